/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two links in one line. Hard because there a pair of links carries no force across, coordinates
   that were independent stop being so, and a driver may ask for more than the reach: what can pass
   must pass with finite forces, and what cannot must be refused at the time it happens. */
#include "hard.h"

static const double mm = 1e-3;
enum { ROWS = 51 };

/* the six-bar with A, B, C in one line at the start; `bend` moves B off that line */
static rig straight(fw_arena *arena, double bend, double speed) {
    rig r = rig_new(arena, 5, 6, 0);
    const double p[6][2] = {{0.70 * mm, 0.15 * mm}, {0.75 * mm + bend, 1.40 * mm},
                            {0.80 * mm, 2.65 * mm}, {2.20 * mm, 2.75 * mm},
                            {2.85 * mm, 1.45 * mm}, {2.30 * mm, 0.15 * mm}};
    static const double mass[5] = {1.88e-8, 2.00e-8, 6.53e-8, 2.03e-8, 1.97e-8};
    static const double inertia[5] = {2.86e-15, 3.44e-15, 1.155e-14, 3.60e-15, 3.30e-15};
    for (int i = 0; i < 5; i++)
        rig_body(&r, "link", mass[i], inertia[i], (p[i][0] + p[i + 1][0]) / 2,
                 (p[i][1] + p[i + 1][1]) / 2, 0);
    for (int i = 0; i < 6; i++)
        rig_pin(&r, (const char *[]){"A", "B", "C", "D", "E", "F"}[i], i - 1, i < 5 ? i : FW_GROUND,
                p[i][0], p[i][1], 1.6e-6, 6e-12);
    rig_force(&r, 2, 0.35e-3, -0.20e-3);
    if (speed != 0) rig_velocity(&r, 0, 0, 0, speed);
    r.scene.duration_s = 5e-3;
    return r;
}

/* turn of B: sign of the triangle A B C */
static double side(const rig *r, const double *q) {
    double at[3][2];
    static const int body[3] = {0, 0, 1};
    for (int i = 0; i < 3; i++) {
        const fw_mechanism_pin *p = &r->m.pin[i];
        const double *b = q + 3 * body[i];
        double x = i == 2 ? p->ax_m : i == 1 ? p->ax_m : p->bx_m;
        double y = i == 2 ? p->ay_m : i == 1 ? p->ay_m : p->by_m;
        at[i][0] = b[0] + cos(b[2]) * x - sin(b[2]) * y;
        at[i][1] = b[1] + sin(b[2]) * x + cos(b[2]) * y;
    }
    return (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
           (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
}

/* at the start in line, and thrown through the line again and again */
static void test_six_bar(void **state) {
    (void)state;
    static const struct {
        double bend, speed;
    } start[] = {{0, 0}, {0, 3000}, {0.05e-3, 3000}, {1e-12, 0}, {1e-9, 1000}};
    for (size_t k = 0; k < (hard_quick() ? 2 : sizeof start / sizeof start[0]); k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = straight(arena, start[k].bend, start[k].speed);
        const fw_dynamics_motion *fine = hard_run(
            arena, &r,
            (fw_dynamics_motion_options){.rtol = 1e-12, .samples = ROWS, .reactions = true});
        double worst = 0, force = 0;
        int passes = 0;
        for (int i = 1; i < ROWS; i++)
            passes += side(&r, hard_q(fine, i)) * side(&r, hard_q(fine, i - 1)) < 0;
        for (int i = 0; i < fine->npin; i++)
            force = fmax(force, fine->force_peak[i].force_N);
        int refused = 0, count = 0;
        for (size_t i = 0; fw_multibody_method_at(i).name; i++, count++) {
            outcome out = hard_try(
                arena, &r,
                (fw_dynamics_motion_options){
                    .rtol = 1e-11, .samples = ROWS, .method = fw_multibody_method_at(i).name});
            if (out.status != FW_OK) {
                refused++;
                print_message("  %s: %s\n", fw_multibody_method_at(i).name, out.message);
                continue;
            }
            for (int c = 0; c < ROWS * 15; c++)
                worst = fmax(worst, fabs(out.m->q[c] - fine->q[c]) / (c % 3 == 2 ? 1 : mm));
        }
        print_message("dead centre, six-bar, B %.0e m off the line, %g rad/s: passed %d times, "
                      "largest force %.3f mN, energy %.1e, %d methods agree to %.1e, %d refuse\n",
                      start[k].bend, start[k].speed, passes, force * 1e3, fine->stats.energy_error,
                      count - refused, worst, refused);
        assert_true(isfinite(force));
        assert_true(fine->stats.energy_error < 1e-9);
        assert_true(worst < 1e-6);
        fw_arena_free(arena);
    }
}

/* slider-crank, thrown through both dead centres by its flywheel: energy is kept, the slider is
   where the closed form has it, and the force of the crank pin matches Newton for the slider */
static void test_slider_crank(void **state) {
    (void)state;
    const double r0 = 0.1, l = 0.3;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 3, 3, 0);
    rig_body(&r, "flywheel", 5, 0.2, 0, 0, 0);
    rig_body(&r, "rod", 1, 0.01, r0 + l / 2, 0, 0);
    rig_body(&r, "piston", 2, 0.01, r0 + l, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", 0, 1, r0, 0, 0, 0);
    rig_pin(&r, "P", 1, 2, r0 + l, 0, 0, 0);
    hard_tie(arena, &r, "guide", FW_JOINT_PRISMATIC, FW_GROUND, 2);
    rig_velocity(&r, 0, 0, 0, 50);
    rig_velocity(&r, 1, 0, 2.5, -50 * r0 / l); /* fits */
    r.scene.duration_s = 2;
    const fw_dynamics_motion *m =
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-11, .samples = 401});
    double worst = 0, newton = 0;
    for (int i = 0; i < 401; i++) {
        double a = hard_q(m, i)[2], s = r0 * sin(a);
        worst = fmax(worst, fabs(hard_q(m, i)[6] - r0 * cos(a) - sqrt(l * l - s * s)));
        newton = fmax(newton, fabs(m->reaction_N[6 * i + 4] - 2 * m->accel[9 * i + 6]));
    }
    print_message("dead centre, slider-crank through about %d of them: slider to %.1e m, force to "
                  "%.1e N, energy %.1e\n",
                  (int)(hard_q(m, 400)[2] / HARD_PI), worst, newton, m->stats.energy_error);
    assert_true(worst < 1e-13);
    assert_true(newton < 1e-8);
    assert_true(m->stats.energy_error < 1e-9);
    fw_arena_free(arena);
}

