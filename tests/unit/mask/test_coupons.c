/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The test dies of both flows, built from the shipped tables at several sizes and biases. Building
   checks every rule of the layers; here is what goes beyond. */
#include "base/output.h"
#include "scene.h"

static const char *const flows[] = {"al-masked-rie", "copper-on-porous-silicon"};

typedef struct die {
    fw_arena *arena;
    fw_diags diags;
    fw_mask_table table;
    const fw_mask_coupons *coupons;
} die;

static die *read_table(const char *flow) {
    fw_arena *arena = fw_arena_new(0);
    die *d = fw_arena_one(arena, die);
    d->arena = arena;
    d->diags = fw_diags_new(arena);
    char *xml;
    size_t n;
    const char *path = fw_arena_printf(arena, FW_TEST_SOURCE_DIR "/masks/%s.xml", flow);
    assert_int_equal(fw_input_read(arena, path, 1 << 20, &d->diags, &xml, &n), FW_OK);
    assert_int_equal(fw_mask_table_read(arena, path, xml, n, &d->diags, &d->table), FW_OK);
    return d;
}

static fw_status build(die *d, double width_um, double height_um, double bias_um) {
    fw_mask_coupon_options options = {
        .die = {123 * UM, -77 * UM, (123 + width_um) * UM, (-77 + height_um) * UM},
        .frame_m = (double)NAN,
        .lane_m = (double)NAN,
        .mask = {.bias_m = bias_um * UM}};
    return fw_mask_coupons_build(d->arena, &d->table, &options, &d->diags, &d->coupons);
}

static void dies_of_both_flows(void **state) {
    (void)state;
    static const double size[][2] = {{5600, 4998.5}, {3500, 3500}, {3000, 3000}, {2200, 1800}};
    static const double bias[] = {0, 1.1, 2.5};
    for (int f = 0; f < 2; f++)
        for (int s = 0; s < 4; s++) {
            die *d = read_table(flows[f]);
            fw_status status = build(d, size[s][0], size[s][1], bias[s % 3]);
            if (status != FW_OK)
                fail_msg("%s, %g um: %s", flows[f], size[s][0],
                         d->diags.count ? d->diags.item[0].message : "no message");
            const fw_mask *m = d->coupons->mask;
            const fw_layout_content *c = d->coupons->content;
            int elsewhere = 0; /* fill, and what goes on the device's own die */
            for (int i = 0; i < d->table.npattern; i++) {
                const fw_layout_pattern_kind *kind = d->table.pattern[i].kind;
                elsewhere += kind->fills || kind->on_frame || kind->in_window;
            }
            assert_int_equal(c->ncoupon, d->table.npattern - elsewhere);
            assert_int_equal(d->diags.count, c->ncoupon - c->nplaced);
            assert_true(s > 1 || c->nplaced == c->ncoupon); /* all have room from 3.5 mm on */
            assert_true(c->nplaced >= 3);
            for (int k = 0; k < m->table->nlayer;
                 k++) { /* on the grid: nothing is left to chance */
                if (m->measure[k].shapes == 0) continue;
                assert_true(m->measure[k].width_m >= 4 * UM - 1e-12);
                assert_true(m->measure[k].space_m >= 4 * UM - 1e-12);
            }
            /* placed patterns lie in the window and apart from each other */
            const fw_geometry_box w = c->layout->window;
            for (int i = 0; i < c->ncoupon; i++) {
                const fw_layout_coupon *a = &c->coupon[i];
                if (!a->placed) continue;
                assert_true(a->at.x >= w.x0 + 59.9 * UM &&
                            a->at.x + a->width_m <= w.x1 - 59.9 * UM);
                assert_true(a->at.y >= w.y0 && a->at.y + a->height_m <= w.y1 - 59.9 * UM);
                for (int j = 0; j < i; j++) {
                    const fw_layout_coupon *b = &c->coupon[j];
                    if (!b->placed) continue;
                    assert_true(a->at.x >= b->at.x + b->width_m + 59.9 * UM ||
                                b->at.x >= a->at.x + a->width_m + 59.9 * UM ||
                                a->at.y >= b->at.y + b->height_m + 59.9 * UM ||
                                b->at.y >= a->at.y + a->height_m + 59.9 * UM);
                }
            }
            fw_arena_free(d->arena);
        }
}

