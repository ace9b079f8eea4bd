/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/multibody_scratch.h"
#include <stdbool.h>
#include <string.h>

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
