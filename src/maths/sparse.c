/* SPDX-License-Identifier: GPL-3.0-or-later */
/* P A P^T = L D L^T of a large symmetric indefinite matrix by fronts.

   The order is that of sparse_order.c. A front is the dense matrix of what is eliminated together with all that it touches; what is left of it waits for the
   next front that has any of that. Pivots are 1 x 1 or 2 x 2 among the unknowns that no later entry
   can change, with growth bounded by 1/u,

     |d| >= u max |column|   or   |D^-1| (max |column i|, max |column j|)^T <= 1/u,   u = 0.05

   and what finds no such pivot waits with the rest. At the root such a pivot exists for all that is not
   nothing. Unknowns are scaled by the caller. Error: that of a backward stable elimination, about n eps
   of the largest entry, once refined. Cost: of a chain in proportion to n; of a square grid n^1.5 and,
   memory, n log n. Sources: I. S. Duff and J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302 (fronts);
   I. S. Duff and J. K. Reid, AERE R-10533 (1982) (pivots with a threshold). Test: test_sparse.c. */
#include "maths/matrix.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_threshold = 0.05;

typedef struct growing { /* of numbers: grows in the arena, by doubling */
    double *at;
    size_t count, room;
} growing;

typedef struct growing_ints {
    int *at;
    size_t count, room;
} growing_ints;

typedef struct front {    /* what a group left in the factor */
    int pivots, size;     /* unknowns eliminated, and all of the front */
    size_t index, number; /* where its indices and numbers begin */
} front;

typedef struct waiting { /* what is left of a front */
    int size, delayed;   /* the delayed ones stand first */
    size_t index, number;
} waiting;

struct fw_maths_sparse {
    fw_arena *arena;
    int n, groups;
    int *group;               /* (groups) in order */
    int *children;            /* (groups) in that order: fronts that wait for it */
    int *own, *first_own;     /* (n) unknowns of each place in the order, (groups + 1) */
    int *place;               /* (n) of each unknown in the order */
    growing_ints row, column; /* of entries */
    growing value;
    int *entry, *first_entry; /* of each place */
    size_t entry_room;
    front *front;       /* (groups) */
    growing_ints index; /* of fronts: pivots first */
    growing number;     /* per front: D (2 pivots), then rows of L (pivots x size) */
    unsigned char *two; /* (n) by place of pivot: 1: first of two, 2: second, 3: nothing */
    int *pivot_at;      /* (groups) first pivot of each front in `two` */
    growing_ints left_index;
    growing left;  /* what waits, the last on top */
    waiting *wait; /* (groups) */
    int waits;
    growing dense;     /* the front at work */
    int *where, *here; /* (n) place in the front at work or FW_MATHS_NONE; its unknowns */
    bool short_of_memory;
};

/* ---- memory ---- */

/* for `add` items beside `count`: at, or a copy in twice the room; NULL: there is no memory */
static void *with_room(fw_maths_sparse *s, void *at, size_t count, size_t *room, size_t add,
                       size_t size) {
    if (count + add <= *room) return at;
    void *to = fw_arena_grow(s->arena, at, count, 2 * (count + add), size);
    if (to)
        *room = 2 * (count + add);
    else
        s->short_of_memory = true;
    return to;
}

static bool more(fw_maths_sparse *s, growing *g, size_t add) {
    double *to = with_room(s, g->at, g->count, &g->room, add, sizeof *to);
    if (to) g->at = to;
    return to || add == 0;
}

static bool more_ints(fw_maths_sparse *s, growing_ints *g, size_t add) {
    int *to = with_room(s, g->at, g->count, &g->room, add, sizeof *to);
    if (to) g->at = to;
    return to || add == 0;
}

/* ---- a new one ---- */

/* unknowns by the place of their group */
static void take_unknowns(fw_maths_sparse *s, const fw_maths_sparse_shape *shape,
                          const int *place) {
    for (int i = 0; i < s->n; i++) {
        int at = place[shape->first[i]], other = shape->second[i];
        if (other != FW_MATHS_NONE && place[other] < at) at = place[other];
        s->place[i] = at;
        s->first_own[at + 1]++;
    }
    for (int k = 0; k < s->groups; k++)
        s->first_own[k + 1] += s->first_own[k];
    for (int i = s->n - 1; i >= 0; i--) /* from behind, so that first_own moves back to the begin */
        s->own[--s->first_own[s->place[i] + 1]] = i;
    for (int k = 0; k < s->groups; k++)
        s->first_own[k] = s->first_own[k + 1];
    s->first_own[s->groups] = s->n;
}

