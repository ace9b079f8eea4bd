/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws that arcs, leaves and paths share: what roots, fillets, depth and ends do to a strip, and the peak strain
   at a root. */
#include "base/constants.h"
#include "flexure/flexure.h"
#include "flexure/section.h"
#include <math.h>
#include <string.h>

/* ---- roots ---- */

/* dL of a fillet that has no radius, over t: what the block behind the root gives way */
static const double block_length = 0.4192;

/* x = rho/t in the range of the laws of the root */
static double fitted_ratio(double width_m, double fillet_m) {
    return fmin(fmax(fillet_m / width_m, 0.05), 2.0);
}

/* dL = t (0.4192 - 0.5972 x - 0.1167 x^2), x = rho/t
   in: m, x clamped to [0.05, 2]; out: m added per root, negative above x = 0.63
   fitted to plane-stress finite elements of three geometries and two materials, x up to 1, blocks
   of 5 t and more behind the root; error 0.005 t there, beyond x = 1 extrapolated
   docs/theory/flexure.md eq. 6; test_flexure.c root_law_matches_finite_elements */
double fw_flexure_root_length_m(double width_m, double fillet_m) {
    if (fillet_m < 0) return 0; /* ideal ends */
    double x = fitted_ratio(width_m, fillet_m);
    return width_m * (block_length - 0.5972 * x - 0.1167 * x * x);
}

double fw_flexure_root_block_m(double width_m, double fillet_m) {
    return fillet_m < 0 ? 0 : block_length * width_m;
}

/* The root of a crystal: what gives way in the block is stressed in all directions and has the mean
   compliance a0; the fillet takes away strip, which has that of the root's tangent:
     dL/E = 0.4192 t a0 + (dL - 0.4192 t) (a0 + a1 cos 4 psi)
   in: 1/Pa; out: m/Pa; isotropic: dL/E. Against 3-D finite elements of a silicon arc (r = 100 um,
   rho = t/2, psi = 0, 22.5, 45 deg) W moves by as much as in them within 0.04 um.
   Test: test_crystal.c roots_of_silicon */
double fw_flexure_root_m_per_Pa(const fw_flexure_shape *f, const fw_flexure_crystal *k,
                                double cos4) {
    double more =
        f->kind == FW_FLEXURE_LEAF ? fw_flexure_straight_more_m(f->width_m, f->fillet_m) : 0;
    return more * (k->a0_per_Pa + k->a1_per_Pa * cos4) + f->root_length_m * k->a0_per_Pa +
           (f->root_length_m - f->root_block_m) * k->a1_per_Pa * cos4;
}

/* 0.006 t + 0.0335 rho^2/t
   in: m, rho held to 1.25 t; out: m added per root. Fitted to K of 335 leaves of silicon as solids, which are then
   as if longer by -0.053 to 0.067 t (both ends); of arcs solids say no such thing of W. Test: test_root_strain.c
   stiffness_of_solids */
double fw_flexure_straight_more_m(double width_m, double fillet_m) {
    if (fillet_m < 0) return 0; /* ideal ends */
    double x = fmin(fillet_m / width_m, 1.25);
    return width_m * (0.006 + 0.0335 * x * x);
}

/* Kt = 0.944 + 0.2113 (t/rho)^(2/3), without the curved-beam factor 1 + t/3r
   valid as above; within 1 % of the finite elements it was fitted to, -0.2..+2.9 % on held-out ones
   docs/theory/root-strain.md eq. 7; test_flexure.c concentration_matches_finite_elements */
double fw_flexure_fillet_concentration(double width_m, double fillet_m) {
    if (fillet_m < 0) return 1;
    return 0.944 + 0.2113 * pow(fitted_ratio(width_m, fillet_m), -2 / 3.0);
}

/* Concentration of tension where a strip enters a wide block by a fillet rho (plane stress):

     Kt = 0.4675 + 0.2494 (t/rho)^(2/3) + 0.5447 (t/rho)^0.3

   in: m; out: 1. Validity: rho/t 0.05 to 1, held to that; within 0.009 of the solids of tests/judge/tension.py, whose own error
   is 2 %. Test: test_strip_strain.c */
double fw_flexure_tension_concentration(double width_m, double fillet_m) {
    if (!(fillet_m > 0)) return 1;
    double x = width_m / fmin(fmax(fillet_m, 0.05 * width_m), width_m);
    return 0.4675 + 0.2494 * cbrt(x * x) + 0.5447 * pow(x, 0.3);
}

