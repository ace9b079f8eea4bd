/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cables that rub on the eyelets that they bend around. No motion has that: what it may come to, sticking or slipping
   either way, is in every band, and statics says within what range friction may hold (statics_friction.c).

     T_before/T_behind = e^(+-mu beta) at most, at an eyelet that bends the cable by beta

   Source: L. Euler 1762, the cable around a post. Theory: docs/theory/effects/eyelet-friction.md.
   Test: tests/cli/test_effects.py */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "quantity/quantity_law.h"
#include <math.h>
#include <string.h>

double fw_effects_eyelet_friction_of(const fw_device_scene *s) {
    for (int i = 0; i < s->npart; i++)
        if (strcmp(s->part[i].element, "eyelet-friction") == 0)
            return fw_device_scene_part_number(&s->part[i], "coefficient");
    return 0;
}

/* rad, between 0 and pi */
static double bend_of(const double *p, int eyelet) {
    const double *a = p + 3 * (eyelet - 1), *b = p + 3 * eyelet, *c = p + 3 * (eyelet + 1);
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
    return fabs(atan2(ux * vy - uy * vx, ux * vx + uy * vy));
}

/* Kept by the actuator: of a segment all bends between it and the actuator count. Else the mean stays, which lies between
   the least and the largest, and all bends count for all. */
static void shares_of(const double *bend, int segments, double coefficient, bool kept,
                      double *share) {
    double sum = 0;
    for (int i = segments - 1; i >= 0; i--) {
        const double here = i > 0 ? bend[i] : 0;
        share[i] = expm1(coefficient * sum);
        sum += here;
    }
    for (int i = 0; i < segments && !kept; i++)
        share[i] = expm1(coefficient * sum);
}

void fw_effects_eyelet_friction_shares(const double *p, int ports, double coefficient, bool kept,
                                       double *share) {
    for (int i = 1; i + 1 < ports; i++)
        share[i] = bend_of(p, i); /* each is taken before it is overwritten */
    shares_of(share, ports - 1, coefficient, kept, share);
}

static bool bends(const fw_device_scene *s) {
    for (int i = 0; i < s->ntendon; i++)
        if (s->tendon[i].neyelet > 2) return true;
    return false;
}

static bool called_for(const fw_effect_case *c) {
    return fw_effects_eyelet_friction_of(c->scene) > 0 && bends(c->scene);
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->scene->ntendon; i++)
        n += c->scene->tendon[i].neyelet - 2;
    return n;
}

typedef struct rubbing {
    const fw_effect_case *c;
    double *mode;             /* (modes) of what friction changes of the forces */
    double *sways;            /* (modes) how far that moves each at most */
    double turned_rad;        /* what turns most of the segments by that */
    double *force;            /* (3 nbody) likewise, sizes */
    double *bend, *share, *p; /* of one tendon's eyelets */
} rubbing;

/* how far friction may move an eyelet further */
static double sways_by(const rubbing *r, const fw_device_eyelet *eyelet) {
    double sum = 0;
    for (int l = 0; l < r->c->envelope->modes; l++) {
        const fw_geometry_vec2 by = fw_effects_envelope_moves(r->c, eyelet, l);
        sum += r->sways[l] * hypot(by.x, by.y);
    }
    return sum;
}

/* bends as drawn, and by how much segments may turn until then, without friction and by it: each by what its ends go over
   its length */
static void bends_of(rubbing *r, const fw_device_tendon *t, bool moved) {
    const fw_effect_case *c = r->c;
    for (int i = 0; i < t->neyelet; i++) {
        const fw_device_eyelet *e = &t->eyelet[i];
        const fw_geometry_vec2 at = fw_mechanism_local_place(c->mechanism, e->body, e->x_m, e->y_m);
        r->p[3 * i] = at.x, r->p[3 * i + 1] = at.y;
    }
    for (int i = 1; i + 1 < t->neyelet; i++) {
        double turn = 0;
        for (int k = i - 1; k <= i && moved; k++) {
            const double *a = r->p + 3 * k, *b = a + 3, length = hypot(b[0] - a[0], b[1] - a[1]);
            const double by =
                (sways_by(r, &t->eyelet[k]) + sways_by(r, &t->eyelet[k + 1])) / length;
            turn += by + (fw_effects_envelope_goes(c, &t->eyelet[k]) +
                          fw_effects_envelope_goes(c, &t->eyelet[k + 1])) /
                             length;
            r->turned_rad = fmax(r->turned_rad, by);
        }
        r->bend[i] = fmin(FW_TURN / 2, bend_of(r->p, i) + turn);
    }
}