fw_status fw_maths_sparse_new(fw_arena *arena, const fw_maths_sparse_shape *shape,
                              fw_maths_sparse **out) {
    fw_maths_sparse *s;
    size_t n = (size_t)shape->n, groups = (size_t)shape->groups;
    FW_NEED(s = fw_arena_one(arena, fw_maths_sparse));
    s->arena = arena, s->n = shape->n, s->groups = shape->groups;
    int **of_groups[] = {&s->group, &s->children, &s->pivot_at};
    int **of_unknowns[] = {&s->own, &s->place, &s->where, &s->here};
    for (size_t i = 0; i < sizeof of_groups / sizeof of_groups[0]; i++)
        FW_NEED(*of_groups[i] = fw_arena_array(arena, int, groups));
    for (size_t i = 0; i < sizeof of_unknowns / sizeof of_unknowns[0]; i++)
        FW_NEED(*of_unknowns[i] = fw_arena_array(arena, int, n));
    FW_NEED(s->first_own = fw_arena_array(arena, int, groups + 2));
    FW_NEED(s->first_entry = fw_arena_array(arena, int, groups + 2));
    FW_NEED(s->front = fw_arena_array(arena, front, groups));
    FW_NEED(s->wait = fw_arena_array(arena, waiting, groups));
    FW_NEED(s->two = fw_arena_array(arena, unsigned char, n));
    for (int i = 0; i < s->n; i++)
        s->where[i] = FW_MATHS_NONE;
    int *place;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(place = fw_arena_array(arena, int, groups));
    FW_TRY(fw_maths_sparse_order(arena, shape, s->group, s->children, place));
    take_unknowns(s, shape, place);
    fw_arena_rewind(arena, mark);
    *out = s;
    return FW_OK;
}

/* ---- entries ---- */

void fw_maths_sparse_clear(fw_maths_sparse *s) {
    s->row.count = s->column.count = s->value.count = 0;
}

void fw_maths_sparse_add(fw_maths_sparse *s, int i, int j, double value) {
    if (!more_ints(s, &s->row, 1) || !more_ints(s, &s->column, 1) || !more(s, &s->value, 1)) return;
    s->row.at[s->row.count++] = i;
    s->column.at[s->column.count++] = j;
    s->value.at[s->value.count++] = value;
}

void fw_maths_sparse_product(const fw_maths_sparse *s, const double *x, double *y) {
    memset(y, 0, (size_t)s->n * sizeof *y);
    for (size_t k = 0; k < s->value.count; k++) {
        int i = s->row.at[k], j = s->column.at[k];
        y[i] += s->value.at[k] * x[j];
        if (i != j) y[j] += s->value.at[k] * x[i];
    }
}

/* entries by the place where the first of their unknowns is eliminated */
static bool sort_entries(fw_maths_sparse *s) {
    size_t count = s->value.count;
    if (count > s->entry_room) {
        s->entry = fw_arena_raw(s->arena, count * sizeof *s->entry);
        if (!s->entry) return false;
        s->entry_room = count;
    }
    int *first = s->first_entry;
    memset(first, 0, ((size_t)s->groups + 2) * sizeof *first);
    for (size_t k = 0; k < count; k++) {
        int a = s->place[s->row.at[k]], b = s->place[s->column.at[k]];
        first[(a < b ? a : b) + 2]++;
    }
    for (int k = 2; k <= s->groups + 1; k++)
        first[k] += first[k - 1];
    for (size_t k = 0; k < count; k++) {
        int a = s->place[s->row.at[k]], b = s->place[s->column.at[k]];
        s->entry[first[(a < b ? a : b) + 1]++] = (int)k;
    }
    return true;
}

/* ---- one front ---- */

static void take(fw_maths_sparse *s, int unknown, int *size) {
    if (s->where[unknown] != FW_MATHS_NONE) return;
    s->where[unknown] = *size;
    s->here[(*size)++] = unknown;
}

