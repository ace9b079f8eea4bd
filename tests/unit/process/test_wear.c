/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the removal of the seed, and a release, take of the copper: bias, films and verdict have the same number. */
#include "pack_fixture.h"
#include "process/films.h"
#include "process/process.h"

static fw_process_flow *copper(double seed_m, double rate) {
    fw_process_flow *f = read_pack(arena, COPPER, NULL, NULL, &diags);
    if (seed_m > 0.0) measured(f, "seed.d", seed_m, 0.1 * seed_m);
    if (rate > 0.0) measured(f, "seed.R", rate, 0.3 * rate);
    return f;
}

static fw_process_wear wear_of(const fw_process_flow *f) {
    fw_process_wear w;
    assert_int_equal(fw_process_flow_wear(arena, f, (double)NAN, &w), FW_OK);
    return w;
}

/* The rate of the seed's etch cancels in what is lost: 0.3 um and 20 % over-etch take 0.36 um, with or without it. Its error
   does not: the planned time takes 30 % more where the etch is 30 % faster. A time that ends with the seed takes what that
   was. */
static void loss(void **state) {
    (void)state;
    fw_process_wear w = wear_of(copper(0.3e-6, 0.0));
    assert_near(w.loss_m, 0.36e-6, 1e-21);
    assert_near(w.uncertainty_m, 0.036e-6, 1e-21);
    assert_null(w.missing);
    w = wear_of(copper(0.3e-6, 5e-9));
    assert_near(w.loss_m, 0.36e-6, 1e-21);
    assert_near(w.uncertainty_m, 0.108e-6, 1e-21);
    fw_process_flow *thick = copper(0.3e-6, 5e-9); /* known worse than the rate */
    measured(thick, "seed.d", 0.3e-6, 0.12e-6);
    assert_near(wear_of(thick).uncertainty_m, 0.144e-6, 1e-21);
    w = wear_of(copper(0.0, 5e-9));
    assert_string_equal(w.missing, "seed.d");
    assert_near(w.loss_m, 0.0, 0);
    assert_string_equal(w.step->id, "C25");
    /* another rate for the plated copper: 0.36 um times 2/5, errors in quadrature */
    fw_process_flow *f = copper(0.3e-6, 5e-9);
    fw_quantity own = {.id = "own", .value = 2e-9, .uncertainty = 0.4e-9};
    step_of(f, "C25")->exposed[0].rate = &own;
    w = wear_of(f);
    assert_near(w.loss_m, 0.36e-6 * 0.4, 1e-21);
    assert_relative(w.uncertainty_m, w.loss_m * sqrt(0.01 + 0.04 + 0.09), 1e-12);
    /* none in silicon */
    assert_null(wear_of(read_pack(arena, SILICON, NULL, NULL, &diags)).step);
}

/* the mask adds it, the walls end where they are drawn, the layer ends thinner */
static void mask_and_films(void **state) {
    (void)state;
    fw_process_flow *plain = copper(0.0, 0.0), *f = copper(0.3e-6, 5e-9);
    assert_int_equal(fw_process_flow_compute(arena, plain, &plain_facts, &diags), FW_OK);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_true(plain->edges.wear.missing && !f->edges.wear.missing);
    assert_near(f->bias_m - plain->bias_m, 0.36e-6, 1e-20);
    assert_near(f->edges.cls[f->edges.field].edge.middle_m, 0.0, 1e-20);
    assert_non_null(strstr(f->bias_note, "step C25 takes 0.36 um"));
    /* and the widths that are accepted lie between the ends of what it may take: as far as a verdict judges them */
    const fw_process_edge_class *c = &f->edges.cls[f->edges.field],
                                *of = &plain->edges.cls[plain->edges.field];
    double least, most;
    fw_process_wear_range(&f->edges.wear, &least, &most);
    assert_near(least, 0.36e-6 - 0.216e-6, 1e-20);
    assert_true(most >= 0.36e-6 + 0.216e-6 - 1e-20);
    assert_near(of->low.top_m - c->low.top_m, most - 0.36e-6, 1e-20);
    assert_near(c->high.bottom_m - of->high.bottom_m, 0.36e-6 - least, 1e-20);
    bool said = false;
    for (int i = 0; i < plain->nreason; i++)
        said = said || strstr(plain->reason[i], "not known (seed.d)");
    assert_true(said);
    fw_process_films films;
    assert_int_equal(fw_process_flow_films(arena, f, f->nstep - 1, &films), FW_OK);
    for (int i = 0; i < films.n; i++) {
        if (strcmp(films.film[i].material, "copper-plated") != 0) continue;
        assert_near(films.film[i].foot_m, 0.0, 1e-18);
        assert_near(films.film[i].head_m, 0.0, 1e-18);
        assert_near(films.film[i].thickness_m, 9e-6 - 0.36e-6, 1e-18);
    }
}

