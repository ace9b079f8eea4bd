/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/layout_text.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

enum { ROWS = 9, SHORT = 6, WIDEST = 9, SPACING = 2, ACCENT_WIDTH = 5 };
enum { MOST_CORNERS = 2 * (ROWS + 1) * (WIDEST + 1) };

/* rows from the top, a blank between them: ROWS, or the lower SHORT of them; 'X' is drawn */
typedef struct glyph {
    unsigned code;
    const char *rows, *accent; /* the upper two rows; NULL: none */
} glyph;

#define LETTER(code, rows)
#define ACCENTED(code, below, accent)
#define ALIAS(code, other)
#define ACCENT(name, rows) static const char accent_##name[] = rows;
#define BELOW(name, rows)  static const char below_##name[] = rows;
#include "layout/glyphs.def"
#undef LETTER
#undef ACCENTED
#undef ACCENT
#undef BELOW
#define ACCENT(name, rows)
#define BELOW(name, rows)
#define LETTER(code, rows)            {code, rows, NULL},
#define ACCENTED(code, below, accent) {code, below_##below, accent_##accent},
static const glyph font[] = {
#include "layout/glyphs.def"
};
#undef LETTER
#undef ACCENTED
#undef ALIAS
#define LETTER(code, rows)
#define ACCENTED(code, below, accent)
#define ALIAS(code, other) {code, other},
static const struct {
    unsigned code, other;
} alias[] = {
#include "layout/glyphs.def"
};

/* NULL: the font lacks it */
static const glyph *find(unsigned code) {
    for (size_t i = 0; i < sizeof alias / sizeof alias[0]; i++)
        if (alias[i].code == code) code = alias[i].other;
    for (size_t i = 0; i < sizeof font / sizeof font[0]; i++)
        if (font[i].code == code) return &font[i];
    return NULL;
}

const char *fw_layout_text_lacks(const char *string) {
    const char *at = string;
    while (*at) {
        const char *letter = at;
        if (!find(fw_text_character(&at))) return letter;
    }
    return NULL;
}

fw_status fw_layout_text_check(const char *string, const char *what, fw_place place,
                               fw_diags *diags) {
    const char *lacking = fw_layout_text_lacks(string), *end = lacking;
    if (!lacking) return FW_OK;
    unsigned code = fw_text_character(&end);
    return fw_diag_error(
        diags, 390, place,
        "%s \"%s\" holds '%.*s' (U+%04X), which the lettering of the masks does not "
        "have; write it with ASCII, the letters of Latin-1 or a Greek mu",
        what, string, (int)(end - lacking), lacking, code);
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

/* is it drawn in row y from the top? */
static bool is_drawn(const glyph *g, int y, int x) {
    int width = (int)width_of(g), above = ROWS - (int)((strlen(g->rows) + 1) / (size_t)(width + 1));
    if (y >= above) return g->rows[(y - above) * (width + 1) + x] == 'X';
    x -= (width - ACCENT_WIDTH) / 2;
    return g->accent && y < 2 && x >= 0 && x < ACCENT_WIDTH &&
           g->accent[y * (ACCENT_WIDTH + 1) + x] == 'X';
}

double fw_layout_text_width(const char *string, double height_m, double stroke_m) {
    double cell = cell_of(height_m, stroke_m);
    size_t cells = 0;
    for (const char *s = string; *s;) {
        const glyph *g = find(fw_text_character(&s));
        if (g) cells += width_of(g) + SPACING;
    }
    return cells > 0 ? (double)(cells - SPACING) * cell : 0;
}

fw_status fw_layout_text_fit(fw_arena *arena, const char *string, double height_m, double stroke_m,
                             double length_m, const char **shown) {
    char *text = fw_arena_printf(arena, "%s+", string);
    FW_NEED(*shown = text);
    size_t n = strlen(string);
    text[n] = '\0';
    while (n > 0 && fw_layout_text_width(text, height_m, stroke_m) > length_m) {
        n--;
        while (n > 0 && ((unsigned char)text[n] & 0xc0) == 0x80) /* inside a character */
            n--;
        strcpy(text + n, n > 0 ? "+" : "");
    }
    return FW_OK;
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
    for (int y = 0; y < ROWS; y++)
        for (int x = 0; x < r.width; x++)
            r.cell[y + 1][x + 1] = is_drawn(g, ROWS - 1 - y, x);
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
    if (fw_layout_text_lacks(string)) return FW_GEOMETRY;
    fw_geometry_vec2 at = {fw_layout_to_grid(origin.x), fw_layout_to_grid(origin.y)};
    fw_layout_piece item = {.role = role, .body = FW_NONE - 1, .joint = FW_NONE, .label = label};
    for (const char *s = string; *s;) {
        const glyph *g = find(fw_text_character(&s));
        FW_TRY(add_letter(arena, g, at, cell, item, piece, npiece, capacity));
        at.x += (double)(width_of(g) + SPACING) * cell;
    }
    return FW_OK;
}
