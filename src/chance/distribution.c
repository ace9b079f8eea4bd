/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/joint.h"
#include "maths/functions.h"
#include <math.h>
#include <stdbool.h>

static fw_status wrong(fw_arena *arena, const char **why, const char *text) {
    FW_NEED(*why = fw_arena_strdup(arena, text));
    return FW_INPUT;
}

static fw_status check_table(fw_arena *arena, const fw_chance_distribution *d, const char **why) {
    if (d->count < 2) return wrong(arena, why, "a table needs at least two rows");
    for (size_t i = 0; i < d->count; i++) {
        if (!isfinite(d->x[i]) || !isfinite(d->p[i]))
            return wrong(arena, why, "a number of the table is not finite");
        if (i && !(d->x[i] > d->x[i - 1]))
            return wrong(arena, why, "the values of the table do not rise");
        if (i && !(d->p[i] > d->p[i - 1]))
            return wrong(arena, why, "the probabilities of the table do not rise");
    }
    if (d->p[0] != 0) return wrong(arena, why, "the first probability of the table is not 0");
    if (d->p[d->count - 1] != 1)
        return wrong(arena, why, "the last probability of the table is not 1");
    return FW_OK;
}

/* Phi(b) - Phi(a), a < b, on the side where nothing cancels */
static double between(double a, double b) {
    return a > 0 ? fw_maths_normal_cdf(-a) - fw_maths_normal_cdf(-b)
                 : fw_maths_normal_cdf(b) - fw_maths_normal_cdf(a);
}

static double reduced(const fw_chance_distribution *d, double x) {
    return (x - d->mean) / d->sd;
}

fw_status fw_chance_distribution_check(fw_arena *arena, const fw_chance_distribution *d,
                                       const char **why) {
    bool spread = isfinite(d->mean) && isfinite(d->sd) && d->sd > 0;
    switch (d->kind) {
    case FW_CHANCE_CONSTANT:
        return isfinite(d->mean) ? FW_OK : wrong(arena, why, "the value is not finite");
    case FW_CHANCE_NORMAL:
        return spread
                   ? FW_OK
                   : wrong(arena, why,
                           "a normal distribution needs a mean and a standard deviation above 0");
    case FW_CHANCE_LOGNORMAL:
        return spread && d->mean > 0
                   ? FW_OK
                   : wrong(
                         arena, why,
                         "a lognormal distribution needs a mean and a standard deviation above 0");
    case FW_CHANCE_UNIFORM:
        return isfinite(d->low) && isfinite(d->high) && d->low < d->high
                   ? FW_OK
                   : wrong(arena, why,
                           "a uniform distribution needs a lower end below its upper end");
    case FW_CHANCE_TRUNCATED:
        if (!spread)
            return wrong(arena, why,
                         "a truncated distribution needs a mean and a standard deviation above 0");
        if (!(d->low < d->high))
            return wrong(arena, why,
                         "a truncated distribution needs a lower end below its upper end");
        return between(reduced(d, d->low), reduced(d, d->high)) > 1e-300
                   ? FW_OK
                   : wrong(arena, why,
                           "the ends of the truncated distribution leave nothing of it: they are "
                           "more than 37 "
                           "standard deviations from its mean");
    case FW_CHANCE_TABLE:
        return check_table(arena, d, why);
    case FW_CHANCE_INTERVAL:
        return isfinite(d->low) && isfinite(d->high) && d->low <= d->high
                   ? FW_OK
                   : wrong(arena, why,
                           "an interval needs a lower end that is not above its upper end");
    }
    return FW_INTERNAL;
}

/* sd and mean of the logarithm: s^2 = ln(1 + (sd/mean)^2), m = ln mean - s^2/2 */
static double log_sd(const fw_chance_distribution *d) {
    double share = d->sd / d->mean;
    return sqrt(log1p(share * share));
}
static double log_mean(const fw_chance_distribution *d) {
    double s = log_sd(d);
    return log(d->mean) - s * s / 2;
}

