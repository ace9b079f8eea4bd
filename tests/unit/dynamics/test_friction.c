/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coulomb friction along whole motions: closed forms of sliding, stopping, sticking and stick-slip;
   a pendulum with pin friction against an integration of its own; all methods; energy. */
#include "quantity/law_kind.h"
#include "models.h"
#include <stdlib.h>

static const double PI = 3.14159265358979323846, NOT = (double)NAN;

static const fw_dynamics_motion *run_by(fw_arena *arena, const rig *r, const char *method,
                                        const char *integrator, double rtol, int samples) {
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {.method = method,
                                    .integrator = integrator,
                                    .rtol = rtol,
                                    .samples = samples,
                                    .effects = {.mode = FW_EFFECTS_ALL}};
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &motion);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    return motion;
}

static const fw_dynamics_motion *run(fw_arena *arena, const rig *r, double rtol, int samples) {
    return run_by(arena, r, NULL, "dop853", rtol, samples);
}

static fw_device_friction_use *rub(fw_arena *arena, rig *r, int revolute, int joint, double mu_s,
                                   double mu_k) {
    if (!r->scene.friction) r->scene.friction = fw_arena_array(arena, fw_device_friction_use, 16);
    fw_device_friction_use *u = &r->scene.friction[r->scene.nfriction++];
    *u = (fw_device_friction_use){
        .revolute = revolute, .joint = joint, .coefficient = mu_k, .static_coefficient = mu_s};
    return u;
}

static fw_device_joint *slide(fw_arena *arena, rig *r, int a, int b, double axis) {
    if (!r->m.joint) r->m.joint = fw_arena_array(arena, fw_device_joint, 8);
    fw_device_joint *t = &r->m.joint[r->m.njoint++];
    *t = (fw_device_joint){
        .id = "slide", .kind = FW_JOINT_PRISMATIC, .body_a = a, .body_b = b, .axis_rad = axis};
    return t;
}

/* ---- a block on an incline ---- */

enum { MASS = 2 };
static const double G = 9.81, TILT = 0.35;

static rig incline(fw_arena *arena, double mu_s, double mu_k, double preload, double v) {
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "block", MASS, 0.1, 0, 0, TILT);
    slide(arena, &r, FW_GROUND, 0, TILT)->angle_rad = TILT;
    rub(arena, &r, FW_NONE, 0, mu_s, mu_k)->preload_N = preload;
    rig_velocity(&r, 0, v * cos(TILT), v * sin(TILT), 0);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -G;
    r.scene.duration_s = 2;
    return r;
}

/* up the incline with v: stops after v/a at v^2/(2a), a = g sin + mu_k N/m, and stays there when
   mu_s N holds the weight; else it comes down with g sin - mu_k N/m */
static void test_incline(void **state) {
    (void)state;
    for (int holds = 0; holds < 2; holds++) {
        fw_arena *arena = fw_arena_new(0);
        const double v = 3, preload = 4, mu_k = 0.2, mu_s = holds ? 0.4 : 0.22;
        rig r = incline(arena, mu_s, mu_k, preload, v);
        double n = MASS * G * cos(TILT) + preload, up = G * sin(TILT) + mu_k * n / MASS;
        double down = G * sin(TILT) - mu_k * n / MASS, stop = v / up, top = v * v / (2 * up);
        assert_true((mu_s * n > MASS * G * sin(TILT)) == holds);
        const fw_dynamics_motion *m = run(arena, &r, 1e-12, 101);
        for (int k = 0; k < 101; k++) {
            double t = m->t_s[k], after = t - stop, s = v * t - up * t * t / 2, rate = v - up * t;
            if (after > 0) {
                s = holds ? top : top - down * after * after / 2;
                rate = holds ? 0 : -down * after;
            }
            assert_near(m->q[3 * k], s * cos(TILT), 1e-12);
            assert_near(m->q[3 * k + 1], s * sin(TILT), 1e-12);
            assert_near(m->v[3 * k], rate * cos(TILT), 3e-11); /* 10 rtol of 3 m/s */
        }
        assert_int_equal(m->stats.events, 1);
        assert_true(m->stats.energy_error < 1e-12);
        fw_arena_free(arena);
    }
}

