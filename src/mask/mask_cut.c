/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far a straight cut stays from everything else of a polygon. Private to the room. */
#include "geometry/polygon.h"
#include "mask/mask_parts.h"
#include <math.h>
#include <string.h>

typedef struct cut_box { /* dbu */
    double x0, y0, x1, y1;
} cut_box;

typedef struct cut_tree { /* boxes of runs of edges: node k holds nodes 2k and 2k + 1 */
    const fw_geometry_polygon *polygon;
    cut_box *box; /* (2 leaves), from 1 on */
    int leaves;   /* a power of two */
} cut_tree;

enum { RUN = 8 }; /* edges of a leaf */

/* twice the area of a triangle: exact, |coordinate| < 2^30 */
static int64_t cut_cross(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - a.y_dbu) -
           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - a.x_dbu);
}

/* from the segment between a and b to c */
static double cut_distance(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
    double u = (double)c.x_dbu - a.x_dbu, w = (double)c.y_dbu - a.y_dbu;
    double t = fw_lesser(1, fw_greater(0, (x * u + y * w) / (x * x + y * y)));
    double dx = u - t * x, dy = w - t * y;
    return sqrt(dx * dx + dy * dy);
}

static cut_box join(cut_box a, cut_box b) {
    return (cut_box){fw_lesser(a.x0, b.x0), fw_lesser(a.y0, b.y0), fw_greater(a.x1, b.x1),
                     fw_greater(a.y1, b.y1)};
}

static fw_status cut_tree_new(fw_arena *arena, const fw_geometry_polygon *polygon, cut_tree *tree) {
    int n = polygon->count, leaves = 1;
    while (leaves * RUN < n)
        leaves *= 2;
    *tree = (cut_tree){.polygon = polygon, .leaves = leaves};
    FW_NEED(tree->box = fw_arena_array(arena, cut_box, 2 * (size_t)leaves));
    for (int k = 0; k < leaves; k++) {
        cut_box *b = &tree->box[leaves + k];
        *b = (cut_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (int e = k * RUN; e <= (k + 1) * RUN && e <= n && k * RUN < n; e++) {
            fw_geometry_point v = polygon->vertex[e < n ? e : 0];
            *b = join(*b, (cut_box){v.x_dbu, v.y_dbu, v.x_dbu, v.y_dbu});
        }
    }
    for (int k = leaves - 1; k > 0; k--)
        tree->box[k] = join(tree->box[2 * k], tree->box[2 * k + 1]);
    return FW_OK;
}

typedef struct query {
    const cut_tree *tree;
    int i, j;
    fw_geometry_point a, b;
    cut_box box;         /* of the segment */
    double x, y, length; /* its direction, not normed */
    double least, now;   /* what need not be undercut; what was found so far */
    double
        line; /* beside the segment's line a vertex with a product beyond that is farther than `now` */
    int near; /* number of the vertex, or of the edge behind it, that set `now`; -1: none */
} query;

/* no more than the distance between the segment and a box: that of their boxes along an axis, and
   that of the box from the line */
static double at_least(const query *q, cut_box b) {
    double gap_x = fw_greater(b.x0 - q->box.x1, q->box.x0 - b.x1);
    double gap_y = fw_greater(b.y0 - q->box.y1, q->box.y0 - b.y1);
    if (gap_x > q->now || gap_y > q->now) return HUGE_VAL;
    double cx = 0.5 * (b.x0 + b.x1) - q->a.x_dbu, cy = 0.5 * (b.y0 + b.y1) - q->a.y_dbu;
    double reach = 0.5 * ((b.x1 - b.x0) * fabs(q->y) + (b.y1 - b.y0) * fabs(q->x));
    double beside = (fabs(q->x * cy - q->y * cx) - reach) / q->length;
    return fw_greater(beside, fw_greater(gap_x, gap_y));
}

static bool between(fw_geometry_point a, fw_geometry_point b,
                    fw_geometry_point c) { /* c on the line through a and b */
    int64_t dot = ((int64_t)c.x_dbu - a.x_dbu) * ((int64_t)c.x_dbu - b.x_dbu);
    int64_t more = ((int64_t)c.y_dbu - a.y_dbu) * ((int64_t)c.y_dbu - b.y_dbu);
    return dot <= 0 && more <= 0;
}

static bool meet(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c,
                 fw_geometry_point d) {
    int64_t abc = cut_cross(a, b, c), abd = cut_cross(a, b, d);
    if ((abc > 0 && abd > 0) || (abc < 0 && abd < 0)) return false;
    int64_t cda = cut_cross(c, d, a), cdb = cut_cross(c, d, b);
    if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc && abd && cda && cdb)
        return true;
    return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) ||
           (cda == 0 && between(c, d, a)) || (cdb == 0 && between(c, d, b));
}

