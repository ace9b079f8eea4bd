/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elements are in the linear motion with their tangent at the drawn pose and at t = 0. What that
   leaves out: a voltage that comes later softens later, a gap that closes makes film and electrodes
   harder, a cable turns.

   For every element the largest of |s_j^T dK s_k / w_j w_k| + |s_j^T dC s_k| / sqrt(w_j w_k)
   (Frobenius) over instants at the drawn pose, and over poses at its busiest instant: all modes at
   their largest amplitudes, with the signs that move two neighbouring ports the farthest in one of
   eight directions or turn them against each other. Poses between and instants between are not
   looked at. Inputs SI; output dimensionless. Cost some 80 n^2 modes per element. Test:
   test_envelope.c, test_bounds.c. */
#include "base/constants.h"
#include "effects/modal.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef struct bend {
    fw_arena *arena;
    const fw_effects_modal *o;
    const fw_effects_force_element *e;
    fw_mechanism moved;
    double *k, *c, *k0, *c0, *product; /* (n x n) and (n) */
    double most;
} bend;

/* Frobenius norm of s^T (a - b) s over omega to `power` of both modes */
static double norm_of(const bend *w, const double *a, const double *b, double power) {
    size_t n = (size_t)w->o->n, m = (size_t)w->o->modes;
    double sum = 0;
    for (size_t j = 0; j < m; j++) {
        for (size_t i = 0; i < n; i++) {
            w->product[i] = 0;
            for (size_t l = 0; l < n; l++)
                w->product[i] += (a[i * n + l] - b[i * n + l]) * w->o->shape[j * n + l];
        }
        for (size_t l = 0; l < m; l++) {
            double value = 0;
            for (size_t i = 0; i < n; i++)
                value += w->o->shape[l * n + i] * w->product[i];
            value /= pow(w->o->omega[j] * w->o->omega[l], power);
            sum += value * value;
        }
    }
    return sqrt(sum);
}

static fw_status compare(bend *w, const fw_mechanism *m, double t_s, double piece_s) {
    size_t size = (size_t)w->o->n * (size_t)w->o->n * sizeof *w->k;
    bool valid;
    memset(w->k, 0, size);
    memset(w->c, 0, size);
    FW_TRY(
        fw_effects_loads_element_tangent_at(w->arena, m, w->e, t_s, piece_s, w->k, w->c, &valid));
    double part = norm_of(w, w->k, w->k0, 1) + norm_of(w, w->c, w->c0, 0.5);
    if (!valid || !isfinite(part)) part = (double)INFINITY;
    w->most = fmax(w->most, part);
    return FW_OK;
}

/* ---- instants ---- */

static fw_status all_along(bend *w) {
    enum { INSTANTS = 64, BREAKS_MOST = 64 };
    double end = w->o->scene->duration_s, at[BREAKS_MOST];
    for (int i = 0; i < INSTANTS && w->e->laws > 0; i++) {
        double t = end * (i + 0.5) / INSTANTS;
        FW_TRY(compare(w, w->o->mechanism, t, t));
    }
    for (int k = 0; k < w->e->laws; k++) {
        int count = fw_quantity_law_breaks_of(w->e->law[k], end, at, BREAKS_MOST);
        for (int i = 0; i < count && i < BREAKS_MOST; i++) {
            FW_TRY(compare(w, w->o->mechanism, at[i], at[i] - 1e-9 * end));
            FW_TRY(compare(w, w->o->mechanism, at[i], at[i] + 1e-9 * end));
        }
    }
    return FW_OK;
}

/* ---- poses ---- */

/* of a port, along (x, y) or, both 0, in turn, under coordinates u (n) */
static double port_way(const bend *w, int port, double x, double y, const double *u) {
    const fw_effects_port *p = &w->e->port[port];
    if (p->body == FW_GROUND) return 0;
    const fw_mechanism_mass *b = &w->o->mechanism->body[p->body];
    fw_geometry_vec2 at = fw_mechanism_local_place(w->o->mechanism, p->body, p->x_m, p->y_m);
    const double *v = u + 3 * p->body;
    if (x == 0 && y == 0) return v[2];
    return x * (v[0] - v[2] * (at.y - b->y_m)) + y * (v[1] + v[2] * (at.x - b->x_m));
}

