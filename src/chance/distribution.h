/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How one quantity scatters: a distribution, one value, or an interval of which nothing but the ends is known. Values are
   in the unit of the quantity; u is standard normal, and value(u) rises with u. */
#ifndef FW_CHANCE_DISTRIBUTION_H
#define FW_CHANCE_DISTRIBUTION_H
#include "base/arena.h"
#include "base/status.h"
#include <stddef.h>

typedef enum fw_chance_kind {
    FW_CHANCE_CONSTANT,  /* mean */
    FW_CHANCE_NORMAL,    /* mean, sd > 0 */
    FW_CHANCE_LOGNORMAL, /* mean > 0 and sd > 0, both of the quantity, not of its logarithm */
    FW_CHANCE_UNIFORM,   /* low < high */
    FW_CHANCE_TRUNCATED, /* normal of mean, sd > 0 before it is cut at low < high (may be infinite) */
    FW_CHANCE_TABLE,     /* cdf linear between (x, p): x and p rise, p from 0 to 1 */
    FW_CHANCE_INTERVAL   /* low <= high: somewhere there, of no distribution */
} fw_chance_kind;

typedef struct fw_chance_distribution {
    fw_chance_kind kind;
    double mean, sd, low, high;
    size_t count;
    const double *x, *p; /* (count >= 2) */
} fw_chance_distribution;

/* FW_INPUT and a sentence in *why (of the arena) where the numbers are none of that kind */
fw_status fw_chance_distribution_check(fw_arena *arena, const fw_chance_distribution *d,
                                       const char **why);

/* The rest is for what passed the check. An interval is taken to be uniform, which is for the caller to say. */
double fw_chance_distribution_cdf(const fw_chance_distribution *d, double x);
double fw_chance_distribution_quantile(const fw_chance_distribution *d, double p); /* 0 < p < 1 */
double fw_chance_distribution_value(const fw_chance_distribution *d,
                                    double u); /* quantile of Phi(u) */
double fw_chance_distribution_mean(const fw_chance_distribution *d);
double fw_chance_distribution_sd(const fw_chance_distribution *d);

#endif
