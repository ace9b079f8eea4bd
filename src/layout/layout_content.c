/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of test patterns, and the test die with them: frame, bars with what stands on them, fill, title, marks
   and lane. */
#include "base/sort.h"
#include "layout/draw.h"
#include "layout/pattern.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the kinds ---- */

#define FW_LAYOUT_PATTERN(name) extern const fw_layout_pattern_kind fw_layout_pattern_##name;
#include "layout/patterns.def"
#undef FW_LAYOUT_PATTERN
#define FW_LAYOUT_PATTERN(name) &fw_layout_pattern_##name,
static const fw_layout_pattern_kind *const kinds[] = {
#include "layout/patterns.def"
};
#undef FW_LAYOUT_PATTERN
enum { NKIND = sizeof kinds / sizeof kinds[0] };

const fw_layout_pattern_kind *fw_layout_pattern_kind_at(size_t i) {
    return i < NKIND ? kinds[i] : NULL;
}

const fw_layout_pattern_kind *fw_layout_pattern_kind_named(const char *name) {
    for (size_t i = 0; i < NKIND; i++)
        if (strcmp(kinds[i]->name, name) == 0) return kinds[i];
    return NULL;
}

fw_status fw_layout_pattern_draw(fw_arena *arena, const fw_layout_pattern *pattern,
                                 double width_rule_m, double space_rule_m, double bias_m,
                                 fw_layout_coupon *coupon) {
    *coupon = (fw_layout_coupon){.pattern = pattern};
    fw_layout_pen pen = {.arena = arena,
                         .pattern = pattern,
                         .coupon = coupon,
                         .width_rule_m = width_rule_m,
                         .space_rule_m = space_rule_m,
                         .bias_m = pattern->biased ? bias_m : 0.0};
    return pattern->kind->draw(&pen);
}

/* ---- the test die ---- */

typedef struct shelf {   /* a bar with what stands on it */
    double low_m, top_m; /* of the bar, once all rows are known */
    double height_m;     /* of the tallest pattern */
    double used_m;       /* along x, from the row's start */
} shelf;

enum { SHELVES = 64 };
typedef struct bench { /* the die while it is being built */
    fw_arena *arena;
    fw_diags *diags;
    const fw_layout_content_options *options;
    fw_layout_content *content;
    fw_layout *layout;
    const fw_layout_pattern *fill; /* NULL: none */
    int capacity;
    fw_geometry_box window; /* between the frame's bars; low edge: top of the lowest bar's frame */
    double lane_m, keep_m, start_m, end_m; /* patterns lie from start to end */
    double floor_m, ceiling_m;             /* top of the lowest bar, foot of the highest */
    shelf shelf[SHELVES];
    int nshelf, *where; /* shelf of each coupon, -1: none */
    double *offset;     /* of each coupon along its shelf */
} bench;

static const double KEEP_M = 60e-6; /* between patterns where no fill says more */
static const double LEAST_ROW_M = 200e-6, TALLEST_FILL_M = 400e-6;
enum { FILL_SQUARE, FILL_STEM, FILL_DENSITY, FILL_KEEP };

static fw_status add_piece(bench *b, const fw_layout_piece *piece) {
    return fw_layout_add(b->arena, *piece, &b->layout->piece, &b->layout->npiece, &b->capacity);
}

/* Where the patterns go: rows from the bottom, first fit in the order of the table. */

static const double STROKE_M = 5e-6;
static const double BAND_M = 125e-6; /* 10, letters 45, 15, letters 45, 10 um */
enum { HIGH = 9 };
static const double APART_M = 20e-6; /* between two pieces of lettering */

static double width_of(const char *text) {
    return fw_layout_text_width(text, HIGH * STROKE_M, STROKE_M);
}

/* left end of a feature's lettering, or a negative number when there is no room behind `taken` */
static double label_at(const fw_layout_feature *f, double taken) {
    double w = width_of(f->label), x = fmax(0.5 * (f->from.x + f->to.x - w), 0);
    return x < taken ? -1 : x;
}

