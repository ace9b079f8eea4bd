/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motions as rows of equilibria: closed forms, the load path of statics, the full motion under slow
   loads, and where the row ends. */
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include "rest_rigs.h"

static const double pi = 3.14159265358979323846;

static const fw_dynamics_motion *row_of(fixture *f, const rig *r,
                                        const fw_dynamics_motion_options *o, const char **why) {
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    const char *unused;
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    const fw_dynamics_motion *m = NULL;
    assert_int_equal(
        fw_effects_compile(f->arena, &r->m, &r->scene, &all, 1e-3, &f->diags, &ledger, &loads),
        FW_OK);
    fw_status status = fw_statics_quasi_static_motion(f->arena, &r->m, &r->scene, o, &ledger,
                                                      &loads, &f->diags, &m, why ? why : &unused);
    assert_int_equal(status, m ? FW_OK : FW_SOLVER);
    return m;
}

static const fw_dynamics_motion *full_motion(fixture *f, const rig *r,
                                             const fw_dynamics_motion_options *o) {
    const fw_dynamics_motion *m = NULL;
    assert_int_equal(fw_dynamics_simulate(f->arena, &r->m, &r->scene, o, &f->diags, &m), FW_OK);
    return m;
}

/* every load of the rig follows the law */
static void put_law(rig *r, const fw_quantity_law *law) {
    for (int i = 0; i < r->scene.nforce; i++)
        r->scene.force[i].law = law;
    for (int i = 0; i < r->scene.ntorque; i++)
        r->scene.torque[i].law = law;
}

/* a lever, torque T sin(w t), spring k: theta = T/k sin, and its derivatives */
static void lever(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 1, 0);
    rig_body(&r, "lever", 2, 0.3, 0.7, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 5, 0);
    rig_torque(&r, 0, 2);
    const fw_quantity_law law = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 0.6};
    double w = 2 * pi * 0.6;
    put_law(&r, &law);
    r.scene.duration_s = 3;
    const fw_dynamics_motion_options o = {.samples = 101, .reactions = true, .accuracy = 1e-4};
    const fw_dynamics_motion *m = row_of(&f, &r, &o, NULL);
    assert_non_null(m);
    for (int i = 0; i < m->nsample; i++) {
        double t = 3 * i / 100.0, turn = 0.4 * sin(w * t);
        assert_near(m->t_s[i], t, 1e-12);
        assert_near(m->q[3 * i + 2], turn, 1e-9);
        assert_near(m->q[3 * i], 0.7 * cos(turn), 1e-9);
        assert_near(m->v[3 * i + 2], 0.4 * w * cos(w * t), 1e-8);
        assert_near(m->accel[3 * i + 2], -0.4 * w * w * sin(w * t), 2e-3 * 0.4 * w * w);
    }
    assert_near(fabs(m->peak[0].angle_rad), 0.4, 1e-9);
    assert_true(m->peak[0].error_rad > 0 && m->peak[0].error_rad < 1e-4 * 0.4);
    assert_near(fabs(sin(w * m->peak[0].t_s)), 1, 1e-6);
    assert_near(m->force_peak[0].force_N, 0, 1e-9);
    assert_string_equal(m->method, "quasi-static");
    fw_arena_free(f.arena);
}

