/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a body hangs over, as a tree of beams. Cells of the body are reached in steps through its material alone, from the
   ways between its hinges and its middle (body_arms.c), as far as these are not one way for all hinges, which is as slender
   as it is and no part of several arms. What is reached within two steps and hangs together is a part, and hangs on the part
   before it. So bars that lie side by side are parts of their own, a serpentine is as long as it is, and a ring is cut where
   its halves meet, which makes nothing stiffer. A part is a beam; its width is its area over its length.

   As a flow makes it (fw_layout.edge_m) a part is narrower by what edges stand in on either side, and lighter, as drawn where they
   stand out. In: outlines of the layout, SI. Range: a gap below a fifth of a cell parts nothing. Error: widths are known to a
   sixteenth of a cell, which they are less. Cost: of a cell some 100 operations. What such beams do: body_hung.c.
   Theory: docs/theory/effects/out-of-plane.md (4a). Test: test_body_arms.c what_hangs_over_bends, folded_bars */
#include "base/constants.h"
#include "base/sort.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "quantity/law_kind.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MARGIN = 3, SWING_CELLS = 50000, SWING_MOST = 1500000 };
/* of a cell: nothing; what bears; at an edge, and as wide as it is filled; a gap between two that is too narrow for it */
typedef enum tree_cell { EMPTY, BEARS, AT_EDGE, IN_GAP } tree_cell;

/* ---- cells ---- */

/* Release holes: loops no larger than they are. Each leaves what is between them of the width over twice its own length:
   E is 0.795 of the solid's for holes of 0.3 of the pitch, where 1/(1 + 3 share of the holes) of thin ones is 0.825. */
