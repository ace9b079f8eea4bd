/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results of one calibration are correlated: what calibrate writes into a laboratory pack is what draws of the measured data
   say, the windows of the steps and the corners of the verdict use it, and a matrix that cannot be is refused at its
   place. */
#include "packs.h"
#include "process/calibrate.h"
#include "process/process_law.h"

static fw_arena *arena;
static fw_diags diags;

static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    if (!arena) return -1;
    diags = fw_diags_new(arena);
    return 0;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static uint64_t seed = 20261123;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return ((double)(seed >> 11) + 0.5) / 9007199254740992.0;
}
static double normal(void) {
    return sqrt(-2.0 * log(uniform())) * cos(2.0 * acos(-1.0) * uniform());
}

enum { MOST = 20, DRAWS = 4000 };
static fw_process_measurement rows[MOST];
static int nrow;

static void read_table(const char *csv) {
    fw_process_measurement *list;
    assert_int_equal(
        fw_process_measurements_read(arena, "lot.csv", csv, strlen(csv), &diags, &list, &nrow),
        FW_OK);
    assert_true(nrow <= MOST);
    memcpy(rows, list, (size_t)nrow * sizeof *rows);
}

/* slots of one run whose time is known to 20 s, a ladder by depth, lines of the aluminium */
static const char silicon_lot[] = "coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit\n"
                                  "arde-slots,,5,43.30,0.2,um,90,20,min\n"
                                  "arde-slots,,10,45.75,0.2,um,90,20,min\n"
                                  "arde-slots,,20,47.50,0.2,um,90,20,min\n"
                                  "arde-slots,,50,48.80,0.2,um,90,20,min\n"
                                  "arde-slots,,100,49.45,0.2,um,90,20,min\n"
                                  "cd-lines,line,10,7.90,0.06,um,,,\n"
                                  "cd-lines,space,10,12.06,0.06,um,,,\n"
                                  "undercut-ladder,width,16,9.86,0.08,um,50.5,0.3,um\n"
                                  "undercut-ladder,width,20,13.79,0.08,um,50.5,0.3,um\n";
static const char copper_lot[] = "coupon,measured,u,unit,at,u_at,at_unit\n"
                                 "spin,8.77,0.06,um,2000,15,rpm\n"
                                 "spin,7.16,0.05,um,3000,15,rpm\n"
                                 "spin,6.20,0.05,um,4000,15,rpm\n"
                                 "spin,5.55,0.05,um,5000,15,rpm\n";

/* slots have 20 s of 90 min, not 20 min: the table gives both in one unit */
static void seconds(double u_s) {
    for (int i = 0; i < nrow; i++)
        if (strcmp(rows[i].coupon, "arde-slots") == 0) rows[i].at_uncertainty = u_s;
}

static bool one_run(const char *coupon) {
    return strcmp(coupon, "arde-slots") == 0 || strcmp(coupon, "undercut-ladder") == 0;
}

/* the measured data once more, with errors of the size that they have */
static void draw(fw_process_measurement *drawn) {
    memcpy(drawn, rows, sizeof rows);
    for (int i = 0; i < nrow; i++) {
        bool shared = false;
        drawn[i].value += rows[i].uncertainty * normal();
        for (int k = 0; k < i && one_run(rows[i].coupon); k++)
            if (strcmp(rows[k].coupon, rows[i].coupon) == 0) {
                drawn[i].at = drawn[k].at;
                shared = true;
                break;
            }
        if (!shared && rows[i].at_uncertainty > 0.0)
            drawn[i].at += rows[i].at_uncertainty * normal();
    }
}

static double correlation_of(const fw_process_calibration *c, const char *a, const char *b) {
    int i = -1, k = -1;
    for (int j = 0; j < c->njoint; j++) {
        if (strcmp(c->joint[j], a) == 0) i = j;
        if (strcmp(c->joint[j], b) == 0) k = j;
    }
    return i < 0 || k < 0 ? 0.0 : c->correlation[i * c->njoint + k];
}

