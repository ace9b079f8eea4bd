/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tradeoff.json and tradeoff.csv: the same numbers. What is measured on this machine (times,
   counted instructions) stands in keys of its own. */
#include "report/json_common.h"
#include "study/problem.h"
#include <math.h>

static const char *const state_text[] = {"done", "skipped", "failed"};

static json_t *time_json(const fw_tradeoff_time *x, bool *failed) {
    if (x->pairs == 0) return json_null();
    json_t *o = json_object();
    fw_json_put(o, "told", json_boolean(x->told), failed);
    fw_json_put(o, "ratio", fw_json_real(x->told ? x->ratio : (double)NAN), failed);
    fw_json_put(o, "low", fw_json_real(x->told ? x->low : (double)NAN), failed);
    fw_json_put(o, "high", fw_json_real(x->told ? x->high : (double)NAN), failed);
    fw_json_put(o, "pairs", json_integer(x->pairs), failed);
    return o;
}

static json_t *point_json(const fw_tradeoff_point *p, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, "method", fw_json_text(p->method), failed);
    fw_json_put(o, "integrator", fw_json_text(p->integrator), failed);
    fw_json_put(o, "rtol", fw_json_real(p->rtol), failed);
    fw_json_put(o, "state", json_string(state_text[p->state]), failed);
    if (p->state != FW_TRADEOFF_DONE) {
        fw_json_put(o, "why", fw_json_text(p->why), failed);
        return o;
    }
    fw_json_put(o, "error", fw_json_real(p->error), failed);
    fw_json_put(o, "at_most", json_boolean(p->floor), failed);
    fw_json_put(o, "estimated", fw_json_real(p->estimated), failed);
    fw_json_put(o, "utilisation", fw_json_real(p->utilisation), failed);
    fw_json_put(o, "utilisation_error", fw_json_real(p->utilisation_error), failed);
    fw_json_put(o, "steps", json_integer(p->steps), failed);
    fw_json_put(o, "rejected", json_integer(p->rejected), failed);
    fw_json_put(o, "rhs", json_integer(p->rhs), failed);
    fw_json_put(o, "jacobians", json_integer(p->jacobians), failed);
    fw_json_put(o, "factorisations", json_integer(p->factorisations), failed);
    fw_json_put(o, "instructions", fw_json_real(p->instructions), failed);
    fw_json_put(o, "instructions_by", json_string(fw_count_by_text(p->by)), failed);
    fw_json_put(o, "front", json_boolean(p->front), failed);
    fw_json_put(o, "time", time_json(&p->time, failed), failed);
    return o;
}

static json_t *reference_json(const fw_tradeoff *t, bool *failed) {
    const fw_tradeoff_reference *r = &t->reference;
    json_t *o = json_object(), *runs = json_array();
    for (int i = 0; i < 2 && r->run[i]; i++) {
        json_t *run = json_object(), *peaks = json_array();
        fw_json_put(run, "method", fw_json_text(r->run[i]->method), failed);
        fw_json_put(run, "integrator", fw_json_text(r->run[i]->integrator), failed);
        fw_json_put(run, "rtol", fw_json_real(r->run[i]->rtol), failed);
        fw_json_put(run, "estimated", fw_json_real(r->run[i]->estimated), failed);
        fw_json_put(run, "utilisation", fw_json_real(r->run[i]->utilisation), failed);
        for (int k = 0; k < t->mechanism->npin; k++)
            fw_json_push(peaks, fw_json_real(r->run[i]->peak_rad[k]), failed);
        fw_json_put(run, "peaks_rad", peaks, failed);
        fw_json_push(runs, run, failed);
    }
    fw_json_put(o, "runs", runs, failed);
    fw_json_put(o, "error", fw_json_real(r->error), failed);
    fw_json_put(o, "utilisation_error", fw_json_real(r->utilisation_error), failed);
    fw_json_put(o, "independent", json_boolean(r->independent), failed);
    return o;
}

