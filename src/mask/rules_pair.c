/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Width and space between two edges: chords between points whose outward normals enclose more than
   90 degrees, that leave both edges through material (width) or through empty space (space).
     - The rule judges every such chord and makes findings. Arcs are taken in parts of at most 7.5
   degrees, because the shortest chord of two whole arcs may be one that the limit of 90 degrees
   leaves out; so the limit is met to the size of a part. Concentric arcs that face each other, and
   an arc that faces itself, have theirs in closed form: R1 - R2, and R sqrt 2 over a quarter turn,
   where the limit begins.
     - The measure, the least width and space of the certificate, takes only chords that are square
   on edges or end at corners: from corners to both feet on an arc or the foot on a line, from
   corner to corner, square on both; and the diameter of half a turn.
   In: two edges, m. Error: a few ulp of the coordinates. Cost O(1), but O(parts) near edges that
   break a rule. Source: Euclidian width and space with a 90 deg limit, as KLayout has it. Theory:
   docs/theory/masks.md. Test: test_mask_rules.c, test_rules_search.c. */
#include "mask/rule.h"

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

enum { MOST_PARTS = 64 }; /* of an edge: a whole turn has 48 of 7.5 degrees */

/* ---- findings ---- */

void fw_mask_rule_add(fw_mask_rule_search *in, fw_mask_rule_finding f) {
    if (in->nfound == in->room) {
        size_t more = in->room ? 2 * (size_t)in->room : 16;
        fw_mask_rule_finding *grown =
            fw_arena_grow(in->arena, in->found, (size_t)in->nfound, more, sizeof f);
        if (!grown) {
            in->no_memory = true;
            return;
        }
        in->found = grown;
        in->room = (int)more;
    }
    in->found[in->nfound++] = f;
}

void fw_mask_rule_report(fw_mask_rule_search *in, fw_mask_rule_finding f) {
    if (f.shape[0] > f.shape[1] || (f.shape[0] == f.shape[1] && f.segment[0] > f.segment[1]))
        f = (fw_mask_rule_finding){.kind = f.kind,
                                   .shape = {f.shape[1], f.shape[0]},
                                   .segment = {f.segment[1], f.segment[0]},
                                   .value_m = f.value_m,
                                   .slack_m = f.slack_m,
                                   .at = {f.at[1], f.at[0]},
                                   .edge = {f.edge[1], f.edge[0]},
                                   .box = f.box};
    fw_mask_rule_add(in, f);
}

/* a chord for the rule: a finding where it is shorter than the rule asks, by more than rounding */
static void report_if_short(fw_mask_rule_search *in, fw_mask_rule_kind what,
                            const fw_mask_rule_edge *p, const fw_mask_rule_edge *q, double length,
                            fw_geometry_vec2 at_p, fw_geometry_vec2 at_q) {
    double slack = p->slack_m + q->slack_m;
    if (length < fw_mask_rule_needed(in, what, slack) - FW_COINCIDENT_M)
        fw_mask_rule_report(in, (fw_mask_rule_finding){.kind = what,
                                                       .shape = {p->shape, q->shape},
                                                       .segment = {p->segment, q->segment},
                                                       .value_m = length,
                                                       .slack_m = slack,
                                                       .at = {at_p, at_q},
                                                       .edge = {p, q}});
}

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

/* chord (n): of the two edges, or of two parts of them */
static void judge_chords(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                         const fw_mask_rule_edge *q, const fw_geometry_chord *chord, int n) {
    crossing x;
    double needed = needed_of(in, p, q);
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 c = vec_sub(chord[i].at_q, chord[i].at_p);
        if (vec_dot(c, c) > needed * needed * (1 + 1e-12)) continue;
        if (crosses(q, &chord[i], outward(p, chord[i].at_p), &x))
            report_if_short(in, x.kind, p, q, x.length_m, chord[i].at_p, chord[i].at_q);
    }
}