/* Where the moment falls along a strip, its peak at a root is that of an even moment as large as here:

     s = 1.07 rho - 0.10 t + 0.6 t^2/R,  0 <= s <= rho

   from the block's face. Of a sharp fillet the peak stands at the face, and shear adds to it what the
   moment loses; of a wide one it stands near the fillet's end.
     in: m, 1/m; out: m. An upper bound of plane-stress solids whose moment falls to nothing over 12
   to 25 t: 13 strips and arcs, rho/t from 0.1 to 1.25, t/R up to 0.14, even or varying by 0.6 to 1.3,
   have 0.01 to 0.08 t less. Source: tests/judge/gradient.py; docs/theory/root-strain.md eq. 7a.
   Test: test_strip_strain.c place_of_the_moment */
double fw_flexure_root_reach_m(double width_m, double fillet_m, double curvature_per_m) {
    double rho = fmax(fillet_m, 0), curved = fabs(curvature_per_m) * width_m;
    return fmin(fmax(1.07 * rho - (0.10 - 0.6 * curved) * width_m, 0), rho);
}

/* ---- curvature ---- */

/* e = r - rn = r (1 - u/atanh u) (Winkler), where the difference would cancel by the series
     atanh u - u = u^3 (1/3 + u^2/5 + u^4/7 + ...)
   Test: test_csfh.c random_hinges */
double fw_flexure_neutral_offset(double r, double u) {
    if (!(u < 0.5)) return r * (1 - u / atanh(u));
    double square = u * u, power = u * square, sum = 0;
    for (int n = 3; n < 60 && power > 1e-18 * sum; n += 2, power *= square)
        sum += power / n;
    return r * sum / atanh(u);
}

double fw_flexure_golovin(double u) {
    double u2 = u * u;
    return 1.0 - 2.0 / 15.0 * u2 - u2 * u2 / 21.0;
}

/* ---- depth ---- */

/* quotients of the sums of hyperbolic and circular functions, each 1 or a number as x -> 0 */
typedef struct strip_functions {
    double bow;   /* f = (2/x)(cosh x - cos x)/(sinh x + sin x) */
    double inner; /* (cosh X sin X - sinh X cos X)/(X^2 (sinh x + sin x)), X = x/2 */
    double outer; /* (sinh x - sin x)/(x^2 (sinh x + sin x)) */
} strip_functions;

/* below x = 1 all three by Taylor's series in x^4, where the differences would cancel (rest 2e-20);
   beyond x = 80 by what is left of them, 2/x, 0 and 1/x^2, before the hyperbolic functions
   overflow */
static strip_functions strip_functions_at(double x) {
    double x2 = x * x, X = 0.5 * x;
    if (!(x < 80)) return (strip_functions){2 / x, 0, 1 / x2};
    if (x > 1) {
        double sum = sinh(x) + sin(x);
        return (strip_functions){2 / x * (cosh(x) - cos(x)) / sum,
                                 (cosh(X) * sin(X) - sinh(X) * cos(X)) / (X * X * sum),
                                 (sinh(x) - sin(x)) / (x2 * sum)};
    }
    double z = x2 * x2, power = 1, turned = 1, factorial = 1, sum = 0, bow = 0, in = 0, out = 0;
    for (int k = 0; k < 5; k++) { /* of (4k + 1)!, (4k + 2)! and (4k + 3)! */
        sum += power / factorial;
        bow += power / (factorial * (4 * k + 2));
        out += power / (factorial * (4 * k + 2) * (4 * k + 3));
        in += turned / (factorial * (4 * k + 2) * (4 * k + 3));
        factorial *= (4 * k + 2) * (4.0 * k + 3) * (4 * k + 4) * (4 * k + 5);
        power *= z, turned *= -0.25 * z;
    }
    return (strip_functions){2 * bow / sum, in / sum, out / sum};
}

