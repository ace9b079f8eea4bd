/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The coefficients of dop853, dopri5 and radau5, and the vector kernels. */
#include "maths/ode_tables.h"
#include "maths/ode.h"
#include "test.h"

/* row sums; quadrature conditions of b (order 8), of the fifth and the third order error; trees of
   height two */
static void test_dop853(void **state) {
    (void)state;
    for (int i = 1; i < DOP_ALL; i++) {
        double sum = 0;
        for (int j = dop_row[i]; j < dop_row[i + 1]; j++) {
            sum += dop_a[j].a;
            assert_true(dop_a[j].stage < i && (j > dop_row[i] || dop_a[j].stage == 0));
        }
        assert_near(sum, dop_c[i], 1e-14);
    }
    const dop_entry *b = dop_a + dop_row[12];
    for (int power = 0; power < 8; power++) {
        double sum = 0, five = 0, three = 0;
        for (int j = 0; j < 8; j++) {
            assert_int_equal(b[j].stage, dop_e5[j].stage); /* the step relies on it */
            sum += b[j].a * pow(dop_c[b[j].stage], power);
            five += dop_e5[j].a * pow(dop_c[dop_e5[j].stage], power);
        }
        for (int j = 0; j < 3; j++)
            three += dop_b3[j].a * pow(dop_c[dop_b3[j].stage], power);
        assert_near(sum, 1.0 / (power + 1), 1e-14);
        if (power < 5) assert_near(five, 0, 1e-14);
        if (power < 3) assert_near(three, 1.0 / (power + 1), 1e-14);
    }
    for (int power = 1; power < 7; power++) {
        double sum = 0;
        for (int j = 0; j < 8; j++)
            for (int m = dop_row[b[j].stage]; m < dop_row[b[j].stage + 1]; m++)
                sum += b[j].a * dop_a[m].a * pow(dop_c[dop_a[m].stage], power);
        assert_near(sum, 1.0 / ((power + 1) * (power + 2)), 1e-13);
    }
}

/* row sums; quadrature conditions of b (order 5), of b - e (order 4) and of the dense output; trees
   of height two */
static void test_dopri5(void **state) {
    (void)state;
    const double *b = dopri_a[6];
    for (int i = 1; i < DOPRI_STAGES; i++) {
        double sum = 0;
        for (int j = 0; j < i; j++)
            sum += dopri_a[i][j];
        assert_near(sum, dopri_c[i], 1e-15 * 8);
    }
    for (int power = 0; power < 5; power++) {
        double sum = 0, error = 0, dense = 0;
        for (int i = 0; i < DOPRI_STAGES; i++) {
            double c = power ? pow(dopri_c[i], power) : 1;
            sum += i < 6 ? b[i] * c : 0;
            error += dopri_e[i] * c;
            dense += dopri_d[i] * c;
        }
        assert_near(sum, 1.0 / (power + 1), 1e-15);
        if (power < 4) assert_near(error, 0, 1e-16);
        /* theta^2 (1 - theta)^2 d must vanish for t^0 to t^2, whose integrals the cubic has */
        if (power < 3) assert_near(dense, 0, 2e-15);
        /* the integral of t^3 is theta^4/4, the cubic Hermite part theta^3/2 - theta^2/4 */
        if (power == 3) assert_near(dense, 0.25, 2e-15);
    }
    for (int k = 1; k < 4; k++) {
        double sum = 0;
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < i; j++)
                sum += b[i] * dopri_a[i][j] * pow(dopri_c[j], k);
        assert_near(sum, 1.0 / ((k + 1) * (k + 2)), 1e-15);
    }
}

/* collocation: sum_j a_ij c_j^k = c_i^(k + 1)/(k + 1), b = last row of order 5; T TI = 1;
   A T diag = T with the eigenvalues of A^-1 */
static void test_radau5(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < (i == 2 ? 5 : 3); k++) {
            double sum = 0;
            for (int j = 0; j < 3; j++)
                sum += radau_a[i][j] * pow(radau_c[j], k);
            assert_near(sum, pow(radau_c[i], k + 1) / (k + 1), 1e-15);
        }
    const double d[3][3] = {
        {radau_gamma, 0, 0}, {0, radau_alpha, -radau_beta}, {0, radau_beta, radau_alpha}};
    double td[3][3] = {{0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double one = 0;
            for (int k = 0; k < 3; k++) {
                one += radau_t[i][k] * radau_ti[k][j];
                td[i][j] += radau_t[i][k] * d[k][j];
            }
            assert_near(one, i == j, 4e-15);
        }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += radau_a[i][k] * td[k][j];
            assert_near(sum, radau_t[i][j], 4e-15);
        }
    /* f + sum e_i z_i / h must be O(h^3): for y' = t^k the z_i are c_i^(k+1)/(k+1) h^(k+1) */
    for (int k = 0; k < 3; k++) {
        double sum = k == 0 ? 1 : 0;
        for (int i = 0; i < 3; i++)
            sum += radau_e[i] * pow(radau_c[i], k + 1) / (k + 1);
        assert_near(sum, 0, 4e-15);
    }
}

enum { LONG = 72, STAGES = 12 };
static _Alignas(64) double k[STAGES][LONG], y[LONG], z[LONG], tolerance[LONG], out[3][LONG];

static double noise(unsigned *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return ((double)*seed / 2147483648.0 - 1) * pow(10, (double)(*seed >> 8 & 7) - 4);
}

