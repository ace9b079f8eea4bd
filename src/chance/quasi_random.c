/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimators.h"
#include "chance/random.h"
#include "chance/sobol.h"
#include <math.h>

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
        FW_TRY(fw_chance_evaluate(run, now, u, value));
        for (size_t i = 0; i < now; i++)
            fw_chance_count_add(count, value[i]);
    }
    fw_arena_rewind(run->arena, mark);
    return FW_OK;
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
    }
    fw_chance_count_interval(&all, run->level, out);
    fw_chance_mean least = fw_chance_mean_of(REPLICATES, low, run->level);
    fw_chance_mean most = fw_chance_mean_of(REPLICATES, high, run->level);
    bool few_fail = all.failed < FEW, few_do_not = all.points - all.failed - all.unevaluated < FEW;
    out->low = few_fail || few_do_not ? fmin(out->low, least.low) : least.low;
    out->high = few_fail || few_do_not ? fmax(out->high, most.high) : most.high;
    if (!few_fail && !few_do_not)
        out->standard_error = fmax(least.standard_error, most.standard_error);
    return FW_OK;
}