/* with what is lost in it */
static void nearer(query *q, double now) {
    q->now = now;
    q->line = now * q->length * (1 + 1e-9);
}

/* vertex k, and the edge behind it */
static void look(query *q, int k) {
    const fw_geometry_polygon *p = q->tree->polygon;
    const int next = k + 1 < p->count ? k + 1 : 0;
    const bool own = k == q->i || k == q->j, next_own = next == q->i || next == q->j;
    const double beside = q->x * ((double)p->vertex[k].y_dbu - q->a.y_dbu) -
                          q->y * ((double)p->vertex[k].x_dbu - q->a.x_dbu);
    const double far =
        own || fabs(beside) > q->line ? HUGE_VAL : cut_distance(q->a, q->b, p->vertex[k]);
    if (far < q->now) q->near = k, nearer(q, far);
    if (!own && !next_own && meet(q->a, q->b, p->vertex[k], p->vertex[next]))
        q->now = -1, q->near = k;
}

static void leaf(query *q, int run) {
    for (int k = run * RUN; k < (run + 1) * RUN && k < q->tree->polygon->count; k++) {
        look(q, k);
        if (q->now <= q->least) return;
    }
}

static void visit(query *q, int node) {
    if (at_least(q, q->tree->box[node]) > q->now) return;
    if (node >= q->tree->leaves) {
        leaf(q, node - q->tree->leaves);
        return;
    }
    for (int side = 0; side < 2 && q->now > q->least; side++)
        visit(q, 2 * node + side);
}

/* Search down a tree of boxes (Guttman 1984, "R-trees", here over runs of a chain). In: a polygon
   and two of its vertices (dbu). Out: the distance (dbu). Error: whether edges meet is exact;
   distances have some ulp of the coordinates. Cost: about ln n boxes where little is near. *blocked: the edge,
   or its first vertex, that refused. Test: test_polygon_cut.c, against all vertices. */
static double cut_clearance(const cut_tree *tree, int i, int j, double least, double most,
                            int *blocked) {
    fw_geometry_point a = tree->polygon->vertex[i], b = tree->polygon->vertex[j];
    query q = {.tree = tree,
               .i = i,
               .j = j,
               .a = a,
               .b = b,
               .box = join((cut_box){a.x_dbu, a.y_dbu, a.x_dbu, a.y_dbu},
                           (cut_box){b.x_dbu, b.y_dbu, b.x_dbu, b.y_dbu}),
               .x = (double)b.x_dbu - a.x_dbu,
               .y = (double)b.y_dbu - a.y_dbu,
               .least = least,
               .near = -1};
    q.length = hypot(q.x, q.y);
    nearer(&q, most);
    if (q.length > 0) visit(&q, 1);
    if (q.now <= least) *blocked = q.near;
    return q.now;
}

/* Nothing below is worth asking for: a quarter of the spot of a fine laser writer. */
static const double CLEAR_DBU = 50;
enum { SAMPLES = 1024, REFUSED = 8 };

