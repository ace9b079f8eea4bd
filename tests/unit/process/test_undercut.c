/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reference: closed form and quadrature of an independent computation. */
#include "process/pack.h"
#include "test.h"

static double stiffness(double A, double width, double time, double w0) {
    double top, bottom;
    fw_process_undercut_widths(width, A, 50.0, 50.0 * time / 90.0, &top, &bottom);
    return fw_process_undercut_stiffness(top, bottom, w0);
}

static void table(void **state) {
    (void)state;
    static const struct {
        double A, t90, t99, t108, biased;
    } rows[] = {{0.999, 0.985100, 0.982133, 0.979171, 0.463704},
                {0.995, 0.927469, 0.913279, 0.899235, 0.422344},
                {0.99, 0.859750, 0.832934, 0.806682, 0.375048},
                {0.98, 0.738000, 0.690272, 0.644656, 0.294096},
                {0.97, 0.633250, 0.569818, 0.510814, 0.229500},
                {0.96, 0.544000, 0.469376, 0.402048, 0.179064},
                {0.95, 0.468750, 0.386750, 0.315250, 0.140592},
                {0.93, 0.354250, 0.266162, 0.195126, 0.090756},
                {0.90, 0.250000, 0.164025, 0.102400, 0.053453},
                {0.85, 0.166667, 0.087001, 0.040017, 0.026255},
                {0.80, 0.125000, 0.051200, 0.016200, 0.014146}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_near(stiffness(rows[i].A, 10.0, 90.0, 10.0), rows[i].t90, 6e-7);
        assert_near(stiffness(rows[i].A, 10.0, 99.0, 10.0), rows[i].t99, 6e-7);
        assert_near(stiffness(rows[i].A, 10.0, 108.0, 10.0), rows[i].t108, 6e-7);
        assert_near(stiffness(rows[i].A, 7.8, 99.0, 10.0), rows[i].biased, 6e-7);
    }
    assert_relative(fw_process_undercut_stiffness(8.0, 10.0, 10.0), 0.738, 1e-12);
    assert_relative(fw_process_undercut_stiffness(7.8, 7.8, 10.0), 0.474552, 1e-12);
    assert_near(fw_process_undercut_stiffness(-3.0, -1.0, 10.0), 0.0, 0.0);
    assert_near(fw_process_undercut_stiffness(-1.0, -1.0, 10.0), 0.0, 0.0);
}

/* against quadrature of the section, negative widths counted as nothing */
static void quadrature(void **state) {
    (void)state;
    for (double top = -6.0; top < 11.0; top += 0.7) {
        double sum = 0.0, bottom = 9.1;
        for (int i = 0; i < 20000; i++) {
            double w = top + (bottom - top) * (i + 0.5) / 20000.0;
            sum += w > 0.0 ? w * w * w : 0.0;
        }
        assert_relative(fw_process_undercut_stiffness(top, bottom, 10.0), sum / 20000.0 / 1000.0,
                        1e-6);
    }
}

static void needed(void **state) {
    (void)state;
    assert_relative(fw_process_undercut_cut(10.0, 50.0), 0.9, 1e-12);
    assert_relative(fw_process_undercut_cut(10.0, 60.0), 0.9166666667, 1e-9);
    assert_near(fw_process_undercut_needed(10.0, 50.0, 50.0, 0.1, 0), 0.9930, 5e-5);
    assert_near(fw_process_undercut_needed(10.0, 50.0, 55.0, 0.1, 0), 0.9942, 5e-5);
    assert_near(fw_process_undercut_needed(10.0, 50.0, 50.0, 0.1, 1), 0.9965489385, 1e-9);
    for (double w = 4.0; w < 40.0; w *= 1.3) /* the answer does what it says */
        for (int straight = 0; straight < 2; straight++) {
            double A = fw_process_undercut_needed(w, 50.0, 57.0, 0.2, straight), top, bottom;
            fw_process_undercut_widths(w, A, 50.0, 57.0, &top, &bottom);
            assert_near(fw_process_undercut_stiffness(top, straight ? top : bottom, w), 0.8, 1e-10);
        }
}

static void print_limit(void **state) {
    (void)state;
    static const double gap[] = {0, 5, 10, 20}, want[] = {2.7, 3.441838172, 4.05, 5.051237472};
    for (int i = 0; i < 4; i++)
        assert_relative(1e6 * fw_process_print_limit(405e-9, gap[i] * 1e-6, 16e-6), want[i], 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(table), cmocka_unit_test(quadrature),
                                       cmocka_unit_test(needed), cmocka_unit_test(print_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
