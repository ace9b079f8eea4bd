/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every kind of constraint and force against differences: Jacobian and gamma along motions, forces
   against the derivative of the energy, S against G M^-1 G^T. */
#include "quantity/law_kind.h"
#include "multibody/systems.h"

/* bodies, joints and forces of every kind at random; nothing needs to fit together */
typedef struct zoo {
    rig r;
    fw_effects_loads loads;
    fw_quantity_law *law;
    fw_multibody_system *sys;
    uint64_t seed;
    bool stretches; /* the ground follows the law */
} zoo;

static double about(zoo *z, double size) {
    return size * (2 * rig_random(&z->seed) - 1);
}

static int some_body(zoo *z, int n, bool ground) {
    return (int)((n + ground) * rig_random(&z->seed)) - ground;
}

static void two_bodies(zoo *z, int n, int *a, int *b) {
    *a = some_body(z, n, true);
    do
        *b = some_body(z, n, true);
    while (*b == *a);
}

static void add_joints(fw_arena *arena, zoo *z, int n) {
    fw_mechanism *m = &z->r.m;
    m->joint = fw_arena_array(arena, fw_device_joint, 6);
    m->driver = fw_arena_array(arena, fw_device_driver, 3);
    for (int i = 0; i < 6; i++) {
        fw_device_joint *t = &m->joint[m->njoint++];
        *t = (fw_device_joint){.id = "tie",
                               .kind = (fw_device_joint_kind)(i % 3),
                               .ax_m = about(z, 1e-3),
                               .ay_m = about(z, 1e-3),
                               .bx_m = about(z, 1e-3),
                               .by_m = about(z, 1e-3),
                               .axis_rad = about(z, 3),
                               .angle_rad = about(z, 1),
                               .length_m = 1e-3,
                               .free_length_m = about(z, 1e-3)};
        two_bodies(z, n, &t->body_a, &t->body_b);
    }
    z->law[0] = (fw_quantity_law){
        .kind = &fw_quantity_law_sine, .frequency_Hz = 700, .phase_rad = 0.4, .end_s = 1};
    m->driver[0] =
        (fw_device_driver){.id = "turns", .revolute = 0, .joint = FW_NONE, .law = z->law[0]};
    m->driver[1] =
        (fw_device_driver){.id = "slides", .revolute = FW_NONE, .joint = 0, .law = z->law[0]};
    m->driver[2] =
        (fw_device_driver){.id = "stretches", .revolute = FW_NONE, .joint = 1, .law = z->law[0]};
    m->ndriver = 3;
}

static void add_terms(fw_arena *arena, zoo *z, int n) {
    fw_mechanism *m = &z->r.m;
    fw_effects_loads *t = &z->loads;
    t->nbody = n;
    t->constant = fw_arena_array(arena, double, 3 * (size_t)n);
    t->velocity = fw_arena_array(arena, double, 3 * (size_t)n);
    for (int i = 0; i < 3 * n; i++)
        t->constant[i] = about(z, i % 3 == 2 ? 1e-7 : 1e-4);
    t->torsion = fw_arena_array(arena, fw_effects_torsion, 2);
    t->stop = fw_arena_array(arena, fw_effects_stop, 2);
    t->load = fw_arena_array(arena, fw_effects_point_load, 2);
    t->timed = fw_arena_array(arena, fw_effects_timed_load, 2);
    t->spring = fw_arena_array(arena, fw_device_spring, 4);
    t->slide = fw_arena_array(arena, fw_effects_slide, 1);
    t->ntorsion = t->nstop = t->nload = t->ntimed = 2;
    t->nspring = 4, t->nslide = 1;
    for (int i = 0; i < 2; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        t->torsion[i] = (fw_effects_torsion){i, p->body_a, p->body_b, 1e-6, 2e-10, 0.1};
        t->stop[i] =
            (fw_effects_stop){i, p->body_a, p->body_b, i ? 1 : -1, i ? -9 : 9, 0.1, 3e-6, 1e-10};
        t->load[i] = (fw_effects_point_load){some_body(z, n, false), about(z, 1e-3), about(z, 1e-3),
                                             about(z, 1e-4), about(z, 1e-4)};
        t->timed[i] = (fw_effects_timed_load){
            some_body(z, n, false), about(z, 1e-3), about(z, 1e-3), about(z, 1e-4),
            about(z, 1e-4),         about(z, 1e-7), &z->law[0]};
    }
    for (int i = 0; i < 4; i++) {
        fw_device_spring *s = &t->spring[i];
        *s = (fw_device_spring){.ax_m = about(z, 1e-3),
                                .ay_m = about(z, 1e-3),
                                .bx_m = about(z, 1e-3),
                                .by_m = about(z, 1e-3),
                                .stiffness_N_per_m = 1,
                                .damping_Ns_per_m = 1e-4,
                                .length_m = 1e-4,
                                .cable = i > 1};
        two_bodies(z, n, &s->body_a, &s->body_b);
    }
    t->slide[0] = (fw_effects_slide){0, 2, 1e-4};
    if (z->stretches)
        t->stretch = (fw_effects_stretch){0.3, {about(z, 1e-3), about(z, 1e-3)}, &z->law[0], 0.3};
}

