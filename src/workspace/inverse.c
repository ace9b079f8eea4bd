/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/loop.h"
#include "base/constants.h"
#include <math.h>

enum { LINKS = 5 }; /* bodies 0..4 of the six-bar; they and the ground are its core */

typedef struct graph {
    const fw_mechanism *m;
    int *parent;   /* (nbody) trees of bodies that are joined to each other outside of the core */
    int *attached; /* (nbody) at a root: 2 + the body of the core that the tree hangs on, 0: none */
} graph;

static bool core(int body) {
    return body < LINKS;
}

static int root(const graph *g, int body) {
    while (g->parent[body] != body) /* halves the way each time */
        body = g->parent[body] = g->parent[g->parent[body]];
    return body;
}

static void join(const graph *g, int a, int b) {
    if (!core(a) && !core(b)) g->parent[root(g, a)] = root(g, b);
}

/* false: this joint holds two bodies of the core together */
static bool attach(const graph *g, int a, int b) {
    if (core(a) && core(b)) return false;
    if (core(a) == core(b)) return true;
    int inner = core(a) ? a : b, *hangs_on = &g->attached[root(g, core(a) ? b : a)];
    if (*hangs_on == 0) *hangs_on = 2 + inner; /* the ground is -1 */
    return *hangs_on == 2 + inner;
}

/* The joint that takes freedom from the six-bar's platform, so that its inverse kinematics does not
   hold: a driver of a hinge, or a joint that, alone or through further bodies, holds two of the
   six-bar's bodies (or the ground) together. What merely rides on one of them takes none.
   Output: its id, NULL when there is none. Cost linear in joints. Test: test_required.c riders. */
