/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/reach.h"
#include "workspace/loop.h"
#include <math.h>

/* ---- singularities ---- */

/* Velocities of the loop: sum over the hinges of psi_i' (1, y_i, -x_i) = 0. With the hinges of a
   set P passive and the others given, the three columns of P must be independent: det [1 x_i y_i] =
   twice the area of the triangle of P, not 0. The serial singularity, where the platform loses a
   freedom, is sin(elbow) = 0 of either leg. Source: the loop closure, docs/theory/workspace.md.
   Test: test_survey.c. */

static void regularity_start(fw_workspace_regularity *s) {
    *s = (fw_workspace_regularity){0};
    int n = 0;
    for (int a = 0; a < FW_SIX; a++)
        for (int b = a + 1; b < FW_SIX; b++)
            for (int c = b + 1; c < FW_SIX; c++)
                s->passive[n++] =
                    (fw_workspace_triangle){.hinge = {a, b, c},
                                            .area2_m2 = {(double)INFINITY, -(double)INFINITY},
                                            .length_m = {(double)INFINITY, (double)INFINITY}};
    s->sine[0] = s->sine[1] = (fw_maths_interval){(double)INFINITY, -(double)INFINITY};
}

static fw_maths_centred apart(fw_maths_centred a, fw_maths_centred b) {
    return fw_centred_sub(a, b);
}

static const fw_maths_interval everything = {-(double)INFINITY, (double)INFINITY};

static void one_triangle(fw_workspace_triangle *t, const fw_workspace_loop_box *known,
                         bool inside) {
    bool elbow = t->hinge[0] == 4 || t->hinge[1] == 4 || t->hinge[2] == 4;
    if (elbow && known->reached != FW_REACHED) { /* nobody knows where E is */
        t->area2_m2 = everything;
        t->length_m.lo = 0.0;
        return;
    }
    const fw_workspace_centred2 *p = &known->hinge[t->hinge[0]], *q = &known->hinge[t->hinge[1]],
                                *r = &known->hinge[t->hinge[2]];
    fw_maths_centred ux = apart(q->x, p->x), uy = apart(q->y, p->y);
    fw_maths_centred vx = apart(r->x, p->x), vy = apart(r->y, p->y);
    fw_maths_centred wx = apart(r->x, q->x), wy = apart(r->y, q->y);
    fw_maths_centred area = fw_centred_sub(fw_centred_mul(ux, vy), fw_centred_mul(uy, vx));
    fw_maths_centred u2 = fw_centred_add(fw_centred_mul(ux, ux), fw_centred_mul(uy, uy));
    fw_maths_centred v2 = fw_centred_add(fw_centred_mul(vx, vx), fw_centred_mul(vy, vy));
    fw_maths_centred w2 = fw_centred_add(fw_centred_mul(wx, wx), fw_centred_mul(wy, wy));
    t->area2_m2 = fw_interval_hull(t->area2_m2, fw_centred_range(area));
    double side2 = fmax(u2.m + u2.r, fmax(v2.m + v2.r, w2.m + w2.r));
    double least = fmax(fabs(area.m) - area.r, 0.0) / sqrt(side2) * (1.0 - 1e-14);
    t->length_m.lo = fmin(t->length_m.lo, least);
    if (!inside) return;
    t->positive = t->positive || area.m > area.e;
    t->negative = t->negative || area.m < -area.e;
    double at = (fabs(area.m) + area.e) / sqrt(fmax(u2.m - u2.e, fmax(v2.m - v2.e, w2.m - w2.e))) *
                (1.0 + 1e-14);
    if (at < t->length_m.hi) {
        t->length_m.hi = at;
        t->pose[0] = known->place.x.m, t->pose[1] = known->place.y.m, t->pose[2] = known->phi.m;
    }
}

/* known: of a box that is not outside; `inside`: its middle is proved to belong to the set */
static void regularity_add(const fw_workspace_loop *k, fw_workspace_regularity *s,
                           const fw_workspace_loop_box *known, bool inside) {
    for (int side = 0; side < 2; side++) {
        const fw_workspace_leg *leg = &k->leg[side];
        fw_maths_interval product = fw_maths_interval_sqrt(
            fw_maths_interval_mul(fw_centred_range(leg->a2), fw_centred_range(leg->b2)));
        fw_maths_interval sine = {-1.0, 1.0};
        if (side == 0 || known->reached == FW_REACHED)
            sine = fw_maths_interval_div(fw_centred_range(known->cross[side]), product);
        s->sine[side] = fw_interval_hull(s->sine[side], sine);
    }
    for (int i = 0; i < FW_TRIANGLES; i++)
        one_triangle(&s->passive[i], known, inside);
    s->boxes++;
}

