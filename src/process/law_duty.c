/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"
#include <math.h>

enum { TIME, PULSE, PAUSE };

/* more than 1e-9 into the next pulse counts as one more, so that 40 s in pulses of 20 s is two */
static double pulses(double time_s, double pulse_s) {
    return fmax(1.0, ceil(time_s / pulse_s * (1.0 - 1e-9)));
}

/* t = time + (n - 1) pause, n = ceil(time/pulse): light or plasma in n parts with pauses between.
   The slopes are those of a constant n; what changes n is in steps(). Tests: test_law.c, duty;
   test_law_monte_carlo.c. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    if (x[PULSE] <= 0.0) {
        call->why = "the pulse has no length";
        return FW_INPUT;
    }
    *result = x[TIME] + (pulses(x[TIME], x[PULSE]) - 1.0) * x[PAUSE];
    return FW_OK;
}

static void slope(const double *x, double result, double *dx) {
    (void)result;
    dx[TIME] = 1.0;
    dx[PULSE] = 0.0;
    dx[PAUSE] = pulses(x[TIME], x[PULSE]) - 1.0;
}

/* n differs within two standard uncertainties of time/pulse =: r: its deviation is then at most
   u_r + 1/2, a ramp and a saw tooth about it, and the time's larger by that many pauses. Never too
   narrow, at most twice too wide. Test: test_law_monte_carlo.c. */
static double steps(const double *x, const double *u) {
    double r = x[TIME] / x[PULSE], u_r = r * hypot(u[TIME] / x[TIME], u[PULSE] / x[PULSE]);
    bool same = pulses(r - 2.0 * u_r, 1.0) == pulses(r + 2.0 * u_r, 1.0);
    return same ? 0.0 : x[PAUSE] * (u_r + 0.5);
}

static fw_status derive(fw_arena *arena, const fw_process_law_use *use,
                        const fw_process_law_answer *answer, fw_process_step *step) {
    const fw_quantity *time = fw_process_law_input(use, "time"),
                      *pulse = fw_process_law_input(use, "pulse");
    if (!answer->computable || !time || !pulse) return FW_OK;
    return fw_process_step_derive(arena, step, "number of parts", pulses(time->value, pulse->value),
                                  0.0, (fw_quantity_dimension)FW_DIM_NONE, "1", answer->status,
                                  "computed: duty law");
}

static const fw_process_law_argument argument[] = {
    [TIME] = {"time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL},
    [PULSE] = {"pulse", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL},
    [PAUSE] = {"pause", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_duty = {
    "duty", "t = time + (n - 1) pause, n = ceil(time/pulse)", argument, 3, evaluate, slope, derive,
    steps};
