/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DXF (ASCII) to closed outlines. Pairs of lines, a group code and a value; of the sections only
   $INSUNITS of HEADER and the ENTITIES of model space. A bulge is the tangent of a quarter of the
   sweep, so arcs of polylines are exact. Source: AutoCAD DXF Reference, u18_1_h. */
#include "base/constants.h"
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

enum { LINE_MOST = 2048, LAYER_MOST = 256 };

typedef fw_drawing_pair pair;
typedef fw_drawing_edge edge;
typedef fw_drawing_run closed;
typedef fw_drawing_dxf reader;

typedef struct vertex {
    fw_geometry_vec2 at;
    double bulge;
} vertex;

static fw_place place_at(const reader *r, int line) {
    return (fw_place){r->asked->file, line, 1};
}

static void damaged(reader *r, int line, const char *what) {
    if (!r->failed)
        fw_diag_error(r->diags, 312, place_at(r, line),
                      "this is no DXF file as it should be: %s; save it again as ASCII DXF", what);
    r->failed = true;
}

/* ---- pairs ---- */

/* one line of text without its end; false: there is none */
static bool next_line(reader *r, const char **text, size_t *length) {
    if (r->at >= r->end) return false;
    const char *stop = memchr(r->at, '\n', (size_t)(r->end - r->at));
    size_t n = (size_t)((stop ? stop : r->end) - r->at);
    *text = r->at;
    r->at = stop ? stop + 1 : r->end;
    r->line++;
    while (n > 0 && ((*text)[n - 1] == '\r' || (*text)[n - 1] == ' ' || (*text)[n - 1] == '\t'))
        n--;
    while (n > 0 && (**text == ' ' || **text == '\t'))
        ++*text, n--;
    *length = n;
    if (n > LINE_MOST) damaged(r, r->line, "a line is longer than 2048 bytes");
    return !r->failed;
}

static bool next(reader *r) {
    const char *code;
    size_t n;
    double number;
    if (r->failed || r->over || !next_line(r, &code, &n)) {
        r->over = true;
        return false;
    }
    r->now.line = r->line;
    if (n == 0 && r->at >= r->end) { /* a blank line at the end */
        r->over = true;
        return false;
    }
    if (!fw_number_parse(code, n, &number) || number != floor(number) || fabs(number) > 2000) {
        damaged(r, r->line, "a group code is expected, a whole number");
        return false;
    }
    r->now.code = (int)number;
    if (!next_line(r, &r->now.value, &r->now.length)) {
        damaged(r, r->line, "it ends behind a group code");
        return false;
    }
    return true;
}

static bool is(const pair *p, int code, const char *value) {
    return p->code == code && p->length == strlen(value) && memcmp(p->value, value, p->length) == 0;
}

static double number_now(reader *r) {
    double value = 0;
    if (!fw_number_parse(r->now.value, r->now.length, &value) || fabs(value) > 1e12)
        damaged(r, r->now.line + 1, "a number is expected");
    return value;
}

/* ---- entities ---- */

typedef struct entity {
    char name[32], layer[LAYER_MOST];
    int line, flags; /* group 70 */
    double x[2], y[2], radius, from_deg, to_deg;
    bool paper, thick, turned;
} entity;

/* what is geometry and is not read; what is neither is a remark (text, dimensions, points) */
static const char *const refused[] = {"SPLINE", "ELLIPSE", "INSERT", "SOLID",   "TRACE",
                                      "REGION", "3DFACE",  "MLINE",  "3DSOLID", NULL};

static bool is_wanted(reader *r, const entity *e) {
    if (e->paper) return false;
    return !r->asked->layer || strcmp(r->asked->layer, e->layer) == 0;
}

/* without a layer in the request all must lie on one */
static bool is_of_layer(reader *r, const entity *e) {
    if (r->asked->layer) return true;
    if (!r->layer) r->layer = fw_arena_strdup(r->arena, e->layer);
    if (!r->layer || strcmp(r->layer, e->layer) == 0) return true;
    fw_diag_error(
        r->diags, 314, r->asked->place,
        "%s has lines on the layers '%.64s' and '%.64s'; say which one with layer=\"...\"",
        r->asked->file, r->layer, e->layer);
    r->failed = true;
    return false;
}

static bool usable(reader *r, const entity *e) {
    if (!is_wanted(r, e) || !is_of_layer(r, e)) return false;
    if (e->thick || e->turned) {
        fw_diag_error(r->diags, 315, place_at(r, e->line),
                      e->thick ? "%s on layer '%.64s' has a width of its own; draw its outline "
                                 "instead, or set the width to 0"
                               : "%s on layer '%.64s' is drawn in a plane of its own (groups 210 "
                                 "to 230); flatten it into the plane of x and y",
                      e->name, e->layer);
        r->failed = true;
    }
    return !r->failed;
}

