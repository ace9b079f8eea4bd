/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of independent coordinates. */
#ifndef FW_ASSEMBLY_INDEPENDENT_H
#define FW_ASSEMBLY_INDEPENDENT_H
#include "multibody/system.h"
#include "maths/dense.h"

typedef struct fw_assembly_coordinate { /* of a body: 0 x, 1 y, 2 phi */
    int body, axis;
} fw_assembly_coordinate;

typedef struct fw_assembly_coordinate_choice {
    fw_assembly_coordinate *item; /* (count) count = degrees of freedom */
    int count;
    double condition; /* largest scaled velocity of any motion over the rates that give it; >= 1 */
    bool automatic;   /* chosen by pivoting, not asked for */
    const char *text; /* "AB.phi,CD.phi" */
    const char *better; /* the automatic choice where it is ten times better conditioned, or NULL */
    double better_condition;
} fw_assembly_coordinate_choice;

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
