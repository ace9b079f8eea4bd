/* SPDX-License-Identifier: GPL-3.0-or-later */
/* undercut-ladder: free-standing lines of rising width, all with the same space between. An etch
   that eats u from either side removes every line narrower than 2 u: with w the widest line that is
   gone and w' the narrowest that stands, w < 2 u <= w'. For a masked etch to depth d of anisotropy
   A under a mask whose own etch took m per edge, 2 u = 2 (m + (1 - A) d),   so 1 - A = (v / 2 -
   m)/d with v between w and w'. In: from, to, step, space, length, m. Out: one line per step, width
   exact on the 1 nm grid. Resolution: step/2 in 2 u, that is step/(4 d) in A. Test:
   test_patterns.c. */
#include "layout/pattern.h"
#include "layout/text.h"
#include <math.h>

enum { FROM, TO, STEP, SPACE, LENGTH };

/* every second micrometre is lettered: more does not fit below narrow lines */
static bool is_lettered(double width_m) {
    double two = width_m / 2e-6;
    return fabs(two - nearbyint(two)) < 1e-6;
}

static fw_status draw(fw_pen *pen) {
    double step = fw_pen_value(pen, STEP), from = fw_pen_value(pen, FROM);
    double space = fw_pen_value(pen, SPACE), length = fw_pen_value(pen, LENGTH), x = 0;
    int n = (int)floor((fw_pen_value(pen, TO) - from) / step + 1e-6) + 1;
    if (n < 2 || n > 200) return FW_GEOMETRY;
    for (int i = 0; i < n; i++) {
        double w = fw_layout_to_grid(from + i * step), y = 0.5 * length;
        FW_TRY(
            fw_pen_bar(pen, FW_ROLE_STRUCTURE, "line of the undercut ladder", x, 0, x + w, length));
        FW_TRY(fw_pen_chord(pen, "line", x, y, x + w, y, is_lettered(w) ? FW_PEN_SIZE : NULL));
        x += w + space;
    }
    fw_pen_figure(pen, "step", step * 1e6, "um");
    fw_pen_figure(pen, "space", space * 1e6, "um");
    pen->coupon->formula = "widest line that is gone <= 2 u <= narrowest that stands; "
                           "1 - A = (u - mask undercut)/depth";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_ladder = {
    .name = "undercut-ladder",
    .what = "lines of rising width: what the etch takes from either side",
    .parameter = {{"from", 4e-6, 1e-6, 100e-6, false},
                  {"to", 24e-6, 1e-6, 200e-6, false},
                  {"step", 0.5e-6, 0.05e-6, 20e-6, false},
                  {"space", 20e-6, 1e-6, 200e-6, false},
                  {"length", 150e-6, 20e-6, 1e-3, false}},
    .nparameter = 5,
    .draw = draw,
};
