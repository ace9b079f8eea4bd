/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What must be known before the first step. */
#include "assembly/assembly.h"
#include "dynamics/run.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

/* ---- size of the motion ---- */

/* in scaled units, at most 1: twice the linear static response to what acts, and the starting
   velocity, or the strain of the ground; 1 when the mechanism can move freely or is driven */
static fw_status motion_size(fw_dynamics_problem *problem, const fw_effects_loads *loads) {
    const fw_mechanism *m = problem->mechanism;
    size_t n = 3 * (size_t)m->nbody;
    double *force, *displacement, *rotation, size = 0, speed = 0;
    const double still = 1e-6; /* where nothing moves round-off is held far below what is seen */
    problem->amplitude = 1;
    problem->stretched = loads->stretch.law != NULL;
    if (m->ndriver > 0) return FW_OK;
    if (loads->stretch.law)
        size = fabs(loads->stretch.strain) *
               fw_quantity_law_largest(loads->stretch.law, problem->scene->duration_s);
    fw_mark mark = fw_arena_mark(problem->arena);
    bool valid = false;
    FW_NEED(force = fw_arena_array(problem->arena, double, n));
    FW_NEED(displacement = fw_arena_array(problem->arena, double, n));
    FW_NEED(rotation = fw_arena_array(problem->arena, double, (size_t)m->npin));
    fw_effects_loads_largest_force(m, loads, problem->scene->duration_s, force);
    FW_TRY(fw_effects_static_response(problem->arena, m, loads, force, displacement, rotation,
                                      &valid));
    const fw_multibody_scale s = problem->model->scale;
    for (size_t i = 0; i < n; i++) {
        double unit = i % 3 == 2 ? 1 : s.length_m;
        if (valid) size = fmax(size, 2 * fabs(displacement[i]) / unit);
        speed = fmax(speed, fabs(problem->start[n + i]));
    }
    fw_arena_rewind(problem->arena, mark);
    size = fmax(size, speed);
    if (valid) problem->amplitude = size > 0 ? fmin(1, size) : still;
    problem->idle = valid && size <= 0;
    return FW_OK;
}

/* ---- start values ---- */

/* stated (nq): does the scene state that velocity (x, y, turn of a body)? One look at every
   <initial>, not one per coordinate: large models state thousands. */
static fw_status note_stated(const fw_dynamics_problem *problem, bool **stated) {
    FW_NEED(*stated = fw_arena_array(problem->arena, bool, (size_t)problem->model->nq));
    for (int i = problem->scene->ninitial - 1; i >= 0; i--) { /* the first of a body counts */
        const fw_device_initial *v = &problem->scene->initial[i];
        if (v->body == FW_GROUND) continue;
        for (int c = 0; c < 3; c++)
            (*stated)[3 * v->body + c] = !(c < 2 ? v->moves_free : v->turns_free);
    }
    return FW_OK;
}

static void warn_velocities(fw_dynamics_run *r, const bool *stated, const double *given,
                            const double *v) {
    double size = 0, moved = 0;
    for (int i = 0; i < r->problem.model->nq; i++) {
        size = fmax(size, fabs(given[i]));
        if (stated[i]) moved = fmax(moved, fabs(v[i] - given[i]));
    }
    r->record.motion->stats.velocity_moved = size > 0 ? moved / size : 0;
    if (!(size > 0 && moved > 1e-6 * size)) return;
    double before = fw_multibody_kinetic_energy(r->problem.model, given),
           after = fw_multibody_kinetic_energy(r->problem.model, v);
    char most[32], energy[32];
    (moved > fw_assembly_another_start * size ? fw_diag_unreliable : fw_diag_warning)(
        r->diags, 106, r->problem.scene->place,
        "initial velocities of %s%s contradict the joints; they were changed by up "
        "to %s %% to fit, the kinetic energy by %s %%",
        FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)),
        fw_number_text(most, sizeof most, 100 * moved / size, 3),
        fw_number_text(energy, sizeof energy, 100 * (after - before) / before, 3));
}

