/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/finish.h"
#include "flexure/kinds.h"
#include "flexure/section_core.h"
#include <math.h>

/* by J_n = int cos(n b) db = 2 sin(n a)/n: products of sines and cosines to sums. Exact;
   test_crystal.c sums_are_the_integrals */
void fw_arc_sums_of(double a, double s, double c, fw_arc_sums *even, fw_arc_sums *along,
                    fw_arc_sums *across) {
    double J[7] = {2 * a, 2 * s}, before = 0, now = s; /* sin (n - 1) a, sin n a */
    for (int n = 2; n <= 6; n++) {
        double next = 2 * c * now - before;
        before = now, now = next;
        J[n] = 2 * now / n;
    }
    double square = 0.25 * (J[6] + J[2]);
    *even = (fw_arc_sums){.w = J[0], .x = J[1], .xx = a + s * c, .yy = a - s * c};
    *along = (fw_arc_sums){
        .w = J[4], .x = 0.5 * (J[5] + J[3]), .xx = 0.5 * J[4] + square, .yy = 0.5 * J[4] - square};
    *across = (fw_arc_sums){.y = 0.5 * (J[5] - J[3]), .xy = 0.25 * (J[6] - J[2])};
}

/* what the outline of an arc gives: rn = r u/atanh u, u = t/2r (Winkler), the exact bending
   stiffness over the thin one, 1 - 2/15 u^2 - u^4/21 (Golovin, plane stress, to u^4), roots, and
   W = 2 r (rn sin a + dL cos a)/(L + 2 dL) from O, L = 2 a r
   in m, rad; valid 0 < a <= pi, u < 1; error of W 0.2 um at r = 100 um against 3-D finite elements.
   Members are set one by one: clearing all of them first would cost a tenth of the closed form.
   source: docs/theory/flexure.md eq. 1, 2, 6, 7; test_ladder.c, test_quick.c */
FW_INLINE void shape_of(const fw_flexure_input *in, fw_flexure_shape *f) {
    double r = in->radius_m, a = 0.5 * in->angle_rad, t = in->width_m, rho = in->fillet_m;
    double L = in->length_m, per_rt = 1 / (r * t), per_t = r * per_rt, half_t = 0.5 * t;
    double dL = 0, block = 0, Kt = 1, s, c, u = half_t * (t * per_rt);
    fw_quick_sincos(a, &s, &c);
    if (rho >= 0) {
        double x = fw_fitted_ratio(rho * per_t);
        dL = t * fw_root_law(x), block = fw_root_block_law * t, Kt = fw_concentration_law(x);
    }
    double whole = L + 2 * dL, per = 1 / (L * whole), e = half_t * u * fw_neutral_series(u);
    double rn = r - e;
    f->kind = FW_FLEXURE_CSFH;
    f->length_m = L, f->radius_m = r, f->width_m = t, f->fillet_m = rho;
    f->half_angle_rad = a, f->sine = s, f->cosine = c;
    f->neutral_m = rn, f->eccentric_m = e, f->golovin = fw_golovin_law(u);
    f->root_length_m = dL, f->root_block_m = block, f->whole_m = whole;
    f->fillet_concentration = Kt;
    f->curved = (2 / 3.0) * u;
    f->per_root_rt = sqrt(per_rt);
    f->per_eccentric = 1 / e;
    f->per_length = whole * per, f->per_whole = L * per;
    f->per_section = 12 * (per_t * per_t);
    f->centre_m = 2 * r * (rn * s + dL * c) * f->per_whole;
}

/* 1/E at every place, a0 + a1 cos 4(al0 + b), as sums, and 1/G likewise; dL/E of the two roots */
typedef struct soft {
    fw_arc_sums bend, shear;
    double root_m_per_Pa[2];
} soft;

typedef struct arc_sums {
    fw_arc_sums even, along, across;
} arc_sums;

static fw_arc_sums mix(const arc_sums *f, double even, double along, double across) {
    const fw_arc_sums *p = &f->even, *q = &f->along, *s = &f->across;
    return (fw_arc_sums){.w = even * p->w + along * q->w,
                         .x = even * p->x + along * q->x,
                         .y = across * s->y,
                         .xx = even * p->xx + along * q->xx,
                         .xy = across * s->xy,
                         .yy = even * p->yy + along * q->yy};
}

