/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law_kind.h"
#include "assembly/assembly.h"
#include "dynamics/models.h"

static void pose(const rig *r, double *q) {
    for (int b = 0; b < r->m.nbody; b++) {
        q[3 * b] = r->m.body[b].x_m;
        q[3 * b + 1] = r->m.body[b].y_m;
        q[3 * b + 2] = r->m.body[b].phi_rad;
    }
}

static double gap(const rig *r, const double *q) {
    double worst = 0;
    for (int i = 0; i < r->m.npin; i++) {
        const fw_mechanism_pin *p = &r->m.pin[i];
        const double ground[3] = {0};
        const double *a = p->body_a == FW_GROUND ? ground : q + 3 * p->body_a;
        const double *b = p->body_b == FW_GROUND ? ground : q + 3 * p->body_b;
        double dx = a[0] + cos(a[2]) * p->ax_m - sin(a[2]) * p->ay_m - b[0] - cos(b[2]) * p->bx_m +
                    sin(b[2]) * p->by_m;
        double dy = a[1] + sin(a[2]) * p->ax_m + cos(a[2]) * p->ay_m - b[1] - sin(b[2]) * p->bx_m -
                    cos(b[2]) * p->by_m;
        worst = fmax(worst, hypot(dx, dy));
    }
    return worst;
}

static void test_already_closed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    double q[15], moved;
    pose(&r, q);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
    assert_true(moved < 1e-17);
    fw_arena_free(arena);
}

/* random guesses up to a link's length and 0.7 rad away close exactly */
static void test_from_a_bad_guess(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int run = 0; run < 60; run++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = run % 3 == 2 ? rig_squeezer(arena) : rig_six_bar(arena, run % 3);
        double unit = run % 3 == 2 ? 0.004 : 0.5e-3, turn = run % 3 == 2 ? 0.3 : 1.4;
        double q[21], moved;
        pose(&r, q);
        for (int i = 0; i < 3 * r.m.nbody; i++)
            q[i] += (i % 3 == 2 ? turn : unit) * (rig_random(&seed) - 0.5);
        assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
        assert_true(gap(&r, q) <= 1e-12 * unit);
        assert_true(moved > 0);
        fw_arena_free(arena);
    }
}

/* least change in the mass metric: a loose pair of bodies pulled together moves both by their
 * masses */
static void test_mass_weighted(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 2, 1, 0);
    rig_body(&r, "light", 1, 1, 0, 0, 0);
    rig_body(&r, "heavy", 3, 1, 4, 0, 0);
    rig_pin_local(&r, "P", 0, 0, 0, 1, 0, 0);
    double q[6], moved;
    pose(&r, q);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
    assert_near(q[0], 3, 1e-12);
    assert_near(q[3], 3, 1e-12);
    assert_near(moved, 3, 1e-12);
    fw_arena_free(arena);
}

/* a ring that is 1 mm too short: says which joint and how far */
static void test_impossible(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 2, 3, 0);
    rig_body(&r, "p", 1e-8, 1e-15, 0.5e-3, 1e-4, 0.1);
    rig_body(&r, "q", 1e-8, 1e-15, 2.5e-3, 1e-4, -0.1);
    rig_pin_local(&r, "left", FW_GROUND, 0, 0, 0, -0.5e-3, 0);
    rig_pin_local(&r, "middle", 0, 0.5e-3, 0, 1, -0.5e-3, 0);
    rig_pin_local(&r, "right", 1, 0.5e-3, 0, FW_GROUND, 3e-3, 0);
    double q[6], moved;
    pose(&r, q);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_SOLVER);
    assert_int_equal(diags.count, 1);
    assert_int_equal(diags.item[0].number, 100);
    print_message("%s\n", diags.item[0].message);
    assert_non_null(strstr(diags.item[0].message, "um"));
    /* 1000 um are missing; the best position shares them among three joints */
    const char *by = strstr(diags.item[0].message, "open by ");
    assert_non_null(by);
    double um = 0;
    assert_int_equal(sscanf(by, "open by %lf um", &um), 1);
    assert_near(um, 1000.0 / 3, 5);
    q[0] = (double)NAN;
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_INPUT);
    fw_arena_free(arena);
}

/* ---- hard guesses ---- */

