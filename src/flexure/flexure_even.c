/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed form of flexures of one width: circular arcs and straight leaves, of one modulus and of a crystal whose
   modulus goes by direction. */
#include "base/constants.h"
#include "flexure/section.h"
#include <math.h>

/* ---- outline of an arc ---- */

/* what the outline of an arc gives: rn = r u/atanh u, u = t/2r (Winkler), the exact bending
   stiffness over the thin one, 1 - 2/15 u^2 - u^4/21 (Golovin, plane stress, to u^4), roots, and
   W = 2 r (rn sin a + dL cos a)/(L + 2 dL) from O, L = 2 a r in m, rad; valid 0 < a <= pi, u < 1;
   error of W 0.2 um at r = 100 um against 3-D finite elements.
   source: docs/theory/flexure.md eq. 1, 2, 6, 7; test_ladder.c, test_csfh.c */
void fw_flexure_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    double r = in->radius_m, a = 0.5 * in->angle_rad, t = in->width_m, rho = in->fillet_m;
    double L = in->length_m, u = 0.5 * t / r, e = fw_flexure_neutral_offset(r, u);
    double dL = fw_flexure_root_length_m(t, rho), whole = L + 2 * dL;
    *f = (fw_flexure_shape){.kind = FW_FLEXURE_CSFH,
                            .length_m = L,
                            .radius_m = r,
                            .width_m = t,
                            .fillet_m = rho,
                            .half_angle_rad = a,
                            .sine = sin(a),
                            .cosine = cos(a),
                            .neutral_m = r - e,
                            .eccentric_m = e,
                            .golovin = fw_flexure_golovin(u),
                            .root_length_m = dL,
                            .root_block_m = fw_flexure_root_block_m(t, rho),
                            .whole_m = whole,
                            .fillet_concentration = fw_flexure_fillet_concentration(t, rho),
                            .curved = t / (3 * r)};
    f->centre_m = 2 * r * (f->neutral_m * f->sine + dL * f->cosine) / whole;
}

/* strain of the fibre over that of the beam, between the roots */
static double fibre_factor(const fw_flexure_shape *f, const fw_flexure_depth *depth) {
    return fmax((1 + f->curved) * depth->inner, (1 - f->curved) * depth->outer);
}

static fw_flexure_root_case root_case(const fw_flexure_shape *f, const fw_flexure_input *in,
                                      double poisson, double bow, int end) {
    return (fw_flexure_root_case){.width_m = f->width_m,
                                  .fillet_m = f->fillet_m,
                                  .depth_m = in->depth_m,
                                  .curved = f->curved,
                                  .poisson = poisson,
                                  .bow = bow,
                                  .end = end,
                                  .angle_rad = end * f->half_angle_rad};
}

/* ---- arcs of one modulus ---- */

/* compliance at W of a uniform modulus: that of a crystal below with what symmetry leaves, and
   rn^2 + e rn = r rn */
static void uniform_compliance(const fw_flexure_shape *f, const fw_flexure_input *in,
                               double softness, double C[3][3]) {
    double r = f->radius_m, rn = f->neutral_m, a = f->half_angle_rad, s = f->sine, c = f->cosine;
    double t = f->width_m, nu = in->poisson, X = f->centre_m, x = r * c - X, y = r * s;
    double per_EA = 1 / (in->youngs_Pa * in->depth_m * t), bend = per_EA / f->eccentric_m;
    double end = 12 / (t * t) * per_EA * 2 * f->root_length_m;
    double shear = 2.4 * (1 + nu) * r * per_EA;
    double along = bend * r * rn * (a - s * c) + end * (y * y);
    double across =
        bend * r * rn * (a + s * c) - bend * (2 * X * (2 * rn * s - X * a)) + end * (x * x);
    C[1][1] = along * softness + shear * (a + s * c);
    C[2][2] = across * softness + shear * (a - s * c);
    C[0][1] = C[1][0] = C[0][2] = C[2][0] = C[1][2] = C[2][1] = 0;
}

/* what both ends lose of an isotropic arc, m, and the share of its stiffness that this is */
static double ends_of_both(const fw_flexure_shape *f, const fw_flexure_input *in, double bow,
                           fw_flexure_result *out) {
    const double ends = 2 * fw_flexure_end_loss_m(in, bow, f->root_block_m);
    out->ends_lost = ends / (f->whole_m - ends);
    return ends;
}

