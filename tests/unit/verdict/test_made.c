/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/verdict.h"
#include "verdict/verdict_parts.h"
#include "test.h"

/* one arm on a leaf and one on an arc, a load and a turn; not drawn */
static const char text[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"two-arms\">\n"
    "<material ref=\"silicon-100\" thickness=\"50 um\"/><limits safety-factor=\"1.5\"/>\n"
    "<flexure id=\"leaf\" kind=\"leaf\" width=\"8 um\" length=\"300 um\" fillet=\"8 um\" gap=\"6 "
    "um\"/>\n"
    "<flexure id=\"arc\" kind=\"csfh\" width=\"9 um\" length=\"300 um\" angle=\"200 deg\" "
    "fillet=\"9 um\"/>\n"
    "<mechanism>\n"
    "<body id=\"a\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"0.5 mm\" y=\"0 mm\"/>\n"
    "<body id=\"b\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"1.5 mm\" y=\"0 mm\"/>\n"
    "<revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"a\" b-x=\"-0.5 mm\" b-y=\"0 "
    "mm\" "
    "hinge=\"leaf\" damping=\"1e-11 N m s/rad\"/>\n"
    "<revolute id=\"B\" a=\"a\" a-x=\"0.5 mm\" a-y=\"0 mm\" b=\"b\" b-x=\"-0.5 mm\" b-y=\"0 mm\" "
    "hinge=\"arc\" stiffness=\"1.4e-6 N m/rad\" damping=\"1e-11 N m s/rad\"/>\n"
    "</mechanism>\n"
    "<scene name=\"push\" duration=\"3 ms\"><force on=\"b\" fx=\"0.01 mN\" fy=\"LOAD\"/></scene>\n"
    "</device>\n";

typedef struct set_up {
    fw_arena *arena;
    fw_diags diags;
    const fw_device *device;
    fw_mechanism_variant variant;
    fw_verdict_fabrication_input input[3];
} set_up;

static fw_quantity known(double value, const char *unit) {
    return (fw_quantity){.value = value, .unit = unit, .status = FW_TYPICAL, .source = "test"};
}

/* edges +- 0.3 um, an etch that leaves a trapezoid, thickness +- 4 % */
static void begin(set_up *s, const char *load) {
    s->arena = fw_arena_new(0);
    s->diags = fw_diags_new(s->arena);
    const char *at = strstr(text, "LOAD");
    const char *xml = fw_arena_printf(s->arena, "%.*s%s%s", (int)(at - text), text, load, at + 4);
    if (fw_device_read(s->arena, "t.xml", xml, strlen(xml), NULL, 0, &s->diags, &s->device) !=
        FW_OK)
        fail_msg("%d: %s", s->diags.item[0].place.line, s->diags.item[0].message);
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
    s->input[0] = (fw_verdict_fabrication_input){.name = "edge",
                                                 .q = known(0, "m"),
                                                 .low = -0.3e-6,
                                                 .high = 0.3e-6,
                                                 .sigma = 0.15e-6,
                                                 .edge_m = 1};
    s->input[1] = (fw_verdict_fabrication_input){.name = "anisotropy",
                                                 .q = known(0.995, "1"),
                                                 .drawn = 1,
                                                 .even = 1,
                                                 .nominal = 0.995,
                                                 .low = 0.99,
                                                 .high = 1,
                                                 .sigma = 0.003,
                                                 .edge_m = 30e-6,
                                                 .flare_m = -50e-6};
    s->input[2] = (fw_verdict_fabrication_input){.name = "thickness",
                                                 .q = known(50e-6, "m"),
                                                 .drawn = 50e-6,
                                                 .nominal = 50e-6,
                                                 .low = 48e-6,
                                                 .high = 52e-6,
                                                 .sigma = 1e-6,
                                                 .thickness = 1 / 50e-6};
}

static fw_verdict judge(set_up *s, fw_verdict_corners corners) {
    fw_verdict v = {.nvariant = 1,
                    .variant = fw_arena_array(s->arena, fw_verdict_variant_verdict, 1)};
    const fw_verdict_options options = {.motion = {.accuracy = 1e-3, .samples = 65},
                                        .corners = corners};
    const fw_layout *layout;
    v.variant[0].variant = &s->variant;
    v.variant[0].input = s->input, v.variant[0].ninput = 3;
    assert_int_equal(fw_verdict_run(s->arena, s->device, &options, &s->diags, &v, &layout), FW_OK);
    return v;
}

static fw_verdict_variant_verdict with_signs(set_up *s, const double *x, const signed char *sign) {
    fw_verdict_fabrication fabricated = fw_verdict_fabrication_at(s->input, 3, x);
    fabricated.sign = sign;
    fw_verdict_fabricated_device *d = fw_arena_one(s->arena, fw_verdict_fabricated_device);
    fw_verdict_variant_verdict v = {0};
    const fw_mechanism *m;
    const fw_verdict_options options = {.motion = {.accuracy = 1e-3, .samples = 65}};
    assert_int_equal(
        fw_verdict_fabrication_build(s->arena, s->device, NULL, &s->variant, &fabricated, d),
        FW_OK);
    assert_null(d->gone);
    v.variant = &d->variant;
    assert_int_equal(fw_mechanism_build(s->arena, &d->device, NULL, &d->variant, &s->diags, &m),
                     FW_OK);
    assert_int_equal(fw_verdict_variant(s->arena, &d->device, NULL, m, &options, &s->diags, &v),
                     FW_OK);
    return v;
}

static fw_verdict_variant_verdict at(set_up *s, const double *x) {
    return with_signs(s, x, NULL);
}

static void corner(const set_up *s, unsigned bits, double *x) {
    for (int i = 0; i < 3; i++)
        x[i] = bits >> i & 1u ? s->input[i].high : s->input[i].low;
}

/* widths, gaps, sections, stated values of a device as made, against formulas of their own */
static void what_is_made_follows_the_edges(void **state) {
    (void)state;
    set_up s;
    begin(&s, "0.02 mN");
    const fw_verdict_fabrication fabricated = {-0.5e-6, 0.25e-6, 0.98, 1.1, 0, 0, 0, NULL};
    fw_verdict_fabricated_device d;
    assert_int_equal(
        fw_verdict_fabrication_build(s.arena, s.device, NULL, &s.variant, &fabricated, &d), FW_OK);
    assert_null(d.gone);
    const fw_device_flexure *f = &d.device.flexure[0];
    assert_near(f->width_m, 7e-6, 1e-15);
    assert_near(f->gap_m, 7e-6, 1e-15);
    assert_near(f->flare_m, 0.25e-6, 0);
    assert_near(f->fillet_m, 8.5e-6, 1e-15); /* wider than the flexure */
    assert_near(d.variant.thickness_m, 49e-6, 1e-15);
    const fw_mechanism *drawn, *now;
    assert_int_equal(fw_mechanism_build(s.arena, s.device, NULL, &s.variant, &s.diags, &drawn),
                     FW_OK);
    assert_int_equal(fw_mechanism_build(s.arena, &d.device, NULL, &d.variant, &s.diags, &now),
                     FW_OK);
    /* leaf: K goes with E h (t^3 + t d^2)/(L + 2 dL), dL with t and rho/t; the walls at its ends go back, too */
    assert_near(f->length_m, 301e-6, 1e-15);
    double x = 8.5 / 7, dL = 8e-6 * (0.4192 - 0.5972 - 0.1167);
    double dL7 = 7e-6 * (0.4192 - 0.5972 * x - 0.1167 * x * x);
    double section = (343 + 7 * 0.0625) / 512.0;
    double want = 1.1 * 0.98 * section * (300e-6 + 2 * dL) / (301e-6 + 2 * dL7);
    assert_relative(now->pin[0].stiffness_Nm_per_rad / drawn->pin[0].stiffness_Nm_per_rad, want,
                    1e-9);
    /* arc, stated: the same ratio as its closed form's, in the new thickness and modulus */
    double own = now->hinge[1].closed_form.stiffness_Nm_per_rad;
    double was = drawn->hinge[1].closed_form.stiffness_Nm_per_rad;
    assert_relative(now->pin[1].stiffness_Nm_per_rad / drawn->pin[1].stiffness_Nm_per_rad,
                    own / was, 2e-3); /* the depth factor sees the thickness, too */
    assert_relative(now->body[0].mass_kg, 0.98 * drawn->body[0].mass_kg, 1e-12);
    /* to the end of the range that was compared, unless it was drawn beyond that */
    fw_device wide = *s.device;
    fw_device_flexure flexure[2] = {s.device->flexure[0], s.device->flexure[1]};
    wide.flexure = flexure;
    const fw_verdict_fabrication thin = {-1e-6, 0, 1, 1, 0, 0, 0, NULL};
    const double fillet[] = {3e-6, 8e-6, 9.9e-6, 11e-6}, then[] = {4e-6, 7.5e-6, 7.5e-6, 12e-6};
    for (int i = 0; i < 4; i++) {
        flexure[0].fillet_m = fillet[i];
        assert_int_equal(fw_verdict_fabrication_build(s.arena, &wide, NULL, &s.variant, &thin, &d),
                         FW_OK);
        assert_near(d.device.flexure[0].fillet_m, then[i], 1e-15);
    }
    const fw_verdict_fabrication cut = {-3.9e-6, 0.3e-6, 1, 1, 0, 0, 0, NULL};
    assert_int_equal(fw_verdict_fabrication_build(s.arena, s.device, NULL, &s.variant, &cut, &d),
                     FW_OK);
    assert_non_null(d.gone);
    const fw_verdict_fabrication shut = {3.1e-6, 0, 1, 1, 0, 0, 0, NULL};
    assert_int_equal(fw_verdict_fabrication_build(s.arena, s.device, NULL, &s.variant, &shut, &d),
                     FW_OK);
    assert_non_null(strstr(d.gone, "gap"));
    fw_arena_free(s.arena);
}

/* the parabola through three widths of a piece, after Lagrange */
static double width_at(const double *w, double x, double length) {
    const double t = x / length;
    return w[0] * (1 - t) * (1 - 2 * t) + w[1] * 4 * t * (1 - t) + w[2] * t * (2 * t - 1);
}

/* A path's pieces lose what its walls take at both ends, and keep the widths that they have at what is left, wider or narrower by
   both edges; uniform pieces stay uniform, and the path turns by what is left of its curves. */
static void pieces_keep_the_widths_of_what_is_left(void **state) {
    (void)state;
    set_up s;
    begin(&s, "0.02 mN");
    static const double widths[][3] = {{8e-6, 11e-6, 9e-6}, {8e-6, 8e-6, 10e-6}, {9e-6, 7e-6, 7e-6}, {8e-6, 8e-6, 8e-6}, {6e-6, 9e-6, 6e-6}};
    const double edges[] = {-0.7e-6, 0.4e-6};
    for (size_t a = 0; a < 5; a++)
        for (size_t b = 0; b < 5; b++)
            for (int e = 0; e < 2; e++) {
                fw_geometry_strip_piece piece[] = {{.length_m = 90e-6, .curvature_per_m = 2e3}, {.length_m = 60e-6, .curvature_per_m = -5e3}};
                memcpy(piece[0].width_m, widths[a], sizeof widths[a]);
                memcpy(piece[1].width_m, widths[b], sizeof widths[b]);
                fw_device changed = *s.device;
                fw_device_flexure flexure[2] = {s.device->flexure[0], s.device->flexure[1]};
                flexure[0].kind = FW_FLEXURE_PATH, flexure[0].length_m = 150e-6, flexure[0].angle_rad = 90e-6 * 2e3 - 60e-6 * 5e3;
                flexure[0].width_m = 6e-6, flexure[0].gap_m = 0;
                flexure[0].piece = piece, flexure[0].npiece = 2;
                changed.flexure = flexure;
                const fw_verdict_fabrication made = {edges[e], 0, 1, 1, 0, 0, 0, NULL};
                fw_verdict_fabricated_device d;
                assert_int_equal(fw_verdict_fabrication_build(s.arena, &changed, NULL, &s.variant, &made, &d), FW_OK);
                const fw_device_flexure *f = &d.device.flexure[0];
                assert_int_equal(f->npiece, 2);
                assert_near(f->length_m, 150e-6 - 2 * edges[e], 1e-15);
                assert_near(f->angle_rad, (90e-6 - edges[e]) * 2e3 - (60e-6 - edges[e]) * 5e3, 1e-12);
                for (int i = 0; i < 2; i++) {
                    const double whole = piece[i].length_m, left = whole - edges[e], from = i == 0 ? edges[e] : 0;
                    assert_near(f->piece[i].length_m, left, 1e-15);
                    for (int k = 0; k < 3; k++)
                        assert_near(f->piece[i].width_m[k], width_at(piece[i].width_m, from + 0.5 * k * left, whole) + 2 * edges[e], 1e-15);
                }
            }
    fw_arena_free(s.arena);
}

/* a crystal's corner of Young's modulus is one of all its constants: stiffness goes with it, and a
   stated force strains as before */
static void a_crystal_has_a_modulus_too(void **state) {
    (void)state;
    set_up s;
    begin(&s, "0.02 mN");
    s.variant.material.c11 = known(165.7e9, "Pa");
    s.variant.material.c12 = known(63.9e9, "Pa");
    s.variant.material.c44 = known(79.6e9, "Pa");
    fw_verdict_fabricated_device d[2];
    const fw_mechanism *m[2];
    for (int k = 0; k < 2; k++) {
        const fw_verdict_fabrication fabricated = {0, 0, 1, k ? 1.1 : 1, 0, 0, 0, NULL};
        assert_int_equal(
            fw_verdict_fabrication_build(s.arena, s.device, NULL, &s.variant, &fabricated, &d[k]),
            FW_OK);
        assert_int_equal(
            fw_mechanism_build(s.arena, &d[k].device, NULL, &d[k].variant, &s.diags, &m[k]), FW_OK);
    }
    for (int k = 0; k < 2; k++) {
        const fw_mechanism_hinge *soft = &m[0]->hinge[k], *stiff = &m[1]->hinge[k];
        assert_true(soft->input.crystal.known);
        assert_relative(stiff->closed_form.stiffness_Nm_per_rad,
                        1.1 * soft->closed_form.stiffness_Nm_per_rad, 1e-12);
        assert_relative(1.1 * stiff->section.point[0].strain_per_Nm,
                        soft->section.point[0].strain_per_Nm, 1e-12);
        assert_relative(1.1 * stiff->law.bend_m_per_N, soft->law.bend_m_per_N, 1e-12);
        assert_relative(1.1 * stiff->closed_form.limit_angle_rad, soft->closed_form.limit_angle_rad,
                        1e-12);
    }
    assert_relative(m[1]->pin[0].stiffness_Nm_per_rad, 1.1 * m[0]->pin[0].stiffness_Nm_per_rad,
                    1e-12);
    fw_arena_free(s.arena);
}

/* no corner, run or not, is above the stated bound, which is below the limit of what is accepted; the
   tightest that was run is the worst of all; accepted only where all are */
static void no_corner_is_worse(void **state) {
    (void)state;
    const char *const load[] = {"100 uN", "145 uN", "190 uN", "0.3 uN",
                                "115 uN", "122 uN", "-150 uN"};
    const int loads = test_cases(7, 3);
    int decisions[3] = {0};
    for (int n = 0; n < loads; n++) {
        set_up s;
        begin(&s, load[n]);
        fw_verdict v = judge(&s, FW_CORNERS_AUTO);
        const fw_verdict_fabricated_verdict *fabricated = v.variant[0].fabricated;
        decisions[v.decision]++;
        if (!fabricated) {
            assert_true(v.drawn != FW_ACCEPT);
            fw_arena_free(s.arena);
            continue;
        }
        double worst[2] = {0};
        fw_verdict_decision all = FW_ACCEPT;
        for (unsigned bits = 0; bits < 8; bits++) {
            double x[3];
            corner(&s, bits, x);
            fw_verdict_variant_verdict now = at(&s, x);
            if (now.decision > all) all = now.decision;
            for (int k = 0; k < 2; k++)
                worst[k] = fmax(worst[k], now.hinge[k].utilisation);
        }
        if (v.decision == FW_ACCEPT) assert_int_equal(all, FW_ACCEPT);
        if (all == FW_ACCEPT && v.drawn == FW_ACCEPT) assert_int_equal(v.decision, FW_ACCEPT);
        for (int k = 0; k < 2 && fabricated->ncorner > 1; k++) {
            const fw_verdict_fabricated_hinge *h = &fabricated->hinge[k];
            assert_true(worst[k] <= h->most * (1 + 1e-6));
            if (v.decision == FW_ACCEPT) assert_true(h->most <= 1);
            const fw_verdict_hinge_verdict *tightest = &fabricated->corner[h->corner].hinge[k];
            assert_near(tightest->utilisation, worst[k], 1e-6 * worst[k] + tightest->numeric);
            assert_true(tightest->numeric < 0.03 * worst[k]);
        }
        fw_arena_free(s.arena);
    }
    assert_true(decisions[FW_ACCEPT] > 0 && decisions[FW_INCONCLUSIVE] > 0);
}

/* Pushed, A bends the more the thinner it is; drawn round by a stiff tendon, B is strained the more
   the wider it is: each has a worst corner of its own, and both are run. The loads are such that
   neither hinge is far from its limit. */
static void each_hinge_has_its_own_corner(void **state) {
    (void)state;
    set_up s;
    begin(&s, "120 uN\"/></scene><scene name=\"pull\" duration=\"6 ms\">"
              "<tendon id=\"T\" stiffness=\"1000 N/m\" damping=\"1e-3 N s/m\" draw=\"24 um\" "
              "law=\"ramp\" "
              "rise=\"4 ms\"><eyelet on=\"a\" x=\"0.2 mm\" y=\"0.1 mm\"/>"
              "<eyelet on=\"b\" x=\"-0.2 mm\" y=\"0.1 mm\"/></tendon>"
              "<force on=\"b\" fx=\"0 mN\" fy=\"0 uN");
    fw_verdict v = judge(&s, FW_CORNERS_AUTO);
    const fw_verdict_fabricated_verdict *fabricated = v.variant[0].fabricated;
    assert_non_null(fabricated);
    double worst[2] = {0};
    unsigned where[2] = {0};
    for (unsigned bits = 0; bits < 8; bits++) {
        double x[3];
        corner(&s, bits, x);
        fw_verdict_variant_verdict now = at(&s, x);
        for (int k = 0; k < 2; k++) {
            if (now.hinge[k].utilisation > worst[k])
                worst[k] = now.hinge[k].utilisation, where[k] = bits;
        }
    }
    assert_true(where[0] != where[1]);
    assert_false(fabricated->all); /* found by their slopes */
    for (int k = 0; k < 2; k++) {
        const fw_verdict_hinge_verdict *tightest =
            &fabricated->corner[fabricated->hinge[k].corner].hinge[k];
        /* of B's the thickness makes so little that first order may take the other end */
        assert_near(tightest->utilisation, worst[k], 2e-3 * worst[k]);
        assert_true(worst[k] <= fabricated->hinge[k].most * (1 + 1e-6));
        assert_true(worst[k] > 0.9);
    }
    fw_arena_free(s.arena);
}

/* both bounds, a size that passes 0 and a bound that is the value as drawn */
static const char asked[] =
    "\"/></scene><probe id=\"go\" kind=\"displacement\" on=\"b\" direction=\"90 deg\"/>"
    "<probe id=\"turn\" kind=\"angle\" on=\"a\"/>"
    "<probe id=\"rush\" kind=\"velocity\" on=\"b\"/>"
    "<require probe=\"go\" measure=\"maximum\" scene=\"push\" min=\"1 um\" max=\"%s\"/>"
    "<require probe=\"go\" measure=\"minimum\" scene=\"push\" min=\"-0.1 um\"/>"
    "<require probe=\"go\" measure=\"parasitic\" scene=\"push\" max=\"1 mm\"/>"
    "<require probe=\"turn\" measure=\"final\" scene=\"push\" min=\"-30 deg\" max=\"30 deg\"/>"
    "<require probe=\"rush\" measure=\"peak\" scene=\"push\" max=\"10 m/s\"/>"
    "<scene name=\"rest\" duration=\"1 ms\"><force on=\"b\" fx=\"0 mN\" fy=\"0 uN";

/* the band of a requirement as made holds the bands of all corners, run or not, and is no wider than
   the corners that decide ask for; accepted only where all are */
static void a_requirement_holds_at_every_corner(void **state) {
    (void)state;
    /* the highest corner is at 131.4 um, with its band */
    const char *const most[] = {"200 um", "132 um", "128 um"};
    int decisions[3] = {0}, unrun = 0;
    for (int n = 0; n < 3; n++) {
        set_up s;
        char load[1600];
        int at_most = snprintf(load, sizeof load, "20 uN");
        snprintf(load + at_most, sizeof load - (size_t)at_most, asked, most[n]);
        begin(&s, load);
        fw_verdict v = judge(&s, FW_CORNERS_AUTO);
        const fw_verdict_fabricated_verdict *f = v.variant[0].fabricated;
        assert_non_null(f);
        decisions[v.decision]++;
        unrun += !f->all && f->ncorner < 12;
        fw_verdict_decision all = FW_ACCEPT;
        double low[5], high[5];
        for (int k = 0; k < 5; k++)
            low[k] = HUGE_VAL, high[k] = -HUGE_VAL;
        for (unsigned bits = 0; bits < 8; bits++) {
            double x[3];
            corner(&s, bits, x);
            fw_verdict_variant_verdict now = at(&s, x);
            assert_int_equal(now.nrequirement, 5);
            all = fw_verdict_worse(all, now.decision);
            for (int k = 0; k < 5; k++) {
                low[k] = fmin(low[k], now.requirement[k].low);
                high[k] = fmax(high[k], now.requirement[k].high);
            }
        }
        if (v.decision == FW_ACCEPT) assert_int_equal(all, FW_ACCEPT);
        if (all == FW_ACCEPT) assert_int_equal(v.decision, FW_ACCEPT);
        for (int k = 0; k < 5; k++) {
            int c;
            const fw_verdict_requirement *made = fw_verdict_requirement_made(&v.variant[0], k, &c);
            double wide = high[k] - low[k];
            assert_non_null(made);
            assert_true(made->all_low <= low[k] + 1e-3 * wide);
            assert_true(made->all_high >= high[k] - 1e-3 * wide);
            /* near 0 there is no measure of it, and where a ring ends it is not monotone */
            if (low[k] > 0 && k != 3) assert_true(made->all_high - made->all_low < 1.5 * wide);
        }
        fw_arena_free(s.arena);
    }
    assert_true(decisions[FW_ACCEPT] > 0 && decisions[FW_INCONCLUSIVE] > 0);
    assert_true(unrun > 0);
}

/* nothing that is run stands for what is made while something that moves it is not known: what would be accepted is not,
   and what would be rejected as made might yet be wider */
static void what_nobody_knows_stays_open(void **state) {
    (void)state;
    for (int worse = 0; worse < 2; worse++)
        for (int open = 0; open < 2; open++) {
            set_up s;
            begin(&s, worse ? "150 uN" : "20 uN");
            if (worse)
                s.input[0].nominal = s.input[0].drawn = s.input[0].low = -2e-6,
                s.input[0].high = -1.9e-6;
            if (open)
                s.input[2] = (fw_verdict_fabrication_input){.name = "thickness",
                                                            .q = {.id = "soi.d", .unit = "um"},
                                                            .unknown = "soi.d",
                                                            .open = true};
            fw_verdict v = judge(&s, FW_CORNERS_AUTO);
            assert_int_equal(v.drawn, FW_ACCEPT);
            const fw_verdict_decision known = worse ? FW_REJECT : FW_ACCEPT;
            assert_int_equal(v.decision, open ? FW_INCONCLUSIVE : known);
            assert_int_equal(v.variant[0].fabricated->decision, v.decision);
            int said = 0;
            for (int i = 0; i < v.variant[0].nreason; i++)
                said += v.variant[0].reason[i].number == 694 &&
                        strstr(v.variant[0].reason[i].text, "thickness (soi.d)");
            assert_int_equal(said, open);
            assert_int_equal(v.variant[0].nreason, worse + open);
            const char *why;
            assert_int_equal(fw_verdict_no_number_helps(&v, &why), open);
            if (open) assert_null(v.variant[0].fabricated->control);
            fw_arena_free(s.arena);
        }
}

/* sigma against central differences of full runs */
static void sigma_is_first_order(void **state) {
    (void)state;
    set_up s;
    begin(&s, "20 uN");
    fw_verdict v = judge(&s, FW_CORNERS_AUTO);
    const fw_verdict_fabricated_hinge *h = &v.variant[0].fabricated->hinge[0];
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double x[3] = {s.input[0].nominal, s.input[1].nominal, s.input[2].nominal}, u[2];
        for (int side = 0; side < 2; side++) {
            x[i] = s.input[i].nominal + (side ? 0.1 : -0.1) * s.input[i].sigma;
            u[side] = at(&s, x).hinge[0].utilisation;
        }
        double share = (u[1] - u[0]) / 0.2;
        assert_near(h->share[i], share, 0.12 * h->sigma); /* secants over the range */
        sum += share * share;
    }
    assert_relative(h->sigma, sqrt(sum), 0.15);
    fw_arena_free(s.arena);
}

