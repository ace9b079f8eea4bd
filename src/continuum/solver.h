/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CalculiX: the mesh of one flexure and what an input deck is made of; the program that runs in a
   directory of its own, what it wrote, and one run from deck to numbers. docs/decisions/0012-continuum.md */
#ifndef FW_CONTINUUM_SOLVER_H
#define FW_CONTINUUM_SOLVER_H
#include "base/status.h"
#include "continuum/continuum.h"
#include "geometry/contour.h"
#include <stdbool.h>
#include <stddef.h>

/* ---- the mesh ----

   Structured mesh of one flexure: a single lattice of quadratic bricks from the far face of the
   first root block to that of the second. */

/* Lattice i along (0 .. 2 ni), j across, right to left (0 .. 2 nj), k up (0 .. 2 nk), half steps;
   nodes where at most one index is odd. The plane k = 0 is the middle of the depth. */
typedef struct fw_continuum_mesh {
    int ni, nj, nk;
    int quiet;     /* elements next to the rigid faces where no strain is looked for */
    int corner;    /* first and last element across that is not rigid at a far face; 0: all are */
    double *x, *y; /* ((2 ni + 1) (2 nj + 1)), m, of the profile */
    double *z;     /* (2 nk + 1), m, from the middle of the depth to its face */
    int *number;   /* ((2 ni + 1) (2 nj + 1) (2 nk + 1)), from 1; 0: no node */
    int nnode, nelement;
    double depth_m; /* 2 z[2 nk] */
} fw_continuum_mesh;

/* FW_GEOMETRY with *why set when fillets or blocks do not fit */
fw_status fw_continuum_mesh_build(fw_arena *arena, const fw_continuum_shape *shape,
                                  double refinement, bool plane_stress, fw_continuum_mesh *mesh,
                                  const char **why);
/* the same with more elements along a fillet (8), through half the width (3 to 5) and through half
   the depth (2 or 3) than at refinement 1, where strains at the fillets are looked at; for
   tools/solids */
typedef struct fw_continuum_finer {
    int fillet, across, layers;
} fw_continuum_finer;
fw_status fw_continuum_mesh_finer(fw_arena *arena, const fw_continuum_shape *shape,
                                  double refinement, bool plane_stress, fw_continuum_finer more,
                                  fw_continuum_mesh *mesh, const char **why);
size_t fw_continuum_lattice(const fw_continuum_mesh *mesh, int i, int j, int k);
/* is lattice point (i, j) on the rigid face of the first (end 0) or second root? */
bool fw_continuum_rigid(const fw_continuum_mesh *mesh, int end, int i, int j);
/* the 20 nodes of a brick in the order of CalculiX: (di, dj, dk) of node a */
extern const signed char fw_continuum_brick[20][3];

typedef struct fw_continuum_quality {
    double least_jacobian; /* least det J of an element over its greatest; <= 0: not valid */
    double volume_m3;      /* of the half that is meshed */
} fw_continuum_quality;
fw_continuum_quality fw_continuum_mesh_quality(const fw_continuum_mesh *mesh);

/* exact outline of the profile; area by fw_geometry_contour_area */
fw_status fw_continuum_outline(fw_arena *arena, const fw_continuum_shape *shape,
                               fw_geometry_contour *contour, const char **why);

/* ---- CalculiX input decks: um, uN, MPa ----

   Not mm and N: there CalculiX stops with moments off by a percent at finite rotation, whatever
   residual is asked for. */

/* numbers as CalculiX reads them: at most 20 characters a field */
void fw_continuum_deck_number(fw_text *deck, double value);
void fw_continuum_deck_head(fw_text *deck, const char *what);
/* nodes, numbered from `first`, placed by rotation and translation; um */
void fw_continuum_deck_nodes(fw_text *deck, const fw_continuum_mesh *mesh, fw_geometry_pose pose,
                             int first);
void fw_continuum_deck_bricks(fw_text *deck, const fw_continuum_mesh *mesh, int first_node,
                              int first_element);
/* *MATERIAL, *ELASTIC, *ORIENTATION for a crystal turned by turn_rad more, *SOLID SECTION */
void fw_continuum_deck_material(fw_text *deck, const fw_continuum_material *material,
                                const char *name, const char *elset, double turn_rad);
/* node numbers for which `take` answers yes, as data lines */
typedef bool (*fw_continuum_deck_take)(const fw_continuum_mesh *mesh, int i, int j, int k);
void fw_continuum_deck_set(fw_text *deck, const fw_continuum_mesh *mesh, int first_node,
                           fw_continuum_deck_take take);
bool fw_continuum_deck_root_first(const fw_continuum_mesh *mesh, int i, int j, int k);
bool fw_continuum_deck_root_second(const fw_continuum_mesh *mesh, int i, int j, int k);
/* but no rigid face */
bool fw_continuum_deck_middle(const fw_continuum_mesh *mesh, int i, int j, int k);
bool fw_continuum_deck_field(const fw_continuum_mesh *mesh, int i, int j, int k);

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
