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

enum { FEW = 1024, RUN = 8 };

/* the segments of an outline that may be near the other one, in their order */
typedef struct listed {
    const fw_geometry_contour *of;
    fw_geometry_box whole; /* around all of them */
    int n, rest;           /* listed; from `rest` on none is, and all may be near */
    int which[FEW];
    fw_geometry_box box[FEW], run[FEW / RUN]; /* of each, of every RUN of these */
} listed;

/* A segment that is `limit` away from a box is so from every segment within that box: also as rounded, since no step
   of a gap falls as boxes become smaller. */
static void list_near(const fw_geometry_boxed *boxed, const fw_geometry_box *box, double limit,
                      listed *to) {
    const fw_geometry_contour *q = boxed->contour;
    to->of = q;
    to->n = 0;
    for (to->rest = 0; to->rest < q->count && to->n < FEW; to->rest++) {
        if (boxed->run && to->rest % FW_GEOMETRY_BOXED_RUN == 0 &&
            fw_box_apart(&boxed->run[to->rest / FW_GEOMETRY_BOXED_RUN], box, limit)) {
            to->rest +=
                FW_GEOMETRY_BOXED_RUN - 1; /* all of a run; after the last one there is nothing */
            continue;
        }
        const fw_geometry_box own =
            boxed->box ? boxed->box[to->rest] : fw_segment_box(&q->segment[to->rest]);
        if (fw_box_apart(&own, box, limit)) continue;
        const int n = to->n++;
        to->which[n] = to->rest;
        to->box[n] = own;
        to->run[n / RUN] = n % RUN ? fw_box_join(to->run[n / RUN], own) : own;
        to->whole = n ? fw_box_join(to->whole, own) : own;
    }
    for (int j = to->rest; j < q->count; j++)
        to->whole = fw_box_join(to->whole, fw_segment_box(&q->segment[j]));
}

typedef struct least_chord {
    double length;
    fw_geometry_vec2 at_p, at_q;
} least_chord;

/* two segments, each with its box */
static void look_between(const fw_geometry_segment *s, const fw_geometry_box *own,
                         const fw_geometry_segment *t, const fw_geometry_box *there,
                         least_chord *best) {
    const double least = best->length;
    if (fw_box_apart(own, there, least)) return;
    double gap = fw_box_gap(*own, *there);
    if (gap >= least || fw_geometry_segment_clear_of(s, there) >= least ||
        fw_geometry_segment_clear_of(t, own) >= least)
        return;
    if (gap > 10 * FW_COINCIDENT_M) { /* then they do not touch */
        best->length = nearest_chord(s, t, least, &best->at_p, &best->at_q);
        return;
    }
    fw_geometry_vec2 here = {0, 0}, across = here;
    double d = fw_geometry_segment_distance(s, t, &here, &across);
    if (d < least) *best = (least_chord){d, here, across};
}

/* one segment, whose box is given, against those of a list and the rest of their outline */
static void look_at_list(const fw_geometry_segment *s, const fw_geometry_box *own, const listed *q,
                         least_chord *best) {
    for (int k = 0; k < q->n; k++) {
        if (k % RUN == 0 && k + RUN <= q->n &&
            (fw_box_apart(own, &q->run[k / RUN], best->length) ||
             fw_box_gap(*own, q->run[k / RUN]) >= best->length)) {
            k += RUN - 1;
            continue;
        }
        look_between(s, own, &q->of->segment[q->which[k]], &q->box[k], best);
    }
    for (int j = q->rest; j < q->of->count; j++) {
        const fw_geometry_box there = fw_segment_box(&q->of->segment[j]);
        look_between(s, own, &q->of->segment[j], &there, best);
    }
}

fw_status fw_geometry_contour_boxed(fw_arena *arena, const fw_geometry_contour *contour,
                                    fw_geometry_boxed *out) {
    enum { EACH = FW_GEOMETRY_BOXED_RUN };
    fw_geometry_box *box = fw_arena_array(arena, fw_geometry_box, (size_t)contour->count),
                    *run =
                        fw_arena_array(arena, fw_geometry_box, (size_t)contour->count / EACH + 1);
    FW_NEED(box && run);
    *out = (fw_geometry_boxed){.contour = contour, .box = box, .run = run};
    for (int i = 0; i < contour->count; i++) {
        box[i] = fw_segment_box(&contour->segment[i]);
        run[i / EACH] = i % EACH ? fw_box_join(run[i / EACH], box[i]) : box[i];
        out->whole = i ? fw_box_join(out->whole, box[i]) : box[i];
    }
    return FW_OK;
}

