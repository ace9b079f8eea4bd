/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joints with friction whose force passes 0 at distances from nothing to its own size: a disc and a
   block under a load that turns round, against quadrature over panels that shrink towards each
   passage; a pendulum that is thrown over the top just fast enough to be weightless there, whose
   friction comes from its own reaction, against an integration of its own with such steps. The
   error stated is never below the true one, and the true one goes with the tolerance. */
#include "quantity/law_kind.h"
#include "hard.h"
#include <float.h>

static const double NOT = (double)NAN;

static long double wide(double x) {
    return (long double)x;
}

typedef struct tally {
    int runs;
    double worst; /* true error over the stated one */
    double off;   /* true error over tolerance and size */
    long steps;
} tally;

static void judge(tally *t, const char *what, double distance, double rtol, double truth,
                  double found, double stated, double size, long steps) {
    double off = fabs(found - truth);
    if (off > stated)
        fail_msg("%s at %.1e, rtol %.0e: off by %.2e, stated %.2e", what, distance, rtol, off,
                 stated);
    t->runs++;
    t->worst = fmax(t->worst, off / stated);
    t->off = fmax(t->off, (off - 64 * DBL_EPSILON * size) / (rtol * size));
    t->steps += steps;
}

static void tell(const char *what, const tally *t) {
    print_message("%s: %d runs, true error at most %.2g of the stated, %.2g tolerances; %ld steps "
                  "each\n",
                  what, t->runs, t->worst, t->off, t->steps / t->runs);
}

/* ---- one integral ---- */

enum { NODES = 16, MOST = 40 };

typedef struct load { /* |(a sin(w t + p) + c, d)| */
    double a, w, p, c, d;
} load;

static long double size_at(const load *l, long double t) {
    return hypotl(wide(l->a) * sinl(wide(l->w) * t + wide(l->p)) + wide(l->c), wide(l->d));
}

static void gauss(long double x[NODES], long double weight[NODES]) {
    for (int i = 0; i < NODES; i++) {
        long double z = cosl(3.14159265358979323846L * (i + 0.75L) / (NODES + 0.5L)), p, d;
        for (int k = 0; k < 20; k++) {
            long double before = 1;
            p = z;
            for (int n = 2; n <= NODES; n++) {
                long double next = ((2 * n - 1) * z * p - (n - 1) * before) / n;
                before = p, p = next;
            }
            d = NODES * (z * p - before) / (z * z - 1);
            z -= p / d;
        }
        x[i] = z, weight[i] = 2 / ((1 - z * z) * d * d);
    }
}

/* integral of (end - s) |F| from a to b, smooth over b - a */
static long double panel(const load *l, long double end, long double a, long double b) {
    static long double x[NODES], w[NODES];
    long double sum = 0;
    if (w[0] == 0) gauss(x, w);
    for (int i = 0; i < NODES; i++) {
        long double s = (a + b) / 2 + (b - a) / 2 * x[i];
        sum += w[i] * (end - s) * size_at(l, s);
    }
    return sum * (b - a) / 2;
}

/* the same from 0 to end: panels double from 0 on both sides of every passage of a sin = -c */
static long double twice_integrated(const load *l, double end) {
    long double at[2 * MOST + 2], sum = 0;
    int n = 0;
    at[n++] = 0;
    double first = asin(-l->c / l->a);
    for (int k = -2; k < MOST; k++) {
        double angle = k * HARD_PI + (k % 2 ? -first : first), t = (angle - l->p) / l->w;
        if (t > 0 && t < end) {
            assert_true(n < 2 * MOST);
            at[n++] = wide(t);
        }
    }
    at[n] = wide(end);
    for (int k = 0; k < n; k++) {
        long double span = (at[k + 1] - at[k]) / 2, part = 1;
        for (int j = 0; j < 60; j++, part /= 2) {
            long double in = j < 59 ? part / 2 : 0;
            sum += panel(l, wide(end), at[k] + in * span, at[k] + part * span);
            sum += panel(l, wide(end), at[k + 1] - part * span, at[k + 1] - in * span);
        }
    }
    return sum;
}

static const fw_quantity_law *swinging(fw_arena *arena, const load *l) {
    fw_quantity_law *law = fw_arena_one(arena, fw_quantity_law);
    *law = (fw_quantity_law){.kind = &fw_quantity_law_sine,
                             .end_s = (double)INFINITY,
                             .frequency_Hz = l->w / (2 * HARD_PI),
                             .phase_rad = l->p};
    return law;
}

