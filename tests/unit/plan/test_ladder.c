/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinges climb the ladder once for all that are alike, and alike are only those of the same shape. */
#include "plan/plan.h"
#include "test.h"
#include <string.h>

/* two hinges of the flexures "one" and "other" */
static const char device[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"pair\">"
    "<material ref=\"silicon-100\" youngs-modulus=\"150 GPa\" strength=\"500 MPa\" "
    "thickness=\"50 um\"/>"
    "%s%s<mechanism>"
    "<body id=\"first\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"0 mm\" y=\"0.75 mm\"/>"
    "<body id=\"second\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"2 mm\" y=\"0.75 mm\"/>"
    "<revolute id=\"A\" a=\"ground\" b=\"first\" b-y=\"-0.75 mm\" hinge=\"one\"/>"
    "<revolute id=\"B\" a=\"ground\" a-x=\"2 mm\" b=\"second\" b-y=\"-0.75 mm\" hinge=\"other\"/>"
    "</mechanism>"
    "<scene name=\"turn\" duration=\"10 ms\"><torque on=\"first\" value=\"50 uN mm\"/></scene>"
    "</device>";

#define LEAF(id_, middle_)                                                                         \
    "<flexure id=\"" id_ "\" kind=\"leaf\" length=\"400 um\" width=\"12 um\" " middle_             \
    "fillet=\"6 um\" gap=\"8 um\"/>"
#define PATH(id_, middle_)                                                                         \
    "<flexure id=\"" id_                                                                           \
    "\" kind=\"path\" width=\"12 um\" fillet=\"6 um\"><line length=\"200 um\" " middle_            \
    "/><line length=\"200 um\"/></flexure>"

/* is the second hinge solved by itself, with another stiffness than the first? */
static void climb(const char *one, const char *other, bool by_itself) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    fw_plan *plan = fw_plan_new(&o);
    fw_plan_ladders all;
    assert_non_null(plan);
    const char *xml = fw_arena_printf(plan->arena, device, one, other);
    if (fw_plan_load_memory(plan, "pair.xml", xml, strlen(xml)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    if (fw_plan_ladders_run(plan, FW_LADDER_ONCE, &all) != FW_OK)
        fail_msg("%s", plan->diags.item[plan->diags.count - 1].message);
    assert_int_equal(all.count, 2);
    assert_int_equal(all.item[0].shared, -1);
    assert_int_equal(all.item[1].shared, by_itself ? -1 : 0);
    assert_int_equal(all.item[0].rows, all.item[1].rows);
    for (int i = 0; i < all.item[0].rows; i++) {
        const fw_report_level *a = &all.item[0].row[i], *b = &all.item[1].row[i];
        assert_int_equal(a->state, FW_LEVEL_SOLVED);
        assert_int_equal(b->state, FW_LEVEL_SOLVED);
        assert_true(by_itself == (a->stiffness_Nm_per_rad != b->stiffness_Nm_per_rad));
    }
    fw_plan_free(plan);
}

static void equal_hinges_are_solved_once(void **state) {
    (void)state;
    climb(LEAF("one", ""), LEAF("other", ""), false);
    climb(LEAF("one", "width-middle=\"6 um\" "), LEAF("other", "width-middle=\"6 um\" "), false);
    climb(PATH("one", ""), PATH("other", ""), false);
}

static void another_width_in_the_middle_is_another_hinge(void **state) {
    (void)state;
    climb(LEAF("one", ""), LEAF("other", "width-middle=\"6 um\" "), true);
    climb(LEAF("one", "width-middle=\"8 um\" "), LEAF("other", "width-middle=\"6 um\" "), true);
    climb(PATH("one", ""), PATH("other", "width-middle=\"8 um\""), true);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_hinges_are_solved_once),
        cmocka_unit_test(another_width_in_the_middle_is_another_hinge)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
