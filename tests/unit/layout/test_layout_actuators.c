/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Electrodes and eyelets in the drawing: areas in closed form, gaps and overlaps measured between
   outlines, what they do to a body's moments, and what is refused. */
#include "layout/draw.h"
#include "fixture.h"
#include "test.h"

static uint64_t state = 20261120;
static double lot(double low, double high) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

static const double back = 40e-6, tip = 3e-6, corner = 10e-6;
static const double inset =
    (10 - 3 * M_PI) / (12 - 3 * M_PI);    /* its centroid, of r, from either edge */
static const double notch = 1 - M_PI / 4; /* of r^2: what rounding takes from a square corner */

static fw_layout_comb_plan any_comb(fw_device_comb *c) {
    *c = (fw_device_comb){.id = "c",
                          .kind = FW_ELECTRODES_COMB,
                          .body_a = FW_GROUND,
                          .fingers = 1 + (int)lot(0, 30),
                          .gap_m = lot(3e-6, 15e-6),
                          .overlap_m = lot(15e-6, 60e-6),
                          .width_m = lot(7.6e-6, 20e-6)};
    c->length_m = c->overlap_m + lot(20e-6, 80e-6);
    double turn = lot(-M_PI, M_PI);
    return (fw_layout_comb_plan){
        .comb = c,
        .width_m = c->width_m,
        .length_m = c->length_m,
        .local = {fw_v(lot(-1e-3, 1e-3), lot(-1e-3, 1e-3)), cos(turn), sin(turn), false}};
}

/* n fingers w by l, the bar behind them, less the corners of the tips */
static double area_of(const fw_layout_comb_plan *p, int n) {
    double w = p->width_m, span = 2 * (n - 1) * (w + p->comb->gap_m) + w;
    return n * w * p->length_m + back * span - 2 * n * notch * tip * tip;
}

static void electrodes_have_the_areas_of_their_fingers(void **unused) {
    (void)unused;
    for (int k = 0; k < 50; k++) {
        fw_arena *arena = fw_arena_new(0);
        fw_device_comb c;
        fw_layout_comb_plan p = any_comb(&c);
        fw_geometry_contour rotor, stator;
        assert_int_equal(fw_layout_comb_rotor(arena, &p, &rotor), FW_OK);
        assert_int_equal(fw_layout_comb_stator(arena, &p, &stator), FW_OK);
        assert_relative(fw_geometry_contour_area(&rotor), area_of(&p, c.fingers), 1e-11);
        assert_relative(fw_geometry_contour_area(&stator), area_of(&p, c.fingers + 1), 1e-11);
        fw_arena_free(arena);
    }
}

/* point of a drive's own frame */
static fw_geometry_vec2 at(const fw_layout_comb_plan *p, double x, double y) {
    return fw_layout_local_point(&p->local, fw_v(x, y));
}

/* the wall next after y0 on the line x of the drive: where an outline is entered or left */
static double next_wall(const fw_layout_comb_plan *p, const fw_geometry_contour *c, double x,
                        double y0, bool in) {
    double y = y0, step = 0.2e-6;
    while (fw_geometry_contour_contains(c, at(p, x, y + step)) != in)
        y += step;
    for (int i = 0; i < 60; i++) {
        step *= 0.5;
        if (fw_geometry_contour_contains(c, at(p, x, y + step)) != in) y += step;
    }
    return y;
}

/* what the force law integrates over: 2 N walls at the gap, everywhere along the overlap, and none
   beyond */
