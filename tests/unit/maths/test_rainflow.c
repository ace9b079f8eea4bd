/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/functions.h"
#include "test.h"

static double counted(const fw_maths_cycle *c, size_t n, double range) {
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        if (fabs(c[i].range - range) < 1e-12) sum += c[i].count;
    return sum;
}

/* the example of ASTM E1049, fig. 6: A -2, B 1, C -3, D 5, E -1, F 3, G -4, H 4, I -2 */
static const double example[] = {-2, 1, -3, 5, -1, 3, -4, 4, -2};

static void astm_example(void **state) {
    (void)state;
    double work[9];
    fw_maths_cycle c[9];
    size_t n = fw_maths_rainflow(example, 9, work, c);
    static const double range[] = {3, 4, 6, 8, 9}, count[] = {0.5, 1.5, 0.5, 1.0, 0.5};
    double all = 0, expected = 0;
    for (int i = 0; i < 5; i++) {
        assert_near(counted(c, n, range[i]), count[i], 0);
        expected += count[i];
    }
    for (size_t i = 0; i < n; i++) {
        all += c[i].count;
        if (c[i].count == 1.0) { /* E-F is the one whole cycle: from -1 to 3 */
            assert_near(c[i].range, 4, 0);
            assert_near(c[i].mean, 1, 0);
        }
    }
    assert_near(all, expected, 0);
}

/* the same history over and over (5.4.5): it begins at D, and 9, 7, 4 and 3 are whole */
static void astm_example_repeating(void **state) {
    (void)state;
    double work[19];
    fw_maths_cycle c[10];
    size_t n = fw_maths_rainflow_repeating(example, 9, work, c);
    assert_int_equal(n, 4);
    static const double range[] = {3, 4, 7, 9}, mean[] = {-0.5, 1, 0.5, 0.5};
    for (int i = 0; i < 4; i++) {
        assert_near(counted(c, n, range[i]), 1, 0);
        for (size_t k = 0; k < n; k++)
            if (fabs(c[k].range - range[i]) < 1e-12) assert_near(c[k].mean, mean[i], 0);
    }
}

static double uniform(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

/* whatever the history: the largest range is that of its extremes; every rise and fall belongs to
   one cycle, so that the ranges add up to half of all ways; cutting elsewhere changes nothing */
static void identities_on_random_histories(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int round = 0; round < 200; round++) {
        double turn[61], other[61], work[200], most = -9, least = 9, way = 0, sum = 0, widest = 0;
        fw_maths_cycle c[62], d[62];
        size_t n = 4 + (size_t)(uniform(&seed) * 28) * 2;
        for (size_t i = 0; i < n; i++) {
            turn[i] = (i % 2 ? 1 : -1) * (0.01 + uniform(&seed));
            most = fmax(most, turn[i]);
            least = fmin(least, turn[i]);
        }
        for (size_t i = 0; i < n; i++) {
            way += fabs(turn[(i + 1) % n] - turn[i]);
            other[i] = turn[(i + 7) % n];
        }
        size_t count = fw_maths_rainflow_repeating(turn, n, work, c);
        assert_int_equal(count, n / 2);
        assert_int_equal(fw_maths_rainflow_repeating(other, n, work, d), count);
        double again = 0;
        for (size_t i = 0; i < count; i++) {
            assert_near(c[i].count, 1, 0);
            sum += c[i].range;
            widest = fmax(widest, c[i].range);
            again += pow(d[i].range, 5) * (2 + d[i].mean) - pow(c[i].range, 5) * (2 + c[i].mean);
        }
        assert_near(sum, 0.5 * way, 1e-12 * way);
        assert_near(widest, most - least, 1e-14);
        assert_near(again, 0, 1e-10);
    }
}

static void what_does_not_turn_has_no_cycles(void **state) {
    (void)state;
    double work[16];
    fw_maths_cycle c[8];
    static const double flat[] = {2, 2, 2}, pulse[] = {0, 3}, slope[] = {0, 1, 2, 5};
    assert_int_equal(fw_maths_rainflow_repeating(flat, 3, work, c), 0);
    assert_int_equal(fw_maths_rainflow_repeating(flat, 1, work, c), 0);
    assert_int_equal(fw_maths_rainflow_repeating(pulse, 2, work, c), 1);
    assert_near(c[0].range, 3, 0);
    assert_near(c[0].mean, 1.5, 0);
    assert_int_equal(fw_maths_rainflow_repeating(slope, 4, work, c), 1); /* up, and back at once */
    assert_near(c[0].range, 5, 0);
}

/* sine of growing amplitude, unevenly sampled, with a ripple below the gate on it */
static void turning_points_of_a_sine(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_maths_turning p = {.gate = 0.01};
    uint64_t seed = 5;
    double pi = acos(-1.0);
    for (double t = 0; t < 10 * 2 * pi; t += 0.05 + 0.1 * uniform(&seed))
        fw_maths_turning_add(&p, arena, t, (1 + 0.02 * t) * sin(t) + 0.002 * sin(71 * t));
    fw_maths_turning_end(&p, arena);
    assert_false(p.failed);
    assert_int_equal(p.count, 1 + 20 + 1); /* the start, twenty extremes, the end */
    for (size_t i = 1; i <= 20; i++) {
        double t = pi * ((double)i - 0.5);
        assert_near(p.value[i], (i % 2 ? 1 : -1) * (1 + 0.02 * t), 6e-3);
    }
    fw_arena_free(arena);
}

/* between samples the top of a smooth history is found to the third power of their spacing */
static void tops_between_samples(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double wrong[2];
    for (int fine = 0; fine < 2; fine++) {
        fw_maths_turning p = {.gate = 1e-3};
        double step = fine ? 0.1 : 0.2;
        wrong[fine] = 0;
        for (int i = 0; i * step < 40; i++)
            fw_maths_turning_add(&p, arena, i * step, sin(i * step));
        for (size_t i = 1; i < p.count; i++)
            wrong[fine] = fmax(wrong[fine], fabs(fabs(p.value[i]) - 1));
    }
    assert_true(wrong[0] < 2e-4);
    assert_true(wrong[1] < wrong[0] / 6);
    fw_arena_free(arena);
}

/* across a jump no parabola is laid, and the jump is a turn like any */
static void a_jump_is_a_turn(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_maths_turning p = {.gate = 1e-3};
    static const double s[] = {0, 1, 2, -1, 0, 1};
    for (int i = 0; i < 6; i++) {
        if (i == 3) fw_maths_turning_jump(&p);
        fw_maths_turning_add(&p, arena, i < 3 ? i : i - 1, s[i]);
    }
    fw_maths_turning_end(&p, arena);
    assert_int_equal(p.count, 4);
    static const double turn[] = {0, 2, -1, 1};
    for (int i = 0; i < 4; i++)
        assert_near(p.value[i], turn[i], 0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(astm_example),
        cmocka_unit_test(astm_example_repeating),
        cmocka_unit_test(identities_on_random_histories),
        cmocka_unit_test(what_does_not_turn_has_no_cycles),
        cmocka_unit_test(turning_points_of_a_sine),
        cmocka_unit_test(tops_between_samples),
        cmocka_unit_test(a_jump_is_a_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
