/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene.h"

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

/* half ring R 50, width w + 2d; two legs of 20 um, wider by d each side and longer by d at the foot
 */
static void bias_has_the_closed_form(void **state) {
    (void)state;
    static const double bias[] = {0, 0.5, -0.5, 1.37, -2.1};
    for (int i = 0; i < 5; i++) {
        scene *s = scene_new(3 * UM, 4 * UM);
        scene_arch(s, 50, 8, 20);
        s->options.bias_m = bias[i] * UM;
        const fw_mask *mask = built(s);
        double width = 8 + 2 * bias[i];
        double area = PI * 50 * width + 2 * width * (20 + bias[i]);
        assert_relative(mask->measure[0].area_m2, area * UM * UM, 1e-12);
        assert_near(mask->measure[0].polygon_area_m2, mask->measure[0].area_m2,
                    mask->measure[0].bound_m2);
        assert_near(mask->measure[0].width_m, width * UM, 1e-15);
        scene_free(s);
    }
}

static void text_is_not_biased(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    static const double p[4][2] = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};
    scene_add(s, FW_ROLE_MARK, "mark", polygon(s->arena, p, 4));
    s->options.bias_m = 1 * UM;
    assert_near(built(s)->measure[1].area_m2, 64 * UM * UM, 1e-24);
    scene_free(s);
}

/* exact: both sides of a joint have the same bits, so the polygons share two grid points */
static void joints_share_grid_points(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_arch(s, 50, 8, 20);
    fw_geometry_pose pose = {0.123456789e-3, -0.987654321e-3, 0.7};
    for (int i = 0; i < s->layout.npiece; i++) {
        fw_geometry_contour moved;
        assert_int_equal(
            fw_geometry_contour_transform(s->arena, &s->piece[i].contour, pose, false, &moved),
            FW_OK);
        s->piece[i].contour = moved;
    }
    s->options.bias_m = 0.777 * UM;
    const fw_mask *mask = built(s);
    int shared = 0;
    for (int i = 0; i < mask->nshape; i++)
        for (int j = 0; j < i; j++)
            for (int a = 0; a < mask->shape[i].polygon.count; a++)
                for (int b = 0; b < mask->shape[j].polygon.count; b++)
                    shared +=
                        memcmp(&mask->shape[i].polygon.vertex[a], &mask->shape[j].polygon.vertex[b],
                               sizeof(fw_geometry_point)) == 0;
    assert_int_equal(shared, 4);
    scene_free(s);
}

static void bias_that_closes_is_refused(void **state) {
    (void)state;
    static const double slot[8][2] = {{0, 0},   {40, 0},  {40, 40}, {23, 40},
                                      {23, 10}, {17, 10}, {17, 40}, {0, 40}};
    scene *s = scene_new(0, 0);
    scene_add(s, FW_ROLE_STRUCTURE, "slotted plate", polygon(s->arena, slot, 8));
    s->options.bias_m = 3.5 * UM;
    const fw_mask *mask = NULL;
    assert_int_equal(scene_build(s, &mask), FW_INPUT);
    const char *m = scene_first(s, 143);
    assert_says(m, "slotted plate");
    assert_says(m, "3.5 um per edge");
    assert_says(m, "um per edge: its edges");
    assert_says(m, "7 um apart");
    scene_free(s);
}

/* the gap between two pieces that bias leaves too small names both */
static void bias_against_space(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_box(s, "link AB", 0, 0, 50, 10);
    scene_box(s, "link BC", 0, 16, 50, 30);
    s->options.bias_m = 1.2 * UM;
    const fw_mask *mask = NULL;
    assert_int_equal(scene_build(s, &mask), FW_INPUT);
    assert_says(scene_first(s, 145), "link AB");
    assert_says(scene_first(s, 145), "link BC");
    assert_says(scene_first(s, 145), "space of 3.6 um");
    scene_free(s);
}

/* random ring sectors: exact area, flattened area within the proven bound, simple, edges not short
 */
static void random_ring_sectors(void **state) {
    (void)state;
    uint64_t seed = 2026;
    for (int i = 0; i < 300; i++) {
        scene *s = scene_new(0, 0);
        double inner = (5 + 200 * random01(&seed)) * UM, width = (4 + 40 * random01(&seed)) * UM;
        double sweep = 0.2 + 5.5 * random01(&seed);
        fw_geometry_vec2 o = {5e-3 * random01(&seed), 5e-3 * random01(&seed)};
        fw_geometry_contour c;
        assert_int_equal(fw_geometry_contour_ring_sector(s->arena, o, inner, inner + width,
                                                         7 * random01(&seed), sweep, &c),
                         FW_OK);
        scene_add(s, FW_ROLE_FLEXURE, "ring", c);
        s->options.tolerance_m = (1.42 + 20 * random01(&seed)) * 1e-9;
        const fw_mask *mask = built(s);
        const fw_mask_measure *m = &mask->measure[0];
        double area = 0.5 * sweep * width * (2 * inner + width);
        assert_relative(m->area_m2, area, 1e-11);
        assert_near(m->polygon_area_m2, area, m->bound_m2);
        assert_true(m->bound_m2 < 0.02 * area);
        assert_true(m->shortest_edge_m > 0.3 * sqrt(8 * inner * s->options.tolerance_m) ||
                    m->shortest_edge_m > 3e-6);
        scene_free(s);
    }
}

