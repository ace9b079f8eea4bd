/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bound on what a rounded kink does to a step, against steps of the integrators themselves: the
   integral of hypot(t - centre, width) in one step, whatever its own error estimate says. */
#include "dynamics/models.h"
#include "dynamics/run.h"
#include <stdlib.h>

typedef struct near_zero {
    double centre, width;
} near_zero;

static void slope(void *context, double t, const double *y, double *f) {
    const near_zero *k = context;
    (void)y;
    f[0] = hypot(t - k->centre, k->width);
}

/* integral of hypot(s, w) from 0 to x */
static long double integral(long double x, long double w) {
    long double curved = w > 0 ? w * w * asinhl(x / w) : 0;
    return (x * hypotl(x, w) + curved) / 2;
}

/* |error| of one step from 0 to 1 */
static double one_step(const char *name, near_zero k) {
    fw_arena *arena = fw_arena_new(0);
    const fw_maths_ode ode = {.context = &k, .rhs = slope, .n = 1, .controlled = 1};
    const double atol = 1e9, start = 0;
    fw_maths_stepper *s;
    assert_int_equal(fw_maths_stepper_new(arena, fw_maths_stepper_find(name), &ode, 1, &atol, &s),
                     FW_OK);
    fw_maths_stepper_start(s, 0, &start, 1);
    s->h_next = 1;
    assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
    assert_true(s->t == 1);
    const long double centre = (long double)k.centre, width = (long double)k.width;
    const long double truth = integral(1 - centre, width) + integral(centre, width);
    double off = (double)fabsl((long double)s->y[0] - truth);
    fw_maths_stepper_free(s);
    fw_arena_free(arena);
    return off;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* anywhere in the step, and up to 30 steps beside it; as sharp as 1e-6 of the step, as blunt as 3.
   Below 1e-13 all is rounding. */
static void bound(const char *name, double median) {
    enum { COUNT = 4000 };
    static double ratio[COUNT];
    int n = 0, order = fw_maths_stepper_find(name)->order;
    uint64_t seed = 7;
    for (int c = 0; c < COUNT; c++) {
        double beside = pow(10, -5 + 6.5 * rig_random(&seed)), where = rig_random(&seed);
        near_zero k = {.centre = where < 0.5    ? 2 * where
                                 : where < 0.75 ? -beside
                                                : 1 + beside,
                       .width = pow(10, -6 + 6.5 * rig_random(&seed))};
        double most = fw_dynamics_near_zero_error(0, 1, k.centre, k.width, order),
               off = one_step(name, k);
        double rounding = 1e-14 * (2 + fabs(k.centre));
        if (off > most + rounding)
            fail_msg("%s: %.3g at centre %g, width %g where %.3g are allowed", name, off, k.centre,
                     k.width, most);
        if (off > 100 * rounding) ratio[n++] = most / off;
    }
    qsort(ratio, (size_t)n, sizeof *ratio, by_size);
    print_message("%s: of %d, bound over error %.2g at least, %.2g in the median\n", name, n,
                  ratio[0], ratio[n / 2]);
    assert_true(n > COUNT / 2);
    assert_true(ratio[n / 2] < median);
}

static void test_bound(void **state) {
    (void)state;
    bound("dop853", 50);
    bound("dopri5", 50);
    bound("radau5", 50);
    bound("gsl-rkf45", 50);
    bound("gsl-rk8pd", 80);
}

/* the same of any interval: it goes with the square of its length, and from either side */
static void test_scales(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int c = 0; c < 1000; c++) {
        double a = rig_random(&seed), h = rig_random(&seed), at = 4 * rig_random(&seed) - 2;
        double w = pow(10, -6 * rig_random(&seed)),
               unit = fw_dynamics_near_zero_error(0, 1, at, w, 8);
        double moved = fw_dynamics_near_zero_error(a, a + h, a + h * at, h * w, 8) / (h * h);
        double turned = fw_dynamics_near_zero_error(0, 1, 1 - at, w, 8);
        assert_true(fabs(moved - unit) <= 1e-6 * unit + 1e-18);
        assert_true(fabs(turned - unit) <= 1e-6 * unit + 1e-18);
        assert_true(fw_dynamics_near_zero_error(0, 1, at, 2 * w, 8) <= unit || at <= 0 || at >= 1 ||
                    w < 0.1);
    }
    assert_true(fw_dynamics_near_zero_error(0, 1, 2, 0, 8) == 0); /* a straight line */
    assert_near(fw_dynamics_near_zero_error(0, 1, 0.5, 0, 8), 0.5, 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bound),
        cmocka_unit_test(test_scales),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
