/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force elements that only tests know, and scenes with them. */
#ifndef FW_TEST_ELEMENT_RIGS_H
#define FW_TEST_ELEMENT_RIGS_H
#include "dynamics/models.h"
#include "dynamics/run.h"
#include "effects/effect.h"

/* ---- line: along the line between two ports, T = [on] (k s + c l') + load pull L(t),
   s = l + load draw L(t) - length ---- */

typedef struct line {
    double k, c, length, draw, pull;
} line;

typedef struct line_now {
    double ux, uy, l, rate, stretch, law, law_rate, force;
} line_now;

static inline line_now line_at(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const line *d = e->data;
    line_now n = {.law = 1};
    double dx = s->p[3] - s->p[0], dy = s->p[4] - s->p[1], all[3];
    n.l = hypot(dx, dy);
    n.ux = dx / n.l, n.uy = dy / n.l;
    n.rate = n.ux * (s->w[3] - s->w[0]) + n.uy * (s->w[4] - s->w[1]);
    if (e->laws) {
        fw_quantity_law_value(e->law[0], s->t_s, s->piece_s, all);
        n.law = all[0], n.law_rate = all[1];
    }
    n.stretch = n.l + s->load * d->draw * n.law - d->length;
    bool on = e->switches == 0 || s->on[0];
    n.force = (on ? d->k * n.stretch + d->c * n.rate : 0) + s->load * d->pull * n.law;
    return n;
}

static inline void line_push(double force, const line_now *n, double *f) {
    f[0] = force * n->ux, f[1] = force * n->uy, f[2] = f[5] = 0;
    f[3] = -f[0], f[4] = -f[1];
}

static inline void line_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                              double *f) {
    line_now n = line_at(e, s);
    line_push(n.force, &n, f);
}

static inline void line_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                                double *stiffness, double *damping) {
    const line *d = e->data;
    line_now n = line_at(e, s);
    bool on = e->switches == 0 || s->on[0];
    double u[2] = {n.ux, n.uy}, k = on ? d->k : 0, c = on ? d->c : 0;
    for (int i = 0; i < 36; i++)
        stiffness[i] = damping[i] = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            double bend = (s->w[3 + j] - s->w[j] - u[j] * n.rate) / n.l;
            double a = u[i] * (k * u[j] + c * bend) + n.force / n.l * ((i == j) - u[i] * u[j]);
            double b = c * u[i] * u[j];
            for (int p = 0; p < 4; p++) {
                int at = (3 * (p / 2) + i) * 6 + 3 * (p % 2) + j;
                stiffness[at] = p / 2 == p % 2 ? a : -a;
                damping[at] = p / 2 == p % 2 ? b : -b;
            }
        }
}

static inline double line_energy(const fw_effects_force_element *e,
                                 const fw_effects_port_state *s) {
    const line *d = e->data;
    line_now n = line_at(e, s);
    return e->switches == 0 || s->on[0] ? 0.5 * d->k * n.stretch * n.stretch : 0;
}

static inline void line_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                              double power[2]) {
    const line *d = e->data;
    line_now n = line_at(e, s);
    bool on = e->switches == 0 || s->on[0];
    power[0] = on ? d->c * n.rate * n.rate : 0;
    power[1] = (on ? d->k * n.stretch * s->load * d->draw * n.law_rate : 0) -
               s->load * d->pull * n.law * n.rate;
}

static inline double line_switch(const fw_effects_force_element *e, const fw_effects_port_state *s,
                                 int i) {
    const line *d = e->data;
    line_now n = line_at(e, s);
    (void)i;
    return fmin(d->k * n.stretch, d->k * n.stretch + d->c * n.rate);
}

static inline void line_slope(const fw_effects_force_element *e, const fw_effects_port_state *s,
                              double *f) {
    const line *d = e->data;
    line_now n = line_at(e, s);
    bool on = e->switches == 0 || s->on[0];
    line_push(n.law * ((on ? d->k * d->draw : 0) + d->pull), &n, f);
}

static inline bool line_valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                              const char **why) {
    *why = "the ends of the line meet";
    return line_at(e, s).l > 1e-6;
}

static const fw_effects_element_class line_class = {.effect = "line",
                                                    .force = line_force,
                                                    .tangent = line_tangent,
                                                    .energy = line_energy,
                                                    .power = line_power,
                                                    .switch_value = line_switch,
                                                    .slope = line_slope,
                                                    .valid = line_valid};

