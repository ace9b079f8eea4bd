/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of tests/data/hinge/root_strain.csv on standard input, with its heading; for each one what
   the fit takes from the closed form: bending strain per radian at the root without concentration,
   Kt of the fillet alone, the part f of the cross-bow that is free to form, Poisson ratio out of the
   plane, strain per radian and stiffness, N m; errors of the strain downwards and upwards and of the
   stiffness upwards and downwards. tools/solids/README.md */
#include "flexure/section.h"
#include "row.h"

int main(void) {
    char line[300];
    solid_row row;
    if (!fgets(line, sizeof line, stdin)) return 1;
    while (fgets(line, sizeof line, stdin)) {
        if (!row_of(line, &row)) return 1;
        const fw_flexure_input in = row_input(&row);
        fw_flexure_result o;
        fw_flexure_closed_form(&in, &o);
        double bow = 1, deep = row.leaf ? 0 : in.depth_m / sqrt(in.radius_m * in.width_m);
        if (!row.leaf)
            bow = in.crystal.known ? fw_flexure_depth_crystal(deep, &in.crystal, o.youngs_Pa).bow
                                   : fw_flexure_depth_at(deep, in.poisson).bow;
        printf("%.12g %.12g %.12g %.12g %.12g %.12g %.4g %.4g %.4g %.4g\n",
               o.strain_per_rad / o.concentration,
               fw_flexure_fillet_concentration(row.width_m, row.fillet_m), bow, o.poisson,
               o.strain_per_rad, o.stiffness_Nm_per_rad, o.error.strain, o.error.above,
               o.error.stiffness, o.error.softer);
    }
    return 0;
}
