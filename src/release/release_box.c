/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes over the field, each with the few edges that matter in it: how they are split, what is known of each, and
   those that cover the field. */
#include "base/constants.h"
#include "release/release_field.h"
#include <math.h>
#include <stdint.h>
#include <string.h>

/* without zeros: what is added is written whole */
static void *grown(fw_arena *arena, const void *old, size_t count, size_t room, size_t size) {
    void *block = room <= SIZE_MAX / size ? fw_arena_raw(arena, room * size) : NULL;
    if (block && count > 0) memcpy(block, old, count * size);
    return block;
}

/* room for one more box of so many edges, and for their distances */
static fw_status level_room(fw_release_level *l, fw_arena *arena, size_t edges) {
    if ((size_t)l->nbox + 1 > l->box_room) {
        size_t more = l->box_room ? 2 * l->box_room : 1024;
        FW_NEED(l->box = grown(arena, l->box, (size_t)l->nbox, more, sizeof *l->box));
        l->box_room = more;
    }
    if ((size_t)l->nlist + edges > l->list_room) {
        size_t more = 2 * l->list_room + edges + 8192;
        FW_NEED(l->list = grown(arena, l->list, (size_t)l->nlist, more, sizeof *l->list));
        l->list_room = more;
    }
    if (edges > l->far_room) {
        FW_NEED(l->far_m = fw_arena_raw(arena, edges * sizeof *l->far_m));
        l->far_room = edges;
    }
    return FW_OK;
}

/* Keeps of the edges `from` (n) those that matter in a box of middle (x, y): open ones that may be
   nearest to any of its points, and all that run through the circle about it. With h the radius of
   that circle and d the distance of its middle from the nearest open edge, no point of the box is
   farther than d + h from one, and an edge farther than d + 2 h from the middle is farther than that
   from all of its points. Most edges are told by the circle around them. most_m: the middle is surely no
   farther from an open edge. */
static fw_status add_box(const fw_release_field *f, const int *from, int n, double x, double y,
                         double half_m, double most_m, int part, fw_release_level *to) {
    fw_geometry_vec2 c = {x, y};
    FW_TRY(level_room(to, f->arena, (size_t)n));
    double h = FW_SQRT_2 * half_m, near = HUGE_VAL, *far = to->far_m;
    int *list = to->list + to->nlist, some = 0, kept = 0;
    double open_within = most_m + 2.0 * h;
    for (int i = 0; i < n; i++) {
        const fw_release_edge *e = &f->edge[from[i]];
        double dx = e->about.x - x, dy = e->about.y - y;
        double within = (e->open ? open_within : h) + e->around;
        if (dx * dx + dy * dy > within * within) continue;
        double d = fw_release_edge_distance(e, c);
        if (e->open && d < near) {
            near = d;
            if (near + 2.0 * h < open_within) open_within = near + 2.0 * h;
        }
        if (d > h && (!e->open || d > open_within)) continue;
        far[some] = d;
        list[some++] = from[i];
    }
    for (int i = 0; i < some; i++)
        if (far[i] <= h || far[i] <= near + 2.0 * h) list[kept++] = list[i];
    to->box[to->nbox++] = (fw_release_box){.x = x,
                                           .y = y,
                                           .half_m = half_m,
                                           .first = to->nlist,
                                           .count = kept,
                                           .part = part,
                                           .near_m = near};
    to->nlist += kept;
    return FW_OK;
}

fw_status fw_release_level_split(const fw_release_field *f, const fw_release_level *level,
                                 const fw_release_box *box, fw_release_level *next) {
    double q = 0.5 * box->half_m, most = box->near_m + FW_SQRT_2 * q;
    for (int k = 0; k < 4; k++)
        FW_TRY(add_box(f, level->list + box->first, box->count, box->x + (k & 1 ? q : -q),
                       box->y + (k & 2 ? q : -q), q, most, box->part, next));
    return FW_OK;
}

const fw_release_edge *fw_release_nearest(const fw_release_field *f, const int *list, int n,
                                          fw_geometry_vec2 p, double most_m, double *near_m) {
    const fw_release_edge *nearest = NULL;
    *near_m = HUGE_VAL;
    for (int i = 0; i < n; i++) {
        const fw_release_edge *e = &f->edge[list[i]];
        double dx = e->about.x - p.x, dy = e->about.y - p.y, within = most_m + e->around;
        if (!e->open || dx * dx + dy * dy > within * within) continue;
        double d = fw_release_edge_distance(e, p);
        if (d < *near_m) *near_m = d, nearest = e;
        if (d < most_m) most_m = d;
    }
    return nearest;
}

