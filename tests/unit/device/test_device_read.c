/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files.h"

static const double pi = 3.14159265358979323846;

static void the_gallery_device(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    const fw_device *d = sound(arena, load(arena, GALLERY, &n), NULL, 0);
    assert_string_equal(d->name, "reference-six-bar");
    assert_int_equal(d->nparameter, 2);
    assert_relative(d->parameter[0].value, 240 * pi / 180, 1e-15);
    assert_relative(d->parameter[0].min, 140 * pi / 180, 1e-15);
    assert_string_equal(d->parameter[0].unit, "deg");
    assert_string_equal(d->parameter[1].name, "link");
    assert_string_equal(d->material_ref, "silicon-100");
    assert_relative(d->material.youngs.value, 169e9, 1e-15);
    assert_relative(d->material.strength.value, 2.5e9, 1e-15);
    assert_true(d->material.poisson.unknown && d->material.density.unknown);
    assert_relative(d->thickness_m, 50e-6, 1e-15);
    assert_near(d->safety_factor, 1.5, 0.0);
    assert_int_equal(d->nflow, 2);
    assert_null(d->flow[0].material);
    assert_true(isnan(d->flow[0].thickness_m));
    assert_string_equal(d->flow[1].material, "copper-plated");
    assert_relative(d->flow[1].thickness_m, 9e-6, 1e-15);
    assert_int_equal(d->nflexure, 6);
    const fw_device_flexure *f = &d->flexure[1];
    assert_relative(f->length_m, 250e-6, 1e-15);
    assert_relative(f->radius_m, 250e-6 / (4 * pi / 3), 1e-15);
    assert_relative(f->width_m, 8.5e-6, 1e-15);
    assert_true(f->length_given && isnan(f->fillet_m));
    assert_int_equal(d->nscene, 2);
    assert_string_equal(d->scene[1].flow, "copper-on-porous-silicon");
    assert_relative(d->scene[0].duration_s, 0.01, 1e-15);
    assert_int_equal(d->scene[0].nforce, 1);
    assert_int_equal(d->scene[0].force[0].body, 2);
    assert_relative(d->scene[0].force[0].fy_N, -0.14e-3, 1e-15);
    assert_int_equal(d->scene[0].torque[0].body, 0);
    assert_relative(d->scene[0].torque[0].value_Nm, -0.11e-6, 1e-15);
    assert_int_equal(d->nworkspace, 2);
    assert_relative(d->workspace[1].phi_max_rad, 0.3 * pi / 180, 1e-15);
    assert_relative(d->die.width_m, 5.6e-3, 1e-15);
    assert_true(isnan(d->die.frame_m) && d->die.tethers);
    assert_string_equal(d->die.title, "REFERENCE SIX-BAR");
    assert_true(isnan(d->release_pitch_m) && isnan(d->release_hole_m));
    assert_int_equal(d->source_length, n);
    d = sound(arena, DEVICE("<die release-pitch=\"40 um\" release-hole=\"12 um\"/>" ARM), NULL, 0);
    assert_relative(d->release_pitch_m, 40e-6, 1e-15);
    assert_relative(d->release_hole_m, 12e-6, 1e-15);
    fw_arena_free(arena);
}

static void the_six_bar_expands(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    const fw_device *d = sound(arena, load(arena, GALLERY, &n), NULL, 0);
    static const char *const body[] = {"AB", "BC", "CD", "DE", "EF"};
    static const char *const joint[] = {"A", "B", "C", "D", "E", "F"};
    static const int ends[][2] = {{FW_GROUND, 0}, {0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, FW_GROUND}};
    assert_true(d->six_bar);
    assert_int_equal(d->nbody, 5);
    assert_int_equal(d->nrevolute, 6);
    for (int i = 0; i < 5; i++) {
        assert_string_equal(d->body[i].id, body[i]);
        assert_int_equal(d->body[i].platform, i == 2);
        assert_near(d->body[i].phi_rad, 0.0, 0.0);
        assert_true(isnan(d->body[i].width_m) == (i == 2));
        assert_true(isnan(d->body[i].plate_width_m) == (i != 2));
        assert_true(d->body[i].place.line > 20);
    }
    for (int i = 0; i < 6; i++) {
        assert_string_equal(d->revolute[i].id, joint[i]);
        assert_int_equal(d->revolute[i].body_a, ends[i][0]);
        assert_int_equal(d->revolute[i].body_b, ends[i][1]);
        assert_int_equal(d->revolute[i].flexure, i);
        assert_true(isnan(d->revolute[i].ax_m) && isnan(d->revolute[i].axis_rad));
    }
    assert_relative(d->body[0].x_m, 0.45e-3, 1e-14); /* midpoint of A and B */
    assert_relative(d->body[0].y_m, 0.775e-3, 1e-14);
    assert_relative(d->body[2].y_m, 2.875e-3, 1e-15);
    assert_relative(d->body[2].plate_y_m, 2.875e-3, 1e-15);
    assert_relative(d->body[2].inertia_kg_m2, 0.01155e-12, 1e-14);
    assert_relative(d->revolute[4].x_m, 2.85e-3, 1e-15);
    assert_relative(d->revolute[5].damping_Nms_per_rad, 0.0075e-9, 1e-15);
    fw_arena_free(arena);
}

