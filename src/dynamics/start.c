/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What must be known before the first step. */
#include "dynamics/run.h"
#include "base/sort.h"
#include "quantity/law_kind.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *scene_name(const fw_run *r) {
    return r->scene->name ? r->scene->name : "(unnamed)";
}

/* ---- smooth pieces between the breaks of all laws ---- */

static int law_count(const fw_run *r, const fw_terms *terms) {
    int count = terms->ntimed + r->mechanism->ndriver + (terms->stretch.law != NULL);
    for (int i = 0; i < terms->nelement; i++)
        count += terms->element[i].laws;
    return count;
}

/* the i-th law of all: of timed loads, drivers, the stretching ground, elements; *coordinate: it
   drives a joint. NULL: constant */
static const fw_law *law_of(const fw_run *r, const fw_terms *terms, int i, bool *coordinate) {
    int drivers = r->mechanism->ndriver, moving = drivers + (terms->stretch.law != NULL);
    *coordinate = i >= terms->ntimed && i < terms->ntimed + moving;
    if (i < terms->ntimed) return terms->timed[i].law;
    if (*coordinate && i == terms->ntimed + drivers) return terms->stretch.law;
    if (*coordinate) return &r->mechanism->driver[i - terms->ntimed].law;
    const fw_force_element *e = terms->element;
    for (i -= terms->ntimed + moving; i >= e->laws; e++)
        i -= e->laws;
    return e->law[i];
}

/* the breaks of every law, one law after the other (at, counted), and the strides between them */
static fw_status look_at_laws(fw_run *r, const fw_terms *terms, double *at, int count) {
    int laws = law_count(r, terms), have = 0;
    double end = r->scene->duration_s;
    bool coordinate;
    FW_NEED(r->stride = fw_arena_array(r->arena, fw_law_strides, (size_t)laws));
    FW_NEED(r->stride_row = fw_arena_array(r->arena, int, (size_t)laws));
    for (int i = 0; i < laws; i++) {
        const fw_law *law = law_of(r, terms, i, &coordinate);
        fw_law_strides *own = &r->stride[r->nstride];
        int breaks = fw_law_breaks(law, end, at + have, count - have);
        fw_sort_doubles(at + have, (size_t)breaks);
        FW_TRY(fw_law_look(r->arena, law, coordinate, end, at + have, breaks, own));
        have += breaks;
        bool limits = false;
        for (int k = 0; k < own->n; k++)
            if (isfinite(own->most_s[k])) limits = true;
        if (limits && !(fw_quantity_law_wave_of(law).fastest_Hz > 0)) r->sudden = true;
        if (limits) r->nstride++;
    }
    return FW_OK;
}

double fw_run_stride(const fw_run *r, double factor, double t) {
    double most = (double)INFINITY, unit = r->model->scale.time_s;
    for (int i = 0; i < r->nstride; i++)
        most = fmin(most, fw_law_stride(&r->stride[i], factor, t * unit, &r->stride_row[i]));
    return most / unit;
}

static fw_status pieces(fw_run *r, const fw_terms *terms) {
    int laws = law_count(r, terms), have = 0;
    double end = r->scene->duration_s, unit = r->model->scale.time_s;
    bool coordinate;
    for (int i = 0; i < laws; i++)
        have += fw_law_breaks(law_of(r, terms, i, &coordinate), end, NULL, 0);
    double *at;
    FW_NEED(at = fw_arena_array(r->arena, double, (size_t)have + 1));
    FW_TRY(look_at_laws(r, terms, at, have));
    fw_sort_doubles(at, (size_t)have);
    int kept = 0;
    for (int i = 0; i < have; i++)
        if (at[i] > 0 && at[i] < end && (kept == 0 || at[i] > at[kept - 1])) at[kept++] = at[i];
    at[kept++] = end;
    for (int i = 0; i < kept; i++)
        at[i] /= unit;
    r->end = at;
    r->npiece = kept;
    r->model->piece = 0.5 * at[0] * unit;
    return FW_OK;
}

