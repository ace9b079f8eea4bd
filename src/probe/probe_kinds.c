/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of <probe>: what each takes of an instant, of a piece of a motion or of the modes about an
   equilibrium. A kind is its row here and its line in device/probes.def. */
#include "probe/probe.h"
#include <math.h>

/* ---- where the points of a probe are, and how they move ----
   p = x + R(phi) s, p' = v + omega (-r_y, r_x) with the arm r = R(phi) s; points of a ground that
   stretches: p + strain law (p - centre). In: poses and velocities in SI. Out: m, m/s. Error: round-off,
   1e-16 of world coordinates. Cost: a sine and a cosine. Test: test_probe.py. */

/* law of a stretching ground and its rate; 0 where there is none */
static double ground_stretch(const fw_probe *p, const fw_probe_state *s, int order) {
    const fw_effects_stretch *g = &p->loads.stretch;
    double value[3];
    if (!g->law || (order > 0 && s->still)) return 0;
    fw_quantity_law_value(g->law, s->t_s, s->piece_s, value);
    return g->strain * value[order];
}

static fw_geometry_vec2 from_centre(const fw_probe *p, const fw_effects_port *at) {
    const fw_geometry_vec2 c = p->loads.stretch.centre_m;
    return (fw_geometry_vec2){at->x_m - c.x, at->y_m - c.y};
}

static fw_geometry_vec2 arm(const fw_effects_port *at, const double *q) {
    double c = cos(q[3 * at->body + 2]), s = sin(q[3 * at->body + 2]);
    return (fw_geometry_vec2){c * at->x_m - s * at->y_m, s * at->x_m + c * at->y_m};
}

/* where the point on that side of the probe is, world */
static fw_geometry_vec2 point_of(const fw_probe *p, int side, const fw_probe_state *s) {
    const fw_effects_port *at = &p->point[side];
    if (at->body == FW_GROUND) {
        const fw_geometry_vec2 far = from_centre(p, at);
        double by = ground_stretch(p, s, 0);
        return (fw_geometry_vec2){at->x_m + by * far.x, at->y_m + by * far.y};
    }
    const fw_geometry_vec2 r = arm(at, s->q);
    return (fw_geometry_vec2){s->q[3 * at->body] + r.x, s->q[3 * at->body + 1] + r.y};
}

/* how it moves */
static fw_geometry_vec2 speed_of(const fw_probe *p, int side, const fw_probe_state *s) {
    const fw_effects_port *at = &p->point[side];
    if (at->body == FW_GROUND) {
        const fw_geometry_vec2 far = from_centre(p, at);
        double by = ground_stretch(p, s, 1);
        return (fw_geometry_vec2){by * far.x, by * far.y};
    }
    if (!s->v) return (fw_geometry_vec2){0, 0};
    const double *v = s->v + 3 * at->body;
    const fw_geometry_vec2 r = arm(at, s->q);
    return (fw_geometry_vec2){v[0] - v[2] * r.y, v[1] + v[2] * r.x};
}

static fw_effects_growth growth_of(const fw_probe *p, const fw_probe_state *s) {
    return fw_effects_growth_at(p->mechanism, &p->loads, s->t_s, s->piece_s, s->still);
}

/* m of a length in lengths of the layer, of which the model is made */
static double metres(const fw_probe *p, const fw_probe_state *s, double length) {
    return fw_effects_has_growth(&p->loads) ? (1 + growth_of(p, s).grown) * length : length;
}

static double turning(const fw_probe_state *s, int body) {
    return s->v && body != FW_GROUND ? s->v[3 * body + 2] : 0;
}

/* along the direction of the probe; where it has none the size */
static double along(const fw_probe *p, double x, double y) {
    double direction = p->asked->direction_rad;
    return isnan(direction) ? hypot(x, y) : x * cos(direction) + y * sin(direction);
}

/* ---- displacement, velocity, angle, distance and opening ---- */

