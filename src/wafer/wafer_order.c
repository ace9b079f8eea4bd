/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Order sheets of the plate for people, of all its layers and as it is written: ASCII, to be pasted into a
   shop's form. */
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_writers.h"
#include "wafer/wafer_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* the die whose middle is nearest to a point, not one of those before; NULL: none is left */
static const fw_wafer_site *near(const fw_wafer *w, double x, double y,
                                 const fw_wafer_site *const *before, int n) {
    const fw_wafer_site *best = NULL;
    double least = HUGE_VAL;
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        bool taken = s->kind != FW_WAFER_DIE;
        for (int k = 0; k < n; k++)
            taken = taken || before[k] == s;
        double away = hypot(s->x + 0.5 * w->grid.width - x, s->y + 0.5 * w->grid.height - y);
        if (taken || away >= least) continue;
        least = away;
        best = s;
    }
    return best;
}

/* ---- the whole plate ----
   Places to measure are those of the die nearest to the centre, in coordinates of the plate. */

static void lengths(fw_text *out, const char *what, double a_m, const char *between, double b_m) {
    char a[32], b[32], line[160];
    fw_number_text(a, sizeof a, a_m * 1e3, 9);
    fw_number_text(b, sizeof b, b_m * 1e3, 9);
    snprintf(line, sizeof line, "%s%s%s%s", a, between, b, " mm");
    fw_mask_order_line(out, what, line);
}

static void head(const fw_wafer *w, const fw_mask_order *order, fw_text *out) {
    if (w->rejecting) fw_mask_order_rejected(out, w->rejecting);
    bool several = fw_mask_plates(w->table) > 1;
    fw_text_printf(out, "Order sheet of plate %s-%s%s%s (flexwright " FW_VERSION ")\n\n", w->top,
                   w->flow, several ? "-" : "",
                   several ? fw_mask_plate_at(w->table, order->plate_index).id : "");
    fw_mask_order_line(out, "device", w->device->name);
    fw_mask_order_line(out, "title", w->title);
    fw_mask_order_line(out, "flow", w->flow);
    fw_mask_order_line(out, "top cell", w->top);
    lengths(out, "plate", w->form.plate_m, " mm x ", w->form.plate_m);
    lengths(out, "wafer", w->form.diameter_m, " mm, in the plate's middle; edge exclusion ",
            w->form.edge_m);
    fw_mask_order_set_lines(out, w->table, order);
    fw_mask_order_plate_lines(out, "layers on the plate", w->table, order);
}

static void content_of_layers(const fw_wafer *w, const fw_mask_order *order, const fw_mask *any,
                              const fw_wafer_sum *s, fw_text *out) {
    double width = HUGE_VAL, space = HUGE_VAL, polygons = 0, vertices = 0;
    for (int k = 0; k < w->table->nlayer; k++) {
        if (!order->plate[k]) continue;
        width = fmin(width, s[k].width_m);
        space = fmin(space, s[k].space_m);
        polygons += s[k].polygons;
        vertices += s[k].vertices;
    }
    fw_mask_order_size_lines(out, width, space, any, order->plate_index);
    fw_mask_order_extent_line(out, fw_wafer_extent(w));
    fw_text_printf(out, "%-22s %d dies, %d alignment sites, %d test dies\n", "places", w->dies,
                   w->alignments, w->tests);
    fw_text_printf(out, "%-22s %d, %d references\n", "cells", w->ncell + 1, w->nrun);
    fw_text_printf(out, "%-22s ", "polygons, flat");
    fw_text_number(out, polygons, 15);
    fw_text_add(out, ", ");
    fw_text_number(out, vertices, 15);
    fw_text_add(out, " vertices\n");
}