/* a turned right angle can lose a little on the grid; along the axes and at joints it cannot */
static void turned_corners_are_told(void **state) {
    (void)state;
    int told = 0;
    for (int i = 0; i < 20; i++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        fw_geometry_contour c, moved;
        assert_int_equal(
            fw_geometry_contour_rectangle(s->arena, (fw_geometry_box){0, 0, 100 * UM, 20 * UM}, &c),
            FW_OK);
        fw_geometry_pose pose = {0, 0, 0.1 * i};
        assert_int_equal(fw_geometry_contour_transform(s->arena, &c, pose, false, &moved), FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, "bar", moved);
        const fw_mask *mask = built(s);
        assert_int_equal(s->diags.errors, 0);
        bool sharp = mask->measure[0].sharpest_rad < 0.5 * PI - 1e-12;
        assert_int_equal(s->diags.count, sharp ? 1 : 0);
        if (sharp) assert_says(scene_first(s, 153), "bar has");
        assert_true(i > 0 || !sharp);
        told += sharp;
        scene_free(s);
    }
    assert_true(told >= 10);
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    assert_true(built(s)->measure[0].sharpest_rad < 0.5 * PI); /* at the joints */
    assert_int_equal(s->diags.count, 0);
    scene_free(s);
}

static void limits(void **state) {
    (void)state;
    const fw_mask *mask = NULL;
    scene *s = scene_new(0, 0);
    assert_int_equal(scene_build(s, &mask), FW_INPUT); /* no pieces */
    scene_first(s, 151);
    s->layout.drawn = false;
    s->layout.why_not = "body AB has no width";
    s->diags.count = 0;
    assert_int_equal(scene_build(s, &mask), FW_INPUT);
    assert_says(scene_first(s, 151), "body AB has no width");
    s->layout.drawn = true;
    scene_box(s, "far", 1.2e6, 0, 1.21e6, 10);
    assert_int_equal(scene_build(s, &mask), FW_INPUT);
    assert_says(scene_first(s, 149), "far");
    scene_free(s);

    static const double tolerance[] = {1e-10, -1, 2e-6};
    for (int i = 0; i < 4; i++) {
        s = scene_new(0, 0);
        scene_box(s, "box", 0, 0, 10, 10);
        s->options.tolerance_m = i < 3 ? tolerance[i] : (double)NAN;
        assert_int_equal(scene_build(s, &mask), FW_INPUT);
        scene_free(s);
    }
    static const double bias[] = {(double)NAN, HUGE_VAL, 1};
    for (int i = 0; i < 3; i++) {
        s = scene_new(0, 0);
        scene_box(s, "box", 0, 0, 10, 10);
        s->options.bias_m = bias[i];
        assert_int_equal(scene_build(s, &mask), FW_INPUT);
        scene_first(s, 143);
        scene_free(s);
    }
}

/* an outline above the limit is drawn whole and cut for GDSII; the neighbours below it are not */
static void more_vertices_than_a_boundary_takes(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){0, 0}, 0.02, &c), FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "wafer", c);
    scene_box(s, "box", 30000, 0, 30010, 10);
    s->options.tolerance_m = 1.5e-9;
    const fw_mask *mask = NULL;
    assert_int_equal(scene_build(s, &mask), FW_OK);
    assert_int_equal(mask->vertex_limit, 4094);
    assert_true(mask->shape[0].polygon.count > 4094 && mask->shape[0].npart > 1);
    for (int i = 0; i < mask->shape[0].npart; i++)
        assert_true(mask->shape[0].part[i].count <= 4094);
    assert_int_equal(mask->shape[1].npart, 1);
    assert_ptr_equal(mask->shape[1].part->vertex, mask->shape[1].polygon.vertex);
    scene_free(s);
}

static void short_memory(void **state) {
    (void)state;
    fw_status status = FW_NOMEM;
    for (long at = 1; status != FW_OK && at < 3000; at++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        scene_arch(s, 50, 8, 20);
        s->options.bias_m = 0.5 * UM;
        const fw_mask *mask = NULL;
        fw_arena_fail_at(at, 1);
        status = scene_build(s, &mask);
        fw_arena_fail_at(0, 0);
        if (status != FW_OK && status != FW_NOMEM)
            fail_msg("allocation %ld: %s", at, fw_status_text(status));
        scene_free(s);
    }
    assert_int_equal(status, FW_OK);
}

/* what stands on an insulating carrier by itself is left out where there is none */
static void islands_need_a_carrier(void **state) {
    (void)state;
    static const double p[4][2] = {{0, 0}, {80, 0}, {80, 80}, {0, 80}},
                        q[4][2] = {{200, 0}, {250, 0}, {250, 50}, {200, 50}};
    for (int without = 0; without < 2; without++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        scene_add(s, FW_ROLE_STRUCTURE, "body", polygon(s->arena, p, 4));
        scene_add(s, FW_ROLE_STRUCTURE, "stator", polygon(s->arena, q, 4));
        s->piece[1].body = FW_ISLAND;
        s->options.no_islands = without;
        const fw_mask *mask = built(s);
        assert_int_equal(mask->nshape, without ? 1 : 2);
        assert_near(mask->measure[0].area_m2, (without ? 6400 : 8900) * UM * UM, 1e-22);
        scene_free(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bias_has_the_closed_form),
        cmocka_unit_test(text_is_not_biased),
        cmocka_unit_test(joints_share_grid_points),
        cmocka_unit_test(bias_that_closes_is_refused),
        cmocka_unit_test(bias_against_space),
        cmocka_unit_test(random_ring_sectors),
        cmocka_unit_test(turned_corners_are_told),
        cmocka_unit_test(limits),
        cmocka_unit_test(more_vertices_than_a_boundary_takes),
        cmocka_unit_test(short_memory),
        cmocka_unit_test(islands_need_a_carrier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
