/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The usable area of a wafer.

   Circle of radius R - e about the centre, cut by the primary flat moved inward by e, that is at
   sqrt(R^2 - (L/2)^2) - e from the centre; with a notch instead, without a disc of radius e + 1.25
   mm about the rim at the notch, which holds the notch (depth 1.00 to 1.25 mm, 90 deg) and all that
   is nearer to it than e. In: diameter, chord L, exclusion e, m, on the 1 nm grid. Out: a decision
   per rectangle, exact in 64 bit integers (coordinates below 2^30, squares below 2^61). Secondary
   flats are not looked at: they cut less than 1 mm off the rim, which an exclusion of 3 mm covers.
   Source of sizes: SEMI M1, specifications for polished single crystal silicon wafers (flat 15.88,
   22.22, 32.5, 42.5, 57.5 mm at 50.8, 76.2, 100, 125, 150 mm; notch at 200 and 300 mm).
   Cost: constant. Test: test_wafer_grid.c. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "wafer/wafer.h"
#include <math.h>
#include <stdio.h>

static const struct {
    double diameter_m, flat_m;
} semi[] = {{50.8e-3, 15.88e-3}, {76.2e-3, 22.22e-3}, {100e-3, 32.5e-3}, {125e-3, 42.5e-3},
            {150e-3, 57.5e-3},   {200e-3, 0},         {300e-3, 0}};
/* 4 in for a wafer of 100 mm is 1.6 % off */
static const double NEAR = 0.02, NOTCH_M = 1.25e-3;
static const double plate_in[] = {3, 4, 5, 6, 7, 9, 14};
static const double INCH_M = 25.4e-3, PLATE_RIM_M = 10e-3, LARGEST_PLATE_M = 0.4;

int64_t fw_wafer_dbu(double m) {
    return (int64_t)floor(m * 1e9 + 0.5);
}

static fw_status refuse(const fw_device_wafer_asked *asked, fw_diags *diags, const char *what,
                        double m, const char *advice) {
    char number[32];
    return fw_diag_error(diags, 190, asked->place, "<wafer>: %s is %s mm; %s", what,
                         fw_number_text(number, sizeof number, m * 1e3, 6), advice);
}

/* smallest usual plate that leaves room for title and fiducials */
static double plate_for(double diameter_m) {
    for (size_t i = 0; i < sizeof plate_in / sizeof plate_in[0]; i++)
        if (plate_in[i] * INCH_M >= diameter_m + 2 * PLATE_RIM_M) return plate_in[i] * INCH_M;
    return diameter_m + 2 * PLATE_RIM_M;
}

fw_status fw_wafer_form_single(const fw_device_wafer_asked *asked, double across_m, fw_diags *diags,
                               fw_wafer_form *form) {
    double own = plate_for(across_m), stated = asked->order.size_m;
    char is[32], need[32];
    *form = (fw_wafer_form){.diameter_m = across_m, .plate_m = stated > 0 ? stated : own};
    if (form->plate_m >= across_m + 2 * PLATE_RIM_M && form->plate_m <= LARGEST_PLATE_M)
        return FW_OK;
    return fw_diag_error(
        diags, 551, asked->order.place,
        "<order>: the die is %s mm across as it is written, and needs a plate of %s mm, that is "
        "10 mm on either side for crosses and title, at most %s mm; the plate is %s mm: change "
        "size or scale",
        fw_number_text(is, sizeof is, across_m * 1e3, 4),
        fw_number_text(need, sizeof need, (across_m + 2 * PLATE_RIM_M) * 1e3, 4), "400",
        fw_number_text((char[32]){0}, 32, form->plate_m * 1e3, 4));
}

