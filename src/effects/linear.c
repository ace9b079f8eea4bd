/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/modal.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

static void put(const fw_effects_linear *s, int i, int j, double value) {
    s->a[(size_t)i * (size_t)s->total + (size_t)j] += value;
}

static fw_geometry_vec2 arm(const fw_mechanism *m, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_geometry_vec2){x, y};
    double c = cos(m->body[body].phi_rad), s = sin(m->body[body].phi_rad);
    return (fw_geometry_vec2){c * x - s * y, s * x + c * y};
}

static void add_arm(int body, double x, double y, double *sum, int *count) {
    if (body == FW_GROUND) return;
    *sum += hypot(x, y);
    ++*count;
}

/* mean distance between the centres of mass and the points of joints and springs, m */
static double typical_length(const fw_mechanism *m) {
    double sum = 0;
    int count = 0;
    for (int i = 0; i < m->npin; i++) {
        add_arm(m->pin[i].body_a, m->pin[i].ax_m, m->pin[i].ay_m, &sum, &count);
        add_arm(m->pin[i].body_b, m->pin[i].bx_m, m->pin[i].by_m, &sum, &count);
    }
    for (int i = 0; i < m->njoint; i++) {
        add_arm(m->joint[i].body_a, m->joint[i].ax_m, m->joint[i].ay_m, &sum, &count);
        add_arm(m->joint[i].body_b, m->joint[i].bx_m, m->joint[i].by_m, &sum, &count);
    }
    for (int i = 0; i < m->nspring && sum == 0; i++) {
        add_arm(m->spring[i].body_a, m->spring[i].ax_m, m->spring[i].ay_m, &sum, &count);
        add_arm(m->spring[i].body_b, m->spring[i].bx_m, m->spring[i].by_m, &sum, &count);
    }
    return sum > 0 ? sum / count : 1;
}

static void add_torsion(const fw_effects_linear *s, const fw_effects_torsion *t) {
    double k = t->stiffness_Nm_per_rad / (s->stiffness_N_per_m * s->length_m * s->length_m);
    int a = t->body_a == FW_GROUND ? -1 : 3 * t->body_a + 2;
    int b = t->body_b == FW_GROUND ? -1 : 3 * t->body_b + 2;
    if (a >= 0) put(s, a, a, k);
    if (b >= 0) put(s, b, b, k);
    if (a >= 0 && b >= 0) put(s, a, b, -k), put(s, b, a, -k);
}

/* what changes a length along the unit vector u between point a and point b: -u on a, u on b, with
   their arms */
typedef struct line {
    int index[6], count;
    double row[6];
} line;

static void add_end(const fw_effects_linear *s, line *l, int body, fw_geometry_vec2 r, double ux,
                    double uy, double sign) {
    if (body == FW_GROUND) return;
    const double part[3] = {sign * ux, sign * uy, sign * (r.x * uy - r.y * ux) / s->length_m};
    for (int c = 0; c < 3; c++, l->count++)
        l->index[l->count] = 3 * body + c, l->row[l->count] = part[c];
}

/* k u u^T along the line: the material part of the tangent */
static void add_stiffness(const fw_effects_linear *s, const line *l, double k) {
    for (int i = 0; i < l->count; i++)
        for (int j = 0; j < l->count; j++)
            put(s, l->index[i], l->index[j], k * l->row[i] * l->row[j]);
}

/* where the rows of the constraints go: into the matrix, or with lambda to their forces */
typedef struct holding {
    const fw_effects_linear *s;
    const double *lambda; /* (rows) or NULL */
    double *force;        /* (n) += G^T lambda */
} holding;

static void add_row(const holding *h, int row, const line *l) {
    const fw_effects_linear *s = h->s;
    for (int i = 0; i < l->count; i++)
        if (h->lambda)
            h->force[l->index[i]] += h->lambda[row] * l->row[i];
        else
            put(s, s->n + row, l->index[i], l->row[i]), put(s, l->index[i], s->n + row, l->row[i]);
}

static void add_spring_along(const fw_effects_linear *s, const fw_mechanism *m,
                             const fw_device_spring *p, double ux, double uy) {
    line along = {.count = 0};
    add_end(s, &along, p->body_a, arm(m, p->body_a, p->ax_m, p->ay_m), ux, uy, -1);
    add_end(s, &along, p->body_b, arm(m, p->body_b, p->bx_m, p->by_m), ux, uy, 1);
    add_stiffness(s, &along, p->stiffness_N_per_m / s->stiffness_N_per_m);
}

