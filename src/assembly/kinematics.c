/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Given motion: velocities, accelerations, joint forces and what drives it. */
#include "assembly/assembly.h"
#include "multibody/system.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef struct state { /* at one instant; arrays are in the model's order, scaled */
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_assembly_kinematics_options *options;
    fw_diags *diags;
    const fw_multibody_model *m;
    fw_multibody_system *system;
    const fw_multibody_pose *pose; /* of y, as long as the instant lasts */
    fw_multibody_solution found;   /* lambda is own */
    double *q0;                    /* (3 nbody) SI: where u = 0 */
    double *y;                     /* (ny) u and v */
    double *a;                     /* (nq) */
    double *g;                     /* (rows x nq) */
    double *packed;                /* (rows) */
    double *work;                  /* (nq) */
    double *block;                 /* (2 nblock) */
    double *next;                  /* (ny) a state to come */
    fw_maths_singular space;
    int rank;
} state;

/* ---- linear algebra on G = U diag(sigma) V^T ---- */

/* least x with G x = b; b becomes what is left of it, *off its size relative to b */
static void particular(const state *s, double *b, double *x, double *off) {
    const fw_maths_singular *g = &s->space;
    double size = 0, left = 0;
    memset(x, 0, (size_t)g->columns * sizeof *x);
    for (int k = 0; k < g->rows; k++)
        size += b[k] * b[k];
    for (int i = 0; i < s->rank; i++) {
        const double *u = g->u + (size_t)i * (size_t)g->rows;
        const double *v = g->v + (size_t)i * (size_t)g->columns;
        double share = 0;
        for (int k = 0; k < g->rows; k++)
            share += u[k] * b[k];
        for (int k = 0; k < g->rows; k++)
            b[k] -= share * u[k];
        for (int k = 0; k < g->columns; k++)
            x[k] += share / g->sigma[i] * v[k];
    }
    for (int k = 0; k < g->rows; k++)
        left += b[k] * b[k];
    *off = size > 0 ? sqrt(left / size) : 0;
}

/* x += N z so that x takes the values `given` at the independent coordinates: N_I z = given -
   x_I */
static void add_free(const state *s, const fw_assembly_coordinate_choice *c,
                     const fw_maths_singular *rows, const double *given, double *x) {
    int f = c->count, n = s->space.columns;
    for (int i = 0; i < f; i++) {
        double share = 0;
        for (int k = 0; k < f; k++)
            share += rows->u[i * f + k] * given[k];
        share /= rows->sigma[i];
        for (int k = 0; k < f; k++) {
            double z = share * rows->v[i * f + k];
            const double *direction = s->space.v + (s->rank + k) * n;
            for (int j = 0; j < n; j++)
                x[j] += z * direction[j];
        }
    }
}

/* N_I^T tau = N^T force */
static void driving(const state *s, const fw_assembly_coordinate_choice *c,
                    const fw_maths_singular *rows, const double *force, double *tau) {
    int f = c->count, n = s->space.columns;
    memset(tau, 0, (size_t)f * sizeof *tau);
    for (int i = 0; i < f; i++) { /* N_I^T = V diag U^T */
        double share = 0;
        for (int k = 0; k < f; k++) {
            double along = 0;
            const double *direction = s->space.v + (s->rank + k) * n;
            for (int j = 0; j < n; j++)
                along += direction[j] * force[j];
            share += rows->v[i * f + k] * along;
        }
        for (int k = 0; k < f; k++)
            tau[k] += share / rows->sigma[i] * rows->u[i * f + k];
    }
}

/* least lambda with G^T lambda = h */
static void multipliers(const state *s, const double *h) {
    const fw_maths_singular *g = &s->space;
    memset(s->packed, 0, (size_t)g->rows * sizeof *s->packed);
    for (int i = 0; i < s->rank; i++) {
        double share = 0;
        for (int k = 0; k < g->columns; k++)
            share += g->v[i * g->columns + k] * h[k];
        for (int k = 0; k < g->rows; k++)
            s->packed[k] += share / g->sigma[i] * g->u[i * g->rows + k];
    }
    fw_multibody_unpack(s->m, s->packed, s->found.lambda);
}

