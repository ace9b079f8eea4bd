/* SPDX-License-Identifier: GPL-3.0-or-later */
/* plating-pads: pads of rising width with bare field between, so that a profilometer finds its zero
   beside each. Thickness d over width tells how the current crowds; their mean over the plated area
   gives the efficiency: eta = d rho z F/(M J t). In: sizes (widths), height, space, m. Out: pads,
   areas exact. The pads' total area is a figure. Test: test_patterns.c. */
#include "layout/pattern.h"

enum { HEIGHT, SPACE };

static fw_status draw(fw_pen *pen) {
    double height = fw_pen_value(pen, HEIGHT), x = 0, area = 0;
    const fw_pattern *p = pen->pattern;
    for (int i = 0; i < p->nsize; i++) {
        double w = p->size_m[i], y = 0.5 * height;
        FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "plating pad", x, 0, x + w, height));
        FW_TRY(fw_pen_chord(pen, "pad", x, y, x + w, y, FW_PEN_SIZE));
        area += w * height;
        x += w + fw_pen_value(pen, SPACE);
    }
    fw_pen_figure(pen, "height", height * 1e6, "um");
    fw_pen_figure(pen, "area", area * 1e12, "um2");
    pen->coupon->formula = "thickness d: efficiency = d rho z F/(M J t); d over width: crowding";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_pads = {
    .name = "plating-pads",
    .what = "pads of rising width: thickness and its spread",
    .parameter = {{"height", 150e-6, 20e-6, 2e-3, false}, {"space", 100e-6, 5e-6, 1e-3, false}},
    .nparameter = 2,
    .sizes = "widths of the pads",
    .draw = draw,
};
