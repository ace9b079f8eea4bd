/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"

/* t = t0 (d/d0)^2: water that must diffuse back through a baked resist. d m, t s.
   Test: test_law.c, diffusion. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    double ratio = x[0] / x[1];
    *result = x[2] * ratio * ratio;
    return FW_OK;
}

static const fw_process_law_argument argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"reference_thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"reference_time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_diffusion = {
    "diffusion", "t = t0 (d/d0)^2", argument, 3, evaluate, NULL, NULL, NULL};
