/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What flexure.h and section.h say of one hinge, of four at once: the members that the laws of an
   arc ask for, and under the same names, so that the text of a law means these where it is compiled
   for four (lanes.h). Whatever is the same for both stays one. Private to the room, for csfh_four.c
   alone; to be included first. */
#ifndef FW_FLEXURE_FOUR_HINGES_H
#define FW_FLEXURE_FOUR_HINGES_H
#define FW_FOUR_HINGES
#include "flexure/kinds.h"
#include "flexure/lanes.h"
#include "flexure/section.h"

typedef struct fw_flexure_four_crystals {
    bool known, aligned;
    fw_flexure_real a0_per_Pa, a1_per_Pa, g0_per_Pa, s12_per_Pa, bow_per_Pa, reach, share, cos4,
        sin4;
} fw_flexure_four_crystals;

typedef struct fw_flexure_four_inputs {
    fw_flexure_real length_m, angle_rad, radius_m, width_m, fillet_m, depth_m, youngs_Pa, poisson;
    fw_flexure_real strength_Pa, safety_factor;
    fw_flexure_four_crystals crystal;
} fw_flexure_four_inputs;

typedef struct fw_flexure_four_shapes {
    fw_device_flexure_kind kind;
    fw_flexure_real length_m, radius_m, width_m, fillet_m, half_angle_rad, sine, cosine;
    fw_flexure_real neutral_m, eccentric_m, golovin, root_length_m, whole_m, root_block_m;
    fw_flexure_real fillet_concentration, centre_m, curved, per_rt;
    fw_flexure_real per_length, per_whole, per_eccentric, per_section, fillet_ratio;
    double widening;
    bool sharp, beyond_fit;
} fw_flexure_four_shapes;

typedef struct fw_flexure_four_errors {
    fw_flexure_real stiffness, kx, ky, strain, centre_m;
    bool outside;
} fw_flexure_four_errors;

typedef struct fw_flexure_four_results {
    fw_flexure_real centre_m, offset_m[2], stiffness_Nm_per_rad, stiffness_thin, kx_N_per_m,
        ky_N_per_m;
    fw_flexure_real compliance[3][3], strain_per_rad, strain_fit_per_rad, stress_per_rad_Pa;
    fw_flexure_real limit_angle_rad, depth_factor, root_length_m, concentration, youngs_Pa, poisson;
    fw_flexure_real uneven_x, uneven_y;
    double limit_uncertainty;
    fw_flexure_four_errors error;
} fw_flexure_four_results;

typedef struct fw_flexure_four_depths {
    fw_flexure_real stiffness, softness, bow, inner, outer;
} fw_flexure_four_depths;

#define fw_flexure_crystal fw_flexure_four_crystals
#define fw_flexure_input   fw_flexure_four_inputs
#define fw_flexure_shape   fw_flexure_four_shapes
#define fw_flexure_error   fw_flexure_four_errors
#define fw_flexure_result  fw_flexure_four_results
#define fw_flexure_depth   fw_flexure_four_depths

#endif