/* crank and rod with a piston on y = e; r 50 mm, l 160 mm */
static rig rig_engine(fw_arena *arena, double e) {
    rig r = rig_new(arena, 3, 3, 0);
    rig_body(&r, "crank", 1, 1e-3, 0, 0.025, 0);
    rig_body(&r, "rod", 0.3, 1e-3, 0.08, 0.025, 0);
    rig_body(&r, "piston", 0.7, 1e-3, 0.15, e, 0);
    rig_pin_local(&r, "A", FW_GROUND, 0, 0, 0, -0.025, 0);
    rig_pin_local(&r, "B", 0, 0.025, 0, 1, -0.08, 0);
    rig_pin_local(&r, "C", 1, 0.08, 0, 2, 0, 0);
    r.m.joint = fw_arena_array(arena, fw_device_joint, 1);
    r.m.joint[r.m.njoint++] = (fw_device_joint){
        .id = "S", .kind = FW_JOINT_PRISMATIC, .body_a = FW_GROUND, .body_b = 2, .ay_m = e};
    return r;
}

static rig rig_kind(fw_arena *arena, int kind, uint64_t seed) {
    switch (kind) {
    case 0:
        return rig_six_bar(arena, false);
    case 1:
        return rig_six_bar(arena, true);
    case 2:
        return rig_squeezer(arena);
    case 3:
        return rig_windows(arena, 1);
    case 4:
        return rig_windows(arena, 2);
    case 5:
        return rig_windows(arena, 5);
    case 6:
        return rig_windows(arena, 20);
    case 7:
        return rig_engine(arena, 0);
    case 8:
        return rig_engine(arena, 0.02);
    default:
        return rig_any(arena, seed);
    }
}

static double extent(const double *q, size_t n) {
    double most = 0;
    for (size_t i = 0; i < n; i++)
        if (i % 3 < 2) most = fmax(most, fabs(q[i]));
    return most;
}

/* bodies strewn over four times the mechanism with any angle, turned over, or all on one point:
   every mechanism that can be closed is closed, to round-off; a second time gives the same bytes */
static void test_hard_guesses(void **state) {
    (void)state;
    static const char *const name[] = {
        "six-bar",          "six-bar, D twice", "squeezer",
        "1 window",         "2 windows",        "5 windows",
        "20 windows",       "slider-crank",     "offset slider-crank",
        "random mechanisms"};
    static const double size[] = {3e-3, 3e-3, 0.05, 1, 1, 1, 1, 0.1, 0.1, 3e-3};
    static const char *const guess[] = {"strewn", "turned over", "collapsed"};
    int closed = 0, all = 0;
    for (int kind = 0; kind < 10; kind++)
        for (int how = 0; how < 3; how++) {
            uint64_t seed = 1000 + (uint64_t)(10 * kind + how);
            int good = 0, runs = (kind == 6 ? 10 : 50) / test_cases(1, 5);
            for (int run = 0; run < runs; run++) {
                fw_arena *arena = fw_arena_new(0);
                fw_diags diags = fw_diags_new(arena);
                rig r = rig_kind(arena, kind, 100 + (uint64_t)run);
                size_t n = 3 * (size_t)r.m.nbody;
                double *q = fw_arena_array(arena, double, n), moved;
                double *again = fw_arena_array(arena, double, n);
                pose(&r, q);
                for (size_t b = 0; b < n; b += 3) {
                    double x = rig_random(&seed) - 0.5, y = rig_random(&seed) - 0.5;
                    double turn = 6.283185 * (rig_random(&seed) - 0.5);
                    if (how == 0) q[b] += 4 * size[kind] * x, q[b + 1] += 4 * size[kind] * y;
                    if (how == 1) turn = turn > 0 ? 3.14159265358979 : 0;
                    if (how == 2) q[b] = q[0], q[b + 1] = q[1];
                    q[b + 2] += run == 0 && how == 2 ? 0 : turn;
                }
                memcpy(again, q, n * sizeof *q);
                good += fw_assembly_assemble(arena, &r.m, q, &moved, &diags) == FW_OK;
                assert_near(gap(&r, q), 0, 1e-14 * extent(q, n));
                if (run % 10 == 0) {
                    assert_int_equal(fw_assembly_assemble(arena, &r.m, again, &moved, &diags),
                                     FW_OK);
                    assert_memory_equal(q, again, n * sizeof *q);
                }
                fw_arena_free(arena);
            }
            if (good < runs)
                print_message("%s, %s: %d of %d\n", name[kind], guess[how], good, runs);
            closed += good, all += runs;
        }
    print_message("assembled %d of %d hard guesses: %.1f %%\n", closed, all, 100.0 * closed / all);
    assert_int_equal(closed, all);
}

