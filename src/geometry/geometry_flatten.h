/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the room: one arc as chords (geometry_flatten.c), for tessellate.c. */
#ifndef FW_GEOMETRY_GEOMETRY_FLATTEN_H
#define FW_GEOMETRY_GEOMETRY_FLATTEN_H
#include "base/constants.h"
#include "geometry/segment.h"
#include "geometry/tessellate.h"

#define FW_GRID_PER_M 1e9                  /* 1 dbu = 1 nm */
#define FW_SNAP_M     (FW_SQRT_HALF / 1e9) /* what rounding moves a vertex at most */

/* floor(x + 1/2) for |x| < 2^30, without a call */
static inline int32_t fw_round_half_up(double x) {
    int32_t n = (int32_t)(x + 0.5);
    return n - ((double)n > x + 0.5);
}

typedef struct fw_geometry_chords { /* of one arc, seen from its lexicographically smaller end */
    fw_geometry_segment arc;  /* that way round, radius and sweep from the shared points alone */
    bool reversed;            /* the contour runs the other way */
    int n;                    /* chords */
    double reach;             /* radius of the inner vertices over that of the arc */
    double edge_m;            /* farthest that a chord is from the arc, before rounding */
    double area_m2, length_m; /* area between arc and chords at most; length of the chords */
    bool clean;               /* rounding leaves no vertex out and turns none the wrong way */
} fw_geometry_chords;

fw_geometry_chords fw_geometry_flatten_plan(const fw_geometry_segment *arc, double tolerance_m,
                                            fw_geometry_flattening kind);
/* the n - 1 inner vertices in the contour's direction. All must be within 2^30 dbu. */
void fw_geometry_flatten_points(const fw_geometry_chords *chords, fw_geometry_point *at);

#endif
