/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/draw.h"
#include "fixture.h"
#include "test.h"

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    const fw_layout *layout;
    fw_status status;
} drawn;

static drawn draw(const fixture *f) {
    drawn d = {.arena = fw_arena_new(0)};
    assert_non_null(d.arena);
    d.diags = fw_diags_new(d.arena);
    d.status = fw_layout_build(d.arena, &f->device, &d.diags, &d.layout);
    return d;
}

static drawn draw_well(const fixture *f) {
    drawn d = draw(f);
    if (d.status != FW_OK)
        fail_msg("%s: %s", fw_status_text(d.status),
                 d.diags.count ? d.diags.item[0].message : "no diagnostic");
    assert_true(d.layout->drawn);
    assert_int_equal(d.diags.errors, 0);
    return d;
}

static bool is_device(const fw_layout_piece *p) {
    return p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FLEXURE || p->role == FW_ROLE_FRAME ||
           p->role == FW_ROLE_TETHER;
}

static bool same(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x == q.x && p.y == q.y;
}

/* pieces that share the JOINT edge k of piece i, reversed, bit for bit */
static int partners(const fw_layout *l, int i, int k, int *who) {
    const fw_geometry_segment *e = &l->piece[i].contour.segment[k];
    int n = 0;
    for (int j = 0; j < l->npiece; j++)
        for (int m = 0; j != i && m < l->piece[j].contour.count; m++) {
            const fw_geometry_segment *g = &l->piece[j].contour.segment[m];
            if ((g->flags & FW_SEGMENT_JOINT) && same(e->a, g->b) && same(e->b, g->a)) {
                *who = j;
                n++;
            }
        }
    return n;
}

/* closed, counter-clockwise, every JOINT edge shared with exactly one other piece, all in one part
 */
static void check_pieces(const fw_layout *l) {
    int group[256];
    assert_true(l->npiece < 256);
    for (int i = 0; i < l->npiece; i++)
        group[i] = i;
    for (int i = 0; i < l->npiece; i++) {
        const fw_geometry_contour *c = &l->piece[i].contour;
        assert_true(fw_geometry_contour_area(c) > 0.0);
        for (int k = 0; k < c->count; k++) {
            assert_true(same(c->segment[k].b, c->segment[(k + 1) % c->count].a));
            if (!is_device(&l->piece[i]) || !(c->segment[k].flags & FW_SEGMENT_JOINT)) continue;
            int who = -1;
            if (partners(l, i, k, &who) != 1)
                fail_msg("joint edge %d of %s has no single partner", k, l->piece[i].label);
            int from = group[who], to = group[i];
            for (int j = 0; j < l->npiece; j++)
                if (group[j] == from) group[j] = to;
        }
    }
    for (int i = 0; i < l->npiece; i++)
        if (is_device(&l->piece[i])) assert_int_equal(group[i], group[0]);
}

static bool share_a_joint(const fw_layout *l, int i, int j) {
    for (int k = 0; k < l->piece[i].contour.count; k++) {
        int who = -1;
        if ((l->piece[i].contour.segment[k].flags & FW_SEGMENT_JOINT) &&
            partners(l, i, k, &who) == 1 && who == j)
            return true;
    }
    return false;
}

/* no piece has an edge point inside another; pieces without a common cut keep a distance */
static void check_disjoint(const fw_layout *l) {
    for (int i = 0; i < l->npiece; i++)
        for (int j = 0; j < l->npiece; j++) {
            const fw_layout_piece *p = &l->piece[i], *q = &l->piece[j];
            if (i == j || !is_device(p) || !is_device(q)) continue;
            bool joined = share_a_joint(l, i, j);
            if (!joined && i < j &&
                !(fw_geometry_contour_distance(&p->contour, &q->contour, NULL, NULL) > 1e-6))
                fail_msg("%s and %s touch", p->label, q->label);
            for (int k = 0; k < p->contour.count; k++) {
                const fw_geometry_segment *e = &p->contour.segment[k];
                fw_geometry_vec2 middle = fw_v(0.5 * (e->a.x + e->b.x), 0.5 * (e->a.y + e->b.y));
                if (e->kind == FW_LINE && !(e->flags & FW_SEGMENT_JOINT) &&
                    fw_geometry_contour_contains(&q->contour, middle))
                    fail_msg("%s lies inside %s", p->label, q->label);
            }
        }
}

static const fw_layout_piece *find(const fw_layout *l, fw_layout_role role, int body, int joint) {
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].role == role && l->piece[i].joint == joint &&
            (joint != FW_NONE || l->piece[i].body == body))
            return &l->piece[i];
    fail_msg("no piece of body %d, joint %d", body, joint);
    return NULL;
}

static void the_reference_is_one_connected_device(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    drawn d = draw_well(&f);
    check_pieces(d.layout);
    check_disjoint(d.layout);
    assert_int_equal(d.diags.count, 0);
    assert_near(d.layout->narrowest_gap_m, 8e-6, 1e-12);
    assert_near(d.layout->die.x1 - d.layout->die.x0, 5.6e-3, 2e-9);
    assert_near(d.layout->die.y1 - d.layout->die.y0, 5e-3, 2e-9);
    for (int j = 0; j < 6; j++) {
        assert_true(d.layout->hinge[j].free_rad >= 0.5);
        assert_true(d.layout->hinge[j].facing_rad > 2.0);
    }
    fw_arena_free(d.arena);
}

/* total angle of the arcs of a contour about w with the given radius (m) */
static double sector(const fw_geometry_contour *c, fw_geometry_vec2 w, double radius,
                     double *worst) {
    double sum = 0.0;
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *e = &c->segment[i];
        if (e->kind != FW_ARC || !same(e->centre, w) || fabs(e->radius - radius) > 1e-9) continue;
        *worst = fmax(*worst, fabs(e->radius - radius));
        sum += fabs(e->sweep_rad);
    }
    return sum;
}

