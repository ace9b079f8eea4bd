/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Width and space of one outline: the shortest chord between two edges that face each other. */
#include "geometry/segment.h"

enum { FEW = 128, RUN = 8 };

typedef struct search {
    const fw_geometry_contour *contour;
    bool inside;
} search;

static const fw_geometry_segment *around(const fw_geometry_contour *contour, int i) {
    int n = contour->count; /* -1 <= i <= n */
    return &contour->segment[i < 0 ? i + n : i < n ? i : i - n];
}

/* can the end of segment i at parameter t slide along the outline past t without a corner? */
static bool runs_on(const fw_geometry_contour *contour, int i, bool at_end) {
    const fw_geometry_segment *before = around(contour, at_end ? i : i - 1);
    const fw_geometry_segment *after = around(contour, at_end ? i + 1 : i);
    if ((before->flags | after->flags) & FW_SEGMENT_JOINT) return false;
    fw_geometry_vec2 u = fw_geometry_segment_tangent(before, 1),
                     v = fw_geometry_segment_tangent(after, 0);
    double along = vec_dot(u, v);
    return along > 0 && fabs(vec_cross(u, v)) < FW_SMOOTH_RAD * along;
}

/* is the distance stationary or least at this end of the chord? u points along the chord, away */
static bool settled(const search *in, int i, double t, fw_geometry_vec2 u) {
    const double slack = 1e-6;
    double toward = vec_dot(u, fw_geometry_segment_tangent(around(in->contour, i), t));
    bool start = t <= 0, end = t >= 1;
    if (start && !runs_on(in->contour, i, false)) return toward <= slack;
    if (end && !runs_on(in->contour, i, true)) return toward >= -slack;
    return fabs(toward) <= slack;
}

/* a chord counts when both edges have it on the wanted side, face each other, and neither end can
   slide along its edge to a shorter one */
static bool counts(const search *in, int i, int j, const fw_geometry_chord *chord, double length) {
    fw_geometry_vec2 u = vec_scale(1 / length, vec_sub(chord->at_q, chord->at_p));
    fw_geometry_vec2 left_i =
        vec_left(fw_geometry_segment_tangent(around(in->contour, i), chord->tp));
    fw_geometry_vec2 left_j =
        vec_left(fw_geometry_segment_tangent(around(in->contour, j), chord->tq));
    double side = in->inside ? 1 : -1, slack = 1e-6;
    if (side * vec_dot(u, left_i) <= slack || side * vec_dot(u, left_j) >= -slack) return false;
    if (vec_dot(left_i, left_j) > -slack) return false;
    return settled(in, i, chord->tp, u) && settled(in, j, chord->tq, vec_scale(-1, u));
}

/* do the two ends of the chord lie at a corner that the segments share? */
static bool at_shared_corner(const fw_geometry_contour *contour, int i, int j,
                             const fw_geometry_chord *chord) {
    int n = contour->count;
    bool after = (i + 1) % n == j && chord->tp >= 1 && chord->tq <= 0;
    bool before = (j + 1) % n == i && chord->tq >= 1 && chord->tp <= 0;
    return after || before;
}

/* Do two lines that follow each other turn by less than 90 degrees, or so little more that no chord
   between them counts (cosine of their normals above -1e-6)? Right corners are most of a drawing,
   and rounding leaves them on either side. */
static bool turns_little(const fw_geometry_segment *p, const fw_geometry_segment *q) {
    fw_geometry_vec2 u = vec_sub(p->b, p->a), v = vec_sub(q->b, q->a);
    double along = vec_dot(u, v);
    return along > 0 || along * along < 0.25e-12 * vec_dot(u, u) * vec_dot(v, v);
}

static bool no_chord_of_line(const search *in, int i, double limit) {
    const fw_geometry_segment *p = around(in->contour, i), *q = around(in->contour, i + 1);
    fw_geometry_vec2 v = p->b;
    if (p->kind == FW_LINE && q->kind == FW_LINE) return turns_little(p, q);
    const fw_geometry_segment *line = p->kind == FW_LINE ? p : q, *arc = line == p ? q : p;
    double off = vec_cross(fw_geometry_segment_tangent(line, 0), vec_sub(arc->centre, v));
    if (fabs(fabs(off) - arc->radius) > FW_COINCIDENT_M || off * arc->sweep_rad < 0)
        return false; /* a corner, or the arc runs back along the line */
    if ((arc->sweep_rad > 0) != in->inside) return true;
    return 2 * arc->radius > limit * (1 + 1e-5) && runs_on(in->contour, i, false) &&
           runs_on(in->contour, i + 1, true);
}

