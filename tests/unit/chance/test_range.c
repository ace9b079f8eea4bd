/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of which only an interval is known: ranges of probabilities against closed forms. */
#include "limits.h"

/* a plane whose distance depends on two unknowns: at the ends most, or inside where `humped` */
typedef struct unknown_limit {
    double z[2];
    int humped;
} unknown_limit;

static double beta_of(const unknown_limit *l) {
    return 3 + (l->humped ? 0.5 * cos(6 * l->z[0]) + 0.3 * (l->z[1] - 0.4) * (l->z[1] - 0.4)
                          : 0.5 * l->z[0] - 0.2 * l->z[1]);
}
static fw_status call(void *context, size_t first, size_t count, const double *u, double *value) {
    (void)first;
    for (size_t i = 0; i < count; i++)
        value[i] = beta_of(context) - (u[2 * i] + u[2 * i + 1]) / sqrt(2.0);
    return FW_OK;
}
static void set(void *context, const double *unknown) {
    memcpy(((unknown_limit *)context)->z, unknown, 2 * sizeof *unknown);
}

static void set_one(void *context, const double *unknown) {
    ((unknown_limit *)context)->z[0] = unknown[0];
}

static fw_chance_range run(unknown_limit *l, fw_chance_search search) {
    static const double low[] = {0, 0}, high[] = {1, 1};
    fw_chance_limit limit = {.dimensions = 2, .g = call, .context = l};
    fw_chance_unknowns unknowns = {2, low, high, set, search};
    fw_chance_options options = {.method = FW_CHANCE_IMPORTANCE, .seed = 4, .budget = 4000};
    fw_chance_range out;
    const char *why;
    assert_int_equal(fw_chance_range_run(arena, &limit, &unknowns, &options, &out, &why), FW_OK);
    assert_true(out.low <= out.least.low && out.high >= out.most.high);
    assert_int_equal(out.evaluations, out.settings * 4000);
    return out;
}

static void ends(void **state) {
    (void)state;
    unknown_limit l = {.humped = 0};
    fw_chance_range r = run(&l, FW_CHANCE_ENDS);
    assert_int_equal(r.settings, 4);
    assert_true(r.least_at[0] == 1 && r.least_at[1] == 0 && r.most_at[0] == 0 && r.most_at[1] == 1);
    assert_relative(r.least.probability_low, fw_maths_normal_cdf(-3.5), 0.15);
    assert_relative(r.most.probability_low, fw_maths_normal_cdf(-2.8), 0.15);
    assert_true(r.low <= fw_maths_normal_cdf(-3.5) && fw_maths_normal_cdf(-2.8) <= r.high);
}

/* cos(6 z) is least at z = pi/6, (z - 0.4)^2 at 0.4: the greatest probability is inside, the least at z = 0 and 1 */
static void inside(void **state) {
    (void)state;
    unknown_limit l = {.humped = 1};
    fw_chance_range r = run(&l, FW_CHANCE_INSIDE);
    assert_near(r.most_at[0], 0.5236, 0.07);
    assert_near(r.most_at[1], 0.4, 0.14);
    assert_relative(r.most.probability_low, fw_maths_normal_cdf(-2.5), 0.15);
    assert_near(r.least_at[0], 0, 0.1);
    assert_near(r.least_at[1], 1, 0);
    assert_true(r.settings > 4 && r.settings < 150);
    fw_chance_range corners = run(&l, FW_CHANCE_ENDS);
    assert_true(corners.high < fw_maths_normal_cdf(-2.5)); /* which the corners do not see */
}

static void refused(void **state) {
    (void)state;
    static const double low[11] = {0}, high[11] = {0, -1};
    unknown_limit l = {.humped = 0};
    fw_chance_limit limit = {.dimensions = 2, .g = call, .context = &l};
    fw_chance_unknowns unknowns = {2, low, high, set, FW_CHANCE_ENDS};
    fw_chance_options options = {.budget = 4000};
    fw_chance_range out;
    const char *why;
    assert_int_equal(fw_chance_range_run(arena, &limit, &unknowns, &options, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "lower end"));
    unknowns.count = 11;
    assert_int_equal(fw_chance_range_run(arena, &limit, &unknowns, &options, &out, &why), FW_INPUT);
    unknowns.count = 1, unknowns.set = set_one, options.budget = 1;
    assert_int_equal(fw_chance_range_run(arena, &limit, &unknowns, &options, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "200 evaluations"));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(ends), cmocka_unit_test(inside),
                                       cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
