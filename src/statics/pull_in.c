/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pull-in of comb drives: the stable equilibrium is followed by arc length from s = 0 on, s the
   square of all their voltages over the scene's largest, to the first limit point or bifurcation.

   Where the first eigenvalue of the reduced stiffness passes zero is a root along the arc to
   round-off (statics_path.c): at a limit point s has an error of second order; at a bifurcation it
   is found again from the eigenvalue beside it. Lengths of the arc count displacements in gaps. The
   first estimate of s is the lesser of two. With S = Phi^T (K(0) - K(1)) Phi, what the fields take of
   the stiffness as drawn, one over the Frobenius norm of S_kl/sqrt(mu_k mu_l), mu the eigenvalues, lies below where
   the linear theory loses its stiffness; and s at which the linear displacement is a gap. It is raised while nothing
   is found. Drives that do not act together are followed for each ratio of their voltages (decision 201), up to RATIOS. Inputs:
   a mechanism as statics takes it. Valid where the capacitance's formula is; a path that leaves it
   says so. Cost: about 100 to 500 evaluations (30 n^3) for each
   ratio, and as many where electrodes stand on soft arms. Source: J. A. Pelesko and D. H. Bernstein,
   Modeling MEMS and NEMS 2002, ch. 7; Keller 1977. Test: test_pull_in.c. */
#include "statics/statics.h"
#include "effects/effects.h"
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

enum { FW_RAISES = 12, FW_PULL_POINTS = 1500, RATIOS = 12 };
static const double fw_raise = 16;
static const double fw_first_unit = 4; /* times the estimate */

typedef struct seeker {
    fw_arena *arena;
    fw_statics_equilibrium w;
    fw_device_scene scene; /* the caller's with the largest voltages, constant */
    fw_statics_pull_in *out;
    const fw_effects_force_element *comb; /* the one that is reported */
} seeker;

const char *fw_statics_pull_in_kind_text(fw_statics_pull_in_kind kind) {
    static const char *const text[] = {"none", "fold", "side", "tilt"};
    return text[kind];
}

/* factor NULL: each as its law is largest */
static fw_status hold_voltages(seeker *k, const fw_device_scene *scene, const double *factor) {
    fw_device_comb *comb;
    k->scene = *scene;
    FW_NEED(comb = fw_arena_array(k->arena, fw_device_comb, (size_t)scene->ncomb));
    for (int i = 0; i < scene->ncomb; i++) {
        comb[i] = scene->comb[i];
        comb[i].voltage_V *=
            factor ? factor[i] : fw_quantity_law_largest(comb[i].law, scene->duration_s);
        comb[i].law = NULL;
    }
    k->scene.comb = comb;
    return FW_OK;
}

/* ---- what the drives do at a pose ---- */

static const fw_effects_comb_element *comb_at(const seeker *k, int i) {
    return fw_effects_comb_of(k->w.model->element[i].own);
}

static double least_gap(const seeker *k) {
    double least = (double)INFINITY;
    for (int i = 0; i < k->w.model->nelement; i++)
        if (comb_at(k, i)) least = fmin(least, comb_at(k, i)->gap_m);
    return least;
}

/* stiffness that the field takes from a small motion (SI) of the bodies: along, across, by tilt,
   and in all, at the scene's voltage */
static void taken(const fw_effects_force_element *e, const double *q, const double *motion,
                  double part[4]) {
    const fw_effects_comb_element *c = fw_effects_comb_of(e);
    double p[6], w[6], where[3], rate[3], slope[3], bend[9];
    fw_effects_element_place_ports(e, q, motion, p, w);
    fw_effects_comb_place(e, p, where);
    fw_effects_comb_rate(e, p, w, rate);
    fw_effects_comb_capacitance(c, where, slope, bend);
    double half = 0.5 * c->voltage_V * c->voltage_V;
    part[3] = 0;
    for (int i = 0; i < 9; i++) {
        double share = half * rate[i / 3] * bend[i] * rate[i % 3];
        if (i % 4 == 0) part[i / 4] = share;
        part[3] += share;
    }
}