/* Neighbouring edges whose carriers touch where the edges join, and nowhere else: most pairs of a
   drawing. Can no chord below the limit count? Said of a space; a width is one of the outline run
   backwards.
   1. The smaller circle lies in the other one, which is convex: a chord that leaves the larger disc
   outwards does not come back to it.
   2. The circles lie beside each other, and the outline runs on smoothly at the far ends too: then
   a chord counts only square on both, hence on the line of the centres; outwards from the convex
   arc and out of the hollow one's disc it is the diameter of that disc.
   3. A line is such a circle: a convex arc lies wholly on its other side, a hollow one is met as in
   2. Two lines that turn by 90 degrees or less do not face each other.
   In: edges i and i + 1. false says nothing. Test: test_distance.c, against all chords. */
static bool no_chord_of_touching(const search *in, int i, double limit) {
    const fw_geometry_segment *p = around(in->contour, i), *q = around(in->contour, i + 1);
    if (in->contour->count < 3) return false;
    if (p->kind == FW_LINE || q->kind == FW_LINE) return no_chord_of_line(in, i, limit);
    double apart = vec_distance(p->centre, q->centre), turn = in->inside ? -1 : 1;
    const fw_geometry_segment *large = p->radius > q->radius ? p : q, *small = large == p ? q : p;
    bool same_turn = p->sweep_rad * q->sweep_rad > 0;
    if (same_turn)
        return turn * p->sweep_rad > 0 && small->radius < 0.99 * large->radius &&
               fabs(apart - (large->radius - small->radius)) <= FW_COINCIDENT_M;
    const fw_geometry_segment *hollow = turn * p->sweep_rad < 0 ? p : q;
    return fabs(apart - (large->radius + small->radius)) <= FW_COINCIDENT_M &&
           2 * hollow->radius > limit * (1 + 1e-5) && runs_on(in->contour, i, false) &&
           runs_on(in->contour, i + 1, true);
}

static bool nothing_between(const search *in, int i, int j, double limit) {
    int n = in->contour->count;
    return ((i + 1) % n == j && no_chord_of_touching(in, i, limit)) ||
           ((j + 1) % n == i && no_chord_of_touching(in, j, limit));
}

/* two lines whose outward normals are not more than 90 degrees apart face each other nowhere */
static bool lines_look_away(const fw_geometry_segment *p, const fw_geometry_segment *q) {
    return p->kind == FW_LINE && q->kind == FW_LINE &&
           vec_dot(vec_sub(p->b, p->a), vec_sub(q->b, q->a)) >= 0;
}

/* less than the limit, or not: then nothing more is said. gap: of the two boxes */
static double pair_clearance(const search *in, int i, int j, double limit, double gap) {
    const fw_geometry_segment *p = around(in->contour, i), *q = around(in->contour, j);
    int n = in->contour->count;
    fw_geometry_vec2 along;
    if (nothing_between(in, i, j, limit)) return HUGE_VAL;
    double ring = fw_geometry_concentric_gap(p, q, &along);
    if (!isinf(ring)) /* material lies between them where the larger one is convex */
        return ((p->radius > q->radius) == (p->sweep_rad > 0)) == in->inside ? ring : HUGE_VAL;
    bool apart = gap > 10 * FW_COINCIDENT_M; /* then they do not touch either */
    if (apart && lines_look_away(p, q)) return HUGE_VAL;
    fw_geometry_hit hit[FW_MOST_HITS];
    int hits = apart ? 0 : fw_geometry_segment_intersect(p, q, hit);
    for (int k = 0; k < hits;
         k++) { /* touching or crossing anywhere else than at a shared corner */
        fw_geometry_chord met = {hit[k].tp, hit[k].tq, hit[k].at, hit[k].at};
        if (!at_shared_corner(in->contour, i, j, &met) || n < 2) return 0;
    }
    fw_geometry_chord chord[FW_MOST_CHORDS];
    int count = fw_geometry_segment_chords(p, q, chord);
    double least = limit;
    for (int k = 0; k < count; k++) {
        fw_geometry_vec2 c = vec_sub(chord[k].at_q, chord[k].at_p);
        if (vec_dot(c, c) > least * least * (1 + 1e-12)) continue;
        double length = vec_length(c);
        if (length > FW_COINCIDENT_M && length < least && counts(in, i, j, &chord[k], length))
            least = length;
    }
    return least;
}

