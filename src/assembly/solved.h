/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bare result of the position problem. Private to assembly/. */
#ifndef FW_ASSEMBLY_SOLVED_H
#define FW_ASSEMBLY_SOLVED_H
#include "assembly/assembly.h"

typedef struct fw_assembly_solved {
    double *q; /* (3 nbody) SI; the least mismatch where there is no assembly */
    int iterations, restarts;
} fw_assembly_solved;
/* Psi(q, 0) = 0 from guess (3 nbody) SI; FW_SOLVER with its reason */
fw_status fw_assembly_close(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                            fw_diags *diags, fw_assembly_solved *out);
/* rank.c: degrees of freedom at q (3 nbody) SI */
fw_status fw_assembly_rank(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                           fw_diags *diags, fw_assembly_rank_result *out);

#endif
