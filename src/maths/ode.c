/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What integrators share: memory, norms, first steps, acceptance, dense output; Jacobians and the systems of implicit
   steps; the vector work of explicit ones. */
#include "maths/ode.h"
#include "maths/matrix.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

int fw_maths_ode_padded(int n) {
    return (n + 7) / 8 * 8;
}

double *fw_maths_ode_vector(fw_arena *arena, int n) {
    return fw_arena_array(arena, double, (size_t)fw_maths_ode_padded(n));
}

double fw_maths_ode_norm(const fw_maths_stepper *s, const double *e, const double *y,
                         const double *z) {
    double sum = 0;
    for (int c = 0; c < s->ode.controlled; c++) {
        double x = e[c] / (s->tolerance[c] + s->rtol * fmax(fabs(y[c]), fabs(z[c])));
        sum += x * x;
    }
    return s->ode.controlled ? sqrt(sum / s->ode.controlled) : 0;
}

void fw_maths_ode_evaluate(fw_maths_stepper *s, double t, const double *y, double *f) {
    s->ode.rhs(s->ode.context, t, y, f);
    s->rhs++;
}

void fw_maths_ode_evaluate_lean(fw_maths_stepper *s, double t, const double *y, double *f) {
    (s->ode.lean ? s->ode.lean : s->ode.rhs)(s->ode.context, t, y, f);
    s->rhs++;
}

bool fw_maths_ode_finite(const double *y, int n) {
    double sum[4] = {0};
    int c = 0;
    for (; c + 4 <= n; c += 4)
        for (int lane = 0; lane < 4; lane++)
            sum[lane] += 0 * y[c + lane];
    for (; c < n; c++)
        sum[0] += 0 * y[c];
    return sum[0] + sum[1] + (sum[2] + sum[3]) == 0;
}

/* h such that an explicit Euler step keeps within 0.01 of |y|, and 0.01 of the error that y'' makes
   in a step of this order, whichever is less; never so short that t would stay. Inputs y, f at t;
   work 2 padded. Cost one evaluation. Source: Hairer, Norsett and Wanner I, II.4. Test:
   test_ode_step.c */
double fw_maths_ode_first_step(fw_maths_stepper *s, int order, double *work) {
    double span = s->t_end - s->t, *y = work, *f = work + s->padded;
    double size = fw_maths_ode_norm(s, s->y, s->y, s->y),
           slope = fw_maths_ode_norm(s, s->f, s->y, s->y);
    double h = size < 1e-5 || slope < 1e-5 ? 1e-6 * span : 0.01 * size / slope;
    h = fmin(h, fmin(span, s->h_max));
    for (int c = 0; c < s->ode.n; c++)
        y[c] = s->y[c] + h * s->f[c];
    fw_maths_ode_evaluate(s, s->t + h, y, f);
    for (int c = 0; c < s->ode.n; c++)
        f[c] -= s->f[c];
    double worst = fmax(slope, fw_maths_ode_norm(s, f, s->y, s->y) / h);
    double other = worst <= 1e-15 ? fmax(1e-6 * span, h * 1e-3) : pow(0.01 / worst, 1.0 / order);
    h = fmin(100 * h, other);
    h = isfinite(h) && h > 0 ? fmin(h, fmin(span, s->h_max)) : 1e-6 * span;
    return fmin(span, fmax(h, 64 * DBL_EPSILON * fabs(s->t)));
}

double fw_maths_ode_target(const fw_maths_stepper *s, double *h) {
    bool last = s->t + 1.01 * *h >= s->t_end;
    double end = last ? s->t_end : s->t + *h;
    *h = end - s->t;
    return end;
}

bool fw_maths_ode_finish(fw_maths_stepper *s, double t_new, double *y_new, double *f_new) {
    bool good = true;
    if (s->ode.project) {
        good = s->ode.project(s->ode.context, t_new, y_new, f_new);
        s->rhs++;
    } else {
        fw_maths_ode_evaluate(s, t_new, y_new, f_new);
    }
    return good && fw_maths_ode_finite(f_new, s->ode.n) && fw_maths_ode_finite(y_new, s->ode.n);
}

