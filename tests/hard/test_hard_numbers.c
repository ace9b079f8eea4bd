/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every number of a mechanism, a scene and the options in turn not a number, infinite, huge or
   tiny. Hard because one such number reaches everything within a few steps, and a comparison with a
   NaN is false whichever way a guard was written: what leaves a room is an error with a diagnostic,
   or finite throughout. */
#include "quantity/law_kind.h"
#include "hard.h"
#include "statics/statics.h"

enum { MOST = 400 };

typedef struct knob {
    const char *name;
    double *value;
} knob;

typedef struct bench {
    rig r;
    fw_dynamics_motion_options o;
    fw_quantity_law ramp, sine, table, motor;
    double table_t[3], table_v[3];
    knob knob[MOST];
    int knobs;
} bench;

static void add(bench *b, const char *name, double *value) {
    assert_true(b->knobs < MOST);
    b->knob[b->knobs++] = (knob){name, value};
}

/* something of everything: a four-bar with springs, dampers and stops, a slider on a rod, a welded
   plate, a driven arm, a spring and a cable, loads with every law */
static bench *everything(fw_arena *arena) {
    static const double p[4][2] = {{0, 0}, {0.2, 0.5}, {1.2, 0.7}, {1.4, 0}};
    bench *b = fw_arena_one(arena, bench);
    b->r = rig_new(arena, 8, 8, 4);
    rig *r = &b->r;
    hard_bars(r, p, 3, 1);
    rig_body(r, "slider", 0.5, 0.01, 2, 0.5, 0);
    rig_body(r, "plate", 0.2, 0.02, 0.8, 0.9, 0.1);
    rig_body(r, "arm", 0.3, 0.03, 0.25, -1, 0);
    rig_pin(r, "A", FW_GROUND, 0, 0, 0, 2, 0.01);
    rig_pin(r, "D", 2, FW_GROUND, 1.4, 0, 1, 0);
    rig_pin(r, "M", FW_GROUND, 5, 0, -1, 0, 0);
    r->m.pin[2].stop_min_rad = -0.4, r->m.pin[2].stop_max_rad = 2;
    r->m.pin[2].stop_stiffness_Nm_per_rad = 50, r->m.pin[2].stop_damping_Nms_per_rad = 0.1;
    fw_device_joint *guide =
        hard_tie_at(arena, r, "guide", FW_JOINT_PRISMATIC, FW_GROUND, 3, 2, 0.5);
    guide->axis_rad = 0.2, guide->stiffness_N_per_m = 5, guide->damping_Ns_per_m = 0.1;
    fw_device_joint *rod = hard_tie_at(arena, r, "rod", FW_JOINT_DISTANCE, 1, 3, 2, 0.5);
    hard_local(r, 1, 1, 0.66, &rod->ax_m, &rod->ay_m);
    rod->length_m = hypot(1, 0.16);
    hard_tie_at(arena, r, "weld", FW_JOINT_WELD, 1, 4, 0.8, 0.75);
    rig_spring(r, "spring", FW_GROUND, 2, 1, 2, 0.1, 0, 3, 0.4)->damping_Ns_per_m = 0.05;
    rig_spring(r, "cable", FW_GROUND, -1, 1, 0, 0, 0, 4, 1)->cable = true;
    b->motor = (fw_quantity_law){
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 1};
    hard_driver(arena, r, "motor", 4, FW_NONE, b->motor);
    b->table_t[1] = 0.1, b->table_t[2] = 0.3, b->table_v[1] = 1, b->table_v[2] = 0.5;
    b->table = (fw_quantity_law){.kind = &fw_quantity_law_table,
                                 .table_t_s = b->table_t,
                                 .table_value = b->table_v,
                                 .ntable = 3};
    b->ramp = (fw_quantity_law){.kind = &fw_quantity_law_ramp, .start_s = 0.05, .rise_s = 0.1};
    b->sine = (fw_quantity_law){.kind = &fw_quantity_law_sine,
                                .start_s = 0.02,
                                .end_s = 0.4,
                                .frequency_Hz = 3,
                                .phase_rad = 0.1};
    for (int i = 0; i < 3; i++) {
        rig_force(r, i, 1 + i, -2);
        r->scene.force[i].x_m = 0.1 * i;
    }
    r->scene.force[1].law = &b->ramp, r->scene.force[2].law = &b->sine;
    rig_torque(r, 3, 0.1);
    rig_torque(r, 2, 0.2);
    r->scene.torque[1].law = &b->table;
    rig_velocity(r, 0, 0, 0, 0.5);
    r->scene.gravity = true, r->scene.gx_m_per_s2 = 0.3, r->scene.gy_m_per_s2 = -9.81;
    r->scene.duration_s = 0.5;
    b->o = (fw_dynamics_motion_options){.rtol = 1e-6,
                                        .accuracy = 1e-3,
                                        .samples = 4,
                                        .reactions = true,
                                        .most_angle_rad = 50,
                                        .most_steps = 1000,
                                        .effects = {.mode = FW_EFFECTS_ALL}};
    return b;
}

