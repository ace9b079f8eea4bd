/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws of section.h in line, with what a hinge's closed form has worked out already. Private to
   the room. */
#ifndef FW_FLEXURE_SECTION_CORE_H
#define FW_FLEXURE_SECTION_CORE_H
#include "flexure/quick.h"
#include "flexure/section.h"

/* x = rho/t in the range of the laws of the root */
FW_INLINE double fw_fitted_ratio(double x) {
    return fw_smaller(fw_larger(x, 0.05), 2.0);
}

/* dL = t (0.4192 - 0.5972 x - 0.1167 x^2), x = rho/t
   in: x in the fitted range; out: length added per root over t, negative above x = 0.63
   valid 0.05 <= x <= 1, blocks of 5 t and more behind the root; error 0.005
   fitted to plane-stress finite elements of three geometries and two materials
   docs/theory/flexure.md eq. 6; test_flexure.c root_law_matches_finite_elements */
static const double fw_root_block_law = 0.4192;
FW_INLINE double fw_root_law(double x) {
    return fw_root_block_law - 0.5972 * x - 0.1167 * x * x;
}

/* Kt = 0.944 + 0.2113 (t/rho)^(2/3), without the curved-beam factor 1 + t/3r
   valid as above; within 1 % of the finite elements it was fitted to, -0.2..+2.9 % on held-out ones
   docs/theory/flexure.md eq. 7; test_flexure.c concentration_matches_finite_elements */
FW_INLINE double fw_concentration_law(double x) {
    double q = fw_quick_per_cube_root(x);
    return 0.944 + 0.2113 * (q * q);
}

/* (t/rho)^(2/3) of that, no more than of rho = t/10 */
FW_INLINE double fw_notch_of(double concentration) {
    return fw_smaller((concentration - 0.944) * (1 / 0.2113), 4.641588833612779);
}

/* e/(r u^2), e = r - rn = r (1 - u/atanh u) (Winkler), by its series where the difference would
   cancel: what is left out is below 4e-16 of e at u = 0.1; above by fw_neutral_thick */
FW_INLINE double fw_neutral_series(double u) {
    double z = u * u, z2 = z * z;
    if (!(u < 0.1)) return fw_neutral_thick(u);
    return ((1 / 3.0 + z * (4 / 45.0)) + z2 * (44 / 945.0 + z * (428 / 14175.0))) +
           z2 * z2 *
               ((10196 / 467775.0 + z * (10719068 / 638512875.0)) + z2 * (25865068 / 1915538625.0));
}

FW_INLINE double fw_golovin_law(double u) {
    double u2 = u * u;
    return 1.0 - 2.0 / 15.0 * u2 - u2 * u2 * (1 / 21.0);
}

/* cylindrical strip of depth h bent about the wafer normal, free edges z = +-h/2:
     x = h [3 (1-nu^2)]^(1/4) / sqrt(r t),  f = (2/x)(cosh x - cos x)/(sinh x + sin x)
     EI_eff/EI = (1 - nu^2 f)/(1 - nu^2)
   hoop strain: inner fibre at mid-depth 1 - C1/(rt/2), outer fibre at the edge
     1 + (C1 ch c + C2 sh s)/(rt/2), all at X = x/2
   as quotients of which both parts are taken times exp(-2 X), so that nothing overflows; below x =
   0.1, where they cancel, by the first terms of their series in x (what is left out: 1e-16).
   in: deep = h/sqrt(r t), nu, per = 1/(1 - nu^2); out: both factors; x -> 0 plane stress, x ->
   infinity plane strain; error below 0.3 % against 3-D finite elements (rigid ends), 0.5 % with
   real roots. Cost 12 ns
   docs/theory/flexure.md eq. 8-10; test_flexure.c depth_factor_limits_and_reference,
   test_quick.c depth_factors */
typedef struct fw_depth_start { /* what the square roots are in */
    double x, poisson, nu2, rest, per, unit;
} fw_depth_start;

FW_INLINE fw_depth_start fw_depth_start_of(double deep, double poisson) {
    double nu2 = poisson * poisson, rest = 1 - nu2, root = sqrt(3 * rest); /* lambda^2 r t */
    return (fw_depth_start){.x = deep * sqrt(root),
                            .poisson = poisson,
                            .nu2 = nu2,
                            .rest = rest,
                            .per = 1 / rest,
                            .unit = poisson / root};
}

FW_INLINE fw_depth fw_depth_law(const fw_depth_start *from) {
    double x = from->x, X = 0.5 * x, nu2 = from->nu2, unit = from->unit;
    double of, over, c1, edge; /* f = of over; c1 = C1 / (rt/2); edge = the bracket / (rt/2) */
    if (x > 60) {
        of = 2, over = x;
        c1 = 0, edge = unit;
    } else if (x < 0.1) {
        double X2 = X * X, X4 = X2 * X2, x4 = 16 * X4;
        over = 1 + x4 * (1 / 120.0 + x4 * (1 / 362880.0));
        of = 1 + x4 * (1 / 360.0 + x4 * (1 / 1814400.0));
        double part = unit * X2 / over;
        c1 = part * (X4 * (1 / 630.0) - 1 / 3.0);
        edge = c1 * (1 - X4 * (1 / 6.0)) + part * (1 - X4 * (1 / 30.0)) * (1 - X4 * (1 / 90.0));
    } else {
        double d = fw_quick_exp_minus(X), p = d * d, H = 0.5 - 0.5 * p, G = 0.5 + 0.5 * p, s, c;
        fw_quick_sincos_near(X, &s, &c); /* H, G: sh, ch times d */
        double D = s * c * p + H * G, part = unit / D;
        double less = H * c - G * s, more = G * s + H * c;
        of = H * H + s * s * p, over = D * X;
        c1 = part * d * less;
        edge = part * (less * G * c + more * H * s);
    }
    double left = over - nu2 * of, per = 1 / (over * left); /* (1 - nu^2 f) over */
    double per_over = left * per, per_left = over * per;
    return (fw_depth){.stiffness = left * from->per * per_over,
                      .softness = from->rest * over * per_left,
                      .bow = of * per_over,
                      .inner = 1 - c1,
                      .outer = 1 + edge};
}

