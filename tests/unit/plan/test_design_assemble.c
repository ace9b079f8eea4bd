/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fw_design_assemble: order of calls, documents, failures, memory that runs out. */
#include "base/arena.h"
#include "test.h"
#include <flexwright.h>

#define STREWN  FW_TEST_SOURCE_DIR "/tests/data/strewn-six-bar.xml"
#define GALLERY FW_TEST_SOURCE_DIR "/docs/gallery/reference-six-bar/device.xml"

static fw_design_options options(void) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    return o;
}

static void order_of_calls(void **state) {
    (void)state;
    fw_design_options o = options();
    fw_design *design = fw_design_new(&o);
    const char *text;
    assert_int_equal(fw_design_assemble(NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_assemble(design), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read(design, STREWN), FW_STATUS_OK);
    for (int d = FW_DOCUMENT_ASSEMBLE_JSON; d <= FW_DOCUMENT_ASSEMBLE_SVG; d++)
        assert_int_equal(fw_design_document(design, d, &text, NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_assemble(design), FW_STATUS_OK);
    assert_int_equal(fw_design_assemble(design), FW_STATUS_OK);
    for (int d = FW_DOCUMENT_ASSEMBLE_JSON; d <= FW_DOCUMENT_ASSEMBLE_SVG; d++) {
        size_t n;
        assert_int_equal(fw_design_document(design, d, &text, &n), FW_STATUS_OK);
        assert_true(n > 200);
        assert_null(strstr(text, "nan"));
    }
    fw_design_free(design);
}

/* a device with a drawing, which is closed: outlines in the picture, nothing moved */
static void drawn_device(void **state) {
    (void)state;
    fw_design_options o = options();
    o.scene = "step-load", o.rates = "1 rad/s, 2 rad/s, -1 rad/s";
    fw_design *design = fw_design_new(&o);
    const char *text;
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_int_equal(fw_design_assemble(design), FW_STATUS_OK);
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_ASSEMBLE_TEXT, &text, NULL),
                     FW_STATUS_OK);
    assert_non_null(strstr(text, "nothing was moved"));
    assert_non_null(strstr(text, "loads of scene step-load"));
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_ASSEMBLE_SVG, &text, NULL),
                     FW_STATUS_OK);
    assert_non_null(strstr(text, "rotate("));
    fw_design_free(design);
}

static void impossible(void **state) {
    (void)state;
    static const char xml[] =
        "<device xmlns=\"urn:flexwright:device:1\" name=\"short\"><mechanism>"
        "<body id=\"b\" mass=\"1 kg\" inertia=\"1 kg m^2\" x=\"0 m\" y=\"0 m\"/>"
        "<revolute id=\"P\" a=\"ground\" b=\"b\" b-x=\"-1 m\"/>"
        "<revolute id=\"Q\" a=\"ground\" a-x=\"3 m\" b=\"b\" b-x=\"1 m\"/>"
        "</mechanism></device>";
    fw_design_options o = options();
    fw_design *design = fw_design_new(&o);
    const char *text;
    assert_int_equal(fw_design_read_memory(design, "short.xml", xml, sizeof xml - 1), FW_STATUS_OK);
    assert_int_equal(fw_design_assemble(design), FW_STATUS_SOLVER);
    assert_int_equal(fw_design_diagnostic(design, 0)->number, 100);
    assert_int_equal(fw_design_diagnostic(design, 0)->line, 1);
    assert_non_null(strstr(fw_design_diagnostic(design, 0)->message, "1000 mm are missing"));
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_ASSEMBLE_JSON, &text, NULL),
                     FW_STATUS_USAGE);
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_ASSEMBLE_SVG, &text, NULL),
                     FW_STATUS_OK);
    assert_non_null(strstr(text, "least mismatch"));
    fw_design_free(design);
    design = fw_design_new(&o);
    assert_int_equal(fw_design_read_memory(design, "short.xml", xml, sizeof xml - 1), FW_STATUS_OK);
    fw_design_cancel(design);
    assert_int_equal(fw_design_assemble(design), FW_STATUS_CANCELLED);
    fw_design_cancel_clear(design);
    fw_design_free(design);
}

static int life(void) {
    fw_design_options o = options();
    o.rates = "1 rad/s,0 rad/s,0 rad/s", o.independent = "AB.phi,BC.phi,CD.phi";
    fw_design *design = fw_design_new(&o);
    const char *text;
    if (!design) return FW_STATUS_NOMEM;
    int status = fw_design_read(design, STREWN);
    if (status == FW_STATUS_OK) status = fw_design_assemble(design);
    for (int d = FW_DOCUMENT_ASSEMBLE_JSON; d <= FW_DOCUMENT_ASSEMBLE_SVG; d++)
        if (status == FW_STATUS_OK) status = fw_design_document(design, d, &text, NULL);
    fw_design_free(design);
    return status;
}

static void memory_runs_out(void **state) {
    (void)state;
    fw_arena_fail_at(0, 0);
    assert_int_equal(life(), FW_STATUS_OK);
    long all = fw_arena_count();
    for (long n = 1; n <= all; n += test_cases(3, 17))
        for (int ever = 0; ever < 2; ever++) {
            fw_arena_fail_at(n, ever);
            int status = life();
            fw_arena_fail_at(0, 0);
            if (status != FW_STATUS_NOMEM && status != FW_STATUS_OK)
                fail_msg("allocation %ld of %ld: status %d", n, all, status);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_of_calls),
        cmocka_unit_test(drawn_device),
        cmocka_unit_test(impossible),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
