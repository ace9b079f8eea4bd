/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/kinds.h"
#include "flexure/section.h"
#include <math.h>

/* moments of the arc with weight 1, cos 4b and -sin 4b, by J_n = int cos(n b) db = 2 sin(n a)/n:
   products of sines and cosines to sums. Exact; test_crystal.c sums_are_the_integrals */
static void sums_of(fw_flexure_shape *f) {
    double a = f->half_angle_rad, s = f->sine, c = f->cosine, J[7] = {2 * a, 2 * s};
    double before = 0, now = s; /* sin (n - 1) a, sin n a */
    for (int n = 2; n <= 6; n++) {
        double next = 2 * c * now - before;
        before = now, now = next;
        J[n] = 2 * now / n;
    }
    double square = 0.25 * (J[6] + J[2]);
    f->even = (fw_arc_sums){.w = J[0], .x = J[1], .xx = a + s * c, .yy = a - s * c};
    f->along = (fw_arc_sums){
        .w = J[4], .x = 0.5 * (J[5] + J[3]), .xx = 0.5 * J[4] + square, .yy = 0.5 * J[4] - square};
    f->across = (fw_arc_sums){.y = 0.5 * (J[5] - J[3]), .xy = 0.25 * (J[6] - J[2])};
}

/* what the outline of an arc gives: rn = r u/atanh u, u = t/2r (Winkler), the exact bending
   stiffness over the thin one, 1 - 2/15 u^2 - u^4/21 (Golovin, plane stress, to u^4), roots, and
   W = (L rn sin(a)/a + 2 dL r cos(a)) / (L + 2 dL) from O
   in m, rad; valid 0 < a <= pi, u < 1; error of W 0.2 um at r = 100 um against 3-D finite elements
   source: docs/theory/flexure.md eq. 1, 2, 6, 7; test_ladder.c */
void fw_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    double r = in->radius_m, a = 0.5 * in->angle_rad, t = in->width_m, u = 0.5 * t / r;
    double dL = fw_root_length_m(t, in->fillet_m), e = fw_neutral_offset(r, u);
    double s = sin(a), c = cos(a), c2 = c * c - s * s, s2 = 2 * s * c;
    *f = (fw_flexure_shape){.kind = in->kind,
                            .length_m = in->length_m,
                            .radius_m = r,
                            .width_m = t,
                            .fillet_m = in->fillet_m,
                            .half_angle_rad = a,
                            .sine = s,
                            .cosine = c,
                            .cos4 = c2 * c2 - s2 * s2,
                            .sin4 = 2 * c2 * s2,
                            .neutral_m = r - e,
                            .eccentric_m = e,
                            .per_eccentric = 1 / e,
                            .curved = t / (3.0 * r),
                            .per_root_rt = 1 / sqrt(r * t),
                            .per_golovin = 1 / fw_golovin(u),
                            .golovin = fw_golovin(u),
                            .root_length_m = dL,
                            .root_block_m = fw_root_block_m(t, in->fillet_m),
                            .whole_m = in->length_m + 2.0 * dL,
                            .fillet_concentration = fw_fillet_concentration(t, in->fillet_m)};
    f->centre_m = (f->length_m * f->neutral_m * s / a + 2.0 * dL * r * c) / f->whole_m;
    sums_of(f);
}

/* 1/E at every place, a0 + a1 cos 4(al0 + b), as sums, and 1/G likewise; dL/E of the two roots */
typedef struct soft {
    fw_arc_sums bend, shear;
    double root_m_per_Pa[2];
} soft;

static fw_arc_sums mix(const fw_flexure_shape *f, double even, double along, double across) {
    const fw_arc_sums *p = &f->even, *q = &f->along, *s = &f->across;
    return (fw_arc_sums){.w = even * p->w + along * q->w,
                         .x = even * p->x + along * q->x,
                         .y = across * s->y,
                         .xx = even * p->xx + along * q->xx,
                         .xy = across * s->xy,
                         .yy = even * p->yy + along * q->yy};
}

