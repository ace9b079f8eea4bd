/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps beside a place where a joint that slips is hardly pressed. Its torque goes with |F|, and F,
   which is smooth in time, passes 0 at a distance: near that place

     |F(t)| = c hypot(t - t0, w),   c = |F'|,  t0 = t - F.F'/c^2,  w = |F x F'|/c^2

   a corner that is rounded over the time w. Its branch points t0 +- i w are the only singular
   points of the motion nearby. The error estimate of a Runge-Kutta step is a weighted sum of its
   stages and vanishes for some places of a corner in the step where the error does not; as steps
   are tried at ever shorter lengths until one is accepted, such places are even looked for, and
   errors of 1000 tolerances pass. So the branch points are located and the length of the step is
   chosen by what they can do:

     |error of the integral of |F|| <= 32/p^2 c h m R^-p
     R = A + sqrt(A^2 - 1),  A = (|z - 1| + |z + 1|)/2,  z = (t0 + i w - middle)/(h/2)
     m = min(h, 2 (w + e)) with t0 in the step, e from its nearer end; min(h, 2 w^2/max(d, w)) with
         t0 at the distance d from it

   for a step of length h of a method of order p: R is the sum of the half axes of the ellipse about
   the step through the branch points, m the size of what no polynomial follows, p^2 stands for the
   number of stages. Times the accelerations of a unit force in units of the tolerance it has to be
   below 0.4. A step may end at t0: a sharp corner (w = 0) costs one step made again or two, a
   rounded one some steps down to w and up again. The sum of these bounds, as displacements, is part
   of the errors that are stated.

   Inputs scaled; methods with error control and without a memory. Cost of a step with joints that
   slip: two right-hand sides, two more where the parabola through the first ones comes near 0;
   without friction none. Error of the bound: for five integrators never below the truth, 5 to 40
   times above it in the median. F is smooth but for what friction adds to it, less than F itself
   where nothing jams. Source: Trefethen, Approximation Theory and Approximation Practice, 2013, ch.
   8 (ellipse); the factors are measured. Test: test_kink.c, test_hard_kink.c. */
#include "dynamics/run.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { PLACES = 5, COARSE = 3, FINE = 32, MOST_TRIES = 12 };
/* ends first, so that the places of the parabola are the first ones */
static const double fw_along[PLACES] = {0, 1, 0.5, 0.25, 0.75};
/* in tolerances: accepted, and aimed at */
static const double fw_accepted = 0.4, fw_aimed = 0.1;
/* scaled times for which an error of a velocity grows: some swings of most of what is slow. What
   becomes of it later shows in the difference of two runs */
static const double fw_swing = 10;

struct fw_dynamics_near_zero {
    int n;
    double *force;                  /* (PLACES x 2 n), then differences */
    double *last;                   /* (2 n) at the end of the last step */
    double *weight;                 /* (n) tolerances per unit of the integral of |F| */
    double *centre, *width, *speed; /* (n) t0, w, c of the branch points next to the last step */
    double *found;                  /* (3 n) those inside it */
    double *most;                   /* (n) largest acceleration per unit of force */
    double *drag;                   /* (n x nq) accelerations of a unit force, amid the step */
    double now;                     /* what the last step may move anything by: scaled velocity */
    double sum[FW_MARKS]; /* displacements by steps that begin in each part of the scene */
    bool known;           /* `last` is that of the state at hand */
    int tries;
};

fw_status fw_dynamics_near_zero_new(fw_dynamics_controller *control) {
    size_t n = (size_t)control->problem->model->nfriction;
    struct fw_dynamics_near_zero *k;
    if (n == 0) return FW_OK;
    FW_NEED(k = fw_arena_one(control->problem->arena, struct fw_dynamics_near_zero));
    k->n = (int)n;
    FW_NEED(k->force = fw_arena_array(control->problem->arena, double, PLACES * 2 * n));
    FW_NEED(k->last = fw_arena_array(control->problem->arena, double, 2 * n));
    FW_NEED(k->weight = fw_arena_array(control->problem->arena, double, n));
    FW_NEED(k->most = fw_arena_array(control->problem->arena, double, n));
    FW_NEED(k->centre = fw_arena_array(control->problem->arena, double, n));
    FW_NEED(k->width = fw_arena_array(control->problem->arena, double, n));
    FW_NEED(k->speed = fw_arena_array(control->problem->arena, double, n));
    FW_NEED(k->found = fw_arena_array(control->problem->arena, double, 3 * n));
    FW_NEED(k->drag = fw_arena_array(control->problem->arena, double,
                                     n *(size_t)control->problem->model->nq));
    control->near_zero = k;
    return FW_OK;
}

void fw_dynamics_near_zero_begin(fw_dynamics_controller *control) {
    fw_dynamics_near_zero_forget(control);
    if (control->near_zero) memset(control->near_zero->sum, 0, sizeof control->near_zero->sum);
}

void fw_dynamics_near_zero_uncertainty(const fw_dynamics_controller *control,
                                       double up_to[FW_MARKS + 1]) {
    up_to[0] = 0;
    for (int k = 0; k < FW_MARKS; k++)
        up_to[k + 1] = up_to[k] + (control->near_zero ? control->near_zero->sum[k] : 0);
}

