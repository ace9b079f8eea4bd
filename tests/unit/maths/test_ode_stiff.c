/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiff problems, and what they cost. */
#include "ode_problems.h"

/* van der Pol, y'' = ((1 - y^2) y' - y)/1e-6 */
static void van_der_pol(void *context, double t, const double *y, double *f) {
    (void)context;
    (void)t;
    f[0] = y[1];
    f[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) / 1e-6;
}

/* end values from y(0) = (2, 0) at t = 2: Test Set for IVP Solvers (Mazzia and Magherini), problem
   VDPOL, 16 digits */
static void test_van_der_pol(void **state) {
    (void)state;
    const fw_maths_ode ode = {.rhs = van_der_pol, .n = 2, .controlled = 2};
    const double start[2] = {2, 0}, want[2] = {0.1706167732170483e1, -0.8928097010247975};
    for (double rtol = 1e-4; rtol > 1e-11; rtol /= 10) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s = new_stepper(arena, &fw_maths_radau5_row, &ode, rtol);
        fw_maths_stepper_start(s, 0, start, 2);
        assert_int_equal(run_to_end(s), FW_ODE_STEP);
        assert_relative(s->y[0], want[0], rtol);
        assert_relative(s->y[1], want[1], rtol);
        fw_arena_free(arena);
    }
}

/* the same from (2, -0.6) with tolerances of 1e-4: Assimulo's documentation of its Radau5 (van der
   Pol example) states 241 steps, 160 Jacobians, 251 decompositions, 7 error test failures and 2233
   evaluations without those for Jacobians. Ours may differ by a tenth. */
static void test_van_der_pol_costs(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_maths_ode ode = {.rhs = van_der_pol, .n = 2, .controlled = 2};
    const double start[2] = {2, -0.6};
    fw_maths_stepper *s = new_stepper(arena, &fw_maths_radau5_row, &ode, 1e-4);
    fw_maths_stepper_start(s, 0, start, 2);
    assert_int_equal(run_to_end(s), FW_ODE_STEP);
    assert_near((double)s->steps, 241, 24);
    assert_near((double)s->jacobians, 160, 16);
    assert_near((double)s->factorisations / 2, 251, 25); /* one real and one complex each */
    assert_near((double)(s->rhs - 2 * s->jacobians), 2233, 223);
    fw_arena_free(arena);
}

/* Robertson's kinetics to t = 1e11; Test Set for IVP Solvers, problem ROBER */
static void robertson(void *context, double t, const double *y, double *f) {
    (void)context;
    (void)t;
    f[0] = -0.04 * y[0] + 1e4 * y[1] * y[2];
    f[2] = 3e7 * y[1] * y[1];
    f[1] = -f[0] - f[2];
}
static void robertson_jacobian(void *context, double t, const double *y, double *j) {
    (void)context;
    (void)t;
    const double a = 1e4 * y[2], b = 1e4 * y[1], c = 6e7 * y[1];
    const double rows[9] = {-0.04, a, b, 0.04, -a - c, -b, 0, c, 0};
    memcpy(j, rows, sizeof rows);
}
static void test_robertson(void **state) {
    (void)state;
    const double start[3] = {1, 0, 0};
    const double want[3] = {0.2083340149701255e-07, 0.8333360770334713e-13, 0.9999999791665050};
    for (int given = 0; given < 2; given++)
        for (double rtol = 1e-6; rtol > 1e-11; rtol /= 100) {
            fw_arena *arena = fw_arena_new(0);
            const fw_maths_ode ode = {.rhs = robertson,
                                      .n = 3,
                                      .controlled = 3,
                                      .jacobian = given ? robertson_jacobian : NULL};
            const double atol[3] = {1e-6 * rtol, 1e-10 * rtol, 1e-6 * rtol};
            fw_maths_stepper *s;
            assert_int_equal(
                fw_maths_stepper_new(arena, &fw_maths_radau5_row, &ode, rtol, atol, &s), FW_OK);
            fw_maths_stepper_start(s, 0, start, 1e11);
            assert_int_equal(run_to_end(s), FW_ODE_STEP);
            for (int c = 0; c < 3; c++)
                assert_relative(s->y[c], want[c], 10 * rtol);
            assert_true(s->steps < 2000);
            fw_arena_free(arena);
        }
}

/* u1 swings with 1 rad/s; u2 follows it on a spring of (1e6)^2, at rest on its slow path u2 =
   u1 w^2/(w^2 - 1) */
