/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Binary STL: 80 bytes of text, the number of triangles, and 50 bytes for each: normal and three
   corners as floats, two bytes of nothing; little-endian. 1 unit = 1 um. Source: 3D Systems,
   StereoLithography Interface Specification, 1989. */
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "base/sort.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* the solid that the polygons of the biased layers stand for: each drawn up from z = 0 to the
   device's thickness */
typedef struct solid_piece {
    const fw_mask_shape *shape;
    fw_geometry_polygon polygon;            /* of the shape, or one of its parts */
    fw_geometry_polygon_triangle *triangle; /* (polygon.count - 2) of its top */
    bool *wall; /* (polygon.count) from vertex i to the next one: false where another
                   piece goes on */
} solid_piece;

typedef struct solid_body {
    solid_piece *piece; /* (npiece) */
    int npiece;
    long triangles; /* of both faces and the walls */
    double thickness_m;
} solid_body;

static const double UNKNOWN_M = 1e-6; /* where nobody said how thick the device is */

typedef struct side { /* an edge of a polygon, from its smaller end */
    fw_geometry_point low, high;
    int layer, piece, edge;
    bool forward; /* the polygon runs from low to high */
} side;

static int by_point(fw_geometry_point p, fw_geometry_point q) {
    int order = fw_order_wholes(p.x_dbu, q.x_dbu);
    return order ? order : fw_order_wholes(p.y_dbu, q.y_dbu);
}

static int by_place(const void *left, const void *right) {
    const side *a = left, *b = right;
    int order = by_point(a->low, b->low);
    if (order == 0) order = by_point(a->high, b->high);
    if (order == 0) order = fw_order_wholes(a->layer, b->layer);
    if (order == 0) order = fw_order_wholes(a->piece, b->piece);
    return order ? order : fw_order_wholes(a->edge, b->edge);
}

static side side_of(const solid_body *solid, int piece, int edge) {
    const fw_geometry_polygon *p = &solid->piece[piece].polygon;
    fw_geometry_point a = p->vertex[edge], b = p->vertex[edge + 1 < p->count ? edge + 1 : 0];
    bool forward = by_point(a, b) < 0;
    return (side){forward ? a : b, forward ? b : a, solid->piece[piece].shape->layer, piece, edge,
                  forward};
}

/* Walls between pieces go: two edges of one layer with the same ends that run opposite ways. In:
   pieces with all walls. Cost O(n log n) over all edges. Exact: grid points. Test:
   test_mask_solid.c. */
static fw_status open_joints(fw_arena *arena, solid_body *solid) {
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

static fw_status add_piece(fw_arena *arena, solid_body *solid, const fw_mask_shape *shape,
                           const fw_geometry_polygon *polygon) {
    solid_piece *p = &solid->piece[solid->npiece++];
    size_t n = (size_t)polygon->count;
    *p = (solid_piece){.shape = shape, .polygon = *polygon};
    FW_NEED(p->triangle = fw_arena_array(arena, fw_geometry_polygon_triangle, n));
    FW_NEED(p->wall = fw_arena_array(arena, bool, n));
    for (size_t i = 0; i < n; i++)
        p->wall[i] = true;
    return fw_geometry_polygon_triangulate(arena, polygon, p->triangle);
}

static fw_status build_solid(fw_arena *arena, const fw_mask *mask, solid_body *solid) {
    size_t most = 0;
    for (int i = 0; i < mask->nshape; i++)
        most += 1 + (size_t)mask->shape[i].npart;
    *solid = (solid_body){.piece = fw_arena_array(arena, solid_piece, most),
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
        const solid_piece *p = &solid->piece[i];
        solid->triangles += 2 * (p->polygon.count - 2);
        for (int e = 0; e < p->polygon.count; e++)
            solid->triangles += p->wall[e] ? 2 : 0;
    }
    return FW_OK;
}

enum { HEAD = 80, FACET = 50 };

typedef struct corner {
    double x, y, z; /* um */
} corner;

static unsigned char *put_u32(unsigned char *at, uint32_t v) {
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(v >> 8 * i & 0xff);
    return at + 4;
}

static unsigned char *put_float(unsigned char *at, double value) {
    float f = (float)value;
    uint32_t v;
    memcpy(&v, &f, sizeof v);
    return put_u32(at, v);
}

static unsigned char *put_corner(unsigned char *at, corner c) {
    return put_float(put_float(put_float(at, c.x), c.y), c.z);
}

static corner place(fw_geometry_point p, double z) {
    return (corner){1e-3 * p.x_dbu, 1e-3 * p.y_dbu, z};
}

static unsigned char *facet(unsigned char *at, corner a, corner b, corner c) {
    corner u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
    corner n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    at = put_corner(at, (corner){n.x / length, n.y / length, n.z / length});
    at = put_corner(put_corner(put_corner(at, a), b), c);
    at[0] = at[1] = 0;
    return at + 2;
}

static unsigned char *piece(unsigned char *at, const solid_piece *s, double top_um) {
    const fw_geometry_polygon *p = &s->polygon;
    for (int i = 0; i < p->count - 2; i++) {
        const int *v = s->triangle[i].vertex;
        fw_geometry_point a = p->vertex[v[0]], b = p->vertex[v[1]], c = p->vertex[v[2]];
        at = facet(at, place(a, top_um), place(b, top_um), place(c, top_um));
        at = facet(at, place(a, 0), place(c, 0), place(b, 0));
    }
    for (int i = 0; i < p->count; i++) {
        if (!s->wall[i]) continue;
        fw_geometry_point a = p->vertex[i], b = p->vertex[i + 1 < p->count ? i + 1 : 0];
        at = facet(at, place(a, 0), place(b, 0), place(b, top_um));
        at = facet(at, place(a, 0), place(b, top_um), place(a, top_um));
    }
    return at;
}

fw_status fw_mask_write_stl(const fw_mask *mask, fw_text *out) {
    solid_body solid;
    FW_TRY(build_solid(out->arena, mask, &solid));
    unsigned char *at = fw_text_room(out, HEAD + 4 + FACET * (size_t)solid.triangles);
    if (!at) return FW_NOMEM;
    memset(at, ' ', HEAD);
    char text[HEAD + 1]; /* a text STL begins with "solid": not this one */
    int n =
        snprintf(text, sizeof text, "%s1 unit = 1 um; %s; %s", mask->rejected ? "REJECTED; " : "",
                 mask->thickness_m > 0 ? "walls vertical" : "THICKNESS NOT KNOWN", mask->cell);
    memcpy(at, text, n < HEAD ? (size_t)n : HEAD);
    at = put_u32(at + HEAD, (uint32_t)solid.triangles);
    for (int i = 0; i < solid.npiece; i++)
        at = piece(at, &solid.piece[i], 1e6 * solid.thickness_m);
    return fw_text_end(out);
}
