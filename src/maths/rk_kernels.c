/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/rk_kernels.h"
#include <stdbool.h>

/* A variant is one instance of KERNELS: vectors V of W doubles, I of W integers. Components go in
   blocks of 16 and a last one of 8, whose sums stay in registers while the stages pass; written
   with the compiler's vector types because -O2 would not vectorise these loops. */
#define UNROLL _Pragma("GCC unroll 8")

#define COMBINE_BLOCK(V, W, B)                                                                     \
    {                                                                                              \
        V sum[B / W];                                                                              \
        const V *first = (const V *)(const void *)(k[0] + c);                                      \
        UNROLL for (int l = 0; l < B / W; l++) sum[l] = a[0] * first[l];                           \
        for (int j = 1; j < count; j++) {                                                          \
            const V *x = (const V *)(const void *)(k[j] + c);                                      \
            UNROLL for (int l = 0; l < B / W; l++) sum[l] += a[j] * x[l];                          \
        }                                                                                          \
        const V *start = (const V *)(const void *)(y + c);                                         \
        V *end = (V *)(void *)(out + c);                                                           \
        UNROLL for (int l = 0; l < B / W; l++) end[l] = start[l] + h * sum[l];                     \
    }

/* |x| clears the sign bit; the larger of two by a mask */
#define ABSOLUTE(V, I, x)  ((V)((I)(x)&0x7fffffffffffffff))
#define LARGER(V, I, x, y) ((V)((((x) > (y)) & (I)(x)) | (~((x) > (y)) & (I)(y))))

#define KERNELS(NAME, V, I, W, TARGET)                                                             \
    typedef double V __attribute__((vector_size(8 * W), may_alias));                               \
    typedef long long I __attribute__((vector_size(8 * W), may_alias));                            \
    TARGET static void combine_##NAME(int n, double h, int count, const double *a,                 \
                                      const double *const *k, const double *y, double *out) {      \
        int c = 0;                                                                                 \
        for (; c + 16 <= n; c += 16)                                                               \
            COMBINE_BLOCK(V, W, 16)                                                                \
        if (c < n) COMBINE_BLOCK(V, W, 8)                                                          \
    }                                                                                              \
    TARGET static void errors_##NAME(int n, int count, const double *e, const double *const *k,    \
                                     double rtol, const double *tolerance, const double *y,        \
                                     const double *z, double sum[2]) {                             \
        V all[2 * (8 / W)];                                                                        \
        UNROLL for (int l = 0; l < 2 * (8 / W); l++) all[l] = (V){0};                              \
        for (int c = 0; c < n; c += 8) {                                                           \
            V one[8 / W], two[8 / W];                                                              \
            const V *first = (const V *)(const void *)(k[0] + c);                                  \
            UNROLL for (int l = 0; l < 8 / W; l++) {                                               \
                one[l] = e[0] * first[l];                                                          \
                two[l] = e[1] * first[l];                                                          \
            }                                                                                      \
            for (int j = 1; j < count; j++) {                                                      \
                const V *x = (const V *)(const void *)(k[j] + c);                                  \
                UNROLL for (int l = 0; l < 8 / W; l++) {                                           \
                    one[l] += e[2 * j] * x[l];                                                     \
                    two[l] += e[2 * j + 1] * x[l];                                                 \
                }                                                                                  \
            }                                                                                      \
            const V *p = (const V *)(const void *)(y + c), *q = (const V *)(const void *)(z + c);  \
            const V *least = (const V *)(const void *)(tolerance + c);                             \
            UNROLL for (int l = 0; l < 8 / W; l++) {                                               \
                V before = ABSOLUTE(V, I, p[l]), after = ABSOLUTE(V, I, q[l]);                     \
                V scale = least[l] + rtol * LARGER(V, I, before, after);                           \
                V x = one[l] / scale, w = two[l] / scale;                                          \
                all[l] += x * x;                                                                   \
                all[8 / W + l] += w * w;                                                           \
            }                                                                                      \
        }                                                                                          \
        double lane[16] __attribute__((aligned(64)));                                              \
        UNROLL for (int l = 0; l < 2 * (8 / W); l++)((V *)(void *)lane)[l] = all[l];               \
        for (int i = 0; i < 2; i++) {                                                              \
            const double *x = lane + 8 * i;                                                        \
            sum[i] = (x[0] + x[4]) + (x[1] + x[5]) + ((x[2] + x[6]) + (x[3] + x[7]));              \
        }                                                                                          \
    }

static int always(void) {
    return true;
}

KERNELS(narrow, narrow2, narrow2i, 2, )
#if defined(__x86_64__)
KERNELS(avx2, wide4, wide4i, 4, __attribute__((target("avx2"))))
KERNELS(avx512, widest8, widest8i, 8, __attribute__((target("avx512f"))))
static int has_avx2(void) {
    return __builtin_cpu_supports("avx2") != 0;
}
static int has_avx512(void) {
    return __builtin_cpu_supports("avx512f") != 0;
}
#endif

static const fw_maths_rk_kernels table[] = {
    {"narrow", always, combine_narrow, errors_narrow},
#if defined(__x86_64__)
    {"avx2", has_avx2, combine_avx2, errors_avx2},
    {"avx512", has_avx512, combine_avx512, errors_avx512},
#endif
};

const fw_maths_rk_kernels *fw_maths_rk_kernels_table(size_t *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

const fw_maths_rk_kernels *fw_maths_rk_kernels_best(void) {
    const fw_maths_rk_kernels *best = table;
    for (size_t i = 1; i < sizeof table / sizeof table[0]; i++)
        if (table[i].usable()) best = &table[i];
    return best;
}
