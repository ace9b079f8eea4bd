/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "survey_table.h"
#include "devices.h"
#include <unistd.h>

static const char *const known[] = {"dop853", "dopri5", "radau5", "quasi-static"};
enum { KNOWN = 4, BIN_LOW = -4, BIN_HIGH = 16 }; /* bins of half a decade, from 10^(BIN_LOW/2) */

int survey_integrator_index(const char *name) {
    for (int i = 0; name && i < KNOWN; i++)
        if (strcmp(known[i], name) == 0) return i;
    return -1;
}

typedef struct summary {
    int devices, below, warned, dishonest, costed, within, total_within, call_within, by[KNOWN];
    long runs, pins, pins_dishonest;
    double *cost, *total, *call, *ratio, *digit; /* (devices) ascending */
    int nratio, ndigit;
} summary;

/* Wilson's interval of a share, z = 1.96 */
static void wilson(int good, int count, double *low, double *high) {
    const double z = 1.959963984540054;
    double n = count > 0 ? count : 1, p = good / n, zz = z * z / n;
    double middle = (p + zz / 2) / (1 + zz);
    double half = z * sqrt(p * (1 - p) / n + zz / (4 * n)) / (1 + zz);
    *low = fmax(0, middle - half), *high = fmin(1, middle + half);
}

static double quantile(const double *sorted, int count, double share) {
    if (count == 0) return (double)NAN;
    int i = (int)(share * count);
    return sorted[i < count ? i : count - 1];
}

/* estimated over true error; infinite where the truth is not known that well */
static double honesty(const survey_row *r) {
    if (!(r->true_error > 3 * r->reference_error) || !(r->true_error > 1e-14)) return HUGE_VAL;
    return r->estimate / r->true_error;
}

static bool counts(const survey_row *r, double accuracy, int group) {
    return r->moved && r->accuracy == accuracy && (group < 0 || r->group == group);
}

/* usual: the same device at the default */
static void add_row(summary *s, const survey_row *r, const survey_row *usual) {
    double ratio = honesty(r);
    int at = survey_integrator_index(r->integrator);
    s->devices++;
    s->below += r->true_error < r->accuracy;
    s->warned += r->warned;
    s->pins += r->pins, s->pins_dishonest += r->pins_dishonest;
    s->runs += r->runs;
    if (at >= 0) s->by[at]++;
    if (usual->moved) s->digit[s->ndigit++] = r->cost_total / usual->cost_total;
    if (isfinite(ratio)) s->ratio[s->nratio++] = ratio, s->dishonest += ratio < 1;
    if (r->rows_of_equilibria || !isfinite(r->cost_cheapest)) return;
    s->cost[s->costed] = r->cost / r->cost_cheapest;
    s->total[s->costed] = r->cost_total / r->cost_cheapest;
    s->within += s->cost[s->costed] <= 1.5;
    s->total_within += s->total[s->costed] <= 1.5;
    s->call[s->costed] = r->cost_total / r->cost_call;
    s->call_within += s->call[s->costed] <= 1.5;
    s->costed++;
}

/* false: no memory */
static bool sum_up(const survey_result *all, double accuracy, int group, summary *s) {
    *s = (summary){.cost = calloc((size_t)all->rows, sizeof(double)),
                   .total = calloc((size_t)all->rows, sizeof(double)),
                   .call = calloc((size_t)all->rows, sizeof(double)),
                   .ratio = calloc((size_t)all->rows, sizeof(double)),
                   .digit = calloc((size_t)all->rows, sizeof(double))};
    if (!s->cost || !s->total || !s->call || !s->ratio || !s->digit) return false;
    for (int i = 0; i < all->rows; i++)
        if (counts(&all->row[i], accuracy, group))
            add_row(s, &all->row[i], &all->row[i - i % SURVEY_ACCURACIES + SURVEY_DEFAULT]);
    qsort(s->cost, (size_t)s->costed, sizeof(double), bounds_by_size);
    qsort(s->total, (size_t)s->costed, sizeof(double), bounds_by_size);
    qsort(s->call, (size_t)s->costed, sizeof(double), bounds_by_size);
    qsort(s->ratio, (size_t)s->nratio, sizeof(double), bounds_by_size);
    qsort(s->digit, (size_t)s->ndigit, sizeof(double), bounds_by_size);
    return true;
}

