/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force elements on the model: forces, energies and powers fit each other in scaled units, far-away
   coordinates cost no digits, switches are counted through, released pins are no blocks. */
#include "effects/effect.h"
#include "multibody/kernel.h"
#include "multibody/systems.h"

/* ---- a class with everything: k s + c l' between the first and the last port, a couple kr on the
   turn of the first two, and load pull t along the line; acts while s > 0 ---- */

typedef struct all {
    double k, c, kr, pull, length;
} all;

typedef struct now {
    double ux, uy, l, rate;
} now;

static now now_of(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const double *p = s->p, *w = s->w;
    int b = 3 * (e->ports - 1);
    now n = {p[b] - p[0], p[b + 1] - p[1], 0, 0};
    n.l = hypot(n.ux, n.uy);
    n.ux /= n.l, n.uy /= n.l;
    n.rate = n.ux * (w[b] - w[0]) + n.uy * (w[b + 1] - w[1]);
    return n;
}

static void all_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                      double *f) {
    const all *d = e->data;
    now n = now_of(e, s);
    int b = 3 * (e->ports - 1);
    double t = s->load * d->pull * s->t_s;
    if (s->on[0]) t += d->k * (n.l - d->length) + d->c * n.rate;
    for (int i = 0; i < 3 * e->ports; i++)
        f[i] = 0;
    f[0] = t * n.ux, f[1] = t * n.uy, f[b] = -t * n.ux, f[b + 1] = -t * n.uy;
    f[2] += d->kr * (s->p[5] - s->p[2]);
    f[5] -= d->kr * (s->p[5] - s->p[2]);
}

static double all_energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const all *d = e->data;
    double g = now_of(e, s).l - d->length, turn = s->p[5] - s->p[2];
    return (s->on[0] ? 0.5 * d->k * g * g : 0) + 0.5 * d->kr * turn * turn;
}

static void all_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                      double power[2]) {
    const all *d = e->data;
    double rate = now_of(e, s).rate;
    power[0] = s->on[0] ? d->c * rate * rate : 0;
    power[1] = -s->load * d->pull * s->t_s * rate;
}

static double all_switch(const fw_effects_force_element *e, const fw_effects_port_state *s, int i) {
    const all *d = e->data;
    return i == 0 ? now_of(e, s).l - d->length : s->t_s - 1;
}

static const fw_effects_element_class all_class = {.effect = "all",
                                                   .force = all_force,
                                                   .energy = all_energy,
                                                   .power = all_power,
                                                   .switch_value = all_switch};

/* ---- plants ---- */

enum { BODIES = 4, ELEMENTS = 3 };

typedef struct plant {
    rig r;
    fw_effects_loads loads;
    all data[ELEMENTS];
    fw_multibody_system *sys;
    const fw_multibody_model *m;
} plant;

static double grid(uint64_t *seed) { /* multiples of 2^-20, so that a shift is exact */
    return floor(rig_random(seed) * 0x1p20) * 0x1p-20 - 0.5;
}

static void plant_new(fw_arena *arena, uint64_t seed, double far, bool released, plant *p) {
    *p = (plant){.r = rig_new(arena, BODIES, BODIES, 1)};
    for (int b = 0; b < BODIES; b++) {
        double mass = 0.5 + rig_random(&seed), inertia = 0.1 + rig_random(&seed);
        double x = grid(&seed) + far;
        rig_body(&p->r, "body", mass, inertia, x, grid(&seed), 3 * grid(&seed));
    }
    for (int i = 0; i < BODIES; i++) {
        double ax = grid(&seed) + (i ? 0 : far);
        rig_pin_local(&p->r, "pin", i - 1, ax, grid(&seed), i, grid(&seed), grid(&seed));
    }
    p->r.scene.duration_s = 4;
    assert_int_equal(fw_effects_loads_new(arena, &p->r.m, &p->r.scene, &p->loads), FW_OK);
    fw_effects_loads *t = &p->loads;
    assert_int_equal(t->nspring, 0); /* of the mechanism: there is room for no more */
    t->spring = fw_arena_array(arena, fw_device_spring, 1);
    t->spring[t->nspring++] = (fw_device_spring){.body_a = FW_GROUND,
                                                 .body_b = 2,
                                                 .ax_m = far,
                                                 .ay_m = 2,
                                                 .stiffness_N_per_m = 1,
                                                 .length_m = 1,
                                                 .cable = true};
    for (int i = 0; i < ELEMENTS; i++) {
        p->data[i] = (all){1 + rig_random(&seed), rig_random(&seed), rig_random(&seed),
                           rig_random(&seed), 0.2 + rig_random(&seed)};
        fw_effects_force_element *e =
            fw_effects_loads_add_element(arena, t, &all_class, 2 + (i == 1));
        for (int k = 0; k < e->ports; k++)
            e->port[k] = (fw_effects_port){(i + k) % BODIES, grid(&seed), grid(&seed)};
        if (i == 2) e->port[0] = (fw_effects_port){FW_GROUND, grid(&seed) + far, grid(&seed)};
        e->switches = i == 0 ? 2 : 1;
        e->dissipates = e->works = true;
        e->size_N_per_m = p->data[i].k;
        e->data = &p->data[i];
    }
    if (released) t->released[2] = true, t->nreleased = 1, t->element[1].pin = 2;
    p->sys = rig_system_with(arena, &p->r.m, t, 4, NULL);
    p->m = p->sys->model;
    p->sys->piece_s = 2;
}