static const double fast = 1e6;
static void led(void *context, double t, const double *y, double *f) {
    (void)context;
    (void)t;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = -y[0];
    f[3] = -fast * fast * (y[1] - y[0]);
}
static void test_a_fast_one_at_rest(void **state) {
    (void)state;
    const fw_maths_ode ode = {.rhs = led, .n = 4, .controlled = 4, .positions = 2};
    const double path = 1 / (1 - 1 / (fast * fast)), start[4] = {1, path, 0, 0};
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        double rtol = row->order < 4 ? 1e-5 : 1e-6, y[4];
        fw_maths_stepper *s = new_stepper(arena, row, &ode, rtol);
        s->h_fixed = 1e-3;
        fw_maths_stepper_start(s, 0, start, 10);
        fw_maths_ode_result result = FW_ODE_STEP;
        while (s->t < s->t_end && s->steps < 3000 && result == FW_ODE_STEP)
            result = fw_maths_stepper_step(s);
        bool stiff =
            row == &fw_maths_radau5_row || row == fw_maths_stepper_find("generalised-alpha");
        if (stiff && !(s->t == 10 && result == FW_ODE_STEP))
            fail_msg("%s: only %g in %ld steps", row->name, s->t, s->steps);
        if (!row->implicit) assert_true(s->t < 1); /* explicit ones need millions of steps */
        if (stiff) {
            double allowed = row->order < 4 ? 2e-2 : 1e-5;
            assert_near(s->y[0], cos(10), allowed);
            assert_near(s->y[1], cos(10), allowed);
            /* the dense output does not multiply the fast one's error with its stiffness */
            fw_maths_stepper_dense(s, 0.5, y);
            double t = s->t_old + 0.5 * s->h;
            assert_near(y[1], cos(t), 3 * allowed);
            assert_near(y[3], -sin(t), 10 * allowed);
        }
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* radau5 on the pendulum (index 1, projected): the error at the end is proportional to rtol */
static void test_tolerance_proportionality(void **state) {
    (void)state;
    const fw_maths_ode ode = {
        .rhs = pendulum_rhs, .project = pendulum_project, .n = 4, .controlled = 4, .positions = 2};
    const double start[4] = {-1, 0, 0, 0};
    double first = 0;
    for (double rtol = 1e-4; rtol > 0.9e-11; rtol /= 10) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s = new_stepper(arena, &fw_maths_radau5_row, &ode, rtol);
        fw_maths_stepper_start(s, 0, start, 10);
        assert_int_equal(run_to_end(s), FW_ODE_STEP);
        double ratio =
            hypot(s->y[0] + 0.2750874625761168600544, s->y[1] + 0.9614192050991250642651) / rtol;
        if (first == 0) first = ratio;
        if (!(ratio > first / 5 && ratio < 5 * first && ratio < 10))
            fail_msg("error / rtol is %g at %g, and was %g at 1e-4", ratio, rtol, first);
        fw_arena_free(arena);
    }
}

/* generalised-alpha: order 2 in equal steps, for every spectral radius, and with steps that change
   by a factor 2 all the time */
static double alpha_error(double rho, double h, bool changing) {
    fw_arena *arena = fw_arena_new(0);
    fw_maths_stepper *s =
        new_stepper(arena, fw_maths_stepper_find("generalised-alpha"), &second_order.ode, 1e-2);
    for (int c = 0; c < 4; c++)
        ((double *)(uintptr_t)s->atol)[c] = 10; /* refuses nothing */
    double y[8], worst = 0;
    s->spectral_radius = rho;
    second_exact(0, y);
    fw_maths_stepper_start(s, 0, y, 6);
    for (long i = 0; s->t < s->t_end; i++) {
        s->h_next = changing && i % 2 ? h / 2 : h;
        assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
    }
    second_exact(6, y);
    for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs(s->y[c] - y[c]));
    fw_arena_free(arena);
    return worst;
}
static void test_generalised_alpha_order(void **state) {
    (void)state;
    for (int i = 0; i <= 5; i++)
        for (int changing = 0; changing < 2; changing++) {
            double rho = i / 5.0, coarse = alpha_error(rho, 0.02, changing);
            double order = log2(coarse / alpha_error(rho, 0.01, changing));
            if (!(order > 1.9 && order < 2.1))
                fail_msg("rho %g, changing %d: order %g", rho, changing, order);
        }
}

/* and its error estimate is the local error: after a few equal steps the controller's factor
   0.9 err^(-1/3) gives err, here to be compared with the growth of the true error in that step,
   which exceeds what the step before left by the local error alone (h << 1) */
static void test_generalised_alpha_estimate(void **state) {
    (void)state;
    for (double h = 0.02; h > 0.004; h /= 2) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s =
            new_stepper(arena, fw_maths_stepper_find("generalised-alpha"), &second_order.ode,
                        0.5 * h * h * h); /* err far from 1: the factor is not cut off */
        double y[8], before[8];
        second_exact(0.3, y);
        fw_maths_stepper_start(s, 0.3, y, 5);
        s->h_max = h;
        for (int i = 0; i < 4; i++) {
            second_exact(s->t, y);
            for (int c = 0; c < 4; c++)
                before[c] = s->y[c] - y[c];
            s->h_next = h;
            assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
            assert_near(s->h, h, 1e-12);
        }
        double seen = pow(0.9 * s->h / s->h_next, 3), growth[8] = {0};
        second_exact(s->t, y);
        for (int c = 0; c < 4; c++)
            growth[c] = s->y[c] - y[c] - before[c];
        double ratio = seen / fw_maths_ode_norm(s, growth, s->y_old, s->y);
        if (!(s->h_next != s->h && ratio > 0.9 && ratio < 1.1))
            fail_msg("estimate / error is %g at h = %g", ratio, h);
        fw_arena_free(arena);
    }
}