void fw_dynamics_near_zero_forget(fw_dynamics_controller *control) {
    struct fw_dynamics_near_zero *k = control->near_zero;
    if (!k) return;
    k->known = false;
    k->tries = 0;
    memset(k->speed, 0, (size_t)k->n * sizeof *k->speed);
}

double fw_dynamics_near_zero_error(double start, double end, double centre, double width,
                                   int order) {
    double h = end - start, x = fabs(2 * (centre - start) / h - 1), b = 2 * width / h;
    double a = 0.5 * (hypot(x - 1, b) + hypot(x + 1, b));
    double beyond = 0.5 * h * (x - 1); /* < 0: inside */
    double off = beyond < 0  ? 2 * (width - beyond)
                 : width > 0 ? 2 * width * (width / fmax(beyond, width))
                             : 0;
    return 32.0 / (order * order) * h * fmin(h, off) * pow(a + sqrt(fmax(0, a * a - 1)), -order);
}

/* tolerances by which a step of h from t may be off for the branch points of joint i */
static double uncertainty(const struct fw_dynamics_near_zero *k, const fw_maths_stepper *s, int i,
                          double t, double h) {
    if (!(k->speed[i] > 0)) return 0;
    double error = fw_dynamics_near_zero_error(t, t + h, k->centre[i], k->width[i], s->row->order);
    return k->weight[i] * k->speed[i] * error;
}

static bool idle(const fw_dynamics_controller *control, const fw_maths_stepper *s) {
    return !control->near_zero || s->row->fixed_step || s->row->variable_order;
}

/* the longest step up to h, by halves of its logarithm, with only the aimed uncertainty about
   joint i */
static double longest(const struct fw_dynamics_near_zero *k, const fw_maths_stepper *s, int i,
                      double h) {
    double least = fmax(1e-9 * h, 64 * DBL_EPSILON * fabs(s->t));
    if (uncertainty(k, s, i, s->t, h) <= fw_aimed || least >= h) return h;
    double low = least, high = h;
    while (high > (1 + 1e-9) * low && high - low > 8 * DBL_EPSILON * fabs(s->t)) {
        double middle = sqrt(low * high);
        *(uncertainty(k, s, i, s->t, middle) <= fw_aimed ? &low : &high) = middle;
    }
    return low;
}

void fw_dynamics_near_zero_limit(const fw_dynamics_controller *control, fw_maths_stepper *s) {
    if (idle(control, s)) return;
    for (int i = 0; i < control->near_zero->n; i++)
        s->h_next = longest(control->near_zero, s, i, s->h_next);
}

/* ---- looking at a step ---- */

static void press_at(fw_dynamics_controller *control, fw_maths_stepper *s, double theta,
                     double *force, double *drag) {
    if (theta < 1)
        fw_maths_stepper_dense(s, theta, control->moved);
    else
        memcpy(control->moved, s->y, (size_t)control->problem->model->ny * sizeof *control->moved);
    fw_multibody_friction_pressing(control->problem->system, s->t_old + theta * s->h,
                                   control->moved, force, drag);
}

/* places first .. count - 1 of the step, as divided differences behind those that are there */
static void sample(fw_dynamics_controller *control, fw_maths_stepper *s, int first, int count) {
    struct fw_dynamics_near_zero *k = control->near_zero;
    for (int p = first; p < count; p++) {
        double *f = k->force + (size_t)p * 2 * (size_t)k->n;
        if (p == 0 && k->known)
            memcpy(f, k->last, 2 * (size_t)k->n * sizeof *f);
        else
            press_at(control, s, fw_along[p], f, p + 1 == COARSE ? k->drag : NULL);
        if (p == 1) memcpy(control->near_zero->last, f, 2 * (size_t)k->n * sizeof *f);
        for (int before = 0; before < p; before++)
            for (int c = 0; c < 2 * k->n; c++)
                f[c] = (f[c] - k->force[2 * before * k->n + c]) / (fw_along[p] - fw_along[before]);
    }
}

/* F and dF/dtheta of joint i by Newton's polynomial through `count` places */
static void force_at(const struct fw_dynamics_near_zero *k, int i, int count, double theta,
                     double f[2], double slope[2]) {
    for (int c = 0; c < 2; c++) {
        f[c] = slope[c] = 0;
        for (int p = count - 1; p >= 0; p--) {
            slope[c] = slope[c] * (theta - fw_along[p]) + f[c];
            f[c] = f[c] * (theta - fw_along[p]) + k->force[2 * (p * k->n + i) + c];
        }
    }
}

/* t0, w, c of the branch points that the force at theta points to: the step is their unit;
   returns |F|/c, how far they are from there */