/* circular arc of centre-line radius r, half-angle a, width t, depth h, L = 2 a r:
     K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy of the above
     eps/rad = t/(2 (L + 2 dL)) max(Kt (1 + t/3r) G, inside), G of fw_flexure_root_peak,
     inside = max((1 + t/3r) F_inner, (1 - t/3r) F_outer); beside it the fit Kt inside
   error: K 0.15-0.51 %, W 0.2 um, strain 0 to 4 % above 3-D finite elements.
   source: docs/theory/flexure.md eq. 1-11a; test_ladder.c, test_csfh.c, test_root_strain.c */
static void printed_arc(const fw_flexure_shape *f, const fw_flexure_input *in,
                        fw_flexure_result *out) {
    double t = f->width_m, E = in->youngs_Pa, EI = E * in->depth_m * t * t * t / 12;
    const fw_flexure_depth depth =
        fw_flexure_depth_factors(f->radius_m, t, in->depth_m, in->poisson);
    out->youngs_Pa = E, out->poisson = in->poisson;
    out->depth_factor = depth.stiffness;
    out->root_length_m = f->root_length_m;
    out->stiffness_thin = EI / f->length_m;
    out->stiffness_Nm_per_rad = EI * f->golovin * depth.stiffness / f->whole_m;
    uniform_compliance(f, in, depth.softness, out->compliance);
    out->compliance[0][0] = 1 / out->stiffness_Nm_per_rad;
    const fw_flexure_root_case root = root_case(f, in, in->poisson, depth.bow, 1);
    double ends = ends_of_both(f, in, depth.bow, out);
    out->ends_stiffer = 1 + out->ends_lost;
    fw_flexure_peak_strain(f, 0.5 * t / (f->whole_m - ends), fibre_factor(f, &depth),
                           fw_flexure_root_peak(&root, NULL), out);
    out->strain_fit_per_rad /= 1 + out->ends_lost; /* the fit has no ends */
}

/* ---- arcs of a crystal ---- */

/* What the harmonic cos 4(al0 + b) = cos 4al0 cos 4b - sin 4al0 sin 4b adds to the sums over an
   arc, b from -a to a: by J_n = int cos(n b) db = 2 sin(n a)/n, products of sines and cosines to
   sums, and sin 3a, sin 5a, sin 6a as sin a and sin 2a times sums of cos 2a and cos 4a (Dirichlet's
   kernel). Exact to some ulp of 1; test_crystal.c crystals_beside_plain_sums */
typedef struct harmonic {
    double w, x, xx, yy;     /* int cos 4b {1, cos b, cos^2 b, sin^2 b} db */
    double y, xy;            /* -int sin 4b {sin b, sin b cos b} db */
    double sin2, cos4, sin4; /* of 2a, 4a */
} harmonic;

static harmonic harmonic_of(double s, double c) {
    double s2 = 2 * s * c, c2 = (c - s) * (c + s), w = s2 * c2, c4 = (c2 - s2) * (c2 + s2);
    double kernel = 1 + 2 * c2, third = kernel / 3, fifth = (kernel + 2 * c4) / 5;
    double sixth = s2 / 6, square = sixth * (2 + c4);
    return (harmonic){.w = w,
                      .x = s * (fifth + third),
                      .xx = 0.5 * w + square,
                      .yy = 0.5 * w - square,
                      .y = s * (fifth - third),
                      .xy = sixth * (c4 - 1),
                      .sin2 = s2,
                      .cos4 = c4,
                      .sin4 = 2 * w};
}

/* of the arc in this material, whatever its width: 1/E summed along it, nu of the mean */
typedef struct arc_modulus {
    harmonic h;
    double along, across;                    /* a1 cos 4al0, a1 sin 4al0, 1/Pa */
    double weight, youngs_Pa, mean, poisson; /* int 1/E db; E, nu of the mean 1/E */
} arc_modulus;

