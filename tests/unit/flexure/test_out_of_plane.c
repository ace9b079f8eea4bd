/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures out of their plane: against closed forms of straight and circular beams, a series for the section that
   gives way, and solids of CalculiX that its root law was not fitted to. */
#include "base/constants.h"
#include "flexure/path.h"
#include "test.h"

static fw_flexure_input strip(double length, double radius, double width, double depth) {
    return (fw_flexure_input){.kind = radius > 0 ? FW_FLEXURE_CSFH : FW_FLEXURE_LEAF,
                              .length_m = length,
                              .radius_m = radius,
                              .angle_rad = radius > 0 ? length / radius : 0,
                              .width_m = width,
                              .fillet_m = -1,
                              .depth_m = depth,
                              .youngs_Pa = 100e9,
                              .poisson = 0.3,
                              .strength_Pa = 1e9,
                              .safety_factor = 1,
                              .ends = true};
}

static fw_flexure_out_of_plane of(fw_arena *arena, const fw_flexure_input *in) {
    fw_flexure_result closed;
    fw_flexure_out_of_plane out;
    fw_flexure_closed_form(in, &closed);
    assert_int_equal(fw_flexure_out_of_plane_of(arena, in, &closed, &out), FW_OK);
    return out;
}

/* b' C b of a wrench at another point, (dx, dy) from that of C: force and moments there */
static double moved(const fw_flexure_out_of_plane *o, double dx, double dy, const double w[3]) {
    const double at[3] = {w[0], w[1] + dy * w[0], w[2] - dx * w[0]};
    double sum = 0;
    for (int i = 0; i < 9; i++)
        sum += at[i / 3] * o->c[i / 3][i % 3] * at[i % 3];
    return sum;
}

/* J/(q p^3): Timoshenko and Goodier, art. 109, table 7 */
static void torsion_of_rectangles(void **state) {
    (void)state;
    const double table[][2] = {{1, 0.1406}, {1.5, 0.196}, {2, 0.229},
                               {3, 0.263},  {5, 0.291},   {10, 0.312}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        assert_near(fw_flexure_torsion_m4(2, 2 * table[i][0]) / (16 * table[i][0]), table[i][1],
                    6e-4);
        assert_relative(fw_flexure_torsion_m4(2 * table[i][0], 2),
                        fw_flexure_torsion_m4(2, 2 * table[i][0]), 1e-15);
    }
    assert_relative(fw_flexure_torsion_m4(1, 1), 0.14057701495515551, 1e-13);
    assert_relative(fw_flexure_torsion_m4(1, 1e6), (1e6 - 0.63025) / 3, 1e-9);
}

/* cantilever: L^3/3EI and shear; fixed-guided leaf: 12 EI/L^3 and shear; torsion with both ends that do not warp */
static void straight_leaf(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double L = 200e-6, w = 8e-6, h = 50e-6, E = 100e9, G = E / 2.6;
    const fw_flexure_input in = strip(L, 0, w, h);
    const fw_flexure_out_of_plane o = of(arena, &in);
    const double EI = E * w * h * h * h / 12, GA = G * w * h / 1.2,
                 GJ = G * fw_flexure_torsion_m4(w, h);
    const double down[3] = {1, 0, 0};
    assert_relative(moved(&o, 0, 0.5 * L, down), L * L * L / (3 * EI) + L / GA, 1e-9);
    assert_relative(1 / o.c[0][0], 1 / (L * L * L / (12 * EI) + L / GA), 1e-9);
    assert_relative(o.c[1][1], L / EI, 1e-9);
    const double even = (h * h - w * w) / (h * h + w * w),
                 warping = even * even * pow(w * h, 3) / 144;
    const double l = sqrt(E * warping / GJ);
    assert_relative(o.c[2][2], (L - 2 * l * tanh(0.5 * L / l)) / GJ, 1e-6);
    assert_near(o.c[0][1], 0, 1e-9 * sqrt(o.c[0][0] * o.c[1][1]));
    fw_arena_free(arena);
}

/* A force across the end of a cantilever, and a torque about it: 6 F L/(w h^2) at the root, at least that and at most twice
   it; of the torque the shear that Roark has for a rectangle (table 10.1, 4) and what a root that cannot warp puts on top */
