/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Follows the equilibria of a scene through its time, step by step (quasi_static_step.c), and says
   whether a scene moves like that or with inertia. Test: test_quasi.c. */
#include "base/constants.h"
#include "statics/statics_equilibrium.h"
#include "assembly/assembly.h"
#include "base/sort.h"
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double fw_least = 1e-10; /* step, relative to the scene */
static const long fw_usual_steps = 10 * 1000 * 1000;

/* ---- steps ---- */

static const fw_quantity_law *law_at(const fw_statics_quasi_static *r,
                                     const fw_effects_loads *loads, int i) {
    return i < loads->ntimed ? loads->timed[i].law : &r->w.mechanism->driver[i - loads->ntimed].law;
}

/* an eighth of a period: no step can take one wave for another */
static double own_step(const fw_quantity_law *law) {
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    return wave.fastest_Hz > 0 ? wave.shortest_s / 8 : (double)INFINITY;
}

/* smooth pieces between the breaks of all laws, and how long steps may be */
static fw_status look_at_laws(fw_statics_quasi_static *r, const fw_effects_loads *loads) {
    int laws = loads->ntimed + r->w.mechanism->ndriver, have = 0, kept = 0;
    double end = r->w.scene->duration_s, second = r->w.model->scale.time_s, *at;
    for (int i = 0; i < laws; i++)
        have += fw_quantity_law_breaks_of(law_at(r, loads, i), end, NULL, 0);
    FW_NEED(at = fw_arena_array(r->w.arena, double, (size_t)have + 1));
    FW_NEED(r->look = fw_arena_array(r->w.arena, fw_quantity_law_strides, (size_t)laws));
    FW_NEED(r->look_row = fw_arena_array(r->w.arena, int, (size_t)laws));
    r->law_step_s = end / 8;
    for (int i = 0, first = 0; i < laws; i++) {
        const fw_quantity_law *law = law_at(r, loads, i);
        int count = fw_quantity_law_breaks_of(law, end, at + first, have - first);
        fw_sort_doubles(at + first, (size_t)count);
        if (!isfinite(own_step(law)) && !fw_quantity_law_is_straight(law))
            FW_TRY(fw_quantity_law_look(r->w.arena, law, i >= loads->ntimed, end, at + first, count,
                                        &r->look[r->nlook++]));
        first += count;
        r->law_step_s = fmin(r->law_step_s, own_step(law));
    }
    fw_sort_doubles(at, (size_t)have);
    for (int i = 0; i < have; i++)
        if (at[i] > 0 && at[i] < end && (kept == 0 || at[i] > at[kept - 1])) at[kept++] = at[i];
    at[kept++] = end;
    for (int i = 0; i < kept; i++)
        at[i] /= second;
    r->end = at;
    r->npiece = kept;
    r->duration = end / second;
    return FW_OK;
}

static double longest_step(const fw_statics_quasi_static *r, double t) {
    double second = r->w.model->scale.time_s, most = r->law_step_s;
    for (int i = 0; i < r->nlook; i++)
        most = fmin(most, fw_quantity_law_stride(&r->look[i], 1, t * second, &r->look_row[i]));
    return most / second;
}

static fw_status cannot(fw_statics_quasi_static *r, double t, const char *what) {
    char at[32];
    FW_NEED(r->why =
                fw_arena_printf(r->w.arena, "%s at %s s: inertia acts", what,
                                fw_number_text(at, sizeof at, t * r->w.model->scale.time_s, 4)));
    return FW_SOLVER;
}

static fw_status too_many(const fw_statics_quasi_static *r, long most) {
    char count[32];
    fw_status status = fw_diag_error(r->w.diags, 108, r->w.scene->place,
                                     "%s%s needs more than %s equilibria: shorten it",
                                     FW_NAMED("scene", fw_statics_equilibrium_scene_name(&r->w)),
                                     fw_number_text(count, sizeof count, (double)most, 9));
    return status == FW_NOMEM ? FW_NOMEM : FW_LIMIT;
}

static bool turned_too_far(const fw_statics_quasi_static *r) {
    double most = r->options->most_angle_rad;
    for (int i = 0; most > 0 && i < r->motion->npin; i++)
        if (fabs(r->motion->peak[i].angle_rad) > most) return true;
    return false;
}

static void swap_ends(fw_statics_quasi_static *r) {
    fw_statics_node old = r->from;
    r->from = r->to;
    r->to = old;
}

