/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The polynomials of a motion, the slack of a pair, and the least clearance against samples. */
#include "base/arena.h"
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include "test.h"

static double chance(uint64_t *seed, double low, double high) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

enum { BODIES = 2 };

typedef struct scene {
    fw_arena *arena;
    fw_clearance_things things;
    fw_clearance_path path;
} scene;

static void box(scene *s, int solid, double x0, double y0, double x1, double y1) {
    fw_clearance_solid *b = &s->things.solid[solid];
    const fw_geometry_vec2 p[5] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
    b->edge = fw_arena_array(s->arena, fw_clearance_edge, 4);
    b->count = 4;
    b->box = (fw_geometry_box){x0, y0, x1, y1};
    b->centre = (fw_geometry_vec2){0.5 * (x0 + x1), 0.5 * (y0 + y1)};
    for (int i = 0; i < 4; i++)
        b->edge[i] = (fw_clearance_edge){.segment = {.kind = FW_LINE, .a = p[i], .b = p[i + 1]},
                                         .hinge = FW_NONE,
                                         .other = FW_NONE,
                                         .held = FW_NONE,
                                         .label = solid == 0   ? "first"
                                                  : solid == 1 ? "second"
                                                               : "ground"};
}

static scene start(void) {
    scene s = {.arena = fw_arena_new(0), .things = {.nbody = BODIES}};
    s.things.solid = fw_arena_array(s.arena, fw_clearance_solid, BODIES + 1);
    assert_int_equal(fw_clearance_path_new(s.arena, BODIES, &s.path), FW_OK);
    return s;
}

/* pieces that go on where the last one ended */
static void wander(scene *s, uint64_t *seed, int pieces, double size, double turn) {
    double last[3 * BODIES];
    for (int b = 0; b < BODIES; b++) {
        last[3 * b] = s->things.solid[b].centre.x;
        last[3 * b + 1] = s->things.solid[b].centre.y;
        last[3 * b + 2] = 0;
    }
    for (int k = 0; k < pieces; k++) {
        double q[FW_PIECE_NODES * 3 * BODIES];
        int nodes = k % 2 ? 6 : FW_PIECE_NODES;
        for (int i = 0; i < nodes; i++)
            for (int c = 0; c < 3 * BODIES; c++) {
                double by = chance(seed, -1, 1) * (c % 3 == 2 ? turn : size) / nodes;
                if (i > 0) last[c] += by;
                q[i * 3 * BODIES + c] = last[c];
            }
        const fw_dynamics_piece piece = {.from_s = k, .to_s = k + 1, .nodes = nodes, .q = q};
        fw_clearance_path_add(&s->path, &piece);
    }
}

static void coefficients_hold_the_polynomial(void **state) {
    (void)state;
    uint64_t seed = 3;
    scene s = start();
    box(&s, 0, 0, 0, 1e-4, 1e-4);
    box(&s, 1, 2e-4, 0, 3e-4, 1e-4);
    wander(&s, &seed, 40, 1e-4, 0.3);
    for (int i = 0; i < 4000; i++) {
        int piece = i % 40, q = i % (3 * BODIES);
        double from = chance(&seed, 0, 1), to = chance(&seed, from, 1), at = chance(&seed, 0, 1);
        double c[FW_CLEARANCE_NODES], low = HUGE_VAL, high = -HUGE_VAL;
        fw_clearance_path_part(&s.path, piece, q, from, to, c);
        for (int k = 0; k < s.path.nodes[piece]; k++) {
            low = fmin(low, c[k]);
            high = fmax(high, c[k]);
        }
        double value = fw_clearance_path_value(&s.path, piece, q, from + at * (to - from));
        assert_true(value >= low - 1e-15 && value <= high + 1e-15);
        assert_near(c[0], fw_clearance_path_value(&s.path, piece, q, from), 1e-14);
        assert_near(c[s.path.nodes[piece] - 1], fw_clearance_path_value(&s.path, piece, q, to),
                    1e-14);
    }
    fw_arena_free(s.arena);
}

static fw_clearance_pose about(uint64_t *seed, fw_clearance_pose p, double size, double turn,
                               double grow) {
    return (fw_clearance_pose){p.x_m + chance(seed, -size, size), p.y_m + chance(seed, -size, size),
                               p.phi_rad + chance(seed, -turn, turn),
                               p.longer + (grow > 0 ? chance(seed, -grow, grow) : 0)};
}

