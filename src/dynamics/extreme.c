/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Extremes along the dense output: of angles of pins and displacements of flexures that give, then of joint forces,
   torques and travels. */
#include "base/constants.h"
#include "dynamics/run.h"
#include "maths/functions.h"
#include "multibody/system.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- peaks of angles and displacements ---- */

/* Largest angles of the pins: extremes inside of steps by the dense output, and the marks at which
   two runs are compared. And how far the ends of flexures that give are displaced: over the strip's
   length that counts as an angle does, so that a stage on leaves, which moves and hardly turns any,
   has a deflection that errors of angles are relative to. Errors of the displacement itself show in
   the joint forces and in the strains. Test: test_peak.c. */

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

/* ---- forces, torques and travels ---- */

/* Extremes of joint forces, of the torques of joints and drivers, and of travels, along the dense
   output. Each is one channel: forces of pins, then forces, torques and travels of joints, then
   drivers. */

enum { GRID = FW_GRID };
typedef enum measure { FORCE, TORQUE, TRAVEL } measure;

int fw_dynamics_run_channels(const fw_dynamics_problem *problem) {
    const fw_mechanism *m = problem->mechanism;
    return m->npin + 3 * m->njoint + m->ndriver;
}

fw_status fw_dynamics_run_extremes_new(fw_dynamics_recorder *record) {
    const fw_mechanism *from = record->problem->mechanism;
    size_t pins = (size_t)from->npin, joints = (size_t)from->njoint,
           drivers = (size_t)from->ndriver;
    size_t channels = (size_t)fw_dynamics_run_channels(record->problem);
    fw_dynamics_motion *m = record->motion;
    FW_NEED(record->channel_now = fw_arena_array(record->problem->arena, double, channels));
    FW_NEED(record->channel_grid =
                fw_arena_array(record->problem->arena, double, (GRID + 1) * channels));
    FW_NEED(record->pin_now = fw_arena_array(record->problem->arena, double, 2 * pins));
    FW_NEED(record->joint_now = fw_arena_array(record->problem->arena, double, 3 * joints));
    FW_NEED(m->force_peak = fw_arena_array(record->problem->arena, fw_dynamics_force_peak, pins));
    FW_NEED(m->joint_peak = fw_arena_array(record->problem->arena, fw_dynamics_force_peak, joints));
    FW_NEED(m->driver_peak =
                fw_arena_array(record->problem->arena, fw_dynamics_force_peak, drivers));
    FW_NEED(m->travel_peak =
                fw_arena_array(record->problem->arena, fw_dynamics_travel_peak, joints));
    return FW_OK;
}

/* ---- along a step ---- */

/* all channels at theta; distances of prismatic joints are those of the state as integrated */
static void channels_at(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta) {
    const fw_multibody_model *m = record->problem->model;
    fw_multibody_system *sys = record->problem->system;
    const fw_mechanism *from = record->problem->mechanism;
    fw_maths_stepper_dense(s, theta, record->state);
    const double t = s->t_old + theta * s->h;
    const fw_multibody_solution *found = fw_multibody_react(sys, t, record->state, record->rate);
    double *force = record->channel_now, *torque = force + m->npin + m->njoint,
           *travel = torque + m->njoint;
    fw_multibody_pin_forces(m, found, record->pin_now);
    fw_multibody_joint_forces(m, found, from, record->joint_now, travel + m->njoint);
    for (int i = 0; i < m->npin; i++)
        force[i] = hypot(record->pin_now[2 * i], record->pin_now[2 * i + 1]);
    for (int i = 0; i < m->njoint; i++) {
        double d[2], e[2], n[2];
        force[m->npin + i] = hypot(record->joint_now[3 * i], record->joint_now[3 * i + 1]);
        torque[i] = from->joint[i].kind == FW_JOINT_DISTANCE ? 0 : record->joint_now[3 * i + 2];
        travel[i] = 0;
        if (from->joint[i].kind != FW_JOINT_PRISMATIC) continue;
        fw_multibody_frame(m, found->pose, m->joint_block[i], d, e, n);
        travel[i] = (e[0] * d[0] + e[1] * d[1]) * m->scale.length_m - from->joint[i].free_length_m;
    }
}

static void offer(fw_dynamics_extreme *extreme, double value, double t) {
    if (fabs(value) > fabs(extreme->value)) extreme->value = value, extreme->t = t;
}