static void hinge_is_exact(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    drawn d = draw_well(&f);
    for (int j = 0; j < 6; j++) {
        const fw_layout_hinge_layout *h = &d.layout->hinge[j];
        const fw_device_flexure *x = &f.flexure[j];
        fw_flexure_input in = {.kind = x->kind,
                               .length_m = x->length_m,
                               .angle_rad = x->angle_rad,
                               .radius_m = x->radius_m,
                               .width_m = x->width_m,
                               .fillet_m = h->fillet_m,
                               .depth_m = 50e-6,
                               .youngs_Pa = 169e9,
                               .poisson = 0.22,
                               .strength_Pa = 1e9,
                               .safety_factor = 1.5};
        fw_flexure_result out;
        fw_flexure_closed_form(&in, &out);
        fw_geometry_vec2 w = fw_add(h->arc_centre, out.centre_m, fw_polar(h->axis_rad));
        assert_near(w.x, f.revolute[j].x_m, 1e-15);
        assert_near(w.y, f.revolute[j].y_m, 1e-15);
        assert_near(h->fillet_m, x->width_m, 0.0);

        const fw_geometry_contour *c = &find(d.layout, FW_ROLE_FLEXURE, 0, j)->contour;
        int arcs = 0;
        assert_int_equal(c->count, 4);
        for (int i = 0; i < 4; i++) {
            const fw_geometry_segment *e = &c->segment[i];
            assert_int_equal(e->kind == FW_LINE, e->flags == FW_SEGMENT_JOINT);
            if (e->kind == FW_LINE) {
                assert_near(fw_norm(fw_sub(e->a, e->b)), x->width_m, 1e-16);
                continue;
            }
            assert_true(same(e->centre, h->arc_centre));
            double side = e->sweep_rad > 0.0 ? 0.5 : -0.5;
            assert_near(e->radius, x->radius_m + side * x->width_m, 2e-18);
            arcs++;
        }
        assert_int_equal(arcs, 2);

        int concave = h->convex == h->upper ? h->lower : h->upper;
        double worst = 0.0;
        double a = sector(&find(d.layout, FW_ROLE_STRUCTURE, h->convex, FW_NONE)->contour,
                          h->centre, h->surface_radius_m, &worst);
        double b = sector(&find(d.layout, FW_ROLE_STRUCTURE, concave, FW_NONE)->contour, h->centre,
                          h->surface_radius_m + h->gap_m, &worst);
        assert_true(a > 2.0 && b > 2.0);
        assert_true(worst <= 2e-18);
    }
    fw_arena_free(d.arena);
}

/* the two fillets beside a cut are tangent to what they join and have the radius that is reported
 */
static void root_fillets_are_tangent(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    drawn d = draw_well(&f);
    for (int j = 0; j < 6; j++) {
        const fw_layout_hinge_layout *h = &d.layout->hinge[j];
        int found = 0;
        for (int s = 0; s < 2; s++) {
            int body = s ? h->upper : h->lower;
            const fw_geometry_contour *c =
                &find(d.layout, FW_ROLE_STRUCTURE, body, FW_NONE)->contour;
            for (int i = 0; i < c->count; i++) {
                const fw_geometry_segment *e = &c->segment[i];
                double away = fw_norm(fw_sub(e->centre, h->arc_centre));
                double t = f.flexure[j].width_m, r = f.flexure[j].radius_m;
                bool outer = fabs(away - (r + 0.5 * t + h->fillet_m)) < 1e-15;
                bool inner = fabs(away - (r - 0.5 * t - h->fillet_m)) < 1e-15;
                if (e->kind != FW_ARC || !(outer || inner)) continue;
                assert_near(e->radius, h->fillet_m, 1e-15);
                found++;
            }
        }
        assert_int_equal(found, 4);
    }
    fw_arena_free(d.arena);
}

/* in the half of a flexure that belongs to body b: on its side of the hinge's axis */
static bool in_a_half(const fw_layout *l, int b, fw_geometry_vec2 at) {
    for (int i = 0; i < l->npiece; i++) {
        const fw_layout_piece *p = &l->piece[i];
        if (p->role != FW_ROLE_FLEXURE) continue;
        const fw_layout_hinge_layout *h = &l->hinge[p->joint];
        double side = cos(h->axis_rad) * (at.y - h->arc_centre.y) -
                      sin(h->axis_rad) * (at.x - h->arc_centre.x);
        if (b == (side > 0 ? h->upper : h->lower) && fw_geometry_contour_contains(&p->contour, at))
            return true;
    }
    return false;
}

/* points of the plane in the order of the R2 sequence: 1/g, 1/g^2 with g^3 = g + 1 */
static void areas_agree_with_counted_points(void **state) {
    (void)state;
    const double g = 1.32471795724474602596;
    fixture f;
    fixture_six_bar(&f);
    f.device.die.tethers = false; /* stubs count in the piece, not in the body */
    drawn d = draw_well(&f);
    for (int b = 0; b < 5; b++) {
        const fw_geometry_contour *c = &find(d.layout, FW_ROLE_STRUCTURE, b, FW_NONE)->contour;
        const fw_layout_body_layout *m = &d.layout->body[b];
        fw_geometry_box box = fw_geometry_contour_box(c);
        box.x0 -= 0.2e-3, box.y0 -= 0.2e-3, box.x1 += 0.2e-3, box.y1 += 0.2e-3; /* the flexures */
        double w = box.x1 - box.x0, h = box.y1 - box.y0, n = 0, sx = 0, sy = 0, s2 = 0, x, y;
        const int total = 150000;
        for (int i = 0; i < total; i++) {
            x = box.x0 + w * fmod(0.5 + i / g, 1.0);
            y = box.y0 + h * fmod(0.5 + i / (g * g), 1.0);
            const fw_geometry_vec2 at = {x, y};
            if (!fw_geometry_contour_contains(c, at) && !in_a_half(d.layout, b, at)) continue;
            n++;
            sx += x;
            sy += y;
            s2 += (x - m->centroid.x) * (x - m->centroid.x) +
                  (y - m->centroid.y) * (y - m->centroid.y);
        }
        double cell = w * h / total;
        assert_relative(m->area_m2, n * cell, 3e-3);
        assert_near(m->centroid.x, sx / n, 2e-6);
        assert_near(m->centroid.y, sy / n, 2e-6);
        assert_relative(m->polar_m4, s2 * cell, 5e-3);
    }
    fw_arena_free(d.arena);
}

