/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two bodies and the ground for elements of actuators: compiled from a scene as the program does
   it, then asked at random states. */
#ifndef FW_TESTS_DRIVE_RIG_H
#define FW_TESTS_DRIVE_RIG_H
#include "effects/effects.h"
#include "element_check.h"
#include "test.h"

enum { RIG_BODIES = 3, RIG_PORTS = 6 };

typedef struct rig {
    fw_arena *arena;
    fw_diags diags;
    fw_mechanism_mass body[RIG_BODIES];
    fw_mechanism_variant variant;
    fw_mechanism m;
    fw_device_scene scene;
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    fw_effects_force_element *e; /* the first */
    uint64_t random;
} rig;

static inline double rig_random(rig *r) { /* in (-1, 1), splitmix64 */
    uint64_t z = (r->random += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return 2 * (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0 - 1;
}

static inline void rig_new(rig *r, uint64_t seed) {
    memset(r, 0, sizeof *r);
    r->arena = fw_arena_new(0);
    r->diags = fw_diags_new(r->arena);
    r->random = seed;
    r->body[0] = (fw_mechanism_mass){"first", 2e-8, 3e-15, 1e-3, 0.2e-3, 0.3, {0, 0}};
    r->body[1] = (fw_mechanism_mass){"second", 1e-8, 2e-15, -0.4e-3, 0.9e-3, -1.1, {0, 0}};
    r->body[2] = (fw_mechanism_mass){"third", 1e-8, 2e-15, 0.4e-3, -0.9e-3, 0, {0, 0}};
    r->variant.thickness_m = 50e-6;
    r->m = (fw_mechanism){.body = r->body, .nbody = RIG_BODIES, .variant = &r->variant};
    r->scene = (fw_device_scene){.name = "s", .duration_s = 1e-3};
}

static inline void rig_compile(rig *r) {
    const fw_effect_choice choice = {.mode = FW_EFFECTS_AUTO};
    assert_int_equal(fw_effects_compile(r->arena, &r->m, &r->scene, &choice, 1e-3, &r->diags,
                                        &r->ledger, &r->loads),
                     FW_OK);
    assert_true(r->loads.nelement > 0);
    r->e = &r->loads.element[0];
}

static inline void rig_pose(const rig *r, double *q) {
    for (int b = 0; b < RIG_BODIES; b++)
        q[3 * b] = r->body[b].x_m, q[3 * b + 1] = r->body[b].y_m, q[3 * b + 2] = r->body[b].phi_rad;
}

/* a state away from the drawn pose: points by up to `way`, turns by `turn`, velocities such that a
   millisecond moves as far */
static inline void rig_state(rig *r, double way, double turn, double *p, double *w) {
    double q[3 * RIG_BODIES], v[3 * RIG_BODIES];
    rig_pose(r, q);
    for (int i = 0; i < 3 * RIG_BODIES; i++) {
        double size = i % 3 == 2 ? turn : way;
        q[i] += size * rig_random(r);
        v[i] = 1e3 * size * rig_random(r);
    }
    fw_effects_element_place_ports(r->e, q, v, p, w);
}

#endif
