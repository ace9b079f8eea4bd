/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effects.h"
#include "effects/modal.h"
#include <float.h>
#include <math.h>
#include <string.h>

fw_status fw_effects_loads_new(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, fw_effects_loads *loads) {
    size_t n = 3 * (size_t)mechanism->nbody;
    *loads = (fw_effects_loads){.nbody = mechanism->nbody};
    FW_NEED(loads->constant = fw_arena_array(arena, double, n));
    FW_NEED(loads->velocity = fw_arena_array(arena, double, n));
    FW_NEED(loads->torsion = fw_arena_array(arena, fw_effects_torsion, (size_t)mechanism->npin));
    FW_NEED(loads->torsion_of = fw_arena_array(arena, int, (size_t)mechanism->npin));
    size_t parts = (size_t)scene->npart; /* each may add a load of either kind */
    FW_NEED(loads->load =
                fw_arena_array(arena, fw_effects_point_load, (size_t)scene->nforce + parts));
    size_t timed = (size_t)scene->nforce + (size_t)scene->ntorque + parts;
    timed += (size_t)scene->nbase * (size_t)mechanism->nbody; /* the base pushes every body */
    FW_NEED(loads->timed = fw_arena_array(arena, fw_effects_timed_load, timed));
    FW_NEED(loads->stop = fw_arena_array(arena, fw_effects_stop, 2 * (size_t)mechanism->npin));
    FW_NEED(loads->slide = fw_arena_array(arena, fw_effects_slide, (size_t)mechanism->njoint));
    FW_NEED(loads->slide_of = fw_arena_array(arena, int, (size_t)mechanism->njoint));
    FW_NEED(loads->spring = fw_arena_array(arena, fw_device_spring, (size_t)mechanism->nspring));
    FW_NEED(loads->released = fw_arena_array(arena, bool, (size_t)mechanism->npin));
    FW_NEED(loads->strain = fw_arena_array(arena, double, (size_t)mechanism->nbody + 1));
    return FW_OK;
}

/* an array that has `have` entries, with room for one more: it doubles where it is full */
static void *grown(fw_arena *arena, void *old, int have, size_t size) {
    if (have > 0 && (have & (have - 1)) != 0) return old;
    size_t room = have > 0 ? 2 * (size_t)have : 1;
    char *more = fw_arena_alloc(arena, room, size);
    if (more && have > 0) memcpy(more, old, (size_t)have * size);
    return more;
}

fw_effects_force_element *fw_effects_loads_add_element(fw_arena *arena, fw_effects_loads *loads,
                                                       const fw_effects_element_class *class_,
                                                       int ports) {
    fw_effects_force_element *all = grown(arena, loads->element, loads->nelement, sizeof *all);
    fw_effects_port *port = fw_arena_array(arena, fw_effects_port, (size_t)ports);
    if (!all || !port) return NULL;
    loads->element = all;
    fw_effects_force_element *e = &all[loads->nelement++];
    *e = (fw_effects_force_element){
        .class_ = class_, .id = class_->effect, .ports = ports, .pin = FW_NONE};
    e->port = port;
    return e;
}

fw_effects_friction *fw_effects_loads_add_friction(fw_arena *arena, fw_effects_loads *loads) {
    fw_effects_friction *all = grown(arena, loads->friction, loads->nfriction, sizeof *all);
    if (!all) return NULL;
    loads->friction = all;
    all[loads->nfriction] =
        (fw_effects_friction){.pin = FW_NONE, .joint = FW_NONE, .element = FW_NONE};
    return &all[loads->nfriction++];
}

fw_effects_torsion *fw_effects_loads_torsion(const fw_mechanism *mechanism, fw_effects_loads *loads,
                                             int pin) {
    if (loads->torsion_of[pin]) return &loads->torsion[loads->torsion_of[pin] - 1];
    fw_effects_torsion *t = &loads->torsion[loads->ntorsion++];
    const fw_mechanism_pin *p = &mechanism->pin[pin];
    *t = (fw_effects_torsion){pin, p->body_a, p->body_b, 0, 0, p->free_angle_rad};
    loads->torsion_of[pin] = loads->ntorsion;
    return t;
}