/* What a solid has at a root over what (5) says without its depth factors, as an upper bound:
     q = (t/rho)^(2/3),  x = rho/t,  p = h/(h + 4 t),  u = t/3R (0: straight)
     n = nu f, f as above (straight: nu): what the strip bows across as it bends, over its bending
     peak strain = M t/2/(EI D) Kt (1 + u) G
     G = 1.022 + n p (1.6609 p^2 - 0.7048) + nu q p^2 (0.91 - 1.0782 p) - 0.0729 nu x p^3
         + u (1.0401 x - 0.1723 q)
   n: a block keeps its end of the strip from bowing, so that the middle of the depth carries more
   of the moment than the faces, the more of it the wider the strip; nu q: a notch is in plane
   strain in the middle, where its concentration differs; u: the fillets of an arc are not mirror
   images.
   in: x clamped to [0.1, 2], q of that x, h, t m, nu, n, u >= 0; out: 1. Cost 3 ns. Fitted
   (Chebyshev) to 182 solids, arcs and leaves: x 0.1 to 2, h/t 0.5 to 10, t/r 0.025 to 0.15,
   nu 0.1 to 0.36, so that it is above all of them: by 0 to 3.2 %, for x > 1.25 by 0 to 5 %.
   source: docs/theory/flexure.md "Peak strain of a root"; test_root_strain.c */
FW_INLINE double fw_root_rise(double x, double q, double p, double nu, double n, double u) {
    double p2 = p * p;
    return 1.022 + n * p * (1.6609 * p2 - 0.7048) +
           nu * p2 * (q * (0.91 - 1.0782 * p) - 0.0729 * x * p) + u * (1.0401 * x - 0.1723 * q);
}

typedef struct fw_heading {
    double cosine, sine;
} fw_heading;

/* turned back by e >= 0: Taylor's series, 2e-4 of 1 off at e = 1. The laws below were fitted with
   the exact turn; what this changes is below 1e-4 of the stress for t/r <= 0.15, x <= 1.25 */
FW_INLINE fw_heading fw_turned_back(double cosine, double sine, double e) {
    double z = e * e, s = e * (1 - z * (1 / 6.0 - z * (1 / 120.0)));
    double c = 1 - z * (0.5 - z * (1 / 24.0 - z * (1 / 720.0)));
    return (fw_heading){cosine * c + sine * s, sine * c - cosine * s};
}

/* The same of a crystal's stress, over M t/2/(I D) Kt, as an upper bound:
     G = H max((1 + u)(A + B c + C s), (1 - u)(A + B c - C s))
     H = 1 + n p (3.3447 p^2 - 1.4352) + nu q p^2 (1.8501 - 2.4344 p)
           + nu x p^2 (0.8857 - 1.2631 p) + u (0.8806 x - 0.2102 q)
   A, B, C linear in x and q; c, s cosine and sine of 4 psi' with psi' the direction of the strip
   from [100] 1.5 rho/R before the root. s > 0: the fillet on the inside of the arc turns towards
   the stiff <110>, the other one away from it; a straight strip has one on either side. Of an
   unknown direction the worst.
   in: heading of 4 psi at the root, its sine such that s is as above; share: a1/a0 over silicon's,
   by which B and C go for other crystals (not compared); x, q, p, n, u as above, nu out of the
   plane, of the mean modulus; out: 1. Fitted (Chebyshev) to 138 solids of silicon, x 0.2 to 2, h/t
   1.2 to 10: above all of them by 0 to 4.3 %; fitted to 70 % of them it is -0.9
   to 5.6 % above the others.
   source: docs/theory/flexure.md eq. 14; test_root_strain.c, test_crystal.c peak_stress_of_silicon
 */
typedef struct fw_root_crystal {
    double even, along, across, shift; /* A, B, C, 6 rho/R */
} fw_root_crystal;

FW_INLINE fw_root_crystal fw_root_crystal_of(double share, double x, double q, double u) {
    return (fw_root_crystal){.even = 1.1247 - 0.0307 * x + 0.0018 * q,
                             .along = share * (-0.0625 + 0.0006 * x + 0.0117 * q),
                             .across = share * (0.1261 - 0.0401 * x + 0.0158 * q),
                             .shift = 18 * x * u};
}

FW_INLINE double fw_root_crystal_at(const fw_root_crystal *r, double u, double cosine,
                                    double sine) {
    const fw_heading at = fw_turned_back(cosine, sine, r->shift);
    double even = r->even + r->along * at.cosine, odd = r->across * at.sine;
    return fw_larger((1 + u) * (even + odd), (1 - u) * (even - odd));
}

FW_INLINE double fw_root_crystal_rise(double x, double q, double p, double nu, double n, double u) {
    double p2 = p * p;
    return 1 + n * p * (3.3447 * p2 - 1.4352) +
           nu * p2 * (q * (1.8501 - 2.4344 * p) + x * (0.8857 - 1.2631 * p)) +
           u * (0.8806 * x - 0.2102 * q);
}

#endif
