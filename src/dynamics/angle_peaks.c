/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Largest angles of the pins: extremes inside of steps by the dense output, and the marks at which
   two runs are compared. And how far the ends of flexures that give are displaced: over the strip's
   length that counts as an angle does, so that a stage on leaves, which moves and hardly turns any,
   has a deflection that errors of angles are relative to. Errors of the displacement itself show in
   the joint forces and in the strains. Test: test_peak.c. */
#include "dynamics/run.h"
#include "maths/cdf.h"
#include <math.h>
#include <string.h>

/* ---- displacements ---- */

/* of the second body's point from the first body's, world axes, over the strip's length */
static void opening(const fw_dynamics_peaks *peaks, const fw_dynamics_strip *s, const double *y,
                    double out[2]) {
    double x[2], z[2];
    for (int i = 0; i < 2; i++) {
        x[i] = s->local[i][0], z[i] = s->local[i][1];
        if (s->body[i] == FW_GROUND) continue;
        const double *at = y + 3 * s->body[i], *from = peaks->rest + 3 * s->body[i];
        double c = cos(from[2] + at[2]), n = sin(from[2] + at[2]);
        x[i] = from[0] + at[0] + c * s->local[i][0] - n * s->local[i][1];
        z[i] = from[1] + at[1] + n * s->local[i][0] + c * s->local[i][1];
    }
    out[0] = (x[1] - x[0]) * s->per_length, out[1] = (z[1] - z[0]) * s->per_length;
}

static void offer_openings(fw_dynamics_peaks *peaks, const double *y) {
    for (int i = 0; i < peaks->nstrip; i++) {
        double at[2];
        opening(peaks, &peaks->strip[i], y, at);
        peaks->displaced = fmax(peaks->displaced, hypot(at[0], at[1]));
    }
}

static fw_status find_strips(fw_arena *arena, const fw_mechanism *m, const double *q,
                             const fw_multibody_model *model, fw_dynamics_peaks *peaks) {
    double unit = model->scale.length_m;
    peaks->nstrip = 0, peaks->displaced = 0;
    FW_NEED(peaks->rest = fw_arena_array(arena, double, 3 * (size_t)m->nbody + 1));
    FW_NEED(peaks->strip = fw_arena_array(arena, fw_dynamics_strip, (size_t)m->nhinge + 1));
    for (int i = 0; i < 3 * m->nbody; i++)
        peaks->rest[i] = q[i] / (i % 3 == 2 ? 1 : unit);
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_pin *p = &m->pin[m->hinge[k].pin];
        double L = m->hinge[k].law.length_m;
        if (model->pin_block[m->hinge[k].pin] != FW_NONE || !(L > 0)) continue;
        peaks->strip[peaks->nstrip++] = (fw_dynamics_strip){
            .body = {p->body_a, p->body_b},
            .local = {{p->ax_m / unit, p->ay_m / unit}, {p->bx_m / unit, p->by_m / unit}},
            .per_length = unit / L};
    }
    return FW_OK;
}

/* ---- angles of the pins ---- */

fw_status fw_dynamics_peaks_new(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                                const fw_multibody_model *model, fw_dynamics_peaks *peaks) {
    size_t n = (size_t)mechanism->npin;
    FW_NEED(peaks->start = fw_arena_array(arena, double, n));
    FW_NEED(peaks->peak = fw_arena_array(arena, fw_dynamics_peak, n));
    FW_NEED(peaks->a = fw_arena_array(arena, int, n));
    FW_NEED(peaks->b = fw_arena_array(arena, int, n));
    FW_NEED(peaks->mark_t = fw_arena_array(arena, double, FW_MARKS));
    FW_NEED(peaks->mark = fw_arena_array(arena, double, FW_MARKS *n));
    FW_NEED(peaks->size = fw_arena_array(arena, double, FW_MARKS *n));
    FW_NEED(peaks->held = fw_arena_array(arena, fw_dynamics_peak, n));
    peaks->npin = mechanism->npin;
    peaks->nmark = 0;
    peaks->marked = NULL;
    for (size_t i = 0; i < n; i++) {
        const fw_mechanism_pin *p = &mechanism->pin[i];
        peaks->a[i] = p->body_a == FW_GROUND ? -1 : 3 * p->body_a + 2;
        peaks->b[i] = p->body_b == FW_GROUND ? -1 : 3 * p->body_b + 2;
        double a = p->body_a == FW_GROUND ? 0 : q[peaks->a[i]];
        double b = p->body_b == FW_GROUND ? 0 : q[peaks->b[i]];
        peaks->start[i] = b - a - p->free_angle_rad;
        peaks->peak[i] = (fw_dynamics_peak){.angle_rad = peaks->start[i]};
    }
    return find_strips(arena, mechanism, q, model, peaks);
}

