/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outlines from points and sweeps, against closed forms; and every way in which they can be wrong. */
#include "drawing/drawing.h"
#include "test.h"
#include <math.h>

#define UM 1e-6

static fw_status trace(fw_arena *arena, const double (*p)[3], int n, fw_geometry_contour *out,
                       fw_drawing_flaw *flaw) {
    fw_drawing_piece piece[16];
    for (int i = 1; i <= n; i++)
        piece[i - 1] = (fw_drawing_piece){{p[i][0] * UM, p[i][1] * UM}, p[i][2]};
    return fw_drawing_trace(arena, (fw_geometry_vec2){p[0][0] * UM, p[0][1] * UM}, piece, n, out,
                            flaw);
}

/* a rectangle with a half disc on its right, either way round */
static void areas_follow(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_contour c;
    fw_drawing_flaw flaw;
    const double left[][3] = {{0, 0, 0}, {300, 0, 0}, {300, 100, M_PI}, {0, 100, 0}, {0, 0, 0}};
    const double right[][3] = {{0, 0, 0}, {0, 100, 0}, {300, 100, 0}, {300, 0, -M_PI}, {0, 0, 0}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(trace(arena, i ? right : left, 4, &c, &flaw), FW_OK);
        double want = (300 * 100 + 0.5 * M_PI * 50 * 50) * UM * UM;
        assert_relative(fw_geometry_contour_area(&c), want, 1e-14);
        int arcs = 0;
        for (int k = 0; k < c.count; k++)
            if (c.segment[k].kind == FW_ARC) {
                arcs++;
                assert_relative(c.segment[k].radius, 50 * UM, 1e-14);
            }
        assert_int_equal(arcs, 1);
    }
    /* a disc with a slice missing: an arc of 270 degrees and two lines */
    const double slice[][3] = {{0, 0, 0}, {80, 0, 0}, {0, -80, 1.5 * M_PI}, {0, 0, 0}};
    assert_int_equal(trace(arena, slice, 3, &c, &flaw), FW_OK);
    assert_relative(fw_geometry_contour_area(&c), 0.75 * M_PI * 80 * 80 * UM * UM, 1e-13);
    /* a lens of two arcs */
    const double lens[][3] = {{-60, 0, 0}, {60, 0, 1.0}, {-60, 0, 1.0}};
    double r = 60 / sin(0.5);
    assert_int_equal(trace(arena, lens, 2, &c, &flaw), FW_OK);
    assert_relative(fw_geometry_contour_area(&c), r * r * (1.0 - sin(1.0)) * UM * UM, 1e-12);
    fw_arena_free(arena);
}

static void what_is_wrong_is_told(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const struct {
        double p[8][3];
        int n;
        fw_drawing_fault fault;
        int piece, other;
    } wrong[] = {
        {{{0, 0, 0}, {100, 0, 0}, {100, 100, 0}}, 2, FW_DRAWING_OPEN, 1, 0},
        {{{0, 0, 0}, {100, 0, 0}, {100, 0, 0}, {0, 80, 0}, {0, 0, 0}}, 4, FW_DRAWING_POINT, 1, 0},
        {{{0, 0, 0}, {100, 100, 0}, {100, 0, 0}, {0, 90, 0}, {0, 0, 0}},
         4,
         FW_DRAWING_CROSSES,
         2,
         0},
        /* back along itself */
        {{{0, 0, 0}, {100, 0, 0}, {50, 0, 0}, {50, 50, 0}, {0, 0, 0}}, 4, FW_DRAWING_CROSSES, 1, 0},
        /* a corner that touches an edge */
        {{{0, 0, 0}, {100, 0, 0}, {100, 80, 0}, {50, 0, 0}, {0, 80, 0}, {0, 0, 0}},
         5,
         FW_DRAWING_CROSSES,
         2,
         0},
        /* an arc that bulges through the opposite edge */
        {{{0, 0, 0}, {100, 0, -M_PI}, {100, 30, 0}, {0, 30, 0}, {0, 0, 0}},
         4,
         FW_DRAWING_CROSSES,
         2,
         0},
        {{{0, 0, 0}, {100, 0, 0}, {0, 0, 0}}, 2, FW_DRAWING_FLAT, 0, 0},
        {{{0, 0, 0}, {0, 0, 0}}, 1, FW_DRAWING_POINT, 0, 0},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fw_geometry_contour c;
        fw_drawing_flaw flaw;
        assert_int_equal(trace(arena, wrong[i].p, wrong[i].n, &c, &flaw), FW_GEOMETRY);
        if (flaw.fault != wrong[i].fault || flaw.piece != wrong[i].piece ||
            flaw.other != wrong[i].other)
            fail_msg("case %zu: fault %d at %d and %d", i, (int)flaw.fault, flaw.piece, flaw.other);
        assert_non_null(fw_drawing_flaw_text(arena, &flaw));
    }
    fw_arena_free(arena);
}

/* ends within a nanometre are one point; beyond they are two */
static void a_nanometre_closes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_contour c;
    fw_drawing_flaw flaw;
    const double near[][3] = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0.0009, 0}};
    const double far[][3] = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0.0011, 0}};
    assert_int_equal(trace(arena, near, 3, &c, &flaw), FW_OK);
    assert_relative(fw_geometry_contour_area(&c), 5000 * UM * UM, 1e-14);
    assert_int_equal(trace(arena, far, 3, &c, &flaw), FW_GEOMETRY);
    assert_int_equal(flaw.fault, FW_DRAWING_OPEN);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(areas_follow),
                                       cmocka_unit_test(what_is_wrong_is_told),
                                       cmocka_unit_test(a_nanometre_closes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