/* every piece of the material hangs together: walk over the joints from the frame */
static void nothing_falls_out(void **state) {
    (void)state;
    for (int f = 0; f < 2; f++) {
        die *d = read_table(flows[f]);
        assert_int_equal(build(d, 3500, 3500, 1.1), FW_OK);
        const fw_mask *m = d->coupons->mask;
        bool *reached = fw_arena_array(d->arena, bool, (size_t)m->nshape);
        int left = 0;
        for (int i = 0; i < m->nshape; i++) {
            fw_layout_role role = m->shape[i].piece->role;
            bool material = role == FW_ROLE_STRUCTURE || role == FW_ROLE_FRAME;
            reached[i] = !material || strcmp(m->shape[i].piece->label, "frame, left upright") == 0;
            left += !reached[i];
        }
        assert_true(left > 50);
        for (bool again = true; again;) {
            again = false;
            for (int i = 0; i < m->nshape; i++) {
                fw_layout_role role = m->shape[i].piece->role;
                if (!reached[i] || (role != FW_ROLE_STRUCTURE && role != FW_ROLE_FRAME)) continue;
                for (int j = 0; j < m->nshape; j++) {
                    if (reached[j]) continue;
                    const fw_geometry_contour *p = &m->shape[i].contour, *q = &m->shape[j].contour;
                    for (int a = 0; a < p->count && !reached[j]; a++)
                        for (int b = 0; b < q->count && (p->segment[a].flags & FW_SEGMENT_JOINT);
                             b++)
                            if ((q->segment[b].flags & FW_SEGMENT_JOINT) &&
                                p->segment[a].a.x == q->segment[b].b.x &&
                                p->segment[a].a.y == q->segment[b].b.y &&
                                p->segment[a].b.x == q->segment[b].a.x &&
                                p->segment[a].b.y == q->segment[b].a.y)
                                reached[j] = again = true;
                    left -= reached[j];
                }
            }
        }
        assert_int_equal(left, 0);
        fw_arena_free(d->arena);
    }
}

/* the process bias is in the patterns that ask for it, and in no other */
static void bias_where_it_is_asked_for(void **state) {
    (void)state;
    die *with = read_table(flows[1]), *without = read_table(flows[1]);
    assert_int_equal(build(with, 5600, 5000, 0.75), FW_OK);
    assert_int_equal(build(without, 5600, 5000, 0), FW_OK);
    const fw_mask *a = with->coupons->mask, *b = without->coupons->mask;
    int same = 0, grown = 0;
    for (int i = 0; i < a->nshape; i++) {
        const char *label = a->shape[i].piece->label;
        if (strncmp(label, "fill", 4) == 0 || a->shape[i].piece->role == FW_ROLE_TEXT) continue;
        int k = 0; /* the same piece: pieces of one label come in the same order */
        for (int j = 0; j < i; j++)
            k += strcmp(a->shape[j].piece->label, label) == 0;
        int j = 0;
        for (; j < b->nshape; j++)
            if (strcmp(b->shape[j].piece->label, label) == 0 && k-- == 0) break;
        assert_true(j < b->nshape);
        fw_geometry_box p = fw_geometry_contour_box(&a->shape[i].contour),
                        q = fw_geometry_contour_box(&b->shape[j].contour);
        if (strcmp(label, "cantilever") == 0 || strcmp(label, "stress pointer") == 0) {
            grown++;
            assert_near(q.x0 - p.x0, 0.75 * UM, 1e-15);
            assert_near(p.x1 - q.x1, 0.75 * UM, 1e-15);
            /* the scales of the pointer are drawn two biases farther apart, to stay as far apart */
            assert_near(p.y1 - q.y1, (label[0] == 'c' ? 1 : 3) * 0.75 * UM, 1e-15);
            assert_near(p.y0, q.y0, 0);
        } else if (strncmp(label, "frame", 5) != 0 && strncmp(label, "bar", 3) != 0) {
            same++;
            assert_true(p.x0 == q.x0 && p.x1 == q.x1); /* rows may lie higher */
            assert_near(p.y1 - p.y0, q.y1 - q.y0, 1e-15);
        }
    }
    assert_int_equal(grown, 5);
    assert_true(same > 40);
    fw_arena_free(with->arena);
    fw_arena_free(without->arena);
}