/* cylindrical strip of depth h bent about the wafer normal, free edges z = +-h/2:
     x = h [3 (1-nu^2)]^(1/4) / sqrt(r t),  f = (2/x)(cosh x - cos x)/(sinh x + sin x)
     EI_eff/EI = (1 - nu^2 f)/(1 - nu^2)
   hoop strain: inner fibre at mid-depth 1 - C1/(rt/2), outer fibre at the edge
     1 + (C1 ch c + C2 sh s)/(rt/2) = 1 + k (4/x^2) (sinh x - sin x)/(sinh x + sin x),
   C1, C2 at X = x/2, C1/(rt/2) = k (8/x^2) (sinh X cos X - cosh X sin X)/(sinh x + sin x),
   k = nu h^2/(4 r t).
     in: deep = h/sqrt(r t); nu; squares: nu^2; unlike: 1 (of a crystal see below); out: factors;
   x -> 0 plane stress, x -> infinity plane strain; error below 0.3 % against 3-D finite elements
   (rigid ends), 0.5 % with real roots. docs/theory/flexure.md eq. 8, docs/theory/root-strain.md
   eq. 9-10; test_flexure.c depth_factor_limits_and_reference, test_csfh.c depth_factors */
static fw_flexure_depth depth_of(double deep, double poisson, double squares, double unlike) {
    double x = deep * sqrt(sqrt(3 * (1 - squares) * unlike)), lift = poisson * (deep * deep);
    const strip_functions at = strip_functions_at(x);
    double plain = 1 - squares, bowed = 1 - squares * at.bow;
    return (fw_flexure_depth){.stiffness = bowed / plain,
                              .softness = plain / bowed,
                              .bow = at.bow,
                              .inner = 1 + 0.5 * lift * at.inner,
                              .outer = 1 + lift * at.outer};
}

fw_flexure_depth fw_flexure_depth_factors(double radius_m, double width_m, double depth_m,
                                          double poisson) {
    return fw_flexure_depth_at(depth_m / sqrt(radius_m * width_m), poisson);
}

fw_flexure_depth fw_flexure_depth_at(double deep, double poisson) {
    return depth_of(deep, poisson, poisson * poisson, 1);
}

/* The same of a crystal's strip. Plate and hoop energy per length of a section that bows by c,
   E' c^2 t^3/12 (its bending across) + E c^2 t h^4/(720 r^2) (its hoop strain), have E' = 1/s11 in
   one and E of the strip in the other: an affinity in z with (E/E')^(1/4) makes them those of an
   isotropic strip (Lekhnitskii, Anisotropic Plates, ch. on affine transformation) of
     nu^2 -> n^2 = nu nu' = s12^2 E/s11,  x^4 -> 3 (1 - n^2) (E/E') (h^2/(r t))^2
   and leave nu h^2, hence the hoop strain's k, as it is. With one nu D of silicon is 0.3 to 0.6 %
   too high for h >= 9 t, r <= 20 t.
   in: deep = h/sqrt(r t), E Pa of the mean 1/E. Test: test_crystal.c ends_of_silicon */
fw_flexure_depth fw_flexure_depth_crystal(double deep, const fw_flexure_crystal *k, double E) {
    return depth_of(deep, -k->s12_per_Pa * E, k->bow_per_Pa * E, (k->a0_per_Pa + k->a1_per_Pa) * E);
}

/* sum of products of cosh, sinh with cos, sin of y: c ch y cos y + s sh y sin y */
static double wave(double c, double s, double y) {
    double up = exp(y), down = 1 / up;
    return 0.5 * (c * (up + down) * cos(y) + s * (up - down) * sin(y));
}

/* Stress between the roots of a strip of a crystal, over M/Z. A section that is kept from bowing bears more
   than its hoop strain says; and where the moduli turn against a curved strip, sections warp. At y = x z/h
   of the depth, w = t/3R, with E, nu, n and x of the strip's own direction, m what a section's radial
   movement adds to its hoop strain and b its bending across over that of a free one:
     inner face ((1 + w v + c) B - m)/D,  outer ((1 - w v + c) B + m)/D,  c = 1.05 w^2 + 1.25 w^3
     B = (1 - n^2 b)/(1 - n^2),  D = (1 - n^2 f)/(1 - n^2),  v = 1 - 4 a1 E cos 4 psi
     m = (2 nu deep^2/x^2) (p ch y cos y + q sh y sin y)/(sinh x + sin x)
     b = 2 (q ch y cos y - p sh y sin y)/(sinh x + sin x)
     p = sh X cos X - ch X sin X,  q = sh X cos X + ch X sin X,  X = x/2
   v: shear by s16 = 2 a1 sin 4 psi of a stress that goes with n over the width warps the section by n^2, which
   changes along the strip by 8 a1 cos 4 psi/R; less what balances over the section, a strain of 4 a1 E w at
   both faces. c is what Golovin's stress has of higher order. The largest over the depth, and more by
   0.05 deep t/R: what is left of 14 solids, where a section bows as its neighbours do; beyond deep = 5
   both edges of the depth are by themselves, and it stays.
     in: deep = h/sqrt(R t); psi of the strip from the hinge's axis, rad; w >= 0; out: 1, > 0.
   Error: 0 to 6 % above places of 14 solids with R from 3 t, h to 10 t. Cost 0.6 us.
   Source: the shell of depth_of; docs/theory/flexure-silicon.md (14a). Test: test_strip_strain.c
   silicon_between_the_roots, stress_of_no_depth */