static void regularity_end(fw_workspace_regularity *s) {
    for (int side = 0; side < 2; side++) {
        s->sine[side].lo = fmax(s->sine[side].lo, -1.0);
        s->sine[side].hi = fmin(s->sine[side].hi, 1.0);
        s->regular[side] = s->boxes > 0 && (s->sine[side].lo > 0.0 || s->sine[side].hi < 0.0);
    }
    for (int i = 0; i < FW_TRIANGLES; i++) {
        fw_workspace_triangle *t = &s->passive[i];
        t->regular = s->boxes > 0 && (t->area2_m2.lo > 0.0 || t->area2_m2.hi < 0.0);
        if (t->positive && t->negative) t->length_m.hi = 0.0; /* in line on the way */
        t->length_m.lo = fmin(t->length_m.lo, t->length_m.hi);
    }
}

/* ---- over a required box of poses ---- */

enum { ALWAYS = 3, DEEPEST = 6 };

static bool plain(const fw_workspace_loop *k, const fw_workspace_loop_box *known) {
    fw_workspace_regularity one;
    regularity_start(&one);
    regularity_add(k, &one, known, false);
    regularity_end(&one);
    bool all = one.regular[0] && one.regular[1];
    for (int i = 0; i < FW_TRIANGLES; i++)
        all = all && one.passive[i].regular;
    return all;
}

static fw_status descend_singular(const fw_arena *arena, const fw_workspace_loop *k,
                                  const fw_workspace_box3 *box, int level,
                                  fw_workspace_regularity *s) {
    fw_workspace_loop_box known = {.reached = FW_MAY_BE_OUT};
    fw_workspace_loop_pose_box(k, box, &known);
    if (known.reached == FW_OUT_OF_REACH) return FW_OK;
    if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    bool split = known.reached != FW_REACHED || level < ALWAYS || !plain(k, &known);
    if (!split || level == DEEPEST) {
        if (known.reached == FW_REACHED)
            regularity_add(k, s, &known, true);
        else { /* a leg may be stretched or folded */
            s->sine[0] = fw_interval_hull(s->sine[0], (fw_maths_interval){-1.0, 1.0});
            s->sine[1] = fw_interval_hull(s->sine[1], (fw_maths_interval){-1.0, 1.0});
            for (int i = 0; i < FW_TRIANGLES; i++)
                s->passive[i].area2_m2 = everything, s->passive[i].length_m.lo = 0.0;
            s->boxes++;
        }
        return FW_OK;
    }
    for (int child = 0; child < 8; child++) {
        fw_workspace_box3 part = *box;
        bool same = false; /* an axis without width has one child */
        for (int i = 0; i < 3; i++) {
            double middle = 0.5 * (box->lo[i] + box->hi[i]);
            bool upper = child >> i & 1;
            same = same || (upper && !(box->hi[i] > box->lo[i]));
            *(upper ? &part.lo[i] : &part.hi[i]) = middle;
        }
        if (!same) FW_TRY(descend_singular(arena, k, &part, level + 1, s));
    }
    return FW_OK;
}

/* Singularities over a box of poses: halved at least three times, and where the sign of a triangle
   or an elbow is not yet certain up to six times. Bounds are proved. Cost about 4 us per box, 512
   boxes where all is regular. Test: test_survey.c. */
fw_status fw_workspace_required_survey(const fw_arena *arena, const fw_workspace_loop *k,
                                       const fw_workspace_box3 *box, fw_workspace_regularity *s) {
    regularity_start(s);
    FW_TRY(descend_singular(arena, k, box, 0, s));
    regularity_end(s);
    return FW_OK;
}

/* ---- shares of the boundary, over the reachable set ---- */

typedef struct walk {
    const fw_arena *arena;
    const fw_workspace_loop *loop;
    fw_workspace_allowed allowed;
    fw_workspace_box3 whole;
    fw_workspace_survey *out;
    bool singularities;
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
    unsigned open = levels > 0 || !w->singularities ? FW_WANT_LIMITS : FW_WANT_ALL;
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
    boundary(w, box, &known);
    if (!w->singularities) return FW_OK;
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
    regularity_add(w->loop, &w->out->singular, &known, inside);
    return FW_OK;
}

/* Over the reachable set, by boxes that are not outside (a superset of it): singularities, proved;
   and the share of the boundary that each hinge owns, an estimate: share_i = theta_i dV/dtheta_i /
   sum_j theta_j dV/dtheta_j, the part of the volume's growth with all limits that comes from limit
   i. By the coarea formula it is the area of the boundary where hinge i is at its limit, weighted
   by theta_i / |grad psi_i|: it does not depend on how lengths are compared with angles. The sum
   over V is the exponent d ln V/d ln theta. in: limits rad; error of shares and exponent, against
   differences of certified volumes: 3e-3 where the limits keep the legs bent, 3e-2 where they do
   not (test_survey.c). singularities false: they are not looked at. Cost about 1.7 us per box, 20 ms
   at level 5, 150 ms at level 6; a third of it without singularities. */
