/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/survey.h"
#include "workspace/workspace_cut.h"

typedef struct walk {
    const fw_arena *arena;
    const fw_workspace_loop *loop;
    fw_workspace_allowed allowed;
    fw_workspace_box3 whole;
    fw_workspace_survey *out;
    double volume, grows[FW_SIX]; /* theta_i dV/dtheta_i */
} walk;

/* share of the box below the hinge's upper and above its lower limit, and by how much it grows when
   both limits grow by the same ratio: three central differences, one per plane */
static void one_hinge(const fw_workspace_form *f, const fw_workspace_bound *range,
                      const double half[3], double at_low, double at_high, double *share,
                      double *grows) {
    double p[3], size = 0.0, middle = 0.5 * (f->at.lo + f->at.hi);
    for (int i = 0; i < 3; i++)
        p[i] = fabs(f->grad[i]) * half[i], size += p[i];
    double step = 1e-4 * size, t[2] = {range->high.lo - middle, middle - range->low.hi};
    double size_of[2] = {fabs(at_high), fabs(at_low)}, v[2];
    *grows = 0.0;
    for (int s = 0; s < 2; s++) {
        v[s] = fw_workspace_cut_share(p, t[s]).hi;
        double more = fw_workspace_cut_share(p, t[s] + step).hi,
               less = fw_workspace_cut_share(p, t[s] - step).hi;
        if (step > 0.0) *grows += size_of[s] * (more - less) / (2.0 * step);
    }
    *share = fmax(v[0] + v[1] - 1.0, 0.0);
}

/* |psi| |d d2/d psi| at an end of the right elbow's range: how its reach goes with that limit */
static double elbow_gain(const fw_workspace_leg *leg, double psi) {
    double along = leg->a.x * leg->b.x + leg->a.y * leg->b.y;
    double side = leg->a.x * leg->b.y - leg->a.y * leg->b.x;
    return fabs(psi * 2.0 * (sin(psi) * along + cos(psi) * side));
}

/* the right elbow by its leg's reach, as where boxes are judged; where E cannot be told the limits
   of D and F are taken to hold */
static void right_leg(const walk *w, const fw_workspace_loop_box *known, const double half[3],
                      double share[FW_SIX], double grows[FW_SIX]) {
    const fw_workspace_leg *leg = &w->loop->leg[1];
    fw_workspace_bound elbow = w->allowed.psi[4];
    double low = elbow_gain(leg, elbow.low.lo), high = elbow_gain(leg, elbow.high.hi);
    bool falls = leg->sign > 0.0; /* the reach, as psi grows */
    one_hinge(&known->d2[1], &w->allowed.d2, half, falls ? high : low, falls ? low : high,
              &share[4], &grows[4]);
    for (int i = 3; i < FW_SIX && known->reached == FW_REACHED; i++) {
        if (i == 4) continue;
        const fw_workspace_bound *psi = &w->allowed.psi[i];
        one_hinge(&known->psi[i], psi, half, psi->low.lo, psi->high.hi, &share[i], &grows[i]);
    }
}

static void boundary(walk *w, const fw_workspace_box3 *box, const fw_workspace_loop_box *known) {
    double half[3], share[FW_SIX] = {1, 1, 1, 1, 1, 1}, grows[FW_SIX] = {0}, all = 1.0, size = 1.0;
    for (int i = 0; i < 3; i++) {
        fw_box3_middle(box, i, &half[i]);
        size *= box->hi[i] - box->lo[i];
    }
    right_leg(w, known, half, share, grows);
    for (int i = 3; i < FW_SIX; i++)
        all *= share[i];
    double part = all * size * fabs(known->cross[0].m);
    w->volume += part;
    for (int i = 0; i < 3; i++) { /* at a face, from the two layers of boxes next to it */
        double width = box->hi[i] - box->lo[i];
        double high = (w->whole.hi[i] - box->hi[i]) / width,
               low = (box->lo[i] - w->whole.lo[i]) / width;
        double first = fabs(w->whole.hi[i]), last = fabs(w->whole.lo[i]), density = part / width;
        if (high < 1.5) w->grows[i] += first * density * (high < 0.5 ? 1.5 : -0.5);
        if (low < 1.5) w->grows[i] += last * density * (low < 0.5 ? 1.5 : -0.5);
    }
    for (int i = 3; i < FW_SIX; i++)
        if (share[i] > 0.0) w->grows[i] += grows[i] / share[i] * part;
}

