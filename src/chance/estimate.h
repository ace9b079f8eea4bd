/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The probability that a limit state is not above zero, with an interval, from few evaluations. */
#ifndef FW_CHANCE_ESTIMATE_H
#define FW_CHANCE_ESTIMATE_H
#include "base/arena.h"
#include "base/status.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* value (count) of the points u (count x dimensions, by rows), independent standard normal numbers: <= 0 fails, NaN could
   not be evaluated. `first` is the number of the first of them since the estimate began: the same options give the same
   points under the same numbers. Another status than FW_OK ends the estimate. What g takes from the arena of the estimate
   may be gone at the next call. */
typedef fw_status fw_chance_function(void *context, size_t first, size_t count, const double *u,
                                     double *value);

typedef struct fw_chance_limit {
    size_t dimensions; /* at least 1 */
    fw_chance_function *g;
    void *context;
    /* As g, of points whose values choose neither other points nor the method: somebody who has a share of them only may
       give any value for the others, and reads nothing of the estimate then. Subset simulation, whose points all
       choose later ones, is FW_LIMIT where there is one. NULL: g. */
    fw_chance_function *apart;
} fw_chance_limit;

/* method, its name in files, its name in sentences */
#define FW_CHANCE_METHODS(X)                                                                       \
    X(AUTO, "auto", "automatic choice")                                                            \
    X(MONTE_CARLO, "monte-carlo", "plain Monte Carlo")                                             \
    X(QUASI, "quasi", "randomised quasi-Monte Carlo")                                              \
    X(IMPORTANCE, "importance", "importance sampling around design points")                        \
    X(SUBSET, "subset", "subset simulation")
typedef enum fw_chance_method {
#define FW_CHANCE_ENUM(name, id, text) FW_CHANCE_##name,
    FW_CHANCE_METHODS(FW_CHANCE_ENUM)
#undef FW_CHANCE_ENUM
} fw_chance_method;

const char *fw_chance_method_id(fw_chance_method method);
const char *fw_chance_method_text(fw_chance_method method);
fw_status fw_chance_method_find(const char *id,
                                fw_chance_method *method); /* FW_INPUT: none of them */

typedef struct fw_chance_options {
    fw_chance_method method;
    uint64_t seed;
    size_t budget; /* evaluations at most; at least FW_CHANCE_BUDGET_LEAST */
    size_t batch;  /* points of a call of g at most; 0: FW_CHANCE_BATCH */
    double level;  /* of the interval, 0 < level < 1; 0: 0.95 */
} fw_chance_options;
enum { FW_CHANCE_BUDGET_LEAST = 200, FW_CHANCE_BUDGET_USUAL = 20000, FW_CHANCE_BATCH = 256 };

/* u = -beta alpha, alpha the unit gradient of g in the linear approximation; alpha^2 are the shares of the inputs */
typedef struct fw_chance_design_point {
    double beta;   /* distance from the origin, negative where the origin fails */
    double *u;     /* (dimensions) */
    double *alpha; /* (dimensions) */
} fw_chance_design_point;

/* what the method would have said after fewer evaluations, by the same formulas */
typedef struct fw_chance_step {
    size_t evaluations;
    double probability, low, high;
} fw_chance_step;
enum { FW_CHANCE_STEPS = 64 };

typedef struct fw_chance_estimate {
    fw_chance_method method; /* the one that gave the numbers */
    const char *reason;      /* one sentence: why this method */
    const char *caution;     /* one sentence on what the interval does not hold, or NULL */
    /* What could not be evaluated counted as safe, and as failed; equal where all was evaluated */
    double probability_low, probability_high;
    double low, high, level; /* the interval of the probability, over both ways of counting */
    double standard_error;   /* of the estimate; NaN where it is not known (no failure seen) */
    size_t evaluations;      /* all, pilots and gradients included */
    size_t unevaluated;      /* NaN among them */
    size_t
        steps; /* evenly over the part of the budget that gave the numbers; the last is the estimate itself */
    fw_chance_step step[FW_CHANCE_STEPS];
    size_t points;
    /* (points), nearest first; none where they were not looked for */
    const fw_chance_design_point *point;
} fw_chance_estimate;

/* FW_INPUT: options out of range (*why, of the arena, says which). FW_LIMIT: quasi beyond FW_CHANCE_SOBOL_MOST
   dimensions. FW_SOLVER: importance, and no design point was found. FW_CANCELLED as the arena says. */
/* FW_INPUT and *why: it cannot be begun, as fw_chance_estimate_run would say; nothing is evaluated */
fw_status fw_chance_estimate_check(const fw_chance_limit *limit, const fw_chance_options *options,
                                   const char **why);
fw_status fw_chance_estimate_run(fw_arena *arena, const fw_chance_limit *limit,
                                 const fw_chance_options *options, fw_chance_estimate *out,
                                 const char **why);

/* ---- inputs of which only an interval is known: a range of probabilities ---- */

/* sets the unknown inputs (count) that the following calls of g use */
typedef void fw_chance_set(void *context, const double *unknown);