fw_status fw_workspace_six_bar_foreign_joint(fw_arena *arena, const fw_mechanism *m,
                                             const char **id) {
    fw_mark mark = fw_arena_mark(arena);
    graph g = {.m = m};
    FW_NEED(g.parent = fw_arena_array(arena, int, (size_t)m->nbody));
    FW_NEED(g.attached = fw_arena_array(arena, int, (size_t)m->nbody));
    *id = NULL;
    for (int i = 0; i < m->nbody; i++)
        g.parent[i] = i;
    for (int i = FW_SIX; i < m->npin; i++)
        join(&g, m->pin[i].body_a, m->pin[i].body_b);
    for (int i = 0; i < m->njoint; i++)
        join(&g, m->joint[i].body_a, m->joint[i].body_b);
    for (int i = FW_SIX; i < m->npin && !*id; i++)
        if (!attach(&g, m->pin[i].body_a, m->pin[i].body_b)) *id = m->pin[i].id;
    for (int i = 0; i < m->njoint && !*id; i++)
        if (!attach(&g, m->joint[i].body_a, m->joint[i].body_b)) *id = m->joint[i].id;
    for (int i = 0; i < m->ndriver && !*id; i++)
        if (m->driver[i].revolute != FW_NONE && m->driver[i].revolute < FW_SIX)
            *id = m->driver[i].id;
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

static double wrapped(double angle_rad) {
    return remainder(angle_rad, 2.0 * FW_PI);
}

static fw_workspace_dyad dyad(fw_geometry_vec2 o, fw_geometry_vec2 elbow, fw_geometry_vec2 q) {
    double ux = elbow.x - o.x, uy = elbow.y - o.y, wx = q.x - elbow.x, wy = q.y - elbow.y;
    double cross = ux * wy - uy * wx, dot = ux * wx + uy * wy;
    return (fw_workspace_dyad){.base = o,
                               .l_m = hypot(ux, uy),
                               .m_m = hypot(wx, wy),
                               .alpha0_rad = atan2(uy, ux),
                               .beta0_rad = atan2(cross, dot),
                               .sign = cross < 0.0 ? -1.0 : 1.0};
}

bool fw_workspace_six_bar_set_up(const fw_mechanism *m, fw_workspace_six_bar *out) {
    if (!m->device->six_bar || m->npin < FW_SIX || m->nbody < 5) return false;
    fw_geometry_vec2 p[FW_SIX];
    for (int i = 0; i < FW_SIX; i++)
        p[i] = fw_mechanism_pin_place(m, &m->pin[i], 0);
    const fw_mechanism_mass *platform = &m->body[2];
    *out = (fw_workspace_six_bar){.left = dyad(p[0], p[1], p[2]), .right = dyad(p[5], p[4], p[3])};
    out->centre = (fw_geometry_vec2){platform->x_m, platform->y_m};
    out->to_c = (fw_geometry_vec2){p[2].x - platform->x_m, p[2].y - platform->y_m};
    out->to_d = (fw_geometry_vec2){p[3].x - platform->x_m, p[3].y - platform->y_m};
    for (int i = 0; i < FW_SIX; i++) { /* rotation already there in the drawn pose */
        const fw_mechanism_pin *pin = &m->pin[i];
        double a = pin->body_a == FW_GROUND ? 0.0 : m->body[pin->body_a].phi_rad;
        double b = pin->body_b == FW_GROUND ? 0.0 : m->body[pin->body_b].phi_rad;
        out->start_rad[i] = b - a - pin->free_angle_rad;
    }
    return true;
}

/* elbow:  beta = +-acos((d^2 - l^2 - m^2)/(2 l m)), base: alpha = ang(v) - atan2(m sin b, l + m cos
   b) out: rotations of the two links from the drawn pose; false when d is out of [|l-m|, l+m] */
static bool solve(const fw_workspace_dyad *k, fw_geometry_vec2 q, double *base_rad,
                  double *elbow_rad) {
    double vx = q.x - k->base.x, vy = q.y - k->base.y;
    double cosine = (vx * vx + vy * vy - k->l_m * k->l_m - k->m_m * k->m_m) / (2 * k->l_m * k->m_m);
    if (!(fabs(cosine) <= 1.0)) return false;
    double beta = k->sign * acos(cosine);
    double alpha = atan2(vy, vx) - atan2(k->m_m * sin(beta), k->l_m + k->m_m * cos(beta));
    *base_rad = wrapped(alpha - k->alpha0_rad);
    *elbow_rad = wrapped(beta - k->beta0_rad);
    return true;
}

/* two RRR dyads O-l-m to Q (O = A, Q = C and O = F, Q = D), branch of the drawn position
   in: displacement of the platform's centre (m) and its rotation (rad); out: phi_b - phi_a - free
   angle of A..F (6), rad; exact up to rounding (1e-15), cost two acos and four atan2 source:
   docs/theory/workspace.md; test_inverse.c reference_poses */
bool fw_workspace_six_bar_solve(const fw_workspace_six_bar *k, double x_m, double y_m,
                                double phi_rad, double angle_rad[FW_SIX], int *leg) {
    double c = cos(phi_rad), s = sin(phi_rad);
    fw_geometry_vec2 centre = {k->centre.x + x_m, k->centre.y + y_m};
    fw_geometry_vec2 at_c = {centre.x + c * k->to_c.x - s * k->to_c.y,
                             centre.y + s * k->to_c.x + c * k->to_c.y};
    fw_geometry_vec2 at_d = {centre.x + c * k->to_d.x - s * k->to_d.y,
                             centre.y + s * k->to_d.x + c * k->to_d.y};
    double a, b, f, e;
    *leg = 0;
    if (!solve(&k->left, at_c, &a, &b)) return false;
    *leg = 1;
    if (!solve(&k->right, at_d, &f, &e)) return false;
    /* left leg counts from the ground up, right leg from the platform down */
    const double turn[FW_SIX] = {a, b, wrapped(phi_rad - a - b), -wrapped(phi_rad - f - e), -e, -f};
    for (int i = 0; i < FW_SIX; i++)
        angle_rad[i] = turn[i] + k->start_rad[i];
    return true;
}

bool fw_workspace_six_bar_inverse(const fw_mechanism *m, double x_m, double y_m, double phi_rad,
                                  double angle_rad[FW_SIX], int *leg) {
    fw_workspace_six_bar k;
    *leg = 0;
    return fw_workspace_six_bar_set_up(m, &k) &&
           fw_workspace_six_bar_solve(&k, x_m, y_m, phi_rad, angle_rad, leg);
}
