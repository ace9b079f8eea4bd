/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Limit states whose failure probability is known: in closed form, or by quadrature in one dimension here. */
#ifndef FW_TEST_CHANCE_LIMITS_H
#define FW_TEST_CHANCE_LIMITS_H
#include "chance/estimate.h"
#include "chance/joint.h"
#include "maths/functions.h"
#include "chance_test.h"

typedef struct limit_state {
    const char *name;
    size_t dimensions;
    double (*g)(const struct limit_state *l, const double *u);
    double b, truth;
    double (*reference)(double b); /* where it is not in `truth` */
    const fw_chance_joint *joint;
    size_t next; /* the number that the next call has to begin with */
} limit_state;

/* b less the sum of all over its standard deviation */
static inline double limit_linear(const limit_state *l, const double *u) {
    double sum = 0;
    for (size_t i = 0; i < l->dimensions; i++)
        sum += u[i];
    return l->b - sum / sqrt((double)l->dimensions);
}
static inline double reference_linear(double b) {
    return fw_maths_normal_cdf(-b);
}

/* trapezoidal rule: exponentially exact for what falls like a normal density */
static inline double quadrature(double (*f)(double x, double b), double b, double from, double to) {
    enum { N = 20000 };
    double sum = 0;
    for (int i = 0; i <= N; i++)
        sum += (i % N ? 1 : 0.5) * f(from + (to - from) * i / N, b);
    return sum * (to - from) / N;
}

/* the four-branch series system: in coordinates a, c along the diagonals it fails where |c| > 3 + a^2/5 or |a| > b/2 */
static inline double limit_branches(const limit_state *l, const double *u) {
    double a = (u[0] - u[1]) / sqrt(2.0), c = (u[0] + u[1]) / sqrt(2.0);
    return fmin(3 + 0.2 * a * a - fabs(c), sqrt(2.0) * (l->b / 2 - fabs(a)));
}
static inline double branches_between(double a, double b) {
    (void)b;
    return fw_maths_normal_density(a) * 2 * fw_maths_normal_cdf(-3 - 0.2 * a * a);
}
static inline double reference_branches(double b) {
    double inner = 0; /* Simpson: the ends do not fall to 0 */
    enum { N = 20000 };
    for (int i = 0; i <= N; i++)
        inner += (i % N == 0 ? 1 : i % 2 ? 4 : 2) * branches_between(-b / 2 + b * i / N, b);
    return 2 * fw_maths_normal_cdf(-b / 2) + inner * b / N / 3;
}

/* a parabola that bends towards the origin: two design points, symmetric but for a shift */
static inline double limit_parabola(const limit_state *l, const double *u) {
    return l->b - u[1] - 0.5 * (u[0] - 0.1) * (u[0] - 0.1);
}
static inline double parabola_at(double x, double b) {
    return fw_maths_normal_density(x) * fw_maths_normal_cdf(-(b - 0.5 * (x - 0.1) * (x - 0.1)));
}
static inline double reference_parabola(double b) {
    return quadrature(parabola_at, b, -14, 14);
}

/* two planes on both sides: b and b + 0.3 away */
static inline double limit_sides(const limit_state *l, const double *u) {
    return fmin(l->b - u[0], l->b + 0.3 + u[0]);
}
static inline double reference_sides(double b) {
    return fw_maths_normal_cdf(-b) + fw_maths_normal_cdf(-b - 0.3);
}

/* the outside of a sphere: every direction is a design point. In 20 dimensions P(chi-square > 2x) = exp(-x) sum x^k/k! */
static inline double limit_sphere(const limit_state *l, const double *u) {
    double sum = 0;
    for (size_t i = 0; i < l->dimensions; i++)
        sum += u[i] * u[i];
    return l->b - sum;
}
static inline double reference_sphere(double b) {
    double term = exp(-b / 2), sum = 0;
    for (int k = 0; k < 10; k++) {
        sum += term;
        term *= b / 2 / (k + 1);
    }
    return sum;
}

/* yes or no: nothing shows a way */
static inline double limit_flat(const limit_state *l, const double *u) {
    return limit_linear(l, u) <= 0 ? -1 : 1;
}

