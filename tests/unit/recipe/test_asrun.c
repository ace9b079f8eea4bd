/* SPDX-License-Identifier: GPL-3.0-or-later */
/* As-run logs: what is written is read back, every change of a written log is seen, and planned
   against actual says what is out of its limits. */
#include "../process/packs.h"
#include "base/output.h"
#include "process/process_law.h"
#include "recipe/asrun.h"
#include "recipe/asrun_parts.h"
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <signal.h>
#include <unistd.h>

static fw_arena *arena;
static fw_diags diags;
static fw_process_flow *flow;
static const char plan[] = "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff";

static double now = (double)NAN; /* of the clock; NaN: there is none */
static const fw_recipe_counted all_count = {0};
static const char *lot_wafers = NULL, *lot_zone = NULL; /* of logs that begin */
static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    diags = fw_diags_new(arena);
    flow = read_pack(arena, COPPER, NULL, NULL, &diags);
    return fw_process_flow_compute(arena, flow, &plain_facts, &diags) == FW_OK ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    lot_wafers = lot_zone = NULL;
    now = (double)NAN;
    fw_arena_free(arena);
    return 0;
}

static fw_status read_log(const char *text, size_t n, fw_recipe_asrun *run) {
    diags = fw_diags_new(arena);
    return fw_recipe_asrun_read(arena, flow, plan, "lot.log", text, n, &diags, run);
}

/* the log with one entry more; NULL: refused with `number` */
static const char *with(const char *log, const char *words, int number) {
    fw_recipe_asrun run;
    const char *line = NULL;
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    fw_status status = fw_recipe_asrun_add(arena, flow, &run, words, (fw_place){"entry", 1, 1}, now,
                                           &diags, &line);
    if (number) {
        assert_int_equal(status, FW_INPUT);
        assert_int_equal(diags.item[diags.count - 1].number, number);
        return NULL;
    }
    if (status != FW_OK) fail_msg("%s: %s", words, diags.item[diags.count - 1].message);
    return fw_arena_printf(arena, "%s%s", log, line);
}

static const char *begun(void) {
    const char *line;
    assert_int_equal(fw_recipe_asrun_begin(arena, flow, plan, "lot 7", lot_wafers, lot_zone, &line),
                     FW_OK);
    return line;
}

static const char *three(void) {
    const char *log = with(begun(), "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB", 0);
    log = with(log,
               "C21;start=2026-11-20T10:09:00;end=2026-11-20T10:14:00;by=AB;contact resistance=0.4",
               0);
    return with(log,
                "C22; start=2026-11-20T10:30:00; end=2026-11-20T10:52:30; by=AB; second=CD; "
                "thickness=7.9; tool=plater 2; bath=17; note=it was so",
                0);
}

/* 7.9 um are too little, and another run put it right: it has been so all the same; what is read later of the same run is
   no other run, and its times count once */
static void what_was_put_right_stands(void **state) {
    (void)state;
    fw_recipe_asrun run;
    fw_recipe_deviation *list;
    fw_recipe_asrun_total total;
    int n, of[2] = {0, 0};
    lot_wafers = "1,2";
    const char *log = with(
        begun(),
        "C23; start=2026-11-20T12:00; end=2026-11-20T12:40; by=AB; wafer=1; thickness=7.9 um", 0);
    log = with(
        log, "C23; start=2026-11-20T13:00; end=2026-11-20T13:09; by=AB; wafer=1; thickness=9.1 um",
        0);
    log = with(
        log, "C23; start=2026-11-20T14:00; end=2026-11-20T14:40; by=AB; wafer=2; thickness=7.8 um",
        0);
    log = with(log,
               "C23; start=2026-11-20T14:00; end=2026-11-20T14:40; by=AB; wafer=2; spread of "
               "thickness=3 %",
               0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
    for (int i = 0; i < n; i++)
        of[list[i].repeated]++;
    assert_int_equal(of[1], 2); /* 40 min, and 7.9 um */
    assert_int_equal(of[0], 2); /* 7.8 um, and 40 min once */
    assert_int_equal(fw_recipe_asrun_sum_up(flow, &run, arena, &total), FW_OK);
    assert_int_equal(total.out, 2);
    fw_text text = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_non_null(strstr(text.data,
                           "out of limits in runs that were repeated:\n"
                           "C23, wafer 1, 2026-11-20T12:00, by AB: duration was 40 min"));
    assert_non_null(strstr(text.data, "thickness was 7.9 um; allowed 8.1 to 9.9 um"));
    assert_null(strstr(text.data, "thickness was 7.8 um"));
}

/* Faraday's law has the time of a thickness: 45 min at 20 mA/cm2 make 18 um, and 9.1 um are written. At half the current they
   do, and so does any other step whose law has the time of what it adds or takes away; a bake's time is none of its height */
static void a_thickness_goes_with_its_time(void **state) {
    (void)state;
    static const struct {
        const char *words, *told, *before;
    } entry[] = {
        {"C22; start=2026-11-20T10:00; end=2026-11-20T10:45; by=AB; thickness=9.1",
         "step C22: thickness = 9.1 um does not go with the time that it took: that makes 18 um "
         "(16.6 to 19.3 um), by t = d rho P n "
         "F/(eta J M) in 42 min",
         NULL},
        {"C22; start=2026-11-20T10:00; end=2026-11-20T10:22; by=AB; thickness=9.1", NULL, NULL},
        {"C22; start=2026-11-20T10:00; end=2026-11-20T10:05; by=AB; thickness=9.1",
         "that makes 2.14 um", NULL},
        {"C22; start=2026-11-20T10:00; end=2026-11-20T10:45; by=AB; thickness=9.1; set current "
         "density=10 mA/cm2",
         NULL, NULL},
        {"C22; start=2026-11-20T10:00; end=2026-11-20T10:22; by=AB; thickness=9.1; set current "
         "density=10 mA/cm2",
         "that makes 4.71 um", NULL},
        {"C13; start=2026-11-20T10:00; end=2026-11-20T10:01; by=AB; resist height=20 um", NULL,
         NULL},
        /* the missing charge: both runs make it, each at its own current; resist that was stripped in between begins anew */
        {"C22; start=2026-11-20T10:20; end=2026-11-20T10:31; by=AB; thickness=9.1", NULL,
         "C22; start=2026-11-20T10:00; end=2026-11-20T10:11; by=AB"},
        {"C22; start=2026-11-20T10:20; end=2026-11-20T10:31; by=AB; thickness=9.1", NULL,
         "C22; start=2026-11-20T09:50; end=2026-11-20T10:12; by=AB; set current density=10 mA/cm2"},
        {"C22; start=2026-11-20T10:20; end=2026-11-20T10:31; by=AB; thickness=9.1", "that makes ",
         "C22; start=2026-11-20T09:28; end=2026-11-20T09:50; by=AB"},
    };
    for (size_t i = 0; i < sizeof entry / sizeof entry[0]; i++) {
        fw_recipe_asrun run;
        fw_recipe_deviation *list;
        bool told = false, listed = false;
        int n;
        const char *log = entry[i].before ? with(begun(), entry[i].before, 0) : begun();
        log = with(log, entry[i].words, 0);
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        assert_int_equal(fw_recipe_asrun_ask_time(arena, &run, &run.entry[run.nentry - 1],
                                                  (fw_place){"entry", 1, 1}, &diags),
                         FW_OK);
        for (size_t k = 0; k < diags.count; k++) {
            if (diags.item[k].number != 654) continue;
            told = true;
            if (!entry[i].told || !strstr(diags.item[k].message, entry[i].told))
                print_message("%s\n", diags.item[k].message);
            assert_true(entry[i].told && strstr(diags.item[k].message, entry[i].told));
        }
        assert_int_equal(told, entry[i].told != NULL);
        assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
        for (int k = 0; k < n; k++)
            listed = listed || strcmp(list[k].what, "thickness for its time") == 0;
        assert_int_equal(listed, told);
    }
}

/* a wafer is in one place: what was entered of it before goes on, and another wafer's does not count, nor a bath that is mixed */
static void a_wafer_is_in_one_place(void **state) {
    (void)state;
    static const struct {
        const char *words;
        bool told;
    } next[] = {
        {"C10; start=2026-11-20T10:03; end=2026-11-20T10:05; by=AB; wafer=1", true},
        {"C10; start=2026-11-20T10:05; end=2026-11-20T10:07; by=AB; wafer=1", false},
        {"C10; start=2026-11-20T10:03; end=2026-11-20T10:05; by=AB; wafer=2", false},
        {"C09; start=2026-11-20T10:03; end=2026-11-20T10:05; by=AB; wafer=1", false},
        {"C03; start=2026-11-20T10:03; end=2026-11-20T10:05; by=AB; second=CD; wafer=1", false}};
    lot_wafers = "1,2";
    const char *log =
        with(begun(), "C09; start=2026-11-20T10:00; end=2026-11-20T10:05; by=AB; wafer=1", 0);
    for (size_t i = 0; i < sizeof next / sizeof next[0]; i++) {
        bool told = false;
        with(log, next[i].words, 0);
        for (size_t k = 0; k < diags.count; k++)
            told = told || strstr(diags.item[k].message,
                                  "the same wafer was in step C09: one of these times");
        assert_int_equal(told, next[i].told);
    }
}

static void what_is_written_is_read(void **state) {
    (void)state;
    fw_recipe_asrun run;
    const char *log = with(begun(), "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB", 0);
    log = with(log,
               "C22; start=2026-11-20T10:30:05; end=2026-11-20T10:52:30; by=AB; second=C D; "
               "thickness=7.9; tool=plater 2; bath=17; note=a = b",
               0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_string_equal(run.lot, "lot 7");
    assert_string_equal(run.plan, plan);
    assert_int_equal(run.nentry, 2);
    const fw_recipe_asrun_entry *e = &run.entry[1];
    assert_string_equal(e->step->id, "C22");
    assert_near(e->end_s - e->start_s, 1345.0, 0.0);
    assert_near(e->start_s - run.entry[0].end_s, 1265.0, 0.0);
    assert_string_equal(e->second, "C D");
    assert_string_equal(e->tool, "plater 2");
    assert_string_equal(e->note, "a = b");
    assert_int_equal(e->nmeasured, 1);
    assert_string_equal(e->measured[0].measure, "thickness");
    assert_near(e->measured[0].number, 7.9, 0.0);
}

/* 150 min of the night in which the clock is set back are 90 min of what it shows, and 9 min of that in which it is set
   forward are 69 */
static void clocks_that_are_changed(void **state) {
    (void)state;
    static const char zone[] = "CET-1CEST,M3.5.0,M10.5.0/3";
    static const struct {
        const char *zone, *start, *end;
        double took_min; /* 0: refused with */
        int number;
    } entry[] = {
        {zone, "2026-10-25T01:00", "2026-10-25T03:00", 180, 0},
        {zone, "2026-10-25T01:00", "2026-10-25T02:30", 0, 717},
        {zone, "2026-10-25T01:00", "2026-10-25T02:30+01:00", 150, 0},
        {zone, "2026-10-25T01:00", "2026-10-25T00:30Z", 90, 0},
        {zone, "2026-10-25T02:50+02:00", "2026-10-25T02:10+01:00", 20, 0},
        {zone, "2026-10-25T02:50+02:00", "2026-10-25T02:40 UTC+02:00", 0, 282},
        {zone, "2026-03-29T01:55", "2026-03-29T03:04", 9, 0},
        {zone, "2026-03-29T02:30", "2026-03-29T03:04", 0, 717},
        {zone, "2026-03-29T01:30", "2026-03-29T02:00", 0, 717},
        {zone, "2026-11-20T10:00", "2026-11-20T10:20", 20, 0},
        {"UTC+05:30", "2026-10-25T01:00", "2026-10-25T02:30", 90, 0},
        {"UTC", "2026-10-25T01:00", "2026-10-25T02:30+01:00", 30, 0},
        {"NZST-12NZDT,M9.5.0,M4.1.0/3", "2026-04-05T01:00", "2026-04-05T04:00", 240, 0}, /* south */
        {NULL, "2026-10-25T01:00", "2026-10-25T02:30", 90, 0},
        {NULL, "2026-10-25T01:00+02:00", "2026-10-25T02:30+01:00", 150, 0},
        {NULL, "2026-10-24T23:00Z", "2026-10-25T02:30+01:00", 150, 0},
        {NULL, "2026-10-25T01:00+02:00", "2026-10-25T02:30", 0, 718},
        {NULL, "2026-10-25T01:00", "2026-10-25T02:30+01:00", 0, 718}};
    for (size_t i = 0; i < sizeof entry / sizeof entry[0]; i++) {
        fw_recipe_asrun run;
        lot_zone = entry[i].zone;
        const char *log = with(
            begun(),
            fw_arena_printf(arena, "C20; start=%s; end=%s; by=A", entry[i].start, entry[i].end),
            entry[i].number);
        if (entry[i].number) continue;
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        assert_near(run.entry[0].end_s - run.entry[0].start_s, 60.0 * entry[i].took_min, 0);
        assert_true(lot_zone ? strcmp(run.zone, lot_zone) == 0 : !run.zone);
    }
    /* waits between entries, too, and who once says it goes on saying it */
    fw_recipe_asrun run;
    lot_zone = NULL;
    const char *log = with(begun(), "C20; start=2026-10-25T00:00; end=2026-10-25T00:09; by=AB", 0);
    log = with(log, "C20; start=2026-10-25T02:00+02:00; end=2026-10-25T02:10+02:00; by=AB", 0);
    log = with(log, "C21; start=2026-10-25T02:00+01:00; end=2026-10-25T01:05Z; by=AB", 0);
    with(log, "C22; start=2026-10-25T03:00; end=2026-10-25T03:20; by=AB; second=CD", 718);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_near(run.entry[1].start_s - run.entry[0].end_s, 60.0 * 111, 0);
    assert_near(run.entry[2].start_s - run.entry[1].end_s, 60.0 * 50, 0);
    assert_near(run.entry[2].end_s - run.entry[2].start_s, 300.0, 0);
    fw_text text = fw_text_new(arena);
    lot_zone = zone;
    log = with(begun(), "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB", 0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_non_null(strstr(text.data, "times of CET-1CEST,M3.5.0,M10.5.0/3"));
    fw_text json = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_non_null(strstr(json.data, "\"zone\":\"CET-1CEST,M3.5.0,M10.5.0/3\""));
}

static void dates(void **state) {
    (void)state;
    static const struct {
        const char *time;
        double days; /* since 1970-01-01, from any calendar */
    } day[] = {{"1970-01-01T00:00", 0},     {"1972-02-29T00:00", 789},
               {"1972-03-01T00:00", 790},   {"2000-02-29T00:00", 11016},
               {"2000-12-31T00:00", 11322}, {"2026-11-20T00:00", 20777},
               {"2100-03-01T00:00", 47541}};
    for (size_t i = 0; i < sizeof day / sizeof day[0]; i++) {
        fw_recipe_asrun run;
        const char *words =
            fw_arena_printf(arena, "C20; start=%s; end=%s; by=A", day[i].time, day[i].time);
        const char *log = with(begun(), words, 0);
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        assert_near(run.entry[0].start_s, 86400.0 * day[i].days, 0.0);
    }
    static const char *const wrong[] = {
        "2026-11-31T00:00",       "2026-02-29T00:00",     "2100-02-29T00:00",
        "2026-13-01T00:00",       "2026-00-01T00:00",     "2026-11-20T24:00",
        "2026-11-20T10:60",       "2026-11-20 10:00",     "20.11.2026",
        "2026-11-20T10:00z",      "2026-11-20T10:0a",     "2026-11-20T10:00+1",
        "2026-11-20T10:00+15:00", "2026-11-20T10:00 CET", "2026-11-20T10:00+01:60"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        with(begun(), fw_arena_printf(arena, "C20; start=%s; end=2026-11-21T00:00; by=A", wrong[i]),
             282);
}

static void refused_entries(void **state) {
    (void)state;
    static const char *const bad[] = {
        "",
        "C99; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB",
        "C20; end=2026-11-20T10:09; by=AB",
        "C20; start=2026-11-20T10:00; by=AB",
        "C20; start=2026-11-20T10:00; end=2026-11-20T10:09",
        "C20; start=2026-11-20T10:10; end=2026-11-20T10:09; by=AB",
        "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB; by=CD",
        "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB; colour=red",
        "C22; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB; thickness=thick",
        "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB; note",
        "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=A\tB",
        "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=A\nB",
        /* hydrofluoric acid: two people, and two different ones */
        "C05; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB",
        "C05; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB; second=AB",
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        with(begun(), bad[i], 282);
}

/* every byte, every line */
static void changes_are_seen(void **state) {
    (void)state;
    fw_recipe_asrun run;
    const char *log = three();
    size_t n = strlen(log);
    char *copy = fw_arena_strndup(arena, log, n);
    for (size_t i = 0; i < n; i++) {
        char was = copy[i];
        copy[i] = (char)(was == '0' ? '1' : '0');
        assert_int_not_equal(read_log(copy, n, &run), FW_OK);
        copy[i] = was;
    }
    for (size_t cut = 0; cut < n; cut++) { /* only whole lines are a log */
        fw_status status = read_log(fw_arena_strndup(arena, log, cut), cut, &run);
        assert_int_equal(status == FW_OK, cut > 0 && log[cut - 1] == '\n');
    }
    const char *second = strchr(log, '\n') + 1, *third = strchr(second, '\n') + 1;
    const char *without = fw_arena_printf(arena, "%.*s%s", (int)(second - log), log, third);
    assert_int_equal(read_log(without, strlen(without), &run), FW_INPUT);
    assert_int_equal(diags.item[0].number, 280);
    assert_int_equal(diags.item[0].place.line, 2);
    const char *twice = fw_arena_printf(arena, "%s%s", log, third);
    assert_int_equal(read_log(twice, strlen(twice), &run), FW_INPUT);
}

/* a looked-at measure has one answer, or one for each site; never another number of them */
static void answers_are_one_or_of_all_sites(void **state) {
    (void)state;
    static const char start[] =
        "C20; start=2026-11-20T11:00; end=2026-11-20T11:10; by=AB; copper bright in the mould=";
    const fw_process_step *s = step_of(flow, "C20");
    int sites = 0;
    for (int i = 0; i < s->naccept; i++)
        if (strcmp(s->accept[i].measure, "copper bright in the mould") == 0)
            sites = s->accept[i].sites;
    assert_true(sites >= 1);
    fw_text all = fw_text_new(arena);
    for (int i = 1; i <= sites + 2; i++) {
        fw_text_add(&all, i % 2 ? " yes" : " no");
        with(begun(), fw_arena_printf(arena, "%s%s", start, all.data + 1),
             i == 1 || i == sites ? 0 : 282);
    }
    with(begun(), fw_arena_printf(arena, "%syes 3", start), 282);
}

/* what a terminal takes for orders is not written, and what an older log holds is not shown */
static void orders_are_not_logged(void **state) {
    (void)state;
    static const char start[] = "C20; start=2026-11-20T11:00; end=2026-11-20T11:10; by=AB; copper "
                                "bright in the mould=yes; note=";
    static const char *const order[] = {"a\x1b[31m", "a\xc2\x9b\x32J", "a\xe2\x80\xae",
                                        "a\x7f",     "9 \xb5m",        "a\tb"};
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++)
        with(begun(), fw_arena_printf(arena, "%s%s", start, order[i]), 282);
    const char *good = with(begun(), fw_arena_printf(arena, "%s9 \xc2\xb5m", start), 0);
    fw_recipe_asrun run;
    assert_int_equal(read_log(good, strlen(good), &run), FW_OK);
    assert_string_equal(run.entry[0].note, "9 \xc2\xb5m");
    /* the same line as somebody else may write it, with its chain */
    const char *first = begun(), *tail = strstr(first, "\tchain=");
    const char *words = "step=C20\tstart=2026-11-20T11:00\tend=2026-11-20T11:10\tby=A\x1b["
                        "2J\tcopper bright in the mould=yes\tnote=\xff";
    char chain[65];
    const char *both = fw_arena_printf(arena, "%.64s\n%s", tail + 7, words);
    fw_sha256(both, strlen(both), chain);
    const char *foreign = fw_arena_printf(arena, "%s%s\tchain=%s\n", first, words, chain);
    assert_int_equal(read_log(foreign, strlen(foreign), &run), FW_OK);
    assert_string_equal(run.entry[0].by, "A [2J");
    assert_string_equal(run.entry[0].note, "\xef\xbf\xbd");
    /* a first line without its plan is damaged, not a lack of memory */
    const char *bare = "flexwright as-run 1\tflow=" COPPER;
    both = fw_arena_printf(arena, "\n%s", bare);
    fw_sha256(both, strlen(both), chain);
    bare = fw_arena_printf(arena, "%s\tchain=%s\n", bare, chain);
    assert_int_equal(read_log(bare, strlen(bare), &run), FW_INPUT);
    assert_int_equal(diags.item[0].number, 280);
}

static void another_plan(void **state) {
    (void)state;
    fw_recipe_asrun run;
    const char *log = three();
    diags = fw_diags_new(arena);
    const char *other = fw_arena_printf(arena, "f%s", plan + 1);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, other, "lot.log", log, strlen(log), &diags, &run),
        FW_INPUT);
    assert_int_equal(diags.item[0].number, 281);
    fw_process_flow *silicon = read_pack(arena, SILICON, NULL, NULL, &diags);
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_recipe_asrun_read(arena, silicon, plan, "lot.log", log, strlen(log), &diags, &run),
        FW_INPUT);
    assert_int_equal(diags.item[0].number, 281);
}

static bool holds(const fw_text *text, const char *words) {
    return strstr(text->data, words) != NULL;
}

/* stamps to the minute leave a minute either way: C21 is planned for 10 min, from the first look at 6 min to 14 min */
static void clocks_are_read_to_the_minute(void **state) {
    (void)state;
    static const struct {
        const char *start, *end, *judged;
    } at[] = {{"10:00", "10:05", "in window"},   {"10:00", "10:04", "short"},
              {"10:00:00", "10:05:00", "short"}, {"10:00:00", "10:06:00", "in window"},
              {"10:00", "10:15", "in window"},   {"10:00", "10:16", "long"},
              {"10:00:00", "10:14:30", "long"},  {"10:00:00", "10:15", "in window"}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        fw_recipe_asrun run;
        fw_text json = fw_text_new(arena);
        const char *log =
            with(begun(),
                 fw_arena_printf(arena, "C21; start=2026-11-20T%s; end=2026-11-20T%s; by=AB",
                                 at[i].start, at[i].end),
                 0);
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
        if (!holds(&json, fw_arena_printf(arena, "\"judged\":\"%s\"", at[i].judged)))
            fail_msg("%s to %s is not %s", at[i].start, at[i].end, at[i].judged);
        /* the sheet's own times beside what the machine is booked for */
        assert_true(holds(&json, "\"planned_s\":600,\"first_look_s\":360,\"stop_s\":840,\"at_"
                                 "machine_s\":600,\"at_machine_most_s\":840"));
    }
}

static void planned_against_actual(void **state) {
    (void)state;
    fw_recipe_asrun run;
    fw_text text = fw_text_new(arena), json = fw_text_new(arena);
    const char *log = three();
    log = with(log,
               "C20; start=2026-11-20T11:00; end=2026-11-20T11:10; by=AB; "
               "copper bright in the mould=no",
               0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_true(holds(&text, "thickness = 7.9 um: OUT of 8.1 to 9.9"));
    assert_true(holds(&text, "copper bright in the mould = no: OUT of yes"));
    assert_true(holds(&text, "contact resistance = 0.4 ohm: accepted"));
    assert_true(holds(&text, "(run 2 times)"));
    /* C21 took 5 min where 6 to 14 are planned; C20 was run again after C22, which came 21 min after the first one */
    assert_true(holds(&text, "3 of 28 steps run, 1 repeated, 4 outside of their limits"));
    assert_true(holds(&json, "\"actual_s\":1350,\"judged\":\"in window\""));
    assert_true(holds(&json, "\"judged\":\"short\""));
    assert_true(holds(&json, "\"measure\":\"thickness\",\"value\":7.9,\"unit\":\"um\","
                             "\"accepted\":false"));
    /* the same log without the repetition: 21 min after C20, and 15 are allowed */
    text = fw_text_new(arena);
    log = three();
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_true(holds(&text, "waited 21 min since C20: OUT of 0 s to 15 min"));
}

/* What was set reaches the law of the step: a time that is right as planned is wrong at half the current, or in a bath that
   etches faster, and the other way round. What is asked of the step is not replaced; a later entry of the same run goes by
   what an earlier one says; a run before counts as long as it would have been at what was set in the last one. */
static void what_was_set_counts(void **state) {
    (void)state;
#define AT(step, from, to)                                                                         \
    step "; start=2026-11-20T" from ":00; end=2026-11-20T" to ":00; by=AB; second=CD; "
    static const struct {
        bool silicon;
        const char *before, *words, *judged;
        double nominal_min; /* at what was set */
        int told;           /* FW-D684 */
    } of[] = {
        {false, NULL, AT("C22", "10:00", "10:24") "note=-", "in window", 21.038, 0},
        {false, NULL, AT("C22", "10:00", "10:21") "note=-", "unclear", 21.038,
         0}, /* with its rinse of 3 min in it */
        {false, NULL, AT("C22", "10:00", "10:21") "set current density=10 mA/cm2", "short", 42.076,
         0},
        {false, NULL, AT("C22", "10:00", "10:44") "set current density=10 mA/cm2", "in window",
         42.076, 0},
        {false, NULL, AT("C22", "10:00", "10:41") "note=-", "long", 21.038, 0},
        {false, NULL, AT("C22", "10:00", "10:24") "set copper thickness=18 um", "in window", 21.038,
         0},
        {false, AT("C22", "10:00", "10:21") "set current density=10 mA/cm2",
         AT("C22", "10:00", "10:21") "thickness=4.6 um", "short", 42.076, 0},
        {false, AT("C22", "09:30", "09:56") "set current density=10 mA/cm2",
         AT("C22", "10:00", "10:12") "note=-", "in window", 21.038, 0},
        {false, AT("C22", "09:30", "09:52") "note=-", AT("C22", "10:00", "10:10") "note=-", "long",
         21.038, 0},
        {true, NULL, AT("S14", "10:00", "10:20") "note=-", "in window", 16.667, 0},
        {true, NULL, AT("S14", "10:00", "10:17") "note=-", "unclear", 16.667,
         0}, /* with its rinse of 5 min in it */
        {true, NULL, AT("S14", "10:00", "10:17") "set etch rate=20 Ao/s", "long", 8.333, 0},
        {true, NULL, AT("S14", "10:00", "10:15") "set etch rate=20 Ao/s", "unclear", 8.333, 1},
        {true, AT("S14", "10:00", "10:15") "set etch rate=20 Ao/s",
         AT("S14", "10:00", "10:08") "note=-", "in window", 8.333, 0},
        {true, NULL, AT("S14", "10:00", "10:08") "set etch rate=20 Ao/s", "unclear", 8.333, 0},
        {true, NULL, AT("S14", "10:00", "10:08") "note=-", "short", 16.667, 0},
        {true, NULL, AT("S14", "10:00", "10:15") "set temperature=35 Cel", "unclear", 7.4, 1},
        {true, NULL, AT("S14", "10:00", "10:40") "set temperature=35 Cel", "long", 7.4, 0},
    };
    fw_process_flow *both[2] = {flow, read_pack(arena, SILICON, NULL, NULL, &diags)};
    assert_int_equal(fw_process_flow_compute(arena, both[1], &plain_facts, &diags), FW_OK);
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        fw_recipe_asrun run;
        fw_text json = fw_text_new(arena);
        int told = 0;
        flow = both[of[i].silicon];
        const char *log = of[i].before ? with(begun(), of[i].before, 0) : begun();
        log = with(log, of[i].words, 0);
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        const fw_recipe_asrun_entry *e = &run.entry[run.nentry - 1];
        if (strcmp(fw_recipe_asrun_in_time(&run, e), of[i].judged) != 0)
            fail_msg("%zu: %s", i, fw_recipe_asrun_in_time(&run, e));
        assert_near(e->as_set->time.nominal_s / 60.0, of[i].nominal_min, 0.03 * of[i].nominal_min);
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, e, (fw_place){"entry", 1, 1}, &diags), FW_OK);
        for (size_t k = 0; k < diags.count; k++)
            told += diags.item[k].number == 684;
        assert_int_equal(told, of[i].told);
        assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
        assert_int_equal(holds(&json, "\"as_set\":{\"planned_s\":"), e->as_set != e->step);
        assert_int_equal(holds(&json, "\"longer_unless_finished\":true"), of[i].told);
    }
