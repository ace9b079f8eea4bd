/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the geometry tests share: a fixed random sequence, an arena per test, random outlines. */
#ifndef FW_TEST_GEO_H
#define FW_TEST_GEO_H
#include "test.h"
#include "geometry/contour.h"
#include "geometry/segment.h"
#include "geometry/polygon.h"
#include <stdlib.h>

static inline uint64_t *seed(void) {
    static uint64_t state = 88172645463325252u;
    return &state;
}

static inline double uniform(double low, double high) /* xorshift64 */
{
    uint64_t x = *seed();
    x ^= x << 13;
    x ^= x >> 7;
    x ^= x << 17;
    *seed() = x;
    return low + (high - low) * (double)(x >> 11) * 0x1p-53;
}

static inline int whole(int low, int high) /* inclusive */
{
    return low + (int)(uniform(0, 1) * (high - low + 1));
}

static inline int with_arena(void **state) {
    *state = fw_arena_new(0);
    return *state ? 0 : -1;
}

static inline int without_arena(void **state) {
    fw_arena_fail_at(0, 0);
    fw_arena_free(*state);
    return 0;
}

#define geo_test(f) cmocka_unit_test_setup_teardown(f, with_arena, without_arena)

static inline fw_geometry_region region_of(fw_geometry_contour *contour) {
    return (fw_geometry_region){contour, 1};
}

static inline double region_area(const fw_geometry_region *r) {
    double sum = 0;
    for (int i = 0; i < r->count; i++)
        sum += fw_geometry_contour_area(&r->contour[i]);
    return sum;
}

static inline int region_turns(const fw_geometry_region *r, fw_geometry_vec2 p) {
    int sum = 0;
    for (int i = 0; i < r->count; i++)
        sum += fw_geometry_contour_winding(&r->contour[i], p);
    return sum;
}

/* distance of a point from the outlines of a region */
static inline double region_edge(const fw_geometry_region *r, fw_geometry_vec2 p) {
    double least = HUGE_VAL;
    for (int i = 0; i < r->count; i++)
        for (int k = 0; k < r->contour[i].count; k++)
            least =
                fmin(least, fw_geometry_segment_nearest(&r->contour[i].segment[k], p, NULL, NULL));
    return least;
}

/* a rectangle, bar, disc or ring sector; `snap` > 0 puts everything on a coarse grid, which makes
   shared edges, touches and tangent circles common */
static inline fw_geometry_contour random_shape(fw_arena *arena, double size, double snap) {
    fw_geometry_contour c = {0};
    double x = uniform(-size, size), y = uniform(-size, size), a = uniform(0.1, 1) * size,
           b = uniform(0.1, 1) * size, angle = uniform(0, FW_TURN);
    if (snap > 0) {
        x = snap * whole(-4, 4);
        y = snap * whole(-4, 4);
        a = snap * whole(1, 4);
        b = snap * whole(1, 4);
        angle = FW_PI / 4 * whole(0, 7);
    }
    switch (whole(0, 3)) {
    case 0:
        assert_int_equal(
            fw_geometry_contour_rectangle(arena, (fw_geometry_box){x, y, x + a, y + b}, &c), 0);
        break;
    case 1: {
        fw_geometry_vec2 p = {x, y}, q = {x + a * cos(angle), y + a * sin(angle)};
        assert_int_equal(fw_geometry_contour_bar(arena, p, q, b, &c), 0);
        break;
    }
    case 2:
        assert_int_equal(fw_geometry_contour_disc(arena, (fw_geometry_vec2){x, y}, a, &c), 0);
        break;
    default: {
        double sweep = snap > 0 ? FW_PI / 4 * whole(1, 7) : uniform(0.3, 6.2);
        assert_int_equal(fw_geometry_contour_ring_sector(arena, (fw_geometry_vec2){x, y}, a, a + b,
                                                         angle, sweep, &c),
                         0);
    }
    }
    return c;
}
#endif
