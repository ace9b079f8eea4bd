/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "wafer/wafer_notes.h"
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
