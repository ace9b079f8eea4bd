/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/envelope.h"
#include "statics/statics.h"
#include "statics/statics_equilibrium.h"
#include <float.h>
#include <math.h>
#include <string.h>

static fw_status actives(const fw_statics_equilibrium *w, fw_statics *out) {
    const fw_multibody_model *m = w->model;
    out->nactive = fw_multibody_switch_count(m);
    FW_NEED(out->active = fw_arena_array(w->arena, fw_statics_active, (size_t)out->nactive));
    for (int i = 0; i < m->nstop; i++)
        out->active[i] = (fw_statics_active){.id = w->mechanism->pin[m->stop[i].pin].id,
                                             .side = m->stop[i].side};
    for (int i = 0, k = m->nstop; i < m->nspring; i++)
        if (m->spring[i].cable)
            out->active[k++] = (fw_statics_active){.id = w->mechanism->spring[i].id};
    for (int i = 0; i < m->nswitch; i++) {
        const fw_effects_force_element *e = fw_multibody_element_of_switch(m, i)->own;
        out->active[m->nstop + m->ncable + i] =
            (fw_statics_active){.id = e->id, .effect = e->class_->effect};
    }
    for (int i = 0; i < out->nactive; i++)
        out->active[i].on = fw_multibody_switch_on(w->system, i);
    return FW_OK;
}

static fw_status count_signs(const fw_statics_equilibrium *w, fw_statics *out) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    double *sum, largest = DBL_MIN, worst = 0;
    FW_NEED(sum = fw_arena_array(w->arena, double, n));
    for (int i = 0; w->sparse && i < r->n; i++)
        worst = fmax(worst, fabs(r->sparse->unbalanced[i]));
    for (int k = 0; k < r->modes; k++) {
        out->eigenvalue_per_s2[k] = r->value[k] * fw_statics_equilibrium_per_s2(w);
        worst = fmax(worst, fabs(w->gradient[k]));
        if (r->value[k] < -r->zero[k]) out->negative++;
        if (fabs(r->value[k]) > r->zero[k]) continue;
        out->neutral++;
        const double *shape = r->shape + (size_t)k * n;
        double most = fw_statics_equilibrium_part(shape, fw_statics_equilibrium_mover(w, shape));
        for (size_t i = 0; i < n; i++) /* each motion as large, whatever its masses */
            sum[i] = fmax(sum[i], fabs(shape[i]) / most);
    }
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, fabs(w->force[i]) * r->root[i]);
    out->residual = worst / fmax(largest, 1); /* forces of order one are the scale's */
    if (out->neutral == 0) return FW_OK;
    FW_TRY(fw_statics_equilibrium_bodies(w, sum, &out->loose));
    fw_diag_warning(w->diags, 113, w->scene->place,
                    "in %s%s nothing holds %s: its equilibrium is not unique",
                    FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)), out->loose);
    return FW_OK;
}

/* ---- what the joints repeat ---- */

/* of a large mechanism: the joints whose rows were left when all others had been eliminated */
static fw_status sparse_rank(const fw_statics_equilibrium *w, fw_text *names,
                             fw_statics_row_rank *rank) {
    const fw_statics_sparse *s = w->reduced.sparse;
    const fw_multibody_model *m = w->model;
    int named = 0, row = 0;
    rank->kept = (double)NAN;
    for (int i = 0; i < m->nblock; row += fw_multibody_row_count(&m->block[i++])) {
        bool said = false;
        for (int k = 0; k < s->repeats; k++)
            said = said || (s->repeat[k] >= row &&
                            s->repeat[k] < row + fw_multibody_row_count(&m->block[i]));
        if (said)
            fw_text_printf(names, "%s%s", named++ ? ", " : "",
                           fw_multibody_block_name(w->mechanism, &m->block[i]));
    }
    FW_TRY(fw_text_end(names));
    rank->joints = named > 0 ? names->data : NULL;
    return FW_OK;
}