static arc_modulus modulus_of(const fw_flexure_shape *f, const fw_flexure_crystal *k) {
    arc_modulus m = {.h = harmonic_of(f->sine, f->cosine)};
    double whole = 2 * f->half_angle_rad;
    m.along = k->a1_per_Pa * k->cos4, m.across = k->a1_per_Pa * k->sin4;
    m.weight = k->a0_per_Pa * whole + m.along * m.h.w;
    m.youngs_Pa = whole / m.weight, m.mean = m.weight / whole;
    m.poisson = -k->s12_per_Pa * m.youngs_Pa;
    return m;
}

/* Compliance at the centre of elastic weights W, the roots as weights dL/(EI) at the ends:
     W    = int P dw / int dw,  dw = db r/(EI), P at rn; dL/(EI) at r (cos a, -+ sin a)
            (dL/E of a crystal: fw_flexure_root_m_per_Pa)
     C_th = int dw / (D g),  g Golovin's factor
     C_xx = int y^2 dw + e rn int sin^2 dw' + r/k int cos^2 db/(GA),   dw' = db/(EAe D), y from W
     C_yy = int x^2 dw + e rn int cos^2 dw' + r/k int sin^2 db/(GA)
     C_xy = -int x y dw - e rn int sin cos dw' + r/k int sin cos db/(GA)
   Winkler's bending about the neutral radius takes axial force and its coupling to bending along:
   M^2/EAe - 2MN/EA + r N^2/EA = (M - eN)^2/EAe + rn N^2/EA. A pure moment has neither N nor V, so
   W is the true centre of compliance and C_th,x = C_th,y = 0 there; weights of the arc in C_th
   (Golovin) and in the rest (Winkler) differ by 0.4 (t/2r)^2 of themselves.
   Both ends lose d (fw_flexure_end_loss_of) at (r/(1 + q^2)) (c + q s, -+ (s - q c)), q = l/r: the
   mean of P over exp(-s/l). d counts as a root of that sign does. Beside it a uniform arc of the
   same rotational stiffness: modulus that of the mean compliance along the arc, nu of that modulus,
   both roots alike; its weight and the roots' are the same. The law at finite rotation knows
   uniform arcs only, with all that roots are at their ends; it takes the shares by which C_xx and
   C_yy differ. C = (bend/D + slide)/(h t). in: shape, h m, 1/E and 1/G 1/Pa, f; out: W m, C h t in
   m^2/Pa. Valid t/r <= 0.3. Error against 3-D finite elements, real roots: 0.3 % in C_th, W 0.1 um.
   source: docs/theory/flexure-silicon.md eq. 1-4, 13; test_ladder.c, test_crystal.c
   crystals_beside_plain_sums */
typedef struct compliance_sum {
    double xx, yy; /* C_xx, C_yy */
} compliance_sum;

typedef struct arc_compliance {
    compliance_sum bend, slide, even_bend, even_slide;
    double bend_xy, slide_xy, X, Y; /* W */
    double roots, weight;           /* (dL - d)/E of both; int ds/E with that */
} arc_compliance;

/* what both ends add to the weight and take from it, and where */
typedef struct arc_ends {
    double roots, other; /* sum of both dL/E, second less first */
    double lost;         /* 2 d/E */
    double x, y;         /* of the roots: r cos a, r sin a */
    double lx, ly;       /* of what is lost */
} arc_ends;

static arc_ends ends_of(const fw_flexure_shape *f, const fw_flexure_crystal *k,
                        const arc_modulus *m, double depth_m, double bow) {
    double r = f->radius_m, s = f->sine, c = f->cosine, dL = f->root_length_m;
    double spare = dL - f->root_block_m; /* fw_flexure_root_m_per_Pa, sum and difference: */
    const fw_flexure_end_loss loss =
        fw_flexure_end_loss_of(k, depth_m, bow, f->length_m, f->root_block_m);
    double q = loss.reach_m / r, in = r / (1 + q * q);
    return (arc_ends){.roots = 2 * (dL * k->a0_per_Pa + spare * (m->along * m->h.cos4)),
                      .other = -2 * (spare * (m->across * m->h.sin4)),
                      .lost = 2 * k->bow_per_Pa * loss.length_m,
                      .x = r * c,
                      .y = r * s,
                      .lx = in * (c + q * s),
                      .ly = in * (s - q * c)};
}

