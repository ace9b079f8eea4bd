/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shares of the variance of a response: of which inputs (Sobol' indices), and, of dies of simulated wafers, between lots,
   between wafers, by place on the wafer, between dies and between hinges; and how many dies hold at each place. */
#ifndef FW_CHANCE_INDICES_H
#define FW_CHANCE_INDICES_H
#include "chance/joint.h"

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

#endif
