/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probes of a scene: which rows, points and force elements they are of. */
#include "probe/probe.h"
#include "base/text.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FW_PROBE(name, ...) &fw_probe_##name,
static const fw_probe_row *const rows[FW_PROBE_KINDS] = {
#include "device/probes.def"
};
#undef FW_PROBE

/* ---- binding ---- */

static const char *effect_of(fw_device_carrier carrier) {
    switch (carrier) {
    case FW_CARRIER_TENDON:
        return "tendon";
    case FW_CARRIER_COMB:
        return "comb-drive";
    case FW_CARRIER_CONTACT:
        return "contact";
    case FW_CARRIER_SPRING: /* one that acts on what gives is an element (effects/body_compliance.c) */
        return "point-spring";
    case FW_CARRIER_REVOLUTE:
    case FW_CARRIER_JOINT:
    case FW_CARRIER_DRIVER:
        break;
    }
    return NULL;
}

/* of a scene's tendon, comb drive, contact or spring by its id; of a revolute that is not a constraint */
static const fw_effects_force_element *element_of(const fw_probe *p) {
    const fw_device_probe *a = p->asked;
    const char *effect = effect_of(a->carrier);
    for (int i = 0; a->of && i < p->loads.nelement; i++) {
        const fw_effects_force_element *e = &p->loads.element[i];
        if (effect ? strcmp(e->class_->effect, effect) == 0 && e->id && strcmp(e->id, a->of) == 0
                   : a->carrier == FW_CARRIER_REVOLUTE && e->pin == a->index)
            return e;
    }
    return NULL;
}

static int spring_of(const fw_probe *p) {
    const fw_device_probe *a = p->asked;
    for (int i = 0; a->of && a->carrier == FW_CARRIER_SPRING && i < p->loads.nspring; i++)
        if (p->loads.spring[i].id && strcmp(p->loads.spring[i].id, a->of) == 0) return i;
    return FW_NONE;
}

/* a body that became longer takes the point along */
static void place_points(fw_probe *p) {
    const fw_device_probe *a = p->asked;
    p->point[0] = (fw_effects_port){a->body, a->x_m, a->y_m};
    p->point[1] = (fw_effects_port){a->body_b, a->bx_m, a->by_m};
    for (int i = 0; i < 2; i++) {
        fw_effects_port *at = &p->point[i];
        p->drawn[i] = fw_mechanism_local_place(p->mechanism, at->body, at->x_m, at->y_m);
        if (p->loads.strained)
            fw_mechanism_strain_point(p->loads.strain, p->mechanism->nbody,
                                      fw_mechanism_ground_centre(p->mechanism), at->body, &at->x_m,
                                      &at->y_m);
    }
}

static fw_status bind(fw_arena *arena, fw_probe *p) {
    p->kind = &fw_device_probe_kinds[p->asked->row];
    p->row = rows[p->asked->row];
    place_points(p);
    p->element = element_of(p);
    p->spring = spring_of(p);
    if (!p->element) return FW_OK;
    for (const fw_effects_force_element *e = p->loads.element; e < p->element; e++)
        p->first_switch += e->switches;
    size_t ports = 3 * (size_t)p->element->ports, n = (size_t)p->element->switches;
    FW_NEED(p->p = fw_arena_array(arena, double, 3 * ports));
    p->w = p->p + ports, p->f = p->w + ports;
    FW_NEED(p->on = fw_arena_array(arena, bool, n));
    return FW_OK;
}

/* outlines of all bodies, once for all probes; of a layout that cannot be made there are none */
static fw_status bind_gap(fw_arena *arena, fw_clearance_things **things, fw_probe *p) {
    const fw_mechanism *m = p->mechanism;
    if (p->kind->takes != FW_PROBE_OUTLINES || !m->layout || !m->layout->drawn ||
        m->layout->nfault > 0)
        return FW_OK;
    if (!*things) {
        FW_NEED(*things = fw_arena_one(arena, fw_clearance_things));
        FW_TRY(fw_clearance_things_of(arena, m->layout, m, *things));
    }
    p->walls_m = fw_layout_walls_m(m->layout);
    FW_NEED(p->placed = fw_arena_array(arena, double, 3 * (size_t)m->nbody));
    return fw_clearance_gap_new(arena, *things, p->asked->body, p->asked->body_b, &p->gap);
}

