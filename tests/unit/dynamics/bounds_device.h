/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random devices and loads for the test of the bounds (bounds.h). */
#ifndef FW_TESTS_BOUNDS_DEVICE_H
#define FW_TESTS_BOUNDS_DEVICE_H
#include "quantity/law_kind.h"
#include "models.h"
#include <stdio.h>
#include <stdlib.h>

enum { BOUNDS_LOADS = 24 };

typedef struct bounds_device {
    rig r;
    double turn;  /* rad: wanted of the static response to the loads */
    double omega; /* rad/s: about the lowest */
    fw_quantity_law law[BOUNDS_LOADS];
    double table_t[BOUNDS_LOADS][4], table_v[BOUNDS_LOADS][4];
    int laws;
    bool slow; /* the loads come slowly against the lowest mode */
    fw_mechanism_variant variant;
} bounds_device;

/* from a to b, evenly in its logarithm */
static inline double bounds_log(uint64_t *seed, double a, double b) {
    return a * pow(b / a, rig_random(seed));
}

static inline double bounds_sign(uint64_t *seed) {
    return rig_random(seed) < 0.5 ? -1 : 1;
}

/* ---- devices ---- */

static inline rig bounds_six_bar(fw_arena *arena, uint64_t *seed) {
    rig r = rig_six_bar(arena, false);
    for (int i = 0; i < r.m.npin; i++) {
        r.m.pin[i].stiffness_Nm_per_rad *= bounds_log(seed, 0.3, 3);
        r.m.pin[i].damping_Nms_per_rad = 0;
    }
    for (int b = 0; b < r.m.nbody; b++) {
        double f = bounds_log(seed, 0.5, 2);
        r.m.body[b].mass_kg *= f, r.m.body[b].inertia_kg_m2 *= f;
    }
    r.scene.nforce = r.scene.ntorque = 0;
    return r;
}

/* n bodies in a row from the ground, closed at the end or not */
static inline rig bounds_row(fw_arena *arena, uint64_t *seed, int n, bool closed) {
    rig r = rig_new(arena, n, n + 1, 1);
    double x = 0, y = 0, angle = 1.5 * rig_random(seed);
    for (int i = 0; i < n; i++) {
        double l = 1e-3 * bounds_log(seed, 0.5, 2), m = 1e-8 * bounds_log(seed, 0.3, 3);
        double dx = l * cos(angle), dy = l * sin(angle);
        rig_body(&r, "link", m, m * l * l * (0.06 + 0.1 * rig_random(seed)), x + dx / 2, y + dy / 2,
                 0.5 * rig_random(seed));
        rig_pin(&r, "pin", i - 1, i, x, y, 1e-6 * bounds_log(seed, 0.3, 3), 0);
        x += dx, y += dy;
        angle -= closed ? 0.6 + 1.2 * rig_random(seed) : rig_random(seed) - 0.5;
    }
    if (closed) rig_pin(&r, "end", n - 1, FW_GROUND, x, y, 1e-6 * bounds_log(seed, 0.3, 3), 0);
    return r;
}

static inline rig bounds_four_bar(fw_arena *arena, uint64_t *seed) {
    return bounds_row(arena, seed, 3, true);
}

static inline rig bounds_chain(fw_arena *arena, uint64_t *seed) {
    return bounds_row(arena, seed, 1 + (int)(5 * rig_random(seed)), false);
}

/* a chain whose end slides on the ground, with a spring along or a point spring */
static inline rig bounds_slider(fw_arena *arena, uint64_t *seed) {
    rig r = bounds_row(arena, seed, 2, false);
    fw_mechanism_mass *last = &r.m.body[1];
    r.m.joint = fw_arena_array(arena, fw_device_joint, 1);
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "slide",
                                                .kind = FW_JOINT_DISTANCE,
                                                .body_a = FW_GROUND,
                                                .body_b = 1,
                                                .ax_m = last->x_m + 1e-3 * (0.5 + rig_random(seed)),
                                                .ay_m = last->y_m - 1e-3 * rig_random(seed)};
    r.m.joint[0].length_m = hypot(r.m.joint[0].ax_m - last->x_m, r.m.joint[0].ay_m - last->y_m);
    if (rig_random(seed) < 0.5) return r;
    /* prismatic: a third body between the chain's end and the ground */
    rig p = bounds_row(arena, seed, 3, false);
    double axis = 0.7 * rig_random(seed);
    p.m.joint = r.m.joint;
    p.m.njoint = 1;
    p.m.joint[0] = (fw_device_joint){.id = "slide",
                                     .kind = FW_JOINT_PRISMATIC,
                                     .body_a = FW_GROUND,
                                     .body_b = 2,
                                     .ax_m = p.m.body[2].x_m,
                                     .ay_m = p.m.body[2].y_m,
                                     .axis_rad = axis,
                                     .angle_rad = p.m.body[2].phi_rad,
                                     .stiffness_N_per_m = bounds_log(seed, 0.1, 10)};
    return p;
}

static rig (*const bounds_devices[])(fw_arena *, uint64_t *) = {bounds_six_bar, bounds_four_bar,
                                                                bounds_chain, bounds_slider};

/* ---- loads ---- */

static inline void bounds_table_law(bounds_device *d, uint64_t *seed, fw_quantity_law *l) {
    double *at = d->table_t[d->laws - 1], *value = d->table_v[d->laws - 1];
    l->kind = &fw_quantity_law_table;
    l->ntable = 4;
    l->table_t_s = at, l->table_value = value;
    for (int i = 0; i < 4; i++) {
        at[i] = d->r.scene.duration_s * (i + 0.8 * rig_random(seed)) / 4;
        value[i] = 2 * rig_random(seed) - 1;
    }
}

