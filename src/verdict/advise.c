/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What to change, and by how much: every declared parameter alone; longer flexures, else wider
   ones; less load or smaller required poses; several values together. Every proposal has been run
   as its settings say and accepted; the least change comes first. */
#include "base/constants.h"
#include "effects/effects.h"
#include "verdict/advice.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 14 };
/* Evaluations of hinges, of about half a microsecond each: of a search for several values, or for one kind of
   change; of all. Where a single look takes more than that the searches behind it are not begun. */
static const double most_work_together = 5e6, most_work_in_all = 2.5e7;
/* a change that is smaller is not worth looking for a smaller one of several values */
static const double small_enough = 0.1;
/* an advice nobody could follow is none: twelve times as long, four times as wide */
static const double most_longer = 12.0, most_wider = 4.0;

static bool accepted(const fw_verdict_trial *trial) {
    return trial->decision == FW_ACCEPT && trial->drawn;
}

static double excess(const fw_verdict_trial_hinge *h) {
    return fmax(h->utilisation_high, h->reach);
}

static fw_device_flexure *flexure_of(fw_verdict_trial *trial, const fw_verdict_trial_hinge *h) {
    return &trial->changed->flexure[trial->changed->revolute[h->joint].flexure];
}

/* a glance sees nothing against it */
static bool may_be_accepted(const fw_verdict_trial *trial) {
    return trial->decision != FW_REJECT && trial->drawn && !(fw_verdict_trial_excess(trial) > 1);
}

typedef bool change_one(fw_verdict_trial *, const fw_verdict_trial_hinge *, double extra);
static change_one lighten;

/* `change` on every hinge (and reason against a scene) that is not accepted; *worst: their largest
   utilisation; false: it is not possible, or there is none */
static bool change_each(fw_verdict_trial *trial, change_one *change, double extra, double *worst) {
    bool any = false;
    *worst = 0.0;
    for (int k = 0; k < trial->nhinge; k++) {
        const fw_verdict_trial_hinge *h = &trial->hinge[k];
        if (h->decision == FW_ACCEPT || (h->either_way && change != lighten)) continue;
        if (h->joint != FW_NONE) *worst = fmax(*worst, excess(h));
        if (!change(trial, h, extra)) return false;
        any = true;
    }
    return any;
}

/* repeats `change`, and judges, until all are accepted; gives up when a change is not possible or the
   worst hinge gets no better by it. Glances lead there; the end is judged wholly, or, if *glanced may stay so, left to
   a glance that accepts it as made, too: what is proposed lies nearer, and is judged wholly in any case. It may where
   something was accepted wholly before, from which the corners that govern there are known. */
static fw_status repeat(fw_verdict_trial *trial, change_one *change, bool *glanced) {
    const bool may_be_glanced = *glanced;
    *glanced = false;
    double worst_before = HUGE_VAL;
    const double most_work = fmin(trial->work + most_work_together, trial->most_work);
    for (int round = 0; round < ROUNDS && !accepted(trial); round++) {
        if (trial->work >= most_work) {
            trial->ended = true;
            return FW_OK;
        }
        double worst, extra = 1.0 + 0.03 * round; /* what is too much is taken back after */
        trial->round = round;
        if (!change_each(trial, change, extra, &worst)) return FW_OK;
        if (round > 1 && worst > 0 && worst > 0.999 * worst_before) return FW_OK;
        worst_before = worst > 0 ? worst : HUGE_VAL;
        int fabricated = trial->fabricated;
        FW_TRY(fw_verdict_trial_run(trial, FW_LOOK_VALUES));
        *glanced = may_be_glanced && accepted(trial) && trial->all_made;
        if (may_be_accepted(trial) && !*glanced) FW_TRY(fw_verdict_trial_run(trial, FW_LOOK_WHOLE));
        if (trial->fabricated != fabricated)
            worst_before = HUGE_VAL; /* corners are tighter than the drawing */
        if (!trial->drawn) return FW_OK;
    }
    return FW_OK;
}

/* ---- lengths: strain per radian goes with 1/L ---- */

