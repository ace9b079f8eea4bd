/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A random device whose edges a flow moves, against the same device written out as that flow leaves it: every width,
   length, gap and distance is put down here by hand, and nothing is biased. Both must give the same numbers. */
#include "verdict/random_device.h"
#include "verdict/verdict.h"
#include "test.h"

typedef struct hand { /* a device, and by how much its edges stand out: um */
    uint64_t seed;
    double edge, deep;
    fw_text text;
} hand;

static double between(hand *h, double low, double high) {
    return low + (high - low) * rig_random(&h->seed);
}
static void um(hand *h, const char *before, double value) {
    fw_text_add(&h->text, before);
    fw_text_number(&h->text, value, 17);
    fw_text_add(&h->text, " um\"");
}
/* solids and gaps: a solid grows by the edge at either side, a gap loses it */
static void solid(hand *h, const char *name, double drawn) {
    um(h, name, drawn + 2 * h->edge);
}
static void gap(hand *h, const char *name, double drawn) {
    um(h, name, drawn - 2 * h->edge);
}

static void flexures(hand *h, bool path) {
    double width = between(h, 7, 10), length = between(h, 250, 400), corner = between(h, 0.4, 0.7) * width;
    fw_text_add(&h->text, "<flexure id=\"leaf\" kind=\"leaf\"");
    double middle = between(h, 0.8, 1.2) * width, cut = 1 - 2 * h->edge / length;
    if (between(h, 0, 1) < 0.5) { /* the same curve as drawn, cut where it now ends */
        solid(h, " width=\"", middle + (width - middle) * cut * cut), solid(h, " width-middle=\"", middle);
    } else {
        solid(h, " width=\"", width);
    }
    gap(h, " length=\"", length), um(h, " fillet=\"", corner - h->edge);
    fw_text_add(&h->text, "/>\n");
    width = between(h, 7, 10), corner = between(h, 0.4, 0.7) * width;
    if (path) {
        double one = between(h, 100, 160), radius = between(h, 60, 120), turn = between(h, 60, 120), two = between(h, 80, 150);
        fw_text_add(&h->text, "<flexure id=\"bow\" kind=\"path\"");
        solid(h, " width=\"", width), um(h, " fillet=\"", corner - h->edge);
        um(h, "><line length=\"", one - h->edge);
        um(h, "/><arc radius=\"", radius);
        fw_text_printf(&h->text, " angle=\"%.17g deg\"/>", turn);
        um(h, "<line length=\"", two - h->edge);
        fw_text_add(&h->text, "/></flexure>\n");
        return;
    }
    double radius = between(h, 80, 150), angle = between(h, 120, 250);
    fw_text_add(&h->text, "<flexure id=\"bow\" kind=\"csfh\"");
    solid(h, " width=\"", width), um(h, " radius=\"", radius);
    fw_text_printf(&h->text, " angle=\"%.17g deg\"", angle - 2 * h->edge / radius * (180 / M_PI));
    um(h, " fillet=\"", corner - h->edge), gap(h, " gap=\"", between(h, 4, 8));
    fw_text_add(&h->text, "/>\n");
}

/* what drives it, what damps it, and what is in its way */
static void scene(hand *h) {
    double drawn;
    fw_text_add(&h->text, "<scene name=\"go\" duration=\"3 ms\">\n<comb-drive id=\"c\" kind=\"comb\" on=\"b\" "
                          "x=\"0.4 mm\" direction=\"80 deg\" fingers=\"40\" voltage=\"30 V\" law=\"ramp\" rise=\"1 ms\"");
    solid(h, " width=\"", 8); /* as by default of the comb as drawn */
    gap(h, " gap=\"", between(h, 6, 9)), solid(h, " overlap=\"", drawn = between(h, 30, 50));
    if (between(h, 0, 1) < 0.5)
        um(h, " length=\"", drawn + between(h, 40, 60));
    else
        um(h, " length=\"", 2 * drawn); /* what the default is of the comb as drawn */
    fw_text_printf(&h->text, " depth=\"%.17g um\"/>\n", 45 * h->deep);
    fw_text_add(&h->text, "<comb-drive id=\"p\" kind=\"plate\" on=\"b\" direction=\"0 deg\" voltage=\"40 V\"");
    um(h, " x=\"", 500 + h->edge), um(h, " y=\"", 30);
    gap(h, " gap=\"", between(h, 14, 20)), solid(h, " length=\"", between(h, 100, 300));
    fw_text_add(&h->text, "/>\n<air kind=\"squeeze\" on=\"a\" direction=\"90 deg\"");
    um(h, " x=\"", between(h, -100, 400)), um(h, " y=\"", 50 + h->edge);
    gap(h, " gap=\"", between(h, 25, 40)), solid(h, " length=\"", between(h, 50, 400));
    if (between(h, 0, 1) < 0.5) fw_text_printf(&h->text, " depth=\"%.17g um\"", 40 * h->deep);
    fw_text_add(&h->text, "/>\n<contact id=\"hole\" a=\"ground\" a-x=\"1.5 mm\" b=\"b\" side=\"inside\" stiffness=\"2e4 "
                          "N/m\" damping=\"1e-5 N s/m\"");
    gap(h, " distance=\"", between(h, 2, 6));
    fw_text_add(&h->text, "/>\n<contact id=\"side\" a=\"ground\" a-x=\"2 mm\" a-y=\"-0.104 mm\" b=\"b\" b-x=\"0.5 mm\" "
                          "side=\"outside\" stiffness=\"1e4 N/m\"");
    solid(h, " distance=\"", 100);
    fw_text_add(&h->text, "/>\n<force on=\"b\" fx=\"5 uN\" fy=\"-20 uN\"/></scene>\n");
}

