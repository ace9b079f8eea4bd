/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which joints at rest hold and which let go, for given pressing forces. The torques T of those at
   rest solve

     min 1/2 T'A T + c'T   with |T_i| <= L_i

   A gains (symmetric, semidefinite), c relative accelerations at T = 0 with those that move
   already: a_i = c_i + (A T)_i vanishes inside, and at a limit it goes against T. The accelerations
   are unique; T, where A is singular, is the one of least norm up to the limits: a proximal
   iteration, min ... + eps/2 |T - T_before|^2 from 0, each by principal pivoting: all entries that
   contradict change sides while that makes them fewer, then only the last one, which ends for every
   positive definite matrix. L is mu_s N first; one that moves at it gets mu_k N, and never back:
   what holds within mu_k N holds within mu_s N, too, so that this ends after at most n rounds with
   an answer, whatever the coefficients.

   Inputs scaled: gains, accelerations, limits. Output: flags and T, to 1e-12 of the limits. Cost
   (entries at rest)^3 per pivoting, a few of them. Source: Judice and Pires, Computers and
   Operations Research 21 (1994) 587-596; Murty, Opsearch 10 (1973). Test: test_friction_model.c. */
#include "multibody/friction.h"
#include "maths/dense.h"
#include <float.h>
#include <math.h>

enum { PROXIMAL = 8, PATIENCE = 5 };
static const double fw_proximal = 1e-6; /* of `loose`, as fw_multibody_friction_hold has it */
static const double fw_noise = 1e-12, fw_still = 1e-9, fw_floor = 1e-15;

/* (A T)_i + c_i over all that rest; *size: what it adds up from */
static double acceleration(const struct fw_multibody_frictions *s, int i, int rests, double *size) {
    double a = s->shift[i];
    *size = s->size[i] + fabs(a);
    for (int k = 0; k < rests; k++) {
        double part = s->gain[i * s->n + s->inside[k]] * s->torque[s->inside[k]];
        a += part, *size += fabs(part);
    }
    return a;
}

/* T of those inside their limits while the others stand at theirs */
static bool stand(struct fw_multibody_frictions *s, int rests) {
    int free = 0;
    for (int k = 0; k < rests; k++) {
        int i = s->inside[k];
        if (s->side[i])
            s->torque[i] = s->side[i] * s->most[i];
        else
            s->free[free++] = i;
    }
    if (!fw_multibody_friction_hold(s, free, s->free)) return false;
    for (int e = 0; e < free; e++) {
        int i = s->free[e];
        s->right[e] = fw_proximal * s->loose[i] * s->centre[i] - s->shift[i];
        for (int k = 0; k < rests; k++) {
            int j = s->inside[k];
            if (s->side[j]) s->right[e] -= s->gain[i * s->n + j] * s->torque[j];
        }
    }
    if (free) fw_maths_cholesky_solve(free, s->factor, s->right);
    for (int e = 0; e < free; e++)
        s->torque[s->free[e]] = s->right[e];
    return true;
}

/* where entry i should stand instead of where it does; the same: it is right */
static int better(const struct fw_multibody_frictions *s, int i, int rests) {
    if (!s->side[i]) {
        bool over = fabs(s->torque[i]) > s->most[i] * (1 + fw_noise) + fw_floor;
        return over ? s->torque[i] > 0 ? 1 : -1 : 0;
    }
    double size, a = acceleration(s, i, rests, &size);
    a += fw_proximal * s->loose[i] * (s->torque[i] - s->centre[i]);
    return s->side[i] * a > fw_noise * size ? 0 : s->side[i];
}

/* the strictly convex problem about `centre`, from the sides at hand */
static bool pivot(struct fw_multibody_frictions *s, int rests) {
    int fewest = rests + 1, patience = PATIENCE;
    for (int round = 0; round < 100 + 20 * rests; round++) {
        int wrong = 0, last = 0;
        if (!stand(s, rests)) return false;
        for (int k = 0; k < rests; k++) {
            int to = better(s, s->inside[k], rests);
            s->free[k] = to;
            if (to != s->side[s->inside[k]]) wrong++, last = k;
        }
        if (wrong == 0) return true;
        bool all = wrong < fewest || patience-- > 0;
        if (wrong < fewest) fewest = wrong, patience = PATIENCE;
        for (int k = all ? 0 : last; k <= last; k++)
            s->side[s->inside[k]] = s->free[k];
    }
    return false;
}

static bool nearest(struct fw_multibody_frictions *s, int rests) {
    for (int k = 0; k < rests; k++)
        s->centre[s->inside[k]] = 0;
    for (int pass = 0; pass < PROXIMAL; pass++) {
        double moved = 0, size = 0;
        if (!pivot(s, rests)) return false;
        for (int k = 0; k < rests; k++) {
            int i = s->inside[k];
            moved = fmax(moved, fabs(s->torque[i] - s->centre[i]));
            size = fmax(size, fabs(s->torque[i]));
            s->centre[i] = s->torque[i];
        }
        if (moved <= fw_noise * size) break;
    }
    return true;
}

/* flags of what was found; whether one moves that had the static limit: it gets the kinetic one */
static bool take_flags(struct fw_multibody_frictions *s, int rests) {
    bool again = false;
    for (int k = 0; k < rests; k++) {
        int i = s->inside[k];
        fw_multibody_friction_state *f = &s->item[i];
        double size, a = acceleration(s, i, rests, &size);
        f->slip = -s->side[i];
        f->yields = f->slip && fabs(a) <= fw_still * size;
        if (!f->slip || f->yields || s->slid[i]) continue;
        s->slid[i] = again = true;
        s->most[i] = s->joint[i].slide * f->press;
    }
    return again;
}

bool fw_multibody_friction_box(struct fw_multibody_frictions *s) {
    int rests = 0;
    for (int i = 0; i < s->n; i++)
        if (s->rests[i]) s->inside[rests++] = i;
    for (int k = 0; k < rests; k++) {
        int i = s->inside[k];
        s->slid[i] = false, s->side[i] = 0;
        s->most[i] = s->joint[i].rest * s->item[i].press;
        s->shift[i] = s->accel[i] + s->creep[i];
        for (int j = 0; j < s->n; j++)
            if (!s->rests[j]) s->shift[i] += s->gain[i * s->n + j] * s->torque[j];
    }
    for (int round = 0; round <= rests; round++) {
        if (!nearest(s, rests)) return false;
        if (!take_flags(s, rests)) return true;
    }
    return true;
}
