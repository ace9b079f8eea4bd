/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

/* closed form against a fine sampling of one of the two outlines, which is never below and at most
   a step above */
static void distance_matches_sampling(void **state) {
    int apart = 0;
    for (int i = 0; i < 1500; i++) {
        fw_mark mark = fw_arena_mark(*state);
        fw_geometry_contour p = random_shape(*state, 1e-4, 0), q = random_shape(*state, 1e-4, 0);
        fw_geometry_vec2 at_p, at_q;
        double d = fw_geometry_contour_distance(&p, &q, &at_p, &at_q), sampled = HUGE_VAL, step = 0;
        assert_near(vec_distance(at_p, at_q), d, 1e-18);
        fw_geometry_region rp = region_of(&p), rq = region_of(&q);
        assert_true(region_edge(&rp, at_p) < 1e-18 + (d > 0 ? 0 : 1e-12));
        assert_true(region_edge(&rq, at_q) < 1e-18 + (d > 0 ? 0 : 1e-12));
        for (int k = 0; k < p.count; k++) {
            step = fmax(step, fw_geometry_segment_length(&p.segment[k]) / 400);
            for (int n = 0; n <= 400; n++)
                sampled = fmin(
                    sampled, region_edge(&rq, fw_geometry_segment_point(&p.segment[k], n / 400.)));
        }
        assert_true(d <= sampled + 1e-18);
        assert_true(sampled <= d + 0.5 * step + 1e-18);
        apart += d > 0;
        fw_arena_rewind(*state, mark);
    }
    assert_true(apart > 200);
}

static void known_distances(void **state) {
    fw_geometry_contour p, q, ring;
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 1e-5, &p), 0);
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){3e-5, 4e-5}, 2e-5, &q), 0);
    fw_geometry_vec2 a, b;
    assert_near(fw_geometry_contour_distance(&p, &q, &a, &b), 2e-5, 1e-20);
    assert_near(a.x, 6e-6, 1e-19);
    assert_near(b.y, 2.4e-5, 1e-19);
    /* concentric: the gap is the same all round */
    assert_int_equal(fw_geometry_contour_ring_sector(*state, (fw_geometry_vec2){0, 0}, 1.8e-5,
                                                     2.5e-5, 1, 4, &ring),
                     0);
    assert_near(fw_geometry_contour_distance(&p, &ring, NULL, NULL), 8e-6, 1e-20);
    /* one inside the other */
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){5e-6, 0}, 3e-6, &q), 0);
    assert_near(fw_geometry_contour_distance(&p, &q, NULL, NULL), 2e-6, 1e-20);
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){9e-6, 0}, 3e-6, &q), 0);
    assert_near(fw_geometry_contour_distance(&p, &q, NULL, NULL), 0, 0);
}

static void clearance_of_a_comb(void **state) {
    /* U: two legs 10 and 14 um wide, a gap of 8 um between them, a bridge of 20 um */
    const double x[] = {0, 32, 32, 18, 18, 10, 10, 0}, y[] = {0, 0, 90, 90, 20, 20, 90, 90};
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    for (int i = 1; i < 8; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-6 * x[i], 1e-6 * y[i]}, 0);
    fw_geometry_contour c, round;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    int i, j;
    assert_near(fw_geometry_contour_clearance(&c, false, &i, &j), 8e-6, 1e-18);
    assert_int_equal(i, 3);
    assert_int_equal(j, 5);
    assert_near(fw_geometry_contour_clearance(&c, true, &i, &j), 10e-6, 1e-18);
    assert_int_equal(i, 5);
    assert_int_equal(j, 7);
    /* rounding corners by 2 um makes neither a width nor a space of 2 um */
    fw_geometry_vec2 where;
    assert_int_equal(fw_geometry_contour_round(*state, &c, 2e-6, 2e-6, &round, &where), FW_OK);
    assert_near(fw_geometry_contour_clearance(&round, false, NULL, NULL), 8e-6, 1e-17);
    assert_near(fw_geometry_contour_clearance(&round, true, NULL, NULL), 10e-6, 1e-17);
}

/* combs of many unlike teeth: the narrowest tooth and the narrowest gap, wherever the outline
 * begins */
