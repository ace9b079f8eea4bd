/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed form against every rung of the reference ladder: thin and thick formulas written out
   here once more, and finite elements (CalculiX, plane stress and 3-D, ideal and real roots; um,
   N/m, uN um/rad). */
#include "flexure/finite.h"
#include "flexure/section.h"
#include "test.h"

static const double degree = M_PI / 180;
enum { H1, H2, H3, H4 };

static fw_flexure_input hinge(int which, double fillet_m, double depth_m) {
    static const double angle[] = {270, 180, 270, 270}, t[] = {8e-6, 10e-6, 10e-6, 8e-6};
    fw_flexure_input in = {.kind = which == H4 ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                           .length_m = 100e-6 * angle[which] * degree,
                           .angle_rad = angle[which] * degree,
                           .radius_m = 100e-6,
                           .width_m = t[which],
                           .fillet_m = fillet_m,
                           .depth_m = depth_m,
                           .youngs_Pa = which == H3 ? 115e9 : 169e9,
                           .poisson = which == H3 ? 0.34 : 0.22,
                           .strength_Pa = 500e6,
                           .safety_factor = 1};
    return in;
}

static double deep(int which) {
    return which == H3 ? 9e-6 : 50e-6;
}

enum { IDEAL = -1 }; /* fillet of ends without roots */

static fw_flexure_result form(const fw_flexure_input *in) {
    fw_flexure_result out;
    memset(&out, 0xff, sizeof out); /* whatever is not set shows */
    fw_flexure_closed_form(in, &out);
    return out;
}

/* ratios of a thin arc, independent of t, h and E: as thin as numbers allow, no shear to speak of
 */
static void ratios_of_thin_arcs(void **state) {
    (void)state;
    const double row[][6] = {
        {90, 0.9003, 5.504, 129.2, 0.1230, 0.3183},  {120, 0.8270, 3.410, 43.80, 0.1561, 0.2387},
        {180, 0.6366, 2.000, 10.56, 0.2026, 0.1592}, {225, 0.4705, 1.695, 5.303, 0.2173, 0.1273},
        {270, 0.3001, 1.650, 3.291, 0.2137, 0.1061}, {300, 0.1910, 1.716, 2.626, 0.2019, 0.0955},
        {330, 0.0899, 1.840, 2.230, 0.1833, 0.0868}, {360, 0, 2, 2, 0.1592, 0.0796}};
    /* 120 deg: the printed 0.0746 is 0.1561/2.0944 rounded the wrong way */
    const double per_length[] = {0.0783, 0.0745, 0.0645, 0.0553, 0.0454, 0.0386, 0.0318, 0.0253};
    for (int i = 0; i < 8; i++) {
        double r = 100e-6, t = 1e-9, a = row[i][0] * degree;
        fw_flexure_input in = {.kind = FW_FLEXURE_CSFH,
                               .length_m = r * a,
                               .angle_rad = a,
                               .radius_m = r,
                               .width_m = t,
                               .fillet_m = IDEAL,
                               .depth_m = 1e-12,
                               .youngs_Pa = 1e11,
                               .poisson = 0.3,
                               .strength_Pa = 1,
                               .safety_factor = 1};
        fw_flexure_result o = form(&in);
        double K = o.stiffness_Nm_per_rad, digit = row[i][3] > 100 ? 0.05 : 0.005;
        assert_near(o.centre_m / r, row[i][1], 5.1e-5);
        assert_near(o.kx_N_per_m * r * r / K, row[i][2], 5.1e-4);
        assert_near(o.ky_N_per_m * r * r / K, row[i][3], row[i][3] < 10 ? 5.1e-4 : 1.05 * digit);
        /* strain without the fillet's concentration and the curved beam's share */
        assert_near(o.strain_per_rad / o.concentration * r / t, row[i][5], 5.1e-5);
        fw_flexure_hinge_law law;
        fw_flexure_hinge_law_of(&in, &o, &law);
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&law, 0, &at);
        assert_near(0.5 * at.drift_m.curve / r, row[i][4], 5.1e-5);
        assert_near(0.5 * at.drift_m.curve / law.length_m, per_length[i], 5.1e-5);
        assert_relative(at.kx_N_per_m.value, o.kx_N_per_m, 1e-6);
        assert_relative(at.ky_N_per_m.value, o.ky_N_per_m, 1e-6);
    }
    fw_flexure_input leaf = hinge(H4, IDEAL, 50e-6);
    leaf.width_m = 1e-9, leaf.fillet_m = IDEAL;
    fw_flexure_result o = form(&leaf);
    fw_flexure_hinge_law law;
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_of(&leaf, &o, &law);
    fw_flexure_hinge_law_at(&law, 0, &at);
    assert_relative(o.kx_N_per_m * pow(leaf.length_m, 2) / o.stiffness_Nm_per_rad, 12, 1e-9);
    assert_near(0.5 * at.drift_m.curve / law.length_m, 0.08333, 5e-6);
    /* the strip is shorter by what its ends lose (13a), which is nothing without Poisson's ratio */
    assert_true(o.ends_stiffer > 1);
    assert_near(o.strain_per_rad / (o.concentration * o.ends_stiffer) * leaf.length_m /
                    leaf.width_m,
                0.5, 1e-9);
    leaf.poisson = 0;
    o = form(&leaf);
    assert_near(o.strain_per_rad / o.concentration * leaf.length_m / leaf.width_m, 0.5, 1e-9);
}