static void walls_face_each_other_at_the_gap(void **unused) {
    (void)unused;
    for (int k = 0; k < 20; k++) {
        fw_arena *arena = fw_arena_new(0);
        fw_device_comb c;
        fw_layout_comb_plan p = any_comb(&c);
        fw_geometry_contour rotor, stator;
        assert_int_equal(fw_layout_comb_rotor(arena, &p, &rotor), FW_OK);
        assert_int_equal(fw_layout_comb_stator(arena, &p, &stator), FW_OK);
        double x = lot(-0.5, 0.5) * (c.overlap_m - 2 * tip) * 0.99;
        double y = -(c.fingers + 1) * (p.width_m + c.gap_m);
        for (int i = 0; i < 2 * c.fingers; i++) { /* stator, rotor, stator, ... */
            const fw_geometry_contour *one = i % 2 ? &rotor : &stator,
                                      *other = i % 2 ? &stator : &rotor;
            double from = next_wall(&p, one, x, y, true),
                   out = next_wall(&p, one, x, from + 1e-7, false);
            double to = next_wall(&p, other, x, out, true);
            assert_near(out - from, p.width_m, 1e-12);
            assert_near(to - out, c.gap_m, 1e-12);
            y = to - 1e-7;
        }
        /* the tips are half an overlap to either side of the point of the drive */
        double middle = c.fingers % 2 ? 0.0 : p.width_m + c.gap_m; /* of a finger of the rotor */
        assert_true(fw_geometry_contour_contains(&rotor, at(&p, 0.5 * c.overlap_m - 1e-9, middle)));
        assert_false(
            fw_geometry_contour_contains(&rotor, at(&p, 0.5 * c.overlap_m + 1e-9, middle)));
        middle += p.width_m + c.gap_m;
        assert_true(
            fw_geometry_contour_contains(&stator, at(&p, -0.5 * c.overlap_m + 1e-9, middle)));
        assert_false(
            fw_geometry_contour_contains(&stator, at(&p, -0.5 * c.overlap_m - 1e-9, middle)));
        fw_arena_free(arena);
    }
}

/* and moved: across the gap closes by the way, along it stays */
static void gaps_follow_the_rotor(void **unused) {
    (void)unused;
    for (int k = 0; k < 50; k++) {
        fw_arena *arena = fw_arena_new(0);
        fw_device_comb c;
        fw_layout_comb_plan p = any_comb(&c), moved = p;
        fw_geometry_contour rotor, stator;
        assert_int_equal(fw_layout_comb_stator(arena, &p, &stator), FW_OK);
        double x = lot(-0.3, 0.3) * c.overlap_m, y = lot(-0.9, 0.9) * c.gap_m;
        moved.local.origin = at(&p, x, y);
        assert_int_equal(fw_layout_comb_rotor(arena, &moved, &rotor), FW_OK);
        double ends = c.length_m - c.overlap_m - x; /* tips to roots */
        assert_near(fw_geometry_contour_distance(&rotor, &stator, NULL, NULL),
                    fmin(c.gap_m - fabs(y), ends), 1e-15);
        fw_arena_free(arena);
    }
}

static void plates_face_each_other_at_the_gap(void **unused) {
    (void)unused;
    for (int k = 0; k < 20; k++) {
        fw_arena *arena = fw_arena_new(0);
        fw_device_comb c;
        fw_layout_comb_plan p = any_comb(&c);
        fw_geometry_contour rotor, stator;
        c.kind = FW_ELECTRODES_PLATE;
        assert_int_equal(fw_layout_comb_rotor(arena, &p, &rotor), FW_OK);
        assert_int_equal(fw_layout_comb_stator(arena, &p, &stator), FW_OK);
        assert_near(fw_geometry_contour_distance(&rotor, &stator, NULL, NULL), c.gap_m, 1e-15);
        assert_relative(fw_geometry_contour_area(&rotor), back * p.length_m, 1e-12);
        assert_relative(fw_geometry_contour_area(&stator),
                        back * (p.length_m + 2 * c.gap_m + 20e-6), 1e-12);
        assert_true(fw_geometry_contour_contains(&rotor, at(&p, -1e-9, 0)));
        assert_false(fw_geometry_contour_contains(&rotor, at(&p, 1e-9, 0)));
        fw_arena_free(arena);
    }
}

/* ---- in a drawing ---- */

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    const fw_layout *layout;
} drawn;

static drawn draw(const fw_device *device) {
    drawn d = {.arena = fw_arena_new(0)};
    assert_non_null(d.arena);
    d.diags = fw_diags_new(d.arena);
    fw_status status = fw_layout_build(d.arena, device, &d.diags, &d.layout);
    if (status != FW_OK)
        fail_msg("%s: %s", fw_status_text(status),
                 d.diags.count ? d.diags.item[0].message : "no diagnostic");
    return d;
}

