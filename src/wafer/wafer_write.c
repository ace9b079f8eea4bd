/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plate as the formats of masks take it: cells, arrays and lines of text. */
#include "wafer/wafer_parts.h"
#include <math.h>

enum { LINE_PITCH_DBU = 1000000 };

static fw_status plate_of(fw_arena *arena, const fw_wafer *w, fw_mask_plate *plate) {
    fw_mask_plate_cell *cell = fw_arena_array(arena, fw_mask_plate_cell, (size_t)w->ncell);
    fw_mask_plate_place *place = fw_arena_array(arena, fw_mask_plate_place, (size_t)w->nrun);
    FW_NEED(cell);
    FW_NEED(place);
    for (int c = 0; c < w->ncell; c++)
        cell[c] = (fw_mask_plate_cell){w->cell[c].name, w->cell[c].mask};
    for (int i = 0; i < w->nrun; i++) {
        const fw_wafer_run *r = &w->run[i];
        place[i] =
            (fw_mask_plate_place){r->cell, r->x, r->y, r->columns, r->rows, r->step_x, r->step_y};
    }
    /* in the left upper corner, below the fiducial: texts too stay within the plate */
    int32_t half = (int32_t)lround(0.5 * w->form.plate_m * 1e9);
    *plate = (fw_mask_plate){.table = w->table,
                             .top = w->top,
                             .title = w->title,
                             .flow = w->flow,
                             .rejected = w->rejected,
                             .edge_m = w->form.plate_m,
                             .cell = cell,
                             .ncell = w->ncell,
                             .place = place,
                             .nplace = w->nrun,
                             .drawn = w->plate,
                             .note_x = LINE_PITCH_DBU - half,
                             .note_y = half - 12 * LINE_PITCH_DBU,
                             .note_step = -LINE_PITCH_DBU};
    return fw_wafer_notes(arena, w, &plate->note, &plate->nnote);
}

fw_status fw_wafer_write_format(const fw_wafer *w, const fw_mask_format *format, fw_text *out) {
    fw_mask_plate plate;
    FW_TRY(plate_of(out->arena, w, &plate));
    return format->plate(&plate, out);
}

fw_status fw_wafer_write_gds(const fw_wafer *w, fw_text *out) {
    fw_mask_plate plate;
    FW_TRY(plate_of(out->arena, w, &plate));
    return fw_mask_plate_gds(&plate, out);
}