static fw_status cannot_start(const fw_dynamics_run *r) {
    fw_status status = fw_diag_error(
        r->diags, 109, r->problem.scene->place,
        "method %s cannot start %s%s: its equations are singular in the "
        "assembled position; use --method chain",
        r->problem.model->method->name, FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)));
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* Stated velocities start as if all pins were joints, also those that elements stand for: they then start without a
   stretch, and without its rate where what is stated can be had so (give_way). Before the scene drivers and ground stand
   still, unless what is stated can be had with their speed alone: a driver that begins with a speed, or ground that begins
   to grow, takes along at once what joints tie to it, and flexures pull the rest after it. */
static fw_status closed_system(fw_dynamics_run *r, const fw_effects_loads *loads,
                               fw_multibody_system **closed) {
    const fw_dynamics_problem *problem = &r->problem;
    fw_effects_loads all = *loads;
    const fw_multibody_model *model;
    *closed = problem->system;
    if (problem->model->nreleased == 0) return FW_OK;
    all.released = NULL;
    FW_TRY(fw_multibody_model_new(problem->arena, problem->mechanism, &all, problem->q0,
                                  problem->scene->duration_s, NULL, &model));
    FW_TRY(fw_multibody_system_new(problem->arena, model, problem->mechanism, r->diags, closed));
    (*closed)->piece_s = problem->system->piece_s;
    return FW_OK;
}

/* at positions on the joints, velocities v too; given: and as near to that as the joints allow */
static bool velocities_onto_joints(fw_multibody_system *sys, const bool *stated,
                                   const double *given, const double *y, double *v, double *work) {
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, 0, y);
    if (given && !fw_multibody_follow_stated(sys, pose, stated, given, v, work)) return false;
    const fw_multibody_factor *factor = fw_multibody_factorise(sys, pose);
    return factor && fw_multibody_impact(sys, factor, v);
}

/* the positions of y likewise */
static bool onto_joints(fw_multibody_system *sys, const bool *stated, const double *given,
                        double *y, double *v, double *work) {
    return fw_multibody_close_position(sys, 0, y) &&
           velocities_onto_joints(sys, stated, given, y, v, work);
}

/* does the motion without stretch leave what was stated? */
static bool contradicted(int n, const bool *stated, const double *given, const double *v) {
    double size = 0, moved = 0;
    for (int i = 0; i < n; i++) {
        size = fmax(size, fabs(given[i]));
        if (stated[i]) moved = fmax(moved, fabs(v[i] - given[i]));
    }
    return moved > 1e-6 * size;
}

/* Velocities that flexures can only follow by giving way, as of a stage on leaves: what is stated
   stays, and the rest gets the velocities whose rate of elastic energy is least, v' K v/2 with K the
   tangent of the elements: those of a slow displacement,

     (K_uu + e M_uu) v_u = -K_us v_s

   e = 1e-9 of the largest K_ii/M_ii keeps what no element holds where it is; joints are closed
   afterwards. In and out: scaled. Cost: n^3/3. Test: test_start_velocity.c. */
