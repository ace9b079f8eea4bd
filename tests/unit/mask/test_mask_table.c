/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output.h"
#include "mask/mask.h"
#include "test.h"

static const fw_mask_layer *layer_of(const fw_mask_table *t, fw_layout_role role) {
    for (int k = 0; k < t->nlayer; k++)
        if (t->layer[k].roles & 1u << role) return &t->layer[k];
    return NULL;
}

static void shipped_table(const char *flow, const char *tone, const char *text_tone) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    char path[512], *xml;
    size_t n;
    snprintf(path, sizeof path, "%s/masks/%s.xml", FW_TEST_SOURCE_DIR, flow);
    assert_int_equal(fw_input_read(arena, path, 1 << 20, &diags, &xml, &n), FW_OK);
    fw_mask_table t;
    fw_status status = fw_mask_table_read(arena, path, xml, n, &diags, &t);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no message");
    assert_string_equal(t.flow, flow);
    assert_string_equal(t.reading, "right-reading chrome down");
    unsigned all = 0;
    int notes = 0;
    for (int k = 0; k < t.nlayer; k++) {
        all |= t.layer[k].roles;
        notes += t.layer[k].documentation;
        assert_true(strlen(t.layer[k].name) <= 8); /* some mask shops take no more */
        assert_true(t.layer[k].biased == (t.layer[k].id == layer_of(&t, FW_ROLE_FLEXURE)->id));
        if (t.layer[k].roles) {
            assert_near(t.layer[k].min_width_m, 4e-6, 1e-18);
            assert_near(t.layer[k].min_space_m, 4e-6, 1e-18);
            assert_non_null(t.layer[k].rule_source);
        }
    }
    /* the lane is for the saw: who orders the plate must not add it to a biased frame */
    assert_non_null(strstr(layer_of(&t, FW_ROLE_DICING)->purpose, "not on the plate"));
    assert_non_null(strstr(t.order, "plate = 1/0 NOT 2/0 NOT 3/0"));
    assert_non_null(strstr(t.order, "4/0 and 63/0 are not on the plate"));
    assert_true(strlen(t.order) < 200 && layer_of(&t, FW_ROLE_DICING)->layer == 4);
    /* all of a drawing; what further plates draw these flows do not have */
    assert_int_equal(all, (1u << FW_ROLE_CAVITY) - 1);
    assert_int_equal(notes, 1);
    assert_string_equal(layer_of(&t, FW_ROLE_STRUCTURE)->tone, tone);
    assert_string_equal(layer_of(&t, FW_ROLE_TEXT)->tone, text_tone);
    assert_ptr_not_equal(layer_of(&t, FW_ROLE_STRUCTURE), layer_of(&t, FW_ROLE_TEXT));
    fw_arena_free(arena);
}

static void copper(void **state) {
    (void)state;
    shipped_table("copper-on-porous-silicon", "data clear", "data dark");
}

static void silicon(void **state) {
    (void)state;
    shipped_table("al-masked-rie", "data dark", "data clear");
}

#define HEAD "<mask-table xmlns=\"urn:flexwright:masks:1\" flow=\"f\" reading=\"r\">\n"
#define GOOD "id=\"a\" name=\"A\" purpose=\"p\" tone=\"data dark\" colour=\"#000000\""

