/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "oasis_reader.h"
#include <stdlib.h>

/* a mask of polygons that are given as they are: the grid, the order and the first vertex */
typedef struct hand {
    scene *s;
    fw_mask mask;
    fw_mask_shape shape[2000];
} hand;

static hand *hand_new(int nlayer) {
    scene *s = scene_new(0, 0);
    hand *h = fw_arena_one(s->arena, hand);
    s->table.nlayer = nlayer;
    *h = (hand){.s = s};
    h->mask = (fw_mask){.table = &s->table,
                        .cell = "hand",
                        .flow = "test-flow",
                        .device = "hand",
                        .title = "title",
                        .shape = h->shape};
    return h;
}

static void hand_add(hand *h, int layer, int n, const int32_t (*v)[2], int32_t x, int32_t y) {
    fw_geometry_point *p = fw_arena_array(h->s->arena, fw_geometry_point, (size_t)n);
    for (int i = 0; i < n; i++)
        p[i] = (fw_geometry_point){v[i][0] + x, v[i][1] + y};
    h->shape[h->mask.nshape++] = (fw_mask_shape){.layer = layer, .polygon = {p, n}};
}

static fw_text written(const fw_mask *mask, fw_arena *arena) {
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_mask_write_oasis(mask, &out), FW_OK);
    return out;
}

static bool same(const oas_polygon *p, const fw_geometry_polygon *q) {
    if (p->n != q->count) return false;
    for (int i = 0; i < p->n; i++)
        if (p->x[i] != q->vertex[i].x_dbu || p->y[i] != q->vertex[i].y_dbu) return false;
    return true;
}

/* every polygon of the mask comes back, vertex by vertex, once */
static void assert_round_trip(const fw_mask *mask, fw_arena *arena, oas *r) {
    fw_text out = written(mask, arena);
    oas_read(r, arena, &out);
    assert_string_equal(r->cell, mask->cell);
    assert_int_equal(r->npolygon, mask->nshape);
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        int found = -1;
        for (int k = 0; k < r->npolygon && found < 0; k++)
            if (r->polygon[k] && r->polygon[k]->layer == mask->table->layer[s->layer].layer &&
                r->polygon[k]->datatype == mask->table->layer[s->layer].datatype &&
                same(r->polygon[k], &s->polygon))
                found = k;
        if (found < 0) fail_msg("polygon %d did not come back", i);
        r->polygon[found] = NULL;
    }
}

/* written by hand from the record table of the format */
static void bytes(void **state) {
    (void)state;
    static const unsigned char body[] = {
        '%',  'S',  'E',  'M',  'I',  '-',  'O',  'A',  'S', 'I', 'S', '\r',
        '\n',                                              /* magic */
        1,    3,    '1',  '.',  '0',  0,    0xe8, 0x07, 1, /* START 1.0, 1000 per um, offsets in END
                                                            */
        13,   0,                                           /* CELL, number 0 */
        21,   0x33, 1,    0,                               /* POLYGON P X D L: 1/0 */
        0,    2,    0xa2, 0x9c, 0x01, 0xc0, 0xb8, 0x02,    /* 1-deltas: 10001 east, 20000 north */
        0x03,                                              /* x = -1; y = 0 is known */
        3,    4,    'h',  'a',  'n',  'd',                 /* CELLNAME */
        11,   6,    'D',  'E',  'V',  'I',  'C',  'E',  3,   1,   3,   0, /* LAYERNAME = 1, = 0 */
        2,    1,    37,   1,    0,    1,    0,    1,    0,   1,   43,  1,
        0,          /* END and the tables */
        0xed, 0x01, /* padding: 256 - 13 - 2 - 5 = 236 */
    };
    hand *h = hand_new(1);
    static const int32_t box[4][2] = {{-1, 0}, {10000, 0}, {10000, 20000}, {-1, 20000}};
    hand_add(h, 0, 4, box, 0, 0);
    fw_text out = written(&h->mask, h->s->arena);
    size_t n = sizeof body;
    for (size_t i = 0; i < n - 2 && i < out.length; i++)
        if ((unsigned char)out.data[i] != body[i])
            fail_msg("byte %zu is %02x, expected %02x", i, (unsigned char)out.data[i], body[i]);
    assert_int_equal((unsigned char)out.data[n - 2], 0x80 | (236 & 127));
    assert_int_equal((unsigned char)out.data[n - 1], 236 >> 7);
    for (size_t i = n; i < n + 236; i++)
        assert_int_equal(out.data[i], 0);
    assert_int_equal(out.length, n + 236 + 5);
    assert_int_equal(out.data[n + 236], 1);
    scene_free(h->s);
}

