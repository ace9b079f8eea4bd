/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/weibull.h"
#include "base/constants.h"
#include "flexure/section.h"
#include <math.h>

/* Effective surface of a flexure under a pure moment, at the peak stress Kt sigma of its fillets:
     A_eff = (L h + L t/(m+1)) / Kt^m + 2 (pi/2 rho h + rho t/(m+1))
   first the strip: its side in tension, uniform, and both faces, across which the stress rises from
   the middle as y, so that int (2y/t)^m dy over the half in tension is t/2/(m+1) each; then the two
   fillets on that side, with a quarter turn of surface each and as much of the faces as they are
   long, all taken at the peak: that bounds their share from above. A flexure that turns as far to
   the other side stresses as much again.
   in: L, t, h, rho in m, m 1; out: m2; valid m > 0; error: of the allowable stress at most
   (1 + share of the fillets)^(1/m) too low, 3 % at m = 10, rho = t/2
   source: W. Weibull, J. Appl. Mech. 18 (1951) 293; docs/theory/limits-of-materials.md eq. 2;
   test_weibull.c area_against_numerical_integration */
double fw_flexure_weibull_area_m2(const fw_flexure_input *f, double m) {
    double t = f->width_m, h = f->depth_m, rho = fmax(f->fillet_m, 0.0);
    double kt = fw_flexure_fillet_concentration(t, f->fillet_m), faces = t / (m + 1.0);
    return f->length_m * (h + faces) * pow(kt, -m) + 2.0 * rho * (0.5 * FW_PI * h + faces);
}

/* P = 1 - exp(-(A_eff/A0) (sigma/sigma0)^m); in: Pa, tension or compression of the same size on the
   other side; out: 1; relative error of small P kept by expm1; test_weibull.c */
double fw_flexure_weibull_probability(const fw_flexure_weibull *w, double peak_Pa) {
    return -expm1(-w->effective_m2 / w->area_m2 * pow(fabs(peak_Pa) / w->strength_Pa, w->modulus));
}

double fw_flexure_weibull_stress_Pa(const fw_flexure_weibull *w, double probability) {
    double links = -log1p(-probability) * w->area_m2 / w->effective_m2;
    return w->strength_Pa * pow(links, 1.0 / w->modulus);
}

double fw_flexure_series_share(double probability, int n) {
    return -expm1(log1p(-probability) / (n > 0 ? n : 1));
}

double fw_flexure_series_probability(const double *probability, int n) {
    double survives = 0.0; /* its logarithm */
    for (int i = 0; i < n; i++)
        survives += log1p(-probability[i]);
    return -expm1(survives);
}