/* an arc of half a turn or more faces itself across its diameter */
static double own_clearance(const fw_geometry_segment *s, bool inside) {
    bool round = s->kind == FW_ARC && fabs(s->sweep_rad) >= FW_PI * (1 - 1e-12);
    return round && (s->sweep_rad > 0) == inside ? 2 * s->radius : HUGE_VAL;
}

typedef struct nearest { /* the shortest chord so far, and between which segments */
    double least;
    int i, j;
} nearest;

static void look_at_pair(const search *in, int p, int q, double gap, nearest *best) {
    double here = pair_clearance(in, p, q, best->least, gap);
    if (here < best->least) *best = (nearest){here, p, q};
}

static bool is_joint(const fw_geometry_segment *s) {
    return s->flags & FW_SEGMENT_JOINT;
}

/* segment p itself and with those behind it that are no neighbours; box: of the first `boxed`,
   run: of every RUN of these */
static void look_beyond(const search *in, int p, const fw_geometry_box *box, int boxed,
                        const fw_geometry_box *run, nearest *best) {
    const fw_geometry_contour *c = in->contour;
    fw_geometry_box own = p < boxed ? box[p] : fw_segment_box(&c->segment[p]);
    double alone = own_clearance(&c->segment[p], in->inside);
    if (alone < best->least) *best = (nearest){alone, p, p};
    int end = p == 0 ? c->count - 1 : c->count;
    for (int q = p + 2; q < end; q++) {
        if (q % RUN == 0 && q + RUN <= boxed &&
            (fw_box_apart(&own, &run[q / RUN], best->least) ||
             fw_box_gap(own, run[q / RUN]) >= best->least)) {
            q += RUN - 1;
            continue;
        }
        const fw_geometry_segment *other = &c->segment[q];
        fw_geometry_box there = q < boxed ? box[q] : fw_segment_box(other);
        if (fw_box_apart(&own, &there, best->least)) continue;
        double gap = fw_box_gap(own, there);
        if (gap >= best->least || is_joint(other)) continue;
        if (fw_geometry_segment_clear_of(&c->segment[p], &there) >= best->least ||
            fw_geometry_segment_clear_of(other, &own) >= best->least)
            continue;
        look_at_pair(in, p, q, gap, best);
    }
}

double fw_geometry_contour_clearance_below(const fw_geometry_contour *contour, bool inside,
                                           double limit_m, int *i, int *j) {
    search in = {contour, inside};
    nearest best = {limit_m, -1, -1};
    int n = contour->count, boxed = n < FEW ? n : FEW;
    fw_geometry_box box[FEW], run[FEW / RUN]; /* of the first segments, each asked for many times */
    for (int k = 0; k < boxed; k++) {
        box[k] = fw_segment_box(&contour->segment[k]);
        run[k / RUN] = k % RUN ? fw_box_join(run[k / RUN], box[k]) : box[k];
    }
    for (int p = 0; p < n; p++)
        if (!is_joint(&contour->segment[p])) look_beyond(&in, p, box, boxed, run, &best);
    for (int p = 0; p < n; p++) /* neighbours last: the limit may then spare them */
        for (int k = 0; k < 2; k++) {
            int q = k == 0 ? p + 1 : n - 1; /* the first one is the last one's neighbour, too */
            if (q >= n || q <= p || (k == 1 && (p > 0 || q == p + 1))) continue;
            if (is_joint(&contour->segment[p]) || is_joint(&contour->segment[q])) continue;
            double gap = fw_box_gap(p < boxed ? box[p] : fw_segment_box(&contour->segment[p]),
                                    q < boxed ? box[q] : fw_segment_box(&contour->segment[q]));
            if (gap < best.least) look_at_pair(&in, p, q, gap, &best);
        }
    if (i) *i = best.i;
    if (j) *j = best.j;
    return best.least;
}

double fw_geometry_contour_clearance(const fw_geometry_contour *contour, bool inside, int *i,
                                     int *j) {
    return fw_geometry_contour_clearance_below(contour, inside, HUGE_VAL, i, j);
}
