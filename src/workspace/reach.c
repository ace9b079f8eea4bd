/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/reach.h"
#include "base/cancel.h"
#include "workspace/cut.h"

enum { MOST_LEVEL = 14, FIRST_CELLS = 64 };

static const double turn = 6.283185307179586; /* below 2 pi */

fw_reach_limits fw_limits_symmetric(const double limit_rad[FW_SIX]) {
    fw_reach_limits l;
    for (int i = 0; i < FW_SIX; i++)
        l.high_rad[i] = limit_rad[i], l.low_rad[i] = -limit_rad[i];
    return l;
}

/* The elbow turns on the side of its drawn branch only: from b by psi, with a x R(psi) b of that
   sign. Where a limit lets it pass the stretched or folded leg, the range ends there, rounded
   outward. */
static fw_bound on_branch(const fw_leg *leg, fw_bound psi) {
    double along = leg->a.x * leg->b.x + leg->a.y * leg->b.y;
    double side = leg->a.x * leg->b.y - leg->a.y * leg->b.x, elbow = atan2(side, along);
    double half = 0.5 * turn, slack = 1e-14;
    double lo = leg->sign > 0.0 ? -elbow : -half - elbow;
    double hi = leg->sign > 0.0 ? half - elbow : -elbow;
    if (psi.low.lo < lo) psi.low = (fw_interval){lo - slack, lo + slack};
    if (psi.high.hi > hi) psi.high = (fw_interval){hi - slack, hi + slack};
    return psi;
}

/* |O Q|^2 with the elbow turned by psi: |a|^2 + |b|^2 + 2 (cos psi a.b - sin psi a x b) */
static fw_interval reach2(const fw_leg *leg, fw_interval psi) {
    fw_interval ax = fw_interval_point(leg->a.x), ay = fw_interval_point(leg->a.y);
    fw_interval bx = fw_interval_point(leg->b.x), by = fw_interval_point(leg->b.y);
    fw_interval along = fw_interval_add(fw_interval_mul(ax, bx), fw_interval_mul(ay, by));
    fw_interval side = fw_interval_sub(fw_interval_mul(ax, by), fw_interval_mul(ay, bx));
    fw_interval both = fw_interval_sub(fw_interval_mul(fw_interval_cos(psi), along),
                                       fw_interval_mul(fw_interval_sin(psi), side));
    return fw_interval_add(fw_interval_add(fw_centred_range(leg->a2), fw_centred_range(leg->b2)),
                           fw_interval_add(both, both));
}

fw_allowed fw_limits_allow(const fw_loop *k, const fw_reach_limits *l) {
    fw_allowed out;
    for (int i = 0; i < FW_SIX; i++) {
        fw_interval low = fw_loop_psi_range(k, i, fw_interval_point(l->low_rad[i]));
        fw_interval high = fw_loop_psi_range(k, i, fw_interval_point(l->high_rad[i]));
        out.psi[i] = i < 3 ? (fw_bound){low, high} : (fw_bound){high, low};
    }
    out.psi[1] = on_branch(&k->leg[0], out.psi[1]);
    /* the right leg's elbow counts from the ground up, as psi does */
    const fw_leg *right = &k->leg[1];
    fw_bound elbow = on_branch(right, out.psi[4]);
    fw_interval at_low = reach2(right, elbow.low), at_high = reach2(right, elbow.high);
    out.d2 = right->sign > 0.0 ? (fw_bound){at_high, at_low} : (fw_bound){at_low, at_high};
    return out;
}

fw_box3 fw_reach_whole(const fw_loop *k, const fw_allowed *allowed) {
    (void)k;
    fw_box3 box;
    for (int i = 0; i < 3; i++)
        box.lo[i] = allowed->psi[i].low.lo, box.hi[i] = allowed->psi[i].high.hi;
    return box;
}

/* share of the box where f <= limit, given that the box is a little smaller than +- half */
static fw_interval below(const fw_form *f, const double half[3], fw_interval limit, double slack) {
    double p[3];
    for (int i = 0; i < 3; i++)
        p[i] = fabs(f->grad[i]) * half[i];
    double least = fw_down(fw_down(limit.lo - f->at.hi) - f->rest);
    double most = fw_up(fw_up(limit.hi - f->at.lo) + f->rest);
    double low = fw_cut_share(p, least).lo, high = fw_cut_share(p, most).hi;
    if (low < 1.0) low = fmax(low - slack, 0.0);
    if (high > 0.0) high = fmin(high + slack, 1.0);
    return (fw_interval){low, high};
}