/* rounded up to 1 um of length, or 0.1 um of the radius where the file gives that */
static bool lengthen(fw_verdict_trial *trial, const fw_verdict_trial_hinge *h, double extra) {
    if (h->joint == FW_NONE) return false;        /* softer flexures are less stable */
    if (h->utilisation_high <= 1.0) return false; /* its solids meet: length is not the cause */
    fw_device_flexure *f = flexure_of(trial, h);
    if (f->kind == FW_FLEXURE_PATH) return false; /* which of its pieces is the designer's choice */
    double length = f->length_m * fmin(fmax(h->utilisation_high * extra, 1.0005), 3.0);
    bool by_radius = f->kind == FW_FLEXURE_CSFH && f->radius_given;
    double unit = by_radius ? 1e-7 * f->angle_rad : 1e-6;
    f->length_m = ceil(length / unit - 1e-6) * unit;
    if (f->kind == FW_FLEXURE_CSFH) f->radius_m = f->length_m / f->angle_rad;
    const fw_device_flexure *was = &trial->device->flexure[f - trial->changed->flexure];
    return f->length_m <= most_longer * was->length_m &&
           fw_verdict_flexure_within(trial, (int)(f - trial->changed->flexure));
}

/* ---- proposals ---- */

typedef struct advice { /* what is at hand while all kinds of changes are tried */
    fw_verdict_trial *trial;
    fw_verdict *out;
    bool ended;             /* a search was, before it was done */
    fw_text tried, untried; /* kinds of changes; those that there was no time left for */
} advice;

/* is there time to begin with a kind of change? */
static bool may_begin(advice *a, const char *kind) {
    const bool yes = a->trial->work < a->trial->most_work;
    fw_text *list = yes ? &a->tried : &a->untried;
    fw_text_printf(list, "%s%s", list->length > 0 ? ", " : "", kind);
    return yes;
}

static void add(advice *a, fw_verdict_proposal proposal) {
    a->out->proposal[a->out->nproposal++] = proposal;
}

/* the settings are read, drawn and judged; what is not accepted is not proposed */
static fw_status add_verified(advice *a, fw_verdict_proposal proposal, bool *added) {
    *added = false;
    if (proposal.nset == 0) return FW_OK;
    *added = fw_verdict_trial_accepted(a->trial, proposal.set, proposal.nset);
    if (!*added) {
        FW_TRY(fw_verdict_trial_restate(a->trial, proposal.set, proposal.nset, FW_LOOK_WHOLE));
        *added = accepted(a->trial);
    }
    if (*added) add(a, proposal);
    return FW_OK;
}

/* the device as described once more; which corners governed stays known */
static fw_status start_again(advice *a) {
    fw_verdict_trial *t = a->trial;
    const fw_verdict_trial was = *t;
    const size_t n = (size_t)was.verdict->nvariant;
    FW_TRY(fw_verdict_trial_start(t->arena, t->device, t->options, t->verdict, t));
    t->work = was.work, t->most_work = was.most_work;
    t->end = was.end, t->written = was.written, t->accepted = was.accepted;
    memcpy(t->suspect, was.suspect, n * sizeof *t->suspect);
    return FW_OK;
}

typedef struct lines { /* of flexures that were changed */
    fw_device_set *set;
    int nset;
    double change;
    fw_text text;
} lines;

static fw_status lines_new(const advice *a, lines *l) {
    *l = (lines){.text = fw_text_new(a->trial->arena)};
    FW_NEED(l->set = fw_arena_array(a->trial->arena, fw_device_set,
                                    2 * (size_t)a->trial->device->nflexure));
    return FW_OK;
}

