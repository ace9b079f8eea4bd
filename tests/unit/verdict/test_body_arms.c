/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How bodies give between their hinges, against beams in closed form. */
#include "verdict/strain.h"
#include "geometry/segment.h"
#include "test.h"

enum { MOST = 12 };

typedef struct scene {
    fw_arena *arena;
    fw_layout layout;
    fw_mechanism m;
    fw_verdict_arm *arm;
} scene;

/* one body, an outline of n corners (mm) turned by turn_rad; edges whose bit is set are where a flexure
   is joined. Its two hinges begin in the middle of the first two of these. */
static scene body(int n, const double corner[][2], unsigned joints, double turn_rad) {
    scene s = {.arena = fw_arena_new(0)};
    fw_layout_piece *piece = fw_arena_one(s.arena, fw_layout_piece);
    piece->role = FW_ROLE_STRUCTURE;
    piece->contour.segment = fw_arena_array(s.arena, fw_geometry_segment, MOST);
    piece->contour.count = n;
    s.m.nbody = 1, s.m.nhinge = s.m.npin = 2;
    s.m.pin = fw_arena_array(s.arena, fw_mechanism_pin, 2);
    s.m.hinge = fw_arena_array(s.arena, fw_mechanism_hinge, 2);
    fw_mechanism_mass *mass = fw_arena_one(s.arena, fw_mechanism_mass);
    s.m.body = mass, s.m.drawn = mass;
    fw_geometry_vec2 sum = {0, 0};
    for (int i = 0, k = 0; i < n; i++) {
        fw_geometry_vec2 p[2];
        for (int j = 0; j < 2; j++) {
            const double *at = corner[(i + j) % n];
            p[j] = fw_geometry_vec_rotate((fw_geometry_vec2){1e-3 * at[0], 1e-3 * at[1]}, turn_rad);
        }
        sum = vec_add(sum, vec_scale(1.0 / n, p[0]));
        piece->contour.segment[i] =
            (fw_geometry_segment){.kind = FW_LINE,
                                  .a = p[0],
                                  .b = p[1],
                                  .flags = joints >> i & 1u ? FW_SEGMENT_JOINT : 0};
        if (!(joints >> i & 1u) || k > 1) continue;
        fw_geometry_vec2 root = vec_scale(0.5, vec_add(p[0], p[1]));
        s.m.hinge[k].pin = k;
        s.m.pin[k] =
            (fw_mechanism_pin){.body_a = FW_GROUND, .body_b = 0, .bx_m = root.x, .by_m = root.y};
        k++;
    }
    fw_layout_body_layout *of = fw_arena_one(s.arena, fw_layout_body_layout);
    of->centroid = sum;
    s.layout = (fw_layout){.drawn = true, .piece = piece, .npiece = 1, .body = of};
    assert_int_equal(fw_verdict_body_arms(s.arena, &s.m, &s.layout, &s.arm), FW_OK);
    return s;
}

/* half of a bar of 1 mm, to a cell; turned, where cells go in steps, not below it and not far above */
static void a_bar_is_a_beam(void **state) {
    (void)state;
    const double wide = 0.1, corner[4][2] = {{0, 0}, {1, 0}, {1, wide}, {0, wide}};
    for (int i = 0; i < 4; i++) {
        double turn = 0.3 * i, w = 1e-3 * wide, half = 0.5e-3, cube = w * w * w;
        scene s = body(4, corner, 1u << 1 | 1u << 3, turn);
        for (int k = 0; k < 2; k++) {
            const fw_verdict_arm *arm = &s.arm[2 * k + 1];
            const double moment = 12 * half / cube, off = 0.03,
                         across = 12 * half * half * half / (3 * cube) + 3.2 * half / w;
            /* energies of a moment, and of a force across the bar at its end, on E h = 1 N */
            double by_moment = 2 * fw_verdict_arm_energy_J(arm, 1, 1, 0, 0, 0),
                   by_force = 2 * fw_verdict_arm_energy_J(arm, 1, 0, -sin(turn), cos(turn), 0),
                   along = 2 * fw_verdict_arm_energy_J(arm, 1, 0, cos(turn), sin(turn), 0);
            assert_true(arm->known && !s.arm[2 * k].known);
            assert_true(by_moment > (1 - off) * moment && by_moment < 1.3 * moment);
            assert_true(by_force > (1 - 3 * off) * across && by_force < 1.4 * across);
            assert_true(along > (1 - off) * half / w && along < 1.6 * half / w);
            if (i > 0) continue;
            assert_relative(by_moment, moment, off);
            assert_relative(along, half / w, off);
            assert_relative(arm->narrow_m, w, 0.01); /* the best place is half a cell off */
        }
        fw_arena_free(s.arena);
    }
}

/* forces in the world of a body that has been turned are those of the drawn pose turned back */
static void forces_turn_with_the_body(void **state) {
    (void)state;
    const double corner[4][2] = {{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}};
    scene s = body(4, corner, 1u << 1 | 1u << 3, 0);
    const double turn = 0.4, fx = 2, fy = -3;
    assert_relative(fw_verdict_arm_energy_J(&s.arm[1], 5, 1e-4, fx * cos(turn) - fy * sin(turn),
                                            fx * sin(turn) + fy * cos(turn), turn),
                    fw_verdict_arm_energy_J(&s.arm[1], 5, 1e-4, fx, fy, 0), 1e-12);
    fw_arena_free(s.arena);
}

/* a waist is found where it is; round a corner the way stays in the material */
static void what_is_narrow_is_found(void **state) {
    (void)state;
    const double waist[8][2] = {{0, 0},   {0.3, 0}, {0.3, 0.08}, {0.4, 0.08},
                                {0.4, 0}, {1, 0},   {1, 0.2},    {0, 0.2}};
    scene s = body(8, waist, 1u << 5 | 1u << 7, 0);
    const fw_verdict_arm *left = &s.arm[3]; /* its root is the middle of the last edge */
    assert_relative(left->narrow_m, 0.12e-3, 0.05);
    assert_true(left->narrow.x > 0.28e-3 && left->narrow.x < 0.42e-3);
    assert_relative(s.arm[1].narrow_m, 0.2e-3, 0.02);
    fw_arena_free(s.arena);
    const double corner[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0.9, 1}, {0.9, 0.1}, {0, 0.1}};
    scene l = body(6, corner, 1u << 2 | 1u << 5, 0);
    double moment = 0;
    for (int k = 0; k < 2; k++)
        moment += l.arm[2 * k + 1].give[0];
    /* two bars of 0.95 mm, of which the corner is stiffer */
    assert_true(moment > 0.8 * 12 * 1.9e-3 / 1e-12 && moment < 1.2 * 12 * 1.9e-3 / 1e-12);
    fw_arena_free(l.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bar_is_a_beam),
        cmocka_unit_test(forces_turn_with_the_body),
        cmocka_unit_test(what_is_narrow_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
