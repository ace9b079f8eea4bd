/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law_kind.h"
#include "test.h"
#include "report/fixture.h"
#include "report/report_page.h"
#include <ctype.h>
#include <libxml/parser.h>

typedef struct page_writer {
    const char *name;
    fw_status (*write)(fw_arena *arena, const fixture *f, fw_text *out);
    bool xml;
} page_writer;

static fw_status html(fw_arena *arena, const fixture *f, fw_text *out) {
    return fw_report_write_html(arena, &f->input, out);
}

static fw_status plot(fw_arena *arena, const fixture *f, fw_text *out) {
    return fw_report_motion_svg(arena, &f->device, &f->mechanism[0],
                                f->variant_verdict[0].motion[0], &f->device.scene[0], NULL, out);
}

static fw_status animation(fw_arena *arena, const fixture *f, fw_text *out) {
    return fw_report_animation_svg(arena, &f->device, &f->layout, &f->mechanism[0],
                                   f->variant_verdict[0].motion[0], &f->device.scene[0], out);
}

static fw_status drawing(fw_arena *arena, const fixture *f, fw_text *out) {
    return fw_report_device_svg(arena, &f->device, &f->layout, &f->verdict, out);
}

static fw_status picture(fw_arena *arena, const fixture *f, fw_text *out) {
    return fw_report_device_png(arena, &f->device, &f->layout, &f->verdict, 320, out);
}

static const page_writer writers[] = {
    {"report.html", html, true},        {"motion.svg", plot, true},
    {"animation.svg", animation, true}, {"device.svg", drawing, true},
    {"device.png", picture, false},
};
enum { WRITERS = sizeof writers / sizeof writers[0] };

static bool is_word(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

/* "nan" and "inf" as words, in any case */
static const char *find_nonfinite(const char *text) {
    for (const char *s = text; *s; s++) {
        bool start = s == text || !is_word(s[-1]);
        if (start && (!strncasecmp(s, "nan", 3) || !strncasecmp(s, "inf", 3)) && !is_word(s[3]))
            return s;
    }
    return NULL;
}

static void check(fw_arena *arena, const fixture *f) {
    for (int i = 0; i < WRITERS; i++) {
        fw_text out = fw_text_new(arena);
        fw_status status = writers[i].write(arena, f, &out);
        if (status != FW_OK) fail_msg("%s: status %d", writers[i].name, (int)status);
        if (!writers[i].xml) continue;
        const char *bad = find_nonfinite(out.data);
        if (bad) fail_msg("%s: %.60s", writers[i].name, bad);
        xmlDocPtr doc = xmlReadMemory(out.data, (int)out.length, writers[i].name, NULL,
                                      XML_PARSE_NONET | XML_PARSE_HUGE);
        if (!doc) fail_msg("%s is not well-formed", writers[i].name);
        xmlFreeDoc(doc);
    }
}

static void every_picture_is_well_formed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const double limit[] = {0.05, 0.12, 0.3};
    for (int i = 0; i < 3; i++)
        check(arena, fixture_new(arena, limit[i]));
    fixture *f = fixture_new(arena, 0.12);
    f->layout.drawn = false;
    f->layout.why_not = "link AB has no width";
    check(arena, f);
    fw_arena_free(arena);
}

static void banner_says_the_verdict(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const double limit[] = {0.05, 0.12, 0.3};
    static const char *const word[] = {">REJECT<", ">INCONCLUSIVE<", ">ACCEPT<"};
    for (int i = 0; i < 3; i++) {
        fixture *f = fixture_new(arena, limit[i]);
        fw_text out = fw_text_new(arena);
        assert_int_equal(html(arena, f, &out), FW_OK);
        char *header_end = strstr(out.data, "</header>");
        assert_non_null(header_end);
        assert_true((strstr(out.data, "length=312 um&#39;</code>") != NULL) == (i < 2));
        assert_non_null(strstr(out.data, "NOT COMPUTABLE"));
        assert_non_null(strstr(out.data, "dose to clear"));
        *header_end = '\0';
        assert_non_null(strstr(out.data, word[i]));
        assert_true(out.length < 1000000);
    }
    fw_arena_free(arena);
}

