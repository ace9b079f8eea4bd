/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Centre line, sections and compliance of beams against closed forms, and finite elements of
   silicon (plane stress, anisotropic). */
#include "flexure/beam.h"
#include "flexure/finite.h"
#include "test.h"

static const double degree = M_PI / 180, um = 1e-6;

/* in the frame of a flexure: centre of the arc at the origin, symmetry axis +x */
static fw_flexure_beam arc(fw_flexure_beam_piece *piece, double r, double angle, double t, double h,
                           double E, double nu) {
    double a = 0.5 * angle;
    *piece = (fw_flexure_beam_piece){
        .length_m = 2 * a * r, .curvature_per_m = 1 / r, .width_m = {t, t, t}};
    return (fw_flexure_beam){.piece = piece,
                             .npiece = 1,
                             .x_m = r * cos(a),
                             .y_m = -r * sin(a),
                             .psi_rad = 0.5 * M_PI - a,
                             .depth_m = h,
                             .youngs_Pa = E,
                             .shear_Pa = E / (2 * (1 + nu))};
}

static void rules_are_exact(void **state) {
    (void)state;
    for (int n = 1; n <= FW_GAUSS_MOST; n++) {
        double x[FW_GAUSS_MOST], w[FW_GAUSS_MOST], a[FW_GAUSS_MOST * FW_GAUSS_MOST];
        fw_flexure_gauss_rule(n, x, w);
        fw_flexure_gauss_integrals(n, x, w, a);
        for (int p = 0; p < 2 * n; p++) {
            double sum = 0;
            for (int i = 0; i < n; i++)
                sum += w[i] * pow(x[i], p);
            assert_near(sum, 1.0 / (p + 1), 1e-15);
        }
        for (int i = 0; i < n; i++)
            for (int p = 0; p < n; p++) {
                double sum = 0;
                for (int j = 0; j < n; j++)
                    sum += a[i * n + j] * pow(x[j], p);
                assert_near(sum, pow(x[i], p + 1) / (p + 1), 2e-15);
            }
        /* one degree further it cannot be */
        double sum = 0;
        for (int i = 0; i < n; i++)
            sum += w[i] * pow(x[i], 2 * n);
        if (n < 8) assert_true(fabs(sum - 1.0 / (2 * n + 1)) > 1e-10);
    }
}

static void arcs_match_the_closed_form(void **state) {
    (void)state;
    const double angles[] = {1, 30, 90, 180, 225, 270, 330, 360};
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++)
        for (int stiff = 0; stiff < 2; stiff++) {
            double r = 100 * um, a = 0.5 * degree * angles[i], t = 8 * um, h = 50 * um, E = 169e9;
            fw_flexure_beam_piece piece;
            fw_flexure_beam beam = arc(&piece, r, 2 * a, t, h, E, 0.22);
            beam.inextensible = stiff;
            double EI = E * h * t * t * t / 12, EA = E * h * t,
                   kGA = 5.0 / 6 * h * t * beam.shear_Pa;
            double s = sin(a), c = cos(a), on = stiff ? 0 : 1;
            fw_flexure_beam_linear got;
            fw_flexure_beam_compliance(&beam, &got);
            assert_near(got.centre_m[0], r * s / a, 1e-13 * r);
            assert_near(got.centre_m[1], 0, 1e-14 * r);
            assert_relative(got.c[0][0], 2 * a * r / EI, 1e-13);
            double xx = r * r * r / EI * (a - s * c) + on * r / EA * (a - s * c) +
                        on * r / kGA * (a + s * c);
            /* a + sc - 2 s^2/a cancels: 2 a^5/45 - ... where the arc is short */
            double weight = a > 0.1
                                ? a + s * c - 2 * s * s / a
                                : pow(a, 5) * (2.0 / 45 - a * a * 2 / 315 + pow(a, 4) * 2 / 4725);
            double yy =
                r * r * r / EI * weight + on * r / EA * (a + s * c) + on * r / kGA * (a - s * c);
            assert_relative(got.c[1][1], xx, angles[i] < 20 ? 1e-9 : 1e-13);
            assert_near(got.c[2][2], yy, 1e-13 * (xx + yy));
            assert_near(got.c[1][2], 0, 1e-13 * (xx + yy));
            assert_near(got.c[0][1] + got.c[0][2] + got.c[2][0] + got.c[1][0], 0, 0);
            assert_near(got.compliance_centre_m[0], got.centre_m[0], 0);
            assert_near(got.turn_rad, 2 * a, 1e-15);
            assert_near(got.chord_m, 2 * r * s, 1e-15 * r);
            if (angles[i] < 330) assert_near(got.chord_rad, 0.5 * M_PI, 1e-14);
            assert_true(got.error < 1e-13);
        }
}

