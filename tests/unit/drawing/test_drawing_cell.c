/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells: areas through every kind of reference against closed forms, holes and their joints, what is refused and with
   which byte, and thousands of damaged files, none of which may do more than be refused. */
#include "base/constants.h"
#include "drawing/drawing.h"
#include "test.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UM 1e-6

/* ---- a writer of records ---- */

typedef struct stream {
    char data[65536];
    size_t n;
} stream;

static void put16(stream *s, unsigned v) {
    s->data[s->n++] = (char)(v >> 8 & 0xff);
    s->data[s->n++] = (char)(v & 0xff);
}
static void put32(stream *s, long v) {
    put16(s, (unsigned)((unsigned long)v >> 16) & 0xffff);
    put16(s, (unsigned)v & 0xffff);
}
static void head(stream *s, size_t length, unsigned kind) {
    put16(s, (unsigned)length + 4);
    put16(s, kind);
}
static void word(stream *s, unsigned kind, unsigned value) {
    head(s, 2, kind);
    put16(s, value);
}
static void name(stream *s, unsigned kind, const char *text) {
    size_t n = (strlen(text) + 1) / 2 * 2;
    head(s, n, kind);
    memset(s->data + s->n, 0, n);
    memcpy(s->data + s->n, text, strlen(text));
    s->n += n;
}
static void real8(stream *s, unsigned kind, double value) {
    int exponent;
    double f = frexp(value, &exponent); /* value > 0 */
    while (exponent % 4 != 0)
        f /= 2, exponent++;
    head(s, 8, kind);
    s->data[s->n++] = (char)(64 + exponent / 4);
    for (int i = 0; i < 7; i++) {
        f *= 256;
        s->data[s->n++] = (char)(unsigned char)f;
        f -= floor(f);
    }
}
static void library(stream *s, double dbu_m) {
    s->n = 0;
    word(s, 0x0002, 600);
    head(s, 24, 0x0102);
    memset(s->data + s->n, 0, 24);
    s->n += 24;
    name(s, 0x0206, "LIB");
    real8(s, 0x0305, 1e-3);
    s->data[s->n - 12 + 1] = 20; /* two numbers in one record */
    real8(s, 0x0305, dbu_m);
    memmove(s->data + s->n - 12, s->data + s->n - 8, 8);
    s->n -= 4;
}
static void cell(stream *s, const char *text) {
    head(s, 24, 0x0502);
    memset(s->data + s->n, 0, 24);
    s->n += 24;
    name(s, 0x0606, text);
}
static void points(stream *s, const long (*p)[2], size_t n) {
    head(s, 8 * n, 0x1003);
    for (size_t i = 0; i < n; i++)
        put32(s, p[i][0]), put32(s, p[i][1]);
}
static void shape(stream *s, unsigned kind, unsigned layer, const long (*p)[2], size_t n) {
    head(s, 0, kind);
    word(s, 0x0d02, layer);
    word(s, kind == 0x2d00 ? 0x2e02 : 0x0e02, 0);
    points(s, p, n);
    head(s, 0, 0x1100);
}
static void path(stream *s, unsigned layer, unsigned ends, long width, const long (*p)[2],
                 size_t n) {
    head(s, 0, 0x0900);
    word(s, 0x0d02, layer);
    word(s, 0x0e02, 0);
    word(s, 0x2102, ends);
    head(s, 4, 0x0f03);
    put32(s, width);
    points(s, p, n);
    head(s, 0, 0x1100);
}
static void refer(stream *s, const char *to, unsigned transform, double scale, double angle, long x,
                  long y) {
    const long at[1][2] = {{x, y}};
    head(s, 0, 0x0a00);
    name(s, 0x1206, to);
    if (transform || scale != 1 || angle > 0) word(s, 0x1a01, transform);
    if (scale != 1) real8(s, 0x1b05, scale);
    if (angle > 0) real8(s, 0x1c05, angle);
    points(s, at, 1);
    head(s, 0, 0x1100);
}
static void array(stream *s, const char *to, unsigned columns, unsigned rows, const long (*p)[2]) {
    head(s, 0, 0x0b00);
    name(s, 0x1206, to);
    head(s, 4, 0x1302);
    put16(s, columns);
    put16(s, rows);
    points(s, p, 3);
    head(s, 0, 0x1100);
}
static void end(stream *s, bool whole) {
    head(s, 0, 0x0700);
    if (whole) head(s, 0, 0x0400);
}

