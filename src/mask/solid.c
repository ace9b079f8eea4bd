/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/solid.h"
#include "base/sort.h"
#include <stdlib.h>

static const double UNKNOWN_M = 1e-6; /* where nobody said how thick the device is */

typedef struct side { /* an edge of a polygon, from its smaller end */
    fw_geometry_point low, high;
    int layer, piece, edge;
    bool forward; /* the polygon runs from low to high */
} side;

static int by_point(fw_geometry_point p, fw_geometry_point q) {
    if (p.x_dbu != q.x_dbu) return p.x_dbu < q.x_dbu ? -1 : 1;
    return (p.y_dbu > q.y_dbu) - (p.y_dbu < q.y_dbu);
}

static int by_place(const void *left, const void *right) {
    const side *a = left, *b = right;
    int order = by_point(a->low, b->low);
    if (order == 0) order = by_point(a->high, b->high);
    if (order == 0) order = fw_order_wholes(a->layer, b->layer);
    if (order == 0) order = fw_order_wholes(a->piece, b->piece);
    return order ? order : fw_order_wholes(a->edge, b->edge);
}

static side side_of(const fw_mask_solid *solid, int piece, int edge) {
    const fw_geometry_polygon *p = &solid->piece[piece].polygon;
    fw_geometry_point a = p->vertex[edge], b = p->vertex[edge + 1 < p->count ? edge + 1 : 0];
    bool forward = by_point(a, b) < 0;
    return (side){forward ? a : b, forward ? b : a, solid->piece[piece].shape->layer, piece, edge,
                  forward};
}

/* Walls between pieces go: two edges of one layer with the same ends that run opposite ways. In:
   pieces with all walls. Cost O(n log n) over all edges. Exact: grid points. Test:
   test_mask_solid.c. */
static fw_status open_joints(fw_arena *arena, fw_mask_solid *solid) {
    size_t n = 0, k = 0;
    for (int i = 0; i < solid->npiece; i++)
        n += (size_t)solid->piece[i].polygon.count;
    fw_mark mark = fw_arena_mark(arena);
    side *list = fw_arena_array(arena, side, n);
    FW_NEED(list);
    for (int i = 0; i < solid->npiece; i++)
        for (int e = 0; e < solid->piece[i].polygon.count; e++)
            list[k++] = side_of(solid, i, e);
    qsort(list, n, sizeof *list, by_place);
    for (size_t i = 0; i + 1 < n; i++) {
        side *a = &list[i], *b = &list[i + 1];
        if (by_point(a->low, b->low) || by_point(a->high, b->high) || a->layer != b->layer ||
            a->forward == b->forward)
            continue;
        solid->piece[a->piece].wall[a->edge] = solid->piece[b->piece].wall[b->edge] = false;
        i++; /* each edge has one twin */
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

static fw_status add_piece(fw_arena *arena, fw_mask_solid *solid, const fw_mask_shape *shape,
                           const fw_geometry_polygon *polygon) {
    fw_mask_solid_piece *p = &solid->piece[solid->npiece++];
    size_t n = (size_t)polygon->count;
    *p = (fw_mask_solid_piece){.shape = shape, .polygon = *polygon};
    FW_NEED(p->triangle = fw_arena_array(arena, fw_geometry_polygon_triangle, n));
    FW_NEED(p->wall = fw_arena_array(arena, bool, n));
    for (size_t i = 0; i < n; i++)
        p->wall[i] = true;
    return fw_geometry_polygon_triangulate(arena, polygon, p->triangle);
}

fw_status fw_mask_solid_build(fw_arena *arena, const fw_mask *mask, fw_mask_solid *solid) {
    size_t most = 0;
    for (int i = 0; i < mask->nshape; i++)
        most += 1 + (size_t)mask->shape[i].npart;
    *solid = (fw_mask_solid){.piece = fw_arena_array(arena, fw_mask_solid_piece, most),
                             .thickness_m = mask->thickness_m > 0 ? mask->thickness_m : UNKNOWN_M};
    FW_NEED(solid->piece);
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        if (!mask->table->layer[s->layer].biased) continue;
        if (s->npart == 0) FW_TRY(add_piece(arena, solid, s, &s->polygon));
        for (int k = 0; k < s->npart; k++)
            FW_TRY(add_piece(arena, solid, s, &s->part[k]));
    }
    FW_TRY(open_joints(arena, solid));
    for (int i = 0; i < solid->npiece; i++) {
        const fw_mask_solid_piece *p = &solid->piece[i];
        solid->triangles += 2 * (p->polygon.count - 2);
        for (int e = 0; e < p->polygon.count; e++)
            solid->triangles += p->wall[e] ? 2 : 0;
    }
    return FW_OK;
}
