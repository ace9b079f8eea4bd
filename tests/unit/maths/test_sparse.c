/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sparse elimination against dense one on random saddle points, and against what is known of chains and grids. */
#include "maths/matrix.h"
#include "test.h"
#include <math.h>

static double random_number(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53 - 0.5;
}

/* bodies of three unknowns in a random graph, and joints of two rows between some of them: entries of K are any,
   so that signs are of every kind; the dense copy has the same */
enum { BODIES = 9, MOST_JOINTS = 16, MOST = 3 * BODIES + 2 * MOST_JOINTS };
typedef struct saddle {
    int n, joints, pair[2 * (MOST_JOINTS + BODIES)], first[MOST], second[MOST], couplings;
    double a[MOST * MOST];
    fw_maths_sparse *s;
} saddle;

static void put(saddle *d, int i, int j, double value) {
    fw_maths_sparse_add(d->s, i, j, value);
    d->a[i * d->n + j] += value;
    if (i != j) d->a[j * d->n + i] += value;
}

static void build(fw_arena *arena, uint64_t *seed, bool empty, saddle *d) {
    *d = (saddle){.joints = 3 + (int)((random_number(seed) + 0.5) * (MOST_JOINTS - 3))};
    d->n = 3 * BODIES + 2 * d->joints;
    for (int i = 0; i < 3 * BODIES; i++)
        d->first[i] = i / 3, d->second[i] = FW_MATHS_NONE;
    for (int k = 0; k < d->joints; k++) {
        int a = (int)((random_number(seed) + 0.5) * BODIES), b = (a + 1 + k % 3) % BODIES;
        bool ground = random_number(seed) > 0.3;
        for (int row = 0; row < 2; row++)
            d->first[3 * BODIES + 2 * k + row] = a,
                                         d->second[3 * BODIES + 2 * k + row] = ground ? FW_MATHS_NONE : b;
        if (!ground) d->pair[2 * d->couplings] = a, d->pair[2 * d->couplings++ + 1] = b;
    }
    for (int b = 0; b + 1 < BODIES; b += 2)
        d->pair[2 * d->couplings] = b, d->pair[2 * d->couplings++ + 1] = b + 1;
    const fw_maths_sparse_shape shape = {.n = d->n,
                                         .groups = BODIES,
                                         .couplings = d->couplings,
                                         .first = d->first,
                                         .second = d->second,
                                         .coupled = d->pair};
    assert_int_equal(fw_maths_sparse_new(arena, &shape, &d->s), FW_OK);
    for (int b = 0; b < BODIES; b++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j <= i && !(empty && b % 3 == 0); j++)
                put(d, 3 * b + i, 3 * b + j, random_number(seed));
    for (int b = 0; b + 1 < BODIES && !empty; b += 2)
        for (int i = 0; i < 9; i++)
            put(d, 3 * b + i / 3, 3 * b + 3 + i % 3, random_number(seed));
    for (int k = 3 * BODIES; k < d->n; k++)
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < 3; i++) {
                int body = side ? d->second[k] : d->first[k];
                if (body != FW_MATHS_NONE) put(d, k, 3 * body + i, random_number(seed));
            }
}

static void signs_and_solutions_are_those_of_dense_ones(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    uint64_t seed = 7;
    static saddle d;
    static double a[MOST * MOST], value[MOST], vector[MOST * MOST];
    int compared = 0, singular = 0;
    for (int run = 0; run < 400; run++) {
        fw_maths_sparse_signs signs;
        double x[MOST], b[MOST] = {0}, got[MOST], work[2 * MOST];
        build(arena, &seed, run % 2, &d);
        memcpy(a, d.a, sizeof a);
        assert_true(fw_maths_jacobi(d.n, a, value, vector));
        int negative = 0, nothing = 0;
        double least = (double)INFINITY;
        for (int i = 0; i < d.n; i++) {
            bool none = fabs(value[i]) < 1e-12;
            nothing += none, negative += !none && value[i] < 0;
            if (!none) least = fmin(least, fabs(value[i]));
        }
        if (least < 1e-4) continue; /* neither zero nor not */
        assert_int_equal(fw_maths_sparse_factor(d.s, 1e-10, &signs), FW_OK);
        assert_int_equal(signs.negative, negative);
        assert_int_equal(signs.nothing, nothing);
        assert_true((fw_maths_sparse_nothing(d.s, 0) == FW_MATHS_NONE) == (nothing == 0));
        for (int i = 0; i < d.n; i++)
            x[i] = random_number(&seed);
        for (int i = 0; i < d.n; i++)
            for (int j = 0; j < d.n; j++)
                b[i] += d.a[i * d.n + j] * x[j];
        memcpy(got, b, sizeof got);
        fw_maths_sparse_solve(d.s, got, work);
        for (int i = 0; i < d.n; i++) { /* of what is singular the right side must come out */
            double sum = 0;
            for (int j = 0; j < d.n; j++)
                sum += d.a[i * d.n + j] * got[j];
            assert_near(sum, b[i], 1e-10 / least);
            if (nothing == 0) assert_near(got[i], x[i], 1e-12 / least);
        }
        compared++, singular += nothing > 0;
    }
    assert_true(compared > 300 && singular > 50);
    fw_arena_free(arena);
}

