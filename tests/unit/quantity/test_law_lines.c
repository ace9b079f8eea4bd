/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The random law: its formula, its derivatives, its mean square, its largest value, and the phases
   that every machine must find the same. */
#include "quantity/law_kind.h"
#include "quantity/quantity_law.h"
#include "test.h"

static const double pi = 3.14159265358979323846;

static fw_quantity_law noise(double f0, double f1, int lines, unsigned seed) {
    return (fw_quantity_law){.kind = &fw_quantity_law_random,
                             .frequency_Hz = f0,
                             .frequency_most_Hz = f1,
                             .lines = lines,
                             .seed = seed};
}

static double at(const fw_quantity_law *law, double t_s) {
    double v[3];
    fw_quantity_law_value(law, t_s, t_s, v);
    return v[0];
}

/* one line at 0 Hz stands still at sqrt(2) cos(2 pi u): phases as written down from a generator of
   its own (Python's whole numbers) */
static void phases(void **state) {
    (void)state;
    static const struct {
        unsigned seed;
        double turns[3];
    } known[] = {{0u, {0.6524484863740322, 0.7012121095215252, 0.3871241409757855}},
                 {1u, {0.36818951565166946, 0.9435642308648544, 0.04525699773739167}},
                 {2u, {0.3922164624235318, 0.08471148009289708, 0.842210508356803}},
                 {4294967295u, {0.9105708636842669, 0.6940376761053388, 0.1308318376391625}}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const fw_quantity_law one = noise(0, 0, 1, known[i].seed);
        assert_near(at(&one, 7), sqrt(2) * cos(2 * pi * known[i].turns[0]), 1e-14);
        const fw_quantity_law three = noise(1, 3, 3, known[i].seed);
        for (double t = 0; t < 3; t += 0.171) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += cos(2 * pi * ((k + 1) * t + known[i].turns[k]));
            assert_near(at(&three, t), sqrt(2.0 / 3) * sum, 1e-13);
        }
    }
}

static void derivatives(void **state) {
    (void)state;
    for (unsigned seed = 1; seed < 40; seed++) {
        const fw_quantity_law law = noise(3 * seed, 50 + 7 * seed, 1 + (int)seed % 33, seed);
        double t = 0.013 * seed, h = 1e-4 / law.frequency_most_Hz,
               w = 2 * pi * law.frequency_most_Hz;
        double v[3], before[3], behind[3];
        fw_quantity_law_value(&law, t, t, v);
        fw_quantity_law_value(&law, t - h, t, before);
        fw_quantity_law_value(&law, t + h, t, behind);
        assert_near((behind[0] - before[0]) / (2 * h), v[1], 2e-7 * 8 * w);
        assert_near((behind[1] - before[1]) / (2 * h), v[2], 2e-7 * 8 * w * w);
    }
}

/* whole periods of every line: the mean square is 1 but for round-off. A window that cuts them: the
   cross terms of lines delta apart are at most 1/(pi delta T) each */
static void mean_square(void **state) {
    (void)state;
    double worst = 0;
    for (unsigned seed = 0; seed < 20; seed++) {
        const fw_quantity_law law = noise(100, 100 + 31 * 4, 32, seed);
        enum { SAMPLES = 500 };
        double sum = 0;
        for (int i = 0; i < SAMPLES; i++) /* 0.25 s: 25 to 56 periods, apart by 1 each */
            sum += pow(at(&law, 0.25 * i / SAMPLES), 2) / SAMPLES;
        assert_near(sum, 1, 1e-9);
        if (seed >= 6) continue; /* the long window is dear */
        const fw_quantity_law broken = noise(97.3, 231.7, 32, seed);
        double long_s = 41.7;
        sum = 0;
        for (int i = 0; i < 40000; i++)
            sum += pow(at(&broken, long_s * (i + 0.5) / 40000), 2) / 40000;
        worst = fmax(worst, fabs(sum - 1));
    }
    assert_true(worst < 0.02);
}

/* other seeds are other noise: their correlation over whole periods is that of random phases,
   1/sqrt(2 n) or so, also of neighbours */
static void seeds_differ(void **state) {
    (void)state;
    for (unsigned seed = 0; seed < 30; seed++) {
        const fw_quantity_law a = noise(10, 41, 32, seed), b = noise(10, 41, 32, seed + 1);
        double sum = 0;
        for (int i = 0; i < 500; i++)
            sum += at(&a, i / 500.0) * at(&b, i / 500.0) / 500;
        assert_true(fabs(sum) < 0.6);
    }
}

/* an upper bound, and not far above what really comes: short scenes 2 %, long ones the envelope */
static void largest(void **state) {
    (void)state;
    static const struct {
        double f0, f1, end_s;
        int lines;
        double slack;
    } scene[] = {{10, 100, 0.2, 32, 1.02}, {10, 100, 3, 32, 1.02},    {0, 50, 1, 7, 1.02},
                 {200, 300, 40, 32, 1.06}, {1000, 1100, 5, 64, 1.06}, {5, 80, 100, 32, 1.35},
                 {40, 40, 2, 1, 1.02},     {1, 1e4, 1e-3, 100, 1.02}};
    for (size_t i = 0; i < sizeof scene / sizeof scene[0]; i++)
        for (unsigned seed = 1; seed <= (unsigned)test_cases(4, 1); seed++) {
            const fw_quantity_law law = noise(scene[i].f0, scene[i].f1, scene[i].lines, seed);
            double bound = fw_quantity_law_largest(&law, scene[i].end_s), seen = 0;
            int looks = (int)(scene[i].end_s * scene[i].f1 * 20) + 50;
            for (int k = 0; k <= looks; k++)
                seen = fmax(seen, fabs(at(&law, scene[i].end_s * k / looks)));
            if (seen > bound) fail_msg("scene %zu seed %u: %g above %g", i, seed, seen, bound);
            if (bound > scene[i].slack * seen * 1.013) /* 20 looks per period miss 1.2 % */
                fail_msg("scene %zu seed %u: %g for %g", i, seed, bound, seen);
            assert_true(bound <= sqrt(2.0 * scene[i].lines) * (1 + 1e-15));
        }
    const fw_quantity_law endless = noise(1, 2, 4, 1);
    assert_true(fw_quantity_law_largest(&endless, (double)INFINITY) <= sqrt(8) * (1 + 1e-15));
    assert_true(fw_quantity_law_largest(&endless, 0) >= fabs(at(&endless, 0)));
}

static void no_breaks(void **state) {
    (void)state;
    const fw_quantity_law law = noise(10, 100, 32, 1);
    assert_int_equal(fw_quantity_law_breaks_of(&law, 10, NULL, 0), 0);
    assert_false(fw_quantity_law_is_constant(&law));
    assert_string_equal(fw_quantity_law_name(&law), "random");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phases),      cmocka_unit_test(derivatives),
        cmocka_unit_test(mean_square), cmocka_unit_test(seeds_differ),
        cmocka_unit_test(largest),     cmocka_unit_test(no_breaks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
