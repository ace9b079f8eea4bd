/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Root of a continuous function in a bracket. */
#ifndef FW_MATHS_BRENT_H
#define FW_MATHS_BRENT_H

typedef double fw_function(const void *context, double x);

/* x in [a, b] with f(x) = 0 to within `tolerance` + 4 eps |x|; f(a) and f(b) must differ in sign,
   or one be 0, else NaN */
double fw_maths_brent_root(fw_function *f, const void *context, double a, double b,
                           double tolerance);

#endif