/* the matrix is that of results which follow from drawn data */
static void as_drawn(const char *pack, const char *csv, double u_s) {
    fw_process_flow *flow = read_pack(arena, pack, NULL, NULL, &diags);
    fw_process_calibration c;
    read_table(csv);
    seconds(u_s);
    assert_int_equal(fw_process_calibrate(arena, flow, rows, nrow, &diags, &c), FW_OK);
    assert_int_equal(fw_process_calibration_correlate(arena, flow, rows, nrow, &c), FW_OK);
    assert_true(c.njoint >= 2);
    double sum[MOST] = {0}, squares[MOST][MOST] = {{0}};
    int n = 0;
    const int draws = test_fewest(DRAWS, DRAWS / 10);
    for (int d = 0; d < draws; d++) {
        fw_process_measurement drawn[MOST];
        fw_process_calibration is;
        fw_mark mark = fw_arena_mark(arena);
        fw_diags said = fw_diags_new(arena);
        draw(drawn);
        if (fw_process_calibrate(arena, flow, drawn, nrow, &said, &is) == FW_OK) {
            n++;
            for (int i = 0; i < c.count; i++) {
                double a = is.item[i].value - c.item[i].value;
                sum[i] += a;
                for (int k = 0; k < c.count; k++)
                    squares[i][k] += a * (is.item[k].value - c.item[k].value);
            }
        }
        fw_arena_rewind(arena, mark);
    }
    assert_true(n > draws * 19 / 20); /* the others scatter too much, as in one of a thousand */
    for (int i = 0; i < c.count; i++)
        for (int k = 0; k < i; k++) {
            double ii = squares[i][i] / n - sum[i] / n * sum[i] / n,
                   kk = squares[k][k] / n - sum[k] / n * sum[k] / n,
                   ik = squares[i][k] / n - sum[i] / n * sum[k] / n, r = ik / sqrt(ii * kk);
            double stated = correlation_of(&c, c.item[i].id, c.item[k].id);
            /* the edge of the pack, if the data do not give it, is not drawn: with its own row it is */
            if (fabs(r - stated) > 5.0 / sqrt(n) + 0.02)
                fail_msg("%s with %s: %.3f, drawn %.3f", c.item[i].id, c.item[k].id, stated, r);
        }
}

static void matrix(void **state) {
    (void)state;
    as_drawn(SILICON, silicon_lot, 20.0);
    as_drawn(SILICON, silicon_lot, 120.0);
    as_drawn(COPPER, copper_lot, 0.0);
}

/* time of the step in a flow with these values, by its law */
static fw_process_time window_of(const char *pack, const char *lab, const char *step,
                                 fw_process_flow **flow) {
    *flow = read_pack(arena, pack, NULL, NULL, &diags);
    if (lab)
        assert_int_equal(fw_process_lab_apply(arena, "lab.xml", lab, strlen(lab), *flow, &diags),
                         FW_OK);
    assert_int_equal(fw_process_flow_compute(arena, *flow, &plain_facts, &diags), FW_OK);
    return step_of(*flow, step)->time;
}

static const char *without(const char *lab) {
    const char *from = strstr(lab, "  <correlation"), *to = strstr(lab, "  </correlation>\n");
    assert_non_null(from);
    return fw_arena_printf(arena, "%.*s%s", (int)(from - lab), lab,
                           to + strlen("  </correlation>\n"));
}

static const fw_quantity *argument_of(const fw_process_step *s, const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(s->argument[i].name, name) == 0) return s->argument[i].q;
    fail_msg("%s has no %s", s->id, name);
    return NULL;
}

/* The time of the reactive ion etch: rate and lag drawn from measured slots, once more calibrated; thickness from the pack
   and the opening as it is. */
static void windows(void **state) {
    (void)state;
    fw_process_flow *silicon = read_pack(arena, SILICON, NULL, NULL, &diags), *flow;
    fw_process_calibration c;
    fw_text pack = fw_text_new(arena);
    read_table(silicon_lot);
    seconds(20.0);
    nrow = 5; /* slots alone, read so that they decide */
    for (int i = 0; i < nrow; i++)
        rows[i].uncertainty = 0.6e-6;
    assert_int_equal(fw_process_calibrate(arena, silicon, rows, nrow, &diags, &c), FW_OK);
    assert_int_equal(fw_process_calibration_correlate(arena, silicon, rows, nrow, &c), FW_OK);
    assert_int_equal(fw_process_calibration_pack(silicon, &c, "lot.csv", "0123456789abcdef", &pack),
                     FW_OK);
    fw_process_time alone = window_of(SILICON, without(pack.data), "S18", &flow);
    fw_process_time with = window_of(SILICON, pack.data, "S18", &flow);
    const fw_process_step *s = step_of(flow, "S18");
    const fw_quantity *D = argument_of(s, "depth"), *w = argument_of(s, "width");
    double sum = 0.0, squares = 0.0;
    int n = 0;
    for (int d = 0; d < DRAWS; d++) {
        fw_process_measurement drawn[MOST];
        fw_process_calibration is;
        fw_mark mark = fw_arena_mark(arena);
        fw_diags said = fw_diags_new(arena);
        draw(drawn);
        if (fw_process_calibrate(arena, silicon, drawn, nrow, &said, &is) == FW_OK) {
            double depth = D->value + D->uncertainty * normal(),
                   width = w->value + w->uncertainty * normal();
            double t = (depth + is.item[1].value * fw_process_arde_integral(width, depth, false)) /
                           is.item[0].value -
                       with.nominal_s;
            n++, sum += t, squares += t * t;
        }
        fw_arena_rewind(arena, mark);
    }
    double drawn_s = sqrt(squares / n - sum / n * sum / n);
    double stated_s = with.relative_uncertainty * with.nominal_s,
           wide_s = alone.relative_uncertainty * alone.nominal_s;
    /* a deviation of 4000 draws is off by 1.1 %; four of those and first order */
    if (fabs(stated_s / drawn_s - 1.0) > 0.06)
        fail_msg("stated %.4g s, drawn %.4g s (without correlation %.4g s)", stated_s, drawn_s,
                 wide_s);
    print_message("window of S18: %.4g s, drawn %.4g s, with independent values %.4g s\n", stated_s,
                  drawn_s, wide_s);
    assert_true(wide_s > 1.1 * drawn_s);
    assert_true(with.first_look_s > alone.first_look_s && with.stop_s < alone.stop_s);
}

