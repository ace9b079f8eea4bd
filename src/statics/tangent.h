/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact derivatives of the equations of motion, dense, in the model's units. Private to statics/.
 */
#ifndef FW_STATICS_TANGENT_H
#define FW_STATICS_TANGENT_H
#include "multibody/model.h"

/* At state y = (u, v, ...) and time t with multipliers lambda (2 nblock, the model's order):
     stiffness (nq x nq) = d(G^T lambda)/du - dQ/du,   damping (nq x nq, may be NULL) = -dQ/dv.
   The model must be posed at u. */
void fw_statics_tangent(const fw_multibody_model *m, double t, const double *y,
                        const double *lambda, double *stiffness, double *damping);

#endif
