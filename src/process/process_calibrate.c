/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include "base/constants.h"
#include "process/calibrate.h"
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
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

/* in the order in which one needs another: edges before the ladder, rates before depths by time */
#define FW_PROCESS_COUPON(name) &fw_process_coupon_##name,
static const fw_process_coupon *const table[] = {
#include "process/coupons.def"
};
#undef FW_PROCESS_COUPON
enum { KINDS = sizeof table / sizeof table[0] };

/* of a larger chi square: below, the data contradict */
static const double least_probability = 0.001;

/* ---- what kinds share ---- */

fw_status fw_process_coupon_wrong(fw_process_coupon_work *w, const fw_process_measurement *at,
                                  const char *format, ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return fw_diag_error(w->diags, 211, at->place, "%s", text);
}

bool fw_process_coupon_has(const fw_process_flow *flow, const char *id) {
    return fw_process_flow_quantity(flow, id) != NULL;
}

bool fw_process_coupon_value(const fw_process_coupon_work *w, const char *id, double *value,
                             double *uncertainty) {
    for (int i = 0; i < w->nknown; i++)
        if (strcmp(w->known[i].id, id) == 0) {
            *value = w->known[i].value;
            *uncertainty = w->known[i].uncertainty;
            return true;
        }
    const fw_quantity *q = fw_process_flow_quantity(w->flow, id);
    if (!q || q->unknown) return false;
    *value = q->value;
    *uncertainty = q->uncertainty;
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
            if (c->isotropic && c->thickness && !c->thickness->unknown)
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
    if (!fw_process_coupon_has(w->flow, id))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "%s gives %s, which flow '%s' does not have", coupon, id,
                                       w->flow->id);
    if (p < least_probability)
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
    w->out[w->nout++] = (fw_process_calibrated){
        id, value, uncertainty, coupon, note, fit->chi_square, p, w->n, fit->freedom};
    return FW_OK;
}

/* ---- the whole table ---- */

static const fw_process_coupon *kind_of(const char *name) {
    for (int i = 0; i < KINDS; i++)
        if (strcmp(table[i]->name, name) == 0) return table[i];
    return NULL;
}

static fw_status unknown_kind(fw_diags *diags, const fw_process_measurement *of) {
    const char *names[KINDS];
    for (int i = 0; i < KINDS; i++)
        names[i] = table[i]->name;
    const char *best = fw_did_you_mean(of->coupon, names, KINDS);
    fw_text list = fw_text_new(diags->arena);
    for (int i = 0; i < KINDS; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", names[i]);
    FW_TRY(fw_text_end(&list));
    return fw_diag_error(diags, 211, of->place, "there is no coupon '%s'%s%s%s; known are %s",
                         of->coupon, best ? "; did you mean '" : "", best ? best : "",
                         best ? "'?" : "", list.data);
}

static fw_status check_row(fw_diags *diags, const fw_process_measurement *r) {
    const fw_process_coupon *kind = kind_of(r->coupon);
    if (!kind) return unknown_kind(diags, r);
    const char *is = fw_quantity_dimension_text(diags->arena, r->dimension),
               *want = fw_quantity_dimension_text(diags->arena, kind->measured);
    FW_NEED(is ? want : NULL);
    if (!fw_quantity_dimension_equal(r->dimension, kind->measured))
        return fw_diag_error(diags, 211, r->place, "%s is measured as %s, not as %s", r->coupon,
                             want, is);
    if (kind->drawn && !(r->drawn_m > 0.0))
        return fw_diag_error(diags, 211, r->place, "%s needs drawn_um, the width on the mask",
                             r->coupon);
    if (kind->at && !(r->at > 0.0))
        return fw_diag_error(diags, 211, r->place,
                             "%s needs the columns at, u_at and at_unit: the time, depth, "
                             "charge or speed at which it was measured",
                             r->coupon);
    return FW_OK;
}

/* two coupons of one number: their weighted mean, unless they contradict each other */
static fw_status join(fw_arena *arena, fw_diags *diags, fw_process_calibrated *list, int *n) {
    for (int i = 0; i < *n; i++)
        for (int k = i + 1; k < *n; k++) {
            fw_process_calibrated *a = &list[i], *b = &list[k];
            if (strcmp(a->id, b->id) != 0) continue;
            double y[2] = {a->value, b->value}, s[2] = {a->uncertainty, b->uncertainty};
            fw_process_fit f = fw_process_fit_mean(y, s, 2);
            double p = fw_process_chi_square_above(f.chi_square, 1);
            char text[32];
            if (p < least_probability)
                return fw_diag_error(
                    diags, 212, (fw_place){0},
                    "%s from %s and from %s contradict each other (probability %s)", a->id,
                    a->coupon, b->coupon, number(text, p, 2));
            FW_NEED(a->coupon = fw_arena_printf(arena, "%s, %s", a->coupon, b->coupon));
            FW_NEED(a->note = fw_arena_printf(arena, "%s; and %s", a->note, b->note));
            a->value = f.value[0], a->uncertainty = f.uncertainty[0];
            a->rows += b->rows;
            a->chi_square += b->chi_square + f.chi_square;
            a->freedom += b->freedom + 1;
            a->probability = fw_process_chi_square_above(a->chi_square, a->freedom);
            memmove(b, b + 1, (size_t)(*n - k - 1) * sizeof *b);
            --*n, --k;
        }
    return FW_OK;
}

fw_status fw_process_calibrate(fw_arena *arena, const fw_process_flow *flow,
                               const fw_process_measurement *measurement, int n, fw_diags *diags,
                               fw_process_calibration *calibration) {
    fw_status status = FW_OK;
    fw_process_calibrated *out = fw_arena_array(arena, fw_process_calibrated, FW_COUPON_RESULTS);
    fw_process_coupon_work *w = fw_arena_one(arena, fw_process_coupon_work);
    FW_NEED(out ? w : NULL);
    *w = (fw_process_coupon_work){
        .arena = arena, .flow = flow, .known = out, .out = out, .diags = diags};
    for (int i = 0; i < n; i++) {
        fw_status of_row = check_row(diags, &measurement[i]);
        if (of_row == FW_NOMEM) return of_row;
        if (of_row != FW_OK) status = of_row;
    }
    if (n == 0) return fw_diag_error(diags, 211, (fw_place){0}, "the table holds no measurement");
    FW_TRY(status);
    for (int k = 0; k < KINDS; k++) {
        w->n = 0;
        for (int i = 0; i < n; i++) {
            if (kind_of(measurement[i].coupon) != table[k]) continue;
            if (w->n == FW_COUPON_ROWS)
                return fw_process_coupon_wrong(w, &measurement[i],
                                               "more than %d rows of one coupon", FW_COUPON_ROWS);
            w->measurement[w->n++] = &measurement[i];
        }
        if (w->n == 0) continue;
        fw_status of_kind = table[k]->fit(w);
        if (of_kind == FW_OK) of_kind = join(arena, diags, out, &w->nout);
        if (of_kind != FW_OK && of_kind != FW_INPUT) return of_kind;
        if (of_kind == FW_INPUT) status = of_kind; /* and what is wrong with the others */
        w->nknown = w->nout;
    }
    FW_TRY(status);
    *calibration = (fw_process_calibration){out, w->nout};
    return diags->failed ? FW_NOMEM : FW_OK;
}
