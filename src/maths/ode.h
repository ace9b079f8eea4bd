/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrators of y' = f(t, y) behind one interface: one file and one line in integrators.def each.
   All of them keep the last step and can be asked for any time in it (dense output), move every
   accepted state onto a manifold when the problem has one, end exactly at t_end, and allocate
   nothing after fw_maths_stepper_new. */
#ifndef FW_MATHS_ODE_H
#define FW_MATHS_ODE_H
#include "base/arena.h"
#include "base/status.h"
#include <stdbool.h>
#include <stddef.h>

typedef struct fw_maths_ode { /* the problem */
    void *context;
    void (*rhs)(void *context, double t, const double *y, double *f);
    /* moves y (n) onto the manifold and sets f = f(t, y) there; false: the step is not acceptable.
       NULL: no manifold */
    bool (*project)(void *context, double t, double *y, double *f);
    /* the same without the rates of the quadratures, whose places in f stay as they are: for
       iterations that do not look at them. NULL: rhs */
    void (*lean)(void *context, double t, const double *y, double *f);
    int n;          /* components */
    int controlled; /* the first ones count in the error; the rest are quadratures: f does not
                       depend on them */
    int positions;  /* y = (u, v, quadratures) with u' = v: number of u, as many v; 0: first order.
                       Needed by generalised-alpha; lets others interpolate better and radau5
                       factor matrices of half the size (when controlled = 2 positions) */
    /* j (n x controlled), by rows: df_i/dy_j at (t, y). NULL: by differences */
    void (*jacobian)(void *context, double t, const double *y, double *j);
} fw_maths_ode;

typedef enum fw_maths_ode_result {
    FW_ODE_STEP,
    FW_ODE_SMALL, /* the step became too small */
    FW_ODE_NAN,   /* f is not a number */
    FW_ODE_NEWTON /* an implicit step does not converge at any step size */
} fw_maths_ode_result;

typedef struct fw_maths_stepper fw_maths_stepper;

enum { FW_ODE_OWN = 4 };
typedef struct
    fw_maths_stepper_row { /* one row per integrator; feeds --help and the reference page */
    const char *name, *summary;
    /* order p: the error at the end falls with h^p. dense_order q: in a step from exact values the
       dense output is off by O(h^(q+1)); dense_order_u is that of the u of second order problems
       (their v have at least dense_order). Proven for every row in test_ode_order.c */
    int order, dense_order, dense_order_u;
    bool implicit;       /* stable for stiff problems */
    bool fixed_step;     /* takes fw_maths_stepper.h_fixed and knows no error */
    bool second_order;   /* only for problems with positions */
    bool variable_order; /* `order` is the highest, chosen by the error */
    /* the dense output is one polynomial, or as many of equal length, at most; 0: one. Their degree
       is dense_order_u, or 5 where that is less */
    int dense_parts;
    /* right-hand sides over those that it counts, and in a step, for limits of what a run may cost;
       0: as others of its kind (study/problem.c) */
    double rhs_per_count, rhs_per_step;
    fw_status (*create)(fw_arena *arena, const fw_maths_ode *ode, fw_maths_stepper **stepper);
    void (*start)(fw_maths_stepper *s); /* y, t, t_end are set: f, first step, history */
    fw_maths_ode_result (*step)(fw_maths_stepper *s); /* one accepted step */
    void (*prepare)(fw_maths_stepper *s); /* dense output of the last step; may evaluate rhs */
    void (*dense)(const fw_maths_stepper *s, double theta,
                  double *y); /* after prepare; theta in [0,1] */
    /* value and d/dtheta of w_a y[a] + w_b y[b] (b < 0: only a): for peaks and events */
    void (*component)(const fw_maths_stepper *s, int a, double wa, int b, double wb, double theta,
                      double *value, double *slope);
    /* where inside the last step states are the method's own and not interpolated, if only these
       fit what is stiff: theta (FW_ODE_OWN), how many of them; 0: all are equally good. NULL: 0 */
    int (*own)(const fw_maths_stepper *s, double *theta);
    void (*destroy)(fw_maths_stepper *s); /* gives back what is not in the arena; NULL: nothing */
} fw_maths_stepper_row;

