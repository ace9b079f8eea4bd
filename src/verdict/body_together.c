/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What ways of one body (body_arms.c) bear together where they go together, and bear in the course of a scene. */
#include "geometry/segment.h"
#include "maths/matrix.h"
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

/* of each that there is (n): what it gives; arms that share their ways go on sharing them */
static fw_status all_made(fw_arena *arena, const fw_verdict_arm **from, int n, double edge_m,
                          fw_verdict_arm **to) {
    for (int i = 0; i < n; i++) {
        int like = 0;
        if (!from[i]) continue;
        arm_made(from[i], edge_m, to[i]);
        while (like < i && !(from[like] && from[like]->shared == from[i]->shared))
            like++;
        if (like < i)
            to[i]->shared = to[like]->shared;
        else if (from[i]->shared)
            FW_TRY(shared_made(arena, from[i]->shared, edge_m, &to[i]->shared));
    }
    return FW_OK;
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
    const int ends = 2 * m->nhinge;
    const fw_verdict_arm **from = fw_arena_array(arena, const fw_verdict_arm *, (size_t)(n + ends));
    fw_verdict_arm **all = fw_arena_array(arena, fw_verdict_arm *, (size_t)(n + ends));
    FW_NEED(from && all ? all : NULL);
    for (int i = 0; i < n; i++)
        from[i] = &arm[i], all[i] = &to[i];
    for (int i = 0; i < ends; i++) {
        if (!(from[n + i] = arm[i].base)) continue;
        FW_NEED(all[n + i] = fw_arena_grow(arena, arm[i].base, 1, 1, sizeof *to));
        to[i].base = all[n + i];
    }
    FW_TRY(all_made(arena, from, n + ends, edge_m, all));
    for (int b = 0; b < m->nbody; b++)
        softer_of_body(m, b, end, nload, to);
    return FW_OK;
}

/* ---- a body as beams with all that acts on it where it does ---- */

bool fw_verdict_element_forces(const fw_effects_force_element *from, const double *q, double *p,
                               double *f) {
    fw_effects_force_element e = *from;
    double still[3 * FW_VERDICT_PORTS] = {0};
    bool on[FW_VERDICT_PORTS];
    if (e.ports > FW_VERDICT_PORTS || e.switches > FW_VERDICT_PORTS || !e.class_->slope)
        return false;
    for (int i = 0; i < FW_VERDICT_PORTS; i++)
        on[i] = true;
    e.laws = 0, e.law[0] = NULL;
    fw_effects_element_place_ports(&e, q, NULL, p, still);
    const fw_effects_port_state state = {.load = 1, .p = p, .w = still, .on = on, .still = true};
    e.class_->slope(&e, &state, f);
    return true;
}

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

/* ---- what bodies bear in the course of a scene that is repeated ----
   A strip at r of an end of a hinge is strained by M + r x F over its width squared and by F along it over its width: sums of M, Fx
   and Fy, in the axes in which the body was drawn, with signs that are not kept. So with the largest factors m, x, y of all strips
   (fw_verdict_arm_add, fw_verdict_arm_rims)

     s(t) = m M(t) +- x Fx(t) +- y Fy(t)

   are four courses, of which cycles are counted as those at the faces of a hinge, with what rings on behind; where the largest
   stress that the static limit is held against is above all of them (fw_verdict_arm_bears) a course is taken to be so much
   more. Of what hinges put on a body together, and of what is stated at a place, the courses are those along four directions,
   and the moment. A sum of such is taken to fatigue by no more than the sum of what each uses: amplitudes are a norm of the
   damage as far as means are not (Smith, Watson, Topper). Of several scenes each is taken to be all of them, and to swing to
   the other side once a repetition, which in turn is the most. Out: the amplitude, fully reversed, that once a repetition
   fatigues as much. Error: signs of a strip's own sum, the factor of three of corners (decision 222). Cost: (8 nhinge + 5 nbody + 4 nplace)
   turning points an instant, where cycles are asked for. Test: test_body_arms.c, test_limits.py FatigueOfBodies */

/* turns by less than this share of a limit are none, as in strain_monitor.c */
static const double course_gate = 1e-3;

