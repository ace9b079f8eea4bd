/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The schedule as documents, of the packs as they are: read back, they say what was computed. */
#include "../process/pack_fixture.h"
#include "recipe/recipe.h"
#include <jansson.h>
#include <stdlib.h>

static const char *const flows[] = {COPPER, SILICON};

static fw_process_flow *computed(const char *name, const char *from, const char *to) {
    fw_process_flow *f = read_pack(arena, name, from, to, &diags);
    assert_non_null(f);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    return f;
}

static const fw_schedule *scheduled(const fw_process_flow *f, int wafers, int operators,
                                    const char *planned) {
    const fw_schedule *s;
    fw_schedule_options o = {
        .wafers = wafers, .operators = operators, .planned = planned, .effort = 20};
    assert_int_equal(fw_schedule_make(arena, f, &o, &diags, &s), FW_OK);
    return s;
}

typedef fw_status (*writer)(const fw_process_flow *, const fw_recipe_header *, fw_text *);

static const char *written(writer write, const fw_process_flow *f, const fw_schedule *s) {
    fw_text out = fw_text_new(arena);
    fw_recipe_header h = {.device = "d<&>\"1\"", .mask_sha256 = "00", .schedule = s};
    assert_int_equal(write(f, &h, &out), FW_OK);
    return out.data;
}

static int occurrences(const char *text, const char *what) {
    int n = 0;
    for (const char *at = text; (at = strstr(at, what)) != NULL; at += strlen(what))
        n++;
    return n;
}

static void json_and_csv(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++)
        for (int wafers = 1; wafers <= 7; wafers += 3) {
            const fw_process_flow *f = computed(flows[i], NULL, NULL);
            const fw_schedule *s = scheduled(f, wafers, 2, NULL);
            json_t *json = json_loads(written(fw_recipe_write_schedule_json, f, s), 0, NULL);
            assert_non_null(json);
            assert_true(s->feasible);
            assert_near(json_number_value(json_object_get(json, "makespan_s")), s->makespan_s,
                        1e-6);
            assert_true(json_number_value(json_object_get(json, "lower_bound_s")) <=
                        s->makespan_s + 1e-6);
            json_t *runs = json_object_get(json, "runs"), *steps = json_object_get(json, "steps");
            assert_int_equal(json_array_size(runs), s->nrun);
            assert_int_equal(json_array_size(steps), f->nstep);
            double wafer_runs = 0;
            for (size_t k = 0; k < json_array_size(runs); k++)
                wafer_runs += json_number_value(json_object_get(json_array_get(runs, k), "wafers"));
            assert_near(wafer_runs, (double)f->nstep * wafers, 0);
            for (int k = 0; k < f->nstep; k++) {
                const char *time =
                    json_string_value(json_object_get(json_array_get(steps, (size_t)k), "time"));
                assert_string_equal(time, f->step[k].time.computable ? "computed" : "unknown");
            }
            json_decref(json);
            const char *csv = written(fw_recipe_write_schedule_csv, f, s);
            assert_int_equal(occurrences(csv, "\n"), s->nrun + 1);
        }
}

/* every run is in the picture, and every load has a band for each of its wafers */
static void picture(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        const fw_process_flow *f = computed(flows[i], NULL, NULL);
        const fw_schedule *s = scheduled(f, 6, 1, NULL);
        const char *svg = written(fw_recipe_write_schedule_svg, f, s);
        int attended = 0;
        for (int k = 0; k < s->nrun; k++)
            attended += s->run[k].operator_ >= 0;
        assert_true(occurrences(svg, "<title>") >= s->nrun + attended);
        assert_null(strstr(svg, "nan"));
        assert_null(strstr(svg, "inf"));
        assert_non_null(strstr(svg, "d&lt;&amp;&gt;"));
        assert_non_null(strstr(svg, "operator 1"));
        assert_non_null(strstr(svg, "within 10 min"));
    }
}

/* Round the clock, in pieces of twelve hours: one that nothing is done in is not drawn, neither where a load ends as it begins nor
   where the next begins as it ends. */
