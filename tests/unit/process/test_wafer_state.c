/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a wafer is like between steps, what is said where a pack forgets it, and that a laboratory's values meet the checks
   of the pack's own. */
#include "pack_fixture.h"
#include "process/calibrate.h"
#include "process/pack.h"

static const fw_process_wait *wait_of(const fw_process_flow *f, const char *from, const char *to) {
    for (int i = 0; i < f->nwait; i++)
        if (strcmp(f->step[f->wait[i].from].id, from) == 0 &&
            strcmp(f->step[f->wait[i].to].id, to) == 0)
            return &f->wait[i];
    return NULL;
}

static const fw_diag *said(int number) {
    for (size_t k = 0; k < diags.count; k++)
        if (diags.item[k].number == number) return &diags.item[k];
    return NULL;
}

static void a_bath_leaves_wafers_wet_until_it_is_finished(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    fw_process_wafer *after;
    assert_non_null(f);
    assert_int_equal(fw_process_flow_wafers(arena, f, &after), FW_OK);
    for (int i = 0; i < f->nstep; i++) {
        const char *id = f->step[i].id;
        bool wet = strcmp(id, "S20") == 0 || strcmp(id, "S21") == 0;
        assert_int_equal(after[i].is[FW_STATE_WET], wet);
        if (wet) assert_string_equal(after[i].with[FW_STATE_WET], "water");
        assert_int_equal(after[i].released, strcmp(id, "S20") >= 0);
        assert_false(after[i].is[FW_STATE_VACUUM] || after[i].is[FW_STATE_HOT]);
    }
    assert_near(wait_of(f, "S20", "S21")->max_s, 4 * 3600.0, 1e-9);
    assert_near(wait_of(f, "S07", "S08")->max_s, 1800, 1e-9);  /* resist without its bake */
    assert_near(wait_of(f, "S08", "S09")->max_s, 86400, 1e-9); /* and before it is exposed */
    assert_near(wait_of(f, "S09", "S11")->max_s, 28800, 1e-9); /* over the bake between */
    assert_true(wait_of(f, "S17", "S18")->first_only);
    assert_null(wait_of(f, "S14", "S15"));
    /* without its finish the acid stays, for as long as base.xml says */
    size_t n = 0, nb = 0;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, SILICON, &n);
    text = replaced(arena, text,
                    "    <finish kind=\"rinse\" q=\"al-rinse.t\"/>\n    <finish "
                    "kind=\"dry\" by=\"spin\"/>\n",
                    "", &n);
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", text, n, &diags, &f),
        FW_INPUT);
    assert_non_null(said(335));
    assert_non_null(strstr(said(335)->message, "phosphoric and nitric acid since step S14"));
}

