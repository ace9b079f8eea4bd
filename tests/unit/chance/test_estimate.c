/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each method by itself: coverage of its intervals, what cannot be evaluated, repeatability, what is refused. */
#include "limits.h"

static void covers(fw_chance_method method, size_t state, size_t budget, int quick, double most) {
    double width;
    int seeds = test_fewest(test_cases(1000, quick), 2);
    limit_coverage(&limit_states[state], (fw_chance_options){.method = method, .budget = budget},
                   seeds, &width);
    if (seeds > 2) assert_true(width < most); /* the mean of two may be anything */
}

static void monte_carlo(void **state) {
    (void)state;
    covers(FW_CHANCE_MONTE_CARLO, 1, 1000, 100, 0.25);
    covers(FW_CHANCE_MONTE_CARLO, 5, 1000, 100, 2);
    covers(FW_CHANCE_MONTE_CARLO, 8, 300, 100, 400); /* never a failure: 1 %, and held */
}

static void quasi(void **state) {
    (void)state;
    covers(FW_CHANCE_QUASI, 1, 4096, 60, 0.05);
    covers(FW_CHANCE_QUASI, 4, 1024, 20, 1);
    covers(FW_CHANCE_QUASI, 5, 8192, 40, 0.8);
    covers(FW_CHANCE_QUASI, 7, 8192, 40, 0.8);
}

static void importance(void **state) {
    (void)state;
    covers(FW_CHANCE_IMPORTANCE, 0, 4000, 60, 0.12);
    covers(FW_CHANCE_IMPORTANCE, 2, 4000, 60, 0.12);
    covers(FW_CHANCE_IMPORTANCE, 5, 8000, 40, 0.12);
    covers(FW_CHANCE_IMPORTANCE, 7, 8000, 40, 0.12);
}

static void subset(void **state) {
    (void)state;
    covers(FW_CHANCE_SUBSET, 0, 20000, 15, 1);
    covers(FW_CHANCE_SUBSET, 1, 20000, 15, 0.08);
    covers(FW_CHANCE_SUBSET, 5, 20000, 15, 0.3);
    covers(FW_CHANCE_SUBSET, 9, 20000, 15, 0.5);
}

/* the mean of many estimates over the truth, and its error */
static double mean_of(fw_chance_method method, size_t state, size_t budget, double *error) {
    int seeds = test_fewest(test_cases(1000, 60), 40);
    limit_state *l = &limit_states[state];
    double sum = 0, square = 0, truth = truth_of(l);
    for (int seed = 0; seed < seeds; seed++) {
        fw_mark mark = fw_arena_mark(arena);
        fw_chance_options o = {.method = method, .seed = 5000 + (uint64_t)seed, .budget = budget};
        double share = limit_estimate(l, o).probability_low / truth;
        sum += share, square += share * share;
        fw_arena_rewind(arena, mark);
    }
    double mean = sum / seeds;
    *error = sqrt((square / seeds - mean * mean) / seeds);
    if (getenv("FW_TEST_SHOW"))
        printf("mean of %s: %.4f +- %.4f\n", fw_chance_method_id(method), mean, *error);
    return mean;
}

/* importance sampling is exact in the mean; subset simulation may be too high by O(1/points), 10 % at most with 400 points */
static void means(void **state) {
    (void)state;
    double error, mean = mean_of(FW_CHANCE_IMPORTANCE, 2, 5000, &error);
    assert_near(mean, 1, 4 * error);
    mean = mean_of(FW_CHANCE_IMPORTANCE, 5, 5000, &error);
    assert_near(mean, 1, 4 * error);
    mean = mean_of(FW_CHANCE_SUBSET, 2, 20000, &error);
    assert_near(mean, 1.05, 0.05 + 4 * error);
    mean = mean_of(FW_CHANCE_SUBSET, 5, 20000, &error);
    assert_near(mean, 1.05, 0.05 + 4 * error);
}

