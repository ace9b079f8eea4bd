/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/layout.h"
#include "base/text.h"
#include "test.h"

/* every letter of the font once, apart by their first bytes; the blank has nothing to look at */
static const char all[] = "!\"#$%&'()*+,-./0123456789:;<=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_`"
                          "abcdefghijklmnopqrstuvwxyz{|}~°±²³µ·¹×÷ΩŸ"
                          "ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÐÑÒÓÔÕÖØÙÚÛÜÝÞßàáâãäåæçèéêëìíîïðñòóôõöøùúûüýþÿ";

/* the character at *at as a string of its own, *at behind it */
static const char *next_letter(const char **at, char letter[5]) {
    const char *from = *at;
    fw_text_character(at);
    memcpy(letter, from, (size_t)(*at - from));
    letter[*at - from] = '\0';
    return letter;
}

typedef struct lettering {
    fw_arena *arena;
    fw_layout_piece *piece;
    int n, capacity;
} lettering;

static lettering write_text(const char *string, fw_geometry_vec2 at, double height, double stroke) {
    lettering t = {.arena = fw_arena_new(0)};
    assert_int_equal(fw_layout_text(t.arena, string, at, height, stroke, FW_ROLE_TEXT, "text",
                                    &t.piece, &t.n, &t.capacity),
                     FW_OK);
    return t;
}

static bool drawn(const lettering *t, double x, double y) {
    for (int i = 0; i < t->n; i++)
        if (fw_geometry_contour_contains(&t->piece[i].contour, (fw_geometry_vec2){x, y}))
            return true;
    return false;
}

enum { W = 11, H = 11 }; /* 9 x 9 cells with an empty rim */

static void spread(int cell[H][W], int y, int x) {
    if (y < 0 || y >= H || x < 0 || x >= W || cell[y][x] != 0) return;
    cell[y][x] = 2;
    spread(cell, y - 1, x);
    spread(cell, y + 1, x);
    spread(cell, y, x - 1);
    spread(cell, y, x + 1);
}

static void no_hole_and_no_corner_contact(void **state) {
    (void)state;
    for (const char *at = all; *at;) {
        char letter[5];
        next_letter(&at, letter);
        const double s = 8e-6;
        lettering t = write_text(letter, (fw_geometry_vec2){0, 0}, 9 * s, s);
        int cell[H][W] = {{0}}, count = 0;
        for (int y = 0; y < 9; y++)
            for (int x = 0; x < 9; x++) {
                cell[y + 1][x + 1] = drawn(&t, (x + 0.5) * s, (y + 0.5) * s);
                count += cell[y + 1][x + 1];
            }
        for (int y = 0; y + 1 < H; y++)
            for (int x = 0; x + 1 < W; x++) {
                int a = cell[y][x], b = cell[y][x + 1], c = cell[y + 1][x], d = cell[y + 1][x + 1];
                if ((a && d && !b && !c) || (b && c && !a && !d))
                    fail_msg("letter %s touches itself at a corner", letter);
            }
        spread(cell, 0, 0);
        for (int y = 0; y < H; y++)
            for (int x = 0; x < W; x++)
                if (cell[y][x] == 0) fail_msg("letter %s has a hole", letter);
        double area = 0;
        for (int i = 0; i < t.n; i++)
            area += fw_geometry_contour_area(&t.piece[i].contour);
        assert_relative(area, count * s * s, 1e-12);
        fw_arena_free(t.arena);
    }
}

/* the edges at `place` along one axis: width and space of a row of letters are never below the
   stroke, for heights above nine strokes, too */
static void widths_and_spaces(void **state) {
    (void)state;
    static const double height[] = {72e-6, 90e-6, 120.5e-6};
    const double s = 8e-6, slack = 1e-15;
    for (int h = 0; h < 3; h++) {
        lettering t = write_text("R=1.5 \xc2\xb5m/%#*;QW(8)N\xc3\xa4\xc3\x86",
                                 (fw_geometry_vec2){1.2345e-3, -2e-3}, height[h], s);
        for (int i = 0; i < t.n; i++) {
            const fw_geometry_contour *c = &t.piece[i].contour;
            double inside = fw_geometry_contour_clearance(c, true, NULL, NULL);
            double outside = fw_geometry_contour_clearance(c, false, NULL, NULL);
            if (inside < s - slack || outside < s - slack)
                fail_msg("piece %d: width %g, space %g", i, inside, outside);
            for (int j = 0; j < i; j++) {
                fw_geometry_vec2 p, q;
                double d = fw_geometry_contour_distance(c, &t.piece[j].contour, &p, &q);
                if (d < s - slack) fail_msg("pieces %d and %d: %g apart", i, j, d);
            }
            for (int k = 0; k < c->count; k++) { /* on the grid, along the axes */
                const fw_geometry_segment *e = &c->segment[k];
                assert_true(e->kind == FW_LINE && ((e->a.x == e->b.x) != (e->a.y == e->b.y)));
                assert_near(e->a.x * 1e9, nearbyint(e->a.x * 1e9), 1e-6);
                assert_near(e->a.y * 1e9, nearbyint(e->a.y * 1e9), 1e-6);
            }
        }
        fw_arena_free(t.arena);
    }
}

