/* SPDX-License-Identifier: GPL-3.0-or-later */
/* stress-pointer: two arms pull at a pointer from opposite sides, their lines the offset O apart. A
   film that wants to shrink by the strain e (stress E e before the release, tension positive) turns
   the pointer. Rigid pointer, arms of length L and width w clamped at both ends, centre at rest by
   symmetry: arm shortens by theta O/2 and pulls with P = E A (e - theta O/(2 L)); its end on the
   pointer turns by theta and, as the pointer shrinks too, moves across by e O/2, which takes
   4 E I theta/L + 3 E I e O/L^2; balance of the pointer, P O = twice that, with I/A = w^2/12:
       theta/e = (2 L/O) (1 - w^2/(2 L^2))/(1 + (4/3) (w/O)^2)
   and the tip, R from the centre, moves by R theta: the amplification is R theta/e.
   In: lengths, m. Out: 1. Error: the arms' own length about w/L, and the give of the pointer: below
   8 % as drawn. Cost O(1). Own derivation; layout after van Drieenhuizen, Goosen, French,
   Wolffenbuttel, Sensors and Actuators A 37-38 (1993) 756. Test: test_patterns.c (frame of beams,
   direct stiffness).

   The tip carries a scale of pitch p, the frame beside it one of pitch p + step: the pair of teeth
   that line up tells the movement in steps. Read while the posts still hold to the wafer: the
   release must not reach half a post. */
#include "layout/pattern.h"
#include "layout/text.h"
#include <math.h>

enum { ARM, OFFSET, WIDTH, POINTER, STEP };

double fw_pointer_turn_per_strain(double arm_m, double offset_m, double width_m) {
    double q = width_m / offset_m, r = width_m / arm_m;
    return 2 * arm_m / offset_m * (1 - 0.5 * r * r) / (1 + 4.0 / 3.0 * q * q);
}

static const double POST_M = 160e-6, LOW_M = 80e-6;
static const double TOOTH_M = 6e-6, PITCH_M = 14e-6, LONG_M = 20e-6, BAR_M = 16e-6;
enum { EACH_SIDE = 5 };

/* teeth at i * pitch from the middle, from y0 to y1 */
static fw_status add_teeth(fw_pen *pen, double x, double pitch, double y0, double y1) {
    for (int i = -EACH_SIDE; i <= EACH_SIDE; i++) {
        double at = fw_layout_to_grid(x + i * pitch);
        FW_TRY(fw_pen_box(pen, at - 0.5 * TOOTH_M, y0, at + 0.5 * TOOTH_M, y1));
    }
    return FW_OK;
}

static fw_status draw(fw_pen *pen) {
    double arm = fw_pen_value(pen, ARM), offset = fw_pen_value(pen, OFFSET);
    double w = fw_pen_value(pen, WIDTH), pointer = fw_pen_value(pen, POINTER);
    double step = fw_pen_value(pen, STEP), bias = fmax(pen->bias_m, 0);
    double gap = fmax(8e-6, 2 * pen->space_rule_m) + 2 * bias;
    double pitch = fw_layout_to_grid(PITCH_M + 2 * bias); /* teeth stay apart with the bias */
    double thick = fmax(2 * w, 16e-6), x = POST_M + arm + 0.5 * thick, y = LOW_M + 0.5 * offset;
    double half = EACH_SIDE * pitch + 0.5 * TOOTH_M + 4e-6, tip = y + pointer;
    double scale = tip + gap; /* where the teeth of the frame end */
    double right = x + 0.5 * thick + arm, top = scale + LONG_M + BAR_M, reach = EACH_SIDE * step;
    if (offset < w + 8e-6 || half + reach > arm - 20e-6) return FW_GEOMETRY;
    /* post, arm, pointer with its scale, arm, post with the other scale: one shape */
    FW_TRY(fw_pen_box(pen, 0, 0, POST_M, y + 0.5 * offset + 0.5 * w + 20e-6));
    FW_TRY(
        fw_pen_box(pen, POST_M - 10e-6, y + 0.5 * offset - 0.5 * w, x, y + 0.5 * offset + 0.5 * w));
    FW_TRY(fw_pen_box(pen, x - 0.5 * thick, y - 0.5 * offset - 0.5 * w, x + 0.5 * thick,
                      tip - LONG_M - 0.5 * BAR_M));
    FW_TRY(
        fw_pen_box(pen, x, y - 0.5 * offset - 0.5 * w, right + 10e-6, y - 0.5 * offset + 0.5 * w));
    FW_TRY(fw_pen_box(pen, x - half, tip - LONG_M - BAR_M, x + half, tip - LONG_M));
    FW_TRY(add_teeth(pen, x, pitch, tip - LONG_M - 0.5 * BAR_M, tip));
    FW_TRY(fw_pen_box(pen, right, 0, right + POST_M, top));
    FW_TRY(fw_pen_box(pen, x - half - reach, scale + LONG_M, right + 0.5 * POST_M, top));
    FW_TRY(add_teeth(pen, x, pitch + step, scale, scale + LONG_M + 0.5 * BAR_M));
    FW_TRY(fw_pen_box(pen, x - 8e-6, top - 0.5 * BAR_M, x + 8e-6, top + 12e-6)); /* the middle */
    FW_TRY(fw_pen_shape(pen, FW_ROLE_STRUCTURE, "stress pointer"));
    double turn = fw_pointer_turn_per_strain(arm, offset, w + 2 * pen->bias_m);
    FW_TRY(fw_pen_chord(pen, "tip", x, y, x, tip, NULL));
    fw_pen_figure(pen, "turn per strain", turn, "1");
    fw_pen_figure(pen, "amplification", turn * pointer, "m");
    fw_pen_figure(pen, "step", step * 1e6, "um");
    fw_pen_figure(pen, "strain per step", step / (turn * pointer), "1");
    pen->coupon->formula = "strain = movement of the tip/amplification; stress = E strain, tension "
                           "where the tip moves to the left";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_pointer = {
    .name = "stress-pointer",
    .what = "rotating pointer with a vernier: mean stress of the film",
    .parameter = {{"arm", 250e-6, 60e-6, 2e-3, false},
                  {"offset", 24e-6, 10e-6, 200e-6, false},
                  {"width", 8e-6, 4e-6, 50e-6, false},
                  {"pointer", 220e-6, 60e-6, 2e-3, false},
                  {"step", 0.5e-6, 0.1e-6, 2e-6, false}},
    .nparameter = 5,
    .draw = draw,
};