/* from the piece's start to `end`; *h is the step to try first, and last was good */
static fw_status walk(fw_statics_quasi_static *r, double end, double *h) {
    long most = r->options->most_steps > 0 ? r->options->most_steps : fw_usual_steps;
    while (r->from.t < end && !r->motion->ended) {
        if (fw_arena_cancelled(r->w.arena)) return FW_CANCELLED;
        if (r->solved > most) return too_many(r, most);
        double step = fmin(*h, longest_step(r, r->from.t)), left = end - r->from.t;
        double before = r->size, t = step >= 0.999 * left ? end : r->from.t + fmin(step, left / 2);
        fw_status status = fw_statics_quasi_static_step(r, t);
        if (status != FW_OK && status != FW_SOLVER) return status;
        double off = status == FW_OK ? fw_statics_quasi_static_miss(r) : (double)INFINITY;
        double bear = fmax(r->tolerance * r->size, 1e-13), grow = 0.9 * sqrt(sqrt(bear / off));
        if (!(off <= bear)) {
            r->size = before;
            r->rejected++;
            *h = (t - r->from.t) * (status == FW_OK ? fmax(0.1, fmin(0.7, grow)) : 0.25);
            if (*h < fw_least * r->duration)
                return cannot(r, r->from.t,
                              "the sequence of equilibria ends, as at a "
                              "snap-through,");
            continue;
        }
        r->worst = fmax(r->worst, off);
        *h = (t - r->from.t) * fmin(4, fmax(0.5, grow));
        FW_TRY(fw_statics_quasi_static_record(r));
        r->motion->ended = t < r->duration && turned_too_far(r);
        r->motion->end_s = t * r->w.model->scale.time_s;
        fw_arena_tell(r->w.arena, "sequence of equilibria", r->motion->end_s,
                      r->duration * r->w.model->scale.time_s, "s");
        swap_ends(r);
    }
    return FW_OK;
}

static fw_status follow(fw_statics_quasi_static *r) {
    double second = r->w.model->scale.time_s;
    r->motion->observed = r->options->context;
    if (r->options->observe) r->options->observe(r->options->context, NULL);
    if (r->options->observe && r->options->trace) r->options->trace(r->options->context, NULL);
    for (int piece = 0; piece < r->npiece && !r->motion->ended; piece++) {
        double begin = piece ? r->end[piece - 1] : 0, h = (r->end[piece] - begin) / 16;
        r->piece_s = 0.5 * (begin + r->end[piece]) * second;
        fw_status status = fw_statics_quasi_static_land(r, begin);
        if (status == FW_SOLVER) return cannot(r, begin, "there is no stable equilibrium near");
        FW_TRY(status);
        r->first = true;
        FW_TRY(fw_statics_quasi_static_begin(r));
        FW_TRY(walk(r, r->end[piece], &h));
    }
    return FW_OK;
}

/* ---- the entry ---- */

static fw_status nodes(fw_statics_quasi_static *r) {
    fw_statics_node *node[] = {&r->from, &r->middle, &r->to};
    size_t n = (size_t)r->w.model->nq;
    for (int i = 0; i < 3; i++) {
        FW_NEED(node[i]->u = fw_arena_array(r->w.arena, double, n));
        FW_NEED(node[i]->v = fw_arena_array(r->w.arena, double, n));
    }
    FW_NEED(r->rate = fw_arena_array(r->w.arena, double, n));
    FW_NEED(r->guess = fw_arena_array(r->w.arena, double, n));
    FW_NEED(r->accel = fw_arena_array(r->w.arena, double, n));
    return FW_OK;
}