static fw_status give_way(fw_dynamics_run *r, const bool *stated, const double *given, double *v) {
    const fw_multibody_model *m = r->problem.model;
    fw_multibody_system *sys = r->problem.system;
    size_t n = (size_t)m->nq;
    fw_mark mark = fw_arena_mark(r->problem.arena);
    double *K, *still, *a, *b, most = 0;
    int *place, *pivot, count = 0;
    FW_NEED(K = fw_arena_array(r->problem.arena, double, n *n));
    FW_NEED(still = fw_arena_array(r->problem.arena, double, n));
    const fw_effects_matrix to_k = {.n = m->nq, .dense = K};
    FW_NEED(a = fw_arena_array(r->problem.arena, double, n *n));
    FW_NEED(b = fw_arena_array(r->problem.arena, double, n));
    FW_NEED(place = fw_arena_array(r->problem.arena, int, n));
    FW_NEED(pivot = fw_arena_array(r->problem.arena, int, n));
    const fw_multibody_pose *pose = fw_multibody_close_position(sys, 0, r->problem.start);
    if (!pose) return FW_OK;
    fw_multibody_element_tangent(sys, pose, still, &to_k, NULL);
    for (int i = 0; i < m->nq; i++) {
        double inverse = i % 3 == 2 ? m->jinv[i / 3] : m->minv[i / 3];
        most = fmax(most, fabs(K[(size_t)i * n + (size_t)i]) * inverse);
        v[i] = given[i];
        if (!stated[i]) place[count++] = i;
    }
    for (int i = 0; i < count; i++) {
        const double *row = K + (size_t)place[i] * n;
        double inverse = place[i] % 3 == 2 ? m->jinv[place[i] / 3] : m->minv[place[i] / 3];
        for (int j = 0; j < count; j++) /* symmetric: rows or columns */
            a[(size_t)i * (size_t)count + (size_t)j] = row[place[j]];
        a[(size_t)i * (size_t)count + (size_t)i] += 1e-9 * most / inverse;
        for (int k = 0; k < m->nq; k++)
            if (stated[k]) b[i] -= row[k] * given[k];
    }
    if (count > 0 && fw_maths_lu_factor(count, a, pivot)) {
        fw_maths_lu_solve(count, a, pivot, NULL, b);
        for (int i = 0; i < count; i++)
            v[place[i]] = b[i];
    }
    fw_arena_rewind(r->problem.arena, mark);
    return FW_OK;
}

/* Pins that stay open, as where the layer has shrunk between clamps: it has done so before the scene, so that this begins
   where the flexures that stand for them are in equilibrium with each other, and nothing rings for it.

     (K + e M) du = Q,   Q of these flexures, K the tangent of all elements, e as in give_way

   In and out: scaled. Newton, closed on the joints after every step; ends at 1e-12 of the size, or where steps grow. Cost:
   n^3/3 a step, some five of them. Test: test_start_velocity.c open_pins_begin_at_rest */
static fw_status settle(fw_dynamics_run *r) {
    const fw_multibody_model *m = r->problem.model;
    fw_multibody_system *sys = r->problem.system;
    size_t n = (size_t)m->nq;
    fw_mark mark = fw_arena_mark(r->problem.arena);
    double *K, *Q, *still, *u = r->problem.start, before = HUGE_VAL;
    int *pivot;
    FW_NEED(K = fw_arena_array(r->problem.arena, double, n *n));
    const fw_effects_matrix to_k = {.n = m->nq, .dense = K};
    FW_NEED(Q = fw_arena_array(r->problem.arena, double, n));
    FW_NEED(still = fw_arena_array(r->problem.arena, double, n));
    FW_NEED(pivot = fw_arena_array(r->problem.arena, int, n));
    for (int round = 0; round < 50; round++) {
        double most = 0, step = 0;
        const fw_multibody_pose *pose = fw_multibody_close_position(sys, 0, u);
        if (!pose) break;
        memset(K, 0, n * n * sizeof(double)), memset(Q, 0, n * sizeof(double));
        fw_multibody_element_tangent(sys, pose, still, &to_k, NULL);
        fw_multibody_element_driven(sys, pose, still, true, Q);
        for (size_t i = 0; i < n; i++) {
            double inverse = i % 3 == 2 ? m->jinv[i / 3] : m->minv[i / 3];
            most = fmax(most, fabs(K[i * n + i]) * inverse);
        }
        for (size_t i = 0; i < n; i++)
            K[i * n + i] += 1e-9 * most / (i % 3 == 2 ? m->jinv[i / 3] : m->minv[i / 3]);
        if (!fw_maths_lu_factor(m->nq, K, pivot)) break;
        fw_maths_lu_solve(m->nq, K, pivot, NULL, Q);
        for (size_t i = 0; i < n; i++)
            step = fmax(step, fabs(Q[i]));
        if (!(step < before) && round > 3) break;
        for (size_t i = 0; i < n; i++)
            u[i] += Q[i];
        before = step;
        if (step < 1e-12) break;
    }
    fw_arena_rewind(r->problem.arena, mark);
    return FW_OK;
}

