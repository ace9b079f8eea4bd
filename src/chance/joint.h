/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All inputs that scatter, together: correlations, what differs from lot to lot, wafer to wafer, die to die and hinge to
   hinge, and trends over a wafer; as a map from independent standard normal numbers u to values. */
#ifndef FW_CHANCE_JOINT_H
#define FW_CHANCE_JOINT_H
#include "base/arena.h"
#include "base/status.h"
#include <stddef.h>
#include <stdint.h>

/* ---- how one quantity scatters ---- */

/* A distribution, one value, or an interval of which nothing but the ends is known. Values are in the unit of the
   quantity; u is standard normal, and value(u) rises with u. */
typedef enum fw_chance_kind {
    FW_CHANCE_CONSTANT,  /* mean */
    FW_CHANCE_NORMAL,    /* mean, sd > 0 */
    FW_CHANCE_LOGNORMAL, /* mean > 0 and sd > 0, both of the quantity, not of its logarithm */
    FW_CHANCE_UNIFORM,   /* low < high */
    FW_CHANCE_TRUNCATED, /* normal of mean, sd > 0 before it is cut at low < high (may be infinite) */
    FW_CHANCE_TABLE,     /* cdf linear between (x, p): x and p rise, p from 0 to 1 */
    FW_CHANCE_INTERVAL   /* low <= high: somewhere there, of no distribution */
} fw_chance_kind;

typedef struct fw_chance_distribution {
    fw_chance_kind kind;
    double mean, sd, low, high;
    size_t count;
    const double *x, *p; /* (count >= 2) */
} fw_chance_distribution;

/* FW_INPUT and a sentence in *why (of the arena) where the numbers are none of that kind */
fw_status fw_chance_distribution_check(fw_arena *arena, const fw_chance_distribution *d,
                                       const char **why);

/* The rest is for what passed the check. An interval is taken to be uniform, which is for the caller to say. */
double fw_chance_distribution_cdf(const fw_chance_distribution *d, double x);
double fw_chance_distribution_quantile(const fw_chance_distribution *d, double p); /* 0 < p < 1 */
double fw_chance_distribution_value(const fw_chance_distribution *d,
                                    double u); /* quantile of Phi(u) */
double fw_chance_distribution_mean(const fw_chance_distribution *d);
double fw_chance_distribution_sd(const fw_chance_distribution *d);

/* ---- all of them together ---- */

/* a variable takes a new value with each ... */
typedef enum fw_chance_level {
    FW_CHANCE_LOT,
    FW_CHANCE_WAFER,
    FW_CHANCE_DIE,
    FW_CHANCE_HINGE
} fw_chance_level;

/* added to the value: radial (r^2/R^2 - 1/2) + (along_x x + along_y y)/R, in the unit of the variable. Its mean over the
   wafer is 0. radius_m 0: none. */
typedef struct fw_chance_trend {
    double radius_m; /* R: where the wafer's edge is */
    double radial;   /* edge less centre */
    double along_x, along_y;
} fw_chance_trend;

typedef struct fw_chance_variable {
    const char *name; /* for messages */
    fw_chance_distribution distribution;
    fw_chance_level level;
    fw_chance_trend trend;
} fw_chance_variable;

/* of two variables of one level, as Pearson's coefficient of their values, -1 < value < 1 */
typedef struct fw_chance_correlation {
    size_t a, b; /* indices of variables */
    double value;
} fw_chance_correlation;

typedef struct fw_chance_place { /* where a die is */
    uint32_t lot, wafer, die;
    double x_m, y_m; /* from the wafer's centre */
} fw_chance_place;

/* what is wrong: the index of the variable or correlation, else SIZE_MAX */
typedef struct fw_chance_fault {
    const char *why;
    size_t variable, correlation;
} fw_chance_fault;

typedef struct fw_chance_joint {
    size_t variables, hinges;
    const fw_chance_variable *variable; /* (variables) */
    size_t values;                /* per die: one per variable, of the level hinge one per hinge */
    size_t *value_first;          /* (variables) where the values of a variable begin */
    size_t dimensions;            /* independent standard normal numbers per die */
    size_t *u_first;              /* (variables) where those of a variable begin; SIZE_MAX: none */
    size_t *u_variable, *u_hinge; /* (dimensions) whose it is; hinge 0 below the level hinge */
    size_t unknowns;              /* intervals */
    size_t *unknown;              /* (unknowns) their variables */
    double *factor; /* (variables x variables) lower L, L L^T the correlation in normal space */
} fw_chance_joint;

/* FW_INPUT: *fault says what. The variables must live as long as the joint; pairs without a row are independent. */
fw_status fw_chance_joint_new(fw_arena *arena, size_t hinges, size_t variables,
                              const fw_chance_variable *variable, size_t correlations,
                              const fw_chance_correlation *correlation, fw_chance_joint *out,
                              fw_chance_fault *fault);

/* u (dimensions) of a die: each number a function of the seed, its dimension and the indices its level names */
void fw_chance_joint_draw(const fw_chance_joint *joint, uint64_t seed, const fw_chance_place *place,
                          double *u);

/* x (values). unknown (unknowns): the values of the intervals, NULL for their middles. place NULL: no trends. */
void fw_chance_joint_map(const fw_chance_joint *joint, const double *u, const double *unknown,
                         const fw_chance_place *place, double *x);

/* The correlation in normal space whose values are correlated by `value` (Nataf). FW_INPUT: out of reach for these two;
   *low and *high are then the ends of what is within. */
fw_status fw_chance_joint_normal(fw_arena *arena, const fw_chance_distribution *a,
                                 const fw_chance_distribution *b, double value, double *normal,
                                 double *low, double *high);

