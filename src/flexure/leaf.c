/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/finish.h"
#include "flexure/section.h"
#include <math.h>

void fw_leaf_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    double t = in->width_m, dL = fw_root_length_m(t, in->fillet_m);
    double whole = in->length_m + 2.0 * dL;
    *f = (fw_flexure_shape){.kind = in->kind,
                            .length_m = in->length_m,
                            .width_m = t,
                            .fillet_m = in->fillet_m,
                            .fillet_ratio = fmax(0.1, fmin(in->fillet_m / t, 2)),
                            .cosine = 1,
                            .golovin = 1,
                            .root_length_m = dL,
                            .root_block_m = fw_root_block_m(t, in->fillet_m),
                            .whole_m = whole,
                            .per_length = 1 / in->length_m,
                            .per_whole = 1 / whole,
                            .per_section = 12 / (t * t),
                            .fillet_concentration = fw_fillet_concentration(t, in->fillet_m)};
}

/* straight strip of length L along y, W at its middle, the roots as weights dL/(EI) at its ends:
     K = EI/(L + 2 dL),  C_xx = L^3/12EI + dL L^2/2EI + L/kGA,  C_yy = L/EA,  C_xy = 0
     eps/rad = t/(2 (L + 2 dL)) Kt G (fw_root_rise)
     crystal: E, G of the one direction it lies in, sigma/rad = t/(2 int ds/E) Kt G
   no depth factor: a straight strip stays in plane stress in linear theory; the ends of a deep one
   add 0.36 % (finite elements), kept as uncertainty. In m, Pa; out SI. Valid L >= 10 t. Cost 15 ns.
   source: docs/theory/flexure.md eq. 11; test_ladder.c leaf_matches_the_reference */
void fw_flexure_leaf(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    const fw_crystal *k = &in->crystal;
    double t = f->width_m, L = f->length_m, A = in->depth_m * t, E = in->youngs_Pa;
    double nu = in->poisson, G = E / (2.0 * (1.0 + nu));
    if (k->known) {
        E = 1 / (k->a0_per_Pa + k->a1_per_Pa * k->cos4);
        G = 1 / (k->g0_per_Pa + k->g1_per_Pa * k->cos4);
        nu = -k->s12_per_Pa * E;
    }
    double EI = E * A * t * t / 12.0, dL = f->root_length_m;
    if (k->known) dL = E * fw_root_m_per_Pa(f, k, k->cos4);
    double whole = f->length_m + 2 * dL, per = 1 / EI;
    out->youngs_Pa = E, out->poisson = nu;
    out->root_length_m = dL;
    out->depth_factor = 1.0;
    out->stiffness_thin = EI * f->per_length;
    out->stiffness_Nm_per_rad = EI / whole;
    for (int i = 0; i < 3; i++)
        out->compliance[i][0] = out->compliance[i][1] = out->compliance[i][2] = 0;
    out->compliance[0][0] = whole * per;
    out->compliance[1][1] = L * L * per * (L / 12.0 + 0.5 * dL) + 6.0 / 5.0 * L / (G * A);
    out->compliance[2][2] = L / (E * A);
    const fw_root_case root = {.width_m = t,
                               .fillet_m = in->fillet_m,
                               .depth_m = in->depth_m,
                               .poisson = nu,
                               .bow = 1,
                               .end = 1};
    fw_peak_strain(f, 0.5 * t / whole * (k->known ? E / in->youngs_Pa : 1), 1,
                   fw_root_peak(&root, k), out);
}
