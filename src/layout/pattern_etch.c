/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test patterns of etching, release and stress. Each with what it tells, and its row;
   patterns.def lists them. */
#include "base/constants.h"
#include "layout/pattern.h"
#include "layout/layout.h"
#include <math.h>

/* ---- ladder ---- */

/* undercut-ladder: free-standing lines of rising width, all with the same space between. An etch
   that eats u from either side removes every line narrower than 2 u: with w the widest line that is
   gone and w' the narrowest that stands, w < 2 u <= w'. For a masked etch to depth d of anisotropy
   A under a mask whose own etch took m per edge,
       2 u = 2 (m + (1 - A) d),   so   1 - A = (v/2 - m)/d   with v between w and w'.
   In: from, to, step, space, length, m. Out: one line per step, width
   exact on the 1 nm grid. Resolution: step/2 in 2 u, that is step/(4 d) in A. Test:
   test_patterns.c. */

enum { FROM, TO, LADDER_STEP, LADDER_SPACE, LADDER_LENGTH };

/* every second micrometre is lettered: more does not fit below narrow lines */
static bool is_lettered(double width_m) {
    double two = width_m / 2e-6;
    return fabs(two - nearbyint(two)) < 1e-6;
}

static fw_status draw_ladder(fw_layout_pen *pen) {
    double step = fw_layout_pen_value(pen, LADDER_STEP), from = fw_layout_pen_value(pen, FROM);
    double space = fw_layout_pen_value(pen, LADDER_SPACE),
           length = fw_layout_pen_value(pen, LADDER_LENGTH), x = 0;
    int n = (int)floor((fw_layout_pen_value(pen, TO) - from) / step + 1e-6) + 1;
    if (n < 2 || n > 200) return FW_GEOMETRY;
    for (int i = 0; i < n; i++) {
        double w = fw_layout_to_grid(from + i * step), y = 0.5 * length;
        FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "line of the undercut ladder", x, 0, x + w,
                                 length));
        FW_TRY(
            fw_layout_pen_chord(pen, "line", x, y, x + w, y, is_lettered(w) ? FW_PEN_SIZE : NULL));
        x += w + space;
    }
    fw_layout_pen_figure(pen, "step", step * 1e6, "um");
    fw_layout_pen_figure(pen, "space", space * 1e6, "um");
    pen->coupon->formula = "widest line that is gone <= 2 u <= narrowest that stands; "
                           "1 - A = (u - mask undercut)/depth";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_ladder = {
    .name = "undercut-ladder",
    .what = "lines of rising width: what the etch takes from either side",
    .parameter = {{"from", 4e-6, 1e-6, 100e-6, false},
                  {"to", 24e-6, 1e-6, 200e-6, false},
                  {"step", 0.5e-6, 0.05e-6, 20e-6, false},
                  {"space", 20e-6, 1e-6, 200e-6, false},
                  {"length", 150e-6, 20e-6, 1e-3, false}},
    .nparameter = 5,
    .draw = draw_ladder,
};

/* ---- slots ---- */

/* arde-slots: trenches of rising width between walls of the same width, open at one end. Depth d_i
   of a slot of width w_i after the time t follows from the transport of the etchant into it,
   dd/dt = R0/(1 + S (1/K(d/w) - 1)); two widths give rate and lag without a fit:
       S = (d2 - d1)/(J1 - J2),   R0 = (d1 + S J1)/t,   J_i = integral of (1/K - 1) over the depth
   (knowledge and test of K: process/law_etch.c). To be measured before the etch goes through.
   In: sizes, wall, length, m. Out: one slot per size, width exact on the 1 nm grid.
   Validity: length at least five widths, else the open end counts. Test: test_patterns.c. */

enum { WALL, SLOTS_LENGTH };