static void slack_bounds_every_pose(void **state) {
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < test_fewest(test_cases(3000, 500), 150); i++) {
        scene s = start();
        box(&s, 0, 0, 0, chance(&seed, 1e-5, 1e-3), chance(&seed, 1e-5, 1e-3));
        box(&s, 1, 1.1e-3, 0, 1.2e-3 + chance(&seed, 0, 1e-3), chance(&seed, 1e-5, 1e-3));
        fw_clearance_pair pair;
        assert_int_equal(fw_clearance_pair_new(s.arena, &s.things, 0, 1, false, &pair), FW_OK);
        fw_clearance_pose middle[2], hull[4][2];
        fw_clearance_slack slack;
        for (int k = 0; k < 2; k++) {
            const fw_clearance_solid *b = &s.things.solid[k ? pair.b : pair.a];
            const fw_clearance_pose rest = {b->centre.x, b->centre.y, 0, 0};
            middle[k] = about(&seed, rest, 1e-5, 0.2, i % 2 ? 0.01 : 0);
        }
        fw_clearance_slack_begin(&pair, (const fw_clearance_pose *)middle, &slack);
        double size = chance(&seed, 0, 1e-4), turn = chance(&seed, 0, 0.3);
        for (int j = 0; j < 4; j++) {
            for (int k = 0; k < 2; k++)
                hull[j][k] = about(&seed, middle[k], size, turn, i % 2 ? 0.05 : 0);
            fw_clearance_slack_add(&pair, (const fw_clearance_pose *)hull[j], &slack);
        }
        double least =
            fw_clearance_pair_distance(&pair, (const fw_clearance_pose *)middle, HUGE_VAL, NULL) -
            fw_clearance_slack_m(&pair, &slack);
        for (int j = 0; j < 20; j++) { /* convex combinations, the same of both */
            double w[4], sum = 0;
            for (int k = 0; k < 4; k++)
                sum += w[k] = chance(&seed, 0, 1);
            fw_clearance_pose at[2] = {{0, 0, 0, 0}, {0, 0, 0, 0}};
            for (int k = 0; k < 4; k++)
                for (int b = 0; b < 2; b++) {
                    at[b].x_m += w[k] / sum * hull[k][b].x_m;
                    at[b].y_m += w[k] / sum * hull[k][b].y_m;
                    at[b].phi_rad += w[k] / sum * hull[k][b].phi_rad;
                    at[b].longer += w[k] / sum * hull[k][b].longer;
                }
            double d =
                fw_clearance_pair_distance(&pair, (const fw_clearance_pose *)at, HUGE_VAL, NULL);
            assert_true(d >= least - 1e-15);
        }
        fw_arena_free(s.arena);
    }
}

/* one side of a box as an arc, bulging or hollow */
static void bend(scene *s, uint64_t *seed, int solid) {
    fw_geometry_segment *side = &s->things.solid[solid].edge[(int)chance(seed, 0, 4)].segment;
    const double chord = vec_distance(side->a, side->b);
    const double radius = chord * chance(seed, 0.6, 4), h = sqrt(radius * radius - chord * chord / 4);
    const fw_geometry_vec2 left = vec_left(vec_unit(vec_sub(side->b, side->a)));
    const int turn = chance(seed, 0, 1) < 0.5 ? -1 : 1; /* the smaller part of the circle */
    side->kind = FW_ARC;
    side->radius = radius;
    side->sweep_rad = 2 * turn * asin(0.5 * chord / radius);
    side->centre = vec_along(vec_scale(0.5, vec_add(side->a, side->b)), turn * h, left);
    assert_true(fw_geometry_segment_valid(side));
}

/* what the direction proves holds at every pose between those of the hull, of each solid by itself where it says so, and
   within the rests; where a
   region is small, and no edge hollow, it is the distance to first order, which the slack is not */
