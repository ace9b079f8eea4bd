/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bound on what a row of equilibria misses, against the motion of one mode integrated in small
   steps; the envelope is filled by hand. */
#include "quantity/law_kind.h"
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include "test.h"

static const double mass = 2e-8, own = 3e-15, arm = 1e-3, stiffness = 1e-6, load = 1e-7;
static const double pi = 3.14159265358979323846;

typedef struct lever { /* a bar on the ground, torsion spring and damper, torques with laws */
    fw_arena *arena;
    fw_mechanism_mass body[1];
    fw_mechanism_pin pin[1];
    fw_device_torque torque[3];
    fw_device_initial initial[1];
    fw_mechanism m;
    fw_device_scene scene;
    fw_effects_envelope e;
    fw_effects_modal modal;
    fw_effects_loads loads;
    double omega, floor;
} lever;

static void lever_new(lever *s, double c) {
    memset(s, 0, sizeof *s);
    s->arena = fw_arena_new(0);
    s->body[0] = (fw_mechanism_mass){"lever", mass, own, arm, 0, 0, {0, 0}};
    s->pin[0] = (fw_mechanism_pin){.id = "O",
                                   .body_a = FW_GROUND,
                                   .body_b = 0,
                                   .bx_m = -arm,
                                   .stiffness_Nm_per_rad = stiffness,
                                   .damping_Nms_per_rad = c,
                                   .hinge = FW_NONE};
    s->m = (fw_mechanism){.body = s->body, .pin = s->pin, .nbody = 1, .npin = 1};
    s->scene =
        (fw_device_scene){.name = "s", .duration_s = 1, .torque = s->torque, .initial = s->initial};
    s->omega = sqrt(stiffness / (own + mass * arm * arm));
    s->floor = 1;
}

/* an envelope of the modes with all that the scene calls for, against `floor`, without a margin */
static double bound_of(lever *s, const char **reason) {
    const fw_effect_case c = {s->arena, &s->m, &s->scene, &s->e, NULL, NULL};
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    assert_int_equal(fw_effects_loads_new(s->arena, &s->m, &s->scene, &s->loads), FW_OK);
    for (size_t i = 0; i < count; i++)
        if (row[i]->called_for(&c)) assert_int_equal(row[i]->add(&c, &s->loads), FW_OK);
    assert_int_equal(fw_effects_modal_find(s->arena, &s->m, &s->scene, &s->loads, &s->modal),
                     FW_OK);
    s->e = (fw_effects_envelope){.valid = !s->modal.why_not,
                                 .why_not = s->modal.why_not,
                                 .n = 3,
                                 .modes = s->modal.modes,
                                 .omega = s->modal.omega,
                                 .shape = s->modal.shape,
                                 .turn = s->modal.turn,
                                 .modal = &s->modal,
                                 .margin = 1,
                                 .floor = s->floor};
    const char *why;
    double value;
    assert_true(fw_effect_inertia.called_for(&c));
    assert_int_equal(fw_effect_inertia.bound(&c, &value, reason ? reason : &why), FW_OK);
    return value;
}

static double torque_at(const lever *s, double t, double piece) {
    double sum = 0, f[3] = {1};
    for (int i = 0; i < s->scene.ntorque; i++) {
        f[0] = 1;
        if (s->torque[i].law) fw_quantity_law_value(s->torque[i].law, t, piece, f);
        sum += s->torque[i].value_Nm * f[0];
    }
    return sum;
}

/* largest |theta - T/k| over the scene: classical Runge-Kutta, breaks of the laws met by steps that
   are short beside the period and by the pieces' midpoints */
