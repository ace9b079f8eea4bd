/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random devices near nothing in particular: chains and six-bars under loads that are scaled as a
   whole, as XML, and what judges them in silicon. */
#ifndef FW_TEST_RANDOM_DEVICE_H
#define FW_TEST_RANDOM_DEVICE_H
#include "base/constants.h"
#include "dynamics/models.h"
#include "verdict/verdict.h"

static inline double device_between(uint64_t *seed, double low, double high) {
    return low + (high - low) * rig_random(seed);
}
static inline double device_spread(uint64_t *seed, double low, double high) {
    return low * pow(high / low, rig_random(seed));
}
static inline bool device_chance(uint64_t *seed, double p) {
    return rig_random(seed) < p;
}

static inline void device_number(fw_text *t, const char *before, double value, const char *after) {
    fw_text_add(t, before);
    fw_text_number(t, value, 9);
    fw_text_add(t, after);
}

/* ---- loads: scaled as a whole ---- */

static inline void device_law(fw_text *t, uint64_t *seed, double period_ms) {
    double kind = rig_random(seed);
    if (kind < 0.35)
        device_number(t, " law=\"ramp\" rise=\"", period_ms * device_spread(seed, 0.2, 8), " ms\"");
    else if (kind < 0.6)
        device_number(t, " law=\"sine\" frequency=\"",
                      1e3 / period_ms * device_spread(seed, 0.05, 2.5), " Hz\"");
}

static inline void device_load(fw_text *t, uint64_t *seed, const char *on, double torque,
                               double force, double period_ms, double by) {
    if (device_chance(seed, 0.7)) {
        fw_text_printf(t, "    <torque on=\"%s\"", on);
        device_number(t, " value=\"", by * torque * device_between(seed, -1, 1), " N m\"");
        device_law(t, seed, period_ms);
        fw_text_add(t, "/>\n");
    }
    if (device_chance(seed, 0.6)) {
        fw_text_printf(t, "    <force on=\"%s\"", on);
        device_number(t, " fx=\"", by * force * device_between(seed, -1, 1), " N\"");
        device_number(t, " fy=\"", by * force * device_between(seed, -1, 1), " N\"");
        device_law(t, seed, period_ms);
        fw_text_add(t, "/>\n");
    }
}

static inline void device_surroundings(fw_text *t, uint64_t *seed) {
    if (device_chance(seed, 0.25))
        fw_text_add(t, "    <gravity gx=\"0 m/s^2\" gy=\"-9.81 m/s^2\"/>\n");
    if (device_chance(seed, 0.2)) {
        device_number(t, "    <temperature change=\"", device_between(seed, -60, 60),
                      " K\" expansion=\"2.6 ppm/K\"");
        fw_text_add(t, " substrate-expansion=\"2.6 ppm/K\" modulus-change=\"-60 ppm/K\"/>\n");
    }
    if (device_chance(seed, 0.25))
        device_number(t, "    <material-damping loss-factor=\"", device_spread(seed, 1e-4, 3e-2),
                      "\"/>\n");
}

/* ---- devices ---- */

static inline void device_flexure(fw_text *t, uint64_t *seed, const char *id, bool drawn) {
    bool leaf = !drawn && device_chance(seed, 0.3);
    double width = device_between(seed, 6, 10), length = device_between(seed, 200, 400);
    fw_text_printf(t, "  <flexure id=\"%s\" kind=\"%s\"", id, leaf ? "leaf" : "csfh");
    device_number(t, " width=\"", width, " um\"");
    device_number(t, " length=\"", length, " um\" fillet=\"6 um\"");
    if (!leaf)
        device_number(t, " angle=\"", drawn ? 240 : device_between(seed, 100, 260), " deg\"");
    fw_text_add(t, drawn ? " gap=\"8 um\"/>\n" : "/>\n");
}

/* The way from a hinge's first body to its second, near which its flexure's axis is: a description that leaves it out asks
   for bands over all directions. Of a generator of its own, so that all else of a device is as it was without it */
static inline void device_axis(fw_text *t, uint64_t *seed, double way_rad) {
    device_number(t, " axis=\"", (way_rad + device_between(seed, -0.6, 0.6)) * FW_DEG_PER_RAD,
                  " deg\"");
}