/* at rest from the start; the limit itself still holds, also with static = kinetic */
static void test_at_the_limit(void **state) {
    (void)state;
    const double share[3] = {0.99, 1, 1.01};
    for (int k = 0; k < 3; k++) {
        fw_arena *arena = fw_arena_new(0);
        double mu = tan(TILT) / share[k];
        rig r = incline(arena, NOT, mu, 0, 0);
        double down = fmax(0, G * sin(TILT) - mu * G * cos(TILT));
        const fw_dynamics_motion *m = run(arena, &r, 1e-12, 2);
        assert_near(m->q[3], -down * 2 * cos(TILT), 1e-11);
        assert_int_equal(m->stats.events, 0);
        assert_true(m->stats.steps < 30);
        fw_arena_free(arena);
    }
}

/* ---- spring and mass ---- */

/* half swings of pi/w about +-mu_k N/k, each 2 mu_k N/k shorter, until the spring holds no longer
   against mu_s N */
static void test_dying_swings(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double k = 50, m0 = 0.5, w = 10, n = 3, mu_s = 0.5, mu_k = 0.4, x0 = 0.37;
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "mass", m0, 1, x0, 0, 0);
    slide(arena, &r, FW_GROUND, 0, 0)->stiffness_N_per_m = k;
    rub(arena, &r, FW_NONE, 0, mu_s, mu_k)->preload_N = n;
    r.scene.duration_s = 4;
    double shift = mu_k * n / k, x = x0;
    int half = 0;
    while (fabs(x) * k > mu_s * n) {
        x = -(fabs(x) - 2 * shift) * (x > 0 ? 1 : -1);
        half++;
    }
    assert_true(half > 4);
    const fw_dynamics_motion *m = run(arena, &r, 1e-12, 401);
    for (int i = 0; i < 401; i++) {
        double t = m->t_s[i], now = x0, want;
        int swing = (int)(t / (PI / w));
        for (int s = 0; s < swing && s < half; s++)
            now = -(fabs(now) - 2 * shift) * (now > 0 ? 1 : -1);
        double middle = now > 0 ? shift : -shift;
        want = swing < half ? middle + (now - middle) * cos(w * t - swing * PI) : now;
        assert_near(m->q[3 * i], want, 2e-11);
    }
    assert_near(m->q[3 * 400], x, 1e-11);
    assert_int_equal(m->stats.events, half);
    assert_true(m->stats.energy_error < 1e-11);
    fw_arena_free(arena);
}

/* ---- a mass on a belt ---- */

typedef struct belt {
    rig r;
    double t[2], x[2], period, first, amplitude, highest;
} belt;

/* belt at speed v, mass tied to the ground by a spring, weight m g presses. With x_s = mu_s N/k,
   x_k = mu_k N/k, D = x_s - x_k: sticks for 2 D/v, slips for 2 (pi - atan(D w/v))/w, between x_k -
   D and x_k + (D^2 + v^2/w^2)^(1/2) */
