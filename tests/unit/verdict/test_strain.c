/* SPDX-License-Identifier: GPL-3.0-or-later */
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

static void section_moments_of_a_whole_six_bar(void **state) {
    (void)state;
    fw_device_flexure f = arc();
    double K = 764912.2e-12 * 147079.09 / 169000.0, W = 30.0105e-6;
    for (size_t i = 0; i < sizeof reference / sizeof reference[0]; i++) {
        double c = cos(reference[i].turned_rad), s = sin(reference[i].turned_rad);
        double fx = -reference[i].fx_uN * 1e-6, fy = -reference[i].fy_uN * 1e-6, root, inside;
        fw_verdict_arc_moments(&f, W, K * reference[i].angle_rad, c * fx + s * fy, -s * fx + c * fy,
                               &root, &inside);
        double largest = fmax(root, inside) * 1e12;
        if (!(fabs(largest / reference[i].moment - 1.0) < 0.029))
            fail_msg("%s: %g, exact %g", reference[i].name, largest, reference[i].moment);
    }
}

/* the closed-form extremum is not below any sampled section */
static void no_section_carries_more(void **state) {
    (void)state;
    fw_device_flexure f = arc();
    uint64_t seed = 3;
    for (int i = 0; i < 2000; i++) {
        double u[4];
        for (int k = 0; k < 4; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            u[k] = 2.0 * (double)(seed >> 11) / 9007199254740992.0 - 1.0;
        }
        f.angle_rad = 3.2 + 2.4 * u[3];
        double M = u[0] * 1e-7, fx = u[1] * 1e-3, fy = u[2] * 1e-3, W = 25e-6, root, inside,
               most = 0;
        fw_verdict_arc_moments(&f, W, M, fx, fy, &root, &inside);
        for (int k = 0; k <= 2000; k++) {
            double b = f.angle_rad * (k / 2000.0 - 0.5);
            most = fmax(most, fabs(M + W * fy + f.radius_m * (fx * sin(b) - fy * cos(b))));
        }
        assert_true(most <= fmax(root, inside) * (1 + 1e-12));
        assert_true(most >= fmax(root, inside) * (1 - 1e-5));
    }
}

static fw_flexure_input input_of(const fw_device_flexure *f) {
    return (fw_flexure_input){.kind = f->kind,
                              .length_m = f->length_m,
                              .angle_rad = f->angle_rad,
                              .radius_m = f->radius_m,
                              .width_m = f->width_m,
                              .fillet_m = 4e-6,
                              .depth_m = 50e-6,
                              .youngs_Pa = 147.08e9,
                              .poisson = 0.22,
                              .strength_Pa = 500e6,
                              .safety_factor = 1.0};
}

/* one flexure between the ground and body 0, which is the upper one; two hinges of it */
typedef struct one_flexure {
    fw_device_flexure f;
    fw_device device;
    fw_mechanism_variant variant;
    fw_mechanism_pin pin;
    fw_mechanism_hinge hinge[2];
    fw_mechanism m;
    fw_layout_hinge_layout drawn;
} one_flexure;

static void set_up(one_flexure *o, fw_device_flexure f, double axis_rad) {
    *o = (one_flexure){
        .f = f,
        .variant = {.thickness_m = 50e-6},
        .pin = {.id = "A", .body_a = FW_GROUND, .body_b = 0, .hinge = 0},
        .drawn = {.drawn = true, .axis_rad = axis_rad, .lower = FW_GROUND, .upper = 0}};
    const fw_flexure_input in = input_of(&o->f);
    o->variant.material.youngs.value = 147.08e9;
    fw_flexure_closed_form(&in, &o->hinge[0].closed_form);
    o->hinge[1] = o->hinge[0];
    o->device = (fw_device){.flexure = &o->f, .nflexure = 1};
    o->m = (fw_mechanism){.device = &o->device,
                          .variant = &o->variant,
                          .pin = &o->pin,
                          .npin = 1,
                          .hinge = o->hinge,
                          .nhinge = 2};
}

/* without force the strain is strain per radian times angle; a bound without drawing is never lower
 */
static void pure_rotation_and_bound(void **state) {
    (void)state;
    one_flexure o;
    set_up(&o, arc(), 1.0);
    fw_verdict_hinge_load load = {0.1, 0, 0, 0};
    assert_relative(fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], &o.drawn, NULL, &load),
                    0.1 * o.hinge[0].closed_form.strain_per_rad, 1e-12);
    for (int i = 0; i < 360; i++) {
        load.fx_N = 2e-4 * cos(i / 57.3);
        load.fy_N = 2e-4 * sin(i / 57.3);
        assert_true(fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], NULL, NULL, &load) >=
                    fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], &o.drawn, NULL, &load));
        /* which of the two bodies is called b does not matter */
        fw_mechanism_pin swapped = {.id = "A", .body_a = 0, .body_b = FW_GROUND, .hinge = 0};
        fw_mechanism n = o.m;
        n.pin = &swapped;
        fw_verdict_hinge_load back = {-load.angle_rad, -load.fx_N, -load.fy_N, 0};
        assert_relative(fw_verdict_hinge_strain_exact(&n, &o.hinge[0], &o.drawn, NULL, &back),
                        fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], &o.drawn, NULL, &load),
                        1e-12);
    }
}

