/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Design points against closed forms: planes, a parabola with two, a plane in unequal directions, starts that lead nowhere. */
#include "chance/estimate.h"
#include "limits.h"

static fw_chance_points find(limit_state *l, size_t budget, size_t starts, double *start) {
    const fw_chance_subset from = {.failing = starts, .failed = start};
    fw_chance_limit limit = {.dimensions = l->dimensions, .g = limit_call, .context = l};
    fw_chance_run run = {
        .arena = arena, .limit = &limit, .batch = 64, .budget = 20000, .level = 0.95};
    fw_chance_points out;
    l->next = 0;
    assert_int_equal(fw_chance_points_find(&run, budget, &from, &out), FW_OK);
    assert_true(run.used <= budget);
    assert_int_equal(run.used, l->next);
    return out;
}

static double limit_plane(const limit_state *l, const double *u) {
    return 100 * (l->b - 0.6 * u[0] + 0.8 * u[1]);
}

static void planes(void **state) {
    (void)state;
    for (double b = -4; b < 6; b += 1.5) { /* from both sides of the origin */
        limit_state l = {.dimensions = 2, .g = limit_plane, .b = b};
        fw_chance_points p = find(&l, 200, 0, NULL);
        assert_int_equal(p.origin_fails, b <= 0);
        assert_int_equal(p.count, 1);
        assert_near(p.point[0].beta, b, 2e-3 * fabs(b));
        assert_near(p.point[0].alpha[0], -0.6, 1e-9);
        assert_near(p.point[0].alpha[1], 0.8, 1e-9);
        assert_near(p.point[0].u[0], 0.6 * b, 2e-3 * fabs(b));
    }
    limit_state many = {.dimensions = 100, .g = limit_linear, .b = 4.75};
    fw_chance_points p = find(&many, 1000, 0, NULL);
    assert_int_equal(p.count, 1);
    assert_true(many.next <=
                1 + 2 * (100 + 6) + 107 + 1 + 3 * 106); /* two gradients; then the other side */
    assert_near(p.point[0].beta, 4.75, 1e-3);
}

/* u_1 = b - (u_0 - 0.1)^2/2 is nearest at two places; by Newton's method along the curve */
static double nearest(double b, double x) {
    for (int i = 0; i < 50; i++) {
        double y = b - (x - 0.1) * (x - 0.1) / 2, slope = -(x - 0.1);
        double f = x + y * slope, df = 1 + slope * slope - y;
        x -= f / df;
    }
    return hypot(x, b - (x - 0.1) * (x - 0.1) / 2);
}

static void parabola(void **state) {
    (void)state;
    limit_state l = {.dimensions = 2, .g = limit_parabola, .b = 5};
    static double starts[] = {3, 2, -3, 2, 2.9, 2.1, 0, 6};
    fw_chance_points p = find(&l, 2000, 4, starts);
    assert_int_equal(p.count, 2);
    double right = nearest(5, 3), left = nearest(5, -3);
    assert_near(p.point[0].beta, fmin(right, left), 2e-3); /* g to 1e-3 of 5, over a slope of 3 */
    assert_near(p.point[1].beta, fmax(right, left), 2e-3);
    assert_true(p.point[0].beta < p.point[1].beta);
}

/* from one side the other is found, too */
static void mirrored(void **state) {
    (void)state;
    limit_state l = {.dimensions = 2, .g = limit_sides, .b = 4};
    fw_chance_points p = find(&l, 400, 0, NULL);
    assert_int_equal(p.count, 2);
    assert_near(p.point[0].beta, 4, 5e-3);
    assert_near(p.point[1].beta, 4.3, 5e-3);
}

static double limit_nowhere(const limit_state *l, const double *u) {
    return l->b + u[0] * u[0];
}
static double limit_unknown(const limit_state *l, const double *u) {
    return u[0] > 1 ? (double)NAN : l->b - u[0];
}

/* flat, rising everywhere, not to be evaluated on the way, or no budget: no point, and no harm */
static void none(void **state) {
    (void)state;
    static double start[] = {2, 2, 2, 2, 2};
    limit_state flat = {.dimensions = 5, .g = limit_flat, .b = 4};
    assert_int_equal(find(&flat, 500, 1, start).count, 0);
    limit_state nowhere = {.dimensions = 2, .g = limit_nowhere, .b = 3};
    assert_int_equal(find(&nowhere, 500, 1, start).count, 0);
    limit_state unknown = {.dimensions = 2, .g = limit_unknown, .b = 3};
    assert_int_equal(find(&unknown, 500, 1, start).count, 0);
    assert_int_equal(find(&unknown, 0, 1, start).count, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(planes), cmocka_unit_test(parabola),
                                       cmocka_unit_test(mirrored), cmocka_unit_test(none)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