static fw_status motion_of(const seeker *k, const double *shape, double **motion) {
    const fw_multibody_model *m = k->w.model;
    double most = 0;
    FW_NEED(*motion = fw_arena_array(k->arena, double, (size_t)m->nq));
    for (int b = 0; b < m->nbody; b++)
        most = fmax(most, fw_statics_equilibrium_part(shape, b));
    for (int i = 0; i < m->nq; i++)
        (*motion)[i] = shape[i] / most * (i % 3 == 2 ? 1 : m->scale.length_m);
    return FW_OK;
}

/* ---- the answer ---- */

static void report_comb(seeker *k, const fw_effects_force_element *e, double s, const double *q) {
    const fw_effects_comb_element *c = fw_effects_comb_of(e);
    fw_statics_pull_in *out = k->out;
    double p[6], w[6];
    k->comb = e;
    fw_effects_element_place_ports(e, q, NULL, p, w);
    fw_effects_comb_place(e, p, out->where);
    out->comb = e->id;
    out->place = e->place;
    out->largest_V = fabs(c->voltage_V);
    out->margin = sqrt(s);
    out->voltage_V = out->largest_V * out->margin;
    out->fringe = fw_effects_comb_fringe(c, out->where);
    out->fringe_counted = c->edge != NULL;
}

/* stable up to s, with the pose q there (NULL: as it stands); named is the drive whose formula
   ends, else the one of the highest voltage over its gap */
static fw_status nothing_found(seeker *k, double s, const double *last, const char *why) {
    const fw_multibody_model *m = k->w.model;
    const fw_effects_force_element *e = NULL;
    double *q, most = -1;
    FW_NEED(q = fw_arena_array(k->arena, double, (size_t)m->nq));
    for (int i = 0; i < m->nelement; i++) {
        const fw_effects_comb_element *c = comb_at(k, i);
        if (!c || !(fabs(c->voltage_V) / c->gap_m > most)) continue;
        most = fabs(c->voltage_V) / c->gap_m;
        e = m->element[i].own;
    }
    if (k->w.invalid && fw_effects_comb_of(k->w.invalid)) e = k->w.invalid;
    fw_statics_equilibrium_pose(&k->w, k->w.y, q, NULL);
    report_comb(k, e, s, last ? last : q);
    k->out->kind = FW_PULL_IN_NONE;
    FW_NEED(k->out->why = fw_arena_strdup(k->arena, why));
    return FW_OK;
}

/* lowest eigenvalue of the stable equilibrium at s, by Newton from `near` (n, scaled) */
static fw_status lowest_at(seeker *k, const double *near, double s, double *lowest) {
    fw_statics_equilibrium *w = &k->w;
    double before = (double)INFINITY;
    memcpy(w->y, near, (size_t)w->model->nq * sizeof *near);
    fw_statics_equilibrium_factor(w, s);
    for (int i = 0; i < 12; i++) {
        FW_TRY(fw_statics_equilibrium_evaluate(w));
        double most = fw_statics_equilibrium_newton(w, w->step);
        if (!(most < 0.5 * before)) break;
        before = most;
        for (int j = 0; j < w->model->nq; j++)
            w->y[j] += w->step[j];
    }
    FW_TRY(fw_statics_equilibrium_evaluate(w));
    *lowest = w->reduced.value[0];
    return FW_OK;
}

/* s at which the cubic through the lowest eigenvalue at four values s (1 - i h) is 0 */
static fw_status extrapolate(seeker *k, const double *near, double s, double h, double *root) {
    enum { POINTS = 4 };
    double at[POINTS], value[POINTS];
    *root = 0;
    for (int i = 0; i < POINTS; i++) {
        at[i] = s * (1 - (i + 1) * h);
        FW_TRY(lowest_at(k, near, at[i], &value[i]));
    }
    for (int i = 0; i < POINTS; i++) { /* Lagrange's formula for s(value) at 0 */
        double share = 1;
        for (int j = 0; j < POINTS; j++)
            if (j != i) share *= value[j] / (value[j] - value[i]);
        *root += share * at[i];
    }
    return FW_OK;
}

/* Branches cross at a bifurcation, so that paths stop some 1e-9 beside it. The lowest eigenvalue is
   smooth there, but only until it meets the next one, of a softer mode that the field does not
   touch: h becomes smaller until two cubics agree, and where none do the last one stands. Error about h^4, 1e-15 where the first
   two agree already. */
