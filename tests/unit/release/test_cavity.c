/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hollows below what moves, and the ground that is left below what is held. */
#include "fixture.h"
#include "release/release.h"

static uint64_t seed = 5;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static fw_release_cavity made(plate *p, double margin, double wall, double step) {
    fw_release_cavity_asked asked = {margin * UM, wall * UM, step * UM, false};
    fw_release_cavity c;
    assert_int_equal(fw_release_cavity_make(p->arena, &p->layout, &asked, &c), FW_OK);
    return c;
}

static bool is_hollow(const fw_release_cavity *c, fw_geometry_vec2 at) {
    bool in = false;
    for (int i = 0; i < c->hollow.count; i++)
        in = in || fw_geometry_contour_contains(&c->hollow.contour[i], at);
    for (int i = 0; i < c->land.count; i++)
        in = in && !fw_geometry_contour_contains(&c->land.contour[i], at);
    return in;
}

static double distance(const plate *p, fw_geometry_vec2 at) {
    double best = HUGE_VAL;
    fw_geometry_vec2 on;
    for (int i = 0; i < p->layout.npiece; i++) {
        const fw_geometry_contour *c = &p->layout.piece[i].contour;
        if (p->layout.piece[i].body < 0) continue;
        if (fw_geometry_contour_contains(c, at)) return 0.0;
        for (int k = 0; k < c->count; k++)
            best = fmin(best, fw_geometry_segment_nearest(&c->segment[k], at, NULL, &on));
    }
    return best;
}

/* every point within the margin of what moves is hollow, and none that is farther than the corner of a square and the
   step make it */
static void margins_hold(void **state) {
    (void)state;
    const double margin = 40, wall = 30, step = 10;
    for (int n = 0; n < 20; n++) {
        plate *p = plate_new(600);
        for (int i = 0; i < 3; i++) {
            double x = 700 * uniform() - 350, y = 700 * uniform() - 350, r = 20 + 80 * uniform();
            plate_add(p, FW_ROLE_STRUCTURE, i, "body",
                      i % 2 ? disc(p, x, y, r) : rectangle(p, x - r, y - 15, x + r, y + 15));
        }
        fw_release_cavity c = made(p, margin, wall, step);
        for (int k = 0; k < 2000; k++) {
            fw_geometry_vec2 at = {1.1e-3 * (uniform() - 0.5), 1.1e-3 * (uniform() - 0.5)};
            double d = distance(p, at) / UM;
            if (d < margin) assert_true(is_hollow(&c, at));
            if (d > 1.4143 * (margin + 2.5 * step) + wall) assert_false(is_hollow(&c, at));
        }
        for (int i = 0; i < c.hollow.count; i++) { /* on the grid of cells */
            const fw_geometry_contour *o = &c.hollow.contour[i];
            for (int k = 0; k < o->count; k++) {
                double x = o->segment[k].a.x / (step * UM), y = o->segment[k].a.y / (step * UM);
                assert_near(x, nearbyint(x), 1e-6);
                assert_near(y, nearbyint(y), 1e-6);
            }
        }
        fw_arena_free(p->arena);
    }
}

/* a block held within a ring that moves: land below it, of the size that the margin leaves */
static void land_is_left(void **state) {
    (void)state;
    plate *p = plate_new(1000);
    plate_add(p, FW_ROLE_STRUCTURE, FW_ISLAND, "block", rectangle(p, -200, -200, 200, 200));
    const double bar[4][4] = {{-420, -420, 420, -380},
                              {-420, 380, 420, 420},
                              {-420, -380, -380, 380},
                              {380, -380, 420, 380}};
    for (int i = 0; i < 4; i++)
        plate_add(p, FW_ROLE_STRUCTURE, 0, "ring",
                  rectangle(p, bar[i][0], bar[i][1], bar[i][2], bar[i][3]));
    fw_release_cavity c = made(p, 50, 40, 10);
    assert_int_equal(c.hollow.count, 1);
    assert_int_equal(c.land.count, 1);
    fw_geometry_box land = fw_geometry_contour_box(&c.land.contour[0]);
    assert_true(land.x1 - land.x0 >= (760 - 100 - 4 * 10) * UM - 1e-12);
    assert_true(land.x1 - land.x0 <= (760 - 100) * UM + 1e-12);
    assert_int_equal(c.nground, 1);
    assert_string_equal(c.ground[0].label, "block");
    assert_relative(c.ground[0].area_m2, 160e-9, 1e-12);
    /* all of the block but the cells that its edge runs through stands on it */
    assert_true(c.ground[0].square.x1 - c.ground[0].square.x0 >= 370e-6);
    assert_true(c.ground[0].bonded_m2 <= 160e-9 && c.ground[0].bonded_m2 >= 0.85 * 160e-9);
    fw_arena_free(p->arena);
}