static void sites_of_middle(const fw_wafer *w, const fw_mask_order *order, const fw_wafer_site *die,
                            fw_geometry_vec2 shift, fw_text *out) {
    char name[2 * FW_WAFER_NAME];
    int wide = fw_mask_order_gds_width(w->table);
    fw_text_printf(out,
                   "\nCD sites in die %s: centre of the chord from the plate's middle and its "
                   "direction, um and degrees\n",
                   fw_wafer_site_name(w, die, name));
    fw_mask_order_site_heading(out, "layer", wide);
    for (int i = 0; i < order->nsite; i++) {
        const fw_mask_order_site *s = &order->site[i];
        fw_geometry_vec2 along = vec_sub(s->to, s->from), at = vec_along(s->from, 0.5, along);
        char gds[FW_MASK_GDS_TEXT];
        fw_mask_order_site_row(out, i + 1, fw_mask_order_gds(gds, &w->table->layer[s->layer]), wide,
                               s, vec_add(at, shift), along);
    }
}

fw_status fw_wafer_write_order(const fw_wafer *w, int plate, const fw_output_file *file, int nfile,
                               fw_text *out) {
    const fw_wafer_site *die = near(w, 0, 0, NULL, 0);
    if (!die) return FW_INTERNAL; /* test dies leave one */
    const fw_wafer_variant *v = &w->variant[die->variant];
    if (fw_wafer_stood_in(v)) v = &w->stand_in;
    fw_mask_order order;
    fw_wafer_sum *s;
    int32_t dx, dy;
    FW_TRY(fw_mask_order_gather(out->arena, v->mask, plate, &order));
    FW_TRY(fw_wafer_sums(w, out->arena, &s));
    fw_wafer_origin(&w->grid, v->die, &dx, &dy);
    head(w, &order, out);
    content_of_layers(w, &order, v->mask, s, out);
    sites_of_middle(w, &order, die, (fw_geometry_vec2){(die->x + dx) * 1e-9, (die->y + dy) * 1e-9},
                    out);
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}

/* ---- the plate as it is written ----
   Every value says where it is from: stated in
   <order>, derived, or usual. */

static const double INCH_M = 25.4e-3;

