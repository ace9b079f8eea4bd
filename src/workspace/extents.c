/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/pose_load.h"
#include "workspace/reach.h"
#include "maths/matrix.h"

typedef struct open_box {
    fw_workspace_box3 box;
    double far; /* not passed within it */
} open_box;

typedef struct end { /* largest of sign * coordinate */
    const fw_arena *arena;
    const fw_workspace_loop *loop;
    const fw_workspace_allowed *allowed;
    fw_workspace_box3 whole;
    int coordinate;
    double sign, slack, relative;
    double found, bound; /* proved to be reached; proved not to be passed */
    double pose[3];
    long boxes;
    open_box *heap; /* (open) the farthest first */
    long open;
} end;

/* ---- bound over the part of a box that the hinges' planes leave ---- */

enum { PLANES = 8 };

typedef struct planes { /* a[i].d <= t[i] for every pose of the set in the box */
    double a[PLANES][3], t[PLANES];
    int count;
} planes;

static void plane(planes *p, const fw_workspace_form *f, double sign, double limit,
                  const double half[3]) {
    double reach = 0.0;
    for (int i = 0; i < 3; i++) {
        p->a[p->count][i] = sign * f->grad[i];
        reach += fabs(f->grad[i]) * half[i];
    }
    double at = sign > 0.0 ? f->at.lo : -f->at.hi;
    p->t[p->count] = fw_up(fw_up(limit - at) + f->rest);
    if (p->t[p->count] < reach && p->count + 1 < PLANES) p->count++; /* it cuts the box */
}

/* may the rotation be that of the range, less a whole turn? Then no plane bounds it. */
static bool wraps(const fw_workspace_form *f, const fw_workspace_bound *range,
                  const double half[3]) {
    const double turn = 6.283; /* somewhat less than one */
    fw_maths_interval now = fw_form_range(f, half);
    return !(now.hi < turn + range->low.lo && now.lo > range->high.hi - turn);
}

static void planes_of(const end *e, const fw_workspace_loop_box *known, const double half[3],
                      planes *p) {
    p->count = 0;
    if (known->reached != FW_REACHED) return;
    for (int i = 3; i < FW_SIX; i++) {
        if (i == 4 || wraps(&known->psi[i], &e->allowed->psi[i], half)) continue;
        plane(p, &known->psi[i], 1.0, e->allowed->psi[i].high.hi, half);
        plane(p, &known->psi[i], -1.0, -e->allowed->psi[i].low.lo, half);
    }
    plane(p, &known->d2[1], 1.0, e->allowed->d2.high.hi, half);
    plane(p, &known->d2[1], -1.0, -e->allowed->d2.low.lo, half);
}

/* weak duality: g.d <= sum lambda_i t_i + sum_k |g_k - sum lambda_i a_ik| half_k for every lambda
 * >= 0 */
static double dual(const double g[3], const double half[3], const planes *p, const int *use,
                   const double *lambda, int n) {
    double bound = 0.0, size = 0.0;
    for (int i = 0; i < n; i++) {
        if (!(lambda[i] >= 0.0)) return (double)INFINITY;
        bound += lambda[i] * p->t[use[i]];
        size += fabs(lambda[i] * p->t[use[i]]);
    }
    for (int k = 0; k < 3; k++) {
        double rest = g[k], all = fabs(g[k]);
        for (int i = 0; i < n; i++) {
            rest -= lambda[i] * p->a[use[i]][k];
            all += fabs(lambda[i] * p->a[use[i]][k]);
        }
        bound += fabs(rest) * half[k];
        size += all * half[k];
    }
    return bound + 0x1p-48 * size; /* some 20 roundings of numbers below `size` */
}

/* multipliers that make g - sum lambda a vanish in n of the coordinates */
static double from_coordinates(const double g[3], const double half[3], const planes *p,
                               const int *unknown, const int *equation, int n) {
    double a[9], lambda[3];
    int pivot[3];
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            a[i * n + j] = p->a[unknown[j]][equation[i]];
        lambda[i] = g[equation[i]];
    }
    if (!fw_maths_lu_factor(n, a, pivot)) return (double)INFINITY;
    fw_maths_lu_solve(n, a, pivot, NULL, lambda); /* a bad pivot only gives a bad bound */
    double bound = dual(g, half, p, unknown, lambda, n);
    return bound == bound ? bound : (double)INFINITY;
}

