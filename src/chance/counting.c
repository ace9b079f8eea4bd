/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probabilities by counting failures: the limit state evaluated in batches, the intervals of a count, the two methods that
   do nothing else, and subset simulation, which counts level by level. */
#include "chance/estimate.h"
#include "base/sort.h"
#include "chance/random.h"
#include "maths/functions.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static fw_status evaluate(fw_chance_run *run, fw_chance_function *g, size_t count, const double *u,
                          double *value) {
    size_t n = run->limit->dimensions;
    for (size_t done = 0; done < count;) {
        if (fw_arena_cancelled(run->arena)) return FW_CANCELLED;
        size_t now = count - done < run->batch ? count - done : run->batch;
        FW_TRY(g(run->limit->context, run->used, now, u + done * n, value + done));
        for (size_t i = done; i < done + now; i++)
            run->unevaluated += isnan(value[i]) != 0;
        run->used += now;
        done += now;
    }
    return FW_OK;
}

fw_status fw_chance_evaluate(fw_chance_run *run, size_t count, const double *u, double *value) {
    return evaluate(run, run->limit->g, count, u, value);
}

fw_status fw_chance_evaluate_apart(fw_chance_run *run, size_t count, const double *u,
                                   double *value) {
    return evaluate(run, run->limit->apart ? run->limit->apart : run->limit->g, count, u, value);
}

size_t fw_chance_left(const fw_chance_run *run) {
    return run->budget - run->used;
}

void fw_chance_count_add(fw_chance_count *count, double value) {
    count->points++;
    if (isnan(value))
        count->unevaluated++;
    else if (value <= 0)
        count->failed++;
}

void fw_chance_trace(const fw_chance_run *run, const fw_chance_estimate *now,
                     fw_chance_estimate *out) {
    if (out->steps == FW_CHANCE_STEPS) {
        for (size_t k = 1; k < FW_CHANCE_STEPS; k += 2)
            out->step[k / 2] = out->step[k];
        out->steps = FW_CHANCE_STEPS / 2;
    }
    out->step[out->steps++] =
        (fw_chance_step){run->used, (now->probability_low + now->probability_high) / 2,
                         fmin(now->low, now->high), now->high};
}

static double lower(size_t failed, size_t points, double tail) {
    return failed ? fw_maths_beta_quantile(tail, (double)failed, (double)(points - failed) + 1) : 0;
}

/* Clopper and Pearson: the probabilities under which a count as low, or as high, is no rarer than half of 1 - level. It is
   the one interval of a binomial count that holds its level for every probability and every number of points, no failure
   at all included, where Wilson's falls short for rare failures; the cost is some width. What was not evaluated counts as
   safe for the lower end and as failed for the upper. Source: C. J. Clopper, E. S. Pearson, Biometrika 26 (1934) 404. Test:
   test_estimate.c */
void fw_chance_counted(const fw_chance_count *count, double level, fw_chance_estimate *out) {
    size_t n = count->points, most = count->failed + count->unevaluated;
    double p = (double)count->failed / (double)n, q = (double)most / (double)n,
           tail = (1 - level) / 2;
    out->probability_low = p, out->probability_high = q;
    out->low = lower(count->failed, n, tail);
    out->high = 1 - lower(n - most, n, tail);
    double middle = (p + q) / 2;
    out->standard_error =
        middle > 0 && middle < 1 ? sqrt(middle * (1 - middle) / (double)n) : (double)NAN;
}

fw_chance_mean fw_chance_mean_of(size_t count, const double *estimate, double level) {
    double n = (double)count, mean = 0, square = 0;
    for (size_t i = 0; i < count; i++)
        mean += estimate[i] / n;
    for (size_t i = 0; i < count; i++)
        square += (estimate[i] - mean) * (estimate[i] - mean);
    double error = sqrt(square / (n * (n - 1))),
           half = error * fw_maths_student_quantile((1 + level) / 2, n - 1);
    return (fw_chance_mean){mean, error, fmax(0, mean - half), fmin(1, mean + half)};
}

/* ---- among random points ---- */

/* Plain Monte Carlo: the share of failures among all points that the budget allows, point i made of the numbers (seed, i,
   dimension). Input: the run; output probabilities with the interval of Clopper and Pearson. Range: any limit state, any
   number of dimensions. Error: sqrt(p (1 - p)/N). Cost: N evaluations. Source: any text. Test: test_estimate.c (coverage) */