static fw_status refine(seeker *k, const double *near, double *s) {
    const double first = 2e-4, agreed = 1e-12, found = *s;
    double before = (double)NAN;
    for (double h = first; h > 1e-7; h /= 8) {
        double root;
        FW_TRY(extrapolate(k, near, found, h, &root));
        if (!(fabs(root - found) <= h * found)) continue;
        *s = root;
        if (fabs(root - before) <= agreed * found) break;
        before = root;
    }
    return FW_OK;
}

/* the event of the path at index i: which motion becomes free there, and which drive takes it */
static fw_status describe(seeker *k, const fw_statics_path *path, int i) {
    fw_statics_equilibrium *w = &k->w;
    fw_statics_pull_in *out = k->out;
    size_t n = (size_t)w->model->nq;
    const double *q = path->q + (size_t)i * n;
    double best[4] = {0}, part[4];
    const fw_effects_force_element *e = NULL;
    for (size_t j = 0; j < n; j++)
        w->y[j] = (q[j] - w->q0[j]) / (j % 3 == 2 ? 1 : w->model->scale.length_m);
    double s = path->factor[i], *near;
    FW_NEED(near = fw_arena_array(k->arena, double, n));
    memcpy(near, w->y, n * sizeof *near);
    out->bifurcation = path->mark[i] == FW_PATH_BIFURCATION;
    if (out->bifurcation) FW_TRY(refine(k, near, &s));
    memcpy(w->y, near, n * sizeof *near);
    fw_statics_equilibrium_factor(w, path->factor[i]);
    FW_TRY(fw_statics_equilibrium_evaluate(w));
    FW_NEED(out->q = fw_arena_array(k->arena, double, n));
    memcpy(out->q, q, n * sizeof *q);
    FW_TRY(motion_of(k, w->reduced.shape, &out->shape)); /* the lowest mode */
    for (int j = 0; j < w->model->nelement; j++) {
        if (!comb_at(k, j)) continue;
        taken(w->model->element[j].own, q, out->shape, part);
        if (e && !(part[3] > best[3])) continue;
        e = w->model->element[j].own;
        memcpy(best, part, sizeof best);
    }
    report_comb(k, e, s * w->drive_unit, q);
    const bool pins = w->ledger.hinge.used == FW_HINGE_REVOLUTE;
    double *energy;
    FW_TRY(fw_statics_hinge_energies(w, q, out->shape, &energy));
    out->stiffness_error =
        fw_statics_shape_error(w->mechanism, q, out->shape, pins, (double)NAN, energy);
    out->kind = fabs(best[2]) > fmax(fabs(best[0]), fabs(best[1])) ? FW_PULL_IN_TILT
                : fabs(best[1]) > fabs(best[0])                    ? FW_PULL_IN_SIDE
                                                                   : FW_PULL_IN_FOLD;
    out->body = w->mechanism->body[fw_statics_equilibrium_mover(w, w->reduced.shape)].id;
    return FW_OK;
}

/* ---- the way there ---- */

/* what of the drawn stiffness the fields take at s = 1, relative, as a Frobenius norm; and how far
   the mechanism would move, in reaches */
static fw_status estimate(seeker *k, double *share, double *moved) {
    fw_statics_equilibrium *w = &k->w;
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n, dof = (size_t)r->dof;
    double *before, *shape, *value, most = 0, sum = 0;
    FW_NEED(before = fw_arena_array(k->arena, double, n *n));
    FW_NEED(shape = fw_arena_array(k->arena, double, n *n));
    FW_NEED(value = fw_arena_array(k->arena, double, n));
    memcpy(before, w->stiffness, n * n * sizeof *before);
    memcpy(shape, r->shape, dof * n * sizeof *shape);
    memcpy(value, r->value, dof * sizeof *value);
    for (size_t i = 0; i < n; i++) {
        double u = 0;
        for (size_t l = 0; l < dof; l++)
            u += shape[l * n + i] * w->push[l] / value[l];
        most = fmax(most, fabs(u));
    }
    fw_statics_equilibrium_factor(w, 1);
    FW_TRY(fw_statics_equilibrium_evaluate(w));
    for (size_t a = 0; a < dof; a++)
        for (size_t b = 0; b < dof; b++) {
            double part = 0;
            for (size_t i = 0; i < n; i++)
                for (size_t j = 0; j < n; j++)
                    part += shape[a * n + i] * (before[i * n + j] - w->stiffness[i * n + j]) *
                            shape[b * n + j];
            sum += part * part / (value[a] * value[b]);
        }
    *share = sqrt(sum);
    *moved = most / w->reach;
    fw_statics_equilibrium_factor(w, 0);
    return fw_statics_equilibrium_evaluate(w);
}

