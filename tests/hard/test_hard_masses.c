/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies of very different mass. Hard because S = G M^-1 G^T then holds numbers of 1e12 beside 1:
   what a heavy body does to the joints drowns in the round-off of what a nearly massless link does,
   and a proximal term that goes with the light link hides the heavy one. */
#include "hard.h"

enum { ROWS = 21 };
static const double mm = 1e-3;

/* the reference six-bar whose four links weigh `factor` of what they do; the platform is as it is */
static rig light_links(fw_arena *arena, double factor) {
    rig r = rig_six_bar(arena, false);
    for (int b = 0; b < 5; b++)
        if (b != 2) r.m.body[b].mass_kg *= factor, r.m.body[b].inertia_kg_m2 *= factor;
    return r;
}

static double apart(const fw_motion *a, const fw_motion *b) {
    double worst = 0;
    for (int i = 0; i < ROWS * 15; i++)
        worst = fmax(worst, fabs(a->q[i] - b->q[i]) / (i % 3 == 2 ? 1 : mm));
    return worst;
}

/* the difference to the massless limit falls with the mass: 1e-6, 1e-8 against 1e-10, 1e-12 */
static void test_light_links(void **state) {
    (void)state;
    static const double factor[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
    enum { N = sizeof factor / sizeof factor[0] };
    fw_arena *arena = fw_arena_new(0);
    const fw_motion *m[N];
    for (int i = 0; i < N; i++) {
        rig r = light_links(arena, factor[i]);
        m[i] = hard_run(arena, &r, (fw_motion_options){.rtol = 1e-11, .samples = ROWS});
    }
    for (int i = 0; i < N; i++) {
        double to_limit = apart(m[i], m[3]);
        print_message("masses: links at %.0e of their mass: %.1e from 1e-8, energy %.1e, steps %ld, "
                      "constraint %.1e\n",
                      factor[i], to_limit, m[i]->stats.energy_error, m[i]->stats.steps,
                      m[i]->stats.max_constraint_norm);
        assert_true(m[i]->stats.energy_error < 1e-8);
        /* a relative change of the total mass by f moves the motion by some f times its phase */
        assert_true(to_limit < 100 * factor[i] + 1e-6 + 1e-7);
    }
    assert_true(apart(m[4], m[3]) < 2e-6);
    assert_true(apart(m[5], m[4]) < 2e-6);
    fw_arena_free(arena);
}

/* a double pendulum with a bob of 1e8 and one of 1e-8 of the other's mass: the heavy upper one
   swings as if it were alone (its period by the exact pendulum), the light upper one as if its bar
   were massless (one long pendulum with free joints: energy and closure judge) */
static void test_ratio(void **state) {
    (void)state;
    for (int e = -8; e <= 8; e += 4) {
        fw_arena *arena = fw_arena_new(0);
        double ratio = pow(10, e); /* lower over upper */
        rig r = rig_new(arena, 2, 2, 0);
        rig_body(&r, "upper", 1, 0.25, -0.5, 0, 0); /* J + m l^2 = m l: A01 */
        rig_body(&r, "lower", ratio, 0.1 * ratio, -1, -0.7, 0);
        rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
        rig_pin(&r, "P", 0, 1, -1, 0, 0, 0);
        r.scene.gravity = true, r.scene.gy_m_per_s2 = -9.81;
        r.scene.duration_s = 10;
        const fw_motion *m =
            hard_run(arena, &r, (fw_motion_options){.rtol = 1e-12, .samples = 11});
        double x = 2 * hard_q(m, 1)[0] - 0.9862917511318753193556;
        print_message("masses: pendulum with a bob of %.0e below it: energy %.1e, upper one off the "
                      "lone pendulum by %.1e at 1 s, %ld steps\n",
                      ratio, m->stats.energy_error, fabs(x), m->stats.steps);
        assert_true(m->stats.energy_error < 1e-9);
        if (e == -8) assert_true(fabs(x) < 1e-6);
        fw_arena_free(arena);
    }
}

/* a chain of 12 bars whose masses alternate between 1 and 1e-8: the methods agree */
static void test_alternating_chain(void **state) {
    (void)state;
    enum { BARS = 12 };
    const fw_motion *first = NULL;
    fw_arena *arena = fw_arena_new(0);
    double worst = 0, energy = 0;
    int refused = 0;
    for (size_t i = 0; fw_method_at(i).name; i++) {
        rig r = rig_new(arena, BARS, BARS, 0);
        for (int b = 0; b < BARS; b++) {
            double mass = b % 2 ? 1e-8 : 1;
            rig_body(&r, "bar", mass, mass / 12, b + 0.5, 0, 0);
            rig_pin(&r, "pin", b - 1, b, b, 0, b % 2 ? 5 : 3, 0);
        }
        r.scene.gravity = true, r.scene.gy_m_per_s2 = -9.81;
        r.scene.duration_s = 0.5;
        outcome out = hard_try(arena, &r,
                               (fw_motion_options){
                                   .rtol = 1e-10, .samples = 6, .method = fw_method_at(i).name});
        if (out.status != FW_OK) {
            refused++;
            print_message("masses, %s: %s\n", fw_method_at(i).name, out.message);
            continue;
        }
        energy = fmax(energy, out.m->stats.energy_error);
        if (!first) first = out.m;
        for (int k = 0; k < 6 * 3 * BARS; k++)
            worst = fmax(worst, fabs(out.m->q[k] - first->q[k]));
    }
    print_message("masses: chain of 12 bars, 1 and 1e-8 kg in turn: methods agree to %.1e, energy "
                  "%.1e, %d refuse\n",
                  worst, energy, refused);
    assert_true(worst < 1e-5);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_light_links),
        cmocka_unit_test(test_ratio),
        cmocka_unit_test(test_alternating_chain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
