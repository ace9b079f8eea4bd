/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Release: an etch runs sideways, below what stands, from every opening of the device layer, and takes
   the layer that holds it. A point is free when the etch has run its distance to the nearest opening.
   So of every part: the distance of its worst point, after which it is free as a whole; of what must
   stay: the reach at which nothing, or less than a stated share, of its bond is left. The window is
   between what frees all that moves and what loses the first of what stays.

   Distances are those of exact lines and arcs, with proved bounds. Theory: docs/theory/release.md. */
#ifndef FW_RELEASE_RELEASE_H
#define FW_RELEASE_RELEASE_H
#include "layout/layout.h"

typedef enum fw_release_duty {
    FW_RELEASE_MOVES, /* bodies and flexures: no point of them may stay bonded */
    FW_RELEASE_STAYS, /* bases, frame, stators with leads and pads: must not come off */
    FW_RELEASE_EITHER /* tethers: broken before use; frame and bases where the whole may come off */
} fw_release_duty;

enum { FW_RELEASE_STEPS = 64 };

typedef struct fw_release_part {
    const char *label; /* "link AB", "frame" */
    fw_release_duty duty;
    fw_layout_role role;
    int body, joint; /* as of its pieces */
    int piece;       /* the first of them */
    double area_m2;
    /* distance of the worst point from the nearest opening: found at `at`, and proved nowhere more
       than most_m */
    double reach_m, most_m;
    fw_geometry_vec2 at;
    /* of what stays: area that is still bonded after a reach of k/FW_RELEASE_STEPS of reach_m */
    double bonded_m2[FW_RELEASE_STEPS + 1];
    double kept_m; /* reach at which the stated share of the bond is left; NaN: need not stay */
} fw_release_part;

typedef struct fw_release {
    fw_release_part *part; /* (npart) in the order of the pieces */
    int npart;
    int own; /* the first so many are of this drawing; what is behind them lies on other dies */
    double share; /* of its bond that what stays must keep */
    /* the window, as drawn: parts -1 and NaN where there is none of the kind */
    int slowest;      /* what moves and is free last */
    double needed_m;  /* no point of it is farther from an opening */
    int weakest;      /* what stays and is lost first */
    double lost_m;    /* the reach at which its bond falls below the share */
    int edges, boxes; /* of the search: what it cost */
} fw_release;

/* Distances of every part of a layout that is drawn. islands: what stands by itself is there (else it
   falls out, and is not in the mask). whole: the flow takes the layer from below everything, so that bases
   and frame may come off, in one piece with the device; islands may not. share: 0 to below 1. Lettering and marks are openings in what
   they lie in. Error of reach_m: at most 10 nm or 5e-4 of itself, stated part by part by most_m;
   of bonded_m2: below 2 % of the area. */
fw_status fw_release_solve(fw_arena *arena, const fw_layout *layout, bool islands, bool whole,
                           double share, const fw_release **release);
/* area of a part that is still bonded after a reach; between two steps by a straight line */
double fw_release_bonded(const fw_release_part *part, double reach_m);

/* distances to the nearest opening at (columns x rows) places in the middle of equal cells of the
   die, from its lower left corner row by row; negative: no material there */
typedef struct fw_release_map {
    fw_geometry_box box;
    int columns, rows;
    float *distance_m; /* (rows x columns) */
} fw_release_map;
fw_status fw_release_map_make(fw_arena *arena, const fw_layout *layout, bool islands, int columns,
                              const fw_release_map **map);

/* ---- what holds ----
   Between the first place that is free and the last: what each body hangs on when it lets go, and the
   anchors of each mechanism. Reaches are as drawn: the foot of the walls comes to them. */

typedef struct fw_release_body_hold {
    int body, group;
    const char *label;
    double free_m;   /* nothing of it is bonded any more */
    const char **by; /* (nby) what it then hangs on: bonded parts, bases at hinges, tethers */
    int nby;
    int holders; /* of them, each tether counted: 1: its last anchor; 0: it floats */
} fw_release_body_hold;

typedef struct fw_release_group_hold { /* bodies that flexures join */
    double hangs_m;        /* from here on nothing of it is bonded: it hangs on its anchors alone */
    const char *last_bond; /* that let go then */
    const char *at;        /* "hinge A, hinge F": to bases; "": none */
    int ground_hinges, tethers;
    /* of base and frame what keeps a bond longest, and how long; NULL, NaN: it has no anchor */
    const char *last_anchor;
    double last_anchor_m;
} fw_release_group_hold;

typedef struct fw_release_hold {
    fw_release_body_hold *body; /* (nbody) in the order in which they let go */
    int nbody;
    fw_release_group_hold *group; /* (ngroup) */
    int ngroup;
} fw_release_hold;

fw_status fw_release_hold_find(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_release *release, const fw_release_hold **out);

/* ---- hollows in a carrier: release_cavity.c ---- */

/* Hollows in a carrier below what moves, and the ground that is left below what is held: for layers that are bonded
   to a carrier and are free where it is hollow, not where an etch has run below them.

   On square cells of a step s. A cell is hollow where one that a moving part touches is within k = ceil(margin/s) columns
   and rows; gaps of ground narrower than the wall are hollow too. So every point of what moves is at least the margin inside,
   and no more than 2 s farther than that; every edge of the outlines between two corners that point outward is longer
   than twice the margin. Theory: docs/theory/plates.md. */

typedef struct fw_release_cavity_asked {
    double margin_m; /* around everything that moves */
    double wall_m;   /* ground narrower than this between two hollows does not stand */
    double step_m;
    bool drawn_only; /* the outlines alone: neither ground nor the widest square is asked for */
} fw_release_cavity_asked;

typedef struct fw_release_ground { /* below a part that must stay */
    const char *label;
    fw_layout_role role;
    int body;
    double area_m2;         /* of the part */
    double bonded_m2;       /* of it on ground: cells that lie in it whole */
    fw_geometry_box square; /* the largest on ground; x0 = x1: it stands on nothing */
} fw_release_ground;

typedef struct fw_release_cavity {
    fw_geometry_region hollow; /* outlines without their holes, counter-clockwise */
    fw_geometry_region land;   /* the holes, counter-clockwise: ground within a hollow */
    fw_release_ground *ground; /* (nground) */
    int nground;
    double area_m2;         /* hollow */
    fw_geometry_box widest; /* the largest square within it */
} fw_release_cavity;

/* Of a layout that is drawn. A hollow within a land within a hollow is joined with the outer one: the land goes, and
   what stands on it has no ground. Cost: cells times parts. Test: test_cavity.c, against distances to the exact outlines.
   FW_LIMIT: a step too fine for the drawing */
fw_status fw_release_cavity_make(fw_arena *arena, const fw_layout *layout,
                                 const fw_release_cavity_asked *asked, fw_release_cavity *cavity);

/* the largest square within part i of the drawing that keeps clear_m from its edges and from lettering and marks upon it, to
   a step; x0 = x1: there is none */
fw_status fw_release_square_in(fw_arena *arena, const fw_layout *layout, int piece, double clear_m,
                               double step_m, fw_geometry_box *square);

#endif
