/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reach, time and judgement of a release, from the distances of a drawing. */
#include "pack_fixture.h"
#include "process/pack.h"

#define SOI "soi-deep-rie"
#define UM  1e-6

/* a body that needs so much, and a pad that holds so long */
static const fw_release *distances(double needed_um, double lost_um) {
    fw_release *r = fw_arena_one(arena, fw_release);
    r->part = fw_arena_array(arena, fw_release_part, 2);
    r->npart = 2;
    r->share = 0.1;
    r->part[0] = (fw_release_part){.label = "link AB",
                                   .duty = FW_RELEASE_MOVES,
                                   .area_m2 = 1e-8,
                                   .reach_m = needed_um * UM,
                                   .at = {100 * UM, 200 * UM}};
    r->part[1] = (fw_release_part){.label = "pad",
                                   .duty = FW_RELEASE_STAYS,
                                   .body = FW_ISLAND,
                                   .area_m2 = 1e-8,
                                   .reach_m = lost_um * UM,
                                   .kept_m = lost_um * UM};
    for (int k = 0; k <= FW_RELEASE_STEPS; k++)
        r->part[1].bonded_m2[k] = 1e-8 * (1.0 - (double)k / FW_RELEASE_STEPS);
    r->slowest = 0, r->weakest = 1;
    r->needed_m = needed_um * UM, r->lost_m = lost_um * UM;
    return r;
}

static fw_process_flow *judged(const fw_release *release, const char *pack) {
    fw_process_mask_facts facts = plain_facts;
    fw_process_flow *f = read_pack(arena, pack, NULL, NULL, &diags);
    facts.release = release;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    return f;
}

static const char *reason_with(const fw_process_flow *f, const char *words) {
    for (int i = 0; i < f->nreason; i++)
        if (strstr(f->reason[i], words)) return f->reason[i];
    return NULL;
}

/* t = (need + foot)/R, and all later numbers of the step with it */
static void time_follows(void **state) {
    (void)state;
    for (double need = 5; need < 40; need += 7) {
        fw_process_flow *f = judged(distances(need, 1000), SOI);
        double reach;
        const fw_process_step *s = fw_process_flow_release_step(f, &reach);
        assert_string_equal(s->id, "D12");
        assert_near(reach, need * UM + f->release_foot_m, 1e-15);
        assert_true(fabs(f->release_foot_m) < 1e-6);
        assert_true(s->time.computable);
        assert_relative(s->time.nominal_s, reach / (0.2 * UM / 60), 1e-9);
        assert_true(f->manufacturable != 0 && !f->no_window);
    }
}

/* A rate of 0.2 um/min known to u = 0.02: the longest time of the slowest runs 30 x 0.24/0.16 = 45 um with the fastest, and
   the planned one, with 20 % over-etch, 43.2; the stop time of the sheet 30 x 1.2 x 1.2 x 1.2 = 51.84. An anchor that holds
   for 48 um is lost by the last alone. */
static void stop_time_counts(void **state) {
    (void)state;
    fw_process_mask_facts facts = plain_facts;
    fw_process_flow *f = read_pack(arena, SOI, NULL, NULL, &diags);
    facts.release = distances(30, 48);
    measured(f, "release.R", 0.2 * UM / 60, 0.02 * UM / 60);
    ((fw_quantity *)fw_process_flow_quantity(f, "release.R"))->interval = false;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_true(f->manufacturable != 0);
    assert_non_null(reason_with(f, "the stop time 5"));
}

/* an etch that runs sideways is timed by how far, whatever its step is called: by a clock alone, or by the film's thickness,
   it is refused */
static void time_goes_by_the_reach(void **state) {
    (void)state;
    static const char by[] =
        "<time law=\"rate\" overrun=\"0.2\" k=\"2\"><arg name=\"thickness\" q=\"release.reach\"/>"
        "<arg name=\"rate\" q=\"release.R\"/></time>";
    static const char *const other[] = {
        "<time law=\"const\" overrun=\"0.2\" k=\"2\"><arg name=\"time\" q=\"final.t\"/></time>",
        "<time law=\"rate\" overrun=\"0.2\" k=\"2\"><arg name=\"thickness\" q=\"box.d\"/>"
        "<arg name=\"rate\" q=\"release.R\"/></time>"};
    for (int i = 0; i < 2; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, SOI, by, other[i], &diags));
        assert_non_null(said_of(541, "step D12 (release) runs sideways"));
    }
}

