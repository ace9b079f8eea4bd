/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other ways of doing a step: what a laboratory chooses is the flow that is checked and computed. */
#include "pack_fixture.h"
#include "process/calibrate.h"

static const char *lacks;

static fw_status chosen(const char *name, const char *from, const char *to,
                        const fw_process_choice *choice, int n, fw_process_flow **flow) {
    size_t nb = 0, nx = 0;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, name, &nx);
    text = replaced(arena, text, from, to, &nx);
    diags = fw_diags_new(arena);
    return fw_process_flow_read_chosen(arena, "base.xml", base, nb, "flow.xml", text, nx, choice, n, lacks,
                                       &diags, flow);
}

static void expect(int number, const char *says) {
    if (!said_of(number, says)) fail_msg("no FW-D%d with '%s'", number, says);
}

/* each one of the packs is a flow that passes every check, and differs in its step alone */
static void every_alternative_of_the_packs(void **state) {
    (void)state;
    static const char *const packs[] = {COPPER, SILICON, "soi-deep-rie"};
    int met = 0;
    for (int p = 0; p < 3; p++) {
        fw_process_flow *plain, *other;
        assert_int_equal(chosen(packs[p], NULL, NULL, NULL, 0, &plain), FW_OK);
        for (int i = 0; i < plain->nalternative; i++, met++) {
            fw_process_choice c = {.alternative = plain->alternative[i].id};
            if (chosen(packs[p], NULL, NULL, &c, 1, &other) != FW_OK)
                fail_msg("%s: %s", c.alternative, diags.item[0].message);
            assert_int_equal(other->nstep, plain->nstep);
            assert_true(other->alternative[i].chosen);
            assert_false(plain->alternative[i].chosen);
            for (int k = 0; k < plain->nstep; k++) {
                bool same = strcmp(plain->step[k].title, other->step[k].title) == 0;
                assert_string_equal(plain->step[k].id, other->step[k].id);
                assert_int_equal(same, strcmp(plain->step[k].id, plain->alternative[i].step) != 0);
            }
            assert_int_equal(fw_process_flow_compute(arena, other, &plain_facts, &diags), FW_OK);
        }
    }
    assert_true(met > 0);
}

static void of_a_laboratory(void **state) {
    (void)state;
    const char *lab =
        "<process xmlns=\"urn:flexwright:process:1\" "
        "flow=\"copper-on-porous-silicon\"><choose alternative=\"sc1-clean\"/></process>";
    fw_process_choice *choice = NULL;
    int n = 0;
    fw_process_flow *flow;
    assert_int_equal(
        fw_process_lab_choices(arena, "lab.xml", lab, strlen(lab), SILICON, &choice, &n), FW_OK);
    assert_int_equal(n, 0); /* of another flow */
    assert_int_equal(
        fw_process_lab_choices(arena, "lab.xml", lab, strlen(lab), COPPER, &choice, &n), FW_OK);
    assert_int_equal(n, 1);
    assert_string_equal(choice[0].alternative, "sc1-clean");
    assert_int_equal(chosen(COPPER, NULL, NULL, choice, n, &flow), FW_OK);
    assert_string_equal(step_of(flow, "C02")->hazard[0]->id, "h.sc1");
    assert_int_equal(fw_process_lab_apply(arena, "lab.xml", lab, strlen(lab), flow, &diags), FW_OK);
    fw_process_choice twice[] = {choice[0], choice[0]}, wrong = {.alternative = "sc2-clean"};
    assert_int_equal(chosen(COPPER, NULL, NULL, twice, 2, &flow), FW_INPUT);
    expect(375, "both for step C02");
    assert_int_equal(chosen(COPPER, NULL, NULL, &wrong, 1, &flow), FW_INPUT);
    expect(375, "did you mean 'sc1-clean'");
}

/* the checks are of the step that is run: aluminium goes in this acid */
static void checked_as_it_is_run(void **state) {
    (void)state;
    static const char put[] =
        "<alternative id=\"acid\" title=\"acid\"><step id=\"S16\" op=\"strip\" title=\"Acid\" "
        "equipment=\"al-bench\" in-source=\"no\"><purpose>x</purpose><change kind=\"remove\" "
        "material=\"resist\"/><time law=\"const\" overrun=\"0\" k=\"2\"><arg name=\"time\" "
        "q=\"strip.t\"/></time><endpoint>x</endpoint><accept measure=\"x\" lo=\"\" hi=\"\" "
        "unit=\"1\" sites=\"1\" every=\"1\"/><hazard-ref ref=\"h.piranha\"/><on-fail if=\"x\" "
        "then=\"hold\">x</on-fail><finish kind=\"rinse\"/><finish kind=\"dry\" by=\"spin\"/></step>"
        "</alternative><step id=\"S17\"";
    fw_process_choice c = {.alternative = "acid"};
    fw_process_flow *flow;
    assert_int_equal(chosen(SILICON, "<step id=\"S17\"", put, &c, 1, &flow), FW_INPUT);
    expect(269, "'h.piranha' attacks 'aluminium'");
    /* and of the one that nobody has chosen yet, said of it; the flow itself stays as it is */
    assert_int_equal(chosen(SILICON, "<step id=\"S17\"", put, NULL, 0, &flow), FW_INPUT);
    expect(269, "with the alternative 'acid': step S16: 'h.piranha' attacks 'aluminium'");
    const char *wet = replaced(arena, put, "<finish kind=\"dry\" by=\"spin\"/>", "", &(size_t){0});
    wet = replaced(arena, wet, "h.piranha", "h.solvent", &(size_t){0});
    assert_int_equal(chosen(SILICON, "<step id=\"S17\"", wet, NULL, 0, &flow), FW_INPUT);
    expect(335, "with the alternative 'acid': step S17"); /* at the step behind it */
    const char *elsewhere = replaced(arena, put, "id=\"S16\"", "id=\"S99\"", &(size_t){0});
    assert_int_equal(chosen(SILICON, "<step id=\"S17\"", elsewhere, NULL, 0, &flow), FW_INPUT);
    expect(375, "there is no step 'S99'");
    assert_int_equal(chosen(SILICON, "<step id=\"S17\"",
                            "<alternative id=\"none\" title=\"none\"/><step id=\"S17\"", NULL, 0,
                            &flow),
                     FW_INPUT);
    expect(375, "holds one <step>");
}