static double cpu_seconds(void) {
    struct timespec now;
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0;
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* what this room knows how to take at one time: no history, no laws inside of elements */
static const char *not_at_rest(const fw_effects_loads *t) {
    for (int i = 0; i < 3 * t->nbody; i++)
        if (t->velocity[i] != 0) return "the scene starts with velocities: inertia carries them on";
    if (t->nfriction > 0) return "friction has no equilibrium of its own: inertia acts";
    if (t->stretch.law) return "the ground stretches with time: inertia acts";
    for (int i = 0; i < t->nelement; i++)
        if (t->element[i].laws > 0) return "an actuator follows a law: inertia acts";
    return NULL;
}

fw_status fw_statics_quasi_static_motion(fw_arena *arena, const fw_mechanism *mechanism,
                                         const fw_device_scene *scene,
                                         const fw_dynamics_motion_options *options,
                                         const fw_effect_ledger *ledger,
                                         const fw_effects_loads *loads, fw_diags *diags,
                                         const fw_dynamics_motion **motion, const char **why) {
    fw_statics_quasi_static r = {
        .w = {.arena = arena, .mechanism = mechanism, .scene = scene, .diags = diags},
        .options = options};
    double began = cpu_seconds(), accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    *motion = NULL;
    r.why = not_at_rest(loads);
    *why = r.why;
    if (r.why) return FW_SOLVER;
    *why = "the assembled pose has no static model: inertia acts";
    r.w.ledger = *ledger;
    r.tolerance = fmax(1e-9, options->rtol > 0 ? 10 * options->rtol : 0.02 * accuracy);
    FW_TRY(fw_statics_equilibrium_in_time(&r.w, loads));
    FW_TRY(nodes(&r));
    FW_TRY(look_at_laws(&r, loads));
    FW_TRY(fw_statics_quasi_static_arrays(&r));
    FW_NEED(r.motion->loads = fw_effects_loads_keep(arena, loads));
    fw_status status = follow(&r);
    if (r.why) *why = r.why;
    FW_TRY(status);
    fw_statics_quasi_static_finish(&r);
    r.motion->stats.cpu_s = cpu_seconds() - began;
    *motion = r.motion;
    return FW_OK;
}

/* ---- with inertia or without ---- */

/* the line of the ledger that says whether inertia acts; NULL in a build without it */
static fw_effect_entry *inertia_of(const fw_effect_ledger *ledger) {
    for (int i = 0; i < ledger->count; i++)
        if (strcmp(ledger->item[i].id, "inertia") == 0) return &ledger->item[i];
    return NULL;
}

static bool asked(const char *name, const char *usual) {
    return name && strcmp(name, usual) != 0;
}

/* what only an integration of the motion can follow */
static const char *integration_asked_for(const fw_dynamics_motion_options *o) {
    if (o->effects.mode != FW_EFFECTS_AUTO) return NULL; /* the effects were chosen by hand */
    if (asked(o->integrator, "auto")) return "an integrator was asked for: inertia acts";
    if (asked(o->method, "chain")) return "a method was asked for: inertia acts";
    if (asked(o->stabilise, "projection")) return "a stabilisation was asked for: inertia acts";
    return o->rtol > 0 ? "a tolerance was asked for: inertia acts" : NULL;
}

static void keep_inertia(fw_effect_ledger *ledger, fw_effects_loads *loads, const char *why) {
    fw_effect_entry *entry = inertia_of(ledger);
    loads->quasi_static = false;
    if (!entry) return;
    ledger->left_out = fmax(0, ledger->left_out - entry->bound);
    entry->active = true;
    entry->reason = why;
}

/* effects chosen by hand: what that may have cost is said where it is more than was asked for */
static void report_cost(const fw_device_scene *scene, const fw_effect_ledger *ledger,
                        double accuracy, fw_diags *diags) {
    const fw_effect_entry *entry = inertia_of(ledger);
    char text[32];
    if (!entry || (entry->bound < accuracy && !entry->looked_at)) return;
    fw_number_text(text, sizeof text, 100 * entry->bound, 2);
    fw_diag_warning(diags, 254, scene->place,
                    "%s%s is computed as a quasi-static sequence of equilibria, because "
                    "--effects excludes inertia: deflections may be wrong by %s%s%s",
                    FW_NAMED("scene", fw_text_name(scene->name)),
                    isinf(entry->bound) ? "an amount that is not bounded" : text,
                    isinf(entry->bound) ? "; use --effects all or auto to include it" : " %",
                    entry->looked_at ? ", and what goes by velocities by all of it" : "");
}

static fw_status move(fw_arena *arena, const fw_mechanism *mechanism, const fw_device_scene *scene,
                      const fw_dynamics_motion_options *options, fw_diags *diags,
                      const fw_dynamics_motion **motion) {
    fw_effects_loads loads;
    fw_effect_ledger ledger;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    FW_TRY(fw_effects_compile(arena, mechanism, scene, &options->effects, accuracy, diags, &ledger,
                              &loads));
    if (loads.quasi_static) {
        const char *why = integration_asked_for(options);
        if (!why) {
            fw_diags own = fw_diags_new(arena);
            fw_dynamics_motion_options whole = *options;
            whole.reactions |= options->alone; /* its steps are as fine as its forces need */
            fw_status status = fw_statics_quasi_static_motion(arena, mechanism, scene, &whole,
                                                              &ledger, &loads, &own, motion, &why);
            if (status != FW_SOLVER || options->ends_with_row) {
                fw_diags_take(diags, &own);
                if (status == FW_OK && options->effects.mode != FW_EFFECTS_AUTO)
                    report_cost(scene, &ledger, accuracy, diags);
                return diags->failed ? FW_NOMEM : status;
            }
            if (options->effects.mode != FW_EFFECTS_AUTO)
                fw_diag_warning(diags, 254, scene->place,
                                "%s%s was computed with inertia, although --effects "
                                "excludes it: %s",
                                FW_NAMED("scene", fw_text_name(scene->name)), why);
        }
        keep_inertia(&ledger, &loads, why);
    }
    return fw_dynamics_simulate_compiled(arena, mechanism, scene, options, &ledger, &loads, diags,
                                         motion);
}

/* A hinge is beyond its limit, so that a verdict needs no better level of hinges; not where that may move otherwise */
static bool decided(const fw_mechanism *m, const fw_dynamics_motion *x,
                    const fw_statics_level_step *step, const fw_dynamics_motion_options *o) {
    const bool unknown = o->beams_anyway && step && step->unknown;
    if (!o->within_limits || (!x->ended && (unknown || fw_statics_level_far_apart(step))))
        return false;
    for (int k = 0; k < m->nhinge; k++)
        if (fabs(x->peak[m->hinge[k].pin].angle_rad) > m->hinge[k].closed_form.limit_angle_rad)
            return true;
    return false;
}

/* Beyond this angle a joint's hinge is at three times its limit at least, whichever it is: a verdict needs no more of an
   exact beam, and one that tumbles costs minutes. HUGE_VAL: joints without a flexure turn freely. Test: test_program.py,
   far_beyond */
static double hopeless_rad(const fw_mechanism *m) {
    double most = 0;
    for (int k = 0; k < m->nhinge; k++)
        most = fmax(most, 3 * m->hinge[k].closed_form.limit_angle_rad);
    return m->nhinge == m->npin && most > 0 ? most : HUGE_VAL;
}

/* A motion that takes many evaluations needs to be followed no further than to half beyond what a hinge bears: by its
   rotation alone it is rejected. Joints without a flexure turn freely. */
static fw_status hopeless_each(fw_arena *arena, const fw_mechanism *m, const double **out) {
    double *to;
    FW_NEED(to = fw_arena_array(arena, double, (size_t)m->npin));
    for (int i = 0; i < m->npin; i++)
        to[i] = HUGE_VAL;
    for (int k = 0; k < m->nhinge; k++)
        to[m->hinge[k].pin] = 1.5 * m->hinge[k].closed_form.limit_angle_rad;
    *out = to;
    return FW_OK;
}

/* the level is looked at in the row nearest the largest of these */
static void rows_of_peaks(const fw_mechanism *m, const fw_dynamics_motion *x) {
    for (int k = 0; x->late && k < m->nhinge; k++)
        fw_dynamics_motion_rows_at(x, x->peak[m->hinge[k].pin].t_s);
}

static fw_status with_level(fw_arena *arena, const fw_dynamics_motion *found,
                            const fw_statics_level_step *step, double accuracy,
                            const fw_effect_choice *asked, const fw_dynamics_motion **motion) {
    fw_dynamics_motion *own = fw_arena_one(arena, fw_dynamics_motion);
    FW_NEED(own);
    *own = *found;
    own->level = step;
    FW_TRY(fw_statics_level_note(arena, step, accuracy, asked, &own->ledger.hinge));
    *motion = own;
    return FW_OK;
}

/* the next level failed: the motion that is there counts, and who looks on sees it again */
static fw_status stay(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                      const fw_dynamics_motion_options *options,
                      const fw_dynamics_motion **motion) {
    fw_dynamics_motion *own = fw_arena_one(arena, fw_dynamics_motion);
    fw_dynamics_motion_options o = *options;
    const fw_dynamics_motion *again;
    FW_NEED(own);
    *own = **motion;
    FW_TRY(fw_statics_level_stays(arena, own->level, "the scene could not be followed with it",
                                  &own->ledger.hinge));
    *motion = own;
    if (!options->observe) return FW_OK;
    fw_diags quiet = fw_diags_new(arena);
    o.effects.hinge = own->ledger.hinge.used;
    return move(arena, m, scene, &o, &quiet, &again);
}

/* ---- what rings along a path's two directions ----
   A path that is no mirror image of itself is drawn across by a force along it, and the closed form leaves that out: by c =
   c_xy/sqrt(c_xx c_yy) it is too stiff along one direction and too soft along another by up to 1 -+ c, its frequencies with it,
   which an instant does not show. So of what rings as much as c may be wrong, r of what turns (fw_statics_level_rings, of pins):

     c r/max(1, r)

   A scene that begins with velocities has no force before and that which leads masses around from then on, F = sum of m |v|
   |omega| at most, of all bodies on any one pin: by U = F^2/(2 k) of the softer direction k that rings besides.

   In: SI; out: relative. Cost: none without such paths, else that of rings. Source: the general eigenvalues of both
   compliances. Test: judge.examples path-pulse. */

/* what velocities at the start set ringing, over what turns */
static double thrown(const fw_mechanism *m, const fw_device_scene *scene,
                     const fw_dynamics_motion *x) {
    double force = 0, rings = 0, turns = 0;
    for (int b = 0; scene->ninitial > 0 && x->nsample > 0 && b < m->nbody; b++)
        force += m->body[b].mass_kg * hypot(x->v[3 * b], x->v[3 * b + 1]) * fabs(x->v[3 * b + 2]);
    for (int k = 0; force > 0 && k < m->nhinge; k++) {
        const fw_flexure_result *c = &m->hinge[k].closed_form;
        const double K = m->pin[m->hinge[k].pin].stiffness_Nm_per_rad,
                     U = 0.5 * force * force / fmin(c->kx_N_per_m, c->ky_N_per_m);
        if (K > 0) rings = fmax(rings, c->strain_per_rad * sqrt(6 * U / K));
        turns = fmax(turns, c->strain_per_rad * fabs(x->peak[m->hinge[k].pin].angle_rad));
    }
    return rings > 0 ? rings / turns : 0;
}

/* 0 where it is not above `least`, either */
static fw_status uncoupled(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                           const fw_dynamics_motion *x, double least, double *relative) {
    const fw_effect_choice pins = {.mode = FW_EFFECTS_AUTO, .hinge = FW_HINGE_REVOLUTE};
    const double matters = 0.01;
    double most = 0, rings;
    *relative = 0;
    for (int k = 0; k < m->nhinge; k++)
        most = fmax(most, m->hinge[k].coupling);
    if (!(most > fmax(matters, least)) || !scene || x->loads->quasi_static) return FW_OK;
    fw_dynamics_motion of_pins = *x;
    fw_effects_loads loads;
    fw_diags own = fw_diags_new(arena);
    FW_TRY(fw_effects_compile(arena, m, scene, &pins, 1e-3, &own, &of_pins.ledger, &loads));
    of_pins.loads = &loads;
    FW_TRY(fw_statics_level_rings(arena, m, scene, &of_pins, &rings));
    *relative = most * fmin(1, rings + thrown(m, scene, x));
    return FW_OK;
}

/* ---- what is thrown back ----
   What meets a contact is thrown back within some periods of what flexures give along them, much faster than they themselves
   would turn it. What rings along them goes on from blow to blow, and how much of it there is turns on a percent of its frequency: two
   guided leaves between soft stops have 98.2 % of their limit, and 102.8 where Young's modulus is 1 % less. An instant does not show
   that. So all of it may be wrong that joint forces pull along a flexure, F+, and push, F-, where that is a hundredth of what it bears:

     min(F+, F-)/(E A eps),   eps: allowed strain, A: narrowest section; what stands pulls or pushes alone.

   In: SI; out: share of the limit, 0 where less. Cost: that of forces at every row, with contacts alone. Validity: strips that
   forces pull; arcs are bent by them, and are no stiffer that way than the way they are meant to turn. Source: the same stage by
   closed forms and by exact beams. Test: test_hinge.py thrown_back. */

/* the force along the strip, pulling, in a row: its axis is half turned */
static double pull_of(const fw_mechanism *m, const fw_mechanism_hinge *h,
                      const fw_dynamics_motion *x, int row) {
    const double *q = x->q + (size_t)row * 3 * (size_t)m->nbody,
                 *f = x->reaction_N + 2 * ((size_t)row * (size_t)m->npin + (size_t)h->pin);
    /* of the flexure's symmetry; the strip lies across it */
    const double axis =
        h->axis_rad + fw_mechanism_pin_half_turned(m, &m->pin[h->pin], q) + FW_PI / 2;
    return cos(axis) * f[0] + sin(axis) * f[1];
}

static double thrown_back(const fw_mechanism *m, const fw_device_scene *scene,
                          const fw_dynamics_motion *x) {
    const double matters = 0.01;
    double share = 0;
    if (!scene || scene->ncontact == 0 || x->stats.events == 0 || x->loads->quasi_static) return 0;
    for (int i = 0; x->late && i < x->nsample; i++)
        fw_dynamics_motion_rows_at(x, x->t_s[i]);
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_hinge *h = &m->hinge[k];
        const fw_flexure_result *c = &h->closed_form;
        const double area = fw_device_flexure_narrowest_m(&m->device->flexure[h->flexure]) *
                            m->variant->thickness_m;
        const double bears = c->youngs_Pa * area * c->strain_per_rad * c->limit_angle_rad;
        double most[2] = {0};
        for (int i = 0; i < x->nsample && isfinite(h->axis_rad); i++) {
            const double f = pull_of(m, h, x, i);
            most[f < 0] = fmax(most[f < 0], fabs(f));
        }
        share = fmax(share, fmin(most[0], most[1]) / bears);
    }
    return share < matters ? 0 : share;
}

