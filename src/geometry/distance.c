/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least distances, in closed form: a shortest chord between two segments ends at segment ends, at
   feet of perpendiculars from them, or stands square on both. */
#include "geometry/segment.h"

static int add_chord(fw_geometry_chord *chord, int n, double tp, double tq, fw_geometry_vec2 at_p,
                     fw_geometry_vec2 at_q) {
    if (n < FW_MOST_CHORDS) chord[n++] = (fw_geometry_chord){tp, tq, at_p, at_q};
    return n;
}

/* concentric arcs: every chord through the centre is square on both, from r1 - r2 (the ends give
   it) to r1 + r2 across the centre */
static int diameters(const fw_geometry_segment *p, const fw_geometry_segment *q,
                     fw_geometry_chord *chord, int n) {
    const fw_geometry_vec2 end[4] = {p->a, p->b, q->a, q->b};
    for (int i = 0; i < 4; i++) {
        fw_geometry_vec2 u = vec_unit(vec_sub(end[i], p->centre));
        double tp, tq, way = i < 2 ? 1 : -1;
        if (fw_geometry_segment_faces(p, vec_scale(way, u), &tp) &&
            fw_geometry_segment_faces(q, vec_scale(-way, u), &tq))
            n = add_chord(chord, n, tp, tq, vec_along(p->centre, way * p->radius, u),
                          vec_along(q->centre, -way * q->radius, u));
    }
    return n;
}

/* chords square on both an arc and a line, or on two arcs: they lie on a line through the centres
 */
static int square_chords(const fw_geometry_segment *p, const fw_geometry_segment *q,
                         fw_geometry_chord *chord, int n) {
    fw_geometry_vec2 foot = {0, 0}, from = p->kind == FW_ARC ? p->centre : q->centre, to;
    double t = 0;
    if (p->kind == FW_ARC && q->kind == FW_ARC)
        to = q->centre;
    else {
        const fw_geometry_segment *line = p->kind == FW_LINE ? p : q;
        double along = vec_dot(vec_sub(from, line->a), vec_sub(line->b, line->a));
        double square = vec_dot(vec_sub(line->b, line->a), vec_sub(line->b, line->a));
        t = along / square;
        if (t < 0 || t > 1) return n;
        to = foot = fw_geometry_segment_point(line, t);
    }
    fw_geometry_vec2 ray = vec_sub(to, from);
    if (p->kind == q->kind && vec_length(ray) <= FW_COINCIDENT_M) return diameters(p, q, chord, n);
    if (vec_length(ray) <= 1e-15) /* line through the centre: the ends and crossings tell all */
        return n;
    fw_geometry_vec2 u = vec_unit(ray);
    for (int i = -1; i <= 1; i += 2) {
        double t0 = 0, t1 = 0;
        const fw_geometry_segment *arc = p->kind == FW_ARC ? p : q;
        if (!fw_geometry_segment_faces(arc, vec_scale(i, u), &t0)) continue;
        fw_geometry_vec2 at = vec_along(arc->centre, i * arc->radius, u);
        if (p->kind != q->kind) {
            n = p->kind == FW_ARC ? add_chord(chord, n, t0, t, at, foot)
                                  : add_chord(chord, n, t, t0, foot, at);
            continue;
        }
        for (int k = -1; k <= 1; k += 2)
            if (fw_geometry_segment_faces(q, vec_scale(k, u), &t1))
                n = add_chord(chord, n, t0, t1, at, vec_along(q->centre, k * q->radius, u));
    }
    return n;
}

/* fw_geometry_segment_foot, lines without a call */
static inline fw_geometry_vec2 foot_on(const fw_geometry_segment *s, fw_geometry_vec2 from,
                                       double *t) {
    return s->kind == FW_LINE ? vec_line_foot(s->a, s->b, from, t)
                              : fw_geometry_segment_foot(s, from, t);
}

/* All chords between two segments at which the distance can be least: end to foot (4), end to end
   (4), square on both (4). In: two segments. Out: at most 12 chords with parameters and places (m).
   Error: a few ulp of the coordinates. Source: first-order conditions. Test: test_distance.c. */
int fw_geometry_segment_chords(const fw_geometry_segment *p, const fw_geometry_segment *q,
                               fw_geometry_chord chord[FW_MOST_CHORDS]) {
    int n = 0;
    for (int end = 0; end < 2; end++) {
        double t;
        fw_geometry_vec2 foot, from = end ? p->b : p->a;
        foot = foot_on(q, from, &t);
        n = add_chord(chord, n, end, t, from, foot);
        from = end ? q->b : q->a;
        foot = foot_on(p, from, &t);
        n = add_chord(chord, n, t, end, foot, from);
        for (int other = 0; other < 2; other++)
            n = add_chord(chord, n, end, other, end ? p->b : p->a, other ? q->b : q->a);
    }
    return p->kind == FW_ARC || q->kind == FW_ARC ? square_chords(p, q, chord, n) : n;
}

