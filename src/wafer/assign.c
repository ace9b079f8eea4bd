/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which place is what. All rules are fixed, so that the same description gives the same wafer:

   alignment  the first and the last die of the row whose middle is nearest to the centre (of two
              the upper one): as far apart as can be, for the least turn per misplaced micrometre
   test dies  the free die nearest to each of nine points: the centre, then at 0.6 of the usable
              radius east, west, north, south and between them
   sweeps     blocks: step = floor(c n / C) of column c of C. In turn: step = c mod n; a single
   sweep is shifted by one from row to row, step = (c + r) mod n, so that every step stands in every
   part of the wafer and a gradient across it does not look like the parameter. A second sweep goes
   by rows in the same way. */
#include "wafer/wafer.h"
#include <math.h>

static int64_t twice_middle_y(const fw_wafer_grid *g, const fw_wafer_site *s) {
    return 2 * (int64_t)s->y + g->height;
}

static int64_t size_of(int64_t v) {
    return v < 0 ? -v : v;
}

static void align(const fw_device_wafer_asked *asked, fw_diags *diags, fw_wafer_grid *g) {
    int row = g->site[0].row, first = -1, last = -1;
    int64_t least = INT64_MAX;
    for (int i = 0; i < g->nsite; i++) /* from the top: of two rows as near the upper one */
        if (size_of(twice_middle_y(g, &g->site[i])) < least) {
            least = size_of(twice_middle_y(g, &g->site[i]));
            row = g->site[i].row;
        }
    for (int i = 0; i < g->nsite; i++)
        if (g->site[i].row == row) {
            if (first < 0) first = i;
            last = i;
        }
    if (last - first < 2) {
        fw_diag_warning(diags, 192, asked->place,
                        "<wafer>: the middle row has %d dies, too few to give two to alignment",
                        last - first + 1);
        return;
    }
    g->site[first].kind = g->site[last].kind = FW_WAFER_ALIGNMENT;
}

static const double towards[][2] = {{0, 0},
                                    {1, 0},
                                    {-1, 0},
                                    {0, 1},
                                    {0, -1},
                                    {0.7071, 0.7071},
                                    {-0.7071, -0.7071},
                                    {-0.7071, 0.7071},
                                    {0.7071, -0.7071}};

/* of the dies that are left; -1: none */
static int nearest(const fw_wafer_grid *g, double x, double y) {
    int best = -1;
    double least = HUGE_VAL;
    for (int i = 0; i < g->nsite; i++) {
        if (g->site[i].kind != FW_WAFER_DIE) continue;
        double dx = g->site[i].x + 0.5 * g->width - x, dy = g->site[i].y + 0.5 * g->height - y;
        if (dx * dx + dy * dy < least) {
            least = dx * dx + dy * dy;
            best = i;
        }
    }
    return best;
}

static void give_tests(const fw_wafer_form *form, const fw_device_wafer_asked *asked,
                       fw_diags *diags, fw_wafer_grid *g) {
    double far = 0.6 * (double)form->usable_dbu;
    int left = 0;
    for (int i = 0; i < g->nsite; i++)
        left += g->site[i].kind == FW_WAFER_DIE;
    int given = asked->tests < left ? asked->tests : left - 1;
    for (int k = 0; k < given; k++) {
        int i = nearest(g, far * towards[k][0], far * towards[k][1]);
        if (i >= 0) g->site[i].kind = FW_WAFER_TEST;
    }
    if (given < asked->tests)
        fw_diag_warning(diags, 192, asked->place,
                        "<wafer>: %d test dies are asked for, and there are %d dies; %d are given",
                        asked->tests, left, given);
}

static int step(bool blocks, int at, int of, int steps) {
    return blocks ? (int)((int64_t)at * steps / of) : at % steps;
}

fw_status fw_wafer_assign(const fw_wafer_form *form, const fw_device_wafer_asked *asked,
                          fw_diags *diags, fw_wafer_grid *g) {
    if (asked->alignment) align(asked, diags, g);
    if (asked->tests > 0) give_tests(form, asked, diags, g);
    int n0 = asked->nsweep > 0 ? asked->sweep[0].steps : 1;
    int n1 = asked->nsweep > 1 ? asked->sweep[1].steps : 1;
    bool shifted = !asked->blocks && asked->nsweep == 1;
    for (int i = 0; i < g->nsite; i++) {
        fw_wafer_site *s = &g->site[i];
        int s0 = step(asked->blocks, s->column + (shifted ? s->row : 0), g->columns, n0);
        int s1 = step(asked->blocks, s->row, g->rows, n1);
        s->variant = s->kind == FW_WAFER_DIE ? s0 + n0 * s1 : -1;
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_wafer_dies(fw_arena *arena, const fw_device_wafer_asked *asked, fw_geometry_box die,
                        int *dies) {
    fw_diags silent = fw_diags_new(arena); /* the wafer says it when it is laid out */
    fw_wafer_form form;
    fw_wafer_grid grid;
    int32_t width = (int32_t)ceil((die.x1 - die.x0) * 1e9 - 1e-3);
    int32_t height = (int32_t)ceil((die.y1 - die.y0) * 1e9 - 1e-3);
    *dies = 0;
    fw_status status = fw_wafer_form_of(asked, &silent, &form);
    if (status == FW_OK)
        status = fw_wafer_grid_fill(arena, &form, asked, width, height, &silent, &grid);
    if (status == FW_OK) status = fw_wafer_assign(&form, asked, &silent, &grid);
    if (silent.failed) return FW_NOMEM;
    if (status != FW_OK) return status == FW_INPUT ? FW_OK : status;
    for (int i = 0; i < grid.nsite; i++)
        *dies += grid.site[i].kind == FW_WAFER_DIE;
    return FW_OK;
}