static void mass_from_the_shape(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml = DEVICE(
        "<material ref=\"m\"/><six-bar><link id=\"EF\" width=\"0.1 mm\"/>"
        "<hinge at=\"F\" x=\"5 mm\" y=\"0 mm\"/><hinge at=\"A\" x=\"0 mm\" y=\"0 mm\"/>"
        "<hinge at=\"B\" x=\"1 mm\" y=\"1 mm\"/><hinge at=\"C\" x=\"2 mm\" y=\"2 mm\"/>"
        "<hinge at=\"D\" x=\"3 mm\" y=\"2 mm\"/><hinge at=\"E\" x=\"4 mm\" y=\"1 mm\"/>"
        "<link id=\"AB\" width=\"0.1 mm\"/><link id=\"BC\" mass=\"1 mg\" inertia=\"1 mg mm^2\" "
        "x=\"1.7 mm\"/><link id=\"DE\" width=\"0.1 mm\"/><platform id=\"CD\" width=\"1 mm\" "
        "height=\"0.3 mm\" x=\"2.5 mm\" y=\"2.1 mm\" angle=\"5 deg\"/></six-bar>");
    const fw_device *d = sound(arena, xml, NULL, 0);
    assert_true(isnan(d->body[0].mass_kg) && isnan(d->body[0].x_m) &&
                isnan(d->body[0].inertia_kg_m2));
    assert_relative(d->body[1].x_m, 1.7e-3, 1e-15);
    assert_relative(d->body[1].y_m, 1.5e-3, 1e-15);
    assert_true(isnan(d->body[2].x_m));
    assert_relative(d->body[2].plate_x_m, 2.5e-3, 1e-15);
    assert_relative(d->body[2].plate_angle_rad, 5 * pi / 180, 1e-15);
    assert_int_equal(d->revolute[0].flexure, FW_NONE);
    assert_true(isnan(d->revolute[0].stiffness_Nm_per_rad) &&
                isnan(d->revolute[0].damping_Nms_per_rad));
    fw_arena_free(arena);
}

static void the_general_mechanism(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml = DEVICE(
        "<mechanism><revolute id=\"j\" a=\"p\" a-x=\"1 mm\" a-y=\"2 mm\" b=\"q\" b-x=\"-1 mm\" "
        "free-angle=\"3 deg\"/><body id=\"p\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"5 mm\" y=\"6 "
        "mm\" phi=\"90 deg\"/><body id=\"q\" mass=\"2 mg\" inertia=\"1 mg mm^2\" x=\"0 mm\" y=\"0 "
        "mm\" "
        "plate-width=\"1 mm\" plate-height=\"2 mm\"/><revolute id=\"g\" a=\"ground\" a-x=\"7 mm\" "
        "a-y=\"8 mm\" b=\"p\"/><spring id=\"s\" a=\"q\" b=\"ground\" b-x=\"1 mm\" stiffness=\"3 "
        "N/m\" "
        "length=\"5 um\"/></mechanism><scene name=\"s\" duration=\"1 s\"><gravity gy=\"-9.81 "
        "m/s^2\"/>"
        "<initial body=\"q\" vx=\"1 mm/s\" omega=\"30 rpm\"/></scene>");
    const fw_device *d = sound(arena, xml, NULL, 0);
    assert_false(d->six_bar);
    assert_relative(d->revolute[0].x_m, 3e-3, 1e-14); /* 5 - 2, turned by 90 deg */
    assert_relative(d->revolute[0].y_m, 7e-3, 1e-14);
    assert_relative(d->revolute[0].bx_m, -1e-3, 1e-15);
    assert_relative(d->revolute[0].free_angle_rad, 3 * pi / 180, 1e-15);
    assert_int_equal(d->revolute[1].body_a, FW_GROUND);
    assert_relative(d->revolute[1].x_m, 7e-3, 1e-15);
    assert_relative(d->body[1].plate_height_m, 2e-3, 1e-15);
    assert_near(d->body[1].plate_x_m, 0.0, 0.0);
    assert_true(isnan(d->body[0].plate_x_m));
    assert_int_equal(d->spring[0].body_b, FW_GROUND);
    assert_relative(d->spring[0].stiffness_N_per_m, 3.0, 1e-15);
    assert_near(d->spring[0].damping_Ns_per_m, 0.0, 0.0);
    assert_true(d->scene[0].gravity);
    assert_relative(d->scene[0].gy_m_per_s2, -9.81, 1e-15);
    assert_int_equal(d->scene[0].initial[0].body, 1);
    assert_relative(d->scene[0].initial[0].omega_rad_per_s, pi, 1e-15);
    assert_null(d->material_ref);
    assert_true(d->material.youngs.unknown);
    fw_arena_free(arena);
}