static fw_status add_line(fw_verdict_trial *trial, lines *l, const fw_device_flexure *f,
                          const char *what, const char *attribute, double to_m, double from_m) {
    fw_device_set *set = &l->set[l->nset++];
    fw_verdict_value v;
    FW_NEED(set->path = fw_arena_printf(trial->arena, "flexure[%s]/@%s", f->id, attribute));
    FW_TRY(fw_verdict_value_of_length(trial, set->path, from_m, 1, 1, &v));
    const double to = fw_quantity_unit_from_si(&v.unit, to_m);
    const char *from = fw_verdict_value_text(trial->arena, &v, v.now, 4);
    FW_NEED(from && (set->value = fw_verdict_value_text(trial->arena, &v, to, 6)) ? from : NULL);
    fw_text_printf(&l->text, "%sflexure %s: %s >= %s is accepted; now %s", l->nset > 1 ? "; " : "",
                   f->id, what, set->value, from);
    return FW_OK;
}

static fw_status propose_lines(advice *a, lines *l, bool *added) {
    FW_TRY(fw_text_end(&l->text));
    return add_verified(a,
                        (fw_verdict_proposal){.kind = FW_PROPOSE_FLEXURES,
                                              .set = l->set,
                                              .nset = l->nset,
                                              .change = l->change,
                                              .text = l->text.data},
                        added);
}

static fw_status propose_lengths(void *context, bool *added) {
    advice *a = context;
    fw_verdict_trial *trial = a->trial;
    lines l;
    FW_TRY(lines_new(a, &l));
    for (int i = 0; i < trial->device->nflexure; i++) {
        const fw_device_flexure *was = &trial->device->flexure[i], *f = &trial->changed->flexure[i];
        if (f->length_m == was->length_m) continue;
        bool arc = f->kind == FW_FLEXURE_CSFH;
        l.change += fabs(log(f->length_m / was->length_m));
        if (f->length_given || !arc)
            FW_TRY(add_line(trial, &l, f, arc ? "arc length" : "leaf length", "length", f->length_m,
                            was->length_m));
        if (arc && f->radius_given)
            FW_TRY(add_line(trial, &l, f, "radius", "radius", f->radius_m, was->radius_m));
    }
    return propose_lines(a, &l, added);
}

/* reaches an accepted, drawn device by one kind of change, and proposes the least of it */
static fw_status change_by(advice *a, const char *kind, change_one *change,
                           fw_verdict_propose *propose, bool *added) {
    *added = false;
    if (!may_begin(a, kind)) return FW_OK;
    for (int turn = 0; turn < 2 && !*added; turn++) {
        bool glanced = turn == 0 && a->trial->accepted;
        FW_TRY(start_again(a));
        FW_TRY(repeat(a->trial, change, &glanced));
        if (accepted(a->trial))
            FW_TRY(fw_verdict_least_change(a->trial, most_work_together, propose, a, added));
        a->ended = a->ended || a->trial->ended;
        if (!glanced || a->trial->ended) return FW_OK;
    }
    return FW_OK;
}

/* ---- widths: under a given load the stress goes with 1/t^2, as long as stiffness follows ---- */

/* flexures that vary have no one width to change */
static bool widen_one(fw_verdict_trial *trial, fw_device_flexure *f, double by) {
    if (fw_device_flexure_varies(f)) return false;
    f->width_m = ceil(f->width_m * fmin(fmax(by, 1.0005), 1.5) * 1e7 - 1e-6) * 1e-7;
    const fw_device_flexure *was = &trial->device->flexure[f - trial->changed->flexure];
    bool slender = f->width_m <= 0.25 * f->length_m &&
                   (f->kind != FW_FLEXURE_CSFH || f->width_m <= 0.5 * f->radius_m);
    return slender && f->width_m <= most_wider * was->width_m &&
           fw_verdict_flexure_within(trial, (int)(f - trial->changed->flexure));
}

/* what a scene bears goes with the stiffness of all flexures, t^3 */
static bool widen(fw_verdict_trial *trial, const fw_verdict_trial_hinge *h, double extra) {
    if (h->utilisation_high <= 1.0 || h->not_by_width) return false;
    if (h->joint != FW_NONE)
        return widen_one(trial, flexure_of(trial, h), sqrt(h->utilisation_high * extra));
    for (int i = 0; i < trial->changed->nflexure; i++)
        if (!widen_one(trial, &trial->changed->flexure[i], cbrt(h->utilisation_high * extra)))
            return false;
    return trial->changed->nflexure > 0;
}

