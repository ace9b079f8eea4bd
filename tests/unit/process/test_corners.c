/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corners of the packs as inputs of the verdict. */
#include "pack_fixture.h"
#include "process/calibrate.h"
#include "process/process.h"
#include "process/pack.h"
#include <math.h>

static fw_mechanism_variant variant_of(double thickness_m, double youngs_u) {
    return (fw_mechanism_variant){
        .material.youngs = {.value = 150e9, .uncertainty = youngs_u, .unit = "GPa"},
        .thickness_m = thickness_m};
}

static const fw_verdict_fabrication_input *
inputs(const char *pack, const char *from, const char *to, const fw_mechanism_variant *v, int *n) {
    const fw_verdict_fabrication_input *list;
    fw_process_flow *flow = read_pack(arena, pack, from, to, &diags);
    assert_non_null(flow);
    assert_int_equal(fw_process_flow_fabricated(arena, flow, NULL, v, &list, n), FW_OK);
    return list;
}

static int named(const fw_verdict_fabrication_input *list, int n, const char *name) {
    for (int i = 0; i < n; i++)
        if (strcmp(list[i].name, name) == 0) return i;
    fail_msg("no input %s", name);
    return 0;
}

/* widths at both faces against the formula of the etch, for a device of another thickness too */
static void the_silicon_flow_leaves_the_trapezoid_of_its_etch(void **state) {
    (void)state;
    for (int thick = 0; thick < 2; thick++) {
        double h = thick ? 30e-6 : 50e-6, width = 10e-6;
        fw_mechanism_variant v = variant_of(h, 1.5e9);
        int n;
        const fw_verdict_fabrication_input *list = inputs(SILICON, NULL, NULL, &v, &n);
        assert_int_equal(n, 5);
        int a = named(list, n, "anisotropy");
        assert_string_equal(list[a].unknown, "rie.A"); /* said to be assumed */
        assert_int_equal(list[a].q.status, FW_ASSUMED);
        double x[FW_FABRICATION_INPUTS], top, bottom;
        for (int i = 0; i < n; i++)
            x[i] = list[i].nominal;
        x[a] = list[a].low;
        fw_verdict_fabrication fabricated = fw_verdict_fabrication_at(list, n, x);
        fw_process_undercut_widths(width, x[a], h, 1.1 * h, &top, &bottom);
        assert_near(width + 2 * fabricated.edge_m, 0.5 * (top + bottom), 1e-12);
        assert_near(2 * fabricated.flare_m, bottom - top, 1e-12);
        x[a] = 1; /* a straight wall is as drawn */
        fabricated = fw_verdict_fabrication_at(list, n, x);
        assert_near(fabricated.edge_m, 0, 1e-15);
        assert_near(fabricated.flare_m, 0, 1e-15);
        assert_near(fabricated.thickness_ratio, 1, 1e-12);
        assert_near(fabricated.youngs_ratio, 1, 1e-12);
        int t = named(list, n, "thickness"), e = named(list, n, "Young's modulus");
        assert_near(list[t].high, 1.02 * h, 1e-12); /* two standard uncertainties of 1 % */
        assert_near(list[e].low, 147e9, 1);
        int p = named(list, n, "printed edge"), m = named(list, n, "edge of the aluminium");
        assert_near(list[p].high, 0.15e-6, 1e-15); /* lo to hi as it stands */
        assert_near(list[m].low, -0.22e-6, 1e-15);
    }
}

/* a measured A is compensated by the mask: mid-depth edges are even at its value, walls are not */
static void a_known_anisotropy_is_compensated(void **state) {
    (void)state;
    fw_mechanism_variant v = variant_of(50e-6, 0);
    int n;
    const fw_verdict_fabrication_input *list =
        inputs(SILICON, "id=\"rie.A\" unknown=\"true\"", "id=\"rie.A\" value=\"0.97\" u=\"0.004\"",
               &v, &n);
    assert_int_equal(n, 4); /* the modulus has no uncertainty */
    int a = named(list, n, "anisotropy");
    assert_null(list[a].unknown);
    assert_near(list[a].low, 0.962, 1e-12);
    double x[FW_FABRICATION_INPUTS];
    for (int i = 0; i < n; i++)
        x[i] = list[i].nominal;
    fw_verdict_fabrication fabricated = fw_verdict_fabrication_at(list, n, x);
    assert_near(fabricated.edge_m, 0, 1e-15);
    assert_near(fabricated.flare_m, 0.03 * 50e-6, 1e-12);
    x[a] = 0.962;
    fabricated = fw_verdict_fabrication_at(list, n, x);
    assert_near(fabricated.edge_m, -0.008 * 30e-6, 1e-12); /* (E - D/2) = 55 - 25 um */
}

