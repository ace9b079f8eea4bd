/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares against their definition: no other parameter gives a smaller chi square, and the
   uncertainty is where it has risen by 1. Chi square against tables. */
#include "process/coupon.h"
#include "test.h"

static uint64_t seed = 3;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

enum { N = 7 };
typedef struct data {
    double y[N], sy[N], x[N], sx[N];
} data;

static data random_data(double R) {
    data d;
    for (int i = 0; i < N; i++) {
        double x = 1.0 + 9.0 * uniform();
        d.sx[i] = i % 2 ? 0.0 : 0.02 + 0.05 * uniform();
        d.sy[i] = 0.02 + 0.2 * uniform();
        d.x[i] = x + d.sx[i] * (uniform() - 0.5);
        d.y[i] = R * x + d.sy[i] * (uniform() - 0.5);
    }
    return d;
}

static double ratio_chi(const data *d, double R) {
    double sum = 0.0;
    for (int i = 0; i < N; i++) {
        double r = d->y[i] - R * d->x[i];
        sum += r * r / (d->sy[i] * d->sy[i] + R * R * d->sx[i] * d->sx[i]);
    }
    return sum;
}

static void ratio(void **state) {
    (void)state;
    for (int round = 0; round < 500; round++) {
        double R = 0.2 + 3.0 * uniform();
        data d = random_data(R);
        fw_process_fit f = fw_process_fit_ratio(d.y, d.sy, d.x, d.sx, N);
        double best = ratio_chi(&d, f.value[0]), u = f.uncertainty[0];
        assert_relative(f.chi_square, best, 1e-12);
        assert_int_equal(f.freedom, N - 1);
        for (double by = 1e-4; by < 0.1; by *= 10.0) {
            assert_true(ratio_chi(&d, f.value[0] * (1.0 + by)) > best);
            assert_true(ratio_chi(&d, f.value[0] * (1.0 - by)) > best);
        }
        assert_near(ratio_chi(&d, f.value[0] + u) - best, 1.0, 0.1);
        assert_near(ratio_chi(&d, f.value[0] - u) - best, 1.0, 0.1);
    }
}

static void mean(void **state) {
    (void)state;
    const double y[] = {3.0, 5.0}, s[] = {1.0, 2.0};
    fw_process_fit f = fw_process_fit_mean(y, s, 2);
    assert_relative(f.value[0], (3.0 + 5.0 / 4.0) / 1.25, 1e-15);
    assert_relative(f.uncertainty[0], sqrt(1.0 / 1.25), 1e-15);
    assert_relative(f.chi_square, 4.0 / 5.0, 1e-14); /* (difference)^2/(s1^2 + s2^2) */
    f = fw_process_fit_mean(y, s, 1);
    assert_near(f.value[0], 3.0, 0);
    assert_int_equal(f.freedom, 0);
}

static double plane_chi(const double *y, const double *s, const double *p, const double *q,
                        double a, double b) {
    double sum = 0.0;
    for (int i = 0; i < N; i++)
        sum += pow((y[i] - a * p[i] - b * q[i]) / s[i], 2);
    return sum;
}

static void plane(void **state) {
    (void)state;
    for (int round = 0; round < 500; round++) {
        double y[N], s[N], p[N], q[N], a = 4.0 * uniform() - 2.0, b = 4.0 * uniform() - 2.0;
        for (int i = 0; i < N; i++) {
            p[i] = uniform(), q[i] = uniform() * 3.0, s[i] = 0.1 + uniform();
            y[i] = a * p[i] + b * q[i] + s[i] * (uniform() - 0.5);
        }
        fw_process_fit f = fw_process_fit_plane(y, s, p, q, N);
        double best = plane_chi(y, s, p, q, f.value[0], f.value[1]);
        assert_near(f.chi_square, best, 1e-9 * (1.0 + best));
        /* chi^2 - best = (d^T C^-1 d), with C from the uncertainties and the correlation */
        double d0 = 0.3 * uniform(), d1 = 0.3 * uniform() - 0.15, r = f.correlation;
        double n0 = d0 / f.uncertainty[0], n1 = d1 / f.uncertainty[1];
        double rise = (n0 * n0 + n1 * n1 - 2.0 * r * n0 * n1) / (1.0 - r * r);
        assert_near(plane_chi(y, s, p, q, f.value[0] + d0, f.value[1] + d1) - best, rise,
                    1e-7 * (1.0 + rise));
        f = fw_process_fit_plane(y, s, p, q, 2); /* through both points */
        assert_near(f.value[0] * p[0] + f.value[1] * q[0], y[0], 1e-8);
        assert_near(f.value[0] * p[1] + f.value[1] * q[1], y[1], 1e-8);
    }
    const double same[] = {1, 1, 1};
    assert_true(isnan(fw_process_fit_plane(same, same, same, same, 3).value[0]));
}

/* Abramowitz and Stegun, table 26.8, and the integral of the density */
static void chi_square(void **state) {
    (void)state;
    static const struct {
        int n;
        double x, p;
    } list[] = {{1, 3.84146, 0.05},  {2, 5.99146, 0.05},  {3, 7.81473, 0.05},  {4, 9.48773, 0.05},
                {10, 18.3070, 0.05}, {15, 24.9958, 0.05}, {30, 43.7729, 0.05}, {1, 10.8276, 0.001},
                {2, 13.8155, 0.001}, {9, 27.8772, 0.001}, {10, 29.5883, 0.001}};
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        assert_near(fw_process_chi_square_above(list[i].x, list[i].n), list[i].p, 2e-6);
    assert_near(fw_process_chi_square_above(5.0, 0), 1.0, 0);
    for (int n = 1; n < 12; n++) { /* the derivative is the density */
        double x = 4.0, h = 1e-4;
        double density =
            pow(x, 0.5 * n - 1.0) * exp(-0.5 * x) / (pow(2.0, 0.5 * n) * tgamma(0.5 * n));
        assert_near(
            (fw_process_chi_square_above(x - h, n) - fw_process_chi_square_above(x + h, n)) /
                (2.0 * h),
            density, 1e-8);
        assert_near(fw_process_chi_square_above(0.0, n), 1.0, 1e-15);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(ratio), cmocka_unit_test(mean),
                                       cmocka_unit_test(plane), cmocka_unit_test(chi_square)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
