/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hours of machines: every run of a schedule lies inside all of them and on no closed day; the earliest fit against a
   search by quarters of an hour; what a laboratory writes, and what it may not. */
#include "../process/pack_fixture.h"
#include "process/calibrate.h"
#include "schedule/place.h"
#include "shops.h"

enum { HOUR = 3600, DAY = 86400 };

static uint64_t seed = 3;
static int below(int n) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (int)((seed >> 33) % (uint64_t)n);
}

/* straight from the words: the run is open from its first to its last second */
static bool inside(const fw_schedule_machine *m, double start, double end) {
    for (int i = 0; i < m->nhours; i++) {
        const fw_schedule_calendar *c = &m->hours[i];
        double day = floor(start / DAY), from = start - day * DAY, to = end - day * DAY;
        int weekday = ((int)day % 7 + 7) % 7; /* undated: day 1 is a Monday */
        if (c->dated) weekday = fw_schedule_calendar_weekday(c, (long)day);
        bool in = !(c->closed_days >> weekday & 1u) && from >= c->open_s - 1e-6 &&
                  to <= c->close_s + 1e-6;
        for (int k = 0; k < c->breaks; k++)
            in = in && (to <= c->break_s[k][0] + 1e-6 || from >= c->break_s[k][1] - 1e-6);
        if (!in) return false;
    }
    for (int i = 0; i < m->nclosed; i++)
        if (start < m->closed_s[i][1] - 1e-6 && end > m->closed_s[i][0] + 1e-6) return false;
    return true;
}

static void earliest_fit(void **state) {
    (void)state;
    const int cases = test_fewest(test_cases(400, 100), 25);
    int never = 0;
    for (int i = 0; i < cases; i++) {
        fw_schedule_calendar hours[2] = {{0}};
        double closed[2][2];
        fw_schedule_machine m = {.hours = hours, .nhours = 1 + below(2), .closed_s = closed};
        for (int k = 0; k < m.nhours; k++) {
            int open = below(12);
            hours[k] = (fw_schedule_calendar){.open_s = open * HOUR,
                                              .close_s = (open + 4 + below(9)) * HOUR,
                                              .weekends = true,
                                              .closed_days = (unsigned)below(127)};
            if (below(2)) {
                hours[k].breaks = 1;
                hours[k].break_s[0][0] = hours[k].open_s + 2 * HOUR;
                hours[k].break_s[0][1] = hours[k].open_s + 3 * HOUR;
            }
        }
        for (m.nclosed = 0; m.nclosed < below(3); m.nclosed++) {
            closed[m.nclosed][0] = DAY * (double)below(14);
            closed[m.nclosed][1] = closed[m.nclosed][0] + DAY * (1.0 + below(3));
        }
        double from = 900.0 * below(4 * 24 * 10), length = 900.0 * (1 + below(20)), want = from;
        while (want < 40.0 * DAY && !inside(&m, want, want + length))
            want += 900.0;
        double got = fw_schedule_machine_fit(&m, from, length);
        if (want >= 40.0 * DAY) {
            assert_true(isinf(got));
            never++;
        } else
            assert_near(got, want, 1e-6);
    }
    assert_true(never > 0 && never < cases / 2);
}

static const char lab_head[] =
    "<process xmlns=\"urn:flexwright:process:1\" flow=\"al-masked-rie\">%s</process>";

static fw_process_flow *with(const char *tools, fw_status wanted) {
    diags = fw_diags_new(arena);
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    const char *lab = fw_arena_printf(arena, lab_head, tools);
    assert_int_equal(fw_process_lab_apply(arena, "lab.xml", lab, strlen(lab), f, &diags), wanted);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    return f;
}

static void every_run(void **state) {
    (void)state;
    static const char *const tools[] = {
        "<tool equipment=\"rie\" open=\"09:00-13:00\" days=\"Tue Thu\"/>",
        "<tool equipment=\"rie\" open=\"08:00-12:00,13:00-18:00\"/><tool equipment=\"rie\" "
        "closed=\"2026-11-24\" to=\"2026-11-26\"/>",
        "<tool equipment=\"aligner\" open=\"10:00-11:00\" days=\"Mon Fri\"/><tool "
        "equipment=\"al-bench\" open=\"09:00-17:00\"/>"};
    for (int i = 0; i < 3; i++)
        for (int wafers = 1; wafers <= 4; wafers += 3) {
            fw_process_flow *f = with(tools[i], FW_OK);
            const fw_schedule *s, *open;
            fw_schedule_options options = {.wafers = wafers, .day = "08:00-18:00 from 2026-11-23"};
            assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
            assert_true(s->feasible);
            int touched = 0;
            for (int k = 0; k < s->nrun; k++) {
                const fw_schedule_machine *m =
                    &s->shop->machine[s->shop->task[s->run[k].task].machine];
                touched += m->nhours + m->nclosed > 0;
                assert_true(inside(m, s->run[k].start_s, s->run[k].end_s));
            }
            assert_true(touched > 0);
            assert_true(s->bound.best_s <= s->makespan_s + 1e-6);
            f->ntool_time = 0; /* without hours it is not later, and not bound to be */
            assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &open), FW_OK);
            assert_true(open->makespan_s <= s->makespan_s + 1e-6);
            assert_true(open->bound.best_s <= s->bound.best_s + 1e-6);
            if (i == 0) { /* the etcher decides: one wafer a Tuesday or Thursday */
                assert_true(s->optimal && s->gap == 0.0);
                assert_true(s->bound.best_s > (wafers > 1 ? 4.0 : 1.5) * open->makespan_s);
            }
        }
}

