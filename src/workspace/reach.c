/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The volume, or the area at one rotation, of the poses that the hinges' limits leave: proved by halving boxes of joint
   rotations. */
#include "workspace/reach.h"
#include "base/constants.h"
#include "workspace/loop.h"

/* ---- the tree of halvings, kept so that another program can go over the same boxes ---- */

enum { PARTS = 8, FIRST_NODES = 1024 };

typedef struct tree_node {
    char kind;
    unsigned first; /* of eight nodes, where it is halved */
} tree_node;

typedef struct halvings {
    fw_arena *arena;
    tree_node *node; /* (count) the first is the whole box */
    size_t count, capacity;
} halvings;

/* the whole box, outside until something else is said of it */
static fw_status tree_plant(halvings *tree, fw_arena *arena) {
    *tree = (halvings){.arena = arena, .count = 1, .capacity = FIRST_NODES};
    FW_NEED(tree->node = fw_arena_array(arena, tree_node, FIRST_NODES));
    tree->node[0].kind = FW_NODE_OUTSIDE;
    return FW_OK;
}

/* halves a node along all three coordinates; *first: the first of its eight parts, all outside;
   part n is the upper half along coordinate i where bit i of n is set */
static fw_status tree_halve(halvings *tree, unsigned node, unsigned *first) {
    if (tree->count + PARTS > tree->capacity) {
        FW_NEED(tree->node = fw_arena_grow(tree->arena, tree->node, tree->count, 2 * tree->capacity,
                                           sizeof *tree->node));
        tree->capacity *= 2;
    }
    *first = (unsigned)tree->count;
    tree->node[node] = (tree_node){.kind = FW_NODE_HALVED, .first = *first};
    for (int i = 0; i < PARTS; i++)
        tree->node[tree->count++] = (tree_node){.kind = FW_NODE_OUTSIDE};
    return FW_OK;
}

/* halved, and some part of it again */
static bool goes_on(const halvings *tree, unsigned node) {
    if (tree->node[node].kind != FW_NODE_HALVED) return false;
    for (unsigned i = 0; i < PARTS; i++)
        if (tree->node[tree->node[node].first + i].kind == FW_NODE_HALVED) return true;
    return false;
}

static char *write_node(const halvings *tree, unsigned node, char *end) {
    char kind = tree->node[node].kind;
    if (!goes_on(tree, node)) {
        *end++ = kind == FW_NODE_HALVED ? FW_NODE_CUT : kind;
        return end;
    }
    *end++ = kind;
    for (unsigned i = 0; i < PARTS; i++)
        end = write_node(tree, tree->node[node].first + i, end);
    return end;
}

/* One character a node: each before its eight parts, which follow in their order. A box that was
   halved into leaves is a cut leaf itself, which makes the text a third as long: the remainders of
   tests/accept/check_volume.py are so much smaller than ours that it does without the last halving. */
static fw_status tree_text(const halvings *tree, fw_arena *arena, const char **text) {
    char *out;
    FW_NEED(out = fw_arena_array(arena, char, tree->count + 1));
    *write_node(tree, 0, out) = '\0';
    *text = out;
    return FW_OK;
}

/* ---- a plane cuts a box ---- */

/* Volume of {x in [0,1]^3 : m1 x1 + m2 x2 + m3 x3 <= a}, m1 <= m2 <= m3, 0 <= a <= (m1+m2+m3)/2:
   inclusion and exclusion of the corners that the plane has passed,
     6 m1 m2 m3 V = a^3 - (a-m1)+^3 - (a-m2)+^3 - (a-m3)+^3,
   with a^3 - (a-m1)^3 = m1 (3 a^2 - 3 a m1 + m1^2) taken apart, so that nothing cancels and small
   m1 do no harm; beyond m1 + m2 <= m3 the cut is a slanted slab, V = (a - (m1+m2)/2)/m3. in: any
   unit; out: 0..1/2. Error below 2e-15: every bracket is a sum of terms of one sign or a difference
   that leaves more than half of the larger. Cost about 20 flops. Source: the convolution of three
   uniform densities; for fluids Scardovelli and Zaleski, J. Comput. Phys. 164 (2000) 228. Test:
   test_cut.c. */
