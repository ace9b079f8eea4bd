/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which method: asked for by name, or by the masses. Which integrator: asked for by name, or by the
   spectrum of the scene at its start, and by trial where that may be wrong. */
#include "base/constants.h"
#include "dynamics/run.h"
#include <math.h>
#include <string.h>

enum { ROUNDS = 12 };

static const int fw_dense_most = 60; /* bodies: a dense method's time goes with their cube */
static const double fw_uneven_most = 1e3;

/* ---- the method ---- */

/* heaviest body over the lightest one that sits between two joints; a released pin is none */
static fw_status unevenness(fw_dynamics_problem *problem, const fw_effects_loads *loads, int *light,
                            int *heavy) {
    const fw_mechanism *m = problem->mechanism;
    int *joints;
    fw_mark mark = fw_arena_mark(problem->arena);
    FW_NEED(joints = fw_arena_array(problem->arena, int, (size_t)m->nbody));
    for (int i = 0; i < m->npin + m->njoint; i++) {
        const fw_device_joint *t = i < m->npin ? NULL : &m->joint[i - m->npin];
        if (!t && loads->released && loads->released[i]) continue;
        int a = t ? t->body_a : m->pin[i].body_a, b = t ? t->body_b : m->pin[i].body_b;
        if (a != FW_GROUND) joints[a]++;
        if (b != FW_GROUND) joints[b]++;
    }
    *light = *heavy = 0;
    for (int b = 0; b < m->nbody; b++) {
        double mass = m->body[b].mass_kg;
        if (mass > m->body[*heavy].mass_kg) *heavy = b;
        if (joints[b] > 1 && (joints[*light] < 2 || mass < m->body[*light].mass_kg)) *light = b;
    }
    problem->uneven = joints[*light] > 1 ? m->body[*heavy].mass_kg / m->body[*light].mass_kg : 1;
    fw_arena_rewind(problem->arena, mark);
    return FW_OK;
}

/* S = G M^-1 G^T adds the 1/m of both bodies of a joint: behind a light body a heavy one keeps only
   16 - log10(ratio) digits, and the step control follows the noise. Independent coordinates add m
   instead and keep them all. Up to a ratio of 1e3 the noise lies below every tolerance. Test:
   test_hard_masses.c. */
fw_status fw_dynamics_method_choose(fw_dynamics_run *r, const fw_effects_loads *loads) {
    int light, heavy;
    char ratio[32];
    FW_TRY(unevenness(&r->problem, loads, &light, &heavy));
    if (r->problem.options->method || r->problem.uneven <= fw_uneven_most ||
        r->problem.mechanism->nbody > fw_dense_most)
        return FW_OK;
    r->record.motion->method = "coordinate-partitioning";
    const char *a = r->problem.mechanism->body[light].id, *b = r->problem.mechanism->body[heavy].id;
    FW_NEED(r->problem.why = fw_arena_printf(
                r->problem.arena,
                "not by chain, whose forces lose digits there: %s%s between its joints is %s "
                "times lighter than %s",
                FW_NAMED("body", fw_text_name(a)),
                fw_number_text(ratio, sizeof ratio, r->problem.uneven, 2), fw_text_name(b)));
    return FW_OK;
}

/* ---- the integrator ---- */

static double norm(const double *x, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sqrt(sum);
}

/* out = J z by a central difference of the right-hand side at (t, y), over 2 `reach` */
static void product(const fw_dynamics_problem *problem, double t, const double *y, const double *z,
                    double reach, double *at, double *more, double *out) {
    const fw_multibody_model *m = problem->model;
    int n = 2 * m->nq;
    double e = reach / fmax(norm(z, n), 1e-300);
    for (int sign = -1; sign <= 1; sign += 2) {
        memcpy(at, y, (size_t)m->ny * sizeof *at);
        for (int i = 0; i < n; i++)
            at[i] += sign * e * z[i];
        fw_multibody_rhs_motion(problem->system, t, at, sign < 0 ? more : out);
    }
    for (int i = 0; i < n; i++)
        out[i] = (out[i] - more[i]) / (2 * e);
}

