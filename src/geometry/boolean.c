/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact boolean of outlines of lines and arcs: cut both at all common points, keep the parts that
   bound the result, stitch them. Nothing is flattened. */
#include "geometry/segment.h"
#include <stdint.h>
#include <string.h>

/* Number of the strip of 1 nm that a coordinate lies in, points of the grid in its middle: nearest
   whole number of nanometres, left in the lowest bits of the sum; never decreasing, whatever x is.
 */
static uint64_t strip_of(double x) {
    double shifted = x * 1e9 + 6755399441055744.0;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    return bits;
}

static int *head_at(const fw_geometry_graph *g, uint64_t x, uint64_t y) {
    uint64_t h = (x ^ (y << 32 | y >> 32)) * UINT64_C(0x9e3779b97f4a7c15);
    return &g->head[(unsigned)(h >> 32) & (g->heads - 1)];
}

/* The earliest node within the tolerance, or -1. What is that near lies in the strips of x and y
   less and more the tolerance: one square, but at its rim. Cost O(1). */
static int find_node(const fw_geometry_graph *g, fw_geometry_vec2 at) {
    const double wider = 2 * FW_COINCIDENT_M;
    const uint64_t x[2] = {strip_of(at.x - wider), strip_of(at.x + wider)};
    const uint64_t y[2] = {strip_of(at.y - wider), strip_of(at.y + wider)};
    int found = -1;
    for (int k = 0; k < 4; k++) {
        if ((k & 1 && x[0] == x[1]) || (k & 2 && y[0] == y[1])) continue;
        for (int i = *head_at(g, x[k & 1], y[k >> 1]); i >= 0; i = g->next[i])
            if (fabs(g->node[i].x - at.x) <= FW_COINCIDENT_M &&
                vec_distance(g->node[i], at) <= FW_COINCIDENT_M && (found < 0 || i < found))
                found = i;
    }
    return found;
}

static fw_status new_node(fw_geometry_graph *g, fw_geometry_vec2 at, int *node) {
    if (g->nnode == g->node_room) {
        int more = 2 * g->node_room;
        fw_geometry_vec2 *grown =
            fw_arena_grow(g->arena, g->node, (size_t)g->nnode, (size_t)more, sizeof *grown);
        int *same = fw_arena_grow(g->arena, g->same, (size_t)g->nnode, (size_t)more, sizeof *same);
        int *next = fw_arena_grow(g->arena, g->next, (size_t)g->nnode, (size_t)more, sizeof *next);
        FW_NEED(grown);
        FW_NEED(same);
        FW_NEED(next);
        g->node = grown;
        g->same = same;
        g->next = next;
        g->node_room = more;
    }
    int *head = head_at(g, strip_of(at.x), strip_of(at.y));
    g->next[g->nnode] = *head;
    *head = g->nnode;
    *node = g->same[g->nnode] = g->nnode;
    g->node[g->nnode++] = at;
    return FW_OK;
}

/* the node at a place, made when there is none within the tolerance */
static fw_status node_at(fw_geometry_graph *g, fw_geometry_vec2 at, int *node) {
    /* one segment begins where the last one ended: what is found first does not change */
    bool again = g->nnode > 0 && at.x == g->asked.x && at.y == g->asked.y;
    *node = again ? g->answer : find_node(g, at);
    if (*node < 0) FW_TRY(new_node(g, at, node));
    g->asked = at;
    g->answer = *node;
    return FW_OK;
}

static int root_of(const fw_geometry_graph *g, int node) {
    while (g->same[node] != node)
        node = g->same[node];
    return node;
}

/* two places that a segment cannot tell apart are one node, the earlier */
static void unite(fw_geometry_graph *g, int a, int b) {
    a = root_of(g, a);
    b = root_of(g, b);
    g->same[a > b ? a : b] = a > b ? b : a;
}

static fw_status add_cut(fw_geometry_graph *g, int segment, double t, int node) {
    if (g->ncut == g->cut_room) {
        int more = 2 * g->cut_room;
        fw_geometry_cut *grown =
            fw_arena_grow(g->arena, g->cut, (size_t)g->ncut, (size_t)more, sizeof *grown);
        FW_NEED(grown);
        g->cut = grown;
        g->cut_room = more;
    }
    g->cut[g->ncut++] = (fw_geometry_cut){segment, node, t};
    return FW_OK;
}

