/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Width and space between edges of the outlines: between which of them they are asked for, and what lies
   between two. */
#include "mask/rule.h"
#include <math.h>

/* ---- two edges ----
     - The rule is judged on what is written (rules_written.c). Here is said between which edges:
   those that face each other somewhere and are nearer than the rule and what flattening may take on
   both sides. Concentric arcs that face each other have their distance in closed form, R1 - R2; an
   arc faces itself where it turns by more than 90 degrees, over R sqrt 2 and more.
     - The measure, the least width and space of the certificate, is that of the exact outlines. It
   takes only chords that are square on edges or end at corners: from corners to both feet on an arc
   or the foot on a line, from corner to corner, square on both; and the diameter of half a turn.
   In: two edges, m. Error: a few ulp of the coordinates. Cost O(1), but O(n m) of what is written
   near edges that may break a rule. Theory: docs/theory/masks.md. Test: test_mask_rules.c,
   test_rules_search.c, test_rules_written.c. */

/* cosine between normals: below it they enclose more than 90 degrees. Not 0, so that the sides of a
   right angle do not face each other by rounding. */
static const double FACING = -1e-6;
/* Contacts so near the end that two edges share are that corner, found again: edges that part
   without a corner stay within 1e-12 m of each other for sqrt(2 R 1e-12 m), 45 nm at R = 1 mm. */
static const double NEAR_CORNER_M = 1e-7;
/* |cosine| of the angle between a chord and an edge: below it the chord is square on the edge */
static const double SQUARE = 1e-5;
/* |cosine| between a chord and a normal: below it the chord runs along the edge and leaves it on
   neither side */
static const double GRAZING = 1e-9;

/* a chord for the measure: kept where it is the shortest so far */
static void keep_if_least(fw_mask_rule_search *in, fw_mask_rule_kind what, fw_geometry_vec2 from,
                          fw_geometry_vec2 to, double length) {
    double *least = what == FW_RULE_WIDTH ? &in->measure->width_m : &in->measure->space_m;
    fw_geometry_vec2 *at = what == FW_RULE_WIDTH ? in->measure->width_at : in->measure->space_at;
    if (length >= *least) return;
    *least = length;
    at[0] = from;
    at[1] = to;
}

/* ---- chords ---- */

/* Outward normal of an edge, whose material is on its left, at a point on it. No angle is computed:
   that would cost time and digits. */
static fw_geometry_vec2 outward(const fw_mask_rule_edge *e, fw_geometry_vec2 at) {
    const fw_geometry_segment *s = &e->s;
    if (s->kind == FW_LINE) return (fw_geometry_vec2){e->along.y, -e->along.x};
    return vec_scale((s->sweep_rad > 0 ? 1 : -1) / s->radius, vec_sub(at, s->centre));
}

typedef struct crossing { /* a chord, as two edges see it */
    fw_mask_rule_kind kind;
    double length_m;
    double slant_p, slant_q; /* |cosine| of its angle with either edge */
} crossing;

/* What a chord crosses between two edges, or parts of them, for these have the edges' normals:
   empty space where it leaves p outward and arrives at q from outside, material where it does both
   on the inside. np: outward normal of p at its end. false: it counts for nothing, because the
   normals enclose at most 90 degrees, or it begins on one side and ends on the other. */
static bool crosses(const fw_mask_rule_edge *q, const fw_geometry_chord *chord, fw_geometry_vec2 np,
                    crossing *x) {
    fw_geometry_vec2 nq = outward(q, chord->at_q);
    if (!(vec_dot(np, nq) < FACING)) return false;
    fw_geometry_vec2 c = vec_sub(chord->at_q, chord->at_p);
    double length = vec_length(c);
    if (length <= FW_COINCIDENT_M) return false;
    double leaves = vec_dot(c, np) / length, arrives = -vec_dot(c, nq) / length;
    bool outside = leaves > GRAZING && arrives > GRAZING;
    bool inside = leaves < -GRAZING && arrives < -GRAZING;
    if (!outside && !inside) return false;
    *x = (crossing){outside ? FW_RULE_SPACE : FW_RULE_WIDTH, length,
                    fabs(vec_cross(c, np)) / length, fabs(vec_cross(c, nq)) / length};
    return true;
}

/* t: place along the edge, 0 at its beginning and 1 at its end */
static bool at_corner(const fw_mask_rule_edge *e, double t) {
    return (t <= 0 && e->corner_a) || (t >= 1 && e->corner_b);
}