/* a ramp over the whole scene is the load path of statics */
static void ramp_is_the_load_path(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 2};
    put_law(&r, &ramp);
    r.scene.duration_s = 2;
    const fw_dynamics_motion_options o = {.samples = 5, .reactions = true};
    const fw_dynamics_motion *m = row_of(&f, &r, &o, NULL);
    assert_non_null(m);
    for (int i = 0; i < 5; i++) {
        rig part = rig_six_bar(f.arena, false);
        const fw_statics *s = NULL;
        const fw_statics_static_options so = {0};
        part.scene.force[0].fx_N *= i / 4.0, part.scene.force[0].fy_N *= i / 4.0;
        part.scene.torque[0].value_Nm *= i / 4.0;
        assert_int_equal(fw_statics_solve(f.arena, &part.m, &part.scene, &so, &f.diags, &s), FW_OK);
        for (int k = 0; k < 15; k++)
            assert_near(m->q[15 * i + k], s->q[k], k % 3 == 2 ? 1e-8 : 1e-11);
        for (int k = 0; k < 12; k++)
            assert_near(m->reaction_N[12 * i + k], s->reaction_N[k], 1e-10);
        for (int k = 0; k < 6 && i == 4; k++) {
            assert_true(fabs(m->peak[k].angle_rad) >= fabs(s->angle_rad[k]) - 1e-9);
            double force = hypot(s->reaction_N[2 * k], s->reaction_N[2 * k + 1]);
            assert_true(m->force_peak[k].force_N >= force - 1e-10);
        }
    }
    fw_arena_free(f.arena);
}

/* v by differences of q, accel by differences of v, over pieces of different kinds */
static void rates(void **state) {
    (void)state;
    fixture f = begin();
    for (uint64_t seed = 1; seed < 12; seed++) {
        rig r = rig_any(f.arena, seed);
        const fw_quantity_law law = {.kind = &fw_quantity_law_sine,
                                     .end_s = (double)INFINITY,
                                     .frequency_Hz = 1,
                                     .phase_rad = 0.3};
        put_law(&r, &law);
        r.scene.duration_s = 0.7;
        const fw_dynamics_motion_options o = {.samples = 701, .accuracy = 1e-5};
        const fw_dynamics_motion *m = row_of(&f, &r, &o, NULL);
        if (!m) continue; /* loads of this rig may buckle it */
        int n = 3 * m->nbody;
        for (int c = 0; c < n; c++) {
            double speed = 0, change = 0;
            for (int i = 0; i < m->nsample; i++) {
                speed = fmax(speed, fabs(m->v[i * n + c]));
                change = fmax(change, fabs(m->accel[i * n + c]));
            }
            for (int i = 2; i + 2 < m->nsample; i += 7) {
                const double *q = m->q + i * n + c, *v = m->v + i * n + c;
                double dq = (8 * (q[n] - q[-n]) - (q[2 * n] - q[-2 * n])) / 12e-3;
                double dv = (8 * (v[n] - v[-n]) - (v[2 * n] - v[-2 * n])) / 12e-3;
                assert_near(v[0], dq, 1e-6 * speed + 1e-12);
                assert_near(m->accel[i * n + c], dv, 2e-3 * change + 1e-9);
            }
        }
    }
    fw_arena_free(f.arena);
}

/* slow ramp and slow sine, on the six-bar and on a four-bar with springs: the full motion peaks
   where the row does, within the slope over the frequency */
static void agrees_with_the_full_motion(void **state) {
    (void)state;
    fixture f = begin();
    for (int which = 0; which < 4; which++) {
        rig r = which % 2 ? rig_windows(f.arena, 1) : rig_six_bar(f.arena, false);
        if (which % 2) { /* a four-bar with springs */
            r.scene.gravity = false, r.scene.ninitial = 0;
            for (int i = 0; i < r.m.npin; i++)
                r.m.pin[i].stiffness_Nm_per_rad = 30 + 5 * i;
            rig_torque(&r, 0, 12);
        }
        double slow = which % 2 ? 60 : 0.2;
        const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 0.8 * slow};
        const fw_quantity_law sine = {
            .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 1.2 / slow};
        put_law(&r, which < 2 ? &ramp : &sine);
        r.scene.duration_s = slow;
        const fw_dynamics_motion_options o = {.samples = 0};
        const fw_dynamics_motion *at_rest = row_of(&f, &r, &o, NULL),
                                 *full = full_motion(&f, &r, &o);
        assert_non_null(at_rest);
        double most = 0;
        for (int i = 0; i < r.m.npin; i++)
            most = fmax(most, fabs(full->peak[i].angle_rad));
        for (int i = 0; i < r.m.npin; i++) {
            double off = fabs(fabs(full->peak[i].angle_rad) - fabs(at_rest->peak[i].angle_rad));
            assert_true(off < 2e-2 * most); /* the slope that a load starts with: 1.3 % */
        }
        assert_true(at_rest->stats.steps < full->stats.rhs);
        fw_arena_free(f.arena);
        f = begin();
    }
    fw_arena_free(f.arena);
}

