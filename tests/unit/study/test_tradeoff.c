/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole on devices whose answer is known from elsewhere. */
#include "study/tradeoff.h"
#include "test.h"
#include <flexwright.h>
#include <stdlib.h>

static fw_plan *plan_of(const char *file, const char *path, const char *value) {
    char name[600];
    const fw_device_set set = {path, value};
    fw_plan_options options = fw_plan_options_default();
    options.data_directory = FW_TEST_SOURCE_DIR;
    options.set = path ? &set : NULL;
    options.nset = path ? 1 : 0;
    fw_plan *plan = fw_plan_new(&options);
    assert_non_null(plan);
    snprintf(name, sizeof name, "%s/%s", FW_TEST_SOURCE_DIR, file);
    assert_int_equal(fw_plan_load(plan, name), FW_OK);
    return plan;
}

static const fw_study_tradeoff *run(fw_plan *plan, double budget_s) {
    const fw_study_tradeoff *t;
    const fw_study_tradeoff_options options = {.budget_s = budget_s};
    assert_int_equal(fw_study_tradeoff_run(plan, &options, &t), FW_OK);
    return t;
}

/* x, y, phi of AB BC CD DE EF at a time, from the quad-precision file */
static void quad(double t_ms, double phi[5]) {
    char line[4000];
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/sixbar_ref_0p1ms.txt", "r");
    assert_non_null(file);
    bool found = false;
    while (!found && fgets(line, sizeof line, file)) {
        char *at = line;
        if (line[0] == '#' || fabs(strtod(line, &at) - t_ms) > 1e-9) continue;
        for (int i = 0; i < 15; i++) {
            double x = strtod(at, &at);
            if (i % 3 == 2) phi[i / 3] = x;
        }
        found = true;
    }
    fclose(file);
    assert_true(found);
}

static const fw_study_tradeoff_curve *curve(const fw_study_tradeoff *t, const char *method,
                                            const char *integrator) {
    for (int i = 0; i < t->ncurve; i++)
        if (strcmp(t->curve[i].method, method) == 0 &&
            strcmp(t->curve[i].integrator, integrator) == 0)
            return &t->curve[i];
    fail_msg("no curve %s + %s", method, integrator);
    return NULL;
}

/* until 0.6 ms every angle of the six-bar grows, so that its peak is its end, which two independent
   quad-precision programs know to 18 digits: the command's own reference and every error that it
   states are compared with that */
static void reference_and_errors(void **state) {
    (void)state;
    double phi[5];
    quad(0.6, phi);
    const double want[6] = {phi[0],          phi[1] - phi[0], phi[2] - phi[1],
                            phi[3] - phi[2], phi[4] - phi[3], -phi[4]};
    double largest = 0;
    for (int i = 0; i < 6; i++)
        largest = fmax(largest, fabs(want[i]));
    fw_plan *plan = plan_of("tests/data/six-bar-benchmark.xml", "scene[step]/@duration", "0.6 ms");
    const fw_study_tradeoff *t = run(plan, 1);
    assert_true(t->reference.independent);
    assert_true(t->reference.error < 1e-10);
    int done = 0;
    for (int i = -2; i < t->npoint; i++) {
        const fw_study_tradeoff_point *p = i < 0 ? t->reference.run[i + 2] : &t->point[i];
        if (p->state != FW_TRADEOFF_DONE) continue;
        double off = 0;
        for (int k = 0; k < 6; k++)
            off = fmax(off, fabs(fabs(p->peak_rad[k]) - fabs(want[k])) / largest);
        if (i < 0)
            assert_true(off <= fmax(3 * t->reference.error, 1e-12));
        else
            assert_near(p->error, off, 3 * t->reference.error + 1e-12);
        done++;
    }
    assert_true(done > 60);
    fw_plan_free(plan);
}

/* orders as seen in the errors of the peaks against right-hand sides: rk4 with its fixed step to a
   tenth; those with error control follow their order, or a little more where the step control does
   better than it promises */
