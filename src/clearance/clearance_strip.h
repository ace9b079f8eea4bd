/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The strip of a flexure, and where it can be when it bends. For verdict/ and tests. */
#ifndef FW_CLEARANCE_CLEARANCE_STRIP_H
#define FW_CLEARANCE_CLEARANCE_STRIP_H
#include "clearance/clearance.h"

typedef struct fw_clearance_strip_part { /* of an edge, as drawn */
    fw_geometry_segment segment;
    double from_m, to_m; /* along the strip from the lower body's root, at its two ends */
} fw_clearance_strip_part;

typedef struct fw_clearance_strip {
    bool known;
    const fw_layout_hinge_layout *hinge;
    fw_clearance_strip_part *part; /* (count) */
    int count;
    double length_m; /* of the longer edge */
} fw_clearance_strip;

typedef struct fw_clearance_bend { /* bounds of what bends it */
    bool known;
    double strain;          /* of any fibre */
    double width_m;         /* the least */
    double curvature_per_m; /* change of it */
    double forced_per_m;    /* of that, what forces add to a pure moment; HUGE_VAL: not known */
    double turn_rad;        /* of the hinge, either way */
    double root_share;      /* of that, what both roots take */
    bool straight;          /* and of one width, so that forces bend it linearly */
} fw_clearance_bend;

/* ---- clearance_strip.c ---- */

fw_status fw_clearance_strip_of(fw_arena *arena, const fw_layout *layout,
                                const fw_layout_piece *piece, fw_clearance_strip *strip);
/* at the elastic limit with its safety factor; turn_rad is left 0 */
fw_clearance_bend fw_clearance_bend_of(const fw_mechanism *mechanism,
                                       const fw_mechanism_hinge *hinge);
/* what a point s_m from a root goes by against the body there, at most */
double fw_clearance_bend_at(const fw_clearance_bend *bend, double s_m);
/* the part between two parameters */
fw_geometry_segment fw_clearance_strip_cut(const fw_geometry_segment *s, double from, double to);
/* radius about the hinge point within which it stays */
double fw_clearance_strip_reach(const fw_clearance_strip *strip, const fw_clearance_bend *bend);

/* ---- clearance_bent.c ---- */

/* an edge of its own two bodies that it is not proved to keep off; NULL: none */
fw_status fw_clearance_strip_meets(fw_arena *arena, const fw_clearance_things *things,
                                   const fw_clearance_strip *strip, const fw_clearance_bend *bend,
                                   double wall_m, const fw_clearance_edge **met);

#endif
