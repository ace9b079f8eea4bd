/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The small system of friction: torques T for given flags (multibody_friction.c has the equations).
   Inputs, scaled: gains, accelerations without friction, what presses; output T. Valid while the
   spectral radius of K is below 1, else refused. Error: round-off times cond(A_stick); of T where
   it is not unique, 1e-9. Cost (entries)^3. Test: test_friction_model.c. */
#include "multibody/friction.h"
#include "maths/dense.h"
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
