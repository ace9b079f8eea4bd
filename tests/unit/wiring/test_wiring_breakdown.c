/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The range of breakdown against the formula written another way, and against what is measured. */
#include "test.h"
#include "wiring/wiring.h"
#include <math.h>

/* V in kV, pd in Torr cm: Paschen's law with other units, its least value by search */
static double paschen_of(double gap_um, double torr, double gamma) {
    double pd = gap_um * 1e-4 * torr, best = HUGE_VAL, at = 0;
    double c = log(1 / gamma + 1);
    for (double x = c / 15 * 1.001; x < 10; x *= 1.0005) {
        double v = 365 * x / (log(15 * x) - log(c));
        if (v < best) best = v, at = x;
    }
    return pd <= at ? best : 365 * pd / log(15 * pd / c);
}

static double paschen(double gap_um, double gamma) {
    return paschen_of(gap_um, 760, gamma);
}

static void follows_paschen_above_six_micrometres(void **unused) {
    (void)unused;
    for (double um = 6; um < 900; um *= 1.3) {
        double v[2];
        fw_wiring_breakdown(um * 1e-6, 1, v);
        assert_relative(v[0], paschen(um, 0.02), 1e-6);
        assert_relative(v[1], paschen(um, 0.005), 1e-6);
        assert_true(v[0] < v[1]);
    }
}

/* the least voltage of air, 327 V, and 350 V/um below 1 um lie in the range or at its end */
static void holds_what_is_measured(void **unused) {
    (void)unused;
    double v[2];
    fw_wiring_breakdown(7.5e-6, 1, v);
    assert_true(v[0] < 327 && 327 < v[1]);
    fw_wiring_breakdown(0.5e-6, 1, v);
    assert_near(v[1], 175, 1e-9);
    assert_true(v[0] > 15 && v[0] < 40);
}

static void grows_with_the_gap(void **unused) {
    (void)unused;
    double before[2] = {0, 0}, v[2];
    for (double um = 0.01; um < 1000; um *= 1.07) {
        fw_wiring_breakdown(um * 1e-6, 1, v);
        for (int i = 0; i < 2; i++) {
            assert_true(v[i] >= before[i] * (1 - 1e-12));
            before[i] = v[i];
        }
    }
    fw_wiring_breakdown(0, 1, v);
    assert_near(v[0] + v[1], 0, 0);
    fw_wiring_breakdown(-1e-6, 1, v);
    assert_near(v[0] + v[1], 0, 0);
}

/* by the product of density and gap: what 2100 V hold apart at 1 atm 300 V may not at 20 Torr, and of a vacuum nothing says
   that it breaks down */
static void thin_air_bears_less(void **unused) {
    (void)unused;
    double v[2], room[2];
    fw_wiring_breakdown(330e-6, 1, room);
    assert_true(room[0] > 1900);
    for (double torr = 15; torr < 700; torr *= 1.5) {
        fw_wiring_breakdown(330e-6, torr / 760, v);
        assert_relative(v[0], paschen_of(330, torr, 0.02), 1e-6);
        assert_true(v[0] < room[0]);
        if (torr > 25) assert_relative(v[1], paschen_of(330, torr, 0.005), 1e-6);
    }
    fw_wiring_breakdown(330e-6, 20.0 / 760, v);
    assert_true(v[0] < 300);
    fw_wiring_breakdown(330e-6, 1e-4, v);
    assert_true(v[0] > 250 && v[1] > 1e5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_paschen_above_six_micrometres),
        cmocka_unit_test(holds_what_is_measured),
        cmocka_unit_test(grows_with_the_gap),
        cmocka_unit_test(thin_air_bears_less),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
