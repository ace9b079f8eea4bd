/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/constants.h"
#include "pack_fixture.h"
#include "process/process_law.h"
#include "process/films.h"

static fw_process_flow *computed(const char *name, const char *from, const char *to,
                                 const fw_process_mask_facts *facts) {
    fw_process_flow *f = read_pack(arena, name, from, to, &diags);
    assert_non_null(f);
    assert_int_equal(fw_process_flow_compute(arena, f, facts, &diags), FW_OK);
    return f;
}

static const fw_quantity *derived(fw_process_flow *f, const char *step, const char *name) {
    fw_process_step *s = step_of(f, step);
    for (int i = 0; i < s->nderived; i++)
        if (strcmp(s->derived[i]->id, name) == 0) return s->derived[i];
    for (int i = 0; i < s->nderived; i++)
        if (strstr(s->derived[i]->id, name)) return s->derived[i];
    fail_msg("%s derives no '%s'", step, name);
    return NULL;
}

static double shown(fw_process_flow *f, const char *step, const char *name) {
    return fw_quantity_in_unit(derived(f, step, name));
}

static bool reason(const fw_process_flow *f, const char *text) {
    for (int i = 0; i < f->nreason; i++)
        if (strstr(f->reason[i], text)) return true;
    return false;
}

static void copper(void **state) {
    (void)state;
    fw_process_flow *f = computed(COPPER, NULL, NULL, &plain_facts);
    fw_process_step *s = step_of(f, "C22");
    assert_relative(s->time.nominal_s, 1262.268843, 1e-9);
    /* 30 dies of 5 mm2 and the contact ring of 2 cm2 */
    assert_relative(fw_quantity_in_unit(fw_process_flow_quantity(f, "mask.plated-area")), 3.5,
                    1e-12);
    assert_relative(shown(f, "C22", "current"), 70.0, 1e-12);
    assert_relative(derived(f, "C22", "charge")->value, 0.07 * 1262.268843, 1e-9);
    assert_relative(shown(f, "C22", "mass deposited"), 8.064 * 3.5, 1e-9);
    assert_relative(shown(f, "C22", "least copper"), 0.7286395637, 1e-8);
    assert_relative(shown(f, "C22", "local current"), 16.0 / 9.0, 1e-12);
    /* edges within 0.5 um: u_A = P u_edge, and the ring's own 0.1 cm2 */
    double u = hypot(0.08 * 30 * 1e-6 / sqrt(12.0), 0.1e-4);
    assert_relative(fw_process_flow_quantity(f, "mask.plated-area")->uncertainty, u, 1e-9);
    assert_string_equal(s->time.contribution[0], "area 2.86 %");
    assert_relative(shown(f, "C05", "current"), 0.2770885, 1e-6);
    assert_relative(shown(f, "C05", "time for 2 um"), 110.4149070, 1e-8);
    /* 4 dV/(J share R^2) with share R^2 = structures/pi */
    assert_relative(shown(f, "C07", "sheet resistance"), 4 * 0.02 * FW_PI / (200 * 30 * 5e-6),
                    1e-9);
    assert_relative(step_of(f, "C15")->time.nominal_s, 4608.0, 1e-9);
    assert_relative(shown(f, "C16", "light on"), 141.4285714, 1e-9);
    /* u(D) 7 %, u(I) 5 %, u(h) 3 %: 9.12 % in all */
    const fw_quantity *light = derived(f, "C16", "light on");
    assert_near(light->uncertainty / light->value, 0.0912, 5e-5);
    assert_relative(shown(f, "C16", "with pauses"), 351.4285714, 1e-9);
    assert_relative(shown(f, "C10", "spin speed"), 2402.5, 1e-9);
    assert_near(f->bias_m, 0.0, 0.0);
    assert_int_equal(f->manufacturable, -1);
    assert_true(reason(f, "adhesion"));
    /* two spins to 16 um by a typical spin curve; the dose needs the resist's name */
    for (int i = 0; i < 2; i++) {
        const fw_process_time *spin = &step_of(f, i ? "C12" : "C10")->time;
        assert_true(spin->computable && spin->status >= FW_TYPICAL);
        assert_near(spin->nominal_s, 60.0, 0.0);
    }
    assert_false(step_of(f, "C16")->time.computable);
    assert_int_equal(f->not_computable, 5);
}

static const char lag_assumed[] =
    "<q id=\"rie.S\" value=\"0.1\" u=\"0.05\" unit=\"1\" status=\"assumed\" src=\"guess\"";
