/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All methods solve the same equations: M a + G^T lambda = Q, G a = -gamma on random M and G, then
   the same motions. */
#include "dynamics/methods.h"
#include "dynamics/dense.h"
#include "models.h"
#include <stdlib.h>

enum { N = 15, ROWS = 12 };

static const struct kernel_row {
    const char *name;
    const fw_dense_kernel *kernel;
} kernels[] = {
    {"augmented", &fw_augmented_kernel},
    {"udwadia-kalaba", &fw_udwadia_kalaba_kernel},
    {"svd", &fw_svd_kernel},
    {"qr", &fw_qr_kernel},
    {"schur", &fw_schur_kernel},
    {"block-least-squares", &fw_block_least_squares_kernel},
    {"coordinate-partitioning", &fw_coordinate_partitioning_kernel},
};
enum { KERNELS = sizeof kernels / sizeof kernels[0] };

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
        double sum = p->mass[j] * (a[j] - p->free[j]), terms = fabs(p->mass[j] * a[j]);
        for (int i = 0; i < p->rows; i++) {
            sum += p->g[i * N + j] * lambda[i];
            terms += fabs(p->g[i * N + j] * lambda[i]);
        }
        *force = fmax(*force, fabs(sum) / terms);
    }
    for (int i = 0; i < p->rows; i++) {
        double sum = p->gamma[i], terms = fabs(sum);
        for (int j = 0; j < N; j++) {
            sum += p->g[i * N + j] * a[j];
            terms += fabs(p->g[i * N + j] * a[j]);
        }
        *constraint = fmax(*constraint, fabs(sum) / terms);
    }
}

static void solve(fw_arena *arena, const fw_dense_kernel *kernel, const problem *p, double *a,
                  double *lambda) {
    fw_dense *d;
    assert_int_equal(fw_dense_new(arena, p->rows, N, kernel, &d), FW_OK);
    memcpy(d->g, p->g, (size_t)(p->rows * N) * sizeof *p->g);
    for (int j = 0; j < N; j++) {
        d->root[j] = 1 / sqrt(p->mass[j]);
        a[j] = p->free[j];
    }
    assert_true(fw_dense_factor(d));
    fw_dense_accelerate(d, p->gamma, a, lambda);
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
        for (int k = 0; k < KERNELS; k++) {
            double a[N], lambda[N + 3], force, constraint;
            solve(arena, kernels[k].kernel, &p, a, lambda);
            residuals(&p, a, lambda, &force, &constraint);
            if (!k) {
                memcpy(first, a, sizeof a);
                memcpy(first_lambda, lambda, sizeof lambda);
            }
            double apart = difference(a, first, N), l = difference(lambda, first_lambda, p.rows);
            if (!(force < 1e-13 && constraint < 1e-13 && apart < 1e-12) ||
                (redundant == 0 && !(l < 1e-12)))
                fail_msg("%s, case %d: force %.1e constraint %.1e a %.1e lambda %.1e",
                         kernels[k].name, c, force, constraint, apart, l);
        }
        fw_arena_free(arena);
    }
}

/* ---- motions ---- */

typedef struct outcome {
    fw_status status;
    const fw_motion *motion;
    const char *message;
} outcome;

static outcome run(fw_arena *arena, const rig *r, const char *method, double rtol) {
    fw_diags *diags = fw_arena_one(arena, fw_diags);
    *diags = fw_diags_new(arena);
    fw_motion_options o = {
        .method = method, .rtol = rtol, .samples = 11, .effects = {FW_EFFECTS_ALL, NULL}};
    outcome out = {0};
    out.status = fw_simulate(arena, &r->m, &r->scene, &o, diags, &out.motion);
    out.message = diags->count ? diags->item[0].message : "";
    return out;
}

static bool is(const char *a, const char *b) {
    return strcmp(a, b) == 0;
}

/* largest difference of all samples: lengths over `length`, velocities over their largest */
static void motions_apart(const fw_motion *a, const fw_motion *b, double length, double *q,
                          double *v) {
    double speed[2] = {0, 0};
    *q = *v = 0;
    int n = 3 * a->nbody * a->nsample;
    for (int i = 0; i < n; i++)
        speed[i % 3 == 2] = fmax(speed[i % 3 == 2], fabs(b->v[i]));
    for (int i = 0; i < n; i++) {
        *q = fmax(*q, fabs(a->q[i] - b->q[i]) / (i % 3 == 2 ? 1 : length));
        *v = fmax(*v, fabs(a->v[i] - b->v[i]) / fmax(speed[i % 3 == 2], 1e-300));
    }
}

