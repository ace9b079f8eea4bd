/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What comes in at the border of this room, and the integrators and stabilisations that can be
   asked for by name. */
#include "dynamics/run.h"
#include <math.h>
#include <string.h>

static fw_status usage(fw_status status) {
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* ---- names ---- */

static fw_status pick(fw_diags *diags, int number, const char *what, const char *wanted,
                      fw_multibody_method_row (*at)(size_t), const char **name) {
    *name = at(0).name;
    if (!wanted) return FW_OK;
    fw_text names = fw_text_new(diags->arena);
    for (size_t i = 0; at(i).name; i++) {
        if (strcmp(at(i).name, wanted) == 0) {
            *name = at(i).name;
            return FW_OK;
        }
        fw_text_printf(&names, "%s%s", i ? ", " : "", at(i).name);
    }
    FW_TRY(fw_text_end(&names));
    return usage(fw_diag_error(diags, number, (fw_place){0},
                               "there is no %s \"%.60s\"; known are %s", what, wanted, names.data));
}

fw_status fw_dynamics_check_names(const fw_dynamics_motion_options *o, fw_diags *diags,
                                  fw_dynamics_motion *motion) {
    FW_TRY(pick(diags, 103, "method", o->method, fw_multibody_method_at, &motion->method));
    FW_TRY(pick(diags, 104, "integrator", o->integrator, fw_dynamics_integrator_at,
                &motion->integrator));
    return pick(diags, 104, "stabilisation", o->stabilise, fw_dynamics_stabilisation_at,
                &motion->stabilise);
}

fw_status fw_dynamics_check_options(const fw_dynamics_motion_options *o, fw_diags *diags) {
    if (!(o->rtol >= 0) || !isfinite(o->rtol) || !(o->accuracy >= 0) || !isfinite(o->accuracy) ||
        o->samples < 0)
        return usage(fw_diag_error(diags, 105, (fw_place){0},
                                   "rtol, accuracy and samples must be finite and not negative"));
    return FW_OK;
}

/* ---- what there is ---- */

fw_multibody_method_row fw_dynamics_integrator_at(size_t i) {
    size_t count;
    const fw_maths_stepper_row *const *stepper = fw_maths_stepper_table(&count);
    if (i == 0)
        return (fw_multibody_method_row){"auto",
                                         "chooses by the spectrum of the scene and says why"};
    return i <= count ? (fw_multibody_method_row){stepper[i - 1]->name, stepper[i - 1]->summary}
                      : (fw_multibody_method_row){NULL, NULL};
}

fw_multibody_method_row fw_dynamics_stabilisation_at(size_t i) {
    static const fw_multibody_method_row row[] = {
        {"projection", "every accepted step is moved onto the constraints, to round-off"},
        {"baumgarte", "violations are damped away by the equations; an error floor remains"},
        {"none", "violations grow; for comparison"},
        {NULL, NULL},
    };
    return row[i < 3 ? i : 3];
}
