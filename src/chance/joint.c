/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs that scatter together: correlations stated between distributions, taken to normal space, and the map from
   independent normal numbers to values. */
#include "chance/joint.h"
#include "base/text.h"
#include "chance/random.h"
#include "maths/functions.h"
#include "maths/matrix.h"
#include <math.h>
#include <stdbool.h>

/* ---- one correlation of two distributions in normal space: Nataf's integral ---- */

enum { TERMS = 100, PER_UNIT = 256, REACH = 12, NODES = 2 * REACH * PER_UNIT + 1 };

/* rho(r) = sum over k of product[k] r^k, and what is missing of it at r = 1 and r = -1 */
typedef struct series {
    double product[TERMS + 1], missing_up, missing_down, wanted;
} series;

/* of a distribution: standardised values at the nodes, and coefficients of normalised Hermite polynomials */
typedef struct expansion {
    double value[NODES], coefficient[TERMS + 1];
} expansion;

static double node(int i) {
    return (double)(i - REACH * PER_UNIT) / PER_UNIT;
}

static void expand(const fw_chance_distribution *d, expansion *e) {
    double mean = fw_chance_distribution_mean(d), sd = fw_chance_distribution_sd(d);
    for (int i = 0; i < NODES; i++) {
        double z = node(i), before = 0, h = 1;
        e->value[i] = (fw_chance_distribution_value(d, z) - mean) / sd;
        double weighted = e->value[i] * fw_maths_normal_density(z) / PER_UNIT;
        for (int k = 0; k <= TERMS; k++) {
            e->coefficient[k] += weighted * h;
            double next = (z * h - sqrt((double)k) * before) / sqrt(k + 1.0);
            before = h, h = next;
        }
    }
}

static double correlation(const void *context, double r) {
    const series *s = context;
    double sum = 0;
    for (int k = TERMS; k >= 1; k--)
        sum = (sum + s->product[k]) * r;
    return sum + (r < 0 ? s->missing_down : s->missing_up) * pow(fabs(r), TERMS + 1) - s->wanted;
}

/* With x = sum a_k H_k(z), y = sum b_k H_k(z') and z, z' normal with correlation r, E[x y] = sum a_k b_k r^k (Mehler),
   x and y standardised; the r of a wanted E[x y] by Brent's method. a_k by the trapezoidal rule in z, |z| <= 12 with step
   1/256; what 100 terms miss is known at r = +-1 and goes as r^101. Inputs: two distributions with a spread, -1 < value
   < 1; output r. Error: 1e-6 in the correlation where a table has corners, 1e-10 else. Cost: some 10 ms. Source: A. Nataf,
   C. R. Acad. Sci. 225 (1962) 42; A. Der Kiureghian, P.-L. Liu, J. Eng. Mech. 112 (1986) 85 (normal space). Test:
   test_joint.c (closed forms of the lognormal and uniform distributions, and by quadrature in two dimensions) */
fw_status fw_chance_joint_normal(fw_arena *arena, const fw_chance_distribution *a,
                                 const fw_chance_distribution *b, double value, double *normal,
                                 double *low, double *high) {
    fw_mark mark = fw_arena_mark(arena);
    expansion *e = fw_arena_array(arena, expansion, 2);
    FW_NEED(e);
    expand(a, &e[0]);
    expand(b, &e[1]);
    series s = {.wanted = 0};
    double up = 0, down = 0;
    for (int i = 0; i < NODES; i++) {
        double weight = fw_maths_normal_density(node(i)) / PER_UNIT;
        up += weight * e[0].value[i] * e[1].value[i];
        down += weight * e[0].value[i] * e[1].value[NODES - 1 - i];
    }
    s.missing_up = up, s.missing_down = down;
    for (int k = 1; k <= TERMS; k++) {
        s.product[k] = e[0].coefficient[k] * e[1].coefficient[k];
        s.missing_up -= s.product[k];
        s.missing_down -= k % 2 ? -s.product[k] : s.product[k];
    }
    fw_arena_rewind(arena, mark);
    *low = down, *high = up;
    if (!(value > down && value < up)) return FW_INPUT;
    s.wanted = value;
    *normal = value == 0 ? 0 : fw_maths_brent_root(correlation, &s, -1, 1, 1e-14);
    return isnan(*normal) ? FW_INPUT : FW_OK;
}

/* ---- all of them together ---- */

static bool scatters(const fw_chance_variable *v) {
    return v->distribution.kind != FW_CHANCE_CONSTANT && v->distribution.kind != FW_CHANCE_INTERVAL;
}