/* against the point of the substrate that is drawn where the probe's point is */
static fw_geometry_vec2 displacement(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 now = point_of(p, 0, s);
    if (p->point[0].body == FW_GROUND) return (fw_geometry_vec2){0, 0};
    if (fw_effects_has_growth(&p->loads)) {
        const fw_effects_growth g = growth_of(p, s);
        return fw_effects_beside_substrate(&g, now, p->drawn[0]);
    }
    return (fw_geometry_vec2){now.x - p->drawn[0].x, now.y - p->drawn[0].y};
}

static double displacement_value(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 u = displacement(p, s);
    return along(p, u.x, u.y);
}

/* a quarter turn to the left of its direction; without a direction there is no across */
static double displacement_across(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 u = displacement(p, s);
    double direction = p->asked->direction_rad;
    return u.y * cos(direction) - u.x * sin(direction);
}

const fw_probe_row fw_probe_displacement = {.value = displacement_value,
                                            .across = displacement_across};

static double velocity(const fw_probe *p, const fw_probe_state *s) {
    if (!s->v && !s->still) return (double)NAN;
    fw_geometry_vec2 v = speed_of(p, 0, s);
    if (fw_effects_has_growth(&p->loads)) { /* d/dt of the displacement */
        const fw_effects_growth g = growth_of(p, s);
        const fw_geometry_vec2 u = displacement(p, s), d = p->drawn[0];
        const double S = 1 + g.grown, more = g.grown_per_s / S;
        if (p->point[0].body == FW_GROUND) return 0;
        v.x = S * (v.x - g.ground_per_s * (d.x - g.centre_m.x)) + more * u.x;
        v.y = S * (v.y - g.ground_per_s * (d.y - g.centre_m.y)) + more * u.y;
    }
    return along(p, v.x, v.y);
}

const fw_probe_row fw_probe_velocity = {.value = velocity};

static double angle(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_probe *a = p->asked;
    if (a->of) return s->angle_rad[a->index];
    return s->q[3 * a->body + 2] - p->mechanism->body[a->body].phi_rad;
}

const fw_probe_row fw_probe_angle = {.value = angle};

static double distance(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 a = point_of(p, 0, s), b = point_of(p, 1, s);
    return metres(p, s, hypot(b.x - a.x, b.y - a.y));
}

const fw_probe_row fw_probe_distance = {.value = distance};

/* in the frame of a, so that jaws that turn together keep their opening */
static double opening(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 a = point_of(p, 0, s), b = point_of(p, 1, s);
    int body = p->asked->body;
    double direction = p->asked->direction_rad + (body == FW_GROUND ? 0 : s->q[3 * body + 2]);
    return metres(p, s, (b.x - a.x) * cos(direction) + (b.y - a.y) * sin(direction));
}

const fw_probe_row fw_probe_opening = {.value = opening};

/* ---- gap ----
   The least distance between what is drawn of two bodies, as it is made:

     gap = max(0, D - w),    w = 2 edge + |flare|

   with D the distance of their outlines at a pose and w by how much walls come nearer than drawn. In:
   poses in SI; out: m. Error: that of the state; extremes over a motion hold between its instants, to
   max(1 nm, 0.1 %). Where outlines meet as drawn it is 0, and up to -w more where walls are etched
   away. Cost: fw_clearance_gap_m. Test: test_clearance_gap.c, tests/clearance/gaps.py */

static double as_made(const fw_probe *p, double drawn_m) {
    return drawn_m > 0 ? fmax(0, drawn_m - p->walls_m) : 0;
}

/* places where the substrate is as it is drawn, with the walls that stand on it; *longer: what bodies are */
static const double *on_substrate(const fw_probe *p, const fw_probe_state *s, double *longer) {
    *longer = 0;
    if (!fw_effects_has_growth(&p->loads)) return s->q;
    const fw_effects_growth g = growth_of(p, s);
    *longer = fw_effects_on_substrate(&g, p->mechanism->nbody, s->q, p->placed);
    return p->placed;
}

static double gap_value(const fw_probe *p, const fw_probe_state *s) {
    double longer;
    if (!p->gap) return (double)NAN;
    const double *q = on_substrate(p, s, &longer);
    return as_made(p, fw_clearance_gap_m(p->gap, q, longer));
}

