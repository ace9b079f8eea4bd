/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The set of platform poses that the hinges' limits leave: its volume, areas at constant rotation
   and extents, each as an interval that is proved to hold it. */
#ifndef FW_WORKSPACE_REACH_H
#define FW_WORKSPACE_REACH_H
#include "workspace/loop.h"

/* The set of platform poses that the hinges' limits leave: its volume, areas at constant rotation
   and extents, each as an interval that is proved to hold it. */

/* of the joint angle A..F, the free angle taken off; rad */
typedef struct fw_workspace_reach_limits {
    double low_rad[FW_SIX], high_rad[FW_SIX];
} fw_workspace_reach_limits;

typedef struct fw_workspace_bound { /* a range whose ends are known within rounding */
    fw_maths_interval low, high;
} fw_workspace_bound;

/* what the limits say of the rotations psi, and of the right elbow */
typedef struct fw_workspace_allowed {
    fw_workspace_bound psi[FW_SIX]; /* rad */
    fw_workspace_bound d2; /* squared reach of the right leg, m2: the same as that of its elbow */
} fw_workspace_allowed;
fw_workspace_allowed fw_workspace_limits_allow(const fw_workspace_loop *loop,
                                               const fw_workspace_reach_limits *limits);

fw_workspace_reach_limits fw_workspace_limits_symmetric(const double limit_rad[FW_SIX]);

typedef struct fw_workspace_measure {
    fw_maths_interval value; /* m2 rad of a volume, m2 of an area */
    long boxes;              /* looked at; parts that a box decides beforehand are not */
    int level;               /* most halvings of every coordinate */
    bool reached;            /* the relative width asked for */
} fw_workspace_measure;

/* stops when width <= relative * value.lo, or before more than `most` boxes would be looked at */
typedef struct fw_workspace_proof_effort {
    double relative;
    long most;
} fw_workspace_proof_effort;

fw_status fw_workspace_reach_volume(fw_arena *arena, const fw_workspace_loop *loop,
                                    const fw_workspace_reach_limits *limits,
                                    fw_workspace_proof_effort effort, fw_workspace_measure *volume);

/* what a node of the tree of a search is, as its character in the text */
enum {
    FW_NODE_INSIDE = 'i',
    FW_NODE_OUTSIDE = 'o',
    FW_NODE_CUT = 'c', /* a leaf that is neither, or of which neither is proved */
    FW_NODE_HALVED = 'h'
};

/* What a checker needs besides mechanism, limits and bracket: the box of rotations of A, B, C (rad)
   and the tree of its halvings: a node is i (inside), o (outside), c (a leaf that is cut) or h
   (halved along all three coordinates, its eight parts follow). A box without width in a coordinate,
   where the limits leave nothing, has the tree o. */
typedef struct fw_workspace_volume_proof {
    fw_workspace_box3 box;
    const char *tree;
} fw_workspace_volume_proof;

/* the same bits as fw_workspace_reach_volume, and what proves them */
fw_status fw_workspace_reach_certify(fw_arena *arena, const fw_workspace_loop *loop,
                                     const fw_workspace_reach_limits *limits,
                                     fw_workspace_proof_effort effort, fw_workspace_measure *volume,
                                     fw_workspace_volume_proof *proof);
fw_status fw_workspace_reach_area(fw_arena *arena, const fw_workspace_loop *loop,
                                  const fw_workspace_reach_limits *limits, double phi_rad,
                                  fw_workspace_proof_effort effort, fw_workspace_measure *area);

typedef enum fw_workspace_inside { FW_OUTSIDE, FW_INSIDE, FW_CUT } fw_workspace_inside;
/* where a box of joint rotations stands, for `dimensions` 3 (A, B, C) or 2 (A, B at rotation phi).
   share: of the box that is within the limits. open (FW_WANT_*): in, what is not proved yet of a
   box around this one, with FW_WANT_REST if all of `known` is to be set; the rest is not looked at.
   Out: what is not proved of this box, unless it is outside. */
fw_workspace_inside fw_workspace_reach_judge(const fw_workspace_loop *loop,
                                             const fw_workspace_allowed *allowed, int dimensions,
                                             double phi_rad, const fw_workspace_box3 *box,
                                             unsigned *open, fw_workspace_loop_box *known,
                                             fw_maths_interval *share);
/* Which of the parts of a cut box, halved along every coordinate at `between` (its middle within
   rounding), its forms decide already: bits, of which bit i is set for the upper half along i. open
   and known: what fw_workspace_reach_judge left of the box. */
void fw_workspace_reach_parts(const fw_workspace_allowed *allowed, int dimensions,
                              const fw_workspace_box3 *box, const double between[3], unsigned open,
                              const fw_workspace_loop_box *known, unsigned *inside,
                              unsigned *outside);
/* all rotations of A, B (and C) that the limits of these hinges and the branch leave */
fw_workspace_box3 fw_workspace_reach_whole(const fw_workspace_loop *loop,
                                           const fw_workspace_allowed *allowed);

#endif
