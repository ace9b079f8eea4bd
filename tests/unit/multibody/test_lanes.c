/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Many designs at once against each of them alone. */
#include "maths/ode.h"
#include "multibody/kernel.h"
#include "kernel_rigs.h"

enum { MOST = 19 };

/* designs of one topology with their own numbers. kind 0: six-bars (a closed loop); 1: hanging
   chains; 2: windows; 3: hinge D twice */
static rig vary(fw_arena *arena, int kind, int design) {
    uint64_t seed = (uint64_t)(100 * kind + design);
    rig r = kind == 2 ? rig_windows(arena, 3) : rig_six_bar(arena, kind == 3);
    if (kind == 1) r.m.npin = 5; /* F let go */
    for (int b = 0; b < r.m.nbody; b++) {
        r.m.body[b].mass_kg *= 0.7 + rig_random(&seed);
        r.m.body[b].inertia_kg_m2 *= 0.7 + rig_random(&seed);
    }
    for (int i = 0; i < r.m.npin; i++) {
        fw_mechanism_pin *p = &r.m.pin[i];
        p->stiffness_Nm_per_rad *= 0.5 + rig_random(&seed);
        p->damping_Nms_per_rad *= 0.5 + rig_random(&seed);
    }
    for (int i = 0; i < r.scene.nforce; i++)
        r.scene.force[i].fx_N *= 2 * rig_random(&seed);
    return r;
}

typedef struct batch {
    fw_arena *arena;
    const fw_multibody_model *model[MOST];
    fw_multibody_system *system[MOST];
    fw_multibody_kernel *kernel[MOST];
    double *y[MOST];
    int count, ny;
} batch;

static batch begin(int kind, int count) {
    batch b = {.arena = fw_arena_new(0), .count = count};
    for (int d = 0; d < count; d++) {
        rig r = vary(b.arena, kind, d);
        b.system[d] = rig_system(b.arena, &r);
        const fw_multibody_model *m = b.system[d]->model;
        b.model[d] = m;
        assert_int_equal(fw_multibody_kernel_new(b.arena, m, &b.kernel[d]), FW_OK);
        b.y[d] = rig_state(b.arena, m, 0.3, (uint64_t)d);
        b.ny = m->ny;
    }
    return b;
}

static fw_multibody_lanes *lanes_of(batch *b, const char *set, double **y, double **f) {
    fw_multibody_lanes *l;
    assert_int_equal(fw_multibody_lanes_new(b->arena, b->model, b->count, set, &l), FW_OK);
    assert_non_null(l);
    assert_string_equal(fw_multibody_lanes_set_name(l), set);
    *y = fw_arena_array(b->arena, double, fw_multibody_lanes_size(l));
    *f = fw_arena_array(b->arena, double, fw_multibody_lanes_size(l));
    for (int d = 0; d < b->count; d++)
        fw_multibody_lanes_put(l, d, b->y[d], *y);
    return l;
}

static void expect(const double *got, const double *want, int n, double tolerance) {
    double most = rig_largest(want, n);
    for (int i = 0; i < n; i++)
        assert_near(got[i], want[i], tolerance * most);
}

static void test_each_lane(void **state) {
    (void)state;
    for (int kind = 0; kind < 4; kind++)
        for (int count = 1; count <= MOST; count += 3)
            for (int s = 0; fw_multibody_lanes_set(s); s++) {
                batch b = begin(kind, count);
                double *y, *f, got[64], want[64], lambda[64];
                fw_multibody_lanes *l = lanes_of(&b, fw_multibody_lanes_set(s), &y, &f);
                fw_multibody_lanes_rhs(l, y, f);
                for (int d = 0; d < count; d++) {
                    fw_multibody_lanes_get(l, d, f, got);
                    fw_multibody_kernel_rhs(b.kernel[d], b.y[d], want);
                    expect(got, want, b.ny, 1e-13);
                    fw_multibody_lanes_lambda(l, d, lambda);
                    if (kind != 3) /* shares between the two hinges D are round-off */
                        expect(lambda, fw_multibody_kernel_lambda(b.kernel[d]),
                               2 * b.model[d]->nblock, 1e-13);
                }
                fw_arena_free(b.arena);
            }
}

/* one closed loop of n bodies in any pose: pins written from either side and in any order, loads,
   masses over `decades` */
