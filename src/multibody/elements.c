/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force elements on the model's bodies (effects/element.h): from the pose to what the ports see, in
   SI, from their forces to accelerations and generalised forces, from their tangents to the
   model's.

   A port at the local point s of a body stands at p = (x + r, phi) with the arm r = R(phi) s and
   moves with w = (v + omega (-r_y, r_x), omega); a force f with a couple on it is the generalised
   force (f, r x f + couple). Positions are counted from the model's centre, so that far-away
   coordinates cost no digits. Units: model.h in, SI to the classes, scaled units out. Error:
   round-off. Cost: the classes', and some twenty operations per port; nothing is allocated after
   fw_multibody_model_elements_new. Test: test_elements.c. */
#include "multibody/build.h"
#include "multibody/reactions.h"
#include <math.h>
#include <string.h>

static fw_status element_new(fw_arena *arena, const fw_multibody_model *m,
                             const fw_effects_force_element *own, fw_geometry_vec2 centre,
                             fw_multibody_model_element *e) {
    size_t ports = (size_t)own->ports;
    double length = m->scale.length_m;
    *e = (fw_multibody_model_element){
        .own = own, .electrodes = own->class_->electrodes, .scaled = *own};
    FW_NEED(e->scaled.port = fw_arena_array(arena, fw_effects_port, ports));
    FW_NEED(e->body = fw_arena_array(arena, int, ports));
    FW_NEED(e->on = fw_arena_array(arena, bool, (size_t)own->switches));
    FW_NEED(e->f = fw_arena_array(arena, double, 3 * ports));
    for (int i = 0; i < own->ports; i++) {
        const fw_effects_port *p = &own->port[i];
        bool ground = p->body == FW_GROUND;
        e->body[i] = ground ? m->nbody : p->body;
        e->scaled.port[i] = (fw_effects_port){.body = p->body,
                                              .x_m = (p->x_m - (ground ? centre.x : 0)) / length,
                                              .y_m = (p->y_m - (ground ? centre.y : 0)) / length};
    }
    return FW_OK;
}

static fw_status work_new(fw_arena *arena, fw_multibody_model *m, size_t ports) {
    fw_multibody_element_work *k = &m->port;
    FW_NEED(k->p = fw_arena_array(arena, double, 3 * ports));
    FW_NEED(k->w = fw_arena_array(arena, double, 3 * ports));
    FW_NEED(k->arm = fw_arena_array(arena, double, 2 * ports));
    FW_NEED(k->f = fw_arena_array(arena, double, 3 * ports));
    FW_NEED(k->stiffness = fw_arena_array(arena, double, 9 * ports * ports));
    FW_NEED(k->damping = fw_arena_array(arena, double, 9 * ports * ports));
    FW_NEED(k->pose = fw_arena_array(arena, double, (size_t)m->nq));
    return FW_OK;
}

fw_status fw_multibody_model_elements_new(fw_arena *arena, fw_multibody_model *m,
                                          const fw_effects_loads *loads, fw_geometry_vec2 centre) {
    int most = 0;
    if (loads->nelement == 0) return FW_OK;
    FW_NEED(m->element =
                fw_arena_array(arena, fw_multibody_model_element, (size_t)loads->nelement));
    m->nelement = loads->nelement;
    for (int i = 0; i < m->nelement; i++) {
        const fw_effects_force_element *own = &loads->element[i];
        FW_TRY(element_new(arena, m, own, centre, &m->element[i]));
        most = own->ports > most ? own->ports : most;
        m->nswitch += own->switches;
        if (own->pin != FW_NONE) m->pin_element[own->pin] = i;
    }
    return work_new(arena, m, (size_t)most);
}

