/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/hinge_ladder.h"

/* linear, roots and depth included: flexure/table.c */
fw_status fw_ladder_closed_form(const fw_ladder_case *c, fw_ladder_row *row, bool *exists) {
    fw_flexure_result r;
    fw_flexure_closed_form(&c->hinge->input, &r);
    *exists = true;
    *row = (fw_ladder_row){.stiffness_Nm_per_rad = r.stiffness_Nm_per_rad,
                           .kx_N_per_m = r.kx_N_per_m,
                           .ky_N_per_m = r.ky_N_per_m,
                           .strain_per_rad = r.strain_per_rad,
                           .limit_angle_rad = r.limit_angle_rad,
                           .error = r.error};
    fw_ladder_place(c, 0, 0, row->centre_m);
    return FW_OK;
}