static fw_form mirrored(const fw_form *f) {
    return (fw_form){.at = fw_interval_negated(f->at),
                     .grad = {-f->grad[0], -f->grad[1], -f->grad[2]},
                     .rest = f->rest};
}

/* One hinge over a box: narrows the share that all hinges leave. Two planes per hinge stand for its
   constraint; at least 1 - sum(1 - v_i) of the box is within all of them, at most min v_i. A
   rotation found beyond +-180 deg is another one less a turn: outside only where that is out of
   range too. */
static fw_inside one_hinge(const fw_form *f, const fw_bound *range, double period,
                           const double half[3], double slack, fw_interval *share) {
    fw_interval now = fw_form_range(f, half);
    if (now.lo >= range->low.hi && now.hi <= range->high.lo) return FW_INSIDE;
    double most = period - 1e-9; /* less than a turn, whatever rounding does */
    double next = most + range->low.lo, last = range->high.hi - most;
    bool beyond = now.lo > range->high.hi && now.hi < next;
    bool before = now.hi < range->low.lo && now.lo > last;
    if (beyond || before) return FW_OUTSIDE;
    if (!(now.lo > last && now.hi < next)) {
        share->lo = 0.0; /* may reach round to the other side: nothing known */
        return FW_CUT;
    }
    fw_form minus = mirrored(f);
    fw_interval top = below(f, half, range->high, slack),
                bottom = below(&minus, half, fw_interval_negated(range->low), slack);
    double missing = fw_up(fw_up(1.0 - top.lo) + fw_up(1.0 - bottom.lo));
    share->lo = fmax(fw_down(share->lo - missing), 0.0);
    share->hi = fmin(share->hi, fmin(top.hi, bottom.hi));
    return share->hi > 0.0 ? FW_CUT : FW_OUTSIDE;
}

/* The right elbow is judged by its leg's reach, which has no singularity: d2 falls as |elbow|
 * grows. */
fw_inside fw_reach_judge(const fw_loop *k, const fw_allowed *allowed, int dimensions,
                         double phi_rad, const fw_box3 *box, fw_loop_box *known,
                         fw_interval *share) {
    double half[3] = {0}, slack = 0.0;
    for (int i = 0; i < dimensions; i++) {
        double c = fw_box3_middle(box, i, &half[i]);
        slack += 0x1p-50 * (1e-3 + fabs(c) / half[i]);
    }
    const fw_interval d2 = {allowed->d2.low.lo, allowed->d2.high.hi};
    if (dimensions == 3)
        fw_loop_joint_box(k, box, d2, known);
    else
        fw_loop_slice_box(k, box, phi_rad, d2, known);
    *share = (fw_interval){1.0, 1.0};
    if (known->reached == FW_OUT_OF_REACH) return FW_OUTSIDE;
    fw_inside all = one_hinge(&known->d2[1], &allowed->d2, (double)INFINITY, half, slack, share);
    if (all == FW_OUTSIDE) return FW_OUTSIDE;
    if (known->reached == FW_MAY_BE_OUT) {
        share->lo = 0.0;
        return FW_CUT;
    }
    for (int i = dimensions; i < FW_SIX; i++) {
        if (i == 4) continue;
        fw_inside one = one_hinge(&known->psi[i], &allowed->psi[i], turn, half, slack, share);
        if (one == FW_OUTSIDE) return FW_OUTSIDE;
        if (one == FW_CUT) all = FW_CUT;
    }
    return all;
}

/* ---- the sum ---- */

typedef struct cell {
    fw_interval part; /* of the measure that its inside has */
    unsigned short at[3];
} cell;

typedef struct cells {
    cell *item;
    size_t count, capacity;
} cells;

typedef struct search {
    fw_arena *arena;
    const fw_loop *loop;
    fw_allowed allowed;
    int dimensions;
    double phi_rad;
    fw_box3 whole;
    fw_interval decided; /* sum over boxes that are inside */
    long boxes;
} search;