/* looked at between its parts: while people are there, though their hands are taken for a quarter of an hour only */
static int runs_into_the_night(const fw_schedule *s, const char *step) {
    int n = 0;
    for (int k = 0; k < s->nrun; k++) {
        const fw_schedule_task *t = &s->shop->task[s->run[k].task];
        double opens = DAY * floor(s->run[k].start_s / DAY) + 8.0 * HOUR;
        if (strcmp(t->id, step) == 0) n += s->run[k].start_s < opens - 1.0 || s->run[k].end_s > opens + 10.0 * HOUR + 1.0;
    }
    return n;
}

static void in_parts(void **state) {
    (void)state;
    fw_process_flow *f = with("", FW_OK);
    fw_schedule_options options = {.wafers = 4, .day = "08:00-18:00 from 2026-11-23"};
    const fw_schedule *s;
    fw_schedule free_of_it;
    assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
    assert_true(s->feasible);
    assert_int_equal(runs_into_the_night(s, "S18"), 0);
    fw_schedule_shop shop = *s->shop;
    fw_schedule_task *task = fw_arena_array(arena, fw_schedule_task, (size_t)shop.ntask);
    memcpy(task, shop.task, (size_t)shop.ntask * sizeof *task);
    int parted = 0;
    for (int i = 0; i < shop.ntask; i++) {
        parted += task[i].in_parts;
        task[i].in_parts = false;
    }
    assert_int_equal(parted, 1);
    shop.task = task;
    assert_int_equal(fw_schedule_solve(arena, &shop, 10, &free_of_it), FW_OK);
    assert_true(runs_into_the_night(&free_of_it, "S18") > 0); /* so that the case asks something */
    assert_true(s->bound.best_s >= free_of_it.bound.best_s - 1e-6);
    /* where no day is so long it is run all the same */
    options.day = "08:00-09:30 from 2026-11-23";
    options.wafers = 1;
    assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
    for (int i = 0; i < s->shop->ntask; i++)
        assert_false(s->shop->task[i].in_parts);
}

/* the open time of a machine, quarter by quarter */
static void worked(void **state) {
    (void)state;
    const int cases = test_fewest(test_cases(400, 100), 25);
    for (int i = 0; i < cases; i++) {
        double closed[1][2] = {{DAY * (double)below(7), 0.0}};
        closed[0][1] = closed[0][0] + DAY * (1.0 + below(2));
        int open = below(12);
        fw_schedule_calendar hours = {.open_s = open * HOUR,
                                      .close_s = (open + 4 + below(9)) * HOUR,
                                      .weekends = true,
                                      .closed_days = (unsigned)below(127)};
        fw_schedule_machine m = {
            .hours = &hours, .nhours = 1, .closed_s = closed, .nclosed = below(2)};
        double from = 900.0 * below(4 * 24 * 10), t = from, left = 900.0 * (1 + below(4 * 24));
        double got = fw_schedule_machine_worked(&m, from, left, 900.0);
        for (; left > 0.0; t += 900.0)
            if (inside(&m, t, t + 900.0)) left -= 900.0;
        assert_near(got, t, 1e-6);
    }
}

/* people are there when the machine is not: no date is named as if there were a schedule */
static void hours_that_never_meet(void **state) {
    (void)state;
    fw_process_flow *f = with("<tool equipment=\"rie\" open=\"19:00-23:00\"/>", FW_OK);
    fw_schedule_options options = {.wafers = 1};
    const fw_schedule *s;
    assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
    assert_false(s->feasible);
    assert_non_null(strstr(s->why, "never meet"));
    options.day = "12:00-22:00"; /* somebody starts it in time */
    assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
    assert_true(s->feasible);
}

