/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What decides a device of a study, in numbers: what each hinge and requirement of it uses of its limit, of a die every check, and
   what the whole device uses; and at which corners it is judged. */
#include "plan/design.h"
#include "study/study_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- what a device uses ---- */

static double of_requirements(const fw_verdict_requirement *r, int n, double most) {
    for (int i = 0; r && i < n; i++)
        most = fmax(most, r[i].utilisation_high); /* NaN is passed */
    return most;
}

static double of_hinges(const fw_verdict_hinge_verdict *h, int n, double most) {
    for (int i = 0; i < n; i++)
        if (h[i].scene) most = fmax(most, h[i].utilisation_high);
    return most;
}

/* Reasons beside hinges and requirements say no number: a device that is not accepted uses at least this. The
   search is told by it which way is out where nothing else tells. */
const double fw_study_beyond = 1.001;

/* A hinge as made or a requirement that is not accepted is a reason as well, and has the number of what it uses by itself:
   `keep` of the reason is where advice begins, a little below what would hold. */
static bool is_check(const fw_verdict_reason *r) {
    return r->number == 237 || r->number == 330 || r->number == 331;
}

/* Reasons that measure nothing say where advice begins by a round share of the loads, which is no number of the device:
   taken for one, it would be the same wherever the reason is, and fall where another one is measured. */
static bool measured(const fw_verdict_reason *r) {
    return !is_check(r) && r->keep > 0 && r->keep != FW_VERDICT_KEEP_HALF &&
           r->keep != FW_VERDICT_KEEP_MOST;
}

double fw_study_used_of(const fw_verdict *verdict, int decision) {
    double most = 0;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        most = of_hinges(v->hinge, v->nhinge, most);
        most = of_requirements(v->requirement, v->nrequirement, most);
        for (int k = 0; v->fabricated && k < v->fabricated->ncorner; k++) {
            const fw_verdict_fabricated_corner *c = &v->fabricated->corner[k];
            most = of_hinges(c->hinge, v->nhinge, most);
            most = of_requirements(c->requirement, v->nrequirement, most);
        }
        for (int k = 0; k < v->nreason; k++)
            if (v->reason[k].decision != FW_ACCEPT && measured(&v->reason[k]))
                most = fmax(most, fmin(1 / v->reason[k].keep, 10));
    }
    return fw_study_used(most, decision);
}

double fw_study_used(double most, int decision) {
    return decision == 0 ? fmin(most, 1) : fmax(most, fw_study_beyond);
}

/* ---- what is better ---- */

bool fw_study_search_better(double fa, double ca, double fb, double cb) {
    if (isnan(ca)) return false;
    if (isnan(cb)) return true;
    if (ca <= 0 && cb <= 0) return fa < fb;
    return ca <= 0 || (cb > 0 && ca < cb);
}

double fw_study_tried_worst(const fw_study_tried *t, int m) {
    double most = isnan(t->f) ? (double)NAN : -HUGE_VAL;
    for (int k = 0; k < m; k++)
        most = isnan(t->c[k]) || isnan(most) ? (double)NAN : fmax(most, t->c[k]);
    return most;
}

/* ---- numbers for response surfaces ----
   Numbers that response surfaces may be laid through (study_fitted.c): of a device as drawn both ends of the band of every
   hinge and requirement, look by look; of a die what each check uses. Test: tests/cli/test_fitted.py, test_dies.py */

static int part_count(const fw_verdict *verdict) {
    int n = verdict->nhinge;
    for (int i = 0; i < verdict->nvariant; i++)
        n += verdict->variant[i].nrequirement;
    return n;
}

/* hinges and requirements of all flows */
static int count_uses(const fw_verdict *verdict) {
    int n = 0;
    for (int i = 0; i < verdict->nvariant; i++)
        n += verdict->variant[i].nhinge + verdict->variant[i].nrequirement;
    return n;
}