/* largest |eigenvalue| of the right-hand side's Jacobian J at (t, y), scaled: power iteration with J^2, whose dominant
   eigenvalues are real for oscillations too. A lower bound that is within a few per cent when the spectrum has a gap; a choice
   needs no more. Cost 48 evaluations. Source: Golub and Van Loan, ch. 7. Test: test_choose.c. shape (nq): its velocities;
   NULL: not asked for */
static fw_status fastest(const fw_dynamics_problem *problem, double t, const double *y,
                         double reach, double *rate, double *shape) {
    const fw_multibody_model *m = problem->model;
    size_t n = (size_t)m->ny;
    double *work[5];
    fw_mark mark = fw_arena_mark(problem->arena);
    for (int i = 0; i < 5; i++)
        FW_NEED(work[i] = fw_arena_array(problem->arena, double, n));
    double *z = work[0], *w = work[1];
    for (size_t i = 0; i < n; i++) /* any vector without symmetry */
        z[i] = i < 2 * (size_t)m->nq ? cos(1.0 + 1.7 * (double)i) : 0;
    *rate = 0;
    for (int k = 0; k < ROUNDS; k++) {
        double before = norm(z, 2 * m->nq);
        if (!(before > 0) || !isfinite(before)) break;
        for (size_t i = 0; i < n; i++)
            z[i] /= before;
        product(problem, t, y, z, reach, work[2], work[3], w);
        product(problem, t, y, w, reach, work[2], work[3], work[4]);
        double *swap = z;
        z = work[4], work[4] = swap;
        if (k > 1) *rate = fmax(*rate, sqrt(norm(z, 2 * m->nq)));
    }
    if (!isfinite(*rate)) *rate = 0;
    if (shape) memcpy(shape, z + m->nq, (size_t)m->nq * sizeof *shape);
    fw_arena_rewind(problem->arena, mark);
    return FW_OK;
}

/* rad^2 per scaled time^2 that an element's stated stiffness can add: 1/m and r^2/J of its ports */
static double stated_square(const fw_multibody_model *m, const fw_effects_force_element *e) {
    double free = 0, unit = m->scale.time_s * m->scale.time_s / m->scale.mass_kg;
    for (int i = 0; i < e->ports; i++) {
        const fw_effects_port *p = &e->port[i];
        double arm = hypot(p->x_m, p->y_m) / m->scale.length_m;
        if (p->body != FW_GROUND) free += m->minv[p->body] + arm * arm * m->jinv[p->body];
    }
    return e->size_N_per_m * unit * free;
}

/* a contact so many times farther open than the motion is long by linear statics: taken for one that never acts */
static bool is_out_of_reach(const fw_dynamics_problem *problem, const fw_effects_force_element *e,
                            double value) {
    const double far_m = 100 * problem->amplitude * problem->model->scale.length_m;
    return e->class_->pressing && -value > far_m * e->size_N_per_m;
}

/* the same with all switches of elements on: a stiff contact may be open at the start. 0: none is off, or all that are stay
   out of reach. Where the formula of one means nothing there (two points that coincide have no direction), the rate depends
   on how far it is looked at; then what they state counts. *own: of the contacts themselves, which may be softer than what is
   fastest without them */
static fw_status fastest_in_touch(const fw_dynamics_problem *problem, double before, double *rate,
                                  double *own) {
    const fw_multibody_model *m = problem->model;
    bool *on = problem->system->on.element;
    double stated = 0, farther, *value;
    bool idle = false;
    *rate = *own = 0;
    fw_mark mark = fw_arena_mark(problem->arena);
    FW_NEED(value = fw_arena_array(problem->arena, double, (size_t)fw_multibody_switch_count(m)));
    fw_multibody_switch_values(problem->system,
                               fw_multibody_pose_at(problem->system, 0, problem->start),
                               problem->start + m->nq, value);
    value += m->nstop + m->ncable;
    for (int i = 0; i < m->nelement; i++)
        for (int k = 0; k < m->element[i].own->switches; k++, on++, value++) {
            if (*on || is_out_of_reach(problem, m->element[i].own, *value)) continue;
            stated += stated_square(m, m->element[i].own);
            *on = idle = true;
        }
    fw_arena_rewind(problem->arena, mark);
    if (!idle) return FW_OK;
    FW_TRY(fastest(problem, 0, problem->start, 1e-6, rate, NULL));
    FW_TRY(fastest(problem, 0, problem->start, 1e-5, &farther, NULL));
    bool sound = fabs(farther - *rate) <= 0.2 * *rate;
    if (!sound || !(*rate > 1.01 * before)) *rate = sqrt(before * before + stated);
    *own = fmin(*rate, sqrt(stated));
    fw_multibody_set_switches(problem->system, 0, problem->start);
    return FW_OK;
}

