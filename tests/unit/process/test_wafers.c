/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lots of several wafers, read at several sites: made up from a known truth with known scatter from site to site and from
   wafer to wafer and an instrument that is off by the same amount everywhere; what is stated for the next wafer holds for
   it in the cases that two standard uncertainties promise. */
#include "packs.h"
#include "process/calibrate.h"
#include "process/coupon.h"
#include "process/process_law.h"

static fw_arena *arena;
static fw_diags diags;
static fw_process_flow *silicon;

static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    if (!arena) return -1;
    diags = fw_diags_new(arena);
    silicon = read_pack(arena, SILICON, NULL, NULL, &diags);
    return silicon ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static uint64_t seed = 77;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return ((double)(seed >> 11) + 0.5) / 9007199254740992.0;
}
static double normal(void) {
    return sqrt(-2.0 * log(uniform())) * cos(2.0 * acos(-1.0) * uniform());
}

enum { SITES = 5, MOST = 80 };
static fw_process_reading item[MOST];
static fw_process_readings readings;
static const char *const name[] = {"1", "2", "3", "4", "5", "6"};

static fw_process_reading *put(const char *coupon, const char *feature, const char *wafer,
                               double truth, double spread, int sites, double u) {
    fw_process_reading *r = &item[readings.n++];
    double x[SITES], mean = 0.0;
    *r = (fw_process_reading){.row = {.coupon = coupon,
                                      .feature = feature,
                                      .drawn_m = (double)NAN,
                                      .uncertainty = u,
                                      .at = (double)NAN,
                                      .at_uncertainty = (double)NAN,
                                      .dimension = FW_DIM_LENGTH},
                              .wafer = wafer,
                              .step = "S18",
                              .date = "2026-11-20",
                              .nsite = sites};
    for (int i = 0; i < sites; i++)
        mean += (x[i] = truth + spread * normal()) / sites;
    for (int i = 0; i < sites; i++)
        r->squares += (x[i] - mean) * (x[i] - mean);
    r->row.value = mean;
    return r;
}

/* depth over time of `wafers`, the rate R of every wafer 1 + scatter off */
static void lot_of(int wafers, double R, double scatter, double spread, double u) {
    readings = (fw_process_readings){.item = item, .file = "lot.log", .sha256 = "0123456789abcdef"};
    double off = u * normal(); /* of the instrument, in all readings */
    for (int w = 0; w < wafers; w++) {
        double of_wafer = R * (1.0 + scatter * normal());
        fw_process_reading *r =
            put("etch-rate", "pan.R", name[w], of_wafer * 1000.0 + off, spread, SITES, u);
        r->row.at = 1000.0, r->row.at_uncertainty = 0.0;
        r->row.at_dimension = (fw_quantity_dimension)FW_DIM_TIME;
    }
}

/* share of lots whose next wafer lies within two stated uncertainties */
static double covered(int wafers, double scatter, double spread, double u) {
    int cases = test_cases(4000, 600), inside = 0;
    for (int i = 0; i < cases; i++) {
        fw_process_calibration c;
        fw_mark mark = fw_arena_mark(arena);
        fw_diags said = fw_diags_new(arena);
        double R = 9e-10;
        lot_of(wafers, R, scatter, spread, u);
        assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &said, &c), FW_OK);
        double next = R * (1.0 + scatter * normal());
        inside += fabs(next - c.item[0].value) <= 2.0 * c.item[0].uncertainty;
        fw_arena_rewind(arena, mark);
    }
    return (double)inside / cases;
}

