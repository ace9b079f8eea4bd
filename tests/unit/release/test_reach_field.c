/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distances from edges, and which part a point belongs to. */
#include "fixture.h"

static uint64_t seed = 11;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* lines and arcs of every sweep, convex and concave */
static fw_geometry_contour odd(plate *p, double x, double y, double size) {
    fw_geometry_contour c;
    fw_geometry_vec2 at = {(x - size) * UM, y * UM};
    fw_geometry_outline o = fw_geometry_outline_start(p->arena, at);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){(x + size) * UM, y * UM}, 0);
    double r = size * (0.3 + 0.6 * uniform()), sweep = 0.3 + 5.5 * uniform();
    fw_geometry_vec2 from = o.at;
    for (int k = 0; k < 2; k++) { /* an arc that bulges out, then one that goes in */
        double turn = k ? -0.6 * sweep : sweep, start = 0.2 + 2 * uniform();
        fw_geometry_vec2 centre = {from.x - r * UM * cos(start), from.y - r * UM * sin(start)};
        fw_geometry_outline_arc(&o, centre, turn, 0);
        from = o.at;
    }
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

static void distances_are_those_of_geometry(void **state) {
    (void)state;
    for (int n = 0; n < 50; n++) {
        plate *p = plate_new(500);
        fw_release_field f;
        int part_of = 0;
        plate_add(p, FW_ROLE_STRUCTURE, 0, "odd", odd(p, 0, 0, 80));
        assert_int_equal(fw_release_field_make(p->arena, &p->layout, &part_of, 1, &f), FW_OK);
        for (int k = 0; k < 100; k++) {
            fw_geometry_vec2 at = {6e-4 * (uniform() - 0.5), 6e-4 * (uniform() - 0.5)}, want;
            for (int i = 0; i < f.nedge; i++) {
                double d = fw_geometry_segment_nearest(&p->layout.piece[0].contour.segment[i], at,
                                                       NULL, &want);
                assert_near(fw_release_edge_distance(&f.edge[i], at), d, 1e-15);
                assert_near(vec_distance(at, fw_release_edge_foot(&f.edge[i], at)), d, 1e-15);
                /* and the circle around it holds it */
                double far = vec_distance(want, f.edge[i].about);
                assert_true(far <= f.edge[i].around * (1 + 1e-12) + 1e-15);
            }
        }
        fw_arena_free(p->arena);
    }
}

static void parts_are_those_of_contains(void **state) {
    (void)state;
    plate *p = plate_new(500);
    for (int i = 0; i < 9; i++) {
        double x = 300 * (i % 3) - 300, y = 300 * (i / 3) - 300;
        plate_add(p, FW_ROLE_STRUCTURE, i, "odd",
                  i % 2 ? disc(p, x, y, 70) : rectangle(p, x - 70, y - 60, x + 70, y + 60));
    }
    plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "letter", disc(p, 0, 0, 20));
    int *part_of, npart, hits = 0;
    fw_release_part *part;
    fw_release_field f;
    assert_int_equal(fw_release_parts(p->arena, &p->layout, true, &part_of, &part, &npart), FW_OK);
    assert_int_equal(npart, 9);
    assert_int_equal(fw_release_field_make(p->arena, &p->layout, part_of, npart, &f), FW_OK);
    for (int k = 0; k < 20000; k++) {
        fw_geometry_vec2 at = {1e-3 * (uniform() - 0.5), 1e-3 * (uniform() - 0.5)};
        /* and at the heights of corners, tops and bottoms of circles */
        if (k % 4 == 0) at.y = (300 * (k % 3) - 300 + (k % 8 ? 70 : -60)) * UM;
        int want = FW_RELEASE_OPENING;
        for (int i = 0; i < 9; i++)
            if (fw_geometry_contour_contains(&p->layout.piece[i].contour, at)) want = i;
        if (fw_geometry_contour_contains(&p->layout.piece[9].contour, at))
            want = FW_RELEASE_OPENING;
        assert_int_equal(fw_release_field_part(&f, at), want);
        hits += want >= 0;
    }
    assert_true(hits > 2000);
    fw_arena_free(p->arena);
}

/* cells of a map have the distance of their middles */
static void maps_are_distances(void **state) {
    (void)state;
    const fw_release_map *m;
    plate *p = plate_new(200);
    plate_add(p, FW_ROLE_STRUCTURE, 0, "disc", disc(p, 10, -20, 150));
    plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "hole", disc(p, 10, -20, 40));
    assert_int_equal(fw_release_map_make(p->arena, &p->layout, true, 100, &m), FW_OK);
    assert_int_equal(m->columns, 100);
    assert_int_equal(m->rows, 100);
    for (int i = 0; i < 10000; i++) {
        double x = m->box.x0 + (i % 100 + 0.5) * 4 * UM, y = m->box.y0 + (i / 100 + 0.5) * 4 * UM;
        double r = hypot(x - 10 * UM, y + 20 * UM), want = fmin(150 * UM - r, r - 40 * UM);
        if (want > 1e-12) assert_near((double)m->distance_m[i], want, 1e-10);
        if (want < -1e-12) assert_true(m->distance_m[i] < 0);
    }
    fw_arena_free(p->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_of_geometry),
        cmocka_unit_test(parts_are_those_of_contains),
        cmocka_unit_test(maps_are_distances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
