/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The set of platform poses that the hinges' limits leave: its volume, areas at constant rotation
   and extents, each as an interval that is proved to hold it. What else is said of a workspace: singular poses, extents, which
   hinge bounds it. */
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

/* ---- what else is said of it (survey.c) ---- */

enum { FW_TRIANGLES = 20 };

/* With these three hinges passive and the other three driven, the platform cannot be held where the
   three are in line: twice the triangle's area is 0 there. The conditioning length is that over the
   triangle's longest side: the arm with which the least favourable force is held. */
typedef struct fw_workspace_triangle {
    int hinge[3];
    fw_maths_interval area2_m2; /* holds its value, at every pose */
    fw_maths_interval length_m; /* holds the least conditioning length */
    double pose[3];             /* where it is at most length_m.hi; x m, y m, phi rad */
    bool regular;               /* proved: in line at no pose */
    bool positive, negative;    /* proved at poses of the set; both: singular in between */
} fw_workspace_triangle;

typedef struct fw_workspace_regularity {
    /* of the elbow's angle, left and right leg: 0 is a serial singularity */
    fw_maths_interval sine[2];
    bool regular[2];
    fw_workspace_triangle passive[FW_TRIANGLES];
    long boxes;
} fw_workspace_regularity;

typedef struct fw_workspace_survey {
    fw_workspace_regularity singular;     /* over the reachable set */
    double share[FW_SIX];                 /* of the boundary, by hinge; adds up to 1; an estimate */
    double exponent;                      /* d ln V / d ln limits, an estimate */
    fw_maths_interval least[3], most[3];  /* where the ends of x, y (m) and phi (rad) lie, proved */
    double least_at[3][3], most_at[3][3]; /* poses near them, proved to be inside */
} fw_workspace_survey;

/* boxes of 2^-level of the limits' ranges */
fw_status fw_workspace_reach_survey(const fw_arena *arena, const fw_workspace_loop *loop,
                                    const fw_workspace_reach_limits *limits, int level,
                                    bool singularities, fw_workspace_survey *survey);
/* the same singularities over a box of poses */
fw_status fw_workspace_required_survey(const fw_arena *arena, const fw_workspace_loop *loop,
                                       const fw_workspace_box3 *box,
                                       fw_workspace_regularity *singular);

/* ends of x, y and phi, each within `relative` of its distance from the drawn pose, or as near as
   `most` boxes lead */
fw_status fw_workspace_reach_extents(fw_arena *arena, const fw_workspace_loop *loop,
                                     const fw_workspace_reach_limits *limits, double relative,
                                     long most, fw_workspace_survey *survey);

/* Everything that is said of a six-bar's workspace under the elastic limits of one flow. */

enum { FW_SLICES = 5 };

typedef struct fw_workspace_slice {
    double phi_rad;
    fw_workspace_measure area; /* m2 */
} fw_workspace_slice;

typedef struct fw_workspace_map {
    const char *none; /* why there is nothing below; NULL: there is */
    fw_workspace_loop loop;
    double limit_rad[FW_SIX];
    fw_workspace_reach_limits limits;
    fw_workspace_measure volume;     /* m2 rad */
    fw_workspace_volume_proof proof; /* of it; no tree where the effort asks for none */
    fw_workspace_survey survey;
    /* at 0 and at a third and two thirds of the way to the ends */
    fw_workspace_slice slice[FW_SLICES];
} fw_workspace_map;

typedef struct fw_workspace_effort {
    double relative; /* width wanted of the volume */
    long most;       /* boxes for it */
    int level;       /* of the survey */
    bool singularities;
    bool certified; /* the volume's tree is kept for the certificate */
} fw_workspace_effort;
extern const fw_workspace_effort fw_workspace_usual; /* some 0.2 s */
extern const fw_workspace_effort fw_workspace_quick; /* some 20 ms, for the report */

fw_status fw_workspace_map_make(fw_arena *arena, const fw_mechanism *mechanism,
                                fw_workspace_effort effort, fw_workspace_map *map);

/* utilisation |angle|/limit of the hinge that is nearest to its limit at a pose, by plain inverse
   kinematics; FW_NONE out of reach */
int fw_workspace_governs(const fw_workspace_map *map, const fw_mechanism *mechanism,
                         const double pose[3], double *utilisation);

#endif
