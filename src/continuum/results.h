/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What CalculiX wrote. Private to the room. */
#ifndef FW_CONTINUUM_RESULTS_H
#define FW_CONTINUUM_RESULTS_H
#include "base/status.h"
#include <stdbool.h>
#include <stddef.h>

enum { FW_RESULT_STEPS = 16, FW_RESULT_NODES = 64 };

/* of printed nodes, in the order of `node`, at the ends of the steps */
typedef struct fw_continuum_result_step {
    bool have_move[FW_RESULT_NODES], have_force[FW_RESULT_NODES];
    double move[FW_RESULT_NODES][3], force[FW_RESULT_NODES][3];
} fw_continuum_result_step;

/* the .dat file: printed displacements and forces; steps last one unit of time each. FW_SOLVER: a
   line that is not understood */
fw_status fw_continuum_results_print(const char *text, const int *node, int nnode,
                                     fw_continuum_result_step *step, int nstep);

typedef struct fw_continuum_result_peak { /* over the nodes of one field at the end of a step */
    double principal, mises;              /* greatest |principal value|; of a stress: von Mises */
    int node;                             /* where the principal value is greatest */
} fw_continuum_result_peak;

/* the .frd file: peaks of strain and stress for each step from 1; `nfound` counts the steps */
fw_status fw_continuum_results_fields(const char *text, fw_continuum_result_peak *strain,
                                      fw_continuum_result_peak *stress, int nstep, int *nfound);

/* principal values of a symmetric tensor xx, yy, zz, xy, yz, zx, ascending */
void fw_continuum_results_principal(const double tensor[6], double value[3]);

#endif