/* mass ratio 1e8: the search does not care, the light body gives way */
static void test_mass_ratio(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int run = 0; run < 40; run++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = rig_squeezer(arena);
        for (int b = 0; b < 7; b += 2)
            r.m.body[b].mass_kg *= 1e-8, r.m.body[b].inertia_kg_m2 *= 1e-8;
        double q[21], moved;
        pose(&r, q);
        for (int i = 0; i < 21; i++)
            q[i] += (i % 3 == 2 ? 3 : 0.03) * (rig_random(&seed) - 0.5);
        assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
        assert_true(gap(&r, q) < 1e-15);
        fw_arena_free(arena);
    }
}

/* ---- the nearest pose ---- */

/* no nearby assembly is nearer to the guess in the mass metric: the gradient along the mechanism's
   freedom vanishes. The crank's end runs on a circle; its nearest point to the guess is known. */
static void test_nearest(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "crank", 2, 1e-9, 3, 4.5, 0.3);
    rig_pin_local(&r, "O", FW_GROUND, 0, 0, 0, -1, 0);
    double q[3], moved;
    pose(&r, q);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
    /* nearly without inertia: the centre goes to the point of the unit circle nearest to it */
    assert_near(q[0], 3 / hypot(3, 4.5), 1e-7);
    assert_near(q[1], 4.5 / hypot(3, 4.5), 1e-7);
    /* six-bar: differences of the distance along feasible directions */
    rig s = rig_six_bar(arena, false);
    uint64_t seed = 8;
    double guess[15], best[15];
    pose(&s, guess);
    for (int i = 0; i < 15; i++)
        guess[i] += (i % 3 == 2 ? 0.2 : 2e-4) * (rig_random(&seed) - 0.5);
    memcpy(best, guess, sizeof best);
    assert_int_equal(fw_assembly_assemble(arena, &s.m, best, &moved, &diags), FW_OK);
    for (int k = 0; k < 30; k++) {
        double other[15], here = 0, there = 0;
        for (int i = 0; i < 15; i++)
            other[i] = best[i] + (i % 3 == 2 ? 1e-3 : 1e-6) * (rig_random(&seed) - 0.5);
        assert_int_equal(fw_assembly_assemble(arena, &s.m, other, &moved, &diags), FW_OK);
        for (int i = 0; i < 15; i++) {
            const fw_mechanism_mass *m = &s.m.body[i / 3];
            double weight = i % 3 == 2 ? m->inertia_kg_m2 : m->mass_kg;
            here += weight * (best[i] - guess[i]) * (best[i] - guess[i]);
            there += weight * (other[i] - guess[i]) * (other[i] - guess[i]);
        }
        assert_true(there >= here * (1 - 1e-9));
    }
    fw_arena_free(arena);
}

/* angles keep the turns of the guess */
static void test_turns(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const double turn = 2 * acos(-1.0);
    rig r = rig_six_bar(arena, false);
    uint64_t seed = 4;
    for (int run = 0; run < 20; run++) {
        double q[15], guess[15], moved;
        pose(&r, q);
        for (int i = 0; i < 15; i++)
            q[i] += i % 3 == 2 ? turn * (i - 7) + 4 * (rig_random(&seed) - 0.5)
                               : 4e-3 * (rig_random(&seed) - 0.5);
        memcpy(guess, q, sizeof q);
        assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
        for (int b = 2; b < 15; b += 3)
            assert_true(fabs(q[b] - guess[b]) <= turn / 2 + 1e-9);
    }
    fw_arena_free(arena);
}

