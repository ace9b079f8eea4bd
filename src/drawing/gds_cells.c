/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A cell of a GDSII file with all that it refers to, as polygons: boundaries, boxes and paths through every SREF and
   AREF, in two passes over the bytes. The first checks the order of all records and lists the cells; the second
   follows the references. Source: GDSII Stream Format Manual, Calma (1987), release 6.0. */
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    NAME_MOST = 255,
    LISTED = 160 /* bytes of a list of names in a message */
};
enum { MIRRORED = 0x8000, ABSOLUTE = 0x0006 };
static const double ROUND_NM = 5; /* of a round end, between a chord and its arc */

typedef struct cell {
    const char *name;
    size_t begin; /* of the record behind STRNAME */
    bool open;    /* it is being followed */
    bool below;   /* another one refers to it */
} cell;

/* p -> (xx x + xy y + x, yx x + yy y + y), nm of what the database counts */
typedef struct frame {
    double xx, xy, yx, yy, x, y, scale;
} frame;

typedef struct element {
    int kind, layer, type, ends, columns, rows;
    double width, begin, end, scale, angle_deg;
    unsigned transform;
    size_t offset;
    fw_drawing_record name, xy; /* data NULL: none */
} element;

typedef struct library {
    fw_drawing_flat *flat;
    const char *data;
    size_t n;
    double unit_nm;
    cell *cell; /* (ncell), by name */
    int ncell, room;
    long work; /* elements looked at */
} library;

static fw_status damaged(const library *l, size_t offset, const char *what) {
    const fw_drawing_cell_asked *a = l->flat->asked;
    return fw_diag_error(l->flat->diags, 565, a->place,
                         "%s, byte %zu: this is no GDSII file as it should be: %s; write it again",
                         a->file, offset, what);
}

/* ---- first pass: the order of records, and the cells ---- */

/* without what no name should hold, which a message could not show */
static const char *name_of(const fw_drawing_record *r, char name[NAME_MOST + 1]) {
    size_t n = r->length < NAME_MOST ? r->length : NAME_MOST;
    for (size_t i = 0; i < n; i++) {
        char c = (char)r->data[i];
        name[i] = c == '\0' || (c >= ' ' && c <= '~') ? c : '?';
    }
    name[n] = '\0';
    return name;
}

static fw_status add_cell(library *l, const fw_drawing_record *r, size_t begin) {
    if (l->ncell == l->room) {
        int more = l->room ? 2 * l->room : 64;
        FW_NEED(l->cell = fw_arena_grow(l->flat->arena, l->cell, (size_t)l->ncell, (size_t)more,
                                        sizeof *l->cell));
        l->room = more;
    }
    cell *c = &l->cell[l->ncell++];
    *c = (cell){.begin = begin};
    char name[NAME_MOST + 1];
    FW_NEED(c->name = fw_arena_strdup(l->flat->arena, name_of(r, name)));
    return *c->name ? FW_OK : damaged(l, r->offset, "a cell has no name");
}

static fw_status read_units(library *l, const fw_drawing_record *r) {
    if (r->length != 16) return damaged(l, r->offset, "UNITS has not two numbers");
    double unit_m = fw_drawing_real8(r->data + 8);
    if (!(unit_m > 1e-15 && unit_m < 1))
        return damaged(l, r->offset, "the database unit of UNITS is not between 1e-15 m and 1 m");
    double nm = unit_m * 1e9;
    l->unit_nm = fabs(nm - round(nm)) < 1e-9 * nm ? round(nm) : nm;
    return FW_OK;
}

static bool begins_element(int kind) {
    return kind == FW_DRAWING_BOUNDARY || kind == FW_DRAWING_PATH || kind == FW_DRAWING_SREF ||
           kind == FW_DRAWING_AREF || kind == FW_DRAWING_TEXT || kind == FW_DRAWING_NODE ||
           kind == FW_DRAWING_BOX;
}