static void kinds_of_point_lists(void **state) {
    (void)state;
    hand *h = hand_new(2);
    static const int32_t along_x[6][2] = {{0, 0}, {9, 0}, {9, 5}, {4, 5}, {4, 9}, {0, 9}};
    static const int32_t along_y[4][2] = {{0, 0}, {0, -7000}, {5000, -7000}, {5000, 0}};
    static const int32_t passed[5][2] = {{0, 0}, {50, 0}, {90, 0}, {90, 70}, {0, 70}};
    static const int32_t eight[5][2] = {{0, 0}, {50, 0}, {90, 40}, {70, 60}, {0, 60}};
    static const int32_t any[3][2] = {{0, 0}, {50, -3}, {7, 60}};
    static const int32_t large[3][2] = {
        {-(1 << 30) + 1, -(1 << 30) + 1}, {(1 << 30) - 1, -(1 << 30) + 2}, {5, (1 << 30) - 1}};
    int32_t circle[600][2];
    for (int i = 0; i < 600; i++) {
        circle[i][0] = (int32_t)lround(1e5 * cos(2 * PI * i / 600));
        circle[i][1] = (int32_t)lround(1e5 * sin(2 * PI * i / 600));
    }
    hand_add(h, 0, 6, along_x, 100, -3);
    hand_add(h, 0, 4, along_y, 0, 0);
    hand_add(h, 1, 5, passed, -8, 0);
    hand_add(h, 0, 5, eight, 0, 77);
    hand_add(h, 1, 3, any, 1, 1);
    hand_add(h, 1, 3, large, 0, 0);
    hand_add(h, 1, 600, (const int32_t(*)[2])circle, 12345, -54321);
    oas *r = fw_arena_one(h->s->arena, oas);
    assert_round_trip(&h->mask, h->s->arena, r);
    for (int k = 0; k < 6; k++)
        if (!r->kinds[k]) fail_msg("no point list of kind %d", k);
    assert_int_equal(r->kinds[5], 1); /* the circle: changes of a chord are short */
    scene_free(h->s);
}

/* 600 polygons of random kind, edges and places, many of them the same one elsewhere */
static void random_polygons(void **state) {
    (void)state;
    static const int scale[5] = {3, 60, 5000, 3000000, 300000000};
    uint64_t seed = 17;
    for (int run = 0; run < 20; run++) {
        hand *h = hand_new(2);
        int32_t v[40][2];
        int n = 0;
        for (int k = 0; k < 600; k++) {
            if (n == 0 || random01(&seed) < 0.5) {
                int size = scale[(int)(5 * random01(&seed))], kind = (int)(4 * random01(&seed));
                n = 3 + (int)(30 * random01(&seed));
                for (int i = 0; i < n; i++) {
                    int32_t a = (int32_t)(size * (2 * random01(&seed) - 1));
                    int32_t b = (int32_t)(size * (2 * random01(&seed) - 1));
                    if (kind == 1)
                        b = i % 2 ? v[i - 1][1] : b, a = i % 2 || i == 0 ? a : v[i - 1][0];
                    if (kind == 2 && i) a = v[i - 1][0] + b, b = v[i - 1][1] + (i % 3 ? b : -b);
                    v[i][0] = a % (1 << 29), v[i][1] = b % (1 << 29);
                }
            }
            int32_t x = (int32_t)(2000 * random01(&seed)) - 1000;
            int32_t y = random01(&seed) < 0.3 ? 0 : (int32_t)(2e8 * random01(&seed));
            hand_add(h, random01(&seed) < 0.7, n, (const int32_t(*)[2])v, x, y);
        }
        oas *r = fw_arena_one(h->s->arena, oas);
        assert_round_trip(&h->mask, h->s->arena, r);
        assert_true(r->records < 600 && r->repetitions[10] > 50);
        scene_free(h->s);
    }
}

