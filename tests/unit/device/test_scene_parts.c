/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What else acts in scenes: the values read, their defaults, and the descriptions in
   tests/data/effects, which use every element. Mistakes are in tests/bad. */
#include "quantity/law_kind.h"
#include "files.h"

static const double pi = 3.14159265358979323846;
static fw_arena *arena;
static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

#define BODIES                                                                                     \
    "<material ref=\"m\"/>"                                                                        \
    "<flexure id=\"A\" kind=\"csfh\" length=\"300 um\" angle=\"240 deg\" width=\"9 um\" gap=\"8 "  \
    "um\"/><mechanism>"                                                                            \
    "<body id=\"p\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"1 mm\" y=\"2 mm\" width=\"0.1 mm\"/>"  \
    "<body id=\"q\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"3 mm\" y=\"2 mm\" width=\"0.1 mm\"/>"  \
    "<revolute id=\"h\" a=\"ground\" b=\"p\" b-x=\"-1 mm\" b-y=\"-2 mm\" hinge=\"A\"/>"            \
    "<prismatic id=\"s\" a=\"p\" b=\"q\" b-x=\"-2 mm\" axis=\"0 deg\"/></mechanism>"
#define SCENE(parts) DEVICE(BODIES "<scene name=\"s\" duration=\"1 s\">" parts "</scene>")

static const fw_device_scene *scene_of(const char *xml) {
    return &sound(arena, xml, NULL, 0)->scene[0];
}

static void tendons(void **state) {
    (void)state;
    const fw_device_scene *s =
        scene_of(SCENE("<tendon id=\"a\" pull=\"3 mN\" law=\"ramp\" rise=\"2 ms\"><eyelet on=\"p\" "
                       "x=\"1 mm\"/><eyelet on=\"q\" y=\"-1 mm\"/><eyelet on=\"ground\" x=\"7 mm\" "
                       "y=\"8 mm\"/></tendon><force on=\"p\" fx=\"1 uN\"/><tendon id=\"b\" "
                       "draw=\"-5 um\" stiffness=\"20 N/m\" damping=\"1 N s/m\" slack=\"-2 um\">"
                       "<eyelet on=\"ground\"/><eyelet on=\"p\"/></tendon>"));
    assert_int_equal(s->ntendon, 2);
    assert_int_equal(s->nforce, 1);
    const fw_device_tendon *t = s->tendon;
    assert_string_equal(t[0].id, "a");
    assert_relative(t[0].pull_N, 3e-3, 1e-15);
    assert_true(isnan(t[0].draw_m));
    assert_int_equal(t[0].law->kind == &fw_quantity_law_ramp, 1);
    assert_int_equal(t[0].neyelet, 3);
    assert_int_equal(t[0].eyelet[0].body, 0);
    assert_relative(t[0].eyelet[0].x_m, 1e-3, 1e-15);
    assert_int_equal(t[0].eyelet[1].body, 1);
    assert_relative(t[0].eyelet[1].y_m, -1e-3, 1e-15);
    assert_int_equal(t[0].eyelet[2].body, FW_GROUND);
    assert_relative(t[0].eyelet[2].y_m, 8e-3, 1e-15);
    assert_true(t[0].eyelet[1].place.column > t[0].eyelet[0].place.column);
    assert_true(isnan(t[1].pull_N) && t[1].law == NULL && t[1].neyelet == 2);
    assert_relative(t[1].draw_m, -5e-6, 1e-15);
    assert_relative(t[1].stiffness_N_per_m, 20, 1e-15);
    assert_relative(t[1].damping_Ns_per_m, 1, 1e-15);
    assert_relative(t[1].slack_m, -2e-6, 1e-15);
}