/* every "closed" row of the ladder, printed digits: thin, Winkler with shear, Golovin, depth, root,
   depth and root */
static void closed_rows(void **state) {
    (void)state;
    const struct {
        double thin, golovin, depth, root, both; /* uN um/rad */
        double winkler_W, W, kx, ky;             /* um, N/m */
    } row[] = {
        {765075.5, 764912.2, 769847.5, 762545.1, 767465.1, 29.9945, 29.6829, 126.222, 251.226},
        {2241432.1, 2240684.3, 2250581.0, 2217860.7, 2227656.5, 63.6089, 62.9610, 447.866, 2331.65},
        {183028.2, 182967.1, 182969.4, 181720.4, 181722.7, 29.9855, 29.2994, 0, 0}};
    for (int i = H1; i <= H3; i++) {
        double h = deep(i), z = IDEAL, shallow = 1e-12;
        fw_flexure_input in = hinge(i, z, h);
        fw_flexure_result o = form(&in);
        assert_near(o.stiffness_thin * 1e12, row[i].thin, 0.051);
        assert_near(o.stiffness_Nm_per_rad * 1e12, row[i].depth, 0.051);
        assert_near(o.centre_m * 1e6, row[i].winkler_W, 5.1e-5);
        in = hinge(i, z, shallow); /* plane stress, scaled to the true depth */
        o = form(&in);
        double up = h / shallow;
        assert_near(o.stiffness_Nm_per_rad * 1e12 * up, row[i].golovin, 0.051);
        if (row[i].kx > 0) {
            assert_near(o.kx_N_per_m * up, row[i].kx, 5.1e-4);
            assert_near(o.ky_N_per_m * up, row[i].ky, row[i].ky > 1000 ? 5.1e-3 : 5.1e-4);
        }
        in = hinge(i, 4e-6, shallow);
        o = form(&in);
        assert_near(o.stiffness_Nm_per_rad * 1e12 * up, row[i].root, 0.051);
        in = hinge(i, 4e-6, h);
        o = form(&in);
        assert_near(o.stiffness_Nm_per_rad * 1e12, row[i].both, 0.051);
        assert_near(o.centre_m * 1e6, row[i].W, 5.1e-5);
    }
}