fw_effects_slide *fw_effects_loads_slide(fw_effects_loads *loads, int joint) {
    if (loads->slide_of[joint]) return &loads->slide[loads->slide_of[joint] - 1];
    fw_effects_slide *s = &loads->slide[loads->nslide++];
    *s = (fw_effects_slide){joint, 0, 0};
    loads->slide_of[joint] = loads->nslide;
    return s;
}

static double turn_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0 : m->body[body].phi_rad;
}

/* force (fx, fy) at the world point p */
static void modal_load(const fw_mechanism *m, double *force, int body, fw_geometry_vec2 p,
                       double fx, double fy) {
    if (body == FW_GROUND) return;
    force[3 * body] += fx;
    force[3 * body + 1] += fy;
    force[3 * body + 2] += (p.x - m->body[body].x_m) * fy - (p.y - m->body[body].y_m) * fx;
}

static void turn(double *force, int body, double torque) {
    if (body != FW_GROUND) force[3 * body + 2] += torque;
}

static void modal_load_at(const fw_mechanism *m, double *force, int body, double x, double y,
                          double fx, double fy) {
    modal_load(m, force, body, fw_mechanism_local_place(m, body, x, y), fx, fy);
}

/* timed loads at the start, or with end_s > 0 at the largest of their factor in the scene */
static void add_loads(const fw_mechanism *m, const fw_effects_loads *loads, double end_s,
                      double *force) {
    for (int i = 0; i < loads->nload; i++) {
        const fw_effects_point_load *l = &loads->load[i];
        modal_load_at(m, force, l->body, l->x_m, l->y_m, l->fx_N, l->fy_N);
    }
    for (int i = 0; i < loads->ntimed; i++) {
        const fw_effects_timed_load *l = &loads->timed[i];
        double factor[3];
        fw_quantity_law_value(l->law, 0, DBL_MIN, factor); /* the piece that begins at 0 */
        if (end_s > 0) factor[0] = fw_quantity_law_largest(l->law, end_s);
        modal_load_at(m, force, l->body, l->x_m, l->y_m, factor[0] * l->fx_N, factor[0] * l->fy_N);
        turn(force, l->body, factor[0] * l->torque_Nm);
    }
}

static void add_springs(const fw_mechanism *m, const fw_effects_loads *loads, double *force) {
    for (int i = 0; i < loads->nspring; i++) {
        const fw_device_spring *s = &loads->spring[i];
        fw_geometry_vec2 a = fw_mechanism_local_place(m, s->body_a, s->ax_m, s->ay_m);
        fw_geometry_vec2 b = fw_mechanism_local_place(m, s->body_b, s->bx_m, s->by_m);
        double dx = b.x - a.x, dy = b.y - a.y, l = hypot(dx, dy);
        if (!(l > 0) || fw_effects_spring_slack(m, s)) continue;
        double f = s->stiffness_N_per_m * (l - s->length_m) / l;
        modal_load(m, force, s->body_a, a, f * dx, f * dy);
        modal_load(m, force, s->body_b, b, -f * dx, -f * dy);
    }
}

/* -k s ds/dq with the travel s = u (p_b - p_a) - free length and u turning with body a */
static void add_slides(const fw_mechanism *m, const fw_effects_loads *loads, double *force) {
    for (int i = 0; i < loads->nslide; i++) {
        const fw_device_joint *t = &m->joint[loads->slide[i].joint];
        fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
        fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
        double turned = turn_of(m, t->body_a) + t->axis_rad, ux = cos(turned), uy = sin(turned);
        double dx = b.x - a.x, dy = b.y - a.y;
        double f = -loads->slide[i].stiffness_N_per_m * (ux * dx + uy * dy - t->free_length_m);
        modal_load(m, force, t->body_b, b, f * ux, f * uy);
        modal_load(m, force, t->body_a, a, -f * ux, -f * uy);
        turn(force, t->body_a, f * (ux * dy - uy * dx));
    }
}

