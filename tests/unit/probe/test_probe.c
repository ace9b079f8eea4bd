/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "probe/probe.h"
#include <float.h>
#include <math.h>

/* a device with one probe: the angle of its one body */
typedef struct fixture {
    fw_arena *arena;
    fw_device_probe probe;
    fw_device_body body;
    fw_device device;
    fw_device_scene scene;
    fw_mechanism_mass mass;
    fw_mechanism mechanism;
    fw_effects_loads loads;
    bool history;
    fw_probe_monitor monitor;
} fixture;

static void begin(fixture *f) {
    *f = (fixture){.arena = fw_arena_new(0), .history = true};
    f->probe = (fw_device_probe){
        .id = "turn", .row = FW_PROBE_IS_angle, .body_b = FW_GROUND, .direction_rad = (double)NAN};
    f->device = (fw_device){.probe = &f->probe, .nprobe = 1, .body = &f->body, .nbody = 1};
    f->loads = (fw_effects_loads){.nbody = 1};
    f->mechanism = (fw_mechanism){.device = &f->device, .body = &f->mass, .nbody = 1};
    assert_int_equal(
        fw_probe_monitor_new(f->arena, &f->mechanism, &f->scene, &f->history, NULL, &f->monitor),
        FW_OK);
    fw_probe_monitor_record(&f->monitor, NULL);
}

static void show(fixture *f, double t_s, double angle_rad, bool begins) {
    const double q[3] = {0, 0, angle_rad};
    const fw_dynamics_instant now = {
        .t_s = t_s, .piece_s = t_s, .q = q, .loads = &f->loads, .begins = begins};
    fw_probe_monitor_record(&f->monitor, &now);
}

/* 0.3 + sin t over a period and a half in 36 unequal steps: extremes 1.3 and -0.7, which no instant
   meets */
static void finds_extremes_between_instants(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    for (int i = 0; i <= 36; i++) {
        double t = 0.25 * (i + 0.2 * sin(3.0 * i));
        show(&f, t, 0.3 + sin(t), i == 0);
    }
    const fw_probe_course *c = f.monitor.course;
    assert_true(fabs(c->maximum.value - 1.3) < 1e-4);
    assert_true(fabs(c->minimum.value + 0.7) < 1e-4);
    assert_true(fabs(c->maximum.value - 1.3) <= c->maximum.between);
    assert_true(fabs(c->minimum.value + 0.7) <= c->minimum.between);
    assert_true(fabs(c->minimum.t_s - 1.5 * acos(-1.0)) < 0.01);
    fw_arena_free(f.arena);
}

static fw_status late_from(const void *of, const fw_probe_monitor *monitor, double *late_s) {
    (void)monitor;
    return *late_s = *(const double *)of, FW_OK;
}

/* A ramp that ends three periods before the end, and a ring of 0.01 of it behind: what is kept are three periods, and the ring is
   0.01, however few rows a motion has; ten thousand instants a period are thinned out, and the ring is the same */
static void rings_as_it_ends(void **state) {
    (void)state;
    const double turn = 2 * acos(-1.0), from = 37, end = 40;
    const bool late = true;
    for (int many = 0; many < 2; many++) {
        fixture f;
        fw_probe_ring ring;
        begin(&f);
        f.monitor.history = NULL, f.monitor.late = &late;
        f.monitor.late_from = late_from, f.monitor.of = &from;
        const int n = many ? 100000 : 13;
        for (int i = 0; i <= 40 * n; i++) {
            const double t = (double)i / n;
            if (many && t < 36.9) continue;
            show(&f, t, fmin(t / from, 1) + (t > from ? 0.01 * sin(turn * t) : 0), i == 0);
        }
        const fw_probe_course *c = f.monitor.course;
        assert_true(c->kept <= FW_PROBE_KEPT_LATE && c->time[0] >= fw_probe_rings_from(end, 1));
        fw_probe_rings(c, 1, &ring);
        assert_true(fabs(ring.amplitude - 0.01) < 2e-4);
        assert_true(fabs(ring.low - 0.99) < 2e-4 && fabs(ring.high - 1.01) < 2e-4);
        fw_probe_rings(c, 0, &ring); /* nothing swings */
        assert_true(ring.amplitude == 0 && ring.low == c->final && ring.high == c->final);
        fw_arena_free(f.arena);
    }
}