bool fw_effects_spring_slack(const fw_mechanism *m, const fw_device_spring *s) {
    fw_geometry_vec2 a = fw_mechanism_local_place(m, s->body_a, s->ax_m, s->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, s->body_b, s->bx_m, s->by_m);
    return s->cable && !(hypot(b.x - a.x, b.y - a.y) > s->length_m);
}

/* points that coincide: a spring without length holds them in all directions */
static void add_spring(const fw_effects_linear *s, const fw_mechanism *m,
                       const fw_device_spring *p) {
    fw_geometry_vec2 a = fw_mechanism_local_place(m, p->body_a, p->ax_m, p->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, p->body_b, p->bx_m, p->by_m);
    double dx = b.x - a.x, dy = b.y - a.y, l = hypot(dx, dy);
    if (l > 0 && !fw_effects_spring_slack(m, p)) add_spring_along(s, m, p, dx / l, dy / l);
    if (l > 0 || p->length_m != 0) return;
    add_spring_along(s, m, p, 1, 0);
    add_spring_along(s, m, p, 0, 1);
}

/* a direction (ux, uy) fixed in body a: turning it moves the point b, at a distance from a */
static line joint_line(const fw_effects_linear *s, const fw_mechanism *m, const fw_device_joint *t,
                       double ux, double uy, bool turns) {
    fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
    fw_geometry_vec2 ra = arm(m, t->body_a, t->ax_m, t->ay_m),
                     rb = arm(m, t->body_b, t->bx_m, t->by_m);
    if (turns) ra.x += b.x - a.x, ra.y += b.y - a.y;
    line l = {.count = 0};
    add_end(s, &l, t->body_a, ra, ux, uy, -1);
    add_end(s, &l, t->body_b, rb, ux, uy, 1);
    return l;
}

static line joint_axis(const fw_effects_linear *s, const fw_mechanism *m, const fw_device_joint *t,
                       bool normal) {
    double turned = t->axis_rad + (t->body_a == FW_GROUND ? 0 : m->body[t->body_a].phi_rad);
    double c = cos(turned), n = sin(turned);
    return normal ? joint_line(s, m, t, -n, c, true) : joint_line(s, m, t, c, n, true);
}

/* phi_b - phi_a held */
static void hold_angle(const holding *h, int row, int body_a, int body_b) {
    line l = {.count = 0};
    if (body_a != FW_GROUND) l.index[l.count] = 3 * body_a + 2, l.row[l.count++] = -1;
    if (body_b != FW_GROUND) l.index[l.count] = 3 * body_b + 2, l.row[l.count++] = 1;
    add_row(h, row, &l);
}

static int joint_rows(const fw_device_joint *t) {
    return t->kind == FW_JOINT_PRISMATIC ? 2 : t->kind == FW_JOINT_DISTANCE ? 1 : 3;
}

/* a driver holds one motion more; that of a rod replaces its length */
static int driver_rows(const fw_mechanism *m, const fw_device_driver *d) {
    return d->joint == FW_NONE || m->joint[d->joint].kind == FW_JOINT_PRISMATIC;
}

static void add_joint(const holding *h, const fw_mechanism *m, const fw_device_joint *t, int row) {
    fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
    double dx = b.x - a.x, dy = b.y - a.y, length = hypot(dx, dy);
    line l;
    switch (t->kind) {
    case FW_JOINT_PRISMATIC:
        l = joint_axis(h->s, m, t, true);
        add_row(h, row, &l);
        hold_angle(h, row + 1, t->body_a, t->body_b);
        return;
    case FW_JOINT_DISTANCE:
        l = joint_line(h->s, m, t, length > 0 ? dx / length : 1, length > 0 ? dy / length : 0,
                       false);
        add_row(h, row, &l);
        return;
    case FW_JOINT_WELD:
        l = joint_line(h->s, m, t, 1, 0, false);
        add_row(h, row, &l);
        l = joint_line(h->s, m, t, 0, 1, false);
        add_row(h, row + 1, &l);
        hold_angle(h, row + 2, t->body_a, t->body_b);
        return;
    }
}