fw_status fw_probe_bind(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                        const fw_effects_loads *loads, fw_probe **probe) {
    fw_effects_loads own = loads ? *loads : (fw_effects_loads){.nbody = m->nbody};
    const fw_mechanism *strained = m;
    fw_clearance_things *things = NULL;
    int n = fw_probe_count(m);
    FW_NEED(*probe = fw_arena_array(arena, fw_probe, (size_t)n));
    if (n > 0 && own.strained) FW_TRY(fw_effects_strain(arena, m, &own, &strained));
    for (int i = 0; i < n; i++) {
        const fw_device_probe *asked = &m->device->probe[i];
        fw_probe *p = &(*probe)[i];
        *p = (fw_probe){.asked = asked, .mechanism = m, .loads = own};
        p->in_scene = fw_device_probe_in_scene(asked, scene);
        FW_TRY(bind(arena, p));
        for (int k = 0; scene && asked->carrier == FW_CARRIER_TENDON && k < scene->ntendon; k++)
            if (isnan(scene->tendon[k].pull_N) && fw_text_same(scene->tendon[k].id, asked->of))
                p->cable_N_per_m = scene->tendon[k].stiffness_N_per_m;
        FW_TRY(bind_gap(arena, &things, p));
    }
    return FW_OK;
}

/* ---- values ---- */

fw_probe_state fw_probe_state_of(const fw_dynamics_instant *now) {
    return (fw_probe_state){.t_s = now->t_s,
                            .piece_s = now->piece_s,
                            .q = now->q,
                            .v = now->v,
                            .angle_rad = now->angle_rad,
                            .reaction_N = now->reaction_N,
                            .joint_N = now->joint_N,
                            .driver_N = now->driver_N,
                            .on = now->on};
}

double fw_probe_value(const fw_probe *p, const fw_probe_state *s) {
    return p->in_scene && p->row->value ? p->row->value(p, s) : (double)NAN;
}

double fw_probe_across(const fw_probe *p, const fw_probe_state *s) {
    return p->in_scene && p->row->across ? p->row->across(p, s) : (double)NAN;
}

double fw_probe_origin(const fw_probe *p) {
    if (p->asked->row == FW_PROBE_IS_capacitance) return fw_probe_capacitance_drawn(p);
    if (p->kind->takes == FW_PROBE_OUTLINES) return fw_probe_gap_drawn(p);
    if (p->kind->takes != FW_PROBE_PAIR) return 0;
    const fw_geometry_vec2 a = p->drawn[0], b = p->drawn[1];
    double dx = b.x - a.x, dy = b.y - a.y, direction = p->asked->direction_rad;
    if (isnan(direction)) return hypot(dx, dy);
    if (p->asked->body != FW_GROUND) direction += p->mechanism->body[p->asked->body].phi_rad;
    return dx * cos(direction) + dy * sin(direction);
}

const char *fw_probe_text(char buffer[FW_PROBE_TEXT], double value, const char *unit) {
    return fw_prefixed_text(buffer, FW_PROBE_TEXT, value, unit, 4);
}

const char *fw_probe_when(char buffer[FW_PROBE_TEXT], double t_s) {
    char number[32];
    buffer[0] = '\0';
    if (!isnan(t_s))
        snprintf(buffer, FW_PROBE_TEXT, " at %s ms",
                 fw_number_text(number, sizeof number, 1e3 * t_s, 4));
    return buffer;
}

