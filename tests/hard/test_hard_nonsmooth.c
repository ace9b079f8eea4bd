/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What bounces and what sticks, by lot over many decades of every number, against closed forms and
   under refinement of the tolerance: the events that the closed form has, errors that fall with the
   tolerance. A seed alone: FW_HARD_CASE=n.

   A place is kept to rtol of the scene's length L, however small the motion (size) is beside it; at
   an event that becomes an error of time, which the next phase turns into a place again, so many
   times larger: `passed`. What rtol explains is thus rtol L/size passed, for every event anew. */
#include "quantity/law_kind.h"
#include "bounce.h"
#include "hard.h"

static uint64_t seed;

static double lot(double from, double to) {
    return from + (to - from) * rig_random(&seed);
}
static double decades(double low, double high) {
    return pow(10, lot(low, high));
}

enum { SAMPLES = 201 };

typedef struct trial {
    const char *name;
    rig r;
    int part; /* of q: what is compared */
    double known[SAMPLES], size, length, passed;
    long events; /* of the closed form */
    /* events that are there only where errors are well below `graze` of the motion, which is the
       same without them; */
    long grazing;
    double graze;
} trial;

static double sample_s(const trial *t, int i) {
    return i * t->r.scene.duration_s / (SAMPLES - 1);
}

/* the largest share of what the tolerance explains */
static double most_share;
static int judged;

/* a tolerance that is no smaller than the motion, or than what makes one event of two, says nothing
   about it and is left out */
static void at_tolerance(fw_arena *arena, const trial *t, int c, double rtol) {
    double error = 0, explained = rtol * t->length / t->size * t->passed * (1 + (double)t->events);
    if (explained > 1e-3) return;
    const fw_dynamics_motion *m = hard_run(
        arena, &t->r,
        (fw_dynamics_motion_options){.rtol = rtol, .samples = SAMPLES, .most_steps = 200000});
    for (int i = 0; i < SAMPLES; i++)
        error = fmax(error, fabs(hard_q(m, i)[t->part] - t->known[i]) / t->size);
    bool seen = t->graze > 100 * explained;
    long least = t->events - (seen ? 0 : t->grazing);
    bool good = m->stats.events >= least && m->stats.events <= t->events && error < 10 * explained;
    if (!good || getenv("FW_HARD_CASE"))
        print_message("%s %d rtol %.0e: error %.1e (%.1e), %ld events (%ld to %ld), energy %.1e, "
                      "%ld steps\n",
                      t->name, c, rtol, error, explained, m->stats.events, least, t->events,
                      m->stats.energy_error, m->stats.steps);
    most_share = fmax(most_share, error / explained), judged++;
    assert_true(good);
}

static void refine(const char *name, void (*draw)(fw_arena *, int, trial *), int many, int quick) {
    const char *one = getenv("FW_HARD_CASE");
    int from = one ? atoi(one) : 0, to = one ? from + 1 : hard_quick() ? quick : many;
    long events = 0;
    most_share = 0, judged = 0;
    for (int c = from; c < to; c++) {
        fw_arena *arena = fw_arena_new(0);
        trial *t = fw_arena_one(arena, trial);
        seed = 7001 + 1000003 * (uint64_t)c;
        t->name = name;
        draw(arena, c, t);
        for (int e = 5; e <= 11; e += hard_quick() ? 6 : 2)
            at_tolerance(arena, t, c, pow(10, -e));
        events += t->events;
        fw_arena_free(arena);
    }
    print_message("%s: %d by lot, %ld events; %d runs judged, errors up to %.1e of what the "
                  "tolerance explains\n",
                  name, to - from, events, judged, most_share);
}

/* ---- a mass bounces until it rests ---- */

/* 1 ug to 0.1 kg over a gap of 1 nm to 1 mm, contacts of 1e2 to 1e8 N/m with 0 to 0.99 of the
   critical damping (or 1 to 3 of it), a fall between a hundredth of the weight and 1000 of it */
