/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the limits of the six hinges say of the rotations and of the right leg's reach. */
#include "base/constants.h"
#include "workspace/loop.h"
#include "workspace/reach.h"

fw_workspace_reach_limits fw_workspace_limits_symmetric(const double limit_rad[FW_SIX]) {
    fw_workspace_reach_limits l;
    for (int i = 0; i < FW_SIX; i++)
        l.high_rad[i] = limit_rad[i], l.low_rad[i] = -limit_rad[i];
    return l;
}

/* The elbow turns on the side of its drawn branch only: from b by psi, with a x R(psi) b of that
   sign. Where a limit lets it pass the stretched or folded leg, the range ends there, rounded
   outward. */
static fw_workspace_bound on_branch(const fw_workspace_leg *leg, fw_workspace_bound psi) {
    double along = leg->a.x * leg->b.x + leg->a.y * leg->b.y;
    double side = leg->a.x * leg->b.y - leg->a.y * leg->b.x, elbow = atan2(side, along);
    double half = 0.5 * FW_TURN, slack = 1e-14;
    double lo = leg->sign > 0.0 ? -elbow : -half - elbow;
    double hi = leg->sign > 0.0 ? half - elbow : -elbow;
    if (psi.low.lo < lo) psi.low = (fw_maths_interval){lo - slack, lo + slack};
    if (psi.high.hi > hi) psi.high = (fw_maths_interval){hi - slack, hi + slack};
    return psi;
}

/* |O Q|^2 with the elbow turned by psi: |a|^2 + |b|^2 + 2 (cos psi a.b - sin psi a x b) */
static fw_maths_interval reach2(const fw_workspace_leg *leg, fw_maths_interval psi) {
    fw_maths_interval ax = fw_interval_point(leg->a.x), ay = fw_interval_point(leg->a.y);
    fw_maths_interval bx = fw_interval_point(leg->b.x), by = fw_interval_point(leg->b.y);
    fw_maths_interval along =
        fw_interval_add(fw_maths_interval_mul(ax, bx), fw_maths_interval_mul(ay, by));
    fw_maths_interval side =
        fw_interval_sub(fw_maths_interval_mul(ax, by), fw_maths_interval_mul(ay, bx));
    fw_maths_interval both =
        fw_interval_sub(fw_maths_interval_mul(fw_maths_interval_cos(psi), along),
                        fw_maths_interval_mul(fw_maths_interval_sin(psi), side));
    return fw_interval_add(fw_interval_add(fw_centred_range(leg->a2), fw_centred_range(leg->b2)),
                           fw_interval_add(both, both));
}

fw_workspace_allowed fw_workspace_limits_allow(const fw_workspace_loop *k,
                                               const fw_workspace_reach_limits *l) {
    fw_workspace_allowed out;
    for (int i = 0; i < FW_SIX; i++) {
        fw_maths_interval low = fw_workspace_loop_psi_range(k, i, fw_interval_point(l->low_rad[i]));
        fw_maths_interval high =
            fw_workspace_loop_psi_range(k, i, fw_interval_point(l->high_rad[i]));
        out.psi[i] = i < 3 ? (fw_workspace_bound){low, high} : (fw_workspace_bound){high, low};
    }
    out.psi[1] = on_branch(&k->leg[0], out.psi[1]);
    /* the right leg's elbow counts from the ground up, as psi does */
    const fw_workspace_leg *right = &k->leg[1];
    fw_workspace_bound elbow = on_branch(right, out.psi[4]);
    fw_maths_interval at_low = reach2(right, elbow.low), at_high = reach2(right, elbow.high);
    out.d2 = right->sign > 0.0 ? (fw_workspace_bound){at_high, at_low}
                               : (fw_workspace_bound){at_low, at_high};
    return out;
}

fw_workspace_box3 fw_workspace_reach_whole(const fw_workspace_loop *k,
                                           const fw_workspace_allowed *allowed) {
    (void)k;
    fw_workspace_box3 box;
    for (int i = 0; i < 3; i++)
        box.lo[i] = allowed->psi[i].low.lo, box.hi[i] = allowed->psi[i].high.hi;
    return box;
}
