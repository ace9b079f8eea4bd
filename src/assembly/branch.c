/* SPDX-License-Identifier: GPL-3.0-or-later */
/* On which side the elbows of a mechanism stand, and its other assemblies: every elbow mirrored in
   turn, breadth first. */
#include "assembly/closure.h"
#include "base/constants.h"
#include <math.h>
#include <string.h>

/* ---- geometry of dyads, SI ---- */

static fw_geometry_vec2 at(const double *q, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_geometry_vec2){x, y};
    double c = cos(q[3 * body + 2]), s = sin(q[3 * body + 2]);
    return (fw_geometry_vec2){q[3 * body] + c * x - s * y, q[3 * body + 1] + s * x + c * y};
}

static fw_geometry_vec2 pin_at(const fw_mechanism *m, const double *q, int pin, int body) {
    const fw_mechanism_pin *p = &m->pin[pin];
    return p->body_a == body ? at(q, body, p->ax_m, p->ay_m) : at(q, body, p->bx_m, p->by_m);
}

/* where the body itself says that its anchor is */
static fw_geometry_vec2 anchor_at(const fw_mechanism *m, const double *q, fw_assembly_anchor anchor,
                                  int body) {
    return pin_at(m, q, anchor.pin, body);
}

static fw_geometry_vec2 elbow_at(const fw_mechanism *m, const double *q,
                                 const fw_assembly_elbow *e) {
    fw_geometry_vec2 a = pin_at(m, q, e->pin, e->body_a), b = pin_at(m, q, e->pin, e->body_b);
    return (fw_geometry_vec2){0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}

static fw_geometry_vec2 axis_of(const fw_mechanism *m, const double *q, int joint) {
    const fw_device_joint *t = &m->joint[joint];
    double angle = t->axis_rad + (t->body_a == FW_GROUND ? 0 : q[3 * t->body_a + 2]);
    return (fw_geometry_vec2){cos(angle), sin(angle)};
}

static bool slides(const fw_assembly_elbow *e) {
    return e->a.joint != FW_NONE || e->b.joint != FW_NONE;
}

int fw_assembly_elbow_side(const fw_mechanism *m, const double *q, const fw_assembly_elbow *e) {
    fw_geometry_vec2 p = elbow_at(m, q, e);
    double value, size;
    if (slides(e)) {
        bool a_slides = e->a.joint != FW_NONE;
        fw_geometry_vec2 c =
            anchor_at(m, q, a_slides ? e->b : e->a, a_slides ? e->body_b : e->body_a);
        fw_geometry_vec2 axis = axis_of(m, q, a_slides ? e->a.joint : e->b.joint);
        value = axis.x * (p.x - c.x) + axis.y * (p.y - c.y);
        size = hypot(p.x - c.x, p.y - c.y);
    } else {
        fw_geometry_vec2 a = anchor_at(m, q, e->a, e->body_a), b = anchor_at(m, q, e->b, e->body_b);
        value = (p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x);
        size = hypot(p.x - a.x, p.y - a.y) * hypot(b.x - a.x, b.y - a.y);
    }
    if (!(fabs(value) > 1e-7 * size)) return 0;
    return value > 0 ? 1 : -1;
}

/* ---- which dyads there are ---- */

static bool is_welded(const fw_mechanism *m, const fw_mechanism_pin *p, int pin) {
    for (int i = 0; i < m->ndriver; i++)
        if (m->driver[i].revolute == pin) return true;
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        bool same = (t->body_a == p->body_a && t->body_b == p->body_b) ||
                    (t->body_a == p->body_b && t->body_b == p->body_a);
        if (same) return true;
    }
    return false;
}

/* the first pin, else the first prismatic joint, that holds the body against a third one */
static bool find_anchor(const fw_mechanism *m, int body, int other, fw_assembly_anchor *anchor) {
    *anchor = (fw_assembly_anchor){FW_NONE, FW_NONE};
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        int to = p->body_a == body ? p->body_b : p->body_b == body ? p->body_a : other;
        if (to == other) continue;
        anchor->pin = i;
        return true;
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        int to = t->body_a == body ? t->body_b : t->body_b == body ? t->body_a : other;
        if (to == other || t->kind != FW_JOINT_PRISMATIC || t->body_b != body) continue;
        anchor->joint = i;
        return true;
    }
    return false;
}

