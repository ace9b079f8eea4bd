/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/singular.h"
#include "maths/lapack.h"
#include <math.h>

static void transpose(int rows, int columns, const double *from, double *to) {
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < columns; k++)
            to[(size_t)k * (size_t)rows + (size_t)i] =
                from[(size_t)i * (size_t)columns + (size_t)k];
}

/* Backward stable: errors of a few eps times the largest singular value. Cost about 4 rows columns
   (rows + columns). Source: LAPACK, by way of fw_maths_svd. Test: test_singular.c. */
fw_status fw_maths_singular_new(fw_arena *arena, int rows, int columns, const double *a,
                                fw_maths_singular *out) {
    size_t m = (size_t)rows, n = (size_t)columns, least = m < n ? m : n;
    *out = (fw_maths_singular){.rows = rows, .columns = columns};
    FW_NEED(out->sigma = fw_arena_array(arena, double, least));
    FW_NEED(out->u = fw_arena_array(arena, double, m *least));
    FW_NEED(out->v = fw_arena_array(arena, double, n *n));
    for (size_t i = 0; i < m * n; i++)
        if (!isfinite(a[i])) return FW_SOLVER; /* LAPACK may loop on a NaN */
    if (least == 0) {
        for (size_t i = 0; i < n; i++)
            out->v[i * n + i] = 1;
        return FW_OK;
    }
    double *copy, *vt;
    fw_maths_lapack_space space;
    FW_NEED(copy = fw_arena_array(arena, double, m *n));
    FW_NEED(vt = fw_arena_array(arena, double, n *n));
    FW_TRY(fw_maths_svd_space(arena, rows, columns, true, &space));
    transpose(rows, columns, a, copy); /* column-major there */
    if (!fw_maths_svd(rows, columns, true, copy, out->sigma, out->u, vt, &space)) return FW_SOLVER;
    transpose(columns, columns, vt, out->v);
    return FW_OK;
}
