/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds on one side only: stops and cables. A flag says whether the element acts; during a
   step it stays as it is, so that the right-hand side is smooth, and run.c looks for the time at
   which the flag no longer fits. With the element's stretch g and its rate g' it acts while

       min(k g, k g + c g') > 0:

   it is stretched and does not pull the wrong way (a damped stop lets go before it is relaxed).
   Test: test_events.c. */
#include "multibody/model.h"
#include <math.h>

static int cables(const fw_model *m) {
    int count = 0;
    for (int i = 0; i < m->nspring; i++)
        count += m->spring[i].cable;
    return count;
}

int fw_model_switches(const fw_model *m) {
    return m->nstop + cables(m);
}

/* the i-th cable */
static fw_model_spring *cable(const fw_model *m, int i) {
    for (int k = 0; k < m->nspring; k++)
        if (m->spring[k].cable && i-- == 0) return &m->spring[k];
    return NULL;
}

double fw_model_switch_value(fw_model *m, int i, const double *y) {
    double stretch, rate, k, c;
    if (i < m->nstop) {
        const fw_model_stop *s = &m->stop[i];
        fw_model_stopped(m, s, y, &stretch, &rate);
        k = s->k, c = s->c;
    } else {
        const fw_model_spring *s = cable(m, i - m->nstop);
        fw_pull p = fw_model_pull(m, s, y);
        stretch = p.length - s->length, rate = p.rate;
        k = s->k, c = s->c;
    }
    return fmin(k * stretch, k * stretch + c * rate);
}

static bool *flag(const fw_model *m, int i) {
    return i < m->nstop ? &m->stop[i].on : &cable(m, i - m->nstop)->on;
}

bool fw_model_switch_on(const fw_model *m, int i) {
    return *flag(m, i);
}

void fw_model_set_switches(fw_model *m, const double *y) {
    int count = fw_model_switches(m);
    if (count == 0) return;
    fw_model_pose(m, y);
    for (int i = 0; i < count; i++)
        *flag(m, i) = fw_model_switch_value(m, i, y) > 0;
}

/* what is still stored when a damped element lets go is lost to it, and is there again when it
   takes hold while stretched */
void fw_model_flip(fw_model *m, int i, double *y) {
    bool *on = flag(m, i);
    double stretch, rate, k;
    fw_model_pose(m, y);
    if (i < m->nstop) {
        fw_model_stopped(m, &m->stop[i], y, &stretch, &rate);
        k = m->stop[i].k;
    } else {
        const fw_model_spring *s = cable(m, i - m->nstop);
        stretch = fw_model_pull(m, s, y).length - s->length;
        k = s->k;
    }
    if (m->dissipated >= 0) y[m->dissipated] += (*on ? 0.5 : -0.5) * k * stretch * stretch;
    *on = !*on;
    m->events++;
}
