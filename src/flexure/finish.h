/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every kind of one width does after its own part, in line: marks of the outline, stiffnesses,
   limits, errors of an isotropic material. Private to the room. */
#ifndef FW_FLEXURE_FINISH_H
#define FW_FLEXURE_FINISH_H
#include "flexure/kinds.h"
#include "flexure/quick.h"

typedef struct fw_root_lever { /* of a root, about W */
    double along, across, sine, cosine;
} fw_root_lever;

FW_INLINE fw_root_lever fw_root_lever_of(const fw_flexure_shape *f) {
    if (f->kind == FW_FLEXURE_LEAF) return (fw_root_lever){0, 0.5 * f->length_m, 0, 1};
    return (fw_root_lever){f->radius_m * f->cosine - f->centre_m, f->radius_m * f->sine, f->sine,
                           f->cosine};
}

/* Five causes, each with the factor that bounds continuum figures of 23 shapes (theory, table):
     ends   the blocks keep the section from its anticlastic bow: shorter by up to
            0.35 h nu^2 f at either end, nu^2 f = 1 - (1 - nu^2) D of the depth factor (leaf 0.4 h)
     roots  the law of dL: 0.006 t, and in thick arcs with wide fillets 2.3 t (t/r)^2 (rho/t)^2
     place  the fillet takes strip away up to rho from the end, where the form has it at the end:
            first moment 0.15 rho^2 (the block's own flexibility beside it)
     rest   0.1 % of a long thin beam; 0.002 r or 0.01 t of W across
     axial  a block gives along the strip as up to 1.6 t of it would, which the form leaves out
   With e = 2 length/L of the first two: K e, kx e y^2 L/(EI C_xx), ky e x^2 L/(EI C_yy), W e |x|,
   (x, y) the root from W. Strain: 3 % (leaf 4 %) and half of what the depth adds to the peak, which
   the root does not feel in full; 3 % (leaf 6 %) more for fillets below t/4: at so sharp a notch
   the middle of the depth bears more than plane stress says.

   in: shape, result with D, C, Kt (SI); out: relative errors, of W in m. Cost 15 ns.
   source: docs/theory/flexure.md "Errors"; test_error.c, test_ladder.c */
FW_INLINE void fw_isotropic_errors(const fw_flexure_shape *f, const fw_flexure_input *in,
                                   const fw_flexure_result *r, double per_EI, double wide,
                                   fw_flexure_error *out) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double t = f->width_m, nu2 = r->poisson * r->poisson, rho = fw_smaller(f->fillet_m, t);
    double bow = fw_larger(1 - (1 - nu2) * r->depth_factor, 0), lost, rho2;
    rho = fw_larger(rho, 0), rho2 = rho * rho; /* twice what either end loses: */
    lost = (arc ? 0.7 : 0.8) * in->depth_m * bow + 0.012 * t;
    if (arc) lost += 4.6 * 9 / 12.0 * (f->curved * f->curved * rho2) * (f->per_section * t);
    double place = 0.6 * rho2, twice = lost, e = lost * f->per_length;
    double give = f->fillet_m < 0 ? 0 : (3.2 / 12) * t * t * t; /* 1/EA over 1/EI: t^2/12 */
    fw_root_lever at = fw_root_lever_of(f);
    double x = fabs(at.along), y = fabs(at.across);
    const fw_pair lever = {y, x}, along = {fabs(at.cosine), fabs(at.sine)};
    const fw_pair turned = {at.sine * at.sine, at.cosine * at.cosine};
    const fw_pair stiff = {r->kx_N_per_m, r->ky_N_per_m};
    fw_pair forces = lever * (twice * lever + place * along) + give * turned;
    forces = wide * (0.002 + (per_EI * stiff) * forces);
    double strain = 0.04, centre = 0.01 * t;
    if (arc) {
        double peak = r->concentration / f->fillet_concentration;
        strain = 0.03 + 0.5 * fw_larger(peak - (1 + f->curved), 0);
        centre = e * x + place * f->per_length + 2e-4 * f->radius_m;
    }
    if (f->fillet_m >= 0 && f->fillet_m < 0.25 * t) strain += arc ? 0.03 : 0.06;
    out->stiffness = wide * (0.001 + e);
    out->kx = forces[0], out->ky = forces[1];
    out->strain = wide * strain;
    out->centre_m = wide * centre;
}

