/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plate as one GDSII library: every different die once, one array per evenly spaced run of
   equal dies, the top cell last. No reader warns: names of at most 32 letters, digits and _, no
   rotation, array corners that divide exactly, dates zero (docs/theory/mask-files.md). */
#include "mask/mask_writers.h"
#include "wafer/wafer_parts.h"
#include <math.h>

enum { LINE_PITCH_DBU = 1000000 };

static size_t expected_bytes(const fw_wafer *w) {
    size_t n = 16384 + 96 * (size_t)w->nrun;
    for (int c = 0; c < w->ncell; c++)
        for (int i = 0; i < w->cell[c].mask->nshape; i++)
            n += 64 + 8 * (size_t)w->cell[c].mask->shape[i].polygon.count;
    return n;
}

/* in the plate's left upper corner, below the fiducial: texts too stay within the plate */
static fw_status notes(const fw_wafer *w, fw_text *out) {
    int k = fw_mask_notes_layer(w->table);
    if (k < 0) return FW_OK;
    const char **line;
    int n;
    FW_TRY(fw_wafer_notes(out->arena, w, &line, &n));
    int32_t half = (int32_t)lround(0.5 * w->form.plate_m * 1e9);
    for (int i = 0; i < n; i++)
        fw_mask_gds_note(
            out, &w->table->layer[k],
            (fw_geometry_point){LINE_PITCH_DBU - half, half - (i + 12) * LINE_PITCH_DBU}, line[i]);
    return FW_OK;
}

fw_status fw_wafer_write_gds(const fw_wafer *w, fw_text *out) {
    fw_text_reserve(out, expected_bytes(w));
    fw_mask_gds_begin(out, w->rejected ? "FLEXWRIGHT_REJECTED" : "FLEXWRIGHT");
    for (int c = 0; c < w->ncell; c++) {
        fw_mask_gds_cell_begin(out, w->cell[c].name);
        fw_mask_gds_shapes(out, w->cell[c].mask);
        fw_mask_gds_cell_end(out);
    }
    fw_mask_gds_cell_begin(out, w->top);
    if (w->plate) fw_mask_gds_shapes(out, w->plate);
    for (int i = 0; i < w->nrun; i++) {
        const fw_wafer_run *r = &w->run[i];
        fw_mask_gds_array(out, w->cell[r->cell].name, (fw_geometry_point){r->x, r->y}, r->columns,
                          r->rows, (fw_geometry_point){r->step_x, r->step_y});
    }
    FW_TRY(notes(w, out));
    fw_mask_gds_cell_end(out);
    fw_mask_gds_end(out);
    return fw_text_end(out);
}
