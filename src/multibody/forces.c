/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Applied forces of the active effects: force elements on the model's bodies, and all that acts. */
#include "multibody/multibody_scratch.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- force elements ---- */

/* Force elements on the model's bodies (effects/effects.h): from the pose to what the ports see, in
   SI, from their forces to accelerations and generalised forces, from their tangents to the
   model's.

   A port at the local point s of a body stands at p = (x + r, phi) with the arm r = R(phi) s and
   moves with w = (v + omega (-r_y, r_x), omega); a force f with a couple on it is the generalised
   force (f, r x f + couple). Positions are counted from the model's centre, so that far-away
   coordinates cost no digits. Units: model.h in, SI to the classes, scaled units out. Error:
   round-off. Cost: the classes', and some twenty operations per port. Test: test_elements.c. */

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
    return fw_effects_beside_new(arena, m->nelement, loads->element, &m->beside);
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
        const int own = e->first_port + i;
        double *p = k->p + 3 * own, *w = k->w + 3 * own;
        k->arm[2 * own] = rx, k->arm[2 * own + 1] = ry;
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
                                   .p = k->p + 3 * e->first_port,
                                   .w = k->w + 3 * e->first_port,
                                   .on = sys->on.element + e->first_switch,
                                   .still = l->hold.on};
}

/* accel += M^-1 Q */
static void element_forces(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                           const double *v) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_solution *found = &sys->work->solution;
    const double unit = 1 / fw_multibody_newton(m), per_length = 1 / m->scale.length_m;
    fw_effects_port_state *seen = sys->work->port.seen;
    for (int i = 0; i < m->nelement; i++)
        seen[i] = look(sys, pose, &m->element[i], v);
    if (m->beside) fw_effects_beside_bend(m->beside, sys->work->port.p);
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        double *own = found->element + 3 * e->first_port;
        e->own->class_->force(e->own, &seen[i], own);
        for (int k = 0; k < e->own->ports; k++) { /* the ground has no mass terms: 0 */
            const int b = e->body[k];
            const double *r = sys->work->port.arm + 2 * (e->first_port + k), *f = own + 3 * k;
            double fx = unit * f[0], fy = unit * f[1], *a = found->accel + 3 * b;
            a[0] += m->minv[b] * fx;
            a[1] += m->minv[b] * fy;
            a[2] += m->jinv[b] * (r[0] * fy - r[1] * fx + unit * per_length * f[2]);
        }
    }
}

/* force += generalised forces of port.f, N and N m at the ports of the element looked at */
static void push_ports(const fw_multibody_system *sys, const fw_multibody_element *e,
                       double *force) {
    const fw_multibody_model *m = sys->model;
    const double unit = 1 / fw_multibody_newton(m), per_length = 1 / m->scale.length_m;
    for (int k = 0; k < e->own->ports; k++) {
        const int b = e->body[k];
        const double *r = sys->work->port.arm + 2 * (e->first_port + k);
        const double *f = sys->work->port.f + 3 * k;
        if (b == m->nbody) continue;
        double fx = unit * f[0], fy = unit * f[1];
        force[3 * b] += fx;
        force[3 * b + 1] += fy;
        force[3 * b + 2] += r[0] * fy - r[1] * fx + unit * per_length * f[2];
    }
}

