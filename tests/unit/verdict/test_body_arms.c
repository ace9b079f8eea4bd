/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How bodies give between their hinges, against beams in closed form. */
#include "verdict/body.h"
#include "geometry/segment.h"
#include "verdict/verdict_parts.h"
#include "test.h"

enum { MOST = 12 };

typedef struct scene {
    fw_arena *arena;
    fw_layout layout;
    fw_mechanism m;
    fw_verdict_arm *arm;
} scene;

static const fw_verdict_turn still = {0, 1, 0};

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

/* Halves of a bar of 1 mm, turned, where cells go in steps, and slender, too. Both together are what the bar
   gives; where the one ends and the other begins is known to a few cells */
static void a_bar_is_a_beam(void **state) {
    (void)state;
    const double wide[] = {0.1, 0.03, 0.012};
    for (int i = 0; i < 3 * 8; i++) {
        double turn = 0.2 * (i % 8), w = 1e-3 * wide[i / 8], half = 0.5e-3, cube = w * w * w;
        const double corner[4][2] = {{0, 0}, {1, 0}, {1, wide[i / 8]}, {0, wide[i / 8]}};
        scene s = body(4, corner, 1u << 1 | 1u << 3, turn);
        const double moment = 12 * half / cube,
                     across = 12 * half * half * half / (3 * cube) + 3.2 * half / w;
        double by[3] = {0};
        for (int k = 0; k < 2; k++) {
            const fw_verdict_arm *arm = &s.arm[2 * k + 1];
            /* energies of a moment, of a force across the bar at its end and along it, on E h = 1 N, of
               what half a bar has */
            const double of[3] = {
                fw_verdict_arm_energy_J(arm, 1, 1, 0, 0, &still) / moment,
                fw_verdict_arm_energy_J(arm, 1, 0, -sin(turn), cos(turn), &still) / across,
                fw_verdict_arm_energy_J(arm, 1, 0, cos(turn), sin(turn), &still) / (half / w)};
            assert_true(arm->known && !s.arm[2 * k].known);
            for (int j = 0; j < 3; j++) {
                assert_true(2 * of[j] > 0.8 && 2 * of[j] < 1.25);
                by[j] += of[j];
            }
            assert_true(arm->narrow_m > 0.98 * w && arm->narrow_m <= 1.0001 * w);
            /* a moment: 6/w^2; a force at the pin has its largest moment in the middle of the bar */
            const double edge = arm->edge_m / (6 * half / (w * w) + 1 / w);
            assert_true(arm->edge_m2 * w * w > 5.99 && arm->edge_m2 * w * w < 6.3);
            assert_true(edge > 0.93 && edge < 1.08);
        }
        for (int j = 0; j < 3; j++)
            if (!(by[j] > 0.985 && by[j] < 1.035))
                fail_msg("%g m wide, turned %g: %d is %.4f", w, turn, j, by[j]);
        fw_arena_free(s.arena);
    }
}

/* Plain ways are what half a bar gives, too, but for a fiftieth of the way that is the flexure's own root; round a corner
   there is none. What they say of a load is the larger of what is known of its size and of what it is. */
static void plain_ways_are_bounds(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        const double turn = 0.2 * i, w = 1e-4, half = 0.5e-3, E = 1e11, h = 10e-6;
        const double corner[4][2] = {{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}};
        scene s = body(4, corner, 1u << 1 | 1u << 3, turn);
        fw_device device = {0};
        fw_mechanism_variant variant = {.thickness_m = h, .material.youngs.value = E};
        s.m.device = &device, s.m.variant = &variant;
        fw_verdict_variant_verdict v = {.mechanism = &s.m};
        assert_int_equal(fw_verdict_bending_begin(s.arena, &s.layout, &s.m, true, &v), FW_OK);
        assert_true(v.straight);
        for (int k = 0; k < 2; k++) {
            const double plain = fw_verdict_arm_energy_J(&v.arm[2 * k + 1], 1, 1, 0, 0, &still),
                         grid = fw_verdict_arm_energy_J(&s.arm[2 * k + 1], 1, 1, 0, 0, &still);
            s.m.pin[k].stiffness_Nm_per_rad = 1e-6;
            assert_true(plain > 0.95 * 6 * half / (w * w * w) && plain > 0.95 * grid);
            assert_true(plain < 3 * grid);
        }
        fw_verdict_strain_monitor seen = {.mechanism = &s.m, .arena = s.arena};
        assert_int_equal(fw_verdict_bending_watch(s.arena, &s.m, v.arm, true, 0, &seen.bending),
                         FW_OK);
        const double q[3] = {0, 0, 0}, angle[2] = {0.1, -0.1}, far = 1e-2 / (1e-6 * 0.1);
        for (int load = 0; load < 9; load++) { /* along x, along y, and between */
            const double force = load % 3 == 0   ? 0
                                 : load % 3 == 1 ? 1e-9
                                                 : far,
                         way = (const double[]){0, M_PI / 2, 0.65}[load / 3];
            const double fx = force * cos(way), fy = force * sin(way);
            const double reaction[4] = {fx, fy, -fx, -fy};
            const fw_dynamics_instant now = {.q = q, .angle_rad = angle, .reaction_N = reaction};
            fw_verdict_bending_record(&seen.bending, &s.m, NULL);
            fw_verdict_bending_record(&seen.bending, &s.m, &now);
            assert_relative(seen.bending.hinges_J, 2 * 0.5 * 1e-6 * 0.01, 1e-12);
            double bodies = 0;
            for (int k = 0; k < 2; k++)
                bodies += fw_verdict_arm_energy_J(&v.arm[2 * k + 1], E * h, -1e-6 * angle[k],
                                                  reaction[2 * k], reaction[2 * k + 1], &still);
            if (load % 3 < 2) /* too little to be looked at */
                assert_true(seen.bending.bodies_J == 0 && bodies < 0.025 * seen.bending.hinges_J);
            else
                assert_relative(seen.bending.bodies_J, bodies, 1e-12);
        }
        /* of leaves that do not turn at all, hinges store nothing by turning: bodies are looked at closely */
        const double none[2] = {0, 0}, pulled[4] = {far, 0, -far, 0};
        const fw_dynamics_instant now = {.q = q, .angle_rad = none, .reaction_N = pulled};
        const fw_dynamics_motion motion = {.observed = &seen}, *motions[] = {&motion};
        device.nscene = 1, v.motion = motions;
        fw_verdict_bending_record(&seen.bending, &s.m, NULL);
        assert_true(fw_verdict_bending_settled(&v));
        fw_verdict_bending_record(&seen.bending, &s.m, &now);
        assert_true(seen.bending.hinges_J == 0 && seen.bending.bodies_J > 0);
        assert_false(fw_verdict_bending_settled(&v));
        fw_arena_free(s.arena);
    }
}

