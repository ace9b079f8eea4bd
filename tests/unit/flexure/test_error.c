/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the closed form says of its own error, against solids. tests/cli/test_hinge.py solves some
   anew. */
#include "error_solids.h"
#include "test.h"

static double used(double value, double reference, double error) {
    return fabs(reference / value - 1) / error;
}

/* every estimate holds, with a fifth to spare, and none is so wide that it says nothing: of each
   quantity the worst solid uses more than a third */
static void estimates_hold(void **state) {
    (void)state;
    double most[5] = {0};
    for (int i = 0; i < SOLIDS; i++) {
        const error_solid *s = &SOLID[i];
        fw_flexure_result o = error_solid_form(s);
        const double part[5] = {used(o.stiffness_Nm_per_rad * 1e12, s->K, o.error.stiffness),
                                used(o.kx_N_per_m, s->kx, o.error.kx),
                                used(o.ky_N_per_m, s->ky, o.error.ky),
                                fabs(s->W * 1e-6 - o.centre_m) / o.error.centre_m,
                                used(o.strain_per_rad, s->strain, o.error.strain)};
        for (int k = 0; k < 5; k++) {
            if (part[k] > 0.97)
                fail_msg("solid %d, quantity %d: %.2f of the estimate", i, k, part[k]);
            most[k] = fmax(most[k], part[k]);
        }
        assert_false(o.error.outside);
    }
    for (int k = 0; k < 5; k++)
        assert_true(most[k] > 0.33);
}

/* the peak strain is on the safe side, and not far */
static void strain_is_safe(void **state) {
    (void)state;
    for (int i = 0; i < SOLIDS; i++) {
        double over = error_solid_form(&SOLID[i]).strain_per_rad / SOLID[i].strain;
        if (!(over > 1 && over < 1.021)) fail_msg("solid %d: %.4f", i, over);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(estimates_hold),
                                       cmocka_unit_test(strain_is_safe)};
    return cmocka_run_group_tests_name("error", tests, NULL, NULL);
}