static void combs(void **state) {
    (void)state;
    const fw_device_scene *s =
        scene_of(SCENE("<comb-drive id=\"c\" kind=\"comb\" on=\"p\" x=\"1 um\" y=\"2 um\" "
                       "direction=\"90 deg\" fingers=\"2*15\" gap=\"3 um\" overlap=\"20 um\" "
                       "voltage=\"-40 V\"/><comb-drive id=\"d\" kind=\"plate\" on=\"p\" "
                       "against=\"q\" direction=\"0 deg\" gap=\"2 um\" length=\"100 um\" "
                       "depth=\"30 um\" voltage=\"1 kV\" law=\"sine\" frequency=\"1 kHz\"/>"));
    assert_int_equal(s->ncomb, 2);
    const fw_device_comb *c = s->comb;
    assert_int_equal(c[0].kind, FW_ELECTRODES_COMB);
    assert_true(c[0].body_a == FW_GROUND && c[0].body_b == 0 && c[0].fingers == 30);
    assert_relative(c[0].bx_m, 1e-6, 1e-15);
    assert_relative(c[0].by_m, 2e-6, 1e-15);
    assert_relative(c[0].direction_rad, pi / 2, 1e-15);
    assert_relative(c[0].gap_m, 3e-6, 1e-15);
    assert_relative(c[0].overlap_m, 20e-6, 1e-15);
    assert_true(isnan(c[0].length_m) && isnan(c[0].depth_m) && c[0].law == NULL);
    assert_relative(c[0].voltage_V, -40, 1e-15);
    assert_int_equal(c[1].kind, FW_ELECTRODES_PLATE);
    assert_true(c[1].body_a == 1 && isnan(c[1].overlap_m));
    assert_relative(c[1].length_m, 100e-6, 1e-15);
    assert_relative(c[1].depth_m, 30e-6, 1e-15);
    assert_relative(c[1].voltage_V, 1000, 1e-15);
    assert_relative(c[1].law->frequency_Hz, 1000, 1e-15);
}

static void carriers(void **state) {
    (void)state;
    const fw_device *d = sound(arena,
                               DEVICE("<flow ref=\"a\"/><flow ref=\"b\" carrier=\"none\"/><flow "
                                      "ref=\"c\" carrier=\"insulating\"/>" ARM),
                               NULL, 0);
    assert_true(!d->flow[0].insulating_carrier && !d->flow[1].insulating_carrier &&
                d->flow[2].insulating_carrier);
}

static void shaking(void **state) {
    (void)state;
    const fw_device_scene *s = scene_of(
        SCENE("<base-motion ax=\"3 m/s^2\" law=\"half-sine\" start=\"1 ms\" rise=\"2 ms\"/>"
              "<base-motion ay=\"-4 mm/ms^2\" law=\"random\" frequency=\"20 Hz\" "
              "frequency-most=\"2 kHz\" lines=\"64\" seed=\"4294967295\"/><base-motion ax=\"1 "
              "m/s^2\" law=\"random\" frequency=\"1 Hz\" frequency-most=\"2 Hz\"/>"));
    assert_int_equal(s->nbase, 3);
    const fw_device_base_motion *b = s->base;
    assert_relative(b[0].ax_m_per_s2, 3, 1e-15);
    assert_near(b[0].ay_m_per_s2, 0, 0);
    assert_int_equal(b[0].law->kind == &fw_quantity_law_half_sine, 1);
    assert_relative(b[0].law->start_s, 1e-3, 1e-15);
    assert_relative(b[0].law->rise_s, 2e-3, 1e-15);
    assert_relative(b[1].ay_m_per_s2, -4e3, 1e-14);
    assert_int_equal(b[1].law->kind == &fw_quantity_law_random, 1);
    assert_relative(b[1].law->frequency_Hz, 20, 1e-15);
    assert_relative(b[1].law->frequency_most_Hz, 2000, 1e-15);
    assert_true(b[1].law->lines == 64 && b[1].law->seed == 4294967295u);
    assert_true(b[2].law->lines == 32 && b[2].law->seed == 1);
}

