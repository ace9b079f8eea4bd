/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law_kind.h"
#include "drive_rig.h"

/* from the ground over both bodies, back to the ground and to the first body again */
static const fw_device_eyelet eyelets[] = {
    {.body = FW_GROUND, .x_m = -2e-3, .y_m = 0.1e-3}, {.body = 0, .x_m = 0.2e-3, .y_m = 0.1e-3},
    {.body = 1, .x_m = -0.1e-3, .y_m = 0.3e-3},       {.body = 1, .x_m = 0.4e-3, .y_m = -0.2e-3},
    {.body = FW_GROUND, .x_m = 1e-3, .y_m = -1e-3},   {.body = 0, .x_m = -0.3e-3, .y_m = 0.2e-3}};
enum { EYELETS = sizeof eyelets / sizeof eyelets[0] };

static const fw_quantity_law sine = {.kind = &fw_quantity_law_sine,
                                     .end_s = (double)INFINITY,
                                     .frequency_Hz = 900,
                                     .phase_rad = 0.4};

static fw_device_tendon drawn_of(int n, double slack) {
    return (fw_device_tendon){.id = "cable",
                              .eyelet = (fw_device_eyelet *)eyelets,
                              .neyelet = n,
                              .pull_N = (double)NAN,
                              .draw_m = 0.2e-3,
                              .stiffness_N_per_m = 3,
                              .damping_Ns_per_m = 2e-5,
                              .slack_m = slack};
}

static fw_device_tendon pulled_of(int n) {
    return (fw_device_tendon){.id = "cable",
                              .eyelet = (fw_device_eyelet *)eyelets,
                              .neyelet = n,
                              .pull_N = 4e-3,
                              .draw_m = (double)NAN,
                              .stiffness_N_per_m = (double)NAN,
                              .damping_Ns_per_m = (double)NAN};
}

static void with_tendon(rig *r, const fw_device_tendon *t) {
    rig_new(r, 11);
    r->scene.tendon = fw_arena_one(r->arena, fw_device_tendon);
    r->scene.tendon[0] = *t;
    r->scene.ntendon = 1;
    rig_compile(r);
}

/* power, tangent and balance for 2 to 6 ports, pulled and drawn, with a constant actuation and a
   law in time, held taut and held slack whatever the state says */
static void test_laws(void **state) {
    (void)state;
    for (int n = 2; n <= EYELETS; n++)
        for (int kind = 0; kind < 4; kind++) {
            fw_device_tendon t = kind & 1 ? pulled_of(n) : drawn_of(n, 0.1e-3);
            if (kind & 2) t.law = &sine;
            rig r;
            with_tendon(&r, &t);
            assert_int_equal(r.e->ports, n);
            assert_int_equal(r.e->switches, kind == 1 ? 0 : 1);
            int over[2] = {0};
            for (int i = 0; i < 40; i++) {
                double p[3 * EYELETS], w[3 * EYELETS];
                bool on = i & 1;
                rig_state(&r, 0.1e-3, 0.2, p, w);
                fw_effects_port_state s = {.t_s = 3e-5 * i,
                                           .piece_s = 3e-5 * i,
                                           .load = 1 + 0.5 * rig_random(&r),
                                           .p = p,
                                           .w = w,
                                           .on = &on};
                over[r.e->class_->switch_value(r.e, &s, 0) > 0]++;
                fw_check_tangent(r.e, &s, 1e-6, 1e-4, 1e-7);
                fw_check_power(r.e, &s, 1e-7, 1e-7);
                fw_check_balance(r.e, &s, 1e-12);
                double f[3 * EYELETS];
                r.e->class_->force(r.e, &s, f);
                for (int k = 0; k < 3 * n && !on && r.e->switches; k++)
                    assert_true(f[k] == 0);
            }
            if (kind != 1) assert_true(over[0] > 3 && over[1] > 3); /* both sides were seen */
            fw_arena_free(r.arena);
        }
}

/* df/d load by differences, which is exact for what is linear in it */
static void test_slope(void **state) {
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        fw_device_tendon t = kind ? pulled_of(EYELETS) : drawn_of(EYELETS, 0);
        t.law = &sine;
        rig r;
        with_tendon(&r, &t);
        double p[3 * EYELETS], w[3 * EYELETS], f[3][3 * EYELETS];
        bool on = true;
        rig_state(&r, 0.1e-3, 0.2, p, w);
        fw_effects_port_state s = {.t_s = 1e-4, .piece_s = 1e-4, .p = p, .w = w, .on = &on};
        r.e->class_->force(r.e, &s, f[0]);
        s.load = 1;
        r.e->class_->force(r.e, &s, f[1]);
        r.e->class_->slope(r.e, &s, f[2]);
        for (int i = 0; i < 3 * EYELETS; i++)
            assert_near(f[2][i], f[1][i] - f[0][i], 1e-12 * 4e-3);
        /* nothing decides by the load factor whether a pulled cable is taut */
        s.load = 0;
        if (kind) assert_true(r.e->class_->switch_value(r.e, &s, 0) > 0);
        fw_arena_free(r.arena);
    }
}

