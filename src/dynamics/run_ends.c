/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ends of a run's parts: smooth pieces with the longest steps that leap over nothing in them, and what can end a run
   before its scene does. */
#include "base/sort.h"
#include "dynamics/run.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- smooth pieces, between the breaks of all laws ---- */

static int law_count(const fw_dynamics_problem *problem, const fw_effects_loads *loads) {
    int count = loads->ntimed + problem->mechanism->ndriver + (loads->stretch.law != NULL);
    for (int i = 0; i < loads->nelement; i++)
        count += loads->element[i].laws;
    return count;
}

/* the i-th law of all: of timed loads, drivers, the stretching ground, elements; *coordinate: it
   drives a joint. NULL: constant */
static const fw_quantity_law *law_of(const fw_dynamics_problem *problem,
                                     const fw_effects_loads *loads, int i, bool *coordinate) {
    int drivers = problem->mechanism->ndriver, moving = drivers + (loads->stretch.law != NULL);
    *coordinate = i >= loads->ntimed && i < loads->ntimed + moving;
    if (i < loads->ntimed) return loads->timed[i].law;
    if (*coordinate && i == loads->ntimed + drivers) return loads->stretch.law;
    if (*coordinate) return &problem->mechanism->driver[i - loads->ntimed].law;
    const fw_effects_force_element *e = loads->element;
    for (i -= loads->ntimed + moving; i >= e->laws; e++)
        i -= e->laws;
    return e->law[i];
}

/* what acts through switches does not at the start: contacts are open */
static bool all_open(const fw_dynamics_problem *problem) {
    const fw_multibody_model *m = problem->model;
    const bool *on = problem->system->on.element;
    for (int i = 0; i < m->nelement; i++)
        for (int k = 0; k < m->element[i].own->switches; k++)
            if (*on++) return false;
    return true;
}

bool fw_dynamics_run_gentle(const fw_dynamics_problem *problem, const fw_effects_loads *loads,
                            double omega_per_s, double share, bool open) {
    const fw_multibody_model *m = problem->model;
    double end = problem->scene->duration_s;
    bool coordinate, still = loads->nload == 0 && loads->nspring == 0 && !loads->strained &&
                             loads->nfriction == 0 &&
                             (problem->scene->ncontact == 0 || (open && all_open(problem)));
    for (int i = 0; i < loads->nelement && still;
         i++) /* what has no law acts at once, but for flexures, and contacts that are open */
        still = loads->element[i].laws > 0 || loads->element[i].class_->pressing ||
                (loads->element[i].pin >= 0 && loads->released[loads->element[i].pin]);
    for (int i = 0; i < m->nq && still; i++) /* constant loads come at once */
        still = !(fabs(loads->constant[i]) > 0) && !(fabs(problem->start[m->nq + i]) > 0);
    for (int i = 0; i < law_count(problem, loads) && still; i++) {
        const fw_quantity_law *law = law_of(problem, loads, i, &coordinate);
        still = fw_quantity_law_jolt(law, coordinate, end, omega_per_s) < share;
    }
    return still;
}

/* the breaks of every law, one law after the other (at, counted), and the strides between them */
static fw_status look_at_laws(fw_dynamics_problem *problem, const fw_effects_loads *loads,
                              double *at, int count) {
    int laws = law_count(problem, loads), have = 0;
    double end = problem->scene->duration_s;
    bool coordinate;
    FW_NEED(problem->stride =
                fw_arena_array(problem->arena, fw_quantity_law_strides, (size_t)laws));
    FW_NEED(problem->stride_row = fw_arena_array(problem->arena, int, (size_t)laws));
    for (int i = 0; i < laws; i++) {
        const fw_quantity_law *law = law_of(problem, loads, i, &coordinate);
        fw_quantity_law_strides *own = &problem->stride[problem->nstride];
        int breaks = fw_quantity_law_breaks_of(law, end, at + have, count - have);
        fw_sort_doubles(at + have, (size_t)breaks);
        FW_TRY(fw_quantity_law_look(problem->arena, law, coordinate, end, at + have, breaks, own));
        have += breaks;
        bool limits = false;
        for (int k = 0; k < own->n; k++)
            if (isfinite(own->most_s[k])) limits = true;
        if (limits && !(fw_quantity_law_wave_of(law).fastest_Hz > 0)) problem->sudden = true;
        if (limits) problem->nstride++;
    }
    return FW_OK;
}

/* longest scaled step from scaled time t on that leaps over nothing in any law, each of whose
   strides may be `factor` times as long */
static double stride(const fw_dynamics_problem *problem, double factor, double t) {
    double most = (double)INFINITY, unit = problem->model->scale.time_s;
    for (int i = 0; i < problem->nstride; i++)
        most = fmin(most, fw_quantity_law_stride(&problem->stride[i], factor, t * unit,
                                                 &problem->stride_row[i]));
    return most / unit;
}

