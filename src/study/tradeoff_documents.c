/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The documents of the comparison: what a person reads, and the same numbers as JSON and CSV. */
#include "base/json.h"
#include "study/tradeoff.h"
#include <math.h>
#include <string.h>

/* ---- the text: the answer first, then the front, then the model, then the masks ---- */

enum { ROWS = 12 };

static void number(fw_text *out, double x, const char *format, int width) {
    if (isfinite(x))
        fw_text_real(out, format, x);
    else
        fw_text_printf(out, "%*s", width, "-");
}

static void cost(fw_text *out, const fw_study_tradeoff_point *p) {
    number(out, p->instructions / 1e6, "%10.2f", 10);
    fw_text_add(out, p->by == FW_COUNT_CALLGRIND ? "  " : p->by == FW_COUNT_SCALED ? "~ " : "? ");
}

static void time_of(fw_text *out, const fw_study_tradeoff_time *x) {
    if (x->pairs == 0)
        fw_text_add(out, "          -");
    else if (!x->told)
        fw_text_add(out, " -- (noisy)");
    else
        fw_text_real(out, "%11.2f", x->ratio);
}

static const char *count_by_text(fw_study_count_by by) {
    static const char *const text[] = {"model", "scaled", "callgrind"};
    return text[by];
}

const char *fw_study_tradeoff_floor_text(const fw_study_tradeoff *t) {
    if (!t->floor_what) return "nothing";
    if (strcmp(t->floor_what, "solid") == 0) return "what the verdict allows its model of hinges";
    if (strcmp(t->floor_what, "hinge") == 0) return "what a better model of the hinges changes";
    return "what the effects that were left out change";
}

static void row(const fw_study_tradeoff_point *p, const char *mark, fw_text *out) {
    fw_text_printf(out, "%s%-24s%-18s", mark, p->method, p->integrator);
    number(out, p->rtol, "%6.0e", 6);
    fw_text_add(out, p->floor ? "  <" : "   ");
    number(out, p->error, "%8.1e", 8);
    number(out, p->estimated, "%10.1e", 10);
    number(out, p->utilisation_error, "%10.1e", 10);
    cost(out, p);
    time_of(out, &p->time);
    fw_text_add(out, "\n");
}

static void answer(const fw_study_tradeoff *t, fw_text *out) {
    const fw_study_tradeoff_point *c = &t->point[0];
    fw_text_printf(out, "%s, %s%s%s%s: simulate takes %s + %s by itself", t->device,
                   FW_NAMED("scene", fw_text_name(t->scene->name)), t->flow ? ", flow " : "",
                   t->flow ? t->flow : "", c->method, c->integrator);
    fw_text_add(out, "; peak deflection off by ");
    number(out, c->error, "%.1e", 1);
    fw_text_add(out, " where ");
    number(out, t->accuracy, "%.0e", 1);
    fw_text_add(out, " is wanted");
    if (isfinite(t->chosen_cpu_s)) {
        fw_text_add(out, ", in ");
        fw_text_real(out, "%.3g", 1e3 * t->chosen_cpu_s);
        fw_text_add(out, " ms of CPU");
    }
    fw_text_add(out, "\n");
    if (t->level_why)
        fw_text_printf(out, "hinges as %s in all settings: %s\n", t->level, t->level_why);
    if (isfinite(t->digit_here)) {
        fw_text_add(out, "one more digit costs x");
        fw_text_real(out, "%.2f", t->digit_here);
        if (isfinite(t->digit_overall)) {
            fw_text_add(out, " here, x");
            fw_text_real(out, "%.2f", t->digit_overall);
            fw_text_add(out, " on average over the front");
        }
        fw_text_add(out, "\n");
    }
    if (isfinite(t->over_cheapest)) {
        const fw_study_tradeoff_point *best = &t->point[t->cheapest];
        fw_text_add(out, "it costs x");
        fw_text_real(out, "%.2f", t->over_cheapest);
        fw_text_printf(out, " the cheapest that would have done: %s + %s at ", best->method,
                       best->integrator);
        number(out, best->rtol, "%.0e", 1);
        fw_text_add(out, "\n");
    }
    if (isfinite(t->floor)) {
        fw_text_add(out, "digits below ");
        number(out, t->floor, "%.1e", 1);
        fw_text_printf(out, " are meaningless: %s is as large\n", fw_study_tradeoff_floor_text(t));
    }
}

