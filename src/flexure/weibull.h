/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fracture as the weakest link of a stressed surface (two-parameter Weibull). */
#ifndef FW_FLEXURE_WEIBULL_H
#define FW_FLEXURE_WEIBULL_H
#include "flexure/flexure.h"

typedef struct fw_flexure_weibull {
    bool known;
    double strength_Pa, modulus, area_m2; /* sigma0, m, A0 */
    double effective_m2; /* surface that breaks as often, were all of it at the peak stress */
} fw_flexure_weibull;

double fw_flexure_weibull_area_m2(const fw_flexure_input *flexure, double modulus);
double fw_flexure_weibull_probability(const fw_flexure_weibull *weibull, double peak_Pa);
double fw_flexure_weibull_stress_Pa(const fw_flexure_weibull *weibull,
                                    double probability); /* its inverse */
/* failure probability of each of n equal links of a chain that fails with `probability` */
double fw_flexure_series_share(double probability, int n);
/* of a chain of n links: 1 - product of their survivals */
double fw_flexure_series_probability(const double *probability, int n);

#endif