static int first_event(const fw_statics_path *path) {
    for (int i = 0; i < path->count; i++)
        if (path->mark[i] == FW_PATH_FOLD || path->mark[i] == FW_PATH_BIFURCATION) return i;
    return -1;
}

static double largest_factor(const fw_statics_path *path) {
    double most = 0;
    for (int i = 0; i < path->count; i++)
        most = fmax(most, path->factor[i]);
    return most;
}

static const char *why_it_ends(const fw_statics_equilibrium *w, const fw_statics_path *path) {
    if (path->count >= FW_PULL_POINTS)
        return "the path of equilibria is too long to be followed further";
    return fw_multibody_switch_count(w->model) > 0
               ? "the path of equilibria ends without a limit point: a stop, cable or contact "
                 "takes "
                 "hold or lets go there"
               : "the path of equilibria could not be followed further, and no limit point was "
                 "found on it";
}

/* from the equilibrium without voltage, evaluated; the unit of s is raised until something is found
   or the path ends otherwise */
static fw_status follow(seeker *k) {
    fw_statics_equilibrium *w = &k->w;
    fw_statics_path *path;
    double share, moved, *rest;
    size_t bytes = (size_t)w->model->ny * sizeof(double);
    FW_NEED(rest = fw_arena_array(k->arena, double, (size_t)w->model->ny));
    FW_TRY(estimate(k, &share, &moved));
    memcpy(rest, w->y, bytes);
    if (!(share > 0) && !(moved > 0))
        return nothing_found(k, (double)INFINITY, NULL, "the fields do nothing against the joints");
    w->drive_unit = fw_first_unit / fmax(share, moved);
    w->until_unstable = true;
    for (int i = 0; i < FW_RAISES; i++, w->drive_unit *= fw_raise) {
        memcpy(w->y, rest, bytes);
        fw_statics_equilibrium_factor(w, 0);
        FW_TRY(fw_statics_equilibrium_evaluate(w));
        w->invalid = NULL;
        FW_TRY(fw_statics_equilibrium_follow(w, FW_PULL_POINTS, &path));
        int event = first_event(path);
        if (event >= 0) return describe(k, path, event);
        if (!path->complete)
            return nothing_found(k, largest_factor(path) * w->drive_unit,
                                 path->q + (size_t)(path->count - 1) * (size_t)w->model->nq,
                                 w->invalid ? w->why : why_it_ends(w, path));
    }
    return nothing_found(k, (double)INFINITY, NULL, "no voltage takes the stiffness");
}

/* Without voltage first: what statics does with all other loads. Its own messages are not for the
   user: the pull-in voltage is only a part of the answer. */
static fw_status seek(seeker *k, const fw_mechanism *mechanism, const fw_effect_choice *effects,
                      fw_diags *silent) {
    fw_statics_equilibrium *w = &k->w;
    bool unstable;
    FW_TRY(fw_statics_equilibrium_new(k->arena, mechanism, &k->scene, effects, FW_STATICS_DENSE,
                                      silent, w));
    if (!(least_gap(k) < (double)INFINITY)) return FW_OK; /* left out on request */
    FW_NEED(k->out = fw_arena_one(k->arena, fw_statics_pull_in));
    w->reach = least_gap(k) / w->model->scale.length_m;
    w->lead = FW_LEAD_LOADS;
    fw_status status = fw_statics_equilibrium_settle(w, &unstable);
    if (status == FW_SOLVER)
        return nothing_found(k, 0, NULL, "there is no equilibrium without voltage either");
    FW_TRY(status);
    if (w->reduced.dof == 0)
        return nothing_found(k, (double)INFINITY, NULL,
                             mechanism->nhinge > 0 && w->ledger.hinge.used == FW_HINGE_REVOLUTE
                                 ? "flexures are taken as pins, and pins, joints and drivers hold "
                                   "everything; what flexures give is not in it"
                                 : "joints and drivers hold everything");
    if (w->reduced.value[0] <= w->reduced.zero[0])
        return nothing_found(k, 0, NULL, "nothing holds the mechanism even without voltage");
    w->lead = FW_LEAD_DRIVES;
    fw_statics_equilibrium_factor(w, 0);
    status = fw_statics_equilibrium_evaluate(w);
    if (status == FW_OK) status = follow(k);
    return status == FW_SOLVER ? nothing_found(k, 0, NULL, "its equations could not be evaluated")
                               : status;
}