static fw_status propose_widths(void *context, bool *added) {
    advice *a = context;
    fw_verdict_trial *trial = a->trial;
    lines l;
    FW_TRY(lines_new(a, &l));
    for (int i = 0; i < trial->device->nflexure; i++) {
        const fw_device_flexure *was = &trial->device->flexure[i], *f = &trial->changed->flexure[i];
        if (f->width_m == was->width_m) continue;
        l.change += fabs(log(f->width_m / was->width_m));
        FW_TRY(add_line(trial, &l, f, "width", "width", f->width_m, was->width_m));
    }
    return propose_lines(a, &l, added);
}

/* ---- loads and required poses: less of them ---- */

/* a scene or workspace is scaled once per round, by the hinge that it strains most */
static bool is_worst(const fw_verdict_trial *trial, const fw_verdict_trial_hinge *h) {
    for (int k = 0; k < trial->nhinge; k++) {
        const fw_verdict_trial_hinge *o = &trial->hinge[k];
        if (o == h || o->decision == FW_ACCEPT || !o->scene) continue;
        if (!fw_text_same(o->scene, h->scene)) continue;
        if (excess(o) > excess(h) || (excess(o) == excess(h) && o < h)) return false;
    }
    return true;
}

static bool lighten(fw_verdict_trial *trial, const fw_verdict_trial_hinge *h, double extra) {
    if (h->not_by_loads) return false;
    if (!is_worst(trial, h)) return true;
    double over = excess(h) * extra;
    double by = fmax(fmin(1.0 / over, 0.9995), 1e-6);
    if (h->joint == FW_NONE) by = pow(by, trial->round + 1); /* a guess: further each time */
    bool any = false; /* what is of no one scene: of all of them and of the boxes together */
    for (int i = 0; i < trial->changed->nscene; i++)
        if (!h->scene || fw_text_same(trial->changed->scene[i].name, h->scene)) {
            trial->share[i] *= by;
            any = fw_effects_scale(&trial->changed->scene[i], by) || any;
            if (h->scene) return any;
        }
    for (int i = 0; i < trial->changed->nworkspace; i++) {
        fw_device_workspace_box *w = &trial->changed->workspace[i];
        if (w->flow && !fw_text_same(w->flow, h->flow)) continue;
        w->x_min_m *= by, w->x_max_m *= by;
        w->y_min_m *= by, w->y_max_m *= by;
        w->phi_min_rad *= by, w->phi_max_rad *= by;
    }
    return any || fw_text_same(h->scene, "workspace");
}

static double kept(double now, double was) {
    return was != 0.0 ? now / was : 1.0;
}

/* down to three digits */
static double rounded_down(double share) {
    double unit = pow(10, floor(log10(share)) - 2);
    return unit * floor(share / unit * (1 + 1e-12));
}

static void add_share(fw_text *text, double share) {
    fw_text_number(text, 100 * share, 4);
    fw_text_add(text, " %");
}
/* "the loads of scene push to 50 %"; what is scaled besides forces and torques is named */
static void report_scene(fw_text *text, const fw_device_scene *s, double share, const char **join) {
    fw_effects_load_scaling loads;
    int plain = 0, others = 0, named = 0;
    fw_effects_find_loads(s, &loads);
    for (int i = 0; i < loads.count; i++) {
        plain += !loads.item[i].squared;
        others += !loads.item[i].squared && !loads.item[i].ordinary;
    }
    if (plain > 0) {
        fw_text_printf(text, "%sthe loads", *join);
        for (int i = 0; others > 0 && i < loads.count; i++)
            if (!loads.item[i].squared)
                fw_text_printf(text, named++ ? ", %s" : " (%s", loads.item[i].name);
        fw_text_printf(text, "%s of %s%s to ", others > 0 ? ")" : "", FW_NAMED("scene", s->name));
        add_share(text, share);
        *join = ", ";
    }
    for (int i = 0; i < loads.count; i++) {
        if (!loads.item[i].squared) continue;
        fw_text_printf(text, "%sthe %s of %s%s to ", *join, loads.item[i].name,
                       FW_NAMED("scene", s->name));
        add_share(text, rounded_down(sqrt(share)));
        *join = ", ";
    }
}

