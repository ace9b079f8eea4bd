/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion under force elements: against the same forces as plain springs and cables, against pins,
   and the balance of energy. */
#include "quantity/law_kind.h"
#include "element_rigs.h"
#include "effects/element_check.h"

static double size_of(const double *x, int count, int every, int from) {
    double most = 0;
    for (int i = from; i < count; i += every)
        most = fmax(most, fabs(x[i]));
    return most;
}

/* all samples of two motions: positions against a length, angles against 1 rad, velocities against
   the largest of their kind */
static void assert_same(const fw_dynamics_motion *a, const fw_dynamics_motion *b, double length,
                        double tol) {
    int n = 3 * a->nbody, count = a->nsample * n;
    assert_int_equal(a->nsample, b->nsample);
    for (int c = 0; c < 3; c++) {
        double speed = size_of(a->v, count, 3, c);
        if (c < 2) speed = fmax(size_of(a->v, count, 3, 0), size_of(a->v, count, 3, 1));
        for (int i = c; i < count; i += 3) {
            assert_near(a->q[i], b->q[i], tol * (c == 2 ? 1 : length));
            assert_near(a->v[i], b->v[i], tol * speed);
        }
    }
}

static rig six_bar_with_springs(fw_arena *arena) {
    rig r = rig_six_bar(arena, false);
    r.m.spring = fw_arena_array(arena, fw_device_spring, 2);
    r.m.spring[r.m.nspring++] = (fw_device_spring){.id = "CD",
                                                   .body_a = FW_GROUND,
                                                   .body_b = 2,
                                                   .ax_m = 3e-3,
                                                   .ay_m = 4e-3,
                                                   .bx_m = 0.4e-3,
                                                   .by_m = -0.1e-3,
                                                   .stiffness_N_per_m = 0.8,
                                                   .damping_Ns_per_m = 2e-6,
                                                   .length_m = 1.5e-3};
    r.m.spring[r.m.nspring++] = (fw_device_spring){.id = "across",
                                                   .body_a = 1,
                                                   .body_b = 3,
                                                   .ax_m = 0.1e-3,
                                                   .ay_m = 0.2e-3,
                                                   .bx_m = -0.2e-3,
                                                   .by_m = 0.3e-3,
                                                   .stiffness_N_per_m = 0.3,
                                                   .length_m = 1.9e-3};
    return r;
}

/* springs and dampers as elements move the six-bar as the native ones do, by every method. Steps of
   one length, so that both runs make the same ones and only round-off is left */
static void springs_as_elements(void **state) {
    (void)state;
    for (size_t i = 0; fw_multibody_method_at(i).name; i += (size_t)test_cases(1, 4)) {
        fw_arena *arena = fw_arena_new(0);
        const char *method = fw_multibody_method_at(i).name;
        rig r = six_bar_with_springs(arena);
        r.scene.duration_s = 2e-3;
        fw_effects_loads native = rig_terms(arena, &r), own = native;
        line data[2];
        own.nspring = 0;
        for (int k = 0; k < 2; k++) {
            const fw_device_spring *s = &r.m.spring[k];
            data[k] = (line){s->stiffness_N_per_m, s->damping_Ns_per_m, s->length_m, 0, 0};
            line_add(arena, &own, &data[k], s->body_a, s->ax_m, s->ay_m, s->body_b, s->bx_m,
                     s->by_m);
        }
        const fw_dynamics_motion *a = rig_run_by(arena, &r, &native, method, "rk4", 1e-8, 21);
        const fw_dynamics_motion *b = rig_run_by(arena, &r, &own, method, "rk4", 1e-8, 21);
        assert_same(a, b, 3e-3, 1e-12);
        for (int k = 0; k < 2 * 6 * 21; k++)
            assert_near(a->reaction_N[k], b->reaction_N[k], 1e-3 * 1e-11);
        const fw_dynamics_motion *c = rig_run(arena, &r, &own, method, 1e-11, 21);
        assert_same(a, c, 3e-3, 1e-6); /* rk4's own error */
        assert_true(c->stats.energy_error < 1e-9);
        fw_arena_free(arena);
    }
}

