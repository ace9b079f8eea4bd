/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws that arcs, leaves and paths share: root compliance, fillet concentration, depth factor,
   what the ends of a crystal lose, peak strain at a root; the kinds, and the sections of a path.
   Private to the room. */
#ifndef FW_FLEXURE_SECTION_H
#define FW_FLEXURE_SECTION_H
#include "flexure/flexure.h"
#include "flexure/path.h"

/* root length dL and fillet concentration for fillet rho and width t; rho/t is clamped to the
   range [0.05, 2] of the laws; rho < 0: an ideal end, 0 and 1 */
double fw_flexure_root_length_m(double width_m, double fillet_m);
double fw_flexure_root_block_m(double width_m,
                               double fillet_m); /* what of it a fillet of no radius would leave */
/* of a straight strip, beside (13a): what a root of a solid gives more than dL, whose law is of plane stress */
double fw_flexure_straight_more_m(double width_m, double fillet_m);
double fw_flexure_fillet_concentration(double width_m, double fillet_m);
/* how far from the block's face, at most, the moment and the width stand that a filleted root is strained by */
double fw_flexure_root_reach_m(double width_m, double fillet_m, double curvature_per_m);

/* e = R - rn of a strip of width t bent to radius R, u = t/2R; exact stiffness of it over the thin
   one (Golovin) */
double fw_flexure_neutral_offset(double radius_m, double u);
double fw_flexure_golovin(double u);

typedef struct fw_flexure_depth {
    double stiffness; /* EI_eff / EI: 1 plane stress .. 1/(1-nu^2) plane strain */
    double softness;  /* 1 over that */
    double bow;       /* f: 1 free to bow across, plane stress .. 0 plane strain */
    double inner,
        outer; /* hoop strain over the beam's: inner fibre at mid-depth, outer at the edge */
} fw_flexure_depth;
fw_flexure_depth fw_flexure_depth_factors(double radius_m, double width_m, double depth_m,
                                          double poisson);
fw_flexure_depth fw_flexure_depth_at(double depth_over_root_of_radius_and_width, double poisson);
/* of a crystal's strip, E of its mean compliance */
fw_flexure_depth fw_flexure_depth_crystal(double depth_over_root_of_radius_and_width,
                                          const fw_flexure_crystal *crystal, double youngs_Pa);
/* of a crystal: stress between the roots over M/Z, largest of the section; curved: t/3R, not signed; psi of the
   strip (or of its normal) from the hinge's axis */
double fw_flexure_depth_stress(double depth_over_root_of_radius_and_width,
                               const fw_flexure_crystal *crystal, double psi_rad, double curved);

typedef struct fw_flexure_end_loss {
    double reach_m, length_m; /* l; f l^2/(l + 0.4192 t) */
} fw_flexure_end_loss;
/* What (13a) and the sums along a strip go by: the crystal, or an isotropic material as one whose
   modulus is the same in all directions; `known` is false of the printed formula, whose ends lose
   nothing. The peak strain has (13a) in any case: it was fitted with it */
fw_flexure_crystal fw_flexure_elastic_of(const fw_flexure_input *in);
/* of an isotropic strip: d, which either end takes off its length in the peak strain per radian. bow: f */
double fw_flexure_end_loss_m(const fw_flexure_input *in, double bow, double block_m);
/* bow: f of the depth factor, 1 of a straight strip; block: fw_flexure_root_block_m */
fw_flexure_end_loss fw_flexure_end_loss_of(const fw_flexure_crystal *crystal, double depth_m,
                                           double bow, double length_m, double block_m);

/* peak strain (of a crystal: stress) at a root over that of the beam there, Kt and curvature
   included, on the safe side of solids. curved: t/3R, signed to the left; end: -1 the first, 1 the
   second, whose tangent has the angle `angle_rad` in the flexure's frame */
typedef struct fw_flexure_root_case {
    double width_m, fillet_m, depth_m, curved, poisson, bow;
    int end;
    double angle_rad;
} fw_flexure_root_case;
double fw_flexure_root_peak(const fw_flexure_root_case *root, const fw_flexure_crystal *crystal);

/* ---- two functions per hinge kind, whose rows are in flexure.c, and what they share ---- */

