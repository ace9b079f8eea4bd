/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the patterns go: rows from the bottom, first fit in the order of the table. */
#include "layout/content.h"
#include "layout/text.h"
#include <math.h>

const double FW_CONTENT_STROKE_M = 5e-6;
const double FW_CONTENT_BAND_M = 125e-6; /* 10, letters 45, 15, letters 45, 10 um */
enum { HIGH = 9 };
static const double APART_M = 20e-6; /* between two pieces of lettering */

static double width_of(const char *text) {
    return fw_layout_text_width(text, HIGH * FW_CONTENT_STROKE_M, FW_CONTENT_STROKE_M);
}

/* left end of a feature's lettering, or a negative number when there is no room behind `taken` */
static double label_at(const fw_feature *f, double taken) {
    double w = width_of(f->label), x = fmax(0.5 * (f->from.x + f->to.x - w), 0);
    return x < taken ? -1 : x;
}

double fw_content_slot_m(const fw_coupon *coupon) {
    double width = fmax(coupon->width_m, width_of(coupon->pattern->title)), taken = 0;
    for (int i = 0; i < coupon->nfeature; i++) {
        const fw_feature *f = &coupon->feature[i];
        double x = f->label ? label_at(f, taken) : -1;
        if (x < 0) continue;
        width = fmax(width, x + width_of(f->label));
        taken = x + width_of(f->label) + APART_M;
    }
    return fw_layout_to_grid(width);
}

/* what all rows take, were the one `k` at least `height` high */
static double total_height(const fw_bench *b, int k, double height) {
    double sum = 0;
    int n = k >= b->nshelf ? k + 1 : b->nshelf;
    for (int i = 0; i < n; i++) {
        double own = i < b->nshelf ? b->shelf[i].height_m : 0;
        sum += (i == k ? fmax(own, height) : own) + b->keep_m + (i ? FW_CONTENT_BAND_M : 0);
    }
    return sum;
}

static bool fits(const fw_bench *b, int k, double width, double height) {
    double used = k < b->nshelf ? b->shelf[k].used_m : 0, gap = used > 0 ? b->keep_m : 0;
    return b->start_m + used + gap + width <= b->end_m + 1e-12 &&
           total_height(b, k, height) <= b->ceiling_m - b->floor_m + 1e-12;
}

static void leave_out(fw_bench *b, const fw_coupon *c, double width) {
    char w[32], h[32], most[32];
    fw_diag_warning(b->diags, 186, c->pattern->place,
                    "the test pattern %s (%s um wide, %s um high with its lettering) finds no room "
                    "on the test die, whose rows are %s um long; it is left out: enlarge the die, "
                    "or move the row up in the table",
                    c->pattern->id, fw_number_text(w, sizeof w, width * 1e6, 6),
                    fw_number_text(h, sizeof h, (c->height_m + FW_CONTENT_BAND_M) * 1e6, 6),
                    fw_number_text(most, sizeof most, (b->end_m - b->start_m) * 1e6, 6));
}

fw_status fw_content_pack(fw_bench *b) {
    fw_content *content = b->content;
    for (int i = 0; i < content->ncoupon; i++) {
        fw_coupon *c = &content->coupon[i];
        double width = fw_content_slot_m(c);
        int k = 0;
        while (k < b->nshelf && !fits(b, k, width, c->height_m))
            k++;
        b->where[i] = -1;
        if (k == FW_SHELVES || !fits(b, k, width, c->height_m)) {
            leave_out(b, c, width);
            continue;
        }
        if (k == b->nshelf) b->shelf[b->nshelf++] = (fw_shelf){0};
        fw_shelf *s = &b->shelf[k];
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

static fw_vec2 moved(fw_vec2 p, fw_vec2 by) {
    return (fw_vec2){fw_layout_to_grid(p.x + by.x), fw_layout_to_grid(p.y + by.y)};
}

static void move_contour(fw_contour *c, fw_vec2 by) {
    for (int i = 0; i < c->count; i++) {
        fw_segment *s = &c->segment[i];
        s->a = moved(s->a, by);
        s->b = moved(s->b, by);
        if (s->kind == FW_ARC) s->centre = moved(s->centre, by);
    }
}

static fw_status add_biased(fw_bench *b, const fw_coupon *c, fw_piece *piece) {
    double bias = b->options->bias_m;
    fw_contour out;
    int i = -1, j = -1;
    if (!c->pattern->biased || bias == 0 || piece->role != FW_ROLE_STRUCTURE)
        return fw_content_add(b, piece);
    fw_status status = fw_contour_offset(b->arena, &piece->contour, bias, &out, &i, &j);
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
    return fw_content_add(b, piece);
}

static fw_status add_text(fw_bench *b, const char *text, double x, double y) {
    return fw_layout_text(b->arena, text, (fw_vec2){fw_layout_to_grid(x), fw_layout_to_grid(y)},
                          HIGH * FW_CONTENT_STROKE_M, FW_CONTENT_STROKE_M, FW_ROLE_TEXT,
                          "lettering of a test pattern", &b->layout->piece, &b->layout->npiece,
                          &b->capacity);
}

/* sizes below what they belong to, the name below them */
static fw_status add_lettering(fw_bench *b, const fw_coupon *c) {
    double high = HIGH * FW_CONTENT_STROKE_M, line = c->at.y - 10e-6 - high, taken = 0;
    for (int i = 0; i < c->nfeature; i++) {
        const fw_feature *f = &c->feature[i];
        double x = f->label ? label_at(f, taken) : -1;
        if (x < 0) continue;
        FW_TRY(add_text(b, f->label, c->at.x + x, line));
        taken = x + width_of(f->label) + APART_M;
    }
    return add_text(b, c->pattern->title, c->at.x, line - 15e-6 - high);
}

fw_status fw_content_place(fw_bench *b) {
    for (int i = 0; i < b->content->ncoupon; i++) {
        fw_coupon *c = &b->content->coupon[i];
        if (b->where[i] < 0) continue;
        c->at =
            moved((fw_vec2){b->start_m, b->shelf[b->where[i]].top_m}, (fw_vec2){b->offset[i], 0});
        for (int k = 0; k < c->npiece; k++) {
            move_contour(&c->piece[k].contour, c->at);
            FW_TRY(add_biased(b, c, &c->piece[k]));
        }
        FW_TRY(add_lettering(b, c));
    }
    return FW_OK;
}