/* every method that takes the mechanism against the chain. `unique`: no redundant rows, so that the
   reactions are the same, too. Returns the methods compared. */
static int compare_all(fw_arena *arena, const rig *r, const char *name, double rtol, double length,
                       bool unique, double allowed) {
    outcome chain = run(arena, r, "chain", rtol);
    assert_int_equal(chain.status, FW_OK);
    int count = 0;
    for (size_t k = 1; fw_method_at(k).name; k++) {
        const char *method = fw_method_at(k).name;
        outcome other = run(arena, r, method, rtol);
        if (other.status == FW_SOLVER && is(method, "minimal")) {
            assert_non_null(strstr(other.message, "two bodies at a time"));
            continue;
        }
        if (other.status != FW_OK) fail_msg("%s, %s: %s", name, method, other.message);
        const fw_motion *a = other.motion, *b = chain.motion;
        double q, v, force = 0, size = 0;
        motions_apart(a, b, length, &q, &v);
        for (int i = 0; i < 2 * a->npin * a->nsample; i++) {
            force = fmax(force, fabs(a->reaction_N[i] - b->reaction_N[i]));
            size = fmax(size, fabs(b->reaction_N[i]));
        }
        if (getenv("VERBOSE"))
            print_message("%s, %s: q %.1e v %.1e force %.1e\n", name, method, q, v, force / size);
        if (!(q <= allowed && v <= 10 * allowed && (!unique || force <= 100 * allowed * size)))
            fail_msg("%s, %s: q %.1e v %.1e force %.1e", name, method, q, v, force / size);
        assert_true(a->stats.max_constraint_norm <= 1e-12);
        count++;
    }
    return count;
}

static void methods_agree(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig six = rig_six_bar(arena, false), twice = rig_six_bar(arena, true);
    rig squeezer = rig_squeezer(arena), pendulum = rig_pendulum(arena);
    assert_int_equal(compare_all(arena, &six, "six-bar", 1e-13, 1e-3, true, 1e-11), 8);
    assert_int_equal(compare_all(arena, &twice, "hinge twice", 1e-12, 1e-3, false, 1e-11), 7);
    assert_int_equal(compare_all(arena, &squeezer, "squeezer", 1e-12, 1e-2, true, 1e-10), 8);
    assert_int_equal(compare_all(arena, &pendulum, "pendulum", 1e-12, 1, true, 1e-11), 8);
    fw_arena_free(arena);
}

static void methods_agree_on_random_mechanisms(void **state) {
    (void)state;
    int minimal = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_any(arena, seed);
        char name[32];
        snprintf(name, sizeof name, "random %d", (int)seed);
        minimal += compare_all(arena, &r, name, 1e-12, 1e-3, true, 1e-9) == 8;
        fw_arena_free(arena);
    }
    assert_true(minimal >= 10);
}

/* the table in tests/data at 11 of its rows */
static void every_method_gives_the_six_bar_table(void **state) {
    (void)state;
    static double table[101][30];
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/sixbar_ref_0p1ms.txt", "r");
    assert_non_null(file);
    char line[2048];
    int row = 0;
    while (row < 101 && fgets(line, sizeof line, file)) {
        if (line[0] == '#') continue;
        char *at = line;
        (void)strtod(at, &at);
        for (int c = 0; c < 30; c++)
            table[row][c] = strtod(at, &at);
        row++;
    }
    fclose(file);
    assert_int_equal(row, 101);
    for (size_t k = 0; fw_method_at(k).name; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false);
        outcome out = run(arena, &r, fw_method_at(k).name, 1e-13);
        assert_int_equal(out.status, FW_OK);
        double worst = 0;
        for (int i = 0; i < 11; i++)
            for (int c = 0; c < 15; c++)
                worst = fmax(worst, fabs(out.motion->q[15 * i + c] / (c % 3 == 2 ? 1 : 1e-3) -
                                         table[10 * i][c]));
        if (!(worst <= 1e-11)) fail_msg("%s: %.1e", fw_method_at(k).name, worst);
        fw_arena_free(arena);
    }
}

/* Andrews' squeezer at 0.03 s, the quad-precision column of the benchmark */
static void every_method_gives_andrews_squeezer(void **state) {
    (void)state;
    static const double beta = 15.810771195153707097, gamma = 0.040822240119645804858,
                        delta = 0.52440996587995406937, epsilon = 1.0480807410419378731;
    for (size_t k = 0; fw_method_at(k).name; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_squeezer(arena);
        outcome out = run(arena, &r, fw_method_at(k).name, 1e-13);
        assert_int_equal(out.status, FW_OK);
        const double *q = out.motion->q + 21 * 10;
        const double error[] = {q[2] - beta, q[8] - gamma, q[14] - delta, q[20] - epsilon};
        for (int i = 0; i < 4; i++)
            if (!(fabs(error[i]) <= 1e-10))
                fail_msg("%s, angle %d: %.1e", fw_method_at(k).name, i, error[i]);
        fw_arena_free(arena);
    }
}

