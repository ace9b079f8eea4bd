/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Certified measures of the reference design against independent ones (another program, other
   arithmetic: mean-value forms in numpy, Monte Carlo, counted pixels), um and degrees. */
#include "workspace/reach.h"
#include "six_bar_fixture.h"
#include "test.h"

static const double degree = 0.017453292519943295;

static void set_up(six_bar_fixture *f, fw_workspace_loop *loop) {
    six_bar_make(f, six_bar_reference);
    assert_true(fw_workspace_loop_set_up(&f->mechanism, loop));
}

static fw_workspace_reach_limits all_equal(double deg) {
    double limit[FW_SIX];
    for (int i = 0; i < FW_SIX; i++)
        limit[i] = deg * degree;
    return fw_workspace_limits_symmetric(limit);
}

static const struct {
    double deg, low, high, sampled, sigma;
} volume[] = {
    {2, 110.32667699456636, 110.3561165338497, 110.21403622765969, 0.08799715719460356},
    {5, 1721.7566503920518, 1722.4923737997096, 1720.249620522073, 1.3738717930898445},
    {10, 13716.238850458118, 13725.95752004333, 13706.113264263238, 10.959415320486475},
};

/* our bracket and the independent one overlap, and are narrow enough to tell; ours is as narrow as
   asked for, inside the box budget; Monte Carlo agrees within four sigma */
static void volumes_of_the_reference(void **state) {
    (void)state;
    six_bar_fixture f;
    fw_workspace_loop loop;
    set_up(&f, &loop);
    fw_arena *arena = fw_arena_new(0);
    for (size_t i = 0; i < 3; i++) {
        fw_workspace_reach_limits limits = all_equal(volume[i].deg);
        fw_workspace_measure v;
        assert_int_equal(fw_workspace_reach_volume(arena, &loop, &limits,
                                                   (fw_workspace_proof_effort){1e-3, 1000000}, &v),
                         FW_OK);
        double low = v.value.lo * 1e12, high = v.value.hi * 1e12;
        assert_true(v.reached && high / low - 1 <= 1e-3);
        assert_true(low <= volume[i].high && high >= volume[i].low);
        assert_true(volume[i].sampled > low - 4 * volume[i].sigma &&
                    volume[i].sampled < high + 4 * volume[i].sigma);
        assert_int_equal(fw_workspace_reach_volume(arena, &loop, &limits,
                                                   (fw_workspace_proof_effort){1e-2, 1000000}, &v),
                         FW_OK);
        assert_true(v.reached && v.boxes < 60000);
    }
    fw_arena_free(arena);
}

/* the finer of two brackets lies in the coarser one, and they close on one number */
static void brackets_nest(void **state) {
    (void)state;
    six_bar_fixture f;
    fw_workspace_loop loop;
    set_up(&f, &loop);
    fw_arena *arena = fw_arena_new(0);
    fw_workspace_reach_limits limits = all_equal(7);
    limits.high_rad[0] = 0.05, limits.low_rad[3] = -0.2, limits.high_rad[4] = 0.09;
    fw_maths_interval before = {0, (double)INFINITY};
    for (int i = 0; i < 7; i++) {
        fw_workspace_measure v;
        assert_int_equal(
            fw_workspace_reach_volume(arena, &loop, &limits,
                                      (fw_workspace_proof_effort){0.3 * pow(0.3, i), 5000000}, &v),
            FW_OK);
        assert_true(v.reached);
        assert_true(v.value.lo >= before.lo && v.value.hi <= before.hi);
        before = v.value;
    }
    fw_workspace_measure few;
    assert_int_equal(fw_workspace_reach_volume(arena, &loop, &limits,
                                               (fw_workspace_proof_effort){1e-6, 2000}, &few),
                     FW_OK);
    assert_true(!few.reached && few.boxes < 2100);
    assert_true(few.value.lo <= before.lo && few.value.hi >= before.hi);
    fw_arena_free(arena);
}

static const struct {
    double deg, phi, area;
} area[] = {
    {5, 0.0, 21224.533333333333},  {5, 0.05, 6604.586666666667},
    {5, -0.05, 6604.586666666667}, {5, 0.1, 0.0},
    {10, 0.0, 84591.92888888888},  {10, 0.05, 61968.0},
    {10, -0.05, 61968.0},          {10, 0.1, 26285.36888888889},
};

