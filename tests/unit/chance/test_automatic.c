/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The automatic choice with 2e4 evaluations: probabilities from 1e-6 to 10 %, 2 to 20 dimensions, correlated and lognormal
   inputs; what it says of its choice. FW_TEST_SHOW=1 prints what was held. */
#include "limits.h"

static fw_chance_joint joint_of(const fw_chance_variable *variable, double correlation) {
    fw_chance_joint joint;
    fw_chance_fault fault;
    fw_chance_correlation row = {0, 1, correlation};
    assert_int_equal(fw_chance_joint_new(arena, 1, 2, variable, 1, &row, &joint, &fault), FW_OK);
    return joint;
}

/* normal, mean 10 and 20, sd 1 and 3, correlated: x + y stays below b */
static const fw_chance_variable normals[] = {
    {.name = "x",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_NORMAL, .mean = 10, .sd = 1}},
    {.name = "y",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_NORMAL, .mean = 20, .sd = 3}}};
static double limit_sum(const limit_state *l, const double *u) {
    double x[2];
    fw_chance_joint_map(l->joint, u, NULL, NULL, x);
    return l->b - x[0] - x[1];
}

/* lognormal, correlated: the product stays below b, the quotient above */
static const fw_chance_variable lognormals[] = {
    {.name = "x",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_LOGNORMAL, .mean = 2, .sd = 0.6}},
    {.name = "y",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_LOGNORMAL, .mean = 5, .sd = 1}}};
static double limit_product(const limit_state *l, const double *u) {
    double x[2];
    fw_chance_joint_map(l->joint, u, NULL, NULL, x);
    return l->b - x[0] * x[1];
}
static double limit_quotient(const limit_state *l, const double *u) {
    double x[2];
    fw_chance_joint_map(l->joint, u, NULL, NULL, x);
    return x[0] / x[1] - l->b;
}

/* ln(x y), or ln(x/y) with sign -1, is normal: the covariance of the logarithms is ln(1 + rho v w) */
static double lognormal_truth(double rho, double sign, double b) {
    double v = 0.3, w = 0.2, s = log1p(v * v), t = log1p(w * w);
    double mean = log(2) - s / 2 + sign * (log(5) - t / 2),
           sd = sqrt(s + t + sign * 2 * log1p(rho * v * w));
    return fw_maths_normal_cdf(sign * (mean - log(b)) / sd);
}

static void covered(limit_state *l, int quick) {
    double width;
    limit_coverage(l, (fw_chance_options){.method = FW_CHANCE_AUTO},
                   test_fewest(test_cases(1000, quick), 1), &width);
    bool hard = l->g == limit_flat ||
                l->g == limit_sphere; /* nothing but counting, or subset simulation, is left */
    assert_true(width < (hard ? 8 : 0.06)); /* half width of the truth, with 2e4 evaluations */
}

static void closed_forms(void **state) {
    (void)state;
    for (size_t i = 0; i < LIMIT_STATES; i++)
        if (limit_states[i].dimensions < 100)
            covered(&limit_states[i], limit_states[i].dimensions < 20 ? 12 : 3);
}

static void correlated(void **state) {
    (void)state;
    fw_chance_joint joint = joint_of(normals, 0.6);
    double sd = sqrt(1 + 9 + 2 * 0.6 * 3);
    for (double beta = 2; beta < 4.6; beta += 1.25) {
        limit_state l = {.name = "correlated",
                         .dimensions = 2,
                         .g = limit_sum,
                         .b = 30 + beta * sd,
                         .joint = &joint,
                         .truth = fw_maths_normal_cdf(-beta)};
        covered(&l, 8);
    }
}

static void lognormal(void **state) {
    (void)state;
    fw_chance_joint joint = joint_of(lognormals, -0.4);
    limit_state product = {.name = "lognormal product",
                           .dimensions = 2,
                           .g = limit_product,
                           .b = 30,
                           .joint = &joint,
                           .truth = lognormal_truth(-0.4, 1, 30)};
    limit_state quotient = {.name = "lognormal quotient",
                            .dimensions = 2,
                            .g = limit_quotient,
                            .b = 0.09,
                            .joint = &joint,
                            .truth = lognormal_truth(-0.4, -1, 0.09)};
    assert_true(product.truth > 1e-6 && product.truth < 1e-3 && quotient.truth > 1e-6 &&
                quotient.truth < 1e-3);
    covered(&product, 8);
    covered(&quotient, 8);
}