/* ---- neighbours: most columns of the Jacobian have no row in common ---- */

enum { CHAIN = 40 };

/* masses that hold their neighbours by stiff springs, damped, one pushed; from t = 0.5 on another spring joins two that are far
   apart */
static void chain(void *context, double t, const double *y, double *f) {
    const double *u = y, *v = y + CHAIN, far = t > 0.5 && *(const bool *)context ? 3e4 : 0;
    for (int i = 0; i < CHAIN; i++) {
        const double left = i > 0 ? u[i - 1] : 0, right = i + 1 < CHAIN ? u[i + 1] : 0,
                     a = u[i] - left, b = u[i] - right,
                     c = v[i] - (i > 0 ? v[i - 1] : 0), d = v[i] - (i + 1 < CHAIN ? v[i + 1] : 0);
        f[i] = v[i];
        f[CHAIN + i] = -1e5 * (a + b + a * a * a + b * b * b) - 2e3 * (c + d);
    }
    f[CHAIN + 20] += 1e4 * cos(3 * t);
    f[CHAIN + 3] -= far * (u[3] - u[33]);
    f[CHAIN + 33] += far * (u[3] - u[33]);
}

static fw_maths_stepper *many_stepper(fw_arena *arena, const fw_maths_ode *ode, double rtol) {
    fw_maths_stepper *s = NULL;
    double *atol = fw_arena_array(arena, double, (size_t)ode->n);
    assert_non_null(atol);
    for (int i = 0; i < ode->n; i++)
        atol[i] = rtol;
    assert_int_equal(fw_maths_stepper_new(arena, &fw_maths_radau5_row, ode, rtol, atol, &s), FW_OK);
    return s;
}

/* Found together columns are those that are found one by one, so that the steps are the same but for round-off; a coupling that
   comes later is seen */
static void test_neighbours(void **state) {
    (void)state;
    for (int far = 0; far < 2; far++) {
        bool joins = far != 0;
        const fw_maths_ode ode = {
            .rhs = chain, .context = &joins, .n = 2 * CHAIN, .controlled = 2 * CHAIN, .positions = CHAIN};
        const double start[2 * CHAIN] = {0};
        double end[2][2 * CHAIN];
        long rhs[2], jacobians[2];
        for (int apart = 0; apart < 2; apart++) {
            fw_arena *arena = fw_arena_new(0);
            fw_maths_stepper *s = many_stepper(arena, &ode, 1e-7);
            assert_non_null(s->apart);
            if (!apart) s->apart = NULL;
            fw_maths_stepper_start(s, 0, start, 1);
            assert_int_equal(run_to_end(s), FW_ODE_STEP);
            memcpy(end[apart], s->y, sizeof end[apart]);
            rhs[apart] = s->rhs, jacobians[apart] = s->jacobians;
            if (apart) assert_true(s->apart->groups > 0 && s->apart->groups < 2 * CHAIN / 4);
            fw_arena_free(arena);
        }
        assert_true(jacobians[1] > 5 && labs(jacobians[1] - jacobians[0]) <= 1 + jacobians[0] / 10);
        /* eighty columns by one evaluation each, or a group at a time */
        assert_true(rhs[0] - rhs[1] > 40 * (jacobians[1] - (far ? 4 : 2)));
        for (int i = 0; i < 2 * CHAIN; i++)
            assert_near(end[1][i], end[0][i], 1e-6 * (1 + fabs(end[0][i])));
    }
}

/* where every column has a row in common with every other they stay one by one */
static void all_together(void *context, double t, const double *y, double *f) {
    (void)context, (void)t;
    double sum = 0;
    for (int i = 0; i < 60; i++)
        sum += y[i];
    for (int i = 0; i < 60; i++)
        f[i] = -1e4 * (y[i] - 1) - 100 * sum;
}

static void test_all_together(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_maths_ode ode = {.rhs = all_together, .n = 60, .controlled = 60};
    const double start[60] = {0};
    fw_maths_stepper *s = many_stepper(arena, &ode, 1e-6);
    fw_maths_stepper_start(s, 0, start, 1);
    assert_int_equal(run_to_end(s), FW_ODE_STEP);
    assert_int_equal(s->apart->groups, FW_ODE_TOGETHER);
    for (int i = 0; i < 60; i++) /* -1e4 (y - 1) - 6000 y = 0 */
        assert_near(s->y[i], 1e4 / 1.6e4, 1e-5);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_van_der_pol),
        cmocka_unit_test(test_van_der_pol_costs),
        cmocka_unit_test(test_robertson),
        cmocka_unit_test(test_neighbours),
        cmocka_unit_test(test_all_together),
        cmocka_unit_test(test_a_fast_one_at_rest),
        cmocka_unit_test(test_tolerance_proportionality),
        cmocka_unit_test(test_generalised_alpha_order),
        cmocka_unit_test(test_generalised_alpha_estimate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
