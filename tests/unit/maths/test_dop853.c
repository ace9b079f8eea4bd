/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/dop853.h"
#include "maths/dop853_table.h"
#include "test.h"
#include <stdlib.h>

/* row sums are c_i; b, e5 and the third-order weights meet their quadrature conditions */
static void test_order_conditions(void **state) {
    (void)state;
    for (int i = 1; i < DOP_ALL; i++) {
        double sum = 0;
        for (int j = dop_row[i]; j < dop_row[i + 1]; j++) {
            sum += dop_a[j].a;
            assert_true(dop_a[j].stage < i);
        }
        assert_near(sum, dop_c[i], 1e-14);
    }
    for (int power = 0; power < 8; power++) {
        double sum = 0, five = 0, three = 0;
        for (int j = dop_row[12]; j < dop_row[13]; j++)
            sum += dop_a[j].a * pow(dop_c[dop_a[j].stage], power);
        for (int j = 0; j < 8; j++)
            five += dop_e5[j].a * pow(dop_c[dop_e5[j].stage], power);
        for (int j = 0; j < 3; j++)
            three += dop_b3[j].a * pow(dop_c[dop_b3[j].stage], power);
        assert_near(sum, 1.0 / (power + 1), 1e-14);
        if (power < 5) assert_near(five, 0, 1e-14);
        if (power < 3) assert_near(three, 1.0 / (power + 1), 1e-14);
    }
    /* sum b_i a_ij c_j^k = 1/((k+1)(k+2)): trees of height two */
    for (int k = 1; k < 7; k++) {
        double sum = 0;
        for (int i = dop_row[12]; i < dop_row[13]; i++) {
            int s = dop_a[i].stage;
            double inner = 0;
            for (int j = dop_row[s]; j < dop_row[s + 1]; j++)
                inner += dop_a[j].a * pow(dop_c[dop_a[j].stage], k);
            sum += dop_a[i].a * inner;
        }
        assert_near(sum, 1.0 / ((k + 1) * (k + 2)), 1e-13);
    }
}

/* y1' = y1 cos t, y2' = -y2^2 with solutions exp(sin t), 1/(1 + t); y3' = y1 y2 is a quadrature */
static void problem(void *context, double t, const double *y, double *f) {
    ++*(long *)context;
    f[0] = y[0] * cos(t);
    f[1] = -y[1] * y[1];
    f[2] = y[0] * y[1];
}

static fw_dop853 *started(fw_arena *arena, double rtol, long *count, const double *atol) {
    const fw_ode ode = {count, problem, NULL, 3, 2};
    const double start[3] = {1, 1, 0};
    fw_dop853 *s;
    assert_int_equal(fw_dop853_new(arena, &ode, rtol, atol, &s), FW_OK);
    fw_dop853_start(s, 0, start, 5);
    return s;
}

static void test_accuracy_and_dense_output(void **state) {
    (void)state;
    double before = 0;
    for (double rtol = 1e-4; rtol > 1e-13; rtol /= 100) {
        fw_arena *arena = fw_arena_new(0);
        long count = 0;
        const double atol[3] = {rtol, rtol, rtol};
        fw_dop853 *s = started(arena, rtol, &count, atol);
        double last[3], dense = 0, y[3], slope, value, r[8];
        while (s->t < s->t_end) {
            memcpy(last, s->y, sizeof last);
            assert_int_equal(fw_dop853_step(s), FW_ODE_STEP);
            fw_dop853_dense_prepare(s);
            fw_dop853_dense(s, 0, y);
            for (int c = 0; c < 3; c++) /* continuous */
                assert_near(y[c], last[c], 1e-14);
            fw_dop853_dense(s, 1, y);
            for (int c = 0; c < 3; c++)
                assert_near(y[c], s->y[c], 1e-14 * (1 + fabs(s->y[c])));
            for (double theta = 0.05; theta < 1; theta += 0.05) {
                double t = s->t_old + theta * s->h;
                fw_dop853_dense(s, theta, y);
                dense = fmax(dense, fabs(y[0] / exp(sin(t)) - 1));
                dense = fmax(dense, fabs(y[1] - 1 / (1 + t)));
                for (int i = 0; i < 8; i++)
                    r[i] = s->dense[3 * i];
                fw_dop853_dense_value(r, theta, &value, &slope);
                assert_near(value, y[0], 1e-14 * y[0]);
                /* the slope of the interpolant is one order worse than its value */
                assert_near(slope / s->h, y[0] * cos(t), 1e3 * rtol + 1e-10);
            }
        }
        assert_true(s->t == 5);
        assert_int_equal(count, s->rhs);
        double error = fabs(s->y[0] / exp(sin(5.0)) - 1);
        /* measured: 0.02 to 10 times rtol, the dense output up to ten times more */
        assert_true(error < 30 * rtol);
        assert_true(dense < 300 * rtol);
        assert_near(s->y[1], 1.0 / 6, 30 * rtol);
        if (before > 0) assert_true((double)s->steps < 3 * before); /* order 8: 100^(1/8) = 1.8 */
        before = (double)s->steps;
        fw_arena_free(arena);
    }
}