/* of one record, in what it may stand: 0 the library, 1 a cell without its name yet, 2 a cell, 3 an element */
static fw_status take_record(library *l, const fw_drawing_record *r, size_t behind, int *within) {
    bool outer = r->kind == FW_DRAWING_BGNSTR || r->kind == FW_DRAWING_ENDSTR ||
                 r->kind == FW_DRAWING_STRNAME || r->kind == FW_DRAWING_ENDLIB;
    bool wrong =
        (*within == 0 && (r->kind == FW_DRAWING_ENDSTR || r->kind == FW_DRAWING_STRNAME)) ||
        (*within == 1 && r->kind != FW_DRAWING_STRNAME) ||
        (*within == 2 && (r->kind == FW_DRAWING_BGNSTR || r->kind == FW_DRAWING_ENDLIB)) ||
        (*within == 3 && (outer || begins_element(r->kind))) ||
        (*within != 3 && r->kind == FW_DRAWING_ENDEL) || (*within != 2 && begins_element(r->kind));
    if (wrong) return damaged(l, r->offset, "a record stands where it does not belong");
    if (r->kind == FW_DRAWING_BGNSTR) {
        *within = 1;
        if (!(l->unit_nm > 0)) return damaged(l, r->offset, "there is no UNITS before a cell");
    } else if (r->kind == FW_DRAWING_STRNAME && *within == 1) {
        *within = 2;
        return add_cell(l, r, behind);
    } else if (r->kind == FW_DRAWING_ENDSTR)
        *within = 0;
    else if (begins_element(r->kind))
        *within = 3;
    else if (r->kind == FW_DRAWING_ENDEL)
        *within = 2;
    else if (r->kind == FW_DRAWING_UNITS && *within == 0)
        return read_units(l, r);
    return FW_OK;
}

static int by_name(const void *p, const void *q) {
    return strcmp(((const cell *)p)->name, ((const cell *)q)->name);
}

static cell *find(const library *l, const char *name) {
    const cell key = {.name = name};
    if (l->ncell == 0) return NULL;
    return bsearch(&key, l->cell, (size_t)l->ncell, sizeof key, by_name);
}

/* the record at *at, which the first pass has seen */
static fw_drawing_record again(const library *l, size_t *at) {
    fw_drawing_record r = {0};
    fw_drawing_record_next(l->data, l->n, at, &r);
    return r;
}

static fw_status list_cells(library *l) {
    size_t at = 0;
    int within = 0;
    fw_drawing_record r;
    do {
        const char *wrong = fw_drawing_record_next(l->data, l->n, &at, &r);
        if (wrong) return damaged(l, r.offset, wrong);
        FW_TRY(take_record(l, &r, at, &within));
    } while (r.kind != FW_DRAWING_ENDLIB);
    if (l->ncell > 0) qsort(l->cell, (size_t)l->ncell, sizeof *l->cell, by_name);
    for (int i = 1; i < l->ncell; i++)
        if (by_name(&l->cell[i - 1], &l->cell[i]) == 0)
            return fw_diag_error(
                l->flat->diags, 565, l->flat->asked->place,
                "%s has two cells '%.64s', and readers differ in which one they take; rename one",
                l->flat->asked->file, l->cell[i].name);
    for (at = 0, r.kind = 0; r.kind != FW_DRAWING_ENDLIB;) {
        r = again(l, &at);
        if (r.kind != FW_DRAWING_SNAME) continue;
        char name[NAME_MOST + 1];
        cell *c = find(l, name_of(&r, name));
        if (c) c->below = true;
    }
    return FW_OK;
}

/* names of cells for a message; only those that nothing refers to, where there are such */
static const char *names_of(const library *l, bool tops, int *count) {
    fw_text names = fw_text_new(l->flat->arena);
    bool more = false;
    *count = 0;
    for (int i = 0; i < l->ncell; i++) {
        if (tops && l->cell[i].below) continue;
        more = names.length > LISTED;
        if (!more) fw_text_printf(&names, "%s%.64s", *count ? ", " : "", l->cell[i].name);
        ++*count;
    }
    if (more) fw_text_add(&names, ", ...");
    return names.failed ? NULL : names.length ? names.data : "";
}

