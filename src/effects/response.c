/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include "maths/dense.h"
#include <math.h>

typedef struct system {
    int n;         /* unknowns */
    double *a;     /* (n x n) */
    double length; /* m: rotations weigh like displacements of this size */
    double force;  /* N per m of displacement: size of the stiffness */
} system;

static void put(const system *s, int i, int j, double value) {
    s->a[(size_t)i * (size_t)s->n + (size_t)j] += value;
}

static fw_vec2 arm(const fw_mechanism *m, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_vec2){x, y};
    double c = cos(m->body[body].phi_rad), s = sin(m->body[body].phi_rad);
    return (fw_vec2){c * x - s * y, s * x + c * y};
}

/* mean distance between the centres of mass and their pins, m */
static double typical_length(const fw_mechanism *m) {
    double sum = 0;
    int count = 0;
    for (int i = 0; i < m->npin; i++) {
        const fw_pin *p = &m->pin[i];
        if (p->body_a != FW_GROUND) sum += hypot(p->ax_m, p->ay_m), count++;
        if (p->body_b != FW_GROUND) sum += hypot(p->bx_m, p->by_m), count++;
    }
    return sum > 0 ? sum / count : 1;
}

static void add_torsion(const system *s, const fw_torsion *t) {
    double k = t->stiffness_Nm_per_rad / (s->force * s->length * s->length);
    int a = t->body_a == FW_GROUND ? -1 : 3 * t->body_a + 2;
    int b = t->body_b == FW_GROUND ? -1 : 3 * t->body_b + 2;
    if (a >= 0) put(s, a, a, k);
    if (b >= 0) put(s, b, b, k);
    if (a >= 0 && b >= 0) put(s, a, b, -k), put(s, b, a, -k);
}

/* k u u^T along the spring's direction: the material part of the tangent */
static void add_spring(const system *s, const fw_mechanism *m, const fw_spring *p) {
    fw_vec2 ra = arm(m, p->body_a, p->ax_m, p->ay_m), rb = arm(m, p->body_b, p->bx_m, p->by_m);
    fw_vec2 a = ra, b = rb;
    if (p->body_a != FW_GROUND) a.x += m->body[p->body_a].x_m, a.y += m->body[p->body_a].y_m;
    if (p->body_b != FW_GROUND) b.x += m->body[p->body_b].x_m, b.y += m->body[p->body_b].y_m;
    double dx = b.x - a.x, dy = b.y - a.y, l = hypot(dx, dy);
    if (!(l > 0)) return;
    double ux = dx / l, uy = dy / l, k = p->stiffness_N_per_m / s->force;
    int index[6];
    double row[6];
    int count = 0;
    if (p->body_a != FW_GROUND) {
        double turn = (-ra.y * ux + ra.x * uy) / s->length;
        const double part[3] = {-ux, -uy, -turn};
        for (int c = 0; c < 3; c++, count++)
            index[count] = 3 * p->body_a + c, row[count] = part[c];
    }
    if (p->body_b != FW_GROUND) {
        double turn = (-rb.y * ux + rb.x * uy) / s->length;
        const double part[3] = {ux, uy, turn};
        for (int c = 0; c < 3; c++, count++)
            index[count] = 3 * p->body_b + c, row[count] = part[c];
    }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            put(s, index[i], index[j], k * row[i] * row[j]);
}

static void add_constraint(const system *s, int row, int body, fw_vec2 r, double sign) {
    if (body == FW_GROUND) return;
    const double gx[3] = {sign, 0, -sign * r.y / s->length};
    const double gy[3] = {0, sign, sign * r.x / s->length};
    for (int c = 0; c < 3; c++) {
        put(s, row, 3 * body + c, gx[c]), put(s, 3 * body + c, row, gx[c]);
        put(s, row + 1, 3 * body + c, gy[c]), put(s, 3 * body + c, row + 1, gy[c]);
    }
}

/* [K G^T; G 0] [dq; lambda] = [F; 0] at the initial pose, rows balanced by a length and a
   stiffness. Geometric stiffness (lambda Psi_qq, turning loads) is left out: callers take a factor
   for it. Inputs SI; outputs displacement (3 nbody) in m and rad, rotation (npin) in rad. Cost (3n
   + 2p)^3/3. Source: standard static condensation of a constrained system. Test: test_effects.c. */
fw_status fw_static_response(fw_arena *arena, const fw_mechanism *m, const fw_terms *terms,
                             const double *force, double *displacement, double *rotation,
                             bool *valid) {
    int n = 3 * m->nbody, total = n + 2 * m->npin;
    *valid = false;
    if (total > FW_RESPONSE_MOST || total == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    system s = {.n = total, .length = typical_length(m)};
    for (int i = 0; i < terms->ntorsion; i++)
        s.force = fmax(s.force, terms->torsion[i].stiffness_Nm_per_rad / (s.length * s.length));
    for (int i = 0; i < terms->nspring; i++)
        s.force = fmax(s.force, terms->spring[i].stiffness_N_per_m);
    if (!(s.force > 0)) return FW_OK;
    double *x;
    FW_NEED(s.a = fw_arena_array(arena, double, (size_t)total *(size_t)total));
    FW_NEED(x = fw_arena_array(arena, double, (size_t)total));
    for (int i = 0; i < terms->ntorsion; i++)
        add_torsion(&s, &terms->torsion[i]);
    for (int i = 0; i < terms->nspring; i++)
        add_spring(&s, m, &terms->spring[i]);
    for (int i = 0; i < m->npin; i++) {
        const fw_pin *p = &m->pin[i];
        add_constraint(&s, n + 2 * i, p->body_a, arm(m, p->body_a, p->ax_m, p->ay_m), 1);
        add_constraint(&s, n + 2 * i, p->body_b, arm(m, p->body_b, p->bx_m, p->by_m), -1);
    }
    double largest = 0;
    for (int i = 0; i < n; i++) {
        x[i] = force[i] / (s.force * s.length) / (i % 3 == 2 ? s.length : 1);
        largest = fmax(largest, fabs(x[i]));
    }
    for (int i = 0; i < n && largest > 0; i++) /* the answer is linear: solve for a unit load */
        x[i] /= largest;
    FW_TRY(fw_dense_solve_symmetric(arena, total, s.a, x, x, valid));
    for (int i = 0; i < n; i++) {
        displacement[i] = largest * x[i] * (i % 3 == 2 ? 1 : s.length);
        *valid = *valid && isfinite(displacement[i]);
    }
    for (int i = 0; i < m->npin; i++) {
        int a = m->pin[i].body_a, b = m->pin[i].body_b;
        rotation[i] = (b == FW_GROUND ? 0 : displacement[3 * b + 2]) -
                      (a == FW_GROUND ? 0 : displacement[3 * a + 2]);
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
