/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small dense systems (GSL, LAPACK). */
#ifndef FW_MATHS_MATHS_DENSE_H
#define FW_MATHS_MATHS_DENSE_H
#include "base/arena.h"
#include "base/status.h"
#include <stdbool.h>

/* solves a x = b for a symmetric, possibly singular a: LU first, then minimum-norm least squares
   where that fails. *consistent says whether |a x - b| <= 1e-9 (|a| |x| + |b|): false means that
   there is no solution, and nothing is hidden behind a rank decision. x may be b. */
fw_status fw_maths_dense_solve_symmetric(fw_arena *arena, int n, const double *a, const double *b,
                                         double *x, bool *consistent);

/* GSL answers by statuses from here on: its own handler of errors would end the process */
void fw_maths_gsl_quiet(void);

#endif