static void surfaces(void **state) {
    (void)state;
    const fw_device_scene *s = scene_of(
        SCENE("<friction on=\"h\" coefficient=\"0.3\" static-coefficient=\"0.4\" preload=\"1 "
              "uN\"/><friction on=\"s\" coefficient=\"0\"/><contact id=\"k\" on=\"h\"/><contact "
              "id=\"l\" a=\"ground\" a-x=\"1 mm\" b=\"q\" b-y=\"2 mm\" side=\"outside\" "
              "distance=\"3 um\" stiffness=\"1 kN/m\" damping=\"1 N s/m\"/><contact id=\"m\" "
              "a=\"p\" b=\"q\" side=\"inside\" distance=\"0 um\" stiffness=\"1 N/m\"/>"));
    const fw_device_friction_use *f = s->friction;
    assert_int_equal(s->nfriction, 2);
    assert_true(f[0].revolute == 0 && f[0].joint == FW_NONE && isnan(f[0].radius_m));
    assert_relative(f[0].coefficient, 0.3, 1e-15);
    assert_relative(f[0].static_coefficient, 0.4, 1e-15);
    assert_relative(f[0].preload_N, 1e-6, 1e-15);
    assert_true(f[1].revolute == FW_NONE && f[1].joint == 0 && isnan(f[1].static_coefficient));
    assert_near(f[1].preload_N, 0, 0);
    assert_int_equal(s->ncontact, 3);
    const fw_device_contact_use *c = s->contact;
    assert_true(c[0].joint == 0 && isnan(c[0].distance_m) && isnan(c[0].stiffness_N_per_m));
    assert_true(c[1].joint == FW_NONE && c[1].side == FW_CONTACT_OUTSIDE);
    assert_true(c[1].body_a == FW_GROUND && c[1].body_b == 1);
    assert_relative(c[1].ax_m, 1e-3, 1e-15);
    assert_relative(c[1].by_m, 2e-3, 1e-15);
    assert_relative(c[1].distance_m, 3e-6, 1e-15);
    assert_relative(c[1].stiffness_N_per_m, 1e3, 1e-15);
    assert_relative(c[1].damping_Ns_per_m, 1, 1e-15);
    assert_true(c[2].side == FW_CONTACT_INSIDE && c[2].distance_m == 0);
    s = scene_of(SCENE("<contact id=\"k\" on=\"h\" gap=\"5 um\" stiffness=\"2 N/m\"/>"));
    assert_relative(s->contact[0].distance_m, 5e-6, 1e-15);
}