/* areas were counted in pixels of a grid: right to some 1e-3 of them */
static void areas_of_the_reference(void **state) {
    (void)state;
    six_bar_fixture f;
    fw_workspace_loop loop;
    set_up(&f, &loop);
    fw_arena *arena = fw_arena_new(0);
    for (size_t i = 0; i < sizeof area / sizeof area[0]; i++) {
        fw_workspace_reach_limits limits = all_equal(area[i].deg);
        fw_workspace_measure a;
        assert_int_equal(fw_workspace_reach_area(arena, &loop, &limits, area[i].phi,
                                                 (fw_workspace_proof_effort){1e-5, 1000000}, &a),
                         FW_OK);
        assert_true(a.reached);
        assert_near(a.value.lo * 1e12, area[i].area, 2e-3 * area[i].area + 1e-9);
        assert_near(a.value.hi * 1e12, area[i].area, 2e-3 * area[i].area + 1e-9);
    }
    fw_arena_free(arena);
}

/* the integral of A(phi) is the volume: Gauss-Legendre on panels would need smoothness, the
   midpoint rule of 400 slices does not */
static void areas_add_up_to_the_volume(void **state) {
    (void)state;
    six_bar_fixture f;
    fw_workspace_loop loop;
    set_up(&f, &loop);
    fw_arena *arena = fw_arena_new(0);
    fw_workspace_reach_limits limits = all_equal(10);
    enum { SLICES = 400 };
    double sum = 0, reach = 0.19;
    for (int i = 0; i < SLICES; i++) {
        fw_workspace_measure a;
        double phi = reach * ((2.0 * i + 1) / SLICES - 1);
        assert_int_equal(fw_workspace_reach_area(arena, &loop, &limits, phi,
                                                 (fw_workspace_proof_effort){1e-3, 100000}, &a),
                         FW_OK);
        sum += 0.5 * (a.value.lo + a.value.hi) * 2 * reach / SLICES;
    }
    assert_relative(sum * 1e12, 13721.1, 1e-3);
    fw_arena_free(arena);
}

/* small limits: the volume grows with the third power; limits that shut a hinge out leave nothing
 */
static void scaling_and_nothing(void **state) {
    (void)state;
    six_bar_fixture f;
    fw_workspace_loop loop;
    set_up(&f, &loop);
    fw_arena *arena = fw_arena_new(0);
    fw_workspace_measure a, b;
    fw_workspace_reach_limits one = all_equal(0.01), two = all_equal(0.02);
    assert_int_equal(fw_workspace_reach_volume(arena, &loop, &one,
                                               (fw_workspace_proof_effort){1e-3, 1000000}, &a),
                     FW_OK);
    assert_int_equal(fw_workspace_reach_volume(arena, &loop, &two,
                                               (fw_workspace_proof_effort){1e-3, 1000000}, &b),
                     FW_OK);
    assert_relative(b.value.lo / a.value.lo, 8.0, 2e-3);
    fw_workspace_reach_limits none = all_equal(1);
    none.low_rad[4] = 0.5, none.high_rad[4] = 0.6; /* E would have to be turned by 30 deg */
    assert_int_equal(fw_workspace_reach_volume(arena, &loop, &none,
                                               (fw_workspace_proof_effort){1e-3, 1000000}, &a),
                     FW_OK);
    assert_true(a.reached && a.value.hi == 0.0);
    none = all_equal(1);
    none.low_rad[1] = 0.2, none.high_rad[1] = 0.1;
    assert_int_equal(fw_workspace_reach_volume(arena, &loop, &none,
                                               (fw_workspace_proof_effort){1e-3, 1000000}, &a),
                     FW_OK);
    assert_true(a.reached && a.value.hi == 0.0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volumes_of_the_reference), cmocka_unit_test(brackets_nest),
        cmocka_unit_test(areas_of_the_reference),   cmocka_unit_test(areas_add_up_to_the_volume),
        cmocka_unit_test(scaling_and_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