/* poses beyond what double precision can hold are an error, never a gap without a word */
static void test_far_away(void **state) {
    (void)state;
    static const double far[] = {1e3, 1e5, 1e12, 1e100, 1e200, 1e308};
    for (size_t k = 0; k < sizeof far / sizeof far[0]; k++)
        for (int axis = 0; axis < 3; axis++) {
            fw_arena *arena = fw_arena_new(0);
            fw_diags diags = fw_diags_new(arena);
            rig r = axis == 1 ? rig_squeezer(arena) : rig_six_bar(arena, false);
            double q[21], moved;
            pose(&r, q);
            q[6 + axis] += far[k];
            fw_status status = fw_assembly_assemble(arena, &r.m, q, &moved, &diags);
            if (status == FW_OK) {
                assert_true(gap(&r, q) < 1e-12);
            } else {
                assert_true(k >= 2);
                assert_int_equal(status, FW_INPUT);
                assert_int_equal(diags.item[0].number, 105);
            }
            fw_arena_free(arena);
        }
}

/* ---- branches, other assemblies, freedom ---- */

static rig rig_four_bar(fw_arena *arena) {
    rig r = rig_new(arena, 3, 5, 0);
    rig_body(&r, "crank", 1, 0.1, 0.25, 0.433, acos(-1.0) / 3);
    rig_body(&r, "coupler", 2, 1.5, 1.9, 1.5, 0.4);
    rig_body(&r, "rocker", 1.5, 0.8, 3.2, 1.25, acos(-1.0) / 2);
    rig_pin_local(&r, "A", FW_GROUND, 0, 0, 0, -0.5, 0);
    rig_pin_local(&r, "B", 0, 0.5, 0, 1, -1.5, 0);
    rig_pin_local(&r, "C", 1, 1.5, 0, 2, 1.25, 0);
    rig_pin_local(&r, "D", FW_GROUND, 3.2, 0, 2, -1.25, 0);
    return r;
}

/* four-bar with a held crank: two assemblies, mirror images about the line from B to D */
static void test_four_bar_branches(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_four_bar(arena);
    fw_device_driver driver = {.id = "hold",
                               .revolute = 0,
                               .joint = FW_NONE,
                               .law = {.kind = &fw_quantity_law_step, .end_s = (double)INFINITY}};
    r.m.pin[0].free_angle_rad = 0.2; /* the step gives 1 rad: the crank stands at 1.2 rad */
    r.m.driver = &driver, r.m.ndriver = 1;
    double q[9];
    pose(&r, q);
    fw_assembly *a;
    assert_int_equal(fw_assembly_solve(arena, &r.m, q, &diags, &a), FW_OK);
    assert_near(a->after[2], 1.2, 1e-14);
    assert_int_equal(a->rank.dof, 0);
    assert_true(a->rank.clear);
    assert_int_equal(a->nelbow, 2); /* at B (flat line A-B-C with D) and at C */
    assert_int_equal(a->nalternative, 1);
    assert_false(a->more);
    assert_true(a->alternative[0].distance_m > a->distance_m);
    double bx = cos(1.2), by = sin(1.2), dx = 3.2 - bx, dy = -by, d = hypot(dx, dy);
    double offset[2];
    for (int i = 0; i < 2; i++) {
        const double *pose_of = i ? a->alternative[0].q : a->after;
        double cx = pose_of[6] + 1.25 * cos(pose_of[8]), cy = pose_of[7] + 1.25 * sin(pose_of[8]);
        assert_near(hypot(cx - bx, cy - by), 3, 1e-12);
        assert_near(hypot(cx - 3.2, cy), 2.5, 1e-12);
        offset[i] = (dx * (cy - by) - dy * (cx - bx)) / d;
    }
    assert_near(offset[0], -offset[1], 1e-11);
    /* a guess with the other elbow finds the other one, and says that it is where the guess was */
    double other[9];
    memcpy(other, a->alternative[0].q, sizeof other);
    for (int i = 0; i < 9; i++)
        other[i] += 0.02 * ((i * 7) % 5 - 2);
    fw_assembly *b;
    assert_int_equal(fw_assembly_solve(arena, &r.m, other, &diags, &b), FW_OK);
    for (int i = 0; i < 9; i++)
        assert_near(b->after[i], a->alternative[0].q[i], 1e-11);
    for (int i = 0; i < b->nelbow; i++)
        assert_int_equal(b->elbow[i].guess, b->elbow[i].found);
    fw_arena_free(arena);
}