static void the_copper_flow(void **state) {
    (void)state;
    fw_mechanism_variant v = variant_of(9e-6, 15e9);
    int n;
    const fw_verdict_fabrication_input *list = inputs(COPPER, NULL, NULL, &v, &n);
    assert_int_equal(n, 4);
    int t = named(list, n, "thickness"), w = named(list, n, "slope of the walls");
    assert_near(list[t].low, 8.1e-6, 1e-15);
    double x[FW_FABRICATION_INPUTS];
    for (int i = 0; i < n; i++)
        x[i] = list[i].nominal;
    x[w] = list[w].high, x[t] = list[t].low;
    fw_verdict_fabrication fabricated = fw_verdict_fabrication_at(list, n, x);
    assert_near(fabricated.flare_m, 9e-6 * acos(-1.0) / 180, 1e-12);
    assert_near(fabricated.thickness_ratio, 0.9, 1e-12);
}

/* what both expand by is known to some part alone, where a scene goes by it: of one substance there is no difference */
static void expansions_where_a_scene_heats(void **state) {
    (void)state;
    fw_mechanism_variant v = variant_of(9e-6, 15e9);
    v.material.expansion = (fw_quantity){.value = 16.7e-6, .uncertainty = 0.5e-6, .unit = "ppm/K"};
    v.substrate_expansion = (fw_quantity){.value = 2.57e-6, .uncertainty = 0.05e-6, .unit = "ppm/K"};
    int n;
    double x[FW_FABRICATION_INPUTS];
    inputs(COPPER, NULL, NULL, &v, &n);
    assert_int_equal(n, 4);
    v.heated_layer = v.heated_substrate = true;
    const fw_verdict_fabrication_input *list = inputs(COPPER, NULL, NULL, &v, &n);
    assert_int_equal(n, 6);
    const int l = named(list, n, "thermal expansion"), s = named(list, n, "thermal expansion of the substrate");
    assert_near(list[l].high, 17.7e-6, 1e-15);
    for (int i = 0; i < n; i++)
        x[i] = list[i].drawn;
    fw_verdict_fabrication made = fw_verdict_fabrication_at(list, n, x);
    assert_true(made.expansion_per_K == 0 && made.substrate_per_K == 0);
    x[l] = list[l].high, x[s] = list[s].low;
    made = fw_verdict_fabrication_at(list, n, x);
    assert_near(made.expansion_per_K, 1e-6, 1e-15);
    assert_near(made.substrate_per_K, -0.1e-6, 1e-15);
    v.substrate_expansion = v.material.expansion;
    inputs(COPPER, NULL, NULL, &v, &n);
    assert_int_equal(n, 4);
}

/* by how much hinges may differ moves nothing that all have in common */
static void hinges_of_their_own(void **state) {
    (void)state;
    fw_mechanism_variant v = variant_of(50e-6, 1.5e9);
    int n;
    const fw_verdict_fabrication_input *list =
        inputs(SILICON, "<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/>",
               "<corner of=\"local\" name=\"from hinge to hinge\" q=\"litho.edge\"/>", &v, &n);
    const int l = named(list, n, "from hinge to hinge");
    assert_near(list[l].local, 1, 0);
    assert_near(list[l].high - list[l].nominal, 0.15e-6, 1e-15);
    assert_true(list[l].edge_m == 0 && list[l].flare_m == 0 && list[l].thickness == 0 && list[l].youngs == 0);
    double x[FW_FABRICATION_INPUTS];
    for (int i = 0; i < n; i++)
        x[i] = list[i].nominal;
    const fw_verdict_fabrication alike = fw_verdict_fabrication_at(list, n, x);
    x[l] = list[l].high;
    const fw_verdict_fabrication apart = fw_verdict_fabrication_at(list, n, x);
    assert_near(alike.local_m, 0, 0);
    assert_near(apart.local_m, 0.15e-6, 1e-15);
    assert_near(apart.edge_m, alike.edge_m, 0);
}

