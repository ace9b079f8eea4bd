/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Straight leaves. */
#include "flexure/section.h"
#include <math.h>

void fw_flexure_leaf_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    double t = in->width_m, L = in->length_m, rho = in->fillet_m;
    double dL = fw_flexure_root_length_m(t, rho);
    *f = (fw_flexure_shape){.kind = FW_FLEXURE_LEAF,
                            .length_m = L,
                            .width_m = t,
                            .fillet_m = rho,
                            .cosine = 1,
                            .golovin = 1,
                            .root_length_m = dL,
                            .root_block_m = fw_flexure_root_block_m(t, rho),
                            .whole_m = L + 2 * dL,
                            .fillet_concentration = fw_flexure_fillet_concentration(t, rho)};
}

/* straight strip of length L along y, W at its middle, the roots as weights dL/(EI) at its ends:
     K = EI/(L + 2 dL),  C_xx = L^3/12EI + dL L^2/2EI + L/kGA,  C_yy = L/EA,  C_xy = 0
     eps/rad = t/(2 (L + 2 dL)) Kt G (fw_flexure_root_peak)
     crystal: E, G of the one direction it lies in, sigma/rad = t/(2 int ds/E) Kt G; its ends lose d
     at l from them (fw_flexure_end_loss_of, f = 1): K = EI/(L + 2 dL - 2 d), C_xx less
     2 d (L/2 - l)^2/EI
   no depth factor: a straight strip stays in plane stress in linear theory; what the ends of a deep
   one add (0.36 % in finite elements) is kept as uncertainty where it is isotropic. In m, Pa; out
   SI. Valid L >= 10 t. source: docs/theory/flexure.md eq. 11; test_ladder.c
   leaf_matches_the_reference */
void fw_flexure_leaf(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    const fw_flexure_crystal material = fw_flexure_elastic_of(in), *k = &material;
    double t = f->width_m, L = f->length_m, h = in->depth_m, A = h * t, E = in->youngs_Pa;
    double nu = in->poisson, G = E / (2.0 * (1.0 + nu)), dL = f->root_length_m;
    double lost = 0, lost_arm = 0;
    if (k->known) {
        E = 1 / (k->a0_per_Pa + k->a1_per_Pa * k->cos4);
        G = 1 / (k->g0_per_Pa + k->g1_per_Pa * k->cos4);
        nu = -k->s12_per_Pa * E;
        const fw_flexure_end_loss end = fw_flexure_end_loss_of(k, h, 1, L, f->root_block_m);
        lost = E * k->bow_per_Pa * end.length_m, lost_arm = 0.5 * L - end.reach_m;
        dL = E * fw_flexure_root_m_per_Pa(f, k, k->cos4);
    }
    double EI = E * A * (t * t) / 12, ends = dL - lost, whole = L + 2 * ends;
    out->youngs_Pa = E, out->poisson = nu;
    out->root_length_m = ends;
    out->depth_factor = 1.0;
    out->stiffness_thin = EI / L;
    out->stiffness_Nm_per_rad = EI / whole;
    for (int i = 0; i < 3; i++)
        out->compliance[i][0] = out->compliance[i][1] = out->compliance[i][2] = 0;
    out->compliance[0][0] = whole / EI;
    out->compliance[1][1] =
        (L * L * (L / 12 + 0.5 * dL) - 2 * lost * (lost_arm * lost_arm)) / EI + 1.2 * L / (G * A);
    out->compliance[2][2] = L / (E * A);
    const fw_flexure_root_case root = {
        .width_m = t, .fillet_m = f->fillet_m, .depth_m = h, .poisson = nu, .bow = 1, .end = 1};
    double apart = k->known ? 0 : 2 * fw_flexure_end_loss_m(in, 1, f->root_block_m);
    out->ends_stiffer = whole / (whole - apart);
    fw_flexure_peak_strain(f, 0.5 * t / (whole - apart) * (k->known ? E / in->youngs_Pa : 1), 1,
                           fw_flexure_root_peak(&root, &in->crystal), out);
    out->strain_fit_per_rad /= out->ends_stiffer; /* the fit has no ends */
}