fw_status fw_assembly_elbows_find(fw_arena *arena, const fw_mechanism *m, fw_assembly_elbow **elbow,
                                  int *count) {
    *count = 0;
    FW_NEED(*elbow = fw_arena_array(arena, fw_assembly_elbow, (size_t)m->npin));
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        fw_assembly_elbow e = {
            .id = fw_text_name(p->id), .pin = i, .body_a = p->body_a, .body_b = p->body_b};
        if (p->body_a == FW_GROUND || p->body_b == FW_GROUND || is_welded(m, p, i)) continue;
        bool again = false; /* two pins between the same bodies: one body */
        for (int k = 0; k < m->npin; k++) {
            const fw_mechanism_pin *o = &m->pin[k];
            again = again || (k < i && ((o->body_a == p->body_a && o->body_b == p->body_b) ||
                                        (o->body_a == p->body_b && o->body_b == p->body_a)));
        }
        if (again || !find_anchor(m, p->body_a, p->body_b, &e.a) ||
            !find_anchor(m, p->body_b, p->body_a, &e.b) ||
            (e.a.joint != FW_NONE && e.b.joint != FW_NONE))
            continue;
        (*elbow)[(*count)++] = e;
    }
    return FW_OK;
}

/* ---- mirroring ---- */

static void turn_about(double *q, int body, fw_geometry_vec2 c, double angle) {
    double co = cos(angle), si = sin(angle);
    double x = q[3 * body] - c.x, y = q[3 * body + 1] - c.y;
    q[3 * body] = c.x + co * x - si * y;
    q[3 * body + 1] = c.y + si * x + co * y;
    q[3 * body + 2] += angle;
}

static double angle_between(fw_geometry_vec2 c, fw_geometry_vec2 from, fw_geometry_vec2 to) {
    double ax = from.x - c.x, ay = from.y - c.y, bx = to.x - c.x, by = to.y - c.y;
    return atan2(ax * by - ay * bx, ax * bx + ay * by);
}

/* P to the other side: bodies turn about their pins, a slider shifts along its axis */
static void mirror(const fw_mechanism *m, const fw_assembly_elbow *e, double *q) {
    fw_geometry_vec2 p = elbow_at(m, q, e);
    if (slides(e)) {
        bool a_slides = e->a.joint != FW_NONE;
        int slider = a_slides ? e->body_a : e->body_b, rod = a_slides ? e->body_b : e->body_a;
        fw_geometry_vec2 c = anchor_at(m, q, a_slides ? e->b : e->a, rod);
        fw_geometry_vec2 axis = axis_of(m, q, a_slides ? e->a.joint : e->b.joint);
        double along = axis.x * (p.x - c.x) + axis.y * (p.y - c.y);
        fw_geometry_vec2 to = {p.x - 2 * along * axis.x, p.y - 2 * along * axis.y};
        q[3 * slider] += to.x - p.x, q[3 * slider + 1] += to.y - p.y;
        turn_about(q, rod, c, angle_between(c, p, to));
        return;
    }
    fw_geometry_vec2 a = anchor_at(m, q, e->a, e->body_a), b = anchor_at(m, q, e->b, e->body_b);
    double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    if (!(square > 0)) return;
    double off = 2 * ((p.x - a.x) * -dy + (p.y - a.y) * dx) / square;
    fw_geometry_vec2 to = {p.x + off * dy, p.y - off * dx};
    turn_about(q, e->body_a, a, angle_between(a, p, to));
    turn_about(q, e->body_b, b, angle_between(b, p, to));
}

/* ---- other assemblies ---- */

typedef struct hunt {
    fw_arena *arena;
    const fw_mechanism *mechanism;
    fw_assembly *found;
    fw_diags *diags;
    fw_assembly_closure c; /* of a model that stands in the guess */
    int *group;
    double *q;
    int *side;
    double mass; /* scaled, of all bodies */
} hunt;

static void sides_of(const hunt *h, const double *q, int *side) {
    for (int i = 0; i < h->found->nelbow; i++)
        side[i] = fw_assembly_elbow_side(h->mechanism, q, &h->found->elbow[i]);
}

/* the same sides; where nothing can move, the same place too */
static bool same(const hunt *h, const double *q, const int *side, const double *other_q,
                 const int *other_side) {
    const fw_assembly *f = h->found;
    double apart = 0, turn = 2 * FW_PI;
    for (int i = 0; i < f->nelbow; i++)
        if (side[i] != other_side[i] && side[i] != 0 && other_side[i] != 0) return false;
    if (!f->rank.known || f->rank.dof > 0) return true;
    for (int i = 0; i < 3 * f->nbody; i++) {
        double d = q[i] - other_q[i];
        apart = fmax(apart,
                     i % 3 == 2 ? fabs(remainder(d, turn)) : fabs(d) / h->c.model->scale.length_m);
    }
    return apart < 1e-6;
}

static bool known(const hunt *h, const double *q, const int *side) {
    const fw_assembly *f = h->found;
    int *first = h->group; /* sides of the answer, in work that is free now */
    for (int i = 0; i < f->nelbow; i++)
        first[i] = f->elbow[i].found;
    if (same(h, q, side, f->after, first)) return true;
    for (int i = 0; i < f->nalternative; i++)
        if (same(h, q, side, f->alternative[i].q, f->alternative[i].side)) return true;
    return false;
}

