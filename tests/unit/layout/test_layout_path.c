/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawings of flexures that are paths or vary in width. */
#include "flexure/path.h"
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
    return d;
}

static void make_path(fw_device_flexure *f, const fw_geometry_strip_piece *piece, int n) {
    f->kind = FW_FLEXURE_PATH;
    f->piece = piece, f->npiece = n;
    f->length_m = fw_geometry_strip_length(piece, n);
    f->angle_rad = f->radius_m = 0;
    f->width_m = HUGE_VAL;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            f->width_m = fmin(f->width_m, piece[i].width_m[k]);
}

static const fw_geometry_strip_piece hook[2] = {{120e-6, 0, {9e-6, 8e-6, 7e-6}},
                                                {80e-6 * 1.6, 1 / 80e-6, {7e-6, 8.2e-6, 9e-6}}};
static const fw_geometry_strip_piece hairpin[3] = {{50e-6, 0, {7e-6, 7e-6, 7e-6}},
                                                   {70e-6 * M_PI, 1 / 70e-6, {7e-6, 9e-6, 7e-6}},
                                                   {50e-6, 0, {7e-6, 7e-6, 7e-6}}};

/* P csfh thick in the middle, Q hairpin, R hook, S leaf thin in the middle */
static void four_kinds(fixture *f) {
    fixture_four_bar(f);
    f->flexure[0].width_middle_m = 11e-6;
    make_path(&f->flexure[1], hairpin, 3);
    make_path(&f->flexure[2], hook, 2);
    fw_device_flexure *leaf = &f->flexure[3];
    leaf->kind = FW_FLEXURE_LEAF, leaf->length_m = 250e-6, leaf->gap_m = 0;
    leaf->width_m = 12e-6, leaf->width_middle_m = 7e-6;
}

static const fw_layout_piece *flexure_of(const fw_layout *l, int joint) {
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].role == FW_ROLE_FLEXURE && l->piece[i].joint == joint) return &l->piece[i];
    fail_msg("no flexure of joint %d", joint);
    return NULL;
}

/* every cut of a flexure is an edge of exactly one other piece, bit for bit, as drawn and after a
   bias either way */
static void pieces_share_their_cuts(void **state) {
    (void)state;
    static const double bias[] = {0, 1.1e-6, -0.7e-6};
    fixture f;
    four_kinds(&f);
    drawn d = draw_well(&f);
    const fw_layout *l = d.layout;
    for (int b = 0; b < 3; b++) {
        fw_geometry_contour *c = fw_arena_array(d.arena, fw_geometry_contour, (size_t)l->npiece);
        for (int i = 0; i < l->npiece; i++)
            if (l->piece[i].role == FW_ROLE_FLEXURE || l->piece[i].role == FW_ROLE_STRUCTURE)
                assert_int_equal(fw_geometry_contour_offset(d.arena, &l->piece[i].contour, bias[b],
                                                            &c[i], NULL, NULL),
                                 FW_OK);
        for (int j = 0; j < 4; j++) {
            int cuts = 0, shared = 0;
            for (int i = 0; i < l->npiece; i++) {
                if (&l->piece[i] != flexure_of(l, j)) continue;
                for (int k = 0; k < c[i].count; k++) {
                    const fw_geometry_segment *e = &c[i].segment[k];
                    if (!(e->flags & FW_SEGMENT_JOINT)) continue;
                    cuts++;
                    for (int o = 0; o < l->npiece; o++)
                        for (int m = 0; o != i && m < c[o].count; m++) {
                            const fw_geometry_segment *g = &c[o].segment[m];
                            shared += (g->flags & FW_SEGMENT_JOINT) && e->a.x == g->b.x &&
                                      e->a.y == g->b.y && e->b.x == g->a.x && e->b.y == g->a.y;
                        }
                }
            }
            assert_int_equal(cuts, 2);
            assert_int_equal(shared, 2);
        }
    }
    fw_arena_free(d.arena);
}

/* the joint is at W of the closed form, and the piece between the cuts has the area of the strip
   there: int t (1 - k m) ds, m the middle of the edges beside the centre line */
