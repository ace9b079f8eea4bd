/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a bent strip can be, against strips that are bent at random. */
#include "base/arena.h"
#include "clearance/clearance.h"
#include "geometry/segment.h"
#include "test.h"

enum { STEPS = 200 };
static const double LENGTH = 400e-6, WIDTH = 8e-6;

static double chance(uint64_t *seed, double low, double high) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* a straight strip along +y from the lower root at y = -L/2 to the upper one; W is the origin */
typedef struct leaf {
    fw_layout_hinge_layout hinge;
    fw_clearance_strip_part part[2];
    fw_clearance_strip strip;
} leaf;

static void leaf_of(leaf *l) {
    const double w = 0.5 * WIDTH, h = 0.5 * LENGTH;
    const fw_geometry_vec2 p[4] = {{w, -h}, {w, h}, {-w, h}, {-w, -h}};
    *l = (leaf){.hinge = {.drawn = true, .lower = 0, .upper = 1}};
    l->part[0] = (fw_clearance_strip_part){{.kind = FW_LINE, .a = p[0], .b = p[1]}, 0, LENGTH};
    l->part[1] = (fw_clearance_strip_part){{.kind = FW_LINE, .a = p[2], .b = p[3]}, LENGTH, 0};
    l->strip = (fw_clearance_strip){
        .known = true, .hinge = &l->hinge, .part = l->part, .count = 2, .length_m = LENGTH};
}

/* places of both edges (side -1, +1) with the curvature's change at each step, seen from the lower
   root */
static void bent(const double *curvature, fw_geometry_vec2 edge[2][STEPS + 1], double *turn) {
    fw_geometry_vec2 at = {0, -0.5 * LENGTH};
    double phi = 0, h = LENGTH / STEPS;
    for (int i = 0; i <= STEPS; i++) {
        for (int side = 0; side < 2; side++) {
            double off = (side ? -0.5 : 0.5) * WIDTH;
            edge[side][i] = (fw_geometry_vec2){at.x + off * cos(phi), at.y + off * sin(phi)};
        }
        if (i == STEPS) break;
        double middle = phi + 0.5 * h * curvature[i];
        at.x -= h * sin(middle);
        at.y += h * cos(middle);
        phi += h * curvature[i];
    }
    *turn = phi;
}

static void points_stay_within_the_bound(void **state) {
    (void)state;
    uint64_t seed = 7;
    leaf l;
    leaf_of(&l);
    double nearest = HUGE_VAL;
    for (int round = 0; round < test_fewest(400, 100); round++) {
        double k = chance(&seed, 50, 2500), curvature[STEPS], turn;
        fw_geometry_vec2 edge[2][STEPS + 1];
        int change = (int)chance(&seed, 0, STEPS), kind = round % 3;
        for (int i = 0; i < STEPS; i++)
            curvature[i] = kind == 0 ? chance(&seed, -k, k) : kind == 1 ? (i < change ? k : -k) : k;
        bent(curvature, edge, &turn);
        const fw_clearance_bend bend = {
            .known = true, .strain = k * WIDTH / 2, .width_m = WIDTH, .curvature_per_m = k};
        const double reach = fw_clearance_strip_reach(&l.strip, &bend);
        for (int side = 0; side < 2; side++)
            for (int i = 0; i <= STEPS; i++) {
                double s = LENGTH * i / STEPS;
                fw_geometry_vec2 drawn = {(side ? -0.5 : 0.5) * WIDTH, s - 0.5 * LENGTH};
                double by = vec_distance(edge[side][i], drawn),
                       most = fw_clearance_bend_at(&bend, s);
                assert_true(by <= most + 1e-12);
                if (i == STEPS) nearest = fmin(nearest, 1 - by / most);
                if (s <= 0.5 * LENGTH) assert_true(vec_length(edge[side][i]) <= reach + 1e-12);
            }
    }
    assert_true(nearest < 0.1); /* and not by far */
}

static double to_wall(const fw_geometry_vec2 edge[2][STEPS + 1], const fw_geometry_segment *wall) {
    double least = HUGE_VAL, t;
    for (int side = 0; side < 2; side++)
        for (int i = 1; i <= STEPS; i++)
            least = fmin(least, vec_distance(edge[side][i],
                                             vec_line_foot(wall->a, wall->b, edge[side][i], &t)));
    return least;
}

/* a wall of the lower body beside the strip: what is called clear does not meet it at any rotation;
   what keeps off it by more than the bound is called clear */