fw_status fw_dynamics_run_pieces(fw_dynamics_problem *problem, const fw_effects_loads *loads) {
    int laws = law_count(problem, loads), have = 0;
    double end = problem->scene->duration_s, unit = problem->model->scale.time_s;
    bool coordinate;
    for (int i = 0; i < laws; i++)
        have += fw_quantity_law_breaks_of(law_of(problem, loads, i, &coordinate), end, NULL, 0);
    double *at;
    FW_NEED(at = fw_arena_array(problem->arena, double, (size_t)have + 1));
    FW_TRY(look_at_laws(problem, loads, at, have));
    if (have > 1) fw_sort_doubles(at, (size_t)have);
    int kept = 0;
    for (int i = 0; i < have; i++)
        if (at[i] > 0 && at[i] < end && (kept == 0 || at[i] > at[kept - 1])) at[kept++] = at[i];
    at[kept++] = end;
    for (int i = 0; i < kept; i++)
        at[i] /= unit;
    problem->end = at;
    problem->npiece = kept;
    problem->system->piece_s = 0.5 * at[0] * unit;
    return FW_OK;
}

/* ---- steps that see all of the loads ---- */

/* Longer by half in the second run, so that the difference of the two tells the error where not the
   tolerance but a law limits the steps. Without error control a step may neither end on a flank
   after a long rest nor be as long as the law bears: an eighth of the whole, and in the second run
   longer like h_fixed, by 10^(1/2).
   A ground that stretches does work on what is held between its points though no body moves, as in stages that are their own
   mirror image. Errors of work are in no step's control: 64 steps of the scene at least have it to 1e-8. */
void fw_dynamics_run_limit_step(const fw_dynamics_controller *control, fw_maths_stepper *s,
                                double t) {
    const fw_dynamics_problem *problem = control->problem;
    double most = (double)INFINITY;
    if (s->row->fixed_step) {
        if (problem->nstride > 0) s->h_max = control->fixed_part * stride(problem, 1, t);
        return;
    }
    if (problem->stretched) most = control->law_stride * problem->end[problem->npiece - 1] / 64;
    if (problem->nstride > 0) most = fmin(most, stride(problem, control->law_stride, t));
    if (isfinite(most) || problem->nstride > 0) s->h_max = most;
}

void fw_dynamics_run_start(const fw_dynamics_controller *control, fw_maths_stepper *s, double t,
                           const double *y, double end) {
    fw_dynamics_run_limit_step(control, s, t);
    fw_maths_stepper_start(s, t, y, end);
}

/* ---- what can end a run before its scene does, and what is said of that ---- */

static const long fw_usual_steps = 10 * 1000 * 1000, fw_most_events = 1000 * 1000;

static long most_steps(const fw_dynamics_problem *problem) {
    return problem->options->most_steps > 0 ? problem->options->most_steps : fw_usual_steps;
}

static fw_status solver_error(fw_status status) {
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* friction that has no force, or more than one, at t or within a millionth of the scene from there
   (towards such a place forces grow without limit, and steps end before it): FW_OK when it is
   something else */
fw_status fw_dynamics_run_jammed(const fw_dynamics_run *r, double t) {
    double at, final = fw_dynamics_end(&r->problem);
    const char *id;
    fw_place place;
    char time[32];
    if (!fw_multibody_friction_jammed(r->problem.system, &at, &id, &place) ||
        !(fabs(at - t) < 1e-6 * final))
        return FW_OK;
    return solver_error(fw_diag_error(
        r->diags, 244, place,
        "friction of %s%s in %s%s has no unique value at %s s: the normal force in the "
        "joint rises with the friction force itself, so that the joint jams, or could stick as "
        "well as slide, and rigid bodies have no unique motion; lower the coefficient or the "
        "radius, move the load nearer to the joint, or give the joint a <contact>, whose "
        "stiffness determines the normal force",
        FW_NAMED("joint", id), FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)),
        fw_number_text(time, sizeof time, t * r->problem.model->scale.time_s, 6)));
}

const char *fw_dynamics_run_pinned(const fw_dynamics_run *r) {
    const bool pins = r->record.motion->ledger.hinge.used == FW_HINGE_REVOLUTE;
    return pins && r->problem.mechanism->nhinge > 0
               ? "; hinges are pins here, which give nothing of that: add nonlinear-hinge to the "
                 "list of --effects, or let --hinge-model choose"
               : "";
}

/* what asks of joints what they cannot keep together */
static const char *what_asks(const fw_multibody_model *m) {
    if (m->stretch.law && m->ndriver > 0)
        return "heat moves the ground's points against the layer, or a driver prescribes a value, "
               "by what the other joints do not allow";
    if (m->stretch.law)
        return "heat moves the ground's points against the layer, by what the other joints do not "
               "allow";
    return m->driven ? "a driver prescribes a value that the other joints do not allow"
                     : "the mechanism cannot reach any farther";
}