static int joints(const fw_geometry_contour *c) {
    int n = 0;
    for (int i = 0; i < c->count; i++)
        n += (c->segment[i].flags & FW_SEGMENT_JOINT) != 0;
    return n;
}

static void tethers_change_no_body(void **state) {
    (void)state;
    fixture with, without;
    fixture_six_bar(&with);
    fixture_six_bar(&without);
    without.device.die.tethers = false;
    drawn a = draw_well(&with), b = draw_well(&without);
    for (int i = 0; i < 5; i++) {
        assert_near(a.layout->body[i].area_m2, b.layout->body[i].area_m2, 0.0);
        assert_near(a.layout->body[i].polar_m4, b.layout->body[i].polar_m4, 0.0);
        const fw_geometry_contour *p = &find(a.layout, FW_ROLE_STRUCTURE, i, FW_NONE)->contour;
        const fw_geometry_contour *q = &find(b.layout, FW_ROLE_STRUCTURE, i, FW_NONE)->contour;
        double extra = fw_geometry_contour_area(p) - fw_geometry_contour_area(q);
        bool platform = i == 2; /* the links hang on their hinges */
        assert_true(platform ? extra > 100e-12 : extra == 0.0);
        assert_true(extra < 0.003 * fw_geometry_contour_area(q));
        assert_true(joints(p) == joints(q) + (platform ? 2 : 0));
    }
    assert_near(a.layout->narrowest_gap_m, b.layout->narrowest_gap_m, 0.0);
    for (int i = 0; i < b.layout->npiece; i++)
        assert_true(b.layout->piece[i].role != FW_ROLE_TETHER);
    fw_arena_free(a.arena);
    fw_arena_free(b.arena);
}

/* one cut with one moving body, exactly a neck wide, one with the frame, exactly a finger wide */
static void check_tether(const fw_layout *l, int i, const fixture *f) {
    const fw_layout_piece *t = &l->piece[i];
    int bodies = 0, frames = 0, sides = 0;
    for (int k = 0; k < t->contour.count; k++) {
        const fw_geometry_segment *e = &t->contour.segment[k];
        if (!(e->flags & FW_SEGMENT_JOINT)) continue;
        int who = -1;
        assert_int_equal(partners(l, i, k, &who), 1);
        const fw_layout_piece *p = &l->piece[who];
        double width = fw_norm(fw_sub(e->a, e->b));
        assert_true(e->a.x == e->b.x || e->a.y == e->b.y);
        if (p->role == FW_ROLE_FRAME) {
            assert_near(width, 20e-6, 1e-15);
            frames++;
            continue;
        }
        assert_int_equal(p->role, FW_ROLE_STRUCTURE);
        assert_true(p->body >= 0);
        assert_non_null(strstr(t->label, f->body[p->body].id));
        assert_near(width, 8e-6, 1e-15);
        bodies++;
        for (int s = 0; s < p->contour.count; s++) { /* straight and square on both sides */
            const fw_geometry_segment *g = &p->contour.segment[s];
            if (!same(g->b, e->b) && !same(g->a, e->a)) continue;
            if (g->flags & FW_SEGMENT_JOINT) continue;
            sides++;
            assert_int_equal(g->kind, FW_LINE);
            assert_true(fw_norm(fw_sub(g->a, g->b)) > 1.99e-6);
            assert_near(fw_dot(fw_sub(g->a, g->b), fw_sub(e->a, e->b)), 0.0, 1e-22);
        }
    }
    assert_int_equal(bodies, 1);
    assert_int_equal(sides, 2);
    assert_int_equal(frames, 1);
    /* nothing narrower than the neck */
    assert_near(fw_geometry_contour_clearance(&t->contour, true, NULL, NULL), 8e-6, 1e-12);
}

/* gallery device, general four-bar, turned plate; as drawn and under both signs of bias */
static void tethers_break_at_the_body(void **state) {
    (void)state;
    static const int expected[] = {2, 1, 2};
    for (int which = 0; which < 3; which++) {
        fixture f;
        if (which == 0)
            fixture_six_bar(&f);
        else if (which == 1)
            fixture_four_bar(&f);
        else
            fixture_paddle(&f);
        drawn d = draw_well(&f);
        int n = 0;
        for (int i = 0; i < d.layout->npiece; i++) {
            const fw_layout_piece *p = &d.layout->piece[i];
            fw_geometry_contour grown;
            if (p->role == FW_ROLE_TETHER) {
                n++;
                assert_int_equal(p->body, FW_GROUND);
                check_tether(d.layout, i, &f);
            }
            if (!is_device(p)) continue;
            for (int sign = -1; sign <= 1; sign += 2) {
                assert_int_equal(fw_geometry_contour_offset(d.arena, &p->contour, sign * 1.1e-6,
                                                            &grown, NULL, NULL),
                                 FW_OK);
                if (p->role == FW_ROLE_TETHER)
                    assert_near(fw_geometry_contour_clearance(&grown, true, NULL, NULL),
                                8e-6 + sign * 2.2e-6, 1e-12);
            }
        }
        assert_int_equal(n, expected[which]);
        fw_arena_free(d.arena);
    }
}

/* turning one body by almost the free rotation about W, either way, leaves the two apart */
static void free_rotation_is_free(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    f.device.die.tethers = false;
    drawn d = draw_well(&f);
    for (int j = 0; j < 6; j++) {
        const fw_layout_hinge_layout *h = &d.layout->hinge[j];
        const fw_geometry_contour *p =
            &find(d.layout, FW_ROLE_STRUCTURE, h->lower, FW_NONE)->contour;
        const fw_geometry_contour *q =
            &find(d.layout, FW_ROLE_STRUCTURE, h->upper, FW_NONE)->contour;
        for (int step = -10; step <= 10; step++) {
            double turn = 0.097 * step * h->free_rad;
            fw_geometry_vec2 w = h->centre;
            fw_geometry_pose pose = {w.x - (cos(turn) * w.x - sin(turn) * w.y),
                                     w.y - (sin(turn) * w.x + cos(turn) * w.y), turn};
            fw_geometry_contour turned;
            assert_int_equal(fw_geometry_contour_transform(d.arena, q, pose, false, &turned),
                             FW_OK);
            if (!(fw_geometry_contour_distance(p, &turned, NULL, NULL) > 0.5e-6))
                fail_msg("hinge %d touches at %.3f rad", j, turn);
        }
    }
    fw_arena_free(d.arena);
}