/* whichever way it is said that hinges may be up to 0.14 um apart, they are that, either way */
static void hinges_apart_by_what_is_stated(void **state) {
    (void)state;
    static const struct {
        const char *q;
        double um;
    } of[] = {{"value=\"0\" u=\"0.07\"", 0.14},
              {"value=\"0.14\" u=\"0\"", 0.14},
              {"value=\"0.07\" u=\"0.035\"", 0.14},
              {"value=\"0.1\" lo=\"0\" hi=\"0.14\"", 0.14},
              {"value=\"-0.14\" u=\"0\" range=\"edge\"", 0.14},
              {"value=\"0\" lo=\"-0.14\" hi=\"0.1\" range=\"edge\"", 0.14},
              {"value=\"0.5\" u=\"0.001\"", 0.502},
              {"value=\"0\" u=\"0\"", 0.0}};
    fw_mechanism_variant v = variant_of(50e-6, 1.5e9);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        int n, l = FW_NONE;
        const fw_verdict_fabrication_input *list = inputs(
            SILICON, "<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/>",
            fw_arena_printf(arena,
                            "<q id=\"loc\" %s unit=\"um\" status=\"assumed\" src=\"guess\"/>"
                            "<corner of=\"local\" name=\"from hinge to hinge\" q=\"loc\"/>",
                            of[i].q),
            &v, &n);
        for (int k = 0; k < n; k++)
            if (list[k].local != 0) l = k;
        assert_int_equal(l == FW_NONE, of[i].um == 0);
        if (l == FW_NONE) continue;
        assert_near(list[l].high, of[i].um * 1e-6, 1e-15);
        assert_near(list[l].low, -list[l].high, 0);
        assert_true(list[l].nominal == 0 && list[l].drawn == 0);
    }
}

/* a range that is refused is told beside the one that it leaves */
static void a_plausible_range_is_named(void **state) {
    (void)state;
    diags = fw_diags_new(arena);
    assert_null(read_pack(arena, SILICON, "<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/>",
                          "<q id=\"loc\" value=\"0\" lo=\"-0.14\" hi=\"0.14\" unit=\"um\" status=\"assumed\" src=\"guess\"/>"
                          "<corner of=\"local\" name=\"from hinge to hinge\" q=\"loc\"/>",
                          &diags));
    assert_non_null(said_of(530, "between -0.14 and 0.14 um, outside its plausible range of 0 to "));
    assert_non_null(said_of(530, "name another range"));
}

static void mistakes_have_a_place(void **state) {
    (void)state;
    static const char *const wrong[][2] = {
        {"<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/>",
         "<corner of=\"thickness\" name=\"thickness\" q=\"rie.R\"/>"},
        {"<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/>",
         "<corner of=\"thickness\" name=\"thickness\"/>"},
        {"<corner of=\"youngs\" name=\"Young's modulus\"/>",
         "<corner of=\"youngs\" name=\"Young's modulus\" q=\"made.A\"/>"},
        {"<corner of=\"youngs\" name=\"Young's modulus\"/>",
         "<corner of=\"edge\" name=\"a\" q=\"wax.d\"/><corner of=\"edge\" name=\"b\" "
         "q=\"paste.d\"/><corner of=\"edge\" name=\"c\" q=\"carrier.d\"/>"},
        {"<corner of=\"youngs\" name=\"Young's modulus\"/>",
         "<corner of=\"edge\" name=\"again\" q=\"litho.edge\"/>"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, SILICON, wrong[i][0], wrong[i][1], &diags));
        assert_int_equal(diags.errors, 1);
        const fw_diag *d = &diags.item[0];
        while (d->severity != FW_ERROR)
            d++;
        assert_int_equal(d->number, 260);
        assert_true(d->place.line > 100);
    }
}

static double edge_u(fw_process_flow *flow) {
    return fw_process_flow_quantity(flow, "made.al-edge")->uncertainty;
}

