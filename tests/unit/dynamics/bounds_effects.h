/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random elements of the effects for the test of the bounds (bounds.h): one function each. Sizes go
   by what the loads turn the device by (d->turn) and by its lowest frequency (d->omega), so that
   every effect is once much and once next to nothing. */
#ifndef FW_TESTS_BOUNDS_EFFECTS_H
#define FW_TESTS_BOUNDS_EFFECTS_H
#include "quantity/law_kind.h"
#include "bounds_device.h"

static const double bounds_length_m = 1e-3, bounds_mass_kg = 1e-8, bounds_stiffness_Nm = 1e-6;

static inline int bounds_body(const bounds_device *d, uint64_t *seed) {
    return (int)(d->r.m.nbody * rig_random(seed));
}

/* some point of a body, and where it is in the world */
static inline fw_geometry_vec2 bounds_point(uint64_t *seed) {
    return (fw_geometry_vec2){3e-4 * (2 * rig_random(seed) - 1), 3e-4 * (2 * rig_random(seed) - 1)};
}

/* flexures for half of the devices: closed forms only, so that nothing but their spring, their
   material's damping and its softening is asked for */
static inline void bounds_hinges(fw_arena *arena, bounds_device *d) {
    if (d->r.m.nhinge > 0) return;
    d->r.m.hinge = fw_arena_array(arena, fw_mechanism_hinge, (size_t)d->r.m.npin);
    d->r.m.nhinge = d->r.m.npin;
    for (int i = 0; i < d->r.m.npin; i++) {
        d->r.m.hinge[i] = (fw_mechanism_hinge){.pin = i, .axis_rad = (double)NAN, .stated = true};
        d->r.m.pin[i].hinge = i;
    }
}

/* ---- base motion ---- */

static inline const fw_quantity_law *bounds_shake(bounds_device *d, uint64_t *seed) {
    double t = d->r.scene.duration_s, kind = rig_random(seed);
    if (kind < 0.5 || d->laws == BOUNDS_LOADS) return bounds_law(d, seed);
    fw_quantity_law *l = bounds_new_law(d);
    l->start_s = 0.4 * t * rig_random(seed);
    if (kind < 0.75) {
        l->kind = &fw_quantity_law_half_sine;
        l->rise_s = bounds_log(seed, 0.1, 10) / d->omega;
        return l;
    }
    l->kind = &fw_quantity_law_random;
    l->start_s = 0;
    l->lines = 2 + (int)(20 * rig_random(seed));
    l->frequency_Hz = bounds_log(seed, 0.05, 1) * d->omega / 6.28;
    l->frequency_most_Hz = l->frequency_Hz * bounds_log(seed, 1.2, 10);
    l->seed = (unsigned)(1e6 * rig_random(seed));
    return l;
}

static inline void bounds_base_motion(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    int count = 1 + (rig_random(seed) < 0.3);
    d->r.scene.base = fw_arena_array(arena, fw_device_base_motion, 2);
    for (int i = 0; i < count; i++) {
        double a = bounds_log(seed, 1e-5, 1) * d->turn * bounds_stiffness_Nm /
                   (bounds_mass_kg * bounds_length_m);
        double angle = 6.283 * rig_random(seed);
        d->r.scene.base[d->r.scene.nbase++] =
            (fw_device_base_motion){a * cos(angle), a * sin(angle), .law = bounds_shake(d, seed)};
    }
}

/* ---- air ---- */

static inline fw_device_air bounds_gas(uint64_t *seed, fw_device_air_kind kind) {
    return (fw_device_air){
        .kind = kind,
        .against = FW_GROUND,
        .gap_m = bounds_log(seed, 0.5e-6, 50e-6),
        .area_m2 = bounds_log(seed, 1e-9, 1e-6),
        .depth_m = bounds_log(seed, 5e-6, 100e-6),
        .pressure_Pa = rig_random(seed) < 0.5 ? (double)NAN : bounds_log(seed, 1, 3e5),
        .temperature_K = rig_random(seed) < 0.7 ? (double)NAN : bounds_log(seed, 200, 900),
        .viscosity_Pas = rig_random(seed) < 0.7 ? (double)NAN : bounds_log(seed, 1e-6, 1e-3)};
}

static inline void bounds_air(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    int count = 1 + (int)(2 * rig_random(seed));
    d->r.scene.air = fw_arena_array(arena, fw_device_air, 2);
    for (int i = 0; i < count; i++) {
        fw_device_air_kind kind = (fw_device_air_kind)(int)(3 * rig_random(seed));
        fw_device_air a = bounds_gas(seed, kind);
        a.body = rig_random(seed) < 0.4 && kind != FW_AIR_SQUEEZE ? FW_NONE : bounds_body(d, seed);
        if (kind == FW_AIR_SQUEEZE) { /* mostly wider than the motion */
            fw_geometry_vec2 at = bounds_point(seed);
            a.gap_m = bounds_log(seed, 0.3, 30) * d->turn * bounds_length_m;
            a.x_m = at.x, a.y_m = at.y;
            a.direction_rad = 6.283 * rig_random(seed);
            a.length_m = bounds_log(seed, 20e-6, 2e-3);
            if (d->r.m.nbody > 1 && rig_random(seed) < 0.3) a.against = (a.body + 1) % d->r.m.nbody;
        }
        d->r.scene.air[d->r.scene.nair++] = a;
    }
}

