/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force elements on the model's bodies (effects/effects.h): from the pose to what the ports see, in
   SI, from their forces to accelerations and generalised forces, from their tangents to the
   model's.

   A port at the local point s of a body stands at p = (x + r, phi) with the arm r = R(phi) s and
   moves with w = (v + omega (-r_y, r_x), omega); a force f with a couple on it is the generalised
   force (f, r x f + couple). Positions are counted from the model's centre, so that far-away
   coordinates cost no digits. Units: model.h in, SI to the classes, scaled units out. Error:
   round-off. Cost: the classes', and some twenty operations per port. Test: test_elements.c. */
#include "multibody/multibody_scratch.h"
#include <math.h>
#include <string.h>

static fw_status element_new(fw_arena *arena, const fw_multibody_model *m,
                             const fw_effects_force_element *own, fw_geometry_vec2 centre,
                             fw_multibody_element *e) {
    size_t ports = (size_t)own->ports;
    double length = m->scale.length_m;
    *e = (fw_multibody_element){.own = own,
                                .electrodes = own->class_->electrodes,
                                .scaled = *own,
                                .first_switch = m->nswitch,
                                .first_port = m->nport};
    FW_NEED(e->scaled.port = fw_arena_array(arena, fw_effects_port, ports));
    FW_NEED(e->body = fw_arena_array(arena, int, ports));
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

fw_status fw_multibody_elements_new(fw_arena *arena, fw_multibody_model *m,
                                    const fw_effects_loads *loads, fw_geometry_vec2 centre) {
    if (loads->nelement == 0) return FW_OK;
    FW_NEED(m->element = fw_arena_array(arena, fw_multibody_element, (size_t)loads->nelement));
    m->nelement = loads->nelement;
    for (int i = 0; i < m->nelement; i++) {
        const fw_effects_force_element *own = &loads->element[i];
        FW_TRY(element_new(arena, m, own, centre, &m->element[i]));
        m->most_ports = own->ports > m->most_ports ? own->ports : m->most_ports;
        m->nswitch += own->switches;
        m->nport += own->ports;
        if (own->pin != FW_NONE) m->pin_element[own->pin] = i;
    }
    return FW_OK;
}

/* what an element sees; also the arms of its ports */
static fw_effects_port_state look(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                  const fw_multibody_element *e, const double *velocity) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_loading *l = &sys->loading;
    const fw_multibody_ports *k = &sys->work->port;
    const double length = m->scale.length_m, per_s = 1 / m->scale.time_s;
    for (int i = 0; i < e->own->ports; i++) {
        const int b = e->body[i];
        const fw_effects_port *at = &e->scaled.port[i];
        double rx = pose->cosine[b] * at->x_m - pose->sine[b] * at->y_m;
        double ry = pose->sine[b] * at->x_m + pose->cosine[b] * at->y_m;
        double *p = k->p + 3 * i, *w = k->w + 3 * i;
        k->arm[2 * i] = rx, k->arm[2 * i + 1] = ry;
        if (b == m->nbody) {
            p[0] = length * rx, p[1] = length * ry, p[2] = 0;
            w[0] = w[1] = w[2] = 0;
            if (m->stretch.law) { /* and moves */
                const fw_geometry_vec2 root = fw_effects_element_root(e->own, i);
                const double local[2] = {at->x_m + root.x / length, at->y_m + root.y / length};
                double gain[2];
                fw_multibody_stretch_gain(m, local, gain);
                for (int c = 0; c < 2; c++) {
                    p[c] += length * gain[c] * pose->ground[0];
                    w[c] = l->hold.on ? 0 : length * per_s * gain[c] * pose->ground[1];
                }
            }
            continue;
        }
        const double *x = m->origin + 3 * b, *u = pose->u + 3 * b, *v = velocity + 3 * b;
        p[0] = length * (x[0] + u[0] + rx), p[1] = length * (x[1] + u[1] + ry), p[2] = x[2] + u[2];
        w[0] = length * per_s * (v[0] - v[2] * ry);
        w[1] = length * per_s * (v[1] + v[2] * rx);
        w[2] = per_s * v[2];
    }
    return (fw_effects_port_state){.t_s = l->hold.on ? l->hold.t_s : pose->t * m->scale.time_s,
                                   .piece_s = sys->piece_s,
                                   .load = e->electrodes ? l->drive : l->actuation,
                                   .p = k->p,
                                   .w = k->w,
                                   .on = sys->on.element + e->first_switch,
                                   .still = l->hold.on};
}

void fw_multibody_element_forces(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 const double *v) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_solution *found = &sys->work->solution;
    const double unit = 1 / fw_multibody_newton(m), per_length = 1 / m->scale.length_m;
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        const fw_effects_port_state state = look(sys, pose, e, v);
        double *own = found->element + 3 * e->first_port;
        e->own->class_->force(e->own, &state, own);
        for (int k = 0; k < e->own->ports; k++) { /* the ground has no mass terms: 0 */
            const int b = e->body[k];
            const double *r = sys->work->port.arm + 2 * k, *f = own + 3 * k;
            double fx = unit * f[0], fy = unit * f[1], *a = found->accel + 3 * b;
            a[0] += m->minv[b] * fx;
            a[1] += m->minv[b] * fy;
            a[2] += m->jinv[b] * (r[0] * fy - r[1] * fx + unit * per_length * f[2]);
        }
    }
}