bool fw_release_box_cut(const fw_release_field *f, const fw_release_level *level,
                        const fw_release_box *box) {
    fw_geometry_vec2 c = {box->x, box->y};
    double h = fw_release_box_about(box);
    if (box->near_m <= h) return true;
    for (int i = 0; i < box->count; i++) {
        const fw_release_edge *e = &f->edge[level->list[box->first + i]];
        if (!e->open && fw_release_edge_distance(e, c) <= h) return true;
    }
    return false;
}

void fw_release_box_settle(fw_release_field *f, fw_release_box *box) {
    if (box->part == FW_RELEASE_MIXED)
        box->part = fw_release_field_part(f, (fw_geometry_vec2){box->x, box->y});
}

/* ---- the upper bound ---- */

/* f(p) <= value + slope (p - c) + bend |p - c|^2 / 2 for all points of the box on the same side of the edge as its
   middle; on the other side, where the edge runs through the box, f(p) <= beyond */
typedef struct tangent {
    double value, bend, beyond;
    fw_geometry_vec2 slope;
    double curve,
        ray; /* of an arc: +1 seen from outside, -1 from inside, else 0; from its centre to c */
    fw_geometry_vec2 centre;
} tangent;

/* do all points of the circle h about p project into the edge itself, not to its ends? */
static bool within(const fw_release_edge *e, fw_geometry_vec2 p, double h) {
    if (e->radius == 0.0) {
        double t = vec_dot(vec_sub(p, e->a), e->along);
        return t >= h && t <= e->length - h;
    }
    fw_geometry_vec2 ray = vec_sub(p, e->centre);
    double length = vec_length(ray);
    if (e->cosine <= -1.0 + 1e-15) return true;
    if (length <= h || vec_dot(ray, e->middle) < e->cosine * length) return false;
    for (int k = 0; k < 2; k++) { /* and the two radii to its ends do not run through the circle */
        fw_geometry_vec2 u = vec_scale(1.0 / e->radius, vec_sub(k ? e->b : e->a, e->centre));
        if (vec_dot(ray, u) > -h && fabs(vec_cross(u, ray)) < h) return false;
    }
    return true;
}

/* of the distance from an edge: from a line it bends nowhere, from the outside of an arc by one over the
   distance from its centre, from the inside the other way; and from anything whatever by no more than
   one over the distance itself, since it is no farther than the foot */
static tangent touch(const fw_release_edge *e, fw_geometry_vec2 c, double h) {
    double d = fw_release_edge_distance(e, c);
    tangent t = {.value = d, .bend = HUGE_VAL, .slope = {0, 0}};
    if (!(d > 1e-15)) return t;
    t.slope = vec_scale(1.0 / d, vec_sub(c, fw_release_edge_foot(e, c)));
    if (d > h) t.bend = 1.0 / (d - h);
    if (!within(e, c, h)) return t;
    t.beyond = d < h ? h - d : 0.0;
    if (e->radius == 0.0) {
        t.bend = 0.0;
        return t;
    }
    t.ray = vec_distance(c, e->centre), t.centre = e->centre;
    if (t.ray <= e->radius)
        t.curve = -1.0, t.bend = 0.0;
    else if (t.ray > h)
        t.curve = 1.0, t.bend = 1.0 / (t.ray - h);
    return t;
}

/* The bend of a mean (1 - w) s + w t of two arcs that face each other, one seen from inside, the other from
   outside. |p - C| - |p - D| bends by no more than 2/sqrt(3) |C - D|/l^2, l the least distance of the circle from
   what is between C and D: the third derivative of a length l is no more than 2/sqrt(3)/l^2. Nothing, for arcs
   about the same centre. */
static double facing(const tangent *s, const tangent *t, double w, double h) {
    double plain = s->bend + w * (t->bend - s->bend);
    if (s->curve * t->curve >= 0.0) return plain;
    double apart = vec_distance(s->centre, t->centre), out = s->curve > 0.0 ? 1.0 - w : w;
    double least = (s->ray < t->ray ? s->ray : t->ray) - h - apart;
    if (least <= 0.0) return plain;
    double both = out < 1.0 - out ? out : 1.0 - out;
    double bend = both * 1.1547005383792517 * apart / (least * least) +
                  (out - both) * (s->curve > 0.0 ? s->bend : t->bend);
    return bend < plain ? bend : plain;
}