/* ---- temperature, stress, damping of the material ---- */

/* a law without jumps; NULL: constant */
static inline const fw_quantity_law *bounds_warming(bounds_device *d, uint64_t *seed) {
    double t = d->r.scene.duration_s;
    if (rig_random(seed) < 0.5 || d->laws == BOUNDS_LOADS) return NULL;
    if (rig_random(seed) < 0.5) return bounds_slow_law(d, seed);
    fw_quantity_law *l = bounds_new_law(d);
    l->kind = rig_random(seed) < 0.5 ? &fw_quantity_law_ramp : &fw_quantity_law_sine;
    l->start_s = rig_random(seed) < 0.5 ? 0 : 0.4 * t * rig_random(seed);
    l->rise_s = bounds_log(seed, 0.01, 1) * t;
    l->frequency_Hz = bounds_log(seed, 0.05, 3) * d->omega / 6.28;
    return l;
}

static inline void bounds_temperature(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    bool law = rig_random(seed) < 0.5;
    if (rig_random(seed) < 0.6) bounds_hinges(arena, d);
    d->r.scene.temperature = fw_arena_array(arena, fw_device_temperature, 1);
    fw_device_temperature *t = &d->r.scene.temperature[d->r.scene.ntemperature++];
    *t = (fw_device_temperature){.change_K = 100,
                                 .expansion_per_K = 2.6e-6,
                                 .substrate_expansion_per_K = 2.6e-6,
                                 .law = law ? bounds_warming(d, seed) : NULL};
    double kind = rig_random(seed);
    if (kind < 0.7) /* another substrate: strain between next to nothing and what turns much */
        t->expansion_per_K +=
            bounds_sign(seed) * fmin(bounds_log(seed, 1e-6, 1) * d->turn, 0.02) / 100;
    if (kind > 0.4) t->modulus_change_per_K = bounds_sign(seed) * bounds_log(seed, 1e-7, 0.3) / 100;
}

static inline void bounds_residual_stress(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    d->variant.thickness_m = 50e-6;
    d->variant.material.youngs = (fw_quantity){.value = 169e9};
    d->variant.material.poisson = (fw_quantity){.value = 0.22};
    d->variant.material.loss = (fw_quantity){.unknown = true};
    d->variant.material.expansion = (fw_quantity){.unknown = true};
    d->variant.material.modulus_change = (fw_quantity){.unknown = true};
    d->r.m.variant = &d->variant;
    d->r.scene.stress = fw_arena_array(arena, fw_device_residual_stress, 1);
    double strain = fmin(bounds_log(seed, 1e-6, 0.3) * d->turn, 0.01), rise = 0;
    if (rig_random(seed) < 0.5) rise = bounds_log(seed, 1e-4, 0.2); /* kappa times 1 mm */
    d->r.scene.stress[d->r.scene.nstress++] = (fw_device_residual_stress){
        .mean_Pa = bounds_sign(seed) * strain * 169e9 / 0.78,
        .gradient_Pa_per_m = bounds_sign(seed) * rise / bounds_length_m * 169e9 / 0.78};
}

static inline void bounds_material_damping(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    bounds_hinges(arena, d);
    d->r.scene.damping = fw_arena_array(arena, fw_device_material_damping, 1);
    d->r.scene.damping[d->r.scene.ndamping++] = (fw_device_material_damping){
        .loss_factor = bounds_log(seed, 1e-6, 0.3),
        .frequency_Hz =
            rig_random(seed) < 0.5 ? (double)NAN : d->omega / 6.28 * bounds_log(seed, 0.2, 5)};
}

/* ---- what drives ---- */

static inline fw_device_eyelet bounds_eyelet(const bounds_device *d, uint64_t *seed, bool ground) {
    fw_geometry_vec2 at = bounds_point(seed);
    if (!ground) return (fw_device_eyelet){.body = bounds_body(d, seed), .x_m = at.x, .y_m = at.y};
    return (fw_device_eyelet){.body = FW_GROUND, .x_m = 1e-3 + 6 * at.x, .y_m = 1e-3 + 6 * at.y};
}