/* Chebyshev-Lobatto points of the way to theta_end: a polynomial through values there does not
   swing. Where a method's interpolated states would be multiplied with large stiffnesses, its own
   ones: the polynomial is then one of forces, which are smooth. */
void fw_dynamics_run_places(const fw_maths_stepper *s, double theta_end, fw_dynamics_grid *g) {
    double own[FW_ODE_OWN];
    int count = s->row->own ? s->row->own(s, own) : 0;
    g->last = count > 0 ? 0 : GRID;
    g->at[0] = 0;
    for (int k = 0; k <= GRID && count == 0; k++) {
        g->at[k] = 0.5 - 0.5 * cos(FW_PI * k / GRID);
        g->weight[k] = (k % 2 ? -1.0 : 1.0) * (k % GRID ? 1 : 0.5);
    }
    if (count == 0) return;
    for (int k = 0; k < count; k++) /* before an event */
        if (own[k] < 0.99 * theta_end) g->at[++g->last] = own[k] / theta_end;
    g->at[++g->last] = 1;
    for (int k = 0; k <= g->last; k++) {
        g->weight[k] = 1;
        for (int i = 0; i <= g->last; i++)
            if (i != k) g->weight[k] /= g->at[k] - g->at[i];
    }
}

/* the polynomial through one channel at the places (a column of values), by the barycentric
   formula; its error at nine places in a step of one radian is some 1e-10. Source: Berrut and
   Trefethen 2004. */
double fw_dynamics_run_between(const fw_dynamics_grid *g, const double *column, int stride,
                               double x) {
    double above = 0, below = 0;
    for (int k = 0; k <= g->last; k++) {
        double distance = x - g->at[k];
        if (distance == 0) return column[k * stride];
        above += g->weight[k] / distance * column[k * stride];
        below += g->weight[k] / distance;
    }
    return above / below;
}

/* extreme of that polynomial between two places, by golden section; evaluates nothing else */
static double highest(const fw_dynamics_grid *g, const double *column, int stride, double a,
                      double b, double *at) {
    const double golden = 0.6180339887498949;
    double x = b - golden * (b - a), y = a + golden * (b - a);
    double fx = fw_dynamics_run_between(g, column, stride, x),
           fy = fw_dynamics_run_between(g, column, stride, y);
    for (int i = 0; i < 40 && b - a > 1e-8; i++) {
        if (fabs(fx) > fabs(fy)) {
            b = y, y = x, fy = fx, x = b - golden * (b - a);
            fx = fw_dynamics_run_between(g, column, stride, x);
        } else {
            a = x, x = y, fx = fy, y = a + golden * (b - a);
            fy = fw_dynamics_run_between(g, column, stride, y);
        }
    }
    bool first = fabs(fx) > fabs(fy);
    *at = first ? x : y;
    return first ? fx : fy;
}

/* cells [*low, *high] around the largest of the places, if they may hide a larger one: next to an
   end of the step the polynomial must rise inwards. A parabola rises above the middle of three
   places by less than its bend. */
static bool worth_a_search(const fw_dynamics_grid *g, const double *column, int count, int best,
                           double so_far, int *low, int *high) {
    int inwards = best == 0 ? 1 : best == g->last ? -1 : 0, middle = best + inwards;
    double f[3], top = fabs(column[best * count]);
    if (g->last < 2) return false;
    for (int k = -1; k <= 1; k++)
        f[k + 1] = fabs(column[(middle + k) * count]);
    double bend = fabs(f[0] - 2 * f[1] + f[2]), near = 0.75 * g->at[best] + 0.25 * g->at[middle];
    *low = best > 0 ? best - 1 : 0, *high = best < g->last ? best + 1 : g->last;
    if (!(bend > 0 && top + bend >= so_far)) return false;
    return !inwards || fabs(fw_dynamics_run_between(g, column, count, near)) > top;
}

/* every channel at the places of the step; where the largest of them comes near the extreme so
   far, its maximum is searched. Cost up to nine evaluations per step, whatever the number of
   joints. */
