/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force elements where the bodies are now, at rest. */
#include "effects/linear.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { PORTS_MOST = 128, SWITCHES_MOST = 64 };

typedef struct still { /* the element alone: its ports' bodies are 0, 1, ... */
    fw_effects_force_element e;
    fw_effects_port port[PORTS_MOST];
    double q[3 * PORTS_MOST], p[3 * PORTS_MOST], w[3 * PORTS_MOST], f[3 * PORTS_MOST];
    bool on[SWITCHES_MOST];
    fw_effects_port_state seen;
} still;

bool fw_effects_loads_element_fits(const fw_effects_force_element *e) {
    return e->ports <= PORTS_MOST && e->switches <= SWITCHES_MOST;
}

/* every switch as its own value says */
static void look(const fw_mechanism *m, const fw_effects_force_element *e, double t_s,
                 double piece_s, still *s) {
    s->e = *e;
    s->e.port = s->port;
    for (int i = 0; i < e->ports; i++) {
        int b = e->port[i].body;
        s->port[i] = e->port[i];
        if (b == FW_GROUND) continue;
        s->port[i].body = i;
        s->q[3 * i] = m->body[b].x_m, s->q[3 * i + 1] = m->body[b].y_m;
        s->q[3 * i + 2] = m->body[b].phi_rad;
    }
    fw_effects_element_place_ports(&s->e, s->q, NULL, s->p, s->w);
    s->seen = (fw_effects_port_state){
        .t_s = t_s, .piece_s = piece_s, .load = 1, .p = s->p, .w = s->w, .on = s->on};
    for (int i = 0; i < e->switches; i++)
        s->on[i] = false;
    for (int i = 0; i < e->switches; i++)
        s->on[i] = e->class_->switch_value && e->class_->switch_value(&s->e, &s->seen, i) > 0;
    e->class_->force(&s->e, &s->seen, s->f);
}

void fw_effects_loads_element_force(const fw_mechanism *m, const fw_effects_force_element *e,
                                    double t_s, double piece_s, double *force) {
    still s;
    double local[3 * PORTS_MOST] = {0};
    if (!fw_effects_loads_element_fits(e)) return;
    look(m, e, t_s, piece_s, &s);
    fw_effects_element_add_forces(&s.e, s.q, s.f, local);
    for (int i = 0; i < 3 * e->ports; i++)
        if (e->port[i / 3].body != FW_GROUND) force[3 * e->port[i / 3].body + i % 3] += local[i];
}

void fw_effects_loads_element_drag(const fw_mechanism *m, const fw_effects_force_element *e,
                                   double strain, fw_geometry_vec2 centre, double *force) {
    still s;
    double before[3 * PORTS_MOST], local[3 * PORTS_MOST] = {0};
    if (!fw_effects_loads_element_fits(e)) return;
    look(m, e, 0, DBL_MIN, &s);
    memcpy(before, s.f, 3 * (size_t)e->ports * sizeof *before);
    for (int i = 0; i < e->ports; i++)
        if (e->port[i].body == FW_GROUND) {
            s.w[3 * i] = strain * (e->port[i].x_m - centre.x);
            s.w[3 * i + 1] = strain * (e->port[i].y_m - centre.y);
        }
    e->class_->force(&s.e, &s.seen, s.f);
    for (int i = 0; i < 3 * e->ports; i++)
        s.f[i] -= before[i];
    fw_effects_element_add_forces(&s.e, s.q, s.f, local);
    for (int i = 0; i < 3 * e->ports; i++)
        if (e->port[i / 3].body != FW_GROUND) force[3 * e->port[i / 3].body + i % 3] += local[i];
}

/* of 65 instants evenly over the scene, and behind every break of its laws, the one with the
   largest forces; with the element's laws NULL or end_s 0 the start */
double fw_effects_loads_element_busiest(const fw_mechanism *m, const fw_effects_force_element *e,
                                        double end_s) {
    enum { INSTANTS = 65, BREAKS_MOST = 64 };
    double at[INSTANTS + FW_ELEMENT_LAWS * BREAKS_MOST], most = -1, best = 0;
    int count = 0;
    if (e->laws == 0 || !(end_s > 0) || !fw_effects_loads_element_fits(e)) return 0;
    for (int i = 0; i < INSTANTS; i++)
        at[count++] = end_s * i / (INSTANTS - 1);
    for (int i = 0; i < e->laws; i++) {
        int found = fw_quantity_law_breaks_of(e->law[i], end_s, at + count, BREAKS_MOST);
        count += found < BREAKS_MOST ? found : BREAKS_MOST;
    }
    for (int i = 0; i < count; i++) {
        still s;
        double size = 0;
        look(m, e, at[i], fmax(at[i], DBL_MIN), &s);
        for (int k = 0; k < 3 * e->ports; k++)
            size += fabs(s.f[k]);
        if (size > most) most = size, best = at[i];
    }
    return best;
}

fw_status fw_effects_loads_element_tangent_at(fw_arena *arena, const fw_mechanism *m,
                                              const fw_effects_force_element *e, double t_s,
                                              double piece_s, double *stiffness, double *damping,
                                              bool *valid) {
    size_t n = 3 * (size_t)m->nbody, size = 9 * (size_t)e->ports * (size_t)e->ports;
    fw_mark mark = fw_arena_mark(arena);
    double *q, *k, *c;
    const char *why;
    still s;
    *valid = true;
    if (!fw_effects_loads_element_fits(e)) return FW_OK;
    FW_NEED(q = fw_arena_array(arena, double, n));
    FW_NEED(k = fw_arena_array(arena, double, size));
    FW_NEED(c = fw_arena_array(arena, double, size));
    for (int b = 0; b < m->nbody; b++)
        q[3 * b] = m->body[b].x_m, q[3 * b + 1] = m->body[b].y_m, q[3 * b + 2] = m->body[b].phi_rad;
    look(m, e, t_s, piece_s, &s);
    *valid = !e->class_->valid || e->class_->valid(&s.e, &s.seen, &why);
    e->class_->tangent(&s.e, &s.seen, k, c);
    fw_effects_element_spread(e, m->nbody, q, NULL, s.f, k, c, stiffness, damping);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

fw_status fw_effects_loads_element_tangent(fw_arena *arena, const fw_mechanism *m,
                                           const fw_effects_loads *loads, double *stiffness,
                                           double *damping) {
    bool valid;
    for (int i = 0; i < loads->nelement; i++)
        FW_TRY(fw_effects_loads_element_tangent_at(arena, m, &loads->element[i], 0, DBL_MIN,
                                                   stiffness, damping, &valid));
    return FW_OK;
}