/* under rotation alone both roots have the rotation's sign; with a force the larger of both is what
   the peak strain has of bending at the roots, and turning everything round turns their signs */
static void root_strains_have_signs(void **state) {
    (void)state;
    one_flexure o;
    set_up(&o, arc(), 1.0);
    const fw_flexure_result *c = &o.hinge[0].closed_form;
    fw_verdict_hinge_load load = {-0.1, 0, 0, 0};
    double s[2], back[2];
    fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], &o.drawn, &load, s);
    assert_relative(s[0], -0.1 * c->strain_per_rad, 1e-12);
    assert_relative(s[1], -0.1 * c->strain_per_rad, 1e-12);
    int governed = 0;
    for (int i = 0; i < 360; i++) {
        load = (fw_verdict_hinge_load){0.1, 2e-4 * cos(i / 57.3), 2e-4 * sin(i / 57.3), 0.3};
        const fw_verdict_hinge_load other = {-0.1, -load.fx_N, -load.fy_N, 0.3};
        double axial = 2e-4 / (147.08e9 * 8e-6 * 50e-6), root, inside;
        fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], &o.drawn, &load, s);
        fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], &o.drawn, &other, back);
        assert_relative(s[0], -back[0], 1e-12);
        assert_relative(s[1], -back[1], 1e-12);
        double along = -(cos(1.3) * load.fx_N + sin(1.3) * load.fy_N);
        double across = -(-sin(1.3) * load.fx_N + cos(1.3) * load.fy_N);
        fw_verdict_arc_moments(&o.f, c->centre_m, 0.1 * c->stiffness_Nm_per_rad, along, across,
                               &root, &inside);
        double most = fmax(fabs(s[0]), fabs(s[1]));
        assert_relative(most, root * c->strain_per_rad / c->stiffness_Nm_per_rad, 1e-12);
        if (root > inside / c->concentration) {
            governed++;
            assert_relative(fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], &o.drawn, NULL, &load),
                            most + axial, 1e-12);
        }
        /* which of the two bodies is called b does not matter */
        fw_mechanism_pin swapped = {.id = "A", .body_a = 0, .body_b = FW_GROUND, .hinge = 0};
        fw_mechanism n = o.m;
        n.pin = &swapped;
        fw_verdict_hinge_root_strains(&n, &o.hinge[0], &o.drawn, &other, back);
        assert_relative(s[0], back[0], 1e-12);
        assert_relative(s[1], back[1], 1e-12);
        /* without a drawing: with the rotation's sign, as much as the peak has */
        fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], NULL, &other, s);
        assert_relative(s[0] - axial,
                        -fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], NULL, NULL, &load),
                        1e-12);
        assert_near(s[1], s[0], 0);
    }
    assert_true(governed > 100);
}

/* the moment that the mechanism knows is the one about the pin, which stands at the true centre: an
   arc whose centre is d off the drawn one feels what one without d does under M + dx Fy - dy Fx */
static void moments_are_about_the_true_centre(void **state) {
    (void)state;
    one_flexure o;
    set_up(&o, arc(), 1.0);
    const double d[2] = {6e-6, -4e-6}, K = o.hinge[0].closed_form.stiffness_Nm_per_rad;
    o.hinge[1].closed_form.offset_m[0] = d[0], o.hinge[1].closed_form.offset_m[1] = d[1];
    for (int i = 0; i < 360; i++) {
        fw_verdict_hinge_load load = {0.1, 2e-4 * cos(i / 57.3), 2e-4 * sin(i / 57.3), 0.3};
        fw_verdict_hinge_load moved = load;
        double Fx = -(cos(1.3) * load.fx_N + sin(1.3) * load.fy_N);
        double Fy = -(-sin(1.3) * load.fx_N + cos(1.3) * load.fy_N), off[2], plain[2];
        moved.angle_rad += (d[0] * Fy - d[1] * Fx) / K;
        assert_relative(fw_verdict_hinge_strain_exact(&o.m, &o.hinge[1], &o.drawn, NULL, &load),
                        fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], &o.drawn, NULL, &moved),
                        1e-12);
        fw_verdict_hinge_root_strains(&o.m, &o.hinge[1], &o.drawn, &load, off);
        fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], &o.drawn, &moved, plain);
        for (int side = 0; side < 2; side++)
            assert_near(off[side], plain[side], 1e-15);
        /* without a drawing no direction is known: not below any */
        assert_true(fw_verdict_hinge_strain_exact(&o.m, &o.hinge[1], NULL, NULL, &load) >=
                    fw_verdict_hinge_strain_exact(&o.m, &o.hinge[1], &o.drawn, NULL, &load));
    }
}

/* a leaf along y: a force along it bends nothing, one across bends its ends to opposite sides, and
   a rotation with a force that reverse together reverse both roots */