static void direction_bounds_every_pose(void **state) {
    (void)state;
    uint64_t seed = 29;
    int better = 0, straight = 0;
    for (int i = 0; i < test_fewest(test_cases(6000, 1000), 300); i++) {
        scene s = start();
        const bool lines = i % 2;
        box(&s, 0, 0, 0, chance(&seed, 1e-5, 1e-3), chance(&seed, 1e-5, 1e-3));
        box(&s, 1, 1.1e-3, 0, 1.2e-3 + chance(&seed, 0, 1e-3), chance(&seed, 1e-5, 1e-3));
        for (int k = 0; k < 2 && !lines; k++)
            bend(&s, &seed, k);
        fw_clearance_pair pair;
        assert_int_equal(fw_clearance_pair_new(s.arena, &s.things, 0, 1, false, &pair), FW_OK);
        fw_clearance_hull hull = {.count = 4, .apart = i % 5 == 0};
        fw_clearance_slack slack;
        fw_clearance_meet meet;
        const double size = pow(10, chance(&seed, -8, -4)), turn = 1e3 * size;
        const double grow = i % 7 == 0 ? turn : 0; /* which is in the rests, not in the direction */
        for (int k = 0; k < 2; k++) {
            const fw_clearance_solid *b = &s.things.solid[k ? pair.b : pair.a];
            hull.middle[k] =
                about(&seed, (fw_clearance_pose){b->centre.x, b->centre.y, 0, 0}, 1e-5, 0.2, 0);
            hull.rest_m[k] = i % 3 ? 0 : chance(&seed, 0, size);
            hull.rest_rad[k] = i % 3 ? 0 : chance(&seed, 0, turn);
        }
        const fw_clearance_pose *middle = hull.middle;
        fw_clearance_slack_begin(&pair, middle, &slack);
        for (int j = 0; j < hull.count; j++)
            for (int k = 0; k < 2; k++)
                hull.pose[j][k] = about(&seed, middle[k], size, turn, grow);
        for (int j = 0; j < hull.count; j++)
            for (int l = 0; l < hull.count; l++) {
                const fw_clearance_pose both[2] = {hull.pose[j][0], hull.pose[l][1]};
                if (j == l || hull.apart) fw_clearance_slack_add(&pair, both, &slack);
            }
        const double d = fw_clearance_pair_distance(&pair, middle, HUGE_VAL, &meet);
        if (d <= 0) {
            fw_arena_free(s.arena);
            continue;
        }
        int where;
        double there, slack_m = fw_clearance_slack_m(&pair, &slack);
        for (int k = 0; k < 2; k++)
            slack_m += hull.rest_m[k] + hull.rest_rad[k] * 1e-2;
        const double edges = fw_clearance_edges_bound(&pair, &hull, &meet, &where, &there);
        double needed = d - chance(&seed, 0, 1) * slack_m;
        const double all = fw_clearance_pair_bound(&pair, &hull, slack_m, needed);
        if (i % 3 && grow == 0) straight += lines, better += lines && edges > d - slack_m;
        assert_true(all <= needed);
        for (int j = 0; j < 30; j++) {
            double w[4], sum = 0;
            fw_clearance_pose at[2] = {{0, 0, 0, 0}, {0, 0, 0, 0}};
            fw_clearance_pair own = pair;
            for (int b = 0; b < 2; b++) {
                for (int k = 0; k < 4 && (b == 0 || hull.apart); k++)
                    sum = (k ? sum : 0) + (w[k] = pow(chance(&seed, 0, 1), 4));
                for (int k = 0; k < 4; k++) {
                    at[b].x_m += w[k] / sum * hull.pose[k][b].x_m;
                    at[b].y_m += w[k] / sum * hull.pose[k][b].y_m;
                    at[b].phi_rad += w[k] / sum * hull.pose[k][b].phi_rad;
                    at[b].longer += w[k] / sum * hull.pose[k][b].longer;
                }
                at[b] = about(&seed, at[b], hull.rest_m[b] / 1.5, hull.rest_rad[b], 0);
            }
            const double now = fw_clearance_pair_distance(&pair, at, HUGE_VAL, NULL);
            if (isfinite(all)) assert_true(now >= all - 1e-15);
            for (int k = 0; k < 2; k++) /* of those two edges alone */
                own.edge[k] = (const fw_clearance_edge **)&meet.edge[k], own.count[k] = 1;
            fw_clearance_pair_boxes(&own);
            assert_true(fw_clearance_pair_distance(&own, at, HUGE_VAL, NULL) >= edges - 1e-15);
        }
        fw_arena_free(s.arena);
    }
    assert_true(better > straight * 9 / 10);
}

static const fw_clearance_wish closely = {
    .relative = 1e-6, .enough_m = HUGE_VAL, .most = 100000, .most_ever = 100000};