void fw_maths_ode_accept(fw_maths_stepper *s, double t_new, double **y_new, double **f_new) {
    double *free_y = s->y_old, *free_f = s->f_old;
    s->y_old = s->y, s->y = *y_new, *y_new = free_y;
    s->f_old = s->f, s->f = *f_new, *f_new = free_f;
    s->t_old = s->t;
    s->t = t_new;
    s->h = t_new - s->t_old;
    s->dense_ready = false;
    s->steps++;
}

static bool too_small(const fw_maths_stepper *s, double h) {
    return !(h > 16 * DBL_EPSILON * fabs(s->t)) || h < 1e10 * DBL_MIN;
}

bool fw_maths_ode_retry(fw_maths_stepper *s, double h, int *tries) {
    s->rejected++;
    return ++*tries < 100 && !too_small(s, h);
}

/* ---- interpolation ---- */

/* p on [0, 1] from value, slope and (with order 5) second derivative with respect to theta at both
   ends; gives p, p' and p'' */
static void hermite3(const double p[2], const double d[2], double x, double out[3]) {
    double bend = d[0] - (p[1] - p[0]), twist = (p[1] - p[0]) - d[1] - bend;
    out[0] = p[0] + x * (p[1] - p[0] + (1 - x) * (bend + x * twist));
    out[1] = p[1] - p[0] + (1 - 2 * x) * bend + (2 - 3 * x) * x * twist;
    out[2] = -2 * bend + (2 - 6 * x) * twist;
}

static void hermite5(const double p[2], const double d[2], const double b[2], double x,
                     double out[3]) {
    double e = p[1] - p[0] - d[0] - b[0] / 2, e1 = d[1] - d[0] - b[0], e2 = b[1] - b[0];
    double c3 = 10 * e - 4 * e1 + e2 / 2, c4 = -15 * e + 7 * e1 - e2, c5 = 6 * e - 3 * e1 + e2 / 2;
    out[0] = p[0] + x * (d[0] + x * (b[0] / 2 + x * (c3 + x * (c4 + x * c5))));
    out[1] = d[0] + x * (b[0] + x * (3 * c3 + x * (4 * c4 + x * 5 * c5)));
    out[2] = b[0] + x * (6 * c3 + x * (12 * c4 + x * 20 * c5));
}

void fw_maths_ode_span_value(const fw_maths_ode *ode, const fw_maths_ode_span *span, int c,
                             double theta, double *value, double *slope) {
    double h = span->h, out[3];
    int n = ode->positions;
    if (c >= 2 * n || (c >= n && span->v_alone)) {
        const double p[2] = {span->y_old[c], span->y[c]};
        const double d[2] = {h * span->f_old[c], h * span->f[c]};
        hermite3(p, d, theta, out);
        *value = out[0], *slope = out[1];
        return;
    }
    int u = c < n ? c : c - n, v = u + n;
    const double p[2] = {span->y_old[u], span->y[u]};
    const double d[2] = {h * span->y_old[v], h * span->y[v]};
    const double b[2] = {h * h * span->f_old[v], h * h * span->f[v]};
    hermite5(p, d, b, theta, out);
    *value = c < n ? out[0] : out[1] / h;
    *slope = c < n ? out[1] : out[2] / h;
}

static fw_maths_ode_span whole_step(const fw_maths_stepper *s) {
    return (fw_maths_ode_span){s->h, s->y_old, s->f_old, s->y, s->f, false};
}

void fw_maths_ode_hermite(const fw_maths_stepper *s, double theta, double *y) {
    const fw_maths_ode_span span = whole_step(s);
    double slope;
    for (int c = 0; c < s->ode.n; c++)
        fw_maths_ode_span_value(&s->ode, &span, c, theta, &y[c], &slope);
}

void fw_maths_ode_hermite_component(const fw_maths_stepper *s, int a, double wa, int b, double wb,
                                    double theta, double *value, double *slope) {
    const fw_maths_ode_span span = whole_step(s);
    double p = 0, d = 0;
    fw_maths_ode_span_value(&s->ode, &span, a, theta, value, slope);
    if (b >= 0) fw_maths_ode_span_value(&s->ode, &span, b, theta, &p, &d);
    *value = wa * *value + wb * p;
    *slope = wa * *slope + wb * d;
}

/* ---- implicit steps ---- */