static void rub(fw_arena *arena, rig *r, int pin, int joint, double mu, double radius) {
    r->scene.friction = fw_arena_array(arena, fw_device_friction_use, 1);
    r->scene.friction[r->scene.nfriction++] = (fw_device_friction_use){.revolute = pin,
                                                                       .joint = joint,
                                                                       .coefficient = mu,
                                                                       .static_coefficient = NOT,
                                                                       .radius_m = radius};
}

static load any_load(uint64_t *seed) {
    return (load){.a = 1 + rig_random(seed),
                  .w = 2 + 20 * rig_random(seed),
                  .p = 0.3 + 5 * rig_random(seed),
                  .d = pow(10, -8 * rig_random(seed))};
}

static void put(fw_arena *arena, rig *r, const load *l, bool across) {
    rig_force(r, 0, across ? 0 : l->a, across ? l->a : 0);
    r->scene.force[0].law = swinging(arena, l);
    r->scene.force =
        memcpy(fw_arena_array(arena, fw_device_force, 2), r->scene.force, sizeof(fw_device_force));
    rig_force(r, 0, 0, across ? l->c : l->d);
}

/* a disc on its pin: J phi'' = -mu r |F(t)| as long as it turns */
static void disc(uint64_t seed, double rtol, const char *integrator, tally *t) {
    fw_arena *arena = fw_arena_new(0);
    load l = any_load(&seed);
    const double inertia = 0.3 + rig_random(&seed), drag = 0.1 + rig_random(&seed), end = 1.5;
    double omega = 1.1 * drag / inertia * hypot(l.a, l.d) * end;
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "disc", 1, inertia, 0, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig_velocity(&r, 0, 0, 0, omega);
    put(arena, &r, &l, false);
    rub(arena, &r, 0, FW_NONE, drag, 1);
    r.scene.duration_s = end;
    const fw_dynamics_motion *m =
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = rtol, .integrator = integrator});
    long double want = wide(omega) * wide(end) - wide(drag / inertia) * twice_integrated(&l, end);
    judge(t, "disc", l.d, rtol, (double)want, m->peak[0].angle_rad, m->peak[0].error_rad,
          omega * end, m->stats.steps);
    fw_arena_free(arena);
}

/* a block between guides that changes sides: m x'' = -mu |F(t)| */
static void block(uint64_t seed, double rtol, const char *integrator, tally *t) {
    fw_arena *arena = fw_arena_new(0);
    load l = any_load(&seed);
    l.c = (2 * rig_random(&seed) - 1) * 0.9 * l.a, l.d = 0;
    const double mass = 0.3 + rig_random(&seed), drag = 0.1 + rig_random(&seed), end = 1.5;
    double speed = 1.1 * drag / mass * 2 * l.a * end;
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "block", mass, 0.1, 0, 0, 0);
    hard_tie(arena, &r, "guide", FW_JOINT_PRISMATIC, FW_GROUND, 0);
    rig_velocity(&r, 0, speed, 0, 0);
    put(arena, &r, &l, true);
    rub(arena, &r, FW_NONE, 0, drag, 0);
    r.scene.duration_s = end;
    const fw_dynamics_motion *m = hard_run(
        arena, &r,
        (fw_dynamics_motion_options){.rtol = rtol, .integrator = integrator, .reactions = true});
    long double want = wide(speed) * wide(end) - wide(drag / mass) * twice_integrated(&l, end);
    judge(t, "block", l.c, rtol, (double)want, m->travel_peak[0].travel_m,
          m->travel_peak[0].error_m, speed * end, m->stats.steps);
    fw_arena_free(arena);
}

/* ---- over the top ---- */

static const long double G = 9.81L;

typedef struct thrown {
    long double m, j, l, drag; /* j about the pin; drag: mu r */
    long double phi, omega;
} thrown;

/* a = -m g l sin(phi)/j - drag m |b + a u|/j by Newton's method: the right side is convex */
static long double speeds_up(const thrown *p, long double phi, long double omega) {
    long double sine = sinl(phi), cosine = cosl(phi), square = omega * omega;
    long double a = -p->m * G * p->l * sine / p->j, start = a, step = 1;
    for (int k = 0; k < 100 && fabsl(step) > 1e-19L * fabsl(a); k++) {
        long double x = p->l * (a * cosine - square * sine);
        long double y = p->l * (a * sine + square * cosine) + G;
        long double n = hypotl(x, y), part = p->drag * p->m / p->j;
        long double slope = n > 0 ? part * p->l * (x * cosine + y * sine) / n : 0;
        step = (a - start + part * n) / (1 + slope);
        a -= step;
    }
    return a;
}