static void strips_match_the_closed_form(void **state) {
    (void)state;
    double L = 300 * um, t = 6 * um, h = 40 * um, E = 70e9, nu = 0.33, dL[2] = {3 * um, -1 * um};
    fw_flexure_beam_piece piece = {.length_m = L, .width_m = {t, t, t}};
    fw_flexure_beam beam = {.piece = &piece,
                            .npiece = 1,
                            .depth_m = h,
                            .youngs_Pa = E,
                            .shear_Pa = E / (2 * (1 + nu)),
                            .depth_factor = 1.05,
                            .root_m = {dL[0], dL[1]}};
    double EI = 1.05 * E * h * t * t * t / 12, A = h * t, whole = L + dL[0] + dL[1];
    double x = (0.5 * L * L + dL[1] * L) / whole;
    fw_flexure_beam_linear got;
    fw_flexure_beam_compliance(&beam, &got);
    assert_near(got.centre_m[0], x, 1e-14 * L);
    assert_relative(got.c[0][0], whole / EI, 1e-14);
    assert_relative(got.c[1][1], L / (E * A), 1e-14);
    double bend = (L * L * L / 3 + dL[1] * L * L - whole * x * x) / EI;
    assert_relative(got.c[2][2], bend + 1.2 * L / (A * beam.shear_Pa), 1e-13);
}

/* width linear in s: the integrals of s^k/t^3 in closed form; as parabola and as function */
static double narrowing(const void *context, int piece, double s_m) {
    const double *w = context;
    (void)piece;
    return w[0] + (w[1] - w[0]) * s_m / w[2];
}

static void tapers_match_the_closed_form(void **state) {
    (void)state;
    const double w[3] = {10 * um, 5 * um, 200 * um};
    double p = w[0], q = w[1], L = w[2], g = (q - p) / L, h = 20 * um, E = 115e9;
    fw_flexure_beam_piece piece = {.length_m = L, .width_m = {p, 0.5 * (p + q), q}};
    for (int way = 0; way < 2; way++) {
        fw_flexure_beam beam = {.piece = &piece,
                                .npiece = 1,
                                .depth_m = h,
                                .youngs_Pa = E,
                                .inextensible = true,
                                .width = way ? narrowing : NULL,
                                .context = w};
        /* with t = p + g s: int t^-3, int s t^-3 = (int t^-2 - p int t^-3)/g, and so on */
        double i3 = (1 / (p * p) - 1 / (q * q)) / (2 * g), i2 = (1 / p - 1 / q) / g;
        double i1 = log(q / p) / g, m0 = i3, m1 = (i2 - p * i3) / g;
        double m2 = (i1 - 2 * p * i2 + p * p * i3) / (g * g), f = 12 / (E * h);
        fw_flexure_beam_linear got;
        fw_flexure_beam_compliance(&beam, &got);
        assert_relative(got.c[0][0], f * m0, 1e-13);
        assert_relative(got.centre_m[0], m1 / m0, 1e-13);
        assert_relative(got.c[2][2], f * (m2 - m1 * m1 / m0), 1e-12);
        assert_true(got.error < 1e-13);
    }
    fw_flexure_beam_section at;
    fw_flexure_beam_pose start = {0};
    piece.width_m[1] = 6 * um;
    const fw_flexure_beam bow = {
        .piece = &piece, .npiece = 1, .depth_m = h, .youngs_Pa = E, .shear_Pa = E};
    for (int i = 0; i < 3; i++) {
        fw_flexure_beam_at(&bow, 0, &start, 0.5 * i * L, &at);
        assert_relative(at.width_m, piece.width_m[i], 1e-15);
    }
}

