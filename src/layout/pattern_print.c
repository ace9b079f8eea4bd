/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test patterns of printing, alignment, plating, films and load. Each with what it tells, and its row; patterns.def
   lists them. */
#include "layout/layout.h"
#include "layout/pattern.h"
#include <math.h>

/* ---- cd-lines ---- */

/* cd-lines: for each width five lines at their own width apart and one by itself, across x and
   across y. Line and space printed against drawn tell the print bias, dense against isolated its
   dependence on neighbours, x against y the writer's and the aligner's. In: sizes (widths), length,
   apart (isolated line and groups), m. Out: lines and spaces exact on the 1 nm grid. Test:
   test_patterns.c. */

enum { CD_LINES_LENGTH, CD_LINES_APART };
enum { DENSE = 5 };
static const double CD_LINES_POST_M = 30e-6;

/* five dense lines and an isolated one; x: upright on the bar, side by side */
static fw_status add_upright(fw_layout_pen *pen, double w, double *x) {
    double length = fw_layout_pen_value(pen, CD_LINES_LENGTH),
           apart = fw_layout_pen_value(pen, CD_LINES_APART), y = 0.5 * length;
    for (int i = 0; i < DENSE; i++)
        FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "dense line", *x + 2 * i * w, 0,
                                 *x + (2 * i + 1) * w, length));
    double middle = *x + (DENSE - 1) * w;
    FW_TRY(fw_layout_pen_chord(pen, "dense line x", middle, y, middle + w, y, FW_PEN_SIZE));
    FW_TRY(fw_layout_pen_chord(pen, "dense space x", middle + w, y, middle + 2 * w, y, NULL));
    *x += (2 * DENSE - 1) * w + apart;
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "isolated line", *x, 0, *x + w, length));
    FW_TRY(fw_layout_pen_chord(pen, "isolated line x", *x, y, *x + w, y, NULL));
    *x += w + apart;
    return FW_OK;
}

/* the same from a post, above each other */
static fw_status add_level(fw_layout_pen *pen, double w, double *x) {
    double length = fw_layout_pen_value(pen, CD_LINES_LENGTH),
           apart = fw_layout_pen_value(pen, CD_LINES_APART);
    double x0 = *x, left = x0 + 0.5 * CD_LINES_POST_M, end = x0 + CD_LINES_POST_M + length,
           y = apart;
    double at = x0 + CD_LINES_POST_M + 0.5 * length;
    for (int i = 0; i < DENSE; i++)
        FW_TRY(fw_layout_pen_box(pen, left, y + 2 * i * w, end, y + (2 * i + 1) * w));
    double middle = y + (DENSE - 1) * w;
    FW_TRY(fw_layout_pen_chord(pen, "dense line y", at, middle, at, middle + w, FW_PEN_SIZE));
    FW_TRY(fw_layout_pen_chord(pen, "dense space y", at, middle + w, at, middle + 2 * w, NULL));
    y += (2 * DENSE - 1) * w + apart;
    FW_TRY(fw_layout_pen_box(pen, left, y, end, y + w));
    FW_TRY(fw_layout_pen_chord(pen, "isolated line y", at, y, at, y + w, NULL));
    FW_TRY(fw_layout_pen_box(pen, x0, 0, x0 + CD_LINES_POST_M, y + w));
    *x = end + apart;
    return fw_layout_pen_shape(pen, FW_ROLE_STRUCTURE, "level lines");
}

