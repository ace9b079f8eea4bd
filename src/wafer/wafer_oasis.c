/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plate as one OASIS file: the cells and arrays of its GDSII library, and no other. */
#include "mask/mask_writers.h"
#include "wafer/wafer_parts.h"
#include <math.h>

enum { LINE_PITCH_DBU = 1000000 };

fw_status fw_wafer_write_oasis(const fw_wafer *w, fw_text *out) {
    fw_mask_oasis_cell *cell = fw_arena_array(out->arena, fw_mask_oasis_cell, (size_t)w->ncell + 1);
    fw_mask_oasis_place *place = fw_arena_array(out->arena, fw_mask_oasis_place, (size_t)w->nrun);
    FW_NEED(cell);
    FW_NEED(place);
    for (int c = 0; c < w->ncell; c++)
        cell[c] = (fw_mask_oasis_cell){.name = w->cell[c].name, .mask = w->cell[c].mask};
    for (int i = 0; i < w->nrun; i++) {
        const fw_wafer_run *r = &w->run[i];
        place[i] = (fw_mask_oasis_place){.cell = r->cell,
                                         .x = r->x,
                                         .y = r->y,
                                         .columns = r->columns,
                                         .rows = r->rows,
                                         .step_x = r->step_x,
                                         .step_y = r->step_y};
    }
    int64_t half = lround(0.5 * w->form.plate_m * 1e9); /* texts stand where those of GDSII do */
    fw_mask_oasis_cell *top = &cell[w->ncell];
    *top = (fw_mask_oasis_cell){.name = w->top,
                                .mask = w->plate,
                                .place = place,
                                .nplace = w->nrun,
                                .note_x = LINE_PITCH_DBU - half,
                                .note_y = half - 12 * (int64_t)LINE_PITCH_DBU,
                                .note_step = -LINE_PITCH_DBU};
    if (fw_mask_notes_layer(w->table) >= 0)
        FW_TRY(fw_wafer_notes(out->arena, w, &top->note, &top->nnote));
    return fw_mask_oasis_write(w->table, w->rejected, cell, w->ncell + 1, out);
}