static double gap_moved(const fw_probe *p, const fw_probe_state *s) {
    double longer;
    const double *q = on_substrate(p, s, &longer);
    return fw_clearance_gap_moved_m(p->gap, q, longer);
}

double fw_probe_gap_drawn(const fw_probe *p) {
    return p->gap ? as_made(p, fw_clearance_gap_drawn_m(p->gap)) : (double)NAN;
}

double fw_probe_gap_etched_m(const fw_probe *p) {
    return p->gap ? fmax(0, -p->walls_m) : 0;
}

/* from what is known of the course to what the piece adds to it */
static void gap_extreme(const fw_probe *p, const fw_clearance_path *piece, double sign,
                        fw_probe_course *course) {
    fw_probe_extreme *e = sign < 0 ? &course->minimum : &course->maximum;
    if (sign < 0 && e->value <= 0) return;
    const double before = e->value + p->walls_m;
    double *bound = sign < 0 ? &course->below : &course->above;
    fw_clearance_gap_extreme known = {
        .m = before, .t_s = e->t_s, .bound_m = course->searched ? *bound + p->walls_m : before};
    fw_clearance_gap_over(p->gap, piece, sign, &known);
    course->moved = fmax(course->moved, known.moved_m);
    *bound = fmax(0, known.bound_m - p->walls_m);
    if (known.m != before) *e = (fw_probe_extreme){as_made(p, known.m), known.t_s, 0};
}

static void gap_within(const fw_probe *p, const fw_clearance_path *piece, fw_probe_course *course) {
    if (!p->gap || course->count == 0) return;
    gap_extreme(p, piece, -1, course);
    gap_extreme(p, piece, 1, course);
    course->searched = true;
    if (course->minimum.value <= 0 && !course->meets)
        course->meets = true, course->met = course->moved;
}

const fw_probe_row fw_probe_gap = {.value = gap_value, .within = gap_within, .moved = gap_moved};

/* ---- forces on the ports of a force element at a pose ----
   The class's own force (effects/effects.h) where the ports are, its switches as the integration holds
   them, or, at rows and equilibria, as their own values say. In: poses and velocities in SI. Out: N,
   N m. Error: round-off, and that. Cost: that of the class. Test: test_probe.py, against the balance
   of forces on a body. */