/* rows that take part in a combination of rows that is zero: what U_1, the part of U that counts,
   misses of a unit row.

   fw_assembly_rank (assembly/freedom.c) finds a rank too, and neither can stand for the other. Here it
   must be the one of the decomposition, in the mass metric and cut at round-off, that the modes and
   multipliers beside it come from, or their count would contradict the freedoms that are reported;
   it is there for every state of a path at no further cost, and names all joints of a dependency.
   There it answers for a pose before masses matter: cut at 1e-10, so that a pose closed to 1e-12
   counts as what it is meant to be, and it names what is redundant in file order. */
fw_status fw_statics_equilibrium_rank(const fw_statics_equilibrium *w, fw_statics_row_rank *rank) {
    const fw_statics_reduced *r = &w->reduced;
    const fw_multibody_model *m = w->model;
    *rank = (fw_statics_row_rank){.rows = r->rows, .rank = r->rank};
    if (r->largest > 0) rank->kept = r->kept / r->largest, rank->dropped = r->dropped / r->largest;
    if (r->rank == r->rows && !w->sparse) return FW_OK;
    fw_text names = fw_text_new(w->arena);
    if (w->sparse) return sparse_rank(w, &names, rank);
    for (int i = 0, row = 0; i < m->nblock; i++) {
        int count = m->block[i].rows == FW_ROWS_PIN || m->block[i].rows == FW_ROWS_SLIDE ? 2 : 1;
        double missing = count;
        for (int k = 0; k < count; k++, row++)
            for (int l = 0; l < r->rank; l++) {
                double part = r->left[(size_t)l * (size_t)r->rows + (size_t)row];
                missing -= part * part;
            }
        if (missing > 0.02)
            fw_text_printf(&names, "%s%s", names.length ? ", " : "",
                           fw_multibody_block_name(w->mechanism, &w->model->block[i]));
    }
    FW_TRY(fw_text_end(&names));
    rank->joints = names.data;
    return FW_OK;
}

/* ---- the answer ---- */

static fw_status answer(const fw_statics_equilibrium *w, fw_statics *out) {
    size_t n = (size_t)w->model->nq, pins = (size_t)w->mechanism->npin;
    out->nbody = w->mechanism->nbody;
    out->npin = w->mechanism->npin;
    out->njoint = w->mechanism->njoint;
    out->ndriver = w->mechanism->ndriver;
    out->dof = w->reduced.dof;
    out->eigenvalues = w->reduced.modes;
    out->ledger = w->ledger;
    out->loads = w->loads;
    fw_effects_in_equilibrium(&out->ledger); /* whatever was asked for */
    out->iterations = w->iterations;
    out->rest_q = w->q0;
    out->pull_in = w->pull_in;
    FW_NEED(out->q = fw_arena_array(w->arena, double, n));
    FW_NEED(out->angle_rad = fw_arena_array(w->arena, double, pins));
    FW_NEED(out->reaction_N = fw_arena_array(w->arena, double, 2 * pins));
    FW_NEED(out->joint_N = fw_arena_array(w->arena, double, 3 * (size_t)out->njoint));
    FW_NEED(out->driver_N = fw_arena_array(w->arena, double, (size_t)out->ndriver));
    FW_NEED(out->eigenvalue_per_s2 = fw_arena_array(w->arena, double, (size_t)out->eigenvalues));
    fw_statics_equilibrium_pose(w, w->y, out->q, out->angle_rad);
    fw_statics_equilibrium_reactions(w, out->reaction_N, out->joint_N, out->driver_N);
    FW_TRY(actives(w, out));
    FW_TRY(fw_statics_equilibrium_rank(w, &out->rank));
    return count_signs(w, out);
}

static fw_status path_ends_early(const fw_statics_equilibrium *w, const fw_statics_path *path) {
    char text[32];
    fw_diag_warning(w->diags, 112, w->scene->place,
                    "the load path of %s%s ends after %d points at load factor %s, before "
                    "the full load: the equilibrium reported is not connected to the unloaded "
                    "one",
                    FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)), path->count,
                    fw_number_text(text, sizeof text, path->factor[path->count - 1], 4));
    return FW_OK;
}