/* what only a device with tethers needs is nowhere in the flow of one that has none, and what named it goes on without */
static void without_what_the_device_lacks(void **state) {
    (void)state;
    fw_process_flow *with, *without;
    assert_int_equal(chosen("silicon-on-glass", NULL, NULL, NULL, 0, &with), FW_OK);
    assert_non_null(step_of(with, "G50"));
    assert_int_equal(with->nleft_out, 0);
    const size_t said = diags.count;
    lacks = "tethers";
    assert_int_equal(chosen("silicon-on-glass", NULL, NULL, NULL, 0, &without), FW_OK);
    assert_int_equal(diags.count, said); /* nothing that is not said of the whole flow */
    assert_int_equal(without->nstep, with->nstep - 1);
    for (int i = 0; i < without->nstep; i++)
        assert_string_not_equal(without->step[i].id, "G50");
    assert_int_equal(without->nleft_out, 1);
    assert_string_equal(without->left_out[0].id, "G50");
    assert_string_equal(without->left_out[0].before, "G51");
    assert_string_equal(without->left_out[0].why, "the device has no tethers");
    assert_ptr_equal(fw_process_flow_left_out(without, "G50"), &without->left_out[0]);
    assert_int_equal(step_of(without, "G51")->nrequired, step_of(with, "G51")->nrequired - 1);
    /* a wait and a rework that name it: the one falls away, the other goes to the step behind it */
    static const char named[] = "<lag from=\"G50\" min=\"1\" unit=\"min\"/>"
                                "<on-fail if=\"held\" then=\"rework\" goto=\"G50\">again</on-fail>"
                                "<on-fail if=\"wire lifts\"";
    assert_int_equal(chosen("silicon-on-glass", "<on-fail if=\"wire lifts\"", named, NULL, 0, &without), FW_OK);
    const fw_process_step *s = step_of(without, "G53");
    assert_int_equal(s->nlag, 0);
    assert_string_equal(s->on_fail[s->non_fail - 2].go_to, "G51");
    /* the last one of all, and a wrong word */
    assert_int_equal(chosen("silicon-on-glass", "id=\"G53\"", "id=\"G53\" only-with=\"tethers\"", NULL, 0, &without), FW_OK);
    assert_int_equal(without->nleft_out, 2);
    assert_string_equal(without->left_out[1].before, "");
    assert_int_equal(chosen("silicon-on-glass", "only-with=\"tethers\"", "only-with=\"fingers\"", NULL, 0, &without), FW_INPUT);
    /* what every device needs is not for some: seen before anybody draws one without, and the other way round */
    static const struct {
        const char *lacks, *says;
    } asked[] = {{NULL, "for a device without 'tethers'"}, {"tethers", NULL}};
    for (size_t i = 0; i < 2; i++) {
        lacks = asked[i].lacks;
        assert_int_equal(chosen("silicon-on-glass", "<step id=\"G46\"", "<step only-with=\"tethers\" id=\"G46\"", NULL, 0,
                                &without),
                         FW_INPUT);
        if (asked[i].says) expect(338, asked[i].says);
    }
    /* what is measured, too */
    assert_int_equal(chosen(SILICON, NULL, NULL, NULL, 0, &without), FW_OK);
    lacks = NULL;
    assert_int_equal(chosen(SILICON, NULL, NULL, NULL, 0, &with), FW_OK);
    assert_int_equal(without->nstep, with->nstep);
    assert_int_equal(step_of(without, "S20")->naccept, step_of(with, "S20")->naccept - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_alternative_of_the_packs, setup, teardown),
        cmocka_unit_test_setup_teardown(of_a_laboratory, setup, teardown),
        cmocka_unit_test_setup_teardown(checked_as_it_is_run, setup, teardown),
        cmocka_unit_test_setup_teardown(without_what_the_device_lacks, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
