/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/joint.h"
#include "maths/cdf.h"
#include <math.h>

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
