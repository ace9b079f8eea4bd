/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bands over ranges that are others than those the device was judged with: against formulas, against
   every corner by itself, and against a verdict that had these ranges from the start. */
#include "verdict/verdict.h"
#include "test.h"

/* one arm on a leaf, pushed a little; not drawn */
static const char text[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"arm\">\n"
    "<material ref=\"silicon-100\" thickness=\"50 um\"/><limits safety-factor=\"1.5\"/>\n"
    "<flexure id=\"leaf\" kind=\"leaf\" width=\"8 um\" length=\"300 um\" fillet=\"8 um\" gap=\"6 "
    "um\"/>\n"
    "<mechanism>\n"
    "<body id=\"a\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"0.5 mm\" y=\"0 mm\"/>\n"
    "<revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"a\" b-x=\"-0.5 mm\" b-y=\"0 "
    "mm\" hinge=\"leaf\" damping=\"1e-11 N m s/rad\"/>\n"
    "</mechanism>\n"
    "<scene name=\"push\" duration=\"3 ms\"><torque on=\"a\" value=\"0.02 mN mm\"/></scene>\n"
    "</device>\n";

enum { INPUTS = 3 };

typedef struct set_up {
    fw_arena *arena;
    fw_diags diags;
    const fw_device *device;
    fw_mechanism_variant variant;
    fw_verdict_options options;
    fw_verdict_fabrication_input input[INPUTS]; /* thickness, edge, modulus */
} set_up;

static fw_quantity known(double value, const char *unit) {
    return (fw_quantity){.value = value, .unit = unit, .status = FW_TYPICAL, .source = "test"};
}

static void begin_with(set_up *s, const char *xml) {
    s->arena = fw_arena_new(0);
    s->diags = fw_diags_new(s->arena);
    if (fw_device_read(s->arena, "t.xml", xml, strlen(xml), NULL, 0, &s->diags, &s->device) !=
        FW_OK)
        fail_msg("%d: %s", s->diags.item[0].place.line, s->diags.item[0].message);
    s->options = (fw_verdict_options){.motion = {.accuracy = 1e-3, .samples = 65}};
    s->variant = (fw_mechanism_variant){.flow = "test",
                                        .material = {.id = "silicon-100",
                                                     .name = "silicon",
                                                     .youngs = known(169e9, "Pa"),
                                                     .poisson = known(0.28, "1"),
                                                     .density = known(2329, "kg/m3"),
                                                     .strength = known(2e9, "Pa"),
                                                     .criterion = "fracture",
                                                     .loss = known(1e-3, "1"),
                                                     .expansion = {.unknown = true},
                                                     .modulus_change = {.unknown = true}},
                                        .substrate_expansion = {.unknown = true},
                                        .thickness_m = 50e-6,
                                        .explicit_mass_scale = 1,
                                        .explicit_stiffness_scale = 1,
                                        .explicit_damping_scale = 1};
    s->input[0] = (fw_verdict_fabrication_input){.name = "thickness",
                                                 .q = known(50e-6, "m"),
                                                 .drawn = 50e-6,
                                                 .nominal = 50e-6,
                                                 .low = 48e-6,
                                                 .high = 52e-6,
                                                 .sigma = 1e-6,
                                                 .thickness = 1 / 50e-6};
    s->input[1] = (fw_verdict_fabrication_input){.name = "edge",
                                                 .q = known(0, "m"),
                                                 .low = -0.2e-6,
                                                 .high = 0.2e-6,
                                                 .sigma = 0.1e-6,
                                                 .edge_m = 1};
    s->input[2] = (fw_verdict_fabrication_input){.name = "modulus",
                                                 .q = known(169e9, "Pa"),
                                                 .drawn = 169e9,
                                                 .nominal = 169e9,
                                                 .low = 160e9,
                                                 .high = 178e9,
                                                 .sigma = 4.5e9,
                                                 .youngs = 1 / 169e9};
}

static void begin(set_up *s) {
    begin_with(s, text);
}

static fw_verdict judge(set_up *s, const fw_verdict_fabrication_input *input, int ninput) {
    fw_verdict v = {.nvariant = 1,
                    .variant = fw_arena_array(s->arena, fw_verdict_variant_verdict, 1)};
    const fw_layout *layout;
    v.variant[0].variant = &s->variant;
    v.variant[0].input = input, v.variant[0].ninput = ninput;
    assert_int_equal(fw_verdict_run(s->arena, s->device, &s->options, &s->diags, &v, &layout),
                     FW_OK);
    return v;
}

static fw_verdict_ranges ranges(set_up *s, const fw_verdict *v,
                                const fw_verdict_fabrication_input *input, int ninput) {
    fw_verdict_ranges out;
    assert_int_equal(fw_verdict_ranges_judge(s->arena, s->device, v->layout, &s->options,
                                             &v->variant[0], input, ninput, 0, &out),
                     FW_OK);
    return out;
}

/* torque that brings the leaf to its limit in this thickness */
static double bears(set_up *s, double thickness_ratio) {
    const fw_verdict_fabrication made = {0, 0, thickness_ratio, 1, 0, 0, 0, NULL};
    fw_verdict_fabricated_device d;
    const fw_mechanism *m;
    assert_int_equal(
        fw_verdict_fabrication_build(s->arena, s->device, NULL, &s->variant, &made, &d), FW_OK);
    assert_int_equal(fw_mechanism_build(s->arena, &d.device, NULL, &d.variant, &s->diags, &m),
                     FW_OK);
    return m->pin[0].stiffness_Nm_per_rad * m->hinge[0].closed_form.limit_angle_rad;
}

/* A stated torque bends a leaf by M/K, of a limit L: U = U0 K0 L0/(K L), K ~ h, L all but the same. Stated
   masses go with the thickness, so that the motion is the same one. */
static void by_hand(void **state) {
    (void)state;
    set_up s;
    begin(&s);
    fw_verdict v = judge(&s, s.input, 1);
    assert_int_equal(v.decision, FW_ACCEPT);
    double U0 = v.variant[0].fabricated->corner[0].hinge[0].utilisation;
    assert_true(U0 > 0.05 && U0 < 0.9);
    fw_verdict_ranges now = ranges(&s, &v, s.input, 1);
    double M0 = bears(&s, 1);
    assert_relative(bears(&s, 1.04), 1.04 * M0, 4e-3);
    assert_relative(now.hinge[0].low, U0 * M0 / bears(&s, 1.04), 2e-4);
    assert_relative(now.hinge[0].high, U0 * M0 / bears(&s, 0.96), 2e-4);
    fw_verdict_fabrication_input measured = s.input[0];
    measured.low = 49.5e-6, measured.high = 50.5e-6, measured.sigma = 0.25e-6;
    fw_verdict_ranges then = ranges(&s, &v, &measured, 1);
    assert_relative(then.hinge[0].low, U0 * M0 / bears(&s, 1.01), 2e-4);
    assert_relative(then.hinge[0].high, U0 * M0 / bears(&s, 0.99), 2e-4);
    assert_int_equal(then.judged, 2); /* its ends; the nominal device was run before */
    measured.low = measured.high = 50e-6, measured.sigma = 0;
    then = ranges(&s, &v, &measured, 1);
    assert_int_equal(then.judged, 0);
    assert_near(then.hinge[0].low, U0, 0);
    assert_near(then.hinge[0].high, U0, 0);
    then = ranges(&s, &v, s.input, 0); /* nothing differs from the drawing */
    assert_near(then.hinge[0].high, v.variant[0].hinge[0].utilisation, 0);
    assert_int_equal(then.decision, v.drawn);
    fw_arena_free(s.arena);
}

/* The ends of the band are corners, and those of all corners, each run by itself, to what numbers of one
   motion are off by: the modulus changes nothing under a stated torque, so that two corners are one. */
static void both_ends_are_corners(void **state) {
    (void)state;
    set_up s;
    begin(&s);
    fw_verdict v = judge(&s, s.input, INPUTS);
    fw_verdict_ranges now = ranges(&s, &v, s.input, INPUTS);
    double least = HUGE_VAL, most = 0;
    bool low = false, high = false;
    for (unsigned bits = 0; bits < 1u << INPUTS; bits++) {
        fw_verdict_fabrication_input one[INPUTS];
        for (int i = 0; i < INPUTS; i++) {
            one[i] = s.input[i];
            one[i].nominal = one[i].low = one[i].high =
                bits >> i & 1u ? s.input[i].high : s.input[i].low;
        }
        fw_verdict_ranges corner = ranges(&s, &v, one, INPUTS);
        assert_near(corner.hinge[0].low, corner.hinge[0].high, 0);
        low = low || corner.hinge[0].low == now.hinge[0].low;
        high = high || corner.hinge[0].high == now.hinge[0].high;
        least = fmin(least, corner.hinge[0].low);
        most = fmax(most, corner.hinge[0].high);
    }
    assert_true(low && high);
    assert_relative(now.hinge[0].low, least, 1e-4);
    assert_relative(now.hinge[0].high, most, 1e-4);
    assert_true(now.judged <= 2); /* at most the other ends: the rest is the verdict's own */
    fw_arena_free(s.arena);
}

/* a measurement is worth what a verdict says that knows it from the start, to the last bit */
static void as_if_judged_with_them(void **state) {
    (void)state;
    set_up s;
    begin(&s);
    fw_verdict v = judge(&s, s.input, INPUTS);
    for (int i = 0; i < INPUTS; i++)
        for (int exact = 0; exact < 2; exact++) {
            fw_verdict_fabrication_input measured[INPUTS];
            memcpy(measured, s.input, sizeof measured);
            double left = exact ? 0.0 : 0.1;
            measured[i].low = measured[i].nominal - left * (measured[i].nominal - measured[i].low);
            measured[i].high =
                measured[i].nominal + left * (measured[i].high - measured[i].nominal);
            measured[i].sigma *= left;
            fw_verdict_ranges then = ranges(&s, &v, measured, INPUTS);
            fw_verdict own = judge(&s, measured, INPUTS);
            fw_verdict_ranges from_start = ranges(&s, &own, measured, INPUTS);
            assert_near(then.hinge[0].low, from_start.hinge[0].low, 0);
            assert_near(then.hinge[0].high, from_start.hinge[0].high, 0);
            assert_int_equal(then.decision, own.variant[0].fabricated->decision);
            assert_true(then.judged < own.variant[0].fabricated->ncorner);
        }
    fw_arena_free(s.arena);
}

/* an input that is known exactly is no second end of anything, and moves what is made all the same */
static void exact_inputs_stay(void **state) {
    (void)state;
    set_up s;
    begin(&s);
    s.input[1].nominal = s.input[1].low = s.input[1].high = -0.2e-6;
    fw_verdict v = judge(&s, s.input, INPUTS);
    const fw_verdict_fabricated_verdict *f = v.variant[0].fabricated;
    double drawn = v.variant[0].hinge[0].utilisation;
    assert_true(f->corner[0].hinge[0].utilisation > drawn * 1.02); /* thinner by 0.4 um of 8 */
    for (int c = 0; c < f->ncorner; c++) {
        assert_near(f->corner[c].x[1], -0.2e-6, 0);
        assert_true(isfinite(f->hinge[0].sigma));
    }
    assert_false(f->all);
    assert_near(f->hinge[0].share[1], 0, 0);
    fw_arena_free(s.arena);
}

/* Edges that lie further than their ranges by half the room keep the verdict, by half more than the room they do not: where
   the hinge decides, and where a frequency does. That one by hand: f ~ w^(3/2) of a leaf under a stated mass, so that edges
   that are off by e change ln f by 3 e/w, and a hundredth is left. */
static void room_of_edges(void **state) {
    (void)state;
    for (int of = 0; of < 2; of++) {
        set_up s;
        char xml[2000];
        double torque = 0.02, least_Hz = 1;
        const char *axis = strstr(text, " damping"); /* without one, no band of the hinge is known */
        fw_verdict v = {0};
        for (int turn = 0; turn < 2; turn++) { /* first to learn how far off the limit is */
            snprintf(xml, sizeof xml,
                     "%.*s axis=\"0 deg\" %.*s<probe id=\"f\" kind=\"frequency\" mode=\"1\"/>"
                     "<require probe=\"f\" min=\"%.9g Hz\"/>"
                     "<scene name=\"push\" duration=\"3 ms\"><torque on=\"a\" value=\"%.9g mN "
                     "mm\"/></scene></device>",
                     (int)(axis - text), text, (int)(strstr(text, "<scene") - axis), axis, least_Hz,
                     torque);
            begin_with(&s, xml);
            v = judge(&s, s.input, INPUTS);
            const fw_verdict_fabricated_verdict *f = v.variant[0].fabricated;
            if (v.decision != FW_ACCEPT || !f) fail_msg("%s", v.variant[0].reason[0].text);
            if (turn == 1) break;
            torque *= of ? 1 : 0.97 / f->corner[f->hinge[0].corner].hinge[0].utilisation_high;
            if (of) least_Hz = 0.99 * f->requirement[0].all_low;
            fw_arena_free(s.arena);
        }
        const fw_verdict_edge_room room = v.variant[0].fabricated->room;
        assert_non_null(room.says);
        assert_non_null(strstr(room.says, of ? "requirement f" : "hinge A"));
        assert_near(room.looked_m, 0.2e-6, 1e-15);
        if (of) assert_relative(room.edge_m, -log(0.99) * 8e-6 / 3, 0.1);
        const double low = s.input[1].low, high = s.input[1].high;
        for (int beyond = 0; beyond < 2; beyond++) {
            const double by = (beyond ? 1.5 : 0.5) * room.edge_m;
            s.input[1].low = low - by, s.input[1].high = high + by;
            const fw_verdict_decision then = judge(&s, s.input, INPUTS).decision;
            assert_true((then == FW_ACCEPT) == !beyond);
        }
        fw_arena_free(s.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(both_ends_are_corners),
        cmocka_unit_test(as_if_judged_with_them),
        cmocka_unit_test(exact_inputs_stay),
        cmocka_unit_test(room_of_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
