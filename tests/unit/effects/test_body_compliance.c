/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What acts on slender parts of bodies: the laws of every element, and series of elastic parts in closed form. */
#include "element_check.h"
#include "hinge_rigs.h"

static const double nan_ = (double)NAN;

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

/* a bar of 1 mm in any direction, whose end goes by `m_per_N` across it */
static void arm_of(double m_per_N, double turn_rad, fw_mechanism_give *to) {
    const double length = 1e-3, x = cos(turn_rad), y = sin(turn_rad), along = m_per_N / 400;
    const double c[9] = {3 * m_per_N / (length * length),
                         -1.5 * m_per_N / length * y,
                         1.5 * m_per_N / length * x,
                         0,
                         along * x * x + m_per_N * y * y,
                         (along - m_per_N) * x * y,
                         0,
                         0,
                         along * y * y + m_per_N * x * x};
    for (int i = 0; i < 9; i++)
        to->c[i] = i / 3 > i % 3 ? c[3 * (i % 3) + i / 3] : c[i];
}

enum { CONTACT, FACE, CABLE, SPRING, ROPE, KINDS };
static const fw_device_eyelet eyelets[3] = {{.body = FW_GROUND, .x_m = -1e-3, .y_m = 0.2e-3},
                                            {.body = 0, .x_m = 0.2e-3, .y_m = 0.1e-3},
                                            {.body = FW_GROUND, .x_m = 1e-3, .y_m = -0.4e-3}};

typedef struct acted {
    rig r;
    fw_device_contact_use contact;
    fw_device_tendon tendon;
    fw_device_spring spring;
    fw_mechanism_give give;
    const fw_effects_force_element *e;
} acted;

/* what acts on the end of a lever, stiffness 1 kN/m, damping 0.02 N s/m where it is damped */
static void act(acted *a, int kind, bool damped) {
    const double k = 1e3, c = damped ? 0.02 : 0;
    rig *r = &a->r;
    rig_new(r, 1, 1);
    r->body[0] = (fw_mechanism_mass){"lever", 1e-8, 1e-15, 1e-4, 2e-4, 0, {0, 0}};
    rig_hinge(r, 0, "H", FW_GROUND, 0, (fw_geometry_vec2){1e-4, 2e-4}, 0, true);
    a->give.body = 0, a->give.x_m = 0.2e-3, a->give.y_m = 0.1e-3;
    r->m.give = &a->give, r->m.ngive = 1;
    a->contact = (fw_device_contact_use){.id = "it",
                                         .joint = FW_NONE,
                                         .side = FW_CONTACT_OUTSIDE,
                                         .face = kind == FACE,
                                         .face_rad = 0.3,
                                         .body_a = 0,
                                         .ax_m = 0.2e-3,
                                         .ay_m = 0.1e-3,
                                         .body_b = FW_GROUND,
                                         .bx_m = 0.4e-3,
                                         .by_m = 0.5e-3,
                                         .distance_m = 230e-6,
                                         .stiffness_N_per_m = k,
                                         .damping_Ns_per_m = c};
    a->tendon = (fw_device_tendon){.id = "it",
                                   .eyelet = (fw_device_eyelet *)eyelets,
                                   .neyelet = 3,
                                   .pull_N = nan_,
                                   .draw_m = 5e-6,
                                   .stiffness_N_per_m = k,
                                   .damping_Ns_per_m = c};
    a->spring = (fw_device_spring){.id = "it",
                                   .body_a = 0,
                                   .ax_m = 0.2e-3,
                                   .ay_m = 0.1e-3,
                                   .body_b = FW_GROUND,
                                   .bx_m = 0.4e-3,
                                   .by_m = 0.9e-3,
                                   .length_m = 0.6e-3,
                                   .stiffness_N_per_m = k,
                                   .damping_Ns_per_m = c,
                                   .cable = kind == ROPE};
    if (kind == CONTACT || kind == FACE) r->scene.contact = &a->contact, r->scene.ncontact = 1;
    if (kind == CABLE) r->scene.tendon = &a->tendon, r->scene.ntendon = 1;
    if (kind == SPRING || kind == ROPE) r->m.spring = &a->spring, r->m.nspring = 1;
    rig_compile(r);
    if (r->scene.ncontact) assert_int_equal(fw_effect_contact.add(&r->c, &r->loads), FW_OK);
    if (r->scene.ntendon) assert_int_equal(fw_effect_tendon.add(&r->c, &r->loads), FW_OK);
    if (r->m.nspring) assert_int_equal(fw_effect_point_spring.add(&r->c, &r->loads), FW_OK);
    assert_true(fw_effect_body_compliance.called_for(&r->c));
    assert_int_equal(fw_effect_body_compliance.add(&r->c, &r->loads), FW_OK);
    assert_int_equal(r->loads.nspring, 0);
    a->e = &r->loads.element[r->loads.nelement - 1];
}

/* the place of its ports, off by some of a micrometre and turned, moving */
static void random_state(unsigned *seed, const acted *a, double *p, double *w) {
    double q[3] = {1e-4, 2e-4, 0};
    fw_effects_element_place_ports(a->e, q, NULL, p, w);
    for (int k = 0; k < 3 * a->e->ports; k++) {
        p[k] += (k % 3 == 2 ? 0.3 : 2e-5) * random_(seed);
        w[k] = (k % 3 == 2 ? 300 : 4e-2) * random_(seed);
    }
}

