/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The small system of friction: torques T for given flags (multibody_friction.c has the equations).
   Inputs, scaled: gains, accelerations without friction, what presses; output T. Valid while the
   spectral radius of K is below 1, else refused. Error: round-off times cond(A_stick); of T where
   it is not unique, 1e-9. Cost (entries)^3. Test: test_friction_model.c. */
#include "multibody/multibody_scratch.h"
#include "maths/matrix.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { SWEEPS = 50, ITERATIONS = 200, POWERS = 40 };
static const double fw_tight = 0.9999;      /* nearly jammed: forces grow as 1/(1 - radius) */
static const double fw_hold_epsilon = 1e-6; /* of `loose` */

bool fw_multibody_friction_hold(struct fw_multibody_frictions *s, int count, const int *which) {
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            double both = s->gain[which[i] * s->n + which[j]];
            both = 0.5 * (both + s->gain[which[j] * s->n + which[i]]);
            s->factor[i + j * count] = both + (i == j ? fw_hold_epsilon * s->loose[which[i]] : 0);
        }
    for (int i = 0; i < count; i++)
        if (!(s->factor[i + i * count] > 0)) return false;
    return count == 0 || fw_maths_cholesky(count, s->factor);
}

void fw_multibody_friction_holding(struct fw_multibody_frictions *s, int count, const int *which,
                                   const double *right, double *x) {
    double size = 0, before = (double)INFINITY;
    for (int i = 0; i < count; i++) {
        size = fmax(size, fabs(right[i]));
        s->more[i] = right[i], x[i] = 0;
    }
    for (int sweep = 0; sweep < SWEEPS && count > 0; sweep++) {
        double worst = 0;
        fw_maths_cholesky_solve(count, s->factor, s->more);
        for (int i = 0; i < count; i++)
            x[i] += s->more[i];
        for (int i = 0; i < count; i++) {
            s->more[i] = right[i];
            for (int j = 0; j < count; j++)
                s->more[i] -= s->gain[which[i] * s->n + which[j]] * x[j];
            worst = fmax(worst, fabs(s->more[i]));
        }
        if (!(worst > 4e-15 * size) || worst > 0.7 * before) return;
        before = worst;
    }
}

void fw_multibody_friction_force(const struct fw_multibody_frictions *s, int i, double force[2]) {
    const double *turn = s->turn + 2 * i * s->n;
    force[0] = s->base[2 * i], force[1] = s->base[2 * i + 1];
    for (int j = 0; j < s->n; j++)
        force[0] += turn[2 * j] * s->torque[j], force[1] += turn[2 * j + 1] * s->torque[j];
}

double fw_multibody_friction_press(const struct fw_multibody_frictions *s, int i) {
    double force[2];
    fw_multibody_friction_force(s, i, force);
    return s->push[i] + hypot(force[0], force[1]);
}

static double coefficient(const struct fw_multibody_frictions *s, int i) {
    return s->item[i].yields ? s->joint[i].rest : s->joint[i].slide;
}

/* eliminates what sticks: T_stuck = start - hold T_moving; reach (2 per pair): what presses a
   moving entry for unit T of another one while the stuck ones hold; more than `left` gains */
static void eliminate(struct fw_multibody_frictions *s, int stuck, int moving) {
    double *press = s->press;
    for (int e = 0; e < stuck; e++) {
        int i = s->stuck[e];
        s->right[e] = -(s->accel[i] + s->creep[i]);
    }
    fw_multibody_friction_holding(s, stuck, s->stuck, s->right, s->start);
    for (int c = 0; c < moving; c++) {
        for (int e = 0; e < stuck; e++)
            s->right[e] = s->gain[s->stuck[e] * s->n + s->moving[c]];
        fw_multibody_friction_holding(s, stuck, s->stuck, s->right, s->hold + c * stuck);
    }
    for (int r = 0; r < moving; r++) {
        int i = s->moving[r];
        const double *turn = s->turn + 2 * i * s->n;
        s->left[i] = s->gain[i * s->n + i];
        for (int e = 0; e < stuck; e++)
            s->left[i] -= s->gain[i * s->n + s->stuck[e]] * s->hold[r * stuck + e];
        for (int k = 0; k < 2; k++) {
            press[2 * r + k] = s->base[2 * i + k];
            for (int e = 0; e < stuck; e++)
                press[2 * r + k] += turn[2 * s->stuck[e] + k] * s->start[e];
            for (int c = 0; c < moving; c++) {
                double *to = &s->reach[2 * (r * moving + c) + k];
                *to = turn[2 * s->moving[c] + k];
                for (int e = 0; e < stuck; e++)
                    *to -= turn[2 * s->stuck[e] + k] * s->hold[c * stuck + e];
            }
        }
    }
}

/* is the spectral radius of K, K_rc = mu_r |reach_rc|, below 1? (K x)_r / x_r of any positive x has
   it below its largest; x by powers of K. *worst: the entry that matters most. Source: Collatz
   1942, Wielandt 1950. */