static inline void device_chain(fw_text *t, uint64_t *seed, double by) {
    uint64_t axes = *seed + 1;
    int n = 1 + (int)(3.999 * rig_random(seed));
    char id[16];
    double x = 0, y = 0, ax = 0, ay = 0, angle = 0, period_ms = device_spread(seed, 0.2, 1.0);
    for (int i = 0; i < n; i++) {
        snprintf(id, sizeof id, "f%d", i);
        device_flexure(t, seed, id, false);
    }
    fw_text_add(t, "  <mechanism>\n");
    fw_text joints = fw_text_new(t->arena);
    for (int i = 0; i < n; i++) {
        double l = device_between(seed, 0.4, 1.2), mass = device_spread(seed, 3e-3, 3e-2);
        angle += device_between(seed, -1.2, 1.2);
        double mx = x + 0.5 * l * cos(angle), my = y + 0.5 * l * sin(angle);
        fw_text_printf(t, "    <body id=\"b%d\"", i);
        device_number(t, " mass=\"", mass, " mg\"");
        device_number(t, " inertia=\"", mass * l * l / 12, " mg mm^2\"");
        device_number(t, " x=\"", mx, " mm\"");
        device_number(t, " y=\"", my, " mm\"/>\n");
        snprintf(id, sizeof id, "b%d", i - 1);
        fw_text_printf(&joints, "    <revolute id=\"h%d\" a=\"%s\" b=\"b%d\" hinge=\"f%d\"", i,
                       i ? id : "ground", i, i);
        device_number(&joints, " a-x=\"", x - ax, " mm\"");
        device_number(&joints, " a-y=\"", y - ay, " mm\"");
        device_number(&joints, " b-x=\"", x - mx, " mm\"");
        device_number(&joints, " b-y=\"", y - my, " mm\"");
        device_axis(&joints, &axes, angle);
        if (device_chance(seed, 0.5))
            device_number(&joints, " damping=\"", device_spread(seed, 1e-13, 3e-11),
                          " N m s/rad\"");
        fw_text_add(&joints, "/>\n");
        x += l * cos(angle), y += l * sin(angle);
        ax = mx, ay = my;
    }
    fw_text_add(t, joints.data);
    fw_text_add(t, "  </mechanism>\n");
    device_number(t, "  <scene name=\"s\" duration=\"", period_ms * device_between(seed, 2, 8),
                  " ms\">\n");
    for (int i = 0; i < n; i++) {
        snprintf(id, sizeof id, "b%d", i);
        if (i == n - 1 || device_chance(seed, 0.5))
            device_load(t, seed, id, 3e-7, 2e-4, period_ms, by);
    }
    device_surroundings(t, seed);
    fw_text_printf(t, "    <torque on=\"b%d\"", n - 1);
    device_number(t, " value=\"", by * 1e-7, " N m\"/>\n  </scene>\n");
}

static inline void device_six_bar(fw_text *t, uint64_t *seed, double by) {
    static const double place[6][2] = {{0.7, 0.15}, {0.2, 1.4},   {0.8, 2.7},
                                       {2.2, 2.75}, {2.85, 1.45}, {2.3, 0.15}};
    bool drawn = device_chance(seed, 0.25), stated = device_chance(seed, 0.5);
    uint64_t axes = *seed + 1;
    static const char *const link[] = {"AB", "BC", "DE", "EF"};
    char id[2] = "A";
    for (int i = 0; i < 6; i++, id[0]++)
        device_flexure(t, seed, id, drawn);
    fw_text_add(t, "  <six-bar>\n");
    for (int i = 0; i < 6; i++) {
        id[0] = (char)('A' + i);
        double off = drawn ? 0.02 : 0.1;
        fw_text_printf(t, "    <hinge at=\"%s\" flexure=\"%s\"", id, id);
        device_number(t, " x=\"", place[i][0] + device_between(seed, -off, off), " mm\"");
        device_number(t, " y=\"", place[i][1] + device_between(seed, -off, off), " mm\"");
        const double *before = place[i > 0 ? i - 1 : 0], *after = place[i < 5 ? i + 1 : 5];
        if (!drawn) /* else its drawing says it */
            device_axis(t, &axes, atan2(after[1] - before[1], after[0] - before[0]));
        if (stated)
            device_number(t, " stiffness=\"", device_spread(seed, 1.3e-6, 2e-6), " N m/rad\"");
        if (device_chance(seed, 0.7))
            device_number(t, " damping=\"", device_spread(seed, 1e-12, 5e-11), " N m s/rad\"");
        fw_text_add(t, "/>\n");
    }
    for (int i = 0; i < 4; i++) {
        fw_text_printf(t, "    <link id=\"%s\"%s", link[i], drawn ? " width=\"120 um\"" : "");
        device_number(t, " mass=\"", device_between(seed, 0.015, 0.025), " mg\"");
        device_number(t, " inertia=\"", device_between(seed, 0.002, 0.004), " mg mm^2\"/>\n");
        if (i == 1)
            fw_text_add(t,
                        "    <platform id=\"CD\" width=\"1.40 mm\" height=\"0.40 mm\" x=\"1.50 mm\""
                        " y=\"2.875 mm\" mass=\"0.0653 mg\" inertia=\"0.01155 mg mm^2\"/>\n");
    }
    fw_text_add(t, "  </six-bar>\n");
    device_number(t, "  <scene name=\"s\" duration=\"", device_between(seed, 1, 6), " ms\">\n");
    device_load(t, seed, "CD", 1.5e-7, 3e-4, 1.5, by);
    device_load(t, seed, "AB", 1.5e-7, 1e-4, 1.5, by);
    device_surroundings(t, seed);
    device_number(t, "    <torque on=\"EF\" value=\"", by * 2e-8, " N m\"/>\n  </scene>\n");
    if (device_chance(seed, 0.3))
        fw_text_add(
            t, "  <workspace x-min=\"-60 um\" x-max=\"60 um\" y-min=\"-30 um\" y-max=\"30 um\" "
               "phi-min=\"-1 deg\" phi-max=\"1 deg\"/>\n");
}