static void reference(const fw_study_tradeoff *t, fw_text *out) {
    const fw_study_tradeoff_reference *r = &t->reference;
    if (!r->run[0]) {
        fw_text_add(out, "no reference: no tighter run ended within its share of the budget\n");
        return;
    }
    fw_text_printf(out, "\nreference: %s + %s at ", r->run[0]->method, r->run[0]->integrator);
    number(out, r->run[0]->rtol, "%.0e", 1);
    if (r->run[1]) {
        fw_text_printf(out, ", against %s + %s at ", r->run[1]->method, r->run[1]->integrator);
        number(out, r->run[1]->rtol, "%.0e", 1);
        fw_text_add(out, ": they differ by ");
        number(out, r->error, "%.1e", 1);
        if (!r->independent) fw_text_add(out, " (not independent)");
    }
    fw_text_add(out, "\n");
}

static void settings(const fw_study_tradeoff *t, fw_text *out) {
    int order[ROWS], n = 0;
    for (int i = 0; i < t->npoint; i++) { /* the front by cost */
        if (!t->point[i].front && i != 0) continue;
        int at = n < ROWS ? n++ : ROWS;
        for (; at > 0 && t->point[order[at - 1]].instructions > t->point[i].instructions; at--)
            if (at < ROWS) order[at] = order[at - 1];
        if (at < ROWS) order[at] = i;
    }
    fw_text_printf(out, "\n  %-24s%-18s%6s%11s%10s%10s%10s%13s\n", "method", "integrator", "rtol",
                   "error", "estimated", "utilis.", "M instr.", "time, ratio");
    for (int i = 0; i < n; i++)
        row(&t->point[order[i]], order[i] == 0 ? "* " : "  ", out);
    fw_text_add(out,
                "* by itself; all others: nothing is both cheaper and better. Instructions: "
                "counted, ~ scaled from a counted\n  tolerance, ? by the model of costs. < the "
                "reference is not known better\n");
}

/* the cheapest setting of every method and of every integrator that is good enough */
static void curves(const fw_study_tradeoff *t, fw_text *out) {
    if (t->quasi_static_only) {
        fw_text_add(out,
                    "\nintegrators are not compared: with inertia none ends within its share of "
                    "the budget\n");
        return;
    }
    fw_text_add(out, "\ncheapest within the accuracy\n");
    for (int i = 0; i < t->ncurve; i++) {
        const fw_study_tradeoff_curve *c = &t->curve[i];
        const fw_study_tradeoff_point *best = NULL, *point = &t->point[c->first];
        if (!c->as_method && !c->as_integrator) continue;
        for (int k = 0; k < c->count; k++)
            if (fw_study_tradeoff_good(t, &point[k]) &&
                (!best || point[k].instructions < best->instructions))
                best = &point[k];
        if (best) {
            row(best, "  ", out);
            continue;
        }
        const char *why = point[0].state == FW_TRADEOFF_DONE ? "none reaches it" : point[0].why;
        fw_text_printf(out, "  %-24s%-18s%s\n", c->method, c->integrator, why ? why : "-");
    }
}

static void honesty(const fw_study_tradeoff *t, fw_text *out) {
    if (t->judged == 0) return;
    fw_text_printf(out, "\nestimated errors: not below the true one in %d of %d settings; ",
                   t->honest, t->judged);
    number(out, t->honesty[0], "%.2g", 1);
    fw_text_add(out, " to ");
    number(out, t->honesty[2], "%.2g", 1);
    fw_text_add(out, " times it, median ");
    number(out, t->honesty[1], "%.2g", 1);
    const fw_study_tradeoff_point *p = &t->point[t->least_honest];
    fw_text_printf(out, "; least of %s + %s at ", p->method, p->integrator);
    number(out, p->rtol, "%.0e", 1);
    fw_text_add(out, "\n");
}