static void free_rotation_of_two_sectors(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_contour p, q;
    fw_geometry_vec2 w = {1e-3, -2e-3};
    assert_int_equal(fw_geometry_contour_ring_sector(arena, w, 50e-6, 90e-6, 0.0, 1.0, &p), FW_OK);
    assert_int_equal(fw_geometry_contour_ring_sector(arena, w, 70e-6, 120e-6, 1.4, 2.0, &q), FW_OK);
    assert_near(fw_layout_free_rotation(w, &p, &q, 200e-6), 0.4, 1e-9);
    assert_int_equal(fw_geometry_contour_ring_sector(arena, w, 95e-6, 120e-6, 1.4, 2.0, &q), FW_OK);
    assert_near(fw_layout_free_rotation(w, &p, &q, 200e-6), M_PI, 0.0);
    fw_arena_free(arena);
}

static fw_geometry_contour triangle(fw_arena *arena, const fw_geometry_vec2 at[3]) {
    fw_geometry_contour c = {.segment = fw_arena_array(arena, fw_geometry_segment, 3), .count = 3};
    assert_non_null(c.segment);
    for (int i = 0; i < 3; i++)
        c.segment[i] = (fw_geometry_segment){.kind = FW_LINE, .a = at[i], .b = at[(i + 1) % 3]};
    return c;
}

/* directions in which the edges of a triangle cross a circle about the origin */
static int directions(const fw_geometry_vec2 at[3], double radius, double out[6]) {
    int n = 0;
    for (int i = 0; i < 3; i++) {
        const fw_geometry_vec2 a = at[i], b = at[(i + 1) % 3];
        const double ux = b.x - a.x, uy = b.y - a.y, length = hypot(ux, uy);
        const double along = -(a.x * ux + a.y * uy) / length, beside = (a.x * uy - a.y * ux) / length;
        for (int sign = -1; sign <= 1 && fabs(beside) <= radius; sign += 2) {
            const double s = along + sign * sqrt(radius * radius - beside * beside);
            if (s >= 0 && s <= length) out[n++] = atan2(a.y + s * uy / length, a.x + s * ux / length);
        }
    }
    return n;
}

/* of random triangles with no corner on a circle, many of which lie about the hinge or in each other's shade: what every edge gives on all 400 circles, none left out */
static void free_rotation_of_any_two(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_geometry_vec2 w = {1e-3, -2e-3};
    const double radius = 200e-6;
    unsigned seed = 26;
    int met = 0;
    for (int trial = 0; trial < 300; trial++) {
        fw_geometry_vec2 at[2][3], placed[3];
        fw_geometry_contour c[2];
        for (int k = 0; k < 2; k++) {
            const double toward = 2.2 * k + 1e-3 * (rand_r(&seed) % 6284);
            for (int i = 0; i < 3; i++) {
                const double far = 30.04e-6 + 1e-7 * (rand_r(&seed) % 2500), angle = toward + 1e-3 * (rand_r(&seed) % 1500);
                at[k][i] = (fw_geometry_vec2){far * cos(angle), far * sin(angle)};
                placed[i] = (fw_geometry_vec2){w.x + at[k][i].x, w.y + at[k][i].y};
            }
            c[k] = triangle(arena, placed);
        }
        double want = M_PI;
        for (int k = 1; k <= 400; k++) {
            double p[6], q[6];
            const int np = directions(at[0], radius * k / 400, p), nq = directions(at[1], radius * k / 400, q);
            for (int i = 0; i < np * nq; i++)
                want = fmin(want, fabs(remainder(p[i / nq] - q[i % nq], 2 * M_PI)));
        }
        assert_near(fw_layout_free_rotation(w, &c[0], &c[1], radius), want, 1e-7);
        met += want < M_PI;
    }
    assert_true(met > 200);
    fw_arena_free(arena);
}

/* the same two as their edges move: a corner of one nears the flat of the other by 2 d, and what passes as drawn does
   not where both have grown into each other's way */
static void free_rotation_as_made(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_layout_hinge_layout h = {.centre = {1e-3, -2e-3}, .keep_out_m = 50e-6};
    double now;
    for (int n = -3; n <= 3; n++) {
        const double d = n * 0.7e-6, inner = n < 0 ? 70e-6 - d : 70e-6; /* a corner that recedes stays sharp */
        const double flat = n < 0 ? 2 * asin(d / inner) : asin(2 * d / inner);
        assert_int_equal(
            fw_geometry_contour_ring_sector(arena, h.centre, 50e-6, 90e-6, 0.0, 1.0, &h.solid[0]), FW_OK);
        assert_int_equal(
            fw_geometry_contour_ring_sector(arena, h.centre, 70e-6, 120e-6, 1.4, 2.0, &h.solid[1]), FW_OK);
        assert_int_equal(fw_layout_free_rotation_made(arena, &h, d, &now), FW_OK);
        /* of receding ones the outer end is the nearest; the circles are 0.5 um apart */
        const double want = n < 0 ? 0.4 - 2 * asin(d / (90e-6 + d)) : 0.4 - flat;
        assert_near(now, want, 3e-4);
        assert_int_equal(
            fw_geometry_contour_ring_sector(arena, h.centre, 95e-6, 120e-6, 1.4, 2.0, &h.solid[1]), FW_OK);
        assert_int_equal(fw_layout_free_rotation_made(arena, &h, d, &now), FW_OK);
        assert_near(now, M_PI, 0.0);
    }
    const double met = acos((90e-6 * 90e-6 + 95e-6 * 95e-6 - 6e-6 * 6e-6) / (2 * 90e-6 * 95e-6));
    assert_int_equal(fw_layout_free_rotation_made(arena, &h, 3e-6, &now), FW_OK);
    assert_near(now, 0.4 - met, 3e-3);
    fw_arena_free(arena);
}

