/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How bodies give between their hinges: an upper bound from their outlines, as beams. Private to the
   room and its tests. Theory: docs/theory/verdict.md. */
#ifndef FW_VERDICT_BODY_ARMS_H
#define FW_VERDICT_BODY_ARMS_H
#include "layout/layout.h"
#include "mechanism/mechanism.h"

/* From where a flexure begins in a body to the body's middle, its centroid or what is nearest to it.
   Energy of a wrench w = (M, Fx, Fy) about the pin, world axes of the drawn pose: w.give.w/(2 E h). */
typedef struct fw_verdict_arm {
    bool known;                /* drawn, and its material hangs together */
    double give[6];            /* MM, Mx, My, xx, xy, yy: m^-2, m^-1, m^-1, 1, 1, 1 */
    double length_m, narrow_m; /* of the way; where it is narrowest, */
    fw_geometry_vec2 narrow;   /* and the place, world */
} fw_verdict_arm;

/* arm: (2 nhinge) of hinge k in body a, in body b. In: outlines of the layout in the drawn pose. Range:
   any outline; unknown where nothing is drawn or the way is narrower than a cell of the grid, a 400th of the body.
   Error: an upper bound as far as a strip of inscribed circles is a beam. Cost: some 1e5 operations for a body.
   Test: test_body_arms.c */
fw_status fw_verdict_body_arms(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_layout *layout, fw_verdict_arm **arm);
/* J of a wrench that a hinge puts on the body, turned back to the drawn pose by turned_rad */
double fw_verdict_arm_energy_J(const fw_verdict_arm *arm, double stiff_N, double moment_Nm,
                               double fx_N, double fy_N, double turned_rad);

#endif
