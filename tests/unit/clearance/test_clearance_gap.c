/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distance of two outlines at a pose, and its extremes over pieces of a motion, against samples. */
#include "base/arena.h"
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include "test.h"

enum { BODIES = 2, NQ = 3 * BODIES };

static double chance(uint64_t *seed, double low, double high) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

typedef struct scene {
    fw_arena *arena;
    fw_clearance_things things;
    fw_clearance_path path;
} scene;

static fw_clearance_edge edge(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return (fw_clearance_edge){.segment = {.kind = FW_LINE, .a = a, .b = b},
                               .hinge = FW_NONE,
                               .other = FW_NONE,
                               .held = FW_NONE,
                               .label = "side"};
}

static void box(scene *s, int solid, double x0, double y0, double x1, double y1) {
    fw_clearance_solid *b = &s->things.solid[solid];
    const fw_geometry_vec2 p[5] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
    b->edge = fw_arena_array(s->arena, fw_clearance_edge, 8);
    b->count = 4;
    b->box = (fw_geometry_box){x0, y0, x1, y1};
    b->centre = (fw_geometry_vec2){0.5 * (x0 + x1), 0.5 * (y0 + y1)};
    for (int i = 0; i < 4; i++)
        b->edge[i] = edge(p[i], p[i + 1]);
}

static scene start(void) {
    scene s = {.arena = fw_arena_new(0), .things = {.nbody = BODIES}};
    s.things.solid = fw_arena_array(s.arena, fw_clearance_solid, BODIES + 1);
    assert_int_equal(fw_clearance_path_of(s.arena, BODIES, 1, &s.path), FW_OK);
    return s;
}

static const fw_clearance_gap *gap_of(scene *s, int a, int b) {
    const fw_clearance_gap *gap;
    assert_int_equal(fw_clearance_gap_new(s->arena, &s->things, a, b, &gap), FW_OK);
    return gap;
}

static void drawn_q(const scene *s, double q[NQ]) {
    for (int b = 0; b < BODIES; b++) {
        q[3 * b] = s->things.solid[b].centre.x;
        q[3 * b + 1] = s->things.solid[b].centre.y;
        q[3 * b + 2] = s->things.solid[b].turned_rad;
    }
}

/* two squares whose corners face each other: sqrt(2) of 30 um */
static void distance_at_a_pose(void **state) {
    (void)state;
    scene s = start();
    double q[NQ];
    box(&s, 0, 0, 0, 1e-4, 1e-4);
    box(&s, 1, 1.3e-4, 1.3e-4, 3e-4, 2e-4);
    box(&s, 2, 0, -2e-4, 1e-4, -1.2e-4);
    drawn_q(&s, q);
    const fw_clearance_gap *gap = gap_of(&s, 0, 1), *below = gap_of(&s, 0, FW_GROUND);
    assert_near(fw_clearance_gap_m(gap, q, 0), 30e-6 * sqrt(2), 1e-15);
    assert_near(fw_clearance_gap_drawn_m(gap), 30e-6 * sqrt(2), 1e-15);
    assert_near(fw_clearance_gap_m(below, q, 0), 120e-6, 1e-15);
    assert_true(fw_clearance_gap_moved_m(below, q, 0) == 0);
    assert_near(fw_clearance_gap_m(below, q, 0.01), 119.5e-6, 1e-15); /* about its middle */
    assert_near(fw_clearance_gap_moved_m(below, q, 0.01), 0.01 * hypot(5e-5, 5e-5), 1e-15);
    q[1] -= 20e-6;
    assert_near(fw_clearance_gap_m(below, q, 0), 100e-6, 1e-15);
    assert_near(fw_clearance_gap_moved_m(below, q, 0), 20e-6, 1e-15);
    q[1] -= 130e-6;
    assert_true(fw_clearance_gap_m(below, q, 0) == 0); /* they cross */
    fw_arena_free(s.arena);
}

/* a flexure's disc and the die's edge are no outline, what nothing is drawn of has none, and what
   lies in a hinge between the two is the hinge's */
static void what_is_no_outline(void **state) {
    (void)state;
    scene s = start();
    box(&s, 0, 0, 0, 1e-4, 1e-4);
    box(&s, 1, 2e-4, 0, 3e-4, 1e-4);
    fw_clearance_solid *b = &s.things.solid[1];
    b->edge[4] = edge((fw_geometry_vec2){1.1e-4, 0}, (fw_geometry_vec2){1.1e-4, 1e-4});
    b->edge[5] = b->edge[6] = b->edge[4];
    b->edge[4].bends = true;
    b->edge[5].always = true;
    b->edge[6].hinge = 0, b->edge[6].other = 0;
    b->count = 7;
    assert_near(fw_clearance_gap_drawn_m(gap_of(&s, 0, 1)), 1e-4, 1e-15);
    assert_null(gap_of(&s, 0, FW_GROUND));
    for (int i = 0; i < b->count; i++)
        b->edge[i].other = 0;
    assert_null(gap_of(&s, 0, 1));
    fw_arena_free(s.arena);
}

