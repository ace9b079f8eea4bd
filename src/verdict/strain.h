/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peak strain of a flexure under rotation and joint force. Private to the room and its tests. */
#ifndef FW_VERDICT_STRAIN_H
#define FW_VERDICT_STRAIN_H
#include "layout/layout.h"
#include "flexure/elastica.h"
#include "mechanism/mechanism.h"

typedef struct fw_verdict_hinge_load {
    double angle_rad;  /* of the pin: phi_b - phi_a - free angle */
    double fx_N, fy_N; /* of the pin on body b, world axes */
    double frame_rad;  /* half the sum of both bodies' rotations since the drawn pose */
} fw_verdict_hinge_load;

/* largest |strain|, fillets included */
double fw_verdict_hinge_strain(const fw_mechanism *mechanism, const fw_mechanism_hinge *hinge,
                               const fw_layout_hinge_layout *drawn,
                               const fw_verdict_hinge_load *load);

/* strain at the fillets of the roots at polar angle -a and +a, signed, without what the force pulls
   along: bending alone, since its sign is what makes cycles */
void fw_verdict_hinge_root_strains(const fw_mechanism *mechanism, const fw_mechanism_hinge *hinge,
                                   const fw_layout_hinge_layout *drawn,
                                   const fw_verdict_hinge_load *load, double strain[2]);
/* the same with the section moments of an exact beam under this rotation and force; that of the
   closed form where the beam has no such equilibrium. beam: of fw_verdict_hinge_beam; NULL: closed
   form */
double fw_verdict_hinge_strain_exact(const fw_mechanism *mechanism, const fw_mechanism_hinge *hinge,
                                     const fw_layout_hinge_layout *drawn, fw_flexure_elastica *beam,
                                     const fw_verdict_hinge_load *load);
/* *beam NULL: nothing is known of the strip, or its stiffness is stated */
fw_status fw_verdict_hinge_beam(fw_arena *arena, const fw_mechanism_hinge *hinge,
                                fw_flexure_elastica **beam);
/* largest |section moment| at the roots and inside, of the strip turned by theta under a force on
   its second body, in the first one's frame; false: no equilibrium. kt: a moment inside counts only
   where it is kt times those at the roots */
bool fw_verdict_exact_moments(fw_flexure_elastica *beam, double theta_rad, const double force_N[2],
                              double kt, double *root_Nm, double *inside_Nm);

/* largest |section moment| at the roots and inside the arc; see verdict_strain.c */
void fw_verdict_arc_moments(const fw_device_flexure *flexure, double centre_m, double moment_Nm,
                            double fx_N, double fy_N, double *root_Nm, double *inside_Nm);

#endif