/* Edges at a vertex: what a line from there must have on its left to leave into the polygon, of both where it is no
   hollow corner. */
typedef struct cone {
    fw_geometry_point v;
    int64_t in_x, in_y, out_x, out_y;
    bool hollow;
} cone;

typedef struct search {
    const fw_geometry_polygon *p;
    cut_tree tree;
    const int *sample; /* (nsample) vertices at which cuts may end, in order */
    int nsample;
    double wanted_dbu; /* distance from all other vertices; 0: the larger, the better */
    int least;         /* vertices that lie on either side at least */
    int peel;          /* 0; else one side has no more edges, the cut not counted */
    int tried; /* 0; else pairs with as many edges on either side were tried with the same distance in vain */
    int i, j;   /* best so far; -1: none */
    cone *cone; /* (nsample) of each sample */
    int *way;   /* (nsample) edge that refused the last cut to it; -1: none */
    int refused[REFUSED],
        nrefused;             /* edges that refused cuts before, the last of them at nrefused - 1 */
    double least2, clear_dbu; /* its length, its distance */
} search;

static fw_geometry_point at(const fw_geometry_polygon *p, int i) {
    return p->vertex[i < 0 ? i + p->count : i < p->count ? i : i - p->count];
}

static double length2(fw_geometry_point a, fw_geometry_point b) {
    double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
    return x * x + y * y;
}

static cone cone_of(const fw_geometry_polygon *p, int i) {
    fw_geometry_point v = at(p, i), before = at(p, i - 1), after = at(p, i + 1);
    return (cone){v,
                  (int64_t)v.x_dbu - before.x_dbu,
                  (int64_t)v.y_dbu - before.y_dbu,
                  (int64_t)after.x_dbu - v.x_dbu,
                  (int64_t)after.y_dbu - v.y_dbu,
                  cut_cross(before, v, after) <= 0};
}

/* does the line from there to q leave into the polygon? Exact */
static bool enters(const cone *c, fw_geometry_point q) {
    const int64_t x = (int64_t)q.x_dbu - c->v.x_dbu, y = (int64_t)q.y_dbu - c->v.y_dbu;
    const bool left_of_out = c->out_x * y - c->out_y * x > 0,
               left_of_in = c->in_x * y - c->in_y * x > 0;
    return c->hollow ? left_of_out || left_of_in : left_of_out && left_of_in;
}

/* does the line from vertex i to q run over one of the edges there? */
static bool along(const fw_geometry_polygon *p, int i, fw_geometry_point q) {
    for (int side = -1; side <= 1; side += 2) {
        fw_geometry_point v = at(p, i), w = at(p, i + side);
        int64_t x = ((int64_t)w.x_dbu - v.x_dbu) * ((int64_t)q.x_dbu - v.x_dbu);
        int64_t y = ((int64_t)w.y_dbu - v.y_dbu) * ((int64_t)q.y_dbu - v.y_dbu);
        if (cut_cross(v, w, q) == 0 && x >= 0 && y >= 0) return true;
    }
    return false;
}

/* is edge k in the way of the line between two vertices? k -1: there is none */
static bool crosses(const fw_geometry_polygon *p, int i, int j, int k) {
    const int next = k + 1 < p->count ? k + 1 : 0;
    return k >= 0 && k != i && k != j && next != i && next != j &&
           meet(p->vertex[i], p->vertex[j], p->vertex[k], p->vertex[next]);
}

/* What was in the way of their neighbours is in most cases. */
static bool refused(const search *s, int i, int m) {
    const int j = s->sample[m];
    for (int k = 0; k < s->nrefused && k < REFUSED; k++)
        if (crosses(s->p, i, j, s->refused[(s->nrefused - 1 - k) % REFUSED])) return true;
    return crosses(s->p, i, j, s->way[m]);
}

/* Distance of the line between two samples from all other vertices where it lies strictly inside and this
   is more than `least`; else a number up to it. The four vertices beside its ends first: they are
   nearest most often. */