/* L u(R)/R with L = d (1 + over-etch): what the pack has written is what its inputs give, and goes with each of them */
static void edge_of_an_etch_follows_its_rate(void **state) {
    (void)state;
    static const struct {
        const char *from, *to;
        double u_um;
    } at[] = {
        {NULL, NULL, 0.11},
        {"value=\"10\" urel=\"0.1\" unit=\"Ao/s\"", "value=\"10\" urel=\"0.05\" unit=\"Ao/s\"",
         0.055},
        {"id=\"al.overetch\" value=\"0.1\"", "id=\"al.overetch\" value=\"0.5\"", 0.15},
        {"id=\"al.d\" value=\"1\"", "id=\"al.d\" value=\"2\"", 0.22},
        {"id=\"al.d\" value=\"1\" urel=\"0.025\"", "id=\"al.d\" value=\"1\" urel=\"0.2\"", 0.11}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        fw_process_flow *flow = read_pack(arena, SILICON, at[i].from, at[i].to, &diags);
        assert_non_null(flow);
        assert_near(edge_u(flow), at[i].u_um * 1e-6, 1e-14);
    }
    /* a warm bath is known less well: its activation energy counts */
    fw_process_flow *warm = read_pack(arena, SILICON, "id=\"pan.T\" unknown=\"true\"",
                                      "id=\"pan.T\" value=\"40\" u=\"1\"", &diags);
    const double k = 8.617333262e-5, step = 1.0 / 295.15 - 1.0 / 313.15,
                 relative = hypot(0.1, hypot(0.5 / k * 1.0 / (313.15 * 313.15), 0.09 / k * step));
    assert_relative(edge_u(warm), 1.1e-6 * relative, 1e-3);
    /* what a laboratory has found of the edge itself holds */
    static const char lab[] = "<process xmlns=\"urn:flexwright:process:1\" flow=\"al-masked-rie\">"
                              "<source id=\"m\" kind=\"measured\">x</source>%s"
                              "<q id=\"pan.R\" value=\"12\" u=\"0.12\" unit=\"Ao/s\" "
                              "status=\"measured\" src=\"m\"/></process>",
                      edge[] = "<q id=\"made.al-edge\" value=\"0.2\" u=\"0.03\" unit=\"um\" "
                               "status=\"measured\" src=\"m\"/>";
    for (int own = 0; own < 2; own++) {
        const char *text = fw_arena_printf(arena, lab, own ? edge : "");
        fw_process_flow *flow = read_pack(arena, SILICON, NULL, NULL, &diags);
        assert_int_equal(fw_process_lab_apply(arena, "lab.xml", text, strlen(text), flow, &diags),
                         FW_OK);
        assert_near(edge_u(flow), own ? 0.03e-6 : 0.011e-6, 1e-14);
    }
}

/* a corner that names what the device is not made by would be dropped: refused, at its line */
static void corners_that_move_nothing(void **state) {
    (void)state;
    static const struct {
        const char *from, *to, *words;
    } wrong[] = {{"q=\"drie.A\"/>\n  <corner of=\"thickness\"",
                  "q=\"drie.S\"/>\n  <corner of=\"thickness\"", "cuts it with 'drie.A'"},
                 {"name=\"thickness\" q=\"soi.d\"", "name=\"thickness\" q=\"box.d\"",
                  "the thickness of another layer"},
                 {"name=\"printed edge\" q=\"litho.edge\"",
                  "name=\"printed edge\" q=\"litho.gap\"", "not where an edge or a wall"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, "soi-deep-rie", wrong[i].from, wrong[i].to, &diags));
        const fw_diag *d = said_of(664, wrong[i].words);
        assert_non_null(d);
        assert_in_range(d->place.line, 98, 100);
    }
}

static const fw_verdict_fabrication_input *open_of(const fw_verdict_fabrication_input *list, int n,
                                                   const char *id) {
    for (int i = 0; i < n; i++)
        if (list[i].open && strcmp(list[i].unknown, id) == 0) return &list[i];
    return NULL;
}

