/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/films.h"
#include "../process/pack_fixture.h"
#include "process/calibrate.h"
#include "recipe/recipe.h"
#include <jansson.h>
#include <stdlib.h>

static const char *const flows[] = {COPPER, SILICON};
static const char mask_hash[] = "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff";

typedef fw_status (*writer)(const fw_process_flow *, const fw_recipe_header *, fw_text *);
static const writer writers[] = {fw_recipe_write_html, fw_recipe_write_csv, fw_recipe_write_ics,
                                 fw_recipe_write_json};

static fw_process_flow *computed(const char *name) {
    fw_process_flow *f = read_pack(arena, name, NULL, NULL, &diags);
    assert_non_null(f);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    return f;
}

static fw_recipe_header header_of(const char *device, bool rejected) {
    return (fw_recipe_header){.device = device,
                              .flow_sha256 = "",
                              .mask_sha256 = mask_hash,
                              .program_version = "9.8.7",
                              .rejected = rejected};
}

static const char *written(writer write, const fw_process_flow *f, const char *device,
                           bool rejected, size_t *n) {
    fw_text out = fw_text_new(arena);
    fw_recipe_header h = header_of(device, rejected);
    assert_int_equal(write(f, &h, &out), FW_OK);
    if (n) *n = out.length;
    return out.data;
}

static int occurrences(const char *text, const char *what) {
    int n = 0;
    for (const char *at = text; (at = strstr(at, what)) != NULL; at += strlen(what))
        n++;
    return n;
}

/* every tag that opens closes, in order; void elements aside */
static void check_nesting(const char *html) {
    char stack[64][16];
    int depth = 0;
    for (const char *c = strchr(html, '<'); c; c = strchr(c + 1, '<')) {
        if (c[1] == '!') continue;
        bool closes = c[1] == '/';
        char name[16] = "";
        sscanf(c + 1 + closes, "%15[a-z0-9]", name);
        const char *end = strchr(c, '>');
        assert_non_null(end);
        if (strcmp(name, "meta") == 0 || strcmp(name, "br") == 0 || end[-1] == '/') continue;
        if (!closes) {
            assert_true(depth < 64);
            snprintf(stack[depth++], sizeof stack[0], "%s", name);
        } else {
            assert_true(depth > 0);
            assert_string_equal(stack[--depth], name);
        }
    }
    assert_int_equal(depth, 0);
}

static void html(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        fw_process_flow *f = computed(flows[i]);
        const char *text = written(fw_recipe_write_html, f, "six & <b>", false, NULL);
        check_nesting(text);
        assert_int_equal(occurrences(text, "<section class=\"step\""), f->nstep);
        int changes = 0, hazards = 0;
        for (int k = 0; k < f->nstep; k++)
            changes += fw_process_step_changes(&f->step[k]);
        for (int k = 0; k < f->nhazard; k++) /* each that a step has, once */
            for (int m = 0, met = 0; m < f->nstep && !met; m++)
                for (int h = 0; h < f->step[m].nhazard && !met; h++)
                    hazards += met = f->step[m].hazard[h] == &f->hazard[k];
        assert_int_equal(occurrences(text, "<svg "), changes);
        assert_int_equal(occurrences(text, "<tr id=\"hazard-"), hazards);
        assert_int_equal(occurrences(text, "TIME NOT COMPUTABLE"), f->not_computable);
        assert_int_equal(occurrences(text, "NOT COMPUTABLE</b></td>"), f->not_computable);
        assert_null(strstr(text, "<script"));
        assert_null(strstr(text, "src="));
        assert_null(strstr(text, "url("));
        assert_null(strstr(text, "REJECTED"));
        assert_non_null(strstr(text, "six &amp; &lt;b&gt;"));
        assert_non_null(strstr(text, mask_hash));
        assert_non_null(strstr(text, f->sha256));
        assert_non_null(strstr(text, "9.8.7"));
        assert_non_null(strstr(text, "Values with status assumed:"));
        for (int k = 0; k < f->nreason; k++) {
            fw_text reason = fw_text_new(arena);
            fw_text_escaped(&reason, f->reason[k]);
            assert_non_null(strstr(text, reason.data));
        }
        int signatures = 0;
        for (int k = 0; k < f->nstep; k++)
            signatures += f->step[k].second_signature;
        assert_int_equal(occurrences(text, "<b>second signature</b>"), signatures);
    }
}

/* two fillings of 80 mL, a price for one acid: 6.40, and besides what a machine takes for its hours; what is not known is a blank,
   and what is not in the sum is named */
