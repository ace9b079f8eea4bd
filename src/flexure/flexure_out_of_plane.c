/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a flexure gives out of the plane that the device moves in: bending of its depth, torsion, shear.
   Theory: docs/theory/effects/out-of-plane.md. */
#include "base/constants.h"
#include "flexure/path.h"
#include "flexure/section.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

/* ---- sections ---- */

/* Saint-Venant's torsion of a rectangle, q >= p its sides:

     J = q p^3/3 (1 - (192/pi^5) (p/q) sum over odd n of tanh(n pi q/(2 p))/n^5)

   the sum as (31/32) zeta(5) less what tanh lacks of 1, which falls as exp(-n pi q/p).
   In: m; out: m^4. Exact to rounding. Source: Timoshenko and Goodier, Theory of Elasticity, art. 109.
   Test: test_out_of_plane.c torsion_of_rectangles */
double fw_flexure_torsion_m4(double a_m, double b_m) {
    const double whole = 1.0045237627951382, pi5 = FW_PI * FW_PI * FW_PI * FW_PI * FW_PI;
    double p = fmin(a_m, b_m), q = fmax(a_m, b_m), sum = whole;
    for (int n = 1; n < 30; n += 2) {
        double lacks = 2 / (1 + exp(n * FW_PI * q / p)), n5 = (double)n * n * n * n * n;
        sum -= lacks / n5;
        if (lacks < 1e-18) break;
    }
    return q * p * p * p / 3 * (1 - 192 / pi5 * (p / q) * sum);
}

/* A strip that is bent out of the plane and curved in it is pressed towards its arc's centre where it is
   pulled, and away from it where it is pressed: it turns about its tangent, which the beam has, and bends
   across its depth besides, which takes stress from its edges as it does in a bent tube. With u odd in z and
   0 at both edges, least of E t int (kappa z + u/R)^2 dz + D int u''^2 dz:

     EI/(E t h^3/12) = (3/(2 X)) (sinh X cosh X - sin X cos X)/(sinh^2 X + sin^2 X)
     X = h [3 (1 - nu^2)]^(1/4)/(2 sqrt(R t))

   In: 1/R, t, h in m; out: dimensionless, 1 of a straight strip. Valid for thin strips, t << R. Error: that of
   shallow shells, t/R. Source: the same energies as eq. (8) of docs/theory/flexure.md.
   Test: test_out_of_plane.c a_tall_arc_gives_way, against quadrature of that energy */
double fw_flexure_tall_arc(double curvature_per_m, double width_m, double depth_m, double poisson) {
    double x =
        0.5 * depth_m * sqrt(sqrt(3 * (1 - poisson * poisson)) * fabs(curvature_per_m) / width_m);
    double x4 = x * x * x * x;
    if (x < 0.1) return 1 - 16.0 / 630.0 * x4; /* the next is 2e-3 x^8 */
    if (x > 30) return 1.5 / x;
    double sh = sinh(x), ch = cosh(x), s = sin(x), c = cos(x);
    return 1.5 / x * (sh * ch - s * c) / (sh * sh + s * s);
}

/* what a material gives: 1/E, 1/G of the two planes that a section is sheared in, and what bending of a
   crystal's strip twists of it, by direction of the tangent in the flexure's frame */
typedef struct stuff {
    const fw_flexure_crystal *crystal; /* NULL: isotropic */
    double youngs_Pa, poisson;
} stuff;

typedef struct soft {
    double bend;   /* 1/E along the strip */
    double wall;   /* 1/G of along and up: the walls of a strip that is taller than wide */
    double flat;   /* 1/G of along and across in the plane: its faces */
    double twists; /* a1 sin 4 psi: -s16/2 */
} soft;

