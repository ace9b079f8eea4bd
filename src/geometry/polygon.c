/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact certificate of a polygon on the grid, in 64-bit integers: with |coordinate| < 2^30 every
   difference is below 2^31 and every cross product below 2^63. */
#include "geometry/polygon.h"
#include "base/sort.h"
#include "geometry/segment.h"
#include <stdlib.h>

typedef struct sweep {
    const fw_geometry_polygon *polygon;
    int *left, *right; /* search tree over the edges that the sweep line meets, by height */
    int root;
} sweep;

static fw_geometry_point vertex(const fw_geometry_polygon *p, int i) {
    return p->vertex[i < p->count ? i : 0];
}

static int sign(int64_t value) {
    return (value > 0) - (value < 0);
}

static int compare_points(fw_geometry_point a, fw_geometry_point b) {
    if (a.x_dbu != b.x_dbu) return a.x_dbu < b.x_dbu ? -1 : 1;
    return (a.y_dbu > b.y_dbu) - (a.y_dbu < b.y_dbu);
}

/* the end of edge e that the sweep meets first, and the other */
static void ends(const fw_geometry_polygon *p, int e, fw_geometry_point *low,
                 fw_geometry_point *high) {
    fw_geometry_point a = vertex(p, e), b = vertex(p, e + 1);
    bool ordered = compare_points(a, b) < 0;
    *low = ordered ? a : b;
    *high = ordered ? b : a;
}

/* is edge e above (+1) or below (-1) edge f, where both meet the sweep line? */
static int above(const fw_geometry_polygon *p, int e, int f) {
    fw_geometry_point el, eh, fl, fh;
    if (e == f) return 0;
    ends(p, e, &el, &eh);
    ends(p, f, &fl, &fh);
    if (compare_points(el, fl) >= 0) {
        int side = sign(fw_cross(fl, fh, el));
        return side ? side : sign(fw_cross(fl, fh, eh));
    }
    int side = sign(fw_cross(el, eh, fl));
    return side ? -side : -sign(fw_cross(el, eh, fh));
}

/* c lies on the line through a <= b: between them? */
static bool within(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return compare_points(a, c) <= 0 && compare_points(c, b) <= 0;
}

/* do two closed edges have a common point? */
static bool meet(const fw_geometry_polygon *p, int e, int f) {
    fw_geometry_point a, b, c, d;
    ends(p, e, &a, &b);
    ends(p, f, &c, &d);
    int c_side = sign(fw_cross(a, b, c)), d_side = sign(fw_cross(a, b, d));
    int a_side = sign(fw_cross(c, d, a)), b_side = sign(fw_cross(c, d, b));
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return (c_side == 0 && within(a, b, c)) || (d_side == 0 && within(a, b, d)) ||
           (a_side == 0 && within(c, d, a)) || (b_side == 0 && within(c, d, b));
}

/* fixed scrambling of the number (Knuth's multiplier, folded): heights of the tree stay about
   2 ln n and the result does not depend on the run */
static uint32_t priority(int e) {
    uint32_t h = (uint32_t)e * 2654435761u;
    h ^= h >> 15;
    h *= 2246822519u;
    return h ^ (h >> 13);
}

static void split(sweep *s, int node, int e, int *below, int *over) {
    if (node < 0)
        *below = *over = -1;
    else if (above(s->polygon, e, node) > 0) {
        *below = node;
        split(s, s->right[node], e, &s->right[node], over);
    } else {
        *over = node;
        split(s, s->left[node], e, below, &s->left[node]);
    }
}

static int merge(sweep *s, int below, int over) {
    if (below < 0 || over < 0) return below < 0 ? over : below;
    if (priority(below) > priority(over)) {
        s->right[below] = merge(s, s->right[below], over);
        return below;
    }
    s->left[over] = merge(s, below, s->left[over]);
    return over;
}