static void forget(summary *s) {
    free(s->cost), free(s->total), free(s->call), free(s->ratio), free(s->digit);
}

/* ---- files ---- */

static void put_summary(FILE *f, double accuracy, const char *group, const summary *s) {
    double low, high, n = s->devices > 0 ? s->devices : 1, c = s->costed > 0 ? s->costed : 1;
    wilson(s->below, s->devices, &low, &high);
    fprintf(f, "%g,%s,%d,%d,%.4f,%.4f,%.4f,%d,", accuracy, group, s->devices, s->below,
            s->below / n, low, high, s->warned);
    fprintf(f, "%.3g,%.3g,%.3f,%.3g,%.3g,%.3f", quantile(s->cost, s->costed, 0.5),
            quantile(s->cost, s->costed, 0.9), s->within / c, quantile(s->total, s->costed, 0.5),
            quantile(s->total, s->costed, 0.9), s->total_within / c);
    const double share[] = {0, 0.01, 0.1, 0.5, 0.9, 0.99};
    for (int i = 0; i < 6; i++)
        fprintf(f, ",%.3g", quantile(s->ratio, s->nratio, share[i]));
    fprintf(f, ",%d,%d,%d,%d,%d,%.3f,%ld,%ld", s->dishonest, s->by[0], s->by[1], s->by[2], s->by[3],
            (double)s->runs / n, s->pins, s->pins_dishonest);
    fprintf(f, ",%.3g,%.3g,%.3f,%.3g,%.3g\n", quantile(s->call, s->costed, 0.5),
            quantile(s->call, s->costed, 0.9), s->call_within / c,
            quantile(s->digit, s->ndigit, 0.5), quantile(s->digit, s->ndigit, 0.9));
}

static bool put_survey(FILE *f, const survey_result *all, const double *accuracy) {
    fprintf(f, "accuracy,group,devices,below,share_below,share_low,share_high,warned,cost_median,"
               "cost_90,cost_within,total_median,total_90,total_within,ratio_least,ratio_01,"
               "ratio_10,ratio_50,ratio_90,ratio_99,dishonest,dop853,dopri5,radau5,quasi_static,"
               "runs_mean,pins,pins_dishonest,call_median,call_90,call_within,default_median,"
               "default_90\n");
    for (int i = 0; i < SURVEY_ACCURACIES; i++)
        for (int g = -1; g < SURVEY_GROUPS; g++) {
            summary s;
            if (!sum_up(all, accuracy[i], g, &s)) return false;
            put_summary(f, accuracy[i], g < 0 ? "all" : survey_groups[g], &s);
            forget(&s);
        }
    return true;
}

static bool put_honesty(FILE *f, const survey_result *all, const double *accuracy) {
    fprintf(f, "accuracy,log10_from,log10_to,devices\n");
    for (int i = 0; i < SURVEY_ACCURACIES; i++)
        for (int b = BIN_LOW - 1; b <= BIN_HIGH; b++) {
            double from = b < BIN_LOW ? -HUGE_VAL : 0.5 * b;
            double to = b == BIN_HIGH ? HUGE_VAL : 0.5 * (b + 1);
            int n = 0;
            for (int k = 0; k < all->rows; k++) {
                const survey_row *r = &all->row[k];
                double l = log10(honesty(r));
                n +=
                    counts(r, accuracy[i], -1) && ((l >= from && l < to) || (l == to && isinf(to)));
            }
            fprintf(f, "%g,%g,%g,%d\n", accuracy[i], from, to, n);
        }
    return true;
}