/* a body pulled over a pulley at a right angle: T at the end, and T (u_after - u_before), sqrt 2 T
   on the pulley; the drawn tendon has no force as drawn, k draw + k slack when drawn in */
static void test_closed_forms(void **state) {
    (void)state;
    static const fw_device_eyelet corner[] = {{.body = 2, .x_m = -0.4e-3, .y_m = 0.9e-3}, /* 0, 0 */
                                              {.body = FW_GROUND, .x_m = 2e-3, .y_m = 0},
                                              {.body = FW_GROUND, .x_m = 2e-3, .y_m = -1e-3}};
    fw_device_tendon t = pulled_of(3);
    t.eyelet = (fw_device_eyelet *)corner;
    rig r;
    double q[9], p[9], w[9], f[9];
    bool on = true;
    with_tendon(&r, &t);
    rig_pose(&r, q);
    fw_effects_element_place_ports(r.e, q, NULL, p, w);
    fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &on};
    r.e->class_->force(r.e, &s, f);
    const double want[9] = {4e-3, 0, 0, -4e-3, -4e-3, 0, 0, 4e-3, 0};
    for (int i = 0; i < 9; i++)
        assert_near(f[i], want[i], 1e-15);
    fw_arena_free(r.arena);

    t = drawn_of(3, -0.05e-3); /* pretension: 3 N/m (0.2 mm + 0.05 mm) */
    t.eyelet = (fw_device_eyelet *)corner;
    with_tendon(&r, &t);
    s.load = 1;
    r.e->class_->force(r.e, &s, f);
    assert_near(f[0], 3 * 0.25e-3, 1e-15);
    s.load = 0;
    r.e->class_->force(r.e, &s, f);
    assert_near(f[0], 3 * 0.05e-3, 1e-15);
    assert_relative(r.e->force_N, 3 * 0.25e-3, 1e-12);
    /* switch rule: stretched, and not when it would push: k g + c g' */
    s.load = 1;
    assert_relative(r.e->class_->switch_value(r.e, &s, 0), 3 * 0.25e-3, 1e-12);
    w[0] = 10; /* towards the pulley */
    assert_relative(r.e->class_->switch_value(r.e, &s, 0), 3 * 0.25e-3 - 2e-5 * 10, 1e-12);
    w[0] = -10;
    assert_relative(r.e->class_->switch_value(r.e, &s, 0), 3 * 0.25e-3, 1e-12);
    fw_arena_free(r.arena);
}

/* two eyelets that meet: no direction at rest, that of their relative velocity when moving, and
   everything stays finite */
static void test_meeting_eyelets(void **state) {
    (void)state;
    fw_device_tendon t = drawn_of(3, -0.1e-3);
    rig r;
    with_tendon(&r, &t);
    double p[9] = {1e-3, 2e-3, 0, 1e-3, 2e-3, 0, 2e-3, 2e-3, 0}, w[9] = {0}, f[9], k[81], c[81];
    bool on = true;
    fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &on};
    r.e->class_->force(r.e, &s, f);
    assert_true(f[0] == 0 && f[1] == 0);
    w[4] = 1e-3;
    r.e->class_->force(r.e, &s, f);
    assert_true(f[0] == 0 && f[1] != 0);
    r.e->class_->tangent(r.e, &s, k, c);
    for (int i = 0; i < 81; i++)
        assert_true(isfinite(k[i]) && isfinite(c[i]));
    fw_arena_free(r.arena);
}

/* ---- a mass that falls into a slack cable ---- */

enum { FALLS = 4000 };

typedef struct bob {
    rig r;
    double mass, gravity;
    bool on;
} bob;

static double bob_force(bob *b, double y, double v, double *hold) {
    double q[9], speed[9] = {0}, p[6], w[6], f[6];
    rig_pose(&b->r, q);
    q[7] = y, speed[7] = v;
    fw_effects_element_place_ports(b->r.e, q, speed, p, w);
    fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &b->on};
    b->r.e->class_->force(b->r.e, &s, f);
    if (hold) *hold = b->r.e->class_->switch_value(b->r.e, &s, 0);
    return f[4] - b->mass * b->gravity;
}

