/* SPDX-License-Identifier: GPL-3.0-or-later */
/* frame-mark: window and cross of `back-mark` in both uprights of every die's frame, as far apart
   as the die is wide: two of them give offset and turn of the back. In: window, cross, arm, m.
   Test: test_patterns.c. */
#include "layout/pattern.h"

enum { WINDOW, CROSS, ARM };

static fw_status draw(fw_pen *pen) {
    double window = fw_pen_value(pen, WINDOW);
    FW_TRY(fw_pen_bar(pen, FW_ROLE_MARK, "window of the back mark", 0, 0, window, window));
    return fw_back_cross_draw(pen, 0.5 * window, fw_pen_value(pen, CROSS), fw_pen_value(pen, ARM),
                              window);
}

const fw_pattern_kind fw_pattern_frame_mark = {
    .name = "frame-mark",
    .what = "windows with a cross of the back on the frame of every die",
    .parameter = {{"window", 120e-6, 40e-6, 1e-3, false},
                  {"cross", 90e-6, 20e-6, 1e-3, false},
                  {"arm", 14e-6, 4e-6, 200e-6, false}},
    .nparameter = 3,
    .draw = draw,
    .on_frame = 2,
};
