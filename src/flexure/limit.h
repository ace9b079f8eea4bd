/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a flexure bears: one row per criterion, each from the material's own data, the lowest
   allowable stress governs. All are peak stresses at the root's fillet, before the safety factor.
   Theory, definitions and sources: docs/theory/limits-of-materials.md; which rules by default:
   docs/decisions/0014-which-limit-rules.md. */
#ifndef FW_FLEXURE_LIMIT_H
#define FW_FLEXURE_LIMIT_H
#include "flexure/flexure.h"
#include <stdbool.h>

/* How many cycles of an amplitude a material lasts. */

typedef struct fw_flexure_strain_life {
    bool known;
    double amplitude_Pa, cycles; /* fully reversed; lasts so many */
    double exponent;             /* b < 0 of the elastic part (Basquin) */
    double youngs_Pa;
    double ductility, ductility_exponent; /* eps_f', c < 0 (Manson, Coffin); 0, 0: elastic only */
} fw_flexure_strain_life;

/* E times the strain amplitude that lasts `cycles` */
double fw_flexure_strain_life_amplitude_Pa(const fw_flexure_strain_life *law, double cycles);
double fw_flexure_strain_life_cycles(const fw_flexure_strain_life *law,
                                     double amplitude_Pa); /* its inverse */
/* fully reversed amplitude that damages as much as this cycle (Smith, Watson, Topper) */
double fw_flexure_equivalent_amplitude_Pa(double amplitude_Pa, double mean_Pa);

/* Fracture as the weakest link of a stressed surface (two-parameter Weibull). */

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

typedef struct fw_flexure_limit {
    const char *criterion;  /* the row's name: "strength", "fracture", "yield", "fatigue" */
    const char *definition; /* what kind of number it is */
    double allowable_Pa;    /* fatigue: amplitude, fully reversed, of `cycles` equal cycles */
    fw_quantity_value_status status; /* the weakest of what went into it */
    const char *source;              /* of the number that it rests on most */
} fw_flexure_limit;

enum { FW_LIMITS = 4 };

typedef struct fw_flexure_limits {
    fw_flexure_limit item[FW_LIMITS]; /* (count) those that apply, in the order of the table */
    int count;
    int governing;               /* index of the lowest, fatigue left out; FW_NONE: nothing known */
    int fatigue;                 /* index of it, or FW_NONE */
    fw_flexure_weibull weibull;  /* of this flexure; .known: its data hold */
    fw_flexure_strain_life life; /* .known where fatigue >= 0 */
    const char *missing;         /* what was asked for and has no data; NULL: nothing */
    fw_place missing_place;      /* of what asked */
} fw_flexure_limits;

typedef struct fw_flexure_limit_input {
    const fw_device_material *material;
    const fw_flexure_input *flexure; /* shape, with its fillet; youngs_Pa of strain and stress */
    const fw_device_limits_asked *asked;
    int nhinge; /* of the whole device: in series, each may break it */
} fw_flexure_limit_input;

typedef struct fw_flexure_limit_row { /* adding a criterion is one function and one row */
    const char *name, *summary;
    /* true: *limit is what it allows. May say in `all` what it found beside, or missed */
    bool (*of)(const fw_flexure_limit_input *in, fw_flexure_limits *all, fw_flexure_limit *limit);
} fw_flexure_limit_row;
void fw_flexure_limits_of(const fw_flexure_limit_input *in, fw_flexure_limits *limits);

/* NULL where nothing is known */
const fw_flexure_limit *fw_flexure_limits_governing(const fw_flexure_limits *limits);

#endif
