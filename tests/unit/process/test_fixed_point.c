/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bias, time and gap: reference values, plain iteration, the fold, what reads the result. */
#include "pack_fixture.h"
#include "process/process_law.h"
#include "process/process.h"
#include "process/pack.h"

static fw_process_flow *flow_of(const char *name) {
    fw_process_flow *f = read_pack(arena, name, NULL, NULL, &diags);
    assert_non_null(f);
    /* a laboratory that measured its lag: what is only assumed is not planned with */
    fw_quantity *lag = (fw_quantity *)fw_process_flow_quantity(f, "rie.S");
    if (lag) lag->status = FW_MEASURED;
    return f;
}

/* as if the pack said so */
static void set(fw_process_flow *f, const char *id, double value) {
    fw_quantity *q = (fw_quantity *)fw_process_flow_quantity(f, id);
    assert_non_null(q);
    q->unknown = isnan(value);
    q->value = q->unknown ? 0.0 : value;
    q->uncertainty = 0.0;
    q->interval = false;
}

static fw_process_change *cutting(fw_process_flow *f) {
    return &step_of(f, "S18")->change[0];
}

static const fw_process_fixed_point *solved(fw_process_flow *f,
                                            const fw_process_mask_facts *facts) {
    fw_process_fixed_point *p = fw_arena_one(arena, fw_process_fixed_point);
    assert_non_null(p);
    assert_int_equal(fw_process_fixed_point_solve(arena, f, facts, 0.0, p), FW_OK);
    return p;
}

static bool told(int number) {
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].number == number) return true;
    return false;
}

static bool reason(const fw_process_flow *f, const char *text) {
    for (int i = 0; i < f->nreason; i++)
        if (strstr(f->reason[i], text)) return true;
    return false;
}

/* ---- reference values ---- */

/* a line of 10 um is 7.8 um wide after the aluminium; with A = 0.95 and the top edge brought back a
   gap of 10 um is 2.3 um on the mask */
static void the_two_biases_of_the_silicon_flow(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    assert_near(10e-6 - 2 * solved(f, &plain_facts)->wet_m, 7.8e-6, 1e-18);
    set(f, "rie.A", 0.95);
    set(f, "rie.S", 0.0);
    cutting(f)->compensate = FW_FACE_TOP;
    const fw_process_fixed_point *p = solved(f, &plain_facts);
    assert_true(p->solved);
    assert_near(p->etch_m, 2.75e-6, 1e-17);
    assert_near(p->cls[0].plate_m, 2.3e-6, 1e-17);
    assert_near(p->cls[0].edge.top_m, 0.0, 1e-18);
    assert_near(p->cls[0].edge.bottom_m, 2.5e-6, 1e-17); /* (1 - A) D */
    cutting(f)->compensate = FW_FACE_BOTTOM;
    p = solved(f, &plain_facts);
    assert_near(p->bias_m, 1.1e-6 + 0.05 * 5e-6, 1e-17);
    assert_near(p->cls[0].edge.bottom_m, 0.0, 1e-18);
}

/* 10 um: 45.8 um deep after 90 min, 98.85 min; 2 um: 38.6 um, 122.7 min */
static void narrow_slots_of_the_source(void **state) {
    (void)state;
    fw_process_mask_gap gap[] = {{FW_GAP_HINGE, "gap of hinge A", 10e-6},
                                 {FW_GAP_COMB, "gap of comb drive c", 2e-6},
                                 {FW_GAP_COMB, "the same width", 10e-6}};
    fw_process_mask_facts facts = plain_facts;
    facts.narrowest_slot_m = 2e-6;
    facts.gap = gap;
    facts.ngap = 3;
    fw_process_flow *f = flow_of(SILICON);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    const fw_process_fixed_point *p = &f->edges;
    assert_int_equal(p->ncls, 3);
    assert_string_equal(p->cls[0].name, "gap of comb drive c");
    assert_relative(p->cls[0].through_s / 60, 122.744, 1e-5);
    assert_relative(p->cls[1].through_s / 60, 98.8542, 1e-6);
    assert_true(reason(f, "reaches 38.59 of 50 um"));
    assert_relative(step_of(f, "S18")->time.nominal_s / 60, 122.744, 1e-5);
    /* over-etch: all in the time of the narrowest, and the pack's own tenth more */
    assert_relative(p->cls[0].over_etch, 0.1, 1e-12);
    assert_relative(p->cls[1].over_etch, 1.1 * 122.744 / 98.8542 - 1, 1e-5);
    assert_true(p->cls[2].kind == FW_GAP_FIELD && p->field == 2);
    assert_true(told(181)); /* 2 um less twice 1.1 um: closed on the mask */
    assert_int_equal(f->manufacturable, 0);
}

