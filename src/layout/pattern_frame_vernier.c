/* SPDX-License-Identifier: GPL-3.0-or-later */
/* frame-vernier: the scales of `vernier` on the frame of every die, front against back. Parameters,
   numbers and test as there. */
#include "layout/pattern.h"

static fw_status draw(fw_pen *pen) {
    return fw_vernier_draw(pen, true);
}

const fw_pattern_kind fw_pattern_frame_vernier = {
    .name = "frame-vernier",
    .what = "pairs of scales on the frame of every die: offset of front and back",
    .parameter = {{"pitch", 16e-6, 12e-6, 100e-6, false},
                  {"step", 0.25e-6, 0.05e-6, 5e-6, false},
                  {"teeth", 11, 3, 61, true}},
    .nparameter = 3,
    .draw = draw,
    .on_frame = 1,
};
