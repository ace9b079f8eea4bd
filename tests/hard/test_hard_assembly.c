/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mechanisms that cannot be put together. Hard because a Newton iteration then wanders or stops
   somewhere, and its last iterate says nothing: the answer wanted is which joint cannot close, and
   by how much at best. Those that just barely close must close. */
#include "hard.h"

static outcome assemble(fw_arena *arena, const rig *r, double *moved) {
    fw_diags diags = fw_diags_new(arena);
    outcome out = {.message = ""};
    double q[60];
    for (int b = 0; b < r->m.nbody; b++) {
        const fw_mechanism_mass *p = &r->m.body[b];
        q[3 * b] = p->x_m, q[3 * b + 1] = p->y_m, q[3 * b + 2] = p->phi_rad;
    }
    out.status = fw_assembly_assemble(arena, &r->m, q, moved, &diags);
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].severity == FW_ERROR)
            out.message = diags.item[i].message, out.number = diags.item[i].number;
    return out;
}

/* two bars of 1 between pins that are `apart`: they reach each other up to 2 */
static rig two_bars(fw_arena *arena, double apart, double size, double guess) {
    rig r = rig_new(arena, 2, 3, 0);
    rig_body(&r, "left", size, size * size * size, 0.5 * size, guess * size, 0.3);
    rig_body(&r, "right", size, size * size * size, 1.5 * size, -guess * size, -0.2);
    rig_pin_local(&r, "A", FW_GROUND, 0, 0, 0, -0.5 * size, 0);
    rig_pin_local(&r, "B", 0, 0.5 * size, 0, 1, -0.5 * size, 0);
    rig_pin_local(&r, "C", 1, 0.5 * size, 0, FW_GROUND, apart * size, 0);
    return r;
}

/* what a triangle lacks, from a millionth of a millionth to all of it; what just fits closes */
static void test_barely(void **state) {
    (void)state;
    for (int e = 0; e <= 12; e++) {
        fw_arena *arena = fw_arena_new(0);
        double lack = 2 * pow(10, -e), moved;
        rig shut = two_bars(arena, 2 - lack, 1, 0.1), open = two_bars(arena, 2 + lack, 1, 0.1);
        outcome good = assemble(arena, &shut, &moved), bad = assemble(arena, &open, &moved);
        if (e % 3 == 0)
            print_message("assembly: bars too short by %.0e of their length: %s; too long by as "
                          "much: %s\n",
                          lack / 2, bad.message, good.status == FW_OK ? "closes" : good.message);
        assert_int_equal(good.status, FW_OK);
        assert_int_equal(bad.status, FW_SOLVER);
        assert_int_equal(bad.number, 100);
        assert_true(strstr(bad.message, "joint A") || strstr(bad.message, "joint B") ||
                    strstr(bad.message, "joint C"));
        fw_arena_free(arena);
    }
}

/* exactly stretched: it closes, to the square root of round-off sideways */
static void test_exactly_stretched(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double moved;
    rig r = two_bars(arena, 2, 1, 0.05);
    outcome out = assemble(arena, &r, &moved);
    print_message("assembly: bars that just reach: %s\n",
                  out.status == FW_OK ? "closes" : out.message);
    assert_int_equal(out.status, FW_OK);
    fw_arena_free(arena);
}

/* the same 10 % too short from 1 nm to 1 km */
static void test_sizes(void **state) {
    (void)state;
    for (int e = -9; e <= 3; e += 3) {
        fw_arena *arena = fw_arena_new(0);
        double size = pow(10, e), moved;
        rig r = two_bars(arena, 2.2, size, 0.1);
        outcome out = assemble(arena, &r, &moved);
        print_message("assembly: 10 %% too short at %.0e m: %s\n", size, out.message);
        assert_int_equal(out.status, FW_SOLVER);
        fw_arena_free(arena);
    }
}

/* loops of other joints that contradict each other */
static void test_others(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double moved;
    rig r = rig_new(arena, 1, 1, 0); /* a rod to the ground that is shorter than the way */
    rig_body(&r, "bar", 1, 0.1, 0.5, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    fw_device_joint *rod = hard_tie(arena, &r, "rod", FW_JOINT_DISTANCE, FW_GROUND, 0);
    rod->ax_m = 5, rod->bx_m = 0.5, rod->length_m = 3;
    outcome out = assemble(arena, &r, &moved);
    print_message("assembly: rod 25 %% too short: %s\n", out.message);
    assert_int_equal(out.status, FW_SOLVER);
    assert_true(strstr(out.message, "rod") || strstr(out.message, "joint O"));

    rig w = rig_new(arena, 2, 2, 0); /* welded at an angle that its pins do not allow */
    rig_body(&w, "p", 1, 0.1, 0.5, 0, 0);
    rig_body(&w, "q", 1, 0.1, 1.5, 0, 0);
    rig_pin(&w, "P", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&w, "Q", 1, FW_GROUND, 2, 0, 0, 0);
    fw_device_joint *weld = hard_tie_at(arena, &w, "weld", FW_JOINT_WELD, 0, 1, 1, 0);
    weld->angle_rad = 0.5;
    out = assemble(arena, &w, &moved);
    print_message("assembly: welded askew: %s\n", out.message);
    assert_int_equal(out.status, FW_SOLVER);

    rig s = rig_new(arena, 1, 0, 0); /* two guides that are not parallel hold the cart: closes; a
                                        third one that misses the crossing does not */
    rig_body(&s, "cart", 1, 0.1, 0.3, 0.2, 0);
    for (int i = 0; i < 3; i++) {
        fw_device_joint *g =
            hard_tie(arena, &s, i < 2 ? "guide" : "third", FW_JOINT_PRISMATIC, FW_GROUND, 0);
        g->axis_rad = i, g->ax_m = i == 2 ? 0.5 : 0;
        if (i == 0) continue;
        out = assemble(arena, &s, &moved);
        if (i == 1) assert_int_equal(out.status, FW_OK);
    }
    print_message("assembly: three guides that do not meet: %s\n", out.message);
    assert_int_equal(out.status, FW_SOLVER);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_barely),
        cmocka_unit_test(test_exactly_stretched),
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
