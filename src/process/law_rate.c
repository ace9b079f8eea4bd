/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"

/* t = d/R. d m, R m/s; t s. Any removal or deposition at a constant rate, also "1 min per um".
   Exact slopes. Test: test_law.c, rate. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    *result = x[0] / x[1];
    return FW_OK;
}

static void slope(const double *x, double result, double *dx) {
    dx[0] = 1.0 / x[1];
    dx[1] = -result / x[1];
}

static const fw_process_law_argument argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"rate", FW_DIM_SPEED, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_rate = {
    "rate", "t = thickness/rate", argument, 2, evaluate, slope, NULL, NULL};