static double branch(const struct fw_dynamics_near_zero *k, int i, int count, double theta,
                     double at[3]) {
    double f[2], g[2];
    force_at(k, i, count, theta, f, g);
    double square = g[0] * g[0] + g[1] * g[1];
    at[0] = at[1] = at[2] = 0;
    if (!(square > DBL_MIN) || !isfinite(square)) return HUGE_VAL;
    at[0] = theta - (f[0] * g[0] + f[1] * g[1]) / square;
    at[1] = fabs(f[0] * g[1] - f[1] * g[0]) / square;
    at[2] = sqrt(square);
    return hypot(f[0], f[1]) / at[2];
}

/* the ones nearest to the step */
static double nearest(const struct fw_dynamics_near_zero *k, int i, int count, double at[3]) {
    double least = HUGE_VAL, other[3];
    at[0] = at[1] = at[2] = 0; /* gcc -O3 does not see that without a corner nobody reads it */
    for (int p = 0; p <= FINE; p++) {
        double how = branch(k, i, count, (double)p / FINE, other);
        if (how < least) least = how, memcpy(at, other, sizeof other);
    }
    for (int p = 0; p < 3 && least < HUGE_VAL && at[0] > 0 && at[0] < 1; p++) {
        double how = branch(k, i, count, at[0], other);
        if (!(how < HUGE_VAL)) break;
        least = how, memcpy(at, other, sizeof other);
    }
    return least;
}

/* from units of the step to those of the model */
static void take(struct fw_dynamics_near_zero *k, int i, const fw_maths_stepper *s,
                 const double at[3]) {
    k->centre[i] = s->t_old + at[0] * s->h;
    k->width[i] = at[1] * s->h;
    k->speed[i] = at[2] / s->h;
}

/* can a parabola rule it out? A third of the distance that it has covers what it does not follow */
static bool far(const struct fw_dynamics_near_zero *k, const fw_maths_stepper *s, int i) {
    double at[3], how = nearest(k, i, COARSE, at);
    if (!(how < HUGE_VAL)) return true;
    double error = fw_dynamics_near_zero_error(-0.5, 0.5, 0, how / 3, s->row->order);
    return k->weight[i] * at[2] * s->h * error <= 0.01 * fw_accepted;
}

/* accelerations of a unit force that presses joint i: the largest, and by the norm of
   fw_maths_ode_norm, in tolerances per unit of time */
static void weigh(fw_dynamics_controller *control, const fw_maths_stepper *s, int i) {
    const int nq = control->problem->model->nq;
    const double *drag = control->near_zero->drag + (size_t)i * (size_t)nq;
    double sum = 0;
    control->near_zero->most[i] = 0;
    for (int c = 0; c < nq; c++) {
        double x = drag[c] / (s->atol[nq + c] + s->rtol * fabs(s->y[nq + c]));
        sum += x * x;
        control->near_zero->most[i] = fmax(control->near_zero->most[i], fabs(drag[c]));
    }
    control->near_zero->weight[i] = sqrt(sum / s->ode.controlled);
}

/* looks at the last step; the branch points that its end points to stay for the next one. True:
   shorter is needed, and where the limit for that is is known */
static bool unsafe(fw_dynamics_controller *control, fw_maths_stepper *s) {
    struct fw_dynamics_near_zero *k = control->near_zero;
    bool all_far = true, bad = false;
    k->now = 0;
    sample(control, s, 0, COARSE);
    for (int i = 0; i < k->n; i++) {
        weigh(control, s, i);
        all_far = all_far && far(k, s, i);
    }
    int count = all_far ? COARSE : PLACES;
    sample(control, s, COARSE, count);
    for (int i = 0; i < k->n && !all_far; i++) {
        nearest(k, i, count, k->found + 3 * i);
        take(k, i, s, k->found + 3 * i);
        double off = uncertainty(k, s, i, s->t_old, s->h);
        bad = bad || off > fw_accepted;
        if (off > 0) k->now += off * k->most[i] / k->weight[i];
    }
    for (int i = 0; i < k->n && !bad; i++) {
        double at[3];
        branch(k, i, count, 1, at);
        take(k, i, s, at);
    }
    return bad;
}

static void add(fw_dynamics_controller *control, double t) {
    struct fw_dynamics_near_zero *k = control->near_zero;
    double final = fw_dynamics_end(control->problem);
    int part = (int)(FW_MARKS * t / final);
    k->sum[part < FW_MARKS ? part : FW_MARKS - 1] += k->now * fmin(fw_swing, final - t);
}

bool fw_dynamics_near_zero_again(fw_dynamics_controller *control, fw_maths_stepper *s) {
    struct fw_dynamics_near_zero *k = control->near_zero;
    if (idle(control, s) || !fw_multibody_friction_slips(control->problem->system)) return false;
    double h = s->h;
    bool again = unsafe(control, s) && ++k->tries <= MOST_TRIES;
    k->known = true;
    if (!again) {
        k->tries = 0;
        add(control, s->t_old);
        return false;
    }
    memcpy(k->last, k->force, 2 * (size_t)k->n * sizeof *k->last); /* at its start */
    memcpy(control->moved, s->y_old, (size_t)control->problem->model->ny * sizeof *control->moved);
    fw_dynamics_run_start(control, s, s->t_old, control->moved, s->t_end);
    s->h_next = fmin(h, s->t_end - s->t);
    return true; /* the loop limits it */
}
