/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every integrator of the table keeps: ends, restarts, projection, failures, memory, bits. */
#include "ode_problems.h"
#include <float.h>

static fw_maths_stepper *started(fw_arena *arena, const fw_maths_stepper_row *row, const problem *p,
                                 double rtol, double t_end) {
    double y[8];
    fw_maths_stepper *s = new_stepper(arena, row, &p->ode, rtol);
    p->exact(0, y);
    fw_maths_stepper_start(s, 0, y, t_end);
    return s;
}

static void test_table(void **state) {
    (void)state;
    size_t count;
    const fw_maths_stepper_row *const *table = fw_maths_stepper_table(&count);
    assert_int_equal(count, 9);
    for (size_t i = 0; i < count; i++) {
        assert_ptr_equal(fw_maths_stepper_find(table[i]->name), table[i]);
        assert_true(strlen(table[i]->summary) > 10);
    }
    assert_null(fw_maths_stepper_find("euler"));
}

static void test_wrong_input(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double atol[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    fw_maths_stepper *s;
    FOR_EACH_ROW(row, second_order) {
        fw_maths_ode ode = second_order.ode;
        ode.controlled = 6; /* more than there are */
        assert_int_equal(fw_maths_stepper_new(arena, row, &ode, 1e-6, atol, &s), FW_INPUT);
        ode = second_order.ode;
        ode.positions = 3; /* 2 x 3 > controlled */
        assert_int_equal(fw_maths_stepper_new(arena, row, &ode, 1e-6, atol, &s), FW_INPUT);
        ode.n = ode.controlled = ode.positions = 0;
        assert_int_equal(fw_maths_stepper_new(arena, row, &ode, 1e-6, atol, &s), FW_INPUT);
        assert_null(s);
    }
    assert_int_equal(fw_maths_stepper_new(arena, fw_maths_stepper_find("generalised-alpha"),
                                          &first_order.ode, 1e-6, atol, &s),
                     FW_INPUT);
    fw_maths_stepper_free(NULL);
    fw_arena_free(arena);
}

/* steps join, the last one ends exactly at t_end, dense output and component() fit the ends and
   each other, and component()'s slope is the derivative */
static void ends_and_components(const problem *p, double rtol) {
    FOR_EACH_ROW(row, *p) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s = started(arena, row, p, rtol, 3.7);
        double before = 0, y[8], value, slope, low, high, unused;
        int n = p->ode.n;
        if (row->fixed_step) s->h_fixed = 0.1, fw_maths_stepper_start(s, 0, s->y, 3.7);
        while (s->t < s->t_end) {
            assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
            assert_true(s->t_old == before && s->t > s->t_old && s->h == s->t - s->t_old);
            before = s->t;
            for (int side = 0; side < 2; side++) {
                const double *want = side ? s->y : s->y_old;
                fw_maths_stepper_dense(s, side, y);
                for (int c = 0; c < n; c++)
                    assert_near(y[c], want[c], 1e-13 * (1 + fabs(want[c])));
            }
            for (double theta = 0.05; theta < 1; theta += 0.3) {
                fw_maths_stepper_dense(s, theta, y);
                for (int c = 0; c < n; c++) {
                    fw_maths_stepper_component(s, c, 2, -1, 5, theta, &value, &slope);
                    assert_near(value, 2 * y[c], 1e-13 * (1 + fabs(y[c])));
                    int other = (c + 1) % n;
                    fw_maths_stepper_component(s, c, 1.5, other, -0.5, theta, &value, &slope);
                    assert_near(value, 1.5 * y[c] - 0.5 * y[other], 1e-13 * (1 + fabs(value)));
                    const double d = 1e-5;
                    fw_maths_stepper_component(s, c, 1.5, other, -0.5, theta - d, &low, &unused);
                    fw_maths_stepper_component(s, c, 1.5, other, -0.5, theta + d, &high, &unused);
                    /* rounding of the difference, and its own error d^2 p'''/6 */
                    assert_near((high - low) / (2 * d), slope, 1e-9 + 1e-7 * fabs(slope));
                }
            }
        }
        assert_true(s->t == 3.7);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}
static void test_ends_and_components(void **state) {
    (void)state;
    ends_and_components(&first_order, 1e-6);
    ends_and_components(&second_order, 1e-6);
}

/* before the first step there is a dense output too: the start itself */
static void test_before_the_first_step(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s = started(arena, row, &second_order, 1e-6, 1);
        double y[8], value, slope;
        fw_maths_stepper_dense(s, 0.5, y);
        assert_memory_equal(y, s->y, 5 * sizeof *y);
        fw_maths_stepper_component(s, 0, 2, 1, 1, 0.5, &value, &slope);
        assert_true(value == 2 * y[0] + y[1] && slope == 0);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* far from t = 0 a short rest is still gone through: a first step that is a share of it would leave
   t where it is */
static void test_short_and_late(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        if (row->fixed_step) continue; /* its step is given */
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s = new_stepper(arena, row, &second_order.ode, 1e-6);
        double y[8] = {0};
        const double end = 1000 * (1 + 300 * DBL_EPSILON);
        fw_maths_stepper_start(s, 1000, y, end);
        for (int k = 0; k < 1000 && s->t < end; k++)
            assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
        assert_true(s->t == end);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* every evaluation is counted */
static void test_counts(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        long calls = 0;
        fw_maths_ode ode = second_order.ode;
        ode.context = &calls;
        fw_maths_stepper *s = new_stepper(arena, row, &ode, 1e-6);
        double y[8];
        second_exact(0, y);
        fw_maths_stepper_start(s, 0, y, 2);
        assert_int_equal(run_to_end(s), FW_ODE_STEP);
        fw_maths_stepper_dense(s, 0.3, y);
        assert_int_equal(calls, s->rhs);
        assert_true(s->steps > 0 && s->rejected >= 0);
        assert_true((s->jacobians > 0) == row->implicit);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* the hook keeps the pendulum on its circle to round-off, with velocities along it, and the motion
   right; A01 of the benchmarks: released at x = -1, y = 0; period 2.3678..., values at 10 s from
   elliptic functions */
static void test_projection(void **state) {
    (void)state;
    const fw_maths_ode ode = {
        .rhs = pendulum_rhs, .project = pendulum_project, .n = 4, .controlled = 4, .positions = 2};
    const double start[4] = {-1, 0, 0, 0};
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        double rtol = row->order < 4 ? 1e-6 : 1e-9, y[4], drift = 0, energy = 0;
        fw_maths_stepper *s = new_stepper(arena, row, &ode, rtol);
        s->h_fixed = 1e-3;
        fw_maths_stepper_start(s, 0, start, 10);
        while (s->t < s->t_end) {
            assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
            drift = fmax(drift, fabs(hypot(s->y[0], s->y[1]) - 1));
            drift = fmax(drift, fabs(s->y[0] * s->y[2] + s->y[1] * s->y[3]) / 5);
            energy = fmax(energy,
                          fabs((s->y[2] * s->y[2] + s->y[3] * s->y[3]) / 2 + pendulum_g * s->y[1]));
            fw_maths_stepper_dense(s, 1, y); /* stays continuous with the projected end */
            for (int c = 0; c < 4; c++)
                assert_near(y[c], s->y[c], 1e-13 * 5);
        }
        assert_true(drift < 1e-15);
        double error = fmax(fabs(s->y[0] + 0.2750874625761168600544),
                            fabs(s->y[1] + 0.9614192050991250642651));
        double allowed = row->order < 4 ? 2e-2 : 2e-6;
        if (!(error < allowed && energy < 10 * allowed))
            fail_msg("%s: off by %g, energy by %g", row->name, error, energy);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* a load that jumps at t = 1: the run ends there and starts again */
static void switched(void *context, double t, const double *y, double *f) {
    (void)t;
    f[0] = y[1];
    f[1] = -y[0] + *(const double *)context;
}
static void test_restart_at_a_jump(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        double load = 1, y[2] = {0, 0}, rtol = row->order < 4 ? 1e-7 : 1e-9;
        const fw_maths_ode ode = {
            .context = &load, .rhs = switched, .n = 2, .controlled = 2, .positions = 1};
        fw_maths_stepper *s = new_stepper(arena, row, &ode, rtol);
        s->h_fixed = 1e-2;
        fw_maths_stepper_start(s, 0, y, 1);
        assert_int_equal(run_to_end(s), FW_ODE_STEP);
        long steps = s->steps, rhs = s->rhs;
        load = -2;
        memcpy(y, s->y, sizeof y);
        fw_maths_stepper_start(s, 1, y, 4);
        assert_true(s->steps == steps && s->rhs > rhs); /* counts go on */
        assert_int_equal(run_to_end(s), FW_ODE_STEP);
        /* u = 1 - cos t, then u + 2 = A cos(t - 1) + B sin(t - 1) */
        double a = 1 - cos(1) + 2, b = sin(1), want = a * cos(3) + b * sin(3) - 2;
        double allowed = row->order < 4 ? 3e-4 : row->variable_order ? 3e-6 : 1e-7;
        if (!(fabs(s->y[0] - want) < allowed))
            fail_msg("%s: %g instead of %g", row->name, s->y[0], want);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* u'' = 6 u^2 with u = 1/(1 - t)^2 ends at t = 1; and an f that is not a number after 0.5 */
static void blows_up(void *context, double t, const double *y, double *f) {
    (void)context;
    (void)t;
    f[0] = y[1];
    f[1] = 6 * y[0] * y[0];
}
static void not_a_number(void *context, double t, const double *y, double *f) {
    (void)context;
    f[0] = y[1];
    f[1] = t > 0.5 ? (double)NAN : 1;
}
static void test_failures(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        const fw_maths_ode bad = {.rhs = not_a_number, .n = 2, .controlled = 2, .positions = 1};
        const fw_maths_ode pole = {.rhs = blows_up, .n = 2, .controlled = 2, .positions = 1};
        const double rest[2] = {0, 0}, one[2] = {1, 2};
        fw_maths_stepper *s = new_stepper(arena, row, &bad, 1e-6);
        fw_maths_stepper_start(s, 0, rest, 2);
        assert_int_equal(run_to_end(s), FW_ODE_NAN);
        assert_true(s->t <= 0.5 && s->t > 0.45);
        fw_maths_stepper_start(s, 0.7, rest, 2); /* from the start */
        assert_int_equal(fw_maths_stepper_step(s), FW_ODE_NAN);
        assert_true(s->t == 0.7);
        fw_maths_stepper_free(s);

        s = new_stepper(arena, row, &pole, 1e-6);
        fw_maths_stepper_start(s, 0, one, 2);
        assert_int_equal(run_to_end(s), row->fixed_step ? FW_ODE_NAN : FW_ODE_SMALL);
        assert_near(s->t, 1, row->fixed_step ? 0.01 : row->order < 4 ? 1e-3 : 1e-4);
        assert_true(fw_maths_ode_finite(s->y, 2));
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* a projection that refuses everything after 0.5 */
static bool refuses(void *context, double t, double *y, double *f) {
    second_rhs(context, t, y, f);
    return t <= 0.5;
}
static void test_refused_projection(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_ode ode = second_order.ode;
        ode.project = refuses;
        fw_maths_stepper *s = new_stepper(arena, row, &ode, 1e-4);
        double y[8];
        second_exact(0, y);
        fw_maths_stepper_start(s, 0, y, 2);
        assert_int_equal(run_to_end(s), FW_ODE_SMALL);
        assert_near(s->t, 0.5, row->fixed_step ? 3e-3 : 1e-9);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

/* one test of the arena's count per integrator: nothing after creation. GSL's malloc is not seen by
   it: see the head of gsl_steppers.c */
static void test_no_allocation(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *s = started(arena, row, &second_order, 1e-6, 5);
        long before = fw_arena_count();
        double y[8], value, slope;
        while (s->t < s->t_end) {
            assert_int_equal(fw_maths_stepper_step(s), FW_ODE_STEP);
            fw_maths_stepper_dense(s, 0.5, y);
            fw_maths_stepper_component(s, 0, 1, 1, -1, 0.5, &value, &slope);
        }
        second_exact(5, y);
        fw_maths_stepper_start(s, 5, y, 6);
        assert_int_equal(run_to_end(s), FW_ODE_STEP);
        assert_int_equal(fw_arena_count(), before);
        fw_maths_stepper_free(s);
        fw_maths_stepper_free(s);
        fw_arena_free(arena);
    }
}

static void test_out_of_memory(void **state) {
    (void)state;
    const double atol[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    FOR_EACH_ROW(row, second_order) {
        fw_maths_stepper *s;
        fw_status status = FW_NOMEM;
        long n = 1;
        for (; n < 100 && status != FW_OK; n++) {
            fw_arena *arena = fw_arena_new(0);
            fw_arena_fail_at(n, 0);
            status = fw_maths_stepper_new(arena, row, &second_order.ode, 1e-6, atol, &s);
            fw_arena_fail_at(0, 0);
            assert_true(status == FW_OK ? s != NULL : status == FW_NOMEM && s == NULL);
            fw_maths_stepper_free(s);
            fw_arena_free(arena);
        }
        assert_true(n > 8 && n < 100);
    }
}

/* the same input gives the same bits, also after another problem went through the same stepper */
static void test_same_bits(void **state) {
    (void)state;
    FOR_EACH_ROW(row, second_order) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_stepper *one = started(arena, row, &second_order, 1e-6, 3);
        fw_maths_stepper *two = started(arena, row, &second_order, 1e-6, 1);
        double y[2][8], start[8];
        assert_int_equal(run_to_end(two), FW_ODE_STEP);
        second_exact(0, start);
        fw_maths_stepper_start(two, 0, start, 3);
        while (one->t < one->t_end) {
            assert_int_equal(fw_maths_stepper_step(one), FW_ODE_STEP);
            assert_int_equal(fw_maths_stepper_step(two), FW_ODE_STEP);
            fw_maths_stepper_dense(one, 0.3, y[0]);
            fw_maths_stepper_dense(two, 0.3, y[1]);
            assert_memory_equal(one->y, two->y, 5 * sizeof(double));
            assert_memory_equal(y[0], y[1], 5 * sizeof(double));
            assert_true(one->t == two->t && one->h_next == two->h_next);
        }
        fw_maths_stepper_free(one);
        fw_maths_stepper_free(two);
        fw_arena_free(arena);
    }
}

/* far from t = 0 steps are differences of the stored times: the phase does not wander */
static void test_late_times(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double late = 1e7;
    const fw_maths_ode ode = {.context = &(double){0}, .rhs = switched, .n = 2, .controlled = 2};
    const double start[2] = {1, 0};
    fw_maths_stepper *s = new_stepper(arena, &fw_maths_dop853_row, &ode, 1e-12);
    fw_maths_stepper_start(s, late, start, late + 100);
    assert_int_equal(run_to_end(s), FW_ODE_STEP);
    assert_near(s->y[0], cos(100), 1e-10); /* ulp of 1e7: 2e-9 per step */
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_wrong_input),
        cmocka_unit_test(test_ends_and_components),
        cmocka_unit_test(test_before_the_first_step),
        cmocka_unit_test(test_short_and_late),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_projection),
        cmocka_unit_test(test_restart_at_a_jump),
        cmocka_unit_test(test_failures),
        cmocka_unit_test(test_refused_projection),
        cmocka_unit_test(test_no_allocation),
        cmocka_unit_test(test_out_of_memory),
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_late_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
