/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is planned is accepted: of a wafer that comes out as planned every step accepts what it measures, on the coupon as it
   stands on the mask, and limits go with the values that laboratories change. */
#include "pack_fixture.h"
#include "process/fixed_point.h"

static const char *const packs[] = {COPPER, SILICON, "silicon-on-glass", "soi-deep-rie",
                                    "soi-double-sided"};
enum { PACKS = sizeof packs / sizeof *packs };

static const fw_process_accept *accept_of(fw_process_flow *f, const char *step,
                                          const char *measure) {
    const fw_process_step *s = step_of(f, step);
    for (int i = 0; i < s->naccept; i++)
        if (strcmp(s->accept[i].measure, measure) == 0) return &s->accept[i];
    fail_msg("step %s does not measure '%s'", step, measure);
    return NULL;
}

/* NaN: there is none, or it is not known */
static double number(const char *text) {
    double x = (double)NAN;
    if (text[0] && strcmp(text, "____") != 0 && !fw_number_parse(text, strlen(text), &x))
        fail_msg("'%s' is no number", text);
    return x;
}

/* without the range of a guess */
static void exactly(fw_process_flow *f, const char *id, double value, double uncertainty) {
    measured(f, id, value, uncertainty);
    ((fw_quantity *)fw_process_flow_quantity(f, id))->interval = false;
}

static void compute(fw_process_flow *f) {
    diags = fw_diags_new(arena);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
}

/* every length that is read off a coupon and has a limit says what is planned, and all that say so are accepted */
static void what_is_planned_is_accepted(void **state) {
    (void)state;
    int said = 0;
    for (int p = 0; p < PACKS; p++) {
        fw_process_flow *f = computed_pack(packs[p], NULL, NULL);
        assert_null(said_of(667, ""));
        for (int i = 0; i < f->nstep; i++)
            for (int k = 0; k < f->step[i].naccept; k++) {
                const fw_process_accept *a = &f->step[i].accept[k];
                const bool length = strcmp(a->unit, "um") == 0 && (a->low[0] || a->high[0]);
                if (a->coupon[0] && length && !a->planned[0])
                    fail_msg("%s %s: '%s' on %s says nothing of what is planned", packs[p],
                             f->step[i].id, a->measure, a->coupon);
                if (!a->planned[0]) continue;
                said++;
                assert_false(number(a->planned) < number(a->low));
                assert_false(number(a->planned) > number(a->high));
            }
    }
    assert_true(said >= 8);
}

/* lines of `cd` are drawn without the bias of the mask: 1 um of aluminium, 1.1 times at either edge */
static void lines_of_the_coupon_have_no_bias(void **state) {
    (void)state;
    static const char *const flow[] = {SILICON, "silicon-on-glass"}, *const step[] = {"S15", "G40"};
    for (int i = 0; i < 2; i++) {
        fw_process_flow *f = computed_pack(flow[i], NULL, NULL);
        const fw_process_accept *a =
            accept_of(f, step[i], "line width in aluminium against the drawn one");
        assert_string_equal(a->coupon, "cd");
        assert_relative(number(a->planned), -2.2, 1e-9);
        assert_relative(number(a->low), -2.2 - 2.0 * (0.15 + 0.22), 1e-2);
        assert_relative(number(a->high), -2.2 + 2.0 * (0.15 + 0.22), 1e-2);
        measured(f, "al.d", 1.5e-6, 1e-8);
        exactly(f, "litho.edge", 0.1e-6, 0.02e-6);
        compute(f);
        assert_relative(number(a->planned), 2.0 * (0.1 - 1.65), 1e-3);
        assert_true(number(a->low) < number(a->planned) && number(a->planned) < number(a->high));
    }
}

/* the test die has slots of 4 um, and the etch is timed for the narrowest of the device, which is 10 um here */
static void slots_are_those_of_the_device(void **state) {
    (void)state;
    static const char *const flow[] = {SILICON, "silicon-on-glass", "soi-deep-rie",
                                       "soi-double-sided"};
    static const char *const step[] = {"S19", "G43", "D09", "B09"};
    for (int p = 0; p < 4; p++) {
        fw_process_flow *f = computed_pack(flow[p], NULL, NULL);
        const fw_process_step *s = step_of(f, step[p]);
        int found = 0;
        for (int k = 0; k < s->naccept; k++) {
            if (strcmp(s->accept[k].coupon, "slots") != 0) continue;
            assert_non_null(strstr(s->accept[k].measure, "slots, 10 um wide and wider"));
            found++;
        }
        assert_int_equal(found, 1);
    }
}