struct fw_maths_stepper { /* first member of every integrator's own struct */
    const fw_maths_stepper_row *row;
    fw_maths_ode ode;
    double rtol;
    const double *atol; /* (n) */
    /* may be changed before fw_maths_stepper_start. h_max: infinite; h_fixed: of fixed_step
       integrators,
       0 means a thousandth of the way; spectral_radius: of generalised-alpha, 0.9 */
    double h_max, h_fixed, spectral_radius;
    double t_old, t, h, h_next, t_end;
    double *y_old, *y; /* (n) at t_old, t; all vectors are padded with zeros to `padded` */
    double *f_old, *f; /* (n) f there */
    int padded;        /* n, rounded up to whole vectors of 8 */
    double *tolerance; /* (padded) atol; infinite where the error does not count */
    struct fw_maths_ode_apart
        *apart; /* columns of the Jacobian that are found together; NULL: none */
    bool dense_ready;
    long steps, rejected, rhs, jacobians, factorisations, newton; /* kept over restarts */
};

/* by name; NULL: unknown */
const fw_maths_stepper_row *fw_maths_stepper_find(const char *name);
const fw_maths_stepper_row *const *fw_maths_stepper_table(size_t *count);
/* those that are chosen where none is asked for */
extern const fw_maths_stepper_row fw_maths_dop853_row, fw_maths_dopri5_row, fw_maths_radau5_row;
/* memory for ode->n components; atol (n) is read at every start and must live as long as the
   stepper. FW_INPUT: the integrator needs positions, or sizes contradict each other. The arena owns
   the stepper, but not what GSL takes from malloc: call fw_maths_stepper_free before the arena
   goes. */
fw_status fw_maths_stepper_new(fw_arena *arena, const fw_maths_stepper_row *row,
                               const fw_maths_ode *ode, double rtol, const double *atol,
                               fw_maths_stepper **stepper);
void fw_maths_stepper_free(fw_maths_stepper *s); /* NULL and twice allowed */
/* (re)start at t < t_end with y (n), on the manifold; counts go on */
void fw_maths_stepper_start(fw_maths_stepper *s, double t, const double *y, double t_end);
fw_maths_ode_result fw_maths_stepper_step(fw_maths_stepper *s);
void fw_maths_stepper_dense(fw_maths_stepper *s, double theta,
                            double *y); /* prepares when needed */
void fw_maths_stepper_component(fw_maths_stepper *s, int a, double wa, int b, double wb,
                                double theta, double *value, double *slope);

/* ---- shared by the integrators ---- */

int fw_maths_ode_padded(int n);
double *fw_maths_ode_vector(fw_arena *arena, int n); /* zeros, padded; NULL when memory is short */
/* weighted rms of e over the controlled components, scale_i = atol_i + rtol max(|y_i|, |z_i|) */
double fw_maths_ode_norm(const fw_maths_stepper *s, const double *e, const double *y,
                         const double *z);
/* first step for a method of this order: Hairer, Norsett and Wanner I, II.4; work: 2 padded */
double fw_maths_ode_first_step(fw_maths_stepper *s, int order, double *work);
void fw_maths_ode_evaluate(fw_maths_stepper *s, double t, const double *y, double *f); /* counts */
/* f of the controlled components alone; counts */
void fw_maths_ode_evaluate_lean(fw_maths_stepper *s, double t, const double *y, double *f);
bool fw_maths_ode_finite(const double *y, int n);
/* where a step of about h ends: t_end when it comes close, else t + h; h becomes the difference of
   the two times as they are stored, so that rounding t does not shift the phase of long runs */
double fw_maths_ode_target(const fw_maths_stepper *s, double *h);
/* projects or evaluates: f_new = f(t_new, y_new); false: not acceptable, or not a number */
bool fw_maths_ode_finish(fw_maths_stepper *s, double t_new, double *y_new, double *f_new);
/* accepts y_new, f_new as the state at t_new (swaps buffers), counts the step */
void fw_maths_ode_accept(fw_maths_stepper *s, double t_new, double **y_new, double **f_new);
/* counts a rejected step; is it worth trying h instead? tries: rejections of this step so far */
bool fw_maths_ode_retry(fw_maths_stepper *s, double h, int *tries);
/* dense output for steppers without one of their own: u by the quintic through (u, v, a) at both
   ends, v by its derivative, the rest by the cubic through (y, f) */
