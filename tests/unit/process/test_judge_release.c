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

/* the copper flow takes everything off; the others say what they do not know */
static void what_may_come_off(void **state) {
    (void)state;
    assert_true(fw_process_flow_frees_all(judged(NULL, COPPER)));
    assert_false(fw_process_flow_frees_all(judged(NULL, SOI)));
    assert_true(fw_process_flow_releases(judged(NULL, COPPER)));
    assert_false(fw_process_flow_releases(judged(NULL, SILICON)));
    assert_non_null(reason_with(judged(distances(20, 50), SOI), "narrow openings"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(time_follows, setup, teardown),
        cmocka_unit_test_setup_teardown(no_drawing_no_time, setup, teardown),
        cmocka_unit_test_setup_teardown(windows_close, setup, teardown),
        cmocka_unit_test_setup_teardown(stated_reaches_are_judged, setup, teardown),
        cmocka_unit_test_setup_teardown(what_may_come_off, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
