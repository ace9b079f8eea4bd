/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers that nature and geometry give, once each: tests/arch/constants.py checks that their
   digits stand nowhere else. They are macros so that tables and other constants may use them.

   Physical constants: CODATA 2018 (P. J. Mohr, D. B. Newell, B. N. Taylor, E. Tiesinga, Reviews of
   Modern Physics 93, 025010, 2021). "Exact" is a value that defines a unit of the SI of 2019. */
#ifndef FW_BASE_CONSTANTS_H
#define FW_BASE_CONSTANTS_H

#define FW_PI          3.14159265358979323846
#define FW_TURN        6.28318530717958647693 /* 2 pi */
#define FW_DEG_PER_RAD 57.29577951308232      /* 180/pi, the nearest double */
#define FW_SQRT_2      1.4142135623730951     /* sqrt 2 */
#define FW_SQRT_HALF   0.70710678118654752    /* 1/sqrt 2 */
#define FW_E           2.71828182845904523536 /* the base of natural logarithms */

#define FW_BOLTZMANN_J_PER_K           1.380649e-23    /* exact */
#define FW_ELECTRONVOLT_J              1.602176634e-19 /* exact; multiples, each rounded once: */
#define FW_KILOELECTRONVOLT_J          1.602176634e-16
#define FW_MILLIELECTRONVOLT_J         1.602176634e-22
#define FW_FARADAY_C_PER_mol           96485.33212      /* exact to these digits */
#define FW_GAS_J_PER_mol_K             8.31446261815324 /* exact to these digits */
#define FW_VACUUM_PERMITTIVITY_F_PER_m 8.8541878128e-12 /* relative uncertainty 1.5e-10 */
#define FW_DRY_AIR_J_PER_kg_K          287.05           /* specific gas constant (ISO 2533) */
#define FW_STANDARD_ATMOSPHERE_Pa      101325.0         /* exact (ISO 2533) */
#define FW_STANDARD_GRAVITY_m_per_s2   9.80665          /* exact (CGPM 1901) */
#define FW_ICE_POINT_K                 273.15           /* 0 degrees Celsius, exact */
#endif