static void area_and_centre(void **state) {
    (void)state;
    fixture f;
    four_kinds(&f);
    drawn d = draw_well(&f);
    for (int j = 0; j < 4; j++) {
        const fw_layout_hinge_layout *h = &d.layout->hinge[j];
        fw_flexure_input in = fw_flexure_input_of(&f.flexure[j], h->fillet_m);
        fw_flexure_shape shape;
        fw_flexure_shape_of(&in, &shape);
        fw_geometry_vec2 w = fw_add(h->arc_centre, shape.centre_m, fw_polar(h->axis_rad));
        assert_near(w.x, f.revolute[j].x_m, 1e-15);
        assert_near(w.y, f.revolute[j].y_m, 1e-15);
        fw_layout_hinge_shape root[2];
        assert_true(fw_layout_hinge_shape_path(&f.flexure[j], h->fillet_m, root));
        fw_flexure_course c;
        fw_flexure_path_of(&in, &c);
        double whole = 0, sum = 0, before = 0;
        for (int i = 0; i < c.n; i++)
            whole += c.shape[i].piece.length_m;
        enum { N = 4000 };
        for (int i = 0; i < c.n; before += c.shape[i++].piece.length_m) {
            const fw_geometry_strip_piece *p = &c.shape[i].piece;
            double from = fmax(0, root[0].cut_m - before);
            double to = fmin(p->length_m, whole - root[1].cut_m - before);
            for (int k = 0; k < N; k++) {
                double s = from + (to - from) * (k + 0.5) / N;
                sum += (to - from) / N * fw_geometry_strip_width(&c.shape[i], s) *
                       (1 - p->curvature_per_m * fw_geometry_strip_aside(&c.shape[i], s));
            }
        }
        assert_relative(fw_geometry_contour_area(&flexure_of(d.layout, j)->contour), sum, 1e-7);
    }
    assert_true(d.layout->hinge[1].facing_rad > 0.35 && d.layout->hinge[2].facing_rad > 0.35);
    fw_arena_free(d.arena);
}

static double whole_area(const fw_layout *l) {
    double sum = 0;
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].role == FW_ROLE_FLEXURE || l->piece[i].role == FW_ROLE_STRUCTURE)
            sum += fw_geometry_contour_area(&l->piece[i].contour);
    return sum;
}

/* a path of one arc, and one of two of its parts, are drawn as that arc is; only the cut is 1 um
   beside */
static void one_arc_is_drawn_as_a_csfh(void **state) {
    (void)state;
    fixture plain, path;
    fixture_four_bar(&plain);
    fixture_four_bar(&path);
    double r = plain.flexure[0].radius_m, L = plain.flexure[0].length_m, t = 8e-6;
    const fw_geometry_strip_piece one[1] = {{L, 1 / r, {t, t, t}}};
    const fw_geometry_strip_piece two[2] = {{0.4 * L, 1 / r, {t, t, t}},
                                            {0.6 * L, 1 / r, {t, t, t}}};
    for (int j = 0; j < 4; j++)
        make_path(&path.flexure[j], j % 2 ? two : one, j % 2 ? 2 : 1);
    drawn a = draw_well(&plain), b = draw_well(&path);
    assert_relative(whole_area(b.layout), whole_area(a.layout), 1e-9);
    for (int j = 0; j < 4; j++) {
        const fw_layout_hinge_layout *p = &a.layout->hinge[j], *q = &b.layout->hinge[j];
        assert_near(q->keep_out_m, p->keep_out_m, 1e-6);
        assert_near(q->fillet_m, p->fillet_m, 1e-12);
        assert_near(fw_geometry_contour_area(&flexure_of(b.layout, j)->contour),
                    fw_geometry_contour_area(&flexure_of(a.layout, j)->contour) - 2 * 1e-6 * t,
                    1e-15);
    }
    fw_arena_free(a.arena);
    fw_arena_free(b.arena);
}

/* two half turns one after the other: the second root would lie inside the bulge */
static void what_cannot_be_drawn_is_refused(void **state) {
    (void)state;
    fixture f;
    fixture_four_bar(&f);
    const double r = 50e-6, t = 7e-6;
    const fw_geometry_strip_piece wave[2] = {{r * M_PI, 1 / r, {t, t, t}},
                                             {r * M_PI, -1 / r, {t, t, t}}};
    make_path(&f.flexure[1], wave, 2);
    drawn d = draw(&f);
    assert_int_equal(d.status, FW_GEOMETRY);
    assert_true(d.diags.errors > 0);
    int n = d.diags.item[0].number;
    assert_true(n == 264 || n == 122 || n == 121);
    fw_arena_free(d.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_share_their_cuts),
        cmocka_unit_test(area_and_centre),
        cmocka_unit_test(one_arc_is_drawn_as_a_csfh),
        cmocka_unit_test(what_cannot_be_drawn_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