static soft uniform(const fw_flexure_shape *f, const arc_sums *of, double youngs_Pa,
                    double poisson) {
    double m = 1 / youngs_Pa, g = 2 * (1 + poisson) * m;
    return (soft){.bend = mix(of, m, 0, 0),
                  .shear = mix(of, g, 0, 0),
                  .root_m_per_Pa = {m * f->root_length_m, m * f->root_length_m}};
}

static soft crystalline(const fw_flexure_shape *f, const arc_sums *of, const fw_crystal *k,
                        double cos4, double sin4) {
    double c = k->cos4, s = k->sin4, c4 = c * cos4, s4 = s * sin4;
    return (soft){
        .bend = mix(of, k->a0_per_Pa, k->a1_per_Pa * c, k->a1_per_Pa * s),
        .shear = mix(of, k->g0_per_Pa, k->g1_per_Pa * c, k->g1_per_Pa * s),
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
   elements, real roots: 0.4 % in C_th, 1 % in C_xx, 1.4 % in C_yy. Cost 15 ns, of a uniform modulus
   (below, the same with what symmetry leaves) 5 ns.
   source: docs/theory/flexure.md eq. 1-4, 13; test_ladder.c */
static void comply(const fw_flexure_shape *f, double depth_m, double D, const soft *m,
                   const double centre[2], double C[3][3]) {
    double r = f->radius_m, rn = f->neutral_m, t = f->width_m;
    double over = 1 / (depth_m * t * D), per_A = over * D, e = f->eccentric_m;
    double end = f->per_section * over, bend = over * f->per_eccentric;
    const fw_arc_sums *S = &m->bend, *G = &m->shear;
    double rx = r * f->cosine, ry = r * f->sine, both = m->root_m_per_Pa[0] + m->root_m_per_Pa[1];
    double weight = r * S->w + both, X = centre[0], Y = centre[1];
    double x = rx - X, low = -ry - Y, high = ry - Y, shear = 6.0 / 5.0 * r * per_A, axial = e * rn;
    double ends = m->root_m_per_Pa[0] * low + m->root_m_per_Pa[1] * high;
    C[0][0] = weight * f->per_section * over / f->golovin;
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

/* the same; per_D 1/D, per_EA 1/(E h t), K; rn^2 + e rn = r rn */
FW_INLINE void comply_evenly(const fw_flexure_shape *f, double per_D, double per_EA, double poisson,
                             double K, double C[3][3]) {
    double r = f->radius_m, rn = f->neutral_m, a = f->half_angle_rad, s = f->sine, c = f->cosine;
    double X = f->centre_m, sc = s * c, bend = per_EA * f->per_eccentric, square = bend * rn * r;
    double end = f->per_section * per_EA * (f->root_length_m + f->root_length_m);
    double x = r * c - X, y = r * s, shear = (2.4 + 2.4 * poisson) * r * per_EA, twice = X + X;
    double along = square * (a - sc) + end * (y * y);
    double across = square * (a + sc) - bend * (twice * ((rn + rn) * s - X * a)) + end * (x * x);
    C[0][0] = 1 / K;
    C[0][1] = C[1][0] = C[0][2] = C[2][0] = C[1][2] = C[2][1] = 0;
    C[1][1] = along * per_D + shear * (a + sc);
    C[2][2] = across * per_D + shear * (a - sc);
}

/* The crystal's arc, and beside it a uniform one of the same rotational stiffness: modulus that of
   the mean compliance along the arc, nu of that modulus. The law at finite rotation knows uniform
   arcs only; it takes the shares by which C_xx and C_yy differ. */
static void crystal_arc(const fw_flexure_shape *f, const fw_flexure_input *in,
                        fw_flexure_result *out) {
    double centre[2];
    arc_sums of;
    double c2 = f->cosine * f->cosine - f->sine * f->sine, s2 = 2 * f->sine * f->cosine;
    double cos4 = c2 * c2 - s2 * s2, sin4 = 2 * c2 * s2, C[3][3], other[2];
    fw_arc_sums_of(f->half_angle_rad, f->sine, f->cosine, &of.even, &of.along, &of.across);
    const soft m = crystalline(f, &of, &in->crystal, cos4, sin4);
    out->youngs_Pa = 2 * f->half_angle_rad / m.bend.w;
    out->poisson = -in->crystal.s12_per_Pa * out->youngs_Pa;
    const fw_depth depth = fw_depth_at(in->depth_m * f->per_root_rt, out->poisson);
    centre_of(f, &m, centre);
    comply(f, in->depth_m, depth.stiffness, &m, centre, out->compliance);
    soft mean = uniform(f, &of, out->youngs_Pa, out->poisson);
    double root = 0.5 * (m.root_m_per_Pa[0] + m.root_m_per_Pa[1]);
    mean.root_m_per_Pa[0] = mean.root_m_per_Pa[1] = root;
    out->root_length_m = root * out->youngs_Pa;
    centre_of(f, &mean, other);
    comply(f, in->depth_m, depth.stiffness, &mean, other, C);
    out->uneven_x = out->compliance[1][1] / C[1][1] - 1;
    out->uneven_y = out->compliance[2][2] / C[2][2] - 1;
    double h = in->depth_m, t = f->width_m,
           thick = fw_larger((1 + f->curved) * depth.inner, (1 - f->curved) * depth.outer);
    double EI = out->youngs_Pa * h * t * t * t * (1 / 12.0);
    double stiff = f->whole_m / (out->compliance[0][0] * h * t * t * t / 12.0 * depth.stiffness *
                                 f->golovin); /* E that gives this C_th */
    out->depth_factor = depth.stiffness;
    out->stiffness_thin = EI * f->per_length;
    out->stiffness_Nm_per_rad = 1 / out->compliance[0][0];
    out->offset_m[0] = centre[0] - f->centre_m, out->offset_m[1] = centre[1];
    out->concentration =
        f->fillet_concentration * thick * fw_crystal_stress(&in->crystal, cos4, sin4);
    out->strain_per_rad = 0.5 * t * f->per_whole * out->concentration * stiff / in->youngs_Pa;
}

/* circular arc of centre-line radius r, half-angle a, width t, depth h, L = 2 a r:
     K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy of the above
     eps/rad = t/(2 (L + 2 dL)) Kt max((1 + t/3r) F_inner, (1 - t/3r) F_outer), at the root fillet
     crystal: sigma/rad = t/(2 int ds/E) Kt max(...) q, eps = sigma/E (fw_crystal_stress)
   error: K 0.15-0.51 %, W 0.2 um, strain -0.2..+2.9 % against 3-D finite elements on held-out
   shapes. Cost 45 ns with the shape at hand and its errors, a crystal 100 (bench_hinge_closed.c).
   source: docs/theory/flexure.md eq. 1-13; test_ladder.c, test_crystal.c, test_quick.c */
FW_INLINE void even_arc(const fw_flexure_shape *f, const fw_flexure_input *in,
                        const fw_depth *depth, fw_flexure_result *out) {
    double t = f->width_m, E = in->youngs_Pa, EA = E * in->depth_m * t;
    double D = depth->stiffness, thin = EA * t * t * (1 / 12.0);
    out->youngs_Pa = E, out->poisson = in->poisson;
    out->depth_factor = D;
    out->stiffness_thin = thin * f->per_length;
    double K = out->stiffness_Nm_per_rad = thin * f->golovin * f->per_whole * D;
    comply_evenly(f, depth->softness, 1 / EA, in->poisson, K, out->compliance);
    out->concentration = f->fillet_concentration *
                         fw_larger((1 + f->curved) * depth->inner, (1 - f->curved) * depth->outer);
    out->strain_per_rad = 0.5 * t * f->per_whole * out->concentration;
}

void fw_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    shape_of(in, f);
}

void fw_flexure_csfh(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    if (in->crystal.known) {
        crystal_arc(f, in, out);
        return;
    }
    const fw_depth depth = fw_depth_at(in->depth_m * f->per_root_rt, in->poisson);
    even_arc(f, in, &depth, out);
}

/* the outline stays in registers, and is worked out while the depth factor, which takes longest,
   is on its way */
void fw_csfh_at_once(const fw_flexure_input *in, fw_flexure_result *out) {
    fw_flexure_shape f;
    const fw_depth_start start =
        fw_depth_start_of(in->depth_m * sqrt(1 / (in->radius_m * in->width_m)), in->poisson);
    shape_of(in, &f);
    const fw_depth depth = fw_depth_law(&start);
    fw_shape_marks(&f);
    out->centre_m = f.centre_m;
    out->root_length_m = f.root_length_m;
    out->offset_m[0] = out->offset_m[1] = out->uneven_x = out->uneven_y = 0;
    even_arc(&f, in, &depth, out);
    fw_stiffness_and_limit(&f, in, out);
    double per_EI = out->compliance[0][0] * f.per_whole * f.golovin;
    fw_isotropic_errors(&f, in, out, per_EI, fw_errors_widened(&f, in->depth_m), &out->error);
    out->error.outside = fw_errors_widened(&f, in->depth_m) > 1;
}