/* what one cable's segments may pull further */
static void pulls(rubbing *r, const fw_device_tendon *t, double coefficient) {
    const fw_effect_case *c = r->c;
    const fw_effects_envelope *e = c->envelope;
    const double tension = fw_effects_envelope_tension(c, t);
    bends_of(r, t, true);
    shares_of(r->bend, t->neyelet - 1, coefficient, !isnan(t->pull_N), r->share);
    for (int i = 0; i + 1 < t->neyelet; i++) {
        const double *a = r->p + 3 * i, *b = a + 3, length = hypot(b[0] - a[0], b[1] - a[1]),
                     further = r->share[i] * tension;
        const fw_geometry_vec2 u = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
        if (further == 0) continue;
        for (int l = 0; l < e->modes; l++) {
            const fw_geometry_vec2 from = fw_effects_envelope_moves(c, &t->eyelet[i], l),
                                   to = fw_effects_envelope_moves(c, &t->eyelet[i + 1], l);
            r->mode[l] += e->margin * further * fabs(u.x * (to.x - from.x) + u.y * (to.y - from.y));
        }
        for (int k = i; k <= i + 1; k++) {
            const int body = t->eyelet[k].body;
            if (body == FW_GROUND) continue;
            r->force[3 * body] += fabs(u.x) * further;
            r->force[3 * body + 1] += fabs(u.y) * further;
        }
    }
}

static int most_eyelets(const fw_device_scene *s) {
    int most = 0;
    for (int i = 0; i < s->ntendon; i++)
        most = s->tendon[i].neyelet > most ? s->tendon[i].neyelet : most;
    return most;
}

/* room for any cable of the scene, and the largest share of a tension as drawn; without an envelope, too */
static fw_status largest(rubbing *r, double *share) {
    const fw_effect_case *c = r->c;
    const size_t n = (size_t)most_eyelets(c->scene);
    const double coefficient = fw_effects_eyelet_friction_of(c->scene);
    FW_NEED(r->bend = fw_arena_array(c->arena, double, n));
    FW_NEED(r->share = fw_arena_array(c->arena, double, n));
    FW_NEED(r->p = fw_arena_array(c->arena, double, 3 * n));
    *share = 0;
    for (int i = 0; i < c->scene->ntendon; i++) {
        const fw_device_tendon *t = &c->scene->tendon[i];
        bends_of(r, t, false);
        shares_of(r->bend, t->neyelet - 1, coefficient, !isnan(t->pull_N), r->share);
        *share = fmax(*share, r->share[0]);
    }
    return FW_OK;
}

/* one round: what friction changes of the forces with bends as the last round has them; rad that it turns a hinge by */
static double round_of(rubbing *r, double coefficient, double *share) {
    const fw_effect_case *c = r->c;
    const fw_effects_envelope *e = c->envelope;
    memset(r->mode, 0, (size_t)e->modes * sizeof *r->mode);
    memset(r->force, 0, (size_t)e->n * sizeof *r->force);
    r->turned_rad = 0;
    for (int i = 0; i < c->scene->ntendon; i++) {
        pulls(r, &c->scene->tendon[i], coefficient);
        *share = fmax(*share, r->share[0]);
    }
    for (int l = 0; l < e->modes; l++)
        r->sways[l] = r->mode[l] * e->response_bound[l];
    return fw_effects_envelope_mode_answer(c, r->mode, (double)INFINITY) * e->floor / e->margin;
}

/* Slipping follows the motion, and so does what it takes: of any course. Friction moves the device as a load does, so that
   the margin is that of a motion which has both: its nonlinearity is that of the envelope, of whose loads the tension is at
   most all, and how far friction turns hinges and segments. rad: INFINITY, nothing bounds it */
