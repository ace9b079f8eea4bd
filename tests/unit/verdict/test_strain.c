/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strains of hinges under rotation and force by the closed form. */
#include "verdict/strain.h"
#include "test.h"

/* A whole six-bar of six equal arcs (r 100 um, 270 deg, t 8 um, h 50 um, E 147.08 GPa) under four
   loads. Angle, joint force and half-rotated frame from an independent statics of ideal pins; the
   last column is the largest section moment of the geometrically exact solution (uN um). */
static const struct {
    const char *name;
    double angle_rad, fx_uN, fy_uN, turned_rad, moment;
} reference[] = {
    {"L1 A", 0.126513013, -33.3271777, 31.9585347, 1.63405283, 88144.0699},
    {"L1 B", -0.0821794128, -33.3271777, 31.9585347, 0.0854233062, 60117.7415},
    {"L1 C", -0.00851517877, -33.3271777, 31.9585347, -1.53072032, 9456.68071},
    {"L1 D", 0.0313006143, -33.3271777, 31.9585347, -1.5193276, 26103.7788},
    {"L1 E", 0.0395946772, -33.3271777, 31.9585347, 3.22850903, 31793.4952},
    {"L1 F", -0.106713712, -33.3271777, 31.9585347, 1.62415318, 76278.983},
    {"L2 A", -0.0529705564, 176.059523, 2.91532745e-15, 1.54431105, 49006.199},
    {"L2 B", 0.126580847, 176.059523, 2.91532745e-15, 0.0103198671, 101212.558},
    {"L2 C", -0.0736102905, 176.059523, 2.91532745e-15, -1.53399118, 65411.4427},
    {"L2 D", -0.0736102905, 176.059523, 2.91532745e-15, -1.60760147, 66252.8174},
    {"L2 E", 0.126580847, 176.059523, 2.91532745e-15, 3.13127279, 102369.418},
    {"L2 F", -0.0529705564, 176.059523, 2.91532745e-15, 1.5972816, 48357.1935},
    {"L3 A", -0.114398159, -80.5220656, -72.6570829, 1.51359725, 89946.2909},
    {"L3 B", 0.0544309992, -80.5220656, -72.6570829, -0.0871826597, 48448.6051},
    {"L3 C", 0.0414133644, -80.5220656, -72.6570829, -1.6100568, 40260.3927},
    {"L3 D", -0.0460103828, 69.4779344, -72.6570829, -1.61235531, 42496.0067},
    {"L3 E", -0.049921705, 69.4779344, -72.6570829, 3.05206762, 44121.9335},
    {"L3 F", 0.114485884, 69.4779344, -72.6570829, 1.51355339, 89019.9569},
    {"L6 A", 0.052793319, -4.79495597, 164.955242, 1.59719299, 51905.7868},
    {"L6 B", -0.077003859, -4.79495597, 164.955242, 0.0142913895, 66396.6692},
    {"L6 C", 0.130273143, -4.79495597, 164.955242, -1.5298703, 102855.848},
    {"L6 D", -0.122652099, -4.79495597, 164.955242, -1.52605977, 98150.3464},
    {"L6 E", 0.067541252, -4.79495597, 164.955242, 3.15877378, 60316.1832},
    {"L6 F", -0.0509517562, -4.79495597, 164.955242, 1.5962722, 50784.8996},
};

static fw_device_flexure arc(void) {
    double angle = 1.5 * acos(-1.0);
    return (fw_device_flexure){.id = "H1",
                               .kind = FW_FLEXURE_CSFH,
                               .length_m = 100e-6 * angle,
                               .angle_rad = angle,
                               .radius_m = 100e-6,
                               .width_m = 8e-6};
}

static fw_flexure_input input_of(const fw_device_flexure *f, double fillet_m) {
    return (fw_flexure_input){.kind = f->kind,
                              .length_m = f->length_m,
                              .angle_rad = f->angle_rad,
                              .radius_m = f->radius_m,
                              .width_m = f->width_m,
                              .fillet_m = fillet_m,
                              .depth_m = 50e-6,
                              .youngs_Pa = 147.08e9,
                              .poisson = 0.22,
                              .strength_Pa = 500e6,
                              .safety_factor = 1.0};
}