/* width with its lettering */
static double slot_width_m(const fw_layout_coupon *coupon) {
    double width = fmax(coupon->width_m, width_of(coupon->pattern->title)), taken = 0;
    for (int i = 0; i < coupon->nfeature; i++) {
        const fw_layout_feature *f = &coupon->feature[i];
        double x = f->label ? label_at(f, taken) : -1;
        if (x < 0) continue;
        width = fmax(width, x + width_of(f->label));
        taken = x + width_of(f->label) + APART_M;
    }
    return fw_layout_to_grid(width);
}

/* what all rows take, were the one `k` at least `height` high */
static double total_height(const bench *b, int k, double height) {
    double sum = 0;
    int n = k >= b->nshelf ? k + 1 : b->nshelf;
    for (int i = 0; i < n; i++) {
        double own = i < b->nshelf ? b->shelf[i].height_m : 0;
        sum += (i == k ? fmax(own, height) : own) + b->keep_m + (i ? BAND_M : 0);
    }
    return sum;
}

static bool fits(const bench *b, int k, double width, double height) {
    double used = k < b->nshelf ? b->shelf[k].used_m : 0, gap = used > 0 ? b->keep_m : 0;
    return b->start_m + used + gap + width <= b->end_m + 1e-12 &&
           total_height(b, k, height) <= b->ceiling_m - b->floor_m + 1e-12;
}

static void leave_out(bench *b, const fw_layout_coupon *c, double width) {
    char w[32], h[32], most[32];
    fw_diag_warning(b->diags, 186, c->pattern->place,
                    "the test pattern %s (%s um wide, %s um high with its lettering) finds no room "
                    "on the test die, whose rows are %s um long; it is left out: enlarge the die, "
                    "or move the row up in the table",
                    c->pattern->id, fw_number_text(w, sizeof w, width * 1e6, 6),
                    fw_number_text(h, sizeof h, (c->height_m + BAND_M) * 1e6, 6),
                    fw_number_text(most, sizeof most, (b->end_m - b->start_m) * 1e6, 6));
}

static fw_status pack_shelves(bench *b) {
    fw_layout_content *content = b->content;
    for (int i = 0; i < content->ncoupon; i++) {
        fw_layout_coupon *c = &content->coupon[i];
        double width = slot_width_m(c);
        int k = 0;
        while (k < b->nshelf && !fits(b, k, width, c->height_m))
            k++;
        b->where[i] = -1;
        if (k == SHELVES || !fits(b, k, width, c->height_m)) {
            leave_out(b, c, width);
            continue;
        }
        if (k == b->nshelf) b->shelf[b->nshelf++] = (shelf){0};
        shelf *s = &b->shelf[k];
        b->where[i] = k;
        b->offset[i] = fw_layout_to_grid(s->used_m > 0 ? s->used_m + b->keep_m : 0);
        s->used_m = b->offset[i] + width;
        s->height_m = fmax(s->height_m, c->height_m);
        c->placed = true;
        content->nplaced++;
    }
    return FW_OK;
}

/* ---- pieces on their places ---- */

static fw_geometry_vec2 moved(fw_geometry_vec2 p, fw_geometry_vec2 by) {
    return (fw_geometry_vec2){fw_layout_to_grid(p.x + by.x), fw_layout_to_grid(p.y + by.y)};
}

static void move_contour(fw_geometry_contour *c, fw_geometry_vec2 by) {
    for (int i = 0; i < c->count; i++) {
        fw_geometry_segment *s = &c->segment[i];
        s->a = moved(s->a, by);
        s->b = moved(s->b, by);
        if (s->kind == FW_ARC) s->centre = moved(s->centre, by);
    }
}

static fw_status add_biased(bench *b, const fw_layout_coupon *c, fw_layout_piece *piece) {
    double bias = b->options->bias_m;
    fw_geometry_contour out;
    int i = -1, j = -1;
    if (!c->pattern->biased || bias == 0 || piece->role != FW_ROLE_STRUCTURE)
        return add_piece(b, piece);
    fw_status status = fw_geometry_contour_offset(b->arena, &piece->contour, bias, &out, &i, &j);
    if (status == FW_GEOMETRY) {
        char number[32];
        fw_diag_error(b->diags, 187, c->pattern->place,
                      "the test pattern %s cannot take the bias of %s um per edge: give it wider "
                      "spaces, or bias=\"no\"",
                      c->pattern->id, fw_number_text(number, sizeof number, bias * 1e6, 6));
        return FW_GEOMETRY;
    }
    FW_TRY(status);
    piece->contour = out;
    return add_piece(b, piece);
}

