/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of flows that print several plates, and what these draw besides the device. */
#include "base/json.h"
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "test.h"
#include <math.h>
#include <string.h>

#define UM 1e-6
#define LAYER(gds, id, more)                                                                       \
    "<layer gds=\"" gds "\" id=\"" id "\" name=\"" id                                              \
    "\" purpose=\"p\" tone=\"data dark\" colour=\"#000000\" " more "/>\n"
#define LAYERS                                                                                     \
    LAYER("1/0", "device", "roles=\"structure flexure frame tether\" biased=\"yes\"")              \
    LAYER("6/0", "cavity", "roles=\"cavity\" shrink=\"cavity.d\"")                                 \
    LAYER("7/0", "land", "roles=\"land\" grow=\"cavity.d\"")                                       \
    LAYER("8/0", "metal", "roles=\"metal\"")
#define FIRST                                                                                      \
    "<plate id=\"cavity\" title=\"cavities\" layers=\"6/0 NOT 7/0\" reading=\"right-reading "      \
    "chrome down\"/>\n"
#define SECOND                                                                                     \
    "<plate id=\"pads\" title=\"pads\" layers=\"8/0\" reading=\"right-reading chrome down\" "      \
    "aligned-to=\"cavity\" marks=\"back\" overlay=\"3 um\"/>\n"
#define THIRD                                                                                      \
    "<plate id=\"device\" title=\"device\" layers=\"1/0\" reading=\"right-reading chrome down\" "  \
    "aligned-to=\"pads\" overlay=\"2 um\"/>\n"
#define CONTENTS                                                                                   \
    "<content kind=\"cavity\" margin=\"40 um\" source=\"s\"/>\n"                                   \
    "<content kind=\"pad-metal\" source=\"s\"/>\n"

static fw_arena *arena;
static fw_diags diags;
static fw_mask_table table;