static void a_wall_beside_the_strip(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    uint64_t seed = 11;
    int clear = 0, met = 0, missed = 0;
    leaf l;
    leaf_of(&l);
    for (int round = 0; round < test_fewest(300, 75); round++) {
        const double x = chance(&seed, 10e-6, 120e-6) * (round % 2 ? 1 : -1);
        const double y = chance(&seed, -0.4, 0.5) * LENGTH, turn = chance(&seed, 0.02, 1);
        const double share = chance(&seed, 0, 0.2), force = share * turn / LENGTH;
        fw_clearance_edge wall = {
            .segment = {.kind = FW_LINE,
                        .a = {x, y},
                        .b = {x + chance(&seed, -20e-6, 20e-6), 0.5 * LENGTH}},
            .hinge = 0,
            .label = "wall"};
        fw_clearance_solid solid[3] = {{.edge = &wall, .count = 1}, {.count = 0}, {.count = 0}};
        const fw_clearance_things things = {.solid = solid, .nbody = 2};
        const fw_clearance_bend bend = {.known = true,
                                        .strain = 0,
                                        .width_m = WIDTH,
                                        .curvature_per_m = turn / LENGTH + force,
                                        .forced_per_m = force,
                                        .turn_rad = turn,
                                        .straight = true};
        const fw_clearance_edge *found;
        assert_int_equal(fw_clearance_strip_meets(arena, &things, &l.strip, &bend, 0, &found),
                         FW_OK);
        double least = HUGE_VAL;
        for (int way = -20; way <= 20; way++)
            for (int with = -1; with <= 1; with++) {
                double curvature[STEPS], end;
                fw_geometry_vec2 edge[2][STEPS + 1];
                for (int i = 0; i < STEPS; i++)
                    curvature[i] =
                        turn * way / 20 / LENGTH + with * force * (1 - 2 * (i + 0.5) / STEPS);
                bent(curvature, edge, &end);
                least = fmin(least, to_wall(edge, &wall.segment));
            }
        clear += !found;
        met += found != NULL;
        if (!found) assert_true(least > 0.1e-6);
        if (found && least > 12e-6 + force * LENGTH * LENGTH / 6) missed++;
    }
    assert_true(clear > test_fewest(50, 12) && met > test_fewest(50, 12));
    assert_int_equal(missed, 0);
    fw_arena_free(arena);
}

/* a strip may bend most where it is narrowest, wherever along it that is */
static void the_narrowest_bends_most(void **state) {
    (void)state;
    static const double width[3][3] = {{6, 9, 8}, {8, 9, 6}, {9, 6, 8}};
    for (int i = 0; i < 3; i++) {
        fw_geometry_strip_piece piece[3];
        for (int k = 0; k < 3; k++) {
            const double w = width[i][k] * 1e-6;
            piece[k] = (fw_geometry_strip_piece){.length_m = 100e-6, .width_m = {w, w, w}};
        }
        const fw_device device = {.safety_factor = 2};
        const fw_mechanism_variant variant = {.material = {.strength = {.value = 1e9}}};
        const fw_mechanism m = {.device = &device, .variant = &variant};
        const fw_mechanism_hinge hinge = {
            .limits = {.governing = FW_NONE},
            .input = {.piece = piece, .npiece = 3, .length_m = 300e-6, .width_m = 20e-6, .youngs_Pa = 100e9}};
        const fw_clearance_bend bend = fw_clearance_bend_of(&m, &hinge);
        assert_true(bend.known);
        assert_relative(bend.width_m, 6e-6, 1e-9);
        assert_relative(bend.curvature_per_m, 2 * 1e9 / 2 / 100e9 / 6e-6, 1e-9);
    }
}

/* what bends less in every respect keeps off whatever the other keeps off; in one respect more is another matter */
static void what_bends_less_keeps_off(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    uint64_t seed = 29;
    int clear = 0, covered = 0;
    leaf l;
    leaf_of(&l);
    for (int round = 0; round < test_fewest(600, 150); round++) {
        const double x = chance(&seed, 5e-6, 200e-6) * (round % 2 ? 1 : -1);
        fw_clearance_edge wall = {.segment = {.kind = FW_LINE,
                                              .a = {x, chance(&seed, -0.4, 0.5) * LENGTH},
                                              .b = {x + chance(&seed, -20e-6, 20e-6), 0.5 * LENGTH}},
                                  .label = "wall"};
        fw_clearance_solid solid[3] = {{.edge = &wall, .count = 1}, {.count = 0}, {.count = 0}};
        const fw_clearance_things things = {.solid = solid, .nbody = 2};
        fw_clearance_bend bend[2];
        const fw_clearance_edge *found[2];
        for (int i = 0; i < 2; i++) {
            const double turn = chance(&seed, 0.02, 1), force = chance(&seed, 0, 0.2) * turn / LENGTH;
            bend[i] = (fw_clearance_bend){.known = true,
                                          .strain = chance(&seed, 0, 2e-4),
                                          .width_m = WIDTH,
                                          .curvature_per_m = turn / LENGTH + force,
                                          .forced_per_m = i ? HUGE_VAL : force,
                                          .turn_rad = turn,
                                          .straight = true};
            assert_int_equal(
                fw_clearance_strip_meets(arena, &things, &l.strip, &bend[i], 0, &found[i]), FW_OK);
        }
        const bool less = bend[1].turn_rad >= bend[0].turn_rad &&
                          bend[1].strain >= bend[0].strain &&
                          bend[1].curvature_per_m >= bend[0].curvature_per_m;
        assert_int_equal(fw_clearance_bend_covers(&bend[1], &bend[0]), less);
        assert_false(fw_clearance_bend_covers(&bend[0], &bend[1]));
        covered += less;
        if (!less || found[1]) continue;
        assert_null(found[0]);
        clear++;
    }
    assert_true(clear > test_fewest(20, 5) && covered > clear + test_fewest(20, 5));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_stay_within_the_bound),
        cmocka_unit_test(a_wall_beside_the_strip),
        cmocka_unit_test(the_narrowest_bends_most),
        cmocka_unit_test(what_bends_less_keeps_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
