/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tracks: from the pad of every stator through the frame to the edge of the chip, where pad="edge" of its
   drive asks for one.

   A track is TRACK_M wide and runs along x and y on a grid of STEP_M about the middle of its pad; a cell is free
   where its middle keeps half of a track and `space` from all outlines but the stator's own and from the hinges' discs
   (FREE_M, else LEAST_M). The shortest way by a search over cells, a turn as long as TURN of them, to the window's
   left or right; from there straight through the frame, whose upright is cut LEAST_M beside it, to a pad at the
   chip's outer edge. The upper and the lower bar have lettering and are not cut. A track is part of its stator's
   outline: it stands on the carrier, takes the bias and is judged with it.

   In: a drawing with bodies, stators, bases and tethers. Out: longer outlines of the stators, and d->track, by
   which the frame is cut. Refuses with the pad's place (FW-D440). Cost: cells of the window for each drive.
   Theory: docs/theory/wiring.md, section 3. Test: test_layout_track.c */
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

static const double TRACK_M = 40e-6, STEP_M = 10e-6; /* as wide as a lead (comb.c) */
static const double FREE_M = 60e-6, LEAST_M = 20e-6; /* as leads keep them */
static const double PAD_M = 150e-6;                  /* side of a pad at the edge */
static const double STEP_MOST_M = 60e-6; /* that is, windows beyond 38 mm square get no tracks */
static const double CELLS_MOST = 4e5;    /* of a search; in larger windows they are larger */
enum { TURN = 6, WAYS = 4 };

typedef struct field {
    fw_layout_drawing *d;
    fw_geometry_vec2 from; /* middle of cell (0, 0) */
    double step; /* from cell to cell: a band of half a track and LEAST_M is wider than that */
    int columns, rows;
    int rim; /* cells along the frame: none above and below, and only straight across left and right */
    unsigned char *blocked; /* 1: by others, 2: by the own stator */
} field;

typedef struct way { /* cells where it turns, from the pad on */
    int *column, *row;
    int n;
    bool right;
    double y;
} way;

static fw_geometry_vec2 middle_of(const field *f, int column, int row) {
    return fw_v(f->from.x + column * f->step, f->from.y + row * f->step);
}

/* ---- what is in the way ---- */

static void block_segment(field *f, const fw_geometry_segment *s, double reach, unsigned char by) {
    fw_geometry_box b = fw_segment_box(s);
    int x0 = (int)ceil((b.x0 - reach - f->from.x) / f->step),
        x1 = (int)floor((b.x1 + reach - f->from.x) / f->step),
        y0 = (int)ceil((b.y0 - reach - f->from.y) / f->step),
        y1 = (int)floor((b.y1 + reach - f->from.y) / f->step);
    for (int y = y0 < 0 ? 0 : y0; y <= y1 && y < f->rows; y++)
        for (int x = x0 < 0 ? 0 : x0; x <= x1 && x < f->columns; x++) {
            double t;
            fw_geometry_vec2 on;
            unsigned char *cell = &f->blocked[(size_t)y * (size_t)f->columns + (size_t)x];
            if (!(*cell & by) &&
                fw_geometry_segment_nearest(s, middle_of(f, x, y), &t, &on) < reach)
                *cell |= by;
        }
}

/* The border is enough: nothing steps over a band that is wider than a cell. */
static void block(field *f, const fw_geometry_contour *c, double reach, unsigned char by) {
    for (int i = 0; i < c->count; i++)
        block_segment(f, &c->segment[i], reach, by);
}

static void block_disc(field *f, fw_geometry_vec2 at, double radius) {
    fw_geometry_segment point = {
        .kind = FW_LINE, .a = at, .b = fw_v(at.x + 1e-9, at.y)}; /* a disc about a point */
    block_segment(f, &point, radius, 1);
}

