/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time laws of etching and of baths: temperature, open area, and the depth that narrow openings lose; plating by charge,
   rinsing by dilution. */
#include "base/constants.h"
#include "process/process_law.h"
#include <math.h>
#include <string.h>

/* ---- etching ---- */

/* t = d/R(T), R(T) = R0 exp[(Ea/kB)(1/T0 - 1/T)]; where Ea, T0 or T is not known, R = R0.
   d m, R0 m/s, Ea J, T0 and T K; t s. Valid for one reaction mechanism, for aluminium in phosphoric
   and nitric acid 15 to 55 Cel (Ea 0.36 to 0.55 eV from three published pairs).
   Test: test_law.c, arrhenius. */
static fw_status arrhenius_time(fw_process_law_call *call, const double *x, double *result) {
    if (isnan(x[4])) {
        *result = x[0] / x[1];
        return FW_OK;
    }
    if (x[3] <= 0.0 || x[4] <= 0.0) {
        call->why = "a temperature is not above absolute zero";
        return FW_INPUT;
    }
    double rate = x[1] * exp(x[2] / FW_BOLTZMANN_J_PER_K * (1.0 / x[3] - 1.0 / x[4]));
    *result = x[0] / rate;
    return FW_OK;
}

/* of thickness and rate; the others by difference */
static void arrhenius_slope(const double *x, double result, double *dx) {
    dx[0] = result / x[0];
    dx[1] = -result / x[1];
    dx[2] = dx[3] = dx[4] = (double)NAN;
}

static const fw_process_law_argument arrhenius_argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"rate", FW_DIM_SPEED, FW_LAW_REQUIRED, false, NULL},
    {"activation_energy", FW_DIM_ENERGY, FW_LAW_WHEN_KNOWN, false, NULL},
    {"reference_temperature", FW_DIM_TEMPERATURE, FW_LAW_WHEN_KNOWN, false, NULL},
    {"temperature", FW_DIM_TEMPERATURE, FW_LAW_WHEN_KNOWN, false, NULL}};
const fw_process_law fw_process_law_arrhenius = {
    .name = "arrhenius",
    .formula = "t = thickness/(rate exp(Ea/k (1/T0 - 1/T)))",
    .argument = arrhenius_argument,
    .nargument = 5,
    .evaluate = arrhenius_time,
    .slope = arrhenius_slope,
};

/* (1 + kappa A)/(1 + kappa A_ref): the etch slows down with the open area.
   kappa 1/m2, A m2; factor on the time, 1; 1 where one of them is not known. kappa from two dummy areas.
   Source: Mogab, J. Electrochem. Soc. 124 (1977) 1262. Test: test_law.c, loading. */
static double loading_factor(double kappa_per_m2, double area_m2, double reference_m2) {
    return (1.0 + kappa_per_m2 * area_m2) / (1.0 + kappa_per_m2 * reference_m2);
}

static fw_status loading_time(fw_process_law_call *call, const double *x, double *result) {
    (void)call;
    *result = x[0] / x[1] * (isnan(x[2]) ? 1.0 : loading_factor(x[2], x[3], x[4]));
    return FW_OK;
}

static const fw_process_law_argument loading_argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"rate", FW_DIM_SPEED, FW_LAW_REQUIRED, false, NULL},
    {"loading", FW_DIM_PER_AREA, FW_LAW_WHEN_KNOWN, false, NULL},
    {"open_area", FW_DIM_AREA, FW_LAW_WHEN_KNOWN, false, NULL},
    {"reference_area", FW_DIM_AREA, FW_LAW_WHEN_KNOWN, false, NULL}};
const fw_process_law fw_process_law_loading = {
    .name = "loading",
    .formula = "t = thickness/rate (1 + kappa A)/(1 + kappa A_ref)",
    .argument = loading_argument,
    .nargument = 5,
    .evaluate = loading_time,
};

enum { DEPTH, RATE, WIDTH, PROBABILITY, LAG, LOADING, OPEN_AREA, REFERENCE_AREA };