static void bill(void **state) {
    (void)state;
    fw_process_flow *f = computed("al-masked-rie");
    const char *plain = written(fw_recipe_write_html, f, "six", false, NULL);
    assert_null(strstr(plain, "Cost of the lot"));
    assert_non_null(strstr(plain, "80 mL phosphoric acid"));
    assert_non_null(strstr(plain, "5 parts deionised water, 1 part ammonia"));
    assert_non_null(strstr(plain, "on coupon ladder"));
    const char *lab = "<process xmlns=\"urn:flexwright:process:1\" flow=\"al-masked-rie\"><source "
                      "id=\"o\" kind=\"datasheet\">offer</source><q id=\"phosphoric.price\" "
                      "value=\"40\" u=\"0\" unit=\"EUR/L\" status=\"stated\" src=\"o\"/></process>";
    assert_int_equal(fw_process_lab_apply(arena, "lab.xml", lab, strlen(lab), f, &diags), FW_OK);
    const char *priced = written(fw_recipe_write_html, f, "six", false, NULL);
    check_nesting(priced);
    assert_non_null(strstr(priced, "6.4 EUR</b>"));
    assert_non_null(strstr(priced, "Not in it: wafers, masks and people."));
    size_t n;
    const char *text = written(fw_recipe_write_json, f, "six", false, &n);
    json_t *all = json_loadb(text, n, 0, NULL), *b = json_object_get(all, "bill");
    assert_string_equal(json_string_value(json_object_get(b, "currency")), "EUR");
    assert_near(json_number_value(json_object_get(b, "consumables_cost")), 6.4, 1e-9);
    json_decref(all);
    const char *hour = "<process xmlns=\"urn:flexwright:process:1\" flow=\"al-masked-rie\"><source id=\"o\" kind=\"datasheet\">offer</source>"
                       "<q id=\"rie.price\" value=\"60\" u=\"0\" unit=\"EUR/h\" status=\"stated\" src=\"o\"/></process>";
    assert_int_equal(fw_process_lab_apply(arena, "hour.xml", hour, strlen(hour), f, &diags), FW_OK);
    const char *sum = strstr(written(fw_recipe_write_html, f, "six", false, NULL), "as far as it is known: ");
    double whole, consumables, machines; /* with the hours of one machine */
    assert_non_null(sum);
    assert_int_equal(sscanf(sum, "as far as it is known: %lf EUR</b>, of it consumables %lf and machine time %lf", &whole, &consumables, &machines), 3);
    assert_near(consumables, 6.4, 1e-9);
    assert_true(machines > 1);
    assert_near(whole, consumables + machines, 0.011);
}

static void rejected_everywhere(void **state) {
    (void)state;
    fw_process_flow *f = computed(COPPER);
    for (size_t w = 0; w < sizeof writers / sizeof writers[0]; w++) {
        const char *text = written(writers[w], f, "d", true, NULL);
        assert_non_null(strstr(text, "REJECTED"));
        if (w == 3) assert_non_null(strstr(text, "\"rejected\":true,\"banner\":\"REJECTED\""));
        assert_null(strstr(written(writers[w], f, "d", false, NULL), "REJECTED"));
    }
    /* on the sheet and in the margin of every page */
    const char *text = written(fw_recipe_write_html, f, "d", true, NULL);
    assert_non_null(strstr(text, "@top-center{content:\"REJECTED"));
    assert_non_null(strstr(text, "<div class=\"rejected\">"));
}

static void csv(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        fw_process_flow *f = computed(flows[i]);
        const char *text = written(fw_recipe_write_csv, f, "d", false, NULL);
        assert_memory_equal(text, "step,title,name,value,unit,uncertainty,status,source\n", 53);
        int commas = 0, quoted = 0, rows = 0;
        for (const char *c = text; *c; c++) {
            if (*c == '"')
                quoted = !quoted;
            else if (!quoted && *c == ',')
                commas++;
            else if (!quoted && *c == '\n') {
                assert_int_equal(commas, 7);
                commas = 0;
                rows++;
            }
        }
        assert_true(rows > 4 * f->nstep - 3 * f->not_computable);
        assert_int_equal(occurrences(text, "NOT COMPUTABLE"), f->not_computable);
        assert_int_equal(occurrences(text, "\"time, stop\""), f->nstep - f->not_computable);
    }
    const char *text = written(fw_recipe_write_csv, computed(SILICON), "d", false, NULL);
    assert_non_null(strstr(text, "S14,Etch the aluminium mask,etch rate,10,Ao/s,1,stated,"));
    static const char row[] = "S14,Etch the aluminium mask,\"time, nominal\",";
    const char *at = strstr(text, row);
    assert_non_null(at);
    assert_memory_equal(at + strlen(row), "1000,s,", 7);
    assert_non_null(strstr(text, "\"time, nominal\",5400"));
    assert_non_null(strstr(text, "time in wide openings,90,min,"));
}