static void surroundings(void **state) {
    (void)state;
    const fw_device_scene *s = scene_of(
        SCENE("<material-damping/><temperature change=\"-40 Cel - 20 Cel\"/><residual-stress "
              "mean=\"20 MPa\" gradient=\"-3 MPa/um\"/><air kind=\"slide\" gap=\"2 um\"/><air "
              "kind=\"squeeze\" on=\"p\" against=\"q\" x=\"1 mm\" direction=\"45 deg\" gap=\"3 "
              "um\" length=\"1 mm\" depth=\"50 um\" pressure=\"1e-3 Pa\" temperature=\"-40 "
              "Cel\"/><air kind=\"drag\" on=\"q\" area=\"1 mm^2\" viscosity=\"20 uPa s\"/>"));
    assert_true(s->ndamping == 1 && s->ntemperature == 1 && s->nstress == 1 && s->nair == 3);
    assert_true(isnan(s->damping[0].loss_factor) && isnan(s->damping[0].frequency_Hz));
    assert_relative(s->temperature[0].change_K, -60, 1e-13);
    assert_true(isnan(s->temperature[0].expansion_per_K) &&
                isnan(s->temperature[0].substrate_expansion_per_K) &&
                isnan(s->temperature[0].modulus_change_per_K) && s->temperature[0].law == NULL);
    assert_relative(s->stress[0].mean_Pa, 20e6, 1e-15);
    assert_relative(s->stress[0].gradient_Pa_per_m, -3e12, 1e-15);
    const fw_device_air *a = s->air;
    assert_true(a[0].kind == FW_AIR_SLIDE && a[0].body == FW_NONE && isnan(a[0].area_m2));
    assert_relative(a[0].gap_m, 2e-6, 1e-15);
    assert_relative(a[0].pressure_Pa, 101325, 0);
    assert_relative(a[0].temperature_K, 293.15, 0);
    assert_true(isnan(a[0].viscosity_Pas));
    assert_true(a[1].kind == FW_AIR_SQUEEZE && a[1].body == 0 && a[1].against == 1);
    assert_relative(a[1].x_m, 1e-3, 1e-15);
    assert_relative(a[1].direction_rad, pi / 4, 1e-15);
    assert_relative(a[1].length_m, 1e-3, 1e-15);
    assert_relative(a[1].depth_m, 50e-6, 1e-15);
    assert_relative(a[1].pressure_Pa, 1e-3, 1e-15);
    assert_relative(a[1].temperature_K, 233.15, 1e-15);
    assert_true(a[2].kind == FW_AIR_DRAG && a[2].body == 1 && a[2].against == FW_GROUND);
    assert_relative(a[2].area_m2, 1e-6, 1e-15);
    assert_relative(a[2].viscosity_Pas, 20e-6, 1e-14);
    s = scene_of(SCENE("<material-damping loss-factor=\"0.01\" frequency=\"1 kHz\"/><temperature "
                       "change=\"20 K\" expansion=\"3 ppm/K\" substrate-expansion=\"4e-6 1/K\" "
                       "modulus-change=\"-60 ppm/K\" law=\"ramp\" rise=\"1 s\"/>"));
    assert_relative(s->damping[0].loss_factor, 0.01, 1e-15);
    assert_relative(s->damping[0].frequency_Hz, 1000, 1e-15);
    assert_relative(s->temperature[0].expansion_per_K, 3e-6, 1e-15);
    assert_relative(s->temperature[0].substrate_expansion_per_K, 4e-6, 1e-15);
    assert_relative(s->temperature[0].modulus_change_per_K, -60e-6, 1e-15);
    assert_non_null(s->temperature[0].law);
}

/* ids belong to their scene: two scenes may use the same */
#define TWO                                                                                        \
    DEVICE(BODIES                                                                                  \
           "<scene name=\"s\" duration=\"1 s\"><tendon id=\"a\" pull=\"1 N\"><eyelet "             \
           "on=\"p\"/><eyelet on=\"ground\"/></tendon><tendon id=\"b\" pull=\"1 N\"><eyelet "      \
           "on=\"p\"/><eyelet on=\"ground\"/></tendon><friction on=\"h\" "                         \
           "coefficient=\"0.1\"/></scene><scene name=\"r\" duration=\"1 s\"><tendon id=\"b\" "     \
           "pull=\"2 N\"><eyelet on=\"q\"/><eyelet on=\"ground\"/></tendon><base-motion ax=\"1 "   \
           "m/s^2\"/><base-motion ay=\"1 m/s^2\"/></scene>")

static void ids_and_sets(void **state) {
    (void)state;
    const fw_device *d = sound(arena, TWO, NULL, 0);
    assert_true(d->scene[0].ntendon == 2 && d->scene[1].ntendon == 1);
    assert_int_equal(d->scene[1].tendon[0].eyelet[0].body, 1);
    assert_true(d->scene[1].nfriction == 0 && d->scene[1].nbase == 2);
    const fw_device_set set[] = {{"tendon[a]/@pull", "7 mN"}, {"friction[h]/@coefficient", "0.7"}};
    d = sound(arena, TWO, set, 2);
    assert_relative(d->scene[0].tendon[0].pull_N, 7e-3, 1e-15);
    assert_relative(d->scene[0].friction[0].coefficient, 0.7, 1e-15);
    const fw_device_set ambiguous = {"tendon[b]/@pull", "7 mN"},
                        unknown = {"tendon[c]/@pull", "7 mN"};
    const fw_device_set nameless = {"base-motion/@ax", "2 m/s^2"};
    only_error(arena, TWO, &ambiguous, 1, 55, "several scenes");
    only_error(arena, TWO, &unknown, 1, 55, "no such element has this id");
    only_error(arena, TWO, &nameless, 1, 55, "no names");
}

