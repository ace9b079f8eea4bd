/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The geometrically exact beam (Reissner): what a beam of beam.h does at any rotation under a
   moment and a dead force at its second end, given any three of its end's six unknowns.

   Everything is in the beam's frame, which the first root holds. The end is watched at a point of
   the second body, W as the beam was made unless told otherwise: twist (theta, ux, uy) is the
   rotation of the second body and the displacement of that point, wrench (M, Fx, Fy) acts on the
   second body at that point where it now is; work is M dtheta + Fx dux + Fy duy.
   Theory: docs/theory/beams.md. */
#ifndef FW_FLEXURE_ELASTICA_H
#define FW_FLEXURE_ELASTICA_H
#include "base/arena.h"
#include "base/status.h"
#include "flexure/beam.h"

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
/* Where other flexures hold the bodies: given are the rotation, the displacement along a direction
   (unit vector) and the force across it; twist and wrench have these, and the rest of another law.
   Only near that; section forces are those of the state, the result's twist across is not. */
void fw_flexure_elastica_held(fw_flexure_elastica *e, const double twist[3], const double wrench[3],
                              const double along[2], double tolerance,
                              fw_flexure_elastica_result *out);
void fw_flexure_elastica_of_wrench(fw_flexure_elastica *e, const double wrench[3], double tolerance,
                                   bool warm, fw_flexure_elastica_result *out);

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