static bool contracts(struct fw_multibody_frictions *s, int moving, int *worst) {
    double *x = s->right, *kx = s->step;
    bool below = moving == 0;
    s->tight = -1;
    for (int r = 0; r < moving; r++)
        x[r] = 1;
    for (int k = 0; k < POWERS; k++) {
        double bound = 0, largest = 0;
        for (int r = 0; r < moving; r++) {
            double mu = coefficient(s, s->moving[r]);
            kx[r] = 0;
            for (int c = 0; c < moving; c++) {
                const double *reach = s->reach + 2 * (r * moving + c);
                kx[r] += mu * hypot(reach[0], reach[1]) * x[c];
            }
            if (!(kx[r] / x[r] <= bound)) bound = kx[r] / x[r], *worst = s->moving[r];
            largest = fmax(largest, kx[r]);
        }
        below = bound < 1;
        if (bound < fw_tight) return true;
        if (!(largest < (double)INFINITY)) return false;
        for (int r = 0; r < moving; r++)
            x[r] = kx[r] / largest + 1e-6;
    }
    s->tight = *worst;
    return below;
}

/* F_r = T_r + sign mu N_r(T) at x, and its largest; with `slopes` the Jacobian too (by columns) */
static double mismatch(struct fw_multibody_frictions *s, int moving, const double *x, double *f,
                       double *slopes) {
    double worst = 0;
    for (int r = 0; r < moving; r++) {
        double mu = s->item[s->moving[r]].slip * coefficient(s, s->moving[r]);
        double rho[2] = {s->press[2 * r], s->press[2 * r + 1]};
        const double *reach = s->reach + 2 * r * moving;
        for (int c = 0; c < moving; c++)
            rho[0] += reach[2 * c] * x[c], rho[1] += reach[2 * c + 1] * x[c];
        double n = hypot(rho[0], rho[1]), over = n > 0 ? 1 / n : 0;
        f[r] = x[r] + mu * (s->push[s->moving[r]] + n);
        worst = fmax(worst, fabs(f[r]));
        if (isnan(f[r])) return (double)INFINITY;
        for (int c = 0; c < moving && slopes; c++)
            slopes[r + c * moving] =
                (r == c) + mu * over * (rho[0] * reach[2 * c] + rho[1] * reach[2 * c + 1]);
    }
    return worst;
}

/* the fixed point of the contraction by Newton's method; where a step does not bring F down to 0.9,
   a plain iteration x - F, which does by the spectral radius of K in some norm */
static bool fixed_point(struct fw_multibody_frictions *s, int moving, double *x) {
    double *f = s->right, *step = s->step, *trial = s->value;
    memset(x, 0, (size_t)moving * sizeof *x);
    for (int k = 0; k < ITERATIONS; k++) {
        double size = 0, now = mismatch(s, moving, x, f, s->jacobian);
        if (!(now < (double)INFINITY)) return false;
        for (int r = 0; r < moving; r++)
            size = fmax(size, fabs(x[r]));
        if (now <= 4 * DBL_EPSILON * size) return true;
        memcpy(step, f, (size_t)moving * sizeof *f);
        memcpy(s->more, f, (size_t)moving * sizeof *f);
        bool newton = fw_maths_lapack_lu(moving, s->jacobian, s->pivot) &&
                      fw_maths_lapack_lu_solve(false, moving, 1, s->jacobian, s->pivot, step);
        for (int r = 0; r < moving; r++)
            trial[r] = x[r] - step[r];
        double next = newton ? mismatch(s, moving, trial, f, NULL) : (double)INFINITY;
        if (!(next < 0.9 * now)) {
            if (now <= 1e-13 * size) return true; /* round-off */
            for (int r = 0; r < moving; r++)
                trial[r] = x[r] - s->more[r];
        }
        memcpy(x, trial, (size_t)moving * sizeof *x);
    }
    return false;
}

bool fw_multibody_friction_solve(struct fw_multibody_frictions *s) {
    int stuck = 0, moving = 0, worst = 0;
    for (int i = 0; i < s->n; i++)
        if (s->item[i].slip)
            s->moving[moving++] = i;
        else
            s->stuck[stuck++] = i;
    s->jam = -1;
    for (int i = 0; i < s->n; i++) /* a state that is no number is no jam */
        if (!isfinite(s->accel[i]) || !isfinite(s->base[2 * i] + s->base[2 * i + 1])) return false;
    s->jam = moving ? s->moving[0] : s->stuck[0];
    if (!fw_multibody_friction_hold(s, stuck, s->stuck)) return false;
    eliminate(s, stuck, moving);
    if (!contracts(s, moving, &worst)) {
        s->jam = worst;
        return false;
    }
    double *x = s->value + s->n; /* of twice the length */
    if (!fixed_point(s, moving, x)) return false;
    for (int e = 0; e < stuck; e++) {
        double torque = s->start[e];
        for (int c = 0; c < moving; c++)
            torque -= s->hold[c * stuck + e] * x[c];
        s->torque[s->stuck[e]] = torque;
    }
    for (int r = 0; r < moving; r++)
        s->torque[s->moving[r]] = x[r];
    for (int i = 0; i < s->n; i++)
        s->item[i].torque = s->torque[i], s->item[i].press = fw_multibody_friction_press(s, i);
    s->jam = -1;
    return true;
}

/* ---- which joints at rest hold ---- */

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
