/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lettering, alignment marks and the dicing lane. */
#include "base/text.h"
#include "layout/layout_rules.h"
#include "layout/layout.h"
#include <math.h>
#include <string.h>

/* ---- lettering ---- */

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
        "have; write it with ASCII, the letters of Latin-1, a Greek mu or Omega",
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

/* ---- marks and the lane ---- */

static const double UM = 1e-6;
static const double MARGIN_M = 10e-6;      /* to the window and to the lane */
static const double LEAST_STROKE_M = 5e-6; /* 4 um rule of contact lithography, and a reserve */
static const double LARGEST_STROKE_M = 12e-6;
static const double LEAST_SIDE_M = 60e-6;     /* of a corner's square with its bracket and cross */
enum { MOST_LINES = 2, HIGH = 9, APART = 4 }; /* strokes: a line of text, and between two */

typedef struct sheet { /* where marks and text go */
    fw_arena *arena;
    fw_layout_piece **piece;
    int *npiece, *capacity;
    fw_geometry_box window, die;
    double lane;
} sheet;

static fw_status add_points(const sheet *s, const fw_geometry_vec2 *p, int n, bool reverse,
                            fw_layout_piece item) {
    fw_geometry_outline outline = {0};
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 at = p[reverse ? n - 1 - i : i];
        at = (fw_geometry_vec2){fw_layout_to_grid(at.x), fw_layout_to_grid(at.y)};
        if (i == 0)
            outline = fw_geometry_outline_start(s->arena, at);
        else
            fw_geometry_outline_line(&outline, at, 0);
    }
    FW_TRY(fw_geometry_outline_close(&outline, &item.contour));
    return fw_layout_add(s->arena, item, s->piece, s->npiece, s->capacity);
}

void fw_layout_cross(fw_geometry_vec2 centre, double w, double a, double f, double b,
                     fw_geometry_vec2 p[FW_LAYOUT_CROSS]) {
    const fw_geometry_vec2 arm[] = {{w, -w}, {a, -w}, {a, -f}, {b, -f}, {b, f}, {a, f}, {a, w}};
    enum { PER_ARM = sizeof arm / sizeof arm[0] };
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < PER_ARM; i++) {
            fw_geometry_vec2 v = arm[i];
            for (int turn = 0; turn < k; turn++)
                v = (fw_geometry_vec2){-v.y, v.x};
            p[k * PER_ARM + i] = (fw_geometry_vec2){centre.x + v.x, centre.y + v.y};
        }
}

static fw_status add_cross(const sheet *s, fw_geometry_vec2 centre, double w, double a, double f,
                           double b) {
    fw_geometry_vec2 p[FW_LAYOUT_CROSS];
    fw_layout_cross(centre, w, a, f, b, p);
    fw_layout_piece item = {FW_ROLE_MARK, FW_NONE - 1, FW_NONE, "alignment cross", {0}};
    return add_points(s, p, FW_LAYOUT_CROSS, false, item);
}

/* L whose outer corner is at `at` and whose arms point along (sx, sy) */
static fw_status add_bracket(const sheet *s, fw_geometry_vec2 at, int sx, int sy, double width,
                             double arm) {
    const fw_geometry_vec2 local[] = {{0, 0},         {arm, 0},     {arm, width},
                                      {width, width}, {width, arm}, {0, arm}};
    enum { CORNERS = sizeof local / sizeof local[0] };
    fw_geometry_vec2 p[CORNERS];
    for (int i = 0; i < CORNERS; i++)
        p[i] = (fw_geometry_vec2){at.x + sx * local[i].x, at.y + sy * local[i].y};
    fw_layout_piece item = {FW_ROLE_MARK, FW_NONE - 1, FW_NONE, "corner bracket", {0}};
    return add_points(s, p, CORNERS, sx * sy < 0, item);
}

static double narrowest_bar(const fw_geometry_box *window, const fw_geometry_box *die) {
    return fmin(fmin(window->x0 - die->x0, die->x1 - window->x1),
                fmin(window->y0 - die->y0, die->y1 - window->y1));
}

