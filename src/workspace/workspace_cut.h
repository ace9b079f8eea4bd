/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much of a box lies on one side of a plane. Private to the room and its tests. */
#ifndef FW_WORKSPACE_WORKSPACE_CUT_H
#define FW_WORKSPACE_WORKSPACE_CUT_H
#include "maths/maths_interval.h"

/* share of the box |d_i| <= 1 with p[0] d_0 + p[1] d_1 + p[2] d_2 <= t; p >= 0, in any order; p = 0
   stands for a dimension less. The interval holds the exact share. */
fw_maths_interval fw_workspace_cut_share(const double p[3], double t);

#endif
