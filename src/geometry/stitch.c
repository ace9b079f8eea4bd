/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/boolean.h"

typedef struct chain { /* the outline being followed */
    int *edge;         /* (count) */
    int count;
} chain;

static int edge_start(const fw_geometry_edge *e) {
    return e->reversed ? e->to : e->from;
}
static int edge_end(const fw_geometry_edge *e) {
    return e->reversed ? e->from : e->to;
}

/* how far from its ends an edge is still one simple crossing of a circle about the end */
static double reach(const fw_geometry_segment *s) {
    double chord = vec_distance(s->a, s->b);
    if (s->kind == FW_LINE) return chord;
    return fabs(s->sweep_rad) > FW_PI ? s->radius : fmin(chord, s->radius);
}

/* direction from the start of s to its point at distance d from there */
static fw_geometry_vec2 heading(const fw_geometry_segment *s, double d) {
    if (s->kind == FW_LINE) return vec_sub(s->b, s->a);
    double angle = copysign(2 * asin(fmin(0.5 * d / s->radius, 1)), s->sweep_rad);
    fw_geometry_vec2 at =
        vec_add(s->centre, fw_geometry_vec_rotate(vec_sub(s->a, s->centre), angle));
    return vec_sub(at, s->a);
}

/* Among the unused edges that leave the node, the one next clockwise from where `arriving` came:
   material lies to the left, so this keeps outlines that only touch apart. Curves with one tangent
   are told apart on a small circle about the node. */
static int next_edge(const fw_geometry_graph *g, const int *first, const int *after, int arriving) {
    int node = edge_end(&g->edge[arriving]), only = -1, candidates = 0;
    for (int e = first[node]; e >= 0; e = after[e])
        if (!g->edge[e].used) {
            only = e;
            candidates++;
        }
    if (candidates < 2) return only;
    fw_geometry_segment in = fw_geometry_edge_segment(g, &g->edge[arriving]);
    in = fw_geometry_segment_reverse(&in);
    double d = reach(&in);
    for (int e = first[node]; e >= 0; e = after[e])
        if (!g->edge[e].used) {
            fw_geometry_segment s = fw_geometry_edge_segment(g, &g->edge[e]);
            d = fmin(d, reach(&s));
        }
    int best = -1;
    double least = HUGE_VAL;
    fw_geometry_vec2 back = heading(&in, 0.5 * d);
    for (int e = first[node]; e >= 0; e = after[e]) {
        if (g->edge[e].used) continue;
        fw_geometry_segment s = fw_geometry_edge_segment(g, &g->edge[e]);
        double angle = fw_geometry_vec_angle(heading(&s, 0.5 * d), back);
        if (angle <= 0) angle += FW_TURN;
        if (angle < least) {
            least = angle;
            best = e;
        }
    }
    return best;
}

/* does b go on where a ends, on the same segment? */
static bool goes_on(const fw_geometry_edge *a, const fw_geometry_edge *b) {
    if (a->segment != b->segment || a->reversed != b->reversed) return false;
    return a->reversed ? b->rank + 1 == a->rank : a->rank + 1 == b->rank;
}

/* segments of different regions that continue each other become one: no vertex without a cause */
static bool join(fw_geometry_segment *a, const fw_geometry_segment *b) {
    if (a->kind != b->kind || a->flags != b->flags || (a->flags & FW_SEGMENT_JOINT)) return false;
    if (a->kind == FW_LINE) {
        fw_geometry_vec2 whole = vec_sub(b->b, a->a), part = vec_sub(a->b, a->a);
        double length = vec_length(whole), along = vec_dot(whole, part);
        if (!(along > 0 && along < length * length &&
              fabs(vec_cross(whole, part)) <= FW_COINCIDENT_M * length))
            return false;
    } else {
        double sweep = a->sweep_rad + b->sweep_rad;
        if (!vec_same(a->centre, b->centre) || a->radius != b->radius ||
            (a->sweep_rad > 0) != (b->sweep_rad > 0) || fabs(sweep) > FW_PI)
            return false;
        a->sweep_rad = sweep;
    }
    a->b = b->b;
    return true;
}