/* where they are left out, a mask is turned and set by nothing but its devices */
static void say_no_marks(const fw_device_die *die, double bar_m, fw_diags *diags) {
    char bar[32], least[32];
    fw_diag_warning(diags, 619, die->frame_place,
                    "the corners of the frame have no room for their alignment crosses, by which "
                    "a mask is turned and set: its narrowest bar is %s um wide; with <die "
                    "frame=\"%s um\"> they are there",
                    fw_number_text(bar, sizeof bar, bar_m * 1e6, 5),
                    fw_number_text(least, sizeof least, (LEAST_SIDE_M + 2 * MARGIN_M) * 1e6, 5));
}

/* in the square of each corner: bracket outside, cross inside; all in units of 1/13 of the square
 */
static fw_status add_marks(const sheet *s, const fw_device_die *die, fw_diags *diags) {
    double bar = narrowest_bar(&s->window, &s->die) - s->lane, side = bar - 2 * MARGIN_M;
    if (side < LEAST_SIDE_M - 1e-12) {
        if (diags) say_no_marks(die, bar, diags);
        return FW_OK;
    }
    double q = fmin(fw_layout_to_grid(side / 13), 20 * UM);
    double inset = s->lane + MARGIN_M;
    double fine = fmax(0.3 * q, 0.5 * LEAST_STROKE_M);
    for (int k = 0; k < 4; k++) {
        int sx = k % 2 ? -1 : 1, sy = k / 2 ? -1 : 1;
        fw_geometry_vec2 at = {sx > 0 ? s->die.x0 + inset : s->die.x1 - inset,
                               sy > 0 ? s->die.y0 + inset : s->die.y1 - inset};
        fw_geometry_vec2 centre = {at.x + sx * 7.5 * q, at.y + sy * 7.5 * q};
        FW_TRY(add_bracket(s, at, sx, sy, q, 6 * q));
        FW_TRY(add_cross(s, centre, q, 3 * q, fine, 5 * q));
    }
    return FW_OK;
}

/* the lane along one side; the two shorter ones end at the two longer ones, on shared edges */
static fw_status add_lane_side(const sheet *s, fw_geometry_box b, bool joined_at_ends, bool flip) {
    fw_geometry_outline o = {0};
    if (joined_at_ends) { /* bottom or top: its left and right edges are joints */
        o = fw_geometry_outline_start(s->arena, (fw_geometry_vec2){b.x0, b.y0});
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x1, b.y0}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x1, b.y1}, FW_SEGMENT_JOINT);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x0, b.y1}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x0, b.y0}, FW_SEGMENT_JOINT);
    } else if (!flip) { /* left: joints at the ends of its right edge */
        o = fw_geometry_outline_start(s->arena, (fw_geometry_vec2){b.x0, b.y0});
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x1, b.y0}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x1, s->die.y0 + s->lane},
                                 FW_SEGMENT_JOINT);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x1, s->die.y1 - s->lane}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x1, b.y1}, FW_SEGMENT_JOINT);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x0, b.y1}, 0);
    } else { /* right: joints at the ends of its left edge */
        o = fw_geometry_outline_start(s->arena, (fw_geometry_vec2){b.x1, b.y1});
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x0, b.y1}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x0, s->die.y1 - s->lane},
                                 FW_SEGMENT_JOINT);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x0, s->die.y0 + s->lane}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x0, b.y0}, FW_SEGMENT_JOINT);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){b.x1, b.y0}, 0);
    }
    fw_layout_piece item = {FW_ROLE_DICING, FW_NONE - 1, FW_NONE, "dicing lane", {0}};
    FW_TRY(fw_geometry_outline_close(&o, &item.contour));
    return fw_layout_add(s->arena, item, s->piece, s->npiece, s->capacity);
}

static fw_status add_lane(const sheet *s) {
    const fw_geometry_box d = s->die;
    double w = s->lane;
    if (!(w > 0)) return FW_OK;
    FW_TRY(add_lane_side(s, (fw_geometry_box){d.x0, d.y0, d.x0 + w, d.y1}, false, false));
    FW_TRY(add_lane_side(s, (fw_geometry_box){d.x1 - w, d.y0, d.x1, d.y1}, false, true));
    FW_TRY(add_lane_side(s, (fw_geometry_box){d.x0 + w, d.y0, d.x1 - w, d.y0 + w}, true, false));
    return add_lane_side(s, (fw_geometry_box){d.x0 + w, d.y1 - w, d.x1 - w, d.y1}, true, false);
}