/* Behind surfaces that meet may lie equilibria that no motion from rest reaches: descent from the assembled pose at the
   full load would step through them. */
static bool surfaces_meet(const fw_statics_equilibrium *w) {
    for (int i = 0; i < w->model->nelement; i++)
        if (w->model->element[i].own->class_->pressing) return true;
    return false;
}

static fw_status no_path(const fw_statics_equilibrium *w, const char *why) {
    fw_status status = fw_diag_error(
        w->diags, 599, w->scene->place,
        "scene %s: %s, and load paths are followed for up to %d bodies (this mechanism has %d); "
        "statics without a path and "
        "without contacts, modes about it, and simulate have no such limit",
        fw_statics_equilibrium_scene_name(w), why, FW_STATICS_DENSE / 3, w->mechanism->nbody);
    return status == FW_NOMEM ? FW_NOMEM : FW_LIMIT;
}

fw_status fw_statics_equilibrium_reach(fw_statics_equilibrium *w, int most_points,
                                       bool *left_unstable, fw_statics_path **path) {
    if (w->sparse && (path || surfaces_meet(w)))
        return no_path(w, path ? "a load path was asked for"
                               : "surfaces may meet, which is followed along the load path");
    if (path || surfaces_meet(w)) {
        fw_statics_path *own = NULL;
        fw_status status = fw_statics_equilibrium_begin(w, 0, left_unstable);
        if (status != FW_OK)
            return status == FW_SOLVER ? fw_statics_equilibrium_nowhere(w) : status;
        FW_TRY(fw_statics_equilibrium_follow(w, most_points, &own));
        if (path) *path = own;
        if (own->complete) return FW_OK;
        FW_TRY(path_ends_early(w, own));
    }
    return fw_statics_equilibrium_settle(w, left_unstable);
}

fw_status fw_statics_equilibrium_statics(fw_statics_equilibrium *w,
                                         const fw_statics_static_options *options,
                                         const fw_statics **statics) {
    fw_statics *out;
    FW_NEED(out = fw_arena_one(w->arena, fw_statics));
    FW_TRY(fw_statics_equilibrium_reach(w, options->most_points, &out->left_unstable,
                                        options->path ? &out->path : NULL));
    FW_TRY(answer(w, out));
    FW_TRY(fw_statics_equilibrium_friction(w, &out->friction));
    *statics = out;
    return FW_OK;
}

/* ---- why a level is used ---- */

fw_status fw_statics_level_note(fw_arena *arena, const fw_statics_level_step *step, double accuracy,
                                const fw_effect_choice *asked, fw_effects_hinge_use *use) {
    char by[32], wanted[32];
    if (!step || step->why_not) return FW_OK;
    use->error = fw_statics_level_changes(step);
    if (asked->hinge != FW_HINGE_AUTO || !(use->error < accuracy) || !use->why) return FW_OK;
    fw_percent_text(by, sizeof by, use->error);
    fw_percent_text(wanted, sizeof wanted, accuracy);
    FW_NEED(use->why = fw_arena_printf(arena,
                                       "%s; the cheapest that is good enough: %s is computed to "
                                       "change %s %%, below %s, %s %%",
                                       use->why, fw_effects_hinge_model_text(step->next), by,
                                       use->pins_first ? "what they are taken to be good to"
                                                       : "the accuracy wanted",
                                       wanted));
    return FW_OK;
}

