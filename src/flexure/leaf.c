/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/finish.h"
#include "flexure/section_core.h"
#include <math.h>

FW_INLINE void outline(const fw_flexure_input *in, fw_flexure_shape *f) {
    double t = in->width_m, L = in->length_m, rho = in->fillet_m, per_t = 1 / t;
    double dL = 0, block = 0, Kt = 1, ratio = 0;
    if (rho >= 0) {
        double x = fw_fitted_ratio(rho * per_t);
        dL = t * fw_root_law(x), block = fw_root_block_law * t, Kt = fw_concentration_law(x);
        ratio = fw_larger(x, 0.1);
    }
    double whole = L + 2 * dL;
    f->kind = FW_FLEXURE_LEAF, f->radius_m = 0;
    f->length_m = L, f->width_m = t, f->fillet_m = rho, f->fillet_ratio = ratio;
    f->cosine = 1, f->golovin = 1;
    f->root_length_m = dL, f->root_block_m = block, f->whole_m = whole;
    f->per_length = 1 / L, f->per_whole = 1 / whole, f->per_section = 12 * (per_t * per_t);
    f->fillet_concentration = Kt;
}

void fw_flexure_leaf_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    *f = (fw_flexure_shape){.kind = FW_FLEXURE_LEAF};
    outline(in, f);
}

/* what a solid has at a fillet over the beam (section_core.h) */
FW_INLINE double root_of(const fw_flexure_shape *f, const fw_flexure_crystal *k, double h,
                         double nu) {
    double Kt = f->fillet_concentration, x = f->fillet_ratio, q = fw_notch_of(Kt);
    double p = h / (h + 4 * f->width_m);
    if (f->fillet_m < 0) return 1;
    if (!k->known) return Kt * fw_root_rise(x, q, p, nu, nu, 0);
    const fw_flexure_root_crystal root = fw_root_crystal_of(k->share, x, q, 0);
    const fw_flexure_root_worst worst =
        k->aligned ? fw_root_crystal_at(&root, 1, 0, k->cos4, k->sin4) : fw_root_crystal_any(&root);
    return Kt * fw_root_crystal_peak(&root, &worst, p, nu, nu);
}

/* straight strip of length L along y, W at its middle, the roots as weights dL/(EI) at its ends:
     K = EI/(L + 2 dL),  C_xx = L^3/12EI + dL L^2/2EI + L/kGA,  C_yy = L/EA,  C_xy = 0
     eps/rad = t/(2 (L + 2 dL)) Kt G (fw_root_rise)
     crystal: E, G of the one direction it lies in, sigma/rad = t/(2 int ds/E) Kt G; its ends lose d
     at l from them (fw_end_loss_of, f = 1): K = EI/(L + 2 dL - 2 d), C_xx less 2 d (L/2 - l)^2/EI
   no depth factor: a straight strip stays in plane stress in linear theory; what the ends of a deep
   one add (0.36 % in finite elements) is kept as uncertainty where it is isotropic. In m, Pa; out
   SI. Valid L >= 10 t. Cost 18 ns. source: docs/theory/flexure.md eq. 11; test_ladder.c
   leaf_matches_the_reference */
FW_INLINE void leaf(const fw_flexure_shape *f, const fw_flexure_input *in, fw_flexure_result *out) {
    const fw_flexure_crystal *k = &in->crystal;
    double t = f->width_m, L = f->length_m, A = in->depth_m * t, E = in->youngs_Pa;
    double nu = in->poisson, G = E / (2.0 * (1.0 + nu));
    if (k->known) {
        E = 1 / (k->a0_per_Pa + k->a1_per_Pa * k->cos4);
        G = 1 / (k->g0_per_Pa + k->g1_per_Pa * k->cos4);
        nu = -k->s12_per_Pa * E;
    }
    double EI = E * A * (t * t) * (1 / 12.0), dL = f->root_length_m, per = 1 / EI;
    double whole = L + 2 * dL, ends = dL, per_whole = f->per_whole, K = EI * per_whole, lost_xx = 0;
    if (k->known) {
        const fw_flexure_end_loss end =
            fw_end_loss_of(k->reach, in->depth_m, 1, L, f->root_block_m);
        double lost = E * k->bow_per_Pa * end.length_m, at = 0.5 * L - end.reach_m;
        dL = E * (dL * k->a0_per_Pa + (dL - f->root_block_m) * k->a1_per_Pa * k->cos4);
        ends = dL - lost, whole = L + 2 * ends, lost_xx = 2 * lost * (at * at) * per;
        const fw_pair strip = fw_quotients(1, EI, L + 2 * dL, whole);
        per_whole = strip[0], K = strip[1];
    }
    out->youngs_Pa = E, out->poisson = nu;
    out->root_length_m = ends;
    out->depth_factor = 1.0;
    out->stiffness_thin = EI * f->per_length;
    out->stiffness_Nm_per_rad = K;
    for (int i = 0; i < 3; i++)
        out->compliance[i][0] = out->compliance[i][1] = out->compliance[i][2] = 0;
    out->compliance[0][0] = whole * per;
    out->compliance[1][1] = L * L * per * (L * (1 / 12.0) + 0.5 * dL) - lost_xx + 1.2 * L / (G * A);
    out->compliance[2][2] = L / (E * A);
    fw_peak_strain(f, 0.5 * t * per_whole * (k->known ? E / in->youngs_Pa : 1), 1,
                   root_of(f, k, in->depth_m, nu), out);
}

void fw_flexure_leaf(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    leaf(f, in, out);
}

void fw_flexure_leaf_at_once(const fw_flexure_input *in, fw_flexure_result *out) {
    fw_flexure_shape f = {.kind = FW_FLEXURE_LEAF}; /* what only arcs have is 0 */
    outline(in, &f);
    fw_shape_marks(&f);
    double wide = fw_errors_widened(&f, in->depth_m);
    out->centre_m = 0;
    out->offset_m[0] = out->offset_m[1] = out->uneven_x = out->uneven_y = 0;
    leaf(&f, in, out);
    fw_stiffness_and_limit(&f, in, out);
    double per_EI = out->compliance[0][0] / (f.length_m + 2 * out->root_length_m);
    fw_isotropic_errors(&f, in, out, per_EI, wide, &out->error);
    if (in->crystal.known) fw_crystal_errors(&f, &in->crystal, wide, &out->error);
    out->error.outside = wide > 1;
}
