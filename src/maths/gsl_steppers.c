/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Four steppers of the GNU Scientific Library (odeiv2) behind the interface; the step control is
   here, with GSL's rules but the project's norm: h is divided by err^(1/p)/0.9 when err > 1 and
   multiplied by 0.9/err^(1/(p+1)) when err < 1/2, by 5 at most.

   gsl-msadams remembers earlier steps. A projection would contradict that memory, so the remembered
   solution z goes on unprojected and f is evaluated at z + d, d the sum of all corrections: this is
   the method applied to the projected states with the earlier slopes kept, which leaves its order
   (Eich, SIAM J. Numer. Anal. 30 (1993)); no restart is needed.

   gsl-bsimp refuses steps in which any component changes by many times its own value. It is given
   y + d with d = +-atol/rtol, so that values passing zero are measured against their size.

   Dense output: Hermite pieces. Steps of high order are long against what one polynomial from both
   ends can follow, so `prepare` computes as many states inside the step, by shorter steps from its
   start (gsl-msadams: of gsl-rk8pd), as the deviation in the middle asks for, at most 64.

   Memory: GSL takes it from malloc, in create, and gives it back in destroy. After that only
   gsl-bsimp allocates: GSL's LU takes and returns one small block per factorisation. GSL does not
   check every allocation in the creation of bsimp and in that LU.
   Source: GSL reference manual, chapter Ordinary Differential Equations. Tests: test_ode_*.c */
#include "maths/functions.h"
#include "maths/ode.h"
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

enum { PIECES = 64 };

typedef struct stepper {
    fw_maths_stepper base;
    gsl_odeiv2_step *gsl, *inside; /* inside: for dense output; the same when it has no memory */
    gsl_odeiv2_system system;
    gsl_odeiv2_control control; /* not GSL's own: gives error levels to msadams, lives here */
    gsl_odeiv2_driver driver;   /* ditto, carries the control */
    bool history, extrapolates; /* msadams; bsimp */
    bool shifted;               /* GSL works with z = y - offset */
    bool nan;                   /* f was not finite in this step */
    double *y_new, *f_new, *e;  /* (padded) */
    double *at, *moved;         /* (padded) z + offset, in function and in jacobian */
    double *offset;             /* (padded) */
    double *j, *work;           /* bsimp: (n x controlled), (2 padded) */
    double *node;               /* (2 (PIECES + 1) padded) y and f at the ends of the pieces */
    int pieces;
} stepper;

static int function(double t, const double *y, double *f, void *context) {
    stepper *s = context;
    fw_maths_stepper *b = &s->base;
    if (s->shifted) {
        for (int c = 0; c < b->ode.n; c++)
            s->at[c] = y[c] + s->offset[c];
        y = s->at;
    }
    fw_maths_ode_evaluate(b, t, y, f);
    bool good = fw_maths_ode_finite(f, b->ode.n);
    if (!good) s->nan = true;
    return good ? GSL_SUCCESS : GSL_FAILURE;
}

/* J (n x n, columns of quadratures zero) and f_t by differences */
static int jacobian(double t, const double *y, double *dfdy, double *dfdt, void *context) {
    stepper *s = context;
    fw_maths_stepper *b = &s->base;
    size_t n = (size_t)b->ode.n, columns = (size_t)b->ode.controlled;
    double *f = s->at, d = sqrt(DBL_EPSILON) * fmax(fabs(t), fmin(b->h_next, b->t_end - b->t));
    double later = t + d, *moved = s->moved;
    for (size_t i = 0; i < n; i++)
        moved[i] = y[i] + s->offset[i];
    y = moved;
    fw_maths_ode_evaluate(b, t, y, f);
    if (!fw_maths_ode_jacobian(b, t, y, f, s->j, s->work)) {
        s->nan = true;
        return GSL_FAILURE;
    }
    fw_maths_ode_evaluate(b, later, y, dfdt);
    for (size_t i = 0; i < n; i++) {
        dfdt[i] = (dfdt[i] - f[i]) / (later - t);
        for (size_t k = 0; k < n; k++)
            dfdy[i * n + k] = k < columns ? s->j[i * columns + k] : 0;
    }
    bool good = fw_maths_ode_finite(dfdt, b->ode.n);
    if (!good) s->nan = true;
    return good ? GSL_SUCCESS : GSL_FAILURE;
}