static const char lag_measured[] =
    "<q id=\"rie.S\" value=\"0.1\" u=\"0.05\" unit=\"1\" status=\"stated\" src=\"paper\"";

/* as the source has it: 90 min, and what a lag that is only assumed would ask for beside it */
static void silicon_as_published(void **state) {
    (void)state;
    fw_process_flow *f = computed(SILICON, NULL, NULL, &plain_facts);
    fw_process_step *s = step_of(f, "S18");
    assert_relative(s->time.nominal_s, 5400.0, 1e-15);
    assert_relative(s->time.first_look_s / 60.0, 80.8218, 1e-6);
    assert_relative(s->time.stop_s / 60.0, 109.0961, 1e-6);
    assert_relative(shown(f, "S18", "narrowest slot"), 98.854173, 1e-7);
    assert_relative(shown(f, "S18", "SF6 used"), 1.1 * 29.32311857, 1e-6);
    assert_relative(step_of(f, "S18")->booked_s, 60 * 129.0, 1e-9); /* 99 min in four parts */
    assert_true(reason(f, "A = 0.9 in the nominal time and at A = 0.9167 with 20 % over-etch"));
    assert_true(
        reason(f, "A >= 0.993 (tapered wall, nominal time), 0.9942 (10 % over-etch), 0.9965"));
    assert_true(reason(f, "reaches 45.81 of 50 um"));
    assert_true(reason(f, "would need 1.098 times that time"));
    assert_non_null(strstr(f->bias_note, "0.55, 2.75, 5.5 um"));
    assert_int_equal(f->manufacturable, -1);
}

static void silicon(void **state) {
    (void)state;
    fw_process_flow *f = computed(SILICON, lag_assumed, lag_measured, &plain_facts);
    fw_process_step *s = step_of(f, "S18");
    /* 50 um in 90 min in wide openings; planned for the slot of 10 um, S = 0.1 */
    assert_relative(shown(f, "S18", "wide openings"), 90.0, 1e-15);
    assert_relative(s->time.nominal_s / 60.0, 98.854173, 1e-7);
    assert_relative(shown(f, "S18", "narrowest slot"), 98.854173, 1e-7);
    assert_true(shown(f, "S18", "open field") > 90.0 && shown(f, "S18", "open field") < 90.3);
    assert_relative(shown(f, "S18", "share of O2"), 3.846153846, 1e-9);
    /* gas flows, and the mask is taken, for as long as the step is planned: 1.1 times 98.85 min */
    assert_relative(shown(f, "S18", "SF6 used"), 1.1 * 29.32311857 * 98.854173 / 90.0, 1e-6);
    assert_relative(shown(f, "S18", "lost of the open aluminium"), 0.55 * 98.854173 / 90.0, 1e-7);
    assert_relative(shown(f, "S04", "bow"), 1666.666667, 1e-8);
    assert_relative(shown(f, "S14", "bath volume"), 95.0, 1e-12);
    assert_relative(shown(f, "S14", "27 Cel"), 720.737, 1e-6);
    assert_relative(step_of(f, "S14")->time.stop_s, 1326.7708, 1e-6);
    assert_relative(step_of(f, "S21")->time.stop_s, 1447.386, 1e-6);
    assert_relative(f->bias_m, 1.1e-6, 1e-12);
    assert_non_null(strstr(f->bias_note, "NOT in the bias"));
    /* E = 1.1 (50 + 0.1 J(10 um, 50 um)) = 60.41 um */
    assert_non_null(strstr(f->bias_note, "(1 - A) 60.41 um"));
    assert_non_null(strstr(f->bias_note, "0.6041, 3.021, 6.041 um"));
    assert_int_equal(f->manufacturable, -1);
    /* 10 um wide, 50 um deep, the time of the slot: 1 - 10/(2 54.92) */
    assert_true(reason(f, "A = 0.909 in the nominal time and at A = 0.9241 with 20 % over-etch"));
    assert_true(reason(f, "reaches 45.81 of 50 um"));
    assert_true(reason(f, "is planned for 1.098 times that time"));
    assert_int_equal(f->not_computable, 2);
    for (int i = 0; i < f->nstep; i++) { /* a time or names, never neither */
        fw_process_time *t = &f->step[i].time;
        assert_true(t->computable ? t->nominal_s > 0.0 && t->nmissing == 0 : t->nmissing > 0);
        if (t->computable)
            assert_true(t->first_look_s <= t->nominal_s && t->nominal_s <= t->clear_by_s &&
                        t->clear_by_s <= t->stop_s);
    }
}