/* what it says would do does, and a little less does not */
static void what_must_be_held_is_enough(void **state) {
    (void)state;
    set_up s;
    begin(&s, "150 uN");
    fw_verdict v = judge(&s, FW_CORNERS_AUTO);
    const fw_verdict_fabricated_verdict *fabricated = v.variant[0].fabricated;
    assert_int_equal(v.drawn, FW_ACCEPT);
    assert_int_equal(v.decision, FW_INCONCLUSIVE);
    assert_non_null(fabricated->control);
    assert_int_equal(v.variant[0].reason[0].number, 237);
    assert_true(fabricated->held != FW_NONE || fabricated->held_share > 0);
    fw_verdict_fabrication_input was[3];
    memcpy(was, s.input, sizeof was);
    for (int less = 0; less < 2; less++) {
        memcpy(s.input, was, sizeof was);
        for (int i = 0; i < 3; i++) {
            fw_verdict_fabrication_input *in = &s.input[i];
            double share =
                fabricated->held == FW_NONE ? fmin(1, fabricated->held_share + 0.08 * less) : 1;
            in->low = in->nominal + share * (in->low - in->nominal);
            in->high = in->nominal + share * (in->high - in->nominal);
            if (i != fabricated->held) continue;
            double slack = 0.05 * less * (in->high - in->low);
            in->low = fmax(in->low, fabricated->held_low - slack);
            in->high = fmin(in->high, fabricated->held_high + slack);
            in->nominal = fmin(fmax(in->nominal, in->low), in->high);
        }
        fw_verdict again = judge(&s, FW_CORNERS_AUTO);
        assert_int_equal(again.decision, less ? FW_INCONCLUSIVE : FW_ACCEPT);
    }
    fw_arena_free(s.arena);
}