/* counter-clockwise; its corners are blunter than 0.3 rad, and its inner circle is larger than 4 d */
static bool is_plain(fw_geometry_vec2 at[3], double d) {
    double length[3], twice = (at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[1].y - at[0].y) * (at[2].x - at[0].x);
    if (twice < 0) {
        const fw_geometry_vec2 other = at[1];
        at[1] = at[2], at[2] = other, twice = -twice;
    }
    for (int i = 0; i < 3; i++)
        length[i] = hypot(at[(i + 1) % 3].x - at[i].x, at[(i + 1) % 3].y - at[i].y);
    for (int i = 0; i < 3; i++)
        if (twice < length[i] * length[(i + 1) % 3] * sin(0.3)) return false;
    return twice / (length[0] + length[1] + length[2]) > 4 * fabs(d);
}

/* the triangle of the lines d farther in */
static void receded(const fw_geometry_vec2 at[3], double d, fw_geometry_vec2 to[3]) {
    for (int i = 0; i < 3; i++) {
        const fw_geometry_vec2 a = at[(i + 2) % 3], b = at[i], c = at[(i + 1) % 3];
        const double p = hypot(a.x - b.x, a.y - b.y), q = hypot(c.x - b.x, c.y - b.y);
        const double ux = (a.x - b.x) / p, uy = (a.y - b.y) / p, vx = (c.x - b.x) / q, vy = (c.y - b.y) / q;
        const double far = d / fabs(ux * vy - uy * vx); /* along either side, d from the other */
        to[i] = (fw_geometry_vec2){b.x + far * (ux + vx), b.y + far * (uy + vy)};
    }
}

/* by which the first turns about w until it is `apart` from the second; M_PI: it never is, < 0: as drawn */
static double turned_until(fw_arena *arena, fw_geometry_vec2 w, const fw_geometry_contour *c, double apart, int way) {
    const double reach = 300e-6; /* no point of it moves farther by 1 rad */
    double turn = 0;
    for (int i = 0; i < 3000 && turn < M_PI; i++) {
        const double by = way * turn;
        const fw_geometry_pose pose = {w.x - (cos(by) * w.x - sin(by) * w.y), w.y - (sin(by) * w.x + cos(by) * w.y), by};
        const fw_mark mark = fw_arena_mark(arena);
        fw_geometry_contour now;
        assert_int_equal(fw_geometry_contour_transform(arena, &c[0], pose, false, &now), FW_OK);
        const double left = fw_geometry_contour_distance(&now, &c[1], NULL, NULL) - apart;
        fw_arena_rewind(arena, mark);
        if (i == 0 && left < 1e-6) return -1;
        if (left < 2e-9) return turn;
        turn += left / reach;
    }
    return fmin(turn, M_PI);
}

/* random triangles whose edges move out or in: out, they touch where they were 2 d apart; in, where smaller triangles do */
static void free_rotation_of_any_two_as_made(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_layout_hinge_layout h = {.centre = {1e-3, -2e-3}, .keep_out_m = 50e-6};
    unsigned seed = 27;
    int met[2] = {0, 0};
    for (int trial = 0; met[0] + met[1] < 60; trial++) {
        const double d = (trial % 2 ? 1 : -1) * (1e-6 + 1e-8 * (rand_r(&seed) % 300));
        fw_geometry_contour made[2];
        bool plain = true;
        for (int k = 0; k < 2; k++) {
            fw_geometry_vec2 at[3], to[3];
            const double toward = 2.2 * k + 1e-3 * (rand_r(&seed) % 1500);
            for (int i = 0; i < 3; i++) {
                const double far = 30.04e-6 + 1e-7 * (rand_r(&seed) % 1500), angle = toward + 1e-3 * (rand_r(&seed) % 1500);
                at[i] = (fw_geometry_vec2){h.centre.x + far * cos(angle), h.centre.y + far * sin(angle)};
            }
            plain = plain && is_plain(at, d);
            h.solid[k] = made[k] = triangle(arena, at);
            if (d < 0 && plain) receded(at, -d, to), made[k] = triangle(arena, to);
        }
        if (!plain) continue;
        const double apart = d > 0 ? 2 * d : 0, one = turned_until(arena, h.centre, made, apart, 1), other = turned_until(arena, h.centre, made, apart, -1);
        double now;
        if (one < 0) continue;
        assert_int_equal(fw_layout_free_rotation_made(arena, &h, d, &now), FW_OK);
        if (fabs(now - fmin(one, other)) > 0.02) fail_msg("%d: %g um: %g, and not %g", trial, 1e6 * d, now, fmin(one, other));
        met[d > 0] += now < 3;
    }
    assert_true(met[0] > 15 && met[1] > 15);
    fw_arena_free(arena);
}

static void symmetric_device_gives_symmetric_layout(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    for (int i = 0; i < 3; i++) { /* D E F from C B A, mirrored at x = 1.5 mm */
        f.revolute[5 - i].x_m = 3e-3 - f.revolute[i].x_m;
        f.revolute[5 - i].y_m = f.revolute[i].y_m;
        f.flexure[5 - i].length_m = f.flexure[i].length_m;
        f.flexure[5 - i].width_m = f.flexure[i].width_m;
        f.flexure[5 - i].radius_m = f.flexure[i].radius_m;
    }
    drawn d = draw_well(&f);
    for (int i = 0; i < 3; i++) {
        const fw_layout_hinge_layout *p = &d.layout->hinge[i], *q = &d.layout->hinge[5 - i];
        assert_near(p->keep_out_m, q->keep_out_m, 1e-15);
        assert_near(p->free_rad, q->free_rad, 1e-6);
        assert_near(p->arc_centre.x + q->arc_centre.x, 3e-3, 1e-12);
        assert_near(p->arc_centre.y, q->arc_centre.y, 1e-12);
    }
    for (int b = 0; b < 3; b++) {
        const fw_layout_body_layout *p = &d.layout->body[b], *q = &d.layout->body[4 - b];
        assert_relative(p->area_m2, q->area_m2, 1e-9);
        assert_relative(p->polar_m4, q->polar_m4, 1e-9);
        assert_near(p->centroid.x + q->centroid.x, 3e-3, 1e-12);
        assert_near(p->centroid.y, q->centroid.y, 1e-12);
        assert_relative(
            fw_geometry_contour_area(&find(d.layout, FW_ROLE_STRUCTURE, b, FW_NONE)->contour),
            fw_geometry_contour_area(&find(d.layout, FW_ROLE_STRUCTURE, 4 - b, FW_NONE)->contour),
            1e-9);
    }
    fw_arena_free(d.arena);
}