static int said(const drawn *d, int number, const char *words) {
    int n = 0;
    for (size_t i = 0; i < d->diags.count; i++)
        n += d->diags.item[i].number == number && strstr(d->diags.item[i].message, words);
    return n;
}

static const fw_layout_piece *labelled(const fw_layout *l, const char *label) {
    for (int i = 0; i < l->npiece; i++)
        if (strcmp(l->piece[i].label, label) == 0) return &l->piece[i];
    return NULL;
}

static const fw_layout_piece *body_piece(const fw_layout *l, int body) {
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].role == FW_ROLE_STRUCTURE && l->piece[i].body == body) return &l->piece[i];
    return NULL;
}

/* the paddle, its pose stated at the middle of its plate: five fingers on the short edge away from
   the hinge */
static fw_device_scene scene;
static fw_device_comb comb;
static void paddle_with_comb(fixture *f, double along_m, double across_m) {
    fixture_paddle(f);
    f->device.die.tethers = false; /* whose stubs are no part of a body's moments */
    f->body[0].x_m = 0.5e-3;
    f->body[0].y_m = 0.3e-3;
    double c = cos(M_PI / 6), s = sin(M_PI / 6);
    comb = (fw_device_comb){.id = "push",
                            .kind = FW_ELECTRODES_COMB,
                            .body_a = FW_GROUND,
                            .bx_m = c * along_m - s * across_m,
                            .by_m = s * along_m + c * across_m,
                            .direction_rad = M_PI / 6,
                            .fingers = 5,
                            .gap_m = 9e-6,
                            .overlap_m = 40e-6,
                            .length_m = 100e-6,
                            .width_m = 10e-6};
    scene = (fw_device_scene){.name = "s", .comb = &comb, .ncomb = 1};
    f->device.scene = &scene;
    f->device.nscene = 1;
}

static void a_comb_is_on_its_body(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_comb(&f, 0.48e-3, 0);
    f.device.nscene = 0;
    drawn without = draw(&f.device);
    f.device.nscene = 1;
    drawn with = draw(&f.device);
    assert_int_equal(said(&with, 131, ""), 0);
    const fw_layout_piece *stator = labelled(with.layout, "stator of comb drive push"),
                          *rotor = body_piece(with.layout, 0);
    assert_non_null(stator);
    assert_int_equal(stator->body, FW_ISLAND);
    assert_near(fw_geometry_contour_distance(&stator->contour, &rotor->contour, NULL, NULL),
                comb.gap_m, 1e-13);

    /* area: fingers, less their tips, plus the hollow corners at their roots; the bar is inside the
       plate. Inertia: rectangles about the common centre; the corners as points. */
    const fw_layout_body_layout *a = &without.layout->body[0], *b = &with.layout->body[0];
    double w = comb.width_m, l = comb.length_m, pitch = 2 * (w + comb.gap_m);
    double more = 5 * w * l + 10 * notch * (corner * corner - tip * tip);
    assert_near(b->area_m2 - a->area_m2, more, 1e-17);
    fw_layout_local plate = {fw_v(0.5e-3, 0.3e-3), cos(M_PI / 6), sin(M_PI / 6), false};
    double area = a->area_m2, mx = area * a->centroid.x, my = area * a->centroid.y;
    double about = a->polar_m4 + area * fw_dot(a->centroid, a->centroid); /* the origin */
    for (int i = 0; i < 5; i++) {
        double y = (i - 2) * pitch;
        fw_geometry_vec2 m = fw_layout_local_point(&plate, fw_v(0.45e-3, y));
        area += w * l, mx += w * l * m.x, my += w * l * m.y;
        about += w * l * ((w * w + l * l) / 12 + fw_dot(m, m));
        for (int end = 0; end < 4; end++) { /* two tips, two roots */
            double r = end < 2 ? tip : corner, da = (end < 2 ? -notch : notch) * r * r;
            double side =
                (end % 2 ? 1 : -1) * (end < 2 ? 0.5 * w - inset * tip : 0.5 * w + inset * corner);
            fw_geometry_vec2 q = fw_layout_local_point(
                &plate, fw_v(end < 2 ? 0.5e-3 - inset * tip : 0.4e-3 + inset * corner, y + side));
            area += da, mx += da * q.x, my += da * q.y, about += da * fw_dot(q, q);
        }
    }
    assert_near(b->centroid.x, mx / area, 1e-13);
    assert_near(b->centroid.y, my / area, 1e-13);
    assert_relative(b->polar_m4, about - (mx * mx + my * my) / area, 1e-7);
    assert_true(b->polar_m4 > 1.02 * a->polar_m4);

    /* lead and pad: one outline at least 20 um from everything but its fingers' partners, a bond
       area of 150 um and the letters on it */
    int letters = 0;
    for (int i = 0; i < with.layout->npiece; i++) {
        const fw_layout_piece *p = &with.layout->piece[i];
        if (p->body == FW_ISLAND && p->role == FW_ROLE_TEXT) {
            letters++;
            assert_true(fw_geometry_contour_contains(&stator->contour, p->contour.segment[0].a));
        } else if (p->role == FW_ROLE_FRAME || p->role == FW_ROLE_TETHER ||
                   (p->role == FW_ROLE_STRUCTURE && p->body == FW_GROUND)) {
            assert_true(fw_geometry_contour_distance(&p->contour, &stator->contour, NULL, NULL) >
                        19.9e-6);
        }
    }
    assert_true(letters >= 4);
    fw_layout_comb_plan plan = {.comb = &comb, .width_m = w, .length_m = l};
    assert_true(fw_geometry_contour_area(&stator->contour) > area_of(&plan, 6) + 150e-6 * 150e-6);
    fw_arena_free(without.arena);
    fw_arena_free(with.arena);
}