static void models(const fw_study_tradeoff *t, fw_text *out) {
    fw_text_printf(out, "\n  %-10s%-28s%10s%10s%14s\n", "model", "", "changes", "bound",
                   "M instr.");
    for (int i = 0; i < t->nmodel; i++) {
        const fw_study_tradeoff_model *m = &t->model[i];
        fw_text_printf(out, "%s%-10s%-28s", m->chosen ? "* " : "  ", m->kind, m->name);
        if (m->state != FW_TRADEOFF_DONE) {
            fw_text_printf(out, "  - %s\n", m->why ? m->why : "could not be run");
            continue;
        }
        number(out, m->change, "%10.1e", 10);
        number(out, m->bound, "%10.1e", 10);
        number(out, m->instructions / 1e6, "%14.2f", 14);
        fw_text_add(out, "\n");
    }
}

static void masks(const fw_study_tradeoff *t, fw_text *out) {
    if (t->mask_why) {
        fw_text_printf(out, "\nno mask: %s\n", t->mask_why);
        return;
    }
    fw_text_printf(out, "\n  %-12s%10s%12s%14s\n", "mask, nm", "vertices", "GDSII bytes",
                   "deflection");
    for (int i = 0; i < t->nmask; i++) {
        const fw_study_tradeoff_mask *m = &t->mask[i];
        fw_text_add(out, m->usual ? "* " : "  ");
        fw_text_real(out, "%-12.4g", 1e9 * m->tolerance_m);
        fw_text_printf(out, "%10ld%12ld", m->vertices, m->bytes);
        fw_text_add(out, "   <");
        number(out, m->deflection, "%10.1e", 10);
        fw_text_add(out, "\n");
    }
}

fw_status fw_study_tradeoff_text(const fw_study_tradeoff *t, fw_text *out) {
    answer(t, out);
    reference(t, out);
    settings(t, out);
    curves(t, out);
    honesty(t, out);
    models(t, out);
    masks(t, out);
    return fw_text_end(out);
}

/* ---- JSON ----
   What is measured on this machine (times, counted instructions) stands in keys of its own. */

static const char *const state_text[] = {"done", "skipped", "failed"};

static void time_json(fw_json *json, const fw_study_tradeoff_time *x) {
    if (x->pairs == 0) {
        fw_json_null(json, "time");
        return;
    }
    fw_json_object(json, "time");
    fw_json_truth(json, "told", x->told);
    fw_json_real(json, "ratio", x->told ? x->ratio : (double)NAN);
    fw_json_real(json, "low", x->told ? x->low : (double)NAN);
    fw_json_real(json, "high", x->told ? x->high : (double)NAN);
    fw_json_whole(json, "pairs", x->pairs);
    fw_json_end(json);
}

/* members of the object about one point */
static void point_json(fw_json *json, const fw_study_tradeoff_point *p) {
    fw_json_text(json, "method", p->method);
    fw_json_text(json, "integrator", p->integrator);
    fw_json_real(json, "rtol", p->rtol);
    fw_json_text(json, "state", state_text[p->state]);
    if (p->state != FW_TRADEOFF_DONE) {
        fw_json_text(json, "why", p->why);
        return;
    }
    fw_json_real(json, "error", p->error);
    fw_json_truth(json, "at_most", p->floor);
    fw_json_real(json, "estimated", p->estimated);
    fw_json_real(json, "utilisation", p->utilisation);
    fw_json_real(json, "utilisation_error", p->utilisation_error);
    fw_json_whole(json, "steps", p->steps);
    fw_json_whole(json, "rejected", p->rejected);
    fw_json_whole(json, "rhs", p->rhs);
    fw_json_whole(json, "jacobians", p->jacobians);
    fw_json_whole(json, "factorisations", p->factorisations);
    fw_json_real(json, "instructions", p->instructions);
    fw_json_text(json, "instructions_by", count_by_text(p->by));
    fw_json_truth(json, "front", p->front);
    time_json(json, &p->time);
}

