/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What else is said of a workspace: singular poses, extents, which hinge bounds it. */
#ifndef FW_WORKSPACE_SURVEY_H
#define FW_WORKSPACE_SURVEY_H
#include "workspace/reach.h"

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
