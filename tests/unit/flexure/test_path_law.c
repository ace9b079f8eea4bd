/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Paths at finite rotation: against the law of plain arcs, against the exact beam, derivatives. */
#include "flexure/beam.h"
#include "flexure/path.h"
#include "flexure/section.h"
#include "test.h"

static uint64_t seed = 0xbead;
static double uniform(double low, double high) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 11) / 9007199254740992.0;
}

static fw_flexure_input arc(double r, double angle, double t) {
    return (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                              .radius_m = r,
                              .angle_rad = angle,
                              .length_m = r * angle,
                              .width_m = t,
                              .fillet_m = 0.4 * t,
                              .depth_m = 40e-6,
                              .youngs_Pa = 130e9,
                              .poisson = 0.28,
                              .strength_Pa = 1e9,
                              .safety_factor = 2};
}

/* one arc, by the table: the law of finite.c, values and both derivatives, at any rotation */
static void one_arc_has_the_arcs_law(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int trial = 0; trial < 12; trial++) {
        double r = uniform(60e-6, 200e-6), angle = uniform(1.2, 5), t = 0.08 * r;
        fw_flexure_input in = arc(r, angle, t), path = in;
        const fw_geometry_strip_piece one = {r * angle, 1 / r, {t, t, t}};
        path.kind = FW_FLEXURE_PATH, path.piece = &one, path.npiece = 1;
        fw_flexure_result a, b;
        fw_flexure_hinge_law law, table;
        fw_flexure_closed_form(&in, &a);
        fw_flexure_closed_form(&path, &b);
        fw_flexure_hinge_law_of(&in, &a, &law);
        assert_int_equal(fw_flexure_path_law(arena, &path, &b, &table), FW_OK);
        assert_relative(table.half_angle_rad, law.half_angle_rad, 1e-12);
        assert_relative(table.share, law.share, 1e-12);
        for (int i = -6; i <= 6; i++) {
            double th = 0.3 * i;
            fw_flexure_hinge_at p, q;
            fw_flexure_hinge_law_at(&law, th, &p);
            fw_flexure_hinge_law_at(&table, th, &q);
            const fw_flexure_hinge_jet *from[] = {&p.kx_N_per_m, &p.ky_N_per_m, &p.drift_m};
            const fw_flexure_hinge_jet *to[] = {&q.kx_N_per_m, &q.ky_N_per_m, &q.drift_m};
            for (int k = 0; k < 3; k++) {
                double size = k < 2 ? from[k]->value : r;
                assert_near(to[k]->value, from[k]->value, 1e-10 * size);
                assert_near(to[k]->slope, from[k]->slope, 1e-9 * size);
                assert_near(to[k]->curve, from[k]->curve, 1e-7 * size);
            }
        }
        assert_true(fw_flexure_hinge_law_holds(&table, 0.1) &&
                    !fw_flexure_hinge_law_holds(&table, 6.4));
    }
    fw_arena_free(arena);
}