static fw_status draw_cd_lines(fw_layout_pen *pen) {
    double x = 0;
    for (int i = 0; i < pen->pattern->nsize; i++) {
        FW_TRY(add_upright(pen, pen->pattern->size_m[i], &x));
        FW_TRY(add_level(pen, pen->pattern->size_m[i], &x));
    }
    pen->coupon->formula = "print bias per edge = (printed - drawn)/2 of a line, "
                           "(drawn - printed)/2 of a space";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_cd_lines = {
    .name = "cd-lines",
    .what = "lines and spaces, dense and isolated, across x and y: print bias",
    .parameter = {{"length", 100e-6, 20e-6, 1e-3, false}, {"apart", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 2,
    .sizes = "widths of the lines",
    .draw = draw_cd_lines,
};

/* ---- resolution ---- */

/* resolution: nests of angles whose lines and spaces have the same width, one nest per width. The
   finest nest in which lines stand and spaces are open is what the print resolves; the corners show
   how it rounds. No nest is finer than the layer's rule: a plate that breaks its own rule would not
   be sent off. In: sizes (widths), length, apart, m. Test: test_patterns.c. */

enum { RESOLUTION_LENGTH, RESOLUTION_APART };
enum { NEST = 4 };

static fw_status draw_resolution(fw_layout_pen *pen) {
    double length = fw_layout_pen_value(pen, RESOLUTION_LENGTH), x = 0;
    for (int i = 0; i < pen->pattern->nsize; i++) {
        double w = pen->pattern->size_m[i], high = length + (2 * NEST - 1) * w;
        double end = x + high;
        for (int k = 0; k < NEST; k++) {
            double left = x + 2 * k * w, top = high - 2 * k * w;
            FW_TRY(fw_layout_pen_box(pen, left, 0, left + w, top));
            FW_TRY(fw_layout_pen_box(pen, left, top - w, end, top));
            FW_TRY(fw_layout_pen_shape(pen, FW_ROLE_STRUCTURE, "nested angle"));
        }
        double y = 0.5 * length;
        FW_TRY(fw_layout_pen_chord(pen, "line", x, y, x + w, y, FW_PEN_SIZE));
        FW_TRY(fw_layout_pen_chord(pen, "space", x + w, y, x + 2 * w, y, NULL));
        x = end + fw_layout_pen_value(pen, RESOLUTION_APART);
    }
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_resolution = {
    .name = "resolution",
    .what = "nested angles of rising width: finest lines and spaces that print",
    .parameter = {{"length", 50e-6, 10e-6, 500e-6, false}, {"apart", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 2,
    .sizes = "widths of lines and spaces",
    .draw = draw_resolution,
};

/* ---- vernier ---- */

/* vernier: two pairs of scales, for x and for y. The scale of the device layer has the pitch p,
   that of the layer to be compared p - step: tooth i of the second stands i step from tooth i of
   the first, and the pair that lines up tells the offset between the layers: i step, to step/2.
   Range: +- (teeth - 1)/2 step. The second scale is drawn as a mark of its own layer (the back), in
   the coordinates of the front. In: pitch, step, teeth (odd), m. Out: teeth exact on the 1 nm grid.
   Test: test_patterns.c. */

enum { PITCH, STEP, TEETH };
static const double TOOTH_M = 6e-6, LONG_M = 30e-6, MORE_M = 4e-6, BAR_M = 12e-6,
                    VERNIER_POST_M = 24e-6;
static const double STAND_M = 20e-6;

typedef struct scale {
    double x0, y0; /* middle of the scale, on the line where the two meet */
    bool upright;  /* counts along y: teeth of the device point to the right */
    double pitch;
    int side;   /* teeth to either side of the middle one */
    bool frame; /* taken out of the frame, so without feet */
} scale;

/* a rectangle: `along` the scale, `across` towards the second scale */
static fw_status part(fw_layout_pen *pen, const scale *s, double along0, double along1,
                      double across0, double across1) {
    if (s->upright)
        return fw_layout_pen_box(pen, s->x0 + across0, s->y0 + along0, s->x0 + across1,
                                 s->y0 + along1);
    return fw_layout_pen_box(pen, s->x0 + along0, s->y0 + across0, s->x0 + along1, s->y0 + across1);
}

/* teeth end at 0; to: where their bar lies, below zero for the device's scale */
static fw_status teeth(fw_layout_pen *pen, const scale *s, double pitch, double sign) {
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

static fw_status first_scale(fw_layout_pen *pen, const scale *s) {
    double half = s->side * s->pitch + 0.5 * TOOTH_M, bar = LONG_M + MORE_M;
    double foot = s->upright && !s->frame ? -s->y0 : -half;
    FW_TRY(part(pen, s, foot, half, -bar - BAR_M, -bar));
    FW_TRY(teeth(pen, s, s->pitch, -1));
    if (s->frame) return fw_layout_pen_shape(pen, FW_ROLE_MARK, "vernier, front");
    if (!s->upright) /* a stand below the bar */
        FW_TRY(fw_layout_pen_box(pen, s->x0 - 0.5 * VERNIER_POST_M, 0, s->x0 + 0.5 * VERNIER_POST_M,
                                 s->y0 - bar - 0.5 * BAR_M));
    return fw_layout_pen_shape(pen, FW_ROLE_STRUCTURE, "vernier, device layer");
}

static fw_status pair(fw_layout_pen *pen, const scale *s, double step) {
    double half = s->side * s->pitch + 0.5 * TOOTH_M, bar = LONG_M + MORE_M;
    FW_TRY(first_scale(pen, s));
    double gap = fmax(pen->space_rule_m, 4e-6);
    scale other = *s;
    other.x0 += s->upright ? gap : 0;
    other.y0 += s->upright ? 0 : gap;
    FW_TRY(part(pen, &other, -half, half, bar, bar + BAR_M));
    FW_TRY(teeth(pen, &other, s->pitch - step, 1));
    return fw_layout_pen_shape(pen, FW_ROLE_BACK, "vernier, other layer");
}

/* side by side on a bar, above each other on a frame */
static fw_status vernier_draw(fw_layout_pen *pen, bool frame) {
    double pitch = fw_layout_pen_value(pen, PITCH), step = fw_layout_pen_value(pen, STEP);
    int count = (int)fw_layout_pen_value(pen, TEETH), side = count / 2;
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
    FW_TRY(fw_layout_pen_feature(pen, "offset x", step, (fw_geometry_vec2){across.x0, across.y0},
                                 (fw_geometry_vec2){across.x0 + step, across.y0}, "X"));
    FW_TRY(fw_layout_pen_feature(pen, "offset y", step, (fw_geometry_vec2){up.x0, up.y0},
                                 (fw_geometry_vec2){up.x0, up.y0 + step}, "Y"));
    fw_layout_pen_figure(pen, "step", step * 1e6, "um");
    fw_layout_pen_figure(pen, "range", side * step * 1e6, "um");
    pen->coupon->formula = "offset of the second layer = number of the pair in line times step, "
                           "counted from the long teeth to the right and upwards";
    return FW_OK;
}

static fw_status draw_vernier(fw_layout_pen *pen) {
    return vernier_draw(pen, false);
}

const fw_layout_pattern_kind fw_layout_pattern_vernier = {
    .name = "vernier",
    .aligns = true,
    .what = "pairs of scales on two layers: offset of one against the other",
    .parameter = {{"pitch", 16e-6, 12e-6, 100e-6, false},
                  {"step", 0.25e-6, 0.05e-6, 5e-6, false},
                  {"teeth", 17, 3, 61, true}},
    .nparameter = 3,
    .draw = draw_vernier,
};

/* ---- back-mark ---- */

/* back-mark: a window in a block of the device layer and, in its middle, the cross of the back
   side's own plate. Both are drawn as seen from the front; the plate for the back is the mirror
   image, which its order says. Centred in the window the sides agree; the distances from the arms
   to the window's edges tell the offset: (left - right)/2, (below - above)/2. Bars of metal beside
   the window tell that of the pads' plate alike. In: window, cross (size over all), arm (width), ring
   (width of these bars; 0: none), m. Out: areas exact. Test: test_patterns.c. */

enum { BACK_MARK_WINDOW, BACK_MARK_CROSS, BACK_MARK_ARM, BACK_MARK_RING };
static const double RIM_M = 40e-6, RING_CLEAR_M = 10e-6;

static fw_status back_cross_draw(fw_layout_pen *pen, double m, double cross, double arm,
                                 double window) {
    if (cross > window - 2 * pen->space_rule_m || arm > 0.5 * cross) return FW_GEOMETRY;
    FW_TRY(fw_layout_pen_box(pen, m - 0.5 * cross, m - 0.5 * arm, m + 0.5 * cross, m + 0.5 * arm));
    FW_TRY(fw_layout_pen_box(pen, m - 0.5 * arm, m - 0.5 * cross, m + 0.5 * arm, m + 0.5 * cross));
    FW_TRY(fw_layout_pen_shape(pen, FW_ROLE_BACK, "back side cross"));
    double edge = m - 0.5 * window;
    FW_TRY(fw_layout_pen_chord(pen, "left", edge, m, m - 0.5 * cross, m, NULL));
    FW_TRY(fw_layout_pen_chord(pen, "below", m, edge, m, m - 0.5 * cross, NULL));
    pen->coupon->formula = "offset of the back = (left - right)/2, (below - above)/2";
    return FW_OK;
}

/* a bar of metal beside each side of the window, below what the device's plate leaves of the block */
static fw_status draw_ring(fw_layout_pen *pen, double from, double to, double width) {
    static const char label[] = "metal beside the back mark";
    double a = from - RING_CLEAR_M, b = to + RING_CLEAR_M, middle = 0.5 * (from + to);
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_METAL, label, from, a - width, to, a));
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_METAL, label, from, b, to, b + width));
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_METAL, label, a - width, from, a, to));
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_METAL, label, b, from, b + width, to));
    FW_TRY(fw_layout_pen_chord(pen, "metal left", a, middle, from, middle, NULL));
    return fw_layout_pen_chord(pen, "metal below", middle, a, middle, from, NULL);
}