/* K(x) = (1 + s - x)/2 - 1.5 (x - asinh x)^2/(x^3 + 3 x^2 + 4 - (x^2 + 4) s), s = sqrt(1 + x^2).
   x = depth/width, 1; K in (0, 1]. Series below 1e-3, where the quotient becomes 0/0; beyond 20,
   where K is a small difference of halves, they are taken out: with s - x = 1/(s + x), A = asinh x
   and b the divisor, K = 1/(2 (s + x)) + (b - 3 (x - A)^2)/(2 b).
   Error < 1e-14 relative from 1e-6 to 1e4. Source: Berman, J. Appl. Phys. 36 (1965) 3356.
   Test: test_law.c, knudsen. */
double fw_process_knudsen_slot(double x) {
    if (x < 1e-3) return 1.0 - x / 2.0 + x * x / 4.0 - x * x * x / 24.0 - x * x * x * x / 16.0;
    double s = sqrt(1.0 + x * x), A = asinh(x), over = 1.0 / (s + x);
    if (x < 20.0) {
        double below = x * x * x + 3.0 * x * x + 4.0 - (x * x + 4.0) * s;
        return 0.5 * (1.0 + over) - 1.5 * (x - A) * (x - A) / below;
    }
    double rest = 4.0 - x * x * over - 4.0 * s; /* b - 3 x^2 */
    return 0.5 * over + (rest + 3.0 * A * (2.0 * x - A)) / (2.0 * (3.0 * x * x + rest));
}

/* K(l) = 1 + l^2/4 - l s/4 - [(8 - l^2) s + l^3 - 16]^2/[72 l s - 288 ln((l + s)/2)],
   s = sqrt(l^2 + 4). l = length/radius, 1. Written without differences of large numbers: the first
   part is s/(l + s), the bracket 4 l^3 (2 + l/(s + 2))/((s + 2) (s + l)). Beyond 20 the bracket is
   6 l - w, w = 16 - 8 d - 2 l e with d = 4/(s + l), e = d/(s + l), and the halves are taken out as
   above. Series below 1e-3. Error < 1e-14 relative from 1e-6 to 1e4. Source as above. */
double fw_process_knudsen_cylinder(double l) {
    if (l < 1e-3)
        return 1.0 - l / 2.0 + l * l / 4.0 - 5.0 * l * l * l / 48.0 + l * l * l * l / 32.0;
    double s = sqrt(l * l + 4.0), A = asinh(l / 2.0), below = 72.0 * l * s - 288.0 * A;
    if (l < 20.0) {
        double part = 4.0 * l * l * l * (2.0 + l / (s + 2.0)) / ((s + 2.0) * (s + l));
        return s / (l + s) - part * part / below;
    }
    double d = 4.0 / (s + l), e = d / (s + l), w = 16.0 - 8.0 * d - 2.0 * l * e;
    return 0.5 * e + (72.0 * l * d - 288.0 * A + w * (24.0 * l - 2.0 * w)) / (2.0 * below);
}

/* Gauss-Legendre, 10 points on [-1, 1] (positive half): Abramowitz and Stegun, table 25.4 */
static const double node[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                              0.8650633666889845, 0.9739065285171717};
static const double weight[] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820,
                                0.1494513491505806, 0.0666713443086881};

static double slowing(double x, bool cylinder) {
    double K = cylinder ? fw_process_knudsen_cylinder(2.0 * x) : fw_process_knudsen_slot(x);
    return 1.0 / K - 1.0;
}

static double panel(double from, double to, bool cylinder) {
    double half = 0.5 * (to - from), middle = 0.5 * (to + from), sum = 0.0;
    for (int i = 0; i < 5; i++)
        sum += weight[i] * (slowing(middle + half * node[i], cylinder) +
                            slowing(middle - half * node[i], cylinder));
    return half * sum;
}

/* J = int_0^D (1/K(z/w) - 1) dz over panels that double in length, 10 points each.
   w, D m; J m. Error < 1e-9 relative. Cost: 10 K per factor of two in D/w. Test: arde_integral. */
double fw_process_arde_integral(double width_m, double depth_m, bool cylinder) {
    double end = depth_m / width_m, sum = 0.0, from = 0.0, to = 0.25;
    while (from < end) {
        sum += panel(from, fmin(to, end), cylinder);
        from = to;
        to *= 2.0;
    }
    return width_m * sum;
}

