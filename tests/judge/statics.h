/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria along the primary branch, from rest. */
#ifndef JUDGE_STATICS_H
#define JUDGE_STATICS_H

#include "model.h"

/* What a model bears: largest stress of every flexure, MPa. */
struct answer {
    double stress[FLEXURES], roots[FLEXURES];
    int at[FLEXURES];
    double most; /* of all */
};

/* Equilibrium at a share of the loads, from the state that is given; the determinant's sign goes to
 * sign. 0 if found, 2 if it is not stable. */
int statics_settle(struct model *model, double share, struct state *state, int *sign);

/* Follows the equilibria from rest until the share, or until the stress, is reached; 0 if it is. */
int statics_follow(struct model *model, double share, double stress, struct state *state,
                   double *reached, struct answer *out);

void statics_answer(const struct model *model, const struct state *state, struct answer *out);

/* Stiffness of a state under a share of the loads, as below; what is held counts as very stiff. */
int statics_stiffness_at(struct model *model, double share, const struct state *state, double *k);

/* Stiffness at rest on the poses of the bodies (3 bodies squared, rows one behind the other). */
void statics_stiffness(struct model *model, double *k);

#endif
