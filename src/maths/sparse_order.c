/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In which order the groups of a sparse matrix are eliminated: the one that has the fewest neighbours next,
   counted exactly on the quotient graph (a group that is gone stays as the set of those that it couples), and
   then as a tree whose branches come one after the other. Cost: of a chain in proportion to its length, of a grid
   some hundred steps a group. Source: A. George and J. W. H. Liu, SIAM Review 31 (1989) 1. Test: test_sparse.c
   (what a chain and a grid fill). */
#include "maths/matrix.h"
#include <stdbool.h>

typedef struct set {
    int *at, count;
} set;

typedef struct ordering {
    fw_arena *arena;
    int n;
    set *beside, *element, *member; /* (n) neighbours, elements around it; members of an element */
    int *room;                      /* (n) of `element` */
    int *degree, *stamp, now;
    int *bucket, *next, *before; /* (n) by degree: lists in both directions */
    bool *gone;
    int *parent, *order;
} ordering;

static void unlink_node(ordering *o, int i) {
    if (o->before[i] != FW_MATHS_NONE)
        o->next[o->before[i]] = o->next[i];
    else
        o->bucket[o->degree[i]] = o->next[i];
    if (o->next[i] != FW_MATHS_NONE) o->before[o->next[i]] = o->before[i];
}

static void link_node(ordering *o, int i) {
    int *head = &o->bucket[o->degree[i]];
    o->before[i] = FW_MATHS_NONE, o->next[i] = *head;
    if (*head != FW_MATHS_NONE) o->before[*head] = i;
    *head = i;
}

/* neighbours of every group, each once */
static fw_status neighbours(ordering *o, const fw_maths_sparse_shape *shape) {
    int *count;
    FW_NEED(count = fw_arena_array(o->arena, int, (size_t)o->n));
    for (int k = 0; k < 2 * shape->couplings; k++)
        count[shape->coupled[k]]++;
    for (int i = 0; i < o->n; i++)
        FW_NEED(o->beside[i].at = fw_arena_array(o->arena, int, (size_t)count[i]));
    for (int k = 0; k < shape->couplings; k++) {
        int a = shape->coupled[2 * k], b = shape->coupled[2 * k + 1];
        if (a == b) continue;
        o->beside[a].at[o->beside[a].count++] = b;
        o->beside[b].at[o->beside[b].count++] = a;
    }
    for (int i = 0; i < o->n; i++) {
        set *x = &o->beside[i];
        int kept = 0;
        o->now++;
        for (int k = 0; k < x->count; k++)
            if (o->stamp[x->at[k]] != o->now) o->stamp[x->at[kept++] = x->at[k]] = o->now;
        x->count = o->degree[i] = kept;
        link_node(o, i);
    }
    return FW_OK;
}

/* the element that p becomes; the elements around it end in it */
static fw_status become_element(ordering *o, int p) {
    set *to = &o->member[p];
    size_t most = (size_t)o->beside[p].count;
    for (int k = 0; k < o->element[p].count; k++)
        most += (size_t)o->member[o->element[p].at[k]].count;
    FW_NEED(to->at = fw_arena_array(o->arena, int, most));
    o->stamp[p] = ++o->now;
    for (int k = -1; k < o->element[p].count; k++) {
        const set *from = k < 0 ? &o->beside[p] : &o->member[o->element[p].at[k]];
        for (int i = 0; i < from->count; i++) {
            int v = from->at[i];
            if (o->gone[v] || o->stamp[v] == o->now) continue;
            o->stamp[v] = o->now;
            to->at[to->count++] = v;
        }
        if (k >= 0) o->parent[o->element[p].at[k]] = p;
    }
    return FW_OK;
}

/* i lies in the new element p: what that has already is no neighbour of its own */
static fw_status join_element(ordering *o, int i, int p) {
    set *x = &o->beside[i], *e = &o->element[i];
    int kept = 0, left = 0;
    for (int k = 0; k < x->count; k++)
        if (!o->gone[x->at[k]] && o->stamp[x->at[k]] != o->now) x->at[kept++] = x->at[k];
    x->count = kept;
    for (int k = 0; k < e->count; k++)
        if (o->parent[e->at[k]] == FW_MATHS_NONE) e->at[left++] = e->at[k];
    e->count = left;
    if (e->count == o->room[i]) {
        int *grown = fw_arena_grow(o->arena, e->at, (size_t)e->count, 2 * (size_t)e->count + 2,
                                   sizeof *grown);
        FW_NEED(grown);
        e->at = grown, o->room[i] = 2 * e->count + 2;
    }
    e->at[e->count++] = p;
    return FW_OK;
}

