/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test patterns of plating, films and load. Each with what it tells, and its row; the table is in
 * pattern.c. */
#include "layout/pattern.h"
#include <math.h>

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