static void fill_is_as_dense_as_stated(void **state) {
    (void)state;
    die *d = read_table(flows[0]);
    assert_int_equal(build(d, 5600, 5000, 0), FW_OK);
    const fw_layout_content *c = d->coupons->content;
    assert_relative(c->fill_density, 0.5, 1e-3); /* the gap is on the grid */
    double area = 0, cells = 0;
    for (int i = 0; i < c->layout->npiece; i++) {
        const fw_layout_piece *p = &c->layout->piece[i];
        if (strcmp(p->label, "fill") != 0) continue;
        fw_geometry_box box = fw_geometry_contour_box(&p->contour);
        area += fw_geometry_contour_area(&p->contour);
        cells += (box.y1 - box.y0) * 120 * UM; /* squares of 80 um, 40 um apart */
    }
    assert_relative(area, 0.5 * cells, 1e-9);
    assert_relative(area, c->fill_area_m2, 1e-12);
    assert_true(area > 1e-6);
    fw_arena_free(d->arena);
}

/* lettering and marks lie within the material, which they are taken out of */
static void lettering_lies_in_the_material(void **state) {
    (void)state;
    die *d = read_table(flows[1]);
    assert_int_equal(build(d, 3500, 3500, 0), FW_OK);
    const fw_layout *l = d->coupons->content->layout;
    for (int i = 0; i < l->npiece; i++) {
        bool own = strcmp(l->piece[i].label, "lettering of a test pattern") == 0;
        if (!own && l->piece[i].role != FW_ROLE_MARK) continue;
        fw_geometry_vec2 at = l->piece[i].contour.segment[0].a;
        bool inside = false;
        for (int j = 0; j < l->npiece && !inside; j++)
            inside = (l->piece[j].role == FW_ROLE_FRAME || l->piece[j].role == FW_ROLE_STRUCTURE) &&
                     fw_geometry_contour_contains(&l->piece[j].contour, at) &&
                     fw_geometry_contour_distance(&l->piece[j].contour, &l->piece[i].contour, NULL,
                                                  NULL) > 4 * UM;
        if (!inside)
            fail_msg("%s at (%g, %g) um is not in the material", l->piece[i].label, at.x * 1e6,
                     at.y * 1e6);
    }
    fw_arena_free(d->arena);
}

static void list_and_certificate(void **state) {
    (void)state;
    die *d = read_table(flows[0]), *twin = read_table(flows[0]);
    assert_int_equal(build(d, 3500, 3500, 1.1), FW_OK);
    assert_int_equal(build(twin, 3500, 3500, 1.1), FW_OK);
    fw_text json = fw_text_new(d->arena), other = fw_text_new(twin->arena);
    assert_int_equal(fw_mask_write_coupons(d->coupons, "00", NULL, 0, &json), FW_OK);
    assert_int_equal(fw_mask_write_coupons(twin->coupons, "00", NULL, 0, &other), FW_OK);
    assert_string_equal(json.data, other.data);
    assert_says(json.data, "\"schema\": \"flexwright.mask/1\"");
    assert_says(json.data, "\"coupon\": \"ladder\", \"kind\": \"undercut-ladder\"");
    assert_says(json.data, "\"gives\": \"rie.R rie.S\"");
    assert_says(json.data, "\"feature\": \"line\", \"drawn_um\": 7.5,");
    assert_says(json.data, "\"bias_um_per_edge\": 0,");
    int open = 0;
    for (const char *s = json.data; *s; s++)
        open += (*s == '{') - (*s == '}');
    assert_int_equal(open, 0);
    fw_text gds = fw_text_new(d->arena), again = fw_text_new(twin->arena);
    assert_int_equal(fw_mask_write_gds(d->coupons->mask, &gds), FW_OK);
    assert_int_equal(fw_mask_write_gds(twin->coupons->mask, &again), FW_OK);
    assert_true(gds.length == again.length && memcmp(gds.data, again.data, gds.length) == 0);
    fw_arena_free(d->arena);
    fw_arena_free(twin->arena);
}

