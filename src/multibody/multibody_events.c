/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds on one side only. Switches are counted through: stops, cables, then those of force
   elements (whatever else has switches is counted behind these). A flag says whether the thing
   acts; during a step it stays as it is, so that the right-hand side is smooth, and
   dynamics/event.c looks for the time at which the flag no longer fits. With the stretch g of a
   stop or cable and its rate g' it acts while

       min(k g, k g + c g') > 0:

   it is stretched and does not pull the wrong way (a damped stop lets go before it is relaxed).
   Elements have a function of their own. Test: test_events.c, test_elements.c. */
#include "multibody/multibody_scratch.h"
#include <math.h>

int fw_multibody_switch_count(const fw_multibody_model *m) {
    return m->nstop + m->ncable + m->nswitch;
}

static double stop_value(const fw_multibody_system *sys, const fw_multibody_pose *pose, int i,
                         const double *v) {
    const fw_multibody_stop *s = &sys->model->stop[i];
    double past, rate;
    fw_multibody_stop_travel(sys->model, pose, s, v, &past, &rate);
    return fmin(s->k * past, s->k * past + s->c * rate);
}

static double cable_value(const fw_multibody_system *sys, const fw_multibody_pose *pose, int spring,
                          const double *v) {
    const fw_multibody_spring *s = &sys->model->spring[spring];
    fw_multibody_pull p = fw_multibody_pull_of(sys, pose, spring, v);
    double stretch = p.length - s->length;
    return fmin(s->k * stretch, s->k * stretch + s->c * p.rate);
}

/* the spring that is the i-th cable */
static int cable(const fw_multibody_model *m, int i) {
    int spring = 0;
    while (!m->spring[spring].cable || i-- > 0)
        spring++;
    return spring;
}

const fw_multibody_element *fw_multibody_element_of_switch(const fw_multibody_model *m, int i) {
    const fw_multibody_element *e = m->element;
    while (i >= e->first_switch + e->own->switches)
        e++;
    return e;
}

double fw_multibody_switch_value(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 int i, const double *v) {
    const fw_multibody_model *m = sys->model;
    if (i < m->nstop) return stop_value(sys, pose, i, v);
    if ((i -= m->nstop) < m->ncable) return cable_value(sys, pose, cable(m, i), v);
    i -= m->ncable;
    const fw_multibody_element *e = fw_multibody_element_of_switch(m, i);
    return fw_multibody_element_switch_value(sys, pose, e, i - e->first_switch, v);
}

void fw_multibody_switch_values(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v, double *value) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nstop; i++)
        *value++ = stop_value(sys, pose, i, v);
    for (int i = 0; i < m->nspring; i++)
        if (m->spring[i].cable) *value++ = cable_value(sys, pose, i, v);
    for (int i = 0; i < m->nelement; i++)
        for (int k = 0; k < m->element[i].own->switches; k++)
            *value++ = fw_multibody_element_switch_value(sys, pose, &m->element[i], k, v);
}

static bool *flag(const fw_multibody_system *sys, int i) {
    const fw_multibody_model *m = sys->model;
    if (i < m->nstop) return &sys->on.stop[i];
    if ((i -= m->nstop) < m->ncable) return &sys->on.spring[cable(m, i)];
    return &sys->on.element[i - m->ncable];
}

bool fw_multibody_switch_on(const fw_multibody_system *sys, int i) {
    return *flag(sys, i);
}

const fw_multibody_pose *fw_multibody_set_switches(fw_multibody_system *sys, double t,
                                                   const double *y) {
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    int count = fw_multibody_switch_count(sys->model);
    for (int i = 0; i < count; i++)
        *flag(sys, i) = fw_multibody_switch_value(sys, pose, i, y + sys->model->nq) > 0;
    return pose;
}

/* what a stop or cable stores while it acts */
static double held(const fw_multibody_system *sys, const fw_multibody_pose *pose, int i,
                   const double *v) {
    const fw_multibody_model *m = sys->model;
    double stretch, rate, k;
    if (i < m->nstop) {
        fw_multibody_stop_travel(m, pose, &m->stop[i], v, &stretch, &rate);
        k = m->stop[i].k;
    } else {
        int spring = cable(m, i - m->nstop);
        stretch = fw_multibody_pull_of(sys, pose, spring, v).length - m->spring[spring].length;
        k = m->spring[spring].k;
    }
    return 0.5 * k * stretch * stretch;
}

/* what is still stored when a damped thing lets go is lost to it, and is there again when it takes
   hold while stretched */
void fw_multibody_flip(fw_multibody_system *sys, double t, int i, double *y) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    const double *v = y + m->nq;
    bool *on = flag(sys, i);
    double lost;
    if (i < m->nstop + m->ncable) {
        lost = (*on ? 1 : -1) * held(sys, pose, i, v);
        *on = !*on;
    } else {
        lost = fw_multibody_element_energy(sys, pose, v, true);
        *on = !*on;
        lost -= fw_multibody_element_energy(sys, pose, v, true);
    }
    if (m->dissipated >= 0) y[m->dissipated] += lost;
    sys->record.events++;
}
