/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures of any centre line and width: against arcs and leaves, against quadrature written out
   here, against the exact beam, and what must hold of any. */
#include "flexure/beam.h"
#include "flexure/path.h"
#include "test.h"

static uint64_t seed = 0xfeed;
static double uniform(double low, double high) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 11) / 9007199254740992.0;
}

static fw_flexure_input made_of(const fw_geometry_strip_piece *piece, int n) {
    return (fw_flexure_input){.kind = FW_FLEXURE_PATH,
                              .piece = piece,
                              .npiece = n,
                              .fillet_m = 4e-6,
                              .depth_m = 50e-6,
                              .youngs_Pa = 130e9,
                              .poisson = 0.28,
                              .strength_Pa = 1e9,
                              .safety_factor = 2};
}

static fw_flexure_input arc(double r, double angle, double t) {
    fw_flexure_input in = made_of(NULL, 0);
    in.kind = FW_FLEXURE_CSFH;
    in.radius_m = r, in.angle_rad = angle, in.length_m = r * angle, in.width_m = t;
    return in;
}

static fw_geometry_strip_piece bent(double r, double angle, double t) {
    return (fw_geometry_strip_piece){r * fabs(angle), copysign(1 / r, angle), {t, t, t}};
}

static void same(const fw_flexure_result *p, const fw_flexure_result *q, double tol) {
    assert_relative(p->stiffness_Nm_per_rad, q->stiffness_Nm_per_rad, tol);
    assert_relative(p->stiffness_thin, q->stiffness_thin, tol);
    assert_relative(p->kx_N_per_m, q->kx_N_per_m, tol);
    assert_relative(p->ky_N_per_m, q->ky_N_per_m, tol);
    assert_near(p->compliance[1][2], q->compliance[1][2],
                tol * sqrt(q->compliance[1][1] * q->compliance[2][2]));
    assert_relative(p->strain_per_rad, q->strain_per_rad, tol);
    assert_relative(p->limit_angle_rad, q->limit_angle_rad, tol);
    assert_relative(p->depth_factor, q->depth_factor, tol);
    assert_relative(p->concentration, q->concentration, tol);
    assert_relative(p->root_length_m, q->root_length_m, tol);
    assert_relative(p->youngs_Pa, q->youngs_Pa, tol);
    assert_relative(p->poisson, q->poisson, tol);
}

/* a path of one arc, of two halves of it, and a csfh with a width-middle that is no other (by the
   integral: just above the width) are that arc; crystals in any direction too */
static void one_arc_is_a_csfh(void **state) {
    (void)state;
    for (int trial = 0; trial < test_cases(60, 15); trial++) {
        double r = uniform(60e-6, 200e-6), angle = uniform(1.2, 5.5), t = r * uniform(0.04, 0.12);
        fw_flexure_input want = arc(r, angle, t);
        want.fillet_m = trial % 5 == 0 ? -1 : t * uniform(0.1, 0.9);
        if (trial % 3 == 1)
            want.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, uniform(-3, 3));
        if (trial % 6 == 2)
            want.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, (double)NAN);
        fw_flexure_result a, b;
        fw_flexure_closed_form(&want, &a);
        const fw_geometry_strip_piece one = bent(r, angle, t);
        const fw_geometry_strip_piece two[2] = {bent(r, 0.37 * angle, t), bent(r, 0.63 * angle, t)};
        for (int n = 1; n <= 2; n++) {
            fw_flexure_input in = want;
            in.kind = FW_FLEXURE_PATH;
            in.piece = n == 1 ? &one : two, in.npiece = n;
            fw_flexure_closed_form(&in, &b);
            same(&b, &a, 1e-12);
            /* W from the chord, as far as from the arc's centre less r cos a */
            assert_near(b.centre_m + b.offset_m[0],
                        a.centre_m + a.offset_m[0] - r * cos(0.5 * angle), 1e-12 * r);
            assert_near(b.offset_m[1], a.offset_m[1], 1e-12 * r);
        }
        fw_flexure_input in = want;
        in.width_middle_m = t;
        fw_flexure_closed_form(&in, &b);
        same(&b, &a, 0); /* not asked of the integral at all */
        in.width_middle_m = t * (1 + 1e-9);
        fw_flexure_closed_form(&in, &b);
        same(&b, &a, 1e-8);
        assert_near(b.centre_m, a.centre_m, 1e-8 * r);
    }
}