/* the step of a motion to the next level, with what an instant does not show: what rings along paths, and what contacts throw back */
static fw_status level_of(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                          const fw_dynamics_motion_options *options, const fw_dynamics_motion *x,
                          const fw_statics_level_step **out) {
    double coupled = 0, strains = 0;
    FW_TRY(fw_statics_level_of_motion(arena, m, scene, x, out));
    if (!*out) return FW_OK;
    const double blows = thrown_back(m, scene, x);
    if (!(*out)->why_not && (*out)->used == FW_HINGE_COMPLIANCE)
        FW_TRY(uncoupled(arena, m, scene, x, (*out)->relative, &coupled));
    if (options->strains_apart && !(*out)->why_not && (*out)->next == FW_HINGE_ELASTICA)
        FW_TRY(options->strains_apart(arena, m, x->loads, *out, &strains));
    const double relative = fmax(coupled, blows);
    if (!(relative > (*out)->relative) && blows == 0 && strains == 0) return FW_OK;
    fw_statics_level_step *more = fw_arena_one(arena, fw_statics_level_step);
    FW_NEED(more);
    *more = **out, more->blows = blows, more->strains = strains;
    if (relative > more->relative) more->relative = relative; /* one that is not known stays so */
    *out = more;
    return FW_OK;
}