static inline soft uniform(const fw_flexure_shape *f, double youngs_Pa, double poisson) {
    double m = 1 / youngs_Pa, g = 2 * (1 + poisson) * m;
    const fw_arc_sums *p = &f->even;
    return (soft){.bend = {.w = m * p->w, .x = m * p->x, .xx = m * p->xx, .yy = m * p->yy},
                  .shear = {.xx = g * p->xx, .yy = g * p->yy},
                  .root_m_per_Pa = {m * f->root_length_m, m * f->root_length_m}};
}

static soft crystalline(const fw_flexure_shape *f, const fw_crystal *k) {
    double c = k->cos4, s = k->sin4, c4 = c * f->cos4, s4 = s * f->sin4;
    return (soft){
        .bend = mix(f, k->a0_per_Pa, k->a1_per_Pa * c, k->a1_per_Pa * s),
        .shear = mix(f, k->g0_per_Pa, k->g1_per_Pa * c, k->g1_per_Pa * s),
        .root_m_per_Pa = {fw_root_m_per_Pa(f, k, c4 + s4), fw_root_m_per_Pa(f, k, c4 - s4)}};
}

static void centre_of(const fw_flexure_shape *f, const soft *m, double centre[2]) {
    const double *root = m->root_m_per_Pa;
    double r = f->radius_m, rn = f->neutral_m;
    double per = 1 / (r * m->bend.w + root[0] + root[1]);
    centre[0] = (r * rn * m->bend.x + r * f->cosine * (root[0] + root[1])) * per;
    centre[1] = (r * rn * m->bend.y + r * f->sine * (root[1] - root[0])) * per;
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
   in: depth h m, D 1, 1/E and 1/G 1/Pa; out: W m, C SI. Valid t/r <= 0.3. Error against 3-D finite
   elements, real roots: 0.4 % in C_th, 1 % in C_xx, 1.4 % in C_yy. Cost 15 ns.
   source: docs/theory/flexure.md eq. 1-4, 13; test_ladder.c */
static inline void comply(const fw_flexure_shape *f, double depth_m, double D, const soft *m,
                          const double centre[2], double C[3][3]) {
    double r = f->radius_m, rn = f->neutral_m, t = f->width_m;
    double over = 1 / (depth_m * t * D), per_A = over * D, e = f->eccentric_m;
    double end = f->per_section * over, bend = over * f->per_eccentric;
    const fw_arc_sums *S = &m->bend, *G = &m->shear;
    double rx = r * f->cosine, ry = r * f->sine, both = m->root_m_per_Pa[0] + m->root_m_per_Pa[1];
    double weight = r * S->w + both, X = centre[0], Y = centre[1];
    double x = rx - X, low = -ry - Y, high = ry - Y, shear = 6.0 / 5.0 * r * per_A, axial = e * rn;
    double ends = m->root_m_per_Pa[0] * low + m->root_m_per_Pa[1] * high;
    C[0][0] = weight * f->per_section * over * f->per_golovin;
    C[0][1] = C[1][0] = C[0][2] = C[2][0] = 0;
    C[1][1] = bend * ((rn * rn + axial) * S->yy - 2 * Y * rn * S->y + Y * Y * S->w) +
              end * (m->root_m_per_Pa[0] * low * low + m->root_m_per_Pa[1] * high * high) +
              shear * G->xx;
    C[2][2] = bend * ((rn * rn + axial) * S->xx - 2 * X * rn * S->x + X * X * S->w) +
              end * both * x * x + shear * G->yy;
    C[1][2] = C[2][1] =
        -bend * ((rn * rn + axial) * S->xy - rn * (X * S->y + Y * S->x) + X * Y * S->w) -
        end * x * ends + shear * G->xy;
}

/* The crystal's arc, and beside it a uniform one of the same rotational stiffness: modulus that of
   the mean compliance along the arc, nu of that modulus. The law at finite rotation knows uniform
   arcs only; it takes the shares by which C_xx and C_yy differ. */
static void crystal_arc(const fw_flexure_shape *f, const fw_flexure_input *in, fw_depth *depth,
                        double centre[2], fw_flexure_result *out) {
    const soft m = crystalline(f, &in->crystal);
    double C[3][3], other[2];
    out->youngs_Pa = 2 * f->half_angle_rad / m.bend.w;
    out->poisson = -in->crystal.s12_per_Pa * out->youngs_Pa;
    *depth = fw_depth_at(in->depth_m * f->per_root_rt, out->poisson);
    centre_of(f, &m, centre);
    comply(f, in->depth_m, depth->stiffness, &m, centre, out->compliance);
    soft mean = uniform(f, out->youngs_Pa, out->poisson);
    double root = 0.5 * (m.root_m_per_Pa[0] + m.root_m_per_Pa[1]);
    mean.root_m_per_Pa[0] = mean.root_m_per_Pa[1] = root;
    out->root_length_m = root * out->youngs_Pa;
    centre_of(f, &mean, other);
    comply(f, in->depth_m, depth->stiffness, &mean, other, C);
    out->uneven_x = out->compliance[1][1] / C[1][1] - 1;
    out->uneven_y = out->compliance[2][2] / C[2][2] - 1;
}

/* circular arc of centre-line radius r, half-angle a, width t, depth h, L = 2 a r:
     K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy of the above
     eps/rad = t/(2 (L + 2 dL)) Kt max((1 + t/3r) F_inner, (1 - t/3r) F_outer), at the root fillet
     crystal: sigma/rad = t/(2 int ds/E) Kt max(...) q, eps = sigma/E (fw_crystal_stress)
   error: K 0.15-0.51 %, W 0.2 um, strain -0.2..+2.9 % against 3-D finite elements on held-out
   shapes. Cost 65 ns with the shape at hand and its errors, a crystal 100 (bench_hinge_closed.c).
   source: docs/theory/flexure.md eq. 1-13; test_ladder.c, test_crystal.c */
void fw_flexure_csfh(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    double t = f->width_m, h = in->depth_m, centre[2];
    fw_depth depth;
    if (in->crystal.known)
        crystal_arc(f, in, &depth, centre, out);
    else {
        out->youngs_Pa = in->youngs_Pa, out->poisson = in->poisson;
        const soft m = uniform(f, in->youngs_Pa, in->poisson);
        depth = fw_depth_at(h * f->per_root_rt, in->poisson);
        comply(f, h, depth.stiffness, &m, (const double[2]){f->centre_m, 0}, out->compliance);
    }
    double EI = out->youngs_Pa * h * t * t * t * (1 / 12.0);
    out->depth_factor = depth.stiffness;
    out->stiffness_thin = EI * f->per_length;
    if (in->crystal.known) {
        out->stiffness_Nm_per_rad = 1 / out->compliance[0][0];
        out->offset_m[0] = centre[0] - f->centre_m, out->offset_m[1] = centre[1];
    } else
        out->stiffness_Nm_per_rad = EI * depth.stiffness * f->golovin * f->per_whole;
    double curved = f->curved, half = 0.5 * t * f->per_whole;
    double inner = (1.0 + curved) * depth.inner, outer = (1.0 - curved) * depth.outer;
    out->concentration = f->fillet_concentration * (inner > outer ? inner : outer);
    out->strain_per_rad = half * out->concentration;
    if (!in->crystal.known) return;
    double stiff = f->whole_m / (out->compliance[0][0] * in->depth_m * t * t * t / 12.0 *
                                 depth.stiffness * f->golovin); /* E that gives this C_th */
    out->concentration *= fw_crystal_stress(&in->crystal, f->cos4, f->sin4);
    out->strain_per_rad = half * out->concentration * stiff / in->youngs_Pa;
}