/* ---- size of the motion ---- */

/* in scaled units, at most 1: twice the linear static response to what acts, and the starting
   velocity, or the strain of the ground; 1 when the mechanism can move freely or is driven */
static fw_status motion_size(fw_run *r, const fw_terms *terms) {
    const fw_mechanism *m = r->mechanism;
    size_t n = 3 * (size_t)m->nbody;
    double *force, *displacement, *rotation, size = 0, speed = 0;
    r->amplitude = 1;
    if (m->ndriver > 0) return FW_OK;
    if (terms->stretch.law)
        size =
            fabs(terms->stretch.strain) * fw_law_largest(terms->stretch.law, r->scene->duration_s);
    fw_mark mark = fw_arena_mark(r->arena);
    bool valid = false;
    FW_NEED(force = fw_arena_array(r->arena, double, n));
    FW_NEED(displacement = fw_arena_array(r->arena, double, n));
    FW_NEED(rotation = fw_arena_array(r->arena, double, (size_t)m->npin));
    fw_terms_largest_force(m, terms, r->scene->duration_s, force);
    FW_TRY(fw_static_response(r->arena, m, terms, force, displacement, rotation, &valid));
    const fw_scale s = r->model->scale;
    for (size_t i = 0; i < n; i++) {
        double unit = i % 3 == 2 ? 1 : s.length_m;
        if (valid) size = fmax(size, 2 * fabs(displacement[i]) / unit);
        speed = fmax(speed, fabs(r->start[n + i]));
    }
    fw_arena_rewind(r->arena, mark);
    size = fmax(size, speed);
    if (valid && size > 0) r->amplitude = fmin(1, size);
    return FW_OK;
}

/* ---- start values ---- */

/* does the scene state component c (x, y, turn) of a body's velocity? */
static bool stated(const fw_run *r, int body, int c) {
    return r->stated[3 * body + c];
}

/* One look at every <initial>, not one per coordinate: large models state thousands. */
static fw_status note_stated(fw_run *r) {
    FW_NEED(r->stated = fw_arena_array(r->arena, bool, (size_t)r->model->nq));
    for (int i = r->scene->ninitial - 1; i >= 0; i--) { /* the first of a body counts */
        const fw_initial *v = &r->scene->initial[i];
        if (v->body == FW_GROUND) continue;
        for (int c = 0; c < 3; c++)
            r->stated[3 * v->body + c] = !(c < 2 ? v->moves_free : v->turns_free);
    }
    return FW_OK;
}

/* one correction v += M^-1 G^T lambda onto G v = -Psi_t with the masses as they are now */
static bool correct_velocity(fw_run *r, double *v) {
    fw_model *m = r->model;
    fw_chain_assemble(m);
    if (!fw_chain_factor(&m->chain, fw_epsilon)) return false;
    fw_model_jacobian(m, v, m->right);
    fw_model_drift(m, 0, m->drift);
    for (int i = 0; i < 2 * m->nblock; i++)
        m->right[i] += m->drift[i];
    fw_chain_proximal(m, m->right, m->lambda);
    fw_model_apply(m, m->lambda, v);
    return true;
}

/* What <initial> does not state follows what it does: the correction is found with masses and
   inertias a million times smaller there, thrice, each time from the velocities that were stated,
   so that what is stated and fits stays to 1e-18. Posed model; v (3 nbody). */
