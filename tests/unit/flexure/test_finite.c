/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hinge at finite rotation against tables of the geometrically exact beam (mpmath, 28 digits;
   um, uN, rad there), closed forms and differences. */
#include "flexure/finite.h"
#include "test.h"

static const double degree = M_PI / 180;

/* a strip without roots, axial and shear compliance: inextensible */
static fw_flexure_hinge_law thin(double r_m, double angle_deg, double EI) {
    double a = 0.5 * angle_deg * degree, L = 2 * a * r_m;
    return (fw_flexure_hinge_law){.stiffness_Nm_per_rad = EI / L,
                                  .half_angle_rad = a,
                                  .length_m = L,
                                  .share = 1,
                                  .bend_m_per_N = L * L * L / (8 * EI)};
}

/* u of W2 in the first body's frame under a dead force (fx, fy) there, at th; *M the moment */
static void loaded(const fw_flexure_hinge_law *law, double th, double fx, double fy, double u[2],
                   double *M) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(law, th, &at);
    double c = cos(0.5 * th), s = sin(0.5 * th);
    double fe = c * fx + s * fy, fn = c * fy - s * fx;
    double w = fe / at.kx_N_per_m.value, v = fn / at.ky_N_per_m.value, y = v + at.drift_m.value;
    u[0] = c * w - s * y, u[1] = s * w + c * y;
    /* dU/dth at fixed u: the frame turns by half of th */
    *M = law->stiffness_Nm_per_rad * th + 0.5 * at.kx_N_per_m.slope * w * w +
         0.5 * at.ky_N_per_m.slope * v * v - fn * at.drift_m.slope + 0.5 * (fe * y - fn * w);
}

/* everything that a law can have */
static fw_flexure_hinge_law example(double half_angle_rad) {
    return (fw_flexure_hinge_law){.stiffness_Nm_per_rad = 1e-6,
                                  .half_angle_rad = half_angle_rad,
                                  .length_m = 300e-6,
                                  .share = 0.97,
                                  .bend_m_per_N = 0.05,
                                  .root_m_per_N = 1e-3,
                                  .axial_m_per_N = 2e-4,
                                  .shear_m_per_N = 5e-4,
                                  .uneven_x = 0.1,
                                  .uneven_y = -0.05};
}

static FILE *table(const char *name) {
    char line[600], path[600];
    snprintf(path, sizeof path, "%s/tests/data/hinge/%s", FW_TEST_SOURCE_DIR, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    return file;
}

/* the table's own column of this law, and its error against the beam, which falls with the square
   of the force: 4 rows of forces that halve */
static void against_the_beam(void **state) {
    (void)state;
    FILE *file = table("prb3theta_check.csv");
    char line[600];
    int rows = 0;
    double last = 0;
    while (fgets(line, sizeof line, file)) {
        double angle, th, fx, fy, x, y, M, px, py, pM, u[2], moment;
        assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &angle, &th, &fx,
                                &fy, &x, &y, &M, &px, &py, &pM),
                         10);
        fw_flexure_hinge_law law = thin(100e-6, angle, 169e9 * 50e-6 * pow(8e-6, 3) / 12);
        loaded(&law, th * degree, fx * 1e-6, fy * 1e-6, u, &moment);
        assert_near(u[0] * 1e6, px, 1e-11 * hypot(px, py) + 1e-12);
        assert_near(u[1] * 1e6, py, 1e-11 * hypot(px, py) + 1e-12);
        assert_relative(moment * 1e12, pM, 1e-11);
        double off = hypot(u[0] * 1e6 - x, u[1] * 1e6 - y);
        assert_true(off < 6e-3);
        if (rows % 4 != 0) assert_relative(last / off, 4, 0.03);
        last = off;
        rows++;
    }
    fclose(file);
    assert_int_equal(rows, 60);
}

/* both theories of the beam; with axial and shear compliance the law is no longer exact, but as
   near as what these change under a moment */