static void clearance_of_many_teeth(void **state) {
    enum { MOST = 60 };
    for (int trial = 0; trial < 60; trial++) {
        fw_mark mark = fw_arena_mark(*state);
        int n = whole(2, MOST);
        double tooth[MOST], gap[MOST], floor[MOST], x = 0, least = 1, least_gap = 1;
        for (int k = 0; k < n; k++) {
            tooth[k] = uniform(5e-6, 15e-6), gap[k] = uniform(5e-6, 15e-6);
            floor[k] = uniform(2e-6, 20e-6);
            least = fmin(least, tooth[k]), x += tooth[k];
            if (k + 1 == n) break;
            least = fmin(least, floor[k]), least_gap = fmin(least_gap, gap[k]), x += gap[k];
        }
        fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
        fw_geometry_outline_line(&o, (fw_geometry_vec2){x, 0}, 0);
        for (int k = n - 1; k >= 0; k--) {
            fw_geometry_outline_line(&o, (fw_geometry_vec2){x, 90e-6}, 0);
            x -= tooth[k];
            fw_geometry_outline_line(&o, (fw_geometry_vec2){k ? x : 0, 90e-6}, 0);
            if (k == 0) break;
            fw_geometry_outline_line(&o, (fw_geometry_vec2){x, floor[k - 1]}, 0);
            x -= gap[k - 1];
            fw_geometry_outline_line(&o, (fw_geometry_vec2){x, floor[k - 1]}, 0);
        }
        fw_geometry_contour c, turned;
        assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
        assert_int_equal(c.count, 4 * n);
        turned = c;
        turned.segment = fw_arena_array(*state, fw_geometry_segment, (size_t)c.count);
        for (int first = 0; first < c.count; first++) {
            for (int k = 0; k < c.count; k++)
                turned.segment[k] = c.segment[(first + k) % c.count];
            assert_near(fw_geometry_contour_clearance(&turned, true, NULL, NULL), least, 1e-17);
            assert_near(fw_geometry_contour_clearance(&turned, false, NULL, NULL), least_gap,
                        1e-17);
        }
        fw_arena_rewind(*state, mark);
    }
}

static void clearance_of_rounds(void **state) {
    fw_geometry_contour c;
    int i, j;
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 1e-5, &c), 0);
    assert_near(fw_geometry_contour_clearance(&c, true, &i, &j), 2e-5, 1e-19);
    assert_true(isinf(fw_geometry_contour_clearance(&c, false, &i, &j)));
    assert_int_equal(i, -1);
    /* nearly closed ring: width 7 um, slot between the ends */
    double w = FW_TURN - 0.2;
    assert_int_equal(
        fw_geometry_contour_ring_sector(*state, (fw_geometry_vec2){0, 0}, 2e-5, 2.7e-5, 0.1, w, &c),
        0);
    assert_near(fw_geometry_contour_clearance(&c, true, &i, &j), 7e-6, 1e-18);
    assert_near(fw_geometry_contour_clearance(&c, false, &i, &j), 2 * 2e-5 * sin(0.1), 1e-18);
    assert_int_equal(i, 1);
    assert_true(j == 2 || j == 3); /* the corner of the slot belongs to both */
    /* a step in an edge is neither */
    const double x[] = {0, 100, 100, 50, 50, 0}, y[] = {0, 0, 40, 40, 41, 41};
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    for (int k = 1; k < 6; k++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-6 * x[k], 1e-6 * y[k]}, 0);
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    assert_near(fw_geometry_contour_clearance(&c, true, NULL, NULL), 40e-6, 1e-17);
    assert_true(isinf(fw_geometry_contour_clearance(&c, false, NULL, NULL)));
}

static void joints_are_no_edges(void **state) {
    /* 9 um wide, 4 um long between two cut lines */
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){4e-6, 0}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){4e-6, 9e-6}, FW_SEGMENT_JOINT);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0, 9e-6}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0, 0}, FW_SEGMENT_JOINT);
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    assert_near(fw_geometry_contour_clearance(&c, true, NULL, NULL), 9e-6, 1e-19);
}