static double most_of(const tangent *t, double h) {
    double here = t->value + vec_length(t->slope) * h + 0.5 * t->bend * h * h;
    return here > t->beyond ? here : t->beyond;
}

static double lesser(double a, double b) {
    return a < b ? a : b;
}

/* The least upper bound that a mean of tangents gives: min f_i <= sum w_i f_i for weights w that add up
   to 1. Where the nearest edges stand around a point their slopes cancel, and the bound is as near as the
   square of the box. A point on the other side of an edge that is used is no farther from it than `beyond`. Weights
   are found one edge after the other, each with the part that makes the mean slope shortest. In: box with its edges. Out: m, never below what is true; *up, *rise_m: a step inside
   from the middle to where two edges are as near, 0 where there is none. Source: concavity of the minimum;
   Frank and Wolfe's step. Test: test_reach.c, bounds_hold, wedges_beside_slots; test_reach_field.c,
   boxes_hold_what_they_say. */
double fw_release_box_most(const fw_release_field *f, const fw_release_level *level,
                           const fw_release_box *box, fw_geometry_vec2 *up, double *rise_m) {
    enum { ROUNDS = 4, LOOKED = 24 };
    fw_geometry_vec2 c = {box->x, box->y};
    double h = fw_release_box_about(box), best = box->near_m + h;
    tangent of[LOOKED];
    int n = 0, nearest = -1;
    *rise_m = 0.0;
    *up = (fw_geometry_vec2){0, 0};
    for (int i = 0; i < box->count && n < LOOKED; i++) {
        const fw_release_edge *e = &f->edge[level->list[box->first + i]];
        if (!e->open) continue;
        of[n] = touch(e, c, h);
        if (nearest < 0 || of[n].value < of[nearest].value) nearest = n;
        n++;
    }
    if (nearest < 0) return best;
    tangent mean = of[nearest];
    *up = mean.slope;
    double step = HUGE_VAL;
    for (int i = 0; i < n; i++) {
        double closing = 1.0 - vec_dot(of[i].slope, *up);
        if (i != nearest && closing > 1e-3)
            step = lesser(step, (of[i].value - mean.value) / closing);
    }
    *rise_m = step < HUGE_VAL ? step : 0.0;
    for (int k = 0; k < ROUNDS; k++) {
        best = lesser(best, most_of(&mean, h));
        double length = vec_length(mean.slope), least = HUGE_VAL;
        int pick = -1;
        if (length < 1e-9 || mean.bend == HUGE_VAL) break;
        fw_geometry_vec2 g = vec_scale(1.0 / length, mean.slope);
        for (int i = 0; i < n; i++) {
            double there = of[i].value + h * vec_dot(of[i].slope, g) + 0.5 * of[i].bend * h * h;
            if (there < least) least = there, pick = i;
        }
        if (pick < 0) break;
        fw_geometry_vec2 to = vec_sub(of[pick].slope, mean.slope);
        double square = vec_dot(to, to);
        if (square < 1e-12) break;
        double w = -vec_dot(mean.slope, to) / square;
        w = w < 0.0 ? 0.0 : w > 1.0 ? 1.0 : w;
        if (w == 0.0) break;
        mean.value += w * (of[pick].value - mean.value);
        mean.bend =
            k == 0 ? facing(&mean, &of[pick], w, h) : mean.bend + w * (of[pick].bend - mean.bend);
        if (of[pick].beyond > mean.beyond) mean.beyond = of[pick].beyond;
        mean.slope = vec_along(mean.slope, w, to);
    }
    return lesser(best, most_of(&mean, h));
}

/* The same for the part of a box on one side of a seam, where the seam alone runs through it: with the
   nearest edge's tangent, whose largest value over the half of the circle is on its arc where the slope
   points there, else at an end of its chord. HUGE_VAL where anything else runs through the circle. */
