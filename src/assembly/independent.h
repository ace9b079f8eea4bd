/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of independent coordinates. Private to assembly/. */
#ifndef FW_ASSEMBLY_INDEPENDENT_H
#define FW_ASSEMBLY_INDEPENDENT_H
#include "assembly/kinematics.h"
#include "multibody/system.h"
#include "maths/dense.h"

/* space: singular values of the scaled G, of which `rank` count; asked: as in the options, or
   NULL */
fw_status fw_assembly_independent_choose(fw_arena *arena, const fw_mechanism *mechanism,
                                         const fw_maths_singular *space, int rank,
                                         const char *asked, fw_diags *diags,
                                         fw_assembly_coordinate_choice *choice);
/* N_I (count x count): rows of the null space at the chosen coordinates */
fw_status fw_assembly_independent_rows(fw_arena *arena, const fw_maths_singular *space, int rank,
                                       const fw_assembly_coordinate_choice *choice,
                                       fw_maths_singular *rows);

#endif