static void against_the_reference(void **state) {
    (void)state;
    FILE *file = table("ge_hinge_reference.csv");
    char line[600], which[8], theory[32];
    int rows = 0;
    double worst[2] = {0, 0}, worst_moment = 0;
    while (fgets(line, sizeof line, file)) {
        double th, fx, fy, M, root, tip, x, y, u[2], moment;
        assert_int_equal(sscanf(line, "%7[^,],%31[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", which,
                                theory, &th, &fx, &fy, &M, &root, &tip, &x, &y),
                         10);
        bool soft = strcmp(theory, "inextensible") != 0, h3 = strcmp(which, "H3") == 0;
        double t = h3 ? 10e-6 : 8e-6, h = h3 ? 9e-6 : 50e-6, E = h3 ? 115e9 : 169e9;
        double nu = h3 ? 0.34 : 0.22;
        fw_flexure_hinge_law law = thin(100e-6, 270, E * h * t * t * t / 12);
        law.axial_m_per_N = soft ? law.length_m / (2 * E * h * t) : 0;
        law.shear_m_per_N = soft ? law.length_m * 2 * (1 + nu) / (2 * 5.0 / 6.0 * E * h * t) : 0;
        loaded(&law, th * degree, fx * 1e-6, fy * 1e-6, u, &moment);
        double off = hypot(u[0] * 1e6 - x, u[1] * 1e6 - y);
        worst[soft] = fmax(worst[soft], off);
        worst_moment = fmax(worst_moment, fabs(moment * 1e12 / M - 1));
        if (fx == 0 && fy == 0 && !soft) assert_true(off < 1e-9);
        rows++;
    }
    fclose(file);
    assert_int_equal(rows, 80);
    if (!(worst[0] < 4e-3 && worst[1] < 6e-3 && worst_moment < 1e-5))
        fail_msg("off by %g um, %g um; moment %g", worst[0], worst[1], worst_moment);
}

/* the angle at which the drift alone closes a gap, r = 100 um: table of the hinge's theory */
static void gaps_close(void **state) {
    (void)state;
    const double angle[] = {90, 120, 180, 225, 270, 300, 330, 360};
    const double deg[][4] = {{16.4, 23.3, 28.6, 37.0}, {14.6, 20.7, 25.4, 32.9},
                             {12.8, 18.2, 22.3, 29.0}, {12.4, 17.6, 21.6, 28.1},
                             {12.5, 17.8, 21.9, 28.5}, {12.9, 18.4, 22.6, 29.5},
                             {13.6, 19.4, 23.9, 31.2}, {14.7, 21.0, 25.9, 33.8}};
    const double gap[] = {1e-6, 2e-6, 3e-6, 5e-6};
    for (int i = 0; i < 8; i++)
        for (int g = 0; g < 4; g++) {
            fw_flexure_hinge_law law = thin(100e-6, angle[i], 1e-6);
            fw_flexure_hinge_at at;
            /* the table winds the arc and has one decimal */
            fw_flexure_hinge_law_at(&law, (deg[i][g] - 0.06) * degree, &at);
            assert_true(at.drift_m.value < gap[g]);
            fw_flexure_hinge_law_at(&law, (deg[i][g] + 0.06) * degree, &at);
            assert_true(at.drift_m.value > gap[g]);
        }
}

/* derivatives against differences of order 6, through a = 0 and through where the series end */
static void derivatives(void **state) {
    (void)state;
    const double half[] = {0, 0.01, 0.4, 0.98, 1.0, 1.7, 2.36, 3.0};
    const double turn[] = {-0.8, -0.2, 0, 0.013, 0.05, 0.21};
    const double weight[7] = {-1, 9, -45, 0, 45, -9, 1};
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 6; j++) {
            fw_flexure_hinge_law law = example(half[i]);
            fw_flexure_hinge_at at, near;
            const double h = 1e-3;
            double slope[3] = {0}, curve[3] = {0};
            fw_flexure_hinge_law_at(&law, turn[j], &at);
            for (int k = -3; k <= 3; k++) {
                fw_flexure_hinge_law_at(&law, turn[j] + k * h, &near);
                const fw_flexure_hinge_jet jet[3] = {near.kx_N_per_m, near.ky_N_per_m,
                                                     near.drift_m};
                for (int m = 0; m < 3; m++) {
                    slope[m] += weight[k + 3] * jet[m].value / (60 * h);
                    curve[m] += weight[k + 3] * jet[m].slope / (60 * h);
                }
            }
            const fw_flexure_hinge_jet jet[3] = {at.kx_N_per_m, at.ky_N_per_m, at.drift_m};
            const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(&law);
            fw_flexure_hinge_law_slopes(&law, &rest, turn[j], &near);
            const fw_flexure_hinge_jet first[3] = {near.kx_N_per_m, near.ky_N_per_m, near.drift_m};
            for (int m = 0; m < 3; m++) {
                assert_near(first[m].value, jet[m].value, 1e-15 * fabs(jet[m].value));
                assert_near(first[m].slope, jet[m].slope, 1e-15 * fabs(jet[m].slope));
                double size = m == 2 ? law.length_m : fabs(jet[m].value);
                assert_near(jet[m].slope, slope[m], 1e-10 * size);
                assert_near(jet[m].curve, curve[m], 2e-9 * (size + fabs(jet[m].curve)));
            }
        }
}

