/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From what a DXF file says to closed outlines: its names in UTF-8, its unit, its edges, chains of lines and arcs, and which of
   the closed lines are holes in others. */
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include <ctype.h>
#include <iconv.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define FARTHEST_M 0.3 /* wafers are at most 300 mm wide */

typedef fw_drawing_edge edge;
typedef fw_drawing_run closed;
typedef fw_drawing_dxf reader;

/* ---- names ---- */

/* a character of the drawing's code page, "ANSI_1252" or what $DWGCODEPAGE has; false: not known here */
static bool in_code_page(const char *page, const char *byte, fw_text *out) {
    char from[16], to[8], *in = (char *)(uintptr_t)byte, *end = to;
    size_t left = 1, room = sizeof to;
    snprintf(from, sizeof from, "CP%.12s",
             page && strncmp(page, "ANSI_", 5) == 0 ? page + 5 : "1252");
    iconv_t way = iconv_open("UTF-8", from);
    if (way == (iconv_t)-1) return false;
    bool good = iconv(way, &in, &left, &end, &room) != (size_t)-1;
    iconv_close(way);
    if (good) fw_text_bytes(out, to, (size_t)(end - to));
    return good;
}

static int hex_of(const char *four) {
    int value = 0;
    for (int i = 0; i < 4; i++) {
        const char *at = strchr("0123456789abcdef", tolower((unsigned char)four[i]));
        if (!at || four[i] == '\0') return 0;
        value = 16 * value + (int)(at - "0123456789abcdef");
    }
    return value;
}

static void add_utf8(fw_text *out, unsigned c) {
    unsigned char bytes[3] = {(unsigned char)(0xe0 | c >> 12),
                              (unsigned char)(0x80 | (c >> 6 & 63)),
                              (unsigned char)(0x80 | (c & 63))};
    if (c < 0x80)
        fw_text_bytes(out, &(unsigned char){(unsigned char)c}, 1);
    else if (c < 0x800)
        fw_text_bytes(out, (unsigned char[]){(unsigned char)(0xc0 | c >> 6), bytes[2]}, 2);
    else
        fw_text_bytes(out, bytes, 3);
}

const char *fw_drawing_dxf_name(const fw_drawing_dxf *dxf, const char *value, size_t n) {
    fw_text out = fw_text_new(dxf->arena);
    const char *text = fw_arena_strndup(dxf->arena, value, n);
    if (!text) return NULL;
    fw_text_add(&out, "");
    while (*text) {
        unsigned code = 0;
        int escaped = strlen(text) >= 7 && memcmp(text, "\\U+", 3) == 0 ? hex_of(text + 3) : 0;
        size_t bytes = fw_text_utf8(text, &code);
        if (escaped > 0 && (escaped < 0xd800 || escaped > 0xdfff)) {
            add_utf8(&out, (unsigned)escaped);
            text += 7;
        } else if (bytes > 0 || !in_code_page(dxf->code_page, text, &out)) {
            fw_text_bytes(&out, text, bytes > 0 ? bytes : 1);
            text += bytes > 0 ? bytes : 1;
        } else
            text++;
    }
    return fw_text_end(&out) == FW_OK ? out.data : NULL;
}

/* ---- edges ---- */

/* a mask's drawing may have more than a body's outline */
int fw_drawing_dxf_most(const fw_drawing_dxf *dxf) {
    return dxf->asked->segments_most ? dxf->asked->segments_most : FW_DRAWING_SEGMENTS_MOST;
}

fw_status fw_drawing_dxf_edge(fw_drawing_dxf *r, fw_geometry_vec2 a, fw_geometry_vec2 b,
                              double sweep_rad, int line) {
    const int most = fw_drawing_dxf_most(r);
    if (r->nedge == most) {
        fw_diag_error(r->diags, 319, fw_drawing_dxf_place(r, line),
                      "more than %d lines and arcs are taken from one file; draw fewer points, or "
                      "use several layers",
                      most);
        r->failed = true;
        return FW_OK;
    }
    if (r->nedge == r->edge_room) {
        int more = r->edge_room ? 2 * r->edge_room : 64;
        FW_NEED(r->edge = fw_arena_grow(r->arena, r->edge, (size_t)r->nedge, (size_t)more,
                                        sizeof *r->edge));
        r->edge_room = more;
    }
    bool mirrored = r->frame.xx * r->frame.yy < r->frame.xy * r->frame.yx;
    r->edge[r->nedge++] = (edge){fw_drawing_placed(&r->frame, a), fw_drawing_placed(&r->frame, b),
                                 mirrored ? -sweep_rad : sweep_rad, line, false};
    return FW_OK;
}

