/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Four arcs at once: the laws of csfh_even.h and csfh_crystal.h, every operation on four numbers. A
   closed form is some 600 operations of which few can go side by side, but those of other hinges
   always can.
     in: four usual arcs (fw_flexure_csfh_usual), all of one modulus or all of a crystal; out: of
     each what
   fw_flexure_closed_form says, bit by bit. Cost per hinge: two thirds of one alone and, where the
   processor has AVX, two fifths to a half (csfh_four_avx.c; bench_hinge_closed.c). Test:
   test_four.c */
#include "flexure/four_hinges.h"
/* the laws, of four */
#include "flexure/csfh_crystal.h"
#include "flexure/csfh_even.h"
/* and one of them */
#undef fw_flexure_input
#undef fw_flexure_result
#undef fw_flexure_crystal

#define EACH(name)                                                                                 \
    .name = (fw_flexure_real) {                                                                    \
        in[0]->name, in[1]->name, in[2]->name, in[3]->name                                         \
    }

FW_INLINE fw_flexure_four_crystals crystals_of(const fw_flexure_crystal *const in[4]) {
    return (fw_flexure_four_crystals){.known = true,
                                      .aligned = true,
                                      EACH(a0_per_Pa),
                                      EACH(a1_per_Pa),
                                      EACH(g0_per_Pa),
                                      EACH(s12_per_Pa),
                                      EACH(bow_per_Pa),
                                      EACH(reach),
                                      EACH(share),
                                      EACH(cos4),
                                      EACH(sin4)};
}

FW_INLINE fw_flexure_four_inputs inputs_of(const fw_flexure_input *const in[4]) {
    return (fw_flexure_four_inputs){
        EACH(length_m), EACH(angle_rad), EACH(radius_m), EACH(width_m),     EACH(fillet_m),
        EACH(depth_m),  EACH(youngs_Pa), EACH(poisson),  EACH(strength_Pa), EACH(safety_factor)};
}

FW_INLINE void take_one(const fw_flexure_four_results *four, int one, fw_flexure_result *out) {
#define OWN(name) out->name = four->name[one]
    OWN(centre_m), OWN(offset_m[0]), OWN(offset_m[1]);
    OWN(stiffness_Nm_per_rad), OWN(stiffness_thin), OWN(kx_N_per_m), OWN(ky_N_per_m);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            OWN(compliance[i][j]);
    OWN(strain_per_rad), OWN(strain_fit_per_rad), OWN(stress_per_rad_Pa), OWN(limit_angle_rad);
    OWN(depth_factor), OWN(root_length_m), OWN(concentration), OWN(youngs_Pa), OWN(poisson);
    OWN(uneven_x), OWN(uneven_y);
    OWN(error.stiffness), OWN(error.kx), OWN(error.ky), OWN(error.strain), OWN(error.centre_m);
#undef OWN
    out->limit_uncertainty = four->limit_uncertainty;
    out->error.outside = four->error.outside;
}

void fw_flexure_csfh_four(const fw_flexure_input *const in[4], fw_flexure_result *const out[4]) {
    fw_flexure_four_inputs four = inputs_of(in);
    fw_flexure_four_results found;
    if (in[0]->crystal.known) {
        four.crystal = crystals_of((const fw_flexure_crystal *const[]){
            &in[0]->crystal, &in[1]->crystal, &in[2]->crystal, &in[3]->crystal});
        fw_crystal_arc_at_once(&four, true, &found);
    } else {
        fw_even_arc_at_once(&four, true, &found);
    }
    for (int i = 0; i < 4; i++)
        take_one(&found, i, out[i]);
}