static void coverage(void **state) {
    (void)state;
    static const struct {
        int wafers;
        double scatter, spread, u, least;
    } of[] = {
        {6, 0.03, 0.02e-6, 0.0, 0.935},     /* wafers differ */
        {6, 0.0, 0.03e-6, 0.0, 0.935},      /* sites differ */
        {3, 0.03, 0.02e-6, 0.0, 0.935},     /* few wafers */
        {2, 0.03, 0.02e-6, 0.0, 0.935},     /* two: where they came out alike, no scatter is seen */
        {6, 0.0, 0.005e-6, 0.02e-6, 0.935}, /* an instrument that is off everywhere */
        {1, 0.0, 0.03e-6, 0.0, 0.935},      /* one wafer, five sites: four degrees of freedom */
        {6, 0.01, 0.02e-6, 0.01e-6, 0.935}, /* everything at once */
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        double share = covered(of[i].wafers, of[i].scatter, of[i].spread, of[i].u);
        /* shares of 95 % scatter by 0.35 % in 4000 cases, by 0.9 % in 600 */
        print_message("%d wafers, scatter %g: %.3f\n", of[i].wafers, of[i].scatter, share);
        if (!(share >= of[i].least - (test_cases(0, 1) ? 0.02 : 0.0)))
            fail_msg("case %d: %.4f", (int)i, share);
        /* not wide beyond reason: a scatter that is there is met */
        if (of[i].wafers == 6 && of[i].scatter > 0.02 && share > 0.98)
            fail_msg("case %d: %.4f", (int)i, share);
    }
}

/* rate and lag of slots: correlated by every wafer's fit, and less so where wafers differ */
static void slots(void **state) {
    (void)state;
    static const double width[] = {4e-6, 7e-6, 12e-6, 30e-6, 100e-6};
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    measured(f, "made.al-edge", 0.0, 0.0); /* else all wafers share what it may be off by */
    for (int differ = 0; differ < 2; differ++) {
        readings = (fw_process_readings){
            .item = item, .file = "lot.log", .sha256 = "0123456789abcdef", .lot = "L7"};
        for (int w = 0; w < 6; w++) {
            double R = 0.55e-6 / 60.0 * (1.0 + (differ ? 0.02 : 0.0) * normal());
            for (int k = 0; k < 5; k++) {
                double low = 0.0, high = R * 5400.0;
                for (int i = 0; i < 80; i++) {
                    double d = 0.5 * (low + high);
                    bool less = d + 0.1 * fw_process_arde_integral(width[k], d, false) < R * 5400.0;
                    *(less ? &low : &high) = d;
                }
                fw_process_reading *r = put("arde-slots", "", name[w], low, 0.3e-6, SITES, 0.0);
                r->row.drawn_m = width[k] - 2.2e-6; /* as the aluminium opens it */
                r->row.at = 5400.0, r->row.at_uncertainty = 0.0;
                r->row.at_dimension = (fw_quantity_dimension)FW_DIM_TIME;
            }
        }
        fw_process_calibration c;
        fw_text pack = fw_text_new(arena);
        assert_int_equal(fw_process_calibrate_wafers(arena, f, &readings, &diags, &c), FW_OK);
        assert_int_equal(c.count, 2);
        assert_relative(c.item[0].value, 0.55e-6 / 60.0, differ ? 0.04 : 0.005);
        assert_near(c.item[1].value, 0.1, 4.0 * c.item[1].uncertainty);
        assert_int_equal(c.njoint, 2);
        double r = c.correlation[1];
        if (differ ? !(r < 0.5) : !(r > 0.4)) fail_msg("differ %d: %g", differ, r);
        assert_non_null(strstr(c.item[0].source, "of wafers 1, 2, 3, 4, 5, 6: n = 150 readings"));
        assert_non_null(strstr(c.item[0].source, "120 degrees of freedom"));
        assert_non_null(strstr(c.item[0].source, "lot L7"));
        /* and the pack is taken, with wafers and day as its source */
        assert_int_equal(
            fw_process_calibration_pack(f, &c, "lot.log", "0123456789abcdef", &pack), FW_OK);
        fw_process_flow *after = read_pack(arena, SILICON, NULL, NULL, &diags);
        assert_int_equal(
            fw_process_lab_apply(arena, "lab.xml", pack.data, pack.length, after, &diags), FW_OK);
        const fw_quantity *R = fw_process_flow_quantity(after, "rie.R");
        assert_int_equal(R->status, FW_MEASURED);
        assert_non_null(strstr(R->source, "wafers 1, 2, 3"));
        assert_near(fw_quantity_correlation(R, fw_process_flow_quantity(after, "rie.S")), r, 1e-5);
    }
}

/* One wafer of several whose rate is twice that of the others is named, with what is found without it; wafers that differ are not, but for one in a
   hundred, and of two nobody knows which one it is. */
