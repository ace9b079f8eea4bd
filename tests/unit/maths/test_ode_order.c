/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The orders that the rows of the integrators' table claim. */
#include "ode_problems.h"

/* largest error of the controlled components at t = 6 (and of the quadrature), and the steps it
   took; h > 0: in steps of this size, with tolerances that refuse none */
static double error_at_end(const fw_maths_stepper_row *row, const problem *p, double rtol, double h,
                           double *steps, double *quadrature) {
    fw_arena *arena = fw_arena_new(0);
    fw_maths_stepper *s = new_stepper(arena, row, &p->ode, rtol);
    double y[8], worst = 0;
    s->h_fixed = h;
    p->exact(0, y);
    fw_maths_stepper_start(s, 0, y, 6);
    while (s->t < s->t_end) {
        if (h > 0) s->h_next = h;
        assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
    }
    assert_true(s->t == 6);
    p->exact(6, y);
    for (int c = 0; c < p->ode.controlled; c++)
        worst = fmax(worst, fabs(s->y[c] - y[c]));
    *quadrature = fabs(s->y[p->ode.controlled] - y[p->ode.controlled]);
    *steps = (double)s->steps;
    fw_maths_stepper_free(s);
    fw_arena_free(arena);
    return worst;
}

/* error against number of steps: a straight line with slope -order in logarithms. Explicit methods
   with equal steps; implicit ones between two tolerances, since theirs decide on Newton's accuracy
   too. Methods of variable order have no slope: their error falls with the tolerance. */
static void convergence(const problem *p) {
    FOR_EACH_ROW(row, *p) {
        double steps[2], quadrature[2], coarse, fine, loose = 1, tight = 1,
                                                      h = row->order > 5 ? 0.3 : 0.1;
        if (row->implicit || row->variable_order) {
            h = 0;
            loose = row->order < 4 ? 1e-5 : 1e-7;
            tight = row->order < 4 ? 1e-7 : 1e-10;
        }
        coarse = error_at_end(row, p, loose, h, &steps[0], &quadrature[0]);
        fine = error_at_end(row, p, tight, h / 2, &steps[1], &quadrature[1]);
        double order = log(coarse / fine) / log(steps[1] / steps[0]);
        if (row->variable_order) {
            assert_true(coarse < 1e4 * loose && fine < 1e4 * tight);
            assert_true(quadrature[1] < 1e4 * tight);
            continue;
        }
        if (!(order > row->order - 0.5 && order < row->order + 1.2))
            fail_msg("%s: order %.2f instead of %d (%g in %g steps, %g in %g)", row->name, order,
                     row->order, coarse, steps[0], fine, steps[1]);
        order = log(quadrature[0] / quadrature[1]) / log(steps[1] / steps[0]);
        if (!(order > row->order - 0.5) && quadrature[1] > 1e-14)
            fail_msg("%s: quadrature %g, then %g: order %.2f instead of %d", row->name,
                     quadrature[0], quadrature[1], order, row->order);
    }
}
static void test_first_order_problem(void **state) {
    (void)state;
    convergence(&first_order);
}
static void test_second_order_problem(void **state) {
    (void)state;
    convergence(&second_order);
}

/* one step from exact values: the error inside falls with h^(q + 1). Tolerances that do not refuse
   the step, and for implicit ones do not spoil Newton. */
static void one_step(const fw_maths_stepper_row *row, const problem *p, double h, double *worst) {
    fw_arena *arena = fw_arena_new(0);
    double y[8], want[8];
    fw_maths_stepper *s = new_stepper(arena, row, &p->ode, row->implicit ? 1e-2 : 1);
    s->h_fixed = s->h_max = h;
    memset(worst, 0, 8 * sizeof *worst);
    for (double t = 0; t < 3; t += 0.37) {
        p->exact(t, y);
        fw_maths_stepper_start(s, t, y, t + h);
        s->h_next = h;
        assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
        assert_near(s->h, h, 1e-12);
        for (double theta = 0.1; theta < 1; theta += 0.1) {
            fw_maths_stepper_dense(s, theta, y);
            p->exact(t + theta * h, want);
            for (int c = 0; c < p->ode.n; c++)
                worst[c] = fmax(worst[c], fabs(y[c] - want[c]));
        }
    }
    fw_maths_stepper_free(s);
    fw_arena_free(arena);
}

