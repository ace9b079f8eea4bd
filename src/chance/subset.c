/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimators.h"
#include "base/sort.h"
#include "chance/random.h"
#include "maths/student.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* a level keeps a tenth of its points, each the seed of a chain of ten */
enum { CHAIN = 10, LEAST_POINTS = 100, MOST_POINTS = 2000, LEVELS = 30, KEPT_POINTS = 200 };
#define ACCEPTED 0.44 /* share of new points that the step length aims at */

/* a point of a level; values that are not a number stand below all others, and are told apart by `unknown` */
typedef struct row {
    double value;
    bool unknown;
    size_t index;
} row;

typedef struct stage { /* one level's points */
    size_t n, points;
    double *u, *next;                   /* (points x n) */
    row *row;                           /* (points) */
    double *candidate, *value, *spread; /* (points/CHAIN x n), (points), (n) */
    double step;                        /* of the proposals, adapted */
    uint64_t seed;
    uint64_t drawn; /* points that numbers were drawn for */
} stage;

fw_status fw_chance_subset_new(const fw_chance_run *run, fw_chance_subset *out) {
    size_t points = run->budget / 40 / CHAIN * CHAIN;
    points = points < LEAST_POINTS ? LEAST_POINTS : points > MOST_POINTS ? MOST_POINTS : points;
    *out = (fw_chance_subset){.points = points, .capacity = run->budget / points + 1};
    FW_NEED(out->low = fw_arena_array(run->arena, double, out->capacity));
    FW_NEED(out->high = fw_arena_array(run->arena, double, out->capacity));
    FW_NEED(out->failed = fw_arena_array(run->arena, double, KEPT_POINTS * run->limit->dimensions));
    out->failing_most = KEPT_POINTS;
    return FW_OK;
}

static fw_status level_new(fw_chance_run *run, size_t points, uint64_t seed, stage *out) {
    size_t n = run->limit->dimensions;
    *out = (stage){.n = n, .points = points, .step = 0.6, .seed = seed};
    FW_NEED(out->u = fw_arena_array(run->arena, double, points *n));
    FW_NEED(out->next = fw_arena_array(run->arena, double, points *n));
    FW_NEED(out->row = fw_arena_array(run->arena, row, points));
    FW_NEED(out->candidate = fw_arena_array(run->arena, double, points / CHAIN * n));
    FW_NEED(out->value = fw_arena_array(run->arena, double, points));
    FW_NEED(out->spread = fw_arena_array(run->arena, double, n));
    return FW_OK;
}

static row row_of(double value, size_t index) {
    bool unknown = isnan(value) != 0;
    return (row){unknown ? -(double)INFINITY : value, unknown, index};
}

static fw_status first_level(fw_chance_run *run, stage *l) {
    for (size_t i = 0; i < l->points; i++)
        for (size_t d = 0; d < l->n; d++)
            l->u[i * l->n + d] = fw_chance_normal(l->seed, i, d);
    l->drawn = l->points;
    FW_TRY(fw_chance_evaluate(run, l->points, l->u, l->value));
    for (size_t i = 0; i < l->points; i++)
        l->row[i] = row_of(l->value[i], i);
    return FW_OK;
}

static int lower(const void *a, const void *b) {
    const row *one = a, *other = b;
    int order = fw_order_doubles(one->value, other->value);
    return order ? order : fw_order_wholes((long long)one->index, (long long)other->index);
}

/* standard deviation of the seeds in each direction, 1 at most: steps are long where they spread */
static void measure_spread(stage *l, size_t seeds) {
    for (size_t d = 0; d < l->n; d++) {
        double mean = 0, square = 0;
        for (size_t i = 0; i < seeds; i++)
            mean += l->next[i * l->n + d] / (double)seeds;
        for (size_t i = 0; i < seeds; i++)
            square += pow(l->next[i * l->n + d] - mean, 2);
        l->spread[d] = sqrt(square / (double)(seeds - 1));
    }
}

/* the proposals of all chains: u' = r u + sqrt(1 - r^2) xi, which leaves the standard normal density as it is */
static void propose(stage *l, size_t seeds, const double *from) {
    for (size_t c = 0; c < seeds; c++, l->drawn++)
        for (size_t d = 0; d < l->n; d++) {
            double s = fmin(1, l->step * l->spread[d]), r = sqrt(1 - s * s);
            l->candidate[c * l->n + d] =
                r * from[c * l->n + d] + s * fw_chance_normal(l->seed, l->drawn, d);
        }
}

/* The points of the next level, given that those of this are sorted: chains from the lowest tenth that never leave
   g <= bound. The chains go side by side; after each step the length of the steps is corrected by the share accepted. */
static fw_status next_level(fw_chance_run *run, stage *l, double bound) {
    size_t n = l->n, seeds = l->points / CHAIN;
    for (size_t c = 0; c < seeds; c++)
        memcpy(l->next + c * n, l->u + l->row[c].index * n, n * sizeof *l->u);
    for (size_t c = 0; c < seeds; c++)
        l->row[c].index = c;
    measure_spread(l, seeds);
    for (size_t k = 1; k < CHAIN; k++) {
        const double *from = l->next + (k - 1) * seeds * n;
        double *to = l->next + k * seeds * n;
        propose(l, seeds, from);
        FW_TRY(fw_chance_evaluate(run, seeds, l->candidate, l->value));
        size_t accepted = 0;
        for (size_t c = 0; c < seeds; c++) {
            row now = row_of(l->value[c], k * seeds + c);
            bool in = now.value <= bound;
            accepted += in;
            memcpy(to + c * n, in ? l->candidate + c * n : from + c * n, n * sizeof *to);
            l->row[k * seeds + c] = in ? now : l->row[(k - 1) * seeds + c];
            l->row[k * seeds + c].index = k * seeds + c;
        }
        double share = (double)accepted / (double)seeds;
        l->step = fmin(1.5, fmax(0.05, l->step * exp((share - ACCEPTED) / sqrt((double)k))));
    }
    double *swap = l->u;
    l->u = l->next, l->next = swap;
    return FW_OK;
}