/* membership against the sign of a flattened polygon's own winding: here, against closed forms */
static void contains_matches_closed_forms(void **state) {
    for (int i = 0; i < 3000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double inner = uniform(1e-5, 5e-5), outer = inner + uniform(1e-6, 5e-5);
        double start = uniform(-7, 7), sweep = uniform(0.1, 6.2);
        fw_geometry_contour c, back;
        fw_geometry_vec2 m = {uniform(-1e-4, 1e-4), uniform(-1e-4, 1e-4)};
        assert_int_equal(fw_geometry_contour_ring_sector(*state, m, inner, outer, start, sweep, &c),
                         0);
        assert_int_equal(fw_geometry_contour_reverse(*state, &c, &back), 0);
        for (int k = 0; k < 20; k++) {
            double r = uniform(0, 1.3 * outer), angle = uniform(0, FW_TURN);
            if (k % 4 == 0) /* level with a vertex, top or bottom */
                angle = asin(fmax(-1, fmin(1, (c.segment[k / 4 % 4].a.y - m.y) / r)));
            fw_geometry_vec2 p = {m.x + r * cos(angle), m.y + r * sin(angle)};
            double turn = fmod(angle - start + 8 * FW_TURN, FW_TURN);
            fw_geometry_region region = region_of(&c);
            if (region_edge(&region, p) < 1e-15) continue;
            bool want = r > inner && r < outer && turn < sweep;
            assert_int_equal(fw_geometry_contour_contains(&c, p), want);
            assert_int_equal(fw_geometry_contour_contains(&back, p), want);
            assert_int_equal(fw_geometry_contour_winding(&back, p), want ? -1 : 0);
        }
        fw_arena_rewind(*state, mark);
    }
}

/* a strip of one width along tangent arcs and lines, with round ends: all of its neighbours touch
 */
static fw_geometry_contour worm(fw_arena *arena, int parts) {
    fw_geometry_vec2 at = {uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3)}, first = at, centre[4],
                     left[5], side;
    double heading = uniform(0, FW_TURN), half = uniform(1e-6, 8e-6), sweep[4];
    side = (fw_geometry_vec2){sin(heading), -cos(heading)};
    fw_geometry_vec2 start = vec_along(at, half, side);
    fw_geometry_outline o = fw_geometry_outline_start(arena, start);
    for (int k = 0; k < parts; k++) { /* along the right side */
        left[k] = vec_along(at, -half, side);
        double turn = whole(0, 1) ? 1 : -1, r = half + uniform(1e-6, 4e-5);
        sweep[k] = whole(0, 2) ? turn * uniform(0.2, 3.5) : 0;
        if (sweep[k] == 0) {
            at = vec_along(at, uniform(2e-6, 6e-5), (fw_geometry_vec2){-side.y, side.x});
            fw_geometry_outline_line(&o, vec_along(at, half, side), 0);
            continue;
        }
        centre[k] = vec_along(at, -turn * r, side);
        at = vec_add(centre[k], fw_geometry_vec_rotate(vec_sub(at, centre[k]), sweep[k]));
        side = fw_geometry_vec_rotate(side, sweep[k]);
        fw_geometry_outline_arc(&o, centre[k], sweep[k], 0);
    }
    fw_geometry_outline_arc(&o, at, FW_PI, 0);
    for (int k = parts - 1; k >= 0; k--)
        if (sweep[k] == 0)
            fw_geometry_outline_line(&o, left[k], 0);
        else
            fw_geometry_outline_arc(&o, centre[k], -sweep[k], 0);
    fw_geometry_outline_arc_to(&o, first, FW_PI, start, 0);
    fw_geometry_contour c = {0};
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

/* of a smooth outline that does not touch itself: the shortest chord that is square on both ends,
   faces and leaves on the wanted side, over all pairs */
static double all_chords(const fw_geometry_contour *c, bool inside) {
    double least = HUGE_VAL, side = inside ? 1 : -1;
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *p = &c->segment[i];
        if ((p->sweep_rad > 0) == inside && fabs(p->sweep_rad) >= FW_PI * (1 - 1e-12))
            least = fmin(least, 2 * p->radius);
        for (int j = i + 1; j < c->count; j++) {
            fw_geometry_chord chord[FW_MOST_CHORDS];
            const fw_geometry_segment *q = &c->segment[j];
            int n = fw_geometry_segment_chords(p, q, chord);
            for (int k = 0; k < n; k++) {
                double length = vec_distance(chord[k].at_p, chord[k].at_q);
                if (length <= FW_COINCIDENT_M) continue;
                fw_geometry_vec2 u = vec_scale(1 / length, vec_sub(chord[k].at_q, chord[k].at_p));
                fw_geometry_vec2 tp = fw_geometry_segment_tangent(p, chord[k].tp);
                fw_geometry_vec2 tq = fw_geometry_segment_tangent(q, chord[k].tq);
                if (fabs(vec_dot(u, tp)) > 1e-6 || fabs(vec_dot(u, tq)) > 1e-6) continue;
                if (side * vec_cross(tp, u) <= 0 || side * vec_cross(tq, u) >= 0) continue;
                least = fmin(least, length);
            }
        }
    }
    return least;
}