/* large turns leave the short series: same law, to rounding */
static void far_turns(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        fw_flexure_hinge_law law = example(1.2 + 0.05 * i);
        const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(&law);
        for (int side = -1; side <= 1; side += 2) {
            fw_flexure_hinge_at in, out;
            double th = side * 1.6;
            fw_flexure_hinge_law_slopes(&law, &rest, th - side * 1e-9, &in);
            fw_flexure_hinge_law_slopes(&law, &rest, th + side * 1e-9, &out);
            assert_relative(in.kx_N_per_m.value, out.kx_N_per_m.value, 1e-7);
            assert_near(in.drift_m.value + side * 2e-9 * in.drift_m.slope, out.drift_m.value,
                        1e-15 * law.length_m + 1e-17 * law.length_m);
            assert_near(in.drift_m.slope, out.drift_m.slope, 1e-8 * law.length_m);
        }
    }
}

/* ---- the inextensible elastica by shooting, independent of the law ---- */

typedef struct strip { /* clamped at the first root, frame of the free arc, W at rest at W[] */
    double a, L, W[2], EI;
} strip;

/* end of the strip for a moment M at W, W displaced by u, a dead force F there: angle of the end
   less that at rest, and its place; RK4 */
static void shoot(const strip *b, const double z[3], const double F[2], double end[3]) {
    enum { N = 240 };
    double r = b->a > 0 ? b->L / (2 * b->a) : 0, h = b->L / N;
    double p[3] = {r * cos(b->a), b->a > 0 ? -r * sin(b->a) : -0.5 * b->L, 0.5 * M_PI - b->a};
    double phi0 = p[2] + 2 * b->a;
    for (int i = 0; i < N; i++) {
        double k[4][3], sum[3] = {0};
        for (int j = 0; j < 4; j++) {
            double step = j == 0 ? 0 : j == 3 ? h : 0.5 * h, q[3];
            for (int n = 0; n < 3; n++)
                q[n] = p[n] + (j > 0 ? step * k[j - 1][n] : 0);
            double moment = z[0] + (b->W[0] + z[1] - q[0]) * F[1] - (b->W[1] + z[2] - q[1]) * F[0];
            k[j][0] = cos(q[2]), k[j][1] = sin(q[2]);
            k[j][2] = 2 * b->a / b->L + moment / b->EI;
            for (int n = 0; n < 3; n++)
                sum[n] += k[j][n] * (j == 0 || j == 3 ? h / 6 : h / 3);
        }
        for (int n = 0; n < 3; n++)
            p[n] += sum[n];
    }
    end[0] = p[2] - phi0, end[1] = p[0], end[2] = p[1];
}

/* by how much the end misses where body 2, turned by th and displaced by u, holds it */
static void miss(const strip *b, double th, const double z[3], const double F[2], double g[3]) {
    double end[3], free[3];
    const double none[3] = {0}, nothing[2] = {0};
    shoot(b, z, F, end);
    shoot(b, none, nothing, free);
    double x = free[1] - b->W[0], y = free[2] - b->W[1];
    g[0] = (end[0] - th) * b->L;
    g[1] = end[1] - (b->W[0] + z[1] + cos(th) * x - sin(th) * y);
    g[2] = end[2] - (b->W[1] + z[2] + sin(th) * x + cos(th) * y);
}