double fw_flexure_depth_stress(double deep, const fw_flexure_crystal *k, double psi_rad,
                               double curved) {
    enum { PLACES = 6 };
    const double four = k->cos4 * cos(4 * psi_rad) - k->sin4 * sin(4 * psi_rad);
    const double wave_E = k->aligned ? k->a1_per_Pa * four : -fabs(k->a1_per_Pa);
    const double E = 1 / (k->a0_per_Pa + wave_E), nu = -k->s12_per_Pa * E;
    const double squares = k->bow_per_Pa * E, plain = 1 - squares, w = curved;
    const double free = sqrt(3 * plain * (k->a0_per_Pa + k->a1_per_Pa) * E); /* (x/deep)^2 */
    const double x = fmin(fmax(deep * sqrt(free), 0.01), 80), X = 0.5 * x;
    const double sum = sinh(x) + sin(x);
    const double first = sinh(X) * cos(X), second = cosh(X) * sin(X);
    const double in = (first - second) / sum, out = (first + second) / sum;
    const double turned = w * (1 - 4 * wave_E * E), thick = (1.05 + 1.25 * w) * (w * w);
    double worst = 0;
    for (int i = 0; i <= PLACES + 1;
         i++) { /* from the edge inwards; beyond y = pi little is left */
        double y = i <= PLACES ? X - fmin(X, FW_PI) * i / PLACES : 0;
        double m = 2 * nu / free * wave(in, out, y), b = 2 * wave(out, -in, y);
        double base = (1 - squares * b) / plain;
        worst = fmax(worst, (1 + turned + thick) * base - m);
        worst = fmax(worst, (1 - turned + thick) * base + m);
    }
    const double stiffness = (1 - squares * strip_functions_at(x).bow) / plain;
    return worst / stiffness * (1 + 0.05 * fmin(deep, 5) * 3 * w);
}

double fw_flexure_path_fibre_factor(const fw_flexure_path_section *at,
                                    const fw_flexure_path_stuff *m) {
    double c = fabs(at->curved);
    double strain = fmax((1 + c) * at->depth.inner, (1 - c) * at->depth.outer);
    if (!m->by_stress || c == 0) return strain;
    const double deep = m->depth_m * sqrt(3 * c) / at->width_m; /* h/sqrt(R t) */
    double stress = fw_flexure_depth_stress(deep, &m->elastic, at->pose.angle_rad, c);
    return fmax(strain, stress * at->depth.stiffness * at->golovin);
}

/* A section bows as its neighbours let it, and bears more stress for it. Of what a place has above M/Z, e, one
   at the distance s has 0.65 e exp(-s/(0.4 h)) at least, and an end that is kept straight counts as e = n^2/0.65,
   or as what its root has above M/Z, which holds of solids with their ends. Of a crystal, whose bends have all
   that. one: strain at M/Z, (n). Test: test_strip_strain.c silicon_between_the_roots */
void fw_flexure_neighbours_reach(const fw_flexure_input *in, double bow, double length_m,
                                 const double *one, fw_flexure_path_strain *out) {
    const double share = 0.65, reach = 0.4 * in->depth_m / length_m;
    for (int way = -1; way <= 1; way += 2) {
        int end = way > 0 ? 0 : out->n - 1;
        double before = way > 0 ? 0 : 1, felt = bow;
        double root = out->point[end].strain_per_Nm / one[end] - 1;
        if (in->fillet_m >= 0) felt = fmin(felt, fmax(root, 0));
        for (int k = 1; k < out->n - 1; k++) {
            int i = end + way * k;
            fw_flexure_path_point *p = &out->point[i];
            felt *= exp(-fabs(p->part - before) / reach), before = p->part;
            double own = p->strain_per_Nm / one[i] - 1;
            if (own < felt) p->strain_per_Nm = one[i] * (1 + felt);
            felt = fmax(felt, share * own);
        }
    }
}

