/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arcs of a crystal whose modulus goes by direction. */
#include "flexure/csfh_core.h"
#include "flexure/kinds.h"

/* What the harmonic cos 4(al0 + b) = cos 4al0 cos 4b - sin 4al0 sin 4b adds to the sums over an
   arc, b from -a to a: by J_n = int cos(n b) db = 2 sin(n a)/n, products of sines and cosines to
   sums. Sines of multiples by doubling and adding, from sin a and cos a alone. Exact to some
   ulp of 1; test_crystal.c sums_are_the_integrals */
typedef struct harmonic {
    double w, x, xx, yy; /* int cos 4b {1, cos b, cos^2 b, sin^2 b} db */
    double y, xy;        /* -int sin 4b {sin b, sin b cos b} db */
    double cos4, sin4;   /* of 4a */
} harmonic;

FW_INLINE harmonic harmonic_of(double s, double c) {
    double s2 = 2 * s * c, c2 = (c - s) * (c + s), s4 = 2 * s2 * c2, c4 = (c2 - s2) * (c2 + s2);
    double J3 = (2 / 3.0) * (s2 * c + c2 * s), J5 = (2 / 5.0) * (s4 * c + c4 * s);
    double half4 = 0.25 * s4, J6 = (1 / 3.0) * (s4 * c2 + c4 * s2), square = 0.25 * (J6 + s2);
    return (harmonic){.w = half4 + half4,
                      .x = 0.5 * (J5 + J3),
                      .xx = half4 + square,
                      .yy = half4 - square,
                      .y = 0.5 * (J5 - J3),
                      .xy = 0.25 * (J6 - s2),
                      .cos4 = c4,
                      .sin4 = s4};
}

void fw_arc_sums_of(double a, double s, double c, fw_arc_sums *even, fw_arc_sums *along,
                    fw_arc_sums *across) {
    const harmonic h = harmonic_of(s, c);
    *even = (fw_arc_sums){.w = 2 * a, .x = 2 * s, .xx = a + s * c, .yy = a - s * c};
    *along = (fw_arc_sums){.w = h.w, .x = h.x, .xx = h.xx, .yy = h.yy};
    *across = (fw_arc_sums){.y = h.y, .xy = h.xy};
}

/* of the arc in this material, whatever its width: 1/E summed along it, nu of the mean */
typedef struct soft {
    harmonic h;
    double along, across; /* a1 cos 4al0, a1 sin 4al0, 1/Pa */
    double weight;        /* int 1/E db */
    double lateral;       /* -s12 2a: nu times the weight */
} soft;

FW_INLINE soft soft_of(const fw_crystal *k, double a, double s, double c) {
    soft m = {.h = harmonic_of(s, c), .lateral = -k->s12_per_Pa * (a + a)};
    m.along = k->a1_per_Pa * k->cos4, m.across = k->a1_per_Pa * k->sin4;
    m.weight = k->a0_per_Pa * (a + a) + (m.along * ((c - s) * (c + s))) * (2 * s * c);
    return m;
}

/* Compliance at the centre of elastic weights W, the roots as weights dL/(EI) at the ends:
     W    = int P dw / int dw,  dw = db r/(EI), P at rn; dL/(EI) at r (cos a, -+ sin a)
            (dL/E of a crystal: fw_root_m_per_Pa)
     C_th = int dw / (D g),  g Golovin's factor
     C_xx = int y^2 dw + e rn int sin^2 dw' + r/k int cos^2 db/(GA),   dw' = db/(EAe D), y from W
     C_yy = int x^2 dw + e rn int cos^2 dw' + r/k int sin^2 db/(GA)
     C_xy = -int x y dw - e rn int sin cos dw' + r/k int sin cos db/(GA)
   Winkler's bending about the neutral radius takes axial force and its coupling to bending along:
   M^2/EAe - 2MN/EA + r N^2/EA = (M - eN)^2/EAe + rn N^2/EA. A pure moment has neither N nor V, so
   W is the true centre of compliance and C_th,x = C_th,y = 0 there; weights of the arc in C_th
   (Golovin) and in the rest (Winkler) differ by 0.4 (t/2r)^2 of themselves.
   Beside it a uniform arc of the same rotational stiffness: modulus that of the mean compliance
   along the arc, nu of that modulus, both roots alike; its weight and the roots' are the same. The
   law at finite rotation knows uniform arcs only; it takes the shares by which C_xx and C_yy
   differ. What does not hang on the depth h is here: C = (bend/D + slide)/(h t). in: shape m, 1/E
   and 1/G 1/Pa; out: W m, C h t in m^2/Pa. Valid t/r <= 0.3. Error against 3-D finite elements,
   real roots: 0.4 % in C_th, 1 % in C_xx, 1.4 % in C_yy. Cost 10 ns. source: docs/theory/flexure.md
   eq. 1-4, 13; test_ladder.c, test_crystal.c crystals_beside_plain_sums */