/* inputs of which only an interval is known, at most: 1024 settings of their ends */
enum { FW_CHANCE_UNKNOWNS_MOST = 10 };

typedef enum fw_chance_search {
    FW_CHANCE_ENDS,   /* all corners: exact where the probability is monotone in each unknown */
    FW_CHANCE_INSIDE, /* corners, then a pattern search inside from the best of them */
    FW_CHANCE_WHERE_NEEDED /* inside where points show that the corners may not be enough */
} fw_chance_search;

/* which extremes a search inside looks for */
typedef enum fw_chance_side {
    FW_CHANCE_BOTH_SIDES,
    FW_CHANCE_LEAST_ONLY,
    FW_CHANCE_MOST_ONLY
} fw_chance_side;

typedef struct fw_chance_unknowns {
    size_t count; /* at most 10 */
    const double *low, *high;
    fw_chance_set *set;
    fw_chance_search search;
    fw_chance_side side;
} fw_chance_unknowns;

typedef struct fw_chance_range {
    fw_chance_estimate least,
        most;                     /* of the settings with the least and the greatest probability */
    double *least_at, *most_at;   /* (count) */
    double low, high;             /* from the lower end of the one to the upper end of the other */
    size_t settings, evaluations; /* tried; of their estimates */
    size_t looked; /* evaluations that said whether corners are enough; 0: nobody asked */
    bool inside;   /* values inside were tried as well */
} fw_chance_range;

/* points that are evaluated to see whether corners are enough, about; estimates of a search inside, at most */
size_t fw_chance_range_looks(size_t count);
size_t fw_chance_range_inside(size_t count);
/* options->budget is for each setting. FW_LIMIT and *why: a share of the points (limit->apart) does not tell where to
   look inside. */
fw_status fw_chance_range_run(fw_arena *arena, const fw_chance_limit *limit,
                              const fw_chance_unknowns *unknowns, const fw_chance_options *options,
                              fw_chance_range *out, const char **why);

/* The methods that estimate a probability, each within the budget that `run` has left; they write the numbers of *out,
   not its method and reason. */

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
/* probabilities, interval and error of a count of at least one point */
void fw_chance_counted(const fw_chance_count *count, double level, fw_chance_estimate *out);

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
    size_t unmet;   /* repetitions that ended before any point failed */
    double *most;   /* (repetitions) high, or where none failed what is below the last level */
    size_t planned; /* evaluations of a repetition, with a level to spare */
    size_t failing;
    double *failed; /* (failing x dimensions) that fail, of the last levels, or come nearest */
    double reach;   /* 0: they fail; else how many standard deviations out they lie, about */
    double step[FW_CHANCE_LEVELS + 1]; /* length of the chains' steps at each level */
    int reached;                       /* the last level that has taught its own */
} fw_chance_subset;

/* a first repetition that is not counted, in half of `budget`, with which `wanted` others are planned for the rest */
fw_status fw_chance_subset_start(fw_chance_run *run, size_t budget, size_t wanted,
                                 fw_chance_subset *out);
/* repetitions while what is planned for one fits into `budget`, `most` at most */
fw_status fw_chance_subset_repeat(fw_chance_run *run, size_t budget, size_t most,
                                  fw_chance_subset *subset);
/* did none of the repetitions that there are meet a failure? Then the estimate is 0, and its upper end what is below the
   last levels */
bool fw_chance_subset_unmet(const fw_chance_subset *subset);
/* with fewer than two repetitions, of which one met a failure, the interval is [0, 1] */
void fw_chance_subset_result(const fw_chance_subset *subset, double level, fw_chance_estimate *out);

/* ---- design points ---- */

enum { FW_CHANCE_POINTS_MOST = 16 };

typedef struct fw_chance_points {
    bool origin_fails;
    bool followed; /* each input was, both ways (importance.c, follow_all) */
    size_t count;
    fw_chance_design_point *point; /* (FW_CHANCE_POINTS_MOST), nearest first */
} fw_chance_points;

/* from the origin, from where the limit is met along each input to either side, from those of the points that subset
   simulation kept which lie beyond none of the points found before, and from opposite sides, in at most `budget` evaluations */
fw_status fw_chance_points_find(fw_chance_run *run, size_t budget, const fw_chance_subset *from,
                                fw_chance_points *out);

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

extern const double fw_chance_weighted_own; /* share of the inputs' own density */
void fw_chance_weighted_start(const fw_chance_points *points, fw_chance_weighted *out);
/* chooses: the method is chosen by these */
fw_status fw_chance_weighted_draw(fw_chance_run *run, size_t samples, bool chooses,
                                  fw_chance_weighted *weighted);
/* how many failures of equal weight would be as good: sum^2/(sum of squares); and how many they would be of a plane at the
   nearest design point */
double fw_chance_weighted_effective(const fw_chance_weighted *weighted);
double fw_chance_weighted_of_plane(const fw_chance_weighted *weighted);
void fw_chance_weighted_result(const fw_chance_weighted *weighted, double level,
                               fw_chance_estimate *out);

#endif
