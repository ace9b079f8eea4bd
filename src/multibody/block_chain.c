/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/system.h"
#include "multibody/multibody_scratch.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

fw_status fw_multibody_chain_numbers_new(fw_arena *arena, const fw_multibody_model *m,
                                         fw_multibody_chain_numbers *s) {
    size_t p = (size_t)m->chain.pins, blocks = (size_t)m->chain.blocks;
    FW_NEED(s->diagonal = fw_arena_array(arena, double, 3 * p));
    FW_NEED(s->pivot = fw_arena_array(arena, double, 3 * p));
    FW_NEED(s->first_row = fw_arena_array(arena, unsigned char, p));
    FW_NEED(s->block = fw_arena_array(arena, double, 4 * blocks));
    FW_NEED(s->factor = fw_arena_array(arena, double, 4 * blocks));
    FW_NEED(s->more = fw_arena_array(arena, double, 2 * p));
    FW_NEED(s->left = fw_arena_array(arena, double, 2 * p));
    FW_NEED(s->product = fw_arena_array(arena, double, (size_t)m->nq));
    return FW_OK;
}

/* ---- S where every block is a pin ---- */

/* with p(r) = (-r_y, r_x) the rows of pin i on body b are +-[I, p(r_i)], so the block of pins i, j
   that share b is +-(I/m + p(r_i) p(r_j)^T / J); 15 flops per pin and body */
static void assemble_pins(const fw_multibody_model *m, const fw_multibody_pose *pose,
                          fw_multibody_chain_numbers *restrict s) {
    const fw_multibody_chain *restrict c = &m->chain;
    const double *restrict arm = pose->arm, *restrict minv = m->minv, *restrict jinv = m->jinv;
    for (int i = 0; i < c->pins; i++) {
        int a = m->body[2 * i], b = m->body[2 * i + 1];
        double ax = arm[4 * i], ay = arm[4 * i + 1], bx = arm[4 * i + 2], by = arm[4 * i + 3];
        double mass = minv[a] + minv[b], ja = jinv[a], jb = jinv[b];
        s->diagonal[3 * i] = mass + ja * ay * ay + jb * by * by;
        s->diagonal[3 * i + 1] = -(ja * ax * ay + jb * bx * by);
        s->diagonal[3 * i + 2] = mass + ja * ax * ax + jb * bx * bx;
    }
    for (int i = 0; i < c->ncoupling; i++) {
        const fw_multibody_coupling *k = &c->coupling[i];
        const double *r = arm + 2 * k->row_arm, *q = arm + 2 * k->column_arm;
        double *to = s->block + 4 * k->block;
        double mass = k->sign * minv[k->body], j = k->sign * jinv[k->body];
        to[0] += mass + j * r[1] * q[1];
        to[1] -= j * r[1] * q[0];
        to[2] -= j * r[0] * q[1];
        to[3] += mass + j * r[0] * q[0];
    }
}

/* ---- S of any blocks, from their 2 x 3 Jacobians ---- */

/* row k of g times M^-1 times row l of h */
static double weighted(const double *g, int k, const double *h, int l, double minv, double jinv) {
    g += 3 * k, h += 3 * l;
    return minv * (g[0] * h[0] + g[1] * h[1]) + jinv * g[2] * h[2];
}

static void assemble_any(const fw_multibody_model *m, const fw_multibody_pose *pose,
                         fw_multibody_chain_numbers *s) {
    const fw_multibody_chain *c = &m->chain;
    for (int i = 0; i < c->pins; i++) {
        double *d = s->diagonal + 3 * i;
        d[0] = d[1] = 0;
        d[2] = fw_multibody_row_count(&m->block[i]) == 2 ? 0 : 1; /* an empty row: lambda = 0 */
        for (int side = 0; side < 2; side++) {
            int body = m->body[2 * i + side];
            const double *g = pose->jac + 12 * i + 6 * side;
            double minv = m->minv[body], jinv = m->jinv[body];
            d[0] += weighted(g, 0, g, 0, minv, jinv);
            d[1] += weighted(g, 0, g, 1, minv, jinv);
            d[2] += weighted(g, 1, g, 1, minv, jinv);
        }
    }
    for (int i = 0; i < c->ncoupling; i++) {
        const fw_multibody_coupling *k = &c->coupling[i];
        const double *g = pose->jac + 6 * k->row_arm, *h = pose->jac + 6 * k->column_arm;
        double *to = s->block + 4 * k->block, minv = m->minv[k->body], jinv = m->jinv[k->body];
        for (int e = 0; e < 4; e++)
            to[e] += weighted(g, e / 2, h, e % 2, minv, jinv);
    }
}