/* forces in the world of a body that has been turned are those of the drawn pose turned back */
static void forces_turn_with_the_body(void **state) {
    (void)state;
    const double corner[4][2] = {{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}};
    scene s = body(4, corner, 1u << 1 | 1u << 3, 0);
    const double turn = 0.4, fx = 2, fy = -3;
    const fw_verdict_turn turned = {turn, cos(turn), sin(turn)};
    assert_relative(fw_verdict_arm_energy_J(&s.arm[1], 5, 1e-4, fx * cos(turn) - fy * sin(turn),
                                            fx * sin(turn) + fy * cos(turn), &turned),
                    fw_verdict_arm_energy_J(&s.arm[1], 5, 1e-4, fx, fy, &still), 1e-12);
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

/* A bar with a release hole, 40 of its 120 um, opened by a cut that a cap closes: what it is said to
   give is at least what both strips beside the hole give together (bending of the net section), and the hole is
   its narrowest place, not the cut. */
static void a_hole_counts_and_its_cut_does_not(void **state) {
    (void)state;
    static const double plain[4][2] = {{0, 0}, {1, 0}, {1, 0.12}, {0, 0.12}};
    static const double pierced[MOST][2] = {
        {0, 0},       {0.295, 0},    {0.295, 0.04}, {0.28, 0.04}, {0.28, 0.08}, {0.32, 0.08},
        {0.32, 0.04}, {0.305, 0.04}, {0.305, 0},    {1, 0},       {1, 0.12},    {0, 0.12}};
    static const double cap[4][2] = {{0.295, 0}, {0.305, 0}, {0.305, 0.04}, {0.295, 0.04}};
    scene bar = body(4, plain, 1u << 1 | 1u << 3, 0),
          s = body(MOST, pierced, 1u << 9 | 1u << 11, 0);
    fw_layout_piece *piece = fw_arena_array(s.arena, fw_layout_piece, 2);
    piece[0] = s.layout.piece[0];
    piece[0].contour.segment[1].flags = piece[0].contour.segment[7].flags = FW_SEGMENT_JOINT;
    piece[1].role = FW_ROLE_STRUCTURE;
    piece[1].contour.count = 4;
    piece[1].contour.segment = fw_arena_array(s.arena, fw_geometry_segment, 4);
    for (int i = 0; i < 4; i++)
        piece[1].contour.segment[i] =
            (fw_geometry_segment){.kind = FW_LINE,
                                  .a = {1e-3 * cap[i][0], 1e-3 * cap[i][1]},
                                  .b = {1e-3 * cap[(i + 1) % 4][0], 1e-3 * cap[(i + 1) % 4][1]},
                                  .flags = i % 2 ? FW_SEGMENT_JOINT : 0};
    s.layout.piece = piece, s.layout.npiece = 2;
    fw_layout_body_layout *middle = fw_arena_one(s.arena, fw_layout_body_layout);
    middle->centroid = (fw_geometry_vec2){0.5e-3, 0.06e-3};
    s.layout.body = middle;
    assert_int_equal(fw_verdict_body_arms(s.arena, &s.m, &s.layout, &s.arm), FW_OK);
    double whole = 0, holed = 0;
    for (int k = 0; k < 2; k++) {
        whole += fw_verdict_arm_energy_J(&bar.arm[2 * k + 1], 1, 1, 0, 0, &still);
        holed += fw_verdict_arm_energy_J(&s.arm[2 * k + 1], 1, 1, 0, 0, &still);
        assert_relative(s.arm[2 * k + 1].narrow_m, k == 0 ? 0.12e-3 : 0.04e-3, 0.05);
    }
    const double full = 0.12e-3, hole = 0.04e-3;
    double net =
        12 * hole * (1 / (full * full * full - hole * hole * hole) - 1 / (full * full * full));
    if (!(holed > whole + 0.5 * net)) /* the unit moment's energy is half its give */
        fail_msg("%g with the hole, %g without, %g in the hole", holed, whole, 0.5 * net);
    fw_arena_free(bar.arena);
    fw_arena_free(s.arena);
}

/* A bar of 60 um with a square hole of 40 um beside the way's narrowest place, between two hinges that turn it against
   each other (M, -M) and pull it (F): over the cut, of two strips of 10 um, equilibrium asks for M over the integral of
   the distances, and F over the two strips. What the hinges put on the body together is taken off. */
static void a_cut_bears_what_equilibrium_asks(void **state) {
    (void)state;
    static const double pierced[MOST][2] = {{0, 0},       {0.28, 0},    {0.28, 0.01}, {0.26, 0.01},
                                            {0.26, 0.05}, {0.30, 0.05}, {0.30, 0.01}, {0.28, 0.01},
                                            {0.28, 0},    {1, 0},       {1, 0.06},    {0, 0.06}};
    for (int turn = 0; turn < 3; turn++) {
        scene s = body(MOST, pierced, 1u << 9 | 1u << 11, 0.7 * turn);
        fw_device device = {.release_pitch_m = 100e-6, .safety_factor = 2};
        fw_device_body *own = fw_arena_one(s.arena, fw_device_body);
        own->id = "bar";
        device.body = own, device.nbody = 1;
        fw_mechanism_variant variant = {.thickness_m = 10e-6, .material.youngs.value = 1e11};
        fw_flexure_limit *limit = fw_arena_one(s.arena, fw_flexure_limit);
        limit->allowable_Pa = 1e9;
        s.m.device = &device, s.m.variant = &variant;
        for (int k = 0; k < 2; k++) {
            s.m.pin[k].stiffness_Nm_per_rad = 1e-6;
            s.m.pin[k].id = k ? "left" : "right";
            s.m.hinge[k].limits.item[0] = *limit;
            s.m.hinge[k].limits.governing = 0;
        }
        const fw_verdict_arm *left = &s.arm[3], *right = &s.arm[1]; /* ends of edges 11 and 9 */
        assert_relative(left->cut_m, 20e-6, 0.05); /* square to the way, which leans in its cells */
        assert_relative(left->cut_m2, 2 * 10e-6 * 25e-6, 0.1);
        assert_true(right->cut_m > 0);
        device.release_hole_m = 40e-6;
        assert_int_equal(fw_verdict_body_arms(s.arena, &s.m, &s.layout, &s.arm), FW_OK);
        left = &s.arm[3], right = &s.arm[1];
        const fw_geometry_vec2 centre = {s.m.drawn->x_m, s.m.drawn->y_m};
        fw_verdict_strain_monitor seen = {.mechanism = &s.m, .arena = s.arena};
        assert_int_equal(fw_verdict_bending_watch(s.arena, &s.m, s.arm, false, 0, &seen.bending),
                         FW_OK);
        for (int load = 0; load < 3; load++) {
            const double moment = load == 1 ? 0 : 4e-6, force = load == 0 ? 0 : 0.1;
            const double along[2] = {cos(0.7 * turn), sin(0.7 * turn)};
            const double q[3] = {0, 0, 0},
                         angle[2] = {moment / 1e-6, load == 2 ? 0 : -moment / 1e-6};
            const double reaction[4] = {force * along[0], force * along[1], -force * along[0],
                                        -force * along[1]};
            const fw_dynamics_instant now = {.q = q, .angle_rad = angle, .reaction_N = reaction};
            fw_verdict_bending_record(&seen.bending, &s.m, NULL);
            fw_verdict_bending_record(&seen.bending, &s.m, &now);
            /* load 2: one moment alone, which may act on either side, so that the force is left */
            const double asked = load == 0 ? moment / left->cut_m2 : force / left->cut_m;
            assert_relative(seen.bending.cut_N_per_m[3], asked, 1e-9);
            const fw_dynamics_motion motion = {.observed = &seen,
                                               .ledger.hinge.used = FW_HINGE_ELASTICA};
            int at[2];
            const fw_verdict_band band = fw_verdict_bending_rims(&s.m, &motion, at);
            assert_true(band.low <= asked / (1e9 / 2 * 10e-6) && band.low > 0);
            assert_true(band.high > 3 * band.low);
            fw_device_scene pull = {.name = "pull"};
            device.scene = &pull, device.nscene = 1;
            fw_verdict_reason reason[2];
            fw_verdict_variant_verdict v = {.reason = reason, .mechanism = &s.m};
            assert_int_equal(fw_verdict_bending_judge(s.arena, 0, &motion, &v), FW_OK);
            assert_int_equal(v.nreason, 1);
            assert_int_equal(reason[0].decision, load == 0 ? FW_REJECT : FW_INCONCLUSIVE);
            /* a box of poses that brings as much uses as much, and decides nothing downward */
            fw_verdict_variant_verdict posed = {.reason = reason, .mechanism = &s.m, .arm = s.arm};
            assert_true(isnan(fw_verdict_bending_rims_required(&posed, at)));
            posed.workspace.required = posed.workspace.reachable = true;
            for (int k = 0; k < 2; k++) {
                posed.workspace.peak[k].angle_rad = -angle[k];
                posed.workspace.load[k] = (fw_workspace_load){.known = true, .most_N = force};
            }
            /* whatever the direction of the force, which poses do not tell */
            const double share = fw_verdict_bending_rims_required(&posed, at);
            const double all[2] = {
                2 * force,
                1e-6 * (fabs(angle[0]) + fabs(angle[1])) +
                    force * (vec_distance(fw_mechanism_pin_place(&s.m, &s.m.pin[0], 1), centre) +
                             vec_distance(fw_mechanism_pin_place(&s.m, &s.m.pin[1], 1), centre))};
            assert_relative(share,
                            fw_verdict_arm_rims_bear(&s.m, at[0] / 2, &s.arm[at[0]],
                                                     1e-6 * fabs(angle[at[0] / 2]), force, NULL,
                                                     all),
                            1e-9);
            assert_true(share >= band.high);
            assert_int_equal(fw_verdict_bending_judge_required(s.arena, &posed), FW_OK);
            assert_int_equal(posed.nreason, 1);
            assert_int_equal(reason[0].decision, FW_INCONCLUSIVE);
            device.release_pitch_m = 0;
            assert_true(isnan(fw_verdict_bending_rims_required(&posed, at)));
            device.release_pitch_m = 100e-6;
        }
        /* the largest between three instants is that of the parabola through them: 1 - (t - 0.2)^2/10 */
        fw_verdict_bending_record(&seen.bending, &s.m, NULL);
        for (int i = -1; i <= 1; i++) {
            const double q[3] = {0, 0, 0}, size = 1 - (i - 0.2) * (i - 0.2) / 10;
            const double angle[2] = {size, 0}, reaction[4] = {sqrt(size), 0, 0, 0};
            const fw_dynamics_instant now = {
                .t_s = i, .q = q, .angle_rad = angle, .reaction_N = reaction};
            fw_verdict_bending_record(&seen.bending, &s.m, &now);
        }
        assert_relative(seen.bending.hardest_N[4], 1, 1e-12);
        assert_relative(seen.bending.hardest_N[5], 1e-6, 1e-12);
        assert_relative(seen.bending.beside * seen.bending.hardest_N[0], 1, 1e-12);
        fw_arena_free(s.arena);
    }
}

/* A bar of 60 um with a square hole of 40 um, opened by a cut: what a straight cut there leaves is a beam of two strips of
   10 um, which has the moment as I = (60^3 - 40^3)/12 and bears a force along itself with 20 um; a strip alone is strained
   8.1 times as much by a moment. What else acts on the body may do so at the end's own edge. */
static void rims_of_what_a_cut_leaves(void **state) {
    (void)state;
    static const double pierced[MOST][2] = {{0, 0},       {0.28, 0},    {0.28, 0.01}, {0.26, 0.01},
                                            {0.26, 0.05}, {0.30, 0.05}, {0.30, 0.01}, {0.28, 0.01},
                                            {0.28, 0},    {1, 0},       {1, 0.06},    {0, 0.06}};
    for (int turn = 0; turn < 4; turn++) {
        scene s = body(MOST, pierced, 1u << 9 | 1u << 11, 0.6 * turn);
        fw_device device = {.release_pitch_m = 100e-6, .release_hole_m = 40e-6};
        s.m.device = &device;
        assert_true(s.arm[3].rim_m2 == 0); /* without holes nobody asks */
        const fw_device in_proportion = {
            .release_pitch_m = 40e-6 / 0.3}; /* a hole is 0.3 of the pitch where none is stated */
        fw_verdict_arm *unstated;
        s.m.device = &in_proportion;
        assert_int_equal(fw_verdict_body_arms(s.arena, &s.m, &s.layout, &unstated), FW_OK);
        s.m.device = &device;
        assert_int_equal(fw_verdict_body_arms(s.arena, &s.m, &s.layout, &s.arm), FW_OK);
        const fw_verdict_arm *left = &s.arm[3];
        assert_relative(unstated[3].rim_m2, left->rim_m2, 1e-12);
        const double second = (60e-6 * 60e-6 * 60e-6 - 40e-6 * 40e-6 * 40e-6) / 12,
                     bends = 30e-6 / second, c = fabs(cos(0.6 * turn)), d = fabs(sin(0.6 * turn));
        assert_true(left->edge_m2 > 0.95 * 6 / (10e-6 * 10e-6));
        assert_relative(left->rim_m2, bends, 0.05);
        /* from the hinge 300 um away, half way up: a force along the bar pulls, one across it bends */
        const double pulls = 1 / 20e-6, across = 300e-6 * bends;
        assert_true(left->rim_x_m > 0.95 * (d * across + c * pulls) &&
                    left->rim_x_m < 1.2 * (d * across + (c + 2 * d) * pulls + bends * 20e-6));
        assert_true(left->rim_y_m > 0.95 * (c * across + d * pulls) &&
                    left->rim_y_m < 1.2 * (c * across + (d + 2 * c) * pulls + bends * 20e-6));
        assert_true(left->rim_m > 0.95 * across && left->rim_m < 1.2 * (across + 2.3 * pulls));
        assert_true(left->rim_rest_m > 0.95 * across &&
                    left->rim_rest_m < 1.2 * (across + 2.3 * pulls));
        assert_relative(left->rim_rest_m2, left->rim_m2, 1e-12);
        assert_true(
            vec_distance(left->rim, fw_geometry_vec_rotate((fw_geometry_vec2){0.28e-3, 0.03e-3},
                                                           0.6 * turn)) < 40e-6);
        fw_arena_free(s.arena);
    }
}

/* Three times what is far from a hole, and 3.28 times in silicon pulled along <110> (Lekhnitskii); walls that the flow puts
   farther in take of every strip. */
static void a_rim_in_silicon_is_strained_more(void **state) {
    (void)state;
    fw_device device = {.safety_factor = 2};
    fw_flexure_limits limits = {.item[0].allowable_Pa = 1e9, .governing = 0};
    fw_mechanism_hinge hinge = {.limits = limits};
    fw_mechanism_variant variant = {.thickness_m = 10e-6};
    fw_layout layout = {.edge_m = 0};
    fw_mechanism m = {.hinge = &hinge, .device = &device, .variant = &variant, .layout = &layout};
    const fw_verdict_arm arm = {.known = true,
                                .narrow_m = 20e-6,
                                .rim_m2 = 1e9,
                                .rim_m = 1e5,
                                .rim_x_m = 5e4,
                                .rim_y_m = 4e4,
                                .rim_rest_m = 1e5,
                                .rim_rest_m2 = 1e9};
    const double along[2] = {1e-3, 0}, rest[2] = {2e-3, 1e-6}, allowed = 1e9 / 2 * 10e-6;
    assert_relative(fw_verdict_arm_rims_bear(&m, 0, &arm, 1e-6, 0, NULL, NULL), 3 * 1e3 / allowed,
                    1e-12);
    assert_relative(fw_verdict_arm_rims_bear(&m, 0, &arm, 0, 1e-3, along, NULL), 3 * 50 / allowed,
                    1e-12);
    assert_relative(fw_verdict_arm_rims_bear(&m, 0, &arm, 0, 0, NULL, rest), 3 * 1200 / allowed,
                    1e-12);
    variant.material.c11.value = 165.7e9, variant.material.c12.value = 63.9e9,
    variant.material.c44.value = 79.6e9;
    assert_relative(fw_verdict_arm_rims_bear(&m, 0, &arm, 1e-6, 0, NULL, NULL),
                    3.28 * 1e3 / allowed, 5e-3);
    layout.edge_m = -2e-6;
    assert_relative(fw_verdict_arm_rims_bear(&m, 0, &arm, 1e-6, 0, NULL, NULL),
                    3.28 * 1e3 / allowed / 0.64, 5e-3);
}

/* A bar of 100 um, but for a neck of 8 um beyond its middle, and a force at its end behind that. Between its hinges it bears
   what it did; the neck has the stress of a beam, three times for its corners, and is inconclusive above what is allowed. */
static void a_neck_before_a_load_is_seen(void **state) {
    (void)state;
    static const double necked[MOST][2] = {{0, 0},       {1, 0},     {1, 0.046}, {1.1, 0.046},
                                           {1.1, 0},     {1.5, 0},   {1.5, 0.1}, {1.1, 0.1},
                                           {1.1, 0.054}, {1, 0.054}, {1, 0.1},   {0, 0.1}};
    fw_device_force force = {.fx_N = 0, .fy_N = 1e-4};
    fw_device_scene pull = {.name = "pull", .duration_s = 1, .force = &force, .nforce = 1};
    fw_device_body own = {.id = "bar"};
    fw_device device = {.body = &own, .nbody = 1, .scene = &pull, .nscene = 1, .safety_factor = 2};
    fw_mechanism_variant variant = {.thickness_m = 10e-6, .material.youngs.value = 1e11};
    scene s = body(MOST, necked, 1u << 10 | 1u << 11, 0); /* two hinges at the left */
    force.x_m = 1.45e-3, force.y_m = 0.05e-3;
    s.m.device = &device, s.m.variant = &variant;
    for (int k = 0; k < 2; k++) {
        s.m.pin[k].id = k ? "left" : "top";
        s.m.hinge[k].limits.item[0] = (fw_flexure_limit){.allowable_Pa = 1e9};
        s.m.hinge[k].limits.governing = 0;
    }
    assert_int_equal(fw_verdict_body_arms(s.arena, &s.m, &s.layout, &s.arm), FW_OK);
    const fw_verdict_arm *arm = &s.arm[4];
    assert_true(arm->known);
    assert_relative(arm->edge_wide_m, 8e-6, 0.02);
    assert_relative(arm->edge_m, 6 * 0.45e-3 / (8e-6 * 8e-6), 0.1);
    const double share = 3 * force.fy_N * arm->edge_m / (1e9 / 2 * 10e-6);
    assert_relative(fw_verdict_arm_bears(&s.m, 0, arm, 0, force.fy_N, NULL), share, 1e-12);
    /* the way runs along x, through the neck: a force along x bends it by what the way is aside, one along y as before */
    const double along_x[2] = {force.fy_N, 0}, along_y[2] = {0, force.fy_N};
    assert_true(fw_verdict_arm_bears(&s.m, 0, arm, 0, force.fy_N, along_x) < 0.1 * share);
    assert_relative(fw_verdict_arm_bears(&s.m, 0, arm, 0, force.fy_N, along_y), share, 0.02);
    fw_verdict_strain_monitor seen = {.mechanism = &s.m, .arena = s.arena};
    const fw_dynamics_motion motion = {.observed = &seen, .ledger.hinge.used = FW_HINGE_ELASTICA};
    const double q[3] = {0, 0, 0}, angle[2] = {0, 0}, reaction[4] = {0, -1e-4, 0, 0};
    const fw_dynamics_instant now = {.q = q, .angle_rad = angle, .reaction_N = reaction};
    for (int weak = 0; weak < 2; weak++) {
        fw_verdict_reason reason[2];
        fw_verdict_variant_verdict v = {.reason = reason, .mechanism = &s.m};
        device.safety_factor = weak ? 2 : 1.8 / share;
        assert_int_equal(fw_verdict_bending_watch(s.arena, &s.m, s.arm, false, 0, &seen.bending),
                         FW_OK);
        fw_verdict_bending_record(&seen.bending, &s.m, NULL);
        fw_verdict_bending_record(&seen.bending, &s.m, &now);
        assert_relative(seen.bending.rest_N[0], 1e-4, 1e-12);
        assert_int_equal(fw_verdict_bending_judge(s.arena, 0, &motion, &v), FW_OK);
        assert_int_equal(v.nreason, weak);
        if (!weak) continue;
        assert_int_equal(reason[0].decision, FW_INCONCLUSIVE);
        assert_int_equal(reason[0].number, FW_VERDICT_BODIES);
        assert_non_null(strstr(reason[0].text, "what force brings"));
    }
    fw_arena_free(s.arena);
}

/* a bar held in its middle by two hinges, 15 um either way, bends at its ends by q l^4/(8 E I), l what reaches beyond, whichever
   way it lies */
static void what_hangs_over_bends(void **state) {
    (void)state;
    const double w = 0.05, l = 1;
    const double corner[8][2] = {{-l, 0},   {-0.02, 0}, {-0.01, -0.01}, {0.01, -0.01},
                                 {0.02, 0}, {l, 0},     {l, w},         {-l, w}};
    for (int i = 0; i < 8; i++) {
        scene s = body(8, corner, 1u << 1 | 1u << 3, 0.21 * i);
        fw_mechanism_variant variant = {.thickness_m = 20e-6};
        fw_mechanism_shape shape = {.area_m2 = 2 * l * w * 1e-6};
        variant.material.youngs.value = 150e9;
        s.m.variant = &variant, s.m.shape = &shape;
        fw_mechanism_mass mass = {.mass_kg = 2330 * 20e-6 * shape.area_m2};
        s.m.body = &mass;
        fw_verdict_hung hung;
        assert_int_equal(fw_verdict_overhang(s.arena, &s.m, &s.layout, 0, s.arm, &hung), FW_OK);
        const double bends = 1.5 * 2330 * pow((l - 0.015) * 1e-3, 4) / (150e9 * 20e-6 * 20e-6);
        assert_true(hung.across_s2 > 0.98 * bends && hung.across_s2 < 1.15 * bends);
        assert_true(hung.across_mode_s2 > 0.98 * bends * 8 / 12.362 &&
                    hung.across_mode_s2 < 1.5 * bends * 8 / 12.362);
        const double in_it = 1.5 * 2330 * pow((l - 0.015) * 1e-3, 4) /
                             (150e9 * pow(w * 1e-3, 2)); /* and half of 3.2 by shear */
        /* it is held by a place at one edge, beside which it is as wide as it is */
        assert_true(hung.in_plane_s2 > 0.95 * in_it && hung.in_plane_s2 < 1.2 * in_it);
        assert_true(hung.in_plane_mode_s2 > 0.95 * in_it * 8 / 12.362 &&
                    hung.in_plane_mode_s2 < 1.5 * in_it * 8 / 12.362);
        assert_true(isinf(hung.bears_N_per_m)); /* nothing is said of what is below */
        const double strained = 3 * 2330 * pow((l - 0.015) * 1e-3, 2) /
                                (w * 1e-3); /* 6 M/(h w^2) at the root, M = rho h w l^2/2 */
        assert_true(hung.Pa_per_m_s2 > 0.9 * strained && hung.Pa_per_m_s2 < 1.1 * strained);
        fw_arena_free(s.arena);
    }
}

/* What a flow leaves of half a bar: moments bend it by the cube of its width, forces along it pull it by the width, piece by piece, and
   as a solid it counts as much softer as the worst of what acts; a bar that is cut through is told, and wider ones count as drawn */
static void arms_as_made(void **state) {
    (void)state;
    const double wide[] = {0.1, 0.03, 0.012}, edge_m = -1.2e-6;
    for (int i = 0; i < 3 * 4; i++) {
        const double turn = 0.4 * (i % 4), w = 1e-3 * wide[i / 4], left = w / (w + 2 * edge_m),
                     cube = left * left * left;
        const double corner[4][2] = {{0, 0}, {1, 0}, {1, wide[i / 4]}, {0, wide[i / 4]}};
        scene s = body(4, corner, 1u << 1 | 1u << 3, turn);
        const fw_verdict_arm *made, *same;
        const char *why;
        assert_int_equal(fw_verdict_arms_made(s.arena, &s.m, s.arm, edge_m, &made), FW_OK);
        assert_int_equal(fw_verdict_arms_made(s.arena, &s.m, s.arm, 1e-6, &same), FW_OK);
        assert_ptr_equal(same, s.arm);
        for (int k = 1; k < 4; k += 2) {
            const double *g = made[k].give, *of = s.arm[k].give;
            const double along =
                             fw_verdict_arm_energy_J(&made[k], 1, 0, cos(turn), sin(turn), &still) /
                             fw_verdict_arm_energy_J(&s.arm[k], 1, 0, cos(turn), sin(turn), &still),
                         across = fw_verdict_arm_energy_J(&made[k], 1, 0, -sin(turn), cos(turn),
                                                          &still) /
                                  fw_verdict_arm_energy_J(&s.arm[k], 1, 0, -sin(turn), cos(turn),
                                                          &still);
            assert_true(fabs(g[0] / of[0] / cube - 1) < 0.02);
            assert_true(along > 0.98 * left && across < 1.01 * cube && across > 1.01 * left);
            assert_true(made[k].softer > 0.98 * cube && made[k].softer < 1.05 * cube);
            assert_true(made[k].narrow_m == s.arm[k].narrow_m && s.arm[k].softer == 0);
            assert_true(fabs(made[k].slide / s.arm[k].slide / left - 1) < 0.02);
        }
        assert_int_equal(fw_verdict_body_cut(s.arena, &s.m, s.arm, edge_m, 0.9e-6, &why), FW_OK);
        assert_null(why);
        s.m.body = &(fw_mechanism_mass){.id = "bar"};
        assert_int_equal(fw_verdict_body_cut(s.arena, &s.m, s.arm, -0.51 * w, 0, &why), FW_OK);
        assert_non_null(strstr(why, "may be cut through"));
        fw_arena_free(s.arena);
    }
}

/* of a bar of two widths the solid counts as much softer as the narrow part may make it by any wrench: more than by what a moment alone or a
   force alone does */
static void a_solid_by_its_softest_wrench(void **state) {
    (void)state;
    const double corner[8][2] = {{0, 0},    {0.4, 0},    {0.4, -0.03}, {1, -0.03},
                                 {1, 0.07}, {0.4, 0.07}, {0.4, 0.04},  {0, 0.04}};
    const double edge_m = -1e-6;
    scene s = body(8, corner, 1u << 3 | 1u << 7, 0);
    const fw_verdict_arm *made;
    assert_int_equal(fw_verdict_arms_made(s.arena, &s.m, s.arm, edge_m, &made), FW_OK);
    double most[2] = {1, 1};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 20000; k++) { /* moments and forces in all proportions */
            const double turn = 0.01 * k, *g = made[2 * i + 1].give, *of = s.arm[2 * i + 1].give;
            const double w[3] = {cos(0.37 * turn), 1e-3 * sin(0.37 * turn) * cos(turn),
                                 1e-3 * sin(0.37 * turn) * sin(turn) * 3};
            double up = 0, down = 0;
            for (int a = 0, n = 0; a < 3; a++)
                for (int b = a; b < 3; b++, n++)
                    up += (a == b ? 1 : 2) * g[n] * w[a] * w[b] * (a ? 1e6 : 1) * (b ? 1e6 : 1),
                        down +=
                        (a == b ? 1 : 2) * of[n] * w[a] * w[b] * (a ? 1e6 : 1) * (b ? 1e6 : 1);
            most[i] = fmax(most[i], up / down);
        }
    const double q = made[1].softer, all = fmax(most[0], most[1]);
    assert_true(q >= all * 0.9998 && q <= pow(0.04 / 0.038, 3) * 1.02);
    assert_true(q < all * 1.02 && made[3].softer == q); /* one of the body */
    fw_arena_free(s.arena);
}