fw_status fw_statics_level_stays(fw_arena *arena, const fw_statics_level_step *step,
                                 const char *why_not, fw_effects_hinge_use *use) {
    char by[32];
    const char *why = use->why ? use->why : "", *next = fw_effects_hinge_model_text(step->next);
    fw_percent_text(by, sizeof by, fw_statics_level_changes(step));
    use->why = step->why_not
                   ? fw_arena_printf(arena, "%s; what %s changes is not known: %s, and %s", why,
                                     next, step->why_not, why_not)
                   : fw_arena_printf(arena, "%s; %s is computed to change %s %%, but %s", why, next,
                                     by, why_not);
    FW_NEED(use->why);
    return FW_OK;
}

/* ---- whether another level is used ---- */

double fw_statics_level_strains(const fw_statics_level_step *s, int nhinge, double *largest) {
    double off = 0;
    *largest = 0;
    for (int k = 0; k < nhinge; k++) {
        const double at = s->at.strain[k], up = s->up.strain[k];
        if (!isfinite(at) || !isfinite(up)) return isinf(at) || isinf(up) ? HUGE_VAL : at + up;
        off = fmax(off, fabs(up - at)), *largest = fmax(*largest, at);
    }
    return *largest > 0 ? off / *largest : 0;
}

double fw_statics_level_changes(const fw_statics_level_step *step) {
    return step->strains > step->relative ? step->strains : step->relative;
}

bool fw_statics_level_far_apart(const fw_statics_level_step *step) {
    return step && !step->why_not && step->next == FW_HINGE_ELASTICA &&
           step->relative > fw_statics_level_bounds;
}

bool fw_statics_level_is_below(const fw_statics_level_step *step, double accuracy) {
    return step && !step->why_not && step->relative < accuracy;
}

/* a flexure's own closed form ended it, and not another formula */
static bool closed_form_ended(const fw_diags *said) {
    for (size_t i = 0; i < said->count; i++)
        if (said->item[i].ended == FW_ENDED_CLOSED_FORM) return true;
    return false;
}

bool fw_statics_level_may_go_on(const fw_effect_choice *asked, const fw_effect_choice *choice) {
    bool by_hand = asked->mode == FW_EFFECTS_NONE || asked->mode == FW_EFFECTS_LIST;
    return asked->hinge == FW_HINGE_AUTO && !by_hand && !choice->ended;
}

bool fw_statics_level_goes_on(const fw_effect_choice *asked, const fw_diags *said,
                              fw_effect_choice *choice) {
    if (!fw_statics_level_may_go_on(asked, choice) || !closed_form_ended(said)) return false;
    choice->hinge = FW_HINGE_ELASTICA;
    choice->ended = true;
    return true;
}

bool fw_statics_level_climb(const fw_statics_level_step *step, double accuracy,
                            const fw_effect_choice *asked, fw_effect_choice *choice) {
    if (asked->hinge != FW_HINGE_AUTO || !step || step->why_not ||
        fw_statics_level_changes(step) < accuracy)
        return false;
    /* a list, or none: what was left out by hand stays out */
    bool by_hand = asked->mode == FW_EFFECTS_NONE || asked->mode == FW_EFFECTS_LIST;
    if (by_hand && step->used == FW_HINGE_REVOLUTE) return false;
    choice->hinge = step->next;
    choice->below = fw_statics_level_changes(step);
    choice->below_of = step->strains > step->relative ? "the largest strain" : NULL;
    return true;
}

/* ---- an equilibrium with its step to the next level ---- */

static fw_status with_level(fw_arena *arena, const fw_statics *found,
                            const fw_statics_level_step *step, double accuracy,
                            const fw_statics_static_options *options, const fw_statics **statics) {
    fw_statics *own = fw_arena_one(arena, fw_statics);
    FW_NEED(own);
    *own = *found;
    own->level = step;
    FW_TRY(fw_statics_level_note(arena, step, accuracy, &options->effects, &own->ledger.hinge));
    *statics = own;
    return FW_OK;
}