/* omega^2 = |F.u| / u^T M u for the static response u to F, scaled; of what is buckled the rate at which it leaves; 0: none */
static fw_status rayleigh(const fw_dynamics_problem *problem, const fw_effects_loads *loads,
                          const double *force, double *u, double *rotation, double *rate) {
    double work = 0, mass = 0;
    bool valid = false;
    FW_TRY(fw_effects_static_response(problem->arena, problem->mechanism, loads, force, u, rotation,
                                      &valid));
    for (int i = 0; i < problem->model->nq && valid; i++) {
        const fw_mechanism_mass *b = &problem->mechanism->body[i / 3];
        work += force[i] * u[i];
        mass += (i % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * u[i] * u[i];
    }
    *rate = valid && mass > 0 ? sqrt(fabs(work) / mass) * problem->model->scale.time_s : 0;
    return FW_OK;
}

/* 1 per scaled time at which motion along u (nq, scaled by any factor) dies away, by damping: half
   of the quotient of power and kinetic energy */
static fw_status dying(const fw_dynamics_problem *problem, const double *u, double *rate) {
    const fw_multibody_model *m = problem->model;
    double *work[4], power = 0, mass = 0;
    size_t n = (size_t)m->nq;
    fw_mark mark = fw_arena_mark(problem->arena);
    for (int i = 0; i < 4; i++)
        FW_NEED(work[i] = fw_arena_array(problem->arena, double, (size_t)m->ny));
    for (size_t i = 0; i < n; i++)
        work[0][n + i] = u[i];
    product(problem, 0, problem->start, work[0], 1e-6, work[1], work[2], work[3]);
    for (size_t i = 0; i < n; i++) {
        double v = work[0][n + i], b = i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3];
        power -= b * v * work[3][n + i];
        mass += b * v * v;
    }
    *rate = mass > 0 && power > 0 ? 0.5 * power / mass : 0;
    fw_arena_rewind(problem->arena, mark);
    return FW_OK;
}

/* rad per scaled unit of time of the motion that is excited: by the loads at their largest, else by
   the starting velocities, whose momenta stand in for forces; 0 for a free motion. And how it dies
   away. Source: Rayleigh's quotient. */
static fw_status excited(const fw_dynamics_problem *problem, const fw_effects_loads *loads,
                         double *rate, double *dies) {
    const fw_mechanism *m = problem->mechanism;
    size_t n = 3 * (size_t)m->nbody;
    double *force, *u, *rotation;
    fw_mark mark = fw_arena_mark(problem->arena);
    FW_NEED(force = fw_arena_array(problem->arena, double, n));
    FW_NEED(u = fw_arena_array(problem->arena, double, n));
    FW_NEED(rotation = fw_arena_array(problem->arena, double, (size_t)m->npin));
    fw_effects_loads_largest_force(m, loads, problem->scene->duration_s, force);
    FW_TRY(rayleigh(problem, loads, force, u, rotation, rate));
    const fw_multibody_scale s = problem->model->scale;
    for (size_t i = 0; i < n; i++) /* SI momenta over a second */
        force[i] =
            problem->start[n + i] *
            (i % 3 == 2 ? m->body[i / 3].inertia_kg_m2 : m->body[i / 3].mass_kg * s.length_m) /
            s.time_s;
    if (*rate == 0) FW_TRY(rayleigh(problem, loads, force, u, rotation, rate));
    *dies = 0;
    for (size_t i = 0; i < n; i++)
        u[i] /= i % 3 == 2 ? 1 : s.length_m;
    if (*rate > 0) FW_TRY(dying(problem, u, dies));
    fw_arena_rewind(problem->arena, mark);
    return FW_OK;
}