static void every_letter_differs(void **state) {
    (void)state;
    static bool seen[200][9][9];
    char letter[200][5];
    int n = 0;
    for (const char *at = all; *at; n++) {
        const double s = 1e-6;
        assert_true(n < 200);
        lettering t = write_text(next_letter(&at, letter[n]), (fw_geometry_vec2){0, 0}, 9 * s, s);
        for (int y = 0; y < 9; y++)
            for (int x = 0; x < 9; x++)
                seen[n][y][x] = drawn(&t, (x + 0.5) * s, (y + 0.5) * s);
        fw_arena_free(t.arena);
    }
    assert_int_equal(n, 167);
    for (int k = 1; k < n; k++)
        for (int m = 0; m < k; m++) {
            int differ = 0;
            for (int i = 0; i < 81; i++)
                differ += seen[k][i / 9][i % 9] != seen[m][i / 9][i % 9];
            if (differ < 3) fail_msg("%s and %s look the same", letter[k], letter[m]);
        }
}

/* what is not in the font is refused, not drawn as something else, and named with its code */
static void foreign_letters(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_layout_piece *piece = NULL;
    int n = 0, capacity = 0;
    const char *text = "10 \xe2\x84\x83"; /* degree Celsius as one character */
    assert_null(fw_layout_text_lacks(all));
    assert_null(fw_layout_text_lacks("\xce\xbcm \xe2\x88\x92 A\xc2\xa0"
                                     "B")); /* by other letters */
    assert_ptr_equal(fw_layout_text_lacks(text), text + 3);
    assert_ptr_equal(fw_layout_text_lacks(text + 4), text + 4); /* inside of a character */
    assert_int_equal(fw_layout_text(arena, text, (fw_geometry_vec2){0, 0}, 9e-6, 1e-6, FW_ROLE_TEXT,
                                    "", &piece, &n, &capacity),
                     FW_GEOMETRY);
    assert_int_equal(n, 0);
    fw_place at = {"a.xml", 3, 7};
    assert_int_equal(fw_layout_text_check("A & B \xc2\xb5", "the title", at, &diags), FW_OK);
    assert_int_equal(fw_layout_text_check(text, "the title", at, &diags), FW_INPUT);
    assert_int_equal(diags.count, 1);
    assert_int_equal(diags.item[0].number, 390);
    assert_int_equal(diags.item[0].place.line, 3);
    assert_non_null(strstr(diags.item[0].message, "'\xe2\x84\x83' (U+2103)"));
    fw_arena_free(arena);
}

/* whole characters are dropped, and the rest with its '+' has room */
static void shortened(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double s = 5e-6;
    const char *text = "AB\xc3\x84"
                       "\xc3\x96",
               *shown;
    for (int cells = 0; cells < 40; cells++) {
        assert_int_equal(fw_layout_text_fit(arena, text, 9 * s, s, cells * s, &shown), FW_OK);
        bool whole = cells >= 34; /* four of 7 cells, three spaces of 2 */
        const char *wanted = whole         ? text
                             : cells >= 32 ? "AB\xc3\x84"
                                             "+"
                             : cells >= 23 ? "AB+"
                             : cells >= 14 ? "A+"
                                           : "";
        assert_string_equal(shown, wanted);
    }
    fw_arena_free(arena);
}

static void width_of_a_line(void **state) {
    (void)state;
    const double s = 5e-6;
    /* H 7 cells, 2 between, i 3 cells */
    assert_near(fw_layout_text_width("Hi", 9 * s, s), 12 * s, 1e-18);
    assert_near(fw_layout_text_width("", 9 * s, s), 0, 0);
    assert_near(fw_layout_text_width("H", 8 * s, s), 0, 0); /* refused size */
    /* cells of 100 um / 9, down to the grid */
    assert_near(fw_layout_text_width("H", 100e-6, s), 7 * 11.111e-6, 1e-15);
    /* a character of two bytes is one letter */
    assert_near(fw_layout_text_width("\xc2\xb5", 9 * s, s), 5 * s, 1e-18);
    lettering t = write_text("HI", (fw_geometry_vec2){0, 0}, 9 * s, s);
    fw_geometry_box last = fw_geometry_contour_box(&t.piece[t.n - 1].contour);
    assert_near(last.x1, 12 * s, 1e-15);
    assert_near(last.y1, 9 * s, 1e-15);
    fw_arena_free(t.arena);
}