static void belt_new(fw_arena *arena, belt *b, double mu_s, double mu_k, double v, double cycles) {
    const double k = 40, m = 0.4, w = 10, reach = 5;
    rig *r = &b->r;
    *r = rig_new(arena, 2, 0, 1);
    rig_body(r, "belt", 3, 1, 0, 0, 0);
    rig_body(r, "mass", m, 1, 0, 0, 0);
    slide(arena, r, FW_GROUND, 0, 0);
    slide(arena, r, 0, 1, 0);
    rig_velocity(r, 0, v, 0, 0);
    rig_velocity(r, 1, v, 0, 0);
    r->m.spring[r->m.nspring++] = (fw_device_spring){.id = "tie",
                                                     .body_a = FW_GROUND,
                                                     .body_b = 1,
                                                     .ax_m = -reach,
                                                     .stiffness_N_per_m = k,
                                                     .length_m = reach};
    r->scene.gravity = true;
    r->scene.gy_m_per_s2 = -10;
    rub(arena, r, FW_NONE, 1, mu_s, mu_k);
    double n = m * 10, xs = mu_s * n / k, xk = mu_k * n / k, d = xs - xk;
    b->first = xs / v;
    b->period = 2 * d / v + 2 * (PI - atan(d * w / v)) / w;
    b->amplitude = sqrt(d * d + v * v / (w * w));
    b->highest = xk + b->amplitude;
    r->scene.duration_s = b->first + cycles * b->period;
    b->t[0] = 0, b->t[1] = 2 * r->scene.duration_s;
    b->x[0] = 0, b->x[1] = v * b->t[1];
    r->m.driver = fw_arena_array(arena, fw_device_driver, 1);
    r->m.driver[r->m.ndriver++] = (fw_device_driver){
        .id = "motor",
        .revolute = FW_NONE,
        .joint = 0,
        .law = {
            .kind = &fw_quantity_law_table, .table_t_s = b->t, .table_value = b->x, .ntable = 2}};
}

/* 20 cycles: after each the mass lets go at x_s with the belt's speed */
static void test_stick_slip(void **state) {
    (void)state;
    const double v = 0.15, mu_s = 0.6, mu_k = 0.35;
    for (int c = 0; c < 2; c++) { /* in the middle of a stick, and of a slip */
        fw_arena *arena = fw_arena_new(0);
        belt b;
        belt_new(arena, &b, mu_s, mu_k, v, 20.5);
        double n = 4, xs = mu_s * n / 40, xk = mu_k * n / 40, d = xs - xk, w = 10;
        double slips = 2 * (PI - atan(d * w / v)) / w;
        if (c) b.r.scene.duration_s += 0.25 * b.period;
        const fw_dynamics_motion *m = run(arena, &b.r, 1e-12, 501);
        for (int i = 0; i < 501; i++) {
            double t = m->t_s[i] - b.first, want = xs + v * t, rate = v;
            if (t > 0) t -= b.period * floor(t / b.period), want = xk - d + v * (t - slips);
            if (t > 0 && t < slips) {
                want = xk + d * cos(w * t) + v / w * sin(w * t);
                rate = v * cos(w * t) - d * w * sin(w * t);
            }
            assert_near(m->q[6 * i + 3], want, 3e-11);
            assert_near(m->v[6 * i + 3], rate, 3e-10);
        }
        print_message("belt: %ld events, %ld steps, energy %.1e\n", m->stats.events, m->stats.steps,
                      m->stats.energy_error);
        double phase = fmod((b.r.scene.duration_s - b.first) / b.period, 1) * b.period;
        assert_int_equal(m->stats.events, 1 + 2 * 20 + (phase > slips));
        assert_true(m->stats.energy_error < 1e-11);
        fw_arena_free(arena);
    }
}

/* ---- a pendulum whose pin rubs ---- */

/* J a = -m g l sin phi + T,  T = -s mu r |R|,  R = m (g + acceleration of the centre): the only
   solution for J > mu r m l, by iteration */
typedef struct swing {
    double m, j, l, mu_s, mu_k, r; /* j about the pin */
    double phi, omega;
    int slip, stops;
    double last; /* when it came to rest for good; NaN */
} swing;

static double swing_accel(const swing *s, double phi, double omega) {
    double weight = -s->m * G * s->l * sin(phi), a = weight / s->j, before = (double)INFINITY;
    for (int k = 0; k < 200 && a != before; k++) {
        double x = s->l * (a * cos(phi) - omega * omega * sin(phi));
        double y = s->l * (a * sin(phi) + omega * omega * cos(phi)) + G;
        before = a;
        a = (weight - s->slip * s->mu_k * s->r * s->m * hypot(x, y)) / s->j;
    }
    return a;
}

