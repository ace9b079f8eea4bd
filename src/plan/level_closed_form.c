/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/ladder.h"
#include <math.h>

void fw_plan_ladder_printed(const fw_flexure_input *in, fw_flexure_result *r) {
    if (in->kind != FW_FLEXURE_CSFH || in->crystal.known || !(r->strain_fit_per_rad > 0.0)) return;
    r->limit_angle_rad *= r->strain_per_rad / r->strain_fit_per_rad;
    r->strain_per_rad = r->strain_fit_per_rad;
}

/* linear, roots and depth included: flexure/flexure_table.c */
fw_status fw_plan_ladder_closed_form(const fw_plan_ladder_case *c, fw_report_level *row) {
    fw_flexure_result r;
    fw_flexure_closed_form(&c->hinge->input, &r);
    fw_plan_ladder_printed(&c->hinge->input, &r);
    *row = (fw_report_level){.stiffness_Nm_per_rad = r.stiffness_Nm_per_rad,
                             .kx_N_per_m = r.kx_N_per_m,
                             .ky_N_per_m = r.ky_N_per_m,
                             .strain_per_rad = r.strain_per_rad,
                             .limit_angle_rad = r.limit_angle_rad,
                             .moment_Nm = r.stiffness_Nm_per_rad * r.limit_angle_rad,
                             .drift_m = (double)NAN,
                             .error = r.error};
    return FW_OK;
}