static void measure_chord(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                          const fw_mask_rule_edge *q, const fw_geometry_chord *chord) {
    crossing x;
    fw_geometry_vec2 c = vec_sub(chord->at_q, chord->at_p), np = outward(p, chord->at_p);
    double least = vec_dot(c, np) > 0 ? in->measure->space_m : in->measure->width_m;
    if (vec_dot(c, c) > least * least * (1 + 1e-12)) return; /* it is not the least one */
    if (!crosses(q, chord, np, &x)) return;
    if ((x.slant_p < SQUARE || at_corner(p, chord->tp)) &&
        (x.slant_q < SQUARE || at_corner(q, chord->tq)))
        keep_if_least(in, x.kind, chord->at_p, chord->at_q, x.length_m);
}

/* from the corners of p to the farther foot on an arc: the nearer one is among the chords */
static void measure_far_feet(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                             const fw_mask_rule_edge *q) {
    if (q->s.kind != FW_ARC) return;
    for (int end = 0; end < 2; end++) {
        if (!(end ? p->corner_b : p->corner_a)) continue;
        fw_geometry_chord chord = {.tp = end, .at_p = end ? p->s.b : p->s.a};
        fw_geometry_vec2 ray = vec_unit(vec_sub(q->s.centre, chord.at_p));
        if (!fw_geometry_segment_faces(&q->s, ray, &chord.tq)) continue;
        chord.at_q = vec_along(q->s.centre, q->s.radius, ray);
        measure_chord(in, p, q, &chord);
    }
}

/* chord (n): of the whole edges */
static void measure_pair(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                         const fw_mask_rule_edge *q, const fw_geometry_chord *chord, int n) {
    for (int i = 0; i < n; i++)
        measure_chord(in, p, q, &chord[i]);
    measure_far_feet(in, p, q);
    measure_far_feet(in, q, p);
}

/* ---- the rule ---- */

/* the longest chord of either kind that breaks a rule; 0: there is no rule */
static double needed_of(const fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                        const fw_mask_rule_edge *q) {
    double slack = p->slack_m + q->slack_m;
    return fw_greater(fw_mask_rule_needed(in, FW_RULE_WIDTH, slack),
                      fw_mask_rule_needed(in, FW_RULE_SPACE, slack));
}

/* is the least of all chords between edges that do not meet, and with it every chord between parts
   of them, longer than that? */
static bool all_longer(const fw_geometry_chord *chord, int n, double needed) {
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 c = vec_sub(chord[i].at_q, chord[i].at_p);
        if (vec_dot(c, c) < needed * needed * (1 + 1e-9)) return false;
    }
    return true;
}

/* Chord (nchord): of the whole edges. First what shows cheaply that no chord is short enough;
   `everything` passes over that, so that tests can compare. meet: the edges touch or cross. square:
   they meet at a corner that is not below 90 degrees. */
static void judge_pair(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q,
                       const fw_geometry_chord *chord, int nchord, bool meet, bool square) {
    double needed = needed_of(in, p, q);
    if (!in->everything && (!(fw_box_gap(p->box, q->box) < needed) ||
                            !(fw_geometry_segment_clear_of(&p->s, &q->box) < needed) ||
                            !(fw_geometry_segment_clear_of(&q->s, &p->box) < needed)))
        return;
    if (!in->everything && !meet && all_longer(chord, nchord, needed)) return;
    fw_mask_rule_judge(in, p, q, square);
}

/* Concentric arcs that face each other: R1 - R2 is square on both and the least chord of the pair.
   The outer one, when it turns left, has its material towards the inner one. true: that was all
   there is to say of the pair. */
static bool concentric(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q) {
    fw_geometry_vec2 along;
    double gap = in->everything ? HUGE_VAL : fw_geometry_concentric_gap(&p->s, &q->s, &along);
    if (isinf(gap)) return false;
    bool material = (p->s.radius > q->s.radius) == (p->s.sweep_rad > 0);
    fw_mask_rule_kind kind = material ? FW_RULE_WIDTH : FW_RULE_SPACE;
    fw_geometry_vec2 at_p = vec_along(p->s.centre, p->s.radius, along);
    fw_geometry_vec2 at_q = vec_along(p->s.centre, q->s.radius, along);
    keep_if_least(in, kind, at_p, at_q, gap);
    if (gap < needed_of(in, p, q)) fw_mask_rule_judge(in, p, q, false);
    return true;
}