static void add_torques(const fw_mechanism *m, const fw_effects_loads *loads, double *force) {
    for (int i = 0; i < loads->ntorsion; i++) {
        const fw_effects_torsion *t = &loads->torsion[i];
        double angle = turn_of(m, t->body_b) - turn_of(m, t->body_a) - t->free_angle_rad;
        turn(force, t->body_a, t->stiffness_Nm_per_rad * angle);
        turn(force, t->body_b, -t->stiffness_Nm_per_rad * angle);
    }
    for (int i = 0; i < loads->nstop; i++) {
        const fw_effects_stop *s = &loads->stop[i];
        double angle = turn_of(m, s->body_b) - turn_of(m, s->body_a) - s->free_angle_rad;
        double inside = s->side * (angle - s->at_rad); /* how far the stop is pressed in */
        if (!(inside > 0)) continue;
        turn(force, s->body_a, s->side * s->stiffness_Nm_per_rad * inside);
        turn(force, s->body_b, -s->side * s->stiffness_Nm_per_rad * inside);
    }
}

static void add_all(const fw_mechanism *m, const fw_effects_loads *loads, double end_s,
                    double *force) {
    for (int i = 0; i < 3 * loads->nbody; i++)
        force[i] = loads->constant[i];
    add_loads(m, loads, end_s, force);
    add_torques(m, loads, force);
    add_springs(m, loads, force);
    add_slides(m, loads, force);
    for (int i = 0; i < loads->nelement; i++) {
        double t_s = fw_effects_loads_element_busiest(m, &loads->element[i], end_s);
        fw_effects_loads_element_force(m, &loads->element[i], t_s, fmax(t_s, DBL_MIN), force);
    }
}

void fw_effects_loads_initial_force(const fw_mechanism *m, const fw_effects_loads *loads,
                                    double *force) {
    add_all(m, loads, 0, force);
}

void fw_effects_loads_largest_force(const fw_mechanism *m, const fw_effects_loads *loads,
                                    double end_s, double *force) {
    add_all(m, loads, end_s, force);
}

const fw_effects_loads *fw_effects_loads_keep(fw_arena *arena, const fw_effects_loads *loads) {
    fw_effects_loads *kept = fw_arena_one(arena, fw_effects_loads);
    if (kept) *kept = *loads;
    return kept;
}

/* [K G^T; G 0] [dq; lambda] = [F; 0] at the initial pose, rows balanced by a length and a
   stiffness. Geometric stiffness (lambda Psi_qq, turning loads) is left out: callers take a factor
   for it. Inputs SI; outputs displacement (3 nbody) in m and rad, rotation (npin) in rad. Cost the
   cube of 3 nbody + the rows of joints and drivers, over 3. Source: standard static condensation
   of a constrained system. Test: test_effects.c. */
