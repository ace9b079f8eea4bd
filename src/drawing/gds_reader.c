/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GDSII to closed outlines: BOUNDARY and BOX of one cell on one layer. Records of two bytes length,
   one byte kind, one byte type of data, big endian. Source: GDSII Stream Format Manual, Calma
   (1987), release 6.0. */
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

enum {
    NAME_MOST = 256,
};
#define FARTHEST_M 0.3

typedef fw_drawing_record record;

typedef struct element {
    int kind, layer, type, number;
    record xy;
} element;

typedef struct reader {
    fw_arena *arena;
    fw_diags *diags;
    const fw_drawing_asked *asked;
    const char *data;
    size_t n, at;
    record now;
    int number; /* of that record, from 1 */
    double dbu_m;
    int layer, type;        /* asked for, or the only ones; -1: none yet, any */
    char cell[NAME_MOST];   /* the one that is being read, */
    char chosen[NAME_MOST]; /* and the one that is taken */
    int cells;              /* met so far */
    bool in_cell, taken, found;
    int segments;
} reader;

/* a file of records has no lines: the message says which record */
static fw_place place_of(const reader *r) {
    return (fw_place){r->asked->file, 0, 0};
}

static fw_status damaged(const reader *r, const char *what) {
    return fw_diag_error(r->diags, 312, place_of(r),
                         "record %d: this is no GDSII file as it should be: %s; write it again",
                         r->number, what);
}

/* sign, exponent of 16 in excess 64, 56 bits of a fraction below 1 */
double fw_drawing_real8(const unsigned char *p) {
    double fraction = 0;
    for (int i = 7; i >= 1; i--)
        fraction = (fraction + p[i]) / 256;
    double value = ldexp(fraction, 4 * ((p[0] & 0x7f) - 64));
    return p[0] & 0x80 ? -value : value;
}

const char *fw_drawing_record_next(const char *data, size_t n, size_t *at, fw_drawing_record *out) {
    const unsigned char *p = (const unsigned char *)data + *at;
    out->offset = *at;
    if (n - *at < 4) return "it ends before ENDLIB";
    size_t length = fw_drawing_u16(p);
    if (length < 4 || length > n - *at) return "the length of a record does not fit";
    out->kind = p[2];
    out->data = p + 4;
    out->length = length - 4;
    *at += length;
    return NULL;
}

static fw_status next(reader *r) {
    r->number++;
    const char *wrong = fw_drawing_record_next(r->data, r->n, &r->at, &r->now);
    return wrong ? damaged(r, wrong) : FW_OK;
}

static fw_status read_units(reader *r) {
    if (r->now.length != 16) return damaged(r, "UNITS has not two numbers");
    r->dbu_m = fw_drawing_real8(r->now.data + 8);
    if (!(r->dbu_m > 1e-15 && r->dbu_m < 1))
        return damaged(r, "the database unit of UNITS is not between 1e-15 m and 1 m");
    return FW_OK;
}

static void name_of(const record *from, char name[NAME_MOST]) {
    size_t n = from->length < NAME_MOST ? from->length : NAME_MOST - 1;
    for (size_t i = 0; i < n; i++) {
        unsigned char c = from->data[i];
        name[i] = c >= ' ' && c < 127 ? (char)c : c ? '?' : '\0';
    }
    name[n] = '\0';
}

/* ---- elements ---- */

static bool is_layer(const reader *r, const element *e) {
    return (r->layer < 0 || e->layer == r->layer) && (r->type < 0 || e->type == r->type);
}

/* without a layer in the request all polygons must lie on one */
static fw_status settle_layer(reader *r, const element *e) {
    if (!r->asked->layer && r->layer >= 0 && (e->layer != r->layer || e->type != r->type))
        return fw_diag_error(r->diags, 314, r->asked->place,
                             "%s%s of %s has polygons on the layers %d/%d and %d/%d; say which "
                             "one with layer=\"...\"",
                             FW_NAMED("cell", r->cell), r->asked->file, r->layer, r->type, e->layer,
                             e->type);
    if (r->layer < 0) r->layer = e->layer, r->type = e->type;
    return FW_OK;
}