static json_t *curves_json(const fw_tradeoff *t, bool *failed) {
    json_t *all = json_array();
    for (int i = 0; i < t->ncurve; i++) {
        json_t *o = json_object();
        fw_json_put(o, "method", fw_json_text(t->curve[i].method), failed);
        fw_json_put(o, "integrator", fw_json_text(t->curve[i].integrator), failed);
        fw_json_put(o, "order_seen", fw_json_real(t->curve[i].order), failed);
        fw_json_push(all, o, failed);
    }
    return all;
}

static json_t *models_json(const fw_tradeoff *t, bool *failed) {
    json_t *all = json_array();
    for (int i = 0; i < t->nmodel; i++) {
        const fw_tradeoff_model *m = &t->model[i];
        json_t *o = json_object();
        fw_json_put(o, "kind", json_string(m->kind), failed);
        fw_json_put(o, "name", fw_json_text(m->name), failed);
        fw_json_put(o, "chosen", json_boolean(m->chosen), failed);
        fw_json_put(o, "state", json_string(state_text[m->state]), failed);
        fw_json_put(o, "why", fw_json_text(m->state == FW_TRADEOFF_DONE ? NULL : m->why), failed);
        fw_json_put(o, "change", fw_json_real(m->change), failed);
        fw_json_put(o, "bound", fw_json_real(m->bound), failed);
        fw_json_put(o, "utilisation", fw_json_real(m->utilisation), failed);
        fw_json_put(o, "instructions", fw_json_real(m->instructions), failed);
        fw_json_push(all, o, failed);
    }
    return all;
}

static json_t *masks_json(const fw_tradeoff *t, bool *failed) {
    json_t *all = json_array();
    for (int i = 0; i < t->nmask; i++) {
        const fw_tradeoff_mask *m = &t->mask[i];
        json_t *o = json_object();
        fw_json_put(o, "tolerance_m", fw_json_real(m->tolerance_m), failed);
        fw_json_put(o, "edge_m", fw_json_real(m->edge_m), failed);
        fw_json_put(o, "vertices", json_integer(m->vertices), failed);
        fw_json_put(o, "bytes", json_integer(m->bytes), failed);
        fw_json_put(o, "deflection_bound", fw_json_real(m->deflection), failed);
        fw_json_put(o, "usual", json_boolean(m->usual), failed);
        fw_json_push(all, o, failed);
    }
    return all;
}

static json_t *chosen_json(const fw_tradeoff *t, bool *failed) {
    json_t *o = point_json(&t->point[0], failed);
    fw_json_put(o, "reason", fw_json_text(t->chosen_why), failed);
    fw_json_put(o, "quasi_static", json_boolean(t->row), failed);
    fw_json_put(o, "equilibria_only", json_boolean(t->rows_only), failed);
    fw_json_put(o, "over_cheapest", fw_json_real(t->over_cheapest), failed);
    json_t *cheapest = json_null();
    if (t->cheapest >= 0) cheapest = point_json(&t->point[t->cheapest], failed);
    fw_json_put(o, "cheapest", cheapest, failed);
    fw_json_put(o, "cpu_s", fw_json_real(t->chosen_cpu_s), failed);
    fw_json_put(o, "cpu_low_s", fw_json_real(t->chosen_cpu_low_s), failed);
    fw_json_put(o, "cpu_high_s", fw_json_real(t->chosen_cpu_high_s), failed);
    return o;
}

static json_t *summary_json(const fw_tradeoff *t, bool *failed) {
    json_t *o = json_object(), *honesty = json_object();
    fw_json_put(o, "digit_here", fw_json_real(t->digit_here), failed);
    fw_json_put(o, "digit_overall", fw_json_real(t->digit_overall), failed);
    fw_json_put(o, "floor", fw_json_real(t->floor), failed);
    fw_json_put(o, "floor_what", fw_json_text(t->floor_what), failed);
    fw_json_put(honesty, "judged", json_integer(t->judged), failed);
    fw_json_put(honesty, "not_below", json_integer(t->honest), failed);
    fw_json_put(honesty, "least", fw_json_real(t->honesty[0]), failed);
    fw_json_put(honesty, "median", fw_json_real(t->honesty[1]), failed);
    fw_json_put(honesty, "largest", fw_json_real(t->honesty[2]), failed);
    fw_json_put(o, "honesty", honesty, failed);
    return o;
}

