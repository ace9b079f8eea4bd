/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/dense.h"
#include "maths/ode_steps.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* J_ij = (f_i(y + d e_j) - f_i(y))/d, d = sqrt(eps) max(|y_j|, atol_j/rtol, sqrt(eps)): the size
   below which y_j does not matter bounds the increment from below. Error about sqrt(eps) |J| for
   components of their expected size; controlled evaluations. Source: Hairer and Wanner II, IV.8.
   Test: test_ode_stiff.c */
bool fw_maths_ode_jacobian(fw_maths_stepper *s, double t, const double *y, const double *f,
                           double *j, double *work) {
    int n = s->ode.n, columns = s->ode.controlled;
    double *at = work, *g = work + s->padded;
    s->jacobians++;
    if (s->ode.jacobian) {
        s->ode.jacobian(s->ode.context, t, y, j);
        return fw_maths_ode_finite(j, n * columns);
    }
    const double least = sqrt(DBL_EPSILON);
    memcpy(at, y, (size_t)n * sizeof *y);
    for (int c = 0; c < columns; c++) {
        double size = fmax(fabs(y[c]), fmax(s->tolerance[c] / s->rtol, least));
        at[c] = y[c] + (f[c] < 0 ? -least : least) * size; /* the way the state is going */
        double d = at[c] - y[c];
        fw_maths_ode_evaluate_lean(s, t, at, g);
        at[c] = y[c];
        for (int i = 0; i < columns; i++)
            j[(size_t)i * (size_t)columns + (size_t)c] = (g[i] - f[i]) / d;
    }
    return fw_maths_ode_finite(j, columns * columns);
}

fw_status fw_maths_ode_shifted_new(fw_arena *arena, const fw_maths_ode *ode, bool complex,
                                   fw_maths_ode_shifted *m) {
    m->half = ode->positions > 0 && 2 * ode->positions == ode->controlled;
    m->size = m->half ? ode->positions : ode->controlled;
    size_t size = (size_t)m->size;
    FW_NEED(m->re = fw_arena_array(arena, double, size *size));
    if (complex) FW_NEED(m->im = fw_arena_array(arena, double, size *size));
    FW_NEED(m->right[0] = fw_arena_array(arena, double, size));
    FW_NEED(m->right[1] = fw_arena_array(arena, double, size));
    FW_NEED(m->pivot = fw_arena_array(arena, int, size));
    return FW_OK;
}

/* sigma I - J, or with J = [0 I; K_u K_v] its Schur complement sigma^2 I - sigma K_v - K_u */
bool fw_maths_ode_shifted_factor(fw_maths_stepper *s, const double *j, double a, double b,
                                 fw_maths_ode_shifted *m) {
    size_t size = (size_t)m->size, columns = (size_t)s->ode.controlled;
    m->a = a;
    m->b = b;
    for (size_t r = 0; r < size; r++)
        for (size_t c = 0; c < size; c++) {
            size_t to = r * size + c;
            const double *row = j + (m->half ? size + r : r) * columns;
            bool diagonal = r == c;
            if (m->half) {
                m->re[to] = (diagonal ? a * a - b * b : 0) - a * row[size + c] - row[c];
                if (m->im) m->im[to] = (diagonal ? 2 * a * b : 0) - b * row[size + c];
            } else {
                m->re[to] = (diagonal ? a : 0) - row[c];
                if (m->im) m->im[to] = diagonal ? b : 0;
            }
        }
    s->factorisations++;
    return m->im ? fw_maths_lu_factor_complex(m->size, m->re, m->im, m->pivot)
                 : fw_maths_lu_factor(m->size, m->re, m->pivot);
}

static void factored(const fw_maths_ode_shifted *m, double *x, double *y) {
    if (m->im)
        fw_maths_lu_solve_complex(m->size, m->re, m->im, m->pivot, x, y);
    else
        fw_maths_lu_solve(m->size, m->re, m->pivot, x);
}

static double product(size_t n, const double *row, const double *x) {
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += row[i] * x[i];
    return sum;
}

/* du from (sigma^2 - sigma K_v - K_u) du = r_v + (sigma - K_v) r_u, then dv = sigma du - r_u */
static void solve_half(const fw_maths_stepper *s, const double *j, const fw_maths_ode_shifted *m,
                       double *x, double *y) {
    size_t n = (size_t)m->size, columns = (size_t)s->ode.controlled;
    double a = m->a, b = m->b, *p = m->right[0], *q = m->right[1];
    for (size_t r = 0; r < n; r++) {
        const double *kv = j + (n + r) * columns + n;
        p[r] = x[n + r] + a * x[r] - product(n, kv, x);
        if (!y) continue;
        p[r] -= b * y[r];
        q[r] = y[n + r] + a * y[r] + b * x[r] - product(n, kv, y);
    }
    factored(m, p, q);
    for (size_t r = 0; r < n; r++) {
        x[n + r] = a * p[r] - (y ? b * q[r] : 0) - x[r];
        x[r] = p[r];
        if (!y) continue;
        y[n + r] = a * q[r] + b * p[r] - y[r];
        y[r] = q[r];
    }
}

void fw_maths_ode_shifted_solve(const fw_maths_stepper *s, const double *j,
                                const fw_maths_ode_shifted *m, double *x, double *y) {
    if (m->half)
        solve_half(s, j, m, x, y);
    else
        factored(m, x, y);
}

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
