/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block elimination against a dense solve of the same S, on random mechanisms. */
#include "multibody/systems.h"
#include "maths/matrix.h"
#include <stdlib.h>

static fw_multibody_system *system_of(fw_arena *arena, const rig *r) {
    return rig_system_with(arena, &r->m, NULL, 1, NULL);
}

/* S = G M^-1 G^T by unit vectors: column j is G (M^-1 G^T e_j) */
static double *dense_s(fw_arena *arena, const fw_multibody_model *m,
                       const fw_multibody_pose *pose) {
    size_t n = 2 * (size_t)m->npin;
    double *s = fw_arena_array(arena, double, n *n);
    double *e = fw_arena_array(arena, double, n), *a = fw_arena_array(arena, double, (size_t)m->nq);
    double *column = fw_arena_array(arena, double, n);
    for (size_t j = 0; j < n; j++) {
        memset(e, 0, n * sizeof *e);
        memset(a, 0, (size_t)m->nq * sizeof *a);
        e[j] = -1; /* apply subtracts */
        fw_multibody_apply(m, pose, e, a);
        fw_multibody_jacobian(m, pose, a, column);
        for (size_t i = 0; i < n; i++)
            s[i * n + j] = column[i];
    }
    return s;
}

static void test_against_dense(void **state) {
    (void)state;
    uint64_t random = 7;
    for (uint64_t seed = 1; seed <= 80; seed++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = seed == 1   ? rig_six_bar(arena, false)
                : seed == 2 ? rig_squeezer(arena)
                : seed == 3 ? rig_windows(arena, 6)
                            : rig_any(arena, seed);
        fw_multibody_system *sys = system_of(arena, &r);
        const fw_multibody_model *m = sys->model;
        fw_multibody_chain_numbers *numbers = &sys->work->chain;
        size_t n = 2 * (size_t)m->npin;
        double *u = fw_arena_array(arena, double, (size_t)m->nq);
        for (int i = 0; i < m->nq;
             i++) /* away from the assembled pose, windows from singular ones */
            u[i] = 0.4 * (rig_random(&random) - 0.5);
        const fw_multibody_pose *pose = fw_multibody_pose_at(sys, 0, u);
        double *s = dense_s(arena, m, pose), *b = fw_arena_array(arena, double, n);
        double *x = fw_arena_array(arena, double, n), *want = fw_arena_array(arena, double, n);
        double size = 0;
        bool consistent;
        for (size_t i = 0; i < n; i++) {
            b[i] = rig_random(&random) - 0.5;
            for (size_t j = 0; j < n; j++)
                assert_near(s[i * n + j], s[j * n + i], 1e-12 * (1 + fabs(s[i * n + j])));
        }
        assert_int_equal(fw_maths_dense_solve_symmetric(arena, (int)n, s, b, want, &consistent),
                         FW_OK);
        for (size_t i = 0; i < n; i++)
            size = fmax(size, fabs(want[i]));
        /* plain factor */
        fw_multibody_chain_assemble(m, pose, numbers);
        assert_true(fw_multibody_chain_factor(&m->chain, numbers, 0));
        memcpy(x, b, n * sizeof *x);
        fw_multibody_chain_solve(&m->chain, numbers, x);
        for (size_t i = 0; i < n; i++)
            assert_near(x[i], want[i], 1e-9 * size);
        /* proximal: the same without the shift showing */
        fw_multibody_chain_assemble(m, pose, numbers);
        assert_true(fw_multibody_chain_factor(&m->chain, numbers, fw_epsilon));
        fw_multibody_chain_proximal(m, pose, numbers, b, x);
        for (size_t i = 0; i < n; i++)
            assert_near(x[i], want[i], 1e-9 * size);
        fw_arena_free(arena);
    }
}

/* hinge D twice: S is singular; G^T lambda must equal that of the mechanism with one hinge D */
static void test_redundant(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig once = rig_six_bar(arena, false), twice = rig_six_bar(arena, true);
    fw_multibody_system *system[2] = {system_of(arena, &once), system_of(arena, &twice)};
    double force[2][15];
    for (int k = 0; k < 2; k++) {
        const fw_multibody_model *m = system[k]->model;
        fw_multibody_chain_numbers *s = &system[k]->work->chain;
        double v[15], r[14], x[14];
        for (int i = 0; i < 15; i++)
            v[i] = sin(3.0 * i + 1) / (i % 3 == 2 ? 1 : m->scale.length_m), force[k][i] = 0;
        const double zero[15] = {0};
        const fw_multibody_pose *pose = fw_multibody_pose_at(system[k], 0, zero);
        fw_multibody_jacobian(m, pose, v, r); /* consistent for both */
        fw_multibody_chain_assemble(m, pose, s);
        assert_true(fw_multibody_chain_factor(&m->chain, s, fw_epsilon));
        fw_multibody_chain_proximal(m, pose, s, r, x);
        fw_multibody_apply(m, pose, x, force[k]);
        for (int i = 0; i < 15; i++) /* the two models have their own lengths */
            force[k][i] *= i % 3 == 2 ? 1e-3 : m->scale.length_m;
    }
    for (int i = 0; i < 15; i++)
        assert_near(force[1][i], force[0][i], 1e-12);
    fw_arena_free(arena);
}

/* chains and rings: no fill; work grows in proportion to the bodies; windows: fill stays bounded */
static void test_topology(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig six = rig_six_bar(arena, false);
    const fw_multibody_model *m = system_of(arena, &six)->model;
    assert_int_equal(m->chain.blocks, 5);
    assert_int_equal(m->chain.first[m->npin], 0);
    /* both ends first */
    const int order[6] = {0, 5, 1, 4, 2, 3};
    for (int i = 0; i < 6; i++)
        assert_int_equal(m->block[i].pin, order[i]);
    for (int n = 5; n <= 80; n *= 2) {
        rig w = rig_windows(arena, n);
        const fw_multibody_model *big = system_of(arena, &w)->model;
        assert_true(big->chain.blocks <= 4 * n);
        assert_true(big->chain.first[big->npin] <= 3 * n);
        char seen[300] = {0};
        for (int i = 0; i < big->npin; i++) {
            assert_false(seen[big->block[i].pin]);
            seen[big->block[i].pin] = 1;
        }
    }
    fw_arena_free(arena);
}

static void test_scaling(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig six = rig_six_bar(arena, false);
    const fw_multibody_model *m = system_of(arena, &six)->model;
    for (int b = 0; b < m->nbody; b++) { /* all of order one */
        assert_true(m->mass[b] > 0.1 && m->mass[b] < 10);
        assert_true(m->inertia[b] > 0.01 && m->inertia[b] < 10);
    }
    assert_true(m->scale.length_m > 0.5e-3 && m->scale.length_m < 3e-3);
    for (int i = 0; i < 4 * m->npin; i++)
        assert_true(fabs(m->local[i]) < 3);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_dense),
        cmocka_unit_test(test_redundant),
        cmocka_unit_test(test_topology),
        cmocka_unit_test(test_scaling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
