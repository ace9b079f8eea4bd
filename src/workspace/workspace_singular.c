/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/survey.h"

/* Velocities of the loop: sum over the hinges of psi_i' (1, y_i, -x_i) = 0. With the hinges of a
   set P passive and the others given, the three columns of P must be independent: det [1 x_i y_i] =
   twice the area of the triangle of P, not 0. The serial singularity, where the platform loses a
   freedom, is sin(elbow) = 0 of either leg. Source: the loop closure, docs/theory/workspace.md.
   Test: test_survey.c. */

void fw_workspace_regularity_start(fw_workspace_regularity *s) {
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

void fw_workspace_regularity_add(const fw_workspace_loop *k, fw_workspace_regularity *s,
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

void fw_workspace_regularity_end(fw_workspace_regularity *s) {
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
    fw_workspace_regularity_start(&one);
    fw_workspace_regularity_add(k, &one, known, false);
    fw_workspace_regularity_end(&one);
    bool all = one.regular[0] && one.regular[1];
    for (int i = 0; i < FW_TRIANGLES; i++)
        all = all && one.passive[i].regular;
    return all;
}

static fw_status descend(const fw_arena *arena, const fw_workspace_loop *k,
                         const fw_workspace_box3 *box, int level, fw_workspace_regularity *s) {
    fw_workspace_loop_box known = {.reached = FW_MAY_BE_OUT};
    fw_workspace_loop_pose_box(k, box, &known);
    if (known.reached == FW_OUT_OF_REACH) return FW_OK;
    if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    bool split = known.reached != FW_REACHED || level < ALWAYS || !plain(k, &known);
    if (!split || level == DEEPEST) {
        if (known.reached == FW_REACHED)
            fw_workspace_regularity_add(k, s, &known, true);
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
        if (!same) FW_TRY(descend(arena, k, &part, level + 1, s));
    }
    return FW_OK;
}

/* Singularities over a box of poses: halved at least three times, and where the sign of a triangle
   or an elbow is not yet certain up to six times. Bounds are proved. Cost about 4 us per box, 512
   boxes where all is regular. Test: test_survey.c. */
fw_status fw_workspace_required_survey(const fw_arena *arena, const fw_workspace_loop *k,
                                       const fw_workspace_box3 *box, fw_workspace_regularity *s) {
    fw_workspace_regularity_start(s);
    FW_TRY(descend(arena, k, box, 0, s));
    fw_workspace_regularity_end(s);
    return FW_OK;
}
