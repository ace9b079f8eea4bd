/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dry friction where it is hard: random mechanisms with friction in many joints, more joints than
   freedoms that stick together, thousands of stick-slip cycles. Everything must end, with books
   that close and no more events than the motion has turning points. */
#include "hard.h"

static const double NOT = (double)NAN;

static void rub(fw_arena *arena, rig *r, int pin, int joint, double mu_s, double mu_k,
                double radius, double preload) {
    if (!r->scene.friction) r->scene.friction = fw_arena_array(arena, fw_device_friction_use, 64);
    r->scene.friction[r->scene.nfriction++] = (fw_device_friction_use){.revolute = pin,
                                                                       .joint = joint,
                                                                       .coefficient = mu_k,
                                                                       .static_coefficient = mu_s,
                                                                       .radius_m = radius,
                                                                       .preload_N = preload};
}

static double largest_angle(const fw_dynamics_motion *m) {
    double most = 0;
    for (int i = 0; i < m->npin; i++)
        most = fmax(most, fabs(m->peak[i].angle_rad));
    return most;
}

/* 80 of them; a third under a load that swings */
static void random_mechanisms(void **state) {
    (void)state;
    int count = hard_quick() ? 8 : 80, sticking = 0, jams = 0;
    double energy = 0;
    long events = 0, most = 0;
    for (int c = 0; c < count; c++) {
        fw_arena *arena = fw_arena_new(0);
        uint64_t seed = 77 + 13 * (uint64_t)c;
        rig r = rig_any(arena, seed);
        r.scene.duration_s = 5e-3;
        double level = pow(10, -1.5 + 2 * rig_random(&seed));
        for (int i = 0; i < r.m.npin; i++) {
            if (rig_random(&seed) < 0.3) continue;
            double mu = 0.05 + 0.3 * rig_random(&seed);
            double more = rig_random(&seed) < 0.5 ? NOT : mu * (1 + rig_random(&seed));
            double preload = rig_random(&seed) < 0.5 ? 0 : 3e-3 * rig_random(&seed);
            rub(arena, &r, i, FW_NONE, more, mu, 1e-4 * level, preload);
        }
        fw_quantity_law law = hard_law(arena, "sin(9000 rad/s * t)", (fw_quantity_dimension){0});
        for (int i = 0; i < r.scene.nforce && c % 3 == 0; i++)
            r.scene.force[i].law = &law;
        outcome out =
            hard_try(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-9, .samples = 31});
        if (out.status != FW_OK) {
            print_message("case %d: %s\n", c, out.message);
            jams += out.number == 244;
            if (out.number != 244) fail_msg("%s", out.message);
            fw_arena_free(arena);
            continue;
        }
        const fw_dynamics_motion *m = out.m;
        int still = 0;
        for (int k = 1; k < m->nsample; k++) {
            double speed = 0;
            for (int i = 0; i < 3 * m->nbody; i++)
                speed = fmax(speed, fabs(hard_v(m, k)[i]) * (i % 3 == 2 ? 1 : 1e3));
            still += speed < 1e-9;
        }
        sticking += still > 0;
        if (m->stats.energy_error > 1e-7 || m->stats.events > 2000)
            print_message("case %d: energy %.1e, %ld events, %ld steps, angle %.2f\n", c,
                          m->stats.energy_error, m->stats.events, m->stats.steps, largest_angle(m));
        energy = fmax(energy, m->stats.energy_error);
        events += m->stats.events;
        most = m->stats.events > most ? m->stats.events : most;
        fw_arena_free(arena);
    }
    print_message("%d mechanisms: %ld events, at most %ld; energy off by at most %.1e; %d came to "
                  "rest; %d jam\n",
                  count, events, most, energy, sticking, jams);
    assert_true(energy < 1e-7);
    assert_true(most < 2000);
    assert_int_equal(jams, 0);
    assert_true(sticking >= count / 20); /* of a few none may: motions that rub are chaotic */
}

/* the six-bar with friction in all six hinges and three freedoms: it is put off balance, comes to
   rest before it is straight again, and whatever each hinge holds, all methods agree; doubled
   hinges and a second friction on the same hinge, too */