static double clearance(search *s, int k, int m, double least, double most) {
    const fw_geometry_polygon *p = s->p;
    const int i = s->sample[k], j = s->sample[m];
    fw_geometry_point a = s->cone[k].v, b = s->cone[m].v;
    if (!enters(&s->cone[k], b) || !enters(&s->cone[m], a)) return -1;
    if (refused(s, i, m)) return -1;
    double clear = most;
    const int beside[4] = {i - 1, i + 1, j - 1, j + 1};
    for (int side = 0; side < 4; side++) {
        clear = fw_lesser(clear, cut_distance(a, b, at(p, beside[side])));
        if (clear <= least) return clear;
    }
    if (along(p, i, b) || along(p, j, a)) return -1;
    int blocked = -1;
    clear = cut_clearance(&s->tree, i, j, least, clear, &blocked);
    if (blocked >= 0) s->way[m] = s->refused[s->nrefused++ % REFUSED] = blocked;
    return clear;
}

/* Samples that are no ends of a cut from vertex i, in the middle of those that leave enough on either side: they were
   tried, or would leave too much on both. */
static void left_out(const search *s, int i, int *low, int *high) {
    const int n = s->p->count;
    *low = i + n, *high = i;
    if (s->tried) *low = i + s->tried, *high = i + n - s->tried;
    if (s->peel && i + s->peel + 1 < *low) *low = i + s->peel + 1, *high = i + n - s->peel - 1;
}

/* the shortest cut that keeps the distance wanted; where none is, that of the largest distance */
static void search_cut(search *s) {
    int n = s->p->count, least = s->least;
    for (int k = 0, far = 0, behind = 0; k < s->nsample; k++) {
        int i = s->sample[k], low, high;
        left_out(s, i, &low, &high);
        while (far < s->nsample && s->sample[far] < i + least)
            far++;
        while (behind < s->nsample && s->sample[behind] <= high)
            behind++;
        for (int m = far; m < s->nsample && s->sample[m] <= i + n - least; m++) {
            if (s->sample[m] >= low && m < behind) m = behind;
            if (m == s->nsample || s->sample[m] > i + n - least) break;
            double l2 = length2(s->cone[k].v, s->cone[m].v), most = HUGE_VAL, more = s->clear_dbu;
            if (s->wanted_dbu > 0) {
                if (!(l2 < s->least2)) continue;
                most = s->wanted_dbu;
                more = most * (1 - 1e-12);
            }
            double clear = clearance(s, k, m, more, most);
            if (!(clear > more)) continue;
            s->least2 = l2;
            s->clear_dbu = clear;
            s->i = i;
            s->j = s->sample[m];
        }
    }
}

/* Where an outline begins to be something else: the lengths of the edges differ by half, or it
   turns by more than 30 degrees. Such ends of straight edges take cuts at any angle. */
static bool is_end(const fw_geometry_polygon *p, int i) {
    fw_geometry_point v = at(p, i), before = at(p, i - 1), after = at(p, i + 1);
    double in2 = length2(before, v), out2 = length2(v, after);
    double turn = (double)cut_cross(before, v, after);
    return in2 > 2.25 * out2 || out2 > 2.25 * in2 || turn * turn > 0.25 * in2 * out2;
}

/* what is asked of every sample */
static fw_status look_at_samples(fw_arena *arena, search *s) {
    FW_NEED(s->way = fw_arena_array(arena, int, (size_t)s->nsample + 1));
    FW_NEED(s->cone = fw_arena_array(arena, cone, (size_t)s->nsample + 1));
    for (int m = 0; m < s->nsample; m++)
        s->cone[m] = cone_of(s->p, s->sample[m]);
    return FW_OK;
}

/* All vertices of a small polygon; of a large one the ends of straight edges, and of the others as
   many, evenly. */