typedef struct samples {
    double least_m, first_s; /* HUGE_VAL: no sample met */
    int a, b;                /* of the first meeting */
} samples;

static samples sampled(const scene *s, int pieces, int each) {
    samples is = {.least_m = HUGE_VAL, .first_s = HUGE_VAL};
    for (int a = 0; a < BODIES; a++)
        for (int b = a + 1; b <= BODIES; b++) {
            fw_clearance_pair pair;
            if (s->things.solid[b].count == 0) continue;
            assert_int_equal(fw_clearance_pair_new(s->arena, &s->things, a, b, false, &pair),
                             FW_OK);
            for (int i = 0; i <= pieces * each; i++) {
                int piece = i / each < pieces ? i / each : pieces - 1;
                double theta = (double)i / each - piece, t_s = piece + theta;
                fw_clearance_pose pose[2];
                fw_clearance_pair_at(&pair, &s->path, piece, theta, pose);
                double d = fw_clearance_pair_distance(&pair, (const fw_clearance_pose *)pose,
                                                      HUGE_VAL, NULL);
                is.least_m = fmin(is.least_m, d);
                if (d <= 0 && t_s < is.first_s) is.first_s = t_s, is.a = a, is.b = b;
            }
        }
    return is;
}

/* the samples are never below the proved bound, and the least is what they come near */
static void least_is_that_of_dense_samples(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < test_cases(60, 10); i++) {
        enum { PIECES = 37 };
        scene s = start();
        box(&s, 0, 0, 0, 3e-4, 1e-4);
        box(&s, 1, 5e-4, 0, 6e-4, 7e-4);
        box(&s, 2, -1e-4, -4e-4, 1e-3, -3e-4);
        wander(&s, &seed, PIECES, 1e-4, 0.2);
        fw_clearance_least least = fw_clearance_nothing();
        assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &closely, &least),
                         FW_OK);
        double seen = sampled(&s, PIECES, 400).least_m;
        assert_true(least.known && !least.given_up);
        if (least.m > 0) {
            assert_true(least.m - least.low_m <= 1.001e-9);
            assert_true(seen >= least.low_m - 1e-15);
            assert_near(least.m, seen, 1e-7); /* what 400 samples of a piece miss */
            assert_true(least.m <= seen + 1e-9);
        }
        fw_arena_free(s.arena);
    }
}

/* Two bodies that swing along a wall and along each other, a thousandth as far towards them: the whole motion is proved in
   some tens of looks, however often they swing. */
static void what_slides_is_proved_as_a_whole(void **state) {
    (void)state;
    enum { PIECES = 400 };
    scene s = start();
    box(&s, 0, 0, 0, 3e-4, 1e-4);
    box(&s, 1, 0, 1.1e-4, 3e-4, 2e-4);
    box(&s, BODIES, -1e-3, -1e-4, 1e-3, -1e-5);
    for (int k = 0; k < PIECES; k++) {
        double q[FW_PIECE_NODES * 3 * BODIES] = {0};
        for (int i = 0; i < FW_PIECE_NODES; i++) {
            const double t = k + (double)i / (FW_PIECE_NODES - 1);
            for (int b = 0; b < 2; b++) {
                double *at = q + i * 3 * BODIES + 3 * b;
                const double x = 5e-5 * sin((b ? 0.31 : 0.2) * t);
                at[0] = s.things.solid[b].centre.x + x;
                at[1] = s.things.solid[b].centre.y - 20 * x * x;
            }
        }
        const fw_dynamics_piece piece = {.from_s = k, .to_s = k + 1, .nodes = FW_PIECE_NODES, .q = q};
        fw_clearance_path_add(&s.path, &piece);
    }
    fw_clearance_wish wish = closely;
    wish.relative = 2e-2;
    fw_clearance_least least = fw_clearance_nothing();
    assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &wish, &least), FW_OK);
    assert_true(least.known && !least.given_up);
    const double seen = sampled(&s, PIECES, 20).least_m;
    assert_true(seen >= least.low_m && least.m <= 1.03 * seen && least.m >= seen - 1e-11);
    if (least.looked > 100) fail_msg("%ld distances", least.looked);
    fw_arena_free(s.arena);
}

