/* SPDX-License-Identifier: GPL-3.0-or-later */
/* By how much two solids may come nearer than at their middle poses.

   A point p of a solid with its centre of mass at x goes by
     d(p) = dx + (R(t) - 1)(p - x) = dx + t J(p - x) + e,  |e| <= t^2/2 |p - x|
   when the pose is off by (dx, t). For p of solid a, q of solid b, and any point c,
     d(q) - d(p) = u + (tb - ta) J(p - c) + tb J(q - p) + e_b - e_a,
     u = dx_b - dx_a + tb J(c - x_b) - ta J(c - x_a).
   q - p + tb J(q - p) is never shorter than q - p: the second is square to it. So
     |q' - p'| >= |q - p| - (|u| + |tb - ta| max|p - c| + (ta^2 arm_a + tb^2 arm_b)/2).
   What turns both alike, or about c, costs only the last part, of second order. u, ta, tb are linear
   in the poses and the parentheses convex in them, so that the bound holds for all poses in the
   convex hull of those it was computed for: Bernstein coefficients of a motion, corners of a box.
   Error: proved, but for rounding (1e-19 m). Source: docs/theory/clearance.md.
   Test: test_clearance.c slack_bounds_every_pose */
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include <math.h>

void fw_clearance_slack_begin(const fw_clearance_pair *pair, const fw_clearance_pose middle[2],
                              fw_clearance_slack *slack) {
    const fw_clearance_solid *a = &pair->things->solid[pair->a];
    *slack = (fw_clearance_slack){.middle = {middle[0], middle[1]}};
    fw_geometry_vec2 c = fw_clearance_place(a, middle[0], pair->centre);
    for (int k = 0; k < 2; k++)
        slack->lever[k] = vec_left(vec_sub(c, (fw_geometry_vec2){middle[k].x_m, middle[k].y_m}));
}

void fw_clearance_slack_add(const fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                            fw_clearance_slack *slack) {
    double ux = 0, uy = 0, turn[2];
    for (int k = 0; k < 2; k++) {
        double sign = k ? 1 : -1;
        turn[k] = pose[k].phi_rad - slack->middle[k].phi_rad;
        ux += sign * (pose[k].x_m - slack->middle[k].x_m + turn[k] * slack->lever[k].x);
        uy += sign * (pose[k].y_m - slack->middle[k].y_m + turn[k] * slack->lever[k].y);
        if (fabs(turn[k]) > slack->turn_rad[k]) slack->turn_rad[k] = fabs(turn[k]);
    }
    double here = sqrt(ux * ux + uy * uy) + fabs(turn[1] - turn[0]) * pair->reach_m;
    if (here > slack->linear_m) slack->linear_m = here;
}

double fw_clearance_slack_m(const fw_clearance_pair *pair, const fw_clearance_slack *slack) {
    double second = 0;
    for (int k = 0; k < 2; k++)
        second += 0.5 * slack->turn_rad[k] * slack->turn_rad[k] * pair->arm_m[k];
    return slack->linear_m + second;
}
