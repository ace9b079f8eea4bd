/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smallest change of one parameter: what is said is run again from the text, as a user would.
 */
#include "plan/plan.h"
#include "test.h"
#include <math.h>

static const char head[] = "<device xmlns=\"urn:flexwright:device:1\" name=\"d\">%s<material "
                           "ref=\"silicon-100\" thickness=\"50 um\"/>%s";
/* an arm on one flexure, turned at once: U goes nearly with the torque, and nearly with 1/width^2
 */
static const char arm[] =
    "<flexure id=\"f\" kind=\"csfh\" radius=\"r\" angle=\"180 deg\" width=\"w\" gap=\"8 um\" "
    "fillet=\"4 um\"/><mechanism><body id=\"arm\" mass=\"0.02 mg\" inertia=\"0.003 mg mm^2\" "
    "x=\"0.5 mm\" y=\"0 mm\" width=\"100 um\"/><revolute id=\"h\" a=\"ground\" b=\"arm\" "
    "b-x=\"-0.5 mm\" hinge=\"f\" axis=\"180 deg\"/></mechanism><scene name=\"a\" duration=\"1 ms\">"
    "<torque on=\"arm\" value=\"%s\"/></scene></device>";

/* what a test does not ask about stays: no room, no looks */
static const char radius[] =
    "<parameter name=\"r\" value=\"100 um\" min=\"100 um\" max=\"100 um\"/>";
static const char free_width[] = "<parameter name=\"w\" value=\"8 um\" max=\"16 um\"/>";
static const char width[] = "<parameter name=\"w\" value=\"8 um\" min=\"8 um\" max=\"8 um\"/>";

static const char *text_of(fw_arena *arena, const char *parameters, bool wider, const char *flow,
                           const char *torque) {
    const char *all =
        fw_arena_printf(arena, "%s%s%s", radius, wider ? free_width : width, parameters);
    const char *a = fw_arena_printf(arena, head, all ? all : "", flow);
    const char *b = fw_arena_printf(arena, arm, torque);
    const char *text = fw_arena_printf(arena, "%s%s", a ? a : "", b ? b : "");
    assert_true(a && b && text);
    return text;
}