static rig closed_loop(fw_arena *arena, int n, double decades, uint64_t design) {
    uint64_t shape = (uint64_t)n, seed = 50 + design;
    rig r = rig_new(arena, n, n + 1, 0);
    for (int i = 0; i < n; i++) { /* one random number per statement: their order is defined */
        double mass = pow(10, decades * (rig_random(&seed) - 0.5));
        double arm = 0.3 + rig_random(&seed), x = i + rig_random(&seed);
        double y = rig_random(&seed) - 0.5, phi = 3 * rig_random(&seed);
        rig_body(&r, "link", mass, mass * 0.2 * arm * arm, x, y, phi);
    }
    for (int i = 0; i <= n; i++) {
        int at = n % 2 ? n - i : i, a = at - 1, b = at == n ? FW_GROUND : at;
        bool turned = rig_random(&shape) < 0.5;
        double x = at + 0.3 * rig_random(&seed), y = 0.8 * sin(2.1 * at) * rig_random(&seed);
        double k = 3 * rig_random(&seed), c = rig_random(&seed);
        rig_pin(&r, "pin", turned ? b : a, turned ? a : b, x, y, k, c);
    }
    for (int i = 0; i < n; i++) {
        double fx = 5 * rig_random(&seed), fy = -5 * rig_random(&seed);
        rig_force(&r, i, fx, fy);
        rig_torque(&r, i, rig_random(&seed));
    }
    r.scene.duration_s = 1;
    return r;
}

enum { UNKNOWNS = 8 * 3 + 9 * 2 };

/* x of A x = r (n), by Gaussian elimination with partial pivoting in 64 bits */
static void eliminate(int n, long double A[UNKNOWNS][UNKNOWNS + 1]) {
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k; i < n; i++)
            if (fabsl(A[i][k]) > fabsl(A[best][k])) best = i;
        for (int j = 0; j <= n; j++) {
            long double keep = A[k][j];
            A[k][j] = A[best][j], A[best][j] = keep;
        }
        for (int i = 0; i < n; i++) {
            long double factor = i == k ? 0 : A[i][k] / A[k][k];
            for (int j = k; j <= n && i != k; j++)
                A[i][j] -= factor * A[k][j];
        }
    }
    for (int k = 0; k < n; k++)
        A[k][n] /= A[k][k];
}

/* one pin into M a + G^T lambda = Q, G a = -G' v */
static void add_pin(const fw_multibody_model *m, const double *y, int pin, int row, int n,
                    long double A[UNKNOWNS][UNKNOWNS + 1]) {
    for (int side = 0; side < 2; side++) {
        int b = m->body[2 * pin + side];
        if (b == m->nbody) continue;
        const double *l = m->local + 4 * pin + 2 * side;
        long double sign = side ? -1 : 1;
        const long double lx = (long double)l[0], ly = (long double)l[1];
        const long double w = (long double)y[m->nq + 3 * b + 2];
        long double angle = (long double)m->origin[3 * b + 2] + (long double)y[3 * b + 2];
        long double x = cosl(angle) * lx - sinl(angle) * ly;
        long double up = sinl(angle) * lx + cosl(angle) * ly;
        A[row][3 * b] = A[3 * b][row] = A[row + 1][3 * b + 1] = A[3 * b + 1][row + 1] = sign;
        A[row][3 * b + 2] = A[3 * b + 2][row] = -sign * up;
        A[row + 1][3 * b + 2] = A[3 * b + 2][row + 1] = sign * x;
        A[row][n] += sign * w * w * x, A[row + 1][n] += sign * w * w * up;
    }
}

/* accelerations (3 bodies) and joint forces (2 pins) from the equations themselves */
static void reference(const fw_multibody_model *m, const double *y, double *a, double *lambda) {
    static long double A[UNKNOWNS][UNKNOWNS + 1];
    const int n = m->nq + 2 * m->nblock;
    memset(A, 0, sizeof A);
    for (int i = 0; i < m->nq; i++) {
        A[i][i] = 1 / (long double)(i % 3 == 2 ? m->jinv[i / 3] : m->minv[i / 3]);
        A[i][n] = A[i][i] * (long double)m->constant[i];
    }
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *t = &m->torsion[i];
        const double *v = y + m->nq;
        long double turn = -(long double)t->angle0, rate = 0;
        if (t->a < m->nbody)
            turn += (long double)y[3 * t->a + 2], rate += (long double)v[3 * t->a + 2];
        if (t->b < m->nbody)
            turn -= (long double)y[3 * t->b + 2], rate -= (long double)v[3 * t->b + 2];
        long double torque = (long double)t->k * turn + (long double)t->c * rate;
        if (t->a < m->nbody) A[3 * t->a + 2][n] -= torque;
        if (t->b < m->nbody) A[3 * t->b + 2][n] += torque;
    }
    for (int i = 0; i < m->nblock; i++)
        add_pin(m, y, i, m->nq + 2 * i, n, A);
    eliminate(n, A);
    for (int i = 0; i < m->nq; i++)
        a[i] = (double)A[i][n];
    for (int i = 0; i < 2 * m->nblock; i++)
        lambda[i] = (double)A[m->nq + i][n];
}

