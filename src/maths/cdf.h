/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distribution functions and their inverses, beside Student's t of student.h. */
#ifndef FW_MATHS_CDF_H
#define FW_MATHS_CDF_H

double fw_maths_normal_density(double u);
double fw_maths_normal_cdf(double u);
double fw_maths_normal_quantile(double p);
double fw_maths_normal_upper(double q);
double fw_maths_gamma_quantile(double p, double shape);
double fw_maths_beta_quantile(double p, double a, double b);

#endif
