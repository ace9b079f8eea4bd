/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/block.h"
#include "geometry/segment.h"
#include <math.h>

/* ---- outlines in the frame of the cut ---- */

static fw_spot local(const fw_recipe_cut *cut, fw_vec2 p, bool open) {
    fw_vec2 d = vec_sub(p, cut->line.at);
    return (fw_spot){vec_dot(d, cut->line.along), vec_cross(cut->line.along, d), open};
}

/* chords of an arc with a sagitta of at most the tolerance: |sweep|/(2 acos(1 - tolerance/r)) */
static int chords(const fw_segment *s, double tolerance_m) {
    if (s->kind == FW_LINE) return 1;
    double step = tolerance_m < s->radius ? 2.0 * acos(1.0 - tolerance_m / s->radius) : 1.5;
    return (int)ceil(fabs(s->sweep_rad) / step - 1e-9);
}

static fw_status flatten(fw_arena *arena, const fw_recipe_cut *cut, const fw_contour *c,
                         double tolerance_m, fw_ring *out) {
    size_t n = 0;
    for (int i = 0; i < c->count; i++)
        n += (size_t)chords(&c->segment[i], tolerance_m);
    *out = (fw_ring){.corner = fw_arena_array(arena, fw_spot, n)};
    FW_NEED(out->corner);
    for (int i = 0; i < c->count; i++) {
        const fw_segment *s = &c->segment[i];
        int parts = chords(s, tolerance_m);
        for (int k = 1; k <= parts; k++)
            out->corner[out->n++] = local(cut, fw_segment_point(s, (double)k / parts),
                                          (s->flags & FW_SEGMENT_JOINT) != 0);
    }
    return FW_OK;
}

/* distance inside one of the block's four sides */
static double inside(const fw_recipe_cut *cut, int side, fw_spot p) {
    const double d[] = {p.x, cut->length_m - p.x, p.y, cut->depth_m - p.y};
    return d[side];
}

/* One ring against one side (Sutherland and Hodgman, Comm. ACM 17 (1974) 32): edges that run along
   the side are marked open. */
static fw_status clip_side(fw_arena *arena, const fw_recipe_cut *cut, int side, fw_ring *ring) {
    fw_ring out = {.corner = fw_arena_array(arena, fw_spot, 2 * (size_t)ring->n)};
    FW_NEED(out.corner);
    for (int i = 0; i < ring->n; i++) {
        fw_spot a = ring->corner[i > 0 ? i - 1 : ring->n - 1], b = ring->corner[i];
        double da = inside(cut, side, a), db = inside(cut, side, b);
        bool in_a = da >= 0.0, in_b = db >= 0.0;
        if (in_a != in_b) {
            double t = da / (da - db);
            fw_spot at = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), in_a ? b.open : true};
            out.corner[out.n++] = at;
        }
        if (in_b) out.corner[out.n++] = b;
    }
    *ring = out;
    return FW_OK;
}

fw_status fw_block_rings(fw_slicer *slicer, double edge_m, double tolerance_m, fw_rings *rings) {
    const fw_outline_at *at;
    FW_TRY(fw_slicer_at(slicer, edge_m, &at));
    *rings = (fw_rings){.ring = fw_arena_array(slicer->arena, fw_ring, (size_t)slicer->nshape)};
    FW_NEED(rings->ring);
    for (int k = 0; k < slicer->nshape; k++) {
        fw_ring *r = &rings->ring[rings->n];
        if (at->contour[k].count == 0) continue;
        FW_TRY(flatten(slicer->arena, slicer->cut, &at->contour[k], tolerance_m, r));
        for (int side = 0; side < 4 && r->n > 0; side++)
            FW_TRY(clip_side(slicer->arena, slicer->cut, side, r));
        if (r->n >= 3) rings->n++;
    }
    return FW_OK;
}

/* ---- which wall hides which ---- */

typedef struct span { /* of a wall, seen from the eye */
    double from, to, depth_from, depth_to;
} span;

static span seen(const fw_wall *w, double tx, double ty) {
    double xa = -ty * w->a.x + tx * w->a.y, xb = -ty * w->b.x + tx * w->b.y; /* to the right */
    double da = tx * w->a.x + ty * w->a.y, db = tx * w->b.x + ty * w->b.y;
    return xa <= xb ? (span){xa, xb, da, db} : (span){xb, xa, db, da};
}

static double depth_at(const span *s, double x) {
    double length = s->to - s->from;
    return length > 0.0 ? s->depth_from + (s->depth_to - s->depth_from) * (x - s->from) / length
                        : fmax(s->depth_from, s->depth_to);
}

/* must p be drawn before q? Where both are seen in one direction q is nearer to the eye. */
static bool before(const span *p, const span *q) {
    double from = fmax(p->from, q->from), to = fmin(p->to, q->to);
    if (to - from <= 1e-12) return false;
    double middle = 0.5 * (from + to);
    return depth_at(p, middle) < depth_at(q, middle);
}

/* Walls do not cross, so that "is hidden by" has no cycle in one direction of view (de Berg et al.,
   Computational Geometry, section 12.1: true of disjoint segments in the plane); what could come
   first comes in the order given. In: n walls. Cost O(n^2). Test: test_profile.c, walls. */
fw_status fw_walls_sort(fw_arena *arena, fw_wall *wall, int n, double toward_x, double toward_y) {
    fw_mark mark = fw_arena_mark(arena);
    span *s = fw_arena_array(arena, span, (size_t)n);
    int *waits = fw_arena_array(arena, int, (size_t)n);
    bool *done = fw_arena_array(arena, bool, (size_t)n);
    fw_wall *sorted = fw_arena_array(arena, fw_wall, (size_t)n);
    FW_NEED(s && waits && done && sorted);
    for (int i = 0; i < n; i++)
        s[i] = seen(&wall[i], toward_x, toward_y);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            waits[i] += i != k && before(&s[k], &s[i]);
    for (int left = n; left > 0; left--) {
        int best = -1;
        for (int i = 0; i < n; i++)
            if (!done[i] && (best < 0 || waits[i] < waits[best])) best = i;
        done[best] = true;
        sorted[n - left] = wall[best];
        for (int i = 0; i < n; i++)
            if (!done[i] && before(&s[best], &s[i])) waits[i]--;
    }
    for (int i = 0; i < n; i++)
        wall[i] = sorted[i];
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