static void orders(void **state) {
    (void)state;
    fw_plan *plan = plan_of("tests/data/six-bar-benchmark.xml", "scene[step]/@duration", "3 ms");
    const fw_study_tradeoff *t = run(plan, 3);
    assert_near(curve(t, "chain", "rk4")->order, 4, 0.15);
    assert_near(curve(t, "chain", "dopri5")->order, 5, 1);
    assert_near(curve(t, "chain", "generalised-alpha")->order, 2, 0.4);
    assert_true(curve(t, "chain", "dop853")->order > 6.5);
    /* an estimate is honest where it is not below the error */
    assert_true(t->judged > 30);
    assert_int_equal(t->honest, t->judged);
    assert_true(t->digit_overall > 1 && t->digit_overall < 3);
    assert_true(t->cheapest >= 0 && t->over_cheapest >= 1 - 1e-12);
    /* every method solves the same equations, so that the same tolerance gives the same error;
       minimal has other coordinates, whose errors are others */
    const double own = t->point[curve(t, "chain", "dop853")->first].error;
    for (size_t m = 0; fw_multibody_method_at(m).name; m++) {
        const char *name = fw_multibody_method_at(m).name;
        const fw_study_tradeoff_point *p = &t->point[curve(t, name, "dop853")->first];
        if (p->state != FW_TRADEOFF_DONE) continue;
        if (strcmp(name, "minimal") == 0)
            assert_near(log10(p->error), log10(own), 0.5);
        else
            assert_relative(p->error, own, 0.01);
    }
    fw_plan_free(plan);
}

static void same_bytes(void **state) {
    (void)state;
    fw_text first = {0};
    fw_plan *plan[2];
    for (int i = 0; i < 2; i++) {
        plan[i] = plan_of("docs/mechanisms/toggle.xml", NULL, NULL);
        fw_text json = fw_text_new(plan[i]->arena);
        assert_int_equal(fw_study_tradeoff_json(run(plan[i], 1), &json), FW_OK);
        if (i == 0)
            first = json;
        else
            assert_string_equal(first.data, json.data);
    }
    fw_plan_free(plan[0]);
    fw_plan_free(plan[1]);
}

/* over the whole budget, pairs that are too dear say so, and nothing is run for much longer */
static void budget(void **state) {
    (void)state;
    fw_plan *plan = plan_of("docs/mechanisms/squeezer.xml", NULL, NULL);
    const fw_study_tradeoff *t = run(plan, 1);
    int skipped = 0;
    double sum = 0;
    for (int i = 0; i < t->npoint; i++) {
        skipped += t->point[i].state == FW_TRADEOFF_SKIPPED;
        if (t->point[i].state == FW_TRADEOFF_SKIPPED) assert_non_null(t->point[i].why);
        if (t->point[i].state == FW_TRADEOFF_DONE) sum += t->point[i].instructions;
    }
    assert_true(skipped > 0);
    assert_true(sum < 2.5e9);
    fw_plan_free(plan);
}

