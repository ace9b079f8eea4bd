/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What to change, and by how much: longer flexures, else wider ones; and, beside either, how far
   the loads or the required poses would have to come down; and every declared parameter alone.
   Every sentence has been run and accepted. */
#include "verdict/trial.h"
#include <math.h>
#include <string.h>

enum { ROUNDS = 14 };
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

/* repeats `change` on every hinge (and reason against a scene) that is not accepted, and judges,
   until all are; gives up when a change is not possible or the worst hinge gets no better by it */
static fw_status repeat(fw_verdict_trial *trial,
                        bool (*change)(fw_verdict_trial *, const fw_verdict_trial_hinge *,
                                       double)) {
    double worst_before = HUGE_VAL;
    for (int round = 0; round < ROUNDS && !accepted(trial); round++) {
        double worst = 0.0, extra = 1.0 + 0.03 * round; /* what is too much is taken back after */
        bool any = false;
        trial->round = round;
        for (int k = 0; k < trial->nhinge; k++) {
            const fw_verdict_trial_hinge *h = &trial->hinge[k];
            if (h->decision == FW_ACCEPT) continue;
            if (h->joint != FW_NONE) worst = fmax(worst, excess(h));
            if (!change(trial, h, extra)) return FW_OK;
            any = true;
        }
        if (!any || (round > 1 && worst > 0 && worst > 0.999 * worst_before)) return FW_OK;
        worst_before = worst > 0 ? worst : HUGE_VAL;
        int fabricated = trial->fabricated;
        FW_TRY(fw_verdict_trial_run(trial));
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
    return f->length_m <= most_longer * was->length_m;
}

static fw_status add_line(fw_verdict_trial *trial, fw_verdict *out, const fw_device_flexure *f,
                          const char *what, const char *attribute, double to_m, double from_m) {
    char to[32], from[32];
    fw_number_text(to, sizeof to, to_m * 1e6, 6);
    fw_number_text(from, sizeof from, from_m * 1e6, 4);
    fw_verdict_advice *advice = &out->advice[out->nadvice++];
    advice->value = to_m;
    advice->change = fabs(to_m - from_m) / from_m;
    FW_NEED(advice->value_text = fw_arena_printf(trial->arena, "%s um", to));
    FW_NEED(advice->set_path = fw_arena_printf(trial->arena, "flexure[%s]/@%s", f->id, attribute));
    FW_NEED(advice->text =
                fw_arena_printf(trial->arena, "flexure %s: %s >= %s um is accepted; now %s um",
                                f->id, what, to, from));
    return FW_OK;
}

/* advise.c: each tries to reach an accepted, drawn device by one kind of change. *done: it did,
   and wrote its advice (lines into verdict->advice, or a sentence). */
static fw_status change_lengths(fw_verdict_trial *trial, fw_verdict *out, bool *done) {
    FW_TRY(repeat(trial, lengthen));
    *done = accepted(trial);
    if (*done) FW_TRY(fw_verdict_least_change(trial));
    for (int i = 0; *done && i < trial->device->nflexure; i++) {
        const fw_device_flexure *was = &trial->device->flexure[i], *f = &trial->changed->flexure[i];
        if (f->length_m == was->length_m) continue;
        bool arc = f->kind == FW_FLEXURE_CSFH;
        if (f->length_given || !arc)
            FW_TRY(add_line(trial, out, f, arc ? "arc length" : "leaf length", "length",
                            f->length_m, was->length_m));
        if (arc && f->radius_given)
            FW_TRY(add_line(trial, out, f, "radius", "radius", f->radius_m, was->radius_m));
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
    return slender && f->width_m <= most_wider * was->width_m;
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

static fw_status change_widths(fw_verdict_trial *trial, fw_verdict *out, bool *done) {
    FW_TRY(repeat(trial, widen));
    *done = accepted(trial);
    if (*done) FW_TRY(fw_verdict_least_change(trial));
    for (int i = 0; *done && i < trial->device->nflexure; i++) {
        const fw_device_flexure *was = &trial->device->flexure[i], *f = &trial->changed->flexure[i];
        if (f->width_m != was->width_m)
            FW_TRY(add_line(trial, out, f, "width", "width", f->width_m, was->width_m));
    }
    return FW_OK;
}

/* ---- loads and required poses: less of them ---- */

static bool same(const char *a, const char *b) {
    return a && b && strcmp(a, b) == 0;
}

/* a scene or workspace is scaled once per round, by the hinge that it strains most */
static bool is_worst(const fw_verdict_trial *trial, const fw_verdict_trial_hinge *h) {
    for (int k = 0; k < trial->nhinge; k++) {
        const fw_verdict_trial_hinge *o = &trial->hinge[k];
        if (o == h || o->decision == FW_ACCEPT || !same(o->scene, h->scene)) continue;
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
    for (int i = 0; i < trial->changed->nscene; i++)
        if (same(trial->changed->scene[i].name, h->scene)) {
            trial->share[i] *= by;
            return fw_effects_scale(&trial->changed->scene[i], by);
        }
    for (int i = 0; i < trial->changed->nworkspace; i++) {
        fw_device_workspace_box *w = &trial->changed->workspace[i];
        if (w->flow && !same(w->flow, h->flow)) continue;
        w->x_min_m *= by, w->x_max_m *= by;
        w->y_min_m *= by, w->y_max_m *= by;
        w->phi_min_rad *= by, w->phi_max_rad *= by;
    }
    return same(h->scene, "workspace");
}

static double kept(double now, double was) {
    return was != 0.0 ? now / was : 1.0;
}

/* rounded down to three digits, in per cent */
static void add_share(fw_text *text, double share) {
    double unit = pow(10, floor(log10(share)) - 2);
    fw_text_number(text, 100 * unit * floor(share / unit * (1 + 1e-12)), 3);
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
        fw_text_printf(text, "%s of scene %s to ", others > 0 ? ")" : "", s->name);
        add_share(text, share);
        *join = ", ";
    }
    for (int i = 0; i < loads.count; i++) {
        if (!loads.item[i].squared) continue;
        fw_text_printf(text, "%sthe %s of scene %s to ", *join, loads.item[i].name, s->name);
        add_share(text, sqrt(share));
        *join = ", ";
    }
}

/* the share that is left of each scene's loads and of each workspace */
static fw_status report_loads(fw_verdict_trial *trial, const char **sentence) {
    fw_text text = fw_text_new(trial->arena);
    const char *join = "";
    for (int i = 0; i < trial->device->nscene; i++)
        if (trial->share[i] < 0.9999)
            report_scene(&text, &trial->device->scene[i], trial->share[i], &join);
    for (int i = 0; i < trial->device->nworkspace; i++) {
        const fw_device_workspace_box *was = &trial->device->workspace[i],
                                      *w = &trial->changed->workspace[i];
        double share =
            fmin(kept(w->x_max_m, was->x_max_m),
                 fmin(kept(w->y_max_m, was->y_max_m), kept(w->phi_max_rad, was->phi_max_rad)));
        if (share > 0.9999) continue;
        fw_text_printf(&text, "%sthe required workspace%s%s to ", join, was->flow ? " of " : "",
                       was->flow ? was->flow : "");
        add_share(&text, share);
        join = ", ";
    }
    FW_TRY(fw_text_end(&text));
    *sentence = text.data;
    return FW_OK;
}

static fw_status change_loads(fw_verdict_trial *trial, const char **sentence, bool *done) {
    FW_TRY(repeat(trial, lighten));
    *done = accepted(trial);
    if (*done) FW_TRY(fw_verdict_least_change(trial));
    if (*done) FW_TRY(report_loads(trial, sentence));
    *done = *done && *sentence;
    return FW_OK;
}

/* ---- which changes are tried, in which order, and what is said ---- */

/* no change of a flexure can help */
static const char *hopeless(const fw_device *device, const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (v->workspace.required && !v->workspace.reachable)
            return "part of the required workspace is out of reach: no flexure can change that; "
                   "make the links longer or the workspace smaller";
        for (int k = 0; k < device->nscene; k++)
            if (v->motion[k] && v->motion[k]->ended)
                return "a scene turns a joint by more than a whole turn: no flexure can follow; "
                       "lower its load";
    }
    return NULL;
}

static fw_status conclude(fw_arena *arena, fw_verdict *verdict, const char *loads) {
    if (!verdict->advice_verified && !loads) {
        verdict->advice_note =
            "no single kind of change (longer or wider flexures, smaller loads or workspace) was "
            "found with which the design is accepted and can be drawn: reconsider hinge points, "
            "thickness or material";
        return FW_OK;
    }
    if (!verdict->advice_verified)
        verdict->advice_note = fw_arena_printf(
            arena,
            "reduce %s: this was run and accepted; longer or wider flexures alone do not help",
            loads);
    else
        verdict->advice_note =
            fw_arena_printf(arena, "%s run and accepted%s%s%s",
                            verdict->nadvice > 1 ? "all of these together were" : "this was",
                            loads ? "; or keep the flexures and reduce " : "", loads ? loads : "",
                            loads ? ": run and accepted as well" : "");
    FW_NEED(verdict->advice_note);
    return FW_OK;
}

fw_status fw_verdict_advise(fw_arena *arena, const fw_device *device,
                            const fw_verdict_options *options, fw_verdict *verdict) {
    if (verdict->decision == FW_ACCEPT || !options->with_advice) return FW_OK;
    FW_TRY(fw_verdict_change_parameters(arena, device, options, verdict));
    verdict->advice_note = hopeless(device, verdict);
    if (verdict->advice_note) return FW_OK;
    FW_NEED(verdict->advice =
                fw_arena_array(arena, fw_verdict_advice, 2 * (size_t)device->nflexure));
    fw_verdict_trial trial;
    bool done = false;
    const char *loads = NULL;
    FW_TRY(fw_verdict_trial_start(arena, device, options, verdict, &trial));
    FW_TRY(change_lengths(&trial, verdict, &done));
    if (!done) {
        FW_TRY(fw_verdict_trial_start(arena, device, options, verdict, &trial));
        FW_TRY(change_widths(&trial, verdict, &done));
    }
    verdict->advice_verified = done;
    FW_TRY(fw_verdict_trial_start(arena, device, options, verdict, &trial));
    FW_TRY(change_loads(&trial, &loads, &done));
    return conclude(arena, verdict, done ? loads : NULL);
}
