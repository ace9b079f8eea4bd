/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells and arrays. Array steps are whole multiples of the pitch in dbu, so that columns and rows
   divide the corners of an AREF exactly. */
#include "wafer/wafer_parts.h"
#include <string.h>

static bool taken(const fw_wafer *w, const char *name) {
    for (int i = 0; i < w->ncell; i++)
        if (strcmp(w->cell[i].name, name) == 0) return true;
    return w->top && strcmp(w->top, name) == 0;
}

/* a name that no other cell has: readers take the last of two cells of one name, or stop */
static const char *own_name(fw_wafer_maker *m, const char *name) {
    const char *own = name;
    for (int k = 2; own && taken(m->wafer, own); k++)
        own = fw_arena_printf(m->arena, "%.*s_%d", FW_WAFER_LONGEST_NAME - 6, name, k);
    return own;
}

fw_status fw_wafer_add_cell(fw_wafer_maker *m, const char *name, const fw_mask *mask, int32_t dx,
                            int32_t dy, int *cell) {
    fw_wafer *w = m->wafer;
    if (w->ncell == m->cells) {
        int more = m->cells ? 2 * m->cells : 64;
        FW_NEED(w->cell = fw_arena_grow(m->arena, w->cell, (size_t)w->ncell, (size_t)more,
                                        sizeof *w->cell));
        m->cells = more;
    }
    const char *own = own_name(m, name);
    FW_NEED(own);
    *cell = w->ncell;
    w->cell[w->ncell++] = (fw_wafer_cell){.name = own, .mask = mask, .dx = dx, .dy = dy};
    return FW_OK;
}

fw_status fw_wafer_add_run(fw_wafer_maker *m, fw_wafer_run run) {
    fw_wafer *w = m->wafer;
    if (w->nrun == m->runs) {
        int more = m->runs ? 2 * m->runs : 256;
        FW_NEED(w->run =
                    fw_arena_grow(m->arena, w->run, (size_t)w->nrun, (size_t)more, sizeof *w->run));
        m->runs = more;
    }
    w->cell[run.cell].placed += run.columns * run.rows;
    w->run[w->nrun++] = run;
    return FW_OK;
}

/* the longest evenly spaced run from site i on, in its row, of sites with its cell that are not
   done; marks them */
static fw_status add_run_from(fw_wafer_maker *m, const int *cell_of, bool *done, int i, int end) {
    const fw_wafer_grid *g = &m->wafer->grid;
    int n = 1, stride = 0, at = g->site[i].column;
    done[i] = true;
    for (int j = i + 1; j < end; j++) {
        if (done[j] || cell_of[j] != cell_of[i]) continue;
        int step = g->site[j].column - at;
        if (stride == 0) stride = step;
        if (step > stride) break; /* a gap: another run begins there */
        if (step < stride) continue;
        done[j] = true;
        at = g->site[j].column;
        n++;
    }
    const fw_wafer_cell *c = &m->wafer->cell[cell_of[i]];
    return fw_wafer_add_run(m, (fw_wafer_run){.cell = cell_of[i],
                                              .x = g->site[i].x + c->dx,
                                              .y = g->site[i].y + c->dy,
                                              .columns = n,
                                              .rows = 1,
                                              .step_x = (stride ? stride : 1) * g->pitch_x,
                                              .step_y = g->pitch_y});
}

fw_status fw_wafer_add_rows(fw_wafer_maker *m, const int *cell_of) {
    const fw_wafer_grid *g = &m->wafer->grid;
    bool *done = fw_arena_array(m->arena, bool, (size_t)g->nsite);
    FW_NEED(done);
    for (int start = 0, end; start < g->nsite; start = end) {
        for (end = start; end < g->nsite && g->site[end].row == g->site[start].row;)
            end++;
        for (int i = start; i < end; i++)
            if (!done[i] && cell_of[i] >= 0) FW_TRY(add_run_from(m, cell_of, done, i, end));
    }
    return FW_OK;
}