fw_status fw_drawing_dxf_close(fw_drawing_dxf *r, int first, int line) {
    if (r->failed || r->nedge == first) return FW_OK;
    if (r->nclosed == r->closed_room) {
        int more = r->closed_room ? 2 * r->closed_room : 16;
        FW_NEED(r->closed = fw_arena_grow(r->arena, r->closed, (size_t)r->nclosed, (size_t)more,
                                          sizeof *r->closed));
        r->closed_room = more;
    }
    for (int i = first; i < r->nedge; i++)
        r->edge[i].used = true;
    r->closed[r->nclosed++] = (closed){first, r->nedge - first, line};
    return FW_OK;
}

/* ---- units ---- */

static const struct {
    int code;
    double metres;
    const char *name;
} units[] = {{1, 25.4e-3, "inches"},
             {2, 0.3048, "feet"},
             {4, 1e-3, "mm"},
             {5, 1e-2, "cm"},
             {6, 1, "m"},
             {8, 25.4e-9, "microinches"},
             {9, 25.4e-6, "mils"},
             {11, 1e-10, "Angstrom"},
             {12, 1e-9, "nm"},
             {13, 1e-6, "um"},
             {14, 0.1, "dm"}};

/* NaN: reported */
static double unit_of(reader *r) {
    const fw_drawing_asked *asked = r->asked;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (units[i].code != r->insunits) continue;
        if (!asked->unit || fabs(asked->unit_m - units[i].metres) < 1e-9 * units[i].metres)
            return units[i].metres;
        fw_diag_error(r->diags, 313, asked->unit_place,
                      "unit=\"%s\", but %s says that it is drawn in %s ($INSUNITS %d); leave unit "
                      "out, or correct the drawing",
                      asked->unit, asked->file, units[i].name, r->insunits);
        return (double)NAN;
    }
    if (asked->unit) return asked->unit_m;
    fw_diag_error(r->diags, 313, asked->place,
                  "%s does not say what its unit is (no $INSUNITS that is known); add "
                  "unit=\"um\" or whatever it is drawn in",
                  asked->file);
    return (double)NAN;
}

/* ---- outlines ---- */

static fw_geometry_vec2 scaled(fw_geometry_vec2 p, double by) {
    return (fw_geometry_vec2){p.x * by, p.y * by};
}

static bool scale_edges(reader *r, double unit_m) {
    for (int i = 0; i < r->nedge; i++) {
        edge *e = &r->edge[i];
        e->a = scaled(e->a, unit_m);
        e->b = scaled(e->b, unit_m);
        double most = fmax(fmax(fabs(e->a.x), fabs(e->a.y)), fmax(fabs(e->b.x), fabs(e->b.y)));
        if (most <= FARTHEST_M) continue;
        fw_diag_error(r->diags, 313, fw_drawing_dxf_place(r, e->line),
                      "it lies farther than 300 mm from the origin, wider than any wafer; correct "
                      "the unit or the drawing");
        return false;
    }
    return true;
}

/* the pieces of one outline to *out; FW_INPUT: reported */
static fw_status trace(reader *r, const fw_drawing_piece *piece, int n, fw_geometry_vec2 start,
                       int line, fw_drawing *out) {
    fw_drawing_flaw flaw;
    const int most = r->asked->outlines_most ? r->asked->outlines_most : FW_DRAWING_OUTLINES_MOST;
    if (out->count == most)
        return fw_diag_error(r->diags, 319, fw_drawing_dxf_place(r, line),
                             "more than %d outlines are taken from one file", most);
    fw_drawing_outline *o = &out->outline[out->count];
    fw_status status = fw_drawing_trace(r->arena, start, piece, n, &o->contour, &flaw);
    if (status == FW_GEOMETRY) {
        const char *what = fw_drawing_flaw_text(r->arena, &flaw);
        FW_NEED(what);
        return fw_diag_error(r->diags, 315, fw_drawing_dxf_place(r, line),
                             "the closed line that begins here %s; repair the drawing", what);
    }
    FW_TRY(status);
    o->line = line;
    out->count++;
    return FW_OK;
}

/* the next edge, used or not, from where a chain ends; -1: none, -2: several */
static int next_in_chain(const reader *r, fw_geometry_vec2 at, bool *backwards) {
    int found = -1;
    for (int i = 0; i < r->nedge; i++) {
        if (r->edge[i].used) continue;
        bool forth = vec_distance(r->edge[i].a, at) <= FW_DRAWING_SAME_M;
        bool back = vec_distance(r->edge[i].b, at) <= FW_DRAWING_SAME_M;
        if (!forth && !back) continue;
        if (found >= 0) return -2;
        found = i;
        *backwards = !forth;
    }
    return found;
}

static fw_status say_open(reader *r, int line, fw_geometry_vec2 at, bool several) {
    char x[32], y[32];
    return fw_diag_error(r->diags, 315, fw_drawing_dxf_place(r, line),
                         "the chain of lines and arcs that begins here %s at (%s, %s) um, ends "
                         "being joined that lie within 1 nm; close the line in the drawing",
                         several ? "meets more than one other" : "ends",
                         fw_number_text(x, sizeof x, at.x * 1e6, 8),
                         fw_number_text(y, sizeof y, at.y * 1e6, 8));
}