static void only_hours_with_loads_are_drawn(void **state) {
    (void)state;
    const fw_process_flow *f = computed(SILICON, NULL, NULL);
    const fw_schedule *of;
    const fw_schedule_options o = {.wafers = 1, .operators = 1, .day = "none", .effort = 1};
    assert_int_equal(fw_schedule_make(arena, f, &o, &diags, &of), FW_OK);
    for (
        int k = 0; k < 4;
        k++) { /* hours from 12 to 24 are full, touched at their begin, at their end, and at both */
        const double half = 12 * 3600.0;
        fw_schedule_run run[2] = {{.count = 1, .end_s = k % 2 ? half : half - 60},
                                  {.count = 1, .start_s = 2 * half + (k / 2 ? 0 : 60)}};
        run[1].end_s = run[1].start_s + 60;
        if (k == 0) run[0].end_s = half + 60;
        fw_schedule two = *of;
        two.run = run, two.nrun = 2;
        two.start_s = 0, two.makespan_s = run[1].end_s;
        const char *svg = written(fw_recipe_write_schedule_svg, f, &two);
        assert_int_equal(occurrences(svg, "class=\"d\">day 1<"), k == 0 ? 2 : 1);
        assert_int_equal(occurrences(svg, "class=\"d\">day 2<"), 1);
    }
}

/* the calendar: an event for every attended load, none outside the working day */
static void calendar(void **state) {
    (void)state;
    const fw_process_flow *f = computed(SILICON, NULL, NULL);
    const fw_schedule *s = scheduled(f, 3, 2, NULL);
    const char *ics = written(fw_recipe_write_ics, f, s);
    int attended = 0;
    for (int k = 0; k < s->nrun; k++)
        attended += s->run[k].operator_ >= 0;
    assert_int_equal(occurrences(ics, "BEGIN:VTODO"), s->nrun);
    assert_int_equal(occurrences(ics, "BEGIN:VEVENT"), attended);
    for (const char *at = ics; (at = strstr(at, "BEGIN:VEVENT")) != NULL; at++) {
        const char *start = strchr(strstr(at, "DTSTART:") + 8, 'T') + 1;
        int hour = atoi(start) / 10000;
        assert_in_range(hour, 8, 17);
    }
    assert_non_null(strstr(ics, "operator 2"));
    assert_null(strstr(ics, "VTIMEZONE"));
}

/* a stated zone: UTC as such, any other with a component that says what it is (RFC 5545, 3.6.5); all times are of it */
static void zones(void **state) {
    (void)state;
    static const struct {
        const char *day, *first;
        int zones, plain;
    } at[] = {{"08:00-18:00 from 2026-11-23T13:00 UTC", "DTSTART:20261123T130000Z\r\n", 0, 0},
              {"08:00-18:00 from 2026-11-23 UTC+05:30", "DTSTART;TZID=UTC+0530:20261123T080000\r\n",
               1, 1},
              {"none from 2026-11-23 UTC-03:30", "DTSTART;TZID=UTC-0330:20261123T000000\r\n", 1, 1},
              {"08:00-18:00 from 2026-11-23T13:00", "DTSTART:20261123T130000\r\n", 0, -1}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        const fw_process_flow *f = computed(SILICON, NULL, NULL);
        const fw_schedule *s = NULL;
        const fw_schedule_options options = {.wafers = 1, .operators = 1, .day = at[i].day};
        assert_int_equal(fw_schedule_make(arena, f, &options, &diags, &s), FW_OK);
        const char *ics = written(fw_recipe_write_ics, f, s);
        if (!strstr(ics, at[i].first)) fail_msg("%s: no %s", at[i].day, at[i].first);
        assert_int_equal(occurrences(ics, "BEGIN:VTIMEZONE\r\n"), at[i].zones);
        int plain = 0;
        for (const char *line = ics; (line = strstr(line, "\nDTSTART:")) != NULL; line++)
            plain += strcspn(line + 1, "\r") == strlen("DTSTART:20261123T130000");
        if (at[i].plain >= 0) assert_int_equal(plain, at[i].plain); /* the component's own */
    }
}

/* Six and seven wafers: every step that is done wafer by wafer has a number for each, once, its cells for every site of
   what is measured on that wafer, and what is written once for each load; whatever stands side by side. */