/* files that travel alone say it in their titles */
static void rejected_in_every_title(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const double limit[] = {0.05, 0.12, 0.3};
    for (int i = 0; i < 3; i++) {
        fixture *f = fixture_new(arena, limit[i]);
        fw_text device = fw_text_new(arena), motion = fw_text_new(arena);
        assert_int_equal(drawing(arena, f, &device), FW_OK);
        assert_int_equal(fw_report_motion_svg(arena, &f->device, &f->mechanism[0],
                                              f->variant_verdict[0].motion[0], &f->device.scene[0],
                                              &f->verdict, &motion),
                         FW_OK);
        assert_true((f->verdict.decision == FW_REJECT) == (i == 0));
        assert_true((strstr(device.data, "<title>REJECTED: ") != NULL) == (i == 0));
        assert_true((strstr(motion.data, "<title>REJECTED: ") != NULL) == (i == 0));
        assert_true((strstr(device.data, ">REJECTED</text>") != NULL) == (i == 0));
    }
    fw_arena_free(arena);
}

/* masses, inertias and stiffnesses as used stand on the page, per flow */
static void mechanics_are_shown(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.3);
    f->mechanism[0].body[0].mass_kg = 1.88e-8;
    f->mechanism[0].body[0].inertia_kg_m2 = 2.86e-15;
    f->mechanism[0].body[0].x_m = 0.45e-3;
    f->mechanism[0].pin[0].stiffness_Nm_per_rad = 1.711e-6;
    f->mechanism[0].pin[0].damping_Nms_per_rad = 7e-12;
    f->mechanism[0].hinge[0].closed_form.stiffness_Nm_per_rad = 1.723e-6;
    fw_text out = fw_text_new(arena);
    assert_int_equal(html(arena, f, &out), FW_OK);
    static const char *const shown[] = {"18.8\u00a0\u00b5g",
                                        "<td class=\"n\">0.00286</td>",
                                        "<td class=\"n\">0.45, ",
                                        "1.711\u00a0\u00b5N\u00b7m/rad",
                                        "1.723\u00a0\u00b5N\u00b7m/rad",
                                        "7\u00a0pN\u00b7m\u00b7s/rad"};
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++)
        if (!strstr(out.data, shown[i])) fail_msg("'%s' is not on the page", shown[i]);
    int tables = 0;
    for (const char *at = out.data; (at = strstr(at, "Masses and stiffnesses used")); at++)
        tables++;
    assert_int_equal(tables, f->verdict.nvariant);
    fw_arena_free(arena);
}

/* how a load goes with time is said where the load is, and at its arrow */
static void laws_are_said(void **state) {
    (void)state;
    static const fw_quantity_law ramp = {
        .kind = &fw_quantity_law_ramp, .rise_s = 2e-3, .end_s = (double)INFINITY};
    static const fw_quantity_law pulse = {
        .kind = &fw_quantity_law_step, .start_s = 1e-3, .end_s = 3e-3};
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.3);
    fw_device_driver driver = {.id = "motor", .revolute = 0, .joint = FW_NONE};
    f->device.scene[0].force[0].law = &ramp;
    f->device.scene[1].force[0].law = &pulse;
    f->device.driver = &driver, f->device.ndriver = 1;
    fw_text out = fw_text_new(arena);
    assert_int_equal(html(arena, f, &out), FW_OK);
    assert_non_null(strstr(out.data, " times a ramp over 2\u00a0ms"));
    assert_non_null(strstr(out.data, " times a step from 1\u00a0ms on until 3\u00a0ms"));
    assert_non_null(strstr(out.data, " \u00d7 ramp</text>"));
    assert_non_null(strstr(out.data, "joint motor driven in time"));
    fw_arena_free(arena);
}