static void one_that_is_odd(void **state) {
    (void)state;
    static const struct {
        int wafers, odd; /* -1: none */
        double scatter;
    } of[] = {{4, 2, 0.005}, {3, 1, 0.0}, {4, -1, 0.03}, {2, 1, 0.0}, {6, 5, 0.02}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        int cases = test_cases(200, 60), told = 0;
        for (int k = 0; k < cases; k++) {
            fw_process_calibration c;
            fw_mark mark = fw_arena_mark(arena);
            fw_diags said = fw_diags_new(arena);
            lot_of(of[i].wafers, 9e-10, of[i].scatter, 0.01e-6, 0.0);
            if (of[i].odd >= 0) item[of[i].odd].row.value *= 2.0;
            assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &said, &c), FW_OK);
            for (size_t d = 0; d < said.count; d++)
                if (said.item[d].number == 692) {
                    const char *named = fw_arena_printf(arena, "--without %s", of[i].odd >= 0 ? name[of[i].odd] : "");
                    told++;
                    assert_non_null(strstr(said.item[d].message, named));
                    assert_non_null(strstr(said.item[d].message, "reads pan.R as "));
                    assert_non_null(strstr(said.item[d].message, "; without it "));
                }
            fw_arena_rewind(arena, mark);
        }
        print_message("%d wafers, odd %d: told %d of %d\n", of[i].wafers, of[i].odd, told, cases);
        const bool can = of[i].odd >= 0 && of[i].wafers > 2;
        if (can ? told < 0.95 * cases : told > 0.1 * cases) fail_msg("case %zu: told %d of %d", i, told, cases);
    }
}

/* readings of one slot that stand at two steps of a wafer are one: nothing is known better by them; those of another wafer
   are others */
static void copies_count_once(void **state) {
    (void)state;
    static const double width[] = {10e-6, 30e-6, 100e-6}, depth[] = {45.6e-6, 46.9e-6, 47.9e-6};
    fw_process_calibration c[2];
    for (int twice = 0; twice < 2; twice++) {
        fw_diags said = fw_diags_new(arena);
        seed = 5;
        readings = (fw_process_readings){.item = item, .file = "lot.log", .sha256 = ""};
        for (int k = 0; k < 3; k++) {
            fw_process_reading *r = put("arde-slots", "", "1", depth[k], 0.1e-6, SITES, 0.1e-6);
            r->row.drawn_m = width[k];
            r->row.at = 960.0, r->row.at_uncertainty = 0.0;
            r->row.at_dimension = (fw_quantity_dimension)FW_DIM_TIME;
            r->row.place.line = k + 2;
        }
        if (twice) {
            item[readings.n] = item[0];
            item[readings.n].row.place.line = 9;
            item[readings.n++].step = "S19";
        }
        assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &said, &c[twice]), FW_OK);
        assert_int_equal(said.count, twice);
        if (!twice) continue;
        assert_int_equal(said.item[0].number, 662);
        assert_int_equal(said.item[0].place.line, 9);
        assert_non_null(strstr(said.item[0].message, "line 2 has of step S18"));
    }
    for (int i = 0; i < 2; i++) {
        assert_near(c[1].item[i].value, c[0].item[i].value, 0);
        assert_near(c[1].item[i].uncertainty, c[0].item[i].uncertainty, 0);
        assert_string_equal(c[1].item[i].source, c[0].item[i].source);
    }
}

static void refused(void **state) {
    (void)state;
    fw_process_calibration c;
    fw_diags said = fw_diags_new(arena);
    readings = (fw_process_readings){.item = item, .file = "lot.log", .sha256 = ""};
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &said, &c), FW_INPUT);
    assert_int_equal(said.item[0].number, 211); /* nothing was read */
    lot_of(3, 9e-10, 0.0, 0.0, 0.0);
    said = fw_diags_new(arena);
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &said, &c), FW_INPUT);
    assert_non_null(strstr(said.item[0].message, "read the same"));
    lot_of(3, 9e-6, 0.0, 1e-6, 0.0); /* 9 um/s */
    said = fw_diags_new(arena);
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &said, &c), FW_INPUT);
    assert_int_equal(said.item[0].number, 278);
    assert_non_null(strstr(said.item[0].message, "wafer 1: "));
}

