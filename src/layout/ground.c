/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/draw.h"
#include "layout/layout_text.h"
#include <math.h>

static fw_status clear_of_all(const fw_layout_drawing *d, const fw_geometry_contour *strip,
                              bool *clear) {
    *clear = false;
    for (int b = 0; b < d->device->nbody; b++)
        if (fw_geometry_contour_distance_below(strip, &d->plain[b], 20e-6, NULL, NULL) < 20e-6)
            return FW_OK;
    if (fw_layout_near_stator(d, strip, 20e-6)) return FW_OK;
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        fw_geometry_contour disc;
        if (fw_geometry_contour_contains(strip, h->centre)) return FW_OK;
        fw_status status = fw_geometry_contour_disc(d->arena, h->centre, h->keep_out_m, &disc);
        if (status == FW_NOMEM) return status; /* not a reason to go to another side */
        if (status != FW_OK ||
            fw_geometry_contour_distance_below(strip, &disc, 10e-6, NULL, NULL) < 10e-6)
            return FW_OK;
    }
    *clear = true;
    return FW_OK;
}

double fw_layout_base_reach(const fw_layout_drawing *d, int joint) {
    const fw_layout_hinge_plan *plan = &d->hinge[joint];
    fw_geometry_vec2 out = plan->side[plan->side[1].body == FW_GROUND].direction;
    fw_geometry_vec2 w = fw_layout_joint_point(d->device, joint);
    const fw_geometry_box *b = &d->layout->window;
    double x = out.x > 0.0 ? b->x1 - w.x : w.x - b->x0, y = out.y > 0.0 ? b->y1 - w.y : w.y - b->y0;
    return (fabs(out.x) > fabs(out.y) ? x : y) - fw_layout_rule.stub_m;
}

/* where the pedestal leaves the base: the middle of the bar between two ground hinges, or the end
   of the spoke of one */
typedef struct foot {
    fw_geometry_vec2 middle, axis; /* axis of the bar, or (0, 0) */
    double half, reach;            /* half width wanted; half the free length of the bar */
} foot;

static foot choose_foot(const fw_layout_drawing *d, const int *joint, int n) {
    foot f = {{0.0, 0.0}, {0.0, 0.0}, 0.0, 0.0};
    const fw_layout_hinge_plan *plan = &d->hinge[joint[0]];
    const fw_layout_side *side = &plan->side[plan->side[1].body == FW_GROUND];
    for (int i = 0; i < n; i++)
        f.middle = fw_add(f.middle, 1.0 / n, fw_layout_joint_point(d->device, joint[i]));
    f.half = side->half_width_m;
    if (n == 1) {
        double begin = side->neck_end_m, cut = fw_layout_base_reach(d, joint[0]);
        f.middle = fw_add(f.middle, begin + fw_layout_rule.pedestal_share * (cut - begin),
                          side->direction);
        f.half = fw_layout_rule.pedestal_widths * side->half_width_m;
    }
    if (n == 2) {
        fw_geometry_vec2 between = fw_sub(fw_layout_joint_point(d->device, joint[1]),
                                          fw_layout_joint_point(d->device, joint[0]));
        double length = fw_norm(between), q = fmax(d->layout->hinge[joint[0]].keep_out_m,
                                                   d->layout->hinge[joint[1]].keep_out_m);
        f.axis = side->direction;
        f.reach = 0.5 * length - q - fw_layout_rule.pedestal_clear_m;
        f.half = fmin(fw_layout_rule.pedestal_bar_share * length, f.reach);
    }
    return f;
}

static double side_distance(const fw_layout *l, fw_layout_window_side side, fw_geometry_vec2 p) {
    return fabs(fw_dot(fw_sub(fw_layout_window_point(l, side, 0.0, 0.0), p),
                       fw_layout_window_outward(side)));
}

/* one base: heads at its ground hinges, a bar between them, and a pedestal to the nearest side of
   the window that it reaches freely */
static fw_status draw_base(fw_layout_drawing *d, const int *joint, int n, int only) {
    foot f = choose_foot(d, joint, n);
    bool tried[4] = {false, false, false, false};
    for (int round = 0; round < 4; round++) {
        fw_layout_window_side side = FW_LEFT;
        double best = HUGE_VAL;
        for (int s = 0; s < 4; s++) {
            double far = side_distance(d->layout, (fw_layout_window_side)s, f.middle);
            if (!tried[s] && far < best - 1e-9) {
                best = far;
                side = (fw_layout_window_side)s;
            }
        }
        tried[side] = true;
        fw_geometry_vec2 out = fw_layout_window_outward(side);
        bool up = out.x != 0.0;
        double across = up ? f.middle.x : f.middle.y, along = up ? f.middle.y : f.middle.x;
        double slope = 0.0, half = f.half;
        if (n == 2) {
            double t = up ? f.axis.y : f.axis.x, o = up ? f.axis.x : f.axis.y;
            if (fabs(t) < 0.5) continue; /* the bar points at this side */
            slope = o / t;
            half = fmin(half, f.reach * fabs(t));
        }
        if (half < 0.5 * fw_layout_rule.tether_m) continue;
        fw_layout_attachment a = {.body = FW_GROUND};
        double at = fw_layout_to_grid(along);
        double low = across + slope * (at - half - along),
               high = across + slope * (at + half - along);
        FW_TRY(fw_layout_strip_draw(d, side, low, high, at, half, fw_layout_rule.stub_m, &a));
        bool clear;
        FW_TRY(clear_of_all(d, &a.finger, &clear));
        if (!clear) continue;
        fw_geometry_contour pedestal = a.finger;
        a.finger = (fw_geometry_contour){NULL, 0};
        FW_TRY(fw_layout_attachment_add(d, &a));
        return fw_layout_body_draw(d, FW_GROUND, only, &pedestal, 1);
    }
    fw_diag_error(d->diags, 128, d->device->revolute[joint[0]].place,
                  "the base at ground hinge %s cannot reach the frame on any side without crossing "
                  "a moving part; move the ground hinges to the rim of the mechanism",
                  d->device->revolute[joint[0]].id);
    return FW_GEOMETRY;
}

/* one base for two ground hinges; with more, every hinge has its own to the frame */
fw_status fw_layout_ground_draw(fw_layout_drawing *d) {
    int n = fw_layout_body_joints(d->device, FW_GROUND, NULL, 0), *joint;
    FW_NEED(joint = fw_arena_array(d->arena, int, (size_t)n));
    fw_layout_body_joints(d->device, FW_GROUND, joint, n);
    if (n == 1 || n == 2) return draw_base(d, joint, n, FW_NONE);
    bool bad = false;
    for (int i = 0; i < n; i++) {
        fw_status status = draw_base(d, &joint[i], 1, joint[i]);
        if (status == FW_GEOMETRY)
            bad = true;
        else if (status != FW_OK)
            return status;
    }
    return bad ? FW_GEOMETRY : FW_OK;
}