static void hostile_names_are_text(void **state) {
    (void)state;
    static const char evil[] = "\"'><script>alert(1)</script><img src=x onerror=y>]]>";
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.05);
    fw_text clean = fw_text_new(arena), out = fw_text_new(arena);
    assert_int_equal(html(arena, f, &clean), FW_OK);
    f->device.name = f->device.file = evil;
    f->device.parameter[0].name = f->device.parameter[0].doc = evil;
    f->device.parameter[0].unit = evil;
    for (int k = 0; k < 2; k++)
        f->device.scene[k].name = evil;
    for (int b = 0; b < FIVE; b++)
        f->device.body[b].id = f->mechanism[0].body[b].id = evil;
    for (int j = 0; j < SIX; j++) {
        f->device.revolute[j].id = f->mechanism[0].pin[j].id = evil;
        f->verdict.hinge[j].id = f->verdict.hinge[j].scene = f->verdict.hinge[j].flow = evil;
    }
    f->variant[0].flow = f->variant[0].material.name = f->variant[0].material.youngs.source = evil;
    f->variant[0].material.youngs.unit = evil;
    f->process[0].id = f->process[0].title = f->process[0].reason[0] = evil;
    f->process[0].step[0].title = f->process[0].step[1].time.missing[0] = evil;
    f->process[0].bias_note = f->flow[1].mask_error = f->mask.cell = f->mask.flow = evil;
    f->mask.table->layer[0].name = f->mask.table->layer[0].purpose = evil;
    const fw_device_set set = {evil, evil};
    f->verdict.proposal[0].text = evil;
    f->verdict.proposal[0].set = &set;
    f->verdict.advice_note = f->input.assumption[0] = f->input.version = evil;
    f->diags.item[0].message = f->diags.item[0].place.file = evil;
    check(arena, f);
    assert_int_equal(html(arena, f, &out), FW_OK);
    assert_null(strstr(out.data, "<img"));
    assert_null(strstr(out.data, "<script>alert"));
    int scripts[2] = {0, 0};
    for (const char *s = clean.data; (s = strstr(s, "<script")); s++)
        scripts[0]++;
    for (const char *s = out.data; (s = strstr(s, "<script")); s++)
        scripts[1]++;
    assert_int_equal(scripts[0], scripts[1]);
    fw_arena_free(arena);
}

static void numbers_that_are_not_finite_do_not_show(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    fw_dynamics_motion *m = (fw_dynamics_motion *)(uintptr_t)f->variant_verdict[0].motion[0];
    double bad = (double)NAN;
    m->q[100] = m->angle_rad[60] = m->peak[1].angle_rad = m->peak[2].t_s = bad;
    m->stats.energy_error = HUGE_VAL;
    f->mechanism[0].hinge[3].closed_form.limit_angle_rad = bad;
    f->verdict.hinge[0].t_s = f->verdict.hinge[1].utilisation = bad;
    f->verdict.hinge[2].utilisation_high = HUGE_VAL;
    f->verdict.accuracy_estimated = bad;
    f->variant_verdict[0].workspace.peak[0].angle_rad = -HUGE_VAL;
    f->process[0].total_s = bad;
    f->process[0].step[2].time.stop_s = HUGE_VAL;
    f->variant[0].thickness_m = bad;
    f->mask.bias_m = bad;
    f->layout.piece[0].contour.segment[0].a.x = bad;
    check(arena, f);
    fw_arena_free(arena);
}

static void little_input_is_enough(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_device device = {.name = "empty", .safety_factor = 1.5};
    fw_verdict verdict = {.governing = FW_NONE};
    fw_report_input input = {.device = &device, .verdict = &verdict, .version = "0"};
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_report_write_html(arena, &input, &out), FW_OK);
    assert_null(find_nonfinite(out.data));
    xmlDocPtr doc = xmlReadMemory(out.data, (int)out.length, "r", NULL, XML_PARSE_NONET);
    assert_non_null(doc);
    xmlFreeDoc(doc);
    fw_text svg = fw_text_new(arena), png = fw_text_new(arena);
    assert_int_equal(fw_report_device_svg(arena, &device, NULL, NULL, &svg), FW_OK);
    assert_int_equal(fw_report_device_png(arena, &device, NULL, NULL, 64, &png), FW_OK);
    assert_int_equal(fw_report_device_png(arena, &device, NULL, NULL, 8, &png), FW_USAGE);
    assert_int_equal(fw_report_device_png(arena, &device, NULL, NULL, 10000, &png), FW_USAGE);
    fw_arena_free(arena);
}