static fw_mechanism_hinge hinge_of(fw_arena *arena, fw_device_flexure f, double fillet_m,
                                   double axis_rad) {
    fw_mechanism_hinge h = {.axis_rad = axis_rad, .first_is_a = true, .scale = 1};
    h.input = input_of(&f, fillet_m);
    fw_flexure_closed_form(&h.input, &h.closed_form);
    fw_flexure_hinge_law_of(&h.input, &h.closed_form, &h.law);
    assert_int_equal(fw_flexure_path_strain_new(arena, &h.input, &h.closed_form, &h.section),
                     FW_OK);
    return h;
}

/* its strains become section moments */
static void count_moments(fw_mechanism_hinge *h) {
    for (int i = 0; i < h->section.n; i++)
        h->section.point[i].strain_per_Nm = 1, h->section.point[i].strain_per_N = 0,
        h->section.point[i].face[0] = h->section.point[i].face[1] = 1;
    fw_flexure_path_strain_bend(&h->section, 1); /* what stands beside the points follows them */
}

static fw_verdict_hinge_strains strain_of(const fw_mechanism_hinge *h, double angle, double fx,
                                          double fy, double frame) {
    const fw_verdict_hinge_load load = {angle, fx, fy, frame, false, {(double)NAN, (double)NAN}, 0};
    fw_verdict_hinge_strains s;
    fw_verdict_hinge_strain(h, NULL, &load, &s);
    return s;
}

static void section_moments_of_a_whole_six_bar(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_mechanism_hinge h = hinge_of(arena, arc(), -1, 0);
    count_moments(&h);
    /* the tables' beam has no depth */
    h.law.stiffness_Nm_per_rad = 764912.2e-12 * 147079.09 / 169000.0;
    for (size_t i = 0; i < sizeof reference / sizeof reference[0]; i++) {
        const fw_verdict_hinge_load load = {reference[i].angle_rad,
                                            1e-6 * reference[i].fx_uN,
                                            1e-6 * reference[i].fy_uN,
                                            reference[i].turned_rad,
                                            true,
                                            {(double)NAN, (double)NAN}, 0};
        fw_verdict_hinge_strains s;
        fw_verdict_hinge_strain(&h, NULL, &load, &s);
        double largest = 1e12 * s.peak;
        if (!(fabs(largest / reference[i].moment - 1.0) < 0.029))
            fail_msg("%s: %g, exact %g", reference[i].name, largest, reference[i].moment);
    }
    fw_arena_free(arena);
}

/* without force the strain is strain per radian times angle, with opposite signs on the two faces;
   which body is called a does not matter; an axis that is not known is bounded by all directions */
