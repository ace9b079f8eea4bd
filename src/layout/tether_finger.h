/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fingers of the frame that tethers are made of: where one may reach a body. Private to the room. */
#ifndef FW_LAYOUT_TETHER_FINGER_H
#define FW_LAYOUT_TETHER_FINGER_H
#include "layout/draw.h"
#include "layout/layout_text.h"

/* nothing but its own body is nearer than the rules have it */
bool fw_layout_finger_is_clear(const fw_layout_drawing *d, const fw_geometry_contour *finger,
                               int body);
/* the finger may leave its own body only once: everything from a little outside on is free */
bool fw_layout_finger_leaves_once(const fw_layout_drawing *d, const fw_layout_attachment *a,
                                  fw_geometry_vec2 from);
/* Depth of the neck's cut. The stub's corners at a body's edge of slope m (against the side) are
   rounded by r; the farther one ends r sqrt(1 + m2) outside the edge at r from the stub. A little
   more stays straight, so that the cut is square. Exact for a straight edge. test_layout.c
   tethers_break_at_the_body */
double fw_layout_finger_cut(const fw_layout_drawing *d, const fw_layout_attachment *a, double at,
                            double deep);
void fw_layout_sides_by_distance(const fw_layout *l, fw_geometry_vec2 p,
                                 fw_layout_window_side order[4]);
/* where a line straight inwards from a side meets the body, if its edge is one there and beside; a
   stub near a corner that somebody drew would leave a slit. Segment -1: it is not */
fw_layout_ray_hit fw_layout_finger_edge(const fw_layout_drawing *d, int body,
                                        fw_layout_window_side side, double along);
/* what stands in the way of the finger that comes nearest to having room, and by how much it would have
   to stand aside: a clause (tether_room.c) */
fw_status fw_layout_tether_room(fw_layout_drawing *d, int body, fw_geometry_vec2 *at,
                                const char **why, const char **room);
#endif
