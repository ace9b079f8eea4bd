/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A region with holes as polygons without: the sides of its border, and diagonals between vertices, of which as few
   stay as do. */
#include "base/sort.h"
#include "geometry/merge.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- sides: a list that grows, and which side follows which around what they enclose ---- */

fw_status fw_geometry_merge_add_side(fw_arena *arena, fw_geometry_merge_sides *list,
                                     fw_geometry_merge_side side) {
    if (list->n == list->capacity) {
        int more = list->capacity ? 2 * list->capacity : 256;
        FW_NEED(list->side = fw_arena_grow(arena, list->side, (size_t)list->n, (size_t)more,
                                           sizeof *list->side));
        list->capacity = more;
    }
    list->side[list->n++] = side;
    return FW_OK;
}

/* Does q come before r when a ray from o turns clockwise from the direction of `back`? None of them
   has the direction of another. */
static bool sooner(fw_geometry_point o, fw_geometry_point back, fw_geometry_point q,
                   fw_geometry_point r) {
    int64_t bq = fw_cross(o, back, q), br = fw_cross(o, back, r), qr = fw_cross(o, q, r);
    /* half a turn to the right of `back` first: there the cross product is below 0 */
    bool q_right = bq < 0, r_right = br < 0;
    if (bq == 0) q_right = false; /* straight on: behind all on the right, before all on the left */
    if (br == 0) r_right = false;
    if (q_right != r_right) return q_right;
    if (bq == 0 || br == 0) return bq == 0;
    return qr < 0;
}

static int by_ends(const void *left, const void *right) {
    const fw_geometry_merge_side *a = left, *b = right;
    int order = fw_order_wholes(fw_geometry_merge_key(a->a), fw_geometry_merge_key(b->a));
    return order ? order
                 : fw_order_wholes(fw_geometry_merge_key(a->b), fw_geometry_merge_key(b->b));
}