typedef struct seen {
    long count, starts;
    double last, largest;
    bool ordered;
} seen;

static void look(void *context, const fw_dynamics_instant *now) {
    seen *s = context;
    if (!now) {
        *s = (seen){.starts = s->starts + 1, .ordered = true};
        return;
    }
    s->ordered = s->ordered && now->t_s >= s->last;
    s->last = now->t_s;
    s->largest = fmax(s->largest, fabs(now->angle_rad[0]));
    s->count++;
}

/* loads that jump, the observer, and a run that is ended */
static void jumps_and_watching(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_quantity_law step = {.kind = &fw_quantity_law_step, .start_s = 0.3, .end_s = 0.6};
    put_law(&r, &step);
    r.scene.duration_s = 1;
    seen s = {0};
    fw_dynamics_motion_options o = {
        .samples = 11, .observe = look, .context = &s, .reactions = true};
    const fw_dynamics_motion *m = row_of(&f, &r, &o, NULL);
    assert_non_null(m);
    assert_true(s.starts == 1 && s.ordered && s.count > 3 * FW_INSTANTS);
    assert_near(s.last, 1, 1e-12);
    assert_near(s.largest, fabs(m->peak[0].angle_rad), 1e-9);
    assert_true(fabs(m->angle_rad[0]) < 1e-12 && fabs(m->angle_rad[6 * 9]) < 1e-9);
    assert_near(m->angle_rad[6 * 5], m->peak[0].angle_rad, 1e-9);
    assert_true(m->peak[0].t_s >= 0.3 && m->peak[0].t_s <= 0.6);
    assert_true(m->force_peak[0].force_N > 0 && m->force_peak[0].t_s <= 0.6);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 1};
    put_law(&r, &ramp);
    o.most_angle_rad = 0.5 * s.largest;
    m = row_of(&f, &r, &o, NULL);
    assert_non_null(m);
    assert_true(m->ended && m->end_s < 0.9 && m->nsample < 11);
    fw_arena_free(f.arena);
}

/* a crank that a driver turns, coupled by a spring to a lever: the driver's way is followed */
static void driven(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 2, 2, 0);
    rig_body(&r, "crank", 1, 0.1, 0.5, 0, 0);
    rig_body(&r, "rod", 1, 0.1, 1.5, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 3, 0);
    rig_pin(&r, "A", 0, 1, 1, 0, 4, 0);
    rig_force(&r, 1, 0, 2); /* at the rod's middle: 4 a = 2 * 0.5 cos(phi + a) */
    r.m.driver = fw_arena_array(f.arena, fw_device_driver, 1);
    r.m.ndriver = 1;
    r.m.driver[0] = (fw_device_driver){.id = "turn", .revolute = 0, .joint = FW_NONE};
    r.m.driver[0].law = (fw_quantity_law){.kind = &fw_quantity_law_ramp, .rise_s = 2};
    r.scene.duration_s = 2;
    const fw_dynamics_motion_options o = {.samples = 9, .reactions = true};
    const fw_dynamics_motion *m = row_of(&f, &r, &o, NULL);
    assert_non_null(m);
    for (int i = 0; i < 9; i++) {
        double phi = i / 8.0, a = m->angle_rad[2 * i + 1];
        assert_near(m->angle_rad[2 * i], phi, 1e-9);
        assert_near(4 * a, cos(phi + a), 1e-8);
        assert_near(m->v[6 * i + 2], 0.5, 1e-8);
        /* the driver holds what the springs and the force ask for */
        assert_near(fabs(m->driver_N[i]), fabs(3 * phi - 2 * (cos(phi) + 0.5 * cos(phi + a))),
                    1e-8);
    }
    assert_near(m->peak[0].angle_rad, 1, 1e-9);
    fw_arena_free(f.arena);
}

