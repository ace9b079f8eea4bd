/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Release holes in the bodies of a device. */
#include "test.h"
#include "fixture.h"
#include "geometry/segment.h"
#include "layout/pattern.h"
#include <stdlib.h>

#define UM 1e-6

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    fixture f;
    const fw_layout *layout;
} drawn;

static drawn *draw(double pitch_um, double hole_um) {
    fw_arena *arena = fw_arena_new(0);
    drawn *d = fw_arena_one(arena, drawn);
    d->arena = arena;
    d->diags = fw_diags_new(arena);
    fixture_six_bar(&d->f);
    d->f.device.die.tethers = false;
    d->f.device.release_pitch_m = pitch_um * UM;
    d->f.device.release_hole_m = hole_um * UM;
    fw_status status = fw_layout_build(arena, &d->f.device, &d->diags, &d->layout);
    if (status != FW_OK) fail_msg("%s", d->diags.count ? d->diags.item[0].message : "no message");
    return d;
}

static fw_geometry_region pieces_of(const drawn *d, int body) {
    fw_geometry_region r = {
        fw_arena_array(d->arena, fw_geometry_contour, (size_t)d->layout->npiece), 0};
    for (int i = 0; i < d->layout->npiece; i++)
        if (d->layout->piece[i].body == body && d->layout->piece[i].role == FW_ROLE_STRUCTURE)
            r.contour[r.count++] = d->layout->piece[i].contour;
    for (int i = 1; i < r.count; i++) /* the body itself first */
        if (fw_geometry_contour_area(&r.contour[i]) > fw_geometry_contour_area(&r.contour[0])) {
            fw_geometry_contour t = r.contour[0];
            r.contour[0] = r.contour[i];
            r.contour[i] = t;
        }
    return r;
}

/* area, first and second moments about the origin */
static void about_origin(double area, fw_geometry_vec2 c, double polar, double out[4]) {
    out[0] = area, out[1] = area * c.x, out[2] = area * c.y;
    out[3] = polar + area * (c.x * c.x + c.y * c.y);
}

/* what holes take off the mechanics equals Green's theorem over the body's own pieces with and
   without them, and they are whole discs */
static void moments_follow(void **state) {
    (void)state;
    drawn *plain = draw(0, 0), *holes = draw(40, 12);
    int bodies = 0;
    for (int b = 0; b < 5; b++) {
        fw_geometry_region r = pieces_of(holes, b), whole = pieces_of(plain, b);
        fw_geometry_moments m = fw_geometry_region_moments(&r),
                            before = fw_geometry_region_moments(&whole);
        const fw_layout_body_layout *l = &holes->layout->body[b], *p = &plain->layout->body[b];
        double with[4], without[4], left[4], all[4];
        about_origin(l->area_m2, l->centroid, l->polar_m4, with);
        about_origin(p->area_m2, p->centroid, p->polar_m4, without);
        about_origin(m.area_m2, m.centroid, m.polar_m4, left);
        about_origin(before.area_m2, before.centroid, before.polar_m4, all);
        for (int k = 0; k < 4; k++)
            assert_near(without[k] - with[k], all[k] - left[k], 1e-10 * all[k]);
        double turn = 2 * M_PI * 6e-6 * (r.count - 1);
        assert_relative(l->perimeter_m, p->perimeter_m + turn, 1e-12);
        const fw_geometry_vec2 by = {l->centroid.x - p->centroid.x, l->centroid.y - p->centroid.y};
        double edge_x = p->edge_m2.x - p->perimeter_m * by.x,
               square = p->edge_m3 - 2 * (p->edge_m2.x * by.x + p->edge_m2.y * by.y) +
                        p->perimeter_m * (by.x * by.x + by.y * by.y);
        for (int i = 1; i < r.count; i++) { /* their edges, about the new centroid */
            fw_geometry_vec2 hole = r.contour[i].segment[2].centre;
            double x = hole.x - l->centroid.x, y = hole.y - l->centroid.y, round = 2 * M_PI * 6e-6;
            edge_x += round * x;
            square += round * (x * x + y * y + 36e-12);
        }
        assert_near(l->edge_m2.x, edge_x, 1e-9 * l->perimeter_m * 1e-3);
        assert_relative(l->edge_m3, square, 1e-9);
        double n = (p->area_m2 - l->area_m2) / (M_PI * 36e-12);
        assert_near(n, nearbyint(n), 1e-6);
        assert_int_equal(nearbyint(n), r.count - 1); /* one cap for each hole */
        assert_relative(l->perimeter_m, p->perimeter_m + M_PI * 12e-6 * nearbyint(n), 1e-12);
        bodies += n > 10;
    }
    assert_int_equal(bodies, 5);
    fw_arena_free(plain->arena);
    fw_arena_free(holes->arena);
}