static double difference(const double *y, int a, int b) {
    return (b < 0 ? 0 : y[b]) - (a < 0 ? 0 : y[a]);
}

double fw_dynamics_peaks_angle(const fw_dynamics_peaks *peaks, int pin, const double *y) {
    return peaks->start[pin] + difference(y, peaks->a[pin], peaks->b[pin]);
}

static void offer_angle(fw_dynamics_peak *peak, double angle, double t) {
    if (fabs(angle) > fabs(peak->angle_rad)) peak->angle_rad = angle, peak->t_s = t;
}

typedef struct turn { /* of one pin along the last step */
    fw_maths_stepper *stepper;
    int a, b; /* components, or -1 */
} turn;

/* value and slope of y[b] - y[a] over theta */
static void along(const turn *p, double theta, double *value, double *slope) {
    if (p->b < 0)
        fw_maths_stepper_component(p->stepper, p->a, -1, -1, 0, theta, value, slope);
    else
        fw_maths_stepper_component(p->stepper, p->b, 1, p->a, -1, theta, value, slope);
}

static double slope_of(const void *context, double theta) {
    double value, slope;
    along(context, theta, &value, &slope);
    return slope;
}

/* extremes of one angle inside the step up to `end`: the derivative of the dense output is sampled
   at 16 places, its sign changes refined by Brent's method */
static void search(fw_dynamics_peak *peak, const turn *p, double start, double end) {
    const fw_maths_stepper *s = p->stepper;
    double before = slope_of(p, 0);
    for (int i = 1; i <= 16; i++) {
        double at = end * i / 16, now = slope_of(p, at);
        if ((before < 0) != (now < 0)) {
            double value, slope, root = fw_maths_brent_root(slope_of, p, at - end / 16, at, 1e-12);
            if (!isnan(root)) {
                along(p, root, &value, &slope);
                offer_angle(peak, start + value, s->t_old + root * s->h);
            }
        }
        before = now;
    }
}

/* can the angle exceed its peak inside the step, and turn there? From the angles, rates and second
   rates at both ends; counts every contribution twice, so that a wrong no would need derivatives
   that the error control of the step excludes */
static bool may_exceed(double peak, const double angle[2], const double rate[2],
                       const double bend[2], double h) {
    double most = fmax(fabs(bend[0]), fabs(bend[1])) * h;
    bool turns = (rate[0] < 0) != (rate[1] < 0) || rate[0] == 0 || rate[1] == 0 ||
                 fmin(fabs(rate[0]), fabs(rate[1])) < most;
    double reach = fmax(fabs(angle[0]), fabs(angle[1])) + h * (fabs(rate[0]) + fabs(rate[1])) / 2 +
                   h * most / 8;
    return turns && reach > peak;
}