static double corner(double m1, double m2, double m3, double a) {
    if (a < m1) return a * a * a / (6.0 * m1 * m2 * m3);
    double plain = (a * (a - m1) + m1 * m1 / 3.0) / (2.0 * m2 * m3);
    if (a < m2) return plain;
    if (m1 + m2 <= m3 && a >= m1 + m2) return (a - 0.5 * (m1 + m2)) / m3;
    double over = a - m2;
    if (over > 0.0) plain -= over / m1 * over / m2 * over / (6.0 * m3);
    over = a - m3;
    if (over > 0.0) plain -= over / m1 * over / m2 * over / (6.0 * m3);
    return plain;
}

fw_maths_interval fw_workspace_cut_share(const double p[3], double t) {
    double a = p[0], b = p[1], c = p[2], swap;
    if (a > b) swap = a, a = b, b = swap;
    if (b > c) swap = b, b = c, c = swap;
    if (a > b) swap = a, a = b, b = swap;
    double sum = a + b + c;
    if (t >= fw_up(sum * 0x1.0000000000004p+0)) return (fw_maths_interval){1.0, 1.0};
    if (t <= -fw_up(sum * 0x1.0000000000004p+0)) return (fw_maths_interval){0.0, 0.0};
    if (!(c > 0.0) || !(t > -(double)INFINITY)) return (fw_maths_interval){0.0, 1.0};
    double from = 0.5 * (t + sum), share;
    if (from > 0.5 * sum)
        share = 1.0 - corner(a, b, c, from < sum ? sum - from : 0.0);
    else
        share = corner(a, b, c, from > 0.0 ? from : 0.0);
    /* the distance errs by 4 units of the sum, which is at most 3 c; the share grows at most by the
       distance over c */
    const double slack = 1e-13;
    return (fw_maths_interval){share > slack ? share - slack : 0.0,
                               share < 1.0 - slack ? share + slack : 1.0};
}

enum { MOST_LEVEL = 14, FIRST_CELLS = 64, FIRST_SUM = 1024 };

static const int judged[] = {4, 2, 3, 5}; /* hinges, the one that costs least first */

/* share of the box where f <= limit, given that the box is a little smaller than +- half */
static fw_maths_interval below(const fw_workspace_form *f, const double half[3],
                               fw_maths_interval limit, double slack) {
    double p[3];
    for (int i = 0; i < 3; i++)
        p[i] = fabs(f->grad[i]) * half[i];
    double least = fw_down(fw_down(limit.lo - f->at.hi) - f->rest);
    double most = fw_up(fw_up(limit.hi - f->at.lo) + f->rest);
    double low = fw_workspace_cut_share(p, least).lo, high = fw_workspace_cut_share(p, most).hi;
    if (low < 1.0) low = low > slack ? low - slack : 0.0;
    if (high > 0.0) high = high + slack < 1.0 ? high + slack : 1.0;
    return (fw_maths_interval){low, high};
}

static fw_workspace_form mirrored(const fw_workspace_form *f) {
    return (fw_workspace_form){.at = fw_interval_negated(f->at),
                               .grad = {-f->grad[0], -f->grad[1], -f->grad[2]},
                               .rest = f->rest};
}

/* A rotation found beyond +-180 deg is another one less a turn: outside only where that is out of
   range too. *known: it cannot reach round to the other side. */
static fw_workspace_inside stands(fw_maths_interval now, const fw_workspace_bound *range,
                                  double period, bool *known) {
    double most = period - 1e-9; /* less than a turn, whatever rounding does */
    double next = most + range->low.lo, last = range->high.hi - most;
    *known = now.lo > last && now.hi < next;
    if (now.lo >= range->low.hi && now.hi <= range->high.lo) return FW_INSIDE;
    bool beyond = now.lo > range->high.hi && now.hi < next;
    bool before = now.hi < range->low.lo && now.lo > last;
    return beyond || before ? FW_OUTSIDE : FW_CUT;
}