/* no number of CSV and JSON has more digits than it can mean */
static void no_numeric_noise(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++)
        for (int w = 1; w < 4; w += 2) {
            fw_process_flow *f = computed(flows[i]);
            const char *text = written(writers[w], f, "d", false, NULL);
            for (const char *c = text; *c; c++) {
                int digits = 0, leading = 1;
                const char *start = c;
                for (; (*c >= '0' && *c <= '9') || *c == '.'; c++) {
                    leading = leading && (*c == '0' || *c == '.');
                    digits += *c != '.' && !leading;
                }
                bool hash = c > start && start > text && strchr("abcdef", start[-1]);
                if (digits > 12 && !hash) fail_msg("%.60s", start);
                if (!*c) break;
            }
            if (i == 0)
                assert_non_null(strstr(text, w == 1 ? ",30,mL,0.6,"
                                                    : "\"value\":30,\"unit\":\"mL\","
                                                      "\"uncertainty\":0.6,"));
        }
}

static void calendar(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        size_t n = 0, start = 0;
        fw_process_flow *f = computed(flows[i]);
        const char *text = written(fw_recipe_write_ics, f, "d", false, &n);
        for (size_t at = 0; at < n;
             at++) { /* CRLF only, 75 octets at most, no control characters */
            unsigned char c = (unsigned char)text[at];
            if (c == '\r') {
                assert_int_equal(text[at + 1], '\n');
                assert_true(at - start <= 75);
                start = ++at + 1;
                assert_false((text[start] & 0xC0) == 0x80);
                continue;
            }
            assert_true(c >= 0x20);
        }
        assert_int_equal(start, n);
        assert_int_equal(occurrences(text, "BEGIN:VTODO\r\n"), f->nstep);
        assert_int_equal(occurrences(text, "END:VTODO\r\n"), f->nstep);
        int attended = 0;
        for (int k = 0; k < f->nstep; k++)
            attended += f->step[k].attended_s > 0.0;
        assert_int_equal(occurrences(text, "BEGIN:VEVENT\r\n"), attended);
        assert_int_equal(occurrences(text, "\r\nDTSTAMP:20250101T000000Z\r\n"),
                         attended + f->nstep);
        assert_int_equal(occurrences(text, "\r\nUID:"), attended + f->nstep);
        assert_memory_equal(text, "BEGIN:VCALENDAR\r\nVERSION:2.0\r\nPRODID:", 37);
        assert_non_null(strstr(text, "DTSTART:20250106T080000\r\n"));
        assert_non_null(strstr(text, "\\, "));
    }
}

static void json(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        json_error_t error;
        fw_process_flow *f = computed(flows[i]);
        json_t *root =
            json_loads(written(fw_recipe_write_json, f, "a \"quoted\"\\ name\n", false, NULL),
                       JSON_REJECT_DUPLICATES, &error);
        if (!root) fail_msg("line %d: %s", error.line, error.text);
        assert_string_equal(json_string_value(json_object_get(root, "schema")),
                            "flexwright.recipe/1");
        assert_string_equal(json_string_value(json_object_get(root, "flow")), flows[i]);
        json_t *edges = json_object_get(root, "edges"),
               *openings = json_object_get(edges, "openings");
        assert_true(json_is_true(json_object_get(edges, "solved")));
        assert_int_equal(json_array_size(openings), f->edges.ncls);
        assert_relative(json_number_value(json_object_get(edges, "wet_m")) + 1e-9,
                        f->edges.wet_m + 1e-9, 1e-11);
        assert_relative(json_number_value(json_object_get(json_array_get(openings, 0), "mask_m")),
                        plain_facts.narrowest_slot_m - 2 * f->bias_m, 1e-11);
        json_t *steps = json_object_get(root, "steps");
        assert_int_equal(json_array_size(steps), f->nstep);
        double sum = 0.0;
        for (int k = 0; k < f->nstep; k++) {
            json_t *s = json_array_get(steps, (size_t)k), *t = json_object_get(s, "time_s");
            double finishing = 0.0;
            assert_string_equal(json_string_value(json_object_get(s, "id")), f->step[k].id);
            assert_true(json_is_boolean(json_object_get(s, "in_source")));
            assert_true(json_is_array(json_object_get(s, "quantities")));
            json_t *finish = json_object_get(s, "finish"), *one;
            size_t at;
            json_array_foreach(finish, at, one) finishing +=
                json_number_value(json_object_get(one, "time_s"));
            size_t missing = json_array_size(json_object_get(s, "not_computable"));
            if (!f->step[k].time.computable) {
                assert_true(json_is_null(t) && missing > 0);
                continue;
            }
            assert_int_equal(missing, 0);
            double booked = json_number_value(json_object_get(s, "booked_s"));
            double took = json_number_value(json_object_get(t, "nominal")) + finishing;
            assert_true(booked >= took * (1 - 1e-12));
            if (f->step[k].overrun == 0.0 && !f->step[k].pulse) /* with its handling */
                assert_relative(booked, fmax(took, f->step[k].attended_s), 1e-11);
            sum += booked;
            assert_relative(json_number_value(json_object_get(t, "stop")), f->step[k].time.stop_s,
                            5e-12);
            assert_true(json_is_number(json_object_get(t, "first_look")));
            assert_true(json_is_number(json_object_get(t, "clear_by")));
        }
        assert_relative(json_number_value(json_object_get(root, "total_s")), sum, 1e-11);
        json_t *q = json_array_get(json_object_get(json_array_get(steps, 0), "quantities"), 0);
        static const char *const keys[] = {"name",        "value",  "unit",
                                           "uncertainty", "status", "source"};
        for (int k = 0; k < 6; k++)
            assert_non_null(json_object_get(q, keys[k]));
        json_decref(root);
    }
}

