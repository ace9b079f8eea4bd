/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the removal of the seed takes of the copper: bias, films and verdict have the same number.
 */
#include "pack_fixture.h"
#include "process/films.h"
#include "process/process.h"

static fw_process_flow *copper(double seed_m, double rate) {
    fw_process_flow *f = read_pack(arena, COPPER, NULL, NULL, &diags);
    if (seed_m > 0.0) measured(f, "seed.d", seed_m, 0.1 * seed_m);
    if (rate > 0.0) measured(f, "seed.R", rate, 0.3 * rate);
    return f;
}

/* The rate of the seed's etch cancels in what is lost: 0.3 um and 20 % over-etch take 0.36 um, with or without it. Its error
   does not: the planned time takes 30 % more where the etch is 30 % faster. A time that ends with the seed takes what that
   was. */
static void loss(void **state) {
    (void)state;
    fw_process_wear w = fw_process_flow_wear(copper(0.3e-6, 0.0));
    assert_near(w.loss_m, 0.36e-6, 1e-21);
    assert_near(w.uncertainty_m, 0.036e-6, 1e-21);
    assert_null(w.missing);
    w = fw_process_flow_wear(copper(0.3e-6, 5e-9));
    assert_near(w.loss_m, 0.36e-6, 1e-21);
    assert_near(w.uncertainty_m, 0.108e-6, 1e-21);
    fw_process_flow *thick = copper(0.3e-6, 5e-9); /* known worse than the rate */
    measured(thick, "seed.d", 0.3e-6, 0.12e-6);
    assert_near(fw_process_flow_wear(thick).uncertainty_m, 0.144e-6, 1e-21);
    w = fw_process_flow_wear(copper(0.0, 5e-9));
    assert_string_equal(w.missing, "seed.d");
    assert_near(w.loss_m, 0.0, 0);
    assert_string_equal(w.step->id, "C25");
    /* another rate for the plated copper: 0.36 um times 2/5, errors in quadrature */
    fw_process_flow *f = copper(0.3e-6, 5e-9);
    fw_quantity own = {.id = "own", .value = 2e-9, .uncertainty = 0.4e-9};
    step_of(f, "C25")->exposed[0].rate = &own;
    w = fw_process_flow_wear(f);
    assert_near(w.loss_m, 0.36e-6 * 0.4, 1e-21);
    assert_relative(w.uncertainty_m, w.loss_m * sqrt(0.01 + 0.04 + 0.09), 1e-12);
    /* none in silicon */
    assert_null(fw_process_flow_wear(read_pack(arena, SILICON, NULL, NULL, &diags)).step);
}

/* the mask adds it, the walls end where they are drawn, the layer ends thinner */
static void mask_and_films(void **state) {
    (void)state;
    fw_process_flow *plain = copper(0.0, 0.0), *f = copper(0.3e-6, 5e-9);
    assert_int_equal(fw_process_flow_compute(arena, plain, &plain_facts, &diags), FW_OK);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    assert_true(plain->edges.worn_open && !f->edges.worn_open);
    assert_near(f->bias_m - plain->bias_m, 0.36e-6, 1e-20);
    assert_near(f->edges.cls[f->edges.field].edge.middle_m, 0.0, 1e-20);
    assert_non_null(strstr(f->bias_note, "step C25 takes 0.36 um"));
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
    const fw_process_wear w = fw_process_flow_wear(f);
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
    assert_near(w->high, 0.576e-6, 1e-20);
    double x[FW_FABRICATION_INPUTS];
    for (int i = 0; i < n; i++)
        x[i] = in[i].nominal;
    fw_verdict_fabrication nominal = fw_verdict_fabrication_at(in, n, x), worst;
    x[n - 1] = w->high;
    worst = fw_verdict_fabrication_at(in, n, x);
    assert_near(worst.edge_m - nominal.edge_m, -0.216e-6, 1e-20);
    assert_near(worst.thickness_ratio - nominal.thickness_ratio, -0.216 / 9.0, 1e-12);
    x[n - 1] = 0.0;
    assert_near(nominal.thickness_ratio - fw_verdict_fabrication_at(in, n, x).thickness_ratio,
                -0.36 / 9.0, 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(loss, setup, teardown),
        cmocka_unit_test_setup_teardown(mask_and_films, setup, teardown),
        cmocka_unit_test_setup_teardown(said, setup, teardown),
        cmocka_unit_test_setup_teardown(verdict, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
