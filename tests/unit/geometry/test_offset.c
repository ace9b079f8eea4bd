/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

static void simple_shapes_have_closed_forms(void **state) {
    for (int i = 0; i < 300; i++) {
        double a = uniform(1e-5, 1e-4), b = uniform(1e-5, 1e-4), d = uniform(-2e-6, 2e-6);
        double x = uniform(-1e-3, 1e-3);
        fw_geometry_contour c, o;
        int p, q;
        assert_int_equal(
            fw_geometry_contour_rectangle(*state, (fw_geometry_box){x, x, x + a, x + b}, &c), 0);
        assert_int_equal(fw_geometry_contour_offset(*state, &c, d, &o, &p, &q), FW_OK);
        assert_int_equal(o.count, 4); /* mitred */
        assert_relative(fw_geometry_contour_area(&o), (a + 2 * d) * (b + 2 * d), 1e-11);
        assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){x, x}, a, &c), 0);
        assert_int_equal(fw_geometry_contour_offset(*state, &c, d, &o, &p, &q), FW_OK);
        assert_relative(fw_geometry_contour_area(&o), FW_PI * (a + d) * (a + d), 1e-11);
        /* ring sector: arcs change their radius, ends move by d and mitre with them */
        double sweep = uniform(0.5, 4);
        fw_geometry_vec2 m = {x, x};
        assert_int_equal(fw_geometry_contour_ring_sector(*state, m, a, a + b, 0.3, sweep, &c), 0);
        assert_int_equal(fw_geometry_contour_offset(*state, &c, d, &o, &p, &q), FW_OK);
        assert_true(fw_geometry_contour_valid(&o));
        double R = a + b + d, r = a - d;
        assert_near(o.segment[0].radius, R, 1e-18);
        assert_near(o.segment[2].radius, r, 1e-18);
        /* sector of R less sector of r, plus on both sides the strip of width d from the foot of
           each arc's end: integral of the strip under the chord line */
        double extra = 0;
        for (int k = 0; k < 2; k++) {
            double rho = k ? r : R, sgn = k ? -1 : 1;
            extra += sgn * (d * sqrt(rho * rho - d * d) + rho * rho * asin(d / rho));
        }
        double want = 0.5 * sweep * (R * R - r * r) + extra;
        assert_relative(fw_geometry_contour_area(&o), want, 1e-9);
    }
}

/* every point of the new outline is |d| from the old one, on the right side */
static void random_shapes_move_by_d(void **state) {
    int done = 0;
    for (int i = 0; i < 2000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        fw_geometry_contour a = random_shape(*state, 1e-4, 0), b = random_shape(*state, 1e-4, 0), o,
                            rounded;
        fw_geometry_region p = region_of(&a), q = region_of(&b), any;
        fw_geometry_vec2 where;
        assert_int_equal(fw_geometry_region_boolean(*state, &p, &q, FW_UNION, &any), FW_OK);
        double d = uniform(-1.5e-6, 1.5e-6), r = 2e-6;
        bool smooth = i % 2;
        fw_geometry_contour *c = &any.contour[0];
        if (smooth) {
            if (fw_geometry_contour_round(*state, c, r, r, &rounded, &where)) continue;
            c = &rounded;
        }
        int s, t;
        if (fw_geometry_contour_offset(*state, c, d, &o, &s, &t) != FW_OK) continue;
        assert_true(fw_geometry_contour_valid(&o));
        fw_geometry_region old = region_of(c);
        for (int k = 0; k < o.count; k++)
            for (int n = 0; n < 20; n++) {
                fw_geometry_vec2 at = fw_geometry_segment_point(&o.segment[k], (n + 0.5) / 20);
                double away = region_edge(&old, at);
                assert_true(away >= fabs(d) - 1e-13);
                assert_true(away <= 2 * fabs(d) + 1e-13);
                if (smooth) assert_near(away, fabs(d), 2e-13);
                assert_int_equal(fw_geometry_contour_contains(c, at), d < 0);
            }
        if (smooth) { /* Steiner: dA = P d + pi d^2 for a smooth closed outline */
            double gain = fw_geometry_contour_perimeter(c) * d + FW_PI * d * d;
            assert_near(fw_geometry_contour_area(&o) - fw_geometry_contour_area(c), gain, 2e-16);
            fw_geometry_contour back; /* and back again */
            if (fw_geometry_contour_offset(*state, &o, -d, &back, &s, &t) == FW_OK)
                for (int k = 0; k < back.count; k++)
                    assert_near(region_edge(&old, back.segment[k].a), 0, 2e-13);
        }
        done++;
        fw_arena_rewind(*state, mark);
    }
    assert_true(done > 1000);
}

