/* SPDX-License-Identifier: GPL-3.0-or-later */
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
#include "layout/pattern.h"
#include "base/constants.h"
#include "layout/text.h"
#include <math.h>

enum { HOLE, ROUND, COUNT, SPACE };
static const double STEM_M = 20e-6, STEM_HIGH_M = 30e-6;

double fw_holes_reach_m(double pitch_m, double hole_m, bool round) {
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
static void half_hole(const plate *p, fw_outline *o, int i, double y, bool up) {
    double a = hole_at(p, i), b = fw_layout_to_grid(a + p->hole), h = 0.5 * p->hole;
    double from = up ? a : b, to = up ? b : a;
    if (p->round) {
        fw_vec2 centre = {0.5 * (a + b), y};
        fw_outline_arc_to(o, centre, -FW_PI, (fw_vec2){to, y}, 0);
        return;
    }
    double inner = fw_layout_to_grid(up ? y + h : y - h);
    fw_outline_line(o, (fw_vec2){from, inner}, 0);
    fw_outline_line(o, (fw_vec2){to, inner}, 0);
    fw_outline_line(o, (fw_vec2){to, y}, 0);
}

/* the strip between cuts k - 1 and k, counter-clockwise from its lower left corner */
static fw_status add_strip(fw_pen *pen, const plate *p, double side, int k) {
    double low = cut_at(p, side, k - 1), high = cut_at(p, side, k);
    double x0 = p->x, x1 = fw_layout_to_grid(p->x + side);
    fw_outline o = fw_outline_start(pen->arena, (fw_vec2){x0, low});
    if (k == 0) { /* on its stem */
        double s0 = fw_layout_to_grid(0.5 * (x0 + x1 - STEM_M)),
               s1 = fw_layout_to_grid(s0 + STEM_M);
        fw_outline_line(&o, (fw_vec2){s0, low}, 0);
        fw_outline_line(&o, (fw_vec2){s0, 0}, 0);
        fw_outline_line(&o, (fw_vec2){s1, 0}, 0);
        fw_outline_line(&o, (fw_vec2){s1, low}, 0);
    }
    for (int i = 0; k > 0 && i < p->count; i++) {
        fw_outline_line(&o, (fw_vec2){hole_at(p, i), low}, FW_SEGMENT_JOINT);
        half_hole(p, &o, i, low, true);
    }
    fw_outline_line(&o, (fw_vec2){x1, low}, k > 0 ? FW_SEGMENT_JOINT : 0);
    fw_outline_line(&o, (fw_vec2){x1, high}, 0);
    for (int i = p->count - 1; k < p->count && i >= 0; i--) {
        fw_outline_line(&o, (fw_vec2){fw_layout_to_grid(hole_at(p, i) + p->hole), high},
                        FW_SEGMENT_JOINT);
        half_hole(p, &o, i, high, false);
    }
    fw_outline_line(&o, (fw_vec2){x0, high}, k < p->count ? FW_SEGMENT_JOINT : 0);
    return fw_pen_outline(pen, FW_ROLE_STRUCTURE, "plate with release holes", &o);
}

static fw_status draw(fw_pen *pen) {
    const fw_pattern *row = pen->pattern;
    double hole = fw_pen_value(pen, HOLE), x = 0;
    bool round = fw_pen_value(pen, ROUND) != 0;
    int count = (int)fw_pen_value(pen, COUNT);
    for (int i = 0; i < row->nsize; i++) {
        double pitch = row->size_m[i], rim = fw_layout_to_grid(0.5 * (pitch - hole));
        if (pitch < hole + 2 * pen->width_rule_m || rim < pen->width_rule_m) return FW_GEOMETRY;
        double side = (count - 1) * pitch + hole + 2 * rim;
        plate p = {x, STEM_HIGH_M, pitch, hole, rim, count, round};
        if (side < STEM_M + 2 * pen->width_rule_m) return FW_GEOMETRY;
        for (int k = 0; k <= count; k++)
            FW_TRY(add_strip(pen, &p, side, k));
        double reach = fw_holes_reach_m(pitch, hole, round);
        fw_vec2 middle = {x + 0.5 * side, STEM_HIGH_M + 0.5 * side};
        FW_TRY(fw_pen_feature(pen, "reach", reach, middle,
                              (fw_vec2){middle.x + 0.5 * pitch, middle.y}, NULL));
        char number[32];
        const char *label =
            fw_arena_strdup(pen->arena, fw_number_text(number, sizeof number, pitch * 1e6, 6));
        FW_NEED(label);
        FW_TRY(fw_pen_chord(pen, "pitch", middle.x - 0.5 * pitch, middle.y, middle.x + 0.5 * pitch,
                            middle.y, label));
        x = fw_layout_to_grid(x + side + fw_pen_value(pen, SPACE));
    }
    fw_pen_figure(pen, "hole", hole * 1e6, "um");
    pen->coupon->formula = "lateral rate of the release >= reach of the widest free plate/time";
    return FW_OK;
}

const fw_pattern_kind fw_pattern_holes = {
    .name = "release-holes",
    .what = "plates with holes of rising pitch: lateral reach of the release",
    .parameter = {{"hole", 10e-6, 2e-6, 200e-6, false},
                  {"round", 0, 0, 1, true},
                  {"count", 4, 1, 20, true},
                  {"space", 40e-6, 4e-6, 500e-6, false}},
    .nparameter = 4,
    .sizes = "pitches of the holes",
    .draw = draw,
};