/* least of the bounds from every one, two or three planes */
static double constrained(const double g[3], const double half[3], const planes *p) {
    double best = fabs(g[0]) * half[0] + fabs(g[1]) * half[1] + fabs(g[2]) * half[2];
    best *= 1.0 + 0x1p-48;
    static const int rows[7][3] = {{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}};
    for (int i = 0; i < p->count; i++) {
        for (int r = 0; r < 3; r++)
            best = fmin(best, from_coordinates(g, half, p, (int[]){i}, rows[r], 1));
        for (int j = i + 1; j < p->count; j++) {
            for (int r = 3; r < 6; r++)
                best = fmin(best, from_coordinates(g, half, p, (int[]){i, j}, rows[r], 2));
            for (int k = j + 1; k < p->count; k++)
                best = fmin(best, from_coordinates(g, half, p, (int[]){i, j, k}, rows[6], 3));
        }
    }
    return best;
}

static double most_of(const end *e, const fw_workspace_loop_box *known, const double half[3]) {
    const fw_workspace_form *f = &known->extent[e->coordinate];
    planes p;
    planes_of(e, known, half, &p);
    double g[3], at = e->sign > 0.0 ? f->at.hi : -f->at.lo;
    for (int i = 0; i < 3; i++)
        g[i] = e->sign * f->grad[i];
    return fw_up(fw_up(at + constrained(g, half, &p)) + f->rest);
}

/* a pose of the set, if the point is one */
static void try_point(end *e, const fw_workspace_box3 *box) {
    fw_workspace_box3 point;
    fw_workspace_loop_box known;
    fw_maths_interval share;
    double half[3];
    for (int i = 0; i < 3; i++) {
        point.lo[i] = point.hi[i] = 0.5 * (box->lo[i] + box->hi[i]);
        fw_box3_middle(&point, i, &half[i]);
    }
    unsigned open = FW_WANT_ALL;
    if (fw_workspace_reach_judge(e->loop, e->allowed, 3, 0.0, &point, &open, &known, &share) !=
        FW_INSIDE)
        return;
    fw_maths_interval range = fw_form_range(&known.extent[e->coordinate], half);
    double now = e->sign > 0.0 ? range.lo : -range.hi;
    if (!(now > e->found)) return;
    e->found = now;
    e->pose[0] = known.place.x.m, e->pose[1] = known.place.y.m, e->pose[2] = known.phi.m;
}

static int longest(const end *e, const fw_workspace_box3 *box) {
    int axis = 0;
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        double width = (box->hi[i] - box->lo[i]) / (e->whole.hi[i] - e->whole.lo[i]);
        if (width > most) most = width, axis = i;
    }
    return axis;
}

/* ---- the search ---- */

static void put(end *e, const fw_workspace_box3 *box, double far) {
    long at = e->open++;
    for (; at > 0 && e->heap[(at - 1) / 2].far < far; at = (at - 1) / 2)
        e->heap[at] = e->heap[(at - 1) / 2];
    e->heap[at] = (open_box){*box, far};
}

static open_box take(end *e) {
    open_box first = e->heap[0], last = e->heap[--e->open];
    long at = 0;
    for (long child; (child = 2 * at + 1) < e->open; at = child) {
        if (child + 1 < e->open && e->heap[child + 1].far > e->heap[child].far) child++;
        if (last.far >= e->heap[child].far) break;
        e->heap[at] = e->heap[child];
    }
    e->heap[at] = last;
    return first;
}

/* bounds a box and keeps it when it may lead farther than what is found, by more than the slack */
static void bound_box(end *e, const fw_workspace_box3 *box, double far) {
    fw_workspace_loop_box known;
    fw_maths_interval share;
    double half[3];
    e->boxes++;
    unsigned open = FW_WANT_ALL;
    if (fw_workspace_reach_judge(e->loop, e->allowed, 3, 0.0, box, &open, &known, &share) ==
        FW_OUTSIDE)
        return;
    for (int i = 0; i < 3; i++)
        fw_box3_middle(box, i, &half[i]);
    far = fmin(far, most_of(e, &known, half));
    try_point(e, box);
    put(e, box, far);
}

/* One end of the set along a coordinate, by branch and bound, the box that may lead farthest first;
   a box is bounded by its Taylor form under the planes of its hinges (a linear program, by weak
   duality). Done when no box leads farther than a pose that is proved to be inside, within the
   slack; when boxes run out before, what is left bounds the end. */
