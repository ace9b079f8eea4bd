/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read off the steps: evenly spaced rows, the observer's instants. All from the dense
   output; rows are projected like accepted steps, at once or when somebody reads them. */
#include "multibody/system.h"
#include "dynamics/run.h"
#include <math.h>
#include <string.h>

/* A copy of what a row needs, of a run that is over by then. What waits stands in q and v, scaled
   as it was integrated. */
typedef struct fw_dynamics_late {
    fw_dynamics_problem problem;
    fw_dynamics_motion_options options;
    fw_dynamics_recorder record;
    bool *waits; /* (nsample) */
} fw_dynamics_late;

/* state y in SI: pose and joint angles */
static void pose_in_SI(const fw_dynamics_problem *problem, const double *y, double *q,
                       double *angle) {
    const fw_multibody_model *m = problem->model;
    for (int i = 0; i < m->nq; i++)
        q[i] = problem->q0[i] + (i % 3 == 2 ? 1 : m->scale.length_m) * y[i];
    for (int i = 0; i < problem->mechanism->npin; i++) {
        const fw_mechanism_pin *p = &problem->mechanism->pin[i];
        angle[i] = (p->body_b == FW_GROUND ? 0 : q[3 * p->body_b + 2]) -
                   (p->body_a == FW_GROUND ? 0 : q[3 * p->body_a + 2]) - p->free_angle_rad;
    }
}

static void store_energy(fw_dynamics_recorder *record, size_t row, double t, const double *y) {
    const fw_multibody_model *m = record->problem->model;
    fw_multibody_system *sys = record->problem->system;
    double speed = m->scale.length_m / m->scale.time_s, joule = m->scale.mass_kg * speed * speed;
    const fw_multibody_energy e = fw_multibody_energy_at(sys, t, y);
    double *out = record->motion->energy_J + 4 * row;
    out[0] = joule * e.kinetic, out[1] = joule * e.elastic;
    out[2] = joule * e.dissipated, out[3] = joule * e.work;
    record->motion->constraint_norm[row] =
        fw_multibody_residual(sys, fw_multibody_pose_at(sys, t, y), NULL);
}

static void store(fw_dynamics_recorder *record, double t_s, double t, const double *y) {
    fw_dynamics_motion *out = record->motion;
    const fw_multibody_model *m = record->problem->model;
    const fw_multibody_scale s = m->scale;
    size_t row = (size_t)record->row, base = row * (size_t)m->nq;
    out->t_s[row] = t_s;
    pose_in_SI(record->problem, y, out->q + base, out->angle_rad + row * (size_t)out->npin);
    const fw_multibody_solution *found =
        fw_multibody_react(record->problem->system, t, y, record->rate);
    for (int i = 0; i < m->nq; i++) {
        double unit = (i % 3 == 2 ? 1 : s.length_m) / s.time_s;
        out->v[base + (size_t)i] = unit * y[m->nq + i];
        out->accel[base + (size_t)i] = unit / s.time_s * record->rate[m->nq + i];
    }
    fw_multibody_pin_forces(m, found, out->reaction_N + row * 2 * (size_t)out->npin);
    fw_multibody_joint_forces(m, found, record->problem->mechanism,
                              out->joint_N + row * 3 * (size_t)out->njoint,
                              out->driver_N + row * (size_t)out->ndriver);
    if (out->energy_J) store_energy(record, row, t, y);
    if (out->late) out->late->waits[row] = false;
    record->row++;
}

static double sample_time(const fw_dynamics_recorder *record, int row) {
    int last = record->motion->nsample - 1;
    return row == last ? record->problem->scene->duration_s
                       : record->problem->scene->duration_s * row / (last > 0 ? last : 1);
}

static void first_sample(fw_dynamics_recorder *record, const double *y) {
    record->row = 0;
    if (record->motion->nsample > 0) store(record, 0, 0, y);
}