static void rotation_and_unknown_axis(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_mechanism_hinge h = hinge_of(arena, arc(), 4e-6, 1.0), other = h, unknown = h;
    const fw_mechanism_hinge sharp = hinge_of(arena, arc(), -1, 1.0);
    other.first_is_a = false;
    unknown.axis_rad = (double)NAN;
    double per = h.closed_form.strain_per_rad;
    fw_verdict_hinge_strains s = strain_of(&h, 0.1, 0, 0, 0);
    assert_relative(s.peak, 0.1 * per, 1e-9);
    for (int root = 0; root < 2; root++) {
        /* the outer fillet has less of it */
        double outer = 1 - h.input.width_m / (3 * h.input.radius_m);
        assert_relative(s.root[root][0], 0.1 * per * outer, 1e-9);
        assert_relative(s.root[root][1], -0.1 * per, 1e-9);
    }
    assert_relative(strain_of(&unknown, 0.1, 0, 0, 0).least, 0.1 * per, 1e-9);
    for (int i = 0; i < 360; i++) {
        double fx = 2e-4 * cos(i / 57.3), fy = 2e-4 * sin(i / 57.3);
        s = strain_of(&h, 0.1, fx, fy, 0.3);
        assert_relative(strain_of(&other, -0.1, -fx, -fy, 0.3).peak, s.peak, 1e-12);
        const fw_verdict_hinge_strains any = strain_of(&unknown, 0.1, fx, fy, 0.3);
        assert_true(any.peak >= s.peak && any.least <= s.peak);
        /* where the fillets end the moment is less, by no more than the force times the fillet, and
           blocks give by no more than 1.6 t of strip each */
        double less = per / h.closed_form.stiffness_Nm_per_rad * 2e-4 * 4e-6;
        double give = 3.2 * h.input.width_m / (h.input.length_m + 3.2 * h.input.width_m);
        assert_true(s.least <= s.peak && s.least >= s.peak * (1 - give) - less && s.known);
        assert_true(any.least <= s.least);
        s = strain_of(&sharp, 0.1, fx, fy, 0.3); /* without fillets and blocks one figure */
        assert_true(s.least <= s.peak && s.least > 0.9999 * s.peak && s.known);
    }
    fw_arena_free(arena);
}

/* A leaf along y under a rotation and a force. Along the strip nothing is bent: the force adds its
   tension with the concentration that a fillet has for it. Across it the roots bend to opposite
   sides. What pulls against the rotation's moment at a root relieves that root. */
static void roots_of_a_leaf(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device_flexure leaf = {.kind = FW_FLEXURE_LEAF, .length_m = 400e-6, .width_m = 8e-6};
    fw_mechanism_hinge h = hinge_of(arena, leaf, 4e-6, 0);
    const fw_flexure_result *c = &h.closed_form;
    double area = 8e-6 * 50e-6, per_Nm = c->strain_per_rad / c->stiffness_Nm_per_rad;
    double axial = fw_flexure_tension_concentration(8e-6, 4e-6) * 1e-6 / (147.08e9 * area);
    /* the pin pushes body b down by a uN: it is what holds the strip's pull */
    const fw_verdict_hinge_strains pulled = strain_of(&h, 0, 0, -1e-6, 0);
    assert_relative(pulled.peak, axial, 1e-9);
    assert_relative(pulled.root[1][0], axial, 1e-9);
    assert_relative(strain_of(&h, 0, 0, 1e-6, 0).root[0][1], -axial, 1e-9);
    const fw_verdict_hinge_strains bent = strain_of(&h, 0, -1e-6, 0, 0);
    double lever = 1e-6 * 200e-6 * per_Nm;
    assert_relative(bent.root[0][0], -bent.root[1][0], 1e-3);
    assert_relative(fabs(bent.root[0][0]), lever, 1e-3);
    const fw_verdict_hinge_strains both = strain_of(&h, 1e-4, -1e-6, 0, 0);
    double turned = 1e-4 * c->strain_per_rad;
    assert_relative(fmax(fabs(both.root[0][0]), fabs(both.root[1][0])), lever + turned, 1e-3);
    assert_relative(fmin(fabs(both.root[0][0]), fabs(both.root[1][0])), fabs(lever - turned), 1e-2);
    fw_arena_free(arena);
}

/* a rotation whose moment the force takes away strains less than the rotation alone, and half a
   strip's length from W there is nothing left of it at that root */
static void force_relieves(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device_flexure leaf = {.kind = FW_FLEXURE_LEAF, .length_m = 400e-6, .width_m = 8e-6};
    fw_mechanism_hinge h = hinge_of(arena, leaf, 4e-6, 0);
    count_moments(&h);
    double M = 1e-3 * h.closed_form.stiffness_Nm_per_rad, least = 1;
    for (int i = -8; i <= 8; i++) {
        const fw_verdict_hinge_strains s = strain_of(&h, 1e-3, i * 0.25 * M / 200e-6, 0, 0);
        least = fmin(least, fmin(fabs(s.root[0][0]), fabs(s.root[1][0])) / M);
        assert_relative(s.root[0][0] + s.root[1][0], 2 * M, 1e-3);
    }
    assert_true(least < 1e-3);
    fw_arena_free(arena);
}

