/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What ways of one body (body_arms.c) bear together where they go together. */
#include "geometry/segment.h"
#include "maths/dense.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- ways that go together ----
   Every end of a body has a way to the body's middle, on which it bears its own wrench: an arm. Stresses of all of them add up,
   and where ways go together one strip, a trunk, bears the sum of the wrenches of its ends:

     2 E h U = sum over trunks (sum w_i).t.(sum w_i)

   t the form of a trunk, the part of ways that the same ends have; one end alone has the first part of its way. Ways are the
   stiffest to one place: where two have met they stay together, and a trunk is found from the middle back to where its ways
   part by more than half of its width, or by 60 degrees. Of a motion the arms' own sum stays, and trunks add by how much more they
   store by the sum than by each wrench (fw_verdict_shared_J): those of which that is less lose nothing, and what gives less
   than a 200th of its ways is left out.
   In: strips, world, m; wrenches about the body's middle. Error: strips_less. Cost: squares of the ends, times pieces.
   Source: least complementary energy (S. Timoshenko, J. Goodier, Theory of Elasticity, 3rd ed., art. 86). Test:
   test_effects.py BodiesOfBars */

/* from which piece of way a on it goes with way b; a->to->nstrip: nowhere */
static int meets_from(const fw_verdict_arm_end *a, const fw_verdict_arm_end *b, double cell) {
    int k = a->to->nstrip, at = b->to->nstrip - 1;
    for (; k > 0 && at >= 0; k--) {
        const fw_verdict_strip *s = &a->to->strip[k - 1];
        double off = vec_distance(b->to->strip[at].at, s->at);
        for (double next; at > 0 && (next = vec_distance(b->to->strip[at - 1].at, s->at)) <= off;
             at--)
            off = next;
        const fw_geometry_vec2 with = vec_sub(b->to->strip[at].until, b->to->strip[at].from),
                               own = vec_sub(s->until, s->from);
        if (off > 0.5 * fmax(s->w, b->to->strip[at].w) + 1.5 * cell) break;
        if (vec_dot(own, with) < 0.5 * vec_length(own) * vec_length(with))
            break; /* it comes from elsewhere */
    }
    return k;
}

/* the part of an arm's own give that a trunk is, at most */
static double part_of(const double t[6], fw_geometry_vec2 about, const fw_verdict_arm_end *end) {
    const fw_geometry_vec2 p = vec_sub(end->pin, about);
    const double *g = end->to->give,
                 forces = t[3] + t[5] - 2 * p.y * t[1] + 2 * p.x * t[2] + vec_dot(p, p) * t[0];
    return fmax(t[0] / g[0], forces / (g[3] + g[5]));
}

static bool counts(const fw_verdict_arm_end *end, const int *member, int n,
                   const fw_verdict_shared *s, const double t[6]) {
    const double hardly = 0.005;
    bool any = false;
    for (int k = 0; k < n; k++)
        any = any || part_of(t, s->about, &end[member[k]]) > hardly;
    return any;
}

/* pieces `from` to `until` of way i, of all members */
static fw_status add_trunk(fw_arena *arena, const fw_verdict_arm_end *end, int i, int from,
                           int until, const int *member, int n, fw_verdict_shared *to) {
    fw_verdict_arm piece = {.narrow_m = HUGE_VAL};
    struct fw_verdict_trunk *t = &to->trunk[to->n++];
    for (int k = from; k < until; k++) {
        const fw_verdict_strip *s = &end[i].to->strip[k];
        fw_verdict_arm_add(&piece, to->about, s->at, s->from, s->until, s->w);
    }
    memcpy(t->give, piece.give, sizeof t->give);
    t->strip = end[i].to->strip + from, t->nstrip = until > from ? until - from : 0;
    t->counts = n > 1 && counts(end, member, n, to, piece.give);
    to->counts = to->counts || t->counts;
    FW_NEED(t->end = fw_arena_array(arena, int, (size_t)n));
    for (int k = 0; k < n; k++)
        t->end[t->n++] = end[member[k]].index;
    return FW_OK;
}