static double largest_difference(const lever *s, double steps_per_radian) {
    double j = own + mass * arm * arm, c = s->pin[0].damping_Nms_per_rad, T = s->scene.duration_s;
    long n = (long)ceil(T * s->omega * steps_per_radian);
    double h = T / (double)n, x = 0, v = 0, worst = 0;
    if (s->scene.ninitial) v = s->initial[0].omega_rad_per_s;
    for (long i = 0; i < n; i++) {
        double t = (double)i * h, k[4][2], p = t + h / 2, y[2] = {x, v};
        worst = fmax(worst, fabs(x - torque_at(s, t, p) / stiffness));
        for (int a = 0; a < 4; a++) {
            double w = a == 0 ? 0 : a == 3 ? h : h / 2;
            double xs = y[0] + (a ? w * k[a - 1][0] : 0), vs = y[1] + (a ? w * k[a - 1][1] : 0);
            k[a][0] = vs;
            k[a][1] = (torque_at(s, t + w, p) - stiffness * xs - c * vs) / j;
        }
        x += h / 6 * (k[0][0] + 2 * k[1][0] + 2 * k[2][0] + k[3][0]);
        v += h / 6 * (k[0][1] + 2 * k[1][1] + 2 * k[2][1] + k[3][1]);
        worst = fmax(worst, fabs(x - torque_at(s, t + h, p) / stiffness));
    }
    return worst;
}

static void set_torque(lever *s, const fw_quantity_law *law, double value) {
    s->torque[s->scene.ntorque++] = (fw_device_torque){.body = 0, .value_Nm = value, .law = law};
}

/* step: T/k; ramp: 2 T/(k rise omega), which is met by ramps of half periods; sine: from the closed
   form */
static void closed_forms(void **state) {
    (void)state;
    lever s;
    lever_new(&s, 0);
    double w = s.omega;
    set_torque(&s, NULL, load);
    assert_near(bound_of(&s, NULL), load / stiffness, 1e-9 * load / stiffness);
    s.scene.duration_s = 40 / w;
    assert_near(largest_difference(&s, 200), load / stiffness, 1e-6 * load / stiffness);
    for (int k = 1; k < 8;
         k++) { /* odd half periods: the second bend adds to what the first left */
        const fw_quantity_law ramp = {
            .kind = &fw_quantity_law_ramp, .start_s = 0, .rise_s = (2 * k + 1) * pi / w};
        s.scene.ntorque = 0;
        set_torque(&s, &ramp, load);
        s.scene.duration_s = 2 * ramp.rise_s;
        double exact = 2 * load / (stiffness * ramp.rise_s * w), found = bound_of(&s, NULL);
        assert_near(found, exact, 1e-9 * exact);
        assert_near(largest_difference(&s, 200), exact, 1e-3 * exact);
    }
    /* a sine: what it settles to and what rings, however many waves there are */
    for (int n = 1; n < 60; n += 7) {
        const fw_quantity_law sine = {
            .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 100};
        s.scene.ntorque = 0;
        set_torque(&s, &sine, load);
        s.scene.duration_s = n / 200.0;
        double r = 2 * pi * 100 / w, a = r * r / (1 - r * r), b = r / (1 - r * r);
        double exact = load / stiffness * (a + hypot(a, b)), found = bound_of(&s, NULL);
        assert_near(found, exact, 1e-9 * exact);
        double is = largest_difference(&s, 60);
        assert_true(is <= found && is > 0.85 * found);
    }
    fw_arena_free(s.arena);
}