/* what is nearer to a moving part than the margin loses its ground */
static void ground_is_lost(void **state) {
    (void)state;
    plate *p = plate_new(1000);
    plate_add(p, FW_ROLE_STRUCTURE, 0, "body", rectangle(p, -300, 0, 300, 40));
    plate_add(p, FW_ROLE_STRUCTURE, FW_ISLAND, "near", rectangle(p, -50, 50, 50, 80));
    plate_add(p, FW_ROLE_STRUCTURE, FW_ISLAND, "far", rectangle(p, -50, 300, 50, 400));
    fw_release_cavity c = made(p, 60, 40, 10);
    assert_int_equal(c.nground, 2);
    assert_near(c.ground[0].bonded_m2, 0.0, 0.0);
    assert_near(c.ground[0].square.x1 - c.ground[0].square.x0, 0.0, 0.0);
    assert_true(c.ground[1].square.x1 - c.ground[1].square.x0 >= 75e-6);
    fw_arena_free(p->arena);
}

/* a hollow within land within a hollow cannot be printed as one layer less another: the land goes, and says so */
static void nested_is_flat(void **state) {
    (void)state;
    plate *p = plate_new(1500);
    const double bar[4][4] = {{-900, -900, 900, -860},
                              {-900, 860, 900, 900},
                              {-900, -860, -860, 860},
                              {860, -860, 900, 860}};
    for (int i = 0; i < 4; i++)
        plate_add(p, FW_ROLE_STRUCTURE, 0, "ring",
                  rectangle(p, bar[i][0], bar[i][1], bar[i][2], bar[i][3]));
    plate_add(p, FW_ROLE_STRUCTURE, FW_ISLAND, "base", rectangle(p, -600, -600, 600, -400));
    plate_add(p, FW_ROLE_STRUCTURE, 1, "inner", rectangle(p, -100, -100, 100, 100));
    fw_release_cavity c = made(p, 50, 40, 10);
    assert_int_equal(c.land.count, 0);
    assert_near(c.ground[0].bonded_m2, 0.0, 0.0);
    fw_arena_free(p->arena);
}

/* the outlines alone are those that come with the ground */
static void outlines_alone(void **state) {
    (void)state;
    plate *p = plate_new(900);
    plate_add(p, FW_ROLE_STRUCTURE, 0, "left", rectangle(p, -300, -300, -250, 300));
    plate_add(p, FW_ROLE_STRUCTURE, 0, "right", disc(p, 200, 100, 90));
    plate_add(p, FW_ROLE_STRUCTURE, FW_GROUND, "base", rectangle(p, -100, -300, 0, -100));
    fw_release_cavity whole = made(p, 40, 30, 10), alone;
    fw_release_cavity_asked asked = {40 * UM, 30 * UM, 10 * UM, true};
    assert_int_equal(fw_release_cavity_make(p->arena, &p->layout, &asked, &alone), FW_OK);
    assert_int_equal(whole.nground, 1);
    assert_int_equal(alone.nground, 0);
    assert_true(alone.widest.x1 == alone.widest.x0);
    assert_true(whole.hollow.count > 0);
    assert_int_equal(alone.hollow.count, whole.hollow.count);
    assert_int_equal(alone.land.count, whole.land.count);
    assert_near(alone.area_m2, whole.area_m2, 0.0);
    fw_arena_free(p->arena);
}

static void nothing_moves(void **state) {
    (void)state;
    plate *p = plate_new(500);
    plate_add(p, FW_ROLE_STRUCTURE, FW_GROUND, "base", rectangle(p, -50, 50, 50, 80));
    fw_release_cavity c = made(p, 60, 40, 10);
    assert_int_equal(c.hollow.count, 0);
    fw_release_cavity_asked fine = {1e-6, 1e-6, 1e-8, false};
    assert_int_equal(fw_release_cavity_make(p->arena, &p->layout, &fine, &c), FW_LIMIT);
    fw_arena_free(p->arena);
}

static void squares_keep_clear(void **state) {
    (void)state;
    plate *p = plate_new(1000);
    plate_add(p, FW_ROLE_STRUCTURE, FW_ISLAND, "pad", rectangle(p, -75, -110, 75, 105));
    plate_add(p, FW_ROLE_TEXT, FW_NONE - 1, "V1", rectangle(p, -40, -100, 40, -60));
    fw_geometry_box b;
    assert_int_equal(fw_release_square_in(p->arena, &p->layout, 0, 10e-6, 5e-6, &b), FW_OK);
    double side = (b.x1 - b.x0) / UM;
    assert_true(side >= 115 && side <= 130);
    assert_true(b.y0 >= -50 * UM - 1e-12 && b.y1 <= 95 * UM + 1e-12);
    assert_true(b.x0 >= -65 * UM - 1e-12 && b.x1 <= 65 * UM + 1e-12);
    fw_arena_free(p->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margins_hold),   cmocka_unit_test(land_is_left),
        cmocka_unit_test(ground_is_lost), cmocka_unit_test(nested_is_flat),
        cmocka_unit_test(nothing_moves),  cmocka_unit_test(squares_keep_clear),
        cmocka_unit_test(outlines_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
