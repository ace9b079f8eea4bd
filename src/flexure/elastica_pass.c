/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One Newton pass of the elastica. With Psi = psi + phi the direction of a section, t and n its
   tangent and normal, N = F.t, V = F.n, and d = 1/EA - 1/(kGA):

     phi' = M/EI
     M'   = m = -(1 + d N) V
     x'   = (1 + N/EA) cos Psi - V/(kGA) sin Psi
     y'   = (1 + N/EA) sin Psi + V/(kGA) cos Psi

   on every element by Gauss collocation with 8 nodes (order 16; symplectic, so that the tangent of
   what is computed is symmetric to rounding). phi at the nodes is the only unknown inside:

     phi = phi0 + turned M0 + twice m(phi, F)

   linearised about the present phi, solved for the change of phi and its derivatives by the
   unknowns p, and carried to the end of the beam. x and y are summed as differences from the beam
   as made, so that small displacements keep their digits and no force gives none. */
#include "flexure/elastica_core.h"
#include "flexure/beam.h"
#include <math.h>
#include <string.h>

static inline double total(const fw_nodes *v) {
    fw_nodes a = *v;
    return ((a[0] + a[4]) + (a[1] + a[5])) + ((a[2] + a[6]) + (a[3] + a[7]));
}

typedef struct slopes { /* at the nodes: values, and by Psi, Fx, Fy */
    fw_nodes m, x, y;   /* x, y: less those of the beam as made */
    fw_nodes m_psi, x_psi, y_psi;
    fw_nodes m_f[2], x_f[2], y_f[2];
} slopes;

static inline void slopes_at(const fw_flexure_element *el, const double force[2], slopes *out) {
    fw_nodes c, s;
    for (int i = 0; i < FW_NODES; i++) {
        double psi = el->psi[i] + el->phi[i];
        c[i] = cos(psi);
        s[i] = sin(psi);
    }
    fw_nodes a = el->axial, g = el->shear, d = a - g;
    fw_nodes N = force[0] * c + force[1] * s, V = force[1] * c - force[0] * s;
    fw_nodes q = 1 + d * N, p = d * V, aN = 1 + a * N, gV = g * V;
    out->m = -q * V;
    out->m_psi = q * N - p * V;
    out->m_f[0] = q * s - p * c;
    out->m_f[1] = -q * c - p * s;
    out->x = aN * c - gV * s - el->cos_made;
    out->y = aN * s + gV * c - el->sin_made;
    out->x_psi = p * c - q * s;
    out->y_psi = q * c + p * s;
    out->x_f[0] = a * c * c + g * s * s;
    out->y_f[0] = out->x_f[1] = d * c * s;
    out->y_f[1] = a * s * s + g * c * c;
}

static inline void twice(const fw_flexure_element *el, const fw_nodes *m, fw_nodes *sum) {
    for (int j = 0; j < FW_NODES; j++)
        *sum += (*m)[j] * el->twice[j];
}

/* (1 - twice diag(m_psi)) x = x for four right sides, by Gauss and Jordan without exchange: the
   eigenvalues of `twice` are below 0.02 h^2/EI, the matrix is near 1 on any mesh that resolves */
static inline void solve(const fw_flexure_element *el, const fw_nodes *m_psi, fw_nodes *x) {
    fw_nodes a[FW_NODES];
    for (int j = 0; j < FW_NODES; j++) {
        a[j] = -(*m_psi)[j] * el->twice[j];
        a[j][j] += 1;
    }
    for (int k = 0; k < FW_NODES; k++) {
        double over = 1 / a[k][k];
        fw_nodes l = a[k];
        l[k] -= 1;
        for (int j = k + 1; j < FW_NODES; j++)
            a[j] -= a[j][k] * over * l;
        for (int j = 0; j <= FW_UNKNOWN; j++)
            x[j] -= x[j][k] * over * l;
    }
}