/* 1e-6 to 10 %, 2 to 100 dimensions */
static limit_state limit_states[] = {
    {.name = "linear, 2, 1e-6",
     .dimensions = 2,
     .g = limit_linear,
     .b = 4.753424,
     .reference = reference_linear},
    {.name = "linear, 2, 10 %",
     .dimensions = 2,
     .g = limit_linear,
     .b = 1.281552,
     .reference = reference_linear},
    {.name = "linear, 10, 1e-4",
     .dimensions = 10,
     .g = limit_linear,
     .b = 3.719016,
     .reference = reference_linear},
    {.name = "linear, 100, 1e-6",
     .dimensions = 100,
     .g = limit_linear,
     .b = 4.753424,
     .reference = reference_linear},
    {.name = "linear, 100, 1 %",
     .dimensions = 100,
     .g = limit_linear,
     .b = 2.326348,
     .reference = reference_linear},
    {.name = "branches, 2e-3",
     .dimensions = 2,
     .g = limit_branches,
     .b = 7,
     .reference = reference_branches},
    {.name = "branches, 4e-3",
     .dimensions = 2,
     .g = limit_branches,
     .b = 6,
     .reference = reference_branches},
    {.name = "parabola, 3e-3",
     .dimensions = 2,
     .g = limit_parabola,
     .b = 5,
     .reference = reference_parabola},
    {.name = "two sides, 4e-5",
     .dimensions = 2,
     .g = limit_sides,
     .b = 4,
     .reference = reference_sides},
    {.name = "sphere, 20, 1e-4",
     .dimensions = 20,
     .g = limit_sphere,
     .b = 52.386,
     .reference = reference_sphere},
    {.name = "flat, 5, 3e-5",
     .dimensions = 5,
     .g = limit_flat,
     .b = 4,
     .reference = reference_linear},
};
enum { LIMIT_STATES = sizeof limit_states / sizeof *limit_states };

static inline double truth_of(const limit_state *l) {
    return l->reference ? l->reference(l->b) : l->truth;
}

static inline fw_status limit_call(void *context, size_t first, size_t count, const double *u,
                                   double *value) {
    limit_state *l = context;
    assert_int_equal(first, l->next);
    l->next += count;
    for (size_t i = 0; i < count; i++)
        value[i] = l->g(l, u + i * l->dimensions);
    return FW_OK;
}

static inline fw_chance_estimate limit_estimate(limit_state *l, fw_chance_options options) {
    fw_chance_limit limit = {.dimensions = l->dimensions, .g = limit_call, .context = l};
    fw_chance_estimate out;
    const char *why;
    l->next = 0;
    if (!options.budget) options.budget = FW_CHANCE_BUDGET_USUAL;
    assert_int_equal(fw_chance_estimate_run(arena, &limit, &options, &out, &why), FW_OK);
    assert_true(out.evaluations <= options.budget);
    assert_int_equal(out.evaluations, l->next);
    return out;
}

/* In how many of `seeds` estimates the 95 % interval holds the truth. The share may fall short of 95 % by what a binomial
   number falls short of its mean once in 700 times; `width` is the mean half width over the truth. */
static inline void limit_coverage(limit_state *l, fw_chance_options options, int seeds,
                                  double *width) {
    double truth = truth_of(l);
    int held = 0;
    *width = 0;
    for (int seed = 1; seed <= seeds; seed++) {
        fw_mark mark = fw_arena_mark(arena);
        options.seed = (uint64_t)seed;
        fw_chance_estimate e = limit_estimate(l, options);
        held += e.low <= truth && truth <= e.high;
        *width += (e.high - e.low) / 2 / truth / seeds;
        fw_arena_rewind(arena, mark);
    }
    if (getenv("FW_TEST_SHOW"))
        printf("%-20s %-12s held %d of %d, half width %.4f\n", l->name,
               fw_chance_method_id(options.method), held, seeds, *width);
    if (held < 0.95 * seeds - 3 * sqrt(0.0475 * seeds))
        fail_msg("%s, %s: held %d of %d", l->name, fw_chance_method_id(options.method), held,
                 seeds);
}
#endif