static int error_level(void *context, double y, double dydt, double h, size_t i, double *level) {
    const fw_maths_stepper *b = context;
    (void)dydt;
    (void)h;
    *level = b->tolerance[i] + b->rtol * fabs(y);
    return GSL_SUCCESS;
}

static const gsl_odeiv2_control_type control_type = {.name = "flexwright", .errlevel = error_level};

static void destroy(fw_maths_stepper *b) {
    stepper *s = (stepper *)b;
    if (s->inside && s->inside != s->gsl) gsl_odeiv2_step_free(s->inside);
    if (s->gsl) gsl_odeiv2_step_free(s->gsl);
    s->gsl = s->inside = NULL;
}

static fw_status create(fw_arena *arena, const fw_maths_ode *ode, const gsl_odeiv2_step_type *type,
                        fw_maths_stepper **out) {
    size_t n = (size_t)ode->n, width = (size_t)fw_maths_ode_padded(ode->n);
    stepper *s = fw_arena_one(arena, stepper);
    FW_NEED(s);
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->e = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->at = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->moved = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->offset = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->work = fw_maths_ode_vector(arena, 2 * fw_maths_ode_padded(ode->n)));
    FW_NEED(s->node = fw_arena_array(arena, double, 2 * (PIECES + 1) * width));
    if (type == gsl_odeiv2_step_bsimp)
        FW_NEED(s->j = fw_arena_array(arena, double, n *(size_t)ode->controlled));
    fw_maths_gsl_quiet();
    s->history = type == gsl_odeiv2_step_msadams;
    s->extrapolates = type == gsl_odeiv2_step_bsimp;
    s->system = (gsl_odeiv2_system){function, jacobian, n, s};
    s->control = (gsl_odeiv2_control){&control_type, s};
    s->driver.c = &s->control;
    FW_NEED(s->gsl = gsl_odeiv2_step_alloc(type, n));
    s->inside = s->history ? gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, n) : s->gsl;
    if (!s->inside) {
        destroy(&s->base);
        return FW_NOMEM;
    }
    gsl_odeiv2_step_set_driver(s->gsl, &s->driver);
    *out = &s->base;
    return FW_OK;
}

static void start(fw_maths_stepper *b) {
    stepper *s = (stepper *)b;
    memset(s->offset, 0, (size_t)b->padded * sizeof(double));
    gsl_odeiv2_step_reset(s->gsl);
    s->shifted = false;
    b->h_next = fw_maths_ode_first_step(b, s->history ? 1 : b->row->order, s->work);
}

/* one step of GSL from y in place, seen from outside without offsets; e: its error; false: it
 * failed */
static bool apply(stepper *s, gsl_odeiv2_step *gsl, double t, double h, double *y,
                  const double *f) {
    fw_maths_stepper *b = &s->base;
    s->shifted = s->extrapolates || (s->history && gsl == s->gsl);
    for (int c = 0; s->extrapolates && c < b->ode.n; c++) {
        double size = b->atol[c] > 0 ? b->atol[c] / b->rtol : 1;
        s->offset[c] = y[c] < 0 ? size : -size;
    }
    for (int c = 0; s->shifted && c < b->ode.n; c++)
        y[c] -= s->offset[c];
    int status = gsl_odeiv2_step_apply(gsl, t, h, y, s->e, f, NULL, &s->system);
    for (int c = 0; s->shifted && c < b->ode.n; c++)
        y[c] += s->offset[c];
    s->shifted = false;
    return status == GSL_SUCCESS && fw_maths_ode_finite(y, b->ode.n) &&
           fw_maths_ode_finite(s->e, b->ode.n);
}

