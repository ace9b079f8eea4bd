/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which check a verdict rests on: the worst decision first, then the largest share used; as made
   where a flow was judged so. */
#include "verdict/verdict.h"
#include "verdict/verdict_parts.h"
#include "test.h"
#include <math.h>

static fw_verdict_hinge_verdict hinge(const char *id, double used, fw_verdict_decision decision) {
    return (fw_verdict_hinge_verdict){.id = id,
                                      .scene = "push",
                                      .utilisation = used,
                                      .utilisation_low = 0.9 * used,
                                      .utilisation_high = 1.1 * used,
                                      .t_s = 1e-3,
                                      .decision = decision};
}

typedef struct example {
    fw_arena *arena;
    fw_mechanism_variant flow[2];
    fw_verdict_hinge_verdict drawn[2][2], corner[2][2];
    fw_verdict_fabricated_corner at[2];
    fw_verdict_fabricated_hinge bound[2];
    fw_verdict_fabricated_verdict made;
    fw_verdict_variant_verdict variant[2];
    fw_verdict verdict;
} example;

/* flow "one" is judged as made, at two corners; flow "two" as drawn only */
static example *example_new(void) {
    fw_arena *arena = fw_arena_new(0);
    example *e = fw_arena_one(arena, example);
    *e = (example){.arena = arena,
                   .flow = {{.flow = "one"}, {.flow = "two"}},
                   .drawn = {{hinge("A", 0.5, FW_ACCEPT), hinge("B", 0.6, FW_ACCEPT)},
                             {hinge("A", 0.4, FW_ACCEPT), hinge("B", 0.3, FW_ACCEPT)}},
                   .corner = {{hinge("A", 0.5, FW_ACCEPT), hinge("B", 0.6, FW_ACCEPT)},
                              {hinge("A", 0.8, FW_ACCEPT), hinge("B", 0.7, FW_ACCEPT)}},
                   .at = {{.what = "nominal"}, {.what = "thickness 49 um"}},
                   .bound = {{.most = 0.8}, {.most = 0.95}}};
    for (int i = 0; i < 2; i++) {
        e->at[i].hinge = e->corner[i];
        e->variant[i] =
            (fw_verdict_variant_verdict){.variant = &e->flow[i], .hinge = e->drawn[i], .nhinge = 2};
    }
    e->made = (fw_verdict_fabricated_verdict){.corner = e->at, .ncorner = 2, .hinge = e->bound};
    e->variant[0].fabricated = &e->made;
    e->verdict = (fw_verdict){.variant = e->variant, .nvariant = 2};
    return e;
}

static void the_largest_share_of_every_flow_and_corner(void **state) {
    (void)state;
    example *e = example_new();
    fw_verdict_check check;
    bool found;
    assert_int_equal(
        fw_verdict_governing(e->arena, &e->verdict, FW_CHECK_HINGES, false, &check, &found), FW_OK);
    assert_true(found);
    assert_string_equal(check.what, "hinge B");
    assert_true(check.used == 0.6 && check.corner == NULL && isnan(check.most));
    assert_int_equal(
        fw_verdict_governing(e->arena, &e->verdict, FW_CHECK_HINGES, true, &check, &found), FW_OK);
    assert_string_equal(check.what, "hinge A");
    assert_string_equal(check.corner, "thickness 49 um");
    assert_string_equal(check.flow, "one");
    assert_true(check.most == 0.95); /* which no corner exceeds, of whichever hinge */
    fw_arena_free(e->arena);
}

static void a_worse_decision_goes_before_a_larger_share(void **state) {
    (void)state;
    example *e = example_new();
    fw_verdict_check check;
    bool found;
    e->drawn[1][1] = hinge("B", 0.55, FW_INCONCLUSIVE);
    assert_int_equal(
        fw_verdict_governing(e->arena, &e->verdict, FW_CHECK_HINGES, true, &check, &found), FW_OK);
    assert_string_equal(check.flow, "two"); /* which nobody judged as made */
    assert_null(check.corner);
    assert_int_equal(check.decision, FW_INCONCLUSIVE);
    fw_arena_free(e->arena);
}

static void nothing_that_was_run_governs_nothing(void **state) {
    (void)state;
    example *e = example_new();
    fw_verdict_check check;
    bool found = true;
    e->variant[0].fabricated = NULL;
    for (int i = 0; i < 4; i++)
        e->drawn[i / 2][i % 2].scene = NULL;
    assert_int_equal(
        fw_verdict_governing(e->arena, &e->verdict, FW_CHECK_HINGES, true, &check, &found), FW_OK);
    assert_false(found);
    fw_arena_free(e->arena);
}