void fw_dynamics_run_extremes(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta_end) {
    if (!record->extreme) return;
    int count = fw_dynamics_run_channels(record->problem), low, high;
    double *value = record->channel_grid, span = theta_end * s->h, at;
    fw_dynamics_grid g;
    fw_dynamics_run_places(s, theta_end, &g);
    for (int k = 0; k <= g.last; k++) {
        channels_at(record, s, theta_end * g.at[k]);
        for (int i = 0; i < count; i++)
            value[k * count + i] = record->channel_now[i];
    }
    for (int i = 0; i < count; i++) {
        int best = 0;
        for (int k = 1; k <= g.last; k++)
            if (fabs(value[k * count + i]) > fabs(value[best * count + i])) best = k;
        offer(&record->extreme[i], value[best * count + i], s->t_old + g.at[best] * span);
        if (worth_a_search(&g, value + i, count, best, fabs(record->extreme[i].value), &low,
                           &high)) {
            double top = highest(&g, value + i, count, g.at[low], g.at[high], &at);
            offer(&record->extreme[i], top, s->t_old + at * span);
        }
        record->extreme[i].end = value[g.last * count + i];
    }
}

/* ---- results ---- */

static measure measure_of(const fw_mechanism *m, int channel) {
    if (channel < m->npin + m->njoint) return FORCE;
    if (channel < m->npin + 2 * m->njoint) return TORQUE;
    if (channel < m->npin + 3 * m->njoint) return TRAVEL;
    return m->driver[channel - m->npin - 3 * m->njoint].revolute != FW_NONE ? TORQUE : FORCE;
}

static void put_force(fw_dynamics_force_peak *to, const fw_dynamics_extreme *from, measure kind,
                      double unit, double error) {
    if (kind == FORCE)
        to->force_N = fabs(from->value), to->t_s = from->t * unit, to->error_N = error;
    else
        to->torque_Nm = fabs(from->value), to->torque_t_s = from->t * unit,
        to->torque_error_Nm = error;
}

static bool is_driven(const fw_mechanism *m, int joint) {
    for (int i = 0; i < m->ndriver; i++)
        if (m->driver[i].joint == joint) return true;
    return false;
}

/* error of each: the largest change of any of its kind from the looser run, at the end too, since
   one number may agree by chance; what the energy balance is off by; and round-off. As for the
   angles in dynamics_simulate.c. */
void fw_dynamics_run_take_extremes(fw_dynamics_recorder *record, double margin,
                                   const fw_dynamics_extreme *fine,
                                   const fw_dynamics_extreme *coarse, double uncertainty,
                                   long steps) {
    const fw_mechanism *m = record->problem->mechanism;
    fw_dynamics_motion *out = record->motion;
    const double length = record->problem->model->scale.length_m,
                 newton = fw_multibody_newton(record->problem->model);
    const double unit_of[3] = {newton, newton * length, length}; /* FORCE, TORQUE, TRAVEL */
    double change[3] = {0}, unit = record->problem->model->scale.time_s;
    out->travelled_m = out->travel_off_m = 0;
    for (int i = 0; i < fw_dynamics_run_channels(record->problem); i++) {
        double *most = &change[measure_of(m, i)];
        *most = fmax(*most, fabs(fabs(fine[i].value) - fabs(coarse[i].value)));
        *most = fmax(*most, fabs(fine[i].end - coarse[i].end));
    }
    for (int i = 0; i < fw_dynamics_run_channels(record->problem); i++) {
        measure kind = measure_of(m, i);
        double energy_balance = out->stats.energy_error + DBL_EPSILON * (double)(8 + steps);
        double error = margin * change[kind] + energy_balance * fabs(fine[i].value) +
                       uncertainty * unit_of[kind];
        if (i < m->npin)
            put_force(&out->force_peak[i], &fine[i], kind, unit, error);
        else if (i >= m->npin + 3 * m->njoint)
            put_force(&out->driver_peak[i - m->npin - 3 * m->njoint], &fine[i], kind, unit, error);
        else if (kind != TRAVEL) {
            bool none = kind == TORQUE && fine[i].value == 0;
            put_force(&out->joint_peak[(i - m->npin) % m->njoint], &fine[i], kind, unit,
                      none ? 0 : error);
        } else if (m->joint[(i - m->npin) % m->njoint].kind == FW_JOINT_PRISMATIC) {
            const int joint = (i - m->npin) % m->njoint;
            out->travel_peak[joint] =
                (fw_dynamics_travel_peak){fine[i].value, fine[i].t * unit, error};
            if (is_driven(m, joint)) continue;
            out->travelled_m = fmax(out->travelled_m, fabs(fine[i].value));
            out->travel_off_m = fmax(out->travel_off_m, error);
        }
    }
}