/* puts e into the tree; its neighbours below and above */
static void insert(sweep *s, int e, int *under, int *over) {
    int *link = NULL, node = s->root;
    *under = *over = -1;
    for (int *at = &s->root; node >= 0; node = *at) {
        if (!link && priority(e) > priority(node)) link = at;
        if (above(s->polygon, e, node) > 0) {
            *under = node;
            at = &s->right[node];
        } else {
            *over = node;
            at = &s->left[node];
        }
        if (*at < 0 && !link) link = at;
    }
    if (!link) link = &s->root;
    int old = *link, low, high;
    split(s, old, e, &low, &high);
    s->left[e] = low;
    s->right[e] = high;
    *link = e;
}

/* takes e out; its neighbours below and above. false: not found, the order was broken */
static bool take_out(sweep *s, int e, int *under, int *over) {
    int *at = &s->root;
    *under = *over = -1;
    while (*at >= 0 && *at != e) {
        int node = *at;
        if (above(s->polygon, e, node) > 0) {
            *under = node;
            at = &s->right[node];
        } else {
            *over = node;
            at = &s->left[node];
        }
    }
    if (*at != e) return false;
    for (int node = s->left[e]; node >= 0; node = s->right[node])
        *under = node;
    for (int node = s->right[e]; node >= 0; node = s->left[node])
        *over = node;
    *at = merge(s, s->left[e], s->right[e]);
    return true;
}

typedef struct event {
    fw_geometry_point at;
    int edge;
    int enters; /* at one point edges leave before others enter */
} event;

static int by_event(const void *left, const void *right) {
    const event *a = left, *b = right;
    int order = compare_points(a->at, b->at);
    if (order) return order;
    if (a->enters != b->enters) return a->enters < b->enters ? -1 : 1;
    return (a->edge > b->edge) - (a->edge < b->edge);
}

static bool neighbours(int n, int e, int f) {
    int gap = e > f ? e - f : f - e;
    return gap == 1 || gap == n - 1;
}

static bool clash(const fw_geometry_polygon *p, int e, int f, fw_geometry_polygon_report *report) {
    if (e < 0 || f < 0 || neighbours(p->count, e, f) || !meet(p, e, f)) return false;
    report->bad_i = e < f ? e : f;
    report->bad_j = e < f ? f : e;
    return true;
}

/* Sweep after Shamos and Hoey (1976): edges are kept in the order in which the sweep line meets
   them, and each pair is tested when it becomes neighbouring; the first common point is always
   found so. Vertices were found distinct before. In: polygon (dbu). Out: report. Exact. O(n log n).
   Test: test_polygon.c. */
static bool sweep_edges(sweep *s, const event *events, fw_geometry_polygon_report *report) {
    const fw_geometry_polygon *p = s->polygon;
    for (int i = 0; i < 2 * p->count; i++) {
        int under, over, e = events[i].edge;
        if (events[i].enters) {
            insert(s, e, &under, &over);
            if (clash(p, e, under, report) || clash(p, e, over, report)) return false;
        } else if (!take_out(s, e, &under, &over))
            return false;
        else if (clash(p, under, over, report))
            return false;
    }
    return true;
}

/* the smaller of two angles between 0 and pi, each as (|sine|, cosine) times the same lengths */
static inline void sharper(double sine, double cosine, double least[2]) {
    if (cosine * least[0] > sine * least[1]) {
        least[0] = sine;
        least[1] = cosine;
    }
}

/* Lengths and corners, in one pass without roots or angles: the least square, and the sharpest
   corner as a pair (u x v, u . v), compared crosswise.
   In: vertices (dbu), exact products. Out: shortest edge (m), sharpest corners (rad) towards
   material and space, whether one is below 90 degrees (exact), numbers of zero edges, spikes and
   straight vertices. Error: one rounding of each. Cost O(n). Test: test_polygon.c. */
