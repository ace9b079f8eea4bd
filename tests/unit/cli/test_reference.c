/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The generated reference pages are what the tables say. FW_UPDATE=1 in the environment rewrites
   them. */
#include "base/diag.h"
#include "cli/cli.h"
#include "device/device_table.h"
#include "effects/effects.h"
#include "process/pack.h"
#include "test.h"
#include <stdlib.h>

static void same_as_committed(const fw_text *text, const char *path) {
    if (getenv("FW_UPDATE")) {
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        assert_int_equal(fwrite(text->data, 1, text->length, file), text->length);
        assert_int_equal(fclose(file), 0);
        return;
    }
    FILE *file = fopen(path, "r");
    if (!file) fail_msg("%s is missing: run this test with FW_UPDATE=1", path);
    static char committed[1 << 18];
    size_t n = fread(committed, 1, sizeof committed, file);
    fclose(file);
    if (n != text->length || memcmp(committed, text->data, n) != 0)
        fail_msg("%s is out of date: run this test with FW_UPDATE=1 and commit it", path);
}

static void command_line_page(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_cli_reference(&text);
    assert_int_equal(fw_text_end(&text), FW_OK);
    same_as_committed(&text, FW_TEST_SOURCE_DIR "/docs/reference/command-line.md");
    fw_arena_free(arena);
}

static void diagnostics_page(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    size_t n;
    const fw_diag_entry *entry = fw_diag_table(&n);
    fw_text_add(&text, "# Diagnostics\n\nGenerated from the table of diagnostics; do not edit. "
                       "`flexwright explain FW-Dnnn` prints the same text.\n");
    for (size_t i = 0; i < n; i++)
        fw_text_printf(&text, "\n## FW-D%03d: %s\n\n%s\n", entry[i].number, entry[i].title,
                       entry[i].text);
    assert_int_equal(fw_text_end(&text), FW_OK);
    same_as_committed(&text, FW_TEST_SOURCE_DIR "/docs/reference/diagnostics.md");
    fw_arena_free(arena);
}

/* Which schema a name space has, for editors. Packs of flows and of laboratories have one, and packs.rng takes both. */
static void catalogue(void **state) {
    (void)state;
    static const struct {
        const fw_xml_table *table;
        const char *schema; /* beside the catalogue in the source; installed, processes/ lies beside it */
    } row[] = {{&fw_device_table, "device.rng"},
               {&fw_device_study_table, "study.rng"},
               {&fw_process_pack_table, "../../processes/packs.rng"}};
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_text_add(&text,
                "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                "<!-- generated from the tables of elements; do not edit. For editors: schemas of "
                "device files, studies and process packs, by their name spaces. -->\n"
                "<catalog xmlns=\"urn:oasis:names:tc:entity:xmlns:xml:catalog\">\n");
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        fw_text_printf(&text,
                       "  <uri name=\"%s\" uri=\"%s\"/>\n  <system systemId=\"%s\" uri=\"%s\"/>\n",
                       row[i].table->urn, row[i].schema, row[i].table->urn, row[i].schema);
    fw_text_add(&text, "</catalog>\n");
    assert_int_equal(fw_text_end(&text), FW_OK);
    assert_string_equal(fw_process_pack_table.urn, fw_process_laboratory_table.urn);
    same_as_committed(&text, FW_TEST_SOURCE_DIR "/docs/reference/catalog.xml");
    fw_arena_free(arena);
}

static void every_command_is_complete(void **state) {
    (void)state;
    size_t n;
    const fw_cli_command *command = fw_cli_command_table(&n);
    for (size_t i = 0; i < n; i++) {
        assert_non_null(command[i].run);
        assert_true(strlen(command[i].summary) > 10 && strlen(command[i].text) > 40);
        assert_memory_equal(command[i].example, "flexwright ", 11);
    }
}

/* the comment above a member of the public header, from `begins` on */
static char *header_comment(fw_arena *arena, const char *begins, const char *member) {
    static char header[1 << 16];
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/include/flexwright.h", "r");
    assert_non_null(file);
    header[fread(header, 1, sizeof header - 1, file)] = '\0';
    fclose(file);
    const char *from = strstr(header, begins), *to = from ? strstr(from, member) : NULL;
    assert_non_null(to);
    return fw_arena_strndup(arena, from, (size_t)(to - from));
}

/* the hinge models that the public header names are those of the table, in its order */
static void public_header_names_the_hinge_models(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    char *at = header_comment(arena, "How flexures enter the mechanism", "*hinge_model;");
    size_t named = 0;
    for (char *end; (at = strchr(at, '"')) && (end = strchr(++at, '"')); at = end + 1) {
        *end = '\0';
        assert_true(named < fw_effects_hinge_model_count());
        assert_string_equal(at, fw_effects_hinge_model_text((fw_effects_hinge_model)named++));
    }
    assert_int_equal(named, fw_effects_hinge_model_count());
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(command_line_page),
        cmocka_unit_test(diagnostics_page),
        cmocka_unit_test(catalogue),
        cmocka_unit_test(every_command_is_complete),
        cmocka_unit_test(public_header_names_the_hinge_models),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