/* a mass thrown up from a cable: the cable as a one-sided element, with and without a damper */
static void cable_as_element(void **state) {
    (void)state;
    for (int damped = 0; damped < 2; damped++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 1, 0, 1);
        rig_body(&r, "weight", 1, 1, 0, -2, 0);
        r.m.spring[r.m.nspring++] = (fw_device_spring){.id = "cable",
                                                       .body_a = FW_GROUND,
                                                       .body_b = 0,
                                                       .stiffness_N_per_m = 400,
                                                       .damping_Ns_per_m = damped ? 3 : 0,
                                                       .length_m = 2,
                                                       .bx_m = 0.05,
                                                       .by_m = 0.1,
                                                       .cable = true};
        rig_velocity(&r, 0, 0.3, 3, 0.1);
        r.scene.gravity = true;
        r.scene.gy_m_per_s2 = -10;
        r.scene.duration_s = 3;
        fw_effects_loads native = rig_terms(arena, &r), own = native;
        line data = {400, damped ? 3 : 0, 2, 0, 0};
        own.nspring = 0;
        line_add(arena, &own, &data, FW_GROUND, 0, 0, 0, 0.05, 0.1)->switches = 1;
        const fw_dynamics_motion *a = rig_run(arena, &r, &native, NULL, 1e-11, 31);
        const fw_dynamics_motion *b = rig_run(arena, &r, &own, NULL, 1e-11, 31);
        assert_true(a->stats.events >= 4);
        assert_int_equal(a->stats.events, b->stats.events);
        assert_same(a, b, 2, 1e-10);
        assert_true(b->stats.energy_error < 1e-10);
        fw_arena_free(arena);
    }
}

/* ---- released pins ---- */

/* a bar on a bush at its end, by Runge and Kutta: m x'' = -k dx, J phi'' = r x f - kr phi - cr phi'
 */
static void bar_rate(const bush *d, double m, double j, double l, double g, const double *y,
                     double *f) {
    double c = cos(y[2]), s = sin(y[2]);
    double fx = -d->k * (y[0] - l * c), fy = -d->k * (y[1] - l * s); /* at (-l, 0) of the bar */
    for (int i = 0; i < 3; i++)
        f[i] = y[3 + i];
    f[3] = fx / m, f[4] = fy / m - g;
    f[5] = (-l * c * fy + l * s * fx - d->kr * y[2] - d->cr * y[5]) / j;
}

