/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tradeoff.json and tradeoff.csv: the same numbers. What is measured on this machine (times,
   counted instructions) stands in keys of its own. */
#include "base/json.h"
#include "study/problem.h"
#include <math.h>

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
    fw_json_text(json, "instructions_by", fw_study_count_by_text(p->by));
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

static void number(fw_text *out, double value) {
    fw_text_add(out, ",");
    if (isfinite(value)) fw_text_number(out, value, 17);
}

static void point_row(const fw_study_tradeoff_point *p, const char *kind, fw_text *out) {
    fw_text_printf(out, "%s,%s,%s", kind, p->method, p->integrator);
    number(out, p->rtol);
    fw_text_printf(out, ",%s", state_text[p->state]);
    bool done = p->state == FW_TRADEOFF_DONE;
    number(out, p->error);
    number(out, p->estimated);
    number(out, p->utilisation_error);
    if (done)
        fw_text_printf(out, ",%ld,%ld", p->steps, p->rhs);
    else
        fw_text_add(out, ",,");
    number(out, p->instructions);
    fw_text_printf(out, ",%s,%d", done ? fw_study_count_by_text(p->by) : "", p->front ? 1 : 0);
    bool told = p->time.pairs > 0 && p->time.told;
    number(out, told ? p->time.ratio : (double)NAN);
    number(out, told ? p->time.low : (double)NAN);
    number(out, told ? p->time.high : (double)NAN);
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
        number(out, m->change);
        number(out, m->bound);
        fw_text_add(out, ",,,");
        number(out, m->instructions);
        fw_text_add(out, ",,,,,\n");
    }
    for (int i = 0; i < t->nmask; i++) { /* tolerance, edge, vertices, bytes */
        const fw_study_tradeoff_mask *m = &t->mask[i];
        fw_text_add(out, "mask,,");
        number(out, m->tolerance_m);
        fw_text_add(out, ",done");
        number(out, m->deflection);
        number(out, m->edge_m);
        fw_text_printf(out, ",,%ld,%ld,,,,,,\n", m->vertices, m->bytes);
    }
    return fw_text_end(out);
}
