/* SPDX-License-Identifier: GPL-3.0-or-later */
/* resolution: nests of angles whose lines and spaces have the same width, one nest per width. The
   finest nest in which lines stand and spaces are open is what the print resolves; the corners show
   how it rounds. No nest is finer than the layer's rule: a plate that breaks its own rule would not
   be sent off. In: sizes (widths), length, apart, m. Test: test_patterns.c. */
#include "layout/pattern.h"

enum { LENGTH, APART };
enum { NEST = 4 };

static fw_status draw(fw_pen *pen) {
    double length = fw_pen_value(pen, LENGTH), x = 0;
    for (int i = 0; i < pen->pattern->nsize; i++) {
        double w = pen->pattern->size_m[i], high = length + (2 * NEST - 1) * w;
        double end = x + high;
        for (int k = 0; k < NEST; k++) {
            double left = x + 2 * k * w, top = high - 2 * k * w;
            FW_TRY(fw_pen_box(pen, left, 0, left + w, top));
            FW_TRY(fw_pen_box(pen, left, top - w, end, top));
            FW_TRY(fw_pen_shape(pen, FW_ROLE_STRUCTURE, "nested angle"));
        }
        double y = 0.5 * length;
        FW_TRY(fw_pen_chord(pen, "line", x, y, x + w, y, FW_PEN_SIZE));
        FW_TRY(fw_pen_chord(pen, "space", x + w, y, x + 2 * w, y, NULL));
        x = end + fw_pen_value(pen, APART);
    }
    return FW_OK;
}

const fw_pattern_kind fw_pattern_resolution = {
    .name = "resolution",
    .what = "nested angles of rising width: finest lines and spaces that print",
    .parameter = {{"length", 50e-6, 10e-6, 500e-6, false}, {"apart", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 2,
    .sizes = "widths of lines and spaces",
    .draw = draw,
};
