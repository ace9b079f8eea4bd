/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads that snap through. Hard because a bistable toggle has no equilibrium near its fold:
   whatever follows the load step by step falls off there, and what integrates meets a fast jump
   after a slow creep, with stops that are hit at full speed. */
#include "quantity/law_kind.h"
#include "hard.h"
#include "statics/statics.h"

enum { ROWS = 201 };

/* two bars of 1 that push a slider against a spring: apex at height `rise`; in line it is unstable
 */
static rig toggle(fw_arena *arena, double rise, double damping) {
    double half = sqrt(1 - rise * rise);
    rig r = rig_new(arena, 3, 3, 0);
    rig_body(&r, "left", 0.1, 0.1 / 12, half / 2, rise / 2, atan2(rise, half));
    rig_body(&r, "right", 0.1, 0.1 / 12, 1.5 * half, rise / 2, atan2(-rise, half));
    rig_body(&r, "slider", 0.05, 1e-3, 2 * half, 0, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, damping);
    rig_pin(&r, "apex", 0, 1, half, rise, 0, 0);
    rig_pin(&r, "C", 1, 2, 2 * half, 0, 0, 0);
    fw_device_joint *guide = hard_tie(arena, &r, "guide", FW_JOINT_PRISMATIC, FW_GROUND, 2);
    guide->stiffness_N_per_m = 1000;
    guide->free_length_m = 2 * half;
    return r;
}

static double apex(const double *q) {
    return q[1] + 0.5 * sin(q[2]);
}

/* elastic energy: k (2 half - 2 cos)^2 / 2, cos of the bars; the peak force is at its fold */
static double fold_force(double rise) {
    double most = 0, half = sqrt(1 - rise * rise);
    for (int i = 1; i < 100000; i++) {
        double y = rise * i / 100000, c = sqrt(1 - y * y);
        most = fmax(most, 1000 * 2 * (c - half) * 2 * y / c);
    }
    return most;
}

/* a slow ramp to 1.2 times the fold pushes it over; damped, it comes to rest on the other side,
   where spring and load balance */
static void test_pushed_over(void **state) {
    (void)state;
    const double rise = 0.2;
    double fold = fold_force(rise);
    for (int share = 80; share <= 120; share += 40) {
        fw_arena *arena = fw_arena_new(0);
        rig r = toggle(arena, rise, 0.3);
        fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .start_s = 0, .rise_s = 20};
        const fw_mechanism_mass *left = &r.m.body[0];
        rig_force(&r, 0, 0, -fold * share / 100);
        hard_local(&r, 0, 2 * left->x_m, 2 * left->y_m, &r.scene.force[0].x_m,
                   &r.scene.force[0].y_m);
        r.scene.force[0].law = &ramp;
        r.scene.duration_s = hard_quick() ? 22 : 30;
        const fw_dynamics_motion *m =
            hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-9, .samples = ROWS});
        double y = apex(hard_q(m, ROWS - 1)), y0 = apex(hard_q(m, 0));
        /* at rest the spring's force at the apex, 4 k (c - half) y / c downwards, holds the load
           up: before the fold between the rise and the fold, or beyond the drawn pose's mirror
           image */
        double half = sqrt(1 - rise * rise), low = share < 100 ? 0.6 * rise : -0.9;
        double high = share < 100 ? rise : -rise, load = fold * share / 100;
        for (int k = 0; k < 200; k++) {
            double mid = 0.5 * (low + high), c = sqrt(1 - mid * mid);
            bool holds = 4000 * (c - half) * mid / c > load;
            *(holds ? &low : &high) = mid;
        }
        print_message(
            "snap: toggle under %d %% of its fold load: apex from %.3f to %.6f m (rest at "
            "%.6f), energy %.1e, by %s in %ld steps, %.0f ms\n",
            share, y0, y, low, m->stats.energy_error, m->integrator, m->stats.steps,
            1e3 * m->stats.cpu_s);
        assert_near(y, low, 1e-4);
        assert_true(m->stats.energy_error < 1e-7);
        fw_arena_free(arena);
    }
}

/* statics: the load path finds the fold, says how far the toggle snaps there, and goes on to the
   far side by arc length */