static fw_status descend(walk *w, const fw_workspace_box3 *box, int levels) {
    fw_workspace_loop_box known;
    fw_maths_interval share;
    if (fw_arena_cancelled(w->arena)) return FW_CANCELLED;
    unsigned open = levels > 0 ? FW_WANT_LIMITS : FW_WANT_ALL;
    fw_workspace_inside where =
        fw_workspace_reach_judge(w->loop, &w->allowed, 3, 0.0, box, &open, &known, &share);
    if (where == FW_OUTSIDE) return FW_OK;
    if (levels > 0) {
        for (int child = 0; child < 8; child++) {
            fw_workspace_box3 part = *box;
            for (int i = 0; i < 3; i++) {
                double middle = 0.5 * (box->lo[i] + box->hi[i]);
                *(child >> i & 1 ? &part.lo[i] : &part.hi[i]) = middle;
            }
            FW_TRY(descend(w, &part, levels - 1));
        }
        return FW_OK;
    }
    bool inside = where == FW_INSIDE;
    if (!inside && known.reached == FW_REACHED) { /* its middle may be */
        fw_workspace_box3 point;
        fw_workspace_loop_box at;
        for (int i = 0; i < 3; i++)
            point.lo[i] = point.hi[i] = 0.5 * (box->lo[i] + box->hi[i]);
        open = FW_WANT_LIMITS;
        inside = fw_workspace_reach_judge(w->loop, &w->allowed, 3, 0.0, &point, &open, &at,
                                          &share) == FW_INSIDE;
    }
    fw_workspace_regularity_add(w->loop, &w->out->singular, &known, inside);
    boundary(w, box, &known);
    return FW_OK;
}

/* Over the reachable set, by boxes that are not outside (a superset of it): singularities, proved;
   and the share of the boundary that each hinge owns, an estimate: share_i = theta_i dV/dtheta_i /
   sum_j theta_j dV/dtheta_j, the part of the volume's growth with all limits that comes from limit
   i. By the coarea formula it is the area of the boundary where hinge i is at its limit, weighted
   by theta_i / |grad psi_i|: it does not depend on how lengths are compared with angles. The sum
   over V is the exponent d ln V/d ln theta. in: limits rad; error of shares and exponent, against
   differences of certified volumes: 3e-3 where the limits keep the legs bent, 3e-2 where they do
   not (test_survey.c). Cost about 1.7 us per box, 20 ms at level 5, 150 ms at level 6. */
fw_status fw_workspace_reach_survey(const fw_arena *arena, const fw_workspace_loop *loop,
                                    const fw_workspace_reach_limits *limits, int level,
                                    fw_workspace_survey *survey) {
    *survey = (fw_workspace_survey){0};
    walk w = {.arena = arena, .loop = loop, .out = survey};
    w.allowed = fw_workspace_limits_allow(loop, limits);
    w.whole = fw_workspace_reach_whole(loop, &w.allowed);
    fw_workspace_regularity_start(&survey->singular);
    bool empty = false;
    for (int i = 0; i < 3; i++)
        empty = empty || !(w.whole.lo[i] < w.whole.hi[i]);
    if (!empty) FW_TRY(descend(&w, &w.whole, level));
    fw_workspace_regularity_end(&survey->singular);
    double sum = 0.0;
    for (int i = 0; i < FW_SIX; i++)
        sum += w.grows[i];
    for (int i = 0; i < FW_SIX; i++)
        survey->share[i] = sum > 0.0 ? w.grows[i] / sum : (double)NAN;
    survey->exponent = w.volume > 0.0 ? sum / w.volume : (double)NAN;
    return FW_OK;
}