#undef AT
}

/* ---- wafers, sites, settings, coupons ---- */

static const char of_C22[] =
    "C22; start=2026-11-20T10:30; end=2026-11-20T10:52; by=AB; second=CD; ";

static const char *entry(const char *more) {
    return fw_arena_printf(arena, "%s%s", of_C22, more);
}

static void sites_and_settings(void **state) {
    (void)state;
    fw_recipe_asrun run;
    lot_wafers = "1,2,A-7";
    const char *log = with(
        begun(),
        entry(
            "wafer=A-7; instrument=profilometer 2; thickness=9.1 9.0 9.2 9.15 8.9 um; "
            "thickness below the mould's top=left:0.0068 centre:0.0069 mm; "
            "set current density=0.0204 A/cm2; set bath temperature=24.5 Cel; set efficiency=96 %; "
            "coupon=plating-pads, drawn=1 mm, value=9.1 9.2 9.0 9.1 9.1 um, u=0.05 um, "
            "at=25 C/cm2, u-at=0.2 C/cm2"),
        0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(run.nwafer, 3);
    const fw_recipe_asrun_entry *e = &run.entry[0];
    assert_string_equal(e->wafer, "A-7");
    assert_string_equal(e->instrument, "profilometer 2");
    assert_int_equal(e->nmeasured, 2);
    assert_int_equal(e->measured[0].nsite, 5);
    assert_near(e->measured[0].number, 9.07, 1e-12);
    assert_near(e->measured[0].site[4], 8.9, 0.0);
    assert_int_equal(e->measured[1].nsite, 2);
    assert_near(e->measured[1].site[0], 6.9, 1e-12);
    assert_near(e->measured[1].site[2], 6.8, 1e-12);
    assert_true(isnan(e->measured[1].site[1]));
    assert_int_equal(e->nset, 3);
    assert_near(e->set[0].value, 20.4, 1e-12);
    assert_near(e->set[1].value, 24.5, 1e-12);
    assert_string_equal(e->set[2].q->id,
                        "cu.eta"); /* no setting, but the sheet has a cell for it */
    assert_int_equal(e->ncoupon, 1);
    const fw_process_measurement *m = &e->coupon[0].row;
    assert_near(m->drawn_m, 1e-3, 1e-18);
    assert_near(m->value, 9.1e-6, 1e-18);
    assert_near(m->uncertainty, 0.05e-6, 1e-18);
    assert_near(m->at, 25e4, 1e-9);
    assert_near(m->at_uncertainty, 2e3, 1e-9);
    assert_int_equal(e->coupon[0].nsite, 5);
    /* 20.4 mA/cm2 where 19.8 to 20.2 are allowed */
    fw_recipe_deviation *list;
    int n;
    assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
    assert_int_equal(n, 1);
    assert_string_equal(list[0].what, "setting current density");
    assert_string_equal(list[0].planned, "20; 19.8 to 20.2 mA/cm2");
    assert_string_equal(list[0].actual, "20.4 mA/cm2 (written 0.0204 A/cm2)");
    /* told and shown in the unit of the plan, whatever it was written in, and never without one */
    fw_text table = fw_text_new(arena), page = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
    assert_true(holds(&table, "set current density = 20.4 mA/cm2 (written 0.0204 A/cm2), planned "
                              "20 mA/cm2: OUT of 19.8 to 20.2 mA/cm2"));
    assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
    assert_true(holds(
        &page, "set current density = 20.4 mA/cm2 (written 0.0204 A/cm2), planned 20 mA/cm2"));
    diags = fw_diags_new(arena);
    assert_int_equal(fw_recipe_asrun_ask_values(e, (fw_place){"entry", 1, 1}, &diags), FW_OK);
    assert_int_equal(diags.count, 1);
    assert_non_null(strstr(diags.item[0].message, "current density = 20.4 mA/cm2 (written 0.0204 "
                                                  "A/cm2), the step allows 19.8 to 20.2 mA/cm2"));
}

/* for calibrate: each coupon once, by wafer; what is read again takes its place; the plan is not needed */
static void readings(void **state) {
    (void)state;
    static const char pads[] =
        "coupon=plating-pads, drawn=%d um, value=%s um, u=0.1 um, at=%d C/cm2";
    fw_recipe_asrun run;
    fw_process_readings r;
    lot_wafers = "1,2";
    const char *one = fw_arena_printf(arena, pads, 10, "9.0 9.2 9.4", 25),
               *two = fw_arena_printf(arena, pads, 1000, "9.1", 25),
               *other = fw_arena_printf(arena, pads, 1000, "9.1", 20),
               *again = fw_arena_printf(arena, pads, 10, "9.5 9.6", 25);
    const char *log = with(
        begun(), entry(fw_arena_printf(arena, "wafer=1; thickness=9 um; %s; %s", one, two)), 0);
    log = with(log, entry(fw_arena_printf(arena, "wafer=2; %s", one)), 0);
    log = with(log, entry(fw_arena_printf(arena, "wafer=1; %s; %s", other, again)), 0);
    /* of one run: what was written under at is corrected where a size is read again; a size that is not read again stays */
    static const char ladder[] =
        "coupon=undercut-ladder, width, drawn=%d um, value=%s um, u=0.08 um, at=%d um";
    const char *narrow = fw_arena_printf(arena, ladder, 8, "5.1", 49),
               *wrong = fw_arena_printf(arena, ladder, 16, "13.1", 49),
               *right = fw_arena_printf(arena, ladder, 16, "13.1", 51);
    log = with(log, entry(fw_arena_printf(arena, "wafer=2; %s; %s", narrow, wrong)), 0);
    log = with(log, entry(fw_arena_printf(arena, "wafer=2; %s", right)), 0);
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, NULL, "lot.log", log, strlen(log), &diags, &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &r), FW_OK);
    assert_int_equal(r.n, 5); /* of eight, three are read again */
    assert_near(r.item[3].row.at, 49e-6, 1e-12);
    assert_near(r.item[3].row.drawn_m, 8e-6, 1e-12);
    assert_near(r.item[4].row.at, 51e-6, 1e-12);
    /* which ones, by which line, and what to do where both shall count; and that what is left says two things of one run */
    int said[2] = {0};
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].number == 610 || diags.item[i].number == 611)
            said[diags.item[i].number - 610]++;
    assert_int_equal(said[0], 3);
    assert_int_equal(said[1], 2); /* pads of wafer 1, ladder of wafer 2 */
    fw_text text = fw_text_new(arena), json = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_non_null(strstr(
        text.data, fw_arena_printf(arena, "line 5, C22: %s; line 6: %s", wrong + 7, right + 7)));
    assert_non_null(strstr(text.data, "as sites of one value"));
    assert_non_null(
        strstr(json.data,
               fw_arena_printf(arena, "\"line\":5,\"coupon\":\"%s\",\"by_line\":6", wrong + 7)));
    assert_null(strstr(text.data, fw_arena_printf(arena, "C22: %s", narrow + 7)));
    assert_string_equal(r.lot, "lot 7");
    assert_string_equal(r.item[0].wafer, "2");
    assert_near(r.item[0].row.value, 9.2e-6, 1e-18);
    assert_near(r.item[0].squares, 0.08e-12, 1e-24);
    assert_int_equal(r.item[0].nsite, 3);
    assert_string_equal(r.item[0].date, "2026-11-20");
    assert_string_equal(r.item[0].step, "C22");
    assert_near(r.item[2].row.value, 9.55e-6, 1e-18);
}