static fw_status choose_cell(library *l, cell **chosen) {
    const fw_drawing_cell_asked *a = l->flat->asked;
    int tops, all;
    const char *top = names_of(l, true, &tops), *every = names_of(l, false, &all);
    FW_NEED(top && every ? top : NULL);
    *chosen = NULL;
    if (a->cell) {
        *chosen = find(l, a->cell);
        if (*chosen) return FW_OK;
        return fw_diag_error(l->flat->diags, 568, a->cell_place,
                             "%s has no cell '%.64s'; it has %s", a->file, a->cell,
                             all ? every : "none");
    }
    for (int i = 0; i < l->ncell && tops == 1; i++)
        if (!l->cell[i].below) *chosen = &l->cell[i];
    if (*chosen) return FW_OK;
    if (l->ncell > 0 && tops == 0)
        return fw_diag_error(l->flat->diags, 566, a->place,
                             "%s: every cell is held by another one, in a circle; say which one is "
                             "meant with cell=\"...\", of %s",
                             a->file, every);
    if (tops == 0) return fw_diag_error(l->flat->diags, 568, a->place, "%s has no cell", a->file);
    return fw_diag_error(l->flat->diags, 568, a->place,
                         "%s has %d top cells (%s); say which one with cell=\"...\"", a->file, tops,
                         top);
}

/* ---- second pass: elements through their references ---- */

static double cosine(double deg) {
    double quarter = deg / 90;
    if (fabs(quarter - round(quarter)) > 1e-12) return cos(deg * FW_PI / 180);
    long long q = llround(quarter) % 4;
    return q == 0 ? 1 : q == 2 || q == -2 ? -1 : 0;
}

/* mirrored about x, larger by scale, turned, moved */
static frame frame_of(bool mirrored, double scale, double angle_deg, double x, double y) {
    double c = scale * cosine(angle_deg), s = scale * cosine(angle_deg - 90), m = mirrored ? -1 : 1;
    return (frame){c, -m * s, s, m * c, x, y, scale};
}

static fw_geometry_vec2 placed(const frame *f, double x, double y) {
    return (fw_geometry_vec2){f->xx * x + f->xy * y + f->x, f->yx * x + f->yy * y + f->y};
}

static frame within_frame(const frame *f, const frame *g) {
    fw_geometry_vec2 o = placed(f, g->x, g->y);
    return (frame){f->xx * g->xx + f->xy * g->yx,
                   f->xx * g->xy + f->xy * g->yy,
                   f->yx * g->xx + f->yy * g->yx,
                   f->yx * g->xy + f->yy * g->yy,
                   o.x,
                   o.y,
                   f->scale * g->scale};
}

/* one record of an element */
static fw_status take_part(library *l, const fw_drawing_record *r, element *e) {
    static const struct {
        int kind;
        size_t length;
    } needs[] = {{FW_DRAWING_LAYER, 2},    {FW_DRAWING_DATATYPE, 2}, {FW_DRAWING_BOXTYPE, 2},
                 {FW_DRAWING_PATHTYPE, 2}, {FW_DRAWING_WIDTH, 4},    {FW_DRAWING_BGNEXTN, 4},
                 {FW_DRAWING_ENDEXTN, 4},  {FW_DRAWING_COLROW, 4},   {FW_DRAWING_STRANS, 2},
                 {FW_DRAWING_MAG, 8},      {FW_DRAWING_ANGLE, 8}};
    for (size_t i = 0; i < sizeof needs / sizeof needs[0]; i++)
        if (r->kind == needs[i].kind && r->length != needs[i].length)
            return damaged(l, r->offset, "a record has not the length of its kind");
    switch (r->kind) {
    case FW_DRAWING_LAYER:
        e->layer = (int)fw_drawing_u16(r->data);
        break;
    case FW_DRAWING_DATATYPE:
    case FW_DRAWING_BOXTYPE:
        e->type = (int)fw_drawing_u16(r->data);
        break;
    case FW_DRAWING_PATHTYPE:
        e->ends = (int)fw_drawing_u16(r->data);
        break;
    case FW_DRAWING_WIDTH:
        e->width = fw_drawing_i32(r->data);
        break;
    case FW_DRAWING_BGNEXTN:
        e->begin = fw_drawing_i32(r->data);
        break;
    case FW_DRAWING_ENDEXTN:
        e->end = fw_drawing_i32(r->data);
        break;
    case FW_DRAWING_COLROW:
        e->columns = (int)fw_drawing_u16(r->data);
        e->rows = (int)fw_drawing_u16(r->data + 2);
        break;
    case FW_DRAWING_STRANS:
        e->transform = fw_drawing_u16(r->data);
        break;
    case FW_DRAWING_MAG:
        e->scale = fw_drawing_real8(r->data);
        break;
    case FW_DRAWING_ANGLE:
        e->angle_deg = fw_drawing_real8(r->data);
        break;
    case FW_DRAWING_SNAME:
        e->name = *r;
        break;
    case FW_DRAWING_XY:
        if (e->xy.data) return damaged(l, r->offset, "an element has several XY records");
        if (r->length == 0 || r->length % 8 != 0)
            return damaged(l, r->offset, "XY has not pairs of numbers");
        e->xy = *r;
        break;
    }
    return FW_OK;
}