/* exact beams cost 0.5 to 10 us each: not by itself where there would be very many */
static fw_status too_many_beams(fw_arena *arena, const fw_mechanism *m,
                                const fw_dynamics_motion_options *options,
                                const fw_statics_level_step *step,
                                const fw_dynamics_motion **motion, bool *too_many) {
    double beams = (double)(*motion)->stats.rhs * m->nhinge;
    *too_many = options->most_beams > 0 && step->next == FW_HINGE_ELASTICA &&
                beams > (double)options->most_beams;
    if (!*too_many) return FW_OK;
    fw_dynamics_motion *own = fw_arena_one(arena, fw_dynamics_motion);
    FW_NEED(own);
    *own = **motion;
    *motion = own;
    const char *why = fw_arena_printf(
        arena, "would take some %.0e exact beams: request it with --hinge-model elastica", beams);
    FW_NEED(why);
    return fw_statics_level_stays(arena, step, why, &own->ledger.hinge);
}

/* times the accuracy wanted, below which pins stand for stated stiffnesses in a motion: at the defaults what `check` has, so that
   forces of `simulate` are of the same hinges as its verdict */
static const double moving_stated = 10;

/* with the hinges as they were asked for; auto climbs where the step to the next level is computed
   to change more than the accuracy wanted, and stays where that level has no such motion */