/* a bar that hangs over, with edges as made in the layout, droops as one that is drawn so */
static void what_hangs_over_as_made(void **state) {
    (void)state;
    const double l = 1, edge = 0.0015, h = 20e-6; /* mm */
    double goes[2], mode[2];
    for (int made = 0; made < 2; made++) {
        const double y = made ? 0 : edge, w = 0.03 - y, x = l - y; /* as it is drawn */
        const double corner[8][2] = {{-x, y},          {-0.02, y}, {-0.01, y - 0.01},
                                     {0.01, y - 0.01}, {0.02, y},  {x, y},
                                     {x, w},           {-x, w}};
        scene s = body(8, corner, 1u << 1 | 1u << 3, 0.3);
        fw_mechanism_variant variant = {.thickness_m = h, .material.youngs.value = 150e9};
        fw_mechanism_shape shape = {.area_m2 = 1};
        fw_mechanism_mass mass = {.mass_kg = 2330 * h * 2 * (l - edge) * (0.03 - 2 * edge) * 1e-6};
        s.m.variant = &variant, s.m.shape = &shape, s.m.body = &mass;
        s.layout.edge_m = made ? -1e-3 * edge : 0;
        fw_verdict_hung hung;
        assert_int_equal(fw_verdict_overhang(s.arena, &s.m, &s.layout, 0, s.arm, &hung), FW_OK);
        goes[made] = hung.in_plane_s2, mode[made] = hung.in_plane_mode_s2;
        fw_arena_free(s.arena);
    }
    assert_true(goes[1] > 0.98 * goes[0] && goes[1] < 1.06 * goes[0]);
    assert_true(mode[1] > 0.98 * mode[0] && mode[1] < 1.06 * mode[0]);
}