/* An edge may lie at 0, where no share of it says by how much wafers differ; one that is 0 but for rounding is written so; and how
   results go together is said once, with all that they share */
static void edges_about_nothing(void **state) {
    (void)state;
    static const double off_um[3] = {-0.03, 0.0, 0.03};
    fw_process_calibration c;
    fw_text pack = fw_text_new(arena);
    readings = (fw_process_readings){.item = item, .file = "lot.log", .sha256 = "0123456789abcdef"};
    for (int w = 0; w < 3; w++) {
        fw_process_reading *r = put("cd-lines", "line", name[w], (10.0 - 2.2 + 2.0 * off_um[w]) * 1e-6, 0.0, 1, 0.01e-6);
        r->row.drawn_m = 10e-6;
    }
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &diags, &c), FW_OK);
    assert_int_equal(c.count, 1);
    assert_true(fabs(c.item[0].value) < 1e-15);
    assert_non_null(strstr(c.item[0].note, "mean of 3 wafers, which differ by 0.03 um (standard"));
    assert_int_equal(fw_process_calibration_pack(silicon, &c, "lot.log", "0123456789abcdef", &pack), FW_OK);
    assert_non_null(strstr(pack.data, "<q id=\"made.al-edge\" value=\"0\" "));
    lot_of(3, 1e-9, 0.05, 1e-9, 1e-9);
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &diags, &c), FW_OK);
    assert_non_null(strstr(c.item[0].note, " % (standard"));
    assert_null(strstr(c.item[0].note, "correlation"));
}

static const fw_process_calibrated *found(const fw_process_calibration *c, const char *id) {
    for (int i = 0; i < c->count; i++)
        if (strcmp(c->item[i].id, id) == 0) return &c->item[i];
    fail_msg("no %s", id);
    return NULL;
}

/* the pack of a calibration, in a flow: what is asked after its values */
static int spreads_told(const fw_process_calibration *c, const char **message) {
    fw_text pack = fw_text_new(arena);
    fw_diags said = fw_diags_new(arena);
    int told = 0;
    assert_int_equal(fw_process_calibration_pack(silicon, c, "lot.log", "0123456789abcdef", &pack), FW_OK);
    fw_process_flow *after = read_pack(arena, SILICON, NULL, NULL, &diags);
    assert_int_equal(fw_process_lab_apply(arena, "lab.xml", pack.data, pack.length, after, &said), FW_OK);
    assert_int_equal(fw_process_lab_ask(arena, after, &said), FW_OK);
    for (size_t i = 0; i < said.count; i++)
        if (said.item[i].number == 734) told++, *message = said.item[i].message;
    for (int i = 0; i < c->count; i++) {
        const fw_quantity *q = fw_process_flow_quantity(after, c->item[i].id);
        assert_true(q->spread_taken == c->item[i].spread_taken);
        assert_relative(q->uncertainty, c->item[i].uncertainty, 1e-3);
        if (q->spread_taken) assert_near(q->spread, c->item[i].spread, 1e-3 * q->uncertainty);
    }
    return told;
}

/* One wafer does not say how the next one differs, and a table has no wafers: the flow's own uncertainty stays as that, a rate's in
   proportion, an edge's with that of the printed edge that is within it. Where wafers differ by what the flow says, the next one is
   met. Three wafers say it themselves. */
