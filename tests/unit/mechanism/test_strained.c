/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mechanisms whose bodies and ground have become longer. */
#include "mechanism/mechanism.h"
#include "test.h"

enum { BODIES = 3, PINS = 4 };

static double number(uint64_t *seed) { /* in [-1, 1) */
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return 2 * ((double)(*seed >> 11) * 0x1p-53) - 1;
}

typedef struct toy {
    fw_mechanism_mass body[BODIES];
    fw_mechanism_pin pin[PINS];
    fw_device_joint joint[1];
    fw_device_spring spring[1];
    fw_mechanism m;
} toy;

static void toy_new(toy *t, uint64_t seed) {
    *t = (toy){.m = {.nbody = BODIES, .npin = PINS, .njoint = 1, .nspring = 1}};
    t->m.body = t->body, t->m.pin = t->pin, t->m.joint = t->joint, t->m.spring = t->spring;
    for (int i = 0; i < BODIES; i++)
        t->body[i] =
            (fw_mechanism_mass){"b", 1, 1, number(&seed), number(&seed), number(&seed), {0, 0}};
    for (int i = 0; i < PINS; i++)
        t->pin[i] = (fw_mechanism_pin){.body_a = i - 1,
                                       .body_b = i < BODIES ? i : FW_GROUND,
                                       .ax_m = number(&seed),
                                       .ay_m = number(&seed),
                                       .bx_m = number(&seed),
                                       .by_m = number(&seed),
                                       .free_angle_rad = number(&seed),
                                       .stiffness_Nm_per_rad = 3};
    t->joint[0] = (fw_device_joint){.kind = FW_JOINT_DISTANCE,
                                    .body_a = 2,
                                    .body_b = FW_GROUND,
                                    .ax_m = number(&seed),
                                    .by_m = number(&seed),
                                    .length_m = 2};
    t->spring[0] = (fw_device_spring){
        .body_a = FW_GROUND, .body_b = 1, .ax_m = number(&seed), .by_m = 0.5, .length_m = 0.7};
}

/* nothing changes without strain, and what is given stays as it is */
static void no_strain_is_identity(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double none[BODIES + 1] = {0};
    for (uint64_t seed = 1; seed < 20; seed++) {
        toy t, kept;
        const fw_mechanism *s;
        toy_new(&t, seed);
        kept = t;
        assert_int_equal(fw_mechanism_strained(arena, &t.m, none, &s), FW_OK);
        assert_memory_equal(s->pin, t.pin, sizeof t.pin);
        assert_memory_equal(s->joint, t.joint, sizeof t.joint);
        assert_memory_equal(s->spring, t.spring, sizeof t.spring);
        const double some[BODIES + 1] = {0.1, -0.2, 0.3, 0.4};
        assert_int_equal(fw_mechanism_strained(arena, &t.m, some, &s), FW_OK);
        assert_memory_equal(&kept.pin, &t.pin, sizeof t.pin);
        assert_true(s->body == t.body && s->pin != t.pin);
    }
    fw_arena_free(arena);
}

/* one strain for all: every distance in a body, and between points of the ground, grows by it; the
   mean of the ground's points stays; angles, rest lengths and stiffnesses do too */
static void distances_grow(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (uint64_t seed = 1; seed < 20; seed++) {
        toy t;
        const fw_mechanism *s;
        const double e = 0.01 * (double)seed, all[BODIES + 1] = {e, e, e, e};
        toy_new(&t, seed);
        assert_int_equal(fw_mechanism_strained(arena, &t.m, all, &s), FW_OK);
        for (int i = 0; i < BODIES; i++) { /* pin i on its body b, pin i + 1 on its body a */
            const fw_mechanism_pin *p = &t.pin[i], *q = &t.pin[i + 1], *ps = &s->pin[i],
                                   *qs = &s->pin[i + 1];
            assert_relative(hypot(qs->ax_m - ps->bx_m, qs->ay_m - ps->by_m),
                            (1 + e) * hypot(q->ax_m - p->bx_m, q->ay_m - p->by_m), 1e-14);
        }
        const double before[3][2] = {{t.pin[0].ax_m, t.pin[0].ay_m},
                                     {t.pin[3].bx_m, t.pin[3].by_m},
                                     {t.joint[0].bx_m, t.joint[0].by_m}};
        const double after[3][2] = {{s->pin[0].ax_m, s->pin[0].ay_m},
                                    {s->pin[3].bx_m, s->pin[3].by_m},
                                    {s->joint[0].bx_m, s->joint[0].by_m}};
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++)
                assert_near(after[i][k] - after[(i + 1) % 3][k],
                            (1 + e) * (before[i][k] - before[(i + 1) % 3][k]), 1e-14);
        fw_geometry_vec2 c = fw_mechanism_ground_centre(&t.m), d = fw_mechanism_ground_centre(s);
        assert_near(c.x, (before[0][0] + before[1][0] + before[2][0] + t.spring[0].ax_m) / 4,
                    1e-15);
        assert_near(d.x, c.x, 1e-15);
        assert_near(d.y, c.y, 1e-15);
        assert_true(s->joint[0].length_m == 2 && s->spring[0].length_m == 0.7);
        assert_true(s->pin[2].free_angle_rad == t.pin[2].free_angle_rad);
        assert_true(s->pin[2].stiffness_Nm_per_rad == 3);
    }
    fw_arena_free(arena);
}

/* there and back again */
static void strains_undo_each_other(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double there[BODIES + 1] = {0.1, -0.2, 0.3, 0.25},
                                back[BODIES + 1] = {1 / 1.1 - 1, 1 / 0.8 - 1, 1 / 1.3 - 1,
                                                    1 / 1.25 - 1};
    toy t;
    const fw_mechanism *a, *b;
    toy_new(&t, 5);
    assert_int_equal(fw_mechanism_strained(arena, &t.m, there, &a), FW_OK);
    assert_int_equal(fw_mechanism_strained(arena, a, back, &b), FW_OK);
    for (int i = 0; i < PINS; i++) {
        assert_near(b->pin[i].ax_m, t.pin[i].ax_m, 1e-15);
        assert_near(b->pin[i].by_m, t.pin[i].by_m, 1e-15);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_strain_is_identity),
                                       cmocka_unit_test(distances_grow),
                                       cmocka_unit_test(strains_undo_each_other)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