static bool measure(const fw_geometry_polygon *p, fw_geometry_polygon_report *report) {
    int n = p->count;
    int64_t least2 = INT64_MAX;
    double corner[2][2] = {{0, -1}, {0, -1}}; /* in material, in space: a straight way so far */
    fw_geometry_point a = vertex(p, n - 1), b = vertex(p, 0);
    int64_t ux = (int64_t)a.x_dbu - b.x_dbu, uy = (int64_t)a.y_dbu - b.y_dbu;
    for (int i = 0; i < n; i++) {
        fw_geometry_point c = vertex(p, i + 1);
        int64_t vx = (int64_t)c.x_dbu - b.x_dbu, vy = (int64_t)c.y_dbu - b.y_dbu;
        int64_t turn = ux * vy - uy * vx, dot = ux * vx + uy * vy, length2 = vx * vx + vy * vy;
        least2 = length2 < least2 ? length2 : least2;
        if (turn == 0) {
            bool spike = dot >= 0;
            report->zero_edges += length2 == 0;
            report->spikes += dot > 0;
            report->straight += dot < 0;
            if (spike && report->bad_i < 0) {
                report->bad_i = (i + n - 1) % n;
                report->bad_j = i;
            }
        }
        /* counter-clockwise, an edge that turns left leaves material in the corner */
        double *least = corner[turn > 0];
        if (dot >= 0 || least[1] < 0) sharper(fabs((double)turn), (double)dot, least);
        ux = -vx, uy = -vy, b = c;
    }
    report->shortest_edge_m = sqrt((double)least2) * 1e-9;
    report->sharpest_space_rad = atan2(corner[1][0], corner[1][1]);
    report->sharpest_material_rad = atan2(corner[0][0], corner[0][1]);
    report->sharpest_rad = fmin(report->sharpest_material_rad, report->sharpest_space_rad);
    report->acute = corner[0][1] > 0 || corner[1][1] > 0;
    return report->bad_i < 0;
}

static void fill_events(const fw_geometry_polygon *p, event *events) {
    for (int e = 0; e < p->count; e++) {
        fw_geometry_point low, high;
        ends(p, e, &low, &high);
        events[2 * e] = (event){low, e, 1};
        events[2 * e + 1] = (event){high, e, 0};
    }
    qsort(events, 2 * (size_t)p->count, sizeof *events, by_event);
}

/* each vertex belongs to two edges, so an end that occurs more than twice is met again */
static bool vertices_distinct(const event *events, int n, fw_geometry_polygon_report *report) {
    for (int i = 2; i < 2 * n; i++)
        if (compare_points(events[i].at, events[i - 2].at) == 0) {
            int e = events[i - 2].edge, f = events[i].edge;
            if (neighbours(n, e, f) && i + 1 < 2 * n &&
                compare_points(events[i + 1].at, events[i].at) == 0)
                f = events[i + 1].edge;
            report->bad_i = e < f ? e : f;
            report->bad_j = e < f ? f : e;
            return false;
        }
    return true;
}

