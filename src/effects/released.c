/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pins that an element stands for: how the modes open them, and with what force the element then
   acts. With u of a mode, D = (places of b) - (places of a) at W, and the force on b is -K u of the
   element's tangent as drawn. Their forces, as those of pins, take from the stiffness: a force f on
   body b at the arm r does the work f . r'' under a turn, so that (phi_b, phi_b) gains r . f, and
   (phi_a, phi_a) loses it. Inputs and outputs SI. Source: second variation of the potential of a
   force at a point of a body. Test: test_linear.c. */
#include "effects/modal.h"
#include <math.h>

static void drawn_place(const fw_mechanism *m, const fw_effects_port *p, double *at,
                        fw_geometry_vec2 *arm) {
    fw_geometry_vec2 w = fw_mechanism_local_place(m, p->body, p->x_m, p->y_m);
    at[0] = w.x, at[1] = w.y, at[2] = 0;
    *arm = w;
    if (p->body == FW_GROUND) return;
    const fw_mechanism_mass *b = &m->body[p->body];
    at[2] = b->phi_rad;
    *arm = (fw_geometry_vec2){w.x - b->x_m, w.y - b->y_m};
}

/* places of both ports and turns of both bodies in a mode */
static void seen_in(const fw_effects_force_element *e, const fw_geometry_vec2 *arm,
                    const double *shape, double *u) {
    for (int side = 0; side < 2; side++) {
        int b = e->port[side].body;
        double x = 0, y = 0, phi = 0;
        if (b != FW_GROUND) x = shape[3 * b], y = shape[3 * b + 1], phi = shape[3 * b + 2];
        u[3 * side] = x - phi * arm[side].y;
        u[3 * side + 1] = y + phi * arm[side].x;
        u[3 * side + 2] = phi;
    }
}

static void open_one(fw_effects_modal *o, const fw_effects_force_element *e) {
    double p[6], w[6] = {0}, k[36], c[36], u[6];
    fw_geometry_vec2 arm[2];
    size_t pins = (size_t)o->mechanism->npin, n = (size_t)o->n;
    for (int side = 0; side < 2; side++)
        drawn_place(o->mechanism, &e->port[side], p + 3 * side, &arm[side]);
    const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
    e->class_->tangent(e, &s, k, c);
    for (size_t j = 0; j < (size_t)o->modes; j++) {
        double *open = o->open + 2 * (j * pins + (size_t)e->pin);
        double *pull = o->pull + 2 * (j * pins + (size_t)e->pin);
        seen_in(e, arm, o->shape + j * n, u);
        for (int i = 0; i < 2; i++) {
            open[i] = u[3 + i] - u[i];
            for (int l = 0; l < 6; l++)
                pull[i] -= k[6 * (3 + i) + l] * u[l];
        }
    }
}

fw_status fw_effects_modal_open(fw_arena *arena, fw_effects_modal *o) {
    size_t size = 2 * (size_t)o->modes * (size_t)o->mechanism->npin;
    FW_NEED(o->open = fw_arena_array(arena, double, size));
    FW_NEED(o->pull = fw_arena_array(arena, double, size));
    for (int i = 0; i < o->loads->nelement; i++)
        if (o->loads->element[i].pin != FW_NONE && o->loads->element[i].ports == 2)
            open_one(o, &o->loads->element[i]);
    return FW_OK;
}

void fw_effects_modal_pulls(const fw_effects_modal *o, const double *force, double *pull) {
    size_t n = (size_t)o->n, size = 2 * (size_t)o->mechanism->npin;
    for (size_t i = 0; i < size; i++)
        pull[i] = 0;
    for (size_t j = 0; j < (size_t)o->modes; j++) {
        double q = 0;
        for (size_t k = 0; k < n; k++)
            q += o->shape[j * n + k] * force[k];
        for (size_t i = 0; i < size; i++)
            pull[i] += o->pull[j * size + i] * q / (o->omega[j] * o->omega[j]);
    }
}

double fw_effects_modal_turning(const fw_effects_modal *o, const double *pull, int row,
                                int column) {
    const double *left = o->shape + (size_t)row * (size_t)o->n;
    const double *right = o->shape + (size_t)column * (size_t)o->n;
    double sum = 0;
    for (int i = 0; i < o->loads->nelement && o->loads->nreleased > 0; i++) {
        const fw_effects_force_element *e = &o->loads->element[i];
        for (int side = 0; side < 2 && e->pin != FW_NONE && e->ports == 2; side++) {
            int b = e->port[side].body;
            double at[3];
            fw_geometry_vec2 arm;
            if (b == FW_GROUND) continue;
            drawn_place(o->mechanism, &e->port[side], at, &arm);
            double work = arm.x * pull[2 * e->pin] + arm.y * pull[2 * e->pin + 1];
            sum += (side ? work : -work) * left[3 * b + 2] * right[3 * b + 2];
        }
    }
    return sum;
}