static inline fw_effects_force_element *line_add(fw_arena *arena, fw_effects_loads *t,
                                                 const line *d, int a, double ax, double ay, int b,
                                                 double bx, double by) {
    fw_effects_force_element *e = fw_effects_loads_add_element(arena, t, &line_class, 2);
    e->port[0] = (fw_effects_port){a, ax, ay}, e->port[1] = (fw_effects_port){b, bx, by};
    e->size_N_per_m = d->k, e->force_N = fabs(d->pull);
    e->dissipates = d->c > 0, e->works = d->draw != 0 || d->pull != 0;
    e->data = d;
    return e;
}

/* ---- bush: k between two points, kr and cr between the angles: what stands for a pin ---- */

typedef struct bush {
    double k, kr, cr;
} bush;

static inline void bush_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                              double *f) {
    const bush *d = e->data;
    for (int i = 0; i < 2; i++)
        f[i] = d->k * (s->p[3 + i] - s->p[i]), f[3 + i] = -f[i];
    f[2] = d->kr * (s->p[5] - s->p[2]) + d->cr * (s->w[5] - s->w[2]);
    f[5] = -f[2];
}

static inline void bush_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                                double *stiffness, double *damping) {
    const bush *d = e->data;
    (void)s;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            double sign = i == j ? 1 : i % 3 == j % 3 ? -1 : 0;
            stiffness[6 * i + j] = sign * (i % 3 == 2 ? d->kr : d->k);
            damping[6 * i + j] = sign * (i % 3 == 2 ? d->cr : 0);
        }
}

static inline double bush_energy(const fw_effects_force_element *e,
                                 const fw_effects_port_state *s) {
    const bush *d = e->data;
    double x = s->p[3] - s->p[0], y = s->p[4] - s->p[1], turn = s->p[5] - s->p[2];
    return 0.5 * d->k * (x * x + y * y) + 0.5 * d->kr * turn * turn;
}

static inline void bush_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                              double power[2]) {
    const bush *d = e->data;
    double rate = s->w[5] - s->w[2];
    power[0] = d->cr * rate * rate, power[1] = 0;
}

static const fw_effects_element_class bush_class = {.effect = "bush",
                                                    .force = bush_force,
                                                    .tangent = bush_tangent,
                                                    .energy = bush_energy,
                                                    .power = bush_power};

/* in the place of a pin, whose spring and damper go */
static inline void bush_release(fw_arena *arena, const fw_mechanism *m, fw_effects_loads *t,
                                int pin, const bush *d) {
    const fw_mechanism_pin *p = &m->pin[pin];
    fw_effects_force_element *e = fw_effects_loads_add_element(arena, t, &bush_class, 2);
    e->port[0] = (fw_effects_port){p->body_a, p->ax_m, p->ay_m};
    e->port[1] = (fw_effects_port){p->body_b, p->bx_m, p->by_m};
    e->pin = pin;
    e->dissipates = d->cr > 0;
    e->data = d;
    t->released[pin] = true;
    t->nreleased++;
    if (t->torsion_of[pin]) {
        fw_effects_torsion *spring = &t->torsion[t->torsion_of[pin] - 1];
        spring->stiffness_Nm_per_rad = spring->damping_Nms_per_rad = 0;
    }
}

/* ---- scenes ---- */

static inline fw_effects_loads rig_terms(fw_arena *arena, const rig *r) {
    fw_effects_loads t;
    fw_effect_ledger ledger;
    fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    fw_diags diags = fw_diags_new(arena);
    assert_int_equal(fw_effects_compile(arena, &r->m, &r->scene, &all, 1e-3, &diags, &ledger, &t),
                     FW_OK);
    return t;
}

static inline const fw_dynamics_motion *rig_run_by(fw_arena *arena, const rig *r,
                                                   const fw_effects_loads *t, const char *method,
                                                   const char *integrator, double rtol,
                                                   int samples) {
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *m;
    const fw_dynamics_motion_options o = {
        .method = method, .integrator = integrator, .rtol = rtol, .samples = samples};
    fw_status status = fw_dynamics_simulate_compiled(arena, &r->m, &r->scene, &o,
                                                     &(fw_effect_ledger){0}, t, &diags, &m);
    if (status != FW_OK)
        fail_msg("%s: %s", method ? method : "(default)",
                 diags.count ? diags.item[diags.count - 1].message : "no message");
    return m;
}

static inline const fw_dynamics_motion *rig_run(fw_arena *arena, const rig *r,
                                                const fw_effects_loads *t, const char *method,
                                                double rtol, int samples) {
    return rig_run_by(arena, r, t, method, NULL, rtol, samples);
}

#endif