static void one_line_is_a_leaf(void **state) {
    (void)state;
    for (int trial = 0; trial < 30; trial++) {
        double L = uniform(200e-6, 600e-6), t = uniform(5e-6, 12e-6);
        fw_flexure_input want = made_of(NULL, 0);
        want.kind = FW_FLEXURE_LEAF, want.length_m = L, want.width_m = t;
        want.fillet_m = trial % 4 == 0 ? -1 : t * uniform(0.1, 0.9);
        if (trial % 2)
            want.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, uniform(-3, 3));
        fw_flexure_result a, b;
        fw_flexure_closed_form(&want, &a);
        const fw_geometry_strip_piece two[2] = {{0.3 * L, 0, {t, t, t}}, {0.7 * L, 0, {t, t, t}}};
        fw_flexure_input in = want;
        in.kind = FW_FLEXURE_PATH, in.piece = two, in.npiece = 2;
        fw_flexure_closed_form(&in, &b);
        same(&b, &a, 1e-12);
        assert_near(b.centre_m, 0, 1e-12 * L);
    }
}

/* a random path that does not cross itself and leaves its two ends apart */
static int random_path(fw_geometry_strip_piece *piece) {
    for (;;) {
        int n = 1 + (int)uniform(0, 4), i, j;
        double w = uniform(6e-6, 10e-6);
        for (int k = 0; k < n; k++) {
            double r = uniform(50e-6, 150e-6), angle = uniform(-3, 3), end = uniform(6e-6, 10e-6);
            bool line = uniform(0, 1) < 0.4;
            piece[k] = (fw_geometry_strip_piece){line ? uniform(50e-6, 250e-6) : r * fabs(angle),
                                                 line ? 0 : copysign(1 / r, angle),
                                                 {w, 0.5 * (w + end) * uniform(0.8, 1.2), end}};
            w = end;
        }
        const fw_geometry_pose end = fw_geometry_strip_end(piece, n, (fw_geometry_pose){0});
        double least = HUGE_VAL, length = fw_geometry_strip_length(piece, n);
        for (int k = 0; k < n; k++) {
            fw_geometry_strip_shape f;
            double low, high;
            fw_geometry_strip_shape_of(&piece[k], &f);
            fw_geometry_strip_widths(&f, &low, &high);
            least = fmin(least, isnan(low) ? 0 : low);
        }
        if (least > 3e-6 && length > 150e-6 && hypot(end.x_m, end.y_m) > 60e-6 &&
            !fw_geometry_strip_crosses(piece, n, &i, &j))
            return n;
    }
}

/* W, rotational and translational compliance by the midpoint rule on 20000 places, thin and shallow
   so that nothing but beam theory is left; converges with the square of the step. Of a crystal each
   place has the modulus of its own direction, and the mean is the one that bends as much */
static void brute_force(void **state) {
    (void)state;
    for (int trial = 0; trial < test_cases(12, 4); trial++) {
        fw_geometry_strip_piece piece[5];
        int n = random_path(piece);
        for (int i = 0; i < n; i++)
            for (int k = 0; k < 3; k++)
                piece[i].width_m[k] *= 0.02;
        fw_flexure_input in = made_of(piece, n);
        in.fillet_m = -1, in.depth_m = 1e-9;
        if (trial % 2)
            in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, uniform(-3, 3));
        const fw_flexure_crystal *c = &in.crystal;
        fw_flexure_result out;
        fw_flexure_closed_form(&in, &out);
        fw_flexure_course course;
        fw_flexure_path_of(&in, &course);
        enum { N = 20000 };
        double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, h = in.depth_m, thin = 0;
        for (int i = 0; i < n; i++)
            for (int k = 0; k < N; k++) {
                const fw_geometry_strip_piece *p = &course.shape[i].piece;
                double ds = p->length_m / N, s = (k + 0.5) * ds;
                const fw_geometry_pose at =
                    fw_geometry_strip_along(course.start[i], p->curvature_per_m, s);
                double t = fw_geometry_strip_width(&course.shape[i], s), soft = 1 / in.youngs_Pa;
                double turned = 4 * at.angle_rad;
                if (c->known)
                    soft = c->a0_per_Pa +
                           c->a1_per_Pa * (c->cos4 * cos(turned) - c->sin4 * sin(turned));
                double v = 12 * ds * soft / (h * t * t * t);
                thin += v / soft;
                w += v, x += v * at.x_m, y += v * at.y_m;
                xx += v * at.x_m * at.x_m, xy += v * at.x_m * at.y_m, yy += v * at.y_m * at.y_m;
            }
        x /= w, y /= w;
        double size = fw_geometry_strip_length(piece, n), far = w * size * size;
        assert_near(out.centre_m + out.offset_m[0], x, 1e-5 * size);
        assert_near(out.offset_m[1], y, 1e-5 * size);
        assert_relative(out.compliance[0][0], w, 1e-5);
        assert_relative(out.youngs_Pa, thin / w, 1e-6);
        assert_near(out.compliance[1][1], yy - w * y * y, 1e-5 * far);
        assert_near(out.compliance[2][2], xx - w * x * x, 1e-5 * far);
        assert_near(out.compliance[1][2], -(xy - w * x * y), 1e-5 * far);
        assert_true(out.centre_m >= -1e-9 * size);
    }
}

