/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tolerances by the accuracy that is wanted. The statistics over random devices are in
   tests/accuracy. */
#include "models.h"

static const fw_dynamics_motion *run(fw_arena *arena, const rig *r,
                                     const fw_dynamics_motion_options *options) {
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, options, &diags, &motion);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    return motion;
}

static double size_of(const fw_dynamics_motion *m) {
    double most = 0;
    for (int i = 0; i < m->npin; i++)
        most = fmax(most, fabs(m->peak[i].angle_rad));
    return most;
}

/* against GSL's Runge-Kutta method of order 8 at 1e-13 */
static void test_errors_are_below(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double accuracy[] = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10};
    for (uint64_t seed = 0; seed < 8; seed++) {
        const rig r = seed == 0 ? rig_six_bar(arena, false) : rig_any(arena, seed);
        const fw_dynamics_motion *truth =
            run(arena, &r, &(fw_dynamics_motion_options){.integrator = "gsl-rk8pd", .rtol = 1e-13});
        long rhs[6];
        double rtol[6];
        for (int k = 0; k < 6; k++) {
            const fw_dynamics_motion *m =
                run(arena, &r, &(fw_dynamics_motion_options){.accuracy = accuracy[k]});
            double size = size_of(truth);
            for (int i = 0; i < m->npin; i++) {
                double off = fabs(fabs(m->peak[i].angle_rad) - fabs(truth->peak[i].angle_rad));
                assert_true(off <= m->peak[i].error_rad + truth->peak[i].error_rad);
                assert_true(off < accuracy[k] * size);
                assert_true(m->peak[i].error_rad <= accuracy[k] * size_of(m));
            }
            /* where a first try was not enough the next digit may have been paid for */
            rtol[k] = m->stats.rtol, rhs[k] = m->stats.rhs;
            if (k >= 2) assert_true(rtol[k] < rtol[k - 2] && rhs[k] > rhs[k - 2]);
        }
    }
    fw_arena_free(arena);
}

/* the six-bar at the usual accuracy takes fewer evaluations, those for the estimate included, than
   at the tolerances 1e-7 and 1e-5, and counts all of them */
static void test_no_more_than_asked_for(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const rig r = rig_six_bar(arena, false);
    const fw_dynamics_motion *m = run(arena, &r, &(fw_dynamics_motion_options){0});
    const fw_dynamics_motion *fixed = run(arena, &r, &(fw_dynamics_motion_options){.rtol = 1e-7});
    print_message("  rtol %.2g and %.2g, %ld of %ld evaluations; %ld of %ld at 1e-7\n",
                  m->stats.rtol, m->stats.looser_rtol, m->stats.rhs, m->stats.all_rhs,
                  fixed->stats.rhs, fixed->stats.all_rhs);
    assert_int_equal(m->stats.runs, 2);
    assert_true(m->stats.rtol > 1e-6 && m->stats.looser_rtol > m->stats.rtol);
    assert_true(10 * m->stats.all_rhs < 9 * fixed->stats.all_rhs);
    assert_true(m->stats.all_rhs > m->stats.rhs && m->stats.all_steps > m->stats.steps);
    fw_arena_free(arena);
}

/* without an estimate: one run, the same answer, and nothing is said of its error */
static void test_without_an_estimate(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const rig r = rig_six_bar(arena, false);
    const fw_dynamics_motion_options both = {.rtol = 1e-7, .reactions = true};
    fw_dynamics_motion_options one = both;
    one.looser = 1;
    const fw_dynamics_motion *a = run(arena, &r, &both), *b = run(arena, &r, &one);
    assert_int_equal(a->stats.runs, 2);
    assert_int_equal(b->stats.runs, 1);
    assert_int_equal(b->stats.rhs, b->stats.all_rhs);
    assert_int_equal(a->stats.rhs, b->stats.rhs);
    for (int i = 0; i < a->npin; i++) {
        assert_true(a->peak[i].angle_rad == b->peak[i].angle_rad);
        assert_true(a->force_peak[i].force_N == b->force_peak[i].force_N);
        assert_true(isfinite(a->peak[i].error_rad) && isinf(b->peak[i].error_rad));
    }
    fw_arena_free(arena);
}

/* what cannot be had is said: the tightest tolerance is used and the estimate is above */
static void test_what_cannot_be_reached(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    const fw_dynamics_motion *m = NULL;
    const fw_dynamics_motion_options o = {.accuracy = 1e-16};
    assert_int_equal(fw_dynamics_simulate(arena, &r.m, &r.scene, &o, &diags, &m), FW_OK);
    assert_true(m->stats.rtol <= 1e-13);
    assert_true(m->peak[0].error_rad > 1e-16 * size_of(m));
    fw_arena_free(arena);
}

