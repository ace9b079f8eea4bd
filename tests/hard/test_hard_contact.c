/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What bounces, snaps, sticks and hits stops, through the whole engine: closed forms and
   integrations of their own, every event, every tolerance, every integrator. Hard because each
   event begins where the last one ended, so that one that is lost, doubled or late spoils all that
   follows; and because what comes to rest on a spring must stop switching. */
#include "bounce.h"
#include "hard.h"
#include "reference.h"

static const double G = 9.81;

/* ---- a case: a scene, and its motion by other means ---- */

typedef struct trial {
    const char *name;
    rig r;
    int body, part;                      /* what is compared: component `part` of q of the body */
    void *exact;                         /* of: */
    double (*at)(void *exact, double t); /* that component; called with t ascending */
    void (*again)(void *exact);          /* from the start */
    long (*events)(void *exact);         /* up to the last t */
    double size, kappa;                  /* error / (size rtol) allowed at the finest tolerances */
    double *known;                       /* (SAMPLES) of it; NULL at first */
    long count;                          /* events up to the end */
} trial;

enum { SAMPLES = 401 };

static void know(fw_arena *arena, trial *c) {
    c->known = fw_arena_array(arena, double, SAMPLES);
    c->again(c->exact);
    for (int k = 0; k < SAMPLES; k++)
        c->known[k] = c->at(c->exact, k * c->r.scene.duration_s / (SAMPLES - 1));
    c->count = c->events(c->exact);
}

/* largest error over all samples, relative to the size of the motion */
static double error_of(const trial *c, const fw_dynamics_motion *m) {
    double worst = 0;
    for (int k = 0; k < SAMPLES; k++)
        worst = fmax(worst, fabs(hard_q(m, k)[3 * c->body + c->part] - c->known[k]));
    return worst / c->size;
}

/* rtol 1e-3 (which is taken as 1e-5) and 1e-6 to 1e-13: errors fall, events stay */
static void refine(fw_arena *arena, trial *c) {
    double before = (double)INFINITY, error = 0;
    know(arena, c);
    for (int e = 3; e <= 13; e += e == 3 ? 3 : 1) {
        if (hard_quick() && e != 3 && e != 8 && e != 13) continue;
        double rtol = pow(10, -e);
        const fw_dynamics_motion *m = hard_run(
            arena, &c->r,
            (fw_dynamics_motion_options){.rtol = rtol, .integrator = "dop853", .samples = SAMPLES});
        error = error_of(c, m);
        print_message("%-22s rtol 1e-%02d: error %.1e, %ld events (%ld), energy %.1e, %ld steps\n",
                      c->name, e, error, m->stats.events, c->count, m->stats.energy_error,
                      m->stats.steps);
        assert_int_equal(m->stats.events, c->count);
        /* down to the round-off of the whole motion */
        assert_true(error < fmax(before, 30 * c->kappa * 1e-13));
        assert_true(error < c->kappa * fmax(rtol, 1e-13));
        assert_true(m->stats.energy_error < c->kappa * fmax(rtol, 1e-13));
        before = fmin(before, error);
    }
}

/* every integrator and some methods */
static void agree(fw_arena *arena, trial *c) {
    static const char *const by[][2] = {
        {"dop853", "minimal"},        {"dop853", "svd"},
        {"dop853", "udwadia-kalaba"}, {"dop853", "coordinate-partitioning"},
        {"dopri5", "chain"},          {"radau5", "chain"},
        {"gsl-rkf45", "schur"},       {"gsl-rk8pd", "augmented"},
        {"gsl-msadams", "chain"},     {"gsl-bsimp", "chain"},
        {"generalised-alpha", "qr"},  {"rk4", "chain"}};
    for (size_t i = 0; i < sizeof by / sizeof by[0]; i++) {
        if (c->r.m.npin == 0 && strcmp(by[i][1], "minimal") == 0) continue; /* knows pins only */
        if (hard_quick() && i % 4) continue;
        bool fixed = strcmp(by[i][0], "rk4") == 0, low = strcmp(by[i][0], "generalised-alpha") == 0;
        fw_dynamics_motion_options o = {.rtol = low                    ? 1e-8
                                                : fixed && c->r.m.npin ? 1e-12
                                                                       : 1e-10,
                                        .integrator = by[i][0],
                                        .method = by[i][1],
                                        .samples = SAMPLES};
        const fw_dynamics_motion *m = hard_run(arena, &c->r, o);
        double error = error_of(c, m);
        print_message("%-22s %-17s %-23s: error %.1e, %ld events, energy %.1e, %ld steps\n",
                      c->name, by[i][0], by[i][1], error, m->stats.events, m->stats.energy_error,
                      m->stats.steps);
        assert_int_equal(m->stats.events, c->count);
        assert_true(error < c->kappa * (low ? 1e-6 : 1e-8));
    }
}