static void strain_of_a_cantilever(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double L = 200e-6, w = 8e-6, h = 50e-6, E = 100e9, G = E / 2.6, F = 1e-3, T = 1e-8;
    const fw_flexure_input in = strip(L, 0, w, h);
    fw_flexure_result closed;
    double strain[2];
    fw_flexure_closed_form(&in, &closed);
    const double force[2][3] = {{F, 0.5 * L * F, 0}, {0, 0, T}};
    const double bends = 6 * F * L / (w * h * h * E);
    assert_int_equal(fw_flexure_across_strain(arena, &in, &closed, force, 1, strain), FW_OK);
    assert_relative(strain[0], bends, 1e-12);
    assert_in_range((long)(1e3 * strain[1] / bends), 1999, 2001);
    const double backwards[1][3] = {{-F, -0.5 * L * F, 0}};
    double same[2];
    assert_int_equal(fw_flexure_across_strain(arena, &in, &closed, backwards, 1, same), FW_OK);
    assert_relative(same[1], strain[1], 1e-15);
    const double shear = T * 3 / (8 * 0.5 * h * 0.25 * w * w) *
                         (1 + 0.6095 * w / h + 0.8865 * w * w / (h * h)) / G;
    double twisted[2];
    assert_int_equal(fw_flexure_across_strain(arena, &in, &closed, force + 1, 1, twisted), FW_OK);
    assert_true(twisted[0] < 1e-12 * bends);
    assert_true(twisted[1] > 0.5 * shear);
    assert_true(twisted[1] < 8 * shear); /* 2 w (3 G/E)^(1/2) beside w/2 */
    double all[2]; /* the second rings */
    assert_int_equal(fw_flexure_across_strain(arena, &in, &closed, force, 2, all), FW_OK);
    assert_relative(all[0], bends, 1e-12);
    assert_relative(all[1], strain[1] + twisted[1], 1e-12);
    fw_arena_free(arena);
}

/* Saint-Venant's warping of the rectangle of sides p along x and q along y, x y - sum of 8 (-1)^((n-1)/2)/(p k^3) sin(k x)
   sinh(k y)/cosh(k q/2) over odd n, k = n pi/p: Timoshenko and Goodier, art. 109 */
static double warps_by(double x, double y, double p, double q) {
    double sum = x * y;
    for (int n = 1; n < 100; n += 2) {
        const double k = n * FW_PI / p, sign = n % 4 == 1 ? 1 : -1;
        sum -= sign * 8 / (p * k * k * k) * sin(k * x) * exp(k * (y - 0.5 * q)) *
               -expm1(-2 * k * y) / (1 + exp(-k * q));
    }
    return sum;
}

/* max |phi| (J/Gamma)^(1/2): what an end that cannot warp makes of a twist, over (G/E)^(1/2); by the midpoint rule */
static double end_strain(double p, double q) {
    enum { N = 40 };
    double gamma = 0, most = 0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double phi = warps_by(0.5 * p * (i + 0.5) / N, 0.5 * q * (j + 0.5) / N, p, q);
            gamma += phi * phi * p * q / (N * N);
        }
    for (int i = 0; i <= N; i++) { /* harmonic: the most of it is on the edges */
        most = fmax(most, fabs(warps_by(0.5 * p, 0.5 * q * i / N, p, q)));
        most = fmax(most, fabs(warps_by(0.5 * p * i / N, 0.5 * q, p, q)));
    }
    return most * sqrt(fw_flexure_torsion_m4(p, q) / gamma);
}

/* strain at the end per twist and width, (strain - theta p/2)/(2 theta p), and of the twist T/GJ itself */
static double end_of(double w, double h, double nu, double *all) {
    fw_arena *arena = fw_arena_new(0);
    const double T = 1e-9, p = fmin(w, h);
    fw_flexure_input in = strip(20 * fmax(w, h), 0, w, h);
    in.poisson = nu;
    const double theta = T * 2 * (1 + nu) / (in.youngs_Pa * fw_flexure_torsion_m4(w, h));
    const double torque[1][3] = {{0, 0, T}};
    fw_flexure_result closed;
    double strain[2];
    fw_flexure_closed_form(&in, &closed);
    assert_int_equal(fw_flexure_across_strain(arena, &in, &closed, torque, 1, strain), FW_OK);
    fw_arena_free(arena);
    *all = strain[1] / (theta * p);
    return 0.5 * (strain[1] / theta - 0.5 * p) / p;
}

