/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the estimators share: the limit state with its count, and intervals of counted failures. */
#ifndef FW_CHANCE_EVALUATE_H
#define FW_CHANCE_EVALUATE_H
#include "chance/estimate.h"
#include <stdbool.h>

typedef struct fw_chance_run {
    fw_arena *arena;
    const fw_chance_limit *limit;
    uint64_t seed;
    size_t batch, budget; /* budget: `used` stays at or below it */
    double level;
    size_t used, unevaluated;
} fw_chance_run;

/* value (count) of u (count x dimensions), in batches; the caller has looked at what is left */
fw_status fw_chance_evaluate(fw_chance_run *run, size_t count, const double *u, double *value);
size_t fw_chance_left(const fw_chance_run *run);

/* of points: failed, and not evaluated */
typedef struct fw_chance_count {
    size_t points, failed, unevaluated;
} fw_chance_count;
void fw_chance_count_add(fw_chance_count *count, double value);

/* probabilities, their interval of `level` and the standard error from a plain count */
void fw_chance_count_interval(const fw_chance_count *count, double level, fw_chance_estimate *out);

/* mean and its Student interval from `count` independent estimates, within [0, 1] */
typedef struct fw_chance_mean {
    double mean, standard_error, low, high;
} fw_chance_mean;
fw_chance_mean fw_chance_mean_of(size_t count, const double *estimate, double level);

#endif