static void test_static_fold(void **state) {
    (void)state;
    const double rise = 0.2;
    fw_arena *arena = fw_arena_new(0);
    rig r = toggle(arena, rise, 0);
    double start = r.m.body[0].phi_rad, fold = fold_force(rise);
    rig_force(&r, 0, 0, -1.2 * fold);
    hard_local(&r, 0, cos(start), sin(start), &r.scene.force[0].x_m, &r.scene.force[0].y_m);
    r.scene.duration_s = 1;
    fw_diags diags = fw_diags_new(arena);
    const fw_statics_static_options o = {.path = true};
    const fw_statics *s = NULL;
    fw_status status = fw_statics_solve(arena, &r.m, &r.scene, &o, &diags, &s);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    double at = 0, way = 0;
    int folds = 0;
    for (int i = 0; i < s->path->count; i++)
        if (s->path->mark[i] == FW_PATH_FOLD && folds++ == 0)
            at = s->path->factor[i], way = s->path->snap_m[i];
    print_message("snap: static path: %d points, %d folds, the first at %.12f of the load (exact "
                  "%.12f), snaps by %.3f m, complete %d, ends at apex %.6f m\n",
                  s->path->count, folds, at, 1 / 1.2, way, s->path->complete, apex(s->q));
    assert_true(folds >= 1);
    assert_near(at, 1 / 1.2, 1e-8);
    assert_true(s->path->complete);
    assert_near(apex(s->q), -0.23499260, 1e-6);
    fw_arena_free(arena);
}

/* free and undamped: thrown with just more, or just less, than the energy of the ridge */
static void test_over_the_ridge(void **state) {
    (void)state;
    const double rise = 0.3;
    double half = sqrt(1 - rise * rise), ridge = 0.5 * 1000 * pow(2 - 2 * half, 2);
    for (int i = 0; i < 6; i++) {
        double share = 1 + (i % 2 ? 1 : -1) * pow(10, -1 - 2 * (i / 2)); /* to 1e-5 of the ridge */
        fw_arena *arena = fw_arena_new(0);
        rig r = toggle(arena, rise, 0);
        /* in terms of the bar's rate w: slider 2 rise w, bars as they turn and move */
        double inertia = 0.1 * (1.0 / 12 + 0.25); /* left about A */
        double vx = 1.5 * rise, vy = 0.5 * half;  /* right's centre */
        inertia += 0.1 / 12 + 0.1 * (vx * vx + vy * vy) + 0.05 * 4 * rise * rise;
        double w = -sqrt(2 * ridge * share / inertia);
        rig_velocity(&r, 0, -rise / 2 * w, half / 2 * w, w);
        rig_velocity(&r, 1, -1.5 * rise * w, half / 2 * w, -w);
        rig_velocity(&r, 2, -2 * rise * w, 0, 0);
        r.scene.duration_s = 0.5;
        outcome out =
            hard_try(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-11, .samples = ROWS});
        assert_int_equal(out.status, FW_OK);
        assert_int_equal(out.number, 0); /* velocities fit */
        double lowest = 1;
        for (int k = 0; k < ROWS; k++)
            lowest = fmin(lowest, apex(hard_q(out.m, k)));
        print_message("snap: thrown with %.5f of the ridge's energy: lowest apex %+.5f m, energy "
                      "%.1e\n",
                      share, lowest, out.m->stats.energy_error);
        assert_true(share > 1 ? lowest < -0.9 * rise : lowest > 0);
        assert_true(out.m->stats.energy_error < 1e-8);
        fw_arena_free(arena);
    }
}

/* the toggle snaps against a stop on the far side and bounces there until it rests */
static void test_stop_on_the_far_side(void **state) {
    (void)state;
    const double rise = 0.2;
    fw_arena *arena = fw_arena_new(0);
    rig r = toggle(arena, rise, 0.02);
    double start = r.m.body[0].phi_rad, fold = fold_force(rise);
    r.m.pin[0].stop_min_rad = -0.1; /* in line it is at 0; free at -start */
    r.m.pin[0].stop_max_rad = (double)NAN;
    r.m.pin[0].stop_stiffness_Nm_per_rad = 1e5;
    r.m.pin[0].stop_damping_Nms_per_rad = 20;
    rig_force(&r, 0, 0, -1.3 * fold);
    hard_local(&r, 0, cos(start), sin(start), &r.scene.force[0].x_m, &r.scene.force[0].y_m);
    r.scene.duration_s = 2;
    const fw_dynamics_motion *m =
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-9, .samples = ROWS});
    double end = hard_q(m, ROWS - 1)[2];
    print_message(
        "snap: against a stop at -0.1 rad: rests at %.6f rad, %ld touches, energy %.1e, by "
        "%s, %ld steps\n",
        end, m->stats.events, m->stats.energy_error, m->integrator, m->stats.steps);
    assert_true(m->stats.events >= 1);
    assert_true(end < -0.1 && end > -0.1 - 0.01);
    assert_true(m->stats.energy_error < 1e-7);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pushed_over),
        cmocka_unit_test(test_static_fold),
        cmocka_unit_test(test_over_the_ridge),
        cmocka_unit_test(test_stop_on_the_far_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