static void refused(void **state) {
    (void)state;
    static const struct {
        const char *tools, *says, *day;
        bool read; /* it is refused when the pack is read, else by the schedule */
    } bad[] = {
        {"<tool equipment=\"ria\" open=\"09:00-13:00\"/>", "did you mean 'rie'", NULL, true},
        {"<tool equipment=\"rie\"/>", "either when it is open", NULL, true},
        {"<tool equipment=\"rie\" open=\"09:00-13:00\" closed=\"2026-11-24\"/>", "either when",
         NULL, true},
        {"<tool equipment=\"rie\" open=\"9-13\"/>", "is not like 09:00-17:00", NULL, false},
        {"<tool equipment=\"rie\" open=\"09:00-13:00\" days=\"Mo\"/>", "are not some of Mon", NULL,
         false},
        {"<tool equipment=\"rie\" open=\"09:00-10:00\"/>", "never open for so long", NULL, false},
        {"<tool equipment=\"rie\" open=\"09:00-13:00\" days=\"Mon\"/><tool equipment=\"rie\" "
         "open=\"09:00-13:00\" days=\"Tue\"/>",
         "never open for so long", NULL, false},
        {"<tool equipment=\"rie\" closed=\"2026-11-24\"/>", "the plan has none", NULL, false},
        {"<tool equipment=\"rie\" closed=\"2026-11-24\" to=\"2026-11-23\"/>", "are not two dates",
         "08:00-18:00 from 2026-11-23", false},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_process_flow *f = with(bad[i].tools, bad[i].read ? FW_INPUT : FW_OK);
        const fw_schedule *s;
        fw_schedule_options options = {.wafers = 1, .day = bad[i].day};
        if (!bad[i].read)
            assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_INPUT);
        const fw_diag *d = said_of(376, bad[i].says);
        if (!d || !d->place.line) fail_msg("case %zu: no FW-D376 with '%s'", i, bad[i].says);
    }
}

static bool is_run_of(const fw_schedule *s, int run, const char *step) {
    return strcmp(s->shop->task[s->run[run].task].id, step) == 0;
}

/* A bath that keeps for an hour is mixed for two wafers at a time, and these are in it within the hour; one that keeps for less than
   what lies between has no schedule, which names it. Without that it is mixed once. What is mixed at the bench is told. */
static void baths_keep(void **state) {
    (void)state;
    static const double keeps_s[] = {0.0, 3600.0, 300.0};
    for (int i = 0; i < 3; i++) {
        fw_process_flow *f = computed_pack("copper-on-porous-silicon", NULL, NULL);
        measured(f, "bath.serves", 2.0, 0.0);
        measured(f, "bath.keeps", keeps_s[i], 0.0);
        ((fw_quantity *)fw_process_flow_quantity(f, "bath.keeps"))->unknown = i == 0;
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        const fw_schedule_options options = {.wafers = 5, .operators = 2, .effort = 20};
        const fw_schedule *s;
        assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
        assert_int_equal(s->feasible, i < 2);
        if (i == 2) {
            assert_non_null(strstr(s->why, "a filling of anodising bath, mixed in C03, keeps no longer (bath.keeps)"));
            continue;
        }
        int mixed = 0, used = 0;
        for (int k = 0; k < s->nrun; k++) {
            mixed += is_run_of(s, k, "C03");
            if (!is_run_of(s, k, "C05")) continue;
            used++;
            for (int m = 0; m < s->nrun; m++) {
                const fw_schedule_run *r = &s->run[m];
                if (!is_run_of(s, m, "C03") || s->run[k].first < r->first || s->run[k].first >= r->first + r->count) continue;
                assert_true(s->run[k].start_s >= r->end_s);
                if (i == 1) assert_true(s->run[k].start_s - r->end_s <= 3600.0 + 1e-6);
            }
        }
        assert_int_equal(used, 5);
        assert_int_equal(mixed, i == 1 ? 3 : 1);
        assert_null(said_of(739, ""));
    }
    fw_process_flow *f = computed_pack("copper-on-porous-silicon", NULL, NULL);
    measured(f, "bath.keeps", 60.0, 0.0);
    measured(f, "cu.bath-serves", 4.0, 0.0);
    for (int i = 0; i < f->nbath; i++) { /* that one is made to keep, in place of the other */
        fw_process_bath *bath = (fw_process_bath *)&f->bath[i];
        const bool plating = strcmp(bath->id, "plating") == 0, anodising = strcmp(bath->id, "anodising") == 0;
        if (anodising) bath->keeps = NULL;
        if (plating) bath->keeps = fw_process_flow_quantity(f, "bath.keeps");
    }
    const fw_schedule_options options = {.wafers = 2, .effort = 20};
    const fw_schedule *s;
    assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
    assert_true(s->feasible);
    assert_non_null(said_of(739, "a filling of plating bath keeps for 60 s (bath.keeps), and this schedule has wafer 2 in it, in C22, "));
}