double fw_release_box_side(const fw_release_field *f, const fw_release_level *level,
                           const fw_release_box *box, const fw_release_edge *seam) {
    fw_geometry_vec2 c = {box->x, box->y}, in = vec_left(seam->along);
    double h = fw_release_box_about(box);
    const fw_release_edge *nearest = NULL;
    if (seam->radius > 0.0 || !within(seam, c, h)) return HUGE_VAL;
    for (int i = 0; i < box->count; i++) {
        const fw_release_edge *e = &f->edge[level->list[box->first + i]];
        double d = fw_release_edge_distance(e, c);
        bool twin = vec_same(e->a, seam->b) && vec_same(e->b, seam->a);
        if (d <= h && e != seam && !twin) return HUGE_VAL;
        if (e->open && d <= box->near_m) nearest = e;
    }
    if (!nearest) return HUGE_VAL;
    tangent t = touch(nearest, c, h);
    double m = vec_dot(vec_sub(seam->a, c), in); /* the half has in . step >= m */
    double length = vec_length(t.slope), most = h * length;
    if (vec_dot(t.slope, in) * h < m * length)
        most = vec_dot(t.slope, in) * m +
               fabs(vec_cross(t.slope, in)) * sqrt(fmax(h * h - m * m, 0.0));
    return t.value + most + 0.5 * t.bend * h * h;
}

/* ---- the boxes with which every search begins ----
   Equal cells over the whole field, each with the edges that may be nearest to any of its points, or run
   through it. Cells that lie in an opening are left out.

   Every edge is listed in the cells through which it may run; a cell then asks its neighbours, ring by ring,
   until the next ring is farther than any edge that matters. In: field with edges and climbs. Out: field->start.
   Cost: the cells of every edge, and of every cell with material the edges of some nine cells. Test:
   test_reach.c, bounds_hold; test_reach_field.c, maps_are_distances, boxes_hold_what_they_say. */

enum { FEWEST = 16, MOST = 128, EDGES_PER_CELL = 1 }; /* of a side */

typedef struct node { /* an edge in a cell */
    int edge, next;
} node;

typedef struct grid {
    fw_release_field *field;
    double x0, y0, half_m; /* lower left corner; half a cell */
    int n;                 /* of a side */
    int *head;             /* (n x n) first node of a cell; -1: none */
    node *node;
    int nnode;
    int *seen; /* (nedge) the cell that looked at an edge last, from 1 */
    int *list; /* (nedge) what a cell has found */
} grid;

static int cell_of(const grid *g, double at, double from) {
    double i = floor((at - from) / (2.0 * g->half_m));
    return i < 0.0 ? 0 : i >= g->n ? g->n - 1 : (int)i;
}

typedef struct span { /* of cells */
    int i0, i1, j0, j1;
} span;

static span cells_of(const grid *g, const fw_release_edge *e) {
    double x0 = e->about.x - e->around, x1 = e->about.x + e->around;
    double y0 = e->about.y - e->around, y1 = e->about.y + e->around;
    if (e->radius == 0.0) {
        x0 = e->a.x < e->b.x ? e->a.x : e->b.x, x1 = e->a.x < e->b.x ? e->b.x : e->a.x;
        y0 = e->a.y < e->b.y ? e->a.y : e->b.y, y1 = e->a.y < e->b.y ? e->b.y : e->a.y;
    }
    double a_little = 1e-6 * g->half_m;
    return (span){cell_of(g, x0 - a_little, g->x0), cell_of(g, x1 + a_little, g->x0),
                  cell_of(g, y0 - a_little, g->y0), cell_of(g, y1 + a_little, g->y0)};
}

static fw_geometry_vec2 middle_of(const grid *g, int i, int j) {
    return (fw_geometry_vec2){g->x0 + (2 * i + 1) * g->half_m, g->y0 + (2 * j + 1) * g->half_m};
}

static fw_status enter_edges(grid *g) {
    const fw_release_field *f = g->field;
    size_t most = 0, cells = (size_t)g->n * (size_t)g->n;
    double h = FW_SQRT_2 * (1.0 + 1e-6) * g->half_m;
    for (int k = 0; k < f->nedge; k++) {
        span s = cells_of(g, &f->edge[k]);
        most += (size_t)(s.i1 - s.i0 + 1) * (size_t)(s.j1 - s.j0 + 1);
    }
    FW_NEED(g->node = fw_arena_raw(f->arena, (most + 1) * sizeof *g->node));
    FW_NEED(g->head = fw_arena_raw(f->arena, cells * sizeof *g->head));
    FW_NEED(g->seen = fw_arena_array(f->arena, int, (size_t)f->nedge));
    FW_NEED(g->list = fw_arena_raw(f->arena, (size_t)f->nedge * sizeof *g->list));
    for (size_t k = 0; k < cells; k++)
        g->head[k] = -1;
    for (int k = f->nedge - 1; k >= 0; k--) {
        const fw_release_edge *e = &f->edge[k];
        span s = cells_of(g, e);
        bool one = s.i0 == s.i1 && s.j0 == s.j1;
        for (int j = s.j0; j <= s.j1; j++)
            for (int i = s.i0; i <= s.i1; i++) {
                if (!one && fw_release_edge_distance(e, middle_of(g, i, j)) > h) continue;
                int *head = &g->head[j * g->n + i];
                g->node[g->nnode] = (node){k, *head};
                *head = g->nnode++;
            }
    }
    return FW_OK;
}

