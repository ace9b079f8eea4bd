/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free strains in the linear motion: arms and ground that are longer by e leave gaps psi in the
   joints. The mechanism is assembled with them where sum M x^2 is least,
     x0 = -M^-1/2 (G M^-1/2)^+ psi,   s^T M x0 = 0 for every mode s,
   and moves from there: x = x0 law + sum s q with q'' + w^2 q = s^T (F - K x0 law): the springs
   answer with a force, and x0 itself is added. Points of loads, springs and elements move too.
   Inputs: strains, dimensionless; outputs m, rad, N, N m. First order in the strain and the turns.
   Cost rows x n. Source: least-norm solution of a linear system; the steps of assembly/ have the
   same norm. Test: test_envelope.c, test_bounds.c.
 */
#include "effects/modal.h"
#include <math.h>
#include <string.h>

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
