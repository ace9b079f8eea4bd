/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimators.h"
#include "chance/random.h"
#include "maths/cdf.h"
#include <math.h>

#define OWN   0.1  /* share of the inputs' own density: no weight is above its inverse */
#define LEAST 0.05 /* share of a design point before all are scaled to a sum of 1 */

void fw_chance_weighted_start(const fw_chance_points *points, fw_chance_weighted *out) {
    *out = (fw_chance_weighted){.points = points};
    double sum = 0, total = 0;
    for (size_t k = 0; k < points->count; k++)
        sum += fw_maths_normal_cdf(-fabs(points->point[k].beta));
    for (size_t k = 0; k < points->count; k++)
        total += out->share[k + 1] =
            fmax(LEAST, fw_maths_normal_cdf(-fabs(points->point[k].beta)) / sum);
    for (size_t k = 0; k < points->count; k++)
        out->share[k + 1] *= (1 - OWN) / total;
    out->share[0] = points->count ? OWN : 1;
}

/* the mixture's component of a number that is uniform in (0, 1) */
static size_t component(const fw_chance_weighted *w, double x) {
    size_t k = 0;
    for (double sum = w->share[0]; k < w->points->count && x >= sum; sum += w->share[k])
        k++;
    return k;
}

/* density of the inputs over that of the mixture: 1/(q_0 + sum of q_k exp(u u_k - |u_k|^2/2)) */
static double weight_of(const fw_chance_weighted *w, size_t n, const double *u) {
    double mixture = w->share[0];
    for (size_t k = 0; k < w->points->count; k++) {
        const double *centre = w->points->point[k].u;
        double power = 0;
        for (size_t i = 0; i < n; i++)
            power += centre[i] * (u[i] - centre[i] / 2);
        mixture += w->share[k + 1] * exp(power);
    }
    return 1 / mixture;
}

static void add(fw_chance_weighted *w, double weight, double value) {
    bool unknown = isnan(value) != 0, rare = !unknown && (value <= 0) != w->points->origin_fails;
    for (int way = 0; way < 2; way++) {
        if (!rare && !(unknown && way == 1)) continue;
        w->sum[way] += weight;
        w->square[way] += weight * weight;
        w->most[way] = fmax(w->most[way], weight);
    }
}

/* Importance sampling: points are drawn from normal densities of unit variance around the design points, shares as
   Phi(-beta), and a tenth from the inputs' own density, so that a failure far from all of them has a weight of 10 at most
   and shows as a wide interval, not as none. Input: design points in the run's space; output sums of weights of what is
   rare. Error: unbiased; coefficient of variation sqrt(beta sqrt(pi/2)/N) for a linear limit. Cost: one evaluation a
   point. Source: G. I. Schueller, R. Stix, Struct. Safety 4 (1987) 293; T. Hesterberg, Technometrics 37 (1995) 185
   (the share of the own density). Test: test_estimate.c (coverage) */
fw_status fw_chance_weighted_draw(fw_chance_run *run, size_t samples, fw_chance_weighted *w) {
    size_t n = run->limit->dimensions;
    fw_mark mark = fw_arena_mark(run->arena);
    double *u = fw_arena_array(run->arena, double, run->batch *n),
           *value = fw_arena_array(run->arena, double, run->batch);
    FW_NEED(u && value ? u : NULL);
    for (size_t done = 0; done < samples; done += run->batch) {
        size_t now = samples - done < run->batch ? samples - done : run->batch;
        for (size_t i = 0; i < now; i++) {
            size_t sample = w->samples + i,
                   k = component(w, fw_chance_uniform(run->seed, sample, n));
            for (size_t d = 0; d < n; d++)
                u[i * n + d] =
                    fw_chance_normal(run->seed, sample, d) + (k ? w->points->point[k - 1].u[d] : 0);
            w->own += k == 0;
        }
        FW_TRY(fw_chance_evaluate(run, now, u, value));
        for (size_t i = 0; i < now; i++)
            add(w, weight_of(w, n, u + i * n), value[i]);
        w->samples += now;
    }
    fw_arena_rewind(run->arena, mark);
    return FW_OK;
}

double fw_chance_weighted_effective(const fw_chance_weighted *w) {
    return w->square[0] > 0 ? w->sum[0] * w->sum[0] / w->square[0] : 0;
}

typedef struct part {
    double mean, variance; /* of the mean */
    double heaviest;       /* weight over number of points */
} part;

static part part_of(const fw_chance_weighted *w, int way) {
    double n = (double)w->samples, mean = w->sum[way] / n;
    double variance = fmax(w->square[way] / n - mean * mean, 1e-9 * mean * mean) / (n - 1);
    return (part){mean, variance, w->most[way] / n};
}

/* quantile of the gamma distribution that has this mean and variance */
static double gamma_quantile(double p, double mean, double variance) {
    return fw_maths_gamma_quantile(p, mean * mean / variance) * variance / mean;
}

/* Interval of a sum of weights (M. P. Fay, E. J. Feuer, Statistics in Medicine 16 (1997) 791): gamma distributions with
   mean and variance of the sum, for the upper end with one failure more, of the heaviest weight met. With equal weights it
   is the exact interval of a Poisson count; with heavy ones it is wider above than below, which mean +- sd is not. The
   variance is that of the sample. Without a failure only the share of the own density speaks: none of `own`. */
static void interval(const fw_chance_weighted *w, double level, double *low, double *high) {
    double tail = (1 - level) / 2;
    part least = part_of(w, 0), most = part_of(w, 1);
    *low = least.mean > 0 ? gamma_quantile(tail, least.mean, least.variance) : 0;
    *high = -expm1(log(tail) / fmax(1, (double)w->own));
    if (most.mean > 0)
        *high = fmin(1, gamma_quantile(1 - tail, most.mean + most.heaviest,
                                       most.variance + most.heaviest * most.heaviest));
}

void fw_chance_weighted_result(const fw_chance_weighted *w, double level, fw_chance_estimate *out) {
    double low, high, least = fmin(1, part_of(w, 0).mean), most = fmin(1, part_of(w, 1).mean);
    interval(w, level, &low, &high);
    bool turned = w->points->origin_fails; /* then what was counted is survival */
    out->probability_low = turned ? 1 - most : least;
    out->probability_high = turned ? 1 - least : most;
    out->low = turned ? 1 - high : low;
    out->high = turned ? 1 - low : high;
    out->standard_error =
        least > 0 ? sqrt(fmax(part_of(w, 0).variance, part_of(w, 1).variance)) : (double)NAN;
}