/* where a law jumps at a row, its value behind that; of the last row that before the end */
static fw_probe_state state_at_row(const fw_dynamics_motion *motion, int row) {
    size_t i = (size_t)row, n = 3 * (size_t)motion->nbody;
    double t = motion->t_s[row], end = motion->end_s, near = 1e-9 * end;
    fw_dynamics_motion_rows(motion, row, 1);
    return (fw_probe_state){.t_s = t,
                            .piece_s = t + near < end ? t + near : t - near,
                            .q = motion->q + i * n,
                            .v = motion->v + i * n,
                            .angle_rad = motion->angle_rad + i * (size_t)motion->npin,
                            .reaction_N = motion->reaction_N + i * 2 * (size_t)motion->npin,
                            .joint_N = motion->joint_N + i * 3 * (size_t)motion->njoint,
                            .driver_N = motion->driver_N + i * (size_t)motion->ndriver};
}

double fw_probe_at_row(const fw_probe *p, const fw_dynamics_motion *motion, int row) {
    const fw_probe_state s = state_at_row(motion, row);
    return fw_probe_value(p, &s);
}

bool fw_probe_has_rate(const fw_probe *p) {
    const fw_quantity_dimension is = p->kind->dimension;
    return p->row->value && (fw_quantity_dimension_equal(is, (fw_quantity_dimension){.m = 1}) ||
                             fw_quantity_dimension_equal(is, (fw_quantity_dimension){.rad = 1}));
}

/* so far to either side that neither rounding nor curvature is seen: of the largest arm, and of a radian */
static const double aside = 1e-6;

/* d/dt of a function of the pose: the difference of its values at q + h v and q - h v, over 2 h. Its error is the third
   derivative along the way times (1e-6 arm)^2/6, and rounding over 1e-6. */
double fw_probe_rate_at_row(const fw_probe *p, const fw_dynamics_motion *motion, int row,
                            double *room) {
    const fw_mechanism *m = p->mechanism;
    const int n = 3 * motion->nbody;
    fw_probe_state s = state_at_row(motion, row);
    const double *q = s.q, *angle = s.angle_rad, t = s.t_s;
    double arm = 0, fastest = 0, value[2];
    for (int i = 0; i < m->npin; i++)
        arm = fmax(arm, fmax(hypot(m->pin[i].ax_m, m->pin[i].ay_m),
                             hypot(m->pin[i].bx_m, m->pin[i].by_m)));
    for (int i = 0; i < n; i++)
        fastest = fmax(fastest, fabs(s.v[i]) * (i % 3 == 2 ? fmax(arm, 1e-9) : 1));
    if (!(fastest > 0) || !fw_probe_has_rate(p)) return fw_probe_has_rate(p) ? 0 : (double)NAN;
    const double h = aside * fmax(arm, 1e-9) / fastest;
    for (int side = 0; side < 2; side++) {
        const double by = side ? h : -h;
        for (int i = 0; i < n; i++)
            room[i] = q[i] + by * s.v[i];
        for (int i = 0; i < m->npin; i++) {
            const int a = m->pin[i].body_a, b = m->pin[i].body_b;
            const double turning =
                (b == FW_GROUND ? 0 : s.v[3 * b + 2]) - (a == FW_GROUND ? 0 : s.v[3 * a + 2]);
            room[n + i] = angle[i] + by * turning;
        }
        s.q = room, s.angle_rad = room + n;
        s.t_s = t + by; /* lengths that a law stretches, in the same piece of it */
        value[side] = fw_probe_value(p, &s);
    }
    return (value[1] - value[0]) / (2 * h);
}

double fw_probe_at_equilibrium(const fw_probe *p, const fw_device_scene *scene,
                               const fw_statics *statics) {
    const double end = scene->duration_s;
    const fw_probe_state s = {.t_s = end,
                              .piece_s = end * (1 - 1e-9),
                              .q = statics->q,
                              .angle_rad = statics->angle_rad,
                              .reaction_N = statics->reaction_N,
                              .joint_N = statics->joint_N,
                              .driver_N = statics->driver_N,
                              .still = true};
    return fw_probe_value(p, &s);
}

