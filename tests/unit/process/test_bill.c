/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a lot uses up: amounts by hand, loads and fillings, prices of a laboratory, mistakes in a pack. */
#include "pack_fixture.h"
#include "process/process.h"
#include "process/calibrate.h"
#include <math.h>

static fw_process_bill bill_of(const fw_process_flow *f, int wafers) {
    fw_process_bill b;
    assert_int_equal(fw_process_flow_bill(arena, f, wafers, NULL, &b), FW_OK);
    return b;
}

static const fw_process_bill_row *row(const fw_process_bill *b, const char *id) {
    for (int i = 0; i < b->nrow; i++)
        if (strcmp(b->row[i].consumable->id, id) == 0) return &b->row[i];
    fail_msg("no consumable %s", id);
    return NULL;
}

static const fw_process_bill_bath *bath(const fw_process_bill *b, const char *id) {
    for (int i = 0; i < b->nbath; i++)
        if (strcmp(b->bath[i].bath->id, id) == 0) return &b->bath[i];
    fail_msg("no bath %s", id);
    return NULL;
}

/* 80 to 5 to 10 parts of 1 mL in a dish for one wafer, twice */
static void amounts(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(SILICON, NULL, NULL);
    for (int n = 1; n <= 7; n++) {
        fw_process_bill b = bill_of(f, n);
        assert_int_equal(bath(&b, "pan")->fillings, n);
        assert_near(bath(&b, "pan")->part_amount[1], 80e-6, 1e-15);
        assert_near(row(&b, "phosphoric")->amount, 2 * n * 80e-6, 1e-15);
        assert_near(row(&b, "nitric")->amount, 2 * n * 5e-6, 1e-15);
        assert_string_equal(row(&b, "nitric")->steps, "S14, S21");
        assert_near(row(&b, "photoresist")->amount, n * 4e-6, 1e-15);
        /* SF6: 50 standard cm3 a minute for 90 min and a tenth more: 4950/22414 mol of
           146.055 g, 32.3 g a wafer */
        assert_near(row(&b, "sf6")->amount, n * 32.26e-3, n * 0.01e-3);
        assert_true(isnan(row(&b, "acetone")->amount)); /* nobody has said how large a dish is */
        assert_string_equal(row(&b, "acetone")->missing, "solvent.volume");
        assert_true(isnan(row(&b, "water")->amount)); /* of three baths one is not known */
        assert_null(b.currency);
    }
}

/* a bath that serves two wafers is mixed as often as the bill has fillings: by the step that sets its volume, once for the lot */
static void fillings_are_mixed(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack("copper-on-porous-silicon", NULL, NULL);
    const fw_process_step *mix = NULL, *other = NULL;
    for (int i = 0; i < f->nstep; i++)
        if (strcmp(f->step[i].id, "C03") == 0) mix = &f->step[i], other = &f->step[i + 1];
    assert_non_null(mix);
    assert_string_equal(fw_process_step_mixes(f, mix)->id, "anodising");
    assert_null(fw_process_step_mixes(f, other));
    assert_int_equal(fw_process_step_times(f, mix, 4), 1); /* nobody has said how many one serves */
    for (int i = 0; i < f->nquantity; i++)
        if (strcmp(f->quantity[i]->id, "bath.serves") == 0) f->quantity[i]->value = 2.0, f->quantity[i]->unknown = false;
    for (int n = 1; n <= 5; n++) {
        fw_process_bill b = bill_of(f, n);
        assert_int_equal(bath(&b, "anodising")->fillings, (n + 1) / 2);
        assert_int_equal(fw_process_step_times(f, mix, n), (n + 1) / 2);
        assert_int_equal(fw_process_step_times(f, other, n), 1);
    }
}

/* A small source h above the wafer sends pi h2 d of what it coats to a thickness of d: 40 cm, twice 0.3 um of gold for the
   glass and once 0.3 um for pads, 19.3 g/cm3; a run takes up to four wafers, and one takes no less */
static void metals(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack("silicon-on-glass", NULL, NULL);
    double throw_m2 = 3.14159265358979 * 0.4 * 0.4;
    for (int n = 1; n <= 8; n++) {
        fw_process_bill b = bill_of(f, n);
        int runs = n > 4 ? 2 : 1;
        assert_near(row(&b, "gold-metal")->amount, runs * throw_m2 * 0.9e-6 * 19300, 1e-9);
        assert_near(row(&b, "chromium-metal")->amount, runs * throw_m2 * 0.12e-6 * 7150, 1e-9);
        assert_near(row(&b, "aluminium-metal")->amount, runs * 0.1 * 1e-6 * 2700, 1e-9);
        assert_string_equal(row(&b, "gold-metal")->steps, "G03, G26");
    }
}