/* repeated points are one; the last repeats the first */
static fw_status add_polygon(reader *r, const element *e, fw_drawing *out) {
    size_t n = e->xy.length / 8;
    fw_drawing_piece *piece = fw_arena_array(r->arena, fw_drawing_piece, n + 1);
    FW_NEED(piece);
    if (e->xy.length % 8 != 0 || n < 4) return damaged(r, "a polygon has fewer than three corners");
    fw_geometry_vec2 start = {0, 0}, at = start;
    int count = 0;
    for (size_t i = 0; i <= n; i++) {
        const unsigned char *p = e->xy.data + 8 * (i % n);
        fw_geometry_vec2 to = {fw_drawing_i32(p) * r->dbu_m, fw_drawing_i32(p + 4) * r->dbu_m};
        if (fmax(fabs(to.x), fabs(to.y)) > FARTHEST_M)
            return fw_diag_error(r->diags, 313, place_of(r),
                                 "record %d: it lies farther than 300 mm from the origin, wider "
                                 "than any wafer; correct the unit or the drawing",
                                 e->number);
        if (i == 0)
            start = to;
        else if (!vec_same(to, at))
            piece[count++] = (fw_drawing_piece){to, 0};
        at = to;
    }
    r->segments += count;
    if (r->segments > FW_DRAWING_SEGMENTS_MOST || out->count == FW_DRAWING_OUTLINES_MOST)
        return fw_diag_error(
            r->diags, 319, place_of(r),
            "record %d: more than %d polygons or %d edges are taken from one file; "
            "use several layers or cells",
            e->number, (int)FW_DRAWING_OUTLINES_MOST, (int)FW_DRAWING_SEGMENTS_MOST);
    FW_NEED(out->outline = fw_arena_grow(r->arena, out->outline, (size_t)out->count,
                                         (size_t)out->count + 1, sizeof *out->outline));
    fw_drawing_outline *o = &out->outline[out->count];
    fw_drawing_flaw flaw;
    fw_status status = fw_drawing_trace(r->arena, start, piece, count, &o->contour, &flaw);
    if (status == FW_GEOMETRY) {
        const char *what = fw_drawing_flaw_text(r->arena, &flaw);
        FW_NEED(what);
        return fw_diag_error(r->diags, 315, place_of(r),
                             "record %d: the polygon %s; repair it, and draw what is cut out of it "
                             "on a layer of its own, for an outline with hole=\"yes\"",
                             e->number, what);
    }
    FW_TRY(status);
    o->line = e->number;
    out->count++;
    return FW_OK;
}

static fw_status take_element(reader *r, const element *e, fw_drawing *out) {
    bool area = e->kind == FW_DRAWING_BOUNDARY || e->kind == FW_DRAWING_BOX;
    if (e->kind == FW_DRAWING_TEXT || !r->taken) return FW_OK;
    if (e->kind == FW_DRAWING_SREF || e->kind == FW_DRAWING_AREF)
        return fw_diag_error(r->diags, 315, place_of(r),
                             "record %d: %s%s holds other cells, which are not read; flatten it",
                             e->number, FW_NAMED("cell", r->cell));
    if (!is_layer(r, e) && (!area || r->asked->layer)) return FW_OK;
    if (!area)
        return fw_diag_error(
            r->diags, 315, place_of(r),
            "record %d: a path on layer %d/%d is not read; convert it to a polygon", e->number,
            e->layer, e->type);
    FW_TRY(settle_layer(r, e));
    return add_polygon(r, e, out);
}

static fw_status read_element(reader *r, fw_drawing *out) {
    element e = {.kind = r->now.kind, .layer = -1, .type = -1, .number = r->number};
    for (;;) {
        FW_TRY(next(r));
        const record *now = &r->now;
        if (now->kind == FW_DRAWING_ENDEL) break;
        if (now->kind == FW_DRAWING_LAYER && now->length == 2)
            e.layer = (int)fw_drawing_u16(now->data);
        else if ((now->kind == FW_DRAWING_DATATYPE || now->kind == FW_DRAWING_BOXTYPE) &&
                 now->length == 2)
            e.type = (int)fw_drawing_u16(now->data);
        else if (now->kind == FW_DRAWING_XY)
            e.xy = *now;
        else if (now->kind == FW_DRAWING_ENDSTR || now->kind == FW_DRAWING_ENDLIB ||
                 now->kind == FW_DRAWING_BGNSTR)
            return damaged(r, "an element does not end");
    }
    return take_element(r, &e, out);
}

/* ---- cells ---- */