/* what tells 0 8 B D O and 6 apart: full sides, where the gaps are, the bar inside the zero */
static void figures_by_their_features(void **state) {
    (void)state;
    static const struct {
        char letter;
        const char *rows; /* from the top: 'X' and '.' as drawn, '?' either */
    } seen[] = {
        {'0', ".XX.XX. XX???XX X.....X X..X..X X..X..X X..X..X X.....X XX???XX .XX.XX."},
        {'O', ".XX.XX. XX???XX X.....X X.....X X.....X X.....X X.....X XX???XX .XX.XX."},
        {'8', ".XX.XX. XX...XX X.....X XX...XX .XXXXX. XX...XX X.....X XX...XX .XX.XX."},
        {'B', "XXXXX?. X????XX X.....X X????XX X.XXX?. X????XX X.....X X????XX X.XXX?."},
        {'D', "XXXXX?. X????XX X.....X X.....X X.....X X.....X X.....X X????XX X.XXX?."},
        {'6', ".XXXXX. XX????? X...... X...... XXXXX?. X????XX X.....X XX???XX .XX.XX."},
        {'A', "??XXX?? ?XX.XX? XX...XX X.....X X.....X XXXXX.X X.....X X.....X X.....X"},
    };
    const double s = 8e-6;
    for (size_t k = 0; k < sizeof seen / sizeof seen[0]; k++) {
        const char letter[2] = {seen[k].letter, 0};
        lettering t = write_text(letter, (fw_geometry_vec2){0, 0}, 9 * s, s);
        for (int y = 0; y < 9; y++)
            for (int x = 0; x < 7; x++) {
                char wanted = seen[k].rows[8 * (8 - y) + x];
                bool there = drawn(&t, (x + 0.5) * s, (y + 0.5) * s);
                if (wanted != '?' && there != (wanted == 'X'))
                    fail_msg("letter %c, column %d, row %d from below", letter[0], x, y);
            }
        fw_arena_free(t.arena);
    }
}

static void refusals(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_layout_piece *piece = NULL;
    int n = 0, capacity = 0;
    const struct {
        double x, height, stroke;
    } bad[] = {
        {0, 8.9e-6, 1e-6},         {0, 9e-6, 0},    {0, (double)NAN, 1e-6}, {0, 9e-6, (double)NAN},
        {(double)NAN, 9e-6, 1e-6}, {2, 9e-6, 1e-6}, {0, HUGE_VAL, 1e-6},    {0, 9e-6, -1e-6}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_int_equal(fw_layout_text(arena, "A", (fw_geometry_vec2){bad[i].x, 0}, bad[i].height,
                                        bad[i].stroke, FW_ROLE_TEXT, "", &piece, &n, &capacity),
                         FW_GEOMETRY);
    assert_int_equal(n, 0);
    fw_arena_free(arena);
}

static void short_memory(void **state) {
    (void)state;
    fw_status status = FW_NOMEM;
    int failures = 0;
    for (long at = 1; status != FW_OK && at < 1000; at++) {
        fw_arena *arena = fw_arena_new(0);
        fw_layout_piece *piece = NULL;
        int n = 0, capacity = 0;
        fw_arena_fail_at(at, 1);
        status = fw_layout_text(arena, "A-B", (fw_geometry_vec2){0, 0}, 9e-6, 1e-6, FW_ROLE_TEXT,
                                "", &piece, &n, &capacity);
        fw_arena_fail_at(0, 0);
        assert_true(status == FW_OK || status == FW_NOMEM);
        failures += status == FW_NOMEM;
        fw_arena_free(arena);
    }
    assert_int_equal(status, FW_OK);
    assert_true(failures >= 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_hole_and_no_corner_contact),
        cmocka_unit_test(widths_and_spaces),
        cmocka_unit_test(every_letter_differs),
        cmocka_unit_test(foreign_letters),
        cmocka_unit_test(shortened),
        cmocka_unit_test(width_of_a_line),
        cmocka_unit_test(figures_by_their_features),
        cmocka_unit_test(refusals),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