/* a parameter that is lost silences what uses it, a body that is misspelt what is on it */
static void one_mistake_one_message(void **state) {
    (void)state;
    only_error(arena,
               DEVICE("<parameter name=\"v\" value=\"1/0\"/>" BODIES
                      "<scene name=\"s\" duration=\"1 s\"><comb-drive id=\"c\" kind=\"comb\" "
                      "on=\"p\" direction=\"0 deg\" fingers=\"v\" gap=\"3 um\" overlap=\"v\" "
                      "voltage=\"v\"/><temperature change=\"v\"/><base-motion ax=\"v\"/></scene>"),
               NULL, 0, 27, "zero");
    only_error(arena,
               SCENE("<tendon id=\"a\" pull=\"1 N\"><eyelet on=\"pp\"/><eyelet "
                     "on=\"ground\"/></tendon>"),
               NULL, 0, 46, "no body");
    only_error(arena,
               SCENE("<tendon id=\"a\" pull=\"1 N\"><eylet on=\"p\"/><eyelet "
                     "on=\"ground\"/></tendon>"),
               NULL, 0, 40, "<eyelet>");
    only_error(arena, SCENE("<air kind=\"drg\"/>"), NULL, 0, 48, "drag");
    only_error(arena, SCENE("<contact id=\"k\" onn=\"h\"/>"), NULL, 0, 42, "'on'");
}

/* temperatures are differences, unless it is the air's */
static void celsius(void **state) {
    (void)state;
    static const char *const refused[] = {"20 Cel", "-20 Cel", "hot", "hot + 20 K"};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++)
        only_error(arena,
                   fw_arena_printf(arena,
                                   DEVICE("<parameter name=\"hot\" value=\"80 Cel\"/>" ARM
                                          "<scene name=\"s\" duration=\"1 s\"><temperature "
                                          "change=\"%s\"/></scene>"),
                                   refused[i]),
                   NULL, 0, 94, "temperature");
    static const struct {
        const char *text;
        double K;
    } good[] = {{"20 K", 20}, {"80 Cel - 20 Cel", 60}, {"hot - 20 Cel", 60}, {"less", -20}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        const fw_device *d =
            sound(arena,
                  fw_arena_printf(arena,
                                  DEVICE("<parameter name=\"hot\" value=\"80 Cel\"/><parameter "
                                         "name=\"less\" value=\"-20 K\"/>" ARM
                                         "<scene name=\"s\" duration=\"1 s\"><temperature "
                                         "change=\"%s\"/></scene>"),
                                  good[i].text),
                  NULL, 0);
        assert_relative(d->scene[0].temperature[0].change_K, good[i].K, 1e-13);
    }
}

static const fw_device *example(const char *name) {
    char path[100];
    size_t n;
    snprintf(path, sizeof path, "tests/data/effects/%s.xml", name);
    return sound(arena, load(arena, path, &n), NULL, 0);
}

/* every element once at least */
static void examples(void **state) {
    (void)state;
    const fw_device *tendons_ = example("tendons"), *comb = example("comb");
    const fw_device *shaken = example("shaken"), *rubbing = example("rubbing");
    assert_true(tendons_->six_bar && tendons_->scene[0].ntendon == 4);
    assert_int_equal(tendons_->scene[1].tendon[3].neyelet, 3);
    assert_true(comb->flow[0].insulating_carrier && comb->scene[0].ncomb == 1);
    assert_int_equal(comb->scene[2].comb[0].kind, FW_ELECTRODES_PLATE);
    assert_true(shaken->scene[0].nbase == 1 && shaken->scene[1].nbase == 2);
    assert_true(shaken->scene[0].nair == 3 && shaken->scene[2].nstress == 1);
    assert_true(shaken->scene[3].temperature[0].change_K < -59);
    assert_true(rubbing->scene[0].ncontact == 2 && rubbing->scene[1].nfriction == 2);
}