/* short and long arcs, all angles: drawn whole, or refused with the reason */
static void variants_are_drawn_or_refused(void **state) {
    (void)state;
    static const double factor[] = {1.0, 0.5, 0.25};
    int refused = 0;
    for (int six = 0; six < 2; six++)
        for (size_t i = 0; i < 3; i++)
            for (double angle = 120.0; angle <= 300.0; angle += 30.0) {
                fixture f;
                if (six)
                    fixture_six_bar(&f);
                else
                    fixture_four_bar(&f);
                fixture_flexures(&f, factor[i], angle);
                drawn d = draw(&f);
                if (d.status == FW_OK) {
                    check_pieces(d.layout);
                    check_disjoint(d.layout);
                    assert_true(d.layout->narrowest_gap_m >= 8e-6 * (1.0 - 1e-9));
                    for (int j = 0; j < f.device.nrevolute; j++)
                        assert_true(d.layout->hinge[j].free_rad > 0.1);
                } else {
                    assert_int_equal(d.status, FW_GEOMETRY);
                    assert_int_equal(d.diags.item[0].number, 121);
                    refused++;
                    assert_true(factor[i] < 0.3 && angle > 250.0);
                }
                fw_arena_free(d.arena);
            }
    assert_true(refused > 0);
}

static void expect_refused(const fixture *f, int number, int line, const char *part) {
    fw_arena *arena = fw_arena_new(0);
    assert_non_null(arena);
    fw_diags diags = fw_diags_new(arena);
    const fw_layout *l;
    assert_int_equal(fw_layout_build(arena, &f->device, &diags, &l), FW_GEOMETRY);
    assert_int_equal(diags.errors, 1);
    assert_int_equal(diags.item[0].number, number);
    assert_int_equal(diags.item[0].place.line, line);
    if (!strstr(diags.item[0].message, part)) fail_msg("%s: %s", part, diags.item[0].message);
    fw_arena_free(arena);
}

/* a fillet that does not fit is refused at its own place, once per flexure, and what the message
   names as the largest one is drawn */
static void a_fillet_that_does_not_fit(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    f.flexure[1].fillet_m = 5e-6;
    drawn d = draw_well(&f);
    if (d.diags.count) fail_msg("%s", d.diags.item[0].message);
    assert_near(d.layout->hinge[1].fillet_m, 5e-6, 1e-18);
    fw_arena_free(d.arena);
    f.flexure[1].fillet_m = 100e-6;
    f.flexure[1].fillet_place = (fw_place){"test.xml", 12, 3};
    f.revolute[2].flexure = 1; /* two hinges with one flexure */
    expect_refused(&f, 129, 12, "a fillet of 100 um does not fit");
    double radius = 250e-6 / f.flexure[1].angle_rad, inner = radius - 0.5 * 8.5e-6;
    f.flexure[1].fillet_m = 0.3 * inner;
    d = draw_well(&f);
    assert_near(d.layout->hinge[1].fillet_m, 0.3 * inner, 1e-15);
    fw_arena_free(d.arena);
}

/* twice the farthest corner of a bar from the line between its hinges, beyond their discs */
static double width_across(const drawn *d, const fixture *f, int body) {
    const fw_device_revolute *p = &f->revolute[body], *q = p + 1;
    double length = hypot(q->x_m - p->x_m, q->y_m - p->y_m), most = 0.0;
    double from = d->layout->hinge[body].keep_out_m,
           to = length - d->layout->hinge[body + 1].keep_out_m;
    fw_geometry_vec2 u = {(q->x_m - p->x_m) / length, (q->y_m - p->y_m) / length};
    for (int i = 0; i < d->layout->npiece; i++) {
        const fw_layout_piece *piece = &d->layout->piece[i];
        if (piece->role != FW_ROLE_STRUCTURE || piece->body != body) continue;
        for (int k = 0; k < piece->contour.count; k++) {
            fw_geometry_vec2 a = piece->contour.segment[k].a;
            double x = (a.x - p->x_m) * u.x + (a.y - p->y_m) * u.y;
            double y = (a.y - p->y_m) * u.x - (a.x - p->x_m) * u.y;
            if (x > from && x < to) most = fmax(most, 2.0 * fabs(y));
        }
    }
    return most;
}

/* A link is drawn as wide as the file states, or refused at its width. 900 um was once drawn as a
   lozenge of 200 um without a word. What the message names as the widest is drawn. */
static void a_link_is_as_wide_as_stated_or_refused(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    f.body[0].width_m = 900e-6;
    f.body[0].width_place = (fw_place){"test.xml", 32, 26};
    expect_refused(&f, 137, 32, "link AB: a bar 900 um wide cannot be drawn");
    double low = 120e-6, high = 900e-6; /* the widest that is not refused for its own sake */
    while (high - low > 0.2e-6) {
        fw_arena *arena = fw_arena_new(0);
        assert_non_null(arena);
        fw_diags diags = fw_diags_new(arena);
        const fw_layout *l;
        f.body[0].width_m = 0.5 * (low + high);
        fw_status status = fw_layout_build(arena, &f.device, &diags, &l);
        *(status == FW_OK ? &low : &high) = f.body[0].width_m;
        if (status == FW_OK) {
            drawn d = {.layout = l};
            assert_near(width_across(&d, &f, 0), f.body[0].width_m, 2e-9);
        } else
            assert_true(diags.item[0].number == 137 || diags.item[0].number == 120);
        fw_arena_free(arena);
    }
    assert_true(low > 300e-6);
}

/* what a die states is kept: its size with the stated clearance, and its title */
static void a_die_is_as_stated_or_refused(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    f.device.die.width_m = f.device.die.height_m = NONE;
    drawn free = draw_well(&f);
    double width = free.layout->die.x1 - free.layout->die.x0; /* at a clearance of 150 um */
    fw_arena_free(free.arena);
    f.device.die.width_m = width - 100e-6;
    f.device.die.width_place = (fw_place){"test.xml", 40, 8};
    drawn d = draw_well(&f); /* no clearance stated: 100 um are enough */
    assert_int_equal(d.diags.count, 0);
    fw_arena_free(d.arena);
    f.device.die.clearance_m = 150e-6;
    expect_refused(&f, 124, 40, "150 um of clearance on either side (as the file asks)");
    f.device.die.width_m = width + 1e-6;
    char title[300];
    memset(title, 'W', sizeof title - 1);
    title[sizeof title - 1] = '\0';
    f.device.die.title = title;
    f.device.die.title_place = (fw_place){"test.xml", 40, 50};
    d = draw_well(&f);
    assert_int_equal(d.diags.count, 1);
    assert_int_equal(d.diags.item[0].number, 139);
    assert_int_equal(d.diags.item[0].place.column, 50);
    fw_arena_free(d.arena);
}