/* of the inputs that would do alone, the one that makes the most of the governing utilisation is
   named: here the edges, whose low end is the bad one */
static void what_counts_most_is_held(void **state) {
    (void)state;
    const char *const load[] = {"138 uN", "141 uN", "144 uN", "147 uN"};
    int held = 0;
    for (size_t n = 0; n < sizeof load / sizeof load[0]; n += (size_t)test_cases(1, 2)) {
        set_up s;
        begin(&s, load[n]);
        fw_verdict v = judge(&s, FW_CORNERS_AUTO);
        const fw_verdict_fabricated_verdict *fabricated = v.variant[0].fabricated;
        if (v.decision == FW_INCONCLUSIVE && fabricated->held != FW_NONE) {
            const double *share = fabricated->hinge[fabricated->governing].share;
            double most = 0;
            int first = FW_NONE;
            for (int i = 0; i < 3; i++) {
                double w = fabs(share[i]) / s.input[i].sigma * (s.input[i].high - s.input[i].low);
                if (w > most) most = w, first = i;
            }
            assert_int_equal(fabricated->held, first);
            assert_true(share[first] < 0 && fabricated->held_low > s.input[first].low);
            held++;
        }
        fw_arena_free(s.arena);
    }
    assert_true(held > 1);
}

/* where the flow makes at its nominal point what is drawn, both have one verdict: that of a run */
static void made_as_drawn(void **state) {
    (void)state;
    set_up s;
    begin(&s, "20 uN");
    s.input[1].nominal = s.input[1].drawn;
    const double x[3] = {s.input[0].nominal, s.input[1].nominal, s.input[2].nominal};
    fw_verdict v = judge(&s, FW_CORNERS_AUTO);
    fw_verdict_variant_verdict again = at(&s, x);
    for (int k = 0; k < 2; k++) {
        const fw_verdict_hinge_verdict *fabricated = &v.variant[0].fabricated->corner[0].hinge[k];
        assert_near(fabricated->utilisation, v.variant[0].hinge[k].utilisation, 0);
        assert_near(fabricated->utilisation, again.hinge[k].utilisation, 1e-12);
    }
    s.input[0].nominal = 0.1e-6; /* a little wider: no longer the same */
    v = judge(&s, FW_CORNERS_AUTO);
    double drawn = v.variant[0].hinge[0].utilisation;
    assert_true(fabs(v.variant[0].fabricated->corner[0].hinge[0].utilisation - drawn) >
                0.01 * drawn);
    fw_arena_free(s.arena);
}

