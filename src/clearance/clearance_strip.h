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
    double turn_rad;        /* of the hinge, either way */
    double drift_m;         /* of the hinge point under a pure moment */
} fw_clearance_bend;

fw_status fw_clearance_strip_of(fw_arena *arena, const fw_layout *layout,
                                const fw_layout_piece *piece, fw_clearance_strip *strip);
fw_clearance_bend fw_clearance_bend_of(const fw_mechanism *mechanism,
                                       const fw_mechanism_hinge *hinge);
/* radius about the hinge point within which it stays */
double fw_clearance_strip_reach(const fw_clearance_strip *strip, const fw_clearance_bend *bend);
/* what of its own two bodies it is not proved to keep off, and where that is drawn; NULL: nothing */
const char *fw_clearance_strip_meets(const fw_clearance_things *things,
                                     const fw_clearance_strip *strip, const fw_clearance_bend *bend,
                                     double wall_m, fw_geometry_vec2 *at);

#endif