/* what moves the device, is not known, and has no assumed range is an input that has none; what is assumed is none */
static void what_nobody_knows(void **state) {
    (void)state;
    static const char edge[] = "id=\"litho.edge\" value=\"0\" lo=\"-0.15\" hi=\"0.15\"",
                      A[] = "id=\"drie.A\" value=\"0.995\" lo=\"0.99\" hi=\"1\"",
                      d[] = "id=\"soi.d\" value=\"50\" u=\"0.5\"",
                      S[] = "id=\"drie.S\" value=\"0.02\" u=\"0.01\" unit=\"1\" status=\"assumed\"";
    static const struct {
        const char *from, *to, *id, *name;
    } of[] = {{edge, "id=\"litho.edge\" unknown=\"true\"", "litho.edge", "printed edge"},
              {A, "id=\"drie.A\" unknown=\"true\"", "drie.A", "anisotropy"},
              {d, "id=\"soi.d\" unknown=\"true\"", "soi.d", "thickness"},
              {S, "id=\"drie.S\" unknown=\"true\" unit=\"1\" status=\"assumed\"", "drie.S",
               "lag of narrow openings"}};
    fw_mechanism_variant v = variant_of(30e-6, 1.5e9);
    int known, n;
    inputs("soi-deep-rie", NULL, NULL, &v, &known);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const fw_verdict_fabrication_input *list =
            inputs("soi-deep-rie", of[i].from, of[i].to, &v, &n);
        const fw_verdict_fabrication_input *open = open_of(list, n, of[i].id);
        assert_non_null(open);
        fw_process_flow *flow = read_pack(arena, "soi-deep-rie", of[i].from, of[i].to, &diags);
        fw_process_fixed_point p;
        assert_int_equal(fw_process_fixed_point_solve(arena, flow, NULL, 30e-6, &p), FW_OK);
        assert_int_equal(p.open, i != 2); /* then outlines are told to be of the known part; a thickness has none */
        assert_string_equal(open->name, of[i].name);
        assert_true(open == &list[n - 1] && fw_verdict_fabrication_open(list, n));
        assert_int_equal(n, known + (i == 3)); /* a lag stands beside its anisotropy */
        assert_true(open->low == open->high && open->edge_m == 0 && open->thickness == 0);
    }
    const fw_verdict_fabrication_input *list = inputs(SILICON, NULL, NULL, &v, &n);
    assert_false(fw_verdict_fabrication_open(list, n)); /* rie.A: made.A is assumed */
    list = inputs(SILICON, "q=\"rie.A\" assumed=\"made.A\"", "q=\"rie.A\"", &v, &n);
    assert_non_null(open_of(list, n, "rie.A"));
    list = inputs(SILICON, "<corner of=\"anisotropy\" name=\"anisotropy\" q=\"rie.A\" assumed=\"made.A\"/>",
                  "", &v, &n);
    assert_non_null(open_of(list, n, "rie.A")); /* and without a corner at all */
    size_t length;
    const char *text = replaced(arena, pack_text(arena, "soi-deep-rie", &length), edge, of[0].to, &length);
    text = replaced(arena, text, "<corner of=\"edge\" name=\"printed edge\" q=\"litho.edge\"/>", "", &length);
    size_t nb;
    const char *base = pack_text(arena, "base", &nb);
    fw_process_flow *flow;
    assert_int_equal(fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", text, length, &diags, &flow), FW_OK);
    assert_int_equal(fw_process_flow_fabricated(arena, flow, NULL, &v, &list, &n), FW_OK);
    assert_non_null(open_of(list, n, "litho.edge"));
}

/* of an unknown lag the least that it takes, none, is in mask and corners alike: (1 - A)(E - D/2), E = (1 + o) D */
static void an_unknown_lag_takes_its_least(void **state) {
    (void)state;
    const double D = 30e-6;
    fw_mechanism_variant v = variant_of(D, 0);
    fw_process_flow *flow = read_pack(
        arena, "soi-deep-rie", "id=\"drie.S\" value=\"0.02\" u=\"0.01\" unit=\"1\" status=\"assumed\"",
        "id=\"drie.S\" unknown=\"true\" unit=\"1\" status=\"assumed\"", &diags);
    assert_non_null(flow);
    measured(flow, "drie.A", 0.985, 0.001);
    fw_process_fixed_point p;
    assert_int_equal(fw_process_fixed_point_solve(arena, flow, &plain_facts, D, &p), FW_OK);
    const double E = (1 + p.cut[0].overrun) * D;
    assert_true(p.solved && p.open && isnan(p.cut[0].etched_m));
    assert_near(p.etch_m, 0.015 * (E - 0.5 * D), 1e-15);
    assert_near(p.cls[p.field].edge.middle_m, 0, 1e-15); /* where it is drawn */
    assert_true(isnan(p.low_m) && isnan(p.cls[p.field].low.top_m));
    const fw_verdict_fabrication_input *list;
    int n;
    assert_int_equal(fw_process_flow_fabricated(arena, flow, &plain_facts, &v, &list, &n), FW_OK);
    const int a = named(list, n, "anisotropy");
    assert_near(list[a].edge_m, E - 0.5 * D, 1e-15);
    assert_near(list[a].flare_m, -D, 1e-15);
    assert_near(list[a].even, 0.985, 1e-12);
    assert_non_null(open_of(list, n, "drie.S"));
}

