/* SPDX-License-Identifier: GPL-3.0-or-later */
/* cd-lines: for each width five lines at their own width apart and one by itself, across x and
   across y. Line and space printed against drawn tell the print bias, dense against isolated its
   dependence on neighbours, x against y the writer's and the aligner's. In: sizes (widths), length,
   apart (isolated line and groups), m. Out: lines and spaces exact on the 1 nm grid. Test:
   test_patterns.c. */
#include "layout/pattern.h"

enum { LENGTH, APART };
enum { DENSE = 5 };
static const double POST_M = 30e-6;

/* five dense lines and an isolated one; x: upright on the bar, side by side */
static fw_status add_upright(fw_pen *pen, double w, double *x) {
    double length = fw_pen_value(pen, LENGTH), apart = fw_pen_value(pen, APART), y = 0.5 * length;
    for (int i = 0; i < DENSE; i++)
        FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "dense line", *x + 2 * i * w, 0,
                          *x + (2 * i + 1) * w, length));
    double middle = *x + (DENSE - 1) * w;
    FW_TRY(fw_pen_chord(pen, "dense line x", middle, y, middle + w, y, FW_PEN_SIZE));
    FW_TRY(fw_pen_chord(pen, "dense space x", middle + w, y, middle + 2 * w, y, NULL));
    *x += (2 * DENSE - 1) * w + apart;
    FW_TRY(fw_pen_bar(pen, FW_ROLE_STRUCTURE, "isolated line", *x, 0, *x + w, length));
    FW_TRY(fw_pen_chord(pen, "isolated line x", *x, y, *x + w, y, NULL));
    *x += w + apart;
    return FW_OK;
}

/* the same from a post, above each other */
static fw_status add_level(fw_pen *pen, double w, double *x) {
    double length = fw_pen_value(pen, LENGTH), apart = fw_pen_value(pen, APART);
    double x0 = *x, left = x0 + 0.5 * POST_M, end = x0 + POST_M + length, y = apart;
    double at = x0 + POST_M + 0.5 * length;
    for (int i = 0; i < DENSE; i++)
        FW_TRY(fw_pen_box(pen, left, y + 2 * i * w, end, y + (2 * i + 1) * w));
    double middle = y + (DENSE - 1) * w;
    FW_TRY(fw_pen_chord(pen, "dense line y", at, middle, at, middle + w, FW_PEN_SIZE));
    FW_TRY(fw_pen_chord(pen, "dense space y", at, middle + w, at, middle + 2 * w, NULL));
    y += (2 * DENSE - 1) * w + apart;
    FW_TRY(fw_pen_box(pen, left, y, end, y + w));
    FW_TRY(fw_pen_chord(pen, "isolated line y", at, y, at, y + w, NULL));
    FW_TRY(fw_pen_box(pen, x0, 0, x0 + POST_M, y + w));
    *x = end + apart;
    return fw_pen_shape(pen, FW_ROLE_STRUCTURE, "level lines");
}

static fw_status draw(fw_pen *pen) {
    double x = 0;
    for (int i = 0; i < pen->pattern->nsize; i++) {
        FW_TRY(add_upright(pen, pen->pattern->size_m[i], &x));
        FW_TRY(add_level(pen, pen->pattern->size_m[i], &x));
    }
    pen->coupon->formula = "print bias per edge = (printed - drawn)/2 of a line, "
                           "(drawn - printed)/2 of a space";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_cd_lines = {
    .name = "cd-lines",
    .what = "lines and spaces, dense and isolated, across x and y: print bias",
    .parameter = {{"length", 100e-6, 20e-6, 1e-3, false}, {"apart", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 2,
    .sizes = "widths of the lines",
    .draw = draw,
};