/* instructions, roughly */
typedef struct cost {
    double explicit_, implicit; /* of a step */
} cost;

/* A right-hand side costs what its effects state (docs/theory/effects/costs.md) and 1300 per body,
   300 on the fast kernel, and in dense methods a factorisation. A step of dop853 takes 12, three
   more for dense output, and nine looks at joint forces; one of radau5, as measured, 12 of lean
   ones, its Jacobian included, and the same nine, besides one real and one complex
   factorisation of size n every second step and five solutions. */
static cost prices(const fw_dynamics_recorder *record) {
    const fw_multibody_model *m = record->problem->model;
    const fw_effect_ledger *l = &record->motion->ledger;
    double n = m->nq, rhs = (record->problem->system->kernel ? 300 : 1300) * (1 + n / 3);
    for (int i = 0; i < l->count && !record->problem->system->kernel; i++)
        if (l->item[i].active) rhs += l->item[i].cost;
    if (m->method->independent) rhs += n * n * n;
    double looks = record->problem->options->reactions ? 9 : 0;
    return (cost){.explicit_ = (15 + looks) * rhs,
                  .implicit = (12 + looks) * rhs + 2.5 * n * n * n + 50 * n * n};
}

typedef struct spectrum {  /* rad per scaled time */
    double fast, touching; /* the fastest motion; once all contacts touch, 0: none is open */
    double pressing;       /* of these contacts themselves */
    double slow, dying;    /* what is excited, and how it dies away */
    double ringing; /* scaled time for which the fastest motion is more than what is wanted */
    double share;   /* its amplitude then, over that of the motion */
} spectrum;

/* Amplitude of the fastest mode z of rate w after the largest loads F came at once, and with the
   starting velocities v, as far as it is wanted to be right:
     A = |z.F|/(z.M z w^2) + |z.M v|/(z.M z w),  |A e^(-d t)| > wanted/4
   Loads that come slowly excite less: then implicit steps are taken for dearer than they are.
   Source: modal superposition. Test: test_choose.c (what_is_not_excited). */
static fw_status ringing(fw_dynamics_recorder *record, const fw_effects_loads *loads,
                         const double *z, double time, spectrum *s) {
    const fw_multibody_model *m = record->problem->model;
    double *force, load = 0, momentum = 0, mass = 0, most = 0, dies;
    const fw_multibody_scale unit = m->scale;
    fw_mark mark = fw_arena_mark(record->problem->arena);
    FW_NEED(force = fw_arena_array(record->problem->arena, double, (size_t)m->nq));
    fw_effects_loads_largest_force(record->problem->mechanism, loads,
                                   record->problem->scene->duration_s, force);
    double newton = unit.mass_kg * unit.length_m / (unit.time_s * unit.time_s);
    for (int i = 0; i < m->nq; i++) {
        bool turn = i % 3 == 2;
        double b = turn ? m->inertia[i / 3] : m->mass[i / 3];
        load += z[i] * force[i] / (turn ? newton * unit.length_m : newton);
        momentum += b * z[i] * record->problem->start[m->nq + i];
        mass += b * z[i] * z[i];
        most = fmax(most, fabs(z[i]));
    }
    fw_arena_rewind(record->problem->arena, mark);
    s->ringing = s->share = 0;
    if (!(mass > 0) || !(s->fast > 0)) return FW_OK;
    double amplitude = (fabs(load) / s->fast + fabs(momentum)) / (mass * s->fast) * most;
    double wanted = record->problem->options->rtol > 0 ? 1e3 * record->problem->options->rtol
                                                       : fw_dynamics_tolerance_wanted(record);
    FW_TRY(dying(record->problem, z, &dies));
    s->share = fmin(1, amplitude / record->problem->amplitude);
    if (s->share > wanted / 4) s->ringing = fmin(time, log(4 * s->share / wanted) / dies);
    return FW_OK;
}