static fw_status draw_slots(fw_layout_pen *pen) {
    double wall = fw_layout_pen_value(pen, WALL), length = fw_layout_pen_value(pen, SLOTS_LENGTH),
           x = 0;
    const fw_layout_pattern *p = pen->pattern;
    for (int i = 0; i <= p->nsize; i++) {
        FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "wall of a slot", x, 0, x + wall, length));
        x += wall;
        if (i == p->nsize) break;
        double w = p->size_m[i], y = 0.4 * length;
        FW_TRY(fw_layout_pen_chord(pen, "slot", x, y, x + w, y, FW_PEN_SIZE));
        x += w;
    }
    fw_layout_pen_figure(pen, "length", length * 1e6, "um");
    pen->coupon->formula = "depths d1, d2 of two widths after time t: S = (d2 - d1)/(J1 - J2), "
                           "R0 = (d1 + S J1)/t";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_slots = {
    .name = "arde-slots",
    .what = "slots of rising width: rate of an etch and how it lags in narrow openings",
    .parameter = {{"wall", 90e-6, 5e-6, 1e-3, false}, {"length", 300e-6, 20e-6, 2e-3, false}},
    .nparameter = 2,
    .sizes = "widths of the slots",
    .draw = draw_slots,
};

/* ---- holes ---- */

/* release-holes: plates with holes in a square grid of rising pitch. What is dissolved below has to
   be reached from the nearest opening; farthest is the middle between four holes,
       square holes of side s:  reach = (p - s)/sqrt 2
       round ones of diameter s: reach = p/sqrt 2 - s/2
   The plate of the largest pitch that is free gives the lateral rate: R >= reach/t. The rim keeps
   the holes (p - s)/2 from the edges, so that the middle of the plate is the last to go.
   An outline has no holes, so the plate is cut along the lines through the holes: strips that share
   the edges between holes as joints, bit for bit. The edges beside a joint are square to it (round
   holes: tangent), as the process bias needs it.
   In: sizes (pitches), hole, round (1) or square (0), holes (along x and y), space, m. Out: per
   pitch the strips; area = strip - holes, exactly. Test: test_patterns.c. */

enum { HOLE, ROUND, COUNT, HOLES_SPACE };
static const double STEM_M = 20e-6, STEM_HIGH_M = 30e-6;

double fw_layout_holes_reach_m(double pitch_m, double hole_m, bool round) {
    return round ? pitch_m / sqrt(2) - 0.5 * hole_m : (pitch_m - hole_m) / sqrt(2);
}

typedef struct plate {
    double x, y, pitch, hole, rim; /* lower left corner of the plate */
    int count;
    bool round;
} plate;

/* left edge of hole i */
static double hole_at(const plate *p, int i) {
    return fw_layout_to_grid(p->x + p->rim + i * p->pitch);
}

/* height of cut k, through the middles of row k; cut -1 and cut `count` are the plate's edges */
static double cut_at(const plate *p, double high, int k) {
    if (k < 0) return p->y;
    if (k == p->count) return fw_layout_to_grid(p->y + high);
    return fw_layout_to_grid(p->y + p->rim + 0.5 * p->hole + k * p->pitch);
}

/* half a hole in the edge at height y: into the strip above (up) or below it. Going right above the
   cut, left below it */
static void half_hole(const plate *p, fw_geometry_outline *o, int i, double y, bool up) {
    double a = hole_at(p, i), b = fw_layout_to_grid(a + p->hole), h = 0.5 * p->hole;
    double from = up ? a : b, to = up ? b : a;
    if (p->round) {
        fw_geometry_vec2 centre = {0.5 * (a + b), y};
        fw_geometry_outline_arc_to(o, centre, -FW_PI, (fw_geometry_vec2){to, y}, 0);
        return;
    }
    double inner = fw_layout_to_grid(up ? y + h : y - h);
    fw_geometry_outline_line(o, (fw_geometry_vec2){from, inner}, 0);
    fw_geometry_outline_line(o, (fw_geometry_vec2){to, inner}, 0);
    fw_geometry_outline_line(o, (fw_geometry_vec2){to, y}, 0);
}

