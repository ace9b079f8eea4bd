/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time laws of baths: plating by charge, rinsing by dilution. */
#include "process/process_law.h"
#include "base/constants.h"
#include <math.h>

enum { THICKNESS, DENSITY, CURRENT_DENSITY, VALENCE, MOLAR_MASS, EFFICIENCY, POROSITY, AREA };

static double or_one(double x) {
    return isnan(x) ? 1.0 : x;
}

/* t = d rho P n F/(eta J M). d m, rho kg/m3, J A/m2, M kg/mol, eta and P 1; t s.
   P is 1 for a dense deposit and the porosity when silicon is dissolved to pores.
   The supply sets I = J A: an area that is wrong by 1 % makes J, and so t, wrong by 1 %. Therefore
   the area enters the uncertainty with faraday_slope t/A although the value does not depend on it.
   Source: Faraday's law; Lehmann, Electrochemistry of Silicon. Test: test_law.c, faraday. */
static fw_status faraday_time(fw_process_law_call *call, const double *x, double *result) {
    if (x[CURRENT_DENSITY] <= 0.0 || x[MOLAR_MASS] <= 0.0 || or_one(x[EFFICIENCY]) <= 0.0) {
        call->why = "current density, molar mass and efficiency must be above zero";
        return FW_INPUT;
    }
    *result = x[THICKNESS] * x[DENSITY] * or_one(x[POROSITY]) * x[VALENCE] * FW_FARADAY_C_PER_mol /
              (or_one(x[EFFICIENCY]) * x[CURRENT_DENSITY] * x[MOLAR_MASS]);
    return FW_OK;
}

static void faraday_slope(const double *x, double result, double *dx) {
    static const int power[] = {
        [THICKNESS] = 1,   [DENSITY] = 1,     [CURRENT_DENSITY] = -1, [VALENCE] = 1,
        [MOLAR_MASS] = -1, [EFFICIENCY] = -1, [POROSITY] = 1,         [AREA] = 1};
    for (int i = 0; i <= AREA; i++)
        dx[i] = x[i] != 0.0 ? power[i] * result / x[i] : 0.0;
}

/* I = J A, Q = I t, m = rho P d A; the errors of area and current stay in the time */
static fw_status faraday_derive(fw_arena *arena, const fw_process_law_use *use,
                                const fw_process_law_answer *answer, fw_process_step *step) {
    const fw_quantity *J = fw_process_law_input(use, "current_density"),
                      *A = fw_process_law_input(use, "area"),
                      *d = fw_process_law_input(use, "thickness"),
                      *rho = fw_process_law_input(use, "density"),
                      *P = fw_process_law_input(use, "porosity");
    if (!J || !A) return FW_OK;
    const char *source = "computed: Faraday's law";
    double share_J = J->uncertainty / J->value;
    double current = J->value * A->value;
    FW_TRY(fw_process_step_derive(arena, step, "current", current, current * share_J,
                                  (fw_quantity_dimension)FW_DIM_CURRENT, current < 0.1 ? "mA" : "A",
                                  answer->status, source));
    if (!answer->computable || !d || !rho) return FW_OK;
    double share_t = answer->uncertainty / answer->value;
    double charge = current * answer->value, mass = rho->value * d->value * A->value;
    FW_TRY(fw_process_step_derive(arena, step, "charge", charge, charge * share_t,
                                  (fw_quantity_dimension)FW_DIM_CHARGE, "C", answer->status,
                                  source));
    FW_TRY(fw_process_step_derive(arena, step, "charge, as the supply shows it", charge,
                                  charge * share_t, (fw_quantity_dimension)FW_DIM_CHARGE, "A h",
                                  answer->status, source));
    double share_m = hypot(rho->uncertainty / rho->value, A->uncertainty / A->value);
    share_m = hypot(share_m, d->uncertainty / d->value);
    if (P) {
        mass *= P->value;
        share_m = hypot(share_m, P->uncertainty / P->value);
    }
    return fw_process_step_derive(arena, step, P ? "mass dissolved" : "mass deposited", mass,
                                  mass * share_m, (fw_quantity_dimension)FW_DIM_MASS, "mg",
                                  answer->status, source);
}

static const fw_process_law_argument faraday_argument[] = {
    [THICKNESS] = {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    [DENSITY] = {"density", FW_DIM_DENSITY, FW_LAW_REQUIRED, false, NULL},
    [CURRENT_DENSITY] = {"current_density", FW_DIM_CURRENT_DENSITY, FW_LAW_REQUIRED, false, NULL},
    [VALENCE] = {"valence", FW_DIM_NONE, FW_LAW_REQUIRED, false, NULL},
    [MOLAR_MASS] = {"molar_mass", FW_DIM_MOLAR_MASS, FW_LAW_REQUIRED, false, NULL},
    [EFFICIENCY] = {"efficiency", FW_DIM_NONE, FW_LAW_OPTIONAL, false, NULL},
    [POROSITY] = {"porosity", FW_DIM_NONE, FW_LAW_OPTIONAL, false, NULL},
    [AREA] = {"area", FW_DIM_AREA, FW_LAW_OPTIONAL, false, NULL}};
const fw_process_law fw_process_law_faraday = {
    .name = "faraday",
    .formula = "t = d rho P n F/(eta J M)",
    .argument = faraday_argument,
    .nargument = 8,
    .evaluate = faraday_time,
    .slope = faraday_slope,
    .derive = faraday_derive,
};

/* t = (V/Q) ln(c0/c): rinsing in a stirred overflow bath. V m3, Q m3/s, c0/c 1; t s.
   Test: test_law.c, dilution. */
static fw_status dilution_time(fw_process_law_call *call, const double *x, double *result) {
    if (x[2] < 1.0) {
        call->why = "the dilution must be 1 or more";
        return FW_INPUT;
    }
    *result = x[0] / x[1] * log(x[2]);
    return FW_OK;
}

static const fw_process_law_argument dilution_argument[] = {
    {"volume", FW_DIM_VOLUME, FW_LAW_REQUIRED, false, NULL},
    {"flow", FW_DIM_FLOW, FW_LAW_REQUIRED, false, NULL},
    {"dilution", FW_DIM_NONE, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_dilution = {
    .name = "dilution",
    .formula = "t = (volume/flow) ln(dilution)",
    .argument = dilution_argument,
    .nargument = 3,
    .evaluate = dilution_time,
};