static void mistakes(void **state) {
    (void)state;
    static const struct {
        const char *flow, *from, *to;
        int number;
        const char *says;
    } bad[] = {
        {SILICON, "    <finish kind=\"rinse\" q=\"demount.t-rinse\"/>\n", "", 336,
         "'h.solvent' (since step S20) into 'h.pan'"},
        {COPPER, "    <finish kind=\"rinse\" q=\"strip.t-rinse\"/>\n", "", 336,
         "(since step C24) into 'h.oxidiser'"},
        {SILICON, "    <finish kind=\"rinse\" q=\"al-rinse.t\"/>\n", "", 347, "'h.pan'"},
        {SILICON, "<finish kind=\"dry\" by=\"critical-point\"/>",
         "<finish kind=\"dry\" by=\"nitrogen\"/>", 337, "meniscus"},
        {SILICON, "<finish kind=\"dry\" by=\"critical-point\"/>",
         "<finish kind=\"dry\" by=\"air\"/>", 337, "say from what they dry"},
        {SILICON, "<finish kind=\"dry\" by=\"critical-point\"/>",
         "<finish kind=\"dry\" by=\"air\" tension=\"pan.T\"/>", 343, "no surface tension"},
        {SILICON, "<finish kind=\"dry\" by=\"critical-point\"/>",
         "<finish kind=\"dry\" by=\"air\" tension=\"water.tension\" angle=\"water.tension\"/>", 343,
         "no angle"},
        {SILICON, "<finish kind=\"vent\"/>", "<finish kind=\"vent\" tension=\"water.tension\"/>",
         343, "of a meniscus"},
        {COPPER, "<change kind=\"remove\" material=\"resist\" where=\"structure\"/>", "", 340,
         "plates 'copper-plated' on 'resist'"},
        {SILICON, "<finished material=\"carrier\" is=\"absent\"/>",
         "<finished material=\"carrier\" is=\"present\"/>", 338, "without 'carrier'"},
        {SILICON, "<requires step=\"S17\"/>", "<requires step=\"S19\"/>", 345, "comes later"},
        {SILICON, "<requires state=\"image\"/>", "<requires state=\"image\" is=\"absent\"/>", 345,
         "not 'image'"},
        {SILICON, "<requires state=\"image\"/>", "<requires/>", 345, "names one thing"},
        {SILICON, "<finish kind=\"vent\"/>", "<finish kind=\"vent\" by=\"spin\"/>", 343, "by is"},
        {SILICON, "<finish kind=\"dry\" by=\"spin\"/>", "<finish kind=\"dry\"/>", 343, "needs by"},
        {SILICON, "<finish kind=\"rinse\"/>", "<finish kind=\"rinse\" with=\"h.uv\"/>", 343,
         "no liquid"},
        {SILICON, "tol-lo=\"98\" tol-hi=\"102\"", "tol-lo=\"102\" tol-hi=\"98\"", 342, "exchange"},
        {SILICON, "tol-lo=\"98\" tol-hi=\"102\"", "tol-lo=\"30\" tol-hi=\"40\"", 342, "allows"},
        {SILICON, "lo=\"60\" hi=\"75\" unit=\"deg\"", "lo=\"75\" hi=\"60\" unit=\"deg\"", 342,
         "above"},
        {COPPER, "<q id=\"cu.eta\" value=\"0.97\"", "<q id=\"cu.eta\" value=\"97\"", 278,
         "no bath deposits more"},
        {COPPER, "<q id=\"ps.d\" unknown=\"true\"", "<q id=\"ps.d\" value=\"600\" u=\"1\"", 344,
         "only 525 um"},
        {SILICON, "range=\"share\"/>", "range=\"stress\"/>", 169, "another dimension"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, bad[i].flow, bad[i].from, bad[i].to, &diags));
        const fw_diag *d = said(bad[i].number);
        if (!d || !strstr(d->message, bad[i].says))
            fail_msg("%d '%s': '%s'", bad[i].number, bad[i].says,
                     d ? d->message : diags.item[0].message);
        assert_true(d->place.line > 0 && d->place.column > 0);
        assert_string_equal(d->place.file, "flow.xml");
    }
}

/* how each flow dries what it has set free, and what a meniscus is of */
static void dries(void **state) {
    (void)state;
    static const char calm[] = "<finish kind=\"dry\" by=\"critical-point\"/>";
    static const struct {
        const char *flow, *to, *step;
        fw_mechanism_dried how;
        const char *tension; /* id; NULL: none */
    } as[] = {
        {SILICON, calm, "S22", FW_DRIED_CALM, NULL},
        {COPPER, calm, "C27", FW_DRIED_CALM, NULL},
        {SILICON, "<finish kind=\"dry\" by=\"sublimation\"/>", "S22", FW_DRIED_CALM, NULL},
        {SILICON, "<finish kind=\"dry\" by=\"air\" tension=\"water.tension\"/>", "S22",
         FW_DRIED_PULLED, "water.tension"},
        {SILICON, "<finish kind=\"dry\" by=\"vapour\"/>", "S22", FW_DRIED_PULLED,
         "isopropanol.tension"},
        {SILICON,
         "<finish kind=\"dry\" by=\"oven\" tension=\"isopropanol.tension\"/><finish "
         "kind=\"rinse\"/>"
         "<finish kind=\"dry\" by=\"oven\" tension=\"water.tension\"/>",
         "S22", FW_DRIED_PULLED, "water.tension"},
    };
    for (size_t i = 0; i < sizeof as / sizeof as[0]; i++) {
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, as[i].flow, calm, as[i].to, &diags);
        assert_non_null(f);
        const fw_process_drying d = fw_process_flow_drying(f);
        assert_int_equal(d.how, as[i].how);
        if (as[i].tension) assert_string_equal(d.tension->id, as[i].tension);
        if (!as[i].tension) assert_null(d.tension);
        assert_string_equal(d.step->id, as[i].step);
        if (as[i].how == FW_DRIED_PULLED) assert_string_equal(d.angle->id, "dry.angle");
    }
}

