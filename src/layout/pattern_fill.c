/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fill: squares with the stated share of covered area, so that etch and plating see much the same
   load everywhere. The squares stand above each other in chains on the bar, joined by stems, so
   that none comes loose. With squares of side s, stems of width n and the gap g the share is
       density = (s^2 + n g)/(s + g)^2,   so  g = (n - 2 D s + sqrt((n - 2 D s)^2 + 4 D (1 - D)
   s^2))/(2 D) content.c draws it where the other patterns leave room, at the keep-out from all of
   them. In: square, stem, keep-out, m; density, 1 (0.1 to 0.8). Test: test_patterns.c. */
#include "layout/pattern.h"
#include <math.h>

double fw_fill_gap_m(double square_m, double stem_m, double density) {
    double s = square_m, b = stem_m - 2 * density * s;
    double root = b * b + 4 * density * (1 - density) * s * s;
    return density > 0 && density < 1 ? (b + sqrt(root)) / (2 * density) : (double)NAN;
}

/* has no drawing of its own: it takes the rest of a row */
static fw_status draw(fw_pen *pen) {
    (void)pen;
    return FW_GEOMETRY;
}

const fw_pattern_kind fw_pattern_fill = {
    .name = "fill",
    .what = "squares where nothing else is, for an even load",
    .parameter = {{"square", 40e-6, 8e-6, 500e-6, false},
                  {"stem", 10e-6, 4e-6, 100e-6, false},
                  {"density", 0.5, 0.1, 0.8, true},
                  {"keep-out", 60e-6, 8e-6, 500e-6, false}},
    .nparameter = 4,
    .draw = draw,
    .fills = true,
};
