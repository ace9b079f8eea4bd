/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws of section.h in line, with what a hinge's closed form has worked out already; of four
   hinges at once too (lanes.h). Private to the room. */
#ifndef FW_FLEXURE_SECTION_CORE_H
#define FW_FLEXURE_SECTION_CORE_H
#include "flexure/quick.h"
#include "flexure/section.h"

/* x = rho/t in the range of the laws of the root */
FW_INLINE fw_flexure_real fw_fitted_ratio(fw_flexure_real x) {
    return fw_smaller(fw_larger(x, fw_all(0.05)), fw_all(2.0));
}

/* dL = t (0.4192 - 0.5972 x - 0.1167 x^2), x = rho/t
   in: x in the fitted range; out: length added per root over t, negative above x = 0.63
   valid 0.05 <= x <= 1, blocks of 5 t and more behind the root; error 0.005
   fitted to plane-stress finite elements of three geometries and two materials
   docs/theory/flexure.md eq. 6; test_flexure.c root_law_matches_finite_elements */
static const double fw_root_block_law = 0.4192;
FW_INLINE fw_flexure_real fw_root_law(fw_flexure_real x) {
    return fw_root_block_law - 0.5972 * x - 0.1167 * x * x;
}

/* Kt = 0.944 + 0.2113 (t/rho)^(2/3), without the curved-beam factor 1 + t/3r
   valid as above; within 1 % of the finite elements it was fitted to, -0.2..+2.9 % on held-out ones
   docs/theory/root-strain.md eq. 7; test_flexure.c concentration_matches_finite_elements */
FW_INLINE fw_flexure_real fw_concentration_law(fw_flexure_real x) {
    return 0.944 + 0.2113 * fw_quick_two_thirds(x);
}

/* (t/rho)^(2/3) of that, no more than of rho = t/10 */
FW_INLINE fw_flexure_real fw_notch_of(fw_flexure_real concentration) {
    return fw_smaller((concentration - 0.944) * (1 / 0.2113), fw_all(4.641588833612779));
}

/* e/(r u^2), e = r - rn = r (1 - u/atanh u) (Winkler), where the difference would cancel by the
   polynomial of u^2 nearest to it (off by 3e-17; tools/minimax.py); thicker than t/r = 0.32 by
   fw_flexure_neutral_thick */
FW_INLINE fw_flexure_real fw_neutral_thin(fw_flexure_real u) {
    fw_flexure_real z = u * u, z2 = z * z;
    return ((0x1.5555555555556p-2 + z * 0x1.6c16c16c16088p-4) +
            z2 * (0x1.7d6d2c2b9bbe8p-5 + z * 0x1.eeb2ce0297badp-6)) +
           z2 * z2 *
               ((0x1.652133d2697fdp-6 + z * 0x1.126e236b9b095p-6) + z2 * 0x1.dcf590d6add0ap-7);
}

#ifndef FW_FOUR_HINGES
FW_INLINE double fw_neutral_series(double u) {
    return u < 0.16 ? fw_neutral_thin(u) : fw_flexure_neutral_thick(u);
}
#endif

FW_INLINE fw_flexure_real fw_golovin_law(fw_flexure_real u) {
    fw_flexure_real u2 = u * u;
    return 1.0 - 2.0 / 15.0 * u2 - u2 * u2 * (1 / 21.0);
}