/* ---- one instant ---- */

static const char *scene_text(const fw_device_scene *scene) {
    return scene && scene->name ? scene->name : "(none)";
}

static fw_status state_new(fw_arena *arena, const fw_mechanism *mechanism,
                           const fw_device_scene *scene, const double *q,
                           const fw_assembly_kinematics_options *options, fw_diags *diags,
                           state *s) {
    *s = (state){.arena = arena, .mechanism = mechanism, .options = options, .diags = diags};
    fw_effects_loads loads;
    fw_effect_ledger ledger;
    size_t n = 3 * (size_t)mechanism->nbody;
    if (n > FW_KINEMATICS_MOST) {
        fw_status status = fw_diag_error(
            diags, 117, (fw_place){0},
            "velocities and joint forces for given rates are computed up to %d bodies; the "
            "mechanism has %d; simulate has no such limit",
            FW_KINEMATICS_MOST / 3, mechanism->nbody);
        return status == FW_NOMEM ? FW_NOMEM : FW_LIMIT;
    }
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    FW_NEED(s->q0 = fw_arena_array(arena, double, n));
    memcpy(s->q0, q, n * sizeof *q);
    if (scene) {
        double moved;
        const fw_mechanism *start;
        FW_TRY(fw_effects_compile(arena, mechanism, scene, &options->effects, accuracy, diags,
                                  &ledger, &loads));
        loads.released = NULL; /* the motion is given: all pins are joints */
        FW_TRY(fw_effects_strain(arena, mechanism, &loads, &s->mechanism));
        FW_TRY(fw_effects_at_start(arena, s->mechanism, &loads, &start));
        if (start != mechanism) FW_TRY(fw_assembly_assemble(arena, start, s->q0, &moved, diags));
        mechanism = s->mechanism, q = s->q0;
    }
    if (scene) loads.nfriction = 0; /* forces as they are without */
    FW_TRY(fw_multibody_model_new(arena, mechanism, scene ? &loads : NULL, q,
                                  scene ? scene->duration_s : 1, NULL, &s->m));
    FW_TRY(fw_multibody_system_new(arena, s->m, mechanism, diags, &s->system));
    s->system->piece_s = DBL_MIN;
    size_t rows = (size_t)s->m->rows, blocks = (size_t)s->m->nblock;
    FW_NEED(s->block = fw_arena_array(arena, double, 2 * blocks));
    FW_NEED(s->found.lambda = fw_arena_array(arena, double, 2 * blocks));
    FW_NEED(s->next = fw_arena_array(arena, double, (size_t)s->m->ny));
    FW_NEED(s->y = fw_arena_array(arena, double, (size_t)s->m->ny + 2));
    FW_NEED(s->a = fw_arena_array(arena, double, n));
    FW_NEED(s->g = fw_arena_array(arena, double, rows *n));
    FW_NEED(s->packed = fw_arena_array(arena, double, rows));
    FW_NEED(s->work = fw_arena_array(arena, double, n));
    return FW_OK;
}

/* the pose of s->y at t, G there and its singular values */
static fw_status factor(state *s, double t) {
    s->pose = fw_multibody_pose_at(s->system, t, s->y);
    fw_multibody_dense_jacobian(s->m, s->pose, s->g);
    FW_TRY(fw_maths_singular_new(s->arena, s->m->rows, s->m->nq, s->g, &s->space));
    int least = s->m->rows < s->m->nq ? s->m->rows : s->m->nq;
    for (s->rank = 0; s->rank < least && s->space.sigma[s->rank] > 1e-10 * s->space.sigma[0];)
        s->rank++;
    return FW_OK;
}

static double unit_of(const state *s, int axis) { /* SI of one scaled displacement */
    return axis == 2 ? 1 : s->m->scale.length_m;
}

/* rates (power 1) or accelerations (power 2) of the independent coordinates, scaled, less what x
   has there */
static void wanted(const state *s, const fw_assembly_coordinate_choice *c, const double *given,
                   const double *x, int power, double *out) {
    double time = power == 1 ? s->m->scale.time_s : s->m->scale.time_s * s->m->scale.time_s;
    for (int i = 0; i < c->count; i++) {
        int axis = c->item[i].axis;
        out[i] = (given ? given[i] * time / unit_of(s, axis) : 0) - x[3 * c->item[i].body + axis];
    }
}

