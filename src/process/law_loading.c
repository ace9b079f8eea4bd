/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"

/* (1 + kappa A)/(1 + kappa A_ref): the etch slows down with the open area.
   kappa 1/m2, A m2; factor on the time, 1. kappa from two dummy areas.
   Source: Mogab, J. Electrochem. Soc. 124 (1977) 1262. Test: test_law.c, loading. */
double fw_process_loading_factor(double kappa_per_m2, double area_m2, double reference_m2) {
    return (1.0 + kappa_per_m2 * area_m2) / (1.0 + kappa_per_m2 * reference_m2);
}

static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    *result = x[0] / x[1] * fw_process_loading_factor(x[2], x[3], x[4]);
    return FW_OK;
}

static const fw_process_law_argument argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"rate", FW_DIM_SPEED, FW_LAW_REQUIRED, false, NULL},
    {"loading", FW_DIM_PER_AREA, FW_LAW_REQUIRED, false, NULL},
    {"open_area", FW_DIM_AREA, FW_LAW_REQUIRED, false, NULL},
    {"reference_area", FW_DIM_AREA, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_loading = {
    "loading", "t = thickness/rate (1 + kappa A)/(1 + kappa A_ref)",
    argument,  5,
    evaluate,  NULL,
    NULL,      NULL};