/* Shares of the variance of a response: of which inputs (Sobol' indices), and, of dies of simulated wafers, between lots,
   between wafers, by place on the wafer, between dies and between hinges; and how many dies hold at each place. */

typedef struct fw_chance_share { /* with its interval */
    double value, low, high;
} fw_chance_share;

/* ---- by input ---- */

typedef struct fw_chance_model {
    size_t dimensions, responses;
    /* value (count x responses, by rows) of u (count x dimensions), standard normal; NaN: not evaluated */
    fw_status (*f)(void *context, size_t first, size_t count, const double *u, double *value);
    void *context;
    /* (dimensions) < groups: dimensions that are one input, as correlated inputs must be; groups 0: each is one */
    size_t groups;
    const size_t *group;
} fw_chance_model;

typedef struct fw_chance_index_options {
    uint64_t seed;
    size_t base;  /* N at most, at least 128: evaluations are N (groups + 2), N = 16 2^k */
    size_t batch; /* points of a call of f at most; 0: 256 */
    double level; /* 0: 0.95 */
} fw_chance_index_options;

typedef struct fw_chance_indices {
    size_t groups, responses, evaluations;
    double level;
    double *mean, *variance; /* (responses) */
    /* (responses) of the N rows those in which all was evaluated: what was not is left out, so that
       the indices are those of the part where the model answers */
    size_t *rows;
    fw_chance_share *first, *total; /* (responses x groups); NaN where the variance is 0 */
} fw_chance_indices;

/* FW_INPUT and *why: they cannot be begun, as fw_chance_indices_run would say; nothing is evaluated */
fw_status fw_chance_indices_check(const fw_chance_model *model,
                                  const fw_chance_index_options *options, const char **why);
fw_status fw_chance_indices_run(fw_arena *arena, const fw_chance_model *model,
                                const fw_chance_index_options *options, fw_chance_indices *out,
                                const char **why);

/* ---- by level and place ---- */

/* Dies come in units that know nothing of each other. Of one unit:
     0  lot 2k,   wafer 0, at place A
     1  lot 2k,   wafer 0, at place B
     2  lot 2k,   wafer 1, at place C
     3  lot 2k+1, wafer 0, at place A
     4  the die 0 once more with other hinges; only where something differs from hinge to hinge
   A, B and C run through all places in orders of their own, so that each place comes equally often. */
enum { FW_CHANCE_UNIT_PLAIN = 4, FW_CHANCE_UNIT_MOST = 5 };

typedef struct fw_chance_nested_order { /* three orders of all places */
    size_t places;
    const uint32_t *turn[3]; /* (places) each */
} fw_chance_nested_order;
fw_status fw_chance_nested_order_new(fw_arena *arena, uint64_t seed, size_t places,
                                     fw_chance_nested_order *out);
/* which lot, wafer, die and place (an index) the member of a unit is; x_m and y_m are left alone */
void fw_chance_nested_member(const fw_chance_nested_order *order, size_t unit, int member,
                             fw_chance_place *who, size_t *place);
/* u (joint->dimensions) of that member */
void fw_chance_nested_draw(const fw_chance_joint *joint, uint64_t seed, const fw_chance_place *who,
                           int member, double *u);

typedef struct fw_chance_nested { /* of a number g of each die */
    double mean, variance;
    /* of the variance: they add up to 1; what two levels do only together counts for the lower one, what place does
       only with others for the die */
    fw_chance_share lot, wafer, place, die, hinge;
    fw_chance_share of_one_wafer; /* correlation of two dies of one wafer, wherever they are */
    fw_chance_share of_one_lot;   /* of two dies of two wafers of one lot */
    /* standard deviations of the mean of g over a wafer, from wafer to wafer of all lots, and from lot to lot */
    fw_chance_share wafer_sd, lot_sd;
    size_t units, left_out; /* whole ones; those with a die that is not known */
} fw_chance_nested;

/* g (units x members, NaN: not known). FW_INPUT: fewer than two whole units. */
fw_status fw_chance_nested_of(size_t units, int members, const double *g, double level,
                              fw_chance_nested *out);

typedef struct fw_chance_map { /* dies at places, with trends in some inputs */
    size_t n, places, trends;
    const size_t *place;  /* (n) where each was */
    const size_t *unit;   /* (n) which is independent of the others; ascending */
    const double *failed; /* (n) 1 or 0; NaN: not known, left out */
    const double *away;   /* (n x trends) normal deviation of the input, without its trend */
    const double *sd;     /* (trends) of that deviation; 0: none */
    const double *trend;  /* (places x trends) added there */
} fw_chance_map;

/* yield (places) at each place, from all dies */
fw_status fw_chance_map_of(fw_arena *arena, const fw_chance_map *map, double level,
                           fw_chance_share *yield);

/* Response surfaces: polynomials that go near values at points of a cube, and what they are off by.

   Of z in [-1, 1]^d, with Legendre's polynomials P_k and all products of a total degree up to p:

     y(z) = sum over t of c_t  prod over v of P_{t_v}(z_v),   t_1 + ... + t_d <= p

   and where even the third degree has too many terms, products of at most two variables: of many variables those are most of
   what there is, and what is left out is in the residuals. Least squares at n points. What a point says of all the others: its residual over 1 minus its leverage, which is by how
   much a surface without this point misses it (leave one out; D. M. Allen, Technometrics 16 (1974) 125). Every
   column has the degree, up to the highest that n allows, whose largest such residual is least.

   Cost: n p^2 for p terms, once for all degrees; a value of it p for the products and p for each column.
   Test: tests/unit/chance/test_surface.c */

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
