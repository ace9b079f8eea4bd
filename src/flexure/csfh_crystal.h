/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arcs of a crystal whose modulus goes by direction: the laws, of one hinge or four at once
   (lanes.h). Private to the room. */
#ifndef FW_FLEXURE_CSFH_CRYSTAL_H
#define FW_FLEXURE_CSFH_CRYSTAL_H
#include "flexure/csfh_core.h"

/* What the harmonic cos 4(al0 + b) = cos 4al0 cos 4b - sin 4al0 sin 4b adds to the sums over an
   arc, b from -a to a: by J_n = int cos(n b) db = 2 sin(n a)/n, products of sines and cosines to
   sums, and sin 3a, sin 5a, sin 6a as sin a and sin 2a times sums of cos 2a and cos 4a (Dirichlet's
   kernel). Exact to some ulp of 1; test_crystal.c sums_are_the_integrals */
typedef struct harmonic {
    fw_flexure_real w, x, xx, yy;     /* int cos 4b {1, cos b, cos^2 b, sin^2 b} db */
    fw_flexure_real y, xy;            /* -int sin 4b {sin b, sin b cos b} db */
    fw_flexure_real sin2, cos4, sin4; /* of 2a, 4a */
} harmonic;

FW_INLINE harmonic harmonic_of(fw_flexure_real s, fw_flexure_real c) {
    fw_flexure_real s2 = (s + s) * c, c2 = (c - s) * (c + s), w = s2 * c2,
                    c4 = (c2 - s2) * (c2 + s2);
    fw_flexure_real kernel = 1 + (c2 + c2), third = (1 / 3.0) * kernel,
                    fifth = 0.2 * (kernel + (c4 + c4));
    fw_flexure_real sixth = (1 / 6.0) * s2, square = sixth * (2 + c4), half = 0.5 * w;
    return (harmonic){.w = w,
                      .x = s * (fifth + third),
                      .xx = half + square,
                      .yy = half - square,
                      .y = s * (fifth - third),
                      .xy = sixth * (c4 - 1),
                      .sin2 = s2,
                      .cos4 = c4,
                      .sin4 = w + w};
}

/* of the arc in this material, whatever its width: 1/E summed along it, nu of the mean */
typedef struct soft {
    harmonic h;
    fw_flexure_real along, across;                    /* a1 cos 4al0, a1 sin 4al0, 1/Pa */
    fw_flexure_real weight, youngs_Pa, mean, poisson; /* int 1/E db; E, nu of the mean 1/E */
} soft;

