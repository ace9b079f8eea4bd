/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layouts of a few outlines, for the distances in them. */
#ifndef FW_TEST_RELEASE_FIXTURE_H
#define FW_TEST_RELEASE_FIXTURE_H
#include "test.h"
#include "geometry/segment.h"
#include "release/release_field.h"

#define UM 1e-6

typedef struct plate {
    fw_arena *arena;
    fw_layout layout;
} plate;

static inline plate *plate_new(double half_um) {
    fw_arena *arena = fw_arena_new(0);
    plate *p = fw_arena_one(arena, plate);
    p->arena = arena;
    p->layout.drawn = true;
    p->layout.piece = fw_arena_array(arena, fw_layout_piece, 2000);
    p->layout.die = (fw_geometry_box){-half_um * UM, -half_um * UM, half_um * UM, half_um * UM};
    return p;
}

static inline void plate_add(plate *p, fw_layout_role role, int body, const char *label,
                             fw_geometry_contour c) {
    p->layout.piece[p->layout.npiece++] = (fw_layout_piece){
        .role = role, .body = body, .joint = FW_NONE, .label = label, .contour = c};
}

static inline fw_geometry_contour rectangle(plate *p, double x0, double y0, double x1, double y1) {
    fw_geometry_contour c;
    fw_geometry_box box = {x0 * UM, y0 * UM, x1 * UM, y1 * UM};
    assert_int_equal(fw_geometry_contour_rectangle(p->arena, box, &c), FW_OK);
    return c;
}

static inline fw_geometry_contour disc(plate *p, double x, double y, double r) {
    fw_geometry_contour c;
    fw_geometry_vec2 at = {x * UM, y * UM};
    assert_int_equal(fw_geometry_contour_disc(p->arena, at, r * UM, &c), FW_OK);
    return c;
}

static inline fw_geometry_contour polygon(plate *p, const double (*xy)[2], int n) {
    fw_geometry_contour c;
    fw_geometry_outline o =
        fw_geometry_outline_start(p->arena, (fw_geometry_vec2){xy[0][0] * UM, xy[0][1] * UM});
    for (int i = 1; i < n; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){xy[i][0] * UM, xy[i][1] * UM}, 0);
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

static inline const fw_release *solve(plate *p, double share) {
    const fw_release *r = NULL;
    assert_int_equal(fw_release_solve(p->arena, &p->layout, true, false, share, &r), FW_OK);
    return r;
}
#endif
