/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"
#include <math.h>

enum { INTENSITY, DOSE, THICKNESS, FIRST, PAIRS = 6 };

static bool dose_of(const double *x, double *dose, const char **why) {
    if (!isnan(x[DOSE])) {
        *dose = x[DOSE];
        return true;
    }
    return fw_process_table_between(x + FIRST, PAIRS, x[THICKNESS], dose, why);
}

/* t = D/I; D given, or linear between pairs of resist thickness and dose, never beyond them.
   D J/m2, I W/m2 as measured today at the mask; t s of light.
   Error: the doses of one table rise and fall together (lamp meter, resist lot, developer), so that
   a table with 7 % gives a dose with 7 %, which stands for a coat as thick as looked up: whether it
   is that thick, its own step accepts or not. Test: test_law.c, dose. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    double dose = 0.0;
    if (x[INTENSITY] <= 0.0) {
        call->why = "the lamp gives no light";
        return FW_INPUT;
    }
    if (!dose_of(x, &dose, &call->why)) return FW_INPUT;
    *result = dose / x[INTENSITY];
    return FW_OK;
}

static void slope(const double *x, double result, double *dx) {
    (void)x;
    (void)result;
    dx[THICKNESS] = 0.0; /* see above; the others by difference */
}

static fw_status derive(fw_arena *arena, const fw_process_law_use *use,
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
static const fw_process_law_argument argument[] = {
    [INTENSITY] = {"intensity", FW_DIM_INTENSITY, FW_LAW_REQUIRED, false, NULL},
    [DOSE] = {"dose", FW_DIM_DOSE, FW_LAW_OPTIONAL, false, NULL},
    [THICKNESS] = {"thickness", FW_DIM_LENGTH, FW_LAW_OPTIONAL, false, NULL},
    PAIR(1),
    PAIR(2),
    PAIR(3),
    PAIR(4),
    PAIR(5),
    PAIR(6)};
const fw_process_law fw_process_law_dose = {
    "dose", "t = dose(thickness)/intensity", argument, FIRST + 2 * PAIRS, evaluate, slope, derive,
    NULL};