fw_status fw_chance_monte_carlo(fw_chance_run *run, fw_chance_estimate *out) {
    size_t n = run->limit->dimensions, total = fw_chance_left(run);
    double *u = fw_arena_array(run->arena, double, run->batch *n),
           *value = fw_arena_array(run->arena, double, run->batch);
    FW_NEED(u && value ? u : NULL);
    fw_chance_count count = {0};
    for (size_t done = 0; done < total; done += run->batch) {
        size_t now = total - done < run->batch ? total - done : run->batch;
        for (size_t i = 0; i < now; i++)
            for (size_t d = 0; d < n; d++)
                u[i * n + d] = fw_chance_normal(run->seed, done + i, d);
        FW_TRY(fw_chance_evaluate_apart(run, now, u, value));
        for (size_t i = 0; i < now; i++)
            fw_chance_count_add(&count, value[i]);
        fw_chance_counted(&count, run->level, out);
        fw_chance_trace(run, out, out);
    }
    return FW_OK;
}

/* ---- among Sobol' points ---- */

enum { REPLICATES = 16, FEW = 10 * REPLICATES };

/* one scrambling, 2^k points */
static fw_status replicate(fw_chance_run *run, size_t number, size_t points, double *u,
                           double *value, fw_chance_count *count) {
    size_t n = run->limit->dimensions;
    fw_chance_sobol sobol;
    fw_mark mark = fw_arena_mark(run->arena);
    FW_TRY(fw_chance_sobol_new(run->arena, n, fw_chance_seed(run->seed, number), &sobol));
    for (size_t done = 0; done < points; done += run->batch) {
        size_t now = points - done < run->batch ? points - done : run->batch;
        for (size_t i = 0; i < now; i++)
            fw_chance_sobol_normal(&sobol, done + i, u + i * n);
        FW_TRY(fw_chance_evaluate_apart(run, now, u, value));
        for (size_t i = 0; i < now; i++)
            fw_chance_count_add(count, value[i]);
    }
    fw_arena_rewind(run->arena, mark);
    return FW_OK;
}

static void quasi_result(const fw_chance_count *all, size_t replicates, const double *low,
                         const double *high, double level, fw_chance_estimate *out) {
    fw_chance_counted(all, level, out);
    if (replicates < 2) return; /* one mean has no interval, its count has */
    fw_chance_mean least = fw_chance_mean_of(replicates, low, level);
    fw_chance_mean most = fw_chance_mean_of(replicates, high, level);
    bool few_fail = all->failed < FEW,
         few_do_not = all->points - all->failed - all->unevaluated < FEW;
    out->low = few_fail || few_do_not ? fmin(out->low, least.low) : least.low;
    out->high = few_fail || few_do_not ? fmax(out->high, most.high) : most.high;
    if (!few_fail && !few_do_not)
        out->standard_error = fmax(least.standard_error, most.standard_error);
}

/* 16 scramblings of the first 2^k Sobol' points, as many as the budget allows. They are independent, so that Student's
   interval of their means holds, whatever the points of one have to do with each other. Where fewer than 160 points fail,
   or do not, the means are too few steps of 1/N for Student, and the interval is widened to that of Clopper and Pearson for
   the count of all points. Range: up to 337 dimensions, else FW_LIMIT. Error: that of Monte Carlo at most, a third of it
   and less for smooth limits in few dimensions. Cost: 16 2^k evaluations. Source: P. L'Ecuyer, C. Lemieux, in Modeling
   Uncertainty, 2002, 419. Test: test_estimate.c (coverage) */
fw_status fw_chance_quasi(fw_chance_run *run, fw_chance_estimate *out) {
    size_t points = 1;
    while (2 * points * REPLICATES <= fw_chance_left(run))
        points *= 2;
    double *u = fw_arena_array(run->arena, double, run->batch * run->limit->dimensions);
    double *value = fw_arena_array(run->arena, double, run->batch);
    FW_NEED(u && value ? u : NULL);
    double low[REPLICATES], high[REPLICATES];
    fw_chance_count all = {0};
    for (size_t r = 0; r < REPLICATES; r++) {
        fw_chance_count count = {0};
        FW_TRY(replicate(run, r, points, u, value, &count));
        low[r] = (double)count.failed / (double)points;
        high[r] = (double)(count.failed + count.unevaluated) / (double)points;
        all.points += points, all.failed += count.failed, all.unevaluated += count.unevaluated;
        quasi_result(&all, r + 1, low, high, run->level, out);
        fw_chance_trace(run, out, out);
    }
    return FW_OK;
}