const char *fw_statics_pull_in_fringe_text(const fw_statics_pull_in *p) {
    return p->fringe_counted ? "what surfaces near or below it change of the fringe fields"
                             : "fringe fields that the model leaves out";
}

double fw_statics_pull_in_margin(const fw_statics_pull_in *p) {
    const double more = 1 + p->fringe, least = 1e-3;
    return sqrt(more / (fmax(least, 1 - more * p->fingers) * fmax(least, 1 - p->stiffness_error)));
}

double fw_statics_pull_in_least_V(const fw_statics_pull_in *p) {
    const double more = 1 + p->fringe, left = fmax(1 - p->stiffness_error, 0) / more,
                 by_fingers = more / (p->fingers_V * p->fingers_V);
    return 1 / sqrt(1 / (left * p->voltage_V * p->voltage_V) + by_fingers);
}

bool fw_statics_pull_in_fingers_snap(const fw_statics_pull_in *p) {
    return (1 + p->fringe) * p->fingers >= 1;
}

/* ---- fingers ---- */

static void fingers(seeker *k, const fw_mechanism *mechanism) {
    fw_statics_pull_in *out = k->out;
    out->fingers_V = (double)INFINITY;
    for (int i = 0; i < k->w.model->nelement; i++) {
        const fw_effects_comb_element *c = comb_at(k, i);
        const double least = c ? fw_effects_comb_fingers_V(c, mechanism->variant, c->edge != NULL)
                               : (double)INFINITY;
        const double share = c ? c->voltage_V / least : 0;
        if (c && !out->beyond && fw_effects_comb_out_of_range(c))
            out->beyond = fw_effects_comb_out_of_range(c),
            out->beyond_id = k->w.model->element[i].own->id;
        if (!(share * share > out->fingers)) continue;
        out->fingers = share * share;
        out->fingers_V = least;
    }
}

/* the static voltage lies above the scene's: electrodes that touch all the same were thrown there
   (dynamic pull-in) */
static bool dynamic(const fw_statics_pull_in *p) {
    return p->margin >= 1;
}

const char *fw_statics_pull_in_explain(fw_arena *arena, const fw_statics_pull_in *p) {
    char at[32], asked[32];
    fw_number_text(at, sizeof at, p->voltage_V, 4);
    fw_number_text(asked, sizeof asked, p->largest_V, 4);
    bool none = p->kind == FW_PULL_IN_NONE;
    if (!dynamic(p))
        return fw_arena_printf(arena,
                               "static pull-in of %s%s %s %s V, below the %s V of the "
                               "scene",
                               FW_NAMED("comb drive", p->comb),
                               none ? "was not found up to" : "is at", at, asked);
    return fw_arena_printf(
        arena,
        "this is dynamic pull-in: static pull-in of %s%s is %s %s V, above the %s V of "
        "the "
        "scene, but a voltage or load that comes suddenly, or in step with an oscillation, throws "
        "the rotor further. Let it rise slowly, or use less",
        FW_NAMED("comb drive", p->comb), none ? "not below" : "at",
        isinf(p->voltage_V) ? "any" : at, asked);
}

static fw_status warn_fringe(const seeker *k, const char *scene, fw_diags *diags) {
    const fw_statics_pull_in *out = k->out;
    char at[32], asked[32], part[32], off[32];
    fw_diag_warning(diags, 248, out->place,
                    "%s%s may pull in: %s%s does so at %s V without %s, which "
                    "may add up to %s %% to its pull%s, its flexures may be less stiff by up to "
                    "%s %%, and the scene asks for up to %s V",
                    FW_NAMED("scene", scene), FW_NAMED("comb drive", out->comb),
                    fw_number_text(at, sizeof at, out->voltage_V, 5),
                    fw_statics_pull_in_fringe_text(out),
                    fw_number_text(part, sizeof part, 100 * out->fringe, 2),
                    out->fingers > 0.01 ? " and with stiff fingers" : "",
                    fw_percent_text(off, sizeof off, out->stiffness_error),
                    fw_number_text(asked, sizeof asked, out->largest_V, 5));
    return diags->failed ? FW_NOMEM : FW_OK;
}