/* Can any two points of parts of at most 7.5 degrees face each other? By the normals of their
   middles, which are the directions of their chords turned alike: either is off by at most 3.75
   degrees, so the limit is the cosine of 90 - 7.5 degrees, 0.13053, rounded to the safe side. */
static bool may_face(const fw_geometry_segment *s, const fw_geometry_segment *t) {
    static const double limit = 0.1306;
    fw_geometry_vec2 u = vec_sub(s->b, s->a), v = vec_sub(t->b, t->a);
    return vec_dot(u, v) < limit * sqrt(vec_dot(u, u) * vec_dot(v, v));
}

static void judge_parts(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q, int i,
                        int j) {
    fw_geometry_chord chord[FW_MOST_CHORDS];
    judge_chords(in, p, q, chord, fw_geometry_segment_chords(&p->part[i], &q->part[j], chord));
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

/* Chord (nchord): of the whole edges; two lines have no others. First what shows cheaply that no
   chord is short enough; `everything` passes over that, so that tests can compare. meet: the edges
   touch or cross, so that the shortest chord of the whole says nothing of the parts. */
static void judge_pair(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q,
                       const fw_geometry_chord *chord, int nchord, bool meet) {
    double needed = needed_of(in, p, q);
    if (!in->everything && (!(fw_box_gap(p->box, q->box) < needed) ||
                            !(fw_geometry_segment_clear_of(&p->s, &q->box) < needed) ||
                            !(fw_geometry_segment_clear_of(&q->s, &p->box) < needed)))
        return;
    if (!in->everything && !meet && all_longer(chord, nchord, needed)) return;
    if (p->s.kind == FW_LINE && q->s.kind == FW_LINE) {
        if (in->everything || may_face(&p->s, &q->s)) judge_chords(in, p, q, chord, nchord);
        return;
    }
    if (!fw_mask_rule_parts(in, p) || !fw_mask_rule_parts(in, q)) return;
    int near[MOST_PARTS], n = 0; /* parts of q that are near p at all */
    for (int j = 0; j < q->nparts; j++)
        if (fw_box_gap(p->box, q->part_box[j]) < needed || in->everything) near[n++] = j;
    for (int i = 0; i < p->nparts; i++) {
        if (fw_box_gap(p->part_box[i], q->box) >= needed && !in->everything) continue;
        for (int k = 0; k < n; k++)
            if (in->everything || (fw_box_gap(p->part_box[i], q->part_box[near[k]]) < needed &&
                                   may_face(&p->part[i], &q->part[near[k]])))
                judge_parts(in, p, q, i, near[k]);
    }
}

/* Concentric arcs that face each other: R1 - R2 is square on both and the least chord of the pair.
   The outer one, when it turns left, has its material towards the inner one. true: that was all
   there is to say of the pair. */
static bool concentric(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                       const fw_mask_rule_edge *q) {
    fw_geometry_vec2 along;
    double gap = in->everything ? HUGE_VAL : fw_geometry_concentric_gap(&p->s, &q->s, &along);
    if (isinf(gap)) return false;
    bool material = (p->s.radius > q->s.radius) == (p->s.sweep_rad > 0);
    fw_mask_rule_kind kind = material ? FW_RULE_WIDTH : FW_RULE_SPACE;
    fw_geometry_vec2 at_p = vec_along(p->s.centre, p->s.radius, along);
    fw_geometry_vec2 at_q = vec_along(p->s.centre, q->s.radius, along);
    keep_if_least(in, kind, at_p, at_q, gap);
    report_if_short(in, kind, p, q, gap, at_p, at_q);
    return true;
}

/* An arc and itself. It faces itself where it turns by more than 90 degrees. For the rule the chord
   over a quarter turn is the shortest one there is, and one in the middle stands for all of them.
   For the measure the diameter counts, and the chord between its ends where both are corners. */
void fw_mask_rule_own(fw_mask_rule_search *in, fw_mask_rule_edge *e) {
    static const double half_turn = FW_PI * (1 - 1e-12);
    double sweep = fabs(e->s.sweep_rad);
    if (e->s.kind != FW_ARC || !(cos(fw_lesser(sweep, FW_PI)) < FACING))
        return; /* a rounded corner */
    fw_mask_rule_kind kind = e->s.sweep_rad > 0 ? FW_RULE_WIDTH : FW_RULE_SPACE;
    double quarter = sqrt(2) * e->s.radius; /* the chord over a quarter turn */
    if (quarter < fw_mask_rule_needed(in, kind, 2 * e->slack_m)) {
        double eighth = 0.25 * FW_PI / sweep; /* of a turn, as a share of the edge */
        report_if_short(in, kind, e, e, quarter, fw_geometry_segment_point(&e->s, 0.5 - eighth),
                        fw_geometry_segment_point(&e->s, 0.5 + eighth));
    }
    if (sweep >= half_turn) { /* from the middle of the first quarter and across */
        fw_geometry_vec2 from =
            fw_geometry_segment_point(&e->s, 0.5 * fw_greater(0, 1 - FW_PI / sweep));
        keep_if_least(in, kind, from, vec_sub(vec_scale(2, e->s.centre), from), 2 * e->s.radius);
    }
    if (e->corner_a && e->corner_b)
        keep_if_least(in, kind, e->s.a, e->s.b, vec_distance(e->s.a, e->s.b));
}

/* ---- contacts ---- */

/* p ends where q begins: a corner of the union. Sharper than 90 degrees it is a width or a space
   that goes to nothing. */
static void look_at_corner(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                           const fw_mask_rule_edge *q) {
    fw_geometry_vec2 before = fw_geometry_segment_tangent(&p->s, 1),
                     after = fw_geometry_segment_tangent(&q->s, 0);
    if (vec_dot(before, after) < FACING)
        report_if_short(in, vec_cross(before, after) > 0 ? FW_RULE_WIDTH : FW_RULE_SPACE, p, q, 0,
                        p->s.b, p->s.b);
}

/* Reports corners that are too sharp and, as overlaps, all other places where two edges meet:
   pieces of one layer may touch at joints alone. True where the edges meet at all. */
static bool look_at_contacts(fw_mask_rule_search *in, const fw_mask_rule_edge *p,
                             const fw_mask_rule_edge *q) {
    bool p_then_q = vec_same(p->s.b, q->s.a), q_then_p = vec_same(q->s.b, p->s.a);
    if (p_then_q) look_at_corner(in, p, q);
    if (q_then_p) look_at_corner(in, q, p);
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

void fw_mask_rule_pair(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q) {
    bool touch = fw_box_gap(p->box, q->box) <= FW_COINCIDENT_M;
    if (!in->everything && look_away(p, q)) {
        /* one after the other they run along one direction: they meet at their corner alone */
        bool joined = vec_same(p->s.b, q->s.a) || vec_same(q->s.b, p->s.a);
        if (touch && !joined) look_at_contacts(in, p, q);
        return;
    }
    double clear = fw_greater(fw_geometry_segment_clear_of(&p->s, &q->box),
                              fw_geometry_segment_clear_of(&q->s, &p->box));
    if (!in->everything && clear > fw_greater(fw_mask_rule_bound(in, FW_RULE_WIDTH),
                                              fw_mask_rule_bound(in, FW_RULE_SPACE)))
        return;
    if (concentric(in, p, q)) return; /* they cannot meet either */
    bool meet = touch && look_at_contacts(in, p, q);
    fw_geometry_chord chord[FW_MOST_CHORDS];
    int n = fw_geometry_segment_chords(&p->s, &q->s, chord);
    measure_pair(in, p, q, chord, n);
    judge_pair(in, p, q, chord, n, meet);
}
