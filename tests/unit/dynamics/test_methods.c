/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All methods solve the same equations: M a + G^T lambda = Q, G a = -gamma on random M and G, then
   the same motions. */
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

/* `redundant` rows that are sums of others, with a gamma that agrees; masses over `spread` decades */
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
            if (getenv("VERBOSE"))
                printf("%d %s: force %.1e constraint %.1e a %.1e lambda %.1e\n", c, kernels[k].name,
                       force, constraint, apart, l);
            else if (!(force < 1e-11 && constraint < 1e-12 && apart < 1e-12) ||
                     (p.rows <= ROWS - c % 4 && !(l < 1e-11)))
                fail_msg("%s, case %d: force %.1e constraint %.1e a %.1e lambda %.1e",
                         kernels[k].name, c, force, constraint, apart, l);
        }
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
