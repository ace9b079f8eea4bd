/* SPDX-License-Identifier: GPL-3.0-or-later */
/* van-der-pauw: a Greek cross with four pads. A current I between two neighbouring pads and the
   voltage V between the other two give the sheet resistance
       R = (pi/ln 2) V/I,    averaged over the four turns,
   so thickness of a film of known resistivity, or the other way round. Arms as long as they are
   wide leave an error below 0.1 % (David and Buehler, Solid-State Electronics 20 (1977) 539). One
   pad stands on the bar: that terminal is the frame's potential, which a four-point measurement
   allows, and the cross is held. The layer below must not conduct beside it: measure when the seed
   between the parts is gone. In: arm (width), pad, m. Out: one shape. Test: test_patterns.c. */
#include "layout/pattern.h"

enum { ARM, PAD };

static fw_status draw(fw_pen *pen) {
    double a = fw_pen_value(pen, ARM), pad = fw_pen_value(pen, PAD);
    double arm = 1.5 * a, m = pad + arm + 0.5 * a; /* middle of the cross */
    double end = 0.5 * a + arm, into = 0.1 * pad;  /* arms run into the pads */
    if (pad < 1.2 * a) return FW_GEOMETRY;
    FW_TRY(fw_pen_box(pen, m - end - into, m - 0.5 * a, m + end + into, m + 0.5 * a));
    FW_TRY(fw_pen_box(pen, m - 0.5 * a, m - end - into, m + 0.5 * a, m + end + into));
    FW_TRY(fw_pen_box(pen, m - 0.5 * pad, 0, m + 0.5 * pad, pad));
    FW_TRY(fw_pen_box(pen, m - 0.5 * pad, m + end, m + 0.5 * pad, m + end + pad));
    FW_TRY(fw_pen_box(pen, 0, m - 0.5 * pad, pad, m + 0.5 * pad));
    FW_TRY(fw_pen_box(pen, m + end, m - 0.5 * pad, m + end + pad, m + 0.5 * pad));
    FW_TRY(fw_pen_shape(pen, FW_ROLE_STRUCTURE, "van der Pauw cross"));
    FW_TRY(fw_pen_chord(pen, "cross", m - 0.5 * a, m, m + 0.5 * a, m, NULL));
    pen->coupon->formula = "sheet resistance = (pi/ln 2) V/I";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_van_der_pauw = {
    .name = "van-der-pauw",
    .what = "Greek cross with four pads: sheet resistance",
    .parameter = {{"arm", 40e-6, 8e-6, 400e-6, false}, {"pad", 120e-6, 40e-6, 500e-6, false}},
    .nparameter = 2,
    .draw = draw,
};