static soft soft_at(const stuff *m, double psi_rad) {
    if (!m->crystal) {
        double g = 2 * (1 + m->poisson) / m->youngs_Pa;
        return (soft){1 / m->youngs_Pa, g, g, 0};
    }
    const fw_flexure_crystal *k = m->crystal;
    double c = 0, s = 0; /* of a direction that is not known: the mean of all */
    if (k->aligned) {
        double cp = cos(4 * psi_rad), sp = sin(4 * psi_rad);
        c = k->cos4 * cp - k->sin4 * sp, s = k->sin4 * cp + k->cos4 * sp;
    }
    return (soft){k->a0_per_Pa + k->a1_per_Pa * c, k->g0_per_Pa + k->g1_per_Pa,
                  k->g0_per_Pa + k->g1_per_Pa * c, k->a1_per_Pa * s};
}

typedef struct section {      /* of a tangent t and its normal n to the left, both in the plane */
    double bend, twist, both; /* turns per length about n and t by moments: 1/(N m^2) */
    double slide;             /* 1/(k G A), k = 5/6 */
    double warp_m;            /* how far an end that cannot warp is felt */
    double warped_m;          /* strain that such an end puts on a twist per length, at most */
} section;

/* G J of a section that is sheared more easily one way: the same function of a rectangle whose height is
   scaled by the root of the moduli. Warping: (q^2 - p^2)^2/(q^2 + p^2)^2 p^3 q^3/144, that of a thin strip
   and none of a square; the true one of a square is a fiftieth of p^6/144. Source: Lekhnitskii, Theory of Elasticity of
   an Anisotropic Body, 1963, 42 and 46.
   Where an end cannot warp, a twist theta per length strains it by theta max|phi|/l, l^2 = E Gamma/(G J), with phi
   Saint-Venant's function of the rectangle and Gamma the integral of its square. Both vanish towards a square, and

     max|phi|/l <= p (3 G/E)^(1/2),   p the shorter side: 0.68 of that for a square, 0.71 to 0.81 up to q = 3 p,
                                      all of it for a thin strip,

   so that the corner's strain stays finite and grows no faster than the side. In: moduli by direction, sides, SI. Valid
   for any q/p; Vlasov's decay, which for a square puts 2.5 times as much on the end as warping that is free of the
   twist. Test: test_out_of_plane.c warping_of_rectangles (series by quadrature, and bars of CalculiX clamped at an end) */
static section section_at(const stuff *m, double psi_rad, double curvature_per_m, double width_m,
                          double depth_m) {
    soft e = soft_at(m, psi_rad);
    double w = width_m, h = depth_m, ratio = sqrt(e.wall / e.flat);
    double I = w * h * h * h / 12, GJ = fw_flexure_torsion_m4(w, h * ratio) / (ratio * e.wall);
    double even = (h * h - w * w) / (h * h + w * w), third = w * h;
    double warping = even * even * third * third * third / 144;
    double tall = fw_flexure_tall_arc(curvature_per_m, w, h, m->poisson);
    return (section){.bend = e.bend / (I * tall),
                     .twist = 1 / GJ,
                     .both = e.twists / I,
                     .slide = 1.2 * e.wall / (w * h),
                     .warp_m = sqrt(warping / (e.bend * GJ)),
                     .warped_m = fmin(w, h * ratio) * sqrt(3 * e.bend / e.wall)};
}

/* ---- the strip ---- */

typedef double out_of_plane_matrix[3][3];

/* moments about t and n of (Fz, Mx, My) at `at` on a section */
static void moment_rows(const fw_geometry_pose *pose, const double at[2], double T[3],
                        double M[3]) {
    const double x = at[0] - pose->x_m, y = at[1] - pose->y_m;
    const double tc = cos(pose->angle_rad), ts = sin(pose->angle_rad);
    T[0] = tc * y - ts * x, T[1] = tc, T[2] = ts;
    M[0] = -ts * y - tc * x, M[1] = -ts, M[2] = tc;
}

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* c += B' S B of a length of strip: those moments and the force across */
static void add_length(const section *is, const fw_geometry_pose *pose, const double at[2],
                       double length_m, double twist_share, out_of_plane_matrix c) {
    double T[3], M[3];
    moment_rows(pose, at, T, M);
    double a = is->twist * twist_share * length_m, b = is->bend * length_m, d = is->both * length_m;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[i][j] += a * T[i] * T[j] + b * M[i] * M[j] + d * (T[i] * M[j] + M[i] * T[j]);
    c[0][0] += is->slide * length_m;
}

