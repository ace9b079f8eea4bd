/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion of which nothing else is asked: no second run, no forces, rows when they are read. What
   it has is what the same motion has with all of that, to the last bit. */
#include "models.h"

static const fw_dynamics_motion *move(fw_arena *arena, const rig *r,
                                      fw_dynamics_motion_options options) {
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *m = NULL;
    assert_int_equal(fw_dynamics_simulate(arena, &r->m, &r->scene, &options, &diags, &m), FW_OK);
    return m;
}

static void same(const double *a, const double *b, int count) {
    assert_memory_equal(a, b, (size_t)count * sizeof *a);
}

static void compare(fw_arena *arena, const rig *r, const char *method) {
    const fw_dynamics_motion_options all = {
        .rtol = 1e-7, .samples = 101, .method = method, .reactions = true};
    fw_dynamics_motion_options bare = all;
    bare.reactions = false, bare.alone = bare.late_rows = true;
    const fw_dynamics_motion *a = move(arena, r, all), *b = move(arena, r, bare);
    assert_int_equal(a->stats.runs, 2);
    assert_int_equal(b->stats.runs, 1);
    assert_true(a->stats.steps == b->stats.steps && a->stats.rejected == b->stats.rejected);
    assert_true(a->stats.energy_error == b->stats.energy_error);
    assert_null(b->force_peak);
    for (int i = 0; i < a->npin; i++) {
        assert_true(a->peak[i].angle_rad == b->peak[i].angle_rad);
        assert_true(a->peak[i].t_s == b->peak[i].t_s);
        assert_true(isinf(b->peak[i].error_rad));
    }
    assert_int_equal(a->nsample, b->nsample);
    fw_dynamics_motion_rows(b, 0, b->nsample);
    same(a->t_s, b->t_s, a->nsample);
    same(a->q, b->q, a->nsample * 3 * a->nbody);
    same(a->v, b->v, a->nsample * 3 * a->nbody);
    same(a->accel, b->accel, a->nsample * 3 * a->nbody);
    same(a->angle_rad, b->angle_rad, a->nsample * a->npin);
    same(a->reaction_N, b->reaction_N, a->nsample * 2 * a->npin);
    same(a->joint_N, b->joint_N, a->nsample * 3 * a->njoint);
    same(a->driver_N, b->driver_N, a->nsample * a->ndriver);
}

static void the_same_bits(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const rig six = rig_six_bar(arena, false), twice = rig_six_bar(arena, true);
    rig windows = rig_windows(arena, 3), squeezer = rig_squeezer(arena);
    rig pendulum = rig_pendulum(arena);
    windows.scene.duration_s = 1;
    compare(arena, &six, NULL);
    compare(arena, &six, "schur"); /* without a kernel no row waits */
    compare(arena, &twice, NULL);
    compare(arena, &windows, NULL);
    compare(arena, &squeezer, NULL);
    compare(arena, &pendulum, NULL);
    fw_arena_free(arena);
}

static bool waits(const fw_dynamics_motion *m, int row) {
    return m->accel[(size_t)row * 3 * (size_t)m->nbody] == 0 &&
           m->angle_rad[(size_t)row * (size_t)m->npin] == 0;
}

/* only those that are asked for, each once, wherever that is */
static void rows_wait(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const rig r = rig_six_bar(arena, false);
    const fw_dynamics_motion_options bare = {
        .rtol = 1e-7, .samples = 1001, .alone = true, .late_rows = true};
    const fw_dynamics_motion *m = move(arena, &r, bare);
    assert_true(waits(m, 500) && waits(m, 501) && !waits(m, 1000));
    fw_dynamics_motion_rows(m, 501, 1);
    assert_true(waits(m, 500) && !waits(m, 501) && waits(m, 502));
    double before = m->q[501 * 15];
    fw_dynamics_motion_rows(m, 501, 1);
    assert_true(m->q[501 * 15] == before);
    fw_dynamics_motion_rows_at(m, 7.0006e-3);
    assert_true(!waits(m, 700) && !waits(m, 701) && waits(m, 690) && waits(m, 710));
    fw_dynamics_motion_rows(m, -5, 2);
    fw_dynamics_motion_rows(m, 1000, 7);
    fw_dynamics_motion_rows_at(m, 1);
    fw_dynamics_motion_rows_at(m, -1);
    assert_true(waits(m, 500));
    fw_arena_free(arena);
}

/* energies are of every row, and a tolerance that is not stated needs two runs */
static void what_needs_more(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const rig r = rig_six_bar(arena, false);
    const fw_dynamics_motion_options energies = {
        .rtol = 1e-7, .samples = 101, .energies = true, .alone = true, .late_rows = true};
    const fw_dynamics_motion_options accuracy = {.samples = 11, .alone = true};
    assert_false(waits(move(arena, &r, energies), 50));
    const fw_dynamics_motion *m = move(arena, &r, accuracy);
    assert_true(m->stats.runs >= 2 && isfinite(m->peak[0].error_rad));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_bits),
        cmocka_unit_test(rows_wait),
        cmocka_unit_test(what_needs_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
