/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "wafer/wafer_parts.h"
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_writers.h"
#include <stdio.h>
#include <string.h>

bool fw_wafer_stood_in(const fw_wafer_variant *v) {
    return !v->mask;
}

const char *fw_wafer_kind_text(fw_wafer_kind kind) {
    static const char *const text[] = {"die", "alignment", "test"};
    return text[kind];
}

const char *fw_wafer_site_name(const fw_wafer *wafer, const fw_wafer_site *site,
                               char name[2 * FW_WAFER_NAME]) {
    char row[FW_WAFER_NAME], column[FW_WAFER_NAME];
    snprintf(name, (size_t)2 * FW_WAFER_NAME, "%s%s", fw_wafer_row_name(site->row, row),
             fw_wafer_column_name(&wafer->grid, site->column, column));
    return name;
}

double fw_wafer_value(const fw_wafer *wafer, const fw_wafer_variant *v, int sweep) {
    const char *unit = wafer->device->wafer.sweep[sweep].unit;
    fw_quantity_unit u = {.factor = 1};
    if (*unit) fw_quantity_unit_parse(unit, strlen(unit), &u, NULL, NULL);
    return fw_quantity_unit_from_si(&u, v->value[sweep]);
}

const char *fw_wafer_values(fw_arena *arena, const fw_wafer *wafer, const fw_wafer_variant *v) {
    const fw_device_wafer_asked *asked = &wafer->device->wafer;
    const char *text = "";
    for (int k = 0; text && k < asked->nsweep; k++) {
        const fw_device_sweep *s = &asked->sweep[k];
        char number[32];
        text =
            fw_arena_printf(arena, "%s%s%s = %s%s%s", text, k ? ", " : "",
                            wafer->device->parameter[s->parameter].name,
                            fw_number_text(number, sizeof number, fw_wafer_value(wafer, v, k), 6),
                            *s->unit ? " " : "", s->unit);
    }
    return text;
}

typedef struct lines {
    fw_arena *arena;
    const char **line;
    int count;
} lines;

static fw_status add(lines *l, const char *key, const char *value) {
    return fw_mask_note(l->arena, key, value, &l->line[l->count++]);
}

static fw_status add_mm(lines *l, const char *key, double m) {
    char number[32];
    return add(l, key, fw_number_text(number, sizeof number, m * 1e3, 9));
}

static fw_status add_variants(lines *l, const fw_wafer *w) {
    for (int v = 0; w->nvariant > 1 && v < w->nvariant; v++) {
        const fw_wafer_variant *x = &w->variant[v];
        char key[32];
        snprintf(key, sizeof key, "variant %d", v + 1);
        const char *values = fw_wafer_values(l->arena, w, x);
        FW_NEED(values);
        FW_TRY(add(l, key,
                   fw_arena_printf(l->arena, "%s; %d dies; %s%s", values, x->dies,
                                   x->decision ? x->decision : "not judged",
                                   fw_wafer_stood_in(x) ? "; nominal dies instead" : "")));
    }
    return FW_OK;
}

fw_status fw_wafer_notes(fw_arena *arena, const fw_wafer *w, const char ***line, int *count) {
    enum { OWN = 16 };
    lines l = {.arena = arena};
    FW_NEED(l.line = fw_arena_array(arena, const char *, OWN + (size_t)w->nvariant));
    if (w->rejected) FW_TRY(add(&l, "status", "REJECTED"));
    FW_TRY(add(&l, "device", w->device->name));
    FW_TRY(add(&l, "title", w->title));
    FW_TRY(add(&l, "program", "flexwright " FW_VERSION));
    FW_TRY(add(&l, "flow", w->flow));
    FW_TRY(add(&l, "reading", w->table->reading));
    if (w->table->order) FW_TRY(add(&l, "order", w->table->order));
    FW_TRY(add_mm(&l, "plate_mm", w->form.plate_m));
    FW_TRY(add_mm(&l, "wafer_mm", w->form.diameter_m));
    FW_TRY(add_mm(&l, "edge_exclusion_mm", w->form.edge_m));
    FW_TRY(add_mm(&l, "pitch_x_mm", w->grid.pitch_x * 1e-9));
    FW_TRY(add_mm(&l, "pitch_y_mm", w->grid.pitch_y * 1e-9));
    FW_TRY(add(&l, "dies",
               fw_arena_printf(arena, "%d; alignment sites %d; test dies %d", w->dies,
                               w->alignments, w->tests)));
    FW_TRY(add_variants(&l, w));
    *line = l.line;
    *count = l.count;
    return FW_OK;
}

/* The order sheet of the whole plate for people: ASCII, to be pasted into a shop's form. Places to
   measure are those of the die nearest to the centre, in coordinates of the plate. */