/* ---- text ---- */
static double width_of_line(const char *string, double stroke) {
    return fw_layout_text_width(string, HIGH * stroke, stroke);
}

static fw_status add_text(const sheet *s, const char *string, double x, double y, double stroke,
                          const char *label) {
    return fw_layout_text(s->arena, string, (fw_geometry_vec2){x, y}, HIGH * stroke, stroke,
                          FW_ROLE_TEXT, label, s->piece, s->npiece, s->capacity);
}

/* a stated title that does not fit in the lower bar of the frame; shown: what is drawn of it */
static void say_title(const fw_device_die *die, const char *shown, double need_m, double room_m,
                      fw_diags *diags) {
    char need[32], room[32];
    fw_number_text(need, sizeof need, need_m * 1e6, 5);
    fw_number_text(room, sizeof room, room_m * 1e6, 5);
    if (*shown)
        fw_diag_warning(diags, 139, die->title_place,
                        "the title \"%s\" is %s um long in the smallest lettering, but the lower "
                        "bar of the frame is %s um long, so it is drawn as \"%s\"; shorten it, or "
                        "make the die wider",
                        die->title, need, room, shown);
    else
        fw_diag_warning(diags, 139, die->title_place,
                        "the title \"%s\" is not drawn: the smallest lettering is %s um high, and "
                        "the lower bar of the frame has %s um for it; make the frame wider",
                        die->title, need, room);
}

/* title left and version right in the lower bar; the version goes first when both do not fit */
static fw_status add_title(const sheet *s, const fw_device_die *die, const char *title,
                           fw_diags *diags) {
    double length = s->window.x1 - s->window.x0;
    double y0 = s->die.y0 + s->lane + MARGIN_M, band = s->window.y0 - MARGIN_M - y0;
    const char *version = "FLEXWRIGHT " FW_VERSION;
    double stroke = LARGEST_STROKE_M;
    while (stroke > LEAST_STROKE_M &&
           (HIGH * stroke > band ||
            width_of_line(title, stroke) + width_of_line(version, stroke) + 12 * stroke > length))
        stroke -= UM;
    if (HIGH * stroke > band) {
        if (die->title && diags) say_title(die, "", HIGH * stroke, band, diags);
        return FW_OK;
    }
    const char *shown;
    FW_TRY(fw_layout_text_fit(s->arena, title, HIGH * stroke, stroke, length, &shown));
    if (die->title && diags && strcmp(shown, title) != 0)
        say_title(die, shown, width_of_line(title, stroke), length, diags);
    double y = y0 + 0.5 * (band - HIGH * stroke);
    FW_TRY(add_text(s, shown, s->window.x0, y, stroke, "title"));
    double width = width_of_line(version, stroke);
    if (width_of_line(shown, stroke) + width + 12 * stroke > length) return FW_OK;
    return add_text(s, version, s->window.x1 - width, y, stroke, "version");
}

typedef struct items {
    const char **text;
    int count;
} items;

static fw_status add_item(fw_arena *arena, items *list, const fw_device_parameter *p) {
    fw_quantity_unit u = {.factor = 1};
    const char *unit = p->unit ? p->unit : "";
    if (!*unit || !fw_quantity_unit_parse(unit, strlen(unit), &u, NULL, NULL)) unit = "";
    char number[64];
    fw_number_text(number, sizeof number, fw_quantity_unit_from_si(&u, p->value), 6);
    const char *text = fw_arena_printf(arena, "%s=%s%s%s", p->name, number, *unit ? " " : "", unit);
    FW_NEED(text);
    list->text[list->count++] = text;
    return FW_OK;
}

/* only what holds for the drawing itself: what differs from flow to flow (thickness, material)
   stands in the notes layer of each flow's mask, so that a plate never tells of another flow */
static fw_status list_parameters(fw_arena *arena, const fw_device *device, items *list) {
    FW_NEED(list->text = fw_arena_array(arena, const char *, (size_t)device->nparameter + 1));
    for (int i = 0; i < device->nparameter; i++)
        FW_TRY(add_item(arena, list, &device->parameter[i]));
    return FW_OK;
}

