/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small linear programmes: some dozens of unknowns and rows. */
#ifndef FW_MATHS_LINEAR_PROGRAMME_H
#define FW_MATHS_LINEAR_PROGRAMME_H
#include "base/arena.h"
#include "base/status.h"
#include <stdbool.h>

/* Minimises  c x + penalty t  over x >= 0 and t >= 0, where

     A x - t <= b   in the first `nsoft` rows,  A x <= b  in the others, whose b is not below 0

   t is what the worst soft row has to be exceeded by: 0 where all can be held and the penalty is
   large. */
typedef struct fw_maths_linear_programme {
    int n, m, nsoft;
    const double *a; /* (m x n) */
    const double *b; /* (m) */
    const double *c; /* (n) not below 0 */
    double penalty;  /* above 0 */
} fw_maths_linear_programme;

/* x (n), *t. *solved false: round-off went in circles, x and t are of no use. Arrays are given back
   to the arena. */
fw_status fw_maths_linear_programme_solve(fw_arena *arena, const fw_maths_linear_programme *p,
                                          double *x, double *t, bool *solved);
#endif