static void lengths(fw_text *out, const char *what, double a_m, const char *between, double b_m) {
    char a[32], b[32], line[160];
    fw_number_text(a, sizeof a, a_m * 1e3, 9);
    fw_number_text(b, sizeof b, b_m * 1e3, 9);
    snprintf(line, sizeof line, "%s%s%s%s", a, between, b, " mm");
    fw_mask_order_line(out, what, line);
}

static void head(const fw_wafer *w, const fw_mask_order *order, fw_text *out) {
    if (w->rejected) fw_text_add(out, "REJECTED: the design is not accepted. Do not order.\n\n");
    fw_text_printf(out, "Order sheet of plate %s-%s (flexwright " FW_VERSION ")\n\n", w->top,
                   w->flow);
    fw_mask_order_line(out, "device", w->device->name);
    fw_mask_order_line(out, "title", w->title);
    fw_mask_order_line(out, "flow", w->flow);
    fw_mask_order_line(out, "top cell", w->top);
    lengths(out, "plate", w->form.plate_m, " mm x ", w->form.plate_m);
    lengths(out, "wafer", w->form.diameter_m, " mm, in the plate's middle; edge exclusion ",
            w->form.edge_m);
    fw_mask_order_plate_lines(out, "layers on the plate", w->table, order);
}

static void content(const fw_wafer *w, const fw_mask_order *order, const fw_mask *any,
                    const fw_wafer_sum *s, fw_text *out) {
    double width = HUGE_VAL, space = HUGE_VAL, polygons = 0, vertices = 0;
    for (int k = 0; k < w->table->nlayer; k++) {
        if (!order->plate[k]) continue;
        width = fmin(width, s[k].width_m);
        space = fmin(space, s[k].space_m);
        polygons += s[k].polygons;
        vertices += s[k].vertices;
    }
    fw_mask_order_size_lines(out, width, space, any);
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

/* the die whose middle is nearest to the wafer's */
static const fw_wafer_site *middle_die(const fw_wafer *w) {
    const fw_wafer_site *best = NULL;
    double least = HUGE_VAL;
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        double away = hypot(s->x + 0.5 * w->grid.width, s->y + 0.5 * w->grid.height);
        if (s->kind != FW_WAFER_DIE || away >= least) continue;
        least = away;
        best = s;
    }
    return best;
}

static void sites(const fw_wafer *w, const fw_mask_order *order, const fw_wafer_site *die,
                  fw_geometry_vec2 shift, fw_text *out) {
    char name[2 * FW_WAFER_NAME];
    fw_text_printf(out,
                   "\nCD sites in die %s: centre of the chord from the plate's middle and its "
                   "direction, um and degrees\n"
                   "site  layer  kind        x            y       angle       CD  what\n",
                   fw_wafer_site_name(w, die, name));
    for (int i = 0; i < order->nsite; i++) {
        const fw_mask_order_site *s = &order->site[i];
        const fw_mask_layer *y = &w->table->layer[s->layer];
        fw_geometry_vec2 along = vec_sub(s->to, s->from), at = vec_along(s->from, 0.5, along);
        char gds[32];
        snprintf(gds, sizeof gds, "%d/%d", y->layer, y->datatype);
        fw_text_printf(out, "%4d  %-5s  %-5s ", i + 1, gds, s->space ? "space" : "width");
        fw_text_real(out, "%12.3f", (at.x + shift.x) * 1e6);
        fw_text_real(out, " %12.3f", (at.y + shift.y) * 1e6);
        fw_text_real(out, " %8.2f", atan2(along.y, along.x) * 180 / FW_PI);
        fw_text_real(out, " %8.3f", vec_length(along) * 1e6);
        fw_text_printf(out, "  %s\n", s->what);
    }
}

fw_status fw_wafer_write_order(const fw_wafer *w, const fw_output_file *file, int nfile,
                               fw_text *out) {
    const fw_wafer_site *die = middle_die(w);
    if (!die) return FW_INTERNAL; /* test dies leave one */
    const fw_wafer_variant *v = &w->variant[die->variant];
    if (fw_wafer_stood_in(v)) v = &w->stand_in;
    fw_mask_order order;
    fw_wafer_sum *s;
    int32_t dx, dy;
    FW_TRY(fw_mask_order_gather(out->arena, v->mask, &order));
    FW_TRY(fw_wafer_sums(w, out->arena, &s));
    fw_wafer_origin(&w->grid, v->die, &dx, &dy);
    head(w, &order, out);
    content(w, &order, v->mask, s, out);
    sites(w, &order, die, (fw_geometry_vec2){(die->x + dx) * 1e-9, (die->y + dy) * 1e-9}, out);
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}