static void sections(void **state) {
    (void)state;
    fw_process_flow *f = computed(COPPER);
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_recipe_section_svg(f, 21, &out), FW_OK);
    assert_non_null(strstr(out.data, "copper 9 µm"));
    assert_non_null(strstr(out.data, "positive photoresist 16 µm"));
    assert_non_null(strstr(out.data, "porous silicon ?"));
    assert_non_null(strstr(out.data, "copper seed ?"));
    assert_null(strstr(out.data, "nan"));
    assert_int_equal(occurrences(out.data, "<svg "), 1);
    double x0, y0, x1, y1; /* lines round the films go to the right, up or down, and none leaves the picture */
    int lines = 0;
    for (const char *at = out.data; (at = strchr(at, 'M')) != NULL; at++)
        if (sscanf(at, "M%lf%*[ ,]%lfL%lf%*[ ,]%lf", &x0, &y0, &x1, &y1) == 4 && ++lines) assert_true(x0 >= 0 && x1 >= x0);
    assert_true(lines > 10);
    out = fw_text_new(arena);
    assert_int_equal(fw_recipe_section_svg(f, 26, &out),
                     FW_OK); /* free: seed under the device only */
    assert_non_null(strstr(out.data, "copper seed ?"));
    assert_null(strstr(out.data, "porous"));
    out = fw_text_new(arena);
    assert_int_equal(fw_recipe_section_svg(f, -1, &out), FW_OK); /* nothing there yet */
    assert_null(strstr(out.data, "nan"));
    assert_null(strstr(out.data, "inf"));
}

static void same_bytes(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++)
        for (size_t w = 0; w < sizeof writers / sizeof writers[0]; w++) {
            size_t n1 = 0, n2 = 0;
            const char *a = written(writers[w], computed(flows[i]), "d", false, &n1);
            const char *b = written(writers[w], computed(flows[i]), "d", false, &n2);
            assert_int_equal(n1, n2);
            assert_memory_equal(a, b, n1);
        }
}

static void out_of_memory(void **state) {
    (void)state;
    fw_process_flow *f = computed(SILICON);
    fw_recipe_header h = header_of("d", false);
    for (size_t w = 0; w < sizeof writers / sizeof writers[0]; w++) {
        for (long at = 1;; at += at < 30 ? 1 : 11) {
            fw_arena *own = fw_arena_new(0);
            fw_text out = fw_text_new(own);
            fw_arena_fail_at(at, 1);
            fw_status status = writers[w](f, &h, &out);
            fw_arena_fail_at(0, 0);
            fw_arena_free(own);
            if (status == FW_OK) break;
            assert_int_equal(status, FW_NOMEM);
        }
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {TEST(html),
                                       TEST(rejected_everywhere),
                                       TEST(bill),
                                       TEST(csv),
                                       TEST(no_numeric_noise),
                                       TEST(calendar),
                                       TEST(json),
                                       TEST(sections),
                                       TEST(same_bytes),
                                       TEST(out_of_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
