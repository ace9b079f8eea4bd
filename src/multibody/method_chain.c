/* SPDX-License-Identifier: GPL-3.0-or-later */
/* chain: S lambda = G M^-1 Q + gamma, a = M^-1 (Q - G^T lambda), with S = G M^-1 G^T eliminated in
   2 x 2 blocks along the joint graph and the proximal iteration in place of a rank decision. Linear
   time for chains and rings; redundant joints and singular positions allowed. Source: Carpentier,
   Budhiraja and Mansard, RSS 2021; Featherstone 2008, ch. 8. Test: test_block_chain.c,
   test_simulate.c. */
#include "multibody/kernel.h"
#include "multibody/multibody_scratch.h"
#include <string.h>

static bool factor(fw_multibody_system *sys, const fw_multibody_pose *pose) {
    fw_multibody_scratch *w = sys->work;
    fw_multibody_chain_assemble(sys->model, pose, &w->chain);
    return fw_multibody_chain_factor(&sys->model->chain, &w->chain, w->epsilon);
}

static void accelerate(fw_multibody_system *sys, const fw_multibody_factor *at, const double *gamma,
                       double *a, double *lambda) {
    const fw_multibody_model *m = sys->model;
    double *right = sys->work->drift;
    fw_multibody_jacobian(m, at->pose, a, right);
    for (int i = 0; i < 2 * m->nblock; i++)
        right[i] += gamma[i];
    fw_multibody_chain_proximal(m, at->pose, &sys->work->chain, right, lambda);
    fw_multibody_apply(m, at->pose, lambda, a);
}

/* d = -M^-1 G^T (S + eps D)^-1 r: rows that cannot be met are left alone */
static void correct(fw_multibody_system *sys, const fw_multibody_pose *pose, const double *r,
                    double *d) {
    const fw_multibody_model *m = sys->model;
    double *lambda = sys->work->more;
    memcpy(lambda, r, 2 * (size_t)m->nblock * sizeof *r);
    fw_multibody_chain_solve(&m->chain, &sys->work->chain, lambda);
    memset(d, 0, (size_t)m->nq * sizeof *d);
    fw_multibody_apply(m, pose, lambda, d);
}

/* do rows repeat each other in the assembled pose? Some pivot of S then vanishes against 1/m_a +
   1/m_b (here: below a millionth of it); the smaller eigenvalue of L diag(d, e) L^T is about e/(1 +
   l^2) */
static bool redundant_as_assembled(fw_multibody_system *sys) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_chain *c = &m->chain;
    fw_multibody_chain_numbers *s = &sys->work->chain;
    double *u = sys->work->correction;
    memset(u, 0, (size_t)m->nq * sizeof *u);
    fw_multibody_chain_assemble(m, fw_multibody_pose_at(sys, 0, u), s);
    if (!fw_multibody_chain_factor(c, s, 0)) return true;
    for (int i = 0; i < c->pins; i++) {
        double slant = s->pivot[3 * i + 1], least = 1 / s->pivot[3 * i + 2] / (1 + slant * slant);
        if (!(least > 1e-6 * c->isotropic[2 * i])) return true;
    }
    return false;
}

static fw_status prepare(fw_arena *arena, fw_multibody_system *sys, const fw_mechanism *mechanism,
                         fw_diags *diags) {
    (void)mechanism, (void)diags;
    /* the kernel's 2 x 2 inverses lose digits where joints repeat each other */
    if (!sys->model->plain || redundant_as_assembled(sys)) return FW_OK;
    return fw_multibody_kernel_new(arena, sys->model, &sys->kernel);
}

const fw_multibody_method fw_multibody_method_chain = {
    .name = "chain",
    .summary = "reference-point coordinates, block elimination along the joint graph, proximal "
               "iteration; linear time, redundant joints and singular positions allowed",
    .source = "Carpentier, Budhiraja and Mansard 2021; Featherstone 2008",
    .cost = {3700, 1},
    .prepare = prepare,
    .factor = factor,
    .accelerate = accelerate,
    .correct = correct,
};
