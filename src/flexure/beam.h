/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A beam of any shape: centre line of straight pieces and arcs, width that varies along it, a
   modulus that may depend on direction, two roots that give. Its centre of elastic weights and
   compliance here; what it does at large rotation in elastica.h. Theory: docs/theory/beams.md. */
#ifndef FW_FLEXURE_BEAM_H
#define FW_FLEXURE_BEAM_H
#include "flexure/flexure.h"
#include <stdbool.h>

typedef struct fw_flexure_beam_piece {
    double length_m, curvature_per_m; /* > 0: the tangent turns to the left as s grows */
    double kink_rad;                  /* rigid corner before this piece: turn of the tangent */
    double width_m[3];                /* start, middle, end: the parabola through them */
} fw_flexure_beam_piece;

/* width at s_m from the start of a piece, where a parabola is not enough; smooth within a piece */
typedef double fw_beam_width(const void *context, int piece, double s_m);

typedef struct fw_flexure_beam {
    const fw_flexure_beam_piece *piece;
    int npiece;
    double x_m, y_m, psi_rad; /* start of the centre line and its tangent there */
    double depth_m, youngs_Pa, shear_Pa;
    double depth_factor; /* EI over that of plane stress; 0 is taken as 1 */
    double root_m[2];    /* length dL added at each end: a point rotation dL/EI */
    bool cubic;          /* 1/E = a0 + a1 cos 4(psi + orientation), not 1/youngs_Pa */
    double a0_per_Pa, a1_per_Pa, orientation_rad; /* orientation: of the frame's x from [100] */
    double lost_per_Pa, lost_m; /* what either end takes of 1/E in bending, s from it:
                                   lost exp(-s/lost_m); 0: nothing */
    bool inextensible;          /* no axial and no shear strain */
    fw_beam_width *width;       /* NULL: width_m of the pieces */
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

/* Gauss-Legendre rules on [0, 1]. Private to the room. */

enum { FW_GAUSS_MOST = 16 };

/* n nodes in rising order and their weights, which add up to 1 */
void fw_flexure_gauss_rule(int n, double *node, double *weight);
/* a[i * n + j] = integral of the j-th Lagrange polynomial of the nodes from 0 to node i: the
   collocation method of order 2 n */
void fw_flexure_gauss_integrals(int n, const double *node, const double *weight, double *a);

#endif