static void bar_step(const bush *d, double m, double j, double l, double g, double h, double *y) {
    double k[4][6], at[6];
    for (int stage = 0; stage < 4; stage++) {
        double part = stage == 3 ? 1 : stage > 0 ? 0.5 : 0;
        for (int i = 0; i < 6; i++)
            at[i] = y[i] + (stage ? part * h * k[stage - 1][i] : 0);
        bar_rate(d, m, j, l, g, at, k[stage]);
    }
    for (int i = 0; i < 6; i++)
        y[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

static rig rig_bar(fw_arena *arena) {
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "bar", 2, 0.3, 0.5, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig_velocity(&r, 0, 0, 0.7 * 0.5, 0.7);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 1;
    return r;
}

static void bar_on_a_bush(void **state) {
    (void)state;
    const bush d = {900, 4, 0.05};
    double y[6] = {0.5, 0, 0, 0, 0.35, 0.7};
    for (int i = 0; i < 20000; i++)
        bar_step(&d, 2, 0.3, 0.5, 9.81, 1.0 / 20000, y);
    for (size_t i = 0; fw_multibody_method_at(i).name; i++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_bar(arena);
        fw_effects_loads t = rig_terms(arena, &r);
        bush_release(arena, &r.m, &t, 0, &d);
        const fw_dynamics_motion *m =
            rig_run(arena, &r, &t, fw_multibody_method_at(i).name, 1e-12, 2);
        for (int k = 0; k < 3; k++) {
            assert_near(m->q[3 + k], y[k], 1e-11);
            assert_near(m->v[3 + k], y[3 + k], 1e-10);
        }
        /* on body b, in the world: -k times where its end is */
        assert_near(m->reaction_N[2], -d.k * (y[0] - 0.5 * cos(y[2])), 1e-8);
        assert_near(m->reaction_N[3], -d.k * (y[1] - 0.5 * sin(y[2])), 1e-8);
        assert_true(m->stats.energy_error < 1e-11);
        fw_arena_free(arena);
    }
}

/* the six-bar with D and A released, a native spring without length in place of each: the same
   motion, by every method; D then joins nothing, and two chains hang from the ground */
static void released_six_bar(void **state) {
    (void)state;
    const bush d = {40, 1.2e-6, 0}, a = {25, 0, 0};
    for (size_t i = 0; fw_multibody_method_at(i).name; i += (size_t)test_cases(1, 4)) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false), cut = rig_six_bar(arena, false);
        fw_effects_loads own = rig_terms(arena, &r);
        bush_release(arena, &r.m, &own, 3, &d);
        bush_release(arena, &r.m, &own, 0, &a);
        /* the same pins missing altogether */
        cut.m.spring = fw_arena_array(arena, fw_device_spring, 2);
        cut.m.npin = 0;
        for (int k = 0; k < 6; k++) {
            const fw_mechanism_pin *p = &r.m.pin[k];
            if (k != 3 && k != 0)
                cut.m.pin[cut.m.npin++] = *p;
            else
                cut.m.spring[cut.m.nspring++] =
                    (fw_device_spring){.id = p->id,
                                       .body_a = p->body_a,
                                       .body_b = p->body_b,
                                       .ax_m = p->ax_m,
                                       .ay_m = p->ay_m,
                                       .bx_m = p->bx_m,
                                       .by_m = p->by_m,
                                       .stiffness_N_per_m = k == 3 ? d.k : a.k};
        }
        fw_effects_loads native = rig_terms(arena, &cut);
        /* the angles of D: its bodies turn against each other under what the bush has */
        native.element = NULL, native.nelement = 0;
        bush *turn = fw_arena_one(arena, bush);
        turn->kr = d.kr;
        fw_effects_force_element *e = fw_effects_loads_add_element(arena, &native, &bush_class, 2);
        e->port[0] = (fw_effects_port){.body = 2}, e->port[1] = (fw_effects_port){.body = 3};
        e->data = turn;
        const fw_dynamics_motion *x =
            rig_run(arena, &r, &own, fw_multibody_method_at(i).name, 1e-11, 11);
        const fw_dynamics_motion *z = rig_run(arena, &cut, &native, "chain", 1e-11, 11);
        assert_same(x, z, 3e-3, 1e-8);
        assert_true(x->stats.energy_error < 1e-9);
        assert_true(x->stats.max_constraint_norm < 1e-12);
        fw_arena_free(arena);
    }
}

/* the largest force on a released pin is found between the samples, and its error is told */
static void peak_of_a_released_pin(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const bush d = {900, 4, 0.05};
    rig r = rig_bar(arena);
    fw_effects_loads t = rig_terms(arena, &r);
    bush_release(arena, &r.m, &t, 0, &d);
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *m;
    const fw_dynamics_motion_options o = {.rtol = 1e-9, .samples = 4001, .reactions = true};
    assert_int_equal(fw_dynamics_simulate_compiled(arena, &r.m, &r.scene, &o,
                                                   &(fw_effect_ledger){0}, &t, &diags, &m),
                     FW_OK);
    double most = 0, at = 0;
    for (int i = 0; i < m->nsample; i++) {
        double now = hypot(m->reaction_N[2 * i], m->reaction_N[2 * i + 1]);
        if (now > most) most = now, at = m->t_s[i];
    }
    assert_near(m->force_peak[0].force_N, most, 1e-5 * most);
    assert_true(m->force_peak[0].force_N >= most * (1 - 1e-9));
    assert_near(m->force_peak[0].t_s, at, 3e-4);
    assert_true(m->force_peak[0].error_N < 1e-5 * most && m->force_peak[0].error_N > 0);
    fw_arena_free(arena);
}

