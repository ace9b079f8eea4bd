/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every kind of one width does after its own part, in line: marks of the outline, stiffnesses,
   limits, errors of an isotropic material. Private to the room. */
#ifndef FW_FLEXURE_FINISH_H
#define FW_FLEXURE_FINISH_H
#include "flexure/kinds.h"
#include "flexure/quick.h"

typedef struct fw_flexure_root_lever { /* of a root, about W */
    fw_flexure_real along, across, sine, cosine;
} fw_flexure_root_lever;

FW_INLINE fw_flexure_root_lever fw_root_lever_of(const fw_flexure_shape *f) {
    if (f->kind == FW_FLEXURE_LEAF)
        return (fw_flexure_root_lever){fw_all(0), 0.5 * f->length_m, fw_all(0), fw_all(1)};
    return (fw_flexure_root_lever){f->radius_m * f->cosine - f->centre_m, f->radius_m * f->sine,
                                   f->sine, f->cosine};
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
   (x, y) the root from W. Strain: it is 0 to 4 % above converged solids (fw_root_rise); of a
   solid whose strains are extrapolated to nodes they scatter by 1 to 2 % with its mesh.

   in: shape, result with D, C, Kt (SI); out: relative errors, of W in m. Cost 15 ns.
   source: docs/theory/flexure-errors.md; test_error.c, test_ladder.c */
FW_INLINE void fw_isotropic_errors(const fw_flexure_shape *f, const fw_flexure_input *in,
                                   const fw_flexure_result *r, fw_flexure_real per_EI,
                                   fw_flexure_real wide, fw_flexure_error *out) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    fw_flexure_real t = f->width_m, nu2 = r->poisson * r->poisson, rho = fw_smaller(f->fillet_m, t);
    fw_flexure_real bow = fw_larger(1 - (1 - nu2) * r->depth_factor, fw_all(0)), lost, rho2;
    rho = fw_larger(rho, fw_all(0)), rho2 = rho * rho; /* twice what either end loses: */
    lost = (arc ? 0.7 : 0.8) * in->depth_m * bow + 0.012 * t;
    if (arc) lost += 4.6 * 9 / 12.0 * (f->curved * f->curved * rho2) * (f->per_section * t);
    fw_flexure_real place = 0.6 * rho2, twice = lost, e = lost * f->per_length;
    /* 1/EA over 1/EI: t^2/12 */
    fw_flexure_real give = fw_unless_below_0(f->fillet_m, (3.2 / 12) * t * t * t, fw_all(0));
    fw_flexure_root_lever at = fw_root_lever_of(f);
    fw_flexure_real x = fw_size(at.along), y = fw_size(at.across), c = at.cosine, n = at.sine;
    fw_flexure_real along = y * (twice * y + place * fw_size(c)) + give * (n * n);
    fw_flexure_real across = x * (twice * x + place * fw_size(n)) + give * (c * c);
    fw_flexure_real centre = 0.01 * t;
    if (arc) centre = e * x + place * f->per_length + 2e-4 * f->radius_m;
    out->stiffness = wide * (0.001 + e);
    out->kx = wide * (0.002 + (per_EI * r->kx_N_per_m) * along);
    out->ky = wide * (0.002 + (per_EI * r->ky_N_per_m) * across);
    out->strain = wide * ((arc ? 0.04 : 0.05) + (f->sharp ? 0.03 : 0));
    out->centre_m = wide * centre;
}

/* A crystal: K 1.4 %, kx 1 %, ky 1.6 % more (linear finite elements of two arcs, three directions
   each, ideal ends, beside a closed form that did not know what ends lose: three times what is left
   since), W twice, strain 3 % more; where its direction is not known the spread over
   all of them. source: docs/theory/flexure-silicon.md; test_crystal.c */
FW_INLINE void fw_crystal_errors(const fw_flexure_shape *f, const fw_flexure_crystal *k,
                                 fw_flexure_real wide, fw_flexure_error *e) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    fw_flexure_real spread = k->aligned ? fw_all(0) : fw_size(k->a1_per_Pa / k->a0_per_Pa);
    e->stiffness += wide * (0.014 + (arc ? fw_all(0) : spread));
    e->kx += wide * (0.010 + (arc ? 0.1 * spread : spread));
    e->ky += wide * (0.016 + spread);
    e->strain += wide * 0.03;
    e->centre_m += e->centre_m;
    if (arc) e->centre_m += wide * ((0.001 + 0.2 * spread) * f->radius_m);
}

