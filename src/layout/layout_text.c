/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/layout_text.h"
#include <math.h>
#include <string.h>

enum { ROWS = 9, WIDEST = 7, SPACING = 2, MOST_CORNERS = 2 * (ROWS + 1) * (WIDEST + 1) };

typedef struct glyph {
    char letter;
    const char *rows; /* ROWS of them from the top, a blank between; 'X' is drawn */
} glyph;

/* The gaps sit where stencils have them: at the foot of a bowl (A B D P R), in the middle of the
   top and bottom bar (0 O 8). test_layout_text.c proves for each letter: no hole, no two cells that
   touch at a corner only, three cells or more that differ from any other. */
static const glyph font[] = {
    {'A', "..XXX.. .XX.XX. XX...XX X.....X X.....X XXXXX.X X.....X X.....X X.....X"},
    {'B', "XXXXXX. X....XX X.....X X....XX X.XXXX. X....XX X.....X X....XX X.XXXX."},
    {'C', ".XXXXX. XX...XX X...... X...... X...... X...... X...... XX...XX .XXXXX."},
    {'D', "XXXXXX. X....XX X.....X X.....X X.....X X.....X X.....X X....XX X.XXXX."},
    {'E', "XXXXXX X..... X..... X..... XXXXX. X..... X..... X..... XXXXXX"},
    {'F', "XXXXXX X..... X..... X..... XXXXX. X..... X..... X..... X....."},
    {'G', ".XXXXX. XX...XX X...... X...... X...XXX X.....X X.....X XX...XX .XXXXX."},
    {'H', "X.....X X.....X X.....X X.....X XXXXXXX X.....X X.....X X.....X X.....X"},
    {'I', "XXX .X. .X. .X. .X. .X. .X. .X. XXX"},
    {'J', ".....X .....X .....X .....X .....X .....X X....X XX..XX .XXXX."},
    {'K', "X....XX X...XX. X..XX.. X.XX... XXX.... X.XX... X..XX.. X...XX. X....XX"},
    {'L', "X..... X..... X..... X..... X..... X..... X..... X..... XXXXXX"},
    {'M', "X.....X XX...XX XXX.XXX X.XXX.X X..X..X X.....X X.....X X.....X X.....X"},
    {'N', "X.....X XX....X XXX...X X.XX..X X..X..X X..XX.X X...XXX X....XX X.....X"},
    {'O', ".XX.XX. XX...XX X.....X X.....X X.....X X.....X X.....X XX...XX .XX.XX."},
    {'P', "XXXXXX. X....XX X.....X X....XX X.XXXX. X...... X...... X...... X......"},
    {'Q', ".XXXXX. XX...XX X.....X X.....X X.....X X.....X X..XX.X XX..XXX .XX..XX"},
    {'R', "XXXXXX. X....XX X.....X X....XX X.XXXX. X..XX.. X...XX. X....XX X.....X"},
    {'S', ".XXXXX. XX...XX X...... XX..... .XXXXX. .....XX ......X XX...XX .XXXXX."},
    {'T', "XXXXXXX ...X... ...X... ...X... ...X... ...X... ...X... ...X... ...X..."},
    {'U', "X.....X X.....X X.....X X.....X X.....X X.....X X.....X XX...XX .XXXXX."},
    {'V', "X.....X X.....X X.....X XX...XX .X...X. .XX.XX. ..X.X.. ..XXX.. ...X..."},
    {'W', "X.....X X.....X X.....X X.....X X..X..X X..X..X X.XXX.X XXX.XXX .X...X."},
    {'X', "X.....X XX...XX .X...X. .XX.XX. ..XXX.. .XX.XX. .X...X. XX...XX X.....X"},
    {'Y', "X.....X XX...XX .XX.XX. ..XXX.. ...X... ...X... ...X... ...X... ...X..."},
    {'Z', "XXXXXXX .....XX ....XX. ...XX.. ...X... ..XX... .XX.... XX..... XXXXXXX"},
    {'0', ".XX.XX. XX...XX X.....X X..X..X X..X..X X..X..X X.....X XX...XX .XX.XX."},
    {'1', "..X.. XXX.. ..X.. ..X.. ..X.. ..X.. ..X.. ..X.. XXXXX"},
    {'2', ".XXXXX. XX...XX ......X .....XX ....XX. ..XXX.. .XX.... XX..... XXXXXXX"},
    {'3', ".XXXXX. XX...XX ......X .....XX ..XXXX. .....XX ......X XX...XX .XXXXX."},
    {'4', "X....X. X....X. X....X. X....X. XXXXXXX .....X. .....X. .....X. .....X."},
    {'5', "XXXXXXX X...... X...... XXXXXX. .....XX ......X ......X XX...XX .XXXXX."},
    {'6', ".XXXXX. XX...XX X...... X...... XXXXXX. X....XX X.....X XX...XX .XX.XX."},
    {'7', "XXXXXXX .....XX .....X. ....XX. ....X.. ...XX.. ...X... ...X... ...X..."},
    {'8', ".XX.XX. XX...XX X.....X XX...XX .XXXXX. XX...XX X.....X XX...XX .XX.XX."},
    {'9', ".XX.XX. XX...XX X.....X XX....X .XXXXXX ......X ......X XX...XX .XXXXX."},
    {' ', "... ... ... ... ... ... ... ... ..."},
    {'.', ". . . . . . . . X"},
    {',', ".. .. .. .. .. .. .X .X XX"},
    {'-', "..... ..... ..... ..... XXXXX ..... ..... ..... ....."},
    {'+', "..... ..... ..X.. ..X.. XXXXX ..X.. ..X.. ..... ....."},
    {'=', "..... ..... ..... XXXXX ..... XXXXX ..... ..... ....."},
    {'/', "....X ...XX ...X. ..XX. ..X.. .XX.. .X... XX... X...."},
    {'_', "...... ...... ...... ...... ...... ...... ...... ...... XXXXXX"},
    {'(', ".XX XX. X.. X.. X.. X.. X.. XX. .XX"},
    {')', "XX. .XX ..X ..X ..X ..X ..X .XX XX."},
    {':', ". . . X . . X . ."},
    {'%', "XX....X XX...XX ....XX. ....X.. ...XX.. ..XX... .XX.... XX...XX X....XX"},
    {'#', ".X...X. .X...X. XXXXXXX .X...X. .X...X. .X...X. XXX.XXX .X...X. .X...X."},
    {'*', "..... ..... ..X.. X.X.X XXXXX X.X.X ..X.. ..... ....."},
};