static fw_status block_all(field *f, int own, double space) {
    fw_layout_drawing *d = f->d;
    double half = 0.5 * TRACK_M, reach = half + space;
    for (int s = 0; s < d->nslot; s++)
        block(f, fw_layout_drawing_outline(d, s), reach, 1);
    for (int j = 0; j < d->device->nrevolute; j++)
        block_disc(f, d->layout->hinge[j].centre, d->layout->hinge[j].keep_out_m + half + LEAST_M);
    for (int i = 0; i < d->nattachment; i++)
        block(f, &d->attachment[i].tether, half + LEAST_M, 1);
    for (int i = 0; i < d->neyelet; i++)
        if (!d->eyelet[i].off)
            block_disc(f, d->eyelet[i].at,
                       0.5 * d->eyelet[i].hole_m + d->eyelet[i].ring_m + half + LEAST_M);
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off) block(f, &d->comb[i].stator, half + LEAST_M, i == own ? 2 : 1);
    return FW_OK;
}

static bool is_free(const field *f, int x, int y, unsigned char by) {
    if (x < 0 || y < 0 || x >= f->columns || y >= f->rows) return false;
    return !(f->blocked[(size_t)y * (size_t)f->columns + (size_t)x] & by);
}

/* may the upright be cut about this height? */
static bool may_cross(const fw_layout_drawing *d, bool right, double y) {
    const fw_geometry_box *w = &d->layout->window;
    double half = 0.5 * PAD_M + LEAST_M, clear = fw_layout_rule.frame_cut_clear_m;
    fw_layout_window_side side = right ? FW_RIGHT : FW_LEFT;
    if (y - half < w->y0 + clear || y + half > w->y1 - clear) return false;
    for (int i = 0; i < d->nattachment; i++) {
        const fw_layout_attachment *a = &d->attachment[i];
        if (a->side == side && y + half + clear > a->low_m && y - half - clear < a->high_m)
            return false;
    }
    for (int i = 0; i < d->neyelet; i++) {
        const fw_layout_eyelet_plan *e = &d->eyelet[i];
        double ring = 0.5 * e->hole_m + e->ring_m + clear;
        double edge = right ? w->x1 : w->x0;
        if (!e->off && fabs(e->at.x - edge) < 500e-6 && fabs(e->at.y - y) < half + ring)
            return false;
    }
    for (int i = 0; i < d->ntrack; i++)
        if (d->track[i].right == right && fabs(d->track[i].y_m - y) < 2.0 * half + clear)
            return false;
    /* the cut between the halves needs a place of its own: half of an upright is enough */
    double middle = 0.5 * (w->y0 + w->y1);
    return fabs(y - middle) > half + 2.0 * clear;
}

/* ---- the search ---- */

static const int step_x[WAYS] = {1, 0, -1, 0}, step_y[WAYS] = {0, 1, 0, -1};

typedef struct search {
    int *cost, *before; /* (cells x WAYS) of arriving in a direction; cost -1: not seen */
    int *queue[TURN + 2];
    int nqueue[TURN + 2], room[TURN + 2];
    int best;
} search;

static fw_status offer(fw_layout_drawing *d, search *s, int state, int cost, int before) {
    if (s->cost[state] >= 0 && s->cost[state] <= cost) return FW_OK;
    int k = cost % (TURN + 2);
    s->cost[state] = cost;
    s->before[state] = before;
    if (s->nqueue[k] == s->room[k]) {
        int more = s->room[k] ? 2 * s->room[k] : 1024;
        FW_NEED(s->queue[k] = fw_arena_grow(d->arena, s->queue[k], (size_t)s->room[k], (size_t)more,
                                            sizeof(int)));
        s->room[k] = more;
    }
    s->queue[k][s->nqueue[k]++] = state;
    return FW_OK;
}

/* straight out of the pad in every direction that others leave free, to the first cell that its own outline does,
   too */
static fw_status leave_pad(field *f, search *s, const fw_geometry_contour *own, int column,
                           int row) {
    for (int k = 0; k < WAYS; k++)
        for (int n = 1;; n++) {
            int x = column + n * step_x[k], y = row + n * step_y[k];
            if (!is_free(f, x, y, 1)) break;
            if (!is_free(f, x, y, 3) || fw_geometry_contour_contains(own, middle_of(f, x, y)))
                continue;
            FW_TRY(offer(f->d, s, (y * f->columns + x) * WAYS + k, 0, -1));
            break;
        }
    return FW_OK;
}

