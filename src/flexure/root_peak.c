/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peak strain at a root, as a bound over solids: isotropic and of a crystal. */
#include "base/constants.h"
#include "flexure/flexure.h"
#include "flexure/section.h"
#include <math.h>

/* What a solid has at a root over what a beam of the same moment has there with the plane-stress
   concentration Kt of its fillet, as an upper bound:

     peak strain = M t/2/(E I D g) Kt (1 + u) G                                       isotropic
     peak stress = M t/2/(I D g) Kt max over both fillets of (1 + u) A (1 + B)        crystal
     G, A, B: sums of c x^i q^j p^k nu^l n^m u^o (cos 4 psi')^v (sin 4 psi')^w, the tables below

   x = rho/t, q = x^(-2/3), p = h/(h + 4 t), u = t/3R (0: straight; of a crystal's outer fillet with
   the other sign), n = nu f, f the part of the cross-bow that is free to form (8). n: a block keeps
   its end of the strip from bowing, so that the middle of the depth carries more of the moment than
   the faces; nu q: a notch is in plane strain in its middle; u: the fillets of an arc are not mirror
   images. psi' is the direction of the strip from [100] 1.35 rho/R before the root; sine > 0: the
   fillet on the inside of the arc turns towards the stiff <110>, the other one away from it; a
   straight strip has one on either side. Of an unknown direction the worst. Other cubic crystals:
   cosine and sine times the share that a1/a0 has of silicon's (not compared).

   M is the closed form's with what its ends lose (13a): the strain at a root is a matter of the
   moment there, and goes with L only by that.

   in: x held to [0.1, 2], p to that of h = t/2 and h = 30 t, nu and n to [0, 0.4], u to 0.05 in the
   sums (t/R = 0.15); out: 1. Fitted (Chebyshev, linear programs) to 331 isotropic solids and 410 of
   silicon: above all of them, by 0.3 to 1.9 % isotropic, 1.7 % (leaves) and 2.1 % (arcs) of silicon
   within the range of the narrow band (fillets from t/10, silicon 0.15 t, to 1.25 t, no deeper than
   10 t), by up to 3.9 % and 5.1 % beyond it. 60 isotropic solids that were not fitted: 0.3 to 2.0 %;
   57 of silicon before they were: -0.5 to 2.3 %; 44 since, of silicon, 0.6 to 2.5 %, where they are
   shallower than wide to 4.1 % (root_strain_unseen.csv).
   The solids' own error is 0.3 %. Cost 0.3 us, of a crystal 1.5 us.
   source: docs/theory/root-strain.md eq. 11a, docs/theory/flexure-silicon.md eq. 14; solids and fit:
   tools/solids; test_root_strain.c, test_crystal.c peak_stress_of_silicon */
typedef struct root_term {
    double by;
    signed char power[8]; /* of x, q, p, nu, n, u, cosine, sine */
} root_term;