/* onto the constraints, as accepted steps are; without projection as it is. A step that cannot be
   projected is made shorter, but a row lies where it was asked for: where that is so near a
   singular position that Newton's method goes astray, the row stays as integrated, within the
   tolerance, and the constraint norm tells. */
static bool settle(fw_dynamics_recorder *record, double t, double *y) {
    fw_multibody_system *sys = record->problem->system;
    size_t bytes = (size_t)sys->model->nq * sizeof *y;
    if (!sys->projecting) return true;
    memcpy(record->kept, y, bytes);
    const fw_multibody_pose *pose = fw_multibody_close_position(sys, t, y);
    if (!pose) {
        memcpy(y, record->kept, bytes);
        pose = fw_multibody_pose_at(sys, t, y);
        double norm = fw_multibody_residual(sys, pose, NULL);
        if (!(norm < (double)INFINITY)) return false;
        sys->record.worst_position = fmax(sys->record.worst_position, norm);
    }
    const fw_multibody_factor *factor = fw_multibody_factorise(sys, pose);
    return factor && fw_multibody_project_velocity(sys, factor, y + sys->model->nq);
}

/* ---- rows that wait ---- */

/* The forces of a kernel are constant: a row is a matter of its own state alone. */
fw_status fw_dynamics_record_late(fw_dynamics_recorder *record) {
    const fw_multibody_system *sys = record->problem->system;
    fw_arena *arena = record->problem->arena;
    if (!sys->kernel || !sys->projecting || record->motion->energy_J) return FW_OK;
    fw_dynamics_late *late = fw_arena_one(arena, fw_dynamics_late);
    FW_NEED(late);
    FW_NEED(late->waits = fw_arena_array(arena, bool, (size_t)record->motion->nsample));
    late->problem = *record->problem;
    late->options = *record->problem->options;
    late->problem.options = &late->options;
    late->record = *record;
    late->record.problem = &late->problem;
    record->motion->late = late;
    return FW_OK;
}

void fw_dynamics_record_waits(fw_dynamics_recorder *record, int row, bool waits) {
    if (record->motion->late) record->motion->late->waits[row] = waits;
}

static void wait(fw_dynamics_recorder *record, double t_s) {
    fw_dynamics_motion *out = record->motion;
    size_t n = (size_t)record->problem->model->nq, base = (size_t)record->row * n;
    memcpy(out->q + base, record->state, n * sizeof *out->q);
    memcpy(out->v + base, record->state + n, n * sizeof *out->v);
    out->t_s[record->row] = t_s;
    out->late->waits[record->row++] = true;
}

/* one that cannot be projected stays as it was integrated */
static void catch_up(fw_dynamics_late *late, const fw_dynamics_motion *motion, int row) {
    fw_dynamics_recorder *record = &late->record;
    size_t n = (size_t)late->problem.model->nq, base = (size_t)row * n;
    double t_s = motion->t_s[row], t = t_s / late->problem.model->scale.time_s;
    memset(record->state, 0, (size_t)late->problem.model->ny * sizeof *record->state);
    memcpy(record->state, motion->q + base, n * sizeof *motion->q);
    memcpy(record->state + n, motion->v + base, n * sizeof *motion->v);
    settle(record, t, record->state);
    record->row = row;
    store(record, t_s, t, record->state);
}

void fw_dynamics_motion_rows(const fw_dynamics_motion *motion, int first, int count) {
    fw_dynamics_late *late = motion->late;
    for (int row = first; late && row < first + count; row++)
        if (row >= 0 && row < motion->nsample && late->waits[row]) catch_up(late, motion, row);
}

bool fw_dynamics_motion_waits(const fw_dynamics_motion *motion, int row) {
    return motion->late && motion->late->waits[row];
}

