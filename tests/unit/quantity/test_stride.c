/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strides of laws: whatever step sequence they allow must see a pulse wherever it lies, and must
   not be held up by laws that change slowly. */
#include "quantity/law_kind.h"
#include "quantity/quantity_law.h"
#include "test.h"

static const double pi = 3.14159265358979323846, scene_s = 10;

static fw_arena *arena;
static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_quantity_law expression(const char *text) {
    static const fw_quantity_names none = {NULL, 0};
    fw_quantity_expression_error error;
    fw_quantity_program *p;
    if (fw_quantity_program_compile(arena, text, strlen(text), &none, (fw_quantity_dimension){0},
                                    &p, &error) != FW_OK)
        fail_msg("%s: %s", text, error.message);
    return (fw_quantity_law){.kind = &fw_quantity_law_expression, .program = p};
}

static fw_quantity_law_strides look_at(const fw_quantity_law *law, bool coordinate) {
    double at[1000];
    int breaks = fw_quantity_law_breaks_of(law, scene_s, at, 1000);
    fw_quantity_law_strides strides;
    assert_int_equal(fw_quantity_law_look(arena, law, coordinate, scene_s, at, breaks, &strides),
                     FW_OK);
    for (int i = 0; i < strides.n; i++) {
        assert_true(strides.most_s[i] > 0);
        assert_true(i == 0 || strides.t_s[i] > strides.t_s[i - 1]);
    }
    return strides;
}

/* the longest steps allowed, from `first` on; how many there are, and how many end where the bell
   at `centre` of width w is above 0.1 */
typedef struct walk {
    int steps, hits;
} walk;
static walk longest_steps(const fw_quantity_law_strides *strides, double factor, double first,
                          double centre, double w) {
    walk out = {0};
    int row = 0;
    for (double t = first; t < scene_s && out.steps < 1000000; out.steps++) {
        double h = fw_quantity_law_stride(strides, factor, t, &row);
        assert_true(h > 0);
        t += h;
        if (fabs(t - centre) < 1.52 * w) out.hits++;
    }
    return out;
}

/* bells from 0.1 ms to 3 s in 10 s, on nothing and on a constant, as loads and as coordinates: both
   runs (factor 1 and 1.5) step into each of them, wherever they come from, at few places besides */
static void bells(void **state) {
    (void)state;
    const double width[] = {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1, 3};
    uint64_t seed = 11;
    for (size_t i = 0; i < 10 * sizeof width / sizeof width[0]; i++) {
        double w = width[i / 10];
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        double centre = scene_s * (0.02 + 0.96 * (double)(seed >> 11) / 9007199254740992.0);
        for (int ground = 0; ground <= (w >= 1e-3); ground++) {
            const fw_quantity_law law = expression(fw_arena_printf(
                arena, "%d + exp(-((t - %.17g s)/(%.17g s))^2)", ground, centre, w));
            for (int coordinate = 0; coordinate <= 1; coordinate++) {
                const fw_quantity_law_strides strides = look_at(&law, coordinate);
                for (int run = 0; run < 8 && w <= 0.3; run++) {
                    double factor = run % 2 ? 1.5 : 1, first = (centre - 2 * w) * run / 8;
                    walk out = longest_steps(&strides, factor, first, centre, w);
                    if (out.hits < 1 || out.steps > 60)
                        fail_msg("w %g at %g, ground %d, coordinate %d, run %d: %d hits, %d steps",
                                 w, centre, ground, coordinate, run, out.hits, out.steps);
                }
                assert_true(longest_steps(&strides, 1, 0, centre, w).steps <= 60);
            }
        }
    }
}

/* a bell beside much larger things, as long as it lasts for a few looks */
static void beside_a_ramp(void **state) {
    (void)state;
    const fw_quantity_law law = expression("t/(1 s) + 3*exp(-((t - 7.0011 s)/(10 ms))^2)");
    const fw_quantity_law_strides strides = look_at(&law, false);
    assert_true(longest_steps(&strides, 1, 0, 7.0011, 10e-3).hits >= 1);
    const fw_quantity_law moved =
        expression("sin(t/(1 s)) + 1e-3*exp(-((t - 7.0011 s)/(10 ms))^2)");
    const fw_quantity_law_strides as_load = look_at(&moved, false),
                                  as_driver = look_at(&moved, true);
    assert_int_equal(longest_steps(&as_load, 1.5, 0, 7.0011, 10e-3).hits, 0); /* a thousandth */
    assert_true(longest_steps(&as_driver, 1.5, 0, 7.0011, 10e-3).hits >= 1);  /* 20 g */
}