/* the top lies at a jump: no parabola goes through both sides of it */
static void a_jump_is_no_peak(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    const double value[] = {0, 1, 2, 1.9, 0.5, 0};
    for (int i = 0; i < 6; i++)
        show(&f, i < 3 ? i : i - 1, value[i], i == 0 || i == 3);
    assert_true(f.monitor.course->maximum.value == 2.0);
    assert_true(f.monitor.course->minimum.value == 0.0);
    fw_arena_free(f.arena);
}

/* a third of a step is up to 2.1 rad of a sine: steps whose thirds stand for them never hold an extreme beyond those so far,
   at any phase; and most steps of a swing that is not the largest do stand */
static void thirds_of_a_sine(void **state) {
    (void)state;
    int stood = 0, of = 0;
    for (int n = 1; n <= 42; n++)
        for (int k = 0; k < 90; k++) {
            const double third = 0.05 * n, at = acos(-1.0) * k / 45, most = n % 2 ? 1 : 1.2;
            fixture f;
            begin(&f);
            f.history = false;
            show(&f, -3, -most, true), show(&f, -2, most, false), show(&f, -1, 0, false);
            show(&f, 0, sin(at), false);
            f.monitor.course->maximum.value = most, f.monitor.course->minimum.value = -most;
            double angle[FW_THIRDS], top = sin(at);
            fw_dynamics_instant now[FW_THIRDS];
            double q[FW_THIRDS][3] = {{0}};
            for (int i = 0; i < FW_THIRDS; i++) {
                q[i][2] = angle[i] = sin(at + (i + 1) * third);
                now[i] = (fw_dynamics_instant){
                    .t_s = i + 1, .piece_s = i + 1, .q = q[i], .loads = &f.loads};
            }
            for (int i = 0; i <= 300; i++)
                top = fmax(top, fabs(sin(at + i * third / 100)));
            const bool stands = fw_probe_monitor_glance(&f.monitor, now);
            if (most <= 1) assert_false(stands && top > 0.999999);
            stood += stands && most > 1 && third<0.3, of += most> 1 && third < 0.3;
            f.history = true;
            assert_false(fw_probe_monitor_glance(&f.monitor, now)); /* whose course is kept */
            fw_arena_free(f.arena);
        }
    assert_int_equal(stood, of);
}

/* e^-t cos(10 t) about 0: within 0.1 for good from where e^-t cos(10 t) = +-0.1 last */
static void settles_at_the_last_crossing(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    for (int i = 0; i <= 4000; i++) {
        double t = 0.005 * i;
        show(&f, t, exp(-t) * cos(10 * t), i == 0);
    }
    double last = 0;
    for (int i = 0; i <= 2000000; i++) {
        double t = 1e-5 * i;
        if (fabs(exp(-t) * cos(10 * t)) > 0.1) last = t;
    }
    assert_true(fabs(fw_probe_settling_s(f.monitor.course, 0, 0.1) - last) < 1e-4);
    assert_true(fw_probe_settling_s(f.monitor.course, 0, 2) == 0);
    fw_arena_free(f.arena);
}

/* a probe that nobody asks for has no course, whatever it would say */
static void looks_at_what_is_asked_for(void **state) {
    (void)state;
    static const bool none[] = {false}, all[] = {true};
    for (int k = 0; k < 2; k++) {
        fixture f;
        begin(&f);
        assert_int_equal(
            fw_probe_monitor_new(f.arena, &f.mechanism, &f.scene, NULL, k ? all : none, &f.monitor),
            FW_OK);
        for (int i = 0; i < 3; i++)
            show(&f, i, 1 + i, i == 0);
        assert_int_equal(f.monitor.course->count, k ? 3 : 0);
        fw_arena_free(f.arena);
    }
}

