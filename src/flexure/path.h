/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures of any centre line and varying width: path, and csfh and leaf with a width-middle. Their
   place in the flexure's frame, law at finite rotation, beam; and the strain along a strip.
   Theory: docs/theory/flexure-path.md. */
#ifndef FW_FLEXURE_PATH_H
#define FW_FLEXURE_PATH_H
#include "base/arena.h"
#include "flexure/beam.h"
#include "flexure/finite.h"

/* strip in the flexure's frame (flexure.h). A path whose W lies to the left of the way from its
   first end to its second is walked from the other end, so that the bulge is at +x. */
typedef struct fw_flexure_course {
    fw_geometry_strip_shape shape[FW_STRIP_MOST];
    fw_geometry_pose start[FW_STRIP_MOST + 1]; /* of each piece; then the end */
    int n;
    double root_m[2], concentration[2]; /* dL, Kt of the first and second end */
    double straight_more_m[2];          /* what solids give more there; 0 of an arc */
} fw_flexure_course;
void fw_flexure_path_of(const fw_flexure_input *in, fw_flexure_course *path);
/* left or right edge (side +1, -1) at part 0..1 of a piece */
fw_geometry_vec2 fw_flexure_path_edge(const fw_flexure_course *path, int piece, double part,
                                      int side);
/* part 0..1 of the whole length at the place of the centre line nearest to a point, to 1/48 of a
   piece: for pictures */
double fw_flexure_path_nearest(const fw_flexure_course *path, double x_m, double y_m);

/* ---- at finite rotation ---- */
enum { FW_PATH_TERMS = 32 };
/* Chebyshev series over |rotation| <= 2 pi */
struct fw_flexure_hinge_table {
    double bend_x[FW_PATH_TERMS], bend_y[FW_PATH_TERMS]; /* m/N: fw_flexure_hinge_soft */
    double rest_x[FW_PATH_TERMS], rest_y[FW_PATH_TERMS];
    double drift_m[FW_PATH_TERMS];
    double pull_x[FW_PATH_TERMS], pull_y[FW_PATH_TERMS]; /* px, py of finite_force.c, 1/N */
    bool straight; /* a strip of any width along one line: y is along itself */
    int terms;     /* behind them all are below 1e-14 of their series */
};
/* values and derivatives of two such series at a rotation; without `second` no second ones */
void fw_flexure_hinge_series(const double *first, const double *other, int terms,
                             double rotation_rad, bool second, fw_flexure_hinge_jet out[2]);
typedef struct fw_flexure_path_pose { /* at one rotation, in the frame half turned */
    double c[2][2];                   /* softness along and across, m/N */
    double bend[2];                   /* of c[0][0] and c[1][1] what bending does; roots included */
    double third_xxy, third_yyy; /* of -V3 = (xxy Fx^2 Fy + yyy Fy^3)/2: what pull does to it */
    double drift_m[2];           /* of W of a pure moment */
} fw_flexure_path_pose;
typedef struct fw_flexure_path_way fw_flexure_path_way;
/* what does not depend on the rotation; fw_flexure_path_pose_at: valid below a full turn, 4 us a
   piece */
fw_status fw_flexure_path_way_new(fw_arena *arena, const fw_flexure_input *in,
                                  const fw_flexure_path_way **out);
void fw_flexure_path_pose_at(const fw_flexure_path_way *way, double rotation_rad,
                             fw_flexure_path_pose *out);
/* largest part up to a rotation, either way, that the law leaves out: drift along x (m), coupling
   c_xy/sqrt(c_xx c_yy); 0 of a path that is its own mirror image */
void fw_flexure_path_left_out(const fw_flexure_path_way *way, double rotation_rad, double *drift_m,
                              double *coupling);
/* the law with its table; without one fw_flexure_hinge_law_of knows plain arcs and leaves only */
fw_status fw_flexure_path_law(fw_arena *arena, const fw_flexure_input *in,
                              const fw_flexure_result *closed_form, fw_flexure_hinge_law *law);

