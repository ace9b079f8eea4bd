/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Large symmetric systems with few entries, indefinite ones too: those of mechanisms, whose joint
   forces stand beside the displacements (why this is code of ours: docs/decisions/0101-sparse-rest.md). */
#ifndef FW_MATHS_SPARSE_H
#define FW_MATHS_SPARSE_H
#include "base/arena.h"
#include "base/status.h"

enum { FW_MATHS_NONE = -1 };

/* ---- P A P^T = L D L^T ---- */

/* Unknowns stand in groups that are eliminated together. Unknown i belongs to first[i], or to
   second[i] where that is eliminated before (FW_MATHS_NONE: there is no other). Two groups are coupled
   where an entry may stand between their unknowns. */
typedef struct fw_maths_sparse_shape {
    int n, groups, couplings;
    const int *first, *second; /* (n) */
    const int *coupled;        /* (2 couplings) */
} fw_maths_sparse_shape;

/* sparse_order.c: group (groups) in order, how many of those before it each waits for (children, zeroed by the
   caller), and the place of each */
fw_status fw_maths_sparse_order(fw_arena *arena, const fw_maths_sparse_shape *shape, int *group,
                                int *children, int *place);

typedef struct fw_maths_sparse fw_maths_sparse;

/* the order of elimination; entries may come */
fw_status fw_maths_sparse_new(fw_arena *arena, const fw_maths_sparse_shape *shape,
                              fw_maths_sparse **out);
void fw_maths_sparse_clear(fw_maths_sparse *s); /* no entries */
/* adds to entry (i, j), which is entry (j, i). Memory that is short is told by the factorisation */
void fw_maths_sparse_add(fw_maths_sparse *s, int i, int j, double value);

typedef struct
    fw_maths_sparse_signs { /* of the pivots, which are those of the eigenvalues (Sylvester) */
    int negative, nothing;  /* nothing: at most `nothing` of the factorisation in size */
} fw_maths_sparse_signs;
/* Entries of A are of order one; what is no larger than `nothing` where a pivot is wanted counts as 0,
   and its unknown stays 0 in what is solved. FW_SOLVER: not finite. FW_CANCELLED */
fw_status fw_maths_sparse_factor(fw_maths_sparse *s, double nothing, fw_maths_sparse_signs *signs);
/* A x = x (n), refined once; work (2 n) */
void fw_maths_sparse_solve(const fw_maths_sparse *s, double *x, double *work);
void fw_maths_sparse_product(const fw_maths_sparse *s, const double *x, double *y); /* y = A x */
/* first unknown whose pivot was nothing, from `from` on; FW_MATHS_NONE: there is no more */
int fw_maths_sparse_nothing(const fw_maths_sparse *s, int from);

/* ---- eigenvalues: lanczos.c ---- */

/* Those of a symmetric operator that are largest in size, and their vectors (count x n), orthonormal,
   from the largest down. `apply` may be nothing but on a subspace, which `apply` itself leads to.
   known: vectors (nknown x n) found before, which are left out. *found: how many came within 1e-10 of their size, at most
   `count`. The arena keeps nothing. */
typedef struct fw_maths_operator {
    int n;
    void (*apply)(void *context, const double *x, double *y);
    void *context;
} fw_maths_operator;
fw_status fw_maths_lanczos(fw_arena *arena, const fw_maths_operator *op, int count, int nknown,
                           const double *known, double *value, double *vector, int *found);

#endif
