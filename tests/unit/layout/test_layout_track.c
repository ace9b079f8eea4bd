/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tracks from the pad of a stator to the edge of the chip: what they keep from everything, what they leave of the
   frame, and where none is found. */
#include "layout/draw.h"
#include "fixture.h"
#include "test.h"
#include "geometry/segment.h"
#include <string.h>

static uint64_t state = 20261123;
static double lot(double low, double high) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    const fw_layout *layout;
    fw_status status;
} drawn;

static drawn draw(const fw_device *device) {
    drawn d = {.arena = fw_arena_new(0)};
    d.diags = fw_diags_new(d.arena);
    d.status = fw_layout_build(d.arena, device, &d.diags, &d.layout);
    return d;
}

static int said(const drawn *d, int number) {
    int n = 0;
    for (size_t i = 0; i < d->diags.count; i++)
        n += d->diags.item[i].number == number;
    return n;
}

static const fw_layout_piece *stator_of(const fw_layout *l) {
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].body == FW_ISLAND && l->piece[i].role == FW_ROLE_STRUCTURE)
            return &l->piece[i];
    return NULL;
}

static fw_device_scene scene;
static fw_device_comb comb;
static void paddle(fixture *f, int fingers, double gap_m, double across_m) {
    fixture_paddle(f);
    f->body[0].x_m = 0.5e-3;
    f->body[0].y_m = 0.3e-3;
    double c = cos(M_PI / 6), s = sin(M_PI / 6), along = 0.48e-3;
    comb = (fw_device_comb){.id = "push",
                            .kind = FW_ELECTRODES_COMB,
                            .body_a = FW_GROUND,
                            .bx_m = c * along - s * across_m,
                            .by_m = s * along + c * across_m,
                            .direction_rad = M_PI / 6,
                            .fingers = fingers,
                            .gap_m = gap_m,
                            .overlap_m = 40e-6,
                            .length_m = 100e-6,
                            .width_m = 10e-6,
                            .pad_at_edge = true};
    scene = (fw_device_scene){.name = "s", .comb = &comb, .ncomb = 1};
    f->device.scene = &scene;
    f->device.nscene = 1;
}

static double outer_x(const fw_layout *l, bool right) {
    fw_geometry_box b = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].role == FW_ROLE_FRAME)
            b = fw_box_join(b, fw_geometry_contour_box(&l->piece[i].contour));
    return right ? b.x1 : b.x0;
}

/* one outline that ends at the outer edge of the frame and keeps 20 um from all that it is not to touch */
static void check_track(const fw_layout *l) {
    const fw_layout_piece *s = stator_of(l);
    const fw_layout_electrode *e = fw_layout_electrode_of(l, &comb);
    assert_non_null(s);
    assert_non_null(e);
    assert_true(e->routed);
    fw_geometry_box b = fw_geometry_contour_box(&s->contour), pad = e->edge_pad;
    bool right = pad.x1 > 0.5 * (l->window.x0 + l->window.x1);
    assert_near(right ? b.x1 : b.x0, outer_x(l, right), 1e-12);
    assert_near(pad.y1 - pad.y0, 150e-6, 2e-9);
    const double inside[4][2] = {{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.8}, {0.2, 0.8}};
    for (int i = 0; i < 4; i++)
        assert_true(fw_geometry_contour_contains(
            &s->contour, (fw_geometry_vec2){pad.x0 + inside[i][0] * (pad.x1 - pad.x0),
                                            pad.y0 + inside[i][1] * (pad.y1 - pad.y0)}));
    for (int i = 0; i < l->npiece; i++) {
        const fw_layout_piece *p = &l->piece[i];
        bool solid = p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FRAME ||
                     p->role == FW_ROLE_TETHER || p->role == FW_ROLE_FLEXURE;
        double keep = p->body == 0 && p->role == FW_ROLE_STRUCTURE ? comb.gap_m : 20e-6;
        if (!solid || p == s) continue;
        if (fw_geometry_contour_distance(&p->contour, &s->contour, NULL, NULL) < keep - 0.1e-6)
            fail_msg("%s is too near", p->label);
    }
    double width = fw_geometry_contour_clearance(&s->contour, true, NULL, NULL);
    assert_true(width > fmin(comb.width_m, 10e-6) - 1e-9);
}

static void a_track_reaches_the_edge(void **unused) {
    (void)unused;
    int routed = 0;
    for (int k = 0; k < 25; k++) {
        fixture f;
        paddle(&f, (int)lot(2, 9), lot(5e-6, 12e-6), k ? lot(-60e-6, 60e-6) : 0.0);
        drawn d = draw(&f.device);
        if (d.status == FW_OK && stator_of(d.layout)) {
            check_track(d.layout);
            routed++;
        } else if (d.status != FW_OK) {
            assert_int_equal(said(&d, 440), 1); /* refused with its place, and with nothing else */
            assert_true(d.layout && d.layout->nfault == 1);
        }
        fw_arena_free(d.arena);
    }
    assert_int_equal(routed, 25); /* each of them has a way out */
}

/* the long upright edges of an outline beside its pad: a comb that is drawn aslant has none, a track that turns has two */
static int upright_edges(const fw_layout_piece *p, fw_geometry_box pad) {
    int n = 0;
    for (int i = 0; i < p->contour.count; i++) {
        const fw_geometry_segment *s = &p->contour.segment[i];
        const bool up = fabs(s->b.x - s->a.x) < 1e-12 && fabs(s->b.y - s->a.y) > 40e-6;
        n += s->kind == FW_LINE && up && (s->a.x < pad.x0 - 1e-6 || s->a.x > pad.x1 + 1e-6);
    }
    return n;
}

