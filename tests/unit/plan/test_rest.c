/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes and equilibria of the public library: order of calls, documents, memory that runs out. */
#include "base/arena.h"
#include "base/status.h"
#include "test.h"
#include <flexwright.h>
#include <stdlib.h>

#define GALLERY FW_TEST_SOURCE_DIR "/docs/gallery/reference-six-bar/device.xml"

static fw_design *fresh(int path, const char *at) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.path = path;
    o.at = at;
    fw_design *design = fw_design_new(&o);
    assert_non_null(design);
    return design;
}

static const char *text_of(fw_design *design, int document) {
    const char *text;
    size_t n;
    assert_int_equal(fw_design_document(design, document, &text, &n), FW_STATUS_OK);
    assert_int_equal(strlen(text), n);
    return text;
}

/* the first number behind "key": in JSON */
static double number_of(const char *json, const char *key) {
    const char *at = strstr(json, key);
    if (!at) fail_msg("no %s", key);
    return strtod(strchr(at, ':') + 1, NULL);
}

static void documents_and_their_stages(void **state) {
    (void)state;
    static const struct {
        int document;
        const char *begins;
        int modes, statics, path; /* there after that stage alone; the path was followed */
    } row[] = {{FW_DOCUMENT_MODES_JSON, "{\n \"schema\": \"flexwright.modes/1\"", 1, 0, 0},
               {FW_DOCUMENT_MODES_TEXT, "scene step-load, about the assembled", 1, 0, 0},
               {FW_DOCUMENT_MODES_SVG, "<?xml", 1, 0, 0},
               {FW_DOCUMENT_STATICS_JSON, "{\n \"schema\": \"flexwright.statics/1\"", 0, 1, 1},
               {FW_DOCUMENT_STATICS_TEXT, "scene step-load: equilibrium", 0, 1, 1},
               {FW_DOCUMENT_STATICS_SVG, "<?xml", 0, 1, 1},
               {FW_DOCUMENT_LOAD_PATH_CSV, "load_factor,lowest_per_s2,", 0, 1, 1},
               {FW_DOCUMENT_LOAD_PATH_SVG, "<?xml", 0, 0, 1}};
    for (int stage = 0; stage < 4; stage++) {
        fw_design *design = fresh(stage == 3, NULL);
        assert_int_equal(fw_design_modes(design), FW_STATUS_USAGE);
        assert_int_equal(fw_design_statics(design), FW_STATUS_USAGE);
        assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
        if (stage == 1) assert_int_equal(fw_design_modes(design), FW_STATUS_OK);
        if (stage > 1) assert_int_equal(fw_design_statics(design), FW_STATUS_OK);
        for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
            const int there[] = {0, row[i].modes, row[i].statics, row[i].path};
            const char *text = "";
            int status = fw_design_document(design, row[i].document, &text, NULL);
            assert_int_equal(status, there[stage] ? FW_STATUS_OK : FW_STATUS_USAGE);
            if (status == FW_STATUS_OK)
                assert_memory_equal(text, row[i].begins, strlen(row[i].begins));
        }
        fw_design_free(design);
    }
    assert_int_equal(fw_design_modes(NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_statics(NULL), FW_STATUS_USAGE);
}

/* a press: crank, rod, a ram on a slide whose pose is off by 5 mm, a plate welded to the ram, a
 * stay */