static void lines_of_wafers(void **state) {
    (void)state;
    for (int wafers = 6; wafers <= 7; wafers++)
        for (int pack = 0; pack < 2; pack++) {
            const fw_process_flow *f = computed(flows[pack], NULL, NULL);
            const char *html = written(fw_recipe_write_html, f, scheduled(f, wafers, 1, NULL));
            for (int i = 0; i < f->nstep; i++) {
                const fw_process_step *s = &f->step[i];
                char text[64];
                snprintf(text, sizeof text, "id=\"%s\">", s->id);
                const char *from = strstr(html, text), *to = strstr(from, "</section>");
                const char *part = fw_arena_strndup(arena, from, (size_t)(to - from));
                if (fw_process_step_is_of_lot(s)) continue;
                int sites = 0, load = fw_process_step_load(s);
                for (int w = 0; w < wafers; w++) {
                    snprintf(text, sizeof text, "<td>%d</td>", w + 1);
                    if (occurrences(part, text) != 1) fail_msg("%s: wafer %d", s->id, w + 1);
                    for (int k = 0; k < s->naccept; k++)
                        if (fw_process_accept_is_due(&s->accept[k], w))
                            sites += s->accept[k].sites < 9 ? s->accept[k].sites : 9;
                }
                const int boxes = occurrences(part, "<span class=\"s\"></span>") +
                                  occurrences(part, "<span class=\"box\"></span>") - 1;
                if (boxes != sites) fail_msg("%s: %d cells for %d sites", s->id, boxes, sites);
                assert_int_equal(occurrences(part, "class=\"w\" rowspan="),
                                 3 * ((wafers + load - 1) / load));
                assert_null(strstr(part, "<td>8</td>"));
            }
        }
}

/* planning times fill what is not computable; the run sheet says so and names where to stop */
static void planning_times(void **state) {
    (void)state;
    const fw_process_flow *f = computed(SILICON, NULL, NULL);
    const fw_schedule *before = scheduled(f, 1, 1, NULL);
    const fw_schedule *s = scheduled(f, 1, 1, "S03=90 min,S09=20 s,C05=1 h");
    assert_int_equal(before->unknown, 2);
    assert_int_equal(s->unknown, 0);
    assert_near(s->makespan_s - before->makespan_s, 5400.0 - 900.0,
                1e-6); /* 15 min were attended */
    const char *html = written(fw_recipe_write_html, f, s);
    assert_non_null(strstr(html, "The times of S03, S09 are planning times of the user"));
    assert_non_null(strstr(html, "Safe stopping points"));
    assert_non_null(strstr(html, "never between"));
    assert_non_null(
        strstr(written(fw_recipe_write_html, f, before), "not known: they are counted"));
    static const char *const bad[] = {"S03",        "S03=90",   "S03=ninety min",
                                      "S03=-1 min", "S03=9 um", "S03=40000 h"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_schedule_options o = {.planned = bad[i]};
        assert_int_equal(fw_schedule_make(arena, f, &o, &diags, &s), FW_USAGE);
    }
}

/* a pack whose windows cannot be kept: named, and no schedule */
static void contradiction(void **state) {
    (void)state;
    const fw_process_flow *f = computed(COPPER, "<lag from=\"C25\" max=\"60\" unit=\"min\"/>",
                                        "<lag from=\"C16\" max=\"30\" unit=\"min\"/>");
    fw_diags said = diags = fw_diags_new(arena);
    const fw_schedule *s = scheduled(f, 2, 1, NULL);
    assert_false(s->feasible);
    assert_null(s->pause_s);
    assert_true(diags.count == said.count + 1 && diags.item[said.count].number == 196);
    assert_non_null(strstr(s->why, "C26 must start within 30 min of the end of C16"));
    json_t *json = json_loads(written(fw_recipe_write_schedule_json, f, s), 0, NULL);
    assert_non_null(json);
    assert_true(json_is_false(json_object_get(json, "feasible")));
    assert_true(json_is_null(json_object_get(json, "makespan_s")));
    json_decref(json);
    assert_non_null(strstr(written(fw_recipe_write_html, f, s), "there is no schedule"));
    written(fw_recipe_write_schedule_svg, f, s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(json_and_csv),    cmocka_unit_test(picture),
        cmocka_unit_test(calendar),        cmocka_unit_test(zones),
        cmocka_unit_test(lines_of_wafers), cmocka_unit_test(planning_times),
        cmocka_unit_test(contradiction),   cmocka_unit_test(only_hours_with_loads_are_drawn)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
