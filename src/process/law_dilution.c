/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"
#include <math.h>

/* t = (V/Q) ln(c0/c): rinsing in a stirred overflow bath. V m3, Q m3/s, c0/c 1; t s.
   Test: test_law.c, dilution. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    if (x[2] < 1.0) {
        call->why = "the dilution must be 1 or more";
        return FW_INPUT;
    }
    *result = x[0] / x[1] * log(x[2]);
    return FW_OK;
}

static const fw_process_law_argument argument[] = {
    {"volume", FW_DIM_VOLUME, FW_LAW_REQUIRED, false, NULL},
    {"flow", FW_DIM_FLOW, FW_LAW_REQUIRED, false, NULL},
    {"dilution", FW_DIM_NONE, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_dilution = {
    "dilution", "t = (volume/flow) ln(dilution)", argument, 3, evaluate, NULL, NULL, NULL};