static void reference_json(fw_json *json, const fw_study_tradeoff *t) {
    const fw_study_tradeoff_reference *r = &t->reference;
    fw_json_object(json, "reference");
    fw_json_list(json, "runs");
    for (int i = 0; i < 2 && r->run[i]; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "method", r->run[i]->method);
        fw_json_text(json, "integrator", r->run[i]->integrator);
        fw_json_real(json, "rtol", r->run[i]->rtol);
        fw_json_real(json, "estimated", r->run[i]->estimated);
        fw_json_real(json, "utilisation", r->run[i]->utilisation);
        fw_json_list(json, "peaks_rad");
        for (int k = 0; k < t->mechanism->npin; k++)
            fw_json_real(json, NULL, r->run[i]->peak_rad[k]);
        fw_json_end(json);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_real(json, "error", r->error);
    fw_json_real(json, "utilisation_error", r->utilisation_error);
    fw_json_truth(json, "independent", r->independent);
    fw_json_end(json);
}

static void curves_json(fw_json *json, const fw_study_tradeoff *t) {
    fw_json_list(json, "curves");
    for (int i = 0; i < t->ncurve; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "method", t->curve[i].method);
        fw_json_text(json, "integrator", t->curve[i].integrator);
        fw_json_real(json, "order_seen", t->curve[i].order);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void models_json(fw_json *json, const fw_study_tradeoff *t) {
    fw_json_list(json, "models");
    for (int i = 0; i < t->nmodel; i++) {
        const fw_study_tradeoff_model *m = &t->model[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "kind", m->kind);
        fw_json_text(json, "name", m->name);
        fw_json_truth(json, "chosen", m->chosen);
        fw_json_text(json, "state", state_text[m->state]);
        fw_json_text(json, "why", m->state == FW_TRADEOFF_DONE ? NULL : m->why);
        fw_json_real(json, "change", m->change);
        fw_json_real(json, "bound", m->bound);
        fw_json_real(json, "utilisation", m->utilisation);
        fw_json_real(json, "instructions", m->instructions);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void masks_json(fw_json *json, const fw_study_tradeoff *t) {
    fw_json_list(json, "masks");
    for (int i = 0; i < t->nmask; i++) {
        const fw_study_tradeoff_mask *m = &t->mask[i];
        fw_json_object(json, NULL);
        fw_json_real(json, "tolerance_m", m->tolerance_m);
        fw_json_real(json, "edge_m", m->edge_m);
        fw_json_whole(json, "vertices", m->vertices);
        fw_json_whole(json, "bytes", m->bytes);
        fw_json_real(json, "deflection_bound", m->deflection);
        fw_json_truth(json, "usual", m->usual);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void chosen_json(fw_json *json, const fw_study_tradeoff *t) {
    fw_json_object(json, "chosen");
    point_json(json, &t->point[0]);
    fw_json_text(json, "reason", t->chosen_why);
    fw_json_truth(json, "quasi_static", t->quasi_static);
    fw_json_truth(json, "equilibria_only", t->quasi_static_only);
    fw_json_real(json, "over_cheapest", t->over_cheapest);
    if (t->cheapest >= 0) {
        fw_json_object(json, "cheapest");
        point_json(json, &t->point[t->cheapest]);
        fw_json_end(json);
    } else
        fw_json_null(json, "cheapest");
    fw_json_real(json, "cpu_s", t->chosen_cpu_s);
    fw_json_real(json, "cpu_low_s", t->chosen_cpu_low_s);
    fw_json_real(json, "cpu_high_s", t->chosen_cpu_high_s);
    fw_json_end(json);
}

static void summary_json(fw_json *json, const fw_study_tradeoff *t) {
    fw_json_object(json, "summary");
    fw_json_real(json, "digit_here", t->digit_here);
    fw_json_real(json, "digit_overall", t->digit_overall);
    fw_json_real(json, "floor", t->floor);
    fw_json_text(json, "floor_what", t->floor_what);
    fw_json_object(json, "honesty");
    fw_json_whole(json, "judged", t->judged);
    fw_json_whole(json, "not_below", t->honest);
    fw_json_real(json, "least", t->honesty[0]);
    fw_json_real(json, "median", t->honesty[1]);
    fw_json_real(json, "largest", t->honesty[2]);
    fw_json_end(json);
    fw_json_end(json);
}

fw_status fw_study_tradeoff_json(const fw_study_tradeoff *t, fw_text *out) {
    fw_json document = fw_json_new(out, FW_JSON_INDENTED), *json = &document;
    fw_json_object(json, NULL);
    fw_json_text(json, "schema", "flexwright.tradeoff/1");
    fw_json_text(json, "device", t->device);
    fw_json_text(json, "flow", t->flow);
    fw_json_text(json, "scene", t->scene->name);
    fw_json_real(json, "accuracy_wanted", t->accuracy);
    fw_json_text(json, "hinges_as", t->level);
    fw_json_text(json, "hinges_why", t->level_why);
    fw_json_real(json, "budget_s", t->budget_s);
    reference_json(json, t);
    chosen_json(json, t);
    summary_json(json, t);
    fw_json_list(json, "points");
    for (int i = 1; i < t->npoint; i++) {
        fw_json_object(json, NULL);
        point_json(json, &t->point[i]);
        fw_json_end(json);
    }
    fw_json_end(json);
    curves_json(json, t);
    models_json(json, t);
    masks_json(json, t);
    fw_json_text(json, "masks_why", t->mask_why);
    fw_json_text(json, "instructions_why", t->instructions_why);
    fw_json_text(json, "times_why", t->times_why);
    fw_json_end(json);
    return fw_json_finish(json, "\n");
}

/* ---- CSV ---- */

static void cell(fw_text *out, double value) {
    fw_text_add(out, ",");
    if (isfinite(value)) fw_text_number(out, value, 17);
}

static void point_row(const fw_study_tradeoff_point *p, const char *kind, fw_text *out) {
    fw_text_printf(out, "%s,%s,%s", kind, p->method, p->integrator);
    cell(out, p->rtol);
    fw_text_printf(out, ",%s", state_text[p->state]);
    bool done = p->state == FW_TRADEOFF_DONE;
    cell(out, p->error);
    cell(out, p->estimated);
    cell(out, p->utilisation_error);
    if (done)
        fw_text_printf(out, ",%ld,%ld", p->steps, p->rhs);
    else
        fw_text_add(out, ",,");
    cell(out, p->instructions);
    fw_text_printf(out, ",%s,%d", done ? count_by_text(p->by) : "", p->front ? 1 : 0);
    bool told = p->time.pairs > 0 && p->time.told;
    cell(out, told ? p->time.ratio : (double)NAN);
    cell(out, told ? p->time.low : (double)NAN);
    cell(out, told ? p->time.high : (double)NAN);
    fw_text_add(out, "\n");
}

fw_status fw_study_tradeoff_csv(const fw_study_tradeoff *t, fw_text *out) {
    fw_text_add(out,
                "kind,method,integrator,rtol,state,error,estimated,utilisation_error,steps,rhs,"
                "instructions,instructions_by,front,time_ratio,time_low,time_high\n");
    for (int i = 0; i < t->npoint; i++)
        point_row(&t->point[i], i ? "setting" : "chosen", out);
    for (int i = 0; i < t->nmodel; i++) {
        const fw_study_tradeoff_model *m = &t->model[i];
        fw_text_printf(out, "%s,%s,,,%s", m->kind, m->name, state_text[m->state]);
        cell(out, m->change);
        cell(out, m->bound);
        fw_text_add(out, ",,,");
        cell(out, m->instructions);
        fw_text_add(out, ",,,,,\n");
    }
    for (int i = 0; i < t->nmask; i++) { /* tolerance, edge, vertices, bytes */
        const fw_study_tradeoff_mask *m = &t->mask[i];
        fw_text_add(out, "mask,,");
        cell(out, m->tolerance_m);
        fw_text_add(out, ",done");
        cell(out, m->deflection);
        cell(out, m->edge_m);
        fw_text_printf(out, ",,%ld,%ld,,,,,,\n", m->vertices, m->bytes);
    }
    return fw_text_end(out);
}
