/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which outlines are another one, moved: letters, combs, marks. */
#include "mask/stream.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SAMPLES = 16,
    LINE_BYTES = 20,
    ARC_BYTES = 90,
    LEAST_BYTES = 160
};                                /* a reference takes some 60 */
static const double PER_M = 1e12; /* as written: 1 pm */
static const double SAME_RAD = 1e-9;

typedef struct entry {
    uint64_t hash;
    int shape;
} entry;

typedef struct form { /* one segment, from the outline's first point */
    int64_t x, y, radius, cx, cy;
    double sweep;
} form;

static form form_of(const fw_geometry_contour *c, int i, fw_geometry_vec2 upper_left) {
    const fw_geometry_segment *s = &c->segment[i], *first = c->segment;
    int64_t x0 = llround((first->a.x - upper_left.x) * PER_M);
    int64_t y0 = llround((upper_left.y - first->a.y) * PER_M);
    form f = {.x = llround((s->b.x - upper_left.x) * PER_M) - x0,
              .y = llround((upper_left.y - s->b.y) * PER_M) - y0};
    if (s->kind != FW_ARC) return f;
    f.radius = llround(s->radius * PER_M);
    f.cx = llround((s->centre.x - first->a.x) * PER_M);
    f.cy = llround((s->centre.y - first->a.y) * PER_M);
    f.sweep = s->sweep_rad;
    return f;
}

/* of the number of segments and of some of them: what is equal is compared as a whole */
static uint64_t hash_of(const fw_mask_shape *s, fw_geometry_vec2 upper_left) {
    int step = s->contour.count / SAMPLES + 1;
    uint64_t h = 1469598103934665603u ^ (uint64_t)s->contour.count; /* Fowler, Noll and Vo */
    for (int i = 0; i < s->contour.count; i += step) {
        form f = form_of(&s->contour, i, upper_left);
        const int64_t part[] = {f.x, f.y, f.radius};
        for (size_t k = 0; k < sizeof part / sizeof part[0]; k++)
            h = (h ^ (uint64_t)part[k]) * 1099511628211u;
    }
    return h;
}

/* Written ends the same, and arcs the same but for 2 pm of their centres. */
static bool same_form(const fw_geometry_contour *p, const fw_geometry_contour *q,
                      fw_geometry_vec2 upper_left) {
    if (p->count != q->count) return false;
    for (int i = 0; i < p->count; i++) {
        form a = form_of(p, i, upper_left), b = form_of(q, i, upper_left);
        if (a.x != b.x || a.y != b.y || a.radius != b.radius || llabs(a.cx - b.cx) > 2 ||
            llabs(a.cy - b.cy) > 2 || !(fabs(a.sweep - b.sweep) <= SAME_RAD))
            return false;
    }
    return true;
}

static bool pays(const fw_geometry_contour *c) {
    int bytes = 0;
    for (int i = 0; i < c->count && bytes < LEAST_BYTES; i++)
        bytes += c->segment[i].kind == FW_ARC ? ARC_BYTES : LINE_BYTES;
    return bytes >= LEAST_BYTES;
}

static int by_hash(const void *left, const void *right) {
    const entry *a = left, *b = right;
    if (a->hash != b->hash) return a->hash < b->hash ? -1 : 1;
    return (a->shape > b->shape) - (a->shape < b->shape);
}

/* For every shape of a layer the first one that it repeats: itself where others repeat it, -1 where
   none does. In: outlines (m), as they are rounded in the file (1 pm). Out: of (nshape). Cost: O(n
   log n) hashes, then each against the first of its hash. Test: test_svg_repeat.c. */
fw_status fw_mask_svg_repeats(fw_arena *arena, const fw_mask *mask, int layer,
                              fw_geometry_vec2 upper_left, int **out) {
    int n = 0, *of = fw_arena_array(arena, int, (size_t)mask->nshape);
    entry *list = fw_arena_array(arena, entry, (size_t)mask->nshape);
    FW_NEED(of);
    FW_NEED(list);
    for (int i = 0; i < mask->nshape; i++) {
        of[i] = -1;
        if (mask->shape[i].layer == layer && pays(&mask->shape[i].contour))
            list[n++] = (entry){hash_of(&mask->shape[i], upper_left), i};
    }
    qsort(list, (size_t)n, sizeof *list, by_hash);
    for (int i = 0, first = 0; i < n; i++) {
        if (list[i].hash != list[first].hash) first = i;
        const fw_geometry_contour *p = &mask->shape[list[first].shape].contour;
        if (i == first || !same_form(p, &mask->shape[list[i].shape].contour, upper_left)) continue;
        of[list[first].shape] = of[list[i].shape] = list[first].shape;
    }
    *out = of;
    return FW_OK;
}