/* what way i has for itself, and with those behind it, up to where it meets one before it, which has the rest */
static fw_status trunks_of(fw_arena *arena, const fw_verdict_arm_end *end, int n, int i,
                           const int *with, int *member, fw_verdict_shared *to) {
    int until = end[i].to->nstrip, from = until;
    for (int j = 0; j < i; j++)
        until = with[j] < until ? with[j] : until;
    for (int j = i + 1; j < n; j++)
        from = with[j] < from ? with[j] : from;
    member[0] = i;
    FW_TRY(add_trunk(arena, end, i, 0, from < until ? from : until, member, 1, to));
    for (int next; from < until; from = next) {
        int many = 1;
        next = until;
        for (int j = i + 1; j < n; j++)
            if (with[j] <= from)
                member[many++] = j;
            else if (with[j] < next)
                next = with[j];
        FW_TRY(add_trunk(arena, end, i, from, next, member, many, to));
    }
    return FW_OK;
}

fw_status fw_verdict_ways_meet(fw_arena *arena, const fw_verdict_arm_end *end, int n, double cell,
                               fw_geometry_vec2 about) {
    fw_verdict_shared *to = fw_arena_one(arena, fw_verdict_shared);
    int *with = fw_arena_array(arena, int, 2 * (size_t)n + 1);
    FW_NEED(to && with ? to : NULL);
    to->about = about, to->first = n > 0 ? end[0].index : 0;
    FW_NEED(to->trunk = fw_arena_array(arena, struct fw_verdict_trunk, (size_t)n * (size_t)n + 1));
    for (int i = 0; i < n; i++) {
        if (!end[i].to->known) continue;
        for (int j = 0; j < n; j++)
            with[j] =
                end[j].to->known && j != i ? meets_from(&end[i], &end[j], cell) : end[i].to->nstrip;
        FW_TRY(trunks_of(arena, end, n, i, with, with + n, to));
    }
    for (int i = 0; to->counts && i < n; i++)
        end[i].to->shared = to;
    return FW_OK;
}

static double stored_twice(const double g[6], const double w[3]) {
    return g[0] * w[0] * w[0] + 2 * w[0] * (g[1] * w[1] + g[2] * w[2]) + g[3] * w[1] * w[1] +
           2 * g[4] * w[1] * w[2] + g[5] * w[2] * w[2];
}

double fw_verdict_arm_J(const fw_verdict_arm *arm, double stiff_N, const double w[3]) {
    return stored_twice(arm->give, w) / (2 * stiff_N);
}

void fw_verdict_end_put(const double on[3], int side, const fw_verdict_turn *turn, double w[3]) {
    const double sign = side ? 1 : -1, x = sign * on[1], y = sign * on[2];
    w[0] = -sign * on[0];
    w[1] = turn->cosine * x + turn->sine * y, w[2] = turn->cosine * y - turn->sine * x;
}

void fw_verdict_wrench_about(fw_geometry_vec2 pin, fw_geometry_vec2 about, const double w[3],
                             double to[3]) {
    to[0] = w[0] + (pin.x - about.x) * w[2] - (pin.y - about.y) * w[1];
    to[1] = w[1], to[2] = w[2];
}

/* what the ends of a trunk put on it together, and 2 E h times what it stores by each */
static double sum_of(const struct fw_verdict_trunk *t, const double *w, int nw, double all[3]) {
    double each = 0;
    all[0] = all[1] = all[2] = 0;
    for (int k = 0; k < t->n; k++) {
        const double *one = w + 3 * t->end[k];
        if (t->end[k] >= nw) continue;
        all[0] += one[0], all[1] += one[1], all[2] += one[2];
        each += stored_twice(t->give, one);
    }
    return each;
}

double fw_verdict_shared_J(const fw_verdict_shared *s, double stiff_N, const double *w, int nw) {
    double sum = 0, all[3];
    for (int i = 0; i < s->n; i++)
        if (s->trunk[i].counts) {
            const double each = sum_of(&s->trunk[i], w, nw, all);
            sum += fmax(stored_twice(s->trunk[i].give, all) - each, 0);
        }
    return sum / (2 * stiff_N);
}