static void touching_neighbours_have_no_chord(void **state) {
    int clear = 0, below = 0;
    for (int i = 0; i < 4000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        fw_geometry_contour c = worm(*state, whole(1, 4));
        double limit = uniform(2e-6, 4e-5);
        for (int inside = 0; inside < 2; inside++) {
            double found = fw_geometry_contour_clearance(&c, inside, NULL, NULL);
            if (found == 0) continue; /* the strip runs over itself */
            double want = all_chords(&c, inside);
            if (isfinite(want) || isfinite(found)) assert_near(found, want, 1e-12);
            found = fw_geometry_contour_clearance_below(&c, inside, limit, NULL, NULL);
            assert_near(found, fmin(want, limit), 1e-12);
            clear++;
            below += want < limit;
        }
        fw_arena_rewind(*state, mark);
    }
    print_message("%d clearances, %d of them below the limit\n", clear, below);
    assert_true(clear > 3000 && below > 1000 && below < clear - 500);
}

/* a ring of many teeth about a point; every other edge an arc where `round` is set */
static fw_geometry_contour teeth(fw_arena *arena, fw_geometry_vec2 c, double r, int n, bool round) {
    fw_geometry_vec2 first = {c.x + r, c.y}, at = first;
    fw_geometry_outline o = fw_geometry_outline_start(arena, first);
    for (int i = 1; i <= n; i++) {
        double angle = FW_TURN * i / n, out = r * (i < n && i % 2 ? 1 + uniform(0.02, 0.2) : 1);
        fw_geometry_vec2 to = {c.x + out * cos(angle), c.y + out * sin(angle)};
        if (i == n) to = first;
        fw_geometry_vec2 between = vec_sub(to, at);
        if (round && i % 2) /* half a turn over the chord */
            fw_geometry_outline_arc_to(&o, vec_along(at, 0.5, between), FW_PI, to, 0);
        else
            fw_geometry_outline_line(&o, to, 0);
        at = to;
    }
    fw_geometry_contour made;
    assert_int_equal(fw_geometry_outline_close(&o, &made), FW_OK);
    return made;
}

/* below a limit it is the least of all pairs of segments, bit for bit, also of outlines with more segments than are
   listed; else the limit */
static void below_is_the_least_of_all_pairs(void **state) {
    int below = 0;
    for (int i = 0; i < 60; i++) {
        fw_mark mark = fw_arena_mark(*state);
        const bool many = i % 10 == 0, round = i % 3 == 0;
        fw_geometry_contour p = teeth(*state, (fw_geometry_vec2){0, 0}, 1e-4, whole(6, 60), round),
                            q = teeth(*state, (fw_geometry_vec2){uniform(1e-4, 3e-4), uniform(0, 2e-4)},
                                      1e-4, many ? 2400 : whole(6, 200), round);
        if (many) fw_geometry_contour_reverse(*state, &q, &q);
        double least = HUGE_VAL, limit = uniform(0, 1e-4);
        for (int k = 0; k < p.count; k++)
            for (int m = 0; m < q.count; m++) {
                fw_geometry_vec2 here, there;
                least = fmin(least, fw_geometry_segment_distance(&p.segment[k], &q.segment[m], &here,
                                                                 &there));
            }
        fw_geometry_vec2 a, b;
        double d = fw_geometry_contour_distance_below(&p, &q, limit, &a, &b);
        assert_true(d == fmin(least, limit));
        fw_geometry_boxed boxed;
        assert_int_equal(fw_geometry_contour_boxed(*state, &q, &boxed), FW_OK);
        assert_true(fw_geometry_boxed_distance_below(&p, &boxed, limit, NULL, NULL) == d);
        assert_true(fw_geometry_contour_distance(&p, &q, NULL, NULL) == least);
        if (d < limit) assert_near(vec_distance(a, b), d, 1e-18);
        below += least < limit;
        fw_arena_rewind(*state, mark);
    }
    assert_true(below > 15 && below < 55);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(distance_matches_sampling),
        geo_test(known_distances),
        geo_test(touching_neighbours_have_no_chord),
        geo_test(clearance_of_a_comb),
        geo_test(clearance_of_many_teeth),
        geo_test(clearance_of_rounds),
        geo_test(joints_are_no_edges),
        geo_test(contains_matches_closed_forms),
        geo_test(below_is_the_least_of_all_pairs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