/* the largest acceleration, or what the largest joint force gives to the lightest body */
static double scale_of(const fw_multibody_model *m, const double *a, const double *lambda) {
    double light = fmax(rig_largest(m->minv, m->nbody), rig_largest(m->jinv, m->nbody));
    return fmax(rig_largest(a, m->nq), rig_largest(lambda, 2 * m->nblock) * light);
}

/* loops of all lengths: up to 6 bodies in their own form, longer ones in that of the blocks; equal
   masses, and masses over two and four decades. Accelerations against the largest that a joint
   force gives to the lightest body. Of 1140 such loops each, the worst was off by 4e-16, 1e-15 and
   3e-12 up to 6 bodies, by 3e-14, 6e-14 and 3e-13 above; joint forces by 1e-13, 6e-13 and 8e-11. */
static void test_loops(void **state) {
    (void)state;
    static const double tolerance[2][3] = {{2e-15, 1e-14, 1e-11}, {1e-13, 2e-13, 1e-11}};
    static const double force_tolerance[3] = {3e-13, 2e-12, 2e-10};
    for (int n = 3; n <= 8; n++)
        for (int decades = 0; decades <= 4; decades += 2)
            for (int s = 0; fw_multibody_lanes_set(s); s++) {
                batch b = {.arena = fw_arena_new(0), .count = MOST};
                for (int d = 0; d < MOST; d++) {
                    rig r = closed_loop(b.arena, n, decades, (uint64_t)d);
                    const fw_multibody_model *m = rig_model(b.arena, &r);
                    b.model[d] = m, b.ny = m->ny;
                    assert_int_equal(fw_multibody_kernel_new(b.arena, m, &b.kernel[d]), FW_OK);
                    assert_int_equal(b.kernel[d]->core.loop != NULL, n <= FW_LOOP_MOST);
                    b.y[d] = rig_state(b.arena, m, 1, (uint64_t)(100 * n + d));
                }
                double *y, *f, got[64], want[64], lambda[64], forces[64];
                fw_multibody_lanes *l = lanes_of(&b, fw_multibody_lanes_set(s), &y, &f);
                fw_multibody_lanes_rhs(l, y, f);
                for (int d = 0; d < MOST; d++) {
                    const int nq = b.model[d]->nq;
                    reference(b.model[d], b.y[d], want, forces);
                    fw_multibody_lanes_get(l, d, f, got);
                    fw_multibody_lanes_lambda(l, d, lambda);
                    double most = scale_of(b.model[d], want, forces);
                    for (int i = 0; i < nq; i++)
                        assert_near(got[nq + i], want[i], tolerance[n > 6][decades / 2] * most);
                    expect(lambda, forces, 2 * b.model[d]->nblock, force_tolerance[decades / 2]);
                    assert_memory_equal(got, b.y[d] + nq, sizeof(double) * (size_t)nq);
                    fw_multibody_kernel_rhs(b.kernel[d], b.y[d], want);
                    if (b.ny > 2 * nq) assert_near(got[2 * nq], want[2 * nq], 1e-14 * want[2 * nq]);
                }
                fw_arena_free(b.arena);
            }
}

/* a four-bar at the angle p from the pose where all bars lie on one line: its condition grows as
   1/p^2. Above 1e-2 the lanes solve in the form of loops, below by the blocks, and where those give
   up by the careful solve of the single kernel */
