/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strain life, counted as stress E eps_a, since what a turned strip imposes is a strain:
     E eps_a(N) = S (N/N1)^b + E eps_f' (2N)^c,   S = sigma1 - E eps_f' (2 N1)^c
   so that N1 cycles of sigma1 last exactly, whether or not the plastic part is known.
   in: Pa, cycles, 1; out: Pa, cycles. Valid 1 <= N, S > 0; error: that of the data, a factor of
   two in life is usual. Cost: two pow; the inverse some six of these.
   Source: O. H. Basquin, Proc. ASTM 10 (1910) 625; S. S. Manson, NACA TN 2933 (1953); L. F. Coffin,
   Trans. ASME 76 (1954) 931. Test: test_strain_life.c */
#include "flexure/strain_life.h"
#include <math.h>

static double plastic_Pa(const fw_flexure_strain_life *law, double cycles) {
    if (!(law->ductility > 0)) return 0;
    return law->youngs_Pa * law->ductility * pow(2 * cycles, law->ductility_exponent);
}

double fw_flexure_strain_life_elastic_Pa(const fw_flexure_strain_life *law) {
    return law->amplitude_Pa - plastic_Pa(law, law->cycles);
}

double fw_flexure_strain_life_amplitude_Pa(const fw_flexure_strain_life *law, double cycles) {
    return fw_flexure_strain_life_elastic_Pa(law) * pow(cycles / law->cycles, law->exponent) +
           plastic_Pa(law, cycles);
}

/* Newton on logarithms: ln sigma(ln N) is convex and falls, so that from below the root in N it
   comes up to it without passing it */
double fw_flexure_strain_life_cycles(const fw_flexure_strain_life *law, double amplitude_Pa) {
    double s = fabs(amplitude_Pa), b = law->exponent, c = law->ductility_exponent;
    double elastic = fw_flexure_strain_life_elastic_Pa(law);
    if (!(s > 0)) return (double)INFINITY;
    double ln = log(law->cycles) + log(s / elastic) / b;
    if (!(law->ductility > 0)) return exp(ln);
    ln = fmax(ln, log(s / (law->youngs_Pa * law->ductility)) / c - log(2));
    for (int i = 0; i < 60; i++) {
        double e = elastic * exp(b * (ln - log(law->cycles)));
        double p = law->youngs_Pa * law->ductility * exp(c * (ln + log(2)));
        double step = log((e + p) / s) * (e + p) / (b * e + c * p);
        ln -= step;
        if (!(fabs(step) > 1e-13 * fmax(1, fabs(ln)))) break;
    }
    return exp(ln);
}

/* sigma_ar = sqrt(sigma_max sigma_a), sigma_max = sigma_a + |sigma_m|: a strip bends, so that one
   of its sides has the mean in tension, whichever its sign source: Smith, Watson, Topper, J.
   Materials 5 (1970) 767; test_strain_life.c mean_stress */
double fw_flexure_equivalent_amplitude_Pa(double amplitude_Pa, double mean_Pa) {
    return sqrt((amplitude_Pa + fabs(mean_Pa)) * amplitude_Pa);
}