/* two strips at a right angle: weights at their middles, L^3/12 each about them */
static void kinks_turn_the_tangent(void **state) {
    (void)state;
    double L = 1, EI = 1;
    fw_flexure_beam_piece piece[2] = {{.length_m = L, .width_m = {1, 1, 1}},
                                      {.length_m = L, .kink_rad = -M_PI / 2, .width_m = {1, 1, 1}}};
    fw_flexure_beam beam = {.piece = piece,
                            .npiece = 2,
                            .psi_rad = M_PI / 2,
                            .depth_m = 1,
                            .youngs_Pa = 12,
                            .inextensible = true};
    fw_flexure_beam_linear got;
    fw_flexure_beam_pose pose[3];
    fw_flexure_beam_compliance(&beam, &got);
    fw_flexure_beam_poses(&beam, pose);
    assert_near(pose[1].psi_rad, 0, 1e-15);
    assert_near(pose[2].x_m, L, 1e-15);
    assert_near(pose[2].y_m, L, 1e-15);
    assert_near(got.centre_m[0], 0.25 * L, 1e-15);
    assert_near(got.centre_m[1], 0.75 * L, 1e-15);
    double own = L * L * L / (12 * EI), off = L * L * L / (16 * EI);
    assert_relative(got.c[1][1], own + 2 * off, 1e-14);
    assert_relative(got.c[2][2], own + 2 * off, 1e-14);
    /* int (x - xW)(y - yW) = -(1/4)^2 and (1/4)^2 twice, of the same sign; c_xy is its negative */
    assert_relative(got.c[1][2], -2 * off, 1e-14);
    assert_relative(got.chord_rad, M_PI / 4, 1e-15);
}

/* (100) silicon: 1/E = a0 + a1 cos 4 psi; closed forms of the arc, then finite elements */
static void silicon_along_an_arc(void **state) {
    (void)state;
    const double c11 = 165.7e9, c12 = 63.9e9, c44 = 79.6e9;
    double det = (c11 - c12) * (c11 + 2 * c12), s11 = (c11 + c12) / det, s12 = -c12 / det;
    double s0 = s11 - s12 - 0.5 / c44, a0 = s11 - 0.25 * s0, a1 = 0.25 * s0;
    assert_relative(1 / a0, 147.08e9, 1e-4);
    const double fe[3][3] = {{0, 30.256, 0}, {45, 29.770, 0}, {22.5, 30.024, -1.043}};
    for (int angle = 60; angle <= 300; angle += 30)
        for (int i = 0; i < 3; i++) {
            double r = 100 * um, t = 8 * um, h = 50 * um, a = 0.5 * angle * degree;
            double al = fe[i][0] * degree, I = h * t * t * t / 12;
            fw_flexure_beam_piece piece;
            fw_flexure_beam beam = arc(&piece, r, 2 * a, t, h, (double)NAN, 0.22);
            beam.cubic = true;
            beam.a0_per_Pa = a0, beam.a1_per_Pa = a1, beam.orientation_rad = al;
            beam.inextensible = true;
            fw_flexure_beam_linear got;
            fw_flexure_beam_compliance(&beam, &got);
            double w0 = 2 * a * a0 + 0.5 * a1 * cos(4 * al) * sin(4 * a);
            double wx = 2 * sin(a) * a0 + a1 * cos(4 * al) * (sin(3 * a) / 3 + sin(5 * a) / 5);
            double wy = -a1 * sin(4 * al) * (sin(3 * a) / 3 - sin(5 * a) / 5);
            assert_relative(got.c[0][0], r * w0 / I, 1e-13);
            assert_near(got.centre_m[0], r * wx / w0, 1e-13 * r);
            assert_near(got.centre_m[1], r * wy / w0, 1e-13 * r);
            if (angle != 270) continue;
            assert_near(got.centre_m[0] / um, fe[i][1], 0.025);
            assert_near(got.centre_m[1] / um, fe[i][2], 0.003);
        }
}

/* turned and moved: W goes with it, C turns */
static void frames_are_equal(void **state) {
    (void)state;
    fw_flexure_beam_piece piece[2] = {
        {.length_m = 0.7, .curvature_per_m = 2, .width_m = {0.05, 0.04, 0.06}},
        {.length_m = 0.4, .curvature_per_m = -1, .kink_rad = 0.3, .width_m = {0.06, 0.05, 0.05}}};
    fw_flexure_beam beam = {.piece = piece,
                            .npiece = 2,
                            .depth_m = 0.1,
                            .youngs_Pa = 1e9,
                            .shear_Pa = 4e8,
                            .root_m = {0.01, 0.02}};
    fw_flexure_beam_linear a, b;
    fw_flexure_beam_compliance(&beam, &a);
    double turn = 1.1, c = cos(turn), s = sin(turn);
    beam.x_m = 2, beam.y_m = -3, beam.psi_rad = turn;
    fw_flexure_beam_compliance(&beam, &b);
    assert_near(b.centre_m[0], 2 + c * a.centre_m[0] - s * a.centre_m[1], 1e-14);
    assert_near(b.centre_m[1], -3 + s * a.centre_m[0] + c * a.centre_m[1], 1e-14);
    double size = a.c[1][1] + a.c[2][2];
    assert_near(b.c[1][1], c * c * a.c[1][1] + s * s * a.c[2][2] - 2 * c * s * a.c[1][2],
                1e-13 * size);
    assert_near(b.c[1][2], c * s * (a.c[1][1] - a.c[2][2]) + (c * c - s * s) * a.c[1][2],
                1e-13 * size);
    assert_near(b.chord_rad, a.chord_rad + turn, 1e-14);
}