/* points of a ground that stretches with time go with it */
static void stretch_ports(const fw_probe *p, const fw_probe_state *s) {
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

/* forces on the ports of the element, and where they are: p->f, p->p, p->w. false: there is none */
static bool element_forces(const fw_probe *p, const fw_probe_state *s,
                           fw_effects_port_state *seen) {
    const fw_effects_force_element *e = p->element;
    if (!e) return false;
    fw_effects_element_place_ports(e, s->q, s->v, p->p, p->w);
    stretch_ports(p, s);
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

/* ---- force in what carries it ----
   A joint: what it exerts on its body b; a distance and springs: the tension T = k (l - l0) + c l', of a
   cable where that is above 0; a tendon: its tension, which is the force on its first eyelet; a comb
   drive: on its rotor, along the drive; a contact: the force that presses its surfaces. In: a state in
   SI; out: N. Error: that of the state. Test: test_probe.py. */

/* of any point of a body, and how it moves */
static fw_geometry_vec2 place_of(const fw_probe *p, const fw_probe_state *s, int body, double x,
                                 double y, fw_geometry_vec2 *speed) {
    fw_probe at = *p;
    at.point[0] = (fw_effects_port){body, x, y};
    *speed = speed_of(&at, 0, s);
    return point_of(&at, 0, s);
}

/* length, its unit vector from a to b, and rate */
static double line(const fw_probe *p, const fw_probe_state *s, int a, double ax, double ay, int b,
                   double bx, double by, double unit[2], double *rate) {
    fw_geometry_vec2 va, vb, from = place_of(p, s, a, ax, ay, &va),
                             to = place_of(p, s, b, bx, by, &vb);
    double dx = to.x - from.x, dy = to.y - from.y, length = hypot(dx, dy);
    unit[0] = length > 0 ? dx / length : 1, unit[1] = length > 0 ? dy / length : 0;
    *rate = unit[0] * (vb.x - va.x) + unit[1] * (vb.y - va.y);
    return length;
}

static double force_of_spring(const fw_probe *p, const fw_probe_state *s) {
    double unit[2], rate;
    fw_effects_port_state seen;
    if (element_forces(p, s, &seen)) { /* on its first point, towards the second */
        const double pull = hypot(p->f[0], p->f[1]);
        return p->f[0] * (p->p[3] - p->p[0]) + p->f[1] * (p->p[4] - p->p[1]) < 0 ? -pull : pull;
    }
    if (p->spring == FW_NONE) return 0;
    const fw_device_spring *k = &p->loads.spring[p->spring];
    double length =
        line(p, s, k->body_a, k->ax_m, k->ay_m, k->body_b, k->bx_m, k->by_m, unit, &rate);
    double stretch = length - k->length_m;
    double tension = k->stiffness_N_per_m * stretch + k->damping_Ns_per_m * rate;
    return k->cable ? (stretch > 0 ? fmax(0, tension) : 0) : tension;
}

static double force_of_joint(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_joint *j = &p->mechanism->joint[p->asked->index];
    if (!s->joint_N) return (double)NAN;
    const double *f = s->joint_N + 3 * p->asked->index;
    double unit[2], rate;
    if (j->kind != FW_JOINT_DISTANCE || !isnan(p->asked->direction_rad))
        return along(p, f[0], f[1]);
    line(p, s, j->body_a, j->ax_m, j->ay_m, j->body_b, j->bx_m, j->by_m, unit, &rate);
    return -(f[0] * unit[0] + f[1] * unit[1]); /* it pulls b towards a */
}

static double force_of_comb(const fw_probe *p, const fw_probe_state *s) {
    fw_effects_port_state seen;
    if (!element_forces(p, s, &seen)) return 0;
    const double *f = p->f + 3; /* port 0: the stator, 1: the rotor */
    if (!isnan(p->asked->direction_rad)) return along(p, f[0], f[1]);
    const fw_effects_comb_element *c = fw_effects_comb_of(p->element);
    double direction = (c ? c->direction_rad : 0) + p->p[2];
    return f[0] * cos(direction) + f[1] * sin(direction);
}

static double force(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_probe *a = p->asked;
    fw_effects_port_state seen;
    switch (a->carrier) {
    case FW_CARRIER_REVOLUTE:
        return s->reaction_N
                   ? along(p, s->reaction_N[2 * a->index], s->reaction_N[2 * a->index + 1])
                   : (double)NAN;
    case FW_CARRIER_JOINT:
        return force_of_joint(p, s);
    case FW_CARRIER_DRIVER:
        return s->driver_N ? s->driver_N[a->index] : (double)NAN;
    case FW_CARRIER_SPRING:
        return force_of_spring(p, s);
    case FW_CARRIER_TENDON:
        return element_forces(p, s, &seen) ? hypot(p->f[0], p->f[1]) : 0;
    case FW_CARRIER_COMB:
        return force_of_comb(p, s);
    case FW_CARRIER_CONTACT:
        break;
    }
    if (!element_forces(p, s, &seen)) return 0;
    return p->element->class_->pressing(p->element, &seen);
}

const fw_probe_row fw_probe_force = {.value = force};

/* ---- torque ----
   Of a revolute on its body b what its flexure exerts there, as a force element or as the spring and
   damper -k angle - c rate; of prismatic joints and welds about their point b; of drivers that turn.
   Stops and friction are not counted. N m. Test: test_probe.py. */

static double torque_of_revolute(const fw_probe *p, const fw_probe_state *s) {
    fw_effects_port_state seen;
    int pin = p->asked->index;
    if (element_forces(p, s, &seen)) return p->f[3 * p->element->ports - 1];
    int k = p->loads.torsion_of ? p->loads.torsion_of[pin] : 0;
    if (k == 0) return 0;
    const fw_effects_torsion *t = &p->loads.torsion[k - 1];
    double rate = turning(s, t->body_b) - turning(s, t->body_a);
    return -t->stiffness_Nm_per_rad * s->angle_rad[pin] - t->damping_Nms_per_rad * rate;
}

static double torque(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_probe *a = p->asked;
    switch (a->carrier) {
    case FW_CARRIER_REVOLUTE:
        return torque_of_revolute(p, s);
    case FW_CARRIER_JOINT:
        return s->joint_N ? s->joint_N[3 * a->index + 2] : (double)NAN;
    case FW_CARRIER_DRIVER:
        return s->driver_N ? s->driver_N[a->index] : (double)NAN;
    case FW_CARRIER_SPRING:
    case FW_CARRIER_TENDON:
    case FW_CARRIER_COMB:
    case FW_CARRIER_CONTACT:
        break;
    }
    return 0;
}

const fw_probe_row fw_probe_torque = {.value = torque};

/* ---- power that an actuator feeds into the bodies ----
   Of a driver its force times the rate of its coordinate; of a tendon or comb drive the sum of f . w over
   its ports, without what the cable stores and what the source loses. Where slender parts of bodies give (body_compliance.c), f . w
   is what moves them as rigid ones, and what those parts store is fed in besides: the element's energy less T^2/(2 k) of the cable,
   by a central difference along the motion. W. Error: round-off; of that difference (omega h)^2/6. Test: test_probe.py, against
   kinetic and elastic energy. */

/* J, h later on the way that the state is on; the element's work room then has that state */
static double given_J(const fw_probe *p, const fw_probe_state *s, const fw_effects_port_state *seen,
                      double k, double h) {
    const fw_effects_force_element *e = p->element;
    const int n = 3 * e->ports;
    fw_effects_port_state then = *seen;
    then.t_s = s->t_s + h, then.still = true;
    for (int i = 0; i < n; i++)
        p->p[i] += h * p->w[i];
    e->class_->force(e, &then, p->f);
    const double pull = hypot(p->f[0], p->f[1]),
                 all = e->class_->energy(e, &then) - pull * pull / (2 * k);
    for (int i = 0; i < n; i++)
        p->p[i] -= h * p->w[i];
    return all;
}

/* W into what gives of bodies where a cable pulls */
static double fed_to_arms(const fw_probe *p, const fw_probe_state *s,
                          const fw_effects_port_state *seen) {
    const fw_effects_force_element *e = p->element;
    const double h = 1e-6; /* s: below any period of a device, above what round-off takes */
    const double k = s->still || !e->class_->beam || !e->class_->energy ? 0 : p->cable_N_per_m;
    return k > 0 ? (given_J(p, s, seen, k, h) - given_J(p, s, seen, k, -h)) / (2 * h) : 0;
}

static double power_of_driver(const fw_probe *p, const fw_probe_state *s) {
    const fw_mechanism *m = p->mechanism;
    const fw_device_driver *d = &m->driver[p->asked->index];
    if (!s->driver_N || !s->v) return s->still ? 0 : (double)NAN;
    double force = s->driver_N[p->asked->index];
    if (d->revolute != FW_NONE) {
        const fw_mechanism_pin *pin = &m->pin[d->revolute];
        return force * (turning(s, pin->body_b) - turning(s, pin->body_a));
    }
    const fw_device_joint *j = &m->joint[d->joint];
    fw_probe at = *p;
    at.point[0] = (fw_effects_port){j->body_a, j->ax_m, j->ay_m};
    at.point[1] = (fw_effects_port){j->body_b, j->bx_m, j->by_m};
    const fw_geometry_vec2 a = point_of(&at, 0, s), b = point_of(&at, 1, s);
    const fw_geometry_vec2 va = speed_of(&at, 0, s), vb = speed_of(&at, 1, s);
    double dx = b.x - a.x, dy = b.y - a.y, wx = vb.x - va.x, wy = vb.y - va.y;
    if (j->kind == FW_JOINT_DISTANCE) return force * (dx * wx + dy * wy) / hypot(dx, dy);
    double axis = j->axis_rad + (j->body_a == FW_GROUND ? 0 : s->q[3 * j->body_a + 2]);
    double spin = turning(s, j->body_a), ex = cos(axis), ey = sin(axis);
    return force * (ex * wx + ey * wy + spin * (ex * dy - ey * dx));
}

static double power(const fw_probe *p, const fw_probe_state *s) {
    fw_effects_port_state seen;
    if (p->asked->carrier == FW_CARRIER_DRIVER) return power_of_driver(p, s);
    if (!element_forces(p, s, &seen)) return 0;
    double sum = 0;
    for (int i = 0; i < 3 * p->element->ports; i++)
        sum += p->f[i] * p->w[i];
    return sum + fed_to_arms(p, s, &seen);
}

const fw_probe_row fw_probe_power = {.value = power};

/* ---- capacitance ----
   Between the electrodes of a comb drive at a pose: comb_drive.c, with the fringe of fringe_field.c where that acts. In: m, rad; out: F. Validity and error: theirs. Test: test_probe.py. */

static double capacitance(const fw_probe *p, const fw_probe_state *s) {
    const fw_effects_comb_element *c = p->element ? fw_effects_comb_of(p->element) : NULL;
    double place[3];
    if (!c) return (double)NAN;
    fw_effects_element_place_ports(p->element, s->q, s->v, p->p, p->w);
    stretch_ports(p, s);
    fw_effects_comb_place(p->element, p->p, place);
    return fw_effects_comb_capacitance(c, place, NULL, NULL);
}

double fw_probe_capacitance_drawn(const fw_probe *p) {
    const double as_drawn[3] = {0, 0, 0};
    const fw_effects_comb_element *c = p->element ? fw_effects_comb_of(p->element) : NULL;
    return c ? fw_effects_comb_capacitance(c, as_drawn, NULL, NULL) : (double)NAN;
}

const fw_probe_row fw_probe_capacitance = {.value = capacitance};

/* ---- compliance, stiffness and frequency ----
   Compliance of a point along a direction, from the small motions about a pose: shapes u_i of all
   degrees of freedom are orthogonal in mass and stiffness, M_i = u_i M u_i, K_i = M_i w_i^2, so that

     C = d . K^-1 d = sum_i (u_i . d)^2 / (M_i w_i^2),     stiffness 1/C

   over the motions that the joints allow. In: modes in SI; out: m/N. Exact but for round-off (1e-9
   with stiff axes beside soft ones). Infinite where a free motion moves the point, NaN where the
   pose is unstable. Cost: one term a mode. Source: Meirovitch, Fundamentals of Vibrations, 7.
   Test: test_probe.py, against a cantilever's end. */

/* u (m) of the point along the probe's direction in a mode, per unit of its shape */
static double mode_along(const fw_probe *p, const fw_statics_modes *modes, int mode) {
    const fw_effects_port *at = &p->point[0];
    if (at->body == FW_GROUND) return 0;
    const double *u = modes->mode[mode].shape + 3 * at->body;
    double phi = modes->q[3 * at->body + 2], c = cos(phi), s = sin(phi);
    double rx = c * at->x_m - s * at->y_m, ry = s * at->x_m + c * at->y_m;
    return along(p, u[0] - u[2] * ry, u[1] + u[2] * rx);
}

static double compliance(const fw_probe *p, const fw_statics_modes *modes) {
    const double rounding = 1e-12; /* of a free motion's farthest way: the point stays */
    double sum = 0;
    for (int i = 0; i < modes->count; i++) {
        const fw_statics_mode *m = &modes->mode[i];
        double u = mode_along(p, modes, i);
        if (fabs(u) <= (m->kind == FW_MODE_FREE ? rounding * modes->unit_length_m : 0)) continue;
        if (m->kind == FW_MODE_UNSTABLE) return (double)NAN;
        sum += m->kind == FW_MODE_FREE ? (double)INFINITY
                                       : u * u / (m->modal_mass_kg_m2 * m->stiffness_per_s2);
    }
    return sum;
}

static double stiffness(const fw_probe *p, const fw_statics_modes *modes) {
    return 1 / compliance(p, modes);
}

/* as `modes` counts them */
static double frequency(const fw_probe *p, const fw_statics_modes *modes) {
    int n = p->asked->mode;
    return n >= 1 && n <= modes->count ? modes->mode[n - 1].f_Hz : (double)NAN;
}

const fw_probe_row fw_probe_stiffness = {.small = stiffness};
const fw_probe_row fw_probe_compliance = {.small = compliance};
const fw_probe_row fw_probe_frequency = {.small = frequency};

double fw_probe_small(const fw_probe *p, const fw_statics_modes *modes) {
    return p->row->small ? p->row->small(p, modes) : (double)NAN;
}

/* What the next model of the hinges changes of a compliance along the probe, over it, or of its stiffness: g . softer g
   over g . g with g_i = u_i . d / sqrt(K_i). NaN: not known. Test: tests/cli/test_unsymmetric.py */
static double next_changes(const fw_probe *p, const fw_statics_modes *modes) {
    double now = 0, next = 0;
    const size_t n = (size_t)modes->count;
    if (!modes->softer) return (double)NAN;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            const fw_statics_mode *a = &modes->mode[i], *b = &modes->mode[j];
            const double g = mode_along(p, modes, (int)i) * mode_along(p, modes, (int)j) /
                             sqrt(a->modal_mass_kg_m2 * a->stiffness_per_s2 * b->modal_mass_kg_m2 *
                                  b->stiffness_per_s2);
            if (i == j) now += g;
            next += g * modes->softer[i * n + j];
        }
    return p->row == &fw_probe_compliance ? fabs(next / now - 1) : fabs(now / next - 1);
}

/* g . give g with g_i = u_i . d / sqrt(M_i); NULL: without end */
static double gives(const fw_probe *p, const fw_statics_modes *modes, const double *give) {
    const int n = modes->count;
    double sum = give ? 0 : (double)INFINITY;
    for (int i = 0; give && i < n * n; i++)
        sum += mode_along(p, modes, i / n) * mode_along(p, modes, i % n) * give[i] /
               sqrt(modes->mode[i / n].modal_mass_kg_m2 * modes->mode[i % n].modal_mass_kg_m2);
    return sum;
}

void fw_probe_small_rubs(const fw_probe *p, const fw_statics_modes *modes, int mode, double by[2]) {
    const fw_statics_mode *m = mode > 0 ? &modes->mode[mode - 1] : NULL;
    by[0] = by[1] = 1;
    if (m && !isnan(m->stuck_Hz) && m->f_Hz > 0)
        by[0] = m->slid_Hz / m->f_Hz, by[1] = m->stuck_Hz / m->f_Hz;
    if (m || modes->count == 0 || isnan(modes->mode[0].stuck_Hz)) return;
    const double now = compliance(p, modes), most = gives(p, modes, modes->slides);
    double least = gives(p, modes, modes->held);
    const bool yields = p->row == &fw_probe_compliance;
    if (!(now > 0)) return;
    if (least < 1e-9 * now) least = 0; /* round-off: it is held */
    by[0] = fmin(1, yields ? least / now : now / most);
    by[1] = fmax(1, yields ? most / now : now / least);
}

double fw_probe_small_error(const fw_probe *p, const fw_statics_modes *modes) {
    int n = p->asked->mode;
    bool one = p->kind->takes == FW_PROBE_MODE && n >= 1 && n <= modes->count;
    double error = one ? fw_statics_mode_error(&modes->mode[n - 1]) : modes->frequency_error;
    if (isnan(error)) return (double)INFINITY;
    if (p->kind->takes == FW_PROBE_MODE) return error;
    const double next = next_changes(p, modes);
    return isfinite(next) ? 2 * (error - modes->ledger.hinge.error) + next : 2 * error;
}