/* where W of the second body goes: the exact beam, stiff against axial and shear strain */
static void drift_of_the_exact_beam(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_geometry_strip_piece hook[2] = {{120e-6, 0, {9e-6, 8e-6, 7e-6}},
                                             {80e-6 * 2, 1 / 80e-6, {7e-6, 7e-6, 8e-6}}};
    const fw_geometry_strip_piece hairpin[3] = {{90e-6, 0, {7e-6, 7e-6, 7e-6}},
                                                {60e-6 * 3, 1 / 60e-6, {7e-6, 9e-6, 7e-6}},
                                                {90e-6, 0, {7e-6, 7e-6, 7e-6}}};
    for (int which = 0; which < 3; which++) {
        fw_flexure_input in = arc(100e-6, 4, 7e-6);
        in.width_middle_m = 10e-6;
        if (which) {
            in.kind = FW_FLEXURE_PATH;
            in.piece = which == 1 ? hook : hairpin, in.npiece = which == 1 ? 2 : 3;
        }
        in.depth_m = 1e-7;
        fw_flexure_result out;
        fw_flexure_beam beam;
        fw_flexure_elastica *e;
        const fw_flexure_path_way *way;
        fw_flexure_closed_form(&in, &out);
        assert_int_equal(fw_flexure_path_beam(arena, &in, &out, &beam), FW_OK);
        beam.inextensible = true;
        fw_flexure_beam_linear linear;
        fw_flexure_beam_compliance(&beam, &linear);
        assert_int_equal(fw_flexure_elastica_new(arena, &beam, linear.centre_m, false, &e), FW_OK);
        assert_int_equal(fw_flexure_path_way_new(arena, &in, &way), FW_OK);
        for (int i = -4; i <= 4; i++) {
            double th = 0.25 * i, c = cos(0.5 * th), s = sin(0.5 * th);
            const fw_flexure_elastica_task turn = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                                   {th, 0, 0}};
            fw_flexure_elastica_result r;
            fw_flexure_path_pose pose;
            fw_flexure_elastica_solve(e, &turn, 1e-9, false, &r);
            assert_true(r.code == FW_ELASTICA_OK || r.error < 1e-6);
            fw_flexure_path_pose_at(way, th, &pose);
            /* Golovin's factor, (2/15) (t/2r)^2 = 2.6e-4 of the weights, is not in the beam */
            double size = 3e-4 * hypot(pose.drift_m[0], pose.drift_m[1]) + 1e-11;
            assert_near(c * r.twist[1] + s * r.twist[2], pose.drift_m[0], size);
            assert_near(c * r.twist[2] - s * r.twist[1], pose.drift_m[1], size);
            /* softness at a held rotation, by a small force besides */
            double F = 1e-4 / sqrt(pose.c[0][0] * pose.c[1][1]) * 1e-4;
            const fw_flexure_elastica_task push = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                                   {th, c * F, s * F}};
            fw_flexure_elastica_result more;
            fw_flexure_elastica_solve(e, &push, 1e-10, false, &more);
            double dx = more.twist[1] - r.twist[1], dy = more.twist[2] - r.twist[2];
            assert_near((c * dx + s * dy) / F, pose.c[0][0], 0.02 * pose.c[0][0]);
            assert_near((c * dy - s * dx) / F, pose.c[0][1],
                        0.02 * sqrt(pose.c[0][0] * pose.c[1][1]));
        }
        double drift, coupling;
        fw_flexure_path_left_out(way, 0.5, &drift, &coupling);
        if (which == 1)
            assert_true(drift > 1e-8 && coupling > 0.05);
        else {
            assert_near(drift, 0, 1e-15);
            assert_near(coupling, 0, 1e-9);
        }
    }
    fw_arena_free(arena);
}

/* first and second derivative against differences; the wrench is the gradient of an energy */
static void derivatives_of_the_table(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_flexure_input in = arc(100e-6, 4, 7e-6);
    in.width_middle_m = 10e-6;
    fw_flexure_result out;
    fw_flexure_hinge_law law;
    fw_flexure_closed_form(&in, &out);
    assert_int_equal(fw_flexure_path_law(arena, &in, &out, &law), FW_OK);
    for (int i = -5; i <= 5; i++) {
        double th = 0.21 * i, d = 1e-3;
        fw_flexure_hinge_at a, b, c;
        fw_flexure_hinge_law_at(&law, th - d, &a);
        fw_flexure_hinge_law_at(&law, th, &b);
        fw_flexure_hinge_law_at(&law, th + d, &c);
        const fw_flexure_hinge_jet *p[] = {&a.kx_N_per_m, &a.ky_N_per_m, &a.drift_m};
        const fw_flexure_hinge_jet *q[] = {&b.kx_N_per_m, &b.ky_N_per_m, &b.drift_m};
        const fw_flexure_hinge_jet *r[] = {&c.kx_N_per_m, &c.ky_N_per_m, &c.drift_m};
        for (int k = 0; k < 3; k++) {
            double size = k < 2 ? q[k]->value : 100e-6;
            assert_near(q[k]->slope, (r[k]->value - p[k]->value) / (2 * d), 3e-6 * size);
            assert_near(q[k]->curve, (r[k]->slope - p[k]->slope) / (2 * d), 3e-6 * size);
        }
        const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(&law);
        const double twist[3] = {th, 1e-6, -2e-6};
        double w[3], low[3], high[3], T[3][3], other[3][3];
        fw_flexure_hinge_law_wrench(&law, &rest, twist, w, T);
        for (int k = 0; k < 3; k++) {
            double step = k ? 1e-10 : 1e-5, from[3], to[3];
            for (int j = 0; j < 3; j++)
                from[j] = twist[j] - (j == k ? step : 0), to[j] = twist[j] + (j == k ? step : 0);
            fw_flexure_hinge_law_wrench(&law, &rest, from, low, other);
            fw_flexure_hinge_law_wrench(&law, &rest, to, high, other);
            for (int j = 0; j < 3; j++)
                assert_near(T[j][k], (high[j] - low[j]) / (2 * step),
                            1e-6 * sqrt(fabs(T[j][j] * T[k][k])));
        }
    }
    assert_relative(out.kx_N_per_m, 1 / law.bend_m_per_N, 0.01); /* Winkler's terms apart */
    fw_arena_free(arena);
}

