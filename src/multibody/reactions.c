/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of the joints from the multipliers of a solution. */
#include "multibody/system.h"

/* force of every pin on its body b, world axes: its multipliers, or what the element that stands
   for the pin does to the body of its last port */
void fw_multibody_pin_forces(const fw_multibody_model *m, const fw_multibody_solution *found,
                             double *out) {
    double unit = fw_multibody_newton(m);
    for (int i = 0; i < m->npin; i++) {
        int block = m->pin_block[i], element = m->pin_element[i];
        for (int k = 0; k < 2; k++)
            out[2 * i + k] = block != FW_NONE ? unit * found->lambda[2 * block + k] : 0;
        if (element == FW_NONE) continue;
        const fw_multibody_element *e = &m->element[element];
        for (int k = 0; k < 2; k++)
            out[2 * i + k] += found->element[3 * (e->first_port + e->own->ports - 1) + k];
    }
}

/* -G_b^T lambda of one block, as force and torque about its point b. Where b is the ground, which
   has no rows, the opposite of what a gets: G_a^T lambda, its torque moved from a's centre of mass
   by the arm of a and d to point b. */
static void add_block_force(const fw_multibody_model *m, const fw_multibody_solution *found,
                            int block, double *out) {
    const fw_multibody_pose *pose = found->pose;
    bool ground = m->body[2 * block + 1] == m->nbody;
    const double *g = pose->jac + 12 * block + (ground ? 0 : 6), *l = found->lambda + 2 * block;
    const double *r = pose->arm + 4 * block + (ground ? 0 : 2);
    double d[2] = {0}, e[2], n[2], sign = ground ? 1 : -1, force = fw_multibody_newton(m);
    if (ground) fw_multibody_frame(m, pose, block, d, e, n);
    double fx = sign * (g[0] * l[0] + g[3] * l[1]), fy = sign * (g[1] * l[0] + g[4] * l[1]);
    double turn = sign * (g[2] * l[0] + g[5] * l[1]);
    out[0] += force * fx;
    out[1] += force * fy;
    out[2] += force * m->scale.length_m * (turn - (r[0] + d[0]) * fy + (r[1] + d[1]) * fx);
}

void fw_multibody_joint_forces(const fw_multibody_model *m, const fw_multibody_solution *found,
                               const fw_mechanism *mechanism, double *joint, double *driver) {
    for (int i = 0; i < m->njoint; i++) {
        int block = m->joint_block[i];
        joint[3 * i] = joint[3 * i + 1] = joint[3 * i + 2] = 0;
        add_block_force(m, found, block, joint + 3 * i);
        for (int k = 0; k < m->nblock && mechanism->joint[i].kind == FW_JOINT_WELD; k++)
            if (m->block[k].joint == i && k != block) add_block_force(m, found, k, joint + 3 * i);
    }
    for (int i = 0; i < m->ndriver; i++) {
        const fw_multibody_block *b = &m->block[m->driver_block[i]];
        double unit = fw_multibody_newton(m) * (b->rows == FW_ROWS_TURN ? m->scale.length_m : 1);
        driver[i] = -unit * found->lambda[2 * m->driver_block[i]];
    }
}
