/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/slice.h"
#include "base/sort.h"
#include "geometry/segment.h"
#include <stdlib.h>

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

double fw_geometry_slices_length(fw_geometry_slices p) {
    double sum = 0.0;
    for (int i = 0; i < p.n; i++)
        sum += p.item[i].to_m - p.item[i].from_m;
    return sum;
}

bool fw_geometry_slices_contain(fw_geometry_slices p, double s_m) {
    for (int i = 0; i < p.n; i++)
        if (s_m >= p.item[i].from_m && s_m <= p.item[i].to_m) return true;
    return false;
}
