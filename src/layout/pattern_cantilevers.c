/* SPDX-License-Identifier: GPL-3.0-or-later */
/* cantilevers: beams of rising length, free at one end. A gradient G of stress through the
   thickness curls a beam that came free to the radius E/G, so that the tip of one of length L
   stands h = G L^2/(2 E) above its root (small slopes; E/(1 - nu) for beams much wider than thick).
   In: sizes (lengths), width, space, m. Source: beam with constant initial curvature, h = L^2/(2
   R). Test: test_patterns.c. Holds where the root does: the bar must be wider than twice what the
   release reaches. */
#include "layout/pattern.h"

enum { WIDTH, SPACE };

static fw_status draw(fw_pen *pen) {
    double width = fw_pen_value(pen, WIDTH), x = 0;
    const fw_pattern *p = pen->pattern;
    for (int i = 0; i < p->nsize; i++) {
        double length = p->size_m[i], middle = x + 0.5 * width;
        FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "cantilever", x, 0, x + width, length));
        FW_TRY(fw_pen_chord(pen, "beam", middle, 0, middle, length, FW_PEN_SIZE));
        x += width + fw_pen_value(pen, SPACE);
    }
    fw_pen_figure(pen, "width", width * 1e6, "um");
    pen->coupon->formula = "height of the tip over the root: G = 2 E h/L^2";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_cantilevers = {
    .name = "cantilevers",
    .what = "beams of rising length: stress gradient from the height of their tips",
    .parameter = {{"width", 12e-6, 2e-6, 200e-6, false}, {"space", 60e-6, 4e-6, 500e-6, false}},
    .nparameter = 2,
    .sizes = "lengths of the beams",
    .draw = draw,
};
