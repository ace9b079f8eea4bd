/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Singular values with both bases. */
#ifndef FW_MATHS_SINGULAR_H
#define FW_MATHS_SINGULAR_H
#include "base/arena.h"
#include "base/status.h"

/* a = U diag(sigma) V^T, rows are contiguous: a (rows x columns), u (rows x rows), v (columns x
   columns) holds the right singular vectors as rows, sigma (min(rows, columns)) from the largest
   down. rows 0 gives the unit matrix in v. FW_SOLVER where it does not converge or `a` is not
   finite. */
typedef struct fw_singular {
    int rows, columns;
    double *sigma, *u, *v;
} fw_singular;
fw_status fw_singular_new(fw_arena *arena, int rows, int columns, const double *a,
                          fw_singular *out);

#endif