/* a place at s along a way of n corners, and how it runs there */
static fw_geometry_vec2 along_the_way(const double (*way)[2], int n, double s,
                                      fw_geometry_vec2 *to) {
    for (int i = 0; i + 1 < n; i++) {
        const fw_geometry_vec2 a = {way[i][0], way[i][1]},
                               off = {way[i + 1][0] - a.x, way[i + 1][1] - a.y};
        *to = vec_unit(off);
        if (s <= vec_length(off) || i + 2 == n) return vec_along(a, s, *to);
        s -= vec_length(off);
    }
    return (fw_geometry_vec2){0, 0};
}

/* A bar that is folded back: what hangs on it is as long as the bar is, and not two bars side by side; with a head at its end, above
   where it is held. By the integrals of a frame, across the plane by bending and torsion, and in it by bending. */
static void folded_bars(void **state) {
    (void)state;
    enum { WAY = 4, PLACES = 600 };
    const double corner[12][2] = {{0, 0},      {2, 0},      {2, 0.24},    {0.5, 0.24},
                                  {0.5, 0.44}, {0.2, 0.44}, {0.2, 0.1},   {0.5, 0.1},
                                  {0.5, 0.2},  {1.96, 0.2}, {1.96, 0.04}, {0, 0.04}};
    const double way[WAY][2] = {{0, 0.02}, {1.98, 0.02}, {1.98, 0.22}, {0.5, 0.22}}, w = 0.04e-3,
                 E = 150e9, nu = 0.25;
    const double length = 1e-3 * (1.98 + 0.2 + 1.48), head = 0.3 * 0.34 * 1e-6, q = 2330 * w,
                 h = 20e-6, wide = h / w,
                 torsion =
                     w * h * h * h / 3 * (1 - 0.63 * wide * (1 - wide * wide * wide * wide / 12)),
                 step = length / PLACES;
    const fw_geometry_vec2 pad = {0.35e-3, 0.27e-3};
    double across = 0, aside[2] = {0, 0};
    for (int i = 0; i < PLACES; i++) {
        fw_geometry_vec2 t, other;
        const double s = (i + 0.5) * step;
        const fw_geometry_vec2 at = vec_scale(1e-3, along_the_way(way, WAY, 1e3 * s, &t)),
                               to_pad = vec_sub(pad, at);
        fw_geometry_vec2 moment =
            vec_scale(2330 * head, to_pad); /* of a force across, by its lever */
        for (int k = i; k < PLACES; k++)
            moment = vec_add(
                moment,
                vec_scale(q * step,
                          vec_sub(vec_scale(1e-3, along_the_way(way, WAY, 1e3 * (k + 0.5) * step,
                                                                &other)),
                                  at)));
        across += step * (12 * vec_dot(moment, t) * vec_dot(to_pad, t) / (E * w * h * h) +
                          h * vec_dot(moment, vec_left(t)) * vec_dot(to_pad, vec_left(t)) * 2 *
                              (1 + nu) / (E * torsion));
        aside[0] += 12 * step * moment.y * to_pad.y /
                    (E * w * w * w); /* the pad, by an acceleration along x and along y */
        aside[1] += 12 * step * moment.x * to_pad.x / (E * w * w * w);
    }
    for (int i = 0; i < 4; i++) {
        scene s = body(12, corner, 1u << 11, 0.4 * i);
        fw_mechanism_variant variant = {
            .thickness_m = h, .material.youngs.value = E, .material.poisson.value = nu};
        variant.below =
            (fw_mechanism_below){.known = true, .m = 5e-6, .low_m = 5e-6, .high_m = 5e-6};
        variant.drying.how = FW_DRIED_PULLED;
        fw_mechanism_shape shape = {.area_m2 = q / 2330 * length + head};
        fw_mechanism_mass mass = {.mass_kg = 2330 * h * shape.area_m2};
        s.m.variant = &variant, s.m.shape = &shape, s.m.body = &mass;
        fw_verdict_hung hung;
        assert_int_equal(fw_verdict_overhang(s.arena, &s.m, &s.layout, 0, s.arm, &hung), FW_OK);
        assert_true(hung.across_s2 > across && hung.across_s2 < 1.35 * across);
        assert_true(hung.in_plane_s2 > hypot(aside[0], aside[1]) &&
                    hung.in_plane_s2 < 1.5 * hypot(aside[0], aside[1]));
        /* a quarter of what closes the gap as an even pressure, and edges as at walls of the bar, to three eighths and wide ones */
        const double even = 2330 * h * 25e-12 / across;
        assert_true(hung.bears_N_per_m < 0.375 * even &&
                    hung.bears_N_per_m > 0.25 * even / (1.35 * (1 + h / w)));
        /* modes: not below what the pad does with all of the mass, not above what it droops by */
        assert_true(hung.across_mode_s2 > 0.6 * across && hung.across_mode_s2 < 1.2 * across);
        fw_arena_free(s.arena);
    }
}