/* the slider is driven: it can push the crank only as far as the line, r + l from O */
static void test_driven_beyond_reach(void **state) {
    (void)state;
    const double r0 = 0.1, l = 0.3, start = 1.0;
    double s = r0 * sin(start), x0 = r0 * cos(start) + sqrt(l * l - s * s);
    double when = (r0 + l - x0) / 0.02;
    for (size_t i = 0; fw_multibody_method_at(i).name; i++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 3, 3, 0);
        rig_body(&r, "crank", 1, 0.01, r0 / 2 * cos(start), s / 2, start);
        rig_body(&r, "rod", 1, 0.01, (r0 * cos(start) + x0) / 2, s / 2, -asin(s / l));
        rig_body(&r, "piston", 2, 0.01, x0, 0, 0);
        rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
        rig_pin(&r, "B", 0, 1, r0 * cos(start), s, 0, 0);
        rig_pin(&r, "P", 1, 2, x0, 0, 0, 0);
        fw_device_joint *guide = hard_tie(arena, &r, "guide", FW_JOINT_PRISMATIC, FW_GROUND, 2);
        guide->free_length_m = x0;
        hard_driver(arena, &r, "motor", FW_NONE, 0,
                    hard_law(arena, "0.02 m/s * t", (fw_quantity_dimension){.m = 1}));
        r.scene.duration_s = 2 * when;
        outcome out =
            hard_try(arena, &r,
                     (fw_dynamics_motion_options){
                         .rtol = 1e-9, .samples = 11, .method = fw_multibody_method_at(i).name});
        print_message("dead centre, slider driven beyond the reach at %.6f s, %s: %s\n", when,
                      fw_multibody_method_at(i).name,
                      out.status == FW_OK ? "ACCEPTED" : out.message);
        assert_int_equal(out.status, FW_SOLVER);
        const char *said = strstr(out.message, " s on")  ? strstr(out.message, "from ") + 5
                           : strstr(out.message, " at ") ? strstr(out.message, " at ") + 4
                                                         : NULL;
        if (out.number == 101) assert_near(strtod(said, NULL), when, 0.01 * when);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_six_bar),
        cmocka_unit_test(test_slider_crank),
        cmocka_unit_test(test_driven_beyond_reach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