static fw_status draw_back_mark(fw_layout_pen *pen) {
    double window = fw_layout_pen_value(pen, BACK_MARK_WINDOW), side = window + 2 * RIM_M;
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "block of the back mark", 0, 0, side, side));
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_MARK, "window of the back mark", RIM_M, RIM_M,
                             RIM_M + window, RIM_M + window));
    double ring = fw_layout_pen_value(pen, BACK_MARK_RING);
    if (ring > RIM_M - 2 * RING_CLEAR_M + 1e-12) return FW_GEOMETRY;
    if (ring > 0) FW_TRY(draw_ring(pen, RIM_M, RIM_M + window, ring));
    return back_cross_draw(pen, 0.5 * side, fw_layout_pen_value(pen, BACK_MARK_CROSS),
                           fw_layout_pen_value(pen, BACK_MARK_ARM), window);
}

const fw_layout_pattern_kind fw_layout_pattern_back_mark = {
    .name = "back-mark",
    .aligns = true,
    .what = "cross on the back's own layer in a window of the device layer",
    .parameter = {{"window", 160e-6, 40e-6, 1e-3, false},
                  {"cross", 120e-6, 20e-6, 1e-3, false},
                  {"arm", 20e-6, 4e-6, 200e-6, false},
                  {"ring", 0, 0, 20e-6, false}},
    .nparameter = 4,
    .draw = draw_back_mark,
};

