/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least distance between what is drawn of two bodies, as it is made:

     gap = max(0, D - w),    w = 2 edge + |flare|

   with D the distance of their outlines at a pose and w by how much walls come nearer than drawn. In:
   poses in SI; out: m. Error: that of the state; extremes over a motion hold between its instants, to
   max(1 nm, 0.1 %). Where outlines meet as drawn it is 0, and up to -w more where walls are etched
   away. Cost: fw_clearance_gap_m. Test: test_clearance_gap.c, tests/clearance/gaps.py */
#include "probe/probe.h"
#include <math.h>

static double as_made(const fw_probe *p, double drawn_m) {
    return drawn_m > 0 ? fmax(0, drawn_m - p->walls_m) : 0;
}

static double value(const fw_probe *p, const fw_probe_state *s) {
    return p->gap ? as_made(p, fw_clearance_gap_m(p->gap, s->q)) : (double)NAN;
}

static double moved(const fw_probe *p, const fw_probe_state *s) {
    return fw_clearance_gap_moved_m(p->gap, s->q);
}

double fw_probe_gap_drawn(const fw_probe *p) {
    return p->gap ? as_made(p, fw_clearance_gap_drawn_m(p->gap)) : (double)NAN;
}

double fw_probe_gap_etched_m(const fw_probe *p) {
    return p->gap ? fmax(0, -p->walls_m) : 0;
}

/* from what is known of the course to what the piece adds to it */
static void extreme(const fw_probe *p, const fw_clearance_path *piece, double sign,
                    fw_probe_course *course) {
    fw_probe_extreme *e = sign < 0 ? &course->minimum : &course->maximum;
    if (sign < 0 && e->value <= 0) return;
    const double before = e->value + p->walls_m;
    double *bound = sign < 0 ? &course->below : &course->above;
    fw_clearance_gap_extreme known = {
        .m = before, .t_s = e->t_s, .bound_m = course->searched ? *bound + p->walls_m : before};
    fw_clearance_gap_over(p->gap, piece, sign, &known);
    course->moved = fmax(course->moved, known.moved_m);
    *bound = fmax(0, known.bound_m - p->walls_m);
    if (known.m != before) *e = (fw_probe_extreme){as_made(p, known.m), known.t_s, 0};
}

static void within(const fw_probe *p, const fw_clearance_path *piece, fw_probe_course *course) {
    if (!p->gap || course->count == 0) return;
    extreme(p, piece, -1, course);
    extreme(p, piece, 1, course);
    course->searched = true;
}

const fw_probe_row fw_probe_gap = {.value = value, .within = within, .moved = moved};
