/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

fw_status fw_terms_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                       fw_terms *terms) {
    size_t n = 3 * (size_t)mechanism->nbody;
    *terms = (fw_terms){.nbody = mechanism->nbody};
    FW_NEED(terms->constant = fw_arena_array(arena, double, n));
    FW_NEED(terms->velocity = fw_arena_array(arena, double, n));
    FW_NEED(terms->torsion = fw_arena_array(arena, fw_torsion, (size_t)mechanism->npin));
    FW_NEED(terms->load = fw_arena_array(arena, fw_point_load, (size_t)scene->nforce));
    FW_NEED(terms->spring = fw_arena_array(arena, fw_spring, (size_t)mechanism->nspring));
    return FW_OK;
}

fw_torsion *fw_terms_torsion(const fw_mechanism *mechanism, fw_terms *terms, int pin) {
    for (int i = 0; i < terms->ntorsion; i++)
        if (terms->torsion[i].pin == pin) return &terms->torsion[i];
    fw_torsion *t = &terms->torsion[terms->ntorsion++];
    const fw_pin *p = &mechanism->pin[pin];
    *t = (fw_torsion){pin, p->body_a, p->body_b, 0, 0, p->free_angle_rad};
    return t;
}

static void add_at(const fw_mechanism *m, double *force, int body, double x, double y, double fx,
                   double fy) {
    if (body == FW_GROUND) return;
    double c = cos(m->body[body].phi_rad), s = sin(m->body[body].phi_rad);
    double rx = c * x - s * y, ry = s * x + c * y;
    force[3 * body] += fx;
    force[3 * body + 1] += fy;
    force[3 * body + 2] += rx * fy - ry * fx;
}

static fw_vec2 world_point(const fw_mechanism *m, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_vec2){x, y};
    const fw_mass *b = &m->body[body];
    double c = cos(b->phi_rad), s = sin(b->phi_rad);
    return (fw_vec2){b->x_m + c * x - s * y, b->y_m + s * x + c * y};
}

void fw_terms_initial_force(const fw_mechanism *m, const fw_terms *terms, double *force) {
    for (int i = 0; i < 3 * terms->nbody; i++)
        force[i] = terms->constant[i];
    for (int i = 0; i < terms->nload; i++) {
        const fw_point_load *l = &terms->load[i];
        add_at(m, force, l->body, l->x_m, l->y_m, l->fx_N, l->fy_N);
    }
    for (int i = 0; i < terms->ntorsion; i++) {
        const fw_torsion *t = &terms->torsion[i];
        double a = t->body_a == FW_GROUND ? 0 : m->body[t->body_a].phi_rad;
        double b = t->body_b == FW_GROUND ? 0 : m->body[t->body_b].phi_rad;
        double torque = -t->stiffness_Nm_per_rad * (b - a - t->free_angle_rad);
        if (t->body_a != FW_GROUND) force[3 * t->body_a + 2] -= torque;
        if (t->body_b != FW_GROUND) force[3 * t->body_b + 2] += torque;
    }
    for (int i = 0; i < terms->nspring; i++) {
        const fw_spring *s = &terms->spring[i];
        fw_vec2 a = world_point(m, s->body_a, s->ax_m, s->ay_m);
        fw_vec2 b = world_point(m, s->body_b, s->bx_m, s->by_m);
        double dx = b.x - a.x, dy = b.y - a.y, l = hypot(dx, dy);
        double f = l > 0 ? s->stiffness_N_per_m * (l - s->length_m) / l : 0;
        add_at(m, force, s->body_a, s->ax_m, s->ay_m, f * dx, f * dy);
        add_at(m, force, s->body_b, s->bx_m, s->by_m, -f * dx, -f * dy);
    }
}