static void add_constraints(const holding *h, const fw_mechanism *m) {
    int row = 0;
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        if (h->s->pin_row[i] == FW_NONE) continue;
        const fw_device_joint same = {.body_a = p->body_a,
                                      .body_b = p->body_b,
                                      .ax_m = p->ax_m,
                                      .ay_m = p->ay_m,
                                      .bx_m = p->bx_m,
                                      .by_m = p->by_m};
        line x = joint_line(h->s, m, &same, 1, 0, false),
             y = joint_line(h->s, m, &same, 0, 1, false);
        add_row(h, row, &x);
        add_row(h, row + 1, &y);
        row += 2;
    }
    for (int i = 0; i < m->njoint; row += joint_rows(&m->joint[i]), i++)
        add_joint(h, m, &m->joint[i], row);
    for (int i = 0; i < m->ndriver; row += driver_rows(m, &m->driver[i]), i++) {
        const fw_device_driver *d = &m->driver[i];
        if (d->joint == FW_NONE)
            hold_angle(h, row, m->pin[d->revolute].body_a, m->pin[d->revolute].body_b);
        else if (m->joint[d->joint].kind == FW_JOINT_PRISMATIC) {
            line l = joint_axis(h->s, m, &m->joint[d->joint], false);
            add_row(h, row, &l);
        }
    }
}

/* largest stiffness, N/m: the unit of the rows of forces; 0 when nothing is elastic */
static double typical_stiffness(const fw_effects_loads *loads, double length) {
    double most = 0;
    for (int i = 0; i < loads->ntorsion; i++)
        most = fmax(most, loads->torsion[i].stiffness_Nm_per_rad / (length * length));
    for (int i = 0; i < loads->nspring; i++)
        most = fmax(most, loads->spring[i].stiffness_N_per_m);
    for (int i = 0; i < loads->nslide; i++)
        most = fmax(most, loads->slide[i].stiffness_N_per_m);
    for (int i = 0; i < loads->nelement; i++)
        most = fmax(most, loads->element[i].size_N_per_m);
    return most;
}

static void add_elastic(const fw_effects_linear *s, const fw_mechanism *m,
                        const fw_effects_loads *loads) {
    for (int i = 0; i < loads->ntorsion; i++)
        add_torsion(s, &loads->torsion[i]);
    for (int i = 0; i < loads->nspring; i++)
        add_spring(s, m, &loads->spring[i]);
    for (int i = 0; i < loads->nslide; i++) {
        line l = joint_axis(s, m, &m->joint[loads->slide[i].joint], false);
        add_stiffness(s, &l, loads->slide[i].stiffness_N_per_m / s->stiffness_N_per_m);
    }
}

