/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loop over steps, smooth pieces and events. */
#include "dynamics/run.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const long fw_usual_steps = 10 * 1000 * 1000, fw_most_events = 1000 * 1000;

static long most_steps(const fw_run *r) {
    return r->options->most_steps > 0 ? r->options->most_steps : fw_usual_steps;
}

static const char *scene_name(const fw_run *r) {
    return r->scene->name ? r->scene->name : "(unnamed)";
}

/* ---- what can go wrong ---- */

static fw_status solver_error(fw_status status) {
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* friction that has no force, or more than one, at t or within a millionth of the scene from there
   (towards such a place forces grow without limit, and steps end before it):
   FW_OK when it is something else */
fw_status fw_run_jammed(const fw_run *r, double t) {
    double at, final = r->end[r->npiece - 1];
    const char *id;
    fw_place place;
    char time[32];
    if (!fw_friction_jammed(r->model, &at, &id, &place) || !(fabs(at - t) < 1e-6 * final))
        return FW_OK;
    return solver_error(fw_diag_error(
        r->diags, 244, place,
        "friction of joint %s in scene %s has no single value at %s s: what presses there grows "
        "with the friction itself, so that the joint jams or may either hold or slide; lower the "
        "coefficient or the radius, move the load nearer to the joint, or let a <contact> press",
        id, scene_name(r), fw_number_text(time, sizeof time, t * r->model->scale.time_s, 6)));
}

static fw_status stopped(const fw_run *r, const fw_stepper *s, fw_ode_result why) {
    const fw_model *m = r->model;
    FW_TRY(fw_run_jammed(r, s->t));
    int worst = 0;
    double most = -1;
    for (int b = 0; b < m->nbody; b++) {
        const double *a = s->f + m->nq + 3 * b;
        double size = fabs(a[0]) + fabs(a[1]) + fabs(a[2]);
        if (size > most || isnan(size)) most = isnan(size) ? (double)INFINITY : size, worst = b;
    }
    const char *id = r->mechanism->body[worst].id ? r->mechanism->body[worst].id : "(unnamed)";
    char time[32];
    fw_number_text(time, sizeof time, s->t * m->scale.time_s, 6);
    if (why == FW_ODE_NAN)
        return solver_error(fw_diag_error(
            r->diags, 102, r->scene->place,
            "the motion of scene %s is no longer a number after %s s, at body %s; check "
            "loads, masses and stiffnesses",
            scene_name(r), time, id));
    /* a position that could not be closed within a billionth of the scene from here is the cause */
    double final = r->end[r->npiece - 1];
    if (m->stuck >= 0 && fabs(m->stuck_time - s->t) < 1e-9 * final) {
        const fw_block *b = &m->block[m->stuck];
        return solver_error(
            fw_diag_error(r->diags, 101, r->scene->place,
                          "the joints of scene %s contradict each other from %s s on: joint %s "
                          "cannot be kept; %s",
                          scene_name(r), time, fw_block_name(r->mechanism, b),
                          m->driven ? "a driver asks for what the other joints do not allow"
                                    : "the mechanism is at the end of its reach"));
    }
    return solver_error(fw_diag_error(
        r->diags, 101, r->scene->place,
        "the steps of scene %s become too small at %s s, at body %s; the motion "
        "runs into a position it cannot pass%s, or rtol is too tight",
        scene_name(r), time, id,
        strcmp(m->method->name, "chain") == 0 ? "" : " by this method (--method chain may)"));
}

/* the step says which of the two it is: a few per period of the motion, or tiny ones */
static fw_status too_long(const fw_run *r, const fw_stepper *s) {
    char count[32], step[32], at[32];
    double unit = r->model->scale.time_s;
    bool steps = r->steps > most_steps(r);
    double limit = (double)(steps ? most_steps(r) : fw_most_events);
    fw_status status =
        fw_diag_error(r->diags, 108, r->scene->place,
                      "scene %s needs more than %s %s (steps are %s s, and %s s are "
                      "reached): shorten it, or "
                      "look for a stiffness or damping that is extreme against the masses",
                      scene_name(r), fw_number_text(count, sizeof count, limit, 9),
                      steps ? "steps" : "events", fw_number_text(step, sizeof step, s->h * unit, 2),
                      fw_number_text(at, sizeof at, s->t * unit, 3));
    return status == FW_NOMEM ? FW_NOMEM : FW_LIMIT;
}

/* ---- steps that see all of the loads ---- */

/* Longer by half in the second run, so that the difference of the two tells the error where not the
   tolerance but a law limits the steps. Without error control a step may neither end on a flank
   after a long rest nor be as long as the law bears: an eighth of the whole, and in the second run
   longer like h_fixed, by 10^(1/2). */
static void limit_step(const fw_run *r, fw_stepper *s, double t) {
    if (r->nstride == 0) return;
    s->h_max = s->row->fixed_step ? (r->full ? 0.125 : 0.395) * fw_run_stride(r, 1, t)
                                  : fw_run_stride(r, r->full ? 1 : 1.5, t);
}

void fw_run_start(const fw_run *r, fw_stepper *s, double t, const double *y, double end) {
    limit_step(r, s, t);
    fw_stepper_start(s, t, y, end);
}

/* ---- energy ---- */

/* the energy of models that have a kernel needs no arms: no loads or springs at points */
static void watch_energy(fw_run *r, double t, const double *y) {
    fw_model_at(r->model, t);
    if (!r->model->kernel) fw_model_pose(r->model, y);
    fw_energy e = fw_model_energy(r->model, t, y);
    double balance = e.kinetic + e.elastic + e.dissipated - e.work;
    double start = r->first.kinetic + r->first.elastic + r->first.dissipated - r->first.work;
    r->drift = fmax(r->drift, fabs(balance - start));
    /* what electrodes store is below 0 */
    r->largest = fmax(r->largest, fmax(e.kinetic + fabs(e.elastic) + e.dissipated, fabs(e.work)));
}

static void first_energy(fw_run *r, const double *y) {
    fw_model_at(r->model, 0);
    fw_model_pose(r->model, y);
    r->first = fw_model_energy(r->model, 0, y);
    r->drift = 0;
    r->largest = r->first.kinetic + fabs(r->first.elastic);
}

/* Dense output is some ten to a thousand times less exact than the step, and what leaves an event
   takes that along. So the step that met one is made again, to end just behind it, where both are
   the same; only there it is passed. Not for methods with a memory: they would begin anew twice. */
enum { MOST_AIMS = 3 };
/* of a step: dense output is off by the square of it there; less than a touch that matters lasts */
static const double fw_near = 1e-3, fw_behind = 1e-6;

static bool aim(fw_run *r, fw_stepper *s, double theta) {
    double h = s->h, target = s->t_old + (1 + fw_behind) * theta * h, end = s->t_end;
    if (s->row->variable_order || theta < fw_near || theta > 1 - fw_near) return false;
    if (++r->aims > MOST_AIMS) return false; /* it comes and goes with the step */
    memcpy(r->moved, s->y_old, (size_t)r->model->ny * sizeof *r->moved);
    fw_run_start(r, s, s->t_old, r->moved, fmin(target, end));
    s->h_next = fmin(h, s->t_end - s->t); /* has been accepted already */
    return true;
}

/* goes on from the event with the flag changed */
static bool pass_event(fw_run *r, fw_stepper *s, int which, double theta, double end) {
    fw_model *m = r->model;
    double t = s->t_old + theta * s->h;
    int friction = which - fw_model_switches(m);
    fw_stepper_dense(s, theta, r->moved);
    fw_model_at(m, t);
    if (friction < 0)
        fw_model_flip(m, t, which, r->moved);
    else
        fw_friction_meet(m, friction);
    if (m->projecting) {
        fw_model_pose(m, r->moved);
        if (!m->method->factor(m) || !fw_model_project_position(m, t, r->moved) ||
            !m->method->factor(m) || !fw_model_project_velocity(m, t, r->moved + m->nq))
            return false;
    }
    if (!fw_friction_decide(m, t, r->moved)) return false;
    fw_kinks_forget(r);
    r->fresh = true;
    fw_run_start(r, s, t, r->moved, end);
    return true;
}

/* A joint at its limit within round-off may be unfit on the dense output and hold all the same when
   all are decided, at the same time again and again. From the third time on its event is passed
   over for a step that doubles with every further one, until it is clear which of the two it is: at
   most as late as the force needs to grow out of its round-off. Test: test_hard_nonsmooth.c. */
enum { PATIENT = 3 };

static bool left_alone(const fw_run *r, const fw_stepper *s) {
    return r->nudge > 0 && s->t - s->t_old <= 1.5 * r->nudge;
}

/* behind an event (which >= 0; `before`: how many there were) or a step without one */
static void mind_idle(fw_run *r, fw_stepper *s, int which, long before, double end) {
    const double final = r->end[r->npiece - 1];
    bool went_on = which < 0 && s->t - s->t_old > 1.5 * r->nudge;
    if (went_on || r->model->events > before) r->idle = 0, r->nudge = 0;
    if (which < 0 || r->model->events > before || ++r->idle < PATIENT) return;
    r->nudge = fmin(1e-6 * final, fmax(2 * r->nudge, 32 * DBL_EPSILON * final));
    if (s->t + r->nudge < end) fw_run_start(r, s, s->t, r->moved, s->t + r->nudge);
}

/* ---- pieces ---- */

/* a law that jumps changes what its element stores: that is its work. Switches fit the new law. */
static void jump_of_elements(fw_run *r, double t, double *y, double stored) {
    fw_model *m = r->model;
    fw_model_at(m, t);
    fw_model_pose(m, y);
    /* a blow may tear a damped stop or cable loose: what it holds is lost then */
    for (int i = 0; i < m->nstop + m->ncable; i++)
        if ((fw_model_switch_value(m, t, i, y) > 0) != fw_model_switch_on(m, i))
            fw_model_flip(m, t, i, y);
    fw_model_set_switches(m, t, y);
    fw_model_pose(m, y);
    if (m->worked >= 0) y[m->worked] += fw_model_element_energy(m, t, y, true) - stored;
}

/* a driver whose speed jumps moves the velocities at once (an impact without rebound); the energy
   that brings or takes is the driver's work */
static fw_status next_piece(fw_run *r, fw_stepper *s, int piece) {
    fw_model *m = r->model;
    double t = s->t, *y = r->moved, stored = 0;
    memcpy(y, s->y, (size_t)m->ny * sizeof *y);
    if (m->nelement > 0) {
        fw_model_at(m, t); /* samples were taken at other times */
        fw_model_pose(m, y);
        stored = fw_model_element_energy(m, t, y, true);
    }
    m->piece = 0.5 * (r->end[piece - 1] + r->end[piece]) * m->scale.time_s;
    if (m->driven) {
        double before = fw_model_kinetic(m, y + m->nq), psi;
        psi = fw_model_residual(m, t, y, m->right);
        if (psi > 1e-9 * m->size) {
            char at[32];
            return solver_error(fw_diag_error(
                r->diags, 101, r->scene->place,
                "a driver or the temperature of scene %s jumps at %s s: a position cannot; give it "
                "a ramp",
                scene_name(r), fw_number_text(at, sizeof at, t * m->scale.time_s, 6)));
        }
        if (!m->method->factor(m) || !fw_model_impact(m, t, y + m->nq))
            return stopped(r, s, FW_ODE_SMALL);
        double after = fw_model_kinetic(m, y + m->nq);
        if (m->worked >= 0) y[m->worked] += after - before;
        m->events += fabs(after - before) > 1e-9 * fmax(after, before); /* a blow */
    }
    if (m->nelement > 0) jump_of_elements(r, t, y, stored);
    if (!fw_friction_decide(m, t, y)) return stopped(r, s, FW_ODE_SMALL);
    fw_kinks_forget(r);
    r->fresh = true;
    fw_run_start(r, s, t, y, r->end[piece]);
    return FW_OK;
}

static bool turned_too_far(const fw_run *r, const fw_peaks *peaks) {
    for (int i = 0; i < peaks->npin; i++)
        if (fabs(peaks->peak[i].angle_rad) > r->most_angle) return true;
    return false;
}

/* everything that looks at the step just made, up to theta_end */
static bool look(fw_run *r, fw_stepper *s, fw_peaks *peaks, double theta_end) {
    fw_peaks_mark(peaks, r->model, s, theta_end, r->end[r->npiece - 1], r->moved);
    fw_peaks_step(peaks, r->model, s, theta_end);
    fw_run_extremes(r, s, theta_end);
    if (!r->full) {
        fw_run_show(r, s, theta_end);
        return true;
    }
    if (theta_end == 1) watch_energy(r, s->t, s->y);
    fw_run_show(r, s, theta_end);
    return fw_run_samples(r, s, theta_end);
}

static fw_status begin(fw_run *r, fw_stepper *s) {
    fw_model *m = r->model;
    fw_run_show_start(r);
    m->projections = m->events = 0;
    r->idle = 0, r->nudge = 0;
    m->worst_position = m->worst_velocity = 0;
    m->stuck = -1;
    m->piece = 0.5 * r->end[0] * m->scale.time_s;
    fw_model_at(m, 0);
    fw_model_set_switches(m, 0, r->start);
    fw_friction_begin(m);
    fw_kinks_begin(r);
    if (!fw_friction_decide(m, 0, r->start)) return stopped(r, s, FW_ODE_SMALL);
    fw_run_start(r, s, 0, r->start, r->end[0]);
    if (!r->full) return FW_OK;
    first_energy(r, s->y);
    fw_run_first_sample(r, s->y);
    return FW_OK;
}

fw_status fw_run_pass(fw_run *r, fw_stepper *s, fw_peaks *peaks) {
    fw_model *m = r->model;
    bool ended = false;
    long taken = 0;
    double patience = r->patience;
    FW_TRY(begin(r, s));
    for (int piece = 0; piece < r->npiece && !ended; piece++) {
        if (piece > 0) FW_TRY(next_piece(r, s, piece));
        const double end = r->end[piece];
        while (s->t < end && !ended) {
            if (fw_arena_cancelled(r->arena)) return FW_CANCELLED;
            if (s->t >= s->t_end) fw_run_start(r, s, s->t, s->y, end); /* no event after all */
            limit_step(r, s, s->t);
            fw_kinks_limit(r, s);
            fw_ode_result result = fw_stepper_step(s);
            if (result != FW_ODE_STEP) return stopped(r, s, result);
            int which;
            double theta = fw_run_event(r, s, &which);
            if (++r->steps > most_steps(r) || m->events > fw_most_events) return too_long(r, s);
            taken++;
            if (r->trial > 0 && taken > r->trial) return FW_LIMIT; /* it lost */
            if (r->patience > 0 && (double)(taken - 50 * m->events) > patience) {
                bool stuck;
                FW_TRY(fw_integrator_stuck(r, s, &stuck));
                if (stuck) {
                    r->given_up_s = s->t * m->scale.time_s;
                    return FW_LIMIT; /* solve starts over */
                }
                patience += 1000; /* looked at again */
            }
            if (which >= 0 && left_alone(r, s)) which = -1, theta = 1;
            if (which >= 0 && aim(r, s, theta)) continue;
            r->aims = 0;
            if (fw_kinks_again(r, s)) continue;
            if (!look(r, s, peaks, theta)) return stopped(r, s, FW_ODE_SMALL);
            long before = m->events;
            double met = s->t_old + theta * s->h;
            if (which >= 0 && !pass_event(r, s, which, theta, end)) {
                FW_TRY(fw_run_jammed(r, met));
                return stopped(r, s, FW_ODE_SMALL);
            }
            mind_idle(r, s, which, before, end);
            FW_TRY(fw_run_valid(r, s->t, s->y));
            ended = turned_too_far(r, peaks);
        }
    }
    if (!r->full) return FW_OK;
    r->motion->ended = ended && s->t < r->end[r->npiece - 1];
    r->motion->end_s = r->motion->ended ? s->t * m->scale.time_s : r->scene->duration_s;
    r->motion->nsample = r->row;
    return FW_OK;
}