/* the elbow of the guess cannot be had: it is on the other side in the result, and said so */
static void test_other_side(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_four_bar(arena);
    double q[9], mirrored = 0;
    uint64_t seed = 9;
    for (int run = 0; run < 30; run++) {
        pose(&r, q);
        for (int i = 0; i < 9; i++)
            q[i] += (i % 3 == 2 ? 6 : 3) * (rig_random(&seed) - 0.5);
        fw_assembly *a;
        assert_int_equal(fw_assembly_solve(arena, &r.m, q, &diags, &a), FW_OK);
        assert_int_equal(a->rank.dof, 1);
        assert_int_equal(a->ngap, 4);
        for (int i = 0; i < a->nelbow; i++)
            mirrored += a->elbow[i].guess != a->elbow[i].found;
        for (int i = 1; i < a->nalternative; i++)
            assert_true(a->alternative[i].distance_m >= a->alternative[i - 1].distance_m);
    }
    assert_true(mirrored > 5);
    fw_arena_free(arena);
}

/* rank: a hinge written twice and thrice is named, windows at a flat position lose rank */
static void test_rank(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    double q[15], w[15];
    rig r = rig_six_bar(arena, true);
    pose(&r, q);
    fw_assembly *a;
    assert_int_equal(fw_assembly_solve(arena, &r.m, q, &diags, &a), FW_OK);
    assert_int_equal(a->rank.dof, 3);
    assert_int_equal(a->rank.rows, 14);
    assert_int_equal(a->rank.rank, 12);
    assert_true(a->rank.clear && a->rank.kept > 0.1 && a->rank.dropped < 1e-15);
    assert_int_equal(a->rank.nredundant, 1);
    assert_string_equal(a->rank.redundant[0], "D2");
    assert_int_equal(a->iterations, 0);
    rig s = rig_windows(arena, 2);
    pose(&s, w);
    assert_int_equal(fw_assembly_solve(arena, &s.m, w, &diags, &a), FW_OK);
    assert_int_equal(a->rank.dof, 1);
    for (int i = 0; i < 3; i++) { /* cranks lie down: all pins on one line */
        s.m.body[i].x_m = i + 0.5, s.m.body[i].y_m = 0, s.m.body[i].phi_rad = -acos(-1.0) / 2;
    }
    for (int i = 3; i < 5; i++)
        s.m.body[i].x_m = i - 1.5, s.m.body[i].y_m = 0;
    pose(&s, w);
    assert_int_equal(fw_assembly_solve(arena, &s.m, w, &diags, &a), FW_OK);
    assert_int_equal(a->rank.dof, 3); /* N + 1 at the singular position */
    assert_int_equal(a->rank.nredundant, 2);
    fw_arena_free(arena);
}

/* ---- joints and drivers ---- */

static void test_joints(void **state) {
    (void)state;
    uint64_t seed = 21;
    for (int run = 0; run < 60; run++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = rig_engine(arena, 0.01);
        fw_device_joint *joint = fw_arena_array(arena, fw_device_joint, 3);
        joint[0] = r.m.joint[0];
        /* a plate welded to the piston at 30 degrees, and a rod from it to the ground */
        fw_mechanism_mass *body = fw_arena_array(arena, fw_mechanism_mass, 4);
        memcpy(body, r.m.body, 3 * sizeof *body);
        body[3] = (fw_mechanism_mass){"plate", 0.2, 1e-4, 0.2, 0.05, 0, {0, 0}};
        r.m.body = body, r.m.nbody = 4;
        joint[1] = (fw_device_joint){.id = "W",
                                     .kind = FW_JOINT_WELD,
                                     .body_a = 2,
                                     .body_b = 3,
                                     .ax_m = 0.03,
                                     .bx_m = -0.02,
                                     .angle_rad = 0.5};
        joint[2] = (fw_device_joint){.id = "R",
                                     .kind = FW_JOINT_DISTANCE,
                                     .body_a = FW_GROUND,
                                     .body_b = 3,
                                     .ax_m = 0.2,
                                     .ay_m = -0.1,
                                     .bx_m = 0.02,
                                     .length_m = 0.14};
        r.m.joint = joint, r.m.njoint = 3;
        double q[12];
        pose(&r, q);
        for (int i = 0; i < 12 && run > 0; i++)
            q[i] += (i % 3 == 2 ? 6 : 0.3) * (rig_random(&seed) - 0.5);
        if (run == 1) /* the rod's points coincide */
            q[11] = 0, q[9] = 0.18, q[10] = -0.1;
        fw_assembly *a;
        fw_status status = fw_assembly_solve(arena, &r.m, q, &diags, &a);
        if (status != FW_OK) fail_msg("run %d: %s", run, diags.item[0].message);
        assert_true(a->gap_after_m < 1e-15);
        assert_near(remainder(a->after[8], 1), 0, 1e-14); /* the slide holds the piston at 0 */
        assert_near(a->after[7], 0.01, 1e-15);
        assert_near(a->after[11] - a->after[8], 0.5, 1e-14);
        double c = cos(a->after[11]), si = sin(a->after[11]);
        assert_near(hypot(a->after[9] + 0.02 * c - 0.2, a->after[10] + 0.02 * si + 0.1), 0.14,
                    1e-14);
        assert_int_equal(a->rank.dof, 0);
        fw_arena_free(arena);
    }
}

