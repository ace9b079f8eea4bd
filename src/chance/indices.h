/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sobol' indices: which share of a response's variance comes from which inputs. */
#ifndef FW_CHANCE_INDICES_H
#define FW_CHANCE_INDICES_H
#include "base/arena.h"
#include "base/status.h"
#include <stddef.h>
#include <stdint.h>

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

typedef struct fw_chance_index {
    double value, low, high;
} fw_chance_index;

typedef struct fw_chance_indices {
    size_t groups, responses, evaluations;
    double level;
    double *mean, *variance; /* (responses) */
    /* (responses) of the N rows those in which all was evaluated: what was not is left out, so that
       the indices are those of the part where the model answers */
    size_t *rows;
    fw_chance_index *first, *total; /* (responses x groups); NaN where the variance is 0 */
} fw_chance_indices;

fw_status fw_chance_indices_run(fw_arena *arena, const fw_chance_model *model,
                                const fw_chance_index_options *options, fw_chance_indices *out,
                                const char **why);

#endif