static void test_loops_near_singular(void **state) {
    (void)state;
    static const double flat[MOST] = {0.3,  0.1,  3e-2, 2e-2,  1e-2,  5e-3,  2e-3, 1e-3, 3e-4, 1e-4,
                                      1e-6, 1e-9, -0.1, -1e-2, -3e-3, -1e-5, 0.2,  1,    -0.5};
    for (int s = 0; fw_multibody_lanes_set(s); s++) {
        batch b = {.arena = fw_arena_new(0), .count = MOST};
        rig r = rig_windows(b.arena, 1);
        const fw_multibody_model *m = rig_model(b.arena, &r);
        for (int d = 0; d < MOST; d++) {
            b.model[d] = m, b.ny = m->ny;
            b.y[d] = rig_state(b.arena, m, 0.1, (uint64_t)d);
            for (int i = 0; i < 3; i++)
                b.y[d][3 * i + 2] = i < 2 ? -1.57079632679489661923 + flat[d] : 0;
        }
        fw_multibody_kernel *k;
        assert_int_equal(fw_multibody_kernel_new(b.arena, m, &k), FW_OK);
        double *y, *f, got[64], want[64];
        fw_multibody_lanes *l = lanes_of(&b, fw_multibody_lanes_set(s), &y, &f);
        fw_multibody_lanes_rhs(l, y, f);
        for (int d = 0; d < MOST; d++) {
            fw_multibody_kernel_rhs(k, b.y[d], want);
            fw_multibody_lanes_get(l, d, f, got);
            expect(got, want, b.ny, fmin(1e-7, 1e-13 / (flat[d] * flat[d])));
        }
        fw_arena_free(b.arena);
    }
}

static void test_projection(void **state) {
    (void)state;
    for (int kind = 0; kind < 4; kind++)
        for (int s = 0; fw_multibody_lanes_set(s); s++) {
            batch b = begin(kind, 11);
            double *y, *f, got[64], want[64], alone[64];
            for (int d = 0; d < 11; d++)
                for (int i = 0; i < b.ny; i++)
                    b.y[d][i] *= 1e-5;
            fw_multibody_lanes *l = lanes_of(&b, fw_multibody_lanes_set(s), &y, &f);
            fw_multibody_lanes_rhs(l, y, f);
            assert_true(fw_multibody_lanes_project(l, y, f));
            for (int d = 0; d < 11; d++) {
                memcpy(alone, b.y[d], sizeof(double) * (size_t)b.ny);
                fw_multibody_kernel_rhs(b.kernel[d], alone, want);
                assert_true(fw_multibody_kernel_project(b.kernel[d], alone, want));
                fw_multibody_lanes_get(l, d, y, got);
                for (int i = 0; i < b.ny; i++)
                    assert_near(got[i], alone[i], 1e-14);
                fw_multibody_lanes_get(l, d, f, got);
                for (int i = 0; i < b.ny; i++) /* of order one in scaled units */
                    assert_near(got[i], want[i], 1e-12);
            }
            fw_arena_free(b.arena);
        }
}

/* a design at its singular position takes the careful solve, one that is not a number is lost; the
   others keep their bits. An angle of a million turns is no different. */
static void test_lanes_are_alone(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind += 2)
        for (int s = 0; fw_multibody_lanes_set(s); s++) {
            batch b = begin(kind, 8);
            double *y, *f, *g, got[64], want[64];
            fw_multibody_lanes *l = lanes_of(&b, fw_multibody_lanes_set(s), &y, &f);
            g = fw_arena_array(b.arena, double, fw_multibody_lanes_size(l));
            fw_multibody_lanes_rhs(l, y, f);
            double flat[64] = {0};
            if (kind == 2) /* all bars on a line */
                for (int i = 0; i <= 3; i++)
                    flat[3 * i + 2] = -1.57079632679489661923;
            fw_multibody_lanes_put(l, 2, flat, y);
            memcpy(want, b.y[4], sizeof(double) * (size_t)b.ny);
            want[2] = (double)NAN;
            fw_multibody_lanes_put(l, 4, want, y);
            memcpy(want, b.y[5], sizeof(double) * (size_t)b.ny);
            want[5] += 6.283185307179586e6;
            fw_multibody_lanes_put(l, 5, want, y);
            fw_multibody_lanes_rhs(l, y, g);
            for (int d = 0; d < 8; d++) {
                fw_multibody_lanes_get(l, d, f, want);
                fw_multibody_lanes_get(l, d, g, got);
                if (d == 2) {
                    fw_multibody_kernel_rhs(b.kernel[d], flat, want);
                    expect(got, want, b.ny, 1e-10);
                } else if (d == 4) {
                    assert_true(isnan(got[b.model[d]->nq + 2]));
                } else if (d == 5) {
                    assert_true(isfinite(got[b.model[d]->nq + 5]) != 0);
                } else {
                    assert_memory_equal(got, want, sizeof(double) * (size_t)b.ny);
                }
            }
            fw_arena_free(b.arena);
        }
}