static void root_strains_of_a_leaf(void **state) {
    (void)state;
    one_flexure o;
    set_up(&o,
           (fw_device_flexure){
               .id = "L", .kind = FW_FLEXURE_LEAF, .length_m = 400e-6, .width_m = 8e-6},
           0);
    const fw_flexure_result *c = &o.hinge[0].closed_form;
    double turned = 0.05 * c->strain_per_rad, s[2], back[2];
    double bent = 1e-4 * 200e-6 * c->strain_per_rad / c->stiffness_Nm_per_rad;
    fw_verdict_hinge_load load = {0.05, 0, 1e-4, 0};
    fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], &o.drawn, &load, s);
    assert_relative(s[0], turned, 1e-12);
    assert_relative(s[1], turned, 1e-12);
    load = (fw_verdict_hinge_load){0.05, 1e-4, 0, 0};
    fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], &o.drawn, &load, s);
    assert_relative(fmax(s[0], s[1]), turned + bent, 1e-12);
    assert_relative(fmin(s[0], s[1]), turned - bent, 1e-10);
    load = (fw_verdict_hinge_load){-0.05, -1e-4, 0, 0};
    fw_verdict_hinge_root_strains(&o.m, &o.hinge[0], &o.drawn, &load, back);
    for (int side = 0; side < 2; side++)
        assert_relative(back[side], -s[side], 1e-12);
    double axial = 1e-4 / (147.08e9 * 8e-6 * 50e-6);
    assert_relative(fw_verdict_hinge_strain_exact(&o.m, &o.hinge[0], &o.drawn, NULL, &load),
                    turned + bent + axial, 1e-12);
}

/* a path of one arc under any load: at the roots as the arc, inside never less (the arc's formula
   takes the fibre factor away with Kt); without a drawing a bound */
static void path_as_the_arc_it_is(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_device_flexure f[2] = {arc(), arc()};
    double t = f[0].width_m, L = f[0].length_m;
    const fw_geometry_strip_piece one = {L, 1 / f[0].radius_m, {t, t, t}};
    f[1].kind = FW_FLEXURE_PATH, f[1].piece = &one, f[1].npiece = 1;
    fw_device device = {.flexure = f, .nflexure = 2};
    fw_mechanism_variant variant = {.thickness_m = 50e-6};
    variant.material.youngs.value = 147.08e9;
    fw_mechanism_pin pin = {.id = "A", .body_a = FW_GROUND, .body_b = 0, .hinge = 0};
    fw_mechanism_hinge hinge[2] = {{.flexure = 0}, {.flexure = 1}};
    for (int i = 0; i < 2; i++) {
        hinge[i].input = fw_flexure_input_of(&f[i], 4e-6);
        hinge[i].input.depth_m = 50e-6, hinge[i].input.youngs_Pa = 147.08e9;
        hinge[i].input.poisson = 0.22, hinge[i].input.strength_Pa = 500e6;
        hinge[i].input.safety_factor = 1;
        fw_flexure_closed_form(&hinge[i].input, &hinge[i].closed_form);
    }
    assert_int_equal(fw_flexure_path_strain_new(arena, &hinge[1].input, &hinge[1].section), FW_OK);
    fw_mechanism m = {.device = &device,
                      .variant = &variant,
                      .pin = &pin,
                      .npin = 1,
                      .hinge = hinge,
                      .nhinge = 2};
    fw_layout_hinge_layout drawn = {.drawn = true, .axis_rad = 1.0, .lower = FW_GROUND, .upper = 0};
    double K = hinge[0].closed_form.stiffness_Nm_per_rad;
    for (int i = 0; i < 360; i++) {
        fw_verdict_hinge_load load = {0.1, 3e-4 * cos(i / 57.3), 3e-4 * sin(i / 57.3), 0.3};
        double want = fw_verdict_hinge_strain_exact(&m, &hinge[0], &drawn, NULL, &load), root,
               inside;
        double got = fw_verdict_hinge_strain_exact(&m, &hinge[1], &drawn, NULL, &load);
        double c = cos(1.3), s = sin(1.3), fx = -load.fx_N, fy = -load.fy_N;
        fw_verdict_arc_moments(&f[0], hinge[0].closed_form.centre_m, K * 0.1, c * fx + s * fy,
                               -s * fx + c * fy, &root, &inside);
        if (root * hinge[0].closed_form.concentration > 1.2 * inside)
            assert_relative(got, want, 1e-9);
        else
            assert_true(got > 0.999 * want && got < 1.15 * want);
        assert_true(fw_verdict_hinge_strain_exact(&m, &hinge[1], NULL, NULL, &load) >= got);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(path_as_the_arc_it_is),
        cmocka_unit_test(section_moments_of_a_whole_six_bar),
        cmocka_unit_test(no_section_carries_more),
        cmocka_unit_test(pure_rotation_and_bound),
        cmocka_unit_test(root_strains_have_signs),
        cmocka_unit_test(root_strains_of_a_leaf),
        cmocka_unit_test(moments_are_about_the_true_centre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