/* the ends' values from those at the nodes: c in by the start, out by the end */
static inline void carry(fw_flexure_element *el, const slopes *at, fw_flexure_carried *c) {
    const fw_nodes *change = el->change;
    fw_nodes w = el->once_end, b = el->twice_end, sum;
    fw_nodes wm = w * at->m_psi, wx = w * at->x_psi, wy = w * at->y_psi, bm = b * at->m_psi;
    sum = b * at->m + bm * change[0];
    c->value[PHI] += el->turn * c->value[MOMENT] + total(&sum);
    sum = w * at->m;
    el->rise = total(&sum);
    sum = w * at->m + wm * change[0];
    c->value[MOMENT] += total(&sum);
    sum = w * at->x + wx * change[0];
    c->value[X] += total(&sum);
    sum = w * at->y + wy * change[0];
    c->value[Y] += total(&sum);
    for (int k = 0; k < FW_UNKNOWN; k++) {
        fw_nodes by = change[1 + k], sums[CARRIED] = {bm * by, wm * by, wx * by, wy * by};
        if (k > 0) {
            sums[PHI] += b * at->m_f[k - 1];
            sums[MOMENT] += w * at->m_f[k - 1];
            sums[X] += w * at->x_f[k - 1];
            sums[Y] += w * at->y_f[k - 1];
        }
        c->by[PHI][k] += el->turn * c->by[MOMENT][k];
        for (int i = 0; i < CARRIED; i++)
            c->by[i][k] += total(&sums[i]);
    }
}

/* in: rotations at the nodes, force, phi, M, x, y and their derivatives by p at the start; without
   units. out: the same at the end, the change of the rotations. Error of a smooth element
   (8!)^4/(17 (16!)^3) h^17 times the 16th derivative, 1.7e-23 h^17 for sine and cosine of h; cost
   0.5 us, half of it the 8 x 8 system. Source: docs/theory/beams.md (23), (24).
   Test: test_elastica.c another_method_agrees, tangents_are_derivatives */
void fw_flexure_element_pass(fw_flexure_element *el, const double force[2], fw_flexure_carried *c) {
    slopes at;
    slopes_at(el, force, &at);
    fw_nodes *change = el->change;
    el->start_by[0] = c->value[PHI];
    change[0] = c->value[PHI] + c->value[MOMENT] * el->turned - el->phi;
    twice(el, &at.m, &change[0]);
    for (int k = 0; k < FW_UNKNOWN; k++) {
        el->start_by[1 + k] = c->by[PHI][k];
        change[1 + k] = c->by[PHI][k] + c->by[MOMENT][k] * el->turned;
        if (k > 0) twice(el, &at.m_f[k - 1], &change[1 + k]);
    }
    solve(el, &at.m_psi, change);
    carry(el, &at, c);
}

/* a clamped root gives phi = root M; a hinge has phi for its unknown and no moment */
void fw_flexure_elastica_begin(const fw_flexure_elastica *e, fw_flexure_carried *c) {
    *c = (fw_flexure_carried){0};
    if (e->hinged) {
        c->value[PHI] = e->p[0];
        c->by[PHI][0] = 1;
    } else {
        c->value[MOMENT] = e->p[0];
        c->by[MOMENT][0] = 1;
        c->value[PHI] = e->root[0] * e->p[0];
        c->by[PHI][0] = e->root[0];
    }
}

/* from the end of the beam to the point that is watched: the second root turns by root M, the arm
   a with it; moment about the point: M - a x F. The arm is linearised about the turn th0 that the line
   has now, as the sections are about theirs: what is carried along a pulled strip under an unknown
   that is hardly wrong turns its end by exp(sqrt F) times as much. */