/* the beam of beam.h: exact width, roots, one depth factor that gives the closed form's
   stiffness. Pieces and the table of widths are taken from the arena. */
fw_status fw_flexure_path_beam(fw_arena *arena, const fw_flexure_input *in,
                               const fw_flexure_result *closed_form, fw_flexure_beam *out);
/* that of any flexure: the path's where the width varies, else of one arc or line (beam.h) */
fw_status fw_flexure_beam_of_input(fw_arena *arena, const fw_flexure_input *in,
                                   const fw_flexure_result *closed_form, fw_flexure_beam *out);

/* ---- out of the plane: flexure_out_of_plane.c ---- */

typedef struct fw_flexure_out_of_plane {
    /* (z, turn about x, turn about y) of the second body at `at`, of (Fz, Mx, My) there, in the flexure's frame:
       m/N, 1/N, rad/(N m) */
    double c[3][3];
    double at_m[2];             /* where its pin is: the true centre of compliance */
    double length_m;            /* of the centre line */
    double bend_Nm2, twist_Nm2; /* the least along it of EI across the plane, of G J */
    double error;               /* relative, of its stiffness against solids */
} fw_flexure_out_of_plane;
fw_status fw_flexure_out_of_plane_of(fw_arena *arena, const fw_flexure_input *in,
                                     const fw_flexure_result *closed_form,
                                     fw_flexure_out_of_plane *out);
/* strain that (n) wrenches about that pin, in the flexure's frame, put on it across the plane, the first at rest and the
   others ringing either way: [0] of the first at least, [1] of all at most */
fw_status fw_flexure_across_strain(fw_arena *arena, const fw_flexure_input *in,
                                   const fw_flexure_result *closed_form, const double (*wrench)[3],
                                   int n, double strain[2]);
double fw_flexure_torsion_m4(double a_m, double b_m);
double fw_flexure_tall_arc(double curvature_per_m, double width_m, double depth_m, double poisson);

/* A strip with its own mass: parts of it along the way, how they go with its second body, and how it swings between its ends.
   In the plane coordinates of a part are (x, y) and those of the body's wrench (turn, x, y); across it (z, turn about the
   strip) and (z, turns about x, y), about the pin, in the flexure's frame. */
enum {
    FW_OWN_PARTS = 12,
    FW_OWN_MODES = 2,
    FW_OWN_LOOKS = FW_OWN_PARTS + 1,
    FW_OWN_LOADS = 2 * FW_OWN_PARTS + 3
};
typedef struct fw_flexure_own {
    double at_m[FW_OWN_PARTS][2];    /* in the flexure's frame */
    double way[FW_OWN_PARTS][2];     /* of the strip there, a unit vector */
    double mass[FW_OWN_PARTS][2];    /* of both coordinates: kg, and kg m2 of a turn */
    double goes[FW_OWN_PARTS][2][3]; /* by the second body's place about the pin, the first held */
    double back[3][3];               /* what that asks for there: a wrench */
    /* clamped at both ends: modes of mass 1, slowest first, 1/omega^2 of each, and of all others at most */
    double mode[FW_OWN_MODES][FW_OWN_PARTS][2], s2[FW_OWN_MODES], rest_s2;
    /* at places along it, both roots first and last, by unit loads on the parts, then by that wrench: moment, and pull in
       the plane or torque across it; and strain by either, at most */
    double moment[FW_OWN_LOOKS][FW_OWN_LOADS], other[FW_OWN_LOOKS][FW_OWN_LOADS];
    double by_moment[FW_OWN_LOOKS], by_other[FW_OWN_LOOKS];
} fw_flexure_own;
typedef struct fw_flexure_path_strain fw_flexure_path_strain;
fw_status fw_flexure_own_of(fw_arena *arena, const fw_flexure_input *in,
                            const fw_flexure_result *closed_form,
                            const fw_flexure_path_strain *section, bool across, double kg_per_m2,
                            fw_flexure_own *own);