void fw_maths_ode_hermite(const fw_maths_stepper *s, double theta, double *y);
void fw_maths_ode_hermite_component(const fw_maths_stepper *s, int a, double wa, int b, double wb,
                                    double theta, double *value, double *slope);
/* the same for component c between any two states h apart */
typedef struct fw_maths_ode_span {
    double h;
    const double *y_old, *f_old, *y, *f;
    bool v_alone; /* v by its own cubic: where the local error of u over h would hurt u' */
} fw_maths_ode_span;
void fw_maths_ode_span_value(const fw_maths_ode *ode, const fw_maths_ode_span *span, int c,
                             double theta, double *value, double *slope);
/* p(theta) = r_0 + theta (r_1 + (1 - theta) (r_2 + theta (r_3 + ...))) of every component, the
   coefficients one row of `padded` after the other; and a weighted pair of components with slope */
enum { FW_ODE_NESTED_MOST = 8 }; /* rows */
/* in the header, so that `rows` is a constant where they are called: peaks and samples ask often.
   Four components at a time, each in the order of its own sum; rows are padded to whole fours */
static inline void fw_ode_nested_dense(const fw_maths_stepper *s, int rows, const double *row,
                                       double theta, double *y) {
    typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
    const size_t width = (size_t)s->padded, n = (size_t)s->ode.n;
    double weight[FW_ODE_NESTED_MOST] = {1};
    _Pragma("GCC unroll 8") for (int i = 1; i < rows; i++) {
        weight[i] = weight[i - 1] * (i % 2 ? theta : 1 - theta);
    }
    for (size_t c = 0; c < n; c += 4) {
        four sum = {0};
        _Pragma("GCC unroll 8") for (int i = rows - 1; i >= 0; i--) {
            sum += weight[i] * *(const four *)&row[(size_t)i * width + c];
        }
        if (c + 4 <= n)
            *(four *)&y[c] = sum;
        else
            for (size_t k = c; k < n; k++)
                y[k] = sum[k - c];
    }
}
/* Components whose rows from the fifth on are more than `fw_ode_wild` times the first difference and
   the two slopes (sums of squares), and more than `fw_ode_seen` tolerances, keep the cubic alone.
   Where an explicit step is long against a stiff direction that is at rest, rounding grows by
   (h lambda)^8 to the end and by (h lambda)^11 between: 1e-22 m became 4e-12 m there, within the
   tolerance, and 170 um between. A sine of two radians a step has 0.4; a body that rattles in a hole
   has up to some thousand where the polynomial is right. */
static const double fw_ode_wild = 1e5, fw_ode_seen = 1000;
static inline void fw_ode_nested_tame(const fw_maths_stepper *s, int rows, double *row) {
    typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
    const size_t width = (size_t)s->padded, n = (size_t)s->ode.n;
    for (size_t c = 0; c < n; c += 4) {
        four low = {0}, high = {0};
        _Pragma("GCC unroll 8") for (int i = 1; i < rows; i++) {
            const four r = *(const four *)&row[(size_t)i * width + c];
            *(i < 4 ? &low : &high) += r * r;
        }
        high -= fw_ode_wild * fw_ode_wild * low;
        for (size_t k = 0; k < 4 && c + k < n; k++) {
            double much =
                s->tolerance[c + k] + s->rtol * (row[c + k] < 0 ? -row[c + k] : row[c + k]);
            much *= fw_ode_seen;
            for (size_t i = 4; high[k] > much * much && i < (size_t)rows; i++)
                row[i * width + c + k] = 0;
        }
    }
}
static inline void fw_ode_nested_component(const fw_maths_stepper *s, int rows, const double *row,
                                           int a, double wa, int b, double wb, double theta,
                                           double *value, double *slope) {
    const double rest = 1 - theta;
    double p = 0, d = 0, r[FW_ODE_NESTED_MOST];
    _Pragma("GCC unroll 8") for (int i = 0; i < rows; i++) r[i] = wa * row[i * s->padded + a];
    if (b >= 0)
        _Pragma("GCC unroll 8") for (int i = 0; i < rows; i++) r[i] += wb * row[i * s->padded + b];
    _Pragma("GCC unroll 8") for (int i = rows - 1; i >= 0; i--) {
        d = i % 2 ? rest * d - p : theta * d + p;
        p = r[i] + (i % 2 ? rest : theta) * p;
    }
    *value = p;
    *slope = d;
}