static void acute_corners_are_joined_by_arcs(void **state) {
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){6e-5, -1e-5}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){6e-5, 1e-5}, 0);
    fw_geometry_contour c, out;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    int i, j;
    assert_int_equal(fw_geometry_contour_offset(*state, &c, 1e-6, &out, &i, &j), FW_OK);
    assert_int_equal(out.count, 4); /* two mitres, one arc at the tip */
    fw_geometry_box box = fw_geometry_contour_box(&out);
    assert_near(box.x0, -1e-6, 1e-18);
    assert_near(box.x1, 6.1e-5, 1e-18);
}

static void what_would_change_topology_is_refused(void **state) {
    const double x[] = {0, 32, 32, 18, 18, 10, 10, 0}, y[] = {0, 0, 90, 90, 20, 20, 90, 90};
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    for (int i = 1; i < 8; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-6 * x[i], 1e-6 * y[i]}, 0);
    fw_geometry_contour c, out, disc, hollow;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    int i, j;
    assert_int_equal(fw_geometry_contour_offset(*state, &c, 3.99e-6, &out, &i, &j), FW_OK);
    assert_near(fw_geometry_contour_clearance(&out, false, NULL, NULL), 0.02e-6, 1e-16);
    assert_int_equal(fw_geometry_contour_offset(*state, &c, 4.01e-6, &out, &i, &j), FW_GEOMETRY);
    assert_int_equal(i, 3);
    assert_int_equal(j, 5);
    assert_int_equal(fw_geometry_contour_offset(*state, &c, -4.99e-6, &out, &i, &j), FW_OK);
    assert_int_equal(fw_geometry_contour_offset(*state, &c, -5.01e-6, &out, &i, &j), FW_GEOMETRY);
    assert_int_equal(i, 5);
    assert_int_equal(j, 7);
    /* a chamfer of 1 um is gone when its neighbours have moved in by 1 um/(2 tan 22.5 deg): they
       are named */
    o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-4, 0}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-4, 0.9e-4}, 0);
    fw_geometry_outline_line(
        &o, (fw_geometry_vec2){1e-4 - 1e-6 * sqrt(0.5), 0.9e-4 + 1e-6 * sqrt(0.5)}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0, 0.9e-4 + 1e-6 * sqrt(0.5)}, 0);
    fw_geometry_contour cut;
    assert_int_equal(fw_geometry_outline_close(&o, &cut), FW_OK);
    assert_int_equal(fw_geometry_contour_offset(*state, &cut, -1.19e-6, &out, &i, &j), FW_OK);
    assert_int_equal(fw_geometry_contour_offset(*state, &cut, -1.23e-6, &out, &i, &j), FW_GEOMETRY);
    assert_int_equal(i, 1);
    assert_int_equal(j, 3);
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 3e-6, &disc), 0);
    assert_int_equal(fw_geometry_contour_reverse(*state, &disc, &hollow), 0);
    assert_int_equal(fw_geometry_contour_offset(*state, &hollow, 2.9e-6, &out, &i, &j), FW_OK);
    assert_int_equal(fw_geometry_contour_offset(*state, &hollow, 3e-6, &out, &i, &j), FW_GEOMETRY);
    assert_int_equal(fw_geometry_contour_offset(*state, &disc, -3e-6, &out, &i, &j), FW_GEOMETRY);
    assert_int_equal(fw_geometry_contour_offset(*state, &disc, (double)NAN, &out, NULL, NULL),
                     FW_GEOMETRY);
    assert_int_equal(fw_geometry_contour_offset(*state, &disc, 0, &out, NULL, NULL), FW_OK);
    for (long n = 1; n <= 2; n++) {
        fw_arena_fail_at(n, 1);
        assert_int_equal(fw_geometry_contour_offset(*state, &c, 1e-6, &out, &i, &j), FW_NOMEM);
        fw_arena_fail_at(0, 0);
    }
}