static void move_to_point(const fw_flexure_elastica *e, const fw_flexure_carried *c, double th0,
                          fw_flexure_end_state *end) {
    double th = c->value[PHI] + e->root[1] * c->value[MOMENT], more = th - th0;
    double sine = sin(th0), half = sin(0.5 * th0), less = 2 * half * half;
    double vx = e->arm[0] - less * e->arm[0] - sine * e->arm[1];
    double vy = e->arm[1] + sine * e->arm[0] - less * e->arm[1]; /* a at th0 */
    double ux = -less * e->arm[0] - sine * e->arm[1] - more * vy;
    double uy = sine * e->arm[0] - less * e->arm[1] + more * vx;
    double ax = e->arm[0] + ux, ay = e->arm[1] + uy, fx = e->p[1], fy = e->p[2];
    end->value[FW_END_THETA] = th;
    end->value[FW_END_UX] = c->value[X] + ux;
    end->value[FW_END_UY] = c->value[Y] + uy;
    end->value[FW_END_M] = c->value[MOMENT] - ax * fy + ay * fx;
    end->value[FW_END_FX] = fx;
    end->value[FW_END_FY] = fy;
    for (int k = 0; k < FW_UNKNOWN; k++) {
        double turn = c->by[PHI][k] + e->root[1] * c->by[MOMENT][k];
        end->by[FW_END_THETA][k] = turn;
        end->by[FW_END_UX][k] = c->by[X][k] - vy * turn;
        end->by[FW_END_UY][k] = c->by[Y][k] + vx * turn;
        end->by[FW_END_M][k] =
            c->by[MOMENT][k] + turn * (vy * fy + vx * fx) + (k == 1 ? ay : 0) - (k == 2 ? ax : 0);
        end->by[FW_END_FX][k] = k == 1;
        end->by[FW_END_FY][k] = k == 2;
    }
}

/* Along a pulled strip what the moment at the start changes grows as exp(sqrt(F) s), and beyond 1e16 of
   it nothing is left of the other end. Where it has grown by that much the moment here, less `moment` that
   the present rotations have, is the first unknown from here on, so that nothing carried is large. A
   Riccati sweep in steps; backwards it decays. Source: Ascher, Mattheij, Russell, Numerical Solution of
   Boundary Value Problems, 1995, section 4.4. Test: test_elastica_ways.c strongly_pulled */
static const double grown_much = 1e3;

static void take_moment_here(fw_flexure_element *el, double moment, fw_flexure_carried *c) {
    double g = c->by[MOMENT][0];
    el->grown = 0;
    if (!(fabs(g) > grown_much)) return;
    el->grown = g;
    el->shift = moment - c->value[MOMENT];
    for (int k = 0; k < 2; k++)
        el->by_force[k] = c->by[MOMENT][1 + k];
    for (int i = 0; i < CARRIED; i++) {
        double by = c->by[i][0] / g;
        c->value[i] += by * el->shift;
        c->by[i][0] = by;
        for (int k = 0; k < 2; k++)
            c->by[i][1 + k] -= by * el->by_force[k];
    }
    c->value[MOMENT] = moment;
    c->by[MOMENT][0] = 1;
    c->by[MOMENT][1] = c->by[MOMENT][2] = 0;
}

void fw_flexure_mesh_pass(fw_flexure_elastica *e, int level, fw_flexure_end_state *end) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    fw_flexure_carried c;
    fw_flexure_elastica_begin(e, &c);
    double moment = c.value[MOMENT];
    mesh->growth = 1;
    for (int n = 0; n < mesh->count; n++) {
        fw_flexure_element *el = &mesh->element[n];
        fw_flexure_element_pass(el, &e->p[1], &c);
        moment += el->rise;
        take_moment_here(el, moment, &c);
        if (el->grown != 0) mesh->growth *= el->grown;
    }
    mesh->end_by[0] = c.value[PHI];
    for (int k = 0; k < FW_UNKNOWN; k++)
        mesh->end_by[1 + k] = c.by[PHI][k];
    move_to_point(e, &c, mesh->turn, end);
    mesh->turn_by[0] = end->value[FW_END_THETA];
    for (int k = 0; k < FW_UNKNOWN; k++)
        mesh->turn_by[1 + k] = end->by[FW_END_THETA][k];
    e->passes += mesh->count;
}