double fw_geometry_boxed_distance_below(const fw_geometry_contour *p, const fw_geometry_boxed *q,
                                        double limit_m, fw_geometry_vec2 *at_p,
                                        fw_geometry_vec2 *at_q) {
    least_chord best = {limit_m, {0, 0}, {0, 0}};
    const fw_geometry_box around = fw_geometry_contour_box(p);
    listed near;
    if (p->count > 0) list_near(q, &around, limit_m, &near);
    bool any = p->count > 0 && (near.n > 0 || near.rest < q->contour->count);
    for (int i = 0; any && i < p->count && best.length > 0; i++) {
        fw_geometry_box own = fw_segment_box(&p->segment[i]);
        if (fw_box_gap(own, near.whole) >= best.length) continue;
        look_at_list(&p->segment[i], &own, &near, &best);
    }
    if (at_p) *at_p = best.at_p;
    if (at_q) *at_q = best.at_q;
    return best.length;
}

double fw_geometry_contour_distance_below(const fw_geometry_contour *p,
                                          const fw_geometry_contour *q, double limit_m,
                                          fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    const fw_geometry_boxed once = {.contour = q}; /* its boxes are found as they are asked for */
    return fw_geometry_boxed_distance_below(p, &once, limit_m, at_p, at_q);
}

double fw_geometry_contour_distance(const fw_geometry_contour *p, const fw_geometry_contour *q,
                                    fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    return fw_geometry_contour_distance_below(p, q, HUGE_VAL, at_p, at_q);
}

/* Width and space of one outline: the shortest chord between two edges that face each other. */

enum { BOXED = 1024, SPAN = 8, WIDE = 64 };

