/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/linear.h"
#include <float.h>
#include <math.h>
#include <string.h>

fw_status fw_terms_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                       fw_terms *terms) {
    size_t n = 3 * (size_t)mechanism->nbody;
    *terms = (fw_terms){.nbody = mechanism->nbody};
    FW_NEED(terms->constant = fw_arena_array(arena, double, n));
    FW_NEED(terms->velocity = fw_arena_array(arena, double, n));
    FW_NEED(terms->torsion = fw_arena_array(arena, fw_torsion, (size_t)mechanism->npin));
    FW_NEED(terms->torsion_of = fw_arena_array(arena, int, (size_t)mechanism->npin));
    size_t parts = (size_t)scene->npart; /* each may add a load of either kind */
    FW_NEED(terms->load = fw_arena_array(arena, fw_point_load, (size_t)scene->nforce + parts));
    size_t timed = (size_t)scene->nforce + (size_t)scene->ntorque + parts;
    timed += (size_t)scene->nbase * (size_t)mechanism->nbody; /* the base pushes every body */
    FW_NEED(terms->timed = fw_arena_array(arena, fw_timed_load, timed));
    FW_NEED(terms->stop = fw_arena_array(arena, fw_stop, 2 * (size_t)mechanism->npin));
    FW_NEED(terms->slide = fw_arena_array(arena, fw_slide, (size_t)mechanism->ntie));
    FW_NEED(terms->slide_of = fw_arena_array(arena, int, (size_t)mechanism->ntie));
    FW_NEED(terms->spring = fw_arena_array(arena, fw_spring, (size_t)mechanism->nspring));
    FW_NEED(terms->released = fw_arena_array(arena, bool, (size_t)mechanism->npin));
    FW_NEED(terms->strain = fw_arena_array(arena, double, (size_t)mechanism->nbody + 1));
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

fw_force_element *fw_terms_add_element(fw_arena *arena, fw_terms *terms,
                                       const fw_element_class *class_, int ports) {
    fw_force_element *all = grown(arena, terms->element, terms->nelement, sizeof *all);
    fw_port *port = fw_arena_array(arena, fw_port, (size_t)ports);
    if (!all || !port) return NULL;
    terms->element = all;
    fw_force_element *e = &all[terms->nelement++];
    *e = (fw_force_element){.class_ = class_, .id = class_->effect, .ports = ports, .pin = FW_NONE};
    e->port = port;
    return e;
}

fw_friction *fw_terms_add_friction(fw_arena *arena, fw_terms *terms) {
    fw_friction *all = grown(arena, terms->friction, terms->nfriction, sizeof *all);
    if (!all) return NULL;
    terms->friction = all;
    all[terms->nfriction] = (fw_friction){.pin = FW_NONE, .tie = FW_NONE, .element = FW_NONE};
    return &all[terms->nfriction++];
}

fw_torsion *fw_terms_torsion(const fw_mechanism *mechanism, fw_terms *terms, int pin) {
    if (terms->torsion_of[pin]) return &terms->torsion[terms->torsion_of[pin] - 1];
    fw_torsion *t = &terms->torsion[terms->ntorsion++];
    const fw_pin *p = &mechanism->pin[pin];
    *t = (fw_torsion){pin, p->body_a, p->body_b, 0, 0, p->free_angle_rad};
    terms->torsion_of[pin] = terms->ntorsion;
    return t;
}

fw_slide *fw_terms_slide(fw_terms *terms, int tie) {
    if (terms->slide_of[tie]) return &terms->slide[terms->slide_of[tie] - 1];
    fw_slide *s = &terms->slide[terms->nslide++];
    *s = (fw_slide){tie, 0, 0};
    terms->slide_of[tie] = terms->nslide;
    return s;
}

static double turn_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0 : m->body[body].phi_rad;
}

/* force (fx, fy) at the world point p */
static void push(const fw_mechanism *m, double *force, int body, fw_vec2 p, double fx, double fy) {
    if (body == FW_GROUND) return;
    force[3 * body] += fx;
    force[3 * body + 1] += fy;
    force[3 * body + 2] += (p.x - m->body[body].x_m) * fy - (p.y - m->body[body].y_m) * fx;
}

static void turn(double *force, int body, double torque) {
    if (body != FW_GROUND) force[3 * body + 2] += torque;
}

static void push_at(const fw_mechanism *m, double *force, int body, double x, double y, double fx,
                    double fy) {
    push(m, force, body, fw_local_place(m, body, x, y), fx, fy);
}

bool fw_spring_slack(const fw_mechanism *m, const fw_spring *s) {
    fw_vec2 a = fw_local_place(m, s->body_a, s->ax_m, s->ay_m);
    fw_vec2 b = fw_local_place(m, s->body_b, s->bx_m, s->by_m);
    return s->cable && !(hypot(b.x - a.x, b.y - a.y) > s->length_m);
}

