/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first event of a step: where a stop, a cable, a switch of an element or the state of a joint
   with friction no longer fits its flag. Looked for on the dense output at FW_PLACES + 1 places,
   and between them wherever a touch may be shorter than their spacing; found to round-off. Entries
   are numbered as switches are (multibody_flags.c), then the joints with friction. Test:
   test_events.c, test_friction.c. */
#include "dynamics/run.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* control->moved at theta, and its pose */
static const fw_multibody_pose *stand_at(fw_dynamics_controller *control, fw_maths_stepper *s,
                                         double theta) {
    fw_maths_stepper_dense(s, theta, control->moved);
    return fw_multibody_pose_at(control->problem->system, s->t_old + theta * s->h, control->moved);
}

/* how well switch i fits its flag: >= 0 fits, its value with the sign of the flag */
static double fitting(const fw_dynamics_problem *problem, int i, double value) {
    if (fw_multibody_switch_on(problem->system, i))
        return value > 0 ? value : fmin(value, -DBL_MIN);
    return value > 0 ? -value : fabs(value);
}

static double fitness(fw_dynamics_controller *control, fw_maths_stepper *s, int i, double theta) {
    const fw_dynamics_problem *problem = control->problem;
    const fw_multibody_pose *pose = stand_at(control, s, theta);
    const double *v = control->moved + problem->model->nq;
    int friction = i - fw_multibody_switch_count(problem->model);
    if (friction < 0)
        return fitting(problem, i, fw_multibody_switch_value(problem->system, pose, i, v));
    fw_multibody_friction_fits(problem->system, pose->t, control->moved, control->friction_fit);
    return control->friction_fit[friction];
}

/* of all entries at place k, which share their evaluations */
static void look_at_place(fw_dynamics_controller *control, fw_maths_stepper *s, int k, double *f) {
    const fw_multibody_model *m = control->problem->model;
    fw_multibody_system *sys = control->problem->system;
    int switches = fw_multibody_switch_count(m);
    const fw_multibody_pose *pose = stand_at(control, s, (double)k / FW_PLACES);
    fw_multibody_switch_values(sys, pose, control->moved + m->nq, f);
    for (int i = 0; i < switches; i++)
        f[i] = fitting(control->problem, i, f[i]);
    if (m->nfriction > 0) fw_multibody_friction_fits(sys, pose->t, control->moved, f + switches);
}

/* first place in (low, high] where entry i does not fit, given that it does at low and not at
   high; to round-off of theta, from above */
static double bisect(fw_dynamics_controller *control, fw_maths_stepper *s, int i, double low,
                     double high) {
    for (int k = 0; k < 52 && high - low > 1e-15; k++) {
        double middle = 0.5 * (low + high);
        *(fitness(control, s, i, middle) < 0 ? &high : &low) = middle;
    }
    return high;
}

/* a place in (low, high) where entry i does not fit, though it does at both ends: the least fit
   one, by golden section; NaN when it fits there too. Finds a touch shorter than the spacing. */
static double dip(fw_dynamics_controller *control, fw_maths_stepper *s, int i, double low,
                  double high) {
    const double golden = 0.6180339887498949;
    double x = high - golden * (high - low), y = low + golden * (high - low);
    double fx = fitness(control, s, i, x), fy = fitness(control, s, i, y);
    for (int k = 0; k < 60 && fx >= 0 && fy >= 0 && high - low > 1e-12; k++) {
        if (fx < fy) {
            high = y, y = x, fy = fx, x = high - golden * (high - low);
            fx = fitness(control, s, i, x);
        } else {
            low = x, x = y, fx = fy, y = low + golden * (high - low);
            fy = fitness(control, s, i, y);
        }
    }
    return fx < 0 ? x : fy < 0 ? y : (double)NAN;
}

/* does entry i, which fits least at an end of the step (f: there, beside it, and beyond), become
   less fit on its way in, so far that a parabola through the three may reach below 0? */
static bool dips_at_end(fw_dynamics_controller *control, fw_maths_stepper *s, int i, double f,
                        double beside, double beyond, double theta, double inward) {
    if (!(f >= 0 && f <= beside && 2 * f <= f - 2 * beside + beyond)) return false;
    return fitness(control, s, i, theta + 1e-3 * inward) < f;
}

/* first place up to place k of the step where entry i does not fit, though it did up to k - 1: by
   its fitness f at the places so far, between any three of which the middle one is least and so
   small that a parabola through them may reach below 0, and at the ends of the step. NaN: none */
static double first_unfit(fw_dynamics_controller *control, fw_maths_stepper *s, int i, int count,
                          int k) {
    const double part = 1.0 / FW_PLACES;
    const double *f = control->fit + (size_t)k * (size_t)count + i;
    if (k == 0) return (double)NAN;
    const double *f1 = f - count, *f2 = f1 - (k > 1 ? count : 0);
    if (k > 1 && *f1 <= *f2 && *f1 <= *f && *f1 >= 0 && *f >= 0 && *f1 <= *f2 - 2 * *f1 + *f) {
        double low = (k - 2) * part, at = dip(control, s, i, low, k * part);
        if (!isnan(at)) return bisect(control, s, i, low, at);
    }
    if (k == 2 && dips_at_end(control, s, i, *f2, *f1, *f, 0, part)) {
        double at = dip(control, s, i, 0, part);
        if (!isnan(at)) return bisect(control, s, i, 0, at);
    }
    if (k == FW_PLACES && dips_at_end(control, s, i, *f, *f1, *f2, 1, -part)) {
        double at = dip(control, s, i, 1 - part, 1);
        if (!isnan(at)) return bisect(control, s, i, 1 - part, at);
    }
    return *f < 0 ? bisect(control, s, i, (k - 1) * part, k * part) : (double)NAN;
}