static fw_status add_elements(fw_arena *arena, const fw_effects_linear *s, const fw_mechanism *m,
                              const fw_effects_loads *loads) {
    if (loads->nelement == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    size_t n = (size_t)s->n;
    double *whole;
    FW_NEED(whole = fw_arena_array(arena, double, n *n));
    FW_TRY(fw_effects_loads_element_tangent(arena, m, loads, whole, NULL));
    for (int i = 0; i < s->n; i++)
        for (int j = 0; j < s->n; j++)
            put(s, i, j,
                whole[(size_t)i * n + (size_t)j] * fw_effects_linear_unit(s, j) /
                    fw_effects_linear_force_unit(s, i));
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

static int rows_of(const fw_mechanism *m, const fw_effects_loads *loads) {
    int rows = 0;
    for (int i = 0; i < m->npin; i++)
        rows += loads->released && loads->released[i] ? 0 : 2;
    for (int i = 0; i < m->njoint; i++)
        rows += joint_rows(&m->joint[i]);
    for (int i = 0; i < m->ndriver; i++)
        rows += driver_rows(m, &m->driver[i]);
    return rows;
}

int fw_effects_linear_size(const fw_mechanism *m, const fw_effects_loads *loads) {
    return m->nbody > FW_RESPONSE_MOST ? 3 * m->nbody : 3 * m->nbody + rows_of(m, loads);
}

double fw_effects_linear_unit(const fw_effects_linear *s, int i) {
    return i % 3 == 2 ? 1 : s->length_m;
}

double fw_effects_linear_force_unit(const fw_effects_linear *s, int i) {
    return s->stiffness_N_per_m * s->length_m * (i % 3 == 2 ? s->length_m : 1);
}

/* K of torsions, springs along their lines, slides and elements, and the rows G of joints and
   drivers. Geometric stiffness of what already pulls (lambda Psi_qq, turning loads, springs across
   their lines) is left out but for the elements'. Cost (3 nbody + rows)^2. Source: linearisation of
   the equations in docs/theory/dynamics.md. Test: test_effects.c, test_envelope.c. */
fw_status fw_effects_linear_new(fw_arena *arena, const fw_mechanism *m,
                                const fw_effects_loads *loads, fw_effects_linear *s,
                                bool *elastic) {
    *s = (fw_effects_linear){
        .n = 3 * m->nbody, .rows = rows_of(m, loads), .length_m = typical_length(m)};
    s->total = s->n + s->rows;
    s->stiffness_N_per_m = typical_stiffness(loads, s->length_m);
    *elastic = s->stiffness_N_per_m > 0;
    int row = 0;
    FW_NEED(s->pin_row = fw_arena_array(arena, int, (size_t)m->npin));
    FW_NEED(s->joint_row = fw_arena_array(arena, int, (size_t)m->njoint));
    for (int i = 0; i < m->npin; i++) {
        bool released = loads->released && loads->released[i];
        s->pin_row[i] = released ? FW_NONE : row;
        row += released ? 0 : 2;
    }
    for (int i = 0; i < m->njoint; row += joint_rows(&m->joint[i]), i++)
        s->joint_row[i] = row;
    if (!*elastic) return FW_OK;
    FW_NEED(s->a = fw_arena_array(arena, double, (size_t)s->total *(size_t)s->total));
    add_elastic(s, m, loads);
    FW_TRY(add_elements(arena, s, m, loads));
    const holding rows = {.s = s};
    add_constraints(&rows, m);
    return FW_OK;
}

void fw_effects_linear_hold(const fw_effects_linear *s, const fw_mechanism *m, const double *lambda,
                            double *force) {
    const holding held = {s, lambda, force};
    add_constraints(&held, m);
}

/* b less a, along and across the direction that the joint holds */
static int joint_gaps(const fw_effects_linear *s, const fw_mechanism *m, const fw_device_joint *t,
                      double *gap) {
    fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
    double dx = (b.x - a.x) / s->length_m, dy = (b.y - a.y) / s->length_m;
    double turned = t->axis_rad + (t->body_a == FW_GROUND ? 0 : m->body[t->body_a].phi_rad);
    if (t->kind == FW_JOINT_PRISMATIC)
        gap[0] = -sin(turned) * dx + cos(turned) * dy;
    else if (t->kind == FW_JOINT_DISTANCE)
        gap[0] = hypot(dx, dy);
    else
        gap[0] = dx, gap[1] = dy;
    return joint_rows(t);
}

void fw_effects_linear_gaps(const fw_effects_linear *s, const fw_mechanism *m, double *gap) {
    int row = 0;
    memset(gap, 0, (size_t)s->rows * sizeof *gap);
    for (int i = 0; i < m->npin; i++) {
        if (s->pin_row[i] == FW_NONE) continue;
        fw_geometry_vec2 a = fw_mechanism_pin_place(m, &m->pin[i], 0),
                         b = fw_mechanism_pin_place(m, &m->pin[i], 1);
        gap[row++] = (b.x - a.x) / s->length_m;
        gap[row++] = (b.y - a.y) / s->length_m;
    }
    for (int i = 0; i < m->njoint; i++)
        row += joint_gaps(s, m, &m->joint[i], gap + row);
}

/* LU of the whole; error round-off times condition; cost total^3 / 3 */
fw_status fw_effects_linear_solve(fw_arena *arena, const fw_effects_linear *s, const double *force,
                                  double *x, bool *valid) {
    double largest = 0;
    for (int i = 0; i < s->total; i++) {
        x[i] = i < s->n ? force[i] : 0;
        largest = fmax(largest, fabs(x[i]));
    }
    for (int i = 0; i < s->n && largest > 0; i++) /* the answer is linear: solve for a unit load */
        x[i] /= largest;
    FW_TRY(fw_maths_dense_solve_symmetric(arena, s->total, s->a, x, x, valid));
    for (int i = 0; i < s->total; i++) {
        x[i] *= largest;
        *valid = *valid && isfinite(x[i]);
    }
    return FW_OK;
}

/* Pins that an element stands for: how the modes open them, and with what force the element then
   acts. With u of a mode, D = (places of b) - (places of a) at W, and the force on b is -K u of the
   element's tangent as drawn. Their forces, as those of pins, take from the stiffness: a force f on
   body b at the arm r does the work f . r'' under a turn, so that (phi_b, phi_b) gains r . f, and
   (phi_a, phi_a) loses it. Inputs and outputs SI. Source: second variation of the potential of a
   force at a point of a body. Test: test_linear.c. */

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