void fw_study_parts_of(const fw_plan *plan, fw_study *study) {
    const fw_verdict *verdict = &plan->verdict;
    if (study->asked->kind == FW_STUDY_IS_size) study->nuse = count_uses(verdict);
    if (!(study->asked->fitted > 0)) return;
    study->npart = part_count(verdict), study->nhinge = verdict->nhinge;
    if (study->asked->judge != FW_JUDGE_DIE) return;
    study->npart = fw_verdict_checks(plan->device, &verdict->variant[0]);
    study->neach = plan->device->nscene + 1;
    study->nhinge = verdict->variant[0].nhinge * study->neach;
}

static void take_part(double low, double high, double value, double **part) {
    *(*part)++ = isnan(low) ? 0 : low;
    *(*part)++ = isnan(high) ? 0 : high;
    *(*part)++ = isnan(value) ? 0 : value;
}

void fw_study_parts_take(const fw_study *study, const fw_verdict *verdict,
                         fw_study_sample *sample) {
    sample->nlook = part_count(verdict) == study->npart ? verdict->ncomputed : 0;
    for (int l = 0; l < sample->nlook; l++) {
        const fw_verdict_computed *look = &verdict->computed[l];
        double *part = sample->part + FW_PART_NUMBERS * study->npart * (int)look->refinement;
        sample->looks[l] = (int)look->refinement;
        for (int i = 0; i < verdict->nhinge; i++) {
            const fw_verdict_hinge_verdict *h = &look->hinge[i];
            take_part(h->utilisation_low, h->utilisation_high, h->utilisation, &part);
        }
        for (int i = 0; i < verdict->nvariant; i++)
            for (int k = 0; look->requirement[i] && k < verdict->variant[i].nrequirement; k++) {
                const fw_verdict_requirement *r = &look->requirement[i][k];
                take_part(r->utilisation_low, r->utilisation_high, r->utilisation, &part);
            }
    }
}

/* ---- what each hinge uses ----
   A size looks for the least of the largest of many numbers, or holds it below a limit, and such a number has edges where another
   hinge becomes the one that uses most. What each uses by itself has none. Test: test_descent.c, test_sizing.py, AsMade */

bool fw_study_response_is_largest(const fw_study_response *response) {
    return fw_study_documents[response->document].document == FW_DOCUMENT_VERDICT_JSON &&
           strcmp(response->path, "governing.utilisation") == 0;
}

static void raise_use(double *use, double value, double high) {
    use[FW_USE_VALUE] = fmax(use[FW_USE_VALUE], value); /* NaN is passed */
    use[FW_USE_HIGH] = fmax(use[FW_USE_HIGH], high);
}

static void raise_uses(const fw_verdict_hinge_verdict *hinge, int n, double *use) {
    for (int k = 0; hinge && k < n; k++)
        if (hinge[k].scene)
            raise_use(use + FW_USE_NUMBERS * k, hinge[k].utilisation, hinge[k].utilisation_high);
}

static void raise_required(const fw_verdict_requirement *r, int n, double *use) {
    for (int k = 0; r && k < n; k++)
        raise_use(use + FW_USE_NUMBERS * k, r[k].utilisation, r[k].utilisation_high);
}

void fw_study_uses_take(const fw_study *study, const fw_verdict *verdict, fw_study_sample *sample) {
    double *use = sample->use;
    if (count_uses(verdict) != study->nuse) return; /* a device of other hinges */
    memset(use, 0, FW_USE_NUMBERS * (size_t)study->nuse * sizeof *use);
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        double *required = use + FW_USE_NUMBERS * v->nhinge;
        raise_uses(v->hinge, v->nhinge, use);
        raise_required(v->requirement, v->nrequirement, required);
        for (int c = 0; v->fabricated && c < v->fabricated->ncorner; c++) {
            const fw_verdict_fabricated_corner *corner = &v->fabricated->corner[c];
            raise_uses(corner->hinge, v->nhinge, use);
            raise_required(corner->requirement, v->nrequirement, required);
        }
        use = required + FW_USE_NUMBERS * v->nrequirement;
    }
}