static fw_status warn(const seeker *k, const fw_device_scene *scene, fw_diags *diags) {
    static const char *const how[] = {"", "snaps along the drive", "moves aside", "tilts"};
    const fw_statics_pull_in *out = k->out;
    const char *name = fw_text_name(scene->name);
    char at[32], asked[32];
    if (fw_statics_pull_in_fingers_snap(out))
        fw_diag_warning(diags, 595, out->place,
                        "%s%s: the fingers of a comb bend and may snap by themselves; up to %s "
                        "V they surely do not, "
                        "and the scene asks for %s times that",
                        FW_NAMED("scene", name), fw_number_text(at, sizeof at, out->fingers_V, 4),
                        fw_number_text(asked, sizeof asked, sqrt(out->fingers), 3));
    if (out->margin >= 1)
        return out->kind != FW_PULL_IN_NONE && !fw_statics_pull_in_fingers_snap(out) &&
                       out->margin < fw_statics_pull_in_margin(out)
                   ? warn_fringe(k, name, diags)
                   : FW_OK;
    fw_number_text(at, sizeof at, out->voltage_V, 5);
    fw_number_text(asked, sizeof asked, out->largest_V, 5);
    if (out->kind == FW_PULL_IN_NONE)
        fw_diag_warning(diags, 249, out->place,
                        "the pull-in voltage of %s%s was not found: %s%s is stable up to "
                        "%s V of its %s V; then %s",
                        FW_NAMED("scene", name), FW_NAMED("comb drive", out->comb), at, asked,
                        out->why);
    else
        fw_diag_warning(diags, 248, out->place,
                        "%s%s pulls in: at %s V%s%s%s %s%s %s (%s%s moves most), and the "
                        "scene asks for up to %s V",
                        FW_NAMED("scene", name), at, isnan(out->at_s) ? "" : ", ",
                        isnan(out->at_s) ? "" : out->together, isnan(out->at_s) ? "" : ",",
                        FW_NAMED("comb drive", out->comb), how[out->kind],
                        FW_NAMED("body", fw_text_name(out->body)), asked);
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* What the flexures' errors take of it. Where nothing but flexures and electrodes acts, V^2 goes with all of the stiffness, so
   that it is off by e, the share of their stiffness by which flexures are off in the motion that becomes free: energies of rotation,
   along and across weigh their errors. Where springs or other loads act besides it may be more: it is followed
   again with flexures softer by e. Error: one e for all flexures. Test: test_near_pull_in.py, PullIn */
static fw_status softer(const seeker *k, const fw_mechanism *mechanism,
                        const fw_effect_choice *effects, fw_diags *silent) {
    fw_statics_pull_in *out = k->out;
    const double e = out->stiffness_error;
    fw_effect_choice soft = *effects;
    seeker *again;
    if (out->kind == FW_PULL_IN_NONE || !(e > 0)) return FW_OK;
    FW_NEED(again = fw_arena_one(k->arena, seeker));
    again->arena = k->arena, again->scene = k->scene;
    soft.hinge = k->w.ledger.hinge.used, soft.like = NULL, soft.untold = true;
    soft.stiffer = (1 + soft.stiffer) * (1 - e) - 1;
    const fw_status status = seek(again, mechanism, &soft, silent);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    const double left = status == FW_OK && again->out ? again->out->margin / out->margin : 0;
    out->stiffness_error = fmin(1, fmax(e, 1 - left * left));
    return FW_OK;
}

/* ---- drives that do not act together ---- */

/* "as they act at 30 ms (cl)" */
static fw_status name_drives(seeker *k, double t_s) {
    char at[32];
    fw_text list = fw_text_new(k->arena);
    int n = 0;
    double most = 0;
    for (int i = 0; i < k->scene.ncomb; i++)
        most = fmax(most, fabs(k->scene.comb[i].voltage_V));
    for (int i = 0; i < k->scene.ncomb; i++)
        if (fabs(k->scene.comb[i].voltage_V) > 1e-3 * most)
            fw_text_printf(&list, "%s%s", n++ ? ", " : "", fw_text_name(k->scene.comb[i].id));
    FW_TRY(fw_text_end(&list));
    k->out->at_s = t_s;
    const char *few = fw_text_few(k->arena, list.data);
    FW_NEED(few);
    FW_NEED(k->out->together =
                fw_arena_printf(k->arena, "where what acts at %s ms (%s) grows together",
                                fw_number_text(at, sizeof at, 1e3 * t_s, 4), few));
    return FW_OK;
}

/* factor NULL: all at their largest */
static fw_status seek_with(fw_arena *arena, const fw_mechanism *mechanism,
                           const fw_device_scene *scene, const double *factor, double t_s,
                           const fw_effect_choice *effects, fw_diags *silent, seeker **best) {
    seeker *k;
    FW_NEED(k = fw_arena_one(arena, seeker));
    k->arena = arena;
    FW_TRY(hold_voltages(k, scene, factor));
    if (factor) k->scene.duration_s = t_s;
    const fw_status status = seek(k, mechanism, effects, silent);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    if (status != FW_OK || !k->out) return FW_OK; /* statics itself says why it cannot start */
    k->out->at_s = (double)NAN, k->out->together = "where all drives of the scene grow together";
    if (factor) FW_TRY(name_drives(k, t_s));
    fingers(k, mechanism);
    FW_TRY(softer(k, mechanism, effects, silent));
    const fw_statics_pull_in *now = k->out, *was = *best ? (*best)->out : NULL;
    const bool worse = was && now->margin / fw_statics_pull_in_margin(now) >=
                                  was->margin / fw_statics_pull_in_margin(was);
    const double most = fmax(now->fingers, was ? was->fingers : 0);
    const double at_V = was && was->fingers > now->fingers ? was->fingers_V : now->fingers_V;
    if (!worse) *best = k;
    (*best)->out->fingers = most, (*best)->out->fingers_V = at_V;
    return FW_OK;
}

/* Drives of one law, or of laws that keep their ratio, at the largest of it. Else whatever ratio their laws come to, and all other
   loads as they are then; the one that is nearest to its pull-in counts. Where there are more ratios than RATIOS all drives at their
   largest are followed as well. Error: of fw_quantity_law_ratios. Test: test_near_pull_in.py, Drives */
static fw_status seek_all(fw_arena *arena, const fw_mechanism *mechanism,
                          const fw_device_scene *scene, const fw_effect_choice *effects,
                          fw_diags *silent, seeker **best) {
    const size_t n = (size_t)scene->ncomb;
    double t_s[RATIOS], *factor;
    const fw_quantity_law **law;
    bool all;
    FW_NEED(law = fw_arena_alloc(arena, n, sizeof *law));
    FW_NEED(factor = fw_arena_array(arena, double, (RATIOS + 1) * n));
    for (size_t i = 0; i < n; i++)
        law[i] = scene->comb[i].law;
    const int count =
        fw_quantity_law_ratios(law, (int)n, scene->duration_s, RATIOS, t_s, factor, &all);
    for (int i = 0; i < count && count > 1; i++)
        FW_TRY(seek_with(arena, mechanism, scene, factor + (size_t)i * n, t_s[i], effects, silent,
                         best));
    if (count > 1 && all) return FW_OK;
    return seek_with(arena, mechanism, scene, NULL, scene->duration_s, effects, silent, best);
}

fw_status fw_statics_pull_in_find(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_device_scene *scene, const fw_effect_choice *effects,
                                  fw_diags *diags, const fw_statics_pull_in **found) {
    *found = NULL;
    bool driven = false;
    for (int i = 0; i < scene->ncomb; i++)
        driven = driven || scene->comb[i].voltage_V != 0;
    if (!driven) return FW_OK;
    if (3 * mechanism->nbody > FW_PULL_IN_MOST) {
        fw_diag_note(diags, 249, scene->comb[0].place,
                     "the pull-in voltage of %s%s was not computed: the mechanism has more "
                     "than %d bodies",
                     FW_NAMED("scene", fw_text_name(scene->name)), FW_PULL_IN_MOST / 3);
        return diags->failed ? FW_NOMEM : FW_OK;
    }
    seeker *k = NULL;
    fw_diags silent = fw_diags_new(arena);
    FW_TRY(seek_all(arena, mechanism, scene, effects, &silent, &k));
    if (!k) return FW_OK;
    FW_TRY(warn(k, scene, diags));
    *found = k->out;
    return FW_OK;
}
