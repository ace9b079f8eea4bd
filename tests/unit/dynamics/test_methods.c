/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All methods solve the same equations, M a + G^T lambda = Q, G a = -gamma, on random M and G; what
   they report; memory and numbers that are none. */
#include "multibody/multibody_dense.h"
#include "models.h"

enum { N = 15, ROWS = 12 };

typedef struct problem {
    double g[(N + 3) * N], mass[N], free[N], gamma[N + 3];
    int rows;
} problem;

/* `redundant` rows that are sums of others, with a gamma that agrees; masses over `spread` decades
 */
static problem any_problem(uint64_t seed, int rows, int redundant, double spread) {
    problem p = {.rows = rows + redundant};
    for (int i = 0; i < rows * N; i++)
        p.g[i] = 2 * rig_random(&seed) - 1;
    for (int j = 0; j < N; j++) {
        p.mass[j] = j % 3 == 1 ? p.mass[j - 1] : pow(10, spread * (rig_random(&seed) - 0.5));
        p.free[j] = 2 * rig_random(&seed) - 1;
    }
    for (int i = 0; i < rows; i++)
        p.gamma[i] = 2 * rig_random(&seed) - 1;
    for (int i = rows; i < p.rows; i++)
        for (int k = 0; k < rows; k += 2) {
            double c = 2 * rig_random(&seed) - 1;
            for (int j = 0; j < N; j++)
                p.g[i * N + j] += c * p.g[k * N + j];
            p.gamma[i] += c * p.gamma[k];
        }
    return p;
}

/* largest errors of the two equations, each against the size of its terms */
static void residuals(const problem *p, const double *a, const double *lambda, double *force,
                      double *constraint) {
    *force = *constraint = 0;
    for (int j = 0; j < N; j++) {
        double sum = p->mass[j] * (a[j] - p->free[j]), loads = fabs(p->mass[j] * a[j]);
        for (int i = 0; i < p->rows; i++) {
            sum += p->g[i * N + j] * lambda[i];
            loads += fabs(p->g[i * N + j] * lambda[i]);
        }
        *force = fmax(*force, fabs(sum) / loads);
    }
    for (int i = 0; i < p->rows; i++) {
        double sum = p->gamma[i], loads = fabs(sum);
        for (int j = 0; j < N; j++) {
            sum += p->g[i * N + j] * a[j];
            loads += fabs(p->g[i * N + j] * a[j]);
        }
        *constraint = fmax(*constraint, fabs(sum) / loads);
    }
}

static void solve(fw_arena *arena, const fw_multibody_dense_kernel *kernel, const problem *p,
                  double *a, double *lambda) {
    fw_multibody_dense *d;
    assert_int_equal(fw_multibody_dense_new(arena, p->rows, N, kernel, &d), FW_OK);
    memcpy(d->g, p->g, (size_t)(p->rows * N) * sizeof *p->g);
    for (int j = 0; j < N; j++) {
        d->root[j] = 1 / sqrt(p->mass[j]);
        a[j] = p->free[j];
    }
    assert_true(fw_multibody_dense_factor(d));
    fw_multibody_dense_accelerate(d, p->gamma, a, lambda);
}

static double difference(const double *a, const double *b, int n) {
    double worst = 0, size = 0;
    for (int i = 0; i < n; i++) {
        worst = fmax(worst, fabs(a[i] - b[i]));
        size = fmax(size, fabs(b[i]));
    }
    return worst / size;
}

static void kernels_agree(void **state) {
    (void)state;
    for (int c = 0; c < 60; c++) {
        fw_arena *arena = fw_arena_new(0);
        int redundant = c % 3 == 2 ? 1 + c % 6 : 0;
        problem p = any_problem(100 + (uint64_t)c, ROWS - c % 4, redundant % 4, c % 2 ? 2 : 0);
        double first[N], first_lambda[N + 3];
        int kernels = 0;
        for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
            const char *name = fw_multibody_method_at(k).name;
            const fw_multibody_dense_kernel *kernel = fw_multibody_method_find(name)->kernel;
            double a[N], lambda[N + 3], force, constraint;
            if (!kernel) continue; /* makes use of what G looks like */
            solve(arena, kernel, &p, a, lambda);
            residuals(&p, a, lambda, &force, &constraint);
            if (kernels++ == 0) {
                memcpy(first, a, sizeof a);
                memcpy(first_lambda, lambda, sizeof lambda);
            }
            double apart = difference(a, first, N), l = difference(lambda, first_lambda, p.rows);
            if (!(force < 1e-13 && constraint < 1e-13 && apart < 1e-12) ||
                (redundant == 0 && !(l < 1e-12)))
                fail_msg("%s, case %d: force %.1e constraint %.1e a %.1e lambda %.1e", name, c,
                         force, constraint, apart, l);
        }
        assert_true(kernels >= 7);
        fw_arena_free(arena);
    }
}

/* what a run may cost goes by it (study/problem.c) */
static void every_method_states_its_cost(void **state) {
    (void)state;
    for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
        const char *name = fw_multibody_method_at(k).name;
        const fw_multibody_method_cost cost = fw_multibody_method_find(name)->cost;
        if (!(cost.six_bar > 1000 && cost.power >= 1)) fail_msg("%s states no cost", name);
    }
}