void fw_dynamics_motion_pose(const fw_dynamics_motion *motion, int row, double *q) {
    const size_t n = 3 * (size_t)motion->nbody;
    const double *kept = motion->q + (size_t)row * n;
    memcpy(q, kept, n * sizeof *q);
    if (!fw_dynamics_motion_waits(motion, row)) return;
    const fw_dynamics_problem *problem = &motion->late->problem;
    for (size_t i = 0; i < n; i++)
        q[i] = problem->q0[i] + (i % 3 == 2 ? 1 : problem->model->scale.length_m) * kept[i];
}

void fw_dynamics_motion_rows_at(const fw_dynamics_motion *motion, double t_s) {
    if (!motion->late || motion->nsample < 1) return;
    double each =
        motion->late->problem.scene->duration_s / fmax(1, motion->late->options.samples - 1);
    fw_dynamics_motion_rows(motion, (int)fmin(t_s / each, motion->nsample) - 1, 4);
}

static bool samples(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta_end) {
    const fw_multibody_model *m = record->problem->model;
    double reached = theta_end < 1 ? s->t_old + theta_end * s->h : s->t;
    double final = fw_dynamics_end(record->problem);
    for (; record->row < record->motion->nsample;) {
        double t_s = sample_time(record, record->row), t = t_s / m->scale.time_s;
        bool end = record->row == record->motion->nsample - 1;
        if (end ? reached < final : t > reached) return true;
        if (theta_end == 1 && (t >= s->t || end)) {
            store(record, t_s, s->t, s->y);
            continue;
        }
        fw_maths_stepper_dense(s, fmin(theta_end, (t - s->t_old) / s->h), record->state);
        if (record->motion->late) {
            wait(record, t_s);
            continue;
        }
        if (!settle(record, t, record->state)) return false;
        store(record, t_s, t, record->state);
    }
    return true;
}

/* who looks at this run, NULL: nobody */
static fw_dynamics_observer observer(const fw_dynamics_recorder *record, void **context) {
    *context = record->full ? record->motion->observed : record->motion->compared;
    return record->full || *context ? record->problem->options->observe : NULL;
}

/* who wants its pieces, NULL: nobody */
static fw_dynamics_tracer tracer(const fw_dynamics_recorder *record, void **context) {
    const fw_dynamics_motion_options *o = record->problem->options;
    return observer(record, context) && (record->full || o->trace_both) ? o->trace : NULL;
}

bool fw_dynamics_record_is_observed(const fw_dynamics_recorder *record) {
    void *context;
    return observer(record, &context) != NULL;
}

bool fw_dynamics_record_is_traced(const fw_dynamics_recorder *record) {
    void *context;
    return tracer(record, &context) != NULL;
}

static void show_start(fw_dynamics_recorder *record) {
    void *context;
    fw_dynamics_observer see = observer(record, &context);
    if (see) see(context, NULL);
    fw_dynamics_tracer trace = tracer(record, &context);
    if (trace) trace(context, NULL);
}

/* of pins; of whole instants those of joints and drivers behind them */
static void forces_at(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta,
                      double *force) {
    const fw_multibody_model *m = record->problem->model;
    fw_maths_stepper_dense(s, theta, record->state);
    const fw_multibody_solution *found = fw_multibody_react(
        record->problem->system, s->t_old + theta * s->h, record->state, record->rate);
    fw_multibody_pin_forces(m, found, force);
    if (!record->seen_v) return;
    double *joint = force + 2 * m->npin;
    fw_multibody_joint_forces(m, found, record->problem->mechanism, joint, joint + 3 * m->njoint);
}

static void velocities_in_SI(const fw_dynamics_problem *problem, const double *y, double *v) {
    const fw_multibody_model *m = problem->model;
    for (int i = 0; v && i < m->nq; i++)
        v[i] = (i % 3 == 2 ? 1 : m->scale.length_m) / m->scale.time_s * y[m->nq + i];
}

/* Where states are interpolated between a method's own ones, stiff axes make large forces of the
   error of that: forces are then interpolated instead, between those of the own states */
