/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FW_W doubles in one register: include once per translation unit with FW_W = 1, 2, 4 or 8. */
#ifndef FW_MULTIBODY_KERNEL_VECTOR_H
#define FW_MULTIBODY_KERNEL_VECTOR_H
#ifndef FW_BRIEF
#define FW_BRIEF 0
#endif
/* products and sums rounded once, by name: never where the bits must be those of every processor */
#if FW_BRIEF && FW_W > 2 && defined(__FMA__)
#define FW_FUSED 1
#else
#define FW_FUSED 0
#endif

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

#if FW_W == 1
typedef double real;
typedef int64_t bits;
#define MASK(comparison) (-(bits)(comparison)) /* all bits where it holds */
static inline bits bits_of(real a) {
    bits b;
    memcpy(&b, &a, sizeof b);
    return b;
}
static inline real real_abs(real a) {
    return fabs(a);
}
static inline real real_of(double x) {
    return x;
}
static inline real real_select(bits mask, real a, real b) {
    return mask ? a : b;
}
static inline bool bits_any(bits mask) {
    return mask != 0;
}
static inline double real_most(real a) {
    return a;
}
#else
typedef double real __attribute__((vector_size(8 * FW_W)));
typedef int64_t bits __attribute__((vector_size(8 * FW_W)));
#define MASK(comparison) ((bits)(comparison))
static inline bits bits_of(real a) {
    return (bits)a;
}
static inline real real_abs(real a) {
    return (real)((bits)a & INT64_MAX);
}
static inline real real_of(double x) {
    return x - (real){0};
}
static inline real real_select(bits mask, real a, real b) {
    return (real)((mask & (bits)a) | (~mask & (bits)b));
}
/* of masks: every lane is all ones or all zeros */
static inline bool bits_any(bits mask) {
#if defined(__AVX512DQ__) && FW_W == 8
    return _mm512_movepi64_mask((__m512i)mask) != 0;
#elif defined(__AVX2__) && FW_W == 4
    return _mm256_movemask_pd((__m256d)mask) != 0;
#else
    int64_t all = 0;
    for (int i = 0; i < FW_W; i++)
        all |= mask[i];
    return all != 0;
#endif
}
#if FW_FUSED
static inline real real_less(real c, real a, real b) { /* c - a b, rounded once */
#if FW_W == 8
    return (real)_mm512_fnmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
    return (real)_mm256_fnmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
#endif
}
#endif
/* the largest; NaN when one is NaN */
static inline double real_most(real a) {
    double most = a[0];
    for (int i = 1; i < FW_W; i++)
        most = a[i] > most || a[i] != a[i] ? a[i] : most;
    return most;
}
#endif

/* comparisons inside loops are kept as sign bits: minus what must not be negative, gathered by | */
static inline bits bits_negative(bits signs) {
    return MASK(signs < 0);
}

static inline real real_max(real a, real b) { /* a stays when it is NaN, b enters when it is */
    return real_select(MASK(b > a) | MASK(b != b), b, a);
}

#endif