/* a bar that passes a post between two nodes: none of the instants that are looked at sees it */
static void what_meets_between_samples_is_found(void **state) {
    (void)state;
    for (int touch = 0; touch < 2; touch++) {
        scene s = start();
        box(&s, 0, 0, 0, 1e-5, 1e-4);
        box(&s, 1, 5.2e-4, touch ? 9e-5 : 1.01e-4, 5.3e-4, 2e-4);
        double q[FW_PIECE_NODES * 3 * BODIES] = {0};
        for (int i = 0; i < FW_PIECE_NODES; i++) {
            double *at = q + i * 3 * BODIES;
            at[0] = 5e-6 + 1e-3 * i / (FW_PIECE_NODES - 1);
            at[1] = 5e-5;
            at[3] = s.things.solid[1].centre.x;
            at[4] = s.things.solid[1].centre.y;
        }
        const fw_dynamics_piece piece = {.from_s = 0, .to_s = 7, .nodes = FW_PIECE_NODES, .q = q};
        fw_clearance_path_add(&s.path, &piece);
        fw_clearance_least least = fw_clearance_nothing();
        assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &closely, &least),
                         FW_OK);
        if (touch) {
            assert_true(least.m <= 0);
            assert_near(least.t_s, 7 * 0.51, 1e-3); /* where the right side of the bar arrives */
            assert_near(least.share, 0.51, 1e-3);
        } else {
            assert_near(least.m, 1e-6, 1e-9);
        }
        fw_arena_free(s.arena);
    }
}

/* a body goes towards a post and turns back: the share is of the way that it goes, not of a bound of that, in one path and
   where the farther part of the motion comes in a path of its own */
static void a_share_is_of_what_the_motion_does(void **state) {
    (void)state;
    const double far_m = 1e-3, way_m = 8e-4;
    for (int parts = 1; parts <= 2; parts++) {
        scene s = start();
        box(&s, 0, 0, 0, 1e-5, 1e-4);
        box(&s, 1, 1e-5 + way_m, 0, 1e-4 + way_m, 2e-4);
        fw_clearance_least least = fw_clearance_nothing();
        for (int part = 0; part < parts; part++) {
            double q[FW_PIECE_NODES * 3 * BODIES] = {0};
            const double to_m = part + 1 < parts ? 0.9 * far_m : far_m;
            for (int i = 0; i < FW_PIECE_NODES; i++) {
                double *at = q + i * 3 * BODIES, t = (double)i / (FW_PIECE_NODES - 1);
                at[0] = s.things.solid[0].centre.x + to_m * 4 * t * (1 - t);
                at[1] = s.things.solid[0].centre.y;
                at[3] = s.things.solid[1].centre.x;
                at[4] = s.things.solid[1].centre.y;
            }
            const fw_dynamics_piece piece = {
                .from_s = part, .to_s = part + 1, .nodes = FW_PIECE_NODES, .q = q};
            fw_clearance_path_add(&s.path, &piece);
            assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &closely, &least),
                             FW_OK);
            s.path.npiece = 0;
        }
        assert_true(least.m <= 0 && least.moved_m >= far_m);
        assert_near(least.went_m, far_m, 1e-9);
        assert_near(least.share, way_m / far_m, 1e-5);
        fw_arena_free(s.arena);
    }
}

/* Of several pairs that meet the one that meets first is named, at its instant: a body that wanders between two
   walls meets both. */
static void first_of_several_meetings(void **state) {
    (void)state;
    uint64_t seed = 21;
    int several = 0;
    for (int i = 0; i < test_cases(100, 20); i++) {
        enum { PIECES = 60 };
        scene s = start();
        box(&s, 0, 0, 0, 1e-4, 1e-4);
        box(&s, 1, 1.5e-4, 0, 2.5e-4, 1e-4);
        box(&s, 2, -1e-4, -2.5e-4, 1e-3, -0.5e-4);
        wander(&s, &seed, PIECES, 1.2e-4, 0.3);
        fw_clearance_least least = fw_clearance_nothing();
        assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &closely, &least),
                         FW_OK);
        const samples is = sampled(&s, PIECES, 200);
        if (isfinite(is.first_s)) {
            assert_true(least.m <= 0);
            assert_true(least.t_s <= is.first_s + 1e-9);
            /* but for a brush that no sample saw */
            if (least.t_s > is.first_s - 0.02) {
                several++;
                assert_int_equal(least.a, is.a);
                assert_int_equal(least.b == FW_GROUND ? BODIES : least.b, is.b);
            }
        }
        fw_arena_free(s.arena);
    }
    assert_true(several > test_cases(60, 10));
}

