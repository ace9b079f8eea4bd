/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nets against the flood of a raster: random lattices of plates with arms between them, joined by cuts or only
   touching; and the least distance of two nets against all pairs. */
#include "test.h"
#include "wiring/wiring.h"
#include <math.h>
#include <stdlib.h>

#define UM 1e-6
enum { SIDE = 9, CELL = 20, PIXELS = SIDE * CELL };

static uint64_t seed = 20261123;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

typedef enum link { APART, CUT, TOUCHING } link;
typedef struct lattice {
    fw_arena *arena;
    bool there[SIDE][SIDE];
    link right[SIDE][SIDE], up[SIDE][SIDE];
    int piece[SIDE][SIDE];
    fw_layout layout;
    fw_geometry_contour *contour;
} lattice;

static link any_link(bool both, bool touching) {
    if (!both || uniform() < 0.45) return APART;
    return touching && uniform() < 0.3 ? TOUCHING : CUT;
}

/* a plate of 12 um with an arm 4 um wide to every neighbour that it is linked with */
static fw_geometry_contour outline(const lattice *l, int x, int y) {
    const link arm[4] = {x > 0 ? l->right[y][x - 1] : APART, y > 0 ? l->up[y - 1][x] : APART,
                         l->right[y][x], l->up[y][x]};
    static const double out[4][2] = {{-1, 0}, {0, -1}, {1, 0}, {0, 1}};
    const double cx = CELL * (x + 0.5), cy = CELL * (y + 0.5);
    fw_geometry_outline o = {0};
    bool begun = false;
    for (int k = 0; k < 4; k++) { /* left, bottom, right, top: counter-clockwise */
        const double ux = out[k][0], uy = out[k][1], vx = -uy, vy = ux;
        const double at[6][2] = {{6, -6}, {6, -2}, {10, -2}, {10, 2}, {6, 2}, {6, 6}};
        for (int i = 0; i < 6; i++) {
            if (arm[k] == APART && i > 0 && i < 5) continue;
            fw_geometry_vec2 p = {(cx + at[i][0] * ux + at[i][1] * vx) * UM,
                                  (cy + at[i][0] * uy + at[i][1] * vy) * UM};
            if (!begun) o = fw_geometry_outline_start(l->arena, p);
            if (begun)
                fw_geometry_outline_line(&o, p, i == 3 && arm[k] == CUT ? FW_SEGMENT_JOINT : 0);
            begun = true;
        }
    }
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

static lattice *lattice_new(bool touching) {
    fw_arena *arena = fw_arena_new(0);
    lattice *l = fw_arena_one(arena, lattice);
    l->arena = arena;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            l->there[y][x] = uniform() < 0.8;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            l->right[y][x] =
                any_link(x + 1 < SIDE && l->there[y][x] && l->there[y][x + 1], touching);
            l->up[y][x] = any_link(y + 1 < SIDE && l->there[y][x] && l->there[y + 1][x], touching);
        }
    l->layout.drawn = true;
    l->layout.piece = fw_arena_array(arena, fw_layout_piece, SIDE * SIDE);
    l->contour = fw_arena_array(arena, fw_geometry_contour, SIDE * SIDE);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            if (!l->there[y][x]) continue;
            int i = l->piece[y][x] = l->layout.npiece++;
            l->contour[i] = outline(l, x, y);
            l->layout.piece[i] = (fw_layout_piece){.role = FW_ROLE_STRUCTURE,
                                                   .body = FW_ISLAND,
                                                   .joint = FW_NONE,
                                                   .label = "plate",
                                                   .contour = l->contour[i]};
        }
    return l;
}

/* numbers of the flooded parts of a raster of 1 um */
static int flood(const lattice *l, int (*number)[PIXELS]) {
    static int stack[PIXELS * PIXELS];
    int n = 0;
    for (int y = 0; y < PIXELS; y++)
        for (int x = 0; x < PIXELS; x++) {
            fw_geometry_vec2 p = {(x + 0.5) * UM, (y + 0.5) * UM};
            number[y][x] = -1;
            for (int i = 0; i < l->layout.npiece && number[y][x] < 0; i++) {
                fw_geometry_vec2 a = l->contour[i].segment[0].a;
                if (fabs(a.x - p.x) > 30 * UM || fabs(a.y - p.y) > 30 * UM) continue;
                if (fw_geometry_contour_contains(&l->contour[i], p)) number[y][x] = 0;
            }
        }
    for (int from = 0; from < PIXELS * PIXELS; from++) {
        if (number[from / PIXELS][from % PIXELS] != 0) continue;
        int top = 0;
        number[from / PIXELS][from % PIXELS] = ++n;
        stack[top++] = from;
        while (top > 0) {
            int at = stack[--top], x = at % PIXELS, y = at / PIXELS;
            const int next[4][2] = {{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}};
            for (int k = 0; k < 4; k++) {
                int u = next[k][0], v = next[k][1];
                if (u < 0 || v < 0 || u >= PIXELS || v >= PIXELS || number[v][u] != 0) continue;
                number[v][u] = n;
                stack[top++] = v * PIXELS + u;
            }
        }
    }
    return n;
}