/* without lag the time is that of the source, and what 10 um in 50 um need */
static void silicon_without_lag(void **state) {
    (void)state;
    fw_process_flow *f = computed(SILICON, "<q id=\"rie.S\" value=\"0.1\" u=\"0.05\"",
                                  "<q id=\"rie.S\" value=\"0\" u=\"0\"", &plain_facts);
    fw_process_step *s = step_of(f, "S18");
    assert_relative(s->time.nominal_s, 5400.0, 1e-15); /* 50 um in 90 min, to the last digits */
    assert_relative(s->time.stop_s / 60.0, 109.0961, 1e-6);
    assert_true(reason(f, "A = 0.9 in the nominal time and at A = 0.9167 with 20 % over-etch"));
    assert_true(
        reason(f, "A >= 0.993 (tapered wall, nominal time), 0.9942 (10 % over-etch), 0.9965"));
    assert_non_null(strstr(f->bias_note, "0.55, 2.75, 5.5 um"));
    assert_relative(shown(f, "S18", "SF6 used"), 1.1 * 29.32311857, 1e-6);
    assert_relative(step_of(f, "S18")->booked_s, 60 * 129.0, 1e-9); /* 99 min in four parts */
}

static void missing_names(void **state) {
    (void)state;
    fw_process_flow *f = computed(SILICON, NULL, NULL, &plain_facts);
    fw_process_time *t = &step_of(f, "S03")->time;
    assert_false(t->computable);
    assert_int_equal(t->nmissing, 2);
    assert_string_equal(t->missing[0], "sputter rate (al.R)");
    assert_string_equal(t->missing[1], "power (al.power)");
    /* a laboratory enters what was missing */
    f = computed(SILICON, "<q id=\"al.R\" unknown=\"true\"", "<q id=\"al.R\" value=\"50\" u=\"2\"",
                 &plain_facts);
    assert_int_equal(step_of(f, "S03")->time.nmissing, 1);
}

static void no_mask_yet(void **state) {
    (void)state;
    fw_process_flow *f = computed(COPPER, NULL, NULL, NULL);
    fw_process_time *t = &step_of(f, "C22")->time;
    assert_false(t->computable);
    assert_string_equal(t->missing[0], "plated area in all (mask.plated-area)");
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_true(t->computable);
    int derived_before = step_of(f, "C22")->nderived, reasons = f->nreason;
    double total = f->total_s;
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags),
                     FW_OK); /* again: the same */
    assert_int_equal(step_of(f, "C22")->nderived, derived_before);
    assert_int_equal(f->nreason, reasons);
    assert_near(f->total_s, total, 0.0);
}

static void device_thickness(void **state) {
    (void)state;
    fw_process_mask_facts facts = plain_facts;
    facts.device_thickness_m = 12e-6;
    fw_process_flow *f = computed(COPPER, NULL, NULL, &facts);
    assert_relative(step_of(f, "C22")->time.nominal_s, 1262.268843 * 12.0 / 9.0, 1e-9);
    assert_int_equal(f->thickness->status, FW_ASSUMED);
    facts.device_thickness_m = 30e-6;
    f = computed(COPPER, NULL, NULL, &facts);
    assert_int_equal(f->manufacturable, 0);
    assert_true(reason(f, "do not fit into a mould of 16 um"));
    facts.device_thickness_m = 9e-6; /* the pack's own: nothing changes */
    f = computed(COPPER, NULL, NULL, &facts);
    assert_int_equal(f->thickness->status, FW_STATED);
}

static void lithography(void **state) {
    (void)state;
    fw_process_mask_facts facts = plain_facts;
    facts.narrowest_slot_m = 2.6e-6;
    fw_process_flow *f = computed(COPPER, NULL, NULL, &facts);
    assert_int_equal(f->manufacturable, 0);
    assert_true(reason(f, "1.5 sqrt(lambda h/2) = 2.7 um"));
    assert_true(reason(f, "Nearest change: openings at least 4.1 um wide"));
    facts.narrowest_slot_m = 3.5e-6; /* prints in perfect contact only */
    f = computed(COPPER, NULL, NULL, &facts);
    assert_int_equal(f->manufacturable, -1);
    assert_true(reason(f, "only in perfect contact"));
    facts.narrowest_slot_m = 2.1e-6; /* silicon: the aluminium bias of 1.1 um per edge closes it */
    f = computed(SILICON, NULL, NULL, &facts);
    assert_int_equal(f->manufacturable, 0);
    assert_true(reason(f, "closes the narrowest slot"));
}