/* a notch: the error that is told holds against Simpson's rule with 1e6 places */
static double notch(const void *context, int piece, double s_m) {
    (void)context, (void)piece;
    return 0.1 - 0.08 * exp(-pow((s_m - 0.37) / 0.02, 2));
}

static void errors_are_told(void **state) {
    (void)state;
    fw_flexure_beam_piece piece = {.length_m = 1, .width_m = {0.1, 0.1, 0.1}};
    fw_flexure_beam beam = {.piece = &piece,
                            .npiece = 1,
                            .depth_m = 1,
                            .youngs_Pa = 12,
                            .inextensible = true,
                            .width = notch};
    fw_flexure_beam_linear got;
    fw_flexure_beam_compliance(&beam, &got);
    enum { N = 1000000 };
    long double sum = 0, first = 0;
    for (int i = 0; i <= N; i++) {
        long double w = (i == 0 || i == N ? 1 : i % 2 ? 4 : 2) / (3.0L * N);
        long double bend = (long double)pow(notch(NULL, 0, (double)i / N), -3);
        sum += w * bend, first += w * bend * i / N;
    }
    assert_relative(got.c[0][0], (double)sum, got.error + 1e-12);
    assert_near(got.centre_m[0], (double)(first / sum), got.error + 1e-12);
    assert_true(got.error < 1e-10);
}

/* the beam of a flexure has the stiffness of the closed form and the law's compliance at rest */
static void flexures_are_beams(void **state) {
    (void)state;
    for (int leaf = 0; leaf < 2; leaf++) {
        const fw_flexure_input in = {.kind = leaf ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                                     .length_m = 100 * um * 270 * degree,
                                     .angle_rad = leaf ? 0 : 270 * degree,
                                     .radius_m = leaf ? 0 : 100 * um,
                                     .width_m = 8 * um,
                                     .fillet_m = 4 * um,
                                     .depth_m = 50 * um,
                                     .youngs_Pa = 169e9,
                                     .poisson = 0.22,
                                     .strength_Pa = 500e6,
                                     .safety_factor = 1};
        fw_flexure_result closed;
        fw_flexure_beam_piece piece;
        fw_flexure_beam beam;
        fw_flexure_beam_linear got;
        fw_flexure_closed_form(&in, &closed);
        fw_flexure_beam_of_flexure(&in, &closed, &piece, &beam);
        fw_flexure_beam_compliance(&beam, &got);
        assert_relative(1 / got.c[0][0], closed.stiffness_Nm_per_rad, 1e-13);
        /* the neutral fibre of the thick arc, r u^2/3, is not in the beam */
        assert_near(got.centre_m[0], closed.centre_m, leaf ? 1e-18 : 0.02 * um);
        assert_near(got.centre_m[1], 0, 1e-16);
        fw_flexure_hinge_law law;
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_of(&in, &closed, &law);
        fw_flexure_hinge_law_at(&law, 0, &at);
        assert_relative(1 / got.c[1][1], at.kx_N_per_m.value, 5e-3);
        assert_relative(1 / got.c[2][2], at.ky_N_per_m.value, 5e-3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rules_are_exact),
        cmocka_unit_test(arcs_match_the_closed_form),
        cmocka_unit_test(strips_match_the_closed_form),
        cmocka_unit_test(tapers_match_the_closed_form),
        cmocka_unit_test(kinks_turn_the_tangent),
        cmocka_unit_test(silicon_along_an_arc),
        cmocka_unit_test(frames_are_equal),
        cmocka_unit_test(errors_are_told),
        cmocka_unit_test(flexures_are_beams),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