fw_status fw_wafer_form_of(const fw_device_wafer_asked *asked, fw_diags *diags,
                           fw_wafer_form *form) {
    int known = -1;
    for (size_t i = 0; i < sizeof semi / sizeof semi[0]; i++)
        if (fabs(asked->diameter_m - semi[i].diameter_m) <= NEAR * semi[i].diameter_m)
            known = (int)i;
    double d = known >= 0 ? semi[known].diameter_m : asked->diameter_m;
    double flat = !isnan(asked->flat_m) ? asked->flat_m
                  : known >= 0          ? semi[known].flat_m
                                        : (double)NAN;
    if (isnan(flat))
        return refuse(asked, diags, "diameter", d,
                      "SEMI M1 has no such wafer, so state flat (0: none) as well");
    bool notched = isnan(asked->flat_m) && semi[known].flat_m == 0;
    double plate = !isnan(asked->plate_m)    ? asked->plate_m
                   : asked->order.size_m > 0 ? asked->order.size_m
                                             : plate_for(d);
    if (!(flat < d))
        return refuse(asked, diags, "flat", flat, "no chord is as long as the diameter");
    if (!(plate >= d + PLATE_RIM_M))
        return refuse(asked, diags, "plate", plate,
                      "it must be 10 mm larger than the wafer, which lies in its middle");
    double chord = sqrt(0.25 * d * d - 0.25 * flat * flat), usable = 0.5 * d - asked->edge_m;
    if (!(usable > 0) || !(chord - asked->edge_m > 0))
        return refuse(asked, diags, "edge-exclusion", asked->edge_m,
                      "nothing is left of the wafer");
    *form = (fw_wafer_form){.diameter_m = d,
                            .flat_m = flat,
                            .notch_m = notched ? NOTCH_M : 0,
                            .edge_m = asked->edge_m,
                            .side = asked->side,
                            .usable_dbu = fw_wafer_dbu(usable),
                            .flat_dbu = fw_wafer_dbu(flat > 0 ? chord - asked->edge_m : usable),
                            .notch_dbu = notched ? fw_wafer_dbu(0.5 * d) : 0,
                            .avoid_dbu = notched ? fw_wafer_dbu(NOTCH_M + asked->edge_m) : 0,
                            .plate_m = plate};
    return FW_OK;
}

static int64_t larger(int64_t a, int64_t b) {
    return a > b ? a : b;
}

static int64_t distance(int64_t from, int64_t low, int64_t high) {
    return from < low ? low - from : from > high ? from - high : 0;
}

bool fw_wafer_holds(const fw_wafer_form *f, int64_t x0, int64_t y0, int64_t x1, int64_t y1) {
    int64_t far_x = larger(-x0, x1), far_y = larger(-y0, y1);
    if (far_x < 0 || far_y < 0 || far_x > f->usable_dbu || far_y > f->usable_dbu) return false;
    if (far_x * far_x + far_y * far_y > f->usable_dbu * f->usable_dbu) return false;
    int64_t toward = f->side == FW_SIDE_BOTTOM ? -y0
                     : f->side == FW_SIDE_TOP  ? y1
                     : f->side == FW_SIDE_LEFT ? -x0
                                               : x1;
    if (toward > f->flat_dbu) return false;
    if (f->notch_dbu == 0) return true;
    int64_t sign = f->side == FW_SIDE_BOTTOM || f->side == FW_SIDE_LEFT ? -1 : 1;
    bool upright = f->side == FW_SIDE_BOTTOM || f->side == FW_SIDE_TOP;
    int64_t dx = distance(upright ? 0 : sign * f->notch_dbu, x0, x1);
    int64_t dy = distance(upright ? sign * f->notch_dbu : 0, y0, y1);
    return dx * dx + dy * dy >= f->avoid_dbu * f->avoid_dbu;
}

/* Step and repeat: which dies lie whole in the usable area.

   Place (i, j) has its lower left corner at (o + i p). With a die in the centre o = -w/2, with a
   street o = (p - w)/2, along x and y by themselves; `auto` takes of the four the one with the most
   dies, a die in the centre where several have as many.
   In: die and pitch in dbu, form. Out: places, row by row from the top. Exact: integers only.
   Cost: (2R/p)^2 tests. Test: test_wafer_grid.c, against a search over all corners,
   and 517 dies of 3 mm on 3.5 mm inside 94 mm. */

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
    *pitch = isnan(asked_m) ? size : fw_wafer_dbu(asked_m);
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

void fw_wafer_origin(const fw_wafer_grid *grid, fw_geometry_box die, int32_t *dx, int32_t *dy) {
    double width = grid->width * 1e-9, height = grid->height * 1e-9;
    *dx = (int32_t)floor((0.5 * (width - (die.x1 - die.x0)) - die.x0) * 1e9 + 0.5);
    *dy = (int32_t)floor((0.5 * (height - (die.y1 - die.y0)) - die.y0) * 1e9 + 0.5);
}

/* Which place is what. All rules are fixed, so that the same description gives the same wafer:

   alignment  the first and the last die of the row whose middle is nearest to the centre (of two
              the upper one): as far apart as can be, for the least turn per misplaced micrometre
   test dies  the free die nearest to each of nine points: the centre, then at 0.6 of the usable
              radius east, west, north, south and between them
   sweeps     blocks: step = floor(c n / C) of column c of C. In turn: step = c mod n; a single
   sweep is shifted by one from row to row, step = (c + r) mod n, so that every step stands in every
   part of the wafer and a gradient across it does not look like the parameter. A second sweep goes
   by rows in the same way. */

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
                        "<wafer>: the middle row has %d dies, too few to give two to alignment, so "
                        "that the plate has no alignment sites; make the pitch smaller",
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
                        "<wafer>: %d test dies are asked for, but only %d dies are left and one of "
                        "them stays a device; the wafer gets %d",
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

