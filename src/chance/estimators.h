/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods that estimate a probability, each within the budget that `run` has left; they write the numbers of *out,
   not its method and reason. */
#ifndef FW_CHANCE_ESTIMATORS_H
#define FW_CHANCE_ESTIMATORS_H
#include "chance/estimate.h"
#include <stdbool.h>

/* ---- what they share: the limit state with its count, and intervals of counted failures ---- */

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
/* the same of points whose values choose neither other points nor the method */
fw_status fw_chance_evaluate_apart(fw_chance_run *run, size_t count, const double *u,
                                   double *value);
size_t fw_chance_left(const fw_chance_run *run);

/* of points: failed, and not evaluated */
typedef struct fw_chance_count {
    size_t points, failed, unevaluated;
} fw_chance_count;
void fw_chance_count_add(fw_chance_count *count, double value);

/* what `now` says becomes a step of *out; of more than there is room for every second one stays */
void fw_chance_trace(const fw_chance_run *run, const fw_chance_estimate *now,
                     fw_chance_estimate *out);

/* mean and its Student interval from `count` independent estimates, within [0, 1] */
typedef struct fw_chance_mean {
    double mean, standard_error, low, high;
} fw_chance_mean;
fw_chance_mean fw_chance_mean_of(size_t count, const double *estimate, double level);

/* ---- counting: plain Monte Carlo and randomised quasi-Monte Carlo ---- */

fw_status fw_chance_monte_carlo(fw_chance_run *run, fw_chance_estimate *out);
fw_status fw_chance_quasi(fw_chance_run *run, fw_chance_estimate *out);

/* ---- subset simulation ---- */

enum { FW_CHANCE_LEVELS = 30 };
typedef struct fw_chance_subset {
    size_t points; /* per level */
    size_t repetitions, capacity;
    /* repetitions that ended on level ground: no value is higher than those of a tenth */
    size_t stuck;
    double *low,
        *high; /* (repetitions) estimates, what was not evaluated counted as safe and as failed */
    size_t planned; /* evaluations of a repetition, with a level to spare */
    size_t failing;
    double *failed; /* (failing x dimensions) failing points of the last levels */
    double step[FW_CHANCE_LEVELS + 1]; /* length of the chains' steps at each level */
    int reached;                       /* the last level that has taught its own */
} fw_chance_subset;

/* a first repetition that is not counted, in half of `budget`, with which `wanted` others are planned for the rest */
fw_status fw_chance_subset_start(fw_chance_run *run, size_t budget, size_t wanted,
                                 fw_chance_subset *out);
/* repetitions while what is planned for one fits into `budget`, `most` at most */
fw_status fw_chance_subset_repeat(fw_chance_run *run, size_t budget, size_t most,
                                  fw_chance_subset *subset);
/* with fewer than two repetitions the interval is [0, 1] */
void fw_chance_subset_result(const fw_chance_subset *subset, double level, fw_chance_estimate *out);

/* ---- design points ---- */

enum { FW_CHANCE_POINTS_MOST = 16 };

typedef struct fw_chance_points {
    bool origin_fails;
    size_t count;
    fw_chance_design_point *point; /* (FW_CHANCE_POINTS_MOST), nearest first */
} fw_chance_points;

/* from the origin and from those of the `starts` points (starts x dimensions) that lie beyond none of the points found
   before, in at most `budget` evaluations */
fw_status fw_chance_points_find(fw_chance_run *run, size_t budget, size_t starts,
                                const double *start, fw_chance_points *out);

/* ---- importance sampling around them ---- */

typedef struct fw_chance_weighted {
    const fw_chance_points *points;
    double share[FW_CHANCE_POINTS_MOST +
                 1];     /* of the mixture; the first is that of the inputs' own density */
    size_t samples, own; /* drawn; of the inputs' own density among them */
    /* over what was drawn: weights of what is rare (failing, or where the origin fails not failing) and, beside, of that
       and of what was not evaluated */
    double sum[2], square[2], most[2];
} fw_chance_weighted;

void fw_chance_weighted_start(const fw_chance_points *points, fw_chance_weighted *out);
/* chooses: the method is chosen by these */
fw_status fw_chance_weighted_draw(fw_chance_run *run, size_t samples, bool chooses,
                                  fw_chance_weighted *weighted);
/* how many failures of equal weight would be as good: sum^2/(sum of squares) */
double fw_chance_weighted_effective(const fw_chance_weighted *weighted);
void fw_chance_weighted_result(const fw_chance_weighted *weighted, double level,
                               fw_chance_estimate *out);

#endif
