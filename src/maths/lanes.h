/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FW_W doubles in one register, one per design or per hinge: a number for FW_W = 1, a vector for FW_W = 2, 4 or 8.
   To be included once in a translation unit that defines FW_W.

   FW_BRIEF 1, for the lanes alone: sines to 1.6 ulp in place of 0.9. */
#ifndef FW_MATHS_LANES_H
#define FW_MATHS_LANES_H
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

#define FW_INLINE static inline __attribute__((always_inline))

#if FW_W == 1
typedef double real;
#define LANE(number, lane) (*((void)(lane), &(number)))
typedef int64_t bits;
typedef uint64_t unsigned_bits;                /* shifts to the left lose bits on purpose */
#define MASK(comparison) (-(bits)(comparison)) /* all bits where it holds */
FW_INLINE bits bits_of(real a) {
    bits b;
    memcpy(&b, &a, sizeof b);
    return b;
}
FW_INLINE real real_from(bits b) {
    real a;
    memcpy(&a, &b, sizeof a);
    return a;
}
FW_INLINE real real_of(double x) {
    return x;
}
#else
typedef double real __attribute__((vector_size(8 * FW_W)));
#define LANE(number, lane) ((number)[lane])
typedef int64_t bits __attribute__((vector_size(8 * FW_W)));
typedef uint64_t unsigned_bits __attribute__((vector_size(8 * FW_W)));
#define MASK(comparison)   ((bits)(comparison))
FW_INLINE bits bits_of(real a) {
    return (bits)a;
}
FW_INLINE real real_from(bits b) {
    return (real)b;
}
FW_INLINE real real_of(double x) {
    return x - (real){0};
}
#endif

/* of masks, whose lanes are all ones or all zeros: bit i where lane i is one */
FW_INLINE unsigned bits_lanes(bits mask) {
#if FW_W == 8
    return _mm512_movepi64_mask((__m512i)mask);
#elif FW_W == 4
    return (unsigned)_mm256_movemask_pd((__m256d)mask);
#else
    unsigned all = 0;
    for (int i = 0; i < FW_W; i++)
        all |= (unsigned)(LANE(mask, i) & 1) << i;
    return all;
#endif
}
FW_INLINE bool bits_any(bits mask) {
    return bits_lanes(mask) != 0;
}

FW_INLINE real real_abs(real a) {
    return real_from(bits_of(a) & INT64_MAX);
}
FW_INLINE real real_select(bits mask, real a, real b) {
    return real_from((mask & bits_of(a)) | (~mask & bits_of(b)));
}
/* comparisons inside loops are kept as sign bits: minus what must not be negative, gathered by | */
FW_INLINE bits bits_negative(bits signs) {
    return MASK(signs < 0);
}
FW_INLINE real real_max(real a, real b) { /* a stays when it is NaN, b enters when it is */
    return real_select(MASK(b > a) | MASK(b != b), b, a);
}
/* the largest; NaN when one is NaN */
static inline double real_most(real a) {
    double most = LANE(a, 0);
    for (int i = 1; i < FW_W; i++)
        most = LANE(a, i) > most || LANE(a, i) != LANE(a, i) ? LANE(a, i) : most;
    return most;
}

/* Sine and cosine of FW_W angles at once.

   x = n pi/2 + r, |r| <= pi/4: pi/2 in two parts of 33 bits, whose products with n are exact, and a
   third of 53 bits; r is kept as a sum of two doubles. Then minimax polynomials of degree 13 (sine,
   relative error 2^-57.9) and 14 (cosine, 2^-63.9) of r, and the quadrant by masks. The library's
   own would give other bits on a processor with FMA than on one without. Input x in rad, any;
   output s, c. Valid for |x| <= fw_sincos_range; beyond it, and for NaN, the callers ask the C
   library. Error below 0.9 ulp (0.83 found) without FMA. Cost about 55 operations, no branch;
   FW_BRIEF 1 leaves out the second doubles: 27 operations, error below 1.6 ulp. Source: Cody and
   Waite 1980, ch. 8; polynomials by the Remez exchange in 60 digits. Test: test_kernel.c (quad
   precision). */
static const double fw_sincos_range = 1e5;

FW_INLINE void real_sincos(real x, real *sine, real *cosine) {
    const double shift = 0x1.8p52; /* its unit is 1: rounds, and shows n in the low bits */
    real t = x * 0x1.45f306dc9c883p-1 + shift;
    bits q = bits_of(t);
    real n = t - shift;
    real a = x - n * 0x1.921fb54400000p+0;
#if FW_BRIEF
    real r = (a - n * 0x1.0b4611a600000p-34) - n * 0x1.3198a2e037073p-69;
#else
    real w = n * 0x1.0b4611a600000p-34, b = a - w;
    real v = n * 0x1.3198a2e037073p-69 - ((a - b) - w);
    real r = b - v, tail = (b - r) - v;
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
    bits other = -(q & 1) & (bits_of(s) ^ bits_of(c)); /* exchanges the two where n is odd */
    *sine = real_from(bits_of(s) ^ other ^ ((bits)((unsigned_bits)q << 62) & INT64_MIN));
    *cosine = real_from(bits_of(c) ^ other ^ ((bits)((unsigned_bits)(q + 1) << 62) & INT64_MIN));
}

#endif
