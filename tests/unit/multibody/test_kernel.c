/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fast right-hand side against the general one, and its own sines against longer arithmetic. */
#include "multibody/kernel.h"
#include "kernel_rigs.h"
#include <float.h>

/* ---- sines ---- */

static double ulps(double got, long double want) {
    int exponent;
    frexpl(want, &exponent);
    return (double)(fabsl((long double)got - want) / ldexpl(1, exponent - 53));
}

static double worst_sincos(int n, const double *x) {
    static double s[4096], c[4096];
    double worst = 0;
    for (int i = 0; i < n; i++) {
        fw_multibody_kernel_sincos(x[i], &s[i], &c[i]);
        worst = fmax(worst, ulps(s[i], sinl((long double)x[i])));
        worst = fmax(worst, ulps(c[i], cosl((long double)x[i])));
    }
    return worst;
}

/* four million angles of all sizes, and the neighbours of multiples of pi/2; the reference has 64
   bits, and glibc's reduction of its argument is exact */
static void test_sincos(void **state) {
    (void)state;
    static double x[4096];
    static const double size[] = {1e-3, 0.8, 7, 100, 1e4, 1e5};
    uint64_t seed = 1;
    double worst = 0;
    for (int block = 0; block < test_fewest(970, 60); block++) {
        for (int i = 0; i < 4096; i++)
            x[i] = size[block % 6] * (2 * rig_random(&seed) - 1);
        worst = fmax(worst, worst_sincos(4096, x));
    }
    for (int k = 0; k < 63000; k += test_fewest(4096 / 8, 4096)) {
        for (int i = 0; i < 4096; i++) {
            double at = (double)(k + i / 8) * 1.57079632679489661923;
            x[i] = at > 99999 ? 1 : at * (1 + (i % 8 - 4) * DBL_EPSILON);
        }
        worst = fmax(worst, worst_sincos(4096, x));
    }
    printf("sincos: at most %.3f ulp\n", worst);
    assert_true(worst < 0.9);
}

static void test_sincos_everywhere(void **state) {
    (void)state;
    const double x[7] = {0, -0.0, 1e5 + 1, -3e8, (double)NAN, (double)INFINITY, 0.5};
    for (int i = 0; i < 7; i++) {
        double s, c;
        fw_multibody_kernel_sincos(x[i], &s, &c);
        assert_true(s == sin(x[i]) || isnan(sin(x[i])) == isnan(s));
        if (isfinite(x[i])) assert_near(s, sin(x[i]), 1e-16);
        if (isfinite(x[i])) assert_near(c, cos(x[i]), 1.2e-16);
    }
}

/* ---- right-hand side ---- */

static fw_multibody_kernel *kernel_of(fw_arena *arena, const fw_multibody_model *m) {
    fw_multibody_kernel *k = NULL;
    assert_int_equal(fw_multibody_kernel_new(arena, m, &k), FW_OK);
    return k;
}

/* M a + G^T lambda = Q and G a = -gamma, put into the model's own operators */
static void check_equations(fw_arena *arena, fw_multibody_system *sys, const double *y,
                            const double *a, const double *lambda) {
    const fw_multibody_model *m = sys->model;
    double *rows = fw_arena_array(arena, double, 2 * (size_t)m->nblock);
    double *gamma = fw_arena_array(arena, double, 2 * (size_t)m->nblock);
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, 0, y);
    fw_multibody_jacobian(m, pose, a, rows);
    fw_multibody_gamma(sys, pose, y + m->nq, gamma);
    double most = fmax(rig_largest(a, m->nq), rig_largest(gamma, 2 * m->nblock)) * m->size;
    for (int i = 0; i < 2 * m->nblock; i++)
        assert_near(rows[i], -gamma[i], 1e-12 * most);
    double *accel = fw_multibody_forces(sys, pose, y + m->nq)->accel;
    most = fmax(rig_largest(accel, m->nq), rig_largest(a, m->nq));
    most = fmax(most, rig_largest(lambda, 2 * m->nblock) * rig_largest(m->minv, m->nbody));
    fw_multibody_apply(m, pose, lambda, accel);
    for (int i = 0; i < m->nq; i++)
        assert_near(accel[i], a[i], 1e-12 * most);
}

