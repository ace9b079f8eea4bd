/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"
#include "geometry/polygon.h"
#include "base/sort.h"
#include <stdlib.h>

typedef struct trail { /* the outline being followed */
    int *edge;         /* (count) */
    int count;
} trail;

static int edge_start(const fw_geometry_edge *e) {
    return e->reversed ? e->to : e->from;
}
static int edge_end(const fw_geometry_edge *e) {
    return e->reversed ? e->from : e->to;
}

fw_geometry_segment fw_geometry_edge_segment(const fw_geometry_graph *g,
                                             const fw_geometry_edge *e) {
    fw_geometry_segment s = fw_geometry_segment_cut(g->segment[e->segment], e->t0, g->node[e->from],
                                                    e->t1, g->node[e->to]);
    return e->reversed ? fw_geometry_segment_reverse(&s) : s;
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

/* follows edges from `first_edge`; whenever a node comes again the loop since then is cut off.
   reached (nodes): edges of the path before it comes to a node, -1 where it does not */
static fw_status follow(collector *c, trail *path, int *reached, const int *first, const int *after,
                        int first_edge) {
    fw_geometry_graph *g = c->graph;
    int e = first_edge;
    path->count = 0;
    reached[edge_start(&g->edge[e])] = 0;
    while (true) {
        g->edge[e].used = true;
        path->edge[path->count++] = e;
        int node = edge_end(&g->edge[e]);
        if (reached[node] >= 0) {
            int from = reached[node];
            FW_TRY(emit(c, path->edge + from, path->count - from));
            for (int i = from; i < path->count; i++)
                if (i > from) reached[edge_start(&g->edge[path->edge[i]])] = -1;
            path->count = from;
            if (from == 0) {
                reached[node] = -1;
                return FW_OK;
            }
            e = path->edge[from - 1]; /* go on as if the loop had not been there */
        } else
            reached[node] = path->count;
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
    int *reached = fw_arena_raw(g->arena, nodes * sizeof *reached);
    int *after = fw_arena_raw(g->arena, edges * sizeof *after);
    trail path = {fw_arena_raw(g->arena, edges * sizeof *path.edge), 0};
    collector c = {g, fw_arena_raw(g->arena, edges * sizeof *c.contour),
                   fw_arena_raw(g->arena, edges * sizeof *c.hole), 0};
    if (!first || !reached || !after || !path.edge || !c.contour || !c.hole) return FW_NOMEM;
    for (int i = 0; i < g->nnode; i++)
        first[i] = reached[i] = -1;
    for (int i = g->nedge - 1; i >= 0; i--)
        if (g->edge[i].keep) {
            int node = edge_start(&g->edge[i]);
            after[i] = first[node];
            first[node] = i;
        }
    for (int i = 0; i < g->nedge; i++)
        if (g->edge[i].keep && !g->edge[i].used)
            FW_TRY(follow(&c, &path, reached, first, after, i));
    return order_outlines(g, &c, out);
}

/* Simplicity of a polygon by its monotone chains. A flattened outline has many edges and few turns:
   between a vertex where it stops running to the right and the next one where it starts again, its
   edges cannot meet each other, and only whole chains are compared. */

enum {
    MOST_ACTIVE = 2048, /* chains met by one vertical: beyond, the sweep over edges is cheaper */
    FEW_EVENTS = 24,    /* put into order one by one */
};

/* A vertex as one number that is ordered as (x, y): x 2^32 + y, exact for |x|, |y| < 2^30. */
typedef int64_t key;

typedef struct chain {
    int at, step;         /* the edge that the sweep is on, from key[at] to key[at + step] */
    int pair_at, pair_up; /* edges of this chain and of the next one above where they became
                             neighbours */
} chain;

typedef struct event {
    key at;
    int vertex;
    bool begins;
} event;

typedef struct sweep {
    const key *v;  /* (n + 1) from the least vertex on, and that one again */
    event *events; /* (nevent) */
    int nevent;
    chain *chain; /* (nevent): two for each vertex where chains begin */
    int *active;  /* (nevent, at most MOST_ACTIVE) chains that the vertical meets, from below */
    int nactive;
} sweep;

static inline key key_of(fw_geometry_point p) {
    return (key)p.x_dbu * ((key)1 << 32) + p.y_dbu;
}

static inline fw_geometry_point point_of(key k) {
    int32_t y = (int32_t)(uint32_t)((uint64_t)k & 0xffffffffu);
    return (fw_geometry_point){(int32_t)((k - y) / ((key)1 << 32)), y};
}

/* > 0: c lies above the edge from a to b, a before b */
static inline int64_t height(key a, key b, key c) {
    return fw_cross(point_of(a), point_of(b), point_of(c));
}

/* from the least vertex on, so that no chain runs over the end of the list */
static void rotate(const fw_geometry_polygon *p, key *v) {
    int least = 0, n = p->count;
    key first = key_of(p->vertex[0]);
    for (int i = 1; i < n; i++) {
        key k = key_of(p->vertex[i]);
        if (k < first) first = k, least = i;
    }
    for (int i = least; i < n; i++)
        *v++ = key_of(p->vertex[i]);
    for (int i = 0; i <= least; i++)
        *v++ = key_of(p->vertex[i]);
}

/* vertices where chains begin and end, an even number. Edges without length were refused before. */
static int count_events(const key *v, int n) {
    int count = 1; /* the least vertex, where the first two begin */
    bool up = v[1] > v[0];
    for (int i = 1; i < n; i++) {
        bool next = v[i + 1] > v[i];
        count += next != up;
        up = next;
    }
    return count;
}

static void find_events(sweep *s, int n) {
    const key *v = s->v;
    s->events[s->nevent++] = (event){v[0], 0, true};
    bool up = v[1] > v[0];
    for (int i = 1; i < n; i++) {
        bool next = v[i + 1] > v[i];
        if (next != up) s->events[s->nevent++] = (event){v[i], i, next};
        up = next;
    }
}

static int by_place(const void *left, const void *right) {
    return fw_order_wholes(((const event *)left)->at, ((const event *)right)->at);
}

static void sort_events(event *list, int n) {
    if (n > FEW_EVENTS) {
        qsort(list, (size_t)n, sizeof *list, by_place);
        return;
    }
    for (int i = 1; i < n; i++) {
        event e = list[i];
        int k = i;
        for (; k > 0 && list[k - 1].at > e.at; k--)
            list[k] = list[k - 1];
        list[k] = e;
    }
}

/* the two chains of the k-th beginning, upper one last; false: they leave in one direction */
static bool make_chains(sweep *s, int k, int vertex, int n) {
    chain on = {.at = vertex, .step = 1}, back = {.at = vertex > 0 ? vertex : n, .step = -1};
    int64_t turn = height(s->v[vertex], s->v[on.at + 1], s->v[back.at - 1]);
    s->chain[2 * k] = turn > 0 ? on : back;
    s->chain[2 * k + 1] = turn > 0 ? back : on;
    return turn != 0;
}

/* the chain at a place, on the edge that p is over */
static chain *current(sweep *s, int place, key p) {
    chain *c = &s->chain[s->active[place]];
    while (s->v[c->at + c->step] < p)
        c->at += c->step;
    return c;
}

/* lowest place among the active chains with nothing strictly below it at p */
static int place_of(sweep *s, key p) {
    int low = 0, high = s->nactive;
    while (low < high) {
        int middle = (low + high) / 2;
        const chain *c = current(s, middle, p);
        if (height(s->v[c->at], s->v[c->at + c->step], p) > 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Does the chain stay strictly below the next one, from where they became neighbours to p? Two
   lines of edges over one range are apart when every vertex of either is on its side of the other's
   edge. At p itself they may meet when both end there. */
static bool apart(const sweep *s, int below, key p) {
    const chain *low = &s->chain[s->active[below]], *up = &s->chain[s->active[below + 1]];
    const key *v = s->v;
    int i = low->pair_at, j = low->pair_up, di = low->step, dj = up->step;
    key a = v[i + di],
        b = v[j + dj]; /* where the two edges end, and as points from where to where */
    fw_geometry_point from_a = point_of(v[i]), from_b = point_of(v[j]), to_a = point_of(a),
                      to_b = point_of(b);
    for (;;) {
        if (a < b) {
            if (a > p) return true;
            if (fw_cross(from_b, to_b, to_a) >= 0) return false;
            if (a == p) return true;
            i += di;
            from_a = to_a, a = v[i + di], to_a = point_of(a);
        } else {
            if (b > p) return true;
            if (a == b) return a == p && i + di == j + dj;
            if (fw_cross(from_a, to_a, to_b) <= 0) return false;
            if (b == p) return true;
            j += dj;
            from_b = to_b, b = v[j + dj], to_b = point_of(b);
        }
    }
}

static void become_neighbours(sweep *s, int below, key p) {
    if (below < 0 || below + 1 >= s->nactive) return;
    chain *low = current(s, below, p);
    low->pair_at = low->at;
    low->pair_up = current(s, below + 1, p)->at;
}

static bool begin(sweep *s, int first, key p) {
    int place = place_of(s, p);
    if (s->nactive + 2 > MOST_ACTIVE) return false;
    if (place < s->nactive) {
        const chain *c = current(s, place, p);
        if (height(s->v[c->at], s->v[c->at + c->step], p) >= 0) return false; /* p lies on it */
        if (place > 0 && !apart(s, place - 1, p)) return false;
    }
    for (int i = s->nactive - 1; i >= place; i--)
        s->active[i + 2] = s->active[i];
    s->active[place] = first;
    s->active[place + 1] = first + 1;
    s->nactive += 2;
    for (int i = place - 1; i <= place + 1; i++)
        become_neighbours(s, i, p);
    return true;
}

/* both chains that end at p lie side by side and clear of their neighbours */
static bool finish(sweep *s, key p) {
    int place = place_of(s, p);
    if (place + 1 >= s->nactive) return false;
    for (int i = place; i <= place + 1; i++) {
        const chain *c = current(s, i, p);
        if (s->v[c->at + c->step] != p) return false;
    }
    for (int i = place - 1; i <= place + 1; i++)
        if (i >= 0 && i + 1 < s->nactive && !apart(s, i, p)) return false;
    s->nactive -= 2;
    for (int i = place; i < s->nactive; i++)
        s->active[i] = s->active[i + 2];
    become_neighbours(s, place - 1, p);
    return true;
}

static bool sweep_chains(sweep *s, int n) {
    int begun = 0;
    for (int i = 0; i < s->nevent; i++) {
        const event *e = &s->events[i];
        if (i > 0 && s->events[i - 1].at == e->at) return false; /* two vertices at one place */
        if (!e->begins) {
            if (!finish(s, e->at)) return false;
            continue;
        }
        if (!make_chains(s, begun, e->vertex, n) || !begin(s, 2 * begun, e->at)) return false;
        begun++;
    }
    return s->nactive == 0;
}

/* Is the polygon simple? Shamos and Hoey's sweep (1976) with monotone chains instead of edges: a
   chain cannot meet itself; the order of chains along the sweep line changes only where chains
   begin or end; two chains can meet first only while they are neighbours there, and each such pair
   is followed over exactly the range where they are. Verticals run as if leaning by nothing: points
   are ordered by x, then y. In: n vertices (dbu), |coordinate| < 2^30. Out: *proved. Exact: 64-bit
   integers. Cost O(n + k log k) for k chains, at most MOST_ACTIVE of them over one another; 24
   bytes a vertex at most. Source: Shamos and Hoey, "Geometric intersection problems", FOCS 1976;
   Park and Shin, Computer-Aided Design 34 (2002) 655, for chains. Test: test_polygon.c, against all
   pairs and the sweep over edges. */
fw_status fw_geometry_polygon_prove(fw_arena *arena, const fw_geometry_polygon *polygon,
                                    bool *proved) {
    int n = polygon->count;
    *proved = false;
    fw_mark mark = fw_arena_mark(arena);
    key *v = fw_arena_raw(arena, ((size_t)n + 1) * sizeof *v); /* written before it is read */
    FW_NEED(v);
    rotate(polygon, v);
    size_t most = (size_t)count_events(v, n), active = most < MOST_ACTIVE ? most : MOST_ACTIVE;
    sweep s = {.v = v,
               .events = fw_arena_raw(arena, most * sizeof(event)),
               .chain = fw_arena_raw(arena, most * sizeof(chain)),
               .active = fw_arena_raw(arena, active * sizeof(int))};
    FW_NEED(s.events);
    FW_NEED(s.chain);
    FW_NEED(s.active);
    find_events(&s, n);
    sort_events(s.events, s.nevent);
    *proved = sweep_chains(&s, n);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