/* the device of a seed, with its edges that far out and the layer that deep; the same draws for every edge */
static const fw_device *written(fw_arena *arena, uint64_t seed, double edge_um, double deep) {
    hand h = {.seed = seed, .edge = edge_um, .deep = deep, .text = fw_text_new(arena)};
    const fw_device *device;
    fw_diags diags = fw_diags_new(arena);
    fw_text_add(&h.text, "<device xmlns=\"urn:flexwright:device:1\" name=\"hand\"><material ref=\"silicon-100\" "
                         "thickness=\"50 um\"/><limits safety-factor=\"1.5\"/>\n");
    flexures(&h, seed % 3 == 0);
    fw_text_add(&h.text,
                "<mechanism><body id=\"a\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"0.5 mm\" y=\"0 mm\"/>\n"
                "<body id=\"b\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"1.5 mm\" y=\"0 mm\"/>\n"
                "<revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"a\" b-x=\"-0.5 mm\" b-y=\"0 mm\" "
                "hinge=\"leaf\"/>\n"
                "<revolute id=\"B\" a=\"a\" a-x=\"0.5 mm\" a-y=\"0 mm\" b=\"b\" b-x=\"-0.5 mm\" b-y=\"0 mm\" "
                "hinge=\"bow\"/></mechanism>\n");
    scene(&h);
    fw_text_add(&h.text, "</device>\n");
    if (fw_device_read(arena, "hand.xml", h.text.data, h.text.length, NULL, 0, &diags, &device) != FW_OK)
        fail_msg("%s\n%s", diags.item[0].message, h.text.data);
    return device;
}

static fw_mechanism_variant silicon(double deep) {
    const fw_quantity q = {.status = FW_TYPICAL, .source = "test", .unit = "1"};
    fw_mechanism_variant v = {.flow = "test",
                              .material = {.id = "silicon-100", .name = "silicon", .criterion = "fracture",
                                           .expansion = {.unknown = true}, .modulus_change = {.unknown = true}},
                              .substrate_expansion = {.unknown = true},
                              .thickness_m = 50e-6 * deep,
                              .explicit_mass_scale = deep, .explicit_stiffness_scale = deep,
                              .explicit_damping_scale = deep};
    v.material.youngs = v.material.poisson = v.material.density = v.material.strength = v.material.loss = q;
    v.material.youngs.value = 169e9, v.material.poisson.value = 0.28, v.material.density.value = 2329;
    v.material.strength.value = 2e9, v.material.loss.value = 1e-3;
    return v;
}

static fw_verdict_variant_verdict run(fw_arena *arena, const fw_device *d, const fw_mechanism_variant *variant,
                                      double rtol) {
    fw_diags diags = fw_diags_new(arena);
    fw_verdict_variant_verdict v = {.variant = variant};
    const fw_verdict_options options = {.motion = {.rtol = rtol, .samples = 65}};
    const fw_mechanism *m;
    assert_int_equal(fw_mechanism_build(arena, d, NULL, variant, &diags, &m), FW_OK);
    fw_status status = fw_verdict_variant(arena, d, NULL, m, &options, &diags, &v);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[diags.count - 1].message : "it did not run");
    return v;
}

static void as_written_by_hand(void **state) {
    (void)state;
    const int devices = test_fewest(test_cases(24, 8), 3); /* of three one has a path */
    int moved = 0;
    for (int n = 0; n < devices; n++) {
        fw_arena *arena = fw_arena_new(0);
        uint64_t seed = 7919u + 104729u * (uint64_t)n, draw = seed ^ 0x5bd1e995u;
        double edge = device_between(&draw, -0.6, 0.6), deep = device_between(&draw, 0.95, 1.05);
        const fw_device *drawn = written(arena, seed, 0, 1), *by_hand = written(arena, seed, edge, deep);
        const fw_mechanism_variant as_drawn = silicon(1), as_made = silicon(deep);
        const fw_verdict_fabrication made = {edge * 1e-6, 0, deep, 1, 0, 0, 0, NULL};
        fw_verdict_fabricated_device d;
        assert_int_equal(fw_verdict_fabrication_build(arena, drawn, NULL, &as_drawn, &made, &d), FW_OK);
        if (d.gone) fail_msg("%s", d.gone);
        /* of the drawing only that it has moved by more than a thousandth is asked */
        fw_verdict_variant_verdict was = run(arena, drawn, &as_drawn, 1e-5), got = run(arena, &d.device, &d.variant, 1e-9),
                                   want = run(arena, by_hand, &as_made, 1e-9);
        assert_int_equal(got.nhinge, want.nhinge);
        for (int k = 0; k < want.nhinge; k++) {
            /* the integration at its tolerance, over some touches and lettings-go */
            assert_relative(got.hinge[k].peak_angle_rad, want.hinge[k].peak_angle_rad, 5e-6);
            assert_relative(got.hinge[k].utilisation, want.hinge[k].utilisation, 5e-6);
            assert_relative(got.hinge[k].limit_angle_rad, want.hinge[k].limit_angle_rad, 1e-9);
            moved += fabs(was.hinge[k].utilisation / want.hinge[k].utilisation - 1) > 1e-3;
        }
        fw_arena_free(arena);
    }
    assert_true(moved > devices);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(as_written_by_hand)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
