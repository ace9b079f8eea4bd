/* SPDX-License-Identifier: GPL-3.0-or-later */
/* arde-slots: trenches of rising width between walls of the same width, open at one end. Depth d_i
   of a slot of width w_i after the time t follows from the transport of the etchant into it,
   dd/dt = R0/(1 + S (1/K(d/w) - 1)); two widths give rate and lag without a fit:
       S = (d2 - d1)/(J1 - J2),   R0 = (d1 + S J1)/t,   J_i = integral of (1/K - 1) over the depth
   (knowledge and test of K: process/law_arde.c). To be measured before the etch goes through.
   In: sizes, wall, length, m. Out: one slot per size, width exact on the 1 nm grid.
   Validity: length at least five widths, else the open end counts. Test: test_patterns.c. */
#include "layout/pattern.h"

enum { WALL, LENGTH };

static fw_status draw(fw_pen *pen) {
    double wall = fw_pen_value(pen, WALL), length = fw_pen_value(pen, LENGTH), x = 0;
    const fw_pattern *p = pen->pattern;
    for (int i = 0; i <= p->nsize; i++) {
        FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "wall of a slot", x, 0, x + wall, length));
        x += wall;
        if (i == p->nsize) break;
        double w = p->size_m[i], y = 0.4 * length;
        FW_TRY(fw_pen_chord(pen, "slot", x, y, x + w, y, FW_PEN_SIZE));
        x += w;
    }
    fw_pen_figure(pen, "length", length * 1e6, "um");
    pen->coupon->formula = "depths d1, d2 of two widths after time t: S = (d2 - d1)/(J1 - J2), "
                           "R0 = (d1 + S J1)/t";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_slots = {
    .name = "arde-slots",
    .what = "slots of rising width: rate of an etch and how it lags in narrow openings",
    .parameter = {{"wall", 90e-6, 5e-6, 1e-3, false}, {"length", 300e-6, 20e-6, 2e-3, false}},
    .nparameter = 2,
    .sizes = "widths of the slots",
    .draw = draw,
};
