/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coefficients of the 5(4) pair of J. R. Dormand and P. J. Prince (J. Comp. Appl. Math. 6, 1980),
   with the dense output given in Hairer, Norsett and Wanner, Solving ODEs I, 2nd ed., II.5 and
   II.6. Order conditions: tests/unit/maths/test_ode_rk.c. */
#ifndef FW_MATHS_DOPRI5_TABLE_H
#define FW_MATHS_DOPRI5_TABLE_H

enum { DOPRI_STAGES = 7 };

static const double dopri_c[DOPRI_STAGES] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};

/* the last row is b */
static const double dopri_a[DOPRI_STAGES][DOPRI_STAGES - 1] = {
    {0},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};

/* b minus the weights of order 4 */
static const double dopri_e[DOPRI_STAGES] = {
    71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40,
};

static const double dopri_d[DOPRI_STAGES] = {
    -12715105075.0 / 11282082432,  0,
    87487479700.0 / 32700410799,   -10690763975.0 / 1880347072,
    701980252875.0 / 199316789632, -1453857185.0 / 822651844,
    69997945.0 / 29380423,
};

#endif