static void what_has_no_room(void **state) {
    (void)state;
    die *d = read_table(flows[0]);
    assert_int_equal(build(d, 800, 3000, 0), FW_GEOMETRY);
    assert_int_equal(d->diags.item[0].number, 188);
    fw_arena_free(d->arena);
    d = read_table(flows[0]);
    assert_int_equal(build(d, 1500, 1500, 0), FW_OK);
    const fw_layout_content *c = d->coupons->content;
    assert_true(c->nplaced < c->ncoupon);
    for (size_t i = 0; i < d->diags.count; i++)
        assert_true(d->diags.item[i].number == 186 && d->diags.item[i].severity == FW_WARNING);
    assert_says(d->diags.item[0].message, "the test pattern ladder");
    fw_text json = fw_text_new(d->arena);
    assert_int_equal(fw_mask_write_coupons(d->coupons, "00", NULL, 0, &json), FW_OK);
    assert_says(json.data, "\"placed\": false");
    fw_arena_free(d->arena);
    d = read_table(flows[0]);
    d->table.npattern = 0; /* a table without patterns: no die, no mistake */
    assert_int_equal(build(d, 3000, 3000, 0), FW_OK);
    assert_null(d->coupons);
    fw_arena_free(d->arena);
}

#define HEAD "<mask-table xmlns=\"urn:flexwright:masks:1\" flow=\"f\" reading=\"r\">\n"
#define LAYER                                                                                      \
    "<layer gds=\"1/0\" id=\"a\" name=\"A\" purpose=\"p\" tone=\"data dark\" colour=\"#000000\" "  \
    "roles=\"structure\"/>\n"