static bool follow_stated(fw_run *r, const double *given, double *v) {
    fw_model *m = r->model;
    double *minv = r->rate, *jinv = r->rate + m->nbody;
    int count = 0;
    bool good = true;
    for (int i = 0; i < m->nq; i++)
        count += stated(r, i / 3, i % 3);
    if (count == 0 || count == m->nq) return true;
    memcpy(minv, m->minv, (size_t)m->nbody * sizeof *minv);
    memcpy(jinv, m->jinv, (size_t)m->nbody * sizeof *jinv);
    for (int b = 0; b < m->nbody; b++) {
        if (!stated(r, b, 0)) m->minv[b] *= 1e6;
        if (!stated(r, b, 2)) m->jinv[b] *= 1e6;
    }
    for (int pass = 0; pass < 3 && good; pass++) {
        for (int i = 0; i < m->nq; i++)
            if (stated(r, i / 3, i % 3)) v[i] = given[i];
        good = correct_velocity(r, v);
    }
    memcpy(m->minv, minv, (size_t)m->nbody * sizeof *minv);
    memcpy(m->jinv, jinv, (size_t)m->nbody * sizeof *jinv);
    return good;
}

static void warn_velocities(fw_run *r, const double *given, const double *v) {
    double size = 0, moved = 0;
    for (int i = 0; i < r->model->nq; i++) {
        size = fmax(size, fabs(given[i]));
        if (stated(r, i / 3, i % 3)) moved = fmax(moved, fabs(v[i] - given[i]));
    }
    r->motion->stats.velocity_moved = size > 0 ? moved / size : 0;
    if (!(size > 0 && moved > 1e-6 * size)) return;
    double before = fw_model_kinetic(r->model, given), after = fw_model_kinetic(r->model, v);
    char most[32], energy[32];
    fw_diag_warning(r->diags, 106, r->scene->place,
                    "initial velocities of scene %s contradict the joints; they were changed by up "
                    "to %s %% to fit, the kinetic energy by %s %%",
                    scene_name(r), fw_number_text(most, sizeof most, 100 * moved / size, 3),
                    fw_number_text(energy, sizeof energy, 100 * (after - before) / before, 3));
}