/* The bath of a rate: what the coupon says, else what was set of the run that it is of, wherever it was read; not that of
   another wafer, nor of a run before the last one */
static void readings_of_warm_baths(void **state) {
    (void)state;
    static const char rate[] =
        "coupon=etch-rate, pan.R, value=0.62 0.61 0.63 um, u=0.01 um, at=5 min";
    static const char *const etch =
        "S14; start=2026-11-20T10:00; end=2026-11-20T10:17; by=AB; second=CD; wafer=1";
    static const char *const later =
        "S15; start=2026-11-20T11:00; end=2026-11-20T11:07; by=AB; wafer=%d; %s%s";
    static const struct {
        const char *etched, *again; /* NULL: not */
        int wafer;
        const char *more;
        double T, u;
    } of[] = {{"; set temperature=35 Cel", NULL, 1, "", 308.15, 0.288675},
              {"; set temperature=35.0 Cel", NULL, 1, "", 308.15, 0.0288675},
              {"; set temperature=35 Cel", NULL, 2, "", 0, 0},
              {"", NULL, 1, "", 0, 0},
              {"", NULL, 1, ", temperature=30 Cel, u-temperature=0.5 K", 303.15, 0.5},
              {"; set temperature=35 Cel", "", 1, "", 0, 0},
              {"; set temperature=35 Cel", "; set temperature=31 Cel", 1, "", 304.15, 0.288675}};
    flow = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    lot_wafers = "1,2";
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        fw_recipe_asrun run;
        fw_process_readings r;
        const char *log = with(begun(), fw_arena_printf(arena, "%s%s", etch, of[i].etched), 0);
        if (of[i].again)
            log = with(log,
                       fw_arena_printf(arena,
                                       "S14; start=2026-11-20T10:30; end=2026-11-20T10:32; by=AB; "
                                       "second=CD; wafer=1%s",
                                       of[i].again),
                       0);
        log = with(log, fw_arena_printf(arena, later, of[i].wafer, rate, of[i].more), 0);
        assert_int_equal(
            fw_recipe_asrun_read(arena, flow, NULL, "lot.log", log, strlen(log), &diags, &run),
            FW_OK);
        assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &r), FW_OK);
        assert_int_equal(r.n, 1);
        assert_near(r.item[0].row.condition[FW_CONDITION_TEMPERATURE], of[i].T, 1e-9);
        assert_near(r.item[0].row.condition_uncertainty[FW_CONDITION_TEMPERATURE], of[i].u, 1e-6);
    }
    fw_recipe_asrun run;
    fw_process_readings open;
    const char *log = with(
        begun(),
        fw_arena_printf(arena, "%s; %s, open-area=176.7 cm2, u-open-area=2 cm2", etch, rate), 0);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, NULL, "lot.log", log, strlen(log), &diags, &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &open), FW_OK);
    assert_near(open.item[0].row.condition[FW_CONDITION_OPEN_AREA], 176.7e-4, 1e-12);
    assert_near(open.item[0].row.condition_uncertainty[FW_CONDITION_OPEN_AREA], 2e-4, 1e-12);
    with(begun(), fw_arena_printf(arena, "%s; %s, open-area=35 um", etch, rate), 282);
    with(begun(), fw_arena_printf(arena, "%s; %s, temperature=35 um", etch, rate), 282);
    with(begun(),
         fw_arena_printf(arena, "%s; %s, temperature=35 Cel, u-temperature=-1 K", etch, rate), 282);
}

/* what the plan does not know is refused with what there is */
static void refused_values(void **state) {
    (void)state;
    static const struct {
        const char *words, *says;
        int number;
    } bad[] = {
        {"wafer=9", "there are: 1, 2, A-7", 282},
        {"wafer=A-8", "there are: 1, 2, A-7; did you mean 'A-7'?", 282},
        {"coupon=plating-pads, a, feature=b, drawn=1 mm, value=9 um, u=1 um, at=25 C/cm2",
         "'b' is a second feature", 282},
        {"wafer=", "not written as name=value", 282},
        {"thicknes=9.1 um", "did you mean 'thickness'", 282},
        {"thickness=9.1 s", "thickness is given in um", 282},
        {"thickness=9.1 9.0 um", "2 values, and is measured at 5 sites", 282},
        {"thickness=9.1 9.0 9 9 9 9 um", "five sites", 282},
        {"thickness=middle:9.1 um", "a site is centre", 282},
        {"thickness=left:9.1 left:9.0 um", "given twice", 282},
        {"thickness=left:9.1 9.0 um", "either all sites have names", 282},
        {"thickness=left:x um", "a number stands behind", 282},
        {"thickness=um", "give a number", 282},
        {"thickness=nan um", "give a number", 282},
        {"thickness=9.1 um; thickness=9.2 um", "given twice", 282},
        {"thickness=-9.1 mm", "plausible range", 278},
        {"thickness=9100 mm", "plausible range", 278},
        {"set power=200 W", "C22 sets no 'power'", 282},
        {"set current density=20 V", "current density is given in mA/cm2", 282},
        {"set current density=-20 mA/cm2", "plausible range", 278},
        {"set bath temperature=2400 Cel", "plausible range", 278},
        {"set current density=20 mA/cm2; set current density=20 mA/cm2", "given twice", 282},
        {"coupon=plating-pad, value=9 um, u=1 um", "did you mean 'plating-pads'", 211},
        {"coupon=plating-pads, drawn=1 mm, value=9 um, at=25 C/cm2", "add u=", 282},
        {"coupon=plating-pads, drawn=1 mm, value=9 s, u=1 s, at=25 C/cm2", "is measured as", 211},
        {"coupon=plating-pads, drawn=1 s, value=9 um, u=1 um, at=25 C/cm2", "no length", 282},
        {"coupon=plating-pads, drawn=1 mm, value=9 um, u=1 s, at=25 C/cm2", "another dimension",
         282},
        {"coupon=plating-pads, drawn=1 mm, value=9 um, u=-1 um, at=25 C/cm2", "not below 0", 282},
        {"coupon=plating-pads, drawn=1 mm, value=9 um, u=1 um", "needs the columns at", 211},
        {"coupon=plating-pads, value=9 um, u=1 um, at=25 C/cm2", "drawn_um", 211},
        {"coupon=plating-pads, drawn=1 mm, value=9 um, u=1 um, at=25 s", "which stands under at",
         211},
        {"coupon=cd-lines, drawn=9 um, value=9 um, u=1 um", "is line or space, not ''", 211},
        {"coupon=undercut-ladder, gon, drawn=9 um, value=9 um, u=1 um, at=9 min",
         "is width, gone or stands", 211},
        {"coupon=plating-pads, colour=red, value=9 um, u=1 um", "a coupon has no 'colour'", 282},
        {"coupon=plating-pads, drawn=1 mm, value=9000 km, u=1 um, at=25 C/cm2", "plausible range",
         278},
    };
    lot_wafers = "1,2,A-7";
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        with(begun(), entry(bad[i].words), bad[i].number);
        const char *said = diags.item[diags.count - 1].message;
        if (!strstr(said, bad[i].says)) fail_msg("%s: %s", bad[i].words, said);
    }
    with(begun(), entry("thickness=9.1 mm; thickness below the mould's top=6"), 0);
    assert_non_null(strstr(diags.item[1].message, "is the unit right?"));
    assert_true(diags.item[1].unreliable);
    with(begun(), entry("thickness=9.1 nm; thickness below the mould's top=6"), 0);
    assert_non_null(strstr(diags.item[1].message, "less than a hundredth of the 8.1 um"));
    lot_wafers = NULL; /* a log of before there were wafers */
    with(begun(), entry("wafer=1"), 282);
    with(begun(), entry("thickness=9.1"), 0);
}

static void wafer_lists(void **state) {
    (void)state;
    const char *wrong;
    assert_string_equal(fw_recipe_asrun_wafers(arena, "3", &wrong), "1,2,3");
    assert_string_equal(fw_recipe_asrun_wafers(arena, "W1,W2", &wrong), "W1,W2");
    static const char *const bad[] = {"", "a b", "1,,2", "1,1", "51,", "a\tb", ",", "1,2,", "a=b"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (fw_recipe_asrun_wafers(arena, bad[i], &wrong) || !wrong) fail_msg("'%s'", bad[i]);
}

/* Whatever is typed is refused or taken, and what is taken is read again as the same: entries with bytes changed, left out
   and doubled. */
static void anything_typed(void **state) {
    (void)state;
    static const char *const good[] = {
        "wafer=A-7; instrument=p 2; thickness=9.1 9.0 9.2 9.15 8.9 um; note=a = b, c",
        "thickness=left:9.1 top:9.0 um; set current density=20 mA/cm2; set bath temperature=4 Cel",
        "wafer=1; coupon=plating-pads, drawn=1 mm, value=9.1 9.2 9.0 um, u=0.05 um, at=25 C/cm2"};
    uint64_t seed = 11;
    int taken = 0;
    lot_wafers = "1,2,A-7";
    const char *log = begun();
    for (int i = 0; i < test_cases(60000, 6000); i++) {
        fw_mark mark = fw_arena_mark(arena);
        char *words = fw_arena_strdup(arena, entry(good[i % 3]));
        fw_recipe_asrun run, again;
        const char *line;
        for (int k = 0; k < 1 + i % 4; k++) {
            size_t n = strlen(words), at;
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            at = sizeof of_C22 - 1 + (size_t)(seed >> 33) % (n - sizeof of_C22 + 1);
            char other = " ;,=:.-0159aeu/\x01\xff"[(seed >> 20) % 17];
            if (seed >> 62)
                words[at] = other;
            else if (n > sizeof of_C22 + 4)
                memmove(words + at, words + at + 1, n - at);
        }
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        fw_status status = fw_recipe_asrun_add(arena, flow, &run, words, (fw_place){"entry", 1, 1},
                                               now, &diags, &line);
        assert_true(status == FW_OK || status == FW_INPUT);
        if (status == FW_OK) {
            const char *both = fw_arena_printf(arena, "%s%s", log, line);
            taken++;
            if (read_log(both, strlen(both), &again) != FW_OK) fail_msg("%s", line);
            assert_int_equal(again.nentry, 1);
            fw_text text = fw_text_new(arena);
            assert_int_equal(fw_recipe_asrun_write_text(flow, &again, &text), FW_OK);
        } else
            assert_true(diags.errors > 0);
        fw_arena_rewind(arena, mark);
    }
    assert_true(taken > 100);
}

/* each wafer has its own last entry */
static void wafers_are_no_repetitions(void **state) {
    (void)state;
    fw_recipe_asrun run;
    fw_text text = fw_text_new(arena), json = fw_text_new(arena), page = fw_text_new(arena);
    lot_wafers = "1,2";
    const char *log = with(begun(), entry("wafer=1; thickness=9.1 um"), 0);
    log = with(log,
               "C22; start=2026-11-20T11:00; end=2026-11-20T11:22; by=AB; second=CD; wafer=2; "
               "thickness=7.1 um",
               0);
    log = with(log, entry("wafer=1; thickness=9.2 um"), 0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_true(holds(&text, "1 of 28 steps run, 1 repeated, 1 outside of their limits"));
    assert_true(holds(&text, ", wafer 1 (run 2 times)"));
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_true(holds(&json, "\"wafer\":\"1\""));
    assert_true(holds(&json, "\"deviations\":[{\"step\":\"C22\",\"wafer\":\"2\",\"what\":"
                             "\"thickness\",\"planned\":\"8.1 to 9.9 um\",\"actual\":"
                             "\"7.1 um\",\"repeated\":false}]"));
    assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
    assert_true(holds(&page, "<svg"));
    assert_true(holds(&page, "too few for control limits, which need 8"));
    assert_true(holds(&page, "a value is not accepted"));
}

static int said(int number) {
    int n = 0;
    for (size_t i = 0; i < diags.count; i++)
        n += diags.item[i].number == number;
    return n;
}

/* the entries (n) of a lot of three: how many of them had too many wafers in one machine, and is it said of the last one? */
static int too_many_of(const char *const *words, int n, bool *told) {
    fw_recipe_asrun run;
    fw_recipe_deviation *list;
    int count, found = 0;
    lot_wafers = "1,2,3";
    const char *log = begun();
    for (int i = 0; i < n; i++)
        log = with(log, words[i], 0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &count), FW_OK);
    for (int i = 0; i < count; i++)
        found += strcmp(list[i].what, "wafers at once") == 0;
    const int before = said(659);
    assert_int_equal(fw_recipe_asrun_ask_time(arena, &run, &run.entry[run.nentry - 1],
                                              (fw_place){"log", 1, 1}, &diags),
                     FW_OK);
    *told = said(659) > before;
    return found;
}

/* a hotplate for one wafer has one at a time: by one load, by entries that overlap, in whatever steps; not where their time is
   enough for one after the other, where a clock that was read to the minute leaves it open, or on two hotplates */
static void machines_take_so_many(void **state) {
    (void)state;
#define BAKE(id, from, to, more)                                                                   \
    id "; start=2026-11-20T" from "; end=2026-11-20T" to "; by=AB; " more
    static const struct {
        const char *words[3];
        int found;
    } of[] = {
        {{BAKE("C09", "10:00", "10:11", "wafer=1"), BAKE("C09", "10:00", "10:11", "wafer=2"),
          BAKE("C09", "10:00", "10:11", "wafer=3")},
         3},
        {{BAKE("C09", "10:00", "10:11", "")}, 1},
        {{BAKE("C09", "10:00", "10:34", "wafer=1"), BAKE("C09", "10:00", "10:34", "wafer=2"),
          BAKE("C09", "10:00", "10:34", "wafer=3")},
         0},
        {{BAKE("C09", "10:00", "10:34", "")}, 0},
        {{BAKE("C09", "10:00", "10:11", "wafer=1"), BAKE("C09", "10:02", "10:13", "wafer=2")}, 2},
        {{BAKE("C09", "10:00", "10:11", "wafer=1"), BAKE("C11", "10:02", "10:13", "wafer=2")}, 2},
        {{BAKE("C09", "10:00", "10:11", "wafer=1"), BAKE("C09", "10:10", "10:21", "wafer=2")}, 0},
        {{BAKE("C09", "10:00", "10:11", "wafer=1"), BAKE("C09", "10:11", "10:22", "wafer=2")}, 0},
        {{BAKE("C09", "10:00", "10:11", "wafer=1; tool=left"),
          BAKE("C09", "10:02", "10:13", "wafer=2; tool=right")},
         0},
        {{BAKE("C09", "10:00", "10:11", "wafer=1; tool=left"),
          BAKE("C09", "10:02", "10:13", "wafer=2; tool=left")},
         2},
    };
#undef BAKE
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        bool told;
        int n = 0;
        while (n < 3 && of[i].words[n])
            n++;
        const int found = too_many_of(of[i].words, n, &told);
        if (found != of[i].found || told != (found > 0))
            fail_msg("case %d: %d are found, %d is told", (int)i, found, told);
    }
}