static fw_plan *judged(const char *text, const fw_device_set *set, bool advice) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.with_advice = advice;
    o.set = set;
    o.nset = set ? 1 : 0;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    if (fw_plan_load_memory(plan, "arm.xml", text, strlen(text)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    return plan;
}

static fw_verdict_decision decision(const char *text, const char *name, const char *value) {
    const fw_device_set set = {name, value};
    fw_plan *plan = judged(text, &set, false);
    fw_verdict_decision is = plan->verdict.decision;
    fw_plan_free(plan);
    return is;
}

static const fw_verdict_parameter_advice *of(const fw_plan *plan, const char *name) {
    for (int i = 0; i < plan->verdict.nparameter; i++)
        if (strcmp(plan->verdict.parameter[i].name, name) == 0) return &plan->verdict.parameter[i];
    fail_msg("nothing is said of %s", name);
    return NULL;
}

/* what is said accepts; with 2 % less of the change nothing does, but for the last digit */
static void check_smallest(const char *text, const fw_verdict_parameter_advice *p, const char *unit,
                           double factor) {
    char value[80];
    if (p->found != FW_PARAMETER_ACCEPTS) fail_msg("%s", p->text);
    assert_true(p->low <= p->to && p->to <= p->high);
    assert_int_equal(decision(text, p->name, p->value_text), FW_ACCEPT);
    double less = p->to - 0.02 * (p->to - p->from);
    snprintf(value, sizeof value, "%.9g%s", less / factor, unit);
    assert_int_not_equal(decision(text, p->name, value), FW_ACCEPT);
    assert_true(strlen(p->value_text) <= strlen(unit) + 7); /* as a person would type it */
}

static void in_order(const fw_plan *plan) {
    const fw_verdict *v = &plan->verdict;
    for (int i = 1; i < v->nparameter; i++) {
        assert_true(v->parameter[i - 1].found <= v->parameter[i].found);
        if (v->parameter[i].found == FW_PARAMETER_ACCEPTS)
            assert_true(v->parameter[i - 1].change <= v->parameter[i].change);
    }
}

static double random_part(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static void of_random_arms(void **state) {
    (void)state;
    uint64_t seed = 77;
    for (int k = 0; k < test_cases(3, 1); k++) {
        fw_arena *arena = fw_arena_new(0);
        double torque = 0.13 + 0.07 * random_part(&seed), share = 1 + 5 * random_part(&seed);
        const char *parameters = fw_arena_printf(
            arena,
            "<parameter name=\"t\" value=\"%.3f uN m\"/><parameter name=\"many\" value=\"%.2f\"/>",
            torque * (k % 2 ? -1 : 1), share);
        const char *value = fw_arena_printf(arena, "t*many/%.2f", share);
        const char *text = text_of(arena, parameters, true, "", value);
        fw_plan *plan = judged(text, NULL, true);
        const fw_verdict_hinge_verdict *h = &plan->verdict.hinge[0];
        const fw_verdict_parameter_advice *t = of(plan, "t"), *s = of(plan, "many");
        assert_int_equal(plan->verdict.decision, FW_REJECT);
        assert_int_equal(plan->verdict.nparameter, 4);
        check_smallest(text, t, " uN m", 1e-6);
        check_smallest(text, s, "", 1);
        check_smallest(text, of(plan, "w"), " um", 1e-6);
        /* the torque that is left: the limit's share, hinges that bend further being no more than
           this off the straight line */
        assert_near(t->to / t->from * h->utilisation_high, 1, 0.06);
        assert_near(s->to / s->from, t->to / t->from, 0.03);
        in_order(plan);
        fw_plan_free(plan);
        fw_arena_free(arena);
    }
}

/* U goes with |(a - 1)(a - 3)|: accepted about 1 and about 3, not between them and not beyond */
static void not_monotonous(void **state) {
    (void)state;
    static const struct {
        double now, low, high;
    } row[] = {{2.2, 2.5, 3}, {1.7, 1, 1.5}, {5.5, 3, 3.4}, {0.3, 0.6, 1}};
    fw_arena *arena = fw_arena_new(0);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i += (size_t)test_cases(1, 3)) {
        const char *parameters = fw_arena_printf(
            arena, "<parameter name=\"a\" value=\"%g\" min=\"0\" max=\"6\"/>", row[i].now);
        const char *text = text_of(arena, parameters, false, "", "0.3 uN m*(a - 1)*(a - 3)");
        fw_plan *plan = judged(text, NULL, true);
        const fw_verdict_parameter_advice *a = of(plan, "a");
        assert_int_equal(plan->verdict.decision, FW_REJECT);
        check_smallest(text, a, "", 1);
        if (!(a->to > row[i].low && a->to < row[i].high)) fail_msg("%s", a->text);
        fw_plan_free(plan);
    }
    fw_arena_free(arena);
}

static void none_is_found(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *text =
        text_of(arena,
                "<parameter name=\"idle\" value=\"3 um\" min=\"1 um\" max=\"9 um\"/>"
                "<parameter name=\"t\" value=\"2 uN m\" min=\"1.5 uN m\" max=\"3 uN m\"/>"
                "<parameter name=\"nought\" value=\"0 N\"/>"
                "<parameter name=\"fixed\" value=\"2\" min=\"2\" max=\"2\"/>",
                false, "", "t");
    fw_plan *plan = judged(text, NULL, true);
    assert_int_equal(plan->verdict.decision, FW_REJECT);
    assert_int_equal(of(plan, "idle")->found, FW_PARAMETER_NONE);
    assert_int_equal(of(plan, "t")->found, FW_PARAMETER_NONE);
    assert_non_null(strstr(of(plan, "t")->text, "no value from 1.5 uN m to 3 uN m was found"));
    assert_near(of(plan, "t")->low, 1.5e-6, 1e-18);
    assert_int_equal(of(plan, "nought")->found, FW_PARAMETER_NOT_LOOKED);
    assert_int_equal(of(plan, "fixed")->found, FW_PARAMETER_NOT_LOOKED);
    assert_int_equal(of(plan, "fixed")->trials, 0);
    in_order(plan);
    for (int i = 0; i < plan->verdict.nparameter; i++)
        assert_true(plan->verdict.parameter[i].trials <= 40);
    fw_plan_free(plan);
    fw_arena_free(arena);
}

/* accepted: nothing is said; and --set of the same parameter is where the search begins */
static void begins_at_what_is_set(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *text = text_of(arena, "<parameter name=\"t\" value=\"0.05 uN m\" max=\"4 uN m\"/>",
                               false, "", "t");
    fw_plan *plan = judged(text, NULL, true);
    assert_int_equal(plan->verdict.decision, FW_ACCEPT);
    assert_int_equal(plan->verdict.nparameter, 0);
    fw_plan_free(plan);
    const fw_device_set set = {"t", "300 uN*1 mm"};
    plan = judged(text, &set, true);
    const fw_verdict_parameter_advice *t = of(plan, "t");
    assert_near(t->from, 3e-7, 1e-18);
    assert_near(t->low, 0.75e-7, 1e-18);
    assert_near(t->high, 4e-6, 1e-18);
    check_smallest(text_of(arena, "<parameter name=\"t\" value=\"0.3 uN m\"/>", false, "", "t"), t,
                   " uN m", 1e-6);
    fw_plan_free(plan);
    fw_arena_free(arena);
}

/* with what a flow makes of it: thickness too, whose range moves with it */
static void as_fabricated(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *text =
        text_of(arena,
                "<parameter name=\"t\" value=\"0.09 uN m\" min=\"0 uN m\" "
                "max=\"1 uN m\"/>"
                "<parameter name=\"thick\" value=\"50 um\" min=\"20 um\" max=\"400 um\"/>",
                true, "<flow ref=\"al-masked-rie\" thickness=\"thick\"/>", "t");
    fw_plan *plan = judged(text, NULL, true);
    assert_int_not_equal(plan->verdict.decision, FW_ACCEPT);
    check_smallest(text, of(plan, "t"), " uN m", 1e-6);
    check_smallest(text, of(plan, "thick"), " um", 1e-6);
    check_smallest(text, of(plan, "w"), " um", 1e-6);
    fw_plan_free(plan);
    fw_arena_free(arena);
}

/* whole numbers stay whole */
/* a plate that a comb draws to its stator from some voltage on: what is used there jumps, and no secant knows where */
static const char pulled_in[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"paddle\">"
    "<parameter name=\"volts\" value=\"120 V\" min=\"5 V\" max=\"200 V\"/>"
    "<material ref=\"silicon-100\" thickness=\"50 um\"/>"
    "<flow ref=\"silicon-on-glass\" carrier=\"insulating\"/>"
    "<die tethers=\"no\"/>"
    "<limits safety-factor=\"1.5\"/>"
    "<flexure id=\"f\" kind=\"leaf\" length=\"320 um\" width=\"5 um\" gap=\"10 um\"/>"
    "<mechanism>"
    "<body id=\"p\" x=\"0.7 mm\" y=\"0 mm\" plate-width=\"0.8 mm\" plate-height=\"0.4 mm\"/>"
    "<revolute id=\"A\" a=\"ground\" b=\"p\" b-x=\"-0.7 mm\" hinge=\"f\"/>"
    "</mechanism>"
    "<scene name=\"run\" duration=\"10 ms\">"
    "<comb-drive id=\"d\" kind=\"comb\" on=\"p\" x=\"0.05 mm\" y=\"0.28 mm\" direction=\"90 deg\" fingers=\"5\" gap=\"10 um\" overlap=\"30 um\" length=\"100 um\" voltage=\"volts\"/>"
    "<material-damping loss-factor=\"0.1\"/>"
    "</scene>"
    "</device>";

/* 31 looks where every second one was a secant in vain. With ends of its fingers it snaps from 47.3 V on, as made */
static void halves_a_jump(void **state) {
    (void)state;
    fw_plan *plan = judged(pulled_in, NULL, true);
    const fw_verdict_parameter_advice *volts = of(plan, "volts");
    assert_int_equal(volts->found, FW_PARAMETER_ACCEPTS);
    assert_true(fabs(volts->to - 47.2) < 0.8);
    assert_int_equal(decision(pulled_in, "volts", "46.7 V"), FW_ACCEPT);
    assert_int_not_equal(decision(pulled_in, "volts", "48.5 V"), FW_ACCEPT);
    assert_in_range(volts->trials, 1, 27);
    fw_plan_free(plan);
}

static void counts(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *text = fw_arena_printf(
        arena,
        "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><parameter name=\"n\" value=\"22\" "
        "min=\"1\" max=\"40\"/><material ref=\"silicon-100\" thickness=\"50 um\"/><flow "
        "ref=\"al-masked-rie\" carrier=\"insulating\"/><flexure id=\"f\" kind=\"csfh\" "
        "radius=\"100 "
        "um\" angle=\"270 deg\" width=\"8 um\" gap=\"8 um\" fillet=\"4 um\"/><mechanism><body "
        "id=\"arm\" mass=\"0.02 mg\" inertia=\"0.003 mg mm^2\" x=\"0.5 mm\" y=\"0 mm\" "
        "plate-width=\"0.9 mm\" plate-height=\"60 um\"/><revolute id=\"h\" a=\"ground\" b=\"arm\" "
        "b-x=\"-0.5 mm\" hinge=\"f\" axis=\"180 "
        "deg\"/></mechanism><scene name=\"a\" duration=\"1 ms\"><comb-drive kind=\"comb\" id=\"c\" "
        "on=\"arm\" "
        "x=\"0.15 mm\" y=\"67 um\" direction=\"90 deg\" fingers=\"n\" gap=\"5 um\" overlap=\"60 "
        "um\" "
        "voltage=\"60 V\"/></scene></device>");
    fw_plan *plan = judged(text, NULL, true);
    const fw_verdict_parameter_advice *n = of(plan, "n");
    assert_int_not_equal(plan->verdict.decision, FW_ACCEPT);
    if (n->found != FW_PARAMETER_ACCEPTS) fail_msg("%s", n->text);
    assert_near(n->to, nearbyint(n->to), 0);
    assert_int_equal(decision(text, "n", n->value_text), FW_ACCEPT);
    char one_less[20];
    snprintf(one_less, sizeof one_less, "%.0f", n->to + (n->to < n->from ? 1 : -1));
    assert_int_not_equal(decision(text, "n", one_less), FW_ACCEPT);
    fw_plan_free(plan);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_random_arms), cmocka_unit_test(not_monotonous),
        cmocka_unit_test(none_is_found),  cmocka_unit_test(begins_at_what_is_set),
        cmocka_unit_test(as_fabricated),  cmocka_unit_test(counts),
        cmocka_unit_test(halves_a_jump),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
