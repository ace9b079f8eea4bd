/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Many designs of one topology at once: every SIMD lane carries a design with its own masses,
   stiffnesses, geometry and loads. Plain models only (kernel.h). The instruction set is chosen at
   run time; lanes may contract products and sums, so they agree with the single kernel to round-off
   and not to the bit.

   A batch is laid out in groups of `width` designs. A state vector y holds group after group, in a
   group component after component (ny of them, as in model.h), in a component lane after lane.
   Lanes that no design fills repeat the last design. */
#ifndef FW_MULTIBODY_LANES_H
#define FW_MULTIBODY_LANES_H
#include "multibody/model.h"

typedef struct fw_lanes fw_lanes;

/* names of the instruction sets of this processor, best first; NULL after the last */
const char *fw_lanes_set(int i);
/* *lanes = NULL when a model is not plain, or has not the joints, springs and state of the first.
   `set` NULL: the best; FW_USAGE for one that this processor has not. count > 0. */
fw_status fw_lanes_new(fw_arena *arena, const fw_model *const *models, int count, const char *set,
                       fw_lanes **lanes);
int fw_lanes_width(const fw_lanes *l);
const char *fw_lanes_set_name(const fw_lanes *l);
size_t fw_lanes_size(const fw_lanes *l); /* doubles in a state vector of the batch */

/* state y (ny) of one design into the batch, and out of it */
void fw_lanes_put(const fw_lanes *l, int design, const double *y, double *batch);
void fw_lanes_get(const fw_lanes *l, int design, const double *batch, double *y);

/* f = y' of every design, all with the vectors aligned as the arena aligns them. Allocates nothing.
   A design that has no solution gets NaN accelerations, the others are not touched by it. */
void fw_lanes_rhs(fw_lanes *l, const double *y, double *f);
/* an accepted step of all designs: y onto the constraints in place, then f there; false: some
   design does not get there */
bool fw_lanes_project(fw_lanes *l, double *y, double *f);
void fw_lanes_lambda(const fw_lanes *l, int design, double *lambda); /* (2 nblock), after rhs */

typedef struct fw_lanes_run {
    long steps, rejected, rhs; /* over all groups */
} fw_lanes_run;
/* every design from y over its own duration (scaled), group by group in lockstep: all designs of a
   group share the fraction of the duration that a step covers. The tolerance of the group's step is
   rtol / sqrt(width), so that no design's own error norm exceeds what rtol allows alone. atol (ny)
   for all designs. Integrator dop853. FW_SOLVER: some design stops. */
fw_status fw_lanes_integrate(fw_arena *arena, fw_lanes *l, const double *duration, double rtol,
                             const double *atol, double *y, fw_lanes_run *run);

#endif