static void draw_drop(fw_arena *arena, int c, trial *t) {
    double m = decades(-9, -1), k = decades(2, 8), fall = 9.81 * decades(-2, 3);
    double gap = decades(-9, -3), size = fmax(decades(-4, -1), 2 * gap), zeta = decades(-3, -1);
    if (c % 2) zeta = lot(0.01, 0.99);
    if (c % 8 == 1) zeta = lot(1.01, 3);
    if (c % 8 == 0) zeta = 0;
    while (m * fall / k * (1 + sqrt(1 + 2 * k * gap / (m * fall))) > size / 4)
        m /= 10; /* it must not go through */
    bounce b = {.m = m, .k = k, .c = 2 * zeta * sqrt(k * m), .fall = fall, .g0 = -gap};
    b.sign = -1, b.offset = size;
    bounce_again(&b);
    while (b.count < (zeta > 0 ? 120 : 40) && isfinite((double)b.end))
        bounce_next(&b);
    double more = isfinite((double)b.end) ? 0.5 * (double)(b.end - b.t) : 10 * sqrt(m / k);
    rig *r = &t->r;
    *r = rig_new(arena, 1, 0, 0);
    rig_body(r, "ball", m, m * size * size * decades(-2, 0), 0, size + gap, 0);
    r->scene.contact = fw_arena_array(arena, fw_device_contact_use, 1);
    r->scene.contact[r->scene.ncontact++] = (fw_device_contact_use){.id = "touch",
                                                                    .joint = FW_NONE,
                                                                    .side = FW_CONTACT_OUTSIDE,
                                                                    .body_a = FW_GROUND,
                                                                    .body_b = 0,
                                                                    .distance_m = size,
                                                                    .stiffness_N_per_m = k,
                                                                    .damping_Ns_per_m = b.c};
    r->scene.gravity = true, r->scene.gy_m_per_s2 = -fall;
    r->scene.duration_s = (double)b.t + more;
    t->part = 1, t->size = gap, t->length = size;
    t->passed = 1 + sqrt(k / m) * sqrt(2 * gap / fall);
    bounce_again(&b);
    for (int i = 0; i < SAMPLES; i++)
        t->known[i] = bounce_at(&b, sample_s(t, i));
    t->events = b.count;
    if (getenv("FW_HARD_CASE"))
        print_message("m %.1e kg, k %.1e N/m, zeta %.3f, fall %.1e, gap %.1e m of %.1e m\n", m, k,
                      zeta, fall, gap, size);
}

static void drops(void **state) {
    (void)state;
    refine("drop", draw_drop, 100, 8);
}

/* ---- stick and slip ---- */

/* A mass on a spring (k, J: or an inertia on a torsion spring) whose other end is drawn at the rate
   v, or that stands on a belt of this rate: it sticks until the spring has mu_s N, slips for
   2 (pi - atan(D w/v))/w, D = (mu_s - mu_k) N/k, and sticks again for 2 D/v. With small D it comes
   to rest (on the belt) for an instant only: seen or not, the motion is the same. */
typedef struct cycle {
    double k, w, d, v, rest, slide; /* rest, slide: mu N/k */
    double first, slips, period;
} cycle;

static cycle draw_cycle(int c) {
    cycle y = {.k = decades(-2, 8), .w = decades(0, 5)};
    double amount = decades(-9, -2);
    y.rest = amount, y.slide = c % 4 == 0 ? amount : amount * (c % 4 == 1 ? 0.99 : lot(0.1, 0.95));
    y.d = y.rest - y.slide;
    y.v = y.w * amount * decades(-4, 3);
    y.slips = 2 * (HARD_PI - atan(y.d * y.w / y.v)) / y.w;
    y.period = 2 * y.d / y.v + y.slips;
    return y;
}

/* stretch of the spring at t, from `start` on */
static double cycle_at(const cycle *y, double start, double t) {
    double first = (y->rest - start) / y->v, at = t - first;
    if (at <= 0) return start + y->v * t;
    at -= y->period * floor(at / y->period);
    if (at < y->slips) return y->slide + y->d * cos(y->w * at) + y->v / y->w * sin(y->w * at);
    return y->slide - y->d + y->v * (at - y->slips);
}

enum { CYCLES = 6 };

static void cycle_trial(const cycle *y, double start, trial *t) {
    double first = (y->rest - start) / y->v;
    t->r.scene.duration_s = first + (CYCLES + 0.37) * y->period;
    t->events = 1 + 2 * CYCLES + (0.37 * y->period > y->slips);
    t->grazing = t->events - 1, t->graze = 0.5 * pow(y->d * y->w / y->v, 2);
    t->size = hypot(y->d, y->v / y->w);
    t->passed = 1 + y->d * y->w / y->v;
    if (getenv("FW_HARD_CASE"))
        print_message(
            "eps %.2e k %.1e, w %.1e /s, slides at %.1e of %.1e, v %.1e (%.1e of w rest), from "
            "%.1e\n",
            y->d * y->w / y->v, y->k, y->w, y->slide, y->rest, y->v, y->v / y->w / y->rest, start);
}