/* the row ends at the fold of a shallow truss and where nothing holds: said, and then integrated */
static void where_it_ends(void **state) {
    (void)state;
    fixture f = begin();
    double fold = truss_load(1, 0.3, 100, truss_fold(1, 0.3));
    rig r = rig_truss(&f, 1, 0.3, 100, 1.2 * fold);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 50};
    put_law(&r, &ramp);
    r.scene.duration_s = 50;
    const char *why = NULL;
    const fw_dynamics_motion_options o = {.samples = 3};
    assert_null(row_of(&f, &r, &o, &why));
    assert_non_null(strstr(why, "ends"));
    r.scene.force[0].fy_N *= 0.8 / 1.2;
    assert_non_null(row_of(&f, &r, &o, &why));
    rig loose = rig_pendulum(f.arena);
    loose.scene.gravity = false;
    rig_torque(&loose, 0, 1);
    assert_null(row_of(&f, &loose, &o, &why));
    assert_non_null(why);
    fw_arena_free(f.arena);
}

/* without a bound inertia acts, and a scene is moved as before */
static void moved(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_dynamics_motion_options o = {.samples = 7, .effects = {.mode = FW_EFFECTS_ALL}};
    const fw_dynamics_motion *a = NULL, *b = full_motion(&f, &r, &o);
    assert_int_equal(fw_statics_move_scene(f.arena, &r.m, &r.scene, &o, &f.diags, &a), FW_OK);
    for (int i = 0; i < 7 * 15; i++)
        assert_true(a->q[i] == b->q[i]);
    assert_string_equal(a->method, "chain");
    const fw_dynamics_motion_options wrong = {.method = "chian"};
    assert_int_equal(fw_statics_move_scene(f.arena, &r.m, &r.scene, &wrong, &f.diags, &a),
                     FW_USAGE);
    fw_arena_free(f.arena);
}

static const fw_dynamics_motion *move(fixture *f, const rig *r,
                                      const fw_dynamics_motion_options *o) {
    const fw_dynamics_motion *m = NULL;
    assert_int_equal(fw_statics_move_scene(f->arena, &r->m, &r->scene, o, &f->diags, &m), FW_OK);
    return m;
}

static const fw_effect_entry *inertia(const fw_dynamics_motion *m) {
    for (int i = 0; i < m->ledger.count; i++)
        if (strcmp(m->ledger.item[i].id, "inertia") == 0) return &m->ledger.item[i];
    fail_msg("no inertia");
    return NULL;
}

/* auto leaves inertia out of a slow scene, within its bound; not where integration was asked for */
static void left_out_by_itself(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 0.5};
    put_law(&r, &ramp);
    r.scene.force[0].fx_N *= 0.1, r.scene.force[0].fy_N *= 0.1, r.scene.ntorque = 0;
    r.scene.duration_s = 0.7;
    const fw_dynamics_motion_options o = {.samples = 2, .accuracy = 2e-2};
    fw_dynamics_motion_options named = o, all = o;
    named.integrator = "dop853", all.effects.mode = FW_EFFECTS_ALL;
    all.accuracy = 1e-5; /* what its own steps miss is not what inertia does */
    const fw_dynamics_motion *row = move(&f, &r, &o), *full = move(&f, &r, &all);
    assert_string_equal(row->method, "quasi-static");
    assert_false(inertia(row)->active);
    assert_true(row->ledger.left_out >= inertia(row)->bound && row->ledger.left_out < 2e-2);
    double most = 0, apart = 0;
    for (int i = 0; i < r.m.npin; i++) {
        most = fmax(most, fabs(full->peak[i].angle_rad));
        apart = fmax(apart, fabs(fabs(full->peak[i].angle_rad) - fabs(row->peak[i].angle_rad)));
    }
    assert_true(apart > 0 && apart <= inertia(row)->bound * most);
    double out = row->ledger.left_out, largest = 0; /* every peak's error knows of it, once */
    for (int i = 0; i < r.m.npin; i++)
        largest = fmax(largest, fabs(row->peak[i].angle_rad));
    assert_relative(fw_dynamics_motion_left_out(row), out / (1 - out) * largest, 1e-12);
    for (int i = 0; i < r.m.npin; i++) {
        assert_true(row->peak[i].error_rad > fw_dynamics_motion_left_out(row));
        assert_true(row->peak[i].error_rad < 1.5 * fw_dynamics_motion_left_out(row));
    }
    assert_true(fw_dynamics_motion_left_out(full) == 0);
    for (int i = 0; i < row->ledger.count; i++) /* the same six-bar has dampers */
        if (strcmp(row->ledger.item[i].id, "joint-damping") == 0)
            assert_false(row->ledger.item[i].active);
    row = move(&f, &r, &named);
    assert_string_equal(row->method, "chain");
    assert_true(inertia(row)->active && row->ledger.left_out < inertia(row)->bound);
    assert_non_null(strstr(inertia(row)->reason, "integrator"));
    fw_arena_free(f.arena);
}

