/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dry friction where it is hard: random mechanisms with friction in many joints, more joints than
   freedoms that stick together, thousands of stick-slip cycles. Everything must end, with books
   that close and no more events than the motion has turning points. */
#include "hard.h"

static const double NOT = (double)NAN;

static void rub(fw_arena *arena, rig *r, int pin, int tie, double mu_s, double mu_k, double radius,
                double preload) {
    if (!r->scene.friction) r->scene.friction = fw_arena_array(arena, fw_friction_use, 64);
    r->scene.friction[r->scene.nfriction++] = (fw_friction_use){.joint = pin,
                                                                .tie = tie,
                                                                .coefficient = mu_k,
                                                                .static_coefficient = mu_s,
                                                                .radius_m = radius,
                                                                .preload_N = preload};
}

static double largest_angle(const fw_motion *m) {
    double most = 0;
    for (int i = 0; i < m->npin; i++)
        most = fmax(most, fabs(m->peak[i].angle_rad));
    return most;
}

/* 200 of them; a third under a load that swings */
static void random_mechanisms(void **state) {
    (void)state;
    int count = hard_quick() ? 20 : 200, sticking = 0, jams = 0;
    double energy = 0;
    long events = 0, most = 0;
    for (int c = 0; c < count; c++) {
        fw_arena *arena = fw_arena_new(0);
        uint64_t seed = 77 + 13 * (uint64_t)c;
        rig r = rig_any(arena, seed);
        r.scene.duration_s = 3e-3;
        double level = pow(10, -2 + 2 * rig_random(&seed));
        for (int i = 0; i < r.m.npin; i++) {
            if (rig_random(&seed) < 0.3) continue;
            double mu = 0.05 + 0.3 * rig_random(&seed);
            double more = rig_random(&seed) < 0.5 ? NOT : mu * (1 + rig_random(&seed));
            double preload = rig_random(&seed) < 0.5 ? 0 : 3e-4 * rig_random(&seed);
            rub(arena, &r, i, FW_NONE, more, mu, 1e-4 * level, preload);
        }
        fw_law law = hard_law(arena, "sin(9000 rad/s * t)", (fw_dimension){0});
        for (int i = 0; i < r.scene.nforce && c % 3 == 0; i++)
            r.scene.force[i].law = &law;
        outcome out = hard_try(arena, &r, (fw_motion_options){.rtol = 1e-9, .samples = 31});
        if (out.status != FW_OK) {
            print_message("case %d: %s\n", c, out.message);
            jams += out.number == 244;
            if (out.number != 244) fail_msg("%s", out.message);
            fw_arena_free(arena);
            continue;
        }
        const fw_motion *m = out.m;
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
                          m->stats.energy_error, m->stats.events, m->stats.steps,
                          largest_angle(m));
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
    assert_true(sticking > count / 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_mechanisms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