/* ---- bounces ---- */

static fw_device_contact_use *touch(fw_arena *arena, rig *r, fw_device_contact_side side, int a,
                                    int b, double distance, double k, double c) {
    if (!r->scene.contact) r->scene.contact = fw_arena_array(arena, fw_device_contact_use, 16);
    fw_device_contact_use *u = &r->scene.contact[r->scene.ncontact++];
    *u = (fw_device_contact_use){.id = "touch",
                                 .joint = FW_NONE,
                                 .side = side,
                                 .body_a = a,
                                 .body_b = b,
                                 .distance_m = distance,
                                 .stiffness_N_per_m = k,
                                 .damping_Ns_per_m = c};
    return u;
}

/* outside: a mass on a guide falls from `height` on a round thing below it; inside: a free one in a
   hole falls on its floor */
static trial bouncing(fw_arena *arena, fw_device_contact_side side, double height, double k,
                      double zeta, double duration) {
    bounce *b = fw_arena_one(arena, bounce);
    double m = 0.3, c = 2 * zeta * sqrt(k * m), d = side == FW_CONTACT_INSIDE ? 0.6 : 0.2;
    double sign = -1, floor = side == FW_CONTACT_INSIDE ? -d : d;
    *b = (bounce){.m = m, .k = k, .c = c, .fall = G, .g0 = -height, .sign = sign, .offset = floor};
    trial t = {.name = side == FW_CONTACT_INSIDE ? "bounces in a hole" : "bounces on a guide",
               .r = rig_new(arena, 1, 0, 0),
               .part = 1,
               .exact = b,
               .at = bounce_at,
               .again = bounce_again,
               .events = bounce_events,
               .size = height,
               .kappa = 1e3};
    rig_body(&t.r, "ball", m, 1e-3, 0, floor + height, 0);
    if (side == FW_CONTACT_OUTSIDE) {
        fw_device_joint *guide =
            hard_tie_at(arena, &t.r, "guide", FW_JOINT_PRISMATIC, FW_GROUND, 0, 0, floor + height);
        guide->axis_rad = HARD_PI / 2;
    }
    touch(arena, &t.r, side, FW_GROUND, 0, d, k, c);
    t.r.scene.gravity = true, t.r.scene.gy_m_per_s2 = -G;
    t.r.scene.duration_s = duration;
    return t;
}

/* until it rests: from a soft ground to one where a touch lasts 1/500 of the first fall */
static void bounces(void **state) {
    (void)state;
    static const double stiff[] = {2e3, 1e5, 1e7}, zeta[] = {0.02, 0.015, 0.03};
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++) {
            fw_arena *arena = fw_arena_new(0);
            double rest = 3 * sqrt(2 * 0.1 / G) / zeta[k];
            trial t = bouncing(arena, (fw_device_contact_side)side, 0.1, stiff[k], zeta[k], rest);
            refine(arena, &t);
            assert_true(t.count >= 21 && isinf((double)((bounce *)t.exact)->end));
            if (k == 0) agree(arena, &t);
            fw_arena_free(arena);
        }
}