/* with rotations that are solved the moment follows from these, and is not carried where it grows */
void fw_flexure_solved_pass(fw_flexure_elastica *e, int n, fw_flexure_carried *c) {
    fw_flexure_mesh *mesh = &e->mesh[e->solved];
    fw_flexure_element *el = &mesh->element[n];
    double moment = c->value[MOMENT];
    fw_flexure_element_pass(el, &e->p[1], c);
    if (mesh->growth == 1) return;
    c->value[MOMENT] = moment + el->rise;
    c->value[PHI] = n + 1 < mesh->count ? el[1].start : mesh->end;
}

static double applied(const double *by, const double *dp) {
    return by[0] + by[1] * dp[0] + by[2] * dp[1] + by[3] * dp[2];
}

double fw_flexure_mesh_update(fw_flexure_elastica *e, int level, const double *dp, double *span) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    double most = 0, size = 1, d[FW_UNKNOWN] = {dp[0], dp[1], dp[2]};
    *span = 0;
    for (int n = mesh->count - 1; n >= 0; n--) {
        fw_flexure_element *el = &mesh->element[n];
        if (el->grown != 0)
            d[0] = (d[0] + el->shift - el->by_force[0] * d[1] - el->by_force[1] * d[2]) / el->grown;
        el->first = d[0];
    }
    const double start = d[0];
    for (int n = 0; n < mesh->count; n++) {
        fw_flexure_element *el = &mesh->element[n];
        d[0] = el->first;
        fw_nodes change =
            el->change[0] + d[0] * el->change[1] + d[1] * el->change[2] + d[2] * el->change[3];
        el->phi += change;
        el->start = applied(el->start_by, d);
        for (int i = 0; i < FW_NODES; i++) {
            most = fabs(change[i]) > most ? fabs(change[i]) : most;
            *span = fabs(el->phi[i]) > *span ? fabs(el->phi[i]) : *span;
        }
    }
    double turn = mesh->turn;
    mesh->turn = applied(mesh->turn_by, dp);
    most = fmax(most, fabs(mesh->turn - turn));
    mesh->end = applied(mesh->end_by, dp); /* a number that is none anywhere comes to here */
    if (!isfinite(mesh->end)) most = (double)INFINITY;
    d[0] = start;
    for (int k = 0; k < FW_UNKNOWN; k++) {
        e->p[k] += d[k];
        size = fmax(size, fabs(e->p[k]));
    }
    for (int k = 0; k < FW_UNKNOWN; k++)
        most = fmax(most, fabs(d[k]) / size);
    return most;
}

/* Tables of the elastica: nodes, sections there, and what the collocation needs of them. */

/* value at x of the Lagrange polynomial of z[k] */
static double lagrange(int n, const double *z, int k, double x) {
    double product = 1;
    for (int i = 0; i < n; i++)
        if (i != k) product *= (x - z[i]) / (z[k] - z[i]);
    return product;
}

void fw_flexure_rule_fill(fw_flexure_rule *rule) {
    double node[FW_NODES], weight[FW_NODES], a[FW_NODES * FW_NODES], z[FW_NODES + 2];
    fw_flexure_gauss_rule(FW_NODES, node, weight);
    fw_flexure_gauss_integrals(FW_NODES, node, weight, a);
    z[0] = 0, z[FW_NODES + 1] = 1;
    for (int i = 0; i < FW_NODES; i++) {
        rule->node[i] = z[i + 1] = node[i];
        rule->weight[i] = weight[i];
        for (int j = 0; j < FW_NODES; j++)
            rule->column[j][i] = a[i * FW_NODES + j];
    }
    for (int k = 0; k < FW_NODES + 2; k++) {
        rule->place[k] = z[k];
        rule->between[k] = 1;
        for (int i = 0; i < FW_NODES + 2; i++)
            if (i != k) rule->between[k] /= z[k] - z[i];
    }
    for (int half = 0; half < 2; half++)
        for (int i = 0; i < FW_NODES; i++)
            for (int k = 0; k < FW_NODES + 2; k++)
                rule->finer[half][i][k] = lagrange(FW_NODES + 2, z, k, 0.5 * (half + node[i]));
}