static double trunks_J(const fw_verdict_shared *s, double stiff_N, const double *w, int nw) {
    double sum = 0, all[3];
    for (int i = 0; i < s->n; i++) {
        sum_of(&s->trunk[i], w, nw, all);
        sum += stored_twice(s->trunk[i].give, all);
    }
    return sum / (2 * stiff_N);
}

/* ---- bodies as a flow makes them ----
   Where edges stand in by e on both sides, a strip of width w as drawn is w - 2 e wide: an arm gives (w/(w - 2 e))^3 as much by
   moments and w/(w - 2 e) by forces, piece by piece, and so does a trunk. Where edges stand out bodies count as drawn, since what
   is made holds what the drawn device may give. Thickness and modulus are in E h. A plane solid of the drawn outlines (its mesh is
   what costs) gives as many times as much as its ways do by any wrench at most, the largest eigenvalue q of

     give as made - q give as drawn

   of any of the ways that bear. In: strips, m; e, m. Error: walls that lean leave more than their mid-depth (theory, (2)). Cost: of a
   piece some 50 operations. Test: test_body_arms.c arms_as_made; test_effects.py AsMade */

/* to: over the sizes of its own axes */
static void whole_form(const double g[6], const double size[3], double to[9]) {
    static const int at[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
    for (int k = 0; k < 9; k++)
        to[k] = g[at[k]] / (size[k / 3] * size[k % 3]);
}

/* q, by powers of drawn^-1 (made - drawn); where the form has a nought all of it is as the narrowest place */
static double most_softer(const fw_verdict_arm *drawn, const double made[6], double edge_m) {
    enum { TIMES = 300 };
    const double *g = drawn->give, size[3] = {sqrt(g[0]), sqrt(g[3]), sqrt(g[5])},
                 narrow = pow(drawn->narrow_m / fw_verdict_made_m(drawn->narrow_m, edge_m), 3);
    double was[9], root[9], more[9], x[3] = {1, 1.3, 1.7}, most = 0;
    if (!(g[0] > 0 && g[3] > 0 && g[5] > 0)) return narrow;
    whole_form(g, size, was), whole_form(g, size, root), whole_form(made, size, more);
    for (int k = 0; k < 9; k++)
        more[k] -= was[k];
    if (!fw_maths_cholesky(3, root)) return narrow;
    for (int turn = 0; turn < TIMES; turn++) {
        double y[3], up = 0, down = 0;
        for (int i = 0; i < 3; i++) {
            y[i] = more[3 * i] * x[0] + more[3 * i + 1] * x[1] + more[3 * i + 2] * x[2];
            up += x[i] * y[i];
            down += x[i] * (was[3 * i] * x[0] + was[3 * i + 1] * x[1] + was[3 * i + 2] * x[2]);
        }
        if (!(up > 0)) break;
        most = fmax(most, up / down);
        (void)fw_maths_cholesky_solve(3, root, y);
        for (int i = 0; i < 3; i++)
            x[i] = y[i] / sqrt(up);
    }
    return fmin(1 + most, narrow);
}

/* what pieces of a way give about a place */
static void strips_give(const fw_verdict_strip *strip, int n, double edge_m, fw_geometry_vec2 about,
                        fw_verdict_arm *to) {
    for (int k = 0; k < n; k++)
        fw_verdict_arm_add(to, about, strip[k].at, strip[k].from, strip[k].until,
                           fw_verdict_made_m(strip[k].w, edge_m));
}

/* a straight way has kept no pieces: all of it as its narrowest place */
static void arm_made(const fw_verdict_arm *arm, double edge_m, fw_verdict_arm *to) {
    fw_verdict_arm gives = {.narrow_m = HUGE_VAL};
    const double wide = arm->narrow_m / fw_verdict_made_m(arm->narrow_m, edge_m),
                 cube = arm->nstrip > 0 ? 1 : pow(wide, 3), one = arm->nstrip > 0 ? 1 : wide;
    to->softer = 1;
    if (!arm->known || !(arm->length_m > 0)) return; /* a load may act on the middle itself */
    strips_give(arm->strip, arm->nstrip, edge_m, arm->pin, &gives);
    const fw_verdict_arm *from = arm->nstrip > 0 ? &gives : arm;
    for (int k = 0; k < 6; k++) {
        to->give[k] = cube * from->give[k], to->bend[k] = one * from->bend[k];
        to->twist[k] = one * from->twist[k], to->twist3[k] = cube * from->twist3[k];
    }
    to->slide = one * from->slide;
    to->softer = most_softer(arm, to->give, edge_m);
}

fw_status fw_verdict_body_cut(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                              double edge_m, double flare_m, const char **why) {
    fw_mechanism_load_end *end;
    int nload;
    *why = NULL;
    if (!arm || !(edge_m < 0 || flare_m != 0)) return FW_OK;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &nload));
    for (int i = 0; i < 2 * m->nhinge + nload; i++) {
        const fw_mechanism_pin *pin = i < 2 * m->nhinge ? &m->pin[m->hinge[i / 2].pin] : NULL;
        const int body = !pin ? end[i - 2 * m->nhinge].body : i % 2 ? pin->body_b : pin->body_a;
        const double left = arm[i].narrow_m + 2 * edge_m - fabs(flare_m);
        char was[32], now[32], x[32], y[32];
        if (!arm[i].known || arm[i].nstrip == 0 || left > 0) continue;
        FW_NEED(*why = fw_arena_printf(
                    arena,
                    "%s%s, %s um wide at (%s, %s) um as drawn, may be cut through there (%s um are "
                    "left): make it wider",
                    FW_NAMED("body", fw_text_name(m->body[body].id)),
                    fw_number_text(was, sizeof was, 1e6 * arm[i].narrow_m, 3),
                    fw_number_text(x, sizeof x, 1e6 * arm[i].narrow.x, 4),
                    fw_number_text(y, sizeof y, 1e6 * arm[i].narrow.y, 4),
                    fw_number_text(now, sizeof now, 1e6 * left, 2)));
        return FW_OK;
    }
    return FW_OK;
}