static void printed_lines_follow_their_edge(void **state) {
    (void)state;
    static const char *const step[] = {"C19", "S12", "G35", "D08", "B08"};
    static const char *const measure[] = {"width against the mask",
                                          "resist width against the mask"};
    for (int p = 0; p < PACKS; p++) {
        fw_process_flow *f = computed_pack(packs[p], NULL, NULL);
        const fw_process_accept *a = accept_of(f, step[p], measure[p > 0]);
        assert_relative(number(a->high), p ? 0.3 : 1.0, 1e-9);
        assert_relative(number(a->low), p ? -0.3 : -1.0, 1e-9);
        exactly(f, "litho.edge", -0.8e-6, 0.05e-6);
        compute(f);
        assert_relative(number(a->planned), -1.6, 1e-9);
        assert_relative(number(a->low), -1.8, 1e-9);
        assert_relative(number(a->high), -1.4, 1e-9);
    }
}

/* 1.5 um of aluminium, twice the over-etch: what the pack's own numbers were for 1 um and a tenth */
static void limits_follow_the_film(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(SILICON, NULL, NULL);
    const fw_process_accept *sheet = accept_of(f, "S04", "sheet resistance"),
                            *lost = accept_of(f, "S14", "width lost against the resist"),
                            *left = accept_of(f, "S18", "aluminium left");
    assert_relative(number(sheet->low), 0.025, 1e-3);
    assert_relative(number(sheet->high), 0.035, 1e-3);
    assert_relative(number(lost->high), 2.4, 1e-9);
    assert_relative(number(left->low), 0.3, 1e-9);
    assert_relative(number(left->planned), 1.0 - 55.0 / 100.0, 1e-9);
    measured(f, "al.d", 1.5e-6, 1e-8);
    measured(f, "al.overetch", 0.2, 0);
    compute(f);
    assert_null(said_of(667, ""));
    assert_relative(number(sheet->planned), 0.02, 1e-9);
    assert_relative(number(lost->planned), 2.0 * 1.8, 1e-9);
    assert_relative(number(lost->high), 2.0 * 1.95, 1e-9);
    assert_relative(number(left->low), 0.45, 1e-9);
    assert_relative(number(left->planned), 1.5 - 0.55, 1e-9);
}

/* 0.8 um of seed, 1.2 times: what its removal takes of the copper is planned, and not refused in the end */
static void what_the_seed_takes_is_planned(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(COPPER, NULL, NULL);
    const fw_process_accept *a = accept_of(f, "C28", "thickness");
    assert_relative(number(a->low), 8.1, 1e-9); /* nothing is known of the seed */
    measured(f, "seed.d", 0.8e-6, 1e-8);
    measured(f, "seed.R", 0.1e-6 / 60, 1e-11);
    compute(f);
    assert_relative(number(a->planned), 9.0 - 0.96, 1e-9);
    assert_relative(number(a->low), 0.9 * 8.04, 1e-9);
    assert_relative(number(a->high), 1.1 * 8.04, 1e-3);
}

/* a limit that is a need stays what it is, and a plan that does not meet it is told so */
static void what_cannot_be_accepted_is_said(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(SILICON, NULL, NULL);
    measured(f, "rie.selectivity", 75, 5);
    compute(f);
    assert_non_null(said_of(667,
                            "step S18 measures 'aluminium left', of which 0.2667 um is planned, "
                            "and accepts no less than 0.3"));
    f = computed_pack(COPPER, NULL, NULL);
    measured(f, "cu.d", 15.5e-6, 0);
    compute(f);
    assert_non_null(said_of(667, "step C22"));
    f = computed_pack("soi-deep-rie", NULL, NULL);
    measured(f, "drie.selectivity", 24, 1);
    compute(f);
    assert_non_null(said_of(667, "step D09"));
    f = computed_pack(SILICON, "lo=\"{=al.d*0.3}\" hi=\"\"", "lo=\"0.5\" hi=\"0.9\"");
    assert_non_null(said_of(667, "accepts no less than 0.5"));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(what_is_planned_is_accepted),    TEST(lines_of_the_coupon_have_no_bias),
        TEST(slots_are_those_of_the_device),  TEST(printed_lines_follow_their_edge),
        TEST(limits_follow_the_film),         TEST(what_the_seed_takes_is_planned),
        TEST(what_cannot_be_accepted_is_said)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