static uint64_t seed = 11;
static double any(void) {
    uint64_t z = (seed += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static fw_quantity_law any_law(double period, double *t, double *value) {
    fw_quantity_law law = {.end_s = (double)INFINITY};
    switch ((int)(4 * any())) {
    case 0:
        law.kind = &fw_quantity_law_step, law.start_s = period * 8 * (any() - 0.3);
        law.end_s = law.start_s + (any() < 0.5 ? (double)INFINITY : 6 * period * any());
        return law;
    case 1:
        law.kind = &fw_quantity_law_ramp, law.start_s = period * 5 * (any() - 0.3);
        law.rise_s = period * (0.1 + 10 * any());
        return law;
    case 2:
        law.kind = &fw_quantity_law_sine, law.start_s = period * 4 * (any() - 0.5);
        law.phase_rad = 7 * any() - 3, law.frequency_Hz = (0.02 + 0.5 * any()) / period;
        if (any() < 0.3) law.end_s = law.start_s + 9 * period * any();
        return law;
    default:
        law.kind = &fw_quantity_law_table, law.table_t_s = t, law.table_value = value;
        law.ntable = 2 + (int)(4 * any());
        for (int i = 0; i < law.ntable; i++) {
            t[i] = (i ? t[i - 1] : -period) + period * (0.1 + 4 * any());
            value[i] = 2 * any() - 1;
        }
        return law;
    }
}

/* never below the true difference: three loads, starting velocity, damping from none to twice the
   critical one */
static void honest(void **state) {
    (void)state;
    double slack = 0;
    for (int n = 0; n < 400; n++) {
        lever s;
        fw_quantity_law law[3];
        double t[3][8], value[3][8], j = own + mass * arm * arm;
        double ratio = n % 4 ? 2 * any() * any() * any() : 0;
        lever_new(&s, 2 * ratio * sqrt(stiffness * j));
        double period = 2 * pi / s.omega;
        s.scene.duration_s = period * (3 + 10 * any());
        for (int i = 0; i < 1 + n % 3; i++) {
            law[i] = any_law(period, t[i], value[i]);
            set_torque(&s, any() < 0.1 ? NULL : &law[i], load * (2 * any() - 1));
        }
        if (n % 5 == 0) {
            s.initial[0] = (fw_device_initial){.body = 0, .omega_rad_per_s = 0.1 * s.omega * any()};
            s.initial[0].vy_m_per_s = arm * s.initial[0].omega_rad_per_s;
            s.scene.ninitial = 1;
        }
        double found = bound_of(&s, NULL), is = largest_difference(&s, 120);
        if (!(found >= is * (1 - 2e-2))) /* breaks fall inside of the test's own steps */
            fail_msg("case %d: bound %g, motion %g, damping %g", n, found, is, ratio);
        slack = fmax(slack, is > 0 ? is / found : 0);
        fw_arena_free(s.arena);
    }
    assert_true(slack > 0.8); /* and reached: the worst case is not far away */
}

static void slow_loads_leave_it_out(void **state) {
    (void)state;
    lever s;
    const char *reason;
    lever_new(&s, 0);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 1};
    set_torque(&s, &ramp, load);
    s.floor = load / stiffness;
    s.scene.duration_s = 2;
    double found = bound_of(&s, &reason);
    assert_near(found, 2 / s.omega, 1e-9 / s.omega);
    assert_non_null(strstr(reason, "sequence of equilibria"));
    s.pin[0].stop_min_rad = -1, s.pin[0].stop_max_rad = 1, s.pin[0].stop_stiffness_Nm_per_rad = 1;
    assert_true(isinf(bound_of(&s, &reason)));
    assert_non_null(strstr(reason, "stops"));
    s.pin[0].stop_stiffness_Nm_per_rad = 0;
    s.pin[0].stiffness_Nm_per_rad = 0; /* a free motion */
    assert_true(isinf(bound_of(&s, &reason)));
    fw_arena_free(s.arena);
}

/* an expression that is a sine: the sum by samples against the closed form */
static void expressions(void **state) {
    (void)state;
    lever s;
    lever_new(&s, 0);
    const char *text = "sin(500 * t/1 s)^2";
    fw_quantity_program *program;
    fw_quantity_expression_error error;
    const fw_quantity_names names = {0};
    assert_int_equal(fw_quantity_program_compile(s.arena, text, strlen(text), &names,
                                                 (fw_quantity_dimension){0}, &program, &error),
                     FW_OK);
    const fw_quantity_law law = {.kind = &fw_quantity_law_expression, .program = program};
    set_torque(&s, &law, load);
    s.scene.duration_s = 0.1; /* f' = 500 sin(1000 t): 100/pi half waves of 2 * 500 */
    double waves = 100 / pi, whole = floor(waves);
    double most = 500 * (2 * ceil(waves) + 0.5), least = 500 * (2 * whole);
    double found = bound_of(&s, NULL) / (load / stiffness / s.omega);
    assert_true(found >= least && found <= 1.011 * most);
    fw_arena_free(s.arena);
}

static const char *kept_for(lever *s) {
    const fw_effect_case c = {s->arena, &s->m, &s->scene, &s->e, NULL, NULL};
    const char *why = NULL;
    assert_int_equal(fw_effect_inertia.looked_at(&c, &why), FW_OK);
    return why;
}

/* with one probe of the device: kept for a velocity, or for a tendon's power where the scene has it, and the bound on
   deflections stays; a damper beside a spring counts by its share in the lowest mode */
static void what_goes_by_velocities(void **state) {
    (void)state;
    lever s;
    const char *reason;
    const double c = 3e-9;
    lever_new(&s, c);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 1};
    set_torque(&s, &ramp, load);
    s.floor = load / stiffness;
    s.scene.duration_s = 2;
    const double share = c * s.omega / stiffness, alone = bound_of(&s, &reason);
    assert_true(isfinite(alone) && share > 0.01);
    fw_device_spring spring = {.id = "s", .stiffness_N_per_m = 2, .damping_Ns_per_m = 0.01};
    fw_device_probe probe = {.id = "v", .row = FW_PROBE_IS_displacement};
    fw_device device = {.probe = &probe, .nprobe = 1, .spring = &spring, .nspring = 1};
    s.m.device = &device;
    assert_near(bound_of(&s, &reason), alone, 1e-12 * alone);
    assert_null(kept_for(&s));
    probe.row = FW_PROBE_IS_velocity;
    assert_near(bound_of(&s, &reason), alone, 1e-12 * alone);
    assert_non_null(strstr(kept_for(&s), "probe v goes by velocities"));
    probe.row = FW_PROBE_IS_torque, probe.of = "O", probe.carrier = FW_CARRIER_REVOLUTE;
    assert_near(bound_of(&s, &reason), alone * (1 + share), 1e-9 * alone);
    probe.row = FW_PROBE_IS_force; /* of the joint itself */
    assert_near(bound_of(&s, &reason), alone, 1e-12 * alone);
    probe.of = "s", probe.carrier = FW_CARRIER_SPRING;
    assert_near(bound_of(&s, &reason), alone * (1 + 0.005 * s.omega), 1e-9 * alone);
    assert_null(kept_for(&s));
    spring.stiffness_N_per_m = 0;
    assert_non_null(kept_for(&s));
    probe.row = FW_PROBE_IS_power, probe.of = "T", probe.carrier = FW_CARRIER_TENDON;
    assert_null(kept_for(&s)); /* in another scene */
    fw_device_tendon tendon = {.id = "T", .pull_N = 1, .draw_m = (double)NAN};
    s.scene.tendon = &tendon, s.scene.ntendon = 1;
    assert_non_null(kept_for(&s));
    fw_arena_free(s.arena);
}

static void choices(void **state) {
    (void)state;
    lever s;
    lever_new(&s, 0);
    fw_diags diags = fw_diags_new(s.arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    set_torque(&s, NULL, load);
    assert_int_equal(
        fw_effects_compile(s.arena, &s.m, &s.scene, &all, 1e-3, &diags, &ledger, &loads), FW_OK);
    assert_false(loads.quasi_static);
    assert_int_equal(fw_effect_inertia.leave_out(NULL, &loads), FW_OK);
    assert_true(loads.quasi_static);
    fw_arena_free(s.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(honest),
        cmocka_unit_test(slow_loads_leave_it_out),
        cmocka_unit_test(expressions),
        cmocka_unit_test(what_goes_by_velocities),
        cmocka_unit_test(choices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
