/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the hard suite shares: runs that keep their error, further joints, laws from text, and runs
   of the bare model with a method made here (for ablations). Every case prints the figures it
   judges. FW_TEST_QUICK=1 leaves out what takes long, for sanitizers and valgrind. */
#ifndef FW_TEST_HARD_H
#define FW_TEST_HARD_H
#include "quantity/law_kind.h"
#include "multibody/system.h"
#include "assembly/assembly.h"
#include "dynamics/models.h"
#include "maths/ode.h"
#include <stdlib.h>

static const double HARD_PI = 3.14159265358979323846;

static inline bool hard_quick(void) {
    return test_cases(0, 1);
}

/* ---- runs ---- */

typedef struct outcome {
    fw_status status;
    const fw_dynamics_motion *m; /* NULL unless FW_OK */
    const char *message;         /* of the last error, else of the last warning; "" */
    int number;                  /* its FW-D */
} outcome;

static inline outcome hard_try(fw_arena *arena, const rig *r, fw_dynamics_motion_options o) {
    fw_diags diags = fw_diags_new(arena);
    outcome out = {.message = ""};
    if (o.effects.mode == FW_EFFECTS_AUTO) o.effects.mode = FW_EFFECTS_ALL;
    out.status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &out.m);
    for (int worst = FW_WARNING; worst <= FW_ERROR; worst++)
        for (size_t i = 0; i < diags.count; i++)
            if ((int)diags.item[i].severity == worst)
                out.message = diags.item[i].message, out.number = diags.item[i].number;
    if (out.status != FW_OK) { /* an error always says what */
        assert_true(out.status == FW_NOMEM || diags.errors > 0);
        assert_null(out.m);
    }
    return out;
}

static inline const fw_dynamics_motion *hard_run(fw_arena *arena, const rig *r,
                                                 fw_dynamics_motion_options o) {
    outcome out = hard_try(arena, r, o);
    if (out.status != FW_OK) fail_msg("%s", out.message);
    assert_true(out.m->stats.max_constraint_norm <= 1e-12 ||
                (o.stabilise && strcmp(o.stabilise, "projection") != 0));
    return out.m;
}

static inline const double *hard_q(const fw_dynamics_motion *m, int row) {
    return m->q + (size_t)row * 3 * (size_t)m->nbody;
}
static inline const double *hard_v(const fw_dynamics_motion *m, int row) {
    return m->v + (size_t)row * 3 * (size_t)m->nbody;
}

/* ---- parts that models.h lacks ---- */

static inline fw_device_joint *hard_tie(fw_arena *arena, rig *r, const char *id,
                                        fw_device_joint_kind kind, int a, int b) {
    if (!r->m.joint) r->m.joint = fw_arena_array(arena, fw_device_joint, 16);
    fw_device_joint *t = &r->m.joint[r->m.njoint++];
    *t = (fw_device_joint){.id = id, .kind = kind, .body_a = a, .body_b = b};
    return t;
}

/* local coordinates of a world point */
static inline void hard_local(const rig *r, int body, double x, double y, double *lx, double *ly) {
    *lx = x, *ly = y;
    if (body == FW_GROUND) return;
    const fw_mechanism_mass *m = &r->m.body[body];
    double dx = x - m->x_m, dy = y - m->y_m, c = cos(m->phi_rad), s = sin(m->phi_rad);
    *lx = c * dx + s * dy, *ly = -s * dx + c * dy;
}

/* a tie whose points a and b are one world point */
static inline fw_device_joint *hard_tie_at(fw_arena *arena, rig *r, const char *id,
                                           fw_device_joint_kind kind, int a, int b, double x,
                                           double y) {
    fw_device_joint *t = hard_tie(arena, r, id, kind, a, b);
    hard_local(r, a, x, y, &t->ax_m, &t->ay_m);
    hard_local(r, b, x, y, &t->bx_m, &t->by_m);
    t->angle_rad =
        (b == FW_GROUND ? 0 : r->m.body[b].phi_rad) - (a == FW_GROUND ? 0 : r->m.body[a].phi_rad);
    return t;
}

static inline fw_device_driver *hard_driver(fw_arena *arena, rig *r, const char *id, int revolute,
                                            int joint, fw_quantity_law law) {
    if (!r->m.driver) r->m.driver = fw_arena_array(arena, fw_device_driver, 8);
    fw_device_driver *d = &r->m.driver[r->m.ndriver++];
    *d = (fw_device_driver){.id = id, .revolute = revolute, .joint = joint, .law = law};
    return d;
}