static fw_status search(end *e, long most) {
    bound_box(e, &e->whole, (double)INFINITY);
    while (e->open > 0) {
        if (fw_arena_cancelled(e->arena)) return FW_CANCELLED;
        double far = e->heap[0].far, near = fmin(e->slack, e->relative * fabs(e->found));
        if (far <= e->found + near || e->boxes + 2 > most) {
            e->bound = far;
            break;
        }
        open_box next = take(e);
        int axis = longest(e, &next.box);
        double middle = 0.5 * (next.box.lo[axis] + next.box.hi[axis]);
        fw_workspace_box3 lower = next.box, upper = next.box;
        lower.hi[axis] = upper.lo[axis] = middle;
        bound_box(e, &lower, next.far);
        bound_box(e, &upper, next.far);
    }
    e->bound = fmax(e->bound, e->found);
    return FW_OK;
}

fw_status fw_workspace_reach_extents(fw_arena *arena, const fw_workspace_loop *loop,
                                     const fw_workspace_reach_limits *limits, double relative,
                                     long most, fw_workspace_survey *survey) {
    fw_workspace_allowed allowed = fw_workspace_limits_allow(loop, limits);
    fw_workspace_box3 whole = fw_workspace_reach_whole(loop, &allowed);
    double nan_ = (double)NAN;
    for (int c = 0; c < 3; c++) {
        survey->least[c] = survey->most[c] = (fw_maths_interval){nan_, nan_};
        if (!(whole.lo[c] < whole.hi[c])) return FW_OK;
    }
    fw_mark mark = fw_arena_mark(arena);
    open_box *heap = fw_arena_array(arena, open_box, (size_t)most + 2);
    FW_NEED(heap);
    for (int c = 0; c < 3; c++)
        for (int s = 0; s < 2; s++) {
            fw_workspace_loop_box known;
            double half[3];
            fw_workspace_loop_joint_box(loop, &whole,
                                        (fw_maths_interval){-(double)INFINITY, (double)INFINITY},
                                        FW_WANT_ALL, &known);
            for (int i = 0; i < 3; i++)
                fw_box3_middle(&whole, i, &half[i]);
            end e = {.arena = arena,
                     .loop = loop,
                     .allowed = &allowed,
                     .whole = whole,
                     .coordinate = c,
                     .sign = s ? 1.0 : -1.0,
                     .relative = relative,
                     .heap = heap,
                     .found = -(double)INFINITY,
                     .bound = -(double)INFINITY};
            e.slack = relative * fw_interval_width(fw_form_range(&known.extent[c], half));
            fw_status status = search(&e, most);
            if (status != FW_OK) {
                fw_arena_rewind(arena, mark);
                return status;
            }
            if (!(e.found > -(double)INFINITY)) continue; /* no pose was found */
            fw_maths_interval end_of =
                s ? (fw_maths_interval){e.found, e.bound} : (fw_maths_interval){-e.bound, -e.found};
            *(s ? &survey->most[c] : &survey->least[c]) = end_of;
            for (int i = 0; i < 3; i++)
                (s ? survey->most_at : survey->least_at)[c][i] = e.pose[i];
        }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- what pins do not reach ----
   A strip whose strain is nowhere beyond e is nowhere bent by more than e over its strain per moment, times what a moment
   bends it there: c ds. From its middle each half turns its body by at most sum c ds and moves the pin by at most
   sum c ds (r + u) + e ds, r from the place to the pin as drawn, u from what lies farther out. Three hinges in a row turn by
   no more than theirs together, and the leg is longer or shorter than its links allow by no more than their pins move.
   Error: a tenth and the strain's own for shear, roots and sections. Test: test_workspace.py */

enum { BITS = 64, TURNED = 33 };

typedef struct supple {
    double turn_rad, shift_m;
} supple;

static supple supple_of(const fw_mechanism *m, int pin) {
    const int k = m->pin[pin].hinge;
    if (k == FW_NONE) return (supple){.turn_rad = HUGE_VAL};
    const fw_flexure_path_strain *s = &m->hinge[k].section;
    const fw_flexure_result *c = &m->hinge[k].closed_form;
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&m->hinge[k].limits);
    if (!limit || s->n < 2) return (supple){HUGE_VAL, HUGE_VAL};
    const double strain = limit->allowable_Pa / m->device->safety_factor / c->youngs_Pa *
                          (1.1 + c->error.strain + c->error.place_less[0]);
    supple all = {0, 0};
    for (int half = 0; half < 2; half++) {
        const fw_flexure_path_point *root = &s->point[half ? s->n - 1 : 0];
        double bends = strain * root->soft_per_Nm / root->strain_per_Nm * c->root_length_m /
                       s->length_m; /* the block, too */
        double u = bends * hypot(root->x_m - s->W_m[0], root->y_m - s->W_m[1]);
        all.turn_rad += bends;
        for (int i = 0, at = 0; i < BITS / 2; i++) {
            const double bit = (i + 0.5) / BITS, part = half ? 1 - bit : bit;
            for (at = 0; at + 2 < s->n && s->point[at + 1].part < part; at++)
                ;
            const fw_flexure_path_point *p = &s->point[at], *q = p + 1;
            const double t = (part - p->part) / (q->part - p->part);
            const double x = p->x_m + t * (q->x_m - p->x_m), y = p->y_m + t * (q->y_m - p->y_m);
            bends = strain / BITS *
                    fmax(p->soft_per_Nm / p->strain_per_Nm, q->soft_per_Nm / q->strain_per_Nm);
            u += bends * (hypot(x - s->W_m[0], y - s->W_m[1]) + u) + strain * s->length_m / BITS;
            all.turn_rad += bends;
        }
        all.shift_m += u;
    }
    return all;
}