/* ---- where the strip goes over into a body ---- */

typedef struct root { /* lengths of strip that a body adds in bending and in torsion, m */
    double bend_m, twist_m;
} root;

/* A plate that is as thick as the strip gives where a narrow strip bends it, the more so the taller the strip;
   it keeps less of the warping than a rigid end would:

     dL_bend/w = 1.07 + 0.215 ln(h/w) - 0.52 rho/w,     dL_twist/w = 0.5 - 0.012 h/w - 0.62 rho/w

   fitted to eleven solids of CalculiX (h/w from 0.5 to 12.5, rho/w from 0.19 to 1, blocks of five widths to either
   side): within 0.06 w and 0.06 w. Test: test_out_of_plane.c solids_that_were_not_fitted */
static root root_of(double width_m, double depth_m, double fillet_m) {
    if (fillet_m < 0) return (root){0, 0}; /* an ideal end */
    double tall = fmin(fmax(depth_m / width_m, 0.5), 15), x = fmin(fillet_m / width_m, 1.25);
    return (root){width_m * (1.07 + 0.215 * log(tall) - 0.52 * x),
                  width_m * (0.5 - 0.012 * tall - 0.62 * x)};
}

static void add_roots(const fw_flexure_course *p, const stuff *m, const fw_flexure_input *in,
                      fw_flexure_out_of_plane *out) {
    for (int end = 0; end < 2; end++) {
        int i = end ? p->n - 1 : 0;
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        double s = end ? q->length_m : 0, w = fw_geometry_strip_width(&p->shape[i], s);
        fw_geometry_pose pose = fw_geometry_strip_along(p->start[i], q->curvature_per_m, s);
        section is = section_at(m, pose.angle_rad, q->curvature_per_m, w, in->depth_m);
        const root give = root_of(w, in->depth_m, in->fillet_m);
        is.both = is.slide = 0;
        is.bend *= give.bend_m, is.twist *= give.twist_m;
        add_length(&is, &pose, out->at_m, 1, 1, out->c);
    }
}

/* What solids and this may differ by, relative: 3 % where the ends are ideal (a tall arc is softer than they by
   up to 3.1 %), 0.4 w of strip at either root for blocks of other sizes, and what beams are off by where they are
   hardly longer than tall */
static double error_of(const fw_flexure_input *in, double widest_m, double length_m) {
    double tall = in->depth_m / length_m, error = 0.03 + 0.3 * tall * tall;
    if (in->fillet_m >= 0) error += 0.8 * widest_m / length_m;
    if (in->crystal.known) {
        error += 0.02;
        if (!in->crystal.aligned) error += fabs(in->crystal.a1_per_Pa / in->crystal.a0_per_Pa);
    }
    return error;
}

/* share of the twist of a strip without restraint that is left s from the middle of one whose ends cannot warp,
   under a torque that is the same all along: 1 - cosh(s/l)/cosh(L/2l) */
static double warps(double from_middle_m, double half_m, double warp_m) {
    if (!(warp_m > 0)) return 1;
    return 1 - exp((from_middle_m - half_m) / warp_m) * (1 + exp(-2 * from_middle_m / warp_m)) /
                   (1 + exp(-2 * half_m / warp_m));
}