/* batches of any size give the same bits; another seed other ones */
static void repeatable(void **state) {
    (void)state;
    for (int method = FW_CHANCE_AUTO; method <= FW_CHANCE_SUBSET; method++) {
        fw_chance_options o = {.method = (fw_chance_method)method, .seed = 3, .budget = 4000};
        fw_chance_estimate a = limit_estimate(&limit_states[5], o);
        o.batch = 7;
        fw_chance_estimate b = limit_estimate(&limit_states[5], o);
        assert_true(a.low == b.low && a.high == b.high && a.probability_low == b.probability_low);
        assert_int_equal(a.evaluations, b.evaluations);
        o.seed = 4;
        assert_true(limit_estimate(&limit_states[5], o).probability_low != a.probability_low);
        assert_true(a.level == 0.95);
        o.level = 0.999;
        fw_chance_estimate wide = limit_estimate(&limit_states[5], o);
        assert_true(wide.level == 0.999 && wide.high - wide.low > a.high - a.low);
    }
}

/* linear, and not to be evaluated far on the other side, where it would not fail, or where the failure is deep */
static double holes_across(const limit_state *l, const double *u) {
    return u[0] < -l->b - 0.2 ? (double)NAN : l->b - u[0];
}
static double holes_beyond(const limit_state *l, const double *u) {
    return u[0] > l->b + 0.2 ? (double)NAN : l->b - u[0];
}

static void check_holes(limit_state *l, fw_chance_method method, double low, double high) {
    fw_chance_estimate e =
        limit_estimate(l, (fw_chance_options){.method = method, .seed = 1, .level = 0.999});
    if (getenv("FW_TEST_SHOW"))
        printf("%s %g: %g %g in %g %g\n", fw_chance_method_id(e.method), l->b, low, high, e.low,
               e.high);
    assert_true(e.low <= low && high <= e.high);
    assert_true(e.unevaluated > 0);
    assert_relative(e.probability_low, low, 0.35);
    assert_relative(e.probability_high, high, 0.35);
    assert_true(e.probability_low < e.probability_high && e.low > low / 4 && e.high < high * 4);
}

/* then the probability lies between two */
static void holes(void **state) {
    (void)state;
    for (int m = FW_CHANCE_AUTO; m <= FW_CHANCE_SUBSET; m++) {
        limit_state l = {.name = "across", .dimensions = 3, .g = holes_across, .b = 1.5};
        double tail = fw_maths_normal_cdf(-l.b), deep = fw_maths_normal_cdf(-l.b - 0.2);
        check_holes(&l, (fw_chance_method)m, tail, tail + deep);
        l.g = holes_beyond;
        check_holes(&l, (fw_chance_method)m, tail - deep, tail);
        if (m == FW_CHANCE_MONTE_CARLO || m == FW_CHANCE_QUASI) continue;
        l.b = 4;
        tail = fw_maths_normal_cdf(-4), deep = fw_maths_normal_cdf(-4.2);
        check_holes(&l, (fw_chance_method)m, tail - deep, tail);
    }
}

/* what nearly always fails: survival is what is rare */
static void nearly_certain(void **state) {
    (void)state;
    limit_state l = {.name = "nearly certain",
                     .dimensions = 4,
                     .g = limit_linear,
                     .b = -4,
                     .reference = reference_linear};
    double rare = fw_maths_normal_cdf(-4);
    fw_chance_estimate e =
        limit_estimate(&l, (fw_chance_options){.method = FW_CHANCE_IMPORTANCE, .seed = 1});
    assert_relative(1 - e.probability_low, rare, 0.1);
    assert_true(1 - e.high <= rare && rare <= 1 - e.low && e.high - e.low < 0.2 * rare);
    assert_true(e.point[0].beta < -3.9);
    e = limit_estimate(&l, (fw_chance_options){.method = FW_CHANCE_AUTO, .seed = 1});
    assert_int_equal(e.method, FW_CHANCE_QUASI);
    assert_true(e.high == 1 && e.low > 0.999);
}

static fw_status broken(void *context, size_t first, size_t count, const double *u, double *value) {
    (void)first, (void)u;
    for (size_t i = 0; i < count; i++)
        value[i] = (double)NAN;
    return *(const fw_status *)context;
}