/* ---- ends ---- */

/* 1/E and 1/G without a harmonic, nu^2/E for what bowing adds, E' = E in the reach of an end:
     l/(h f) = (G/(3 E))^(1/2) = (1/(6 (1 + nu)))^(1/2)
   exact. Test: test_csfh.c ends_beside_plain_sums */
fw_flexure_crystal fw_flexure_elastic_of(const fw_flexure_input *in) {
    if (in->crystal.known || !in->ends) return in->crystal;
    double nu = in->poisson, soft = 1 / in->youngs_Pa;
    return (fw_flexure_crystal){.known = true,
                                .aligned = true,
                                .a0_per_Pa = soft,
                                .g0_per_Pa = 2 * (1 + nu) * soft,
                                .s12_per_Pa = -nu * soft,
                                .bow_per_Pa = nu * nu * soft,
                                .reach = sqrt(1 / (6 * (1 + nu)))};
}

/* What an end takes away, because it keeps its section straight that would bow across by nu/R as
   the strip bends (R of the bending), by f of that in a strip that is curved. Bow c0 f (1 - b(s)):
   the energy per length of an orthotropic plate under a given moment, (E'/f) (b c0 f)^2 against
   bowing and G h^2/3 (b' c0 f)^2 against the twist that goes with a bow that changes, is least for
     b = B exp(-s/l),  l = h f (G/(3 E'))^(1/2)
   and the strip bends by n^2 f b less. The block gives to the moments across as it does to those
   along, by 0.4192 t of strip: B = l/(l + 0.4192 t). So an end is as if there were less strip by
     d = n^2 f B l = n^2 f l^2/(l + 0.4192 t),  in the middle at l from the end, inwards
   with the energy's own l h f^(1/2) replaced by h f, since a deep strip bows (f < 1) at its two
   edges apart, over (r t)^(1/2) each, and as far along. n^2/E = s12^2/s11 of a crystal is the same
   in all directions: d is counted in 1/Pa m. No number in it is fitted.
     in: h, L, block = 0.4192 t (rigid end: 0) m; f; out: m. l no more than L/3, where both ends
   would meet (outside of what was compared). Error: K of 144 solids of silicon arcs (x 0.1 to 1.25,
   h/t 0.5 to 30, t/r to 0.15) is then -0.27 to 0.26 % off, 0.08 % rms (without: 0.42 %, 1.25 % at
   most), W of others 0.1 um.
   source: docs/theory/flexure-silicon.md eq. 13a; test_crystal.c ends_of_silicon */
fw_flexure_end_loss fw_flexure_end_loss_of(const fw_flexure_crystal *k, double depth_m, double bow,
                                           double length_m, double block_m) {
    double l = fmin(depth_m * k->reach * bow, length_m / 3.0);
    return (fw_flexure_end_loss){.reach_m = l, .length_m = bow * (l * l) / (l + block_m)};
}

double fw_flexure_end_loss_m(const fw_flexure_input *in, double bow, double block_m) {
    fw_flexure_input own = *in;
    own.ends = true;
    const fw_flexure_crystal k = fw_flexure_elastic_of(&own);
    return in->poisson * in->poisson *
           fw_flexure_end_loss_of(&k, in->depth_m, bow, in->length_m, block_m).length_m;
}

/* compliances of a cubic crystal by inversion of (C11, C12, C44), turned about [001]:
     S11 = (C11 + C12)/((C11 - C12)(C11 + 2 C12)),  S12 = -C12/(...),  S44 = 1/C44
     S0 = S11 - S12 - S44/2,  1/E = S11 - S0/2 sin^2(2 psi),  1/G = S44 + 2 S0 sin^2(2 psi)
   in: Pa, rad; out: 1/Pa. Valid for a stable crystal, C44 > 0, C11 > |C12|, C11 + 2 C12 > 0;
   exact. Cost 60 ns. Source: Nye, Physical Properties of Crystals, ch. VIII (rotation of the
   compliance tensor); docs/theory/flexure-silicon.md eq. 12.
   Test: test_crystal.c moduli_by_direction */