/* 0, 2 and 1 rad at instants that two runs share: nothing lies between them and the runs agree, so that the error is what the
   motion's own share and rounding make of the value, 64 spacings of doubles */
static void an_error_has_the_share_of_the_motion_and_rounding(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    const double value[] = {0, 0, 2, 2, 1, 1};
    for (int i = 0; i < 6; i++) /* level on either side of each extreme */
        show(&f, i, value[i], i % 2 == 0);
    fw_dynamics_peak peak = {.angle_rad = 2, .error_rad = 0};
    fw_dynamics_motion motion = {.npin = 1, .peak = &peak, .stats = {.estimate_margin = 1}};
    f.mechanism.npin = 1;
    for (int i = 0; i < 2; i++) {
        fw_probe_result r;
        peak.error_rad = i * 0.01;
        fw_probe_result_of(&f.monitor, &f.monitor, &motion, 0, &r);
        assert_true(r.known && r.maximum == 2 && r.final == 1);
        assert_relative(r.numeric, 2 * (i * 0.005 + 64 * DBL_EPSILON), 1e-12);
        assert_relative(r.final_numeric, r.numeric, 1e-12);
    }
    fw_arena_free(f.arena);
}

/* A finer run is unsettled by twice the margin of what it and a coarser one differ by, above or below, of what the probe reaches,
   against 30 times the accuracy wanted and 3 % at most. */
static void a_run_is_unsettled_by_what_a_coarser_one_differs_by(void **state) {
    (void)state;
    static const struct {
        double above, below, accuracy, worst;
    } row[] = {{0, 0, 1e-4, 0},
               {0.006, 0, 1e-4, 2 * 1.5 * 0.006 / (0.003 * 2)},
               {0.006, -0.009, 1e-4, 2 * 1.5 * 0.009 / (0.003 * 2)},
               {-0.006, 0, 1e-2, 2 * 1.5 * 0.006 / (0.03 * 2)}};
    const double asked = 1;
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        fixture f, coarse;
        begin(&f), begin(&coarse);
        const double value[] = {2, 2, -1, -1}, off[] = {row[k].above, row[k].below};
        for (int i = 0; i < 4; i++) {
            show(&f, i, value[i], i % 2 == 0);
            show(&coarse, i, value[i] - off[i / 2], i % 2 == 0);
        }
        f.monitor.judged = &f.history, f.monitor.asked = &asked;
        assert_near(fw_probe_monitor_unsettled(&f.monitor, &coarse.monitor, 1.5, row[k].accuracy),
                    row[k].worst, 1e-9);
        fw_arena_free(f.arena), fw_arena_free(coarse.arena);
    }
}

/* a distance begins at what is drawn of it: between points, or along a direction that is stated in a body's frame */
static void a_distance_begins_as_drawn(void **state) {
    (void)state;
    fw_device_probe asked = {
        .row = FW_PROBE_IS_distance, .body = FW_GROUND, .direction_rad = (double)NAN};
    fw_mechanism_mass mass = {.phi_rad = -0.5 * acos(-1.0)};
    const fw_mechanism mechanism = {.body = &mass, .nbody = 1};
    const fw_probe p = {.asked = &asked,
                        .kind = &fw_device_probe_kinds[FW_PROBE_IS_distance],
                        .mechanism = &mechanism,
                        .drawn = {{1e-3, 2e-3}, {4e-3, 6e-3}}};
    assert_near(fw_probe_origin(&p), 5e-3, 1e-15);
    asked.direction_rad = 0.5 * acos(-1.0);
    assert_near(fw_probe_origin(&p), 4e-3, 1e-15);
    asked.body = 0;
    assert_near(fw_probe_origin(&p), 3e-3, 1e-15);
}

/* A point that goes 1 mm sin t across its direction, and along it as far as it is drawn from the body's middle: the largest between
   instants, and what the parabola may be off by; along a direction of 60 degrees both coordinates count. */