/* a first look decides as the whole one does, also where it is not enough */
static void first_look_decides_alike(void **state) {
    (void)state;
    int decisions[3] = {0};
    for (int n = 0; n < 24; n += test_cases(1, 5)) {
        char load[32];
        snprintf(load, sizeof load, "%d uN", 100 + 12 * n);
        set_up s;
        begin(&s, load);
        fw_verdict v[2];
        for (int coarse = 0; coarse < 2; coarse++) {
            const fw_verdict_options options = {.motion = {.accuracy = 1e-3, .samples = 65},
                                                .corners = FW_CORNERS_FIRST,
                                                .coarse_first = coarse};
            const fw_layout *layout;
            v[coarse] = (fw_verdict){
                .nvariant = 1, .variant = fw_arena_array(s.arena, fw_verdict_variant_verdict, 1)};
            v[coarse].variant[0].variant = &s.variant;
            v[coarse].variant[0].input = s.input, v[coarse].variant[0].ninput = 3;
            assert_int_equal(
                fw_verdict_run(s.arena, s.device, &options, &s.diags, &v[coarse], &layout), FW_OK);
        }
        decisions[v[0].decision]++;
        assert_int_equal(v[0].drawn, v[1].drawn);
        assert_int_equal(v[0].decision, v[1].decision);
        fw_arena_free(s.arena);
    }
    assert_true(decisions[FW_ACCEPT] > 0 && decisions[FW_INCONCLUSIVE] > 0);
    assert_true(decisions[FW_REJECT] > 0);
}