fw_flexure_crystal fw_flexure_crystal_cubic(double c11_Pa, double c12_Pa, double c44_Pa,
                                            double axis_rad) {
    double d = (c11_Pa - c12_Pa) * (c11_Pa + 2 * c12_Pa);
    double s11 = (c11_Pa + c12_Pa) / d, s12 = -c12_Pa / d, s44 = 1 / c44_Pa;
    double s0 = s11 - s12 - 0.5 * s44;
    const double silicon = 0.130229; /* a1/a0 of (165.7, 63.9, 79.6) GPa */
    bool aligned = isfinite(axis_rad);
    return (fw_flexure_crystal){.known = true,
                                .aligned = aligned,
                                .a0_per_Pa = s11 - 0.25 * s0,
                                .a1_per_Pa = 0.25 * s0,
                                .g0_per_Pa = s44 + s0,
                                .g1_per_Pa = -s0,
                                .s12_per_Pa = s12,
                                .bow_per_Pa = s12 * s12 / s11,
                                .reach = sqrt(s11 / (3 * s44)),
                                .share = 0.25 * s0 / (s11 - 0.25 * s0) / silicon,
                                .cos4 = aligned ? cos(4 * axis_rad) : 0,
                                .sin4 = aligned ? sin(4 * axis_rad) : 0};
}

/* ---- peak strain at a root, as a bound over solids: isotropic and of a crystal ---- */

/* What a solid has at a root over what a beam of the same moment has there with the plane-stress
   concentration Kt of its fillet, as an upper bound:

     peak strain = M t/2/(E I D g) Kt (1 + w) G                                       isotropic
     peak stress = M t/2/(I D g) Kt G                                                 leaf of a crystal
     peak stress = M t/2/(I D g) Kt max over both fillets of (1 + w) G                its arcs
     G: sum of c z^i p^j nu^k n^l u^m (cos 4 psi)^v (sin 4 psi)^o, the tables STRIP, LEAF, INNER and OUTER

   x = rho/t, q = x^(-2/3), p' = h/(h + 4 t), w = t/3R (0: straight; of a crystal's outer fillet with
   the other sign), z = 2 ln(x/0.1)/ln 12.5 - 1, p = 2 (p' - 1/9)/(10/14 - 1/9) - 1, u = sqrt(20 w),
   n = nu f, f the part of the cross-bow that is free to form (8). n: a block keeps its end of the strip
   from bowing, so that the middle of the depth carries more of the moment than the faces; nu: a notch
   is in plane strain in its middle; w: the fillets of an arc are not mirror images. psi' is the
   direction of the strip from [100] 1.35 rho/R before the root; sine > 0: the fillet on the inside of
   the arc turns towards the stiff <110>, the other one away from it; a straight strip has one on either
   side, of which that counts which turns towards it. Of an unknown direction the worst. Other cubic
   crystals: cosine and sine times the share that a1/a0 has of silicon's (not compared).

   G holds for fillets to 1.25 t (silicon from 0.15 t) and depths of t/2 to 10 t. Beyond, it goes on from the
   range's end as the former law does (tables EVEN, LEAF_...), which was fitted to solids of fillets to 2 t and
   h to 30 t, and up to 0.9 % more; arcs of a crystal go over into theirs (ARC_...).

   M is the closed form's with what its ends lose (13a): the strain at a root is a matter of the
   moment there, and goes with L only by that.

   in: x held to [0.1, 2], p' to that of h = t/2 and h = 30 t, nu and n to [0, 0.4], w to 0.05 in the
   sums (t/R = 0.15); out: 1. Fitted (Chebyshev, linear programs): above all solids, by 0.3 to 0.66 %
   (675 isotropic), 0.81 % (390 leaves of silicon) and 0.88 % (fillets of 1033 halves of its arcs) within the
   range. Fits that have not seen a tenth of the solids are 0.12 to 0.85 %, 0.13 to 1.08 % and -0.17 to 1.43 % above
   that tenth; 179 solids drawn and solved after the fit 0.2 to 1.0 % (root_strain_after.csv). The solids' own error
   is 0.3 %. A crystal's strip shorter than 2.45 h is strained up to 1.5 % less. Cost 0.2 us, of a crystal's arc
   0.4 us, of an unknown direction 17 us.
   source: docs/theory/root-strain.md eq. 11a, docs/theory/flexure-silicon.md eq. 14; solids and fit:
   tools/solids; test_root_strain.c, test_crystal.c peak_stress_of_silicon */
typedef struct strip_term {
    double by;
    signed char power[7]; /* of z, p, nu, n, u, cosine, sine */
} strip_term;