static bool own_forces(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta_end,
                       fw_dynamics_grid *g) {
    if (!s->row->own) return false;
    size_t count = (size_t)record->seen_forces;
    fw_dynamics_run_places(s, theta_end, g);
    for (int k = 0; k <= g->last; k++)
        forces_at(record, s, theta_end * g->at[k], record->seen_grid + (size_t)k * count);
    return true;
}

/* the step that is looked at: forces between a method's own places where it has such */
typedef struct looked_at {
    fw_dynamics_recorder *record;
    fw_maths_stepper *stepper;
    double theta_end;
    fw_dynamics_grid grid;
    bool own;
    const fw_dynamics_shown *again; /* as it was shown before; NULL: it is new */
} looked_at;

static fw_dynamics_instant instant_of(const fw_dynamics_recorder *record, double t_s,
                                      const double *q, const double *angle, const double *force,
                                      const double *v) {
    const fw_dynamics_problem *problem = record->problem;
    const double *joint = v ? force + 2 * problem->mechanism->npin : NULL;
    return (fw_dynamics_instant){.t_s = t_s,
                                 .q = q,
                                 .angle_rad = angle,
                                 .reaction_N = force,
                                 .hinge = record->motion->ledger.hinge.used,
                                 .piece_s = problem->system->piece_s,
                                 .loads = record->motion->loads,
                                 .v = v,
                                 .on = v ? problem->system->on.element : NULL,
                                 .joint_N = joint,
                                 .driver_N = joint ? joint + 3 * problem->mechanism->njoint : NULL};
}

/* in the slot-th of the recorder's arrays */
static fw_dynamics_instant instant_at(looked_at *l, int i, size_t slot) {
    fw_dynamics_recorder *record = l->record;
    const fw_dynamics_problem *problem = record->problem;
    size_t n = (size_t)problem->model->nq, pins = (size_t)problem->mechanism->npin;
    const fw_dynamics_shown *was = l->again;
    if (was)
        return instant_of(record, was->t_s[i], was->q + (size_t)i * n,
                          was->angle_rad + (size_t)i * pins, was->reaction_N + (size_t)i * 2 * pins,
                          NULL);
    double part = (double)i / FW_INSTANTS, theta = l->theta_end * i / FW_INSTANTS;
    double *q = record->seen_q + slot * n, *angle = record->seen_angle + slot * pins;
    int count = record->seen_forces;
    double *force = record->seen_force + slot * (size_t)count;
    double *v = record->seen_v ? record->seen_v + slot * n : NULL;
    if (l->own)
        fw_maths_stepper_dense(l->stepper, theta, record->state);
    else
        forces_at(record, l->stepper, theta, force);
    for (int k = 0; l->own && k < count; k++)
        force[k] = fw_dynamics_run_between(&l->grid, record->seen_grid + k, count, part);
    pose_in_SI(problem, record->state, q, angle);
    velocities_in_SI(problem, record->state, v);
    return instant_of(record,
                      (l->stepper->t_old + theta * l->stepper->h) * problem->model->scale.time_s, q,
                      angle, force, v);
}

static void look(looked_at *l, bool fresh) {
    void *context;
    const fw_dynamics_observer see = observer(l->record, &context);
    const fw_dynamics_glance glance = l->record->problem->options->glance;
    if (glance && !fresh) {
        fw_dynamics_instant third[FW_THIRDS];
        for (int i = 0; i < FW_THIRDS; i++)
            third[i] = instant_at(l, (i + 1) * FW_INSTANTS / FW_THIRDS, (size_t)i);
        if (glance(context, third)) return;
    }
    for (int i = fresh ? 0 : 1; i <= FW_INSTANTS; i++) {
        fw_dynamics_instant now = instant_at(l, i, 0);
        now.begins = fresh && i == 0;
        see(context, &now);
    }
}