/* ramps, decays and slow waves are stepped over as before; constants are not even looked at */
static void slow_laws(void **state) {
    (void)state;
    const struct {
        const char *text;
        int steps;
    } slow[] = {
        {"5", 1},
        {"t/(1 s)", 1},
        {"1 + 1e-9*t/(1 s)", 1},
        {"1e6 + t/(1 s)", 1},
        {"exp(-t/(10 s))", 1},
        {"exp(-t/(3 s))", 3},
        {"1 - exp(-t/(1 s))", 6},
        {"sqrt(t/(1 s))", 8},
        {"(t/(1 s))^3", 3},
        {"max(0, min(1, t/(1 s) - 3))", 1},
        {"abs(t/(1 s) - 3)", 1},
        {"sin(2*pi*t/(10 s))", 4},
        {"1/(1 + exp(-(t - 5 s)/(10 ms)))", 12},
    };
    for (size_t i = 0; i < sizeof slow / sizeof slow[0]; i++) {
        const fw_quantity_law law = expression(slow[i].text);
        for (int coordinate = 0; coordinate <= 1; coordinate++) {
            const fw_quantity_law_strides strides = look_at(&law, coordinate);
            walk out = longest_steps(&strides, 1, 0, 0, 0);
            if (out.steps > slow[i].steps)
                fail_msg("%s: %d steps, coordinate %d", slow[i].text, out.steps, coordinate);
        }
    }
    const fw_quantity_law constant = expression("2 + 3");
    assert_int_equal(look_at(&constant, false).n, 0);
}

/* waves get some three steps per period, as laws of their own and as expressions, also when every
   look falls on a node (204.8 Hz times whole numbers) and when there are more periods than looks */
static void waves(void **state) {
    (void)state;
    const double frequency[] = {0.3, 1, 7, 90, 204.8, 1000, 20480, 33333};
    for (size_t i = 0; i < sizeof frequency / sizeof frequency[0]; i++) {
        const fw_quantity_law own = {
            .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = frequency[i]};
        const fw_quantity_law written =
            expression(fw_arena_printf(arena, "sin(2*pi*t*%.17g Hz)", frequency[i]));
        double periods = frequency[i] * scene_s;
        for (int k = 0; k < 3; k++) {
            const fw_quantity_law_strides strides = look_at(k ? &written : &own, k == 2);
            walk out = longest_steps(&strides, 1, 0, 0, 0);
            if (out.steps < 2.4 * periods || out.steps > 6 * periods + 1)
                fail_msg("%g Hz, way %d: %d steps for %g periods", frequency[i], k, out.steps,
                         periods);
        }
    }
    const fw_quantity_law part = {.kind = &fw_quantity_law_sine,
                                  .start_s = 2,
                                  .end_s = 3,
                                  .frequency_Hz = 100,
                                  .phase_rad = pi / 3};
    const fw_quantity_law_strides strides = look_at(&part, false);
    int row = 0;
    double h = 2.1 / (2 * pi * 100);
    assert_near(fw_quantity_law_stride(&strides, 1, 0, &row), 2 + h, 1e-12);
    assert_near(fw_quantity_law_stride(&strides, 1.5, 2.5, &row), 1.5 * h, 1e-12);
    assert_true(isinf(fw_quantity_law_stride(&strides, 1, 3, &row)));
    assert_near(fw_quantity_law_stride(&strides, 1, 1, &row), 1 + h, 1e-12); /* back again */
}

/* a half sine gets a step inside and none around it; random loads some three per period of their
   fastest line */
static void shocks_and_noise(void **state) {
    (void)state;
    const fw_quantity_law shock = {
        .kind = &fw_quantity_law_half_sine, .start_s = 2, .rise_s = 1e-3};
    const fw_quantity_law_strides strides = look_at(&shock, false);
    int row = 0;
    double h = 2.1 / pi * 1e-3;
    assert_near(fw_quantity_law_stride(&strides, 1, 0, &row), 2 + h, 1e-12);
    assert_near(fw_quantity_law_stride(&strides, 1, 2, &row), h, 1e-12);
    assert_true(isinf(fw_quantity_law_stride(&strides, 1, 2.001, &row)));
    const fw_quantity_law noise = {.kind = &fw_quantity_law_random,
                                   .frequency_Hz = 20,
                                   .frequency_most_Hz = 200,
                                   .lines = 32,
                                   .seed = 1};
    const fw_quantity_law_strides fine = look_at(&noise, false);
    row = 0;
    for (double t = 0; t < scene_s; t += 0.37)
        assert_near(fw_quantity_law_stride(&fine, 1, t, &row), 2.1 / (2 * pi * 200), 1e-15);
}

