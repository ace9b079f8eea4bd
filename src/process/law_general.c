/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time laws of no particular process: a stated time, a constant rate, an expression, a laboratory's
   table. And of resist: spinning, water that comes back after the bake, dose of light, exposure in parts. */
#include "process/process_law.h"
#include "base/text.h"
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
   within [shortest, longest], as the window about it is (fw_process_law_window): a displacement deposit is thin before and
   dissolves again after.
   Test: test_law.c, table. */
static fw_status table_time(fw_process_law_call *call, const double *x, double *result) {
    if (!fw_process_table_between(x + FIRST, PAIRS, x[VALUE], result, &call->why)) return FW_INPUT;
    const bool brief = *result < x[SHORTEST]; /* no number is not above or below any */
    if (!brief && !(*result > x[LONGEST])) return FW_OK;
    char time[32], limit[32];
    call->why =
        fw_arena_printf(call->arena, "the time from the table, %s s, is %s allowed, %s s",
                        fw_number_text(time, sizeof time, *result, 4),
                        brief ? "below the shortest" : "above the longest",
                        fw_number_text(limit, sizeof limit, x[brief ? SHORTEST : LONGEST], 4));
    FW_NEED(call->why);
    return FW_INPUT;
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

/* ---- resist ---- */

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

#define DOSE_PAIR(i)                                                                               \
    {"thickness_" #i, FW_DIM_LENGTH, FW_LAW_OPTIONAL, false, NULL}, {                              \
        "dose_" #i, FW_DIM_DOSE, FW_LAW_OPTIONAL, false, dose_table                                \
    }
static const char dose_table[] = "dose table";
static const fw_process_law_argument dose_argument[] = {
    [DOSE_INTENSITY] = {"intensity", FW_DIM_INTENSITY, FW_LAW_REQUIRED, false, NULL},
    [DOSE_GIVEN] = {"dose", FW_DIM_DOSE, FW_LAW_OPTIONAL, false, NULL},
    [DOSE_THICKNESS] = {"thickness", FW_DIM_LENGTH, FW_LAW_OPTIONAL, false, NULL},
    DOSE_PAIR(1),
    DOSE_PAIR(2),
    DOSE_PAIR(3),
    DOSE_PAIR(4),
    DOSE_PAIR(5),
    DOSE_PAIR(6)};
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