/* unknowns of the front at place k: those that can be pivots first. Returns the size */
static int gather(fw_maths_sparse *s, int k, int *can) {
    int size = 0, below = s->waits - s->children[k];
    for (int i = s->first_own[k]; i < s->first_own[k + 1]; i++)
        take(s, s->own[i], &size);
    for (int c = below; c < s->waits; c++)
        for (int i = 0; i < s->wait[c].delayed; i++)
            take(s, s->left_index.at[s->wait[c].index + (size_t)i], &size);
    *can = size;
    for (int c = below; c < s->waits; c++)
        for (int i = s->wait[c].delayed; i < s->wait[c].size; i++)
            take(s, s->left_index.at[s->wait[c].index + (size_t)i], &size);
    for (int e = s->first_entry[k]; e < s->first_entry[k + 1]; e++) {
        take(s, s->row.at[s->entry[e]], &size);
        take(s, s->column.at[s->entry[e]], &size);
    }
    return size;
}

static bool assemble(fw_maths_sparse *s, int k, int size) {
    size_t n = (size_t)size;
    s->dense.count = 0;
    if (!more(s, &s->dense, n * n)) return false;
    double *f = s->dense.at;
    memset(f, 0, n * n * sizeof *f);
    for (int e = s->first_entry[k]; e < s->first_entry[k + 1]; e++) {
        int at = s->entry[e];
        size_t i = (size_t)s->where[s->row.at[at]], j = (size_t)s->where[s->column.at[at]];
        f[i * n + j] += s->value.at[at];
        if (i != j) f[j * n + i] += s->value.at[at];
    }
    for (int below = s->waits - s->children[k]; s->waits > below; s->waits--) {
        const waiting *w = &s->wait[s->waits - 1];
        if (w->size == 0) continue; /* there may be no room yet to point into */
        const int *index = s->left_index.at + w->index;
        const double *from = s->left.at + w->number;
        for (int i = 0; i < w->size; i++) {
            double *row = f + (size_t)s->where[index[i]] * n;
            for (int j = 0; j < w->size; j++)
                row[s->where[index[j]]] += *from++;
        }
        s->left_index.count = w->index, s->left.count = w->number;
    }
    return true;
}

/* unknowns a and b of the front change places: in the matrix, and in the `done` rows of L */
static void exchange(double *f, int *here, size_t n, double *l, size_t done, size_t a, size_t b) {
    if (a == b) return;
    int keep = here[a];
    here[a] = here[b], here[b] = keep;
    for (size_t j = 0; j < n; j++) {
        double x = f[a * n + j];
        f[a * n + j] = f[b * n + j], f[b * n + j] = x;
    }
    for (size_t i = 0; i < n; i++) {
        double x = f[i * n + a];
        f[i * n + a] = f[i * n + b], f[i * n + b] = x;
    }
    for (size_t k = 0; k < done; k++) {
        double x = l[k * n + a];
        l[k * n + a] = l[k * n + b], l[k * n + b] = x;
    }
}

/* largest entry of row i from column k on, off the diagonal and but for column `but` */
static double largest(const double *f, size_t n, size_t i, size_t k, size_t but) {
    double most = 0;
    for (size_t j = k; j < n; j++)
        if (j != i && j != but) most = fmax(most, fabs(f[i * n + j]));
    return most;
}

enum { NOT = 0, ONE, TWO, NOTHING };

/* is there a pivot with unknown i at step k? *with: the second one of two */
static int pivot_with(const double *f, size_t n, size_t i, size_t k, size_t can, double nothing,
                      size_t *with) {
    const double d = fabs(f[i * n + i]), all = largest(f, n, i, k, i);
    if (d <= nothing && all <= nothing) return NOTHING;
    if (d > nothing && d >= fw_threshold * all) return ONE;
    double most = 0;
    for (size_t j = k; j < can; j++)
        if (j != i && fabs(f[i * n + j]) > most) most = fabs(f[i * n + j]), *with = j;
    if (!(most > nothing)) return NOT;
    const size_t r = *with;
    const double a = f[i * n + i], b = f[i * n + r], c = f[r * n + r], det = fabs(a * c - b * b);
    const double of_i = largest(f, n, i, k, r), of_r = largest(f, n, r, k, i);
    const bool stable =
        fmax(fabs(c) * of_i + fabs(b) * of_r, fabs(b) * of_i + fabs(a) * of_r) * fw_threshold <=
        det;
    return stable && det > nothing * fabs(b) ? TWO : NOT;
}

/* rows below lose what the pivot row(s) k stand for; L goes to `l` */
static void eliminate_one(double *f, size_t n, size_t k, double *l) {
    const double *pivot = f + k * n;
    for (size_t i = k + 1; i < n; i++) {
        double x = l[i] = pivot[i] / pivot[k], *row = f + i * n;
        if (x == 0) continue;
        for (size_t j = k + 1; j < n; j++)
            row[j] -= x * pivot[j];
    }
}