fw_status fw_effects_static_response(fw_arena *arena, const fw_mechanism *m,
                                     const fw_effects_loads *loads, const double *force,
                                     double *displacement, double *rotation, bool *valid) {
    int total = fw_effects_linear_size(m, loads);
    *valid = false;
    if (total > FW_RESPONSE_MOST || total == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    fw_effects_linear s;
    bool elastic;
    FW_TRY(fw_effects_linear_new(arena, m, loads, &s, &elastic));
    if (elastic) {
        double *x, *f;
        FW_NEED(x = fw_arena_array(arena, double, (size_t)total));
        FW_NEED(f = fw_arena_array(arena, double, (size_t)s.n));
        for (int i = 0; i < s.n; i++)
            f[i] = force[i] / fw_effects_linear_force_unit(&s, i);
        FW_TRY(fw_effects_linear_solve(arena, &s, f, x, valid));
        for (int i = 0; i < s.n; i++) {
            displacement[i] = x[i] * fw_effects_linear_unit(&s, i);
            *valid = *valid && isfinite(displacement[i]);
        }
        for (int i = 0; i < m->npin; i++) {
            int a = m->pin[i].body_a, b = m->pin[i].body_b;
            rotation[i] = (b == FW_GROUND ? 0 : displacement[3 * b + 2]) -
                          (a == FW_GROUND ? 0 : displacement[3 * a + 2]);
        }
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* Free strains that act from the start on: temperature without a law, stress of the layer. */

/* arrays of these loads alone: whoever else holds the same loads keeps theirs as they were */
static void *copied(fw_arena *arena, const void *from, int count, size_t size) {
    void *to = fw_arena_alloc(arena, (size_t)count, size);
    if (to && count > 0) memcpy(to, from, (size_t)count * size);
    return to;
}

static fw_status own_arrays(fw_arena *arena, fw_effects_loads *t) {
    FW_NEED(t->load = copied(arena, t->load, t->nload, sizeof *t->load));
    FW_NEED(t->timed = copied(arena, t->timed, t->ntimed, sizeof *t->timed));
    FW_NEED(t->spring = copied(arena, t->spring, t->nspring, sizeof *t->spring));
    FW_NEED(t->element = copied(arena, t->element, t->nelement, sizeof *t->element));
    for (int i = 0; i < t->nelement; i++) {
        fw_effects_force_element *e = &t->element[i];
        FW_NEED(e->port = copied(arena, e->port, e->ports, sizeof *e->port));
    }
    return FW_OK;
}

static void strain_ports(const fw_effects_loads *loads, fw_geometry_vec2 centre,
                         fw_effects_force_element *e) {
    for (int i = 0; i < e->ports; i++)
        fw_mechanism_strain_pin(loads->strain, loads->nbody, centre, e->port[i].body,
                                fw_effects_element_root(e, i), &e->port[i].x_m, &e->port[i].y_m);
}

/* Inputs: loads->strain, dimensionless. Every point of the loads moves with the material
   that it lies on, as the joints do in fw_mechanism_strained. Cost O(loads). Test: test_thermal.c.
 */
fw_status fw_effects_strain(fw_arena *arena, const fw_mechanism *mechanism, fw_effects_loads *loads,
                            const fw_mechanism **strained) {
    *strained = mechanism;
    if (!loads->strained) return FW_OK;
    fw_geometry_vec2 centre = fw_mechanism_ground_centre(mechanism);
    const double *e = loads->strain;
    const int n = loads->nbody;
    FW_TRY(own_arrays(arena, loads));
    for (int i = 0; i < loads->nload; i++) {
        fw_effects_point_load *l = &loads->load[i];
        fw_mechanism_strain_point(e, n, centre, l->body, &l->x_m, &l->y_m);
    }
    for (int i = 0; i < loads->ntimed; i++) {
        fw_effects_timed_load *l = &loads->timed[i];
        fw_mechanism_strain_point(e, n, centre, l->body, &l->x_m, &l->y_m);
    }
    for (int i = 0; i < loads->nspring; i++) {
        fw_device_spring *s = &loads->spring[i];
        fw_mechanism_strain_point(e, n, centre, s->body_a, &s->ax_m, &s->ay_m);
        fw_mechanism_strain_point(e, n, centre, s->body_b, &s->bx_m, &s->by_m);
    }
    for (int i = 0; i < loads->nelement; i++)
        strain_ports(loads, centre, &loads->element[i]);
    return fw_mechanism_strained(arena, mechanism, e, strained);
}

fw_status fw_effects_at_start(fw_arena *arena, const fw_mechanism *mechanism,
                              const fw_effects_loads *loads, const fw_mechanism **start) {
    double law[3], *strain;
    *start = mechanism;
    if (!loads->stretch.law) return FW_OK;
    fw_quantity_law_value(loads->stretch.law, 0, DBL_MIN, law); /* the piece that begins at 0 */
    if (law[0] == 0) return FW_OK;
    FW_NEED(strain = fw_arena_array(arena, double, (size_t)mechanism->nbody + 1));
    strain[mechanism->nbody] = loads->stretch.strain * law[0];
    return fw_mechanism_strained(arena, mechanism, strain, start);
}

/* ---- places as the substrate sees them ----
   A point that the model has at x, in lengths of the layer about the mean c of the ground's points, is at c + S (x - c)
   with S = 1 + grown, and the point of the substrate that was drawn at p is at c + S (1 + e)(p - c) with the strain e of the
   ground against the layer. In: dimensionless, m; out: m. Exact for even strains; constant ones and one with a law come one
   after the other, as their scales do. Source: docs/theory/effects/temperature.md. Test: test_temperature.c, test_heated.py */

fw_effects_growth fw_effects_growth_at(const fw_mechanism *m, const fw_effects_loads *loads,
                                       double t_s, double piece_s, bool still) {
    const fw_effects_stretch *s = &loads->stretch;
    fw_effects_growth g = {.ground = loads->strained ? loads->strain[loads->nbody] : 0,
                           .grown = loads->strained ? loads->grown : 0};
    double law[3];
    if (!fw_effects_has_growth(loads)) return g;
    g.centre_m = fw_mechanism_ground_centre(m);
    if (!s->law) return g;
    fw_quantity_law_value(s->law, t_s, piece_s, law);
    const double ground = 1 + g.ground, grown = 1 + g.grown, rate = still ? 0 : law[1];
    g.ground += ground * s->strain * law[0], g.ground_per_s = ground * s->strain * rate;
    g.grown += grown * s->grown * law[0], g.grown_per_s = grown * s->grown * rate;
    return g;
}

fw_geometry_vec2 fw_effects_beside_substrate(const fw_effects_growth *g, fw_geometry_vec2 place_m,
                                             fw_geometry_vec2 drawn_m) {
    const double e = g->ground, S = 1 + g->grown;
    return (fw_geometry_vec2){S * (place_m.x - drawn_m.x - e * (drawn_m.x - g->centre_m.x)),
                              S * (place_m.y - drawn_m.y - e * (drawn_m.y - g->centre_m.y))};
}

double fw_effects_on_substrate(const fw_effects_growth *g, int nbody, const double *q,
                               double *out) {
    const double longer = -g->ground / (1 + g->ground);
    for (int i = 0; i < 3 * nbody; i++)
        out[i] = q[i];
    for (int b = 0; b < nbody && longer != 0; b++) {
        out[3 * b] += longer * (q[3 * b] - g->centre_m.x);
        out[3 * b + 1] += longer * (q[3 * b + 1] - g->centre_m.y);
    }
    return longer;
}

bool fw_effects_foreign_in(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->ncontact; i++) {
        const fw_device_contact_use *use = &c->scene->contact[i];
        if (use->joint == FW_NONE && use->side == FW_CONTACT_OUTSIDE &&
            use->undrawn != FW_UNDRAWN_ETCHED)
            return true;
    }
    for (int i = 0; i < c->scene->ntendon; i++)
        if (!isnan(c->scene->tendon[i].draw_m)) return true;
    for (int i = 0; i < c->mechanism->nspring; i++)
        if (c->mechanism->spring[i].stiffness_N_per_m > 0) return true;
    return false;
}

bool fw_effects_places_count(const fw_effect_case *c) {
    const fw_device *d = c->mechanism->device;
    bool count = c->mechanism->layout && c->mechanism->layout->drawn;
    for (int i = 0; d && i < d->nprobe && !count; i++) {
        const fw_device_probe_takes takes = fw_device_probe_kinds[d->probe[i].row].takes;
        count = takes == FW_PROBE_POINT || takes == FW_PROBE_PAIR || takes == FW_PROBE_OUTLINES;
    }
    return count;
}