static void measured_anisotropy(void **state) {
    (void)state;
    fw_process_mask_facts facts = plain_facts;
    fw_process_flow *f = read_pack(arena, SILICON, "<q id=\"rie.A\" unknown=\"true\"",
                                   "<q id=\"rie.A\" value=\"0.95\" u=\"0.01\"", &diags);
    ((fw_quantity *)fw_process_flow_quantity(f, "rie.S"))->status = FW_MEASURED;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    /* 1.1 um of the aluminium and (1 - A)(E - (D + lag)/2), which narrows the slot it is for */
    double m = 0.0, E = 0.0, field = 2.0 * (28e-6 - 5e-6) / 0.08;
    for (int i = 0; i < 60; i++) {
        E = 1.1 * (50e-6 + 0.1 * fw_process_arde_integral(10e-6 - 2 * m, 50e-6, false));
        m = 0.05 *
            (E - 0.5 * (50e-6 + 0.1 * fw_process_arde_integral(field - 2 * m, 50e-6, false)));
    }
    assert_relative(f->bias_m, 1.1e-6 + m, 1e-12);
    assert_relative(f->edges.cls[f->edges.field].edge.top_m, m - 0.05 * E, 1e-11);
    assert_true(reason(f, "um wide at the top"));
    f = computed(SILICON, "<q id=\"rie.A\" unknown=\"true\"",
                 "<q id=\"rie.A\" value=\"0.75\" u=\"0.01\"", &facts);
    assert_int_equal(f->manufacturable, 0);
}

static void wrong_facts(void **state) {
    (void)state;
    fw_process_mask_facts bad[8];
    for (int i = 0; i < 8; i++) {
        bad[i] = plain_facts;
        bad[i].narrowest_slot_m = bad[i].narrowest_line_m = bad[i].deepest_hinge_width_m = 8e-6;
    }
    bad[0].structure_area_m2 = 0;
    bad[1].die_area_m2 = -1;
    bad[2].perimeter_m = bad[3].narrowest_slot_m = (double)NAN;
    bad[4].dies = 0;
    bad[5].deepest_hinge_width_m = -8e-6;
    bad[6].device_thickness_m = -1;
    bad[7].structure_area_m2 = 9e-6, bad[7].die_area_m2 = 8e-6;
    fw_process_flow *f = read_pack(arena, COPPER, NULL, NULL, &diags);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        diags = fw_diags_new(arena);
        assert_int_equal(fw_process_flow_compute(arena, f, &bad[i], &diags), FW_INPUT);
        assert_int_equal(diags.item[0].number, 179);
    }
}

/* a rigid mechanism without flexures and slots is no mistake */
static void nothing_narrow(void **state) {
    (void)state;
    const double none = (double)INFINITY;
    fw_process_mask_facts facts = plain_facts;
    facts.narrowest_slot_m = facts.narrowest_line_m = none;
    facts.deepest_hinge_width_m = 0.0;
    facts.dies = 1;
    facts.device_thickness_m = (double)NAN;
    for (int i = 0; i < 2; i++) {
        fw_process_flow *f = computed(i ? SILICON : COPPER, NULL, NULL, &facts);
        assert_int_equal(f->manufacturable, -1);
        for (int k = 0; k < f->nreason; k++)
            if (strstr(f->reason[k], " inf") || strstr(f->reason[k], "nan "))
                fail_msg("%s", f->reason[k]);
    }
}

static int count(const fw_process_stack *s, int column, const char *material) {
    int n = 0;
    for (int i = 0; i < s->n[column]; i++)
        n += strcmp(s->cell[column][i].material, material) == 0;
    return n;
}