/* ---- subset simulation ---- */

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

static int below(const void *a, const void *b) {
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

/* Some of the failing points of the last level, from the highest value down: what lies deepest is in one place, what is
   near the limit shows all of it. Room is left for four repetitions. Where none fails the nearest to it stand for them:
   `reach` is how far out they lie, as if behind a plane. */
static void keep_failing(const stage *l, size_t within, double product, fw_chance_subset *s) {
    const bool met = within > 0;
    if (!met) {
        within = l->points / CHAIN;
        product *= (double)within / (double)l->points;
    }
    if (!met && s->failing > 0 && s->reach <= 0) return; /* others do fail */
    if (met && s->reach > 0) s->failing = 0;
    s->reach = met ? 0 : -fw_maths_normal_quantile(product);
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

/* one repetition, in `left` evaluations at most; where they or the levels do not reach a failure, the last level reached is
   what a failure is at most as likely as, and no estimate of it */
static fw_status repetition(fw_chance_run *run, size_t left, uint64_t seed, fw_chance_subset *s) {
    stage l;
    FW_TRY(level_new(run, s->points, seed, &l));
    size_t start = run->used, within, failed, kept;
    double product = 1, accepted;
    bool down, stuck;
    FW_TRY(first_level(run, &l));
    for (int k = 0;; k++) {
        qsort(l.row, l.points, sizeof *l.row, below);
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
    s->unmet += within == 0;
    s->high[s->repetitions] = product * (double)within / (double)l.points;
    s->most[s->repetitions] = within ? s->high[s->repetitions] : product;
    s->low[s->repetitions++] = product * (double)failed / (double)l.points;
    keep_failing(&l, within, product, s);
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
    FW_NEED(s->most = fw_arena_array(run->arena, double, capacity));
    FW_NEED(s->failed = fw_arena_array(run->arena, double, KEPT_POINTS * run->limit->dimensions));
    s->step[0] = 0.7;
    size_t start = run->used, share = budget < 2 * LEAST_POINTS ? budget : budget / 2;
    if (share < LEAST_POINTS) return FW_OK;
    FW_TRY(repeat_once(run, share, UINT64_MAX, s));
    s->repetitions = s->stuck = s->unmet = 0; /* it is not counted */
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

/* What a failure is at most as likely as, where no repetition met one: the mean of the shares below their last levels,
   times what these may be off by. Each of k levels scatters by sqrt(9 (1 + c)/N) of itself with N points of which a tenth
   is kept, where c is what points of one chain have in common: 2.6 were measured for planes, shells and branches, and 3
   are taken (S.-K. Au, J. L. Beck, Prob. Eng. Mech. 16 (2001) 263). Repetitions have one and the same share below levels of
   their own, so that their own scatter says nothing. Test: test_automatic.c, unmet */
static double unmet(const fw_chance_subset *s, double level) {
    const double rest = 1 - 1.0 / CHAIN, common = 3;
    double mean = 0, levels = 0, n = (double)s->repetitions;
    for (size_t i = 0; i < s->repetitions; i++) {
        mean += s->most[i] / n;
        levels += -log(s->most[i]) / log(CHAIN) / n;
    }
    double scatter = sqrt(levels * rest * CHAIN * (1 + common) / (double)s->points / n);
    return fmin(1, mean * exp(fw_maths_normal_quantile((1 + level) / 2) * scatter));
}

bool fw_chance_subset_unmet(const fw_chance_subset *s) {
    return s->repetitions > 0 && s->unmet == s->repetitions;
}

void fw_chance_subset_result(const fw_chance_subset *s, double level, fw_chance_estimate *out) {
    fw_chance_mean least = result_of(s->repetitions, s->low, level),
                   most = result_of(s->repetitions, s->high, level);
    out->probability_low = least.mean, out->probability_high = most.mean;
    out->low = least.low, out->high = most.high;
    if (s->unmet > 0 && s->repetitions > 1) /* some of them: 0 is no upper end */
        out->high = fmax(most.high, fw_chance_mean_of(s->repetitions, s->most, level).high);
    out->standard_error = fmax(least.standard_error, most.standard_error);
    if (fw_chance_subset_unmet(s)) out->high = unmet(s, level), out->standard_error = (double)NAN;
}