static fw_status equilibrium(fw_arena *arena, const fw_mechanism *mechanism,
                             const fw_device_scene *scene, const fw_statics_static_options *options,
                             fw_diags *diags, const fw_statics **found,
                             const fw_statics_level_step **step) {
    fw_statics_equilibrium w;
    /* contacts are followed along the load path */
    const bool path = options->path || scene->ncontact > 0;
    FW_TRY(fw_statics_equilibrium_new(arena, mechanism, scene, &options->effects,
                                      path ? FW_STATICS_DENSE : FW_STATICS_QUICK, diags, &w));
    w.beams_next = fw_statics_level_may_go_on(&options->effects, &options->effects);
    /* first: it says why there may be no equilibrium */
    FW_TRY(fw_statics_pull_in_find(arena, mechanism, scene, &options->effects, diags, &w.pull_in));
    FW_TRY(fw_statics_equilibrium_statics(&w, options, found));
    return fw_statics_level_of_equilibrium(&w, step);
}

/* Exact beams may rest elsewhere: they have no equilibrium here, or the flexures' forces along and across are coupled, which
   closed forms leave out, so that both may have one beyond a snap that only these have gone through. */
static bool may_rest_elsewhere(const fw_mechanism *m, const fw_statics_level_step *step) {
    bool may = step && step->unknown;
    if (!step || step->used != FW_HINGE_COMPLIANCE || step->next != FW_HINGE_ELASTICA) return false;
    for (int k = 0; k < m->nhinge; k++)
        may = may || m->hinge[k].coupling > fw_statics_coupled;
    return may;
}

bool fw_statics_level_elsewhere(const fw_mechanism *m, const fw_statics_level_step *step,
                                const fw_effect_choice *asked, fw_effect_choice *choice) {
    if (!may_rest_elsewhere(m, step) || !fw_statics_level_may_go_on(asked, choice)) return false;
    choice->hinge = FW_HINGE_ELASTICA, choice->elsewhere = true;
    return true;
}

/* the next level was wanted and has no equilibrium: what is there counts, and may be another branch */
static fw_status stay(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                      fw_diags *diags, const fw_statics **statics) {
    fw_statics *own = fw_arena_one(arena, fw_statics);
    FW_NEED(own);
    *own = **statics;
    *statics = own;
    if (may_rest_elsewhere(m, own->level))
        fw_diag_warning(
            diags, 690, scene->place,
            "%s%s: exact beams could not follow its loads, and may rest elsewhere than "
            "the closed forms that are used in their place: where it snaps may be off by "
            "several times, and it may have a stable position that is not seen; ask for "
            "smaller loads, or draw hinges that are mirror images of themselves",
            FW_NAMED("scene", fw_text_name(scene->name)));
    return fw_statics_level_stays(arena, own->level, "the equilibrium could not be found with it",
                                  &own->ledger.hinge);
}

fw_status fw_statics_solve(fw_arena *arena, const fw_mechanism *mechanism,
                           const fw_device_scene *scene, const fw_statics_static_options *options,
                           fw_diags *diags, const fw_statics **statics) {
    fw_effect_choice choice = options->effects;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    double stated = fw_statics_level_stated * accuracy;
    bool tried;
    FW_TRY(fw_statics_level_pins_first(arena, mechanism, scene, &choice, &tried));
    *statics = NULL;
    if (tried) choice.hinge = FW_HINGE_REVOLUTE, choice.pins_first = true;
    for (;;) {
        const fw_statics_static_options o = {
            .effects = choice, .path = options->path, .most_points = options->most_points};
        fw_diags own = fw_diags_new(arena);
        const fw_statics_level_step *step = NULL;
        const fw_statics *found;
        bool higher = *statics != NULL;
        fw_status status = equilibrium(arena, mechanism, scene, &o, &own, &found, &step);
        if (higher && status == FW_SOLVER) return stay(arena, mechanism, scene, diags, statics);
        if (tried && (status == FW_SOLVER || status == FW_INPUT ||
                      (status == FW_OK && !fw_statics_level_is_below(step, stated)))) {
            choice = options->effects, tried = false; /* as if they had not been tried */
            continue;
        }
        if (status == FW_SOLVER && fw_statics_level_goes_on(&options->effects, &own, &choice))
            continue;
        if (!higher && !tried) fw_diags_take(diags, &own);
        FW_TRY(status);
        if (tried) accuracy = stated, fw_diags_take(diags, &own);
        FW_TRY(with_level(arena, found, step, accuracy, options, statics));
        if (fw_statics_level_climb(step, accuracy, &options->effects, &choice)) continue;
        if (!fw_statics_level_elsewhere(mechanism, step, &options->effects, &choice))
            return FW_OK;
    }
}