/* one closed chain of edges to an outline: parts of one segment are put together again */
static fw_status outline_of(const fw_geometry_graph *g, const int *edge, int n,
                            fw_geometry_contour *contour) {
    int start = 0;
    while (start < n && goes_on(&g->edge[edge[(start + n - 1) % n]], &g->edge[edge[start]]))
        start++;
    start %= n;
    fw_geometry_segment *segment = fw_arena_raw(g->arena, (size_t)n * sizeof *segment);
    int *owner = fw_arena_raw(g->arena, (size_t)n * sizeof *owner);
    FW_NEED(segment);
    FW_NEED(owner);
    int count = 0;
    for (int i = 0; i < n;) {
        fw_geometry_edge whole = g->edge[edge[(start + i) % n]];
        const fw_geometry_edge *last = &g->edge[edge[(start + i) % n]];
        for (i++; i < n && goes_on(last, &g->edge[edge[(start + i) % n]]); i++) {
            last = &g->edge[edge[(start + i) % n]];
            if (whole.reversed) {
                whole.from = last->from;
                whole.t0 = last->t0;
            } else {
                whole.to = last->to;
                whole.t1 = last->t1;
            }
        }
        fw_geometry_segment s = fw_geometry_edge_segment(g, &whole);
        if (count > 0 && owner[count - 1] != whole.owner && join(&segment[count - 1], &s)) continue;
        owner[count] = whole.owner;
        segment[count++] = s;
    }
    if (count > 2 && owner[count - 1] != owner[0]) {
        fw_geometry_segment s = segment[count - 1];
        if (join(&s, &segment[0])) {
            segment[0] = s;
            count--;
        }
    }
    *contour = (fw_geometry_contour){segment, count};
    return FW_OK;
}

/* outlines thinner than the tolerance are what is left of coincident edges */
static bool is_sliver(const fw_geometry_contour *contour, double area_m2) {
    return fabs(area_m2) <=
           4 * FW_COINCIDENT_M * (fw_geometry_contour_perimeter(contour) + FW_COINCIDENT_M);
}

typedef struct collector {
    fw_geometry_graph *graph;
    fw_geometry_contour *contour;
    bool *hole; /* (count) */
    int count;
} collector;

static fw_status emit(collector *c, const int *edge, int n) {
    fw_geometry_contour made;
    FW_TRY(outline_of(c->graph, edge, n, &made));
    double area_m2 = fw_geometry_contour_area(&made);
    if (is_sliver(&made, area_m2)) return FW_OK;
    c->hole[c->count] = area_m2 < 0;
    c->contour[c->count++] = made;
    return FW_OK;
}

/* follows edges from `first_edge`; whenever a node comes again the loop since then is cut off */
static fw_status follow(collector *c, chain *path, int *seen, const int *first, const int *after,
                        int first_edge) {
    fw_geometry_graph *g = c->graph;
    int e = first_edge;
    path->count = 0;
    seen[edge_start(&g->edge[e])] = 0;
    while (true) {
        g->edge[e].used = true;
        path->edge[path->count++] = e;
        int node = edge_end(&g->edge[e]);
        if (seen[node] >= 0) {
            int from = seen[node];
            FW_TRY(emit(c, path->edge + from, path->count - from));
            for (int i = from; i < path->count; i++)
                if (i > from) seen[edge_start(&g->edge[path->edge[i]])] = -1;
            path->count = from;
            if (from == 0) {
                seen[node] = -1;
                return FW_OK;
            }
            e = path->edge[from - 1]; /* go on as if the loop had not been there */
        } else
            seen[node] = path->count;
        e = next_edge(g, first, after, e);
        if (e < 0) return FW_GEOMETRY;
    }
}

static fw_status order_outlines(fw_geometry_graph *g, const collector *c, fw_geometry_region *out) {
    out->contour = fw_arena_array(g->arena, fw_geometry_contour, (size_t)c->count);
    FW_NEED(out->contour);
    for (int holes = 0; holes < 2; holes++)
        for (int i = 0; i < c->count; i++)
            if (c->hole[i] == (holes == 1)) out->contour[out->count++] = c->contour[i];
    return FW_OK;
}

fw_status fw_geometry_graph_stitch(fw_geometry_graph *g, fw_geometry_region *out) {
    size_t nodes = (size_t)g->nnode, edges = (size_t)g->nedge; /* all written before it is read */
    int *first = fw_arena_raw(g->arena, nodes * sizeof *first);
    int *seen = fw_arena_raw(g->arena, nodes * sizeof *seen);
    int *after = fw_arena_raw(g->arena, edges * sizeof *after);
    chain path = {fw_arena_raw(g->arena, edges * sizeof *path.edge), 0};
    collector c = {g, fw_arena_raw(g->arena, edges * sizeof *c.contour),
                   fw_arena_raw(g->arena, edges * sizeof *c.hole), 0};
    if (!first || !seen || !after || !path.edge || !c.contour || !c.hole) return FW_NOMEM;
    for (int i = 0; i < g->nnode; i++)
        first[i] = seen[i] = -1;
    for (int i = g->nedge - 1; i >= 0; i--)
        if (g->edge[i].keep) {
            int node = edge_start(&g->edge[i]);
            after[i] = first[node];
            first[node] = i;
        }
    for (int i = 0; i < g->nedge; i++)
        if (g->edge[i].keep && !g->edge[i].used) FW_TRY(follow(&c, &path, seen, first, after, i));
    return order_outlines(g, &c, out);
}
