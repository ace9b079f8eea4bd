/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person reads: the answer first, then the front, then the model, then the masks. */
#include "study/problem.h"
#include <math.h>
#include <string.h>

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

const char *fw_study_count_by_text(fw_study_count_by by) {
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
    fw_text_printf(out, "%s, scene %s%s%s: simulate takes %s + %s by itself", t->device,
                   t->scene->name ? t->scene->name : "(unnamed)", t->flow ? ", flow " : "",
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