/* what an element sees at y; also the arms of its ports. The model is posed at y. */
static fw_effects_port_state look(const fw_multibody_model *m, const fw_multibody_model_element *e,
                                  double t, const double *y) {
    const fw_multibody_element_work *k = &m->port;
    const double length = m->scale.length_m, per_s = 1 / m->scale.time_s;
    for (int i = 0; i < e->own->ports; i++) {
        const int b = e->body[i];
        const fw_effects_port *at = &e->scaled.port[i];
        double rx = m->cosine[b] * at->x_m - m->sine[b] * at->y_m;
        double ry = m->sine[b] * at->x_m + m->cosine[b] * at->y_m;
        double *p = k->p + 3 * i, *w = k->w + 3 * i;
        k->arm[2 * i] = rx, k->arm[2 * i + 1] = ry;
        if (b == m->nbody) {
            p[0] = length * rx, p[1] = length * ry, p[2] = 0;
            w[0] = w[1] = w[2] = 0;
            if (m->stretch.law) { /* and moves */
                const double local[2] = {at->x_m, at->y_m};
                double gain[2];
                fw_multibody_stretch_gain(m, local, gain);
                for (int c = 0; c < 2; c++) {
                    p[c] += length * gain[c] * m->stretch.now[0];
                    w[c] = m->held_s < 0 ? length * per_s * gain[c] * m->stretch.now[1] : 0;
                }
            }
            continue;
        }
        const double *x = m->origin + 3 * b, *u = y + 3 * b, *v = y + m->nq + 3 * b;
        p[0] = length * (x[0] + u[0] + rx), p[1] = length * (x[1] + u[1] + ry), p[2] = x[2] + u[2];
        w[0] = length * per_s * (v[0] - v[2] * ry);
        w[1] = length * per_s * (v[1] + v[2] * rx);
        w[2] = per_s * v[2];
    }
    return (fw_effects_port_state){.t_s = m->held_s >= 0 ? m->held_s : t * m->scale.time_s,
                                   .piece_s = m->piece,
                                   .load = e->electrodes ? m->drive : m->actuation,
                                   .p = k->p,
                                   .w = k->w,
                                   .on = e->on,
                                   .still = m->held_s >= 0};
}

void fw_multibody_model_element_forces(fw_multibody_model *m, double t, const double *y) {
    const double unit = 1 / fw_multibody_newton(m), per_length = 1 / m->scale.length_m;
    for (int i = 0; i < m->nelement; i++) {
        fw_multibody_model_element *e = &m->element[i];
        const fw_effects_port_state seen = look(m, e, t, y);
        e->own->class_->force(e->own, &seen, e->f);
        for (int k = 0; k < e->own->ports; k++) { /* the ground has no mass terms: 0 */
            const int b = e->body[k];
            const double *r = m->port.arm + 2 * k, *f = e->f + 3 * k;
            double fx = unit * f[0], fy = unit * f[1], *a = m->accel + 3 * b;
            a[0] += m->minv[b] * fx;
            a[1] += m->minv[b] * fy;
            a[2] += m->jinv[b] * (r[0] * fy - r[1] * fx + unit * per_length * f[2]);
        }
    }
}

/* force += generalised forces of m->port.f, N and N m at the ports that were looked at last */
static void push(const fw_multibody_model *m, const fw_multibody_model_element *e, double *force) {
    const double unit = 1 / fw_multibody_newton(m), per_length = 1 / m->scale.length_m;
    for (int k = 0; k < e->own->ports; k++) {
        const int b = e->body[k];
        const double *r = m->port.arm + 2 * k, *f = m->port.f + 3 * k;
        if (b == m->nbody) continue;
        double fx = unit * f[0], fy = unit * f[1];
        force[3 * b] += fx;
        force[3 * b + 1] += fy;
        force[3 * b + 2] += r[0] * fy - r[1] * fx + unit * per_length * f[2];
    }
}

void fw_multibody_model_element_driven(fw_multibody_model *m, double t, const double *y,
                                       double *force) {
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_model_element *e = &m->element[i];
        if (!e->own->works) continue;
        const fw_effects_port_state seen = look(m, e, t, y);
        e->own->class_->force(e->own, &seen, m->port.f);
        push(m, e, force);
    }
}

void fw_multibody_model_element_slope(fw_multibody_model *m, double t, const double *y,
                                      double *force) {
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_model_element *e = &m->element[i];
        double rate = e->electrodes ? m->drive_rate : m->actuation_rate;
        if (!e->own->class_->slope || rate == 0) continue;
        const fw_effects_port_state seen = look(m, e, t, y);
        e->own->class_->slope(e->own, &seen, m->port.f);
        for (int k = 0; k < 3 * e->own->ports; k++)
            m->port.f[k] *= rate;
        push(m, e, force);
    }
}

