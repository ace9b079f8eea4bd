/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

static fw_geometry_contour polygon_of(fw_arena *arena, const double *x, const double *y, int n,
                                      const unsigned *flags) {
    fw_geometry_contour c;
    fw_geometry_outline o =
        fw_geometry_outline_start(arena, (fw_geometry_vec2){1e-6 * x[0], 1e-6 * y[0]});
    for (int i = 1; i <= n; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-6 * x[i % n], 1e-6 * y[i % n]},
                                 flags ? flags[i - 1] : 0);
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

static double worst_turn(const fw_geometry_contour *c) {
    double worst = 0;
    for (int i = 0; i < c->count; i++)
        worst = fmax(
            worst, fabs(fw_geometry_corner_turn(&c->segment[i], &c->segment[(i + 1) % c->count])));
    return worst;
}

static void square_loses_the_closed_form(void **state) {
    fw_geometry_contour box, round;
    fw_geometry_vec2 where;
    double a = 4e-5;
    assert_int_equal(
        fw_geometry_contour_rectangle(*state, (fw_geometry_box){1e-4, 0, 1e-4 + a, a}, &box), 0);
    for (double r = 1e-6; r < 2.01e-5; r += 1e-6) {
        assert_int_equal(fw_geometry_contour_round(*state, &box, r, 0, &round, &where), FW_OK);
        assert_true(fw_geometry_contour_valid(&round));
        assert_int_equal(round.count, r < 1.99e-5 ? 8 : 4);
        assert_relative(fw_geometry_contour_area(&round), a * a - (4 - FW_PI) * r * r, 1e-12);
        assert_true(worst_turn(&round) < 1e-6);
    }
    /* too large: shrinks to half the side; more than four times too large: refused */
    assert_int_equal(fw_geometry_contour_round(*state, &box, 7.9e-5, 0, &round, &where), FW_OK);
    assert_relative(fw_geometry_contour_area(&round), FW_PI * a * a / 4, 1e-12);
    assert_int_equal(fw_geometry_contour_round(*state, &box, 8.1e-5, 0, &round, &where),
                     FW_GEOMETRY);
    assert_true(vec_same(where, box.segment[0].b)); /* the first corner */
}

static void convex_and_concave_have_their_own_radius(void **state) {
    const double x[] = {0, 50, 50, 20, 20, 0}, y[] = {0, 0, 20, 20, 60, 60};
    fw_geometry_contour ell = polygon_of(*state, x, y, 6, NULL), round;
    fw_geometry_vec2 where;
    assert_int_equal(fw_geometry_contour_round(*state, &ell, 0, 3e-6, &round, &where), FW_OK);
    assert_int_equal(round.count, 7);
    double k = 1 - FW_PI / 4;
    assert_relative(fw_geometry_contour_area(&round), 1800e-12 + k * 9e-12, 1e-13);
    assert_int_equal(fw_geometry_contour_round(*state, &ell, 2e-6, 3e-6, &round, &where), FW_OK);
    assert_int_equal(round.count, 12);
    assert_relative(fw_geometry_contour_area(&round), 1800e-12 + k * (9e-12 - 5 * 4e-12), 1e-13);
    assert_int_equal(fw_geometry_contour_round(*state, &ell, 0, 0, &round, &where), FW_OK);
    for (int i = 0; i < 6; i++)
        assert_memory_equal(&round.segment[i].a, &ell.segment[i].a, sizeof(fw_geometry_vec2));
}

/* Two hollow corners share an arc that is about as long as both roundings: whatever its length, it
   is used up, or an edge of some 200 nm stays. Nothing between, which would be a sliver on the
   mask. */