/* any path: symmetric, positive, the same from its other end and as a mirror image, softer when
   thinner, twice as stiff of twice the modulus */
static void what_holds_of_any(void **state) {
    (void)state;
    for (int trial = 0; trial < test_cases(60, 15); trial++) {
        fw_geometry_strip_piece piece[5], back[5];
        int n = random_path(piece);
        fw_flexure_input in = made_of(piece, n);
        fw_flexure_result o, p, q;
        fw_flexure_closed_form(&in, &o);
        const double(*C)[3] = (const double(*)[3])o.compliance;
        assert_true(C[0][0] > 0 && C[1][1] > 0 && C[2][2] > 0);
        assert_true(C[1][1] * C[2][2] > C[1][2] * C[1][2]);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                assert_true(C[i][j] == C[j][i]);
        assert_true(o.strain_per_rad > 0 && isfinite(o.limit_angle_rad));

        fw_geometry_strip_turned(piece, n, back); /* mirror image: axis kept, y turned round */
        fw_flexure_input other = in;
        other.piece = back;
        fw_flexure_closed_form(&other, &p);
        for (int i = 0; i < n; i++)
            back[i].curvature_per_m = -back[i].curvature_per_m;
        fw_flexure_closed_form(&other, &q); /* the same strip, walked from its other end */
        double size = o.error.centre_m + fw_geometry_strip_length(piece, n);
        bool straight = fabs(o.centre_m) < 1e-6 * size;
        for (int k = 0; k < 2 && !straight; k++) {
            const fw_flexure_result *r = k ? &q : &p;
            double sign = k ? 1 : -1;
            assert_relative(r->stiffness_Nm_per_rad, o.stiffness_Nm_per_rad, 1e-11);
            assert_relative(r->compliance[1][1], C[1][1], 1e-10);
            assert_relative(r->compliance[2][2], C[2][2], 1e-10);
            assert_near(r->compliance[1][2], sign * C[1][2], 1e-10 * (C[1][1] + C[2][2]));
            assert_near(r->offset_m[1], sign * o.offset_m[1], 1e-11 * size);
            assert_relative(r->strain_per_rad, o.strain_per_rad, 1e-9);
        }
        other = in;
        other.youngs_Pa *= 2;
        fw_flexure_closed_form(&other, &p);
        assert_relative(p.stiffness_Nm_per_rad, 2 * o.stiffness_Nm_per_rad, 1e-12);
        for (int i = 0; i < n; i++) {
            back[i] = piece[i];
            for (int k = 0; k < 3; k++)
                back[i].width_m[k] *= 0.9;
        }
        other = in;
        other.piece = back;
        fw_flexure_closed_form(&other, &p);
        assert_true(p.stiffness_Nm_per_rad < 0.75 * o.stiffness_Nm_per_rad);
    }
}

/* K and the way a small moment and small forces move W, by the geometrically exact beam of the same
   outline: what is left are Winkler's terms, (t/2r)^2/3, and the one depth factor for all */
static void beam_of_a_path(void **state) {
    (void)state;
    seed = 0xbead; /* its own shapes, however many the tests before it draw */
    for (int trial = 0; trial < 8; trial++) {
        fw_arena *arena = fw_arena_new(0);
        fw_geometry_strip_piece piece[5];
        int n = random_path(piece);
        fw_flexure_input in = made_of(piece, n);
        in.depth_m = 1e-7; /* plane stress: one depth factor */
        fw_flexure_result out;
        fw_flexure_closed_form(&in, &out);
        fw_flexure_beam beam;
        fw_flexure_elastica *e;
        assert_int_equal(fw_flexure_path_beam(arena, &in, &out, &beam), FW_OK);
        const double W[2] = {out.centre_m + out.offset_m[0], out.offset_m[1]};
        assert_int_equal(fw_flexure_elastica_new(arena, &beam, W, false, &e), FW_OK);
        double size = fw_geometry_strip_length(piece, n), M = 1e-5 * out.stiffness_Nm_per_rad;
        double softest = sqrt(out.compliance[1][1] + out.compliance[2][2]);
        for (int load = 0; load < 3; load++) {
            double F = 1e-6 * size / (softest * softest);
            const double wrench[3] = {load == 0 ? M : 0, load == 1 ? F : 0, load == 2 ? F : 0};
            fw_flexure_elastica_result r;
            fw_flexure_elastica_of_wrench(e, wrench, 1e-7, false, &r);
            assert_true(r.code == FW_ELASTICA_OK ||
                        (r.code == FW_ELASTICA_ROUGH && r.error < 1e-5));
            double unit[3] = {1 / sqrt(out.compliance[0][0]), 1 / softest, 1 / softest};
            double scale = load ? F * softest : M * sqrt(out.compliance[0][0]);
            for (int i = 0; i < 3; i++) {
                double want = 0;
                for (int j = 0; j < 3; j++)
                    want += out.compliance[i][j] * wrench[j];
                assert_near(r.twist[i] * unit[i], want * unit[i], 0.004 * scale);
            }
            if (load == 0) assert_relative(r.twist[0], M / out.stiffness_Nm_per_rad, 1e-8);
        }
        fw_arena_free(arena);
    }
}

