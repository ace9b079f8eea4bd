/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flags, which are held during a step and changed by events: of what holds on one side only, and of joints with friction. */
#include "multibody/multibody_scratch.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- what holds on one side only ---- */

/* What holds on one side only. Switches are counted through: stops, cables, then those of force
   elements (whatever else has switches is counted behind these). A flag says whether the thing
   acts; during a step it stays as it is, so that the right-hand side is smooth, and
   dynamics/event.c looks for the time at which the flag no longer fits. With the stretch g of a
   stop or cable and its rate g' it acts while

       min(k g, k g + c g') > 0:

   it is stretched and does not pull the wrong way (a damped stop lets go before it is relaxed).
   Elements have a function of their own. Test: test_events.c, test_elements.c. */

int fw_multibody_switch_count(const fw_multibody_model *m) {
    return m->nstop + m->ncable + m->nswitch;
}

static double stop_value(const fw_multibody_system *sys, const fw_multibody_pose *pose, int i,
                         const double *v) {
    const fw_multibody_stop *s = &sys->model->stop[i];
    double past, rate;
    fw_multibody_stop_travel(sys->model, pose, s, v, &past, &rate);
    return fmin(s->k * past, s->k * past + s->c * rate);
}

static double cable_value(const fw_multibody_system *sys, const fw_multibody_pose *pose, int spring,
                          const double *v) {
    const fw_multibody_spring *s = &sys->model->spring[spring];
    fw_multibody_pull p = fw_multibody_pull_of(sys, pose, spring, v);
    double stretch = p.length - s->length;
    return fmin(s->k * stretch, s->k * stretch + s->c * p.rate);
}

/* the spring that is the i-th cable */
static int cable(const fw_multibody_model *m, int i) {
    int spring = 0;
    while (!m->spring[spring].cable || i-- > 0)
        spring++;
    return spring;
}

const fw_multibody_element *fw_multibody_element_of_switch(const fw_multibody_model *m, int i) {
    const fw_multibody_element *e = m->element;
    while (i >= e->first_switch + e->own->switches)
        e++;
    return e;
}

double fw_multibody_switch_value(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 int i, const double *v) {
    const fw_multibody_model *m = sys->model;
    if (i < m->nstop) return stop_value(sys, pose, i, v);
    if ((i -= m->nstop) < m->ncable) return cable_value(sys, pose, cable(m, i), v);
    i -= m->ncable;
    const fw_multibody_element *e = fw_multibody_element_of_switch(m, i);
    return fw_multibody_element_switch_value(sys, pose, e, i - e->first_switch, v);
}

void fw_multibody_switch_values(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v, double *value) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nstop; i++)
        *value++ = stop_value(sys, pose, i, v);
    for (int i = 0; i < m->nspring; i++)
        if (m->spring[i].cable) *value++ = cable_value(sys, pose, i, v);
    for (int i = 0; i < m->nelement; i++)
        for (int k = 0; k < m->element[i].own->switches; k++)
            *value++ = fw_multibody_element_switch_value(sys, pose, &m->element[i], k, v);
}

static bool *flag(const fw_multibody_system *sys, int i) {
    const fw_multibody_model *m = sys->model;
    if (i < m->nstop) return &sys->on.stop[i];
    if ((i -= m->nstop) < m->ncable) return &sys->on.spring[cable(m, i)];
    return &sys->on.element[i - m->ncable];
}

bool fw_multibody_switch_on(const fw_multibody_system *sys, int i) {
    return *flag(sys, i);
}

const fw_multibody_pose *fw_multibody_set_switches(fw_multibody_system *sys, double t,
                                                   const double *y) {
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    int count = fw_multibody_switch_count(sys->model);
    for (int i = 0; i < count; i++)
        *flag(sys, i) = fw_multibody_switch_value(sys, pose, i, y + sys->model->nq) > 0;
    return pose;
}

/* what a stop or cable stores while it acts */
static double held(const fw_multibody_system *sys, const fw_multibody_pose *pose, int i,
                   const double *v) {
    const fw_multibody_model *m = sys->model;
    double stretch, rate, k;
    if (i < m->nstop) {
        fw_multibody_stop_travel(m, pose, &m->stop[i], v, &stretch, &rate);
        k = m->stop[i].k;
    } else {
        int spring = cable(m, i - m->nstop);
        stretch = fw_multibody_pull_of(sys, pose, spring, v).length - m->spring[spring].length;
        k = m->spring[spring].k;
    }
    return 0.5 * k * stretch * stretch;
}

