/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/wear.h"
#include <math.h>
#include <string.h>

bool fw_step_is_wet(const fw_step *s) {
    static const char *const wet[] = {"wet-etch", "strip", "release", "clean", "develop"};
    for (size_t i = 0; i < sizeof wet / sizeof *wet; i++)
        if (strcmp(s->op, wet[i]) == 0) return true;
    return false;
}

static const fw_quantity *argument(const fw_step *s, const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(s->argument[i].name, name) == 0) return s->argument[i].q;
    return NULL;
}

static double relative(const fw_quantity *q) {
    return q->value != 0.0 ? q->uncertainty / fabs(q->value) : 0.0;
}

/* l = r T (1 + overrun) with T = d/R of the law `rate`, or the time of the law `const`. r the rate
   at which the device is taken, R that of what the step is for: where both are the same quantity it
   cancels, and so does its error. In: one step. Out: l and its standard uncertainty, m; false: an
   input is not known, or another law says how long the step takes. */
static bool loss_of(const fw_step *s, const fw_quantity *r, double *loss_m, double *u_m) {
    const fw_quantity *d = argument(s, "thickness"), *R = argument(s, "rate"),
                      *t = argument(s, "time");
    double more = 1.0 + s->overrun, share;
    if (s->law && strcmp(s->law, "rate") == 0 && d && R && r == R && !d->unknown) {
        *loss_m = d->value * more;
        share = relative(d);
    } else if (!r || r->unknown) {
        return false;
    } else if (s->law && strcmp(s->law, "rate") == 0 && d && R && !d->unknown && !R->unknown) {
        *loss_m = d->value * r->value / R->value * more;
        share = hypot(relative(d), hypot(relative(r), relative(R)));
    } else if (s->law && strcmp(s->law, "const") == 0 && t && !t->unknown) {
        *loss_m = t->value * r->value * more;
        share = hypot(relative(t), relative(r));
    } else {
        return false;
    }
    *u_m = share * *loss_m;
    return true;
}

/* Sum over the steps that say <exposed> of the device's own material with a rate, losses added,
   uncertainties in quadrature. Source: docs/theory/process.md, "What a step takes along".
   Test: test_wear.c. */
fw_wear fw_flow_wear(const fw_flow *flow) {
    fw_wear w = {0};
    for (int i = 0; flow->material && i < flow->nstep; i++) {
        const fw_step *s = &flow->step[i];
        for (int k = 0; k < s->nexposed && fw_step_is_wet(s); k++) {
            const fw_exposed *x = &s->exposed[k];
            double loss, u;
            if (strcmp(x->material, flow->material) != 0 || !x->rate) continue;
            if (!w.step) {
                w.step = s;
                w.exposed = x;
            }
            if (!loss_of(s, x->rate, &loss, &u)) {
                w.open = true;
                continue;
            }
            w.loss_m += loss;
            w.uncertainty_m = hypot(w.uncertainty_m, u);
        }
    }
    return w;
}
