/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What kinds of coupons share: fits, their test, and results. */
#include "process/coupon.h"
#include "process/films.h"
#include "process/pack.h"
#include "base/constants.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* m = sum(y/s^2)/sum(1/s^2), u = 1/sqrt(sum(1/s^2)), chi^2 = sum((y - m)^2/s^2). Any one unit.
   Source: textbook, e.g. Bevington and Robinson, ch. 4. Test: test_fit.c, mean. */
fw_process_fit fw_process_fit_mean(const double *y, const double *s, int n) {
    fw_process_fit f = {.freedom = n - 1};
    double weight = 0.0, sum = 0.0;
    for (int i = 0; i < n; i++) {
        weight += 1.0 / (s[i] * s[i]);
        sum += y[i] / (s[i] * s[i]);
    }
    f.value[0] = sum / weight;
    f.uncertainty[0] = 1.0 / sqrt(weight);
    for (int i = 0; i < n; i++)
        f.chi_square += (y[i] - f.value[0]) * (y[i] - f.value[0]) / (s[i] * s[i]);
    return f;
}

/* R that minimises sum((y - R x)^2/v), v = s_y^2 + R^2 s_x^2: sum((y - R x) x^/v) = 0 with the
   adjusted x^ = x + R s_x^2 (y - R x)/v, solved by a fixed point that contracts by (s_x/x)^2.
   u = 1/sqrt(sum(x^2/v)). Source: York, Can. J. Phys. 44 (1966) 1079, through the origin.
   Test: test_fit.c, ratio; test_calibrate.c, coverage. */
fw_process_fit fw_process_fit_ratio(const double *y, const double *s_y, const double *x,
                                    const double *s_x, int n) {
    fw_process_fit f = {.freedom = n - 1};
    double R = 0.0, above = 0.0, below = 0.0;
    for (int i = 0; i < n; i++) {
        above += y[i] * x[i] / (s_y[i] * s_y[i]);
        below += x[i] * x[i] / (s_y[i] * s_y[i]);
    }
    R = above / below;
    for (int round = 0; round < 30; round++) {
        above = below = 0.0;
        for (int i = 0; i < n; i++) {
            double v = s_y[i] * s_y[i] + R * R * s_x[i] * s_x[i];
            double adjusted = x[i] + R * s_x[i] * s_x[i] * (y[i] - R * x[i]) / v;
            above += y[i] * adjusted / v;
            below += x[i] * adjusted / v;
        }
        R = above / below;
    }
    double weight = 0.0;
    for (int i = 0; i < n; i++) {
        double v = s_y[i] * s_y[i] + R * R * s_x[i] * s_x[i], r = y[i] - R * x[i];
        weight += x[i] * x[i] / v;
        f.chi_square += r * r / v;
    }
    f.value[0] = R;
    f.uncertainty[0] = 1.0 / sqrt(weight);
    return f;
}

/* Normal equations of two parameters: [pp pq; pq qq] [a b] = [py qy], sums weighted with 1/s^2; the
   inverse of the matrix is the covariance. Test: test_fit.c, plane. */
fw_process_fit fw_process_fit_plane(const double *y, const double *s, const double *p,
                                    const double *q, int n) {
    fw_process_fit f = {.freedom = n - 2};
    double pp = 0, pq = 0, qq = 0, py = 0, qy = 0;
    for (int i = 0; i < n; i++) {
        double w = 1.0 / (s[i] * s[i]);
        pp += w * p[i] * p[i], pq += w * p[i] * q[i], qq += w * q[i] * q[i];
        py += w * p[i] * y[i], qy += w * q[i] * y[i];
    }
    double det = pp * qq - pq * pq;
    if (!(det > 1e-12 * pp * qq)) {
        f.value[0] = f.value[1] = f.uncertainty[0] = f.uncertainty[1] = (double)NAN;
        return f;
    }
    f.value[0] = (qq * py - pq * qy) / det;
    f.value[1] = (pp * qy - pq * py) / det;
    f.uncertainty[0] = sqrt(qq / det);
    f.uncertainty[1] = sqrt(pp / det);
    f.correlation = -pq / sqrt(pp * qq);
    for (int i = 0; i < n; i++) {
        double r = y[i] - f.value[0] * p[i] - f.value[1] * q[i];
        f.chi_square += r * r / (s[i] * s[i]);
    }
    return f;
}

/* Q(n/2, x/2) for whole n, a finite sum: even n exp(-h) sum h^k/k!, k < n/2; odd n erfc(sqrt h) +
   exp(-h) sum h^(k+1/2)/Gamma(k + 3/2), k < (n - 1)/2; h = x/2. Source: Abramowitz and
   Stegun 26.4.4 and 26.4.5. Error 1e-14. Test: test_fit.c, chi_square (table 26.8). */
double fw_process_chi_square_above(double x, int n) {
    if (n <= 0) return 1.0;
    bool odd = n % 2 == 1;
    double h = 0.5 * x, sum = odd ? erfc(sqrt(h)) : 0.0;
    double term = odd ? exp(-h) * sqrt(h) / (0.5 * sqrt(FW_PI)) : exp(-h);
    for (int k = 0; k < n / 2; k++) {
        sum += term;
        term *= h / (k + (odd ? 1.5 : 1.0));
    }
    return fmin(sum, 1.0);
}

/* ---- what kinds read and give ---- */

fw_status fw_process_coupon_wrong(fw_process_coupon_work *w, const fw_process_measurement *at,
                                  const char *format, ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return fw_diag_error(w->diags, 211, at->place, "%s", text);
}

