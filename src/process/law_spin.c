/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"
#include <math.h>

enum { THICKNESS, REFERENCE_THICKNESS, REFERENCE_SPEED, EXPONENT, TIME };

/* Solves the speed, not the time: w = w0 (d0/d)^(1/a), from d = k w^-a with a near 1/2 for thin and
   1 for very thick resists. The time is the spin time of the resist's data sheet.
   d m, w rad/s; a 1. Test: test_law.c, spin. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    if (x[EXPONENT] <= 0.0 || x[THICKNESS] <= 0.0 || x[REFERENCE_THICKNESS] <= 0.0) {
        call->why = "thicknesses and exponent must be above zero";
        return FW_INPUT;
    }
    *result = x[TIME];
    return FW_OK;
}

static fw_status derive(fw_arena *arena, const fw_process_law_use *use,
                        const fw_process_law_answer *answer, fw_process_step *step) {
    const fw_quantity *d = fw_process_law_input(use, "thickness"),
                      *d0 = fw_process_law_input(use, "reference_thickness"),
                      *w0 = fw_process_law_input(use, "reference_speed"),
                      *a = fw_process_law_input(use, "exponent");
    if (!d || !d0 || !w0 || !a) return FW_OK;
    double speed = w0->value * pow(d0->value / d->value, 1.0 / a->value);
    double share = hypot(d->uncertainty / d->value, d0->uncertainty / d0->value) / a->value;
    double by_a = log(d0->value / d->value) / (a->value * a->value) * a->uncertainty;
    share = hypot(hypot(share, by_a), w0->uncertainty / w0->value);
    return fw_process_step_derive(arena, step, "spin speed", speed, speed * share,
                                  (fw_quantity_dimension)FW_DIM_ROTATION, "rpm", answer->status,
                                  "computed: spin curve");
}

static const fw_process_law_argument argument[] = {
    [THICKNESS] = {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    [REFERENCE_THICKNESS] = {"reference_thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    [REFERENCE_SPEED] = {"reference_speed", FW_DIM_ROTATION, FW_LAW_REQUIRED, false, NULL},
    [EXPONENT] = {"exponent", FW_DIM_NONE, FW_LAW_REQUIRED, false, NULL},
    [TIME] = {"time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_spin = {
    "spin", "speed = w0 (d0/d)^(1/a); t = time", argument, 5, evaluate, NULL, derive, NULL};
