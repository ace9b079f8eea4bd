/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of a wafer say of it: names, values of sweeps, notes for the documentation layer,
   sums over the plate; and its certificate with the data of the order, as JSON. */
#include "base/json.h"
#include "geometry/polygon.h"
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "wafer/wafer.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- names, values, sums ---- */

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

static fw_status add_line(lines *l, const char *key, const char *value) {
    return fw_mask_note(l->arena, key, value, &l->line[l->count++]);
}

static fw_status add_mm_line(lines *l, const char *key, double m) {
    char number[32];
    return add_line(l, key, fw_number_text(number, sizeof number, m * 1e3, 9));
}

static fw_status add_variants(lines *l, const fw_wafer *w) {
    for (int v = 0; w->nvariant > 1 && v < w->nvariant; v++) {
        const fw_wafer_variant *x = &w->variant[v];
        char key[32];
        snprintf(key, sizeof key, "variant %d", v + 1);
        const char *values = fw_wafer_values(l->arena, w, x);
        FW_NEED(values);
        FW_TRY(add_line(l, key,
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
    if (w->rejected) FW_TRY(add_line(&l, "status", "REJECTED"));
    FW_TRY(add_line(&l, "device", w->device->name));
    FW_TRY(add_line(&l, "title", w->title));
    FW_TRY(add_line(&l, "program", "flexwright " FW_VERSION));
    FW_TRY(add_line(&l, "flow", w->flow));
    FW_TRY(add_line(&l, "reading", w->table->reading));
    if (w->table->order) FW_TRY(add_line(&l, "order", w->table->order));
    FW_TRY(add_mm_line(&l, "plate_mm", w->form.plate_m));
    FW_TRY(add_mm_line(&l, "wafer_mm", w->form.diameter_m));
    FW_TRY(add_mm_line(&l, "edge_exclusion_mm", w->form.edge_m));
    FW_TRY(add_mm_line(&l, "pitch_x_mm", w->grid.pitch_x * 1e-9));
    FW_TRY(add_mm_line(&l, "pitch_y_mm", w->grid.pitch_y * 1e-9));
    FW_TRY(add_line(&l, "dies",
                    fw_arena_printf(arena, "%d; alignment sites %d; test dies %d", w->dies,
                                    w->alignments, w->tests)));
    FW_TRY(add_variants(&l, w));
    *line = l.line;
    *count = l.count;
    return FW_OK;
}

/* beside: of the plate itself, which reaches beyond its wafer; NULL: of a cell, whose places lie on it */
static void add_mask(const fw_mask *mask, double times, const fw_wafer_form *beside,
                     fw_wafer_sum *s) {
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *x = &mask->shape[i];
        fw_wafer_sum *of = &s[x->layer];
        double vertices = x->npart == 0 ? x->polygon.count : 0;
        for (int k = 0; k < x->npart; k++)
            vertices += x->part[k].count;
        of->polygons += times * (x->npart == 0 ? 1 : x->npart);
        of->vertices += times * vertices;
        const double area_m2 = 0.5e-18 * (double)fw_geometry_polygon_area2(&x->polygon);
        of->area_m2 += times * area_m2;
        of->over_m2 += times * (beside ? fw_wafer_area_over(beside, &x->polygon) : area_m2);
    }
    for (int k = 0; k < mask->table->nlayer; k++) {
        s[k].width_m = fmin(s[k].width_m, mask->measure[k].width_m);
        s[k].space_m = fmin(s[k].space_m, mask->measure[k].space_m);
        s[k].unfinished = s[k].unfinished || mask->measure[k].unfinished;
    }
}

fw_status fw_wafer_sums(const fw_wafer *w, fw_arena *arena, fw_wafer_sum **out) {
    fw_wafer_sum *s = fw_arena_array(arena, fw_wafer_sum, (size_t)w->table->nlayer);
    FW_NEED(s);
    for (int k = 0; k < w->table->nlayer; k++)
        s[k].width_m = s[k].space_m = HUGE_VAL;
    for (int c = 0; c < w->ncell; c++)
        add_mask(w->cell[c].mask, w->cell[c].placed, NULL, s);
    if (w->plate) add_mask(w->plate, 1, &w->form, s);
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

/* ---- certificate and order data ----
   docs/reference/json.md explains every member. */

static void mm(fw_json *json, const char *key, double m) {
    fw_json_number(json, key, m * 1e3, 12);
}

static void head(fw_json *json, const fw_wafer *w, const char *gds_sha256) {
    static const char *const side[] = {"bottom", "top", "left", "right"};
    fw_json_line(json, 2);
    fw_json_text(json, "schema", "flexwright.wafer/1");
    fw_json_line(json, 2);
    fw_json_text(json, "device", w->device->name);
    fw_json_text(json, "title", w->title);
    fw_json_line(json, 2);
    fw_json_text(json, "flow", w->flow);
    fw_json_text(json, "version", FW_VERSION);
    fw_json_truth(json, "rejected", w->rejected);
    if (w->rejecting) fw_mask_json_because(json, w->rejecting);
    fw_json_line(json, 2);
    fw_json_text(json, "gds_sha256", gds_sha256 ? gds_sha256 : "");
    fw_json_line(json, 2);
    fw_json_text(json, "cell", w->top);
    fw_json_line(json, 2);
    fw_json_object(json, "wafer");
    mm(json, "diameter_mm", w->form.diameter_m);
    mm(json, "flat_mm", w->form.flat_m);
    mm(json, "notch_mm", w->form.notch_m);
    fw_json_text(json, "flat_side", side[w->form.side]);
    mm(json, "edge_exclusion_mm", w->form.edge_m);
    fw_json_end(json);
}

static void grid(fw_json *json, const fw_wafer *w) {
    fw_json_line(json, 2);
    fw_json_object(json, "grid");
    mm(json, "die_x_mm", w->grid.width * 1e-9);
    mm(json, "die_y_mm", w->grid.height * 1e-9);
    mm(json, "pitch_x_mm", w->grid.pitch_x * 1e-9);
    mm(json, "pitch_y_mm", w->grid.pitch_y * 1e-9);
    fw_json_whole(json, "rows", w->grid.rows);
    fw_json_whole(json, "columns", w->grid.columns);
    fw_json_line(json, 4);
    fw_json_text(json, "centre_x", w->grid.street_x ? "street" : "die");
    fw_json_text(json, "centre_y", w->grid.street_y ? "street" : "die");
    fw_json_whole(json, "dies", w->dies);
    fw_json_whole(json, "alignment_sites", w->alignments);
    fw_json_whole(json, "test_dies", w->tests);
    fw_json_truth(json, "ids", w->ids);
    fw_json_end(json);
}

/* what a mask shop asks for; tones and sides are those of the die's own order sheet */
static fw_status plate(fw_json *json, const fw_wafer *w, const fw_wafer_sum *s) {
    static const char *const sense[] = {"right-reading", "wrong-reading"};
    fw_mask_order order;
    const fw_mask *any = w->ncell > 0 ? w->cell[0].mask : w->plate;
    FW_TRY(fw_mask_order_gather(json->out->arena, any, w->table->device_plate, &order));
    double width = HUGE_VAL, space = HUGE_VAL;
    bool unfinished = false;
    for (int k = 0; k < w->table->nlayer; k++)
        if (order.plate[k]) {
            width = fmin(width, s[k].width_m);
            space = fmin(space, s[k].space_m);
            unfinished = unfinished || s[k].unfinished;
        }
    fw_json_line(json, 2);
    fw_json_object(json, "plate");
    mm(json, "edge_mm", w->form.plate_m);
    fw_json_text(json, "layers", w->table->plate);
    fw_json_text(json, "polygon_tone", order.tone);
    fw_json_text(json, "field", order.field);
    fw_json_line(json, 4);
    fw_json_text(json, "reading", w->table->reading);
    fw_json_text(json, "reading_chrome_up", order.mirror < 0 ? NULL : sense[order.mirror]);
    fw_json_whole(json, "grid_nm", 1);
    fw_json_line(json, 4);
    fw_json_number(json, "min_feature_um", width * 1e6, 9);
    fw_json_number(json, "min_space_um", space * 1e6, 9);
    if (unfinished) fw_json_truth(json, "unfinished", true);
    fw_json_number(json, "bias_um_per_edge", any->bias_m * 1e6, 9);
    fw_json_line(json, 4);
    fw_json_list(json, "extent_um");
    fw_geometry_box box = fw_wafer_extent(w);
    const double side[] = {box.x0, box.y0, box.x1, box.y1};
    for (int i = 0; i < 4; i++)
        fw_json_number(json, NULL, side[i] * 1e6, 12);
    fw_json_end(json);
    fw_json_end(json);
    return FW_OK;
}

static void variant(fw_json *json, const fw_wafer *w, int v) {
    const fw_device_wafer_asked *asked = &w->device->wafer;
    const fw_wafer_variant *u = &w->variant[v], *stands = fw_wafer_stood_in(u) ? &w->stand_in : u;
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_whole(json, "variant", v + 1);
    fw_json_list(json, "parameters");
    for (int k = 0; k < asked->nsweep; k++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "name", w->device->parameter[asked->sweep[k].parameter].name);
        fw_json_number(json, "value", fw_wafer_value(w, u, k), 12);
        fw_json_text(json, "unit", asked->sweep[k].unit);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_whole(json, "dies", u->dies);
    fw_json_text(json, "verdict", stands->decision);
    fw_json_number(json, "utilisation", stands->utilisation, 12);
    fw_json_truth(json, "nominal_instead", fw_wafer_stood_in(u));
    fw_json_text(json, "why", u->why);
    fw_json_end(json);
}

static void cell(fw_json *json, const fw_wafer *w, int c) {
    const fw_mask *m = w->cell[c].mask;
    int vertices = 0;
    for (int i = 0; i < m->nshape; i++)
        vertices += m->shape[i].polygon.count;
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_text(json, "cell", w->cell[c].name);
    fw_json_whole(json, "placed", w->cell[c].placed);
    fw_json_whole(json, "polygons", m->nshape);
    fw_json_whole(json, "vertices", vertices);
    fw_json_end(json);
}

static void layer(fw_json *json, const fw_mask_layer *y, const fw_wafer_sum *s) {
    fw_json_line(json, 4);
    fw_json_object(json, NULL);
    fw_json_textf(json, "gds", "%d/%d", y->layer, y->datatype);
    fw_json_text(json, "name", y->name);
    fw_json_number(json, "polygons", s->polygons, 15);
    fw_json_number(json, "vertices", s->vertices, 15);
    fw_json_number(json, "polygon_area_um2", s->area_m2 * 1e12, 17);
    fw_json_number(json, "wafer_area_um2", s->over_m2 * 1e12, 17);
    fw_json_number(json, "min_width_um", s->width_m * 1e6, 9);
    fw_json_number(json, "min_space_um", s->space_m * 1e6, 9);
    if (s->unfinished) fw_json_truth(json, "unfinished", true);
    fw_json_end(json);
}

fw_status fw_wafer_write_json(const fw_wafer *w, const char *gds_sha256, fw_text *out) {
    fw_wafer_sum *s;
    FW_TRY(fw_wafer_sums(w, out->arena, &s));
    fw_json json = fw_json_new(out, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    head(&json, w, gds_sha256);
    grid(&json, w);
    FW_TRY(plate(&json, w, s));
    fw_json_line(&json, 2);
    fw_json_list(&json, "variants");
    for (int v = 0; v < w->nvariant; v++)
        variant(&json, w, v);
    fw_json_end_line(&json, 2);
    fw_json_line(&json, 2);
    fw_json_list(&json, "cells");
    for (int c = 0; c < w->ncell; c++)
        cell(&json, w, c);
    fw_json_end_line(&json, 2);
    fw_json_line(&json, 2);
    fw_json_whole(&json, "arrays", w->nrun);
    fw_json_line(&json, 2);
    fw_json_list(&json, "layers");
    for (int k = 0; k < w->table->nlayer; k++)
        layer(&json, &w->table->layer[k], &s[k]);
    fw_json_end_line(&json, 2);
    fw_json_end_line(&json, 0);
    return fw_json_finish(&json, "\n");
}
