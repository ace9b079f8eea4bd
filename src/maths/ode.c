/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What integrators share: memory, norms, first steps, acceptance, dense output. */
#include "maths/ode.h"
#include <float.h>
#include <math.h>

int fw_maths_ode_padded(int n) {
    return (n + 7) / 8 * 8;
}

double *fw_maths_ode_vector(fw_arena *arena, int n) {
    return fw_arena_array(arena, double, (size_t)fw_maths_ode_padded(n));
}

double fw_maths_ode_norm(const fw_maths_stepper *s, const double *e, const double *y,
                         const double *z) {
    double sum = 0;
    for (int c = 0; c < s->ode.controlled; c++) {
        double x = e[c] / (s->tolerance[c] + s->rtol * fmax(fabs(y[c]), fabs(z[c])));
        sum += x * x;
    }
    return s->ode.controlled ? sqrt(sum / s->ode.controlled) : 0;
}

void fw_maths_ode_evaluate(fw_maths_stepper *s, double t, const double *y, double *f) {
    s->ode.rhs(s->ode.context, t, y, f);
    s->rhs++;
}

void fw_maths_ode_evaluate_lean(fw_maths_stepper *s, double t, const double *y, double *f) {
    (s->ode.lean ? s->ode.lean : s->ode.rhs)(s->ode.context, t, y, f);
    s->rhs++;
}

bool fw_maths_ode_finite(const double *y, int n) {
    double sum[4] = {0};
    int c = 0;
    for (; c + 4 <= n; c += 4)
        for (int lane = 0; lane < 4; lane++)
            sum[lane] += 0 * y[c + lane];
    for (; c < n; c++)
        sum[0] += 0 * y[c];
    return sum[0] + sum[1] + (sum[2] + sum[3]) == 0;
}

/* h such that an explicit Euler step keeps within 0.01 of |y|, and 0.01 of the error that y'' makes
   in a step of this order, whichever is less; never so short that t would stay. Inputs y, f at t;
   work 2 padded. Cost one evaluation. Source: Hairer, Norsett and Wanner I, II.4. Test:
   test_ode_step.c */
double fw_maths_ode_first_step(fw_maths_stepper *s, int order, double *work) {
    double span = s->t_end - s->t, *y = work, *f = work + s->padded;
    double size = fw_maths_ode_norm(s, s->y, s->y, s->y),
           slope = fw_maths_ode_norm(s, s->f, s->y, s->y);
    double h = size < 1e-5 || slope < 1e-5 ? 1e-6 * span : 0.01 * size / slope;
    h = fmin(h, fmin(span, s->h_max));
    for (int c = 0; c < s->ode.n; c++)
        y[c] = s->y[c] + h * s->f[c];
    fw_maths_ode_evaluate(s, s->t + h, y, f);
    for (int c = 0; c < s->ode.n; c++)
        f[c] -= s->f[c];
    double worst = fmax(slope, fw_maths_ode_norm(s, f, s->y, s->y) / h);
    double other = worst <= 1e-15 ? fmax(1e-6 * span, h * 1e-3) : pow(0.01 / worst, 1.0 / order);
    h = fmin(100 * h, other);
    h = isfinite(h) && h > 0 ? fmin(h, fmin(span, s->h_max)) : 1e-6 * span;
    return fmin(span, fmax(h, 64 * DBL_EPSILON * fabs(s->t)));
}

double fw_maths_ode_target(const fw_maths_stepper *s, double *h) {
    bool last = s->t + 1.01 * *h >= s->t_end;
    double end = last ? s->t_end : s->t + *h;
    *h = end - s->t;
    return end;
}

bool fw_maths_ode_finish(fw_maths_stepper *s, double t_new, double *y_new, double *f_new) {
    bool good = true;
    if (s->ode.project) {
        good = s->ode.project(s->ode.context, t_new, y_new, f_new);
        s->rhs++;
    } else {
        fw_maths_ode_evaluate(s, t_new, y_new, f_new);
    }
    return good && fw_maths_ode_finite(f_new, s->ode.n) && fw_maths_ode_finite(y_new, s->ode.n);
}