/* Newton, derivatives by differences; z from the law */
static void exact(const strip *b, double th, const double F[2], double z[3]) {
    const double size[3] = {b->EI / b->L, b->L, b->L};
    for (int round = 0; round < 8; round++) {
        double g[3], near[3], J[3][4];
        miss(b, th, z, F, g);
        for (int k = 0; k < 3; k++) {
            double y[3] = {z[0], z[1], z[2]}, h = 1e-5 * size[k];
            y[k] += h;
            miss(b, th, y, F, near);
            y[k] -= 2 * h;
            double back[3];
            miss(b, th, y, F, back);
            for (int n = 0; n < 3; n++)
                J[n][k] = (near[n] - back[n]) / 2e-5;
        }
        for (int n = 0; n < 3; n++)
            J[n][3] = g[n];
        for (int c = 0; c < 3; c++) { /* Gauss with pivoting */
            int best = c;
            for (int n = c + 1; n < 3; n++)
                if (fabs(J[n][c]) > fabs(J[best][c])) best = n;
            for (int k = 0; k < 4; k++) {
                double t = J[c][k];
                J[c][k] = J[best][k], J[best][k] = t;
            }
            for (int n = 0; n < 3; n++) {
                double part = n == c ? 0 : J[n][c] / J[c][c];
                for (int k = 0; k < 4; k++)
                    J[n][k] -= part * J[c][k];
            }
        }
        for (int k = 0; k < 3; k++)
            z[k] -= size[k] * J[k][3] / J[k][k];
    }
}

/* displacement by the law against the elastica: the error falls with the square of the force, at
   every rotation, for arcs and the straight leaf */
static void error_goes_with_the_square_of_the_force(void **state) {
    (void)state;
    const double angle[] = {0, 90, 180, 270};
    for (int i = 0; i < 4; i++)
        for (int deg = -30; deg <= 60; deg += 15) {
            double a = 0.5 * angle[i] * degree, EI = 1e-10, L = 400e-6, last = 0;
            strip b = {.a = a, .L = L, .EI = EI};
            if (a > 0) b.W[0] = L / (2 * a) * sin(a) / a;
            fw_flexure_hinge_law law = {.stiffness_Nm_per_rad = EI / L,
                                        .half_angle_rad = a,
                                        .length_m = L,
                                        .share = 1,
                                        .bend_m_per_N = L * L * L / (8 * EI),
                                        .axial_m_per_N =
                                            i == 0 ? 1e-9 : 0}; /* else 0/0 at no turn */
            for (int half = 0; half < 3; half++) {
                double f = EI / (L * L) * 0.2 / (1 << half), F[2] = {0.77 * f, 0.64 * f}, u[2], M;
                if (i == 0) F[0] = 0.3 * f;
                loaded(&law, deg * degree, F[0], F[1], u, &M);
                double z[3] = {M, u[0], u[1]};
                exact(&b, deg * degree, F, z);
                double off = hypot(z[1] - u[0], z[2] - u[1]);
                if (!(off < 2e-3 * L))
                    fail_msg("%g deg %d deg %d: u %g %g exact %g %g M %g %g", angle[i], deg, half,
                             u[0], u[1], z[1], z[2], M, z[0]);
                if (half > 0) assert_relative(last / off, 4, 0.06 / half);
                last = off;
                assert_relative(z[0], M, deg == 0 ? 1 : 1e-2);
            }
        }
}

/* linear theory: exact integrals of the free arc at no rotation, straight leaf, roots as weights */
static void at_rest(void **state) {
    (void)state;
    double r = 100e-6, a = 135 * degree, s = sin(a), c = cos(a), EI = 3.6e-10, dL = 0.7e-6;
    double L = 2 * a * r, W = (L * r * s / a + 2 * dL * r * c) / (L + 2 * dL);
    fw_flexure_hinge_law law = thin(r, 270, EI);
    law.share = L / (L + 2 * dL), law.root_m_per_N = dL * L * L / (2 * EI);
    law.axial_m_per_N = 3e-5, law.shear_m_per_N = 7e-5;
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(&law, 0, &at);
    double p = 2 * 3e-5 / L * r, v = 2 * 7e-5 / L * r; /* r/EA, r/kGA */
    double x = pow(r, 3) / EI * (a - s * c) + p * (a - s * c) + v * (a + s * c) +
               2 * dL * r * r * s * s / EI;
    /* int (x - W)^2 ds = r^3 (a + sc) - 2 W r^2 2 s + W^2 L, and the two ends */
    double y =
        (pow(r, 3) * (a + s * c) - 4 * W * r * r * s + W * W * L + 2 * dL * pow(r * c - W, 2)) /
            EI +
        p * (a + s * c) + v * (a - s * c);
    assert_relative(at.kx_N_per_m.value, 1 / x, 1e-12);
    assert_relative(at.ky_N_per_m.value, 1 / y, 1e-12);
    assert_near(at.drift_m.value, 0, 1e-19);
    assert_near(at.drift_m.slope, 0, 1e-18); /* W is the elastic centre, the roots included */

    fw_flexure_hinge_law leaf = {.stiffness_Nm_per_rad = 1e-6,
                                 .length_m = L,
                                 .share = 1,
                                 .bend_m_per_N = L * L * L / (8 * EI),
                                 .axial_m_per_N = L / (2 * 5.0),
                                 .shear_m_per_N = L / (2 * 2.0)};
    fw_flexure_hinge_law_at(&leaf, 0, &at);
    assert_relative(at.kx_N_per_m.value, 1 / (L * L * L / (12 * EI) + L / 2.0), 1e-13);
    assert_relative(at.ky_N_per_m.value, 5.0 / L, 1e-13);
    for (double th = -0.4; th < 0.5; th += 0.2) {
        fw_flexure_hinge_law_at(&leaf, th, &at);
        double half = 0.5 * th + 1e-300;
        assert_near(at.drift_m.value, L * (sin(half) / half - cos(half)), 1e-15 * L);
    }
}