/* ---- a chain of masses on springs, held at one end: eigenvalues 4 sin^2((2 k - 1) pi/(2 (2 n + 1))) ---- */

static fw_maths_sparse *springs(fw_arena *arena, int n, double shift) {
    const size_t size = (size_t)n;
    int *first = fw_arena_array(arena, int, size), *second = fw_arena_array(arena, int, size),
        *pair = fw_arena_array(arena, int, 2 * size);
    fw_maths_sparse *s;
    for (int i = 0; i < n; i++) {
        first[i] = i, second[i] = FW_MATHS_NONE;
        if (i + 1 < n) pair[2 * i] = i, pair[2 * i + 1] = i + 1;
    }
    const fw_maths_sparse_shape shape = {n, n, n - 1, first, second, pair};
    assert_int_equal(fw_maths_sparse_new(arena, &shape, &s), FW_OK);
    for (int i = 0; i < n; i++) {
        fw_maths_sparse_add(s, i, i, (i + 1 < n ? 2 : 1) - shift);
        if (i + 1 < n) fw_maths_sparse_add(s, i, i + 1, -1);
    }
    return s;
}

typedef struct inverse {
    const fw_maths_sparse *s;
    double *work;
    int n;
} inverse;

static void invert(void *context, const double *x, double *y) {
    const inverse *k = context;
    memcpy(y, x, (size_t)k->n * sizeof *y);
    fw_maths_sparse_solve(k->s, y, k->work);
}

static double known(int n, int k) {
    double x = sin((2 * k - 1) * M_PI / (2 * (2 * n + 1)));
    return 4 * x * x;
}

static void eigenvalues_of_a_chain(void **state) {
    (void)state;
    enum { COUNT = 12 };
    for (int n = 40; n <= 40000; n *= 10) {
        fw_arena *arena = fw_arena_new(0);
        fw_maths_sparse *s = springs(arena, n, 0);
        fw_maths_sparse_signs signs;
        assert_int_equal(fw_maths_sparse_factor(s, 1e-14, &signs), FW_OK);
        assert_int_equal(signs.negative + signs.nothing, 0);
        inverse k = {s, fw_arena_array(arena, double, 2 * (size_t)n), n};
        const fw_maths_operator op = {n, invert, &k};
        double value[COUNT], *vector = fw_arena_array(arena, double, (size_t)COUNT *(size_t)n);
        int found;
        assert_int_equal(fw_maths_lanczos(arena, &op, COUNT, 0, NULL, value, vector, &found),
                         FW_OK);
        assert_int_equal(found, COUNT);
        for (int i = 0; i < COUNT; i++)
            assert_near(1 / value[i] / known(n, i + 1), 1, 1e-15 * n * (n > 100 ? n / 100.0 : 1));
        assert_true(fw_arena_peak(arena) < (size_t)4000 * (size_t)n + 500000);
        /* Sturm: as many lie below a shift as the signs say */
        fw_maths_sparse *shifted = springs(arena, n, 0.5 * (known(n, 7) + known(n, 8)));
        assert_int_equal(fw_maths_sparse_factor(shifted, 0, &signs), FW_OK);
        assert_int_equal(signs.negative, 7);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(signs_and_solutions_are_those_of_dense_ones),
        cmocka_unit_test(eigenvalues_of_a_chain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