static void compare(bool touching) {
    static int number[PIXELS][PIXELS];
    int several = 0;
    for (int k = 0; k < 12; k++) {
        lattice *l = lattice_new(touching);
        int part[SIDE * SIDE], roots = 0;
        assert_int_equal(fw_wiring_parts(l->arena, &l->layout, l->contour, true, touching, part),
                         FW_OK);
        int n = flood(l, number);
        for (int i = 0; i < l->layout.npiece; i++)
            roots += part[i] == i;
        assert_int_equal(roots, n);
        several += n > 1 && n < l->layout.npiece;
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                for (int v = 0; v < SIDE; v++)
                    for (int u = 0; u < SIDE; u++) {
                        if (!l->there[y][x] || !l->there[v][u]) continue;
                        bool same = part[l->piece[y][x]] == part[l->piece[v][u]];
                        bool flooded = number[CELL * y + CELL / 2][CELL * x + CELL / 2] ==
                                       number[CELL * v + CELL / 2][CELL * u + CELL / 2];
                        assert_int_equal(same, flooded);
                    }
        fw_arena_free(l->arena);
    }
    assert_int_equal(several, 12); /* or nothing was told apart */
}

static void cuts_join_as_the_flood_does(void **unused) {
    (void)unused;
    compare(false);
}

static void outlines_that_touch_are_one(void **unused) {
    (void)unused;
    compare(true);
}

/* without a look at what touches, only cuts join */
static void touching_alone_is_no_cut(void **unused) {
    (void)unused;
    int more = 0;
    for (int k = 0; k < 6; k++) {
        lattice *l = lattice_new(true);
        int part[SIDE * SIDE], with = 0, without = 0;
        assert_int_equal(fw_wiring_parts(l->arena, &l->layout, l->contour, true, true, part),
                         FW_OK);
        for (int i = 0; i < l->layout.npiece; i++)
            with += part[i] == i;
        assert_int_equal(fw_wiring_parts(l->arena, &l->layout, l->contour, true, false, part),
                         FW_OK);
        for (int i = 0; i < l->layout.npiece; i++)
            without += part[i] == i;
        more += without > with;
        fw_arena_free(l->arena);
    }
    assert_true(more > 3);
}

/* what is an island falls out of a flow that does not insulate; lettering conducts nothing */
static void what_conducts(void **unused) {
    (void)unused;
    fw_layout_piece p = {.role = FW_ROLE_STRUCTURE, .body = FW_ISLAND};
    assert_true(fw_wiring_conducts(&p, true));
    assert_false(fw_wiring_conducts(&p, false));
    p.body = FW_GROUND;
    assert_true(fw_wiring_conducts(&p, false));
    p.role = FW_ROLE_TEXT;
    assert_false(fw_wiring_conducts(&p, true));
    p = (fw_layout_piece){.role = FW_ROLE_STRUCTURE, .body = FW_NONE - 1};
    assert_false(fw_wiring_conducts(&p, true));
}

/* against every pair of outlines, without limits */
static void least_distance_is_that_of_all_pairs(void **unused) {
    (void)unused;
    for (int k = 0; k < 6; k++) {
        lattice *l = lattice_new(false);
        int part[SIDE * SIDE], n = l->layout.npiece;
        fw_geometry_box box[SIDE * SIDE];
        assert_int_equal(fw_wiring_parts(l->arena, &l->layout, l->contour, true, false, part),
                         FW_OK);
        for (int i = 0; i < n; i++)
            box[i] = fw_geometry_contour_box(&l->contour[i]);
        for (int a = 0; a < n; a++)
            for (int b = a + 1; b < n; b += 3) {
                if (part[a] != a || part[b] != b) continue;
                double least = HUGE_VAL;
                for (int i = 0; i < n; i++)
                    for (int j = 0; part[i] == a && j < n; j++)
                        if (part[j] == b)
                            least = fmin(least, fw_geometry_contour_distance(
                                                    &l->contour[i], &l->contour[j], NULL, NULL));
                fw_wiring_near near = fw_wiring_least(&l->layout, l->contour, box, part, a, b);
                assert_near(near.m, least, 1e-15);
            }
        fw_arena_free(l->arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_join_as_the_flood_does),
        cmocka_unit_test(outlines_that_touch_are_one),
        cmocka_unit_test(touching_alone_is_no_cut),
        cmocka_unit_test(what_conducts),
        cmocka_unit_test(least_distance_is_that_of_all_pairs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
