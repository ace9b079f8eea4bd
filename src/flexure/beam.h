/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A beam of any shape: centre line of straight pieces and arcs, width that varies along it, a
   modulus that may depend on direction, two roots that give. Its centre of elastic weights and
   compliance, and what it does at any rotation. Theory: docs/theory/beams.md. */
#ifndef FW_FLEXURE_BEAM_H
#define FW_FLEXURE_BEAM_H
#include "base/arena.h"
#include "base/status.h"
#include "flexure/flexure.h"
#include <stdbool.h>

typedef struct fw_flexure_beam_piece {
    double length_m, curvature_per_m; /* > 0: the tangent turns to the left as s grows */
    double kink_rad;                  /* rigid corner before this piece: turn of the tangent */
    double width_m[3];                /* start, middle, end: the parabola through them */
} fw_flexure_beam_piece;

/* of the section at s_m from the start of a piece; smooth within a piece */
typedef double fw_beam_course(const void *context, int piece, double s_m);

typedef struct fw_flexure_beam {
    const fw_flexure_beam_piece *piece;
    int npiece;
    double x_m, y_m, psi_rad; /* start of the centre line and its tangent there */
    double depth_m, youngs_Pa, shear_Pa;
    double depth_factor; /* EI over that of plane stress; 0 is taken as 1 */
    double root_m[2];    /* length dL added at each end: a point rotation dL/EI */
    bool cubic;          /* 1/E = a0 + a1 cos 4(psi + orientation), not 1/youngs_Pa; 1/G likewise */
    double a0_per_Pa, a1_per_Pa, orientation_rad; /* orientation: of the frame's x from [100] */
    double g0_per_Pa, g1_per_Pa;                  /* both 0: 1/shear_Pa */
    double lost_per_Pa[2], lost_m[2]; /* what the first and the second end take of 1/E in bending, s
                                         from it: lost exp(-s/lost_m); 0: nothing */
    bool inextensible;                /* no axial and no shear strain */
    double along; /* EA is 1 + this times as large as section and modulus say; bending is not */
    fw_beam_course *width;   /* NULL: width_m of the pieces */
    fw_beam_course *stiffer; /* EI over that of plane stress, times depth_factor; NULL: 1 */
    const void *context;
} fw_flexure_beam;

typedef struct fw_flexure_beam_pose {
    double x_m, y_m, psi_rad;
} fw_flexure_beam_pose;

/* centre line and section at one place of the beam as it was made */
typedef struct fw_flexure_beam_section {
    fw_flexure_beam_pose pose;
    double width_m;
    double bend_per_Nm2;             /* 1/EI */
    double axial_per_N, shear_per_N; /* 1/EA, 1/(kGA), k = 5/6; 0 when inextensible */
} fw_flexure_beam_section;

/* small displacements of the second root against the first: (theta, ux, uy) = c (M, Fx, Fy), force
   and displacement at W, in the beam's frame */
typedef struct fw_flexure_beam_linear {
    double centre_m[2];            /* W: centre of elastic weights 1/EI, roots included */
    double c[3][3];                /* rad/(N m), rad/N = m/(N m), m/N */
    double compliance_centre_m[2]; /* where a pure moment leaves the point at rest */
    double length_m, turn_rad;     /* of the centre line; turn with the kinks */
    double chord_m, chord_rad;     /* from the first root to the second: length, direction */
    fw_flexure_beam_pose end;      /* of the centre line */
    double error;                  /* relative, of centre (against length) and compliance */
} fw_flexure_beam_linear;

/* strip of a flexure in the flexure's frame (flexure.h), with the corrections of its closed form:
   depth, curvature and roots. `piece` (one) must live as long as the beam. */
void fw_flexure_beam_of_flexure(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                                fw_flexure_beam_piece *piece, fw_flexure_beam *out);

/* all of its stiffness times `by`, where above 0 */
void fw_flexure_beam_scale(fw_flexure_beam *beam, double by);

/* pose at the start of each piece, kinks included, and at the end: npiece + 1 */
void fw_flexure_beam_poses(const fw_flexure_beam *beam, fw_flexure_beam_pose *out);
/* at s_m from the start of a piece that starts at `start` */
void fw_flexure_beam_at(const fw_flexure_beam *beam, int piece, const fw_flexure_beam_pose *start,
                        double s_m, fw_flexure_beam_section *out);
void fw_flexure_beam_compliance(const fw_flexure_beam *beam, fw_flexure_beam_linear *out);

/* ---- Gauss-Legendre rules on [0, 1]; private to the room ---- */

enum { FW_GAUSS_MOST = 16 };

/* n nodes in rising order and their weights, which add up to 1 */
void fw_flexure_gauss_rule(int n, double *node, double *weight);
/* a[i * n + j] = integral of the j-th Lagrange polynomial of the nodes from 0 to node i: the
   collocation method of order 2 n */
void fw_flexure_gauss_integrals(int n, const double *node, const double *weight, double *a);

/* ---- the geometrically exact beam (Reissner) ----

   What a beam does at any rotation under a moment and a dead force at its second end, given any
   three of its end's six unknowns.

   Everything is in the beam's frame, which the first root holds. The end is watched at a point of
   the second body, W as the beam was made unless told otherwise: twist (theta, ux, uy) is the
   rotation of the second body and the displacement of that point, wrench (M, Fx, Fy) acts on the
   second body at that point where it now is; work is M dtheta + Fx dux + Fy duy. */

typedef enum fw_flexure_elastica_end {
    FW_END_THETA,
    FW_END_UX,
    FW_END_UY,
    FW_END_M,
    FW_END_FX,
    FW_END_FY
} fw_flexure_elastica_end;