/* nothing takes energy: all of it is there after a thousand bounces, each as high as the first */
static void thousand_bounces(void **state) {
    (void)state;
    long count = hard_quick() ? 50 : 1000;
    for (double k = 1e4; k < 1e9; k *= 1e2) {
        fw_arena *arena = fw_arena_new(0);
        trial t = bouncing(arena, FW_CONTACT_OUTSIDE, 0.1, k, 0, 1);
        bounce *b = t.exact;
        b->on = false;
        bounce_again(b);
        double fall = sqrt(2 * 0.1 / G);
        b->t = 0, b->g = 0, b->v = (long double)(G * fall), b->on = true;
        double period = 2 * fall + (double)bounce_lasts(b);
        t.r.scene.duration_s = ((double)count + 0.01) * period;
        know(arena, &t);
        const fw_dynamics_motion *m =
            hard_run(arena, &t.r,
                     (fw_dynamics_motion_options){
                         .rtol = 1e-12, .integrator = "dop853", .samples = SAMPLES});
        double error = error_of(&t, m);
        print_message("%ld bounces, k %.0e: %ld events, error %.1e, energy %.1e, %ld steps\n",
                      count, k, m->stats.events, error, m->stats.energy_error, m->stats.steps);
        assert_int_equal(m->stats.events, 2 * count);
        /* a place off by rtol of the way is one in k: sqrt(k/m) times the fall in the speed */
        double passed_on = 1e-12 * sqrt(k / b->m) * fall * (double)count;
        assert_true(m->stats.energy_error < passed_on);
        assert_true(error < 10 * passed_on * (double)count);
        fw_arena_free(arena);
    }
}

/* thrown up to where it barely reaches the ceiling: overlap of 1e-4 down to 1e-11 of the way, for
   a blink of the step; and not at all */
static void grazes(void **state) {
    (void)state;
    const double way = 0.5;
    for (int e = 4; e <= 12; e++) {
        fw_arena *arena = fw_arena_new(0);
        double over = e == 12 ? -1e-9 : way * pow(10, -e), top = way + over;
        rig r = rig_new(arena, 1, 0, 0);
        rig_body(&r, "ball", 1, 1, 0, 0, 0);
        rig_velocity(&r, 0, 0, sqrt(2 * G * top), 0);
        touch(arena, &r, FW_CONTACT_INSIDE, FW_GROUND, 0, way, 1e5, 0);
        r.scene.gravity = true, r.scene.gy_m_per_s2 = -G;
        r.scene.duration_s = 1.7 * sqrt(2 * top / G);
        const fw_dynamics_motion *m = hard_run(
            arena, &r,
            (fw_dynamics_motion_options){.rtol = 1e-11, .integrator = "dop853", .samples = 3});
        print_message("grazes by %.0e: %ld events, %ld steps\n", over, m->stats.events,
                      m->stats.steps);
        assert_int_equal(m->stats.events, over > 0 ? 2 : 0);
        assert_true(m->stats.energy_error < 1e-11);
        fw_arena_free(arena);
    }
}

/* ---- motions by an integration of their own ---- */

typedef struct own {
    ref now, first;
    double scale;
    int part;
} own;

static void own_again(void *exact) {
    own *o = exact;
    o->now = o->first;
}
static double own_at(void *exact, double t) {
    own *o = exact;
    ref_to(&o->now, (ref_real)t);
    return (double)o->now.x[o->part];
}
static long own_events(void *exact) {
    return ((const own *)exact)->now.events;
}

static trial by_own(const char *name, own *o, double size, double kappa) {
    o->now = o->first;
    return (trial){.name = name,
                   .exact = o,
                   .at = own_at,
                   .again = own_again,
                   .events = own_events,
                   .size = size,
                   .kappa = kappa};
}

/* a mass on a slack tendon: x, y, x', y' from its fixed end */
typedef struct slack {
    ref_real m, k, c, length;
} slack;

static void slack_look(const slack *s, const ref_real *x, ref_real *g, ref_real *rate) {
    ref_real l = hypotl(x[0], x[1]);
    *g = l - s->length, *rate = (x[0] * x[2] + x[1] * x[3]) / l;
}
static void slack_rhs(const ref *r, ref_real t, const ref_real *x, ref_real *dx) {
    (void)t;
    const slack *s = r->data;
    ref_real g, rate, l = hypotl(x[0], x[1]);
    slack_look(s, x, &g, &rate);
    ref_real pull = r->on ? s->k * g + s->c * rate : 0;
    dx[0] = x[2], dx[1] = x[3];
    dx[2] = -pull * x[0] / l / s->m;
    dx[3] = -pull * x[1] / l / s->m - (ref_real)G;
}
static ref_real slack_value(const ref *r, ref_real t, const ref_real *x) {
    (void)t;
    const slack *s = r->data;
    ref_real g, rate;
    slack_look(s, x, &g, &rate);
    return fminl(s->k * g, s->k * g + s->c * rate);
}