/* the tolerance of the answer */
static double tolerance(const fw_dynamics_run *r, const char *name) {
    if (r->problem.options->rtol > 0) return r->problem.options->rtol;
    return fw_dynamics_tolerance_start(&r->control, fw_maths_stepper_find(name),
                                       fw_dynamics_tolerance_wanted(&r->record))
        .rtol;
}

/* Steps of radau5: 8 per rad at a tolerance of 1e-7, as measured on one undamped mode, twice as many where faster modes are
   excited besides: 12 are taken. The error of a motion that dies away grows with its fourth power, so that it counts for four
   of its times. Contacts excite what they are as stiff as, for as long as an impact takes: in between, the geometric mean.
   The fastest motion is passed over only where it is less than what is wanted; steps go with the fifth root of an amplitude. */
static double implicit_steps(const fw_dynamics_run *r, const spectrum *s, double time) {
    double count = fmin(time, s->dying > 0 ? 4 / s->dying : time) * s->slow;
    if (s->touching > 0) count = fmax(count, time * sqrt(s->slow * s->pressing));
    count += s->fast * s->ringing * pow(s->share, 0.2);
    return fmax(80, 12 * count) * pow(tolerance(r, "radau5") / 1e-7, -0.2);
}

/* Steps of dop853 that the tolerance needs: one per rad at 1e-7 and at least thirty */
static double explicit_steps(const fw_dynamics_run *r, const spectrum *s, double time) {
    return fmax(30, time * s->slow) * pow(tolerance(r, "dop853") / 1e-7, -0.1);
}

static fw_status report_choice(fw_dynamics_recorder *record, const spectrum *s, bool stiff,
                               double stable, double most) {
    double unit = record->problem->model->scale.time_s;
    bool later = s->touching > s->fast;
    char a[32], b[32], c[32], d[32];
    fw_number_text(c, sizeof c, ceil(stable), 2);
    fw_number_text(d, sizeof d, most, 2);
    const char *but = stiff ? "implicit ones pass over the fast motion"
                            : "which cost less than implicit ones that pass over it";
    if (!stiff && stable < 5 * fmax(200, record->problem->scene->duration_s / unit * s->slow))
        record->motion->reason =
            fw_arena_printf(record->problem->arena,
                            "auto: not stiff (%s explicit steps would be stable), so order 8", c);
    else
        record->motion->reason = fw_arena_printf(
            record->problem->arena,
            "auto: stiff, the fastest motion has %s rad/s%s where %s rad/s are excited; explicit "
            "steps need %s for stability, %s (a step costs %s explicit ones)",
            fw_number_text(a, sizeof a, fmax(s->fast, s->touching) / unit, 2),
            later ? " (once all contacts touch)" : "",
            fw_number_text(b, sizeof b, s->slow / unit, 2), c, but, d);
    FW_NEED(record->motion->reason);
    return FW_OK;
}

/* Loads and drivers that come slowly against what they excite do not excite it: the motion goes along with them, as in a stage
   that a driver moves, whose static response is one of the stiffest. What is left of the motion counts as one period over the
   scene. forced false: no force says what is excited, as drivers and heat have none; contacts that are still open come in
   besides, by themselves. Test: test_choose.c */
static void gentle(const fw_dynamics_problem *problem, const fw_effects_loads *loads, double time,
                   double wanted, bool forced, spectrum *s) {
    const fw_dynamics_motion *like = problem->options->like;
    if ((s->touching > 0 && forced) || (like && like->stats.beyond > 1)) return;
    double unit = problem->model->scale.time_s;
    if (!fw_dynamics_run_gentle(problem, loads, s->slow / unit, wanted, !forced)) return;
    s->slow = 2 * FW_PI / time, s->ringing = 0;
}

/* The cheaper of two costs, each a number of steps times instructions of a step. Explicit steps of order 8 are stable up to
   |eigenvalue| h of about 6 and need about one per radian of the motion wanted; those of radau5 pass over fast modes. Right
   within a factor of 1.5 of the better one on the scenes of docs/theory/integrators.md. Test: test_choose.c. */