/* the recipe says the same of the step: what is lost, and how exactly that is known */
static void said(void **state) {
    (void)state;
    fw_process_flow *f = copper(0.3e-6, 5e-9);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    const fw_process_wear w = wear_of(f);
    const fw_process_step *s = step_of(f, "C25");
    bool found = false;
    for (int i = 0; i < s->nderived; i++) {
        if (strncmp(s->derived[i]->id, "lost of the open", 16) != 0) continue;
        assert_relative(s->derived[i]->value, w.loss_m, 1e-12);
        assert_relative(s->derived[i]->uncertainty, w.uncertainty_m, 1e-9);
        found = true;
    }
    assert_true(found);
}

/* at the ends of its range edges and thickness differ by what was not foreseen */
static void verdict(void **state) {
    (void)state;
    fw_mechanism_variant v = {.thickness_m = 9e-6};
    const fw_verdict_fabrication_input *in;
    int n, m;
    assert_int_equal(fw_process_flow_fabricated(arena, copper(0.0, 0.0), &plain_facts, &v, &in, &m),
                     FW_OK);
    assert_int_equal(
        fw_process_flow_fabricated(arena, copper(0.3e-6, 5e-9), &plain_facts, &v, &in, &n), FW_OK);
    assert_int_equal(n, m + 1);
    const fw_verdict_fabrication_input *w = &in[n - 1];
    assert_near(w->low, 0.144e-6, 1e-20);
    /* 0.576 um by what the rate is off by; where the step runs to its stop time, which holds what the seed is off by, too, more */
    assert_near(w->high, 0.36e-6 * (1.0 + 2.0 * hypot(0.1, 0.3)), 1e-20);
    double x[FW_FABRICATION_INPUTS];
    for (int i = 0; i < n; i++)
        x[i] = in[i].nominal;
    fw_verdict_fabrication nominal = fw_verdict_fabrication_at(in, n, x), worst;
    x[n - 1] = w->high;
    worst = fw_verdict_fabrication_at(in, n, x);
    assert_near(worst.edge_m - nominal.edge_m, 0.36e-6 - w->high, 1e-20);
    assert_near(worst.thickness_ratio - nominal.thickness_ratio, (0.36e-6 - w->high) / 9e-6, 1e-12);
    x[n - 1] = 0.0;
    assert_near(nominal.thickness_ratio - fw_verdict_fabrication_at(in, n, x).thickness_ratio,
                -0.36 / 9.0, 1e-12);
}

/* ---- what a release takes of the device while it frees it ---- */

#define WAY 50e-6

static const fw_release *way_of(double needed_m) {
    fw_release *r = fw_arena_one(arena, fw_release);
    r->part = fw_arena_array(arena, fw_release_part, 1);
    r->npart = 1, r->weakest = -1, r->needed_m = needed_m, r->lost_m = 1.0;
    r->part[0] = (fw_release_part){.duty = FW_RELEASE_MOVES, .area_m2 = 1e-8, .reach_m = needed_m};
    return r;
}

/* the porous silicon at 1 um/min, the copper meanwhile at so many um/min or by a selectivity */
static fw_process_flow *released(const char *exposed, double taken_um_min, double lateral_um_min) {
    static const char change[] =
        "<change kind=\"remove\" material=\"porous-silicon\" reach=\"release.reach\"/>";
    fw_process_flow *f =
        read_pack(arena, COPPER, change, fw_arena_printf(arena, "%s%s", change, exposed), &diags);
    assert_non_null(f);
    measured(f, "seed.d", 0.3e-6, 0.03e-6);
    measured(f, "seed.R", taken_um_min * 1e-6 / 60.0, 0.0);
    measured(f, "release.R", lateral_um_min * 1e-6 / 60.0, 0.0);
    return f;
}

static fw_process_mask_facts drawn(void) {
    fw_process_mask_facts facts = plain_facts;
    facts.release = way_of(WAY);
    return facts;
}

/* Walls stand out by what they are to lose, a, and the etch begins so much further out: a = r (way + a) 1.2/R. Mask, time,
   films and verdict have that number, in the first pass as in a second one. */