/* by how much a leg is too short, or too long, for a pose */
static double lacks(const fw_workspace_loop *k, int side, const double pose[3]) {
    const fw_workspace_leg *leg = &k->leg[side];
    const double c = cos(pose[2]), n = sin(pose[2]), l = hypot(leg->a.x, leg->a.y),
                 b = hypot(leg->b.x, leg->b.y);
    const double way = hypot(k->centre.x + pose[0] + c * leg->to.x - n * leg->to.y - leg->base.x,
                             k->centre.y + pose[1] + n * leg->to.x + c * leg->to.y - leg->base.y);
    return fmax(way - l - b, fabs(l - b) - way);
}

static void look_beyond(const fw_workspace_loop *k, const supple may[2], const double pose[3],
                        bool first, fw_workspace_beyond *b) {
    for (int side = 0; side < 2; side++) {
        const double now = lacks(k, side, pose);
        if (!first && !(now - may[side].shift_m > b->lacks_m - b->gives_m)) continue;
        first = false;
        *b = (fw_workspace_beyond){.leg = side,
                                   .lacks_m = now,
                                   .gives_m = may[side].shift_m,
                                   .certain = now > may[side].shift_m,
                                   .pose = {pose[0], pose[1], pose[2]}};
    }
}

bool fw_workspace_beyond_of(const fw_mechanism *m, const fw_workspace_loop *k,
                            const fw_workspace_box3 *box, const double *at,
                            fw_workspace_beyond *b) {
    supple may[2] = {{0, 0}, {0, 0}};
    for (int i = 0; i < FW_SIX; i++) {
        const supple one = supple_of(m, i);
        may[i > 2].turn_rad += one.turn_rad, may[i > 2].shift_m += one.shift_m;
    }
    const double turned = fmax(fabs(box->lo[2]), fabs(box->hi[2]));
    const int stiff = may[1].turn_rad < may[0].turn_rad;
    if (turned > may[stiff].turn_rad) {
        *b = (fw_workspace_beyond){.leg = stiff,
                                   .certain = true,
                                   .turns = true,
                                   .gives_rad = may[stiff].turn_rad,
                                   .pose = {0.5 * (box->lo[0] + box->hi[0]),
                                            0.5 * (box->lo[1] + box->hi[1]),
                                            -box->lo[2] > box->hi[2] ? box->lo[2] : box->hi[2]}};
        return true;
    }
    if (!at) return false;
    look_beyond(k, may, at, true, b);
    for (int i = 0; i < TURNED;
         i++) /* the way to a corner is longest; that to a place within is shortest */
        for (int corner = 0; corner < 6; corner++) {
            const int side = corner - 4;
            double pose[3] = {box->lo[0], box->lo[1],
                              box->lo[2] + (box->hi[2] - box->lo[2]) * i / (TURNED - 1)};
            for (int j = 0; j < 2 && corner < 4; j++)
                pose[j] = corner >> j & 1 ? box->hi[j] : box->lo[j];
            if (corner >= 4) {
                const fw_workspace_leg *leg = &k->leg[side];
                const double c = cos(pose[2]), n = sin(pose[2]);
                const double x = leg->base.x - k->centre.x - c * leg->to.x + n * leg->to.y,
                             y = leg->base.y - k->centre.y - n * leg->to.x - c * leg->to.y;
                pose[0] = fmin(fmax(x, box->lo[0]), box->hi[0]);
                pose[1] = fmin(fmax(y, box->lo[1]), box->hi[1]);
            }
            look_beyond(k, may, pose, false, b);
        }
    return true;
}