/* Can chords of an arc of more than 90 degrees that face each other be nearer than the rule? They
   are 2 R sin(45 deg - x) apart and more, where 2 x is the turn from one chord to the next: x = acos(1
   - eps/R), or with vertices outside of the arc acos(1 - 2 eps/R), which is at most (pi/2) sqrt(2
   eps/R); and sin(45 deg - x) >= (1 - 1.4 x) sin 45 deg. */
static bool may_break(const fw_mask_rule_search *in, const fw_mask_rule_edge *e,
                      fw_mask_rule_kind kind) {
    double needed = fw_mask_rule_needed(in, kind, 2 * e->slack_m), quarter = sqrt(2) * e->s.radius;
    if (quarter >= 4 * needed && e->s.radius > 20 * in->tolerance_m) return false;
    return quarter * (1 - 3.12 * sqrt(in->tolerance_m / e->s.radius)) < needed;
}

/* An arc and itself. It faces itself where it turns by more than 90 degrees. For the measure the
   diameter counts, and the chord between its ends where both are corners. */
static void look_at_own(fw_mask_rule_search *in, fw_mask_rule_edge *e) {
    static const double half_turn = FW_PI * (1 - 1e-12);
    double sweep = fabs(e->s.sweep_rad);
    if (e->s.kind != FW_ARC || !(cos(fw_lesser(sweep, FW_PI)) < FACING))
        return; /* a rounded corner */
    fw_mask_rule_kind kind = e->s.sweep_rad > 0 ? FW_RULE_WIDTH : FW_RULE_SPACE;
    if (may_break(in, e, kind)) fw_mask_rule_judge(in, e, e, false);
    if (sweep >= half_turn) { /* from the middle of the first quarter and across */
        fw_geometry_vec2 from =
            fw_geometry_segment_point(&e->s, 0.5 * fw_greater(0, 1 - FW_PI / sweep));
        keep_if_least(in, kind, from, vec_sub(vec_scale(2, e->s.centre), from), 2 * e->s.radius);
    }
    if (e->corner_a && e->corner_b)
        keep_if_least(in, kind, e->s.a, e->s.b, vec_distance(e->s.a, e->s.b));
}

/* ---- contacts ---- */

/* does p end where q begins, at a corner that is square, or blunter? */
static bool square_corner(const fw_mask_rule_edge *p, const fw_mask_rule_edge *q) {
    return p->corner_b &&
           vec_dot(fw_geometry_segment_tangent(&p->s, 1), fw_geometry_segment_tangent(&q->s, 0)) >=
               FACING - fw_mask_rule_lean(p, q);
}

/* Reports, as overlaps, all places where two edges meet that are no corners: pieces of one layer may
   touch at joints alone. True where the edges meet at all; *square: at corners that are not below 90
   degrees. */
static bool look_at_contacts(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                             const fw_mask_rule_edge *q, bool *square) {
    bool p_then_q = vec_same(p->s.b, q->s.a), q_then_p = vec_same(q->s.b, p->s.a);
    *square = (p_then_q || q_then_p) && (!p_then_q || square_corner(p, q)) &&
              (!q_then_p || square_corner(q, p));
    fw_geometry_hit hit[FW_MOST_HITS];
    int n = fw_geometry_segment_intersect(&p->s, &q->s, hit);
    for (int i = 0; i < n; i++) {
        bool corner = (p_then_q && vec_distance(hit[i].at, p->s.b) < NEAR_CORNER_M) ||
                      (q_then_p && vec_distance(hit[i].at, q->s.b) < NEAR_CORNER_M);
        if (!corner)
            fw_mask_rule_report(in, (fw_mask_rule_finding){.kind = FW_RULE_OVERLAP,
                                                           .shape = {p->shape, q->shape},
                                                           .segment = {p->segment, q->segment},
                                                           .at = {hit[i].at, hit[i].at},
                                                           .edge = {p, q}});
    }
    return n > 0;
}

/* Does no normal of p enclose more than 90 degrees with one of q? None does when the angle between
   the tangents in the middle and half of either sweep add up to at most 90 degrees: cos(angle) >=
   sin(halves). Another 4e-7 rad are let pass, for right angles with rounding: less than the 1e-6
   that FACING leaves out anyway. Sweeps that add up to half a turn or more are not decided here. */
static bool look_away(const fw_mask_rule_edge *p, const fw_mask_rule_edge *q) {
    if (!(p->cos_half > 0 && q->cos_half > 0)) return false;
    double sine = p->sin_half * q->cos_half + p->cos_half * q->sin_half;
    double cosine = p->cos_half * q->cos_half - p->sin_half * q->sin_half;
    return cosine > 1e-3 && vec_dot(p->along, q->along) >= sine - 4e-7 * cosine;
}

