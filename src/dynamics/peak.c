/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/model.h"
#include "maths/brent.h"
#include <math.h>

fw_status fw_peaks_new(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                       fw_peaks *peaks) {
    size_t n = (size_t)mechanism->npin;
    FW_NEED(peaks->start = fw_arena_array(arena, double, n));
    FW_NEED(peaks->peak = fw_arena_array(arena, fw_peak, n));
    FW_NEED(peaks->a = fw_arena_array(arena, int, n));
    FW_NEED(peaks->b = fw_arena_array(arena, int, n));
    peaks->npin = mechanism->npin;
    for (size_t i = 0; i < n; i++) {
        const fw_pin *p = &mechanism->pin[i];
        peaks->a[i] = p->body_a == FW_GROUND ? -1 : 3 * p->body_a + 2;
        peaks->b[i] = p->body_b == FW_GROUND ? -1 : 3 * p->body_b + 2;
        double a = p->body_a == FW_GROUND ? 0 : q[peaks->a[i]];
        double b = p->body_b == FW_GROUND ? 0 : q[peaks->b[i]];
        peaks->start[i] = b - a - p->free_angle_rad;
        peaks->peak[i] = (fw_peak){.angle_rad = peaks->start[i]};
    }
    return FW_OK;
}

static double difference(const double *y, int a, int b) {
    return (b < 0 ? 0 : y[b]) - (a < 0 ? 0 : y[a]);
}

double fw_peaks_angle(const fw_peaks *peaks, int pin, const double *y) {
    return peaks->start[pin] + difference(y, peaks->a[pin], peaks->b[pin]);
}

static void offer(fw_peak *peak, double angle, double t) {
    if (fabs(angle) > fabs(peak->angle_rad)) peak->angle_rad = angle, peak->t_s = t;
}

static double slope_of(const void *coefficients, double theta) {
    double value, slope;
    fw_dop853_dense_value(coefficients, theta, &value, &slope);
    return slope;
}

/* extremes of one angle inside the step: the derivative of the dense polynomial (order 7) is
   sampled at 16 places, its sign changes refined by Brent's method */
static void search(fw_peak *peak, const fw_dop853 *s, double start, int a, int b) {
    double r[8], before;
    for (int i = 0; i < 8; i++)
        r[i] = difference(s->dense + (size_t)i * (size_t)s->ode.n, a, b);
    before = slope_of(r, 0);
    for (int i = 1; i <= 16; i++) {
        double at = i / 16.0, now = slope_of(r, at);
        if ((before < 0) != (now < 0)) {
            double value, slope, root = fw_brent_root(slope_of, r, at - 1.0 / 16, at, 1e-12);
            if (!isnan(root)) {
                fw_dop853_dense_value(r, root, &value, &slope);
                offer(peak, start + value, s->t_old + root * s->h);
            }
        }
        before = now;
    }
}

/* can the angle exceed its peak inside the step, and turn there? From the angles, rates and second
   rates at both ends; counts every contribution twice, so that a wrong no would need derivatives
   that the error control of an eighth-order step excludes */
static bool may_exceed(double peak, const double angle[2], const double rate[2],
                       const double bend[2], double h) {
    double most = fmax(fabs(bend[0]), fabs(bend[1])) * h;
    bool turns = (rate[0] < 0) != (rate[1] < 0) || rate[0] == 0 || rate[1] == 0 ||
                 fmin(fabs(rate[0]), fabs(rate[1])) < most;
    double reach = fmax(fabs(angle[0]), fabs(angle[1])) + h * (fabs(rate[0]) + fabs(rate[1])) / 2 +
                   h * most / 8;
    return turns && reach > peak;
}

void fw_peaks_step(fw_peaks *peaks, const fw_model *m, fw_dop853 *s) {
    for (int i = 0; i < peaks->npin; i++) {
        int a = peaks->a[i], b = peaks->b[i], n = m->nq;
        double start = peaks->start[i];
        const double angle[2] = {start + difference(s->y_old, a, b),
                                 start + difference(s->y, a, b)};
        const double rate[2] = {difference(s->k, a, b), difference(s->f, a, b)};
        const double bend[2] = {difference(s->k + n, a, b), difference(s->f + n, a, b)};
        offer(&peaks->peak[i], angle[1], s->t);
        if (may_exceed(fabs(peaks->peak[i].angle_rad), angle, rate, bend, s->h)) {
            fw_dop853_dense_prepare(s);
            search(&peaks->peak[i], s, start, a, b);
        }
    }
}
