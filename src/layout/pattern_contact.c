/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact-pad: a field of the device layer for probes, a step of the mask layer or a mean
   thickness. In: width, height, m. Out: one rectangle, area exact. Test: test_patterns.c. */
#include "layout/pattern.h"

enum { WIDTH, HEIGHT };

static fw_status draw(fw_pen *pen) {
    double w = fw_pen_value(pen, WIDTH), h = fw_pen_value(pen, HEIGHT);
    FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "contact pad", 0, 0, w, h));
    return fw_pen_chord(pen, "pad", 0, 0.5 * h, w, 0.5 * h, NULL);
}

const fw_pattern_kind fw_pattern_contact = {
    .name = "contact-pad",
    .what = "field for probes and for the thickness of a layer",
    .parameter = {{"width", 300e-6, 20e-6, 3e-3, false}, {"height", 200e-6, 20e-6, 3e-3, false}},
    .nparameter = 2,
    .draw = draw,
};