/* What is measured on a machine differs from run to run: of numbers made here the text says each as it is, rounded. */
static void measured_numbers_are_printed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device_scene scene = {.name = "turn"};
    fw_study_tradeoff_point point[3] = {
        {.method = "chain", .integrator = "dop853", .rtol = 1e-6, .error = 2.5e-7, .estimated = 4e-7, .utilisation_error = 3e-6,
         .instructions = 12.5e6, .by = FW_COUNT_CALLGRIND, .time = {1, 1, 1, 9, true}},
        {.method = "chain", .integrator = "rk4", .rtol = 1e-3, .error = 5e-5, .estimated = 6e-5, .utilisation_error = (double)NAN,
         .instructions = 3.25e6, .by = FW_COUNT_SCALED, .front = true, .floor = true, .time = {2.346, 2.2, 2.5, 7, true}},
        {.method = "minimal", .integrator = "dopri5", .rtol = 1e-9, .error = 1e-10, .estimated = 2e-10, .utilisation_error = 1e-9,
         .instructions = 98.7e6, .by = FW_COUNT_MODEL, .front = true, .time = {3, 1, 9, 5, false}},
    };
    fw_study_tradeoff_curve curve[3] = {{"chain", "dop853", 0, 1, 8.0, true, true}, {"chain", "rk4", 1, 1, 4.0, false, true},
                                        {"minimal", "dopri5", 2, 1, 5.0, true, false}};
    fw_study_tradeoff_model model[2] = {{.kind = "hinge", .name = "linear", .change = 1.26e-3, .bound = 2e-3, .instructions = 1.5e6, .chosen = true},
                                        {.kind = "solid", .name = "CalculiX", .state = FW_TRADEOFF_SKIPPED, .why = "not there"}};
    fw_study_tradeoff_mask mask[2] = {{.tolerance_m = 5e-9, .vertices = 1234, .bytes = 56789, .deflection = 3.5e-6, .usual = true},
                                      {.tolerance_m = 25e-9, .vertices = 321, .bytes = 9876, .deflection = 4.5e-5}};
    const fw_study_tradeoff t = {.device = "lever", .scene = &scene, .accuracy = 1e-3, .reference = {{&point[2], &point[1]}, 7e-9, 1e-8, false},
                                 .point = point, .npoint = 3, .curve = curve, .ncurve = 3, .cheapest = 1, .over_cheapest = 3.847, .digit_here = 1.52,
                                 .digit_overall = 1.73, .honesty = {1.2, 1.6, 2.0}, .least_honest = 1, .honest = 2, .judged = 3, .model = model,
                                 .nmodel = 2, .floor = 4.26e-4, .floor_what = "effects", .mask = mask, .nmask = 2, .chosen_cpu_s = 0.0123,
                                 .chosen_cpu_low_s = 0.0119, .chosen_cpu_high_s = 0.013};
    static const char want[] =
        "lever, scene turn: simulate takes chain + dop853 by itself; peak deflection off by 2.5e-07 where 1e-03 is wanted, in 12.3 ms of CPU\n"
        "one more digit costs x1.52 here, x1.73 on average over the front\n"
        "it costs x3.85 the cheapest that would have done: chain + rk4 at 1e-03\n"
        "digits below 4.3e-04 are meaningless: what the effects that were left out change is as large\n"
        "\n"
        "reference: minimal + dopri5 at 1e-09, against chain + rk4 at 1e-03: they differ by 7.0e-09 (not independent)\n"
        "\n"
        "  method                  integrator          rtol      error estimated   utilis.  M instr.  time, ratio\n"
        "  chain                   rk4                1e-03  < 5.0e-05   6.0e-05         -      3.25~        2.35\n"
        "* chain                   dop853             1e-06    2.5e-07   4.0e-07   3.0e-06     12.50         1.00\n"
        "  minimal                 dopri5             1e-09    1.0e-10   2.0e-10   1.0e-09     98.70?  -- (noisy)\n"
        "* by itself; all others: nothing is both cheaper and better. Instructions: counted, ~ scaled from a counted\n"
        "  tolerance, ? by the model of costs. < the reference is not known better\n"
        "\n"
        "cheapest within the accuracy\n"
        "  chain                   dop853             1e-06    2.5e-07   4.0e-07   3.0e-06     12.50         1.00\n"
        "  chain                   rk4                1e-03  < 5.0e-05   6.0e-05         -      3.25~        2.35\n"
        "  minimal                 dopri5             1e-09    1.0e-10   2.0e-10   1.0e-09     98.70?  -- (noisy)\n"
        "\n"
        "estimated errors: not below the true one in 2 of 3 settings; 1.2 to 2 times it, median 1.6; least of chain + rk4 at 1e-03\n"
        "\n"
        "  model                                    changes     bound      M instr.\n"
        "* hinge     linear                         1.3e-03   2.0e-03          1.50\n"
        "  solid     CalculiX                      - not there\n"
        "\n"
        "  mask, nm      vertices GDSII bytes    deflection\n"
        "* 5                 1234       56789   <   3.5e-06\n"
        "  25                 321        9876   <   4.5e-05\n";
    fw_text text = fw_text_new(arena);
    assert_int_equal(fw_study_tradeoff_text(&t, &text), FW_OK);
    assert_string_equal(text.data, want);
    fw_arena_free(arena);
}

/* the same through the library: order of calls, documents, twice */
static void library(void **state) {
    (void)state;
    static const char *const begins[] = {"{\n \"schema\": \"flexwright.tradeoff/1\"",
                                         "six-bar-benchmark, scene step", "kind,method,", "<?xml"};
    fw_design_options o = fw_design_options_default();
    const char *text;
    o.data_directory = FW_TEST_SOURCE_DIR;
    fw_design *d = fw_design_new(&o);
    assert_int_equal(fw_design_tradeoff(NULL, 1, 0), FW_STATUS_USAGE);
    assert_int_equal(fw_design_tradeoff(d, 1, 0), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read(d, FW_TEST_SOURCE_DIR "/tests/data/six-bar-benchmark.xml"),
                     FW_STATUS_OK);
    assert_int_equal(fw_design_tradeoff(d, 0.5, 0), FW_STATUS_USAGE);
    assert_int_equal(fw_design_tradeoff(d, (double)NAN, 0), FW_STATUS_USAGE);
    assert_int_equal(fw_design_document(d, FW_DOCUMENT_TRADEOFF_JSON, &text, NULL),
                     FW_STATUS_USAGE);
    assert_int_equal(fw_design_tradeoff(d, 1, 0), FW_STATUS_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(fw_design_document(d, FW_DOCUMENT_TRADEOFF_JSON + i, &text, NULL),
                         FW_STATUS_OK);
        assert_int_equal(strncmp(text, begins[i], strlen(begins[i])), 0);
    }
    assert_int_equal(fw_design_document(d, FW_DOCUMENT_DIAGNOSTICS_JSON + 1, &text, NULL),
                     FW_STATUS_USAGE);
    fw_design_free(d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_and_errors),
        cmocka_unit_test(orders),
        cmocka_unit_test(same_bytes),
        cmocka_unit_test(budget),
        cmocka_unit_test(measured_numbers_are_printed),
        cmocka_unit_test(library),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