/* no device changes by what is refused: the same body, and the thing in the way is named */
static void crossing_is_refused(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_comb(&f, 0.48e-3, 0);
    f.device.nscene = 0;
    drawn without = draw(&f.device);
    f.device.nscene = 1;
    static const struct {
        double along_m, across_m, length_m;
        int stator, fingers;
        const char *words;
    } wrong[] = {
        {-0.5e-3, -0.2e-3, 100e-6, FW_GROUND, 5, "hinge H at ("},
        {0.48e-3, 0, 100e-6, 0, 5, "nothing insulates"},
        {0.48e-3, 0, 45e-6, FW_GROUND, 5, "5 um before the root"},
        {0.48e-3, 0, 100e-6, FW_GROUND, 101, "more than 100 fingers"},
        {3e-3, 0, 100e-6, FW_GROUND, 5, "do not make one outline"},
        {0, 0, 100e-6, FW_GROUND, 5, "its own rotor's body platform paddle at ("},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        paddle_with_comb(&f, wrong[i].along_m, wrong[i].across_m);
        comb.length_m = wrong[i].length_m;
        comb.body_a = wrong[i].stator;
        comb.fingers = wrong[i].fingers;
        drawn with = draw(&f.device);
        if (said(&with, 131, wrong[i].words) != 1)
            fail_msg("%s: %s", wrong[i].words,
                     with.diags.count ? with.diags.item[0].message : "nothing is said");
        assert_true(with.layout->body[0].area_m2 == without.layout->body[0].area_m2);
        assert_null(labelled(with.layout, "stator of comb drive push"));
        fw_arena_free(with.arena);
    }
    fw_arena_free(without.arena);
}

/* a die that has no room for the stator: the device is drawn as before */
static void a_small_die_has_no_stator(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_comb(&f, 0.48e-3, 0);
    f.device.nscene = 0;
    drawn without = draw(&f.device);
    f.device.nscene = 1;
    f.device.die.width_m = without.layout->die.x1 - without.layout->die.x0;
    f.device.die.height_m = without.layout->die.y1 - without.layout->die.y0;
    drawn with = draw(&f.device);
    assert_int_equal(said(&with, 131, "the die is too small"), 1);
    assert_true(with.layout->body[0].area_m2 == without.layout->body[0].area_m2);
    fw_arena_free(without.arena);
    fw_arena_free(with.arena);
}