fw_status fw_statics_move_scene(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_device_scene *scene,
                                const fw_dynamics_motion_options *options, fw_diags *diags,
                                const fw_dynamics_motion **motion) {
    fw_dynamics_motion_options o = *options;
    const fw_effect_choice *asked = &options->effects;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    double stated = moving_stated * accuracy;
    if (options->hinge_accuracy > 0) accuracy = stated = options->hinge_accuracy;
    if (options->hopeless_rhs > 0) FW_TRY(hopeless_each(arena, mechanism, &o.hopeless_rad));
    *motion = NULL;
    FW_TRY(fw_dynamics_check_request(mechanism, scene, options, diags));
    bool tried;
    FW_TRY(fw_statics_level_pins_first(arena, mechanism, scene, asked, &tried));
    if (tried) o.effects.hinge = FW_HINGE_REVOLUTE, o.effects.pins_first = true;
    for (;;) {
        const fw_dynamics_motion *found;
        const fw_statics_level_step *step;
        fw_diags own = fw_diags_new(arena);
        bool higher = *motion != NULL;
        fw_status status = move(arena, mechanism, scene, &o, &own, &found);
        if (tried && (status == FW_SOLVER || status == FW_INPUT)) { /* pins cannot move it */
            o.effects = options->effects, tried = false;
            continue;
        }
        if (higher && status == FW_SOLVER) return stay(arena, mechanism, scene, options, motion);
        if (status == FW_SOLVER && fw_statics_level_goes_on(asked, &own, &o.effects)) {
            if (options->within_limits)
                o.most_angle_rad = fmin(o.most_angle_rad > 0 ? o.most_angle_rad : HUGE_VAL,
                                        hopeless_rad(mechanism));
            continue;
        }
        if (!higher && !tried) fw_diags_take(diags, &own);
        FW_TRY(status);
        rows_of_peaks(mechanism, found);
        FW_TRY(level_of(arena, mechanism, scene, &o, found, &step));
        /* pins that take a stated velocity away cannot say what flexures make of it */
        bool elsewhere = found->stats.velocity_moved > fw_assembly_another_start;
        bool stay_pins = tried && !elsewhere && fw_statics_level_is_below(step, stated);
        if (stay_pins) {
            double rings;
            FW_TRY(fw_statics_level_rings(arena, mechanism, scene, found, &rings));
            stay_pins = rings < fw_statics_level_rings_most && step->blows == 0 &&
                        !fw_statics_takes_hold(mechanism, scene, found, 1);
        }
        if (tried && !stay_pins) {
            o.effects = options->effects, tried = false; /* as if they had not been tried */
            continue;
        }
        if (tried) accuracy = stated;
        if (higher || tried) fw_diags_take(diags, &own);
        FW_TRY(with_level(arena, found, step, accuracy, asked, motion));
        if (decided(mechanism, found, step, options) ||
            (!fw_statics_level_climb(step, accuracy, asked, &o.effects) &&
             !(options->beams_anyway &&
               fw_statics_level_elsewhere(mechanism, step, asked, &o.effects))))
            return FW_OK;
        bool too_many;
        FW_TRY(too_many_beams(arena, mechanism, options, step, motion, &too_many));
        if (too_many) return FW_OK;
    }
}