static const glyph *find(unsigned char c) {
    char letter = (char)(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    const glyph *other = NULL;
    for (size_t i = 0; i < sizeof font / sizeof font[0]; i++) {
        if (font[i].letter == letter) return &font[i];
        if (font[i].letter == '*') other = &font[i];
    }
    return other;
}

/* one UTF-8 character counts once */
static bool continues(unsigned char c) {
    return (c & 0xc0) == 0x80;
}

double fw_layout_to_grid(double x_m) {
    return nearbyint(x_m * 1e9) / 1e9;
}

/* edge of a cell, m, a multiple of 1 nm; 0 for sizes that are refused */
static double cell_of(double height_m, double stroke_m) {
    if (!(stroke_m >= 1e-9 && height_m <= 1.0 && height_m >= ROWS * stroke_m * (1 - 1e-12)))
        return 0;
    return fmax(fw_layout_to_grid(stroke_m), floor(height_m / ROWS * 1e9 + 1e-6) / 1e9);
}

static size_t width_of(const glyph *g) {
    return strcspn(g->rows, " ");
}

double fw_layout_text_width(const char *string, double height_m, double stroke_m) {
    double cell = cell_of(height_m, stroke_m);
    size_t cells = 0;
    for (const unsigned char *s = (const unsigned char *)string; *s; s++)
        if (!continues(*s)) cells += width_of(find(*s)) + SPACING;
    return cells > 0 ? (double)(cells - SPACING) * cell : 0;
}

fw_status fw_layout_add(fw_arena *arena, fw_layout_piece item, fw_layout_piece **piece, int *npiece,
                        int *capacity) {
    if (*npiece >= *capacity) {
        int more = *capacity > 0 ? 2 * *capacity : 64;
        fw_layout_piece *grown =
            fw_arena_grow(arena, *piece, (size_t)*npiece, (size_t)more, sizeof **piece);
        FW_NEED(grown);
        *piece = grown;
        *capacity = more;
    }
    (*piece)[(*npiece)++] = item;
    return FW_OK;
}

/* cells of one letter, row 0 at the bottom, with an empty rim */
typedef struct raster {
    int width;
    signed char cell[ROWS + 2][WIDEST + 2]; /* 0 empty, 1 drawn, 2 already outlined */
} raster;

static raster fill(const glyph *g) {
    raster r = {.width = (int)width_of(g)};
    for (int y = 0; y < ROWS; y++) {
        const char *row = g->rows + (ROWS - 1 - y) * (r.width + 1);
        for (int x = 0; x < r.width; x++)
            r.cell[y + 1][x + 1] = row[x] == 'X';
    }
    return r;
}

/* cells reached through edges from (x, y), which is 1, become 2 */
static void flood(raster *r, int y, int x) {
    r->cell[y][x] = 2;
    if (r->cell[y - 1][x] == 1) flood(r, y - 1, x);
    if (r->cell[y + 1][x] == 1) flood(r, y + 1, x);
    if (r->cell[y][x - 1] == 1) flood(r, y, x - 1);
    if (r->cell[y][x + 1] == 1) flood(r, y, x + 1);
}

typedef struct corner {
    int x, y; /* grid lines */
} corner;

/* Walks round the part whose lowest, then leftmost cell is (x, y), material on the left, and keeps
   the places where the direction changes. Four steps suffice per corner of the grid. */
static int trace(const raster *r, int y, int x, corner *out) {
    static const int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
    /* cell ahead on the left and on the right of the grid corner, per direction */
    static const int lx[] = {0, -1, -1, 0}, ly[] = {0, 0, -1, -1};
    int n = 0, direction = 0, px = x, py = y;
    do {
        int right = (direction + 3) % 4;
        bool ahead_right = r->cell[py + ly[right]][px + lx[right]] != 0;
        bool ahead_left = r->cell[py + ly[direction]][px + lx[direction]] != 0;
        int turned = ahead_right ? right : ahead_left ? direction : (direction + 1) % 4;
        if (turned != direction || n == 0) out[n++] = (corner){px - 1, py - 1};
        direction = turned;
        px += dx[direction];
        py += dy[direction];
    } while ((px != x || py != y) && n < MOST_CORNERS);
    return n;
}

static fw_status add_part(fw_arena *arena, const corner *c, int n, fw_geometry_vec2 origin,
                          double cell, fw_layout_piece item, fw_layout_piece **piece, int *npiece,
                          int *capacity) {
    fw_geometry_outline outline = {0};
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 at = {fw_layout_to_grid(origin.x + c[i].x * cell),
                               fw_layout_to_grid(origin.y + c[i].y * cell)};
        if (i == 0)
            outline = fw_geometry_outline_start(arena, at);
        else
            fw_geometry_outline_line(&outline, at, 0);
    }
    FW_TRY(fw_geometry_outline_close(&outline, &item.contour));
    return fw_layout_add(arena, item, piece, npiece, capacity);
}