static fw_status add_text(bench *b, const char *text, double x, double y) {
    return fw_layout_text(b->arena, text,
                          (fw_geometry_vec2){fw_layout_to_grid(x), fw_layout_to_grid(y)},
                          HIGH * STROKE_M, STROKE_M, FW_ROLE_TEXT, "lettering of a test pattern",
                          &b->layout->piece, &b->layout->npiece, &b->capacity);
}

/* sizes below what they belong to, the name below them */
static fw_status add_lettering(bench *b, const fw_layout_coupon *c) {
    double high = HIGH * STROKE_M, line = c->at.y - 10e-6 - high, taken = 0;
    for (int i = 0; i < c->nfeature; i++) {
        const fw_layout_feature *f = &c->feature[i];
        double x = f->label ? label_at(f, taken) : -1;
        if (x < 0) continue;
        FW_TRY(add_text(b, f->label, c->at.x + x, line));
        taken = x + width_of(f->label) + APART_M;
    }
    return add_text(b, c->pattern->title, c->at.x, line - 15e-6 - high);
}

/* pieces of the patterns and their lettering */
static fw_status place_patterns(bench *b) {
    for (int i = 0; i < b->content->ncoupon; i++) {
        fw_layout_coupon *c = &b->content->coupon[i];
        if (b->where[i] < 0) continue;
        c->at = moved((fw_geometry_vec2){b->start_m, b->shelf[b->where[i]].top_m},
                      (fw_geometry_vec2){b->offset[i], 0});
        for (int k = 0; k < c->npiece; k++) {
            move_contour(&c->piece[k].contour, c->at);
            FW_TRY(add_biased(b, c, &c->piece[k]));
        }
        FW_TRY(add_lettering(b, c));
    }
    return FW_OK;
}

/* ---- rows ---- */

static bool prepare(bench *b) {
    const fw_layout_content_options *o = b->options;
    double frame = fw_layout_to_grid(isnan(o->frame_m) ? fw_layout_rule.frame_m : o->frame_m);
    b->lane_m = fw_layout_to_grid(isnan(o->lane_m) ? fw_layout_rule.lane_m : o->lane_m);
    double rim = frame + b->lane_m;
    b->window =
        (fw_geometry_box){fw_layout_to_grid(o->die.x0 + rim), fw_layout_to_grid(o->die.y0 + rim),
                          fw_layout_to_grid(o->die.x1 - rim), fw_layout_to_grid(o->die.y1 - rim)};
    b->keep_m = b->fill ? b->fill->value[FILL_KEEP] : KEEP_M;
    b->start_m = fw_layout_to_grid(b->window.x0 + b->keep_m);
    b->end_m = fw_layout_to_grid(b->window.x1 - b->keep_m);
    b->floor_m = fw_layout_to_grid(b->window.y0 + BAND_M);
    b->ceiling_m = b->window.y1;
    return b->end_m - b->start_m >= LEAST_ROW_M && b->ceiling_m - b->floor_m >= LEAST_ROW_M;
}

/* rows of fill alone where height is left */
static void add_empty_rows(bench *b) {
    double used = 0;
    for (int k = 0; k < b->nshelf; k++)
        used += b->shelf[k].height_m + b->keep_m + (k ? BAND_M : 0);
    double each = BAND_M + b->keep_m, left = b->ceiling_m - b->floor_m - used;
    double cell = b->fill->value[FILL_SQUARE];
    int n = (int)ceil(left / (each + TALLEST_FILL_M));
    double height = n > 0 ? fw_layout_to_grid(left / n - each - 1e-9) : 0;
    for (int i = 0; i < n && height >= cell && b->nshelf < SHELVES; i++)
        b->shelf[b->nshelf++] = (shelf){.height_m = height};
}

static void set_levels(bench *b) {
    double y = b->floor_m;
    for (int k = 0; k < b->nshelf; k++) {
        shelf *s = &b->shelf[k];
        s->low_m = k ? y : b->window.y0;
        s->top_m = k ? fw_layout_to_grid(y + BAND_M) : y;
        y = fw_layout_to_grid(s->top_m + s->height_m + b->keep_m);
    }
}