/* S = G M^-1 G^T in 2 x 2 blocks along the joint graph. Inputs: the pose (arms or jac), minv, jinv;
   outputs diagonal (3 pins), block (4 blocks). Exact but for rounding. Cost O(pins). Source:
   reference-point coordinates, e.g. Garcia de Jalon and Bayo 1994, ch. 2 and 5. Test:
   test_block_chain.c. */
void fw_multibody_chain_assemble(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                 fw_multibody_chain_numbers *s) {
    memset(s->block, 0, 4 * (size_t)m->chain.blocks * sizeof *s->block);
    if (m->plain)
        assemble_pins(m, pose, s);
    else
        assemble_any(m, pose, s);
}

/* S + eps D = L D L^T, D = 1/m_a + 1/m_b for pins, column by column in the compiled order. The
   shift goes with the smaller eigenvalue of a pin's block: one that went with the larger, r^2/J,
   would drown it where J is small against m r^2. Outputs pivot (inverse pivot blocks), factor (L).
   `block` is used up. Error: backward stable, S + eps D is positive definite. Cost: chains and
   rings O(pins). Source: Golub and Van Loan, Matrix Computations, ch. 4. Test:
   test_block_chain.c. */
bool fw_multibody_chain_factor(const fw_multibody_chain *c, fw_multibody_chain_numbers *s,
                               double epsilon) {
    double *restrict d = s->diagonal, *restrict block = s->block, *restrict factor = s->factor;
    for (int i = 0; i < c->pins; i++) {
        d[3 * i] += epsilon * c->isotropic[2 * i];
        d[3 * i + 2] += epsilon * c->isotropic[2 * i + 1];
    }
    bool positive = true;
    for (int k = 0; k < c->pins; k++) {
        const int y = d[3 * k + 2] > d[3 * k], x = !y; /* rows of the block: the larger first */
        double xx = d[3 * k + 2 * y], xy = d[3 * k + 1], yy = d[3 * k + 2 * x];
        double ix = 1 / xx, slant = xy * ix, rest = yy - xy * slant, iy = 1 / rest;
        positive &= xx > 0 && rest > 0;
        s->first_row[k] = (unsigned char)y;
        s->pivot[3 * k] = ix, s->pivot[3 * k + 1] = slant, s->pivot[3 * k + 2] = iy;
        for (int e = c->column[k]; e < c->column[k + 1]; e++) {
            const double *b = block + 4 * e;
            double *l = factor + 4 * e, *to = d + 3 * c->row[e];
            for (int row = 0; row < 4; row += 2) {
                l[row + x] = (b[row + x] - slant * b[row + y]) * iy;
                l[row + y] = b[row + y] * ix - slant * l[row + x];
            }
            to[0] -= l[0] * b[0] + l[1] * b[1];
            to[1] -= l[0] * b[2] + l[1] * b[3];
            to[2] -= l[2] * b[2] + l[3] * b[3];
        }
        for (int u = c->first[k]; u < c->first[k + 1]; u++) {
            const double *l = factor + 4 * c->update[u].left, *b = block + 4 * c->update[u].right;
            double *to = block + 4 * c->update[u].to;
            to[0] -= l[0] * b[0] + l[1] * b[1];
            to[1] -= l[0] * b[2] + l[1] * b[3];
            to[2] -= l[2] * b[0] + l[3] * b[1];
            to[3] -= l[2] * b[2] + l[3] * b[3];
        }
    }
    return positive;
}

