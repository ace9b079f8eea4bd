/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks between the steps, and honesty of their error estimate: at every tolerance the estimate
   must not be below the distance from the peak of a far tighter run. */
#include "models.h"

static const fw_dynamics_motion *simulate(fw_arena *arena, fw_diags *diags, const rig *r,
                                          double rtol, int samples) {
    const fw_dynamics_motion *motion = NULL;
    const fw_dynamics_motion_options o = {.rtol = rtol, .samples = samples};
    assert_int_equal(fw_dynamics_simulate(arena, &r->m, &r->scene, &o, diags, &motion), FW_OK);
    return motion;
}

typedef struct tally {
    int cases, dishonest, moved;
    double worst_ratio, mean;
} tally;

static void honest(fw_arena *arena, fw_diags *diags, const rig *r, const double *rtol, int count,
                   tally *t) {
    const fw_dynamics_motion *truth = simulate(arena, diags, r, 1e-13, 0);
    for (int i = 0; i < count; i++) {
        const fw_dynamics_motion *m = simulate(arena, diags, r, rtol[i], 0);
        for (int p = 0; p < m->npin; p++) {
            /* extremes of both signs may joint: sizes count */
            double error = fabs(fabs(m->peak[p].angle_rad) - fabs(truth->peak[p].angle_rad));
            double known = truth->peak[p].error_rad; /* the truth's own uncertainty */
            assert_true(m->peak[p].error_rad >= 0);
            t->cases++;
            if (error > known + m->peak[p].error_rad) {
                t->dishonest++;
                print_message("  pin %d of %d rtol %g: error %.2e estimate %.2e\n", p, m->npin,
                              rtol[i], error, m->peak[p].error_rad);
            }
            double ratio = error / m->peak[p].error_rad;
            t->worst_ratio = fmax(t->worst_ratio, ratio);
            if (error > 1e-14) {
                t->mean += log10(ratio);
                t->moved++;
            }
        }
    }
}

static void test_six_bar_peaks(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    const double rtol[] = {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11};
    tally t = {0};
    honest(arena, &diags, &r, rtol, 7, &t);
    print_message(
        "six-bar: %d cases, %d dishonest, worst error/estimate %.2f, geometric mean %.3f\n",
        t.cases, t.dishonest, t.worst_ratio, pow(10, t.mean / t.moved));
    assert_int_equal(t.dishonest, 0);
    fw_arena_free(arena);
}

/* no sample of a fine grid may lie above the peak, and one must come close to it */
static void test_peak_is_the_extreme(void **state) {
    (void)state;
    for (uint64_t seed = 100; seed < 112; seed++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = seed == 100 ? rig_six_bar(arena, false) : rig_any(arena, seed);
        const fw_dynamics_motion *m = simulate(arena, &diags, &r, 1e-11, 20001);
        for (int p = 0; p < m->npin; p++) {
            double most = 0, at = 0;
            for (int i = 0; i < m->nsample; i++) {
                double angle = fabs(m->angle_rad[(size_t)i * (size_t)m->npin + (size_t)p]);
                if (angle > most) most = angle, at = m->t_s[i];
            }
            double peak = fabs(m->peak[p].angle_rad);
            assert_true(most <= peak + 1e-9);
            assert_near(most, peak, 1e-4 * peak);
            if (most < peak - 1e-6 * peak)
                assert_near(m->peak[p].t_s, at, 2e-2 * r.scene.duration_s);
        }
        fw_arena_free(arena);
    }
}

static void test_random_mechanisms(void **state) {
    (void)state;
    tally t = {0};
    const double rtol[] = {1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
    for (uint64_t seed = 1; seed <= (uint64_t)test_cases(120, 30); seed++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = rig_any(arena, seed);
        int before = t.dishonest;
        honest(arena, &diags, &r, rtol, 5, &t);
        if (t.dishonest > before) print_message("  seed %d\n", (int)seed);
        fw_arena_free(arena);
    }
    print_message(
        "random: %d cases, %d dishonest, worst error/estimate %.2f, geometric mean %.3f\n", t.cases,
        t.dishonest, t.worst_ratio, pow(10, t.mean / t.moved));
    assert_int_equal(t.dishonest, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_six_bar_peaks),
        cmocka_unit_test(test_peak_is_the_extreme),
        cmocka_unit_test(test_random_mechanisms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
