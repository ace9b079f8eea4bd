/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A section of a strip with all that its closed form corrects. Private to the room. */
#ifndef FW_FLEXURE_PATH_SECTIONS_H
#define FW_FLEXURE_PATH_SECTIONS_H
#include "flexure/path.h"
#include "flexure/section.h"

/* of what: uniform modulus 1 without depth (outline alone), or a material */
typedef struct fw_flexure_path_stuff {
    fw_flexure_crystal elastic; /* of fw_flexure_elastic_of; not known: youngs_Pa alone */
    double youngs_Pa, poisson;  /* poisson: out of the plane; of a crystal its mean */
    double depth_m;             /* 0: no depth factor, unit depth */
    double end_depth_m;         /* of what ends lose, whatever depth_m is */
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
/* of the second kind: d of fw_flexure_end_loss_of; neutral_*: where it counts */
void fw_flexure_path_end_loss(const fw_flexure_course *path, const fw_flexure_path_stuff *stuff,
                              int end, fw_flexure_path_section *at, double *loss_m);
fw_flexure_path_stuff fw_flexure_path_stuff_of(const fw_flexure_course *path,
                                               const fw_flexure_input *in);
/* strain of the fibre over that of the beam: max((1 + t/3R) F_inner, (1 - t/3R) F_outer) */
double fw_flexure_path_fibre_factor(const fw_flexure_path_section *at);
/* strain per section moment at a section: t/2 of that over (E I D g), no fillet */
double fw_flexure_path_fibre(const fw_flexure_path_section *at, double youngs_Pa,
                             const fw_flexure_path_stuff *stuff);

/* at a root over that of the beam there, fillet and all (fw_flexure_root_peak); ideal ends: as
   between them
 */
double fw_flexure_path_root_factor(const fw_flexure_input *in, const fw_flexure_path_stuff *stuff,
                                   int end, const fw_flexure_path_section *at);
/* (w(rho)/w(0))^2 of an end: the peak strain of a root stands where its fillet ends, and by that it
   is less or more than with the width at the face. Test: test_varying.c */
double fw_flexure_path_root_opens(const fw_flexure_course *path, int end, double fillet_m);

#endif