/* ---- what becomes of wafers ---- */

static const char *fate(const char *log, const char *wafer, const char *time, const char *word,
                        int number) {
    return with(log,
                fw_arena_printf(arena,
                                "C22; wafer=%s; start=2026-11-20T%s; by=AB; %s=cracked in the jig",
                                wafer, time, word),
                number);
}

static const char *run_of(const char *log, const char *step, const char *wafer, const char *from,
                          const char *to, int number) {
    return with(log,
                fw_arena_printf(arena,
                                "%s; start=2026-11-20T%s; end=2026-11-20T%s; by=AB; second=CD%s%s",
                                step, from, to, wafer ? "; wafer=" : "", wafer ? wafer : ""),
                number);
}

/* from then on no entry of a wafer that is scrapped or held is taken or expected; what was done before may still be logged */
static void wafers_that_are_out(void **state) {
    (void)state;
    fw_recipe_asrun run;
    fw_text text = fw_text_new(arena), json = fw_text_new(arena), page = fw_text_new(arena);
    lot_wafers = "1,2,3";
    const char *log = run_of(begun(), "C21", NULL, "10:00", "10:12", 0);
    log = run_of(log, "C22", "1", "10:20", "10:42", 0);
    log = fate(log, "2", "10:45", "scrapped", 0);
    log = fate(log, "3", "10:50", "held", 0);
    run_of(log, "C22", "2", "10:46", "10:50", 603);
    assert_non_null(
        strstr(diags.item[diags.count - 1].message,
               "wafer 2 was scrapped at C22, 2026-11-20T10:45 (line 4: cracked in the jig)"));
    run_of(log, "C22", "3", "11:00", "11:22", 603);
    assert_non_null(strstr(diags.item[diags.count - 1].message, "log resumed= first"));
    run_of(log, "C22", "2", "10:21", "10:43", 0); /* before that, and only logged now */
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(run.nentry, 4);
    assert_null(run.entry[2].step);
    assert_string_equal(run.entry[2].at->id, "C22");
    assert_string_equal(run.entry[2].why, "cracked in the jig");
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
    assert_true(
        holds(&text, "wafer 2: scrapped at C22, 2026-11-20T10:45, by AB: cracked in the jig"));
    assert_true(holds(&text, "wafers: 3 in, 1 out, 1 held"));
    assert_true(holds(&text, "2 of 28 steps run, 0 repeated"));
    assert_false(holds(&text, "not yet"));
    assert_true(holds(&json, "\"wafers_in\":3,\"wafers_out\":1,\"expected\":[]"));
    assert_true(holds(&json, "\"wafers_in\":1,\"wafers_out\":1,\"expected\":[\"1\"]"));
    assert_true(holds(
        &json, "\"fates\":[{\"wafer\":\"2\",\"fate\":\"scrapped\",\"step\":\"C22\",\"at\":\"2026-"
               "11-20T10:45\",\"by\":\"AB\",\"why\":\"cracked in the jig\",\"line\":4}"));
    assert_true(holds(&page, "3 in, 1 out, 1 held, 1 scrapped"));
    /* held, and goes on; scrapped, and does not; and no lot is left of scrapped wafers */
    const char *on = fate(log, "3", "12:00", "resumed", 0);
    assert_int_equal(read_log(on, strlen(on), &run), FW_OK);
    text = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_true(holds(&text, "not yet: wafer 3\n"));
    run_of(on, "C22", "3", "12:01", "12:23", 0);
    fate(on, "2", "12:00", "resumed", 603);
    fate(on, "1", "12:00", "resumed", 603);
    fate(on, "2", "12:00", "scrapped", 603);
    fate(on, "1", "10:30", "scrapped", 603); /* it was plated until 10:42 */
    fate(on, "4", "12:00", "scrapped", 282);
    const char *none = fate(fate(on, "1", "12:00", "scrapped", 0), "3", "12:30", "scrapped", 0);
    run_of(none, "C23", NULL, "13:00", "13:10", 603);
    /* an entry of its own */
    with(log, entry("held=why"), 282);
    with(log, entry("wafer=1; held=why"), 282); /* from 10:30 to 10:52 */
    with(log, "C22; wafer=1; start=2026-11-20T12:00; by=AB; held=why; scrapped=why", 282);
    with(log, "C22; wafer=1; start=2026-11-20T12:00; by=AB; held=why; thickness=9 um", 282);
    with(log, "C22; wafer=1; start=2026-11-20T12:00; held=why", 282);
}

/* what was done otherwise is in the log, with whoever says so; also of a run that was repeated, and of a wafer that is out */
static void deviations_are_written_down(void **state) {
    (void)state;
    fw_recipe_asrun run;
    fw_text text = fw_text_new(arena), json = fw_text_new(arena), page = fw_text_new(arena);
    lot_wafers = "1,2";
    const char *log = with(begun(), entry("wafer=1; deviation=1, plated at 30 °C = too warm"), 0);
    log = run_of(log, "C22", "1", "11:20", "11:42", 0);
    log = with(log,
               "C22; wafer=2; start=2026-11-20T10:45; by=CD; scrapped=cracked; deviation=2, "
               "without its jig",
               0);
    with(log, entry("wafer=1; deviation=1; deviation=2"), 282);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_string_equal(run.entry[0].deviation, "1, plated at 30 °C = too warm");
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
    assert_true(holds(&text, "deviations written down:\nC22, wafer 1, by AB: 1, plated at 30 °C = "
                             "too warm\nC22, wafer 2, by CD: 2, without its jig\n"));
    assert_true(holds(
        &json, "\"written_down\":[{\"step\":\"C22\",\"wafer\":\"1\",\"at\":\"2026-11-20T10:30\","
               "\"by\":\"AB\",\"deviation\":\"1, plated at 30 °C = too warm\",\"line\":2}"));
    assert_true(holds(&page, "<td>2, without its jig</td><td>CD</td>"));
}

/* calibrate leaves out what was read on a wafer after it was scrapped, and keeps what was read before */
static void readings_of_what_is_out(void **state) {
    (void)state;
    static const char pads[] =
        "%s; wafer=1; start=2026-11-20T%s; end=2026-11-20T%s; by=AB; second=CD; "
        "coupon=plating-pads, drawn=%d um, value=9.1 um, u=0.1 um, at=25 C/cm2";
    fw_recipe_asrun run;
    fw_process_readings r;
    lot_wafers = "1,2";
    const char *log = with(begun(), fw_arena_printf(arena, pads, "C22", "10:00", "10:22", 10), 0);
    log = with(log, fw_arena_printf(arena, pads, "C22", "11:00", "11:22", 100), 0);
    log = fate(log, "1", "11:30", "scrapped", 0);
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, NULL, "lot.log", log, strlen(log), &diags, &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &r), FW_OK);
    assert_int_equal(r.n, 2);
    run.entry[2].start_s -= 3600.0; /* as if it had been scrapped at 10:30 */
    assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &r), FW_OK);
    assert_int_equal(r.n, 1);
    assert_near(r.item[0].row.drawn_m, 10e-6, 1e-12);
    assert_int_equal(diags.item[diags.count - 1].number, 604);
}

/* Lines and spaces of a wafer whose wet etch was too long, or was gone on with after they were read, do not count, and that is
   told once; the log is judged without its plan, by the times that stand in its lines. What says under what it was read
   counts; --all-runs counts all, --without leaves a wafer out. */
static void readings_of_bad_runs(void **state) {
    (void)state;
#define AT(step, from, to, wafer)                                                                  \
    step "; start=2026-11-20T" from ":00; end=2026-11-20T" to ":00; by=AB; second=CD; "            \
                                                              "wafer=" wafer
    static const char lines[] =
        "; coupon=cd-lines, line, drawn=6 um, value=3.64 3.65 3.63 um, u=0.02 um; coupon=cd-lines, "
        "space, drawn=6 um, value=8.34 8.35 8.36 um, u=0.02 um";
    static const char step[] = "; coupon=al-step, value=0.6 um, u=0.01 um, at=50 um";
    static const char ladder[] =
        "; coupon=undercut-ladder, width, drawn=10 um, value=6.9 um, u=0.02 um, at=50 um";
#define LADDER AT("S18", "14:00", "15:50", "1") ";"
    static const struct {
        const char *entry[4];
        int n;
        fw_recipe_counted counted;
        int read, told;
    } log[] = {
        /* the ladder begins at the edge that the lines of its wafer tell; where nobody read it since, it does not count */
        {{AT("S14", "10:00", "10:17", "1"), LADDER}, 2, {0}, 1, 0},
        {{AT("S14", "10:00", "10:40", "1"), LADDER}, 2, {0}, 0, 1},
        {{AT("S14", "10:00", "10:40", "2"), LADDER}, 2, {0}, 1, 0},
        {{AT("S14", "10:00", "10:40", "1"), LADDER}, 2, {.all_runs = true}, 1, 0},
        {{AT("S14", "10:00", "10:40", "1"), AT("S15", "11:00", "11:07", "1"), LADDER},
         3,
         {0},
         3,
         1},
        {{AT("S14", "10:00", "10:17", "1"), AT("S15", "11:00", "11:07", "1"),
          AT("S14", "12:00", "12:20", "1"), LADDER},
         4,
         {0},
         0,
         2},
        {{AT("S14", "10:00", "10:17", "1"), AT("S15", "11:00", "11:07", "1"),
          AT("S14", "12:00", "12:02", "1"), LADDER},
         4,
         {0},
         1,
         1},
        {{AT("S14", "10:00", "10:17", "1"), AT("S15", "11:00", "11:07", "1")}, 2, {0}, 2, 0},
        {{AT("S14", "10:00", "10:40", "1"), AT("S15", "11:00", "11:07", "1")}, 2, {0}, 0, 1},
        {{AT("S14", "10:00", "10:40", "1"), AT("S15", "11:00", "11:07", "1")},
         2,
         {.all_runs = true},
         2,
         1},
        {{AT("S14", "10:00", "10:40", "2"), AT("S15", "11:00", "11:07", "1")}, 2, {0}, 2, 0},
        {{AT("S14", "10:00", "10:05", "1"), AT("S15", "11:00", "11:07", "1")}, 2, {0}, 0, 1},
        {{AT("S14", "10:00", "10:05", "1"), AT("S14", "10:30", "10:42", "1"),
          AT("S15", "11:00", "11:07", "1")},
         3,
         {0},
         2,
         0},
        {{AT("S14", "10:00", "10:17", "1"), AT("S15", "11:00", "11:07", "1"),
          AT("S14", "12:00", "12:02", "1")},
         3,
         {0},
         0,
         1},
        {{AT("S14", "10:00", "10:40", "1"), AT("S18", "11:00", "12:50", "1")}, 2, {0}, 1, 0},
        {{AT("S14", "10:00", "10:17", "1"), AT("S15", "11:00", "11:07", "1")},
         2,
         {.without = "1"},
         0,
         0},
        {{AT("S14", "10:00", "10:17", "1"), AT("S15", "11:00", "11:07", "1")},
         2,
         {.without = "2"},
         2,
         0},
    };
    flow = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    lot_wafers = "1,2";
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        fw_process_readings r;
        int told = 0;
        const char *text = begun();
        for (int k = 0; k < log[i].n; k++) {
            const char *e = log[i].entry[k];
            const char *more = strncmp(e, "S15", 3) == 0    ? lines
                               : strchr(e, '\0')[-1] == ';' ? ladder
                               : strncmp(e, "S18", 3) == 0  ? step
                                                            : "";
            if (more == ladder) more++; /* its entry ends with one */
            text = with(text, fw_arena_printf(arena, "%s%s", e, more), 0);
        }
        assert_non_null(strstr(text, "\tplanned=1000 "));
        /* as calibrate has it: the flow as the pack gives it, without a device */
        fw_process_flow *computed = flow;
        flow = read_pack(arena, SILICON, NULL, NULL, &diags);
        diags = fw_diags_new(arena);
        assert_int_equal(
            fw_recipe_asrun_read(arena, flow, NULL, "lot.log", text, strlen(text), &diags, &run),
            FW_OK);
        assert_int_equal(fw_recipe_asrun_readings(arena, &run, &log[i].counted, &diags, &r), FW_OK);
        for (size_t k = 0; k < diags.count; k++)
            told += diags.item[k].number == 693;
        if (r.n != log[i].read || told != log[i].told)
            fail_msg("%zu: %d readings, told %d times", i, r.n, told);
        flow = computed;
    }
    fw_recipe_asrun run;
    fw_process_readings r;
    const fw_recipe_counted without = {.without = "1, 9"};
    const char *text = with(begun(), log[0].entry[0], 0);
    assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_readings(arena, &run, &without, &diags, &r), FW_INPUT);
    with(begun(), AT("S14", "10:00", "10:17", "1") "; planned=1 2 3 4 5 6 7", 282);
#undef LADDER
#undef AT
}

/* A lot goes on by another plan where its log says so: what a pack that was calibrated meanwhile makes of it. Lines before are
   judged by the times that stand in them, those behind by the plan; head and chain hold the line that says it, too. */
static void a_log_goes_on_by_another_plan(void **state) {
    (void)state;
    static const char other[] = "ffeeddccbbaa99887766554433221100ffeeddccbbaa99887766554433221100";
    static const struct {
        const char *words;
        bool taken;
    } of[] = {{"plan; by=AB", false},
              {"plan; start=2026-11-20T12:00", false},
              {"plan; start=noon; by=AB", false},
              {"plan; start=2026-11-20T12:00; by=AB; wafer=1", false},
              {"plan; start=2026-11-20T12:00; by=AB; note=pack of wafer 1", true}};
    fw_recipe_asrun run;
    const char *line = NULL, *head;
    const char *log = with(
        begun(),
        "C22; start=2026-11-20T10:00:00; end=2026-11-20T10:24:00; by=AB; second=CD; thickness=9.1",
        0);
    assert_true(fw_recipe_asrun_is_plan(of[0].words));
    assert_false(fw_recipe_asrun_is_plan("planarise; start=2026-11-20T12:00"));
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, other, "lot.log", log, strlen(log), &diags, &run),
        FW_INPUT);
    assert_int_equal(diags.item[diags.count - 1].number, 281);
    assert_non_null(strstr(diags.item[diags.count - 1].message,
                           "--entry \"plan; start=TIME; by=INITIALS; note=WHY\""));
    assert_int_equal(
        fw_recipe_asrun_read_former(arena, flow, other, "lot.log", log, strlen(log), &diags, &run),
        FW_OK);
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        assert_int_equal(fw_recipe_asrun_add_plan(arena, &run, other, of[i].words,
                                                  (fw_place){"entry", 1, 1}, &diags, &line),
                         of[i].taken ? FW_OK : FW_INPUT);
    assert_int_equal(fw_recipe_asrun_add_plan(arena, &run, plan, of[4].words,
                                              (fw_place){"entry", 1, 1}, &diags, &head),
                     FW_INPUT);
    log = fw_arena_printf(arena, "%s%s", log, line);
    /* at half of the rate the same times are short: of the line before they are not */
    measured(flow, "cu.J", 100.0, 1.0);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, other, "lot.log", log, strlen(log), &diags, &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_add(arena, flow, &run,
                                         "C22; start=2026-11-20T13:00:00; end=2026-11-20T13:21:00; "
                                         "by=AB; second=CD; thickness=4.6; wafer=1",
                                         (fw_place){"entry", 1, 1}, now, &diags, &line),
                     FW_INPUT);
    assert_int_equal(
        fw_recipe_asrun_add(arena, flow, &run,
                            "C20; start=2026-11-20T13:00:00; end=2026-11-20T13:09:00; by=AB",
                            (fw_place){"entry", 1, 1}, now, &diags, &line),
        FW_OK);
    log = fw_arena_printf(arena, "%s%s", log, line);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, other, "lot.log", log, strlen(log), &diags, &run), FW_OK);
    assert_int_equal(run.nentry, 2);
    assert_int_equal(run.nline, 3);
    fw_recipe_asrun_total total; /* what was planned is of the plan of each line */
    assert_int_equal(fw_recipe_asrun_sum_up(flow, &run, arena, &total), FW_OK);
    assert_true(run.entry[0].as_set->booked_s < 0.75 * run.entry[0].step->booked_s);
    assert_near(total.planned_s, run.entry[0].as_set->booked_s + run.entry[1].step->booked_s, 1e-6);
    assert_int_equal(run.nreplan, 1);
    assert_int_equal(run.replan[0].line, 3);
    assert_true(run.entry[0].former && !run.entry[1].former);
    assert_int_equal(run.entry[1].line, 4);
    assert_string_equal(fw_recipe_asrun_in_time(&run, &run.entry[0]), "in window");
    assert_string_equal(fw_recipe_asrun_in_time(&run, &run.entry[1]), "in window");
    assert_int_equal(run.entry[0].nmeasured, 1);
    fw_text text = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_true(
        holds(&text, "from line 3 on plan ffeeddccbbaa: 2026-11-20T12:00, by AB: pack of wafer 1"));
    assert_true(holds(&text, "by the plan of its line: "));
    for (int n = 3; n >= 2; n--) { /* also where the head ends with the line of the plan */
        assert_int_equal(fw_recipe_asrun_head(arena, n, run.link[n - 1], &head), FW_OK);
        assert_int_equal(fw_recipe_asrun_check_head(&run, "head", head, strlen(head), &diags),
                         FW_OK);
    }
    assert_int_equal(fw_recipe_asrun_head(arena, 4, run.chain, &head), FW_OK);
    assert_int_equal(fw_recipe_asrun_check_head(&run, "head", head, strlen(head), &diags),
                     FW_INPUT);
}

