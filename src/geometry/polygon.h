/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the room: the two exact answers to "is this polygon simple?". */
#ifndef FW_GEOMETRY_POLYGON_H
#define FW_GEOMETRY_POLYGON_H
#include "geometry/tessellate.h"

/* -1, 0, 1 left of, on, right of .. : twice the area of the triangle, exact for |coordinate| < 2^30
 */
static inline int64_t fw_cross(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - a.y_dbu) -
           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - a.x_dbu);
}

/* *proved: no two edges have a common point but the vertex of neighbours. false says nothing: then
   polygon.c's sweep over edges decides and names the two. */
fw_status fw_geometry_polygon_prove(fw_arena *arena, const fw_geometry_polygon *polygon,
                                    bool *proved);

#endif