/* the least A for a stiffness within 10 %: 0.9930 nominal, 0.9942 with a tenth more */
static void needed_anisotropy(void **state) {
    (void)state;
    static const double want[] = {0.9930, 0.9942};
    for (int i = 0; i < 2; i++) {
        fw_process_flow *f = flow_of(SILICON);
        set(f, "rie.S", 0.0);
        step_of(f, "S18")->overrun = 0.1 * i;
        set(f, "rie.A", want[i]);
        cutting(f)->compensate = FW_FACE_MIDDLE;
        const fw_process_fixed_point *p = solved(f, &plain_facts);
        double A[] = {want[i]}, w = 10e-6;
        fw_process_edge e = fw_process_fixed_point_edge(p, p->cls[p->field].opening_m, A);
        /* with a mask that adds nothing */
        double top = w + 2 * (e.top_m - p->etch_m), bottom = w + 2 * (e.bottom_m - p->etch_m);
        assert_near(fw_process_undercut_stiffness(top, bottom, w), 0.9, 1e-3);
    }
}

/* ---- the fixed point itself ---- */

static double random01(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

typedef struct random_case {
    double D, A, S, over, gap, field;
    fw_process_face face;
    bool linear;
} random_case;

static double lag_of(const random_case *r, double w) {
    return r->linear ? r->S * r->D * r->D / (2 * w)
                     : r->S * fw_process_arde_integral(w, r->D, false);
}

static double F_of(const random_case *r, double m) {
    double E = (1 + r->over) * (r->D + lag_of(r, r->gap - 2 * m));
    double foot = fmax(0, E - r->D - lag_of(r, r->field - 2 * m));
    double loss = r->face == FW_FACE_TOP ? E : r->face == FW_FACE_BOTTOM ? foot : 0.5 * (E + foot);
    return (1 - r->A) * loss;
}

/* m <- F(m) until nothing moves; false: the gap closes on the way */
static bool plain_iteration(const random_case *r, double *m) {
    *m = 0;
    for (int i = 0; i < 20000; i++) {
        double next = F_of(r, *m);
        if (!(r->gap - 2 * next > 0)) return false;
        if (fabs(next - *m) <= 1e-16 * next) return true;
        *m = next;
    }
    return true;
}

static fw_process_flow *flow_with(const random_case *r) {
    fw_process_flow *f = flow_of(SILICON);
    fw_process_step *s = step_of(f, "S18");
    set(f, "si.d", r->D);
    set(f, "rie.A", r->A);
    set(f, "rie.S", r->S);
    s->overrun = r->over;
    s->change[0].compensate = r->face;
    if (r->linear) {
        s->shape = "linear";
        for (int i = 0; i < s->nargument; i++)
            if (strcmp(s->argument[i].name, "probability") == 0) s->argument[i].name = "lag";
    }
    return f;
}

static fw_process_mask_facts facts_with(const random_case *r) {
    fw_process_mask_facts facts = plain_facts;
    facts.narrowest_slot_m = r->gap;
    facts.perimeter_m = 2 * (facts.die_area_m2 - facts.structure_area_m2) / r->field;
    return facts;
}

static void newton_finds_what_plain_iteration_finds(void **state) {
    (void)state;
    uint64_t seed = 20240601;
    int with = 0, without = 0;
    const int cases = test_fewest(250, 50);
    for (int n = 0; n < cases; n++) {
        random_case r = {.D = (5 + 95 * random01(&seed)) * 1e-6,
                         .A = 1 - 0.15 * random01(&seed),
                         .S = random01(&seed),
                         .over = 0.4 * random01(&seed),
                         .gap = (1 + 19 * random01(&seed)) * 1e-6,
                         .face = (fw_process_face)(3 * random01(&seed)),
                         .linear = random01(&seed) < 0.3};
        r.field = r.gap * (1 + 50 * random01(&seed));
        fw_process_mask_facts facts = facts_with(&r);
        double m;
        bool there = plain_iteration(&r, &m);
        const fw_process_fixed_point *p = solved(flow_with(&r), &facts);
        assert_int_equal(p->solved, there);
        with += there, without += !there;
        if (!there) continue;
        /* the plain iteration stops 1e-16/(1 - slope) from its limit */
        assert_near(p->etch_m, m, 1e-12 * m + 1e-15 * m / (1 - p->slope));
        assert_true(p->slope < 1 && p->iterations < 40);
        /* the edges beside the field end up where they are drawn, by the compensated face */
        fw_process_edge e = p->cls[p->field].edge;
        double off = r.face == FW_FACE_TOP      ? e.top_m
                     : r.face == FW_FACE_BOTTOM ? e.bottom_m
                                                : e.middle_m;
        assert_near(off, 0, 1e-12 * r.D);
        assert_true(e.bottom_m >= e.top_m);
    }
    assert_true(with > cases * 8 / 25 && without > cases * 3 / 50);
}

/* just wide enough: there is a solution, and hardly one; a little less: none */
static void the_fold_is_where_it_is_said_to_be(void **state) {
    (void)state;
    random_case r = {.D = 50e-6, .A = 0.95, .S = 0.2, .over = 0.1, .gap = 3e-6, .field = 400e-6};
    fw_process_mask_facts facts = facts_with(&r);
    fw_process_flow *f = flow_with(&r);
    set(f, "al.d", 0.0);
    const fw_process_fixed_point *p = solved(f, &facts);
    assert_false(p->solved);
    double least = p->least_gap_m, m;
    assert_true(least > r.gap && least < 20e-6);
    for (int i = 0; i < 2; i++) {
        r.gap = least * (i ? 1 + 1e-6 : 1 - 1e-6);
        facts.narrowest_slot_m = r.gap;
        assert_int_equal(plain_iteration(&r, &m), i == 1);
        const fw_process_fixed_point *q = solved(f, &facts);
        assert_int_equal(q->solved, i == 1);
        if (i) assert_true(q->slope > 0.99);
    }
    /* a better etch does it in the drawn gap; with the least that is said, hardly */
    facts.narrowest_slot_m = 3e-6;
    double best = p->least_anisotropy;
    assert_true(best > 0.95 && best < 1);
    set(f, "rie.A", best + 1e-6);
    assert_true(solved(f, &facts)->solved);
    set(f, "rie.A", best - 1e-6);
    assert_false(solved(f, &facts)->solved);
}

/* ---- what nobody knows stays so ---- */

static void unknown_stays_unknown(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    const fw_process_fixed_point *p = solved(f, &plain_facts);
    assert_true(p->solved && p->open);
    assert_relative(p->bias_m, 1.1e-6, 1e-14);
    assert_near(p->cls[0].edge.top_m, 0, 0); /* the known part alone */
    /* the assumed range 0.99 to 1 is one of edges, and of the bias it would ask for */
    /* with printed edges within 0.15 um and those of the aluminium within two times 0.11 um */
    assert_near(p->cls[0].high.top_m, 0.37e-6, 1e-17);
    assert_relative(p->cls[0].low.top_m, -0.01 * p->cut[0].etched_m - 0.37e-6, 1e-12);
    assert_relative(p->low_m, 1.1e-6, 1e-12);
    random_case r = {50e-6, 0.99, 0.1, 0.1, 10e-6, 575e-6, FW_FACE_MIDDLE, false};
    double m;
    assert_true(plain_iteration(&r, &m));
    assert_relative(p->high_m, 1.1e-6 + m, 1e-12);
    /* without a range there is none */
    f->ncorner = 0;
    p = solved(f, &plain_facts);
    assert_true(isnan(p->low_m) && isnan(p->high_m) && isnan(p->cut[0].low));
    /* where the time is not known a known A tells what is taken at least: (1 - A)(E - D/2) with E without any lag */
    f = flow_of(SILICON);
    set(f, "rie.A", 0.97);
    set(f, "rie.S", (double)NAN);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_true(f->edges.open && isnan(f->edges.cut[0].etched_m));
    assert_relative(f->bias_m, 1.1e-6 + 0.03 * (55e-6 - 25e-6), 1e-12);
    assert_non_null(strstr(f->bias_note, "undercuts by at least 0.9 um"));
    assert_false(step_of(f, "S18")->time.computable);
    assert_true(reason(f, "neither its time nor its undercut is"));
    /* nor does a thickness of aluminium that is not known */
    f = flow_of(SILICON);
    set(f, "al.d", (double)NAN);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_true(f->edges.wet_open);
    assert_near(f->bias_m, 0, 0);
}

static void what_is_known_of_printing_is_taken_back(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    set(f, "litho.edge", 0.2e-6);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_relative(f->bias_m, 0.9e-6, 1e-12);
    assert_non_null(strstr(f->bias_note, "0.2 um outside where they are drawn and the mask takes back that"));
    f = flow_of(SILICON);
    set(f, "litho.edge", -0.1e-6);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_relative(f->bias_m, 1.2e-6, 1e-12);
    assert_non_null(strstr(f->bias_note, "0.1 um inside where they are drawn and the mask adds that"));
}

/* copper: printed edges within 0.5 um, walls within a degree of upright over 9 um */
static void copper_copies_its_mould(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(COPPER);
    const fw_process_fixed_point *p = solved(f, &plain_facts);
    double wall = 9e-6 * acos(-1.0) / 180;
    assert_true(p->solved && p->ncut == 0 && !p->open);
    assert_near(p->bias_m, 0, 0);
    assert_near(p->cls[0].edge.top_m, 0, 0);
    assert_relative(p->cls[0].low.top_m, -0.5e-6 - wall / 2, 1e-12);
    assert_relative(p->cls[0].high.bottom_m, 0.5e-6 + wall / 2, 1e-12);
    set(f, "made.wall", acos(-1.0) / 180); /* a known slope: faces differ, the mean stays */
    p = solved(f, &plain_facts);
    assert_relative(p->cls[0].edge.bottom_m - p->cls[0].edge.top_m, wall, 1e-12);
    assert_near(p->cls[0].edge.middle_m, 0, 1e-20);
}

/* ---- one struct for mask, recipe and verdict ---- */

typedef struct seen { /* by the three who read it */
    double bias_m, nominal_s, stop_s, flare_m, edge_slope;
} seen;

static const fw_verdict_fabrication_input *anisotropy_of(fw_process_flow *f,
                                                         fw_verdict_fabrication *fabricated) {
    fw_mechanism_variant v = {.material.youngs = {.value = 150e9},
                              .thickness_m = f->thickness->value};
    const fw_verdict_fabrication_input *list;
    int n;
    assert_int_equal(fw_process_flow_fabricated(arena, f, &plain_facts, &v, &list, &n), FW_OK);
    double x[FW_FABRICATION_INPUTS];
    const fw_verdict_fabrication_input *found = NULL;
    for (int i = 0; i < n; i++) {
        x[i] = list[i].nominal;
        if (strcmp(list[i].name, "anisotropy") == 0) found = &list[i];
    }
    *fabricated = fw_verdict_fabrication_at(list, n, x);
    assert_non_null(found);
    return found;
}

static seen look(fw_process_flow *f) {
    fw_verdict_fabrication fabricated;
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    const fw_verdict_fabrication_input *in = anisotropy_of(f, &fabricated);
    const fw_process_step *s = step_of(f, "S18");
    const fw_process_fixed_point *p = &f->edges;
    const fw_process_edge e = p->cls[p->field].edge;
    /* they agree: time, bias and corner are one computation */
    double R = fw_process_flow_quantity(f, "rie.R")->value;
    assert_relative(R * s->time.nominal_s, p->cut[0].planned_m, 1e-13);
    assert_relative(R * s->time.nominal_s * (1 + s->overrun), p->cut[0].etched_m, 1e-13);
    assert_near(f->bias_m, p->wet_m + p->etch_m + p->printed_m + p->wear.loss_m, 0);
    assert_near(fabricated.edge_m, e.middle_m, 1e-18);
    assert_near(fabricated.flare_m, e.bottom_m - e.top_m, 1e-18);
    assert_near(fabricated.edge_m, 0, 1e-17);
    assert_relative(fw_process_flow_quantity(f, FW_MASK_OPENING)->value,
                    plain_facts.narrowest_slot_m - 2 * p->etch_m, 1e-13);
    return (seen){f->bias_m, s->time.nominal_s, s->time.stop_s, fabricated.flare_m, in->edge_m};
}

static fw_process_flow *with_known_anisotropy(void) {
    fw_process_flow *f = flow_of(SILICON);
    set(f, "rie.A", 0.97);
    ((fw_quantity *)fw_process_flow_quantity(f, "rie.A"))->uncertainty = 0.004;
    return f;
}

static bool moved(double a, double b) {
    return fabs(a - b) > 1e-4 * fabs(a);
}

static void perturb_one_and_look(void **state) {
    (void)state;
    fw_process_flow *f = with_known_anisotropy();
    seen base = look(f), now;
    set(f, "rie.A", 0.96); /* mask, time and wall */
    ((fw_quantity *)fw_process_flow_quantity(f, "rie.A"))->uncertainty = 0.004;
    now = look(f);
    assert_true(moved(base.bias_m, now.bias_m) && moved(base.nominal_s, now.nominal_s));
    assert_true(moved(base.flare_m, now.flare_m) && moved(base.edge_slope, now.edge_slope));
    f = with_known_anisotropy();
    set(f, "rie.overetch", 0.2);
    now = look(f);
    assert_true(moved(base.bias_m, now.bias_m) && moved(base.stop_s, now.stop_s));
    assert_true(moved(base.edge_slope, now.edge_slope) && moved(base.nominal_s, now.nominal_s));
    f = with_known_anisotropy();
    set(f, "rie.S", 0.2);
    now = look(f);
    assert_true(moved(base.bias_m, now.bias_m) && moved(base.nominal_s, now.nominal_s));
    assert_true(moved(base.edge_slope, now.edge_slope));
    /* the aluminium moves the plate, not what stands under it */
    f = with_known_anisotropy();
    set(f, "al.d", 1.2e-6);
    now = look(f);
    assert_relative(now.bias_m - base.bias_m, 1.1 * 0.2e-6, 1e-9);
    assert_near(now.nominal_s, base.nominal_s, 0);
    assert_near(now.flare_m, base.flare_m, 0);
    assert_relative(step_of(f, "S14")->time.nominal_s, 1200, 1e-12);
    assert_relative(f->edges.cls[0].plate_m, 10e-6 - 2 * now.bias_m, 1e-12);
    /* the rate of the etch: its time alone, as depths do not know it */
    f = with_known_anisotropy();
    set(f, "rie.R", 2 * fw_process_flow_quantity(f, "rie.R")->value);
    now = look(f);
    assert_relative(now.nominal_s, 0.5 * base.nominal_s, 1e-13);
    assert_near(now.bias_m, base.bias_m, 0);
}

/* the run sheet's widths of the narrowest flexure are the drawn one and twice either edge */
static void widths_that_are_said(void **state) {
    (void)state;
    fw_process_flow *f = with_known_anisotropy();
    const char *at = NULL, *words = "the narrowest flexure is ";
    look(f);
    for (int i = 0; i < f->nreason && !at; i++)
        at = strstr(f->reason[i], words);
    double top, bottom, ratio, w = 1e6 * plain_facts.deepest_hinge_width_m;
    assert_non_null(at);
    assert_int_equal(sscanf(at + strlen(words),
                            "%lf um wide at the top and %lf um at the bottom: its stiffness is %lf",
                            &top, &bottom, &ratio),
                     3);
    const fw_process_edge e = f->edges.cls[f->edges.field].edge;
    assert_near(top, w + 2e6 * e.top_m, 6e-3);
    assert_near(bottom, w + 2e6 * e.bottom_m, 6e-3);
    assert_true(fabs(top - bottom) > 0.5);
    /* I of a trapezium about its own centroid, over that of the rectangle */
    double I = (top + bottom) * (top * top + bottom * bottom) / 4;
    assert_relative(ratio, I / (w * w * w), 5e-3);
}

/* ---- refusals ---- */

/* what is proposed, the whole flow does not refuse; a little less it does */
static void a_proposal_is_accepted_and_least(fw_process_flow *f, fw_process_mask_facts facts) {
    double gap = f->nearest_gap_m, A = f->nearest_anisotropy;
    double was = fw_process_flow_quantity(f, "rie.A")->value;
    assert_true(gap > facts.narrowest_slot_m && !(A <= was));
    for (int enough = 0; enough < 2; enough++) {
        fw_process_mask_facts with = facts;
        with.narrowest_slot_m = enough ? gap : gap - 0.2e-6;
        assert_int_equal(fw_process_flow_compute(arena, f, &with, &diags), FW_OK);
        assert_int_equal(f->manufacturable != 0 && !f->tight, enough);
        if (isnan(A)) continue;
        set(f, "rie.A", enough ? A : A - 3e-4);
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        assert_int_equal(f->manufacturable != 0 && !f->tight, enough);
        set(f, "rie.A", was);
    }
}

static void no_solution_names_the_gap_and_a_change(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    fw_process_mask_facts facts = plain_facts;
    facts.narrowest_slot_m = 3e-6;
    set(f, "rie.A", 0.93);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_false(f->edges.solved);
    assert_int_equal(f->manufacturable, 0);
    assert_true(told(181));
    assert_true(reason(f, "narrows the narrowest slot (3 um drawn)"));
    assert_true(reason(f, "openings at least"));
    assert_true(isnan(f->nearest_anisotropy)); /* with a straight wall it could not be printed */
    assert_false(step_of(f, "S18")->time.computable);
    a_proposal_is_accepted_and_least(f, facts);
}

static void lithography_cannot_open_what_is_left(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    fw_process_mask_facts facts = plain_facts;
    facts.narrowest_slot_m = 5.2e-6;
    set(f, "rie.A", 0.97);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_true(f->edges.solved && f->edges.cls[0].plate_m > 0);
    assert_true(told(182) && !told(181));
    assert_int_equal(f->manufacturable, 0);
    assert_true(reason(f, "Nearest change: openings at least"));
    a_proposal_is_accepted_and_least(f, facts);
    /* nor do the rules of the mask refuse what is proposed */
    facts.least_space_m = 9e-6;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    const double gap = f->nearest_gap_m;
    assert_true(isnan(f->nearest_anisotropy)); /* no wall makes 9 um of the 5.2 um that are drawn */
    facts.narrowest_slot_m = gap;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_true(gap - 2.0 * f->bias_m >= facts.least_space_m && gap - 2.0 * f->bias_m < facts.least_space_m + 0.2e-6);
    /* ... nor those of lines, which no width of an opening makes wider */
    facts.narrowest_slot_m = 5.2e-6;
    facts.least_space_m = 0.0;
    facts.least_width_m = facts.narrowest_line_m + 1e-3;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_true(isnan(f->nearest_gap_m) && isnan(f->nearest_anisotropy));
    assert_true(reason(f, "no width of the openings alone is enough"));
}

/* ---- what is proposed is drawn, by whoever can ---- */

typedef struct drawing {
    double least_m; /* an opening that has a mask */
    double steep;   /* likewise an anisotropy */
    const fw_process_flow *flow;
    bool outlines;
    int times;
} drawing;

static fw_status draws(void *context, double gap_m, double thickness_m, fw_process_redrawn *answer, char *why, size_t n) {
    drawing *d = context;
    const bool has = gap_m > 0.0 ? gap_m >= d->least_m : fw_process_flow_quantity(d->flow, "rie.A")->value >= d->steep;
    (void)thickness_m;
    d->times++;
    *answer = has ? FW_REDRAWN_MADE : d->outlines ? FW_REDRAWN_UNDECIDED : FW_REDRAWN_REFUSED;
    snprintf(why, n, "its corner %d", d->times);
    return FW_OK;
}

/* The next width and the next anisotropy that have a mask are found to their last digit; where none has one, that is said with
   what refuses the first; and where nobody can draw it, that. */
static void the_next_change_that_can_be_drawn(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    fw_process_mask_facts facts = plain_facts;
    drawing d = {.flow = f};
    const fw_process_redraw by = {.judge = draws, .context = &d}, none = {.judging = true};
    facts.narrowest_slot_m = 5.2e-6;
    set(f, "rie.A", 0.97);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    const double alone = f->nearest_gap_m, steep = f->nearest_anisotropy;
    assert_true(alone > 0.0 && steep > 0.97);
    facts.redraw = &by;
    for (int more = 0; more < 40; more += more < 8 ? 1 : 9) {
        d.least_m = alone + 1e-7 * more - 1e-9, d.steep = fmin(steep + 1e-4 * more, 1.0) - 1e-7, d.times = 0;
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        assert_near(f->nearest_gap_m, alone + 1e-7 * more, 1e-12);
        assert_near(f->nearest_anisotropy, fmin(steep + 1e-4 * more, 1.0), 1e-9);
        assert_true(d.times <= 2 + 2 * 12);
        assert_false(f->nearest_undrawn);
    }
    d.least_m = d.steep = 1.0, d.times = 0, d.steep = 2.0;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_true(isnan(f->nearest_gap_m) && isnan(f->nearest_anisotropy));
    assert_true(reason(f, "no width of the openings alone is enough (drawn with openings of "));
    assert_true(reason(f, "it is refused by its corner 1)"));
    d.outlines = true;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_near(f->nearest_gap_m, alone, 1e-12);
    assert_true(f->nearest_undrawn && reason(f, "between outlines, and were not drawn anew"));
    facts.redraw = &none; /* of one that is being drawn nothing is proposed */
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_false(f->nearest_known);
}

/* The over-etch that is proposed where a slot stays closed is one with which the whole flow refuses nothing, and a hundredth
   less is not enough; where a longer etch is through the aluminium before, there is none, and that is said. */
static void an_over_etch_is_proposed_that_is_enough(void **state) {
    (void)state;
    for (int harm = 0; harm < 2; harm++) {
        fw_process_flow *f = flow_of(SILICON);
        fw_process_mask_facts facts = plain_facts;
        facts.narrowest_slot_m = 6e-6;
        ((fw_quantity *)fw_process_flow_quantity(f, "rie.S"))->status = FW_ASSUMED;
        set(f, "rie.A", 1.0);
        set(f, "rie.selectivity", harm ? 56.0 : 1000.0);
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        assert_true(reason(f, "does not come through in step S18"));
        assert_int_equal(f->manufacturable, -1);
        assert_near(fw_process_flow_quantity(f, "rie.overetch")->value, 0.1, 1e-15);
        const double proposed = f->nearest_overetch;
        assert_int_equal(isnan(proposed), harm);
        assert_int_equal(reason(f, "no over-etch alone is enough"), harm);
        for (int enough = 0; enough < 2 && !harm; enough++) {
            set(f, "rie.overetch", enough ? proposed : proposed - 0.02);
            assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
            assert_int_equal(reason(f, "does not come through"), !enough);
            assert_int_equal(f->manufacturable, -1);
        }
    }
}

/* a device layer that is proposed for a mould fits into it, and the flow refuses nothing then */
static void a_layer_is_proposed_that_fits(void **state) {
    (void)state;
    for (int narrow = 0; narrow < 2; narrow++) {
        fw_process_flow *f = flow_of(COPPER);
        fw_process_mask_facts facts = plain_facts;
        facts.device_thickness_m = 20e-6;
        if (narrow) facts.narrowest_slot_m = 0.5e-6; /* which no layer makes printable */
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        assert_int_equal(f->manufacturable, 0);
        assert_int_equal(reason(f, "Nearest change: a device layer of 12.3 um, or a thicker resist"), !narrow);
        assert_int_equal(reason(f, "do not fit into a mould of 16 um. Nearest change: a thicker resist"), narrow);
        facts.device_thickness_m = f->nearest_layer_m;
        if (narrow) continue;
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        assert_true(f->manufacturable != 0);
    }
}

/* a laboratory that plans for wide openings: a narrow slot is not through, which a measured lag
   makes a no */
static void a_time_for_wide_openings_leaves_slots_closed(void **state) {
    (void)state;
    for (int measured = 0; measured < 2; measured++) {
        size_t n = 0, nb = 0;
        const char *text = pack_text(arena, SILICON, &n), *base = pack_text(arena, "base", &nb);
        text = replaced(
            arena, text,
            "<time law=\"arde\" shape=\"slot\" overrun=\"rie.overetch\" k=\"2\" id=\"rie.t-planned\" "
            "pulse=\"rie.part\" pause=\"rie.break\"><arg name=\"depth\"",
            "<time law=\"rate\" overrun=\"0.05\" k=\"2\" id=\"rie.t-planned\">"
            "<arg name=\"thickness\" q=\"si.d\"/>"
            "<arg name=\"rate\" q=\"rie.R\"/></time><derive name=\"slot\" unit=\"min\" "
            "law=\"arde\">"
            "<arg name=\"depth\"",
            &n);
        text = replaced(arena, text, "q=\"rie.A-reference\"/></time>",
                        "q=\"rie.A-reference\"/></derive>", &n);
        fw_process_flow *f = NULL;
        diags = fw_diags_new(arena);
        assert_int_equal(
            fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", text, n, &diags, &f),
            FW_OK);
        ((fw_quantity *)fw_process_flow_quantity(f, "rie.S"))->status =
            measured ? FW_MEASURED : FW_ASSUMED;
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        assert_true(told(183));
        assert_true(f->edges.cls[0].over_etch < 0 && !f->edges.cut[0].follows);
        assert_relative(f->edges.cut[0].etched_m, 52.5e-6, 1e-12);
        assert_true(reason(f, "does not come through in step S18: it needs 1.098 times"));
        assert_int_equal(f->manufacturable, measured ? 0 : -1);
        assert_relative(step_of(f, "S18")->time.nominal_s, 5400, 1e-12);
        /* the time does not need the lag, nor does what it undercuts; only slots are open */
        set(f, "rie.S", (double)NAN);
        set(f, "rie.A", 0.98);
        const fw_process_fixed_point *p = solved(f, &plain_facts);
        assert_true(p->solved && !p->open);
        assert_relative(p->etch_m, 0.02 * (52.5e-6 + 2.5e-6) / 2, 1e-12);
        assert_true(isnan(p->cls[0].over_etch));
    }
}

/* a guess is shown and judged, and neither time nor bias rests on it; as of a step of the law rate
 */
static void a_guessed_lag_is_not_planned_with(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    ((fw_quantity *)fw_process_flow_quantity(f, "rie.S"))->status = FW_ASSUMED;
    set(f, "rie.A", 0.95);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_relative(step_of(f, "S18")->time.nominal_s, 5400.0, 1e-12);
    assert_false(f->edges.cut[0].own || f->edges.cut[0].follows);
    assert_relative(f->edges.cut[0].etched_m, 55e-6, 1e-12);
    assert_true(reason(f, "would need"));
    assert_true(f->edges.cls[0].over_etch < 0.1); /* less than wide openings get */
    for (int i = 0; i < step_of(f, "S18")->time.ncontribution; i++)
        assert_null(strstr(step_of(f, "S18")->time.contribution[i], "probability"));
}

static void a_flexure_that_the_etch_takes_is_said(void **state) {
    (void)state;
    fw_process_flow *f = flow_of(SILICON);
    fw_process_mask_facts facts = plain_facts;
    facts.narrowest_slot_m = 40e-6;
    facts.deepest_hinge_width_m = facts.narrowest_line_m = 4e-6;
    set(f, "rie.A", 0.90);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_true(f->edges.solved && told(184));
    assert_int_equal(f->manufacturable, 0);
}

/* ---- a third flow, of XML alone: an oxide mask opened by an etch of its own ---- */

static const char third[] =
    "<process xmlns=\"urn:flexwright:process:1\" id=\"third\" version=\"1\" title=\"t\" "
    "material=\"silicon-100\" thickness=\"d\"><source id=\"lab\" kind=\"measured\">log</source>"
    "<equipment id=\"e\" class=\"RIE\" capacity=\"1\">x</equipment>"
    "<q id=\"d\" value=\"25\" u=\"0\" unit=\"um\" status=\"measured\" src=\"lab\"/>"
    "<q id=\"ox\" value=\"2\" u=\"0\" unit=\"um\" status=\"measured\" src=\"lab\"/>"
    "<q id=\"R\" value=\"2\" u=\"0\" unit=\"um/min\" status=\"measured\" src=\"lab\"/>"
    "<q id=\"Aox\" value=\"0.9\" u=\"0.02\" unit=\"1\" status=\"measured\" src=\"lab\"/>"
    "<q id=\"A\" value=\"0.98\" u=\"0.005\" unit=\"1\" status=\"measured\" src=\"lab\"/>"
    "<q id=\"p\" unknown=\"true\" unit=\"Pa\" status=\"assumed\" src=\"lab\"/>"
    "<q id=\"c\" value=\"0.02\" u=\"0\" unit=\"1\" status=\"measured\" src=\"lab\"/>"
    "<q id=\"w\" value=\"-0.1\" u=\"0.05\" unit=\"um\" range=\"edge\" status=\"measured\" src=\"lab\"/>"
    "<q id=\"mask.narrowest-opening\" unknown=\"true\" unit=\"um\" status=\"derived\" src=\"lab\"/>"
    "<corner of=\"edge\" name=\"printed\" q=\"w\"/><corner of=\"anisotropy\" name=\"oxide\" "
    "q=\"Aox\"/><corner of=\"anisotropy\" name=\"silicon\" q=\"A\"/>"
    "<step id=\"T1\" op=\"dry-etch\" title=\"t\" equipment=\"e\" "
    "in-source=\"no\"><purpose>p</purpose>"
    "<change kind=\"add\" material=\"silicon-100\" thickness=\"d\"/>"
    "<change kind=\"add\" material=\"aluminium\" thickness=\"ox\"/>"
    "<change kind=\"remove\" material=\"aluminium\" thickness=\"ox\" where=\"field\" "
    "profile=\"anisotropic\" anisotropy=\"Aox\"/>"
    "<set name=\"pressure\" q=\"p\" tol-lo=\"\" tol-hi=\"\"/><time law=\"rate\" overrun=\"0.3\" k=\"2\">"
    "<arg name=\"thickness\" q=\"ox\"/><arg name=\"rate\" q=\"R\"/></time><endpoint>e</endpoint>"
    "<accept measure=\"m\" lo=\"\" hi=\"\" unit=\"1\" sites=\"1\" every=\"1\"/>"
    "<on-fail if=\"x\" then=\"hold\">y</on-fail></step>"
    "<step id=\"T2\" op=\"dry-etch\" title=\"t\" equipment=\"e\" "
    "in-source=\"no\"><purpose>p</purpose>"
    "<change kind=\"remove\" material=\"silicon-100\" thickness=\"d\" where=\"field\" "
    "profile=\"anisotropic\" anisotropy=\"A\" compensate=\"top\"/>"
    "<set name=\"pressure\" q=\"p\" tol-lo=\"\" tol-hi=\"\"/>"
    "<time law=\"arde\" shape=\"linear\" overrun=\"0.2\" k=\"2\"><arg name=\"depth\" q=\"d\"/>"
    "<arg name=\"rate\" q=\"R\"/><arg name=\"width\" q=\"mask.narrowest-opening\"/>"
    "<arg name=\"lag\" q=\"c\"/></time><endpoint>e</endpoint>"
    "<accept measure=\"m\" lo=\"\" hi=\"\" unit=\"1\" sites=\"1\" every=\"1\"/>"
    "<on-fail if=\"x\" then=\"hold\">y</on-fail></step></process>";

static void a_third_flow_needs_no_code(void **state) {
    (void)state;
    size_t nb = 0;
    const char *base = pack_text(arena, "base", &nb);
    fw_process_flow *f = NULL;
    fw_status status = fw_process_flow_read(arena, "base.xml", base, nb, "third.xml", third,
                                            sizeof third - 1, &diags, &f);
    for (size_t i = 0; status != FW_OK && i < diags.count; i++)
        print_message("%s\n", diags.item[i].message);
    assert_int_equal(status, FW_OK);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    /* foot of the oxide: (1 - 0.9) 0.3 2 um; top of the silicon: 0.02 1.2 (25 + c D^2/2w) um */
    double m = 0, D = 25e-6;
    for (int i = 0; i < 100; i++)
        m = 0.1 * 0.3 * 2e-6 + 0.02 * 1.2 * (D + 0.02 * D * D / (2 * (10e-6 - 2 * m)));
    assert_relative(f->edges.etch_m, m, 1e-12);
    assert_relative(f->bias_m, m + 0.1e-6, 1e-12);
    assert_near(f->edges.cls[f->edges.field].edge.top_m, 0, 1e-18);
    assert_relative(step_of(f, "T2")->time.nominal_s,
                    60 * (D + 0.02 * D * D / (2 * (10e-6 - 2 * m))) / 2e-6, 1e-12);
    fw_mechanism_variant v = {.material.youngs = {.value = 150e9}, .thickness_m = D};
    const fw_verdict_fabrication_input *in;
    int n;
    assert_int_equal(fw_process_flow_fabricated(arena, f, &plain_facts, &v, &in, &n), FW_OK);
    assert_int_equal(n, 3);
    assert_relative(in[1].edge_m, 0.3 * 2e-6, 1e-12); /* the oxide's foot moves edges alone */
    assert_near(in[1].flare_m, 0, 0);
    assert_relative(in[1].even, 0.9, 1e-12);
    assert_near(in[2].edge_m * (in[2].nominal - in[2].even),
                f->edges.cls[f->edges.field].edge.middle_m, 1e-17);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {TEST(the_two_biases_of_the_silicon_flow),
                                       TEST(narrow_slots_of_the_source),
                                       TEST(needed_anisotropy),
                                       TEST(newton_finds_what_plain_iteration_finds),
                                       TEST(the_fold_is_where_it_is_said_to_be),
                                       TEST(unknown_stays_unknown),
                                       TEST(what_is_known_of_printing_is_taken_back),
                                       TEST(copper_copies_its_mould),
                                       TEST(perturb_one_and_look),
                                       TEST(widths_that_are_said),
                                       TEST(no_solution_names_the_gap_and_a_change),
                                       TEST(lithography_cannot_open_what_is_left),
                                       TEST(the_next_change_that_can_be_drawn),
                                       TEST(an_over_etch_is_proposed_that_is_enough),
                                       TEST(a_layer_is_proposed_that_fits),
                                       TEST(a_time_for_wide_openings_leaves_slots_closed),
                                       TEST(a_guessed_lag_is_not_planned_with),
                                       TEST(a_flexure_that_the_etch_takes_is_said),
                                       TEST(a_third_flow_needs_no_code)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
