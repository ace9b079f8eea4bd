/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The simplex method on a dense tableau.

   In: p, dimensionless, entries of the order of 1. Out: x, t.

   Method: the slack of every row is in the basis at first, and t for that of the soft row that is
   most exceeded, after which nothing is below 0 and the primal method goes on from there: the
   entering column is the first with a negative reduced cost, the leaving row of several the one
   with the first unknown (Bland's rule), so that no basis comes twice.

   Validity: c >= 0 bounds the value below, so that there is always a solution. Error: round-off
   times the condition of the last basis; values within 1e-11 of 0 count as 0. Cost: (m + 1) (n + m)
   per exchange, some 2 (n + m) of them.

   Source: R. G. Bland, New finite pivoting rules for the simplex method, Math. Oper. Res. 2 (1977)
   103. Test: tests/unit/maths/test_linear_programme.c. */
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

static const double nought = 1e-11;

typedef struct tableau {
    int rows, columns; /* of constraints; of x, t and slacks; the right-hand side is behind them */
    double *v;         /* (rows + 1) x (columns + 1), costs last */
    int *basic;        /* (rows) */
} tableau;

static double *at(const tableau *t, int row, int column) {
    return &t->v[(size_t)row * ((size_t)t->columns + 1) + (size_t)column];
}

static void exchange(tableau *t, int row, int column) {
    const double pivot = *at(t, row, column);
    for (int k = 0; k <= t->columns; k++)
        *at(t, row, k) /= pivot;
    for (int i = 0; i <= t->rows; i++) {
        const double f = *at(t, i, column);
        if (i == row || f == 0) continue;
        for (int k = 0; k <= t->columns; k++)
            *at(t, i, k) -= f * *at(t, row, k);
        *at(t, i, column) = 0;
    }
    t->basic[row] = column;
}

static int entering(const tableau *t) {
    for (int k = 0; k < t->columns; k++)
        if (*at(t, t->rows, k) < -nought) return k;
    return -1;
}

static int leaving(const tableau *t, int column) {
    int row = -1;
    double least = HUGE_VAL;
    for (int i = 0; i < t->rows; i++) {
        const double a = *at(t, i, column);
        if (a <= nought) continue;
        const double ratio = *at(t, i, t->columns) / a;
        if (ratio > least + nought) continue;
        if (row >= 0 && ratio >= least - nought && t->basic[i] > t->basic[row]) continue;
        least = fmin(least, ratio), row = i;
    }
    return row;
}

static void fill(const fw_maths_linear_programme *p, tableau *t) {
    for (int i = 0; i < p->m; i++) {
        memcpy(at(t, i, 0), p->a + (size_t)i * (size_t)p->n, (size_t)p->n * sizeof *p->a);
        *at(t, i, p->n) = i < p->nsoft ? -1 : 0;
        *at(t, i, p->n + 1 + i) = 1;
        *at(t, i, t->columns) = p->b[i];
        t->basic[i] = p->n + 1 + i;
    }
    memcpy(at(t, p->m, 0), p->c, (size_t)p->n * sizeof *p->c);
    *at(t, p->m, p->n) = p->penalty;
}

static int most_exceeded(const fw_maths_linear_programme *p) {
    int row = -1;
    for (int i = 0; i < p->nsoft; i++)
        if (p->b[i] < 0 && (row < 0 || p->b[i] < p->b[row])) row = i;
    return row;
}

static bool solve(const fw_maths_linear_programme *p, tableau *t) {
    const int most = 50 * (p->n + p->m + 1), worst = most_exceeded(p);
    fill(p, t);
    if (worst >= 0) exchange(t, worst, p->n);
    for (int k = 0; k < most; k++) {
        const int column = entering(t), row = column < 0 ? -1 : leaving(t, column);
        if (row < 0) return column < 0;
        exchange(t, row, column);
    }
    return false;
}

fw_status fw_maths_linear_programme_solve(fw_arena *arena, const fw_maths_linear_programme *p,
                                          double *x, double *t, bool *solved) {
    fw_mark mark = fw_arena_mark(arena);
    tableau w = {.rows = p->m, .columns = p->n + 1 + p->m};
    FW_NEED(w.v = fw_arena_array(arena, double, ((size_t)p->m + 1) * ((size_t)w.columns + 1)));
    FW_NEED(w.basic = fw_arena_array(arena, int, (size_t)p->m));
    *solved = solve(p, &w);
    *t = 0;
    memset(x, 0, (size_t)p->n * sizeof *x);
    for (int i = 0; i < p->m; i++) {
        const double value = *at(&w, i, w.columns);
        if (w.basic[i] < p->n) x[w.basic[i]] = value;
        if (w.basic[i] == p->n) *t = value;
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