/* what was before the scene, by the joints of `closed`, with drivers at rest or as fast as they begin */
static bool before_start(fw_dynamics_run *r, fw_multibody_system *closed, const bool *stated,
                         bool driven) {
    const size_t n = (size_t)r->problem.model->nq;
    const double *given = r->record.state;
    double *y = r->problem.start, *v = y + n;
    memcpy(v, given, n * sizeof *v);
    if (!fw_multibody_close_position(closed, 0, y)) return false;
    const bool drives = closed->loading.driven;
    closed->loading.driven = drives && driven;
    const bool good = velocities_onto_joints(closed, stated, given, y, v, r->record.rate);
    closed->loading.driven = drives;
    return good;
}

/* assembled pose, initial velocities moved onto G v = -Psi_t; says so when they contradicted the
   joints */
static fw_status start_values(fw_dynamics_run *r, const fw_effects_loads *loads) {
    const fw_multibody_model *m = r->problem.model;
    fw_multibody_system *sys = r->problem.system, *closed;
    const fw_multibody_scale s = m->scale;
    double *v = r->problem.start + m->nq, *given = r->record.state;
    bool *stated;
    FW_TRY(note_stated(&r->problem, &stated));
    for (int i = 0; i < m->nq; i++)
        v[i] = given[i] = loads->velocity[i] * s.time_s / (i % 3 == 2 ? 1 : s.length_m);
    FW_TRY(closed_system(r, loads, &closed));
    memcpy(r->record.kept, r->problem.start, (size_t)m->nq * sizeof(double));
    bool good = before_start(r, closed, stated, closed == sys);
    if (closed != sys) {
        if (good && closed->loading.driven && contradicted(m->nq, stated, given, v))
            good = before_start(r, closed, stated, true);
        if (!good) { /* pins stay open */
            memcpy(r->problem.start, r->record.kept, (size_t)m->nq * sizeof(double));
            FW_TRY(settle(r));
        }
        bool gives = !good || contradicted(m->nq, stated, given, v);
        if (gives) FW_TRY(give_way(r, stated, given, v));
        good = onto_joints(sys, stated, gives ? given : NULL, r->problem.start, v, r->record.rate);
    }
    if (!good) return cannot_start(r);
    warn_velocities(r, stated, given, v);
    fw_multibody_set_switches(sys, 0, r->problem.start);
    FW_TRY(fw_dynamics_run_valid(r, 0, r->problem.start));
    fw_multibody_friction_begin(sys);
    if (fw_multibody_friction_decide(sys, 0, r->problem.start)) return FW_OK;
    FW_TRY(fw_dynamics_run_jammed(r, 0));
    return cannot_start(r);
}

fw_status fw_dynamics_run_prepare(fw_dynamics_run *r, const fw_effects_loads *loads) {
    FW_TRY(fw_dynamics_run_pieces(&r->problem, loads));
    FW_TRY(start_values(r, loads));
    return motion_size(&r->problem, loads);
}

/* ---- memory ---- */

