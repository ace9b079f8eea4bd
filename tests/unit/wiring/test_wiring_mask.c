/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nets found again on outlines that a bias has moved: the same, joined, in pieces. */
#include "test.h"
#include "wiring/wiring.h"
#include <math.h>
#include <string.h>

#define UM 1e-6
enum { LINK, BASE, STATOR, PIECES };

typedef struct bench {
    fw_arena *arena;
    fw_layout layout;
    fw_layout_piece piece[PIECES];
    fw_geometry_contour contour[PIECES];
    fw_device device;
    const fw_wiring *wiring;
} bench;

static void put(bench *b, int i, int body, const char *label, double x0, double y0, double x1,
                double y1, int joint) {
    fw_geometry_contour c;
    fw_geometry_box box = {x0 * UM, y0 * UM, x1 * UM, y1 * UM};
    assert_int_equal(fw_geometry_contour_rectangle(b->arena, box, &c), FW_OK);
    if (joint >= 0) c.segment[joint].flags |= FW_SEGMENT_JOINT;
    b->piece[i] = (fw_layout_piece){
        .role = FW_ROLE_STRUCTURE, .body = body, .joint = FW_NONE, .label = label, .contour = c};
}

/* a link on a base, and a stator `gap_um` to its right */
static bench *bench_new(double gap_um) {
    fw_arena *arena = fw_arena_new(0);
    bench *b = fw_arena_one(arena, bench);
    const fw_wiring_asked asked = {.carrier = {.insulates = true, .words = "glass"}};
    b->arena = arena;
    b->layout = (fw_layout){.drawn = true, .piece = b->piece, .npiece = PIECES};
    put(b, LINK, 0, "link A", 0, 0, 100, 200, 0);
    put(b, BASE, FW_GROUND, "base", 0, -100, 100, 0, 2);
    put(b, STATOR, FW_ISLAND, "stator", 100 + gap_um, 50, 300, 150, -1);
    assert_int_equal(fw_wiring_find(arena, &b->device, &b->layout, &asked, &b->wiring), FW_OK);
    assert_int_equal(b->wiring->nnet, 2);
    return b;
}

static fw_wiring_on_mask on_mask(bench *b, double bias_m) {
    fw_wiring_on_mask found;
    int i, j;
    for (int k = 0; k < PIECES; k++)
        assert_int_equal(fw_geometry_contour_offset(b->arena, &b->piece[k].contour, bias_m,
                                                    &b->contour[k], &i, &j),
                         FW_OK);
    assert_int_equal(fw_wiring_compare(b->arena, b->wiring, &b->layout, b->contour, &found), FW_OK);
    return found;
}

/* a bias moves both sides of a cut alike, and takes twice itself from a gap */
static void a_bias_keeps_nets(void **unused) {
    (void)unused;
    for (double bias = -1.5; bias < 1.6; bias += 0.25) {
        bench *b = bench_new(8);
        fw_wiring_on_mask m = on_mask(b, bias * UM);
        assert_true(m.same);
        assert_int_equal(m.nnet, 2);
        assert_near(m.least_m, (8 - 2 * bias) * UM, 1e-15);
        assert_string_equal(m.label[0], "link A");
        assert_string_equal(m.label[1], "stator");
        assert_null(m.differs);
        fw_arena_free(b->arena);
    }
}

static void a_bias_that_closes_a_gap_joins(void **unused) {
    (void)unused;
    bench *b = bench_new(2);
    assert_true(on_mask(b, 0.9 * UM).same);
    for (double bias = 1.0; bias < 3.0; bias += 0.5) { /* they touch, then overlap */
        fw_wiring_on_mask m = on_mask(b, bias * UM);
        assert_false(m.same);
        assert_int_equal(m.nnet, 1);
        assert_non_null(strstr(m.differs, "link A touches stator"));
    }
    fw_arena_free(b->arena);
}

static void a_part_that_is_gone_is_no_net(void **unused) {
    (void)unused;
    bench *b = bench_new(8);
    on_mask(b, 0);
    fw_wiring_on_mask m;
    put(b, LINK, 0, "link A", 0, 3, 100, 200, -1); /* comes loose from its base */
    b->contour[LINK] = b->piece[LINK].contour;
    assert_int_equal(fw_wiring_compare(b->arena, b->wiring, &b->layout, b->contour, &m), FW_OK);
    assert_false(m.same);
    assert_int_equal(m.nnet, 3);
    assert_non_null(strstr(m.differs, "is in pieces"));
    b->contour[LINK].count = 0; /* and is not on the mask at all */
    assert_int_equal(fw_wiring_compare(b->arena, b->wiring, &b->layout, b->contour, &m), FW_OK);
    assert_int_equal(m.nnet, 2);
    fw_arena_free(b->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bias_keeps_nets),
        cmocka_unit_test(a_bias_that_closes_a_gap_joins),
        cmocka_unit_test(a_part_that_is_gone_is_no_net),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