/* cylindrical strip of depth h bent about the wafer normal, free edges z = +-h/2:
     x = h [3 (1-nu^2)]^(1/4) / sqrt(r t),  f = (2/x)(cosh x - cos x)/(sinh x + sin x)
     EI_eff/EI = (1 - nu^2 f)/(1 - nu^2)
   hoop strain: inner fibre at mid-depth 1 - C1/(rt/2), outer fibre at the edge
     1 + (C1 ch c + C2 sh s)/(rt/2) = 1 + k (4/x^2) (sinh x - sin x)/(sinh x + sin x),
   C1, C2 at X = x/2, k = nu h^2/(4 r t). All three are even in x and the same (f) or of the other
   sign (C1, the edge) at i x, so that f, C1/(k rt/2) and the edge over k are functions of z = x^4 =
   3 (1 - nu^2) (h^2/(r t))^2 alone, which asks for no root, exponential or sine. Their poles, the
   zeros of (sinh x + sin x)/2x, lie on z < 0, at -4 mu^4, tan mu + tanh mu = 0, and are those of a
   free bar. With the first seven as
   their denominator Q(z) they are quotients of polynomials of degree 7 up to x = 8, off by 2e-17
   (tools/minimax.py); deeper ones by fw_flexure_depth_deep.
   in: square
   = h^2/(r t), nu, per = 1/(1 - nu^2); out: both factors; x -> 0 plane stress, x -> infinity plane
   strain; error below 0.3 % against 3-D finite elements (rigid ends), 0.5 % with real roots. Cost 8
   ns docs/theory/flexure.md eq. 8, docs/theory/root-strain.md eq. 9-10;
   test_flexure.c depth_factor_limits_and_reference,
   test_quick.c depth_factors */
typedef struct fw_flexure_depth_start {
    fw_flexure_real z, poisson, nu2, rest, per, lift; /* x^4, nu, nu^2, 1 - nu^2, 1 over that, k */
} fw_flexure_depth_start;

FW_INLINE fw_flexure_depth_start fw_depth_start_of(fw_flexure_real square,
                                                   fw_flexure_real poisson) {
    fw_flexure_real nu2 = poisson * poisson, rest = 1 - nu2;
    return (fw_flexure_depth_start){.z = 3 * rest * (square * square),
                                    .poisson = poisson,
                                    .nu2 = nu2,
                                    .rest = rest,
                                    .per = 1 / rest,
                                    .lift = 0.25 * poisson * square};
}

/* The same of a crystal's strip. Plate and hoop energy per length of a section that bows by c,
   E' c^2 t^3/12 (its bending across) + E c^2 t h^4/(720 r^2) (its hoop strain), have E' = 1/s11 in
   one and E of the strip in the other: an affinity in z with (E/E')^(1/4) makes them those of an
   isotropic strip (Lekhnitskii, Anisotropic Plates, ch. on affine transformation) of
     nu^2 -> n^2 = nu nu' = s12^2 E/s11,  x^4 -> 3 (1 - n^2) (E/E') (h^2/(r t))^2
   and leave nu h^2, hence the hoop strain's k, as it is. With one nu D of silicon is 0.3 to 0.6 %
   too high for h >= 9 t, r <= 20 t.
   in: square = h^2/(r t), E Pa of the mean 1/E. Test: test_crystal.c ends_of_silicon */