/* effects that are left out take their share: what the numbers may be off by is the rest */
static void test_effects_take_their_share(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_six_bar(arena, false);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -1e-3;
    r.scene.force[0].fx_N *= 0.01,
        r.scene.force[0].fy_N *= 0.01; /* the bounds are of small motion */
    r.scene.torque[0].value_Nm *= 0.01;
    const fw_dynamics_motion *all =
        run(arena, &r,
            &(fw_dynamics_motion_options){.accuracy = 1e-9, .effects = {.mode = FW_EFFECTS_ALL}});
    bool left = false;
    for (double accuracy = 1e-2; accuracy > 1e-7; accuracy /= 1.7) {
        const fw_dynamics_motion *m =
            run(arena, &r, &(fw_dynamics_motion_options){.accuracy = accuracy});
        left = left || m->ledger.left_out > 0.2 * accuracy;
        double error = 0;
        for (int i = 0; i < m->npin; i++) {
            error = fmax(error, m->peak[i].error_rad);
            assert_true(fabs(fabs(m->peak[i].angle_rad) - fabs(all->peak[i].angle_rad)) <=
                        m->peak[i].error_rad + all->peak[i].error_rad);
        }
        double beyond = fmax(0, m->ledger.left_out - 0.95 * accuracy);
        assert_true(error <= 1.03 * (accuracy + beyond) * size_of(m));
    }
    assert_true(left); /* else it was not tested */
    fw_arena_free(arena);
}

/* ---- a motion much like this one says where to begin ---- */

static void see_largest(void *context, const fw_dynamics_instant *now) {
    double *most = context;
    if (!now) *most = 0;
    for (int i = 0; now && i < 4; i++)
        *most = fmax(*most, fabs(now->angle_rad[i]));
}

/* the largest angle, a hundred times closer than peaks are wanted */
static double unsettled(const void *tighter, const void *looser, double margin, double accuracy) {
    const double a = *(const double *)tighter, b = *(const double *)looser;
    return margin * fabs(a - b) / (1e-2 * accuracy * a);
}

static void test_begins_where_another_ended(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    long runs[2] = {0}, rhs[2] = {0};
    for (uint64_t seed = 0; seed < 14; seed++) {
        const rig r = seed == 0 ? rig_six_bar(arena, false) : rig_any(arena, seed);
        if (r.m.npin < 4) continue;
        double saw[4];
        fw_dynamics_motion_options o = {.accuracy = 1e-3,
                                        .observe = see_largest,
                                        .unsettled = unsettled,
                                        .context = &saw[0],
                                        .other = &saw[1]};
        const fw_dynamics_motion *first = run(arena, &r, &o);
        assert_true(first->stats.needed_rtol > 0);
        o.like = first, o.context = &saw[2], o.other = &saw[3];
        const fw_dynamics_motion *then = run(arena, &r, &o);
        runs[0] += first->stats.runs, runs[1] += then->stats.runs;
        rhs[0] += first->stats.all_rhs, rhs[1] += then->stats.all_rhs;
        for (int i = 0; i < r.m.npin; i++) /* as good as asked for, whatever was left out */
            assert_true(fabs(fabs(then->peak[i].angle_rad) - fabs(first->peak[i].angle_rad)) <=
                        then->peak[i].error_rad + first->peak[i].error_rad);
        assert_true(unsettled(&saw[2], &saw[3], then->stats.estimate_margin, 1e-3) <= 1);
    }
    print_message("  %ld runs and %ld evaluations, then %ld and %ld\n", runs[0], rhs[0], runs[1],
                  rhs[1]);
    assert_true(runs[1] < runs[0] && rhs[1] < rhs[0]);
    fw_arena_free(arena);
}

/* as a strain that a stiff hinge makes of forces: after the first two runs 400 times what was wanted, then near enough */
static int looks;
static double far_off_at_first(const void *tighter, const void *looser, double margin,
                               double accuracy) {
    (void)tighter, (void)looser, (void)margin, (void)accuracy;
    return looks++ == 0 ? 400 : 0.5;
}

/* who does not see errors pays for no smaller ones than were wanted: the answer so far is the looser run of the next */
static void test_no_tighter_than_needed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const rig r = rig_six_bar(arena, false);
    const fw_dynamics_motion *m[2];
    for (int k = 0; k < 2; k++) {
        double saw[2];
        looks = 0;
        m[k] = run(arena, &r,
                   &(fw_dynamics_motion_options){.accuracy = 1e-3,
                                                 .observe = see_largest,
                                                 .unsettled = far_off_at_first,
                                                 .sparing = k == 1,
                                                 .context = &saw[0],
                                                 .other = &saw[1]});
        assert_int_equal(looks, 2);
    }
    print_message("  rtol %.2g in %d runs, sparing %.2g in %d\n", m[0]->stats.rtol,
                  m[0]->stats.runs, m[1]->stats.rtol, m[1]->stats.runs);
    assert_int_equal(m[0]->stats.runs, 4);
    assert_int_equal(m[1]->stats.runs, 3);
    assert_true(m[1]->stats.rtol > 5 * m[0]->stats.rtol);
    assert_true(m[1]->stats.all_rhs < m[0]->stats.all_rhs);
    for (int i = 0; i < r.m.npin; i++)
        assert_true(fabs(fabs(m[1]->peak[i].angle_rad) - fabs(m[0]->peak[i].angle_rad)) <=
                    m[1]->peak[i].error_rad + m[0]->peak[i].error_rad);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors_are_below),
        cmocka_unit_test(test_no_more_than_asked_for),
        cmocka_unit_test(test_without_an_estimate),
        cmocka_unit_test(test_what_cannot_be_reached),
        cmocka_unit_test(test_effects_take_their_share),
        cmocka_unit_test(test_begins_where_another_ended),
        cmocka_unit_test(test_no_tighter_than_needed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