/* Hinges that differ: every pattern of narrower and wider ones, at every corner, by brute force. What is stated of a hinge
   is above all of them, and no more above than what first order is off by; accepted only where all are; and one that
   is alike everywhere is judged as if nobody had asked. */
static void hinges_may_differ(void **state) {
    (void)state;
    const char *const load[] = {"20 uN", "100 uN", "118 uN", "122 uN", "-110 uN"};
    const int loads = test_cases(5, 3);
    int decisions[3] = {0};
    for (int n = 0; n < loads; n++) {
        set_up s;
        begin(&s, load[n]);
        s.input[2] = (fw_verdict_fabrication_input){
            .name = "edge from hinge to hinge", .q = known(0, "m"), .low = -0.2e-6, .high = 0.2e-6, .sigma = 0.1e-6, .local = 1};
        fw_verdict v = judge(&s, FW_CORNERS_AUTO);
        const fw_verdict_fabricated_verdict *f = v.variant[0].fabricated;
        assert_non_null(f);
        decisions[v.decision]++;
        double worst[2] = {0};
        fw_verdict_decision all = FW_ACCEPT;
        for (unsigned bits = 0; bits < 16; bits++) {
            double x[3];
            for (int i = 0; i < 2; i++)
                x[i] = bits >> i & 1u ? s.input[i].high : s.input[i].low;
            x[2] = 0.2e-6;
            const signed char sign[2] = {bits & 4 ? 1 : -1, bits & 8 ? 1 : -1};
            fw_verdict_variant_verdict now = with_signs(&s, x, sign);
            all = fw_verdict_worse(all, now.decision);
            for (int k = 0; k < 2; k++)
                worst[k] = fmax(worst[k], now.hinge[k].utilisation);
        }
        if (v.decision == FW_ACCEPT) assert_int_equal(all, FW_ACCEPT);
        if (all == FW_ACCEPT) assert_int_equal(v.decision, FW_ACCEPT);
        for (int k = 0; k < 2 && v.decision != FW_REJECT; k++) {
            assert_true(worst[k] <= f->hinge[k].most * (1 + 1e-6));
            assert_true(f->hinge[k].most < 1.1 * worst[k]);
        }
        /* at no difference at all the words and the numbers of one that has none */
        s.input[2].low = s.input[2].high = 0;
        v = judge(&s, FW_CORNERS_AUTO);
        assert_int_equal(v.variant[0].fabricated->ncorner > 0, 1);
        for (int c = 0; c < v.variant[0].fabricated->ncorner; c++)
            assert_null(v.variant[0].fabricated->corner[c].sign);
        fw_arena_free(s.arena);
    }
    assert_true(decisions[FW_ACCEPT] > 0 && decisions[FW_INCONCLUSIVE] > 0);
}

