/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Undamped motions of the bodies on massless beams. */
#ifndef JUDGE_MOTION_H
#define JUDGE_MOTION_H

#include "statics.h"

/* Angular frequencies at rest, rising, 1/s; 3 for every body. */
void motion_frequencies(struct model *model, double *omega);
/* Those of a stiffness, which is spoilt. */
void motion_frequencies_of(struct model *model, double *k, double *omega);

/* Largest stresses of the motion from rest (or from its velocities) under a share of the loads,
 * with so many steps in a period of the fastest mode; 0 if it could be followed.
 * most > 0 ends a motion that has gone beyond 3 times it. */
int motion_follow(struct model *model, double share, int fineness, double most, struct answer *out);

#endif