#define KNOB(b, of, member) add((b), #member, &(of)->member)

static void collect(bench *b) {
    fw_mechanism *m = &b->r.m;
    fw_device_scene *s = &b->r.scene;
    for (int i = 0; i < m->nbody; i++) {
        fw_mechanism_mass *p = &m->body[i];
        KNOB(b, p, mass_kg), KNOB(b, p, inertia_kg_m2);
        KNOB(b, p, x_m), KNOB(b, p, y_m), KNOB(b, p, phi_rad);
    }
    for (int i = 0; i < m->npin; i++) {
        fw_mechanism_pin *p = &m->pin[i];
        KNOB(b, p, ax_m), KNOB(b, p, ay_m), KNOB(b, p, bx_m), KNOB(b, p, by_m);
        KNOB(b, p, stiffness_Nm_per_rad), KNOB(b, p, damping_Nms_per_rad);
        KNOB(b, p, free_angle_rad), KNOB(b, p, stop_min_rad), KNOB(b, p, stop_max_rad);
        KNOB(b, p, stop_stiffness_Nm_per_rad), KNOB(b, p, stop_damping_Nms_per_rad);
    }
    for (int i = 0; i < m->njoint; i++) {
        fw_device_joint *p = &m->joint[i];
        KNOB(b, p, ax_m), KNOB(b, p, ay_m), KNOB(b, p, bx_m), KNOB(b, p, by_m);
        KNOB(b, p, axis_rad), KNOB(b, p, angle_rad), KNOB(b, p, length_m);
        KNOB(b, p, stiffness_N_per_m), KNOB(b, p, damping_Ns_per_m), KNOB(b, p, free_length_m);
    }
    for (int i = 0; i < m->nspring; i++) {
        fw_device_spring *p = &m->spring[i];
        KNOB(b, p, ax_m), KNOB(b, p, ay_m), KNOB(b, p, bx_m), KNOB(b, p, by_m);
        KNOB(b, p, stiffness_N_per_m), KNOB(b, p, damping_Ns_per_m), KNOB(b, p, length_m);
    }
    fw_quantity_law *law[] = {&m->driver[0].law, &b->ramp, &b->sine};
    for (int i = 0; i < 3; i++) {
        KNOB(b, law[i], start_s), KNOB(b, law[i], end_s), KNOB(b, law[i], rise_s);
        KNOB(b, law[i], frequency_Hz), KNOB(b, law[i], phase_rad);
    }
    for (int i = 0; i < 3; i++)
        add(b, "table_t_s", &b->table_t[i]), add(b, "table_value", &b->table_v[i]);
    KNOB(b, s, duration_s), KNOB(b, s, gx_m_per_s2), KNOB(b, s, gy_m_per_s2);
    for (int i = 0; i < s->nforce; i++) {
        fw_device_force *p = &s->force[i];
        KNOB(b, p, x_m), KNOB(b, p, y_m), KNOB(b, p, fx_N), KNOB(b, p, fy_N);
    }
    for (int i = 0; i < s->ntorque; i++)
        add(b, "torque value_Nm", &s->torque[i].value_Nm);
    KNOB(b, &s->initial[0], vx_m_per_s), KNOB(b, &s->initial[0], vy_m_per_s);
    KNOB(b, &s->initial[0], omega_rad_per_s);
    KNOB(b, &b->o, rtol), KNOB(b, &b->o, accuracy), KNOB(b, &b->o, most_angle_rad);
}