static fw_status choose(fw_dynamics_run *r, const fw_effects_loads *loads) {
    const fw_multibody_model *m = r->problem.model;
    double time = r->problem.scene->duration_s / m->scale.time_s;
    spectrum s;
    double *shape;
    FW_NEED(shape = fw_arena_array(r->problem.arena, double, (size_t)m->nq));
    FW_TRY(fastest(&r->problem, 0, r->problem.start, 1e-6, &s.fast, shape));
    FW_TRY(fastest_in_touch(&r->problem, s.fast, &s.touching, &s.pressing));
    FW_TRY(excited(&r->problem, loads, &s.slow, &s.dying));
    FW_TRY(ringing(&r->record, loads, shape, time, &s));
    double most = fmax(s.fast, s.touching);
    const bool forced = s.slow > 0;
    if (!(s.slow > 0) || s.slow > most) s.slow = most; /* a nearly rigid response says nothing */
    gentle(&r->problem, loads, time, fw_dynamics_tolerance_wanted(&r->record), forced, &s);
    const cost p = prices(&r->record);
    double stable = time * most / 6, explicit_ = explicit_steps(r, &s, time);
    /* contacts that are open at the start touch for a part of the time: half */
    explicit_ = fmax(explicit_, s.touching > s.fast ? fmax(time * s.fast / 6, stable / 2) : stable);
    double implicit = implicit_steps(r, &s, time);
    bool stiff = implicit * p.implicit < explicit_ * p.explicit_;
    r->control.integrator = fw_maths_stepper_find(stiff ? "radau5" : "dop853");
    /* what is stiff only later, such as a film that closes, shows in the number of steps; beyond
       300 components a factorisation costs more than any of them */
    r->control.patience = !stiff && m->ny <= 300 ? 5000 + 30 * explicit_ : 0;
    r->control.stable = stable, r->control.needed = explicit_steps(r, &s, time);
    r->control.implicit_cost = stiff || m->ny <= 300 ? p.implicit / p.explicit_ : 0;
    r->control.chosen_cost = stiff ? p.implicit / p.explicit_ : 0;
    return report_choice(&r->record, &s, stiff, stable, p.implicit / p.explicit_);
}

/* Many steps alone are no sign: a tight tolerance or a fast motion takes them too. Explicit steps
   of order 8 are stable up to |eigenvalue| h of about 6, and their control keeps them between half
   and all of it; steps well below are as short as the tolerance wants them. Source: Hairer and
   Wanner II, IV.2 (detection of stiffness). Test: test_choose.c. */
fw_status fw_dynamics_integrator_stuck(const fw_dynamics_problem *problem,
                                       const fw_maths_stepper *s, bool *stuck) {
    double rate;
    FW_TRY(fastest(problem, s->t, s->y, 1e-6, &rate, NULL));
    *stuck = s->h * rate > 2;
    return FW_OK;
}

fw_status fw_dynamics_integrator_change(fw_dynamics_run *r) {
    char steps[32], at[32];
    fw_number_text(steps, sizeof steps, r->control.patience, 2);
    fw_number_text(at, sizeof at, r->control.given_up_s, 3);
    r->control.integrator = fw_maths_stepper_find("radau5");
    r->record.motion->integrator = r->control.integrator->name;
    r->control.patience = r->control.implicit_cost = 0;
    r->control.given_up_s = (double)NAN;
    FW_NEED(r->record.motion->reason = fw_arena_printf(
                r->problem.arena,
                "auto: not stiff at the start, but by %s s explicit steps had become so small that "
                "%s were not enough; implicit ones pass over what is fast there",
                at, steps));
    return FW_OK;
}

/* An implicit one that was chosen because it passes over what is fast: a tolerance that has to
   resolve the fast vibrations all the same makes its steps, of order 5, many more than those of
   order 8 that stability allows. steps: of the run whose tolerance was not tight enough; the next one,
   a hundred times tighter, takes 100^(1/5) times as many at least. Test: test_choose.c,
   implicit_steps_that_grew_too_many. */
