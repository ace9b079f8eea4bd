/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions over the small ranges that hinges have, short enough to stand in line: a
   closed form needs a sine, a cosine and a cube root, deep strips an exponential too, and the
   library's would be half of its cost. Private to the room. */
#ifndef FW_FLEXURE_QUICK_H
#define FW_FLEXURE_QUICK_H
#include "flexure/lanes.h"

/* {sin r, cos r}: r + r^3 p(r^2) and 1 - r^2/2 + r^4 q(r^2), p and q minimax of degree 5 (rest
   below 4e-18; tools/minimax.py). in: |r| <= pi/4 rad; out: 1. Error 1 ulp. Cost 3 ns. Test:
   test_quick.c sine_and_cosine */
FW_INLINE fw_flexure_both fw_quick_small_angle(fw_flexure_real r) {
    static const double law[6][2] = {{-0x1.5555555555549p-3, 0x1.555555555554cp-5},
                                     {0x1.111111110f87bp-7, -0x1.6c16c16c1517dp-10},
                                     {-0x1.a01a019c11c83p-13, 0x1.a01a019cb1bd1p-16},
                                     {0x1.71de3577ea6a0p-19, -0x1.27e4f809f93a7p-22},
                                     {-0x1.ae5e666a03935p-26, 0x1.1ee9ebf426062p-29},
                                     {0x1.5d93106531dabp-33, -0x1.8faea46b3db14p-37}};
    fw_flexure_real z = r * r, z2 = z * z;
    return fw_both_madd(fw_both_of(r * z, z2), fw_quintics(law, z, z2, z2 * z2),
                        fw_both_of(r, 1 - 0.5 * z));
}

/* sine and cosine of half an angle, at most a full turn: cos 2r and -sin 2r of r = angle/4 - pi/4,
   |r| <= pi/4, which needs no quadrants. in: rad, 0 to 6.2832; out: 1. Error 6e-16, of the cosine 3
   ulp. Cost 4 ns. Test: test_quick.c half_angles */
FW_INLINE void fw_quick_half_turn(fw_flexure_real angle, fw_flexure_real *sine,
                                  fw_flexure_real *cosine) {
    fw_flexure_both of =
        fw_quick_small_angle((0.25 * angle - 0x1.921fb54442d18p-1) - 0x1.1a62633145c07p-55);
    fw_flexure_real s = fw_first(of), c = fw_second(of);
    *sine = (c - s) * (c + s);
    *cosine = -2 * s * c;
}

/* x^(-2/3): x = 2^e m, m in one of 32 equal parts of 1 to 2 and 1/m there about y; with d = m y -
   1, |d| <= 1/64, it is 2^(-2e/3) y^(2/3) (1 + d)^(-2/3), two figures from tables and a polynomial
   (minimax of degree 7, off by 9e-18; tools/minimax.py).
   in: 1/32 <= x < 8, beyond it something finite or NaN; out: 1. Error 3 ulp. Cost 3 ns.
   Test: test_quick.c two_thirds */
FW_INLINE fw_flexure_real fw_quick_two_thirds(fw_flexure_real x) {
    static const double part[32][2] = {
        {0x1.f81f81f81f820p-1, 0x1.fabc3375d249cp-1}, {0x1.e9131abf0b767p-1, 0x1.f0999b9824157p-1},
        {0x1.dae6076b981dbp-1, 0x1.e6f4f94b57ef8p-1}, {0x1.cd85689039b0bp-1, 0x1.ddc4cab9e69d2p-1},
        {0x1.c0e070381c0e0p-1, 0x1.d50083b2904afp-1}, {0x1.b4e81b4e81b4fp-1, 0x1.cca06ef2e0cdap-1},
        {0x1.a98ef606a63bep-1, 0x1.c49d93fbfe568p-1}, {0x1.9ec8e951033d9p-1, 0x1.bcf1a0acbb674p-1},
        {0x1.948b0fcd6e9e0p-1, 0x1.b596d60159ff4p-1}, {0x1.8acb90f6bf3aap-1, 0x1.ae87f77708322p-1},
        {0x1.8181818181818p-1, 0x1.a7c03ca8a8d4ap-1}, {0x1.78a4c8178a4c8p-1, 0x1.a13b44cd4ff11p-1},
        {0x1.702e05c0b8170p-1, 0x1.9af50bd0011a6p-1}, {0x1.6816816816817p-1, 0x1.94e9e0c47e8f7p-1},
        {0x1.6058160581606p-1, 0x1.8f165d86ee215p-1}, {0x1.58ed2308158edp-1, 0x1.89775f5c3bdd7p-1},
        {0x1.51d07eae2f815p-1, 0x1.840a006fcff7bp-1}, {0x1.4afd6a052bf5bp-1, 0x1.7ecb9210ae950p-1},
        {0x1.446f86562d9fbp-1, 0x1.79b99794a68f4p-1}, {0x1.3e22cbce4a902p-1, 0x1.74d1c1cbfdd1cp-1},
        {0x1.3813813813814p-1, 0x1.7011eaf332dafp-1}, {0x1.323e34a2b10bfp-1, 0x1.6b781313106dcp-1},
        {0x1.2c9fb4d812ca0p-1, 0x1.67025cc189e1ap-1}, {0x1.27350b8812735p-1, 0x1.62af0a37b6b49p-1},
        {0x1.21fb78121fb78p-1, 0x1.5e7c7ab2da592p-1}, {0x1.1cf06ada2811dp-1, 0x1.5a692817be1cep-1},
        {0x1.1811811811812p-1, 0x1.5673a4d0c8abap-1}, {0x1.135c81135c811p-1, 0x1.529a99e03975bp-1},
        {0x1.0ecf56be69c90p-1, 0x1.4edcc520c4f9bp-1}, {0x1.0a6810a6810a7p-1, 0x1.4b38f7af87565p-1},
        {0x1.0624dd2f1a9fcp-1, 0x1.47ae147ae147bp-1}, {0x1.0204081020408p-1, 0x1.443b0ef25cba5p-1}};
    static const double octave[8] = {
        0x1.428a2f98d728bp-1, 0x1.965fea53d6e3dp-2, 0x1.428a2f98d728bp+3,
        0x1.965fea53d6e3dp+2, 0x1.0000000000000p+2, 0x1.428a2f98d728bp+1,
        0x1.965fea53d6e3dp+0, 0x1.0000000000000p+0}; /* by the last bits of e */
    static const double law[4][2] = {{0x1.0000000000000p+0, 0x1.cf8a00651455dp-2},
                                     {-0x1.5555555555555p-1, -0x1.b0a2ee1aaafe8p-2},
                                     {0x1.1c71c71c746f1p-1, 0x1.98c7187b9b632p-2},
                                     {-0x1.f9add3c0d8484p-2, -0x1.855b321904a33p-2}};
    fw_flexure_real d = fw_mantissa(x) * fw_fetch(&part[0][0], 2, x, 47, 31) - 1, square = d * d;
    fw_flexure_both half = fw_cubics(law, d, square);
    return (fw_fetch(octave, 1, x, 52, 7) * fw_fetch(&part[0][1], 2, x, 47, 31)) *
           (fw_first(half) + (square * square) * fw_second(half));
}