static fw_status put_together(reader *r, fw_drawing_piece *piece, fw_drawing *out) {
    for (int i = 0; i < r->nedge; i++) {
        edge *first = &r->edge[i];
        if (first->used) continue;
        int n = 0;
        fw_geometry_vec2 at = first->b;
        first->used = true;
        piece[n++] = (fw_drawing_piece){at, first->sweep_rad};
        while (vec_distance(at, first->a) > FW_DRAWING_SAME_M) {
            bool backwards = false;
            int k = next_in_chain(r, at, &backwards);
            if (k < 0) return say_open(r, first->line, at, k == -2);
            edge *e = &r->edge[k];
            e->used = true;
            at = backwards ? e->a : e->b;
            piece[n++] = (fw_drawing_piece){at, backwards ? -e->sweep_rad : e->sweep_rad};
        }
        FW_TRY(trace(r, piece, n, first->a, first->line, out));
    }
    return FW_OK;
}

/* An outline within another is a hole; one within a hole would be an island that nothing holds.
   Those that cross are one part each. */
static fw_status find_holes(reader *r, fw_drawing *d) {
    for (int i = 0; i < d->count; i++) {
        int around = 0;
        const fw_geometry_contour *own = &d->outline[i].contour;
        fw_geometry_box box = fw_geometry_contour_box(own);
        for (int k = 0; k < d->count; k++) {
            const fw_geometry_contour *other = &d->outline[k].contour;
            fw_geometry_box wide = fw_geometry_contour_box(other);
            if (k == i || box.x0 < wide.x0 || box.x1 > wide.x1 || box.y0 < wide.y0 ||
                box.y1 > wide.y1)
                continue;
            around += fw_geometry_contour_contains(other, own->segment[0].a) &&
                      fw_geometry_contour_distance_below(own, other, 1e-9, NULL, NULL) > 0;
        }
        if (around > 1)
            return fw_diag_error(r->diags, 315, fw_drawing_dxf_place(r, d->outline[i].line),
                                 "the closed line that begins here lies within a hole, an island "
                                 "that nothing holds; remove it, or put it on another layer");
        d->outline[i].hole = around == 1;
    }
    return FW_OK;
}

fw_status fw_drawing_dxf_note_other(fw_drawing_dxf *r, const char *layer) {
    const size_t most = sizeof r->other / sizeof *r->other;
    for (size_t i = 0; i < r->nother && i < most; i++)
        if (strcmp(r->other[i], layer) == 0) return FW_OK;
    if (r->nother < most) FW_NEED(r->other[r->nother] = fw_arena_strdup(r->arena, layer));
    r->nother += r->nother <= most;
    return FW_OK;
}

/* with the layers on which something lies, where one was asked for */
static fw_status say_nothing(reader *r) {
    const char *layer = r->asked->layer;
    const size_t most = sizeof r->other / sizeof *r->other;
    fw_text others = fw_text_new(r->arena);
    fw_text_add(&others, "");
    for (size_t i = 0; i < r->nother && i < most; i++)
        fw_text_printf(&others, "%s'%.64s'", i == 0 ? "; something lies on " : ", ", r->other[i]);
    if (r->nother > most) fw_text_add(&others, " and others");
    FW_TRY(fw_text_end(&others));
    return fw_diag_error(r->diags, 314, layer ? r->asked->layer_place : r->asked->place,
                         "%s has no closed line%s%s%s%s; draw one as a polyline, or as lines and "
                         "arcs that meet",
                         r->asked->file, layer ? " on layer '" : "", layer ? layer : "",
                         layer ? "'" : "", others.data);
}

static fw_status make_outlines(reader *r, fw_drawing *out) {
    size_t room = (size_t)r->nclosed + (size_t)r->nedge;
    fw_drawing_piece *piece;
    FW_NEED(out->outline = fw_arena_array(r->arena, fw_drawing_outline, room));
    FW_NEED(piece = fw_arena_array(r->arena, fw_drawing_piece, (size_t)r->nedge));
    for (int i = 0; i < r->nclosed; i++) {
        const closed *c = &r->closed[i];
        for (int k = 0; k < c->count; k++)
            piece[k] = (fw_drawing_piece){r->edge[c->first + k].b, r->edge[c->first + k].sweep_rad};
        FW_TRY(trace(r, piece, c->count, r->edge[c->first].a, c->line, out));
    }
    FW_TRY(put_together(r, piece, out));
    return out->count == 0 ? say_nothing(r) : find_holes(r, out);
}

fw_status fw_drawing_dxf_outlines(fw_drawing_dxf *dxf, fw_drawing *out) {
    double unit_m = unit_of(dxf);
    if (isnan(unit_m) || !scale_edges(dxf, unit_m)) return FW_INPUT;
    return make_outlines(dxf, out);
}
