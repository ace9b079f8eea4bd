/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plates of a table, and the lists that contents add to. */
#include "mask/mask_plates.h"
#include "layout/layout_text.h"
#include <math.h>
#include <string.h>

int fw_mask_plates(const fw_mask_table *table) {
    return table->nplate ? table->nplate : 1;
}

fw_mask_plate_row fw_mask_plate_at(const fw_mask_table *table, int i) {
    if (table->nplate) return table->plates[i];
    return (fw_mask_plate_row){.id = "device",
                               .title = "the device",
                               .layers = table->plate,
                               .reading = table->reading,
                               .order = table->order,
                               .overlay_m = (double)NAN};
}

int fw_mask_plate_named(const fw_mask_table *table, const char *id) {
    for (int i = 0; id && i < table->nplate; i++)
        if (strcmp(table->plates[i].id, id) == 0) return i;
    return -1;
}

double fw_mask_content_m(const fw_mask_table *table, const char *kind, const char *parameter) {
    for (int i = 0; i < table->ncontent; i++) {
        const fw_mask_content_kind *k = table->content[i].kind;
        for (int j = 0; strcmp(k->name, kind) == 0 && j < k->nparameter; j++)
            if (strcmp(k->parameter[j].name, parameter) == 0) return table->content[i].value[j];
    }
    return (double)NAN;
}

fw_status fw_mask_sheet_add(fw_mask_sheet *sheet, fw_layout_role role, int body, const char *label,
                            const fw_geometry_contour *contour) {
    fw_layout_piece piece = {
        .role = role, .body = body, .joint = FW_NONE, .label = label, .contour = *contour};
    return fw_layout_add(sheet->arena, piece, &sheet->piece, &sheet->npiece, &sheet->capacity);
}

fw_status fw_mask_verdict_add(fw_mask_verdict *verdict, const char *text) {
    FW_NEED(text);
    if (verdict->n == verdict->room) {
        int more = 2 * verdict->room + 8;
        FW_NEED(verdict->reason = fw_arena_grow(verdict->arena, verdict->reason, (size_t)verdict->n,
                                                (size_t)more, sizeof *verdict->reason));
        verdict->room = more;
    }
    verdict->reason[verdict->n++] = text;
    return FW_OK;
}