static const char press[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"press\"><mechanism>"
    "<body id=\"crank\" mass=\"5 g\" inertia=\"0.2 g cm^2\" x=\"5 mm\" y=\"0 mm\"/>"
    "<body id=\"rod\" mass=\"8 g\" inertia=\"6 g cm^2\" x=\"25 mm\" y=\"0 mm\"/>"
    "<body id=\"ram\" mass=\"20 g\" inertia=\"3 g cm^2\" x=\"45 mm\" y=\"0 mm\"/>"
    "<body id=\"plate\" mass=\"20 g\" inertia=\"3 g cm^2\" x=\"45 mm\" y=\"0 mm\"/>"
    "<revolute id=\"main\" a=\"ground\" b=\"crank\" b-x=\"-5 mm\"/>"
    "<revolute id=\"pin\" a=\"crank\" a-x=\"5 mm\" b=\"rod\" b-x=\"-15 mm\"/>"
    "<revolute id=\"wrist\" a=\"rod\" a-x=\"15 mm\" b=\"ram\"/>"
    "<prismatic id=\"bore\" a=\"ground\" b=\"ram\" axis=\"0 deg\" angle=\"0 deg\"/>"
    "<weld id=\"seam\" a=\"ram\" b=\"plate\" angle=\"0 deg\"/>"
    "<driver id=\"motor\" joint=\"main\" value=\"30 rad/s * t\"/>"
    "</mechanism><scene name=\"turn\" duration=\"0.1 s\">"
    "<force on=\"plate\" fx=\"-2 N\" fy=\"-1 N\"/></scene></device>";

static void joints_of_every_kind_are_listed(void **state) {
    (void)state;
    fw_design *design = fresh(0, NULL);
    assert_int_equal(fw_design_read_memory(design, "press.xml", press, sizeof press - 1),
                     FW_STATUS_OK);
    assert_int_equal(fw_design_statics(design), FW_STATUS_OK);
    assert_non_null(
        strstr(fw_design_diagnostic(design, 0)->message, "by up to 5000 um to close")); /* poses */
    const char *json = text_of(design, FW_DOCUMENT_STATICS_JSON);
    const double a = 3, tilt = asin(sin(a) / 3);
    assert_near(number_of(strstr(json, "\"motor\""), "torque_Nm"),
                2 * 0.01 * (-sin(a) - cos(a) * tan(tilt)), 1e-13);
    assert_non_null(strstr(json, "\"kind\": \"prismatic\""));
    assert_non_null(strstr(json, "\"kind\": \"weld\""));
    assert_null(strstr(json, "-0.0,"));
    const char *csv = text_of(design, FW_DOCUMENT_LOAD_PATH_CSV);
    assert_non_null(strstr(csv, ",bore.fx_N,bore.fy_N,bore.torque_Nm,seam.fx_N,"));
    assert_non_null(strstr(csv, ",motor.drive_Nm\n"));
    int commas[2] = {0}, line = 0;
    for (const char *c = csv; *c; c++) {
        commas[line] += *c == ',';
        line += *c == '\n' && line == 0;
    }
    assert_int_equal(commas[0], commas[1]);
    const char *text = text_of(design, FW_DOCUMENT_STATICS_TEXT);
    assert_non_null(strstr(text, "  seam "));
    assert_non_null(strstr(text, "  motor "));
    assert_int_equal(fw_design_simulate(design), FW_STATUS_OK);
    json = text_of(design, FW_DOCUMENT_SIMULATE_JSON);
    assert_near(number_of(json, "assembly_moved_m"), 5e-3, 1e-9);
    assert_near(number_of(strstr(json, "\"travels\""), "travel_m"), 0.04, 1e-9);
    const char *reactions = strstr(json, "\"reactions\"");
    assert_non_null(reactions);
    static const char *const joint[] = {"main", "pin", "wrist", "bore", "seam", "motor"};
    for (int i = 0; i < 6; i++) {
        char key[32];
        snprintf(key, sizeof key, "\"joint\": \"%s\"", joint[i]);
        const char *at = strstr(reactions, key);
        assert_non_null(at);
        assert_true((number_of(at, "force_N") > 0) == (i < 5));
        if (i > 2) assert_true(number_of(at, "torque_Nm") >= (i == 5 ? 0.01 : 0));
    }
    text = text_of(design, FW_DOCUMENT_SIMULATE_TEXT);
    assert_non_null(strstr(text, "bore     travel"));
    assert_non_null(strstr(text, "seam     force"));
    assert_non_null(strstr(text, "motor    torque"));
    fw_design_free(design);
}

/* all three stages of one design, in any order, keep their documents; a failed one harms none */
static void stages_side_by_side(void **state) {
    (void)state;
    fw_design *a = fresh(1, "equilibrium"), *b = fresh(1, "equilibrium");
    fw_design *design[2] = {a, b};
    for (int i = 0; i < 2; i++)
        assert_int_equal(fw_design_read(design[i], GALLERY), FW_STATUS_OK);
    assert_int_equal(fw_design_modes(a), FW_STATUS_OK);
    assert_int_equal(fw_design_statics(a), FW_STATUS_OK);
    assert_int_equal(fw_design_simulate(b), FW_STATUS_OK);
    assert_int_equal(fw_design_statics(b), FW_STATUS_OK);
    assert_int_equal(fw_design_modes(b), FW_STATUS_OK);
    static const int same[] = {FW_DOCUMENT_MODES_JSON,    FW_DOCUMENT_MODES_SVG,
                               FW_DOCUMENT_STATICS_JSON,  FW_DOCUMENT_STATICS_SVG,
                               FW_DOCUMENT_LOAD_PATH_CSV, FW_DOCUMENT_LOAD_PATH_SVG};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
        assert_string_equal(text_of(a, same[i]), text_of(b, same[i]));
    assert_relative(number_of(text_of(a, FW_DOCUMENT_MODES_JSON), "\"f_Hz\""), 499.954131531546860,
                    1e-12);
    fw_design_free(a);
    fw_design_free(b);

    static const char lone[] = "<device xmlns=\"urn:flexwright:device:1\" name=\"lone\">"
                               "<mechanism><body id=\"b\" mass=\"1 mg\" inertia=\"1 mg mm^2\" "
                               "x=\"0 mm\" y=\"0 mm\"/></mechanism></device>";
    fw_design *c = fresh(0, NULL);
    assert_int_equal(fw_design_read_memory(c, "lone.xml", lone, sizeof lone - 1), FW_STATUS_OK);
    assert_int_equal(fw_design_modes(c), FW_STATUS_OK); /* no scene is needed */
    assert_int_equal(fw_design_statics(c), FW_STATUS_INPUT);
    assert_int_equal(fw_design_simulate(c), FW_STATUS_INPUT);
    assert_non_null(strstr(text_of(c, FW_DOCUMENT_MODES_TEXT), "(free)"));
    assert_non_null(strstr(text_of(c, FW_DOCUMENT_MODES_JSON), "\"kind\": \"free\""));
    fw_design_free(c);
}

static void wrong_options(void **state) {
    (void)state;
    fw_design *design = fresh(0, "midnight");
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_USAGE);
    fw_design_free(design);
}