/* t = (D + S J(w, D))/R0: transport of neutrals into the slot (Coburn and Winters, Appl. Phys.
   Lett. 55 (1989) 2730); or, shape "linear", t = (D + c D^2/(2 w))/R0 for R = R0/(1 + c z/w). D, w
   m, R0 m/s at zero aspect ratio, S and c 1; t s. The narrowest opening of the mask decides. In
   SF6/O2 the lag may come from ions, not radicals (Jansen et al. 1997): S is empirical, to be read
   off two slots of different width. The loading factor where loading and both areas are known. Test: test_law.c, arde. */
static fw_status arde_time(fw_process_law_call *call, const double *x, double *result) {
    bool linear = strcmp(call->shape, "linear") == 0;
    bool cylinder = strcmp(call->shape, "cylinder") == 0;
    if (!linear && !cylinder && call->shape[0] && strcmp(call->shape, "slot") != 0) {
        call->why = "shape must be slot, cylinder or linear";
        return FW_INPUT;
    }
    double lag = linear ? x[LAG] : x[PROBABILITY];
    if (!(x[WIDTH] > 0.0) || !(x[RATE] > 0.0) || !(x[DEPTH] >= 0.0) || isnan(lag) ||
        !(x[DEPTH] / x[WIDTH] <= 1e6)) {
        call->why = linear ? "width, rate and lag must be given and above zero"
                           : "width, rate and probability must be given and above zero";
        return FW_INPUT;
    }
    double more = linear ? lag * x[DEPTH] * x[DEPTH] / (2.0 * x[WIDTH])
                         : lag * fw_process_arde_integral(x[WIDTH], x[DEPTH], cylinder);
    *result = (x[DEPTH] + more) / x[RATE];
    if (!isnan(x[LOADING]) && !isnan(x[OPEN_AREA]) && !isnan(x[REFERENCE_AREA]))
        *result *= loading_factor(x[LOADING], x[OPEN_AREA], x[REFERENCE_AREA]);
    return FW_OK;
}

static const fw_process_law_argument arde_argument[] = {
    [DEPTH] = {"depth", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    [RATE] = {"rate", FW_DIM_SPEED, FW_LAW_REQUIRED, false, NULL},
    [WIDTH] = {"width", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    [PROBABILITY] = {"probability", FW_DIM_NONE, FW_LAW_OPTIONAL, false, NULL},
    [LAG] = {"lag", FW_DIM_NONE, FW_LAW_OPTIONAL, false, NULL},
    [LOADING] = {"loading", FW_DIM_PER_AREA, FW_LAW_WHEN_KNOWN, false, NULL},
    [OPEN_AREA] = {"open_area", FW_DIM_AREA, FW_LAW_WHEN_KNOWN, false, NULL},
    [REFERENCE_AREA] = {"reference_area", FW_DIM_AREA, FW_LAW_WHEN_KNOWN, false, NULL}};
const fw_process_law fw_process_law_arde = {
    .name = "arde",
    .formula = "t = (D + S J(w, D))/R0",
    .argument = arde_argument,
    .nargument = 8,
    .evaluate = arde_time,
    .lags = true,
};

/* ---- baths ---- */

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

/* I = J A, Q = I t, m = rho P d A. In Q the current density cancels, whose error the time has; the area is in I, and once in
   Q. Test: test_law.c, faraday */
static fw_status faraday_derive(fw_arena *arena, const fw_process_law_use *use,
                                const fw_process_law_answer *answer, fw_process_step *step) {
    const fw_quantity *J = fw_process_law_input(use, "current_density"),
                      *A = fw_process_law_input(use, "area"),
                      *d = fw_process_law_input(use, "thickness"),
                      *rho = fw_process_law_input(use, "density"),
                      *P = fw_process_law_input(use, "porosity");
    if (!J || !A) return FW_OK;
    const char *source = "computed: Faraday's law";
    const double share_J = J->uncertainty / J->value, share_A = A->uncertainty / A->value;
    double current = J->value * A->value;
    FW_TRY(fw_process_step_derive(
        arena, step, "current", current, current * hypot(share_J, share_A),
        (fw_quantity_dimension)FW_DIM_CURRENT, current < 0.1 ? "mA" : "A", answer->status, source));
    if (!answer->computable || !d || !rho) return FW_OK;
    double share_t = answer->uncertainty / answer->value;
    share_t = sqrt(fmax(share_t * share_t - share_J * share_J, 0.0));
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
    .derived = "current",
    .of_argument = "current_density",
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
