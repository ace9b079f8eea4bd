/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a step measures, is timed for, parts or dissolves below must be so, by the films on the wafer alone: the packs without a
   single <requires>, and steps of them at wrong places. And a bath that is not of our packs. */
#include "pack_fixture.h"

static const char *step_text(const char *text, const char *id) {
    const char *from = strstr(text, fw_arena_printf(arena, "  <step id=\"%s\"", id));
    assert_non_null(from);
    return fw_arena_strndup(arena, from, (size_t)(strstr(from, "</step>\n") + strlen("</step>\n") - from));
}

static const char *in_place(const char *text, const char *from, const char *to) {
    const char *at = strstr(text, from);
    if (!at) fail_msg("no '%s'", from);
    return fw_arena_printf(arena, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
}

/* the lines of the text that do not hold `word` */
static const char *without(const char *text, const char *word) {
    size_t n = strlen(text);
    char *out = fw_arena_strndup(arena, text, n), *to = out;
    for (const char *line = text; *line;) {
        const char *end = strchr(line, '\n'), *next = end ? end + 1 : line + strlen(line);
        const char *found = strstr(line, word);
        if (!found || found >= next) {
            memmove(to, line, (size_t)(next - line));
            to += next - line;
        }
        line = next;
    }
    *to = '\0';
    return out;
}

static const char *bare(const char *pack) {
    size_t n = 0;
    return without(without(pack_text(arena, pack, &n), "<requires "), "<lag ");
}

static const char *put_before(const char *text, const char *id, const char *other) {
    const char *step = step_text(text, id);
    const char *at = fw_arena_printf(arena, "  <step id=\"%s\"", other);
    return in_place(in_place(text, step, ""), at, fw_arena_printf(arena, "%s%s", step, at));
}

static const char *again_before(const char *text, const char *id, const char *other) {
    const char *at = fw_arena_printf(arena, "  <step id=\"%s\"", other);
    const char *step = in_place(step_text(text, id), fw_arena_printf(arena, "id=\"%s\"", id),
                                fw_arena_printf(arena, "id=\"%sB\"", id));
    return in_place(text, at, fw_arena_printf(arena, "%s%s", step, at));
}

static const fw_diag *said(const char *pack, const char *text, int number, const char *says) {
    size_t nb = 0;
    const char *base = pack_text(arena, "base", &nb);
    fw_process_flow *f = NULL;
    diags = fw_diags_new(arena);
    fw_process_flow_read(arena, "base.xml", base, nb, pack, text, strlen(text), &diags, &f);
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].number == number && strstr(diags.item[i].message, says)) return &diags.item[i];
    return NULL;
}

static const char GLASS[] = "silicon-on-glass";
static const int OURS[] = {600, 601, 602, 623, 624, 633, 634};

static void judged(const char *pack, const char *text, int number, fw_severity severity, const char *says) {
    const fw_diag *d = said(pack, text, number, says);
    if (!d) fail_msg("nothing says FW-D%d '%s'", number, says);
    assert_int_equal(d->severity, severity);
}

static void packs_are_fine(void **state) {
    (void)state;
    static const char *const packs[] = {SILICON, COPPER, GLASS, "soi-deep-rie", "soi-double-sided"};
    for (size_t i = 0; i < sizeof packs / sizeof *packs; i++)
        for (size_t k = 0; k < sizeof OURS / sizeof *OURS; k++)
            if (said(packs[i], bare(packs[i]), OURS[k], "")) fail_msg("%s: FW-D%d", packs[i], OURS[k]);
}

