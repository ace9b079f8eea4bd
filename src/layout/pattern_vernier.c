/* SPDX-License-Identifier: GPL-3.0-or-later */
/* vernier: two pairs of scales, for x and for y. The scale of the device layer has the pitch p,
   that of the layer to be compared p - step: tooth i of the second stands i step from tooth i of
   the first, and the pair that lines up tells the offset between the layers: i step, to step/2.
   Range: +- (teeth - 1)/2 step. The second scale is drawn as a mark of its own layer (the back), in
   the coordinates of the front. In: pitch, step, teeth (odd), m. Out: teeth exact on the 1 nm grid.
   Test: test_patterns.c. */
#include "layout/pattern.h"
#include "layout/text.h"
#include <math.h>

enum { PITCH, STEP, TEETH };
static const double TOOTH_M = 6e-6, LONG_M = 30e-6, MORE_M = 4e-6, BAR_M = 12e-6, POST_M = 24e-6;
static const double STAND_M = 20e-6;

typedef struct scale {
    double x0, y0; /* middle of the scale, on the line where the two meet */
    bool upright;  /* counts along y: teeth of the device point to the right */
    double pitch;
    int side;   /* teeth to either side of the middle one */
    bool frame; /* taken out of the frame, so without feet */
} scale;

/* a rectangle: `along` the scale, `across` towards the second scale */
static fw_status part(fw_pen *pen, const scale *s, double along0, double along1, double across0,
                      double across1) {
    if (s->upright)
        return fw_pen_box(pen, s->x0 + across0, s->y0 + along0, s->x0 + across1, s->y0 + along1);
    return fw_pen_box(pen, s->x0 + along0, s->y0 + across0, s->x0 + along1, s->y0 + across1);
}

/* teeth end at 0; to: where their bar lies, below zero for the device's scale */
static fw_status teeth(fw_pen *pen, const scale *s, double pitch, double sign) {
    for (int i = -s->side; i <= s->side; i++) {
        double at = fw_layout_to_grid(i * pitch), far = sign * (LONG_M + MORE_M + 0.5 * BAR_M);
        double near = sign * (i == 0  ? 0
                              : i % 5 ? MORE_M
                                      : 0.5 * MORE_M); /* the middle one longest */
        FW_TRY(part(pen, s, at - 0.5 * TOOTH_M, at + 0.5 * TOOTH_M, sign > 0 ? near : far,
                    sign > 0 ? far : near));
    }
    return FW_OK;
}

static fw_status first_scale(fw_pen *pen, const scale *s) {
    double half = s->side * s->pitch + 0.5 * TOOTH_M, bar = LONG_M + MORE_M;
    double foot = s->upright && !s->frame ? -s->y0 : -half;
    FW_TRY(part(pen, s, foot, half, -bar - BAR_M, -bar));
    FW_TRY(teeth(pen, s, s->pitch, -1));
    if (s->frame) return fw_pen_shape(pen, FW_ROLE_MARK, "vernier, front");
    if (!s->upright) /* a stand below the bar */
        FW_TRY(fw_pen_box(pen, s->x0 - 0.5 * POST_M, 0, s->x0 + 0.5 * POST_M,
                          s->y0 - bar - 0.5 * BAR_M));
    return fw_pen_shape(pen, FW_ROLE_STRUCTURE, "vernier, device layer");
}

static fw_status pair(fw_pen *pen, const scale *s, double step) {
    double half = s->side * s->pitch + 0.5 * TOOTH_M, bar = LONG_M + MORE_M;
    FW_TRY(first_scale(pen, s));
    double gap = fmax(pen->space_rule_m, 4e-6);
    scale other = *s;
    other.x0 += s->upright ? gap : 0;
    other.y0 += s->upright ? 0 : gap;
    FW_TRY(part(pen, &other, -half, half, bar, bar + BAR_M));
    FW_TRY(teeth(pen, &other, s->pitch - step, 1));
    return fw_pen_shape(pen, FW_ROLE_BACK, "vernier, other layer");
}

/* side by side on a bar, above each other on a frame */
fw_status fw_vernier_draw(fw_pen *pen, bool frame) {
    double pitch = fw_pen_value(pen, PITCH), step = fw_pen_value(pen, STEP);
    int count = (int)fw_pen_value(pen, TEETH), side = count / 2;
    if (count % 2 == 0 || pitch - step < 2 * TOOTH_M) return FW_GEOMETRY;
    double half = side * pitch + 0.5 * TOOTH_M, deep = LONG_M + MORE_M + BAR_M;
    scale across = {half, (frame ? 0 : STAND_M) + deep, false, pitch, side, frame};
    scale up = {2 * half + 60e-6 + deep, STAND_M + half, true, pitch, side, frame};
    if (frame) {
        up.x0 = deep;
        up.y0 = 2 * deep + 40e-6 + half;
    }
    FW_TRY(pair(pen, &across, step));
    FW_TRY(pair(pen, &up, step));
    FW_TRY(fw_pen_feature(pen, "offset x", step, (fw_vec2){across.x0, across.y0},
                          (fw_vec2){across.x0 + step, across.y0}, "X"));
    FW_TRY(fw_pen_feature(pen, "offset y", step, (fw_vec2){up.x0, up.y0},
                          (fw_vec2){up.x0, up.y0 + step}, "Y"));
    fw_pen_figure(pen, "step", step * 1e6, "um");
    fw_pen_figure(pen, "range", side * step * 1e6, "um");
    pen->coupon->formula = "offset of the second layer = number of the pair in line times step, "
                           "counted from the long teeth to the right and upwards";
    return FW_OK;
}

static fw_status draw(fw_pen *pen) {
    return fw_vernier_draw(pen, false);
}

const fw_pattern_kind fw_pattern_vernier = {
    .name = "vernier",
    .what = "pairs of scales on two layers: offset of one against the other",
    .parameter = {{"pitch", 16e-6, 12e-6, 100e-6, false},
                  {"step", 0.25e-6, 0.05e-6, 5e-6, false},
                  {"teeth", 17, 3, 61, true}},
    .nparameter = 3,
    .draw = draw,
};
