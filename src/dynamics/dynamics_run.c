/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loop over steps, smooth pieces and events. */
#include "dynamics/run.h"
#include <math.h>
#include <string.h>

/* ---- pieces ---- */

/* a law that jumps changes what its element stores: that is its work. Switches fit the new law. */
static void jump_of_elements(const fw_dynamics_problem *problem, double t, double *y,
                             double stored) {
    const fw_multibody_model *m = problem->model;
    fw_multibody_system *sys = problem->system;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    const double *v = y + m->nq;
    /* a blow may tear a damped stop or cable loose: what it holds is lost then */
    for (int i = 0; i < m->nstop + m->ncable; i++)
        if ((fw_multibody_switch_value(sys, pose, i, v) > 0) != fw_multibody_switch_on(sys, i))
            fw_multibody_flip(sys, t, i, y);
    pose = fw_multibody_set_switches(sys, t, y);
    if (m->worked >= 0) y[m->worked] += fw_multibody_element_energy(sys, pose, v, true) - stored;
}

/* a driver whose speed jumps moves the velocities at once (an impact without rebound); the energy
   that brings or takes is the driver's work */
static fw_status blow_of_drivers(fw_dynamics_run *r, const fw_maths_stepper *s, double *y) {
    const fw_multibody_model *m = r->problem.model;
    fw_multibody_system *sys = r->problem.system;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, s->t, y);
    double *v = y + m->nq, before = fw_multibody_kinetic_energy(m, v);
    if (fw_multibody_residual(sys, pose, NULL) > 1e-9 * m->size)
        return fw_dynamics_run_position_jumps(r, s->t);
    const fw_multibody_factor *factor = fw_multibody_factorise(sys, pose);
    if (!factor || !fw_multibody_impact(sys, factor, v))
        return fw_dynamics_run_stopped(r, s, FW_ODE_SMALL);
    double after = fw_multibody_kinetic_energy(m, v);
    if (m->worked >= 0) y[m->worked] += after - before;
    sys->record.events += fabs(after - before) > 1e-9 * fmax(after, before);
    return FW_OK;
}

static double stored_by_elements(const fw_dynamics_problem *problem, double t, const double *y) {
    const fw_multibody_pose *pose = fw_multibody_pose_at(problem->system, t, y);
    return fw_multibody_element_energy(problem->system, pose, y + problem->model->nq, true);
}

static fw_status next_piece(fw_dynamics_run *r, fw_maths_stepper *s, int piece) {
    const fw_dynamics_problem *problem = &r->problem;
    const fw_multibody_model *m = problem->model;
    const double *end = problem->end;
    double *y = r->control.moved, stored = 0;
    memcpy(y, s->y, (size_t)m->ny * sizeof *y);
    if (m->nelement > 0) stored = stored_by_elements(problem, s->t, y);
    problem->system->piece_s = 0.5 * (end[piece - 1] + end[piece]) * m->scale.time_s;
    if (m->driven) FW_TRY(blow_of_drivers(r, s, y));
    if (m->nelement > 0) jump_of_elements(problem, s->t, y, stored);
    if (!fw_multibody_friction_decide(problem->system, s->t, y))
        return fw_dynamics_run_stopped(r, s, FW_ODE_SMALL);
    fw_dynamics_near_zero_forget(&r->control);
    r->record.fresh = true;
    fw_dynamics_run_start(&r->control, s, s->t, y, end[piece]);
    return FW_OK;
}

/* ---- the loop ---- */

static fw_status begin(fw_dynamics_run *r, fw_maths_stepper *s) {
    fw_multibody_system *sys = r->problem.system;
    fw_dynamics_controller *control = &r->control;
    double *start = r->problem.start;
    sys->record = (fw_multibody_record){.stuck = -1};
    sys->piece_s = 0.5 * r->problem.end[0] * sys->model->scale.time_s;
    control->idle = 0, control->nudge = 0;
    control->taken = 0, control->next_choice_check = control->patience;
    fw_multibody_set_switches(sys, 0, start);
    fw_multibody_friction_begin(sys);
    fw_dynamics_near_zero_begin(control);
    if (!fw_multibody_friction_decide(sys, 0, start))
        return fw_dynamics_run_stopped(r, s, FW_ODE_SMALL);
    fw_dynamics_run_start(control, s, 0, start, r->problem.end[0]);
    fw_dynamics_record_begin(&r->record, s->y);
    return FW_OK;
}

static void limit(const fw_dynamics_controller *control, fw_maths_stepper *s, double end) {
    if (s->t >= s->t_end)
        fw_dynamics_run_start(control, s, s->t, s->y, end); /* no event after all */
    fw_dynamics_run_limit_step(control, s, s->t);
    fw_dynamics_near_zero_limit(control, s);
}

static fw_status step(fw_dynamics_run *r, fw_maths_stepper *s) {
    fw_maths_ode_result result = fw_maths_stepper_step(s);
    return result == FW_ODE_STEP ? FW_OK : fw_dynamics_run_stopped(r, s, result);
}