/* ---- fill ---- */

/* a chain of squares on the bar, stems between and below */
static fw_status add_chain(bench *b, double x, double y, double gap, int count) {
    double s = b->fill->value[FILL_SQUARE], stem = b->fill->value[FILL_STEM];
    double a = fw_layout_to_grid(x + 0.5 * (s - stem)), c = fw_layout_to_grid(a + stem);
    double x1 = fw_layout_to_grid(x + s);
    fw_geometry_outline o = fw_geometry_outline_start(b->arena, (fw_geometry_vec2){a, y});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){c, y}, FW_SEGMENT_JOINT);
    for (int right = 1; right >= 0; right--)
        for (int i = 0; i < count; i++) {
            int k = right ? i : count - 1 - i;
            double low = fw_layout_to_grid(y + gap + k * (s + gap));
            double high = fw_layout_to_grid(low + s);
            double in = right ? c : a, out = right ? x1 : x, first = right ? low : high;
            double last = right ? high : low;
            bool end = k == count - 1; /* the top of the last square is one edge */
            if (!(end && !right)) fw_geometry_outline_line(&o, (fw_geometry_vec2){in, first}, 0);
            fw_geometry_outline_line(&o, (fw_geometry_vec2){out, first}, 0);
            fw_geometry_outline_line(&o, (fw_geometry_vec2){out, last}, 0);
            if (!(end && right)) fw_geometry_outline_line(&o, (fw_geometry_vec2){in, last}, 0);
        }
    fw_layout_piece piece = {FW_ROLE_STRUCTURE, FW_GROUND, FW_NONE, "fill", {0}};
    FW_TRY(fw_geometry_outline_close(&o, &piece.contour));
    b->content->fill_area_m2 += fw_geometry_contour_area(&piece.contour);
    return add_piece(b, &piece);
}

static fw_status draw_fill(bench *b) {
    if (!b->fill) return FW_OK;
    double s = b->fill->value[FILL_SQUARE], stem = b->fill->value[FILL_STEM];
    double gap = fw_layout_to_grid(fw_layout_fill_gap_m(s, stem, b->fill->value[FILL_DENSITY]));
    if (!(gap >= b->options->space_rule_m) || stem < b->options->width_rule_m || stem >= s)
        return fw_diag_error(
            b->diags, 187, b->fill->place,
            "the fill with this density, square and stem has spaces or stems below the layer's own "
            "rule; choose a smaller density, larger squares or a wider stem");
    b->content->fill_density = (s * s + stem * gap) / ((s + gap) * (s + gap));
    for (int k = 0; k < b->nshelf; k++) {
        const shelf *level = &b->shelf[k];
        int count = (int)floor((level->height_m + 1e-12) / (s + gap));
        double from = b->start_m + level->used_m + (level->used_m > 0 ? b->keep_m : 0);
        int chains = (int)floor((b->end_m - from + gap) / (s + gap));
        for (int i = 0; i < chains && count > 0; i++)
            FW_TRY(add_chain(b, fw_layout_to_grid(from + i * (s + gap)), level->top_m, gap, count));
    }
    return FW_OK;
}

/* ---- frame and bars ---- */

static int from_right(const void *left, const void *right) {
    const fw_geometry_segment *p = left, *q = right;
    return fw_order_doubles(q->a.x, p->a.x);
}

/* feet at height y, from the right */
static fw_status feet_at(bench *b, double y, fw_geometry_segment **out, int *count) {
    size_t n = 0;
    *out = NULL;
    for (int pass = 0; pass < 2; pass++) {
        n = 0;
        for (int i = 0; i < b->layout->npiece; i++) {
            const fw_geometry_contour *c = &b->layout->piece[i].contour;
            for (int k = 0; k < c->count; k++) {
                const fw_geometry_segment *s = &c->segment[k];
                if (!(s->flags & FW_SEGMENT_JOINT) || s->a.y != y || s->b.y != y) continue;
                if (b->layout->piece[i].role == FW_ROLE_DICING || s->b.x <= s->a.x) continue;
                if (pass) (*out)[n] = *s;
                n++;
            }
        }
        if (!pass) FW_NEED(*out = fw_arena_array(b->arena, fw_geometry_segment, n));
    }
    if (n > 0) qsort(*out, n, sizeof **out, from_right);
    *count = (int)n;
    return FW_OK;
}