/* usual thickness of a square plate; NaN: not known (blanks as SEMI P1 lists them) */
static double usual_thickness(double edge_m) {
    static const double known[][2] = {{3, 0.060}, {4, 0.060}, {5, 0.090},
                                      {6, 0.120}, {7, 0.120}, {9, 0.120}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (fabs(edge_m - known[i][0] * INCH_M) < 0.5e-3) return known[i][1] * INCH_M;
    return (double)NAN;
}

static void line_from(fw_text *out, const char *what, double value, const char *unit,
                      const char *from) {
    char number[32], text[300];
    if (isnan(value))
        snprintf(text, sizeof text, "%s", from);
    else
        snprintf(text, sizeof text, "%s %s (%s)", fw_number_text(number, sizeof number, value, 4),
                 unit, from);
    fw_mask_order_line(out, what, text);
}

static double downwards(double m, double step_m) {
    double steps = floor(m / step_m + 1e-9);
    return steps > 0 ? steps * step_m : m;
}

/* Half of what the governing hinge has left, over what a wider line changes of it; a tenth of the
   least feature at most. In: effect, m. Out: m, downwards to 10 nm. First order. */
static double cd_tolerance(const fw_wafer *w, double least_m, bool *derived) {
    double most = 0.1 * least_m, left = 0.5 * (1 - w->effect.used) / fabs(w->effect.per_m);
    *derived = isfinite(left) && left > 0 && left < most;
    return downwards(*derived ? left : most, 10e-9);
}

static void tolerances(const fw_wafer *w, double least_m, fw_text *out) {
    const fw_device_order_asked *o = &w->device->wafer.order;
    bool derived, stated = !isnan(o->cd_m);
    double cd = cd_tolerance(w, least_m, &derived);
    line_from(out, "CD tolerance +-", (stated ? o->cd_m : cd) * 1e6, "um",
              stated    ? "stated"
              : derived ? "half of what the verdict has left"
                        : "a tenth of the least feature or space");
    if (w->effect.what) {
        char text[300], u[32], per[32];
        snprintf(text, sizeof text,
                 "%s: at most %s %% of its limit; lines 0.1 um wider change that by %s %%",
                 w->effect.what, fw_number_text(u, sizeof u, 100 * w->effect.used, 3),
                 fw_number_text(per, sizeof per, 100 * w->effect.per_m * 0.1e-6, 3));
        fw_mask_order_line(out, "", text);
    } else
        fw_mask_order_line(out, "", "what a width changes of the verdict is not known");
    bool registered = !isnan(o->registration_m);
    line_from(out, "registration +-", (registered ? o->registration_m : w->overlay_m / 3) * 1e6,
              "um",
              registered             ? "stated"
              : !isnan(w->overlay_m) ? "a third of the closest overlay of the flow"
                                     : "not asked for: the flow aligns no mask to another");
    bool defect = !isnan(o->defect_m);
    line_from(out, "largest defect", (defect ? o->defect_m : least_m / 3) * 1e6, "um",
              defect ? "stated" : "a third of the least feature or space");
}

static void glass(const fw_wafer *w, fw_text *out) {
    const fw_device_order_asked *o = &w->device->wafer.order;
    char text[200], edge[32], inch[32];
    bool stated = !isnan(o->thickness_m);
    double thick = stated ? o->thickness_m : usual_thickness(w->form.plate_m);
    fw_mask_order_line(out, "material", o->quartz ? "quartz, chrome" : "soda-lime glass, chrome");
    fw_number_text(edge, sizeof edge, w->form.plate_m * 1e3, 6);
    fw_number_text(inch, sizeof inch, w->form.plate_m / INCH_M, 4);
    snprintf(text, sizeof text, "%s mm x %s mm (%s inch)", edge, edge, inch);
    fw_mask_order_line(out, "size", text);
    line_from(out, "thickness", thick * 1e3, "mm",
              stated         ? "stated"
              : isnan(thick) ? "not known for this size: ask"
                             : "usual for the size");
    snprintf(text, sizeof text, "%d", o->quantity);
    fw_mask_order_line(out, "quantity", text);
    fw_mask_order_line(out, "pellicle", o->pellicle ? "yes" : "no");
}

/* ---- where to measure: dies at the centre and at four edges ---- */

enum { PLACES = 5, NAME = 5 }; /* columns of a die's name */

static fw_status sites_of_die(const fw_wafer *w, const fw_wafer_site *die, bool mirrored, bool all,
                              int *number, fw_text *out) {
    const fw_wafer_variant *v = &w->variant[die->variant];
    char name[2 * FW_WAFER_NAME];
    fw_mask_order order;
    int32_t dx, dy;
    if (fw_wafer_stood_in(v)) v = &w->stand_in;
    FW_TRY(fw_mask_order_gather(out->arena, v->mask, w->table->device_plate, &order));
    fw_wafer_origin(&w->grid, v->die, &dx, &dy);
    bool flexure = false;
    for (int i = 0; i < order.nsite; i++) {
        const fw_mask_order_site *s = &order.site[i];
        bool least =
            s->what[0] == 'l' && !strcmp(s->what, s->space ? "least space" : "least width");
        if (!all && !least && flexure) continue; /* at the edges one flexure stands for all */
        flexure = flexure || !least;
        fw_geometry_vec2 along = vec_sub(s->to, s->from), at = vec_along(s->from, 0.5, along);
        double sign = mirrored ? -1 : 1;
        fw_mask_order_site_row(
            out, ++*number, fw_wafer_site_name(w, die, name), NAME, s,
            (fw_geometry_vec2){sign * (at.x + (die->x + dx) * 1e-9), at.y + (die->y + dy) * 1e-9},
            (fw_geometry_vec2){sign * along.x, along.y});
    }
    return FW_OK;
}

static fw_status sites_as_written(const fw_wafer *w, bool mirrored, fw_text *out) {
    static const double to[PLACES][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const fw_wafer_site *die[PLACES];
    int number = 0;
    fw_text_add(out,
                "\nCD sites, as the file has them: centre of the chord from the plate's middle "
                "and its direction, um and degrees\n");
    fw_mask_order_site_heading(out, "die", NAME);
    for (int i = 0; i < PLACES; i++) {
        double r = (double)w->form.usable_dbu;
        die[i] = near(w, r * to[i][0], r * to[i][1], die, i);
        if (!die[i]) break;
        FW_TRY(sites_of_die(w, die[i], mirrored, i == 0, &number, out));
    }
    return FW_OK;
}

static void content_as_written(const fw_wafer *w, const fw_wafer_written *written, fw_text *out) {
    const fw_mask_merge_sums *s = &written->sums;
    char text[300], a[32], b[32], c[32];
    const fw_mask_layer *y = &written->plate.table->layer[0];
    snprintf(text, sizeof text, "%d/%d %s, the only one: %s of the drawing", y->layer, y->datatype,
             y->name, w->table->plate ? w->table->plate : "all layers");
    fw_mask_order_line(out, "layer", text);
    snprintf(text, sizeof text, "%s, %s vertices, at most %d each, none overlap",
             fw_number_text(a, sizeof a, s->polygons, 15),
             fw_number_text(b, sizeof b, s->vertices, 15),
             w->ncell > 0 ? w->cell[0].mask->vertex_limit : 4094);
    fw_mask_order_line(out, "polygons, flat", text);
    snprintf(text, sizeof text,
             "%s for %s holes; besides, frames share edges with the windows of ids",
             fw_number_text(a, sizeof a, s->cuts, 15), fw_number_text(b, sizeof b, s->holes, 15));
    fw_mask_order_line(out, "cuts between them", text);
    snprintf(text, sizeof text, "%d, %d references", written->cells, written->references);
    fw_mask_order_line(out, "cells", text);
    snprintf(text, sizeof text, "%s mm2", fw_number_text(c, sizeof c, s->area_m2 * 1e6, 9));
    fw_mask_order_line(out, "area of the polygons", text);
    fw_mask_order_line(out, "scale", "1");
}

fw_status fw_wafer_write_written_order(const fw_wafer *w, const fw_wafer_written *written,
                                       const fw_output_file *file, int nfile, fw_text *out) {
    const fw_mask *any = w->ncell > 0 ? w->cell[0].mask : w->plate;
    double width = HUGE_VAL, space = HUGE_VAL;
    fw_mask_order order;
    fw_wafer_sum *s;
    char tone[200];
    FW_TRY(fw_mask_order_gather(out->arena, any, w->table->device_plate, &order));
    FW_TRY(fw_wafer_sums(w, out->arena, &s));
    for (int k = 0; k < w->table->nlayer; k++)
        if (order.plate[k]) width = fmin(width, s[k].width_m), space = fmin(space, s[k].space_m);
    if (w->rejecting) fw_mask_order_rejected(out, w->rejecting);
    fw_text_printf(out, "Order sheet of the written plate %s-%s (flexwright " FW_VERSION ")\n\n",
                   w->top, w->flow);
    fw_mask_order_line(out, "device", w->device->name);
    fw_mask_order_line(out, "title", w->title);
    fw_mask_order_line(out, "flow", w->flow);
    fw_mask_order_line(out, "top cell", w->top);
    content_as_written(w, written, out);
    snprintf(tone, sizeof tone, "digitised %s (%s field)", order.tone ? order.tone : "data: ask",
             order.field ? order.field : "unknown");
    fw_mask_order_line(out, "polygon tone", tone);
    fw_mask_order_line(out, "reading", w->table->reading);
    fw_mask_order_line(
        out, "mirror",
        written->mirrored
            ? "done: the data are the mirror image of the drawing; write them as they are"
            : "none: the data are as drawn; write them as they are");
    glass(w, out);
    fw_mask_order_size_lines(out, width, space, any, w->table->device_plate);
    double least = fmin(width, space);
    tolerances(w, isfinite(least) ? least : FW_MASK_LOOK_M, out);
    FW_TRY(sites_as_written(w, written->mirrored, out));
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}