static void to_SI(const hunt *h, const double *u, double *q) {
    for (int i = 0; i < 3 * h->found->nbody; i++)
        q[i] = h->found->before[i] + (i % 3 == 2 ? 1 : h->c.model->scale.length_m) * u[i];
}

/* closes from h->q and, when that is a new assembly, moves within it towards the guess */
static bool close_from(hunt *h) {
    const fw_assembly *f = h->found;
    fw_assembly_closure *c = &h->c;
    int n = 3 * f->nbody;
    for (int i = 0; i < n; i++)
        c->u[i] = (h->q[i] - f->before[i]) / (i % 3 == 2 ? 1 : c->model->scale.length_m);
    c->left = 400;
    if (!fw_assembly_closure_descend(c, 60)) return false;
    fw_assembly_closure_unwind(c, h->group);
    to_SI(h, c->u, h->q);
    sides_of(h, h->q, h->side);
    if (known(h, h->q, h->side)) return false;
    c->left = 2000;
    fw_assembly_closure_nearest(c);
    double *nearer = c->trial;
    to_SI(h, c->u, nearer);
    int *side = h->side + f->nelbow;
    sides_of(h, nearer, side);
    if (known(h, nearer, side)) { /* the way to the guess leads into another one: stay */
        for (int i = 0; i < n; i++)
            c->u[i] = (h->q[i] - f->before[i]) / (i % 3 == 2 ? 1 : c->model->scale.length_m);
        return true;
    }
    memcpy(h->q, nearer, (size_t)n * sizeof(double));
    memcpy(h->side, side, (size_t)f->nelbow * sizeof(int));
    return true;
}

static fw_status keep(hunt *h) {
    fw_assembly *f = h->found;
    fw_assembly_alternative *to = &f->alternative[f->nalternative];
    size_t n = 3 * (size_t)f->nbody;
    FW_NEED(to->q = fw_arena_array(h->arena, double, n));
    FW_NEED(to->side = fw_arena_array(h->arena, int, (size_t)f->nelbow));
    memcpy(to->q, h->q, n * sizeof(double));
    memcpy(to->side, h->side, (size_t)f->nelbow * sizeof(int));
    to->distance_m =
        sqrt(fw_assembly_closure_distance(&h->c, h->c.u) / h->mass) * h->c.model->scale.length_m;
    f->nalternative++;
    return FW_OK;
}

static fw_status hunt_new(hunt *h) {
    const fw_assembly *f = h->found;
    size_t n = (size_t)f->nbody, most = (n > (size_t)f->nelbow ? n : (size_t)f->nelbow) + 1;
    FW_TRY(fw_assembly_closure_new(h->arena, h->mechanism, f->before, h->diags, &h->c));
    FW_NEED(h->group = fw_arena_array(h->arena, int, most));
    FW_NEED(h->q = fw_arena_array(h->arena, double, 3 * n));
    FW_NEED(h->side = fw_arena_array(h->arena, int, 2 * (size_t)f->nelbow));
    for (int b = 0; b < f->nbody; b++)
        h->mass += h->c.model->mass[b];
    return FW_OK;
}

static void sort_by_distance(fw_assembly_alternative *a, int count) {
    for (int i = 1; i < count; i++) {
        fw_assembly_alternative take = a[i];
        int k = i;
        for (; k > 0 && a[k - 1].distance_m > take.distance_m; k--)
            a[k] = a[k - 1];
        a[k] = take;
    }
}

/* found->elbow, after and rank are there. Bounded: FW_ALTERNATIVES_MOST results, 160 tries. */
fw_status fw_assembly_alternatives_find(fw_arena *arena, const fw_mechanism *mechanism,
                                        fw_diags *diags, fw_assembly *found) {
    enum { TRIES = 160 };
    hunt h = {.arena = arena, .mechanism = mechanism, .found = found, .diags = diags};
    size_t n = 3 * (size_t)found->nbody;
    if (found->nelbow == 0) return FW_OK;
    FW_NEED(found->alternative =
                fw_arena_array(arena, fw_assembly_alternative, FW_ALTERNATIVES_MOST));
    FW_TRY(hunt_new(&h));
    int tries = 0;
    for (int from = -1; from < found->nalternative; from++)
        for (int e = 0; e < found->nelbow; e++) {
            if (found->nalternative == FW_ALTERNATIVES_MOST || tries++ == TRIES) {
                found->more = true;
                sort_by_distance(found->alternative, found->nalternative);
                return FW_OK;
            }
            memcpy(h.q, from < 0 ? found->after : found->alternative[from].q, n * sizeof(double));
            mirror(mechanism, &found->elbow[e], h.q);
            if (close_from(&h)) FW_TRY(keep(&h));
        }
    sort_by_distance(found->alternative, found->nalternative);
    return FW_OK;
}