/* equal steps: halving them divides the error by 2^8, that of the dense output by 2^8 within a step
   too (its own error is of order 8 there) */
static void test_order(void **state) {
    (void)state;
    double error[3], dense[3];
    for (int i = 0; i < 3; i++) {
        fw_arena *arena = fw_arena_new(0);
        long count = 0;
        const double atol[3] = {1, 1, 1};
        fw_dop853 *s = started(arena, 1, &count, atol);
        s->h_max = s->h_next = 5.0 / (10 << i);
        dense[i] = 0;
        while (s->t < s->t_end) {
            s->h_next = s->h_max;
            assert_int_equal(fw_dop853_step(s), FW_ODE_STEP);
            fw_dop853_dense_prepare(s);
            double y[3];
            fw_dop853_dense(s, 0.4, y);
            dense[i] = fmax(dense[i], fabs(y[0] - exp(sin(s->t_old + 0.4 * s->h))));
        }
        assert_int_equal(s->steps, 10 << i);
        error[i] = fabs(s->y[0] - exp(sin(5.0)));
        fw_arena_free(arena);
    }
    for (int i = 0; i < 2; i++) {
        double order = log2(error[i] / error[i + 1]), within = log2(dense[i] / dense[i + 1]);
        assert_true(order > 7.2 && order < 9.8);
        assert_true(within > 6.7 && within < 9.8);
    }
}

/* y = (cos, sin): the hook keeps the unit circle to round-off, dense output still fits the ends */
static void circle(void *context, double t, const double *y, double *f) {
    (void)context;
    (void)t;
    f[0] = -y[1];
    f[1] = y[0];
}
static bool to_circle(void *context, double t, double *y, double *f) {
    double norm = hypot(y[0], y[1]);
    y[0] /= norm;
    y[1] /= norm;
    circle(context, t, y, f);
    return true;
}
static void test_projection(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double atol[2] = {1e-6, 1e-6}, start[2] = {1, 0};
    const fw_ode ode = {NULL, circle, to_circle, 2, 2};
    fw_dop853 *s;
    assert_int_equal(fw_dop853_new(arena, &ode, 1e-6, atol, &s), FW_OK);
    fw_dop853_start(s, 0, start, 100);
    double y[2];
    while (s->t < s->t_end) {
        assert_int_equal(fw_dop853_step(s), FW_ODE_STEP);
        assert_near(hypot(s->y[0], s->y[1]), 1, 4e-16);
        fw_dop853_dense_prepare(s);
        fw_dop853_dense(s, 1, y);
        assert_near(y[0], s->y[0], 1e-14);
    }
    assert_near(s->y[0], cos(100.0), 1e-4);
    fw_arena_free(arena);
}

static void blows_up(void *context, double t, const double *y, double *f) {
    (void)context;
    (void)t;
    f[0] = y[0] * y[0]; /* 1/(1 - t): no solution beyond t = 1 */
}
static void not_a_number(void *context, double t, const double *y, double *f) {
    (void)context;
    (void)y;
    f[0] = t > 0.5 ? (double)NAN : 1;
}
static void test_failures(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double atol[1] = {1e-9}, start[1] = {1};
    for (int i = 0; i < 2; i++) {
        const fw_ode ode = {NULL, i ? not_a_number : blows_up, NULL, 1, 1};
        fw_dop853 *s;
        assert_int_equal(fw_dop853_new(arena, &ode, 1e-9, atol, &s), FW_OK);
        fw_dop853_start(s, 0, start, 2);
        fw_ode_result result = FW_ODE_STEP;
        for (int k = 0; k < 100000 && result == FW_ODE_STEP && s->t < 2; k++)
            result = fw_dop853_step(s);
        assert_true(result != FW_ODE_STEP);
        if (i == 0)
            assert_near(s->t, 1, 1e-6);
        else
            assert_true(s->t <= 0.5);
    }
    fw_arena_free(arena);
}

static void test_out_of_memory(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double atol[3] = {1, 1, 1};
    const fw_ode ode = {NULL, problem, NULL, 3, 3};
    fw_dop853 *s;
    for (long n = 1; n <= 8; n++) {
        fw_arena_fail_at(n, 0);
        assert_int_equal(fw_dop853_new(arena, &ode, 1e-6, atol, &s), FW_NOMEM);
    }
    fw_arena_fail_at(0, 0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_conditions),
        cmocka_unit_test(test_accuracy_and_dense_output),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_projection),
        cmocka_unit_test(test_failures),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