/* A tooth that slides along a wall at a gap of 2 um and goes to its root: nearest is the wall, which loses nothing;
   the root comes nearer by `by` of the 40 um that there are. */
static void what_takes_most_of_its_way(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        const double by = 10e-6 + 5e-6 * i, within = i % 2 ? 1e-6 : 0;
        scene s = start();
        box(&s, 0, 0, 0, 100e-6, 10e-6);
        box(&s, 1, 2e-3, 2e-3, 2.1e-3, 2.1e-3);
        box(&s, 2, 140e-6, -20e-6, 150e-6, 50e-6);
        fw_clearance_solid *ground = &s.things.solid[2];
        fw_clearance_edge *more = fw_arena_array(s.arena, fw_clearance_edge, 5);
        for (int k = 0; k < 4; k++)
            more[k] = ground->edge[k];
        more[4] = more[0];
        more[4].label = "wall";
        more[4].segment.a = (fw_geometry_vec2){-100e-6, 12e-6};
        more[4].segment.b = (fw_geometry_vec2){139e-6, 12e-6};
        ground->edge = more;
        ground->count = 5;
        ground->box.x0 = -100e-6;
        double q[FW_PIECE_NODES * 3 * BODIES];
        for (int n = 0; n < FW_PIECE_NODES; n++)
            for (int b = 0; b < BODIES; b++) {
                double *to = q + (n * BODIES + b) * 3;
                to[0] = s.things.solid[b].centre.x;
                to[1] = s.things.solid[b].centre.y;
                to[2] = 0;
                if (b == 0) to[0] += by * n / (FW_PIECE_NODES - 1);
            }
        const fw_dynamics_piece piece = {.from_s = 0, .to_s = 7, .nodes = FW_PIECE_NODES, .q = q};
        fw_clearance_path_add(&s.path, &piece);
        fw_clearance_least least = fw_clearance_nothing();
        assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &closely, &least),
                         FW_OK);
        assert_near(least.m, 2e-6, 1e-9);
        fw_clearance_way way = {.share = 0.2};
        assert_int_equal(
            fw_clearance_way_of_path(s.arena, &s.things, &s.path, &closely, within, &way), FW_OK);
        assert_string_equal(way.b, "ground");
        assert_near(way.share, by / (40e-6 - within), 3e-3);
        assert_near(way.t_s, 7, 1e-12);
        way = (fw_clearance_way){.share = by / (40e-6 - within) + 0.01};
        assert_int_equal(
            fw_clearance_way_of_path(s.arena, &s.things, &s.path, &closely, within, &way), FW_OK);
        assert_null(way.a); /* no share is larger than that which was asked about */
        fw_arena_free(s.arena);
    }
}

/* more pieces than fit are looked at in parts, with the same end */
static void enough_is_enough(void **state) {
    (void)state;
    uint64_t seed = 9;
    scene s = start();
    box(&s, 0, 0, 0, 3e-4, 1e-4);
    box(&s, 1, 8e-4, 0, 9e-4, 7e-4);
    wander(&s, &seed, 50, 5e-5, 0.05);
    fw_clearance_least least = fw_clearance_nothing(), brief = least;
    assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &closely, &least), FW_OK);
    fw_clearance_wish wish = closely;
    wish.enough_m = 1e-6;
    assert_int_equal(fw_clearance_of_path(s.arena, &s.things, &s.path, &wish, &brief), FW_OK);
    assert_true(least.m > 1e-5 && brief.low_m >= 1e-6);
    assert_true(brief.looked < least.looked);
    fw_arena_free(s.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coefficients_hold_the_polynomial),
        cmocka_unit_test(slack_bounds_every_pose),
        cmocka_unit_test(direction_bounds_every_pose),
        cmocka_unit_test(least_is_that_of_dense_samples),
        cmocka_unit_test(what_slides_is_proved_as_a_whole),
        cmocka_unit_test(what_meets_between_samples_is_found),
        cmocka_unit_test(a_share_is_of_what_the_motion_does),
        cmocka_unit_test(first_of_several_meetings),
        cmocka_unit_test(what_takes_most_of_its_way),
        cmocka_unit_test(enough_is_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
