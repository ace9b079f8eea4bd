/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `auto`: which integrator, for loads that act at once, that come later, and for starting
   velocities; the choice is never far from the cheaper of the two. */
#include "quantity/law_kind.h"
#include "models.h"

static const fw_dynamics_motion *run_to(fw_arena *arena, const rig *r, const char *integrator,
                                        double accuracy) {
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {
        .integrator = integrator, .accuracy = accuracy, .effects = {.mode = FW_EFFECTS_ALL}};
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &motion);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    return motion;
}

static const fw_dynamics_motion *run(fw_arena *arena, const rig *r, const char *integrator) {
    return run_to(arena, r, integrator, 0);
}

/* two bars in a row, the second held by a spring and a damper that are `stiff` times the first */
static rig two_bars(fw_arena *arena, double stiff) {
    rig r = rig_new(arena, 2, 2, 0);
    rig_body(&r, "a", 1e-6, 1e-12, 1e-3, 0, 0);
    rig_body(&r, "b", 1e-6, 1e-12, 3e-3, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 1e-6, 1e-10);
    rig_pin(&r, "P", 0, 1, 2e-3, 0, 1e-6 * stiff, 1e-11 * stiff);
    r.scene.duration_s = 0.1;
    return r;
}

static void test_stiff_scenes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 5e-3};
    for (int kind = 0; kind < 3; kind++) {
        rig r = two_bars(arena, 1e6);
        if (kind < 2) rig_torque(&r, 0, 2e-7);
        if (kind == 1) r.scene.torque[0].law = &ramp;
        if (kind == 2) {
            rig_velocity(&r, 0, 0, 0.05, 50);
            rig_velocity(&r, 1, 0, 0.15, 50);
        }
        const fw_dynamics_motion *m = run(arena, &r, NULL);
        assert_string_equal(m->integrator, "radau5");
        assert_non_null(strstr(m->reason, "stiff, "));
        assert_true(m->stats.steps < 5000);
        const fw_dynamics_motion *same = run(arena, &r, "generalised-alpha");
        assert_near(m->peak[0].angle_rad, same->peak[0].angle_rad,
                    m->peak[0].error_rad + same->peak[0].error_rad);
    }
    fw_arena_free(arena);
}

static void test_ordinary_scenes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig some[4] = {two_bars(arena, 1), rig_six_bar(arena, false), rig_pendulum(arena),
                   rig_windows(arena, 3)};
    rig_torque(&some[0], 0, 2e-7);
    for (int i = 0; i < 4; i++) {
        const fw_dynamics_motion *m = run(arena, &some[i], NULL);
        assert_string_equal(m->integrator, "dop853");
        assert_non_null(strstr(m->reason, "not stiff"));
    }
    const fw_dynamics_motion *m = run(arena, &some[0], "dopri5");
    assert_string_equal(m->reason, "asked for");
    fw_arena_free(arena);
}

/* The two costs meet where the stiffness is some hundred times larger, and some thousand times
   where the answer has to be better: implicit steps of order 5 become more in number than explicit
   ones of order 8. Wherever it is, the choice is near the better one. */
static void test_the_border(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int tight = 0; tight < 2; tight++)
        for (int k = 1; k <= 6; k += test_cases(1, 3)) {
            rig r = two_bars(arena, pow(10, k));
            rig_torque(&r, 0, 2e-7);
            double accuracy = tight ? 1e-8 : 1e-3;
            const fw_dynamics_motion *m = run_to(arena, &r, NULL, accuracy);
            const fw_dynamics_motion *a = run_to(arena, &r, "dop853", accuracy);
            const fw_dynamics_motion *b = run_to(arena, &r, "radau5", accuracy);
            long least = a->stats.rhs < b->stats.rhs ? a->stats.rhs : b->stats.rhs;
            assert_true(m->stats.rhs <= 2 * least);
            if (k < (tight ? 3 : 2)) assert_string_equal(m->integrator, "dop853");
            if (k > (tight ? 4 : 2)) assert_string_equal(m->integrator, "radau5");
        }
    fw_arena_free(arena);
}

/* the same motion in a long scene, damped: nothing is left that needs accurate steps, but explicit
   ones must stay stable; undamped, too, the fast motion is hardly excited, which the spectrum does
   not tell but a trial does */
