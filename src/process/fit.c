/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/fit.h"
#include "base/constants.h"
#include <math.h>
#include <stdbool.h>

/* m = sum(y/s^2)/sum(1/s^2), u = 1/sqrt(sum(1/s^2)), chi^2 = sum((y - m)^2/s^2). Any one unit.
   Source: textbook, e.g. Bevington and Robinson, ch. 4. Test: test_fit.c, mean. */
fw_process_fit fw_process_fit_mean(const double *y, const double *s, int n) {
    fw_process_fit f = {.freedom = n - 1};
    double weight = 0.0, sum = 0.0;
    for (int i = 0; i < n; i++) {
        weight += 1.0 / (s[i] * s[i]);
        sum += y[i] / (s[i] * s[i]);
    }
    f.value[0] = sum / weight;
    f.uncertainty[0] = 1.0 / sqrt(weight);
    for (int i = 0; i < n; i++)
        f.chi_square += (y[i] - f.value[0]) * (y[i] - f.value[0]) / (s[i] * s[i]);
    return f;
}

/* R that minimises sum((y - R x)^2/v), v = s_y^2 + R^2 s_x^2: sum((y - R x) x^/v) = 0 with the
   adjusted x^ = x + R s_x^2 (y - R x)/v, solved by a fixed point that contracts by (s_x/x)^2.
   u = 1/sqrt(sum(x^2/v)). Source: York, Can. J. Phys. 44 (1966) 1079, through the origin.
   Test: test_fit.c, ratio; test_calibrate.c, coverage. */
fw_process_fit fw_process_fit_ratio(const double *y, const double *s_y, const double *x,
                                    const double *s_x, int n) {
    fw_process_fit f = {.freedom = n - 1};
    double R = 0.0, above = 0.0, below = 0.0;
    for (int i = 0; i < n; i++) {
        above += y[i] * x[i] / (s_y[i] * s_y[i]);
        below += x[i] * x[i] / (s_y[i] * s_y[i]);
    }
    R = above / below;
    for (int round = 0; round < 30; round++) {
        above = below = 0.0;
        for (int i = 0; i < n; i++) {
            double v = s_y[i] * s_y[i] + R * R * s_x[i] * s_x[i];
            double adjusted = x[i] + R * s_x[i] * s_x[i] * (y[i] - R * x[i]) / v;
            above += y[i] * adjusted / v;
            below += x[i] * adjusted / v;
        }
        R = above / below;
    }
    double weight = 0.0;
    for (int i = 0; i < n; i++) {
        double v = s_y[i] * s_y[i] + R * R * s_x[i] * s_x[i], r = y[i] - R * x[i];
        weight += x[i] * x[i] / v;
        f.chi_square += r * r / v;
    }
    f.value[0] = R;
    f.uncertainty[0] = 1.0 / sqrt(weight);
    return f;
}

/* Normal equations of two parameters: [pp pq; pq qq] [a b] = [py qy], sums weighted with 1/s^2; the
   inverse of the matrix is the covariance. Test: test_fit.c, plane. */
fw_process_fit fw_process_fit_plane(const double *y, const double *s, const double *p,
                                    const double *q, int n) {
    fw_process_fit f = {.freedom = n - 2};
    double pp = 0, pq = 0, qq = 0, py = 0, qy = 0;
    for (int i = 0; i < n; i++) {
        double w = 1.0 / (s[i] * s[i]);
        pp += w * p[i] * p[i], pq += w * p[i] * q[i], qq += w * q[i] * q[i];
        py += w * p[i] * y[i], qy += w * q[i] * y[i];
    }
    double det = pp * qq - pq * pq;
    if (!(det > 1e-12 * pp * qq)) {
        f.value[0] = f.value[1] = f.uncertainty[0] = f.uncertainty[1] = (double)NAN;
        return f;
    }
    f.value[0] = (qq * py - pq * qy) / det;
    f.value[1] = (pp * qy - pq * py) / det;
    f.uncertainty[0] = sqrt(qq / det);
    f.uncertainty[1] = sqrt(pp / det);
    f.correlation = -pq / sqrt(pp * qq);
    for (int i = 0; i < n; i++) {
        double r = y[i] - f.value[0] * p[i] - f.value[1] * q[i];
        f.chi_square += r * r / (s[i] * s[i]);
    }
    return f;
}

/* Q(n/2, x/2) for whole n, a finite sum: even n exp(-h) sum h^k/k!, k < n/2; odd n erfc(sqrt h) +
   exp(-h) sum h^(k+1/2)/Gamma(k + 3/2), k < (n - 1)/2; h = x/2. Source: Abramowitz and
   Stegun 26.4.4 and 26.4.5. Error 1e-14. Test: test_fit.c, chi_square (table 26.8). */
double fw_process_chi_square_above(double x, int n) {
    if (n <= 0) return 1.0;
    bool odd = n % 2 == 1;
    double h = 0.5 * x, sum = odd ? erfc(sqrt(h)) : 0.0;
    double term = odd ? exp(-h) * sqrt(h) / (0.5 * sqrt(FW_PI)) : exp(-h);
    for (int k = 0; k < n / 2; k++) {
        sum += term;
        term *= h / (k + (odd ? 1.5 : 1.0));
    }
    return fmin(sum, 1.0);
}
