/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/eigen.h"
#include "maths/lapack.h"
#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

static bool finite_all(const double *value, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += 0 * value[i];
    return sum == 0;
}

/* LAPACK's answer to a query for the size of its work array; 0: nothing sensible */
static size_t asked(int info, double size) {
    return info == 0 && size >= 1 && size < 1e9 ? (size_t)size : 0;
}

static void transpose(int n, double *a) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            double *p = a + (size_t)i * (size_t)n + j, *q = a + (size_t)j * (size_t)n + i,
                   keep = *p;
            *p = *q;
            *q = keep;
        }
}

/* dgeev, balanced. Error of a value: round-off times |a| times its condition. Cost about 25 n^3.
   Test: test_eigen.c. */
fw_status fw_maths_eigen_general(fw_arena *arena, int n, double *a, double *re, double *im,
                                 double *vector) {
    if (n == 0) return FW_OK;
    if (!finite_all(a, (size_t)n * (size_t)n)) return FW_SOLVER;
    FW_TRY(fw_maths_lapack_ready());
    transpose(n, a);
    double size = 0, *work;
    int info = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', n, a, n, re, im, NULL, 1, vector, n,
                                  &size, -1);
    size_t length = asked(info, size);
    if (!length) return FW_SOLVER;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(work = fw_arena_array(arena, double, length));
    info = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', n, a, n, re, im, NULL, 1, vector, n, work,
                              (int)length);
    fw_arena_rewind(arena, mark);
    return info == 0 ? FW_OK : FW_SOLVER;
}
