/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of elements and what is generated from it. To regenerate the committed pages:
   FW_WRITE_REFERENCE=1 test_device_table */
#include "device/device.h"
#include "device/device_table.h"
#include "files.h"
#include <stdlib.h>
#include <unistd.h>

static void compare(const char *name, fw_status (*generate)(fw_text *)) {
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    assert_int_equal(generate(&text), FW_OK);
    char path[512];
    snprintf(path, sizeof path, "%s/%s", FW_TEST_SOURCE_DIR, name);
    if (getenv("FW_WRITE_REFERENCE")) {
        FILE *f = fopen(path, "wb");
        assert_non_null(f);
        assert_int_equal(fwrite(text.data, 1, text.length, f), text.length);
        assert_int_equal(fclose(f), 0);
    }
    size_t n;
    char *committed = load(arena, name, &n);
    if (n != text.length || memcmp(committed, text.data, n) != 0)
        fail_msg("%s differs from src/device/table_*.c; run FW_WRITE_REFERENCE=1 test_device_table",
                 name);
    fw_arena_free(arena);
}

static fw_status study_schema(fw_text *out) {
    return fw_xml_schema(&fw_device_study_table, out);
}

static void pages_are_current(void **state) {
    (void)state;
    compare("docs/reference/device.md", fw_device_reference_markdown);
    compare("docs/reference/device.rng", fw_device_relax_ng);
    compare("docs/reference/study.rng", study_schema);
}

static void rows_are_complete(void **state) {
    (void)state;
    const fw_xml_element_row *e;
    int count = 0;
    assert_null(fw_xml_row_at(&fw_device_table, -1));
    for (int i = 0; (e = fw_xml_row_at(&fw_device_table, i)) != NULL; i++, count++) {
        /* a name is unique in its parent; by itself it finds the first */
        assert_int_equal(fw_xml_row_index_in(&fw_device_table, e->name, e->parent), i);
        assert_ptr_equal(fw_xml_row_in(&fw_device_table, e->name, e->parent), e);
        assert_string_equal(fw_xml_row_find(&fw_device_table, e->name)->name, e->name);
        assert_true(e->parent[0] == '\0' || fw_xml_row_find(&fw_device_table, e->parent));
        assert_non_null(e->sentence);
        assert_true(e->nattribute <= FW_ATTRIBUTES_MOST);
        bool key = e->key == NULL;
        for (int k = 0; k < e->nattribute; k++) {
            const fw_xml_attribute_row *a = &e->attribute[k];
            fw_quantity_unit unit;
            assert_non_null(a->sentence);
            assert_true(a->sentence[strlen(a->sentence) - 1] == '.');
            key |= e->key && strcmp(e->key, a->name) == 0;
            assert_true(!a->required || !a->fallback);
            if (a->kind == FW_KIND_NUMBER) {
                assert_true(fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL));
                assert_true(fw_quantity_dimension_equal(unit.dimension, a->dimension));
            }
            assert_true(!a->whole || (a->kind == FW_KIND_NUMBER && a->ranged));
            assert_true(!a->difference || a->dimension.K == 1);
            assert_true(!a->ranged || (a->min < a->max && a->reason));
            assert_true((a->kind == FW_KIND_WORD) == (a->words != NULL));
            assert_true((a->kind == FW_KIND_REF) == (a->space != FW_SPACE_NONE));
        }
        assert_true(key);
        assert_true(!e->within || e->key);
    }
    assert_true(count > 30 && count < FW_ELEMENTS_MOST);
}

static int run(const char *command) {
    int status = system(command);
    return status;
}

static void the_schema_judges_files(void **state) {
    (void)state;
    if (run("command -v xmllint > /dev/null") != 0) skip();
#define LINT                                                                                       \
    "cd " FW_TEST_SOURCE_DIR " && xmllint --nonet --noout --relaxng docs/reference/device.rng "
    assert_int_equal(run(LINT GALLERY " 2> /dev/null"), 0);
    static const char *const refused[] = {
        "attribute-misspelt", "element-misplaced", "element-misspelt",  "word-unknown",
        "name-with-space",    "value-empty",       "attribute-missing", "dimension-wrong",
        "decimal-comma",      "unit-unknown"};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        char command[1024];
        snprintf(command, sizeof command, LINT "tests/bad/%s.xml 2> /dev/null", refused[i]);
        if (run(command) == 0) fail_msg("the schema accepts %s", refused[i]);
    }
    /* what only the program can judge passes the schema */
    assert_int_equal(run(LINT "tests/bad/dimensions-added.xml 2> /dev/null"), 0);
}

/* of a file of its own; as <study> of a device file it is in that one's schema */
static void the_schema_of_studies_judges_files(void **state) {
    (void)state;
    if (run("command -v xmllint > /dev/null") != 0) skip();
#define LINT_STUDY                                                                                 \
    "cd " FW_TEST_SOURCE_DIR " && sed '%s' docs/studies/%s.xml | "                                 \
    "xmllint --nonet --noout --relaxng docs/reference/study.rng - 2> /dev/null"
    static const struct {
        const char *change, *file;
        bool good;
    } row[] = {{"", "which-matters", true},
               {"", "how-many-survive", true},
               {"", "widest-hinge", true},
               {"s/kind=\"sensitivity\"/kind=\"sensitivities\"/", "which-matters", false},
               {"s/ device=\"[^\"]*\"//", "which-matters", false},
               {"s/ from=/ form=/", "which-matters", false},
               {"s/<vary /<varies /", "which-matters", false},
               {"s/study:1/device:1/", "which-matters", false},
               {"s/steps=\"[0-9]*\"/steps=\"8 um\"/", "width-and-arc", false}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        char command[1024];
        snprintf(command, sizeof command, LINT_STUDY, row[i].change, row[i].file);
        if ((run(command) == 0) != row[i].good)
            fail_msg("%s with %s: %s", row[i].file, row[i].change,
                     row[i].good ? "refused" : "accepted");
    }
}

static void memory_runs_out(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (long n = 1; n < 12; n++) {
        fw_text text = fw_text_new(arena);
        fw_arena_fail_at(n, 1);
        fw_status s = fw_device_relax_ng(&text);
        long used = fw_arena_count();
        fw_arena_fail_at(0, 0);
        assert_int_equal(s, used >= n ? FW_NOMEM : FW_OK);
        text = fw_text_new(arena);
        fw_arena_fail_at(n, 1);
        s = fw_device_reference_markdown(&text);
        fw_arena_fail_at(0, 0);
        assert_true(s == FW_NOMEM || s == FW_OK);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pages_are_current),
        cmocka_unit_test(rows_are_complete),
        cmocka_unit_test(the_schema_judges_files),
        cmocka_unit_test(the_schema_of_studies_judges_files),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