/* six wafers a load in S20, two in the dryer: ceil */
static void loads_and_fillings(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(SILICON, NULL, NULL);
    measured(f, "solvent.volume", 1e-3, 0);
    measured(f, "alcohol.volume", 0.5e-3, 0);
    measured(f, "sc1.volume", 7e-3, 0);
    static const int of_six[] = {0, 1, 1, 1, 1, 1, 1, 2}, of_two[] = {0, 1, 1, 2, 2, 3, 3, 4};
    for (int n = 1; n <= 7; n++) {
        fw_process_bill b = bill_of(f, n);
        assert_near(row(&b, "acetone")->amount, 1e-3 * of_six[n], 1e-15);
        assert_near(row(&b, "alcohol")->amount, 1e-3 * of_six[n] + 0.5e-3 * of_two[n], 1e-15);
        assert_near(row(&b, "ammonia")->amount, 1e-3, 1e-15);
        assert_near(row(&b, "water")->amount, 5e-3 + 2 * n * 10e-6, 1e-15);
    }
    for (int serves = 1; serves <= 4; serves++) {
        measured(f, "pan.serves", serves, 0);
        fw_process_bill b = bill_of(f, 6);
        assert_int_equal(bath(&b, "pan")->fillings, (6 + serves - 1) / serves);
    }
    ((fw_quantity *)fw_process_flow_quantity(f, "pan.serves"))->unknown = true;
    fw_process_bill b = bill_of(f, 6);
    assert_int_equal(bath(&b, "pan")->fillings, 0);
    assert_true(isnan(row(&b, "phosphoric")->amount));
    assert_string_equal(row(&b, "phosphoric")->missing, "pan.serves");
}

/* 0.5 mol/L of the pentahydrate in 2 L: 249.685 g */
static void weighed(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(COPPER, NULL, NULL);
    measured(f, "cu.bath-c", 500.0, 0);
    measured(f, "cu.bath-serves", 10, 0);
    fw_process_bill b = bill_of(f, 4);
    assert_int_equal(bath(&b, "plating")->fillings, 1);
    assert_near(bath(&b, "plating")->part_amount[2], 0.249685, 1e-9);
    b = bill_of(f, 11);
    assert_int_equal(bath(&b, "plating")->fillings, 2);
    measured(f, "release.V", 1e-3, 0);
    b = bill_of(f, 1);
    assert_near(row(&b, "koh")->amount, 4.99e-3, 1e-12); /* 0.5 % of 1 L */
    measured(f, "bath.serves", 3, 0);
    b = bill_of(f, 6); /* HF 3 of 10 parts of 100 mL, twice */
    assert_near(bath(&b, "anodising")->part_amount[2], 30e-6, 1e-15);
    assert_int_equal(bath(&b, "anodising")->fillings, 2);
}

static const char lab_head[] =
    "<process xmlns=\"urn:flexwright:process:1\" flow=\"al-masked-rie\"><source id=\"o\" "
    "kind=\"datasheet\">offer</source>";

static fw_status priced(fw_process_flow *f, const char *rows) {
    const char *text = fw_arena_printf(arena, "%s%s</process>", lab_head, rows);
    return fw_process_lab_apply(arena, "lab.xml", text, strlen(text), f, &diags);
}

#define PRICE(id, value, unit)                                                                     \
    "<q id=\"" id "\" value=\"" value "\" u=\"0\" unit=\"" unit "\" status=\"stated\" src=\"o\"/>"

static void prices(void **state) {
    (void)state;
    fw_process_flow *f = computed_pack(SILICON, NULL, NULL);
    assert_int_equal(priced(f, PRICE("phosphoric.price", "40", "EUR/L")
                                   PRICE("photoresist.price", "0.5", "EUR/mL")
                                       PRICE("rie.price", "60", "EUR/h")),
                     FW_OK);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    fw_process_bill b = bill_of(f, 3);
    assert_string_equal(b.currency, "EUR");
    assert_near(row(&b, "phosphoric")->cost, 3 * 0.16 * 40, 1e-9);
    assert_near(row(&b, "photoresist")->cost, 3 * 4 * 0.5, 1e-9);
    assert_near(b.consumables_cost, 3 * 0.16 * 40 + 3 * 4 * 0.5, 1e-9);
    assert_int_equal(b.rows_without, b.nrow - 2);
    /* the chamber once a lot, then every wafer */
    double seconds = step_of(f, "S17")->booked_s + 3 * step_of(f, "S18")->booked_s;
    assert_near(b.machines_cost, seconds / 60.0, 1e-6);
    assert_int_equal(b.machines_without, b.nmachine - 1);
}