/* --lab is no door around the checks: id, value, unit */
static void a_laboratory_meets_the_same_checks(void **state) {
    (void)state;
    static const struct {
        const char *flow, *id, *value, *unit;
        int number; /* 0: fine */
    } lab[] = {
        {COPPER, "cu.eta", "97", "1", 278},
        {COPPER, "cu.eta", "97", "%", 0},
        {COPPER, "ps.P", "0", "1", 278},
        {SILICON, "rie.A", "1.5", "1", 278},
        {SILICON, "rie.A", "0.97", "1", 0},
        {SILICON, "rie.selectivity", "-3", "1", 278},
        {SILICON, "pan.R", "-10", "Ao/s", 278},
        {SILICON, "pan.R", "10000", "Ao/s", 278},
        {SILICON, "hard.T", "131", "Cel", 271},
        {SILICON, "si.d", "60", "um", 0},
        {SILICON, "bake.T", "108", "Cel", 342},
        {COPPER, "ps.d", "526", "um", 344},
        {SILICON, "al.d", "-1", "um", 278},
        {COPPER, "ps.J", "20", "mA/cm2", 0},
        {COPPER, "develop.R-porous", "-1", "um/min", 278},
    };
    for (size_t i = 0; i < sizeof lab / sizeof lab[0]; i++) {
        fw_diags quiet = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, lab[i].flow, NULL, NULL, &quiet);
        const char *xml = fw_arena_printf(
            arena,
            "<process xmlns=\"urn:flexwright:process:1\" id=\"lab\" flow=\"%s\"><source id=\"s\" "
            "kind=\"measured\">log</source>\n<q id=\"%s\" value=\"%s\" u=\"0\" unit=\"%s\" "
            "status=\"measured\" src=\"s\"/></process>",
            lab[i].flow, lab[i].id, lab[i].value, lab[i].unit);
        diags = fw_diags_new(arena);
        fw_status status = fw_process_lab_apply(arena, "lab.xml", xml, strlen(xml), f, &diags);
        if (status != (lab[i].number ? FW_INPUT : FW_OK))
            fail_msg("%s = %s %s: status %d", lab[i].id, lab[i].value, lab[i].unit, status);
        if (!lab[i].number) continue;
        if (!said(lab[i].number)) fail_msg("%s: %s", lab[i].id, diags.item[0].message);
        if (lab[i].number == 271) continue; /* said at the step that is too hot */
        assert_string_equal(said(lab[i].number)->place.file, "lab.xml");
        assert_int_equal(said(lab[i].number)->place.line, 2);
    }
}

/* From the step on that makes what a coupon reads, until the one that takes it away; of a flow that does not make it, and of what
   is read on any wafer, whenever */
static void where_coupons_are_read(void **state) {
    (void)state;
    static const struct {
        const char *flow, *coupon, *feature, *where; /* NULL: at any step */
    } of[] = {
        {SILICON, "cd-lines", "line", "the printed edge (litho.edge) from S11 to S13, the edge of the aluminium (made.al-edge) from S14 to S20"},
        {SILICON, "arde-slots", "", "from S18 to S23"},
        {SILICON, "undercut-ladder", "width", "from S18 to S23"},
        {SILICON, "al-step", "", "from S18 to S20"},
        {SILICON, "etch-rate", "pan.R", NULL},
        {SILICON, "spin", "", NULL},
        {SILICON, "release-holes", "free", NULL},
        {COPPER, "cd-lines", "space", "the printed edge (litho.edge) from C18 to C23"},
        {COPPER, "plating-pads", "", "from C22 to C28"},
        {COPPER, "release-holes", "held", "from C26 to C28"},
        {COPPER, "plating-mass", "", NULL},
        {"soi-deep-rie", "cd-lines", "line", "the printed edge (litho.edge) from D07 to D09"},
        {"soi-deep-rie", "arde-slots", "", "from D09 to D13"},
        {"soi-double-sided", "cd-lines", "line", "the printed edge (litho.edge) from B07 to B09"},
        {"silicon-on-glass", "cd-lines", "line", "the printed edge (litho.edge) from G34 to G36, the edge of the aluminium (made.al-edge) from G37 to G44"},
        {"silicon-on-glass", "undercut-ladder", "width", "from G42 to G53"},
    };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const fw_process_flow *f = read_pack(arena, of[i].flow, NULL, NULL, &diags);
        const fw_process_measurement row = {.coupon = of[i].coupon, .feature = of[i].feature};
        fw_process_coupon_stage stage;
        const char *where = NULL;
        bool there;
        assert_int_equal(fw_process_coupon_stage_at(arena, f, &row, f->step, &there, &stage, &where), FW_OK);
        assert_int_equal(there, of[i].where == NULL);
        if (of[i].where && strcmp(where, of[i].where) != 0) fail_msg("%s of %s: %s", of[i].coupon, of[i].flow, where);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {TEST(a_bath_leaves_wafers_wet_until_it_is_finished),
                                       TEST(mistakes), TEST(dries),
                                       TEST(a_laboratory_meets_the_same_checks),
                                       TEST(where_coupons_are_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
