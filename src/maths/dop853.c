/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/dop853.h"
#include "maths/dop853_table.h"
#include <float.h>
#include <math.h>
#include <string.h>

fw_status fw_dop853_new(fw_arena *arena, const fw_ode *ode, double rtol, const double *atol,
                        fw_dop853 **integrator) {
    fw_dop853 *s = fw_arena_one(arena, fw_dop853);
    FW_NEED(s);
    size_t n = (size_t)ode->n;
    s->ode = *ode;
    s->rtol = rtol;
    s->atol = atol;
    s->h_max = (double)INFINITY;
    FW_NEED(s->y_old = fw_arena_array(arena, double, n));
    FW_NEED(s->y = fw_arena_array(arena, double, n));
    FW_NEED(s->f = fw_arena_array(arena, double, n));
    FW_NEED(s->y_new = fw_arena_array(arena, double, n));
    FW_NEED(s->f_new = fw_arena_array(arena, double, n));
    FW_NEED(s->k = fw_arena_array(arena, double, DOP_ALL *n));
    FW_NEED(s->dense = fw_arena_array(arena, double, 8 * n));
    *integrator = s;
    return FW_OK;
}

static void evaluate(fw_dop853 *s, double t, const double *y, double *f) {
    s->ode.rhs(s->ode.context, t, y, f);
    s->rhs++;
}

/* out = y + h sum_j a_ij k_j for row i of the table */
static void combine(const fw_dop853 *s, int i, double h, const double *restrict y,
                    double *restrict out) {
    int n = s->ode.n, first = dop_row[i], count = dop_row[i + 1] - first;
    const double *k[DOP_STAGES];
    double a[DOP_STAGES];
    for (int j = 0; j < count; j++) {
        k[j] = s->k + (size_t)dop_a[first + j].stage * (size_t)n;
        a[j] = h * dop_a[first + j].a;
    }
    for (int c = 0; c < n; c++)
        out[c] = y[c] + a[0] * k[0][c];
    int j = 1;
    for (; j + 1 < count; j += 2)
        for (int c = 0; c < n; c++)
            out[c] += a[j] * k[j][c] + a[j + 1] * k[j + 1][c];
    if (j < count)
        for (int c = 0; c < n; c++)
            out[c] += a[j] * k[j][c];
}

/* err = |h| E5^2 / sqrt(n (E5^2 + 0.01 E3^2)) with E the sums of (e_i / scale_i)^2,
   scale_i = atol_i + rtol max(|y_i|, |y_new_i|): the step is accepted for err <= 1 */
static double error_norm(const fw_dop853 *s, double h) {
    const double *k = s->k;
    size_t n = (size_t)s->ode.n;
    double five = 0, three = 0;
    for (int c = 0; c < s->ode.controlled; c++) {
        double e5 = 0, e3 = 0;
        for (size_t j = 0; j < sizeof dop_e5 / sizeof dop_e5[0]; j++)
            e5 += dop_e5[j].a * k[(size_t)dop_e5[j].stage * n + (size_t)c];
        /* b has the same stages as e5 */
        const dop_entry *b = dop_a + dop_row[DOP_STAGES];
        for (int j = 0; j < 8; j++)
            e3 += b[j].a * k[(size_t)b[j].stage * n + (size_t)c];
        for (int j = 0; j < 3; j++)
            e3 -= dop_b3[j].a * k[(size_t)dop_b3[j].stage * n + (size_t)c];
        double scale = s->atol[c] + s->rtol * fmax(fabs(s->y[c]), fabs(s->y_new[c]));
        five += (e5 / scale) * (e5 / scale);
        three += (e3 / scale) * (e3 / scale);
    }
    double denominator = five + 0.01 * three;
    if (denominator == 0) return 0; /* a NaN falls through */
    return fabs(h) * five * sqrt(1 / (s->ode.controlled * denominator));
}

static double weighted_norm(const fw_dop853 *s, const double *y, const double *a, const double *b) {
    double sum = 0;
    for (int c = 0; c < s->ode.controlled; c++) {
        double x = (a[c] - (b ? b[c] : 0)) / (s->atol[c] + s->rtol * fabs(y[c]));
        sum += x * x;
    }
    return sqrt(sum / s->ode.controlled);
}

/* first step (Hairer, Norsett and Wanner I, II.4): an explicit Euler trial bounds y'' */
static double first_step(fw_dop853 *s) {
    double span = s->t_end - s->t;
    double size = weighted_norm(s, s->y, s->y, NULL), slope = weighted_norm(s, s->y, s->f, NULL);
    double h = size < 1e-5 || slope < 1e-5 ? 1e-6 * span : 0.01 * size / slope;
    h = fmin(h, fmin(span, s->h_max));
    for (int c = 0; c < s->ode.n; c++)
        s->y_new[c] = s->y[c] + h * s->f[c];
    evaluate(s, s->t + h, s->y_new, s->f_new);
    double second = weighted_norm(s, s->y, s->f_new, s->f) / h;
    double worst = fmax(slope, second);
    double other = worst <= 1e-15 ? fmax(1e-6 * span, h * 1e-3) : pow(0.01 / worst, 1.0 / 8);
    h = fmin(100 * h, other);
    return isfinite(h) && h > 0 ? fmin(h, fmin(span, s->h_max)) : 1e-6 * span;
}

void fw_dop853_start(fw_dop853 *s, double t, const double *y, double t_end) {
    size_t bytes = (size_t)s->ode.n * sizeof *y;
    memcpy(s->y, y, bytes);
    memcpy(s->y_old, y, bytes);
    s->t = s->t_old = t;
    s->t_end = t_end;
    s->steps = s->rejected = s->rhs = 0;
    s->err_old = 1e-4;
    s->rejected_last = s->dense_ready = false;
    evaluate(s, t, s->y, s->f);
    s->h = 0;
    s->h_next = first_step(s);
}

