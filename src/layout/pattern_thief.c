/* SPDX-License-Identifier: GPL-3.0-or-later */
/* plating-thief: a pad within a ring at the stated distance, both joined to the frame, so that the
   ring takes the current that would crowd at the pad's edges. The same pad without a ring (plating-
   pads) shows what it does. The frame is such a ring about the device. In: pad (side), distance,
   ring (width), m. Out: pad and ring; the ring's area is a figure. Test: test_patterns.c. */
#include "layout/pattern.h"

enum { PAD, DISTANCE, RING };

static fw_status draw(fw_pen *pen) {
    double pad = fw_pen_value(pen, PAD), d = fw_pen_value(pen, DISTANCE);
    double ring = fw_pen_value(pen, RING), x = ring + d, high = pad + d + ring;
    double wide = pad + 2 * (d + ring);
    FW_TRY(fw_pen_box(pen, 0, 0, ring, high));
    FW_TRY(fw_pen_box(pen, wide - ring, 0, wide, high));
    FW_TRY(fw_pen_box(pen, 0, high - ring, wide, high));
    FW_TRY(fw_pen_shape(pen, FW_ROLE_STRUCTURE, "plating thief"));
    FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "pad within a thief", x, 0, x + pad, pad));
    FW_TRY(fw_pen_chord(pen, "pad", x, 0.5 * pad, x + pad, 0.5 * pad, FW_PEN_SIZE));
    FW_TRY(fw_pen_chord(pen, "distance", ring, 0.5 * pad, x, 0.5 * pad, NULL));
    fw_pen_figure(pen, "ring area", (2 * ring * high + ring * (wide - 2 * ring)) * 1e12, "um2");
    pen->coupon->formula = "thickness of this pad against that of the pad without a ring: what "
                           "the thief evens out";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_thief = {
    .name = "plating-thief",
    .what = "pad within a ring that takes the crowding current",
    .parameter = {{"pad", 100e-6, 10e-6, 1e-3, false},
                  {"distance", 40e-6, 4e-6, 500e-6, false},
                  {"ring", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 3,
    .draw = draw,
};