/* every variant that this processor has, all lengths, all counts: the same bits, and right */
static void test_kernels(void **state) {
    (void)state;
    unsigned seed = 1;
    size_t variants;
    const fw_maths_rk_kernels *kernel = fw_maths_rk_kernels_table(&variants);
    const double *list[STAGES];
    double a[STAGES], e[2 * STAGES], sum[3][2];
    assert_true(variants >= 1 && variants <= 3 && kernel[0].usable());
    assert_true(fw_maths_rk_kernels_best()->usable());
    for (int trial = 0; trial < 300; trial++) {
        int n = 8 * (1 + trial % (LONG / 8)), count = 1 + trial % STAGES;
        for (int c = 0; c < n; c++) {
            y[c] = noise(&seed), z[c] = noise(&seed);
            tolerance[c] = c % 7 == 6 ? (double)INFINITY : fabs(noise(&seed)) + 1e-6;
            for (int j = 0; j < count; j++)
                k[j][c] = noise(&seed);
        }
        for (int j = 0; j < count; j++) {
            list[j] = k[j];
            a[j] = noise(&seed);
            e[2 * j] = noise(&seed), e[2 * j + 1] = noise(&seed);
        }
        double five = 0, three = 0;
        for (int c = 0; c < n; c++) {
            double p = 0, q = 0, scale = tolerance[c] + 1e-3 * fmax(fabs(y[c]), fabs(z[c]));
            for (int j = 0; j < count; j++) {
                p += e[2 * j] * k[j][c];
                q += e[2 * j + 1] * k[j][c];
            }
            five += p / scale * (p / scale);
            three += q / scale * (q / scale);
        }
        for (size_t v = 0; v < variants; v++) {
            if (!kernel[v].usable()) continue;
            kernel[v].combine(n, 0.37, count, a, list, y, out[v]);
            kernel[v].errors(n, count, e, list, 1e-3, tolerance, y, z, sum[v]);
            assert_memory_equal(out[v], out[0], (size_t)n * sizeof(double));
            assert_memory_equal(sum[v], sum[0], sizeof sum[0]);
        }
        for (int c = 0; c < n; c++) {
            double want = 0;
            for (int j = 0; j < count; j++)
                want += a[j] * k[j][c];
            assert_true(out[0][c] == y[c] + 0.37 * want); /* the same operations in this order */
        }
        assert_relative(sum[0][0], five, 1e-13);
        assert_relative(sum[0][1], three, 1e-13);
    }
}

/* not a number and infinity arrive in the sums, padding does not */
static void test_kernels_stop_nothing(void **state) {
    (void)state;
    size_t variants;
    const fw_maths_rk_kernels *kernel = fw_maths_rk_kernels_table(&variants);
    const double *list[1] = {k[0]};
    const double e[2] = {1, 0};
    double s[2];
    for (size_t v = 0; v < variants; v++) {
        if (!kernel[v].usable()) continue;
        for (int c = 0; c < 8; c++) {
            k[0][c] = y[c] = z[c] = 0;
            tolerance[c] = c < 5 ? 1 : (double)INFINITY;
        }
        k[0][1] = 3;
        kernel[v].errors(8, 1, e, list, 1e-3, tolerance, y, z, s);
        assert_true(s[0] == 9 && s[1] == 0);
        z[6] = (double)NAN; /* a quadrature */
        kernel[v].errors(8, 1, e, list, 1e-3, tolerance, y, z, s);
        assert_true(isnan(s[0]));
        z[6] = 0;
        k[0][2] = (double)INFINITY;
        kernel[v].errors(8, 1, e, list, 1e-3, tolerance, y, z, s);
        assert_true(!(s[0] <= 1));
    }
}

/* u0 is stated, as by a driver, and stands on u1, which nothing excites: a step that its error allows is hundreds of radians of u1
   long, and what rounding leaves of that grows from stage to stage */
static const double fast = 1e3;

static void stated_and_fast(void *context, double t, const double *at, double *f) {
    (void)context;
    f[0] = at[2], f[1] = at[3];
    f[3] = -fast * fast * at[1];
    f[2] = cos(t) - f[3];
}

static bool as_stated(void *context, double t, double *at, double *f) {
    at[0] = 1 - cos(t), at[2] = sin(t);
    stated_and_fast(context, t, at, f);
    return true;
}

/* between the ends of a step it is no other than at them, whatever the three stages of the dense output do */
static void test_dense_beyond_stability(void **state) {
    (void)state;
    for (double rounding = 1e-60; rounding < 1e-9; rounding *= 10) {
        const fw_maths_ode ode = {
            .rhs = stated_and_fast, .project = as_stated, .n = 4, .controlled = 4, .positions = 2};
        const double start[4] = {0, rounding, 0, 0}, atol[4] = {1e-9, 1e-9, 1e-9, 1e-9};
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s;
        assert_int_equal(
            fw_maths_stepper_new(arena, fw_maths_stepper_find("dop853"), &ode, 1e-8, atol, &s),
            FW_OK);
        fw_maths_stepper_start(s, 0, start, 1);
        for (int steps = 0; s->t < 1 && steps < 40; steps++) {
            assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
            for (double theta = 0.125; theta < 1; theta += 0.125) {
                double at[8];
                fw_maths_stepper_dense(s, theta, at);
                assert_near(at[0], 1 - cos(s->t_old + theta * s->h), 1e-5);
            }
        }
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dense_beyond_stability),
        cmocka_unit_test(test_dop853),
        cmocka_unit_test(test_dopri5),
        cmocka_unit_test(test_radau5),
        cmocka_unit_test(test_kernels),
        cmocka_unit_test(test_kernels_stop_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
