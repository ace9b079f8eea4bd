/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts of packs that name values (process_find.c), and that no text repeats a value of its step: what changes, changes
   everywhere. */
#include "base/constants.h"
#include "base/text.h"
#include "pack_fixture.h"
#include "process/calibrate.h"
#include <ctype.h>

static void put_value(fw_process_flow *f, const char *id, double factor) {
    fw_quantity *q = (fw_quantity *)fw_process_flow_quantity(f, id);
    assert_non_null(q);
    q->value *= factor;
}

static const char *derive_like(const fw_process_step *s, const char *part) {
    for (int i = 0; i < s->nderive; i++)
        if (strstr(s->derive[i].name, part)) return s->derive[i].name;
    return "";
}

static void texts_follow_their_values(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    const fw_process_step *etch = step_of(f, "S18"), *in = step_of(f, "S01");
    assert_non_null(strstr(derive_like(etch, "narrowest slot"), "S = 0.1)"));
    assert_relative(etch->booked_s, 60 * (90 * 1.1 + 3 * 10), 1e-9); /* four parts, three breaks */
    assert_string_equal(in->setting[0].tolerance_low, "48");
    assert_non_null(strstr(etch->purpose, "In parts"));
    assert_non_null(strstr(step_of(f, "S14")->endpoint[0], "after clear 10 % more"));
    put_value(f, "rie.break", 1.5);
    put_value(f, "si.d", 0.5);
    put_value(f, "al.overetch", 3);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_relative(etch->booked_s, 60 * (45 * 1.1 + 15), 1e-9);
    assert_string_equal(in->setting[0].tolerance_high, "26");
    assert_non_null(strstr(step_of(f, "S14")->endpoint[0], "after clear 30 % more"));
    assert_relative(step_of(f, "S14")->overrun, 0.3, 1e-15);
    assert_relative(f->bias_m, 1.3e-6, 1e-12); /* the same share goes to the mask */
}

static void what_names_nothing_is_said(void **state) {
    (void)state;
    static const char *const bad[] = {"{no.such}", "{rie.break:um}", "{=}", "{rie.break",
                                      "{rie.break*x}"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, SILICON, "S = {=rie.S})", bad[i], &diags));
        assert_int_equal(diags.item[0].number, 348);
    }
}

/* "10 min" as a number and a unit in a raw text of a step, and a quantity that the step uses has that value in that unit:
   it must be named instead. Only texts of the steps; notes of quantities say where a number is from. */
static bool repeats(const fw_process_flow *f, const char *text, const fw_quantity *q) {
    (void)f;
    if (q->unknown || !q->unit || strcmp(q->unit, "1") == 0) return false;
    for (const char *c = text; *c; c++) {
        char *end;
        bool starts = isdigit((unsigned char)*c) &&
                      (c == text || (!isdigit((unsigned char)c[-1]) && c[-1] != '.' &&
                                     c[-1] != '{' && !isalpha((unsigned char)c[-1])));
        if (!starts) continue;
        double value = strtod(c, &end);
        size_t n = strlen(q->unit);
        if (end == c || *end != ' ' || strncmp(end + 1, q->unit, n) != 0 ||
            isalnum((unsigned char)end[1 + n]))
            continue;
        if (fabs(value - fw_quantity_in_unit(q)) <= 1e-9 * fabs(value)) return true;
    }
    return false;
}

static const char *raw_of(const fw_process_flow *f, const char *const *slot) {
    for (int i = 0; i < f->ntext; i++)
        if (f->text[i].slot == (const char **)slot) return f->text[i].raw;
    return *slot;
}

static int look(const fw_process_flow *f, const fw_process_step *s, const char *const *slot) {
    const char *text = raw_of(f, slot);
    const fw_quantity *used[200];
    int n = 0, found = 0;
    for (int i = 0; i < s->nsetting; i++)
        used[n++] = s->setting[i].q;
    for (int i = 0; i < s->nargument; i++)
        used[n++] = s->argument[i].q;
    for (int d = 0; d < s->nderive; d++)
        for (int i = 0; i < s->derive[d].nargument; i++)
            used[n++] = s->derive[d].argument[i].q;
    for (int i = 0; i < n; i++)
        if (repeats(f, text, used[i])) {
            print_error("%s: '%s' repeats %s\n", s->id, text, used[i]->id);
            found++;
        }
    return found;
}

