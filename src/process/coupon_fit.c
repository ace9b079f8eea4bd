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

void fw_process_coupon_note_read(fw_process_coupon_work *w, const fw_quantity *q) {
    if (!q || !q->id || fw_process_quantity_computed(q)) return;
    for (int i = 0; i < w->nread; i++)
        if (w->read[i] == q) return;
    if (w->nread < FW_COUPON_READ) w->read[w->nread++] = q;
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
    fw_process_coupon_note_read(w, q);
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

/* ---- rates that a step corrects for the conditions that they are had under ---- */

static const char of_rate[] = "rate";
static const struct {
    const char *at, *reference; /* arguments of the law */
} condition[FW_CONDITIONS] = {[FW_CONDITION_TEMPERATURE] = {"temperature", "reference_temperature"},
                              [FW_CONDITION_OPEN_AREA] = {"open_area", "reference_area"}};

const char *fw_process_condition_reference(fw_process_condition which) {
    return condition[which].reference;
}

/* of what the time is, and what cancels in a ratio of two: neither has a part in what a condition does */
static bool cancels(const char *name) {
    static const char *const none[] = {of_rate, "thickness", "depth", "width"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        if (strcmp(name, none[i]) == 0) return true;
    return false;
}

/* is it a part of the correction? Of a law that says which are, those; of an expression all that does not cancel */
static bool corrects(const fw_process_step *s, const char *name) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const int at = law && law->argument ? fw_process_law_argument_index(law, name) : -1;
    return at >= 0 ? law->argument[at].need == FW_LAW_WHEN_KNOWN : !cancels(name);
}

const fw_quantity *fw_process_step_corrects(const fw_process_step *s, fw_process_condition which,
                                            const char *rate) {
    const fw_quantity *R = fw_process_step_argument(s, of_rate),
                      *is = fw_process_step_argument(s, condition[which].at);
    bool known = R && R->id && strcmp(R->id, rate) == 0 &&
                 fw_process_step_argument(s, condition[which].reference);
    for (int i = 0; known && i < s->nargument; i++) /* it is made where all of it is known */
        known = !corrects(s, s->argument[i].name) || s->argument[i].q == is ||
                !s->argument[i].q->unknown;
    return known ? is : NULL;
}

const fw_process_step *fw_process_flow_corrects(const fw_process_flow *flow,
                                                fw_process_condition which, const char *rate) {
    for (int i = 0; i < flow->nstep; i++)
        if (fw_process_step_corrects(&flow->step[i], which, rate)) return &flow->step[i];
    return NULL;
}

typedef struct correction { /* what is asked of a step, at a value of a condition */
    const fw_process_step *step;
    fw_process_condition which;
    double at;
} correction;

/* s for 1 um at 1 um/s, through an opening of 1 um; NaN: the law has no answer there. `moved` is taken with that much more */
static fw_status time_at(fw_process_coupon_work *w, const correction *c, double at,
                         const fw_quantity *moved, double by, double *time_s) {
    const fw_process_step *s = c->step;
    fw_process_argument argument[FW_LAW_ARGUMENTS];
    fw_quantity q[FW_LAW_ARGUMENTS];
    fw_process_law_answer answer;
    *time_s = (double)NAN;
    if (s->nargument > FW_LAW_ARGUMENTS) return FW_OK;
    for (int i = 0; i < s->nargument; i++) {
        const char *name = s->argument[i].name;
        q[i] = *s->argument[i].q;
        argument[i] = (fw_process_argument){.name = name, .q = &q[i]};
        if (cancels(name))
            q[i].value = 1e-6;
        else if (strcmp(name, condition[c->which].at) == 0)
            q[i].value = at;
        else if (q[i].unknown)
            q[i].value = 0.0; /* a lag: it is in both times alike */
        else if (q[i].id)
            fw_process_coupon_value(w, q[i].id, &q[i].value, NULL);
        if (s->argument[i].q == moved) q[i].value += by;
        q[i].unknown = false, q[i].uncertainty = 0.0;
    }
    const fw_process_law_use use = fw_process_law_of_step(s, argument);
    if (!use.law) return FW_OK;
    FW_TRY(fw_process_law_evaluate(w->arena, &use, &answer));
    if (answer.computable && answer.value > 0.0) *time_s = answer.value;
    return FW_OK;
}

static fw_status speed(fw_process_coupon_work *w, const correction *c, double more,
                       const fw_quantity *moved, double by, double *factor) {
    const fw_quantity *reference = fw_process_step_argument(c->step, condition[c->which].reference);
    double from = reference->value, there, here;
    if (reference->id) fw_process_coupon_value(w, reference->id, &from, NULL);
    if (reference == moved) from += by;
    FW_TRY(time_at(w, c, c->at + more, moved, by, &there));
    FW_TRY(time_at(w, c, from, moved, by, &here));
    *factor = here / there;
    return FW_OK;
}

fw_status fw_process_step_speed(fw_process_coupon_work *w, const fw_process_step *s,
                                fw_process_condition which, double at, double *factor) {
    const correction c = {s, which, at};
    return speed(w, &c, 0.0, NULL, 0.0, factor);
}

/* relative change of the speed by one standard uncertainty u of an input of the law, or of the condition: central over
   +-0.1 u, as the covariances are (process_calibrate.c), so that what the same input takes back later goes out */
static fw_status changed(fw_process_coupon_work *w, const correction *c, const fw_quantity *q,
                         double u, double *change) {
    static const double part = 0.1;
    const double of_at = q ? 0.0 : part * u, of_q = q ? part * u : 0.0;
    double f[2];
    FW_TRY(speed(w, c, -of_at, q, -of_q, &f[0]));
    FW_TRY(speed(w, c, of_at, q, of_q, &f[1]));
    *change = (f[1] - f[0]) / (f[1] + f[0]) / part;
    return FW_OK;
}

/* of one condition, into what others do */
static fw_status correct_for(fw_process_coupon_work *w, const correction *c,
                             const fw_process_measurement *row, fw_process_coupon_speed *out) {
    double f, change, u;
    FW_TRY(speed(w, c, 0.0, NULL, 0.0, &f));
    if (!(f > 0.0))
        return fw_process_coupon_wrong(
            w, row, "%s: the law of step %s has no rate at a %s of %.4g %s", row->coupon,
            c->step->id, c->which == FW_CONDITION_TEMPERATURE ? "temperature" : "open area", c->at,
            c->which == FW_CONDITION_TEMPERATURE ? "K" : "m2");
    FW_TRY(changed(w, c, NULL, row->condition_uncertainty[c->which], &change));
    out->factor *= f;
    out->uncertainty = hypot(out->uncertainty, change);
    for (int i = 0; i < c->step->nargument; i++) {
        const char *name = c->step->argument[i].name;
        const fw_quantity *q = c->step->argument[i].q;
        double value;
        if (!corrects(c->step, name) || strcmp(name, condition[c->which].at) == 0 || !q->id ||
            !fw_process_coupon_value(w, q->id, &value, &u) || !(u > 0.0))
            continue;
        FW_TRY(changed(w, c, q, u, &change));
        out->uncertainty = hypot(out->uncertainty, change);
    }
    return FW_OK;
}

/* f = t(reference)/t(as it was) by the step's own law, in which the rate cancels; u(f)/f is the root of the sum of the squares
   of what each input of the law, and the condition, changes it by. SI; f 1. Test: test_calibrate.c, of_warm_baths,
   of_open_areas. */
fw_status fw_process_coupon_sped(fw_process_coupon_work *w, const char *id,
                                 const fw_process_measurement *row, fw_process_coupon_speed *out) {
    *out = (fw_process_coupon_speed){.factor = 1.0};
    for (int k = 0; k < FW_CONDITIONS; k++) {
        const fw_process_condition which = (fw_process_condition)k;
        const correction c = {fw_process_flow_corrects(w->flow, which, id), which,
                              row->condition[k]};
        if (c.step && c.at > 0.0) FW_TRY(correct_for(w, &c, row, out));
    }
    return FW_OK;
}

/* would the step correct the rate, were all of it known? */
static const fw_quantity *would_correct(const fw_process_step *s, fw_process_condition which,
                                        const char *rate) {
    const fw_quantity *R = fw_process_step_argument(s, of_rate);
    return R && R->id && strcmp(R->id, rate) == 0 &&
                   fw_process_step_argument(s, condition[which].reference)
               ? fw_process_step_argument(s, condition[which].at)
               : NULL;
}

/* what a rate is corrected by later, known now or not */
static void note_corrections(fw_process_coupon_work *w, const char *rate) {
    for (int i = 0; i < w->flow->nstep * FW_CONDITIONS; i++) {
        const fw_process_step *s = &w->flow->step[i / FW_CONDITIONS];
        const fw_quantity *is = would_correct(s, (fw_process_condition)(i % FW_CONDITIONS), rate);
        for (int m = 0; m < s->nargument && is; m++)
            if (s->argument[m].q != is && corrects(s, s->argument[m].name))
                fw_process_coupon_note_read(w, s->argument[m].q);
    }
}

fw_process_coupon_lacking fw_process_coupon_lacks(const fw_process_flow *flow,
                                                  fw_process_condition which, const char *rate) {
    fw_process_coupon_lacking out = {0};
    for (int i = 0; i < flow->nstep && !out.step; i++) {
        const fw_process_step *s = &flow->step[i];
        const fw_quantity *is = would_correct(s, which, rate);
        if (is) out.step = s;
        for (int m = 0; m < s->nargument && is; m++) {
            const fw_quantity *q = s->argument[m].q;
            if (q != is && q->id && q->unknown && corrects(s, s->argument[m].name) &&
                out.n < FW_LAW_ARGUMENTS)
                out.q[out.n++] = q;
        }
    }
    return out;
}

const fw_quantity *fw_process_change_takes_edges(const fw_process_flow *flow,
                                                 const fw_process_change *c) {
    return c->isotropic && fw_process_where_is_of_device(flow, c->where) ? c->thickness : NULL;
}

double fw_process_coupon_loss(const fw_process_flow *flow, fw_process_coupon_work *w) {
    double loss = 0.0;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (!fw_process_change_takes_edges(flow, c)) continue;
            if (w) fw_process_coupon_note_read(w, c->thickness);
            if (w) fw_process_coupon_note_read(w, flow->step[i].overrun_from);
            if (!c->thickness->unknown) loss += c->thickness->value * (1.0 + flow->step[i].overrun);
        }
    return loss;
}

