/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a hinge's axis drifts, and where its conjugate surfaces meet: by a pure moment and under a
   given force. Theory: docs/theory/axis-drift.md. */
#ifndef FW_FLEXURE_DRIFT_H
#define FW_FLEXURE_DRIFT_H
#include "base/arena.h"
#include "flexure/finite.h"

typedef struct fw_flexure_surfaces { /* conjugate surfaces, one on each body */
    double gap_m;
    double aside_rad;   /* zeta: least angle between the direction of the displacement and one in
                           which both surfaces are there; 0: they are there */
    double centre_m[2]; /* where both are drawn, from W along and across the axis: of a crystal */
    double offset_m;    /* of the first body's surface alone, from there along its +y */
} fw_flexure_surfaces;

typedef struct fw_flexure_drift_point {
    double rotation_rad;
    double drift_m; /* of W on the second body, along y of the frame half turned */
    double pole_m;  /* pole of the finite displacement less W, along x of that frame */
    double left_m;  /* of the gap: below 0 the surfaces would overlap */
} fw_flexure_drift_point;

/* pure moment */
fw_flexure_drift_point fw_flexure_drift_at(const fw_flexure_hinge_law *law,
                                           const fw_flexure_surfaces *surfaces,
                                           double rotation_rad);
/* n points, evenly from low to high */
void fw_flexure_drift_curve(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *surfaces,
                            double low_rad, double high_rad, int n, fw_flexure_drift_point *point);
/* First rotation with the sign of `sense` (+1: winds the arc) at which the surfaces meet, the
   second body bearing a force (Fx, Fy) at W that keeps its direction in the first body's frame;
   NaN: at none below half a turn; 0: the force alone closes the gap. NULL: pure moment. */
double fw_flexure_drift_contact_rad(const fw_flexure_hinge_law *law,
                                    const fw_flexure_surfaces *surfaces, const double force_N[2],
                                    int sense);
/* by the first term of the drift, sqrt(2 gap a^2/(r (sin a - a cos a) cos zeta)) of an arc without
   roots: within 2 % below 15 deg */
double fw_flexure_drift_contact_small_rad(const fw_flexure_hinge_law *law,
                                          const fw_flexure_surfaces *surfaces);
/* displacement (ux, uy) of W in the first body's frame at a rotation under that force */
void fw_flexure_drift_displacement(const fw_flexure_hinge_law *law, double rotation_rad,
                                   const double force_N[2], double u_m[2]);

typedef struct fw_flexure_drift_advice {
    double offset_m;  /* of the first body's surface: fw_flexure_surfaces */
    double gap_m;     /* that is then needed for the whole range, by a pure moment */
    double centred_m; /* that is needed with both surfaces at W */
    double pivot_x_m; /* where, from W along the axis, a pin stands in for the hinge at the far end
                         of its range exactly, a quarter of the drift off between; 0 where the range
                         is as wide on either side: W is best */
} fw_flexure_drift_advice;
/* range of use, low <= 0 <= high */
fw_flexure_drift_advice fw_flexure_drift_advise(const fw_flexure_hinge_law *law, double low_rad,
                                                double high_rad);

#endif