static void swing_step(swing *s, double h) {
    double p[4], w[4];
    static const double c[4] = {0, 0.5, 0.5, 1};
    for (int k = 0; k < 4; k++) {
        w[k] = s->omega + (k ? c[k] * h * p[k - 1] : 0);
        double phi = s->phi + (k ? c[k] * h * w[k - 1] : 0);
        p[k] = swing_accel(s, phi, w[k]);
    }
    s->phi += h / 6 * (w[0] + 2 * w[1] + 2 * w[2] + w[3]);
    s->omega += h / 6 * (p[0] + 2 * p[1] + 2 * p[2] + p[3]);
}

static void swing_rest(swing *s, double t) {
    double asks = s->l * sin(s->phi);
    s->omega = 0;
    s->slip = fabs(asks) <= s->mu_s * s->r ? 0 : asks > 0 ? -1 : 1;
    if (!s->slip) s->last = t;
}

static void swing_to(swing *s, double from, double to) {
    int n = (int)ceil((to - from) / 1e-4);
    double h = (to - from) / n;
    for (int i = 0; i < n && s->slip; i++) {
        double done = 0;
        while (done < h && s->slip) { /* a stop inside the step: its length by bisection */
            swing end = *s;
            swing_step(&end, h - done);
            if (end.slip * end.omega >= 0) {
                *s = end;
                break;
            }
            double low = 0, high = h - done;
            for (int k = 0; k < 60; k++) {
                end = *s;
                swing_step(&end, (low + high) / 2);
                *(end.slip * end.omega >= 0 ? &low : &high) = (low + high) / 2;
            }
            done += low;
            swing_step(s, low);
            swing_rest(s, from + i * h + done);
            s->stops++;
        }
    }
}

static rig pendulum(fw_arena *arena, swing *s) {
    const double j = 0.25, l = 0.5, m = 1.5, phi = 1.9;
    *s = (swing){.m = m, .j = j + m * l * l, .l = l, .mu_s = 0.5, .mu_k = 0.3, .r = 0.11};
    s->phi = phi;
    s->last = NOT;
    swing_rest(s, 0);
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "bob", m, j, l * sin(phi), -l * cos(phi), phi);
    rig_pin_local(&r, "O", FW_GROUND, 0, 0, 0, 0, l);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -G;
    r.scene.duration_s = 12;
    rub(arena, &r, 0, FW_NONE, s->mu_s, s->mu_k)->radius_m = s->r;
    return r;
}

static void test_pendulum(void **state) {
    (void)state;
    double off[4];
    const double rtol[4] = {1e-6, 1e-8, 1e-10, 1e-12};
    for (int c = 0; c < 4; c++) {
        fw_arena *arena = fw_arena_new(0);
        swing s;
        rig r = pendulum(arena, &s);
        const fw_dynamics_motion *m = run(arena, &r, rtol[c], 121);
        off[c] = 0;
        for (int k = 0; k < 121; k++) {
            if (k) swing_to(&s, m->t_s[k - 1], m->t_s[k]);
            off[c] = fmax(off[c], fabs(m->q[3 * k + 2] - s.phi));
            off[c] = fmax(off[c], 0.1 * fabs(m->v[3 * k + 2] - s.omega));
        }
        assert_true(s.slip == 0 && s.stops > 3);
        assert_int_equal(m->stats.events, s.stops);
        assert_true(m->v[3 * 120 + 2] == 0 || fabs(m->v[3 * 120 + 2]) < 1e-14);
        assert_true(m->stats.energy_error < fmax(10 * rtol[c], 1e-12));
        print_message("pendulum: rtol %.0e off %.1e, %ld events, energy %.1e\n", rtol[c], off[c],
                      m->stats.events, m->stats.energy_error);
        fw_arena_free(arena);
    }
    assert_true(off[0] < 1e-4 && off[1] < off[0] / 10 && off[2] < off[1] / 10);
    assert_true(off[3] < 1e-11);
}

