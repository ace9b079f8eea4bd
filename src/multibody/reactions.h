/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joint forces in SI from model->lambda, at the pose of the model. Private to multibody/. */
#ifndef FW_MULTIBODY_REACTIONS_H
#define FW_MULTIBODY_REACTIONS_H
#include "multibody/model.h"

double fw_multibody_newton(const fw_multibody_model *m); /* N of one scaled unit of force */
/* (2 npin) force on body b, world axes */
void fw_multibody_pin_forces(const fw_multibody_model *m, double *out);
/* joint (3 njoint): force on body b, torque on it about its point b; driver (ndriver): N or N m
   along
   the driven coordinate */
void fw_multibody_joint_forces(const fw_multibody_model *m, const fw_mechanism *mechanism,
                               double *joint, double *driver);

#endif