/* what is uncertain and has none is told by its name */
static void corners_that_lack(void **state) {
    (void)state;
    static const struct {
        const char *pack, *from, *words;
    } gone[] = {
        {"soi-deep-rie", "<corner of=\"anisotropy\" name=\"anisotropy\" q=\"drie.A\"/>", "'drie.A'"},
        {"soi-deep-rie", "<corner of=\"edge\" name=\"printed edge\" q=\"litho.edge\"/>",
         "'litho.edge'"},
        {"soi-deep-rie", "<corner of=\"thickness\" name=\"thickness\" q=\"soi.d\"/>", "'soi.d'"},
        {COPPER, "<corner of=\"taper\" name=\"slope of the walls\" q=\"made.wall\"/>",
         "'made.wall'"},
        {SILICON, " etched=\"yes\"/>", "moves every edge"}};
    for (size_t i = 0; i < sizeof gone / sizeof *gone; i++) {
        diags = fw_diags_new(arena);
        assert_non_null(
            read_pack(arena, gone[i].pack, gone[i].from, i == 4 ? "/>" : "", &diags));
        assert_non_null(said_of(665, gone[i].words));
    }
    static const char *const shipped[] = {"soi-deep-rie", "soi-double-sided", "silicon-on-glass",
                                          COPPER, SILICON};
    for (size_t i = 0; i < sizeof shipped / sizeof *shipped; i++) {
        diags = fw_diags_new(arena);
        assert_non_null(read_pack(arena, shipped[i], NULL, NULL, &diags));
        assert_null(said_of(665, ""));
        assert_null(said_of(674, ""));
        fw_mechanism_variant v = variant_of(30e-6, 1.5e9);
        int n;
        const fw_verdict_fabrication_input *list = inputs(shipped[i], NULL, NULL, &v, &n);
        assert_false(fw_verdict_fabrication_open(list, n));
    }
}

/* ratios that are written as shares, and Faraday's law of another metal */
static void numbers_that_are_meant(void **state) {
    (void)state;
    diags = fw_diags_new(arena);
    fw_process_flow *f = read_pack(arena, COPPER, NULL, NULL, &diags);
    fw_process_step *s = NULL;
    fw_process_change *plated = NULL;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            if (strcmp(f->step[i].op, "plate") == 0 &&
                strcmp(f->step[i].change[k].material, "copper-plated") == 0)
                s = &f->step[i], plated = &f->step[i].change[k];
    assert_non_null(plated);
    fw_quantity spread = {.id = "spread", .value = 0.12, .unit = "1"};
    plated->spread = &spread;
    assert_int_equal(fw_process_flow_lint_values(arena, f, &diags), FW_OK);
    assert_non_null(said_of(669, "write 1.12"));
    spread.value = 1.12;
    diags = fw_diags_new(arena);
    fw_quantity nickel[] = {{.id = "rho", .value = 8900, .uncertainty = 10, .unit = "kg/m3"},
                            {.id = "M", .value = 0.058693, .unit = "g/mol"}};
    for (int i = 0; i < s->nargument; i++) {
        if (strcmp(s->argument[i].name, "density") == 0) s->argument[i].q = &nickel[0];
        if (strcmp(s->argument[i].name, "molar_mass") == 0) s->argument[i].q = &nickel[1];
    }
    assert_int_equal(fw_process_flow_lint_values(arena, f, &diags), FW_OK);
    assert_non_null(said_of(674, "copper has 63.546"));
    assert_null(said_of(669, ""));
    nickel[0].value = 8700; /* farther than the material's own 45 */
    assert_int_equal(fw_process_flow_lint_values(arena, f, &diags), FW_OK);
    assert_non_null(said_of(674, "a density of 8700"));
    diags = fw_diags_new(arena);
    f = read_pack(arena, "soi-deep-rie", NULL, NULL, &diags);
    measured(f, "drie.A", 0.008, 0.002);
    assert_int_equal(fw_process_flow_lint_values(arena, f, &diags), FW_OK);
    assert_non_null(said_of(675, "write 0.992"));
}