static const char *number(char text[32], double value, int digits) {
    return fw_number_text(text, 32, value, digits);
}

/* of the rows that a rate comes of; not where one of them does not say (any one does of those of one run) */
static void note_condition(const fw_process_coupon_work *w, fw_process_condition which,
                           fw_process_calibrated *c) {
    bool said = fw_process_flow_corrects(w->flow, which, c->id);
    double low = (double)INFINITY, high = 0.0;
    for (int i = 0; said && i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        const double at = r->condition[which];
        if (has(w->flow, r->feature) && strcmp(r->feature, c->id) != 0) continue;
        said = w->one_run || at > 0.0;
        if (!(at > 0.0)) continue;
        low = fmin(low, at);
        high = fmax(high, at);
    }
    if (said && high > 0.0) c->least[which] = low, c->most[which] = high;
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
    for (int k = 0; k < FW_CONDITIONS; k++)
        note_condition(w, (fw_process_condition)k, &w->out[w->nout - 1]);
    note_corrections(w, id);
    return FW_OK;
}

/* ---- what several coupons say of one result ---- */

void fw_process_calibrated_join(fw_process_calibrated *a, const fw_process_calibrated *b) {
    for (int k = 0; k < FW_CONDITIONS; k++) {
        const bool both = a->most[k] > 0.0 && b->most[k] > 0.0;
        a->least[k] = both ? fmin(a->least[k], b->least[k]) : 0.0;
        a->most[k] = both ? fmax(a->most[k], b->most[k]) : 0.0;
    }
}