/* from a cell straight to the window's edge, and through it */
static bool leaves_window(const field *f, int x, int y, int way_of) {
    if (step_x[way_of] == 0) return false;
    bool right = step_x[way_of] > 0;
    for (int u = x; u >= 0 && u < f->columns; u += step_x[way_of])
        if (!is_free(f, u, y, 3)) return false;
    return may_cross(f->d, right, middle_of(f, x, y).y);
}

static fw_status look(field *f, search *s, const fw_geometry_contour *own, int column, int row) {
    FW_TRY(leave_pad(f, s, own, column, row));
    s->best = -1;
    for (int cost = 0, empty = 0; empty < TURN + 2; cost++) {
        int k = cost % (TURN + 2);
        empty = s->nqueue[k] ? 0 : empty + 1;
        for (int i = 0; i < s->nqueue[k]; i++) {
            int state = s->queue[k][i], way_of = state % WAYS, cell = state / WAYS;
            int x = cell % f->columns, y = cell / f->columns;
            if (s->cost[state] != cost) continue;
            bool edge = x == 0 || x == f->columns - 1;
            if (edge && leaves_window(f, x, y, way_of)) {
                s->best = state;
                return FW_OK;
            }
            for (int turn = 0; turn < WAYS; turn++) {
                int u = x + step_x[turn], v = y + step_y[turn];
                bool along = step_x[turn] == 0 && (u < f->rim || u >= f->columns - f->rim);
                if ((turn + 2) % WAYS == way_of || along || !is_free(f, u, v, 3)) continue;
                int dearer = cost + (turn == way_of ? 1 : 1 + TURN - 1);
                FW_TRY(offer(f->d, s, (v * f->columns + u) * WAYS + turn, dearer, state));
            }
        }
        s->nqueue[k] = 0;
    }
    return FW_OK;
}

/* ---- drawing it ---- */

static fw_status unite(fw_arena *arena, fw_geometry_contour *whole, fw_geometry_contour part,
                       bool *good) {
    fw_geometry_region a = {whole, 1}, b = {&part, 1}, both;
    fw_status status = fw_geometry_region_boolean(arena, &a, &b, FW_UNION, &both);
    *good = status == FW_OK && both.count == 1;
    if (*good) *whole = both.contour[0];
    return status == FW_GEOMETRY ? FW_OK : status;
}

/* bars between turns, each half a track longer at its ends, and the pad at the edge of the chip */
static fw_status draw_way(fw_layout_drawing *d, fw_layout_comb_plan *p,
                          const fw_geometry_vec2 *corner, int n, fw_geometry_box pad, bool *good) {
    fw_geometry_contour whole = p->stator, part, round;
    fw_geometry_vec2 where;
    *good = true;
    for (int i = 0; i + 1 < n && *good; i++) {
        fw_geometry_vec2 a = corner[i], b = corner[i + 1];
        double half = i + 2 < n ? 0.5 * TRACK_M : 0.0;
        fw_geometry_box bar = {fmin(a.x, b.x), fmin(a.y, b.y), fmax(a.x, b.x), fmax(a.y, b.y)};
        bool along = fabs(b.x - a.x) > fabs(b.y - a.y);
        bar.x0 -= along ? (b.x < a.x ? half : 0.0) : 0.5 * TRACK_M;
        bar.x1 += along ? (b.x > a.x ? half : 0.0) : 0.5 * TRACK_M;
        bar.y0 -= !along ? (b.y < a.y ? half : 0.0) : 0.5 * TRACK_M;
        bar.y1 += !along ? (b.y > a.y ? half : 0.0) : 0.5 * TRACK_M;
        double *side[] = {&bar.x0, &bar.y0, &bar.x1, &bar.y1};
        for (int k = 0; k < 4; k++)
            *side[k] = fw_layout_to_grid(*side[k]);
        FW_TRY(fw_geometry_contour_rectangle(d->arena, bar, &part));
        FW_TRY(unite(d->arena, &whole, part, good));
    }
    if (!*good) return FW_OK;
    FW_TRY(fw_geometry_contour_rectangle(d->arena, pad, &part));
    FW_TRY(unite(d->arena, &whole, part, good));
    if (!*good) return FW_OK;
    fw_status status = fw_geometry_contour_round(d->arena, &whole, fw_layout_rule.corner_m,
                                                 fw_layout_rule.corner_m, &round, &where);
    *good = status == FW_OK;
    if (*good) p->stator = round;
    return status == FW_GEOMETRY ? FW_OK : status;
}