/* ---- several at once ---- */

/* a four-bar of two equal cranks that hangs (from above) and swings, friction in all four pins: one
   freedom, so that all of them stop and stick together, each holding what it likes */
static rig four_bar(fw_arena *arena) {
    rig r = rig_windows(arena, 1);
    r.scene.gy_m_per_s2 = 9.81;
    r.scene.duration_s = 10;
    for (int i = 0; i < 4; i++)
        rub(arena, &r, i, FW_NONE, 0.3, 0.2)->radius_m = 0.05;
    return r;
}

static void test_all_methods(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = four_bar(arena);
    const fw_dynamics_motion *first = NULL;
    for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
        const fw_dynamics_motion *m =
            run_by(arena, &r, fw_multibody_method_at(k).name, "dop853", 1e-12, 41);
        print_message("%s: %ld events, %ld steps, energy %.1e\n", fw_multibody_method_at(k).name,
                      m->stats.events, m->stats.steps, m->stats.energy_error);
        assert_true(m->stats.energy_error < 1e-11);
        for (int i = 0; i < 9; i++)
            assert_near(m->v[40 * 9 + i], 0, 1e-14);
        if (!first) first = m;
        assert_int_equal(m->stats.events, first->stats.events);
        for (int i = 0; i < 41 * 9; i++) {
            assert_near(m->q[i], first->q[i], 1e-10);
            assert_near(m->v[i], first->v[i], 1e-9);
        }
        for (int i = 0; i < 41 * 8; i++)
            assert_near(m->reaction_N[i], first->reaction_N[i], 1e-7);
    }
    assert_true(fabs(first->q[40 * 9 + 2]) > 1e-3); /* not where it would hang */
    fw_arena_free(arena);
}

static void test_all_integrators(void **state) {
    (void)state;
    for (size_t k = 1; fw_dynamics_integrator_at(k).name; k++) {
        fw_arena *arena = fw_arena_new(0);
        swing s;
        rig r = pendulum(arena, &s);
        r.scene.duration_s = test_cases(8, 2);
        swing_to(&s, 0, r.scene.duration_s);
        const char *name = fw_dynamics_integrator_at(k).name;
        const fw_dynamics_motion *m = run_by(arena, &r, NULL, name, 1e-9, 2);
        print_message("%s: off %.1e, %ld events, %ld steps\n", name, m->q[5] - s.phi,
                      m->stats.events, m->stats.steps);
        assert_int_equal(m->stats.events, s.stops);
        assert_near(m->q[5], s.phi,
                    strcmp(name, "rk4") == 0 || strcmp(name, "generalised-alpha") == 0 ? 1e-4
                                                                                       : 1e-6);
        fw_arena_free(arena);
    }
}

/* two equal masses on equal springs, mirrored: they stop at the same instants */
static void test_two_at_once(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 2, 0, 0);
    for (int i = 0; i < 2; i++) {
        rig_body(&r, "mass", 0.5, 1, i ? -0.37 : 0.37, i, 0);
        fw_device_joint *t = slide(arena, &r, FW_GROUND, i, 0);
        t->stiffness_N_per_m = 50, t->ay_m = i;
        rub(arena, &r, FW_NONE, i, 0.5, 0.4)->preload_N = 3;
    }
    r.scene.duration_s = 4;
    const fw_dynamics_motion *m = run(arena, &r, 1e-12, 41);
    for (int k = 0; k < 41; k++)
        assert_near(m->q[6 * k], -m->q[6 * k + 3], 1e-11);
    assert_true(m->stats.events >= 7 && m->stats.events <= 14);
    assert_true(fabs(m->v[6 * 40]) < 1e-14 && fabs(m->v[6 * 40 + 3]) < 1e-14);
    fw_arena_free(arena);
}

