/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Response surfaces: polynomials that go near values at points of a cube, and what they are off by.

   Of z in [-1, 1]^d, with Legendre's polynomials P_k and all products of a total degree up to p:

     y(z) = sum over t of c_t  prod over v of P_{t_v}(z_v),   t_1 + ... + t_d <= p

   and where even the third degree has too many terms, products of at most two variables: of many variables those are most of
   what there is, and what is left out is in the residuals. Least squares at n points. What a point says of all the others: its residual over 1 minus its leverage, which is by how
   much a surface without this point misses it (leave one out; D. M. Allen, Technometrics 16 (1974) 125). Every
   column has the degree, up to the highest that n allows, whose largest such residual is least.

   Cost: n p^2 for p terms, once for all degrees; a value of it p for the products and p for each column.
   Test: tests/unit/chance/test_surface.c */
#ifndef FW_CHANCE_SURFACE_H
#define FW_CHANCE_SURFACE_H
#include "base/arena.h"
#include "base/status.h"
#include <stddef.h>

enum {
    FW_CHANCE_SURFACE_DEGREE = 12, /* at most */
    FW_CHANCE_SURFACE_TERMS = 600, /* likewise */
    FW_CHANCE_SURFACE_POINTS = 3   /* a term, at least */
};

typedef struct fw_chance_surface {
    size_t dimensions, columns;
    size_t terms;        /* 0: there were too few points for a plane */
    int degree;          /* the highest that any column may have */
    int together;        /* variables in one product, at most */
    const int *less;     /* (terms) the product without its last factor */
    const int *variable; /* (terms) of the last factor; -1: the term is 1 */
    const int *power;    /* (terms) of the last factor */
    double *coefficient; /* (terms x columns); 0 beyond the column's degree */
    double *missed;      /* (columns) the largest residual with a point left out */
    int *degree_of;      /* (columns) */
} fw_chance_surface;

/* terms of a total degree, of products of at most `together` variables */
size_t fw_chance_surface_terms(size_t dimensions, int degree, int together);

/* z (n x dimensions), y (n x columns), both finite. Memory for out from the arena. */
fw_status fw_chance_surface_fit(fw_arena *arena, size_t n, size_t dimensions, const double *z,
                                size_t columns, const double *y, fw_chance_surface *out);

/* A column that some points have no value of, 0: they get that of a surface through the others. *missed: by how much that
   misses its own; 0 where all points have a value, none has, or too few for a plane: then y is as it was. */
fw_status fw_chance_surface_fill(fw_arena *arena, size_t n, size_t dimensions, const double *z,
                                 size_t columns, size_t column, double *y, double *missed);

/* y (columns) at z (dimensions); work (terms) */
void fw_chance_surface_at(const fw_chance_surface *surface, const double *z, double *work,
                          double *y);

#endif
