/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of a wafer say of it: names, values of sweeps, notes for the documentation layer,
   sums over the plate. */
#include "geometry/polygon.h"
#include "mask/mask_writers.h"
#include "wafer/wafer_parts.h"
#include <math.h>
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

static void add_mask(const fw_mask *mask, double times, fw_wafer_sum *s) {
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *x = &mask->shape[i];
        fw_wafer_sum *of = &s[x->layer];
        double vertices = x->npart == 0 ? x->polygon.count : 0;
        for (int k = 0; k < x->npart; k++)
            vertices += x->part[k].count;
        of->polygons += times * (x->npart == 0 ? 1 : x->npart);
        of->vertices += times * vertices;
        of->area_m2 += times * 0.5e-18 * (double)fw_geometry_polygon_area2(&x->polygon);
    }
    for (int k = 0; k < mask->table->nlayer; k++) {
        s[k].width_m = fmin(s[k].width_m, mask->measure[k].width_m);
        s[k].space_m = fmin(s[k].space_m, mask->measure[k].space_m);
    }
}

fw_status fw_wafer_sums(const fw_wafer *w, fw_arena *arena, fw_wafer_sum **out) {
    fw_wafer_sum *s = fw_arena_array(arena, fw_wafer_sum, (size_t)w->table->nlayer);
    FW_NEED(s);
    for (int k = 0; k < w->table->nlayer; k++)
        s[k].width_m = s[k].space_m = HUGE_VAL;
    for (int c = 0; c < w->ncell; c++)
        add_mask(w->cell[c].mask, w->cell[c].placed, s);
    if (w->plate) add_mask(w->plate, 1, s);
    *out = s;
    return FW_OK;
}

fw_geometry_box fw_wafer_extent(const fw_wafer *w) {
    if (w->plate) return w->plate->box;
    fw_geometry_box b = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < w->grid.nsite; i++) {
        double x = w->grid.site[i].x * 1e-9, y = w->grid.site[i].y * 1e-9;
        b = (fw_geometry_box){fmin(b.x0, x), fmin(b.y0, y), fmax(b.x1, x + w->grid.width * 1e-9),
                              fmax(b.y1, y + w->grid.height * 1e-9)};
    }
    return b;
}