static const char *device_describe(fw_arena *arena, uint64_t seed, double by) {
    fw_text t = fw_text_new(arena);
    for (int i = 0; i < 5; i++)
        rig_random(&seed);
    fw_text_add(&t, "<device xmlns=\"urn:flexwright:device:1\" name=\"random\">\n"
                    "  <material ref=\"silicon-100\" thickness=\"50 um\"/>\n"
                    "  <limits safety-factor=\"1.5\"/>\n");
    if (device_chance(&seed, 0.6))
        device_chain(&t, &seed, by);
    else
        device_six_bar(&t, &seed, by);
    fw_text_add(&t, "</device>\n");
    assert_int_equal(fw_text_end(&t), FW_OK);
    return t.data;
}

static inline fw_quantity device_known(double value) {
    return (fw_quantity){.value = value, .unit = "1", .status = FW_TYPICAL, .source = ""};
}

static inline fw_mechanism_variant device_silicon(void) {
    return (fw_mechanism_variant){.material = {.id = "silicon-100",
                                               .name = "silicon",
                                               .youngs = device_known(169e9),
                                               .poisson = device_known(0.28),
                                               .density = device_known(2329),
                                               .strength = device_known(2.5e9),
                                               .criterion = "fracture",
                                               .loss = device_known(1e-3),
                                               .expansion = device_known(2.6e-6),
                                               .modulus_change = device_known(-60e-6)},
                                  .substrate_expansion = device_known(2.6e-6),
                                  .thickness_m = 50e-6,
                                  .explicit_mass_scale = 1,
                                  .explicit_stiffness_scale = 1,
                                  .explicit_damping_scale = 1};
}

/* ---- judging ---- */

static inline fw_status device_judge(fw_arena *arena, const char *xml, double accuracy,
                                     fw_verdict *verdict, const char **message) {
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    const fw_layout *layout;
    *message = "";
    fw_status status =
        fw_device_read(arena, "random.xml", xml, strlen(xml), NULL, 0, &diags, &device);
    if (status != FW_OK) fail_msg("%s\n%s", diags.item[0].message, xml);
    fw_mechanism_variant *variant = fw_arena_one(arena, fw_mechanism_variant);
    *variant = device_silicon();
    *verdict = (fw_verdict){.nvariant = 1,
                            .variant = fw_arena_array(arena, fw_verdict_variant_verdict, 1)};
    verdict->variant[0].variant = variant;
    const fw_verdict_options options = {.motion = {.accuracy = accuracy, .samples = 65}};
    status = fw_verdict_run(arena, device, &options, &diags, verdict, &layout);
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].severity == FW_ERROR) *message = diags.item[i].message;
    return status;
}

/* the factor of its loads by which the governing hinge is near its limit; false: it has no verdict
 */
static inline bool device_aimed(fw_arena *arena, uint64_t seed, double *by) {
    fw_verdict first;
    const char *message;
    uint64_t aim = seed * 2654435761u + 1;
    rig_random(&aim), rig_random(&aim);
    *by = 1;
    bool fine = true;
    for (int round = 0; round < 2 && fine; round++) {
        fine = device_judge(arena, device_describe(arena, seed, *by), 1e-3, &first, &message) ==
                   FW_OK &&
               first.governing != FW_NONE;
        double used = fine ? first.hinge[first.governing].utilisation : 1;
        if (fine) *by *= device_spread(&aim, 0.85, 1.18) / fmin(fmax(used, 0.02), 50);
    }
    return fine;
}

#endif