/* A twist that an end keeps from warping: above Vlasov's of the true warping of every rectangle, nowhere by more than a
   half, and even through the square. Bars of CalculiX (C3D20R), clamped at one end and turned at the other, which is free
   to warp: the largest principal strain a tenth of the shorter side from the clamp, and at it, where it grows with
   the mesh, both over theta p */
static void warping_of_rectangles(void **state) {
    (void)state;
    static const double solid[][4] = {{1, 0.25, 0.327, 0.432},   {1.1, 0.25, 0.352, 0.479},
                                      {1.3, 0.25, 0.392, 0.594}, {2, 0.25, 0.529, 0.861},
                                      {5, 0.25, 0.828, 1.299},   {10, 0.25, 0.994, 1.567}};
    const double tall[] = {0.2, 0.5, 0.8, 0.9, 0.99, 1, 1.02, 1.1, 1.3, 2, 3, 5, 10};
    double all, before = HUGE_VAL;
    for (size_t i = 0; i < sizeof tall / sizeof tall[0]; i++) {
        const double w = 10e-6, h = tall[i] * w, p = fmin(w, h), q = fmax(w, h), nu = 0.25;
        const double end = end_of(w, h, nu, &all), true_end = end_strain(p, q) / p / sqrt(2.5);
        assert_true(end > true_end);
        assert_true(end < 1.5 * true_end);
        assert_relative(end, sqrt(3 / 2.5), 1e-9);
    }
    for (size_t i = 0; i < sizeof solid / sizeof solid[0]; i++) {
        const double end = end_of(10e-6, 10e-6 * solid[i][0], solid[i][1], &all);
        assert_true(end > solid[i][2]);
        assert_true(all > 1.5 * solid[i][3]);
    }
    for (int i = 0; i < 100; i++) { /* the same torque strains a wider leaf less, through the square */
        const double w = 20e-6 + i * 0.3e-6, h = 36e-6;
        end_of(w, h, 0.25, &all);
        const double now = all * fmin(w, h) / fw_flexure_torsion_m4(w, h);
        assert_true(now < before);
        assert_true(i == 0 || now > 0.95 * before);
        before = now;
    }
}

/* A circular cantilever loaded square to its plane at its end: Roark, Formulas for Stress and Strain, table 9.4, 1e:
   P R^3 ((f/2 - sin 2f/4)/EI + (3f/2 - 2 sin f + sin 2f/4)/GJ), and shear. A square section does not warp, and one
   this slender does not give way across */
static void circular_cantilever(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double angles[] = {0.5, 0.5 * FW_PI, FW_PI, 1.5 * FW_PI}, R = 100e-6, w = 1e-6;
    for (size_t i = 0; i < 4; i++) {
        const double f = angles[i], E = 100e9, G = E / 2.6, EI = E * w * w * w * w / 12;
        const double GJ = G * fw_flexure_torsion_m4(w, w), down[3] = {1, 0, 0};
        const fw_flexure_input in = strip(R * f, R, w, w);
        const fw_flexure_out_of_plane o = of(arena, &in);
        const double exact =
            R * R * R *
                ((f / 2 - sin(2 * f) / 4) / EI + (1.5 * f - 2 * sin(f) + sin(2 * f) / 4) / GJ) +
            1.2 * R * f / (G * w * w);
        assert_relative(moved(&o, R * cos(f / 2) - o.at_m[0], R * sin(f / 2), down), exact, 2e-6);
    }
    fw_arena_free(arena);
}

/* Ritz: u = sum of a_k sin(2 pi k z/h) in the energy that fw_flexure_tall_arc minimises, term by term */
static double series(double R, double w, double h, double nu) {
    double sum = 0;
    for (int k = 1; k < 20000; k++) {
        double q = 2 * FW_PI * k / h, I = h / q / R, D = w * w * w / 12 / (1 - nu * nu);
        sum += w * w * I * I / (0.5 * w * h / (R * R) + 0.5 * D * q * q * q * q * h);
    }
    return 1 - sum / (w * h * h * h / 12);
}