typedef struct root_term {
    double by;
    signed char power[8]; /* of x, q, p, nu, n, u, cosine, sine */
} root_term;

/* rows of roots.def */
static const strip_term strip[] = {
#define STRIP(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const strip_term leaf[] = {
#define LEAF(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const strip_term inner[] = {
#define INNER(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const strip_term outer[] = {
#define OUTER(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const root_term even[] = {
#define EVEN(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const root_term leaf_direction[] = {
#define LEAF_DIRECTION(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const root_term leaf_level[] = {
#define LEAF_LEVEL(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const root_term arc_direction[] = {
#define ARC_DIRECTION(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
static const root_term arc_level[] = {
#define ARC_LEVEL(by, ...) {by, {__VA_ARGS__}},
#include "flexure/roots.def"
};
#define SUM(table, at) sum_of(table, sizeof(table) / sizeof *(table), at)

static double sum_of(const root_term *term, size_t n, const double at[8]) {
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        double product = term[i].by;
        for (int k = 0; k < 8; k++)
            for (int j = 0; j < term[i].power[k]; j++)
                product *= at[k];
        sum += product;
    }
    return sum;
}

/* powers of each up to the fifth, once */
static double strip_sum(const strip_term *term, size_t n, const double at[7]) {
    double power[7][6], sum = 0;
    for (int k = 0; k < 7; k++) {
        power[k][0] = 1;
        for (int j = 1; j < 6; j++)
            power[k][j] = at[k] * power[k][j - 1];
    }
    for (size_t i = 0; i < n; i++) {
        const signed char *to = term[i].power;
        sum += term[i].by * (power[0][to[0]] * power[1][to[1]] * power[2][to[2]]) *
               (power[3][to[3]] * power[4][to[4]]) * (power[5][to[5]] * power[6][to[6]]);
    }
    return sum;
}

enum { X, Q, P, NU, N, U, COSINE, SINE };

/* the range of the first four tables, as p' and x */
static const double shallow = 1 / 9.0, deepest = 10 / 14.0, sharpest = 0.1, widest = 1.25;

/* where the laws are asked, and the end of the range of the first four tables on the way there */
typedef struct root_place {
    double at[8], end[8];
    bool beyond;
} root_place;

/* sharp: x down to which the law goes. The part of the bow that is free is another one at the range's
   depth */
static root_place place_of_root(const fw_flexure_root_case *r, double sharp) {
    const double most_curved = 0.05, deep = 15 / 17.0, most_bow = 0.4, most_depth = 10;
    double x = fmin(fmax(r->fillet_m / r->width_m, sharpest), 2.0), p = r->depth_m / r->width_m;
    root_place o = {{0}, {0}, x > widest || x < sharp || p > most_depth};
    o.at[X] = x, o.at[Q] = 1 / cbrt(x * x);
    o.at[P] = fmin(fmax(p / (p + 4), shallow), deep);
    o.at[NU] = fmin(fmax(r->poisson, 0), most_bow);
    o.at[N] = fmin(fmax(r->poisson * r->bow, 0), most_bow);
    o.at[U] = fmin(fabs(r->curved), most_curved);
    memcpy(o.end, o.at, sizeof o.end);
    if (!o.beyond) return o;
    o.end[X] = fmin(fmax(x, sharp), widest), o.end[Q] = 1 / cbrt(o.end[X] * o.end[X]);
    o.end[P] = fmin(o.at[P], deepest);
    if (p > most_depth && o.at[U] > 0) {
        const double per_depth = sqrt(3 * fabs(r->curved)); /* h/sqrt(R t) = h/t of it */
        o.end[N] *= fw_flexure_depth_at(most_depth * per_depth, o.at[NU]).bow /
                    fw_flexure_depth_at(p * per_depth, o.at[NU]).bow;
        o.end[N] = fmin(o.end[N], most_bow);
    }
    return o;
}

/* G of one of the first four tables; u: t/3R; cosine and sine: of four times a crystal's direction */
static double strip_of(const strip_term *term, size_t n, const double at[8], double curved) {
    const double place[7] = {2 * log(at[X] / sharpest) / log(widest / sharpest) - 1,
                             2 * (at[P] - shallow) / (deepest - shallow) - 1,
                             at[NU],
                             at[N],
                             sqrt(20 * curved),
                             at[COSINE],
                             at[SINE]};
    return strip_sum(term, n, place);
}
#define STRIP_SUM(table, at, curved) strip_of(table, sizeof(table) / sizeof *(table), at, curved)