static fw_geometry_vec2 point_of(const element *e, size_t i) {
    const unsigned char *p = e->xy.data + 8 * i;
    return (fw_geometry_vec2){fw_drawing_i32(p), fw_drawing_i32(p + 4)};
}

static fw_status too_large(const library *l, size_t offset) {
    return fw_diag_error(
        l->flat->diags, 567, l->flat->asked->place,
        "%s, byte %zu: with what its references multiply the cell has more than %d elements or "
        "%d points; a mask takes less: place a smaller cell",
        l->flat->asked->file, offset, (int)FW_DRAWING_SHAPES_MOST, (int)FW_DRAWING_POINTS_MOST);
}

/* the first layers of which nothing is taken */
static void note_other(fw_drawing_flat *flat, int layer, int type) {
    const int most = sizeof flat->other / sizeof *flat->other;
    for (int i = 0; i < flat->nother && i < most; i++)
        if (flat->other[i].layer == layer && flat->other[i].type == type) return;
    if (flat->nother < most)
        flat->other[flat->nother] = (fw_drawing_map){.layer = layer, .type = type};
    flat->nother += flat->nother <= most;
}

/* to every layer that takes it; in the frame of the device */
static fw_status add_polygon(library *l, const element *e, const frame *f, fw_geometry_vec2 *p,
                             int n) {
    fw_drawing_flat *flat = l->flat;
    bool any = flat->asked->nmap == 0, taken = any;
    for (int i = 0; i < n; i++)
        p[i] = placed(f, p[i].x, p[i].y);
    for (int i = 0; i < flat->nmap; i++) {
        fw_drawing_map *m = &flat->map[i];
        bool own = m->layer == e->layer && (m->type < 0 || m->type == e->type);
        if (any && !own && m->found)
            return fw_diag_error(
                flat->diags, 568, flat->asked->place,
                "cell %.64s of %s has polygons on the layers %d/%d and %d/%d; say which go where "
                "with layers=\"%d/%d>mask; ...\"",
                flat->name, flat->asked->file, m->layer, m->type, e->layer, e->type, m->layer,
                m->type);
        if (any) m->layer = e->layer, m->type = e->type;
        if (!own && !any) continue;
        m->found = taken = true;
        fw_status status = fw_drawing_flat_add(flat, i, p, n, false);
        if (status == FW_LIMIT) return too_large(l, e->offset);
        char unit[32];
        if (status == FW_GEOMETRY)
            return fw_diag_error(
                flat->diags, 567, flat->asked->place,
                "%s, byte %zu: it lies farther than 268 mm from the origin; correct the unit of "
                "the "
                "drawing (its database unit is %s nm), or where the cell is placed",
                flat->asked->file, e->offset, fw_number_text(unit, sizeof unit, l->unit_nm, 9));
        FW_TRY(status);
    }
    if (!taken) note_other(flat, e->layer, e->type);
    return FW_OK;
}

static fw_status add_boundary(library *l, const element *e, const frame *f) {
    size_t n = e->xy.length / 8;
    fw_geometry_vec2 *p = fw_arena_array(l->flat->arena, fw_geometry_vec2, n);
    FW_NEED(p);
    for (size_t i = 0; i < n; i++)
        p[i] = point_of(e, i);
    if (n > 1 && vec_same(p[0], p[n - 1])) n--;
    if (n < 3) return damaged(l, e->offset, "a polygon has fewer than three corners");
    return add_polygon(l, e, f, p, (int)n);
}