/* a line of a former version: without the limits of its values */
static const char *of_before(const char *log, const char *words) {
    size_t n = strlen(log);
    char before[65], chain[65];
    memcpy(before, log + n - 65, 64);
    before[64] = '\0';
    const char *both = fw_arena_printf(arena, "%s\n%s", before, words);
    fw_sha256(both, strlen(both), chain);
    return fw_arena_printf(arena, "%s%s\tchain=%s\n", log, words, chain);
}

/* 9.1 um and 20.1 mA/cm2 were right when they were logged; the next plan wants 10 um, and another current. They stay right, and
   8 um stay wrong, also in another unit; a line of a former version has no limits, which is told */
static void values_go_by_the_plan_of_their_line(void **state) {
    (void)state;
    static const char other[] = "ffeeddccbbaa99887766554433221100ffeeddccbbaa99887766554433221100";
    fw_recipe_asrun run;
    fw_recipe_deviation *list;
    const char *line;
    int n;
    lot_wafers = "1,2,3";
    const char *log = with(begun(),
                           "C22; start=2026-11-20T10:00:00; end=2026-11-20T10:21:00; by=AB; "
                           "second=CD; wafer=1; thickness=9.1 um; set current density=20.1 mA/cm2",
                           0);
    log = with(log,
               "C22; start=2026-11-20T11:00:00; end=2026-11-20T11:21:00; by=AB; second=CD; "
               "wafer=2; thickness=9.1 9.2 9.0 9.1 8.0 um",
               0);
    assert_non_null(strstr(log, "\tlimits of thickness=8.1 9.9 - um\t"));
    assert_non_null(strstr(log, "\tlimits of set current density=19.8 20.2 20 mA/cm2\t"));
    log = of_before(log, "step=C22\tstart=2026-11-20T12:00:00\tend=2026-11-20T12:21:00\tby="
                         "AB\twafer=3\tsecond=CD\tthickness=9.1 um");
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_add_plan(arena, &run, other,
                                              "plan; start=2026-11-20T13:00; by=AB",
                                              (fw_place){"entry", 1, 1}, &diags, &line),
                     FW_OK);
    log = fw_arena_printf(arena, "%s%s", log, line);
    measured(flow, "cu.J", 100.0, 1.0);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    for (int k = 0; k < flow->nstep; k++)
        for (int i = 0; i < flow->step[k].naccept && strcmp(flow->step[k].id, "C22") == 0; i++)
            if (strcmp(flow->step[k].accept[i].measure, "thickness") == 0)
                flow->step[k].accept[i].low = "9500", flow->step[k].accept[i].high = "10500",
                flow->step[k].accept[i].unit = "nm";
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_recipe_asrun_read(arena, flow, other, "lot.log", log, strlen(log), &diags, &run), FW_OK);
    assert_true(run.entry[0].limited && run.entry[1].limited && !run.entry[2].limited);
    assert_true(fw_recipe_asrun_accepted(&run.entry[0].measured[0]));
    assert_string_equal(run.entry[0].measured[0].low, "8100");
    assert_near(run.entry[0].set[0].planned, 20.0, 1e-9);
    assert_true(fw_recipe_asrun_allowed(&run.entry[0].set[0]));
    assert_false(fw_recipe_asrun_accepted(&run.entry[1].measured[0]));
    assert_false(fw_recipe_asrun_accepted(&run.entry[2].measured[0]));
    assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
    for (int i = 0; i < n; i++)
        assert_false(strcmp(list[i].what, "thickness") == 0 && list[i].entry == &run.entry[0]);
    fw_text text = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_true(
        holds(&text, "lines before are judged by the times and the limits that stand in them"));
    assert_true(holds(&text, "without limits, and judged by the last plan's: line 4\n"));
    /* of one site, and not of the mean of the sites, which is fine */
    assert_true(holds(
        &text, "thickness = 8880 nm, mean of 5 sites: 8000 nm (right) OUT of 8100 to 9900 nm"));
    with(begun(),
         "C22; start=2026-11-20T10:00; end=2026-11-20T10:21; by=AB; second=CD; limits of "
         "thickness=1 2 - um",
         282);
}

/* A wafer that goes on without a step: it is no step that is not yet due. A bath whose time nobody can compute, and in which one wafer stayed over night */
static void steps_left_out_and_times_of_no_plan(void **state) {
    (void)state;
    fw_recipe_asrun run;
    fw_recipe_deviation *list;
    fw_recipe_asrun_total total;
    fw_text text = fw_text_new(arena), json = fw_text_new(arena), page = fw_text_new(arena);
    int n, odd = 0;
#define C(step, from, to, wafer)                                                                   \
    step "; start=2026-11-20T" from ":00; end=2026-11-2" to ":00; by=AB; second=CD; wafer=" wafer
    static const char *const entries[] = {
        C("C19", "08:00", "0T08:10", "1"), C("C19", "08:10", "0T08:20", "2"),
        C("C20", "08:30", "0T08:39", "1"), C("C20", "08:40", "0T08:49", "2"),
        C("C21", "08:50", "0T09:00", "2"), C("C22", "08:52", "0T09:12", "2"),
        C("C22", "08:52", "0T09:12", "1"), C("C26", "10:00", "0T10:15", "1"),
        C("C26", "10:00", "1T01:15", "2")};
#undef C
    lot_wafers = "1,2,3";
    const char *log = begun();
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++)
        log = with(log, entries[i], 0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int w = 0; w < 3; w++) {
            const bool between = i > 18 && i < 25 && w < 2,
                       there = strcmp(s->id, "C20") == 0 || strcmp(s->id, "C22") == 0 ||
                               (strcmp(s->id, "C21") == 0 && w == 1);
            assert_int_equal(fw_recipe_asrun_left_out(&run, s, run.wafer[w]),
                             (between && !there) ||
                                 (i < 18 && w < 2 && !fw_process_step_is_of_lot(s)));
        }
    }
    assert_int_equal(fw_recipe_asrun_sum_up(flow, &run, arena, &total), FW_OK);
    assert_true(total.left_out > 7);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
    assert_true(holds(&text, "LEFT OUT, and gone on without it: wafer 1\n"));
    assert_true(holds(&text, "not yet: wafer 3\n"));
    assert_true(holds(&json, "\"left_out\":[\"1\"]"));
    assert_true(holds(&page, "C21 of wafer 1: left out"));
    for (int k = 1; k <= 2; k++) {
        assert_int_equal(fw_recipe_asrun_ask_time(arena, &run, &run.entry[run.nentry - k],
                                                  (fw_place){"entry", 1, 1}, &diags),
                         FW_OK);
    }
    for (size_t k = 0; k < diags.count; k++)
        if (diags.item[k].number == 703 &&
            strstr(diags.item[k].message,
                   "C26 of wafer 2 took otherwise than others: no planned time"))
            odd++;
    assert_int_equal(odd, 1);
    assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
    odd = 0;
    for (int i = 0; i < n; i++)
        odd += strstr(list[i].planned, "other wafers took 15 min") != NULL;
    assert_int_equal(odd, 1);
    assert_true(
        holds(&text, "times without a zone: taken to be of one clock that is never changed"));
}

/* An entry whose times were mistyped cannot be taken back, and one with later times is another run, which adds up; what says that it
   replaces the line does not: neither times nor coupons of the former count, nor what a wafer waited by it */
static void a_line_is_replaced(void **state) {
    (void)state;
#define AT(step, from, to)                                                                         \
    step "; start=2026-11-20T" from ":00; end=2026-11-20T" to ":00; by=AB; second=CD; wafer=1"
    static const char rate[] = "; coupon=etch-rate, pan.R, value=%s um, u=0.01 um, at=%d min";
    static const struct {
        const char *more;
        const char *judged;
        int readings;
    } of[] = {{"", "long", 2}, {"; replaces=2", "in window", 1}};
    flow = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    lot_wafers = "1,2";
    const char *first = with(begun(),
                             fw_arena_printf(arena, "%s%s", AT("S14", "08:00", "08:17"),
                                             fw_arena_printf(arena, rate, "0.62", 5)),
                             0);
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        fw_recipe_asrun run;
        fw_process_readings r;
        fw_recipe_asrun_total total;
        const char *log = with(first,
                               fw_arena_printf(arena, "%s%s%s", AT("S14", "10:00", "10:20"),
                                               fw_arena_printf(arena, rate, "0.64", 6), of[i].more),
                               0);
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        assert_string_equal(fw_recipe_asrun_in_time(&run, &run.entry[1]), of[i].judged);
        assert_int_equal(fw_recipe_asrun_taken_back(&run, &run.entry[0]), i);
        assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &r), FW_OK);
        assert_int_equal(r.n, of[i].readings);
        assert_int_equal(fw_recipe_asrun_sum_up(flow, &run, arena, &total), FW_OK);
        assert_int_equal(total.repeated, 0);
        assert_near(total.actual_s, i ? 1200.0 : 2220.0, 1e-9);
        fw_text page = fw_text_new(arena);
        assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
        assert_non_null(
            strstr(page.data, i ? "S14 (replaced by a later line)" : "S14 (gone on with later)"));
        assert_null(strstr(page.data, "repeated later"));
        if (i == 0) continue;
        with(log, AT("S14", "11:00", "11:17") "; replaces=2", 282); /* another one stands there */
        with(log, AT("S15", "11:00", "11:07") "; replaces=3", 282);
        with(log, AT("S14", "11:00", "11:17") "; replaces=9", 282);
        with(log,
             "S14; start=2026-11-20T11:00; end=2026-11-20T11:17; by=AB; second=CD; wafer=2; "
             "replaces=3",
             282);
        with(log, AT("S14", "11:00", "11:17") "; replaces=that", 282);
    }
#undef AT
}

/* a load that was typed with one start and end took that long for all of its wafers, one after the other where the machine takes
   one: neither "long" for each, nor counted for each */
static void loads_share_their_time(void **state) {
    (void)state;
    fw_recipe_asrun run;
    fw_text text = fw_text_new(arena), json = fw_text_new(arena);
    lot_wafers = "1,2,3,4";
    const char *log = begun();
    for (int i = 1; i <= 4; i++)
        log = run_of(log, "C21", fw_arena_printf(arena, "%d", i), "10:00", "10:40", 0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &text), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_true(holds(
        &text, "0 outside of their limits; planned at the machine 40 min for them, actual 40 min"));
    assert_false(holds(&json, "\"judged\":\"long\""));
    /* of one wafer alone that is long */
    log = run_of(begun(), "C21", "1", "10:00", "10:40", 0);
    json = fw_text_new(arena);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_true(holds(&json, "\"judged\":\"long\""));
}

/* said of a log whose entries are made one after the other; how often, and with these words */
static int told_of_waits(const char *const *entry, int n, const char *words, fw_text *table) {
    fw_recipe_asrun run;
    int told = 0;
    const char *log = begun();
    for (int i = 0; i < n; i++) {
        log = with(log, entry[i], 0);
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, &run.entry[i], (fw_place){"entry", 1, 1}, &diags),
            FW_OK);
        for (size_t k = 0; k < diags.count; k++) {
            if (diags.item[k].number != 648) continue;
            told++;
            if (!strstr(diags.item[k].message, words)) print_message("%s\n", diags.item[k].message);
            assert_non_null(strstr(diags.item[k].message, words));
        }
    }
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, table), FW_OK);
    return told;
}

/* A step begins after the one before it has ended, with a lag or without, whichever of the two was entered first; what is
   run again afterwards is no contradiction, and neither is another wafer's, nor what shares its time with other loads. A wait
   that is too long is told with the entry that shows it. Each once */