/* what is still stored when a damped thing lets go is lost to it, and is there again when it takes
   hold while stretched */
void fw_multibody_flip(fw_multibody_system *sys, double t, int i, double *y) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    const double *v = y + m->nq;
    bool *on = flag(sys, i);
    double lost;
    if (i < m->nstop + m->ncable) {
        lost = (*on ? 1 : -1) * held(sys, pose, i, v);
        *on = !*on;
    } else {
        lost = fw_multibody_element_energy(sys, pose, v, true);
        *on = !*on;
        lost -= fw_multibody_element_energy(sys, pose, v, true);
    }
    if (m->dissipated >= 0) y[m->dissipated] += lost;
    sys->record.events++;
}

/* ---- which joints stick ---- */

/* Which joints with friction stick and which slip. Flags are held during a step; dynamics/event.c
   looks on the dense output for the first time at which one no longer fits:

     slips   its rate crosses 0
     sticks  |T| exceeds mu_s r N
     yields  (at rest because others hold it) it moves

   After an event, at the start, at borders of pieces and after blows all flags are decided
   together. Joints that move slip the way they go. Those at rest are first brought to rate 0
   exactly (least change in the mass metric). If all of them can hold they do. Else they are sorted
   by a convex problem for the forces that press now (friction_solve.c, which always has an answer),
   and what presses is found for that answer (friction_solve.c), in turns until both agree: a fixed
   point of N, plain at first, then by halves. It exists and is unique while N depends on T weakly
   enough (multibody_friction.c); where it is not found the run ends with FW-D244. A joint that can
   stick does. Cost at an event: n solutions, rounds times n^3. Source: Lotstedt 1982; Pfeiffer and
   Glocker, Multibody Dynamics with Unilateral Contacts, 1996. Test: test_friction.c,
   test_friction_model.c, test_hard_friction.c. */

enum { ROUNDS = 60, PLAIN = 8 };
/* relative to the largest velocity, to mu_s r N; the search for events is twice as patient as the
   decision, so that no decision is an event at once */
static const double fw_rate_noise = 1e-13, fw_statics_equilibrium = 1e-12, fw_still = 1e-6;
static const double fw_limit_noise = 1e-12, fw_floor = 1e-15, fw_can_move = 1e-6;

/* ---- how well flags fit ---- */

void fw_multibody_friction_track(fw_multibody_system *sys, const double *y) {
    struct fw_multibody_frictions *s = sys->friction;
    const int nq = sys->model->nq;
    for (int i = 0; i < nq && s; i++)
        s->speed = fmax(s->speed, fabs(y[nq + i]));
}

static double limit(const struct fw_multibody_frictions *s, int i, double noise) {
    return s->joint[i].rest * s->item[i].press * (1 + noise) + fw_floor;
}

void fw_multibody_friction_fits(fw_multibody_system *sys, double t, const double *y, double *fit) {
    struct fw_multibody_frictions *s = sys->friction;
    bool held = false, known = true;
    for (int i = 0; i < s->n; i++)
        held = held || !s->item[i].slip;
    if (held) known = fw_multibody_evaluate(sys, t, y, true, s->state); /* torques */
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    fw_multibody_friction_rows(sys, pose, y + sys->model->nq);
    for (int i = 0; i < s->n; i++) {
        const fw_multibody_friction_state *f = &s->item[i];
        if (!f->slip)
            fit[i] = known ? limit(s, i, 2 * fw_limit_noise) - fabs(f->torque) : -1;
        else if (f->yields)
            fit[i] = fw_still * s->speed + fw_floor - fabs(s->rate[i]);
        else
            fit[i] = f->slip * s->rate[i] + fw_rate_noise * s->speed + fw_floor;
    }
}

bool fw_multibody_friction_slips(const fw_multibody_system *sys) {
    for (int i = 0; i < sys->model->nfriction; i++)
        if (sys->friction->item[i].slip) return true;
    return false;
}

/* accelerations of entry i per unit of the force that presses it */
static void drag_of(const struct fw_multibody_frictions *s, int i, int nq, double *accel) {
    double coefficient = s->item[i].yields ? s->joint[i].rest : s->joint[i].slide;
    const double *a = s->response + (size_t)i * (size_t)(nq + 3);
    for (int c = 0; c < nq; c++)
        accel[c] = coefficient * a[c];
}