/* by the blocks (0), or in the form of closed loops where the model is one (1) */
static void prefer(fw_multibody_kernel *k, bool loop) {
    static struct loop *own;
    if (k->core.loop) own = k->core.loop;
    if (k->core.plan.loop) k->core.loop = loop ? own : NULL;
}

/* both forms, as far as the model has them, against the general code and in the equations */
static void compare(fw_arena *arena, const rig *r, double size, uint64_t seed, double tolerance) {
    fw_multibody_system *sys = rig_system(arena, r);
    const fw_multibody_model *m = sys->model;
    fw_multibody_kernel *k = kernel_of(arena, m);
    assert_non_null(k);
    double *y = rig_state(arena, m, size, seed);
    double *f = fw_arena_array(arena, double, (size_t)m->ny), *g;
    g = fw_arena_array(arena, double, (size_t)m->ny);
    rig_general(sys, y, f);
    for (int loop = 0; loop < 2; loop++) {
        prefer(k, loop);
        fw_multibody_kernel_rhs(k, y, g);
        double most = rig_largest(f, m->ny);
        for (int i = 0; i < m->ny; i++)
            assert_near(g[i], f[i], tolerance * most);
        assert_memory_equal(g, y + m->nq, sizeof(double) * (size_t)m->nq);
        check_equations(arena, sys, y, g + m->nq, fw_multibody_kernel_lambda(k));
    }
}

static void test_against_general(void **state) {
    (void)state;
    int loops = 0;
    for (uint64_t seed = 0; seed < 160; seed++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = seed == 0   ? rig_six_bar(arena, false)
                : seed == 1 ? rig_pendulum(arena)
                : seed < 8  ? rig_windows(arena, (int)seed)
                            : rig_any(arena, seed);
        fw_multibody_kernel *k = kernel_of(arena, rig_model(arena, &r));
        loops += k->core.loop != NULL;
        compare(arena, &r, 0.6, seed, 1e-10);
        fw_arena_free(arena);
    }
    printf("%d closed loops of 160\n", loops);
    assert_true(loops > 0 && loops < 150); /* both kinds were there */
}

/* chains of 1 to 9 bodies, hanging and closed, pins written from either side, in any order */
static void test_chains_and_loops(void **state) {
    (void)state;
    for (int n = 1; n <= 9; n++)
        for (int kind = 0; kind < 6; kind++) {
            fw_arena *arena = fw_arena_new(0);
            rig r = rig_new(arena, n, n + 1, 0);
            bool closed = kind % 2, turned = kind / 2 == 1, back = kind / 2 == 2;
            for (int i = 0; i < n; i++)
                rig_body(&r, "link", 1 + 0.1 * i, 0.1, i + 0.4, 0.2 * sin(i), 0.3 * i);
            for (int i = 0; i < n + closed; i++) {
                int at = back ? n + closed - 1 - i : i;
                int a = at - 1, b = at == n ? FW_GROUND : at;
                rig_pin(&r, "pin", turned ? b : a, turned ? a : b, at, 0.1 * at, 2 + at, 0.01 * at);
            }
            rig_force(&r, n - 1, 1, -2);
            r.scene.duration_s = 1;
            if (n == 1 && closed) { /* two pins between the ground and one body: redundant */
                fw_arena_free(arena);
                continue;
            }
            const fw_multibody_model *m = rig_model(arena, &r);
            assert_int_equal(kernel_of(arena, m)->core.loop != NULL, closed && n >= 3 && n <= 6);
            compare(arena, &r, 0.3, (uint64_t)(10 * n + kind), 1e-10);
            fw_arena_free(arena);
        }
}

