/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"

/* t = time. Handling times and holds. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    *result = x[0];
    return FW_OK;
}

static const fw_process_law_argument argument[] = {
    {"time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_const = {"const",  "t = time", argument, 1,
                                             evaluate, NULL,       NULL,     NULL};