/* a row of equilibria has no integrator to be found again by, and where it ends the device has snapped */
void fw_statics_move_like(const fw_dynamics_motion *like, fw_dynamics_motion_options *o) {
    const bool row = like->loads->quasi_static;
    o->glance = NULL, o->unsettled = NULL, o->other = NULL, o->like = NULL;
    o->tapes = NULL, o->late_rows = false, o->trace_both = false;
    if (!row) o->rtol = like->stats.rtol, o->alone = o->rtol > 0;
    if (!row && o->alone) o->integrator = like->integrator; /* found by trying */
    o->ends_with_row = row;
    o->samples = like->nsample, o->hinge_accuracy = 1;
    o->effects.hinge = like->ledger.hinge.used, o->effects.untold = true;
}

fw_status fw_statics_move_stiffer(fw_arena *arena, const fw_mechanism *m,
                                  const fw_device_scene *scene, double by,
                                  const fw_dynamics_motion *like,
                                  const fw_dynamics_motion_options *given,
                                  const fw_dynamics_motion **motion) {
    fw_dynamics_motion_options o = *given;
    fw_diags own = fw_diags_new(arena);
    fw_statics_move_like(like, &o);
    o.effects.like = o.effects.along != 0 ? &like->ledger : NULL; /* hardly another device */
    o.effects.stiffer = by;
    const fw_status status = fw_statics_move_scene(arena, m, scene, &o, &own, motion);
    if (status != FW_OK) *motion = NULL;
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}