/* A link whose ends are turned alike: moments M at both and forces across that balance them, 2 M/L. It is bent as an S, by
   M (1 - 2 s/L), and not by M (1 + 2 s/L): M^2 L/(6 E I) of both halves, where the other sign gives seven times that */
static void a_link_bent_as_an_s(void **state) {
    (void)state;
    const double corner[4][2] = {{0, 0}, {1, 0}, {1, 0.05}, {0, 0.05}}, moment = 1e-9,
                 length = 1e-3, wide = 5e-5;
    scene s = body(4, corner, 10, 0);
    const fw_verdict_turn as_drawn = {0, 1, 0};
    double sum = 0, most = 0;
    for (int k = 0; k < 2; k++) { /* both moments are against the clock, and the pair with it */
        const double across = (s.m.pin[k].bx_m < 0.5e-3 ? 1 : -1) * 2 * moment / length,
                     *g = s.arm[2 * k + 1].give;
        sum += 0.5 * (g[0] * moment * moment + 2 * g[2] * moment * across + g[5] * across * across);
        most += fw_verdict_arm_energy_J(&s.arm[2 * k + 1], 1, moment, 0, across, &as_drawn);
    }
    assert_relative(most, 7 * sum, 0.1); /* the bound takes no sign */
    assert_relative(sum, moment * moment * length / (6 * pow(wide, 3) / 12), 0.1);
    fw_arena_free(s.arena);
}