static void state_any(uint64_t *seed, double *y, int count) {
    for (int i = 0; i < count; i++)
        y[i] = rig_random(seed) - 0.5;
}

/* Q . v = -dE/dt - taken + fed, dE/dt along u + v t by differences of order 6; all in the model's
   units, so that units are right too. The cable's part is in E. */
static void powers_fit(void **state) {
    (void)state;
    static const double weight[7] = {-1, 9, -45, 0, 45, -9, 1};
    for (uint64_t seed = 1; seed <= 40; seed++) {
        fw_arena *arena = fw_arena_new(0);
        uint64_t pick = 31 * seed;
        plant p;
        plant_new(arena, seed, 0, seed % 2, &p);
        fw_multibody_system *sys = p.sys;
        const fw_multibody_model *m = p.m;
        int n = m->nq;
        double y[64] = {0}, z[64] = {0}, t = 1.5 / m->scale.time_s, h = 1e-3, given = 0, rate = 0;
        double power[2], size = 0;
        state_any(&pick, y, 2 * n);
        const fw_multibody_pose *pose = fw_multibody_set_switches(sys, t, y);
        const double *accel = fw_multibody_forces(sys, pose, y + n)->accel;
        fw_multibody_power(sys, pose, y + n, power);
        for (int i = 0; i < n; i++) {
            double part = y[n + i] * accel[i] * (i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]);
            given += part, size += fabs(part);
        }
        for (int k = 0; k < 7; k++) {
            for (int i = 0; i < n; i++)
                z[i] = y[i] + (k - 3) * h * y[n + i];
            rate += weight[k] / (60 * h) * fw_multibody_energy_at(sys, t, z).elastic;
        }
        assert_near(given, -rate - power[0] + power[1], 1e-9 * (1 + size));
        fw_arena_free(arena);
    }
}

/* 1024 m away: the same accelerations to round-off of the mechanism's own size */
static void far_away_costs_nothing(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        fw_arena *arena = fw_arena_new(0);
        plant near, far;
        plant_new(arena, seed, 0, true, &near);
        plant_new(arena, seed, 1024, true, &far);
        uint64_t pick = seed;
        double y[64] = {0}, a[2][64];
        int n = near.m->nq;
        state_any(&pick, y, 2 * n);
        fw_multibody_system *both[2] = {near.sys, far.sys};
        for (int i = 0; i < 2; i++) {
            const fw_multibody_pose *pose = fw_multibody_set_switches(both[i], 1, y);
            const double *accel = fw_multibody_forces(both[i], pose, y + n)->accel;
            memcpy(a[i], accel, (size_t)n * sizeof *accel);
        }
        for (int i = 0; i < n; i++)
            assert_near(a[1][i], a[0][i], 1e-12 * (1 + fabs(a[0][i])));
        fw_arena_free(arena);
    }
}

