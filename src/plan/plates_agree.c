/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pack of a flow and its layer table speak of the same plates: printed in one order, drawn smaller by the same length,
   aligned to the same one within the same budget. Page: docs/theory/plates.md; test: test_hollows.c. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

static bool same(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
}

/* steps print the plates of the table, each once and in its order */
static void check_order(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table) {
    int printed = 0;
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        if (!s->mask[0]) continue;
        int plate = fw_mask_plate_named(table, s->mask);
        if (plate < 0 || plate != printed)
            fw_diag_error(
                diags, 412, s->place,
                "step %s prints mask=\"%s\"; next of the plates in masks/%s.xml is %s%s%s", s->id,
                s->mask, flow->id, printed < table->nplate ? "\"" : "none",
                printed < table->nplate ? table->plates[printed].id : "",
                printed < table->nplate ? "\"" : "");
        printed++;
    }
    if (printed < table->nplate)
        fw_diag_error(diags, 412, table->plates[printed].place,
                      "plate \"%s\" is printed by no step of flow %s", table->plates[printed].id,
                      flow->id);
}

static const fw_process_plate *plate_of(const fw_process_flow *flow, const char *id) {
    for (int p = 0; p < flow->nplate; p++)
        if (same(flow->plate[p].id, id)) return &flow->plate[p];
    return NULL;
}

/* rows <plate> of the pack and of the table, but for the device's */
static void check_rows(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table) {
    for (int p = 0; p < flow->nplate; p++) {
        int row = fw_mask_plate_named(table, flow->plate[p].id);
        if (row < 0 || row == table->device_plate)
            fw_diag_error(diags, 421, flow->plate[p].place,
                          "plate \"%s\" is %s in masks/%s.xml; <plate> of a pack names those "
                          "besides the device's",
                          flow->plate[p].id, row < 0 ? "no row" : "that of the device", flow->id);
    }
    for (int row = 0; row < table->nplate; row++)
        if (row != table->device_plate && !plate_of(flow, table->plates[row].id))
            fw_diag_error(diags, 421, table->plates[row].place,
                          "the pack says nothing of plate \"%s\"; add <plate id=\"%s\" "
                          "inside=\"...\" outside=\"...\"/> to processes/%s.xml",
                          table->plates[row].id, table->plates[row].id, flow->id);
}

/* every layer of a plate is drawn by the length that the pack names */
static void check_lengths(fw_diags *diags, const fw_process_flow *flow,
                          const fw_mask_table *table) {
    for (int p = 0; p < flow->nplate; p++) {
        const char *shrink = flow->plate[p].shrink ? flow->plate[p].shrink->id : NULL;
        int row = fw_mask_plate_named(table, flow->plate[p].id);
        for (int k = 0; row >= 0 && k < table->nlayer; k++) {
            const fw_mask_layer *l = &table->layer[k];
            const char *by = l->shrink ? l->shrink : l->grow;
            if (!fw_mask_plate_draws(table, row, k) || same(by, shrink)) continue;
            fw_diag_error(diags, 421, l->place,
                          "layer \"%s\" of plate \"%s\" is drawn by %s, but the pack draws that "
                          "plate by %s (shrink); name the same quantity in both",
                          l->id, flow->plate[p].id, by ? by : "nothing",
                          shrink ? shrink : "nothing");
        }
    }
}

/* steps align to what the table says, within its budget */
static void check_alignment(fw_diags *diags, const fw_process_flow *flow,
                            const fw_mask_table *table) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        int row = s->mask[0] ? fw_mask_plate_named(table, s->mask) : -1;
        if (row < 0) continue;
        const fw_mask_plate_row *t = &table->plates[row];
        if (!same(s->align.to, t->aligned_to)) {
            fw_diag_error(diags, 421, s->align.to ? s->align.place : s->place,
                          "step %s aligns plate \"%s\" to %s, and masks/%s.xml to %s", s->id,
                          s->mask, s->align.to ? s->align.to : "nothing", flow->id,
                          t->aligned_to ? t->aligned_to : "nothing");
            continue;
        }
        const fw_quantity *q = s->align.to ? s->align.overlay : NULL;
        char a[32], b[32];
        if (!q || q->unknown || q->value <= t->overlay_m * (1.0 + 1e-9)) continue;
        fw_diag_error(diags, 421, s->align.place,
                      "step %s lets plate \"%s\" lie %s um off, but masks/%s.xml reckons with "
                      "%s um: the hollows and pads of this device stand only that",
                      s->id, s->mask, fw_number_text(a, sizeof a, q->value * 1e6, 4), flow->id,
                      fw_number_text(b, sizeof b, t->overlay_m * 1e6, 4));
    }
}

void fw_plan_check_plates(fw_diags *diags, const fw_process_flow *flow,
                          const fw_mask_table *table) {
    if (table->nplate > 1) check_order(diags, flow, table);
    check_rows(diags, flow, table);
    check_lengths(diags, flow, table);
    if (table->nplate > 1) check_alignment(diags, flow, table);
}