static void move_by(bend *w, double factor, const double *u) {
    for (int b = 0; b < w->moved.nbody; b++) {
        w->moved.body[b].x_m += factor * u[3 * b];
        w->moved.body[b].y_m += factor * u[3 * b + 1];
        w->moved.body[b].phi_rad += factor * u[3 * b + 2];
    }
}

static fw_status farthest(bend *w, int port, double x, double y, const double *amplitude, double t,
                          double sign) {
    const fw_effects_modal *o = w->o;
    memcpy(w->moved.body, o->mechanism->body, (size_t)o->mechanism->nbody * sizeof *w->moved.body);
    for (int j = 0; j < o->modes; j++) {
        const double *shape = o->shape + (size_t)j * (size_t)o->n;
        double way = port_way(w, port + 1, x, y, shape) - port_way(w, port, x, y, shape);
        move_by(w, sign * (way < 0 ? -amplitude[j] : amplitude[j]), shape);
    }
    for (int i = 0; i < 2; i++)
        if (o->shift[i])
            move_by(w, i ? fw_quantity_law_largest(o->loads->stretch.law, o->scene->duration_s) : 1,
                    o->shift[i]);
    return compare(w, &w->moved, t, fmax(t, DBL_MIN));
}

static fw_status everywhere(bend *w, const double *amplitude) {
    double t = fw_effects_loads_element_busiest(w->o->mechanism, w->e, w->o->scene->duration_s);
    for (int port = 0; port + 1 < w->e->ports; port++)
        for (int i = 0; i < 10; i++) {
            double angle = 0.25 * FW_PI * i;
            bool turn = i >= 8;
            FW_TRY(farthest(w, port, turn ? 0 : cos(angle), turn ? 0 : sin(angle), amplitude, t,
                            i == 9 ? -1 : 1));
        }
    return FW_OK;
}