static bool put_raw(FILE *f, const survey_result *all, const double *accuracy) {
    (void)accuracy;
    fprintf(f, "seed,group,bodies,accuracy,true_error,estimated_error,reference_error,integrator,"
               "rtol,runs,cost,cost_total,cost_cheapest,cheapest_integrator,cheapest_rtol\n");
    for (int i = 0; i < all->rows; i++) {
        const survey_row *r = &all->row[i];
        if (!r->moved) continue;
        fprintf(f, "%llu,%s,%d,%g,%.3g,%.3g,%.3g,%s,%.3g,%d,%.4g,%.4g,%.4g,%s,%g\n",
                (unsigned long long)r->seed, survey_groups[r->group], r->bodies, r->accuracy,
                r->true_error, r->estimate, r->reference_error, r->integrator, r->rtol, r->runs,
                r->cost, r->cost_total, r->cost_cheapest,
                r->cheapest_integrator ? r->cheapest_integrator : "", r->cheapest_rtol);
    }
    return true;
}

/* whole or not at all */
static bool put_file(const char *path, const survey_result *all, const double *accuracy,
                     bool (*put)(FILE *, const survey_result *, const double *)) {
    char temporary[4096];
    if (!path) return true;
    if (snprintf(temporary, sizeof temporary, "%s.%ld", path, (long)getpid()) >=
        (int)sizeof temporary)
        return false;
    FILE *f = fopen(temporary, "w");
    if (!f) return false;
    bool good = put(f, all, accuracy);
    good = fclose(f) == 0 && good;
    if (good) good = rename(temporary, path) == 0;
    if (!good) remove(temporary);
    return good;
}

bool survey_write(const survey_result *result, const double accuracy[SURVEY_ACCURACIES],
                  const char *csv, const char *honesty_csv, const char *raw) {
    return put_file(csv, result, accuracy, put_survey) &&
           put_file(honesty_csv, result, accuracy, put_honesty) &&
           put_file(raw, result, accuracy, put_raw);
}

/* ---- in short ---- */

bool survey_print(const survey_result *result, const double accuracy[SURVEY_ACCURACIES]) {
    bool good = true;
    for (int i = 0; i < SURVEY_ACCURACIES; i++) {
        summary s;
        double low, high;
        if (!sum_up(result, accuracy[i], -1, &s)) return false;
        wilson(s.below, s.devices, &low, &high);
        printf(
            "%-6g %d devices, %.2f %% within (%.2f to %.2f), %d warned; cost over the cheapest: "
            "median %.2f, 90 %% %.2f, up to 1.5 in %.0f %%; all runs %.2f, %.2f (%.2f runs), over "
            "the same call by --rtol %.2f, %.2f; "
            "estimate over error: 1 %% %.2g, half %.2g, 90 %% %.2g; too small %d of %d, of peaks "
            "%ld of %ld\n",
            accuracy[i], s.devices, 100.0 * s.below / fmax(1, s.devices), 100 * low, 100 * high,
            s.warned, quantile(s.cost, s.costed, 0.5), quantile(s.cost, s.costed, 0.9),
            100.0 * s.within / fmax(1, s.costed), quantile(s.total, s.costed, 0.5),
            quantile(s.total, s.costed, 0.9), (double)s.runs / fmax(1, s.devices),
            quantile(s.call, s.costed, 0.5), quantile(s.call, s.costed, 0.9),
            quantile(s.ratio, s.nratio, 0.01), quantile(s.ratio, s.nratio, 0.5),
            quantile(s.ratio, s.nratio, 0.9), s.dishonest, s.nratio, s.pins_dishonest, s.pins);
        double least, honest;
        wilson(s.nratio - s.dishonest, s.nratio, &least, &honest);
        good = good && s.devices > 0 && high >= 0.99 && honest >= 0.99;
        forget(&s);
    }
    return good;
}