double fw_verdict_tires(const fw_mechanism *m, int hinge) {
    const fw_flexure_limits *l = &m->hinge[hinge].limits;
    const fw_flexure_limit *once = fw_flexure_limits_governing(l);
    if (!(m->device->limits.cycles > 0) || !l->life.known || l->fatigue == FW_NONE || !once)
        return 0;
    return once->allowable_Pa / l->item[l->fatigue].allowable_Pa;
}

/* turns of what is multiplied by `factor` that are none */
static double least_turn(const fw_mechanism *m, int hinge, const fw_verdict_arm *arm,
                         double factor) {
    const double corner = 3.3; /* the most that holes and corners count */
    return factor > 0 ? course_gate * fw_verdict_arm_allowed_N_per_m(m, hinge, arm) /
                            (corner * fmax(fw_verdict_tires(m, hinge), 1) * factor)
                      : HUGE_VAL;
}

static void find_gates(fw_verdict_bending *b, const fw_mechanism *m) {
    double *gate = b->courses->gate;
    const bool holes = b->rest_Nm != NULL;
    for (int i = 0; i < b->courses->n; i++)
        gate[i] = HUGE_VAL;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_verdict_arm *arm = &b->arm[i];
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const int body = i % 2 ? pin->body_b : pin->body_a;
        if (!arm->known || body == FW_GROUND) continue;
        double *force = &gate[fw_verdict_course_of_force(m, body)],
               *moment = &gate[fw_verdict_course_of_moment(m, body)];
        gate[i] = least_turn(m, i / 2, arm, 1);
        *force = fmin(*force, least_turn(m, i / 2, arm, holes ? arm->rim_rest_m : 0));
        *moment = fmin(*moment, least_turn(m, i / 2, arm, holes ? arm->rim_rest_m2 : 0));
    }
    for (int k = 0; k < b->nplace; k++) {
        const fw_verdict_arm *arm = b->place[k].arm;
        const double by = holes ? arm->rim_m + arm->rim_rest_m : arm->edge_m,
                     turns = holes ? arm->rim_rest_m2 : 0;
        double *force = &gate[fw_verdict_course_of_force(m, b->place[k].body)],
               *moment = &gate[fw_verdict_course_of_moment(m, b->place[k].body)];
        gate[fw_verdict_course_of_place(m, k)] = least_turn(m, 0, arm, by);
        *force = fmin(*force, least_turn(m, 0, arm, by));
        *moment = fmin(*moment, least_turn(m, 0, arm, turns));
    }
}

fw_status fw_verdict_courses_new(fw_arena *arena, const fw_mechanism *m, fw_verdict_bending *b) {
    if (m->nhinge == 0 || !(fw_verdict_tires(m, 0) > 0)) return FW_OK;
    const size_t n = 2 * (size_t)m->nhinge + 2 * (size_t)m->nbody + (size_t)b->nplace;
    FW_NEED(b->courses = fw_arena_one(arena, fw_verdict_courses));
    *b->courses = (fw_verdict_courses){.arena = arena, .n = (int)n};
    FW_NEED(b->courses->row = fw_arena_alloc(arena, n, sizeof *b->courses->row));
    FW_NEED(b->courses->gate = fw_arena_array(arena, double, n));
    FW_NEED(b->courses->lasts = fw_arena_array(arena, double, n));
    find_gates(b, m);
    fw_verdict_courses_record(b, m, NULL);
    return FW_OK;
}

static void add_courses(fw_verdict_courses *c, int row, const fw_dynamics_instant *now,
                        const double value[FW_FACES]) {
    for (int i = 0; isfinite(c->gate[row]) && i < FW_FACES; i++) {
        if (now->begins) fw_maths_turning_jump(&c->row[row][i]);
        fw_maths_turning_add(&c->row[row][i], c->arena, now->t_s, value[i]);
    }
}

static void add_directions(fw_verdict_courses *c, int row, const fw_dynamics_instant *now, double x,
                           double y) {
    const double to[FW_FACES] = {x, y, sqrt(0.5) * (x + y), sqrt(0.5) * (x - y)};
    add_courses(c, row, now, to);
}