static void one_wafer_keeps_the_spread(void **state) {
    (void)state;
    const double rel = fw_process_flow_quantity(silicon, "pan.R")->uncertainty /
                       fw_process_flow_quantity(silicon, "pan.R")->value;
    fw_process_calibration c, table;
    const char *message = "";
    lot_of(1, 5e-10, 0.0, 0.01e-6, 0.0);
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &diags, &c), FW_OK);
    const fw_process_calibrated *R = found(&c, "pan.R");
    assert_true(R->spread_taken);
    assert_relative(R->spread, rel * R->value, 1e-9); /* of half the rate, half of it */
    assert_true(R->uncertainty > R->spread && R->uncertainty < 1.2 * R->spread);
    assert_non_null(strstr(R->note, "of one wafer: how the next one differs is taken to be what the flow had for it"));
    assert_int_equal(spreads_told(&c, &message), 1);
    assert_non_null(strstr(message, "how wafers differ in pan.R (taken to be +- 0."));
    lot_of(3, 5e-10, 0.0, 0.01e-6, 0.0);
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &diags, &c), FW_OK);
    assert_false(found(&c, "pan.R")->spread_taken);
    assert_true(found(&c, "pan.R")->uncertainty < 0.5 * rel * 5e-10);
    assert_int_equal(spreads_told(&c, &message), 0);
    /* edges, of a wafer and of a table */
    const double edge = hypot(fw_process_flow_quantity(silicon, "made.al-edge")->uncertainty,
                              fw_process_flow_quantity(silicon, "litho.edge")->uncertainty);
    readings = (fw_process_readings){.item = item, .file = "lot.log", .sha256 = "0123456789abcdef"};
    fw_process_reading *r = put("cd-lines", "line", "1", 7.8e-6, 0.02e-6, SITES, 0.01e-6);
    r->row.drawn_m = 10e-6;
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &diags, &c), FW_OK);
    assert_near(found(&c, "made.al-edge")->spread, edge, 1e-12);
    assert_true(found(&c, "made.al-edge")->uncertainty > edge);
    assert_int_equal(fw_process_calibrate(arena, silicon, &r->row, 1, &diags, &table), FW_OK);
    const double read = table.item[0].uncertainty;
    assert_int_equal(fw_process_calibration_correlate(arena, silicon, &r->row, 1, &table), FW_OK);
    assert_int_equal(fw_process_calibration_keep_spread(arena, silicon, &table), FW_OK);
    assert_near(table.item[0].spread, edge, 1e-12);
    assert_near(table.item[0].uncertainty, hypot(read, edge), 1e-12);
    assert_non_null(strstr(table.item[0].note, "a table has no wafers"));
    assert_int_equal(spreads_told(&table, &message), 1);
    /* a mistaken row is told by what was read, however wide the spread is */
    fw_diags said = fw_diags_new(arena);
    r->row.value = 11e-6;
    assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &diags, &c), FW_OK);
    fw_process_calibration_ask(silicon, &c, "lot.log", &said);
    assert_true(said.count > 0);
    assert_int_equal(said.item[0].number, 643);
}

/* ... and the next wafer lies within two of them as often, as long as no more than half of what the flow has (in squares) is from
   wafer to wafer */
static void the_next_after_one(void **state) {
    (void)state;
    const double rel = fw_process_flow_quantity(silicon, "pan.R")->uncertainty /
                       fw_process_flow_quantity(silicon, "pan.R")->value;
    const double share = covered(1, rel / sqrt(2.0), 0.02e-6, 0.0);
    print_message("one wafer, scatter %g: %.3f\n", rel / sqrt(2.0), share);
    if (!(share >= 0.935 - (test_cases(0, 1) ? 0.02 : 0.0))) fail_msg("%.4f", share);
}

/* A pack that calibrate wrote before `spread` was has what was read alone: the flow's own is added, and told, as in those of now; a
   laboratory that writes its own value, and a mean of several wafers, are left as they are */
static void packs_of_before(void **state) {
    (void)state;
    static const char head[] = "<process xmlns=\"urn:flexwright:process:1\" id=\"lab\" version=\"1\" title=\"L\" flow=\"al-masked-rie\">"
                               "<source id=\"coupons\" kind=\"measured\">measured</source><q id=\"pan.R\" value=\"0.5\" u=\"0.005\" unit=\"nm/s\" status=\"measured\" src=\"coupons\" note=\"";
    static const struct {
        const char *note;
        bool taken;
    } of[] = {{"etch-rate: slope of 3 times; chi square 1.2, 2 degrees of freedom, probability 0.5", true},
              {"etch-rate: one time; no residual to test", true},
              {"etch-rate: slope; mean of 3 wafers, which differ by 1 % (standard, 2 degrees of freedom); the next wafer is meant; chi square 1.2, 2 degrees of freedom, probability 0.5", false},
              {"from our book of last year", false}};
    const fw_quantity *own = fw_process_flow_quantity(silicon, "pan.R");
    const double rel = own->uncertainty / own->value;
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        int told = 0;
        fw_diags said = fw_diags_new(arena);
        const char *pack = fw_arena_printf(arena, "%s%s\"/></process>", head, of[i].note);
        fw_process_flow *after = read_pack(arena, SILICON, NULL, NULL, &diags);
        assert_int_equal(fw_process_lab_apply(arena, "lab.xml", pack, strlen(pack), after, &said), FW_OK);
        assert_int_equal(fw_process_lab_ask(arena, after, &said), FW_OK);
        for (size_t k = 0; k < said.count; k++)
            if (said.item[k].number == 734) told++;
        const fw_quantity *q = fw_process_flow_quantity(after, "pan.R");
        assert_int_equal(told, of[i].taken);
        assert_true(q->spread_taken == of[i].taken);
        assert_relative(q->uncertainty, of[i].taken ? hypot(5e-12, rel * 5e-10) : 5e-12, 1e-6);
        assert_relative(fw_process_lab_read_part(q), of[i].taken ? 5e-12 / q->uncertainty : 1.0, 1e-9);
    }
}