/* the rocker of a crank-rocker swings between the positions where crank and coupler align: a driver
   that asks for more is told the end of its swing */
static void test_impossible_driver(void **state) {
    (void)state;
    const double degree = acos(-1.0) / 180;
    const double ask[] = {20 * degree, 170 * degree};
    for (int i = 0; i < 2; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        rig r = rig_four_bar(arena);
        fw_device_driver driver = {
            .id = "motor",
            .revolute = 3,
            .joint = FW_NONE,
            .law = {.kind = &fw_quantity_law_step, .end_s = (double)INFINITY}};
        r.m.pin[3].free_angle_rad = ask[i] - 1;
        r.m.driver = &driver, r.m.ndriver = 1;
        double q[9];
        pose(&r, q);
        fw_assembly *a;
        assert_int_equal(fw_assembly_solve(arena, &r.m, q, &diags, &a), FW_SOLVER);
        assert_int_equal(diags.item[0].number, 116);
        const char *off = strrchr(diags.item[0].message, '(');
        assert_non_null(off);
        double found = 0, reach = i ? 2 : 4; /* coupler and crank in line */
        assert_int_equal(sscanf(off, "(%lf deg off)", &found), 1);
        double inner = acos((3.2 * 3.2 + 2.5 * 2.5 - reach * reach) / (2 * 3.2 * 2.5));
        double end = acos(-1.0) - inner;
        assert_near(found, fabs(end - ask[i]) / degree, 0.01);
        double asked, nearest; /* 1 rad, which stands for the angle that is asked for */
        const char *says = strstr(diags.item[0].message, "it prescribes ");
        assert_non_null(says);
        assert_int_equal(sscanf(says, "it prescribes %lf deg, and the nearest value that the joints allow from this initial guess is %lf deg", &asked, &nearest), 2);
        assert_near(asked, 1 / degree, 0.05);
        assert_near(nearest, (1 + end - ask[i]) / degree, 0.05);
        fw_arena_free(arena);
    }
}

/* ---- impossible closures ---- */

/* where angles are held the gap means something: all of it in one joint, the others closed */
static void test_gap_of_slides(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 2, 2, 0); /* a level bar on a crank of 1 m reaches 1 m high, not 2.5 */
    rig_body(&r, "a", 1, 0.1, 0.5, 0, 0);
    rig_body(&r, "b", 1, 0.1, 1.5, 0, 0);
    rig_pin_local(&r, "A", FW_GROUND, 0, 0, 0, -0.5, 0);
    rig_pin_local(&r, "B", 0, 0.5, 0, 1, -0.5, 0);
    r.m.joint = fw_arena_array(arena, fw_device_joint, 3);
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "C",
                                                .kind = FW_JOINT_PRISMATIC,
                                                .body_a = FW_GROUND,
                                                .body_b = 1,
                                                .ay_m = 2.5,
                                                .bx_m = 0.5};
    double q[6], moved;
    pose(&r, q);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_SOLVER);
    assert_non_null(strstr(diags.item[0].message, "joint C stays open by 1500 mm at best"));
    r.m.npin = 0; /* three welds in a ring that turns by 0.3 rad */
    r.m.njoint = 3;
    for (int i = 0; i < 3; i++)
        r.m.joint[i] = (fw_device_joint){.id = "W",
                                         .kind = FW_JOINT_WELD,
                                         .body_a = i == 0 ? FW_GROUND : i - 1,
                                         .body_b = i == 2 ? FW_GROUND : i,
                                         .angle_rad = i == 1 ? 0.3 : 0};
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_SOLVER);
    assert_non_null(strstr(diags.item[1].message, "joint W stays open by 17.19 deg at best"));
    fw_arena_free(arena);
}