static fw_status alone(const fw_effect_case *c, double *rad, double *share) {
    enum { ROUNDS = 50 };
    static const double settled = 1e-3, not_linear_most = 0.8;
    const fw_effects_envelope *e = c->envelope;
    const double coefficient = fw_effects_eyelet_friction_of(c->scene);
    rubbing r = {.c = c};
    *rad = (double)INFINITY;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_TRY(largest(&r, share));
    if (e && e->valid && !(e->loose_pull > 0)) {
        double rings = 1, turns = 0, before = -1;
        FW_NEED(r.mode = fw_arena_array(c->arena, double, (size_t)e->modes));
        FW_NEED(r.sways = fw_arena_array(c->arena, double, (size_t)e->modes));
        FW_NEED(r.force = fw_arena_array(c->arena, double, (size_t)e->n));
        for (int i = 0; i < ROUNDS && turns > (1 + settled) * before; i++)
            before = turns, turns = round_of(&r, coefficient, share);
        for (int l = 0; l < e->modes; l++)
            rings = fmax(rings, e->omega[l] * e->omega[l] * e->response_bound[l]);
        const double not_linear = 0.25 * (e->margin - 1) * (1 + *share) + fmax(turns, r.turned_rad);
        if (turns <= (1 + settled) * before && not_linear <= not_linear_most)
            *rad = (1 + 4 * not_linear) *
                   (turns +
                    fw_effects_envelope_displaced(c, r.force, rings - 1) * e->floor / e->margin);
    }
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

/* ---- what a cable is stiff by ----
   While it slides a drawn cable of stiffness k is stretched as a whole, by the sum of what its segments are, g_i along their
   gradients; while it sticks on its eyelets each is by itself, with what a piece of its length has:

     k g g^T, g = sum g_i          sum k (L/l_i) g_i g_i^T, L = sum l_i           difference >= 0 (Cauchy)

   Some that stick and some that slide lie between. While it slips one way its tensions keep (1) of the theory, so that what one
   segment alone is pulled by is k e^(-mu B) at least, B all bends. A pulled cable states no stiffness: where it sticks no segment but
   the last one, which the actuator holds, changes its length. In: a pose, SI. Range: small motions. An eyelet that holds less
   than a ten-thousandth of the tension is none. Cost: a few operations a segment and body. Test: tests/cli/test_friction_range.py,
   test_a_stiffness_with_a_cable_that_rubs */
fw_status fw_effects_eyelet_friction_segments(fw_arena *arena, const fw_device_scene *s, int tendon,
                                              const fw_effects_force_element *e, const double *q,
                                              int nbody, fw_effects_segments *to) {
    const double hardly = 1e-4, coefficient = fw_effects_eyelet_friction_of(s);
    const fw_device_tendon *t = &s->tendon[tendon];
    const size_t ports = (size_t)e->ports, width = 3 * (size_t)nbody;
    double *p, whole = 0;
    *to = (fw_effects_segments){0};
    if (!(coefficient > 0) || ports < 3) return FW_OK;
    FW_NEED(p = fw_arena_array(arena, double, 7 * ports));
    double *f = p + 3 * ports, *share = f + 3 * ports;
    FW_NEED(to->row = fw_arena_array(arena, double, ports *width));
    FW_NEED(to->alone_N_per_m = fw_arena_array(arena, double, ports));
    fw_effects_element_place_ports(e, q, NULL, p, f);
    for (int i = 0; i + 1 < e->ports; i++) {
        const double *a = p + 3 * i, x = a[3] - a[0], y = a[4] - a[1], far = hypot(x, y);
        if (i == 0 || coefficient * bend_of(p, i) > hardly) to->n++;
        to->alone_N_per_m[to->n - 1] += far, whole += far; /* lengths first */
        memset(f, 0, 3 * ports * sizeof *f);
        if (!(far > 0)) continue;
        f[3 * i + 3] = x / far, f[3 * i + 4] = y / far, f[3 * i] = -x / far,
                  f[3 * i + 1] = -y / far;
        fw_effects_element_add_forces(e, q, f, to->row + (size_t)(to->n - 1) * width);
    }
    const bool drawn = isnan(t->pull_N);
    for (int i = 0; i < to->n; i++)
        to->alone_N_per_m[i] = drawn           ? t->stiffness_N_per_m * whole / to->alone_N_per_m[i]
                               : i + 1 < to->n ? (double)INFINITY
                                               : 0;
    fw_effects_eyelet_friction_shares(p, e->ports, coefficient, !drawn, share);
    to->whole_N_per_m = drawn ? t->stiffness_N_per_m : 0;
    to->less = 1 - 1 / (1 + share[0]);
    if (to->n == 1) *to = (fw_effects_segments){0};
    return FW_OK;
}

static fw_status beside(const fw_effect_case *c, double *share) {
    fw_mark mark = fw_arena_mark(c->arena);
    const fw_status status = largest(&(rubbing){.c = c}, share);
    fw_arena_rewind(c->arena, mark);
    return status;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    double rad, share, moved;
    char part[32];
    FW_TRY(alone(c, &rad, &moved));
    FW_TRY(beside(c, &share));
    *value = isfinite(rad) ? rad / c->envelope->floor : (double)INFINITY;
    FW_NEED(*reason = fw_arena_printf(
                c->arena,
                "where cables bend over eyelets friction may change their tension by up to %s %%%s",
                fw_number_text(part, sizeof part, 100 * share, 3),
                isfinite(*value) ? "" : "; nothing bounds what that does to the motion"));
    return FW_OK;
}

const fw_effect_row fw_effect_eyelet_friction = {
    .id = "eyelet-friction",
    .summary = "cables that rub on the eyelets they bend around; in every band, in no motion",
    .called_for = called_for,
    .bound = bound,
    .add = fw_effects_add_nothing,
    .count = count,
    .beside = beside,
    .alone = alone};
