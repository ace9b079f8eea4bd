/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Singular values with both bases. */
#ifndef FW_MATHS_SINGULAR_H
#define FW_MATHS_SINGULAR_H
#include "base/arena.h"
#include "base/status.h"

/* a = U diag(sigma) V^T. `a` (rows x columns) has its rows contiguous; sigma (min(rows, columns))
   from the largest down; u: left vector i at u + i rows; v: right vector i at v + i columns, all
   `columns` of them, so that those behind the rank span the null space. */
typedef struct fw_maths_singular {
    int rows, columns;
    double *sigma, *u, *v;
} fw_maths_singular;
/* rows 0 gives the unit matrix in v. FW_SOLVER where it does not converge or `a` is not finite. */
fw_status fw_maths_singular_new(fw_arena *arena, int rows, int columns, const double *a,
                                fw_maths_singular *out);

#endif