static const fw_geometry_segment *joint_of(const fw_geometry_contour *c, int which) {
    for (int i = 0; i < c->count; i++)
        if ((c->segment[i].flags & FW_SEGMENT_JOINT) && which-- == 0) return &c->segment[i];
    return NULL;
}

typedef struct pair {
    fw_geometry_vec2 in, out, u,
        back; /* the joint's ends, its direction, and the one into the body */
    double width;
} pair;

/* flexure from the joint: curved about a point R inside, or straight (R = 0), `reach` long */
static fw_geometry_contour flexure_of(fw_arena *arena, const pair *p, double R, double reach) {
    fw_geometry_contour c;
    fw_geometry_outline o = fw_geometry_outline_start(arena, p->in);
    fw_geometry_outline_line(&o, p->out, FW_SEGMENT_JOINT);
    fw_geometry_vec2 m = vec_along(p->in, -R, p->u),
                     v = fw_geometry_vec_rotate(p->u, R > 0 ? reach / R : 0);
    if (R > 0) {
        fw_geometry_outline_arc_to(&o, m, reach / R, vec_along(m, R + p->width, v), 0);
        fw_geometry_outline_line(&o, vec_along(m, R, v), FW_SEGMENT_JOINT);
        fw_geometry_outline_arc_to(&o, m, -reach / R, p->in, 0);
    } else {
        fw_geometry_outline_line(&o, vec_along(p->out, -reach, p->back), 0);
        fw_geometry_outline_line(&o, vec_along(p->in, -reach, p->back), FW_SEGMENT_JOINT);
        fw_geometry_outline_line(&o, p->in, 0);
    }
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

/* body behind the joint. fillet > 0: tangent to the flexure at the joint; else its edge leaves the
   joint at the angle `slant` behind the joint's own line */
static fw_geometry_contour body_of(fw_arena *arena, const pair *p, double fillet, double slant) {
    fw_geometry_contour c;
    double L = 3e-5;
    fw_geometry_vec2 spread = vec_along(vec_scale(cos(slant), p->u), sin(slant), p->back);
    fw_geometry_vec2 other = vec_along(vec_scale(-cos(slant), p->u), sin(slant), p->back);
    fw_geometry_vec2 left = p->in, right = p->out;
    fw_geometry_outline o = fw_geometry_outline_start(arena, p->out);
    fw_geometry_outline_line(&o, p->in, FW_SEGMENT_JOINT);
    if (fillet > 0) {
        left = vec_along(vec_along(p->in, -fillet, p->u), fillet, p->back);
        right = vec_along(vec_along(p->out, fillet, p->u), fillet, p->back);
        fw_geometry_outline_arc_to(&o, vec_along(p->in, -fillet, p->u), -FW_PI / 2, left, 0);
    }
    fw_geometry_vec2 a = vec_along(left, L, other), b = vec_along(right, L, spread);
    fw_geometry_outline_line(&o, a, 0);
    fw_geometry_outline_line(&o, vec_along(a, 6e-5, p->back), 0);
    fw_geometry_outline_line(&o, vec_along(b, 6e-5, p->back), 0);
    fw_geometry_outline_line(&o, b, 0);
    if (fillet > 0) {
        fw_geometry_outline_line(&o, right, 0);
        fw_geometry_outline_arc_to(&o, vec_along(p->out, fillet, p->u), -FW_PI / 2, p->out, 0);
    }
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

/* A flexure and a body that share a cut line, grown one by one: they abut in the very same two
   points, and together they are what growing their union gives. Square or tangent edges at the
   joint: any flexure; slanted ones: a straight flexure. */
static void neighbours_share_their_moved_joint(void **state) {
    for (int i = 0; i < 600; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double start = uniform(0, FW_TURN), d = uniform(-2e-6, 2e-6);
        bool curved = i % 2;
        pair p = {.width = uniform(7e-6, 1.2e-5), .u = {cos(start), sin(start)}};
        p.back = (fw_geometry_vec2){p.u.y, -p.u.x};
        p.in = (fw_geometry_vec2){uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3)};
        p.out = vec_along(p.in, p.width, p.u);
        double R = curved ? uniform(2e-5, 1e-4) : 0, reach = curved ? R * uniform(1, 3.5) : 5e-5;
        double slant = curved ? 0 : uniform(-0.4, 1.5);
        fw_geometry_contour flexure = flexure_of(*state, &p, R, reach), f, b, grown;
        fw_geometry_contour body = body_of(*state, &p, curved ? uniform(2.5e-6, 1e-5) : 0, slant);
        int s, t;
        assert_int_equal(fw_geometry_contour_offset(*state, &flexure, d, &f, &s, &t), FW_OK);
        assert_int_equal(fw_geometry_contour_offset(*state, &body, d, &b, &s, &t), FW_OK);
        assert_true(fw_geometry_contour_valid(&f) && fw_geometry_contour_valid(&b));
        assert_int_equal(f.count, 4);
        assert_int_equal(b.count, body.count + (curved ? 0 : 2));
        const fw_geometry_segment *jf = joint_of(&f, 0), *jb = joint_of(&b, 0);
        assert_memory_equal(&jf->a, &jb->b, sizeof(fw_geometry_vec2));
        assert_memory_equal(&jf->b, &jb->a, sizeof(fw_geometry_vec2));
        assert_near(fw_geometry_segment_length(jf), p.width + 2 * d, 1e-18);
        /* the flexure keeps its length and is width + 2 d wide */
        double length = curved ? reach / R * (R + p.width / 2) : reach;
        assert_relative(fw_geometry_contour_area(&f), (p.width + 2 * d) * length, 1e-9);
        fw_geometry_region rf = region_of(&flexure), rb = region_of(&body), nf = region_of(&f),
                           nb = region_of(&b), any, both;
        assert_int_equal(fw_geometry_region_boolean(*state, &rf, &rb, FW_UNION, &any), FW_OK);
        assert_int_equal(any.count, 1);
        assert_int_equal(fw_geometry_contour_offset(*state, &any.contour[0], d, &grown, &s, &t),
                         FW_OK);
        assert_int_equal(fw_geometry_region_boolean(*state, &nf, &nb, FW_UNION, &both), FW_OK);
        assert_int_equal(both.count, 1);
        assert_near(region_area(&both), fw_geometry_contour_area(&grown), 1e-17);
        fw_arena_rewind(*state, mark);
    }
}

static void two_joints_at_one_vertex_are_refused(void **state) {
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){5e-5, 0}, FW_SEGMENT_JOINT);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){5e-5, 5e-5}, FW_SEGMENT_JOINT);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0, 5e-5}, 0);
    fw_geometry_contour c, out;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    int i, j;
    assert_int_equal(fw_geometry_contour_offset(*state, &c, 1e-6, &out, &i, &j), FW_GEOMETRY);
    assert_int_equal(i, 0);
    assert_int_equal(j, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(simple_shapes_have_closed_forms),
        geo_test(random_shapes_move_by_d),
        geo_test(acute_corners_are_joined_by_arcs),
        geo_test(what_would_change_topology_is_refused),
        geo_test(neighbours_share_their_moved_joint),
        geo_test(two_joints_at_one_vertex_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