/* One hinge over a box: narrows the share that all hinges leave. Two planes per hinge stand for its
   constraint; at least 1 - sum(1 - v_i) of the box is within all of them, at most min v_i. */
static fw_workspace_inside one_hinge(const fw_workspace_form *f, const fw_workspace_bound *range,
                                     double period, const double half[3], double slack,
                                     fw_maths_interval *share) {
    fw_maths_interval now = fw_form_range(f, half);
    bool clear;
    fw_workspace_inside where = stands(now, range, period, &clear);
    if (where != FW_CUT) return where;
    if (!clear) {
        share->lo = 0.0; /* may reach round to the other side: nothing known */
        return FW_CUT;
    }
    fw_workspace_form minus = mirrored(f);
    fw_maths_interval top = {1.0, 1.0}, bottom = {1.0, 1.0};
    if (now.hi > range->high.lo) top = below(f, half, range->high, slack);
    if (now.lo < range->low.hi)
        bottom = below(&minus, half, fw_interval_negated(range->low), slack);
    double missing = fw_up(fw_up(1.0 - top.lo) + fw_up(1.0 - bottom.lo));
    double left = fw_down(share->lo - missing);
    double right = top.hi < bottom.hi ? top.hi : bottom.hi;
    share->lo = left > 0.0 ? left : 0.0;
    share->hi = right < share->hi ? right : share->hi;
    return share->hi > 0.0 ? FW_CUT : FW_OUTSIDE;
}

/* The right elbow is judged by its leg's reach, which has no singularity: d2 falls as |elbow|
 * grows. */
fw_workspace_inside fw_workspace_reach_judge(const fw_workspace_loop *k,
                                             const fw_workspace_allowed *allowed, int dimensions,
                                             double phi_rad, const fw_workspace_box3 *box,
                                             unsigned *open, fw_workspace_loop_box *known,
                                             fw_maths_interval *share) {
    const unsigned wanted = *open;
    double half[3] = {0}, slack = 0.0;
    for (int i = 0; i < dimensions; i++) {
        double c = fw_box3_middle(box, i, &half[i]);
        slack += 0x1p-50 * (1e-3 + fabs(c) / half[i]);
    }
    const fw_maths_interval d2 = {allowed->d2.low.lo, allowed->d2.high.hi};
    if (dimensions == 3)
        fw_workspace_loop_joint_box(k, box, d2, wanted, known);
    else
        fw_workspace_loop_slice_box(k, box, phi_rad, d2, wanted, known);
    *share = (fw_maths_interval){1.0, 1.0};
    if (known->reached == FW_OUT_OF_REACH) return FW_OUTSIDE;
    *open = 0;
    for (int n = 0; n < 4; n++) {
        int i = judged[n];
        if (i < dimensions || !(wanted & 1u << i)) continue;
        bool elbow = i == 4;
        fw_workspace_inside one = FW_CUT;
        if (elbow)
            one = one_hinge(&known->d2[1], &allowed->d2, (double)INFINITY, half, slack, share);
        else if (known->reached == FW_REACHED)
            one = one_hinge(&known->psi[i], &allowed->psi[i], FW_TURN, half, slack, share);
        else
            share->lo = 0.0, *open |= FW_WANT_BRANCH;
        if (one == FW_OUTSIDE) return FW_OUTSIDE;
        if (one == FW_CUT) *open |= 1u << i;
    }
    return *open ? FW_CUT : FW_INSIDE;
}

/* Which parts of a box one hinge's form decides, as bits: in a part f is within at + v +- reach, v
   = sum of +-g_i half_i/2 as the part lies above or below the middle, reach = sum |g_i| (half_i/2 +
   off_i) + rest, off what rounding has moved the edge between parts by. Some ten roundings of
   numbers below `reach`: 2^-48 of it. Test: test_reach_random.c. */
