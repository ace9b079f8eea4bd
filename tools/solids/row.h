/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One row of tests/data/hinge/root_strain.csv, up to the axis: what it is a solid of. The width in
   the middle follows in varying.csv alone. */
#ifndef FW_TOOLS_SOLIDS_ROW_H
#define FW_TOOLS_SOLIDS_ROW_H
#include "flexure/flexure.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* of the isotropic solids, and what stresses of silicon are divided by */
static const double row_youngs_Pa = 150e9;
static const double row_silicon_Pa[3] = {165.7e9, 63.9e9, 79.6e9}; /* c11, c12, c44 */

typedef struct solid_row {
    bool leaf, silicon;
    double size_m, width_m, angle_rad, fillet_m, depth_m, poisson, axis_rad;
    double width_middle_m; /* 0: one width */
} solid_row;

static inline bool row_of(const char *line, solid_row *row) {
    char kind[16], material[16];
    double v[7];
    if (sscanf(line, "%15[^,],%15[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf", kind, material, &v[0], &v[1],
               &v[2], &v[3], &v[4], &v[5], &v[6]) != 9)
        return false;
    *row = (solid_row){.leaf = strcmp(kind, "leaf") == 0,
                       .silicon = strcmp(material, "silicon") == 0,
                       .size_m = 1e-6 * v[0],
                       .width_m = 1e-6 * v[1],
                       .angle_rad = v[2] * M_PI / 180,
                       .fillet_m = 1e-6 * v[3],
                       .depth_m = 1e-6 * v[4],
                       .poisson = v[5],
                       .axis_rad = v[6] * M_PI / 180};
    double middle = 0;
    if (sscanf(line, "%*[^,],%*[^,],%*f,%*f,%*f,%*f,%*f,%*f,%*f,middle=%lf", &middle) == 1)
        row->width_middle_m = 1e-6 * middle;
    return true;
}

static inline fw_flexure_input row_input(const solid_row *row) {
    fw_flexure_input in = {.kind = row->leaf ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                           .length_m = row->leaf ? row->size_m : row->size_m * row->angle_rad,
                           .angle_rad = row->leaf ? 0 : row->angle_rad,
                           .radius_m = row->leaf ? 0 : row->size_m,
                           .width_m = row->width_m,
                           .width_middle_m = row->width_middle_m,
                           .fillet_m = row->fillet_m,
                           .depth_m = row->depth_m,
                           .youngs_Pa = row_youngs_Pa,
                           .poisson = row->poisson,
                           .strength_Pa = 500e6,
                           .safety_factor = 1};
    if (row->silicon)
        in.crystal = fw_flexure_crystal_cubic(row_silicon_Pa[0], row_silicon_Pa[1],
                                              row_silicon_Pa[2], row->axis_rad);
    return in;
}

#endif