/* Winkler's thick arc written out: eq. of the theory, no roots, plane stress */
static void thick_arcs(void **state) {
    (void)state;
    for (int i = 0; i < 40; i++) {
        double a = 0.3 + 0.07 * i, t = (1 + i % 7) * 4e-6, r = 100e-6, h = 1e-12, E = 150e9;
        double nu = 0.27, A = h * t, u = t / (2 * r), s = sin(a), c = cos(a);
        fw_flexure_input in = {.kind = FW_FLEXURE_CSFH,
                               .length_m = 2 * a * r,
                               .angle_rad = 2 * a,
                               .radius_m = r,
                               .width_m = t,
                               .fillet_m = IDEAL,
                               .depth_m = h,
                               .youngs_Pa = E,
                               .poisson = nu,
                               .strength_Pa = 1,
                               .safety_factor = 1};
        fw_flexure_result o = form(&in);
        double rn = t / log((1 + u) / (1 - u)), e = r - rn, kGA = 5.0 / 6 * A * E / (2 * (1 + nu));
        assert_relative(o.centre_m, rn * s / a, 1e-9);
        assert_relative(o.compliance[1][1],
                        (a - s * c) * r * rn / (E * A * e) + r * (a + s * c) / kGA, 1e-9);
        assert_relative(o.compliance[2][2],
                        rn / (E * A * e) * (r * (a + s * c) - 2 * rn * s * s / a) +
                            r * (a - s * c) / kGA,
                        1e-8);
        assert_relative(o.kx_N_per_m * o.compliance[1][1], 1, 1e-14);
        assert_relative(o.stiffness_Nm_per_rad * o.compliance[0][0], 1, 1e-14);
        /* inner fibre, exact over the thin one */
        double inner = (rn / (r * (1 - u)) - 1) / (2 * a);
        assert_relative(o.strain_per_rad, inner, 0.7 * u * u + u * u * u);
        assert_true(o.strain_per_rad < inner); /* the series 1 + t/3r ends where terms add */
    }
}

/* roots are point rotations at the ends: the whole 3x3 by adding them to the free arc's, moved to
   its own centre */
static void roots_in_every_entry(void **state) {
    (void)state;
    for (int i = 0; i < 30; i++) {
        double t = 9e-6, rho = t * (0.05 + 0.03 * i), a = 0.5 + 0.08 * i, h = 1e-12;
        fw_flexure_input in = hinge(H1, IDEAL, h);
        in.angle_rad = 2 * a, in.length_m = 2 * a * in.radius_m, in.width_m = t;
        fw_flexure_result bare = form(&in);
        in.fillet_m = rho;
        fw_flexure_result o = form(&in);
        double EI = in.youngs_Pa * h * t * t * t / 12, dL = fw_flexure_root_length_m(t, rho);
        double x = in.radius_m * cos(a), y = in.radius_m * sin(a), W = o.centre_m;
        double shift = W - bare.centre_m, arc = 1 / bare.stiffness_Nm_per_rad, root = 2 * dL / EI;
        assert_relative(o.compliance[0][0], arc + root, 1e-3);
        assert_relative(o.compliance[1][1], bare.compliance[1][1] + root * y * y, 1e-12);
        assert_relative(o.compliance[2][2],
                        bare.compliance[2][2] + root * (x - W) * (x - W) + arc * shift * shift,
                        1e-5);
        /* a moment alone does not move W: first moments of arc and roots cancel about it */
        assert_near(arc * shift, root * (x - W), 2e-3 * fabs(root) * 1e-4);
    }
    fw_flexure_input in = hinge(H4, IDEAL, 50e-6);
    fw_flexure_result bare = form(&in);
    in.fillet_m = 2e-6;
    fw_flexure_result o = form(&in);
    double EI = in.youngs_Pa * 50e-6 * pow(8e-6, 3) / 12, dL = fw_flexure_root_length_m(8e-6, 2e-6);
    assert_relative(o.compliance[0][0] - bare.compliance[0][0], 2 * dL / EI, 1e-9);
    assert_relative(o.compliance[1][1] - bare.compliance[1][1],
                    2 * dL / EI * pow(0.5 * in.length_m, 2), 1e-9);
}