/* the moment that the mechanism knows is the one about the pin, which stands at the true centre: an
   arc whose centre is d off the drawn one feels what one without d does under M + dx Fy - dy Fx */
static void moments_are_about_the_true_centre(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_mechanism_hinge h = hinge_of(arena, arc(), 4e-6, 1.0), off = h;
    const double d[2] = {6e-6, -4e-6};
    off.section.W_m[0] += d[0], off.section.W_m[1] += d[1];
    count_moments(&h);
    for (int i = 0; i < 36; i++) {
        double fx = 1e-6 * cos(i / 5.73), fy = 1e-6 * sin(i / 5.73);
        double Fx = -(cos(1.3) * fx + sin(1.3) * fy), Fy = -(-sin(1.3) * fx + cos(1.3) * fy);
        double more = d[0] * Fy - d[1] * Fx;
        const fw_verdict_hinge_strains a = strain_of(&h, 0, fx, fy, 0.3);
        const fw_verdict_hinge_strains b = strain_of(&off, 0, fx, fy, 0.3);
        for (int root = 0; root < 2; root++)
            assert_near(b.root[root][0], a.root[root][0] + more, 1e-3 * 1e-6 * 100e-6);
    }
    fw_arena_free(arena);
}

/* an arc and the path of one piece that it is, with a load in every direction */
static void path_as_the_arc_it_is(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_mechanism_hinge h = hinge_of(arena, arc(), 4e-6, 1.0), path = h;
    const fw_geometry_strip_piece one = {
        h.input.length_m, 1 / h.input.radius_m, {8e-6, 8e-6, 8e-6}};
    path.input.kind = FW_FLEXURE_PATH, path.input.piece = &one, path.input.npiece = 1;
    fw_flexure_closed_form(&path.input, &path.closed_form);
    assert_int_equal(fw_flexure_path_law(arena, &path.input, &path.closed_form, &path.law), FW_OK);
    assert_int_equal(
        fw_flexure_path_strain_new(arena, &path.input, &path.closed_form, &path.section), FW_OK);
    for (int i = 0; i < 360; i++) {
        double fx = 3e-4 * cos(i / 57.3), fy = 3e-4 * sin(i / 57.3);
        const fw_verdict_hinge_strains a = strain_of(&h, 0.1, fx, fy, 0.3);
        const fw_verdict_hinge_strains b = strain_of(&path, 0.1, fx, fy, 0.3);
        for (int k = 0; k < FW_FACES; k++)
            assert_near(b.root[k / 2][k % 2], a.root[k / 2][k % 2], 5e-3 * a.peak);
        assert_true(b.peak > 0.995 * a.peak && b.peak < 1.15 * a.peak);
    }
    fw_arena_free(arena);
}

/* a stiffness that the file states twice as large: twice the forces bend it as far */
static void scaled_strip(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_mechanism_hinge h = hinge_of(arena, arc(), 4e-6, 1.0);
    const fw_verdict_hinge_strains own = strain_of(&h, 0.1, 1e-4, -2e-4, 0.3);
    fw_flexure_path_strain_scale(&h.section, 2);
    assert_int_equal(fw_flexure_hinge_law_scale(arena, &h.law, 2), FW_OK);
    assert_relative(strain_of(&h, 0.1, 2e-4, -4e-4, 0.3).peak, own.peak, 1e-12);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(section_moments_of_a_whole_six_bar),
        cmocka_unit_test(rotation_and_unknown_axis),
        cmocka_unit_test(roots_of_a_leaf),
        cmocka_unit_test(force_relieves),
        cmocka_unit_test(moments_are_about_the_true_centre),
        cmocka_unit_test(path_as_the_arc_it_is),
        cmocka_unit_test(scaled_strip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