fw_status fw_process_calibration_with(fw_arena *arena, fw_process_calibration *c,
                                      const fw_process_found_with *with) {
    for (int i = 0; i < c->nwith; i++)
        if (c->with[i].q == with->q && strcmp(c->with[i].of, with->of) == 0) return FW_OK;
    fw_process_found_with *grown =
        fw_arena_grow(arena, c->with, (size_t)c->nwith, (size_t)c->nwith + 1, sizeof *grown);
    FW_NEED(grown);
    grown[c->nwith++] = *with;
    c->with = grown;
    return FW_OK;
}

const char *fw_process_coupon_edge(const fw_process_flow *flow) {
    static const char etched[] = "made.al-edge";
    return has(flow, etched) ? etched : FW_PROCESS_PRINTED_EDGE;
}

static bool is_found(const fw_process_coupon_work *w, const char *id) {
    for (int i = 0; i < w->nknown; i++)
        if (strcmp(w->known[i].id, id) == 0) return true;
    return false;
}

/* e = sum e_k - L: e_k of the flow's corners of edges that count, as the fixed point has them; where cd-lines found the edge
   of this layer, that alone, since what was printed is in it. m. Test: test_calibrate.c, slots_as_the_mask_opens_them */
void fw_process_coupon_mask_edge(fw_process_coupon_work *w, double *edge, double *uncertainty) {
    const char *read = fw_process_coupon_edge(w->flow);
    double e, u;
    *edge = -fw_process_coupon_loss(w->flow, w);
    *uncertainty = 0.0;
    for (int i = 0; i < w->flow->ncorner; i++) {
        const fw_process_corner *c = &w->flow->corner[i];
        if (c->of != FW_CORNER_EDGE || !c->q || !c->q->id || !fw_process_corner_counts(c)) continue;
        if (is_found(w, read) && strcmp(c->q->id, read) != 0) continue;
        if (!fw_process_coupon_value(w, c->q->id, &e, &u)) continue;
        *edge += e;
        *uncertainty = hypot(*uncertainty, u);
    }
}