static const long square[][2] = {{0, 0}, {10000, 0}, {10000, 10000}, {0, 10000}, {0, 0}};
static const long flag[][2] = {{0, 0}, {30000, 0}, {0, 10000}, {0, 0}};

/* ---- reading ---- */

static fw_drawing_cell_asked asked_for(const fw_drawing_map *map, int n) {
    return (fw_drawing_cell_asked){.file = "t.gds",
                                   .usual = "mask",
                                   .unit_m = (double)NAN,
                                   .map = map,
                                   .nmap = n,
                                   .place = {"t.xml", 3, 7},
                                   .cell_place = {"t.xml", 3, 20},
                                   .unit_place = {"t.xml", 3, 30},
                                   .layers_place = {"t.xml", 3, 40}};
}

static fw_drawing_cell sound(fw_arena *arena, const stream *s, const fw_drawing_cell_asked *asked,
                             size_t notes) {
    fw_diags diags = fw_diags_new(arena);
    fw_drawing_cell c;
    if (fw_drawing_cell_read(arena, s->data, s->n, asked, &diags, &c) != FW_OK)
        fail_msg("%s", diags.count ? diags.item[0].message : "no message");
    assert_int_equal(diags.count, notes);
    return c;
}

static void refused(fw_arena *arena, const stream *s, const fw_drawing_cell_asked *asked,
                    int number, const char *says) {
    fw_diags diags = fw_diags_new(arena);
    fw_drawing_cell c;
    assert_int_equal(fw_drawing_cell_read(arena, s->data, s->n, asked, &diags, &c), FW_INPUT);
    if (diags.count != 1 || diags.item[0].number != number || !strstr(diags.item[0].message, says))
        fail_msg("%zu messages, FW-D%03d %s", diags.count, diags.count ? diags.item[0].number : 0,
                 diags.count ? diags.item[0].message : "");
    assert_string_equal(diags.item[0].place.file, "t.xml");
    assert_int_equal(diags.item[0].place.line, 3);
}

static double area(const fw_drawing_cell_layer *l) {
    double sum = 0;
    for (int i = 0; i < l->n; i++)
        sum += fw_geometry_contour_area(&l->outline[i]);
    return sum;
}

static void references_are_followed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s;
    static const long step[3][2] = {{200000, 0}, {320000, 0}, {200000, 80000}};
    library(&s, 1e-9);
    cell(&s, "LEAF");
    shape(&s, 0x0800, 3, flag, 4);
    shape(&s, 0x0800, 4, square, 5);
    end(&s, false);
    cell(&s, "MIDDLE");
    refer(&s, "LEAF", 0x8000, 2, 90, 50000, 0);
    array(&s, "LEAF", 3, 2, step);
    end(&s, false);
    cell(&s, "TOP");
    refer(&s, "MIDDLE", 0, 1, 180, 0, 0);
    shape(&s, 0x2d00, 3, square, 5);
    end(&s, true);
    const fw_drawing_map map[] = {{.from = "3", .to = "mask"}, {.from = "4/0", .to = "text"}};
    fw_drawing_cell_asked asked = asked_for(map, 2);
    fw_drawing_cell c = sound(arena, &s, &asked, 0);
    assert_string_equal(c.name, "TOP");
    assert_int_equal(c.nlayer, 2);
    assert_int_equal(c.layer[0].n, 8);
    /* triangles: one twice as large, six; and the box */
    assert_relative(area(&c.layer[0]), (150 * (4 + 6) + 100) * UM * UM, 1e-12);
    assert_relative(area(&c.layer[1]), 100 * (4 + 6) * UM * UM, 1e-12);
    /* mirrored (30, -0) (0, -10), twice, a quarter turn: (0, 60) (20, 0) from (50, 0), then half a turn */
    assert_near(c.layer[0].box.y0, -60 * UM, 1e-15);
    assert_near(c.layer[0].box.x0, -(200 + 2 * 40 + 30) * UM, 1e-15);
    asked.pose = (fw_geometry_pose){1e-3, -2e-3, FW_PI / 2};
    asked.mirrored = true;
    c = sound(arena, &s, &asked, 0);
    /* y -> -y, a quarter turn: (x, y) -> (y, x), then moved */
    assert_near(c.layer[0].box.x0, 1e-3 - 60 * UM, 1e-15);
    assert_near(c.layer[0].box.y0, -2e-3 - 310 * UM, 1e-15);
    assert_relative(area(&c.layer[0]), 1600 * UM * UM, 1e-12);
    asked.cell = "LEAF";
    assert_int_equal(sound(arena, &s, &asked, 0).layer[0].n, 1);
    fw_arena_free(arena);
}

