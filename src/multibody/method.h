/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What solves  M a + G^T lambda = Q,  G a = -gamma: one file and one line in methods.def each.
   Vectors are in the model's order: a, d (3 nbody), gamma, lambda, r (2 nblock; empty rows are 0
   and stay 0). */
#ifndef FW_MULTIBODY_METHOD_H
#define FW_MULTIBODY_METHOD_H
#include "multibody/system.h"

/* Instructions of an answer for the reference six-bar (five bodies, n = 15, m = 12) by dop853 at a
   tolerance of 1e-7, over the right-hand sides of its finer run: projection, dense output, peaks
   and the run that errors are estimated from included; and how that grows with the bodies. Counted
   by `flexwright tradeoff`, gcc -O2 (docs/theory/tradeoff.md). Dense factorisations grow with the
   cube of the bodies, where small ones are mostly calls. */
typedef struct fw_multibody_method_cost {
    double six_bar, power;
} fw_multibody_method_cost;

typedef struct fw_multibody_method {
    const char *name, *summary, *source;
    fw_multibody_method_cost cost;
    bool independent; /* solves for independent coordinates, not for forces: very different masses
                         cost it no digits */
    const struct fw_multibody_dense_kernel *kernel; /* of a dense one (multibody_dense.h); NULL */
    /* memory, for sys->work->method; FW_SOLVER with a diagnostic when it cannot treat this
       mechanism. NULL: none */
    fw_status (*prepare)(fw_arena *arena, fw_multibody_system *sys, const fw_mechanism *mechanism,
                         fw_diags *diags);
    /* false: impossible there */
    bool (*factor)(fw_multibody_system *sys, const fw_multibody_pose *pose);
    /* a: in M^-1 Q, out the constrained acceleration; lambda: out */
    void (*accelerate)(fw_multibody_system *sys, const fw_multibody_factor *factor,
                       const double *gamma, double *a, double *lambda);
    /* d with G d = -r: of least mass norm, or the method's own choice. With G of the pose, but the
       numbers of the factor made last, which may be of a pose nearby */
    void (*correct)(fw_multibody_system *sys, const fw_multibody_pose *pose, const double *r,
                    double *d);
    /* its own way onto Psi(q, t) = 0 from u: the pose there, or NULL. The member NULL: Newton by
       `correct` */
    const fw_multibody_pose *(*close)(fw_multibody_system *sys, double t, double *u);
    /* with close: the right-hand side is evaluated at closed states, so that only the independent
       coordinates are integrated */
    bool closes_stages;
    /* what is worth knowing after a run, one sentence: which coordinates are independent, how often
       they changed, where the rank dropped. NULL: nothing */
    fw_status (*report)(const fw_multibody_system *sys, const fw_mechanism *mechanism,
                        fw_text *out);
} fw_multibody_method;

/* NULL: unknown; name NULL: the default */
const fw_multibody_method *fw_multibody_method_find(const char *name);

#endif
