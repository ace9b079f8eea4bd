/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Correlated inputs: Nataf's correlation against closed forms, what maps and draws give, what is refused. */
#include "chance/joint.h"
#include "base/constants.h"
#include "maths/functions.h"
#include "chance_test.h"

static double nataf(const fw_chance_distribution *a, const fw_chance_distribution *b,
                    double value) {
    double normal = 9, low, high;
    assert_int_equal(fw_chance_joint_normal(arena, a, b, value, &normal, &low, &high), FW_OK);
    return normal;
}

/* two normal: the same; two uniform: 2 sin(pi rho/6); two lognormal: ln(1 + rho v w)/(s t) */
static void closed_forms(void **state) {
    (void)state;
    fw_chance_distribution normal = {.kind = FW_CHANCE_NORMAL, .mean = 3, .sd = 2};
    fw_chance_distribution uniform = {.kind = FW_CHANCE_UNIFORM, .low = -1, .high = 5};
    fw_chance_distribution one = {.kind = FW_CHANCE_LOGNORMAL, .mean = 3, .sd = 1.2};
    fw_chance_distribution other = {.kind = FW_CHANCE_LOGNORMAL, .mean = 1, .sd = 1};
    for (double rho = -0.9; rho < 0.95; rho += 0.1) {
        assert_near(nataf(&normal, &normal, rho), rho, 1e-10);
        assert_near(nataf(&uniform, &uniform, rho), 2 * sin(FW_PI * rho / 6), 1e-9);
        if (rho > -0.6) {
            double s = sqrt(log1p(0.16)), t = sqrt(log1p(1));
            assert_near(nataf(&one, &other, rho), log1p(rho * 0.4) / (s * t), 1e-9);
        }
        assert_near(nataf(&normal, &one, rho), rho * 0.4 / sqrt(log1p(0.16)), 1e-9); /* rho v/s */
    }
    double x, low, high;
    assert_int_equal(fw_chance_joint_normal(arena, &one, &other, -0.9, &x, &low, &high), FW_INPUT);
    double s = sqrt(log1p(0.16)), t = sqrt(log1p(1));
    assert_near(low, expm1(-s * t) / 0.4, 1e-8);
    assert_near(high, expm1(s * t) / 0.4, 1e-8);
}

/* a table with corners and a truncated normal: the correlation of the values by quadrature in two dimensions */
static void by_quadrature(void **state) {
    (void)state;
    static const double x[] = {0, 1, 1.5, 6}, p[] = {0, 0.5, 0.9, 1};
    fw_chance_distribution table = {.kind = FW_CHANCE_TABLE, .count = 4, .x = x, .p = p};
    fw_chance_distribution cut = {
        .kind = FW_CHANCE_TRUNCATED, .mean = 0, .sd = 1, .low = -0.5, .high = 2};
    double r = nataf(&table, &cut, 0.6), h = 1.0 / 64, sum = 0, root = sqrt(1 - r * r);
    for (double z = -8; z <= 8; z += h)
        for (double w = -8; w <= 8; w += h)
            sum += h * h * fw_maths_normal_density(z) * fw_maths_normal_density(w) *
                   (fw_chance_distribution_value(&table, z) - fw_chance_distribution_mean(&table)) *
                   fw_chance_distribution_value(&cut, r * z + root * w);
    sum /= fw_chance_distribution_sd(&table) * fw_chance_distribution_sd(&cut);
    assert_near(sum, 0.6, 1e-4); /* of the quadrature: h^2 at the corners */
}