static fw_status number(fw_arena *arena, fw_chance_joint *j) {
    FW_NEED(j->value_first = fw_arena_array(arena, size_t, j->variables));
    FW_NEED(j->u_first = fw_arena_array(arena, size_t, j->variables));
    FW_NEED(j->unknown = fw_arena_array(arena, size_t, j->variables));
    for (size_t v = 0; v < j->variables; v++) {
        size_t times = j->variable[v].level == FW_CHANCE_HINGE ? j->hinges : 1;
        j->value_first[v] = j->values;
        j->values += times;
        j->u_first[v] = scatters(&j->variable[v]) ? j->dimensions : SIZE_MAX;
        if (scatters(&j->variable[v])) j->dimensions += times;
        if (j->variable[v].distribution.kind == FW_CHANCE_INTERVAL) j->unknown[j->unknowns++] = v;
    }
    FW_NEED(j->u_variable = fw_arena_array(arena, size_t, j->dimensions));
    FW_NEED(j->u_hinge = fw_arena_array(arena, size_t, j->dimensions));
    for (size_t v = 0; v < j->variables; v++) {
        size_t times = j->variable[v].level == FW_CHANCE_HINGE ? j->hinges : 1;
        for (size_t h = 0; scatters(&j->variable[v]) && h < times; h++) {
            j->u_variable[j->u_first[v] + h] = v;
            j->u_hinge[j->u_first[v] + h] = h;
        }
    }
    return FW_OK;
}

static fw_status check_variable(fw_arena *arena, const fw_chance_variable *v, const char **why) {
    FW_TRY(fw_chance_distribution_check(arena, &v->distribution, why));
    const fw_chance_trend *t = &v->trend;
    bool some = t->radial != 0 || t->along_x != 0 || t->along_y != 0;
    if (!isfinite(t->radial) || !isfinite(t->along_x) || !isfinite(t->along_y))
        *why = "a number of the trend is not finite";
    else if (some && !(t->radius_m > 0 && isfinite(t->radius_m)))
        *why = "a trend needs the radius of the wafer, above 0";
    else
        return FW_OK;
    return FW_INPUT;
}

static const char *quoted(fw_arena *arena, const char *format, double x) {
    char text[32];
    return fw_arena_printf(arena, format, fw_number_text(text, sizeof text, x, 4));
}

/* what is wrong with a row of correlations in itself, NULL: nothing */
static const char *fault_of(const fw_chance_joint *j, const fw_chance_correlation *all,
                            size_t row) {
    const fw_chance_correlation *c = &all[row];
    if (c->a >= j->variables || c->b >= j->variables) return "there is no such variable";
    if (c->a == c->b) return "a variable is not correlated with itself";
    if (!scatters(&j->variable[c->a]) || !scatters(&j->variable[c->b]))
        return "what does not scatter has no correlation";
    if (j->variable[c->a].level != j->variable[c->b].level)
        return "the two are of different levels (lot, wafer, die, hinge), so that they cannot be "
               "correlated";
    if (!(c->value > -1 && c->value < 1)) return "a correlation is above -1 and below 1";
    for (size_t i = 0; i < row; i++)
        if ((all[i].a == c->a && all[i].b == c->b) || (all[i].a == c->b && all[i].b == c->a))
            return "the correlation of these two is stated twice";
    return NULL;
}

static fw_status put_correlation(fw_arena *arena, const fw_chance_joint *j,
                                 const fw_chance_correlation *c, const char **why) {
    double normal, low, high;
    fw_status status =
        fw_chance_joint_normal(arena, &j->variable[c->a].distribution,
                               &j->variable[c->b].distribution, c->value, &normal, &low, &high);
    if (status == FW_INPUT)
        FW_NEED(*why = c->value > 0
                           ? quoted(arena,
                                    "two such distributions cannot be correlated by more than %s",
                                    high)
                           : quoted(arena,
                                    "two such distributions cannot be correlated by less than %s",
                                    low));
    FW_TRY(status);
    j->factor[c->a * j->variables + c->b] = j->factor[c->b * j->variables + c->a] = normal;
    return FW_OK;
}