static void memory_runs_out(void **state) {
    (void)state;
    static const char *const name[] = {"tendons", "comb", "shaken", "rubbing"};
    for (int k = 0; k < 4; k++) {
        char path[100];
        size_t n;
        snprintf(path, sizeof path, "tests/data/effects/%s.xml", name[k]);
        char *xml = load(arena, path, &n);
        for (long at = 1;; at++) {
            fw_arena *own = fw_arena_new(0);
            fw_diags diags = fw_diags_new(own);
            const fw_device *device;
            fw_arena_fail_at(at, 0);
            fw_status s = fw_device_read(own, "g.xml", xml, n, NULL, 0, &diags, &device);
            long used = fw_arena_count();
            fw_arena_fail_at(0, 0);
            assert_int_equal(s, used >= at ? FW_NOMEM : FW_OK);
            fw_arena_free(own);
            if (used < at) break;
        }
    }
}

/* a law that is 0 until the scene of 1 s is over is said, at its place; others are not */
static void never_acts(void **state) {
    (void)state;
    static const struct {
        const char *part;
        bool late;
    } row[] = {
        {"<torque on=\"p\" value=\"1 uN m\" law=\"step\" start=\"1 s\"/>", true},
        {"<torque on=\"p\" value=\"1 uN m\" law=\"step\" start=\"0.99 s\"/>", false},
        {"<force on=\"p\" fx=\"1 uN\" law=\"ramp\" start=\"2 s\" rise=\"1 s\"/>", true},
        {"<force on=\"p\" fx=\"1 uN\" law=\"ramp\" rise=\"10 s\"/>", false},
        {"<force on=\"p\" fx=\"1 uN\" law=\"sine\" frequency=\"1 Hz\" start=\"3 s\"/>", true},
        {"<force on=\"p\" fx=\"1 uN\" law=\"table\" table=\"0 s: 0; 2 s: 0; 3 s: 1\"/>", true},
        {"<force on=\"p\" fx=\"1 uN\" law=\"table\" table=\"0 s: 0; 3 s: 1\"/>", false},
        {"<force on=\"p\" fx=\"1 uN\" law=\"step\" end=\"2 s\"/>", false},
        {"<temperature change=\"9 K\" law=\"ramp\" start=\"5 s\" rise=\"1 s\"/>", true}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        char xml[4096];
        snprintf(xml, sizeof xml, SCENE("%s"), row[i].part);
        fw_diags diags = fw_diags_new(arena);
        const fw_device *d;
        if (fw_device_read(arena, "d.xml", xml, strlen(xml), NULL, 0, &diags, &d) != FW_OK)
            fail_msg("%zu: %s", i, diags.item[0].message);
        const fw_diag *said = NULL;
        for (size_t k = 0; k < diags.count; k++)
            if (diags.item[k].number == 99) said = &diags.item[k];
        if ((said != NULL) != row[i].late) fail_msg("%s", row[i].part);
        if (!said) continue;
        assert_int_equal(said->severity, FW_WARNING);
        assert_true(said->place.column > 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tendons),         cmocka_unit_test(combs),
        cmocka_unit_test(carriers),        cmocka_unit_test(shaking),
        cmocka_unit_test(surfaces),        cmocka_unit_test(surroundings),
        cmocka_unit_test(ids_and_sets),    cmocka_unit_test(one_mistake_one_message),
        cmocka_unit_test(celsius),         cmocka_unit_test(examples),
        cmocka_unit_test(memory_runs_out), cmocka_unit_test(never_acts),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