typedef struct look { /* of one cell at its neighbours */
    fw_geometry_vec2 c;
    double *far_m;
    double near_m, seam_m; /* the nearest open edge; seam */
    int n, stamp;
} look;

static void look_at(const grid *g, look *l, int i, int j) {
    if (i < 0 || j < 0 || i >= g->n || j >= g->n) return;
    for (int k = g->head[j * g->n + i]; k >= 0; k = g->node[k].next) {
        int which = g->node[k].edge;
        const fw_release_edge *e = &g->field->edge[which];
        if (g->seen[which] == l->stamp) continue;
        g->seen[which] = l->stamp;
        double d = fw_release_edge_distance(e, l->c);
        double *least = e->open ? &l->near_m : &l->seam_m;
        if (d < *least) *least = d;
        l->far_m[l->n] = d;
        g->list[l->n++] = which;
    }
}

/* the cells that are `ring` cells away */
static void look_around(const grid *g, look *l, int i, int j, int ring) {
    for (int k = -ring; k <= ring; k++) {
        look_at(g, l, i + k, j - ring);
        if (ring > 0) look_at(g, l, i + k, j + ring);
    }
    for (int k = 1 - ring; k < ring; k++) {
        look_at(g, l, i - ring, j + k);
        look_at(g, l, i + ring, j + k);
    }
}

/* What a point of ring k has at least to the middle is (2 k - 1) half cells; what matters is no farther
   than the nearest and twice the radius about the cell (fw_release_box_most). */
static fw_status add_cell(grid *g, int i, int j, fw_release_level *to) {
    fw_release_field *f = g->field;
    FW_TRY(level_room(to, f->arena, (size_t)f->nedge));
    look l = {middle_of(g, i, j), to->far_m, HUGE_VAL, HUGE_VAL, 0, j * g->n + i + 1};
    double h = FW_SQRT_2 * g->half_m;
    fw_release_box box = {
        .x = l.c.x, .y = l.c.y, .half_m = g->half_m, .part = FW_RELEASE_MIXED, .first = to->nlist};
    for (int ring = 0; ring <= g->n; ring++) {
        if (ring > 1 && (2 * ring - 1) * g->half_m > l.near_m + 2.0 * h) break;
        look_around(g, &l, i, j, ring);
        if (ring != 1 || l.near_m <= h || l.seam_m <= h) continue;
        box.part = fw_release_field_part(f, l.c);
        if (box.part < 0) return FW_OK;
    }
    for (int k = 0; k < l.n; k++)
        if (l.far_m[k] <= h || (l.far_m[k] <= l.near_m + 2.0 * h && f->edge[g->list[k]].open))
            to->list[to->nlist++] = g->list[k];
    box.near_m = l.near_m;
    box.count = to->nlist - box.first;
    to->box[to->nbox++] = box;
    return FW_OK;
}

fw_status fw_release_field_start(fw_release_field *f) {
    fw_geometry_box b = f->box;
    double side = fmax(b.x1 - b.x0, b.y1 - b.y0), n = ceil(sqrt((double)f->nedge / EDGES_PER_CELL));
    grid g = {.field = f, .n = n < FEWEST ? FEWEST : n > MOST ? MOST : (int)n};
    /* a little larger and not in the middle, so that corners of drawings on a grid do not lie on the
       edges of boxes */
    g.half_m = 0.5 * side * (1.0 + 7.1e-6) / g.n;
    g.x0 = 0.5 * (b.x0 + b.x1) + 1.37e-9 * side - g.n * g.half_m;
    g.y0 = 0.5 * (b.y0 + b.y1) + 0.73e-9 * side - g.n * g.half_m;
    FW_TRY(enter_edges(&g));
    for (int j = 0; j < g.n; j++)
        for (int i = 0; i < g.n; i++)
            FW_TRY(add_cell(&g, i, j, &f->start));
    return FW_OK;
}