void fw_maths_ode_accept(fw_maths_stepper *s, double t_new, double **y_new, double **f_new) {
    double *free_y = s->y_old, *free_f = s->f_old;
    s->y_old = s->y, s->y = *y_new, *y_new = free_y;
    s->f_old = s->f, s->f = *f_new, *f_new = free_f;
    s->t_old = s->t;
    s->t = t_new;
    s->h = t_new - s->t_old;
    s->dense_ready = false;
    s->steps++;
}

static bool too_small(const fw_maths_stepper *s, double h) {
    return !(h > 16 * DBL_EPSILON * fabs(s->t)) || h < 1e10 * DBL_MIN;
}

bool fw_maths_ode_retry(fw_maths_stepper *s, double h, int *tries) {
    s->rejected++;
    return ++*tries < 100 && !too_small(s, h);
}

/* ---- interpolation ---- */

/* p on [0, 1] from value, slope and (with order 5) second derivative with respect to theta at both
   ends; gives p, p' and p'' */
static void hermite3(const double p[2], const double d[2], double x, double out[3]) {
    double bend = d[0] - (p[1] - p[0]), twist = (p[1] - p[0]) - d[1] - bend;
    out[0] = p[0] + x * (p[1] - p[0] + (1 - x) * (bend + x * twist));
    out[1] = p[1] - p[0] + (1 - 2 * x) * bend + (2 - 3 * x) * x * twist;
    out[2] = -2 * bend + (2 - 6 * x) * twist;
}

static void hermite5(const double p[2], const double d[2], const double b[2], double x,
                     double out[3]) {
    double e = p[1] - p[0] - d[0] - b[0] / 2, e1 = d[1] - d[0] - b[0], e2 = b[1] - b[0];
    double c3 = 10 * e - 4 * e1 + e2 / 2, c4 = -15 * e + 7 * e1 - e2, c5 = 6 * e - 3 * e1 + e2 / 2;
    out[0] = p[0] + x * (d[0] + x * (b[0] / 2 + x * (c3 + x * (c4 + x * c5))));
    out[1] = d[0] + x * (b[0] + x * (3 * c3 + x * (4 * c4 + x * 5 * c5)));
    out[2] = b[0] + x * (6 * c3 + x * (12 * c4 + x * 20 * c5));
}

void fw_maths_ode_span_value(const fw_maths_ode *ode, const fw_maths_ode_span *span, int c,
                             double theta, double *value, double *slope) {
    double h = span->h, out[3];
    int n = ode->positions;
    if (c >= 2 * n || (c >= n && span->v_alone)) {
        const double p[2] = {span->y_old[c], span->y[c]};
        const double d[2] = {h * span->f_old[c], h * span->f[c]};
        hermite3(p, d, theta, out);
        *value = out[0], *slope = out[1];
        return;
    }
    int u = c < n ? c : c - n, v = u + n;
    const double p[2] = {span->y_old[u], span->y[u]};
    const double d[2] = {h * span->y_old[v], h * span->y[v]};
    const double b[2] = {h * h * span->f_old[v], h * h * span->f[v]};
    hermite5(p, d, b, theta, out);
    *value = c < n ? out[0] : out[1] / h;
    *slope = c < n ? out[1] : out[2] / h;
}

static fw_maths_ode_span whole_step(const fw_maths_stepper *s) {
    return (fw_maths_ode_span){s->h, s->y_old, s->f_old, s->y, s->f, false};
}

void fw_maths_ode_hermite(const fw_maths_stepper *s, double theta, double *y) {
    const fw_maths_ode_span span = whole_step(s);
    double slope;
    for (int c = 0; c < s->ode.n; c++)
        fw_maths_ode_span_value(&s->ode, &span, c, theta, &y[c], &slope);
}

void fw_maths_ode_hermite_component(const fw_maths_stepper *s, int a, double wa, int b, double wb,
                                    double theta, double *value, double *slope) {
    const fw_maths_ode_span span = whole_step(s);
    double p = 0, d = 0;
    fw_maths_ode_span_value(&s->ode, &span, a, theta, value, slope);
    if (b >= 0) fw_maths_ode_span_value(&s->ode, &span, b, theta, &p, &d);
    *value = wa * *value + wb * p;
    *slope = wa * *slope + wb * d;
}