/* force += generalised forces of port.f, N and N m at the ports of the element looked at */
static void push(const fw_multibody_system *sys, const fw_multibody_element *e, double *force) {
    const fw_multibody_model *m = sys->model;
    const double unit = 1 / fw_multibody_newton(m), per_length = 1 / m->scale.length_m;
    for (int k = 0; k < e->own->ports; k++) {
        const int b = e->body[k];
        const double *r = sys->work->port.arm + 2 * k, *f = sys->work->port.f + 3 * k;
        if (b == m->nbody) continue;
        double fx = unit * f[0], fy = unit * f[1];
        force[3 * b] += fx;
        force[3 * b + 1] += fy;
        force[3 * b + 2] += r[0] * fy - r[1] * fx + unit * per_length * f[2];
    }
}

void fw_multibody_element_driven(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 const double *v, double *force) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        if (!e->own->works) continue;
        const fw_effects_port_state state = look(sys, pose, e, v);
        e->own->class_->force(e->own, &state, sys->work->port.f);
        push(sys, e, force);
    }
}

void fw_multibody_element_slope(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v, double *force) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        double rate = e->electrodes ? sys->loading.drive_rate : sys->loading.actuation_rate;
        if (!e->own->class_->slope || rate == 0) continue;
        const fw_effects_port_state state = look(sys, pose, e, v);
        e->own->class_->slope(e->own, &state, sys->work->port.f);
        for (int k = 0; k < 3 * e->own->ports; k++)
            sys->work->port.f[k] *= rate;
        push(sys, e, force);
    }
}

/* W: what the moving ground gives through the ports on it */
static double fed_by_ground(const fw_multibody_system *sys, const fw_multibody_element *e,
                            const fw_effects_port_state *state) {
    double power = 0, *f = sys->work->port.f;
    e->own->class_->force(e->own, state, f);
    for (int k = 0; k < e->own->ports; k++)
        if (e->body[k] == sys->model->nbody)
            power -= f[3 * k] * state->w[3 * k] + f[3 * k + 1] * state->w[3 * k + 1];
    return power;
}

/* W per scaled unit of power: newton L / T */
void fw_multibody_element_power(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v, double power[2]) {
    const fw_multibody_model *m = sys->model;
    const double unit = m->scale.time_s / (fw_multibody_newton(m) * m->scale.length_m);
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        double now[2] = {0, 0};
        bool own = e->own->class_->power && (e->own->dissipates || e->own->works);
        if (!own && !m->stretch.law) continue;
        const fw_effects_port_state state = look(sys, pose, e, v);
        if (own) e->own->class_->power(e->own, &state, now);
        if (m->stretch.law) now[1] += fed_by_ground(sys, e, &state);
        power[0] += unit * now[0], power[1] += unit * now[1];
    }
}

double fw_multibody_element_energy(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                   const double *v, bool driven) {
    const fw_multibody_model *m = sys->model;
    const double unit = 1 / (fw_multibody_newton(m) * m->scale.length_m);
    double energy = 0;
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        if (!e->own->class_->energy || (e->own->works && !driven)) continue;
        const fw_effects_port_state state = look(sys, pose, e, v);
        energy += unit * e->own->class_->energy(e->own, &state);
    }
    return energy;
}

/* SI to scaled: row i times 1/(newton, newton, newton L), column j times (L, L, 1), rates over T */
static void scale_tangent(const fw_multibody_system *sys, int n) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_ports *k = &sys->work->port;
    const double length = m->scale.length_m, force = 1 / fw_multibody_newton(m),
                 per_s = 1 / m->scale.time_s;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double unit = force * (i % 3 == 2 ? 1 / length : 1) * (j % 3 == 2 ? 1 : length);
            k->stiffness[i * n + j] *= unit;
            k->damping[i * n + j] *= unit * per_s;
        }
    for (int i = 0; i < n; i++)
        k->f[i] *= force * (i % 3 == 2 ? 1 / length : 1);
}

void fw_multibody_element_tangent(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                  const double *v, double *stiffness, double *damping) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_ports *k = &sys->work->port;
    for (int i = 0; i < m->nq; i++)
        k->pose[i] = m->origin[i] + pose->u[i];
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        const fw_effects_port_state state = look(sys, pose, e, v);
        e->own->class_->force(e->own, &state, k->f);
        e->own->class_->tangent(e->own, &state, k->stiffness, k->damping);
        scale_tangent(sys, 3 * e->own->ports);
        fw_effects_element_spread(&e->scaled, m->nbody, k->pose, v, k->f, k->stiffness, k->damping,
                                  stiffness, damping);
    }
}

double fw_multibody_element_switch_value(const fw_multibody_system *sys,
                                         const fw_multibody_pose *pose,
                                         const fw_multibody_element *e, int i, const double *v) {
    const fw_effects_port_state state = look(sys, pose, e, v);
    return e->own->class_->switch_value(e->own, &state, i);
}

const fw_effects_force_element *fw_multibody_element_invalid(const fw_multibody_system *sys,
                                                             const fw_multibody_pose *pose,
                                                             const double *v, const char **why) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        if (!e->own->class_->valid) continue;
        const fw_effects_port_state state = look(sys, pose, e, v);
        if (!e->own->class_->valid(e->own, &state, why)) return e->own;
    }
    return NULL;
}

double fw_multibody_element_pressing(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                     int i, const double *v) {
    const fw_multibody_element *e = &sys->model->element[i];
    const fw_effects_port_state state = look(sys, pose, e, v);
    return e->own->class_->pressing(e->own, &state) / fw_multibody_newton(sys->model);
}