static void decide_parts(const fw_workspace_form *f, const fw_workspace_bound *range, double period,
                         int parts, const double half[3], const double off[3], unsigned *inside,
                         unsigned *outside) {
    bool clear;
    double step[3], reach = f->rest;
    for (int i = 0; i < 3; i++) {
        step[i] = f->grad[i] * (0.5 * half[i]);
        reach += fabs(f->grad[i]) * (0.5 * half[i] + off[i]);
    }
    reach = reach * (1.0 + 0x1p-48) + 1e-300;
    stands(fw_form_range(f, half), range, period, &clear);
    double from = fw_up(fw_up(range->low.hi - f->at.lo) + reach);
    double to = fw_down(fw_down(range->high.lo - f->at.hi) - reach);
    double before = fw_down(fw_down(range->low.lo - f->at.hi) - reach);
    double beyond = fw_up(fw_up(range->high.hi - f->at.lo) + reach);
    *inside = *outside = 0;
    for (int part = 0; part < parts && clear; part++) {
        double v = (part & 1 ? step[0] : -step[0]) + (part & 2 ? step[1] : -step[1]) +
                   (part & 4 ? step[2] : -step[2]);
        *inside |= (unsigned)(v >= from && v <= to) << part;
        *outside |= (unsigned)(v < before || v > beyond) << part;
    }
}

void fw_workspace_reach_parts(const fw_workspace_allowed *allowed, int dimensions,
                              const fw_workspace_box3 *box, const double between[3], unsigned open,
                              const fw_workspace_loop_box *known, unsigned *inside,
                              unsigned *outside) {
    double half[3] = {0}, off[3] = {0};
    const int parts = 1 << dimensions;
    for (int i = 0; i < dimensions; i++) {
        double middle = fw_box3_middle(box, i, &half[i]);
        off[i] = fw_up(fabs(between[i] - middle));
    }
    *inside = (1u << parts) - 1u, *outside = 0;
    for (int n = 0; n < 4; n++) {
        int i = judged[n];
        unsigned in = 0, out = 0;
        if (i < dimensions || !(open & 1u << i)) continue;
        if (i == 4)
            decide_parts(&known->d2[1], &allowed->d2, (double)INFINITY, parts, half, off, &in,
                         &out);
        else if (known->reached == FW_REACHED)
            decide_parts(&known->psi[i], &allowed->psi[i], FW_TURN, parts, half, off, &in, &out);
        *inside &= in;
        *outside |= out;
    }
}

/* ---- the sum ---- */

typedef struct cell {
    fw_maths_interval part; /* of the measure that its inside has */
    unsigned short at[3];
    unsigned char level, open;     /* FW_WANT_*: what is not proved of it */
    unsigned char inside, outside; /* bits of its parts of which that is proved already */
    unsigned node;                 /* of the tree, where there is one */
} cell;

typedef struct search {
    fw_arena *arena;
    const fw_workspace_loop *loop;
    fw_workspace_allowed allowed;
    int dimensions;
    double phi_rad;
    fw_workspace_box3 whole;
    fw_maths_interval decided; /* sum over boxes that are inside, or too small to be halved */
    fw_maths_interval about;   /* that and the open ones, but for rounding: says when to sum up */
    long boxes;
    int level;  /* deepest looked at */
    cell *heap; /* (count) neither inside nor outside; the one that leaves most open first */
    size_t count, capacity;
    halvings *tree; /* of all halvings; NULL: nobody wants it */
    unsigned node;  /* the one looked at */
} search;

static void note_kind(search *s, char kind) {
    if (s->tree) s->tree->node[s->node].kind = kind;
}

static double edge(const search *s, int axis, unsigned i, int level) {
    if (i >> level) return s->whole.hi[axis];
    double share = (double)i / (double)(1u << level); /* exact */
    return s->whole.lo[axis] + (s->whole.hi[axis] - s->whole.lo[axis]) * share;
}

/* integral of |a x b| over the box: product of the widths, with the elbow's
   integral_-h^h sin(c + s) ds = 2 sin(c) sin(h), c the elbow's angle at the middle:
     |a x b|(c) 2 sin(h) (w_A w_C)      inside
   and |a x b| times the box's volume where only a part counts. m2 rad^n */