/* 1/G goes by -4 times what 1/E does (flexure_section.c) */
static arc_compliance compliance_of(const fw_flexure_shape *f, const fw_flexure_crystal *k,
                                    const arc_modulus *m, const arc_ends *at) {
    double a = f->half_angle_rad, s = f->sine, r = f->radius_m, rn = f->neutral_m, t = f->width_m;
    double a0 = k->a0_per_Pa, rr = r * rn, sc = 0.5 * m->h.sin2, less = a - sc, more = a + sc;
    double kept = at->roots - at->lost, weight = r * m->weight + kept;
    double bend = 1 / f->eccentric_m, end = 12 / (t * t), aside = at->y * at->other;
    double first = 2 * s * a0 + m->along * m->h.x, second = m->across * m->h.y;
    double X = (rr * first + at->x * at->roots - at->lost * at->lx) / weight;
    double Y = (rr * second + aside) / weight, x = at->x - X, lost_x = at->lx - X;
    double even_X = (rr * (2 * s * m->mean) + at->x * kept) / weight, even_x = at->x - even_X;
    double wave_yy = m->along * m->h.yy, wave_xx = m->along * m->h.xx, xy = m->across * m->h.xy;
    double turn_x = 2 * rn * first - m->weight * X, turn_y = 2 * rn * second - m->weight * Y;
    double slide = 1.2 * r, g0 = k->g0_per_Pa, even = bend * m->mean;
    double even_slide = slide * (2 + 2 * m->poisson) * m->mean, held = end * at->roots;
    double lost = end * at->lost, y2 = at->y * at->y, ly2 = at->ly * at->ly;
    return (arc_compliance){
        .bend = {bend * (rr * (a0 * less + wave_yy) - Y * turn_y) + held * (y2 + Y * Y) -
                     2 * end * Y * aside - lost * (ly2 + Y * Y),
                 bend * (rr * (a0 * more + wave_xx) - X * turn_x) + held * (x * x) -
                     lost * (lost_x * lost_x)},
        .slide = {slide * (g0 * more - 4 * wave_xx), slide * (g0 * less - 4 * wave_yy)},
        .even_bend = {even * rr * less + end * kept * y2,
                      even * (rr * more - even_X * (4 * rn * s - 2 * a * even_X)) +
                          end * kept * (even_x * even_x)},
        .even_slide = {even_slide * more, even_slide * less},
        .bend_xy = x * (held * Y - end * aside) - lost * (lost_x * Y) -
                   bend * (rr * xy - 0.5 * (X * turn_y + Y * turn_x)),
        .slide_xy = -4 * slide * xy,
        .X = X,
        .Y = Y,
        .roots = kept,
        .weight = weight};
}

/* Kt G of the worse root: directions 4a - 4al0 and 4a + 4al0, the first mirrored */
static double root_peak(const fw_flexure_shape *f, const fw_flexure_input *in, double poisson,
                        double bow) {
    const fw_flexure_root_case first = root_case(f, in, poisson, bow, -1),
                               second = root_case(f, in, poisson, bow, 1);
    return fmax(fw_flexure_root_peak(&first, &in->crystal),
                fw_flexure_root_peak(&second, &in->crystal));
}

/* Of a crystal the fibre between the roots by its stress, where the arc is stiffest: (14a), which grows with E and
   with -cos 4 psi. Test: test_path.c one_arc_is_a_csfh, whose path looks at all places */
static double stress_factor(const fw_flexure_shape *f, const fw_flexure_input *in,
                            const fw_flexure_depth *depth) {
    const fw_flexure_crystal *k = &in->crystal;
    double strain = fibre_factor(f, depth), deep = in->depth_m / sqrt(f->radius_m * f->width_m);
    if (!k->known) return strain;
    double stiffest = k->a1_per_Pa > 0 ? FW_PI : 0;
    double b = 0.25 * remainder(stiffest - atan2(k->sin4, k->cos4), FW_TURN);
    if (fabs(b) > f->half_angle_rad) b = copysign(f->half_angle_rad, b);
    double stress = fw_flexure_depth_stress(deep, k, b, f->curved);
    return fmax(strain, stress * depth->stiffness * f->golovin);
}