/* FW_LIMIT with a diagnostic: the scene is too long; without: a trial lost, or explicit steps
   turned out to be the wrong choice, and solve starts over */
static fw_status count(fw_dynamics_run *r, const fw_maths_stepper *s) {
    fw_dynamics_controller *control = &r->control;
    const fw_multibody_record *record = &r->problem.system->record;
    bool stuck;
    control->steps++;
    FW_TRY(fw_dynamics_run_limits(r, s));
    control->taken++;
    if (control->trial > 0 && control->taken > control->trial) return FW_LIMIT;
    if (!(control->patience > 0)) return FW_OK;
    if ((double)(control->taken - 50 * record->events) <= control->next_choice_check) return FW_OK;
    FW_TRY(fw_dynamics_integrator_stuck(&r->problem, s, &stuck));
    if (stuck) {
        control->given_up_s = s->t * r->problem.model->scale.time_s;
        return FW_LIMIT;
    }
    control->next_choice_check += 1000; /* looked at again */
    return FW_OK;
}

static fw_status pass(fw_dynamics_run *r, fw_maths_stepper *s, fw_dynamics_event event,
                      double end) {
    const fw_multibody_record *record = &r->problem.system->record;
    long before = record->events;
    double met = s->t_old + event.theta * s->h;
    if (event.which >= 0) {
        if (!fw_dynamics_event_pass(&r->control, s, event, end)) {
            FW_TRY(fw_dynamics_run_jammed(r, met));
            return fw_dynamics_run_stopped(r, s, FW_ODE_SMALL);
        }
        r->record.fresh = true;
    }
    fw_dynamics_event_mind_idle(&r->control, s, event, record->events > before, end);
    return FW_OK;
}

/* A run that is hopeless ends only where it takes long: what tumbles far beyond what hinges bear rings with all it has
   got, and is followed for millions of steps. Test: test_program.py, test_far_beyond_without_an_end */
static bool turned_too_far(const fw_dynamics_problem *problem, const fw_maths_stepper *s,
                           const fw_dynamics_peaks *peaks) {
    const fw_dynamics_motion_options *o = problem->options;
    const double *hopeless = s->rhs > o->hopeless_rhs ? o->hopeless_rad : NULL;
    for (int i = 0; i < peaks->npin; i++) {
        const double turned = fabs(peaks->peak[i].angle_rad);
        if (turned > problem->most_angle || (hopeless && turned > hopeless[i])) return true;
    }
    return false;
}

enum { TOLD = 64 }; /* times in a scene at most that who listens is told */

static void tell(const fw_dynamics_run *r, double before, double now) {
    const double end = fw_dynamics_end(&r->problem);
    const double s = r->problem.model->scale.time_s;
    if (fw_arena_tells(r->problem.arena) && floor(TOLD * now / end) > floor(TOLD * before / end))
        fw_arena_tell(r->problem.arena, "motion of a scene", now * s, end * s, "s");
}

/* one step; where an event or a contact force near zero wants it shorter the next call makes it
   again */
static fw_status advance(fw_dynamics_run *r, fw_maths_stepper *s, fw_dynamics_peaks *peaks,
                         double end) {
    fw_dynamics_controller *control = &r->control;
    if (fw_arena_cancelled(r->problem.arena)) return FW_CANCELLED;
    limit(control, s, end);
    FW_TRY(step(r, s));
    fw_dynamics_event event = fw_dynamics_event_first(control, s);
    FW_TRY(count(r, s));
    event = fw_dynamics_event_unless_idle(control, s, event);
    if (fw_dynamics_event_aim(control, s, event)) return FW_OK;
    if (fw_dynamics_near_zero_again(control, s)) return FW_OK;
    if (!fw_dynamics_record_step(&r->record, s, peaks, event.theta))
        return fw_dynamics_run_stopped(r, s, FW_ODE_SMALL);
    FW_TRY(pass(r, s, event, end));
    return fw_dynamics_run_valid(r, s->t, s->y);
}

fw_status fw_dynamics_run_pass(fw_dynamics_run *r, fw_maths_stepper *s, fw_dynamics_peaks *peaks) {
    const fw_dynamics_problem *problem = &r->problem;
    bool ended = false;
    FW_TRY(begin(r, s));
    for (int piece = 0; piece < problem->npiece && !ended; piece++) {
        if (piece > 0) FW_TRY(next_piece(r, s, piece));
        while (s->t < problem->end[piece] && !ended) {
            const double before = s->t;
            FW_TRY(advance(r, s, peaks, problem->end[piece]));
            tell(r, before, s->t);
            ended = turned_too_far(problem, s, peaks);
        }
    }
    fw_dynamics_record_end(&r->record, ended && s->t < fw_dynamics_end(problem), s->t);
    return FW_OK;
}