/* W: what the moving ground gives through the ports on it */
static double fed_by_ground(const fw_multibody_model *m, const fw_multibody_model_element *e,
                            const fw_effects_port_state *seen) {
    double power = 0;
    e->own->class_->force(e->own, seen, m->port.f);
    for (int k = 0; k < e->own->ports; k++)
        if (e->body[k] == m->nbody)
            power -= m->port.f[3 * k] * seen->w[3 * k] + m->port.f[3 * k + 1] * seen->w[3 * k + 1];
    return power;
}

/* W per scaled unit of power: newton L / T */
void fw_multibody_model_element_power(const fw_multibody_model *m, double t, const double *y,
                                      double power[2]) {
    const double unit = m->scale.time_s / (fw_multibody_newton(m) * m->scale.length_m);
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_model_element *e = &m->element[i];
        double now[2] = {0, 0};
        if (!e->own->class_->power && !m->stretch.law) continue;
        const fw_effects_port_state seen = look(m, e, t, y);
        if (e->own->class_->power) e->own->class_->power(e->own, &seen, now);
        if (m->stretch.law) now[1] += fed_by_ground(m, e, &seen);
        power[0] += unit * now[0], power[1] += unit * now[1];
    }
}

double fw_multibody_model_element_energy(const fw_multibody_model *m, double t, const double *y,
                                         bool driven) {
    const double unit = 1 / (fw_multibody_newton(m) * m->scale.length_m);
    double energy = 0;
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_model_element *e = &m->element[i];
        if (!e->own->class_->energy || (e->own->works && !driven)) continue;
        const fw_effects_port_state seen = look(m, e, t, y);
        energy += unit * e->own->class_->energy(e->own, &seen);
    }
    return energy;
}

/* SI to scaled: row i times 1/(newton, newton, newton L), column j times (L, L, 1), rates over T */
static void scale_tangent(const fw_multibody_model *m, int n) {
    const double length = m->scale.length_m, force = 1 / fw_multibody_newton(m),
                 per_s = 1 / m->scale.time_s;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double unit = force * (i % 3 == 2 ? 1 / length : 1) * (j % 3 == 2 ? 1 : length);
            m->port.stiffness[i * n + j] *= unit;
            m->port.damping[i * n + j] *= unit * per_s;
        }
    for (int i = 0; i < n; i++)
        m->port.f[i] *= force * (i % 3 == 2 ? 1 / length : 1);
}

void fw_multibody_model_element_tangent(const fw_multibody_model *m, double t, const double *y,
                                        double *stiffness, double *damping) {
    const fw_multibody_element_work *k = &m->port;
    for (int i = 0; i < m->nq; i++)
        k->pose[i] = m->origin[i] + y[i];
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_model_element *e = &m->element[i];
        const fw_effects_port_state seen = look(m, e, t, y);
        e->own->class_->force(e->own, &seen, k->f);
        e->own->class_->tangent(e->own, &seen, k->stiffness, k->damping);
        scale_tangent(m, 3 * e->own->ports);
        fw_effects_element_spread(&e->scaled, m->nbody, k->pose, y + m->nq, k->f, k->stiffness,
                                  k->damping, stiffness, damping);
    }
}

fw_multibody_model_element *fw_multibody_model_element_switch(const fw_multibody_model *m, int i,
                                                              int *which) {
    fw_multibody_model_element *e = m->element;
    while (i >= e->own->switches)
        i -= e->own->switches, e++;
    *which = i;
    return e;
}

double fw_multibody_model_element_switch_value(const fw_multibody_model *m,
                                               const fw_multibody_model_element *e, double t, int i,
                                               const double *y) {
    const fw_effects_port_state seen = look(m, e, t, y);
    return e->own->class_->switch_value(e->own, &seen, i);
}

const fw_effects_force_element *fw_multibody_model_element_invalid(const fw_multibody_model *m,
                                                                   double t, const double *y,
                                                                   const char **why) {
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_model_element *e = &m->element[i];
        if (!e->own->class_->valid) continue;
        const fw_effects_port_state seen = look(m, e, t, y);
        if (!e->own->class_->valid(e->own, &seen, why)) return e->own;
    }
    return NULL;
}

double fw_multibody_model_element_pressing(const fw_multibody_model *m, int i, double t,
                                           const double *y) {
    const fw_multibody_model_element *e = &m->element[i];
    const fw_effects_port_state seen = look(m, e, t, y);
    return e->own->class_->pressing(e->own, &seen) / fw_multibody_newton(m);
}
