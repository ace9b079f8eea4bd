/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the ports of an element and the coordinates of bodies. With the arm r = R(phi) s of a
   port and p(r) = (-r_y, r_x): place x + r, velocity v + omega p(r);  force f: (f, p(r) . f +
   couple) tangent: J^T K J with J = d(place)/dq, and, since dp/dphi = -r, + r . f at (phi, phi);
   damping forces see the velocity, whose derivative by phi is -omega r:  stiffness += J^T C (-omega
   r). */
#include "effects/element.h"
#include <math.h>
#include <string.h>

static fw_geometry_vec2 arm_of(const fw_effects_port *p, const double *q) {
    if (p->body == FW_GROUND) return (fw_geometry_vec2){p->x_m, p->y_m};
    double c = cos(q[3 * p->body + 2]), s = sin(q[3 * p->body + 2]);
    return (fw_geometry_vec2){c * p->x_m - s * p->y_m, s * p->x_m + c * p->y_m};
}

void fw_effects_element_place_ports(const fw_effects_force_element *e, const double *q,
                                    const double *v, double *p, double *w) {
    for (int i = 0; i < e->ports; i++) {
        int b = e->port[i].body;
        fw_geometry_vec2 r = arm_of(&e->port[i], q);
        double *at = p + 3 * i, *speed = w + 3 * i;
        at[0] = r.x, at[1] = r.y, at[2] = 0;
        speed[0] = speed[1] = speed[2] = 0;
        if (b == FW_GROUND) continue;
        at[0] += q[3 * b], at[1] += q[3 * b + 1], at[2] = q[3 * b + 2];
        if (!v) continue;
        speed[0] = v[3 * b] - v[3 * b + 2] * r.y;
        speed[1] = v[3 * b + 1] + v[3 * b + 2] * r.x;
        speed[2] = v[3 * b + 2];
    }
}

void fw_effects_element_add_forces(const fw_effects_force_element *e, const double *q,
                                   const double *f, double *force) {
    for (int i = 0; i < e->ports; i++) {
        int b = e->port[i].body;
        if (b == FW_GROUND) continue;
        fw_geometry_vec2 r = arm_of(&e->port[i], q);
        force[3 * b] += f[3 * i];
        force[3 * b + 1] += f[3 * i + 1];
        force[3 * b + 2] += r.x * f[3 * i + 1] - r.y * f[3 * i] + f[3 * i + 2];
    }
}

/* whole += J_i^T block J_j for ports i, j; J = [1 0 -ry; 0 1 rx; 0 0 1] */
static void spread_block(int n, int bi, int bj, fw_geometry_vec2 ri, fw_geometry_vec2 rj,
                         const double *block, int stride, double *whole) {
    double right[3][3], both[3][3];
    for (int k = 0; k < 3; k++) {
        const double *row = block + k * stride;
        right[k][0] = row[0], right[k][1] = row[1];
        right[k][2] = -rj.y * row[0] + rj.x * row[1] + row[2];
    }
    for (int k = 0; k < 3; k++) {
        both[0][k] = right[0][k], both[1][k] = right[1][k];
        both[2][k] = -ri.y * right[0][k] + ri.x * right[1][k] + right[2][k];
    }
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            whole[(size_t)(3 * bi + k) * (size_t)n + (size_t)(3 * bj + l)] += both[k][l];
}

/* column phi_j of the stiffness: damping forces that change because the arm of port j turns */
static void spread_turning(int n, int bi, int bj, fw_geometry_vec2 ri, fw_geometry_vec2 rj,
                           double omega, const double *block, int stride, double *whole) {
    double f[3];
    for (int k = 0; k < 3; k++)
        f[k] = -omega * (block[k * stride] * rj.x + block[k * stride + 1] * rj.y);
    f[2] += ri.x * f[1] - ri.y * f[0];
    for (int k = 0; k < 3; k++)
        whole[(size_t)(3 * bi + k) * (size_t)n + (size_t)(3 * bj + 2)] += f[k];
}

void fw_effects_element_spread(const fw_effects_force_element *e, int nbody, const double *q,
                               const double *v, const double *f, const double *stiffness,
                               const double *damping, double *whole_stiffness,
                               double *whole_damping) {
    int n = 3 * nbody, stride = 3 * e->ports;
    for (int i = 0; i < e->ports; i++) {
        int bi = e->port[i].body;
        if (bi == FW_GROUND) continue;
        fw_geometry_vec2 ri = arm_of(&e->port[i], q);
        whole_stiffness[(size_t)(3 * bi + 2) * (size_t)n + (size_t)(3 * bi + 2)] +=
            ri.x * f[3 * i] + ri.y * f[3 * i + 1];
        for (int j = 0; j < e->ports; j++) {
            int bj = e->port[j].body, at = 3 * i * stride + 3 * j;
            if (bj == FW_GROUND) continue;
            fw_geometry_vec2 rj = arm_of(&e->port[j], q);
            spread_block(n, bi, bj, ri, rj, stiffness + at, stride, whole_stiffness);
            if (!damping) continue;
            if (v)
                spread_turning(n, bi, bj, ri, rj, v[3 * bj + 2], damping + at, stride,
                               whole_stiffness);
            if (whole_damping) spread_block(n, bi, bj, ri, rj, damping + at, stride, whole_damping);
        }
    }
}