/* as the bush becomes stiff, the motion tends to that of the pin like 1/k */
static void stiff_bush_is_a_pin(void **state) {
    (void)state;
    double off[3];
    for (int i = 0; i < 3; i++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_bar(arena);
        const bush d = {1e5 * pow(10, i), 4, 0};
        r.m.pin[0].stiffness_Nm_per_rad = 4;
        r.scene.initial[0] = (fw_device_initial){.body = 0};
        r.scene.gravity = false;
        /* 1 - cos(2 pi t): begins without a slope, so that nothing rings above 1/k */
        const fw_quantity_law slow = {.kind = &fw_quantity_law_sine,
                                      .frequency_Hz = 1,
                                      .phase_rad = -asin(1.0),
                                      .end_s = (double)INFINITY};
        r.scene.force = fw_arena_array(arena, fw_device_force, 2);
        rig_force(&r, 0, 0.5, 3);
        rig_force(&r, 0, 0.5, 3);
        r.scene.force[1].law = &slow;
        fw_effects_loads pinned = rig_terms(arena, &r), own = rig_terms(arena, &r);
        bush_release(arena, &r.m, &own, 0, &d);
        const fw_dynamics_motion *a = rig_run(arena, &r, &pinned, NULL, 1e-12, 2);
        const fw_dynamics_motion *b = rig_run(arena, &r, &own, NULL, 1e-12, 2);
        off[i] = fabs(a->q[3 + 2] - b->q[3 + 2]);
        assert_near(a->reaction_N[2], b->reaction_N[2], 300 * fabs(a->reaction_N[2]) / d.k);
        fw_arena_free(arena);
    }
    assert_true(off[0] > 1e-6);
    for (int i = 0; i < 2; i++)
        assert_relative(off[i + 1], off[i] / 10, 0.3);
}

/* velocities start as the pins ask, also where elements stand for them: no stretch rate */
static void start_is_closed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_six_bar(arena, false);
    rig_velocity(&r, 0, 0, 0, -3);
    r.scene.initial[0].moves_free = true;
    r.scene.nforce = r.scene.ntorque = 0;
    r.scene.duration_s = 1e-5;
    fw_effects_loads pinned = rig_terms(arena, &r), own = rig_terms(arena, &r);
    const bush d = {40, 1.5e-6, 0};
    bush_release(arena, &r.m, &own, 3, &d);
    const fw_dynamics_motion *a = rig_run(arena, &r, &pinned, NULL, 1e-10, 1);
    const fw_dynamics_motion *b = rig_run(arena, &r, &own, NULL, 1e-10, 1);
    assert_near(a->v[2], -3, 1e-12);
    for (int i = 0; i < 15; i++)
        assert_near(a->v[i], b->v[i], 1e-12 * (i % 3 == 2 ? 3 : 3e-3));
    fw_arena_free(arena);
}

/* ---- laws, energy, validity ---- */

