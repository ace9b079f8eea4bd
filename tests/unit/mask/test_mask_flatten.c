/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Necks, ways of flattening, and what the certificate sums up, on built masks. */
#include "geometry/segment.h"
#include "mask/mask_parts.h"
#include "scene.h"
#include <stdlib.h>

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

/* two blocks with a circular notch on either side between them, neck t at x = 0 */
static fw_geometry_contour notched(fw_arena *arena, fw_geometry_vec2 o, double r, double neck,
                                   double angle) {
    double high = 0.5 * neck + r, end = 1.5 * r;
    fw_geometry_pose pose = {o.x, o.y, angle};
    fw_geometry_outline l = fw_geometry_outline_start(arena, (fw_geometry_vec2){-end, -high});
    fw_geometry_outline_line(&l, (fw_geometry_vec2){-r, -high}, 0);
    fw_geometry_outline_arc_to(&l, (fw_geometry_vec2){0, -high}, -FW_PI,
                               (fw_geometry_vec2){r, -high}, 0);
    fw_geometry_outline_line(&l, (fw_geometry_vec2){end, -high}, 0);
    fw_geometry_outline_line(&l, (fw_geometry_vec2){end, high}, 0);
    fw_geometry_outline_line(&l, (fw_geometry_vec2){r, high}, 0);
    fw_geometry_outline_arc_to(&l, (fw_geometry_vec2){0, high}, -FW_PI,
                               (fw_geometry_vec2){-r, high}, 0);
    fw_geometry_outline_line(&l, (fw_geometry_vec2){-end, high}, 0);
    fw_geometry_contour c, out = {0};
    assert_int_equal(fw_geometry_outline_close(&l, &c), FW_OK);
    assert_int_equal(fw_geometry_contour_transform(arena, &c, pose, false, &out), FW_OK);
    return out;
}

/* least width of the polygon: every vertex to every edge of the other side */
static double polygon_width(const fw_geometry_polygon *p, fw_geometry_vec2 at, double within) {
    double least = HUGE_VAL;
    for (int i = 0; i < p->count; i++) {
        fw_geometry_vec2 v = {1e-9 * p->vertex[i].x_dbu, 1e-9 * p->vertex[i].y_dbu};
        if (vec_distance(v, at) > within) continue;
        for (int k = 0; k < p->count; k++) {
            int gap = abs(k - i);
            if (gap < 20 || gap > p->count - 20) continue; /* the same side */
            fw_geometry_point a = p->vertex[k], b = p->vertex[(k + 1) % p->count];
            fw_geometry_segment s = {.kind = FW_LINE,
                                     .a = {1e-9 * a.x_dbu, 1e-9 * a.y_dbu},
                                     .b = {1e-9 * b.x_dbu, 1e-9 * b.y_dbu}};
            least = fmin(least, fw_geometry_segment_nearest(&s, v, NULL, NULL));
        }
    }
    return least;
}

/* on the grid and along it the neck is exact; off it, to the rounding of two vertices. Without the
   vertices it could be wider by twice the tolerance. */
static void necks_are_exact_to_the_grid(void **state) {
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < 60; i++) {
        scene *s = scene_new(0, 0);
        bool straight = i % 2;
        double t = 1e-9 * (2000 + 2 * (int)(4000 * random01(&seed)));
        double r = 1e-9 * (30000 + (int)(70000 * random01(&seed)));
        double angle = straight ? 0 : 6 * random01(&seed);
        fw_geometry_vec2 o = {1e-9 * (int)(1e6 * random01(&seed)),
                              1e-9 * (int)(1e6 * random01(&seed))};
        scene_add(s, FW_ROLE_FLEXURE, "notch", notched(s->arena, o, r, t, angle));
        s->options.flattening = i % 4 < 2 ? FW_FLATTEN_INSIDE : FW_FLATTEN_EQUAL_AREA;
        s->options.tolerance_m = 20e-9;
        const fw_mask *mask = built(s);
        const fw_mask_neck *neck = &mask->shape[0].neck;
        assert_true(neck->there && neck->on_vertex[0] && neck->on_vertex[1]);
        assert_near(vec_distance(neck->at[0], neck->at[1]), t, 1e-15);
        double x = 1e-9 * ((double)neck->vertex[0].x_dbu - neck->vertex[1].x_dbu);
        double y = 1e-9 * ((double)neck->vertex[0].y_dbu - neck->vertex[1].y_dbu);
        assert_near(hypot(x, y), t, straight ? 1e-15 : 1.4143e-9);
        fw_geometry_vec2 middle = vec_scale(0.5, vec_add(neck->at[0], neck->at[1]));
        if (s->options.flattening == FW_FLATTEN_INSIDE)
            assert_near(polygon_width(&mask->shape[0].polygon, middle, 3e-6 + t), t,
                        straight ? 1e-12 : 1.4143e-9);
        scene_free(s);
    }
}

/* a ring has one width everywhere: its middle gets the vertices */
static void rings_have_them_in_the_middle(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_arch(s, 50, 8, 20);
    const fw_mask *mask = built(s);
    const fw_mask_neck *neck = &mask->shape[0].neck;
    assert_true(neck->there && neck->on_vertex[0] && neck->on_vertex[1]);
    for (int k = 0; k < 2; k++) {
        assert_int_equal(neck->vertex[k].x_dbu, 0);
        assert_true(neck->vertex[k].y_dbu == 46000 || neck->vertex[k].y_dbu == 54000);
    }
    assert_false(mask->shape[1].neck.there); /* no flexure */
    scene_free(s);
}

/* the same mask both ways: equal areas are nearer, and need no more vertices */
static void areas_are_kept_where_wanted(void **state) {
    (void)state;
    double error[2];
    int vertices[2];
    for (int k = 0; k < 2; k++) {
        scene *s = scene_new(0, 0);
        fw_geometry_contour disc;
        assert_int_equal(
            fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){0, 0}, 300 * UM, &disc), FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, "disc", disc);
        s->options.flattening = (fw_geometry_flattening)k;
        s->options.tolerance_m = 50e-9;
        const fw_mask *mask = built(s);
        const fw_mask_measure *m = &mask->measure[0];
        error[k] = fabs(m->polygon_area_m2 - m->area_m2);
        vertices[k] = m->vertices;
        assert_true(error[k] <= m->bound_m2 && m->edge_m <= 50e-9 + 0.7072e-9);
        assert_near(m->box.x1, 300e-6, 51e-9);
        assert_true(m->straight == 0 && m->sharpest_material_rad > 3);
        scene_free(s);
    }
    assert_true(error[1] < 0.01 * error[0] && vertices[1] <= vertices[0]);
}

static void ways_have_names(void **state) {
    (void)state;
    fw_geometry_flattening kind;
    assert_true(fw_mask_flattening_named(NULL, &kind) && kind == FW_FLATTEN_INSIDE);
    assert_true(fw_mask_flattening_named("equal-area", &kind) && kind == FW_FLATTEN_EQUAL_AREA);
    assert_string_equal(fw_mask_flattening_name(kind), "equal-area");
    assert_false(fw_mask_flattening_named("outside", &kind));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(necks_are_exact_to_the_grid),
        cmocka_unit_test(rings_have_them_in_the_middle),
        cmocka_unit_test(areas_are_kept_where_wanted),
        cmocka_unit_test(ways_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
