/* SPDX-License-Identifier: GPL-3.0-or-later */
/* back-mark: a window in a block of the device layer and, in its middle, the cross of the back
   side's own plate. Both are drawn as seen from the front; the plate for the back is the mirror
   image, which its order says. Centred in the window the sides agree; the distances from the arms
   to the window's edges tell the offset: (left - right)/2, (below - above)/2. In: window, cross
   (size over all), arm (width), m. Out: areas exact. Test: test_patterns.c. */
#include "layout/pattern.h"

enum { WINDOW, CROSS, ARM };
static const double RIM_M = 40e-6;

fw_status fw_back_cross_draw(fw_pen *pen, double m, double cross, double arm, double window) {
    if (cross > window - 2 * pen->space_rule_m || arm > 0.5 * cross) return FW_GEOMETRY;
    FW_TRY(fw_pen_box(pen, m - 0.5 * cross, m - 0.5 * arm, m + 0.5 * cross, m + 0.5 * arm));
    FW_TRY(fw_pen_box(pen, m - 0.5 * arm, m - 0.5 * cross, m + 0.5 * arm, m + 0.5 * cross));
    FW_TRY(fw_pen_shape(pen, FW_ROLE_BACK, "back side cross"));
    double edge = m - 0.5 * window;
    FW_TRY(fw_pen_chord(pen, "left", edge, m, m - 0.5 * cross, m, NULL));
    FW_TRY(fw_pen_chord(pen, "below", m, edge, m, m - 0.5 * cross, NULL));
    pen->coupon->formula = "offset of the back = (left - right)/2, (below - above)/2";
    return FW_OK;
}

static fw_status draw(fw_pen *pen) {
    double window = fw_pen_value(pen, WINDOW), side = window + 2 * RIM_M;
    FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "block of the back mark", 0, 0, side, side));
    FW_TRY(fw_pen_bar(pen, FW_ROLE_MARK, "window of the back mark", RIM_M, RIM_M, RIM_M + window,
                      RIM_M + window));
    return fw_back_cross_draw(pen, 0.5 * side, fw_pen_value(pen, CROSS), fw_pen_value(pen, ARM),
                              window);
}

const fw_pattern_kind fw_pattern_back_mark = {
    .name = "back-mark",
    .what = "cross on the back's own layer in a window of the device layer",
    .parameter = {{"window", 160e-6, 40e-6, 1e-3, false},
                  {"cross", 120e-6, 20e-6, 1e-3, false},
                  {"arm", 20e-6, 4e-6, 200e-6, false}},
    .nparameter = 3,
    .draw = draw,
};