static const double fw_growth = 2.5;

fw_status fw_dynamics_integrator_back(fw_dynamics_run *r, long steps, bool *changed) {
    double explicit_ = fmax(r->control.needed, r->control.stable);
    double most = fw_growth * (double)steps, paid = most * r->control.chosen_cost;
    *changed = r->control.integrator == &fw_maths_radau5_row && paid > 2 * explicit_ &&
               r->control.chosen_cost > 0;
    if (!*changed) return FW_OK;
    char times[32];
    r->control.integrator = &fw_maths_dop853_row;
    r->record.motion->integrator = r->control.integrator->name;
    r->control.patience = r->control.implicit_cost = r->control.chosen_cost = 0;
    FW_NEED(
        r->record.motion->reason = fw_arena_printf(
            r->problem.arena,
            "auto: implicit steps pass over what is fast, but the tolerance needs %.0f of them, "
            "each %s times as expensive as an explicit one, of which stability needs %.0f",
            most, fw_number_text(times, sizeof times, paid / most, 2), explicit_));
    return FW_OK;
}

fw_status fw_dynamics_integrator_choose(fw_dynamics_run *r, const fw_effects_loads *loads,
                                        const char *name) {
    if (!name || strcmp(name, "auto") == 0) {
        FW_TRY(choose(r, loads));
        if (r->problem.idle) { /* explicit steps would follow what round-off makes of stiff axes */
            r->control.integrator = &fw_maths_radau5_row;
            r->record.motion->reason =
                "auto: nothing acts, so that there is nothing fast to follow";
        }
    } else {
        r->control.integrator = fw_maths_stepper_find(name);
        r->record.motion->reason = "asked for";
    }
    r->record.motion->integrator = r->control.integrator->name;
    return FW_OK;
}

/* ---- the integrator by trial ---- */

/* Which integrator, by trial. A choice by estimates (choose.c) may be wrong by much where what is
   fast is hardly excited, or comes up only on the way. The looser run is cheap: where one of the
   signs below says so it is made by the other integrator too, which may cost two fifths of the
   first one's steps, and takes over when it gets to the end with that.

     explicit, before: stability will hold its steps short, needed < stable/2, stable >= 200
     explicit, after:  it did, N < 2 stable and N >= 200, or something else did that nobody saw,
                       N > 5 max(needed, stable) and N >= 60
     implicit, after:  it took more than explicit steps should cost, max(needed, stable) < N cost/2

   with N steps of the looser run, `needed` and `stable` explicit ones (choose.c), and the cost of
   an implicit step in explicit ones. Two fifths, because the answer's tolerance, some ten times
   lower, lengthens implicit runs by 10^0.2 to 10^0.25, and those not whose steps stability keeps
   short. Cost: at most two fifths of the looser run, where it loses. Error: no answer changes but
   by the integrator. Statistics: docs/theory/integrators.md. Source: Hairer and Wanner II, IV.2
   (detection of stiffness). Test: test_choose.c. */
static const double fw_share = 0.4;
static const long fw_many = 200, fw_some = 60;

static fw_dynamics_integrator_trial implicit_one(const fw_dynamics_controller *control,
                                                 double steps) {
    return (fw_dynamics_integrator_trial){&fw_maths_radau5_row,
                                          (long)(fw_share * steps / control->implicit_cost)};
}

fw_dynamics_integrator_trial fw_dynamics_integrator_trial_of(const fw_dynamics_controller *control,
                                                             long steps) {
    const fw_dynamics_integrator_trial none = {NULL, 0};
    bool watched = control->problem->options->unsettled || control->problem->options->other ||
                   control->problem->sudden;
    double explicit_ = fmax(control->needed, control->stable), n = (double)steps;
    if (watched || !(control->implicit_cost > 0)) return none;
    if (control->integrator == &fw_maths_radau5_row) {
        double paid = n * control->implicit_cost;
        return explicit_ < 0.5 * paid
                   ? (fw_dynamics_integrator_trial){&fw_maths_dop853_row, (long)(fw_share * paid)}
                   : none;
    }
    if (steps == 0)
        return control->needed < 0.5 * control->stable && control->stable >= (double)fw_many
                   ? implicit_one(control, control->stable)
                   : none;
    bool held = steps >= fw_many && n < 2 * control->stable;
    bool unseen = steps >= fw_some && n > 5 * explicit_;
    return held || unseen ? implicit_one(control, n) : none;
}