/* ---- eyelets ---- */

static fw_device_tendon tendon;
static fw_device_eyelet eyelet[4];
static void paddle_with_tendon(fixture *f) {
    fixture_paddle(f);
    f->device.die.tethers = false; /* whose stubs are no part of a body's moments */
    eyelet[0] = (fw_device_eyelet){.body = 0, .x_m = 0.36e-3, .y_m = 0.36e-3};
    eyelet[1] = (fw_device_eyelet){.body = FW_GROUND, .x_m = 0.7e-3, .y_m = 1.3e-3};
    eyelet[2] = (fw_device_eyelet){.body = FW_GROUND, .x_m = 0.7e-3, .y_m = 9e-3};
    tendon = (fw_device_tendon){
        .id = "t", .eyelet = eyelet, .neyelet = 1, .pull_N = 1e-3, .draw_m = NONE};
    scene = (fw_device_scene){.name = "s", .tendon = &tendon, .ntendon = 1};
    f->device.scene = &scene;
    f->device.nscene = 1;
}

static const fw_geometry_segment *hole_of(const fw_geometry_contour *c, double radius_m) {
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].kind == FW_ARC && c->segment[i].sweep_rad < 0 &&
            fabs(c->segment[i].radius - radius_m) < 1e-12)
            return &c->segment[i];
    return NULL;
}

/* the hole is where the force acts: at its place from the centre of mass, which the ring moves */
static void a_ring_is_where_the_cable_pulls(void **unused) {
    (void)unused;
    fixture f;
    double shift = 0;
    paddle_with_tendon(&f);
    for (int k = 0; k < 12; k++) {
        double r = lot(8.5e-6, 60e-6), ring = lot(15e-6, 60e-6), a = lot(0.55, 1.2);
        eyelet[0] = (fw_device_eyelet){.body = 0,
                                       .x_m = 0.4e-3 * cos(a),
                                       .y_m = 0.4e-3 * sin(a),
                                       .hole_m = 2 * r,
                                       .ring_m = ring};
        f.device.nscene = 0;
        drawn without = draw(&f.device);
        f.device.nscene = 1;
        drawn d = draw(&f.device);
        assert_int_equal(said(&d, 131, ""), 0);
        const fw_layout_piece *body = body_piece(d.layout, 0),
                              *cap = labelled(d.layout, "ring of tendon t");
        assert_non_null(cap);
        const fw_geometry_segment *hole = hole_of(&body->contour, r),
                                  *rest = hole_of(&cap->contour, r);
        assert_non_null(hole);
        assert_non_null(rest);
        assert_near(fabs(hole->sweep_rad) + fabs(rest->sweep_rad), 2 * M_PI, 1e-9);
        fw_geometry_vec2 c = d.layout->body[0].centroid;
        assert_near(hole->centre.x, c.x + eyelet[0].x_m, 2e-12);
        assert_near(hole->centre.y, c.y + eyelet[0].y_m, 2e-12);
        shift = fmax(shift, fw_norm(fw_sub(c, without.layout->body[0].centroid)));
        double halves = without.layout->body[0].area_m2 - /* of its flexures */
                        fw_geometry_contour_area(&body_piece(without.layout, 0)->contour);
        assert_relative(d.layout->body[0].area_m2,
                        fw_geometry_contour_area(&body->contour) +
                            fw_geometry_contour_area(&cap->contour) + halves,
                        1e-11);
        /* a circle of the ring's width about the hole is material all round */
        for (int i = 0; i < 360; i++) {
            fw_geometry_vec2 p =
                fw_add(hole->centre, r + 0.99 * ring, fw_polar(i * M_PI / 180 + 1e-4));
            assert_true(fw_geometry_contour_contains(&body->contour, p) ||
                        fw_geometry_contour_contains(&cap->contour, p));
        }
        fw_arena_free(without.arena);
        fw_arena_free(d.arena);
    }
    assert_true(shift > 1e-7); /* or nothing was tested above */
}