/* plane stress with real roots, rho = 0.5 to 8 um: K, W, kx, ky of finite elements (50 um; H3 9) */
static void plane_stress_real_roots(void **state) {
    (void)state;
    const double fe[][6] = {{H1, 0.5, 755134.4, 28.69641, 124.85552, 240.76060},
                            {H1, 1.0, 756068.0, 28.82078, 124.97818, 241.72879},
                            {H1, 2.0, 758081.5, 29.08897, 125.24518, 243.835},
                            {H1, 4.0, 762495.5, 29.67337, 125.84218, 248.523},
                            {H1, 8.0, 772519.1, 30.97956, 127.25919, 259.5106},
                            {H2, 0.5, 2186819.1, 62.04465, 426.5538, 2109.114},
                            {H2, 1.0, 2190741.7, 62.16038, 428.0492, 2124.48},
                            {H2, 2.0, 2199206.6, 62.40910, 431.3022, 2158.02},
                            {H2, 4.0, 2217817.6, 62.94801, 438.5546, 2233.296},
                            {H2, 8.0, 2260461.8, 64.13944, 455.673, 2413.352},
                            {H3, 0.5, 180011.6, 28.34194, 29.7792, 56.885364},
                            {H3, 4.0, 181718.5, 29.29346, 30.0055464, 58.656312},
                            {H3, 8.0, 184041.4, 30.56550, 30.330515, 61.15878}};
    for (size_t i = 0; i < sizeof fe / sizeof fe[0]; i++) {
        int which = (int)fe[i][0];
        fw_flexure_input in = hinge(which, fe[i][1] * 1e-6, 1e-12);
        fw_flexure_result o = form(&in);
        double up = deep(which) / 1e-12;
        assert_relative(o.stiffness_Nm_per_rad * 1e12 * up, fe[i][2], 6e-4);
        assert_near(o.centre_m * 1e6, fe[i][3], 0.06);
        assert_relative(o.kx_N_per_m * up, fe[i][4], 2.5e-3);
        assert_relative(o.ky_N_per_m * up, fe[i][5], 5e-3);
    }
}

/* 3-D, real roots, held out: what the closed form promises, and its own estimates hold */
static void three_dimensional_real_roots(void **state) {
    (void)state;
    const double fe[][6] = {{H1, 769198.6, 29.8787, 127.020, 251.951, 0.011625551},
                            {H2, 2235484.8, 63.1165, 443.768, 2269.21, 0.022574897},
                            {H3, 181755.1, 29.3113, 30.0111, 58.6924, 0.014438574}};
    const double printed[] = {0.01163, 0.02256, 0.01455};
    for (int i = H1; i <= H3; i++) {
        fw_flexure_input in = hinge(i, 4e-6, deep(i));
        fw_flexure_result o = form(&in);
        assert_relative(o.stiffness_Nm_per_rad * 1e12, fe[i][1], 0.006);
        assert_near(o.centre_m * 1e6, fe[i][2], 0.25);
        assert_relative(o.kx_N_per_m, fe[i][3], 0.008);
        assert_relative(o.ky_N_per_m, fe[i][4], 0.011);
        assert_near(o.strain_fit_per_rad, printed[i], 5.1e-6);
        /* never below a solid, and no more than: */
        assert_true(o.strain_per_rad >= fe[i][5] && o.strain_per_rad <= 1.015 * fe[i][5]);
        assert_relative(o.stiffness_Nm_per_rad * 1e12, fe[i][1], o.error.stiffness);
        assert_near(o.centre_m * 1e6, fe[i][2], o.error.centre_m * 1e6);
        assert_relative(o.kx_N_per_m, fe[i][3], o.error.kx);
        assert_relative(o.ky_N_per_m, fe[i][4], o.error.ky);
        assert_relative(o.strain_per_rad, fe[i][5], o.error.strain);
        assert_false(o.error.outside);
        assert_relative(o.limit_angle_rad * in.youngs_Pa * o.strain_per_rad, 500e6, 1e-13);
    }
    fw_flexure_input leaf = hinge(H4, IDEAL, 50e-6); /* rigid ends */
    fw_flexure_result o = form(&leaf);
    assert_relative(o.stiffness_Nm_per_rad * 1e12, 767802.8, o.error.stiffness);
    assert_relative(o.kx_N_per_m, 41.717, o.error.kx);
    assert_near(o.stiffness_Nm_per_rad * 1e12, 765075.5, 0.051);
}