static void release_takes(void **state) {
    (void)state;
    const double r = 0.1, R = 1.5, share = 1.2 * r / R;
    const fw_process_mask_facts facts = drawn();
    fw_process_flow *f = released("<exposed material=\"copper-plated\" rate=\"seed.R\"/>", r, R);
    fw_process_flow *plain = released("", r, R);
    const fw_verdict_fabrication_input *in;
    fw_mechanism_variant v = {.thickness_m = 9e-6};
    int n;
    assert_true(fw_process_flow_wears_by_reach(f));
    assert_false(fw_process_flow_wears_by_reach(plain));
    assert_int_equal(fw_process_flow_fabricated(arena, f, &facts, &v, &in, &n), FW_OK);
    const double by_verdict = in[n - 1].nominal;
    assert_int_equal(fw_process_flow_compute(arena, plain, &facts, &diags), FW_OK);
    for (int pass = 0; pass < 2; pass++) {
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        const double way = WAY + plain->release_foot_m, a = share * way / (1.0 - share);
        assert_relative(f->edges.wear.after_m, a, 1e-12);
        assert_near(f->edges.wear.loss_m, 0.36e-6 + a, 1e-18);
        assert_near(by_verdict, 0.36e-6 + a, 1e-18);
        assert_near(f->bias_m - plain->bias_m, a, 1e-18);
        assert_relative(step_of(f, "C26")->time.nominal_s, (way + a) / (R * 1e-6 / 60.0), 1e-12);
        assert_non_null(strstr(f->bias_note, "takes"));
    }
    fw_process_films films;
    assert_int_equal(fw_process_flow_films(arena, f, f->nstep - 1, &films), FW_OK);
    for (int i = 0; i < films.n; i++)
        if (strcmp(films.film[i].material, "copper-plated") == 0)
            assert_near(films.film[i].foot_m, 0.0, 1e-16);
}

/* by a selectivity it goes by how far the etch runs, not by how thick the layer below is */
static void release_takes_by_selectivity(void **state) {
    (void)state;
    const fw_process_mask_facts facts = drawn();
    fw_process_flow *f =
        released("<exposed material=\"copper-plated\" selectivity=\"rinse.ratio\"/>", 0.1, 1.5);
    fw_quantity S = {.id = "S", .value = 20.0, .uncertainty = 2.0};
    step_of(f, "C26")->exposed[0].selectivity = &S;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    const double share = 1.2 / 20.0, way = WAY + f->release_foot_m - f->edges.wear.after_m;
    assert_relative(f->edges.wear.after_m, share * way / (1.0 - share), 1e-9);
}

static const char *refused_by(const fw_process_flow *f, const char *words) {
    for (int i = 0; i < f->nreason; i++)
        if (strstr(f->reason[i], words)) return f->manufacturable == 0 ? f->reason[i] : NULL;
    return NULL;
}

/* what is taken as fast as it is freed has no reach that is enough; nothing of it is applied, and it is refused */
static void never_free(void **state) {
    (void)state;
    const fw_process_mask_facts facts = drawn();
    fw_process_flow *f =
        released("<exposed material=\"copper-plated\" rate=\"seed.R\"/>", 1.3, 1.5);
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    assert_non_null(refused_by(f, "as fast as it is freed"));
}

/* a time that the mask alone gives is known too late for the mask: refused by name */
static void time_of_the_mask(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(
        arena, COPPER,
        "<time law=\"rate\" overrun=\"0.2\" k=\"2\"><arg name=\"thickness\" q=\"seed.d\"/>",
        "<time law=\"rate\" overrun=\"0.2\" k=\"2\"><arg name=\"thickness\" "
        "q=\"mask.narrowest-slot\"/>",
        &diags);
    assert_non_null(f);
    measured(f, "seed.R", 5e-9, 0.0);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_non_null(refused_by(f, "mask.narrowest-slot"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(loss, setup, teardown),
        cmocka_unit_test_setup_teardown(mask_and_films, setup, teardown),
        cmocka_unit_test_setup_teardown(said, setup, teardown),
        cmocka_unit_test_setup_teardown(verdict, setup, teardown),
        cmocka_unit_test_setup_teardown(release_takes, setup, teardown),
        cmocka_unit_test_setup_teardown(release_takes_by_selectivity, setup, teardown),
        cmocka_unit_test_setup_teardown(never_free, setup, teardown),
        cmocka_unit_test_setup_teardown(time_of_the_mask, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
