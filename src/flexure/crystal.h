/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cubic crystal in a (100) wafer: Young's modulus by direction. Theory:
   docs/theory/flexure-silicon.md. */
#ifndef FW_FLEXURE_CRYSTAL_H
#define FW_FLEXURE_CRYSTAL_H
#include <stdbool.h>

/* with psi the direction from [100] in the wafer plane:
     1/E(psi) = a0 + a1 cos 4 psi,  1/G(psi) = g0 + g1 cos 4 psi,  nu to [001] = -s12 E(psi)
     nu' = -s12/s11 from [001],  G of psi and [001] = 1/s44 whatever psi */
typedef struct fw_flexure_crystal {
    bool known;   /* false: isotropic */
    bool aligned; /* false: the hinge's axis is not known; modulus and stress are then means and
                     worst cases over all directions */
    double a0_per_Pa, a1_per_Pa, g0_per_Pa, g1_per_Pa, s12_per_Pa;
    double bow_per_Pa; /* nu nu'/E: what bowing across adds to 1/E, the same for all psi */
    double reach;      /* of what keeps the strip from bowing, over its depth */
    double share;      /* a1/a0 over silicon's: for what was found with silicon */
    double cos4, sin4; /* of four times the angle of the hinge's symmetry axis from [100] */
} fw_flexure_crystal;

/* axis_rad: the hinge's symmetry axis from [100]; NaN: not known */
fw_flexure_crystal fw_flexure_crystal_cubic(double c11_Pa, double c12_Pa, double c44_Pa,
                                            double axis_rad);
double fw_flexure_crystal_youngs_Pa(const fw_flexure_crystal *crystal, double from_100_rad);

#endif
