/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimators.h"
#include "base/sort.h"
#include "chance/random.h"
#include "maths/functions.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* a level keeps a tenth of its points, each the seed of a chain of some ten */
enum {
    CHAIN = 10,
    LEAST_POINTS = 100,
    MOST_POINTS = 2000,
    LEVELS = FW_CHANCE_LEVELS,
    KEPT_POINTS = 200
};
#define ACCEPTED 0.44 /* share of new points that the step length aims at */

/* a point of a level; values that are not a number stand below all others, and are told apart by `unknown` */
typedef struct row {
    double value;
    bool unknown;
    size_t index;
} row;

typedef struct stage { /* one level's points */
    size_t n, points;
    double *u, *next;          /* (points x n) */
    row *row;                  /* (points) */
    double *candidate, *value; /* (points x n), (points) */
    uint64_t seed;
    uint64_t drawn; /* points that numbers were drawn for */
} stage;

static fw_status level_new(fw_chance_run *run, size_t points, uint64_t seed, stage *out) {
    size_t n = run->limit->dimensions;
    *out = (stage){.n = n, .points = points, .seed = seed};
    FW_NEED(out->u = fw_arena_array(run->arena, double, points *n));
    FW_NEED(out->next = fw_arena_array(run->arena, double, points *n));
    FW_NEED(out->row = fw_arena_array(run->arena, row, points));
    FW_NEED(out->candidate = fw_arena_array(run->arena, double, points *n));
    FW_NEED(out->value = fw_arena_array(run->arena, double, points));
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

/* the seeds, rows 0 to kept - 1, in an order that does not tell which is lower: only some chains get a last point */
static void shuffle(stage *l, size_t kept) {
    for (size_t i = kept; i > 1; i--) {
        size_t other = (size_t)(fw_chance_uniform(l->seed, l->drawn++, l->n) * (double)i);
        row swap = l->row[i - 1];
        l->row[i - 1] = l->row[other], l->row[other] = swap;
    }
}

/* the proposals of `count` chains: u' = r u + sqrt(1 - r^2) xi, which leaves the standard normal density as it is */
static void propose(stage *l, size_t count, double step, const double *from) {
    double r = sqrt(1 - step * step);
    for (size_t c = 0; c < count; c++, l->drawn++)
        for (size_t d = 0; d < l->n; d++)
            l->candidate[c * l->n + d] =
                r * from[c * l->n + d] + step * fw_chance_normal(l->seed, l->drawn, d);
}

/* The points of the next level, given that those of this are sorted: the first `kept` and chains from them that stay below
   the value of the next, side by side. *accepted: the share of new points. */
static fw_status next_level(fw_chance_run *run, stage *l, size_t kept, double step,
                            double *accepted) {
    size_t n = l->n, moved = 0;
    double bound = l->row[kept].value;
    shuffle(l, kept);
    for (size_t c = 0; c < kept; c++) {
        memcpy(l->next + c * n, l->u + l->row[c].index * n, n * sizeof *l->u);
        l->row[c].index = c;
    }
    for (size_t i = kept; i < l->points; i += kept) {
        size_t count = l->points - i < kept ? l->points - i : kept;
        const double *from = l->next + (i - kept) * n;
        propose(l, count, step, from);
        FW_TRY(fw_chance_evaluate(run, count, l->candidate, l->value));
        for (size_t c = 0; c < count; c++) {
            row now = row_of(l->value[c], i + c);
            bool in = now.value < bound;
            moved += in;
            memcpy(l->next + (i + c) * n, (in ? l->candidate : from) + c * n, n * sizeof *from);
            l->row[i + c] = in ? now : l->row[i + c - kept];
            l->row[i + c].index = i + c;
        }
    }
    *accepted = (double)moved / (double)(l->points - kept);
    double *swap = l->u;
    l->u = l->next, l->next = swap;
    return FW_OK;
}

/* some of the failing points of the last level, from the highest value down: what lies deepest is in one place, what is
   near the limit shows all of it. Room is left for four repetitions. */
static void keep_failing(const stage *l, size_t within, fw_chance_subset *s) {
    size_t most = s->failing + KEPT_POINTS / 4;
    if (most > KEPT_POINTS) most = KEPT_POINTS;
    for (size_t i = within; i-- > 0 && s->failing < most;)
        if (!l->row[i].unknown &&
            (!i || l->row[i].value != l->row[i - 1].value)) /* each point of a chain once */
            memcpy(s->failed + s->failing++ * l->n, l->u + l->row[i].index * l->n,
                   l->n * sizeof *l->u);
}

/* Steps are as long as they were good at this level in the repetitions before, or at the level before: were they corrected
   by the chains that they move, the estimate would be off (a fifth for a shell in 20 dimensions and 500 points). */
static void learn(fw_chance_subset *s, int k, double accepted) {
    s->step[k] = fmin(1, fmax(0.05, s->step[k] * exp(1.5 * (accepted - ACCEPTED))));
    if (s->reached < k) s->step[k + 1] = s->step[k], s->reached = k;
}

/* how many of the sorted points make the seeds: a tenth, and more until the next is really higher; all of them: none is */
static size_t kept_of(const stage *l) {
    size_t kept = l->points / CHAIN;
    while (kept < l->points && !(l->row[kept].value > l->row[kept - 1].value))
        kept++;
    return kept;
}

/* one repetition, in `left` evaluations at most; where they or the levels do not reach, the last level reached is the upper
   estimate */
static fw_status repetition(fw_chance_run *run, size_t left, uint64_t seed, fw_chance_subset *s) {
    stage l;
    FW_TRY(level_new(run, s->points, seed, &l));
    size_t start = run->used, within, failed, kept;
    double product = 1, accepted;
    bool down, stuck;
    FW_TRY(first_level(run, &l));
    for (int k = 0;; k++) {
        qsort(l.row, l.points, sizeof *l.row, lower);
        for (within = failed = 0; within < l.points && l.row[within].value <= 0; within++)
            failed += !l.row[within].unknown;
        kept = kept_of(&l);
        down = kept == l.points ? within == l.points : l.row[kept].value <= 0;
        stuck = kept == l.points || k == LEVELS || run->used - start + s->points - kept > left;
        if (down || stuck) break;
        product *= (double)kept / (double)l.points;
        FW_TRY(next_level(run, &l, kept, s->step[k], &accepted));
        learn(s, k, accepted);
    }
    s->stuck += !down && kept == l.points;
    s->high[s->repetitions] = product * (within ? (double)within / (double)l.points : 1);
    s->low[s->repetitions++] = product * (double)failed / (double)l.points;
    keep_failing(&l, within, s);
    return FW_OK;
}

static fw_status repeat_once(fw_chance_run *run, size_t left, uint64_t number,
                             fw_chance_subset *s) {
    fw_mark mark = fw_arena_mark(run->arena);
    FW_TRY(repetition(run, left, fw_chance_seed(run->seed, number), s));
    fw_arena_rewind(run->arena, mark);
    return FW_OK;
}

/* A first repetition with few points tells how many levels there are, and how long steps should be; the others are planned
   for it, with a level to spare. */
fw_status fw_chance_subset_start(fw_chance_run *run, size_t budget, size_t wanted,
                                 fw_chance_subset *s) {
    size_t capacity = run->budget / LEAST_POINTS + 1;
    *s = (fw_chance_subset){.points = LEAST_POINTS, .capacity = capacity, .reached = -1};
    FW_NEED(s->low = fw_arena_array(run->arena, double, capacity));
    FW_NEED(s->high = fw_arena_array(run->arena, double, capacity));
    FW_NEED(s->failed = fw_arena_array(run->arena, double, KEPT_POINTS * run->limit->dimensions));
    s->step[0] = 0.7;
    size_t start = run->used, share = budget < 2 * LEAST_POINTS ? budget : budget / 2;
    if (share < LEAST_POINTS) return FW_OK;
    FW_TRY(repeat_once(run, share, UINT64_MAX, s));
    s->repetitions = s->stuck = 0; /* it is not counted */
    double levels = 1 + (double)(run->used - start - LEAST_POINTS) / LEAST_POINTS + 0.9;
    double points = (double)(budget - (run->used - start)) / ((double)wanted * levels);
    s->points = (size_t)fmin(MOST_POINTS, fmax(LEAST_POINTS, points)) / CHAIN * CHAIN;
    s->planned = (size_t)ceil((double)s->points * levels);
    return FW_OK;
}

/* Subset simulation as adaptive multilevel splitting: P = product of kept shares, each level what lies strictly below the
   value of the lowest point that is not kept, until that fails; kept are a tenth of the points. The points that are not
   kept are drawn anew by Markov chains from the kept ones, with normal proposals correlated with their start. What cannot be
   evaluated counts as below every level. Output: one estimate a repetition, coefficient of variation some 0.4 for 1e-3, 0.7
   for 1e-6 with 400 points. Error: too high by O(1/points), because points of one chain set the next level together: 1 %
   for 1e-4, some 5 % for 1e-6 with 400 points, a tenth of the interval; were the level set by a kept point, 5 to 15 %. Cost: (1 +
   0.9 (levels - 1)) points, -log10 P levels. Range: any dimension. Source: S.-K. Au, J. L. Beck, Prob. Eng. Mech. 16
   (2001) 263; I. Papaioannou, W. Betz, K. Zwirglmaier, D. Straub, Prob. Eng. Mech. 41 (2015) 89 (proposals); F. Cerou,
   P. Del Moral, T. Furon, A. Guyader, Stat. Comput. 22 (2012) 795 (levels, bias). Test: test_estimate.c */
fw_status fw_chance_subset_repeat(fw_chance_run *run, size_t budget, size_t most,
                                  fw_chance_subset *s) {
    size_t stop = run->used + budget;
    for (size_t i = 0; i < most && s->planned && s->repetitions < s->capacity; i++) {
        size_t left = stop - run->used;
        if (left < (s->repetitions ? s->planned : s->points)) break; /* one at least */
        FW_TRY(repeat_once(run, left, s->repetitions, s));
    }
    return FW_OK;
}

/* The estimates of repetitions scatter like lognormal numbers: mean m and variance v of their logarithms give ln P = m +
   v/2 with a standard error of sqrt(v/R + v^2/(2 (R - 1))), and Student's interval of that is as long above as it has to
   be (Cox's method; U. Olsson, J. Stat. Educ. 13 (2005) 1). Where one of them is 0 there is no logarithm: the lower end is
   then 0, the upper Student's of the estimates themselves. Test: test_estimate.c */
static fw_chance_mean result_of(size_t count, const double *estimate, double level) {
    if (count < 2) return (fw_chance_mean){count ? estimate[0] : (double)NAN, (double)NAN, 0, 1};
    fw_chance_mean plain = fw_chance_mean_of(count, estimate, level);
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