static double share_of_box(const fw_device_workspace_box *was, const fw_device_workspace_box *w) {
    return fmin(kept(w->x_max_m, was->x_max_m),
                fmin(kept(w->y_max_m, was->y_max_m), kept(w->phi_max_rad, was->phi_max_rad)));
}

typedef struct shares {            /* what is left of each scene's loads and of each required box */
    fw_verdict_variable *variable; /* (count) */
    double *x, change;
    int count;
    fw_text text;
    const char *join;
} shares;

static fw_status take_scene(fw_verdict_trial *trial, int i, shares *s, bool *ok) {
    const double share = trial->share[i];
    *ok = true;
    if (share >= 0.9999) return FW_OK;
    FW_TRY(fw_verdict_variable_of_loads(trial, i, &s->variable[s->count], ok));
    s->x[s->count++] = rounded_down(share);
    s->change += fabs(log(s->x[s->count - 1]));
    report_scene(&s->text, &trial->device->scene[i], rounded_down(share), &s->join);
    return FW_OK;
}

static fw_status take_box(fw_verdict_trial *trial, int i, shares *s, bool *ok) {
    const fw_device_workspace_box *was = &trial->device->workspace[i];
    const double share = share_of_box(was, &trial->changed->workspace[i]);
    *ok = true;
    if (share >= 0.9999) return FW_OK;
    FW_TRY(fw_verdict_variable_of_box(trial, i, &s->variable[s->count], ok));
    s->x[s->count++] = rounded_down(share);
    s->change += fabs(log(s->x[s->count - 1]));
    fw_text_printf(&s->text, "%sthe required workspace%s%s to ", s->join, was->flow ? " of " : "",
                   was->flow ? was->flow : "");
    add_share(&s->text, rounded_down(share));
    s->join = ", ";
    return FW_OK;
}

static fw_status propose_shares(void *context, bool *added) {
    advice *a = context;
    fw_verdict_trial *trial = a->trial;
    const fw_device *d = trial->device;
    size_t most = (size_t)d->nscene + (size_t)d->nworkspace;
    shares s = {.text = fw_text_new(trial->arena), .join = "reduce "};
    fw_verdict_proposal proposal = {.kind = FW_PROPOSE_LOADS};
    bool ok = true;
    *added = false;
    FW_NEED(s.variable = fw_arena_array(trial->arena, fw_verdict_variable, most));
    FW_NEED(s.x = fw_arena_array(trial->arena, double, most));
    for (int i = 0; ok && i < d->nscene; i++)
        FW_TRY(take_scene(trial, i, &s, &ok));
    for (int i = 0; ok && i < d->nworkspace; i++)
        FW_TRY(take_box(trial, i, &s, &ok));
    if (!ok || s.count == 0) return FW_OK;
    fw_text_add(&s.text, ": accepted");
    FW_TRY(fw_text_end(&s.text));
    FW_TRY(fw_verdict_variables_settings(trial->arena, s.variable, s.count, s.x, &proposal.set,
                                         &proposal.nset));
    proposal.change = s.change;
    proposal.text = s.text.data;
    return add_verified(a, proposal, added);
}

/* ---- parameters ---- */

static fw_status propose_parameters(advice *a) {
    for (int i = 0; i < a->out->nparameter; i++) {
        const fw_verdict_parameter_advice *p = &a->out->parameter[i];
        a->ended = a->ended || p->ended;
        if (p->found != FW_PARAMETER_ACCEPTS) continue;
        fw_device_set *set = fw_arena_one(a->trial->arena, fw_device_set);
        FW_NEED(set);
        *set = (fw_device_set){p->name, p->value_text};
        const bool ratio = (p->to > 0 && p->from > 0) || (p->to < 0 && p->from < 0);
        const double range = fmax(p->high - p->from, p->from - p->low);
        add(a, (fw_verdict_proposal){.kind = FW_PROPOSE_PARAMETER,
                                     .set = set,
                                     .nset = 1,
                                     .change = ratio ? fabs(log(p->to / p->from))
                                                     : fabs(p->to - p->from) / range,
                                     .text = p->text});
    }
    return FW_OK;
}