void fw_multibody_element_driven(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 const double *v, bool pins, double *force) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nelement; i++) {
        const fw_multibody_element *e = &m->element[i];
        if (pins ? e->own->pin == FW_NONE : !e->own->works) continue;
        const fw_effects_port_state state = look(sys, pose, e, v);
        e->own->class_->force(e->own, &state, sys->work->port.f);
        push_ports(sys, e, force);
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
        push_ports(sys, e, force);
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

/* power +=; W per scaled unit of power: newton L / T */
static void element_power(const fw_multibody_system *sys, const fw_multibody_pose *pose,
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
                                  const double *v, const fw_effects_matrix *stiffness,
                                  const fw_effects_matrix *damping) {
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
        fw_effects_element_spread(&e->scaled, k->pose, v, k->f, k->stiffness, k->damping, stiffness,
                                  damping);
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

/* ---- all that acts ---- */

/* Applied forces of the active effects, as accelerations M^-1 Q; each kind is one loop that does
   not run when it is empty. Scaled units.

   torsion   torque -k angle - c rate between two bodies
   stop      the same beyond an angle, while it touches
   load      constant force at a point; timed: force and torque times a law
   spring    k (l - l0) + c l' along the line between two points; a cable only while taut. Where
             the points meet, along their relative velocity, which is where the line comes to lie
             next: the damping force is continuous there along every motion
   slide     -k s - c s' along the axis of a prismatic joint
   elements  above
   Test: test_simulate.c, test_constraints.c (against the derivative of the energy). */

static void push(const fw_multibody_system *sys, int body, double rx, double ry, double fx,
                 double fy) {
    const fw_multibody_model *m = sys->model;
    double *a = sys->work->solution.accel + 3 * body;
    a[0] += m->minv[body] * fx;
    a[1] += m->minv[body] * fy;
    a[2] += m->jinv[body] * (rx * fy - ry * fx);
}

static void twist(const fw_multibody_system *sys, int a, int b, double torque) {
    double *accel = sys->work->solution.accel;
    accel[3 * a + 2] -= sys->model->jinv[a] * torque;
    accel[3 * b + 2] += sys->model->jinv[b] * torque;
}

static double difference(const fw_multibody_model *m, const double *x, int a, int b) {
    return (b < m->nbody ? x[3 * b + 2] : 0) - (a < m->nbody ? x[3 * a + 2] : 0);
}

double fw_multibody_spring_round_off(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                     int i) {
    const fw_multibody_spring *s = &m->spring[i];
    const double *a = m->origin + 3 * s->a, *b = m->origin + 3 * s->b;
    const double *end = pose->spring_end + 4 * i;
    double reach = fabs(a[0]) + fabs(a[1]) + fabs(b[0]) + fabs(b[1]);
    return 64 * DBL_EPSILON * (reach + fabs(end[0]) + fabs(end[1]) + fabs(end[2]) + fabs(end[3]));
}

fw_multibody_pull fw_multibody_pull_of(const fw_multibody_system *sys,
                                       const fw_multibody_pose *pose, int spring, const double *v) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_spring *s = &m->spring[spring];
    const double *u = pose->u, *end = pose->spring_end + 4 * spring;
    double state[2][6] = {{0}}; /* x, y, vx, vy of each point, then the arm */
    const int body[2] = {s->a, s->b};
    for (int i = 0; i < 2; i++) {
        int b = body[i];
        double rx = pose->cosine[b] * end[2 * i] - pose->sine[b] * end[2 * i + 1];
        double ry = pose->sine[b] * end[2 * i] + pose->cosine[b] * end[2 * i + 1];
        double *p = state[i];
        p[4] = rx, p[5] = ry;
        p[0] = m->origin[3 * b] + rx, p[1] = m->origin[3 * b + 1] + ry;
        if (b == m->nbody && m->stretch.law && !sys->loading.hold.on) {
            const double *grows = m->stretch.spring + 4 * spring + 2 * i;
            p[2] = pose->ground[1] * grows[0], p[3] = pose->ground[1] * grows[1];
        }
        if (b == m->nbody) continue;
        p[0] += u[3 * b], p[1] += u[3 * b + 1];
        p[2] = v[3 * b] - v[3 * b + 2] * ry;
        p[3] = v[3 * b + 1] + v[3 * b + 2] * rx;
    }
    double dx = state[1][0] - state[0][0], dy = state[1][1] - state[0][1];
    double wx = state[1][2] - state[0][2], wy = state[1][3] - state[0][3];
    double length = sqrt(dx * dx + dy * dy), size = length;
    if (length <= fw_multibody_spring_round_off(m, pose, spring) && (wx != 0 || wy != 0))
        dx = wx, dy = wy, size = sqrt(wx * wx + wy * wy);
    double inverse = size > 0 ? 1 / size : 0, ux = dx * inverse, uy = dy * inverse;
    double rate = ux * wx + uy * wy;
    return (fw_multibody_pull){state[0][4], state[0][5], state[1][4], state[1][5],
                               ux,          uy,          length,      rate};
}

/* e.d - free length of a prismatic joint, and its rate */
static void slide_travel(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                         const fw_multibody_slide *s, const double *v, double *travel,
                         double *rate) {
    const fw_multibody_model *m = sys->model;
    double d[2], e[2], n[2], psi_rate = 0;
    const double *arm = pose->arm + 4 * s->block;
    fw_multibody_frame(m, pose, s->block, d, e, n);
    *travel = e[0] * d[0] + e[1] * d[1] - s->free;
    for (int side = 0; side < 2; side++) {
        int b = side ? s->b : s->a;
        if (b == m->nbody) continue;
        const double *w = v + 3 * b, *r = arm + 2 * side;
        double vx = w[0] - w[2] * r[1], vy = w[1] + w[2] * r[0];
        psi_rate += (side ? 1 : -1) * (e[0] * vx + e[1] * vy);
        if (!side) psi_rate += w[2] * (n[0] * d[0] + n[1] * d[1]);
    }
    if (m->stretch.law && !sys->loading.hold.on) {
        const double *grows = m->stretch.block + 2 * s->block;
        psi_rate += pose->ground[1] * (e[0] * grows[0] + e[1] * grows[1]);
    }
    *rate = psi_rate;
}

void fw_multibody_stop_travel(const fw_multibody_model *m, const fw_multibody_pose *pose,
                              const fw_multibody_stop *s, const double *v, double *past,
                              double *rate) {
    *past = s->side * (difference(m, pose->u, s->a, s->b) - s->at);
    *rate = s->side * difference(m, v, s->a, s->b);
}

static void turning(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                    const double *v) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *t = &m->torsion[i];
        double angle = t->angle0 + difference(m, pose->u, t->a, t->b);
        twist(sys, t->a, t->b, -t->k * angle - t->c * difference(m, v, t->a, t->b));
    }
    for (int i = 0; i < m->nstop; i++) {
        const fw_multibody_stop *s = &m->stop[i];
        double past, rate;
        if (!sys->on.stop[i]) continue;
        fw_multibody_stop_travel(m, pose, s, v, &past, &rate);
        twist(sys, s->a, s->b, -s->side * (s->k * past + s->c * rate));
    }
}

