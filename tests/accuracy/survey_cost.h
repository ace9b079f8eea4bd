/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instructions of the run that gave the answer. */
#ifndef FW_TESTS_SURVEY_COST_H
#define FW_TESTS_SURVEY_COST_H
#include "dynamics/dynamics.h"
#include <string.h>

/* A right-hand side costs P = 1300 (1 + bodies), and what the active effects cost; the vector work
   of a stage 10 per component; a step a projection, dense output and the search for peaks: 2 P and
   150 per component, and with radau5 2.5 n^3 + 50 n^2 for n = 3 bodies coordinates. in: counts of a
   run; out: instructions; only ratios for the same device are used. Error: against callgrind,
   README.md. Source: as in src/dynamics/choose.c. */
static inline double survey_cost_rhs(const fw_dynamics_motion *m, int bodies) {
    double rhs = 1300.0 * (1 + bodies);
    for (int i = 0; i < m->ledger.count; i++)
        if (m->ledger.item[i].active) rhs += m->ledger.item[i].cost;
    return rhs;
}

static inline double survey_cost(const fw_dynamics_motion *m, int bodies) {
    double n = 3.0 * bodies, rhs = survey_cost_rhs(m, bodies), step = 2 * rhs + 300 * n;
    if (strcmp(m->integrator, "radau5") == 0) step += 2.5 * n * n * n + 50 * n * n;
    return (double)m->stats.rhs * (rhs + 20 * n) + (double)m->stats.steps * step;
}

#endif