/* Castigliano, of a strip that is statically determinate: with P the centre line, t and n its tangent and normal,
   (T, M) the moment about them and F the force that (Fz, Mx, My) at W put on the section,

     C = int B' S B ds,   B: (Fz, Mx, My) -> (T, M, F),   S = [1/GJ, d, 0; d, 1/EI, 0; 0, 0, 1/(k G A)]

   EI of the depth as fw_flexure_tall_arc has it, GJ of fw_flexure_torsion_m4 and of ends that do not warp, d of a
   crystal a1 sin(4 psi)/I (bending twists it; Lekhnitskii 1963, 17), and a length of strip for either root.
   In: geometry, material of the flexure, SI. Out: C about its pin, symmetric. Valid for w, h < L/2. Error:
   quadrature below 1e-9, the model `error`. Cost 64 sections a piece, 25 us. Source: docs/theory/effects/out-of-plane.md.
   Test: test_out_of_plane.c */
fw_status fw_flexure_out_of_plane_of(fw_arena *arena, const fw_flexure_input *in,
                                     const fw_flexure_result *closed_form,
                                     fw_flexure_out_of_plane *out) {
    enum { PANELS = 4 };
    double node[FW_GAUSS_MOST], weight[FW_GAUSS_MOST], before = 0, widest = 0;
    fw_mark mark = fw_arena_mark(arena);
    fw_flexure_course *p;
    FW_NEED(p = fw_arena_one(arena, fw_flexure_course));
    fw_flexure_path_of(in, p);
    fw_flexure_gauss_rule(FW_GAUSS_MOST, node, weight);
    const stuff m = {in->crystal.known ? &in->crystal : NULL, in->youngs_Pa,
                     in->crystal.known ? closed_form->poisson : in->poisson};
    *out = (fw_flexure_out_of_plane){
        .at_m = {closed_form->centre_m + closed_form->offset_m[0], closed_form->offset_m[1]},
        .bend_Nm2 = HUGE_VAL,
        .twist_Nm2 = HUGE_VAL};
    for (int i = 0; i < p->n; i++)
        out->length_m += p->shape[i].piece.length_m;
    for (int i = 0; i < p->n; i++) {
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        for (int j = 0; j < PANELS * FW_GAUSS_MOST; j++) {
            double panel = q->length_m / PANELS, half = 0.5 * out->length_m;
            double s = (j / FW_GAUSS_MOST + node[j % FW_GAUSS_MOST]) * panel;
            double w = fw_geometry_strip_width(&p->shape[i], s);
            fw_geometry_pose pose = fw_geometry_strip_along(p->start[i], q->curvature_per_m, s);
            section is = section_at(&m, pose.angle_rad, q->curvature_per_m, w, in->depth_m);
            double share = warps(fabs(before + s - half), half, is.warp_m);
            add_length(&is, &pose, out->at_m, panel * weight[j % FW_GAUSS_MOST], share, out->c);
            out->bend_Nm2 = fmin(out->bend_Nm2, 1 / is.bend);
            out->twist_Nm2 = fmin(out->twist_Nm2, 1 / is.twist);
            widest = fmax(widest, w);
        }
        before += q->length_m;
    }
    add_roots(p, &m, in, out);
    out->error = error_of(in, widest, out->length_m);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* What a section bears: kappa = M/EI bends the depth, theta = T/GJ twists it. The largest strain there is at most

     2 (kappa h/2 + theta p (3 G/E)^(1/2)) + theta p/2,     p = min(w, h)

   bending at the faces; warping that a root restrains, as in `section_at`; half of a shear that is theta p at most; twice
   the first two, since a fillet concentrates what bends and warps a strip. At least it is kappa h/2 of a straight strip, and two thirds of that whatever the shape of
   the stress over the depth (a stress that is the same all over each half). Strains of a crystal are stress over youngs_Pa.
   In: (Fz, Mx, My) about the pin in the flexure's frame, n of them, the first at rest, the others amplitudes that ring
   either way. Out: sure[0] of the first alone, sure[1] at most of all. Error: the factor 2 is an assumption, above what
   charts have for plates bent at shoulders with fillets from a twentieth of the width on; what the flexure's length and the
   plates' stiffness are off by is not in it. Cost: 16 sections a piece. Source: Timoshenko and Goodier, art. 109; Vlasov,
   Thin-Walled Elastic Beams 1961 (warping); Peterson's Stress Concentration Factors, bending of flat bars across.
   Test: test_out_of_plane.c strain_of_a_cantilever, warping_of_rectangles */
fw_status fw_flexure_across_strain(fw_arena *arena, const fw_flexure_input *in,
                                   const fw_flexure_result *closed_form, const double (*wrench)[3],
                                   int n, double strain[2]) {
    enum { PANELS = 15 };
    fw_mark mark = fw_arena_mark(arena);
    fw_flexure_course *p;
    FW_NEED(p = fw_arena_one(arena, fw_flexure_course));
    fw_flexure_path_of(in, p);
    const stuff m = {in->crystal.known ? &in->crystal : NULL, in->youngs_Pa,
                     in->crystal.known ? closed_form->poisson : in->poisson};
    const double at[2] = {closed_form->centre_m + closed_form->offset_m[0],
                          closed_form->offset_m[1]};
    const double h = in->depth_m, halves = 2.0 / 3.0;
    strain[0] = strain[1] = 0;
    for (int i = 0; i < p->n; i++) {
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        for (int j = 0; j <= PANELS; j++) {
            const double s = q->length_m * j / PANELS;
            const double w = fw_geometry_strip_width(&p->shape[i], s);
            const fw_geometry_pose pose =
                fw_geometry_strip_along(p->start[i], q->curvature_per_m, s);
            const section is = section_at(&m, pose.angle_rad, q->curvature_per_m, w, h);
            double row[2][3];
            moment_rows(&pose, at, row[0], row[1]);
            const double face = 6 / (w * h * h * closed_form->youngs_Pa); /* strain of M there */
            double bends = 0, twists = 0;
            for (int k = 0; k < n; k++) {
                const double T = dot3(row[0], wrench[k]), M = dot3(row[1], wrench[k]);
                bends += fabs(M) * face;
                twists += fabs(T) * is.twist + fabs(M * is.both);
                if (k > 0) continue;
                const bool straight = !(fabs(q->curvature_per_m) > 0);
                strain[0] = fmax(strain[0], fabs(M) * face * (straight ? 1 : halves));
            }
            const double here = 2 * (bends + twists * is.warped_m) + 0.5 * twists * fmin(w, h);
            if (!(here <= strain[1])) strain[1] = isnan(here) ? (double)INFINITY : here;
        }
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- a strip with its own mass ----
   Places of the parts and of the second body follow from loads on both by a compliance, of a strip clamped at its first end,
   in parts p and the body b:

     u_p = C_pp f_p + C_pb w,   u_b = C_bp f_p + C_bb w

   so parts go with the body by C_pb C_bb^-1, and between ends that are held give C_pp - C_pb C_bb^-1 C_bp, of which
   eigenvalues with the masses are the 1/omega^2 of the strip itself. In: geometry, kg/m2 of the layer. Out: SI. Valid for slender
   strips (masses turn with them about their own axis only). Error: as many masses as parts; of a clamped bar 0.2 % of the
   first 1/omega^2, below. Cost 0.1 ms. Source: R. Craig, M. Bampton, AIAA J. 6 (1968) 1313. Test: test_out_of_plane.c
   strips_that_swing */

enum { OWN_CUTS = 2, OWN_BODY = 2 * FW_OWN_PARTS };

typedef struct
    own_section { /* turns and lengths by moment, pull or torque, and force across, per length */
    fw_geometry_pose pose;
    double by[3], both, wide_m, warped_m;
} own_section;

typedef struct own_strip {
    const fw_flexure_input *in;
    const fw_flexure_course *p;
    fw_flexure_path_stuff flat;
    stuff tall;
    double length_m;
    bool across;
    double pin[2];
    double load[FW_OWN_LOADS]
               [5]; /* of unit loads: place, force or moment, and how far along they act */
} own_strip;

static own_section own_at(const own_strip *o, double s_m) {
    int i = 0;
    double s = fmin(fmax(s_m, 0), o->length_m);
    while (i < o->p->n - 1 && s > o->p->shape[i].piece.length_m)
        s -= o->p->shape[i++].piece.length_m;
    s = fmin(s, o->p->shape[i].piece.length_m);
    if (!o->across) {
        fw_flexure_path_section at;
        fw_flexure_path_section_at(o->p, &o->flat, i, s, &at);
        return (own_section){
            at.pose, {at.bend_per_Nm2, at.stretch_per_N, at.shear_per_N}, 0, at.width_m, 0};
    }
    const double curved = o->p->shape[i].piece.curvature_per_m,
                 wide = fw_geometry_strip_width(&o->p->shape[i], s);
    const fw_geometry_pose pose = fw_geometry_strip_along(o->p->start[i], curved, s);
    const section is = section_at(&o->tall, pose.angle_rad, curved, wide, o->in->depth_m);
    const double half = 0.5 * o->length_m, share = warps(fabs(s_m - half), half, is.warp_m);
    return (own_section){
        pose, {is.bend, is.twist * fmax(share, 0), is.slide}, is.both, wide, is.warped_m};
}

/* what a load puts on a section that it acts beyond: moment, pull or torque, force across */
static void own_bears(const own_strip *o, const own_section *at, int load, double to[3]) {
    const double *f = o->load[load], x = f[0] - at->pose.x_m, y = f[1] - at->pose.y_m;
    const double c = cos(at->pose.angle_rad), s = sin(at->pose.angle_rad);
    if (!o->across) { /* (Fx, Fy, M) */
        to[0] = f[4] + x * f[3] - y * f[2];
        to[1] = c * f[2] + s * f[3], to[2] = c * f[3] - s * f[2];
        return;
    }
    const double T[3] = {c * y - s * x, c, s}, M[3] = {-s * y - c * x, -s, c};
    to[0] = dot3(M, f + 2), to[1] = dot3(T, f + 2), to[2] = f[2]; /* (Fz, Mx, My) */
}

static void own_add(const own_strip *o, const own_section *at, double s_m, double length_m,
                    double (*c)[FW_OWN_LOADS]) {
    double bears[FW_OWN_LOADS][3];
    const double beyond = s_m / o->length_m * FW_OWN_PARTS - 0.5;
    const int first = beyond < 0 ? 0 : 2 * (int)ceil(beyond);
    for (int i = first; i < FW_OWN_LOADS; i++)
        own_bears(o, at, i, bears[i]);
    for (int i = first; i < FW_OWN_LOADS; i++)
        for (int j = first; j <= i; j++)
            c[i][j] +=
                length_m *
                (at->by[0] * bears[i][0] * bears[j][0] + at->by[1] * bears[i][1] * bears[j][1] +
                 at->by[2] * bears[i][2] * bears[j][2] +
                 at->both * (bears[i][0] * bears[j][1] + bears[i][1] * bears[j][0]));
}

static void own_add_roots(const own_strip *o, double (*c)[FW_OWN_LOADS]) {
    for (int end = 0; end < 2; end++) {
        const double s = end ? o->length_m : 0;
        own_section at = own_at(o, s);
        double bend_m, other_m = 0;
        fw_flexure_path_section flat;
        if (o->across) {
            const root give = root_of(at.wide_m, o->in->depth_m, o->in->fillet_m);
            const double curved = o->p->shape[end ? o->p->n - 1 : 0].piece.curvature_per_m;
            const section is =
                section_at(&o->tall, at.pose.angle_rad, curved, at.wide_m, o->in->depth_m);
            at.by[1] = is.twist, bend_m = give.bend_m, other_m = give.twist_m;
        } else {
            fw_flexure_path_root(o->p, &o->flat, end, &flat, &bend_m);
        }
        at.by[0] *= bend_m, at.by[1] *= other_m, at.by[2] = at.both = 0;
        own_add(o, &at, s, 1, c);
    }
}

static void own_loads(own_strip *o, double kg_per_m2, fw_flexure_own *own) {
    const double l = o->length_m / FW_OWN_PARTS, h = o->in->depth_m;
    for (int i = 0; i < FW_OWN_PARTS; i++) {
        const own_section at = own_at(o, (i + 0.5) * l);
        const double c = cos(at.pose.angle_rad), s = sin(at.pose.angle_rad), w = at.wide_m,
                     kg = kg_per_m2 * w * l;
        own->at_m[i][0] = at.pose.x_m, own->at_m[i][1] = at.pose.y_m;
        own->way[i][0] = c, own->way[i][1] = s;
        own->mass[i][0] = kg, own->mass[i][1] = o->across ? kg * (w * w + h * h) / 12 : kg;
        for (int d = 0; d < 2; d++) {
            double *f = o->load[2 * i + d];
            f[0] = at.pose.x_m, f[1] = at.pose.y_m;
            f[2] = !d, f[3] = d && !o->across, f[4] = 0;
            if (d && o->across) f[3] = c, f[4] = s;
        }
    }
    for (int d = 0; d < 3; d++) { /* in the plane the turn comes first */
        double *f = o->load[OWN_BODY + d];
        f[0] = o->pin[0], f[1] = o->pin[1];
        f[2 + (o->across ? d : (d + 2) % 3)] = 1;
    }
}

/* strain by a moment and by a pull or a torque, and what loads put there */
static void own_look(const own_strip *o, const fw_flexure_path_strain *strained,
                     fw_flexure_own *own) {
    const double h = o->in->depth_m;
    for (int k = 0; k < FW_OWN_LOOKS; k++) {
        const double part = (double)k / (FW_OWN_LOOKS - 1), s = part * o->length_m;
        const own_section at = own_at(o, s);
        if (o->across) { /* as fw_flexure_across_strain has it */
            own->by_moment[k] = 12 / (at.wide_m * h * h * o->in->youngs_Pa);
            own->by_other[k] = section_at(&o->tall, at.pose.angle_rad, 0, at.wide_m, h).twist *
                               (2 * at.warped_m + 0.5 * fmin(at.wide_m, h));
        } else if (strained->n > 1) {
            int i = 0;
            while (i < strained->n - 2 && strained->point[i + 1].part < part)
                i++;
            const fw_flexure_path_point *p = &strained->point[i], *q = p + 1;
            if (k == 0) q = p;
            if (k == FW_OWN_LOOKS - 1) p = q = &strained->point[strained->n - 1];
            if (k > 0 && i == 0 && strained->n > 2) p = q;
            own->by_moment[k] = fmax(p->strain_per_Nm, q->strain_per_Nm);
            own->by_other[k] = fmax(p->strain_per_N, q->strain_per_N);
        }
        for (int i = 0; i < FW_OWN_LOADS; i++) {
            double bears[3] = {0};
            if (i >= OWN_BODY || (i / 2 + 0.5) / FW_OWN_PARTS > part) own_bears(o, &at, i, bears);
            own->moment[k][i] = bears[0], own->other[k][i] = bears[1];
        }
    }
}

/* goes, back and modes of the strip between its ends; c: of all loads */
static fw_status own_swings(fw_arena *arena, double (*c)[FW_OWN_LOADS], fw_flexure_own *own) {
    enum { N = OWN_BODY };
    double held[3][3], unit[3] = {1, 1, 1}, det, *a, *value;
    fw_maths_lapack_space space;
    FW_NEED(a = fw_arena_array(arena, double, N *N + N));
    value = a + N * N;
    FW_TRY(fw_maths_eigen_space(arena, N, &space));
    for (int i = 0; i < 3; i++)
        unit[i] = 1 / sqrt(c[N + i][N + i]); /* of one size, whatever the units */
    for (int i = 0; i < 9; i++) {
        held[i / 3][i % 3] = c[N + i / 3][N + i % 3] * unit[i / 3] * unit[i % 3];
        own->back[i / 3][i % 3] = i % 4 == 0;
    }
    if (!fw_maths_solve3((const double(*)[3])held, 3, own->back, &det)) return FW_SOLVER;
    for (int i = 0; i < 9; i++)
        own->back[i / 3][i % 3] *= unit[i / 3] * unit[i % 3];
    for (int i = 0; i < N; i++)
        for (int k = 0; k < 3; k++)
            own->goes[i / 2][i % 2][k] = dot3(c[i] + N, own->back[k]);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            a[i * N + j] = sqrt(own->mass[i / 2][i % 2] * own->mass[j / 2][j % 2]) *
                           (c[i][j] - dot3(own->goes[i / 2][i % 2], c[j] + N));
    if (!fw_maths_eigen(N, a, value, &space)) return FW_SOLVER;
    for (int k = 0; k < FW_OWN_MODES; k++) {
        own->s2[k] = fmax(value[N - 1 - k], 0);
        for (int i = 0; i < N; i++)
            own->mode[k][i / 2][i % 2] = a[(N - 1 - k) * N + i] / sqrt(own->mass[i / 2][i % 2]);
    }
    own->rest_s2 = fmax(value[N - 1 - FW_OWN_MODES], 0);
    return FW_OK;
}

fw_status fw_flexure_own_of(fw_arena *arena, const fw_flexure_input *in,
                            const fw_flexure_result *closed_form,
                            const fw_flexure_path_strain *strained, bool across, double kg_per_m2,
                            fw_flexure_own *own) {
    fw_mark mark = fw_arena_mark(arena);
    fw_flexure_course *p;
    double(*c)[FW_OWN_LOADS];
    FW_NEED(p = fw_arena_one(arena, fw_flexure_course));
    FW_NEED(c = fw_arena_alloc(arena, FW_OWN_LOADS, sizeof *c));
    memset(c, 0, FW_OWN_LOADS * sizeof *c);
    fw_flexure_path_of(in, p);
    own_strip o = {.in = in, .p = p, .across = across};
    o.flat = fw_flexure_path_stuff_of(p, in);
    o.tall = (stuff){in->crystal.known ? &in->crystal : NULL, in->youngs_Pa,
                     in->crystal.known ? closed_form->poisson : in->poisson};
    o.pin[0] = closed_form->centre_m + closed_form->offset_m[0];
    o.pin[1] = closed_form->offset_m[1];
    for (int i = 0; i < p->n; i++)
        o.length_m += p->shape[i].piece.length_m;
    *own = (fw_flexure_own){.rest_s2 = 0};
    own_loads(&o, kg_per_m2, own);
    const double cut = o.length_m / (OWN_CUTS * FW_OWN_PARTS);
    for (int i = 0; i < 2 * OWN_CUTS * FW_OWN_PARTS; i++) { /* two places of Gauss in each */
        const double s = (i / 2 + 0.5 + (i % 2 ? 0.5 : -0.5) / sqrt(3)) * cut;
        const own_section at = own_at(&o, s);
        own_add(&o, &at, s, 0.5 * cut, c);
    }
    own_add_roots(&o, c);
    for (int i = 0; i < FW_OWN_LOADS; i++)
        for (int j = i + 1; j < FW_OWN_LOADS; j++)
            c[i][j] = c[j][i];
    own_look(&o, strained, own);
    const fw_status status = own_swings(arena, c, own);
    fw_arena_rewind(arena, mark);
    return status;
}