/* one mistake each: number, line and column of the report */
static const struct {
    const char *xml;
    int number, line, column;
} wrong[] = {
    {"<other/>", 140, 1, 1},
    {"<mask-table flow=\"f\" reading=\"r\"/>", 140, 1, 1},
    {HEAD "</mask-table>", 140, 1, 1},
    {HEAD "<layer gds=\"1/0\" " GOOD "/><lair/></mask-table>", 140, 2, 81},
    {HEAD "<layer gds=\"65536/0\" " GOOD "/></mask-table>", 141, 2, 13},
    {HEAD "<layer gds=\"1/65536\" " GOOD "/></mask-table>", 141, 2, 13},
    {HEAD "<layer gds=\"1\" " GOOD "/></mask-table>", 141, 2, 13},
    {HEAD "<layer gds=\"1/0x\" " GOOD "/></mask-table>", 141, 2, 13},
    {HEAD "<layer gds=\"-1/0\" " GOOD "/></mask-table>", 141, 2, 13},
    {HEAD "<layer gds=\"99999999999999999999/0\" " GOOD "/></mask-table>", 141, 2, 13},
    {HEAD "<layer " GOOD "/></mask-table>", 140, 2, 1},
    {HEAD "<layer gds=\"1/0\" min-widht=\"1 um\" " GOOD "/></mask-table>", 140, 2, 29},
    {HEAD "<layer gds=\"1/0\" roles=\"structure links\" " GOOD "/></mask-table>", 141, 2, 25},
    {HEAD "<layer gds=\"1/0\" biased=\"maybe\" " GOOD "/></mask-table>", 141, 2, 26},
    {HEAD "<layer gds=\"1/0\" min-width=\"4 um\" " GOOD "/></mask-table>", 140, 2, 1},
    {HEAD "<layer gds=\"1/0\" source=\"s\" min-width=\"-4 um\" " GOOD "/></mask-table>", 141, 2,
     40},
    {HEAD "<layer gds=\"1/0\" documentation=\"yes\" roles=\"text\" " GOOD "/></mask-table>", 141, 2,
     1},
    {HEAD "<layer gds=\"1/0\" " GOOD "/>\n <layer gds=\"2/0\" " GOOD "/></mask-table>", 142, 3, 2},
    {HEAD "<layer gds=\"1/0\" " GOOD "/>\n <layer gds=\"1/0\" id=\"b\" name=\"B\" purpose=\"p\" "
          "tone=\"data dark\" colour=\"#000000\"/></mask-table>",
     142, 3, 2},
    {HEAD "<layer gds=\"1/0\" roles=\"text\" " GOOD "/>\n <layer gds=\"2/0\" roles=\"text mark\" "
          "id=\"b\" name=\"B\" purpose=\"p\" tone=\"data dark\" colour=\"#000000\"/></mask-table>",
     142, 3, 2},
    {HEAD "<layer gds=\"1/0\" id=\"a b\" name=\"A\" purpose=\"p\" tone=\"data dark\" "
          "colour=\"#000000\"/></mask-table>",
     141, 2, 22},
    {HEAD "<layer gds=\"1/0\" id=\"a\" name=\"A\" purpose=\"\xc2\xb5\" tone=\"data dark\" "
          "colour=\"#000000\"/></mask-table>",
     141, 2, 43},
    {HEAD "<layer gds=\"1/0\" id=\"a\" name=\"A\" purpose=\"p\" tone=\"clear field\" "
          "colour=\"#000000\"/></mask-table>",
     141, 2, 52},
    {HEAD "<layer gds=\"1/0\" id=\"a\" name=\"A\" purpose=\"p\" tone=\"data dark\" "
          "colour=\"black\"/></mask-table>",
     141, 2, 71},
};

static void mistakes_have_their_place(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_mask_table t;
        fw_status status =
            fw_mask_table_read(arena, "t.xml", wrong[i].xml, strlen(wrong[i].xml), &diags, &t);
        bool found = false;
        for (size_t k = 0; k < diags.count; k++)
            found = found || (diags.item[k].number == wrong[i].number &&
                              diags.item[k].place.line == wrong[i].line &&
                              diags.item[k].place.column == wrong[i].column);
        if (status != FW_INPUT || !found)
            fail_msg("case %zu: status %d, first D%03d at %d:%d: %s", i, (int)status,
                     diags.count ? diags.item[0].number : 0,
                     diags.count ? diags.item[0].place.line : 0,
                     diags.count ? diags.item[0].place.column : 0,
                     diags.count ? diags.item[0].message : "none");
        fw_arena_free(arena);
    }
}

static void wrong_unit_is_told_inside_the_value(void **state) {
    (void)state;
    static const char xml[] =
        HEAD "<layer gds=\"1/0\" source=\"s\" min-space=\"4 kg\" " GOOD "/></mask-table>";
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_mask_table t;
    assert_int_equal(fw_mask_table_read(arena, "t.xml", xml, strlen(xml), &diags, &t), FW_INPUT);
    assert_int_equal(diags.count, 1);
    assert_in_range(diags.item[0].number, 20, 39);
    assert_int_equal(diags.item[0].place.line, 2);
    assert_true(diags.item[0].place.column >= 40);
    fw_arena_free(arena);
}

static void all_mistakes_in_one_run(void **state) {
    (void)state;
    static const char xml[] = HEAD "<layer gds=\"0/x\" tone=\"x\" colour=\"y\" roles=\"z\"/>"
                                   "<layer wrong=\"1\"/></mask-table>";
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_mask_table t;
    assert_int_equal(fw_mask_table_read(arena, "t.xml", xml, strlen(xml), &diags, &t), FW_INPUT);
    assert_true(diags.errors >= 4 + 3 + 1 + 6);
    fw_arena_free(arena);
}

static void short_memory(void **state) {
    (void)state;
    static const char xml[] =
        HEAD "<layer gds=\"1/0\" source=\"s\" min-space=\"4 um\" " GOOD "/></mask-table>";
    fw_status status = FW_NOMEM;
    for (long at = 1; status != FW_OK && at < 500; at++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_mask_table t;
        fw_arena_fail_at(at, 1);
        status = fw_mask_table_read(arena, "t.xml", xml, strlen(xml), &diags, &t);
        fw_arena_fail_at(0, 0);
        assert_true(status == FW_OK || status == FW_NOMEM);
        fw_arena_free(arena);
    }
    assert_int_equal(status, FW_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copper),
        cmocka_unit_test(silicon),
        cmocka_unit_test(mistakes_have_their_place),
        cmocka_unit_test(wrong_unit_is_told_inside_the_value),
        cmocka_unit_test(all_mistakes_in_one_run),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