/* ---- few inputs, and failures on more than one side ---- */

/* of one table, one in ten of what fails lies below; and a lognormal load that has to come to three times its mean, below
   which another check holds the device at the same share whatever the load is */
static const double table_x[] = {-1.5, -1.3, 1.39, 1.6}, table_p[] = {0, 2e-5, 0.9999, 1};
static const fw_chance_variable one_table[] = {
    {.name = "m",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_TABLE, .count = 4, .x = table_x, .p = table_p}},
    {.name = "p",
     .level = FW_CHANCE_DIE,
     .distribution = {.kind = FW_CHANCE_LOGNORMAL, .mean = 1, .sd = 0.3}}};
static const double table_fails = 1e-4 * 0.2 / 0.21 + 1e-5;

static double limit_table(const limit_state *l, const double *u) {
    return -log(
        fmax(fabs(fw_chance_distribution_value(&one_table[0].distribution, u[0])) / l->b, 1e-3));
}
static double load(double u) {
    const double p = fw_chance_distribution_value(&one_table[1].distribution, u);
    assert_true(isfinite(p)); /* nobody looks where an input has no value */
    return p / 3;
}
static double limit_load(const limit_state *l, const double *u) {
    /* the check that holds it is as good as its last digits */
    return -log(fmax(l->b * (1 + 1e-14 * sin(1e5 * u[0])), load(u[0])));
}
static double limit_both(const limit_state *l, const double *u) {
    return fmin(limit_table(l, u), -log(load(u[1])));
}
/* and with a third input that does nothing, the first is normal: fails below -4 and above 3.5 */
static double limit_three(const limit_state *l, const double *u) {
    return fmin(fmin(l->b - u[0], l->b + 0.5 + u[0]) / 4, -log(load(u[1]))) + 0 * u[2];
}

static void both_sides(void **state) {
    (void)state;
    const double fails = fw_maths_normal_cdf(-(log(3) - log(1 / sqrt(1.09))) / sqrt(log(1.09)));
    limit_state of[] = {
        {.name = "table", .dimensions = 1, .g = limit_table, .b = 1.4, .truth = table_fails},
        {.name = "load", .dimensions = 1, .g = limit_load, .b = 0.714, .truth = fails},
        {.name = "table and load",
         .dimensions = 2,
         .g = limit_both,
         .b = 1.4,
         .truth = 1 - (1 - table_fails) * (1 - fails)},
        {.name = "two sides and load",
         .dimensions = 3,
         .g = limit_three,
         .b = 3.5,
         .truth = 1 - (1 - fw_maths_normal_cdf(-3.5) - fw_maths_normal_cdf(-4)) * (1 - fails)}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        double width;
        limit_coverage(&of[i], (fw_chance_options){.method = FW_CHANCE_AUTO, .budget = 4000},
                       test_cases(200, 40), &width);
        assert_true(width < 0.25);
        const fw_chance_estimate e =
            limit_estimate(&of[i], (fw_chance_options){.seed = 1, .budget = 4000});
        assert_non_null(strstr(e.caution, of[i].dimensions == 1 ? "the one input was followed"
                                                                : "points would meet it"));
    }
}

static void chosen(size_t which, fw_chance_method method, const char *says) {
    fw_chance_estimate e = limit_estimate(&limit_states[which], (fw_chance_options){.seed = 2});
    assert_int_equal(e.method, method);
    assert_non_null(strstr(e.reason, says));
    assert_true((e.caution != NULL) == (method == FW_CHANCE_IMPORTANCE));
}