static void rows_that_are_wrong(void **state) {
    (void)state;
    static const struct {
        const char *row, *says;
    } bad[] = {
        {"<pattern kind=\"ladder\"/>", "there are: undercut-ladder"},
        {"<pattern/>", "needs a kind"},
        {"<pattern kind=\"undercut-ladder\" width=\"4 um\"/>", "has no attribute 'width'"},
        {"<pattern kind=\"undercut-ladder\" from=\"4\"/>", "from: "},
        {"<pattern kind=\"undercut-ladder\" from=\"4 mm\"/>", "at least 1 um and at most 100 um"},
        {"<pattern kind=\"undercut-ladder\" step=\"0.5004 um\"/>", "multiple of 1 nm"},
        {"<pattern kind=\"arde-slots\"/>", "needs sizes=\"...\": widths of the slots"},
        {"<pattern kind=\"arde-slots\" sizes=\"4 um, 5\"/>", "sizes: "},
        {"<pattern kind=\"arde-slots\" sizes=\"4 um, 0.1 um\"/>",
         "at least 1 um and at most 5000 um"},
        {"<pattern kind=\"contact-pad\" sizes=\"4 um\"/>", "has no attribute 'sizes'"},
        {"<pattern kind=\"contact-pad\" bias=\"maybe\"/>", "is not one of: yes, no"},
        {"<pattern kind=\"contact-pad\" title=\"\xc2\xb5m\"/>", "plain ASCII"},
        {"<pattern kind=\"contact-pad\"/><pattern kind=\"contact-pad\"/>", "two test patterns"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_mask_table table;
        char xml[1024];
        snprintf(xml, sizeof xml, HEAD LAYER "%s\n</mask-table>", bad[i].row);
        assert_int_equal(fw_mask_table_read(arena, "t.xml", xml, strlen(xml), &diags, &table),
                         FW_INPUT);
        assert_int_equal(diags.count, 1);
        assert_int_equal(diags.item[0].number, 185);
        assert_int_equal(diags.item[0].place.line, 3);
        assert_says(diags.item[0].message, bad[i].says);
        fw_arena_free(arena);
    }
}

/* sizes below the layer's own rule: the rule is what refuses, naming the pattern */
static void own_rule_holds(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    die *d = fw_arena_one(arena, die);
    d->arena = arena;
    d->diags = fw_diags_new(arena);
    static const char xml[] =
        HEAD "<layer gds=\"1/0\" id=\"a\" name=\"A\" purpose=\"p\" tone=\"data dark\" "
             "colour=\"#000000\" roles=\"structure frame\" min-width=\"4 um\" min-space=\"4 um\" "
             "source=\"s\"/>\n<pattern kind=\"arde-slots\" sizes=\"3.999 um\"/>\n</mask-table>";
    assert_int_equal(fw_mask_table_read(arena, "t.xml", xml, strlen(xml), &d->diags, &d->table),
                     FW_OK);
    assert_int_equal(build(d, 2000, 2000, 0), FW_INPUT);
    assert_int_equal(d->diags.item[0].number, 145);
    assert_says(d->diags.item[0].message, "wall of a slot");
    fw_arena_free(arena);
}

/* ---- on the frame of the device's die ---- */

typedef struct framed {
    fw_layout_piece piece[3];
    fw_layout layout;
} framed;

/* two uprights `bar_um` wide beside a window of 3 mm, lane 100 um */
static void frame_of(fw_arena *arena, double bar_um, framed *f) {
    *f = (framed){.layout = {.drawn = true, .piece = f->piece, .npiece = 2}};
    f->layout.window = (fw_geometry_box){0, 0, 3000 * UM, 3000 * UM};
    double rim = (bar_um + 100) * UM;
    f->layout.die = (fw_geometry_box){-rim, -rim, 3000 * UM + rim, 3000 * UM + rim};
    for (int k = 0; k < 2; k++) {
        double x0 = k ? 3000 : -bar_um, x1 = k ? 3000 + bar_um : 0;
        const double p[4][2] = {
            {x0, -bar_um}, {x1, -bar_um}, {x1, 3000 + bar_um}, {x0, 3000 + bar_um}};
        f->piece[k] = (fw_layout_piece){FW_ROLE_FRAME, FW_GROUND, FW_NONE, k ? "right" : "left",
                                        polygon(arena, p, 4)};
    }
}

static void marks_on_the_frame(void **state) {
    (void)state;
    die *d = read_table(flows[0]);
    framed f;
    const fw_layout *out;
    fw_layout_no_room no_room;
    frame_of(d->arena, 250, &f);
    assert_int_equal(fw_mask_frame_marks(d->arena, &d->table, &f.layout, &out, &no_room), FW_OK);
    assert_int_equal(no_room.count, 0);
    assert_int_equal(out->npiece, 2 + 2 * 2 + 4);
    fw_geometry_vec2 cross[2];
    int n = 0;
    for (int i = 2; i < out->npiece; i++) {
        fw_geometry_box b = fw_geometry_contour_box(&out->piece[i].contour);
        bool left = b.x0 >= (-250 + 12) * UM && b.x1 <= -12 * UM;
        bool right = b.x0 >= 3012 * UM && b.x1 <= 3238 * UM;
        assert_true(left || right);
        if (strcmp(out->piece[i].label, "back side cross") == 0)
            cross[n++] = (fw_geometry_vec2){0.5 * (b.x0 + b.x1), 0.5 * (b.y0 + b.y1)};
    }
    assert_int_equal(n, 2); /* level, and symmetric about the die's middle */
    assert_near(cross[0].y, cross[1].y, 1e-15);
    assert_near(0.5 * (cross[0].x + cross[1].x), 1500 * UM, 1e-15);
    double top = cross[0].y;
    /* lettering where the first mark would be: it goes below */
    const double at[4][2] = {{-150, 2950}, {-100, 2950}, {-100, 2995}, {-150, 2995}};
    f.piece[2] =
        (fw_layout_piece){FW_ROLE_TEXT, FW_NONE - 1, FW_NONE, "title", polygon(d->arena, at, 4)};
    f.layout.npiece = 3;
    assert_int_equal(fw_mask_frame_marks(d->arena, &d->table, &f.layout, &out, &no_room), FW_OK);
    for (int i = 3; i < out->npiece; i++) {
        fw_geometry_box b = fw_geometry_contour_box(&out->piece[i].contour);
        assert_true(b.x0 > 0 || b.y1 <= 2910 * UM + 1e-12);
    }
    assert_true(fw_geometry_contour_box(&out->piece[4].contour).y1 < top);
    /* a frame too narrow has none, and is handed back as it is */
    frame_of(d->arena, 100, &f);
    assert_int_equal(fw_mask_frame_marks(d->arena, &d->table, &f.layout, &out, &no_room), FW_OK);
    assert_int_equal(no_room.count, 3);
    assert_int_equal(out->npiece, 2);
    d->table.npattern = 0;
    assert_int_equal(fw_mask_frame_marks(d->arena, &d->table, &f.layout, &out, &no_room), FW_OK);
    assert_ptr_equal(out, &f.layout);
    fw_arena_free(d->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dies_of_both_flows),
        cmocka_unit_test(nothing_falls_out),
        cmocka_unit_test(bias_where_it_is_asked_for),
        cmocka_unit_test(fill_is_as_dense_as_stated),
        cmocka_unit_test(lettering_lies_in_the_material),
        cmocka_unit_test(list_and_certificate),
        cmocka_unit_test(what_has_no_room),
        cmocka_unit_test(rows_that_are_wrong),
        cmocka_unit_test(own_rule_holds),
        cmocka_unit_test(marks_on_the_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