static void more_joints_than_freedoms(void **state) {
    (void)state;
    const char *methods[] = {"chain", "minimal", "svd", "augmented"};
    for (int twice = 0; twice < 2; twice++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, twice);
        r.scene.duration_s = 60e-3;
        for (int i = 0; i < 6; i++) {
            r.m.pin[i].damping_Nms_per_rad = 0;
            rub(arena, &r, i, FW_NONE, 0.3, 0.2, 30e-6, 0.4e-3);
        }
        rub(arena, &r, 2, FW_NONE, NOT, 0.1, 20e-6, 0);
        const fw_dynamics_motion *first = NULL;
        for (int k = 0; k < 4; k++) {
            if (twice && k == 1) continue; /* not for minimal */
            if (hard_quick() && (k == 1 || k == 2)) continue;
            fw_dynamics_motion_options o = {.method = methods[k], .rtol = 1e-11, .samples = 61};
            const fw_dynamics_motion *m = hard_run(arena, &r, o);
            print_message("six-bar%s, %s: %ld events, %ld steps, energy %.1e\n",
                          twice ? " (D twice)" : "", methods[k], m->stats.events, m->stats.steps,
                          m->stats.energy_error);
            assert_true(m->stats.energy_error < 1e-9);
            assert_true(m->stats.events > 10 && m->stats.events < 200);
            for (int i = 0; i < 15; i++) /* mm/s and rad/s of some hundred on the way */
                assert_near(hard_v(m, 60)[i] * (i % 3 == 2 ? 1 : 1e3), 0, 1e-9);
            if (!first) first = m;
            for (int i = 0; i < 15; i++)
                assert_near(hard_q(m, 60)[i] * (i % 3 == 2 ? 1 : 1e3),
                            hard_q(first, 60)[i] * (i % 3 == 2 ? 1 : 1e3), 1e-7);
        }
        fw_arena_free(arena);
    }
}

/* a slow rotor that a spring pulls round through a sticking disc: thousands of stick-slip cycles,
   none lost. Disc (driven, rate W) - friction - rotor - spring to the ground: sticks for 2 D/W,
   slips for 2 (pi - atan(D w/W))/w, D = (mu_s - mu_k) N r/k */
static void thousand_cycles(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double k = 4, j = 0.01, w = 20, n = 5, radius = 0.1, mu_s = 0.5, mu_k = 0.3, rate = 0.4;
    const long cycles = hard_quick() ? 50 : 1000;
    double d = (mu_s - mu_k) * n * radius / k, first = mu_s * n * radius / k / rate;
    double slips = 2 * (HARD_PI - atan(d * w / rate)) / w, period = 2 * d / rate + slips;
    rig r = rig_new(arena, 2, 3, 0);
    rig_body(&r, "disc", 1, 1, 0, 0, 0);
    rig_body(&r, "rotor", 1, j, 0, 0, 0);
    rig_pin(&r, "axle", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "bearing", FW_GROUND, 1, 0, 0, k, 0);
    rig_pin(&r, "clutch", 0, 1, 0, 0, 0, 0);
    rig_velocity(&r, 0, 0, 0, rate);
    rig_velocity(&r, 1, 0, 0, rate);
    hard_driver(arena, &r, "motor", 0, FW_NONE,
                hard_law(arena, "0.4 rad/s * t", (fw_quantity_dimension){.rad = 1}));
    rub(arena, &r, 2, FW_NONE, mu_s, mu_k, radius, n);
    r.scene.duration_s = first + ((double)cycles + 0.5) * period;
    fw_dynamics_motion_options o = {
        .method = "chain", .integrator = "dop853", .rtol = 1e-10, .samples = 2};
    const fw_dynamics_motion *m = hard_run(arena, &r, o);
    double late = 0.5 * period, x = mu_k * n * radius / k;
    double want = late < slips ? x + d * cos(w * late) + rate / w * sin(w * late)
                               : x - d + rate * (late - slips);
    print_message("%ld cycles: %ld events, %ld steps, off %.1e rad, energy %.1e\n", cycles,
                  m->stats.events, m->stats.steps, hard_q(m, 1)[5] - want, m->stats.energy_error);
    assert_int_equal(m->stats.events, 1 + 2 * cycles + (late > slips));
    assert_near(hard_q(m, 1)[5], want, 1e-7);
    assert_true(m->stats.energy_error < 1e-9);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_mechanisms),
        cmocka_unit_test(more_joints_than_freedoms),
        cmocka_unit_test(thousand_cycles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