/* ---- corners that a size watches ----
   Devices as made cost several times what those as drawn do, for their corners, and of all that a size tries few are the best.
   Those are judged at all corners, and the others at the ones that governed before (at most two of each flow): what is
   not accepted there is not accepted, and what is and would not be better anyway is no answer. Whatever is
   found better, or turns out to be refused at another corner, adds its own. A number as made of a device judged so is one
   over fewer corners, that is, not more than the true one, so that goals and limits must be such that less is better. */

/* less of the governing utilisation is better, and of what says how devices are made nobody asks */
static bool is_watched(const fw_study_response *r) {
    static const char *const made[] = {"as_fabricated", "all_corners", "corners", "flows",
                                       "failure_probability"};
    for (size_t i = 0; i < sizeof made / sizeof made[0]; i++)
        if (strstr(r->path, made[i])) return false;
    return strncmp(r->path, "governing", strlen("governing")) != 0 ||
           (strcmp(r->path, "governing.utilisation") == 0 && isnan(r->min) &&
            r->asked->goal != FW_GOAL_MAXIMISE);
}

bool fw_study_may_watch(const fw_study *study) {
    const char *corners = study->options.design.corners;
    int goals = 0;
    if (corners && strcmp(corners, "none") == 0) return false;
    if (!study->asked || study->asked->kind != FW_STUDY_IS_size ||
        study->asked->judge != FW_JUDGE_MADE || study->asked->yield > 0)
        return false;
    for (int k = 0; k < study->nresponse; k++) {
        goals += study->response[k].asked->goal != FW_GOAL_NONE;
        if (!is_watched(&study->response[k])) return false;
    }
    return goals == 1;
}

static const char partly[] =
    "not the best: accepted at the corners that governed before, the others were not judged";

bool fw_study_asks_for_no_clearance(const fw_study *study) {
    for (int k = 0; k < study->nresponse; k++)
        if (!fw_study_response_of_hinges(&study->response[k])) return false;
    return true;
}

/* of a device that is looked at in few corners clearances are bounded, where no response is about them, and nobody asks for masks */
void fw_study_look(const fw_study *study, const fw_study_sample *sample, fw_plan_options *options) {
    const fw_study_watch *watch = sample->watch && sample->watch->n > 0 ? sample->watch : NULL;
    if (!study->watches) return;
    options->watched = watch ? watch->text : NULL, options->nwatched = watch ? watch->n : 0;
    options->verdict.corners = watch ? FW_CORNERS_SUSPECT : FW_CORNERS_AUTO;
    options->verdict.bounded = options->without_masks =
        watch && fw_study_asks_for_no_clearance(study);
}

void fw_study_say_corner(const fw_study *study, const fw_plan *plan, fw_study_sample *sample) {
    if (!study->watches) return;
    if (!sample->watch)
        fw_plan_corner_text(plan, sample->corner);
    else if (sample->decision == 0)
        snprintf(sample->why, FW_STUDY_WHY, "%s", partly);
}

bool fw_study_is_partly(const fw_study_sample *sample) {
    return sample->run && strcmp(sample->why, partly) == 0;
}

void fw_study_watch_add(fw_study_watch *watch, const char *corner) {
    int at = 0;
    if (!corner[0]) return;
    while (at < watch->n && strcmp(watch->text[at], corner) != 0)
        at++;
    if (at == watch->n && watch->n < FW_STUDY_WATCHED) watch->n++;
    if (at == FW_STUDY_WATCHED) at--; /* the one that governed longest ago goes */
    for (int i = at; i > 0; i--)
        memcpy(watch->text[i], watch->text[i - 1], FW_PLAN_CORNER);
    snprintf(watch->text[0], FW_PLAN_CORNER, "%s", corner);
}

