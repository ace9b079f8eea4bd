/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many cycles of an amplitude a material lasts. */
#ifndef FW_FLEXURE_STRAIN_LIFE_H
#define FW_FLEXURE_STRAIN_LIFE_H
#include <stdbool.h>

typedef struct fw_flexure_strain_life {
    bool known;
    double amplitude_Pa, cycles; /* fully reversed; lasts so many */
    double exponent;             /* b < 0 of the elastic part (Basquin) */
    double youngs_Pa;
    double ductility, ductility_exponent; /* eps_f', c < 0 (Manson, Coffin); 0, 0: elastic only */
} fw_flexure_strain_life;

/* elastic part of amplitude_Pa */
double fw_flexure_strain_life_elastic_Pa(const fw_flexure_strain_life *law);
/* E times the strain amplitude that lasts `cycles` */
double fw_flexure_strain_life_amplitude_Pa(const fw_flexure_strain_life *law, double cycles);
double fw_flexure_strain_life_cycles(const fw_flexure_strain_life *law,
                                     double amplitude_Pa); /* its inverse */
/* fully reversed amplitude that damages as much as this cycle (Smith, Watson, Topper) */
double fw_flexure_equivalent_amplitude_Pa(double amplitude_Pa, double mean_Pa);

#endif
