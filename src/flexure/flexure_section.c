/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/kinds.h"
#include "flexure/section_core.h"

double fw_flexure_root_length_m(double width_m, double fillet_m) {
    if (fillet_m < 0) return 0; /* ideal ends */
    return width_m * fw_root_law(fw_fitted_ratio(fillet_m / width_m));
}

double fw_flexure_root_block_m(double width_m, double fillet_m) {
    return fillet_m < 0 ? 0 : fw_root_block_law * width_m;
}

/* The root of a crystal: what gives way in the block is stressed in all directions and has the mean
   compliance a0; the fillet takes away strip, which has that of the root's tangent:
     dL/E = 0.4192 t a0 + (dL - 0.4192 t) (a0 + a1 cos 4 psi)
   in: 1/Pa; out: m/Pa; isotropic: dL/E. Against 3-D finite elements of a silicon arc (r = 100 um,
   rho = t/2, psi = 0, 22.5, 45 deg) W moves by as much as in them within 0.04 um.
   Test: test_crystal.c roots_of_silicon */
double fw_flexure_root_m_per_Pa(const fw_flexure_shape *f, const fw_flexure_crystal *k,
                                double cos4) {
    return f->root_length_m * k->a0_per_Pa +
           (f->root_length_m - f->root_block_m) * k->a1_per_Pa * cos4;
}

double fw_flexure_neutral_offset(double r, double u) {
    return r * u * u * fw_neutral_series(u);
}

/* (atanh u - u)/(u^2 atanh u), the numerator by its series u^3 (1/3 + u^2/5 + ...) as long as it is
   small beside u. Test: test_quick.c random_hinges */
double fw_flexure_neutral_thick(double u) {
    double z = u * u, power = u, sum = 0;
    if (!(u < 0.5)) return (1 - u / atanh(u)) / z;
    for (int n = 3; n < 60; n += 2, power *= z)
        sum += power / n;
    return sum / atanh(u);
}

double fw_flexure_golovin(double u) {
    return fw_golovin_law(u);
}

double fw_flexure_fillet_concentration(double width_m, double fillet_m) {
    if (fillet_m < 0) return 1;
    return fw_concentration_law(fw_fitted_ratio(fillet_m / width_m));
}

fw_flexure_depth fw_flexure_depth_factors(double radius_m, double width_m, double depth_m,
                                          double poisson) {
    return fw_flexure_depth_at(depth_m / sqrt(radius_m * width_m), poisson);
}

fw_flexure_depth fw_flexure_depth_at(double deep, double poisson) {
    const fw_flexure_depth_start start = fw_depth_start_of(deep * deep, poisson);
    return fw_depth_law(&start);
}

fw_flexure_depth fw_flexure_depth_crystal(double deep, const fw_flexure_crystal *k,
                                          double youngs_Pa) {
    const fw_flexure_depth_start start = fw_depth_start_crystal(deep * deep, k, youngs_Pa);
    return fw_depth_law(&start);
}

/* by their own functions, both parts of the quotients times exp(-2 X), so that nothing overflows.
   Cost 25 ns. Test: test_quick.c depth_factors, over the seams */
fw_flexure_depth fw_flexure_depth_deep(fw_flexure_depth_start from) {
    double x2 = sqrt(from.z), x = sqrt(x2), X = 0.5 * x, unit = 4 * from.lift / x2;
    if (!(x <= 80)) return fw_depth_by(&from, 2, x, 0, x * unit, 1);
    double d = fw_quick_exp_minus(X), p = d * d, H = 0.5 - 0.5 * p, G = 0.5 + 0.5 * p, s, c;
    fw_quick_sincos_near(X, &s, &c); /* H, G: sh, ch times d */
    double turn = s * c * p, stand = H * G;
    return fw_depth_by(&from, H * H + s * s * p, (stand + turn) * X, X * d * (H * c - G * s),
                       X * (stand - turn), unit);
}

double fw_flexure_root_peak(const fw_flexure_root_case *r, const fw_flexure_crystal *k) {
    if (r->fillet_m < 0) return 1 + fabs(r->curved);
    double t = r->width_m, h = r->depth_m, u = fabs(r->curved), nu = r->poisson, n = nu * r->bow;
    double x = fw_fitted_ratio(r->fillet_m / t), Kt = fw_concentration_law(x), p = h / (h + 4 * t);
    double q = fw_notch_of(Kt);
    x = fw_larger(x, 0.1);
    if (!k || !k->known) return Kt * (1 + u) * fw_root_rise(x, q, p, nu, n, u);
    const fw_flexure_root_crystal root = fw_root_crystal_of(k->share, x, q, u);
    fw_flexure_root_worst worst = fw_root_crystal_any(&root);
    if (k->aligned) {
        double c = cos(4 * r->angle_rad), s = sin(4 * r->angle_rad);
        double inner = r->curved < 0 ? -r->end : r->end; /* mirrored where it turns right */
        double cosine = k->cos4 * c - k->sin4 * s, sine = inner * (k->sin4 * c + k->cos4 * s);
        worst = fw_root_crystal_at(&root, 1, 0, cosine, sine);
    }
    return Kt * fw_root_crystal_peak(&root, &worst, p, nu, n);
}
