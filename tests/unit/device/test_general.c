/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sliding and rigid joints, rods, drivers, stops, cables, loads with laws, and sizes from
   nanometres to kilometres. */
#include "quantity/law_kind.h"
#include "files.h"

static const double pi = 3.14159265358979323846;

#define BODIES                                                                                     \
    "<body id=\"p\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"5 mm\" y=\"6 mm\" phi=\"90 deg\"/>"    \
    "<body id=\"q\" mass=\"2 mg\" inertia=\"1 mg mm^2\" x=\"0 mm\" y=\"0 mm\"/>"

static void all_joints(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml = DEVICE(
        "<parameter name=\"speed\" value=\"2 rad/s\"/><mechanism>"
        "<driver joint=\"r\" value=\"speed*time + 0.1 rad\"/>"
        "<driver id=\"pull\" joint=\"d\" value=\"1 mm + 2 mm/s*time\"/>"
        "<distance id=\"d\" a=\"p\" a-x=\"1 mm\" b=\"q\" b-y=\"2 mm\"/>"
        "<prismatic id=\"s\" a=\"p\" b=\"ground\" b-x=\"1 mm\" axis=\"30 deg\" stiffness=\"4 N/m\" "
        "damping=\"5 N s/m\" free-length=\"-2 mm\"/>"
        "<weld id=\"w\" a=\"q\" b=\"ground\" angle=\"1 rad\"/>" BODIES
        "<revolute id=\"r\" a=\"ground\" b=\"q\" stop-min=\"-400 deg\" stop-max=\"1 deg\" "
        "stop-stiffness=\"3 N m/rad\" stop-damping=\"2 N m s/rad\"/>"
        "<revolute id=\"plain\" a=\"p\" b=\"q\"/>"
        "<spring id=\"c\" a=\"p\" b=\"q\" stiffness=\"3 N/m\" cable=\"yes\"/>"
        "<spring id=\"n\" a=\"p\" b=\"q\" stiffness=\"3 N/m\" cable=\"no\"/></mechanism>");
    const fw_device *d = sound(arena, xml, NULL, 0);
    assert_int_equal(d->njoint, 3);
    assert_int_equal(d->joint[0].kind, FW_JOINT_DISTANCE);
    assert_true(d->joint[0].body_a == 0 && d->joint[0].body_b == 1 && isnan(d->joint[0].length_m));
    assert_relative(d->joint[0].by_m, 2e-3, 1e-15);
    assert_int_equal(d->joint[1].kind, FW_JOINT_PRISMATIC);
    assert_int_equal(d->joint[1].body_b, FW_GROUND);
    assert_relative(d->joint[1].axis_rad, pi / 6, 1e-15);
    assert_true(isnan(d->joint[1].angle_rad));
    assert_relative(d->joint[1].stiffness_N_per_m, 4, 1e-15);
    assert_relative(d->joint[1].damping_Ns_per_m, 5, 1e-15);
    assert_relative(d->joint[1].free_length_m, -2e-3, 1e-15);
    assert_int_equal(d->joint[2].kind, FW_JOINT_WELD);
    assert_relative(d->joint[2].angle_rad, 1, 1e-15);
    /* drivers may stand before what they drive; without an id they carry the joint's */
    assert_int_equal(d->ndriver, 2);
    assert_string_equal(d->driver[0].id, "r");
    assert_true(d->driver[0].revolute == 0 && d->driver[0].joint == FW_NONE);
    double v[3];
    fw_quantity_law_value(&d->driver[0].law, 3, 3, v);
    assert_near(v[0], 6.1, 1e-15);
    assert_near(v[1], 2, 1e-15);
    assert_string_equal(d->driver[1].id, "pull");
    assert_true(d->driver[1].revolute == FW_NONE && d->driver[1].joint == 0);
    fw_quantity_law_value(&d->driver[1].law, 3, 3, v);
    assert_near(v[0], 7e-3, 1e-17);
    assert_relative(d->revolute[0].stop_min_rad, -400 * pi / 180, 1e-15);
    assert_relative(d->revolute[0].stop_max_rad, pi / 180, 1e-15);
    assert_relative(d->revolute[0].stop_stiffness_Nm_per_rad, 3, 1e-15);
    assert_relative(d->revolute[0].stop_damping_Nms_per_rad, 2, 1e-15);
    assert_true(isnan(d->revolute[1].stop_min_rad) && isnan(d->revolute[1].stop_max_rad) &&
                isnan(d->revolute[1].stop_stiffness_Nm_per_rad));
    assert_true(d->spring[0].cable && !d->spring[1].cable);
    fw_arena_free(arena);
}