static void no_address_outside(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    fw_text out = fw_text_new(arena);
    assert_int_equal(html(arena, f, &out), FW_OK);
    for (const char *s = out.data; (s = strstr(s, "http")); s++) {
        bool known = !strncmp(s, "http://www.w3.org/", 18) || !strncmp(s, "http-equiv", 10);
        if (!known) fail_msg("%.80s", s);
    }
    assert_null(strstr(out.data, "src="));
    assert_null(strstr(out.data, "@import"));
    fw_arena_free(arena);
}

static void same_input_same_bytes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int i = 0; i < WRITERS; i++) {
        fw_text a = fw_text_new(arena), b = fw_text_new(arena);
        fixture *f = fixture_new(arena, 0.12), *g = fixture_new(arena, 0.12);
        ((fw_dynamics_motion *)(uintptr_t)g->variant_verdict[0].motion[0])->stats.cpu_s = 77.0;
        assert_int_equal(writers[i].write(arena, f, &a), FW_OK);
        assert_int_equal(writers[i].write(arena, g, &b), FW_OK);
        assert_int_equal(a.length, b.length);
        assert_memory_equal(a.data, b.data, a.length);
    }
    fw_arena_free(arena);
}

static void png_is_a_png(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    fw_text out = fw_text_new(arena);
    assert_int_equal(picture(arena, f, &out), FW_OK);
    static const unsigned char head[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0,
                                         0,    13,  'I', 'H', 'D',  'R',  0,    0,    1, 0x40};
    assert_true(out.length > 1000);
    assert_memory_equal(out.data, head, sizeof head); /* 320 wide */
    fw_arena_free(arena);
}

/* in the drawing of the device once, in no picture that moves */
static void tethers_stay_out_of_motion(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    fw_text still[2], film[2], page[2];
    fw_geometry_contour tether;
    f->device.die.tethers = true;
    for (int i = 0; i < 2; i++) {
        still[i] = fw_text_new(arena);
        film[i] = fw_text_new(arena);
        page[i] = fw_text_new(arena);
        assert_int_equal(drawing(arena, f, &still[i]), FW_OK);
        assert_int_equal(animation(arena, f, &film[i]), FW_OK);
        assert_int_equal(html(arena, f, &page[i]), FW_OK);
        fw_geometry_box box = {1.49e-3, 3.05e-3, 1.51e-3, 3.7e-3};
        assert_int_equal(fw_geometry_contour_rectangle(arena, box, &tether), FW_OK);
        fixture_piece(&f->layout, FW_ROLE_TETHER, FW_GROUND, FW_NONE, "tether", tether);
    }
    const char *mark = "<path class=\"tethers\"";
    assert_string_equal(film[0].data, film[1].data);
    assert_null(strstr(still[0].data, mark));
    assert_non_null(strstr(still[1].data, mark));
    assert_null(strstr(page[0].data, mark));
    const char *at = strstr(page[1].data, mark);
    assert_non_null(at);
    assert_null(strstr(at + 1, mark));
    const char *end = strstr(at, "/>");
    assert_non_null(end);
    size_t before = (size_t)(at - page[1].data), after = strlen(end + 3);
    assert_memory_equal(page[0].data, page[1].data, before); /* nothing else changed */
    assert_string_equal(page[0].data + before, end + 3);
    assert_int_equal(page[0].length, before + after);
    assert_non_null(strstr(page[1].data, "broken at the bodies before use"));
    fw_arena_free(arena);
}