void fw_verdict_courses_record(fw_verdict_bending *b, const fw_mechanism *m,
                               const fw_dynamics_instant *now) {
    fw_verdict_courses *c = b->courses;
    for (int i = 0; !now && i < c->n; i++)
        for (int k = 0; k < FW_FACES; k++)
            c->row[i][k] = (fw_maths_turning){.gate = c->gate[i]};
    if (!now) return;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_verdict_arm *arm = &b->arm[i];
        const int j = m->hinge[i / 2].pin, body = i % 2 ? m->pin[j].body_b : m->pin[j].body_a;
        if (!isfinite(c->gate[i])) continue;
        const bool holes = b->rest_Nm != NULL;
        const fw_verdict_turn *turn = &b->turn[body];
        const double *f = now->reaction_N + 2 * j,
                     bends = (holes ? arm->rim_m2 : arm->edge_m2) * m->pin[j].stiffness_Nm_per_rad *
                             now->angle_rad[j],
                     x = (holes ? arm->rim_x_m : arm->edge_x_m) *
                         (turn->cosine * f[0] + turn->sine * f[1]),
                     y = (holes ? arm->rim_y_m : arm->edge_y_m) *
                         (turn->cosine * f[1] - turn->sine * f[0]);
        const double to[FW_FACES] = {bends + x + y, bends + x - y, bends - x + y, bends - x - y};
        add_courses(c, i, now, to);
    }
    for (int i = 0; i < m->nbody; i++) {
        const double turns[FW_FACES] = {b->rest_Nm ? b->put[3 * i + 2] : 0};
        add_directions(c, fw_verdict_course_of_force(m, i), now, b->rest[2 * i],
                       b->rest[2 * i + 1]);
        add_courses(c, fw_verdict_course_of_moment(m, i), now, turns);
    }
    for (int k = 0; k < b->nplace; k++) {
        double acts[3];
        if (!isfinite(b->place[k].known_N)) continue;
        fw_verdict_place_acts(&b->place[k], now, acts, NULL);
        add_directions(c, fw_verdict_course_of_place(m, k), now, acts[0], acts[1]);
    }
}

/* ---- how far what has no force of its own holds bodies: drivers, heat, stress ---- */

int fw_verdict_laws_held(const fw_mechanism *m, const fw_device_scene *s,
                         fw_quantity_law_load *load) {
    int n = 0;
    double from, to;
    for (int i = 0; i < m->ndriver; i++)
        if (fw_quantity_law_goes(&m->driver[i].law, s->duration_s, &from, &to))
            load[n++] = (fw_quantity_law_load){&m->driver[i].law, 1, false, from, true};
    for (int i = 0; i < s->ntemperature; i++)
        if (s->temperature[i].change_K != 0)
            load[n++] = (fw_quantity_law_load){s->temperature[i].law, 1, false, 0, false};
    if (s->nstress > 0) load[n++] = (fw_quantity_law_load){.size = 1};
    return n;
}

fw_status fw_verdict_ways_held(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                               fw_verdict_held_ways *held) {
    const int size = 3 * m->nbody;
    double from, to, *way;
    bool known = true;
    int n = 0;
    *held = (fw_verdict_held_ways){0};
    FW_NEED(held->load = fw_arena_array(arena, fw_quantity_law_load,
                                        (size_t)(m->ndriver + s->ntemperature + 1)));
    FW_NEED(held->way = way = fw_arena_array(
                arena, double, (size_t)size *(size_t)(m->ndriver + s->ntemperature + 1)));
    for (int i = 0; i < m->ndriver; i++) {
        if (!fw_quantity_law_goes(&m->driver[i].law, s->duration_s, &from, &to)) continue;
        FW_TRY(fw_statics_driven_way(arena, m, i, s->duration_s, way + size * n++, &known));
        if (!known) held->unknown = "a driver";
    }
    for (int i = 0; i < s->ntemperature; i++) {
        if (s->temperature[i].change_K == 0) continue;
        FW_TRY(fw_statics_heated_way(arena, m, &s->temperature[i], way + size * n++, &known));
        if (!known) held->unknown = "heat";
    }
    if (s->nstress > 0) FW_TRY(fw_statics_stressed_way(arena, m, s, way + size * n, &known));
    if (!known && !held->unknown) held->unknown = "the stress of a layer";
    held->n = fw_verdict_laws_held(m, s, held->load);
    return FW_OK;
}