/* the strip between cuts k - 1 and k, counter-clockwise from its lower left corner */
static fw_status add_strip(fw_layout_pen *pen, const plate *p, double side, int k) {
    double low = cut_at(p, side, k - 1), high = cut_at(p, side, k);
    double x0 = p->x, x1 = fw_layout_to_grid(p->x + side);
    fw_geometry_outline o = fw_geometry_outline_start(pen->arena, (fw_geometry_vec2){x0, low});
    if (k == 0) { /* on its stem */
        double s0 = fw_layout_to_grid(0.5 * (x0 + x1 - STEM_M)),
               s1 = fw_layout_to_grid(s0 + STEM_M);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){s0, low}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){s0, 0}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){s1, 0}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){s1, low}, 0);
    }
    for (int i = 0; k > 0 && i < p->count; i++) {
        fw_geometry_outline_line(&o, (fw_geometry_vec2){hole_at(p, i), low}, FW_SEGMENT_JOINT);
        half_hole(p, &o, i, low, true);
    }
    fw_geometry_outline_line(&o, (fw_geometry_vec2){x1, low}, k > 0 ? FW_SEGMENT_JOINT : 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){x1, high}, 0);
    for (int i = p->count - 1; k < p->count && i >= 0; i--) {
        fw_geometry_outline_line(
            &o, (fw_geometry_vec2){fw_layout_to_grid(hole_at(p, i) + p->hole), high},
            FW_SEGMENT_JOINT);
        half_hole(p, &o, i, high, false);
    }
    fw_geometry_outline_line(&o, (fw_geometry_vec2){x0, high}, k < p->count ? FW_SEGMENT_JOINT : 0);
    return fw_layout_pen_outline(pen, FW_ROLE_STRUCTURE, "plate with release holes", &o);
}

