/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact derivatives of the equations of motion, dense, in scaled units. Private to statics/. */
#ifndef FW_STATICS_TANGENT_H
#define FW_STATICS_TANGENT_H
#include "multibody/system.h"

/* At a pose, with velocities v and multipliers lambda (2 nblock, the model's order):
     stiffness (nq x nq) = d(G^T lambda)/du - dQ/du,   damping (nq x nq, may be NULL) = -dQ/dv. */
void fw_statics_tangent(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                        const double *v, const double *lambda, double *stiffness, double *damping);

#endif
