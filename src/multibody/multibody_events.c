/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds on one side only. Switches are counted through: stops, cables, then those of force
   elements (whatever else has switches is counted behind these). A flag says whether the thing
   acts; during a step it stays as it is, so that the right-hand side is smooth, and dynamics_run.c looks for
   the time at which the flag no longer fits. With the stretch g of a stop or cable and its rate g'
   it acts while

       min(k g, k g + c g') > 0:

   it is stretched and does not pull the wrong way (a damped stop lets go before it is relaxed).
   Elements have a function of their own. Test: test_events.c, test_elements.c. */
#include "multibody/model.h"
#include <math.h>

int fw_multibody_model_switches(const fw_multibody_model *m) {
    return m->nstop + m->ncable + m->nswitch;
}

static double stop_value(const fw_multibody_model *m, const fw_multibody_model_stop *s,
                         const double *y) {
    double past, rate;
    fw_multibody_model_stopped(m, s, y, &past, &rate);
    return fmin(s->k * past, s->k * past + s->c * rate);
}

static double cable_value(const fw_multibody_model *m, const fw_multibody_model_spring *s,
                          const double *y) {
    fw_multibody_pull p = fw_multibody_model_pull(m, s, y);
    double stretch = p.length - s->length;
    return fmin(s->k * stretch, s->k * stretch + s->c * p.rate);
}

/* the i-th cable */
static fw_multibody_model_spring *cable(const fw_multibody_model *m, int i) {
    for (int k = 0; k < m->nspring; k++)
        if (m->spring[k].cable && i-- == 0) return &m->spring[k];
    return NULL;
}

double fw_multibody_model_switch_value(const fw_multibody_model *m, double t, int i,
                                       const double *y) {
    int which;
    if (i < m->nstop) return stop_value(m, &m->stop[i], y);
    if ((i -= m->nstop) < m->ncable) return cable_value(m, cable(m, i), y);
    const fw_multibody_model_element *e =
        fw_multibody_model_element_switch(m, i - m->ncable, &which);
    return fw_multibody_model_element_switch_value(m, e, t, which, y);
}

void fw_multibody_model_switch_values(const fw_multibody_model *m, double t, const double *y,
                                      double *value) {
    for (int i = 0; i < m->nstop; i++)
        *value++ = stop_value(m, &m->stop[i], y);
    for (int i = 0; i < m->nspring; i++)
        if (m->spring[i].cable) *value++ = cable_value(m, &m->spring[i], y);
    for (int i = 0; i < m->nelement; i++)
        for (int k = 0; k < m->element[i].own->switches; k++)
            *value++ = fw_multibody_model_element_switch_value(m, &m->element[i], t, k, y);
}

static bool *flag(const fw_multibody_model *m, int i) {
    int which;
    if (i < m->nstop) return &m->stop[i].on;
    if ((i -= m->nstop) < m->ncable) return &cable(m, i)->on;
    fw_multibody_model_element *e = fw_multibody_model_element_switch(m, i - m->ncable, &which);
    return &e->on[which];
}

bool fw_multibody_model_switch_on(const fw_multibody_model *m, int i) {
    return *flag(m, i);
}

void fw_multibody_model_set_switches(fw_multibody_model *m, double t, const double *y) {
    int count = fw_multibody_model_switches(m);
    if (count == 0) return;
    fw_multibody_model_pose(m, y);
    for (int i = 0; i < count; i++)
        *flag(m, i) = fw_multibody_model_switch_value(m, t, i, y) > 0;
}

/* what a stop or cable stores while it acts */
static double held(const fw_multibody_model *m, int i, const double *y) {
    double stretch, rate, k;
    if (i < m->nstop) {
        fw_multibody_model_stopped(m, &m->stop[i], y, &stretch, &rate);
        k = m->stop[i].k;
    } else {
        const fw_multibody_model_spring *s = cable(m, i - m->nstop);
        stretch = fw_multibody_model_pull(m, s, y).length - s->length;
        k = s->k;
    }
    return 0.5 * k * stretch * stretch;
}

/* what is still stored when a damped thing lets go is lost to it, and is there again when it takes
   hold while stretched */
void fw_multibody_model_flip(fw_multibody_model *m, double t, int i, double *y) {
    bool *on = flag(m, i);
    double lost;
    fw_multibody_model_pose(m, y);
    if (i < m->nstop + m->ncable) {
        lost = (*on ? 1 : -1) * held(m, i, y);
        *on = !*on;
    } else {
        lost = fw_multibody_model_element_energy(m, t, y, true);
        *on = !*on;
        lost -= fw_multibody_model_element_energy(m, t, y, true);
    }
    if (m->dissipated >= 0) y[m->dissipated] += lost;
    m->events++;
}