/* peak strain: at the fillets of a root (share: Kt (1 + u) G of section_core.h), or between them
   where the fillets are wide; (5) beside it. beam: t/2 over length and roots, of a crystal in its
   modulus */
FW_INLINE void fw_peak_strain(const fw_flexure_shape *f, fw_flexure_real beam,
                              fw_flexure_real inside, fw_flexure_real share,
                              fw_flexure_result *out) {
    out->concentration = fw_unless_below_0(f->fillet_m, fw_larger(inside, share), inside);
    out->strain_per_rad = beam * out->concentration;
    out->strain_fit_per_rad = beam * f->fillet_concentration * inside;
}

/* limit angle = strength / safety factor / (E eps/rad); its relative standard uncertainty is that
   of the strain: 0 to 4 % above solids; twice as much for a crystal; 2 % more for fillets below
   t/10, 5 % more where the fillet lies outside the fitted range or the arc is thick (t/r > 0.3) */
FW_INLINE void fw_stiffness_and_limit(const fw_flexure_shape *f, const fw_flexure_input *in,
                                      fw_flexure_result *out) {
    const fw_flexure_both stiff =
        fw_quotients(fw_all(1), fw_all(1), out->compliance[1][1], out->compliance[2][2]);
    out->kx_N_per_m = fw_first(stiff), out->ky_N_per_m = fw_second(stiff);
    out->stress_per_rad_Pa = in->youngs_Pa * out->strain_per_rad;
    out->limit_angle_rad = in->strength_Pa / (in->safety_factor * out->stress_per_rad_Pa);
    out->limit_uncertainty = (in->crystal.known ? 0.03 : FW_FLEXURE_STRAIN_UNCERTAINTY) +
                             (f->beyond_fit ? 0.065 - FW_FLEXURE_STRAIN_UNCERTAINTY
                              : f->sharp    ? 0.02
                                            : 0);
}

#ifndef FW_FOUR_HINGES

/* inside of what was compared, as far as the outline goes; thick: the width of an arc */
FW_INLINE bool fw_shape_compared(double fillet, double width, double thick, double radius,
                                 double length) {
    const double above = 1.0 + 1e-9;
    return (fillet >= 0.1 * width) & (fillet <= 1.25 * above * width) &
           (thick <= 0.15 * above * radius) & (length >= 16 * width);
}

/* the factors by which a shape outside of those compared widens its errors, times 2 for each of
   fillet outside [0.05, 1.25] t, arc thicker than t/r = 0.15, strip shorter than 16 t (depth above
   10 t: fw_flexure_errors); times 10 in all above t/r = 0.3 */
FW_INLINE void fw_shape_marks(fw_flexure_shape *f) {
    bool path = f->kind == FW_FLEXURE_PATH, arc = f->kind == FW_FLEXURE_CSFH;
    const double above = 1.0 + 1e-9;
    double t = f->width_m, rho = f->fillet_m, ratio = arc ? t : 0, r = f->radius_m, wide = 1;
    f->sharp = f->beyond_fit = false, f->widening = 1;
    /* most are as those that were compared; a path has its own mark for what is beyond the fit */
    if (fw_shape_compared(rho, t, ratio, r, f->length_m)) return;
    bool ideal = !(rho >= 0), thick = ratio > 0.3 * r;
    bool unlike = !ideal && (rho < 0.05 * t || rho > 1.25 * above * t);
    f->sharp = !ideal && rho < 0.1 * t * (1.0 - 1e-9);
    f->beyond_fit = unlike || thick;
    if (unlike) wide *= 2;
    if (ratio > 0.15 * above * r) wide *= 2;
    if (f->length_m < 16 * t) wide *= 2;
    if (thick) wide = fw_larger(wide, 10);
    if (!path) f->widening = wide;
}

FW_INLINE double fw_errors_widened(const fw_flexure_shape *f, double depth_m) {
    return depth_m > 10 * f->width_m * (1.0 + 1e-9) ? 2 * f->widening : f->widening;
}

#endif
#endif
