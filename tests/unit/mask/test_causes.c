/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mask that cannot be drawn says to which hinge the place belongs and which way its axis points:
   a bias that finds no room (FW-D143), an outline that touches itself (FW-D147), pieces that meet
   (FW-D152); far from every hinge it does not. */
#include "scene.h"

/* a fork of which the slot is `gap` um wide, with its middle at (x, 0) */
static void fork(scene *s, double x, double gap, int joint) {
    double h = 0.5 * gap;
    const double p[8][2] = {{x - 30, -40}, {x + 30, -40}, {x + 30, 10}, {x + h, 10},
                            {x + h, -20},  {x - h, -20},  {x - h, 10},  {x - 30, 10}};
    scene_add(s, FW_ROLE_STRUCTURE, "fork", polygon(s->arena, p, 8));
    s->piece[s->layout.npiece - 1].joint = joint;
}

static void break_bias(scene *s, double x, int joint) {
    fork(s, x, 3, joint);
    s->options.bias_m = 2 * UM;
}

static void break_outline(scene *s, double x, int joint) {
    fork(s, x, 0.0004, joint);
}

static void break_overlap(scene *s, double x, int joint) {
    fork(s, x, 12, joint);
    const double p[4][2] = {{x - 10, 0}, {x + 10, 0}, {x + 10, 4}, {x - 10, 4}};
    scene_add(s, FW_ROLE_STRUCTURE, "bar", polygon(s->arena, p, 4));
}

static void the_hinge_and_its_axis_are_named(void **state) {
    (void)state;
    static const struct {
        int number;
        void (*draw)(scene *s, double x, int joint);
    } row[] = {{143, break_bias}, {147, break_outline}, {152, break_overlap}};
    for (int i = 0; i < 3; i++)
        for (int stated = 0; stated < 2; stated++) {
            scene *s = scene_new(0, 0);
            fw_layout_hinge_layout hinge[2] = {
                {.drawn = true, .id = "A", .centre = {-900 * UM, 0}, .keep_out_m = 60 * UM},
                {.drawn = true,
                 .id = "knee",
                 .axis_stated = stated,
                 .axis_rad = -137.5 * PI / 180,
                 .centre = {500 * UM, 0},
                 .keep_out_m = 60 * UM}};
            s->layout.hinge = hinge;
            row[i].draw(s, 500, 1);
            const fw_mask *mask = NULL;
            assert_int_equal(scene_build(s, &mask), FW_INPUT);
            const char *said = scene_first(s, row[i].number);
            assert_says(said, "hinge knee");
            assert_says(said, "-137.5 deg");
            assert_says(said, stated ? "turn its axis" : "state another axis");
            assert_null(strstr(said, "smaller tolerance"));
            assert_null(strstr(said, "smaller bias"));
            scene_free(s);
        }
}

static void a_place_of_no_hinge_names_none(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    fw_layout_hinge_layout hinge = {
        .drawn = true, .id = "A", .centre = {0, 0}, .keep_out_m = 60 * UM};
    s->layout.hinge = &hinge;
    break_bias(s, 500, 0);
    const fw_mask *mask = NULL;
    assert_int_equal(scene_build(s, &mask), FW_INPUT);
    assert_null(strstr(scene_first(s, 143), "hinge"));
    assert_says(scene_first(s, 143), "smaller bias");
    scene_free(s);
}

/* Two bars in one fork at one hinge: one mistake, told once, at the line of its flexure, and with its gap; the
   other is counted. The bar far away is another one, told by itself and of no line. */
static void a_hinge_without_room_is_told_once(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    fw_layout_hinge_layout hinge[2] = {
        {.drawn = true, .id = "A", .centre = {-900 * UM, 0}, .keep_out_m = 60 * UM},
        {.drawn = true,
         .id = "knee",
         .place = {"d.xml", 26, 3},
         .gap_m = 0.1 * UM,
         .centre = {500 * UM, 0},
         .keep_out_m = 60 * UM}};
    s->layout.hinge = hinge;
    break_overlap(s, 500, 1);
    const double more[4][2] = {{490, -12}, {510, -12}, {510, -8}, {490, -8}};
    scene_add(s, FW_ROLE_STRUCTURE, "second bar", polygon(s->arena, more, 4));
    fork(s, 3000, 12, 1);
    const double far[4][2] = {{2990, 0}, {3010, 0}, {3010, 4}, {2990, 4}};
    scene_add(s, FW_ROLE_STRUCTURE, "far bar", polygon(s->arena, far, 4));
    const fw_mask *mask = NULL;
    assert_int_equal(scene_build(s, &mask), FW_INPUT);
    int at_knee = 0, elsewhere = 0;
    for (size_t i = 0; i < s->diags.count; i++) {
        const fw_diag *d = &s->diags.item[i];
        if (d->number != 152) continue;
        at_knee += d->place.line == 26;
        elsewhere += d->place.line == 0;
        if (d->place.line == 26) assert_says(d->message, "a wider gap than its 0.1 um");
    }
    assert_int_equal(at_knee, 1);
    assert_true(elsewhere >= 1);
    assert_says(scene_first(s, 159), "more place(s)");
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_hinge_and_its_axis_are_named),
                                       cmocka_unit_test(a_place_of_no_hinge_names_none),
                                       cmocka_unit_test(a_hinge_without_room_is_told_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