static const fw_chance_variable variables[] = {
    {.name = "rate",
     .level = FW_CHANCE_LOT,
     .distribution = {.kind = FW_CHANCE_LOGNORMAL, .mean = 2, .sd = 0.5}},
    {.name = "film",
     .level = FW_CHANCE_WAFER,
     .distribution = {.kind = FW_CHANCE_NORMAL, .mean = 10, .sd = 1},
     .trend = {.radius_m = 0.05, .radial = 0.4, .along_x = 0.2, .along_y = -0.1}},
    {.name = "fixed",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_CONSTANT, .mean = 7}},
    {.name = "edge",
     .level = FW_CHANCE_HINGE,
     .distribution = {.kind = FW_CHANCE_UNIFORM, .low = -1, .high = 1}},
    {.name = "lean",
     .level = FW_CHANCE_HINGE,
     .distribution = {.kind = FW_CHANCE_NORMAL, .mean = 0, .sd = 3}},
    {.name = "unknown",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_INTERVAL, .low = 1, .high = 4}},
    {.name = "gas",
     .level = FW_CHANCE_LOT,
     .distribution = {.kind = FW_CHANCE_NORMAL, .mean = 0, .sd = 1}},
};
enum { VARIABLES = sizeof variables / sizeof *variables, HINGES = 3 };
static const fw_chance_correlation rows[] = {{3, 4, 0.7}, {6, 0, -0.5}};

static void layout(void **state) {
    (void)state;
    fw_chance_joint j;
    fw_chance_fault fault;
    assert_int_equal(fw_chance_joint_new(arena, HINGES, VARIABLES, variables, 2, rows, &j, &fault),
                     FW_OK);
    assert_int_equal(j.values, 5 + 2 * HINGES);
    assert_int_equal(j.dimensions, 3 + 2 * HINGES);
    assert_int_equal(j.unknowns, 1);
    assert_int_equal(j.unknown[0], 5);
    assert_int_equal(j.u_variable[5], 4);
    double u[9] = {0}, x[11];
    u[2 + 3] = 1.5; /* lean of hinge 0 alone */
    fw_chance_joint_map(&j, u, NULL, NULL, x);
    assert_near(x[j.value_first[4]], 3 * 1.5 * j.factor[4 * VARIABLES + 4], 1e-14);
    assert_near(x[j.value_first[4] + 1], 0, 1e-15);
    assert_near(x[j.value_first[5]], 2.5, 0);
    fw_chance_joint_map(&j, u, (double[]){3.25}, &(fw_chance_place){.x_m = 0.03, .y_m = 0.04}, x);
    assert_near(x[j.value_first[5]], 3.25, 0);
    assert_near(x[j.value_first[1]], 10 + 0.4 * 0.5 + 0.2 * 0.6 - 0.1 * 0.8, 1e-14);
}

/* Pearson's coefficients of what is drawn, and what dies of one wafer, wafers of one lot share */
static void draws(void **state) {
    (void)state;
    fw_chance_joint j;
    fw_chance_fault fault;
    assert_int_equal(fw_chance_joint_new(arena, HINGES, VARIABLES, variables, 2, rows, &j, &fault),
                     FW_OK);
    enum { N = 40000 };
    double sum[2][2] = {{0}}, square[2][2] = {{0}}, product[2] = {0};
    double u[9], x[11];
    for (uint32_t i = 0; i < N; i++) {
        fw_chance_joint_draw(&j, 5, &(fw_chance_place){.lot = i, .wafer = 3, .die = 8}, u);
        fw_chance_joint_map(&j, u, NULL, NULL, x);
        const double pair[2][2] = {{x[j.value_first[3] + 2], x[j.value_first[4] + 2]},
                                   {x[j.value_first[6]], x[0]}};
        for (int k = 0; k < 2; k++) {
            product[k] += pair[k][0] * pair[k][1];
            for (int c = 0; c < 2; c++)
                sum[k][c] += pair[k][c], square[k][c] += pair[k][c] * pair[k][c];
        }
    }
    const double want[2] = {0.7, -0.5};
    for (int k = 0; k < 2; k++) {
        double covariance = product[k] / N - sum[k][0] / N * sum[k][1] / N;
        double a = square[k][0] / N - pow(sum[k][0] / N, 2),
               b = square[k][1] / N - pow(sum[k][1] / N, 2);
        assert_near(covariance / sqrt(a * b), want[k], 5.0 / sqrt((double)N));
    }
    double v[9];
    fw_chance_joint_draw(&j, 5, &(fw_chance_place){.lot = 1, .wafer = 2, .die = 3}, u);
    fw_chance_joint_draw(&j, 5, &(fw_chance_place){.lot = 1, .wafer = 2, .die = 4}, v);
    for (size_t d = 0; d < j.dimensions; d++)
        assert_true((u[d] == v[d]) == (j.variable[j.u_variable[d]].level < FW_CHANCE_DIE));
    assert_true(u[2] != u[3]); /* hinges have their own */
    fw_chance_joint_draw(&j, 5, &(fw_chance_place){.lot = 1, .wafer = 9, .die = 3}, v);
    for (size_t d = 0; d < j.dimensions; d++)
        assert_true((u[d] == v[d]) == (j.variable[j.u_variable[d]].level < FW_CHANCE_WAFER));
    fw_chance_joint_draw(&j, 6, &(fw_chance_place){.lot = 1, .wafer = 2, .die = 3}, v);
    for (size_t d = 0; d < j.dimensions; d++)
        assert_true(u[d] != v[d]);
}