fw_status fw_geometry_polygon_check(fw_arena *arena, const fw_geometry_polygon *polygon,
                                    fw_geometry_polygon_report *report) {
    int n = polygon->count;
    *report = (fw_geometry_polygon_report){.bad_i = -1, .bad_j = -1};
    if (n < 3) return FW_GEOMETRY;
    for (int i = 0; i < n; i++) {
        int64_t x = polygon->vertex[i].x_dbu, y = polygon->vertex[i].y_dbu, most = 1 << 30;
        if (x <= -most || x >= most || y <= -most || y >= most) return FW_LIMIT;
    }
    if (!measure(polygon, report)) return FW_OK;
    FW_TRY(fw_geometry_polygon_prove(arena, polygon, &report->simple));
    if (report->simple) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    event *events = fw_arena_array(arena, event, 2 * (size_t)n);
    sweep s = {polygon, fw_arena_array(arena, int, (size_t)n),
               fw_arena_array(arena, int, (size_t)n), -1};
    if (!events || !s.left || !s.right) return FW_NOMEM;
    fill_events(polygon, events);
    report->simple = vertices_distinct(events, n, report) && sweep_edges(&s, events, report);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

typedef struct crossing {
    double s_m, sine;
} crossing;

typedef struct crossings {
    crossing *item;
    int n;
} crossings;

/* along and across the line; the same point gives the same doubles whoever asks */
static fw_geometry_vec2 local(fw_geometry_cut_line line, fw_geometry_vec2 p) {
    fw_geometry_vec2 d = vec_sub(p, line.at);
    return (fw_geometry_vec2){vec_dot(d, line.along), vec_cross(line.along, d)};
}

static void add(crossings *list, double s_m, double sine) {
    list->item[list->n++] = (crossing){s_m, fmin(1.0, fmax(fabs(sine), 1e-6))};
}

/* from the smaller end, so that both pieces that share an edge find the same double */
static void slice_line(fw_geometry_cut_line line, fw_geometry_vec2 a, fw_geometry_vec2 b,
                       crossings *list) {
    if (vec_before(b, a)) {
        fw_geometry_vec2 swap = a;
        a = b;
        b = swap;
    }
    fw_geometry_vec2 p = local(line, a), q = local(line, b);
    if ((p.y <= 0.0) == (q.y <= 0.0)) return;
    double t = p.y / (p.y - q.y);
    add(list, p.x + t * (q.x - p.x), (q.y - p.y) / vec_distance(a, b));
}

/* angle from the arc's start to a point of its circle, in the arc's own direction, 0..2 pi */
static double swept(const fw_geometry_segment *arc, fw_geometry_vec2 at) {
    double angle = fw_geometry_vec_angle(vec_sub(arc->a, arc->centre), vec_sub(at, arc->centre));
    if (arc->sweep_rad < 0.0) angle = -angle;
    return angle < 0.0 ? angle + FW_TURN : angle;
}

/* How far a point of the circle is inside the arc (> 0) or outside it (< 0), as an angle to the
   nearer end. */
static double depth_in(const fw_geometry_segment *arc, fw_geometry_vec2 at) {
    double whole = fabs(arc->sweep_rad), angle = swept(arc, at);
    if (angle <= whole) return fmin(angle, whole - angle);
    return -fmin(angle - whole, FW_TURN - angle);
}

/* The circle's two points on the line, those of them that lie on the arc. Their number must be odd
   when the ends lie on different sides and even when not; where rounding says otherwise, the point
   nearest to an end is the one that was judged wrongly. */
static void slice_arc(fw_geometry_cut_line line, const fw_geometry_segment *arc, crossings *list) {
    fw_geometry_vec2 c = local(line, arc->centre);
    bool apart = (local(line, arc->a).y <= 0.0) != (local(line, arc->b).y <= 0.0);
    double h = c.y, r = arc->radius;
    double half = fabs(h) < r ? sqrt((r - h) * (r + h)) : 0.0;
    if (half == 0.0 && !apart) return; /* beside it, or a touch */
    double s[2] = {c.x - half, c.x + half}, depth[2];
    bool on[2];
    for (int i = 0; i < 2; i++) {
        depth[i] = depth_in(arc, vec_along(line.at, s[i], line.along));
        on[i] = depth[i] >= 0.0;
    }
    if ((on[0] != on[1]) != apart) {
        int wrong = fabs(depth[0]) <= fabs(depth[1]) ? 0 : 1;
        on[wrong] = !on[wrong];
    }
    for (int i = 0; i < 2; i++)
        if (on[i]) add(list, s[i], half / r);
}

static int by_place(const void *left, const void *right) {
    const crossing *p = left, *q = right;
    return fw_order_doubles(p->s_m, q->s_m);
}

/* The line's crossings with every segment, sorted; the pieces between the first and the second, the
   third and the fourth ... lie inside (even-odd). A point with across <= 0 counts as below: the
   line lies an infinitesimal step to its own left, so that vertices and edges on it count once. The
   sides of shared vertices come from the same doubles, and every segment crosses an odd number of
   times exactly when its ends lie on different sides, so that the number of crossings is even
   whatever the rounding.
   In: contour (m), line. Out: intervals, m along the line. Error: 2 ulp of the coordinates over the
   sine of the crossing; where the line grazes an arc, sqrt(2 r ulp). Cost: O(n log n).
   Test: test_slice.c: closed forms, random lines against flattened outlines, area by slices. */
fw_status fw_geometry_contour_slice(fw_arena *arena, const fw_geometry_contour *contour,
                                    fw_geometry_cut_line line, fw_geometry_slices *out) {
    *out = (fw_geometry_slices){0};
    crossings list = {.item = fw_arena_array(arena, crossing, 2 * (size_t)contour->count)};
    FW_NEED(list.item);
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        if (s->kind == FW_LINE)
            slice_line(line, s->a, s->b, &list);
        else
            slice_arc(line, s, &list);
    }
    if (list.n > 1) qsort(list.item, (size_t)list.n, sizeof *list.item, by_place);
    FW_NEED(out->item = fw_arena_array(arena, fw_geometry_slice, (size_t)list.n / 2));
    for (int i = 0; i + 1 < list.n; i += 2) {
        const crossing *p = &list.item[i], *q = p + 1;
        if (q->s_m - p->s_m > FW_COINCIDENT_M)
            out->item[out->n++] = (fw_geometry_slice){p->s_m, q->s_m, p->sine, q->sine};
    }
    return FW_OK;
}