static void measured_too_early(void **state) {
    (void)state;
    judged(SILICON, put_before(bare(SILICON), "S04", "S03"), 624, FW_WARNING, "step S04 measures 'sheet resistance'");
    judged(SILICON, put_before(bare(SILICON), "S12", "S11"), 624, FW_ERROR, "step S12 measures 'resist width");
    judged(SILICON, put_before(bare(SILICON), "S15", "S14"), 624, FW_ERROR, "step S15 measures 'line width in al");
    judged(SILICON, put_before(bare(SILICON), "S19", "S17"), 624, FW_ERROR, "step S19 looks at the coupon 'slots'");
    judged(COPPER, put_before(bare(COPPER), "C19", "C18"), 624, FW_ERROR, "step C19 measures 'width against");
    judged(COPPER, put_before(bare(COPPER), "C23", "C22"), 623, FW_ERROR, "step C23 accepts a wafer by cu.d");
    judged(GLASS, put_before(bare(GLASS), "G16", "G09"), 623, FW_ERROR, "step G16 accepts a wafer by cavity.d");
    judged(GLASS, put_before(bare(GLASS), "G51", "G40"), 623, FW_ERROR, "step G51 drives the device");
    judged(GLASS, put_before(bare(GLASS), "G50", "G40"), 623, FW_ERROR, "step G50 frees the device");
}

static void measured_too_late(void **state) {
    (void)state;
    judged(SILICON, again_before(bare(SILICON), "S08", "S17"), 623, FW_ERROR, "step S08B is timed for litho.resist");
    judged(SILICON, again_before(bare(SILICON), "S12", "S17"), 624, FW_ERROR, "there is no 'resist' on the wafer");
    const char *height = "    <accept measure=\"step height\" lo=\"{=al.d*0.9}\" hi=\"{=al.d*1.1}\" unit=\"um\" sites=\"5\" every=\"1\"/>\n",
               *end = strstr(step_text(bare(SILICON), "S23"), "    <accept");
    assert_non_null(end);
    judged(SILICON, in_place(bare(SILICON), end, fw_arena_printf(arena, "%s%s", height, end)), 623, FW_ERROR,
           "step S23 accepts a wafer by al.d");
    /* numbers of a film that is gone are those of no film */
    const char *number = "    <accept measure=\"thickness\" lo=\"0.9\" hi=\"1.1\" unit=\"um\" sites=\"5\" every=\"1\"/>\n";
    judged(SILICON, in_place(bare(SILICON), end, fw_arena_printf(arena, "%s%s", number, end)), 616, FW_ERROR, "step S23");
    judged(COPPER, put_before(bare(COPPER), "C14", "C28"), 623, FW_ERROR, "step C14 strips, and there is no coat");
}

static void parted_and_undermined(void **state) {
    (void)state;
    const char *glass = bare(GLASS);
    judged(GLASS, in_place(glass, step_text(glass, "G48"), ""), 633, FW_ERROR, "step G52 packages chips, and no step");
    judged(GLASS, put_before(glass, "G38", "G49"), 633, FW_ERROR, "step G38 saws a wafer that a step before it");
    judged(GLASS, put_before(glass, "G38", "G22"), 633, FW_WARNING, "step G22 spins over the cuts");
    judged(GLASS, in_place(in_place(in_place(glass, step_text(glass, "G48"), ""), step_text(glass, "G52"), ""),
                           step_text(glass, "G53"), ""), 633, FW_WARNING, "step G38 saws the wafer, and no step");
    judged(COPPER, put_before(bare(COPPER), "C26", "C25"), 634, FW_ERROR, "dissolves 'porous-silicon' below 'copper-seed'");
    judged("soi-double-sided", in_place(bare("soi-double-sided"), "where=\"window\" side=\"back\" profile=\"anisotropic\"", "profile=\"anisotropic\""),
           634, FW_ERROR, "dissolves 'silicon-substrate' below 'buried-oxide'");
}

/* the copper's plating step in a bath of gold cyanide, as a laboratory would write it in a pack of its own */
static const char *gold_bath(const char *attributes, const char *first_aid) {
    static const char first[] = "  <equipment id=\"bench\"";
    size_t n = 0;
    const char *text = pack_text(arena, COPPER, &n), *step = step_text(text, "C22");
    const char *hazard = fw_arena_printf(arena,
                                         "  <hazard id=\"h.gold\" name=\"gold cyanide\" ghs=\"GHS06\" wets=\"yes\" %s>\n"
                                         "    <ppe>x</ppe><firstaid>%s</firstaid><waste stream=\"cyanide\">x</waste>\n  </hazard>\n",
                                         attributes, first_aid);
    const char *gold = in_place(step, "<hazard-ref ref=\"h.copper-acid\"/>", "<hazard-ref ref=\"h.gold\"/>");
    return in_place(in_place(text, step, gold), first, fw_arena_printf(arena, "%s%s", hazard, first));
}

