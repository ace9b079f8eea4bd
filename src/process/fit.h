/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weighted least squares of one or two parameters in closed form. Private to process/. */
#ifndef FW_PROCESS_FIT_H
#define FW_PROCESS_FIT_H

typedef struct fw_process_fit {
    double value[2], uncertainty[2], correlation;
    double chi_square;
    int freedom;
} fw_process_fit;

/* mean of y (n) with standard uncertainties s (n) */
fw_process_fit fw_process_fit_mean(const double *y, const double *s, int n);
/* y = R x through the origin, both with errors: s_y, s_x (n; s_x may be 0) */
fw_process_fit fw_process_fit_ratio(const double *y, const double *s_y, const double *x,
                                    const double *s_x, int n);
/* y = a p + b q; s of y (n). value[0] = a. Needs n >= 2 and p, q not in proportion: else NaN */
fw_process_fit fw_process_fit_plane(const double *y, const double *s, const double *p,
                                    const double *q, int n);
/* probability of a chi square above x with n degrees of freedom; n 0: 1 */
double fw_process_chi_square_above(double x, int n);

#endif