fw_status fw_tradeoff_json(const fw_tradeoff *t, fw_text *out) {
    bool failed = false;
    json_t *root = json_object(), *points = json_array();
    fw_json_put(root, "schema", json_string("flexwright.tradeoff/1"), &failed);
    fw_json_put(root, "device", fw_json_text(t->device), &failed);
    fw_json_put(root, "flow", fw_json_text(t->flow), &failed);
    fw_json_put(root, "scene", fw_json_text(t->scene->name), &failed);
    fw_json_put(root, "accuracy_wanted", fw_json_real(t->accuracy), &failed);
    fw_json_put(root, "hinges_as", fw_json_text(t->level), &failed);
    fw_json_put(root, "hinges_why", fw_json_text(t->level_why), &failed);
    fw_json_put(root, "budget_s", fw_json_real(t->budget_s), &failed);
    fw_json_put(root, "reference", reference_json(t, &failed), &failed);
    fw_json_put(root, "chosen", chosen_json(t, &failed), &failed);
    fw_json_put(root, "summary", summary_json(t, &failed), &failed);
    for (int i = 1; i < t->npoint; i++)
        fw_json_push(points, point_json(&t->point[i], &failed), &failed);
    fw_json_put(root, "points", points, &failed);
    fw_json_put(root, "curves", curves_json(t, &failed), &failed);
    fw_json_put(root, "models", models_json(t, &failed), &failed);
    fw_json_put(root, "masks", masks_json(t, &failed), &failed);
    fw_json_put(root, "masks_why", fw_json_text(t->mask_why), &failed);
    fw_json_put(root, "instructions_why", fw_json_text(t->instructions_why), &failed);
    fw_json_put(root, "times_why", fw_json_text(t->times_why), &failed);
    return fw_json_write(root, failed, out);
}

/* ---- CSV ---- */

static void number(fw_text *out, double value) {
    fw_text_add(out, ",");
    if (isfinite(value)) fw_text_number(out, value, 17);
}

static void point_row(const fw_tradeoff_point *p, const char *kind, fw_text *out) {
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
    fw_text_printf(out, ",%s,%d", done ? fw_count_by_text(p->by) : "", p->front ? 1 : 0);
    bool told = p->time.pairs > 0 && p->time.told;
    number(out, told ? p->time.ratio : (double)NAN);
    number(out, told ? p->time.low : (double)NAN);
    number(out, told ? p->time.high : (double)NAN);
    fw_text_add(out, "\n");
}

fw_status fw_tradeoff_csv(const fw_tradeoff *t, fw_text *out) {
    fw_text_add(out,
                "kind,method,integrator,rtol,state,error,estimated,utilisation_error,steps,rhs,"
                "instructions,instructions_by,front,time_ratio,time_low,time_high\n");
    for (int i = 0; i < t->npoint; i++)
        point_row(&t->point[i], i ? "setting" : "chosen", out);
    for (int i = 0; i < t->nmodel; i++) {
        const fw_tradeoff_model *m = &t->model[i];
        fw_text_printf(out, "%s,%s,,,%s", m->kind, m->name, state_text[m->state]);
        number(out, m->change);
        number(out, m->bound);
        fw_text_add(out, ",,,");
        number(out, m->instructions);
        fw_text_add(out, ",,,,,\n");
    }
    for (int i = 0; i < t->nmask; i++) { /* tolerance, edge, vertices, bytes */
        const fw_tradeoff_mask *m = &t->mask[i];
        fw_text_add(out, "mask,,");
        number(out, m->tolerance_m);
        fw_text_add(out, ",done");
        number(out, m->deflection);
        number(out, m->edge_m);
        fw_text_printf(out, ",,%ld,%ld,,,,,,\n", m->vertices, m->bytes);
    }
    return fw_text_end(out);
}