/* none: a row where there is one, with a word on what it may cost; else the full motion */
static void left_out_by_hand(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_dynamics_motion_options none = {.samples = 2, .effects = {.mode = FW_EFFECTS_NONE}};
    assert_string_equal(move(&f, &r, &none)->method, "quasi-static"); /* a step */
    assert_true(said(&f, 254));
    fw_diags quiet = fw_diags_new(f.arena);
    f.diags = quiet;
    double fold = truss_load(1, 0.3, 100, truss_fold(1, 0.3));
    rig truss = rig_truss(&f, 1, 0.3, 100, 1.2 * fold);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 5};
    put_law(&truss, &ramp);
    truss.scene.duration_s = 5;
    const fw_dynamics_motion *m = move(&f, &truss, &none);
    assert_string_equal(m->integrator, "dop853");
    assert_true(inertia(m)->active && said(&f, 254));
    assert_non_null(strstr(inertia(m)->reason, "ends"));
    rig swing = rig_pendulum(f.arena);
    rig_velocity(&swing, 0, 0, 0, 1);
    swing.scene.duration_s = 0.1;
    m = move(&f, &swing, &none);
    assert_string_equal(m->method, "chain");
    assert_non_null(strstr(inertia(m)->reason, "velocities"));
    fw_arena_free(f.arena);
}

static void out_of_memory(void **state) {
    (void)state;
    for (long n = 1; n < 4000; n++) {
        fixture f = begin();
        rig r = rig_six_bar(f.arena, false);
        const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 2};
        put_law(&r, &ramp);
        r.scene.duration_s = 2;
        fw_effect_ledger ledger;
        fw_effects_loads loads;
        const fw_dynamics_motion_options o = {.samples = 3, .reactions = true, .accuracy = 0.1};
        const fw_dynamics_motion *m;
        const char *why;
        assert_int_equal(fw_effects_compile(f.arena, &r.m, &r.scene, &o.effects, 1e-3, &f.diags,
                                            &ledger, &loads),
                         FW_OK);
        fw_arena_fail_at(n, 0);
        fw_status status = fw_statics_quasi_static_motion(f.arena, &r.m, &r.scene, &o, &ledger,
                                                          &loads, &f.diags, &m, &why);
        long made = fw_arena_count();
        fw_arena_fail_at(0, 0);
        fw_arena_free(f.arena);
        if (made < n) {
            assert_int_equal(status, FW_OK);
            return;
        }
        assert_int_equal(status, FW_NOMEM);
    }
    fail_msg("never went through");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lever),
        cmocka_unit_test(ramp_is_the_load_path),
        cmocka_unit_test(rates),
        cmocka_unit_test(agrees_with_the_full_motion),
        cmocka_unit_test(jumps_and_watching),
        cmocka_unit_test(driven),
        cmocka_unit_test(where_it_ends),
        cmocka_unit_test(moved),
        cmocka_unit_test(left_out_by_itself),
        cmocka_unit_test(left_out_by_hand),
        cmocka_unit_test(out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