static void reasons(void **state) {
    (void)state;
    chosen(0, FW_CHANCE_IMPORTANCE, "subset simulation agrees");
    chosen(1, FW_CHANCE_QUASI, "often enough to count");
    chosen(9, FW_CHANCE_SUBSET, "uneven weights");
    chosen(10, FW_CHANCE_QUASI, "shows no way");
    limit_state many = {.name = "many", .dimensions = 400, .g = limit_linear, .b = 1};
    fw_chance_estimate e = limit_estimate(&many, (fw_chance_options){.seed = 2});
    assert_int_equal(e.method, FW_CHANCE_MONTE_CARLO);
    assert_non_null(strstr(e.reason, "Sobol' points do not"));
    assert_true(e.low < fw_maths_normal_cdf(-1) && fw_maths_normal_cdf(-1) < e.high);
    e = limit_estimate(&limit_states[2], (fw_chance_options){.seed = 2, .budget = 1000});
    assert_non_null(strstr(e.reason, "too small"));
    assert_true(e.low == 0 && e.high > 1e-4);
}

/* one bound for all: nothing fails, and the value goes on falling */
static double limit_never(const limit_state *l, const double *u) {
    return l->b - fw_maths_normal_cdf(u[0]) - 1e-3 * fw_maths_normal_cdf(u[1]);
}

/* A device far from its limit with few evaluations: subset simulation ends before any point fails. Where there is a design
   point it is taken; the interval holds, is narrow, and is never wider than what the first 400 points alone say. */
static void far(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double (*g)(const limit_state *l, const double *u), (*reference)(double b);
        size_t dimensions, budget;
        double b;
    } of[] = {
        {"plane, 1, 5 sd", limit_linear, reference_linear, 1, 4000, 5},
        {"plane, 1, 6 sd", limit_linear, reference_linear, 1, 4000, 6},
        {"plane, 1, 6 sd", limit_linear, reference_linear, 1, 3000, 6},
        {"plane, 1, 7 sd", limit_linear, reference_linear, 1, 4000, 7},
        {"plane, 1, 12 sd", limit_linear, reference_linear, 1, 4000, 12},
        {"plane, 10, 5.5 sd", limit_linear, reference_linear, 10, 4000, 5.5},
        {"plane, 10, 8 sd", limit_linear, reference_linear, 10, 4000, 8},
        {"two sides, 6 sd", limit_sides, reference_sides, 2, 4000, 6},
        {"two sides, 6.8 sd", limit_sides, reference_sides, 2, 4000, 6.8},
        {"parabola, 13", limit_parabola, reference_parabola, 2, 4000, 13},
        {"parabola, 20", limit_parabola, reference_parabola, 2, 4000, 20},
    };
    const double first = -expm1(log(0.025) / 300);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        limit_state l = {of[i].name, of[i].dimensions, of[i].g, of[i].b,
                         0,          of[i].reference,  NULL,    0};
        double width, truth = of[i].reference(of[i].b);
        limit_coverage(&l, (fw_chance_options){.budget = of[i].budget},
                       test_fewest(test_cases(1000, 20), 1), &width);
        if (truth > 1e-12) assert_true(width < 1);
        for (uint64_t seed = 1; seed <= 5; seed++) {
            fw_chance_estimate e =
                limit_estimate(&l, (fw_chance_options){.seed = seed, .budget = of[i].budget});
            assert_int_equal(e.method, FW_CHANCE_IMPORTANCE);
            assert_true(e.high < first && e.high <= fmax(1e-12, 4 * truth));
            if (truth < 1e-14) assert_true(e.low == 0 && e.high >= 1e-12); /* no tail is known */
        }
    }
}