void fw_multibody_friction_pressing(fw_multibody_system *sys, double t, const double *y,
                                    double *force, double *drag) {
    struct fw_multibody_frictions *s = sys->friction;
    const int nq = sys->model->nq;
    bool known = fw_multibody_evaluate(sys, t, y, false, s->state);
    for (int i = 0; i < s->n; i++) {
        force[2 * i] = force[2 * i + 1] = 0;
        if (s->item[i].slip && known) fw_multibody_friction_force(s, i, force + 2 * i);
        if (drag) drag_of(s, i, nq, drag + (size_t)i * (size_t)nq);
    }
}

static int goes(const fw_multibody_friction_state *f) {
    return f->yields ? 0 : f->slip;
}

void fw_multibody_friction_meet(fw_multibody_system *sys, int i) {
    fw_multibody_friction_state *f = &sys->friction->item[i];
    sys->friction->met = i;
    sys->friction->met_slip = goes(f);
    if (f->yields) return;
    f->slip = 0, f->held = (double)NAN; /* at rest here; where it lets go, without a pull back */
}

void fw_multibody_friction_begin(fw_multibody_system *sys) {
    struct fw_multibody_frictions *s = sys->friction;
    if (!s) return;
    for (int i = 0; i < s->n; i++)
        s->item[i].slip = 1, s->item[i].yields = false;
    s->speed = 0;
    s->jam = s->jammed = s->met = -1;
}

/* ---- who is at rest ---- */

/* one that sticks or yields is at rest unless something has torn it away; one that slips, when its
   rate is round-off. Whether further ones came to rest by that. */
static bool find_rests(struct fw_multibody_frictions *s, bool first) {
    bool more = false;
    for (int i = 0; i < s->n; i++) {
        fw_multibody_friction_state *f = &s->item[i];
        bool held = !f->slip || f->yields, was = s->rests[i];
        double most = (first && held ? fw_still : fw_statics_equilibrium) * s->speed + fw_floor;
        s->rests[i] = (was && !first) || fabs(s->rate[i]) <= most;
        more = more || (s->rests[i] && !was);
    }
    for (int i = 0; i < s->n; i++) {
        fw_multibody_friction_state *f = &s->item[i];
        f->yields = false;
        f->slip = s->rests[i] ? 0 : s->rate[i] > 0 ? 1 : -1;
    }
    return more || first;
}

/* ---- sorting ---- */

typedef enum contradiction { NONE, ABOVE, BACKWARDS, FREE } contradiction;

/* what is wrong with entry i at the torques found, and how much */
static contradiction wrong(const struct fw_multibody_frictions *s, int i, double *how) {
    const fw_multibody_friction_state *f = &s->item[i];
    *how = 0;
    if (!s->rests[i]) return NONE;
    if (!f->slip) {
        *how = fabs(f->torque) / limit(s, i, fw_limit_noise);
        return *how > 1 ? ABOVE : NONE;
    }
    bool free = s->left[i] > fw_can_move * s->loose[i];
    if (!free && f->yields) return NONE; /* others hold it: what it would do is round-off */
    double a = s->accel[i] + s->creep[i], size = s->size[i] + fabs(s->creep[i]);
    for (int j = 0; j < s->n; j++) {
        a += s->gain[i * s->n + j] * s->torque[j];
        size += fabs(s->gain[i * s->n + j] * s->torque[j]);
    }
    *how = size > 0 ? -f->slip * a / size : 0;
    if (*how > 1e-9) return BACKWARDS;
    return f->yields ? FREE : NONE;
}

static void mend(struct fw_multibody_frictions *s, int i, contradiction what) {
    fw_multibody_friction_state *f = &s->item[i];
    if (what == ABOVE)
        f->slip = f->torque > 0 ? -1 : 1, f->yields = true;
    else if (what == BACKWARDS)
        f->slip = 0, f->yields = false;
    else
        f->yields = false;
}

/* the worst of the most pressing kind; with `lowest` the first entry (no cycles that way) */
static int choose(const struct fw_multibody_frictions *s, bool lowest, contradiction *what) {
    int found = -1;
    double most = 0;
    *what = NONE;
    for (int i = 0; i < s->n; i++) {
        double how;
        contradiction now = wrong(s, i, &how);
        if (now == NONE) continue;
        bool first = *what == NONE, urgent = now < *what, worse = now == *what && how > most;
        if (lowest ? !first : !(first || urgent || worse)) continue;
        found = i, most = how, *what = now;
    }
    return found;
}

