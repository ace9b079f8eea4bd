/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawn tendons in the envelope, by closed forms: a lever about the ground with torsion K under a
   torque F from rest, and a cable from its end, at r, straight up to the ground. */
#include "quantity/law_kind.h"
#include "effects/envelope.h"
#include "test.h"

static const double K = 1e-6, F = 1e-10, r_m = 2e-3, J = 3e-15 + 2e-8 * 1e-6, high_m = 0.5;

typedef struct lever {
    fw_arena *arena;
    fw_mechanism_mass body[1];
    fw_mechanism_pin pin[1];
    fw_device_torque torque[1];
    fw_device_eyelet eyelet[2];
    fw_device_tendon tendon[1];
    fw_mechanism m;
    fw_device_scene scene;
} lever;

static void lever_new(lever *s, double torque) {
    memset(s, 0, sizeof *s);
    s->arena = fw_arena_new(0);
    s->body[0] = (fw_mechanism_mass){"lever", 2e-8, 3e-15, 1e-3, 0, 0, {0, 0}};
    s->pin[0] = (fw_mechanism_pin){.id = "O",
                                   .body_a = FW_GROUND,
                                   .body_b = 0,
                                   .bx_m = -1e-3,
                                   .stiffness_Nm_per_rad = K,
                                   .hinge = FW_NONE};
    s->torque[0] = (fw_device_torque){.body = 0, .value_Nm = torque};
    s->eyelet[0] = (fw_device_eyelet){.body = 0, .x_m = r_m - 1e-3};
    s->eyelet[1] = (fw_device_eyelet){.body = FW_GROUND, .x_m = r_m, .y_m = high_m};
    s->tendon[0] = (fw_device_tendon){.id = "cable",
                                      .eyelet = s->eyelet,
                                      .neyelet = 2,
                                      .pull_N = (double)NAN,
                                      .draw_m = (double)NAN};
    s->m = (fw_mechanism){.body = s->body, .pin = s->pin, .nbody = 1, .npin = 1};
    s->scene = (fw_device_scene){.name = "s",
                                 .duration_s = acos(-1.0) / sqrt(K / J),
                                 .torque = s->torque,
                                 .tendon = s->tendon,
                                 .ntorque = 1,
                                 .ntendon = 1};
}

/* drawn by nothing, of stiffness k: slack below 0 stretches it */
static void find(lever *s, double k, double slack, fw_effects_envelope *e) {
    s->tendon[0].draw_m = 0;
    s->tendon[0].stiffness_N_per_m = k;
    s->tendon[0].slack_m = slack;
    assert_int_equal(fw_effects_envelope_find(s->arena, &s->m, &s->scene, e), FW_OK);
}

/* Stretched by p it lifts the lever, with the torque, by up to 2 (F + k p r)/(K + k r^2): it stays
   taut where that times r is below p. Then it is a spring. */
static void taut(void **state) {
    (void)state;
    const double k = 0.1 * K / (r_m * r_m), least = 2 * r_m * F / (K * (1.1 - 0.2));
    for (int i = 0; i < 2; i++) {
        lever s;
        fw_effects_envelope e;
        lever_new(&s, F);
        find(&s, k, -least * (i ? 1.02 : 0.98), &e);
        assert_true(e.valid && e.modes == 1);
        assert_near(e.omega[0], sqrt((i ? 1.1 : 1) * K / J), 1e-5 * e.omega[0]);
        assert_int_equal(e.loose_pull > 0, !i);
        fw_arena_free(s.arena);
    }
}

/* a damper that slackens it when the lever comes back: k g - c |g'| */
static void damped(void **state) {
    (void)state;
    const double k = 0.1 * K / (r_m * r_m), p = 4 * r_m * F / K;
    for (int i = 0; i < 2; i++) {
        lever s;
        fw_effects_envelope e;
        lever_new(&s, F);
        s.tendon[0].damping_Ns_per_m = k / sqrt(K / J) * (i ? 10 : 0.1);
        find(&s, k, -p, &e);
        assert_true(e.valid);
        assert_int_equal(e.loose_pull > 0, i);
        fw_arena_free(s.arena);
    }
}