/* what thickness comes of a lab pack `text` or two */
static fw_verdict_fabrication_input thickness_with(fw_process_flow *flow, const char *first, const char *second, double h) {
    const char *text[] = {first, second}, *file[] = {"first.xml", "second.xml"};
    fw_mechanism_variant v = variant_of(h, 0);
    const fw_verdict_fabrication_input *list;
    int n;
    for (int i = 0; i < 2 && text[i]; i++) {
        const char *xml = fw_arena_printf(arena,
                                          "<process xmlns=\"urn:flexwright:process:1\" flow=\"" COPPER "\">"
                                          "<source id=\"m\" kind=\"measured\">x</source>%s</process>",
                                          text[i]);
        assert_int_equal(fw_process_lab_apply(arena, file[i], xml, strlen(xml), flow, &diags), FW_OK);
    }
    assert_int_equal(fw_process_flow_fabricated(arena, flow, NULL, &v, &list, &n), FW_OK);
    return list[named(list, n, "thickness")];
}

#define SAID(id, value, u, unit) \
    "<q id=\"" id "\" value=\"" value "\" u=\"" u "\" unit=\"" unit "\" status=\"measured\" src=\"m\"/>"

/* What is made follows what is planned, whoever plans it: stated as its share, or as a length beside what was planned then.
   A range of 8.1 to 9.9 um stayed where a laboratory plated 6.5 um. */
static void thickness_follows_its_plan(void **state) {
    (void)state;
    static const char share[] = "id=\"made.cu\" value=\"1\" lo=\"0.9\" hi=\"1.1\" unit=\"1\"",
                      length[] = "id=\"made.cu\" value=\"9\" lo=\"8.1\" hi=\"9.9\" unit=\"um\"",
                      least[] = "least=\"0.5\" most=\"2\" note=\"share";
    for (int k = 0; k < 2; k++) {
        size_t nb = 0, n = 0;
        const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, COPPER, &n);
        text = replaced(arena, text, share, k ? length : share, &n);
        if (k) text = replaced(arena, text, least, "note=\"share", &n);
        static const char thinner[] = SAID("cu.d", "6.5", "0", "um");
        const char *read = k ? SAID("made.cu", "9.27", "0.07", "um") : SAID("made.cu", "1.03", "0.00778", "1");
        const char *read_so = k ? SAID("made.cu", "6.695", "0.05", "um") : read;
        struct {
            const char *first, *second;
            double h, nominal, low;
        } of[] = {{NULL, NULL, 9e-6, 9e-6, 8.1e-6},
                  {NULL, NULL, 12e-6, 12e-6, 10.8e-6}, /* of the device file */
                  {thinner, NULL, 6.5e-6, 6.5e-6, 5.85e-6},
                  {read, NULL, 9e-6, 9.27e-6, 0},
                  {read, thinner, 6.5e-6, 6.695e-6, 0},
                  {thinner, read_so, 6.5e-6, 6.695e-6, 0}};
        for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
            fw_process_flow *flow = NULL;
            diags = fw_diags_new(arena);
            assert_int_equal(fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", text, n, &diags, &flow), FW_OK);
            fw_verdict_fabrication_input in = thickness_with(flow, of[i].first, of[i].second, of[i].h);
            assert_near(in.nominal, of[i].nominal, 1e-12);
            if (of[i].low > 0) assert_near(in.low, of[i].low, 1e-12);
            assert_near(in.thickness * of[i].h, 1, 1e-12);
            assert_string_equal(in.q.unit, "um"); /* as it is told */
            if (!k) assert_near(in.q.value, of[i].nominal, 1e-12);
        }
    }
}

/* A laboratory's edge that was judged without it changes nothing of wafers that are printed; one beyond that is of a mask drawn
   anew, which is told */