static void what_is_across_has_its_extreme_between_instants(void **state) {
    (void)state;
    const double turn = acos(-1.0) / 3, c = cos(turn), s = sin(turn);
    fixture f;
    begin(&f);
    f.probe = (fw_device_probe){
        .id = "tip", .row = FW_PROBE_IS_displacement, .body_b = FW_GROUND, .direction_rad = turn};
    double last = 0;
    for (int i = 0; i <= 30; i++) {
        const double t = 0.1 * (i + 0.2 * sin(3.0 * i)), across = 1e-3 * sin(t), along = 2e-4 * t;
        const double q[3] = {along * c - across * s, along * s + across * c, 0};
        const fw_dynamics_instant now = {
            .t_s = t, .piece_s = t, .q = q, .loads = &f.loads, .begins = i == 0};
        fw_probe_monitor_record(&f.monitor, &now);
        last = along;
    }
    const fw_probe_course *course = f.monitor.course;
    assert_relative(course->maximum.value, last, 1e-12);
    assert_true(fabs(course->across.value - 1e-3) <= course->across.between);
    assert_true(course->across.between > 0 && course->across.between < 1e-5);
    fw_arena_free(f.arena);
}

/* the rate of an angle and of a place is the velocity that the motion has, also where bodies hang on each other */
static void rates_are_of_the_motion(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    double t = 1, q[6] = {1e-3, 2e-3, 0.3, 4e-3, 5e-3, -0.2}, v[6] = {3e-3, -4e-3, 5, 0, 0, 7},
           angle = -0.5, room[7];
    fw_mechanism_mass mass[2] = {{0}, {0}};
    fw_mechanism_pin pin = {.body_a = 0, .body_b = 1, .ax_m = 1e-3};
    fw_mechanism m = {.device = &f.device, .body = mass, .nbody = 2, .pin = &pin, .npin = 1};
    const fw_dynamics_motion motion = {
        .nbody = 2, .npin = 1, .nsample = 1, .t_s = &t, .q = q, .v = v, .angle_rad = &angle};
    const fw_effects_loads loads = {.nbody = 2};
    static const struct {
        fw_device_probe_row row;
        double direction_rad, rate;
    } row[] = {{FW_PROBE_IS_angle, (double)NAN, 5},
               {FW_PROBE_IS_displacement, 0, 3e-3},
               {FW_PROBE_IS_displacement, 1.5707963267948966, -4e-3}};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        fw_probe *p;
        f.probe = (fw_device_probe){.id = "p",
                                    .row = row[k].row,
                                    .body_b = FW_GROUND,
                                    .direction_rad = row[k].direction_rad};
        assert_int_equal(fw_probe_bind(f.arena, &m, &f.scene, &loads, &p), FW_OK);
        assert_relative(fw_probe_rate_at_row(p, &motion, 0, room), row[k].rate, 1e-6);
        assert_relative(room[6] - angle, (room[2] - q[2]) / v[2] * (v[5] - v[2]),
                        1e-9); /* the pin turns with both */
    }
    fw_arena_free(f.arena);
}

static void values_have_a_prefix(void **state) {
    (void)state;
    char text[FW_PROBE_TEXT];
    assert_string_equal(fw_probe_text(text, 3.5412e-4, "N"), "354.1 uN");
    assert_string_equal(fw_probe_text(text, -1e-3, "m"), "-1 mm");
    assert_string_equal(fw_probe_text(text, 1234, "Hz"), "1.234 kHz");
    assert_string_equal(fw_probe_text(text, 0, "rad"), "0 rad");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_extremes_between_instants),
        cmocka_unit_test(rings_as_it_ends),
        cmocka_unit_test(a_jump_is_no_peak),
        cmocka_unit_test(thirds_of_a_sine),
        cmocka_unit_test(settles_at_the_last_crossing),
        cmocka_unit_test(looks_at_what_is_asked_for),
        cmocka_unit_test(an_error_has_the_share_of_the_motion_and_rounding),
        cmocka_unit_test(a_run_is_unsettled_by_what_a_coarser_one_differs_by),
        cmocka_unit_test(a_distance_begins_as_drawn),
        cmocka_unit_test(what_is_across_has_its_extreme_between_instants),
        cmocka_unit_test(rates_are_of_the_motion),
        cmocka_unit_test(values_have_a_prefix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