static void what_stays_between_two_corners_is_no_sliver(void **state) {
    double least = HUGE_VAL;
    for (int k = 0; k < 400; k++) {
        double sweep = 0.02 + 0.00006 * k, r = 300e-6;
        fw_geometry_vec2 o = {0, 0}, p = {r * sin(sweep), -r * cos(sweep)}, q = {-p.x, p.y};
        fw_geometry_contour c, round;
        fw_geometry_vec2 where, up = {0, 60e-6};
        fw_geometry_outline out =
            fw_geometry_outline_start(*state, (fw_geometry_vec2){q.x, q.y + up.y});
        fw_geometry_outline_line(&out, q, 0);
        fw_geometry_outline_arc_to(&out, o, 2 * sweep, p, 0);
        fw_geometry_outline_line(&out, (fw_geometry_vec2){p.x, p.y + up.y}, 0);
        fw_geometry_outline_line(&out, (fw_geometry_vec2){p.x, p.y + 80e-6}, 0);
        fw_geometry_outline_line(&out, (fw_geometry_vec2){q.x, q.y + 80e-6}, 0);
        assert_int_equal(fw_geometry_outline_close(&out, &c), FW_OK);
        assert_int_equal(fw_geometry_contour_round(*state, &c, 10e-6, 0, &round, &where), FW_OK);
        assert_true(fw_geometry_contour_valid(&round));
        assert_true(worst_turn(&round) < 1e-6);
        for (int i = 0; i < round.count; i++)
            least = fmin(least, fw_geometry_segment_length(&round.segment[i]));
    }
    assert_true(least > 199e-9);
}

/* A step that the rolling disc does not touch leaves no trace: a box with a corner cut off by less
   than that is rounded like the whole box; cut off by more, each corner has its own arc. Holes
   alike. */
static void steps_shorter_than_the_disc_are_passed_over(void **state) {
    double r = 10;
    for (int k = 0; k < 200; k++) {
        double angle = FW_PI / 180 * uniform(3, 43), up = uniform(0.01, 8);
        /* cut off at `angle` to the right side, from (60, 40 - up) to the top */
        double run = up * tan(angle);
        const double x[] = {0, 60, 60, 60 - run, 0}, y[] = {0, 0, 40 - up, 40, 40};
        fw_geometry_contour cut = polygon_of(*state, x, y, 5, NULL), round;
        fw_geometry_vec2 where;
        assert_int_equal(fw_geometry_contour_round(*state, &cut, r * 1e-6, 0, &round, &where),
                         FW_OK);
        double step = hypot(up, run), second = FW_PI / 2 - angle;
        double trims = r * (tan(angle / 2) + tan(second / 2));
        bool passed = trims > step;
        if (!passed && step - trims < 0.2) continue; /* then both shrink, to leave an edge */
        assert_int_equal(round.count, passed ? 8 : 10);
        assert_true(worst_turn(&round) < 1e-6);
        double want = 2400 - (4 - FW_PI) * r * r;
        if (!passed) /* the cut, and roundings with other turns: each takes r^2 (tan(t/2) - t/2) */
            want = 2400 - 0.5 * up * run - 0.75 * (4 - FW_PI) * r * r -
                   r * r * (tan(angle / 2) + tan(second / 2) - FW_PI / 4);
        assert_relative(fw_geometry_contour_area(&round), want * 1e-12, 1e-12);
        fw_geometry_contour hole;
        assert_int_equal(fw_geometry_contour_reverse(*state, &cut, &hole), FW_OK);
        assert_int_equal(fw_geometry_contour_round(*state, &hole, 0, r * 1e-6, &round, &where),
                         FW_OK);
        assert_relative(-fw_geometry_contour_area(&round), want * 1e-12, 1e-12);
    }
}

static void corners_beside_joints_stay(void **state) {
    const double x[] = {0, 50, 50, 0}, y[] = {0, 0, 20, 20};
    const unsigned flags[] = {0, FW_SEGMENT_JOINT, 0, 0};
    fw_geometry_contour c = polygon_of(*state, x, y, 4, flags), round;
    fw_geometry_vec2 where;
    assert_int_equal(fw_geometry_contour_round(*state, &c, 4e-6, 4e-6, &round, &where), FW_OK);
    assert_int_equal(round.count, 6);
    int joints = 0;
    for (int i = 0; i < round.count; i++)
        if (round.segment[i].flags & FW_SEGMENT_JOINT) {
            assert_memory_equal(&round.segment[i], &c.segment[1], sizeof(fw_geometry_segment));
            joints++;
        }
    assert_int_equal(joints, 1);
}