/* ---- what came out ---- */

static const char *bad; /* the name of the first field that is not finite */

static void look(const char *what, const double *x, int count) {
    for (int i = 0; i < count && !bad; i++)
        if (!isfinite(x[i])) bad = what;
}

static void look_at_motion(const fw_dynamics_motion *m) {
    int n = 3 * m->nbody * m->nsample;
    bad = NULL;
    look("t", m->t_s, m->nsample);
    look("q", m->q, n), look("v", m->v, n), look("accel", m->accel, n);
    look("angle", m->angle_rad, m->nsample * m->npin);
    look("reaction", m->reaction_N, 2 * m->nsample * m->npin);
    look("tie", m->joint_N, 3 * m->nsample * m->njoint);
    look("driver", m->driver_N, m->nsample * m->ndriver);
    for (int i = 0; i < m->npin; i++) {
        look("peak", &m->peak[i].angle_rad, 1), look("peak error", &m->peak[i].error_rad, 1);
        look("force peak", &m->force_peak[i].force_N, 1);
        look("force error", &m->force_peak[i].error_N, 1);
    }
    const fw_dynamics_motion_stats *s = &m->stats;
    const double all[] = {
        s->max_constraint_norm, s->max_velocity_norm, s->energy_error, s->largest_energy_J,
        s->assembly_moved_m,    s->velocity_moved,    s->rtol,         m->end_s};
    look("statistics", all, sizeof all / sizeof all[0]);
}

typedef struct tally {
    int finite, refused, silent;
} tally;

/* a status that is not FW_OK comes with an error */
static void count(tally *t, const char *entry, const knob *k, double value, fw_status status,
                  const fw_diags *diags) {
    if (status == FW_OK && !bad) {
        t->finite++;
    } else if (status != FW_OK && status != FW_NOMEM && diags->errors > 0) {
        t->refused++;
    } else {
        t->silent++;
        print_message("SILENT %s with %s = %g: %s\n", entry, k->name, value,
                      bad && status == FW_OK ? bad : fw_status_text(status));
    }
}

static void try_all(tally t[4], const bench *b, const knob *k, double value) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags[4];
    for (int i = 0; i < 4; i++)
        diags[i] = fw_diags_new(arena);
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &b->r.m, &b->r.scene, &b->o, &diags[0], &motion);
    bad = NULL;
    if (status == FW_OK) look_at_motion(motion);
    count(&t[0], "simulate", k, value, status, &diags[0]);
    double q[30], moved;
    for (int i = 0; i < b->r.m.nbody; i++) {
        const fw_mechanism_mass *p = &b->r.m.body[i];
        q[3 * i] = p->x_m, q[3 * i + 1] = p->y_m, q[3 * i + 2] = p->phi_rad;
    }
    bad = NULL;
    status = fw_assembly_assemble(arena, &b->r.m, q, &moved, &diags[1]);
    if (status == FW_OK) look("pose", q, 3 * b->r.m.nbody), look("moved", &moved, 1);
    count(&t[1], "assemble", k, value, status, &diags[1]);
    const fw_statics_static_options so = {.path = false};
    const fw_statics *s = NULL;
    bad = NULL;
    status = fw_statics_solve(arena, &b->r.m, &b->r.scene, &so, &diags[2], &s);
    if (status == FW_OK) {
        look("equilibrium", s->q, 3 * s->nbody), look("angle", s->angle_rad, s->npin);
        look("reaction", s->reaction_N, 2 * s->npin);
        look("eigenvalue", s->eigenvalue_per_s2, s->dof), look("residual", &s->residual, 1);
    }
    count(&t[2], "statics", k, value, status, &diags[2]);
    const fw_statics_mode_options mo = {.drawn = 0};
    const fw_statics_modes *modes = NULL;
    bad = NULL;
    status = fw_statics_small_motions(arena, &b->r.m, &b->r.scene, &mo, &diags[3], &modes);
    if (status == FW_OK) {
        look("pose", modes->q, 3 * modes->nbody);
        for (int i = 0; i < modes->count; i++) {
            look("omega", &modes->mode[i].omega_rad_per_s, 1);
            look("eigenvalue", &modes->mode[i].eigenvalue_per_s[0][0], 4);
            look("shape", modes->mode[i].shape, 3 * modes->nbody);
        }
    }
    count(&t[3], "modes", k, value, status, &diags[3]);
    fw_arena_free(arena);
}