/* cables first, then elements; one by one and all at once; a flip loses what is stored */
static void switches_are_counted_through(void **state) {
    (void)state;
    int on = 0;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        fw_arena *arena = fw_arena_new(0);
        plant p;
        plant_new(arena, seed, 0, false, &p);
        fw_multibody_system *sys = p.sys;
        const fw_multibody_model *m = p.m;
        uint64_t pick = 5 * seed;
        double y[64] = {0}, value[5], t = 2 * rig_random(&pick) / m->scale.time_s;
        state_any(&pick, y, 2 * m->nq);
        assert_int_equal(fw_multibody_switch_count(m), 5);
        const fw_multibody_pose *pose = fw_multibody_set_switches(sys, t, y);
        const double *v = y + m->nq;
        const bool *elements = sys->on.element; /* two of the first, one of each other */
        fw_multibody_switch_values(sys, pose, v, value);
        for (int i = 0; i < 5; i++) {
            assert_near(value[i], fw_multibody_switch_value(sys, pose, i, v), 0);
            assert_int_equal(fw_multibody_switch_on(sys, i), value[i] > 0);
            on += value[i] > 0;
        }
        assert_int_equal(elements[0], value[1] > 0);
        assert_int_equal(elements[1], t * m->scale.time_s > 1);
        assert_int_equal(elements[m->element[2].first_switch], value[4] > 0);
        double before = fw_multibody_energy_at(sys, t, y).elastic;
        fw_multibody_flip(sys, t, 4, y);
        double after = fw_multibody_energy_at(sys, t, y).elastic;
        assert_int_equal(elements[3], !(value[4] > 0));
        assert_near(y[m->dissipated], before - after, 1e-13 * (1 + before));
        assert_true(value[4] > 0 ? before > after : before < after);
        fw_arena_free(arena);
    }
    assert_true(on > 40 && on < 110);
}

/* no block, no fast path, and its reaction is the element's force on its last port */
static void released_pins_are_no_blocks(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    plant with, without;
    plant_new(arena, 7, 0, true, &with);
    plant_new(arena, 7, 0, false, &without);
    assert_int_equal(without.m->nblock, 4);
    assert_int_equal(with.m->nblock, 3);
    assert_int_equal(with.m->rows, 6);
    assert_int_equal(with.m->pin_block[2], FW_NONE);
    assert_false(fw_multibody_core_plain(with.m));
    double y[64] = {0}, f[64], reaction[8];
    uint64_t pick = 3;
    state_any(&pick, y, 2 * with.m->nq);
    fw_multibody_set_switches(with.sys, 1, y);
    const fw_multibody_solution *found = fw_multibody_react(with.sys, 1, y, f);
    fw_multibody_pin_forces(with.m, found, reaction);
    for (int k = 0; k < 2; k++) {
        assert_near(reaction[4 + k], found->element[3 * with.m->element[1].first_port + 6 + k], 0);
        assert_true(reaction[4 + k] != 0);
        int block = with.m->pin_block[3];
        assert_near(reaction[6 + k], fw_multibody_newton(with.m) * found->lambda[2 * block + k], 0);
    }
    fw_arena_free(arena);
}

/* what `minimal` makes of pieces that hang on nothing but elements */
static void minimal_places_loose_bodies(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_six_bar(arena, false);
    fw_effects_loads t;
    assert_int_equal(fw_effects_loads_new(arena, &r.m, &r.scene, &t), FW_OK);
    static const struct {
        int pins[3];
        const char *report;
    } cases[] = {
        {{3, -1, -1}, "independent coordinates: AB.phi, BC.phi, CD.phi, EF.phi, DE.phi; 0 dyads"},
        {{1, 4, -1}, "independent coordinates: AB.phi, EF.phi, BC.x, BC.y, BC.phi, CD.phi, DE.phi"},
        {{0, 5, -1}, "independent coordinates: AB.x, AB.y, AB.phi, BC.phi, CD.phi, DE.phi, EF.phi"},
    };
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        memset(t.released, 0, 6 * sizeof *t.released);
        for (int i = 0; i < 3 && cases[c].pins[i] >= 0; i++)
            t.released[cases[c].pins[i]] = true;
        fw_multibody_system *sys =
            rig_system_with(arena, &r.m, &t, 1, fw_multibody_method_find("minimal"));
        fw_text text = fw_text_new(arena);
        assert_int_equal(fw_multibody_method_find("minimal")->report(sys, &r.m, &text), FW_OK);
        if (!strstr(text.data, cases[c].report)) fail_msg("%s", text.data);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_fit),
        cmocka_unit_test(far_away_costs_nothing),
        cmocka_unit_test(switches_are_counted_through),
        cmocka_unit_test(released_pins_are_no_blocks),
        cmocka_unit_test(minimal_places_loose_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
