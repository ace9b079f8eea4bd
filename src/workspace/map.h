/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Everything that is said of a six-bar's workspace under the elastic limits of one flow. */
#ifndef FW_WORKSPACE_MAP_H
#define FW_WORKSPACE_MAP_H
#include "workspace/survey.h"

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
    fw_workspace_measure volume; /* m2 rad */
    fw_workspace_survey survey;
    fw_workspace_slice
        slice[FW_SLICES]; /* at 0 and at a third and two thirds of the way to the ends */
} fw_workspace_map;

typedef struct fw_workspace_effort {
    double relative; /* width wanted of the volume */
    long most;       /* boxes for it */
    int level;       /* of the survey */
} fw_workspace_effort;
extern const fw_workspace_effort fw_workspace_usual; /* some 0.2 s */
extern const fw_workspace_effort fw_workspace_quick; /* some 50 ms, for the report */

fw_status fw_workspace_map_make(fw_arena *arena, const fw_mechanism *mechanism,
                                fw_workspace_effort effort, fw_workspace_map *map);

/* utilisation |angle|/limit of the hinge that is nearest to its limit at a pose, by plain inverse
   kinematics; FW_NONE out of reach */
int fw_workspace_governs(const fw_workspace_map *map, const fw_mechanism *mechanism,
                         const double pose[3], double *utilisation);

#endif