static bool has(const fw_process_flow *flow, const char *id) {
    return fw_process_flow_quantity(flow, id) != NULL;
}

static void note_use(fw_process_coupon_work *w, const fw_quantity *q) {
    for (int i = 0; i < w->nused; i++)
        if (w->used[i] == q) return;
    if (q->uncertainty > 0.0 && w->nused < FW_COUPON_USED) w->used[w->nused++] = q;
}

bool fw_process_coupon_value(fw_process_coupon_work *w, const char *id, double *value,
                             double *uncertainty) {
    for (int i = 0; i < w->nknown; i++)
        if (strcmp(w->known[i].id, id) == 0) {
            *value = w->known[i].value;
            if (uncertainty) *uncertainty = w->known[i].uncertainty;
            return true;
        }
    const fw_quantity *q = fw_process_flow_quantity(w->flow, id);
    if (!q || q->unknown) return false;
    *value = q->value + (q == w->shifted ? w->shift : 0.0);
    if (uncertainty) {
        *uncertainty = q->uncertainty;
        note_use(w, q);
    }
    return true;
}

fw_status fw_process_coupon_condition(fw_process_coupon_work *w, fw_quantity_dimension d,
                                      const char *what, double *value, double *uncertainty) {
    const fw_process_measurement *first = w->measurement[0];
    *value = first->at;
    *uncertainty = first->at_uncertainty;
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        if (!fw_quantity_dimension_equal(r->at_dimension, d) || !(r->at > 0.0))
            return fw_process_coupon_wrong(w, r, "%s needs %s in the columns at, u_at and at_unit",
                                           r->coupon, what);
        if (fabs(r->at - *value) > 1e-9 * *value ||
            fabs(r->at_uncertainty - *uncertainty) > 1e-9 * *value)
            return fw_process_coupon_wrong(
                w, r,
                "%s: all rows are of one run, so %s and its uncertainty are "
                "the same in all; put other runs into a table of their own",
                r->coupon, what);
    }
    return FW_OK;
}

double fw_process_coupon_loss(const fw_process_flow *flow) {
    double loss = 0.0;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (c->isotropic && fw_process_where_is_of_device(flow, c->where) && c->thickness &&
                !c->thickness->unknown)
                loss += c->thickness->value * (1.0 + flow->step[i].overrun);
        }
    return loss;
}

static const char *number(char text[32], double value, int digits) {
    return fw_number_text(text, 32, value, digits);
}

fw_status fw_process_coupon_give(fw_process_coupon_work *w, const char *id, double value,
                                 double uncertainty, const fw_process_fit *fit, const char *note) {
    double p = fw_process_chi_square_above(fit->chi_square, fit->freedom);
    const char *coupon = w->measurement[0]->coupon;
    char a[32], b[32];
    if (!has(w->flow, id))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "%s gives %s, which flow '%s' does not have", coupon, id,
                                       w->flow->id);
    if (p < FW_COUPON_LEAST_PROBABILITY)
        return fw_diag_error(w->diags, 212, w->measurement[0]->place,
                             "the values of %s scatter more around their model than their "
                             "uncertainties allow: chi square %s with %d degrees of freedom has "
                             "a probability of %s; %s is not calibrated from it",
                             coupon, number(a, fit->chi_square, 4), fit->freedom, number(b, p, 2),
                             id);
    if (!(uncertainty > 0.0) || !isfinite(value) || !isfinite(uncertainty))
        return fw_process_coupon_wrong(w, w->measurement[0], "%s gives no finite value of %s",
                                       coupon, id);
    if (w->nout == FW_COUPON_RESULTS) return FW_LIMIT;
    w->out[w->nout++] = (fw_process_calibrated){.id = id,
                                                .value = value,
                                                .uncertainty = uncertainty,
                                                .coupon = coupon,
                                                .note = note,
                                                .chi_square = fit->chi_square,
                                                .probability = p,
                                                .rows = w->n,
                                                .freedom = fit->freedom};
    return FW_OK;
}

/* how thick the material was when it was put there last, before the step */
static const fw_quantity *put_there(const fw_process_flow *flow, int before, const char *material) {
    for (int i = before - 1; i >= 0; i--)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (strcmp(c->kind, "add") == 0 && strcmp(c->material, material) == 0)
                return c->thickness;
        }
    return NULL;
}

fw_process_etch fw_process_flow_etch(const fw_process_flow *flow) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nchange; k++) {
            const fw_process_change *c = &s->change[k];
            if (!c->anisotropy || strcmp(c->kind, "remove") != 0 || !flow->material ||
                strcmp(c->material, flow->material) != 0)
                continue;
            fw_process_etch e = {.rate = fw_process_step_argument(s, "rate"),
                                 .lag = fw_process_step_argument(s, "probability"),
                                 .anisotropy = c->anisotropy,
                                 .over_etch = s->overrun_from};
            for (int x = 0; x < s->nexposed && !e.selectivity; x++) {
                e.selectivity = s->exposed[x].selectivity;
                if (e.selectivity) e.mask = put_there(flow, i, s->exposed[x].material);
            }
            return e;
        }
    }
    return (fw_process_etch){0};
}

const char *fw_process_coupon_edge(const fw_process_flow *flow) {
    static const char etched[] = "made.al-edge";
    return has(flow, etched) ? etched : FW_PROCESS_PRINTED_EDGE;
}
