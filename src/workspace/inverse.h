/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The six-bar as two dyads, set up once per mechanism. Private to the room and its tests. */
#ifndef FW_WORKSPACE_INVERSE_H
#define FW_WORKSPACE_INVERSE_H
#include "workspace/workspace.h"

typedef struct fw_workspace_dyad {
    fw_geometry_vec2 base;        /* A or F, m */
    double l_m, m_m;              /* link lengths, from the base outward */
    double alpha0_rad, beta0_rad; /* direction of the first link, elbow angle, as drawn */
    double sign;                  /* assembly branch: sign of the elbow angle */
} fw_workspace_dyad;

typedef struct fw_workspace_six_bar {
    fw_workspace_dyad left, right; /* A-B-C and F-E-D */
    fw_geometry_vec2 centre;       /* platform's centre of mass as drawn */
    fw_geometry_vec2 to_c, to_d;   /* from it to C and D */
    double start_rad[FW_SIX];      /* joint angles as drawn */
} fw_workspace_six_bar;

bool fw_workspace_six_bar_set_up(const fw_mechanism *mechanism, fw_workspace_six_bar *out);
bool fw_workspace_six_bar_solve(const fw_workspace_six_bar *six_bar, double x_m, double y_m,
                                double phi_rad, double angle_rad[FW_SIX], int *leg);
/* id of the joint or driver that takes freedom from the platform, NULL when there is none */
fw_status fw_workspace_six_bar_foreign_joint(fw_arena *arena, const fw_mechanism *mechanism,
                                             const char **id);

#endif