static void dense_convergence(const problem *p, double h) {
    FOR_EACH_ROW(row, *p) {
        double coarse[8], fine[8];
        one_step(row, p, h, coarse);
        one_step(row, p, h / 2, fine);
        for (int c = 0; c < p->ode.n; c++) {
            int claimed = c < p->ode.positions ? row->dense_order_u : row->dense_order;
            if (strcmp(row->name, "gsl-msadams") == 0) claimed = 1; /* its first step has order 1 */
            double order = log2(coarse[c] / fine[c]);
            if (!(order > claimed + 1 - 0.45) && fine[c] > 1e-14)
                fail_msg("%s: component %d inside a step of %g: %g, then %g: order %.2f, not %d",
                         row->name, c, h, coarse[c], fine[c], order, claimed + 1);
        }
    }
}
static void test_dense_order_first(void **state) {
    (void)state;
    dense_convergence(&first_order, 0.1);
}
static void test_dense_order_second(void **state) {
    (void)state;
    dense_convergence(&second_order, 0.2);
}

/* over a whole run the dense output is as good as the states at the ends, to a factor that the
   method's own steps explain; radau5 controls the order of its interpolant */
static void test_dense_follows_the_tolerance(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        if (row->fixed_step || row->order < 4) continue;
        double before = 0;
        for (double rtol = 1e-5; rtol > 1e-10; rtol /= 100) {
            fw_arena *arena = fw_arena_new(0);
            fw_maths_stepper *s = new_stepper(arena, row, &second_order.ode, rtol);
            double y[8], want[8], ends = 0, inside = 0;
            second_exact(0, y);
            fw_maths_stepper_start(s, 0, y, 10);
            while (s->t < s->t_end) {
                assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
                for (int i = 1; i <= 10; i++) {
                    double theta = i / 10.0;
                    fw_maths_stepper_dense(s, theta, y);
                    second_exact(s->t_old + theta * s->h, want);
                    for (int c = 0; c < 2; c++)
                        if (i == 10)
                            ends = fmax(ends, fabs(y[c] - want[c]));
                        else
                            inside = fmax(inside, fabs(y[c] - want[c]));
                }
            }
            if (!(inside < 20 * ends + 10 * rtol))
                fail_msg("%s at %g: %g inside, %g at the ends", row->name, rtol, inside, ends);
            if (before > 0) assert_true(inside < before);
            before = inside;
            fw_maths_stepper_free(s);
            fw_arena_free(arena);
        }
    }
}

/* beside cos t a stiff oscillator that is at rest but for rounding: u'' = -(300)^2 u */
static void at_rest_rhs(void *context, double t, const double *y, double *f) {
    (void)context;
    f[0] = y[2], f[1] = y[3];
    f[2] = -cos(t), f[3] = -9e4 * y[1];
}

/* a step that is 300 times too long for it ends within the tolerance; inside it stays as near to
   nothing, and the other component is as exact as before */
static void test_rounding_does_not_grow_inside(void **state) {
    (void)state;
    const char *names[] = {"dop853", "dopri5"};
    const fw_maths_ode ode = {.rhs = at_rest_rhs, .n = 4, .controlled = 4, .positions = 2};
    for (int k = 0; k < 2; k++) {
        fw_arena *arena = fw_arena_new(0);
        const fw_maths_stepper_row *row = fw_maths_stepper_find(names[k]);
        fw_maths_stepper *s = new_stepper(arena, row, &ode, 1e-3);
        double y[8] = {1, k ? 1e-22 : 1e-27}, inside = 0, ends = 0;
        fw_maths_stepper_start(s, 0, y, 1);
        s->h_next = 1;
        assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
        assert_near(s->h, 1, 0);
        ends = fabs(s->y[1]) + fabs(s->f[1]) * s->h;
        for (double theta = 0.05; theta < 1; theta += 0.05) {
            fw_maths_stepper_dense(s, theta, y);
            inside = fmax(inside, fabs(y[1]));
            assert_near(y[0], cos(theta), 2e-4);
        }
        assert_true(ends > 1e-16 && inside <= 4 * ends);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_first_order_problem),
        cmocka_unit_test(test_second_order_problem),
        cmocka_unit_test(test_dense_order_first),
        cmocka_unit_test(test_dense_order_second),
        cmocka_unit_test(test_dense_follows_the_tolerance),
        cmocka_unit_test(test_rounding_does_not_grow_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