/* L of L L^T in the place of the symmetric matrix; the least eigenvalue says by how much it misses */
static fw_status factorise(fw_arena *arena, fw_chance_joint *j, const char **why) {
    size_t n = j->variables;
    if (!n) return FW_OK;
    FW_TRY(fw_maths_lapack_ready());
    double *a = fw_arena_array(arena, double, n *n), *vector = fw_arena_array(arena, double, n *n);
    double *value = fw_arena_array(arena, double, n);
    FW_NEED(a && vector && value ? a : NULL);
    for (size_t i = 0; i < n * n; i++)
        a[i] = vector[i] = j->factor[i];
    if (!fw_maths_cholesky((int)n, a)) {
        if (!fw_maths_jacobi((int)n, vector, value, a)) return FW_SOLVER;
        FW_NEED(*why = quoted(arena,
                              "the correlations contradict each other: no inputs have all of them "
                              "at once (least eigenvalue of "
                              "their matrix in normal space %s, which must be above 0)",
                              value[0]));
        return FW_INPUT;
    }
    for (size_t row = 0; row < n; row++)
        for (size_t column = 0; column < n; column++)
            j->factor[row * n + column] = column <= row ? a[column * n + row] : 0;
    return FW_OK;
}

/* Gaussian copula: each pair's correlation in normal space by Nataf's integral, then Cholesky's factor of all of them. Where
   that matrix is not positive definite the stated correlations are no correlations, or their marginals cannot have them. */
fw_status fw_chance_joint_new(fw_arena *arena, size_t hinges, size_t variables,
                              const fw_chance_variable *variable, size_t correlations,
                              const fw_chance_correlation *correlation, fw_chance_joint *out,
                              fw_chance_fault *fault) {
    *fault = (fw_chance_fault){NULL, SIZE_MAX, SIZE_MAX};
    *out = (fw_chance_joint){.variables = variables, .hinges = hinges, .variable = variable};
    for (size_t v = 0; v < variables; v++) {
        fault->variable = v;
        FW_TRY(check_variable(arena, &variable[v], &fault->why));
    }
    fault->variable = SIZE_MAX;
    FW_TRY(number(arena, out));
    FW_NEED(out->factor = fw_arena_array(arena, double, variables *variables));
    for (size_t v = 0; v < variables; v++)
        out->factor[v * variables + v] = 1;
    for (size_t c = 0; c < correlations; c++) {
        fault->correlation = c;
        if ((fault->why = fault_of(out, correlation, c))) return FW_INPUT;
        FW_TRY(put_correlation(arena, out, &correlation[c], &fault->why));
    }
    fault->correlation = SIZE_MAX;
    return factorise(arena, out, &fault->why);
}

/* The key is of seed and variable; the counter has the indices down to the variable's level, so that all dies of a wafer
   share the number of a variable of the level wafer. Test: test_joint.c */
void fw_chance_joint_draw(const fw_chance_joint *joint, uint64_t seed, const fw_chance_place *place,
                          double *u) {
    for (size_t d = 0; d < joint->dimensions; d++) {
        size_t v = joint->u_variable[d];
        fw_chance_level level = joint->variable[v].level;
        const uint32_t counter[4] = {place->lot, level >= FW_CHANCE_WAFER ? place->wafer : 0,
                                     level >= FW_CHANCE_DIE ? place->die : 0,
                                     (uint32_t)joint->u_hinge[d]};
        u[d] = fw_maths_normal_quantile(fw_chance_uniform_at(fw_chance_seed(seed, v), counter));
    }
}

static double trend_at(const fw_chance_trend *t, const fw_chance_place *place) {
    if (!place || !(t->radius_m > 0)) return 0;
    double x = place->x_m / t->radius_m, y = place->y_m / t->radius_m;
    return t->radial * (x * x + y * y - 0.5) + t->along_x * x + t->along_y * y;
}

/* row v of L, times the u of the same hinge */
static double correlated(const fw_chance_joint *j, size_t v, size_t hinge, const double *u) {
    double sum = 0;
    for (size_t w = 0; w <= v; w++)
        if (j->factor[v * j->variables + w] != 0)
            sum += j->factor[v * j->variables + w] * u[j->u_first[w] + hinge];
    return sum;
}

void fw_chance_joint_map(const fw_chance_joint *joint, const double *u, const double *unknown,
                         const fw_chance_place *place, double *x) {
    size_t intervals = 0;
    for (size_t v = 0; v < joint->variables; v++) {
        const fw_chance_variable *variable = &joint->variable[v];
        const fw_chance_distribution *d = &variable->distribution;
        double trend = trend_at(&variable->trend, place), stated = fw_chance_distribution_mean(d);
        if (d->kind == FW_CHANCE_INTERVAL && unknown) stated = unknown[intervals++];
        size_t times = variable->level == FW_CHANCE_HINGE ? joint->hinges : 1;
        for (size_t h = 0; h < times; h++) {
            double value = scatters(variable)
                               ? fw_chance_distribution_value(d, correlated(joint, v, h, u))
                               : stated;
            x[joint->value_first[v] + h] = value + trend;
        }
    }
}