static fw_status draw_holes(fw_layout_pen *pen) {
    const fw_layout_pattern *pattern = pen->pattern;
    double hole = fw_layout_pen_value(pen, HOLE), x = 0;
    bool round = fw_layout_pen_value(pen, ROUND) != 0;
    int count = (int)fw_layout_pen_value(pen, COUNT);
    for (int i = 0; i < pattern->nsize; i++) {
        double pitch = pattern->size_m[i], rim = fw_layout_to_grid(0.5 * (pitch - hole));
        if (pitch < hole + 2 * pen->width_rule_m || rim < pen->width_rule_m) return FW_GEOMETRY;
        double side = (count - 1) * pitch + hole + 2 * rim;
        plate p = {x, STEM_HIGH_M, pitch, hole, rim, count, round};
        if (side < STEM_M + 2 * pen->width_rule_m) return FW_GEOMETRY;
        for (int k = 0; k <= count; k++)
            FW_TRY(add_strip(pen, &p, side, k));
        double reach = fw_layout_holes_reach_m(pitch, hole, round);
        fw_geometry_vec2 middle = {x + 0.5 * side, STEM_HIGH_M + 0.5 * side};
        FW_TRY(fw_layout_pen_feature(pen, "reach", reach, middle,
                                     (fw_geometry_vec2){middle.x + 0.5 * pitch, middle.y}, NULL));
        char number[32];
        const char *label =
            fw_arena_strdup(pen->arena, fw_number_text(number, sizeof number, pitch * 1e6, 6));
        FW_NEED(label);
        FW_TRY(fw_layout_pen_chord(pen, "pitch", middle.x - 0.5 * pitch, middle.y,
                                   middle.x + 0.5 * pitch, middle.y, label));
        x = fw_layout_to_grid(x + side + fw_layout_pen_value(pen, HOLES_SPACE));
    }
    fw_layout_pen_figure(pen, "hole", hole * 1e6, "um");
    pen->coupon->formula = "lateral rate of the release >= reach of the widest free plate/time";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_holes = {
    .name = "release-holes",
    .what = "plates with holes of rising pitch: lateral reach of the release",
    .parameter = {{"hole", 10e-6, 2e-6, 200e-6, false},
                  {"round", 0, 0, 1, true},
                  {"count", 4, 1, 20, true},
                  {"space", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 4,
    .sizes = "pitches of the holes",
    .draw = draw_holes,
};

/* ---- cantilevers ---- */

/* cantilevers: beams of rising length, free at one end. A gradient G of stress through the
   thickness curls a beam that came free to the radius M/G, so that the tip of one of length L
   stands h = G L^2/(2 M) above its root (small slopes), M the biaxial modulus, E/(1 - nu) or of (100) silicon
   180.3 GPa: the film was stressed in all directions of its plane, so that a beam of any width wants that strain.
   In: sizes (lengths), width, space, m; where the carrier stays below, hollow: how far a hollow of it goes
   beyond the beams on every side, below their bar too, so that what the two plates are off by moves no root.
   Source: beam with constant initial curvature, h = L^2/(2 R). Test: test_patterns.c. Holds where the root
   does: the bar must be wider than twice what the release reaches, or than the hollow goes below it. */

enum { CANTILEVERS_WIDTH, CANTILEVERS_SPACE, CANTILEVERS_HOLLOW };

static fw_status draw_cantilevers(fw_layout_pen *pen) {
    double width = fw_layout_pen_value(pen, CANTILEVERS_WIDTH), longest = 0;
    const double beyond = fw_layout_pen_value(pen, CANTILEVERS_HOLLOW);
    double x = beyond;
    const fw_layout_pattern *p = pen->pattern;
    for (int i = 0; i < p->nsize; i++) {
        longest = fmax(longest, p->size_m[i]);
        double length = p->size_m[i], middle = x + 0.5 * width;
        FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_STRUCTURE, "cantilever", x, 0, x + width, length));
        FW_TRY(fw_layout_pen_chord(pen, "beam", middle, 0, middle, length, FW_PEN_SIZE));
        x += width + fw_layout_pen_value(pen, CANTILEVERS_SPACE);
    }
    if (beyond > 0)
        FW_TRY(fw_layout_pen_bar(pen, FW_ROLE_CAVITY, "hollow below cantilevers", 0, -beyond,
                                 x - fw_layout_pen_value(pen, CANTILEVERS_SPACE) + beyond,
                                 longest + beyond));
    fw_layout_pen_figure(pen, "width", width * 1e6, "um");
    pen->coupon->formula = "height of the tip over the root: G = 2 M h/L^2, M = E/(1 - nu), of "
                           "(100) silicon 180.3 GPa";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_cantilevers = {
    .name = "cantilevers",
    .what = "beams of rising length: stress gradient from the height of their tips",
    .parameter = {{"width", 12e-6, 2e-6, 200e-6, false},
                  {"space", 60e-6, 4e-6, 500e-6, false},
                  {"hollow", 0, 0, 100e-6, false}},
    .nparameter = 3,
    .sizes = "lengths of the beams",
    .draw = draw_cantilevers,
};

/* ---- pointer ---- */

/* stress-pointer: two arms pull at a pointer from opposite sides, their lines the offset O apart. A
   film that wants to shrink by the strain e (stress M e before the release, M its biaxial modulus) turns
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

enum { ARM, OFFSET, POINTER_WIDTH, POINTER, POINTER_STEP };

double fw_layout_pointer_turn_per_strain(double arm_m, double offset_m, double width_m) {
    double q = width_m / offset_m, r = width_m / arm_m;
    return 2 * arm_m / offset_m * (1 - 0.5 * r * r) / (1 + 4.0 / 3.0 * q * q);
}

static const double POST_M = 160e-6, LOW_M = 80e-6;
static const double TOOTH_M = 6e-6, PITCH_M = 14e-6, LONG_M = 20e-6, BAR_M = 16e-6;
enum { EACH_SIDE = 5 };

/* teeth at i * pitch from the middle, from y0 to y1 */
static fw_status add_teeth(fw_layout_pen *pen, double x, double pitch, double y0, double y1) {
    for (int i = -EACH_SIDE; i <= EACH_SIDE; i++) {
        double at = fw_layout_to_grid(x + i * pitch);
        FW_TRY(fw_layout_pen_box(pen, at - 0.5 * TOOTH_M, y0, at + 0.5 * TOOTH_M, y1));
    }
    return FW_OK;
}

static fw_status draw_pointer(fw_layout_pen *pen) {
    double arm = fw_layout_pen_value(pen, ARM), offset = fw_layout_pen_value(pen, OFFSET);
    double w = fw_layout_pen_value(pen, POINTER_WIDTH), pointer = fw_layout_pen_value(pen, POINTER);
    double step = fw_layout_pen_value(pen, POINTER_STEP), bias = fmax(pen->bias_m, 0);
    double gap = fmax(8e-6, 2 * pen->space_rule_m) + 2 * bias;
    double pitch = fw_layout_to_grid(PITCH_M + 2 * bias); /* teeth stay apart with the bias */
    double thick = fmax(2 * w, 16e-6), x = POST_M + arm + 0.5 * thick, y = LOW_M + 0.5 * offset;
    double half = EACH_SIDE * pitch + 0.5 * TOOTH_M + 4e-6, tip = y + pointer;
    double scale = tip + gap; /* where the teeth of the frame end */
    double right = x + 0.5 * thick + arm, top = scale + LONG_M + BAR_M, reach = EACH_SIDE * step;
    if (offset < w + 8e-6 || half + reach > arm - 20e-6) return FW_GEOMETRY;
    /* post, arm, pointer with its scale, arm, post with the other scale: one shape */
    FW_TRY(fw_layout_pen_box(pen, 0, 0, POST_M, y + 0.5 * offset + 0.5 * w + 20e-6));
    FW_TRY(fw_layout_pen_box(pen, POST_M - 10e-6, y + 0.5 * offset - 0.5 * w, x,
                             y + 0.5 * offset + 0.5 * w));
    FW_TRY(fw_layout_pen_box(pen, x - 0.5 * thick, y - 0.5 * offset - 0.5 * w, x + 0.5 * thick,
                             tip - LONG_M - 0.5 * BAR_M));
    FW_TRY(fw_layout_pen_box(pen, x, y - 0.5 * offset - 0.5 * w, right + 10e-6,
                             y - 0.5 * offset + 0.5 * w));
    FW_TRY(fw_layout_pen_box(pen, x - half, tip - LONG_M - BAR_M, x + half, tip - LONG_M));
    FW_TRY(add_teeth(pen, x, pitch, tip - LONG_M - 0.5 * BAR_M, tip));
    FW_TRY(fw_layout_pen_box(pen, right, 0, right + POST_M, top));
    FW_TRY(fw_layout_pen_box(pen, x - half - reach, scale + LONG_M, right + 0.5 * POST_M, top));
    FW_TRY(add_teeth(pen, x, pitch + step, scale, scale + LONG_M + 0.5 * BAR_M));
    FW_TRY(fw_layout_pen_box(pen, x - 8e-6, top - 0.5 * BAR_M, x + 8e-6,
                             top + 12e-6)); /* the middle */
    FW_TRY(fw_layout_pen_shape(pen, FW_ROLE_STRUCTURE, "stress pointer"));
    double turn = fw_layout_pointer_turn_per_strain(arm, offset, w + 2 * pen->bias_m);
    FW_TRY(fw_layout_pen_chord(pen, "tip", x, y, x, tip, NULL));
    fw_layout_pen_figure(pen, "turn per strain", turn, "1");
    fw_layout_pen_figure(pen, "amplification", turn * pointer, "m");
    fw_layout_pen_figure(pen, "step", step * 1e6, "um");
    fw_layout_pen_figure(pen, "strain per step", step / (turn * pointer), "1");
    pen->coupon->formula =
        "strain = movement of the tip/amplification; stress = M strain, M = E/(1 - nu), "
        "of (100) silicon 180.3 GPa; tension where the tip moves to the left";
    return FW_OK;
}

const fw_layout_pattern_kind fw_layout_pattern_pointer = {
    .name = "stress-pointer",
    .what = "rotating pointer with a vernier: mean stress of the film",
    .parameter = {{"arm", 250e-6, 60e-6, 2e-3, false},
                  {"offset", 24e-6, 10e-6, 200e-6, false},
                  {"width", 8e-6, 4e-6, 50e-6, false},
                  {"pointer", 220e-6, 60e-6, 2e-3, false},
                  {"step", 0.5e-6, 0.1e-6, 2e-6, false}},
    .nparameter = 5,
    .draw = draw_pointer,
};