/* both layers go to one: what lies on both is there once */
static void layers_are_merged(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s;
    static const long across[][2] = {
        {5000, 2000}, {5000, 4000}, {25000, 4000}, {25000, 2000}, {5000, 2000}};
    library(&s, 1e-9);
    cell(&s, "TOP");
    shape(&s, 0x0800, 3, square, 5);
    shape(&s, 0x0800, 4, across, 5); /* clockwise */
    end(&s, true);
    const fw_drawing_map map[] = {
        {.from = "3", .to = "mask"}, {.from = "4", .to = "mask"}, {.from = "4", .to = "9/0"}};
    fw_drawing_cell_asked asked = asked_for(map, 3);
    fw_drawing_cell c = sound(arena, &s, &asked, 0);
    assert_int_equal(c.nlayer, 2);
    assert_int_equal(c.layer[0].n, 1);
    assert_relative(area(&c.layer[0]), (100 + 15 * 2) * UM * UM, 1e-12);
    assert_relative(area(&c.layer[1]), 40 * UM * UM, 1e-12);
    fw_arena_free(arena);
}

static double stroke_area(unsigned ends, long width, const long (*p)[2], size_t n, double dbu_m,
                          size_t notes) {
    fw_arena *arena = fw_arena_new(0);
    stream s;
    library(&s, dbu_m);
    cell(&s, "TOP");
    path(&s, 1, ends, width, p, n);
    end(&s, true);
    fw_drawing_cell_asked asked = asked_for(NULL, 0);
    fw_drawing_cell c = sound(arena, &s, &asked, notes);
    double a = area(&c.layer[0]) / UM / UM;
    fw_arena_free(arena);
    return a;
}

static void paths_are_strokes(void **state) {
    (void)state;
    static const long bend[][2] = {{0, 0}, {40000, 0}, {40000, 30000}, {40000, 30000}};
    static const long hook[][2] = {{0, 0}, {40000, 0}, {0, 3000}}; /* sharper than a right angle */
    static const long tight[][2] = {{0, 0}, {40000, 0}, {40000, 1000}, {80000, 1000}};
    assert_relative(stroke_area(0, 4000, bend, 4, 1e-9, 0), 70 * 4, 1e-12);
    assert_relative(stroke_area(2, 4000, bend, 4, 1e-9, 0), 74 * 4, 1e-12);
    assert_relative(stroke_area(1, 4000, bend, 4, 1e-9, 1), 70 * 4 + FW_PI * 4, 2e-4);
    assert_relative(stroke_area(0, -4000, bend, 4, 1e-9, 0), 70 * 4, 1e-12);
    /* two units of 0.5 nm: half as long, half as wide */
    assert_relative(stroke_area(0, 4000, bend, 4, 0.5e-9, 0), 70, 1e-12);
    /* turned by 135 degrees, it is cut off half a width behind its point, as KLayout has it: 4 (40 + 30 sqrt 2) um2
       less 4 tan 67.5 deg inside, and 4 + 2 sqrt 2 um2 outside */
    static const long sharp[][2] = {{0, 0}, {40000, 0}, {10000, 30000}};
    assert_relative(stroke_area(0, 4000, sharp, 3, 1e-9, 1),
                    4 * (40 + 30 * sqrt(2.0)) - 4 * tan(67.5 * FW_PI / 180) + 4 + 2 * sqrt(2.0),
                    1e-4);
    double a = stroke_area(0, 4000, hook, 3, 1e-9, 1), b = stroke_area(0, 4000, tight, 4, 1e-9, 0);
    /* at least one of its two arms and less than both; no mitre runs away */
    assert_true(a > 40 * 4 && a < 2 * 41 * 4);
    assert_true(b > 80 * 4 && b < 84 * 5);
}

/* whether another outline has this segment the other way round */
static bool shared(const fw_drawing_cell_layer *layer, int of, const fw_geometry_segment *s) {
    for (int i = 0; i < layer->n; i++)
        for (int k = 0; i != of && k < layer->outline[i].count; k++) {
            const fw_geometry_segment *t = &layer->outline[i].segment[k];
            if (hypot(s->a.x - t->b.x, s->a.y - t->b.y) + hypot(s->b.x - t->a.x, s->b.y - t->a.y) <
                1e-12)
                return true;
        }
    return false;
}