/* so are bands of what is required: whichever hinges are narrower, no device that the flow makes is outside */
static void a_requirement_holds_where_hinges_differ(void **state) {
    (void)state;
    set_up s;
    char load[1600];
    const int at_most = snprintf(load, sizeof load, "20 uN");
    snprintf(load + at_most, sizeof load - (size_t)at_most, asked, "300 um");
    begin(&s, load);
    s.input[2] = (fw_verdict_fabrication_input){
        .name = "edge from hinge to hinge", .q = known(0, "m"), .low = -0.2e-6, .high = 0.2e-6, .sigma = 0.1e-6, .local = 1};
    fw_verdict v = judge(&s, FW_CORNERS_AUTO);
    assert_int_equal(v.decision, FW_ACCEPT);
    double low[5], high[5], alike[5][2];
    for (int k = 0; k < 5; k++)
        low[k] = alike[k][0] = HUGE_VAL, high[k] = alike[k][1] = -HUGE_VAL;
    for (unsigned bits = 0; bits < 32; bits++) {
        double x[3] = {0, 0, 0.2e-6};
        for (int i = 0; i < 2; i++)
            x[i] = bits >> i & 1u ? s.input[i].high : s.input[i].low;
        const signed char sign[2] = {bits & 4 ? 1 : -1, bits & 8 ? 1 : -1}, same[2] = {0, 0};
        fw_verdict_variant_verdict now = with_signs(&s, x, bits & 16 ? sign : same);
        assert_int_equal(now.nrequirement, 5);
        for (int k = 0; k < 5; k++) {
            double *least = bits & 16 ? &low[k] : &alike[k][0], *most = bits & 16 ? &high[k] : &alike[k][1];
            *least = fmin(*least, now.requirement[k].low), *most = fmax(*most, now.requirement[k].high);
        }
    }
    int wider = 0;
    for (int k = 0; k < 5; k++) {
        int c;
        const fw_verdict_requirement *made = fw_verdict_requirement_made(&v.variant[0], k, &c);
        const double wide = high[k] - low[k];
        wider += wide > 1.05 * (alike[k][1] - alike[k][0]);
        assert_non_null(made);
        assert_true(made->all_low <= low[k] + 1e-3 * wide);
        assert_true(made->all_high >= high[k] - 1e-3 * wide);
        if (low[k] > 0 && k != 3) assert_true(made->all_high - made->all_low < 2 * wide);
    }
    assert_true(wider > 2);
    fw_arena_free(s.arena);
}