/* thick in the middle: strain where the fillets are, less than of the thin strip; an hourglass
   bends in its middle, without Kt */
static void where_it_is_strained(void **state) {
    (void)state;
    fw_flexure_input leaf = made_of(NULL, 0);
    leaf.kind = FW_FLEXURE_LEAF, leaf.length_m = 400e-6, leaf.width_m = 12e-6;
    leaf.width_middle_m = 6e-6;
    fw_flexure_result out;
    fw_flexure_closed_form(&leaf, &out);
    /* there M t/2/EI with t = 6 um, by the closed form's own stiffness */
    double EI = leaf.youngs_Pa * leaf.depth_m * pow(6e-6, 3) / 12;
    double ended = out.stiffness_Nm_per_rad * out.ends_stiffer;
    assert_relative(out.strain_per_rad, ended * 3e-6 / EI, 1e-9);
    assert_relative(out.concentration, 1, 1e-12);
    fw_flexure_input swelling = arc(100e-6, 4, 6e-6), plain = swelling;
    swelling.width_middle_m = 9e-6;
    fw_flexure_result a, b;
    fw_flexure_closed_form(&swelling, &a);
    fw_flexure_closed_form(&plain, &b);
    assert_true(a.stiffness_Nm_per_rad > 1.5 * b.stiffness_Nm_per_rad);
    assert_true(a.strain_per_rad / (a.stiffness_Nm_per_rad * a.ends_stiffer) <
                1.001 * b.strain_per_rad / (b.stiffness_Nm_per_rad * b.ends_stiffer));
    assert_true(a.centre_m < b.centre_m); /* the roots weigh more */
}

static void errors_are_stated(void **state) {
    (void)state;
    const fw_geometry_strip_piece one = bent(100e-6, 4, 8e-6);
    const fw_geometry_strip_piece taper = {400e-6, 1 / 100e-6, {8e-6, 11e-6, 14e-6}};
    fw_flexure_input in = made_of(&one, 1), other = made_of(&taper, 1);
    fw_flexure_result a, b;
    fw_flexure_closed_form(&in, &a);
    fw_flexure_closed_form(&other, &b);
    assert_true(!a.error.outside && !b.error.outside);
    /* compared with solids: test_paths.c, test_forces.c */
    assert_true(b.error.stiffness > 0.002 && b.error.stiffness < 2 * a.error.stiffness);
    assert_true(b.error.kx > 0.8 * a.error.kx && b.error.ky > a.error.ky);
    assert_true(b.error.centre_m > a.error.centre_m && b.limit_uncertainty >= a.limit_uncertainty);

    /* a fillet as wide as the ends is inside of what was compared, however thin the middle */
    const fw_geometry_strip_piece waist = {400e-6, 1 / 100e-6, {8e-6, 7e-6, 8e-6}};
    other = made_of(&waist, 1);
    other.fillet_m = 8e-6;
    fw_flexure_closed_form(&other, &b);
    assert_true(b.error.stiffness > 0.5 * a.error.stiffness);
    assert_true(b.error.stiffness < 2 * a.error.stiffness);
    assert_true(b.error.kx > 0.5 * a.error.kx && b.error.kx < 2 * a.error.kx);

    /* between the roots of isotropic paths solids bear so much more than is said (tools/solids/between --isotropic) */
    const double found[][2] = {
        {3, 0.05}, {5, 0.035}, {6, 0.02}, {8, 0.006}}; /* radius over width, share */
    for (size_t i = 0; i < sizeof found / sizeof found[0]; i++) {
        const fw_geometry_strip_piece s_bend[] = {bent(found[i][0] * 8e-6, 2, 8e-6),
                                                  bent(found[i][0] * 8e-6, -2, 8e-6)};
        other = made_of(s_bend, 2);
        other.depth_m = 50e-6;
        fw_flexure_closed_form(&other, &b);
        const double near =
            other.length_m < 16 * 8e-6 ? 0.008 : 0; /* both ends: short ones have that besides */
        assert_true(b.error.above > found[i][1] && b.error.above < found[i][1] + 0.035 + near);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_arc_is_a_csfh), cmocka_unit_test(one_line_is_a_leaf),
        cmocka_unit_test(brute_force),       cmocka_unit_test(what_holds_of_any),
        cmocka_unit_test(beam_of_a_path),    cmocka_unit_test(where_it_is_strained),
        cmocka_unit_test(errors_are_stated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
