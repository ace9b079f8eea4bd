/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solid that the polygons of the biased layers stand for: each drawn up from z = 0 to the
   device's thickness. Private to the room: stl.c. */
#ifndef FW_MASK_SOLID_H
#define FW_MASK_SOLID_H
#include "mask/mask.h"

typedef struct fw_mask_solid_piece {
    const fw_mask_shape *shape;
    fw_geometry_polygon polygon;            /* of the shape, or one of its parts */
    fw_geometry_polygon_triangle *triangle; /* (polygon.count - 2) of its top */
    bool *wall; /* (polygon.count) from vertex i to the next one: false where another
                   piece goes on */
} fw_mask_solid_piece;

typedef struct fw_mask_solid {
    fw_mask_solid_piece *piece; /* (npiece) */
    int npiece;
    long triangles; /* of both faces and the walls */
    double thickness_m;
} fw_mask_solid;

fw_status fw_mask_solid_build(fw_arena *arena, const fw_mask *mask, fw_mask_solid *solid);

#endif