static void no_text_repeats_a_value(void **state) {
    (void)state;
    static const char *const pack[] = {SILICON, COPPER, "soi-deep-rie"};
    int found = 0;
    for (int p = 0; p < 3; p++) {
        fw_process_flow *f = read_pack(arena, pack[p], NULL, NULL, &diags);
        for (int i = 0; i < f->nstep; i++) {
            const fw_process_step *s = &f->step[i];
            found += look(f, s, &s->purpose);
            for (int k = 0; k < s->nendpoint; k++)
                found += look(f, s, &s->endpoint[k]);
            for (int k = 0; k < s->nderive; k++)
                found += look(f, s, &s->derive[k].name);
            for (int k = 0; k < s->nsetting; k++)
                found += look(f, s, &s->setting[k].name);
            for (int k = 0; k < s->naccept; k++)
                found += look(f, s, &s->accept[k].measure);
            for (int k = 0; k < s->non_fail; k++)
                found += look(f, s, &s->on_fail[k].text);
        }
    }
    assert_int_equal(found, 0);
}

/* a bath that is warmer, and an open area that loads the plasma: blanks of the sheet that do something once filled in */
static void what_is_entered_changes_the_time(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_relative(step_of(f, "S14")->time.nominal_s, 1000, 1e-12);
    assert_int_equal(step_of(f, "S14")->time.status,
                     FW_DERIVED); /* a guess that is not used does not count */
    double plasma = step_of(f, "S18")->time.nominal_s;
    measured(f, "pan.T", 313.15, 0.5);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    double slower = exp(0.5 * 1.602176634e-19 / 1.380649e-23 * (1 / 295.15 - 1 / 313.15));
    assert_relative(step_of(f, "S14")->time.nominal_s, 1000 / slower, 1e-9);
    assert_relative(step_of(f, "S21")->time.nominal_s, 1000 / slower, 1e-9);
    assert_relative(step_of(f, "S18")->time.nominal_s, plasma, 1e-15);
    measured(f, "rie.kappa", 100, 1); /* of the reference area alone nothing follows */
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_relative(step_of(f, "S18")->time.nominal_s, plasma, 1e-15);
    measured(f, "rie.A-reference", 1e-4, 0);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    /* the whole wafer, 100 mm across, less the aluminium, of whose edges its etch took 1.1 um */
    double open = 0.25 * FW_PI * 0.01 - 30 * (5e-6 - 1.1e-6 * 0.08);
    assert_relative(step_of(f, "S18")->time.nominal_s, plasma * (1 + 100 * open) / (1 + 100 * 1e-4),
                    1e-12);
}

/* a value of the publication with an uncertainty of ours says so, and so does the time that follows */
static void an_uncertainty_has_its_own_status(void **state) {
    (void)state;
    static const char *const pack[] = {SILICON, COPPER, "soi-deep-rie"};
    int ours = 0;
    for (int p = 0; p < 3; p++) {
        fw_process_flow *f = read_pack(arena, pack[p], NULL, NULL, &diags);
        for (int i = 0; i < f->nquantity; i++) {
            const fw_quantity *q = f->quantity[i];
            if (q->status != FW_STATED || q->uncertainty == 0.0 || q->unknown) continue;
            assert_int_equal(q->u_status, FW_ASSUMED);
            ours++;
        }
        if (p > 0) continue;
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        assert_int_equal(step_of(f, "S14")->time.status, FW_DERIVED);
        assert_int_equal(step_of(f, "S14")->time.u_status, FW_ASSUMED);
    }
    assert_int_equal(ours, 16);
    assert_null(read_pack(arena, SILICON, "u-status=\"assumed\"", "u-status=\"ours\"", &diags));
}

