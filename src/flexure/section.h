/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What arcs and leaves share: root compliance, fillet concentration, depth. Private to the room. */
#ifndef FW_FLEXURE_SECTION_H
#define FW_FLEXURE_SECTION_H

/* root length dL and fillet concentration for fillet rho and width t; rho/t is clamped to the
   fitted range [0.05, 1] */
double fw_root_length_m(double width_m, double fillet_m);
double fw_fillet_concentration(double width_m, double fillet_m);

typedef struct fw_depth {
    double stiffness; /* EI_eff / EI: 1 plane stress .. 1/(1-nu^2) plane strain */
    double inner,
        outer; /* hoop strain over the beam's: inner fibre at mid-depth, outer at the edge */
} fw_depth;
fw_depth fw_depth_factors(double radius_m, double width_m, double depth_m, double poisson);

#endif