/* ---- frame-mark ---- */

/* frame-mark: window and cross of `back-mark` in both uprights of every die's frame, as far apart
   as the die is wide: two of them give offset and turn of the back. In: window, cross, arm, ring, m.
   Test: test_patterns.c. */

enum { FRAME_MARK_WINDOW, FRAME_MARK_CROSS, FRAME_MARK_ARM, FRAME_MARK_RING };

static fw_status draw_frame_mark(fw_layout_pen *pen) {
    double window = fw_layout_pen_value(pen, FRAME_MARK_WINDOW),
           ring = fw_layout_pen_value(pen, FRAME_MARK_RING);
    double from = ring > 0 ? RING_CLEAR_M + ring : 0, to = from + window;
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_MARK, "window of the back mark", from, from, to, to));
    if (ring > 0) FW_TRY(draw_ring(pen, from, to, ring));
    return back_cross_draw(pen, from + 0.5 * window, fw_layout_pen_value(pen, FRAME_MARK_CROSS),
                           fw_layout_pen_value(pen, FRAME_MARK_ARM), window);
}

const fw_layout_pattern_kind fw_layout_pattern_frame_mark = {
    .name = "frame-mark",
    .aligns = true,
    .what = "windows with a cross of the back on the frame of every die",
    .parameter = {{"window", 120e-6, 40e-6, 1e-3, false},
                  {"cross", 90e-6, 20e-6, 1e-3, false},
                  {"arm", 14e-6, 4e-6, 200e-6, false},
                  {"ring", 0, 0, 50e-6, false}},
    .nparameter = 4,
    .draw = draw_frame_mark,
    .on_frame = 2,
};