static void other_chemistry(void **state) {
    (void)state;
    static const char cyanide[] = "reacts-as=\"base cyanide\" buddy=\"yes\"", aid[] = "say cyanide";
    const char *fine = gold_bath(cyanide, aid), *step = step_text(fine, "C20");
    assert_null(said(COPPER, fine, 635, ""));
    judged(COPPER, gold_bath("reacts-as=\"base cyanide\"", aid), 635, FW_ERROR, "hazard 'h.gold' is a cyanide");
    judged(COPPER, gold_bath(cyanide, "fresh air"), 635, FW_ERROR, "say \"cyanide\"");
    assert_null(said(COPPER, gold_bath("reacts-as=\"base\"", "x"), 635, "")); /* a sulfite */
    const char *wet = without(without(step, "<finish kind=\"rinse\""), "<finish kind=\"dry\"");
    judged(COPPER, in_place(fine, step, wet), 336, FW_ERROR, "hydrogen cyanide is set free");
    const char *mixed = in_place(fine, "<hazard-ref ref=\"h.gold\"/>", "<hazard-ref ref=\"h.gold\"/><hazard-ref ref=\"h.acid\"/>");
    judged(COPPER, mixed, 175, FW_WARNING, "step C22 works with h.gold and h.acid");
    assert_null(said(COPPER, mixed, 175, "steps C22 and C22"));
}

/* a dose of nothing, and one of a thousand times too much, which is its unit mistaken */
static void doses(void **state) {
    (void)state;
    static const char unknown[] = "<q id=\"expose.D\" unknown=\"true\"";
    judged(SILICON, in_place(bare(SILICON), unknown, "<q id=\"expose.D\" value=\"0\" u=\"1\""), 278, FW_ERROR, "'expose.D' is 0");
    judged(SILICON, in_place(bare(SILICON), unknown, "<q id=\"expose.D\" value=\"1e5\" u=\"1\""), 278, FW_ERROR, "'expose.D'");
    assert_null(said(SILICON, in_place(bare(SILICON), unknown, "<q id=\"expose.D\" value=\"150\" u=\"5\""), 278, ""));
}

static const char *made_a(const char *text, const char *id, const char *op, const char *other) {
    const char *step = step_text(text, id);
    return in_place(text, step, in_place(step, op, other));
}

/* what holds a wafer flat, what throws chips on it, and what presses on it */
static void flat_and_dusty(void **state) {
    (void)state;
    judged(SILICON, put_before(bare(SILICON), "S05", "S04"), 600, FW_ERROR, "step S04 measures 'bow'");
    judged(GLASS, put_before(bare(GLASS), "G39", "G38"), 601, FW_WARNING, "step G38 saws or breaks");
    judged(GLASS, made_a(bare(GLASS), "G20", "op=\"clean\"", "op=\"inspect\""), 602, FW_WARNING, "that step G19 has pressed on");
    /* behind all that is worked on it may be sawn open */
    assert_null(said(GLASS, bare(GLASS), 601, ""));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(packs_are_fine, setup, teardown),
        cmocka_unit_test_setup_teardown(measured_too_early, setup, teardown),
        cmocka_unit_test_setup_teardown(measured_too_late, setup, teardown),
        cmocka_unit_test_setup_teardown(parted_and_undermined, setup, teardown),
        cmocka_unit_test_setup_teardown(other_chemistry, setup, teardown),
        cmocka_unit_test_setup_teardown(doses, setup, teardown),
        cmocka_unit_test_setup_teardown(flat_and_dusty, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