static void layers(void **state) {
    (void)state;
    fw_process_stack s;
    const fw_process_change *absent = NULL;
    fw_process_flow *f = read_pack(arena, COPPER, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_stack(arena, f, 12, &s, &absent),
                     FW_OK); /* after C13: two coats */
    assert_int_equal(count(&s, FW_STACK_STRUCTURE, "resist"), 2);
    assert_int_equal(fw_process_flow_stack(arena, f, 21, &s, &absent), FW_OK); /* after C22 */
    assert_int_equal(count(&s, FW_STACK_STRUCTURE, "resist"), 0);
    assert_int_equal(count(&s, FW_STACK_FIELD, "resist"), 2);
    assert_int_equal(count(&s, FW_STACK_STRUCTURE, "copper-plated"), 1);
    assert_int_equal(count(&s, FW_STACK_FIELD, "copper-plated"), 0);
    assert_int_equal(fw_process_flow_stack(arena, f, 27, &s, &absent), FW_OK);
    assert_int_equal(count(&s, FW_STACK_STRUCTURE, "porous-silicon"), 0);
    assert_int_equal(count(&s, FW_STACK_FIELD, "copper-seed"), 0);
    assert_null(absent);
    f = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_stack(arena, f, 22, &s, &absent),
                     FW_OK); /* silicon alone is left */
    assert_int_equal(s.n[FW_STACK_STRUCTURE], 1);
    assert_int_equal(s.n[FW_STACK_FIELD], 0);
    assert_int_equal(fw_process_flow_stack(arena, f, -1, &s, &absent), FW_OK);
    assert_int_equal(s.n[FW_STACK_STRUCTURE], 0);
}

static void counted(void **state) {
    (void)state;
    fw_process_flow *f = computed(SILICON, NULL, NULL, &plain_facts);
    int sum = f->unknown;
    for (int i = FW_MEASURED; i <= FW_ASSUMED; i++)
        sum += f->count[i];
    assert_true(f->unknown >= 10 && f->count[FW_STATED] == 14 && f->count[FW_ASSUMED] > 5);
    assert_true(sum <= f->nquantity);
    assert_int_equal(diags.item[0].number, 176);
    assert_non_null(strstr(diags.item[0].message, "S03, S09"));
}

/* 0.07 of 0.08 m of edges are moved by the bias of the mask: what is printed is plated, and the plasma sees the aluminium and
   all of the wafer that it does not cover */
static void areas(void **state) {
    (void)state;
    fw_process_mask_facts facts = plain_facts;
    facts.biased_perimeter_m = 0.07;
    fw_process_flow *f = computed(COPPER, NULL, NULL, &facts);
    measured(f, "seed.d", 0.8e-6, 1e-8);
    measured(f, "seed.R", 0.1e-6 / 60, 1e-11);
    measured(f, "litho.edge", 0.1e-6, 1e-8);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_relative(f->bias_m, 0.96e-6 - 0.1e-6, 1e-9);
    const double printed = 30 * (5e-6 + 0.86e-6 * 0.07 + 0.1e-6 * 0.08), ring = 2e-4;
    assert_relative(fw_process_flow_quantity(f, "mask.structure-area")->value, printed, 1e-9);
    assert_relative(fw_process_flow_quantity(f, "mask.plated-area")->value, printed + ring, 1e-9);
    assert_relative(shown(f, "C22", "current"), 200 * (printed + ring) * 1e3, 1e-9);
    f = computed(SILICON, NULL, NULL, &facts);
    const double left = 30 * (5e-6 + 1.1e-6 * (0.07 - 0.08)), wafer = 0.25 * FW_PI * 0.01;
    const fw_quantity *open = fw_process_flow_quantity(f, "mask.open-area");
    assert_relative(open->value, wafer - left, 1e-9);
    assert_int_equal(open->status, FW_ASSUMED); /* of the pack's own wafer */
    facts.wafer_area_m2 = 7e-3, facts.wafer_diameter_m = 0.1;
    facts.wafer_structure_m2 = 2e-4, facts.wafer_perimeter_m = 3, facts.wafer_biased_m = 2;
    f = computed(SILICON, NULL, NULL, &facts);
    open = fw_process_flow_quantity(f, "mask.open-area");
    assert_relative(open->value, 7e-3 - 2e-4 + 1.1e-6, 1e-9);
    assert_int_equal(open->status, FW_DERIVED);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {TEST(copper),
                                       TEST(areas),
                                       TEST(silicon_as_published),
                                       TEST(silicon),
                                       TEST(silicon_without_lag),
                                       TEST(missing_names),
                                       TEST(no_mask_yet),
                                       TEST(device_thickness),
                                       TEST(lithography),
                                       TEST(measured_anisotropy),
                                       TEST(wrong_facts),
                                       TEST(nothing_narrow),
                                       TEST(layers),
                                       TEST(counted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