/* the careful solve and the plain one solve the same system */
static void test_both_solves(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 60; seed++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = seed == 0   ? rig_six_bar(arena, false)
                : seed == 1 ? rig_windows(arena, 5)
                            : rig_any(arena, seed);
        const fw_multibody_model *m = rig_model(arena, &r);
        fw_multibody_kernel *k = kernel_of(arena, m);
        double *y = rig_state(arena, m, 0.4, seed), *f[2];
        for (int loop = 0; loop < 2; loop++) {
            prefer(k, loop);
            for (int care = 0; care < 2; care++) {
                f[care] = fw_arena_array(arena, double, (size_t)m->ny);
                k->core.healthy = care ? (double)INFINITY : 1e-9;
                fw_multibody_kernel_rhs(k, y, f[care]);
            }
            for (int i = 0; i < m->ny; i++)
                assert_near(f[1][i], f[0][i], 1e-9 * rig_largest(f[0], m->ny));
        }
        fw_arena_free(arena);
    }
}

/* windows at the angle `flat` from the position where all bars lie on one line; accelerations are
   those of one pendulum: phi'' = -kappa g cos phi with the bars parallel and the speeds equal */
static void windows_state(const fw_multibody_model *m, int n, double flat, double *y) {
    double phi = -1.57079632679489661923 + flat; /* from upright */
    for (int b = 0; b <= 2 * n; b++) {
        double l = m->scale.length_m, rate = -0.7, t = m->scale.time_s;
        double turn = b <= n ? 1 : 0, arm = b <= n ? 0.5 : 1;
        double dx = -sin(phi) * arm, dy = (cos(phi) - 1) * arm;
        y[3 * b] = dx / l, y[3 * b + 1] = dy / l, y[3 * b + 2] = turn * phi;
        double *v = y + m->nq + 3 * b;
        v[0] = -cos(phi) * arm * rate * t / l, v[1] = -sin(phi) * arm * rate * t / l;
        v[2] = turn * rate * t;
    }
}

/* exact where the plain solution holds; below 1e-3 rad both use the proximal iteration, the general
   code with residuals from the Jacobian */
static void test_singular_positions(void **state) {
    (void)state;
    static const double flat[] = {0.3, 1e-1, 1e-2, 3e-3, 1e-3, 5e-4, 1e-4, 1e-6, 1e-8, 0};
    static const double error[] = {1e-13, 1e-13, 5e-12, 1e-11, 1e-3, 1, 1, 1, 1, 1};
    for (int n = 1; n <= 21; n += 4)
        for (size_t i = 0; i < sizeof flat / sizeof *flat; i++) {
            fw_arena *arena = fw_arena_new(0);
            rig r = rig_windows(arena, n);
            fw_multibody_system *sys = rig_system(arena, &r);
            const fw_multibody_model *m = sys->model;
            fw_multibody_kernel *k = kernel_of(arena, m);
            double *y = fw_arena_array(arena, double, (size_t)m->ny);
            double *f = fw_arena_array(arena, double, (size_t)m->ny);
            double *g = fw_arena_array(arena, double, (size_t)m->ny);
            windows_state(m, n, flat[i], y);
            fw_multibody_kernel_rhs(k, y, f);
            rig_general(sys, y, g);
            /* crank angle from the x axis: phi + 90 degrees = flat */
            double kappa = ((n + 1) / 2.0 + n) / ((n + 1) / 3.0 + n);
            double want = -kappa * 9.81 * cos(flat[i]) * m->scale.time_s * m->scale.time_s;
            for (int b = 0; b <= n; b++) {
                double got = f[m->nq + 3 * b + 2], general = g[m->nq + 3 * b + 2];
                assert_near(got, want, error[i] * fabs(want));
                if (fabs(flat[i]) >= 1e-3)
                    assert_true(fabs(got - want) <=
                                1e-10 * fabs(want) + 1.01 * fabs(general - want));
            }
            fw_arena_free(arena);
        }
}

