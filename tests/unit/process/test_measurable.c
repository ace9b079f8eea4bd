/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be read in a flow, and how exactly: against the coupons' own formulas. */
#include "pack_fixture.h"
#include "process/calibrate.h"

static const double WIDTH = 0.05e-6, DEPTH = 0.25e-6, STEP = 0.02e-6, TIME = 1.0;

static const fw_process_measurable *list;
static int n;

static void read(const fw_process_flow *flow) {
    assert_non_null(flow);
    assert_int_equal(fw_process_measurables(arena, flow, &list, &n), FW_OK);
}

static double u_of(const char *id) {
    const fw_process_measurable *r = fw_process_measurable_of(list, n, id);
    if (!r) fail_msg("nothing reads %s", id);
    return r->uncertainty;
}

/* three lines and three spaces: u/2 each, sqrt 6; the undercut of five lines with that, over E = 1.1 D */
static void coupons_of_silicon(void **state) {
    (void)state;
    read(read_pack(arena, SILICON, NULL, NULL, &diags));
    double edge = 0.5 * WIDTH / sqrt(6);
    assert_relative(u_of("made.al-edge"), edge, 1e-9);
    double E = 55e-6, u = 0.005 * E; /* A is not known: the middle of what is assumed */
    double lines = 0.5 * WIDTH / sqrt(5);
    assert_relative(u_of("rie.A"), hypot(hypot(lines, edge), u / E * DEPTH) / E, 1e-6);
    assert_string_equal(fw_process_measurable_of(list, n, "rie.A")->by,
                        "coupon undercut-ladder, with cd-lines");
    assert_true(fw_process_measurable_of(list, n, "rie.A")->coupon);
    /* half of 1 um at 1 nm/s */
    assert_relative(u_of("pan.R") / 1e-9, hypot(STEP / 0.5e-6, TIME / 500.0), 1e-3);
    /* D/l, l = 0.5 um at 50 um */
    assert_relative(u_of("rie.selectivity") / 100.0, hypot(STEP / 0.5e-6, DEPTH / 50e-6), 1e-3);
    assert_true(u_of("rie.R") > 0 && u_of("rie.S") > 0 && u_of("rie.S") < 0.05);
}

/* an instrument of the pack: absolute, or relative where it is a share; coupons go before it */
static void instruments(void **state) {
    (void)state;
    read(read_pack(arena, SILICON, NULL, NULL, &diags));
    assert_relative(u_of("si.d"), 0.15e-6, 1e-12);
    assert_false(fw_process_measurable_of(list, n, "si.d")->coupon);
    assert_relative(u_of("lamp.I"), 0.02 * 100, 1e-12); /* of 10 mW/cm2 */
    assert_null(
        fw_process_measurable_of(list, n, "litho.edge")); /* cd-lines reads the aluminium's edge */
    assert_null(fw_process_measurable_of(list, n, "expose.D"));
}

/* better instruments read better; without a word on them the coupons read nothing */
static void as_exactly_as_the_pack_says(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    read(f);
    double was = u_of("made.al-edge");
    measured(f, "read.width", 0.5 * WIDTH, 0);
    read(f);
    assert_relative(u_of("made.al-edge"), 0.5 * was, 1e-9);
    ((fw_quantity *)fw_process_flow_quantity(f, "read.width"))->unknown = true;
    read(f);
    assert_null(fw_process_measurable_of(list, n, "made.al-edge"));
    assert_null(fw_process_measurable_of(list, n, "rie.A"));
    assert_non_null(fw_process_measurable_of(list, n, "rie.R"));
}

/* pads of copper, printed edges; what the calibration has no law for nothing reads */
static void other_flows(void **state) {
    (void)state;
    read(read_pack(arena, COPPER, NULL, NULL, &diags));
    assert_relative(u_of("litho.edge"), 0.5 * WIDTH / sqrt(6), 1e-9);
    assert_relative(u_of("cu.eta") / 0.97, STEP / 9e-6, 1e-3); /* the widest pad */
    assert_relative(u_of("made.cu"), hypot(STEP / 9e-6 / sqrt(2), STEP / 9e-6), 1e-3);
    assert_null(fw_process_measurable_of(list, n, "made.wall"));
    assert_null(fw_process_measurable_of(list, n, "ps.P"));
    read(read_pack(arena, "soi-deep-rie", NULL, NULL, &diags));
    static const char *const of_soi[] = {"drie.A", "drie.R", "drie.S", "drie.selectivity",
                                         "litho.edge"};
    for (int i = 0; i < 5; i++)
        assert_true(fw_process_measurable_of(list, n, of_soi[i])->coupon);
    assert_relative(u_of("soi.d"), 0.1e-6, 1e-12);
}

/* the flow is as it was, and what is asked with is what a laboratory pack would leave */
static void with_and_back(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags),
                    *lab = read_pack(arena, SILICON, NULL, NULL, &diags);
    const fw_quantity *rate = fw_process_flow_quantity(f, "rie.R"), was = *rate;
    const fw_process_with none = {.id = NULL}, with = {"rie.R", was.value, 0.01 * was.value};
    fw_process_time *before = fw_arena_array(arena, fw_process_time, (size_t)f->nstep),
                    *then = fw_arena_array(arena, fw_process_time, (size_t)f->nstep);
    assert_int_equal(fw_process_flow_times_with(arena, f, &none, &plain_facts, before), FW_OK);
    assert_int_equal(fw_process_flow_times_with(arena, f, &with, &plain_facts, then), FW_OK);
    assert_memory_equal(rate, &was, sizeof was);
    measured(lab, "rie.R", was.value, 0.01 * was.value);
    assert_int_equal(fw_process_flow_compute(arena, lab, &plain_facts, &diags), FW_OK);
    for (int i = 0; i < f->nstep; i++) {
        bool etch = strcmp(f->step[i].id, "S18") == 0;
        assert_near(then[i].first_look_s, lab->step[i].time.first_look_s, 0);
        assert_near(then[i].clear_by_s, lab->step[i].time.clear_by_s, 0);
        assert_int_equal(then[i].clear_by_s < before[i].clear_by_s, etch);
    }
    assert_true(fw_process_flow_takes(f, rate));
    assert_true(fw_process_flow_takes(f, fw_process_flow_quantity(f, "rie.A")));
    assert_false(fw_process_flow_takes(f, fw_process_flow_quantity(f, "inspect.t"))); /* stated */
    assert_false(fw_process_flow_takes(f, fw_process_flow_quantity(f, "mask.open-area")));
    assert_false(fw_process_flow_takes(f, fw_process_flow_quantity(f, "read.width")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(coupons_of_silicon, setup, teardown),
        cmocka_unit_test_setup_teardown(instruments, setup, teardown),
        cmocka_unit_test_setup_teardown(as_exactly_as_the_pack_says, setup, teardown),
        cmocka_unit_test_setup_teardown(other_flows, setup, teardown),
        cmocka_unit_test_setup_teardown(with_and_back, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