/* 0 or the status of all documents of both stages */
static int life(const char *want, int *same) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.path = 1;
    fw_design *design = fw_design_new(&o);
    if (!design) return FW_STATUS_NOMEM;
    const char *text = NULL;
    *same = 1;
    int status = fw_design_read(design, GALLERY);
    if (status == FW_STATUS_OK) status = fw_design_modes(design);
    if (status == FW_STATUS_OK) status = fw_design_statics(design);
    for (int d = FW_DOCUMENT_MODES_JSON; status == FW_STATUS_OK && d <= FW_DOCUMENT_LOAD_PATH_SVG;
         d++)
        status = fw_design_document(design, d, &text, NULL);
    if (status == FW_STATUS_OK) *same = !want || strcmp(want, text) == 0;
    fw_design_free(design);
    return status;
}

static void memory_runs_out(void **state) {
    (void)state;
    int same;
    fw_design *design = fresh(1, NULL);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_int_equal(fw_design_statics(design), FW_STATUS_OK);
    const char *want = text_of(design, FW_DOCUMENT_LOAD_PATH_SVG);
    fw_arena_fail_at(0, 0);
    assert_int_equal(life(want, &same), FW_STATUS_OK);
    assert_true(same);
    long all = fw_arena_count(), nomem = 0;
    for (long i = 0; i < 60; i++) {
        fw_arena_fail_at(all - i * (all / 60), 1);
        int status = life(want, &same);
        fw_arena_fail_at(0, 0);
        nomem += status == FW_STATUS_NOMEM;
        if (status != FW_STATUS_NOMEM && !(status == FW_STATUS_OK && same))
            fail_msg("allocation %ld of %ld: status %d", all - i * (all / 60), all, status);
    }
    assert_true(nomem > 30);
    fw_design_free(design);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(documents_and_their_stages),
        cmocka_unit_test(joints_of_every_kind_are_listed),
        cmocka_unit_test(stages_side_by_side),
        cmocka_unit_test(wrong_options),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
