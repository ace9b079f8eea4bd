/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time laws of resist: spinning, water that comes back after the bake, dose of light, exposure in
   parts. */
#include "process/process_law.h"
#include <math.h>

enum { SPIN_THICKNESS, SPIN_REFERENCE_THICKNESS, SPIN_REFERENCE_SPEED, SPIN_EXPONENT, SPIN_TIME };

/* Solves the speed, not the time: w = w0 (d0/d)^(1/a), from d = k w^-a with a near 1/2 for thin and
   1 for very thick resists. The time is the spin time of the resist's data sheet.
   d m, w rad/s; a 1. Test: test_law.c, spin. */
static fw_status spin_speed(fw_process_law_call *call, const double *x, double *result) {
    if (x[SPIN_EXPONENT] <= 0.0 || x[SPIN_THICKNESS] <= 0.0 || x[SPIN_REFERENCE_THICKNESS] <= 0.0) {
        call->why = "thicknesses and exponent must be above zero";
        return FW_INPUT;
    }
    *result = x[SPIN_TIME];
    return FW_OK;
}

static fw_status spin_derive(fw_arena *arena, const fw_process_law_use *use,
                             const fw_process_law_answer *answer, fw_process_step *step) {
    const fw_quantity *d = fw_process_law_input(use, "thickness"),
                      *d0 = fw_process_law_input(use, "reference_thickness"),
                      *w0 = fw_process_law_input(use, "reference_speed"),
                      *a = fw_process_law_input(use, "exponent");
    if (!d || !d0 || !w0 || !a) return FW_OK;
    double speed = w0->value * pow(d0->value / d->value, 1.0 / a->value);
    double by_d0 = d0->uncertainty / d0->value / a->value;
    double share = hypot(d->uncertainty / d->value / a->value, by_d0);
    double by_a = log(d0->value / d->value) / (a->value * a->value) * a->uncertainty;
    share = hypot(hypot(share, by_a), w0->uncertainty / w0->value);
    /* both are of one spin curve; a thicker reference spins faster, a larger exponent slower where it is thicker */
    double crossed = -2.0 * fw_quantity_correlation(d0, a) * by_d0 * by_a;
    if (crossed != 0.0) share = sqrt(fmax(share * share + crossed, 0.0));
    return fw_process_step_derive(arena, step, "spin speed", speed, speed * share,
                                  (fw_quantity_dimension)FW_DIM_ROTATION, "rpm", answer->status,
                                  "computed: spin curve");
}