static fw_maths_interval weight(const search *s, const fw_workspace_box3 *box,
                                const fw_workspace_loop_box *known, fw_workspace_inside where,
                                fw_maths_interval share) {
    double half, widths = box->hi[0] - box->lo[0];
    fw_box3_middle(box, 1, &half);
    if (s->dimensions == 3) widths *= box->hi[2] - box->lo[2];
    /* what rounding of the widths and the library's sine change: some 1e-15; this is 1e-12 */
    const fw_maths_interval unit = {1.0 - 0x1p-40, 1.0 + 0x1p-40};
    fw_maths_centred side = known->cross[0];
    if (side.m < 0.0) side = fw_centred_negated(side);
    fw_maths_interval density = {side.m - side.e, side.m + side.e};
    double factor = widths * 2.0 * sin(half);
    if (where != FW_INSIDE) {
        density = (fw_maths_interval){side.m - side.r, side.m + side.r};
        factor = widths * (box->hi[1] - box->lo[1]);
    }
    if (!(density.lo > 0.0))
        density.lo = 0.0; /* across the stretched leg: the branch has part of it */
    fw_maths_interval size = fw_interval_mul_sizes(unit, fw_interval_point(factor));
    return fw_interval_mul_sizes(fw_interval_mul_sizes(density, size), share);
}

/* ---- open boxes, a binary heap ---- */

static double open_in(const cell *c) {
    return c->part.hi - c->part.lo;
}

static fw_status keep(search *s, const cell *one) {
    if (s->count == s->capacity) {
        size_t more = s->capacity ? 2 * s->capacity : FIRST_CELLS;
        FW_NEED(s->heap = fw_arena_grow(s->arena, s->heap, s->count, more, sizeof *one));
        s->capacity = more;
    }
    size_t i = s->count++;
    for (double width = open_in(one); i > 0 && open_in(&s->heap[(i - 1) / 2]) < width;
         i = (i - 1) / 2)
        s->heap[i] = s->heap[(i - 1) / 2];
    s->heap[i] = *one;
    return FW_OK;
}

/* takes the first; the hole goes down to the end and the last cell up from there, since it mostly
   belongs near the end */
static cell take(search *s) {
    cell top = s->heap[0], last = s->heap[--s->count];
    size_t i = 0;
    for (size_t child = 1; child < s->count; i = child, child = 2 * i + 1) {
        if (child + 1 < s->count && open_in(&s->heap[child + 1]) > open_in(&s->heap[child]))
            child++;
        s->heap[i] = s->heap[child];
    }
    for (; i > 0 && open_in(&s->heap[(i - 1) / 2]) < open_in(&last); i = (i - 1) / 2)
        s->heap[i] = s->heap[(i - 1) / 2];
    s->heap[i] = last;
    return top;
}

/* ---- the search ---- */

static void note_parts(const search *s, const fw_workspace_box3 *box,
                       const fw_workspace_loop_box *known, cell *c) {
    double between[3];
    unsigned inside, outside;
    for (int i = 0; i < s->dimensions; i++)
        between[i] = edge(s, i, 2u * c->at[i] + 1u, c->level + 1);
    fw_workspace_reach_parts(&s->allowed, s->dimensions, box, between, c->open, known, &inside,
                             &outside);
    c->inside = (unsigned char)inside, c->outside = (unsigned char)outside;
}

/* a part that is inside for certain; false: the left leg may be stretched or folded in it */
static bool count_inside(search *s, const fw_workspace_box3 *box) {
    fw_workspace_loop_box known;
    double half, middle = fw_box3_middle(box, 1, &half);
    known.cross[0] = fw_workspace_loop_left_cross(s->loop, middle, half);
    if (!(known.cross[0].m * s->loop->leg[0].sign > known.cross[0].r)) return false;
    fw_maths_interval part = weight(s, box, &known, FW_INSIDE, fw_interval_point(1.0));
    s->about.lo += part.lo, s->about.hi += part.hi;
    s->decided = fw_interval_add(s->decided, part);
    note_kind(s, FW_NODE_INSIDE);
    return true;
}