/* a body with three hinges and a base per ground hinge; a turned plate on one hinge */
static void other_mechanisms_are_drawn(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        fixture f;
        if (i)
            fixture_stage(&f);
        else
            fixture_paddle(&f);
        drawn d = draw_well(&f);
        check_pieces(d.layout);
        check_disjoint(d.layout);
        for (int j = 0; j < f.device.nrevolute; j++)
            assert_true(d.layout->hinge[j].free_rad > 0.4);
        int bases = 0;
        for (int k = 0; k < d.layout->npiece; k++)
            bases += d.layout->piece[k].role == FW_ROLE_STRUCTURE &&
                     d.layout->piece[k].body == FW_GROUND;
        assert_int_equal(bases, i ? 3 : 1);
        fw_arena_free(d.arena);
    }
}

/* half the width of the bar between two ground hinges on the x axis: its longest side is parallel to it */
static double base_half_width(const fw_layout *l) {
    double longest = 0, half = 0;
    for (int i = 0; i < l->npiece; i++) {
        const fw_layout_piece *p = &l->piece[i];
        for (int k = 0; p->role == FW_ROLE_STRUCTURE && p->body == FW_GROUND && k < p->contour.count; k++) {
            const fw_geometry_segment *s = &p->contour.segment[k];
            double length = fabs(s->b.x - s->a.x);
            if (s->kind == FW_LINE && fabs(s->b.y - s->a.y) < 1e-9 * length && length > longest && s->a.x > 0.2e-3 && s->a.x < 1.3e-3)
                longest = length, half = fabs(s->a.y);
        }
    }
    return half;
}

/* <die anchor="..."/> is how wide bases are: device.md */
static void a_base_is_as_wide_as_its_anchor(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        fixture f;
        fixture_four_bar(&f);
        f.device.die.anchor_m = (60 + 30 * i) * 1e-6;
        drawn d = draw_well(&f);
        assert_near(base_half_width(d.layout), 0.5 * f.device.die.anchor_m, 1e-9);
        fw_arena_free(d.arena);
    }
}

static void leaf_is_exact(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    for (int i = 0; i < 6; i++) {
        f.flexure[i].kind = FW_FLEXURE_LEAF;
        f.flexure[i].angle_rad = f.flexure[i].radius_m = NONE;
        f.flexure[i].length_m *= 0.8;
    }
    drawn d = draw_well(&f);
    check_pieces(d.layout);
    check_disjoint(d.layout);
    for (int j = 0; j < 6; j++) {
        const fw_layout_hinge_layout *h = &d.layout->hinge[j];
        const fw_geometry_contour *c = &find(d.layout, FW_ROLE_FLEXURE, 0, j)->contour;
        fw_geometry_region region = {(fw_geometry_contour *)c, 1};
        fw_geometry_moments m = fw_geometry_region_moments(&region);
        double length = f.flexure[j].length_m - 2.0 * h->fillet_m;
        assert_near(m.centroid.x, f.revolute[j].x_m, 1e-15);
        assert_near(m.centroid.y, f.revolute[j].y_m, 1e-15);
        assert_relative(m.area_m2, length * f.flexure[j].width_m, 1e-12);
    }
    fw_arena_free(d.arena);
}

static bool said(const drawn *d, int number, const char *a, const char *b) {
    for (size_t i = 0; i < d->diags.count; i++)
        if (d->diags.item[i].number == number && strstr(d->diags.item[i].message, a) &&
            strstr(d->diags.item[i].message, b))
            return true;
    return false;
}

static void tight_devices_are_refused(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f); /* the plate reaches over the links' hinges and the links */
    f.body[2].plate_width_m = 2.0e-3;
    f.body[2].plate_height_m = 1.4e-3;
    f.body[2].plate_y_m = 2.4e-3;
    drawn d = draw(&f);
    assert_int_equal(d.status, FW_GEOMETRY);
    assert_true(said(&d, 120, "link BC", "platform CD"));
    fw_arena_free(d.arena);

    fixture_six_bar(&f);
    f.revolute[2].x_m = 1.4e-3;
    f.revolute[3].x_m = 1.6e-3;
    d = draw(&f);
    assert_int_equal(d.status, FW_GEOMETRY);
    assert_true(said(&d, 125, "hinges C and D", "um apart"));
    fw_arena_free(d.arena);

    fixture_six_bar(&f);
    f.device.die.width_m = 3.5e-3;
    d = draw(&f);
    assert_int_equal(d.status, FW_GEOMETRY);
    assert_true(said(&d, 124, "width", "3500 um"));
    fw_arena_free(d.arena);

    fixture_four_bar(&f);
    f.revolute[0].axis_rad =
        130.0 * M_PI / 180.0; /* the crank leaves where the surfaces should be */
    d = draw(&f);
    assert_int_equal(d.status, FW_GEOMETRY);
    assert_true(said(&d, 122, "hinge P", "conjugate"));
    fw_arena_free(d.arena);
}

static void bulge_may_be_turned(void **state) {
    (void)state;
    fixture f;
    for (int step = 0; step < 12; step++) {
        fixture_six_bar(&f);
        f.revolute[1].axis_rad = step * M_PI / 6.0;
        drawn d = draw(&f);
        assert_true(d.status == FW_OK || d.diags.errors > 0);
        if (d.status == FW_OK) {
            check_pieces(d.layout);
            check_disjoint(d.layout);
        }
        if (step == 0 || step == 6) assert_int_equal(d.status, FW_OK);
        fw_arena_free(d.arena);
    }
}