/* timed loads at the start, or with end_s > 0 at the largest of their factor in the scene */
static void add_loads(const fw_mechanism *m, const fw_terms *terms, double end_s, double *force) {
    for (int i = 0; i < terms->nload; i++) {
        const fw_point_load *l = &terms->load[i];
        push_at(m, force, l->body, l->x_m, l->y_m, l->fx_N, l->fy_N);
    }
    for (int i = 0; i < terms->ntimed; i++) {
        const fw_timed_load *l = &terms->timed[i];
        double factor[3];
        fw_law_value(l->law, 0, DBL_MIN, factor); /* the piece that begins at 0 */
        if (end_s > 0) factor[0] = fw_law_largest(l->law, end_s);
        push_at(m, force, l->body, l->x_m, l->y_m, factor[0] * l->fx_N, factor[0] * l->fy_N);
        turn(force, l->body, factor[0] * l->torque_Nm);
    }
}

static void add_springs(const fw_mechanism *m, const fw_terms *terms, double *force) {
    for (int i = 0; i < terms->nspring; i++) {
        const fw_spring *s = &terms->spring[i];
        fw_vec2 a = fw_local_place(m, s->body_a, s->ax_m, s->ay_m);
        fw_vec2 b = fw_local_place(m, s->body_b, s->bx_m, s->by_m);
        double dx = b.x - a.x, dy = b.y - a.y, l = hypot(dx, dy);
        if (!(l > 0) || fw_spring_slack(m, s)) continue;
        double f = s->stiffness_N_per_m * (l - s->length_m) / l;
        push(m, force, s->body_a, a, f * dx, f * dy);
        push(m, force, s->body_b, b, -f * dx, -f * dy);
    }
}

/* -k s ds/dq with the travel s = u (p_b - p_a) - free length and u turning with body a */
static void add_slides(const fw_mechanism *m, const fw_terms *terms, double *force) {
    for (int i = 0; i < terms->nslide; i++) {
        const fw_tie *t = &m->tie[terms->slide[i].tie];
        fw_vec2 a = fw_local_place(m, t->body_a, t->ax_m, t->ay_m);
        fw_vec2 b = fw_local_place(m, t->body_b, t->bx_m, t->by_m);
        double turned = turn_of(m, t->body_a) + t->axis_rad, ux = cos(turned), uy = sin(turned);
        double dx = b.x - a.x, dy = b.y - a.y;
        double f = -terms->slide[i].stiffness_N_per_m * (ux * dx + uy * dy - t->free_length_m);
        push(m, force, t->body_b, b, f * ux, f * uy);
        push(m, force, t->body_a, a, -f * ux, -f * uy);
        turn(force, t->body_a, f * (ux * dy - uy * dx));
    }
}

static void add_torques(const fw_mechanism *m, const fw_terms *terms, double *force) {
    for (int i = 0; i < terms->ntorsion; i++) {
        const fw_torsion *t = &terms->torsion[i];
        double angle = turn_of(m, t->body_b) - turn_of(m, t->body_a) - t->free_angle_rad;
        turn(force, t->body_a, t->stiffness_Nm_per_rad * angle);
        turn(force, t->body_b, -t->stiffness_Nm_per_rad * angle);
    }
    for (int i = 0; i < terms->nstop; i++) {
        const fw_stop *s = &terms->stop[i];
        double angle = turn_of(m, s->body_b) - turn_of(m, s->body_a) - s->free_angle_rad;
        double inside = s->side * (angle - s->at_rad); /* how far the stop is pressed in */
        if (!(inside > 0)) continue;
        turn(force, s->body_a, s->side * s->stiffness_Nm_per_rad * inside);
        turn(force, s->body_b, -s->side * s->stiffness_Nm_per_rad * inside);
    }
}

static void add_all(const fw_mechanism *m, const fw_terms *terms, double end_s, double *force) {
    for (int i = 0; i < 3 * terms->nbody; i++)
        force[i] = terms->constant[i];
    add_loads(m, terms, end_s, force);
    add_torques(m, terms, force);
    add_springs(m, terms, force);
    add_slides(m, terms, force);
    for (int i = 0; i < terms->nelement; i++) {
        double t_s = fw_terms_element_busiest(m, &terms->element[i], end_s);
        fw_terms_element_force(m, &terms->element[i], t_s, fmax(t_s, DBL_MIN), force);
    }
}

void fw_terms_initial_force(const fw_mechanism *m, const fw_terms *terms, double *force) {
    add_all(m, terms, 0, force);
}

void fw_terms_largest_force(const fw_mechanism *m, const fw_terms *terms, double end_s,
                            double *force) {
    add_all(m, terms, end_s, force);
}

const fw_terms *fw_terms_keep(fw_arena *arena, const fw_terms *terms) {
    fw_terms *kept = fw_arena_one(arena, fw_terms);
    if (kept) *kept = *terms;
    return kept;
}