static int count_segments(const fw_geometry_region *region) {
    int n = 0;
    for (int i = 0; i < region->count; i++)
        n += region->contour[i].count;
    return n;
}

/* room for the nodes and cuts of all ends and of some crossings */
static fw_status make_room(fw_geometry_graph *g) {
    size_t n = (size_t)g->nsegment;
    for (g->heads = 16; g->heads < n;)
        g->heads *= 2;
    FW_NEED(g->segment = fw_arena_raw(g->arena, n * sizeof *g->segment));
    FW_NEED(g->head = fw_arena_raw(g->arena, g->heads * sizeof *g->head));
    memset(g->head, -1, g->heads * sizeof *g->head);
    g->cut_room = 2 * g->nsegment + 32;
    FW_NEED(g->cut = fw_arena_raw(g->arena, (size_t)g->cut_room * sizeof *g->cut));
    g->node_room = g->nsegment + 16;
    FW_NEED(g->node = fw_arena_raw(g->arena, (size_t)g->node_room * sizeof *g->node));
    FW_NEED(g->same = fw_arena_raw(g->arena, (size_t)g->node_room * sizeof *g->same));
    FW_NEED(g->next = fw_arena_raw(g->arena, (size_t)g->node_room * sizeof *g->next));
    return FW_OK;
}

/* every segment with cuts at its own two ends; ends of p come first and keep their doubles */
static fw_status collect(fw_geometry_graph *g, const fw_geometry_region *p,
                         const fw_geometry_region *q) {
    g->nfirst = count_segments(p);
    g->nsegment = g->nfirst + count_segments(q);
    FW_TRY(make_room(g));
    int n = 0;
    for (int side = 0; side < 2; side++) {
        const fw_geometry_region *region = side ? q : p;
        for (int i = 0; i < region->count; i++) {
            if (!fw_geometry_contour_valid(&region->contour[i])) return FW_GEOMETRY;
            for (int k = 0; k < region->contour[i].count; k++)
                g->segment[n++] = &region->contour[i].segment[k];
        }
    }
    for (int i = 0; i < g->nsegment; i++) {
        int node;
        FW_TRY(node_at(g, g->segment[i]->a, &node));
        FW_TRY(add_cut(g, i, 0, node));
        FW_TRY(node_at(g, g->segment[i]->b, &node));
        FW_TRY(add_cut(g, i, 1, node));
    }
    return FW_OK;
}

/* a cut inside a segment; at its very end the node is united with that end */
static fw_status cut_at(fw_geometry_graph *g, int segment, double t, int node) {
    double length = fw_geometry_segment_length(g->segment[segment]);
    if (t * length <= FW_COINCIDENT_M)
        unite(g, node, g->cut[2 * segment].node);
    else if ((1 - t) * length <= FW_COINCIDENT_M)
        unite(g, node, g->cut[2 * segment + 1].node);
    else
        return add_cut(g, segment, t, node);
    return FW_OK;
}

static fw_geometry_box box_of(const fw_geometry_box *box, int from, int to) {
    fw_geometry_box all = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = from; i < to; i++)
        all = fw_box_join(all, box[i]);
    return all;
}

static fw_status intersect_all(fw_geometry_graph *g) {
    fw_geometry_box *box = fw_arena_raw(g->arena, (size_t)g->nsegment * sizeof *box);
    FW_NEED(g->own = box);
    for (int i = 0; i < g->nsegment; i++)
        box[i] = fw_segment_box(g->segment[i]);
    g->box[0] = box_of(box, 0, g->nfirst);
    g->box[1] = box_of(box, g->nfirst, g->nsegment);
    for (int i = 0; i < g->nfirst; i++) {
        if (fw_box_gap(box[i], g->box[1]) > FW_COINCIDENT_M) continue;
        for (int j = g->nfirst; j < g->nsegment; j++) {
            if (fw_box_apart(&box[i], &box[j], 2 * FW_COINCIDENT_M)) continue;
            if (fw_box_gap(box[i], box[j]) > FW_COINCIDENT_M) continue;
            fw_geometry_hit hit[FW_MOST_HITS];
            int n = fw_geometry_segment_intersect(g->segment[i], g->segment[j], hit);
            for (int k = 0; k < n; k++) {
                int node;
                FW_TRY(node_at(g, hit[k].at, &node));
                FW_TRY(cut_at(g, i, hit[k].tp, node));
                FW_TRY(cut_at(g, j, hit[k].tq, node));
            }
        }
    }
    return FW_OK;
}