FW_INLINE soft soft_of(const fw_flexure_crystal *k, fw_flexure_real a, fw_flexure_real s,
                       fw_flexure_real c) {
    soft m = {.h = harmonic_of(s, c)};
    fw_flexure_real whole = a + a;
    m.along = k->a1_per_Pa * k->cos4, m.across = k->a1_per_Pa * k->sin4;
    m.weight = k->a0_per_Pa * whole + m.along * m.h.w;
    const fw_flexure_both quotient = fw_quotients(whole, m.weight, m.weight, whole);
    m.youngs_Pa = fw_first(quotient), m.mean = fw_second(quotient),
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
   Both ends lose d (fw_end_loss_of) at (r/(1 + q^2)) (c + q s, -+ (s - q c)), q = l/r: the mean of
   P over exp(-s/l). d counts as a root of that sign does. Beside it a uniform arc of the same
   rotational stiffness: modulus that of the mean compliance along the arc, nu of that modulus, both
   roots alike; its weight and the roots' are the same. The law at finite rotation knows uniform
   arcs only, with all that roots are at their ends; it takes the shares by which C_xx and C_yy
   differ. C = (bend/D + slide)/(h t). in: shape, h m, 1/E and 1/G 1/Pa, f; out: W m, C h t in
   m^2/Pa. Valid t/r <= 0.3. Error against 3-D finite elements, real roots: 0.3 % in C_th, W 0.1 um.
   Cost 12 ns. source: docs/theory/flexure-silicon.md eq. 1-4, 13; test_ladder.c, test_crystal.c
   crystals_beside_plain_sums */
typedef struct flat_sum {
    fw_flexure_real xx, yy; /* C_xx, C_yy */
} flat_sum;

typedef struct flat {
    flat_sum bend, slide, even_bend, even_slide;
    fw_flexure_real bend_xy, slide_xy, X, Y; /* W */
    fw_flexure_real roots, per;              /* (dL - d)/E of both; 1/int ds/E */
    fw_flexure_real per_whole;               /* with dL alone */
} flat;

/* 1/G goes by -4 times what 1/E does (crystal.c) */
FW_INLINE flat flat_of(const fw_flexure_shape *f, const fw_flexure_crystal *k, const soft *m,
                       fw_flexure_real depth_m, fw_flexure_real bow) {
    fw_flexure_real a = f->half_angle_rad, s = f->sine, c = f->cosine, r = f->radius_m,
                    rn = f->neutral_m;
    fw_flexure_real dL = f->root_length_m, a0 = k->a0_per_Pa, rr = r * rn, sc = 0.5 * m->h.sin2;
    fw_flexure_real spare =
        dL - f->root_block_m; /* fw_flexure_root_m_per_Pa, sum and difference: */
    fw_flexure_real waved = dL * a0 + spare * (m->along * m->h.cos4), roots = waved + waved;
    fw_flexure_real other = -2 * (spare * (m->across * m->h.sin4)), rx = r * c, ry = r * s;
    fw_flexure_real l = fw_end_reach(k->reach, depth_m, bow, f->length_m),
                    q = l * (f->per_rt * f->width_m);
    const fw_flexure_both ends = fw_quotients(r, bow * (l * l), 1 + q * q, l + f->root_block_m);
    fw_flexure_real in = fw_first(ends),
                    lost = 2 * k->bow_per_Pa * fw_second(ends); /* fw_end_loss_of */
    fw_flexure_real kept = roots - lost, arc = r * m->weight;
    const fw_flexure_both weights = fw_quotients(fw_all(1), fw_all(1), arc + roots, arc + kept);
    fw_flexure_real lx = in * (c + q * s), ly = in * (s - q * c);
    fw_flexure_real per = fw_second(weights), bend = f->per_eccentric, end = f->per_section;
    fw_flexure_real first = (s + s) * a0 + m->along * m->h.x, second = m->across * m->h.y;
    fw_flexure_real held = rx * roots, aside = ry * other;
    fw_flexure_real X = (rr * first + held - lost * lx) * per, Y = (rr * second + aside) * per;
    fw_flexure_real even_X = (rr * ((s + s) * m->mean) + rx * kept) * per, x = rx - X,
                    even_x = rx - even_X;
    fw_flexure_real less = a - sc, more = a + sc, twice = rn + rn, ry2 = ry * ry;
    fw_flexure_real wave_yy = m->along * m->h.yy, wave_xx = m->along * m->h.xx,
                    xy = m->across * m->h.xy;
    fw_flexure_real turn_x = twice * first - m->weight * X, turn_y = twice * second - m->weight * Y;
    fw_flexure_real slide = 1.2 * r, g0 = k->g0_per_Pa, flat_end = end * roots,
                    flat_bend = bend * m->mean;
    fw_flexure_real flat_lost = end * lost, flat_kept = end * kept, lost_x = lx - X;
    fw_flexure_real even_slide = slide * ((2 + 2 * m->poisson) * m->mean), even_rr = flat_bend * rr;
    fw_flexure_real yaw = Y * aside;
    return (flat){
        .bend = {bend * (rr * (a0 * less + wave_yy) - Y * turn_y) +
                     (flat_end * (ry2 + Y * Y) - end * (yaw + yaw)) - flat_lost * (ly * ly + Y * Y),
                 bend * (rr * (a0 * more + wave_xx) - X * turn_x) + flat_end * (x * x) -
                     flat_lost * (lost_x * lost_x)},
        .slide = {slide * (g0 * more - 4 * wave_xx), slide * (g0 * less - 4 * wave_yy)},
        .even_bend = {even_rr * less + flat_kept * ry2,
                      even_rr * more - flat_bend * (even_X * (twice * (s + s) - (a + a) * even_X)) +
                          flat_kept * (even_x * even_x)},
        .even_slide = {even_slide * more, even_slide * less},
        .bend_xy = x * (flat_end * Y - end * aside) - flat_lost * (lost_x * Y) -
                   bend * (rr * xy - 0.5 * (X * turn_y + Y * turn_x)),
        .slide_xy = -4 * slide * xy,
        .X = X,
        .Y = Y,
        .roots = kept,
        .per = per,
        .per_whole = fw_first(weights)};
}

typedef struct ends { /* what the direction does to the stress of the roots */
    fw_flexure_root_crystal law;
    fw_flexure_root_worst worst; /* of both */
} ends;

/* 4 psi of the roots: 4a - 4al0 and 4a + 4al0, the first mirrored (section_core.h) */
FW_INLINE ends ends_of(const fw_flexure_shape *f, const fw_flexure_crystal *k, const soft *m) {
    ends e = {.law = fw_root_crystal_of(k->share, f->fillet_ratio,
                                        fw_notch_of(f->fillet_concentration), f->curved)};
    e.worst =
        FW_IF_USUAL(k->aligned, fw_root_crystal_at(&e.law, k->cos4, k->sin4, m->h.cos4, m->h.sin4),
                    fw_root_crystal_any(&e.law));
    return e;
}

/* the arc of a crystal: K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy of the above,
     sigma/rad = t/(2 int ds/E) max(Kt G, inside), G of the worse root, eps = sigma/E
   the integral without d, with which G was found
   docs/theory/flexure-silicon.md eq. 12-14; test_crystal.c, test_root_strain.c */
FW_INLINE void crystal_arc(const fw_flexure_shape *f, const fw_flexure_input *in, const soft *m,
                           const flat *o, const ends *e, const fw_flexure_depth *depth,
                           fw_flexure_real per_A, fw_flexure_result *out) {
    fw_flexure_real t = f->width_m, I = (in->depth_m * t) * (t * t) * (1 / 12.0);
    fw_flexure_real K = f->golovin * depth->stiffness * I * o->per;
    fw_flexure_real soft_D = depth->softness;
    fw_flexure_real xx = o->bend.xx * soft_D + o->slide.xx, yy = o->bend.yy * soft_D + o->slide.yy;
    out->stiffness_Nm_per_rad = K;
    out->stiffness_thin = m->youngs_Pa * I * f->per_length;
    out->compliance[0][0] = 1 / K;
    out->compliance[0][1] = out->compliance[1][0] = fw_all(0);
    out->compliance[0][2] = out->compliance[2][0] = fw_all(0);
    out->compliance[1][1] = xx * per_A, out->compliance[2][2] = yy * per_A;
    out->compliance[1][2] = out->compliance[2][1] = (o->bend_xy * soft_D + o->slide_xy) * per_A;
    out->uneven_x = xx / (o->even_bend.xx * soft_D + o->even_slide.xx) - 1;
    out->uneven_y = yy / (o->even_bend.yy * soft_D + o->even_slide.yy) - 1;
    out->root_length_m = 0.5 * o->roots * m->youngs_Pa;
    out->offset_m[0] = o->X - f->centre_m, out->offset_m[1] = o->Y;
    out->youngs_Pa = m->youngs_Pa, out->poisson = m->poisson;
    out->depth_factor = depth->stiffness;
    fw_flexure_real u = f->curved,
                    inside = fw_larger((1 + u) * depth->inner, (1 - u) * depth->outer);
    fw_flexure_real h = in->depth_m, nu = m->poisson;
    fw_flexure_real rise =
        fw_root_crystal_peak(&e->law, &e->worst, h / (h + 4 * t), nu, nu * depth->bow);
    fw_peak_strain(f, 0.5 * t * o->per_whole / in->youngs_Pa, inside,
                   f->fillet_concentration * rise, out);
}

/* as fw_flexure_csfh_at_once: the depth factor on its way while the outline is worked out */
FW_INLINE void fw_crystal_arc_at_once(const fw_flexure_input *in, bool usual,
                                      fw_flexure_result *out) {
    fw_flexure_shape f;
    fw_flexure_real s, c, h = in->depth_m;
    fw_arc_sine(in, usual, &s, &c);
    const soft m = soft_of(&in->crystal, 0.5 * in->angle_rad, s, c);
    const fw_flexure_depth_start start = fw_depth_start_crystal(
        h * h * (1 / (in->radius_m * in->width_m)), &in->crystal, m.youngs_Pa);
    fw_arc_outline(in, usual, s, c, &f);
    const ends e = ends_of(&f, &in->crystal, &m);
    const fw_flexure_depth depth = fw_arc_depth(&start, usual);
    const flat o = flat_of(&f, &in->crystal, &m, h, depth.bow);
    fw_flexure_real per_A = 1 / (h * f.width_m), wide = fw_arc_widened(&f, in, usual);
    out->centre_m = f.centre_m;
    crystal_arc(&f, in, &m, &o, &e, &depth, per_A, out);
    fw_stiffness_and_limit(&f, in, out);
    fw_isotropic_errors(&f, in, out, m.mean * f.per_section * per_A * depth.softness, wide,
                        &out->error);
    fw_crystal_errors(&f, &in->crystal, wide, &out->error);
    out->error.outside = FW_IF_USUAL(usual, false, wide > 1);
}

#endif