static void waits_are_not_below_nothing(void **state) {
    (void)state;
#define C(step, from, to, wafer)                                                                   \
    step "; start=2026-11-20T" from "; end=2026-11-20T" to "; by=AB; second=CD; wafer=" wafer
    static const struct {
        const char *entry[5];
        int n, told;
        const char *words, *table;
    } log[] = {
        {{C("C20", "10:00", "10:09", "1"), C("C22", "09:00", "09:22", "1")},
         2,
         1,
         "step C22 of wafer 1 began 69 min before C20 ended (2026-11-20T10:00 to 2026-11-20T10:09)",
         "began 69 min before C20 ended: OUT of 0 s to 15 min"},
        {{C("C22", "09:00", "09:22", "1"), C("C20", "10:00", "10:09", "1")},
         2,
         1,
         "step C22 of wafer 1 began 69 min before C20",
         "began 69 min before C20 ended: OUT"},
        {{C("C01", "10:00", "10:05", "1"), C("C02", "08:00", "08:45", "1")},
         2,
         1,
         "step C02 of wafer 1 began 2 h 5 min before C01 ended",
         "began 2 h 5 min before C01 ended: OUT of 0 s or more"},
        {{C("C10", "08:00", "08:05", "1"), C("C09", "10:00", "10:05", "1")},
         2,
         1,
         "step C10 of wafer 1 began",
         "before C09 ended: OUT"},
        {{C("C20", "10:00", "10:09", "1"), C("C22", "11:00", "11:22", "1")},
         2,
         1,
         "step C22 of wafer 1 waited 51 min since C20, and allowed is 0 s to 15 min",
         "waited 51 min since C20: OUT"},
        {{C("C22", "11:00", "11:22", "1"), C("C20", "10:00", "10:09", "1")},
         2,
         1,
         "waited 51 min since C20",
         "waited 51 min since C20: OUT"},
        /* what a state of the wafer allows is no other than what a lag does */
        {{C("C05", "09:40", "09:44", "1"), C("C06", "09:59", "10:02", "1")},
         2,
         1,
         "step C06 of wafer 1 waited 15 min since C05, wet with",
         "waited 15 min since C05, wet with"},
        {{C("C08", "18:00", "18:05", "1"), C("C07", "10:05", "10:10", "1")},
         2,
         1,
         "waited 7 h 50 min since C07, wet with",
         "since C07, wet with"},
        /* none of these */
        {{C("C05", "09:40", "09:44", "1"), C("C06", "09:44", "09:47", "1")}, 2, 0, "", NULL},
        {{C("C07", "10:05", "10:10", "1"), C("C08", "14:00", "14:05", "1")}, 2, 0, "", NULL},
        {{C("C05", "09:40", "09:44", "2"), C("C06", "09:59", "10:02", "1")}, 2, 0, "", NULL},
        {{C("C20", "10:00", "10:09", "2"), C("C22", "09:00", "09:22", "1")}, 2, 0, "", NULL},
        {{C("C20", "10:00", "10:09", "1"), C("C22", "10:10", "10:32", "1"),
          C("C20", "12:00", "12:09", "1")},
         3,
         0,
         "",
         NULL},
        {{C("C09", "10:00", "10:05", "1"), C("C10", "10:05", "10:10", "1")}, 2, 0, "", NULL},
        {{C("C09", "10:00", "10:05", "1"), C("C10", "10:05", "10:10", "1"),
          C("C09", "10:20", "10:25", "1")},
         3,
         0,
         "",
         NULL},
        /* an interrupted step goes on from its first run: what it waited for was over then, and what that waited for stands */
        {{C("C20", "10:00", "10:09", "1"), C("C22", "10:12", "10:22", "1"),
          C("C22", "10:35", "10:47", "1")},
         3,
         0,
         "",
         NULL},
        {{C("C20", "10:00", "10:09", "1"), C("C22", "10:30", "10:40", "1"),
          C("C22", "10:45", "10:57", "1")},
         3,
         1,
         "step C22 of wafer 1 waited 21 min since C20, and allowed",
         "waited 21 min since C20: OUT"},
        {{C("C20", "10:00", "10:09", "1"), C("C22", "10:12", "10:22", "1"),
          C("C20", "10:40", "10:49", "1"), C("C22", "11:10", "11:22", "1")},
         4,
         1,
         "step C22 of wafer 1 waited 21 min since C20, and allowed",
         "waited 21 min since C20: OUT"},
        {{C("C20", "10:00", "10:09", "1"), C("C22", "10:12", "10:22", "1"),
          C("C22", "10:45", "10:50", "1"), C("C22", "10:55", "11:01", "1")},
         4,
         1,
         "step C22 of wafer 1 waited 23 min since C22, and allowed is 0 s to 15 min",
         "waited 23 min since C22: OUT"},
        /* the wrong time was put right */
        {{C("C20", "18:00", "18:09", "1"), C("C22", "10:10", "10:32", "1"),
          C("C20", "10:00", "10:09", "1")},
         3,
         1,
         "before C20 ended",
         NULL},
    };
#undef C
    lot_wafers = "1,2";
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_text table = fw_text_new(arena);
        int told = told_of_waits(log[i].entry, log[i].n, log[i].words, &table);
        if (told != log[i].told) print_message("log %zu: told %d times\n", i, told);
        assert_int_equal(told, log[i].told);
        if (log[i].table && !holds(&table, log[i].table))
            print_message("log %zu\n%s\n", i, table.data);
        assert_true(!log[i].table || holds(&table, log[i].table));
        assert_true(log[i].table || (!holds(&table, "before") && !holds(&table, "waited")));
    }
    fw_recipe_asrun run;
    fw_recipe_deviation *list;
    fw_text json = fw_text_new(arena), page = fw_text_new(arena);
    int n, waits = 0;
    const char *late = begun(), *early = begun();
    static const char *const once[] = {
        "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=AB; wafer=1",
        "C22; start=2026-11-20T10:30; end=2026-11-20T10:40; by=AB; second=CD; wafer=1",
        "C22; start=2026-11-20T10:45; end=2026-11-20T10:57; by=AB; second=CD; wafer=1"};
    for (int i = 0; i < 3; i++)
        late = with(late, once[i], 0);
    assert_int_equal(read_log(late, strlen(late), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
    assert_int_equal(n, 1); /* which no second run puts right */
    assert_false(list[0].repeated);
    for (int i = 0; i < 2; i++)
        early = with(early, log[0].entry[i], 0);
    assert_int_equal(read_log(early, strlen(early), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
    assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
    assert_true(holds(&json, "\"waited_s\":-4140,\"min_s\":0,\"max_s\":900,\"accepted\":false"));
    assert_true(holds(&page, "began 69 min before C20 ended"));
    assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
    for (int i = 0; i < n; i++)
        waits += strcmp(list[i].what, "wait since C20") == 0;
    assert_int_equal(waits, 1);
}

/* the same line a second time is seldom meant; with a value more it is */
static void an_entry_is_made_once(void **state) {
    (void)state;
    static const char
        again[] = "C23; start=2026-11-20T10:30; end=2026-11-20T10:39; by=AB; thickness=9.1",
        more[] =
            "C23; start=2026-11-20T10:30; end=2026-11-20T10:39; by=AB; spread of thickness=3 %";
    const char *log = with(begun(), again, 0);
    for (int i = 0; i < 2; i++) {
        bool told = false;
        with(log, i ? more : again, 0);
        for (size_t k = 0; k < diags.count; k++)
            told = told || strstr(diags.item[k].message,
                                  "is in the log already, with the same values (line 2)");
        assert_int_equal(told, i == 0);
    }
}

/* An etch of two runs is one longer etch: judged by the sum, with the rinse of each where that is in question; what was made anew
   in between begins anew, a run put right by a later line is one, a bake whose time is stated does not add up, and another
   wafer's has no part in it. A run that is gone on with is not short. */
static void runs_add_up(void **state) {
    (void)state;
#define E(step, from, to, wafer)                                                                   \
    step "; start=2026-11-20T" from ":00; end=2026-11-20T" to ":00; by=AB; second=CD; "            \
                                                              "wafer=" wafer
    static const struct {
        const char *entry[4];
        int n, asked;               /* FW-D680 */
        const char *judged, *table; /* of the last */
        int out;
    } log[] = {
        {{E("S14", "10:00", "10:12", "1"), E("S14", "10:20", "10:32", "1")},
         2,
         0,
         "in window",
         "adds up to 24 min in 2 runs\n",
         0},
        {{E("S14", "10:00", "10:10", "1"), E("S14", "10:20", "10:27", "1")},
         2,
         0,
         "unclear",
         "adds up to 17 min in 2 runs\n",
         0},
        {{E("S14", "10:00", "10:05", "1"), E("S14", "10:20", "10:24", "1")},
         2,
         0,
         "short",
         "adds up to 9 min in 2 runs",
         1},
        {{E("S14", "10:00", "10:16", "1"), E("S14", "10:20", "10:35", "1")},
         2,
         1,
         "unclear",
         "adds up to 31 min in 2 runs, and one run is to stop by 27 min 7 s",
         0},
        {{E("S14", "10:00", "10:20", "1"), E("S14", "10:30", "10:43", "1")},
         2,
         0,
         "long",
         "adds up to 33 min in 2 runs",
         1},
        {{E("S14", "10:00", "10:20", "1"), E("S14", "10:30", "10:50", "2")},
         2,
         0,
         "in window",
         NULL,
         0},
        {{E("S03", "08:00", "08:25", "1"), E("S14", "10:00", "10:20", "1"),
          E("S03", "12:00", "12:25", "1"), E("S14", "13:00", "13:20", "1")},
         4,
         0,
         "in window",
         NULL,
         0},
        {{E("S07", "08:00", "08:03", "1"), E("S14", "10:00", "10:20", "1"),
          E("S07", "12:00", "12:03", "1"), E("S14", "13:00", "13:20", "1")},
         4,
         0,
         "long",
         "adds up to 40 min in 2 runs",
         1},
        {{E("S14", "10:00", "10:20", "1"), E("S14", "10:00", "10:19", "1")},
         2,
         0,
         "in window",
         NULL,
         0},
        {{E("S14", "10:00", "10:20", "1"), E("S14", "09:00", "09:20", "1")},
         2,
         0,
         "in window",
         NULL,
         0},
        {{E("S06", "10:00", "10:20", "1"), E("S06", "10:30", "10:50", "1")},
         2,
         0,
         "in window",
         NULL,
         0},
        {{E("S08", "10:00", "10:02", "1"), E("S08", "10:30", "10:32", "1")},
         2,
         0,
         "long",
         "adds up to 4 min in 2 runs",
         1},
        {{E("S07", "09:50", "09:52", "1"), E("S08", "10:00", "10:02", "1"),
          E("S07", "10:10", "10:12", "1"), E("S08", "10:30", "10:32", "1")},
         4,
         0,
         "in window",
         NULL,
         0},
        {{E("S18", "10:00", "10:40", "1"), E("S18", "10:50", "11:30", "1"),
          E("S18", "11:40", "12:10", "1")},
         3,
         0,
         "in window",
         "adds up to 110 min in 3 runs",
         0},
    };
    flow = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    lot_wafers = "1,2";
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        fw_recipe_asrun_total total;
        fw_text table = fw_text_new(arena), json = fw_text_new(arena);
        const char *text = begun();
        int asked = 0;
        for (int k = 0; k < log[i].n; k++)
            text = with(text, log[i].entry[k], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        const fw_recipe_asrun_entry *last = &run.entry[run.nentry - 1];
        if (strcmp(fw_recipe_asrun_in_time(&run, last), log[i].judged) != 0)
            print_message("log %zu\n", i);
        assert_string_equal(fw_recipe_asrun_in_time(&run, last), log[i].judged);
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, last, (fw_place){"entry", 1, 1}, &diags), FW_OK);
        for (size_t k = 0; k < diags.count; k++)
            asked += diags.item[k].number == 680;
        assert_int_equal(asked, log[i].asked);
        assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
        assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
        if (log[i].table && !holds(&table, log[i].table))
            print_message("log %zu\n%s\n", i, table.data);
        assert_true(log[i].table ? holds(&table, log[i].table) : !holds(&table, "adds up"));
        assert_true(holds(&json, "\"runs\":") == (log[i].table != NULL));
        assert_int_equal(fw_recipe_asrun_sum_up(flow, &run, arena, &total), FW_OK);
        if (total.out != log[i].out) print_message("log %zu\n%s\n", i, table.data);
        assert_int_equal(total.out, log[i].out);
        if (holds(&table, "out of limits in runs that were repeated"))
            print_message("log %zu\n%s\n", i, strstr(table.data, "steps run"));
        assert_false(holds(&table, "out of limits in runs that were repeated"));
    }
    /* planned and actual are of the same steps: those with a planned time; the others are told beside them */
    static const char *const both[] = {
        E("S01", "08:00", "08:08", "1"), E("S03", "09:00", "09:30", "1"),
        E("S14", "10:00", "10:10", "1"), E("S14", "10:20", "10:27", "1")};
    fw_recipe_asrun run;
    fw_recipe_asrun_total total;
    fw_text table = fw_text_new(arena);
    const char *text = begun();
    for (int k = 0; k < 4; k++)
        text = with(text, both[k], 0);
    assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_sum_up(flow, &run, arena, &total), FW_OK);
    assert_near(total.actual_s, 60.0 * (8 + 10 + 7), 1e-9);
    assert_near(total.earlier_s, 600.0, 1e-9);
    assert_near(total.unplanned_s, 1800.0, 1e-9);
    assert_int_equal(total.unplanned, 1);
    fw_text page = fw_text_new(arena);
    assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
    assert_true(holds(&page, "S14 (gone on with later)"));
    assert_int_equal(total.repeated, 0);
    assert_near(total.planned_s, step_of(flow, "S01")->booked_s + step_of(flow, "S14")->booked_s,
                1e-9);
    assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
    assert_true(holds(&table, "for those that have a planned time, actual 25 min, of which 10 min "
                              "in earlier runs; 1 without a planned time took 30 min"));
#undef E
}

/* ---- what is read, and when ---- */

#define AT(step, from, to)                                                                         \
    step "; start=2026-11-20T" from ":00; end=2026-11-20T" to ":00; by=AB; second=CD; wafer=1"

static int told_of(int number) {
    int n = 0;
    for (size_t i = 0; i < diags.count; i++)
        n += diags.item[i].number == number;
    return n;
}

static void silicon(void) {
    flow = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    lot_wafers = "1,2,3";
}

/* A line of the test die is an edge in the resist until the metal below is etched, and an edge of that from there on; before it
   is developed there is none. By the times of the log, too: what was read before the step that makes it, or after the one that
   takes it away, is nothing that a plan goes by, whatever else counts. */
static void lines_in_the_resist(void **state) {
    (void)state;
#define LINES                                                                                      \
    "; coupon=cd-lines, line, drawn=10 um, value=10.04 10.06 10.02 um, u=0.05 um; "                \
    "coupon=cd-lines, space, drawn=10 um, value=9.96 9.98 9.94 um, u=0.05 um"
#define STEP "; coupon=al-step, value=0.6 um, u=0.01 um, at=50 um"
    static const struct {
        const char *entry[4];
        int n, read, told; /* readings, FW-D707 of calibrate */
        const char *of;
    } log[] = {
        {{AT("S12", "10:00", "10:08") LINES}, 1, 2, 0, "litho.edge"},
        {{AT("S11", "10:00", "10:03") LINES}, 1, 2, 0, "litho.edge"},
        {{AT("S14", "10:00", "10:17") LINES}, 1, 2, 0, "made.al-edge"},
        {{AT("S14", "10:00", "10:17"), AT("S15", "11:00", "11:07") LINES}, 2, 2, 0, "made.al-edge"},
        {{AT("S15", "11:00", "11:07") LINES, AT("S14", "12:00", "12:17")}, 2, 0, 2, NULL},
        {{AT("S14", "12:00", "12:17"), AT("S15", "11:00", "11:07") LINES}, 2, 0, 2, NULL},
        {{AT("S14", "10:00", "10:17"), AT("S12", "11:00", "11:08") LINES}, 2, 0, 2, NULL},
        {{AT("S11", "09:00", "09:03"), AT("S14", "10:00", "10:17"), AT("S11", "10:30", "10:33"),
          AT("S12", "11:00", "11:08") LINES},
         4,
         2,
         0,
         "litho.edge"},
        {{AT("S18", "12:00", "13:50") STEP}, 1, 1, 0, NULL},
        {{AT("S19", "12:00", "12:10") STEP, AT("S18", "13:00", "14:50")}, 2, 0, 1, NULL},
    };
    silicon();
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        fw_process_readings r;
        const fw_recipe_counted all = {.all_runs = true};
        const char *text = begun();
        for (int k = 0; k < log[i].n; k++)
            text = with(text, log[i].entry[k], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        diags = fw_diags_new(arena);
        assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all, &diags, &r), FW_OK);
        if (r.n != log[i].read || told_of(707) != log[i].told)
            fail_msg("%zu: %d readings, told %d times", i, r.n, told_of(707));
        assert_int_equal(r.left_out, r.n ? r.left_out : log[i].told);
        for (int k = 0; k < r.n; k++)
            assert_true(fw_text_same(r.item[k].row.of, log[i].of));
    }
    /* what is printed is calibrated as that; how far the metal is to be etched has no part in it */
    fw_recipe_asrun run;
    fw_process_readings r;
    fw_process_calibration c;
    const char *text = with(begun(), log[0].entry[0], 0);
    text = with(text, AT("S14", "11:00", "11:17"), 0);
    text =
        with(text,
             AT("S15", "12:00",
                "12:07") "; coupon=cd-lines, line, drawn=10 um, value=7.80 7.82 7.78 um, u=0.05 um",
             0);
    assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &r), FW_OK);
    r.file = "lot.log", r.sha256 = plan;
    assert_int_equal(fw_process_calibrate_wafers(arena, flow, &r, &diags, &c), FW_OK);
    assert_int_equal(c.count, 2);
    for (int i = 0; i < 2; i++) {
        const bool printed = strcmp(c.item[i].id, "litho.edge") == 0;
        assert_near(c.item[i].value, printed ? 0.02e-6 : 0.0, 1e-12);
        assert_non_null(strstr(c.item[i].source, printed ? "n = 6 readings" : "n = 3 readings"));
        assert_non_null(strstr(c.item[i].source, printed ? "step S12" : "step S15"));
    }
    for (int i = 0; i < c.nwith; i++)
        assert_string_equal(c.with[i].of, "made.al-edge");
    with(begun(), AT("S09", "10:00", "10:08") LINES, 706);
    assert_non_null(strstr(diags.item[diags.count - 1].message,
                           "the printed edge (litho.edge) from S11 to S13, the edge of the "
                           "aluminium (made.al-edge) from S14 to S20"));
    with(begun(), AT("S15", "10:00", "10:08") STEP, 706);
    assert_non_null(strstr(diags.item[diags.count - 1].message, "it reads from S18 to S20"));
    with(begun(), AT("S21", "10:00", "10:18") LINES, 706);
    /* a line that stands from before is left out, and none is left to calibrate */
    text = with(begun(), AT("S15", "10:00", "10:08") LINES, 0);
    assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
    run.entry[0].step = step_of(flow, "S09");
    diags = fw_diags_new(arena);
    assert_int_equal(fw_recipe_asrun_readings(arena, &run, &all_count, &diags, &r), FW_OK);
    assert_int_equal(told_of(706), 2);
    assert_int_equal(fw_process_calibrate_wafers(arena, flow, &r, &diags, &c), FW_INPUT);
    assert_non_null(strstr(diags.item[diags.count - 1].message,
                           "of 2 readings of coupons in the log none counts"));
#undef STEP
#undef LINES
}

/* An inspection that ended before the step began that it inspects has looked at something else, whichever of the two was entered
   first: it is told, a deviation, accepted no more and expected again */
static void inspections_come_after(void **state) {
    (void)state;
    static const struct {
        const char *entry[3], *step;
    } log[] = {
        {{AT("S15", "12:10", "12:17") "; line width in aluminium against the drawn one=-2.2 um",
          AT("S14", "12:20", "12:37"), AT("S16", "12:40", "12:55")},
         "S15"},
        {{AT("S14", "12:20", "12:37"),
          AT("S15", "12:10", "12:17") "; line width in aluminium against the drawn one=-2.2 um",
          AT("S16", "12:40", "12:55")},
         "S15"},
        {{AT("S19", "12:10", "12:20"), AT("S18", "13:00", "14:50"), AT("S20", "15:00", "16:00")},
         "S19"},
        {{AT("S12", "12:10", "12:18"), AT("S11", "13:00", "13:02"), AT("S13", "13:10", "13:15")},
         "S12"},
        {{AT("S14", "12:00", "12:17"), AT("S15", "12:18", "12:25"), AT("S16", "12:40", "12:55")},
         NULL},
        {{AT("S04", "12:10", "12:15"), AT("S05", "12:20", "12:35"), AT("S06", "12:40", "13:00")},
         NULL},
    };
    silicon();
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        fw_recipe_deviation *list;
        fw_text table = fw_text_new(arena), json = fw_text_new(arena), page = fw_text_new(arena);
        const char *text = begun();
        int n, began = 0, without = 0;
        for (int k = 0; k < 3; k++)
            text = with(text, log[i].entry[k], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, &run.entry[1], (fw_place){"entry", 1, 1}, &diags),
            FW_OK);
        if (told_of(707) != (log[i].step != NULL)) fail_msg("%zu: told %d times", i, told_of(707));
        assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
        for (int k = 0; k < n; k++) {
            began += strstr(list[k].actual, "began ") != NULL;
            without += strcmp(list[k].what, "not run again") == 0;
        }
        assert_int_equal(began, log[i].step != NULL);
        assert_int_equal(without, log[i].step != NULL);
        assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
        assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
        assert_int_equal(fw_recipe_asrun_write_html(flow, &run, &page), FW_OK);
        assert_int_equal(holds(&json, "\"overtaken_by\":{\"step\":"), log[i].step != NULL);
        assert_int_equal(holds(&table, "was run after it at"), log[i].step != NULL);
        assert_int_equal(holds(&page, "before") && holds(&page, "ended"), log[i].step != NULL);
        if (!log[i].step) continue;
        assert_false(holds(&table, "-2.2 um: accepted"));
        assert_false(holds(&json, "-2.2,\"unit\":\"um\",\"accepted\":true"));
        assert_true(fw_recipe_asrun_expects(&run, step_of(flow, log[i].step), "1"));
    }
}