static void bad_prices(void **state) {
    (void)state;
    static const struct {
        const char *rows;
        int number;
        const char *says;
    } bad[] = {
        {PRICE("phosphoric.price", "40", "EUR/L") PRICE("nitric.price", "40", "USD/L"), 371,
         "in EUR"},
        {PRICE("phosphoric.price", "40", "EUR/kg"), 211, "price of a volume"},
        {PRICE("phosphoric.price", "-1", "EUR/L"), 278, "not below 0"},
        {PRICE("phosphoriq.price", "1", "EUR/L"), 211, "did you mean"},
        {PRICE("pan.serves", "0.5", "1"), 370, "less than one wafer"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_process_flow *f = computed_pack(SILICON, NULL, NULL);
        diags = fw_diags_new(arena);
        assert_int_equal(priced(f, bad[i].rows), FW_INPUT);
        const fw_diag *d = said_of(bad[i].number, bad[i].says);
        if (!d || !d->place.line)
            fail_msg("case %zu: no FW-D%03d with '%s'", i, bad[i].number, bad[i].says);
    }
}

static void bad_packs(void **state) {
    (void)state;
    static const struct {
        const char *from, *to;
        int number;
        const char *says;
    } bad[] = {
        {"<part of=\"nitric\" q=\"pan.nitric\"/>", "<part of=\"nitric\" q=\"al.d\"/>", 370,
         "parts of volume"},
        {"<part of=\"nitric\" q=\"pan.nitric\"/>", "<part of=\"sf6\" q=\"pan.nitric\"/>", 370,
         "density of the bath"},
        {"<part of=\"nitric\" q=\"pan.nitric\"/>", "<part of=\"nitrik\" q=\"pan.nitric\"/>", 165,
         "did you mean 'nitric'"},
        {"name=\"sulfur hexafluoride\" unit=\"kg\"", "name=\"sulfur hexafluoride\" unit=\"L\"", 169,
         "not a volume"},
        {"<uses bath=\"pan\"/>", "<uses bath=\"pan\" q=\"al.d\"/>", 370, "names a bath"},
        {"<uses bath=\"pan\"/>", "<uses bath=\"pan\" per=\"lot\"/>", 370, "serves"},
        {"<uses bath=\"pan\"/>", "<uses consumable=\"acetone\" q=\"solvent.volume\"/>", 374,
         "h.solvent"},
        {"one-part=\"pan.part\" serves", "one-part=\"al.d\" serves", 169, "not a volume"},
        {"one-part=\"pan.part\" serves", "serves", 370, "needs the volume"},
        {"<uses consumable=\"photoresist\" q=\"resist.dispense\"/>",
         "<align to=\"M1\" overlay=\"litho.gap\"/>", 373, "exposes no mask"},
        {"mask=\"M1\" batch=\"1\" attended=\"8\">",
         "mask=\"M1\" batch=\"1\" attended=\"8\"><align to=\"M0\" overlay=\"litho.gap\"/>", 373,
         "no earlier step"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, SILICON, bad[i].from, bad[i].to, &diags));
        const fw_diag *d = said_of(bad[i].number, bad[i].says);
        if (!d) fail_msg("case %zu: no FW-D%03d with '%s'", i, bad[i].number, bad[i].says);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(fillings_are_mixed, setup, teardown),
        cmocka_unit_test_setup_teardown(amounts, setup, teardown),
        cmocka_unit_test_setup_teardown(metals, setup, teardown),
        cmocka_unit_test_setup_teardown(loads_and_fillings, setup, teardown),
        cmocka_unit_test_setup_teardown(weighed, setup, teardown),
        cmocka_unit_test_setup_teardown(prices, setup, teardown),
        cmocka_unit_test_setup_teardown(bad_prices, setup, teardown),
        cmocka_unit_test_setup_teardown(bad_packs, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