/* every allocation fails in turn, once and ever after: FW_NOMEM or the whole output */
static void out_of_memory_is_said(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.05);
    const int thinner = test_cases(100, 8);
    for (int w = 0; w < WRITERS; w++)
        for (int ever_after = 0; ever_after < 2; ever_after++) {
            long failures = 0;
            /* the first one by one, then ever fewer: the whole workspace is found each
               time */
            for (long n = 1;; n += 1 + n / thinner) {
                fw_arena *scratch = fw_arena_new(0);
                assert_non_null(scratch);
                fw_text out = fw_text_new(scratch);
                fw_arena_fail_at(n, ever_after);
                fw_status status = writers[w].write(scratch, f, &out);
                fw_arena_fail_at(0, 0);
                fw_arena_free(scratch);
                if (status == FW_OK) break;
                assert_int_equal(status, FW_NOMEM);
                failures++;
                assert_true(failures < 2000);
            }
            assert_true(failures > 0);
        }
    fw_arena_free(arena);
}

static const char *line_of(fw_arena *arena, fixture *f, const char *label) {
    fw_report_summary s;
    assert_int_equal(fw_report_summarise(arena, &f->input, &s), FW_OK);
    for (int i = 0; i < s.nline; i++)
        if (strncmp(s.line[i].label, label, strlen(label)) == 0) return s.line[i].text;
    return "";
}

/* How much of their way until they meet, or have just what is asked for, parts take is said behind the nearest, where it is more than
   half; of the nearest pair itself only where that is not seen: it comes down from 10 to 2 um, or to 6 um of which 5 are asked for. */
static void the_way_that_parts_take(void **state) {
    (void)state;
    static const struct {
        double m, required_m, share, of_other;
        const char *says;
    } row[] = {
        {2e-6, 0, 0.8, 0, "A and B 2 um (2 to 2) in close"},
        {6e-6, 5e-6, 0.8, 0,
         "A and B 6 um (6 to 6) in close; A and B take 80 % of the way until they have just what "
         "is asked for"},
        {6e-6, 0, 0.4, 0, "A and B 6 um (6 to 6) in close"},
        {6e-6, 0, 0.4, 0.54,
         "A and B 6 um (6 to 6) in close; C and D take 54 % of the way until they meet in open"},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        fw_arena *arena = fw_arena_new(0);
        fixture *f = fixture_new(arena, 0.12);
        const double m = row[i].m;
        fw_verdict_clearance c[2] = {
            {.scene = "close",
             .least = {.known = true, .m = m, .start_m = 10e-6, .at = {.a = "A", .b = "B"}},
             .way = {.share = row[i].share, .a = "A", .b = "B"},
             .m = m,
             .low_m = m,
             .high_m = m,
             .required_m = row[i].required_m},
            {.scene = "open",
             .least = {.known = true, .m = 9e-6, .start_m = 20e-6, .at = {.a = "C", .b = "D"}},
             .way = {.share = row[i].of_other, .a = "C", .b = "D"},
             .m = 9e-6,
             .low_m = 9e-6,
             .high_m = 9e-6}};
        f->variant_verdict[0].clearance = c, f->variant_verdict[0].nclearance = 2;
        assert_string_equal(line_of(arena, f, "nearest"), row[i].says);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_way_that_parts_take),
        cmocka_unit_test(every_picture_is_well_formed),
        cmocka_unit_test(banner_says_the_verdict),
        cmocka_unit_test(rejected_in_every_title),
        cmocka_unit_test(mechanics_are_shown),
        cmocka_unit_test(laws_are_said),
        cmocka_unit_test(hostile_names_are_text),
        cmocka_unit_test(numbers_that_are_not_finite_do_not_show),
        cmocka_unit_test(little_input_is_enough),
        cmocka_unit_test(no_address_outside),
        cmocka_unit_test(same_input_same_bytes),
        cmocka_unit_test(png_is_a_png),
        cmocka_unit_test(tethers_stay_out_of_motion),
        cmocka_unit_test(out_of_memory_is_said),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    xmlCleanupParser();
    return failed;
}