static int degree_of(ordering *o, int i) {
    int degree = 0;
    o->stamp[i] = ++o->now;
    for (int k = -1; k < o->element[i].count; k++) {
        const set *from = k < 0 ? &o->beside[i] : &o->member[o->element[i].at[k]];
        for (int l = 0; l < from->count; l++) {
            int v = from->at[l];
            if (o->gone[v] || o->stamp[v] == o->now) continue;
            o->stamp[v] = o->now;
            degree++;
        }
    }
    return degree;
}

static fw_status eliminate_all(ordering *o) {
    for (int k = 0, least = 0; k < o->n; k++) {
        while (o->bucket[least] == FW_MATHS_NONE)
            least++;
        int p = o->bucket[least];
        unlink_node(o, p);
        FW_TRY(become_element(o, p));
        o->gone[p] = true;
        o->order[k] = p;
        for (int i = 0; i < o->member[p].count; i++)
            FW_TRY(join_element(o, o->member[p].at[i], p));
        for (int i = 0; i < o->member[p].count; i++) {
            int v = o->member[p].at[i];
            unlink_node(o, v);
            o->degree[v] = degree_of(o, v);
            link_node(o, v);
            if (o->degree[v] < least) least = o->degree[v];
        }
    }
    return FW_OK;
}

/* children before parents, one subtree after the other: fronts then wait as on a stack */
static void postorder(const ordering *o, int *head, int *next, int *stack, int *group,
                      int *children) {
    int done = 0, depth;
    for (int i = 0; i < o->n; i++)
        head[i] = FW_MATHS_NONE;
    for (int k = o->n - 1; k >= 0; k--) {
        int v = o->order[k], parent = o->parent[v];
        if (parent != FW_MATHS_NONE) next[v] = head[parent], head[parent] = v;
    }
    for (int k = 0; k < o->n; k++) {
        if (o->parent[o->order[k]] != FW_MATHS_NONE) continue;
        stack[0] = o->order[k], depth = 1;
        while (depth > 0) {
            int v = stack[depth - 1], child = head[v];
            if (child != FW_MATHS_NONE) {
                head[v] = next[child];
                stack[depth++] = child;
                continue;
            }
            group[done++] = v, depth--;
        }
    }
    for (int i = 0; i < o->n; i++)
        head[group[i]] = i; /* now: the place of a group */
    for (int i = 0; i < o->n; i++)
        if (o->parent[i] != FW_MATHS_NONE) children[head[o->parent[i]]]++;
}

static fw_status order_new(fw_arena *arena, int n, ordering *o) {
    *o = (ordering){.arena = arena, .n = n};
    size_t size = (size_t)n + 1;
    set **sets[] = {&o->beside, &o->element, &o->member};
    int **ints[] = {&o->room, &o->degree, &o->stamp,  &o->bucket,
                    &o->next, &o->before, &o->parent, &o->order};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++)
        FW_NEED(*sets[i] = fw_arena_array(arena, set, size));
    for (size_t i = 0; i < sizeof ints / sizeof ints[0]; i++)
        FW_NEED(*ints[i] = fw_arena_array(arena, int, size));
    FW_NEED(o->gone = fw_arena_array(arena, bool, size));
    for (int i = 0; i <= n; i++)
        o->bucket[i] = o->parent[i] = FW_MATHS_NONE;
    return FW_OK;
}

fw_status fw_maths_sparse_order(fw_arena *arena, const fw_maths_sparse_shape *shape, int *group,
                                int *children, int *place) {
    ordering o;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(order_new(arena, shape->groups, &o));
    FW_TRY(neighbours(&o, shape));
    FW_TRY(eliminate_all(&o));
    postorder(&o, o.bucket, o.next, o.stamp, group, children);
    for (int i = 0; i < o.n; i++)
        place[i] = o.bucket[i];
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