/* one step of the classical Runge-Kutta method with the switch held */
static void bob_step(bob *b, double h, double *y, double *v) {
    double k[4][2], at = *y, speed = *v;
    for (int i = 0; i < 4; i++) {
        double share = i == 3 ? 1 : 0.5;
        if (i) at = *y + share * h * k[i - 1][0], speed = *v + share * h * k[i - 1][1];
        k[i][0] = speed, k[i][1] = bob_force(b, at, speed, NULL) / b->mass;
    }
    *y += h / 6 * (k[0][0] + 2 * k[1][0] + 2 * k[2][0] + k[3][0]);
    *v += h / 6 * (k[0][1] + 2 * k[1][1] + 2 * k[2][1] + k[3][1]);
}

/* ends the step where the switch no longer fits; the time that was used */
static double bob_advance(bob *b, double h, double *y, double *v) {
    double y1 = *y, v1 = *v, hold;
    bob_step(b, h, &y1, &v1);
    bob_force(b, y1, v1, &hold);
    if ((hold > 0) == b->on) return *y = y1, *v = v1, h;
    double low = 0, high = h;
    for (int i = 0; i < 60; i++) {
        double mid = 0.5 * (low + high);
        y1 = *y, v1 = *v;
        bob_step(b, mid, &y1, &v1);
        bob_force(b, y1, v1, &hold);
        *((hold > 0) == b->on ? &low : &high) = mid;
    }
    bob_step(b, high, y, v);
    b->on = !b->on;
    return high;
}

/* Exact: y below the ring, free fall over the slack, then m z'' + c z' + k z = m g until the cable
   lets go, then free flight. Undamped: the mass comes back to where it started, and the greatest
   depth is slack + x + sqrt(x^2 + 2 x slack), x = m g/k. Damped: the height regained falls short by
   what the closed form of the damped arc says. */
static void fall(double damping, double tolerance) {
    static const fw_device_eyelet line[] = {{.body = FW_GROUND, .x_m = 0.4e-3, .y_m = 1e-3},
                                            {.body = 2, .x_m = 0, .y_m = 0}};
    fw_device_tendon t = drawn_of(2, 0.3e-3);
    t.eyelet = (fw_device_eyelet *)line;
    t.draw_m = 0;
    t.damping_Ns_per_m = damping;
    t.stiffness_N_per_m = 0.05;
    bob b = {.mass = 1e-6, .gravity = 9.81};
    with_tendon(&b.r, &t);
    double m = b.mass, g = b.gravity, k = 0.05, slack = 0.3e-3, y0 = b.r.body[2].y_m;
    double y = y0, v = 0, time = 0, lowest = y0, fallen = sqrt(2 * slack / g);
    double omega = sqrt(k / m), h = 2 * M_PI / omega / FALLS;
    /* the arc: z = stretch, z(0) = 0, z'(0) = g fallen */
    double beta = damping / (2 * m), nu = sqrt(omega * omega - beta * beta), x = m * g / k;
    double a = -x, s = (g * fallen + beta * a) / nu;
    int events = 0;
    while (events < 2 && time < 1) {
        bool before = b.on;
        time += bob_advance(&b, h, &y, &v);
        lowest = fmin(lowest, y);
        if (b.on != before) {
            events++;
            if (events == 1) assert_relative(time, fallen, 1e-9);
        }
    }
    assert_int_equal(events, 2);
    double e = exp(-beta * (time - fallen)), co = cos(nu * (time - fallen)),
           si = sin(nu * (time - fallen));
    double z = x + e * (a * co + s * si);
    double zs = e * ((-beta * a + nu * s) * co + (-beta * s - nu * a) * si);
    assert_near(y0 - slack - y, z, tolerance * x);
    assert_near(-v, zs, tolerance * g * fallen);
    assert_near(fmin(k * z, k * z + damping * zs), 0, 1e-8 * m * g); /* where it lets go */
    if (damping == 0) {
        assert_near(y0 - lowest, slack + x + sqrt(x * x + 2 * x * slack), 1e-6 * x);
        assert_near(v * v / (2 * g), slack, tolerance * slack);
    } else
        assert_true(v * v / (2 * g) < slack);
    fw_arena_free(b.r.arena);
}

static void test_slack_fall(void **state) {
    (void)state;
    fall(0, 1e-9);
    fall(4e-5, 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_laws),         cmocka_unit_test(test_slope),
        cmocka_unit_test(test_closed_forms), cmocka_unit_test(test_meeting_eyelets),
        cmocka_unit_test(test_slack_fall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