void fw_multibody_chain_solve(const fw_multibody_chain *c, const fw_multibody_chain_numbers *s,
                              double *restrict x) {
    const double *restrict factor = s->factor;
    for (int k = 0; k < c->pins; k++) {
        double x0 = x[2 * k], x1 = x[2 * k + 1];
        for (int e = c->column[k]; e < c->column[k + 1]; e++) {
            const double *l = factor + 4 * e;
            double *to = x + 2 * c->row[e];
            to[0] -= l[0] * x0 + l[1] * x1;
            to[1] -= l[2] * x0 + l[3] * x1;
        }
    }
    for (int k = c->pins - 1; k >= 0; k--) {
        const double *p = s->pivot + 3 * k;
        const int first = 2 * k + s->first_row[k], other = 4 * k + 1 - first;
        x[other] = (x[other] - p[1] * x[first]) * p[2];
        x[first] = x[first] * p[0] - p[1] * x[other];
        double x0 = x[2 * k], x1 = x[2 * k + 1];
        for (int e = c->column[k]; e < c->column[k + 1]; e++) {
            const double *l = factor + 4 * e, *from = x + 2 * c->row[e];
            x0 -= l[0] * from[0] + l[2] * from[1];
            x1 -= l[1] * from[0] + l[3] * from[1];
        }
        x[2 * k] = x0, x[2 * k + 1] = x1;
    }
}

/* out = S p = G M^-1 G^T p at the pose, from the Jacobian and not from the blocks; an empty row
   gives 0, as its right side is 0 */
static void multiply(const fw_multibody_model *m, const fw_multibody_pose *pose, const double *p,
                     double *product, double *out) {
    memset(product, 0, (size_t)m->nq * sizeof *product);
    fw_multibody_apply(m, pose, p, product);
    fw_multibody_jacobian(m, pose, product, out);
    for (int i = 0; i < 2 * m->nblock; i++)
        out[i] = -out[i];
}

/* S x = right without a rank decision: x += (S + eps D)^-1 (right - S x), the residual by products
   with the Jacobian, so that digits which the blocks have lost (J small against m r^2) are found
   again. Two sweeps always, more while the residual exceeds 1e-14 |right| and falls, at most six:
   the error in a mode with relative eigenvalue s shrinks by eps/(s + eps) per sweep; modes with s =
   0 are redundant rows and do not move a body, and weak ones near a singular position are damped.
   Inputs right (2 nblock, kept), pose and factor; output x. Source: proximal point algorithm,
   Rockafellar 1976; Carpentier et al., RSS 2021. Test: test_block_chain.c. */
void fw_multibody_chain_proximal(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                 fw_multibody_chain_numbers *s, const double *right, double *x) {
    int n = 2 * m->nblock;
    double *more = s->more, *left = s->left, size = 0, before = (double)INFINITY;
    for (int i = 0; i < n; i++) {
        size = fmax(size, fabs(right[i]));
        more[i] = right[i];
        x[i] = 0;
    }
    for (int sweep = 0; sweep < 6; sweep++) {
        double worst = 0;
        fw_multibody_chain_solve(&m->chain, s, more);
        for (int i = 0; i < n; i++)
            x[i] += more[i];
        if (sweep == 5) return;
        multiply(m, pose, x, s->product, left);
        for (int i = 0; i < n; i++) {
            more[i] = right[i] - left[i];
            worst = fmax(worst, fabs(more[i]));
        }
        if (sweep > 0 && (!(worst > 1e-14 * size) || worst > 0.5 * before)) return;
        before = worst;
    }
}

/* ---- elimination order and schedule ---- */

/* ---- sets of neighbours, sorted ---- */
typedef struct set {
    int *item;
    int count, capacity;
} set;

static fw_status insert(fw_arena *arena, set *s, int value) {
    int at = s->count;
    while (at > 0 && s->item[at - 1] >= value) {
        if (s->item[at - 1] == value) return FW_OK;
        at--;
    }
    if (s->count == s->capacity) {
        int more = s->capacity ? 2 * s->capacity : 8;
        int *item = fw_arena_grow(arena, s->item, (size_t)s->count, (size_t)more, sizeof *item);
        FW_NEED(item);
        s->item = item;
        s->capacity = more;
    }
    memmove(s->item + at + 1, s->item + at, (size_t)(s->count - at) * sizeof *s->item);
    s->item[at] = value;
    s->count++;
    return FW_OK;
}

static void erase(set *s, int value) {
    for (int i = 0; i < s->count; i++)
        if (s->item[i] == value) {
            memmove(s->item + i, s->item + i + 1, (size_t)(s->count - i - 1) * sizeof *s->item);
            s->count--;
            return;
        }
}

/* pins are neighbours when they share a moving body; `body` (2 npin), `ground` the body that does
   not couple */
