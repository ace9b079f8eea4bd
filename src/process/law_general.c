/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time laws of no particular process: a stated time, a constant rate, an expression, a laboratory's
   table. */
#include "process/process_law.h"
#include "quantity/quantity.h"
#include <math.h>
#include <string.h>

/* t = time. Handling times and holds. */
static fw_status const_time(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    *result = x[0];
    return FW_OK;
}

static const fw_process_law_argument const_argument[] = {
    {"time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_const = {
    .name = "const",
    .formula = "t = time",
    .argument = const_argument,
    .nargument = 1,
    .evaluate = const_time,
    .stated = true,
};

/* t = d/R. d m, R m/s; t s. Any removal or deposition at a constant rate, also "1 min per um".
   Exact slopes. Test: test_law.c, rate. */
static fw_status rate_time(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    *result = x[0] / x[1];
    return FW_OK;
}

static void rate_slope(const double *x, double result, double *dx) {
    dx[0] = 1.0 / x[1];
    dx[1] = -result / x[1];
}

static const fw_process_law_argument rate_argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"rate", FW_DIM_SPEED, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_rate = {
    .name = "rate",
    .formula = "t = thickness/rate",
    .argument = rate_argument,
    .nargument = 2,
    .evaluate = rate_time,
    .slope = rate_slope,
    .by_rate = true,
};

/* t = one arithmetic expression over the declared arguments, dimension-checked: a laboratory adds
   its own law without a compiler. Slopes by central difference. Test: test_law.c, expr. */
static fw_status expr_time(fw_process_law_call *call, const double *x, double *result) {
    fw_quantity_name_value item[FW_LAW_ARGUMENTS];
    for (int i = 0; i < call->n; i++)
        item[i] = (fw_quantity_name_value){call->name[i], x[i], call->dimension[i]};
    fw_quantity_names names = {item, (size_t)call->n};
    fw_quantity_expression_error error = {0};
    fw_status status =
        fw_quantity_expression_evaluate(call->arena, call->expression, strlen(call->expression),
                                        &names, call->wanted, result, &error);
    if (status == FW_INPUT)
        call->why = error.message ? error.message : "the expression has no value";
    return status;
}

const fw_process_law fw_process_law_expr = {
    .name = "expr",
    .formula = "t = expression over the arguments",
    .evaluate = expr_time,
};

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
static fw_status table_time(fw_process_law_call *call, const double *x, double *result) {
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
static const fw_process_law_argument table_argument[] = {
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
    .name = "table",
    .formula = "t between the laboratory's own pairs value_i, time_i",
    .argument = table_argument,
    .nargument = FIRST + 2 * PAIRS,
    .evaluate = table_time,
    .pairs_of = "the laboratory curve",
};
