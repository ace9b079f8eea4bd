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

/* a plate of nine shapes with slots, holes and letters between them */
static plate *busy(void) {
    plate *p = plate_new(500);
    for (int i = 0; i < 9; i++) {
        double x = 300 * (i % 3) - 300, y = 300 * (i / 3) - 300, w = 60 + 85 * uniform();
        plate_add(p, FW_ROLE_STRUCTURE, i, "odd",
                  i % 3 == 0   ? disc(p, x, y, w)
                  : i % 3 == 1 ? odd(p, x, y, 0.4 * w)
                               : rectangle(p, x - w, y - 140, x + w, y + 140));
    }
    for (int i = 0; i < 12; i++) {
        double x = 800 * (uniform() - 0.5), y = 800 * (uniform() - 0.5), w = 30 * uniform() + 1;
        plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "letter",
                  i % 2 ? disc(p, x, y, w) : rectangle(p, x, y, x + 6 * w, y + w));
    }
    return p;
}

static fw_release_field field_of(plate *p) {
    fw_release_field f;
    fw_release_part *part;
    int *part_of, npart;
    assert_int_equal(fw_release_parts(p->arena, &p->layout, true, &part_of, &part, &npart), FW_OK);
    assert_int_equal(fw_release_field_make(p->arena, &p->layout, part_of, npart, &f), FW_OK);
    assert_int_equal(fw_release_field_start(&f), FW_OK);
    return f;
}

static double nearest_of_all(const fw_release_field *f, fw_geometry_vec2 at) {
    double near = HUGE_VAL;
    for (int i = 0; i < f->nedge; i++)
        if (f->edge[i].open) near = fmin(near, fw_release_edge_distance(&f->edge[i], at));
    return near;
}

/* a row asked at once says of each of its points what the point says */
static void rows_are_those_of_points(void **state) {
    (void)state;
    for (int n = 0; n < 20; n++) {
        plate *p = busy();
        fw_release_field f = field_of(p);
        fw_release_crossing *row =
            fw_arena_array(p->arena, fw_release_crossing, (size_t)f.nclimb + 1);
        for (int k = 0; k < 200; k++) {
            double y = 1e-3 * (uniform() - 0.5), x0 = 1e-3 * (uniform() - 0.5), x1 = x0;
            x1 += 5e-4 * uniform();
            int crossings = fw_release_field_row(&f, y, x0, x1, row);
            for (int i = 0; i < 40; i++) {
                fw_geometry_vec2 at = {x0 + (x1 - x0) * uniform(), y};
                int c = 0;
                while (c < crossings && row[c].x <= at.x)
                    c++;
                assert_int_equal(row[c].part, fw_release_field_part(&f, at));
            }
        }
        fw_arena_free(p->arena);
    }
}

static const fw_release_box *box_about(const fw_release_level *l, fw_geometry_vec2 at) {
    for (int i = 0; i < l->nbox; i++)
        if (fabs(at.x - l->box[i].x) <= l->box[i].half_m &&
            fabs(at.y - l->box[i].y) <= l->box[i].half_m)
            return &l->box[i];
    return NULL;
}

/* every point of material has a box, and the edge that is nearest is in its list, at the beginning and in
   every quarter; and no point is farther from an opening than the box says */
static void boxes_hold_what_they_say(void **state) {
    (void)state;
    int met = 0;
    for (int n = test_cases(100, 12); n > 0; n--) {
        plate *p = busy();
        fw_release_field f = field_of(p);
        for (int k = 0; k < 600; k++) {
            fw_geometry_vec2 at = {1e-3 * (uniform() - 0.5), 1e-3 * (uniform() - 0.5)}, up;
            fw_release_level quarter = {0}, *level = &f.start;
            if (fw_release_field_part(&f, at) < 0) continue;
            double want = nearest_of_all(&f, at), near, rise;
            for (int depth = 0; depth < 5; depth++) {
                const fw_release_box *box = box_about(level, at);
                assert_non_null(box);
                fw_release_nearest(&f, level->list + box->first, box->count, at, HUGE_VAL, &near);
                assert_near(near, want, 0);
                assert_near(box->near_m, nearest_of_all(&f, (fw_geometry_vec2){box->x, box->y}), 0);
                assert_true(want <= fw_release_box_most(&f, level, box, &up, &rise) * (1 + 1e-12));
                fw_release_level next = {0};
                assert_int_equal(fw_release_level_split(&f, level, box, &next), FW_OK);
                quarter = next, level = &quarter;
                met++;
            }
        }
        fw_arena_free(p->arena);
    }
    assert_true(met > 5000);
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

/* of every cell with material the bits of the least of all edges: beside few edges, which are taken together, and many */
static void maps_have_the_bits_of_edges(void **state) {
    (void)state;
    int met = 0;
    for (int n = 0; n < 12; n++) {
        const bool many = n % 2;
        const fw_release_map *m;
        fw_release_field f;
        plate *p = plate_new(300);
        plate_add(p, FW_ROLE_STRUCTURE, 0, "plate", rectangle(p, -280, -270, 290, 260));
        plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "odd", odd(p, -120, -80, 60));
        plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "disc", disc(p, 150 * uniform(), 120, 40));
        for (int i = 0; many && i < 400; i++) { /* in a corner, so that its boxes have more than are taken together */
            double x = 200 + 3 * (i % 20), y = -200 + 3 * (i / 20);
            plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "dot",
                      i % 3 ? rectangle(p, x, y, x + 1, y + 2) : disc(p, x, y, 1));
        }
        int *part_of, npart;
        fw_release_part *part;
        assert_int_equal(fw_release_parts(p->arena, &p->layout, true, &part_of, &part, &npart),
                         FW_OK);
        assert_int_equal(fw_release_field_make(p->arena, &p->layout, part_of, npart, &f), FW_OK);
        assert_int_equal(fw_release_map_make(p->arena, &p->layout, true, 90, &m), FW_OK);
        double cell = (m->box.x1 - m->box.x0) / 90;
        for (int i = 0; i < m->rows * m->columns; i++) {
            fw_geometry_vec2 at = {m->box.x0 + (i % m->columns + 0.5) * cell,
                                   m->box.y0 + (i / m->columns + 0.5) * cell};
            double least = HUGE_VAL;
            if (m->distance_m[i] < 0.0F) continue;
            for (int k = 0; k < f.nedge; k++)
                least = fmin(least, fw_release_edge_distance(&f.edge[k], at));
            assert_true(m->distance_m[i] == (float)least);
            met++;
        }
        fw_arena_free(p->arena);
    }
    assert_true(met > 40000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_of_geometry),
        cmocka_unit_test(parts_are_those_of_contains),
        cmocka_unit_test(rows_are_those_of_points),
        cmocka_unit_test(boxes_hold_what_they_say),
        cmocka_unit_test(maps_are_distances),
        cmocka_unit_test(maps_have_the_bits_of_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