/* ---- what has no answer ---- */

/* a bar about its end: unit torque takes m l/(J + m l^2) = 1.5 from the pin's force, so that mu r
   above 2/3 m has no single motion */
static void test_jam(void **state) {
    (void)state;
    for (int jams = 0; jams < 2; jams++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 1, 1, 0);
        rig_body(&r, "bar", 1, 1.0 / 12, 0.5, 0, 0);
        rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
        rig_velocity(&r, 0, 0, 0.5, 1);
        r.scene.duration_s = 1;
        rub(arena, &r, 0, FW_NONE, NOT, 0.7)->radius_m = jams ? 0.96 : 0.95;
        fw_diags diags = fw_diags_new(arena);
        fw_dynamics_motion_options o = {.effects = {.mode = FW_EFFECTS_ALL}};
        const fw_dynamics_motion *m = NULL;
        fw_status status = fw_dynamics_simulate(arena, &r.m, &r.scene, &o, &diags, &m);
        assert_int_equal(status, jams ? FW_SOLVER : FW_OK);
        assert_true((diags.count > 0 && diags.item[0].number == 244) == jams);
        fw_arena_free(arena);
    }
}

/* A slides along x with friction, B (25 times its mass) along y, a rod of length 1 between them.
   Unit force along the guide of A changes what presses by m_B c/(m_A + m_B c^2), c = x/y: with mu =
   0.8 its product reaches 1 at c = (20 + 300^(1/2))/50, on the way in. The run ends there. */
static void test_jams_on_the_way(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double c = (20 + sqrt(300)) / 50, x0 = cos(PI / 6), y0 = sin(PI / 6);
    rig r = rig_new(arena, 2, 0, 0);
    rig_body(&r, "A", 1, 1, x0, 0, 0);
    rig_body(&r, "B", 25, 1, 0, y0, 0);
    slide(arena, &r, FW_GROUND, 0, 0);
    slide(arena, &r, FW_GROUND, 1, PI / 2);
    fw_device_joint *rod = slide(arena, &r, 0, 1, 0);
    *rod = (fw_device_joint){
        .id = "rod", .kind = FW_JOINT_DISTANCE, .body_a = 0, .body_b = 1, .length_m = 1};
    rig_velocity(&r, 0, -1, 0, 0);
    rig_velocity(&r, 1, 0, x0 / y0, 0);
    rig_force(&r, 0, -3, 0);
    rub(arena, &r, FW_NONE, 0, NOT, 0.8)->preload_N = 0.1;
    r.scene.duration_s = 2;
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {.rtol = 1e-10, .effects = {.mode = FW_EFFECTS_ALL}};
    const fw_dynamics_motion *m = NULL;
    assert_int_equal(fw_dynamics_simulate(arena, &r.m, &r.scene, &o, &diags, &m), FW_SOLVER);
    assert_int_equal(diags.item[0].number, 244);
    const char *at = strstr(diags.item[0].message, "unique value at ");
    assert_non_null(at);
    double when = atof(at + 16);
    r.scene.duration_s = when * (1 - 1e-5);
    m = run(arena, &r, 1e-10, 2);
    assert_near(m->q[6] / m->q[6 + 4], c, 1e-3);
    assert_true(m->q[6] / m->q[6 + 4] > c);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_incline),
        cmocka_unit_test(test_at_the_limit),
        cmocka_unit_test(test_dying_swings),
        cmocka_unit_test(test_stick_slip),
        cmocka_unit_test(test_pendulum),
        cmocka_unit_test(test_all_methods),
        cmocka_unit_test(test_all_integrators),
        cmocka_unit_test(test_two_at_once),
        cmocka_unit_test(test_jam),
        cmocka_unit_test(test_jams_on_the_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