/* arms a hundredth to ten times as soft as what acts on them; a face on softer ones may turn into what it presses */
static void element_laws(void **state) {
    (void)state;
    unsigned seed = 11;
    for (int kind = 0; kind < KINDS; kind++)
        for (int i = 0; i < 40; i++) {
            acted a;
            arm_of(1e-5 * pow(10, i % 4), 3 * random_(&seed), &a.give);
            act(&a, kind, i % 2);
            double p[9], w[9], still[9] = {0};
            random_state(&seed, &a, p, w);
            const bool on = true;
            fw_effects_port_state s = {.t_s = 1e-4, .piece_s = 1e-4, .load = 1, .p = p, .w = w, .on = &on};
            fw_check_power(a.e, &s, 1e-9, 2e-5);
            fw_check_balance(a.e, &s, 1e-9);
            s.w = still;
            fw_check_tangent(a.e, &s, 2e-8, 1e-3, 2e-5);
            fw_arena_free(a.r.arena);
        }
}

/* pressed straight: 1/(1/k + c), and nothing where it does not touch */
static void series(void **state) {
    (void)state;
    for (int kind = CONTACT; kind <= ROPE; kind++) {
        if (kind == CABLE) continue; /* it turns where it is pulled: element_laws */
        acted a;
        memset(&a, 0, sizeof a);
        for (int i = 4; i < 9; i += 4)
            a.give.c[i] = 2e-3; /* alike in x and y: 2 mm/N beside 1 mm/N */
        act(&a, kind, false);
        double p[9], w[9] = {0}, q[3] = {1e-4, 2e-4, 0}, f[9], own[9];
        fw_effects_element_place_ports(a.e, q, NULL, p, w);
        const double ways[] = {-60e-6, 20e-6};
        for (int k = 0; k < 2; k++) { /* along the line of the two ports, or the normal of the face */
            const double x = p[3] - p[0], y = p[4] - p[1], far = hypot(x, y), face = 0.3;
            const double ux = kind == FACE ? cos(face) : x / far, uy = kind == FACE ? sin(face) : y / far;
            double at[9];
            memcpy(at, p, sizeof at);
            const double length = kind == FACE ? x * ux + y * uy : far,
                         rest = kind < CABLE ? 230e-6 : 0.6e-3, wanted = rest + ways[k];
            at[0] += (length - wanted) * ux, at[1] += (length - wanted) * uy;
            bool on = false;
            fw_effects_port_state s = {.load = 1, .p = at, .w = w, .on = &on, .still = true};
            for (int j = 0; j < a.e->switches; j++)
                on = a.e->class_->switch_value(a.e, &s, j) > 0;
            a.e->class_->force(a.e, &s, f);
            own[0] = f[0] * ux + f[1] * uy;
            double expected = 1e3 / 3 * ways[k];
            if (kind < CABLE && ways[k] > 0) expected = 0;
            if (kind == ROPE && ways[k] < 0) expected = 0;
            assert_true(fabs(own[0] - expected) <= 1e-9 * 1e3 * 60e-6);
        }
        fw_arena_free(a.r.arena);
    }
}

/* What damps lets go where nothing presses the body any more, and takes hold where it is touched. Judged by what presses the end
   of the arm alone it let go of two thirds of the force, took hold again at once, and a motion did not get on */
static void lets_go_of_nothing(void **state) {
    (void)state;
    for (int kind = CONTACT; kind <= ROPE; kind++) {
        if (kind == CABLE || kind == SPRING) continue; /* a cable turns where it is pulled; a spring has no switch */
        acted a;
        memset(&a, 0, sizeof a);
        for (int i = 4; i < 9; i += 4)
            a.give.c[i] = 2e-3;
        act(&a, kind, true);
        double p[9], q[3] = {1e-4, 2e-4, 0}, f[9], none[9] = {0};
        bool on = true;
        fw_effects_element_place_ports(a.e, q, NULL, p, f);
        const double x = p[3] - p[0], y = p[4] - p[1], far = hypot(x, y), face = 0.3, past = kind < CABLE ? -60e-6 : 60e-6;
        const double ux = kind == FACE ? cos(face) : x / far, uy = kind == FACE ? sin(face) : y / far;
        const double off = (kind == FACE ? x * ux + y * uy : far) - (kind < CABLE ? 230e-6 : 0.6e-3) - past;
        p[0] += off * ux, p[1] += off * uy;
        double slow = 0, fast = past < 0 ? -1e2 : 1e2; /* leaving, m/s */
        for (int i = 0; i < 200; i++) {
            const double half = 0.5 * (slow + fast), w[9] = {half * ux, half * uy};
            fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &on};
            *(a.e->class_->switch_value(a.e, &s, 0) > 0 ? &slow : &fast) = half;
        }
        const double w[9] = {slow * ux, slow * uy}, back[9] = {-slow * ux, -slow * uy};
        fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = &on};
        a.e->class_->force(a.e, &s, f);
        assert_true(fabs(slow) > 1e-3 && fabs(slow) < 50);
        assert_true(hypot(f[0], f[1]) < 1e-6 * 1e3 / 3 * 60e-6);
        if (a.e->class_->pressing) assert_true(a.e->class_->pressing(a.e, &s) < 1e-6 * 1e3 / 3 * 60e-6);
        s.w = none;
        const double elastic = a.e->class_->switch_value(a.e, &s, 0);
        s.w = back; /* taken hold of by where it is, however fast it comes */
        assert_true(fabs(a.e->class_->switch_value(a.e, &s, 0) - elastic) < 1e-9 * elastic);
        fw_arena_free(a.r.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(element_laws), cmocka_unit_test(series),
                                       cmocka_unit_test(lets_go_of_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