static fw_status add_edge(reader *r, fw_geometry_vec2 a, fw_geometry_vec2 b, double sweep_rad,
                          int line) {
    if (r->nedge == FW_DRAWING_SEGMENTS_MOST) {
        fw_diag_error(r->diags, 319, place_at(r, line),
                      "more than %d lines and arcs are taken from one file; draw fewer points, or "
                      "use several layers",
                      (int)FW_DRAWING_SEGMENTS_MOST);
        r->failed = true;
        return FW_OK;
    }
    if (r->nedge == r->edge_room) {
        int more = r->edge_room ? 2 * r->edge_room : 64;
        FW_NEED(r->edge = fw_arena_grow(r->arena, r->edge, (size_t)r->nedge, (size_t)more,
                                        sizeof *r->edge));
        r->edge_room = more;
    }
    r->edge[r->nedge++] = (edge){a, b, sweep_rad, line, false};
    return FW_OK;
}

static fw_status add_closed(reader *r, int first, int line) {
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

/* a vertex that repeats the one before it is none */
static fw_status add_polyline(reader *r, const entity *e, const vertex *v, int n) {
    bool shut = e->flags & 1;
    int first = r->nedge;
    for (int i = 0; i + !shut < n && !r->failed; i++) {
        fw_geometry_vec2 a = v[i].at, b = v[(i + 1) % n].at;
        if (!vec_same(a, b)) FW_TRY(add_edge(r, a, b, 4 * atan(v[i].bulge), e->line));
    }
    bool ends_meet = n > 2 && vec_same(v[0].at, v[n - 1].at);
    return shut || ends_meet ? add_closed(r, first, e->line) : FW_OK;
}

static fw_status add_arc(reader *r, const entity *e) {
    double from = e->from_deg * FW_PI / 180, sweep = fmod(e->to_deg - e->from_deg, 360);
    if (sweep <= 0) sweep += 360;
    double to = from + sweep * FW_PI / 180;
    fw_geometry_vec2 c = {e->x[0], e->y[0]};
    return add_edge(r, (fw_geometry_vec2){c.x + e->radius * cos(from), c.y + e->radius * sin(from)},
                    (fw_geometry_vec2){c.x + e->radius * cos(to), c.y + e->radius * sin(to)},
                    sweep * FW_PI / 180, e->line);
}

static fw_status add_circle(reader *r, const entity *e) {
    int first = r->nedge;
    fw_geometry_vec2 left = {e->x[0] - e->radius, e->y[0]}, right = {e->x[0] + e->radius, e->y[0]};
    FW_TRY(add_edge(r, right, left, FW_PI, e->line));
    FW_TRY(add_edge(r, left, right, FW_PI, e->line));
    return add_closed(r, first, e->line);
}

typedef struct vertices {
    vertex *item;
    int count, room;
} vertices;

static fw_status add_vertex(reader *r, vertices *v) {
    if (v->count > FW_DRAWING_SEGMENTS_MOST) return FW_OK; /* said when edges are made of them */
    if (v->count == v->room) {
        int more = v->room ? 2 * v->room : 64;
        FW_NEED(v->item = fw_arena_grow(r->arena, v->item, (size_t)v->count, (size_t)more,
                                        sizeof *v->item));
        v->room = more;
    }
    v->item[v->count++] = (vertex){{0, 0}, 0};
    return FW_OK;
}

/* the groups that any entity may have */
static void common_group(reader *r, entity *e) {
    int code = r->now.code;
    if (code == 8) {
        size_t n = r->now.length < LAYER_MOST ? r->now.length : LAYER_MOST - 1;
        memcpy(e->layer, r->now.value, n);
        e->layer[n] = '\0';
    } else if (code == 67)
        e->paper = number_now(r) != 0;
    else if (code == 70)
        e->flags = (int)fmax(0, fmin(number_now(r), 1e6));
    else if (code == 230)
        e->turned = e->turned || number_now(r) < 1 - 1e-9;
    else if (code == 210 || code == 220)
        e->turned = e->turned || fabs(number_now(r)) > 1e-9;
}

static entity begin(const reader *r) {
    entity e = {.line = r->now.line};
    size_t n = r->now.length < sizeof e.name - 1 ? r->now.length : sizeof e.name - 1;
    memcpy(e.name, r->now.value, n);
    return e;
}

/* LWPOLYLINE: its vertices are groups of its own */
static fw_status read_light(reader *r, entity *e) {
    vertices v = {0};
    while (next(r) && r->now.code != 0) {
        int code = r->now.code;
        if (code == 10) FW_TRY(add_vertex(r, &v));
        vertex *last = v.count > 0 ? &v.item[v.count - 1] : NULL;
        if (code == 10 && last)
            last->at.x = number_now(r);
        else if (code == 20 && last)
            last->at.y = number_now(r);
        else if (code == 42 && last)
            last->bulge = number_now(r);
        else if (code == 40 || code == 41 || code == 43)
            e->thick = e->thick || number_now(r) != 0;
        else
            common_group(r, e);
    }
    return !r->failed && usable(r, e) ? add_polyline(r, e, v.item, v.count) : FW_OK;
}

/* POLYLINE: VERTEX entities follow, up to SEQEND */
static fw_status read_heavy(reader *r, entity *e) {
    vertices v = {0};
    bool other = false; /* splines, meshes, and polylines in space */
    while (next(r) && r->now.code != 0) {
        if (r->now.code == 40 || r->now.code == 41)
            e->thick = e->thick || number_now(r) != 0;
        else
            common_group(r, e);
    }
    other = e->flags & ~(1 | 128);
    while (!r->failed && !r->over && is(&r->now, 0, "VERTEX")) {
        entity of = begin(r);
        FW_TRY(add_vertex(r, &v));
        vertex *last = &v.item[v.count - 1];
        while (next(r) && r->now.code != 0) {
            if (r->now.code == 10)
                last->at.x = number_now(r);
            else if (r->now.code == 20)
                last->at.y = number_now(r);
            else if (r->now.code == 42)
                last->bulge = number_now(r);
            else if (r->now.code == 40 || r->now.code == 41)
                e->thick = e->thick || number_now(r) != 0;
            else
                common_group(r, &of);
        }
    }
    if (r->failed || !usable(r, e)) return FW_OK;
    if (other) {
        fw_diag_error(r->diags, 315, place_at(r, e->line),
                      "this POLYLINE is a spline, a mesh or drawn in space; convert it to a plain "
                      "polyline of lines and arcs");
        r->failed = true;
        return FW_OK;
    }
    return add_polyline(r, e, v.item, v.count);
}

/* LINE, ARC, CIRCLE */
static fw_status read_simple(reader *r, entity *e) {
    while (next(r) && r->now.code != 0) {
        int code = r->now.code;
        if (code == 10 || code == 11)
            e->x[code - 10] = number_now(r);
        else if (code == 20 || code == 21)
            e->y[code - 20] = number_now(r);
        else if (code == 40)
            e->radius = number_now(r);
        else if (code == 50)
            e->from_deg = number_now(r);
        else if (code == 51)
            e->to_deg = number_now(r);
        else
            common_group(r, e);
    }
    if (r->failed || !usable(r, e)) return FW_OK;
    fw_geometry_vec2 a = {e->x[0], e->y[0]}, b = {e->x[1], e->y[1]};
    if (strcmp(e->name, "LINE") == 0) return vec_same(a, b) ? FW_OK : add_edge(r, a, b, 0, e->line);
    if (!(e->radius > 0)) {
        damaged(r, e->line, "an arc has no radius");
        return FW_OK;
    }
    return strcmp(e->name, "ARC") == 0 ? add_arc(r, e) : add_circle(r, e);
}

static fw_status read_other(reader *r, entity *e) {
    while (next(r) && r->now.code != 0)
        if (r->now.code == 8 || r->now.code == 67) common_group(r, e);
    for (const char *const *name = refused; *name && !r->failed; name++) {
        if (strcmp(*name, e->name) != 0 || !is_wanted(r, e)) continue;
        fw_diag_error(r->diags, 315, place_at(r, e->line), "%s on layer '%.64s' is not read: %s",
                      e->name, e->layer,
                      strcmp(*name, "INSERT") == 0 ? "explode blocks into lines, arcs and polylines"
                                                   : "convert it to polylines of lines and arcs");
        r->failed = true;
    }
    return FW_OK;
}

/* stands on the pair 0/NAME of an entity, leaves on that of the next */
static fw_status read_entity(reader *r) {
    entity e = begin(r);
    if (strcmp(e.name, "LWPOLYLINE") == 0) return read_light(r, &e);
    if (strcmp(e.name, "POLYLINE") == 0) return read_heavy(r, &e);
    if (strcmp(e.name, "LINE") == 0 || strcmp(e.name, "ARC") == 0 || strcmp(e.name, "CIRCLE") == 0)
        return read_simple(r, &e);
    return read_other(r, &e);
}

static fw_status read_section(reader *r) {
    if (!next(r) || r->now.code != 2) {
        damaged(r, r->line, "a section has no name");
        return FW_OK;
    }
    bool header = is(&r->now, 2, "HEADER"), entities = is(&r->now, 2, "ENTITIES");
    bool wanted = false;
    next(r);
    while (!r->failed && !r->over && !is(&r->now, 0, "ENDSEC")) {
        if (entities && r->now.code == 0) {
            FW_TRY(read_entity(r));
            continue;
        }
        if (header && r->now.code == 9) wanted = is(&r->now, 9, "$INSUNITS");
        if (header && wanted && r->now.code == 70)
            r->insunits = (int)fmax(0, fmin(number_now(r), 1e3));
        next(r);
    }
    if (r->over) damaged(r, r->line, "a section does not end");
    return FW_OK;
}

fw_status fw_drawing_read_dxf(fw_arena *arena, const char *data, size_t n,
                              const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out) {
    reader r = {.arena = arena,
                .diags = diags,
                .asked = asked,
                .at = data,
                .end = data + n,
                .insunits = -1};
    *out = (fw_drawing){0};
    while (next(&r) && !is(&r.now, 0, "EOF"))
        if (is(&r.now, 0, "SECTION")) FW_TRY(read_section(&r));
    if (!r.failed && r.line == 0) damaged(&r, 1, "it is empty");
    if (!r.failed && r.over) damaged(&r, r.line, "it does not end with EOF");
    if (r.failed) return FW_INPUT;
    return fw_drawing_dxf_outlines(&r, out);
}