static const fw_quantity_law *law_any(fw_arena *arena, uint64_t *seed, double duration) {
    fw_quantity_law *law = fw_arena_one(arena, fw_quantity_law);
    switch ((int)(4 * rig_random(seed))) {
    case 0:
        *law = (fw_quantity_law){.kind = &fw_quantity_law_ramp,
                                 .start_s = 0.3 * duration * rig_random(seed),
                                 .rise_s = 0.5 * duration};
        break;
    case 1:
        *law = (fw_quantity_law){.kind = &fw_quantity_law_sine,
                                 .frequency_Hz = (1 + 3 * rig_random(seed)) / duration,
                                 .end_s = (double)INFINITY};
        break;
    case 2: /* jumps */
        *law = (fw_quantity_law){.kind = &fw_quantity_law_step,
                                 .start_s = 0.4 * duration * rig_random(seed),
                                 .end_s = duration * (0.5 + 0.3 * rig_random(seed))};
        break;
    default: {
        double *t = fw_arena_array(arena, double, 4), *f = fw_arena_array(arena, double, 4);
        for (int i = 0; i < 4; i++)
            t[i] = duration * (0.1 + 0.25 * i), f[i] = 2 * rig_random(seed) - 1;
        *law = (fw_quantity_law){
            .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = f, .ntable = 4};
    }
    }
    return law;
}

/* a mass on a line that is drawn by d from t = 0.3 on, at once: x = d (1 - cos w (t - 0.3)) from
   there; or by d (t - 0.3) / 0.4 up to 0.7: the same of the ramp, d/0.4 (s - sin(w s) / w) */
static void laws_are_followed(void **state) {
    (void)state;
    for (int ramp = 0; ramp < 2; ramp++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 1, 0, 0);
        rig_body(&r, "mass", 2, 1, 0, 0, 0);
        r.scene.duration_s = 1;
        fw_effects_loads t = rig_terms(arena, &r);
        const line d = {.k = 800, .draw = 0.1, .length = 5};
        const fw_quantity_law law = {.kind = ramp ? &fw_quantity_law_ramp : &fw_quantity_law_step,
                                     .start_s = 0.3,
                                     .rise_s = 0.4,
                                     .end_s = (double)INFINITY};
        fw_effects_force_element *e = line_add(arena, &t, &d, FW_GROUND, 5, 0, 0, 0, 0);
        e->law[e->laws++] = &law;
        const fw_dynamics_motion *m = rig_run(arena, &r, &t, NULL, 1e-11, 101);
        for (int i = 0; i <= 100; i++) {
            double s = fmax(0, 0.01 * i - 0.3), w = 20, x = 0.1 * (1 - cos(w * s));
            if (ramp) x = 0.1 / 0.4 * (s - sin(w * s) / w);
            if (ramp && s > 0.4) x -= 0.1 / 0.4 * (s - 0.4 - sin(w * (s - 0.4)) / w);
            assert_near(m->q[3 * i], x, 1e-10);
        }
        assert_true(m->stats.energy_error < 1e-10);
        fw_arena_free(arena);
    }
}

/* random mechanisms with drawn, pulled, damped, one-sided lines and bushes in place of pins: what
   is stored, taken and fed in adds up, and switches happen */
static void energies_add_up(void **state) {
    (void)state;
    long events = 0, jumps = 0;
    int count = test_cases(60, 15);
    for (uint64_t seed = 1; seed <= (uint64_t)count; seed++) {
        fw_arena *arena = fw_arena_new(0);
        uint64_t pick = 977 * seed;
        rig r = rig_any(arena, seed);
        fw_effects_loads t = rig_terms(arena, &r);
        line d[3];
        bush b = {20 + 100 * rig_random(&pick), 1e-6, 1e-11};
        for (int i = 0; i < 3; i++) {
            int on = (int)(r.m.nbody * rig_random(&pick));
            double x = r.m.body[on].x_m + 1e-3, y = r.m.body[on].y_m + 1.5e-3;
            d[i] = (line){0.2 * rig_random(&pick), 1e-6 * rig_random(&pick), hypot(1e-3, 1.5e-3),
                          i == 0 ? 4e-4 : 0, i == 1 ? 5e-5 : 0};
            fw_effects_force_element *e = line_add(arena, &t, &d[i], FW_GROUND, x, y, on, 0, 0);
            e->switches = i != 1;
            if (i == 2) continue;
            e->law[e->laws++] = law_any(arena, &pick, r.scene.duration_s);
            jumps += i == 0 && e->law[0]->kind == &fw_quantity_law_step;
        }
        if (seed % 3 == 0) bush_release(arena, &r.m, &t, 1, &b);
        const fw_dynamics_motion *m = rig_run(arena, &r, &t, NULL, 1e-10, 2);
        events += m->stats.events;
        if (!(m->stats.energy_error < 1e-8))
            fail_msg("seed %d: energies are off by %g", (int)seed, m->stats.energy_error);
        fw_arena_free(arena);
    }
    assert_true(events > count);
    assert_true(jumps > count / 12);
}