/* at the centre of compliance moment and force are apart; the matrix is positive and scales */
static void compliance_is_one(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < 200; i++) {
        double v[6];
        for (int k = 0; k < 6; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            v[k] = (double)(seed >> 40) / 16777216.0;
        }
        fw_flexure_input in = hinge(i % 5 == 4 ? H4 : H1, 0, 0);
        in.width_m = (4 + 8 * v[0]) * 1e-6, in.fillet_m = in.width_m * (0.05 + 0.95 * v[1]);
        in.angle_rad = 0.5 + 5 * v[2], in.length_m = 100e-6 * in.angle_rad;
        in.depth_m = (2 + 60 * v[3]) * 1e-6, in.poisson = 0.45 * v[4];
        if (i % 2) in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, 3 * v[5]);
        fw_flexure_result o = form(&in);
        const double *c = &o.compliance[0][0];
        for (int k = 0; k < 9; k++)
            assert_true(isfinite(c[k]));
        assert_near(c[1], 0, 0);
        assert_near(c[2], 0, 0);
        assert_near(c[5], c[7], 0);
        assert_true(c[0] > 0 && c[4] > 0 && c[4] * c[8] > c[5] * c[5]);
        fw_flexure_input twice = in; /* moduli doubled: half as soft, same centre */
        twice.youngs_Pa *= 2;
        if (i % 2) twice.crystal = fw_flexure_crystal_cubic(331.4e9, 127.8e9, 159.2e9, 3 * v[5]);
        fw_flexure_result p = form(&twice);
        assert_relative(p.compliance[0][0], 0.5 * c[0], 1e-12);
        assert_relative(p.compliance[1][1], 0.5 * c[4], 1e-12);
        assert_relative(p.compliance[2][2], 0.5 * c[8], 1e-11);
        assert_near(p.offset_m[1], o.offset_m[1], 1e-17);
        assert_relative(p.stress_per_rad_Pa, 2 * o.stress_per_rad_Pa, 1e-12);
    }
}

/* beyond what was compared the estimates widen and say so */
static void estimates_widen(void **state) {
    (void)state;
    fw_flexure_input in = hinge(H1, 4e-6, 50e-6), near[4] = {in, in, in, in}, far[4];
    near[0].fillet_m = 0.4001e-6;                            /* the sharpest that was fitted */
    near[1].depth_m = 159.99e-6;                             /* the deepest */
    near[2].width_m = 14.99e-6;                              /* the thickest */
    near[3].angle_rad = 0.6401, near[3].length_m = 64.01e-6; /* the shortest */
    memcpy(far, near, sizeof far);
    far[0].fillet_m = 0.3999e-6;
    far[1].depth_m = 160.01e-6;
    far[2].width_m = 15.01e-6;
    far[3].angle_rad = 0.6399, far[3].length_m = 63.99e-6;
    /* by which solids are less strained than in the range of the law: deep ones, and short ones, whose ends reach each other */
    const double less[4] = {0, 0.04, 0, 0.004 + 0.05 * (50.0 / 64 - 0.4)};
    for (int i = 0; i < 4; i++) {
        const fw_flexure_error e = form(&far[i]).error, inside = form(&near[i]).error;
        assert_false(inside.outside);
        assert_true(e.outside);
        const bool thick = i == 2; /* whose strain and stiffness go on */
        assert_relative(e.stiffness, (thick ? 1 : 2) * inside.stiffness, 0.005);
        assert_relative(e.ky, 2 * inside.ky, 0.005);
        /* a fillet beyond the laws of the root: a guess besides */
        const double beyond = 2 * 0.025 + (i == 0 ? 0.10 : 0) + less[i];
        assert_relative(e.strain, thick ? inside.strain : beyond, 0.005);
        assert_relative(inside.strain, 0.011 + (i == 0 ? 0.04 : 0) + less[i], 0.005); /* sharp */
        assert_relative(e.centre_m, 2 * inside.centre_m, 0.005);
    }
    assert_near(form(&far[0]).limit_uncertainty, 0.065, 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ratios_of_thin_arcs),
        cmocka_unit_test(closed_rows),
        cmocka_unit_test(thick_arcs),
        cmocka_unit_test(roots_in_every_entry),
        cmocka_unit_test(plane_stress_real_roots),
        cmocka_unit_test(three_dimensional_real_roots),
        cmocka_unit_test(compliance_is_one),
        cmocka_unit_test(estimates_widen),
    };
    return cmocka_run_group_tests_name("ladder", tests, NULL, NULL);
}