static fw_flexure_input real_root(double angle_rad, double width_m) {
    return (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                              .length_m = 100e-6 * angle_rad,
                              .angle_rad = angle_rad,
                              .radius_m = 100e-6,
                              .width_m = width_m,
                              .fillet_m = 4e-6,
                              .depth_m = 50e-6,
                              .youngs_Pa = 169e9,
                              .poisson = 0.22,
                              .strength_Pa = 1e9,
                              .safety_factor = 1};
}

/* a leaf is stiffer along its strip (y) and bends as before; an arc bends and stretches less, and turns as before */
static void stiffer_along_itself(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    assert_non_null(arena);
    const double half[2] = {0, 1.1}, by = 1.25;
    for (int i = 0; i < 2; i++) {
        fw_flexure_hinge_law law = example(half[i]);
        fw_flexure_hinge_at was, now;
        fw_flexure_hinge_law_at(&law, 0, &was);
        assert_int_equal(fw_flexure_hinge_law_along(arena, &law, by), FW_OK);
        fw_flexure_hinge_law_at(&law, 0, &now);
        assert_relative(now.ky_N_per_m.value, by * was.ky_N_per_m.value, 1e-12);
        assert_relative(now.kx_N_per_m.value, (i ? by : 1) * was.kx_N_per_m.value, 1e-12);
        assert_relative(law.stiffness_Nm_per_rad, 1e-6, 1e-12);
    }
    fw_arena_free(arena);
}

/* with real roots: forces against 3-D finite elements of H1 and H2 (N/m), and the drift, less what
   the printed centre was off by (um) */
static void against_finite_elements(void **state) {
    (void)state;
    const struct {
        fw_flexure_input in;
        double kx, ky, deg, shift, centre, thin_centre;
    } row[] = {
        {real_root(1.5 * M_PI, 8e-6), 127.020, 251.951, 10, 0.66283, 29.8787, 30.0105},
        {real_root(M_PI, 10e-6), 443.768, 2269.21, 10, 0.70753, 63.1165, 63.6620},
    };
    for (int i = 0; i < 2; i++) {
        fw_flexure_result out;
        fw_flexure_hinge_law law;
        fw_flexure_hinge_at at;
        fw_flexure_closed_form(&row[i].in, &out);
        fw_flexure_hinge_law_of(&row[i].in, &out, &law);
        fw_flexure_hinge_law_at(&law, 0, &at);
        assert_relative(at.kx_N_per_m.value, row[i].kx, 0.01);
        assert_relative(at.ky_N_per_m.value, row[i].ky, 0.014);
        fw_flexure_hinge_law_at(&law, row[i].deg * degree, &at);
        double seen = row[i].shift - row[i].deg * degree * (row[i].thin_centre - row[i].centre);
        assert_near(at.drift_m.value * 1e6, seen, 0.006);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_the_beam),
        cmocka_unit_test(against_the_reference),
        cmocka_unit_test(gaps_close),
        cmocka_unit_test(derivatives),
        cmocka_unit_test(far_turns),
        cmocka_unit_test(error_goes_with_the_square_of_the_force),
        cmocka_unit_test(at_rest),
        cmocka_unit_test(against_finite_elements),
        cmocka_unit_test(stiffer_along_itself),
    };
    return cmocka_run_group_tests_name("finite", tests, NULL, NULL);
}
