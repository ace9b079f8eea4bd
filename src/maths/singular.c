/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/singular.h"
#include <lapacke.h>
#include <math.h>
#include <string.h>

/* Backward stable: errors of a few eps times the largest singular value. Cost about 4 rows columns
   (rows + columns). Row-major `a` is the transpose of what LAPACK sees, so its left vectors are the
   right ones here. Source: LAPACK dgesvd. Test: test_singular.c. */
fw_status fw_singular_new(fw_arena *arena, int rows, int columns, const double *a,
                          fw_singular *out) {
    size_t m = (size_t)rows, n = (size_t)columns, least = m < n ? m : n;
    *out = (fw_singular){.rows = rows, .columns = columns};
    FW_NEED(out->sigma = fw_arena_array(arena, double, least));
    FW_NEED(out->u = fw_arena_array(arena, double, m *m));
    FW_NEED(out->v = fw_arena_array(arena, double, n *n));
    for (size_t i = 0; i < m * n; i++)
        if (!isfinite(a[i])) return FW_SOLVER;
    if (least == 0) {
        for (size_t i = 0; i < n; i++)
            out->v[i * n + i] = 1;
        for (size_t i = 0; i < m; i++)
            out->u[i * m + i] = 1;
        return FW_OK;
    }
    double *copy, *work, ask = 0;
    FW_NEED(copy = fw_arena_array(arena, double, m *n));
    memcpy(copy, a, m * n * sizeof *a);
    int info = LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'A', 'A', columns, rows, copy, columns,
                                   out->sigma, out->v, columns, out->u, rows, &ask, -1);
    if (info != 0 || !(ask > 0) || ask > 1e9) return FW_SOLVER;
    FW_NEED(work = fw_arena_array(arena, double, (size_t)ask));
    info = LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'A', 'A', columns, rows, copy, columns, out->sigma,
                               out->v, columns, out->u, rows, work, (int)ask);
    return info == 0 ? FW_OK : FW_SOLVER;
}