/* hinge D twice: the bodies move as with one */
static void test_redundant(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig once = rig_six_bar(arena, false), twice = rig_six_bar(arena, true);
    const fw_multibody_model *m[2] = {rig_model(arena, &once), rig_model(arena, &twice)};
    double f[2][31], y[2][31];
    for (int k = 0; k < 2; k++) {
        fw_multibody_kernel *kernel = kernel_of(arena, m[k]);
        double l = m[k]->scale.length_m / 1e-3, t = m[k]->scale.time_s / 1e-3;
        memset(y[k], 0, sizeof y[k]);
        for (int i = 0; i < 15; i++)
            y[k][i] = 0.01 * sin(i) / (i % 3 == 2 ? 1 : l);
        for (int i = 0; i < 15; i++)
            y[k][15 + i] = 0.1 * cos(i) * t / (i % 3 == 2 ? 1 : l);
        fw_multibody_kernel_rhs(kernel, y[k], f[k]);
        assert_true(fw_multibody_kernel_project(kernel, y[k], f[k]));
        assert_true(fw_multibody_kernel_norms_of(kernel).position < 1e-14);
        for (int i = 0; i < 15; i++) { /* mm, ms */
            y[k][i] *= i % 3 == 2 ? 1 : l;
            f[k][15 + i] *= (i % 3 == 2 ? 1 : l) / (t * t);
        }
    }
    for (int i = 0; i < 15; i++) {
        assert_near(y[1][i], y[0][i], 1e-12);
        assert_near(f[1][15 + i], f[0][15 + i], 1e-10 * rig_largest(f[0], 30));
    }
    fw_arena_free(arena);
}

/* the same bits on every processor and from every compiler: no contraction, one order */
static void test_bits(void **state) {
    (void)state;
    static const double want[2][4] = {
        {-0x1.acc2fedaeba8ap-1, -0x1.411df48ca7d8ap+1, 0x1.c2fe09d03c72fp-1, 0x1.91d66cbd5ca1ap-7},
        {-0x1.acc2fedaeba7ep-1, -0x1.411df48ca7d82p+1, 0x1.c2fe09d03c72fp-1, 0x1.91d66cbd5ca1ap-7}};
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_six_bar(arena, false);
    const fw_multibody_model *m = rig_model(arena, &r);
    fw_multibody_kernel *k = kernel_of(arena, m);
    double *y = rig_state(arena, m, 3, 12), f[31];
    for (int loop = 0; loop < 2; loop++) {
        prefer(k, loop);
        fw_multibody_kernel_rhs(k, y, f);
        const double got[4] = {f[m->nq], f[m->nq + 5], f[m->nq + 10], f[2 * m->nq]};
        for (int i = 0; i < 4; i++)
            if (got[i] != want[loop][i])
                fail_msg("loop %d: %a, not %a", loop, got[i], want[loop][i]);
    }
    fw_arena_free(arena);
}

/* ---- projection ---- */

static void test_projection(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 60; seed++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = seed == 0   ? rig_six_bar(arena, false)
                : seed == 1 ? rig_windows(arena, 4)
                            : rig_any(arena, seed);
        fw_multibody_system *sys = rig_system(arena, &r);
        const fw_multibody_model *m = sys->model;
        fw_multibody_kernel *k = kernel_of(arena, m), *own = sys->kernel;
        double *start = rig_state(arena, m, 1e-4, seed), *y[2], *f[2];
        for (int i = 0; i < 2; i++) {
            y[i] = fw_arena_array(arena, double, (size_t)m->ny);
            f[i] = fw_arena_array(arena, double, (size_t)m->ny);
            memcpy(y[i], start, sizeof(double) * (size_t)m->ny);
        }
        sys->kernel = NULL;
        fw_multibody_rhs(sys, 0, y[0], f[0]);
        assert_true(fw_multibody_project(sys, 0, y[0], f[0]));
        sys->kernel = own;
        for (int loop = 0; loop < 2; loop++) {
            prefer(k, loop);
            memcpy(y[1], start, sizeof(double) * (size_t)m->ny);
            fw_multibody_kernel_rhs(k, y[1], f[1]);
            assert_true(fw_multibody_kernel_project(k, y[1], f[1]));
            assert_true(fw_multibody_kernel_norms_of(k).position <= 4 * DBL_EPSILON * m->size);
            for (int i = 0; i < m->ny; i++) {
                assert_near(y[1][i], y[0][i], 1e-13);
                assert_near(f[1][i], f[0][i], 1e-9 * rig_largest(f[0], m->ny));
            }
            const fw_multibody_pose *pose = fw_multibody_pose_at(sys, 0, y[1]);
            assert_true(fw_multibody_residual(sys, pose, NULL) <= 8 * DBL_EPSILON * m->size);
        }
        fw_arena_free(arena);
    }
}