/* a law from text; `of` is what it gives: rad, m, or nothing for a factor */
static inline fw_quantity_law hard_law(fw_arena *arena, const char *text,
                                       fw_quantity_dimension of) {
    const fw_quantity_names none = {NULL, 0};
    fw_quantity_expression_error error;
    fw_quantity_program *program = NULL;
    if (fw_quantity_program_compile(arena, text, strlen(text), &none, of, &program, &error) !=
        FW_OK)
        fail_msg("%s: %s", text, error.message);
    return (fw_quantity_law){.kind = &fw_quantity_law_expression, .program = program};
}

/* ---- a row of bars through pins; the bars are bodies first, first + 1, ... ---- */

/* bars through the points p (n + 1), uniform mass each, pins at the inner points only */
static inline void hard_bars(rig *r, const double (*p)[2], int n, double mass) {
    int first = r->m.nbody;
    for (int i = 0; i < n; i++) {
        double dx = p[i + 1][0] - p[i][0], dy = p[i + 1][1] - p[i][1];
        rig_body(r, "bar", mass, mass * (dx * dx + dy * dy) / 12, (p[i][0] + p[i + 1][0]) / 2,
                 (p[i][1] + p[i + 1][1]) / 2, atan2(dy, dx));
    }
    for (int i = 1; i < n; i++)
        rig_pin(r, "inner", first + i - 1, first + i, p[i][0], p[i][1], 0, 0);
}

/* ---- the bare model: terms, assembled pose, method of one's own ---- */

static inline fw_multibody_system *hard_system(fw_arena *arena, const rig *r,
                                               const fw_multibody_method *method) {
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads *loads = fw_arena_one(arena, fw_effects_loads);
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    double *q = fw_arena_array(arena, double, 3 * (size_t)r->m.nbody), moved;
    for (int b = 0; b < r->m.nbody; b++) {
        const fw_mechanism_mass *p = &r->m.body[b];
        q[3 * b] = p->x_m, q[3 * b + 1] = p->y_m, q[3 * b + 2] = p->phi_rad;
    }
    const fw_multibody_model *m;
    fw_multibody_system *sys;
    assert_int_equal(
        fw_effects_compile(arena, &r->m, &r->scene, &all, 1e-3, &diags, &ledger, loads), FW_OK);
    assert_int_equal(fw_assembly_assemble(arena, &r->m, q, &moved, &diags), FW_OK);
    assert_int_equal(
        fw_multibody_model_new(arena, &r->m, loads, q, r->scene.duration_s, method, &m), FW_OK);
    assert_int_equal(fw_multibody_system_new(arena, m, &r->m, &diags, &sys), FW_OK);
    sys->kernel = NULL; /* the fast one, which knows one method only */
    return sys;
}

/* integrates the bare system by dop853 at rtol from the scene's initial velocities; y (ny) is the
   end. Tolerances as they are: no lower or upper bound. FW_ODE_SMALL: more than most_steps, too. */
static inline fw_maths_ode_result hard_integrate(fw_arena *arena, const rig *r,
                                                 fw_multibody_system *sys, double rtol,
                                                 long most_steps, double *y) {
    const fw_multibody_model *m = sys->model;
    const fw_maths_ode ode = {.context = sys,
                              .rhs = fw_multibody_rhs,
                              .project = fw_multibody_project,
                              .n = m->ny,
                              .controlled = 2 * m->nq,
                              .positions = m->nq};
    double *atol = fw_arena_array(arena, double, (size_t)m->ny);
    fw_maths_stepper *s = NULL;
    memset(y, 0, (size_t)m->ny * sizeof *y);
    for (int i = 0; i < m->ny; i++)
        atol[i] = rtol;
    for (int i = 0; i < r->scene.ninitial; i++) {
        const fw_device_initial *v = &r->scene.initial[i];
        double *to = y + m->nq + 3 * v->body, unit = m->scale.time_s / m->scale.length_m;
        to[0] = v->vx_m_per_s * unit, to[1] = v->vy_m_per_s * unit;
        to[2] = v->omega_rad_per_s * m->scale.time_s;
    }
    assert_int_equal(
        fw_maths_stepper_new(arena, fw_maths_stepper_find("dop853"), &ode, rtol, atol, &s), FW_OK);
    fw_maths_stepper_start(s, 0, y, r->scene.duration_s / m->scale.time_s);
    fw_maths_ode_result result = FW_ODE_STEP;
    while (s->t < s->t_end && result == FW_ODE_STEP && s->steps < most_steps)
        result = fw_maths_stepper_step(s);
    memcpy(y, s->y, (size_t)m->ny * sizeof *y);
    if (s->t < s->t_end && result == FW_ODE_STEP) result = FW_ODE_SMALL;
    fw_maths_stepper_free(s);
    return result;
}

#endif
