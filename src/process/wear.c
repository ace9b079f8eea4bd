/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/wear.h"
#include <math.h>
#include <string.h>

bool fw_process_step_is_wet(const fw_process_step *s) {
    static const char *const wet[] = {"wet-etch", "strip", "release", "clean", "develop"};
    for (size_t i = 0; i < sizeof wet / sizeof *wet; i++)
        if (strcmp(s->op, wet[i]) == 0) return true;
    return false;
}

static const fw_quantity *argument(const fw_process_step *s, const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(s->argument[i].name, name) == 0) return s->argument[i].q;
    return NULL;
}

static double relative(const fw_quantity *q) {
    return q->value != 0.0 ? q->uncertainty / fabs(q->value) : 0.0;
}

static const char *unknown_of(const fw_quantity *q) {
    return q && !q->unknown ? NULL : q && q->id ? q->id : "an input of its time";
}

/* l = r T (1 + overrun) with T = d/R of the law `rate`, or the time of the law `const`. r the rate
   at which the device is taken, R that of what the step is for: where both are the same quantity it
   cancels, and so does its error. In: one step. Out: l and its standard uncertainty, m; the id of
   what is not known, or NULL. Other laws say nothing here. */
static const char *loss_of(const fw_process_step *s, const fw_quantity *r, double *loss_m,
                           double *u_m) {
    bool rate = s->law && strcmp(s->law, "rate") == 0,
         fixed = s->law && strcmp(s->law, "const") == 0;
    const fw_quantity *length = argument(s, rate ? "thickness" : "time"), *R = argument(s, "rate");
    double share = 0.0;
    if (!rate && !fixed) return "the time of its law";
    if (unknown_of(length)) return unknown_of(length);
    *loss_m = length->value * (1.0 + s->overrun);
    share = relative(length);
    if (!rate || r != R) { /* over R, and times r */
        if (unknown_of(r)) return unknown_of(r);
        if (rate && unknown_of(R)) return unknown_of(R);
        *loss_m *= rate ? r->value / R->value : r->value;
        share = hypot(share, hypot(relative(r), rate ? relative(R) : 0.0));
    }
    *u_m = share * *loss_m;
    return NULL;
}

/* Sum over the steps that say <exposed> of the device's own material with a rate, losses added,
   uncertainties in quadrature. Source: docs/theory/process.md, "What a step takes along".
   Test: test_wear.c. */
fw_process_wear fw_process_flow_wear(const fw_process_flow *flow) {
    fw_process_wear w = {0};
    for (int i = 0; flow->material && i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nexposed && fw_process_step_is_wet(s); k++) {
            const fw_process_exposed *x = &s->exposed[k];
            double loss = 0.0, u = 0.0;
            if (strcmp(x->material, flow->material) != 0 || !x->rate) continue;
            if (!w.step) {
                w.step = s;
                w.exposed = x;
            }
            const char *missing = loss_of(s, x->rate, &loss, &u);
            if (missing) {
                if (!w.missing) w.missing = missing;
                continue;
            }
            w.loss_m += loss;
            w.uncertainty_m = hypot(w.uncertainty_m, u);
        }
    }
    return w;
}