/* ---- how the next wafer differs, where no reading says it ---- */

/* Of what lies on one side of 0 the spread is relative: a bath that etches twice as fast differs by twice as much. Of a share,
   which may come out as 0 or 1, and of where an edge lies, it is not. */
static bool spreads_in_proportion(fw_arena *arena, const fw_quantity *of) {
    fw_diags quiet = fw_diags_new(arena);
    fw_quantity below = *of, above = *of;
    below.value = -1e-9, above.value = 1.0 + 1e-9;
    below.unknown = above.unknown = false;
    return !fw_process_quantity_in_range(&below, &quiet) &&
           (!fw_quantity_dimension_equal(of->dimension, (fw_quantity_dimension){0}) ||
            fw_process_quantity_in_range(&above, &quiet));
}

/* the range that a corner takes where nobody knows the quantity; NULL: none does */
static const fw_quantity *assumed_of(const fw_process_flow *flow, const fw_quantity *q) {
    for (int i = 0; i < flow->ncorner; i++)
        if (flow->corner[i].q == q && flow->corner[i].assumed) return flow->corner[i].assumed;
    return NULL;
}

/* s: the spread that the flow states for the quantity, else its standard uncertainty u; relative where it is in proportion,
   s = u x/x_0; and with those of the corners that are within it once it is measured: s^2 = s_0^2 + sum s_k^2. No more than what
   cannot be below 0 may be off by at all. u holds both where this laboratory lies and how its wafers differ, and the reading took the
   first away. SI. Source: docs/theory/calibrate.md. Test: test_wafers.c, one_wafer_keeps_the_spread. */