/* the beam's compliance against the closed form's, at W: rotation, along and across. spread: m/N less along,
   since what ends lose is spread */
static void has_compliance(fw_arena *arena, const fw_flexure_input *in, double spread, double tol,
                           double place) {
    fw_flexure_result out;
    fw_flexure_beam beam;
    fw_flexure_beam_linear linear;
    fw_flexure_closed_form(in, &out);
    assert_int_equal(fw_flexure_path_beam(arena, in, &out, &beam), FW_OK);
    fw_flexure_beam_compliance(&beam, &linear);
    assert_relative(linear.c[0][0] * out.stiffness_Nm_per_rad, 1, 1e-9);
    assert_relative(linear.c[1][1], out.compliance[1][1] - spread, tol);
    assert_relative(linear.c[2][2], out.compliance[2][2], tol);
    assert_near(linear.centre_m[0], out.centre_m + out.offset_m[0], place);
    assert_near(linear.centre_m[1], out.offset_m[1], place);
    assert_relative(beam.depth_factor, 1, 1e-4); /* its parts have the stiffness by themselves */
}

/* Ends of a crystal lose up to 3 % of what a force bends, a third of that of what a moment turns, and blocks
   give with the mean modulus: the beam has both, in any direction. What an end loses stands l from it in the
   closed form, and is spread as exp(-s/l) in the beam, with a variance of l^2 */
static void beam_of_a_crystal(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    seed = 0x51c0;
    for (int trial = 0; trial < 16; trial++) {
        fw_flexure_input in = arc(100e-6, 4, uniform(4e-6, 10e-6));
        double t = in.width_m;
        in.kind = FW_FLEXURE_LEAF, in.radius_m = in.angle_rad = 0;
        in.length_m = uniform(20, 60) * t, in.depth_m = uniform(2, 10) * t;
        in.width_middle_m = uniform(0.6, 1.3) * t, in.fillet_m = uniform(0.2, 0.7) * t;
        in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, uniform(0, 1.6));
        const fw_flexure_end_loss loss = fw_flexure_end_loss_of(
            &in.crystal, in.depth_m, 1, in.length_m, fw_flexure_root_block_m(t, in.fillet_m));
        double lost = 2 * in.crystal.bow_per_Pa * loss.length_m * 12 / (in.depth_m * t * t * t);
        has_compliance(arena, &in, lost * loss.reach_m * loss.reach_m, 0.008, 1e-12);
        /* two pieces, one of them as an arc whose direction goes through all of the crystal's */
        const fw_geometry_strip_piece hook[2] = {{20 * t, 0, {t, t, 0.9 * t}},
                                                 {40 * t, 1 / (20 * t), {0.9 * t, t, t}}};
        in.kind = FW_FLEXURE_PATH, in.piece = hook, in.npiece = 2;
        in.length_m = in.width_middle_m = 0, in.depth_m = fmin(in.depth_m, 4 * t);
        has_compliance(arena, &in, 0, 0.005, 0.002 * 20 * t);
    }
    fw_arena_free(arena);
}

/* an arc in plane strain between lines in plane stress: each has its own depth factor */
static void beam_of_two_depths(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_geometry_strip_piece hairpin[3] = {{150e-6, 0, {4e-6, 4e-6, 4e-6}},
                                                {60e-6 * 3, 1 / 60e-6, {4e-6, 4e-6, 4e-6}},
                                                {150e-6, 0, {4e-6, 4e-6, 4e-6}}};
    fw_flexure_input in = arc(100e-6, 4, 4e-6);
    in.kind = FW_FLEXURE_PATH, in.piece = hairpin, in.npiece = 3;
    for (int ends = 0; ends < 2; ends++) {
        in.ends = ends;
        has_compliance(arena, &in, 0, 0.001, 0.1e-6);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_arc_has_the_arcs_law),
        cmocka_unit_test(drift_of_the_exact_beam),
        cmocka_unit_test(beam_of_a_crystal),
        cmocka_unit_test(beam_of_two_depths),
        cmocka_unit_test(derivatives_of_the_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
