/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "models.h"

static void pose(const rig *r, double *q) {
    for (int b = 0; b < r->m.nbody; b++) {
        q[3 * b] = r->m.body[b].x_m;
        q[3 * b + 1] = r->m.body[b].y_m;
        q[3 * b + 2] = r->m.body[b].phi_rad;
    }
}

static double gap(const rig *r, const double *q) {
    double worst = 0;
    for (int i = 0; i < r->m.npin; i++) {
        const fw_pin *p = &r->m.pin[i];
        const double ground[3] = {0};
        const double *a = p->body_a == FW_GROUND ? ground : q + 3 * p->body_a;
        const double *b = p->body_b == FW_GROUND ? ground : q + 3 * p->body_b;
        double dx = a[0] + cos(a[2]) * p->ax_m - sin(a[2]) * p->ay_m - b[0] - cos(b[2]) * p->bx_m +
                    sin(b[2]) * p->by_m;
        double dy = a[1] + sin(a[2]) * p->ax_m + cos(a[2]) * p->ay_m - b[1] - sin(b[2]) * p->bx_m -
                    cos(b[2]) * p->by_m;
        worst = fmax(worst, hypot(dx, dy));
    }
    return worst;
}

static void test_already_closed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    double q[15], moved;
    pose(&r, q);
    assert_int_equal(fw_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
    assert_true(moved < 1e-17);
    fw_arena_free(arena);
}

/* random guesses up to a link's length and 0.7 rad away close exactly */
static void test_from_a_bad_guess(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int run = 0; run < 60; run++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = run % 3 == 2 ? rig_squeezer(arena) : rig_six_bar(arena, run % 3);
        double unit = run % 3 == 2 ? 0.004 : 0.5e-3, turn = run % 3 == 2 ? 0.3 : 1.4;
        double q[21], moved;
        pose(&r, q);
        for (int i = 0; i < 3 * r.m.nbody; i++)
            q[i] += (i % 3 == 2 ? turn : unit) * (rig_random(&seed) - 0.5);
        assert_int_equal(fw_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
        assert_true(gap(&r, q) <= 1e-12 * unit);
        assert_true(moved > 0);
        fw_arena_free(arena);
    }
}

/* least change in the mass metric: a loose pair of bodies pulled together moves both by their
 * masses */
static void test_mass_weighted(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 2, 1, 0);
    rig_body(&r, "light", 1, 1, 0, 0, 0);
    rig_body(&r, "heavy", 3, 1, 4, 0, 0);
    rig_pin_local(&r, "P", 0, 0, 0, 1, 0, 0);
    double q[6], moved;
    pose(&r, q);
    assert_int_equal(fw_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
    assert_near(q[0], 3, 1e-12);
    assert_near(q[3], 3, 1e-12);
    assert_near(moved, 3, 1e-12);
    fw_arena_free(arena);
}

/* a ring that is 1 mm too short: says which joint and how far */
static void test_impossible(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 2, 3, 0);
    rig_body(&r, "p", 1e-8, 1e-15, 0.5e-3, 1e-4, 0.1);
    rig_body(&r, "q", 1e-8, 1e-15, 2.5e-3, 1e-4, -0.1);
    rig_pin_local(&r, "left", FW_GROUND, 0, 0, 0, -0.5e-3, 0);
    rig_pin_local(&r, "middle", 0, 0.5e-3, 0, 1, -0.5e-3, 0);
    rig_pin_local(&r, "right", 1, 0.5e-3, 0, FW_GROUND, 3e-3, 0);
    double q[6], moved;
    pose(&r, q);
    assert_int_equal(fw_assemble(arena, &r.m, q, &moved, &diags), FW_SOLVER);
    assert_int_equal(diags.count, 1);
    assert_int_equal(diags.item[0].number, 100);
    print_message("%s\n", diags.item[0].message);
    assert_non_null(strstr(diags.item[0].message, "um"));
    /* 1000 um are missing; the best position shares them among three joints */
    const char *by = strstr(diags.item[0].message, "open by ");
    assert_non_null(by);
    double um = 0;
    assert_int_equal(sscanf(by, "open by %lf um", &um), 1);
    assert_near(um, 1000.0 / 3, 5);
    q[0] = (double)NAN;
    assert_int_equal(fw_assemble(arena, &r.m, q, &moved, &diags), FW_INPUT);
    fw_arena_free(arena);
}

static void test_out_of_memory(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    double q[15], moved;
    pose(&r, q);
    fw_arena_fail_at(0, 0);
    assert_int_equal(fw_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
    long count = fw_arena_count();
    for (long n = 1; n <= count; n++) {
        fw_arena_fail_at(n, 0);
        assert_int_equal(fw_assemble(arena, &r.m, q, &moved, &diags), FW_NOMEM);
    }
    fw_arena_fail_at(0, 0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_already_closed), cmocka_unit_test(test_from_a_bad_guess),
        cmocka_unit_test(test_mass_weighted),  cmocka_unit_test(test_impossible),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