/* ---- small motions where joints and cables rub ---- */

/* Between which frequencies and compliances a device lies where joints and cables rub: each sticks or slides. Of the pencil
   diag(value) in the modes, all that slides: any joint that sticks is one condition h_j u = 0 more, and so on the null space
   Z of the rows h_j . shape_k; any cable that does adds S, and one that slips takes s (fw_effects_eyelet_friction_segments):

     diag(value) - s   <=   omega_k (all slide)   <=   stuck_k = eigenvalue k of Z^T (diag(value) + S) Z

   Inputs: an evaluated state, scaled. Output: stuck_Hz and slid_Hz of the modes, infinite of those that no freedom is left
   for; held and slides, the inverses of both. Valid for small motions about the pose. Error: round-off; s of a cable of which
   more than one segment moves is a guess. Cost: dof^3. Source: Courant, Fischer (R. Horn, C. Johnson, Matrix Analysis, 4.3).
   Test: tests/cli/test_friction_range.py */

typedef struct sticking {
    fw_statics_equilibrium *w;
    size_t dof;
    double *row, *held, *slides; /* (count x n) of what does not move; (dof x dof) */
    double *side;                /* (dof) 1; -1: as it is shown a mode is turned round */
    int count, cables;
} sticking;

/* along (dof): of a row (3 nbody) in SI, scaled, in every mode; to: the row itself */
static void row_along(const sticking *s, const double *row, double *to, double *along) {
    const fw_statics_reduced *r = &s->w->reduced;
    const double unit = s->w->model->scale.length_m;
    for (int i = 0; i < r->n; i++)
        to[i] = row[i] / (i % 3 == 2 ? unit : 1);
    for (size_t k = 0; k < s->dof; k++)
        for (size_t i = 0; i < (size_t)r->n; i++)
            along[k] += to[i] * r->shape[k * (size_t)r->n + i];
}

static void add_square(size_t n, double times, const double *x, double *a) {
    for (size_t i = 0; i < n * n; i++)
        a[i] += times * x[i / n] * x[i % n];
}

static fw_status add_cable(sticking *s, const fw_effects_segments *c) {
    const fw_multibody_model *m = s->w->model;
    const size_t n = (size_t)m->nq;
    const double unit = m->scale.length_m / fw_multibody_newton(m);
    double *along, *all;
    FW_NEED(along = fw_arena_array(s->w->arena, double, s->dof *((size_t)c->n + 1)));
    all = along + s->dof * (size_t)c->n;
    for (int i = 0; i < c->n; i++) {
        double *to = along + s->dof * (size_t)i, *row = s->row + n * (size_t)s->count;
        row_along(s, c->row + n * (size_t)i, row, to);
        for (size_t k = 0; k < s->dof; k++)
            all[k] += to[k];
        if (isinf(c->alone_N_per_m[i]))
            s->count++;
        else
            add_square(s->dof, c->alone_N_per_m[i] * unit, to, s->held);
    }
    add_square(s->dof, -c->whole_N_per_m * unit, all, s->held);
    add_square(s->dof, -c->less * c->whole_N_per_m * unit, all, s->slides);
    s->cables++;
    return FW_OK;
}