FW_INLINE fw_flexure_depth_start fw_depth_start_crystal(fw_flexure_real square,
                                                        const fw_flexure_crystal *k,
                                                        fw_flexure_real E) {
    fw_flexure_real n2 = k->bow_per_Pa * E, rest = 1 - n2,
                    unlike = (k->a0_per_Pa + k->a1_per_Pa) * E;
    fw_flexure_real poisson = -k->s12_per_Pa * E;
    return (fw_flexure_depth_start){.z = 3 * rest * unlike * (square * square),
                                    .poisson = poisson,
                                    .nu2 = n2,
                                    .rest = rest,
                                    .per = 1 / rest,
                                    .lift = 0.25 * poisson * square};
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
     in: h, L, block = 0.4192 t (rigid end: 0) m; reach (G/(3 E'))^(1/2); f; out: m. l no more than
   L/3, where both ends would meet (outside of what was compared). Cost 2 ns. Error: K of 144 solids
   of silicon arcs (x 0.1 to 1.25, h/t 0.5 to 30, t/r to 0.15) is then -0.27 to 0.26 % off, 0.08 %
   rms (without: 0.42 %, 1.25 % at most), W of others 0.1 um.
   source: docs/theory/flexure-silicon.md eq. 13a; test_crystal.c ends_of_silicon */
typedef struct fw_flexure_end_loss {
    fw_flexure_real reach_m, length_m; /* l; f l^2/(l + 0.4192 t) */
} fw_flexure_end_loss;

FW_INLINE fw_flexure_real fw_end_reach(fw_flexure_real reach, fw_flexure_real depth_m,
                                       fw_flexure_real f, fw_flexure_real length_m) {
    return fw_smaller(depth_m * reach * f, (1 / 3.0) * length_m);
}

FW_INLINE fw_flexure_end_loss fw_end_loss_of(fw_flexure_real reach, fw_flexure_real depth_m,
                                             fw_flexure_real f, fw_flexure_real length_m,
                                             fw_flexure_real block_m) {
    fw_flexure_real l = fw_end_reach(reach, depth_m, f, length_m);
    return (fw_flexure_end_loss){.reach_m = l, .length_m = f * (l * l) / (l + block_m)};
}

/* f = of over; c1 = C1 / (rt/2), edge the bracket over it */
FW_INLINE fw_flexure_depth fw_depth_by(const fw_flexure_depth_start *from, fw_flexure_real of,
                                       fw_flexure_real over, fw_flexure_real c1,
                                       fw_flexure_real edge, fw_flexure_real per_part) {
    fw_flexure_real left = over - from->nu2 * of, per = 1 / (over * left); /* (1 - nu^2 f) over */
    fw_flexure_real per_over = left * per, per_left = over * per, part = per_part * per_over;
    return (fw_flexure_depth){.stiffness = left * from->per * per_over,
                              .softness = from->rest * over * per_left,
                              .bow = of * per_over,
                              .inner = 1 - c1 * part,
                              .outer = 1 + edge * part};
}

/* x <= 8 */
FW_INLINE fw_flexure_depth fw_depth_near(const fw_flexure_depth_start *from) {
    static const double stiff[8][2] = {{0x1.0000000000000p+0, 0x1.0000000000000p+0},
                                       {0x1.10fe6934aafd4p-7, 0x1.6bcc21fa7e721p-9},
                                       {0x1.6f618bcc145b3p-19, 0x1.249456cbca3fcp-21},
                                       {0x1.53b7e96db87b8p-33, 0x1.7e2b72af5744dp-36},
                                       {0x1.62da427f36276p-49, 0x1.2f2a73804c661p-52},
                                       {0x1.04435993ae757p-66, 0x1.5b6fd9b1ee1eap-70},
                                       {0x1.1b8b627de79fdp-85, 0x1.23e4828aabafbp-89},
                                       {0x1.8311c31e245a2p-106, 0x1.0d47eb5a2a719p-110}};
    static const double hoop[8][2] = {{0x1.5555555555555p-2, 0x1.5555555555555p-1},
                                      {-0x1.a335fbb11d4f6p-14, 0x1.9f53031bd92e1p-11},
                                      {0x1.ccd907801cb81p-29, 0x1.a6d1cc063236dp-24},
                                      {-0x1.1894031d8ba8ap-45, 0x1.8f74db51ee5abp-39},
                                      {0x1.2b45ed8f480c1p-63, 0x1.e6683f27eb5d9p-56},
                                      {-0x1.6fe4c96047d55p-82, 0x1.b413d9facee34p-74},
                                      {0x1.361e8235e345ep-101, 0x1.1699265c4a5f2p-93},
                                      {-0x1.8c0b9e948c137p-121, 0x1.364bc77d9de83p-115}};
    fw_flexure_real z = from->z, z2 = z * z, z4 = z2 * z2;
    fw_flexure_both f = fw_septics(stiff, z, z2, z4), c = fw_septics(hoop, z, z2, z4);
    return fw_depth_by(from, fw_second(f), fw_first(f), -fw_first(c), fw_second(c), from->lift);
}

#ifndef FW_FOUR_HINGES
FW_INLINE fw_flexure_depth fw_depth_law(const fw_flexure_depth_start *from) {
    return from->z <= 4096 ? fw_depth_near(from) : fw_flexure_depth_deep(*from);
}
#endif

/* What a solid has at a root over what (5) says without its depth factors, as an upper bound:
     q = (t/rho)^(2/3),  x = rho/t,  p = h/(h + 4 t),  u = t/3R (0: straight)
     n = nu f, f as above (straight: nu): what the strip bows across as it bends, over its bending
     peak strain = M t/2/(EI D) Kt (1 + u) G
     G = 1.0312 + n p (1.8208 p^2 - 0.7838) + nu p^2 (q (0.8824 - 1.069 p) - 0.0907 x p)
         + u (0.316 p + 3.092 n x - 0.2066 q)
   n: a block keeps its end of the strip from bowing, so that the middle of the depth carries more
   of the moment than the faces, the more of it the wider the strip; nu q: a notch is in plane
   strain in the middle, where its concentration differs; u: the fillets of an arc are not mirror
   images.
   in: x clamped to [0.1, 2], q of that x, h, t m, nu, n, u >= 0; out: 1. Cost 3 ns. Fitted
   (Chebyshev) to 262 solids, arcs and leaves: x 0.1 to 2, h/t 0.5 to 30, t/r 0.025 to 0.15, nu 0.1
   to 0.36, so that it is above all of them: by 0.3 to 3.5 %, deeper than 10 t by 0.1 to 4.3 %; the
   solids' own error is 0.3 %.
   source: docs/theory/root-strain.md eq. 11a; solids and fit: tools/solids;
   test_root_strain.c */
FW_INLINE fw_flexure_real fw_root_rise(fw_flexure_real x, fw_flexure_real q, fw_flexure_real p,
                                       fw_flexure_real nu, fw_flexure_real n, fw_flexure_real u) {
    fw_flexure_real p2 = p * p;
    return 1.0312 + n * p * (1.8208 * p2 - 0.7838) +
           nu * p2 * (q * (0.8824 - 1.069 * p) - 0.0907 * x * p) +
           u * (0.316 * p + 3.092 * n * x - 0.2066 * q);
}

/* The same of a crystal's stress, over M t/2/(I D) Kt, as an upper bound:
     G = max((1 + u)(A + B c + D u s + C s)(H + u V), (1 - u)(A + B c + D u s - C s)(H - u V))
     A = a0 + a1 x + a2 q + a3 q^2,  B = b0 + b1 x + b2 q,  C = c0 + c1 x + c2 q + c3 q^2
     H = 1 + n p (h1 p^2 + h2 p + h3) + nu p^2 x (h4 + h5 p),  V = v1 p + n (v2 x + v3) + v4 q
   (the numbers are below). c, s: cosine and sine of 4 psi', psi' the direction of the strip from
   [100] 1.35 rho/R before the root. s > 0: the fillet on the inside of the arc turns towards the
   stiff <110>, the other one away from it; a straight strip has one on either side. What the
   curvature does to the inner fillet it does to the outer one with the other sign. Of an unknown
   direction the worst.
     in: heading of 4 psi at the root, its sine such that s is as above; share: a1/a0 over
   silicon's, by which B, C and D go for other crystals (not compared); x, q, p, n, u as above, p of
   no more than h = 30 t, nu out of the plane, of the mean modulus; out: 1. Cost 4 ns. Fitted
   (Chebyshev) to 285 solids of silicon, x 0.1 to 2, h/t 0.5 to 30: above all of them by 0.3 to
   3.6 %, deeper than 10 t by 0.1 to 4.4 %; fitted to 70 % of them it is -1.3 to 4.9 % above the
   others.
   source: docs/theory/flexure-silicon.md eq. 14; tools/solids; test_root_strain.c, test_crystal.c
   peak_stress_of_silicon
 */
typedef struct fw_flexure_root_crystal {
    fw_flexure_real even, along, across, lean; /* A, B, C, D u */
    fw_flexure_real x, q, u;
} fw_flexure_root_crystal;

typedef struct
    fw_flexure_root_worst { /* (1 + u)(A + ...) of the inner fillet, (1 - u)(A + ...) of the
                                  outer */
    fw_flexure_real inner, outer;
} fw_flexure_root_worst;

FW_INLINE fw_flexure_root_crystal fw_root_crystal_of(fw_flexure_real share, fw_flexure_real x,
                                                     fw_flexure_real q, fw_flexure_real u) {
    return (fw_flexure_root_crystal){.even = 1.0721 + 0.02 * x + q * (0.0172 + 0.0039 * q),
                                     .along = share * (-0.1134 + 0.0261 * x + 0.0305 * q),
                                     .across =
                                         share * (-0.077 + 0.0061 * x + q * (0.1783 - 0.0305 * q)),
                                     .lean = share * 0.394 * u,
                                     .x = x,
                                     .q = q,
                                     .u = u};
}

/* the worse of two roots whose 4 psi are b - w and b + w, cosine and sine of both angles given. b
   is turned back by 16.2 x u = 5.4 rho/R, of which sine and cosine stand as their Taylor series,
   2e-4 of 1 off at 1 rad, with which the laws were fitted. The larger of a + b and a - b is a + |b|
 */
FW_INLINE fw_flexure_root_worst fw_root_crystal_at(const fw_flexure_root_crystal *r,
                                                   fw_flexure_real cos_w, fw_flexure_real sin_w,
                                                   fw_flexure_real cos_b, fw_flexure_real sin_b) {
    fw_flexure_real e = 16.2 * r->x * r->u, z = e * e;
    fw_flexure_real S = e * (1 - z * (1 / 6.0 - z * (1 / 120.0)));
    fw_flexure_real C = 1 - z * (0.5 - z * (1 / 24.0 - z * (1 / 720.0)));
    fw_flexure_real c = cos_b * C + sin_b * S, s = sin_b * C - cos_b * S, Bc = r->along * c,
                    Bs = r->along * s;
    fw_flexure_real P = r->lean + r->across, Q = r->lean - r->across;
    return (fw_flexure_root_worst){
        (1 + r->u) * (r->even + (Bc + P * s) * cos_w + fw_size((P * c - Bs) * sin_w)),
        (1 - r->u) * (r->even + (Bc + Q * s) * cos_w + fw_size((Q * c - Bs) * sin_w))};
}

#ifndef FW_FOUR_HINGES
/* the worst direction */
FW_INLINE fw_flexure_root_worst fw_root_crystal_any(const fw_flexure_root_crystal *r) {
    fw_flexure_real P = r->lean + r->across, Q = r->lean - r->across, B = r->along * r->along;
    return (fw_flexure_root_worst){(1 + r->u) * (r->even + sqrt(B + P * P)),
                                   (1 - r->u) * (r->even + sqrt(B + Q * Q))};
}
#endif

/* G */
FW_INLINE fw_flexure_real fw_root_crystal_peak(const fw_flexure_root_crystal *r,
                                               const fw_flexure_root_worst *worst,
                                               fw_flexure_real p, fw_flexure_real nu,
                                               fw_flexure_real n) {
    p = fw_smaller(p, fw_all(15 / 17.0));
    fw_flexure_real p2 = p * p, level = 1 + n * p * (-4.4563 * p2 + 6.5109 * p - 2.0268) +
                                        nu * p2 * r->x * (-1.3063 + 1.6285 * p);
    fw_flexure_real tilt = r->u * (1.5231 * p + n * (0.3433 * r->x + 2.1208) - 0.4898 * r->q);
    return fw_larger(worst->inner * (level + tilt), worst->outer * (level - tilt));
}

#endif
