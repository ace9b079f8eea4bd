/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Indices of functions that have them in closed form: linear, Ishigami's, a product; groups, coverage, what is missing. */
#include "chance/joint.h"
#include "base/constants.h"
#include "maths/functions.h"
#include "chance_test.h"

static fw_chance_indices run(const fw_chance_model *model, uint64_t seed, size_t base) {
    fw_chance_indices out;
    const char *why;
    fw_chance_index_options o = {.seed = seed, .base = base, .batch = 100};
    assert_int_equal(fw_chance_indices_run(arena, model, &o, &out, &why), FW_OK);
    return out;
}

/* response 0: 1000 + u_1 + 2 u_2 + 3 u_3; response 1: Ishigami's of x = pi (2 Phi(u) - 1), a = 7, b = 0.1 */
static fw_status two(void *context, size_t first, size_t count, const double *u, double *value) {
    assert_int_equal(first, *(size_t *)context);
    *(size_t *)context += count;
    for (size_t i = 0; i < count; i++) {
        double x[3];
        for (size_t d = 0; d < 3; d++)
            x[d] = FW_PI * (2 * fw_maths_normal_cdf(u[i * 3 + d]) - 1);
        value[2 * i] = 1000 + u[i * 3] + 2 * u[i * 3 + 1] + 3 * u[i * 3 + 2];
        value[2 * i + 1] = sin(x[0]) + 7 * pow(sin(x[1]), 2) + 0.1 * pow(x[2], 4) * sin(x[0]);
    }
    return FW_OK;
}

static void closed_forms(double first[2][3], double total[2][3], double variance[2]) {
    double b = 0.1, p4 = pow(FW_PI, 4), p8 = p4 * p4;
    double one = pow(1 + b * p4 / 5, 2) / 2, second = 49.0 / 8,
           both = b * b * p8 * (1.0 / 18 - 1.0 / 50);
    double all = one + second + both;
    const double want_first[2][3] = {{1.0 / 14, 4.0 / 14, 9.0 / 14}, {one / all, second / all, 0}};
    const double want_total[2][3] = {{1.0 / 14, 4.0 / 14, 9.0 / 14},
                                     {(one + both) / all, second / all, both / all}};
    memcpy(first, want_first, sizeof want_first);
    memcpy(total, want_total, sizeof want_total);
    variance[0] = 14, variance[1] = all;
}

static void known(void **state) {
    (void)state;
    double first[2][3], total[2][3], variance[2];
    closed_forms(first, total, variance);
    size_t calls = 0;
    fw_chance_model model = {3, 2, two, &calls, 0, NULL};
    fw_chance_indices s = run(&model, 3, 8192);
    assert_int_equal(s.evaluations, 5 * 8192);
    assert_int_equal(calls, s.evaluations);
    assert_near(s.mean[0], 1000, 1e-3);
    for (int r = 0; r < 2; r++) {
        assert_relative(s.variance[r], variance[r], 0.01);
        assert_int_equal(s.rows[r], 8192);
        for (int g = 0; g < 3; g++) {
            assert_near(s.first[3 * r + g].value, first[r][g], 0.01);
            assert_near(s.total[3 * r + g].value, total[r][g], 0.01);
            assert_true(s.first[3 * r + g].high - s.first[3 * r + g].low < 0.02);
        }
    }
    assert_near(s.mean[1], 3.5, 0.01);
}

/* the intervals hold at 95 % in at least what chance allows of 95 % (four standard deviations) */
static void coverage(void **state) {
    (void)state;
    double first[2][3], total[2][3], variance[2];
    closed_forms(first, total, variance);
    int seeds = test_cases(1000, 100), held[2][2][3] = {{{0}}};
    for (int seed = 0; seed < seeds; seed++) {
        fw_mark mark = fw_arena_mark(arena);
        size_t calls = 0;
        fw_chance_model model = {3, 2, two, &calls, 0, NULL};
        fw_chance_indices s = run(&model, (uint64_t)seed, 512);
        for (int r = 0; r < 2; r++)
            for (int g = 0; g < 3; g++) {
                const fw_chance_share *a = &s.first[3 * r + g], *b = &s.total[3 * r + g];
                held[0][r][g] += a->low <= first[r][g] && first[r][g] <= a->high;
                held[1][r][g] += b->low <= total[r][g] && total[r][g] <= b->high;
            }
        fw_arena_rewind(arena, mark);
    }
    for (int k = 0; k < 2; k++)
        for (int r = 0; r < 2; r++)
            for (int g = 0; g < 3; g++)
                assert_true(held[k][r][g] >= 0.95 * seeds - 4 * sqrt(0.0475 * seeds));
}