/* ---- reports ---- */

typedef struct outcome {
    fw_status status;
    const fw_dynamics_motion *motion;
    const char *message;
} outcome;

static outcome run(fw_arena *arena, const rig *r, const char *method, double rtol) {
    fw_diags *diags = fw_arena_one(arena, fw_diags);
    *diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {
        .method = method, .rtol = rtol, .samples = 11, .effects = {.mode = FW_EFFECTS_ALL}};
    outcome out = {0};
    out.status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, diags, &out.motion);
    out.message = diags->count ? diags->item[0].message : "";
    return out;
}

static void reports_say_what_was_met(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig six = rig_six_bar(arena, false), twice = rig_six_bar(arena, true);
    rig windows = rig_windows(arena, 1);
    static const char *const ranked[] = {"udwadia-kalaba", "svd", "qr", "schur"};
    for (int i = 0; i < 4; i++) {
        outcome out = run(arena, &six, ranked[i], 1e-8);
        assert_non_null(
            strstr(out.motion->method_report, "all 12 constraint rows are independent"));
        out = run(arena, &twice, ranked[i], 1e-8);
        assert_non_null(strstr(out.motion->method_report, "2 of 14 constraint rows are redundant"));
        out = run(arena, &windows, ranked[i], 1e-12);
        assert_non_null(strstr(out.motion->method_report, "a singular position"));
    }
    outcome out = run(arena, &six, "coordinate-partitioning", 1e-8);
    assert_string_equal(out.motion->method_report,
                        "independent coordinates: AB.phi, BC.phi, EF.phi; changed 0 times");
    out = run(arena, &twice, "coordinate-partitioning", 1e-8);
    assert_non_null(strstr(out.motion->method_report, "2 of 14 constraint rows"));
    out = run(arena, &windows, "coordinate-partitioning", 1e-12);
    assert_null(strstr(out.motion->method_report, "changed 0 times"));
    out = run(arena, &six, "minimal", 1e-8);
    assert_string_equal(out.motion->method_report,
                        "independent coordinates: AB.phi, BC.phi, CD.phi; 1 dyad closed");
    fw_arena_free(arena);
}

/* ---- memory ---- */

static fw_multibody_system *six_bar_system(fw_arena *arena, const rig *r, const char *method,
                                           fw_status *status) {
    double q[15];
    for (int b = 0; b < 5; b++)
        q[3 * b] = r->m.body[b].x_m, q[3 * b + 1] = r->m.body[b].y_m, q[3 * b + 2] = 0;
    fw_diags diags = fw_diags_new(arena);
    const fw_multibody_model *m;
    fw_multibody_system *sys = NULL;
    *status =
        fw_multibody_model_new(arena, &r->m, NULL, q, 1, fw_multibody_method_find(method), &m);
    if (*status == FW_OK) *status = fw_multibody_system_new(arena, m, &r->m, &diags, &sys);
    return sys;
}

static void the_loop_allocates_nothing(void **state) {
    (void)state;
    for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false);
        fw_status status;
        fw_multibody_system *sys =
            six_bar_system(arena, &r, fw_multibody_method_at(k).name, &status);
        assert_int_equal(status, FW_OK);
        double y[32] = {0}, f[32];
        long before = fw_arena_count();
        fw_multibody_rhs(sys, 0, y, f);
        assert_true(fw_multibody_project(sys, 0, y, f));
        assert_int_equal(fw_arena_count(), before);
        fw_arena_free(arena);
    }
}

static void memory_short_is_said(void **state) {
    (void)state;
    for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
        fw_status status = FW_NOMEM;
        for (long n = 1; status == FW_NOMEM; n++) {
            fw_arena *arena = fw_arena_new(0);
            rig r = rig_six_bar(arena, false);
            fw_arena_fail_at(n, 1);
            six_bar_system(arena, &r, fw_multibody_method_at(k).name, &status);
            fw_arena_fail_at(0, 0);
            fw_arena_free(arena);
            assert_true(n < 400);
        }
        assert_int_equal(status, FW_OK);
    }
}

/* states that are not numbers end as a refused evaluation, never in LAPACK */
static void not_a_number_is_refused(void **state) {
    (void)state;
    for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false);
        fw_status status;
        fw_multibody_system *sys =
            six_bar_system(arena, &r, fw_multibody_method_at(k).name, &status);
        double y[32] = {0}, f[32];
        y[2] = (double)NAN;
        fw_multibody_rhs(sys, 0, y, f);
        assert_true(isnan(f[15]));
        y[2] = 0, y[17] = (double)INFINITY;
        fw_multibody_rhs(sys, 0, y, f);
        assert_true(!isfinite(f[15]));
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_agree),
        cmocka_unit_test(every_method_states_its_cost),
        cmocka_unit_test(reports_say_what_was_met),
        cmocka_unit_test(the_loop_allocates_nothing),
        cmocka_unit_test(memory_short_is_said),
        cmocka_unit_test(not_a_number_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