/* room for what one more step shows; false: it is not kept */
static bool add_shown(fw_dynamics_recorder *record) {
    fw_dynamics_tape *tape = record->tape;
    if (!tape || tape->torn) return false;
    const size_t n = (size_t)record->problem->model->nq, all = FW_INSTANTS + 1,
                 pins = (size_t)record->problem->mechanism->npin;
    fw_dynamics_shown *own = fw_arena_one(tape->arena, fw_dynamics_shown);
    if (own) {
        own->t_s = fw_arena_array(tape->arena, double, all);
        own->q = fw_arena_array(tape->arena, double, all *n);
        own->angle_rad = fw_arena_array(tape->arena, double, all *pins);
        own->reaction_N = fw_arena_array(tape->arena, double, all * 2 * pins);
    }
    tape->torn = !own || !own->t_s || !own->q || !own->angle_rad || !own->reaction_N;
    if (tape->torn) return false;
    if (tape->last)
        tape->last->next = own;
    else
        tape->first = own;
    tape->last = own;
    return true;
}

/* all that may be looked at in this step, for those who look at it another time */
static void keep(looked_at *l, bool fresh) {
    const fw_dynamics_problem *problem = l->record->problem;
    size_t n = (size_t)problem->model->nq, pins = (size_t)problem->mechanism->npin;
    if (!add_shown(l->record)) return;
    fw_dynamics_shown *to = l->record->tape->last;
    to->fresh = fresh;
    for (int i = fresh ? 0 : 1; i <= FW_INSTANTS; i++) {
        const fw_dynamics_instant now = instant_at(l, i, 0);
        to->t_s[i] = now.t_s;
        memcpy(to->q + (size_t)i * n, now.q, n * sizeof *now.q);
        memcpy(to->angle_rad + (size_t)i * pins, now.angle_rad, pins * sizeof *now.q);
        memcpy(to->reaction_N + (size_t)i * 2 * pins, now.reaction_N, 2 * pins * sizeof *now.q);
    }
}

/* a law has one smooth piece in it, which its middle says; the jumps of equilibria go with no time */
double fw_dynamics_piece_node(const fw_dynamics_piece *piece, int nbody, int node, double *q) {
    const size_t n = 3 * (size_t)nbody;
    const double *from = piece->q + (size_t)node * n, length_s = piece->to_s - piece->from_s;
    memcpy(q, from, n * sizeof *q);
    if (!fw_effects_has_growth(piece->loads)) return 0;
    const fw_effects_growth growth = fw_effects_growth_at(
        piece->mechanism, piece->loads, piece->from_s + length_s * node / (piece->nodes - 1),
        piece->from_s + 0.5 * length_s, true);
    return fw_effects_on_substrate(&growth, nbody, from, q);
}

static void keep_piece(fw_dynamics_tape *tape, const fw_dynamics_piece *piece, size_t n) {
    if (!tape || tape->torn || !tape->last) return;
    double *q = fw_arena_array(tape->arena, double, (size_t)piece->nodes *n);
    tape->torn = !q;
    if (!q) return;
    memcpy(q, piece->q, (size_t)piece->nodes * n * sizeof *q);
    tape->last->piece = *piece;
    tape->last->piece.q = q;
}

static void observe_step(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta_end) {
    if (!fw_dynamics_record_is_observed(record)) return;
    bool fresh = record->fresh || !(s->t_old > 0);
    looked_at l = {.record = record, .stepper = s, .theta_end = theta_end};
    l.own = own_forces(record, s, theta_end, &l.grid);
    record->fresh = false;
    keep(&l, fresh);
    look(&l, fresh);
}

/* The dense output of a step as polynomials: interpolated exactly by as many values as its degree
   asks for, of each part where it is made of several. */
