/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Step and repeat: which dies lie whole in the usable area.

   Place (i, j) has its lower left corner at (o + i p). With a die in the centre o = -w/2, with a
   street o = (p - w)/2, along x and y by themselves; `auto` takes of the four the one with the most
   dies, a die in the centre where several have as many.
   In: die and pitch in dbu, form. Out: places, row by row from the top. Exact: integers only.
   Cost: (2R/p)^2 tests. Test: test_wafer_grid.c, against a search over all corners,
   and 517 dies of 3 mm on 3.5 mm inside 94 mm. */
#include "wafer/wafer.h"
#include <math.h>
#include <stdio.h>

typedef struct stepping {
    const fw_wafer_form *form;
    int64_t w, h, px, py, ox, oy;
} stepping;

static int64_t offset(bool street, int64_t size, int64_t pitch) {
    int64_t twice = street ? pitch - size : -size;
    return twice >= 0 ? twice / 2 : -((1 - twice) / 2);
}

static int64_t reach(const stepping *s, int64_t pitch) {
    return s->form->usable_dbu / pitch + 2;
}

/* counts, and stores where site is not NULL; stops counting above the limit */
static int walk(const stepping *s, fw_wafer_site *site) {
    int n = 0;
    int64_t rows = reach(s, s->py), columns = reach(s, s->px);
    for (int64_t j = rows; j >= -rows; j--)
        for (int64_t i = -columns; i <= columns && n <= FW_WAFER_MOST_DIES; i++) {
            int64_t x = s->ox + i * s->px, y = s->oy + j * s->py;
            if (!fw_wafer_holds(s->form, x, y, x + s->w, y + s->h)) continue;
            if (site)
                site[n] = (fw_wafer_site){
                    .row = (int)-j, .column = (int)i, .x = (int32_t)x, .y = (int32_t)y};
            n++;
        }
    return n;
}

/* the one of die and street in the centre, along both axes, that holds the most */
static int choose(stepping *s, fw_device_wafer_centre centre, bool *street_x, bool *street_y) {
    int most = -1;
    stepping best = *s;
    for (int k = 0; k < 4; k++) {
        bool sx = k & 1, sy = k & 2;
        if (centre == FW_CENTRE_DIE && (sx || sy)) continue;
        if (centre == FW_CENTRE_STREET && !(sx && sy)) continue;
        s->ox = offset(sx, s->w, s->px);
        s->oy = offset(sy, s->h, s->py);
        int n = walk(s, NULL);
        if (n <= most) continue;
        most = n;
        best = *s;
        *street_x = sx;
        *street_y = sy;
    }
    *s = best;
    return most;
}

/* rows and columns from 0 at the top and on the left */
static void number(fw_wafer_grid *g) {
    int top = g->site[0].row, bottom = top, left = g->site[0].column, right = left;
    for (int i = 0; i < g->nsite; i++) {
        const fw_wafer_site *s = &g->site[i];
        top = s->row < top ? s->row : top;
        bottom = s->row > bottom ? s->row : bottom;
        left = s->column < left ? s->column : left;
        right = s->column > right ? s->column : right;
    }
    for (int i = 0; i < g->nsite; i++) {
        g->site[i].row -= top;
        g->site[i].column -= left;
    }
    g->rows = bottom - top + 1;
    g->columns = right - left + 1;
}

static fw_status pitch_of(double asked_m, int32_t size, const char *name, fw_place place,
                          fw_diags *diags, int64_t *pitch) {
    *pitch = isnan(asked_m) ? size : (int64_t)floor(asked_m * 1e9 + 0.5);
    if (*pitch >= size) return FW_OK;
    char have[32], need[32];
    return fw_diag_error(diags, 191, place,
                         "<wafer>: %s is %s um, but the die with its lane is %s um; enlarge it or "
                         "leave it out",
                         name, fw_number_text(have, sizeof have, (double)*pitch * 1e-3, 9),
                         fw_number_text(need, sizeof need, size * 1e-3, 9));
}

fw_status fw_wafer_grid_fill(fw_arena *arena, const fw_wafer_form *form,
                             const fw_device_wafer_asked *asked, int32_t width, int32_t height,
                             fw_diags *diags, fw_wafer_grid *grid) {
    stepping s = {.form = form, .w = width, .h = height};
    FW_TRY(pitch_of(asked->pitch_x_m, width, "pitch-x", asked->place, diags, &s.px));
    FW_TRY(pitch_of(asked->pitch_y_m, height, "pitch-y", asked->place, diags, &s.py));
    *grid = (fw_wafer_grid){
        .width = width, .height = height, .pitch_x = (int32_t)s.px, .pitch_y = (int32_t)s.py};
    int n = s.px > 1000 && s.py > 1000 ? choose(&s, asked->centre, &grid->street_x, &grid->street_y)
                                       : FW_WAFER_MOST_DIES + 1;
    if (n > FW_WAFER_MOST_DIES)
        return fw_diag_error(diags, 190, asked->place,
                             "<wafer>: more than %d dies; enlarge the pitch", FW_WAFER_MOST_DIES);
    if (n == 0)
        return fw_diag_error(diags, 190, asked->place,
                             "<wafer>: no die of %d um by %d um lies whole in the usable area; "
                             "choose a larger wafer or a smaller edge-exclusion",
                             (int)(width / 1000), (int)(height / 1000));
    FW_NEED(grid->site = fw_arena_array(arena, fw_wafer_site, (size_t)n));
    grid->nsite = walk(&s, grid->site);
    number(grid);
    return FW_OK;
}

const char *fw_wafer_row_name(int row, char name[FW_WAFER_NAME]) {
    char *at = name;
    if (row >= 26 * 27) *at++ = (char)('A' + (row / (26 * 26) - 1) % 26);
    if (row >= 26) *at++ = (char)('A' + (row / 26 - 1) % 26);
    *at++ = (char)('A' + row % 26);
    *at = '\0';
    return name;
}

const char *fw_wafer_column_name(const fw_wafer_grid *grid, int column, char name[FW_WAFER_NAME]) {
    snprintf(name, FW_WAFER_NAME, grid->columns > 99 ? "%03d" : "%02d", column + 1);
    return name;
}