static double least_so_far(const fw_verdict *v) {
    double least = HUGE_VAL;
    for (int i = 0; i < v->nproposal; i++)
        least = fmin(least, v->proposal[i].change);
    return least;
}

/* what is found is new where it is smaller than all that is known, or changes something else */
static fw_status propose_several(advice *a, const fw_verdict_variable *variable, int count) {
    fw_verdict_trial *trial = a->trial;
    fw_verdict_several found;
    fw_verdict_proposal proposal = {.kind = FW_PROPOSE_SEVERAL};
    bool added;
    FW_TRY(start_again(a));
    FW_TRY(fw_verdict_change_several(trial, variable, count, least_so_far(a->out),
                                     fmin(trial->work + most_work_together, trial->most_work),
                                     &found));
    a->ended = a->ended || found.ended;
    if (!found.accepted || found.size > 0.98 * least_so_far(a->out)) return FW_OK;
    FW_TRY(fw_verdict_variables_settings(trial->arena, variable, count, found.x, &proposal.set,
                                         &proposal.nset));
    FW_TRY(fw_verdict_variables_text(trial->arena, variable, count, found.x, &proposal.text));
    proposal.change = found.size;
    for (int i = 0; proposal.nset == 1 && i < count; i++)
        if (found.x[i] != variable[i].value.now) proposal.kind = variable[i].kind;
    return add_verified(a, proposal, &added);
}

static fw_status change_parameters_together(advice *a) {
    fw_verdict_variable *variable;
    int count;
    if (least_so_far(a->out) <= small_enough) return FW_OK;
    FW_TRY(fw_verdict_variables_of_parameters(a->trial, &variable, &count));
    if (count < 2 || !may_begin(a, "several parameters together")) return FW_OK;
    return propose_several(a, variable, count);
}

/* fewer or smaller: a way of its own, as flexures and loads are, which stands beside a smaller change of something else */
static fw_status change_holes(advice *a) {
    fw_verdict_trial *trial = a->trial;
    fw_verdict_variable *v;
    int count;
    double x;
    bool found;
    FW_TRY(fw_verdict_variables_of_holes(trial, &v, &count));
    if (count == 0 || !may_begin(a, "fewer and smaller release holes")) return FW_OK;
    for (int i = 0; i < count; i++) {
        fw_verdict_proposal proposal = {.kind = FW_PROPOSE_HOLES};
        FW_TRY(start_again(a));
        FW_TRY(fw_verdict_least_step(
            trial, &v[i], fmin(trial->work + most_work_together, trial->most_work), &x, &found));
        if (!found) continue;
        FW_TRY(fw_verdict_variables_settings(trial->arena, &v[i], 1, &x, &proposal.set,
                                             &proposal.nset));
        FW_TRY(fw_verdict_variables_text(trial->arena, &v[i], 1, &x, &proposal.text));
        proposal.change = fw_verdict_variable_size(&v[i], x);
        add(a, proposal);
    }
    return FW_OK;
}

static fw_status change_all(advice *a) {
    fw_verdict_variable *variable;
    int count;
    if (a->out->nproposal > 0) return FW_OK;
    FW_TRY(fw_verdict_variables_of_attributes(a->trial, &variable, &count));
    if (count == 0) return FW_OK;
    if (!may_begin(a, "lengths, widths, loads and required poses together")) return FW_OK;
    return propose_several(a, variable, count);
}

/* ---- which changes are tried, and what is said ---- */

/* no change of a flexure can help */
static bool turned(const fw_dynamics_motion *motion) {
    for (int i = 0; i < motion->npin; i++)
        if (fabs(motion->peak[i].angle_rad) > 0.99 * FW_TURN) return true;
    return false;
}