static fw_status add_path(library *l, const element *e, const frame *f) {
    size_t n = e->xy.length / 8;
    fw_geometry_vec2 *p = fw_arena_array(l->flat->arena, fw_geometry_vec2, n);
    FW_NEED(p);
    if (e->ends > 2 && e->ends != 4) return damaged(l, e->offset, "PATHTYPE is none of 0, 1, 2, 4");
    /* a negative width is not scaled with the cell */
    double half = 0.5 * fabs(e->width) / (e->width < 0 ? f->scale / l->unit_nm : 1);
    fw_drawing_stroke s = {
        .p = p, .half = half, .round = e->ends == 1, .chord = ROUND_NM / f->scale};
    for (size_t i = 0; i < n; i++) {
        fw_geometry_vec2 at = point_of(e, i);
        if (s.n == 0 || !vec_same(at, p[s.n - 1])) p[s.n++] = at;
    }
    if (e->ends == 2) s.begin = s.end = half;
    if (e->ends == 4) s.begin = e->begin, s.end = e->end;
    if (!(half > 0)) return FW_OK; /* a line without a width covers nothing */
    if (s.n < 2) return damaged(l, e->offset, "a path has fewer than two different points");
    fw_drawing_points *part;
    int parts;
    FW_TRY(fw_drawing_stroke_parts(l->flat->arena, &s, &part, &parts));
    for (int i = 0; i < parts; i++)
        FW_TRY(add_polygon(l, e, f, part[i].p, part[i].n));
    return FW_OK;
}

/* ---- references ---- */

static fw_status follow(library *l, cell *c, const frame *f, int depth, size_t offset);

static fw_status add_references(library *l, const element *e, const frame *f, int depth) {
    const fw_drawing_cell_asked *a = l->flat->asked;
    bool array = e->kind == FW_DRAWING_AREF;
    size_t points = e->xy.length / 8;
    if (points != (array ? 3u : 1u))
        return damaged(l, e->offset, "a reference has not the points it needs");
    if (array && (e->columns < 1 || e->rows < 1 || e->columns > 32767 || e->rows > 32767))
        return damaged(l, e->offset, "COLROW of an array is not 1 to 32767");
    if (e->transform & ABSOLUTE)
        return fw_diag_error(l->flat->diags, 565, a->place,
                             "%s, byte %zu: a reference with an absolute angle or magnification, "
                             "which programs read in "
                             "different ways; write it with relative ones",
                             a->file, e->offset);
    if (!(e->scale > 1e-6 && e->scale < 1e6 && fabs(e->angle_deg) < 1e6))
        return damaged(l, e->offset, "MAG is not between 1e-6 and 1e6, or ANGLE is no angle");
    char name[NAME_MOST + 1] = "";
    cell *c = e->name.data ? find(l, name_of(&e->name, name)) : NULL;
    if (!c)
        return fw_diag_error(l->flat->diags, 568, a->place,
                             "%s, byte %zu: it refers to a cell '%.64s' that is not in the file; "
                             "write it with all of its "
                             "cells",
                             a->file, e->offset, name);
    fw_geometry_vec2 o = point_of(e, 0), right = {0, 0}, up = {0, 0};
    if (array) {
        right = vec_sub(point_of(e, 1), o);
        up = vec_sub(point_of(e, 2), o);
    }
    if ((long)e->columns * e->rows > FW_DRAWING_SHAPES_MOST - l->work)
        return too_large(l, e->offset);
    for (int i = 0; i < e->rows; i++)
        for (int k = 0; k < e->columns; k++) {
            double across = (double)k / e->columns, upwards = (double)i / e->rows;
            frame own = frame_of(e->transform & MIRRORED, e->scale, e->angle_deg,
                                 o.x + across * right.x + upwards * up.x,
                                 o.y + across * right.y + upwards * up.y);
            own = within_frame(f, &own);
            FW_TRY(follow(l, c, &own, depth + 1, e->offset));
        }
    return FW_OK;
}

/* a polygon that no layer takes is not even made: hostile files hold many */
static bool is_wanted(const library *l, const element *e) {
    bool wanted = l->flat->asked->nmap == 0;
    for (int i = 0; i < l->flat->nmap && !wanted; i++) {
        const fw_drawing_map *m = &l->flat->map[i];
        wanted = m->layer == e->layer && (m->type < 0 || m->type == e->type);
    }
    return wanted;
}