static const root_term EVEN[] = {
    {1.0206, {0, 0, 0, 0, 0, 0, 0, 0}},   {0.74219, {0, 0, 3, 0, 0, 0, 0, 0}},
    {40.584, {2, 0, 1, 0, 2, 1, 0, 0}},   {-0.54381, {1, 0, 3, 0, 0, 0, 0, 0}},
    {-0.81571, {0, 0, 4, 0, 0, 0, 0, 0}}, {-0.065301, {0, 0, 1, 0, 0, 0, 0, 0}},
    {0.7011, {1, 0, 4, 0, 0, 0, 0, 0}},   {-4.1064, {0, 1, 0, 0, 0, 2, 0, 0}},
    {-0.98729, {0, 0, 1, 0, 2, 0, 0, 0}}, {0.66387, {0, 0, 3, 0, 1, 0, 0, 0}},
    {0.37319, {1, 0, 0, 0, 0, 1, 0, 0}},  {0.00096288, {0, 2, 0, 0, 0, 0, 0, 0}},
    {46.504, {1, 0, 4, 0, 1, 1, 0, 0}},   {-76.151, {2, 0, 2, 0, 2, 1, 0, 0}},
    {0.36242, {0, 1, 2, 0, 2, 0, 0, 0}},  {128.73, {0, 2, 3, 0, 2, 2, 0, 0}},
    {-8.692, {1, 0, 3, 1, 0, 1, 0, 0}},   {-0.50274, {0, 2, 1, 2, 0, 1, 0, 0}},
};
static const root_term LEAF_DIRECTION[] = {
    {0.94976, {0, 0, 0, 0, 0, 0, 0, 0}},    {0.053591, {1, 0, 0, 0, 0, 0, 0, 0}},
    {0.079017, {0, 1, 0, 0, 0, 0, 0, 0}},   {-0.13921, {0, 0, 0, 0, 0, 0, 1, 0}},
    {0.035991, {1, 0, 0, 0, 0, 0, 1, 0}},   {0.038076, {0, 1, 0, 0, 0, 0, 1, 0}},
    {0.11658, {0, 0, 0, 0, 0, 0, 0, 1}},    {-0.055573, {1, 0, 0, 0, 0, 0, 0, 1}},
    {0.043864, {0, 1, 0, 0, 0, 0, 0, 1}},   {-0.0056543, {0, 2, 0, 0, 0, 0, 0, 0}},
    {-0.0071442, {0, 2, 0, 0, 0, 0, 0, 1}},
};
static const root_term LEAF_LEVEL[] = {
    {-3.616, {0, 0, 3, 0, 1, 0, 0, 0}},  {-1.6064, {0, 0, 1, 0, 1, 0, 0, 0}},
    {-1.1022, {1, 0, 2, 1, 0, 0, 0, 0}}, {1.2749, {1, 0, 3, 1, 0, 0, 0, 0}},
    {5.3339, {0, 0, 2, 0, 1, 0, 0, 0}},  {0.017306, {1, 0, 1, 0, 0, 0, 1, 0}},
};
static const root_term ARC_DIRECTION[] = {
    {1.0598, {0, 0, 0, 0, 0, 0, 0, 0}},    {0.0214, {1, 0, 0, 0, 0, 0, 0, 0}},
    {0.0078132, {0, 1, 0, 0, 0, 0, 0, 0}}, {-0.21173, {0, 0, 0, 0, 0, 0, 1, 0}},
    {0.14282, {1, 0, 0, 0, 0, 0, 1, 0}},   {0.042537, {0, 1, 0, 0, 0, 0, 1, 0}},
    {-0.020267, {0, 0, 0, 0, 0, 0, 0, 1}}, {-0.0083954, {1, 0, 0, 0, 0, 0, 0, 1}},
    {0.13901, {0, 1, 0, 0, 0, 0, 0, 1}},   {0.0075124, {0, 2, 0, 0, 0, 0, 0, 0}},
    {-0.024885, {0, 2, 0, 0, 0, 0, 0, 1}}, {0.12522, {0, 0, 0, 0, 0, 1, 0, 1}},
    {0.014052, {0, 1, 0, 0, 0, 0, 1, 1}},  {-0.019125, {0, 0, 0, 0, 0, 0, 1, 1}},
    {-0.050025, {2, 0, 0, 0, 0, 0, 1, 0}},
};
static const root_term ARC_LEVEL[] = {
    {-3.8397, {0, 0, 3, 0, 1, 0, 0, 0}},  {-1.5603, {0, 0, 1, 0, 1, 0, 0, 0}},
    {-2.0353, {1, 0, 2, 1, 0, 0, 0, 0}},  {2.5017, {1, 0, 3, 1, 0, 0, 0, 0}},
    {-0.56982, {0, 1, 0, 0, 0, 1, 0, 0}}, {5.6494, {0, 0, 2, 0, 1, 0, 0, 0}},
    {2.1024, {0, 0, 1, 0, 0, 1, 0, 0}},   {2.6834, {1, 0, 0, 0, 1, 1, 0, 0}},
    {-0.92399, {0, 0, 0, 0, 1, 1, 0, 0}}, {0.87799, {0, 1, 0, 0, 1, 1, 0, 0}},
    {-0.77585, {0, 0, 2, 0, 1, 0, 1, 0}}, {-0.21727, {1, 0, 1, 0, 0, 1, 0, 0}},
    {0.23712, {1, 0, 2, 0, 1, 0, 0, 0}},  {-1.1155, {0, 0, 2, 0, 2, 0, 0, 0}},
    {0.46425, {0, 0, 1, 0, 1, 0, 1, 0}},  {0.069893, {0, 0, 2, 0, 0, 0, 1, 0}},
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

enum { X, Q, P, NU, N, U, COSINE, SINE };

static void section_of(const fw_flexure_root_case *r, double at[8]) {
    const double most_curved = 0.05, shallow = 1 / 9.0, deep = 15 / 17.0, most_bow = 0.4;
    double x = fmin(fmax(r->fillet_m / r->width_m, 0.1), 2.0), p = r->depth_m / r->width_m;
    at[X] = x, at[Q] = 1 / cbrt(x * x);
    at[P] = fmin(fmax(p / (p + 4), shallow), deep);
    at[NU] = fmin(fmax(r->poisson, 0), most_bow);
    at[N] = fmin(fmax(r->poisson * r->bow, 0), most_bow);
    at[U] = fmin(fabs(r->curved), most_curved);
    at[COSINE] = at[SINE] = 0;
}

/* (1 + u) A (1 + B) of the worse fillet where 4 psi' has this cosine and sine */
static double of_fillets(const fw_flexure_root_case *r, double share, double four_psi) {
    double at[8], worst = 0, u = fabs(r->curved);
    section_of(r, at);
    double curved = at[U], cosine = share * cos(four_psi), sine = share * sin(four_psi);
    for (int side = 1; side >= -1; side -= 2) {
        at[U] = side * curved, at[COSINE] = cosine, at[SINE] = side * sine;
        double along = u > 0 ? SUM(ARC_DIRECTION, at) : SUM(LEAF_DIRECTION, at);
        double level = u > 0 ? SUM(ARC_LEVEL, at) : SUM(LEAF_LEVEL, at);
        worst = fmax(worst, (1 + side * u) * along * (1 + level));
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
    double u = fabs(r->curved), at[8];
    if (r->fillet_m < 0) return 1 + u;
    double Kt = fw_flexure_fillet_concentration(r->width_m, r->fillet_m);
    section_of(r, at);
    if (!k || !k->known) return Kt * (1 + u) * SUM(EVEN, at);
    if (!k->aligned) return Kt * of_any_direction(r, k->share);
    /* of an arc that turns right and of the first end the mirror image */
    double sense = r->curved < 0 ? -r->end : r->end;
    double four_psi = sense * (atan2(k->sin4, k->cos4) + 4 * r->angle_rad);
    return Kt * of_fillets(r, k->share, four_psi - 12 * before * at[X] * at[U]);
}

void fw_flexure_peak_strain(const fw_flexure_shape *f, double beam, double inside, double root,
                            fw_flexure_result *out) {
    out->concentration = f->fillet_m < 0 ? inside : fmax(inside, root);
    out->fibre = inside;
    out->strain_per_rad = beam * out->concentration;
    out->strain_fit_per_rad = beam * f->fillet_concentration * inside;
}