static const fw_process_law_argument spin_argument[] = {
    [SPIN_THICKNESS] = {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    [SPIN_REFERENCE_THICKNESS] = {"reference_thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false,
                                  NULL},
    [SPIN_REFERENCE_SPEED] = {"reference_speed", FW_DIM_ROTATION, FW_LAW_REQUIRED, false, NULL},
    [SPIN_EXPONENT] = {"exponent", FW_DIM_NONE, FW_LAW_REQUIRED, false, NULL},
    [SPIN_TIME] = {"time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_spin = {
    .name = "spin",
    .formula = "speed = w0 (d0/d)^(1/a); t = time",
    .argument = spin_argument,
    .nargument = 5,
    .evaluate = spin_speed,
    .derive = spin_derive,
};

/* t = t0 (d/d0)^2: water that must diffuse back through a baked resist. d m, t s.
   Test: test_law.c, diffusion. */
static fw_status diffusion_time(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    double ratio = x[0] / x[1];
    *result = x[2] * ratio * ratio;
    return FW_OK;
}

static const fw_process_law_argument diffusion_argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"reference_thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"reference_time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_diffusion = {
    .name = "diffusion",
    .formula = "t = t0 (d/d0)^2",
    .argument = diffusion_argument,
    .nargument = 3,
    .evaluate = diffusion_time,
};

enum { DOSE_INTENSITY, DOSE_GIVEN, DOSE_THICKNESS, DOSE_FIRST, DOSE_PAIRS = 6 };

static bool dose_of(const double *x, double *dose, const char **why) {
    if (!isnan(x[DOSE_GIVEN])) {
        *dose = x[DOSE_GIVEN];
        return true;
    }
    return fw_process_table_between(x + DOSE_FIRST, DOSE_PAIRS, x[DOSE_THICKNESS], dose, why);
}

/* t = D/I; D given, or linear between pairs of resist thickness and dose, never beyond them.
   I W/m2, D J/m2, thickness m; t s. The error of the thickness counts with the slope of the table.
   Error: the doses of one table rise and fall together (lamp meter, resist lot, developer), so that
   a table with 7 % gives a dose with 7 %. Test: test_law.c, dose. */
static fw_status dose_time(fw_process_law_call *call, const double *x, double *result) {
    double dose = 0.0;
    if (x[DOSE_INTENSITY] <= 0.0) {
        call->why = "the lamp gives no light";
        return FW_INPUT;
    }
    if (!dose_of(x, &dose, &call->why)) return FW_INPUT;
    *result = dose / x[DOSE_INTENSITY];
    return FW_OK;
}

static fw_status dose_derive(fw_arena *arena, const fw_process_law_use *use,
                             const fw_process_law_answer *answer, fw_process_step *step) {
    const fw_quantity *intensity = fw_process_law_input(use, "intensity");
    if (!answer->computable || !intensity) return FW_OK;
    double dose = answer->value * intensity->value;
    double share = answer->uncertainty / answer->value,
           share_lamp = intensity->uncertainty / intensity->value;
    double share_dose = sqrt(fmax(0.0, share * share - share_lamp * share_lamp));
    return fw_process_step_derive(arena, step, "dose", dose, dose * share_dose,
                                  (fw_quantity_dimension)FW_DIM_DOSE, "mJ/cm2", answer->status,
                                  "computed: dose law");
}

#define PAIR(i)                                                                                    \
    {"thickness_" #i, FW_DIM_LENGTH, FW_LAW_OPTIONAL, false, NULL}, {                              \
        "dose_" #i, FW_DIM_DOSE, FW_LAW_OPTIONAL, false, dose_table                                \
    }
static const char dose_table[] = "dose table";
static const fw_process_law_argument dose_argument[] = {
    [DOSE_INTENSITY] = {"intensity", FW_DIM_INTENSITY, FW_LAW_REQUIRED, false, NULL},
    [DOSE_GIVEN] = {"dose", FW_DIM_DOSE, FW_LAW_OPTIONAL, false, NULL},
    [DOSE_THICKNESS] = {"thickness", FW_DIM_LENGTH, FW_LAW_OPTIONAL, false, NULL},
    PAIR(1),
    PAIR(2),
    PAIR(3),
    PAIR(4),
    PAIR(5),
    PAIR(6)};
const fw_process_law fw_process_law_dose = {
    .name = "dose",
    .formula = "t = dose(thickness)/intensity",
    .argument = dose_argument,
    .nargument = DOSE_FIRST + 2 * DOSE_PAIRS,
    .evaluate = dose_time,
    .derive = dose_derive,
};

enum { DUTY_TIME, DUTY_PULSE, DUTY_PAUSE };

/* more than 1e-9 into the next pulse counts as one more, so that 40 s in pulses of 20 s is two */
static double pulses(double time_s, double pulse_s) {
    return fmax(1.0, ceil(time_s / pulse_s * (1.0 - 1e-9)));
}

/* t = time + (n - 1) pause, n = ceil(time/pulse): light or plasma in n parts with pauses between.
   The slopes are those of a constant n; what changes n is in steps(). Tests: test_law.c, duty;
   test_law_monte_carlo.c. */
static fw_status duty_time(fw_process_law_call *call, const double *x, double *result) {
    if (x[DUTY_PULSE] <= 0.0) {
        call->why = "the pulse has no length";
        return FW_INPUT;
    }
    *result = x[DUTY_TIME] + (pulses(x[DUTY_TIME], x[DUTY_PULSE]) - 1.0) * x[DUTY_PAUSE];
    return FW_OK;
}

static void duty_slope(const double *x, double result, double *dx) {
    (void)result;
    dx[DUTY_TIME] = 1.0;
    dx[DUTY_PULSE] = 0.0;
    dx[DUTY_PAUSE] = pulses(x[DUTY_TIME], x[DUTY_PULSE]) - 1.0;
}

/* n differs within two standard uncertainties of time/pulse =: r: its deviation is then at most
   u_r + 1/2, a ramp and a saw tooth about it, and the time's larger by that many pauses. Never too
   narrow, at most twice too wide. Test: test_law_monte_carlo.c. */
static double steps(const double *x, const double *u) {
    double r = x[DUTY_TIME] / x[DUTY_PULSE],
           u_r = r * hypot(u[DUTY_TIME] / x[DUTY_TIME], u[DUTY_PULSE] / x[DUTY_PULSE]);
    bool same = pulses(r - 2.0 * u_r, 1.0) == pulses(r + 2.0 * u_r, 1.0);
    return same ? 0.0 : x[DUTY_PAUSE] * (u_r + 0.5);
}

static fw_status duty_derive(fw_arena *arena, const fw_process_law_use *use,
                             const fw_process_law_answer *answer, fw_process_step *step) {
    const fw_quantity *time = fw_process_law_input(use, "time"),
                      *pulse = fw_process_law_input(use, "pulse");
    if (!answer->computable || !time || !pulse) return FW_OK;
    return fw_process_step_derive(arena, step, "number of parts", pulses(time->value, pulse->value),
                                  0.0, (fw_quantity_dimension)FW_DIM_NONE, "1", answer->status,
                                  "computed: duty law");
}

static const fw_process_law_argument duty_argument[] = {
    [DUTY_TIME] = {"time", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL},
    [DUTY_PULSE] = {"pulse", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL},
    [DUTY_PAUSE] = {"pause", FW_DIM_TIME, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_duty = {
    .name = "duty",
    .formula = "t = time + (n - 1) pause, n = ceil(time/pulse)",
    .argument = duty_argument,
    .nargument = 3,
    .evaluate = duty_time,
    .slope = duty_slope,
    .derive = duty_derive,
    .steps = steps,
};