double fw_geometry_concentric_gap(const fw_geometry_segment *p, const fw_geometry_segment *q,
                                  fw_geometry_vec2 *along) {
    if (p->kind != FW_ARC || q->kind != FW_ARC || (p->sweep_rad > 0) == (q->sweep_rad > 0) ||
        vec_distance(p->centre, q->centre) > FW_COINCIDENT_M ||
        fabs(p->radius - q->radius) <= FW_COINCIDENT_M)
        return HUGE_VAL;
    const fw_geometry_vec2 end[4] = {q->a, q->b, p->a, p->b};
    double t;
    for (int i = 0; i < 4; i++) { /* where angles overlap, an end of one lies before the other */
        *along = vec_unit(vec_sub(end[i], p->centre));
        if (fw_geometry_segment_faces(i < 2 ? p : q, *along, &t))
            return fabs(p->radius - q->radius);
    }
    return HUGE_VAL;
}

/* the least of all chords; HUGE_VAL: none was nearer than `limit` */
static double nearest_chord(const fw_geometry_segment *p, const fw_geometry_segment *q,
                            double limit, fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    fw_geometry_chord chord[FW_MOST_CHORDS];
    int n = fw_geometry_segment_chords(p, q, chord);
    double least = limit;
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 c = vec_sub(chord[i].at_p, chord[i].at_q);
        if (vec_dot(c, c) > least * least * (1 + 1e-12)) continue;
        double length = vec_length(c);
        if (length < least) {
            least = length;
            *at_p = chord[i].at_p;
            *at_q = chord[i].at_q;
        }
    }
    return least;
}

double fw_geometry_segment_distance(const fw_geometry_segment *p, const fw_geometry_segment *q,
                                    fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    fw_geometry_hit hit[FW_MOST_HITS];
    if (fw_geometry_segment_intersect(p, q, hit) > 0) {
        *at_p = *at_q = hit[0].at;
        return 0;
    }
    return nearest_chord(p, q, HUGE_VAL, at_p, at_q);
}

enum { FEW = 96, RUN = 8 };

/* the segments of q against one of p whose box is given; box: of the first FEW, run: of every RUN
   of these */
static double nearest_of(const fw_geometry_segment *s, fw_geometry_box own,
                         const fw_geometry_contour *q, const fw_geometry_box *box,
                         const fw_geometry_box *run, double least, fw_geometry_vec2 *at_p,
                         fw_geometry_vec2 *at_q) {
    for (int j = 0; j < q->count; j++) {
        if (j % RUN == 0 && j + RUN <= q->count && j + RUN <= FEW &&
            (fw_box_apart(&own, &run[j / RUN], least) || fw_box_gap(own, run[j / RUN]) >= least)) {
            j += RUN - 1;
            continue;
        }
        const fw_geometry_segment *t = &q->segment[j];
        fw_geometry_box there = j < FEW ? box[j] : fw_segment_box(t);
        if (fw_box_apart(&own, &there, least)) continue;
        double gap = fw_box_gap(own, there);
        if (gap >= least || fw_geometry_segment_clear_of(s, &there) >= least ||
            fw_geometry_segment_clear_of(t, &own) >= least)
            continue;
        if (gap > 10 * FW_COINCIDENT_M) { /* then they do not touch */
            least = nearest_chord(s, t, least, at_p, at_q);
            continue;
        }
        fw_geometry_vec2 here = {0, 0}, across = here;
        double d = fw_geometry_segment_distance(s, t, &here, &across);
        if (d < least) {
            least = d;
            *at_p = here;
            *at_q = across;
        }
    }
    return least;
}

double fw_geometry_contour_distance_below(const fw_geometry_contour *p,
                                          const fw_geometry_contour *q, double limit_m,
                                          fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    double least = limit_m;
    fw_geometry_vec2 best_p = {0, 0}, best_q = {0, 0};
    fw_geometry_box whole = fw_geometry_contour_box(q), box[FEW], run[FEW / RUN];
    bool boxed = false;
    for (int i = 0; i < p->count && q->count > 0; i++) {
        fw_geometry_box own = fw_segment_box(&p->segment[i]);
        if (fw_box_gap(own, whole) >= least) continue;
        for (int j = 0; !boxed && j < q->count && j < FEW; j++) {
            box[j] = fw_segment_box(&q->segment[j]);
            run[j / RUN] = j % RUN ? fw_box_join(run[j / RUN], box[j]) : box[j];
        }
        boxed = true;
        least = nearest_of(&p->segment[i], own, q, box, run, least, &best_p, &best_q);
    }
    if (at_p) *at_p = best_p;
    if (at_q) *at_q = best_q;
    return least;
}

double fw_geometry_contour_distance(const fw_geometry_contour *p, const fw_geometry_contour *q,
                                    fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    return fw_geometry_contour_distance_below(p, q, HUGE_VAL, at_p, at_q);
}
