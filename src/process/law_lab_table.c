/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"
#include <math.h>

enum { VALUE, SHORTEST, LONGEST, FIRST, PAIRS = 6 };

bool fw_process_table_between(const double *pairs, int n, double x, double *y, const char **why) {
    int count = 0;
    while (count < n && !isnan(pairs[2 * count]) && !isnan(pairs[2 * count + 1]))
        count++;
    *why = "the table needs two pairs or more";
    if (count < 2) return false;
    for (int i = 1; i < count; i++) {
        *why = "the table's first column does not rise";
        if (!(pairs[2 * i] > pairs[2 * i - 2])) return false;
    }
    *why = "outside the table; it is never extrapolated";
    if (!(x >= pairs[0] && x <= pairs[2 * count - 2])) return false;
    int i = 1;
    while (i < count - 1 && x > pairs[2 * i])
        i++;
    double x0 = pairs[2 * i - 2], y0 = pairs[2 * i - 1], x1 = pairs[2 * i], y1 = pairs[2 * i + 1];
    *y = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
    *why = NULL;
    return true;
}

/* t = table(value), piecewise linear between a laboratory's own pairs, never beyond them, and
   within [shortest, longest]: a displacement deposit is thin before and dissolves again after.
   Test: test_law.c, table. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    if (!fw_process_table_between(x + FIRST, PAIRS, x[VALUE], result, &call->why)) return FW_INPUT;
    if ((!isnan(x[SHORTEST]) && *result < x[SHORTEST]) ||
        (!isnan(x[LONGEST]) && *result > x[LONGEST])) {
        call->why = "the time from the table is outside the shortest to longest allowed";
        return FW_INPUT;
    }
    return FW_OK;
}

#define PAIR(need, i)                                                                              \
    {"value_" #i, FW_DIM_NONE, need, true, NULL}, {                                                \
        "time_" #i, FW_DIM_TIME, need, false, NULL                                                 \
    }
static const fw_process_law_argument argument[] = {
    [VALUE] = {"value", FW_DIM_NONE, FW_LAW_REQUIRED, true, NULL},
    [SHORTEST] = {"shortest", FW_DIM_TIME, FW_LAW_OPTIONAL, false, NULL},
    [LONGEST] = {"longest", FW_DIM_TIME, FW_LAW_OPTIONAL, false, NULL},
    PAIR(FW_LAW_REQUIRED, 1),
    PAIR(FW_LAW_REQUIRED, 2),
    PAIR(FW_LAW_OPTIONAL, 3),
    PAIR(FW_LAW_OPTIONAL, 4),
    PAIR(FW_LAW_OPTIONAL, 5),
    PAIR(FW_LAW_OPTIONAL, 6)};
const fw_process_law fw_process_law_lab_table = {
    "table",  "t between the laboratory's own pairs value_i, time_i",
    argument, FIRST + 2 * PAIRS,
    evaluate, NULL,
    NULL,     NULL};