/* a line whose ends meet is where its formula ends: the run says so, with its words */
static void where_it_ends(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "mass", 1, 1, 1, 0, 0);
    r.scene.duration_s = 10;
    fw_effects_loads t = rig_terms(arena, &r);
    line d = {.pull = 0.1};
    line_add(arena, &t, &d, FW_GROUND, 0, 0, 0, 0, 0)->id = "winch";
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *m;
    const fw_dynamics_motion_options o = {.rtol = 1e-8};
    assert_int_equal(fw_dynamics_simulate_compiled(arena, &r.m, &r.scene, &o,
                                                   &(fw_effect_ledger){0}, &t, &diags, &m),
                     FW_SOLVER);
    assert_int_equal(diags.item[diags.count - 1].number, 242);
    assert_non_null(strstr(diags.item[diags.count - 1].message, "winch"));
    assert_non_null(strstr(diags.item[diags.count - 1].message, "ends of the line meet"));
    r.m.body[0].x_m = 0; /* at the start already */
    diags = fw_diags_new(arena);
    assert_int_equal(fw_dynamics_simulate_compiled(arena, &r.m, &r.scene, &o,
                                                   &(fw_effect_ledger){0}, &t, &diags, &m),
                     FW_SOLVER);
    assert_int_equal(diags.item[diags.count - 1].number, 242);
    fw_arena_free(arena);
}

/* plates that attract each other with C/g^2 */
static void plate_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double *f) {
    double g = s->p[0] - s->p[3];
    memset(f, 0, 6 * sizeof *f);
    f[3] = *(const double *)e->data / (g * g), f[0] = -f[3];
}

static void plate_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double power[2]) {
    double f[6];
    plate_force(e, s, f);
    power[0] = 0, power[1] = f[3] * s->w[3];
}

static bool plate_valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        const char **why) {
    (void)e;
    *why = "the plates touch";
    return s->p[0] - s->p[3] > 1e-3;
}

static const fw_effects_element_class plate_class = {
    .effect = "plate", .force = plate_force, .power = plate_power, .valid = plate_valid};

/* from g = 2 with C = m = 1 they meet after pi s with a speed that grows without bound: every
   integrator gets near enough to see that the formula ends there, and not merely that steps become
   small */
static void runs_into_the_plates(void **state) {
    (void)state;
    static const char *const names[] = {"dop853", "dopri5", "radau5", "generalised-alpha"};
    for (int i = 0; i < 8; i++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 1, 0, 0);
        rig_body(&r, "rotor", 1, 1, 0, 0, 0);
        bool beyond = i % 2;
        r.scene.duration_s = beyond ? 10 : 3.1;
        fw_effects_loads t = rig_terms(arena, &r);
        const double c = 1;
        fw_effects_force_element *e = fw_effects_loads_add_element(arena, &t, &plate_class, 2);
        e->port[0] = (fw_effects_port){FW_GROUND, 2, 0}, e->port[1] = (fw_effects_port){0, 0, 0};
        e->works = true, e->force_N = 0.25, e->data = &c;
        fw_diags diags = fw_diags_new(arena);
        const fw_dynamics_motion *m;
        const fw_dynamics_motion_options o = {.integrator = names[i / 2], .rtol = 1e-7};
        fw_status status = fw_dynamics_simulate_compiled(arena, &r.m, &r.scene, &o,
                                                         &(fw_effect_ledger){0}, &t, &diags, &m);
        assert_int_equal(status, beyond ? FW_SOLVER : FW_OK);
        if (beyond) assert_int_equal(diags.item[diags.count - 1].number, 242);
        fw_arena_free(arena);
    }
}