/* Slots and the ladder of a wafer that was etched longer begin at the edge that its own lines tell, which is no result of the lot:
   A is that of the truth, and made.al-edge that of the others. Without any lines what begins at that edge does not count. */
static void the_edge_of_its_wafer(void **state) {
    (void)state;
    static const double A = 0.9915, depth = 49e-6, edge[] = {-1.1e-6, -1.6e-6, -1.1e-6}, drawn[] = {10e-6, 14e-6, 20e-6};
    for (int lines = 0; lines < 2; lines++) {
        fw_diags said = fw_diags_new(arena);
        fw_process_calibration c;
        readings = (fw_process_readings){.item = item, .file = "lot.log", .sha256 = ""};
        for (int w = 0; w < 3; w++) {
            for (int k = 0; k < 3 && (w != 1 || lines); k++) {
                fw_process_reading *r = put("cd-lines", "line", name[w], drawn[k] + 2.0 * edge[w], 5e-9, SITES, 20e-9);
                r->row.drawn_m = drawn[k], r->row.of = "made.al-edge", r->row.of_wafer = w == 1;
            }
            for (int k = 0; k < 3; k++) {
                const double width = drawn[k] + 2.0 * edge[w] - 2.0 * (1.0 - A) * depth;
                fw_process_reading *r = put("undercut-ladder", "width", name[w], width, 5e-9, SITES, 20e-9);
                r->row.drawn_m = drawn[k], r->row.at = depth, r->row.at_uncertainty = 0.2e-6;
                r->row.at_dimension = (fw_quantity_dimension)FW_DIM_LENGTH;
                r->edge_off = w == 1 ? "S14 (line 3, 2026-11-03T10:00) was long" : NULL;
            }
        }
        fw_process_readings_of_edges(silicon, &readings, &said);
        assert_int_equal(readings.n, lines ? 18 : 12);
        assert_int_equal(said.count, lines ? 0 : 1);
        if (!lines) assert_non_null(strstr(said.item[0].message, "3 readings of undercut-ladder at step S18 of wafer 2 do not count"));
        assert_int_equal(fw_process_calibrate_wafers(arena, silicon, &readings, &said, &c), FW_OK);
        assert_int_equal(c.count, 2);
        for (int i = 0; i < 2; i++) {
            const bool of_A = strcmp(c.item[i].id, "rie.A") == 0;
            const double u = fmax(c.item[i].uncertainty, of_A ? 3e-4 : 0.03e-6);
            assert_near(c.item[i].value, of_A ? A : 0.0, 2.0 * u);
            assert_true(c.item[i].uncertainty < (of_A ? 2e-3 : 0.1e-6));
            assert_non_null(strstr(c.item[i].source, of_A && lines ? "wafers 1, 2, 3" : "wafers 1, 3"));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(coverage), cmocka_unit_test(slots),
                                       cmocka_unit_test(copies_count_once), cmocka_unit_test(one_that_is_odd),
        cmocka_unit_test(edges_about_nothing),
                                       cmocka_unit_test(refused),
                                       cmocka_unit_test(one_wafer_keeps_the_spread),
                                       cmocka_unit_test(packs_of_before), cmocka_unit_test(the_edge_of_its_wafer),
                                       cmocka_unit_test(the_next_after_one)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