/* lines with arcs and arcs with arcs: tangent everywhere, the drop in area between nothing and the
   square's worst case, the shape changed only near the corners */
static void arcs_get_tangent_fillets(void **state) {
    int done = 0;
    for (int i = 0; i < 2000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double size = 1e-4;
        fw_geometry_contour a = random_shape(*state, size, 0), b = random_shape(*state, size, 0),
                            round;
        fw_geometry_region p = region_of(&a), q = region_of(&b), any;
        fw_geometry_boolean op = (fw_geometry_boolean)whole(0, 2);
        assert_int_equal(fw_geometry_region_boolean(*state, &p, &q, op, &any), FW_OK);
        fw_geometry_vec2 where;
        double r = uniform(2e-7, 2e-6);
        for (int k = 0; k < any.count; k++) {
            fw_status status =
                fw_geometry_contour_round(*state, &any.contour[k], r, r, &round, &where);
            if (status != FW_OK) {
                assert_int_equal(status, FW_GEOMETRY);
                assert_near(region_edge(&any, where), 0, 0);
                continue;
            }
            assert_true(fw_geometry_contour_valid(&round));
            assert_true(worst_turn(&round) < 2e-6);
            for (int n = 0; n < round.count; n++)
                if (round.segment[n].kind == FW_ARC)
                    assert_true(round.segment[n].radius >= 0.2499 * r);
            done++;
        }
        fw_arena_rewind(*state, mark);
    }
    assert_true(done > 1500);
}

static void half_disc_closed_form(void **state) {
    /* line-arc corner of a half disc R: the fillet r has its centre at height r, at distance R - r
       from the centre: the touch on the line is at sqrt(R^2 - 2 R r) */
    double R = 5e-5, r = 4e-6;
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){-R, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){R, 0}, 0);
    fw_geometry_outline_arc_to(&o, (fw_geometry_vec2){0, 0}, FW_PI, (fw_geometry_vec2){-R, 0}, 0);
    fw_geometry_contour c, round;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    fw_geometry_vec2 where;
    assert_int_equal(fw_geometry_contour_round(*state, &c, r, 0, &round, &where), FW_OK);
    assert_int_equal(round.count, 4);
    assert_near(round.segment[0].b.x, sqrt(R * R - 2 * R * r), 1e-18);
    assert_near(round.segment[1].centre.y, r, 1e-18);
    assert_near(vec_length(round.segment[1].centre), R - r, 1e-18);
}

static void errors(void **state) {
    fw_geometry_contour box, round;
    fw_geometry_vec2 where;
    assert_int_equal(
        fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 1e-5, 1e-5}, &box), 0);
    assert_int_equal(fw_geometry_contour_round(*state, &box, (double)NAN, 0, &round, &where),
                     FW_GEOMETRY);
    assert_int_equal(fw_geometry_contour_round(*state, &box, -1, 0, &round, NULL), FW_GEOMETRY);
    for (long n = 1; n <= 3; n++) {
        fw_arena_fail_at(n, 1);
        assert_int_equal(fw_geometry_contour_round(*state, &box, 1e-6, 0, &round, &where),
                         FW_NOMEM);
        fw_arena_fail_at(0, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(square_loses_the_closed_form),
        geo_test(convex_and_concave_have_their_own_radius),
        geo_test(corners_beside_joints_stay),
        geo_test(arcs_get_tangent_fillets),
        geo_test(half_disc_closed_form),
        geo_test(steps_shorter_than_the_disc_are_passed_over),
        geo_test(what_stays_between_two_corners_is_no_sliver),
        geo_test(errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