/* a comb above or below the paddle has its pad there: the track turns on its way to the right or the left */
static void a_track_turns(void **unused) {
    (void)unused;
    for (int k = 0; k < 3; k++) {
        fixture f;
        paddle(&f, 4, 8e-6, 0.0);
        comb.direction_rad = M_PI / 6 + (k % 2 ? -0.5 : 0.5) * M_PI;
        const double c = cos(comb.direction_rad), s = sin(comb.direction_rad),
                     beside = k / 2 ? 100e-6 : 0.0;
        comb.bx_m = 0.33e-3 * c - beside * s, comb.by_m = 0.33e-3 * s + beside * c;
        drawn d = draw(&f.device);
        if (d.status != FW_OK)
            fail_msg("%s", d.diags.count ? d.diags.item[d.diags.count - 1].message : "");
        check_track(d.layout);
        assert_int_equal(
            upright_edges(stator_of(d.layout), fw_layout_electrode_of(d.layout, &comb)->edge_pad),
            2);
        fw_arena_free(d.arena);
    }
}

/* Where only a tether stands between a pad and the edge, the track does not cross it: refused, and without tethers there is a way. */
static void a_track_crosses_no_tether(void **unused) {
    (void)unused;
    for (int tethers = 0; tethers < 2; tethers++) {
        fixture f;
        paddle(&f, 4, 8e-6, 0.0);
        f.device.die.tethers = tethers;
        f.body[0].plate_width_m = 1.28e-3, f.body[0].plate_height_m = 0.54e-3,
        f.body[0].plate_angle_rad = 1.164;
        f.body[0].plate_x_m = f.body[0].x_m = 0.826e-3;
        f.body[0].plate_y_m = f.body[0].y_m = 0.647e-3;
        comb.direction_rad = 1.164 + 1.5 * M_PI; /* below the plate, to its right */
        comb.bx_m = 0.35e-3 * sin(1.164) + 32e-6 * cos(1.164),
        comb.by_m = -0.35e-3 * cos(1.164) + 32e-6 * sin(1.164);
        drawn d = draw(&f.device);
        assert_int_equal(d.status, tethers ? FW_GEOMETRY : FW_OK);
        assert_int_equal(said(&d, 440), tethers);
        if (!tethers) check_track(d.layout);
        fw_arena_free(d.arena);
    }
}

/* what stands on the frame is whole: it loses one gap of 190 um across one upright, and its parts keep the cuts */
static void the_frame_is_cut_once(void **unused) {
    (void)unused;
    fixture f;
    paddle(&f, 5, 9e-6, 0.0);
    drawn with = draw(&f.device);
    comb.pad_at_edge = false;
    drawn without = draw(&f.device);
    assert_int_equal(with.status, FW_OK);
    double area[2] = {0, 0}, wide = with.layout->window.x0 - outer_x(with.layout, false);
    int parts[2] = {0, 0}, cuts[2] = {0, 0};
    for (int which = 0; which < 2; which++) {
        const fw_layout *l = which ? with.layout : without.layout;
        for (int i = 0; i < l->npiece; i++) {
            if (l->piece[i].role != FW_ROLE_FRAME) continue;
            parts[which]++;
            area[which] += fw_geometry_contour_area(&l->piece[i].contour);
            for (int k = 0; k < l->piece[i].contour.count; k++)
                cuts[which] += (l->piece[i].contour.segment[k].flags & FW_SEGMENT_JOINT) != 0;
        }
    }
    assert_int_equal(parts[0], 2);
    assert_int_equal(parts[1], 3);
    assert_int_equal(cuts[0], cuts[1]);
    assert_near(area[0] - area[1], 190e-6 * wide, 1e-13);
    assert_false(fw_layout_electrode_of(without.layout, &comb)->routed);
    fw_arena_free(with.arena);
    fw_arena_free(without.arena);
}

/* within the loop of a four-bar and its base there is no way out in one layer: the stator has its pad, and no track */
static void no_way_is_refused_with_its_place(void **unused) {
    (void)unused;
    fixture f;
    fixture_four_bar(&f);
    f.body[1].x_m = 0.7e-3;
    f.body[1].y_m = 1.0e-3;
    comb = (fw_device_comb){.id = "pull",
                            .kind = FW_ELECTRODES_PLATE,
                            .body_a = FW_GROUND,
                            .body_b = 1,
                            .by_m = -90e-6,
                            .direction_rad = -0.5 * M_PI,
                            .gap_m = 10e-6,
                            .length_m = 200e-6};
    scene = (fw_device_scene){.name = "s", .comb = &comb, .ncomb = 1};
    f.device.scene = &scene;
    f.device.nscene = 1;
    drawn probed = draw(&f.device);
    assert_int_equal(probed.status, FW_OK);
    assert_non_null(stator_of(probed.layout));
    comb.pad_at_edge = true;
    drawn d = draw(&f.device);
    assert_int_equal(d.status, FW_GEOMETRY);
    assert_int_equal(said(&d, 440), 1);
    assert_int_equal(d.layout->nfault, 1);
    assert_non_null(strstr(d.layout->fault[0].message, "comb drive pull at ("));
    fw_geometry_box stator = fw_geometry_contour_box(&stator_of(probed.layout)->contour);
    assert_true(d.layout->fault[0].at.x > stator.x0 && d.layout->fault[0].at.x < stator.x1);
    assert_true(d.layout->fault[0].at.y > stator.y0 && d.layout->fault[0].at.y < stator.y1);
    fw_arena_free(probed.arena);
    fw_arena_free(d.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_track_reaches_the_edge),         cmocka_unit_test(a_track_turns),
        cmocka_unit_test(a_track_crosses_no_tether),        cmocka_unit_test(the_frame_is_cut_once),
        cmocka_unit_test(no_way_is_refused_with_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
