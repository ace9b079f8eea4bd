/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the effect `air` share. Private to the effect and its tests. */
#ifndef FW_EFFECTS_AIR_H
#define FW_EFFECTS_AIR_H
#include "effects/effect.h"

typedef struct fw_effects_gas { /* dry air, or what the scene states of it */
    double pressure_Pa, temperature_K, viscosity_Pas, density_kg_per_m3;
    double path_m; /* mean free path */
} fw_effects_gas;

/* ---- air.c ---- */

/* Sutherland's law for dry air, 170 K to 1900 K within 2 %: 1.458e-6 T^1.5/(T + 110.4) */
double fw_effects_air_viscosity(double temperature_K);
fw_effects_gas fw_effects_gas_of(const fw_device_air *air);

typedef struct fw_effects_damper { /* of a body: force by speed, couple by angular speed */
    double force_Ns_per_m, couple_Nms;
} fw_effects_damper;

typedef struct fw_effects_face { /* of a body seen from above */
    double area_m2, polar_m4, perimeter_m;
} fw_effects_face;
/* stated, or as drawn; area NaN where neither is known */
fw_effects_face fw_effects_air_face(const fw_mechanism *mechanism, const fw_device_air *air,
                                    int body);

/* film of `gap` between the face of a body and the ground below it */
fw_effects_damper fw_effects_air_slide(const fw_effects_gas *gas, const fw_effects_face *face,
                                       double gap_m);

/* open air around a thin body that moves in its own plane */
fw_effects_damper fw_effects_air_drag(const fw_effects_gas *gas, const fw_effects_face *face);

/* film between two walls that approach each other */
typedef struct fw_effects_squeeze {
    double c0_Nsm2; /* coefficient times gap^3, without rarefaction */
    double path_m;
    double angle_rad; /* of the normal, towards `against`, in its frame */
    double least_m;   /* below this gap the coefficient stays as it is there */
} fw_effects_squeeze;
/* integral of the solution of -laplace u = 1, u = 0 around, over a x b, m4 */
double fw_effects_rectangle_integral(double a_m, double b_m);
fw_effects_squeeze fw_effects_air_squeeze(const fw_effects_gas *gas, double length_m,
                                          double depth_m, double gap_m);
/* coefficient at a gap, N s/m, and its derivative by the gap (may be NULL) */
double fw_effects_squeeze_at(const fw_effects_squeeze *film, double gap_m, double *slope);
double fw_effects_air_depth(const fw_mechanism *mechanism,
                            const fw_device_air *air); /* NaN: not known */

#endif