typedef struct
    fw_flexure_elastica_task { /* three different ends and their values, rad, m, N m, N */
    fw_flexure_elastica_end given[3];
    double value[3];
} fw_flexure_elastica_task;

typedef enum fw_flexure_elastica_code {
    FW_ELASTICA_OK,
    FW_ELASTICA_ROUGH, /* solved, but the error stays above the tolerance on the finest mesh */
    FW_ELASTICA_LIMIT, /* the way from the unloaded beam ends at `reached` of the values: a limit
                          point or a branching; the result is the last state before it */
    FW_ELASTICA_LOOSE, /* what is given does not hold the beam, or contradicts its rigidity */
    FW_ELASTICA_FAILED /* not finite, or no convergence from the state it was to start from */
} fw_flexure_elastica_code;

typedef struct fw_flexure_elastica_result {
    fw_flexure_elastica_code code;
    double twist[3], wrench[3];
    double stiffness[3]
                    [3]; /* d wrench/d twist; not a number where the beam has a rigid direction */
    double start_Nm, start_rad; /* moment on the first body's side of the first root; its rotation,
                                   other than 0 when hinged */
    double twist_error[3], wrench_error[3]; /* absolute; 0 where given */
    double error;                           /* relative, of wrench and twist as a whole */
    double stability; /* the tangent's determinant over that of the unloaded beam: 0 at a limit
                         point of what is given, > 0 on the primary branch before the first */
    double reached;   /* part of the values reached, 1: all */
    int passes, steps, mesh; /* element sweeps over the coarse mesh, load steps, elements used */
} fw_flexure_elastica_result;

typedef struct fw_flexure_elastica fw_flexure_elastica;

/* Tables of one beam and room for its solutions: all memory is taken here, some 50 kB a piece. The
   beam itself must live as long; one thread at a time. point_m NULL: W. hinged: the first root
   turns freely about the start of the centre line. */
fw_status fw_flexure_elastica_new(fw_arena *arena, const fw_flexure_beam *beam,
                                  const double *point_m, bool hinged, fw_flexure_elastica **out);

/* From the last solution if there is one and `warm`, otherwise from the unloaded beam along its
   primary branch. tolerance: relative error wanted, 1e-13 to 1e-3. */
void fw_flexure_elastica_solve(fw_flexure_elastica *e, const fw_flexure_elastica_task *task,
                               double tolerance, bool warm, fw_flexure_elastica_result *out);
void fw_flexure_elastica_of_twist(fw_flexure_elastica *e, const double twist[3], double tolerance,
                                  bool warm, fw_flexure_elastica_result *out);
/* First of all near the state of another law, then as above. Where not all of the place is given the
   state found may be one that only what else holds the body keeps: pressed beyond its buckling load. */
void fw_flexure_elastica_near(fw_flexure_elastica *e, const fw_flexure_elastica_task *task,
                              const double twist[3], const double wrench[3], double tolerance,
                              fw_flexure_elastica_result *out);
/* From the last solution on its own mesh, for the state inside alone: of the same ends, values near
   those. Error that of the last that said it; false: ask afresh. A third of the cost. out: twist, wrench and
   start_Nm alone */
bool fw_flexure_elastica_again(fw_flexure_elastica *e, const fw_flexure_elastica_task *task,
                               double tolerance, fw_flexure_elastica_result *out);
/* Where other flexures hold the bodies: given are the rotation, the displacement along a direction
   (unit vector) and the force across it; twist and wrench have these, and the rest of another law.
   Only near that. */
void fw_flexure_elastica_held(fw_flexure_elastica *e, const double twist[3], const double wrench[3],
                              const double along[2], double tolerance,
                              fw_flexure_elastica_result *out);
void fw_flexure_elastica_of_wrench(fw_flexure_elastica *e, const double wrench[3], double tolerance,
                                   bool warm, fw_flexure_elastica_result *out);

/* The coarser mesh of the last solution; and that solutions begin on no coarser one than that (0: any). A beam
   that is hardly bent is solved on the coarsest mesh, since its state has no error there; its tangent has. */
int fw_flexure_elastica_level(const fw_flexure_elastica *e);
void fw_flexure_elastica_no_coarser(fw_flexure_elastica *e, int level);

/* --- of the last solution ----------------------------------------------------------------- */
typedef struct fw_flexure_elastica_state {
    double s_m;                /* along the centre line of the whole beam */
    fw_flexure_beam_pose pose; /* where the section is now */
    double rotation_rad, moment_Nm, axial_N, shear_N;
    double strain[2]; /* of the fibres to the left (+t/2) and to the right of the tangent, by
                         plane sections: axial/EA -+ t/2 moment/EI. Fillets and the
                         hyperbolic law of thick arcs are the caller's */
} fw_flexure_elastica_state;

void fw_flexure_elastica_at(fw_flexure_elastica *e, double s_m, fw_flexure_elastica_state *out);
/* moment and axial force at n places, ascending, 0..1 of the length; much cheaper than each by itself */
void fw_flexure_elastica_along(fw_flexure_elastica *e, int n, const double *part, double *moment_Nm,
                               double *axial_N);
void fw_flexure_elastica_peak_strain(fw_flexure_elastica *e,
                                     fw_flexure_elastica_state *out); /* the larger |strain| */
double fw_flexure_elastica_energy_J(fw_flexure_elastica *e);
const fw_flexure_beam_linear *fw_flexure_elastica_linear(const fw_flexure_elastica *e);

#endif