/* ---- a length that contacts hold ----
   What presses a contact is known with its force, and with that by how much it has closed. So of a length y near it is off what
   does not go with that alone. With slopes y_i and g_i of the length and of what the contact says of itself, and coordinates
   off by no more than d_i,

     y - y(q) = s (g - g(q)) + r,   |r| <= sum of |y_i - s g_i| d_i,   s the one by which that is least: some y_i/g_i, or 0

   and of what is left, r, the next contact takes its part. In: pose and d in m, rad; contacts that hold. Out: the bound of r, m: 0 of
   a length between the two places that meet, along their normal. Validity: changes so small that slopes are what they are. Error:
   central differences, 1e-8 of it. Cost: of each contact six values a body and the square of all. Test: test_effects.py,
   NearFirstTouch; test_probe.py, of two jaws on a bead */

enum { CONTACT_PORTS = 64 };

double fw_probe_contact_closes(const fw_effects_force_element *contact, const double *q) {
    double p[3 * CONTACT_PORTS], w[3 * CONTACT_PORTS], still[3 * CONTACT_PORTS] = {0};
    const bool on[CONTACT_PORTS] = {false};
    if (contact->ports > CONTACT_PORTS || contact->switches != 1 || !contact->class_->switch_value)
        return (double)NAN;
    fw_effects_element_place_ports(contact, q, NULL, p, w);
    const fw_effects_port_state state = {.load = 1, .p = p, .w = still, .on = on, .still = true};
    return contact->class_->switch_value(contact, &state, 0);
}

/* of a probe, or of a contact */
static double length_of(const fw_probe *p, const fw_effects_force_element *contact, double t_s,
                        const double *q) {
    const fw_probe_state s = {.t_s = t_s, .piece_s = t_s, .q = q, .still = true};
    return contact ? fw_probe_contact_closes(contact, q) : fw_probe_value(p, &s);
}

/* to (n): its slopes about the pose `at` (n), which is left as it was */
static void slopes(const fw_probe *p, const fw_effects_force_element *contact, double t_s, size_t n,
                   double *at, double *to) {
    for (size_t i = 0; i < n; i++) {
        const double was = at[i], h = i % 3 == 2 ? 1e-6 : 1e-8;
        at[i] = was - h, to[i] = -length_of(p, contact, t_s, at);
        at[i] = was + h, to[i] = (to[i] + length_of(p, contact, t_s, at)) / (2 * h);
        at[i] = was;
    }
}

static double left_over(const double *of, const double *closes, double times, const double *off,
                        size_t n) {
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += fabs(of[i] - times * closes[i]) * off[i];
    return sum;
}

double fw_probe_beside(const fw_probe *p, const fw_effects_force_element *const *contact, int count,
                       double t_s, const double *q, const double *off, double *room) {
    const size_t n = 3 * (size_t)p->mechanism->nbody;
    const fw_device_probe_row row = p->asked->row;
    double *at = room, *of = at + n, *closes = of + n;
    if (row != FW_PROBE_IS_displacement && row != FW_PROBE_IS_distance &&
        row != FW_PROBE_IS_opening)
        return HUGE_VAL;
    memcpy(at, q, n * sizeof *at);
    slopes(p, NULL, t_s, n, at, of);
    for (int c = 0; c < count; c++) {
        double times = 0, least = left_over(of, of, 0, off, n);
        slopes(p, contact[c], t_s, n, at, closes);
        for (size_t k = 0; k < n; k++) {
            const double s = fabs(closes[k]) > 0 && off[k] > 0 ? of[k] / closes[k] : 0,
                         left = left_over(of, closes, s, off, n);
            if (left < least) least = left, times = s;
        }
        for (size_t i = 0; i < n; i++)
            of[i] -= times * closes[i];
    }
    return left_over(of, of, 0, off, n);
}