static double largest_deflection(const fw_dynamics_motion *motion) {
    double angle = motion->displaced;
    for (int i = 0; i < motion->npin; i++)
        angle = fmax(angle, fabs(motion->peak[i].angle_rad));
    return angle;
}

double fw_dynamics_motion_travel_off(const fw_dynamics_motion *motion) {
    return largest_deflection(motion) > 0 ? 0 : motion->travel_off_m;
}

/* relative to what no driver states */
static double travels_estimated(const fw_dynamics_motion *motion) {
    const double off = fw_dynamics_motion_travel_off(motion);
    return off > 0 && motion->travelled_m > 0 ? off / motion->travelled_m : 0;
}

static void widen(const fw_dynamics_force_peak *p, int count, double most[3], double off[3]) {
    for (int i = 0; i < count; i++) {
        most[FORCE] = fmax(most[FORCE], p[i].force_N);
        most[TORQUE] = fmax(most[TORQUE], p[i].torque_Nm);
        off[FORCE] = fmax(off[FORCE], p[i].error_N);
        off[TORQUE] = fmax(off[TORQUE], p[i].torque_error_Nm);
    }
}

/* torques that are small beside force times the scene's length count with those, and the reverse */
double fw_dynamics_run_extremes_off(const fw_dynamics_recorder *record) {
    const fw_dynamics_motion *m = record->motion;
    double most[3] = {0}, off[3] = {0}, length = record->problem->model->scale.length_m;
    widen(m->force_peak, m->npin, most, off);
    widen(m->joint_peak, m->njoint, most, off);
    widen(m->driver_peak, m->ndriver, most, off);
    for (int i = 0; i < m->njoint; i++) {
        most[TRAVEL] = fmax(most[TRAVEL], fabs(m->travel_peak[i].travel_m));
        off[TRAVEL] = fmax(off[TRAVEL], m->travel_peak[i].error_m);
    }
    double force = fmax(most[FORCE], most[TORQUE] / length);
    double worst = 0;
    if (off[FORCE] > 0) worst = off[FORCE] / force;
    if (off[TORQUE] > 0) worst = fmax(worst, off[TORQUE] / (force * length));
    if (off[TRAVEL] > 0) worst = fmax(worst, off[TRAVEL] / most[TRAVEL]);
    return fmax(worst, travels_estimated(m));
}

/* The bounds are relative to the largest deflection of any hinge with nothing left out, which is at
   least 1 - their sum of the one seen here. What no motion has and is bounded alone adds to that. */
double fw_dynamics_motion_left_out(const fw_dynamics_motion *motion) {
    double largest = 0, out = motion->ledger.left_out + motion->ledger.beside;
    for (int i = 0; i < motion->npin; i++)
        largest = fmax(largest, fabs(motion->peak[i].angle_rad));
    return out < 1 ? out / (1 - out) * largest + motion->ledger.beside_rad : HUGE_VAL;
}

/* Of a device that heat only presses, since it is its own mirror image, angles are rounding, and nothing is a share of them:
   what its forces are off by their probes see themselves */
double fw_dynamics_motion_estimated(const fw_dynamics_motion *motion) {
    const double rounding_rad = 1e-9;
    double angle = largest_deflection(motion), error = 0;
    for (int i = 0; i < motion->npin; i++)
        error = fmax(error, motion->peak[i].error_rad);
    if (angle > rounding_rad || (angle > 0 && isinf(error))) return error / angle;
    return travels_estimated(motion);
}

/* What no motion has is a share of every way, also where flexures bend without turning, so that errors of angles have next to
   none of it. What a formula lacks (fw_effect_row.lacking) is put to bands of requirements by itself. */
double fw_dynamics_motion_ways_off(const fw_dynamics_motion *motion, bool lacking) {
    const double lacks = lacking ? 0 : motion->ledger.lacking_share,
                 aside = fmax(motion->ledger.beside - lacks / (1 + lacks), 0);
    return fmax(fw_dynamics_motion_estimated(motion), aside < 1 ? aside / (1 - aside) : HUGE_VAL);
}

void fw_dynamics_motion_widen(fw_dynamics_motion *motion) {
    double more = fw_dynamics_motion_left_out(motion);
    for (int i = 0; i < motion->npin; i++)
        motion->peak[i].error_rad += more;
}