/* falls beside its support, snaps taut, swings, goes slack again; by a tendon and by a cable */
static trial slack_pendulum(fw_arena *arena, bool cable, double zeta) {
    const double m = 0.2, k = 2e3, c = 2 * zeta * sqrt(k * m), length = 0.5, x0 = 0.3, y0 = 0.1;
    slack *s = fw_arena_one(arena, slack);
    own *o = fw_arena_one(arena, own);
    *s = (slack){(ref_real)m, (ref_real)k, (ref_real)c, (ref_real)length};
    o->first = (ref){.n = 4,
                     .rhs = slack_rhs,
                     .value = slack_value,
                     .data = s,
                     .h = 1e-5L,
                     .x = {(ref_real)x0, (ref_real)y0, 0, 0}};
    trial t = by_own(cable ? "slack cable" : "slack tendon", o, length, 1e4);
    t.r = rig_new(arena, 1, 0, 1);
    rig_body(&t.r, "bob", m, 1e-3, x0, y0, 0);
    if (cable) {
        fw_device_spring *line = rig_spring(&t.r, "line", FW_GROUND, 0, 0, 0, 0, 0, k, length);
        line->cable = true, line->damping_Ns_per_m = c;
    } else {
        fw_device_tendon *line = t.r.scene.tendon = fw_arena_array(arena, fw_device_tendon, 1);
        *line = (fw_device_tendon){.id = "line",
                                   .eyelet = fw_arena_array(arena, fw_device_eyelet, 2),
                                   .neyelet = 2,
                                   .pull_N = (double)NAN,
                                   .draw_m = 0,
                                   .stiffness_N_per_m = k,
                                   .damping_Ns_per_m = c,
                                   .slack_m = length - hypot(x0, y0)};
        line->eyelet[0] = (fw_device_eyelet){.body = FW_GROUND};
        line->eyelet[1] = (fw_device_eyelet){.body = 0};
        t.r.scene.ntendon = 1;
    }
    t.r.scene.gravity = true, t.r.scene.gy_m_per_s2 = -G;
    t.r.scene.duration_s = 2.5;
    return t;
}

static void slack_pendulums(void **state) {
    (void)state;
    for (int k = 0; k < 4; k++) {
        fw_arena *arena = fw_arena_new(0);
        trial t = slack_pendulum(arena, k % 2, k < 2 ? 0 : 0.05);
        refine(arena, &t);
        assert_true(t.count >= 5);
        if (k % 2 == 0) agree(arena, &t);
        fw_arena_free(arena);
    }
}

/* J phi'' + k phi = M sin(w t) - stop (ks (phi - at) + cs phi') */
typedef struct driven {
    ref_real j, k, m, w, at, ks, cs;
} driven;

static void driven_rhs(const ref *r, ref_real t, const ref_real *x, ref_real *dx) {
    const driven *d = r->data;
    ref_real stop = r->on ? d->ks * (x[0] - d->at) + d->cs * x[1] : 0;
    dx[0] = x[1];
    dx[1] = (d->m * sinl(d->w * t) - d->k * x[0] - stop) / d->j;
}
static ref_real driven_value(const ref *r, ref_real t, const ref_real *x) {
    (void)t;
    const driven *d = r->data;
    ref_real push = d->ks * (x[0] - d->at);
    return fminl(push, push + d->cs * x[1]);
}