static fw_status sample(fw_arena *arena, const fw_geometry_polygon *p, search *s) {
    int n = p->count, ends = 0;
    int *list = fw_arena_array(arena, int, (size_t)n);
    FW_NEED(list);
    for (int i = 0; i < n && n > SAMPLES; i++)
        ends += is_end(p, i);
    int every_end = ends / (SAMPLES / 2) + 1, room = SAMPLES - ends / every_end;
    int every = n > SAMPLES ? (n - ends) / room + 1 : 1;
    s->nsample = 0;
    for (int i = 0, end = 0, other = 0; i < n; i++) {
        bool take = n <= SAMPLES || (is_end(p, i) ? end++ % every_end == 0 : other++ % every == 0);
        if (take) list[s->nsample++] = i;
    }
    s->sample = list;
    return look_at_samples(arena, s);
}

static fw_status all(fw_arena *arena, const fw_geometry_polygon *p, search *s) {
    int *list = fw_arena_array(arena, int, (size_t)p->count);
    FW_NEED(list);
    for (int i = 0; i < p->count; i++)
        list[i] = i;
    s->sample = list;
    s->nsample = p->count;
    return look_at_samples(arena, s);
}

/* How to go about it: a quarter or a third on either side at least, or parts of half the number to
   the full one taken off one by one. The latter leaves the fewest slivers: its parts are as large
   as they may be, and a part along an arc is the better the more of the arc it has. */
typedef struct manner {
    int share;
    bool peel;
} manner;
static const manner manners[] = {{4, true}, {4, false}, {3, false}, {8, false}};
enum { PEELED = 64 }; /* parts at most; a larger polygon is halved first, so that n ln n remains */

/* Shortest straight cut that keeps wanted_dbu to all vertices but its own and leaves at least a
   quarter of the vertices on either side, or less where only that keeps the distance: a neck, where
   there is one. Where no cut keeps it (a disc of equal chords has none whose sides are below 128
   degrees), the one that keeps most. In: a simple polygon, counter-clockwise. Out: numbers of the
   two vertices, the distance (dbu). Every polygon has a cut inside it with at least n / 3 edges on
   either side (the middle edge of the tree of any triangulation), so the last search, over all
   pairs, finds one. Cost: O(n) for the boxes and at most SAMPLES^2 / 2 pairs, of which only those
   that are shorter than the best are looked at, in O(ln n); only where that finds nothing, all
   pairs. Exact integers decide what is inside. Test: test_polygon_cut.c. */
static fw_status find(fw_arena *arena, const fw_geometry_polygon *p, double wanted_dbu, int most,
                      manner how, search *s) {
    static const struct {
        bool wanted, all;
        int part; /* of the share */
    } rounds[] = {
        {true, false, 1},  {true, false, 2},  {true, false, 4}, {true, false, 8},
        {false, false, 2}, {false, false, 8}, {false, true, 1},
    };
    *s = (search){.p = p, .i = -1, .j = -1};
    FW_TRY(cut_tree_new(arena, p, &s->tree));
    FW_TRY(sample(arena, p, s));
    for (size_t k = 0; k < sizeof rounds / sizeof *rounds && s->i < 0; k++) {
        if (rounds[k].all) FW_TRY(all(arena, p, s));
        bool peel = how.peel && !rounds[k].all && p->count / PEELED < most;
        int of = peel && 2 * most < p->count ? 2 * most : p->count;
        s->peel = peel ? most - 1 : 0;
        int least = of / (rounds[k].part * how.share);
        const bool alike =
            k > 0 && rounds[k].wanted == rounds[k - 1].wanted && rounds[k].all == rounds[k - 1].all;
        s->tried = alike ? s->least : 0;
        s->least = least > 2 ? least : 2;
        s->wanted_dbu = rounds[k].wanted ? wanted_dbu : 0;
        s->least2 = HUGE_VAL;
        s->clear_dbu = -1;
        for (int m = 0; m < s->nsample; m++)
            s->way[m] = -1;
        s->nrefused = 0;
        search_cut(s);
    }
    return s->i >= 0 ? FW_OK : FW_GEOMETRY;
}

