/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/ode.h"
#include <string.h>

static const fw_maths_stepper_row *const table[] = {
    &fw_maths_dop853_row,    &fw_maths_dopri5_row,
    &fw_maths_radau5_row,    &fw_maths_generalised_alpha_row,
    &fw_maths_rk4_row,       &fw_maths_gsl_rkf45_row,
    &fw_maths_gsl_rk8pd_row, &fw_maths_gsl_msadams_row,
    &fw_maths_gsl_bsimp_row,
};

const fw_maths_stepper_row *const *fw_maths_stepper_table(size_t *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

const fw_maths_stepper_row *fw_maths_stepper_find(const char *name) {
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (strcmp(table[i]->name, name) == 0) return table[i];
    return NULL;
}
