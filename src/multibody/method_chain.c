/* SPDX-License-Identifier: GPL-3.0-or-later */
/* chain: S lambda = G M^-1 Q + gamma, a = M^-1 (Q - G^T lambda), with S = G M^-1 G^T eliminated in
   2 x 2 blocks along the joint graph and the proximal iteration in place of a rank decision. Linear
   time for chains and rings; redundant joints and singular positions allowed. Source: Carpentier,
   Budhiraja and Mansard, RSS 2021; Featherstone 2008, ch. 8. Test: test_block_chain.c,
   test_simulate.c. */
#include "multibody/kernel.h"
#include "multibody/methods.h"
#include <string.h>

static bool factor(fw_multibody_model *m) {
    fw_multibody_chain_assemble(m);
    return fw_multibody_chain_factor(&m->chain, m->epsilon);
}

static void accelerate(fw_multibody_model *m, const double *gamma, double *a, double *lambda) {
    fw_multibody_model_jacobian(m, a, m->drift);
    for (int i = 0; i < 2 * m->nblock; i++)
        m->drift[i] += gamma[i];
    fw_multibody_chain_proximal(m, m->drift, lambda);
    fw_multibody_model_apply(m, lambda, a);
}

/* d = -M^-1 G^T (S + eps D)^-1 r: rows that cannot be met are left alone */
static void correct(fw_multibody_model *m, const double *r, double *d) {
    memcpy(m->more, r, 2 * (size_t)m->nblock * sizeof *r);
    fw_multibody_chain_solve(&m->chain, m->more);
    memset(d, 0, (size_t)m->nq * sizeof *d);
    fw_multibody_model_apply(m, m->more, d);
}

/* do rows repeat each other in the assembled pose? Some pivot of S then vanishes against 1/m_a +
   1/m_b (here: below a millionth of it); the smaller eigenvalue of L diag(d, e) L^T is about e/(1 +
   l^2) */
static bool redundant_as_assembled(fw_multibody_model *m) {
    const fw_multibody_chain *c = &m->chain;
    memset(m->correction, 0, (size_t)m->nq * sizeof *m->correction);
    fw_multibody_model_pose(m, m->correction);
    fw_multibody_chain_assemble(m);
    if (!fw_multibody_chain_factor(&m->chain, 0)) return true;
    for (int i = 0; i < c->pins; i++) {
        double slant = c->pivot[3 * i + 1], least = 1 / c->pivot[3 * i + 2] / (1 + slant * slant);
        if (!(least > 1e-6 * c->isotropic[2 * i])) return true;
    }
    return false;
}

static fw_status prepare(fw_arena *arena, fw_multibody_model *m, const fw_mechanism *mechanism,
                         fw_diags *diags, void **work) {
    (void)mechanism, (void)diags, (void)work;
    /* the kernel's 2 x 2 inverses lose digits where joints repeat each other */
    if (!m->plain || redundant_as_assembled(m)) return FW_OK;
    return fw_multibody_kernel_new(arena, m, &m->kernel);
}

const fw_multibody_method fw_multibody_method_chain = {
    .name = "chain",
    .summary = "reference-point coordinates, block elimination along the joint graph, proximal "
               "iteration; linear time, redundant joints and singular positions allowed",
    .source = "Carpentier, Budhiraja and Mansard 2021; Featherstone 2008",
    .prepare = prepare,
    .factor = factor,
    .accelerate = accelerate,
    .correct = correct,
};