static void hinges_of_the_six_bar(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    char *gallery = load(arena, GALLERY, &n);
    fw_text xml = fw_text_new(arena);
    char *end = strstr(gallery, "<scene");
    fw_text_bytes(&xml, gallery, (size_t)(end - gallery));
    fw_text_add(&xml,
                "<mechanism><driver joint=\"F\" value=\"0.1 rad*sin(t/(1 ms))\"/></mechanism>");
    fw_text_add(&xml, end);
    const fw_device *d = sound(arena, xml.data, NULL, 0);
    assert_true(d->driver[0].revolute == 5 && d->driver[0].joint == FW_NONE);
    assert_true(isnan(d->revolute[5].stop_min_rad));
    fw_arena_free(arena);
}

static const fw_quantity_law *law_of(fw_arena *arena, const char *attributes) {
    fw_text xml = fw_text_new(arena);
    fw_text_printf(&xml,
                   DEVICE("<parameter name=\"late\" value=\"2 ms\"/>" ARM
                          "<scene name=\"s\" duration=\"10 ms\"><force on=\"arm\" fx=\"1 uN\" %s/>"
                          "<torque on=\"arm\" value=\"1 uN mm\" %s/></scene>"),
                   attributes, attributes);
    const fw_device *d = sound(arena, xml.data, NULL, 0);
    const fw_quantity_law *a = d->scene[0].force[0].law, *b = d->scene[0].torque[0].law;
    assert_true((a == NULL) == (b == NULL));
    if (a) assert_int_equal(a->kind, b->kind);
    return a;
}

static void laws(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    assert_null(law_of(arena, ""));
    assert_null(law_of(arena, "law=\"step\""));
    assert_null(law_of(arena, "law=\"step\" start=\"0 ms\""));
    const fw_quantity_law *l = law_of(arena, "start=\"late\""); /* step is the default */
    assert_int_equal(l->kind == &fw_quantity_law_step, 1);
    assert_relative(l->start_s, 2e-3, 1e-15);
    assert_true(isinf(l->end_s));
    l = law_of(arena, "law=\"step\" end=\"3*late\"");
    assert_true(l->start_s == 0 && fabs(l->end_s - 6e-3) < 1e-17);
    l = law_of(arena, "law=\"ramp\" rise=\"late\" start=\"1 ms\"");
    assert_true(l->kind == &fw_quantity_law_ramp && fabs(l->rise_s - 2e-3) < 1e-18 &&
                fabs(l->start_s - 1e-3) < 1e-18);
    l = law_of(arena, "law=\"sine\" frequency=\"2 kHz\" phase=\"90 deg\"");
    assert_true(l->kind == &fw_quantity_law_sine && l->frequency_Hz == 2000 && isinf(l->end_s));
    assert_relative(l->phase_rad, pi / 2, 1e-15);
    l = law_of(arena, "law=\"table\" table=\" 0 ms : 0 ;late: 1/4;\n 2*late:-1 ; \"");
    assert_int_equal(l->kind == &fw_quantity_law_table, 1);
    assert_int_equal(l->ntable, 3);
    assert_relative(l->table_t_s[2], 4e-3, 1e-15);
    assert_true(l->table_value[1] == 0.25 && l->table_value[2] == -1);
    l = law_of(arena, "law=\"expression\" factor=\"sin(2*pi*t/(10 ms))\"");
    double v[3];
    fw_quantity_law_value(l, 2.5e-3, 2.5e-3, v);
    assert_near(v[0], 1, 1e-15);
    assert_near(v[2], -4 * pi * pi * 1e4, 1e-6);
    fw_arena_free(arena);
}

/* a molecule and a bridge, a picosecond and years; what is drawn stays on its wafer */
static void sizes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml = DEVICE(
        "<mechanism><body id=\"small\" mass=\"1e-27 kg\" inertia=\"1e-46 kg m^2\" x=\"1 nm\" y=\"0 "
        "m\"/><body id=\"large\" mass=\"1e9 kg\" inertia=\"1e15 kg m^2\" x=\"-2 km\" y=\"0 m\" "
        "phi=\"30 rad\"/><revolute id=\"r\" a=\"ground\" a-x=\"-3 km\" b=\"large\" b-x=\"-1 km\" "
        "stiffness=\"1e12 N m/rad\"/><spring id=\"s\" a=\"small\" b=\"large\" stiffness=\"1 N/m\" "
        "length=\"1 km\"/></mechanism><scene name=\"short\" duration=\"0.001 ns\"><force "
        "on=\"large\" "
        "x=\"1 km\" fx=\"1e9 N\"/></scene><scene name=\"long\" duration=\"2e5 h\"/>");
    const fw_device *d = sound(arena, xml, NULL, 0);
    assert_relative(d->body[0].mass_kg, 1e-27, 1e-15);
    assert_relative(d->body[1].x_m, -2000, 1e-15);
    assert_relative(d->revolute[0].x_m, -3000, 1e-15);
    fw_arena_free(arena);
}