/* 10 m and 4 m in one sentence: one unit */
static void test_one_unit(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "a", 1, 0.1, 0.5, 0, 0);
    r.m.joint = fw_arena_array(arena, fw_device_joint, 2);
    r.m.njoint = 2;
    r.m.joint[0] =
        (fw_device_joint){"r1", FW_JOINT_DISTANCE, FW_GROUND, 0, 0, 0, -0.5, 0, .length_m = 1};
    r.m.joint[1] =
        (fw_device_joint){"r2", FW_JOINT_DISTANCE, FW_GROUND, 0, 10, 0, 0.5, 0, .length_m = 2};
    double q[3], moved;
    pose(&r, q);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_SOLVER);
    const char *text = diags.item[0].message;
    assert_non_null(strstr(text, "measures 10 m and the other sides reach 4 m together: 6 m"));
    assert_null(strstr(text, " mm"));
    fw_arena_free(arena);
}

/* random rings with one link too long by 1 % to 200 %: always refused, and the hint names that side
   and what is missing */
static void test_always_refused(void **state) {
    (void)state;
    uint64_t seed = 77;
    int refused = 0, runs = test_cases(60, 15);
    for (int run = 0; run < runs; run++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        int n = 2 + (int)(4 * rig_random(&seed));
        rig r = rig_new(arena, n, n + 1, 0);
        static const char *const body[] = {"b0", "b1", "b2", "b3", "b4", "b5"};
        static const char *const pin[] = {"p0", "p1", "p2", "p3", "p4", "p5", "p6"};
        double length[6], sum = 0, ground = 1e-3 * (0.5 + rig_random(&seed));
        int which = (int)(n * rig_random(&seed));
        for (int i = 0; i < n; i++) {
            length[i] = 1e-3 * (0.3 + rig_random(&seed));
            if (i != which) sum += length[i];
        }
        double missing = (sum + ground) * (0.01 + 2 * rig_random(&seed));
        length[which] = sum + ground + missing;
        for (int i = 0; i < n; i++)
            rig_body(&r, body[i], 1e-8 * (1 + 9 * rig_random(&seed)), 1e-15,
                     3e-3 * rig_random(&seed), 3e-3 * rig_random(&seed), 6 * rig_random(&seed));
        for (int i = 0; i <= n; i++)
            rig_pin_local(&r, pin[i], i ? i - 1 : FW_GROUND, i ? length[i - 1] / 2 : 0, 0,
                          i < n ? i : FW_GROUND, i < n ? -length[i] / 2 : ground, 0);
        double q[18];
        pose(&r, q);
        fw_assembly *a;
        fw_status status = fw_assembly_solve(arena, &r.m, q, &diags, &a);
        refused += status == FW_SOLVER;
        assert_int_equal(diags.count, 1);
        /* the least mismatch shares what is missing equally among the n + 1 joints */
        assert_near(a->gap_after_m, missing / (n + 1), 1e-4 * missing);
        char side[64];
        snprintf(side, sizeof side, "%s to %s on %s", pin[which], pin[which + 1], body[which]);
        const char *text = diags.item[0].message;
        if (!strstr(text, side)) fail_msg("%s: %s", side, text);
        fw_arena_free(arena);
    }
    print_message("impossible rings refused: %d of %d\n", refused, runs);
    assert_int_equal(refused, runs);
}

/* a mechanism that stands open is copied into its assembled pose, with a note; a closed one is
   handed back */