/* A02: B0 at 10 s, after ten passes through positions where the rank of G drops by N. Before the
   first of them all methods agree to round-off of the integration. */
static void windows_pass_singular_positions(void **state) {
    (void)state;
    static const struct {
        int n;
        double x, y;
    } exact[] = {{1, 0.4783850577609705590054, 0.8781501787912093011639},
                 {2, 0.3284581108415408153786522, 0.9445185381786009621613}};
    for (int e = 0; e < 2; e++)
        for (size_t k = 0; fw_method_at(k).name; k++) {
            const char *method = fw_method_at(k).name;
            fw_arena *arena = fw_arena_new(0);
            rig r = rig_windows(arena, exact[e].n);
            outcome out = run(arena, &r, method, 1e-11);
            if (out.status != FW_OK) fail_msg("%s: %s", method, out.message);
            const double *q = out.motion->q + 3 * out.motion->nbody * 10;
            double error = fmax(fabs(-sin(q[2]) - exact[e].x), fabs(cos(q[2]) - exact[e].y));
            if (getenv("VERBOSE"))
                print_message("windows %d, %s: %.1e\n", exact[e].n, method, error);
            if (!(error <= 1e-6)) fail_msg("%s: %.1e", method, error);
            fw_arena_free(arena);
        }
    fw_arena *arena = fw_arena_new(0);
    rig before = rig_windows(arena, 2);
    before.scene.duration_s = 0.45;
    assert_int_equal(compare_all(arena, &before, "windows, before", 1e-13, 1, true, 1e-11), 8);
    fw_arena_free(arena);
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

static fw_model *six_bar_model(fw_arena *arena, const rig *r, const char *method,
                               fw_status *status) {
    double q[15];
    for (int b = 0; b < 5; b++)
        q[3 * b] = r->m.body[b].x_m, q[3 * b + 1] = r->m.body[b].y_m, q[3 * b + 2] = 0;
    fw_diags diags = fw_diags_new(arena);
    fw_model *m = NULL;
    *status = fw_model_new(arena, &r->m, NULL, q, 1, fw_method_find(method), &diags, &m);
    return m;
}

static void the_loop_allocates_nothing(void **state) {
    (void)state;
    for (size_t k = 0; fw_method_at(k).name; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false);
        fw_status status;
        fw_model *m = six_bar_model(arena, &r, fw_method_at(k).name, &status);
        assert_int_equal(status, FW_OK);
        double y[32] = {0}, f[32];
        long before = fw_arena_count();
        fw_model_rhs(m, 0, y, f);
        assert_true(fw_model_project(m, 0, y, f));
        assert_int_equal(fw_arena_count(), before);
        fw_arena_free(arena);
    }
}

static void memory_short_is_said(void **state) {
    (void)state;
    for (size_t k = 0; fw_method_at(k).name; k++) {
        fw_status status = FW_NOMEM;
        for (long n = 1; status == FW_NOMEM; n++) {
            fw_arena *arena = fw_arena_new(0);
            rig r = rig_six_bar(arena, false);
            fw_arena_fail_at(n, 1);
            six_bar_model(arena, &r, fw_method_at(k).name, &status);
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
    for (size_t k = 0; fw_method_at(k).name; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false);
        fw_status status;
        fw_model *m = six_bar_model(arena, &r, fw_method_at(k).name, &status);
        double y[32] = {0}, f[32];
        y[2] = (double)NAN;
        fw_model_rhs(m, 0, y, f);
        assert_true(isnan(f[15]));
        y[2] = 0, y[17] = (double)INFINITY;
        fw_model_rhs(m, 0, y, f);
        assert_true(!isfinite(f[15]));
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_agree),
        cmocka_unit_test(methods_agree),
        cmocka_unit_test(methods_agree_on_random_mechanisms),
        cmocka_unit_test(every_method_gives_the_six_bar_table),
        cmocka_unit_test(every_method_gives_andrews_squeezer),
        cmocka_unit_test(windows_pass_singular_positions),
        cmocka_unit_test(reports_say_what_was_met),
        cmocka_unit_test(the_loop_allocates_nothing),
        cmocka_unit_test(memory_short_is_said),
        cmocka_unit_test(not_a_number_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