static inline fw_quantity_law *bounds_new_law(bounds_device *d) {
    fw_quantity_law *l = &d->law[d->laws++];
    *l = (fw_quantity_law){.kind = &fw_quantity_law_step, .end_s = (double)INFINITY};
    return l;
}

/* continuous from 0 on, over a good part of the scene */
static inline const fw_quantity_law *bounds_slow_law(bounds_device *d, uint64_t *seed) {
    double t = d->r.scene.duration_s, kind = rig_random(seed);
    if (d->laws == BOUNDS_LOADS) return NULL;
    fw_quantity_law *l = bounds_new_law(d);
    l->start_s = rig_random(seed) < 0.5 ? 0 : 0.3 * t * rig_random(seed);
    if (kind < 0.4) {
        l->kind = &fw_quantity_law_ramp;
        l->rise_s = bounds_log(seed, 0.1, 1.5) * t;
    } else if (kind < 0.65) {
        l->kind = &fw_quantity_law_sine;
        l->frequency_Hz = bounds_log(seed, 0.2, 3) / t;
    } else if (kind < 0.8) {
        l->kind = &fw_quantity_law_half_sine;
        l->rise_s = bounds_log(seed, 0.2, 1) * t;
    } else {
        bounds_table_law(d, seed, l);
        d->table_t[d->laws - 1][0] = 0, d->table_v[d->laws - 1][0] = 0;
    }
    return l;
}

/* of all kinds; NULL: constant */
static inline const fw_quantity_law *bounds_law(bounds_device *d, uint64_t *seed) {
    double t = d->r.scene.duration_s, kind = rig_random(seed);
    if (d->slow) return bounds_slow_law(d, seed);
    if (kind < 0.4 || d->laws == BOUNDS_LOADS) return NULL;
    fw_quantity_law *l = bounds_new_law(d);
    l->start_s = rig_random(seed) < 0.5 ? 0 : 0.4 * t * rig_random(seed);
    if (kind < 0.55) {
        if (rig_random(seed) < 0.5) l->end_s = l->start_s + 0.5 * t * rig_random(seed);
    } else if (kind < 0.7) {
        l->kind = &fw_quantity_law_ramp;
        l->rise_s = bounds_log(seed, 0.01, 2) * t;
    } else if (kind < 0.85) {
        l->kind = &fw_quantity_law_sine;
        l->frequency_Hz = bounds_log(seed, 0.1, 3) * d->omega / 6.28;
        l->phase_rad = 3 * rig_random(seed);
    } else
        bounds_table_law(d, seed, l);
    return l;
}

static inline void bounds_add_loads(bounds_device *d, uint64_t *seed) {
    rig *r = &d->r;
    int count = 1 + (int)(3 * rig_random(seed));
    for (int i = 0; i < count; i++) {
        int b = (int)(r->m.nbody * rig_random(seed));
        if (rig_random(seed) < 0.5 && r->scene.ntorque < r->m.nbody) {
            rig_torque(r, b, bounds_sign(seed) * bounds_log(seed, 0.1, 1));
            r->scene.torque[r->scene.ntorque - 1].law = bounds_law(d, seed);
        } else if (r->scene.nforce < r->m.nbody) {
            rig_force(r, b, 1e3 * (2 * rig_random(seed) - 1), 1e3 * (2 * rig_random(seed) - 1));
            fw_device_force *f = &r->scene.force[r->scene.nforce - 1];
            f->law = bounds_law(d, seed);
            if (rig_random(seed) < 0.5) f->x_m = 5e-4 * (2 * rig_random(seed) - 1);
        }
    }
}

static inline double bounds_static(fw_arena *arena, const rig *r, double *omega) {
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    fw_diags diags = fw_diags_new(arena);
    const fw_effect_choice choice = {.mode = FW_EFFECTS_NONE};
    double force[60], u[60], turn[40], most = 0, work = 0, mass = 0;
    bool valid;
    assert_int_equal(
        fw_effects_compile(arena, &r->m, &r->scene, &choice, 1e-3, &diags, &ledger, &loads), FW_OK);
    fw_effects_loads_largest_force(&r->m, &loads, r->scene.duration_s, force);
    assert_int_equal(fw_effects_static_response(arena, &r->m, &loads, force, u, turn, &valid),
                     FW_OK);
    for (int i = 0; i < r->m.npin && valid; i++)
        most = fmax(most, fabs(turn[i]));
    for (int i = 0; i < 3 * r->m.nbody && valid; i++) {
        const fw_mechanism_mass *b = &r->m.body[i / 3];
        work += force[i] * u[i];
        mass += (i % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * u[i] * u[i];
    }
    *omega = work > 0 ? sqrt(work / mass) : 0;
    return most;
}

/* the loads so that the static response to the largest of them turns some pin by d->turn */
static inline bool bounds_scale_loads(fw_arena *arena, bounds_device *d) {
    double turn = bounds_static(arena, &d->r, &d->omega);
    if (!(turn > 0) || !(d->omega > 0)) return false;
    fw_device_scene *s = &d->r.scene;
    for (int i = 0; i < s->nforce; i++)
        s->force[i].fx_N *= d->turn / turn, s->force[i].fy_N *= d->turn / turn;
    for (int i = 0; i < s->ntorque; i++)
        s->torque[i].value_Nm *= d->turn / turn;
    return true;
}

#endif