/* J_ij = (f_i(y + d e_j) - f_i(y))/d, d = sqrt(eps) max(|y_j|, atol_j/rtol, sqrt(eps)): the size
   below which y_j does not matter bounds the increment from below. Error about sqrt(eps) |J| for
   components of their expected size; controlled evaluations. Source: Hairer and Wanner II, IV.8.
   Test: test_ode_stiff.c */
static double beside(const fw_maths_stepper *s, const double *y, const double *f, int c) {
    const double least = sqrt(DBL_EPSILON);
    double size = fmax(fabs(y[c]), fmax(s->tolerance[c] / s->rtol, least));
    return y[c] + (f[c] < 0 ? -least : least) * size; /* the way the state is going */
}

static void by_columns(fw_maths_stepper *s, double t, const double *y, const double *f, double *j,
                       double *work) {
    int columns = s->ode.controlled;
    double *at = work, *g = work + s->padded;
    memcpy(at, y, (size_t)s->ode.n * sizeof *y);
    for (int c = 0; c < columns; c++) {
        at[c] = beside(s, y, f, c);
        const double d = at[c] - y[c];
        fw_maths_ode_evaluate_lean(s, t, at, g);
        at[c] = y[c];
        for (int i = 0; i < columns; i++)
            j[(size_t)i * (size_t)columns + (size_t)c] = (g[i] - f[i]) / d;
    }
}

/* ---- columns apart ----

   Where bodies are coupled to their neighbours alone, a column of J has entries in few rows, and columns that have no row in
   common are found by one evaluation, each by the same difference as alone (Curtis, Powell and Reid, J. Inst. Maths Applics
   13 (1974) 117): 300 bodies on a lattice ask for some 40 evaluations, not 600. Who has which rows is
   read from a J that was found column by column, first column first. It may change, as where a stop is met; so each time a
   group may move none of the rows that are not its own, and one more evaluation, at y + r, r unlike shares of the
   increments, must move every row by J r within 1e-4 of its terms: else J is found column by column. A J that is off
   makes Newton's iteration slower, its end is the same. Cost: groups + 1 evaluations. Test: test_ode_stiff.c,
   test_neighbours */

fw_status fw_maths_ode_apart_new(fw_arena *arena, const fw_maths_ode *ode,
                                 fw_maths_ode_apart **apart) {
    const size_t n = (size_t)ode->controlled;
    fw_maths_ode_apart *a = fw_arena_one(arena, fw_maths_ode_apart);
    FW_NEED(a);
    FW_NEED(a->group = fw_arena_array(arena, int, n));
    FW_NEED(a->owner = fw_arena_array(arena, int, n / 3 * n));
    FW_NEED(a->r = fw_arena_array(arena, double, 2 * n));
    *apart = a;
    return FW_OK;
}

static bool fits(const int *owner, const double *j, size_t n, size_t c) {
    for (size_t i = 0; i < n; i++)
        if (j[i * n + c] != 0 && owner[i] >= 0) return false;
    return true;
}

/* each column into the first group that it fits into */
static void part(fw_maths_ode_apart *a, size_t n, const double *j) {
    a->groups = 0;
    for (size_t c = 0; c < n; c++) {
        size_t g = 0;
        while (g < (size_t)a->groups && !fits(a->owner + g * n, j, n, c))
            g++;
        if (g == n / 3) {
            a->groups = FW_ODE_TOGETHER;
            return;
        }
        int *owner = a->owner + g * n;
        for (size_t i = 0; g == (size_t)a->groups && i < n; i++)
            owner[i] = -1;
        if (g == (size_t)a->groups) a->groups++;
        a->group[c] = (int)g;
        for (size_t i = 0; i < n; i++)
            if (j[i * n + c] != 0) owner[i] = (int)c;
    }
}

/* of its increment, in the evaluation that asks whether J is right: no two columns have the same, since what joins them would not
   be seen where both go as far */
static double share_of(size_t c) {
    const double golden = 0.618033988749895, at = golden * (double)c;
    return 0.5 + 0.5 * (at - floor(at));
}