/* a bias moves outline and cap alike: one hole, smaller by it */
static void a_bias_keeps_the_ring_closed(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_tendon(&f);
    for (int k = 0; k < 20; k++) {
        double a = lot(0.55, 1.2), bias = lot(-1.5e-6, 1.5e-6);
        eyelet[0] = (fw_device_eyelet){.body = 0, .x_m = 0.4e-3 * cos(a), .y_m = 0.4e-3 * sin(a)};
        drawn d = draw(&f.device);
        const fw_layout_piece *body = body_piece(d.layout, 0),
                              *cap = labelled(d.layout, "ring of tendon t");
        fw_geometry_contour big, small;
        int i, j, met = 0;
        assert_int_equal(fw_geometry_contour_offset(d.arena, &body->contour, bias, &big, &i, &j),
                         FW_OK);
        assert_int_equal(fw_geometry_contour_offset(d.arena, &cap->contour, bias, &small, &i, &j),
                         FW_OK);
        assert_non_null(hole_of(&big, 40e-6 - bias));
        assert_non_null(hole_of(&small, 40e-6 - bias));
        for (i = 0; i < small.count; i++)
            for (j = 0; j < big.count && small.segment[i].flags & FW_SEGMENT_JOINT; j++)
                met += big.segment[j].flags & FW_SEGMENT_JOINT &&
                       fw_norm(fw_sub(big.segment[j].a, small.segment[i].b)) < 1e-12 &&
                       fw_norm(fw_sub(big.segment[j].b, small.segment[i].a)) < 1e-12;
        assert_int_equal(met, 2);
        fw_arena_free(d.arena);
    }
}

static void eyelets_on_the_ground_are_in_the_frame(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_tendon(&f);
    drawn one = draw(&f.device);
    double top = one.layout->window.y1,
           middle = 0.5 * (one.layout->window.x0 + one.layout->window.x1);
    assert_int_equal(said(&one, 131, ""), 0);
    fw_arena_free(one.arena);
    tendon.neyelet = 3;
    eyelet[1] = (fw_device_eyelet){.body = FW_GROUND, .x_m = middle, .y_m = top + 125e-6};
    drawn d = draw(&f.device);
    int caps = 0, holes = 0;
    for (int i = 0; i < d.layout->npiece; i++) {
        const fw_layout_piece *p = &d.layout->piece[i];
        if (p->role != FW_ROLE_FRAME) continue;
        const fw_geometry_segment *hole = hole_of(&p->contour, 40e-6);
        if (!hole) continue;
        assert_near(hole->centre.x, middle, 1e-15);
        assert_near(hole->centre.y, top + 125e-6, 1e-15);
        if (strcmp(p->label, "ring of tendon t") == 0)
            caps++;
        else
            holes++;
    }
    assert_int_equal(caps, 1);
    assert_int_equal(holes, 1);
    assert_int_equal(said(&d, 131, "outside of the frame"), 1); /* the third */
    fw_arena_free(d.arena);
    /* in the midst of the hinge */
    tendon.neyelet = 2;
    eyelet[1] = (fw_device_eyelet){.body = FW_GROUND, .x_m = 20e-6, .y_m = 20e-6};
    d = draw(&f.device);
    assert_int_equal(said(&d, 131, "ring would cross or nearly touch platform paddle at ("), 1);
    fw_arena_free(d.arena);
}

static bool is_letter(const fw_layout_piece *p) {
    return p->role == FW_ROLE_TEXT || p->role == FW_ROLE_MARK;
}

static bool has_outline(const fw_layout *l, fw_geometry_box b) {
    for (int i = 0; i < l->npiece; i++) {
        const fw_geometry_box at = fw_geometry_contour_box(&l->piece[i].contour);
        if (is_letter(&l->piece[i]) && at.x0 == b.x0 && at.y0 == b.y0 && at.x1 == b.x1 &&
            at.y1 == b.y1)
            return true;
    }
    return false;
}

/* Letters in the frame go where a ring's hole is: what comes within 10 um of the square about the hole of 80 um, on any side of its middle,
   or is where the ring is closed; all others stay, and how many went is said. */