/* ---- frame-vernier ---- */

/* frame-vernier: the scales of `vernier` on the frame of every die, front against back. Parameters,
   numbers and test as there. */

static fw_status draw_frame_vernier(fw_layout_pen *pen) {
    return vernier_draw(pen, true);
}

const fw_layout_pattern_kind fw_layout_pattern_frame_vernier = {
    .name = "frame-vernier",
    .aligns = true,
    .what = "pairs of scales on the frame of every die: offset of front and back",
    .parameter = {{"pitch", 16e-6, 12e-6, 100e-6, false},
                  {"step", 0.25e-6, 0.05e-6, 5e-6, false},
                  {"teeth", 11, 3, 61, true}},
    .nparameter = 3,
    .draw = draw_frame_vernier,
    .on_frame = 1,
};

/* ---- pads ---- */

/* plating-pads: pads of rising width with bare field between, so that a profilometer finds its zero
   beside each. Thickness d over width tells how the current crowds; their mean over the plated area
   gives the efficiency: eta = d rho z F/(M J t). In: sizes (widths), height, space, m. Out: pads,
   areas exact. The pads' total area is a figure. Test: test_patterns.c. */

enum { PADS_HEIGHT, SPACE };

static fw_status draw_pads(fw_layout_pen *pen) {
    double height = fw_layout_pen_value(pen, PADS_HEIGHT), x = 0, area = 0;
    const fw_layout_pattern *p = pen->pattern;
    for (int i = 0; i < p->nsize; i++) {
        double w = p->size_m[i], y = 0.5 * height;
        FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "plating pad", x, 0, x + w, height));
        FW_TRY(fw_layout_pen_chord(pen, "pad", x, y, x + w, y, FW_PEN_SIZE));
        area += w * height;
        x += w + fw_layout_pen_value(pen, SPACE);
    }
    fw_layout_pen_figure(pen, "height", height * 1e6, "um");
    fw_layout_pen_figure(pen, "area", area * 1e12, "um2");
    pen->coupon->formula = "thickness d: efficiency = d rho z F/(M J t); d over width: crowding";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_pads = {
    .name = "plating-pads",
    .what = "pads of rising width: thickness and its spread",
    .parameter = {{"height", 150e-6, 20e-6, 2e-3, false}, {"space", 100e-6, 5e-6, 1e-3, false}},
    .nparameter = 2,
    .sizes = "widths of the pads",
    .draw = draw_pads,
};

/* ---- thief ---- */

/* plating-thief: a pad within a ring at the stated distance, both joined to the frame, so that the
   ring takes the current that would crowd at the pad's edges. The same pad without a ring (plating-
   pads) shows what it does. The frame is such a ring about the device. In: pad (side), distance,
   ring (width), m. Out: pad and ring; the ring's area is a figure. Test: test_patterns.c. */

enum { THIEF_PAD, DISTANCE, RING };