static void sets(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml =
        DEVICE("<mechanism>" BODIES "<prismatic id=\"s\" a=\"p\" b=\"q\" axis=\"0 deg\"/>"
               "<driver id=\"d\" joint=\"s\" value=\"1 mm\"/></mechanism>");
    const fw_device_set set[] = {{"driver[d]/@value", "3 mm"}, {"prismatic[s]/@axis", "90 deg"}};
    const fw_device *d = sound(arena, xml, set, 2);
    double v[3];
    fw_quantity_law_value(&d->driver[0].law, 0, 0, v);
    assert_near(v[0], 3e-3, 1e-18);
    assert_relative(d->joint[0].axis_rad, pi / 2, 1e-15);
    const fw_device_set wrong[] = {{"driver[d]/@value", "3 mm + t"}};
    only_error(arena, xml, wrong, 1, 26, "added");
    fw_arena_free(arena);
}

/* a lost parameter silences the laws that use it */
static void one_mistake_one_message(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    only_error(
        arena,
        DEVICE("<parameter name=\"a\" value=\"1/0\"/>" ARM
               "<scene name=\"s\" duration=\"1 s\"><force on=\"arm\" fx=\"1 N\" law=\"table\" "
               "table=\"0 s: 0; 1 s: a\"/><force on=\"arm\" fx=\"1 N\" law=\"expression\" "
               "factor=\"a*t/(1 s)\"/><force on=\"arm\" fx=\"1 N\" law=\"step\" start=\"a*1 s\"/>"
               "</scene>"),
        NULL, 0, 27, "zero");
    fw_arena_free(arena);
}

static void memory_runs_out(void **state) {
    (void)state;
    const char *xml = DEVICE(
        "<mechanism>" BODIES "<prismatic id=\"s\" a=\"p\" b=\"q\" axis=\"0 deg\"/>"
        "<driver id=\"d\" joint=\"s\" value=\"1 mm*sin(t/(1 s))\"/></mechanism><scene "
        "name=\"s\" duration=\"1 s\"><force on=\"p\" fx=\"1 N\" law=\"table\" table=\"0 s: 0; 1 s: "
        "1\"/><torque on=\"q\" value=\"1 N m\" law=\"expression\" factor=\"t/(1 s)\"/>"
        "</scene>");
    for (int ever = 0; ever < 2; ever++)
        for (long at = 1;; at++) {
            fw_arena *arena = fw_arena_new(0);
            fw_diags diags = fw_diags_new(arena);
            const fw_device *device;
            fw_arena_fail_at(at, ever);
            fw_status s =
                fw_device_read(arena, "g.xml", xml, strlen(xml), NULL, 0, &diags, &device);
            long used = fw_arena_count();
            fw_arena_fail_at(0, 0);
            assert_int_equal(s, used >= at ? FW_NOMEM : FW_OK);
            fw_arena_free(arena);
            if (used < at) break;
        }
}

/* measured loads have thousands of points */
static void long_table(void **state) {
    (void)state;
    enum { POINTS = 2000 };
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, "law=\"table\" table=\"");
    for (int i = 0; i < POINTS; i++)
        fw_text_printf(&text, "%.4f ms: %.6f; ", i * 5e-3, sin(i * 1e-2));
    fw_text_add(&text, "\"");
    assert_int_equal(fw_text_end(&text), FW_OK);
    assert_true(text.length > 40000);
    const fw_quantity_law *l = law_of(arena, text.data);
    assert_int_equal(l->ntable, POINTS);
    for (int i = 0; i < POINTS; i++) {
        assert_near(l->table_t_s[i], i * 5e-6, 1e-15);
        assert_near(l->table_value[i], sin(i * 1e-2), 5.1e-7);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_joints),
        cmocka_unit_test(hinges_of_the_six_bar),
        cmocka_unit_test(laws),
        cmocka_unit_test(long_table),
        cmocka_unit_test(sizes),
        cmocka_unit_test(sets),
        cmocka_unit_test(one_mistake_one_message),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