/* ---- strain of a flexure under rotation and force ----

   Bending and tension with their own concentrations, on both faces, largest along the strip.
   Theory: docs/theory/verdict.md. */

typedef struct fw_flexure_path_point {
    double x_m, y_m;      /* in the flexure's frame */
    double cosine, sine;  /* of the tangent there, from the first root to the second */
    double part;          /* of the length, 0 to 1 */
    double strain_per_Nm; /* largest there per section moment; roots with their concentration */
    double strain_per_N;  /* per axial force; likewise */
    /* share of strain_per_Nm that the right and the left face have: of an arc one has less */
    double face[2];
    double soft_per_Nm; /* rotation by a moment, per part of the length: L/EI */
} fw_flexure_path_point;

enum { FW_STRIP_PLACES = 33 * FW_STRIP_MOST, FW_STRIP_ROWS = 7 };

struct fw_flexure_path_strain {
    fw_flexure_path_point *point; /* (n) along the strip, roots first and last */
    int n;                        /* at most FW_STRIP_PLACES */
    double length_m;              /* of the centre line */
    double fillet_m;              /* below 0: none */
    double reach_m[2]; /* from either end into the strip at most, the moment that counts */
    double narrows[2]; /* (w(0)/w(rho))^2 of either end, at least 1 */
    double stretched;  /* of what pulls along, the share that the blocks' give may take */
    double less[3];    /* share by which either root, and what is between, may be strained less */
    double more;       /* and by which what is between may be strained more */
    double W_m[2];     /* true centre of compliance */
    double
        *row; /* (FW_STRIP_ROWS x wide) the points once more, a number after the other; NULL: not */
    int wide; /* n, rounded up to whole vectors of 4 */
};

/* stress over N/(t h) at a root in tension */
double fw_flexure_tension_concentration(double width_m, double fillet_m);
fw_status fw_flexure_path_strain_new(fw_arena *arena, const fw_flexure_input *in,
                                     const fw_flexure_result *closed_form,
                                     fw_flexure_path_strain *out);

/* of a strip all of whose stiffness is `by` times as large: strains per force and moment are less */
void fw_flexure_path_strain_scale(fw_flexure_path_strain *strip, double by);
/* of one whose sections are strained by a moment `by` times as much, and by forces as before */
void fw_flexure_path_strain_bend(fw_flexure_path_strain *strip, double by);

typedef struct fw_flexure_strip_load {
    double rotation_rad;
    double force_N[2]; /* on the second body, along and across the axis in the frame half turned */
    double bend_Nm;    /* the rotation times the flexure's own stiffness */
    double root_Nm[2]; /* moments at the first and the second root, > 0: as a rotation > 0 */
    double pull;       /* across the axis over EI/L^2, as it acts on what bends */
    bool drawn;        /* the strip is taken as drawn, half turned: of an ideal pin */
    bool held; /* false: beyond the buckling load; the rest is then as without displacement */
    double
        least_known; /* the least strain is not looked for (it is 0 then) where the peak is no more than this */
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
    double least; /* no more than peak: with moments where the peaks of roots stand, and blocks that
                          give along the strip */
    double most;  /* no less than peak: with what may be more between the roots */
    double root[2][2]; /* signed, at both faces of both roots: that of the side to which the axis
                          points away from first */
} fw_flexure_strip_strains;
void fw_flexure_strip_strain(const fw_flexure_path_strain *strip, const fw_flexure_strip_load *load,
                             fw_flexure_strip_strains *out);
/* with the section forces of the beam's last solution */
void fw_flexure_strip_strain_exact(const fw_flexure_path_strain *strip, fw_flexure_elastica *beam,
                                   fw_flexure_strip_strains *out);

#endif