static fw_status joint_graph(fw_arena *arena, int npin, const int *body, int ground, set *graph) {
    set *pins_of;
    FW_NEED(pins_of = fw_arena_array(arena, set, (size_t)ground + 1));
    for (int i = 0; i < 2 * npin; i++)
        if (body[i] != ground) FW_TRY(insert(arena, &pins_of[body[i]], i / 2));
    for (int b = 0; b < ground; b++)
        for (int i = 0; i < pins_of[b].count; i++)
            for (int j = 0; j < pins_of[b].count; j++)
                if (i != j) FW_TRY(insert(arena, &graph[pins_of[b].item[i]], pins_of[b].item[j]));
    return FW_OK;
}

/* ---- a heap of candidates ---- */

typedef struct candidate { /* out of date when its pin is done or has another degree or level */
    int degree, level, pin;
} candidate;

typedef struct heap {
    candidate *item;
    int count, capacity;
} heap;

static bool before(candidate a, candidate b) {
    if (a.degree != b.degree) return a.degree < b.degree;
    return a.level != b.level ? a.level < b.level : a.pin < b.pin;
}

static fw_status push(fw_arena *arena, heap *h, candidate c) {
    if (h->count == h->capacity) {
        int more = h->capacity ? 2 * h->capacity : 64;
        candidate *item =
            fw_arena_grow(arena, h->item, (size_t)h->count, (size_t)more, sizeof *item);
        FW_NEED(item);
        h->item = item;
        h->capacity = more;
    }
    int at = h->count++;
    for (; at > 0 && before(c, h->item[(at - 1) / 2]); at = (at - 1) / 2)
        h->item[at] = h->item[(at - 1) / 2];
    h->item[at] = c;
    return FW_OK;
}

static candidate pop(heap *h) {
    candidate top = h->item[0], last = h->item[--h->count];
    int at = 0;
    for (int child; (child = 2 * at + 1) < h->count; at = child) {
        if (child + 1 < h->count && before(h->item[child + 1], h->item[child])) child++;
        if (!before(h->item[child], last)) break;
        h->item[at] = h->item[child];
    }
    h->item[at] = last;
    return top;
}

/* ---- order ---- */

/* minimum degree; among equals the one whose subtree is lowest, so that a chain is eliminated from
   both ends at once (half the dependent inversions); then the lowest index. Chains and rings have
   no fill beyond one block per pin. Inputs the joint graph; output order (n). Cost O(n log n) for
   bounded degrees, once per topology. Test: test_block_chain.c. */