static fw_status contradict(const state *s, double t, const char *what) {
    char time[32];
    fw_status status = fw_diag_error(
        s->diags, 118, (fw_place){0},
        "at %s s the drivers prescribe %s that the joints do not allow; the position is "
        "singular there, or two drivers contradict each other",
        fw_number_text(time, sizeof time, t * s->m->scale.time_s, 6), what);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* v, then a, at the pose; the choice's rates and accelerations in SI */
static fw_status rates(state *s, const fw_assembly_coordinate_choice *c,
                       const fw_maths_singular *rows, const double *rate, const double *accel) {
    const fw_multibody_model *m = s->m;
    const double t = s->pose->t;
    double off, *v = s->y + m->nq, *given;
    FW_NEED(given = fw_arena_array(s->arena, double, (size_t)c->count));
    fw_multibody_drift(s->system, s->pose, s->block);
    fw_multibody_pack(m, s->block, s->packed);
    for (int i = 0; i < m->rows; i++)
        s->packed[i] = -s->packed[i];
    particular(s, s->packed, v, &off);
    if (off > 1e-8) return contradict(s, t, "velocities");
    wanted(s, c, rate, v, 1, given);
    add_free(s, c, rows, given, v);
    fw_multibody_gamma(s->system, s->pose, v, s->block);
    fw_multibody_pack(m, s->block, s->packed);
    for (int i = 0; i < m->rows; i++)
        s->packed[i] = -s->packed[i];
    particular(s, s->packed, s->a, &off);
    if (off > 1e-6) return contradict(s, t, "accelerations");
    wanted(s, c, accel, s->a, 2, given);
    add_free(s, c, rows, given, s->a);
    return FW_OK;
}

/* tau and lambda from M a - Q */
static void forces(state *s, const fw_assembly_coordinate_choice *c, const fw_maths_singular *rows,
                   double *tau) {
    const fw_multibody_model *m = s->m;
    s->pose = fw_multibody_set_switches(s->system, s->pose->t, s->y);
    const fw_multibody_solution *found = fw_multibody_forces(s->system, s->pose, s->y + m->nq);
    s->found.pose = s->pose, s->found.element = found->element;
    for (int i = 0; i < m->nq; i++) {
        double mass = i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3];
        s->work[i] = mass * (s->a[i] - found->accel[i]);
    }
    driving(s, c, rows, s->work, tau);
    for (int i = 0; i < m->nq; i++)
        s->work[i] = -s->work[i];
    for (int i = 0; i < c->count; i++)
        s->work[3 * c->item[i].body + c->item[i].axis] += tau[i];
    multipliers(s, s->work);
    for (int i = 0; i < c->count; i++)
        tau[i] *= fw_multibody_newton(m) * (c->item[i].axis == 2 ? m->scale.length_m : 1);
}

static fw_status result_new(fw_arena *arena, const fw_mechanism *m, int freedom,
                            fw_assembly_kinematics *k) {
    size_t n = 3 * (size_t)m->nbody, f = (size_t)freedom;
    k->nbody = m->nbody, k->npin = m->npin, k->njoint = m->njoint, k->ndriver = m->ndriver;
    FW_NEED(k->rate = fw_arena_array(arena, double, f));
    FW_NEED(k->accel = fw_arena_array(arena, double, f));
    FW_NEED(k->drive = fw_arena_array(arena, double, f));
    FW_NEED(k->q = fw_arena_array(arena, double, n));
    FW_NEED(k->v = fw_arena_array(arena, double, n));
    FW_NEED(k->a = fw_arena_array(arena, double, n));
    FW_NEED(k->reaction_N = fw_arena_array(arena, double, 2 * (size_t)m->npin));
    FW_NEED(k->joint_N = fw_arena_array(arena, double, 3 * (size_t)m->njoint));
    FW_NEED(k->driver_N = fw_arena_array(arena, double, (size_t)m->ndriver));
    return FW_OK;
}

