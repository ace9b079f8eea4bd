/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distribution functions and their inverses, and the root in a bracket by which an inverse is found. */
#ifndef FW_MATHS_FUNCTIONS_H
#define FW_MATHS_FUNCTIONS_H

/* ---- roots ---- */

typedef double fw_function(const void *context, double x);

/* x in [a, b] with f(x) = 0 to within `tolerance` + 4 eps |x|; f(a) and f(b) must differ in sign,
   or one be 0, else NaN */
double fw_maths_brent_root(fw_function *f, const void *context, double a, double b,
                           double tolerance);

/* ---- distributions ---- */

double fw_maths_normal_density(double u);
double fw_maths_normal_cdf(double u);
double fw_maths_normal_quantile(double p);
double fw_maths_normal_upper(double q);
double fw_maths_gamma_quantile(double p, double shape);
double fw_maths_beta_quantile(double p, double a, double b);

/* Student's t, for means of few readings */
double fw_maths_student_quantile(double p, double n);

/* ---- the GNU Scientific Library ---- */

/* GSL answers by statuses and NaN from here on: its own handler of errors would end the process. It is one for the
   process, and designs run in parallel: it is written once */
void fw_maths_gsl_quiet(void);

#endif