static void loads(const fw_multibody_system *sys, const fw_multibody_pose *pose) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nload; i++) {
        const fw_multibody_load *l = &m->load[i];
        double c = pose->cosine[l->body], s = pose->sine[l->body];
        const double *f = sys->loading.force + 2 * i;
        push(sys, l->body, c * l->x - s * l->y, s * l->x + c * l->y, f[0], f[1]);
    }
    for (int i = 0; i < m->ntimed; i++) {
        const fw_multibody_timed_load *l = &m->timed[i];
        double c = pose->cosine[l->body], s = pose->sine[l->body], factor[3];
        fw_quantity_law_value(l->law, pose->t * m->scale.time_s, sys->piece_s, factor);
        push(sys, l->body, c * l->x - s * l->y, s * l->x + c * l->y, factor[0] * l->fx,
             factor[0] * l->fy);
        sys->work->solution.accel[3 * l->body + 2] += m->jinv[l->body] * factor[0] * l->torque;
    }
}

static void springs(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                    const double *v) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nspring; i++) {
        const fw_multibody_spring *s = &m->spring[i];
        if (!sys->on.spring[i]) continue;
        fw_multibody_pull p = fw_multibody_pull_of(sys, pose, i, v);
        double f = s->k * (p.length - s->length) + s->c * p.rate;
        push(sys, s->a, p.ax, p.ay, f * p.ux, f * p.uy);
        push(sys, s->b, p.bx, p.by, -f * p.ux, -f * p.uy);
    }
    for (int i = 0; i < m->nslide; i++) { /* acts where both bodies have the joint's point b */
        const fw_multibody_slide *s = &m->slide[i];
        const double *r = pose->arm + 4 * s->block;
        double d[2], e[2], n[2], travel, rate;
        fw_multibody_frame(m, pose, s->block, d, e, n);
        slide_travel(sys, pose, s, v, &travel, &rate);
        double f = s->k * travel + s->c * rate;
        push(sys, s->a, r[0] + d[0], r[1] + d[1], f * e[0], f * e[1]);
        push(sys, s->b, r[2], r[3], -f * e[0], -f * e[1]);
    }
}