static void no_drawing_no_time(void **state) {
    (void)state;
    fw_process_flow *f = judged(NULL, SOI);
    double reach;
    const fw_process_step *s = fw_process_flow_release_step(f, &reach);
    assert_true(isnan(reach));
    assert_false(s->time.computable);
    assert_null(f->release);
}

/* refused from (1 + E) need >= lost on, and then first of all reasons */
static void windows_close(void **state) {
    (void)state;
    fw_process_flow *open = judged(distances(20, 24.2), SOI);
    fw_process_flow *shut = judged(distances(20, 23.9), SOI);
    assert_true(open->manufacturable != 0);
    assert_false(open->no_window);
    assert_true(shut->no_window);
    assert_int_equal(shut->manufacturable, 0);
    assert_non_null(strstr(shut->reason[0], "step D12 has no window"));
    assert_non_null(strstr(shut->reason[0], "link AB, near (100, 200) um"));
    assert_non_null(strstr(shut->reason[0], "pad"));
    /* a rate of 0.2 +- 0.06 um/min: the fastest runs four times as far as the slowest */
    assert_non_null(reason_with(judged(distances(20, 60), SOI), "release ladder"));
    assert_null(reason_with(judged(distances(20, 90), SOI), "release ladder"));
}

/* a reach that somebody states is judged by the same two numbers */
static void stated_reaches_are_judged(void **state) {
    (void)state;
    static const struct {
        double reach_um;
        const char *refuses;
    } row[] = {{15, "does not free the device"}, {25, NULL}, {60, "has no window"}};
    for (int i = 0; i < 3; i++) {
        fw_process_mask_facts facts = plain_facts;
        fw_process_flow *f = read_pack(arena, SOI, NULL, NULL, &diags);
        measured(f, "release.reach", row[i].reach_um * UM, 0);
        facts.release = distances(20, 50);
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        assert_int_equal(f->manufacturable == 0, row[i].refuses != NULL);
        if (row[i].refuses) assert_non_null(reason_with(f, row[i].refuses));
    }
}

/* the release with a law of lag, t = (D + c D^2/(2 w))/R */
static fw_process_flow *lagging(double needed_um, double lost_um, double c, double u,
                                fw_quantity_value_status status) {
    static const fw_quantity none;
    static fw_quantity width, lag;
    static fw_process_argument list[4];
    fw_process_mask_facts facts = plain_facts;
    fw_process_flow *f = read_pack(arena, SOI, NULL, NULL, &diags);
    double reach;
    fw_process_step *s = NULL;
    for (int i = 0; i < f->nstep; i++)
        if (f->step[i].nchange > 0 && f->step[i].change[0].reach) s = &f->step[i];
    assert_non_null(s);
    width = lag = none;
    width.id = "slit", width.dimension = (fw_quantity_dimension)FW_DIM_LENGTH,
    width.value = 10 * UM;
    lag.id = "lag", lag.value = c, lag.uncertainty = u, lag.status = status;
    width.status = FW_MEASURED;
    for (int i = 0; i < 2; i++)
        list[i] = s->argument[i];
    list[0].name = "depth";
    list[2] = list[3] = list[1];
    list[2].name = "width", list[2].q = &width;
    list[3].name = "lag", list[3].q = &lag;
    s->law = "arde", s->shape = "linear", s->argument = list, s->nargument = 4;
    facts.release = distances(needed_um, lost_um);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_ptr_equal(fw_process_flow_release_step(f, &reach), s);
    return f;
}

/* A narrow opening of 10 um needs (D + c D^2/20 um)/R for D: in that time a wide one runs 1 + c D/20 um times
   as far, and that loses what must stay. */
