/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"
#include "base/constants.h"
#include <math.h>

/* t = d/R(T), R(T) = R0 exp[(Ea/kB)(1/T0 - 1/T)].
   d m, R0 m/s, Ea J, T0 and T K; t s. Valid for one reaction mechanism, for aluminium in phosphoric
   and nitric acid 15 to 55 Cel (Ea 0.36 to 0.55 eV from three published pairs).
   Test: test_law.c, arrhenius. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    if (x[3] <= 0.0 || x[4] <= 0.0) {
        call->why = "a temperature is not above absolute zero";
        return FW_INPUT;
    }
    double rate = x[1] * exp(x[2] / FW_BOLTZMANN_J_PER_K * (1.0 / x[3] - 1.0 / x[4]));
    *result = x[0] / rate;
    return FW_OK;
}

static const fw_process_law_argument argument[] = {
    {"thickness", FW_DIM_LENGTH, FW_LAW_REQUIRED, false, NULL},
    {"rate", FW_DIM_SPEED, FW_LAW_REQUIRED, false, NULL},
    {"activation_energy", FW_DIM_ENERGY, FW_LAW_REQUIRED, false, NULL},
    {"reference_temperature", FW_DIM_TEMPERATURE, FW_LAW_REQUIRED, false, NULL},
    {"temperature", FW_DIM_TEMPERATURE, FW_LAW_REQUIRED, false, NULL}};
const fw_process_law fw_process_law_arrhenius = {
    "arrhenius", "t = thickness/(rate exp(Ea/k (1/T0 - 1/T)))", argument, 5, evaluate, NULL, NULL,
    NULL};