static void test_not_a_number(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int kind = 0; kind < 3; kind++) {
        rig r = kind == 0   ? rig_six_bar(arena, false)
                : kind == 1 ? rig_six_bar(arena, true)
                            : rig_windows(arena, 3);
        const fw_multibody_model *m = rig_model(arena, &r);
        fw_multibody_kernel *k = kernel_of(arena, m);
        double *y = rig_state(arena, m, 0.1, 3), *f, *g;
        f = fw_arena_array(arena, double, (size_t)m->ny);
        g = fw_arena_array(arena, double, (size_t)m->ny);
        fw_multibody_kernel_rhs(k, y, f);
        double angle = y[5];
        y[5] = (double)NAN;
        fw_multibody_kernel_rhs(k, y, g);
        assert_true(isnan(g[m->nq + 5]));
        assert_false(fw_multibody_kernel_project(k, y, g));
        y[5] = (double)INFINITY;
        fw_multibody_kernel_rhs(k, y, g);
        assert_true(!isfinite(g[m->nq + 5]));
        y[5] = angle; /* nothing of it is left */
        fw_multibody_kernel_rhs(k, y, g);
        assert_memory_equal(f, g, sizeof(double) * (size_t)m->ny);
    }
    fw_arena_free(arena);
}

/* what is not plain has no kernel */
static void test_only_plain(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_squeezer(arena);
    assert_null(kernel_of(arena, rig_model(arena, &r)));
    fw_arena_free(arena);
}

static void test_memory(void **state) {
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = kind ? rig_windows(arena, 3) : rig_six_bar(arena, false);
        const fw_multibody_model *m = rig_model(arena, &r);
        fw_multibody_kernel *k;
        double *y = rig_state(arena, m, 0.1, 3), *f = rig_state(arena, m, 0, 3);
        fw_arena_fail_at(0, 0);
        assert_int_equal(fw_multibody_kernel_new(arena, m, &k), FW_OK);
        long count = fw_arena_count();
        fw_multibody_kernel_rhs(k, y, f);
        fw_multibody_kernel_project(k, y, f);
        assert_int_equal(fw_arena_count(), count); /* none after the start */
        for (long n = 1; n <= count; n++) {
            fw_arena_fail_at(n, 0);
            fw_status status = fw_multibody_kernel_new(arena, m, &k);
            fw_arena_fail_at(0, 0);
            if (status == FW_OK) break; /* the count runs over the models before */
            assert_int_equal(status, FW_NOMEM);
            assert_null(k);
        }
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sincos),          cmocka_unit_test(test_sincos_everywhere),
        cmocka_unit_test(test_against_general), cmocka_unit_test(test_chains_and_loops),
        cmocka_unit_test(test_both_solves),     cmocka_unit_test(test_singular_positions),
        cmocka_unit_test(test_redundant),       cmocka_unit_test(test_bits),
        cmocka_unit_test(test_projection),      cmocka_unit_test(test_not_a_number),
        cmocka_unit_test(test_only_plain),      cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