/* a piece of a random motion, into the path */
static void wander(scene *s, uint64_t *seed, double last[NQ], double size, double turn) {
    double q[FW_PIECE_NODES * NQ];
    for (int i = 0; i < FW_PIECE_NODES; i++)
        for (int c = 0; c < NQ; c++) {
            double by = chance(seed, -1, 1) * (c % 3 == 2 ? turn : size) / FW_PIECE_NODES;
            if (i > 0) last[c] += by;
            q[i * NQ + c] = last[c];
        }
    const fw_dynamics_piece piece = {.from_s = 3, .to_s = 5, .nodes = FW_PIECE_NODES, .q = q};
    s->path.npiece = 0;
    fw_clearance_path_add(&s->path, &piece);
}

static double at(const scene *s, const fw_clearance_gap *gap, double theta) {
    double q[NQ];
    for (int c = 0; c < NQ; c++)
        q[c] = fw_clearance_path_value(&s->path, 0, c, theta);
    return fw_clearance_gap_m(gap, q, 0);
}

static void extremes_are_those_of_dense_samples(void **state) {
    (void)state;
    enum { SAMPLES = 4000 };
    uint64_t seed = 19;
    int inside = 0;
    for (int i = 0; i < test_cases(200, 40); i++) {
        scene s = start();
        double q[NQ];
        box(&s, 0, 0, 0, 3e-4, 1e-4);
        box(&s, 1, 4e-4, chance(&seed, -1e-4, 1e-4), 6e-4, 5e-4);
        box(&s, 2, -1e-4, -4e-4, 1e-3, -3e-4);
        drawn_q(&s, q);
        wander(&s, &seed, q, 3e-4, i % 2 ? 1.0 : 0.05);
        const fw_clearance_gap *gap = gap_of(&s, 0, i % 3 ? 1 : FW_GROUND);
        fw_clearance_gap_extreme found[2];
        double low = HUGE_VAL, high = 0, when[2] = {0, 0};
        for (int k = 0; k <= SAMPLES; k++) {
            double d = at(&s, gap, (double)k / SAMPLES);
            if (d < low) low = d, when[0] = 3 + 2.0 * k / SAMPLES;
            if (d > high) high = d, when[1] = 3 + 2.0 * k / SAMPLES;
        }
        for (int k = 0; k < 2; k++) { /* what an observer knows: both ends */
            double a = at(&s, gap, 0), b = at(&s, gap, 1);
            found[k] = (fw_clearance_gap_extreme){.m = k ? fmax(a, b) : fmin(a, b),
                                                  .t_s = (a < b) == (k == 0) ? 3 : 5};
            found[k].bound_m = found[k].m;
            fw_clearance_gap_over(gap, &s.path, k ? 1 : -1, &found[k]);
            assert_true(fabs(found[k].bound_m - found[k].m) <=
                        fmax(1e-9, 1e-3 * found[k].m) + 1e-15);
        }
        assert_true(low >= found[0].bound_m - 1e-15);
        assert_true(high <= found[1].bound_m + 1e-15);
        /* found at a pose: what it says is so there */
        assert_near(at(&s, gap, 0.5 * (found[0].t_s - 3)), found[0].m, 1e-15);
        assert_near(at(&s, gap, 0.5 * (found[1].t_s - 3)), found[1].m, 1e-15);
        inside += when[0] > 3 && when[0] < 5;
        inside += when[1] > 3 && when[1] < 5;
        fw_arena_free(s.arena);
    }
    assert_true(inside > 20);
}

/* two teeth pass each other between two ends that are far apart: a minimum with a kink, and the
   largest distance between two minima */
static void kinks_are_found(void **state) {
    (void)state;
    scene s = start();
    box(&s, 0, 0, 0, 1e-5, 1e-4);
    box(&s, 1, 5.2e-4, 1.01e-4, 5.3e-4, 2e-4);
    double q[FW_PIECE_NODES * NQ] = {0};
    for (int i = 0; i < FW_PIECE_NODES; i++) {
        q[i * NQ] = 5e-6 + 1e-3 * i / (FW_PIECE_NODES - 1);
        q[i * NQ + 1] = 5e-5;
        q[i * NQ + 3] = s.things.solid[1].centre.x;
        q[i * NQ + 4] = s.things.solid[1].centre.y;
    }
    const fw_dynamics_piece piece = {.from_s = 0, .to_s = 7, .nodes = FW_PIECE_NODES, .q = q};
    fw_clearance_path_add(&s.path, &piece);
    const fw_clearance_gap *gap = gap_of(&s, 0, 1);
    fw_clearance_gap_extreme least = {.m = at(&s, gap, 1), .bound_m = HUGE_VAL, .t_s = 7};
    fw_clearance_gap_over(gap, &s.path, -1, &least);
    assert_near(least.m, 1e-6, 1.001e-9);
    assert_near(least.t_s, 7 * 0.52, 7 * 0.011);
    assert_near(least.moved_m, 1e-3, 1e-9);
    fw_arena_free(s.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_at_a_pose),
        cmocka_unit_test(what_is_no_outline),
        cmocka_unit_test(extremes_are_those_of_dense_samples),
        cmocka_unit_test(kinks_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