static fw_status store(const state *s, double t, fw_assembly_kinematics *k) {
    const fw_multibody_model *m = s->m;
    double time = m->scale.time_s, sum = 0;
    k->t_s = t * time;
    for (int i = 0; i < m->nq; i++) {
        double unit = unit_of(s, i % 3);
        k->q[i] = s->q0[i] + unit * s->y[i];
        k->v[i] = unit / time * s->y[m->nq + i];
        k->a[i] = unit / (time * time) * s->a[i];
        sum += 0 * (k->v[i] + k->a[i]);
    }
    fw_multibody_pin_forces(m, &s->found, k->reaction_N);
    fw_multibody_joint_forces(m, &s->found, s->mechanism, k->joint_N, k->driver_N);
    k->unique = s->rank == m->rows;
    for (int i = 0; i < 2 * m->npin; i++)
        sum += 0 * k->reaction_N[i];
    return sum == 0 ? FW_OK : contradict(s, t, "a motion");
}

static fw_status check_count(const char *what, int given, const fw_assembly_coordinate_choice *c,
                             fw_diags *diags) {
    if (given == 0 || given == c->count) return FW_OK;
    fw_status status =
        fw_diag_error(diags, 117, (fw_place){0}, "%d %s given for %d independent coordinate%s (%s)",
                      given, what, c->count, c->count == 1 ? "" : "s", c->count ? c->text : "none");
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

static fw_status check_finite(const double *value, int count, fw_diags *diags) {
    for (int i = 0; i < count; i++)
        if (!isfinite(value[i])) {
            fw_status status =
                fw_diag_error(diags, 117, (fw_place){0}, "rates and accelerations must be finite");
            return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
        }
    return FW_OK;
}

/* v and a by the null space, forces by projecting on it. Inputs SI; all in one singular value
   decomposition of the scaled G. Error: round-off times the condition of the choice and of G. Cost
   of that decomposition, about 10 unknowns^3. Source: Wehage and Haug 1982; Garcia de Jalon and
   Bayo 1994, ch. 3 and 5. Test: test_kinematics.c. */
fw_status fw_assembly_kinematics_solve(fw_arena *arena, const fw_mechanism *mechanism,
                                       const fw_device_scene *scene, const double *q,
                                       const fw_assembly_kinematics_options *options,
                                       fw_diags *diags, const fw_assembly_kinematics **result) {
    state s;
    fw_maths_singular rows;
    *result = NULL;
    fw_assembly_kinematics *k = fw_arena_one(arena, fw_assembly_kinematics);
    FW_NEED(k);
    FW_TRY(check_finite(options->rate, options->rate ? options->nrate : 0, diags));
    FW_TRY(check_finite(options->accel, options->accel ? options->naccel : 0, diags));
    FW_TRY(state_new(arena, mechanism, scene, q, options, diags, &s));
    FW_TRY(factor(&s, 0));
    FW_TRY(fw_assembly_independent_choose(arena, mechanism, &s.space, s.rank, options->independent,
                                          diags, &k->independent));
    const fw_assembly_coordinate_choice *c = &k->independent;
    FW_TRY(check_count("rates are", options->rate ? options->nrate : 0, c, diags));
    FW_TRY(check_count("accelerations are", options->accel ? options->naccel : 0, c, diags));
    FW_TRY(fw_assembly_independent_rows(arena, &s.space, s.rank, c, &rows));
    FW_TRY(result_new(arena, mechanism, c->count, k));
    FW_TRY(rates(&s, c, &rows, options->rate, options->accel));
    forces(&s, c, &rows, k->drive);
    for (int i = 0; i < c->count; i++) {
        k->rate[i] = options->rate ? options->rate[i] : 0;
        k->accel[i] = options->accel ? options->accel[i] : 0;
    }
    FW_TRY(store(&s, 0, k));
    *result = k;
    return FW_OK;
}

/* ---- driven mechanisms along time ---- */

static fw_status lost(const state *s, const fw_device_scene *scene, double t) {
    char time[32];
    fw_status status = fw_diag_error(
        s->diags, 118, scene->place,
        "the mechanism cannot follow its drivers in %s%s beyond %s s: no position near the "
        "last one has the values that they prescribe",
        FW_NAMED("scene", scene_text(scene)),
        fw_number_text(time, sizeof time, t * s->m->scale.time_s, 6));
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

static fw_status not_driven(const state *s, const fw_device_scene *scene) {
    fw_status status = fw_diag_error(
        s->diags, 117, scene->place,
        "%d degrees of freedom are left free by the drivers; only a mechanism that is driven in "
        "all of them can be followed without its dynamics",
        s->m->nq - s->rank);
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* u at t + h from u, v, a at t: the Taylor step, closed by Newton; false: not within a tenth of
   what it moved */
static bool advance(state *s, double t, double h, double *next) {
    const fw_multibody_model *m = s->m;
    const double *u = s->y, *v = s->y + m->nq;
    double moved = 0, off = 0;
    for (int i = 0; i < m->nq; i++) {
        next[i] = u[i] + h * (v[i] + h / 2 * s->a[i]);
        s->work[i] = next[i];
        moved = fmax(moved, fabs(next[i] - u[i]));
    }
    if (!(moved < 0.3)) return false;
    if (!fw_multibody_close_position(s->system, t + h, next)) return false;
    for (int i = 0; i < m->nq; i++)
        off = fmax(off, fabs(next[i] - s->work[i]));
    return off <= 0.1 * moved + 1e-9;
}

static fw_status at_instant(state *s, double t, const fw_assembly_coordinate_choice *none) {
    fw_maths_singular rows = {0};
    fw_mark mark = fw_arena_mark(s->arena);
    FW_TRY(factor(s, t));
    if (s->rank < s->m->nq) return contradict(s, t, "a motion");
    FW_TRY(rates(s, none, &rows, NULL, NULL));
    forces(s, none, &rows, s->work);
    fw_arena_rewind(s->arena, mark);
    return FW_OK;
}

/* from t to `end` in steps that keep the branch */
static fw_status walk(state *s, const fw_device_scene *scene, double t, double end,
                      const fw_assembly_coordinate_choice *none) {
    double h = end - t, span = h, *next = s->next;
    while (t < end) {
        double to = t + h >= end ? end : t + h;
        s->system->piece_s = to * s->m->scale.time_s; /* what holds from there on */
        if (!advance(s, t, to - t, next)) {
            h /= 2;
            if (h < 1e-10 * span) return lost(s, scene, t);
            continue;
        }
        memcpy(s->y, next, (size_t)s->m->nq * sizeof *next);
        t = to;
        h *= 2;
        if (t < end) FW_TRY(at_instant(s, t, none));
    }
    return at_instant(s, end, none);
}

fw_status fw_assembly_kinematics_follow(fw_arena *arena, const fw_mechanism *mechanism,
                                        const fw_device_scene *scene, const double *q, int samples,
                                        const fw_assembly_kinematics_options *options,
                                        fw_diags *diags, const fw_assembly_kinematics **result) {
    state s;
    fw_assembly_coordinate_choice none = {.condition = 1, .text = ""};
    *result = NULL;
    if (samples < 1 || !(scene->duration_s > 0) || !isfinite(scene->duration_s)) {
        fw_status status = fw_diag_error(diags, 105, scene->place,
                                         "duration and number of samples must be above 0");
        return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
    }
    FW_TRY(state_new(arena, mechanism, scene, q, options, diags, &s));
    fw_assembly_kinematics *all = fw_arena_array(arena, fw_assembly_kinematics, (size_t)samples);
    FW_NEED(all);
    FW_TRY(factor(&s, 0));
    if (s.rank < s.m->nq) return not_driven(&s, scene);
    FW_TRY(at_instant(&s, 0, &none));
    double end = scene->duration_s / s.m->scale.time_s;
    for (int i = 0; i < samples; i++) {
        double t = samples > 1 ? end * i / (samples - 1) : 0;
        if (i > 0) FW_TRY(walk(&s, scene, end * (i - 1) / (samples - 1), t, &none));
        all[i].independent = none;
        FW_TRY(result_new(arena, mechanism, 0, &all[i]));
        FW_TRY(store(&s, t, &all[i]));
    }
    *result = all;
    return FW_OK;
}