/* A difference may lie as far off as a step that was badly overdone leaves it, and never is what is accepted refused; a whole
   width in its place, or another unit, is asked after */
static void differences_are_taken(void **state) {
    (void)state;
    static const struct {
        const char *is;
        int asked;
    } of[] = {{"-2.2", 0}, {"-3.3", 0}, {"-6.6", 0},   {"-0.0033 mm", 0},
              {"7.8", 1},  {"-220", 1}, {"2200 nm", 0}};
    silicon();
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        int asked = 0;
        with(begun(),
             fw_arena_printf(arena, "%s; line width in aluminium against the drawn one=%s%s",
                             AT("S15", "10:00", "10:07"), of[i].is,
                             strchr(of[i].is, 'm') ? "" : " um"),
             0);
        for (size_t k = 0; k < diags.count; k++)
            asked += diags.item[k].number == 283 &&
                     strstr(diags.item[k].message, "is the unit right") != NULL;
        if (asked != of[i].asked) fail_msg("%s: asked %d times", of[i].is, asked);
    }
    with(begun(),
         AT("S15", "10:00", "10:07") "; line width in aluminium against the drawn one=-1 m", 278);
}

/* A filling that is named serves so many wafers, and keeps so long from when it was mixed; under another name it is another
   one, and what is mixed anew under the same name as well */
static void fillings_serve_so_many(void **state) {
    (void)state;
#define C(step, wafer, day, from, to, name)                                                        \
    step "; start=2026-11-" day "T" from ":00; end=2026-11-" day "T" to                            \
         ":00; by=AB; second=CD" wafer "; bath=" name
    static const struct {
        bool silicon;
        const char *entry[3];
        int n;
        const char *is; /* of the last one; NULL: it does not say so */
    } log[] = {
        {true,
         {C("S14", "; wafer=1", "20", "10:00", "10:17", "A"),
          C("S14", "; wafer=2", "20", "11:00", "11:17", "B")},
         2,
         NULL},
        {true,
         {C("S14", "; wafer=1", "20", "10:00", "10:17", "A"),
          C("S14", "; wafer=2", "20", "11:00", "11:17", "A")},
         2,
         "wafer 2 of one filling"},
        {true,
         {C("S14", "; wafer=1", "20", "10:00", "10:10", "A"),
          C("S14", "; wafer=1", "20", "10:20", "10:27", "A")},
         2,
         NULL},
        {true,
         {C("S14", "; wafer=1", "20", "10:00", "10:17", "A"),
          C("S14", "; wafer=2", "20", "11:00", "11:17", "A; replaces=2")},
         1,
         NULL},
        {false,
         {C("C05", "; wafer=1", "20", "10:00", "10:02", "A"),
          C("C05", "; wafer=2", "20", "17:00", "17:02", "A")},
         2,
         NULL},
        {false,
         {C("C05", "; wafer=1", "20", "10:00", "10:02", "A"),
          C("C05", "; wafer=2", "21", "10:00", "10:02", "A")},
         2,
         "24 h after it was first used"},
        {false,
         {C("C03", "", "20", "08:00", "08:30", "A"),
          C("C05", "; wafer=1", "21", "10:30", "10:30", "A")},
         2,
         "26 h after it was mixed"},
        {false,
         {C("C05", "; wafer=1", "20", "10:00", "10:02", "A"),
          C("C03", "", "21", "08:00", "08:30", "A"),
          C("C05", "; wafer=2", "21", "10:00", "10:02", "A")},
         3,
         NULL},
    };
    fw_process_flow *both[2] = {flow, NULL};
    silicon();
    both[1] = flow;
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        fw_recipe_deviation *list;
        fw_text table = fw_text_new(arena);
        int n, of_bath = 0;
        flow = both[log[i].silicon];
        const char *text = begun();
        for (int k = 0; k < log[i].n; k++)
            text = with(text, log[i].entry[k], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        assert_int_equal(fw_recipe_asrun_ask_time(arena, &run, &run.entry[run.nentry - 1],
                                                  (fw_place){"entry", 1, 1}, &diags),
                         FW_OK);
        if (told_of(708) != (log[i].is != NULL)) fail_msg("%zu: told %d times", i, told_of(708));
        assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
        for (int k = 0; k < n; k++)
            if (strcmp(list[k].what, "bath A") == 0) {
                of_bath++;
                if (!log[i].is || !strstr(list[k].actual, log[i].is))
                    fail_msg("%zu: %s", i, list[k].actual);
            }
        assert_int_equal(of_bath, log[i].is != NULL);
        assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
        assert_int_equal(holds(&table, "      bath A: "), log[i].is != NULL);
    }
#undef C
}

/* A developer goes on for as long as the wafer is in it: beyond its stop time with a minute each for rinse and drying (96 s and
   2 min) nobody knows what the rest was, and it is not in its window until the time in it is logged. A plasma is switched off. */
static void left_in_the_bath(void **state) {
    (void)state;
    static const struct {
        const char *entry[2], *judged;
        int told;
    } log[] = {
        {{AT("S11", "10:00", "10:03")}, "in window", 0},
        {{AT("S11", "10:00", "10:05")},
         "in window",
         0}, /* as the plan has it there, handling included */
        {{"S11; start=2026-11-20T10:00:00; end=2026-11-20T10:05:10; by=AB; wafer=1"}, "unclear", 1},
        {{AT("S11", "10:00", "10:20")}, "long", 0},
        {{AT("S11", "10:00", "10:04"), AT("S11", "10:00", "10:01")}, "in window", 0},
        {{AT("S18", "10:00", "12:10")}, "in window", 0},
    };
    silicon();
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        fw_text table = fw_text_new(arena), json = fw_text_new(arena);
        const char *text = with(begun(), log[i].entry[0], 0);
        if (log[i].entry[1]) text = with(text, log[i].entry[1], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        const fw_recipe_asrun_entry *e = &run.entry[run.nentry - 1];
        if (strcmp(fw_recipe_asrun_in_time(&run, e), log[i].judged) != 0)
            fail_msg("%zu: %s", i, fw_recipe_asrun_in_time(&run, e));
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, e, (fw_place){"entry", 1, 1}, &diags), FW_OK);
        assert_int_equal(told_of(684), log[i].told);
        assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
        assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
        assert_int_equal(holds(&table, "took 5 min 10 s, and is to stop by 96 s, with what is "
                                       "finished at the bench by 5 min; was the rest in it?"),
                         log[i].told);
        assert_int_equal(holds(&json, "\"judged\":\"unclear\""), log[i].told);
    }
}

/* A step in parts is logged by the clock, with its pauses: what they leave of an entry that reaches the first look may be too short,
   which is asked, and the end by the clock answers it. What is scheduled is asked nothing. */
static void pauses_between_parts(void **state) {
    (void)state;
    silicon();
    const fw_process_step *s = NULL;
    for (const fw_process_step *k = flow->step; k < flow->step + flow->nstep; k++)
        if (strcmp(k->id, "S18") == 0) s = k;
    assert_non_null(s);
    assert_near(fw_process_step_own_s(s, 110 * 60.0), 90 * 60.0,
                1e-9); /* 30 min, 10 min, 30, 10, 30 */
    assert_near(fw_process_step_own_s(s, 35 * 60.0), 30 * 60.0, 1e-9);
    const struct {
        double took_s;
        const char *judged;
        int told;
    } of[] = {{s->time.first_look_s - 60.0, "short", 0},
              {s->time.first_look_s + 120.0, "unclear", 1},
              {s->booked_s + 1.0, "in window", 0}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        fw_recipe_asrun run;
        fw_text table = fw_text_new(arena);
        const int t = (int)of[i].took_s;
        const char *text =
            with(begun(),
                 fw_arena_printf(arena,
                                 "S18; start=2026-11-20T10:00:00; end=2026-11-20T%02d:%02d:%02d; "
                                 "by=AB; second=CD; wafer=1",
                                 10 + t / 3600, t / 60 % 60, t % 60),
                 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        assert_string_equal(fw_recipe_asrun_in_time(&run, run.entry), of[i].judged);
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, run.entry, (fw_place){"entry", 1, 1}, &diags),
            FW_OK);
        assert_int_equal(told_of(732), of[i].told);
        assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
        assert_int_equal(holds(&table, "; or was that without them?"), of[i].told);
    }
}

/* A rinse of 5 min is in the time by the clock, or it is not: what it leaves of an entry that reaches the first look (13 min 14 s) may
   be too short, of one run and of the sum of several, which is asked. The end by the clock answers it, and so does the end of the
   etch alone, which then is short; what was asked since it was long is answered by that, too. As scheduled nothing is asked. */
static void finishes_inside(void **state) {
    (void)state;
    static const struct {
        const char *entry[2], *judged, *left;
        int told;
    } of[] = {
        {{AT("S14", "13:00", "13:15")},
         "unclear",
         "took 15 min, of which its finishes leave 10 min, and the first look is at 13 min 14 s; "
         "or was that without them?",
         1},
        {{AT("S14", "13:00", "13:15"), AT("S14", "13:00", "13:20")}, "in window", NULL, 0},
        {{AT("S14", "13:00", "13:15"), AT("S14", "13:00", "13:10")}, "short", NULL, 0},
        {{AT("S14", "13:00", "13:10"), AT("S14", "13:12", "13:20")},
         "unclear",
         "took 18 min in 2 runs, of which its finishes leave 8 min, ",
         1},
        {{AT("S14", "13:00", "13:15"), AT("S14", "13:17", "13:27")}, "in window", NULL, 0},
        {{AT("S14", "13:00", "13:12")}, "short", NULL, 0},
        {{"S14; start=2026-11-20T13:00:00; end=2026-11-20T13:23:20; by=AB; wafer=1"},
         "in window",
         NULL,
         0},
        {{AT("S14", "13:00", "13:15") "; set etch rate=20 Ao/s", AT("S14", "13:00", "13:08")},
         "in window",
         NULL,
         0},
        {{AT("S14", "13:00", "13:08") "; set etch rate=20 Ao/s"},
         "unclear",
         "took 8 min, of which its finishes leave 3 min, ",
         1},
        {{AT("C22", "13:00", "13:21")},
         "unclear",
         "took 21 min, of which its finishes leave 18 min, ",
         1},
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        fw_recipe_asrun run;
        fw_text table = fw_text_new(arena);
        silicon();
        if (of[i].entry[0][0] == 'C') {
            flow = read_pack(arena, COPPER, NULL, NULL, &diags);
            assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
        }
        const char *text = with(begun(), of[i].entry[0], 0);
        if (of[i].entry[1]) text = with(text, of[i].entry[1], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        const fw_recipe_asrun_entry *e = &run.entry[run.nentry - 1];
        if (strcmp(fw_recipe_asrun_in_time(&run, e), of[i].judged) != 0)
            fail_msg("%zu: %s", i, fw_recipe_asrun_in_time(&run, e));
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, e, (fw_place){"entry", 1, 1}, &diags), FW_OK);
        if (told_of(759) != of[i].told) fail_msg("%zu: told %d times", i, told_of(759));
        assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
        if (of[i].left && !holds(&table, of[i].left)) fail_msg("%zu: %s", i, table.data);
    }
}

/* Of 3 h 20 min with parts of 30 min and pauses of 10 min 150 min were etched, or more: pauses of the time that was logged, not those
   of the stop time, are none of the least that the law makes of it. So it is of a run that was gone on with, and of what is held
   against a depth. */
static void least_of_a_long_time(void **state) {
    (void)state;
    static const struct {
        const char *entry[2];
        double etch_s; /* at least */
    } of[] = {
        {{AT("S18", "14:00", "17:20")}, 150 * 60.0},
        {{AT("S18", "14:00", "15:30"), AT("S18", "16:00", "17:50")}, (70 + 90) * 60.0},
        {{AT("S14", "14:00", "14:40")}, 35 * 60.0},
    };
    silicon();
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        fw_recipe_asrun run;
        char least[64], number[32];
        bool found = false;
        const char *text = with(begun(), of[i].entry[0], 0);
        if (of[i].entry[1]) text = with(text, of[i].entry[1], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        const fw_recipe_asrun_entry *e = &run.entry[run.nentry - 1];
        const fw_process_argument *a = fw_recipe_asrun_amount_of_law(e->step);
        assert_non_null(a);
        double amount_m = a->q->value;
        assert_int_equal(fw_process_step_amount_in(arena, e->step, (int)(a - e->step->argument),
                                                   of[i].etch_s, &amount_m),
                         FW_OK);
        fw_process_law_answer answer; /* there and back */
        assert_int_equal(fw_process_step_time_of(arena, e->step, (int)(a - e->step->argument),
                                                 amount_m, &answer),
                         FW_OK);
        assert_near(answer.value, of[i].etch_s, 1e-6 * of[i].etch_s);
        assert_string_equal(fw_recipe_asrun_in_time(&run, e), "long");
        assert_int_equal(
            fw_recipe_asrun_ask_time(arena, &run, e, (fw_place){"entry", 1, 1}, &diags), FW_OK);
        snprintf(least, sizeof least, "by its law that makes at least %s um",
                 fw_number_text(number, sizeof number, amount_m * 1e6, 3));
        for (size_t k = 0; k < diags.count; k++)
            found = found || strstr(diags.item[k].message, least);
        if (!found) fail_msg("%zu: no '%s'", i, least);
    }
}

/* a step that is done once for a lot, logged for its wafers, took its time once, as a load does */
static void a_step_of_the_lot_counts_once(void **state) {
    (void)state;
    silicon();
    lot_wafers = "1,2";
    for (int one = 0; one < 2; one++) {
        fw_recipe_asrun run;
        fw_recipe_asrun_total t;
        const char *text = begun();
        for (int w = 0; w < (one ? 1 : 2); w++)
            text = with(text,
                        fw_arena_printf(
                            arena,
                            "S17; start=2026-11-20T10:00; end=2026-11-20T10:20; by=AB; second=CD%s",
                            one ? ""
                            : w ? "; wafer=2"
                                : "; wafer=1"),
                        0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        assert_true(fw_process_step_is_of_lot(run.entry->step));
        assert_int_equal(fw_recipe_asrun_sum_up(flow, &run, arena, &t), FW_OK);
        assert_near(t.actual_s + t.unplanned_s, 1200.0, 1e-6);
        assert_near(t.planned_s, run.entry->step->booked_s, 1e-6);
        assert_string_equal(fw_recipe_asrun_in_time(&run, run.entry), "in window");
    }
}

/* slots that were etched for longer than their run took; a mask of which more or less was lost than is gone */
static void entries_that_contradict_themselves(void **state) {
    (void)state;
    static const struct {
        const char *entry[2];
        int told;
    } log[] = {
        {{AT("S18", "10:00",
             "10:50") "; coupon=arde-slots, drawn=10 um, value=45.6 45.4 um, u=0.1 um, at=90 min"},
         1},
        {{AT("S18", "10:00",
             "12:00") "; coupon=arde-slots, drawn=10 um, value=45.6 45.4 um, u=0.1 um, at=90 min"},
         0},
        {{AT("S18", "10:00", "10:50"),
          AT("S19", "11:00",
             "11:10") "; coupon=arde-slots, drawn=10 um, value=45.6 45.4 um, u=0.1 um, at=90 min"},
         1},
        {{AT("S18", "10:00", "10:50"),
          AT("S18", "11:00",
             "11:50") "; coupon=arde-slots, drawn=10 um, value=45.6 45.4 um, u=0.1 um, at=90 min"},
         0},
        {{AT("S18", "10:00", "12:00") "; coupon=al-step, value=0.2 um, u=0.01 um, at=50 um; "
                                      "aluminium left=0.4 0.41 0.39 0.4 0.4 um"},
         1},
        {{AT("S18", "10:00", "12:00") "; coupon=al-step, value=0.58 um, u=0.01 um, at=50 um; "
                                      "aluminium left=0.4 0.41 0.39 0.4 0.4 um"},
         0},
    };
    silicon();
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        const char *text = with(begun(), log[i].entry[0], 0);
        if (log[i].entry[1]) text = with(text, log[i].entry[1], 0);
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        assert_int_equal(fw_recipe_asrun_ask_time(arena, &run, &run.entry[run.nentry - 1],
                                                  (fw_place){"entry", 1, 1}, &diags),
                         FW_OK);
        if (told_of(709) != log[i].told) fail_msg("%zu: told %d times", i, told_of(709));
    }
}
#undef AT