static void trace_step(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta_end) {
    const fw_dynamics_problem *problem = record->problem;
    const fw_maths_stepper_row *row = s->row;
    void *context;
    size_t n = (size_t)problem->model->nq;
    int parts = row->dense_parts > 0 ? row->dense_parts : 1;
    int nodes = row->dense_order_u > 5 ? FW_PIECE_NODES : 6; /* quintics at most */
    fw_dynamics_tracer trace = tracer(record, &context);
    if (!trace) return;
    for (int k = 0; k < parts; k++) {
        double from = (double)k / parts, to = fmin(theta_end, (k + 1.0) / parts);
        if (!(to > from)) return;
        for (int i = 0; i < nodes; i++) {
            double theta = from + (to - from) * i / (nodes - 1);
            fw_maths_stepper_dense(s, theta, record->state);
            pose_in_SI(problem, record->state, record->seen_piece + (size_t)i * n,
                       record->seen_angle);
        }
        double unit = problem->model->scale.time_s;
        const fw_dynamics_piece piece = {.from_s = (s->t_old + from * s->h) * unit,
                                         .to_s = (s->t_old + to * s->h) * unit,
                                         .nodes = nodes,
                                         .q = record->seen_piece,
                                         .loads = record->motion->loads,
                                         .mechanism = problem->mechanism};
        keep_piece(record->tape, &piece, n);
        trace(context, &piece);
    }
}

/* ---- energy ---- */

static void watch_energy(fw_dynamics_recorder *record, double t, const double *y) {
    fw_multibody_energy e = fw_multibody_energy_at(record->problem->system, t, y);
    double balance = e.kinetic + e.elastic + e.dissipated - e.work;
    double start = record->first.kinetic + record->first.elastic + record->first.dissipated -
                   record->first.work;
    record->drift = fmax(record->drift, fabs(balance - start));
    /* what electrodes store is below 0 */
    record->largest =
        fmax(record->largest, fmax(e.kinetic + fabs(e.elastic) + e.dissipated, fabs(e.work)));
}

static void first_energy(fw_dynamics_recorder *record, const double *y) {
    record->first = fw_multibody_energy_at(record->problem->system, 0, y);
    record->drift = 0;
    record->largest = record->first.kinetic + fabs(record->first.elastic);
}

/* ---- all of it ---- */

void fw_dynamics_record_again(fw_dynamics_recorder *record, const fw_dynamics_shown *first) {
    void *context;
    const fw_dynamics_tracer trace = tracer(record, &context);
    show_start(record);
    for (const fw_dynamics_shown *step = first; step; step = step->next) {
        look(&(looked_at){.record = record, .again = step}, step->fresh);
        fw_dynamics_piece piece = step->piece; /* shown to a run of its own loads */
        piece.loads = record->motion->loads, piece.mechanism = record->problem->mechanism;
        if (trace) trace(context, &piece);
    }
    record->fresh = false;
}

void fw_dynamics_record_begin(fw_dynamics_recorder *record, const double *y) {
    show_start(record);
    if (!record->full) return;
    first_energy(record, y);
    first_sample(record, y);
}

bool fw_dynamics_record_step(fw_dynamics_recorder *record, fw_maths_stepper *s,
                             fw_dynamics_peaks *peaks, double theta_end) {
    const fw_dynamics_problem *problem = record->problem;
    fw_dynamics_peaks_mark(peaks, problem->model, s, theta_end, fw_dynamics_end(problem),
                           record->state);
    fw_dynamics_peaks_step(peaks, problem->model, s, theta_end);
    fw_dynamics_run_extremes(record, s, theta_end);
    if (record->full && theta_end == 1) watch_energy(record, s->t, s->y);
    observe_step(record, s, theta_end);
    trace_step(record, s, theta_end);
    return !record->full || samples(record, s, theta_end);
}

void fw_dynamics_record_end(fw_dynamics_recorder *record, bool early, double t) {
    const fw_dynamics_problem *problem = record->problem;
    if (!record->full) return;
    record->motion->ended = early;
    record->motion->end_s = early ? t * problem->model->scale.time_s : problem->scene->duration_s;
    record->motion->nsample = record->row;
}