typedef struct search {
    const fw_geometry_contour *contour;
    bool inside;
    unsigned except; /* flags: pairs that share one of them do not count */
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

static bool excepted(const search *in, int p, int q) {
    return in->contour->segment[p].flags & in->contour->segment[q].flags & in->except;
}

static void look_at_pair(const search *in, int p, int q, double gap, nearest *best) {
    if (excepted(in, p, q)) return;
    double here = pair_clearance(in, p, q, best->least, gap);
    if (here < best->least) *best = (nearest){here, p, q};
}

static bool is_joint(const fw_geometry_segment *s) {
    return s->flags & FW_SEGMENT_JOINT;
}

typedef struct boxes { /* of the first segments, each asked for many times */
    fw_geometry_box one[BOXED], run[BOXED / SPAN], wide[BOXED / WIDE];
    int count;
} boxes;

static void put_boxes(const fw_geometry_contour *c, boxes *b) {
    b->count = c->count < BOXED ? c->count : BOXED;
    for (int k = 0; k < b->count; k++) {
        fw_geometry_box *run = &b->run[k / SPAN];
        b->one[k] = fw_segment_box(&c->segment[k]);
        *run = k % SPAN ? fw_box_join(*run, b->one[k]) : b->one[k];
    }
    for (int r = 0; r * SPAN < b->count; r++) {
        fw_geometry_box *wide = &b->wide[r * SPAN / WIDE];
        *wide = r * SPAN % WIDE ? fw_box_join(*wide, b->run[r]) : b->run[r];
    }
}

static fw_geometry_box box_of(const search *in, const boxes *b, int k) {
    return k < b->count ? b->one[k] : fw_segment_box(&in->contour->segment[k]);
}

static bool far_off(const fw_geometry_box *own, const fw_geometry_box *there, double least) {
    return fw_box_apart(own, there, least) || fw_box_gap(*own, *there) >= least;
}

/* the first segment from q on that may be nearer than `least`, by runs of them; there is none before it */
static int pass_over(const boxes *b, const fw_geometry_box *own, int q, double least) {
    while (q % SPAN == 0 && q + SPAN <= b->count) {
        if (q % WIDE == 0 && q + WIDE <= b->count && far_off(own, &b->wide[q / WIDE], least))
            q += WIDE;
        else if (far_off(own, &b->run[q / SPAN], least))
            q += SPAN;
        else
            break;
    }
    return q;
}

/* segment p itself and with those behind it that are no neighbours */
static void look_beyond(const search *in, int p, const boxes *box, nearest *best) {
    const fw_geometry_contour *c = in->contour;
    fw_geometry_box own = box_of(in, box, p);
    double alone = own_clearance(&c->segment[p], in->inside);
    if (alone < best->least && !excepted(in, p, p)) *best = (nearest){alone, p, p};
    int end = p == 0 ? c->count - 1 : c->count;
    for (int q = p + 2; q < end; q++) {
        if (q % SPAN == 0 && (q = pass_over(box, &own, q, best->least)) >= end) break;
        const fw_geometry_segment *other = &c->segment[q];
        fw_geometry_box there = box_of(in, box, q);
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
    return fw_geometry_contour_clearance_except(contour, inside, limit_m, 0, i, j);
}

double fw_geometry_contour_clearance_except(const fw_geometry_contour *contour, bool inside,
                                            double limit_m, unsigned except, int *i, int *j) {
    search in = {contour, inside, except};
    nearest best = {limit_m, -1, -1};
    int n = contour->count;
    boxes box;
    put_boxes(contour, &box);
    for (int p = 0; p < n; p++)
        if (!is_joint(&contour->segment[p])) look_beyond(&in, p, &box, &best);
    for (int p = 0; p < n; p++) /* neighbours last: the limit may then spare them */
        for (int k = 0; k < 2; k++) {
            int q = k == 0 ? p + 1 : n - 1; /* the first one is the last one's neighbour, too */
            if (q >= n || q <= p || (k == 1 && (p > 0 || q == p + 1))) continue;
            if (is_joint(&contour->segment[p]) || is_joint(&contour->segment[q])) continue;
            double gap = fw_box_gap(box_of(&in, &box, p), box_of(&in, &box, q));
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

/* ---- many lines at once ---- */

fw_status fw_geometry_lines_new(fw_arena *arena, int n, fw_geometry_lines *to) {
    const size_t room = (size_t)n + FW_GEOMETRY_LINES_TOGETHER;
    double *all = fw_arena_array(arena, double, 4 * room);
    FW_NEED(all);
    *to = (fw_geometry_lines){all, all + room, all + 2 * room, all + 3 * room, 0};
    return FW_OK;
}

void fw_geometry_lines_add(fw_geometry_lines *to, double ax, double ay, double bx, double by) {
    const int i = to->n++;
    to->ax[i] = ax, to->ay[i] = ay, to->bx[i] = bx, to->by[i] = by;
}

/* four lines in a register, each with the operations of vec_line_foot in their order, so that every
   processor has the same bits */
__attribute__((always_inline)) static inline void squares_of(const fw_geometry_lines *l,
                                                             fw_geometry_vec2 at, double *off) {
    typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
    typedef long long mask __attribute__((vector_size(32), aligned(8), may_alias));
    for (int i = 0; i < l->n; i += FW_GEOMETRY_LINES_TOGETHER) {
        const four ax = *(const four *)(l->ax + i), ay = *(const four *)(l->ay + i),
                   bx = *(const four *)(l->bx + i), by = *(const four *)(l->by + i);
        const four way_x = bx - ax, way_y = by - ay, square = way_x * way_x + way_y * way_y;
        four here = ((at.x - ax) * way_x + (at.y - ay) * way_y) / square;
        here = (four)((mask)here & (square > 0));
        const mask first = here <= 0.5, between = (here > 0) & (here < 1); /* else an end itself */
        const four t = (four)((((mask)here & first) | ((mask)(here - 1) & ~first)) & between);
        const four x = (four)(((mask)ax & first) | ((mask)bx & ~first)) + t * way_x - at.x,
                   y = (four)(((mask)ay & first) | ((mask)by & ~first)) + t * way_y - at.y;
        *(four *)(off + i) = x * x + y * y;
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void squares_avx2(const fw_geometry_lines *l,
                                                         fw_geometry_vec2 at, double *off) {
    squares_of(l, at, off);
}
#endif

double fw_geometry_lines_least_square(const fw_geometry_lines *l, fw_geometry_vec2 at,
                                      double *off) {
    double least = HUGE_VAL;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        squares_avx2(l, at, off);
    else
#endif
        squares_of(l, at, off);
    for (int i = 0; i < l->n; i++)
        least = fw_lesser(least, off[i]);
    return least;
}