/* ---- shared by implicit integrators: the Jacobian, and systems (sigma I - J) x = r ---- */

/* Columns of the Jacobian without a row in common, which one evaluation finds together. They are those of the last one
   that was found column by column, and each later one is asked whether they are still (fw_maths_ode_jacobian). */
typedef struct fw_maths_ode_apart {
    int groups; /* 0: not known; FW_ODE_TOGETHER: too many rows are common to too many */
    int *group; /* (controlled) */
    int *owner; /* (controlled/3 x controlled): whose entry a row has in a group; -1: none */
    double *r;  /* (2 controlled) */
} fw_maths_ode_apart;
enum { FW_ODE_TOGETHER = -1, FW_ODE_MANY = 48 }; /* of fewer columns it does not pay */
fw_status fw_maths_ode_apart_new(fw_arena *arena, const fw_maths_ode *ode,
                                 fw_maths_ode_apart **apart);

/* j (n x controlled) by rows at (t, y) with f = f(t, y): the problem's own, or by differences with
   one evaluation per column, or per group of columns apart; work: 2 padded. false: not finite */
bool fw_maths_ode_jacobian(fw_maths_stepper *s, double t, const double *y, const double *f,
                           double *j, double *work);

/* (sigma I - J) x = r for the controlled components, sigma real or complex */
typedef struct fw_maths_ode_shifted {
    bool half; /* u' = v was eliminated: (sigma^2 - sigma K_v - K_u) is factored */
    int size;
    double a, b;      /* sigma = a + i b */
    double *re, *im;  /* (size x size); im NULL: sigma is real */
    double *right[2]; /* (size) */
    int *pivot;       /* (size) */
    int *
        within; /* (size x 4) first and behind the last entry that is not 0: of the factors, of K_v */
} fw_maths_ode_shifted;

fw_status fw_maths_ode_shifted_new(fw_arena *arena, const fw_maths_ode *ode, bool complex,
                                   fw_maths_ode_shifted *m);
bool fw_maths_ode_shifted_factor(fw_maths_stepper *s, const double *j, double a, double b,
                                 fw_maths_ode_shifted *m);
/* x, y (controlled): real and imaginary part of r in, of the solution out; y NULL when sigma is
   real */
void fw_maths_ode_shifted_solve(const fw_maths_stepper *s, const double *j,
                                const fw_maths_ode_shifted *m, double *x, double *y);

/* ---- the vector work of explicit Runge-Kutta steps ----

   It is done for the vector units of the processor that it runs on. Vectors are padded with zeros
   to a multiple of 8 and aligned to 64 bytes. Every variant does the same operations in the same
   order on each component, so all give the same bits. */

typedef struct fw_maths_rk_kernels {
    const char *name;
    int (*usable)(void); /* on this processor */
    /* out = y + h sum_j a_j k_j, j < count */
    void (*combine)(int n, double h, int count, const double *a, const double *const *k,
                    const double *y, double *out);
    /* sum_i = sum_c ((sum_j e_2j+i k_j[c]) / (tolerance[c] + rtol max(|y[c]|, |z[c]|)))^2 for i in
       {0, 1}: two error estimates at once, their weights side by side in e (2 count) */
    void (*errors)(int n, int count, const double *e, const double *const *k, double rtol,
                   const double *tolerance, const double *y, const double *z, double sum[2]);
} fw_maths_rk_kernels;

/* narrowest first */
const fw_maths_rk_kernels *fw_maths_rk_kernels_table(size_t *count);
const fw_maths_rk_kernels *fw_maths_rk_kernels_best(void);

#endif