/* A crystal: K 1.4 %, kx 1 %, ky 1.6 % more (linear finite elements of two arcs, three directions
   each, ideal ends), W twice, strain 3.1 % more; where its direction is not known the spread over
   all of them. source: docs/theory/flexure.md; test_crystal.c */
FW_INLINE void fw_crystal_errors(const fw_flexure_shape *f, const fw_crystal *k, double wide,
                                 fw_flexure_error *e) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double spread = k->aligned ? 0 : fabs(k->a1_per_Pa / k->a0_per_Pa);
    e->stiffness += wide * (0.014 + (arc ? 0 : spread));
    e->kx += wide * (0.010 + (arc ? 0.1 * spread : spread));
    e->ky += wide * (0.016 + spread);
    e->strain += wide * 0.031;
    e->centre_m = 2 * e->centre_m + wide * (arc ? (0.001 + 0.2 * spread) * f->radius_m : 0);
}

/* what lifts the peak strain above all continuum figures: they are up to 1.9 % (leaf 2.7 %) higher
   than the closed form, 4.3 % (8.3 %) with fillets below t/4; and the factors by which a shape
   outside of those compared widens its errors, times 2 for each of fillet outside [0.05, 1] t, arc
   thicker than t/r = 0.15, strip shorter than 16 t (depth above 10 t: fw_flexure_errors); times 10
   in all above t/r = 0.3 */
FW_INLINE void fw_shape_marks(fw_flexure_shape *f) {
    bool path = f->kind == FW_FLEXURE_PATH, arc = f->kind == FW_FLEXURE_CSFH;
    double t = f->width_m, rho = f->fillet_m, x = rho / t, wide = 1;
    bool ideal = !(x >= 0), thick = arc && t > 0.3 * f->radius_m;
    f->sharp = !ideal && x < 0.25;
    f->safe = ideal ? 1.002 : f->sharp ? (arc ? 1.045 : 1.085) : (arc ? 1.02 : 1.03);
    f->beyond_fit = (!ideal && x < 0.05) || x > 1.0 + 1e-9 || thick;
    if ((rho >= 0 && rho < 0.05 * t) || rho > t * (1.0 + 1e-9)) wide *= 2;
    if (arc && t > 0.15 * f->radius_m * (1.0 + 1e-9)) wide *= 2;
    if (f->length_m < 16 * t) wide *= 2;
    if (thick) wide = fw_larger(wide, 10);
    f->widening = path ? 1 : wide;
}

/* limit angle = strength / safety factor / (E eps/rad); its relative uncertainty is that of the
   strain formula: half of the 2.9 % by which held-out finite elements were off (crystal: of 6 %),
   and 2 % more (leaf 4 %) for fillets below t/4, 5 % more where the fillet lies outside the fitted
   range or the arc is thick (t/r > 0.3) */
FW_INLINE void fw_stiffness_and_limit(const fw_flexure_shape *f, const fw_flexure_input *in,
                                      fw_flexure_result *out) {
    const fw_pair stiff = 1 / (fw_pair){out->compliance[1][1], out->compliance[2][2]};
    out->kx_N_per_m = stiff[0], out->ky_N_per_m = stiff[1];
    out->strain_bound_per_rad = f->safe * out->strain_per_rad;
    out->stress_per_rad_Pa = in->youngs_Pa * out->strain_per_rad;
    out->limit_angle_rad = in->strength_Pa / (in->safety_factor * out->stress_per_rad_Pa);
    out->limit_uncertainty = (in->crystal.known ? 0.03 : FW_FLEXURE_STRAIN_UNCERTAINTY) +
                             (f->beyond_fit ? 0.065 - FW_FLEXURE_STRAIN_UNCERTAINTY
                              : f->sharp    ? (f->kind == FW_FLEXURE_LEAF ? 0.04 : 0.02)
                                            : 0);
}

FW_INLINE double fw_errors_widened(const fw_flexure_shape *f, double depth_m) {
    return depth_m > 10 * f->width_m * (1.0 + 1e-9) ? 2 * f->widening : f->widening;
}

#endif