/* ---- one die ---- */

/* every check is a number of one look; one that is not there uses nothing */
static void take_checks(const fw_study *study, const double *ln, fw_study_sample *sample) {
    for (int r = 0; r < study->npart; r++)
        for (int number = 0; number < FW_PART_NUMBERS; number++)
            sample->part[FW_PART_NUMBERS * r + number] = isnan(ln[r]) ? 0 : exp(ln[r]);
    sample->looks[0] = 0, sample->nlook = 1;
}

/* Hinges and requirements of the drawn device become those of the die, for documents; what was drawn stays where it is. A
   hinge uses what its worst check does: the one that governs by its band may use less. */
static fw_status put_in_place(fw_plan *plan, const fw_verdict_die *die) {
    fw_verdict *verdict = &plan->verdict;
    fw_verdict_variant_verdict *v = &verdict->variant[0];
    const size_t n = (size_t)v->nhinge, m = (size_t)verdict->nhinge;
    const int each = plan->device->nscene + 1;
    fw_verdict_hinge_verdict *hinge = fw_arena_array(plan->arena, fw_verdict_hinge_verdict, n),
                             *merged = fw_arena_array(plan->arena, fw_verdict_hinge_verdict, m);
    FW_NEED(hinge && merged ? hinge : NULL);
    memcpy(merged, verdict->hinge, m * sizeof *merged);
    for (int k = 0; k < v->nhinge; k++) {
        double most = -HUGE_VAL;
        for (int r = k * each; r < (k + 1) * each; r++)
            most = fmax(most, die->ln[r]); /* NaN is passed */
        hinge[k] = die->hinge[k];
        hinge[k].utilisation = exp(most);
        for (size_t i = 0; i < m; i++)
            if (merged[i].joint == hinge[k].joint) merged[i] = hinge[k];
    }
    v->hinge = hinge, verdict->hinge = merged;
    if (v->nrequirement > 0)
        FW_NEED(v->requirement =
                    fw_arena_grow(plan->arena, die->requirement, (size_t)v->nrequirement,
                                  (size_t)v->nrequirement, sizeof *v->requirement));
    return FW_OK;
}

static fw_status not_run(fw_study_sample *sample, const char *why) {
    snprintf(sample->why, FW_STUDY_WHY, "%s", why);
    return FW_OK;
}

static bool has_numbers(const fw_verdict_die *die, const fw_verdict_variant_verdict *v) {
    bool any = v->nhinge == 0;
    for (int k = 0; k < v->nhinge; k++)
        any = any || die->hinge[k].scene;
    return any && (v->nrequirement == 0 || die->requirement);
}

fw_status fw_study_die_take(const fw_study *study, fw_plan *plan, fw_study_sample *sample,
                            bool *numbers) {
    fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    const int first = study->nvary + study->nsetting;
    fw_verdict_die die;
    *numbers = false;
    if (plan->layout && plan->layout->nfault > 0) { /* whatever its motion does */
        sample->run = true, sample->decision = 1, sample->used = 0;
        return FW_OK;
    }
    if (v->ninput != study->ninput - first)
        return not_run(sample, "other quantities of its flow differ from die to die");
    FW_TRY(fw_verdict_die_at(plan->arena, plan->device, plan->layout, &plan->options.verdict, v,
                             sample->value + first, &die));
    if (isnan(die.made.ln))
        return not_run(sample, die.made.why ? die.made.why : "no check of it has a value");
    sample->run = true, sample->decision = die.made.ln > 0 ? 1 : 0;
    sample->used = exp(die.made.ln);
    *numbers = has_numbers(&die, v);
    if (!*numbers) return FW_OK;
    if (study->npart > 0 && study->npart == fw_verdict_checks(plan->device, v))
        take_checks(study, die.ln, sample);
    return put_in_place(plan, &die);
}