static void a_requirement_governs_where_less_is_left_of_it(void **state) {
    (void)state;
    example *e = example_new();
    fw_verdict_check check;
    bool found;
    fw_verdict_requirement asked[2] = {{.probe = "grip",
                                        .measure = "final",
                                        .unit = "N",
                                        .scene = "push",
                                        .min = 1,
                                        .max = (double)NAN,
                                        .value = 1.1,
                                        .low = 1.05,
                                        .high = 1.15,
                                        .utilisation = 1 / 1.1,
                                        .decision = FW_ACCEPT},
                                       {.probe = "tilt",
                                        .measure = "final",
                                        .unit = "rad",
                                        .min = (double)NAN,
                                        .max = 0,
                                        .value = -1,
                                        .low = -1,
                                        .high = -1,
                                        .utilisation = (double)NAN,
                                        .decision = FW_ACCEPT}};
    e->variant[0].requirement = asked;
    e->variant[0].nrequirement = 2;
    const int all = FW_CHECK_HINGES | FW_CHECK_REQUIREMENTS;
    assert_int_equal(fw_verdict_governing(e->arena, &e->verdict, all, false, &check, &found),
                     FW_OK);
    assert_true(check.requirement == &asked[0] && !check.hinge);
    assert_string_equal(check.what, "requirement grip (final)");
    assert_int_equal(
        fw_verdict_governing(e->arena, &e->verdict, FW_CHECK_HINGES, false, &check, &found), FW_OK);
    assert_true(check.hinge && !check.requirement);
    asked[1].decision = FW_INCONCLUSIVE; /* a bound of 0 has no share, but a decision */
    assert_int_equal(fw_verdict_governing(e->arena, &e->verdict, all, false, &check, &found),
                     FW_OK);
    assert_true(check.requirement == &asked[1]);
    fw_arena_free(e->arena);
}

/* Two flows that miss one bound by values of their own: each says which flow it is of. Where both say
   the same it is said once, of no flow; a sentence that names its flow is left as it is. */
static void a_reason_names_the_flow_that_it_is_of(void **state) {
    (void)state;
    example *e = example_new();
    const fw_verdict_reason slow = {.scene = "push",
                                    .flow = "one",
                                    .number = 330,
                                    .decision = FW_REJECT,
                                    .text = "tip is 1 um, and at least 9 um is required"};
    const fw_verdict_reason both = {.number = 204, .decision = FW_REJECT, .text = "jaws meet"};
    const fw_verdict_reason self = {
        .number = 237, .decision = FW_REJECT, .text = "in flow one it breaks"};
    fw_verdict_reason one[4] = {slow, both, self, slow}, two[2] = {slow, both};
    const char **text;
    int n;
    one[3].scene = fw_verdict_at_rest;
    one[1].scene = "push"; /* it is the same in every scene */
    two[0].flow = "two", two[0].text = "tip is 2 um, and at least 9 um is required";
    e->variant[0].reason = one, e->variant[0].nreason = 4;
    e->variant[1].reason = two, e->variant[1].nreason = 2;
    assert_int_equal(fw_verdict_rejections(e->arena, &e->verdict, &text, &n), FW_OK);
    assert_int_equal(n, 5);
    assert_string_equal(text[0],
                        "tip is 1 um, and at least 9 um is required in push, flow one [FW-D330]");
    assert_string_equal(text[1], "jaws meet [FW-D204]");
    assert_string_equal(text[2], "in flow one it breaks [FW-D237]");
    assert_string_equal(text[3], "tip is 1 um, and at least 9 um is required, flow one [FW-D330]");
    assert_string_equal(text[4],
                        "tip is 2 um, and at least 9 um is required in push, flow two [FW-D330]");
    two[0] = slow; /* of both alike, beside other numbers */
    assert_int_equal(fw_verdict_rejections(e->arena, &e->verdict, &text, &n), FW_OK);
    assert_int_equal(n, 4);
    assert_string_equal(text[0], "tip is 1 um, and at least 9 um is required in push [FW-D330]");
    fw_arena_free(e->arena);
}

/* rows of factors, of the hinges and of what bends besides: the most up and the least down, and never less than 1 */
static void a_requirement_goes_by_the_largest_factor(void **state) {
    (void)state;
    const double factor[] = {1.1, 0.95, 1.3, 0.9, 1.2, 0.7}, small[] = {0.9, 1.2};
    double most[2];
    fw_verdict_requirement_factor(factor, 2, most);
    assert_true(most[0] == 1.3 && most[1] == 0.7);
    fw_verdict_requirement_factor(factor, 1, most);
    assert_true(most[0] == 1.3 && most[1] == 0.9);
    fw_verdict_requirement_factor(small, 0, most);
    assert_true(most[0] == 1 && most[1] == 1);
}

/* a factor of millions is what is left of a zero, but where forces are off by so much that it may tip all the same */
static void what_is_left_of_no_force_tips_nothing(void **state) {
    (void)state;
    fw_verdict_across a = {.tips = 4.805e7, .tips_error = 62};
    assert_false(fw_verdict_across_tips(&a));
    a.tips_error = 1e6;
    assert_true(fw_verdict_across_tips(&a));
    a.tips = 2e5, a.tips_error = 1e-3;
    assert_true(fw_verdict_across_tips(&a));
    a.tips = HUGE_VAL;
    assert_false(fw_verdict_across_tips(&a));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_left_of_no_force_tips_nothing),
        cmocka_unit_test(a_requirement_goes_by_the_largest_factor),
        cmocka_unit_test(the_largest_share_of_every_flow_and_corner),
        cmocka_unit_test(a_worse_decision_goes_before_a_larger_share),
        cmocka_unit_test(nothing_that_was_run_governs_nothing),
        cmocka_unit_test(a_requirement_governs_where_less_is_left_of_it),
        cmocka_unit_test(a_reason_names_the_flow_that_it_is_of)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