/* Slack by s, and let down by 2 F/K: pulls by T = k (2 F r/K - s)/(1 - 2 k r^2/K) at most in half a
   period, which takes T r/F of the peak; the true change is below that. Out of reach it is nothing,
   and where k r^2 > K/2 it may be anything. */
static void slack(void **state) {
    (void)state;
    for (int i = 1; i < 6; i++) {
        double k = 1e-4 * i * i * K / (r_m * r_m), s_m = 0.2 * i * r_m * F / K;
        double pull = k * (2 * F * r_m / K - s_m) / (1 - 2 * k * r_m * r_m / K);
        lever s;
        fw_effects_envelope e;
        lever_new(&s, -F);
        find(&s, k, s_m, &e);
        assert_true(e.valid);
        assert_near(e.omega[0], sqrt(K / J), 1e-9 * e.omega[0]);
        double back = 2 * k * r_m * r_m / K; /* of any other change */
        assert_true(e.loose_pull >= pull * r_m / F + back);
        assert_true(e.loose_pull <= 1.05 * (pull * r_m / F + back));
        find(&s, k, 2.1 * r_m * F / K, &e);
        assert_true(e.valid && e.loose_pull == 0);
        find(&s, 0.6 * K / (r_m * r_m), s_m, &e);
        assert_true(e.valid && isinf(e.loose_pull));
        fw_arena_free(s.arena);
    }
}

static const fw_effect_entry *entry(const fw_effect_ledger *l, const char *id) {
    for (int i = 0; i < l->count; i++)
        if (strcmp(l->item[i].id, id) == 0) return &l->item[i];
    fail_msg("no effect %s", id);
    return NULL;
}

/* A pull of a sine is the load max(0, pull sin): the envelope is there, and weight has a bound;
   with a cable that may pull anything it has none. Tendons stay, whatever their bound is. */
static void others(void **state) {
    (void)state;
    const fw_effect_choice choice = {.mode = FW_EFFECTS_AUTO};
    for (int i = 0; i < 3; i++) {
        lever s;
        fw_effect_ledger ledger;
        fw_effects_loads loads;
        lever_new(&s, -F);
        fw_diags diags = fw_diags_new(s.arena);
        const fw_quantity_law sine = {.kind = &fw_quantity_law_sine,
                                      .end_s = (double)INFINITY,
                                      .frequency_Hz = 3 / s.scene.duration_s};
        s.scene.gravity = true, s.scene.gy_m_per_s2 = 1e-9;
        s.tendon[0].draw_m = 0;
        s.tendon[0].slack_m = 0;
        s.tendon[0].stiffness_N_per_m = (i == 1 ? 1e-4 : 10) * K / (r_m * r_m);
        if (i == 0) {
            s.tendon[0].pull_N = 0.5 * F / r_m, s.tendon[0].law = &sine;
        }
        assert_int_equal(
            fw_effects_compile(s.arena, &s.m, &s.scene, &choice, 1e-3, &diags, &ledger, &loads),
            FW_OK);
        assert_int_equal(isfinite(entry(&ledger, "gravity")->bound), i < 2);
        assert_int_equal(isfinite(entry(&ledger, "tendon")->bound), i == 1);
        assert_true(entry(&ledger, "tendon")->active && entry(&ledger, "inertia")->active);
        assert_int_equal(loads.nelement, 1);
        assert_int_equal(loads.element[0].switches, 1);
        fw_arena_free(s.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taut),
        cmocka_unit_test(damped),
        cmocka_unit_test(slack),
        cmocka_unit_test(others),
    };
    return cmocka_run_group_tests_name("tendon_slack", tests, NULL, NULL);
}