fw_status fw_dynamics_integrator_trial_won(fw_dynamics_run *r, long before, long steps) {
    bool implicit = r->control.integrator == &fw_maths_radau5_row;
    const char *names[2] = {"explicit", "implicit"};
    FW_NEED(r->record.motion->reason = fw_arena_printf(
                r->problem.arena,
                "auto: tried, %s steps %s %ld, %s ones take %ld (an implicit one costs %.2g "
                "explicit ones)",
                names[!implicit], before > 0 ? "take" : "would take",
                before > 0 ? before : (long)r->control.stable, names[implicit], steps,
                r->control.implicit_cost));
    r->record.motion->integrator = r->control.integrator->name;
    r->control.patience = r->control.implicit_cost = 0; /* that is the last word */
    return FW_OK;
}

/* ---- what is asked for ---- */

/* What comes in at the border of this room, and the integrators and stabilisations that can be
   asked for by name. */

static fw_status usage(fw_status status) {
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* ---- names ---- */

static fw_status pick(fw_diags *diags, int number, const char *what, const char *wanted,
                      fw_multibody_method_row (*at)(size_t), const char **name) {
    *name = at(0).name;
    if (!wanted) return FW_OK;
    fw_text names = fw_text_new(diags->arena);
    for (size_t i = 0; at(i).name; i++) {
        if (strcmp(at(i).name, wanted) == 0) {
            *name = at(i).name;
            return FW_OK;
        }
        fw_text_printf(&names, "%s%s", i ? ", " : "", at(i).name);
    }
    FW_TRY(fw_text_end(&names));
    return usage(fw_diag_error(diags, number, (fw_place){0},
                               "there is no %s \"%.60s\"; known are %s", what, wanted, names.data));
}

fw_status fw_dynamics_check_names(const fw_dynamics_motion_options *o, fw_diags *diags,
                                  fw_dynamics_motion *motion) {
    FW_TRY(pick(diags, 103, "method", o->method, fw_multibody_method_at, &motion->method));
    FW_TRY(pick(diags, 104, "integrator", o->integrator, fw_dynamics_integrator_at,
                &motion->integrator));
    return pick(diags, 104, "stabilisation", o->stabilise, fw_dynamics_stabilisation_at,
                &motion->stabilise);
}

fw_status fw_dynamics_check_options(const fw_dynamics_motion_options *o, fw_diags *diags) {
    if (!(o->rtol >= 0) || !isfinite(o->rtol) || !(o->accuracy >= 0) || !isfinite(o->accuracy) ||
        o->samples < 0)
        return usage(fw_diag_error(diags, 105, (fw_place){0},
                                   "rtol, accuracy and samples must be finite and not negative"));
    return FW_OK;
}

/* ---- what there is ---- */

fw_multibody_method_row fw_dynamics_integrator_at(size_t i) {
    size_t count;
    const fw_maths_stepper_row *const *stepper = fw_maths_stepper_table(&count);
    if (i == 0)
        return (fw_multibody_method_row){"auto",
                                         "chooses by the spectrum of the scene and says why"};
    return i <= count ? (fw_multibody_method_row){stepper[i - 1]->name, stepper[i - 1]->summary}
                      : (fw_multibody_method_row){NULL, NULL};
}

fw_multibody_method_row fw_dynamics_stabilisation_at(size_t i) {
    static const fw_multibody_method_row row[] = {
        {"projection", "every accepted step is moved onto the constraints, to round-off"},
        {"baumgarte", "violations are damped away by the equations; an error floor remains"},
        {"none", "violations grow; for comparison"},
        {NULL, NULL},
    };
    return row[i < 3 ? i : 3];
}
