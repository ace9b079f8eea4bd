/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/dynamics.h"

static const fw_method_row methods[] = {
    {"chain", "reference-point coordinates, block elimination along the joint graph, proximal "
              "iteration; linear time, redundant joints and singular positions allowed"},
};

static const fw_method_row integrators[] = {
    {"auto", "picks by the problem and says why; dop853 here"},
    {"dop853", "explicit Runge-Kutta 8(5,3) of Dormand and Prince, dense output of order 7, "
               "projection of positions and velocities after every step"},
};

const fw_method_row *fw_method_table(size_t *count) {
    *count = sizeof methods / sizeof methods[0];
    return methods;
}

const fw_method_row *fw_integrator_table(size_t *count) {
    *count = sizeof integrators / sizeof integrators[0];
    return integrators;
}
