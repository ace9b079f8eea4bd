/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The potential of force elements that are driven from outside (pulls, voltages): what they state
   as stored is not what their force derives from. At rest and at a given load factor it derives
   from a potential all the same,

       V(u) = - int_0^1 Q(w + x (u - w)) . (u - w) dx       with w where a descent stands,

   by Gauss's formula of 8 points; Q is a function of the pose alone, so the way there does not
   matter. Inputs: poses, scaled. Valid while the formulas hold on the way. Error: round-off where Q
   is smooth, some per cent of what a switch on the way changes where it is not; the line search
   that asks accepts by a ten-thousandth of what the forces promise. Cost: 8 evaluations of those
   elements. Source: Gauss-Legendre nodes and weights, Abramowitz and Stegun, table 25.4. Test:
   test_static_elements.c. */
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

enum { POINTS = 4 }; /* on either side of the middle */
static const double node[POINTS] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                    0.9602898564975363};
static const double weight[POINTS] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                      0.1012285362903763};

static bool none_is_driven(const fw_multibody_model *m) {
    for (int i = 0; i < m->nelement; i++)
        if (m->element[i].own->works) return false;
    return true;
}

/* what elements store too, but fw_multibody_energy_at counts that: it is taken off */
double fw_statics_equilibrium_driven(fw_statics_equilibrium *w, const double *u, double *size) {
    const fw_multibody_model *m = w->model;
    fw_multibody_system *sys = w->system;
    const double *v = w->away + m->nq;
    double sum = 0;
    *size = 0;
    if (none_is_driven(m)) return 0;
    for (int k = 0; k < 2 * POINTS; k++) {
        double x = 0.5 + (k % 2 ? 0.5 : -0.5) * node[k / 2], along = 0;
        for (int i = 0; i < m->nq; i++)
            w->away[i] = w->y[i] + x * (u[i] - w->y[i]);
        const fw_multibody_pose *pose = fw_multibody_set_switches(sys, w->t, w->away);
        memset(w->pull, 0, (size_t)m->nq * sizeof *w->pull);
        fw_multibody_element_driven(sys, pose, v, w->pull);
        for (int i = 0; i < m->nq; i++)
            along += w->pull[i] * (u[i] - w->y[i]);
        sum -= 0.5 * weight[k / 2] * along;
        *size += 0.5 * weight[k / 2] * fabs(along);
    }
    memcpy(w->away, u, (size_t)m->nq * sizeof *u);
    const fw_multibody_pose *pose = fw_multibody_set_switches(sys, w->t, w->away);
    return sum - (fw_multibody_element_energy(sys, pose, v, true) -
                  fw_multibody_element_energy(sys, pose, v, false));
}