typedef struct flat {
    fw_pair bend, slide, even_bend, even_slide; /* xx and yy */
    double bend_xy, slide_xy, centre_m[2];
    double youngs_Pa, poisson, mean, roots, per; /* E, nu, 1/E; dL/E of both; 1/int ds/E */
} flat;

FW_INLINE flat flat_of(const fw_flexure_shape *f, const fw_crystal *k, const soft *m) {
    double a = f->half_angle_rad, s = f->sine, c = f->cosine, r = f->radius_m, rn = f->neutral_m;
    const harmonic *h = &m->h;
    const fw_pair twice = {a + a, m->weight}, quotient = twice / (fw_pair){m->weight, a + a};
    double mean = quotient[1], nu = -k->s12_per_Pa * quotient[0];
    double spare = f->root_length_m - f->root_block_m; /* fw_root_m_per_Pa, sum and difference: */
    double roots = 2 * (f->root_length_m * k->a0_per_Pa + spare * (m->along * h->cos4));
    double other = -2 * spare * (m->across * h->sin4), rx = r * c, ry = r * s, rr = r * rn;
    double per = 1 / (r * m->weight + roots);
    double first = 2 * s * k->a0_per_Pa + m->along * h->x, second = m->across * h->y;
    double X = (rr * first + rx * roots) * per, Y = (rr * second + ry * other) * per;
    double even_X = (2 * rr * s * mean + rx * roots) * per, x = rx - X, even_x = rx - even_X;
    double sc = s * c, bend = f->per_eccentric, end = f->per_section, slide = 1.2 * r;
    double g1 = k->g1_per_Pa * k->cos4;
    fw_pair less = {a - sc, a + sc}, more = {a + sc, a - sc}, W = {Y, X};
    fw_pair square = k->a0_per_Pa * less + m->along * (fw_pair){h->yy, h->xx};
    fw_pair bent = rr * square - W * ((rn + rn) * (fw_pair){second, first} - m->weight * W);
    fw_pair ends = {roots * (ry * ry + Y * Y) - 2 * ry * Y * other, roots * x * x};
    fw_pair even = {rr * less[0], rr * less[1] - even_X * (4 * rn * s - 2 * a * even_X)};
    fw_pair even_ends = roots * (fw_pair){ry * ry, even_x * even_x};
    return (flat){.bend = bend * bent + end * ends,
                  .slide = slide * (k->g0_per_Pa * more + g1 * (fw_pair){h->xx, h->yy}),
                  .even_bend = (bend * mean) * even + end * even_ends,
                  .even_slide = (slide * (2 + 2 * nu) * mean) * more,
                  .bend_xy = -end * x * (ry * other - Y * roots) -
                             bend * (rr * (m->across * h->xy) - rn * (X * second + Y * first) +
                                     X * Y * m->weight),
                  .slide_xy = slide * (k->g1_per_Pa * k->sin4 * h->xy),
                  .centre_m = {X, Y},
                  .youngs_Pa = quotient[0],
                  .poisson = nu,
                  .mean = mean,
                  .roots = roots,
                  .per = per};
}

/* as fw_depth_start_of, but without waiting for nu = p/w, w = int 1/E db, p = -s12 2a:
     x^2 = h^2/(r t) (3 (1 - nu^2))^(1/2) = h^2/(r t w) (3 (w^2 - p^2))^(1/2) */
FW_INLINE fw_depth_start start_of(const soft *m, double square) {
    const double sqrt3 = 1.7320508075688773;
    double w = m->weight, p = m->lateral, left = (w - p) * (w + p), root = sqrt(left);
    double per_w = 1 / w, per_w2 = per_w * per_w;
    const fw_pair quotient = (fw_pair){p * (1 / sqrt3), w * w} / (fw_pair){root, left};
    return (fw_depth_start){.x = sqrt(square * sqrt3 * per_w * root),
                            .nu2 = p * p * per_w2,
                            .rest = left * per_w2,
                            .per = quotient[1],
                            .unit = quotient[0]};
}