static bool finite_all(const double *y, int n) {
    double sum = 0;
    for (int c = 0; c < n; c++)
        sum += fabs(y[c]);
    return isfinite(sum);
}

/* new step = h / clamp(err^alpha err_old^-beta / 0.9, 1/6, 3), alpha = 1/8 - 0.2 beta, beta 0.04:
   the proportional-integral controller of Gustafsson with the constants of the cited book */
static double step_factor(const fw_dop853 *s, double err) {
    const double beta = 0.04, safety = 0.9;
    double factor = pow(err, 0.125 - 0.2 * beta) / pow(s->err_old, beta) / safety;
    return fmin(3, fmax(1.0 / 6, factor));
}

/* y(t + h) by the twelve stages, its error, the projection; order 8. Inputs y, f at t and h_next;
   outputs the same at t + h. Cost 12 evaluations (11 and the one after the projection).
   Source: Hairer, Norsett and Wanner I, II.5 and II.10. Test: test_dop853.c. */
fw_ode_result fw_dop853_step(fw_dop853 *s) {
    size_t n = (size_t)s->ode.n;
    double h = fmin(s->h_next, s->h_max);
    memcpy(s->k, s->f, n * sizeof(double));
    for (;;) {
        bool last = s->t + 1.01 * h >= s->t_end;
        if (last) h = s->t_end - s->t;
        if (!last && h <= 16 * DBL_EPSILON * fmax(fabs(s->t), DBL_MIN)) return FW_ODE_SMALL;
        for (int i = 1; i < DOP_STAGES; i++) {
            combine(s, i, h, s->y, s->y_new);
            evaluate(s, s->t + dop_c[i] * h, s->y_new, s->k + (size_t)i * n);
        }
        combine(s, DOP_STAGES, h, s->y, s->y_new);
        double err = error_norm(s, h), t_new = last ? s->t_end : s->t + h;
        bool good = err <= 1; /* false for a NaN */
        if (good && s->ode.project) {
            good = s->ode.project(s->ode.context, t_new, s->y_new, s->f_new);
            s->rhs++;
        } else if (good) {
            evaluate(s, t_new, s->y_new, s->f_new);
        }
        if (good && finite_all(s->f_new, s->ode.n) && finite_all(s->y_new, s->ode.n)) {
            double factor = step_factor(s, err);
            double *swap = s->y_old;
            s->y_old = s->y, s->y = s->y_new, s->y_new = swap;
            swap = s->f, s->f = s->f_new, s->f_new = swap;
            s->err_old = fmax(err, 1e-4);
            s->h_next = s->rejected_last ? fmin(h, h / factor) : h / factor;
            s->rejected_last = s->dense_ready = false;
            s->t_old = s->t;
            s->h = h;
            s->t = t_new;
            s->steps++;
            return FW_ODE_STEP;
        }
        if (h <= 1e-13 * fabs(s->t_end - s->t_old) && !isfinite(err)) return FW_ODE_NAN;
        h = good || !(err > 1) ? h / 4 : h / fmin(3, pow(err, 0.117) / 0.9);
        s->rejected_last = true;
        s->rejected++;
        if (!(h > 16 * DBL_EPSILON * fabs(s->t)) || !(h > 1e-15 * fabs(s->t_end)))
            return isfinite(err) ? FW_ODE_SMALL : FW_ODE_NAN;
    }
}

/* coefficients of the order-7 interpolant; the first four fit y and f at both ends, so that it
   stays continuous with projected end points */
void fw_dop853_dense_prepare(fw_dop853 *s) {
    if (s->dense_ready) return;
    size_t n = (size_t)s->ode.n;
    double h = s->h, *k = s->k, *r = s->dense;
    memcpy(k + 12 * n, s->f, n * sizeof(double));
    for (int i = 13; i < DOP_ALL; i++) {
        combine(s, i, h, s->y_old, s->y_new);
        evaluate(s, s->t_old + dop_c[i] * h, s->y_new, k + (size_t)i * n);
    }
    for (size_t c = 0; c < n; c++) {
        double difference = s->y[c] - s->y_old[c], bend = h * k[c] - difference;
        r[c] = s->y_old[c];
        r[n + c] = difference;
        r[2 * n + c] = bend;
        r[3 * n + c] = difference - h * s->f[c] - bend;
    }
    for (size_t m = 0; m < 4; m++)
        for (size_t c = 0; c < n; c++) {
            double sum = 0;
            for (int j = 0; j < DOP_DENSE; j++)
                sum += dop_d[m][j] * k[(size_t)dop_d_stage[j] * n + c];
            r[(4 + m) * n + c] = h * sum;
        }
    s->dense_ready = true;
}

void fw_dop853_dense(const fw_dop853 *s, double theta, double *y) {
    size_t n = (size_t)s->ode.n;
    double rest = 1 - theta;
    const double *r = s->dense;
    for (size_t c = 0; c < n; c++) {
        double high =
            r[4 * n + c] + theta * (r[5 * n + c] + rest * (r[6 * n + c] + theta * r[7 * n + c]));
        y[c] = r[c] +
               theta * (r[n + c] + rest * (r[2 * n + c] + theta * (r[3 * n + c] + rest * high)));
    }
}

void fw_dop853_dense_value(const double r[8], double theta, double *value, double *slope) {
    double p = r[7], d = 0;
    for (int i = 6; i >= 0; i--) {
        double x = i % 2 ? 1 - theta : theta, dx = i % 2 ? -1 : 1;
        d = dx * p + x * d;
        p = r[i] + x * p;
    }
    *value = p;
    *slope = d;
}