fw_status fw_workspace_reach_survey(const fw_arena *arena, const fw_workspace_loop *loop,
                                    const fw_workspace_reach_limits *limits, int level,
                                    bool singularities, fw_workspace_survey *survey) {
    *survey = (fw_workspace_survey){0};
    walk w = {.arena = arena, .loop = loop, .out = survey, .singularities = singularities};
    w.allowed = fw_workspace_limits_allow(loop, limits);
    w.whole = fw_workspace_reach_whole(loop, &w.allowed);
    regularity_start(&survey->singular);
    bool empty = false;
    for (int i = 0; i < 3; i++)
        empty = empty || !(w.whole.lo[i] < w.whole.hi[i]);
    if (!empty) FW_TRY(descend(&w, &w.whole, level));
    regularity_end(&survey->singular);
    double sum = 0.0;
    for (int i = 0; i < FW_SIX; i++)
        sum += w.grows[i];
    for (int i = 0; i < FW_SIX; i++)
        survey->share[i] = sum > 0.0 ? w.grows[i] / sum : (double)NAN;
    survey->exponent = w.volume > 0.0 ? sum / w.volume : (double)NAN;
    return FW_OK;
}

const fw_workspace_effort fw_workspace_usual = {
    .relative = 2e-3, .most = 400000, .level = 6, .singularities = true, .certified = true};
const fw_workspace_effort fw_workspace_quick = {.relative = 2e-2, .most = 80000, .level = 5};

static const double slice_relative = 1e-3, extent_relative = 1e-3;
enum { SLICE_BOXES = 100000, EXTENT_BOXES = 20000 };

/* elastic limits of the six hinges; false: one has none */
static bool limits_of(const fw_mechanism *m, double limit_rad[FW_SIX]) {
    for (int i = 0; i < FW_SIX; i++) {
        int hinge = m->pin[i].hinge;
        limit_rad[i] = hinge == FW_NONE ? (double)NAN : m->hinge[hinge].closed_form.limit_angle_rad;
        if (!(limit_rad[i] > 0.0 && limit_rad[i] < 3.0)) return false;
    }
    return true;
}

fw_status fw_workspace_map_make(fw_arena *arena, const fw_mechanism *m, fw_workspace_effort effort,
                                fw_workspace_map *map) {
    *map = (fw_workspace_map){0};
    const char *held = NULL;
    if (!m->device->six_bar || m->npin < FW_SIX)
        map->none = "the mechanism is not a <six-bar>";
    else if (!fw_workspace_loop_set_up(m, &map->loop))
        map->none = "a leg is stretched or folded in the drawn pose";
    else if (!limits_of(m, map->limit_rad))
        map->none = "a hinge has no elastic limit: give every hinge of the six-bar a flexure";
    if (map->none) return FW_OK;
    FW_TRY(fw_workspace_six_bar_foreign_joint(arena, m, &held));
    if (held) {
        FW_NEED(map->none = fw_arena_printf(arena, "%s holds or drives the six-bar", held));
        return FW_OK;
    }
    map->limits = fw_workspace_limits_symmetric(map->limit_rad);
    const fw_workspace_proof_effort wanted = {effort.relative, effort.most};
    if (effort.certified)
        FW_TRY(fw_workspace_reach_certify(arena, &map->loop, &map->limits, wanted, &map->volume,
                                          &map->proof));
    else
        FW_TRY(fw_workspace_reach_volume(arena, &map->loop, &map->limits, wanted, &map->volume));
    FW_TRY(fw_workspace_reach_survey(arena, &map->loop, &map->limits, effort.level,
                                     effort.singularities, &map->survey));
    FW_TRY(fw_workspace_reach_extents(arena, &map->loop, &map->limits, extent_relative,
                                      EXTENT_BOXES, &map->survey));
    for (int i = 0; i < FW_SLICES; i++) {
        double step = i - FW_SLICES / 2;
        double end = step < 0.0 ? -map->survey.least[2].hi : map->survey.most[2].lo;
        fw_workspace_slice *s = &map->slice[i];
        s->phi_rad = isfinite(end) ? step * end / (FW_SLICES / 2 + 1) : 0.0;
        FW_TRY(fw_workspace_reach_area(arena, &map->loop, &map->limits, s->phi_rad,
                                       (fw_workspace_proof_effort){slice_relative, SLICE_BOXES},
                                       &s->area));
    }
    return FW_OK;
}

int fw_workspace_governs(const fw_workspace_map *map, const fw_mechanism *m, const double pose[3],
                         double *utilisation) {
    double angle[FW_SIX];
    int leg, worst = 0;
    *utilisation = 2.0;
    if (!fw_workspace_six_bar_inverse(m, pose[0], pose[1], pose[2], angle, &leg)) return FW_NONE;
    *utilisation = 0.0;
    for (int i = 0; i < FW_SIX; i++) {
        double now = fabs(angle[i]) / map->limit_rad[i];
        if (now > *utilisation) *utilisation = now, worst = i;
    }
    return worst;
}
