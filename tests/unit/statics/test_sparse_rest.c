/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria and modes of large mechanisms: against dense matrices on random ones, and against what is known of chains. */
#include "statics/statics_equilibrium.h"
#include "rest_rigs.h"

/* the six-bar of the reference, loaded, both ways */
static void same_as_dense(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    fw_statics_equilibrium w[2];
    for (int sparse = 0; sparse < 2; sparse++) {
        bool unstable;
        assert_int_equal(fw_statics_equilibrium_new(f.arena, &r.m, &r.scene, &all, sparse ? 0 : 300,
                                                    &f.diags, &w[sparse]),
                         FW_OK);
        assert_int_equal(w[sparse].sparse, sparse);
        assert_int_equal(fw_statics_equilibrium_reach(&w[sparse], 0, &unstable, NULL), FW_OK);
        assert_int_equal(fw_statics_equilibrium_lowest(&w[sparse], 3), FW_OK);
    }
    assert_int_equal(w[0].reduced.dof, w[1].reduced.dof);
    for (int i = 0; i < 15; i++)
        assert_near(w[1].y[i], w[0].y[i], 1e-13);
    for (int i = 0; i < 2 * w[0].model->nblock; i++)
        assert_near(w[1].lambda[i], w[0].lambda[i], 1e-11);
    for (int k = 0; k < w[1].reduced.modes; k++)
        assert_near(w[1].reduced.value[k] / w[0].reduced.value[k], 1, 1e-11);
    fw_arena_free(f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_as_dense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