/* a bar between the uprights of the frame, with the feet on its upper edge */
static fw_status add_bar(bench *b, double low, double top, const char *label) {
    fw_geometry_segment *foot;
    int n;
    FW_TRY(feet_at(b, top, &foot, &n));
    fw_geometry_outline o =
        fw_geometry_outline_start(b->arena, (fw_geometry_vec2){b->window.x0, low});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){b->window.x1, low}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){b->window.x1, top}, FW_SEGMENT_JOINT);
    for (int i = 0; i < n; i++) {
        fw_geometry_outline_line(&o, foot[i].b, 0);
        fw_geometry_outline_line(&o, foot[i].a, FW_SEGMENT_JOINT);
    }
    fw_geometry_outline_line(&o, (fw_geometry_vec2){b->window.x0, top}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){b->window.x0, low}, FW_SEGMENT_JOINT);
    fw_layout_piece piece = {FW_ROLE_FRAME, FW_GROUND, FW_NONE, label, {0}};
    FW_TRY(fw_geometry_outline_close(&o, &piece.contour));
    return add_piece(b, &piece);
}

/* an upright of the frame: joints where bars meet it, from the lowest (their corners in y, from
   below) */
static fw_status add_upright(bench *b, const double *y, int n, bool right) {
    double x0 = right ? b->window.x1 : b->options->die.x0 + b->lane_m;
    double x1 = right ? b->options->die.x1 - b->lane_m : b->window.x0;
    double in = right ? x0 : x1, out = fw_layout_to_grid(right ? x1 : x0);
    fw_layout_piece piece = {FW_ROLE_FRAME,
                             FW_GROUND,
                             FW_NONE,
                             right ? "frame, right upright" : "frame, left upright",
                             {0}};
    fw_geometry_outline o =
        fw_geometry_outline_start(b->arena, (fw_geometry_vec2){in, right ? y[n - 1] : y[0]});
    for (int i = 1; i < n; i++) /* bars and openings take turns */
        fw_geometry_outline_line(&o, (fw_geometry_vec2){in, right ? y[n - 1 - i] : y[i]},
                                 i % 2 ? FW_SEGMENT_JOINT : 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){out, right ? y[0] : y[n - 1]}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){out, right ? y[n - 1] : y[0]}, 0);
    FW_TRY(fw_geometry_outline_close(&o, &piece.contour));
    return add_piece(b, &piece);
}

/* frame and bars around the feet */
static fw_status draw_bars(bench *b) {
    double y[2 * SHELVES + 2], low = fw_layout_to_grid(b->options->die.y0 + b->lane_m);
    double high = fw_layout_to_grid(b->options->die.y1 - b->lane_m);
    int n = 0;
    for (int k = 0; k < b->nshelf; k++) {
        const shelf *s = &b->shelf[k];
        double from = k ? s->low_m : low;
        FW_TRY(add_bar(b, from, s->top_m, k ? "bar of test patterns" : "frame, lowest bar"));
        y[n++] = from;
        y[n++] = s->top_m;
    }
    FW_TRY(add_bar(b, b->ceiling_m, high, "frame, highest bar"));
    y[n++] = b->ceiling_m;
    y[n++] = high;
    FW_TRY(add_upright(b, y, n, false));
    return add_upright(b, y, n, true);
}

/* ---- the whole ---- */

/* title and version below, bias and die above, crosses, brackets and the lane: as on a device. The
   bias is that of the patterns: nothing where all are as drawn */
