/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria are those without dry friction, the ledger says so, and the range that friction may hold in is what torques
   of that size lead to. */
#include "statics/statics.h"
#include "rest_rigs.h"

static const fw_effect_entry *entry(const fw_effect_ledger *ledger) {
    for (int i = 0; i < ledger->count; i++)
        if (strcmp(ledger->item[i].id, "friction") == 0) return &ledger->item[i];
    fail_msg("no friction in the ledger");
    return NULL;
}

static void left_out_at_rest(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_statics_static_options o = {.path = false};
    const fw_statics *without = NULL, *with = NULL;
    assert_int_equal(fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &without), FW_OK);
    assert_false(entry(&without->ledger)->called_for);
    r.scene.friction = fw_arena_array(f.arena, fw_device_friction_use, 1);
    r.scene.friction[r.scene.nfriction++] =
        (fw_device_friction_use){.revolute = 0,
                                 .joint = FW_NONE,
                                 .coefficient = 0.5,
                                 .static_coefficient = (double)NAN,
                                 .radius_m = 1e-4,
                                 .preload_N = 1};
    assert_int_equal(fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &with), FW_OK);
    for (int i = 0; i < 15; i++)
        assert_true(with->q[i] == without->q[i]);
    const fw_effect_entry *e = entry(&with->ledger);
    assert_true(e->called_for && !e->active);
    assert_non_null(strstr(e->reason, "left out at rest"));
    fw_arena_free(f.arena);
}

enum { RUBS = 3, BODIES = 5 };
static const int rubs[RUBS] = {0, 2, 4}; /* pins of the six-bar */

static rig rubbing(fixture *f) {
    rig r = rig_six_bar(f->arena, false);
    r.scene.friction = fw_arena_array(f->arena, fw_device_friction_use, RUBS);
    for (int i = 0; i < RUBS; i++)
        r.scene.friction[r.scene.nfriction++] =
            (fw_device_friction_use){.revolute = rubs[i],
                                     .joint = FW_NONE,
                                     .coefficient = 0.2,
                                     .static_coefficient = 0.3,
                                     .radius_m = 2e-6,
                                     .preload_N = 1e-4};
    return r;
}

/* the pins' torques as loads, +- what friction has at most: all eight ways to rest at the edge */
static void range_is_where_such_torques_lead(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rubbing(&f);
    const fw_statics_static_options o = {.path = false};
    const fw_statics *with = NULL, *pushed = NULL;
    assert_int_equal(fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &with), FW_OK);
    const fw_statics_friction_range *range = with->friction;
    assert_non_null(range);
    assert_null(range->why);
    assert_int_equal(range->count, RUBS);
    for (int i = 0; i < RUBS; i++) { /* the larger coefficient, and what presses with it */
        const double *n = with->reaction_N + 2 * rubs[i];
        double alone = 0.3 * 2e-6 * (1e-4 + hypot(n[0], n[1]));
        assert_true(range->limit[i] >= alone && range->limit[i] < 1.02 * alone);
    }
    double far[3 * BODIES] = {0}, turned[6] = {0};
    const int stated = r.scene.ntorque;
    fw_device_torque *torque = fw_arena_array(f.arena, fw_device_torque, (size_t)stated + 2 * RUBS);
    memcpy(torque, r.scene.torque, (size_t)stated * sizeof *torque);
    r.scene.torque = torque;
    r.scene.nfriction = 0;
    for (int way = 0; way < 1 << RUBS; way++) {
        r.scene.ntorque = stated;
        for (int i = 0; i < RUBS; i++) {
            const fw_mechanism_pin *p = &r.m.pin[rubs[i]];
            double t = (way >> i & 1 ? 1 : -1) * range->limit[i];
            fw_device_torque one = torque[0];
            one.value_Nm = t, one.body = p->body_b;
            if (p->body_b != FW_GROUND) torque[r.scene.ntorque++] = one;
            one.value_Nm = -t, one.body = p->body_a;
            if (p->body_a != FW_GROUND) torque[r.scene.ntorque++] = one;
        }
        assert_int_equal(fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &pushed), FW_OK);
        for (int i = 0; i < 3 * BODIES; i++)
            far[i] = fmax(far[i], fabs(pushed->q[i] - with->q[i]));
        for (int k = 0; k < 6; k++)
            turned[k] = fmax(turned[k], fabs(pushed->angle_rad[k] - with->angle_rad[k]));
    }
    for (int i = 0; i < 3 * BODIES; i++)
        assert_near(range->q[i] / far[i], 1, 2e-3);
    for (int k = 0; k < 6; k++)
        assert_near(range->angle_rad[k] / turned[k], 1, 2e-3);
    fw_arena_free(f.arena);
}

/* what presses grows with the friction: a radius of the size of the links holds anywhere */
static void what_locks_itself_is_told(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rubbing(&f);
    const fw_statics_static_options o = {.path = false};
    const fw_statics *with = NULL;
    for (int i = 0; i < RUBS; i++)
        r.scene.friction[i].radius_m = 5e-3, r.scene.friction[i].static_coefficient = 2;
    assert_int_equal(fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &with), FW_OK);
    assert_non_null(with->friction);
    assert_non_null(with->friction->why);
    fw_arena_free(f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(left_out_at_rest),
        cmocka_unit_test(range_is_where_such_torques_lead),
        cmocka_unit_test(what_locks_itself_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