static inline void bounds_tendon(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    d->r.scene.tendon = fw_arena_array(arena, fw_device_tendon, 1);
    fw_device_tendon *t = &d->r.scene.tendon[d->r.scene.ntendon++];
    double share = bounds_log(seed, 0.01, 1) * d->turn;
    *t = (fw_device_tendon){.id = "tendon", .pull_N = (double)NAN, .draw_m = (double)NAN};
    t->neyelet = 2 + (rig_random(seed) < 0.4);
    t->eyelet = fw_arena_array(arena, fw_device_eyelet, 3);
    t->eyelet[0] = bounds_eyelet(d, seed, false);
    t->eyelet[1] = bounds_eyelet(d, seed, t->neyelet == 2 || rig_random(seed) < 0.5);
    t->eyelet[2] = bounds_eyelet(d, seed, true);
    if (rig_random(seed) < 0.5) {
        t->pull_N = share * bounds_stiffness_Nm / bounds_length_m;
        if (rig_random(seed) < 0.4) t->law = bounds_law(d, seed);
        return;
    }
    t->draw_m = share * bounds_length_m;
    t->stiffness_N_per_m = bounds_log(seed, 1e-4, 10);
    t->damping_Ns_per_m = rig_random(seed) < 0.5 ? 0 : 0.1 * t->stiffness_N_per_m / d->omega;
    t->slack_m = (rig_random(seed) - 0.5) * t->draw_m;
    if (rig_random(seed) < 0.4) t->slack_m = -t->draw_m * bounds_log(seed, 1, 30); /* taut */
    t->law = bounds_law(d, seed);
}

/* wide enough for the motion, mostly; soft is the stiffness that the voltage takes */
static inline void bounds_comb_drive(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    d->r.scene.comb = fw_arena_array(arena, fw_device_comb, 1);
    fw_device_comb *b = &d->r.scene.comb[d->r.scene.ncomb++];
    double gap = bounds_log(seed, 1, 30) * d->turn * bounds_length_m;
    double soft =
        bounds_log(seed, 1e-4, 0.7) * bounds_stiffness_Nm / bounds_length_m / bounds_length_m;
    fw_geometry_vec2 at = bounds_point(seed);
    *b = (fw_device_comb){.id = "comb",
                          .kind = rig_random(seed) < 0.5 ? FW_ELECTRODES_COMB : FW_ELECTRODES_PLATE,
                          .body_a = FW_GROUND,
                          .body_b = bounds_body(d, seed),
                          .bx_m = at.x,
                          .by_m = at.y,
                          .direction_rad = 6.283 * rig_random(seed),
                          .gap_m = gap,
                          .depth_m = 50e-6};
    b->length_m = bounds_log(seed, 2, 20) * gap;
    double face = 8.854e-12 * b->depth_m * b->length_m;
    if (b->kind == FW_ELECTRODES_COMB) {
        b->fingers = 1 + (int)(20 * rig_random(seed));
        b->overlap_m = 0.5 * b->length_m;
        face *= b->fingers;
    }
    b->voltage_V = sqrt(soft * gap * gap * gap / face);
    b->law = bounds_law(d, seed);
}

/* ---- what touches and rubs ---- */

static inline void bounds_contact(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    d->r.scene.contact = fw_arena_array(arena, fw_device_contact_use, 1);
    fw_device_contact_use *u = &d->r.scene.contact[d->r.scene.ncontact++];
    fw_geometry_vec2 at = bounds_point(seed), away = bounds_point(seed);
    int body = bounds_body(d, seed);
    fw_geometry_vec2 world = fw_mechanism_local_place(&d->r.m, body, at.x, at.y);
    double room = bounds_log(seed, 0.2, 30) * d->turn * bounds_length_m;
    *u = (fw_device_contact_use){.id = "touch",
                                 .joint = FW_NONE,
                                 .body_a = FW_GROUND,
                                 .body_b = body,
                                 .ax_m = world.x + away.x,
                                 .ay_m = world.y + away.y,
                                 .bx_m = at.x,
                                 .by_m = at.y,
                                 .stiffness_N_per_m = bounds_log(seed, 1, 100),
                                 .damping_Ns_per_m = rig_random(seed) < 0.5 ? 0 : 1e-5};
    double now = hypot(away.x, away.y);
    u->side = rig_random(seed) < 0.5 ? FW_CONTACT_INSIDE : FW_CONTACT_OUTSIDE;
    u->distance_m = u->side == FW_CONTACT_INSIDE ? now + room : now - fmin(room, 0.9 * now);
}

/* one joint to three, slides too; a joint twice has twice the friction */
static inline void bounds_friction(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    int count = 1 + (int)(3 * rig_random(seed));
    d->r.scene.friction = fw_arena_array(arena, fw_device_friction_use, 3);
    for (int i = 0; i < count; i++) {
        bool slides = d->r.m.njoint > 0 && d->r.m.joint[0].kind == FW_JOINT_PRISMATIC;
        slides = slides && rig_random(seed) < 0.4;
        int joint = (int)(d->r.m.npin * rig_random(seed));
        d->r.scene.friction[d->r.scene.nfriction++] = (fw_device_friction_use){
            .revolute = slides ? FW_NONE : joint,
            .joint = slides ? 0 : FW_NONE,
            .coefficient = bounds_log(seed, slides ? 1e-6 : 1e-3, slides ? 1e-2 : 0.3),
            .static_coefficient = (double)NAN,
            .radius_m = bounds_log(seed, 1e-6, 1e-4),
            .preload_N = rig_random(seed) < 0.5 ? 0 : 1e-3 * d->turn};
    }
}

#endif