/* steps, ramps and tables are straight between their breaks */
static void straight_laws(void **state) {
    (void)state;
    const double t[] = {0, 1, 1.001}, value[] = {0, 1, 0};
    const fw_quantity_law laws[] = {
        {.kind = &fw_quantity_law_step, .start_s = 1, .end_s = 1.001},
        {.kind = &fw_quantity_law_ramp, .start_s = 1, .rise_s = 1e-3},
        {.kind = &fw_quantity_law_table, .table_t_s = t, .table_value = value, .ntable = 3},
    };
    for (int i = 0; i < 3; i++)
        assert_int_equal(look_at(&laws[i], false).n, 0);
    fw_quantity_law_strides none;
    int row = 0;
    assert_int_equal(fw_quantity_law_look(arena, NULL, false, 1, NULL, 0, &none), FW_OK);
    assert_true(isinf(fw_quantity_law_stride(&none, 1, 0, &row)));
}

/* poles, infinite slopes and jumps that hide between the looks end, and limit something finite */
static void wild_laws(void **state) {
    (void)state;
    const char *const text[] = {"1 s/(t - 5 s)",
                                "1e-300*exp(t*70/(1 s))",
                                "exp(t*700/(1 s))",
                                "sqrt(t/(1 s) - 5)",
                                "tan(t/(1 s))",
                                "(t/(1 s))^0.1",
                                "sin(1 s/(t + 1e-6 s))",
                                "abs(sin(2e3*t/(1 s)))",
                                "atan2(sin(t*20 rad/s), cos(t*20 rad/s))/(1 rad)"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        const fw_quantity_law law = expression(text[i]);
        for (int coordinate = 0; coordinate <= 1; coordinate++) {
            const fw_quantity_law_strides strides = look_at(&law, coordinate);
            assert_true(strides.n <= 1024);
            walk out = longest_steps(&strides, 1, 0, 0, 0);
            if (out.steps > 30000)
                fail_msg("%s: %d steps, coordinate %d", text[i], out.steps, coordinate);
        }
    }
}

static void memory(void **state) {
    (void)state;
    const fw_quantity_law law = expression("exp(-((t - 5 s)/(1 ms))^2)");
    fw_status status = FW_NOMEM;
    long tries = 1;
    for (; status == FW_NOMEM && tries < 50; tries++) {
        fw_arena *small = fw_arena_new(0);
        fw_quantity_law_strides strides;
        fw_arena_fail_at(tries, 0);
        status = fw_quantity_law_look(small, &law, false, scene_s, NULL, 0, &strides);
        fw_arena_fail_at(0, 0);
        fw_arena_free(small);
    }
    assert_int_equal(status, FW_OK);
    assert_true(tries > 3);
}

static void ratios(void **state) {
    (void)state;
    enum { MOST = 12, N = 3 };
    const fw_quantity_law first = expression("max(0, 1 - abs(t - 2 s)/(2 s))"),
                          second = expression("max(0, (t - 6 s)/(4 s))"),
                          half = expression("max(0, 0.5 - abs(t - 2 s)/(4 s))");
    const fw_quantity_law *law[N] = {&first, &half, NULL};
    double t_s[MOST], value[(MOST + 1) * N];
    bool all;
    /* one ratio, where it is largest */
    assert_int_equal(fw_quantity_law_ratios(law, 2, 10, MOST, t_s, value, &all), 1);
    assert_true(all);
    assert_float_equal(value[0], 1, 1e-6);
    assert_float_equal(value[1], 0.5, 1e-6);
    assert_float_equal(t_s[0], 2, 1e-6);
    /* one after the other: each by itself, at its largest */
    law[1] = &second;
    assert_int_equal(fw_quantity_law_ratios(law, 2, 10, MOST, t_s, value, &all), 2);
    for (int k = 0; k < 2; k++) {
        assert_float_equal(fmax(value[2 * k], value[2 * k + 1]), 1, 1e-6);
        assert_float_equal(fmin(value[2 * k], value[2 * k + 1]), 0, 1e-6);
    }
    /* beside what is always there it is another ratio at every instant; there are more than are asked for */
    const int n = fw_quantity_law_ratios(law, N, 10, 2, t_s, value, &all);
    assert_int_equal(n, 2);
    assert_false(all);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ratios),
        cmocka_unit_test(shocks_and_noise),
        cmocka_unit_test(bells),
        cmocka_unit_test(beside_a_ramp),
        cmocka_unit_test(slow_laws),
        cmocka_unit_test(waves),
        cmocka_unit_test(straight_laws),
        cmocka_unit_test(wild_laws),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