static void refused(void **state) {
    (void)state;
    fw_status says = FW_OK;
    fw_chance_limit limit = {.dimensions = 2, .g = broken, .context = &says};
    fw_chance_options o = {.budget = 199};
    fw_chance_estimate out;
    const char *why;
    assert_int_equal(fw_chance_estimate_run(arena, &limit, &o, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "200 evaluations"));
    o.budget = 4000, o.level = 1.5;
    assert_int_equal(fw_chance_estimate_run(arena, &limit, &o, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "level"));
    o.level = 0, limit.dimensions = 0;
    assert_int_equal(fw_chance_estimate_run(arena, &limit, &o, &out, &why), FW_INPUT);
    assert_non_null(strstr(why, "nothing scatters"));
    limit.dimensions = 400, o.method = FW_CHANCE_QUASI;
    assert_int_equal(fw_chance_estimate_run(arena, &limit, &o, &out, &why), FW_LIMIT);
    limit.dimensions = 2;
    for (int method = FW_CHANCE_AUTO; method <= FW_CHANCE_SUBSET;
         method++) { /* nothing can be evaluated: 0 to 1 */
        o.method = (fw_chance_method)method;
        fw_status status = fw_chance_estimate_run(arena, &limit, &o, &out, &why);
        if (method == FW_CHANCE_IMPORTANCE)
            assert_int_equal(status, FW_SOLVER);
        else
            assert_true(status == FW_OK && out.low == 0 && out.high == 1 &&
                        out.unevaluated == out.evaluations);
    }
    says = FW_IO;
    for (int method = FW_CHANCE_AUTO; method <= FW_CHANCE_SUBSET; method++) {
        o.method = (fw_chance_method)method;
        assert_int_equal(fw_chance_estimate_run(arena, &limit, &o, &out, &why), FW_IO);
    }
    fw_cancel stop = {.number = 0};
    fw_arena *stopped = fw_arena_new(0);
    fw_arena_stop_with(stopped, &stop);
    fw_cancel_request(&stop, 2);
    assert_int_equal(fw_chance_estimate_run(stopped, &limit, &o, &out, &why), FW_CANCELLED);
    fw_arena_free(stopped);
}

/* every allocation fails once: the answer is that memory is short, or the same as ever */
static void short_of_memory(void **state) {
    (void)state;
    for (int method = FW_CHANCE_AUTO; method <= FW_CHANCE_SUBSET; method++) {
        limit_state *l = &limit_states[5];
        fw_chance_options o = {.method = (fw_chance_method)method, .seed = 3, .budget = 3000};
        fw_chance_limit limit = {.dimensions = l->dimensions, .g = limit_call, .context = l};
        fw_chance_estimate want = limit_estimate(l, o), out;
        const char *why;
        fw_status status = FW_NOMEM;
        for (long n = 1; status != FW_OK; n++) {
            fw_mark mark = fw_arena_mark(arena);
            l->next = 0;
            fw_arena_fail_at(n, 0);
            status = fw_chance_estimate_run(arena, &limit, &o, &out, &why);
            fw_arena_fail_at(0, 0);
            assert_true(status == FW_NOMEM ||
                        (status == FW_OK && out.low == want.low && out.high == want.high));
            if (status == FW_OK) assert_true(n > 2);
            fw_arena_rewind(arena, mark);
        }
    }
}

static void names(void **state) {
    (void)state;
    for (int m = FW_CHANCE_AUTO; m <= FW_CHANCE_SUBSET; m++) {
        fw_chance_method found;
        assert_int_equal(fw_chance_method_find(fw_chance_method_id((fw_chance_method)m), &found),
                         FW_OK);
        assert_int_equal(found, m);
        assert_true(strlen(fw_chance_method_text((fw_chance_method)m)) > 5);
    }
    fw_chance_method found;
    assert_int_equal(fw_chance_method_find("luck", &found), FW_INPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(monte_carlo), cmocka_unit_test(quasi),
        cmocka_unit_test(importance),  cmocka_unit_test(subset),
        cmocka_unit_test(means),       cmocka_unit_test(repeatable),
        cmocka_unit_test(holes),       cmocka_unit_test(nearly_certain),
        cmocka_unit_test(refused),     cmocka_unit_test(short_of_memory),
        cmocka_unit_test(names)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