/* projection and f at the new state; what it moved is remembered for msadams */
static bool finish(stepper *s, double t_new) {
    fw_maths_stepper *b = &s->base;
    memcpy(s->at, s->y_new, (size_t)b->ode.n * sizeof(double));
    if (!fw_maths_ode_finish(b, t_new, s->y_new, s->f_new)) {
        if (!fw_maths_ode_finite(s->f_new, b->ode.n)) s->nan = true;
        return false;
    }
    for (int c = 0; s->history && b->ode.project && c < b->ode.n; c++)
        s->offset[c] += s->y_new[c] - s->at[c];
    return true;
}

static fw_maths_ode_result step(fw_maths_stepper *b) {
    stepper *s = (stepper *)b;
    double h = fmin(b->h_next, b->h_max);
    for (int tries = 0;;) {
        double t_new = fw_maths_ode_target(b, &h), err = (double)INFINITY;
        s->nan = false;
        memcpy(s->y_new, b->y, (size_t)b->ode.n * sizeof(double));
        bool good = apply(s, s->gsl, b->t, h, s->y_new, b->f);
        double order = gsl_odeiv2_step_order(s->gsl);
        if (good) err = fw_maths_ode_norm(b, s->e, b->y, s->y_new);
        if (err <= 1 && finish(s, t_new)) {
            fw_maths_ode_accept(b, t_new, &s->y_new, &s->f_new);
            double grow = 0.9 * pow(fmax(err, DBL_EPSILON), -1 / (order + 1));
            b->h_next = err < 0.5 ? h * fmin(5, fmax(1, grow)) : h;
            return FW_ODE_STEP;
        }
        bool large = err > 1 && isfinite(err);
        h *= large ? fmax(0.2, 0.9 * pow(err, -1 / order)) : 0.5;
        if (!fw_maths_ode_retry(b, h, &tries)) return s->nan ? FW_ODE_NAN : FW_ODE_SMALL;
    }
}

/* ---- dense output ---- */

static double *node_y(const stepper *s, int i) {
    return s->node + (size_t)(2 * i) * (size_t)s->base.padded;
}
static double *node_f(const stepper *s, int i) {
    return s->node + (size_t)(2 * i + 1) * (size_t)s->base.padded;
}

/* states at the ends of m equal pieces. The short steps end elsewhere than the step itself by its
   error: the difference is spread evenly, else the last piece would have all of it. false: failed
 */
static bool inner_states(stepper *s, int m) {
    fw_maths_stepper *b = &s->base;
    size_t bytes = (size_t)b->ode.n * sizeof(double);
    memcpy(node_y(s, 0), b->y_old, bytes);
    memcpy(node_f(s, 0), b->f_old, bytes);
    for (int i = 1; i <= m; i++) {
        double *y = node_y(s, i), h = b->h / m, t = b->t_old + (i - 1) * h;
        memcpy(y, node_y(s, i - 1), bytes);
        if (!apply(s, s->inside, t, h, y, node_f(s, i - 1))) return false;
        if (i < m) fw_maths_ode_evaluate(b, t + h, y, node_f(s, i));
        if (i < m && !fw_maths_ode_finite(node_f(s, i), b->ode.n)) return false;
    }
    for (int c = 0; c < b->ode.n; c++) {
        double miss = b->y[c] - node_y(s, m)[c];
        for (int i = 1; i < m; i++)
            node_y(s, i)[c] += miss * i / m;
    }
    return true;
}