static double edge(const search *s, int axis, unsigned i, int level) {
    if (i >> level) return s->whole.hi[axis];
    return s->whole.lo[axis] + (s->whole.hi[axis] - s->whole.lo[axis]) * ldexp((double)i, -level);
}

/* integral of |a x b| over the box: product of the widths, with the elbow's
   integral_-h^h sin(c + s) ds = 2 sin(c) sin(h), c the elbow's angle at the middle:
     |a x b|(c) 2 sin(h) (w_A w_C)      inside
   and |a x b| times the box's volume where only a part counts. m2 rad^n */
static fw_interval weight(const search *s, const fw_box3 *box, const fw_loop_box *known,
                          fw_inside where, fw_interval share) {
    double half, widths = box->hi[0] - box->lo[0];
    fw_box3_middle(box, 1, &half);
    if (s->dimensions == 3) widths *= box->hi[2] - box->lo[2];
    /* what rounding of the widths and the library's sine change: some 1e-15; this is 1e-12 */
    const fw_interval unit = {1.0 - 0x1p-40, 1.0 + 0x1p-40};
    fw_centred side = known->cross[0];
    if (side.m < 0.0) side = fw_centred_negated(side);
    fw_interval density = {side.m - side.e, side.m + side.e};
    double factor = widths * 2.0 * sin(half);
    if (where != FW_INSIDE) {
        density = (fw_interval){side.m - side.r, side.m + side.r};
        factor = widths * (box->hi[1] - box->lo[1]);
    }
    density.lo = fmax(density.lo, 0.0); /* across the stretched leg: the branch has part of it */
    fw_interval out = fw_interval_mul(density, fw_interval_mul(unit, fw_interval_point(factor)));
    return fw_interval_mul(out, share);
}

static fw_status keep(search *s, cells *list, const cell *one) {
    if (list->count == list->capacity) {
        size_t more = list->capacity ? 2 * list->capacity : FIRST_CELLS;
        FW_NEED(list->item = fw_arena_grow(s->arena, list->item, list->count, more, sizeof *one));
        list->capacity = more;
    }
    list->item[list->count++] = *one;
    return FW_OK;
}

/* looks at one box; keeps it in `next` when it is neither inside nor outside */
static fw_status look(search *s, int level, const unsigned short at[3], cells *next,
                      fw_interval *part) {
    fw_box3 box = {0};
    fw_loop_box known;
    fw_interval share;
    for (int i = 0; i < s->dimensions; i++) {
        box.lo[i] = edge(s, i, at[i], level);
        box.hi[i] = edge(s, i, at[i] + 1u, level);
    }
    s->boxes++;
    *part = (fw_interval){0.0, 0.0};
    fw_inside where =
        fw_reach_judge(s->loop, &s->allowed, s->dimensions, s->phi_rad, &box, &known, &share);
    if (where == FW_OUTSIDE) return FW_OK;
    *part = weight(s, &box, &known, where, share);
    part->lo = fmax(part->lo, 0.0);
    if (where == FW_INSIDE && known.cross[0].m * s->loop->leg[0].sign > known.cross[0].r) {
        s->decided = fw_interval_add(s->decided, *part);
        return FW_OK;
    }
    if (where == FW_INSIDE) part->lo = 0.0;
    return keep(s, next, &(cell){.part = *part, .at = {at[0], at[1], at[2]}});
}

static fw_status split(search *s, int level, const cell *parent, cells *next, double *gap) {
    for (int child = 0; child < 1 << s->dimensions; child++) {
        unsigned short at[3];
        fw_interval part;
        for (int i = 0; i < 3; i++)
            at[i] = (unsigned short)(2 * parent->at[i] + (child >> i & 1));
        FW_TRY(look(s, level, at, next, &part));
        *gap += part.hi - part.lo;
    }
    *gap -= parent->part.hi - parent->part.lo;
    return FW_OK;
}

/* boxes that leave more than the mean open come first: a level is seldom looked at as a whole */
static void widest_first(cells *list) {
    double mean = 0.0;
    for (size_t i = 0; i < list->count; i++)
        mean += list->item[i].part.hi - list->item[i].part.lo;
    mean /= (double)list->count;
    size_t wide = 0;
    for (size_t i = 0; i < list->count; i++) {
        if (list->item[i].part.hi - list->item[i].part.lo <= mean) continue;
        cell swap = list->item[i];
        list->item[i] = list->item[wide];
        list->item[wide++] = swap;
    }
}