/* looks at one box; keeps it when it is neither inside nor outside */
static fw_status examine(search *s, const fw_workspace_box3 *box, const unsigned short at[3],
                         int level, unsigned open) {
    fw_workspace_loop_box known;
    fw_maths_interval share;
    s->boxes++;
    if (level > s->level) s->level = level;
    fw_workspace_inside where = fw_workspace_reach_judge(s->loop, &s->allowed, s->dimensions,
                                                         s->phi_rad, box, &open, &known, &share);
    if (where == FW_OUTSIDE) return FW_OK;
    fw_maths_interval part = weight(s, box, &known, where, share);
    if (!(part.lo > 0.0)) part.lo = 0.0;
    bool sure = known.cross[0].m * s->loop->leg[0].sign > known.cross[0].r;
    if (where == FW_INSIDE && !sure) part.lo = 0.0;
    s->about.lo += part.lo, s->about.hi += part.hi;
    note_kind(s, where == FW_INSIDE && sure ? FW_NODE_INSIDE : FW_NODE_CUT);
    if ((where != FW_INSIDE || !sure) && level < MOST_LEVEL) {
        cell one = {.part = part,
                    .at = {at[0], at[1], at[2]},
                    .level = (unsigned char)level,
                    .open = (unsigned char)open,
                    .node = s->node};
        if (where == FW_CUT) note_parts(s, box, &known, &one);
        return keep(s, &one);
    }
    s->decided = fw_interval_add(s->decided, part);
    return FW_OK;
}

static fw_status split(search *s) {
    cell parent = take(s);
    s->about.lo -= parent.part.lo, s->about.hi -= parent.part.hi;
    int level = parent.level + 1;
    unsigned first = 0;
    if (s->tree) FW_TRY(tree_halve(s->tree, parent.node, &first));
    double edges[3][3] = {0};
    for (int i = 0; i < s->dimensions; i++)
        for (unsigned k = 0; k < 3; k++)
            edges[i][k] = edge(s, i, 2u * parent.at[i] + k, level);
    for (int child = 0; child < 1 << s->dimensions; child++) {
        unsigned short at[3];
        fw_workspace_box3 box;
        for (int i = 0; i < 3; i++) {
            int upper = child >> i & 1;
            at[i] = (unsigned short)(2 * parent.at[i] + upper);
            box.lo[i] = edges[i][upper], box.hi[i] = edges[i][upper + 1];
        }
        s->node = first + (unsigned)child;
        if (parent.outside >> child & 1) continue;
        if (parent.inside >> child & 1 && count_inside(s, &box)) continue;
        FW_TRY(examine(s, &box, at, level, parent.open));
    }
    return FW_OK;
}

/* the bracket that all boxes give together, cut with those before */
static void sum_up(search *s, double relative, fw_workspace_measure *out) {
    fw_maths_interval all = s->decided;
    for (size_t i = 0; i < s->count; i++)
        all = fw_interval_add(all, s->heap[i].part);
    s->about = all;
    out->value.lo = fmax(out->value.lo, all.lo);
    out->value.hi = fmin(out->value.hi, all.hi);
    out->boxes = s->boxes;
    out->level = s->level;
    out->reached = out->value.hi - out->value.lo <= relative * out->value.lo;
}

/* Measure of a set of joint rotations by branch and bound: boxes that are inside count whole, boxes
   outside not, of the others the share that the planes of all hinges leave (loop.h); what
   they leave
   open falls fourfold with every halving. The box that leaves most open is halved next, along all
   coordinates. Its own forms decide two of five parts beforehand, which need no look; what is
   proved of a box is not asked again within it: most open boxes are cut by one hinge, and the parts
   of a box that only the right elbow cuts need no inverse kinematics. Brackets are summed whenever
   the boxes have doubled and at the end, each sum is proved, so that the largest lower and the
   smallest upper one hold. dx dy dphi = |a x b| dpsi_A dpsi_B dpsi_C,  dx dy = |a x b| dpsi_A
   dpsi_B at constant phi, one to one on the branch (a x b of one sign). in: limits rad; out: m2
   rad, or m2. Error: proved; sums are rounded outward. Cost about 0.5 us per box. Source:
   docs/theory/workspace.md. Test: test_reach.c, test_reach_random.c. */