const fw_multibody_solution *fw_multibody_forces(fw_multibody_system *sys,
                                                 const fw_multibody_pose *pose, const double *v) {
    fw_multibody_solution *found = &sys->work->solution;
    for (int i = 0; i < sys->model->nq + 3; i++) /* the ground's three zeros too */
        found->accel[i] = sys->loading.constant[i];
    turning(sys, pose, v);
    loads(sys, pose);
    springs(sys, pose, v);
    if (sys->model->nelement > 0) element_forces(sys, pose, v);
    return found;
}

static double taken(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                    const double *v) {
    const fw_multibody_model *m = sys->model;
    double power = 0, a, rate;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *t = &m->torsion[i];
        rate = difference(m, v, t->a, t->b);
        power += t->c * rate * rate;
    }
    for (int i = 0; i < m->nstop; i++)
        if (sys->on.stop[i] && m->stop[i].c > 0) {
            fw_multibody_stop_travel(m, pose, &m->stop[i], v, &a, &rate);
            power += m->stop[i].c * rate * rate;
        }
    for (int i = 0; i < m->nspring; i++)
        if (sys->on.spring[i] && m->spring[i].c > 0) {
            rate = fw_multibody_pull_of(sys, pose, i, v).rate;
            power += m->spring[i].c * rate * rate;
        }
    for (int i = 0; i < m->nslide; i++)
        if (m->slide[i].c > 0) {
            slide_travel(sys, pose, &m->slide[i], v, &a, &rate);
            power += m->slide[i].c * rate * rate;
        }
    return power;
}

/* What a moving ground (constraints.c) feeds in: force on its point times its velocity, with the
   opposite sign: springs k (l - l0) + c l' along the line, slides likewise along the axis of their
   joint */
static double stretch_power(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                            const double *v) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_stretch *s = &m->stretch;
    double power = 0, speed = pose->ground[1];
    for (int i = 0; i < m->nspring; i++) {
        const fw_multibody_spring *p = &m->spring[i];
        const double *g = s->spring + 4 * i;
        if (!sys->on.spring[i] || (p->a != m->nbody && p->b != m->nbody)) continue;
        fw_multibody_pull l = fw_multibody_pull_of(sys, pose, i, v);
        double f = p->k * (l.length - p->length) + p->c * l.rate;
        power += f * speed * (l.ux * (g[2] - g[0]) + l.uy * (g[3] - g[1]));
    }
    for (int i = 0; i < m->nslide; i++) {
        const fw_multibody_slide *p = &m->slide[i];
        const double *g = s->block + 2 * p->block;
        double d[2], e[2], n[2], travel, rate;
        fw_multibody_frame(m, pose, p->block, d, e, n);
        slide_travel(sys, pose, p, v, &travel, &rate);
        power += (p->k * travel + p->c * rate) * speed * (e[0] * g[0] + e[1] * g[1]);
    }
    return power;
}

void fw_multibody_power(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                        const double *v, double power[2]) {
    const fw_multibody_model *m = sys->model;
    power[0] = m->dissipated >= 0 ? taken(sys, pose, v) : 0;
    power[1] = 0;
    for (int i = 0; i < m->ntimed; i++) {
        const fw_multibody_timed_load *l = &m->timed[i];
        const double *w = v + 3 * l->body;
        double c = pose->cosine[l->body], s = pose->sine[l->body], factor[3];
        double rx = c * l->x - s * l->y, ry = s * l->x + c * l->y;
        fw_quantity_law_value(l->law, pose->t * m->scale.time_s, sys->piece_s, factor);
        power[1] += factor[0] *
                    (l->fx * (w[0] - w[2] * ry) + l->fy * (w[1] + w[2] * rx) + l->torque * w[2]);
    }
    if (m->nelement > 0) element_power(sys, pose, v, power);
    if (m->stretch.law) power[1] += stretch_power(sys, pose, v);
}