static fw_status find_holes(const fw_device *d, fw_verdict_tree *t) {
    const double pitch = d ? d->release_pitch_m : 0,
                 hole_m = pitch > 0 && d->release_hole_m > 0 ? d->release_hole_m : 0.3 * pitch,
                 share = pitch > 0 ? fmin((hole_m - 2 * t->edge_m) / pitch, 0.9) : 0;
    FW_NEED(t->hole = fw_arena_array(t->arena, bool, (size_t)t->nline));
    t->left = 1;
    for (int first = 0, last; pitch > 0 && first < t->nline; first = last) {
        fw_geometry_vec2 low = t->line[first].a, high = low;
        for (last = first; last < t->nline; last++) {
            const fw_geometry_vec2 p = t->line[last].a;
            if (last > first && vec_distance(p, t->line[last - 1].b) > FW_COINCIDENT_M) break;
            low = (fw_geometry_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
            high = (fw_geometry_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
        }
        if (!(fmax(high.x - low.x, high.y - low.y) < 1.2 * hole_m)) continue;
        for (int i = first; i < last; i++)
            t->hole[i] = true;
        t->left = 1 / (1 + fmin(1, 2 * share) * share / (1 - share));
    }
    return FW_OK;
}

/* it is fuller on either side */
static bool parts_two(const float *full, int step) {
    const float more = full[0] + 0.1F;
    return fmaxf(full[-step], full[-2 * step]) > more && fmaxf(full[step], full[2 * step]) > more;
}

fw_status fw_verdict_tree_lay(fw_verdict_tree *t, fw_geometry_box box, double cell) {
    t->cell = cell, t->whole_m2 = 0, t->nlist = 0;
    t->near = (int)(0.2 * t->depth_m / cell);
    t->box = (fw_geometry_box){box.x0 - MARGIN * cell, box.y0 - MARGIN * cell, box.x1, box.y1};
    t->nx = 2 * MARGIN + 1 + (int)((box.x1 - box.x0) / cell);
    t->ny = 2 * MARGIN + 1 + (int)((box.y1 - box.y0) / cell);
    const size_t n = (size_t)t->nx * (size_t)t->ny;
    FW_NEED(t->full = fw_arena_array(t->arena, float, n));
    FW_NEED(t->kind = fw_arena_array(t->arena, unsigned char, n));
    FW_NEED(t->step = fw_arena_raw(t->arena, n * sizeof *t->step));
    FW_NEED(t->came = fw_arena_raw(t->arena, n * sizeof *t->came));
    FW_NEED(t->part = fw_arena_raw(t->arena, n * sizeof *t->part));
    FW_NEED(t->list = fw_arena_raw(t->arena, n * sizeof *t->list));
    const fw_mechanism_cells cells = {t->box, cell, t->nx, t->ny};
    FW_TRY(fw_mechanism_fill_cells(t->arena, t->line, t->hole, t->nline, &cells, t->full));
    for (int j = 0; j < t->ny; j++)
        for (int i = 0; i < t->nx; i++) {
            const int at = j * t->nx + i;
            const float full = t->full[at];
            t->whole_m2 += cell * cell * (double)full;
            if (i < 2 || j < 2 || i >= t->nx - 2 || j >= t->ny - 2 || full < 0.01F) continue;
            const bool gap =
                full < 0.9F && (parts_two(t->full + at, 1) || parts_two(t->full + at, t->nx));
            t->kind[at] = gap ? IN_GAP : full < 0.5F ? AT_EDGE : BEARS;
        }
    return FW_OK;
}

/* ---- steps and parts ---- */

/* Of a cell's neighbours: where they are, and the two that a corner lies between. Arrays and sizes are the tree's; a function's
   own, since what it writes might be them. */
typedef struct beside {
    int to[8], x[8], y[8];
} beside;

static beside beside_of(const fw_verdict_tree *t) {
    static const int x[8] = {1, -1, 0, 0, 1, 1, -1, -1}, y[8] = {0, 0, 1, -1, 1, -1, 1, -1};
    beside b;
    for (int d = 0; d < 8; d++)
        b.x[d] = x[d], b.y[d] = y[d] * t->nx, b.to[d] = b.x[d] + b.y[d];
    return b;
}

/* no corner is cut */
static bool hangs_together(const unsigned char *kind, const beside *b, int d) {
    return d < 4 || (kind[b->x[d]] == BEARS && kind[b->y[d]] == BEARS);
}

static void begin_at(fw_verdict_tree *t, fw_geometry_vec2 p) {
    const int x = (int)((p.x - t->box.x0) / t->cell), y = (int)((p.y - t->box.y0) / t->cell);
    int best = FW_NONE;
    double least = HUGE_VAL;
    for (int j = y - 2; j <= y + 2; j++)
        for (int i = x - 2; i <= x + 2; i++) {
            if (i < 2 || j < 2 || i >= t->nx - 2 || j >= t->ny - 2) continue;
            const double off = pow(i - x, 2) + pow(j - y, 2);
            if (t->kind[j * t->nx + i] == BEARS && off < least) least = off, best = j * t->nx + i;
        }
    if (best == FW_NONE || t->step[best] == 0) return;
    t->step[best] = 0, t->came[best] = FW_NONE;
    t->list[t->nlist++] = best;
}

/* from the cells that hold: to those beside, and to all around, by turns */
static void spread_out(fw_verdict_tree *t) {
    const beside b = beside_of(t);
    const unsigned char *kind = t->kind;
    int *step = t->step, *came = t->came, *list = t->list, n = t->nlist;
    for (int k = 1, from = 0; from < n; k++)
        for (const int end = n, most = k % 2 ? 4 : 8; from < end; from++) {
            const int at = list[from];
            for (int d = 0; d < most; d++) {
                const int to = at + b.to[d];
                if (kind[to] != BEARS || step[to] < INT_MAX || !hangs_together(kind + at, &b, d))
                    continue;
                step[to] = k, came[to] = at;
                list[n++] = to;
            }
        }
    t->nlist = n;
}

/* what is nearer to what holds it than a fifth of the layer's thickness is held, whatever width it begins with */
static int level_of(int step, int near) {
    return step > near ? (step - near + 1) / 2 : 0;
}

/* the cells of a new part, from one of them on; room: of cells */
static void gather(fw_verdict_tree *t, const beside *b, int first, int *room) {
    const unsigned char *kind = t->kind;
    const int *step = t->step, near = t->near;
    int *part = t->part, n = 0, most = 0;
    const int own = t->n++, level = level_of(step[first], near);
    t->at[own] = (fw_verdict_tree_part){.level = level, .before = FW_NONE, .keeps = 1};
    part[first] = own, room[n++] = first;
    for (int i = 0; i < n; i++) {
        const int at = room[i];
        for (int d = 0; d < 8; d++) {
            const int to = at + b->to[d];
            if (part[to] != FW_NONE || kind[to] != BEARS || step[to] == INT_MAX ||
                level_of(step[to], near) != level || !hangs_together(kind + at, b, d))
                continue;
            part[to] = own, room[n++] = to;
        }
    }
    for (int i = 0; i < n && level > 0; i++) { /* on what most of it came from */
        const int from = t->came[room[i]], on = part[from];
        if (on == own || on == t->at[own].before) continue;
        int came = 0;
        for (int k = 0; k < n; k++)
            came += part[t->came[room[k]]] == on;
        if (came > most) most = came, t->at[own].before = on;
    }
}

static fw_geometry_vec2 place_of_cell(const fw_verdict_tree *t, int at) {
    return (fw_geometry_vec2){t->box.x0 + (at % t->nx + 0.5) * t->cell,
                              t->box.y0 + (at / t->nx + 0.5) * t->cell};
}

static void weigh(fw_verdict_tree *t, int at, int own, bool wide) {
    const double area = t->cell * t->cell * (double)t->full[at], all = t->at[own].area_m2 + area;
    fw_verdict_tree_part *p = &t->at[own];
    const fw_geometry_vec2 here = place_of_cell(t, at);
    p->mass_m2 += area, t->reached_m2 += area;
    if (!wide || !(area > 0)) return;
    p->at = vec_along(p->at, area / all, vec_sub(here, p->at));
    p->area_m2 = all;
}

/* what bears nothing hangs on what is nearest to it; cells at an edge are of its width */
static void take_rest(fw_verdict_tree *t, const beside *b) {
    const unsigned char *kind = t->kind;
    int *part = t->part, *list = t->list, n = t->nlist;
    for (int i = 0; i < n; i++) {
        const int at = list[i];
        for (int d = 0; d < 8; d++) {
            const int to = at + b->to[d];
            if (kind[to] == BEARS || kind[to] == EMPTY || part[to] != FW_NONE) continue;
            part[to] = part[at];
            weigh(t, to, part[to], kind[at] == BEARS && kind[to] == AT_EDGE);
            list[n++] = to;
        }
    }
    t->nlist = n;
}

/* How long and wide parts are, and how they run. What spreads around what holds it by half a right angle or more is in what
   the roots of flexures give in a wide base (flexure/), and bends no more. */
static fw_status measure_parts(fw_verdict_tree *t) {
    int *next = fw_arena_array(t->arena, int, (size_t)t->n);
    const double step = 2 * t->cell, most = 1.12 * step;
    FW_NEED(next);
    for (int i = 0; i < t->n; i++)
        next[i] = FW_NONE;
    for (int i = 0; i < t->n; i++) {
        const int on = t->at[i].before;
        if (on != FW_NONE) t->at[on].bears++;
        if (on != FW_NONE && (next[on] == FW_NONE || t->at[i].area_m2 > t->at[next[on]].area_m2))
            next[on] = i;
    }
    for (int i = 0; i < t->nlist; i++) {
        fw_verdict_tree_part *p = &t->at[t->part[t->list[i]]];
        p->far_m = fmax(p->far_m, vec_distance(place_of_cell(t, t->list[i]), p->at));
    }
    for (int i = 0; i < t->n; i++) {
        fw_verdict_tree_part *p = &t->at[i];
        if (p->before == FW_NONE) continue;
        const fw_verdict_tree_part *b = &t->at[p->before],
                                   *c = next[i] == FW_NONE ? p : &t->at[next[i]];
        const bool held = b->before == FW_NONE;
        const double before = held ? 0 : vec_distance(p->at, b->at),
                     after = vec_distance(p->at, c->at),
                     count = (before > 0.5 * step) + (after > 0.5 * step),
                     sum = (before > 0.5 * step ? before : 0) + (after > 0.5 * step ? after : 0);
        p->long_m = count > 0 ? fmin(fmax(sum / count, step), most) : most;
        const double drawn_m = p->area_m2 / p->long_m - t->cell / FW_MECHANISM_SUBROWS;
        if (drawn_m > 0) p->keeps = fw_verdict_made_m(drawn_m, t->edge_m) / drawn_m;
        p->wide_m = fmax(t->left * drawn_m * p->keeps, 1e-3 * t->cell);
        if ((held || b->spreads) && p->wide_m - b->wide_m >= p->long_m) {
            p->spreads = true, p->long_m = 0;
            continue;
        }
        const fw_geometry_vec2 along = vec_sub(c->at, held ? p->at : b->at);
        if (vec_length(along) > 0.5 * step && fmax(before, after) < 1.5 * most)
            p->along = vec_unit(along);
        if (held || !(b->wide_m > 2 * p->wide_m)) continue;
        p->root_m[0] = p->wide_m * fmax(0.5, 1.07 + 0.215 * log(t->depth_m / p->wide_m));
        p->root_m[1] = 0.5 * p->wide_m;
    }
    t->made_m2 = 0;
    for (int i = 0; i < t->n; i++)
        t->at[i].mass_m2 *= t->at[i].keeps, t->made_m2 += t->at[i].mass_m2;
    if (!(t->edge_m < 0)) t->made_m2 = t->reached_m2;
    return FW_OK;
}

static fw_status make_parts(fw_verdict_tree *t) {
    size_t most = 64; /* there are some parts of hundreds of cells each, as a rule */
    FW_NEED(t->at = fw_arena_array(t->arena, fw_verdict_tree_part, most));
    int *room = fw_arena_raw(t->arena, ((size_t)t->nlist + 1) * sizeof *room);
    FW_NEED(room);
    const beside b = beside_of(t);
    t->n = 0, t->reached_m2 = 0;
    for (int i = 0; i < t->nlist; i++) {
        if (t->part[t->list[i]] != FW_NONE) continue;
        if ((size_t)t->n == most) {
            FW_NEED(t->at = fw_arena_grow(t->arena, t->at, most, 2 * most, sizeof *t->at));
            most *= 2;
        }
        gather(t, &b, t->list[i], room);
    }
    for (int i = 0; i < t->nlist; i++)
        weigh(t, t->list[i], t->part[t->list[i]], true);
    take_rest(t, &b);
    FW_TRY(measure_parts(t));
    FW_NEED(t->f = fw_arena_alloc(t->arena, (size_t)t->n, sizeof *t->f));
    FW_NEED(t->u = fw_arena_alloc(t->arena, (size_t)t->n, sizeof *t->u));
    FW_NEED(t->v = fw_arena_alloc(t->arena, (size_t)t->n, sizeof *t->v));
    return FW_OK;
}

/* ---- what holds a body ---- */

/* of the ways of a body's hinges to its middle (n): from where on, back from its end, the first one goes with all others */
static int goes_with_all(const fw_verdict_arm *const *arm, int n) {
    const fw_verdict_arm *first = arm[0];
    int at = first->nway - 1;
    for (; at > 0; at--) {
        const fw_geometry_vec2 p = first->way[at - 1];
        const double near_m = 2.1 * vec_distance(first->way[at], p);
        bool all = true;
        for (int k = 1; k < n && all; k++) {
            all = false;
            for (int i = 0; i < arm[k]->nway && !all; i++)
                all = vec_distance(arm[k]->way[i], p) < near_m;
        }
        if (!all) break;
    }
    return at;
}

static void begin_along(fw_verdict_tree *t, fw_geometry_vec2 a, fw_geometry_vec2 b) {
    const int n = 1 + (int)(2 * vec_distance(a, b) / t->cell);
    for (int k = 0; k <= n; k++)
        begin_at(t, vec_along(a, (double)k / n, vec_sub(b, a)));
}

typedef struct
    fw_verdict_held { /* by hinges: arms (n) that are known, roots (nroot) of those that are not */
    const fw_verdict_arm **arm;
    fw_geometry_vec2 *root, middle;
    int n, nroot, shared; /* of the first arm: from where on it goes with all others */
} held;

static fw_status find_held(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout,
                           int body, const fw_verdict_arm *arm, held *to) {
    fw_geometry_vec2 pin, root;
    const size_t most = 2 * (size_t)m->nhinge + 1;
    *to = (held){.middle = layout->body[body].centroid};
    FW_NEED(to->arm = fw_arena_array(arena, const fw_verdict_arm *, most));
    FW_NEED(to->root = fw_arena_array(arena, fw_geometry_vec2, most));
    for (int k = 0; k < 2 * m->nhinge; k++) {
        if (!fw_mechanism_hinge_end(m, body, k, &pin, &root)) continue;
        if (arm && arm[k].known && arm[k].nway > 0)
            to->arm[to->n++] = &arm[k];
        else
            to->root[to->nroot++] = root;
    }
    if (to->n > 0) to->shared = to->nroot == 0 ? goes_with_all(to->arm, to->n) : INT_MAX;
    return FW_OK;
}

/* all: with what is one way for all hinges */
static void begin_held(fw_verdict_tree *t, const held *h, bool all) {
    const bool meets = !all && h->n > 0 && h->shared < INT_MAX;
    for (int k = 0; k < h->n; k++) {
        const fw_verdict_arm *arm = h->arm[k];
        const double near_m = 2.1 * vec_distance(arm->way[0], arm->way[arm->nway > 1]);
        for (int i = 0; i < arm->nway; i++) {
            begin_at(t, arm->way[i]);
            if (i > 0) begin_along(t, arm->way[i - 1], arm->way[i]);
            /* it ends where all go one way */
            if (meets && vec_distance(arm->way[i], h->arm[0]->way[h->shared]) <= near_m) break;
        }
    }
    for (int k = 0; k < h->nroot; k++)
        begin_along(t, h->root[k], h->middle);
    if (h->n + h->nroot == 0) begin_at(t, h->middle);
}

fw_status fw_verdict_tree_grow(fw_verdict_tree *t, bool whole_ways) {
    const int n = t->nx * t->ny;
    for (int i = 0; i < n; i++)
        t->step[i] = INT_MAX, t->part[i] = FW_NONE;
    t->nlist = 0;
    begin_held(t, t->held, whole_ways);
    spread_out(t);
    return make_parts(t);
}

fw_status fw_verdict_tree_new(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout,
                              int body, const fw_verdict_arm *arm, fw_verdict_tree *t) {
    fw_mechanism_line *line;
    t->arena = arena, t->edge_m = fmin(layout->edge_m, 0);
    FW_TRY(fw_mechanism_body_lines(arena, layout, body, &line, &t->nline));
    t->line = line;
    if (t->nline == 0) return FW_OK;
    t->box = (fw_geometry_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < t->nline; i++) {
        const fw_geometry_vec2 p = line[i].a;
        t->box = fw_box_join(t->box, (fw_geometry_box){p.x, p.y, p.x, p.y});
    }
    FW_TRY(find_holes(m->device, t));
    FW_NEED(t->held = fw_arena_one(arena, held));
    FW_TRY(find_held(arena, m, layout, body, arm, t->held));
    t->nhinge = t->held->n + t->held->nroot;
    return FW_OK;
}

/* ---- a body as a tree from its middle: all of what it does as it swings (body_swing.c) ---- */

/* three cells across, but for a tenth of what bears anything, and all hangs together */
static bool is_resolved(const fw_verdict_tree *t) {
    const double across = 3, little = 1e-3;
    int narrow = 0, all = 0;
    for (int i = 0; i < t->n; i++) {
        if (t->at[i].before == FW_NONE || t->at[i].bears == 0) continue;
        all++, narrow += t->at[i].wide_m < across * t->cell;
    }
    return t->reached_m2 >= (1 - little) * t->whole_m2 && narrow <= 1 + all / 10;
}

static fw_status grow_from_middle(fw_verdict_tree *t) {
    const double least_m = 1e-6;
    const fw_geometry_box box = t->box;
    const double x = box.x1 - box.x0, y = box.y1 - box.y0;
    double cell = fmax(fmax(sqrt(x * y / SWING_CELLS), fmax(x, y) / 1000), least_m);
    const fw_mark mark = fw_arena_mark(t->arena);
    for (;; cell /= 2) {
        fw_arena_rewind(t->arena, mark);
        FW_TRY(fw_verdict_tree_lay(t, box, cell));
        FW_TRY(fw_verdict_tree_grow(t, true));
        if (is_resolved(t) || cell < 2 * least_m || 4 * x * y / (cell * cell) > SWING_MOST)
            return FW_OK;
    }
}

/* the part that is nearest to a place; FW_NONE: none is near */
static int part_at(const fw_verdict_tree *t, fw_geometry_vec2 p) {
    enum { NEAR = 4 };
    const int x = (int)((p.x - t->box.x0) / t->cell), y = (int)((p.y - t->box.y0) / t->cell);
    double least = HUGE_VAL;
    int best = FW_NONE;
    for (int j = y - NEAR; j <= y + NEAR; j++)
        for (int i = x - NEAR; i <= x + NEAR; i++) {
            if (i < 0 || j < 0 || i >= t->nx || j >= t->ny) continue;
            const int part = t->part[j * t->nx + i];
            const double off = pow(i - x, 2) + pow(j - y, 2);
            if (part != FW_NONE && t->kind[j * t->nx + i] == BEARS && off < least)
                least = off, best = part;
        }
    return best;
}

/* nothing hangs on it but the end of the flexure's strip, which is no wider */
static bool is_an_end(fw_verdict_tree *t, int part) {
    t->f[part][0] = 1; /* of those behind it: it hangs on this part */
    for (int i = part + 1; i < t->n; i++) {
        t->f[i][0] = t->at[i].before >= part ? t->f[t->at[i].before][0] : 0;
        if (t->f[i][0] > 0 && t->at[i].wide_m > t->at[part].wide_m) return false;
    }
    return true;
}

/* What spreads from a flexure's root by half a right angle or more is in what the root gives, as in measure_parts. */
static void spread_from_root(fw_verdict_tree *t, int part) {
    for (bool only = is_an_end(t, part); only; only = t->at[part].bears == 1) {
        fw_verdict_tree_part *p = &t->at[part];
        if (p->before == FW_NONE || !(p->long_m > 0) ||
            t->at[p->before].wide_m - p->wide_m < p->long_m)
            return;
        part = p->before;
        p->long_m = p->root_m[0] = p->root_m[1] = 0;
    }
}

/* how far what spreads around the middle goes all around: a part there is a ring */
static double around_middle(const fw_verdict_tree *t, int part) {
    double widest = 0;
    for (; part != FW_NONE; part = t->at[part].before)
        widest = fmax(widest, t->at[part].wide_m);
    return widest / FW_TURN;
}

/* What bears spreads within a body by a quarter of its way on either side, from both ends of it: in a corner, and behind a
   narrow part, less is borne than is there. And what spreads around the middle, which is held there alone, is as long as it is,
   less what of the middle is wider than what goes on from there. */
static void narrow_parts(fw_verdict_tree *t) {
    const double spreads = 0.5;
    for (int i = 0; i < t->n; i++) {
        fw_verdict_tree_part *p = &t->at[i];
        if (p->before == FW_NONE || !(p->long_m > 0)) continue;
        const fw_verdict_tree_part *b = &t->at[p->before];
        const bool first = b->before == FW_NONE || b->spreads;
        if (first)
            p->long_m = fmax(p->long_m, vec_distance(p->at, t->at[0].at) + 0.5 * p->long_m -
                                            fmax(0, around_middle(t, p->before) - 0.5 * p->wide_m));
        else
            p->wide_m = fmin(p->wide_m, b->wide_m + spreads * vec_distance(p->at, b->at));
        if (!first && b->bears > 1) /* the front runs into a branch before it parts there */
            p->long_m =
                fmax(p->long_m, vec_distance(p->at, b->at) - 0.5 * b->wide_m + 0.5 * p->long_m);
    }
    for (int i = 0; i < t->n; i++)
        t->f[i][0] = 0; /* the most that goes on behind it */
    for (int i = t->n - 1; i >= 0; i--) {
        fw_verdict_tree_part *p = &t->at[i];
        if (t->f[i][0] > 0) p->wide_m = fmin(p->wide_m, t->f[i][0]);
        if (p->before == FW_NONE) continue;
        const double apart = vec_distance(p->at, t->at[p->before].at);
        const double behind = p->long_m > 0 ? p->wide_m + spreads * apart : HUGE_VAL;
        t->f[p->before][0] = fmax(t->f[p->before][0], behind);
    }
}

static void gives_by(const fw_verdict_tree *t, int part, double *turns, double *goes) {
    const fw_verdict_tree_part *p = &t->at[part];
    const double stiff = t->youngs_Pa * t->depth_m * p->wide_m;
    *turns = 12 * (p->long_m + p->root_m[1]) / (stiff * p->wide_m * p->wide_m);
    *goes = 3.2 * p->long_m / stiff;
}

/* from one part to another by what both hang on */
static double way_around(const fw_verdict_tree *t, int a, int b) {
    double far = 0;
    while (a != b) {
        int *later = a > b ? &a : &b; /* what stands before a part has a lower number */
        if (t->at[*later].before == FW_NONE) return HUGE_VAL;
        far += vec_distance(t->at[*later].at, t->at[t->at[*later].before].at);
        *later = t->at[*later].before;
    }
    return far;
}

/* Where two parts touch that are far from each other along the tree they close a ring, which gives there as the narrower one
   does: once within their widths. Of the rings those farthest out: what is left out makes nothing stiffer. */
static fw_status add_loops(fw_arena *arena, const fw_verdict_tree *t, int first,
                           fw_verdict_beams *to) {
    enum { LOOPS = 24 };
    const double around = 3;
    const beside b = beside_of(t);
    const size_t had = (size_t)to->nloop;
    FW_NEED(to->loop = fw_arena_grow(arena, to->loop, had, had + LOOPS, sizeof *to->loop));
    fw_verdict_loop *loop = to->loop + had;
    int n = 0;
    for (int k = t->nlist - 1; k >= 0 && n < LOOPS; k--) {
        const int at = t->list[k], part = t->part[at];
        for (int d = 0; d < 4 && n < LOOPS && t->kind[at] == BEARS; d++) {
            const int other = t->part[at + b.to[d]];
            if (other == part || other == FW_NONE || t->kind[at + b.to[d]] != BEARS) continue;
            const fw_geometry_vec2 here = place_of_cell(t, at);
            const double wide = t->at[part].wide_m + t->at[other].wide_m;
            bool known = !(way_around(t, part, other) > around * wide);
            for (int i = 0; i < n && !known; i++)
                known = vec_distance(loop[i].at, here) < 2 * wide;
            if (known) continue;
            const int thin = t->at[part].wide_m < t->at[other].wide_m ? part : other;
            loop[n] = (fw_verdict_loop){{first + part, first + other}, here, 0, 0};
            gives_by(t, thin, &loop[n].turns, &loop[n].goes);
            n++;
        }
    }
    to->nloop += n;
    return FW_OK;
}

fw_status fw_verdict_tree_beams(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                                fw_verdict_tree *t, int body, fw_verdict_beams *to, bool *holds) {
    const size_t first = (size_t)to->n;
    fw_geometry_vec2 pin, root;
    *t->held = (held){.middle = m->layout->body[body].centroid};
    for (int k = 0; k < 2 * m->nhinge; k++)
        if (arm && arm[k].nway > 0 && fw_mechanism_hinge_end(m, body, k, &pin, &root))
            t->held->middle = arm[k].way[arm[k].nway - 1];
    FW_TRY(grow_from_middle(t));
    const double little = 0.01;
    *holds = t->n > 0 && t->reached_m2 >= (1 - little) * t->whole_m2;
    if (!*holds) return FW_OK;
    FW_NEED(to->at = fw_arena_grow(arena, to->at, first, first + (size_t)t->n, sizeof *to->at));
    for (int k = 0; k < 2 * m->nhinge; k++) {
        if (!fw_mechanism_hinge_end(m, body, k, &pin, &root)) continue;
        const int part = part_at(t, root);
        *holds = *holds && part != FW_NONE;
        to->on[k] = (int)first + (part == FW_NONE ? 0 : part);
        if (part != FW_NONE) spread_from_root(t, part);
    }
    narrow_parts(t);
    for (int i = 0; i < t->n; i++) {
        const fw_verdict_tree_part *p = &t->at[i];
        fw_verdict_beam *b = &to->at[to->n++];
        *b = (fw_verdict_beam){.body = body, .before = FW_NONE, .at = p->at, .along = p->along};
        if (p->before == FW_NONE) continue;
        b->before = (int)first + p->before;
        gives_by(t, i, &b->turns, &b->goes);
        b->pulls = vec_length(p->along) > 0 ? b->goes / 3.2 : b->goes;
    }
    FW_TRY(add_loops(arena, t, (int)first, to));
    return FW_OK;
}

/* What hangs over is pulled down by itself, over the gap that is left at rest, and goes with what bodies do as plates: shares
   of the tension add up at most (Dunkerley). What bears more than ten times as much is left out. */
double fw_verdict_hung_pulled(const fw_verdict_hung *hung, double gap_m, double down_m,
                              double error, double bodies_N_per_m) {
    const double times = 10,
                 left = 1 - (down_m + hung->across_s2 * FW_STANDARD_GRAVITY_m_per_s2) / gap_m,
                 own = 0.5 * hung->bears_N_per_m * pow(fmax(left, 1e-3), 2) / (1 + error);
    return own < times * bodies_N_per_m ? 1 / (1 / own + 1 / bodies_N_per_m) : HUGE_VAL;
}
