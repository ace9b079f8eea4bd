/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every class of force elements must satisfy, on states that the caller makes: power balance,
   tangent against differences of order 6, and equilibrium of the forces on all ports. */
#ifndef FW_TESTS_ELEMENT_CHECK_H
#define FW_TESTS_ELEMENT_CHECK_H
#include "effects/effects.h"
#include "test.h"
#include <math.h>

enum { FW_CHECK_MOST = 3 * 12 };

/* derivative of order 6 by x of a function whose values at x + k h are value[k + 3] */
static inline double fw_check_slope(const double value[7], double h) {
    return (45 * (value[4] - value[2]) - 9 * (value[5] - value[1]) + (value[6] - value[0])) /
           (60 * h);
}

static inline void fw_check_tangent(const fw_effects_force_element *e,
                                    const fw_effects_port_state *s, double step_m, double step_rad,
                                    double relative) {
    int n = 3 * e->ports;
    double stiffness[FW_CHECK_MOST * FW_CHECK_MOST], damping[FW_CHECK_MOST * FW_CHECK_MOST];
    double x[2][FW_CHECK_MOST], f[FW_CHECK_MOST], value[FW_CHECK_MOST][7];
    e->class_->tangent(e, s, stiffness, damping);
    for (int which = 0; which < 2; which++) {
        const double *exact = which ? damping : stiffness;
        double largest[3][3] = {{0}}; /* by kind of row and column: units differ */
        for (int i = 0; i < n * n; i++) {
            double *l = &largest[i / n % 3 == 2][i % n % 3 == 2];
            *l = fmax(*l, fabs(exact[i]));
        }
        for (int j = 0; j < n; j++) {
            /* a velocity changes by the step in a thousandth of a second */
            double h = (j % 3 == 2 ? step_rad : step_m) * (which ? 1e3 : 1);
            for (int k = -3; k <= 3; k++) {
                memcpy(x[0], s->p, (size_t)n * sizeof(double));
                memcpy(x[1], s->w, (size_t)n * sizeof(double));
                x[which][j] += k * h;
                fw_effects_port_state moved = *s;
                moved.p = x[0], moved.w = x[1];
                e->class_->force(e, &moved, f);
                for (int i = 0; i < n; i++)
                    value[i][k + 3] = f[i];
            }
            for (int i = 0; i < n; i++) {
                double size = largest[i % 3 == 2][j % 3 == 2];
                double noise = 1e-15 * fabs(value[i][3]) / h;
                double off = fabs(-fw_check_slope(value[i], h) - exact[i * n + j]);
                if (off > relative * size + 100 * noise)
                    fail_msg("%s: %s (%d, %d) is %.15g, differences say %.15g", e->class_->effect,
                             which ? "damping" : "stiffness", i, j, exact[i * n + j],
                             -fw_check_slope(value[i], h));
            }
        }
    }
}

/* f . w = -dE/dt - power[0] + power[1], dE/dt by differences along the motion p + w t */
static inline void fw_check_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                                  double step_s, double relative) {
    int n = 3 * e->ports;
    double f[FW_CHECK_MOST], p[FW_CHECK_MOST], energy[7] = {0}, power[2] = {0}, given = 0, size = 0;
    e->class_->force(e, s, f);
    for (int i = 0; i < n; i++) {
        given += f[i] * s->w[i];
        size = fmax(size, fabs(f[i] * s->w[i]));
    }
    if (e->class_->power) e->class_->power(e, s, power);
    for (int k = -3; k <= 3 && e->class_->energy; k++) {
        fw_effects_port_state moved = *s;
        for (int i = 0; i < n; i++)
            p[i] = s->p[i] + k * step_s * s->w[i];
        moved.p = p;
        moved.t_s = s->t_s + k * step_s;
        energy[k + 3] = e->class_->energy(e, &moved);
    }
    double stored = fw_check_slope(energy, step_s);
    double noise = 1e-15 * fabs(energy[3]) / step_s;
    size = fmax(size, fmax(fabs(stored), fmax(fabs(power[0]), fabs(power[1]))));
    assert_true(power[0] >= 0);
    if (fabs(given + stored + power[0] - power[1]) > relative * size + 100 * noise)
        fail_msg("%s: f.w = %.15g, -dE/dt = %.15g, taken %.15g, fed in %.15g", e->class_->effect,
                 given, -stored, power[0], power[1]);
}

/* forces and moments about the origin add up to nothing */
static inline void fw_check_balance(const fw_effects_force_element *e,
                                    const fw_effects_port_state *s, double relative) {
    double f[FW_CHECK_MOST], sum[3] = {0}, force = 0, moment = 0;
    e->class_->force(e, s, f);
    for (int i = 0; i < e->ports; i++) {
        const double *p = s->p + 3 * i, *a = f + 3 * i;
        sum[0] += a[0], sum[1] += a[1], sum[2] += p[0] * a[1] - p[1] * a[0] + a[2];
        force = fmax(force, hypot(a[0], a[1]));
        moment = fmax(moment, hypot(p[0], p[1]) * hypot(a[0], a[1]) + fabs(a[2]));
    }
    assert_true(hypot(sum[0], sum[1]) <= relative * force);
    assert_true(fabs(sum[2]) <= relative * moment);
}

#endif
