/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The integrators and stabilisations that can be asked for by name. */
#include "dynamics/run.h"

fw_method_row fw_integrator_at(size_t i) {
    size_t count;
    const fw_stepper_row *const *stepper = fw_stepper_table(&count);
    if (i == 0) return (fw_method_row){"auto", "chooses by the spectrum of the scene and says why"};
    return i <= count ? (fw_method_row){stepper[i - 1]->name, stepper[i - 1]->summary}
                      : (fw_method_row){NULL, NULL};
}

fw_method_row fw_stabilisation_at(size_t i) {
    static const fw_method_row row[] = {
        {"projection", "every accepted step is moved onto the constraints, to round-off"},
        {"baumgarte", "violations are damped away by the equations; an error floor remains"},
        {"none", "violations grow; for comparison"},
        {NULL, NULL},
    };
    return row[i < 3 ? i : 3];
}