static fw_interval sum(fw_interval start, const cell *item, size_t count) {
    for (size_t i = 0; i < count; i++)
        start = fw_interval_add(start, item[i].part);
    return start;
}

/* Measure of a set of joint rotations by branch and bound, level by level: boxes that are inside
   count whole, boxes outside not, of the others the share that the planes of all hinges leave
   (cut.h); the width falls fourfold with every halving. Levels share one bracket: each sum is
   proved, so that the largest lower and the smallest upper one hold. The last level stops as soon
   as it is narrow enough. dx dy dphi = |a x b| dpsi_A dpsi_B dpsi_C,  dx dy = |a x b| dpsi_A dpsi_B
   at constant phi, one to one on the branch (a x b of one sign). in: limits rad; out: m2 rad, or
   m2. Error: proved; sums are rounded outward. Cost about 0.5 us per box. Source:
   docs/theory/workspace.md. Test: test_reach.c, test_reach_random.c. */
static fw_status measured(search *s, fw_effort effort, fw_measure *out) {
    *out = (fw_measure){.value = {0.0, (double)INFINITY}};
    for (int i = 0; i < s->dimensions; i++)
        if (!(s->whole.lo[i] < s->whole.hi[i])) {
            out->value.hi = 0.0; /* the limits leave nothing */
            out->reached = true;
            return FW_OK;
        }
    cells list = {0};
    fw_interval part;
    const unsigned short first[3] = {0};
    FW_TRY(look(s, 0, first, &list, &part));
    for (int level = 0;; level++) {
        fw_interval all = sum(s->decided, list.item, list.count);
        out->value.lo = fmax(out->value.lo, all.lo);
        out->value.hi = fmin(out->value.hi, all.hi);
        out->boxes = s->boxes;
        out->level = level;
        double wanted = effort.relative * out->value.lo;
        out->reached = out->value.hi - out->value.lo <= wanted;
        if (out->reached || list.count == 0 || level == MOST_LEVEL) break;
        if (s->boxes + (long)(list.count << s->dimensions) > 8 * effort.most) break;
        cells next = {0};
        size_t done = 0;
        widest_first(&list);
        double gap = out->value.hi - out->value.lo;
        for (; done < list.count && (gap > 0.98 * wanted || wanted <= 0.0); done++) {
            if (s->boxes >= effort.most) break;
            if (done % 4096 == 0 && fw_cancel_requested()) return FW_CANCELLED;
            FW_TRY(split(s, level + 1, &list.item[done], &next, &gap));
        }
        if (done < list.count) { /* narrow enough on the way, or out of boxes: the rest as it is */
            all = sum(sum(s->decided, list.item + done, list.count - done), next.item, next.count);
            out->value.lo = fmax(out->value.lo, all.lo);
            out->value.hi = fmin(out->value.hi, all.hi);
            out->boxes = s->boxes;
            out->reached = out->value.hi - out->value.lo <= effort.relative * out->value.lo;
            break;
        }
        list = next;
    }
    return FW_OK;
}

static fw_status scratch(search *s, fw_effort effort, fw_measure *out) {
    fw_mark mark = fw_arena_mark(s->arena);
    fw_status status = measured(s, effort, out);
    fw_arena_rewind(s->arena, mark);
    return status;
}

fw_status fw_reach_volume(fw_arena *arena, const fw_loop *loop, const fw_reach_limits *limits,
                          fw_effort effort, fw_measure *volume) {
    search s = {.arena = arena, .loop = loop, .dimensions = 3};
    s.allowed = fw_limits_allow(loop, limits);
    s.whole = fw_reach_whole(loop, &s.allowed);
    return scratch(&s, effort, volume);
}

fw_status fw_reach_area(fw_arena *arena, const fw_loop *loop, const fw_reach_limits *limits,
                        double phi_rad, fw_effort effort, fw_measure *area) {
    search s = {.arena = arena, .loop = loop, .dimensions = 2, .phi_rad = phi_rad};
    s.allowed = fw_limits_allow(loop, limits);
    s.whole = fw_reach_whole(loop, &s.allowed);
    return scratch(&s, effort, area);
}