static bool nothing_wrong(const struct fw_multibody_frictions *s) {
    contradiction what;
    return choose(s, true, &what) < 0;
}

/* the flags at hand, the worst contradiction mended one after the other: after the box problem only
   who is held by others and who can move by itself, told apart by what is left of it while those
   that stick hold */
static bool mended(struct fw_multibody_frictions *s) {
    for (int round = 0; round < 8 * s->n + 8; round++) {
        contradiction what;
        int i = choose(s, round > 4 * s->n, &what);
        if (i < 0) return true;
        mend(s, i, what);
        if (!fw_multibody_friction_solve(s)) return false;
    }
    return false;
}

/* flags by the box problem, forces by the flags, until both agree */
static bool agree(struct fw_multibody_frictions *s, int *jam) {
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < s->n; i++)
            s->before[i] = s->item[i].press;
        if (!fw_multibody_friction_box(s)) return false;
        bool solved = fw_multibody_friction_solve(s);
        if (solved && mended(s)) return true;
        if (!solved) *jam = s->jam;
        for (int i = 0; i < s->n; i++) {
            fw_multibody_friction_state *f = &s->item[i];
            if (!s->rests[i]) s->torque[i] = -f->slip * s->joint[i].slide * s->before[i];
            if (!solved) f->press = fw_multibody_friction_press(s, i);
            if (round >= PLAIN) f->press = 0.5 * (f->press + s->before[i]);
        }
    }
    return false;
}

static bool sort(struct fw_multibody_frictions *s) {
    int jam = -1;
    bool solved = fw_multibody_friction_solve(s);
    if (solved && nothing_wrong(s)) return true;
    if (!solved) {
        jam = s->jam;
        if (jam < 0) return false;
        memset(s->torque, 0, (size_t)s->n * sizeof *s->torque);
        for (int i = 0; i < s->n; i++)
            s->item[i].press = fw_multibody_friction_press(s, i);
    }
    if (agree(s, &jam)) return true;
    for (int i = 0; i < s->n; i++) /* where torques are not unique, others may do */
        if (s->rests[i]) s->item[i].slip = 0, s->item[i].yields = false;
    if (fw_multibody_friction_solve(s) && mended(s)) return true;
    s->jam = jam >= 0 ? jam : 0;
    return false;
}

/* a0, lambda0, rows, responses */
static void evaluate(fw_multibody_system *sys, const fw_multibody_factor *factor, const double *v) {
    const fw_multibody_solution *found = fw_multibody_accelerate(sys, factor, v);
    fw_multibody_friction_respond(sys, factor, v);
    fw_multibody_friction_evaluate(sys, found, v);
}

bool fw_multibody_friction_decide(fw_multibody_system *sys, double t, double *y) {
    struct fw_multibody_frictions *s = sys->friction;
    const fw_multibody_factor *factor;
    double *v = y + sys->model->nq;
    if (!s) return true;
    fw_multibody_friction_track(sys, y);
    factor = fw_multibody_factorise(sys, fw_multibody_pose_at(sys, t, y));
    if (!factor) return false;
    for (int i = 0; i < s->n; i++) /* those that stay at rest keep their place */
        s->rests[i] = false, s->held[i] = !s->item[i].slip || s->item[i].yields;
    fw_multibody_friction_respond(sys, factor, v);
    for (int pass = 0; pass <= s->n && find_rests(s, pass == 0); pass++)
        fw_multibody_friction_settle(sys, factor, v);
    for (int i = 0; i < s->n; i++)
        if (s->rests[i] && (!s->held[i] || isnan(s->item[i].held)))
            s->item[i].held = fw_multibody_friction_coordinate(sys->model, factor->pose, i);
    evaluate(sys, factor, v);
    if (!sort(s)) {
        if (s->jam >= 0) s->jammed = s->jam, s->jam_time = t;
        return false;
    }
    if (s->met >= 0) { /* one that holds after all was no event */
        sys->record.events += goes(&s->item[s->met]) != s->met_slip;
        s->met = -1;
    }
    return true;
}

bool fw_multibody_friction_jammed(const fw_multibody_system *sys, double *t, const char **id,
                                  fw_place *place) {
    const struct fw_multibody_frictions *s = sys->friction;
    if (!s || s->jammed < 0) return false;
    *t = s->jam_time, *id = s->joint[s->jammed].id, *place = s->joint[s->jammed].place;
    return true;
}