/* A base is a bar from its hinge to where it is cut from the frame, and on into that by 5.3/12 of its width, whichever way it lies; two hinges at its end bend it together.
   What begins at no base, and a piece that hangs on no frame, has none. */
static void a_base_is_a_beam_up_to_the_frame(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        const double turn = 0.2 * i, w = 1e-4, length = 1e-3 + 5.3 / 12 * w, cube = w * w * w;
        const double corner[4][2] = {{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}};
        scene s = body(4, corner, 1u << 1 | 1u << 3, turn);
        fw_mechanism_variant variant = {.thickness_m = 10e-6, .material.youngs.value = 1e11};
        double on[6] = {1, 0, 0, 0, 0, 0}, end[12];
        s.layout.piece[0].body = FW_GROUND, s.m.variant = &variant, s.m.nhinge = 1;
        s.m.pin[0].ax_m = s.m.pin[0].bx_m, s.m.pin[0].ay_m = s.m.pin[0].by_m;
        assert_int_equal(fw_verdict_bases(s.arena, &s.m, &s.layout, s.arm), FW_OK);
        assert_true(fw_verdict_has_bases(&s.m, s.arm) && s.arm[0].base && !s.arm[1].base);
        assert_true(!s.arm[0].base->shared && fabs(s.arm[0].base->narrow_m / w - 1) < 0.02);
        assert_relative(2 * fw_verdict_bases_J(&s.m, s.arm, 1, on, end), 12 * length / cube, 0.035);
        on[0] = 0, on[1] = -sin(turn), on[2] = cos(turn);
        const double one = fw_verdict_bases_J(&s.m, s.arm, 1, on, end),
                     across = 4 * pow(length, 3) / cube + 3.2 * length / w;
        assert_relative(2 * one, across, 0.035);
        double gives[9] = {0};
        fw_verdict_bases_add(&s.m, s.arm, 0, gives);
        const double n[2] = {-sin(turn), cos(turn)},
                     goes = n[0] * (gives[0] * n[0] + gives[1] * n[1]) +
                            n[1] * (gives[3] * n[0] + gives[4] * n[1]);
        assert_relative(goes * 1e11 * 10e-6, 2 * one, 1e-9);
        const fw_verdict_arm *made;
        assert_int_equal(fw_verdict_arms_made(s.arena, &s.m, s.arm, -2e-6, &made), FW_OK);
        assert_relative(fw_verdict_bases_J(&s.m, made, 1, on, end), pow(w / (w - 4e-6), 3) * one,
                        0.005);
        s.m.nhinge = 2, s.m.pin[1] = s.m.pin[0], on[4] = on[1], on[5] = on[2];
        assert_int_equal(fw_verdict_bases(s.arena, &s.m, &s.layout, s.arm), FW_OK);
        assert_true(s.arm[2].base->shared && s.arm[2].base->shared == s.arm[0].base->shared);
        assert_relative(fw_verdict_bases_J(&s.m, s.arm, 1, on, end), 4 * one, 0.01);
        on[4] = -on[1], on[5] = -on[2]; /* against each other: what is known is each by itself */
        assert_relative(fw_verdict_bases_J(&s.m, s.arm, 1, on, end), 2 * one, 0.01);
        s.layout.piece[0].contour.segment[3].flags = 0; /* it hangs on nothing */
        s.arm[0].base = s.arm[2].base = NULL;
        assert_int_equal(fw_verdict_bases(s.arena, &s.m, &s.layout, s.arm), FW_OK);
        assert_false(fw_verdict_has_bases(&s.m, s.arm));
        fw_arena_free(s.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_base_is_a_beam_up_to_the_frame),
        cmocka_unit_test(a_link_bent_as_an_s),
        cmocka_unit_test(a_neck_before_a_load_is_seen),
        cmocka_unit_test(a_bar_is_a_beam),
        cmocka_unit_test(what_hangs_over_bends),
        cmocka_unit_test(arms_as_made),
        cmocka_unit_test(a_solid_by_its_softest_wrench),
        cmocka_unit_test(what_hangs_over_as_made),
        cmocka_unit_test(folded_bars),
        cmocka_unit_test(plain_ways_are_bounds),
        cmocka_unit_test(forces_turn_with_the_body),
        cmocka_unit_test(what_is_narrow_is_found),
        cmocka_unit_test(a_hole_counts_and_its_cut_does_not),
        cmocka_unit_test(a_cut_bears_what_equilibrium_asks),
        cmocka_unit_test(rims_of_what_a_cut_leaves),
        cmocka_unit_test(a_rim_in_silicon_is_strained_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
