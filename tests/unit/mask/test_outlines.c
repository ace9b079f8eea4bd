/* SPDX-License-Identifier: GPL-3.0-or-later */
/* As drawn, on the mask, as fabricated. */
#include "mask/mask.h"
#include "xml/xml.h"
#include "scene.h"

static fw_mask_edges edges;

static const fw_mask *built(scene *s, double bias_m) {
    const fw_mask *mask = NULL;
    s->options.bias_m = bias_m;
    s->options.edges = &edges;
    assert_int_equal(
        fw_mask_build(s->arena, &s->layout, &s->table, "d", &s->options, &s->diags, &mask), FW_OK);
    return mask;
}

static scene *some_shapes(void) {
    scene *s = scene_new(0, 0);
    fw_geometry_contour c;
    assert_int_equal(
        fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){200 * UM, 0}, 40 * UM, &c), FW_OK);
    scene_add(s, FW_ROLE_STRUCTURE, "disc", c);
    assert_int_equal(
        fw_geometry_contour_rectangle(s->arena, (fw_geometry_box){0, 0, 90 * UM, 8 * UM}, &c),
        FW_OK);
    scene_add(s, FW_ROLE_FLEXURE, "bar", c);
    assert_int_equal(fw_geometry_contour_ring_sector(s->arena, (fw_geometry_vec2){0, 300 * UM},
                                                     60 * UM, 75 * UM, 0.3, 4.0, &c),
                     FW_OK);
    fw_geometry_contour round;
    fw_geometry_vec2 where;
    assert_int_equal(fw_geometry_contour_round(s->arena, &c, 4 * UM, 4 * UM, &round, &where),
                     FW_OK);
    scene_add(s, FW_ROLE_FLEXURE, "ring", round);
    const double ell[][2] = {{-300, 0}, {-200, 0}, {-200, 30}, {-260, 30}, {-260, 90}, {-300, 90}};
    scene_add(s, FW_ROLE_STRUCTURE, "ell", polygon(s->arena, ell, 6));
    return s;
}

static void same_contour(const fw_geometry_contour *p, const fw_geometry_contour *q) {
    assert_int_equal(p->count, q->count);
    for (int i = 0; i < p->count; i++) {
        const fw_geometry_segment *a = &p->segment[i], *b = &q->segment[i];
        assert_int_equal(a->kind, b->kind);
        assert_near(hypot(a->a.x - b->a.x, a->a.y - b->a.y), 0, 1e-12);
        assert_near(hypot(a->b.x - b->b.x, a->b.y - b->b.y), 0, 1e-12);
        if (a->kind == FW_ARC) assert_near(a->radius, b->radius, 1e-12);
    }
}

/* what the mask added and the flow took gives back what was drawn, for any bias */
static void identity(void **state) {
    (void)state;
    const double bias[] = {1.1 * UM, 2.6 * UM, -0.9 * UM, 0.3333 * UM, 0};
    for (size_t k = 0; k < sizeof bias / sizeof bias[0]; k++) {
        scene *s = some_shapes();
        edges = (fw_mask_edges){.least_m = (double)NAN, .most_m = (double)NAN, .range = ""};
        const fw_mask *mask = built(s, bias[k]);
        fw_mask_outlines o;
        assert_int_equal(fw_mask_outlines_of(s->arena, mask, &o), FW_OK);
        assert_int_equal(o.n, 4);
        for (int i = 0; i < o.n; i++) {
            same_contour(&o.outline[i].top, &o.outline[i].shape->piece->contour);
            same_contour(&o.outline[i].bottom, &o.outline[i].shape->piece->contour);
            assert_int_equal(o.outline[i].least.count, 0);
        }
        assert_int_equal(o.gone_top + o.gone_bottom + o.gone_least, 0);
        fw_text out = fw_text_new(s->arena); /* the legend: how far, and on which side */
        static const char *const says[] = {">mask: 1.1 um outside the drawn edge<", ">mask: 2.6 um outside the drawn edge<",
                                           ">mask: 0.9 um inside the drawn edge<"};
        assert_int_equal(fw_mask_write_outlines(mask, &out), FW_OK);
        if (k < 3 && !strstr(out.data, says[k])) fail_msg("no %s", says[k]);
        scene_free(s);
    }
}

/* faces against closed forms: the disc's radius, the bar's sides; and a range about them */
static void faces_stand_where_they_are_said_to(void **state) {
    (void)state;
    scene *s = some_shapes();
    edges = (fw_mask_edges){.top_m = -0.5 * UM,
                            .bottom_m = 0.4 * UM,
                            .least_m = -0.9 * UM,
                            .most_m = -0.1 * UM,
                            .range = "A 0.97 to 0.99"};
    fw_mask_outlines o;
    assert_int_equal(fw_mask_outlines_of(s->arena, built(s, 1.7 * UM), &o), FW_OK);
    const double edge[] = {edges.top_m, edges.bottom_m, edges.least_m, edges.most_m};
    for (int w = 0; w < 4; w++)
        for (int i = 0; i < 2; i++) {
            const fw_mask_outline *p = &o.outline[i];
            const fw_geometry_contour *c[] = {&p->top, &p->bottom, &p->least, &p->most};
            double e = edge[w], r = 40 * UM + e;
            double want = i == 0 ? PI * r * r : (90 * UM + 2 * e) * (8 * UM + 2 * e);
            assert_relative(fw_geometry_contour_area(c[w]), want, 1e-11);
        }
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_outlines(built(s, 1.7 * UM), &out), FW_OK);
    assert_non_null(strstr(out.data, "as fabricated, top face, nominal: 0.5 um inside the drawn edge"));
    assert_non_null(strstr(out.data, "0.4 um outside the drawn edge"));
    scene_free(s);
}