/* the lockstep run against each design alone, at their own durations */
static void test_integrate(void **state) {
    (void)state;
    for (int s = 0; fw_multibody_lanes_set(s); s++) {
        batch b = begin(0, 5);
        double *y, *f, duration[5], atol[40], got[40];
        fw_multibody_lanes *l = lanes_of(&b, fw_multibody_lanes_set(s), &y, &f);
        fw_multibody_lanes_run run;
        for (int i = 0; i < b.ny; i++)
            atol[i] = 1e-11;
        for (int d = 0; d < 5; d++) {
            duration[d] = (1 + 0.5 * d) * 1e-3 / b.model[d]->scale.time_s;
            memset(b.y[d], 0, sizeof(double) * (size_t)b.ny);
            fw_multibody_lanes_put(l, d, b.y[d], y);
        }
        assert_int_equal(fw_multibody_lanes_integrate(b.arena, l, duration, 1e-11, atol, y, &run),
                         FW_OK);
        assert_true(run.steps > 10 && run.rhs > 11 * run.steps);
        for (int d = 0; d < 5; d++) {
            const fw_multibody_model *m = b.model[d];
            const fw_maths_ode ode = {.context = b.system[d],
                                      .rhs = fw_multibody_rhs,
                                      .project = fw_multibody_project,
                                      .n = m->ny,
                                      .controlled = 2 * m->nq};
            fw_maths_stepper *alone;
            assert_int_equal(fw_maths_stepper_new(b.arena, fw_maths_stepper_find("dop853"), &ode,
                                                  1e-11, atol, &alone),
                             FW_OK);
            fw_maths_stepper_start(alone, 0, b.y[d], duration[d]);
            while (alone->t < alone->t_end)
                assert_int_equal(fw_maths_stepper_step(alone), FW_ODE_STEP);
            fw_multibody_lanes_get(l, d, y, got);
            for (int i = 0; i < b.ny; i++)
                assert_near(got[i], alone->y[i], 1e-9);
            fw_maths_stepper_free(alone);
        }
        fw_arena_free(b.arena);
    }
}

static void test_refused(void **state) {
    (void)state;
    batch b = begin(0, 3), other = begin(2, 1);
    fw_multibody_lanes *l;
    assert_int_equal(fw_multibody_lanes_new(b.arena, b.model, 3, "abacus", &l), FW_USAGE);
    assert_int_equal(fw_multibody_lanes_new(b.arena, b.model, 0, NULL, &l), FW_USAGE);
    b.model[2] = other.model[0];
    assert_int_equal(fw_multibody_lanes_new(b.arena, b.model, 3, NULL, &l), FW_OK);
    assert_null(l);
    assert_non_null(fw_multibody_lanes_set(0)); /* portable at least, on any processor */
    assert_null(fw_multibody_lanes_set(9));
    fw_arena_free(b.arena);
    fw_arena_free(other.arena);
}

static void test_memory(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind += 2) {
        batch b = begin(kind, 9);
        fw_status status = FW_NOMEM;
        int n = 1;
        for (; n < 200 && status != FW_OK; n++) {
            fw_multibody_lanes *l;
            fw_arena_fail_at(n, 0);
            status = fw_multibody_lanes_new(b.arena, b.model, 9, NULL, &l);
            fw_arena_fail_at(0, 0);
            assert_true(status == FW_OK ? l != NULL : status == FW_NOMEM && l == NULL);
        }
        assert_true(n > 5 && n < 200);
        double *y, *f;
        fw_multibody_lanes *l = lanes_of(&b, fw_multibody_lanes_set(0), &y, &f);
        fw_arena_fail_at(0, 0);
        long count = fw_arena_count();
        fw_multibody_lanes_rhs(l, y, f);
        fw_multibody_lanes_project(l, y, f);
        assert_int_equal(fw_arena_count(), count);
        fw_arena_free(b.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_lane),
        cmocka_unit_test(test_loops),
        cmocka_unit_test(test_loops_near_singular),
        cmocka_unit_test(test_projection),
        cmocka_unit_test(test_lanes_are_alone),
        cmocka_unit_test(test_integrate),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
