/* SPDX-License-Identifier: GPL-3.0-or-later */
/* window-thief and window-fill: copper inside the window of a device's own die, where <die
   fill="yes"> asks for it and the flow's table has these rows. The thief is a rim along the
   window's edges that takes the current that would crowd there; the fill are chains of squares as
   on the test die, from the lower and the upper edge inwards. Both keep out of everything that is
   drawn there. content_window.c draws them. In: width, keep-out, m; square, stem, density as of
   `fill`. Test: test_content_window.c. */
#include "layout/pattern.h"

static fw_status draw(fw_pen *pen) {
    (void)pen;
    return FW_GEOMETRY; /* it has no drawing of its own */
}

const fw_pattern_kind fw_pattern_window_thief = {
    .name = "window-thief",
    .what = "a rim in the window of a device's die that takes the crowding current",
    .parameter = {{"width", 60e-6, 10e-6, 1e-3, false}, {"keep-out", 150e-6, 20e-6, 2e-3, false}},
    .nparameter = 2,
    .draw = draw,
    .in_window = true,
};

const fw_pattern_kind fw_pattern_window_fill = {
    .name = "window-fill",
    .what = "squares in the window of a device's die, for an even load",
    .parameter = {{"square", 80e-6, 8e-6, 500e-6, false},
                  {"stem", 20e-6, 4e-6, 100e-6, false},
                  {"density", 0.5, 0.1, 0.8, true},
                  {"keep-out", 150e-6, 20e-6, 2e-3, false}},
    .nparameter = 4,
    .draw = draw,
    .in_window = true,
};