/* the speed of the spinner, of the copper flow's resist */
static void speed(void **state) {
    (void)state;
    fw_process_flow *copper = read_pack(arena, COPPER, NULL, NULL, &diags), *flow;
    fw_process_calibration c;
    fw_text pack = fw_text_new(arena);
    read_table(copper_lot);
    assert_int_equal(fw_process_calibrate(arena, copper, rows, nrow, &diags, &c), FW_OK);
    assert_int_equal(fw_process_calibration_correlate(arena, copper, rows, nrow, &c), FW_OK);
    assert_int_equal(fw_process_calibration_pack(copper, &c, "lot.csv", "0123456789abcdef", &pack),
                     FW_OK);
    window_of(COPPER, pack.data, "C10", &flow);
    const fw_process_step *s = step_of(flow, "C10");
    const fw_quantity *d = argument_of(s, "thickness"), *w0 = argument_of(s, "reference_speed"),
                      *rpm = NULL;
    for (int i = 0; i < s->nderived; i++)
        if (strstr(s->derived[i]->id, "speed")) rpm = s->derived[i];
    assert_non_null(rpm);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < DRAWS; i++) {
        fw_process_measurement drawn[MOST];
        fw_process_calibration is = {0};
        fw_mark mark = fw_arena_mark(arena);
        fw_diags said = fw_diags_new(arena);
        do
            draw(drawn);
        while (fw_process_calibrate(arena, copper, drawn, nrow, &said, &is) != FW_OK);
        double wanted = d->value + 0.1 * d->uncertainty * normal(),
               reference = w0->value + w0->uncertainty * normal();
        double w = reference * pow(is.item[0].value / wanted, 1.0 / is.item[1].value) - rpm->value;
        sum += w, squares += w * w;
        fw_arena_rewind(arena, mark);
    }
    double drawn_u = sqrt(squares / DRAWS - sum / DRAWS * sum / DRAWS);
    double by_d = 0.99 * pow(rpm->value * d->uncertainty / d->value /
                                 fw_process_flow_quantity(flow, "resist.a")->value,
                             2.0);
    assert_relative(sqrt(rpm->uncertainty * rpm->uncertainty - by_d), drawn_u, 0.06);
}

/* ---- corners ---- */

static fw_verdict_fabrication_input input(const char *id, double nominal, double sigma,
                                          const fw_quantity_correlated *with, int n) {
    return (fw_verdict_fabrication_input){.name = id,
                                          .q = {.id = id, .correlated = with, .ncorrelated = n},
                                          .nominal = nominal,
                                          .sigma = sigma,
                                          .low = nominal - 2 * sigma,
                                          .high = nominal + 2 * sigma};
}

#include "process/pack.h"

/* three inputs, two of them correlated: the spread of edge and flare from independent draws of the new inputs is that of
   correlated draws of the old ones, and the nominal device is the same */