static fw_status draw_thief(fw_layout_pen *pen) {
    double pad = fw_layout_pen_value(pen, THIEF_PAD), d = fw_layout_pen_value(pen, DISTANCE);
    double ring = fw_layout_pen_value(pen, RING), x = ring + d, high = pad + d + ring;
    double wide = pad + 2 * (d + ring);
    FW_TRY(fw_layout_pen_box(pen, 0, 0, ring, high));
    FW_TRY(fw_layout_pen_box(pen, wide - ring, 0, wide, high));
    FW_TRY(fw_layout_pen_box(pen, 0, high - ring, wide, high));
    FW_TRY(fw_layout_pen_shape(pen, FW_ROLE_STRUCTURE, "plating thief"));
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "pad within a thief", x, 0, x + pad, pad));
    FW_TRY(fw_layout_pen_chord(pen, "pad", x, 0.5 * pad, x + pad, 0.5 * pad, FW_PEN_SIZE));
    FW_TRY(fw_layout_pen_chord(pen, "distance", ring, 0.5 * pad, x, 0.5 * pad, NULL));
    fw_layout_pen_figure(pen, "ring area", (2 * ring * high + ring * (wide - 2 * ring)) * 1e12,
                         "um2");
    pen->coupon->formula = "thickness of this pad against that of the pad without a ring: what "
                           "the thief evens out";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_thief = {
    .name = "plating-thief",
    .what = "pad within a ring that takes the crowding current",
    .parameter = {{"pad", 100e-6, 10e-6, 1e-3, false},
                  {"distance", 40e-6, 4e-6, 500e-6, false},
                  {"ring", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 3,
    .draw = draw_thief,
};

/* ---- contact ---- */

/* contact-pad: a field of the device layer for probes, a step of the mask layer or a mean
   thickness. In: width, height, m. Out: one rectangle, area exact. Test: test_patterns.c. */

enum { WIDTH, CONTACT_HEIGHT };

static fw_status draw_contact(fw_layout_pen *pen) {
    double w = fw_layout_pen_value(pen, WIDTH), h = fw_layout_pen_value(pen, CONTACT_HEIGHT);
    FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "contact pad", 0, 0, w, h));
    return fw_layout_pen_chord(pen, "pad", 0, 0.5 * h, w, 0.5 * h, NULL);
}

const fw_layout_pattern_kind fw_layout_pattern_contact = {
    .name = "contact-pad",
    .what = "field for probes and for the thickness of a layer",
    .parameter = {{"width", 300e-6, 20e-6, 3e-3, false}, {"height", 200e-6, 20e-6, 3e-3, false}},
    .nparameter = 2,
    .draw = draw_contact,
};

/* ---- van-der-pauw ---- */

/* van-der-pauw: a Greek cross with four pads. A current I between two neighbouring pads and the
   voltage V between the other two give the sheet resistance
       R = (pi/ln 2) V/I,    averaged over the four turns,
   so thickness of a film of known resistivity, or the other way round. Arms as long as they are
   wide leave an error below 0.1 % (David and Buehler, Solid-State Electronics 20 (1977) 539). One
   pad stands on the bar: that terminal is the frame's potential, which a four-point measurement
   allows, and the cross is held. The layer below must not conduct beside it: measure when the seed
   between the parts is gone. In: arm (width), pad, m. Out: one shape. Test: test_patterns.c. */

enum { ARM, VAN_DER_PAUW_PAD };