static void gap_may_be_small_or_absent(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    for (int i = 0; i < 6; i++)
        f.flexure[i].gap_m = i == 2 ? 3e-6 : 0.0;
    drawn d = draw_well(&f);
    check_pieces(d.layout);
    assert_near(d.layout->narrowest_gap_m, 3e-6, 1e-12);
    assert_near(d.layout->hinge[0].surface_radius_m, 0.0, 0.0);
    assert_true(d.layout->hinge[2].surface_radius_m > 50e-6);
    fw_arena_free(d.arena);
}

static void without_shapes_nothing_is_drawn(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    f.body[3].width_m = NONE;
    drawn d = draw(&f);
    assert_int_equal(d.status, FW_OK);
    assert_false(d.layout->drawn);
    assert_non_null(strstr(d.layout->why_not, "DE"));
    fw_arena_free(d.arena);
    fixture_six_bar(&f);
    f.revolute[4].flexure = FW_NONE;
    d = draw(&f);
    assert_int_equal(d.status, FW_OK);
    assert_false(d.layout->drawn);
    assert_non_null(strstr(d.layout->why_not, "E"));
    assert_near(d.layout->body[0].area_m2, 0.0, 0.0);
    fw_arena_free(d.arena);
}

/* joints that are no flexures are left out of the drawing, and that is said; drivers need no shape
 */
static void joints_are_not_drawn(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    fw_device_joint joint = {.id = "rod",
                             .kind = FW_JOINT_DISTANCE,
                             .body_a = 2,
                             .body_b = FW_GROUND,
                             .place = {"d.xml", 5, 3}};
    fw_device_driver driver = {.revolute = 0, .joint = FW_NONE};
    drawn plain = draw_well(&f);
    f.device.driver = &driver, f.device.ndriver = 1;
    drawn driven = draw_well(&f);
    assert_int_equal(driven.diags.count, plain.diags.count);
    f.device.joint = &joint, f.device.njoint = 1;
    drawn d = draw_well(&f);
    assert_int_equal(d.diags.count, plain.diags.count + 1);
    assert_true(said(&d, 130, "distance", "rod"));
    assert_int_equal(d.layout->npiece, plain.layout->npiece);
    fw_arena_free(plain.arena);
    fw_arena_free(driven.arena);
    fw_arena_free(d.arena);
}

/* far more than anybody draws: refused at once, not after hours */
static void large_mechanisms_are_not_drawn(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    f.device.nbody = 2001; /* none of them is looked at */
    drawn d = draw(&f);
    assert_int_equal(d.status, FW_OK);
    assert_false(d.layout->drawn);
    assert_non_null(strstr(d.layout->why_not, "2000"));
    fw_arena_free(d.arena);
}

/* how far walls stand out below: what their edges do and what they lean, whichever way */
static void walls_lean_either_way(void **state) {
    (void)state;
    const fw_layout in = {.edge_m = 1e-7, .flare_m = -3e-7}, out = {.edge_m = -1e-7, .flare_m = 3e-7};
    assert_near(fw_layout_walls_m(&in), 5e-7, 1e-20);
    assert_near(fw_layout_walls_m(&out), 1e-7, 1e-20);
}

static void same_input_same_outlines(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    drawn a = draw_well(&f), b = draw_well(&f);
    assert_int_equal(a.layout->npiece, b.layout->npiece);
    for (int i = 0; i < a.layout->npiece; i++) {
        const fw_geometry_contour *p = &a.layout->piece[i].contour,
                                  *q = &b.layout->piece[i].contour;
        assert_int_equal(p->count, q->count);
        for (int k = 0; k < p->count; k++) {
            assert_true(same(p->segment[k].a, q->segment[k].a));
            assert_true(p->segment[k].sweep_rad == q->segment[k].sweep_rad);
        }
    }
    fw_arena_free(a.arena);
    fw_arena_free(b.arena);
}

static void out_of_memory_is_reported(void **state) {
    (void)state;
    fixture f;
    fixture_six_bar(&f);
    long before = fw_arena_count();
    drawn whole = draw_well(&f);
    long count = fw_arena_count() - before;
    fw_arena_free(whole.arena);
    for (long n = 1; n <= count; n += n < 200 ? 1 : 7) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        const fw_layout *layout = NULL;
        fw_arena_fail_at(n, 1);
        fw_status status = fw_layout_build(arena, &f.device, &diags, &layout);
        fw_arena_fail_at(0, 0);
        if (status == FW_OK)
            assert_true(n > count - 3); /* the arena itself and the list of diagnostics */
        else
            assert_int_equal(status, FW_NOMEM);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reference_is_one_connected_device),
        cmocka_unit_test(hinge_is_exact),
        cmocka_unit_test(root_fillets_are_tangent),
        cmocka_unit_test(areas_agree_with_counted_points),
        cmocka_unit_test(tethers_change_no_body),
        cmocka_unit_test(tethers_break_at_the_body),
        cmocka_unit_test(free_rotation_is_free),
        cmocka_unit_test(free_rotation_of_two_sectors),
        cmocka_unit_test(free_rotation_of_any_two),
        cmocka_unit_test(free_rotation_as_made),
        cmocka_unit_test(free_rotation_of_any_two_as_made),
        cmocka_unit_test(symmetric_device_gives_symmetric_layout),
        cmocka_unit_test(variants_are_drawn_or_refused),
        cmocka_unit_test(other_mechanisms_are_drawn),
        cmocka_unit_test(a_base_is_as_wide_as_its_anchor),
        cmocka_unit_test(leaf_is_exact),
        cmocka_unit_test(tight_devices_are_refused),
        cmocka_unit_test(a_fillet_that_does_not_fit),
        cmocka_unit_test(a_link_is_as_wide_as_stated_or_refused),
        cmocka_unit_test(a_die_is_as_stated_or_refused),
        cmocka_unit_test(bulge_may_be_turned),
        cmocka_unit_test(gap_may_be_small_or_absent),
        cmocka_unit_test(without_shapes_nothing_is_drawn),
        cmocka_unit_test(joints_are_not_drawn),
        cmocka_unit_test(large_mechanisms_are_not_drawn),
        cmocka_unit_test(walls_lean_either_way),
        cmocka_unit_test(same_input_same_outlines),
        cmocka_unit_test(out_of_memory_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