/* product of 1 + c_d u_d in 200 dimensions, beyond Sobol' points, in two groups: variances (1 + c^2)^n - 1 */
static fw_status product(void *context, size_t first, size_t count, const double *u,
                         double *value) {
    (void)context, (void)first;
    for (size_t i = 0; i < count; i++) {
        value[i] = 1;
        for (size_t d = 0; d < 200; d++)
            value[i] *= 1 + (d < 50 ? 0.08 : 0.03) * u[i * 200 + d];
    }
    return FW_OK;
}

static void groups(void **state) {
    (void)state;
    static size_t group[200];
    for (size_t d = 0; d < 200; d++)
        group[d] = d >= 50;
    fw_chance_model model = {200, 1, product, NULL, 2, group};
    fw_chance_indices s = run(&model, 5, 8192);
    assert_int_equal(s.groups, 2);
    assert_int_equal(s.evaluations, 4 * 8192);
    double one = pow(1 + 0.0064, 50) - 1, other = pow(1 + 0.0009, 150) - 1,
           all = (1 + one) * (1 + other) - 1;
    const double want[2] = {one / all, other / all};
    for (int g = 0; g < 2; g++) {
        double half = (s.first[g].high - s.first[g].low) / 2;
        assert_true(half < 0.1);
        assert_near(s.first[g].value, want[g], 2 * half);
        assert_near(s.total[g].value, want[g] + one * other / all,
                    s.total[g].high - s.total[g].low);
    }
}

static fw_status holes(void *context, size_t first, size_t count, const double *u, double *value) {
    (void)context, (void)first;
    for (size_t i = 0; i < count; i++) {
        value[2 * i] = u[2 * i] > 1.5 ? (double)NAN : u[2 * i] + u[2 * i + 1];
        value[2 * i + 1] = 4;
    }
    return FW_OK;
}

/* rows with a hole are left out and counted; a response that does not vary has no indices */
static void missing(void **state) {
    (void)state;
    fw_chance_model model = {2, 2, holes, NULL, 0, NULL};
    fw_chance_indices s = run(&model, 1, 1024);
    assert_near((double)s.rows[0] / 1024, pow(fw_maths_normal_cdf(1.5), 2), 0.02);
    assert_int_equal(s.rows[1], 1024);
    assert_true(s.first[0].value > 0.2 && s.first[0].value < s.first[1].value);
    assert_true(isnan(s.first[2].value) && isnan(s.total[3].low));
}

static void refused(void **state) {
    (void)state;
    const size_t wrong[2] = {0, 2};
    fw_chance_model model = {2, 2, holes, NULL, 0, NULL};
    fw_chance_indices out;
    const char *why;
    fw_chance_index_options o = {.base = 8};
    assert_int_equal(fw_chance_indices_run(arena, &model, &o, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "128 rows"));
    o = (fw_chance_index_options){.base = 128, .level = 1};
    assert_int_equal(fw_chance_indices_run(arena, &model, &o, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "level"));
    o.level = 0.9;
    model.groups = 2, model.group = wrong;
    assert_int_equal(fw_chance_indices_run(arena, &model, &o, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "group"));
    model.dimensions = 0;
    assert_int_equal(fw_chance_indices_run(arena, &model, &o, &out, &why), FW_INPUT);
    fw_cancel stop = {.number = 0};
    fw_arena *stopped = fw_arena_new(0);
    fw_arena_stop_with(stopped, &stop);
    fw_cancel_request(&stop, 2);
    model = (fw_chance_model){2, 2, holes, NULL, 0, NULL};
    assert_int_equal(fw_chance_indices_run(stopped, &model, &o, &out, &why), FW_CANCELLED);
    fw_arena_free(stopped);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(known), cmocka_unit_test(coverage),
                                       cmocka_unit_test(groups), cmocka_unit_test(missing),
                                       cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