static fw_status shared_made(fw_arena *arena, const fw_verdict_shared *shared, double edge_m,
                             const fw_verdict_shared **made) {
    fw_verdict_shared *to = fw_arena_one(arena, fw_verdict_shared);
    FW_NEED(to);
    *to = *shared, *made = to;
    const size_t n = (size_t)shared->n;
    FW_NEED(to->trunk = fw_arena_grow(arena, shared->trunk, n, n, sizeof *to->trunk));
    for (int k = 0; k < to->n; k++) {
        fw_verdict_arm gives = {.narrow_m = HUGE_VAL};
        strips_give(to->trunk[k].strip, to->trunk[k].nstrip, edge_m, to->about, &gives);
        memcpy(to->trunk[k].give, gives.give, sizeof gives.give);
    }
    return FW_OK;
}

/* of a body the most of what hinges put on it, and of all that acts on it */
static void softer_of_body(const fw_mechanism *m, int body, const fw_mechanism_load_end *end, int n,
                           fw_verdict_arm *arm) {
    const int hinges = 2 * m->nhinge;
    fw_geometry_vec2 pin, root;
    double most = 1;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < hinges; i++) {
            if (!fw_mechanism_hinge_end(m, body, i, &pin, &root)) continue;
            most = fmax(most, arm[i].softer);
            if (pass > 0) arm[i].softer = most;
        }
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < n; k++) {
            if (end[k].body != body) continue;
            most = fmax(most, arm[hinges + k].softer);
            if (pass > 0) arm[hinges + k].softer = most;
        }
}

void fw_verdict_softer(const fw_mechanism *m, const fw_verdict_arm *arm,
                       const fw_verdict_bending *b, int body, double to[2]) {
    to[0] = 1;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        if ((i % 2 ? pin->body_b : pin->body_a) == body) to[0] = fmax(to[0], arm[i].softer);
    }
    to[1] = to[0];
    for (int i = 0; i < b->nplace; i++)
        if (b->place[i].body == body && b->place[i].arm)
            to[1] = fmax(to[1], b->place[i].arm->softer);
}