/* no hole near a flexure or an edge: the bodies' own outlines outside are what they were */
static void holes_keep_away(void **state) {
    (void)state;
    drawn *plain = draw(0, 0), *d = draw(40, 12);
    int holes = 0, heads = 0;
    for (int b = 0; b < 5; b++) {
        fw_geometry_region before = pieces_of(plain, b), after = pieces_of(d, b);
        for (int i = 1; i < after.count; i++) { /* caps: the end inside is an arc of a hole */
            const fw_geometry_contour *cap = &after.contour[i];
            fw_geometry_vec2 middle = cap->segment[2].centre;
            double t, least = HUGE_VAL;
            fw_geometry_vec2 at;
            for (int k = 0; k < before.contour[0].count; k++) {
                const fw_geometry_segment *e = &before.contour[0].segment[k];
                double x = e->b.x - e->a.x, y = e->b.y - e->a.y, l = x * x + y * y;
                if (e->kind != FW_LINE || l == 0) continue;
                t = fmin(1, fmax(0, ((middle.x - e->a.x) * x + (middle.y - e->a.y) * y) / l));
                at = (fw_geometry_vec2){e->a.x + t * x, e->a.y + t * y};
                least = fmin(least, hypot(at.x - middle.x, at.y - middle.y));
            }
            assert_true(least >= 20 * UM - 1e-9);
            for (int k = 0; k < d->layout->npiece; k++) { /* and three widths from flexures */
                const fw_layout_piece *f = &d->layout->piece[k];
                for (int s = 0; f->role == FW_ROLE_FLEXURE && s < f->contour.count; s++)
                    assert_true(fw_geometry_segment_nearest(&f->contour.segment[s], middle, &t,
                                                            &at) >= (20 + 3 * 6) * UM);
            }
            for (int j = 0; j < 6; j++) {
                fw_geometry_vec2 w = d->layout->hinge[j].centre;
                heads += hypot(middle.x - w.x, middle.y - w.y) < d->layout->hinge[j].keep_out_m;
            }
            holes++;
        }
    }
    assert_true(holes > 300);
    assert_true(heads > 5); /* in the heads and necks of the hinges, too */
    for (int j = 0; j < 6; j++)
        assert_true(d->layout->hinge[j].free_rad == plain->layout->hinge[j].free_rad);
    fw_arena_free(plain->arena);
    fw_arena_free(d->arena);
}

/* every cut fits: bit for bit, also after a bias to either side */
static void cuts_fit(void **state) {
    (void)state;
    drawn *plain = draw(0, 0), *d = draw(40, 12);
    static const double bias[] = {0, 1.1e-6, -1.1e-6};
    for (int k = 0; k < 3; k++)
        for (int b = 0; b < 5; b++) {
            fw_geometry_region r = pieces_of(d, b);
            double area = 0, cut = 0;
            for (int i = 0; i < r.count; i++) {
                fw_geometry_contour out = r.contour[i];
                int p, q;
                if (bias[k] != 0)
                    assert_int_equal(
                        fw_geometry_contour_offset(d->arena, &r.contour[i], bias[k], &out, &p, &q),
                        FW_OK);
                area += fw_geometry_contour_area(&out);
                cut += i > 0;
                r.contour[i] = out;
            }
            int joints = 0, paired = 0;
            for (int i = 1; i < r.count; i++)
                for (int s = 0; s < r.contour[i].count; s++) {
                    const fw_geometry_segment *u = &r.contour[i].segment[s];
                    if (!(u->flags & FW_SEGMENT_JOINT)) continue;
                    joints++;
                    for (int t = 0; t < r.contour[0].count; t++) {
                        const fw_geometry_segment *v = &r.contour[0].segment[t];
                        paired += v->flags & FW_SEGMENT_JOINT &&
                                  hypot(u->a.x - v->b.x, u->a.y - v->b.y) < 1e-12 &&
                                  hypot(u->b.x - v->a.x, u->b.y - v->a.y) < 1e-12;
                    }
                }
            assert_int_equal(joints, 2 * (int)cut);
            assert_int_equal(paired, joints);
            fw_geometry_region before = pieces_of(plain, b);
            double whole = fw_geometry_region_moments(&before).area_m2;
            double taken = plain->layout->body[b].area_m2 - d->layout->body[b].area_m2;
            if (bias[k] == 0) assert_near(whole - area, taken, 1e-11 * whole);
        }
    fw_arena_free(plain->arena);
    fw_arena_free(d->arena);
}

/* every hole is whole: no cut of another comes nearer to its middle than its rim, whatever the pitch */
static void holes_are_off_the_cuts_of_others(void **state) {
    (void)state;
    for (double pitch = 28; pitch < 46; pitch += 2) {
        drawn *d = draw(pitch, 0.3 * pitch);
        for (int b = 0; b < 5; b++) {
            fw_geometry_region r = pieces_of(d, b);
            const fw_geometry_contour *body = &r.contour[0];
            for (int i = 1; i < r.count; i++) { /* of a cap the third is the rim of its hole */
                fw_geometry_vec2 middle = r.contour[i].segment[2].centre, at;
                double t;
                for (int k = 0; k < body->count; k++)
                    if (body->segment[k].flags & FW_SEGMENT_THROUGH)
                        assert_true(fw_geometry_segment_nearest(&body->segment[k], middle, &t,
                                                                &at) > 0.15 * pitch * UM - 1e-9);
            }
        }
        fw_arena_free(d->arena);
    }
}