static void driven_stop(void **state) {
    (void)state;
    for (int damped = 0; damped < 2; damped++) {
        fw_arena *arena = fw_arena_new(0);
        driven d = {0.01L, 1, 0.35L, 14, 0.15L, 500, damped ? 0.4L : 0};
        own *o = fw_arena_one(arena, own);
        o->first = (ref){.n = 2, .rhs = driven_rhs, .value = driven_value, .data = &d, .h = 1e-5L};
        trial t = by_own(damped ? "driven against a pad" : "driven against a stop", o, 0.3, 1e5);
        t.part = 2;
        t.r = rig_new(arena, 1, 1, 0);
        rig_body(&t.r, "rotor", 1, (double)d.j, 0, 0, 0);
        fw_mechanism_pin *p = rig_pin(&t.r, "O", FW_GROUND, 0, 0, 0, (double)d.k, 0);
        p->stop_min_rad = (double)NAN, p->stop_max_rad = (double)d.at;
        p->stop_stiffness_Nm_per_rad = (double)d.ks, p->stop_damping_Nms_per_rad = (double)d.cs;
        fw_quantity_law law = hard_law(arena, "sin(14 rad/s * t)", (fw_quantity_dimension){0});
        rig_torque(&t.r, 0, (double)d.m);
        t.r.scene.torque[0].law = &law;
        t.r.scene.duration_s = 8;
        refine(arena, &t);
        assert_true(t.count >= 30);
        agree(arena, &t);
        fw_arena_free(arena);
    }
}

/* a mass on a belt, 20 cycles (test_friction.c has the closed form): on: it sticks */
typedef struct belt {
    ref_real k, m, v, rest, slide; /* forces */
} belt;

static void belt_rhs(const ref *r, ref_real t, const ref_real *x, ref_real *dx) {
    (void)t;
    const belt *b = r->data;
    dx[0] = r->on ? b->v : x[1];
    dx[1] = r->on ? 0 : (b->slide - b->k * x[0]) / b->m;
}
/* it slips from |k x| = rest on, and sticks when the belt has caught up */
static ref_real belt_value(const ref *r, ref_real t, const ref_real *x) {
    (void)t;
    const belt *b = r->data;
    if (r->on) return b->rest - b->k * x[0];
    return b->k * x[0] > b->slide ? -1 : x[1] - b->v;
}

static void sticks_and_slips(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    belt b = {40, 0.4L, 0.15L, 2.4L, 1.4L};
    own *o = fw_arena_one(arena, own);
    o->first = (ref){.n = 2,
                     .rhs = belt_rhs,
                     .value = belt_value,
                     .data = &b,
                     .h = 1e-5L,
                     .x = {0, b.v},
                     .on = true};
    trial t = by_own("sticks and slips", o, 0.06, 1e5);
    t.body = 1;
    t.r = rig_new(arena, 2, 0, 1);
    rig_body(&t.r, "belt", 3, 1, 0, 0, 0);
    rig_body(&t.r, "mass", (double)b.m, 1, 0, 0, 0);
    hard_tie(arena, &t.r, "rail", FW_JOINT_PRISMATIC, FW_GROUND, 0);
    hard_tie(arena, &t.r, "rub", FW_JOINT_PRISMATIC, 0, 1);
    rig_velocity(&t.r, 0, (double)b.v, 0, 0);
    rig_velocity(&t.r, 1, (double)b.v, 0, 0);
    rig_spring(&t.r, "spring", FW_GROUND, -5, 0, 1, 0, 0, (double)b.k, 5);
    t.r.scene.friction = fw_arena_array(arena, fw_device_friction_use, 1);
    t.r.scene.friction[t.r.scene.nfriction++] = (fw_device_friction_use){.revolute = FW_NONE,
                                                                         .joint = 1,
                                                                         .coefficient = 0.35,
                                                                         .static_coefficient = 0.6,
                                                                         .preload_N = 4};
    fw_quantity_law law = hard_law(arena, "0.15 m/s * t", (fw_quantity_dimension){.m = 1});
    hard_driver(arena, &t.r, "motor", FW_NONE, 0, law);
    t.r.scene.duration_s = 20.2;
    refine(arena, &t);
    assert_true(t.count >= 40);
    agree(arena, &t);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounces),     cmocka_unit_test(thousand_bounces),
        cmocka_unit_test(grazes),      cmocka_unit_test(slack_pendulums),
        cmocka_unit_test(driven_stop), cmocka_unit_test(sticks_and_slips),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
