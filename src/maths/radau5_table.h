/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Radau IIA of order 5: nodes, A, the eigenvalues gamma and alpha +- i beta of A^-1, and T with
   T^-1 A^-1 T = [gamma 0 0; 0 alpha -beta; 0 beta alpha]; weights of the error estimate. Values
   from Hairer and Wanner, Solving ODEs II, 2nd ed., IV.8. That they belong together, to round-off:
   tests/unit/maths/test_ode_rk.c. */
#ifndef FW_MATHS_RADAU5_TABLE_H
#define FW_MATHS_RADAU5_TABLE_H

#define RADAU_ROOT6 2.4494897427831780982

static const double radau_c[3] = {(4 - RADAU_ROOT6) / 10, (4 + RADAU_ROOT6) / 10, 1};
static const double radau_a[3][3] = {
    {(88 - 7 * RADAU_ROOT6) / 360, (296 - 169 * RADAU_ROOT6) / 1800, (-2 + 3 * RADAU_ROOT6) / 225},
    {(296 + 169 * RADAU_ROOT6) / 1800, (88 + 7 * RADAU_ROOT6) / 360, (-2 - 3 * RADAU_ROOT6) / 225},
    {(16 - RADAU_ROOT6) / 36, (16 + RADAU_ROOT6) / 36, 1.0 / 9},
};
static const double radau_gamma = 3.6378342527444957322;
static const double radau_alpha = 2.6810828736277521339;
static const double radau_beta = 3.0504301992474105694;
static const double radau_t[3][3] = {
    {9.1232394870892942792e-02, -0.14125529502095420843, -3.0029194105147424492e-02},
    {0.24171793270710701896, 0.20412935229379993199, 0.38294211275726193779},
    {0.96604818261509293619, 1, 0},
};
static const double radau_ti[3][3] = {
    {4.3255798900631553510, 0.33919925181580986954, 0.54177053993587487119},
    {-4.1787185915519047273, -0.32768282076106238708, 0.47662355450055045196},
    {-0.50287263494578687595, 2.5719269498556054292, -0.59603920482822492497},
};
static const double radau_e[3] = {-(13 + 7 * RADAU_ROOT6) / 3, (-13 + 7 * RADAU_ROOT6) / 3,
                                  -1.0 / 3};

#endif
