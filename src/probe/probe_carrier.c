/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces on the ports of a force element at a pose: the class's own force (effects/effects.h) where
   the ports are, its switches as the integration holds them, or, at rows and equilibria, as their
   own values say. In: poses and velocities in SI. Out: N, N m. Error: round-off, and that. Cost: that of
   the class. Test: test_probe.py, against the balance of forces on a body. */
#include "probe/probe.h"

/* points of a ground that stretches with time go with it */
static void stretch(const fw_probe *p, const fw_probe_state *s) {
    const fw_effects_stretch *g = &p->loads.stretch;
    double law[3];
    if (!g->law) return;
    fw_quantity_law_value(g->law, s->t_s, s->piece_s, law);
    for (int i = 0; i < p->element->ports; i++) {
        const fw_effects_port *at = &p->element->port[i];
        if (at->body != FW_GROUND) continue;
        const fw_geometry_vec2 root = fw_effects_element_root(p->element, i);
        double x = g->strain * (at->x_m + root.x - g->centre_m.x),
               y = g->strain * (at->y_m + root.y - g->centre_m.y);
        p->p[3 * i] += law[0] * x, p->p[3 * i + 1] += law[0] * y;
        if (!s->still) p->w[3 * i] += law[1] * x, p->w[3 * i + 1] += law[1] * y;
    }
}

bool fw_probe_element_forces(const fw_probe *p, const fw_probe_state *s,
                             fw_effects_port_state *seen) {
    const fw_effects_force_element *e = p->element;
    if (!e) return false;
    fw_effects_element_place_ports(e, s->q, s->v, p->p, p->w);
    stretch(p, s);
    *seen = (fw_effects_port_state){.t_s = s->t_s,
                                    .piece_s = s->piece_s,
                                    .load = 1,
                                    .p = p->p,
                                    .w = p->w,
                                    .on = p->on,
                                    .still = s->still};
    for (int i = 0; i < e->switches; i++)
        p->on[i] = false;
    for (int i = 0; i < e->switches; i++)
        p->on[i] = s->on ? s->on[p->first_switch + i]
                         : e->class_->switch_value && e->class_->switch_value(e, seen, i) > 0;
    e->class_->force(e, seen, p->f);
    return true;
}