static zoo zoo_new(fw_arena *arena, uint64_t seed, bool stretches) {
    enum { N = 5 };
    zoo z = {.seed = seed, .stretches = stretches};
    z.r = rig_new(arena, N, 3, 0);
    z.law = fw_arena_array(arena, fw_quantity_law, 1);
    for (int i = 0; i < N; i++)
        rig_body(&z.r, "body", 1e-8 * (1 + rig_random(&z.seed)), 1e-14 * (1 + rig_random(&z.seed)),
                 about(&z, 2e-3), about(&z, 2e-3), about(&z, 3));
    for (int i = 0; i < 3; i++) {
        int a, b;
        two_bodies(&z, N, &a, &b);
        fw_mechanism_pin *p = rig_pin_local(&z.r, "pin", a, about(&z, 1e-3), about(&z, 1e-3), b,
                                            about(&z, 1e-3), about(&z, 1e-3));
        p->free_angle_rad = about(&z, 1);
    }
    add_joints(arena, &z, N);
    add_terms(arena, &z, N);
    z.sys = rig_system_with(arena, &z.r.m, &z.loads, 1e-2, NULL);
    z.sys->piece_s = 1e-3;
    return z;
}

enum { MOST = 64 };

static void state_of(zoo *z, double *y, double size) {
    for (int i = 0; i < z->sys->model->ny; i++)
        y[i] = about(z, size);
}

/* Psi, and its first and second derivative along u + s v at t + s, by central differences */
static void test_constraint_derivatives(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 80; seed++) {
        fw_arena *arena = fw_arena_new(0);
        zoo z = zoo_new(arena, seed, seed > 40);
        fw_multibody_system *sys = z.sys;
        const fw_multibody_model *m = sys->model;
        assert_true(m->nblock == 3 + 6 + 2 + 2 && !m->plain && m->driven);
        int n = 2 * m->nblock;
        double y[MOST], psi[5][MOST], rate[MOST], drift[MOST], gamma[MOST], u[MOST];
        double t = 1e-3 / m->scale.time_s, step = 1e-3;
        state_of(&z, y, 0.7);
        const double *v = y + m->nq;
        for (int k = 0; k < 5; k++) {
            double s = (k - 2) * step;
            for (int i = 0; i < m->nq; i++)
                u[i] = y[i] + s * v[i];
            fw_multibody_residual(sys, fw_multibody_pose_at(sys, t + s, u), psi[k]);
        }
        const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
        fw_multibody_jacobian(m, pose, v, rate);
        fw_multibody_drift(sys, pose, drift);
        fw_multibody_gamma(sys, pose, v, gamma);
        for (int i = 0; i < n; i++) {
            double first = (8 * (psi[3][i] - psi[1][i]) - (psi[4][i] - psi[0][i])) / (12 * step);
            double second =
                (16 * (psi[3][i] + psi[1][i]) - psi[4][i] - psi[0][i] - 30 * psi[2][i]) /
                (12 * step * step);
            assert_near(rate[i] + drift[i], first, 1e-9 * (1 + fabs(first)));
            assert_near(gamma[i], second, 3e-7 * (1 + fabs(second)));
        }
        fw_arena_free(arena);
    }
}

/* S v by the chain's blocks equals G M^-1 G^T v; G^T by rig_transpose and by the
   dense G */
static void test_products(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        fw_arena *arena = fw_arena_new(0);
        zoo z = zoo_new(arena, seed, false);
        fw_multibody_system *sys = z.sys;
        const fw_multibody_model *m = sys->model;
        int n = 2 * m->nblock;
        double y[MOST], l[MOST], a[MOST] = {0}, f[MOST] = {0}, rows[MOST], g[MOST * MOST];
        state_of(&z, y, 0.7);
        const fw_multibody_pose *pose = fw_multibody_pose_at(sys, 0, y);
        for (int i = 0; i < m->rows; i++)
            rows[i] = about(&z, 1);
        fw_multibody_unpack(m, rows, l);
        rig_transpose(m, pose, l, f);
        fw_multibody_apply(m, pose, l, a);
        fw_multibody_dense_jacobian(m, pose, g);
        for (int c = 0; c < m->nq; c++) {
            double sum = 0;
            for (int i = 0; i < m->rows; i++)
                sum += g[i * m->nq + c] * rows[i];
            assert_near(f[c], sum, 1e-13);
            assert_near(a[c], -(c % 3 == 2 ? m->jinv : m->minv)[c / 3] * sum,
                        1e-12 * (1 + fabs(sum) * m->jinv[c / 3]));
        }
        /* (S + eps D) x = b solved by the blocks, checked by products */
        double b[MOST], x[MOST], back[MOST];
        fw_multibody_chain_numbers s;
        assert_int_equal(fw_multibody_chain_numbers_new(arena, m, &s), FW_OK);
        fw_multibody_chain_assemble(m, pose, &s);
        assert_true(fw_multibody_chain_factor(&m->chain, &s, 1e-3));
        memcpy(x, l, sizeof x);
        memcpy(b, l, sizeof b);
        fw_multibody_chain_solve(&m->chain, &s, x);
        memset(a, 0, sizeof a);
        fw_multibody_apply(m, pose, x, a);
        fw_multibody_jacobian(m, pose, a, back);
        for (int i = 0; i < n; i++)
            assert_near(-back[i] + 1e-3 * m->chain.isotropic[i] * x[i], b[i], 1e-9);
        fw_arena_free(arena);
    }
}