/* G beyond the range, from that of its end: as the former law goes on from there, up to x = 2 and h = 30 t, and
   what 75 solids there have more than that */
static double goes_on(double G, const root_place *o, double (*former)(const double at[8])) {
    const double more = 0.009, x = 2.0, p = 15 / 17.0;
    if (!o->beyond) return G;
    return (1 + more * fmax((o->at[X] - o->end[X]) / (x - widest),
                            (o->at[P] - o->end[P]) / (p - deepest))) *
           G * former(o->at) / former(o->end);
}

/* the same of arcs of silicon, whose former law holds beyond by itself: soon it is that one */
static double fades(double G, const root_place *o, double (*former)(const double at[8])) {
    if (!o->beyond) return G;
    double fade = fmax(fmax((o->at[X] - o->end[X]) / 0.1, (o->end[X] - o->at[X]) / 0.02), 0);
    fade = fmin(fmax(fade, (o->at[P] - o->end[P]) / 0.04), 1);
    double less = 1 - G / former(o->end);
    return former(o->at) * (1 - less * (1 - fade));
}

static double former_even(const double at[8]) {
    return SUM(even, at);
}

static double former_leaf(const double at[8]) {
    return SUM(leaf_direction, at) * (1 + SUM(leaf_level, at));
}

static double former_arc(const double at[8]) {
    return SUM(arc_direction, at) * (1 + SUM(arc_level, at));
}

/* (1 + w) G, of a leaf G, of the worse fillet where 4 psi' has this cosine and sine */
static double of_fillets(const fw_flexure_root_case *r, double share, double four_psi) {
    const double sharp = 0.15, w = fabs(r->curved), sine = share * sin(four_psi);
    double worst = 0;
    root_place o = place_of_root(r, sharp);
    const double curved = o.at[U];
    o.at[COSINE] = o.end[COSINE] = share * cos(four_psi);
    if (!(w > 0)) { /* one fillet on either side: the one that turns towards the stiff direction */
        o.at[SINE] = o.end[SINE] = fabs(sine);
        return goes_on(STRIP_SUM(leaf, o.end, 0), &o, former_leaf);
    }
    for (int side = 1; side >= -1; side -= 2) {
        o.at[U] = o.end[U] = side * curved, o.at[SINE] = o.end[SINE] = side * sine;
        double G = side > 0 ? STRIP_SUM(inner, o.end, curved) : STRIP_SUM(outer, o.end, curved);
        worst = fmax(worst, (1 + side * w) * fades(G, &o, former_arc));
    }
    return worst;
}

/* between two of these directions it is 0.1 % higher at most */
static double of_any_direction(const fw_flexure_root_case *r, double share) {
    enum { DIRECTIONS = 48 };
    double worst = 0;
    for (int i = 0; i < DIRECTIONS; i++)
        worst = fmax(worst, of_fillets(r, share, i * FW_TURN / DIRECTIONS));
    return 1.001 * worst;
}

double fw_flexure_root_peak(const fw_flexure_root_case *r, const fw_flexure_crystal *k) {
    const double before = 1.35; /* fillet radii */
    double u = fabs(r->curved);
    if (r->fillet_m < 0) return 1 + u;
    double Kt = fw_flexure_fillet_concentration(r->width_m, r->fillet_m);
    const root_place o = place_of_root(r, sharpest);
    if (!k || !k->known)
        return Kt * (1 + u) * goes_on(STRIP_SUM(strip, o.end, o.end[U]), &o, former_even);
    if (!k->aligned) return Kt * of_any_direction(r, k->share);
    /* of an arc that turns right and of the first end the mirror image */
    double sense = r->curved < 0 ? -r->end : r->end;
    double four_psi = sense * (atan2(k->sin4, k->cos4) + 4 * r->angle_rad);
    return Kt * of_fillets(r, k->share, four_psi - 12 * before * o.at[X] * o.at[U]);
}

void fw_flexure_peak_strain(const fw_flexure_shape *f, double beam, double inside, double root,
                            fw_flexure_result *out) {
    out->concentration = f->fillet_m < 0 ? inside : fmax(inside, root);
    out->fibre = inside;
    out->strain_per_rad = beam * out->concentration;
    out->strain_fit_per_rad = beam * f->fillet_concentration * inside;
}