fw_status fw_effects_modal_bend(fw_arena *arena, const fw_effects_modal *o, const double *amplitude,
                                double *part) {
    size_t n = (size_t)o->n;
    bend w = {.arena = arena, .o = o, .moved = *o->mechanism};
    bool valid;
    *part = 0;
    if (o->loads->nelement == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(w.moved.body = fw_arena_array(arena, fw_mechanism_mass, (size_t)w.moved.nbody));
    FW_NEED(w.k = fw_arena_array(arena, double, n *n));
    FW_NEED(w.c = fw_arena_array(arena, double, n *n));
    FW_NEED(w.k0 = fw_arena_array(arena, double, n *n));
    FW_NEED(w.c0 = fw_arena_array(arena, double, n *n));
    FW_NEED(w.product = fw_arena_array(arena, double, n));
    for (int i = 0; i < o->loads->nelement; i++) {
        w.e = &o->loads->element[i];
        if (w.e->pin != FW_NONE) continue; /* hinges that give: envelope.c */
        w.most = 0;
        memset(w.k0, 0, n * n * sizeof *w.k0);
        memset(w.c0, 0, n * n * sizeof *w.c0);
        FW_TRY(fw_effects_loads_element_tangent_at(arena, o->mechanism, w.e, 0, DBL_MIN, w.k0, w.c0,
                                                   &valid));
        FW_TRY(all_along(&w));
        FW_TRY(everywhere(&w, amplitude));
        *part += w.most;
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* Free strains in the linear motion: arms and ground that are longer by e leave gaps psi in the
   joints. The mechanism is assembled with them where sum M x^2 is least,
     x0 = -M^-1/2 (G M^-1/2)^+ psi,   s^T M x0 = 0 for every mode s,
   and moves from there: x = x0 law + sum s q with q'' + w^2 q = s^T (F - K x0 law): the springs
   answer with a force, and x0 itself is added. Points of loads, springs and elements move too.
   Inputs: strains, dimensionless; outputs m, rad, N, N m. First order in the strain and the turns.
   Cost rows x n. Source: least-norm solution of a linear system; the steps of assembly/ have the
   same norm. Test: test_envelope.c, test_bounds.c.
 */

static fw_status find_gaps(fw_arena *arena, const fw_effects_modal *o, const fw_mechanism *strained,
                           double *shift) {
    const fw_effects_linear *s = &o->linear;
    size_t n = (size_t)o->n, rows = (size_t)s->rows;
    double *gap, *drawn;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(gap = fw_arena_array(arena, double, rows));
    FW_NEED(drawn = fw_arena_array(arena, double, rows));
    fw_effects_linear_gaps(s, o->mechanism, drawn);
    fw_effects_linear_gaps(s, strained, gap);
    memset(shift, 0, n * sizeof *shift);
    for (size_t k = 0; k < rows; k++) {
        double part = 0;
        for (size_t i = 0; i < rows; i++)
            part -= o->holding.u[k * rows + i] * (gap[i] - drawn[i]);
        for (size_t i = 0; i < n; i++)
            shift[i] += o->holding.v[k * n + i] * part / o->holding.sigma[k];
    }
    for (size_t i = 0; i < n; i++)
        shift[i] *= fw_effects_linear_unit(s, (int)i) / sqrt(o->inertia[i]);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* -K x0, and what springs, loads and elements do otherwise because their own points move */
static fw_status find_force(fw_arena *arena, const fw_effects_modal *o,
                            const fw_mechanism *strained, const fw_effects_loads *loads,
                            const double *shift, double *force) {
    const fw_effects_linear *s = &o->linear;
    size_t total = (size_t)s->total, n = (size_t)o->n;
    double *now;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(now = fw_arena_array(arena, double, n));
    fw_effects_loads_initial_force(strained, loads, force);
    fw_effects_loads_initial_force(o->mechanism, o->loads, now);
    for (size_t i = 0; i < n; i++) {
        double answer = 0;
        for (size_t k = 0; k < n; k++)
            answer -= s->a[i * total + k] * shift[k] / fw_effects_linear_unit(s, (int)k);
        force[i] += answer * fw_effects_linear_force_unit(s, (int)i) - now[i];
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

fw_status fw_effects_modal_shift(fw_arena *arena, const fw_effects_modal *o, const double *strain,
                                 double *shift, double *turn, double *force) {
    const fw_mechanism *m = o->mechanism, *strained;
    fw_effects_loads loads = *o->loads;
    size_t size = ((size_t)loads.nbody + 1) * sizeof *strain;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(loads.strain = fw_arena_array(arena, double, (size_t)loads.nbody + 1));
    memcpy(loads.strain, strain, size);
    loads.strained = true;
    FW_TRY(fw_effects_strain(arena, m, &loads, &strained));
    FW_TRY(find_gaps(arena, o, strained, shift));
    FW_TRY(find_force(arena, o, strained, &loads, shift, force));
    for (int i = 0; i < m->npin; i++) {
        int a = m->pin[i].body_a, b = m->pin[i].body_b;
        turn[i] = (b == FW_GROUND ? 0 : shift[3 * b + 2]) - (a == FW_GROUND ? 0 : shift[3 * a + 2]);
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

fw_status fw_effects_modal_find_shifts(fw_arena *arena, fw_effects_modal *o) {
    const fw_effects_loads *t = o->loads;
    double *ground;
    FW_NEED(ground = fw_arena_array(arena, double, (size_t)t->nbody + 1));
    ground[t->nbody] = t->stretch.strain;
    for (int i = 0; i < 2; i++) {
        if (!(i ? t->stretch.law != NULL : t->strained)) continue;
        FW_NEED(o->shift[i] = fw_arena_array(arena, double, (size_t)o->n));
        FW_NEED(o->shift_turn[i] = fw_arena_array(arena, double, (size_t)o->mechanism->npin));
        FW_NEED(o->shift_force[i] = fw_arena_array(arena, double, (size_t)o->n));
        FW_NEED(o->shift_drag[i] = fw_arena_array(arena, double, (size_t)o->modes));
        FW_TRY(fw_effects_modal_shift(arena, o, i ? ground : t->strain, o->shift[i],
                                      o->shift_turn[i], o->shift_force[i]));
    }
    return FW_OK;
}

/* a damper between the ground and a body pulls the body along its line */
static void drag_spring(const fw_effects_modal *o, const fw_device_spring *p, double *force) {
    const fw_mechanism *m = o->mechanism;
    const fw_effects_stretch *t = &o->loads->stretch;
    bool ground_is_a = p->body_a == FW_GROUND;
    if (ground_is_a == (p->body_b == FW_GROUND) || p->damping_Ns_per_m == 0) return;
    fw_geometry_vec2 a = fw_mechanism_local_place(m, p->body_a, p->ax_m, p->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, p->body_b, p->bx_m, p->by_m);
    fw_geometry_vec2 fixed = ground_is_a ? a : b, at = ground_is_a ? b : a;
    double dx = b.x - a.x, dy = b.y - a.y, l = hypot(dx, dy);
    if (!(l > 0)) return;
    double rate = t->strain * ((fixed.x - t->centre_m.x) * dx + (fixed.y - t->centre_m.y) * dy) / l;
    double fx = p->damping_Ns_per_m * rate * dx / l, fy = p->damping_Ns_per_m * rate * dy / l;
    int body = ground_is_a ? p->body_b : p->body_a;
    force[3 * body] += fx, force[3 * body + 1] += fy;
    force[3 * body + 2] += (at.x - m->body[body].x_m) * fy - (at.y - m->body[body].y_m) * fx;
}

/* modal forces (modes) += of films and dampers that the moving ground drags along, per 1/s */
fw_status fw_effects_modal_drag(fw_arena *arena, const fw_effects_modal *o, double *mode) {
    const fw_effects_loads *t = o->loads;
    double *force;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(force = fw_arena_array(arena, double, (size_t)o->n));
    for (int i = 0; i < t->nelement; i++)
        fw_effects_loads_element_drag(o->mechanism, &t->element[i], t->stretch.strain,
                                      t->stretch.centre_m, force);
    for (int i = 0; i < t->nspring; i++)
        drag_spring(o, &t->spring[i], force);
    for (int j = 0; j < o->modes; j++)
        for (int i = 0; i < o->n; i++)
            mode[j] += o->shape[(size_t)j * (size_t)o->n + (size_t)i] * force[i];
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* The pose that is assembled and the equilibrium near it differ by squares of the turns, which
   ring. The factor is that of `widen` in envelope.c: found by trial, 0.8 was seen (test_bounds.c)
 */
double fw_effects_modal_second(const fw_effects_modal *o) {
    double most = 0;
    for (int i = 0; i < 2; i++) {
        if (!o->shift[i]) continue;
        double turn = 0;
        for (int k = 0; k < o->mechanism->npin; k++)
            turn = fmax(turn, fabs(o->shift_turn[i][k]));
        for (int k = 2; k < o->n; k += 3)
            turn = fmax(turn, fabs(o->shift[i][k]));
        most +=
            turn * (i ? fw_quantity_law_largest(o->loads->stretch.law, o->scene->duration_s) : 1);
    }
    return 4 * most * most;
}

double fw_effects_modal_shifted(const fw_effects_modal *o, int pin, double t_s, double piece_s) {
    double sum = 0, law[3];
    if (o->shift[0]) sum += o->shift_turn[0][pin];
    if (o->shift[1]) {
        fw_quantity_law_value(o->loads->stretch.law, t_s, piece_s, law);
        sum += law[0] * o->shift_turn[1][pin];
    }
    return sum;
}