static void another_bias(void **state) {
    (void)state;
    static const struct {
        const char *q, *words; /* NULL: nothing is told */
    } of[] = {{SAID("made.al-edge", "-0.2", "0.02", "um"), NULL},
              {SAID("made.al-edge", "-0.8", "0.02", "um"), "where lines come out 1.6 um narrower than here"},
              {SAID("made.al-edge", "0.5", "0.02", "um"), "1 um wider"},
              {SAID("rie.A", "0.993", "0.0003", "1"), NULL}, /* 0.99 to 1 was judged */
              {SAID("rie.A", "0.97", "0.0003", "1"), "rie.A is 0.97, beyond what it was taken to be before"},
              {SAID("al.d", "1.2", "0.02", "um"), NULL}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        fw_process_flow *flow = read_pack(arena, SILICON, NULL, NULL, &diags);
        const char *xml = fw_arena_printf(arena,
                                          "<process xmlns=\"urn:flexwright:process:1\" flow=\"" SILICON "\">"
                                          "<source id=\"m\" kind=\"measured\">x</source>%s</process>",
                                          of[i].q);
        diags = fw_diags_new(arena);
        assert_int_equal(fw_process_lab_apply(arena, "l.xml", xml, strlen(xml), flow, &diags), FW_OK);
        assert_int_equal(fw_process_lab_ask_bias(arena, flow, &diags), FW_OK);
        assert_true(of[i].words ? said_of(683, of[i].words) != NULL : said_of(683, "") == NULL);
    }
}

/* The narrowest opening is off by both of its edges in the layer that masks the etch: of what is printed and of how that is
   etched, or of the latter alone where it was measured with the former in it. The note of the bias says the same. What is
   stated closes what was open of it. */
static void what_an_opening_is_off_by(void **state) {
    (void)state;
    static const struct {
        double printed_um, etched_um, u_um; /* 0: as the pack has it */
        const char *note;
    } of[] = {{0, 0, 0, "printed edges may lie off by 0.0866 um"},
              {0, 0.012, 0.024, "the edge of the aluminium, with the printed edge in it, may lie off by 0.012 um"},
              {0.01, 0, 0, "printed edges may lie off by 0.01 um"},
              {0.01, 0.012, 0.024, "the edge of the aluminium, with the printed edge in it, may lie off by 0.012 um"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        fw_process_flow *flow = read_pack(arena, SILICON, NULL, NULL, &diags);
        if (of[i].printed_um > 0) measured(flow, "litho.edge", 0, of[i].printed_um * 1e-6);
        if (of[i].etched_um > 0) measured(flow, "made.al-edge", 0, of[i].etched_um * 1e-6);
        assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
        const double printed = of[i].printed_um > 0 ? of[i].printed_um : 0.15 / sqrt(3.0);
        assert_near(fw_process_flow_quantity(flow, "mask.narrowest-opening")->uncertainty,
                    1e-6 * (of[i].u_um > 0 ? of[i].u_um : 2.0 * hypot(printed, 0.11)), 1e-12);
        assert_non_null(strstr(flow->bias_note, of[i].note));
        assert_int_equal(strstr(flow->bias_note, "printed edges may") != NULL, of[i].etched_um == 0);
    }
    for (int known = 0; known < 2; known++) {
        fw_process_flow *flow = read_pack(arena, COPPER, NULL, NULL, &diags);
        bool open = false;
        if (known) measured(flow, "seed.d", 0.15e-6, 0.01e-6), measured(flow, "seed.R", 5e-9, 0.3e-9);
        assert_int_equal(fw_process_flow_compute(arena, flow, &plain_facts, &diags), FW_OK);
        for (int i = 0; i < flow->nreason; i++)
            open = open || strstr(flow->reason[i], "which is not in the corners of the verdict");
        assert_int_equal(open, !known);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_an_opening_is_off_by),
        cmocka_unit_test(edge_of_an_etch_follows_its_rate),
        cmocka_unit_test(the_silicon_flow_leaves_the_trapezoid_of_its_etch),
        cmocka_unit_test(a_known_anisotropy_is_compensated),
        cmocka_unit_test(the_copper_flow),
        cmocka_unit_test(hinges_of_their_own),
        cmocka_unit_test(hinges_apart_by_what_is_stated),
        cmocka_unit_test(a_plausible_range_is_named),
        cmocka_unit_test(mistakes_have_a_place),
        cmocka_unit_test(expansions_where_a_scene_heats),
        cmocka_unit_test(corners_that_move_nothing),
        cmocka_unit_test(what_nobody_knows),
        cmocka_unit_test(an_unknown_lag_takes_its_least),
        cmocka_unit_test(corners_that_lack),
        cmocka_unit_test(numbers_that_are_meant),
        cmocka_unit_test(thickness_follows_its_plan),
        cmocka_unit_test(another_bias),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
