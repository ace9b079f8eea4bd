/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sine and cosine of FW_W angles at once.

   x = n pi/2 + r, |r| <= pi/4: pi/2 in two parts of 33 bits, whose products with n are exact, and a
   third of 53 bits; r is kept as a sum of two doubles. Then minimax polynomials of degree 13 (sine,
   relative error 2^-57.9) and 14 (cosine, 2^-63.9) of r, and the quadrant by masks.
   Input x in rad, any; output s, c. Valid for |x| <= fw_sincos_range; beyond it, and
   for NaN, the callers ask the C library. Error below 0.9 ulp (0.83 found)
   without FMA. Cost about 55 operations, no branch; FW_BRIEF 1
   leaves out the second doubles: 25 operations with FMA (pi/2 in two parts), error below 1.6 ulp.
   Source: Cody and Waite 1980, ch. 8; polynomials by the Remez exchange in 60 digits. Test:
   test_kernel.c (quad precision). */
#ifndef FW_MULTIBODY_KERNEL_SINCOS_H
#define FW_MULTIBODY_KERNEL_SINCOS_H
#include "multibody/kernel_vector.h"

static const double fw_sincos_range = 1e5;

#if FW_W > 1
static inline __attribute__((always_inline)) void real_sincos(real x, real *sine, real *cosine) {
    const double shift = 0x1.8p52; /* its unit is 1: rounds, and shows n in the low bits */
    real t = x * 0x1.45f306dc9c883p-1 + shift;
    bits q = (bits)t;
    real n = t - shift;
#if FW_FUSED
    real a = real_less(x, n, real_of(0x1.921fb54442d18p+0)); /* exact: |n| < 2^17 */
    real r = real_less(a, n, real_of(0x1.1a62633145c07p-54));
#else
    real a = x - n * 0x1.921fb54400000p+0;
#if FW_BRIEF
    real r = (a - n * 0x1.0b4611a600000p-34) - n * 0x1.3198a2e037073p-69;
#else
    real w = n * 0x1.0b4611a600000p-34, b = a - w;
    real v = n * 0x1.3198a2e037073p-69 - ((a - b) - w);
    real r = b - v, tail = (b - r) - v;
#endif
#endif
    real z = r * r, z2 = z * z, half = 0.5 * z, one = 1 - half;
    real ps = (-0x1.5555555555548p-3 + z * 0x1.111111110f7cap-7) +
              z2 * ((-0x1.a01a019bfd1bdp-13 + z * 0x1.71de356714d58p-19) +
                    z2 * (-0x1.ae5e59f7155e6p-26 + z * 0x1.5d8fa3765d455p-33));
    real pc = (0x1.555555555554bp-5 + z * -0x1.6c16c16c14f8ap-10) +
              z2 * ((0x1.a01a019c8390ap-16 + z * -0x1.27e4f7ea377c9p-22) +
                    z2 * (0x1.1ee9d7529243fp-29 + z * -0x1.8fa465f5db197p-37));
#if FW_BRIEF
    real s = r + (r * z) * ps, c = one + z2 * pc;
#else
    real s = r + ((r * z) * ps + tail * one);
    real c = one + (((1 - one) - half) + (z2 * pc - r * tail));
#endif
    bits other = -(q & 1) & ((bits)s ^ (bits)c); /* exchanges the two where n is odd */
    *sine = (real)((bits)s ^ other ^ ((q << 62) & INT64_MIN));
    *cosine = (real)((bits)c ^ other ^ (((q + 1) << 62) & INT64_MIN));
}
#endif

#endif
