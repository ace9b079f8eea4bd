/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boxes with which every search begins: equal cells over the whole field, each with the edges that may be
   nearest to any of its points, or run through it. Cells that lie in an opening are left out.

   Every edge is listed in the cells through which it may run; a cell then asks its neighbours, ring by ring,
   until the next ring is farther than any edge that matters. In: field with edges and climbs. Out: field->start.
   Cost: the cells of every edge, and of every cell with material the edges of some nine cells. Test:
   test_reach.c, bounds_hold; test_reach_field.c, maps_are_distances, boxes_hold_what_they_say. */
#include "release/release_field.h"
#include <math.h>

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
    double h = 1.4142135623730951 * (1.0 + 1e-6) * g->half_m;
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
   than the nearest and twice the radius about the cell (release_box.c). */
static fw_status add_cell(grid *g, int i, int j, fw_release_level *to) {
    fw_release_field *f = g->field;
    FW_TRY(fw_release_level_room(to, f->arena, (size_t)f->nedge));
    look l = {middle_of(g, i, j), to->far_m, HUGE_VAL, HUGE_VAL, 0, j * g->n + i + 1};
    double h = 1.4142135623730951 * g->half_m;
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