static void eliminate_two(double *f, size_t n, size_t k, double *l, double *m) {
    const double *p = f + k * n, *q = p + n, a = p[k], b = p[k + 1], c = q[k + 1];
    const double det = a * c - b * b;
    for (size_t i = k + 2; i < n; i++) {
        double x = l[i] = (c * p[i] - b * q[i]) / det, y = m[i] = (a * q[i] - b * p[i]) / det;
        double *row = f + i * n;
        if (x == 0 && y == 0) continue;
        for (size_t j = k + 2; j < n; j++)
            row[j] -= x * p[j] + y * q[j];
    }
}

static void count_one(double d, fw_maths_sparse_signs *signs) {
    if (d < 0) signs->negative++;
}

static void count_two(double a, double b, double c, fw_maths_sparse_signs *signs) {
    if (a * c - b * b < 0)
        signs->negative++;
    else if (a + c < 0)
        signs->negative += 2;
}

/* as many pivots as can be had; they stand first then */
static size_t pivots_of(fw_maths_sparse *s, int place, size_t n, size_t can, double nothing,
                        fw_maths_sparse_signs *signs) {
    double *f = s->dense.at, *numbers = s->number.at + s->front[place].number;
    unsigned char *two = s->two + s->pivot_at[place];
    size_t k = 0;
    while (k < can) {
        size_t i = k, with = k;
        int kind = NOT;
        for (; i < can; i++)
            if ((kind = pivot_with(f, n, i, k, can, nothing, &with)) != NOT) break;
        if (kind == NOT) break;
        double *all = numbers + 2 * can, *l = all + k * n;
        exchange(f, s->here, n, all, k, k, i);
        if (kind == TWO) {
            exchange(f, s->here, n, all, k, k + 1, with == k ? i : with);
            eliminate_two(f, n, k, l, l + n);
            const double a = f[k * n + k], b = f[k * n + k + 1], c = f[(k + 1) * n + k + 1];
            numbers[2 * k] = a, numbers[2 * k + 1] = b, numbers[2 * k + 2] = c;
            count_two(a, b, c, signs);
            two[k] = 1, two[k + 1] = 2;
            k += 2;
            continue;
        }
        if (kind == ONE) eliminate_one(f, n, k, l), count_one(f[k * n + k], signs);
        if (kind == NOTHING) memset(l, 0, n * sizeof *l), signs->nothing++;
        numbers[2 * k] = f[k * n + k];
        two[k] = kind == NOTHING ? 3 : 0;
        k++;
    }
    return k;
}

/* what is left of the front waits, be it nothing: its parent counts on it */
static bool leave(fw_maths_sparse *s, size_t n, size_t pivots, size_t can) {
    const size_t size = n - pivots;
    waiting *w = &s->wait[s->waits++];
    if (!more_ints(s, &s->left_index, size) || !more(s, &s->left, size * size)) return false;
    *w = (waiting){.size = (int)size,
                   .delayed = (int)(can - pivots),
                   .index = s->left_index.count,
                   .number = s->left.count};
    for (size_t i = 0; i < size; i++) {
        s->left_index.at[s->left_index.count++] = s->here[pivots + i];
        memcpy(s->left.at + s->left.count, s->dense.at + (pivots + i) * n + pivots,
               size * sizeof(double));
        s->left.count += size;
    }
    return true;
}

static bool one_front(fw_maths_sparse *s, int k, double nothing, fw_maths_sparse_signs *signs) {
    int can, size = gather(s, k, &can);
    const size_t n = (size_t)size;
    front *f = &s->front[k];
    *f = (front){.size = size, .index = s->index.count, .number = s->number.count};
    if (!assemble(s, k, size) || !more_ints(s, &s->index, n) ||
        !more(s, &s->number, (size_t)can * (n + 2)))
        return false;
    const size_t pivots = pivots_of(s, k, n, (size_t)can, nothing, signs);
    f->pivots = (int)pivots;
    if (k + 1 < s->groups) s->pivot_at[k + 1] = s->pivot_at[k] + f->pivots;
    memcpy(s->index.at + f->index, s->here, n * sizeof(int));
    s->index.count += n;
    /* rows of L stand behind 2 `can` numbers of D: with fewer pivots they move up */
    double *numbers = s->number.at + f->number;
    if ((int)pivots < can)
        memmove(numbers + 2 * pivots, numbers + 2 * (size_t)can, pivots * n * sizeof *numbers);
    s->number.count += pivots * (n + 2);
    for (size_t i = 0; i < n; i++)
        s->where[s->here[i]] = FW_MATHS_NONE;
    return leave(s, n, pivots, (size_t)can);
}

