/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh of one flexure, and what an input deck is made of. Private to the room. */
#ifndef FW_CONTINUUM_MESH_H
#define FW_CONTINUUM_MESH_H
#include "continuum/continuum.h"
#include "geometry/contour.h"

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

#endif