/* taut ones */
static fw_status add_cables(sticking *s, const double *q) {
    const fw_statics_equilibrium *w = s->w;
    const fw_multibody_model *m = w->model;
    for (int i = 0, tendon = 0; i < m->nelement; i++) {
        const fw_effects_force_element *e = m->element[i].own;
        fw_effects_segments c;
        if (strcmp(e->class_->effect, "tendon") != 0) continue;
        const int at = tendon++, on = m->nstop + m->ncable + m->element[i].first_switch;
        if (e->switches > 0 && !fw_multibody_switch_on(w->system, on)) continue;
        FW_TRY(fw_effects_eyelet_friction_segments(w->arena, w->scene, at, e, q,
                                                   w->mechanism->nbody, &c));
        if (c.n > 0) FW_TRY(add_cable(s, &c));
    }
    return FW_OK;
}

/* eigenvalues (left) of a on the span of free (left x dof), and there its inverse, SI, by modes as they are shown; NULL: nothing
   holds it */
static fw_status give_within(const sticking *s, const double *a, const double *free, size_t left,
                             double *value, const double **give) {
    const size_t dof = s->dof;
    double *small, *vector, *x, *to, *half;
    FW_NEED(small = fw_arena_array(s->w->arena, double, 2 * left * left + 1));
    FW_NEED(half = fw_arena_array(s->w->arena, double, left *dof + 1));
    FW_NEED(to = fw_arena_array(s->w->arena, double, dof *(dof + 1)));
    vector = small + left * left, x = to + dof * dof, *give = NULL;
    for (size_t i = 0; i < left * dof; i++)
        for (size_t k = 0; k < dof; k++)
            half[i] += free[i / dof * dof + k] * a[k * dof + i % dof];
    for (size_t i = 0; i < left * left; i++)
        for (size_t k = 0; k < dof; k++)
            small[i] += half[i / left * dof + k] * free[i % left * dof + k];
    if (left > 0 && !fw_maths_jacobi((int)left, small, value, vector)) return FW_SOLVER;
    for (size_t v = 0; v < left; v++) {
        memset(x, 0, dof * sizeof *x);
        for (size_t i = 0; i < left; i++)
            for (size_t k = 0; k < dof; k++)
                x[k] += vector[v * left + i] * free[i * dof + k] * s->side[k];
        add_square(dof, 1 / (value[v] * fw_statics_equilibrium_per_s2(s->w)), x, to);
    }
    if (left == 0 || value[0] > s->w->reduced.zero[0]) *give = to;
    return FW_OK;
}

/* modes may have been turned round to be shown */
static fw_status sides_of(sticking *s, const fw_statics_modes *out) {
    const fw_statics_reduced *r = &s->w->reduced;
    FW_NEED(s->side = fw_arena_array(s->w->arena, double, s->dof));
    for (size_t k = 0; k < s->dof; k++) {
        double same = 0;
        for (size_t i = 0; i < (size_t)r->n; i++)
            same += r->shape[k * (size_t)r->n + i] * out->mode[k].shape[i];
        s->side[k] = same < 0 ? -1 : 1;
    }
    return FW_OK;
}

/* what may move where the rows do not */
static fw_status free_of(const sticking *s, const double **free, size_t *left) {
    const size_t n = (size_t)s->w->reduced.n, dof = s->dof;
    double *part;
    fw_maths_singular z;
    int rank = 0;
    FW_NEED(part = fw_arena_array(s->w->arena, double, dof *(size_t)(s->count > 0 ? s->count : 1)));
    for (size_t j = 0; j < (size_t)s->count; j++)
        for (size_t k = 0; k < dof; k++)
            for (size_t i = 0; i < n; i++)
                part[j * dof + k] += s->row[j * n + i] * s->w->reduced.shape[k * n + i];
    FW_TRY(fw_maths_singular_new(s->w->arena, s->count > 0 ? s->count : 1, (int)dof, part, &z));
    while (rank < s->count && rank < (int)dof && z.sigma[rank] > 1e-10 * z.sigma[0])
        rank++;
    *left = dof - (size_t)rank, *free = z.v + (size_t)rank * dof;
    return FW_OK;
}

