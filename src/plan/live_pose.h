/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the bodies of a mechanism are when one of them is put somewhere. Private to live*.c and its
   tests. */
#ifndef FW_PLAN_LIVE_POSE_H
#define FW_PLAN_LIVE_POSE_H
#include "mechanism/mechanism.h"

typedef struct fw_plan_posed {
    double *q;         /* (3 nbody) m, rad */
    double *angle_rad; /* (npin) phi_b - phi_a - free angle */
    double at[3];      /* displacement of the body from rest that q has: x m, y m, phi rad */
    bool reachable;    /* that is the one that was asked for */
    bool closed_form;
    double share;       /* closed form: of the way from rest to what was asked for; else NaN */
    const char *reason; /* why it is not reachable, a sentence; NULL */
} fw_plan_posed;

/* size of the mechanism at rest: larger extent of its pins and centres of mass, m */
double fw_plan_pose_size(const fw_mechanism *mechanism);
/* the body that is meant without a name: the platform, else the heaviest; FW_NONE: no bodies */
int fw_plan_pose_body(const fw_mechanism *mechanism);
/* asked: displacement of `body` from rest (x m, y m, phi rad), finite; phi NaN: any (of a
   six-bar's platform: as drawn). from (3 nbody): poses of the
   other bodies to start from, NULL: at rest. *posed is in `arena`. FW_SOLVER: no pose was found. */
fw_status fw_plan_pose_solve(fw_arena *arena, const fw_mechanism *mechanism, int body,
                             const double asked[3], const double *from, fw_plan_posed *posed);
#endif