static void a_tall_arc_gives_way(void **state) {
    (void)state;
    const double h[] = {2e-6, 10e-6, 25e-6, 50e-6, 100e-6, 200e-6};
    for (size_t i = 0; i < 6; i++)
        assert_relative(fw_flexure_tall_arc(1 / 75e-6, 8e-6, h[i], 0.3),
                        series(75e-6, 8e-6, h[i], 0.3), 1e-8);
    assert_relative(fw_flexure_tall_arc(0, 8e-6, 50e-6, 0.3), 1, 1e-15);
    assert_relative(fw_flexure_tall_arc(-1 / 75e-6, 8e-6, 50e-6, 0.3),
                    fw_flexure_tall_arc(1 / 75e-6, 8e-6, 50e-6, 0.3), 1e-15);
}

/* an arc in pieces, and walked as a path, is that arc */
static void pieces_of_an_arc(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double R = 80e-6, f = 3.2, w = 8e-6;
    fw_flexure_input one = strip(R * f, R, w, 50e-6), path = one;
    const fw_geometry_strip_piece piece[2] = {{0.3 * R * f, 1 / R, {w, w, w}},
                                              {0.7 * R * f, 1 / R, {w, w, w}}};
    path.kind = FW_FLEXURE_PATH, path.piece = piece, path.npiece = 2;
    const fw_flexure_out_of_plane a = of(arena, &one), b = of(arena, &path);
    for (int i = 0; i < 3; i++)
        assert_relative(b.c[i][i], a.c[i][i], 1e-5); /* W of a path leaves the fillets' share out */
    fw_arena_free(arena);
}

/* of a crystal: bending along <100> is 1/E100, and off the axes of symmetry it twists */
static void silicon(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double L = 300e-6, w = 10e-6, h = 40e-6, I = w * h * h * h / 12;
    for (int k = 0; k < 4; k++) {
        fw_flexure_input in = strip(L, 0, w, h);
        const double psi = k * FW_PI / 8;
        in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, psi);
        in.youngs_Pa = 147e9;
        const fw_flexure_out_of_plane o = of(arena, &in);
        const fw_flexure_crystal *c = &in.crystal;
        assert_relative(o.c[1][1], (c->a0_per_Pa + c->a1_per_Pa * cos(4 * psi)) * L / I, 1e-9);
        assert_near(o.c[1][2], -c->a1_per_Pa * sin(4 * psi) * L / I, 1e-9 * o.c[1][1]);
    }
    fw_arena_free(arena);
}

/* C of CalculiX 2.20, quadratic bricks with real fillets and blocks (refinement 1 of the program's own mesh with its
   middle plane antisymmetric; refinement 2 moves no figure by more than 0.4 %), none of which the root law was fitted
   to: zz, xx, yy. Silicon: an arc whose axis is 20 degrees from [100] */
static void solids_that_were_not_fitted(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const struct {
        double size, angle, w, rho, h, E, nu, c[3];
    } solid[] = {
        {300, 0, 10, 6, 30, 160, 0.22, {0.000781412, 88633.9, 560902}},
        {60, 270, 6, 5, 25, 160, 0.3, {0.00864434, 1.82688e+06, 1.26232e+06}},
        {100, 180, 10, 10, 50, 120, 0.35, {0.0015689, 210788, 252413}},
        {300, 60, 12, 9, 9, 120, 0.33, {0.0333854, 3.7922e+06, 4.40048e+06}},
        {150, 0, 12, 12, 50, 147, 0.28, {2.99997e-05, 9231.16, 88518.6}},
        {75, 230, 8, 8, 50, 0, 0.3, {0.001626234, 269730, 210301.3}},
    };
    for (size_t i = 0; i < sizeof solid / sizeof solid[0]; i++) {
        const double R = solid[i].angle > 0 ? 1e-6 * solid[i].size : 0,
                     f = solid[i].angle * FW_PI / 180;
        fw_flexure_input in =
            strip(R > 0 ? R * f : 1e-6 * solid[i].size, R, 1e-6 * solid[i].w, 1e-6 * solid[i].h);
        in.fillet_m = 1e-6 * solid[i].rho;
        in.youngs_Pa = 1e9 * solid[i].E, in.poisson = solid[i].nu;
        if (solid[i].E == 0) {
            in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, 20 * FW_PI / 180);
            in.youngs_Pa = 147e9;
        }
        const fw_flexure_out_of_plane o = of(arena, &in);
        for (int k = 0; k < 3; k++) {
            assert_near(o.c[k][k] / solid[i].c[k], 1, o.error);
            assert_near(o.c[k][k] / solid[i].c[k], 1, i == 4 ? 0.11 : 0.03);
        }
    }
    fw_arena_free(arena);
}

