/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What solves  M a + G^T lambda = Q,  G a = -gamma. One file each, method_*.c; rows in
   multibody_table.c. Vectors are in the model's order: a, d (3 nbody), gamma, lambda, r (2 nblock;
   empty rows are 0 and stay 0). */
#ifndef FW_MULTIBODY_METHOD_H
#define FW_MULTIBODY_METHOD_H
#include "multibody/system.h"

typedef struct fw_multibody_method {
    const char *name, *summary, *source;
    bool independent; /* solves for independent coordinates, not for forces: very different masses
                         cost it no digits */
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

extern const fw_multibody_method fw_multibody_method_chain, fw_multibody_method_augmented,
    fw_multibody_method_coordinate_partitioning, fw_multibody_method_udwadia_kalaba,
    fw_multibody_method_svd, fw_multibody_method_qr, fw_multibody_method_schur,
    fw_multibody_method_block_least_squares, fw_multibody_method_minimal;

#endif