static void look_at_pair(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q) {
    bool touch = fw_box_gap(p->box, q->box) <= FW_COINCIDENT_M, square = false;
    bool away = look_away(p, q);
    if (!in->everything && away) {
        /* one after the other they run along one direction: they meet at their corner alone */
        bool joined = vec_same(p->s.b, q->s.a) || vec_same(q->s.b, p->s.a);
        if (touch && !joined) look_at_contacts(in, p, q, &square);
        return;
    }
    double clear = fw_greater(fw_geometry_segment_clear_of(&p->s, &q->box),
                              fw_geometry_segment_clear_of(&q->s, &p->box));
    if (!in->everything && clear > fw_greater(fw_mask_rule_bound(in, FW_RULE_WIDTH),
                                              fw_mask_rule_bound(in, FW_RULE_SPACE)))
        return;
    if (concentric(in, p, q)) return; /* they cannot meet either */
    bool meet = touch && look_at_contacts(in, p, q, &square);
    fw_geometry_chord chord[FW_MOST_CHORDS];
    int n = fw_geometry_segment_chords(&p->s, &q->s, chord);
    measure_pair(in, p, q, chord, n);
    if (!away) judge_pair(in, p, q, chord, n, meet, square);
}

/* ---- which pairs ----
   Which pairs of edges are looked at: shapes whose boxes are near enough, by a sweep along x, and
   of those the edges whose boxes are. Cost O(n log n + pairs of neighbours). Test:
   test_rules_search.c. */

static double reach(const fw_mask_rule_search *in) {
    return fw_greater(fw_mask_rule_bound(in, FW_RULE_WIDTH), fw_mask_rule_bound(in, FW_RULE_SPACE));
}

static void look_inside(fw_mask_rule_search *in, const fw_mask_rule_range *r) {
    fw_mask_rule_edge *e = in->edge + r->first;
    for (int i = 0; i < r->count && !in->crowded; i++) {
        look_at_own(in, &e[i]);
        double far = reach(in); /* only a pair that was looked at changes it */
        fw_geometry_box own = e[i].box;
        for (int j = i + 1; j < r->count && e[j].box.x0 - own.x1 <= far; j++) {
            if (fw_box_beyond(&own, &e[j].box, far)) continue;
            look_at_pair(in, &e[i], &e[j]);
            far = reach(in);
        }
    }
}

static void look_between(fw_mask_rule_search *in, const fw_mask_rule_range *r,
                         const fw_mask_rule_range *s) {
    for (int i = 0; i < r->count && !in->crowded; i++) {
        fw_mask_rule_edge *p = &in->edge[r->first + i], *q = &in->edge[s->first];
        fw_geometry_box own = p->box;
        double far = reach(in);
        if (fw_box_beyond(&own, &s->box, far)) continue;
        for (int j = 0; j < s->count && q[j].box.x0 - own.x1 <= far; j++) {
            if (fw_box_beyond(&own, &q[j].box, far)) continue;
            look_at_pair(in, p, &q[j]);
            far = reach(in);
        }
    }
}

static void search_pairs(fw_mask_rule_search *in) {
    for (int i = 0; i < in->nrange; i++) /* first: what a shape measures bounds the rest */
        look_inside(in, &in->range[i]);
    for (int i = 0; i < in->nrange && !in->crowded; i++)
        for (int j = i + 1; j < in->nrange; j++) {
            const fw_mask_rule_range *r = &in->range[i], *s = &in->range[j];
            double far = reach(in);
            if (s->box.x0 - r->box.x1 > far) break;
            if (fw_box_gap(r->box, s->box) <= far) look_between(in, r, s);
        }
}

/* Near pairs first: most layers have a width and a space of some um, and then nothing beyond these
   is looked at. Where they have not, again up to what was found, or with a larger cap. What stands
   in the end is what the last round alone finds, in its order. */
void fw_mask_rule_search_run(fw_mask_rule_search *in) {
    for (double cap_m = 12e-6;;) {
        in->cap_m = fw_lesser(cap_m, FW_MASK_LOOK_M);
        in->measure->width_m = in->measure->space_m = HUGE_VAL;
        in->nfound = 0;
        search_pairs(in);
        double found_m = fw_greater(in->measure->width_m, in->measure->space_m);
        if (in->crowded || in->everything || found_m <= in->cap_m || in->cap_m >= FW_MASK_LOOK_M)
            return;
        cap_m = isinf(found_m) ? 3 * cap_m : found_m;
    }
}