static bool finite_entries(const fw_maths_sparse *s) {
    for (size_t k = 0; k < s->value.count; k++)
        if (!isfinite(s->value.at[k])) return false;
    return true;
}

fw_status fw_maths_sparse_factor(fw_maths_sparse *s, double nothing, fw_maths_sparse_signs *signs) {
    *signs = (fw_maths_sparse_signs){0};
    if (s->short_of_memory || !sort_entries(s)) return FW_NOMEM;
    if (!finite_entries(s)) return FW_SOLVER;
    s->index.count = s->number.count = s->left.count = s->left_index.count = 0;
    s->waits = 0;
    s->pivot_at[0] = 0;
    for (int k = 0; k < s->groups; k++) {
        if (k % 64 == 0 && fw_arena_cancelled(s->arena)) return FW_CANCELLED;
        if (!one_front(s, k, nothing, signs)) return FW_NOMEM;
    }
    return FW_OK;
}

int fw_maths_sparse_nothing(const fw_maths_sparse *s, int from) {
    int best = FW_MATHS_NONE;
    for (int k = 0; k < s->groups; k++)
        for (int i = 0; i < s->front[k].pivots; i++) {
            int unknown = s->index.at[s->front[k].index + (size_t)i];
            if (s->two[s->pivot_at[k] + i] != 3 || unknown < from) continue;
            if (best == FW_MATHS_NONE || unknown < best) best = unknown;
        }
    return best;
}

/* ---- solving ---- */

static void forward(const fw_maths_sparse *s, double *x) {
    for (int k = 0; k < s->groups; k++) {
        const front *f = &s->front[k];
        const int *index = s->index.at + f->index;
        const double *l = s->number.at + f->number + 2 * f->pivots;
        const unsigned char *two = s->two + s->pivot_at[k];
        for (int p = 0; p < f->pivots; p++, l += f->size) {
            const double by = x[index[p]];
            for (int i = p + (two[p] == 1 ? 2 : 1); by != 0 && i < f->size; i++)
                x[index[i]] -= l[i] * by;
        }
    }
}

static void divide(const fw_maths_sparse *s, double *x) {
    for (int k = 0; k < s->groups; k++) {
        const front *f = &s->front[k];
        const int *index = s->index.at + f->index;
        const double *d = s->number.at + f->number;
        const unsigned char *two = s->two + s->pivot_at[k];
        for (int p = 0; p < f->pivots; p++) {
            double *to = &x[index[p]];
            if (two[p] == 1) {
                const double a = d[2 * p], b = d[2 * p + 1], c = d[2 * p + 2], det = a * c - b * b;
                double *other = &x[index[p + 1]], y = *to, z = *other;
                *to = (c * y - b * z) / det, *other = (a * z - b * y) / det;
            } else if (two[p] == 3)
                *to = 0;
            else if (two[p] == 0)
                *to /= d[2 * p];
        }
    }
}

static void backward(const fw_maths_sparse *s, double *x) {
    for (int k = s->groups - 1; k >= 0; k--) {
        const front *f = &s->front[k];
        const int *index = s->index.at + f->index;
        const double *all = s->number.at + f->number + 2 * f->pivots;
        const unsigned char *two = s->two + s->pivot_at[k];
        for (int p = f->pivots - 1; p >= 0; p--) {
            const double *l = all + (size_t)p * (size_t)f->size;
            double sum = x[index[p]];
            for (int i = p + (two[p] == 1 ? 2 : 1); i < f->size; i++)
                sum -= l[i] * x[index[i]];
            x[index[p]] = two[p] == 3 ? 0 : sum;
        }
    }
}

void fw_maths_sparse_solve(const fw_maths_sparse *s, double *x, double *work) {
    double *right = work, *rest = work + s->n;
    const size_t bytes = (size_t)s->n * sizeof *x;
    memcpy(right, x, bytes);
    forward(s, x), divide(s, x), backward(s, x);
    fw_maths_sparse_product(s, x, rest);
    for (int i = 0; i < s->n; i++)
        rest[i] = right[i] - rest[i];
    forward(s, rest), divide(s, rest), backward(s, rest);
    for (int i = 0; i < s->n; i++)
        x[i] += rest[i];
}