/* a stiff one-sided element that is slack at the start is seen by the choice of the integrator */
static void open_contact_is_seen(void **state) {
    (void)state;
    const char *chosen[2];
    for (int stiff = 0; stiff < 2; stiff++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_bar(arena);
        r.m.pin[0].stiffness_Nm_per_rad = 40;
        r.scene.gravity = false;
        r.scene.initial[0].omega_rad_per_s = -0.1, r.scene.initial[0].vy_m_per_s = -0.05;
        fw_effects_loads t = rig_terms(arena, &r);
        line d = {.k = stiff ? 1e12 : 1e3, .c = stiff ? 1e7 : 1, .length = 1.2};
        line_add(arena, &t, &d, FW_GROUND, 0.5, -1, 0, 0, 0)->switches = 1;
        t.element[0].size_N_per_m = 1e3; /* the same scales: only the probe can tell */
        const fw_dynamics_motion *m = rig_run(arena, &r, &t, NULL, 1e-6, 2);
        chosen[stiff] = m->integrator;
        assert_int_equal(strstr(m->reason, "once all contacts touch") != NULL, stiff);
        fw_arena_free(arena);
    }
    assert_string_equal(chosen[0], "dop853");
    assert_string_equal(chosen[1], "radau5");
}

/* the classes of this file are what they should be */
static void classes_are_sound(void **state) {
    (void)state;
    uint64_t seed = 3;
    fw_arena *arena = fw_arena_new(0);
    for (int i = 0; i < 100; i++) {
        const line d = {1 + rig_random(&seed), rig_random(&seed), 0.3, rig_random(&seed),
                        rig_random(&seed)};
        const bush b = {1 + rig_random(&seed), rig_random(&seed), rig_random(&seed)};
        fw_effects_loads t = {0};
        double p[6], w[6];
        bool on = true;
        fw_quantity_law sine = {
            .kind = &fw_quantity_law_sine, .frequency_Hz = 0.3, .end_s = (double)INFINITY};
        for (int k = 0; k < 6; k++)
            p[k] = rig_random(&seed) + (k == 3), w[k] = rig_random(&seed) - 0.5;
        fw_effects_port_state s = {
            .t_s = rig_random(&seed), .load = 0.8, .p = p, .w = w, .on = &on};
        s.piece_s = s.t_s;
        fw_effects_force_element *e = line_add(arena, &t, &d, 0, 0, 0, 1, 0, 0);
        e->law[0] = &sine, e->laws = 1, e->switches = 1;
        fw_check_tangent(e, &s, 1e-3, 1e-3, 1e-8);
        fw_check_power(e, &s, 1e-3, 1e-9);
        fw_check_balance(e, &s, 1e-12);
        fw_effects_force_element *f = fw_effects_loads_add_element(arena, &t, &bush_class, 2);
        f->data = &b;
        fw_check_tangent(f, &s, 1e-3, 1e-3, 1e-8);
        fw_check_power(f, &s, 1e-3, 1e-9);
        fw_check_balance(f, &s, 1e-12);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(classes_are_sound),    cmocka_unit_test(springs_as_elements),
        cmocka_unit_test(cable_as_element),     cmocka_unit_test(bar_on_a_bush),
        cmocka_unit_test(released_six_bar),     cmocka_unit_test(peak_of_a_released_pin),
        cmocka_unit_test(stiff_bush_is_a_pin),  cmocka_unit_test(start_is_closed),
        cmocka_unit_test(laws_are_followed),    cmocka_unit_test(energies_add_up),
        cmocka_unit_test(where_it_ends),        cmocka_unit_test(runs_into_the_plates),
        cmocka_unit_test(open_contact_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
