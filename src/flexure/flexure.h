/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinge mechanics in closed form. Theory: docs/theory/flexure.md; reference: shared hinge tables.

   Frame of a flexure: arc centre O at the origin, symmetry axis +x, root of the first body at polar
   angle -a, of the second at +a. A leaf lies along y, its middle at the origin. */
#ifndef FW_FLEXURE_FLEXURE_H
#define FW_FLEXURE_FLEXURE_H
#include "device/device.h"

typedef struct fw_flexure_input {
    fw_flexure_kind kind;
    double length_m, angle_rad, radius_m, width_m, fillet_m, depth_m;
    double youngs_Pa, poisson;
    double strength_Pa, safety_factor;
} fw_flexure_input;

typedef struct fw_flexure_result {
    double centre_m;               /* W on the symmetry axis, from O (leaf: from the middle: 0) */
    double stiffness_Nm_per_rad;   /* with depth and root corrections */
    double stiffness_thin;         /* E I / L, without them, for the record */
    double kx_N_per_m, ky_N_per_m; /* translation stiffness at W, thin theory with shear */
    double strain_per_rad;         /* peak, at the fillet */
    double stress_per_rad_Pa;      /* E * strain_per_rad */
    double limit_angle_rad;        /* strength / safety factor / stress_per_rad */
    double limit_uncertainty;      /* relative standard uncertainty of limit_angle from the model */
    double depth_factor, root_length_m, concentration; /* EI_eff/EI, dL, Kt */
} fw_flexure_result;

/* relative standard uncertainty of the peak strain inside the fitted range: half of the 2.9 % by which
   held-out finite elements were off. The verdict's model error holds it already. */
#define FW_FLEXURE_STRAIN_UNCERTAINTY 0.015

typedef struct fw_flexure_model { /* one row per kind: adding a hinge kind is one file and one row
                                   */
    fw_flexure_kind kind;
    const char *name, *summary;
    void (*closed_form)(const fw_flexure_input *in, fw_flexure_result *out);
} fw_flexure_model;
const fw_flexure_model *fw_flexure_models(size_t *count);
void fw_flexure_closed_form(const fw_flexure_input *in, fw_flexure_result *out);
/* the fillet used where the file gives none: as wide as the flexure, where the arc leaves room */
double fw_flexure_default_fillet(const fw_flexure *flexure);

#endif