static int set_up(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int tear_down(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_status table_of(const char *root, const char *rows) {
    char *xml = fw_arena_printf(
        arena, "<mask-table xmlns=\"urn:flexwright:masks:1\" flow=\"f\"%s>\n%s</mask-table>\n",
        root, rows);
    diags = fw_diags_new(arena);
    return fw_mask_table_read(arena, "t.xml", xml, strlen(xml), &diags, &table);
}

static void several(void **state) {
    (void)state;
    assert_int_equal(table_of("", LAYERS FIRST SECOND THIRD), FW_OK);
    assert_int_equal(fw_mask_plates(&table), 3);
    assert_int_equal(table.device_plate, 2);
    assert_string_equal(table.plate, "1/0");
    assert_int_equal(fw_mask_plate_named(&table, "pads"), 1);
    assert_int_equal(fw_mask_plate_named(&table, "other"), -1);
    assert_true(fw_mask_plate_at(&table, 1).back && !fw_mask_plate_at(&table, 2).back);
    fw_mask_plate_term *term;
    int n;
    assert_int_equal(fw_mask_plate_terms_of(arena, &table, 0, &term, &n), FW_OK);
    assert_int_equal(n, 2);
    assert_int_equal(term[1].rule, FW_SET_NOT);
    /* budgets add up from plate to plate */
    assert_near(fw_mask_overlay_m(&table, FW_ROLE_METAL), 2 * UM, 1e-12);
    assert_near(fw_mask_overlay_m(&table, FW_ROLE_CAVITY), 5 * UM, 1e-12);
    assert_near(fw_mask_overlay_between_m(&table, 0, 1), 3 * UM, 1e-12);
}

/* both put on the first: between them lie both budgets */
static void side_by_side(void **state) {
    (void)state;
    static const char own[] = "<plate id=\"device\" title=\"device\" layers=\"1/0\" reading=\"r\" "
                              "aligned-to=\"cavity\" overlay=\"2 um\"/>\n";
    char rows[4000];
    snprintf(rows, sizeof rows, "%s%s%s%s", LAYERS, FIRST, SECOND, own);
    assert_int_equal(table_of("", rows), FW_OK);
    assert_near(fw_mask_overlay_m(&table, FW_ROLE_METAL), 5 * UM, 1e-12);
    assert_near(fw_mask_overlay_m(&table, FW_ROLE_CAVITY), 2 * UM, 1e-12);
}

static void one(void **state) {
    (void)state;
    assert_int_equal(table_of(" reading=\"r\" plate=\"1/0\"", LAYERS), FW_OK);
    assert_int_equal(fw_mask_plates(&table), 1);
    assert_string_equal(fw_mask_plate_at(&table, 0).id, "device");
    assert_string_equal(fw_mask_plate_at(&table, 0).layers, "1/0");
    assert_near(fw_mask_overlay_m(&table, FW_ROLE_METAL), 0.0, 0.0);
}

static void mistakes(void **state) {
    (void)state;
    const struct {
        const char *root, *rows, *says;
    } row[] = {
        {"", LAYERS, "needs the attribute reading"},
        {" plate=\"1/0\"", LAYERS FIRST THIRD, "plate is of a table with one plate"},
        {"", LAYERS FIRST THIRD, "is aligned to \"pads\", which no row above it is"},
        {"", LAYERS FIRST FIRST SECOND THIRD, "two plates have the id \"cavity\""},
        {"", LAYERS FIRST SECOND, "0 of 2 plates print the layer with the role \"structure\""},
        {"", LAYERS "<plate id=\"a\" title=\"t\" layers=\"9/0\" reading=\"r\"/>\n",
         "layers=\"9/0\" cannot be read"},
        {"", LAYERS FIRST "<plate id=\"device\" title=\"t\" layers=\"1/0\" reading=\"r\"/>\n",
         "is not the first that is printed"},
        {" reading=\"r\"", LAYERS "<content kind=\"moat\" source=\"s\"/>\n",
         "<content> needs a kind; there are: cavity pad-metal"},
        {" reading=\"r\"", LAYERS "<content kind=\"cavity\" source=\"s\"/>\n", "margin"},
        {" reading=\"r\"",
         LAYERS "<layer gds=\"9/0\" id=\"x\" name=\"x\" purpose=\"p\" tone=\"data dark\" "
                "colour=\"#000000\" biased=\"yes\" shrink=\"a\"/>\n",
         "a layer takes one of biased, shrink and grow"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        bool said = false;
        assert_int_equal(table_of(row[i].root, row[i].rows), FW_INPUT);
        for (size_t k = 0; k < diags.count; k++)
            said = said || strstr(diags.item[k].message, row[i].says);
        if (!said) fail_msg("%s: %s", row[i].says, diags.item[0].message);
    }
}

static void put(fw_layout *l, fw_layout_role role, int body, const char *label, double x0,
                double y0, double x1, double y1) {
    fw_layout_piece *p = &l->piece[l->npiece++];
    *p = (fw_layout_piece){.role = role, .body = body, .joint = FW_NONE, .label = label};
    fw_geometry_box b = {x0 * UM, y0 * UM, x1 * UM, y1 * UM};
    assert_int_equal(fw_geometry_contour_rectangle(arena, b, &p->contour), FW_OK);
}

static fw_layout drawing(double pad) {
    fw_layout l = {.drawn = true, .piece = fw_arena_array(arena, fw_layout_piece, 20)};
    l.die = (fw_geometry_box){-800 * UM, -800 * UM, 800 * UM, 800 * UM};
    put(&l, FW_ROLE_STRUCTURE, 0, "stage", -200, -50, 200, 50);
    put(&l, FW_ROLE_STRUCTURE, FW_GROUND, "base", -700, -700, 700, -400);
    put(&l, FW_ROLE_STRUCTURE, FW_ISLAND, "stator", -pad, 300, pad, 300 + 2 * pad);
    return l;
}

static int count(const fw_layout *l, fw_layout_role role) {
    int n = 0;
    for (int i = 0; i < l->npiece; i++)
        n += l->piece[i].role == role;
    return n;
}

/* a hollow below the stage, printed smaller by what its etch takes sideways; metal on base and stator */
static void contents(void **state) {
    (void)state;
    assert_int_equal(table_of("", LAYERS FIRST SECOND THIRD CONTENTS), FW_OK);
    fw_layout l = drawing(75);
    const fw_layout *with;
    fw_mask_verdict verdict;
    assert_int_equal(fw_mask_contents_add(arena, &table, &l, &with), FW_OK);
    assert_int_equal(count(with, FW_ROLE_CAVITY), 1);
    assert_int_equal(count(with, FW_ROLE_METAL), 2);
    assert_int_equal(count(with, FW_ROLE_STRUCTURE), 3);
    assert_int_equal(fw_mask_contents_judge(arena, &table, &l, &verdict), FW_OK);
    assert_int_equal(verdict.n, 0);
    double bias[] = {0, -20 * UM, 20 * UM, 0};
    fw_mask_options options = {.layer_bias_m = bias};
    const fw_mask *mask;
    diags = fw_diags_new(arena);
    assert_int_equal(fw_mask_build(arena, with, &table, "d", &options, &diags, &mask), FW_OK);
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        fw_geometry_box drawn = fw_geometry_contour_box(&s->piece->contour);
        assert_near(s->box.x0 - drawn.x0, s->layer == 1 ? 20 * UM : 0.0, 1e-12);
    }
    /* an order sheet for each plate, which says to what it is aligned */
    fw_text text = fw_text_new(arena);
    assert_int_equal(fw_mask_write_order_text(mask, 1, NULL, 0, &text), FW_OK);
    assert_non_null(strstr(text.data, "2 of 3 of this flow, \"pads\": pads"));
    assert_non_null(
        strstr(text.data,
               "to the marks of plate \"cavity\", seen from the back of the wafer, within 3 um"));
    assert_non_null(strstr(text.data, "0 um per edge of 8/0, in the data already"));
    fw_text cavity = fw_text_new(arena);
    assert_int_equal(fw_mask_write_order_text(mask, 0, NULL, 0, &cavity), FW_OK);
    assert_non_null(strstr(cavity.data, "-20 um per edge of 6/0, 20 um of 7/0, in the data"));
    assert_near(fw_mask_plate_bias_m(mask, 0), -20 * UM, 1e-15);
    assert_near(verdict.widest_hollow_m, 190 * UM, 11 * UM); /* 100 and both margins, on a grid */
    assert_near(fw_mask_content_m(&table, "cavity", "margin"), 40 * UM, 1e-15);
    assert_true(isnan(fw_mask_content_m(&table, "moat", "margin")));
    assert_int_equal(fw_mask_plate_of_role(&table, FW_ROLE_METAL), 1);
    assert_int_equal(fw_mask_plate_of_role(&table, FW_ROLE_BACK), -1);
    fw_text json = fw_text_new(arena);
    assert_int_equal(fw_mask_write_order(mask, 0, NULL, 0, &json), FW_OK);
    assert_non_null(strstr(json.data, "\"plate_of_set\": {"));
    assert_non_null(strstr(json.data, "\"plate\": \"6/0 NOT 7/0\""));
}

static void what_is_not_held(void **state) {
    (void)state;
    assert_int_equal(table_of("", LAYERS FIRST SECOND THIRD CONTENTS), FW_OK);
    fw_layout l = drawing(40);
    put(&l, FW_ROLE_STRUCTURE, 1, "link", -300, 150, 300, 170);
    fw_mask_verdict verdict;
    assert_int_equal(fw_mask_contents_judge(arena, &table, &l, &verdict), FW_OK);
    assert_int_equal(verdict.n, 2);
    assert_non_null(strstr(verdict.reason[0], "stator is bonded to the carrier on a square of"));
    assert_non_null(strstr(verdict.reason[0], "needs one of 90 um"));
    assert_non_null(strstr(verdict.reason[1], "stator has no room for the metal of a bond pad"));
    fw_layout none = {.drawn = false};
    assert_int_equal(fw_mask_contents_judge(arena, &table, &none, &verdict), FW_OK);
    assert_int_equal(verdict.n, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(several, set_up, tear_down),
        cmocka_unit_test_setup_teardown(side_by_side, set_up, tear_down),
        cmocka_unit_test_setup_teardown(one, set_up, tear_down),
        cmocka_unit_test_setup_teardown(mistakes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(contents, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_not_held, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