static fw_status add_letter(fw_arena *arena, const glyph *g, fw_geometry_vec2 origin, double cell,
                            fw_layout_piece item, fw_layout_piece **piece, int *npiece,
                            int *capacity) {
    raster r = fill(g);
    for (int y = 1; y <= ROWS; y++)
        for (int x = 1; x <= r.width; x++) {
            if (r.cell[y][x] != 1) continue;
            corner c[MOST_CORNERS];
            int n = trace(&r, y, x, c);
            FW_TRY(add_part(arena, c, n, origin, cell, item, piece, npiece, capacity));
            flood(&r, y, x);
        }
    return FW_OK;
}

fw_status fw_layout_text(fw_arena *arena, const char *string, fw_geometry_vec2 origin,
                         double height_m, double stroke_m, fw_layout_role role, const char *label,
                         fw_layout_piece **piece, int *npiece, int *capacity) {
    double cell = cell_of(height_m, stroke_m);
    if (!(cell > 0) || !(fabs(origin.x) < 1) || !(fabs(origin.y) < 1)) return FW_GEOMETRY;
    fw_geometry_vec2 at = {fw_layout_to_grid(origin.x), fw_layout_to_grid(origin.y)};
    fw_layout_piece item = {.role = role, .body = FW_NONE - 1, .joint = FW_NONE, .label = label};
    for (const unsigned char *s = (const unsigned char *)string; *s; s++) {
        if (continues(*s)) continue;
        const glyph *g = find(*s);
        FW_TRY(add_letter(arena, g, at, cell, item, piece, npiece, capacity));
        at.x += (double)(width_of(g) + SPACING) * cell;
    }
    return FW_OK;
}