static void refused(void **state) {
    (void)state;
    fw_chance_variable some[4];
    for (int i = 0; i < 4; i++)
        some[i] =
            (fw_chance_variable){.name = "x",
                                 .level = FW_CHANCE_DIE,
                                 .distribution = {.kind = FW_CHANCE_NORMAL, .mean = 1, .sd = 1}};
    const struct {
        size_t count;
        fw_chance_correlation row[3];
        const char *says;
    } bad[] = {{1, {{0, 4, 0.1}}, "no such variable"},
               {1, {{1, 1, 0.1}}, "itself"},
               {1, {{0, 1, 1}}, "below 1"},
               {2, {{0, 1, 0.1}, {1, 0, 0.2}}, "twice"},
               {3, {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}}, "contradict"},
               {1, {{0, 3, 0.1}}, "levels"}};
    some[3].level = FW_CHANCE_LOT;
    fw_chance_joint j;
    fw_chance_fault fault;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(
            fw_chance_joint_new(arena, 1, 4, some, bad[i].count, bad[i].row, &j, &fault), FW_INPUT);
        assert_non_null(strstr(fault.why, bad[i].says));
        assert_true(fault.variable == SIZE_MAX);
        assert_true(i == 4 ? fault.correlation == SIZE_MAX : fault.correlation == bad[i].count - 1);
    }
    some[1].distribution.kind = FW_CHANCE_CONSTANT;
    assert_int_equal(
        fw_chance_joint_new(arena, 1, 4, some, 1, &(fw_chance_correlation){0, 1, 0.2}, &j, &fault),
        FW_INPUT);
    assert_non_null(strstr(fault.why, "does not scatter"));
    some[1].distribution =
        (fw_chance_distribution){.kind = FW_CHANCE_LOGNORMAL, .mean = 1, .sd = 3};
    assert_int_equal(
        fw_chance_joint_new(arena, 1, 4, some, 1, &(fw_chance_correlation){0, 1, 0.9}, &j, &fault),
        FW_INPUT);
    assert_non_null(strstr(fault.why, "by more than 0.5"));
    assert_int_equal(
        fw_chance_joint_new(arena, 1, 4, some, 1, &(fw_chance_correlation){0, 1, -0.9}, &j, &fault),
        FW_INPUT);
    assert_non_null(strstr(fault.why, "by less than -0.5"));
    some[2].distribution.sd = -1;
    assert_int_equal(fw_chance_joint_new(arena, 1, 4, some, 0, NULL, &j, &fault), FW_INPUT);
    assert_int_equal(fault.variable, 2);
    some[2].distribution.sd = 1;
    some[2].trend.radial = 1;
    assert_int_equal(fw_chance_joint_new(arena, 1, 4, some, 0, NULL, &j, &fault), FW_INPUT);
    assert_non_null(strstr(fault.why, "radius"));
    some[2].trend.along_y = (double)NAN;
    assert_int_equal(fw_chance_joint_new(arena, 1, 4, some, 0, NULL, &j, &fault), FW_INPUT);
    assert_non_null(strstr(fault.why, "not finite"));
    assert_int_equal(fw_chance_joint_new(arena, 1, 0, NULL, 0, NULL, &j, &fault), FW_OK);
    assert_int_equal(j.dimensions, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(closed_forms),
                                       cmocka_unit_test(by_quadrature), cmocka_unit_test(layout),
                                       cmocka_unit_test(draws), cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
