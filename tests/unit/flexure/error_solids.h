/* SPDX-License-Identifier: GPL-3.0-or-later */
/* 23 flexures with fillets and root blocks, solved by the continuum level (fw_continuum_shape_of, E
   150 GPa; refinement 1); their strains as in tests/data/hinge/root_strain.csv, where they stand,
   too (test_root_strain.c). For test_error.c and the table of docs/theory/flexure-errors.md
   (tools/solids/errors.c). */
#ifndef FW_TEST_ERROR_SOLIDS_H
#define FW_TEST_ERROR_SOLIDS_H
#include "solid_input.h"

typedef struct error_solid {
    double radius, width, angle, fillet, depth, poisson; /* um, deg; angle 0: leaf of that length */
    double K, kx, ky, W, strain;                         /* uN um/rad, N/m, um, 1/rad */
} error_solid;

static const error_solid SOLID[] = {
    {100, 5, 140, 0.5, 30, 0.22, 190118, 50.7509, 452.503, 76.381, 0.0212},
    {120, 6, 300, 3, 60, 0.36, 267699, 31.899, 49.0483, 23.238, 0.0066696},
    {100, 5, 220, 5, 50, 0.22, 208037, 35.8399, 120.605, 49.691, 0.0081487},
    {100, 15, 300, 15, 15, 0.34, 1.23198e+06, 209.144, 334.376, 21.149, 0.017961},
    {100, 8, 270, 0.8, 50, 0.22, 676639, 111.915, 217.18, 28.984, 0.017722},
    {100, 8, 140, 8, 50, 0.22, 1.3491e+06, 377.56, 3547.07, 77.766, 0.020696},
    {100, 15, 140, 15, 50, 0.28, 9.08356e+06, 2621.59, 23845.1, 78.512, 0.039542},
    {100, 10, 180, 5, 50, 0.34, 2.0147e+06, 403.862, 2096.68, 63.633, 0.021736},
    {100, 12, 180, 12, 90, 0.22, 6.47122e+06, 1330.36, 7226.76, 65.181, 0.024719},
    {200, 10, 180, 2, 50, 0.28, 990593, 49.2332, 255.109, 126.471, 0.013182},
    {150, 9, 200, 9, 50, 0.31, 887108, 72.6696, 308.6, 86.089, 0.010533},
    {71.62, 9, 240, 9, 50, 0.22, 1.56581e+06, 509.847, 1417.73, 30.945, 0.019166},
    {80, 12, 240, 3, 100, 0.30, 6.64973e+06, 1716.09, 4362.57, 31.868, 0.028422},
    {100, 10, 240, 10, 9, 0.34, 272438, 45.3344, 124.719, 42.618, 0.014648},
    {60, 6, 270, 6, 50, 0.22, 493331, 225.822, 464.668, 18.857, 0.013508},
    {100, 15, 270, 7.5, 60, 0.28, 5.3946e+06, 891.248, 1753.17, 29.735, 0.02181},
    {100, 10, 300, 10, 50, 0.22, 1.21485e+06, 207.111, 326.726, 20.487, 0.011914},
    {150, 7.5, 300, 0.75, 40, 0.22, 267501, 20.4729, 30.8774, 27.762, 0.009894},
    {471, 8, 0, 4, 50, 0.22, 679344, 36.6813, 121460, 0.000, 0.011181},
    {300, 9, 0, 9, 50, 0.28, 1.55546e+06, 216.161, 211608, 0.000, 0.017754},
    {200, 10, 0, 1, 50, 0.30, 3.0556e+06, 865.832, 327037, 0.000, 0.050171},
    {400, 5, 0, 5, 50, 0.34, 198625, 15.3501, 90746.2, 0.000, 0.0075708},
    {250, 8, 0, 2, 20, 0.22, 504118, 93.5912, 87131.2, 0.000, 0.023473},
};

enum { SOLIDS = sizeof SOLID / sizeof SOLID[0] };

static inline fw_flexure_result error_solid_form(const error_solid *s) {
    const fw_flexure_input in =
        solid_input(&(solid_shape){s->radius, s->width, s->angle, s->fillet, s->depth, s->poisson});
    fw_flexure_result out;
    fw_flexure_closed_form(&in, &out);
    return out;
}

#endif