/* What is found at the next place lies beyond the place before this one. */
fw_dynamics_event fw_dynamics_event_first(fw_dynamics_controller *control, fw_maths_stepper *s) {
    const fw_multibody_model *m = control->problem->model;
    int count = fw_multibody_switch_count(m) + m->nfriction;
    fw_dynamics_event first = {.which = -1, .theta = 1};
    if (count == 0) return first;
    fw_multibody_friction_track(control->problem->system, s->y);
    memset(control->unfit, 0, (size_t)count * sizeof *control->unfit);
    for (int k = 0; k <= FW_PLACES; k++) {
        if (first.which >= 0 && first.theta <= (k - 2.0) / FW_PLACES) break;
        look_at_place(control, s, k, control->fit + (size_t)k * (size_t)count);
        for (int i = 0; i < count; i++) {
            double at = control->unfit[i] ? (double)NAN : first_unfit(control, s, i, count, k);
            if (isnan(at)) continue;
            control->unfit[i] = true;
            bool earlier = at < first.theta || (at == first.theta && i < first.which);
            if (first.which < 0 || earlier) first = (fw_dynamics_event){i, at};
        }
    }
    return first;
}

/* ---- what becomes of an event ---- */

/* Dense output is some ten to a thousand times less exact than the step, and what leaves an event
   takes that along. So the step that met one is made again, to end just behind it, where both are
   the same; only there it is passed. Not for methods with a memory: they would begin anew twice. */
enum { MOST_AIMS = 3 };
/* of a step: dense output is off by the square of it there; less than a touch that matters lasts */
static const double fw_near = 1e-3, fw_behind = 1e-6;

static bool worth_an_aim(const fw_maths_stepper *s, fw_dynamics_event event) {
    return event.which >= 0 && !s->row->variable_order && event.theta >= fw_near &&
           event.theta <= 1 - fw_near;
}

bool fw_dynamics_event_aim(fw_dynamics_controller *control, fw_maths_stepper *s,
                           fw_dynamics_event event) {
    double h = s->h, target = s->t_old + (1 + fw_behind) * event.theta * h, end = s->t_end;
    /* it may come and go with the step */
    if (!worth_an_aim(s, event) || ++control->aims > MOST_AIMS) {
        control->aims = 0;
        return false;
    }
    memcpy(control->moved, s->y_old, (size_t)control->problem->model->ny * sizeof *control->moved);
    fw_dynamics_run_start(control, s, s->t_old, control->moved, fmin(target, end));
    s->h_next = fmin(h, s->t_end - s->t); /* has been accepted already */
    return true;
}

bool fw_dynamics_event_pass(fw_dynamics_controller *control, fw_maths_stepper *s,
                            fw_dynamics_event event, double end) {
    const fw_multibody_model *m = control->problem->model;
    fw_multibody_system *sys = control->problem->system;
    double t = s->t_old + event.theta * s->h, *y = control->moved;
    int friction = event.which - fw_multibody_switch_count(m);
    fw_maths_stepper_dense(s, event.theta, y);
    if (friction < 0)
        fw_multibody_flip(sys, t, event.which, y);
    else
        fw_multibody_friction_meet(sys, friction);
    if (sys->projecting && !fw_multibody_close_state(sys, t, y)) return false;
    if (!fw_multibody_friction_decide(sys, t, y)) return false;
    fw_dynamics_near_zero_forget(control);
    fw_dynamics_run_start(control, s, t, y, end);
    return true;
}

/* A joint at its limit within round-off may be unfit on the dense output and hold all the same when
   all are decided, at the same time again and again. From the third time on its event is passed
   over for a step that doubles with every further one, until it is clear which of the two it is: at
   most as late as the force needs to grow out of its round-off. Test: test_hard_nonsmooth.c. */
enum { PATIENT = 3 };

fw_dynamics_event fw_dynamics_event_unless_idle(const fw_dynamics_controller *control,
                                                const fw_maths_stepper *s,
                                                fw_dynamics_event event) {
    bool left_alone = control->nudge > 0 && s->t - s->t_old <= 1.5 * control->nudge;
    return left_alone ? (fw_dynamics_event){.which = -1, .theta = 1} : event;
}

void fw_dynamics_event_mind_idle(fw_dynamics_controller *control, fw_maths_stepper *s,
                                 fw_dynamics_event event, bool changed, double end) {
    const double final = fw_dynamics_end(control->problem);
    bool went_on = event.which < 0 && s->t - s->t_old > 1.5 * control->nudge;
    if (went_on || changed) control->idle = 0, control->nudge = 0;
    if (event.which < 0 || changed || ++control->idle < PATIENT) return;
    control->nudge = fmin(1e-6 * final, fmax(2 * control->nudge, 32 * DBL_EPSILON * final));
    if (s->t + control->nudge < end)
        fw_dynamics_run_start(control, s, s->t, control->moved, s->t + control->nudge);
}
