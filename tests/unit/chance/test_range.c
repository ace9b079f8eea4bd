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
    fw_chance_unknowns unknowns = {
        .count = 2, .low = low, .high = high, .set = set, .search = search};
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

/* ---- limits of which one binds at either end ---- */

/* u is between two limits that both rise with the unknown: it holds where from < u - slope z < to, so that the probability
   of failing is known for each z. `dip`: it fails besides where z is near 0.6 and u[1] above 0. */
typedef struct opposed {
    double from, to, slope, weight[2];
    double z[2];
    int dip;
    size_t calls, shift;
} opposed;

static double of_opposed(const opposed *l, double z) {
    const double mean = l->slope * z,
                 held = fw_maths_normal_cdf(mean + l->to) - fw_maths_normal_cdf(mean + l->from);
    return 1 - held * (l->dip && fabs(z - 0.6) < 0.2 ? 0.5 : 1);
}
static fw_status call_opposed(void *context, size_t first, size_t count, const double *u,
                              double *value) {
    opposed *l = context;
    const double z = l->weight[0] * l->z[0] + l->weight[1] * l->z[1];
    (void)first;
    l->calls += count;
    for (size_t i = 0; i < count; i++) {
        value[i] = fmin(u[2 * i] - l->slope * z - l->from, l->to + l->slope * z - u[2 * i]);
        if (l->dip) value[i] = fmin(value[i], 4 * (fabs(z - 0.6) - 0.2) - u[2 * i + 1]);
    }
    return FW_OK;
}
static void set_opposed(void *context, const double *unknown) {
    opposed *l = context;
    l->z[0] = unknown[0], l->z[1] = l->weight[1] != 0 ? unknown[1] : 0;
}

static fw_chance_range range_of(opposed *l, size_t budget, fw_chance_side side) {
    static const double low[] = {0, 0}, high[] = {1, 1};
    const fw_chance_limit limit = {.dimensions = 2, .g = call_opposed, .context = l};
    const fw_chance_unknowns unknowns = {.count = l->weight[1] != 0 ? 2 : 1,
                                         .low = low,
                                         .high = high,
                                         .set = set_opposed,
                                         .search = FW_CHANCE_WHERE_NEEDED,
                                         .side = side};
    const fw_chance_options options = {.seed = 7, .budget = budget};
    fw_chance_range out;
    const char *why;
    l->calls = 0;
    assert_int_equal(fw_chance_range_run(arena, &limit, &unknowns, &options, &out, &why), FW_OK);
    assert_int_equal(out.evaluations + out.looked, l->calls);
    return out;
}

/* the least and the most of the closed form */
static void extremes(const opposed *l, double *least, double *most) {
    *least = 1, *most = 0;
    for (int i = 0; i <= 1000; i++) {
        *least = fmin(*least, of_opposed(l, i / 1000.0));
        *most = fmax(*most, of_opposed(l, i / 1000.0));
    }
}

/* counted, and so rare that design points are sampled around: both limits at the same distance, and one nearer */
static void opposed_limits_bind_at_either_end(void **state) {
    (void)state;
    static const opposed given[] = {
        {.from = -2, .to = 1, .slope = 1, .weight = {1, 0}},
        {.from = -1.8, .to = 1.4, .slope = 1, .weight = {1, 0}},
        {.from = -2, .to = 1, .slope = 1, .weight = {0.5, 0.5}},
        {.from = -5, .to = 3.5, .slope = 1.5, .weight = {1, 0}},
    };
    for (size_t k = 0; k < sizeof given / sizeof *given; k++) {
        opposed l = given[k];
        double least, most;
        extremes(&l, &least, &most);
        const bool rare = l.to > 3;
        const fw_chance_range r = range_of(&l, rare ? 8000 : 4096, FW_CHANCE_BOTH_SIDES);
        assert_true(r.inside && r.settings < 60);
        assert_true(r.low <= least && most <= r.high);
        assert_relative(r.least.probability_low, least, rare ? 0.15 : 0.05);
        assert_relative(r.most.probability_high, most, rare ? 0.15 : 0.05);
        const fw_chance_range one = range_of(&l, rare ? 8000 : 4096, FW_CHANCE_LEAST_ONLY);
        assert_true(one.settings <= r.settings && one.low <= least);
    }
}

/* what is worst inside is found as well: a limit that is missed there and at neither end */
static void worse_inside(void **state) {
    (void)state;
    opposed l = {.from = -3, .to = 3, .slope = 0.2, .weight = {1, 0}, .dip = 1};
    const fw_chance_range r = range_of(&l, 1000, FW_CHANCE_BOTH_SIDES);
    assert_true(r.inside && r.most_at[0] > 0.4 && r.most_at[0] < 0.8);
    assert_true(r.most.probability_high > 0.45);
    const fw_chance_range one = range_of(&l, 1000, FW_CHANCE_MOST_ONLY);
    assert_true(one.most_at[0] > 0.4 && one.most_at[0] < 0.8);
}

/* one limit, or the other so far away that no failure is of it: the ends are enough, and no more is estimated */
static void one_limit_needs_its_ends(void **state) {
    (void)state;
    opposed l = {.from = -9, .to = 1, .slope = 1, .weight = {1, 0}};
    fw_chance_range r = range_of(&l, 1000, FW_CHANCE_BOTH_SIDES);
    assert_true(!r.inside && r.settings == 2 && r.looked > 0);
    assert_true(r.looked <= fw_chance_range_looks(1));
    l.weight[0] = l.weight[1] = 0.5;
    r = range_of(&l, 1000, FW_CHANCE_BOTH_SIDES);
    assert_true(!r.inside && r.settings == 4 && r.looked <= fw_chance_range_looks(2));
    l = (opposed){.from = -12, .to = 11, .slope = 1, .weight = {1, 0}}; /* nothing fails */
    r = range_of(&l, 1000, FW_CHANCE_BOTH_SIDES);
    assert_true(!r.inside && r.settings == 2);
}

/* who has a share of the points cannot know where to look */
static void shares_do_not_search(void **state) {
    (void)state;
    static const double low[] = {0}, high[] = {1};
    opposed l = {.from = -2, .to = 1, .slope = 1, .weight = {1, 0}};
    const fw_chance_limit limit = {
        .dimensions = 2, .g = call_opposed, .context = &l, .apart = call_opposed};
    const fw_chance_unknowns unknowns = {.count = 1,
                                         .low = low,
                                         .high = high,
                                         .set = set_opposed,
                                         .search = FW_CHANCE_WHERE_NEEDED};
    const fw_chance_options options = {.seed = 7, .budget = 1000};
    fw_chance_range out;
    const char *why;
    assert_int_equal(fw_chance_range_run(arena, &limit, &unknowns, &options, &out, &why), FW_LIMIT);
    assert_non_null(why);
}

static void refused(void **state) {
    (void)state;
    static const double low[11] = {0}, high[11] = {0, -1};
    unknown_limit l = {.humped = 0};
    fw_chance_limit limit = {.dimensions = 2, .g = call, .context = &l};
    fw_chance_unknowns unknowns = {
        .count = 2, .low = low, .high = high, .set = set, .search = FW_CHANCE_ENDS};
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(ends),
                                       cmocka_unit_test(inside),
                                       cmocka_unit_test(opposed_limits_bind_at_either_end),
                                       cmocka_unit_test(worse_inside),
                                       cmocka_unit_test(one_limit_needs_its_ends),
                                       cmocka_unit_test(shares_do_not_search),
                                       cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