static double potential(fw_multibody_system *sys, double t, const double *y) {
    fw_multibody_energy e = fw_multibody_energy_at(sys, t, y);
    return e.elastic - e.work;
}

/* without dampers and laws M a = -d(V - W)/du; dampers take exactly the power they are booked with
 */
static void test_forces(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        fw_arena *arena = fw_arena_new(0);
        zoo z = zoo_new(arena, seed, false);
        fw_multibody_system *sys = z.sys;
        const fw_multibody_model *m = sys->model;
        double y[MOST], work = 0, booked[2];
        state_of(&z, y, 0.7);
        y[m->dissipated] = y[m->worked] = 0;
        assert_int_equal(fw_multibody_switch_count(m), 4);
        const fw_multibody_pose *pose = fw_multibody_set_switches(sys, 1e-3 / m->scale.time_s, y);
        double with[MOST], without[MOST];
        memcpy(with, fw_multibody_forces(sys, pose, y + m->nq)->accel,
               sizeof(double) * (size_t)m->nq);
        fw_multibody_power(sys, pose, y + m->nq, booked);
        fw_multibody_model conservative = *m;
        conservative.ntimed = 0;
        sys->model = &conservative;
        double rest[MOST] = {0};
        memcpy(rest, y, sizeof(double) * (size_t)m->nq);
        pose = fw_multibody_pose_at(sys, 0, rest);
        memcpy(without, fw_multibody_forces(sys, pose, rest + m->nq)->accel,
               sizeof(double) * (size_t)m->nq);
        for (int i = 0; i < m->nq; i++) {
            const double h = 2e-4; /* a short spring bends its potential strongly */
            double p[4];
            for (int k = 0; k < 4; k++) {
                double u[MOST] = {0};
                memcpy(u, rest, sizeof u);
                u[i] += h * (k < 2 ? k - 2 : k - 1);
                p[k] = potential(sys, 0, u);
            }
            double slope = (8 * (p[2] - p[1]) - (p[3] - p[0])) / (12 * h);
            double mass = i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3];
            assert_near(mass * without[i], -slope, 1e-8 * (1 + fabs(slope)));
            work += mass * (with[i] - without[i]) * y[m->nq + i];
        }
        assert_near(work, booked[1] - booked[0], 1e-10 * (1 + fabs(booked[0])));
        fw_arena_free(arena);
    }
}

/* along any motion at any speed, on a ground that moves: Q.v = -dV/dt - what dampers take + what
   loads and the ground feed in */
static void test_moving_ground(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        fw_arena *arena = fw_arena_new(0);
        zoo z = zoo_new(arena, seed, true);
        fw_multibody_system *sys = z.sys;
        const fw_multibody_model *m = sys->model;
        double y[MOST], u[MOST] = {0}, value[5], booked[2], work = 0;
        const double t = 1e-3 / m->scale.time_s, step = 1e-4;
        state_of(&z, y, 0.7);
        y[m->dissipated] = y[m->worked] = 0;
        const fw_multibody_pose *pose = fw_multibody_set_switches(sys, t, y);
        const double *accel = fw_multibody_forces(sys, pose, y + m->nq)->accel;
        fw_multibody_power(sys, pose, y + m->nq, booked);
        for (int i = 0; i < m->nq; i++)
            work += (i % 3 == 2 ? m->inertia : m->mass)[i / 3] * accel[i] * y[m->nq + i];
        for (int k = 0; k < 5; k++) {
            for (int i = 0; i < m->nq; i++)
                u[i] = y[i] + (k - 2) * step * y[m->nq + i];
            value[k] = potential(sys, t + (k - 2) * step, u);
        }
        double rate = (8 * (value[3] - value[1]) - (value[4] - value[0])) / (12 * step);
        double size = 1 + fabs(rate) + fabs(booked[0]) + fabs(booked[1]);
        assert_near(work, -rate - booked[0] + booked[1], 1e-9 * size);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_constraint_derivatives),
        cmocka_unit_test(test_products),
        cmocka_unit_test(test_forces),
        cmocka_unit_test(test_moving_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