static double spread_of(fw_arena *arena, const fw_process_flow *flow,
                        const fw_process_calibrated *c) {
    const fw_quantity *q = fw_process_flow_quantity(flow, c->id),
                      *of = q && q->unknown ? assumed_of(flow, q) : q;
    fw_diags quiet = fw_diags_new(arena);
    double s = 0.0;
    if (of && !of->unknown) {
        s = of->spread > 0.0 ? of->spread : of->uncertainty;
        if (of->value > 0.0 && spreads_in_proportion(arena, q)) s *= c->value / of->value;
    }
    for (int i = 0; i < flow->ncorner; i++) {
        const fw_process_corner *k = &flow->corner[i];
        const fw_quantity *in = k->q && k->q->unknown ? k->assumed : k->q;
        if (k->within != q || !q || !in || in->unknown || !fw_process_corner_counts(k)) continue;
        s = hypot(s, in->spread > 0.0 ? in->spread : in->uncertainty);
    }
    if (!q) return 0.0;
    fw_quantity below = *q;
    below.value = -1e-9, below.unknown = false;
    if (c->value > 0.0 && !fw_process_quantity_in_range(&below, &quiet))
        s = fmin(s, sqrt(fmax(c->value * c->value - c->uncertainty * c->uncertainty, 0.0)));
    return s;
}

double fw_process_calibrated_read_u(const fw_process_calibrated *c) {
    return sqrt(fmax(c->uncertainty * c->uncertainty - c->spread * c->spread, 0.0));
}

fw_status fw_process_calibrated_spread(fw_arena *arena, const fw_process_flow *flow,
                                       const char *who, fw_process_calibrated *c) {
    const fw_quantity *q = fw_process_flow_quantity(flow, c->id);
    fw_quantity_unit unit;
    char text[32];
    c->spread_taken = true;
    c->spread = spread_of(arena, flow, c);
    if (!(c->spread > 0.0) || !fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL))
        c->note =
            fw_arena_printf(arena, "%s; %s: how the next one differs is not known", c->note, who);
    else {
        unit.offset = 0.0;
        c->note = fw_arena_printf(
            arena,
            "%s; %s: how the next one differs is taken to be what the flow had for it, +- %s%s%s",
            c->note, who,
            fw_number_text(text, sizeof text, fw_quantity_unit_from_si(&unit, c->spread), 2),
            strcmp(q->unit, "1") == 0 ? "" : " ", strcmp(q->unit, "1") == 0 ? "" : q->unit);
    }
    c->uncertainty = hypot(c->uncertainty, c->spread);
    return c->note ? FW_OK : FW_NOMEM;
}

/* what is correlated with others is the part that was read: r_ij -> r_ij f_i f_j, f = u_read/u */
fw_status fw_process_calibration_keep_spread(fw_arena *arena, const fw_process_flow *flow,
                                             fw_process_calibration *calibration) {
    const int n = calibration->njoint;
    fw_process_calibrated *item =
        fw_arena_array(arena, fw_process_calibrated, (size_t)calibration->count + 1);
    double *f = fw_arena_array(arena, double, (size_t)n + 1),
           *r = fw_arena_array(arena, double, (size_t)(n * n) + 1);
    FW_NEED(item && f ? r : NULL);
    for (int k = 0; k < n; k++)
        f[k] = 1.0;
    for (int i = 0; i < calibration->count; i++) {
        item[i] = calibration->item[i];
        FW_TRY(fw_process_calibrated_spread(arena, flow, "a table has no wafers", &item[i]));
        for (int k = 0; k < n; k++)
            if (strcmp(calibration->joint[k], item[i].id) == 0 && item[i].uncertainty > 0.0)
                f[k] = fw_process_calibrated_read_u(&item[i]) / item[i].uncertainty;
    }
    for (int i = 0; i < n * n; i++)
        r[i] = calibration->correlation[i] * (i % (n + 1) ? f[i / n] * f[i % n] : 1.0);
    calibration->item = item;
    if (n > 0) calibration->correlation = r;
    return FW_OK;
}