static fw_status follow(field *f, fw_layout_comb_plan *p, const search *s, fw_geometry_vec2 pad,
                        bool *good) {
    fw_layout_drawing *d = f->d;
    int n = 2, last = -1;
    for (int state = s->best; state >= 0; state = s->before[state]) {
        n += state % WAYS != last;
        last = state % WAYS;
    }
    fw_geometry_vec2 *corner = fw_arena_array(d->arena, fw_geometry_vec2, (size_t)n);
    FW_NEED(corner);
    int k = n, way_of = s->best % WAYS, cell = s->best / WAYS;
    bool right = step_x[way_of] > 0;
    const fw_geometry_box *die = &d->layout->die, *w = &d->layout->window;
    fw_geometry_box out = {die->x0 + d->lane_m, die->y0 + d->lane_m, die->x1 - d->lane_m,
                           die->y1 - d->lane_m};
    double y = middle_of(f, 0, cell / f->columns).y, bar = right ? out.x1 - w->x1 : w->x0 - out.x0;
    double deep = fw_layout_to_grid(fmin(PAD_M, bar));
    corner[--k] = fw_v(right ? out.x1 - 0.5 * deep : out.x0 + 0.5 * deep, y);
    for (int state = s->best; s->before[state] >= 0; state = s->before[state]) {
        int before = s->before[state];
        if (before % WAYS == state % WAYS) continue;
        corner[--k] = middle_of(f, before / WAYS % f->columns, before / WAYS / f->columns);
    }
    corner[--k] = pad;
    fw_geometry_box end = {right ? out.x1 - deep : out.x0, y - 0.5 * PAD_M,
                           right ? out.x1 : out.x0 + deep, y + 0.5 * PAD_M};
    end.x0 = fw_layout_to_grid(end.x0), end.x1 = fw_layout_to_grid(end.x1);
    end.y0 = fw_layout_to_grid(end.y0), end.y1 = fw_layout_to_grid(end.y1);
    FW_TRY(draw_way(d, p, corner + k, n - k, end, good));
    if (!*good) return FW_OK;
    p->routed = true;
    p->edge_pad = end;
    d->track[d->ntrack++] = (fw_layout_track){
        .right = right, .y_m = fw_layout_to_grid(y), .half_m = 0.5 * PAD_M + LEAST_M};
    return FW_OK;
}

static fw_status try_track(fw_layout_drawing *d, int own, double space, bool *good) {
    const fw_geometry_box *w = &d->layout->window;
    fw_layout_comb_plan *p = &d->comb[own];
    double area = (w->x1 - w->x0) * (w->y1 - w->y0);
    field f = {.d = d, .step = STEP_M * fmax(1.0, ceil(sqrt(area / CELLS_MOST) / STEP_M))};
    fw_geometry_vec2 pad = p->pad_at;
    int column = (int)floor((pad.x - w->x0) / f.step), row = (int)floor((pad.y - w->y0) / f.step);
    *good = false;
    f.from = fw_v(pad.x - column * f.step, pad.y - row * f.step);
    f.columns = column + (int)floor((w->x1 - pad.x) / f.step) + 1;
    f.rows = row + (int)floor((w->y1 - pad.y) / f.step) + 1;
    fw_mark mark = fw_arena_mark(d->arena);
    size_t cells = (size_t)f.columns * (size_t)f.rows;
    search s = {.best = -1};
    if (f.step > STEP_MOST_M) return FW_OK;
    FW_NEED(f.blocked = fw_arena_array(d->arena, unsigned char, cells));
    FW_NEED(s.cost = fw_arena_array(d->arena, int, cells *WAYS));
    FW_NEED(s.before = fw_arena_array(d->arena, int, cells *WAYS));
    for (size_t i = 0; i < cells * WAYS; i++)
        s.cost[i] = -1;
    FW_TRY(block_all(&f, own, space));
    f.rim = (int)ceil((0.5 * TRACK_M + LEAST_M) / f.step);
    for (int y = 0; y < f.rows; y++)
        for (int x = 0; x < f.columns && (y < f.rim || y >= f.rows - f.rim); x++)
            f.blocked[(size_t)y * (size_t)f.columns + (size_t)x] |= 1;
    FW_TRY(look(&f, &s, &p->stator, column, row));
    if (s.best >= 0) FW_TRY(follow(&f, p, &s, pad, good));
    if (!*good) fw_arena_rewind(d->arena, mark);
    return FW_OK;
}