/* every text that a flow shows, filled in; freed with the arena */
static const char *all_texts(const fw_process_flow *f) {
    fw_text out = fw_text_new(arena);
    fw_text_add(&out, "");
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        fw_text_printf(&out, "%s\n%s\n", s->title, s->purpose);
        for (int k = 0; k < s->nendpoint; k++)
            fw_text_printf(&out, "%s\n", s->endpoint[k]);
        for (int k = 0; k < s->nderive; k++)
            fw_text_printf(&out, "%s\n", s->derive[k].name);
        for (int k = 0; k < s->nsetting; k++)
            fw_text_printf(&out, "%s\n", s->setting[k].name);
        for (int k = 0; k < s->naccept; k++)
            fw_text_printf(&out, "%s\n", s->accept[k].measure);
        for (int k = 0; k < s->non_fail; k++)
            fw_text_printf(&out, "%s: %s\n", s->on_fail[k].condition, s->on_fail[k].text);
    }
    for (int i = 0; i < f->nreason; i++)
        fw_text_printf(&out, "%s\n", f->reason[i]);
    fw_text_printf(&out, "%s\n", f->bias_note);
    assert_int_equal(fw_text_end(&out), FW_OK);
    return out.data;
}

/* "90 min" as a word of its own */
static bool says(const char *texts, const char *token) {
    size_t n = strlen(token);
    for (const char *at = strstr(texts, token); at; at = strstr(at + 1, token)) {
        bool starts = at == texts || (!isalnum((unsigned char)at[-1]) && at[-1] != '.');
        if (starts && !isalnum((unsigned char)at[n]) && at[n] != '/') return true;
    }
    return false;
}

typedef struct
    printed { /* quantities of the flow, and what its steps derive, as they are printed */
    const char *token[1200];
    int n;
} printed;

static void print_one(printed *p, const fw_quantity *q) {
    char value[32];
    bool shown = !q->unknown && q->unit && strcmp(q->unit, "1") != 0;
    fw_number_text(value, sizeof value, shown ? fw_quantity_in_unit(q) : 0.0, 4);
    assert_true(p->n < 1200);
    p->token[p->n++] = shown ? fw_arena_printf(arena, "%s %s", value, q->unit) : "";
}

static printed *print_all(const fw_process_flow *f) {
    printed *p = fw_arena_one(arena, printed);
    for (int i = 0; i < f->nquantity; i++)
        print_one(p, f->quantity[i]);
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nderived; k++)
            print_one(p, f->step[i].derived[k]);
    return p;
}

static bool still_true(const printed *now, const char *token) {
    for (int i = 0; i < now->n; i++)
        if (strcmp(now->token[i], token) == 0) return true;
    return false;
}

/* Each input in turn is changed by some per cent: a text that still says the former value of a quantity that changed with
   it, where no other has that value, was not told. */
static void nothing_stays_when_a_value_changes(void **state) {
    (void)state;
    static const char *const pack[] = {SILICON, COPPER, "soi-deep-rie"};
    int stale = 0, changed = 0;
    for (int p = 0; p < 3; p++) {
        fw_process_flow *f = read_pack(arena, pack[p], NULL, NULL, &diags);
        for (int i = 0; i < f->nquantity; i++) {
            fw_quantity *q = f->quantity[i], was = *q;
            fw_mark mark = fw_arena_mark(arena);
            if (q->unknown || q->status == FW_DERIVED || q->value == 0.0) continue;
            diags = fw_diags_new(arena);
            assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
            const printed *before = print_all(f);
            q->value *= q->range && strcmp(q->range, "anisotropy") == 0 ? 0.993 : 1.0137;
            assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
            const printed *after = print_all(f);
            const char *texts = all_texts(f);
            for (int k = 0; k < before->n && before->n == after->n; k++) {
                const char *old = before->token[k];
                if (!old[0] || strcmp(old, after->token[k]) == 0) continue;
                changed++;
                if (!says(texts, old) || still_true(after, old)) continue;
                print_error("%s, %s changed: a text still says %s\n", pack[p], was.id, old);
                stale++;
            }
            *q = was;
            fw_arena_rewind(arena, mark);
        }
    }
    assert_true(changed > 300);
    assert_int_equal(stale, 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(texts_follow_their_values),         TEST(what_names_nothing_is_said),
        TEST(no_text_repeats_a_value),           TEST(what_is_entered_changes_the_time),
        TEST(an_uncertainty_has_its_own_status), TEST(nothing_stays_when_a_value_changes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
