/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probabilities by counting failures: the limit state evaluated in batches, the intervals of a count, and the two methods
   that do nothing else. */
#include "chance/estimators.h"
#include "chance/random.h"
#include "maths/functions.h"
#include <math.h>

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
static void count_interval(const fw_chance_count *count, double level, fw_chance_estimate *out) {
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
        count_interval(&count, run->level, out);
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
    count_interval(all, level, out);
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