/* ---- energy ---- */

static double work_of_loads(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                            const double *u) {
    const fw_multibody_model *m = sys->model;
    const double *constant = sys->loading.constant;
    double work = 0;
    for (int b = 0; b < m->nbody; b++)
        for (int c = 0; c < 3; c++)
            work += (c < 2 ? m->mass[b] : m->inertia[b]) * constant[3 * b + c] * u[3 * b + c];
    for (int i = 0; i < m->nload; i++) {
        const fw_multibody_load *l = &m->load[i];
        const double *f = sys->loading.force + 2 * i;
        double c = pose->cosine[l->body], s = pose->sine[l->body];
        double c0 = cos(m->origin[3 * l->body + 2]), s0 = sin(m->origin[3 * l->body + 2]);
        double dx = u[3 * l->body] + (c - c0) * l->x - (s - s0) * l->y;
        double dy = u[3 * l->body + 1] + (s - s0) * l->x + (c - c0) * l->y;
        work += f[0] * dx + f[1] * dy;
    }
    return work;
}

static double stored(const fw_multibody_system *sys, const fw_multibody_pose *pose, const double *u,
                     const double *v) {
    const fw_multibody_model *m = sys->model;
    double energy = 0, stretch, rate;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *s = &m->torsion[i];
        stretch = s->angle0 + (s->b < m->nbody ? u[3 * s->b + 2] : 0) -
                  (s->a < m->nbody ? u[3 * s->a + 2] : 0);
        energy += 0.5 * s->k * stretch * stretch;
    }
    for (int i = 0; i < m->nstop; i++) {
        if (!sys->on.stop[i]) continue;
        fw_multibody_stop_travel(m, pose, &m->stop[i], v, &stretch, &rate);
        energy += 0.5 * m->stop[i].k * stretch * stretch;
    }
    for (int i = 0; i < m->nspring; i++) {
        if (!sys->on.spring[i]) continue;
        stretch = fw_multibody_pull_of(sys, pose, i, v).length - m->spring[i].length;
        energy += 0.5 * m->spring[i].k * stretch * stretch;
    }
    for (int i = 0; i < m->nslide; i++) {
        slide_travel(sys, pose, &m->slide[i], v, &stretch, &rate);
        energy += 0.5 * m->slide[i].k * stretch * stretch;
    }
    return energy + (m->nelement > 0 ? fw_multibody_element_energy(sys, pose, v, true) : 0);
}

double fw_multibody_kinetic_energy(const fw_multibody_model *m, const double *v) {
    double sum = 0;
    for (int b = 0; b < m->nbody; b++)
        sum += 0.5 * (m->mass[b] * (v[3 * b] * v[3 * b] + v[3 * b + 1] * v[3 * b + 1]) +
                      m->inertia[b] * v[3 * b + 2] * v[3 * b + 2]);
    return sum;
}

/* T = v^T M v / 2; V of torsion springs, stops, point springs and slides, k x^2 / 2 each, and what
   elements say that they store at time t; W = work of constant loads from the assembled pose, and
   of drivers, timed loads and laws of elements as carried with the state; D = what dampers took,
   carried with the state. T + V + D - W is constant. Scaled units. Models that have a kernel need
   no pose: no loads, stops or springs at points. Test: test_simulate.c, test_constraints.c. */
fw_multibody_energy fw_multibody_energy_at(fw_multibody_system *sys, double t, const double *y) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = sys->kernel ? NULL : fw_multibody_pose_at(sys, t, y);
    const double *u = y, *v = y + m->nq;
    fw_multibody_energy e = {.dissipated = m->dissipated >= 0 ? y[m->dissipated] : 0};
    e.kinetic = fw_multibody_kinetic_energy(m, v);
    e.elastic = stored(sys, pose, u, v);
    e.work = work_of_loads(sys, pose, u) + (m->worked >= 0 ? y[m->worked] : 0);
    return e;
}