static void prepare(fw_maths_stepper *b) {
    stepper *s = (stepper *)b;
    size_t bytes = (size_t)b->ode.n * sizeof(double);
    const fw_maths_ode_span span = {b->h, b->y_old, b->f_old, b->y, b->f, true};
    double miss = 0, middle, slope;
    s->pieces = 1;
    bool good = inner_states(s, 2);
    for (int c = 0; good && c < b->ode.n; c++) {
        fw_maths_ode_span_value(&b->ode, &span, c, 0.5, &middle, &slope);
        s->e[c] = middle - node_y(s, 1)[c];
    }
    if (good) miss = fw_maths_ode_norm(b, s->e, b->y_old, b->y);
    /* with every halving the error of the cubic falls by 16 */
    for (; s->pieces < PIECES && miss > 0.1; miss /= 16)
        s->pieces *= 2;
    if (s->pieces > 2 && !inner_states(s, s->pieces)) s->pieces = 1;
    memcpy(node_y(s, 0), b->y_old, bytes);
    memcpy(node_f(s, 0), b->f_old, bytes);
    memcpy(node_y(s, s->pieces), b->y, bytes);
    memcpy(node_f(s, s->pieces), b->f, bytes);
}

static fw_maths_ode_span piece(const fw_maths_stepper *b, double *theta) {
    const stepper *s = (const stepper *)b;
    int i = (int)fmin(s->pieces - 1, fmax(0, floor(*theta * s->pieces)));
    *theta = *theta * s->pieces - i;
    return (fw_maths_ode_span){b->h / s->pieces, node_y(s, i),     node_f(s, i),
                               node_y(s, i + 1), node_f(s, i + 1), true};
}

static void dense(const fw_maths_stepper *b, double theta, double *y) {
    const fw_maths_ode_span span = piece(b, &theta);
    double slope;
    for (int c = 0; c < b->ode.n; c++)
        fw_maths_ode_span_value(&b->ode, &span, c, theta, &y[c], &slope);
}

static void component(const fw_maths_stepper *b, int i, double wi, int j, double wj, double theta,
                      double *value, double *slope) {
    const fw_maths_ode_span span = piece(b, &theta);
    double p = 0, d = 0;
    fw_maths_ode_span_value(&b->ode, &span, i, theta, value, slope);
    if (j >= 0) fw_maths_ode_span_value(&b->ode, &span, j, theta, &p, &d);
    *value = wi * *value + wj * p;
    *slope = (wi * *slope + wj * d) * ((const stepper *)b)->pieces;
}

/* ---- rows ---- */

#define ROW(NAME, ...)                                                                             \
    static fw_status create_##NAME(fw_arena *arena, const fw_maths_ode *ode,                       \
                                   fw_maths_stepper **s) {                                         \
        return create(arena, ode, gsl_odeiv2_step_##NAME, s);                                      \
    }                                                                                              \
    const fw_maths_stepper_row fw_maths_gsl_##NAME##_row = {.create = create_##NAME,               \
                                                            .start = start,                        \
                                                            .step = step,                          \
                                                            .prepare = prepare,                    \
                                                            .dense = dense,                        \
                                                            .component = component,                \
                                                            .destroy = destroy,                    \
                                                            .dense_order = 3,                      \
                                                            .dense_order_u = 5,                    \
                                                            .dense_parts = PIECES,                 \
                                                            __VA_ARGS__}

ROW(rkf45, .name = "gsl-rkf45", .summary = "GSL's Runge-Kutta-Fehlberg 4(5)", .order = 5);
ROW(rk8pd, .name = "gsl-rk8pd", .summary = "GSL's Runge-Kutta Prince-Dormand 8(9)", .order = 8);
ROW(msadams, .name = "gsl-msadams",
    .summary = "GSL's Adams multistep method of order 1 to 12: few evaluations per step",
    .order = 12, .variable_order = true);
ROW(bsimp, .name = "gsl-bsimp",
    .summary = "GSL's semi-implicit extrapolation of Bader and Deuflhard", .order = 12,
    .implicit = true, .variable_order = true,
    /* a Jacobian by differences and many small steps in each of its own */
    .rhs_per_count = 5, .rhs_per_step = 1000);
