/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles of a polygon on the grid, in exact integers. */
#include "geometry/polygon.h"

typedef struct ring {
    const fw_geometry_point *v;
    int *next, *before; /* of the vertices that are left */
    int *not_convex;    /* (count) vertices that may lie in a triangle */
    int *place;         /* in that list; -1: convex */
    int count;
} ring;

static int64_t turn(const ring *r, int i) {
    return fw_cross(r->v[r->before[i]], r->v[i], r->v[r->next[i]]);
}

static void becomes_convex(ring *r, int i) {
    if (r->place[i] < 0 || turn(r, i) <= 0) return;
    int last = r->not_convex[--r->count];
    r->not_convex[r->place[i]] = last;
    r->place[last] = r->place[i];
    r->place[i] = -1;
}

/* in the closed triangle, which runs counter-clockwise */
static bool covers(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c,
                   fw_geometry_point p) {
    return fw_cross(a, b, p) >= 0 && fw_cross(b, c, p) >= 0 && fw_cross(c, a, p) >= 0;
}

static int32_t least(int32_t a, int32_t b, int32_t c) {
    int32_t m = a < b ? a : b;
    return m < c ? m : c;
}

static int32_t most(int32_t a, int32_t b, int32_t c) {
    int32_t m = a > b ? a : b;
    return m > c ? m : c;
}

static bool is_ear(const ring *r, int i) {
    if (r->place[i] >= 0) return false;
    int p = r->before[i], n = r->next[i];
    fw_geometry_point a = r->v[p], b = r->v[i], c = r->v[n];
    int32_t x0 = least(a.x_dbu, b.x_dbu, c.x_dbu), x1 = most(a.x_dbu, b.x_dbu, c.x_dbu);
    int32_t y0 = least(a.y_dbu, b.y_dbu, c.y_dbu), y1 = most(a.y_dbu, b.y_dbu, c.y_dbu);
    for (int k = 0; k < r->count; k++) {
        int q = r->not_convex[k];
        fw_geometry_point at = r->v[q];
        if (at.x_dbu < x0 || at.x_dbu > x1 || at.y_dbu < y0 || at.y_dbu > y1) continue;
        if (q != p && q != n && covers(a, b, c, at)) return false;
    }
    return true;
}

static fw_status start(fw_arena *arena, const fw_geometry_polygon *p, ring *r) {
    size_t n = (size_t)p->count;
    *r = (ring){.v = p->vertex,
                .next = fw_arena_array(arena, int, n),
                .before = fw_arena_array(arena, int, n),
                .not_convex = fw_arena_array(arena, int, n),
                .place = fw_arena_array(arena, int, n)};
    if (!r->next || !r->before || !r->not_convex || !r->place) return FW_NOMEM;
    for (int i = 0; i < p->count; i++) {
        r->next[i] = i + 1 < p->count ? i + 1 : 0;
        r->before[i] = i > 0 ? i - 1 : p->count - 1;
    }
    for (int i = 0; i < p->count; i++) {
        r->place[i] = turn(r, i) > 0 ? -1 : r->count;
        if (r->place[i] >= 0) r->not_convex[r->count++] = i;
    }
    return FW_OK;
}

/* Ears are cut off until three vertices are left (Meisters 1975: there are always two). An ear is a
   corner of less than 180 degrees whose closed triangle has no other vertex in it; vertices on a
   straight way count as such, so that no triangle is flat and every vertex is used.
   In: a simple polygon, counter-clockwise (fw_geometry_polygon_check). Out: (count - 2) triangles,
   vertex
   numbers, counter-clockwise. Exact. Cost: O(n r) for r corners that are not convex, n tries at
   best, n^2 at worst. FW_GEOMETRY: the polygon is not simple. Source: G. H. Meisters, "Polygons
   have ears", Am. Math. Monthly 82 (1975) 648. Test: test_triangulate.c. */
fw_status fw_geometry_polygon_triangulate(fw_arena *arena, const fw_geometry_polygon *polygon,
                                          fw_geometry_polygon_triangle *out) {
    ring r;
    if (polygon->count < 3) return FW_GEOMETRY;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(start(arena, polygon, &r));
    int left = polygon->count, at = 0, made = 0, missed = 0;
    while (left > 3 && missed <= left) {
        if (!is_ear(&r, at)) {
            at = r.next[at];
            missed++;
            continue;
        }
        int p = r.before[at], n = r.next[at];
        out[made++] = (fw_geometry_polygon_triangle){{p, at, n}};
        r.next[p] = n;
        r.before[n] = p;
        becomes_convex(&r, p);
        becomes_convex(&r, n);
        at = r.next[n]; /* not from one corner only: triangles would be needles */
        left--;
        missed = 0;
    }
    bool whole = left == 3 && turn(&r, at) > 0;
    out[made] = (fw_geometry_polygon_triangle){{r.before[at], at, r.next[at]}};
    fw_arena_rewind(arena, mark);
    return whole ? FW_OK : FW_GEOMETRY;
}
