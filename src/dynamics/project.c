/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/model.h"
#include <float.h>
#include <math.h>

static const double fw_position_limit = 1e-12; /* scaled: what every accepted state satisfies */

double fw_model_residual(fw_model *m, const double *u, double *psi) {
    static const double still[2] = {0};
    fw_model_pose(m, u);
    double worst = 0;
    for (int i = 0; i < m->npin; i++) {
        int p = m->body[2 * i], q = m->body[2 * i + 1];
        const double *r = m->arm + 4 * i;
        const double *up = p < m->nbody ? u + 3 * p : still, *uq = q < m->nbody ? u + 3 * q : still;
        psi[2 * i] = m->offset[2 * i] + up[0] - uq[0] + r[0] - r[2];
        psi[2 * i + 1] = m->offset[2 * i + 1] + up[1] - uq[1] + r[1] - r[3];
        double norm = sqrt(psi[2 * i] * psi[2 * i] + psi[2 * i + 1] * psi[2 * i + 1]);
        worst = norm > worst || isnan(norm) ? norm : worst;
    }
    return worst;
}

/* u -= M^-1 G^T (S + eps D)^-1 Psi with the factor at hand (of a pose a step's error away); the
   factor is renewed when that converges slowly. Ends at round-off: below 2 eps times the size, or
   no longer halving below 1e-13 of it. false: |Psi| stays above 1e-12 scaled. Input and output u (3
   nbody), scaled; arms are left at the result. Cost one to two solves. Source: coordinate
   projection in the mass metric, Eich 1993. Test: test_simulate.c. */
bool fw_model_project_position(fw_model *m, double *u) {
    double before = (double)INFINITY, norm = 0;
    for (int i = 0; i < 20; i++) {
        norm = fw_model_residual(m, u, m->right);
        if (!(norm < (double)INFINITY)) return false;
        bool slow = norm > 0.25 * before;
        if (norm <= 2 * DBL_EPSILON * m->size || (slow && norm <= 1e-13 * m->size)) break;
        if (slow || i == 4) {
            fw_chain_assemble(m);
            if (!fw_chain_factor(&m->chain, fw_epsilon)) return false;
        }
        before = norm;
        fw_chain_solve(&m->chain, m->right);
        fw_model_apply(m, m->right, u);
    }
    m->worst_position = fmax(m->worst_position, norm);
    return norm <= fw_position_limit;
}

/* v -= M^-1 G^T S^-1 G v; arms and factor must belong to the pose */
bool fw_model_project_velocity(fw_model *m, double *v) {
    double before = (double)INFINITY, norm = 0, size = DBL_MIN;
    for (int i = 0; i < m->nq; i++)
        size = fmax(size, fabs(v[i]));
    for (int i = 0; i < 6; i++) {
        fw_model_jacobian(m, v, m->right);
        norm = 0;
        for (int j = 0; j < 2 * m->npin; j++)
            norm = fmax(norm, fabs(m->right[j]));
        if (norm <= 2 * DBL_EPSILON * size || norm > 0.25 * before) break;
        before = norm;
        fw_chain_solve(&m->chain, m->right);
        fw_model_apply(m, m->right, v);
    }
    m->worst_velocity = fmax(m->worst_velocity, norm);
    return norm < (double)INFINITY;
}

/* an accepted step: q onto Psi = 0, then v onto G v = 0 with the factor at the new pose, which the
   evaluation of f uses again */
bool fw_model_project(void *model, double t, double *y, double *f) {
    fw_model *m = model;
    (void)t;
    m->projections++;
    double worst = m->worst_position, worst_velocity = m->worst_velocity;
    bool good = fw_model_project_position(m, y);
    if (good) {
        fw_chain_assemble(m);
        m->broken = !fw_chain_factor(&m->chain, fw_epsilon);
        good = !m->broken && fw_model_project_velocity(m, y + m->nq);
    }
    if (!good) { /* a rejected step does not count */
        m->worst_position = worst;
        m->worst_velocity = worst_velocity;
        return false;
    }
    fw_model_accelerate(m, y, f);
    return true;
}
