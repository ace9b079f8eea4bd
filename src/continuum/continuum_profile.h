/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The profile of a flexure: centre line of lines and arcs, edges, fillets, blocks. Private. */
#ifndef FW_CONTINUUM_CONTINUUM_PROFILE_H
#define FW_CONTINUUM_CONTINUUM_PROFILE_H
#include "continuum/continuum.h"
#include "geometry/contour.h"

typedef struct
    fw_continuum_profile_frame { /* on the centre line: point, unit tangent; left normal (-ty, tx)
                                   */
    double x, y, tx, ty;
} fw_continuum_profile_frame;

typedef struct
    fw_continuum_profile_fillet { /* seen along the way out of the strip into the block */
    double before_m;              /* of its start from the root, along the centre line */
    fw_geometry_vec2 centre;
    double from_rad, sweep_rad; /* from the edge of the strip to the face of the root */
} fw_continuum_profile_fillet;

typedef struct fw_continuum_profile {
    const fw_continuum_shape *shape;
    double length_m, s0_m[FW_CONTINUUM_PIECES]; /* where each piece starts */
    fw_continuum_profile_frame start[FW_CONTINUUM_PIECES];
    fw_continuum_profile_fillet fillet[2][2]; /* [end][side: 0 right, 1 left of the way out] */
} fw_continuum_profile;

/* a point of an edge and the unit normal there, into the material */
typedef struct fw_continuum_profile_edge {
    fw_geometry_vec2 p, n;
} fw_continuum_profile_edge;

fw_status fw_continuum_profile_build(const fw_continuum_shape *shape, fw_continuum_profile *profile,
                                     const char **why);
/* frame at arc length s; beyond the ends the last piece goes on */
fw_continuum_profile_frame fw_continuum_profile_at(const fw_continuum_profile *p, double s_m);
/* outward-looking frame at distance `before` inside end 0 or 1 (< 0: in the block) */
fw_continuum_profile_frame fw_continuum_profile_out(const fw_continuum_profile *p, int end,
                                                    double before_m);
fw_geometry_vec2 fw_continuum_profile_offset(fw_continuum_profile_frame f, double n_m);
/* at `side` (0 right, 1 left of the way from first to second root), u in [0, 1] along the strip
   between its fillets, or along a fillet from the strip to the face */
fw_continuum_profile_edge fw_continuum_profile_strip_edge(const fw_continuum_profile *p, int side,
                                                          double u);
fw_continuum_profile_edge fw_continuum_profile_fillet_edge(const fw_continuum_profile *p, int end,
                                                           int side, double u);
/* outer boundary of the block from the right to the left of the way out, v in [0, 1]: the first
   `corner` and the last belong to the sides */
fw_geometry_vec2 fw_continuum_profile_block_edge(const fw_continuum_profile *p, int end,
                                                 double corner, double v);

#endif
