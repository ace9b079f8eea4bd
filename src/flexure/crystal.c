/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/crystal.h"
#include <math.h>

/* compliances of a cubic crystal by inversion of (C11, C12, C44), turned about [001]:
     S11 = (C11 + C12)/((C11 - C12)(C11 + 2 C12)),  S12 = -C12/(...),  S44 = 1/C44
     S0 = S11 - S12 - S44/2,  1/E = S11 - S0/2 sin^2(2 psi),  1/G = S44 + 2 S0 sin^2(2 psi)
   in: Pa, rad; out: 1/Pa. Valid for a stable crystal, C44 > 0, C11 > |C12|, C11 + 2 C12 > 0;
   exact. Cost 60 ns. Source: Nye, Physical Properties of Crystals, ch. VIII (rotation of the
   compliance tensor); docs/theory/flexure-silicon.md eq. 12.
   Test: test_crystal.c moduli_by_direction */
fw_flexure_crystal fw_flexure_crystal_cubic(double c11_Pa, double c12_Pa, double c44_Pa,
                                            double axis_rad) {
    double d = (c11_Pa - c12_Pa) * (c11_Pa + 2 * c12_Pa);
    double s11 = (c11_Pa + c12_Pa) / d, s12 = -c12_Pa / d, s44 = 1 / c44_Pa;
    double s0 = s11 - s12 - 0.5 * s44;
    const double silicon = 0.130229; /* a1/a0 of (165.7, 63.9, 79.6) GPa */
    bool aligned = isfinite(axis_rad);
    return (fw_flexure_crystal){.known = true,
                                .aligned = aligned,
                                .a0_per_Pa = s11 - 0.25 * s0,
                                .a1_per_Pa = 0.25 * s0,
                                .g0_per_Pa = s44 + s0,
                                .g1_per_Pa = -s0,
                                .s12_per_Pa = s12,
                                .bow_per_Pa = s12 * s12 / s11,
                                .reach = sqrt(s11 / (3 * s44)),
                                .share = 0.25 * s0 / (s11 - 0.25 * s0) / silicon,
                                .cos4 = aligned ? cos(4 * axis_rad) : 0,
                                .sin4 = aligned ? sin(4 * axis_rad) : 0};
}

double fw_flexure_crystal_youngs_Pa(const fw_flexure_crystal *c, double from_100_rad) {
    return 1 / (c->a0_per_Pa + c->a1_per_Pa * cos(4 * from_100_rad));
}