/* ---- what lies over the wafer ----
   A plate is larger than its wafer: what it draws beyond the rim is on no wafer. The part of a polygon over the disc less
   the segment of its flat: the polygon cut along the flat, and of each of its edges the triangle with the centre as far as
   the disc has it, a triangle inside and sectors outside. Exact for any simple polygon; the notch, some mm2, is not looked
   at. In: dbu of the plate as it is drawn. Out: m2. Cost: linear in its edges. Test: test_wafer_grid.c. */

/* from the centre to the chord of the flat, and the way there */
static double flat_away_m(const fw_wafer_form *form, fw_geometry_vec2 *way) {
    const double R = 0.5 * form->diameter_m, half = fmin(0.5 * form->flat_m, R);
    switch (form->side) {
    case FW_SIDE_BOTTOM:
        *way = (fw_geometry_vec2){0, -1};
        break;
    case FW_SIDE_TOP:
        *way = (fw_geometry_vec2){0, 1};
        break;
    case FW_SIDE_LEFT:
        *way = (fw_geometry_vec2){-1, 0};
        break;
    case FW_SIDE_RIGHT:
        *way = (fw_geometry_vec2){1, 0};
        break;
    }
    return sqrt(R * R - half * half);
}

double fw_wafer_area(const fw_wafer_form *form) {
    fw_geometry_vec2 way;
    if (!(form->diameter_m > 0.0)) return 0.0;
    const double R = 0.5 * form->diameter_m, h = flat_away_m(form, &way);
    return FW_PI * R * R - (R * R * acos(h / R) - h * sqrt(R * R - h * h));
}

/* the triangle of the centre and an edge, within the disc, > 0 counter-clockwise */
static double within_disc(fw_geometry_vec2 a, fw_geometry_vec2 b, double R) {
    const fw_geometry_vec2 d = vec_sub(b, a);
    const double A = vec_dot(d, d), B = vec_dot(a, d), square = B * B - A * (vec_dot(a, a) - R * R);
    if (!(A > 0)) return 0;
    if (!(square > 0)) return 0.5 * R * R * fw_geometry_vec_angle(a, b);
    const double root = sqrt(square), in = fmin(fmax((-B - root) / A, 0), 1),
                 out = fmin(fmax((-B + root) / A, 0), 1);
    const fw_geometry_vec2 p = vec_along(a, in, d), q = vec_along(a, out, d);
    double area = 0.5 * vec_cross(p, q);
    if (in > 0) area += 0.5 * R * R * fw_geometry_vec_angle(a, p);
    if (out < 1) area += 0.5 * R * R * fw_geometry_vec_angle(q, b);
    return area;
}

typedef struct outline_cut { /* the vertices that the flat leaves, one behind the other */
    double R, area;
    fw_geometry_vec2 first, last;
    bool any;
} outline_cut;

static void next_vertex(outline_cut *c, fw_geometry_vec2 at) {
    if (c->any)
        c->area += within_disc(c->last, at, c->R);
    else
        c->first = at;
    c->any = true, c->last = at;
}

double fw_wafer_area_over(const fw_wafer_form *form, const fw_geometry_polygon *polygon) {
    fw_geometry_vec2 way = {0, 0};
    outline_cut c = {.R = 0.5 * form->diameter_m};
    const double away = flat_away_m(form, &way);
    for (int i = 0; i < polygon->count; i++) {
        const fw_geometry_point *v = &polygon->vertex[i],
                                *w = &polygon->vertex[(i + 1) % polygon->count];
        const fw_geometry_vec2 a = {1e-9 * v->x_dbu, 1e-9 * v->y_dbu},
                               b = {1e-9 * w->x_dbu, 1e-9 * w->y_dbu};
        const double out_a = vec_dot(a, way) - away, out_b = vec_dot(b, way) - away;
        if (out_a <= 0) next_vertex(&c, a);
        if ((out_a < 0 && out_b > 0) || (out_a > 0 && out_b < 0))
            next_vertex(&c, vec_along(a, out_a / (out_a - out_b), vec_sub(b, a)));
    }
    return c.any ? c.area + within_disc(c.last, c.first, c.R) : 0;
}
