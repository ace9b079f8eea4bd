/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strain of a flexure under rotation and force: bending and tension with their own concentrations,
   on both faces, largest along the strip. Theory: docs/theory/verdict.md. */
#ifndef FW_FLEXURE_STRIP_STRAIN_H
#define FW_FLEXURE_STRIP_STRAIN_H
#include "flexure/elastica.h"
#include "flexure/path.h"

typedef struct fw_flexure_path_point {
    double x_m, y_m;      /* in the flexure's frame */
    double cosine, sine;  /* of the tangent there, from the first root to the second */
    double part;          /* of the length, 0 to 1 */
    double strain_per_Nm; /* largest there per section moment; roots with their concentration */
    double strain_per_N;  /* per axial force; likewise */
    double face[2];     /* share of strain_per_Nm that the right and the left face have: 1, less at
                             the outside of an arc's root */
    double soft_per_Nm; /* rotation by a moment, per part of the length: L/EI */
} fw_flexure_path_point;

enum { FW_STRIP_PLACES = 33 * FW_STRIP_MOST };

typedef struct fw_flexure_path_strain {
    fw_flexure_path_point *point; /* (n) along the strip, roots first and last */
    int n;                        /* at most FW_STRIP_PLACES */
    double length_m;              /* of the centre line */
    double fillet_m;              /* below 0: none */
    double narrows[2];            /* (w(0)/w(rho))^2 of either end, at least 1 */
    double stretched; /* of what pulls along, the share that the blocks' give may take */
    double W_m[2];    /* true centre of compliance */
} fw_flexure_path_strain;

/* stress over N/(t h) at a root in tension */
double fw_flexure_tension_concentration(double width_m, double fillet_m);
fw_status fw_flexure_path_strain_new(fw_arena *arena, const fw_flexure_input *in,
                                     const fw_flexure_result *closed_form,
                                     fw_flexure_path_strain *out);

/* of a strip all of whose stiffness is `by` times as large: strains per force and moment are less */
void fw_flexure_path_strain_scale(fw_flexure_path_strain *strip, double by);

typedef struct fw_flexure_strip_load {
    double rotation_rad;
    double force_N[2]; /* on the second body, along and across the axis in the frame half turned */
    double bend_Nm;    /* the rotation times the flexure's own stiffness */
    double root_Nm[2]; /* moments at the first and the second root, > 0: as a rotation > 0 */
    double pull;       /* across the axis over EI/L^2, as it acts on what bends */
    bool drawn;        /* the strip is taken as drawn, half turned: of an ideal pin */
    bool held; /* false: beyond the buckling load; the rest is then as without displacement */
} fw_flexure_strip_load;
/* By the law of finite.h; rest NULL: of an ideal pin, whose W is one place whatever the force.
   along_m: how far the second body's W is from the first's along the axis half turned, for a strip
   that the force alone would buckle and other flexures hold; NULL: not known */
void fw_flexure_strip_load_of(const fw_flexure_path_strain *strip, const fw_flexure_hinge_law *law,
                              const fw_flexure_hinge_rest *rest, double rotation_rad,
                              const double force_N[2], const double *along_m,
                              fw_flexure_strip_load *out);

typedef struct fw_flexure_strip_strains {
    double peak;  /* largest |strain|, fillets included */
    double least; /* no more than peak: with moments where the fillets end, and blocks that give
                          along the strip */
    double root[2][2]; /* signed, at both faces of both roots: that of the side to which the axis
                          points away from first */
} fw_flexure_strip_strains;
void fw_flexure_strip_strain(const fw_flexure_path_strain *strip, const fw_flexure_strip_load *load,
                             fw_flexure_strip_strains *out);
/* with the section forces of the beam's last solution */
void fw_flexure_strip_strain_exact(const fw_flexure_path_strain *strip, fw_flexure_elastica *beam,
                                   fw_flexure_strip_strains *out);

#endif
