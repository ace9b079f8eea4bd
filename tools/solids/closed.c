/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of tests/data/hinge/root_strain.csv on standard input, with its heading; for each one what
   the fit takes from the closed form: bending strain per radian at the root without concentration,
   Kt of the fillet alone, the moment's share that a strip as deep as this bears (depth factor),
   Poisson ratio out of the plane, strain per radian and that of (5). tools/solids/README.md */
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
        printf("%.12g %.12g %.12g %.12g %.12g %.12g\n", o.strain_per_rad / o.concentration,
               fw_flexure_fillet_concentration(row.width_m, row.fillet_m), o.depth_factor,
               o.poisson, o.strain_per_rad, o.strain_fit_per_rad);
    }
    return 0;
}