static void corners(void **state) {
    (void)state;
    static const fw_quantity_correlated of_edge[] = {{"rie.A", -0.8}},
                                        of_A[] = {{"made.al-edge", -0.8}};
    fw_verdict_fabrication_input in[3] = {input("made.al-edge", 0.1e-6, 0.05e-6, of_edge, 1),
                                          input("rie.A", 0.95, 0.01, of_A, 1),
                                          input("si.d", 50e-6, 0.5e-6, NULL, 0)};
    in[0].edge_m = 1.0, in[0].even = in[0].drawn = 0.02e-6;
    in[1].edge_m = 25e-6, in[1].flare_m = -50e-6, in[1].even = 0.94, in[1].drawn = 1.0;
    in[2].thickness = 1.0 / 50e-6, in[2].drawn = 50e-6;
    fw_verdict_fabrication_input was[3];
    memcpy(was, in, sizeof in);
    assert_int_equal(fw_process_corners_independent(arena, in, 3), FW_OK);
    double x[3] = {0.1e-6, 0.95, 50e-6};
    fw_verdict_fabrication a = fw_verdict_fabrication_at(was, 3, x),
                           b = fw_verdict_fabrication_at(in, 3, x);
    assert_near(a.edge_m, b.edge_m, 1e-20);
    assert_near(a.flare_m, b.flare_m, 1e-20);
    assert_near(a.thickness_ratio, b.thickness_ratio, 1e-12);
    double var[2][2] = {{0}}, cross[2] = {0};
    int n = test_fewest(test_cases(200000, 50000), 5000);
    for (int i = 0; i < n; i++) {
        double z[3] = {normal(), normal(), normal()};
        double old[3] = {0.1e-6 + 0.05e-6 * z[0], 0.95 + 0.01 * (-0.8 * z[0] + 0.6 * z[1]),
                         50e-6 + 0.5e-6 * z[2]};
        double new[3] = {in[0].nominal + in[0].sigma * z[0], in[1].nominal + in[1].sigma * z[1],
                         in[2].nominal + in[2].sigma * z[2]};
        fw_verdict_fabrication s[2] = {fw_verdict_fabrication_at(was, 3, old),
                                       fw_verdict_fabrication_at(in, 3, new)};
        for (int k = 0; k < 2; k++) {
            double e = s[k].edge_m - a.edge_m, f = s[k].flare_m - a.flare_m;
            var[k][0] += e * e, var[k][1] += f * f, cross[k] += e * f;
        }
    }
    assert_relative(var[1][0], var[0][0], 1e-9); /* the same draws: the same devices */
    assert_relative(var[1][1], var[0][1], 1e-9);
    assert_relative(cross[1], cross[0], 1e-9);
    /* an edge and an undercut that are read off one width lie closer than two that are not */
    double alone = hypot(0.05e-6, 25e-6 * 0.01);
    assert_true(sqrt(var[0][0] / n) < 0.9 * alone);
    assert_relative(in[1].sigma, 0.006, 1e-12);
    assert_relative(in[1].high, 0.962, 1e-12);
    /* one that is known exactly beside them, and how hinges differ, change nothing of it */
    for (int kind = 0; kind < 2; kind++) {
        memcpy(in, was, sizeof in);
        in[2].sigma = kind ? 0.5e-6 : 0.0, in[2].local = kind;
        in[2].q.correlated = of_A, in[2].q.ncorrelated = kind;
        assert_int_equal(fw_process_corners_independent(arena, in, 3), FW_OK);
        assert_relative(in[1].high, 0.962, 1e-12);
        assert_near(in[2].high, was[2].high, 0);
    }
    /* nothing correlated: nothing is touched */
    was[0].q.ncorrelated = was[1].q.ncorrelated = 0;
    memcpy(in, was, sizeof in);
    assert_int_equal(fw_process_corners_independent(arena, in, 3), FW_OK);
    assert_memory_equal(in, was, sizeof in);
}

/* ---- what is read ---- */

static const char *lab_with(const char *inside) {
    return fw_arena_printf(
        arena,
        "<process xmlns=\"urn:flexwright:process:1\" id=\"lab\" version=\"1\" title=\"x\"\n"
        "  flow=\"al-masked-rie\"><source id=\"s\" kind=\"measured\">x</source>\n"
        "<q id=\"rie.S\" value=\"0.1\" u=\"0.01\" unit=\"1\" status=\"measured\" src=\"s\"/>\n"
        "%s</process>",
        inside);
}

