/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Initial velocities that the joints do not allow. Hard because something must give: the velocities
   are moved the least way there is in the mass metric, which is what a plastic impact does, and how
   much that was must be said. */
#include "hard.h"

/* T of velocities v of the rig */
static double kinetic(const rig *r, const double *v) {
    double sum = 0;
    for (int b = 0; b < r->m.nbody; b++)
        sum += 0.5 * (r->m.body[b].mass_kg * (v[3 * b] * v[3 * b] + v[3 * b + 1] * v[3 * b + 1]) +
                      r->m.body[b].inertia_kg_m2 * v[3 * b + 2] * v[3 * b + 2]);
    return sum;
}

/* a bar on a pin, pushed anyhow: w = (m l x v + J w0) / (J + m l^2), the moment about the pin */
static void test_bar(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double l = 0.7, mass = 2, inertia = 0.3, vx = 5, vy = -3, w = 2;
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "bar", mass, inertia, l, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig_velocity(&r, 0, vx, vy, w);
    r.scene.duration_s = 0.1;
    outcome out = hard_try(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-10, .samples = 2});
    assert_int_equal(out.status, FW_OK);
    double want = (mass * l * vy + inertia * w) / (inertia + mass * l * l);
    const double *v = hard_v(out.m, 0);
    assert_near(v[2], want, 1e-14);
    assert_near(v[0], 0, 1e-14);
    assert_near(v[1], l * want, 1e-14);
    assert_int_equal(out.number, 106);
    /* the message's per cents: largest change over largest velocity, and the energy's change */
    double before = kinetic(&r, (const double[3]){vx, vy, w}), after = kinetic(&r, v);
    char energy[40];
    snprintf(energy, sizeof energy, "%.3g %%", 100 * (after - before) / before);
    print_message("start: %s (energy by %s)\n", out.message, energy);
    assert_non_null(strstr(out.message, energy));
    assert_true(out.m->stats.velocity_moved > 0.5);
    fw_arena_free(arena);
}

/* random velocities on mechanisms of all kinds: v+ satisfies G v+ = 0; the change is orthogonal to
   every motion that is allowed, so that T(v) = T(v+) + T(v - v+), and projecting again does nothing
 */
static void test_is_the_mass_orthogonal_one(void **state) {
    (void)state;
    uint64_t seed = 11;
    for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
        double pythagoras = 0, again = 0, joints = 0;
        int refused = 0;
        for (int run = 0; run < (hard_quick() ? 6 : 30); run++) {
            fw_arena *arena = fw_arena_new(0);
            rig r = run % 3 == 0   ? rig_squeezer(arena)
                    : run % 3 == 1 ? rig_six_bar(arena, run % 2)
                                   : rig_windows(arena, 3);
            r.scene.ninitial = 0;
            double size = run % 3 == 2 ? 1 : 1e-3, v[27];
            for (int b = 0; b < r.m.nbody; b++) {
                for (int c = 0; c < 3; c++)
                    v[3 * b + c] = (c == 2 ? 1 : size) * 100 * (rig_random(&seed) - 0.5);
                rig_velocity(&r, b, v[3 * b], v[3 * b + 1], v[3 * b + 2]);
            }
            r.scene.duration_s = run % 3 == 2 ? 1e-3 : 1e-5;
            outcome out =
                hard_try(arena, &r,
                         (fw_dynamics_motion_options){
                             .rtol = 1e-8, .samples = 2, .method = fw_multibody_method_at(k).name});
            if (out.status != FW_OK) {
                refused++;
                fw_arena_free(arena);
                continue;
            }
            const double *after = hard_v(out.m, 0);
            double change[27];
            for (int i = 0; i < 3 * r.m.nbody; i++)
                change[i] = v[i] - after[i];
            double all = kinetic(&r, v);
            pythagoras =
                fmax(pythagoras, fabs(all - kinetic(&r, after) - kinetic(&r, change)) / all);
            joints = fmax(joints, out.m->stats.max_velocity_norm);
            r.scene.ninitial = 0;
            for (int b = 0; b < r.m.nbody; b++)
                rig_velocity(&r, b, after[3 * b], after[3 * b + 1], after[3 * b + 2]);
            outcome twice =
                hard_try(arena, &r,
                         (fw_dynamics_motion_options){
                             .rtol = 1e-8, .samples = 2, .method = fw_multibody_method_at(k).name});
            assert_int_equal(twice.status, FW_OK);
            assert_int_equal(twice.number, 0); /* nothing to say */
            again = fmax(again, twice.m->stats.velocity_moved);
            fw_arena_free(arena);
        }
        print_message("start, %-23s: T(v) = T(v+) + T(v - v+) to %.1e, G v+ %.1e, moved when asked "
                      "again %.1e, %d refuse\n",
                      fw_multibody_method_at(k).name, pythagoras, joints, again, refused);
        assert_true(pythagoras < 1e-10);
        assert_true(again < 1e-10);
    }
}

/* a driver that moves at once: the velocities that fit it, and its own energy */
static void test_driver(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "arm", 2, 0.5, 0.5, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    hard_driver(arena, &r, "motor", 0, FW_NONE,
                hard_law(arena, "3 rad/s * t", (fw_quantity_dimension){.rad = 1}));
    r.scene.duration_s = 1;
    outcome out = hard_try(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-10, .samples = 3});
    assert_int_equal(out.status, FW_OK);
    assert_near(hard_v(out.m, 0)[2], 3, 1e-13);
    assert_near(hard_v(out.m, 2)[2], 3, 1e-13);
    assert_true(out.m->stats.energy_error < 1e-10);
    print_message("start: driver at speed from rest: rate to %.1e, energy %.1e, says: %s\n",
                  fabs(hard_v(out.m, 0)[2] - 3), out.m->stats.energy_error, out.message);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bar),
        cmocka_unit_test(test_is_the_mass_orthogonal_one),
        cmocka_unit_test(test_driver),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
