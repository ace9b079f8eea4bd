/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A number of the description that advice may change, as somebody would type it. Private to the
   room. */
#ifndef FW_VERDICT_TRIAL_VALUE_H
#define FW_VERDICT_TRIAL_VALUE_H
#include "verdict/trial.h"

typedef struct fw_verdict_value { /* all in the unit as written */
    const char *path;             /* what --set takes */
    fw_quantity_unit unit;
    const char *unit_text;
    double now, low, high;
    double range; /* to the farther end */
    double digit; /* no value is finer */
} fw_verdict_value;

/* of a parameter; *ok false: nothing says how far it may go, or it may not go anywhere */
fw_status fw_verdict_value_of_parameter(fw_verdict_trial *trial, const fw_device_parameter *p,
                                        fw_verdict_value *value, bool *ok);
/* "12.4 um" */
const char *fw_verdict_value_text(fw_arena *arena, const fw_verdict_value *value, double x,
                                  int digits);
/* the power of ten at or below x, not finer than the finest digit */
double fw_verdict_value_step(const fw_verdict_value *value, double x);
/* the nearest whole number of steps, which are a power of ten */
double fw_verdict_value_rounded(double x, double step);

#endif
