/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laboratory's layer numbers: what they change, and where mistakes are told. */
#include "base/output.h"
#include "mask/mask_parts.h"
#include "test.h"

static fw_status apply(fw_arena *arena, fw_diags *diags, const char *text, fw_mask_table *t) {
    char path[512], *xml;
    size_t n;
    fw_mask_layer_map map;
    snprintf(path, sizeof path, "%s/masks/al-masked-rie.xml", FW_TEST_SOURCE_DIR);
    assert_int_equal(fw_input_read(arena, path, 1 << 20, diags, &xml, &n), FW_OK);
    assert_int_equal(fw_mask_table_read(arena, path, xml, n, diags, t), FW_OK);
    fw_status status = fw_mask_layer_map_read(arena, "l.txt", text, strlen(text), diags, &map);
    if (status == FW_OK) status = fw_mask_layer_map_apply(arena, &map, t, diags);
    const fw_mask_table *tables[] = {t};
    if (status == FW_OK) status = fw_mask_layer_map_finish(arena, &map, tables, 1, diags);
    return status;
}

static void numbers_and_names(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_mask_table t;
    /* two layers change places */
    assert_int_equal(apply(arena, &diags,
                           "# ours\nstructure 2/0 name POLY2 # and so on\r\ntext 1/0\nplate 10/1\n"
                           "flow al-masked-rie\nnotes 65535/0\n",
                           &t),
                     FW_OK);
    assert_int_equal(t.layer[0].layer, 2);
    assert_string_equal(t.layer[0].name, "POLY2");
    assert_string_equal(t.plate, "2/0 NOT 1/0 NOT 3/0");
    assert_non_null(strstr(t.order, "65535/0 are not on the plate"));
    assert_true(t.written_numbered && t.written_layer == 10 && t.written_datatype == 1);
    assert_int_equal(diags.item[0].number, 383); /* 65535 */
    fw_arena_free(arena);
}

static void mistakes(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int number, line, column;
    } wrong[] = {{"structure 7/0\nlane 65536/0\n", 380, 2, 6},
                 {"structure 7\n", 380, 1, 11},
                 {"structure 7/0 name\n", 380, 1, 15},
                 {"structure\n", 380, 1, 1},
                 {"", 380, 1, 1},
                 {"structure 7/0\nstructure 8/0\n", 380, 2, 1},
                 {"structure 7/0\ndevice 8/0\n", 382, 2, 1},
                 {"structure 2/0\n", 382, 1, 11},
                 {"text 7/0 name al_mask\n", 382, 1, 15},
                 {"strukture 7/0\n", 381, 1, 1},
                 {"flow\n", 380, 1, 1}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_mask_table t;
        assert_int_equal(apply(arena, &diags, wrong[i].text, &t), FW_INPUT);
        const fw_diag *d = &diags.item[0];
        if (d->number != wrong[i].number || d->place.line != wrong[i].line ||
            d->place.column != wrong[i].column)
            fail_msg("%s: FW-D%d at %d:%d", wrong[i].text, d->number, d->place.line,
                     d->place.column);
        fw_arena_free(arena);
    }
}

/* a message has what was written, in UTF-8, and no byte that is none */
static void what_was_written_is_shown(void **state) {
    (void)state;
    static const struct {
        const char *text, *shown;
    } row[] = {{"structure 7/0 name POLY_\xc3\x84\n", "\"POLY_\xc3\x84\""},
               {"structure 7/0 name P\xff\n", "\"P\xef\xbf\xbd\""}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_mask_table t;
        assert_int_equal(apply(arena, &diags, row[i].text, &t), FW_INPUT);
        if (!strstr(diags.item[0].message, row[i].shown)) fail_msg("%s", diags.item[0].message);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_and_names),
                                       cmocka_unit_test(mistakes),
                                       cmocka_unit_test(what_was_written_is_shown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
