/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free strains in the linear motion: arms and ground that are longer by e leave gaps psi in the
   joints. The mechanism is assembled with them where sum M x^2 is least,
     x0 = -M^-1/2 (G M^-1/2)^+ psi,   s^T M x0 = 0 for every mode s,
   and moves from there: x = x0 law + sum s q with q'' + w^2 q = s^T (F - K x0 law): the springs
   answer with a force, and x0 itself is added. Inputs: strains, dimensionless; outputs m, rad, N,
   N m. First order in the strain and the turns. Cost rows x n. Source: least-norm solution of a
   linear system; the steps of assembly/ have the same norm. Test: test_envelope.c, test_bounds.c.
 */
#include "effects/modal.h"
#include <math.h>
#include <string.h>

fw_status fw_modal_shift(fw_arena *arena, const fw_modal *o, const double *strain, double *shift,
                         double *turn) {
    const fw_linear *s = &o->linear;
    const fw_mechanism *m = o->mechanism, *strained;
    size_t n = (size_t)o->n, rows = (size_t)s->rows;
    double *gap, *drawn;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(gap = fw_arena_array(arena, double, rows));
    FW_NEED(drawn = fw_arena_array(arena, double, rows));
    FW_TRY(fw_mechanism_strained(arena, m, strain, &strained));
    fw_linear_gaps(s, m, drawn);
    fw_linear_gaps(s, strained, gap);
    memset(shift, 0, n * sizeof *shift);
    for (size_t k = 0; k < rows; k++) {
        double part = 0;
        for (size_t i = 0; i < rows; i++)
            part -= o->holding.u[k * rows + i] * (gap[i] - drawn[i]);
        for (size_t i = 0; i < n; i++)
            shift[i] += o->holding.v[k * n + i] * part / o->holding.sigma[k];
    }
    for (size_t i = 0; i < n; i++)
        shift[i] *= fw_linear_unit(s, (int)i) / sqrt(o->inertia[i]);
    for (int i = 0; i < m->npin; i++) {
        int a = m->pin[i].body_a, b = m->pin[i].body_b;
        turn[i] = (b == FW_GROUND ? 0 : shift[3 * b + 2]) - (a == FW_GROUND ? 0 : shift[3 * a + 2]);
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

void fw_modal_shift_force(const fw_modal *o, const double *shift, double *force) {
    const fw_linear *s = &o->linear;
    size_t total = (size_t)s->total;
    for (int i = 0; i < s->n; i++) {
        force[i] = 0;
        for (int k = 0; k < s->n; k++)
            force[i] -= s->a[(size_t)i * total + (size_t)k] * shift[k] / fw_linear_unit(s, k);
        force[i] *= fw_linear_force_unit(s, i);
    }
}

fw_status fw_modal_find_shifts(fw_arena *arena, fw_modal *o) {
    const fw_terms *t = o->terms;
    double *ground;
    FW_NEED(ground = fw_arena_array(arena, double, (size_t)t->nbody + 1));
    ground[t->nbody] = t->stretch.strain;
    for (int i = 0; i < 2; i++) {
        if (!(i ? t->stretch.law != NULL : t->strained)) continue;
        FW_NEED(o->shift[i] = fw_arena_array(arena, double, (size_t)o->n));
        FW_NEED(o->shift_turn[i] = fw_arena_array(arena, double, (size_t)o->mechanism->npin));
        FW_NEED(o->shift_drag[i] = fw_arena_array(arena, double, (size_t)o->modes));
        FW_TRY(fw_modal_shift(arena, o, i ? ground : t->strain, o->shift[i], o->shift_turn[i]));
    }
    return FW_OK;
}

double fw_modal_shifted(const fw_modal *o, int pin, double t_s, double piece_s) {
    double sum = 0, law[3];
    if (o->shift[0]) sum += o->shift_turn[0][pin];
    if (o->shift[1]) {
        fw_law_value(o->terms->stretch.law, t_s, piece_s, law);
        sum += law[0] * o->shift_turn[1][pin];
    }
    return sum;
}
