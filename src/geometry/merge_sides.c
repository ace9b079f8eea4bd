/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sides of borders: a list that grows, and which side follows which around what they enclose. */
#include "geometry/merge.h"
#include "base/sort.h"
#include <stdlib.h>

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

static int by_start(const void *left, const void *right) {
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
    if (s->n > 1) qsort(s->side, (size_t)s->n, sizeof *s->side, by_start);
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
