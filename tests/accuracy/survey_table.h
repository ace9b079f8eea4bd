/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the survey found, as tables; the columns are in README.md. */
#ifndef FW_TESTS_SURVEY_TABLE_H
#define FW_TESTS_SURVEY_TABLE_H
#include <stdbool.h>
#include <stdint.h>

enum { SURVEY_ACCURACIES = 5, SURVEY_DEFAULT = 1 }; /* 1e-3 is the second */

typedef struct survey_row { /* a device at an accuracy */
    uint64_t seed;
    int group, bodies;
    bool moved, warned, rows_of_equilibria;
    double accuracy, true_error, estimate, reference_error; /* relative to the largest deflection */
    char integrator[24];
    double rtol, cost, cost_total, cost_cheapest, cheapest_rtol;
    double cost_call; /* of the cheapest one and the run that --rtol compares it with */
    const char *cheapest_integrator; /* NULL: none of the grid would have done */
    int runs;
    long steps;
    int pins, pins_dishonest; /* peaks with an estimate below their true error */
} survey_row;

typedef struct survey_result {
    const survey_row *row;
    int rows;
} survey_result;

int survey_integrator_index(const char *name); /* -1: none */
/* NULL: no such file is wanted */
bool survey_write(const survey_result *result, const double accuracy[SURVEY_ACCURACIES],
                  const char *csv, const char *honesty, const char *raw);
/* a summary to stdout; false: it contradicts, by the 95 % interval, that 99 % of the devices are
   within the accuracy they asked for and 99 % of the estimates are not too small */
bool survey_print(const survey_result *result, const double accuracy[SURVEY_ACCURACIES]);

#endif
