/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimators.h"
#include "chance/random.h"

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
        FW_TRY(fw_chance_evaluate(run, now, u, value));
        for (size_t i = 0; i < now; i++)
            fw_chance_count_add(&count, value[i]);
    }
    fw_chance_count_interval(&count, run->level, out);
    return FW_OK;
}