static int first_from(const fw_geometry_merge_sides *s, int64_t key) {
    int low = 0, high = s->n;
    while (low < high) {
        int middle = (low + high) / 2;
        if (fw_geometry_merge_key(s->side[middle].a) < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

fw_status fw_geometry_merge_follow(fw_arena *arena, fw_geometry_merge_sides *s, int **next) {
    FW_NEED(*next = fw_arena_array(arena, int, (size_t)s->n + 1));
    if (s->n > 1) qsort(s->side, (size_t)s->n, sizeof *s->side, by_ends);
    for (int i = 0; i < s->n; i++) {
        const fw_geometry_merge_side *e = &s->side[i];
        int64_t key = fw_geometry_merge_key(e->b);
        int best = -1;
        for (int k = first_from(s, key); k < s->n && fw_geometry_merge_key(s->side[k].a) == key;
             k++) {
            if (fw_geometry_merge_key(s->side[k].b) == fw_geometry_merge_key(e->a))
                continue; /* its other side */
            if (best < 0 || sooner(e->b, e->a, s->side[k].b, s->side[best].b)) best = k;
        }
        if (best < 0) return FW_INTERNAL; /* a border that ends */
        (*next)[i] = best;
    }
    return FW_OK;
}

/* ---- monotone parts ---- */

typedef struct border { /* a side, low before high */
    fw_geometry_point low, high;
    bool above;               /* the region lies above it */
    fw_geometry_point helper; /* of the space above: the last vertex met in it */
    bool merge;               /* there two lines ended, with the region behind them */
} border;

typedef struct sweep {
    fw_arena *arena;
    border *border;
    int n;
    int *active; /* (nactive) borders that the vertical meets, from below */
    int nactive;
    fw_geometry_merge_sides *sides; /* diagonals are added */
} sweep;

static int by_border(const void *left, const void *right) {
    const border *a = left, *b = right;
    int order = fw_order_wholes(fw_geometry_merge_key(a->low), fw_geometry_merge_key(b->low));
    return order ? order : fw_order_wholes(0, fw_cross(a->low, a->high, b->high));
}

static int by_key(const void *left, const void *right) {
    return fw_order_wholes(*(const int64_t *)left, *(const int64_t *)right);
}

static fw_geometry_point point_of(int64_t key) {
    int32_t y = (int32_t)(uint32_t)((uint64_t)key & 0xffffffffu);
    return (fw_geometry_point){(int32_t)((key - y) / ((int64_t)1 << 32)), y};
}

static int below(const sweep *s, fw_geometry_point p) {
    int low = 0, high = s->nactive;
    while (low < high) {
        int middle = (low + high) / 2;
        const border *l = &s->border[s->active[middle]];
        if (fw_cross(l->low, l->high, p) > 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static fw_status add_diagonal(sweep *s, fw_geometry_point a, fw_geometry_point b) {
    FW_TRY(
        fw_geometry_merge_add_side(s->arena, s->sides, (fw_geometry_merge_side){a, b, true, -1}));
    return fw_geometry_merge_add_side(s->arena, s->sides, (fw_geometry_merge_side){b, a, true, -1});
}

/* the border below a place among the active ones, where the region lies above it; else NULL */
static border *floor_at(const sweep *s, int at) {
    border *b = at > 0 ? &s->border[s->active[at - 1]] : NULL;
    return b && b->above ? b : NULL;
}

/* A vertex: borders active[at .. at + ending) end there, border[from .. to) begin. Spaces of the
   region left of it whose last vertex was a merge get a diagonal to it, and so does the space in which
   it begins; the spaces right of it have it for their last vertex. */
static fw_status vertex(sweep *s, fw_geometry_point v, int at, int ending, int from, int to) {
    for (int i = 0; i <= ending; i++) {
        border *floor = floor_at(s, at + i);
        if (!floor) continue;
        if (ending == 0 || floor->merge) FW_TRY(add_diagonal(s, v, floor->helper));
        floor->merge = false;
    }
    border *under = floor_at(s, at);
    int beginning = to - from;
    if (beginning != ending)
        memmove(s->active + at + beginning, s->active + at + ending,
                (size_t)(s->nactive - at - ending) * sizeof *s->active);
    s->nactive += beginning - ending;
    for (int i = 0; i < beginning; i++) {
        s->active[at + i] = from + i;
        s->border[from + i].helper = v;
    }
    if (!under) return FW_OK;
    under->helper = v;
    under->merge = beginning == 0;
    return FW_OK;
}

fw_status fw_geometry_merge_monotone(fw_arena *arena, fw_geometry_merge_sides *sides) {
    int n = sides->n;
    sweep s = {.arena = arena, .n = n, .sides = sides};
    if (n == 0) return FW_OK;
    int64_t *key = fw_arena_array(arena, int64_t, 2 * (size_t)n);
    s.border = fw_arena_array(arena, border, (size_t)n);
    s.active = fw_arena_array(arena, int, (size_t)n);
    FW_NEED(key && s.border && s.active ? key : NULL);
    for (int i = 0; i < n; i++) {
        fw_geometry_point a = sides->side[i].a, b = sides->side[i].b;
        key[2 * i] = fw_geometry_merge_key(a);
        key[2 * i + 1] = fw_geometry_merge_key(b);
        bool forward = key[2 * i] < key[2 * i + 1];
        s.border[i] = (border){.low = forward ? a : b, .high = forward ? b : a, .above = forward};
    }
    qsort(s.border, (size_t)n, sizeof *s.border, by_border);
    qsort(key, 2 * (size_t)n, sizeof *key, by_key);
    for (int i = 0, from = 0; i < 2 * n; i++) {
        if (i > 0 && key[i] == key[i - 1]) continue;
        fw_geometry_point v = point_of(key[i]);
        int at = below(&s, v), to = from, ending = 0;
        while (at + ending < s.nactive &&
               fw_geometry_merge_key(s.border[s.active[at + ending]].high) == key[i])
            ending++;
        while (to < n && fw_geometry_merge_key(s.border[to].low) == key[i])
            to++;
        FW_TRY(vertex(&s, v, at, ending, from, to));
        from = to;
    }
    return s.nactive == 0 ? FW_OK : FW_INTERNAL;
}

/* ---- which diagonals stay ---- */

typedef struct part { /* polygons put together */
    int vertices;
    int64_t *shared; /* (nshared) points where diagonals end, sorted */
    int nshared;
} part;

typedef struct joiner {
    fw_arena *arena;
    fw_geometry_merge_sides *sides;
    int *next, *of; /* (sides) the side behind each; the part that each bounds */
    part *part;
    int *up; /* (parts) the part that took it, or itself */
    int most;
} joiner;

static int whole(joiner *j, int p) {
    while (j->up[p] != p)
        p = j->up[p] = j->up[j->up[p]];
    return p;
}

/* the sides are sorted: fw_geometry_merge_follow has done so */
static void find_twins(fw_geometry_merge_sides *s) {
    for (int i = 0; i < s->n; i++) {
        fw_geometry_merge_side other = {.a = s->side[i].b, .b = s->side[i].a};
        if (!s->side[i].cut) continue;
        const fw_geometry_merge_side *found =
            bsearch(&other, s->side, (size_t)s->n, sizeof *s->side, by_ends);
        s->side[i].twin = found ? (int)(found - s->side) : -1;
    }
}

/* points that may be met by another part: where a diagonal ends, or the border comes by twice */
static fw_status mark_shared(joiner *j, bool **out) {
    const fw_geometry_merge_sides *s = j->sides;
    FW_NEED(*out = fw_arena_array(j->arena, bool, (size_t)s->n + 1));
    for (int i = 0; i < s->n;) {
        int64_t key = fw_geometry_merge_key(s->side[i].a);
        int end = i;
        while (end < s->n && fw_geometry_merge_key(s->side[end].a) == key)
            end++;
        for (int k = i; k < end; k++)
            (*out)[k] = end - i > 1;
        i = end;
    }
    return FW_OK;
}

static fw_status find_parts(joiner *j) {
    const fw_geometry_merge_sides *s = j->sides;
    bool *shared;
    int n = 0;
    FW_TRY(mark_shared(j, &shared));
    FW_NEED(j->of = fw_arena_array(j->arena, int, (size_t)s->n + 1));
    FW_NEED(j->part = fw_arena_array(j->arena, part, (size_t)s->n + 1));
    FW_NEED(j->up = fw_arena_array(j->arena, int, (size_t)s->n + 1));
    for (int i = 0; i < s->n; i++)
        j->of[i] = -1;
    for (int i = 0; i < s->n; i++) {
        if (j->of[i] >= 0) continue;
        part *p = &j->part[n];
        for (int k = i; j->of[k] < 0; k = j->next[k]) {
            j->of[k] = n;
            p->vertices++;
            p->nshared += shared[k];
        }
        FW_NEED(p->shared = fw_arena_array(j->arena, int64_t, (size_t)p->nshared + 1));
        p->nshared = 0;
        int k = i;
        do {
            if (shared[k]) p->shared[p->nshared++] = fw_geometry_merge_key(s->side[k].a);
            k = j->next[k];
        } while (k != i);
        qsort(p->shared, (size_t)p->nshared, sizeof *p->shared, by_key);
        j->up[n] = n;
        n++;
    }
    return FW_OK;
}

/* how many points two sorted lists have in common; stops above two */
static int common(const part *p, const part *q) {
    const part *few = p->nshared < q->nshared ? p : q, *many = few == p ? q : p;
    int n = 0;
    for (int i = 0; i < few->nshared && n <= 2; i++)
        n += bsearch(&few->shared[i], many->shared, (size_t)many->nshared, sizeof *many->shared,
                     by_key) != NULL;
    return n;
}

static fw_status take(joiner *j, int a, int b) {
    part *p = &j->part[a], *q = &j->part[b];
    int64_t *all = fw_arena_array(j->arena, int64_t, (size_t)(p->nshared + q->nshared) + 1);
    FW_NEED(all);
    int n = 0, i = 0, k = 0;
    while (i < p->nshared || k < q->nshared) {
        bool first = k == q->nshared || (i < p->nshared && p->shared[i] <= q->shared[k]);
        int64_t v = first ? p->shared[i++] : q->shared[k++];
        if (n == 0 || all[n - 1] != v) all[n++] = v;
    }
    p->shared = all;
    p->nshared = n;
    p->vertices += q->vertices - 2;
    j->up[b] = a;
    return FW_OK;
}

typedef struct diagonal {
    int side;
    double length2;
} diagonal;

static int by_length(const void *left, const void *right) { /* the longest first */
    const diagonal *a = left, *b = right;
    int order = fw_order_doubles(b->length2, a->length2);
    return order ? order : fw_order_wholes(a->side, b->side);
}

static double length2(const fw_geometry_merge_side *s) {
    double dx = (double)s->b.x_dbu - s->a.x_dbu, dy = (double)s->b.y_dbu - s->a.y_dbu;
    return dx * dx + dy * dy;
}

/* a diagonal can go where the parts on its sides have nothing else in common: then they are one
   simple polygon */
static fw_status join(joiner *j, bool *gone) {
    fw_geometry_merge_sides *s = j->sides;
    diagonal *list = fw_arena_array(j->arena, diagonal, (size_t)s->n + 1);
    FW_NEED(list);
    int n = 0;
    for (int i = 0; i < s->n; i++)
        if (s->side[i].cut && s->side[i].twin > i) list[n++] = (diagonal){i, length2(&s->side[i])};
    if (n > 1) qsort(list, (size_t)n, sizeof *list, by_length);
    for (int i = 0; i < n; i++) {
        int side = list[i].side, twin = s->side[side].twin;
        int a = whole(j, j->of[side]), b = whole(j, j->of[twin]);
        if (a == b || j->part[a].vertices + j->part[b].vertices - 2 > j->most) continue;
        if (common(&j->part[a], &j->part[b]) != 2) continue;
        gone[side] = gone[twin] = true;
        FW_TRY(j->part[a].nshared >= j->part[b].nshared ? take(j, a, b) : take(j, b, a));
    }
    return FW_OK;
}

/* ---- the polygons ---- */

/* from the vertex that comes first in the order of points, so that equal parts have equal lists */
static void turn_to_least(fw_geometry_polygon *p, fw_geometry_point *scratch) {
    int least = 0;
    for (int i = 1; i < p->count; i++)
        if (fw_geometry_merge_key(p->vertex[i]) < fw_geometry_merge_key(p->vertex[least]))
            least = i;
    memcpy(scratch, p->vertex, (size_t)p->count * sizeof *scratch);
    for (int i = 0; i < p->count; i++)
        p->vertex[i] = scratch[(least + i) % p->count];
}

static void trace(const fw_geometry_merge_sides *s, const int *next, int start, bool *done,
                  fw_geometry_polygon *p) {
    int i = start;
    p->count = 0;
    do {
        done[i] = true;
        p->vertex[p->count++] = s->side[i].a;
        i = next[i];
    } while (i != start);
}

static int by_first(const void *left, const void *right) {
    const fw_geometry_polygon *a = left, *b = right;
    int order =
        fw_order_wholes(fw_geometry_merge_key(a->vertex[0]), fw_geometry_merge_key(b->vertex[0]));
    for (int i = 1; !order && i < a->count && i < b->count; i++)
        order = fw_order_wholes(fw_geometry_merge_key(a->vertex[i]),
                                fw_geometry_merge_key(b->vertex[i]));
    return order ? order : fw_order_wholes(a->count, b->count);
}

/* from a side to a point that is not one of its ends, m */
static double away_from(const fw_geometry_merge_side *s, fw_geometry_point p) {
    double dx = (double)s->b.x_dbu - s->a.x_dbu, dy = (double)s->b.y_dbu - s->a.y_dbu;
    double px = (double)p.x_dbu - s->a.x_dbu, py = (double)p.y_dbu - s->a.y_dbu;
    double t = fmin(fmax((px * dx + py * dy) / (dx * dx + dy * dy), 0), 1);
    return 1e-9 * hypot(px - t * dx, py - t * dy);
}

/* Least distance of a cut from a vertex of a polygon that has it as an edge; every cut is an edge of two, and what
   is nearest to it lies in one of them. */
static void clear_cuts(const fw_geometry_merge_sides *s, const int *next, int start,
                       const fw_geometry_polygon *p, fw_geometry_merged *out) {
    int i = start;
    do {
        const fw_geometry_merge_side *c = &s->side[i];
        for (int k = 0; c->cut && k < p->count; k++) {
            int64_t key = fw_geometry_merge_key(p->vertex[k]);
            if (key == fw_geometry_merge_key(c->a) || key == fw_geometry_merge_key(c->b)) continue;
            out->clear_m = fmin(out->clear_m, away_from(c, p->vertex[k]));
        }
        i = next[i];
    } while (i != start);
}

static void account(const fw_geometry_merge_sides *s, fw_geometry_merged *out) {
    for (int i = 0; i < s->n; i++)
        if (s->side[i].cut &&
            fw_geometry_merge_key(s->side[i].a) < fw_geometry_merge_key(s->side[i].b)) {
            out->cuts++;
            out->cut_m += 1e-9 * sqrt(length2(&s->side[i]));
        }
    for (int i = 0; i < out->n; i++) {
        out->area2_dbu += fw_geometry_polygon_area2(&out->polygon[i]);
        out->vertices += out->polygon[i].count;
    }
}

fw_status fw_geometry_merge_parts(fw_arena *arena, fw_geometry_merge_sides *sides, int most,
                                  fw_geometry_merged *out) {
    joiner j = {.arena = arena, .sides = sides, .most = most};
    if (sides->n == 0) return FW_OK;
    FW_TRY(fw_geometry_merge_follow(arena, sides, &j.next));
    find_twins(sides);
    bool *gone = fw_arena_array(arena, bool, (size_t)sides->n + 1);
    FW_NEED(gone);
    FW_TRY(find_parts(&j));
    FW_TRY(join(&j, gone));
    fw_geometry_merge_sides left = {0};
    for (int i = 0; i < sides->n; i++)
        if (!gone[i]) FW_TRY(fw_geometry_merge_add_side(arena, &left, sides->side[i]));
    FW_TRY(fw_geometry_merge_follow(arena, &left, &j.next));
    bool *done = fw_arena_array(arena, bool, (size_t)left.n + 1);
    fw_geometry_point *vertex = fw_arena_array(arena, fw_geometry_point, (size_t)left.n + 1);
    fw_geometry_point *scratch = fw_arena_array(arena, fw_geometry_point, (size_t)left.n + 1);
    out->polygon = fw_arena_array(arena, fw_geometry_polygon, (size_t)left.n + 1);
    FW_NEED(done && vertex && scratch && out->polygon ? done : NULL);
    for (int i = 0; i < left.n; i++) {
        if (done[i]) continue;
        fw_geometry_polygon *p = &out->polygon[out->n++];
        p->vertex = vertex;
        trace(&left, j.next, i, done, p);
        clear_cuts(&left, j.next, i, p, out);
        turn_to_least(p, scratch);
        vertex += p->count;
    }
    qsort(out->polygon, (size_t)out->n, sizeof *out->polygon, by_first);
    account(&left, out);
    return FW_OK;
}
