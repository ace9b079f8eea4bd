/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From where to where air at 1 atm breaks down between two conductors.

     V = B p d/(ln(A p d) - ln ln(1 + 1/gamma)),   A = 15/(cm Torr), B = 365 V/(cm Torr)      Paschen
     V >= (B/A) e ln(1 + 1/gamma),                 its least value, at p d = (e/A) ln(1 + 1/gamma)

   gamma, the electrons that an ion frees at the cathode, is not known for etched silicon or plated copper: 0.005
   to 0.02 gives the range, whose least values, 260 and 350 V, enclose the 327 V measured for air. Left of its least
   value the curve of Paschen would rise again; measured voltages do not, so the least value holds on there.
   Below 6 um electrons leave the cathode by the field alone and the voltage falls with the gap: the lower end
   goes straight to 0 from there (43 V/um, below what is measured), the upper end is 350 V/um at most.

   In: gap, m, 0 to about 1 mm (E/p of the constants: 100 to 800 V/(cm Torr)). Out: V. Error: the range is one
   of flat, clean metal; edges, burrs and dust lower it, damp lowers it below 1 um. Cost: four logarithms. Source:
   Y. P. Raizer, Gas Discharge Physics (1991), for A and B; P. G. Slade, E. D. Taylor, IEEE Trans. Components and
   Packaging Technol. 25 (2002) 390: Paschen's curve above 6 um, field emission below 4 um; A. Peschot et al., Appl.
   Phys. Lett. 105 (2014) 123109: 350 V/um below 1 um. Test: test_wiring_breakdown.c */
#include "wiring/wiring.h"
#include "base/constants.h"
#include <math.h>

static const double TORR = FW_STANDARD_ATMOSPHERE_Pa / 760.0;
static const double TOWNSEND_A = 15.0 / 1e-2, TOWNSEND_B = 365.0 / 1e-2; /* per m and Torr */
static const double GAMMA[2] = {0.02, 0.005};
static const double EMISSION_BELOW_M = 6e-6, HIGHEST_FIELD_V_per_m = 350e6;

static double paschen(double gap_m, double gamma) {
    double pd = gap_m * (FW_STANDARD_ATMOSPHERE_Pa / TORR), loss = log1p(1.0 / gamma);
    double least_pd = FW_E * loss / TOWNSEND_A;
    if (pd <= least_pd) return TOWNSEND_B * least_pd;
    return TOWNSEND_B * pd / (log(TOWNSEND_A * pd) - log(loss));
}

void fw_wiring_breakdown(double gap_m, double volts[2]) {
    if (!(gap_m > 0.0)) {
        volts[0] = volts[1] = 0.0;
        return;
    }
    volts[0] = paschen(gap_m, GAMMA[0]) * fmin(1.0, gap_m / EMISSION_BELOW_M);
    volts[1] = fmin(paschen(gap_m, GAMMA[1]), HIGHEST_FIELD_V_per_m * gap_m);
}