static double clamped(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

/* the line through (x0, y0), (x1, y1) */
static double line(double x, double x0, double x1, double y0, double y1) {
    return y0 + (x - x0) / (x1 - x0) * (y1 - y0);
}

/* the piece of rising numbers that x is in: 0 .. count - 2 */
static size_t piece(const double *list, size_t count, double x) {
    size_t low = 0, high = count - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (list[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double table(double x, const double *from, const double *to, size_t count) {
    if (x <= from[0]) return to[0];
    if (x >= from[count - 1]) return to[count - 1];
    size_t i = piece(from, count, x);
    return line(x, from[i], from[i + 1], to[i], to[i + 1]);
}

double fw_chance_distribution_cdf(const fw_chance_distribution *d, double x) {
    switch (d->kind) {
    case FW_CHANCE_CONSTANT:
        return x >= d->mean;
    case FW_CHANCE_NORMAL:
        return fw_maths_normal_cdf(reduced(d, x));
    case FW_CHANCE_LOGNORMAL:
        return x > 0 ? fw_maths_normal_cdf((log(x) - log_mean(d)) / log_sd(d)) : 0;
    case FW_CHANCE_UNIFORM:
        return clamped((x - d->low) / (d->high - d->low), 0, 1);
    case FW_CHANCE_TRUNCATED: {
        double a = reduced(d, d->low), b = reduced(d, d->high), z = clamped(reduced(d, x), a, b);
        return z > a ? between(a, z) / between(a, b) : 0;
    }
    case FW_CHANCE_TABLE:
        return table(x, d->x, d->p, d->count);
    case FW_CHANCE_INTERVAL:
        return d->low < d->high ? clamped((x - d->low) / (d->high - d->low), 0, 1) : x >= d->low;
    }
    return (double)NAN;
}

/* Phi(z) = Phi(a) + p (Phi(b) - Phi(a)), solved in the tail in which z is; q = 1 - p to full precision */
static double truncated(const fw_chance_distribution *d, double p, double q) {
    double a = reduced(d, d->low), b = reduced(d, d->high), w = between(a, b);
    double below = fw_maths_normal_cdf(a) + p * w, above = fw_maths_normal_cdf(-b) + q * w;
    double z = below < above ? fw_maths_normal_quantile(below) : fw_maths_normal_upper(above);
    return clamped(d->mean + d->sd * z, d->low, d->high);
}

/* the quantile of p, q = 1 - p, u with Phi(u) = p: each kind takes what it keeps digits with */
static double quantile(const fw_chance_distribution *d, double p, double q, double u) {
    switch (d->kind) {
    case FW_CHANCE_CONSTANT:
        return d->mean;
    case FW_CHANCE_NORMAL:
        return d->mean + d->sd * u;
    case FW_CHANCE_LOGNORMAL:
        return exp(log_mean(d) + log_sd(d) * u);
    case FW_CHANCE_UNIFORM:
    case FW_CHANCE_INTERVAL:
        return p < q ? d->low + p * (d->high - d->low) : d->high - q * (d->high - d->low);
    case FW_CHANCE_TRUNCATED:
        return truncated(d, p, q);
    case FW_CHANCE_TABLE:
        return table(p, d->p, d->x, d->count);
    }
    return (double)NAN;
}

double fw_chance_distribution_quantile(const fw_chance_distribution *d, double p) {
    return quantile(d, p, 1 - p, fw_maths_normal_quantile(p));
}

/* x with F(x) = Phi(u). Range: any finite u. Error: 1e-13 of mean + sd, beyond the quantile's own nothing cancels. Cost:
   two to six calls of the normal distribution, 0.1 to 1 us. Test: test_distribution.c */
double fw_chance_distribution_value(const fw_chance_distribution *d, double u) {
    return quantile(d, fw_maths_normal_cdf(u), fw_maths_normal_cdf(-u), u);
}

/* Moments of the truncated normal: with a, b its reduced ends, w = Phi(b) - Phi(a), m = (phi(a) - phi(b))/w, the mean is
   mean + sd m, the variance sd^2 (1 + (a phi(a) - b phi(b))/w - m^2). In the far tails the variance cancels: relative
   error 1e-16 times the square of the reduced end. Source: N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous Univariate
   Distributions 1, 1994, 13.10. Test: test_distribution.c */
static double truncated_shift(const fw_chance_distribution *d) {
    double a = reduced(d, d->low), b = reduced(d, d->high);
    return (fw_maths_normal_density(a) - fw_maths_normal_density(b)) / between(a, b);
}
static double times_density(double a) {
    return isfinite(a) ? a * fw_maths_normal_density(a) : 0;
}
static double truncated_sd(const fw_chance_distribution *d) {
    double a = reduced(d, d->low), b = reduced(d, d->high), m = truncated_shift(d);
    return d->sd * sqrt(fmax(0, 1 + (times_density(a) - times_density(b)) / between(a, b) - m * m));
}

static double table_mean(const fw_chance_distribution *d) {
    double sum = 0;
    for (size_t i = 1; i < d->count; i++)
        sum += (d->p[i] - d->p[i - 1]) * (d->x[i] + d->x[i - 1]) / 2;
    return sum;
}

/* uniform in each piece: its own variance and that of its middle */
static double table_sd(const fw_chance_distribution *d) {
    double mean = table_mean(d), sum = 0;
    for (size_t i = 1; i < d->count; i++) {
        double width = d->x[i] - d->x[i - 1], off = (d->x[i] + d->x[i - 1]) / 2 - mean;
        sum += (d->p[i] - d->p[i - 1]) * (width * width / 12 + off * off);
    }
    return sqrt(sum);
}

double fw_chance_distribution_mean(const fw_chance_distribution *d) {
    switch (d->kind) {
    case FW_CHANCE_CONSTANT:
    case FW_CHANCE_NORMAL:
    case FW_CHANCE_LOGNORMAL:
        return d->mean;
    case FW_CHANCE_UNIFORM:
    case FW_CHANCE_INTERVAL:
        return d->low + (d->high - d->low) / 2;
    case FW_CHANCE_TRUNCATED:
        return d->mean + d->sd * truncated_shift(d);
    case FW_CHANCE_TABLE:
        return table_mean(d);
    }
    return (double)NAN;
}

double fw_chance_distribution_sd(const fw_chance_distribution *d) {
    switch (d->kind) {
    case FW_CHANCE_CONSTANT:
        return 0;
    case FW_CHANCE_NORMAL:
    case FW_CHANCE_LOGNORMAL:
        return d->sd;
    case FW_CHANCE_UNIFORM:
    case FW_CHANCE_INTERVAL:
        return (d->high - d->low) / sqrt(12.0);
    case FW_CHANCE_TRUNCATED:
        return truncated_sd(d);
    case FW_CHANCE_TABLE:
        return table_sd(d);
    }
    return (double)NAN;
}
