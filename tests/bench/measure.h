/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every program of the comparison shares: the problems' data, the reference, the error, the
   clock and the printed row. C17 and C++, standard library only, nothing of the product in it.

   Units mm, mg, ms: all numbers of the six-bar are of order one. Error of the six-bar: largest
   deviation over t = 1, 2 .. 10 ms and the 15 coordinates (mm, rad). Error of the windows: largest
   deviation of position and velocity of B0 (m, m/s) at 10 s. Time: CPU of the calling thread from
   the consistent start to the end of the motion, without building the model; median of repetitions
   in a process that has warmed up. */
#ifndef FW_BENCH_MEASURE_H
#define FW_BENCH_MEASURE_H
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- the reference six-bar: bodies AB BC CD DE EF, hinges A B C D E F ---- */
static const double six_mass[5] = {.0188, .0200, .0653, .0203, .0197};
static const double six_inertia[5] = {.00286, .00344, .01155, .00360, .00330};
static const double six_centre[5][2] = {
    {.45, .775}, {.50, 2.05}, {1.50, 2.875}, {2.525, 2.10}, {2.575, .80}};
static const double six_hinge[6][2] = {{.70, .15},   {.20, 1.40},  {.80, 2.70},
                                       {2.20, 2.75}, {2.85, 1.45}, {2.30, .15}};
static const double six_stiffness[6] = {1.711, 1.730, 1.803, 1.502, 1.467, 1.760};
static const double six_damping[6] = {.0070, .0060, .0050, .0055, .0065, .0075};
static const double six_force[2] = {.35, -.20}; /* on CD */
static const double six_torque = -.15;          /* on AB */

/* ---- N four-bar windows: B0 (x, y, vx, vy) at 10 s, elliptic functions ---- */
typedef struct windows_exact {
    int n;
    double b0[4];
} windows_exact;
static const windows_exact windows_reference[] = {
    {1, {0.4783850577609705590, 0.8781501787912093012, 1.7272640755471536358, -.94095217937151564}},
    {2, {0.3284581115408153787, 0.9445185381786009622, 1.4230514702069441233, -.49486884548704296}},
    {5, {0.2357891358452558532, 0.9718042413044653312, 1.2415648176836322773, -.30124122021173478}},
    {10,
     {0.2043535609897709855, 0.9788971458283040423, 1.1866800237546228307, -.24773010080082250}},
    {40,
     {0.1805122266867283901, 0.9835727405823115749, 1.1484412774694141333, -.21077006677942393}},
    {100,
     {0.1757109727909790406, 0.9844417981987801717, 1.1411433739448994622, -.20368031172255309}},
    {1000,
     {0.1728243651707741733, 0.9849526581533342402, 1.1368248841254532779, -.19947257087226866}},
};

static inline double windows_error(int n, const double b0[4]) {
    for (size_t i = 0; i < sizeof windows_reference / sizeof *windows_reference; i++) {
        if (windows_reference[i].n != n) continue;
        double worst = 0;
        for (int k = 0; k < 4; k++) {
            double e = fabs(b0[k] - windows_reference[i].b0[k]);
            if (!(e <= worst)) worst = e;
        }
        return worst;
    }
    return (double)NAN;
}

/* ---- the reference motion of the six-bar ---- */
typedef struct six_reference {
    double q[11][15]; /* at 0, 1 .. 10 ms */
} six_reference;

static inline void six_read(const char *path, six_reference *r) {
    FILE *file = fopen(path, "r");
    char line[2048];
    int found = 0;
    while (file && fgets(line, sizeof line, file)) {
        char *at = line;
        double t = strtod(line, &at);
        int k = (int)floor(t + .5);
        if (*line == '#' || fabs(t - k) > 1e-9 || k < 0 || k > 10) continue;
        for (int i = 0; i < 15; i++)
            r->q[k][i] = strtod(at, &at);
        found++;
    }
    if (file) fclose(file);
    if (found != 11) {
        fprintf(stderr, "%s: not the reference table\n", path);
        exit(2);
    }
}

/* largest deviation at k ms; q as in the table */
static inline double six_error(const six_reference *r, int k, const double *q) {
    double worst = 0;
    for (int i = 0; i < 15; i++) {
        double e = fabs(q[i] - r->q[k][i]);
        if (!(e <= worst)) worst = e;
    }
    return worst;
}

/* ---- what the caller wants: PROGRAM PROBLEM [--reference FILE] [--quick] [--only SETTING]
   [--from E] [--to E]: tolerances 10^-E, all settings without --only ---- */
typedef struct request {
    const char *problem, *reference, *only;
    int quick, from, to;
} request;

static inline request read_request(int argc, char **argv) {
    request r = {argc > 1 ? argv[1] : "", "tests/data/sixbar_ref_0p1ms.txt", NULL, 0, -99, 99};
    for (int i = 2; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--quick") == 0) {
            r.quick = 1;
            continue;
        }
        if (strcmp(argv[i], "--reference") == 0) r.reference = value;
        if (strcmp(argv[i], "--only") == 0) r.only = value;
        if (strcmp(argv[i], "--from") == 0) r.from = atoi(value);
        if (strcmp(argv[i], "--to") == 0) r.to = atoi(value);
        i++;
    }
    return r;
}

/* does the caller want this setting at 10^-e? */
static inline int wanted(const request *r, const char *setting, int e) {
    return (!r->only || strcmp(r->only, setting) == 0) && e >= r->from && e <= r->to;
}

/* ---- clock, repetition, output ---- */
static inline double cpu_seconds(void) {
    struct timespec now;
    return clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now)
               ? 0
               : (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct outcome {
    double error, cpu_s;
    long rhs;
    const char *failed; /* NULL: it finished */
} outcome;

static inline int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* runs until 0.2 s are spent, 3 to 31 times; once when one run takes longer than that; `cpu_s` is
   the median */
static inline outcome measure(outcome (*run)(void *), void *context) {
    enum { MOST = 31 };
    double cpu[MOST], spent = 0;
    outcome o;
    int n = 0;
    do {
        o = run(context);
        cpu[n++] = o.cpu_s;
        spent += o.cpu_s;
    } while (!o.failed && n < MOST && (n == 1 ? spent < .2 : n < 3 || spent < .2));
    qsort(cpu, (size_t)n, sizeof *cpu, by_size);
    o.cpu_s = n % 2 ? cpu[n / 2] : (cpu[n / 2 - 1] + cpu[n / 2]) / 2;
    return o;
}

/* peer,setting,tolerance,error,cpu_ms,rhs: a run that failed has the error nan, and its reason goes
   to standard error */
static inline void print_row(const char *peer, const char *setting, double tolerance, outcome o) {
    if (o.failed) fprintf(stderr, "%s %s %g: %s\n", peer, setting, tolerance, o.failed);
    printf("%s,%s,%.3g,%.4e,%.7g,%ld\n", peer, setting, tolerance, o.failed ? (double)NAN : o.error,
           1e3 * o.cpu_s, o.rhs);
    fflush(stdout);
}

#endif