static fw_status take_element(library *l, const fw_drawing_record *first, size_t *at,
                              const frame *f, int depth) {
    element e = {.kind = first->kind,
                 .layer = -1,
                 .type = -1,
                 .columns = 1,
                 .rows = 1,
                 .scale = 1,
                 .offset = first->offset};
    for (fw_drawing_record r = again(l, at); r.kind != FW_DRAWING_ENDEL; r = again(l, at))
        FW_TRY(take_part(l, &r, &e));
    if (++l->work > FW_DRAWING_SHAPES_MOST) return too_large(l, e.offset);
    bool area =
        e.kind == FW_DRAWING_BOUNDARY || e.kind == FW_DRAWING_BOX || e.kind == FW_DRAWING_PATH;
    if (!area && e.kind != FW_DRAWING_SREF && e.kind != FW_DRAWING_AREF) return FW_OK;
    if (!e.xy.data) return damaged(l, e.offset, "an element has no XY");
    if (!area) return add_references(l, &e, f, depth);
    if (e.layer < 0 || e.type < 0)
        return damaged(l, e.offset, "a polygon or path has no layer or data type");
    if (!is_wanted(l, &e)) return FW_OK;
    return e.kind == FW_DRAWING_PATH ? add_path(l, &e, f) : add_boundary(l, &e, f);
}

static fw_status follow(library *l, cell *c, const frame *f, int depth, size_t offset) {
    const fw_drawing_cell_asked *a = l->flat->asked;
    if (c->open)
        return fw_diag_error(l->flat->diags, 566, a->place,
                             "%s, byte %zu: cell '%.64s' holds itself, here or through others; "
                             "remove this reference",
                             a->file, offset, c->name);
    if (depth > FW_DRAWING_DEEPEST)
        return fw_diag_error(
            l->flat->diags, 566, a->place,
            "%s, byte %zu: cells lie within cells more than %d deep; flatten some of them", a->file,
            offset, (int)FW_DRAWING_DEEPEST);
    c->open = true;
    size_t at = c->begin;
    for (fw_drawing_record r = again(l, &at); r.kind != FW_DRAWING_ENDSTR; r = again(l, &at)) {
        if (++l->work > FW_DRAWING_SHAPES_MOST) return too_large(l, r.offset);
        if (begins_element(r.kind)) FW_TRY(take_element(l, &r, &at, f, depth));
    }
    c->open = false;
    return FW_OK;
}

/* "3" or "3/0" of all that is asked for */
static fw_status read_maps(fw_drawing_flat *flat) {
    for (int i = 0; i < flat->nmap; i++) {
        fw_drawing_map *m = &flat->map[i];
        const char *text = m->from;
        double layer = -1, type = -1;
        m->layer = m->type = -1;
        if (!text) continue;
        size_t n = strcspn(text, "/");
        bool good = fw_number_parse(text, n, &layer) &&
                    (text[n] == '\0' || fw_number_parse(text + n + 1, strlen(text + n + 1), &type));
        good = good && layer == floor(layer) && layer >= 0 && layer <= 65535 &&
               type == floor(type) && type >= -1 && type <= 65535;
        if (!good)
            return fw_diag_error(flat->diags, 568, flat->asked->layers_place,
                                 "layer \"%.64s\": a layer of a GDSII file is a number, or "
                                 "NUMBER/DATATYPE, as in \"3\" or "
                                 "\"3/0\"",
                                 text);
        m->layer = (int)layer;
        m->type = (int)type;
    }
    return FW_OK;
}

fw_status fw_drawing_flatten_gds(fw_drawing_flat *flat, const char *data, size_t n) {
    const fw_drawing_cell_asked *a = flat->asked;
    library l = {.flat = flat, .data = data, .n = n};
    cell *chosen;
    if (a->unit)
        return fw_diag_error(flat->diags, 568, a->unit_place,
                             "a GDSII file states its own unit; remove unit");
    FW_TRY(read_maps(flat));
    FW_TRY(list_cells(&l));
    FW_TRY(choose_cell(&l, &chosen));
    flat->name = chosen->name;
    double deg = a->pose.angle_rad * 180 / FW_PI;
    frame f = frame_of(a->mirrored, l.unit_nm, deg, a->pose.x_m * 1e9, a->pose.y_m * 1e9);
    return follow(&l, chosen, &f, 0, 0);
}