fw_status fw_verdict_arms_made(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                               double edge_m, const fw_verdict_arm **made) {
    fw_mechanism_load_end *end;
    fw_verdict_arm *to;
    int nload;
    *made = arm;
    if (!arm || !(edge_m < 0)) return FW_OK;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &nload));
    const int n = 2 * m->nhinge + nload;
    FW_NEED(to = fw_arena_grow(arena, arm, (size_t)n, (size_t)n, sizeof *to));
    *made = to;
    for (int i = 0; i < n; i++) {
        int like = 0;
        while (like < i && arm[like].shared != arm[i].shared)
            like++;
        arm_made(&arm[i], edge_m, &to[i]);
        if (like < i)
            to[i].shared = to[like].shared;
        else if (arm[i].shared)
            FW_TRY(shared_made(arena, arm[i].shared, edge_m, &to[i].shared));
    }
    for (int b = 0; b < m->nbody; b++)
        softer_of_body(m, b, end, nload, to);
    return FW_OK;
}

/* ---- a body as beams with all that acts on it where it does ---- */

/* Solids of bars with corners, junctions and heads give up to that much more than strips of inscribed circles */
static const double strips_less = 0.05;

/* what acts at places of the body, about each, axes as drawn: all of one place together with the first of them */
static void put_at_places(const fw_verdict_places *p, const double *acts,
                          const fw_verdict_turn *turn) {
    for (int i = 0; i < p->n; i++, acts += 3) {
        double *w = p->end + 3 * p->at[i].end;
        if (p->at[i].body != p->body || !p->at[i].arm || !p->at[i].arm->known) continue;
        w[0] += acts[2];
        w[1] += turn->cosine * acts[0] + turn->sine * acts[1];
        w[2] += turn->cosine * acts[1] - turn->sine * acts[0];
    }
}

static bool is_first_there(const fw_verdict_places *p, int i) {
    for (int j = 0; j < i; j++)
        if (p->at[j].end == p->at[i].end) return false;
    return p->at[i].body == p->body && p->at[i].arm && p->at[i].arm->known;
}

double fw_verdict_beams_J(const fw_mechanism *m, const fw_verdict_arm *arm, double stiff_N,
                          const double *instant, const fw_verdict_turn *turn,
                          const fw_verdict_places *p, double *meet_J, double *aside_J) {
    const fw_verdict_shared *shared = NULL;
    double sum = 0, *end = p->end;
    memset(end, 0, 3 * (size_t)p->nend * sizeof *end);
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        double w[3];
        if ((i % 2 ? pin->body_b : pin->body_a) != p->body || !arm[i].known) continue;
        fw_verdict_end_put(instant + 3 * (i / 2), i % 2, turn, w);
        sum += fw_verdict_arm_J(&arm[i], stiff_N, w);
        shared = arm[i].shared;
        if (shared)
            fw_verdict_wrench_about(fw_mechanism_pin_place(m, pin, i % 2), shared->about, w,
                                    end + 3 * i);
    }
    *meet_J = shared ? fw_verdict_shared_J(shared, stiff_N, end, 2 * m->nhinge) : 0;
    *aside_J = 0;
    put_at_places(p, instant + 3 * m->nhinge + m->nbody, turn);
    for (int i = 0; i < p->n; i++) {
        double *w = end + 3 * p->at[i].end, own[3];
        if (!is_first_there(p, i)) continue;
        *aside_J += fw_verdict_arm_J(p->at[i].arm, stiff_N, w);
        memcpy(own, w, sizeof own);
        if (shared)
            fw_verdict_wrench_about(
                fw_mechanism_local_place(m, p->body, p->at[i].x_m, p->at[i].y_m), shared->about,
                own, w);
    }
    const double all = shared ? trunks_J(shared, stiff_N, end, p->nend) : sum + *aside_J;
    return (1 + strips_less) * all;
}

/* ---- how near electrodes come ----
   By the place of every rotor in each row: across the fingers and by its tilt, of a plate along; of fingers that are nearly
   at the roots of the others along, too. Error: between rows. Test: test_near_pull_in.py, Motions */

typedef struct near_to { /* m: least gap, and farthest along */
    double gap, along;
} near_to;