static void test_what_is_not_excited(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int damped = 0; damped < 2; damped++) {
        rig r = two_bars(arena, 100);
        rig_torque(&r, 0, 2e-7);
        r.m.pin[0].damping_Nms_per_rad = damped ? 1e-8 : 0;
        r.m.pin[1].damping_Nms_per_rad = 0;
        r.scene.duration_s = 1;
        const fw_dynamics_motion *m = run(arena, &r, NULL);
        assert_string_equal(m->integrator, "radau5");
        const fw_dynamics_motion *explicit_ = run(arena, &r, "dop853");
        assert_true(2 * m->stats.steps < explicit_->stats.steps);
        assert_true(m->stats.rhs <= run(arena, &r, "radau5")->stats.rhs);
        if (!damped) assert_non_null(strstr(m->reason, "tried"));
    }
    fw_arena_free(arena);
}

/* a trial that loses costs at most two fifths of one run, and leaves the answer as it was: both
   motions are excited, and the slow one is not slower by much */
static void test_a_trial_that_loses(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    int tried = 0;
    for (uint64_t seed = 1; seed < 60 && tried < 2; seed++) {
        rig r = rig_any(arena, seed);
        r.scene.duration_s *= 10;
        const fw_dynamics_motion *m = run(arena, &r, NULL), *other = run(arena, &r, "dop853");
        if (strcmp(m->integrator, "dop853") != 0 || m->stats.runs <= other->stats.runs) continue;
        tried++;
        assert_int_equal(m->stats.runs, other->stats.runs + 1);
        for (int i = 0; i < m->npin; i++)
            assert_true(m->peak[i].angle_rad == other->peak[i].angle_rad);
        assert_true(m->stats.all_steps - other->stats.all_steps <= other->stats.all_steps / 2);
    }
    assert_int_equal(tried, 2);
    fw_arena_free(arena);
}

/* what comes slowly is gone along with: as many steps as explicit stability takes are not needed, although
   the static answer to the load has the frequency of the only motion there is */
static void test_what_comes_slowly(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_quantity_law slow = {.kind = &fw_quantity_law_ramp, .rise_s = 10};
    rig r = two_bars(arena, 1);
    rig_torque(&r, 0, 2e-7);
    r.scene.torque[0].law = &slow;
    r.m.pin[0].damping_Nms_per_rad = r.m.pin[1].damping_Nms_per_rad = 0;
    r.scene.duration_s = 10;
    const fw_dynamics_motion *m = run(arena, &r, NULL), *other = run(arena, &r, "dop853");
    assert_string_equal(m->integrator, "radau5");
    assert_non_null(strstr(m->reason, "stiff, ")); /* at once, without a trial */
    assert_true(5 * m->stats.rhs < other->stats.rhs);
    assert_near(m->peak[0].angle_rad, other->peak[0].angle_rad,
                m->peak[0].error_rad + other->peak[0].error_rad);
    fw_arena_free(arena);
}

static double settled(const void *one, const void *other, double margin, double wanted) {
    (void)one, (void)other, (void)margin, (void)wanted;
    return 0;
}

/* who looks on has the trial, too, and does not see it */
static void test_a_trial_unseen(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = two_bars(arena, 100);
    rig_torque(&r, 0, 2e-7);
    r.m.pin[1].damping_Nms_per_rad = 0;
    r.scene.duration_s = 1;
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {.effects = {.mode = FW_EFFECTS_ALL}, .unsettled = settled};
    const fw_dynamics_motion *m = NULL;
    assert_int_equal(fw_dynamics_simulate(arena, &r.m, &r.scene, &o, &diags, &m), FW_OK);
    assert_string_equal(m->integrator, "radau5");
    assert_non_null(strstr(m->reason, "tried"));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stiff_scenes),       cmocka_unit_test(test_ordinary_scenes),
        cmocka_unit_test(test_the_border),         cmocka_unit_test(test_what_is_not_excited),
        cmocka_unit_test(test_a_trial_that_loses), cmocka_unit_test(test_what_comes_slowly),
        cmocka_unit_test(test_a_trial_unseen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
