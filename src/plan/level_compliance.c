/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/ladder.h"
#include "base/constants.h"
#include <math.h>

/* The hinge of three degrees of freedom at finite rotation (flexure/finite.c), as the mechanism
   uses it, at the limit angle: what it then is against small displacements, the moment over the
   angle as its stiffness, W of the second body where it has drifted to. Its error is that of the
   closed form it is made from, and the drift's 0.006 um of 0.7 against finite elements, 1 % */
fw_status fw_plan_ladder_compliance(const fw_plan_ladder_case *c, fw_report_level *row) {
    const fw_flexure_hinge_law *law = &c->hinge->law;
    fw_flexure_result own = c->hinge->closed_form;
    const fw_flexure_result *r = &own;
    fw_plan_ladder_printed(&c->hinge->input, &own);
    const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(law);
    double limit = r->limit_angle_rad, most = 2 * (FW_PI - law->half_angle_rad) / law->share;
    if (!(limit < fmin(0.95 * most, FW_PI))) {
        *row = (fw_report_level){.state = FW_LEVEL_NONE,
                                 .why = "the arc would close before the limit angle"};
        return FW_OK;
    }
    fw_flexure_hinge_at at;
    double u[2], wrench[3], tangent[3][3];
    fw_flexure_drift_displacement(law, limit, NULL, u);
    const double twist[3] = {limit, u[0], u[1]};
    fw_flexure_hinge_law_wrench(law, &rest, twist, wrench, tangent);
    fw_flexure_hinge_law_at(law, limit, &at);
    *row = (fw_report_level){.stiffness_Nm_per_rad = wrench[0] / limit,
                             .kx_N_per_m = at.kx_N_per_m.value,
                             .ky_N_per_m = at.ky_N_per_m.value,
                             .strain_per_rad = r->strain_per_rad,
                             .limit_angle_rad = limit,
                             .moment_Nm = wrench[0],
                             .drift_m = hypot(u[0], u[1]),
                             .at_m = {u[0], u[1]},
                             .error = r->error};
    row->error.kx += 0.002, row->error.ky += 0.002; /* its own thick arc: Winkler's is 0.2 % off */
    row->error.centre_m += 0.01 * hypot(u[0], u[1]);
    return FW_OK;
}