static fw_status part_of(fw_arena *arena, const fw_geometry_polygon *p, int from, int to,
                         fw_geometry_polygon *out) {
    int n = to - from + 1;
    FW_NEED(out->vertex = fw_arena_array(arena, fw_geometry_point, (size_t)n));
    for (int k = 0; k < n; k++)
        out->vertex[k] = at(p, from + k);
    out->count = n;
    return FW_OK;
}

/* Distances wanted do not become smaller with the parts: a cut that keeps them keeps them to the
   edges that are cuts, too, because these end at vertices. */
static double wanted(const fw_geometry_polygon *p) {
    double least2 = HUGE_VAL;
    for (int i = 0; i < p->count; i++)
        least2 = fmin(least2, length2(at(p, i), at(p, i + 1)));
    return fmax(CLEAR_DBU, FW_CUT_SHARE * sqrt(least2));
}

typedef struct parts {
    fw_geometry_polygon *list;
    int n;
    double clear_dbu;
} parts;

/* above_dbu: ends, with parts that are too large, as soon as a cut keeps no more than that */
static fw_status cut(fw_arena *arena, const fw_geometry_polygon *polygon, int most,
                     double wanted_dbu, double above_dbu, manner how, parts *out) {
    int room = polygon->count; /* triangles are fewer */
    FW_NEED(out->list = fw_arena_array(arena, fw_geometry_polygon, (size_t)room));
    out->list[0] = *polygon;
    out->n = 1;
    out->clear_dbu = HUGE_VAL;
    for (int k = 0; k < out->n && out->clear_dbu > above_dbu;) {
        if (out->list[k].count <= most) {
            k++;
            continue;
        }
        if (out->n == room) return FW_GEOMETRY;
        search s;
        fw_geometry_polygon whole = out->list[k], *here = &out->list[k];
        fw_mark mark = fw_arena_mark(arena);
        /* better than the worst so far would be of no use */
        double enough_dbu = fmin(wanted_dbu, out->clear_dbu);
        fw_status status = find(arena, &whole, enough_dbu, most, how, &s);
        fw_arena_rewind(arena, mark);
        FW_TRY(status);
        out->clear_dbu = fmin(out->clear_dbu, s.clear_dbu);
        memmove(here + 2, here + 1, (size_t)(out->n - k - 1) * sizeof *here);
        FW_TRY(part_of(arena, &whole, s.i, s.j, &here[0]));
        FW_TRY(part_of(arena, &whole, s.j, s.i + whole.count, &here[1]));
        out->n++;
    }
    return FW_OK;
}

fw_status fw_mask_polygon_cut(fw_arena *arena, const fw_geometry_polygon *polygon, int most,
                              fw_geometry_polygon **part, int *npart, double *clear_dbu) {
    if (polygon->count <= most) {
        FW_NEED(*part = fw_arena_one(arena, fw_geometry_polygon));
        **part = *polygon;
        *npart = 1;
        if (clear_dbu) *clear_dbu = HUGE_VAL;
        return FW_OK;
    }
    parts best = {.n = 0}, now;
    double wanted_dbu = wanted(polygon);
    for (size_t k = 0; k < sizeof manners / sizeof *manners; k++) {
        const double above_dbu = k == 0 ? -HUGE_VAL : 1.1 * best.clear_dbu;
        FW_TRY(cut(arena, polygon, most, wanted_dbu, above_dbu, manners[k], &now));
        if (now.clear_dbu > above_dbu) best = now;
        /* far from it: the outline itself is why, as of a disc in many parts */
        if (best.clear_dbu >= wanted_dbu || best.clear_dbu < wanted_dbu / 8) break;
    }
    *part = best.list;
    *npart = best.n;
    if (clear_dbu) *clear_dbu = best.clear_dbu;
    return FW_OK;
}