/* Strips with their own mass between ends that are held: 22.373 (EI/(m L^3))^(1/2) of a clamped bar, in the plane and across it,
   and 61.673; what goes with one end, 13/35 and 11/210 of a bar's mass; m a L/12 at a root, 0.89 of it by the first mode. An arc that
   is nearly straight is a bar. Source: Blevins, Formulas for Natural Frequency and Mode Shape, table 8-1 */
static void strips_that_swing(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double L = 2e-3, w = 8e-6, h = 12e-6, E = 100e9, sigma = 2330 * h;
    const double kg = sigma * w * L, first = 22.3733, second = 61.6728;
    for (int kind = 0; kind < 2; kind++)
        for (int across = 0; across < 2; across++) {
            const fw_flexure_input in = strip(L, kind ? 3000 * L : 0, w, h);
            fw_flexure_result closed;
            fw_flexure_path_strain strained;
            fw_flexure_own own;
            fw_flexure_closed_form(&in, &closed);
            assert_int_equal(fw_flexure_path_strain_new(arena, &in, &closed, &strained), FW_OK);
            assert_int_equal(
                fw_flexure_own_of(arena, &in, &closed, &strained, across, sigma, &own), FW_OK);
            const double EI = E * (across ? w * h * h * h : h * w * w * w) / 12,
                         s2 = kg * L * L * L / EI;
            assert_relative(own.s2[0], s2 / (first * first), 5e-3);
            assert_relative(own.s2[1], s2 / (second * second), 0.02);
            assert_true(own.rest_s2 < 0.3 * own.s2[1]);
            /* z, or x, of the second body where its end is, the pin at the middle: without a turn */
            double all = 0, moves = 0, load = 0, moment = 0;
            const int to = across ? 0 : 1;
            for (int i = 0; i < FW_OWN_PARTS; i++) {
                const double goes = own.goes[i][0][to], *mass = own.mass[i];
                all += mass[0], moves += mass[0] * goes * goes;
                load += mass[0] * own.mode[0][i][0];
            }
            assert_relative(all, kg, 1e-9);
            assert_relative(moves, 13.0 / 35 * kg, 5e-3);
            for (int i = 0; i < FW_OWN_PARTS; i++) { /* held at both ends: what the second bears is -goes */
                moment += own.mass[i][0] * own.mode[0][i][0] * own.moment[0][2 * i];
                for (int k = 0; k < 3; k++)
                    moment -= own.mass[i][0] * own.mode[0][i][0] * own.goes[i][0][k] *
                              own.moment[0][2 * FW_OWN_PARTS + k];
            }
            assert_relative(fabs(load * moment), 0.892 / 12 * kg * L, 0.02);
            assert_relative(own.by_moment[0], (across ? 2 : 1) * 6 / (E * (across ? w * h * h : h * w * w)), 0.03);
        }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torsion_of_rectangles),
        cmocka_unit_test(straight_leaf),
        cmocka_unit_test(strain_of_a_cantilever),
        cmocka_unit_test(strips_that_swing),
        cmocka_unit_test(warping_of_rectangles),
        cmocka_unit_test(circular_cantilever),
        cmocka_unit_test(a_tall_arc_gives_way),
        cmocka_unit_test(pieces_of_an_arc),
        cmocka_unit_test(silicon),
        cmocka_unit_test(solids_that_were_not_fitted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