static void equal_polygons_are_written_once(void **state) {
    (void)state;
    static const int32_t box[4][2] = {{0, 0}, {10, 0}, {10, 20}, {0, 20}};
    static const int32_t tri[3][2] = {{0, 0}, {10, 1}, {3, 20}};
    static const int32_t small[4][2] = {{0, 0}, {5, 0}, {5, 5}, {0, 5}};
    static const int32_t one[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    hand *h = hand_new(2);
    for (int i = 0; i < 12; i++) { /* a grid of 4 by 3, in a wild order */
        int k = 5 * i % 12;
        hand_add(h, 0, 4, box, -7 + 100 * (k % 4), 3 + 50 * (k / 4));
        hand_add(h, 0, 3, tri, 1000 - 40 * i, 9);    /* a row */
        hand_add(h, 0, 4, small, 9, -1000 + 40 * i); /* a column */
        hand_add(h, 0, 3, one, 7 * i, i * i);        /* neither */
    }
    hand_add(h, 1, 4, box, 0, 0); /* another layer: by itself, its form known by then or not */
    oas *r = fw_arena_one(h->s->arena, oas);
    assert_round_trip(&h->mask, h->s->arena, r);
    assert_int_equal(r->records, 5);
    assert_int_equal(r->repetitions[1], 1);
    assert_int_equal(r->repetitions[2], 1);
    assert_int_equal(r->repetitions[3], 1);
    assert_int_equal(r->repetitions[10], 1);
    scene_free(h->s);
}

/* a real mask: deflated, with its texts and the names of its layers */
static void whole_mask(void **state) {
    (void)state;
    for (int rejected = 0; rejected < 2; rejected++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        scene_arch(s, 50, 8, 20);
        static const double letter[4][2] = {{0, 200}, {8, 200}, {8, 208}, {0, 208}};
        scene_add(s, FW_ROLE_TEXT, "letter", polygon(s->arena, letter, 4));
        s->options.rejected = rejected;
        const fw_mask *mask = NULL;
        assert_int_equal(scene_build(s, &mask), FW_OK);
        oas *r = fw_arena_one(s->arena, oas);
        assert_round_trip(mask, s->arena, r);
        assert_int_equal(r->packed, 1);
        assert_int_equal(r->ntext, r->nstring);
        for (int i = 0; i < r->ntext; i++) {
            assert_int_equal(r->used[i], i);
            assert_int_equal(r->text_x[i], lround(mask->box.x0 * 1e9));
            assert_true(r->text_y[i] > lround(mask->box.y1 * 1e9));
            if (i) assert_int_equal(r->text_y[i - 1] - r->text_y[i], 60000);
        }
        assert_string_equal(r->text[0], rejected ? "status=REJECTED" : "device=test device");
        assert_int_equal(r->nlayer, 3);
        assert_string_equal(r->layer[0], rejected ? "REJECTED_DEVICE" : "DEVICE");
        for (int k = 0; k < 3; k++)
            assert_true(r->named_layer[k][0] == s->layer[k].layer && r->named_layer[k][1] == 0);
        scene_free(s);
    }
}

static void same_mask_same_bytes(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM), *t = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    scene_arch(t, 50, 8, 20);
    const fw_mask *one = NULL, *other = NULL;
    assert_int_equal(scene_build(s, &one), FW_OK);
    assert_int_equal(scene_build(t, &other), FW_OK);
    fw_text a = written(one, s->arena), b = written(other, t->arena);
    assert_int_equal(a.length, b.length);
    assert_memory_equal(a.data, b.data, a.length);
    scene_free(s);
    scene_free(t);
}

static void short_memory(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    const fw_mask *mask = NULL;
    assert_int_equal(scene_build(s, &mask), FW_OK);
    fw_status status = FW_NOMEM;
    for (long at = 1; status != FW_OK && at < 400; at++) {
        fw_text out = fw_text_new(s->arena);
        fw_arena_fail_at(at, 1);
        status = fw_mask_write_oasis(mask, &out);
        fw_arena_fail_at(0, 0);
        assert_true(status == FW_OK || status == FW_NOMEM);
    }
    assert_int_equal(status, FW_OK);
    scene_free(s);
}

static void lists_of_formats(void **state) {
    (void)state;
    unsigned usual, all, some;
    assert_true(fw_mask_formats(NULL, &usual) && fw_mask_formats("all", &all));
    assert_true(fw_mask_formats("oasis,svg,outlines", &some) && some != usual &&
                (some & usual) == usual);
    assert_false(fw_mask_formats("gds,", &some));
    assert_false(fw_mask_formats("", &some));
    assert_false(fw_mask_formats("oasis;svg", &some));
    size_t n = 0;
    while (fw_mask_format_at(n))
        n++;
    assert_int_equal(all, (1u << n) - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes),           cmocka_unit_test(kinds_of_point_lists),
        cmocka_unit_test(random_polygons), cmocka_unit_test(equal_polygons_are_written_once),
        cmocka_unit_test(whole_mask),      cmocka_unit_test(same_mask_same_bytes),
        cmocka_unit_test(short_memory),    cmocka_unit_test(lists_of_formats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