/* steps of `part` of the way in angle from the top, `least` added, at most a quarter of `part` */
static void fly(thrown *p, long double time, long double part, long double least) {
    long double done = 0;
    const long double c[4] = {0, 0.5L, 0.5L, 1}, sign = time < 0 ? -1 : 1;
    while (done < fabsl(time)) {
        long double off = fabsl(p->phi - 3.14159265358979323846L) + least;
        long double h = fminl(part * off, 0.25L * part) / p->omega, v[4], a[4];
        h = sign * fminl(h, fabsl(time) - done);
        for (int k = 0; k < 4; k++) {
            v[k] = p->omega + (k ? c[k] * h * a[k - 1] : 0);
            a[k] = speeds_up(p, p->phi + (k ? c[k] * h * v[k - 1] : 0), v[k]);
        }
        p->phi += h / 6 * (v[0] + 2 * v[1] + 2 * v[2] + v[3]);
        p->omega += h / 6 * (a[0] + 2 * a[1] + 2 * a[2] + a[3]);
        done += fabsl(h);
    }
}

static void over_the_top(uint64_t seed, double rtol, const char *integrator, tally *t) {
    fw_arena *arena = fw_arena_new(0);
    const uint64_t seed_given = seed;
    const double m = 0.5 + rig_random(&seed), l = 0.3 + rig_random(&seed);
    const double own = m * l * l * (0.1 + rig_random(&seed)), end = 0.8;
    double near = pow(10, -8 * rig_random(&seed)) * (rig_random(&seed) < 0.5 ? 1 : -0.5);
    thrown p = {.m = wide(m), .l = wide(l), .j = wide(own + m * l * l)};
    p.drag = 0.05L + 0.4L * wide(rig_random(&seed));
    p.drag *= p.j / (p.m * p.l);
    p.phi = 3.14159265358979323846L, p.omega = sqrtl(G / p.l * (1 + wide(near)));
    const double drag = (double)p.drag;
    p.drag = wide(drag);
    fly(&p, -0.3L, 0.01L, 0.1L);
    const double phi = (double)p.phi, omega = (double)p.omega;
    p.phi = wide(phi), p.omega = wide(omega); /* what is thrown, whatever becomes of it */
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "bob", m, own, l * sin(phi), -l * cos(phi), phi);
    rig_pin_local(&r, "O", FW_GROUND, 0, 0, 0, 0, l);
    rig_velocity(&r, 0, l * cos(phi) * omega, l * sin(phi) * omega, omega);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = (double)-G;
    r.scene.duration_s = end;
    rub(arena, &r, 0, FW_NONE, drag, 1);
    const fw_dynamics_motion *motion =
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = rtol, .integrator = integrator});
    static double known[4096]; /* by seeds: the same for all tolerances */
    double *truth = &known[seed_given % 4096];
    if (*truth == 0) {
        thrown rough = p;
        fly(&p, wide(end), 0.004L, 0.1L * fabsl(wide(near)));
        fly(&rough, wide(end), 0.008L, 0.1L * fabsl(wide(near)));
        assert_true(fabsl(p.phi - rough.phi) < 5e-12L); /* 15 times what p is off by */
        *truth = (double)p.phi;
    }
    judge(t, "pendulum", near, rtol, *truth, motion->peak[0].angle_rad, motion->peak[0].error_rad,
          1, motion->stats.steps);
    fw_arena_free(arena);
}

/* ---- all of them ---- */

typedef void family(uint64_t seed, double rtol, const char *integrator, tally *t);

static void by_lot(const char *name, family *one, const char *integrator, int count, double most) {
    for (double rtol = 1e-6; rtol > 0.5e-13; rtol /= 10) {
        char what[80];
        tally t = {0};
        for (int c = 0; c < (hard_quick() ? count / 10 : count); c++)
            one(1000 + (uint64_t)c, rtol, integrator, &t);
        snprintf(what, sizeof what, "%s, %s, rtol %.0e", name, integrator, rtol);
        tell(what, &t);
        assert_true(t.off < most);
    }
}

static void turning_loads(void **state) {
    (void)state;
    by_lot("disc", disc, "dop853", 100, 100);
    by_lot("disc", disc, "dopri5", 10, 100);
    by_lot("disc", disc, "radau5", 10, 100);
}

static void changing_sides(void **state) {
    (void)state;
    by_lot("block", block, "dop853", 100, 100);
    by_lot("block", block, "dopri5", 10, 100);
    by_lot("block", block, "radau5", 10, 100);
}

static void weightless(void **state) {
    (void)state;
    by_lot("pendulum", over_the_top, "dop853", 40, 100);
    by_lot("pendulum", over_the_top, "dopri5", 10, 100);
    by_lot("pendulum", over_the_top, "radau5", 10, 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turning_loads),
        cmocka_unit_test(changing_sides),
        cmocka_unit_test(weightless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