static fw_status begin_cell(reader *r) {
    name_of(&r->now, r->cell);
    r->taken = !r->asked->cell || strcmp(r->asked->cell, r->cell) == 0;
    if (!r->asked->cell && ++r->cells > 1)
        return fw_diag_error(r->diags, 314, r->asked->place,
                             "%s has the cells %s and %s, perhaps more; say which one with "
                             "cell=\"...\"",
                             r->asked->file, r->chosen, r->cell);
    if (!r->taken) return FW_OK;
    r->found = true;
    memcpy(r->chosen, r->cell, sizeof r->chosen);
    return FW_OK;
}

/* "3" or "3/0" */
static fw_status read_layer(reader *r) {
    const char *text = r->asked->layer;
    double layer = -1, type = -1;
    r->layer = r->type = -1;
    if (!text) return FW_OK;
    size_t n = strcspn(text, "/");
    bool good = fw_number_parse(text, n, &layer) &&
                (text[n] == '\0' || fw_number_parse(text + n + 1, strlen(text + n + 1), &type));
    good = good && layer == floor(layer) && layer >= 0 && layer <= 65535 && type == floor(type) &&
           type >= -1 && type <= 65535;
    if (!good)
        return fw_diag_error(r->diags, 314, r->asked->layer_place,
                             "layer \"%.64s\": a layer of a GDSII file is a number, or "
                             "NUMBER/DATATYPE, as in \"3\" or \"3/0\"",
                             text);
    r->layer = (int)layer;
    r->type = (int)type;
    return FW_OK;
}

static fw_status nothing_there(const reader *r) {
    const fw_drawing_asked *asked = r->asked;
    if (asked->cell && !r->found)
        return fw_diag_error(r->diags, 314, asked->cell_place, "%s has no cell '%.64s'",
                             asked->file, asked->cell);
    return fw_diag_error(r->diags, 314, asked->layer ? asked->layer_place : asked->place,
                         "%s has no polygon in %s%s%s%s", asked->file, FW_NAMED("cell", r->chosen),
                         asked->layer ? " on layer " : "", asked->layer ? asked->layer : "");
}

fw_status fw_drawing_read_gds(fw_arena *arena, const char *data, size_t n,
                              const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out) {
    reader r = {.arena = arena, .diags = diags, .asked = asked, .data = data, .n = n};
    *out = (fw_drawing){0};
    if (asked->unit)
        return fw_diag_error(diags, 313, asked->unit_place,
                             "a GDSII file states its own unit; remove unit");
    FW_TRY(read_layer(&r));
    do {
        FW_TRY(next(&r));
        switch (r.now.kind) {
        case FW_DRAWING_UNITS:
            FW_TRY(read_units(&r));
            break;
        case FW_DRAWING_BGNSTR:
            r.in_cell = true, r.taken = false;
            break;
        case FW_DRAWING_ENDSTR:
            r.in_cell = false;
            break;
        case FW_DRAWING_STRNAME:
            if (r.in_cell) FW_TRY(begin_cell(&r));
            break;
        case FW_DRAWING_BOUNDARY:
        case FW_DRAWING_BOX:
        case FW_DRAWING_PATH:
        case FW_DRAWING_SREF:
        case FW_DRAWING_AREF:
        case FW_DRAWING_TEXT:
            if (!(r.dbu_m > 0)) return damaged(&r, "there is no UNITS before the first cell");
            FW_TRY(read_element(&r, out));
            break;
        }
    } while (r.now.kind != FW_DRAWING_ENDLIB);
    return out->count > 0 ? FW_OK : nothing_there(&r);
}

/* ---- which format ---- */

fw_status fw_drawing_read(fw_arena *arena, const char *data, size_t n,
                          const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out) {
    static const char binary[] = "AutoCAD Binary DXF";
    bool gds = n >= 4 && data[0] == 0 && (data[1] == 4 || data[1] == 6) && data[2] == 0;
    if (n >= sizeof binary - 1 && memcmp(data, binary, sizeof binary - 1) == 0)
        return fw_diag_error(diags, 312, (fw_place){asked->file, 1, 1},
                             "this is a binary DXF file; save it as ASCII DXF");
    if (gds) return fw_drawing_read_gds(arena, data, n, asked, diags, out);
    if (asked->cell)
        return fw_diag_error(diags, 314, asked->cell_place,
                             "cell is of GDSII files, and %s is none; remove it", asked->file);
    return fw_drawing_read_dxf(arena, data, n, asked, diags, out);
}