void fw_flexure_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_csfh(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
void fw_flexure_leaf_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_leaf(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
void fw_flexure_path_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_path(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
fw_flexure_error fw_flexure_path_errors(fw_flexure_shape *shape, const fw_flexure_input *in);

/* of all kinds and materials */
void fw_flexure_shape_marks(fw_flexure_shape *shape);
fw_flexure_error fw_flexure_errors(const fw_flexure_shape *shape, const fw_flexure_input *in,
                                   const fw_flexure_result *result);

/* the peak: at the fillet of a root (root: fw_flexure_root_peak), or between the roots where the
   fillets are wide; beside it the fit (5). beam: t/2 over length and roots, of a crystal in its
   modulus; inside: of the fibre between the roots over it */
void fw_flexure_peak_strain(const fw_flexure_shape *shape, double beam, double inside, double root,
                            fw_flexure_result *out);

/* dL/E of a root whose tangent has cos 4 psi, psi from [100] */
double fw_flexure_root_m_per_Pa(const fw_flexure_shape *shape, const fw_flexure_crystal *crystal,
                                double cos4);

/* ---- sections of a path: one of them with all that its closed form corrects ---- */

/* of what: uniform modulus 1 without depth (outline alone), or a material */
typedef struct fw_flexure_path_stuff {
    fw_flexure_crystal elastic; /* of fw_flexure_elastic_of; not known: youngs_Pa alone */
    double youngs_Pa, poisson;  /* poisson: out of the plane; of a crystal its mean */
    double depth_m;             /* 0: no depth factor, unit depth */
    double end_depth_m;         /* of what ends lose, whatever depth_m is */
    bool by_stress;             /* a crystal is limited by stress: fw_flexure_depth_stress */
} fw_flexure_path_stuff;

typedef struct fw_flexure_path_section {
    fw_geometry_pose pose;
    double neutral_x_m, neutral_y_m; /* where a moment leaves the section in place */
    double width_m, curved;          /* t; t/3R, signed to the left */
    double stretch_per_N, shear_per_N;
    double bend_per_Nm2;  /* 1/(EI D g): of rotation and of W */
    double force_per_Nm2; /* 1/(E A e D R): of forces; 1/(EI D) where straight */
    double thin_per_Nm2;  /* 1/EI */
    fw_flexure_depth depth;
    double golovin;
} fw_flexure_path_section;
void fw_flexure_path_section_at(const fw_flexure_course *path, const fw_flexure_path_stuff *stuff,
                                int piece, double s_m, fw_flexure_path_section *out);
/* dL/(EI) of an end without and with depth: per N m */
void fw_flexure_path_root(const fw_flexure_course *path, const fw_flexure_path_stuff *stuff,
                          int end, fw_flexure_path_section *at, double *root_m);
/* what an end of it loses; nothing where the material's moduli are not known by direction */
fw_flexure_end_loss fw_flexure_path_end(const fw_flexure_course *path,
                                        const fw_flexure_path_stuff *stuff, int end);
/* of the second kind: d of fw_flexure_end_loss_of; neutral_*: where it counts */
void fw_flexure_path_end_loss(const fw_flexure_course *path, const fw_flexure_path_stuff *stuff,
                              int end, fw_flexure_path_section *at, double *loss_m);
fw_flexure_path_stuff fw_flexure_path_stuff_of(const fw_flexure_course *path,
                                               const fw_flexure_input *in);
/* strain of the fibre over that of the beam: max((1 + t/3R) F_inner, (1 - t/3R) F_outer) */
double fw_flexure_path_fibre_factor(const fw_flexure_path_section *at,
                                    const fw_flexure_path_stuff *stuff);
/* of a crystal's strip: raises the places whose neighbours bow less; bow: n^2; one: strain per moment at M/Z, (n) */
void fw_flexure_neighbours_reach(const fw_flexure_input *in, double bow, double length_m,
                                 const double *one, fw_flexure_path_strain *out);
/* strain per section moment at a section: t/2 of that over (E I D g), no fillet */
double fw_flexure_path_fibre(const fw_flexure_path_section *at, double youngs_Pa,
                             const fw_flexure_path_stuff *stuff);

/* at a root over that of the beam there, fillet and all (fw_flexure_root_peak); ideal ends: as
   between them
 */
double fw_flexure_path_root_factor(const fw_flexure_input *in, const fw_flexure_path_stuff *stuff,
                                   int end, const fw_flexure_path_section *at);
/* (w(s)/w(0))^2 of an end, s from it: the peak strain of a root stands within its fillet, and by that it
   is less or more than with the width at the face. Test: test_varying.c */
double fw_flexure_path_root_opens(const fw_flexure_course *path, int end, double s_m);

#endif