static const char *hopeless(const fw_device *device, const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (v->workspace.required && !v->workspace.reachable && v->workspace.beyond.certain)
            return "part of the required workspace is out of reach, and no flexure can change "
                   "that: make the links longer or the workspace smaller";
        for (int k = 0; k < device->nscene; k++)
            if (v->motion[k] && v->motion[k]->ended && turned(v->motion[k]))
                return "a scene turns a joint by more than a whole turn, and no flexure can "
                       "follow: lower its load";
    }
    return NULL;
}

/* neither a flexure nor a load makes room for a part: only parameters may */
static bool lacks_part(const fw_verdict *verdict) {
    return verdict->layout && verdict->layout->nmissing > 0;
}

/* what the time did not do for; "" where it did for all */
static const char *left_out(const advice *a) {
    if (a->untried.length > 0)
        return fw_arena_printf(a->trial->arena,
                               "the search was ended where it would have taken too long, and not "
                               "tried were %s",
                               a->untried.data);
    return a->ended ? "the search was ended where it would have taken too long" : "";
}

static fw_status conclude(advice *a, const char *why) {
    fw_verdict *v = a->out;
    fw_arena *arena = a->trial->arena;
    FW_TRY(fw_text_end(&a->tried));
    FW_TRY(fw_text_end(&a->untried));
    const char *left = left_out(a);
    FW_NEED(left);
    v->advice_note = NULL;
    if (v->nproposal > 0) {
        if (*left)
            FW_NEED(v->advice_note =
                        fw_arena_printf(arena, "%s: there may be smaller changes", left));
        return FW_OK;
    }
    if (lacks_part(v)) {
        FW_NEED(
            v->advice_note = fw_arena_printf(
                arena,
                "%sa part that finds no room in the drawing is not drawn, which neither flexures "
                "nor loads change: give it the place or the size that its reason names",
                v->nparameter > 0 ? "no change of a parameter was found with which the design is "
                                    "accepted; "
                                  : ""));
        return FW_OK;
    }
    FW_NEED(v->advice_note = fw_arena_printf(
                arena,
                "no change was found with which the design is accepted%s; tried were %s: %s%s%s",
                a->trial->shapeless ? "" : " and can be drawn", a->tried.data, left,
                *left ? "; " : "", why ? why : "reconsider hinge points, thickness or material"));
    return FW_OK;
}

fw_status fw_verdict_advise(fw_arena *arena, const fw_device *device,
                            const fw_verdict_options *options, fw_verdict *verdict) {
    if (verdict->decision == FW_ACCEPT || !options->with_advice || !options->restated.with)
        return FW_OK;
    if (fw_verdict_no_number_helps(verdict, &verdict->advice_note)) return FW_OK;
    fw_verdict_trial trial;
    advice a = {.trial = &trial,
                .out = verdict,
                .tried = fw_text_new(arena),
                .untried = fw_text_new(arena)};
    const char *why = hopeless(device, verdict);
    bool added = false;
    FW_NEED(verdict->proposal =
                fw_arena_array(arena, fw_verdict_proposal, (size_t)device->nparameter + 6));
    FW_TRY(fw_verdict_trial_start(arena, device, options, verdict, &trial));
    trial.most_work = most_work_in_all;
    if (device->nparameter > 0 && may_begin(&a, "every parameter alone"))
        FW_TRY(fw_verdict_change_parameters(&trial, verdict));
    FW_TRY(propose_parameters(&a));
    const bool lacks = lacks_part(verdict);
    if (!lacks) FW_TRY(change_holes(&a));
    if (!why && !lacks) FW_TRY(change_by(&a, "longer flexures", lengthen, propose_lengths, &added));
    if (!why && !lacks && !added)
        FW_TRY(change_by(&a, "wider flexures", widen, propose_widths, &added));
    if (!lacks)
        FW_TRY(change_by(&a, "smaller loads and required poses", lighten, propose_shares, &added));
    FW_TRY(change_parameters_together(&a));
    if (!lacks) FW_TRY(change_all(&a));
    fw_verdict_sort_proposals(verdict);
    return conclude(&a, why);
}
