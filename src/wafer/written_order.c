/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Order sheet of a plate as it is written, for people and as JSON. Every value says where it is from: stated
   in <order>, derived, or usual. Lengths of the data are those of the plate, scale included. */
#include "base/json.h"
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "wafer/wafer.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double INCH_M = 25.4e-3;
enum { PLACES = 5, NAME = 5 }; /* dies that are measured; columns of a die's name */

typedef struct said { /* a length and where it is from; NaN: only the words */
    double m;
    const char *from;
} said;

typedef struct measured { /* a chord to be measured, as the file has it */
    const fw_wafer_site *die;
    fw_mask_order_site chord;
} measured;

typedef struct sheet {
    const fw_wafer *wafer;
    const fw_wafer_written *written;
    const fw_mask *any;
    fw_mask_plate_row row;
    fw_mask_order order;
    double width_m, space_m; /* least ones of the written polygons; INFINITY: none below 100 um */
    bool unfinished;         /* the search for them ended before its end */
    said thickness, cd, registration, defect;
    said bearable; /* CD tolerance with which the verdict stays what it is, whatever is stated */
    fw_wafer_beside beside;
    measured *site;
    int nsite, room;
} sheet;

/* ---- what is asked for ---- */

/* usual thickness of a square plate; NaN: not known (blanks as SEMI P1 lists them) */
static double usual_thickness(double edge_m) {
    static const double known[][2] = {{3, 0.060}, {4, 0.060}, {5, 0.090},
                                      {6, 0.120}, {7, 0.120}, {9, 0.120}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (fabs(edge_m - known[i][0] * INCH_M) < 0.5e-3) return known[i][1] * INCH_M;
    return (double)NAN;
}

static said thickness_of(const sheet *s) {
    double stated = s->written->asked->thickness_m;
    double usual = usual_thickness(s->wafer->form.plate_m);
    if (!isnan(stated)) return (said){stated, "stated"};
    return (said){usual, isnan(usual) ? "not known for this size: ask" : "usual for the size"};
}

static double downwards(double m, double step_m) {
    double steps = floor(m / step_m + 1e-9);
    return steps > 0 ? steps * step_m : m;
}

/* closest budget between this plate and one that it is put on, or that is put on it; NaN: there is none */
static double closest_overlay(const sheet *s) {
    const fw_mask_table *t = s->wafer->table;
    double least = (double)NAN;
    for (int p = 0; p < t->nplate; p++)
        if (p == s->written->of || (t->plates[p].aligned_to && s->row.id &&
                                    strcmp(t->plates[p].aligned_to, s->row.id) == 0))
            least = fmin(least, t->plates[p].overlay_m);
    return t->nplate ? least : s->wafer->overlay_m;
}

static bool of_device(const sheet *s) {
    return s->written->of == s->wafer->table->device_plate;
}

/* Half of the way by which lines of the device's plate may be off before something that the verdict accepts is not: a
   hinge, a requirement, a distance. That is first order, so no more than the verdict's corners went themselves; and a
   tenth of the least feature. Of another plate, which no hinge asks: a third of its overlay. All of that is of the wafer,
   on which a plate of scale k is k times smaller. In: effect, m; least_m of the plate. Out: m on the plate, downwards to
   10 nm. */
static said bearable_cd(const sheet *s, double least_m) {
    const fw_wafer_width_effect *e = &s->wafer->effect;
    const double scale = s->written->asked->scale;
    said best = {0.1 * least_m, s->unfinished
                                    ? "a tenth of the least feature or space that was found"
                                    : "a tenth of the least feature or space"};
    if (!of_device(s)) {
        const double third = scale * closest_overlay(s) / 3;
        if (third < best.m) best = (said){third, "a third of the closest overlay"};
    } else {
        if (0.5 * scale * e->left_m < best.m)
            best = (said){0.5 * scale * e->left_m, "half of what the verdict has left"};
        if (scale * e->looked_m < best.m)
            best = (said){scale * e->looked_m,
                          "as far again as the verdict's corners have moved lines"};
    }
    best.m = downwards(best.m, 10e-9);
    return best;
}

static said cd_of(const sheet *s) {
    const double stated = s->written->asked->cd_m;
    return isnan(stated) ? s->bearable : (said){stated, "stated"};
}

static said registration_of(const sheet *s) {
    double stated = s->written->asked->registration_m,
           overlay = s->written->asked->scale * closest_overlay(s);
    if (!isnan(stated)) return (said){stated, "stated"};
    if (!isnan(overlay)) return (said){overlay / 3, "a third of the closest overlay of the flow"};
    return (said){(double)NAN, "not asked for: the flow aligns no mask to another"};
}

/* ---- where to measure: dies at the centre and at four edges ---- */

static fw_geometry_vec2 as_written(const sheet *s, fw_geometry_vec2 p, double dx, double dy) {
    double k = s->written->asked->scale;
    return (fw_geometry_vec2){(s->written->mirrored ? -k : k) * (p.x + dx), k * (p.y + dy)};
}

static fw_status add_site(fw_arena *arena, sheet *s, measured site) {
    if (s->nsite == s->room) {
        int more = s->room ? 2 * s->room : 32;
        FW_NEED(s->site =
                    fw_arena_grow(arena, s->site, (size_t)s->nsite, (size_t)more, sizeof *s->site));
        s->room = more;
    }
    s->site[s->nsite++] = site;
    return FW_OK;
}

/* what was a space of the drawing is a polygon of the other tone */
static fw_mask_order_site turned(fw_mask_order_site chord, bool least) {
    chord.space = !chord.space;
    if (least) chord.what = chord.space ? "least space" : "least width";
    return chord;
}

static fw_status sites_of_die(fw_arena *arena, sheet *s, const fw_wafer_site *die, bool all) {
    const fw_wafer *w = s->wafer;
    const fw_wafer_variant *v = &w->variant[die->variant];
    fw_mask_order order;
    int32_t dx, dy;
    if (fw_wafer_stood_in(v)) v = &w->stand_in;
    FW_TRY(fw_mask_order_gather(arena, v->mask, s->written->of, &order));
    fw_wafer_origin(&w->grid, v->die, &dx, &dy);
    double x = (die->x + dx) * 1e-9, y = (die->y + dy) * 1e-9;
    bool flexure = false;
    for (int i = 0; i < order.nsite; i++) {
        fw_mask_order_site chord = order.site[i];
        bool least = strcmp(chord.what, chord.space ? "least space" : "least width") == 0;
        if (!all && !least && flexure) continue; /* at the edges one flexure stands for all */
        flexure = flexure || !least;
        chord.from = as_written(s, chord.from, x, y);
        chord.to = as_written(s, chord.to, x, y);
        if (s->written->asked->inverted) chord = turned(chord, least);
        FW_TRY(add_site(arena, s, (measured){die, chord}));
    }
    return FW_OK;
}

static fw_status find_sites(fw_arena *arena, sheet *s) {
    static const double to[PLACES][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const fw_wafer_site *die[PLACES];
    for (int i = 0; i < PLACES; i++) {
        double r = (double)s->wafer->form.usable_dbu;
        die[i] = fw_wafer_nearest_die(s->wafer, r * to[i][0], r * to[i][1], die, i);
        if (!die[i]) break;
        FW_TRY(sites_of_die(arena, s, die[i], i == 0));
    }
    return FW_OK;
}

static fw_status gather(fw_arena *arena, const fw_wafer *w, const fw_wafer_written *written,
                        sheet *s) {
    fw_wafer_sum *sum;
    double width = HUGE_VAL, space = HUGE_VAL;
    *s = (sheet){.wafer = w,
                 .written = written,
                 .any = w->ncell > 0 ? w->cell[0].mask : w->plate,
                 .row = fw_mask_plate_at(w->table, written->of),
                 .beside = w->beside ? w->beside[written->of] : (fw_wafer_beside){0}};
    FW_TRY(fw_mask_order_gather(arena, s->any, written->of, &s->order));
    FW_TRY(fw_wafer_sums(w, arena, &sum));
    for (int k = 0; k < w->table->nlayer; k++)
        if (s->order.plate[k])
            width = fmin(width, sum[k].width_m), space = fmin(space, sum[k].space_m),
            s->unfinished = s->unfinished || sum[k].unfinished;
    const fw_device_order_asked *asked = written->asked;
    s->width_m = asked->scale * (asked->inverted ? space : width);
    s->space_m = asked->scale * (asked->inverted ? width : space);
    double least = fmin(width, space) * asked->scale;
    if (!isfinite(least)) least = FW_MASK_LOOK_M;
    s->thickness = thickness_of(s);
    s->bearable = bearable_cd(s, least);
    s->cd = cd_of(s);
    s->registration = registration_of(s);
    const char *third = s->unfinished ? "a third of the least feature or space that was found"
                                      : "a third of the least feature or space";
    s->defect =
        isnan(asked->defect_m) ? (said){least / 3, third} : (said){asked->defect_m, "stated"};
    if (asked->inverted && s->order.tone) {
        bool dark = strcmp(s->order.tone, "data dark") == 0;
        s->order.tone = dark ? "data clear" : "data dark";
        s->order.field = dark ? "dark" : "clear";
    }
    return find_sites(arena, s);
}

/* ---- for people ---- */

static void line_from(fw_text *out, const char *what, said value, double unit_m, const char *unit) {
    char number[32], text[300];
    if (isnan(value.m))
        snprintf(text, sizeof text, "%s", value.from);
    else
        snprintf(text, sizeof text, "%s %s (%s)",
                 fw_number_text(number, sizeof number, value.m / unit_m, 4), unit, value.from);
    fw_mask_order_line(out, what, text);
}

static void tolerances(const sheet *s, fw_text *out) {
    char text[300];
    line_from(out, "CD tolerance +-", s->cd, 1e-6, "um");
    if (of_device(s)) fw_mask_order_line(out, "", s->wafer->effect.says);
    line_from(out, "registration +-", s->registration, 1e-6, "um");
    if (s->wafer->fiducial_m > 0) {
        char at[32];
        snprintf(text, sizeof text, "at the crosses in the corners, x and y = +-%s mm%s",
                 fw_number_text(at, sizeof at, s->wafer->fiducial_m * 1e3, 9),
                 fw_mask_plates(s->wafer->table) > 1 ? ": the same on every plate of the set" : "");
        fw_mask_order_line(out, "", text);
    }
    line_from(out, "largest defect", s->defect, 1e-6, "um");
}

static void glass(const sheet *s, fw_text *out) {
    const fw_device_order_asked *o = s->written->asked;
    char text[200], edge[32], inch[32];
    fw_mask_order_line(out, "material", o->quartz ? "quartz, chrome" : "soda-lime glass, chrome");
    fw_number_text(edge, sizeof edge, s->wafer->form.plate_m * 1e3, 6);
    fw_number_text(inch, sizeof inch, s->wafer->form.plate_m / INCH_M, 4);
    snprintf(text, sizeof text, "%s mm x %s mm (%s inch)", edge, edge, inch);
    fw_mask_order_line(out, "size", text);
    line_from(out, "thickness", s->thickness, 1e-3, "mm");
    snprintf(text, sizeof text, "%d", o->quantity);
    fw_mask_order_line(out, "quantity", text);
    fw_mask_order_line(out, "pellicle", o->pellicle ? "yes" : "no");
}

/* the inner edge of the flat line, as the file has it: *along of the coordinate "x" or "y"; false: there is none */
static bool flat_line_of(const sheet *s, const char **coordinate, double *at_m) {
    const fw_wafer_form *f = &s->wafer->form;
    double chord2_m2 = f->diameter_m * f->diameter_m - f->flat_m * f->flat_m;
    double away = 0.5 * s->written->asked->scale * sqrt(chord2_m2);
    bool upright = f->side == FW_SIDE_LEFT || f->side == FW_SIDE_RIGHT;
    bool below = f->side == FW_SIDE_LEFT || f->side == FW_SIDE_BOTTOM;
    *coordinate = upright ? "x" : "y";
    *at_m = (below ? -away : away) * (upright && s->written->mirrored ? -1 : 1);
    return s->beside.flat_line;
}

/* what stands on the glass besides dies, word by word: it is compared with the plate that comes back */
static void beside(const sheet *s, fw_text *out) {
    const fw_wafer_beside *b = &s->beside;
    char text[300], long_mm[32], at_mm[32];
    const char *coordinate;
    double at_m, long_m = s->written->asked->scale * s->wafer->form.flat_m;
    fw_mask_order_line(out, "text at the top", b->title ? b->title : "none: it has no room");
    fw_mask_order_line(out, "text at the bottom", b->line ? b->line : "none: it has no room");
    if (b->barcode)
        snprintf(text, sizeof text, "%s (Code 39), %s of the wafer", b->barcode,
                 s->written->mirrored ? "on the right" : "on the left");
    fw_mask_order_line(out, "barcode", b->barcode ? text : "none");
    bool line = flat_line_of(s, &coordinate, &at_m);
    snprintf(text, sizeof text, "%s mm long, its inner edge at %s = %s mm",
             fw_number_text(long_mm, sizeof long_mm, long_m * 1e3, 6), coordinate,
             fw_number_text(at_mm, sizeof at_mm, at_m * 1e3, 6));
    fw_mask_order_line(out, "flat line", line ? text : "none");
}

static void cuts(const fw_mask_merge_sums *s, bool ids, fw_text *out) {
    char text[300], a[32], b[32], c[32];
    snprintf(text, sizeof text, "%s for %s holes%s%s%s%s", fw_number_text(a, sizeof a, s->cuts, 15),
             fw_number_text(b, sizeof b, s->holes, 15), isfinite(s->clear_m) ? ", at least " : "",
             isfinite(s->clear_m) ? fw_number_text(c, sizeof c, s->clear_m * 1e9, 4) : "",
             isfinite(s->clear_m) ? " nm from other vertices" : "",
             ids ? "; besides, frames share edges with the windows of ids" : "");
    fw_mask_order_line(out, "cuts between them", text);
}

static void content(const sheet *s, fw_text *out) {
    const fw_mask_merge_sums *sums = &s->written->sums;
    const fw_mask_layer *y = &s->written->plate.table->layer[0];
    const fw_device_order_asked *o = s->written->asked;
    char text[300], a[32], b[32];
    snprintf(text, sizeof text, "%d/%d %s, the only one: %s%s of the drawing", y->layer,
             y->datatype, y->name, o->inverted ? "what is left free by " : "",
             s->row.layers ? s->row.layers : "all layers");
    fw_mask_order_line(out, "layer", text);
    snprintf(text, sizeof text, "%s, %s vertices, at most %d each, none overlap",
             fw_number_text(a, sizeof a, sums->polygons, 15),
             fw_number_text(b, sizeof b, sums->vertices, 15), s->any->vertex_limit);
    fw_mask_order_line(out, "polygons, flat", text);
    cuts(sums, s->wafer->ids, out);
    snprintf(text, sizeof text, "%d, %d references", s->written->cells, s->written->references);
    fw_mask_order_line(out, "cells", text);
    snprintf(text, sizeof text, "%s mm2", fw_number_text(a, sizeof a, sums->area_m2 * 1e6, 9));
    fw_mask_order_line(out, "area of the polygons", text);
    if (!s->wafer
             ->single) { /* titles and crosses stand beside the wafer, and nothing is made of them */
        snprintf(text, sizeof text, "%s mm2",
                 fw_number_text(a, sizeof a, s->written->over_m2 * 1e6, 9));
        fw_mask_order_line(out, "of it over the wafer", text);
    }
    snprintf(text, sizeof text, "%s%s", fw_number_text(a, sizeof a, o->scale, 9),
             o->scale != 1 ? ", in the data already: write them as they are" : "");
    fw_mask_order_line(out, "scale", text);
}

/* are the data already what the reading asks for, seen with the chrome up? -1: the reading does not say */
static int as_read(const sheet *s) {
    return s->order.mirror < 0 ? -1 : s->written->mirrored == (s->order.mirror == 1);
}

static const char *mirror_words(const sheet *s) {
    switch (as_read(s)) {
    case 1:
        return s->written->mirrored
                   ? "done: the data are the mirror image of the drawing; write them as they are"
                   : "none: the data are as drawn; write them as they are";
    case 0:
        return s->written->mirrored
                   ? "to be undone: the data are the mirror image of the drawing; mirror them when "
                     "writing (x becomes -x), so that the plate reads as said above"
                   : "to be done: the data are as drawn; mirror them when writing (x becomes -x), "
                     "so "
                     "that the plate reads as said above";
    }
    return s->written->mirrored
               ? "the data are the mirror image of the drawing; the reading does not "
                 "say what is wanted: ask before writing"
               : "the data are as drawn; the reading does not say what is wanted: "
                 "ask before writing";
}

static void reading(const sheet *s, fw_text *out) {
    char text[200], edge[32];
    const fw_device_order_asked *o = s->written->asked;
    snprintf(text, sizeof text, "digitised %s (%s field)%s",
             s->order.tone ? s->order.tone : "data: ask",
             s->order.field ? s->order.field : "unknown",
             o->inverted ? ": the other one than the drawing's" : "");
    fw_mask_order_line(out, "polygon tone", text);
    if (o->inverted) {
        snprintf(text, sizeof text,
                 "done within a square of %s mm about the middle; write the data as they are",
                 fw_number_text(edge, sizeof edge, s->written->field_m * 1e3, 6));
        fw_mask_order_line(out, "inverted", text);
    }
    fw_mask_order_line(out, "reading", s->row.reading);
    fw_mask_order_line(out, "mirror", mirror_words(s));
}

static void sites(const sheet *s, fw_text *out) {
    fw_text_add(out, "\nCD sites, as the file has them: centre of the chord from the plate's "
                     "middle and its direction, um and degrees\n");
    fw_mask_order_site_heading(out, "die", NAME);
    for (int i = 0; i < s->nsite; i++) {
        const fw_mask_order_site *c = &s->site[i].chord;
        fw_geometry_vec2 along = vec_sub(c->to, c->from);
        char name[2 * FW_WAFER_NAME];
        fw_mask_order_site_row(out, i + 1, fw_wafer_site_name(s->wafer, s->site[i].die, name), NAME,
                               c, vec_along(c->from, 0.5, along), along);
    }
}

static const char *name_of(fw_arena *arena, const sheet *s) {
    bool several = fw_mask_plates(s->wafer->table) > 1;
    return fw_arena_printf(arena, "%s-%s%s%s", s->wafer->top, s->wafer->flow, several ? "-" : "",
                           several ? s->row.id : "");
}

fw_status fw_wafer_write_written_order(const fw_wafer *w, const fw_wafer_written *written,
                                       const fw_output_file *file, int nfile, fw_text *out) {
    sheet s;
    FW_TRY(gather(out->arena, w, written, &s));
    const char *name = name_of(out->arena, &s);
    FW_NEED(name);
    if (w->rejecting) fw_mask_order_rejected(out, w->rejecting);
    fw_text_printf(out, "Order sheet of the written plate %s (flexwright " FW_VERSION ")\n\n",
                   name);
    fw_mask_order_line(out, "device", w->device->name);
    fw_mask_order_line(out, "title", w->title);
    fw_mask_order_line(out, "flow", w->flow);
    fw_mask_order_set_lines(out, w->table, &s.order);
    fw_mask_order_line(out, "top cell", w->top);
    content(&s, out);
    reading(&s, out);
    beside(&s, out);
    glass(&s, out);
    fw_mask_order_scaled_lines(out, s.width_m, s.space_m, s.unfinished, s.any, written->of,
                               written->asked->scale);
    tolerances(&s, out);
    sites(&s, out);
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}

/* ---- what the order asks for, against what the verdict and a shop bear ---- */

/* lines within less than this, of either kind, no shop promises: laser writers hold 0.1 to 0.3 um, electron beams a few
   hundredths on the best plates (assumed) */
static const double FINEST_CD_M = 30e-9;

static void check_cd(const sheet *s, fw_place place, const char *plate, fw_diags *diags) {
    char is[32], bears[32], finest[32];
    fw_number_text(is, sizeof is, s->cd.m * 1e6, 4);
    fw_number_text(bears, sizeof bears, s->bearable.m * 1e6, 4);
    fw_number_text(finest, sizeof finest, FINEST_CD_M * 1e6, 4);
    if (s->cd.m > s->bearable.m * (1 + 1e-9) && s->wafer->effect.left_m >= 0)
        fw_diag_warning(diags, 689, place,
                        "%s: a CD tolerance of %s um is stated, and +-%s um is %s%s%s: lines that "
                        "are off by what is stated may change the verdict",
                        plate, is, bears, s->bearable.from, of_device(s) ? ", decided by " : "",
                        of_device(s) ? s->wafer->effect.says : "");
    if (s->cd.m < FINEST_CD_M)
        fw_diag_warning(
            diags, 697, place,
            "%s: a CD tolerance of +-%s um is asked for (%s%s%s), and finer than %s um "
            "no shop promises one: give the device more room there, or order the plate at "
            "a larger scale",
            plate, is, s->cd.from, of_device(s) ? ", decided by " : "",
            of_device(s) ? s->wafer->effect.says : "", finest);
}

fw_status fw_wafer_check_orders(fw_arena *arena, const fw_wafer *w, fw_diags *diags) {
    for (int p = 0; p < fw_mask_plates(w->table); p++) {
        const fw_mask_plate_row row = fw_mask_plate_at(w->table, p);
        const fw_device_order_asked *asked = fw_device_order_of(&w->device->wafer, row.id);
        fw_wafer_written written = {.of = p, .asked = asked};
        sheet s;
        const fw_place place = asked->place.file ? asked->place : w->device->wafer.place;
        const char *plate = fw_arena_printf(arena, "<order>: plate%s%s of flow %s",
                                            row.id ? " " : "", row.id ? row.id : "", w->flow);
        FW_NEED(plate);
        FW_TRY(gather(arena, w, &written, &s));
        written.mirrored =
            asked->mirror == FW_MIRROR_READ ? s.order.mirror == 1 : asked->mirror == FW_MIRROR_YES;
        if (as_read(&s) == 0)
            fw_diag_warning(diags, 688, place,
                            "%s: mirror=\"%s\" leaves data that are not what its reading (%s) asks "
                            "for: its sheet asks the shop to mirror them when it writes; leave "
                            "mirror out, and they are written as they are",
                            plate, asked->mirror == FW_MIRROR_YES ? "yes" : "no", row.reading);
        if (!w->rejected) check_cd(&s, place, plate, diags);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- for programs ----
   docs/reference/json.md explains every member. */

static void json_line(fw_json *json, const char *key, const char *value) {
    fw_json_line(json, 2);
    fw_json_text(json, key, value);
}

/* "cd_tolerance_um": 0.1, "cd_tolerance_from": "stated" */
static void json_said(fw_json *json, const char *key, const char *from, said value, double unit_m) {
    fw_json_line(json, 2);
    fw_json_number(json, key, value.m / unit_m, 9);
    fw_json_text(json, from, value.from);
}

static void json_data(fw_json *json, const sheet *s) {
    const fw_wafer_written *written = s->written;
    const fw_mask_merge_sums *sums = &written->sums;
    const fw_mask_layer *y = &written->plate.table->layer[0];
    fw_json_line(json, 2);
    fw_json_textf(json, "gds", "%d/%d", y->layer, y->datatype);
    fw_json_text(json, "layer", y->name);
    fw_json_text(json, "layers", s->row.layers);
    json_line(json, "polygon_tone", s->order.tone);
    fw_json_text(json, "field", s->order.field);
    fw_json_truth(json, "inverted_in_data", written->asked->inverted);
    fw_json_number(json, "field_mm", written->field_m > 0 ? written->field_m * 1e3 : (double)NAN,
                   9);
    json_line(json, "reading", s->row.reading);
    fw_json_truth(json, "mirrored_in_data", written->mirrored);
    if (as_read(s) < 0)
        fw_json_null(json, "mirror_when_writing");
    else
        fw_json_truth(json, "mirror_when_writing", as_read(s) == 0);
    fw_json_number(json, "scale_in_data", written->asked->scale, 12);
    fw_json_line(json, 2);
    fw_json_number(json, "polygons", sums->polygons, 15);
    fw_json_number(json, "vertices", sums->vertices, 15);
    fw_json_whole(json, "vertex_limit", s->any->vertex_limit);
    fw_json_number(json, "area_mm2", sums->area_m2 * 1e6, 12);
    if (!s->wafer->single) fw_json_number(json, "wafer_area_mm2", written->over_m2 * 1e6, 12);
    fw_json_number(json, "cuts", sums->cuts, 15);
    fw_json_number(json, "holes", sums->holes, 15);
    fw_json_number(json, "cut_clearance_nm", sums->clear_m * 1e9, 9);
    fw_json_whole(json, "cells", written->cells);
    fw_json_whole(json, "references", written->references);
    fw_json_line(json, 2);
    fw_json_number(json, "min_feature_um", s->width_m * 1e6, 9);
    fw_json_number(json, "min_space_um", s->space_m * 1e6, 9);
    if (s->unfinished) fw_json_truth(json, "unfinished", true);
    fw_json_number(json, "bias_um_per_edge",
                   written->asked->scale * fw_mask_plate_bias_m(s->any, written->of) * 1e6, 9);
    fw_json_truth(json, "bias_in_data", true);
    fw_json_whole(json, "mask_cd_bias_um", 0);
    fw_json_whole(json, "grid_nm", 1);
}

static void json_glass(fw_json *json, const sheet *s) {
    const fw_device_order_asked *o = s->written->asked;
    double f = s->wafer->fiducial_m;
    json_line(json, "material", o->quartz ? "quartz" : "soda-lime");
    fw_json_number(json, "size_mm", s->wafer->form.plate_m * 1e3, 9);
    fw_json_whole(json, "quantity", o->quantity);
    fw_json_truth(json, "pellicle", o->pellicle);
    fw_json_text(json, "text_at_top", s->beside.title);
    fw_json_text(json, "text_at_bottom", s->beside.line);
    fw_json_text(json, "barcode", s->beside.barcode);
    fw_json_truth(json, "flat_line", s->beside.flat_line);
    json_said(json, "thickness_mm", "thickness_from", s->thickness, 1e-3);
    json_said(json, "cd_tolerance_um", "cd_tolerance_from", s->cd, 1e-6);
    if (of_device(s)) fw_json_text(json, "cd_tolerance_decided_by", s->wafer->effect.says);
    json_said(json, "registration_um", "registration_from", s->registration, 1e-6);
    json_said(json, "largest_defect_um", "largest_defect_from", s->defect, 1e-6);
    fw_json_line(json, 2);
    fw_json_list(json, "registration_sites_um");
    for (int k = 0; f > 0 && k < 4; k++) {
        fw_json_list(json, NULL);
        fw_json_fixed(json, NULL, (k % 2 ? f : -f) * 1e6, 4);
        fw_json_fixed(json, NULL, (k / 2 ? f : -f) * 1e6, 4);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void json_site(fw_json *json, const sheet *s, int i) {
    const fw_mask_order_site *c = &s->site[i].chord;
    const fw_geometry_vec2 end[] = {c->from, c->to};
    char name[2 * FW_WAFER_NAME];
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_whole(json, "site", i + 1);
    fw_json_text(json, "die", fw_wafer_site_name(s->wafer, s->site[i].die, name));
    fw_json_text(json, "what", c->what);
    fw_json_text(json, "kind", c->space ? "space" : "width");
    fw_json_number(json, "cd_um", vec_distance(c->from, c->to) * 1e6, 9);
    for (int k = 0; k < 2; k++) {
        fw_json_list(json, k ? "to_um" : "from_um");
        fw_json_fixed(json, NULL, end[k].x * 1e6, 4);
        fw_json_fixed(json, NULL, end[k].y * 1e6, 4);
        fw_json_end(json);
    }
    fw_json_end(json);
}

fw_status fw_wafer_write_written_order_json(const fw_wafer *w, const fw_wafer_written *written,
                                            const fw_output_file *file, int nfile, fw_text *out) {
    sheet s;
    FW_TRY(gather(out->arena, w, written, &s));
    const char *name = name_of(out->arena, &s);
    FW_NEED(name);
    fw_json json = fw_json_new(out, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    json_line(&json, "schema", "flexwright.plate/1");
    json_line(&json, "plate", name);
    json_line(&json, "device", w->device->name);
    fw_json_text(&json, "title", w->title);
    fw_json_text(&json, "flow", w->flow);
    fw_json_text(&json, "cell", w->top);
    fw_json_text(&json, "version", FW_VERSION);
    fw_json_line(&json, 2);
    fw_json_truth(&json, "rejected", w->rejected);
    if (w->rejecting) fw_mask_json_because(&json, w->rejecting);
    fw_mask_json_set(&json, w->table, &s.order);
    json_data(&json, &s);
    json_glass(&json, &s);
    fw_json_line(&json, 2);
    fw_json_list(&json, "cd_sites");
    for (int i = 0; i < s.nsite; i++)
        json_site(&json, &s, i);
    fw_json_end_line(&json, 2);
    fw_mask_json_files(&json, file, nfile);
    fw_json_end_line(&json, 2);
    fw_json_end_line(&json, 0);
    return fw_json_finish(&json, "\n");
}