static void rub(fw_arena *arena, rig *r, int pin, int joint, double mu_s, double mu_k,
                double preload, double radius) {
    r->scene.friction = fw_arena_array(arena, fw_device_friction_use, 1);
    r->scene.friction[r->scene.nfriction++] = (fw_device_friction_use){.revolute = pin,
                                                                       .joint = joint,
                                                                       .coefficient = mu_k,
                                                                       .static_coefficient = mu_s,
                                                                       .preload_N = preload,
                                                                       .radius_m = radius};
}

/* a law that is `from` at 0 and rises by `rate` per second */
static fw_quantity_law rising(fw_arena *arena, double from, double rate, double end_s) {
    double *t = fw_arena_array(arena, double, 2), *x = fw_arena_array(arena, double, 2);
    t[1] = 2 * end_s, x[0] = from, x[1] = from + rate * t[1];
    return (fw_quantity_law){
        .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = x, .ntable = 2};
}

static void draw_belt(fw_arena *arena, int c, trial *t) {
    cycle y = draw_cycle(c);
    double m = y.k / (y.w * y.w), mu = lot(0.05, 1), size = y.rest * decades(0, 4);
    double reach = size + 10 * (y.rest + y.v / y.w);
    rig *r = &t->r;
    *r = rig_new(arena, 2, 0, 1);
    rig_body(r, "belt", m * decades(-1, 1), m * size * size, 0, 0, 0);
    rig_body(r, "mass", m, m * size * size, 0, 0, 0);
    hard_tie(arena, r, "rail", FW_JOINT_PRISMATIC, FW_GROUND, 0);
    hard_tie(arena, r, "rub", FW_JOINT_PRISMATIC, 0, 1);
    rig_spring(r, "spring", FW_GROUND, -reach, 0, 1, 0, 0, y.k, reach);
    rub(arena, r, FW_NONE, 1, mu, mu * y.slide / y.rest, y.k * y.rest / mu, 0);
    rig_velocity(r, 0, y.v, 0, 0);
    rig_velocity(r, 1, y.v, 0, 0);
    cycle_trial(&y, 0, t);
    hard_driver(arena, r, "motor", FW_NONE, 0, rising(arena, 0, y.v, r->scene.duration_s));
    t->part = 3, t->length = fmax(size, y.v * r->scene.duration_s);
    for (int i = 0; i < SAMPLES; i++)
        t->known[i] = cycle_at(&y, 0, sample_s(t, i));
}

static void belts(void **state) {
    (void)state;
    refine("belt", draw_belt, 60, 8);
}

/* a rotor on a torsion spring that is strained from the start, by up to 0.999 of what friction
   holds, and a torque that rises: it turns by what the torque's spring would less the strain */
static void draw_strained(fw_arena *arena, int c, trial *t) {
    cycle y = draw_cycle(c);
    double j = y.k / (y.w * y.w), size = decades(-4, -1), mu = lot(0.05, 1);
    double start = y.rest * (c % 3 == 0 ? 0.999 : c % 3 == 1 ? -0.999 : lot(-1, 1));
    rig *r = &t->r;
    *r = rig_new(arena, 1, 1, 0);
    rig_body(r, "rotor", j / (size * size), j, 0, 0, 0);
    fw_mechanism_pin *p = rig_pin(r, "axle", FW_GROUND, 0, 0, 0, y.k, 0);
    p->free_angle_rad = start; /* wound: the torque k start turns it forwards */
    rub(arena, r, 0, FW_NONE, mu, mu * y.slide / y.rest, y.k * y.rest / mu / size, size);
    rig_torque(r, 0, 1);
    cycle_trial(&y, start, t);
    fw_quantity_law *law = fw_arena_one(arena, fw_quantity_law);
    *law = rising(arena, 0, y.k * y.v, r->scene.duration_s);
    r->scene.torque[0].law = law;
    t->part = 2, t->length = fmax(1, y.v * r->scene.duration_s);
    for (int i = 0; i < SAMPLES; i++) /* what the spring's other end went, less its stretch */
        t->known[i] = start + y.v * sample_s(t, i) - cycle_at(&y, start, sample_s(t, i));
}

static void strained(void **state) {
    (void)state;
    refine("strained", draw_strained, 60, 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(drops), cmocka_unit_test(belts),
                                       cmocka_unit_test(strained)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
