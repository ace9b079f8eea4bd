/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motions that the joints allow, and the stiffness against them: the null space of G and the
   symmetric pencil (K, M) in it. Scaled units. Private to statics/. */
#ifndef FW_STATICS_REDUCED_H
#define FW_STATICS_REDUCED_H
#include "multibody/system.h"
#include "maths/dense.h"

typedef struct fw_statics_reduced {
    int n, rows, rank, dof;        /* n = 3 nbody; dof = n - rank */
    double largest, kept, dropped; /* singular values of balanced G M^-1/2: the largest, the
                                      smallest that counts, the largest that does not (0: none) */
    double *shape; /* (dof x n) modes: shape M shape^T = 1, shape K shape^T = value */
    double *value; /* (dof) ascending, 1/time^2 */
    double *zero;  /* (dof) |value| up to this is no more than round-off */
    double *root;  /* (n) M^-1/2 */
    double *left;  /* (rows x min(rows, n)) column-major, singular vectors */
    double *right; /* (n x n) row-major: right singular vectors, those of the null space last */
    double *balance, *g, *a, *sigma, *small, *work;
    fw_maths_lapack_space svd, eigen;
} fw_statics_reduced;

fw_status fw_statics_reduced_new(fw_arena *arena, const fw_multibody_model *m,
                                 fw_statics_reduced *r);
/* null space of G; FW_SOLVER: not finite */
fw_status fw_statics_reduced_null(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                  fw_statics_reduced *r);
/* modes of K (n x n) in it, after fw_statics_reduced_null */
fw_status fw_statics_reduced_spectrum(fw_statics_reduced *r, const double *stiffness);
/* lambda (2 nblock) with G^T lambda as close to the force (n) as it gets in the mass metric; of all
   such, the one of least norm */
void fw_statics_reduced_multipliers(const fw_multibody_model *m, const fw_statics_reduced *r,
                                    const double *force, double *lambda);
/* d (n) of least mass norm with G d = -psi (2 nblock) */
void fw_statics_reduced_correct(const fw_multibody_model *m, const fw_statics_reduced *r,
                                const double *psi, double *d);

#endif