static void both_mechanisms_together(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    char *gallery = load(arena, GALLERY, &n);
    fw_text xml = fw_text_new(arena);
    char *end = strstr(gallery, "<scene");
    fw_text_bytes(&xml, gallery, (size_t)(end - gallery));
    fw_text_add(&xml,
                "<mechanism><body id=\"tip\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"1 mm\" y=\"3 "
                "mm\"/><revolute id=\"T\" a=\"CD\" a-x=\"0.5 mm\" b=\"tip\" "
                "hinge=\"C\"/></mechanism>");
    fw_text_add(&xml, end);
    const fw_device *d = sound(arena, xml.data, NULL, 0);
    assert_int_equal(d->nbody, 6);
    assert_int_equal(d->nrevolute, 7);
    assert_int_equal(d->revolute[6].body_a, 2);
    assert_int_equal(d->revolute[6].body_b, 5);
    assert_int_equal(d->revolute[6].flexure, 2);
    assert_relative(d->revolute[6].x_m, 2e-3, 1e-14);
    fw_arena_free(arena);
}

static void three_ways_to_an_arc(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml = DEVICE(
        "<material ref=\"m\"/><flexure id=\"a\" kind=\"csfh\" radius=\"100 um\" angle=\"3 rad\" "
        "width=\"9 "
        "um\"/><flexure id=\"b\" kind=\"csfh\" radius=\"100 um\" length=\"300 um\" width=\"9 um\"/>"
        "<flexure id=\"c\" kind=\"csfh\" length=\"300 um\" angle=\"3 rad\" width=\"9 um\"/>"
        "<flexure id=\"d\" kind=\"leaf\" length=\"300 um\" width=\"9 um\"/>" ARM);
    const fw_device *d = sound(arena, xml, NULL, 0);
    for (int i = 0; i < 3; i++) {
        assert_relative(d->flexure[i].length_m, 300e-6, 1e-14);
        assert_relative(d->flexure[i].radius_m, 100e-6, 1e-14);
        assert_relative(d->flexure[i].angle_rad, 3.0, 1e-14);
        assert_int_equal(d->flexure[i].length_given, i != 0);
        assert_near(d->flexure[i].gap_m, 0.0, 0.0);
    }
    assert_int_equal(d->flexure[3].kind, FW_FLEXURE_LEAF);
    assert_true(isnan(d->flexure[3].radius_m) && isnan(d->flexure[3].angle_rad));
    fw_arena_free(arena);
}

/* every allocation fails in turn, once and ever after: NOMEM, never a crash */
static void memory_runs_out(void **state) {
    (void)state;
    fw_arena *outer = fw_arena_new(0);
    size_t n;
    char *xml = load(outer, GALLERY, &n);
    const fw_device_set set[] = {{"link", "150 um"}, {"flexure[A]/@length", "2*link"}};
    for (int ever = 0; ever < 2; ever++)
        for (long at = 1;; at++) {
            fw_arena *arena = fw_arena_new(0);
            fw_diags diags = fw_diags_new(arena);
            const fw_device *device;
            fw_arena_fail_at(at, ever);
            fw_status s = fw_device_read(arena, "g.xml", xml, n, set, 2, &diags, &device);
            long used = fw_arena_count();
            fw_arena_fail_at(0, 0);
            assert_int_equal(s, used >= at ? FW_NOMEM : FW_OK);
            fw_arena_free(arena);
            if (used < at) break;
        }
    fw_arena_free(outer);
}

/* the same in a file full of mistakes: NOMEM or the mistakes, never success */
static void memory_runs_out_over_mistakes(void **state) {
    (void)state;
    static const char *const name[] = {"many-mistakes", "many-mistakes-six-bar", "parameter-cycle",
                                       "xml-end-tag-misspelt", "attribute-missing"};
    fw_arena *outer = fw_arena_new(0);
    for (size_t k = 0; k < sizeof name / sizeof name[0]; k++) {
        char path[100];
        size_t n;
        snprintf(path, sizeof path, "tests/bad/%s.xml", name[k]);
        char *xml = load(outer, path, &n);
        for (int ever = 0; ever < 2; ever++)
            for (long at = 1;; at++) {
                fw_arena *arena = fw_arena_new(0);
                fw_diags diags = fw_diags_new(arena);
                const fw_device *device;
                fw_arena_fail_at(at, ever);
                fw_status s = fw_device_read(arena, "b.xml", xml, n, NULL, 0, &diags, &device);
                long used = fw_arena_count();
                fw_arena_fail_at(0, 0);
                assert_true(s == FW_NOMEM || (s == FW_INPUT && diags.errors > 0));
                assert_true(s == FW_NOMEM || used < at || !ever);
                fw_arena_free(arena);
                if (used < at) break;
            }
    }
    fw_arena_free(outer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_gallery_device),       cmocka_unit_test(the_six_bar_expands),
        cmocka_unit_test(mass_from_the_shape),      cmocka_unit_test(the_general_mechanism),
        cmocka_unit_test(both_mechanisms_together), cmocka_unit_test(three_ways_to_an_arc),
        cmocka_unit_test(memory_runs_out),          cmocka_unit_test(memory_runs_out_over_mistakes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