static fw_status annotate(bench *b) {
    const fw_layout_content_options *o = b->options;
    bool any = false;
    for (int i = 0; i < b->content->ncoupon; i++)
        any = any || (b->content->coupon[i].placed && b->content->coupon[i].pattern->biased);
    fw_device_parameter bias = {.name = "BIAS", .value = any ? o->bias_m : 0, .unit = "um"};
    fw_device device = {.name = o->title,
                        .parameter = &bias,
                        .nparameter = 1,
                        .die = {.lane_m = b->lane_m, .title = o->title}};
    FW_TRY(fw_layout_annotate(b->arena, &device, b->window, o->die, NULL, &b->layout->piece,
                              &b->layout->npiece, &b->capacity));
    if (!o->die_id) return FW_OK;
    double stroke = STROKE_M, w = fw_layout_text_width(o->die_id, 9 * stroke, stroke);
    fw_geometry_vec2 at = {fw_layout_to_grid(b->window.x1 - w),
                           fw_layout_to_grid(b->window.y1 + 20e-6)};
    for (int i = 0; i < b->layout->npiece; i++) { /* where the other line leaves room */
        fw_geometry_box other = fw_geometry_contour_box(&b->layout->piece[i].contour);
        if (b->layout->piece[i].role == FW_ROLE_TEXT && other.y1 > at.y &&
            other.x1 > at.x - 6 * stroke)
            return FW_OK;
    }
    return fw_layout_text(b->arena, o->die_id, at, 9 * stroke, stroke, FW_ROLE_TEXT, "die id",
                          &b->layout->piece, &b->layout->npiece, &b->capacity);
}

static fw_status draw_all(bench *b, const fw_layout_pattern *pattern, int npattern) {
    fw_layout_content *content = b->content;
    for (int i = 0; i < npattern; i++) {
        if (pattern[i].kind->fills || pattern[i].kind->on_frame || pattern[i].kind->in_window)
            continue;
        fw_layout_coupon *c = &content->coupon[content->ncoupon++];
        fw_status status = fw_layout_pattern_draw(b->arena, &pattern[i], b->options->width_rule_m,
                                                  b->options->space_rule_m, b->options->bias_m, c);
        if (status == FW_GEOMETRY)
            fw_diag_error(b->diags, 187, pattern[i].place,
                          "the test pattern %s (%s) cannot be drawn: its sizes do not go together "
                          "or fall below the layer's own rule; change them in the layer table",
                          pattern[i].id, pattern[i].kind->name);
        FW_TRY(status);
    }
    return FW_OK;
}

fw_status fw_layout_content_build(fw_arena *arena, const fw_layout_pattern *pattern, int npattern,
                                  const fw_layout_content_options *options, fw_diags *diags,
                                  const fw_layout_content **content) {
    bench *b = fw_arena_one(arena, bench);
    fw_layout_content *c = fw_arena_one(arena, fw_layout_content);
    fw_layout *layout = fw_arena_one(arena, fw_layout);
    size_t n = (size_t)npattern;
    FW_NEED(b);
    FW_NEED(c);
    FW_NEED(layout);
    FW_NEED(c->coupon = fw_arena_array(arena, fw_layout_coupon, n));
    *b = (bench){.arena = arena, .diags = diags, .options = options, .content = c};
    b->layout = layout;
    FW_NEED(b->where = fw_arena_array(arena, int, n));
    FW_NEED(b->offset = fw_arena_array(arena, double, n));
    for (int i = 0; i < npattern; i++)
        if (pattern[i].kind->fills) b->fill = &pattern[i];
    if (!prepare(b)) {
        char w[32], h[32];
        fw_diag_error(diags, 188, (fw_place){options->file, 0, 0},
                      "a die of %s um x %s um has no room for test patterns inside its frame; make "
                      "the die larger or its frame narrower",
                      fw_layout_um(w, options->die.x1 - options->die.x0),
                      fw_layout_um(h, options->die.y1 - options->die.y0));
        return FW_GEOMETRY;
    }
    FW_TRY(draw_all(b, pattern, npattern));
    FW_TRY(pack_shelves(b));
    if (b->fill) add_empty_rows(b);
    if (b->nshelf == 0) b->shelf[b->nshelf++] = (shelf){0};
    set_levels(b);
    FW_TRY(place_patterns(b));
    FW_TRY(draw_fill(b));
    FW_TRY(draw_bars(b));
    FW_TRY(annotate(b));
    layout->drawn = true;
    layout->die = options->die;
    layout->window = b->window;
    layout->narrowest_gap_m = (double)INFINITY;
    c->layout = layout;
    *content = c;
    return FW_OK;
}