/* ---- sets ---- */

typedef struct end {
    double s_m, sine;
    int of; /* 0 p, 1 q */
} end;

static int by_end(const void *left, const void *right) {
    const end *p = left, *q = right;
    int order = fw_order_doubles(p->s_m, q->s_m);
    return order ? order : fw_order_wholes(p->of, q->of);
}

static int ends_of(fw_geometry_slices p, int of, end *list) {
    for (int i = 0; i < p.n; i++) {
        list[2 * i] = (end){p.item[i].from_m, p.item[i].from_sine, of};
        list[2 * i + 1] = (end){p.item[i].to_m, p.item[i].to_sine, of};
    }
    return 2 * p.n;
}

static bool holds(const bool in[2], fw_geometry_set_rule rule) {
    switch (rule) {
    case FW_SET_OR:
        return in[0] || in[1];
    case FW_SET_AND:
        return in[0] && in[1];
    case FW_SET_NOT:
        return in[0] && !in[1];
    case FW_SET_XOR:
        break;
    }
    return in[0] != in[1];
}

/* Sweep over all ends. Within one set intervals are apart, so that each end turns it over. Test:
   test_slice.c, sets. */
fw_status fw_geometry_slices_combine(fw_arena *arena, fw_geometry_slices p, fw_geometry_slices q,
                                     fw_geometry_set_rule rule, fw_geometry_slices *out) {
    size_t most = 2 * ((size_t)p.n + (size_t)q.n);
    end *list = fw_arena_array(arena, end, most);
    fw_geometry_slices r = {.item = fw_arena_array(arena, fw_geometry_slice, most)};
    FW_NEED(list && r.item);
    int n = ends_of(p, 0, list);
    n += ends_of(q, 1, list + n);
    if (n > 1) qsort(list, (size_t)n, sizeof *list, by_end);
    bool in[2] = {false, false}, inside = false;
    for (int i = 0; i < n; i++) {
        in[list[i].of] = !in[list[i].of];
        if (holds(in, rule) == inside) continue;
        inside = !inside;
        fw_geometry_slice *last = r.n ? &r.item[r.n - 1] : NULL;
        if (inside && last && list[i].s_m - last->to_m <= FW_COINCIDENT_M) {
            continue; /* nothing between the two: they are one */
        } else if (inside) {
            r.item[r.n++] =
                (fw_geometry_slice){list[i].s_m, list[i].s_m, list[i].sine, list[i].sine};
        } else {
            last->to_m = list[i].s_m;
            last->to_sine = list[i].sine;
            if (last->to_m - last->from_m <= FW_COINCIDENT_M) r.n--;
        }
    }
    *out = r;
    return FW_OK;
}
