/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One run of CalculiX: deck in, numbers out. Private to the room. */
#ifndef FW_CONTINUUM_SOLVER_H
#define FW_CONTINUUM_SOLVER_H
#include "continuum/mesh.h"
#include "continuum/results.h"

typedef struct fw_continuum_solver_call {
    const char *program;
    const fw_text *deck;
    const int *node; /* (nnode) printed nodes, all of which must have moved in every step */
    int nnode, nstep;
    double timeout_s; /* 0: 600 */
    fw_place place;
} fw_continuum_solver_call;

typedef struct fw_continuum_solver_result {
    fw_continuum_result_step step[FW_RESULT_STEPS];
    fw_continuum_result_peak strain[FW_RESULT_STEPS], stress[FW_RESULT_STEPS];
    double cpu_s;
} fw_continuum_solver_result;

/* FW_SOLVER, FW_LIMIT, FW_IO with a diagnostic, FW_CANCELLED */
fw_status fw_continuum_solver_run(fw_arena *arena, const fw_continuum_solver_call *call,
                                  fw_diags *diags, fw_continuum_solver_result *result);

/* FW_GEOMETRY with FW-D213 */
fw_status fw_continuum_usable(const fw_continuum_material *material, double refinement,
                              fw_place place, fw_diags *diags);
fw_status fw_continuum_good_mesh(fw_arena *arena, const fw_continuum_shape *shape,
                                 double refinement, bool plane_stress, fw_place place,
                                 fw_diags *diags, fw_continuum_mesh *mesh);
#endif