/* two inputs by which hinges differ add up to one of both */
static void hinges_differ_by_all_that_is_stated(void **state) {
    (void)state;
    double most[2];
    for (int two = 0; two < 2; two++) {
        set_up s;
        begin(&s, "20 uN");
        const double d = two ? 0.1e-6 : 0.2e-6;
        const fw_verdict_fabrication_input apart = {
            .name = "apart", .q = known(0, "m"), .low = -d, .high = d, .sigma = d / 2, .local = 1};
        s.input[1] = s.input[2] = apart;
        if (!two) s.input[1].low = s.input[1].high = 0;
        fw_verdict v = judge(&s, FW_CORNERS_AUTO);
        assert_int_equal(v.decision, FW_ACCEPT);
        most[two] = v.variant[0].fabricated->hinge[0].most;
        fw_arena_free(s.arena);
    }
    assert_relative(most[1], most[0], 1e-9);
}

/* one narrower hinge of two that share a flexure: the other one stays as it is */
static void a_hinge_alone_is_narrower(void **state) {
    (void)state;
    set_up s;
    begin(&s, "20 uN");
    fw_device shared = *s.device;
    fw_device_revolute joint[2] = {s.device->revolute[0], s.device->revolute[1]};
    joint[1].flexure = 0;
    shared.revolute = joint;
    const signed char sign[2] = {0, -1};
    const fw_verdict_fabrication made = {0.1e-6, 0, 1, 1, 0, 0, 0.3e-6, sign};
    fw_verdict_fabricated_device d;
    assert_int_equal(fw_verdict_fabrication_build(s.arena, &shared, NULL, &s.variant, &made, &d), FW_OK);
    const fw_device *now = &d.device;
    assert_near(now->flexure[now->revolute[0].flexure].width_m, 8.2e-6, 1e-15);
    assert_near(now->flexure[now->revolute[1].flexure].width_m, 7.6e-6, 1e-15);
    assert_near(now->flexure[now->revolute[1].flexure].gap_m, 6.4e-6, 1e-15);
    assert_int_equal(s.device->nflexure, 2);
    assert_int_equal(s.device->revolute[1].flexure, 1);
    fw_arena_free(s.arena);
}