fw_status fw_dynamics_run_stopped(const fw_dynamics_run *r, const fw_maths_stepper *s,
                                  fw_maths_ode_result why) {
    const fw_multibody_model *m = r->problem.model;
    const fw_multibody_record *record = &r->problem.system->record;
    FW_TRY(fw_dynamics_run_jammed(r, s->t));
    int worst = 0;
    double most = -1;
    for (int b = 0; b < m->nbody; b++) {
        const double *a = s->f + m->nq + 3 * b;
        double size = fabs(a[0]) + fabs(a[1]) + fabs(a[2]);
        if (size > most || isnan(size)) most = isnan(size) ? (double)INFINITY : size, worst = b;
    }
    const char *id = fw_text_name(r->problem.mechanism->body[worst].id);
    char time[32];
    fw_number_text(time, sizeof time, s->t * m->scale.time_s, 6);
    if (why == FW_ODE_NAN)
        return solver_error(fw_diag_error(
            r->diags, 102, r->problem.scene->place,
            "the motion of %s%s overflows after %s s, at %s%s: its accelerations are no "
            "finite numbers; check loads, masses and stiffnesses",
            FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)), time, FW_NAMED("body", id)));
    /* a position that could not be closed within a billionth of the scene from here is the cause */
    double final = fw_dynamics_end(&r->problem);
    if (record->stuck >= 0 && fabs(record->stuck_time - s->t) < 1e-9 * final) {
        const fw_multibody_block *b = &m->block[record->stuck];
        return solver_error(
            fw_diag_error(r->diags, 101, r->problem.scene->place,
                          "the joints of %s%s contradict each other from %s s on: %s%s "
                          "cannot be kept; %s%s",
                          FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)), time,
                          FW_NAMED("joint", fw_multibody_block_name(r->problem.mechanism, b)),
                          what_asks(m), m->stretch.law ? fw_dynamics_run_pinned(r) : ""));
    }
    return solver_error(fw_diag_error(
        r->diags, 101, r->problem.scene->place,
        "the steps of %s%s become too small at %s s, at %s%s; the motion "
        "runs into a position it cannot pass%s, or rtol is too tight",
        FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)), time, FW_NAMED("body", id),
        strcmp(m->method->name, "chain") == 0 ? "" : " by this method (--method chain may)"));
}

/* the step says which of the two it is: a few per period of the motion, or tiny ones */
static fw_status too_long(const fw_dynamics_run *r, const fw_maths_stepper *s) {
    char count[32], step[32], at[32];
    double unit = r->problem.model->scale.time_s;
    bool steps = r->control.steps > most_steps(&r->problem);
    double limit = (double)(steps ? most_steps(&r->problem) : fw_most_events);
    fw_status status = fw_diag_error(
        r->diags, 108, r->problem.scene->place,
        "%s%s needs more than %s %s (steps are %s s, and %s s are reached): shorten it, or "
        "check for a stiffness or damping that is extreme in relation to the masses",
        FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)),
        fw_number_text(count, sizeof count, limit, 9), steps ? "steps" : "events",
        fw_number_text(step, sizeof step, s->h * unit, 2),
        fw_number_text(at, sizeof at, s->t * unit, 3));
    return status == FW_NOMEM ? FW_NOMEM : FW_LIMIT;
}

fw_status fw_dynamics_run_limits(const fw_dynamics_run *r, const fw_maths_stepper *s) {
    bool over = r->control.steps > most_steps(&r->problem) ||
                r->problem.system->record.events > fw_most_events;
    return over ? too_long(r, s) : FW_OK;
}

fw_status fw_dynamics_run_position_jumps(const fw_dynamics_run *r, double t) {
    char at[32];
    return solver_error(fw_diag_error(
        r->diags, 101, r->problem.scene->place,
        "a driver or the temperature of %s%s jumps at %s s, but positions must "
        "change continuously; use law=\"ramp\" with a rise, or another law without jumps",
        FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)),
        fw_number_text(at, sizeof at, t * r->problem.model->scale.time_s, 6)));
}

fw_status fw_dynamics_run_valid(const fw_dynamics_run *r, double t, const double *y) {
    const fw_multibody_model *m = r->problem.model;
    const char *why = "";
    char time[32], at[40];
    if (m->nelement == 0) return FW_OK;
    const fw_multibody_pose *pose = fw_multibody_pose_at(r->problem.system, t, y);
    const fw_effects_force_element *e =
        fw_multibody_element_invalid(r->problem.system, pose, y + m->nq, &why);
    if (!e) return FW_OK;
    snprintf(at, sizeof at, "%s s", fw_number_text(time, sizeof time, t * m->scale.time_s, 4));
    return fw_effects_element_ended(e, fw_dynamics_scene_name(&r->problem), at, why, r->diags);
}
