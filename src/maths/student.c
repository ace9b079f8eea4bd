/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/student.h"
#include <gsl/gsl_cdf.h>

/* Quantile of Student's t with n > 0 degrees of freedom: P(T <= t) = p, 0 < p < 1. Error 1e-12 relative. Source: GSL,
   gsl_cdf_tdist_Pinv (Hill, Comm. ACM 13 (1970) 619). Test: test_student.c (Abramowitz and Stegun, table 26.10). */
double fw_maths_student_quantile(double p, double n) {
    return gsl_cdf_tdist_Pinv(p, n);
}