/* the worse of both roots; the sine of the first is that of its mirror image (section_core.h) */
FW_INLINE double root_of(const fw_flexure_shape *f, const fw_crystal *k, const soft *m, double h,
                         double nu, double bow) {
    double x = f->fillet_ratio, Kt = f->fillet_concentration, q = fw_notch_of(Kt), u = f->curved;
    double H = Kt * fw_root_crystal_rise(x, q, h / (h + 4 * f->width_m), nu, nu * bow, u);
    const fw_root_crystal root = fw_root_crystal_of(k->share, x, q, u);
    if (!k->aligned) return H * (1 + u) * (root.even + hypot(root.along, root.across));
    double cc = k->cos4 * m->h.cos4, ss = k->sin4 * m->h.sin4;
    double sc = k->sin4 * m->h.cos4, cs = k->cos4 * m->h.sin4;
    return H * fw_larger(fw_root_crystal_at(&root, u, cc - ss, sc + cs),
                         fw_root_crystal_at(&root, u, cc + ss, cs - sc));
}

/* the arc of a crystal: K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy of the above,
     sigma/rad = t/(2 int ds/E) max(Kt G, inside), G of the worse root, eps = sigma/E
   docs/theory/flexure.md eq. 12-14; test_crystal.c, test_root_strain.c */
FW_INLINE void crystal_arc(const fw_flexure_shape *f, const fw_flexure_input *in, const soft *m,
                           const flat *o, const fw_depth *depth, double per_A,
                           fw_flexure_result *out) {
    double t = f->width_m, I = in->depth_m * t * t * t * (1 / 12.0);
    double K = f->golovin * depth->stiffness * I * o->per;
    fw_pair C = o->bend * depth->softness + o->slide;
    fw_pair uneven = C / (o->even_bend * depth->softness + o->even_slide);
    C *= per_A;
    out->stiffness_Nm_per_rad = K;
    out->stiffness_thin = o->youngs_Pa * I * f->per_length;
    out->compliance[0][0] = 1 / K;
    out->compliance[0][1] = out->compliance[1][0] = 0;
    out->compliance[0][2] = out->compliance[2][0] = 0;
    out->compliance[1][1] = C[0], out->compliance[2][2] = C[1];
    out->compliance[1][2] = out->compliance[2][1] =
        (o->bend_xy * depth->softness + o->slide_xy) * per_A;
    out->uneven_x = uneven[0] - 1, out->uneven_y = uneven[1] - 1;
    out->root_length_m = 0.5 * o->roots * o->youngs_Pa;
    out->offset_m[0] = o->centre_m[0] - f->centre_m, out->offset_m[1] = o->centre_m[1];
    out->youngs_Pa = o->youngs_Pa, out->poisson = o->poisson;
    out->depth_factor = depth->stiffness;
    double u = f->curved, inside = fw_larger((1 + u) * depth->inner, (1 - u) * depth->outer);
    fw_peak_strain(f, 0.5 * t * o->per / in->youngs_Pa, inside,
                   root_of(f, &in->crystal, m, in->depth_m, o->poisson, depth->bow), out);
}

void fw_flexure_crystal_arc(const fw_flexure_shape *f, const fw_flexure_input *in,
                            fw_flexure_result *out) {
    double h = in->depth_m, deep = h * f->per_root_rt;
    const soft m = soft_of(&in->crystal, f->half_angle_rad, f->sine, f->cosine);
    const fw_depth_start start = start_of(&m, deep * deep);
    const flat o = flat_of(f, &in->crystal, &m);
    const fw_depth depth = fw_depth_law(&start);
    crystal_arc(f, in, &m, &o, &depth, 1 / (h * f->width_m), out);
}

/* as fw_csfh_at_once: the depth factor on its way while the outline is worked out */
void fw_crystal_at_once(const fw_flexure_input *in, fw_flexure_result *out) {
    fw_flexure_shape f;
    double s, c, a = 0.5 * in->angle_rad, h = in->depth_m;
    fw_quick_sincos(a, &s, &c);
    const soft m = soft_of(&in->crystal, a, s, c);
    const fw_depth_start start = start_of(&m, h * h / (in->radius_m * in->width_m));
    fw_arc_outline(in, s, c, &f);
    const flat o = flat_of(&f, &in->crystal, &m);
    const fw_depth depth = fw_depth_law(&start);
    fw_shape_marks(&f);
    double per_A = 1 / (h * f.width_m), wide = fw_errors_widened(&f, h);
    out->centre_m = f.centre_m;
    crystal_arc(&f, in, &m, &o, &depth, per_A, out);
    fw_stiffness_and_limit(&f, in, out);
    fw_isotropic_errors(&f, in, out, o.mean * f.per_section * per_A * depth.softness, wide,
                        &out->error);
    fw_crystal_errors(&f, &in->crystal, wide, &out->error);
    out->error.outside = wide > 1;
}