/* a ring is drawn as two polygons that share two cuts, each a JOINT of both; nothing else is one, since joints are not moved by a bias */
static void rings_are_cut(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s;
    static const long ring[][2] = {{0, 0},         {30000, 0},     {30000, 30000}, {0, 30000},
                                   {0, 0},         {10000, 10000}, {10000, 20000}, {20000, 20000},
                                   {20000, 10000}, {10000, 10000}, {0, 0}};
    library(&s, 1e-9);
    cell(&s, "TOP");
    shape(&s, 0x0800, 1, ring, 11);
    end(&s, true);
    fw_drawing_cell_asked asked = asked_for(NULL, 0);
    fw_drawing_cell c = sound(arena, &s, &asked, 0);
    int joints = 0;
    assert_relative(area(&c.layer[0]), 800 * UM * UM, 1e-12);
    assert_true(c.layer[0].n >= 2);
    for (int i = 0; i < c.layer[0].n; i++)
        for (int k = 0; k < c.layer[0].outline[i].count; k++) {
            const fw_geometry_segment *one = &c.layer[0].outline[i].segment[k];
            assert_int_equal((one->flags & FW_SEGMENT_JOINT) != 0, shared(&c.layer[0], i, one));
            joints += (one->flags & FW_SEGMENT_JOINT) != 0;
        }
    assert_true(joints >= 4 && joints % 2 == 0);
    fw_arena_free(arena);
}

static void off_grid_is_noted(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s;
    library(&s, 1e-9);
    cell(&s, "TOP");
    shape(&s, 0x0800, 1, square, 5);
    end(&s, true);
    fw_drawing_cell_asked asked = asked_for(NULL, 0);
    asked.pose.angle_rad = FW_PI / 6;
    fw_drawing_cell c = sound(arena, &s, &asked, 1);
    assert_relative(area(&c.layer[0]), 100 * UM * UM, 4e-4);
    fw_arena_free(arena);
}

/* ---- what is refused ---- */

static stream broken(int which) {
    stream s;
    static const long far[3][2] = {{0, 0}, {32000000, 0}, {0, 32000000}};
    static const long away[][2] = {{0, 0}, {2000000000, 0}, {0, 2000000000}, {0, 0}};
    static const long line[][2] = {{0, 0}, {100, 0}};
    library(&s, which == 7 ? 2 : 1e-9);
    cell(&s, "A");
    switch (which) {
    case 0:
        refer(&s, "B", 0, 1, 0, 0, 0);
        break;
    case 1:
        refer(&s, "NOWHERE", 0, 1, 0, 0, 0);
        break;
    case 2:
        array(&s, "B", 32000, 32000, far);
        break;
    case 3:
        shape(&s, 0x0800, 1, away, 4);
        break;
    case 4:
        shape(&s, 0x0800, 1, line, 2);
        break;
    case 5:
        refer(&s, "B", 0x0004, 1, 0, 0, 0);
        break;
    case 6:
        shape(&s, 0x0800, 1, square, 5);
        shape(&s, 0x0800, 2, square, 5);
        break;
    }
    end(&s, false);
    cell(&s, "B");
    if (which == 0) refer(&s, "A", 0, 1, 0, 0, 0);
    shape(&s, 0x0800, 1, square, 5);
    end(&s, true);
    return s;
}

static void bad_files_are_refused(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const struct {
        const char *cell, *from;
        int number;
        const char *says;
    } bad[] = {
        {"A", NULL, 566, "byte 160: cell 'A' holds itself"},
        {"A", NULL, 568, "byte 96: it refers to a cell 'NOWHERE'"},
        {"A", NULL, 567, "byte 96: with what its references"},
        {"A", NULL, 567, "farther than 268 mm"},
        {"A", NULL, 565, "byte 96: this is no GDSII file as it should be: a polygon has fewer"},
        {"A", NULL, 565, "absolute angle"},
        {"A", NULL, 568, "1/0 and 2/0"},
        {"A", NULL, 565, "between 1e-15 m and 1 m"},
        {"C", NULL, 568, "has no cell 'C'; it has A, B"},
        {NULL, NULL, 568, "2 top cells (A, B)"},
        {"B", "5/0", 568, "no polygon in cell B on layer 5/0"},
        {"B", "metal", 568, "is a number"},
    };
    for (int i = 0; i < (int)(sizeof bad / sizeof bad[0]); i++) {
        stream s = broken(i);
        fw_drawing_map map = {.from = bad[i].from, .to = "mask"};
        fw_drawing_cell_asked asked = asked_for(&map, bad[i].from ? 1 : 0);
        asked.cell = bad[i].cell;
        refused(arena, &s, &asked, bad[i].number, bad[i].says);
    }
    stream oasis = {.data = "%SEMI-OASIS\r\n.", .n = 14};
    fw_drawing_cell_asked asked = asked_for(NULL, 0);
    refused(arena, &oasis, &asked, 569, "KLayout");
    fw_arena_free(arena);
}