/* What was found before an earlier step was run again is not passed: it is asked for with the entry of the rework, expected in the
   table, told once more where the next step follows, and a deviation where somebody went on. A resist that was coated again has
   its bakes to see again. Times that are put right and another wafer overtake nothing. */
static void inspections_are_overtaken(void **state) {
    (void)state;
#define E(step, from, to, wafer)                                                                   \
    step "; start=2026-11-20T" from ":00; end=2026-11-20T" to ":00; by=AB; second=CD; "            \
                                                              "wafer=" wafer
    static const struct {
        const char *entry[5];
        int n, told; /* FW-D687 of the last one */
        const char *expected, *step, *deviation;
    } log[] = {
        {{E("S14", "10:00", "10:17", "1"), E("S15", "11:00", "11:07", "1"),
          E("S14", "12:00", "12:02", "1")},
         3,
         1,
         "not yet: wafer 1",
         "S15",
         NULL},
        {{E("S14", "10:00", "10:17", "1"), E("S15", "11:00", "11:07", "1"),
          E("S14", "12:00", "12:02", "1"), E("S16", "13:00", "13:15", "1")},
         4,
         1,
         "not yet: wafer 1",
         "S15",
         "not run again"},
        {{E("S14", "10:00", "10:17", "1"), E("S15", "11:00", "11:07", "1"),
          E("S14", "12:00", "12:02", "1"), E("S15", "12:30", "12:37", "1"),
          E("S16", "13:00", "13:15", "1")},
         5,
         0,
         NULL,
         NULL,
         NULL},
        {{E("S14", "10:00", "10:17", "1"), E("S15", "11:00", "11:07", "1"),
          E("S14", "09:59", "10:16", "1")},
         3,
         0,
         NULL,
         NULL,
         NULL},
        {{E("S14", "10:00", "10:17", "1"), E("S15", "11:00", "11:07", "1"),
          E("S14", "12:00", "12:17", "2")},
         3,
         0,
         NULL,
         NULL,
         NULL},
        {{E("S07", "10:00", "10:03", "1"), E("S08", "10:05", "10:07", "1"),
          E("S07", "12:00", "12:03", "1")},
         3,
         1,
         "not yet: wafer 1",
         "S08",
         NULL},
        {{E("S14", "10:00", "10:17", "1"), E("S15", "11:00", "11:07", "1"),
          E("S15", "12:00", "12:07", "1")},
         3,
         0,
         NULL,
         NULL,
         NULL},
    };
    flow = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
    lot_wafers = "1,2";
    for (size_t i = 0; i < sizeof log / sizeof log[0]; i++) {
        fw_recipe_asrun run;
        fw_recipe_deviation *list;
        fw_text table = fw_text_new(arena), json = fw_text_new(arena);
        const char *text = begun();
        int told = 0, n, without = 0;
        for (int k = 0; k < log[i].n; k++)
            text = with(text, log[i].entry[k], 0);
        for (size_t k = 0; k < diags.count; k++)
            told += diags.item[k].number == 687;
        assert_int_equal(read_log(text, strlen(text), &run), FW_OK);
        assert_int_equal(fw_recipe_asrun_ask_time(arena, &run, &run.entry[run.nentry - 1],
                                                  (fw_place){"entry", 1, 1}, &diags),
                         FW_OK);
        for (size_t k = 0; k < diags.count; k++)
            told += diags.item[k].number == 687;
        if (told != log[i].told) fail_msg("%zu: told %d times", i, told);
        assert_int_equal(fw_recipe_asrun_write_text(flow, &run, &table), FW_OK);
        assert_int_equal(fw_recipe_asrun_write_json(flow, &run, &json), FW_OK);
        assert_int_equal(holds(&table, "overtaken: "), log[i].step != NULL);
        assert_int_equal(holds(&json, "\"overtaken_by\":{\"step\":"), log[i].step != NULL);
        if (log[i].step) {
            assert_true(holds(&table, log[i].expected));
            assert_true(fw_recipe_asrun_expects(&run, step_of(flow, log[i].step), "1"));
        }
        assert_int_equal(fw_recipe_asrun_deviations(arena, flow, &run, &list, &n), FW_OK);
        for (int k = 0; k < n; k++)
            without += strcmp(list[k].what, "not run again") == 0;
        assert_int_equal(without, log[i].deviation != NULL);
    }
#undef E
}

/* what calibrate could make nothing of is not written */
static void coupons_of_other_flows(void **state) {
    (void)state;
    static const char *const words[] = {
        "coupon=al-step, value=0.4 um, u=0.01 um, at=50 um",
        "coupon=arde-slots, drawn=10 um, value=45 um, u=0.1 um, at=90 min"};
    fw_recipe_asrun run;
    const char *line;
    with(begun(), entry("coupon=etch-rate, seed.Q, value=1 um, u=0.01 um, at=5 min"), 605);
    with(begun(), entry("coupon=etch-rate, seed.d, value=1 um, u=0.01 um, at=5 min"), 605);
    with(begun(), entry("coupon=etch-rate, seed.R, value=1 um, u=0.01 um, at=5 min"), 0);
    const fw_layout_pattern_kind pads = {.name = "plating-pads"};
    const fw_layout_pattern pattern = {.kind = &pads, .id = "pads"};
    const fw_mask_table table = {.pattern = &pattern, .npattern = 1};
    const char *log = begun();
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        run.table = &table;
        assert_int_equal(fw_recipe_asrun_add(arena, flow, &run, entry(words[i]),
                                             (fw_place){"entry", 1, 1}, now, &diags, &line),
                         FW_INPUT);
        assert_int_equal(diags.item[diags.count - 1].number, 605);
    }
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    run.table = &table;
    assert_int_equal(
        fw_recipe_asrun_add(
            arena, flow, &run,
            entry("coupon=plating-pads, drawn=10 um, value=9.1 um, u=0.1 um, at=25 C/cm2"),
            (fw_place){"entry", 1, 1}, now, &diags, &line),
        FW_OK);
    /* a width that the die does not have is asked after, with those that there are */
    const fw_layout_pattern sized = {
        .kind = &pads, .id = "pads", .size_m = {10e-6, 30e-6}, .nsize = 2};
    const fw_mask_table widths = {.pattern = &sized, .npattern = 1};
    static const char *const drawn[] = {"12", "10", "30"};
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0]; i++) {
        bool told = false;
        assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
        run.table = &widths;
        const char *of = fw_arena_printf(
            arena, "coupon=plating-pads, drawn=%s um, value=9.1 um, u=0.1 um, at=25 C/cm2",
            drawn[i]);
        assert_int_equal(fw_recipe_asrun_add(arena, flow, &run, entry(of),
                                             (fw_place){"entry", 1, 1}, now, &diags, &line),
                         FW_OK);
        for (size_t k = 0; k < diags.count; k++)
            told =
                told ||
                strstr(
                    diags.item[k].message,
                    "coupon plating-pads, drawn=12 um: on the test die it is drawn with 10, 30 um");
        assert_int_equal(told, i == 0);
    }
}

/* the year 2126 has not come; ages ago is asked about; before 1970 and far ahead are dates like others */
static void the_clock(void **state) {
    (void)state;
    const char *some = "C20; start=2026-11-20T10:00; end=2026-11-20T10:09; by=A";
    now = 86400.0 * 20777.0 + 36000.0; /* 2026-11-20T10:00 */
    with(begun(), some, 0);
    assert_int_equal(diags.count, 2); /* the step before, and a value that is not there */
    with(begun(), "C20; start=2026-11-20T10:00; end=2126-11-20T10:09; by=A", 282);
    assert_non_null(strstr(diags.item[diags.count - 1].message, "is in the future"));
    with(begun(), "C20; start=2026-11-22T10:00; end=2026-11-22T10:09; by=A", 282);
    with(begun(), "C20; start=1926-11-20T10:00; end=1926-11-20T10:09; by=A", 0);
    assert_non_null(strstr(diags.item[0].message, "more than a year ago"));
    now = (double)NAN;
    fw_recipe_asrun run;
    const char *log = with(begun(), "C20; start=1969-12-31T23:59; end=2126-01-01T00:01; by=A", 0);
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_near(run.entry[0].start_s, -60.0, 0.0);
    assert_near(run.entry[0].end_s, 86400.0 * 56978.0 + 60.0, 0.0);
}

/* ---- the file ---- */
static const char *temporary(void) {
    const char *path = fw_arena_printf(
        arena, "%s/asrun-%ld", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp", (long)getpid());
    unlink(path);
    return path;
}

/* eight writers at once: every line whole, none lost */
static void writers_wait_for_each_other(void **state) {
    (void)state;
    enum { WRITERS = 8, LINES = 20 };
    const char *path = temporary();
    for (int w = 0; w < WRITERS; w++)
        if (fork() == 0) {
            for (int i = 0; i < LINES; i++) {
                fw_append file;
                if (fw_append_open(arena, path, 1u << 20, &diags, &file) != FW_OK) _exit(1);
                size_t before = file.n; /* the line says how long the file was: 6 bytes each */
                char line[16];
                snprintf(line, sizeof line, "%5zu\n", before);
                if (fw_append_text(&file, line, 6) != FW_OK) _exit(1);
                fw_append_close(&file);
            }
            _exit(0);
        }
    for (int w = 0; w < WRITERS; w++) {
        int status;
        assert_true(wait(&status) > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    fw_append file;
    assert_int_equal(fw_append_open(arena, path, 1u << 20, &diags, &file), FW_OK);
    assert_int_equal(file.n, WRITERS * LINES * 6);
    for (size_t i = 0; i < WRITERS * LINES; i++)
        assert_int_equal((size_t)atol(file.text + 6 * i), 6 * i);
    fw_append_close(&file);
    unlink(path);
}

/* no room: the file is as it was; nothing written: no file */
static void no_room(void **state) {
    (void)state;
    fw_append file;
    const char *path = temporary();
    assert_int_equal(fw_append_open(arena, path, 1u << 20, &diags, &file), FW_OK);
    fw_append_close(&file);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(fw_append_open(arena, path, 1u << 20, &diags, &file), FW_OK);
    assert_int_equal(fw_append_text(&file, "0123456789\n", 11), FW_OK);
    struct rlimit before, small;
    getrlimit(RLIMIT_FSIZE, &before);
    small = before;
    small.rlim_cur = 15;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    assert_int_equal(fw_append_text(&file, "0123456789\n", 11), FW_IO);
    setrlimit(RLIMIT_FSIZE, &before);
    fw_append_close(&file);
    assert_int_equal(fw_append_open(arena, path, 1u << 20, &diags, &file), FW_OK);
    assert_int_equal(file.n, 11);
    fw_append_close(&file);
    assert_int_equal(fw_append_open(arena, path, 10, &diags, &file), FW_LIMIT);
    unlink(path);
    assert_int_equal(fw_append_open(arena, "/nonexistent/log", 10, &diags, &file), FW_IO);
}

/* lines taken off at the end are seen by the head; one line more than it says is an interrupted entry */
static void heads(void **state) {
    (void)state;
    fw_recipe_asrun run;
    const char *log = three(), *head, *second;
    assert_int_equal(read_log(log, strlen(log), &run), FW_OK);
    assert_int_equal(fw_recipe_asrun_head(arena, 3, run.chain, &head), FW_OK);
    assert_int_equal(fw_recipe_asrun_head(arena, 2, run.entry[1].chain, &second), FW_OK);
    assert_int_equal(fw_recipe_asrun_check_head(&run, "h", head, strlen(head), &diags), FW_OK);
    assert_int_equal(fw_recipe_asrun_check_head(&run, "h", second, strlen(second), &diags), FW_OK);
    const char *none;
    assert_int_equal(fw_recipe_asrun_head(arena, 0, run.begun, &none), FW_OK);
    assert_int_equal(fw_recipe_asrun_check_head(&run, "h", none, strlen(none), &diags), FW_OK);
    for (size_t i = 0; i < strlen(head); i++) { /* any byte of it */
        char *bad = fw_arena_strdup(arena, head);
        bad[i] = bad[i] == '3' ? '4' : '3';
        if (strcmp(bad, head) == 0) continue;
        assert_int_equal(fw_recipe_asrun_check_head(&run, "h", bad, strlen(bad), &diags), FW_INPUT);
        assert_int_equal(fw_recipe_asrun_check_head(&run, "h", head, i, &diags), FW_INPUT);
    }
    size_t n = strlen(log) - 1;
    while (log[n - 1] != '\n')
        n--;
    assert_int_equal(read_log(log, n, &run), FW_OK); /* the chain sees nothing */
    assert_int_equal(fw_recipe_asrun_check_head(&run, "h", head, strlen(head), &diags), FW_INPUT);
    assert_int_equal(diags.item[diags.count - 1].number, 280);
    assert_non_null(strstr(diags.item[diags.count - 1].message, "removed at its end"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(heads, setup, teardown),
        cmocka_unit_test_setup_teardown(what_is_written_is_read, setup, teardown),
        cmocka_unit_test_setup_teardown(a_wafer_is_in_one_place, setup, teardown),
        cmocka_unit_test_setup_teardown(runs_add_up, setup, teardown),
        cmocka_unit_test_setup_teardown(what_was_put_right_stands, setup, teardown),
        cmocka_unit_test_setup_teardown(dates, setup, teardown),
        cmocka_unit_test_setup_teardown(clocks_that_are_changed, setup, teardown),
        cmocka_unit_test_setup_teardown(refused_entries, setup, teardown),
        cmocka_unit_test_setup_teardown(changes_are_seen, setup, teardown),
        cmocka_unit_test_setup_teardown(answers_are_one_or_of_all_sites, setup, teardown),
        cmocka_unit_test_setup_teardown(orders_are_not_logged, setup, teardown),
        cmocka_unit_test_setup_teardown(another_plan, setup, teardown),
        cmocka_unit_test_setup_teardown(clocks_are_read_to_the_minute, setup, teardown),
        cmocka_unit_test_setup_teardown(planned_against_actual, setup, teardown),
        cmocka_unit_test_setup_teardown(what_was_set_counts, setup, teardown),
        cmocka_unit_test_setup_teardown(a_line_is_replaced, setup, teardown),
        cmocka_unit_test_setup_teardown(a_log_goes_on_by_another_plan, setup, teardown),
        cmocka_unit_test_setup_teardown(readings_of_bad_runs, setup, teardown),
        cmocka_unit_test_setup_teardown(inspections_are_overtaken, setup, teardown),
        cmocka_unit_test_setup_teardown(lines_in_the_resist, setup, teardown),
        cmocka_unit_test_setup_teardown(inspections_come_after, setup, teardown),
        cmocka_unit_test_setup_teardown(differences_are_taken, setup, teardown),
        cmocka_unit_test_setup_teardown(fillings_serve_so_many, setup, teardown),
        cmocka_unit_test_setup_teardown(left_in_the_bath, setup, teardown),
        cmocka_unit_test_setup_teardown(pauses_between_parts, setup, teardown),
        cmocka_unit_test_setup_teardown(finishes_inside, setup, teardown),
        cmocka_unit_test_setup_teardown(least_of_a_long_time, setup, teardown),
        cmocka_unit_test_setup_teardown(a_step_of_the_lot_counts_once, setup, teardown),
        cmocka_unit_test_setup_teardown(entries_that_contradict_themselves, setup, teardown),
        cmocka_unit_test_setup_teardown(writers_wait_for_each_other, setup, teardown),
        cmocka_unit_test_setup_teardown(no_room, setup, teardown),
        cmocka_unit_test_setup_teardown(sites_and_settings, setup, teardown),
        cmocka_unit_test_setup_teardown(refused_values, setup, teardown),
        cmocka_unit_test_setup_teardown(readings, setup, teardown),
        cmocka_unit_test_setup_teardown(readings_of_warm_baths, setup, teardown),
        cmocka_unit_test_setup_teardown(wafer_lists, setup, teardown),
        cmocka_unit_test_setup_teardown(anything_typed, setup, teardown),
        cmocka_unit_test_setup_teardown(wafers_are_no_repetitions, setup, teardown),
        cmocka_unit_test_setup_teardown(the_clock, setup, teardown),
        cmocka_unit_test_setup_teardown(a_thickness_goes_with_its_time, setup, teardown),
        cmocka_unit_test_setup_teardown(wafers_that_are_out, setup, teardown),
        cmocka_unit_test_setup_teardown(deviations_are_written_down, setup, teardown),
        cmocka_unit_test_setup_teardown(readings_of_what_is_out, setup, teardown),
        cmocka_unit_test_setup_teardown(waits_are_not_below_nothing, setup, teardown),
        cmocka_unit_test_setup_teardown(an_entry_is_made_once, setup, teardown),
        cmocka_unit_test_setup_teardown(loads_share_their_time, setup, teardown),
        cmocka_unit_test_setup_teardown(values_go_by_the_plan_of_their_line, setup, teardown),
        cmocka_unit_test_setup_teardown(steps_left_out_and_times_of_no_plan, setup, teardown),
        cmocka_unit_test_setup_teardown(machines_take_so_many, setup, teardown),
        cmocka_unit_test_setup_teardown(coupons_of_other_flows, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