/* nothing else of the outline lies within 2.5 um of the sides of a cut, on its way to straight edges, to round ones and to other holes */
static void cuts_lie_in_solid(void **state) {
    (void)state;
    int cuts = 0;
    for (double pitch = 27; pitch < 47; pitch += 4) {
        drawn *d = draw(pitch, 0.3 * pitch);
        for (int b = 0; b < 5; b++) {
            fw_geometry_region r = pieces_of(d, b);
            const fw_geometry_contour *body = &r.contour[0];
            for (int i = 0; i < body->count; i++) {
                const fw_geometry_segment *side = &body->segment[i];
                if (!(side->flags & FW_SEGMENT_THROUGH)) continue;
                cuts++;
                for (int k = 0; k < body->count; k++) {
                    const fw_geometry_segment *s = &body->segment[k];
                    fw_geometry_vec2 p, q;
                    if (abs(k - i) % (body->count - 2) < 3) continue; /* its own edge and hole, and the other side */
                    double far = fw_geometry_segment_distance(side, s, &p, &q);
                    if (far < 2.5e-6 - 1e-10) fail_msg("%g um beside a cut at pitch %g", 1e6 * far, pitch);
                }
            }
        }
        fw_arena_free(d->arena);
    }
    assert_true(cuts > 500);
}

/* a body narrower than the reach has none; a pitch that large leaves the drawing as it was */
static void narrow_bodies_have_none(void **state) {
    (void)state;
    drawn *plain = draw(0, 0), *d = draw(120, 12); /* reach 79 um, bars 120 um wide */
    for (int b = 0; b < 5; b++) {
        fw_geometry_region p = pieces_of(plain, b), q = pieces_of(d, b);
        if (b == 2) {
            assert_true(q.count > p.count); /* the platform is wide */
            continue;
        }
        assert_int_equal(p.count, q.count);
        assert_true(plain->layout->body[b].area_m2 == d->layout->body[b].area_m2);
    }
    fw_arena_free(plain->arena);
    fw_arena_free(d->arena);
}

static void wrong_sizes(void **state) {
    (void)state;
    static const double bad[][2] = {{40, 21}, {20, 6}, {40, 7.9}};
    for (int i = 0; i < 3; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fixture f;
        const fw_layout *layout;
        fixture_six_bar(&f);
        f.device.release_pitch_m = bad[i][0] * UM;
        f.device.release_hole_m = bad[i][1] * UM;
        assert_int_equal(fw_layout_build(arena, &f.device, &diags, &layout), FW_GEOMETRY);
        assert_int_equal(diags.item[diags.count - 1].number, 189);
        fw_arena_free(arena);
    }
}

/* how far a place is from whatever is open beside the pieces of a body */
static double from_open_um(const fw_geometry_region *r, fw_geometry_vec2 p) {
    double least = INFINITY, t;
    fw_geometry_vec2 where;
    for (int i = 0; i < r->count; i++)
        for (int k = 0; k < r->contour[i].count; k++)
            if (!(r->contour[i].segment[k].flags & FW_SEGMENT_JOINT))
                least = fmin(least, fw_geometry_segment_nearest(&r->contour[i].segment[k], p, &t, &where));
    return least / UM;
}

/* What is told of a place without a hole is what the masks draw: so far it is from what is open there, and no place around it is
   farther, also between the points of the lattice that were tried (it said up to 2 um too little) */
static void the_farthest_place(void **state) {
    (void)state;
    int told = 0;
    drawn *d = draw(60, 27);
    for (size_t k = 0; k < d->diags.count; k++) {
        const char *near = strstr(d->diags.item[k].message, "opened near (");
        double x, y, um;
        if (d->diags.item[k].number != 189 || !near) continue;
        assert_int_equal(sscanf(near, "opened near (%lf, %lf) um, which stays %lf um", &x, &y, &um), 3);
        for (int b = 0; b < 5; b++) {
            fw_geometry_region r = pieces_of(d, b);
            const fw_geometry_vec2 p = {x * UM, y * UM};
            if (!fw_geometry_contour_contains(&r.contour[0], p)) continue;
            told++;
            const fw_geometry_region itself = {r.contour, 1}; /* heads of flexures lie in it */
            assert_near(from_open_um(&itself, p), um, 0.07);  /* the place is written with 0.1 um */
            for (int i = -20; i <= 20; i++)
                for (int j = -20; j <= 20; j++) {
                    const fw_geometry_vec2 q = {(x + 0.2 * i) * UM, (y + 0.2 * j) * UM};
                    if (!fw_geometry_contour_contains(&r.contour[0], q)) continue;
                    assert_true(from_open_um(&itself, q) < um + 0.002);
                }
        }
    }
    assert_true(told >= 3);
    fw_arena_free(d->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_farthest_place),
        cmocka_unit_test(moments_follow), cmocka_unit_test(holes_keep_away),
        cmocka_unit_test(cuts_fit),       cmocka_unit_test(narrow_bodies_have_none),
        cmocka_unit_test(wrong_sizes),    cmocka_unit_test(holes_are_off_the_cuts_of_others),
        cmocka_unit_test(cuts_lie_in_solid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