static fw_status result_arrays(const fw_dynamics_problem *problem, fw_dynamics_motion *m) {
    const fw_mechanism *from = problem->mechanism;
    fw_arena *arena = problem->arena;
    int samples = problem->options->samples;
    size_t rows = (size_t)samples, n = 3 * (size_t)from->nbody, pins = (size_t)from->npin;
    m->nbody = from->nbody, m->npin = from->npin;
    m->njoint = from->njoint, m->ndriver = from->ndriver;
    m->nsample = samples;
    if (rows > ((size_t)1 << 40) / (n + pins + 1)) return FW_LIMIT;
    FW_NEED(m->t_s = fw_arena_array(arena, double, rows));
    FW_NEED(m->q = fw_arena_array(arena, double, rows *n));
    FW_NEED(m->v = fw_arena_array(arena, double, rows *n));
    FW_NEED(m->accel = fw_arena_array(arena, double, rows *n));
    FW_NEED(m->angle_rad = fw_arena_array(arena, double, rows *pins));
    FW_NEED(m->reaction_N = fw_arena_array(arena, double, rows * 2 * pins));
    FW_NEED(m->joint_N = fw_arena_array(arena, double, rows * 3 * (size_t)from->njoint));
    FW_NEED(m->driver_N = fw_arena_array(arena, double, rows *(size_t)from->ndriver));
    FW_NEED(m->peak = fw_arena_array(arena, fw_dynamics_peak, pins));
    if (!problem->options->energies) return FW_OK;
    FW_NEED(m->energy_J = fw_arena_array(arena, double, 4 * rows));
    FW_NEED(m->constraint_norm = fw_arena_array(arena, double, rows));
    return FW_OK;
}

static fw_status recorder_arrays(fw_dynamics_recorder *record) {
    const fw_dynamics_problem *problem = record->problem;
    fw_arena *arena = problem->arena;
    size_t pins = (size_t)problem->mechanism->npin;
    size_t ny = (size_t)problem->model->ny, n = (size_t)problem->model->nq;
    FW_NEED(record->state = fw_arena_array(arena, double, ny));
    FW_NEED(record->rate = fw_arena_array(arena, double, ny));
    FW_NEED(record->kept = fw_arena_array(arena, double, n));
    FW_NEED(record->seen_q = fw_arena_array(arena, double, FW_THIRDS *n));
    FW_NEED(record->seen_angle = fw_arena_array(arena, double, FW_THIRDS *pins));
    size_t forces = 2 * pins;
    if (problem->options->whole) {
        forces += 3 * (size_t)problem->mechanism->njoint + (size_t)problem->mechanism->ndriver;
        FW_NEED(record->seen_v = fw_arena_array(arena, double, FW_THIRDS *n));
    }
    record->seen_forces = (int)forces;
    FW_NEED(record->seen_force = fw_arena_array(arena, double, FW_THIRDS *forces));
    FW_NEED(record->seen_grid = fw_arena_array(arena, double, (FW_GRID + 1) * forces));
    FW_NEED(record->seen_piece = fw_arena_array(arena, double, FW_PIECE_NODES *n));
    return problem->options->reactions ? fw_dynamics_run_extremes_new(record) : FW_OK;
}

static fw_status controller_arrays(fw_dynamics_controller *control) {
    const fw_multibody_model *model = control->problem->model;
    fw_arena *arena = control->problem->arena;
    size_t friction = (size_t)model->nfriction;
    size_t entries = (size_t)fw_multibody_switch_count(model) + friction;
    FW_NEED(control->moved = fw_arena_array(arena, double, (size_t)model->ny));
    FW_NEED(control->fit = fw_arena_array(arena, double, (FW_PLACES + 1) * entries));
    FW_NEED(control->unfit = fw_arena_array(arena, bool, entries));
    FW_NEED(control->friction_fit = fw_arena_array(arena, double, friction));
    return fw_dynamics_near_zero_new(control);
}

fw_status fw_dynamics_run_arrays(fw_dynamics_run *r) {
    fw_dynamics_problem *problem = &r->problem;
    FW_TRY(result_arrays(problem, r->record.motion));
    FW_NEED(problem->start = fw_arena_array(problem->arena, double, (size_t)problem->model->ny));
    FW_TRY(recorder_arrays(&r->record));
    return controller_arrays(&r->control);
}