static bool before(const fw_geometry_cut *a, const fw_geometry_cut *b) {
    return a->t != b->t ? a->t < b->t : a->node < b->node;
}

/* by segment, place and node: counted into the segments, put into order there, where there are few
 */
static fw_status sort_cuts(fw_geometry_graph *g) {
    if (g->ncut == 2 * g->nsegment) return FW_OK; /* the two ends of each */
    int *begin = fw_arena_array(g->arena, int, (size_t)g->nsegment + 1);
    int *there = fw_arena_array(g->arena, int, (size_t)g->nsegment);
    fw_geometry_cut *sorted = fw_arena_array(g->arena, fw_geometry_cut, (size_t)g->ncut);
    if (!begin || !there || !sorted) return FW_NOMEM;
    for (int i = 0; i < g->ncut; i++)
        begin[g->cut[i].segment + 1]++;
    for (int i = 0; i < g->nsegment; i++)
        begin[i + 1] += begin[i];
    for (int i = 0; i < g->ncut; i++) {
        const fw_geometry_cut *c = &g->cut[i];
        int first = begin[c->segment], at = first + there[c->segment]++;
        for (; at > first && before(c, &sorted[at - 1]); at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = *c;
    }
    g->cut = sorted;
    return FW_OK;
}

static fw_status cut_edges(fw_geometry_graph *g) {
    for (int i = 0; i < g->ncut; i++)
        g->cut[i].node = root_of(g, g->cut[i].node);
    FW_TRY(sort_cuts(g));
    g->edge = fw_arena_raw(g->arena, (size_t)g->ncut * sizeof *g->edge);
    FW_NEED(g->edge);
    for (int i = 1, rank = 0; i < g->ncut; i++) {
        const fw_geometry_cut *a = &g->cut[i - 1], *b = &g->cut[i];
        if (a->segment != b->segment) {
            rank = 0;
            continue;
        }
        const fw_geometry_segment *s = g->segment[a->segment];
        double length = fw_geometry_segment_length(s) * (b->t - a->t);
        /* a closed circle may run from a node to itself, a stub within the tolerance may not */
        if (a->node == b->node && length <= 8 * FW_COINCIDENT_M) continue;
        g->edge[g->nedge++] = (fw_geometry_edge){.segment = a->segment,
                                                 .rank = rank++,
                                                 .owner = a->segment < g->nfirst ? 0 : 1,
                                                 .from = a->node,
                                                 .to = b->node,
                                                 .t0 = a->t,
                                                 .t1 = b->t,
                                                 .twin = -1};
    }
    return FW_OK;
}

static fw_geometry_vec2 middle_of(const fw_geometry_graph *g, const fw_geometry_edge *e) {
    fw_geometry_segment s = fw_geometry_edge_segment(g, e);
    return fw_geometry_segment_point(&s, 0.5);
}

/* edges of p and q between the same nodes along the same path; *same: in the same direction */
static bool is_twin(const fw_geometry_graph *g, const fw_geometry_edge *a,
                    const fw_geometry_edge *b, bool *same) {
    if (a->from == b->from && a->to == b->to)
        *same = true;
    else if (a->from == b->to && a->to == b->from)
        *same = false;
    else
        return false;
    if (a->from == a->to)
        *same = (g->segment[a->segment]->sweep_rad > 0) == (g->segment[b->segment]->sweep_rad > 0);
    return vec_distance(middle_of(g, a), middle_of(g, b)) <= 8 * FW_COINCIDENT_M;
}

/* outside the box nothing winds around a point */
static bool may_hold(fw_geometry_box b, fw_geometry_vec2 p) {
    const double wider = 1e-9;
    return p.x >= b.x0 - wider && p.x <= b.x1 + wider && p.y >= b.y0 - wider && p.y <= b.y1 + wider;
}

/* own: boxes of the region's segments, outline by outline; of many outlines few are near a point */
static int region_winding(const fw_geometry_region *region, const fw_geometry_box *own,
                          fw_geometry_vec2 point) {
    int winding = 0;
    for (int i = 0; i < region->count; i++) {
        const fw_geometry_contour *c = &region->contour[i];
        if (region->count == 1 || may_hold(box_of(own, 0, c->count), point))
            winding += fw_geometry_contour_winding(c, point);
        own += c->count;
    }
    return winding;
}

/* Does the other region hold the middle of an edge? Where all of its segment is clear of that
   region's box the middle is not worked out. */
static bool is_within(const fw_geometry_graph *g, const fw_geometry_edge *e,
                      const fw_geometry_region *other) {
    const fw_geometry_box *box = &g->box[!e->owner];
    if (fw_box_gap(g->own[e->segment], *box) > 2e-9) return false;
    fw_geometry_vec2 middle = middle_of(g, e);
    return may_hold(*box, middle) &&
           region_winding(other, g->own + (e->owner ? 0 : g->nfirst), middle) != 0;
}

/* which edges bound the result, and in which direction */
static void choose(fw_geometry_edge *e, bool within, fw_geometry_boolean op) {
    if (op == FW_UNION)
        e->keep = !within;
    else if (op == FW_INTERSECTION)
        e->keep = within;
    else {
        e->keep = e->owner == 0 ? !within : within;
        e->reversed = e->owner == 1;
    }
}

/* Twins are among the edges with the same lower node, listed in their order. Shared edges bound a
   union or an intersection once when both regions lie on one side, never when on either side; a
   difference the other way round. The copy of p is kept, with its flags. */
static fw_status pair_twins(fw_geometry_graph *g, fw_geometry_boolean op) {
    int *first = fw_arena_raw(g->arena, (size_t)g->nnode * sizeof *first);
    int *after = fw_arena_raw(g->arena, (size_t)g->nedge * sizeof *after);
    FW_NEED(first);
    FW_NEED(after);
    for (int i = 0; i < g->nnode; i++)
        first[i] = -1;
    for (int i = g->nedge - 1; i >= 0; i--) {
        const fw_geometry_edge *e = &g->edge[i];
        int low = e->from < e->to ? e->from : e->to;
        after[i] = first[low];
        first[low] = i;
    }
    for (int i = 0; i < g->nedge; i++)
        for (int j = after[i]; j >= 0; j = after[j]) {
            fw_geometry_edge *a = &g->edge[i], *b = &g->edge[j];
            bool same;
            if (a->owner == b->owner || a->twin >= 0 || b->twin >= 0 || !is_twin(g, a, b, &same))
                continue;
            a->twin = j;
            b->twin = i;
            a->keep = same == (op != FW_DIFFERENCE); /* a is of p: its edges come first */
        }
    return FW_OK;
}

/* Boolean of two regions: (1) cut every segment at its common points with the other region, nodes
   within 1e-12 m are one; (2) an edge bounds the result by the winding number of its midpoint about
   the other region, coincident edges by rule; (3) stitch. In: regions (outer ccw, holes cw, m).
   Out: the same kind of region. Untouched segments keep their doubles and flags.
   Cost: O(n m + n (n + m)). Test: test_boolean.c. */
fw_status fw_geometry_region_boolean(fw_arena *arena, const fw_geometry_region *p,
                                     const fw_geometry_region *q, fw_geometry_boolean op,
                                     fw_geometry_region *out) {
    *out = (fw_geometry_region){0};
    fw_geometry_graph g = {.arena = arena};
    FW_TRY(collect(&g, p, q));
    if (g.nsegment == 0) return FW_OK;
    FW_TRY(intersect_all(&g));
    FW_TRY(cut_edges(&g));
    FW_TRY(pair_twins(&g, op));
    for (int i = 0; i < g.nedge; i++)
        if (g.edge[i].twin < 0)
            choose(&g.edge[i], is_within(&g, &g.edge[i], g.edge[i].owner ? p : q), op);
    return fw_geometry_graph_stitch(&g, out);
}