/* fills lines with whole items; returns how many were placed */
static fw_status compose(fw_arena *arena, const items *list, int nline, double stroke,
                         double length, const char **line, int *placed) {
    int next = 0;
    for (int k = 0; k < nline; k++) {
        line[k] = "";
        while (next < list->count) {
            const char *tried =
                fw_arena_printf(arena, "%s%s%s", line[k], *line[k] ? "  " : "", list->text[next]);
            FW_NEED(tried);
            bool last = k == nline - 1 && next < list->count - 1; /* room for the '+' */
            if (width_of_line(tried, stroke) + (last ? 12 * stroke : 0) > length) break;
            line[k] = tried;
            next++;
        }
    }
    *placed = next;
    if (next < list->count && nline > 0) {
        FW_NEED(line[nline - 1] = fw_arena_printf(arena, "%s +", line[nline - 1]));
    }
    return FW_OK;
}

/* in the upper bar: the largest stroke with which everything fits on one line, else on two */
static fw_status add_parameters(const sheet *s, const fw_device *device) {
    items list = {0};
    FW_TRY(list_parameters(s->arena, device, &list));
    double length = s->window.x1 - s->window.x0;
    double y0 = s->window.y1 + MARGIN_M, band = s->die.y1 - s->lane - MARGIN_M - y0;
    const char *line[MOST_LINES] = {0};
    int nline = 0, placed = -1;
    double stroke = LARGEST_STROKE_M, used = 0;
    for (; stroke > LEAST_STROKE_M - 0.5 * UM; stroke -= UM) {
        for (int k = 1; k <= MOST_LINES && placed < list.count; k++) {
            if (((HIGH + APART) * k - APART) * stroke > band || list.count == 0) break;
            FW_TRY(compose(s->arena, &list, k, stroke, length, line, &placed));
            nline = k;
            used = stroke;
        }
        if (placed == list.count) break;
    }
    double height = ((HIGH + APART) * nline - APART) * used;
    for (int k = 0; k < nline; k++) {
        double y = y0 + 0.5 * (band - height) + (nline - 1 - k) * (HIGH + APART) * used;
        FW_TRY(add_text(s, line[k], s->window.x0, y, used, "parameter text"));
    }
    return FW_OK;
}

/* what is drawn as the title; a stated one that cannot be lettered is refused, a name is left out and
   that is said, for nobody said that it would be lettered */
static fw_status choose_title(fw_arena *arena, const fw_device *device, fw_diags *diags,
                              const char **title) {
    const char *name = device->name;
    *title = device->die.title;
    if (*title) {
        fw_diags unsaid = fw_diags_new(arena);
        fw_status status = fw_layout_text_check(*title, "the title", device->die.title_place,
                                                diags ? diags : &unsaid);
        return status == FW_INPUT ? FW_GEOMETRY : status;
    }
    *title = name;
    const char *lacking = fw_layout_text_lacks(name), *behind = lacking;
    if (!lacking) return FW_OK;
    *title = "";
    fw_text_character(&behind);
    if (diags)
        fw_diag_warning(diags, 390, (fw_place){device->file, 0, 0},
                        "the die has no title, because the name \"%s\" holds '%.*s', which the "
                        "lettering of the masks does not have; add <die title=\"...\"> in ASCII, "
                        "letters of Latin-1, a Greek mu or Omega",
                        name, (int)(behind - lacking), lacking);
    return FW_OK;
}

fw_status fw_layout_annotate(fw_arena *arena, const fw_device *device, fw_geometry_box window,
                             fw_geometry_box die, fw_diags *diags, fw_layout_piece **piece,
                             int *npiece, int *capacity) {
    sheet s = {arena, piece, npiece, capacity, window, die, device->die.lane_m};
    double bar = narrowest_bar(&window, &die);
    if (isnan(s.lane)) s.lane = fw_layout_rule.lane_m; /* the frame begins there */
    bool inside = window.x0 < window.x1 && window.y0 < window.y1 && bar >= 0 && bar < 1;
    if (!inside || !(s.lane >= 0 && s.lane <= bar)) return FW_GEOMETRY;
    FW_TRY(add_lane(&s));
    FW_TRY(add_marks(&s, &device->die, diags));
    const char *title;
    FW_TRY(choose_title(arena, device, diags, &title));
    FW_TRY(add_title(&s, &device->die, title, diags));
    return add_parameters(&s, device);
}