#ifndef FW_FOUR_HINGES /* what differs by branches from one hinge to the next */

/* sin x and cos x: x = n pi/2 + r, |r| <= pi/4, pi/2 in two parts of 33 and 53 bits (n times the
   first is exact, what both leave out is 2^-87 n), then as above; n swaps the two and sets their
   signs. Added to 2^52, a number has no places behind the point and n stands in the last bits.
   in: x rad, 0 <= x <= 64; out: 1. Error 2 ulp, or 4e-25 where that is more (next to a zero).
   Cost 4 ns. Source: Cody and Waite, Software Manual for the Elementary Functions, ch. 8.
   Test: test_quick.c sine_and_cosine */
FW_INLINE void fw_quick_sincos_near(double x, double *sine, double *cosine) {
    double shifted = x * 0x1.45f306dc9c883p-1 + 0x1p52, n = shifted - 0x1p52;
    fw_bits value =
        (fw_bits)fw_quick_small_angle((x - n * 0x1.921fb544p+0) - n * 0x1.0b4611a626331p-34);
    fw_bits quarter = (fw_bits)(fw_pair){shifted, shifted}, odd = -(quarter & 1);
    fw_bits sign = ((quarter + (fw_bits){0, 1}) & 2) << 62, turned = {value[1], value[0]};
    fw_pair is = (fw_pair)(((turned & odd) | (value & ~odd)) ^ sign);
    *sine = is[0], *cosine = is[1];
}

/* the library's beyond that */
FW_INLINE void fw_quick_sincos(double x, double *sine, double *cosine) {
    if (x >= 0 && x <= 64)
        fw_quick_sincos_near(x, sine, cosine);
    else
        *sine = sin(x), *cosine = cos(x);
}

/* the library's beyond that */
FW_INLINE void fw_quick_half_angle(double angle, double *sine, double *cosine) {
    if (angle >= 0 && angle <= 6.2832)
        fw_quick_half_turn(angle, sine, cosine);
    else
        fw_quick_sincos(0.5 * angle, sine, cosine);
}

/* exp(-x): x = n ln 2 + r, |r| <= 0.35, ln 2 in two parts of 32 and 53 bits, then cosh r - sinh r
   by Taylor's series to r^14 (rest 4e-18), times 2^-n. in: 0 <= x <= 64; out: 1. Error 2 ulp. Cost
   3 ns. Source: as above, ch. 6. Test: test_quick.c exponential */
FW_INLINE double fw_quick_exp_minus(double x) {
    double shifted = x * 0x1.71547652b82fep+0 + 0x1p52, n = shifted - 0x1p52, power;
    double r = (x - n * 0x1.62e42fefp-1) - n * 0x1.473de6af278edp-34;
    double z1 = r * r, z2 = z1 * z1, z4 = z2 * z2;
    fw_pair z = {z1, z1}, low = {z2, z2}, high = {z4, z4};
    fw_pair rest =
        ((fw_pair){1 / 2.0, 1 / 6.0} + z * (fw_pair){1 / 24.0, 1 / 120.0}) +
        low * ((fw_pair){1 / 720.0, 1 / 5040.0} + z * (fw_pair){1 / 40320.0, 1 / 362880.0}) +
        high * ((fw_pair){1 / 3628800.0, 1 / 39916800.0} +
                z * (fw_pair){1 / 479001600.0, 1 / 6227020800.0});
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (1023 - bits) << 52;
    memcpy(&power, &bits, sizeof power);
    return power * (1 - (r - (z1 * rest[0] - r * z1 * rest[1])));
}

#endif
#endif