static fw_status draw_van_der_pauw(fw_layout_pen *pen) {
    double a = fw_layout_pen_value(pen, ARM), pad = fw_layout_pen_value(pen, VAN_DER_PAUW_PAD);
    double arm = 1.5 * a, m = pad + arm + 0.5 * a; /* middle of the cross */
    double end = 0.5 * a + arm, into = 0.1 * pad;  /* arms run into the pads */
    if (pad < 1.2 * a) return FW_GEOMETRY;
    FW_TRY(fw_layout_pen_box(pen, m - end - into, m - 0.5 * a, m + end + into, m + 0.5 * a));
    FW_TRY(fw_layout_pen_box(pen, m - 0.5 * a, m - end - into, m + 0.5 * a, m + end + into));
    FW_TRY(fw_layout_pen_box(pen, m - 0.5 * pad, 0, m + 0.5 * pad, pad));
    FW_TRY(fw_layout_pen_box(pen, m - 0.5 * pad, m + end, m + 0.5 * pad, m + end + pad));
    FW_TRY(fw_layout_pen_box(pen, 0, m - 0.5 * pad, pad, m + 0.5 * pad));
    FW_TRY(fw_layout_pen_box(pen, m + end, m - 0.5 * pad, m + end + pad, m + 0.5 * pad));
    FW_TRY(fw_layout_pen_shape(pen, FW_ROLE_STRUCTURE, "van der Pauw cross"));
    FW_TRY(fw_layout_pen_chord(pen, "cross", m - 0.5 * a, m, m + 0.5 * a, m, NULL));
    pen->coupon->formula = "sheet resistance = (pi/ln 2) V/I";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_van_der_pauw = {
    .name = "van-der-pauw",
    .what = "Greek cross with four pads: sheet resistance",
    .parameter = {{"arm", 40e-6, 8e-6, 400e-6, false}, {"pad", 120e-6, 40e-6, 500e-6, false}},
    .nparameter = 2,
    .draw = draw_van_der_pauw,
};

/* ---- fill ---- */

/* fill: squares with the stated share of covered area, so that etch and plating see much the same
   load everywhere. The squares stand above each other in chains on the bar, joined by stems, so
   that none comes loose. With squares of side s, stems of width n and the gap g the share is
       density = (s^2 + n g)/(s + g)^2,
       g = (n - 2 D s + sqrt((n - 2 D s)^2 + 4 D (1 - D) s^2))/(2 D)
   layout_content.c draws it where the other patterns leave room, at the keep-out from all of
   them. In: square, stem, keep-out, m; density, 1 (0.1 to 0.8). Test: test_patterns.c. */

double fw_layout_fill_gap_m(double square_m, double stem_m, double density) {
    double s = square_m, b = stem_m - 2 * density * s;
    double root = b * b + 4 * density * (1 - density) * s * s;
    return density > 0 && density < 1 ? (b + sqrt(root)) / (2 * density) : (double)NAN;
}

/* has no drawing of its own: it takes the rest of a row */
static fw_status draw_fill(fw_layout_pen *pen) {
    (void)pen;
    return FW_GEOMETRY;
}

const fw_layout_pattern_kind fw_layout_pattern_fill = {
    .name = "fill",
    .what = "squares where nothing else is, for an even load",
    .parameter = {{"square", 40e-6, 8e-6, 500e-6, false},
                  {"stem", 10e-6, 4e-6, 100e-6, false},
                  {"density", 0.5, 0.1, 0.8, true},
                  {"keep-out", 60e-6, 8e-6, 500e-6, false}},
    .nparameter = 4,
    .draw = draw_fill,
    .fills = true,
};

/* ---- window ---- */

/* window-thief and window-fill: copper inside the window of a device's own die, where <die
   fill="yes"> asks for it and the flow's table has these rows. The thief is a rim along the
   window's edges that takes the current that would crowd there; the fill are chains of squares as
   on the test die, from the lower and the upper edge inwards. Both keep out of everything that is
   drawn there. content_frame.c draws them. In: width, keep-out, m; square, stem, density as of
   `fill`. Test: test_content_window.c. */

static fw_status draw_window(fw_layout_pen *pen) {
    (void)pen;
    return FW_GEOMETRY; /* it has no drawing of its own */
}

const fw_layout_pattern_kind fw_layout_pattern_window_thief = {
    .name = "window-thief",
    .what = "a rim in the window of a device's die that takes the crowding current",
    .parameter = {{"width", 60e-6, 10e-6, 1e-3, false}, {"keep-out", 150e-6, 20e-6, 2e-3, false}},
    .nparameter = 2,
    .draw = draw_window,
    .in_window = FW_GROWS_ALONG_EDGES,
};

const fw_layout_pattern_kind fw_layout_pattern_window_fill = {
    .name = "window-fill",
    .what = "squares in the window of a device's die, for an even load",
    .parameter = {{"square", 80e-6, 8e-6, 500e-6, false},
                  {"stem", 20e-6, 4e-6, 100e-6, false},
                  {"density", 0.5, 0.1, 0.8, true},
                  {"keep-out", 150e-6, 20e-6, 2e-3, false}},
    .nparameter = 4,
    .draw = draw_window,
    .in_window = FW_GROWS_IN_CELLS,
};