/* a bar of 8 um that loses 4 um at either side */
static void nothing_is_drawn_of_what_is_gone(void **state) {
    (void)state;
    scene *s = some_shapes();
    edges = (fw_mask_edges){.top_m = -4.1 * UM, .least_m = -5 * UM, .most_m = 0, .range = "A"};
    const fw_mask *mask = built(s, 1 * UM);
    fw_mask_outlines o;
    assert_int_equal(fw_mask_outlines_of(s->arena, mask, &o), FW_OK);
    assert_int_equal(o.outline[1].top.count, 0);
    assert_true(o.outline[0].top.count > 0 && o.outline[1].bottom.count > 0);
    assert_true(o.gone_top >= 1 && o.gone_least >= o.gone_top && o.gone_bottom == 0);
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_outlines(mask, &out), FW_OK);
    assert_non_null(strstr(out.data, "nothing is left of them"));
    scene_free(s);
}

static int occurrences(const char *text, const char *what) {
    int n = 0;
    for (const char *s = text; (s = strstr(s, what)); s++)
        n++;
    return n;
}

static void the_picture(void **state) {
    (void)state;
    for (int w = 0; w < 3; w++) { /* even, with a range, tapered with a range */
        scene *s = some_shapes();
        edges = (fw_mask_edges){.top_m = w == 2 ? -0.5 * UM : 0,
                                .bottom_m = w == 2 ? 0.5 * UM : 0,
                                .least_m = w ? -0.6 * UM : (double)NAN,
                                .most_m = w ? 0.1 * UM : (double)NAN,
                                .range = "printed <edge> 0 to 0.1 um; A 0.9 to 1"};
        const fw_mask *mask = built(s, 1.1 * UM);
        fw_text out = fw_text_new(s->arena), again = fw_text_new(s->arena);
        assert_int_equal(fw_mask_write_outlines(mask, &out), FW_OK);
        assert_int_equal(fw_mask_write_outlines(mask, &again), FW_OK);
        assert_string_equal(out.data, again.data);
        assert_null(strstr(out.data, "nan"));
        assert_null(strstr(out.data, "inf"));
        assert_int_equal(occurrences(out.data, "id=\"test-flow-drawn\""), 1);
        assert_int_equal(occurrences(out.data, "id=\"test-flow-band\""), w > 0);
        assert_int_equal(occurrences(out.data, "id=\"test-flow-bottom\""), w == 2);
        assert_true(occurrences(out.data, "A40 40 0 0 0") > 0); /* arcs are arcs */
        assert_non_null(strstr(out.data, "drawn 8, on the mask 10.2 um"));
        if (w == 1) assert_non_null(strstr(out.data, "made 6.8 to 8.2 um at the top"));
        if (w == 2) assert_non_null(strstr(out.data, "made 7 at the top, 9 um below"));
        if (w) assert_non_null(strstr(out.data, "printed &lt;edge&gt; 0 to 0.1 um</text>"));
        fw_xml_element *root = NULL;
        assert_int_equal(fw_xml_read(s->arena, "x.svg", out.data, out.length, &s->diags, &root),
                         FW_OK);
        scene_free(s);
    }
}

/* what a flow takes from every edge is seen, as is what it adds: what was made has an outline of its own */
static void what_an_edge_loses_is_drawn(void **state) {
    (void)state;
    const double edge[] = {0, 0.5 * UM, -0.5 * UM};
    for (int k = 0; k < 3; k++) {
        scene *s = some_shapes();
        edges = (fw_mask_edges){
            .top_m = edge[k], .bottom_m = edge[k], .least_m = (double)NAN, .most_m = (double)NAN, .range = ""};
        fw_text out = fw_text_new(s->arena);
        assert_int_equal(fw_mask_write_outlines(built(s, 1.1 * UM), &out), FW_OK);
        assert_int_equal(occurrences(out.data, "id=\"test-flow-top\""), k > 0);
        assert_int_equal(occurrences(out.data, "href=\"#test-flow-top\"") > 0, k > 0);
        scene_free(s);
    }
}

/* without edges there is nothing to take back: the drawing and the mask alone */
static void without_edges(void **state) {
    (void)state;
    scene *s = some_shapes();
    s->options.bias_m = 1 * UM;
    const fw_mask *mask = NULL;
    assert_int_equal(
        fw_mask_build(s->arena, &s->layout, &s->table, "d", &s->options, &s->diags, &mask), FW_OK);
    fw_mask_outlines o;
    assert_int_equal(fw_mask_outlines_of(s->arena, mask, &o), FW_OK);
    assert_int_equal(o.n, 0);
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_outlines(mask, &out), FW_OK);
    assert_null(strstr(out.data, "fabricated:"));
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(identity),
        cmocka_unit_test(faces_stand_where_they_are_said_to),
        cmocka_unit_test(nothing_is_drawn_of_what_is_gone),
        cmocka_unit_test(the_picture),
        cmocka_unit_test(what_an_edge_loses_is_drawn),
        cmocka_unit_test(without_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