/* the arc of a crystal: K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy of the above,
     sigma/rad = t/(2 int ds/E) max(Kt G, inside), G of the worse root, eps = sigma/E
   the integral without d, with which G was found
   docs/theory/flexure-silicon.md eq. 12-14; test_crystal.c, test_root_strain.c */
static void elastic_arc(const fw_flexure_shape *f, const fw_flexure_input *in,
                        fw_flexure_result *out) {
    double t = f->width_m, h = in->depth_m, I = h * t * t * t / 12, A = h * t;
    const fw_flexure_crystal material = fw_flexure_elastic_of(in), *k = &material;
    const arc_modulus m = modulus_of(f, k);
    const fw_flexure_depth depth =
        fw_flexure_depth_crystal(h / sqrt(f->radius_m * t), k, m.youngs_Pa);
    const arc_ends at = ends_of(f, k, &m, h, depth.bow);
    const arc_compliance o = compliance_of(f, k, &m, &at);
    double soft = depth.softness, K = f->golovin * depth.stiffness * I / o.weight;
    double xx = o.bend.xx * soft + o.slide.xx, yy = o.bend.yy * soft + o.slide.yy;
    out->stiffness_Nm_per_rad = K;
    out->stiffness_thin = m.youngs_Pa * I / f->length_m;
    out->compliance[0][0] = 1 / K;
    out->compliance[0][1] = out->compliance[1][0] = out->compliance[0][2] = 0;
    out->compliance[2][0] = 0;
    out->compliance[1][1] = xx / A, out->compliance[2][2] = yy / A;
    out->compliance[1][2] = out->compliance[2][1] = (o.bend_xy * soft + o.slide_xy) / A;
    out->uneven_x = xx / (o.even_bend.xx * soft + o.even_slide.xx) - 1;
    out->uneven_y = yy / (o.even_bend.yy * soft + o.even_slide.yy) - 1;
    out->root_length_m = 0.5 * o.roots * m.youngs_Pa;
    out->offset_m[0] = o.X - f->centre_m, out->offset_m[1] = o.Y;
    out->youngs_Pa = m.youngs_Pa, out->poisson = m.poisson;
    out->depth_factor = depth.stiffness;
    fw_flexure_peak_strain(f, 0.5 * t / (o.weight * in->youngs_Pa), stress_factor(f, in, &depth),
                           root_peak(f, in, m.poisson, depth.bow), out);
    out->strain_fit_per_rad *= fibre_factor(f, &depth) / out->fibre;
    if (in->crystal.known) return;
    (void)ends_of_both(f, in, depth.bow, out);
    out->strain_fit_per_rad /= 1 + out->ends_lost; /* the fit has no ends */
}

void fw_flexure_csfh(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    if (!in->crystal.known && !in->ends)
        printed_arc(f, in, out);
    else
        elastic_arc(f, in, out);
}

/* ---- leaves ---- */

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
    double lost = 0, lost_arm = 0, more = 0;
    if (k->known) {
        E = 1 / (k->a0_per_Pa + k->a1_per_Pa * k->cos4);
        G = 1 / (k->g0_per_Pa + k->g1_per_Pa * k->cos4);
        nu = -k->s12_per_Pa * E;
        const fw_flexure_end_loss end = fw_flexure_end_loss_of(k, h, 1, L, f->root_block_m);
        lost = E * k->bow_per_Pa * end.length_m, lost_arm = 0.5 * L - end.reach_m;
        dL = E * fw_flexure_root_m_per_Pa(f, k, k->cos4);
        more = 2 * fw_flexure_straight_more_m(t, f->fillet_m); /* G was found without */
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
    const double both = in->crystal.known ? 0 : 2 * fw_flexure_end_loss_m(in, 1, f->root_block_m);
    const double apart = k->known ? 0 : both;
    out->ends_stiffer = whole / (whole - apart);
    out->ends_lost = both / (whole - apart);
    fw_flexure_peak_strain(f, 0.5 * t / (whole - apart - more) * (k->known ? E / in->youngs_Pa : 1),
                           1, fw_flexure_root_peak(&root, &in->crystal), out);
    out->strain_fit_per_rad /= 1 + out->ends_lost; /* the fit has no ends */
}