static void test_every_number(void **state) {
    (void)state;
    static const char *const entry[4] = {"simulate", "assemble", "statics", "modes"};
    const double value[] = {
        (double)NAN, (double)INFINITY, (double)-INFINITY, 1e300, -1e300, 1e-300, 0, 1e20};
    fw_arena *arena = fw_arena_new(0);
    bench *b = everything(arena);
    collect(b);
    tally t[4] = {{0}};
    knob none = {"nothing changed", &b->table_v[0]};
    try_all(t, b, &none, *none.value); /* as it is everything is fine */
    for (int i = 0; i < 4; i++)
        assert_int_equal(t[i].finite, 1);
    int step = test_fewest(hard_quick() ? 7 : 1, 23);
    for (int i = 0; i < b->knobs; i += step)
        for (size_t k = 0; k < sizeof value / sizeof value[0]; k++) {
            double kept = *b->knob[i].value;
            *b->knob[i].value = value[k];
            try_all(t, b, &b->knob[i], value[k]);
            *b->knob[i].value = kept;
        }
    int silent = 0;
    for (int i = 0; i < 4; i++) {
        print_message("numbers, %-8s: %d numbers x 8 values: %d finite, %d refused in words, %d "
                      "silent\n",
                      entry[i], b->knobs / step, t[i].finite, t[i].refused, t[i].silent);
        silent += t[i].silent;
    }
    assert_int_equal(silent, 0);
    fw_arena_free(arena);
}

/* loads that blow up while the mechanism moves */
static void test_blows_up(void **state) {
    (void)state;
    static const char *const law[] = {
        "1 s / (0.05 s - t)", "1 s^2 / (0.05 s - t)^2", "exp(t / 1e-4 s)", "sqrt(1 - t / 0.03 s)",
        "ln(1 - t / 0.03 s)", "1 / (t / 1 s - 0.05)",   "0 / (t / 1 s)"};
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++)
        for (int integrator = 0; integrator < 3; integrator++) {
            static const char *const name[3] = {"dop853", "radau5", "auto"};
            fw_arena *arena = fw_arena_new(0);
            rig r = rig_six_bar(arena, false);
            const fw_quantity_names none = {NULL, 0};
            fw_quantity_expression_error error;
            fw_quantity_program *program = NULL;
            if (fw_quantity_program_compile(arena, law[i], strlen(law[i]), &none,
                                            (fw_quantity_dimension){0}, &program,
                                            &error) != FW_OK) {
                print_message("numbers, load %s: %s\n", law[i], error.message);
                fw_arena_free(arena);
                break;
            }
            fw_quantity_law l = {.kind = &fw_quantity_law_expression, .program = program};
            r.scene.force[0].law = &l;
            r.scene.duration_s = 0.1;
            outcome out = hard_try(arena, &r,
                                   (fw_dynamics_motion_options){.rtol = 1e-7,
                                                                .samples = 11,
                                                                .reactions = true,
                                                                .integrator = name[integrator],
                                                                .most_steps = 5000});
            if (out.status == FW_OK) {
                look_at_motion(out.m);
                assert_null(bad);
            }
            print_message("numbers, load %s by %s: %s\n", law[i], name[integrator],
                          out.status == FW_OK ? "finite" : out.message);
            fw_arena_free(arena);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_number),
        cmocka_unit_test(test_blows_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