static void drawn_only_when_asked(void **state) {
    (void)state;
    set_up s;
    begin(&s, "150 uN");
    fw_verdict v = judge(&s, FW_CORNERS_NONE);
    assert_null(v.variant[0].fabricated);
    assert_int_equal(v.decision, FW_ACCEPT);
    assert_int_equal(v.drawn, FW_ACCEPT);
    fw_arena_free(s.arena);
}

/* a stator whose gap loses 1 um as made nominally and 2 um where one edge is at its end; then nothing is known of what it loses there,
   and so nothing of a corner that is not run */
static void what_is_not_known_leaves_no_gap(void **state) {
    (void)state;
    fw_wiring_moved drawn = {.stator = "c", .start_m = 10e-6, .low_m = 9e-6}, nominal = drawn, off = drawn;
    const fw_verdict_fabrication_input input = {.nominal = 0, .low = -1, .high = 1, .edge_m = 1e-6};
    const double x[] = {0, -1};
    fw_verdict_fabricated_corner corner[] = {{.stator = &nominal, .nstator = 1, .x = x}, {.stator = &off, .nstator = 1, .x = x + 1}};
    fw_verdict_fabricated_verdict fabricated = {.corner = corner, .ncorner = 2};
    fw_verdict_variant_verdict v = {.input = &input, .ninput = 1, .stator = &drawn, .nstator = 1};
    const fw_verdict_search s = {.v = &v, .fabricated = &fabricated, .first = 2, .slope_point = {1}};
    off.low_m = 8e-6;
    fw_verdict_stators_made(&s, &v);
    assert_near(drawn.low_m, 8e-6, 1e-7);
    corner[1].nstator = 0;
    fw_verdict_stators_made(&s, &v);
    assert_near(drawn.low_m, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_made_follows_the_edges),
        cmocka_unit_test(pieces_keep_the_widths_of_what_is_left),
        cmocka_unit_test(a_crystal_has_a_modulus_too),
        cmocka_unit_test(what_is_not_known_leaves_no_gap),
        cmocka_unit_test(no_corner_is_worse),
        cmocka_unit_test(each_hinge_has_its_own_corner),
        cmocka_unit_test(a_requirement_holds_at_every_corner),
        cmocka_unit_test(a_requirement_holds_where_hinges_differ),
        cmocka_unit_test(sigma_is_first_order),
        cmocka_unit_test(what_nobody_knows_stays_open),
        cmocka_unit_test(what_must_be_held_is_enough),
        cmocka_unit_test(what_counts_most_is_held),
        cmocka_unit_test(hinges_may_differ),
        cmocka_unit_test(hinges_differ_by_all_that_is_stated),
        cmocka_unit_test(a_hinge_alone_is_narrower),
        cmocka_unit_test(made_as_drawn),
        cmocka_unit_test(first_look_decides_alike),
        cmocka_unit_test(drawn_only_when_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
