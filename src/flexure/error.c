/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the closed form does not know, as a figure of each shape. */
#include "flexure/kinds.h"
#include <math.h>

typedef struct lever { /* of a root, about W */
    double along, across, sine, cosine;
} lever;

static lever lever_of(const fw_flexure_shape *f) {
    if (f->kind == FW_FLEXURE_LEAF) return (lever){0, 0.5 * f->length_m, 0, 1};
    return (lever){f->radius_m * f->cosine - f->centre_m, f->radius_m * f->sine, f->sine,
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
static fw_flexure_error isotropic(const fw_flexure_shape *f, const fw_flexure_input *in,
                                  const fw_flexure_result *r) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double t = f->width_m, L = f->length_m, nu2 = r->poisson * r->poisson;
    double rho = fmax(0, fmin(f->fillet_m, t)), thin = arc ? t / f->radius_m : 0;
    double bow = fmax(0, 1 - (1 - nu2) * r->depth_factor);
    double lost =
        (arc ? 0.35 : 0.4) * in->depth_m * bow + 0.006 * t + 2.3 * thin * thin * rho * rho / t;
    double e = 2 * lost / L, place = 4 * 0.15 * rho * rho;
    double EI = r->youngs_Pa * in->depth_m * t * t * t / 12 * r->depth_factor;
    double cx = EI * r->compliance[1][1], cy = EI * r->compliance[2][2];
    double give = f->fillet_m < 0 ? 0 : 3.2 * t * t * t / 12; /* 1/EA over 1/EI: t^2/12 */
    lever at = lever_of(f);
    double x = fabs(at.along), y = fabs(at.across);
    double peak = r->concentration / f->fillet_concentration;
    fw_flexure_error out = {
        .stiffness = 0.001 + e,
        .kx = 0.002 + (e * L * y * y + place * y * fabs(at.cosine) + give * at.sine * at.sine) / cx,
        .ky =
            0.002 + (e * L * x * x + place * x * fabs(at.sine) + give * at.cosine * at.cosine) / cy,
        .strain = arc ? 0.03 + 0.5 * fmax(0, peak - (1 + f->curved)) : 0.04,
        .centre_m = arc ? e * x + place / L + 2e-4 * f->radius_m : 0.01 * t};
    if (f->fillet_m >= 0 && f->fillet_m < 0.25 * t) out.strain += arc ? 0.03 : 0.06;
    return out;
}

/* A crystal: K 1.4 %, kx 1 %, ky 1.6 % more (linear finite elements of two arcs, three directions
   each, ideal ends), W twice, strain 3.1 % more; where its direction is not known the spread over
   all of them. source: docs/theory/flexure.md; test_crystal.c */
static void of_crystal(const fw_flexure_shape *f, const fw_crystal *k, fw_flexure_error *e) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double spread = k->aligned ? 0 : fabs(k->a1_per_Pa / k->a0_per_Pa);
    e->stiffness += 0.014 + (arc ? 0 : spread);
    e->kx += 0.010 + (arc ? 0.1 * spread : spread);
    e->ky += 0.016 + spread;
    e->strain += 0.031;
    e->centre_m = 2 * e->centre_m + (arc ? (0.001 + 0.2 * spread) * f->radius_m : 0);
}

double fw_flexure_safe(const fw_flexure_shape *f) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    if (f->fillet_m < 0) return 1.002; /* ideal ends */
    return f->sharp ? (arc ? 1.045 : 1.085) : (arc ? 1.02 : 1.03);
}

double fw_flexure_widening(const fw_flexure_shape *f) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double t = f->width_m, wide = 1;
    wide *= (f->fillet_m >= 0 && f->fillet_m < 0.05 * t) || f->fillet_m > t * (1.0 + 1e-9) ? 2 : 1;
    wide *= arc && t > 0.15 * f->radius_m * (1.0 + 1e-9) ? 2 : 1;
    wide *= f->length_m < 16 * t ? 2 : 1;
    return arc && t > 0.3 * f->radius_m ? fmax(wide, 10) : wide;
}

/* outside of the shapes that were compared nothing is known: times 2 for each of fillet outside
   [0.05, 1] t, arc thicker than t/r = 0.15, strip shorter than 16 t, depth above 10 t; times 10 in
   all above t/r = 0.3 */
fw_flexure_error fw_flexure_errors(const fw_flexure_shape *f, const fw_flexure_input *in,
                                   const fw_flexure_result *r) {
    bool path = f->kind == FW_FLEXURE_PATH;
    fw_flexure_error e = path ? f->error : isotropic(f, in, r);
    if (in->crystal.known) of_crystal(f, &in->crystal, &e);
    double by = f->widening * (in->depth_m > 10 * f->width_m * (1.0 + 1e-9) ? 2 : 1);
    return (fw_flexure_error){by * e.stiffness, by * e.kx,       by * e.ky,
                              by * e.strain,    by * e.centre_m, by > 1 || e.outside};
}
