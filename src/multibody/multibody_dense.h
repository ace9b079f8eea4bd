/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the dense methods share. In mass-weighted coordinates w = M^1/2 a with balanced rows,
   A = D^-1/2 G M^-1/2 (rows x n), every one of them solves

       w + A^T lambda = w0,   A w = b      (w0 = M^-1/2 Q, b = -D^-1/2 gamma)

   that is: least |w - w0| among the w that fulfil the constraints (Gauss' principle). D is 1/m_a +
   1/m_b of a row's two bodies (of a row that only turns: 1/J_a + 1/J_b), the proximal term of the
   chain.

   No method decides a rank to compute with. A direction of A with singular value s gets the share
   1 - (eps / (s^2 + eps))^k of its constraint, which is what k proximal sweeps give: 1 to
   round-off where s > 1e-3, 0 where s is round-off (redundant rows), and bounded forces in between
   (singular positions). Private to multibody/. */
#ifndef FW_MULTIBODY_MULTIBODY_DENSE_H
#define FW_MULTIBODY_MULTIBODY_DENSE_H
#include "multibody/multibody_scratch.h"

typedef struct fw_multibody_dense fw_multibody_dense;

typedef struct fw_multibody_dense_kernel {                        /* one per method */
    fw_status (*prepare)(fw_arena *arena, fw_multibody_dense *d); /* memory: d->space */
    bool (*factor)(fw_multibody_dense *d); /* of d->a; false: LAPACK gave up */
    /* w: in w0, out w; lambda out; `sweeps` of the proximal iteration, or as many as it needs;
       false: LAPACK gave up */
    bool (*solve)(fw_multibody_dense *d, const double *b, double *w, double *lambda, int sweeps);
} fw_multibody_dense_kernel;

typedef struct fw_multibody_rank_monitor { /* what was met; nothing is computed with it */
    long evaluations, weak;                /* weak: a singular value between round-off and 1e-3 */
    int least, most;                       /* redundant rows */
    double smallest;                       /* weakest of those above round-off; INFINITY: none */
} fw_multibody_rank_monitor;

struct fw_multibody_dense {
    int rows, n;
    const fw_multibody_dense_kernel *kernel;
    double *g;           /* (rows x n) row-major: G, set before fw_multibody_dense_factor */
    double *root;        /* (n) M^-1/2, set once */
    double *row;         /* (rows) D^-1/2 */
    double *a;           /* (rows x n) column-major */
    double *b, *lambda;  /* (rows) */
    double *w;           /* (n) */
    double *gamma, *out; /* (rows) packed, for the model */
    void *space;         /* the method's */
    fw_multibody_rank_monitor rank;
};

enum { FW_SWEEPS = 6 };                   /* at most */
static const double fw_round_off = 1e-13; /* of singular values, relative to the largest */

fw_status fw_multibody_dense_new(fw_arena *arena, int rows, int n,
                                 const fw_multibody_dense_kernel *kernel, fw_multibody_dense **d);
bool fw_multibody_dense_factor(fw_multibody_dense *d);
/* G a = -gamma, M a + G^T lambda = M a_in; NaN where LAPACK gave up */
void fw_multibody_dense_accelerate(fw_multibody_dense *d, const double *gamma, double *a,
                                   double *lambda);

/* share of the constraint over s^2: sum_{j < sweeps} eps^j / (s^2 + eps)^(j + 1) */
double fw_multibody_dense_share(double s_squared, int sweeps);
void fw_multibody_dense_monitor(fw_multibody_dense *d, const double *s, int count, double noise);
void fw_multibody_dense_times(const fw_multibody_dense *d, const double *w,
                              double *r); /* r = A w */
void fw_multibody_dense_subtract_transpose(const fw_multibody_dense *d, const double *l,
                                           double *w); /* w -= A^T l */
double fw_multibody_dense_largest(const double *x, int count);
/* the proximal iteration with step = (dw, dl) of [I A^T; A -eps] (dw; dl) = (r1; r2), in place;
   more: (n + rows) */
bool fw_multibody_dense_sweep(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                              int sweeps, double *more, double *start,
                              bool (*step)(fw_multibody_dense *d, double *r1, double *r2));

/* the members of a fw_multibody_method with a kernel; sys->work->method is the fw_multibody_dense
 */
fw_status fw_multibody_dense_model_prepare(fw_arena *arena, fw_multibody_system *sys,
                                           const fw_mechanism *mechanism, fw_diags *diags);
bool fw_multibody_dense_model_factor(fw_multibody_system *sys, const fw_multibody_pose *pose);
void fw_multibody_dense_model_accelerate(fw_multibody_system *sys,
                                         const fw_multibody_factor *factor, const double *gamma,
                                         double *a, double *lambda);
void fw_multibody_dense_model_correct(fw_multibody_system *sys, const fw_multibody_pose *pose,
                                      const double *r, double *correction);
fw_status fw_multibody_dense_model_report(const fw_multibody_system *sys,
                                          const fw_mechanism *mechanism, fw_text *out);

#endif
