/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria are those without dry friction, and the ledger says so. */
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(left_out_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