static near_to nearest(const fw_dynamics_motion *x, int element) {
    const fw_effects_force_element *e = &x->loads->element[element];
    const fw_effects_comb_element *c = fw_effects_comb_of(e);
    near_to n = {HUGE_VAL, -HUGE_VAL};
    fw_dynamics_motion_rows(x, 0, x->nsample);
    for (int row = 0; row < x->nsample; row++) {
        double p[6], w[6], at[3];
        fw_effects_element_place_ports(e, x->q + (size_t)row * 3 * (size_t)x->nbody, NULL, p, w);
        fw_effects_comb_place(e, p, at);
        const bool comb = c->kind == FW_ELECTRODES_COMB;
        const double half = 0.5 * (comb ? c->overlap_m + at[0] : c->length_m);
        n.gap = fmin(n.gap, c->gap_m - (comb ? fabs(at[1]) : at[0]) - fabs(at[2]) * half);
        n.along = fmax(n.along, at[0]);
    }
    return n;
}

double fw_verdict_electrodes_nearer(const fw_dynamics_motion *was, const fw_dynamics_motion *now,
                                    double *kept) {
    double nearer = 0;
    *kept = 1;
    for (int i = 0; i < was->loads->nelement && i < now->loads->nelement; i++) {
        const fw_effects_comb_element *c = fw_effects_comb_of(&was->loads->element[i]);
        if (!c || !fw_effects_comb_of(&now->loads->element[i])) continue;
        const near_to a = nearest(was, i), b = nearest(now, i);
        const double length = isnan(c->length_m) ? 2 * c->overlap_m : c->length_m;
        *kept = fmin(*kept, a.gap / c->gap_m);
        nearer = fmax(nearer, a.gap - b.gap);
        if (c->kind == FW_ELECTRODES_COMB && length - c->overlap_m - b.along < 2 * b.gap)
            nearer = fmax(nearer, b.along - a.along);
    }
    return nearer;
}

/* ---- and in series with electrodes ----
   Pull-in comes where the field takes the stiffness k that holds its rotor; where a place of the rotor's body gives c that is
   k/(1 + c k), and k is what the field takes there: the largest eigenvalue of -df/dp at the pull-in voltage and pose. Test:
   test_effects.py SlenderArms */

static double field_takes(const fw_effects_force_element *e, const fw_statics_pull_in *p,
                          double duration_s) {
    enum { TIMES = 64, ROTOR = 1 };
    double at[6], w[6], stiff[36], damp[36], most = 0;
    if (!e->class_->electrodes || e->ports != 2 || e->switches > 0) return 0;
    fw_effects_element_place_ports(e, p->q, NULL, at, w);
    for (int i = 0; i <= TIMES; i++) { /* wherever its law is largest */
        const double t_s = duration_s * i / TIMES;
        const fw_effects_port_state seen = {.t_s = t_s,
                                            .piece_s = t_s,
                                            .load = p->margin * p->margin,
                                            .p = at,
                                            .w = w,
                                            .still = true};
        e->class_->tangent(e, &seen, stiff, damp);
        const double *row = stiff + 3 * ROTOR * 6 + 3 * ROTOR;
        const double a = -row[0], b = -0.5 * (row[1] + row[6]), c = -row[7];
        most = fmax(most, 0.5 * (a + c) + hypot(0.5 * (a - c), b));
    }
    return most;
}

fw_status fw_verdict_places_pulled(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                   const fw_statics_pull_in *p, double *gives) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *motion = v->motion[scene];
    fw_mechanism_load_end *end;
    int n;
    *gives = 0;
    if (!v->arm || v->straight || !p->q || !motion || !motion->loads) return FW_OK;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    for (int k = 0; k < n; k++) {
        const fw_verdict_arm *arm = &v->arm[2 * m->nhinge + k];
        if (end[k].scene != scene || !end[k].id || !arm->known) continue;
        const double goes = fw_verdict_arm_goes(arm);
        for (int i = 0; i < motion->loads->nelement; i++)
            if (motion->loads->element[i].id &&
                strcmp(motion->loads->element[i].id, end[k].id) == 0)
                *gives +=
                    goes / (m->variant->material.youngs.value * m->variant->thickness_m) *
                    field_takes(&motion->loads->element[i], p, m->device->scene[scene].duration_s);
    }
    return FW_OK;
}