static double hertz(const sticking *s, double value) {
    return sqrt(fmax(value, 0) * fw_statics_equilibrium_per_s2(s->w)) / (2 * FW_PI);
}

fw_status fw_statics_equilibrium_stick(fw_statics_equilibrium *w, fw_statics_modes *out) {
    const size_t dof = (size_t)w->reduced.dof, n = (size_t)w->reduced.n;
    sticking s = {.w = w, .dof = dof};
    const double *free;
    double *joints, *value, *every;
    size_t left, most = 1;
    for (int k = 0; k < out->count; k++)
        out->mode[k].stuck_Hz = out->mode[k].slid_Hz = (double)NAN;
    const bool cables = w->scene && fw_effects_eyelet_friction_of(w->scene) > 0;
    if (w->sparse || dof == 0) return FW_OK;
    FW_TRY(fw_statics_equilibrium_rubbing(w, &s.count, &joints));
    if (s.count == 0 && !cables) return FW_OK;
    for (int i = 0; cables && i < w->scene->ntendon; i++)
        most += (size_t)w->scene->tendon[i].neyelet;
    FW_NEED(s.row = fw_arena_array(w->arena, double, ((size_t)s.count + most) * n));
    memcpy(s.row, joints, (size_t)s.count * n * sizeof *joints);
    FW_NEED(s.held = fw_arena_array(w->arena, double, 4 * dof * dof));
    s.slides = s.held + dof * dof, every = s.slides + dof * dof, value = every + dof * dof;
    for (size_t k = 0; k < dof; k++)
        s.held[k * dof + k] = s.slides[k * dof + k] = w->reduced.value[k], every[k * dof + k] = 1;
    if (cables) FW_TRY(add_cables(&s, out->q));
    if (s.count == 0 && s.cables == 0) return FW_OK;
    FW_TRY(sides_of(&s, out));
    FW_TRY(give_within(&s, s.slides, every, dof, value, &out->slides));
    for (size_t k = 0; k < dof; k++)
        out->mode[k].slid_Hz =
            s.cables > 0 ? fmin(hertz(&s, value[k]), out->mode[k].f_Hz) : out->mode[k].f_Hz;
    FW_TRY(free_of(&s, &free, &left));
    FW_TRY(give_within(&s, s.held, free, left, value, &out->held));
    for (size_t k = 0; k < dof; k++)
        out->mode[k].stuck_Hz = k < left ? hertz(&s, value[k]) : (double)INFINITY;
    return FW_OK;
}

/* ---- films of gas that are springs as well (effects/squeeze_film.c) ---- */

fw_status fw_statics_films_raise(fw_arena *arena, const fw_mechanism *m,
                                 const fw_device_scene *scene, fw_diags *diags,
                                 fw_statics_modes *modes) {
    char was[32], may[32];
    for (int k = 0; k < modes->count; k++) {
        fw_statics_mode *mode = &modes->mode[k];
        double omega;
        mode->raised = 1;
        if (!(mode->stiffness_per_s2 > 0) || scene->nair == 0) continue;
        FW_TRY(fw_effects_squeeze_raised(arena, m, scene, mode->shape, mode->modal_mass_kg_m2,
                                         mode->omega_rad_per_s, &omega));
        mode->raised = omega / mode->omega_rad_per_s;
        if (!diags || !(mode->raised - 1 > fw_statics_mode_error(mode))) continue;
        fw_diag_warning(
            diags, 754, scene->place,
            "mode %d of %s%s has squeezed films as dampers alone, whose gas is compressed "
            "within a period and pushes back as a spring: with that it lies between "
            "%s and %s kHz",
            k + 1, FW_NAMED("scene", scene->name),
            fw_number_text(was, sizeof was, 1e-3 * mode->f_Hz, 4),
            fw_number_text(may, sizeof may, 1e-3 * mode->f_Hz * mode->raised, 4));
    }
    return FW_OK;
}
