/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/evaluate.h"
#include "maths/cdf.h"
#include <math.h>

fw_status fw_chance_evaluate(fw_chance_run *run, size_t count, const double *u, double *value) {
    size_t n = run->limit->dimensions;
    for (size_t done = 0; done < count;) {
        if (fw_arena_cancelled(run->arena)) return FW_CANCELLED;
        size_t now = count - done < run->batch ? count - done : run->batch;
        FW_TRY(run->limit->g(run->limit->context, run->used, now, u + done * n, value + done));
        for (size_t i = done; i < done + now; i++)
            run->unevaluated += isnan(value[i]) != 0;
        run->used += now;
        done += now;
    }
    return FW_OK;
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

static double lower(size_t failed, size_t points, double tail) {
    return failed ? fw_maths_beta_quantile(tail, (double)failed, (double)(points - failed) + 1) : 0;
}

/* Clopper and Pearson: the probabilities under which a count as low, or as high, is no rarer than half of 1 - level. It is
   the one interval of a binomial count that holds its level for every probability and every number of points, no failure
   at all included, where Wilson's falls short for rare failures; the cost is some width. What was not evaluated counts as
   safe for the lower end and as failed for the upper. Source: C. J. Clopper, E. S. Pearson, Biometrika 26 (1934) 404. Test:
   test_estimate.c */
void fw_chance_count_interval(const fw_chance_count *count, double level, fw_chance_estimate *out) {
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