static void letters_make_room_for_a_ring(void **unused) {
    (void)unused;
    static const double off[][2] = {{0, 0}, {0, 45e-6}, {0, -45e-6}, {45e-6, 0}, {-45e-6, 0}};
    fixture f;
    paddle_with_tendon(&f);
    f.device.die.title = "PADDLE";
    const drawn plain = draw(&f.device);
    const fw_layout_piece *letter = NULL;
    for (int i = 0; i < plain.layout->npiece && !letter; i++)
        if (plain.layout->piece[i].role == FW_ROLE_TEXT) letter = &plain.layout->piece[i];
    assert_non_null(letter);
    const fw_geometry_box b = fw_geometry_contour_box(&letter->contour);
    tendon.neyelet = 2;
    for (size_t k = 0; k < sizeof off / sizeof *off; k++) {
        const fw_geometry_vec2 at =
            fw_v(0.5 * (b.x0 + b.x1) + off[k][0], 0.5 * (b.y0 + b.y1) + off[k][1]);
        eyelet[1] = (fw_device_eyelet){.body = FW_GROUND, .x_m = at.x, .y_m = at.y};
        const drawn d = draw(&f.device);
        fw_geometry_box cap = {0, 0, 0, 0};
        for (int i = 0; i < d.layout->npiece; i++)
            if (d.layout->piece[i].role == FW_ROLE_FRAME &&
                strcmp(d.layout->piece[i].label, "ring of tendon t") == 0)
                cap = fw_geometry_contour_box(&d.layout->piece[i].contour);
        int gone = 0;
        for (int i = 0; i < plain.layout->npiece; i++) {
            if (!is_letter(&plain.layout->piece[i])) continue;
            const fw_geometry_box p = fw_geometry_contour_box(&plain.layout->piece[i].contour);
            const double away =
                fmax(fmax(p.x0 - at.x, at.x - p.x1), fmax(p.y0 - at.y, at.y - p.y1));
            const bool stays =
                away > 50e-6 && (p.x0 > cap.x1 || p.x1 < cap.x0 || p.y0 > cap.y1 || p.y1 < cap.y0);
            if (has_outline(d.layout, p) != stays)
                fail_msg("%s at (%g, %g)", plain.layout->piece[i].label, p.x0, p.y0);
            gone += !stays;
        }
        char says[40];
        snprintf(says, sizeof says, "; %d polygons of that are left out", gone);
        assert_true(gone > 0 && said(&d, 258, says) == 1);
        fw_arena_free(d.arena);
    }
    fw_arena_free(plain.arena);
}

/* two rings that would share material are refused, the first stays */
static void rings_keep_apart(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_tendon(&f);
    tendon.neyelet = 2;
    eyelet[1] = eyelet[0];
    eyelet[1].x_m += 90e-6;
    drawn d = draw(&f.device);
    assert_int_equal(said(&d, 131, "another hole"), 1);
    assert_non_null(labelled(d.layout, "ring of tendon t"));
    fw_arena_free(d.arena);
}

static void stated_masses_are_kept_and_noted(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_tendon(&f);
    drawn d = draw(&f.device);
    assert_int_equal(said(&d, 255, ""), 0);
    fw_arena_free(d.arena);
    f.body[0].mass_kg = 1e-8;
    f.body[0].inertia_kg_m2 = 1e-15;
    d = draw(&f.device);
    assert_int_equal(said(&d, 255, "paddle"), 1);
    fw_arena_free(d.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(electrodes_have_the_areas_of_their_fingers),
        cmocka_unit_test(walls_face_each_other_at_the_gap),
        cmocka_unit_test(gaps_follow_the_rotor),
        cmocka_unit_test(plates_face_each_other_at_the_gap),
        cmocka_unit_test(a_comb_is_on_its_body),
        cmocka_unit_test(crossing_is_refused),
        cmocka_unit_test(a_small_die_has_no_stator),
        cmocka_unit_test(a_ring_is_where_the_cable_pulls),
        cmocka_unit_test(a_bias_keeps_the_ring_closed),
        cmocka_unit_test(eyelets_on_the_ground_are_in_the_frame),
        cmocka_unit_test(letters_make_room_for_a_ring),
        cmocka_unit_test(rings_keep_apart),
        cmocka_unit_test(stated_masses_are_kept_and_noted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