void fw_dynamics_peaks_step(fw_dynamics_peaks *peaks, const fw_multibody_model *m,
                            fw_maths_stepper *s, double theta_end) {
    for (int i = 0; i < peaks->npin; i++) {
        int a = peaks->a[i], b = peaks->b[i], n = m->nq;
        double start = peaks->start[i];
        const turn p = {s, a, b};
        if (a < 0 && b < 0) continue;
        const double value[2] = {start + difference(s->y_old, a, b),
                                 start + difference(s->y, a, b)};
        const double rate[2] = {difference(s->f_old, a, b), difference(s->f, a, b)};
        const double bend[2] = {difference(s->f_old + n, a, b), difference(s->f + n, a, b)};
        if (may_exceed(fabs(peaks->peak[i].angle_rad), value, rate, bend, s->h))
            search(&peaks->peak[i], &p, start, theta_end);
        double last = value[1], slope;
        if (theta_end < 1) along(&p, theta_end, &last, &slope), last += start;
        offer_angle(&peaks->peak[i], last, s->t_old + theta_end * (s->t - s->t_old));
    }
    offer_openings(peaks, theta_end < 1 ? s->y_old : s->y);
}

/* ---- marks ---- */

/* the peaks themselves stay: the whole step finds them at its own places */
static void note(fw_dynamics_peaks *peaks, const fw_multibody_model *m, fw_maths_stepper *s,
                 double t, const double *y) {
    size_t n = (size_t)peaks->npin, row = (size_t)peaks->nmark * n;
    peaks->mark_t[peaks->nmark++] = t;
    for (size_t i = 0; i < n; i++)
        peaks->mark[row + i] = fw_dynamics_peaks_angle(peaks, (int)i, y);
    if (!peaks->sized) return;
    memcpy(peaks->held, peaks->peak, n * sizeof *peaks->held);
    fw_dynamics_peaks_step(peaks, m, s, t < s->t ? (t - s->t_old) / s->h : 1);
    for (size_t i = 0; i < n; i++)
        peaks->size[row + i] = fabs(peaks->peak[i].angle_rad);
    memcpy(peaks->peak, peaks->held, n * sizeof *peaks->held);
}

/* The run that sets the marks takes ends of its steps, where angles cost nothing; the other one
   reads them off its dense output. */
void fw_dynamics_peaks_mark(fw_dynamics_peaks *peaks, const fw_multibody_model *m,
                            fw_maths_stepper *s, double theta_end, double final, double *y) {
    const fw_dynamics_peaks *set = peaks->marked;
    double reached = theta_end < 1 ? s->t_old + theta_end * s->h : s->t;
    if (!set) {
        bool due = peaks->nmark < FW_MARKS && s->t >= final * (peaks->nmark + 1) / FW_MARKS;
        if (due && theta_end == 1) note(peaks, m, s, s->t, s->y);
        return;
    }
    while (peaks->nmark < set->nmark && set->mark_t[peaks->nmark] <= reached) {
        double t = set->mark_t[peaks->nmark];
        if (t < s->t) fw_maths_stepper_dense(s, (t - s->t_old) / s->h, y);
        note(peaks, m, s, t, t < s->t ? y : s->y);
    }
}

int fw_dynamics_peaks_first_mark(const fw_dynamics_peaks *peaks, const fw_dynamics_peaks *other,
                                 double t) {
    int shared = peaks->nmark < other->nmark ? peaks->nmark : other->nmark, k = 0;
    while (k < shared && peaks->mark_t[k] < t)
        k++;
    return k < shared ? k : FW_MARKS;
}

static double apart(const fw_dynamics_peaks *peaks, const fw_dynamics_peaks *other, int k,
                    const double *a, const double *b) {
    double worst = 0;
    if (k >= peaks->nmark || k >= other->nmark) return 0;
    size_t row = (size_t)k * (size_t)peaks->npin;
    for (size_t i = row; i < row + (size_t)peaks->npin; i++)
        worst = fmax(worst, fabs(a[i] - b[i]));
    return worst;
}

double fw_dynamics_peaks_apart(const fw_dynamics_peaks *peaks, const fw_dynamics_peaks *other,
                               int k) {
    return apart(peaks, other, k, peaks->mark, other->mark);
}

double fw_dynamics_peaks_sizes_apart(const fw_dynamics_peaks *peaks, const fw_dynamics_peaks *other,
                                     int k) {
    return apart(peaks, other, k, peaks->size, other->size);
}