/* every so many of the failing points, so that those of all repetitions have room */
static void keep_failing(const stage *l, fw_chance_subset *s) {
    size_t most = s->failing + s->failing_most / 4;
    if (most > s->failing_most) most = s->failing_most;
    for (size_t i = 0; i < l->points && s->failing < most; i++)
        if (!l->row[i].unknown && l->row[i].value <= 0)
            memcpy(s->failed + s->failing++ * l->n, l->u + l->row[i].index * l->n,
                   l->n * sizeof *l->u);
}

/* one repetition, in `left` evaluations at most; where they or the levels do not reach, what was reached is taken, which
   is too much for the upper estimate and 0 for the lower */
static fw_status repetition(fw_chance_run *run, size_t left, uint64_t seed, fw_chance_subset *s) {
    stage l;
    FW_TRY(level_new(run, s->points, seed, &l));
    size_t start = run->used, tenth = s->points / CHAIN, within = 0, failed = 0;
    double product = 1;
    FW_TRY(first_level(run, &l));
    for (int k = 0;; k++) {
        qsort(l.row, l.points, sizeof *l.row, lower);
        for (within = failed = 0; within < l.points && l.row[within].value <= 0; within++)
            failed += !l.row[within].unknown;
        size_t kept = tenth;
        while (kept < l.points && l.row[kept].value <= l.row[tenth - 1].value)
            kept++;
        bool stuck =
            kept == l.points || k == LEVELS || run->used - start + s->points - tenth > left;
        if (within >= tenth || stuck) break;
        product *= (double)kept / (double)l.points;
        FW_TRY(next_level(run, &l, l.row[tenth - 1].value));
    }
    s->high[s->repetitions] = product * (double)(within ? within : tenth) / (double)l.points;
    s->low[s->repetitions++] = product * (double)failed / (double)l.points;
    keep_failing(&l, s);
    if (run->used - start > s->dearest) s->dearest = run->used - start;
    return FW_OK;
}

/* Subset simulation: P = product of P(F_k | F_(k-1)), F_k = {g <= b_k}, b_k the value that a tenth of the points of level
   k - 1 are below, until that is below 0. Points of a level come from its seeds by Markov chains with normal proposals
   correlated with their start (adaptive conditional sampling), whose steps are as long as 44 % of them allow. What cannot
   be evaluated counts as below every level. Output: one estimate a repetition, nearly unbiased, coefficient of variation
   some 0.4 for 1e-6 with 500 points. Cost: (1 + 0.9 (levels - 1)) points, -log10 P levels. Range: any dimension. Source:
   S.-K. Au, J. L. Beck, Prob. Eng. Mech. 16 (2001) 263; I. Papaioannou, W. Betz, K. Zwirglmaier, D. Straub, Prob. Eng.
   Mech. 41 (2015) 89. Test: test_estimate.c (coverage) */
fw_status fw_chance_subset_repeat(fw_chance_run *run, size_t budget, size_t most,
                                  fw_chance_subset *s) {
    size_t stop = run->used + budget, reserve = 2 * (s->points - s->points / CHAIN);
    for (size_t done = 0; done < most && s->repetitions < s->capacity; done++) {
        size_t left = stop - run->used, needed = s->repetitions ? s->dearest + reserve : s->points;
        if (left < needed) break;
        fw_mark mark = fw_arena_mark(run->arena);
        FW_TRY(repetition(run, left, fw_chance_seed(run->seed, s->repetitions), s));
        fw_arena_rewind(run->arena, mark);
    }
    return FW_OK;
}

/* The estimates of repetitions scatter like lognormal numbers: mean m and variance v of their logarithms give ln P = m +
   v/2 with a standard error of sqrt(v/R + v^2/(2 (R - 1))), and Student's interval of that is as long above as it has to
   be (Cox's method; U. Olsson, J. Stat. Educ. 13 (2005) 1). Where one of them is 0 there is no logarithm: the lower end is
   then 0, the upper Student's of the estimates themselves. Test: test_estimate.c */
static fw_chance_mean result_of(size_t count, const double *estimate, double level) {
    fw_chance_mean plain = fw_chance_mean_of(count, estimate, level);
    if (count < 2) return (fw_chance_mean){estimate[0], (double)NAN, 0, 1};
    double n = (double)count, mean = 0, variance = 0;
    for (size_t i = 0; i < count; i++) {
        if (!(estimate[i] > 0))
            return (fw_chance_mean){plain.mean, plain.standard_error, 0, plain.high};
        mean += log(estimate[i]) / n;
    }
    for (size_t i = 0; i < count; i++)
        variance += pow(log(estimate[i]) - mean, 2) / (n - 1);
    double half = fw_maths_student_quantile((1 + level) / 2, n - 1) *
                  sqrt(variance / n + variance * variance / (2 * (n - 1)));
    return (fw_chance_mean){plain.mean, plain.standard_error,
                            fmin(1, exp(mean + variance / 2 - half)),
                            fmin(1, exp(mean + variance / 2 + half))};
}

void fw_chance_subset_result(const fw_chance_subset *s, double level, fw_chance_estimate *out) {
    fw_chance_mean least = result_of(s->repetitions, s->low, level),
                   most = result_of(s->repetitions, s->high, level);
    out->probability_low = least.mean, out->probability_high = most.mean;
    out->low = least.low, out->high = most.high;
    out->standard_error = fmax(least.standard_error, most.standard_error);
}