/* cells that hold ten of the next one, with nothing in the last: work is bounded, not only polygons */
static void empty_arrays_end(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s;
    static const long step[3][2] = {{0, 0}, {10, 0}, {0, 10}};
    char own[16], next[16];
    library(&s, 1e-9);
    for (int i = 0; i < 12; i++) {
        snprintf(own, sizeof own, "C%d", i);
        snprintf(next, sizeof next, "C%d", i + 1);
        cell(&s, own);
        if (i < 11) array(&s, next, 10, 1, step);
        end(&s, i == 11);
    }
    fw_drawing_cell_asked asked = asked_for(NULL, 0);
    refused(arena, &s, &asked, 567, "byte");
    library(&s, 1e-9);
    for (int i = 0; i < 40; i++) {
        snprintf(own, sizeof own, "C%d", i);
        snprintf(next, sizeof next, "C%d", i + 1);
        cell(&s, own);
        if (i < 39) refer(&s, next, 0, 1, 0, 0, 0);
        end(&s, i == 39);
    }
    refused(arena, &s, &asked, 566, "more than 32 deep");
    fw_arena_free(arena);
}

/* 33 thousand squares, each 18 nm beside the one before, are 300 bytes and a square of them to compare: refused within seconds,
   where a user's time limit ends it at once */
static void what_lies_upon_itself_is_refused(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s;
    static const long step[3][2] = {{0, 0}, {300000, 0}, {0, 200000}};
    static const long wide[][2] = {{0, 0}, {30000, 0}, {30000, 30000}, {0, 30000}, {0, 0}};
    library(&s, 1e-9);
    cell(&s, "A");
    shape(&s, 0x0800, 2, wide, 5);
    end(&s, false);
    cell(&s, "B");
    array(&s, "A", 16511, 2, step);
    end(&s, true);
    fw_drawing_cell_asked asked = asked_for(NULL, 0);
    refused(arena, &s, &asked, 567, "upon each other");
    fw_cancel stop = {0};
    fw_cancel_request(&stop, 2);
    fw_arena_stop_with(arena, &stop);
    fw_diags diags = fw_diags_new(arena);
    fw_drawing_cell c;
    assert_int_equal(fw_drawing_cell_read(arena, s.data, s.n, &asked, &diags, &c), FW_CANCELLED);
    assert_int_equal(diags.count, 0);
    fw_arena_free(arena);
}

static void damage_is_survived(void **state) {
    (void)state;
    static stream s, t;
    static const long step[3][2] = {{0, 0}, {40000, 0}, {0, 40000}};
    library(&s, 1e-9);
    cell(&s, "LEAF");
    shape(&s, 0x0800, 1, flag, 4);
    path(&s, 1, 1, 3000, square, 4);
    end(&s, false);
    cell(&s, "TOP");
    array(&s, "LEAF", 2, 2, step);
    refer(&s, "LEAF", 0x8000, 2, 45, 0, 0);
    end(&s, true);
    unsigned seed = 12345;
    const int whole = test_fewest(test_cases(3000, 300), 60);
    for (int i = 0; i < whole; i++) {
        fw_arena *arena = fw_arena_new(64 << 20);
        fw_diags diags = fw_diags_new(arena);
        fw_drawing_cell_asked asked = asked_for(NULL, 0);
        fw_drawing_cell c;
        t = s;
        if (i % 3 == 0) t.n = (size_t)(i / 3) % s.n;
        for (int k = 0; k < 1 + i % 4 && i % 3; k++) {
            seed = seed * 1103515245u + 12345u;
            t.data[(seed >> 8) % s.n] = (char)(seed >> 20);
        }
        fw_status status = fw_drawing_cell_read(arena, t.data, t.n, &asked, &diags, &c);
        assert_true(status == FW_OK || status == FW_INPUT || status == FW_NOMEM);
        assert_true(status != FW_INPUT || diags.errors > 0);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(references_are_followed),
        cmocka_unit_test(layers_are_merged),
        cmocka_unit_test(paths_are_strokes),
        cmocka_unit_test(rings_are_cut),
        cmocka_unit_test(off_grid_is_noted),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(empty_arrays_end),
        cmocka_unit_test(what_lies_upon_itself_is_refused),
        cmocka_unit_test(damage_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