/* none fails: 0, and what subset simulation reached is an upper end, that of the first points at most */
static void unmet(void **state) {
    (void)state;
    limit_state l = {.name = "never", .dimensions = 2, .g = limit_never, .b = 1.1};
    for (uint64_t seed = 1; seed <= 5; seed++) {
        fw_chance_estimate e =
            limit_estimate(&l, (fw_chance_options){.seed = seed, .budget = 4000});
        assert_int_equal(e.method, FW_CHANCE_SUBSET);
        assert_true(e.probability_low == 0 && e.probability_high == 0 && e.low == 0);
        assert_true(e.high > 1e-9 && e.high < 1e-3);
        assert_non_null(strstr(e.caution, "no failure was met"));
    }
    /* by subset simulation alone, with an end that its levels come just not to: the upper end holds */
    limit_state plane = {.name = "plane, 10, short",
                         .dimensions = 10,
                         .g = limit_linear,
                         .b = 6,
                         .reference = reference_linear};
    for (size_t budget = 600; budget <= 2400; budget *= 2)
        for (double beta = 3.5; beta < 6; beta += 0.5) {
            double width;
            plane.b = beta;
            limit_coverage(&plane,
                           (fw_chance_options){.method = FW_CHANCE_SUBSET, .budget = budget},
                           test_fewest(test_cases(1000, 40), 1), &width);
        }
}

/* both branches' points are found, and the shares of two inputs that are unequal */
static void points(void **state) {
    (void)state;
    fw_chance_estimate e = limit_estimate(&limit_states[8], (fw_chance_options){.seed = 2});
    assert_int_equal(e.points, 2);
    assert_near(e.point[0].beta, 4, 0.01);
    assert_near(e.point[1].beta, 4.3, 0.01);
    assert_near(e.point[0].alpha[0], -1, 1e-3);
    assert_near(e.point[1].alpha[0], 1, 1e-3);
}

typedef struct shared { /* a machine that has a share of what chooses nothing */
    const limit_state *l;
    int share, of;
    size_t asked, judged;
    double places; /* of all points that were asked for, in their order */
} shared;

static fw_status judge(shared *s, size_t first, size_t count, const double *u, double *value,
                       int share) {
    for (size_t i = 0; i < count; i++) {
        const double *at = u + i * s->l->dimensions;
        bool own = share < 0 || (first + i) % (size_t)s->of == (size_t)share;
        value[i] = own ? s->l->g(s->l, at) : 1;
        s->judged += own;
        for (size_t d = 0; d < s->l->dimensions; d++)
            s->places = 0.5 * s->places + at[d] * (double)(1 + (first + i + d) % 7);
    }
    s->asked += count;
    return FW_OK;
}

static fw_status chooses(void *context, size_t first, size_t n, const double *u, double *value) {
    return judge(context, first, n, u, value, -1);
}

static fw_status shares(void *context, size_t first, size_t n, const double *u, double *value) {
    return judge(context, first, n, u, value, ((shared *)context)->share);
}

/* whoever judges only a share of the points that choose nothing asks for the same points in the same order */
static void apart(void **state) {
    (void)state;
    static const size_t which[] = {0, 1, 9};
    for (size_t k = 0; k < 3; k++) {
        const limit_state *l = &limit_states[which[k]];
        fw_chance_options o = {.method = FW_CHANCE_AUTO, .seed = 2, .budget = 20000};
        fw_chance_estimate e;
        const char *why;
        shared whole = {.l = l, .of = 1}, half = {.l = l, .share = 1, .of = 2};
        fw_chance_limit one = {.dimensions = l->dimensions, .g = chooses, .context = &whole};
        fw_chance_limit part = {
            .dimensions = l->dimensions, .g = chooses, .context = &half, .apart = shares};
        assert_int_equal(fw_chance_estimate_run(arena, &one, &o, &e, &why), FW_OK);
        fw_status status = fw_chance_estimate_run(arena, &part, &o, &e, &why);
        assert_int_equal(status, k == 2 ? FW_LIMIT : FW_OK);
        if (k == 2) continue; /* subset simulation */
        assert_int_equal(half.asked, whole.asked);
        assert_true(half.places == whole.places);
        assert_true((double)half.judged < (k == 1 ? 0.6 : 0.8) * (double)whole.judged);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms), cmocka_unit_test(correlated), cmocka_unit_test(lognormal),
        cmocka_unit_test(both_sides),   cmocka_unit_test(reasons),    cmocka_unit_test(points),
        cmocka_unit_test(far),          cmocka_unit_test(unmet),      cmocka_unit_test(apart)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