/* sections at the nodes of an element whose piece, from and h are set; with D = diag(1/EI) and A
   the collocation matrix, phi = phi0 + h A D (M0 + h A m) = phi0 + turned M0 + twice m */
void fw_flexure_element_fill(const fw_flexure_elastica *e, fw_flexure_element *el) {
    const fw_flexure_rule *r = &e->rule;
    const fw_flexure_beam_pose *start = &e->pose[el->piece];
    fw_flexure_beam_section at, ends[2];
    double l = e->length_m, C = e->soft, h = el->h;
    for (int i = 0; i < FW_NODES; i++) {
        fw_flexure_beam_at(e->beam, el->piece, start, l * (el->from + h * r->node[i]), &at);
        el->psi[i] = at.pose.psi_rad;
        el->cos_made[i] = cos(at.pose.psi_rad);
        el->sin_made[i] = sin(at.pose.psi_rad);
        el->bend[i] = at.bend_per_Nm2 * l / C;
        el->axial[i] = at.axial_per_N / (C * l);
        el->shear[i] = at.shear_per_N / (C * l);
    }
    for (int end = 0; end < 2; end++)
        fw_flexure_beam_at(e->beam, el->piece, start, l * (el->from + h * end), &ends[end]);
    el->dx = (ends[1].pose.x_m - ends[0].pose.x_m) / l;
    el->dy = (ends[1].pose.y_m - ends[0].pose.y_m) / l;
    el->once_end = h * r->weight;
    el->turn = 0;
    el->turned = el->twice_end = (fw_nodes){0};
    for (int j = 0; j < FW_NODES; j++) {
        double to_end = 0;
        el->turn += el->once_end[j] * el->bend[j];
        el->turned += h * el->bend[j] * r->column[j];
        el->twice[j] = (fw_nodes){0};
        for (int k = 0; k < FW_NODES; k++) {
            el->twice[j] += h * h * el->bend[k] * r->column[j][k] * r->column[k];
            to_end += h * el->once_end[k] * el->bend[k] * r->column[j][k];
        }
        el->twice_end[j] = to_end;
    }
}

void fw_flexure_mesh_fill(fw_flexure_elastica *e, int level) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    if (mesh->made) return;
    double cumulative = e->hinged ? 0 : e->root[0];
    fw_flexure_element *el = mesh->element;
    for (int piece = 0; piece < e->beam->npiece; piece++) {
        int n = e->per_piece[piece] << level;
        double h = e->beam->piece[piece].length_m / e->length_m / n;
        for (int i = 0; i < n; i++, el++) {
            el->piece = piece;
            el->from = i * h;
            el->h = h;
            fw_flexure_element_fill(e, el);
            el->cumulative = cumulative;
            cumulative += el->turn;
        }
    }
    mesh->made = true;
}

void fw_flexure_mesh_refine(fw_flexure_elastica *e, int level) {
    const fw_flexure_mesh *from = &e->mesh[level];
    fw_flexure_mesh *to = &e->mesh[level + 1];
    fw_flexure_mesh_fill(e, level + 1);
    to->turn = from->turn;
    for (int n = 0; n < from->count; n++) {
        double z[FW_NODES + 2];
        const fw_flexure_element *el = &from->element[n];
        z[0] = el->start;
        memcpy(z + 1, &el->phi, sizeof el->phi);
        z[FW_NODES + 1] = n + 1 < from->count ? el[1].start : from->end;
        for (int half = 0; half < 2; half++) {
            double phi[FW_NODES];
            for (int i = 0; i < FW_NODES; i++) {
                const double *w = e->rule.finer[half][i];
                double sum = 0;
                for (int k = 0; k < FW_NODES + 2; k++)
                    sum += w[k] * z[k];
                phi[i] = sum;
            }
            memcpy(&to->element[2 * n + half].phi, phi, sizeof phi);
        }
    }
}