static void test_assembled(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    const fw_mechanism *m;
    double far = -1;
    assert_int_equal(fw_assembly_assembled(arena, &r.m, &diags, &m, &far), FW_OK);
    assert_ptr_equal(m, &r.m);
    assert_int_equal(diags.count, 0);
    assert_near(far, 0, 0);
    r.m.body[2].x_m += 1e-10; /* hardly: a note */
    assert_int_equal(fw_assembly_assembled(arena, &r.m, &diags, &m, &far), FW_OK);
    assert_int_equal(diags.item[0].number, 115);
    assert_int_equal(diags.item[0].severity, FW_NOTE);
    assert_true(far > 1e-12 && far < 2e-10);
    r.m.body[2].x_m += 3e-4, r.m.body[4].phi_rad += 0.3;
    assert_int_equal(fw_assembly_assembled(arena, &r.m, &diags, &m, &far), FW_OK);
    assert_ptr_not_equal(m, &r.m);
    assert_int_equal(diags.item[1].number, 115);
    assert_int_equal(diags.item[1].severity, FW_WARNING);
    assert_true(far > 1e-5 && far < 1e-3);
    for (int b = 0; b < m->nbody; b++)
        assert_true(far >=
                    hypot(m->body[b].x_m - r.m.body[b].x_m, m->body[b].y_m - r.m.body[b].y_m));
    double q[15];
    rig moved = r;
    moved.m.body = m->body;
    pose(&moved, q);
    assert_true(gap(&r, q) < 1e-17);
    fw_arena_free(arena);
}

static void test_out_of_memory(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_six_bar(arena, false);
    double q[15], moved;
    pose(&r, q);
    fw_arena_fail_at(0, 0);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_OK);
    long count = fw_arena_count();
    for (long n = 1; n <= count; n++) {
        fw_arena_fail_at(n, 0);
        assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_NOMEM);
    }
    fw_arena_fail_at(0, 0);
    /* from a bad guess, with the report */
    fw_assembly *a;
    uint64_t seed = 6;
    for (int i = 0; i < 15; i++)
        q[i] += (i % 3 == 2 ? 2 : 2e-3) * (rig_random(&seed) - 0.5);
    assert_int_equal(fw_assembly_solve(arena, &r.m, q, &diags, &a), FW_OK);
    count = fw_arena_count();
    for (long n = 1; n <= count; n++) {
        fw_arena_fail_at(n, 0);
        assert_int_equal(fw_assembly_solve(arena, &r.m, q, &diags, &a), FW_NOMEM);
    }
    fw_arena_fail_at(0, 0);
    fw_arena_free(arena);
}

/* Two bodies that nothing joins to the ground before one that hangs on it twice, which cannot close: other starts are tried. The
   first body that is looked at has no joint and no other before it (the sanitizers see what is read in place of that) */
static void test_a_body_that_nothing_joins(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    rig r = rig_new(arena, 3, 2, 0);
    rig_body(&r, "loose", 1, 1, 0, 0, 0);
    rig_body(&r, "looser", 2, 1, 2, 0, 0);
    rig_body(&r, "held", 1, 1, 1, 1, 0);
    rig_pin_local(&r, "L", FW_GROUND, -1, 0, 2, 0, -1);
    rig_pin_local(&r, "R", FW_GROUND, 1, 0, 2, 0, -1);
    double q[9], moved;
    pose(&r, q);
    assert_int_equal(fw_assembly_assemble(arena, &r.m, q, &moved, &diags), FW_SOLVER);
    assert_int_equal(diags.count, 1);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_already_closed), cmocka_unit_test(test_from_a_bad_guess),
        cmocka_unit_test(test_mass_weighted),  cmocka_unit_test(test_impossible),
        cmocka_unit_test(test_hard_guesses),   cmocka_unit_test(test_mass_ratio),
        cmocka_unit_test(test_nearest),        cmocka_unit_test(test_turns),
        cmocka_unit_test(test_far_away),       cmocka_unit_test(test_four_bar_branches),
        cmocka_unit_test(test_other_side),     cmocka_unit_test(test_rank),
        cmocka_unit_test(test_joints),         cmocka_unit_test(test_impossible_driver),
        cmocka_unit_test(test_always_refused), cmocka_unit_test(test_gap_of_slides),
        cmocka_unit_test(test_one_unit),       cmocka_unit_test(test_assembled),
        cmocka_unit_test(test_out_of_memory), cmocka_unit_test(test_a_body_that_nothing_joins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
