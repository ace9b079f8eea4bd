/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CalculiX: a program that runs in a directory of its own, what it wrote, and one run from deck to
   numbers. docs/decisions/0012-continuum.md */
#ifndef FW_CONTINUUM_SOLVER_H
#define FW_CONTINUUM_SOLVER_H
#include "base/status.h"
#include "continuum/continuum.h"
#include "continuum/mesh.h"
#include <stdbool.h>
#include <stddef.h>

/* ---- running an external program ---- */
/* Running an external program: in a directory of its own that nobody else can read, without a
   shell, with a limit of time, and gone when this process is. Private to the room
   but for study/, which counts its own instructions so. docs/decisions/0012-continuum.md */

typedef struct fw_continuum_external_room { /* a private temporary directory */
    char path[512];
    const fw_arena *work; /* a request to stop it ends the program that runs here */
} fw_continuum_external_room;

typedef enum fw_continuum_external_end {
    FW_EXTERNAL_DONE,    /* exit status 0 */
    FW_EXTERNAL_FAILED,  /* another one, or a signal */
    FW_EXTERNAL_TIMEOUT, /* killed by us */
    FW_EXTERNAL_CANCELLED
} fw_continuum_external_end;

typedef struct fw_continuum_external_run {
    fw_continuum_external_end end;
    int code;     /* exit status, or minus the signal */
    double cpu_s; /* user and system */
} fw_continuum_external_run;

/* below $TMPDIR or /tmp; FW_IO */
fw_status fw_continuum_external_room_open(const fw_arena *work, fw_continuum_external_room *room);
/* removes it and all that is in it */
void fw_continuum_external_room_close(fw_continuum_external_room *room);
fw_status fw_continuum_external_write(const fw_continuum_external_room *room, const char *name,
                                      const char *data, size_t n);
/* argv[0] is an absolute path; output and error go to `log` in the room, input is empty; one
   thread. FW_IO: it could not be started */
fw_status fw_continuum_external_call(const fw_continuum_external_room *room,
                                     const char *const *argv, const char *log, double timeout_s,
                                     fw_continuum_external_run *run);
/* the same where we are and with our own environment: for this program itself, whose arguments name
   files as we see them */
fw_status fw_continuum_external_call_here(const fw_continuum_external_room *room,
                                          const char *const *argv, const char *log,
                                          double timeout_s, fw_continuum_external_run *run);

/* What CalculiX wrote. Private to the room. */

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

/* One run of CalculiX: deck in, numbers out. Private to the room. */

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
