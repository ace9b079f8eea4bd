/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions over the small ranges that hinges have, short enough to stand in line: a
   closed form needs four sines and cosines, a root and a cube root, and the library's are half of
   its cost. Private to the room. */
#ifndef FW_FLEXURE_QUICK_H
#define FW_FLEXURE_QUICK_H
#include <math.h>
#include <stdint.h>
#include <string.h>

#define FW_INLINE static inline __attribute__((always_inline))

typedef double fw_pair __attribute__((vector_size(16))); /* two of a kind at once */
typedef uint64_t fw_bits __attribute__((vector_size(16)));

/* one instruction each, where fmin and fmax are calls; the second where the first is no number */
FW_INLINE double fw_larger(double a, double b) {
    return a > b ? a : b;
}
FW_INLINE double fw_smaller(double a, double b) {
    return a < b ? a : b;
}

/* sin x and cos x: x = n pi/2 + r, |r| <= pi/4, pi/2 in two parts of 33 and 53 bits (n times the
   first is exact, what both leave out is 2^-87 n), Taylor's series of r to r^15 and r^16, whose
   rest is below 7e-17; n swaps the two and sets their signs. Added to 2^52, a number has no places
   behind the point and n stands in the last bits.
   in: x rad, 0 <= x <= 64; out: 1. Error 2 ulp, or 4e-25 where that is more (next to a zero).
   Cost 4 ns. Source: Cody and Waite, Software Manual for the Elementary Functions, ch. 8.
   Test: test_quick.c sine_and_cosine */
FW_INLINE void fw_quick_sincos_near(double x, double *sine, double *cosine) {
    double shifted = x * 0x1.45f306dc9c883p-1 + 0x1p52, n = shifted - 0x1p52;
    double r = (x - n * 0x1.921fb544p+0) - n * 0x1.0b4611a626331p-34;
    double z1 = r * r, z2 = z1 * z1, z4 = z2 * z2;
    fw_pair z = {z1, z1}, low = {z2, z2}, high = {z4, z4};
    fw_pair rest =
        ((fw_pair){-1 / 6.0, 1 / 24.0} + z * (fw_pair){1 / 120.0, -1 / 720.0}) +
        low * ((fw_pair){-1 / 5040.0, 1 / 40320.0} + z * (fw_pair){1 / 362880.0, -1 / 3628800.0}) +
        high * (((fw_pair){-1 / 39916800.0, 1 / 479001600.0} +
                 z * (fw_pair){1 / 6227020800.0, -1 / 87178291200.0}) +
                low * (fw_pair){-1 / 1307674368000.0, 1 / 20922789888000.0});
    fw_bits value = (fw_bits)((fw_pair){r, 1 - 0.5 * z1} + (fw_pair){r * z1, z2} * rest);
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

/* x^(-1/3): a third of the exponent from the bits, within 3.4 %, then twice the first four terms of
   y (1 - d)^(-1/3), d = 1 - x y^3, which take a relative error e to 12 e^4.
   in: x > 0, normal; out: 1. Error 2 ulp. Cost 5 ns. Source: binomial series.
   Test: test_quick.c cube_roots */
FW_INLINE double fw_quick_per_cube_root(double x) {
    uint64_t bits;
    double y;
    memcpy(&bits, &x, sizeof bits);
    bits = 0x553ef0ff289dd796u - bits / 3;
    memcpy(&y, &bits, sizeof y);
    for (int pass = 0; pass < 2; pass++) {
        double d = 1 - x * y * (y * y);
        y += y * d * (1 / 3.0 + d * (2 / 9.0 + d * (14 / 81.0)));
    }
    return y;
}

#endif