/* false: they are not apart any more */
static bool by_groups(fw_maths_stepper *s, double t, const double *y, const double *f, double *j,
                      double *work) {
    const fw_maths_ode_apart *a = s->apart;
    const size_t n = (size_t)s->ode.controlled;
    double *at = work, *g = work + s->padded, *moved = a->r, *terms = a->r + n;
    memset(j, 0, n * n * sizeof *j);
    memset(a->r, 0, 2 * n * sizeof *a->r);
    for (int k = 0; k <= a->groups; k++) {
        const bool all = k == a->groups;
        memcpy(at, y, (size_t)s->ode.n * sizeof *y);
        for (size_t c = 0; c < n; c++)
            if (all || a->group[c] == k) at[c] = beside(s, y, f, (int)c);
        for (size_t c = 0; all && c < n; c++)
            at[c] = y[c] + share_of(c) * (at[c] - y[c]);
        fw_maths_ode_evaluate_lean(s, t, at, g);
        for (size_t i = 0; i < n; i++) {
            const int c = all ? -1 : a->owner[(size_t)k * n + i];
            if (c < 0 && !all && g[i] != f[i]) return false;
            if (all && !(fabs(g[i] - f[i] - moved[i]) <= 1e-4 * terms[i])) return false;
            if (c < 0) continue;
            const double d = beside(s, y, f, c) - y[c], entry = (g[i] - f[i]) / d;
            j[i * n + (size_t)c] = entry;
            moved[i] += share_of((size_t)c) * d * entry;
            terms[i] += fabs(d * entry);
        }
    }
    return true;
}

bool fw_maths_ode_jacobian(fw_maths_stepper *s, double t, const double *y, const double *f,
                           double *j, double *work) {
    int n = s->ode.n, columns = s->ode.controlled;
    s->jacobians++;
    if (s->ode.jacobian) {
        s->ode.jacobian(s->ode.context, t, y, j);
        return fw_maths_ode_finite(j, n * columns);
    }
    fw_maths_ode_apart *a = s->apart;
    if (a && a->groups > 0 && by_groups(s, t, y, f, j, work))
        return fw_maths_ode_finite(j, columns * columns);
    by_columns(s, t, y, f, j, work);
    if (!fw_maths_ode_finite(j, columns * columns)) return false;
    if (a && a->groups != FW_ODE_TOGETHER) part(a, (size_t)columns, j);
    return true;
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
    FW_NEED(m->within = fw_arena_array(arena, int, 4 * size));
    return FW_OK;
}

static void row_within(size_t n, const double *re, const double *im, int within[2]) {
    int first = 0, end = (int)n;
    while (first < end && re[first] == 0 && (!im || im[first] == 0))
        first++;
    while (end > first && re[end - 1] == 0 && (!im || im[end - 1] == 0))
        end--;
    within[0] = first, within[1] = end;
}

/* where zeros begin and end, which what is solved leaves out: they change no bit of it */
static void see_zeros(const double *j, size_t columns, const fw_maths_ode_shifted *m) {
    const size_t n = (size_t)m->size;
    for (size_t r = 0; r < n; r++) {
        row_within(n, m->re + r * n, m->im ? m->im + r * n : NULL, m->within + 4 * r);
        if (m->half) row_within(n, j + (n + r) * columns + n, NULL, m->within + 4 * r + 2);
    }
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
    const bool regular = m->im ? fw_maths_lu_factor_complex(m->size, m->re, m->im, m->pivot)
                               : fw_maths_lu_factor(m->size, m->re, m->pivot);
    if (regular) see_zeros(j, columns, m);
    return regular;
}

static void factored(const fw_maths_ode_shifted *m, double *x, double *y) {
    if (m->im)
        fw_maths_lu_solve_complex(m->size, m->re, m->im, m->pivot, m->within, x, y);
    else
        fw_maths_lu_solve(m->size, m->re, m->pivot, m->within, x);
}

static double product(const int within[2], const double *row, const double *x) {
    double sum = 0;
    for (int i = within[0]; i < within[1]; i++)
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
        const int *within = m->within + 4 * r + 2;
        p[r] = x[n + r] + a * x[r] - product(within, kv, x);
        if (!y) continue;
        p[r] -= b * y[r];
        q[r] = y[n + r] + a * y[r] + b * x[r] - product(within, kv, y);
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

/* ---- vector work of explicit Runge-Kutta steps ----

   A variant is one instance of KERNELS: vectors V of W doubles, I of W integers. Components go in
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