static void wrong_matrices(void **state) {
    (void)state;
    static const struct {
        const char *inside, *says;
        int line, column; /* 0: not looked at */
    } bad[] = {
        {"<correlation of=\"rie.R rie.SS\"><row of=\"rie.R\" values=\"1 0\"/></correlation>",
         "no quantity 'rie.SS'", 4, 18},
        {"<correlation of=\"rie.R rie.R\"><row of=\"rie.R\" values=\"1 0\"/></correlation>",
         "named twice", 4, 18},
        {"<correlation of=\"rie.R\"><row of=\"rie.R\" values=\"1\"/></correlation>",
         "two quantities or more", 4, 18},
        {"<correlation of=\"rie.R rie.S\"><row of=\"rie.R\" values=\"1 0.5\"/></correlation>",
         "1 rows for 2", 4, 18},
        {"<correlation of=\"rie.R rie.S\">\n<row of=\"rie.S\" values=\"1 0.5\"/>\n</correlation>",
         "in the order of the ids", 5, 10},
        {"<correlation of=\"rie.R rie.S\">\n<row of=\"rie.R\" values=\"1 0.5 0\"/>\n</correlation>",
         "more than 2 values", 5, 25},
        {"<correlation of=\"rie.R rie.S\">\n<row of=\"rie.R\" values=\"1\"/>\n</correlation>",
         "fewer than 2 values", 5, 25},
        {"<correlation of=\"rie.R rie.S\">\n<row of=\"rie.R\" values=\"1 1.2\"/>\n</correlation>",
         "no correlation", 5, 25},
        {"<correlation of=\"rie.R rie.S\">\n<row of=\"rie.R\" values=\"1 nan\"/>\n</correlation>",
         "no correlation", 5, 25},
        {"<correlation of=\"rie.R rie.S\">\n<row of=\"rie.R\" values=\"0.9 0.5\"/>\n</correlation>",
         "with itself is 1", 5, 25},
        {"<correlation of=\"rie.R rie.S\">\n<row of=\"rie.R\" values=\"1 0.5\"/>\n"
         "<row of=\"rie.S\" values=\"0.4 1\"/></correlation>",
         "both are one number", 6, 25},
        {"<correlation of=\"rie.R rie.S rie.selectivity\">\n<row of=\"rie.R\" values=\"1 0.9 "
         "0.9\"/>\n"
         "<row of=\"rie.S\" values=\"0.9 1 -0.9\"/>"
         "<row of=\"rie.selectivity\" values=\"0.9 -0.9 1\"/></correlation>",
         "not positive semidefinite", 4, 18},
        {"<correlation of=\"rie.R rie.S\" colour=\"red\"><row of=\"rie.R\" values=\"1 0\"/>"
         "<row of=\"rie.S\" values=\"0 1\"/></correlation>",
         "colour", 0, 0},
        {"<correlation of=\"rie.R rie.S\"/>", "row", 0, 0},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_diags said = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &said);
        const char *xml = lab_with(bad[i].inside);
        said = fw_diags_new(arena);
        assert_int_equal(fw_process_lab_apply(arena, "l.xml", xml, strlen(xml), f, &said),
                         FW_INPUT);
        bool found = false;
        for (size_t k = 0; k < said.count; k++) {
            const fw_diag *d = &said.item[k];
            if (!strstr(d->message, bad[i].says)) continue;
            found = true;
            if (bad[i].line && (d->place.line != bad[i].line || d->place.column != bad[i].column))
                fail_msg("%s at %d:%d", bad[i].says, d->place.line, d->place.column);
        }
        if (!found)
            fail_msg("%s: %s", bad[i].says, said.count ? said.item[said.count - 1].message : "-");
    }
}

/* a later pack that replaces one of two says nothing of the other one's error */
static void later_packs(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    const char *first = lab_with("<correlation of=\"rie.R rie.S\">"
                                 "<row of=\"rie.R\" values=\"1 0.5\"/>"
                                 "<row of=\"rie.S\" values=\"0.5 1\"/></correlation>"),
               *second = lab_with("");
    const fw_quantity *R = fw_process_flow_quantity(f, "rie.R"),
                      *S = fw_process_flow_quantity(f, "rie.S");
    assert_int_equal(fw_process_lab_apply(arena, "1.xml", first, strlen(first), f, &diags), FW_OK);
    assert_near(fw_quantity_correlation(R, S), 0.5, 0);
    assert_near(fw_quantity_correlation(S, R), 0.5, 0);
    assert_int_equal(fw_process_lab_apply(arena, "2.xml", second, strlen(second), f, &diags),
                     FW_OK);
    assert_near(fw_quantity_correlation(R, S), 0.0, 0);
    assert_near(fw_quantity_correlation(S, R), 0.0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matrix),  cmocka_unit_test(windows),        cmocka_unit_test(speed),
        cmocka_unit_test(corners), cmocka_unit_test(wrong_matrices), cmocka_unit_test(later_packs)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
