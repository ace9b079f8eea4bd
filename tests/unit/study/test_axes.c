/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Logarithmic axes and labels that do not cover each other. */
#include "study/tradeoff.h"
#include "test.h"

static void decades(void **state) {
    (void)state;
    fw_study_axis a = fw_study_axis_new(true);
    fw_study_axis_add(&a, 3e-4);
    fw_study_axis_add(&a, 2e-9);
    fw_study_axis_add(&a, 0);
    fw_study_axis_add(&a, (double)NAN);
    fw_study_axis_add(&a, (double)INFINITY);
    fw_study_axis_end(&a);
    assert_near(a.low, -9, 0);
    assert_near(a.high, -3, 0);
    fw_study_panel p = {.x = 10, .y = 20, .width = 600, .height = 100, .ax = a, .ay = a};
    assert_near(fw_study_panel_x(&p, 1e-3), 10, 1e-9); /* it falls to the right */
    assert_near(fw_study_panel_x(&p, 1e-4), 110, 1e-9);
    assert_near(fw_study_panel_x(&p, 1e-9), 610, 1e-9);
    assert_near(fw_study_panel_x(&p, 1e-20), 610, 1e-9); /* stays inside */
    p.ay.falls = false;
    assert_near(fw_study_panel_y(&p, 1e-9), 120, 1e-9);
    assert_near(fw_study_panel_y(&p, 1e-3), 20, 1e-9);
    fw_study_axis none = fw_study_axis_new(false);
    fw_study_axis_end(&none);
    assert_true(none.high > none.low);
}

static void labels(void **state) {
    (void)state;
    static const double y[][5] = {
        {50, 50, 50, 50, 50}, {10, 11, 12, 190, 191}, {198, 199, 199, 199, 199}, {3, 1, 2, 1, 0}};
    const fw_study_panel panel = {.x = 0, .y = -1, .width = 100, .height = 200};
    fw_arena *arena = fw_arena_new(0);
    for (int k = 0; k < 4; k++) {
        fw_study_labels l = {0};
        for (int i = 0; i < 5; i++)
            fw_study_labels_add(&l, "x", 0, y[k][i], i);
        fw_text out = fw_text_new(arena);
        fw_study_labels_draw(&l, &panel, &out); /* which keeps them between 5 and 195, 16 apart */
        for (int i = 0; i < 5; i++) {
            assert_true(l.item[i].at >= 5 - 1e-9 && l.item[i].at <= 195 + 1e-9);
            if (i > 0) {
                assert_true(l.item[i].at - l.item[i - 1].at >= 16 - 1e-9);
                assert_true(l.item[i].y >= l.item[i - 1].y);
            }
        }
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(decades), cmocka_unit_test(labels)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