static void wide_openings_run_ahead(void **state) {
    (void)state;
    fw_process_flow *f = lagging(20, 60, 0.5, 0, FW_MEASURED);
    double reach;
    const fw_process_step *s = fw_process_flow_release_step(f, &reach);
    double k = 1.0 + 0.5 * reach / (20 * UM);
    assert_relative(s->time.nominal_s, k * reach / (0.2 * UM / 60), 1e-9);
    assert_relative(f->release_wide, k, 1e-9);
    assert_relative(fw_process_release_run(f, s, reach), 1.2 * k * reach, 1e-9);
    assert_true(f->release_lag_known && !f->no_window);
    assert_null(reason_with(f, "narrow openings"));
    /* 1.2 x 20 x 1.5 = 36 um: with 35 um there is no window, without the lag there was */
    assert_true(lagging(20, 35, 0.5, 0, FW_MEASURED)->no_window);
    assert_false(lagging(20, 35, 0.0, 0, FW_MEASURED)->no_window);
    /* 0.5 +- 0.2 (k = 2): up to 1.2 x 20 x 1.9 = 45.6 um */
    f = lagging(20, 42, 0.5, 0.2, FW_MEASURED);
    assert_false(f->no_window);
    assert_non_null(reason_with(f, "narrow openings may fall so far behind"));
    assert_null(reason_with(lagging(20, 47, 0.5, 0.2, FW_MEASURED), "narrow openings"));
}

/* a lag that is assumed leaves the time that of wide openings, and is said with what it may be */
static void assumed_lags_are_said(void **state) {
    (void)state;
    fw_process_flow *f = lagging(20, 60, 0.5, 0.2, FW_ASSUMED);
    double reach;
    const fw_process_step *s = fw_process_flow_release_step(f, &reach);
    assert_relative(s->time.nominal_s, reach / (0.2 * UM / 60), 1e-9);
    assert_true(f->release_wide == 1.0);
    assert_true(f->release_wide_most > 1.5);
    assert_non_null(reason_with(f, "only assumed, and the time is that of wide ones"));
}

/* the copper flow takes everything off; the others say what they do not know */
static void what_may_come_off(void **state) {
    (void)state;
    assert_true(fw_process_flow_frees_all(judged(NULL, COPPER)));
    assert_false(fw_process_flow_frees_all(judged(NULL, SOI)));
    assert_true(fw_process_flow_releases(judged(NULL, COPPER)));
    assert_false(fw_process_flow_releases(judged(NULL, SILICON)));
    assert_non_null(reason_with(judged(distances(20, 50), SOI), "narrow openings"));
}

/* what a mechanism hangs on last, for people: eight hinges, and how many more */
static void words_name_eight_hinges(void **state) {
    (void)state;
    fw_text at = fw_text_new(arena);
    for (int i = 0; i < 12; i++)
        fw_text_printf(&at, "%shinge h%d", i ? ", " : "", i);
    assert_int_equal(fw_text_end(&at), FW_OK);
    fw_release_body_hold body = {.label = "stage", .free_m = 20 * UM, .holders = 12};
    fw_release_group_hold group = {.at = at.data, .ground_hinges = 12, .hangs_m = 20 * UM, .last_bond = "stage"};
    fw_release_hold hold = {.body = &body, .nbody = 1, .group = &group, .ngroup = 1};
    fw_process_flow flow = *judged(NULL, SOI);
    flow.hold = &hold;
    const char *words = NULL;
    assert_int_equal(fw_process_hold_words(arena, &flow, &words), FW_OK);
    assert_non_null(strstr(words, "the device hangs on hinge h0, "));
    assert_non_null(strstr(words, "hinge h7 and 4 more"));
    assert_null(strstr(words, "hinge h8"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(time_follows, setup, teardown),
        cmocka_unit_test_setup_teardown(stop_time_counts, setup, teardown),
        cmocka_unit_test_setup_teardown(time_goes_by_the_reach, setup, teardown),
        cmocka_unit_test_setup_teardown(no_drawing_no_time, setup, teardown),
        cmocka_unit_test_setup_teardown(windows_close, setup, teardown),
        cmocka_unit_test_setup_teardown(stated_reaches_are_judged, setup, teardown),
        cmocka_unit_test_setup_teardown(wide_openings_run_ahead, setup, teardown),
        cmocka_unit_test_setup_teardown(assumed_lags_are_said, setup, teardown),
        cmocka_unit_test_setup_teardown(what_may_come_off, setup, teardown),
        cmocka_unit_test_setup_teardown(words_name_eight_hinges, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
