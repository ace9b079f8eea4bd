/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elbows and other assemblies. Private to assembly/. */
#ifndef FW_ASSEMBLY_BRANCH_H
#define FW_ASSEMBLY_BRANCH_H
#include "assembly/closure.h"

/* dyads whose mirror image may close too; (*count) of at most npin */
fw_status fw_assembly_elbows_find(fw_arena *arena, const fw_mechanism *mechanism,
                                  fw_assembly_elbow **elbow, int *count);
/* +1, -1, or 0 where it is flat; q (3 nbody) SI */
int fw_assembly_elbow_side(const fw_mechanism *mechanism, const double *q,
                           const fw_assembly_elbow *elbow);
fw_status fw_assembly_alternatives_find(fw_arena *arena, const fw_mechanism *mechanism,
                                        fw_diags *diags, fw_assembly *found);

#endif