static fw_status cannot_start(const fw_run *r) {
    fw_status status =
        fw_diag_error(r->diags, 109, r->scene->place,
                      "method %s cannot start scene %s: its equations are singular in the "
                      "assembled position; use --method chain",
                      r->model->method->name, scene_name(r));
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* Velocities start as if all pins were joints, also those that elements stand for: they then start
   without a stretch and without its rate, whatever the scene states. */
static fw_status closed_model(fw_run *r, const fw_terms *terms, fw_model **closed) {
    fw_terms all = *terms;
    *closed = r->model;
    if (r->model->nreleased == 0) return FW_OK;
    all.released = NULL;
    FW_TRY(fw_model_new(r->arena, r->mechanism, &all, r->q0, r->scene->duration_s, NULL, r->diags,
                        closed));
    (*closed)->piece = r->model->piece;
    return FW_OK;
}

/* r->start onto the joints of r->model, v too; given: and as near to that as they allow */
static bool onto_joints(fw_run *r, const double *given, double *v) {
    fw_model *m = r->model;
    fw_model_pose(m, r->start);
    if (!m->method->factor(m) || !fw_model_project_position(m, 0, r->start)) return false;
    fw_model_pose(m, r->start);
    if (given && !follow_stated(r, given, v)) return false;
    return m->method->factor(m) && fw_model_impact(m, 0, v);
}

/* assembled pose, initial velocities moved onto G v = -Psi_t; says so when they contradicted the
   joints */
static fw_status start_values(fw_run *r, const fw_terms *terms) {
    fw_model *m = r->model, *closed;
    const fw_scale s = m->scale;
    double *v = r->start + m->nq, *given = r->state;
    FW_TRY(note_stated(r));
    for (int i = 0; i < m->nq; i++)
        v[i] = given[i] = terms->velocity[i] * s.time_s / (i % 3 == 2 ? 1 : s.length_m);
    FW_TRY(closed_model(r, terms, &closed));
    r->model = closed;
    bool good = onto_joints(r, given, v);
    r->model = m;
    if (good && closed != m) good = onto_joints(r, NULL, v);
    if (!good) return cannot_start(r);
    warn_velocities(r, given, v);
    fw_model_set_switches(m, 0, r->start);
    FW_TRY(fw_run_valid(r, 0, r->start));
    fw_friction_begin(m);
    if (fw_friction_decide(m, 0, r->start)) return FW_OK;
    FW_TRY(fw_run_jammed(r, 0));
    return cannot_start(r);
}

fw_status fw_run_valid(const fw_run *r, double t, const double *y) {
    fw_model *m = r->model;
    const char *why = "";
    char time[32];
    if (m->nelement == 0) return FW_OK;
    fw_model_pose(m, y);
    const fw_force_element *e = fw_model_element_invalid(m, t, y, &why);
    if (!e) return FW_OK;
    fw_status status =
        fw_diag_error(r->diags, 242, e->place, "%s of scene %s at %s s: %s", e->id, scene_name(r),
                      fw_number_text(time, sizeof time, t * m->scale.time_s, 4), why);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

fw_status fw_run_prepare(fw_run *r, const fw_terms *terms) {
    FW_TRY(pieces(r, terms));
    FW_TRY(start_values(r, terms));
    return motion_size(r, terms);
}

fw_status fw_run_arrays(fw_run *r) {
    fw_motion *m = r->motion;
    const fw_mechanism *from = r->mechanism;
    int samples = r->options->samples;
    size_t rows = (size_t)samples, n = 3 * (size_t)from->nbody, pins = (size_t)from->npin;
    m->nbody = from->nbody, m->npin = from->npin;
    m->ntie = from->ntie, m->ndriver = from->ndriver;
    m->nsample = samples;
    if (rows > ((size_t)1 << 40) / (n + pins + 1)) return FW_LIMIT;
    FW_NEED(m->t_s = fw_arena_array(r->arena, double, rows));
    FW_NEED(m->q = fw_arena_array(r->arena, double, rows *n));
    FW_NEED(m->v = fw_arena_array(r->arena, double, rows *n));
    FW_NEED(m->accel = fw_arena_array(r->arena, double, rows *n));
    FW_NEED(m->angle_rad = fw_arena_array(r->arena, double, rows *pins));
    FW_NEED(m->reaction_N = fw_arena_array(r->arena, double, rows * 2 * pins));
    FW_NEED(m->tie_N = fw_arena_array(r->arena, double, rows * 3 * (size_t)from->ntie));
    FW_NEED(m->driver_N = fw_arena_array(r->arena, double, rows *(size_t)from->ndriver));
    FW_NEED(m->peak = fw_arena_array(r->arena, fw_peak, pins));
    if (r->options->energies) {
        FW_NEED(m->energy_J = fw_arena_array(r->arena, double, 4 * rows));
        FW_NEED(m->constraint_norm = fw_arena_array(r->arena, double, rows));
    }
    FW_NEED(r->seen_q = fw_arena_array(r->arena, double, n));
    FW_NEED(r->seen_angle = fw_arena_array(r->arena, double, pins));
    FW_NEED(r->seen_force = fw_arena_array(r->arena, double, 2 * pins));
    FW_NEED(r->seen_grid = fw_arena_array(r->arena, double, (FW_GRID + 1) * 2 * pins));
    if (r->options->reactions) FW_TRY(fw_run_extremes_new(r));
    size_t friction = (size_t)fw_friction_count(r->model);
    FW_NEED(r->friction_fit = fw_arena_array(r->arena, double, friction));
    FW_TRY(fw_kinks_new(r));
    size_t ny = (size_t)r->model->ny;
    FW_NEED(r->start = fw_arena_array(r->arena, double, ny));
    FW_NEED(r->state = fw_arena_array(r->arena, double, ny));
    FW_NEED(r->rate = fw_arena_array(r->arena, double, ny));
    FW_NEED(r->moved = fw_arena_array(r->arena, double, ny));
    size_t entries = (size_t)fw_model_switches(r->model) + friction;
    FW_NEED(r->fit = fw_arena_array(r->arena, double, (FW_PLACES + 1) * entries));
    FW_NEED(r->unfit = fw_arena_array(r->arena, bool, entries));
    return FW_OK;
}
