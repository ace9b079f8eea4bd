/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fast right-hand side of the method `chain` for plain models: all joints are pins, the effects
   torsion springs and dampers between bodies and constant forces at the bodies' own points.

   State y = (u, v, [d]) and units as in model.h. A path of bodies (a chain, or the one loop of a
   six-bar) has a kernel of its own that eliminates from both ends in the two lanes of one register;
   every other topology runs over a flat schedule. Both give the same bits on every processor: no
   contraction, baseline instructions, one order of operations. */
#ifndef FW_MULTIBODY_KERNEL_H
#define FW_MULTIBODY_KERNEL_H
#include "multibody/model.h"

typedef struct fw_kernel fw_kernel;

/* A pivot block is healthy when its smaller eigenvalue exceeds this share of 1/m_a + 1/m_b; with
   all of them healthy one plain solve is enough. Near a singular position the pivot falls with the
   square of the angle p to it: A02 leaves health at p = 1e-3 rad. Closer than that the plain
   solution is the better one of S lambda = r (N = 5, p = 1e-4: error of the accelerations 1e-9, and
   1e-2 by six sweeps), but it takes the round-off of the pose for a motion out of the branch: with
   1e-12 here N = 40 does not get through. The sweeps leave such motions out. What is singular by
   structure leaves pivots of some round-offs, 1e-16 to 1e-14. Test: test_kernel.c, test_simulate.c
   (windows). */
static const double fw_healthy = 1e-6;

typedef struct fw_kernel_norms { /* after the last projection; scaled */
    double position, velocity;
} fw_kernel_norms;

/* *kernel = NULL when the model is not plain. The model must live as long as the kernel. */
fw_status fw_kernel_new(fw_arena *arena, const fw_model *model, fw_kernel **kernel);
/* f (ny) = y' at y (ny); NaN where the equations cannot be solved. Allocates nothing. */
void fw_kernel_rhs(fw_kernel *k, const double *y, double *f);
/* an accepted step: y onto Psi = 0 and G v = 0 in place, then f there; starts with the factor of
   the last evaluation. false: it does not get there; y is not usable */
bool fw_kernel_project(fw_kernel *k, double *y, double *f);
/* (2 npin) joint forces of the last evaluation, pins in the order of the model */
const double *fw_kernel_lambda(fw_kernel *k);
fw_kernel_norms fw_kernel_norms_of(const fw_kernel *k);
/* for tests and measurements */
bool fw_kernel_is_path(const fw_kernel *k);
void fw_kernel_prefer(fw_kernel *k, bool path);            /* false: the flat schedule */
void fw_kernel_set_healthy(fw_kernel *k, double relative); /* infinity: always the careful solve */

#endif