fw_status fw_multibody_topology_order(fw_arena *arena, int n, const int *body, int ground,
                                      int *order) {
    set *graph;
    int *level;
    char *done;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(graph = fw_arena_array(arena, set, (size_t)n));
    FW_NEED(level = fw_arena_array(arena, int, (size_t)n));
    FW_NEED(done = fw_arena_array(arena, char, (size_t)n));
    FW_TRY(joint_graph(arena, n, body, ground, graph));
    heap h = {0};
    for (int i = 0; i < n; i++)
        FW_TRY(push(arena, &h, (candidate){graph[i].count, 0, i}));
    for (int k = 0; k < n;) {
        candidate c = pop(&h); /* of every pin that is not done, one is up to date */
        int best = c.pin;
        if (done[best] || c.degree != graph[best].count || c.level != level[best]) continue;
        done[best] = 1;
        order[k++] = best;
        const set *around = &graph[best];
        for (int i = 0; i < around->count; i++) {
            int p = around->item[i];
            erase(&graph[p], best);
            if (level[p] <= level[best]) level[p] = level[best] + 1;
            for (int j = 0; j < around->count; j++)
                if (j != i) FW_TRY(insert(arena, &graph[p], around->item[j]));
            FW_TRY(push(arena, &h, (candidate){graph[p].count, level[p], p}));
        }
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* fill-in of the elimination in the given order: below[k] = rows of column k */
static fw_status fill_in(fw_arena *arena, int npin, const set *graph, set *below) {
    for (int k = 0; k < npin; k++)
        for (int i = 0; i < graph[k].count; i++)
            if (graph[k].item[i] > k) FW_TRY(insert(arena, &below[k], graph[k].item[i]));
    for (int k = 0; k < npin; k++) /* the rows of a column reach the column of the first of them */
        for (int i = 1; i < below[k].count; i++)
            FW_TRY(insert(arena, &below[below[k].item[0]], below[k].item[i]));
    return FW_OK;
}

static int find_block(const fw_multibody_chain *c, int column, int row) {
    for (int e = c->column[column]; e < c->column[column + 1]; e++)
        if (c->row[e] == row) return e;
    return -1;
}

static fw_status couplings(fw_arena *arena, fw_multibody_model *m) {
    fw_multibody_chain *c = &m->chain;
    set *arms_of;
    FW_NEED(arms_of = fw_arena_array(arena, set, (size_t)m->nbody + 1));
    int count = 0;
    for (int i = 0; i < 2 * m->nblock; i++)
        if (m->body[i] != m->nbody) {
            count += arms_of[m->body[i]].count;
            FW_TRY(insert(arena, &arms_of[m->body[i]], i));
        }
    FW_NEED(c->coupling = fw_arena_array(arena, fw_multibody_coupling, (size_t)count));
    for (int b = 0; b < m->nbody; b++)
        for (int j = 0; j < arms_of[b].count; j++)
            for (int i = 0; i < j; i++) {
                int row = arms_of[b].item[j], column = arms_of[b].item[i]; /* row > column */
                int block = find_block(c, column / 2, row / 2);
                double sign = row % 2 == column % 2 ? 1 : -1;
                c->coupling[c->ncoupling++] = (fw_multibody_coupling){block, row, column, b, sign};
            }
    return FW_OK;
}

static fw_status updates(fw_arena *arena, fw_multibody_chain *c) {
    size_t count = 0;
    for (int k = 0; k < c->pins; k++) {
        size_t rows = (size_t)(c->column[k + 1] - c->column[k]);
        count += rows * (rows - 1) / 2 * (rows > 0);
    }
    FW_NEED(c->first = fw_arena_array(arena, int, (size_t)c->pins + 1));
    FW_NEED(c->update = fw_arena_array(arena, fw_multibody_update, count));
    int at = 0;
    for (int k = 0; k < c->pins; k++) {
        c->first[k] = at;
        for (int j = c->column[k]; j < c->column[k + 1]; j++)
            for (int i = j + 1; i < c->column[k + 1]; i++)
                c->update[at++] = (fw_multibody_update){find_block(c, c->row[j], c->row[i]), i, j};
    }
    c->first[c->pins] = at;
    return FW_OK;
}

/* D of the proximal term: the size of a row of S that no arm has lengthened; 1 for an empty row */
static void proximal_weights(const fw_multibody_model *m, int i, double weight[2]) {
    int a = m->body[2 * i], b = m->body[2 * i + 1];
    double move = m->minv[a] + m->minv[b], turn = m->jinv[a] + m->jinv[b];
    fw_multibody_rows rows = m->block[i].rows;
    weight[0] = rows == FW_ROWS_TURN || rows == FW_ROWS_SLIDE ? turn : move;
    weight[1] = rows == FW_ROWS_PIN || rows == FW_ROWS_SLIDE ? move : 1;
}

/* the flat schedule: block columns with their fill-in, which bodies add to which block, which block
   products an elimination step needs */
fw_status fw_multibody_chain_compile(fw_arena *arena, fw_multibody_model *m) {
    fw_multibody_chain *c = &m->chain;
    size_t p = (size_t)m->nblock;
    set *graph, *below;
    FW_NEED(graph = fw_arena_array(arena, set, p));
    FW_NEED(below = fw_arena_array(arena, set, p));
    FW_TRY(joint_graph(arena, m->nblock, m->body, m->nbody, graph));
    FW_TRY(fill_in(arena, m->nblock, graph, below));
    c->pins = m->nblock;
    FW_NEED(c->column = fw_arena_array(arena, int, p + 1));
    for (int k = 0; k < c->pins; k++)
        c->column[k + 1] = c->column[k] + below[k].count;
    c->blocks = c->column[c->pins];
    FW_NEED(c->row = fw_arena_array(arena, int, (size_t)c->blocks));
    for (int k = 0; k < c->pins; k++)
        for (int i = 0; i < below[k].count; i++)
            c->row[c->column[k] + i] = below[k].item[i];
    FW_TRY(couplings(arena, m));
    FW_TRY(updates(arena, c));
    FW_NEED(c->isotropic = fw_arena_array(arena, double, 2 * p));
    for (int i = 0; i < m->nblock; i++)
        proximal_weights(m, i, c->isotropic + 2 * i);
    return FW_OK;
}