static fw_status refuse(fw_layout_drawing *d, const fw_layout_comb_plan *p) {
    char x[32], y[32];
    fw_layout_fault fault = fw_layout_fault_at(p->pad_at);
    fault.body[fault.nbody++] = FW_ISLAND;
    fw_diag_error(
        d->diags, 440, p->comb->place,
        "no way leads from the pad of %s%s at (%s, %s) um to the chip's edge: a track of "
        "40 um with 20 um on either side has to reach the left or the right bar of the frame, and "
        "190 um of it that nothing else holds on to. Moving parts, hinges and the base shut the "
        "pad in, or are too near: move the drive, give the die more clearance, or say "
        "pad=\"probed\"",
        FW_NAMED("comb drive", fw_text_name(p->comb->id)), fw_layout_um(x, p->pad_at.x),
        fw_layout_um(y, p->pad_at.y));
    FW_TRY(fw_layout_fault_keep(d, fault));
    return FW_GEOMETRY;
}

fw_status fw_layout_tracks_route(fw_layout_drawing *d) {
    d->ntrack = 0;
    if (d->ncomb == 0) return FW_OK;
    FW_NEED(d->track = fw_arena_array(d->arena, fw_layout_track, (size_t)d->ncomb));
    for (int i = 0; i < d->ncomb; i++) {
        bool good = d->comb[i].off || !d->comb[i].at_edge;
        FW_TRY(good ? FW_OK : try_track(d, i, FREE_M, &good));
        FW_TRY(good ? FW_OK : try_track(d, i, LEAST_M, &good));
        if (!good) return refuse(d, &d->comb[i]);
    }
    return FW_OK;
}

/* ---- the frame ---- */

/* a half of the frame without what the tracks need: its parts, with all their cuts */
fw_status fw_layout_tracks_cut(fw_layout_drawing *d, const fw_geometry_contour *half,
                               fw_geometry_region *parts) {
    const fw_geometry_box *die = &d->layout->die, *w = &d->layout->window;
    fw_geometry_box box = fw_geometry_contour_box(half);
    FW_NEED(parts->contour = fw_arena_array(d->arena, fw_geometry_contour, 1));
    parts->contour[0] = *half;
    parts->count = 1;
    for (int i = 0; i < d->ntrack; i++) {
        const fw_layout_track *t = &d->track[i];
        fw_geometry_box gap = {
            t->right ? w->x1 - 1e-6 : die->x0, fw_layout_to_grid(t->y_m - t->half_m),
            t->right ? die->x1 : w->x0 + 1e-6, fw_layout_to_grid(t->y_m + t->half_m)};
        fw_geometry_contour hole;
        fw_geometry_region left;
        if (t->y_m < box.y0 || t->y_m > box.y1) continue;
        FW_TRY(fw_geometry_contour_rectangle(d->arena, gap, &hole));
        fw_geometry_region all = {parts->contour, parts->count}, take = {&hole, 1};
        FW_TRY(fw_geometry_region_boolean(d->arena, &all, &take, FW_DIFFERENCE, &left));
        *parts = left;
    }
    return FW_OK;
}