static fw_status measured(search *s, fw_workspace_proof_effort effort, fw_workspace_measure *out) {
    *out = (fw_workspace_measure){.value = {0.0, (double)INFINITY}};
    for (int i = 0; i < s->dimensions; i++)
        if (!(s->whole.lo[i] < s->whole.hi[i])) {
            out->value.hi = 0.0; /* the limits leave nothing */
            out->reached = true;
            return FW_OK;
        }
    const unsigned short first[3] = {0};
    FW_TRY(examine(s, &s->whole, first, 0, FW_WANT_LIMITS));
    sum_up(s, effort.relative, out);
    if (out->reached) return FW_OK;
    const long children = 1 << s->dimensions;
    long next =
        FIRST_SUM; /* the same places in all runs, so that finer brackets lie in coarser ones */
    for (long done = 1; s->count > 0 && s->boxes + children <= effort.most; done++) {
        if (done % 1024 == 0) {
            fw_arena_tell(s->arena, "proving the reachable set", (double)s->boxes,
                          -(double)effort.most, "boxes");
            if (fw_arena_cancelled(s->arena)) return FW_CANCELLED;
        }
        FW_TRY(split(s));
        bool narrow = s->about.hi - s->about.lo <= 0.96 * effort.relative * s->about.lo;
        if (!narrow && s->boxes < next) continue;
        while (next <= s->boxes)
            next *= 2;
        sum_up(s, effort.relative, out);
        if (out->reached) return FW_OK;
    }
    sum_up(s, effort.relative, out);
    return FW_OK;
}

static fw_status scratch(search *s, fw_workspace_proof_effort effort, fw_workspace_measure *out) {
    fw_mark mark = fw_arena_mark(s->arena);
    fw_status status = measured(s, effort, out);
    fw_arena_rewind(s->arena, mark);
    return status;
}

fw_status fw_workspace_reach_volume(fw_arena *arena, const fw_workspace_loop *loop,
                                    const fw_workspace_reach_limits *limits,
                                    fw_workspace_proof_effort effort,
                                    fw_workspace_measure *volume) {
    search s = {.arena = arena, .loop = loop, .dimensions = 3};
    s.allowed = fw_workspace_limits_allow(loop, limits);
    s.whole = fw_workspace_reach_whole(loop, &s.allowed);
    return scratch(&s, effort, volume);
}

/* The same search, of which the halvings are kept: they grow in an arena of their own, and only the
   text of the tree stays. in: limits rad; out: bracket m2 rad, the box of rotations (rad) and its
   tree. Error: the bracket is proved as before; of the tree that every leaf inside or outside is so.
   Cost 8 bytes a node besides the search, 1.3 nodes for each box looked at. Source:
   docs/theory/workspace.md. Test: test_reach_random.c, tests/accept/check_volume.py. */
fw_status fw_workspace_reach_certify(fw_arena *arena, const fw_workspace_loop *loop,
                                     const fw_workspace_reach_limits *limits,
                                     fw_workspace_proof_effort effort, fw_workspace_measure *volume,
                                     fw_workspace_volume_proof *proof) {
    fw_arena *own = fw_arena_part(arena, 0);
    FW_NEED(own);
    halvings tree;
    search s = {.arena = own, .loop = loop, .dimensions = 3, .tree = &tree};
    s.allowed = fw_workspace_limits_allow(loop, limits);
    s.whole = proof->box = fw_workspace_reach_whole(loop, &s.allowed);
    fw_status status = tree_plant(&tree, own);
    if (status == FW_OK) status = measured(&s, effort, volume);
    if (status == FW_OK) status = tree_text(&tree, arena, &proof->tree);
    fw_arena_free(own);
    return status;
}

fw_status fw_workspace_reach_area(fw_arena *arena, const fw_workspace_loop *loop,
                                  const fw_workspace_reach_limits *limits, double phi_rad,
                                  fw_workspace_proof_effort effort, fw_workspace_measure *area) {
    search s = {.arena = arena, .loop = loop, .dimensions = 2, .phi_rad = phi_rad};
    s.allowed = fw_workspace_limits_allow(loop, limits);
    s.whole = fw_workspace_reach_whole(loop, &s.allowed);
    return scratch(&s, effort, area);
}
