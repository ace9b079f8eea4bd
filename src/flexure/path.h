/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures of any centre line and varying width: path, and csfh and leaf with a width-middle. Their
   place in the flexure's frame, section by section strain, law at finite rotation, beam.
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
    int terms; /* behind them all are below 1e-14 of their series */
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

/* the beam of elastica.h: exact width, roots, one depth factor that gives the closed form's
   stiffness. Pieces and the table of widths are taken from the arena. */
fw_status fw_flexure_path_beam(fw_arena *arena, const fw_flexure_input *in,
                               const fw_flexure_result *closed_form, fw_flexure_beam *out);
/* that of any flexure: the path's where the width varies, else of one arc or line (beam.h) */
fw_status fw_flexure_beam_of_input(fw_arena *arena, const fw_flexure_input *in,
                                   const fw_flexure_result *closed_form, fw_flexure_beam *out);

#endif
