/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a document of a simulated scene prints besides the motion is found when it is asked for, and
   is then what it would have been at once. */
#include "plan/design.h"
#include "test.h"
#include <stdlib.h>

#define SOURCE FW_TEST_SOURCE_DIR

static fw_design *simulated(const char *file, double rtol, int32_t figures) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = SOURCE;
    o.samples = 51;
    o.rtol = rtol;
    o.figures = figures;
    if (!test_cases(1, 0)) o.hinge_model = "compliance"; /* exact beams take seconds */
    fw_design *design = fw_design_new(&o);
    assert_non_null(design);
    assert_int_equal(fw_design_read(design, file), FW_STATUS_OK);
    assert_int_equal(fw_design_simulate(design), FW_STATUS_OK);
    return design;
}

static const char *text_of(fw_design *design, int document) {
    const char *text;
    assert_int_equal(fw_design_document(design, document, &text, NULL), FW_STATUS_OK);
    return text;
}

/* but for lines with a CPU time */
static void same_lines(const char *a, const char *b) {
    while (*a && *b) {
        size_t n = strcspn(a, "\n"), m = strcspn(b, "\n");
        bool timed = n > 4 && (strstr(a, "cpu_s\"") && strstr(a, "cpu_s\"") < a + n);
        timed = timed || (strstr(a, " CPU") && strstr(a, " CPU") < a + n);
        if (!timed && (n != m || memcmp(a, b, n) != 0))
            fail_msg("%.*s\n%.*s", (int)n, a, (int)m, b);
        a += n + (a[n] == '\n'), b += m + (b[m] == '\n');
    }
    assert_true(!*a && !*b);
}

static void the_same_documents(void **state) {
    (void)state;
    static const char *const file[] = {SOURCE "/docs/gallery/reference-six-bar/device.xml",
                                       SOURCE "/tests/data/six-bar-benchmark.xml",
                                       SOURCE "/tests/data/effects/rubbing.xml",
                                       SOURCE "/tests/data/effects/comb.xml"};
    for (size_t i = 0; i < sizeof file / sizeof file[0]; i++) {
        fw_design *late = simulated(file[i], 1e-7, 0), *whole = simulated(file[i], 1e-7, 1);
        size_t said = fw_design_diagnostics(late);
        assert_int_equal(said, fw_design_diagnostics(whole));
        assert_int_equal(late->known, 0);
        assert_int_equal(whole->known, FW_WANTED_FIGURES);
        assert_string_equal(text_of(late, FW_DOCUMENT_MOTION_CSV),
                            text_of(whole, FW_DOCUMENT_MOTION_CSV));
        assert_string_equal(text_of(late, FW_DOCUMENT_FORCES_CSV),
                            text_of(whole, FW_DOCUMENT_FORCES_CSV));
        assert_string_equal(text_of(late, FW_DOCUMENT_ANIMATION_SVG),
                            text_of(whole, FW_DOCUMENT_ANIMATION_SVG));
        assert_int_equal(late->known, 0);
        same_lines(text_of(late, FW_DOCUMENT_SIMULATE_JSON),
                   text_of(whole, FW_DOCUMENT_SIMULATE_JSON));
        assert_int_equal(late->known, FW_WANTED_FIGURES);
        text_of(late, FW_DOCUMENT_PREVIEW_JSON);
        assert_int_equal(late->known, FW_WANTED_FIGURES | FW_WANTED_ENERGIES);
        assert_int_equal(said, fw_design_diagnostics(late));
        fw_design_free(late);
        fw_design_free(whole);
    }
}

/* a tolerance that is not stated is chosen by the figures */
static void without_a_tolerance(void **state) {
    (void)state;
    fw_design *design = simulated(SOURCE "/tests/data/six-bar-benchmark.xml", 0, 0);
    assert_int_equal(design->known, FW_WANTED_FIGURES);
    fw_design_free(design);
}

/* the second run may be cancelled, and asked for again; what was there stays */
static void cancelled_in_between(void **state) {
    (void)state;
    fw_design *design = simulated(SOURCE "/tests/data/six-bar-benchmark.xml", 1e-7, 0);
    const char *text;
    fw_design_cancel(design);
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_SIMULATE_JSON, &text, NULL),
                     FW_STATUS_CANCELLED);
    assert_null(text);
    text_of(design, FW_DOCUMENT_MOTION_CSV);
    fw_design_cancel_clear(design);
    assert_non_null(strstr(text_of(design, FW_DOCUMENT_SIMULATE_JSON), "\"reactions\""));
    fw_design_free(design);
}

/* what a scene starts from is made once for all that is asked of it */
static void one_mechanism(void **state) {
    (void)state;
    fw_design *design = simulated(SOURCE "/tests/data/six-bar-benchmark.xml", 1e-7, 0);
    const fw_mechanism *first = design->mechanism;
    assert_int_equal(fw_design_statics(design), FW_STATUS_OK);
    assert_ptr_equal(design->mechanism, first);
    text_of(design, FW_DOCUMENT_SIMULATE_JSON);
    assert_ptr_equal(design->mechanism, first);
    fw_design_free(design);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_documents),
        cmocka_unit_test(without_a_tolerance),
        cmocka_unit_test(cancelled_in_between),
        cmocka_unit_test(one_mechanism),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