/* Where no order is found with as few fillings as there may be: the wafers of one are brought to it one soon after the other, and it
   is mixed for fewer of them, which is told. Two wafers of one filling of 40 min are in it by 35 min where one waits until the other
   is out of it (found by hand); three never are, whatever it serves. Where no number of them helps the message says what was tried;
   a filling of which nobody knows what it serves is mixed more often, too, where not all of the lot come to it on the day of its mixing. */
static void mixed_oftener(void **state) {
    (void)state;
    static const struct {
        int wafers, operators;
        double serves, keeps_min; /* 0: not known */
        int fillings, told;
    } of[] = {
        {2, 1, 2, 40, 1, 0}, {5, 1, 1, 40, 5, 0}, {5, 1, 3, 40, 3, 1}, {5, 1, 5, 40, 3, 1}, {3, 1, 3, 25, 3, 1}, {3, 1, 3, 40, 0, 0}, {6, 1, 0, 720, 3, 1},
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        fw_process_flow *f = computed_pack("copper-on-porous-silicon", NULL, NULL);
        measured(f, "bath.serves", fmax(of[i].serves, 1.0), 0.0);
        measured(f, "bath.keeps", 60.0 * of[i].keeps_min, 0.0);
        ((fw_quantity *)fw_process_flow_quantity(f, "bath.serves"))->unknown = !(of[i].serves > 0.0);
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        for (int k = 0; k < f->nstep && of[i].fillings == 0; k++) /* rinsed together, each within a minute: never */
            if (strcmp(f->step[k].id, "C06") == 0) ((fw_process_step *)&f->step[k])->batch = 99;
        const fw_schedule_options options = {.wafers = of[i].wafers,
                                             .operators = of[i].operators,
                                             .effort = 20,
                                             .day = of[i].serves > 0.0 ? "08:00-12:00,13:00-18:00 from 2026-12-21" : "08:00-10:00"};
        const fw_schedule *s;
        const size_t before = diags.count;
        int told = 0, fillings = 0;
        assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
        for (size_t k = before; k < diags.count; k++)
            told += diags.item[k].number == 758;
        if (of[i].fillings == 0) {
            assert_false(s->feasible);
            assert_non_null(strstr(s->why, "keeps no longer (bath.keeps)"));
            assert_non_null(strstr(s->why, "a filling for every wafer by itself was tried, too, in C03"));
            continue;
        }
        if (!s->feasible) fail_msg("%zu: %s", i, s->why);
        check_schedule(s);
        for (int k = 0; k < s->nrun; k++)
            fillings += is_run_of(s, k, "C03");
        if (told != of[i].told || fillings != of[i].fillings) fail_msg("%zu: told %d times, %d fillings", i, told, fillings);
        for (int k = 0; k < s->nrun; k++) { /* by themselves: no wafer is in what keeps no longer */
            if (!is_run_of(s, k, "C05")) continue;
            double mixed_s = -1.0;
            for (int m = 0; m < s->nrun; m++)
                if (is_run_of(s, m, "C03") && s->run[k].first >= s->run[m].first && s->run[k].first < s->run[m].first + s->run[m].count) mixed_s = s->run[m].end_s;
            assert_true(mixed_s >= 0.0 && s->run[k].start_s - mixed_s <= 60.0 * of[i].keeps_min + 1e-6);
        }
        const int *loads; /* what they take is counted in the bill of the lot */
        fw_process_bill bill;
        assert_int_equal(fw_schedule_loads(arena, s, f, &loads), FW_OK);
        assert_int_equal(fw_process_flow_bill(arena, f, of[i].wafers, loads, &bill), FW_OK);
        for (int k = 0; k < bill.nbath; k++)
            if (strcmp(bill.bath[k].bath->id, "anodising") == 0 && of[i].serves > 0.0) assert_int_equal(bill.bath[k].fillings, fillings);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(earliest_fit, setup, teardown),
        cmocka_unit_test_setup_teardown(in_parts, setup, teardown),
        cmocka_unit_test_setup_teardown(every_run, setup, teardown),
        cmocka_unit_test_setup_teardown(worked, setup, teardown),
        cmocka_unit_test_setup_teardown(hours_that_never_meet, setup, teardown),
        cmocka_unit_test_setup_teardown(refused, setup, teardown),
        cmocka_unit_test_setup_teardown(baths_keep, setup, teardown),
        cmocka_unit_test_setup_teardown(mixed_oftener, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
