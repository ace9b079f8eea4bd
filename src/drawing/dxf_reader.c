/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DXF (ASCII) to closed outlines. Pairs of lines, a group code and a value; of the sections only
   $INSUNITS and $DWGCODEPAGE of HEADER, the layers of TABLES, BLOCKS, and the ENTITIES of model space with the blocks that they insert. A bulge is the tangent of a quarter of the
   sweep, so arcs of polylines are exact. Source: AutoCAD DXF Reference, u18_1_h. */
#include "base/constants.h"
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { LINE_MOST = 2048, LAYER_MOST = 256, BLOCKS_MOST = 10000, DEEPEST = 16, WORK_MOST = 100000 };

typedef fw_drawing_pair pair;
typedef fw_drawing_dxf reader;

typedef struct vertex {
    fw_geometry_vec2 at;
    double bulge;
} vertex;

static void damaged(reader *r, int line, const char *what) {
    if (!r->failed)
        fw_diag_error(r->diags, 312, fw_drawing_dxf_place(r, line),
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
    r->pair_at = r->at;
    r->pair_line = r->line;
    if (r->failed || r->no_memory || r->over || !next_line(r, &code, &n)) {
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
    bool paper, thick, turned, hidden;
} entity;

/* What is drawn with lines that are not read is refused, and so is what is not known. What is mostly a remark or a mark, or fills
   what has its line, too, is passed over with one warning for each kind; of no warning is what has no
   extent, or is never shown by itself. */
static const struct {
    const char *name;
    bool told;
} passed_over[] = {{"POINT", false},    {"DIMENSION", true},   {"ARC_DIMENSION", true},
                   {"LEADER", true},    {"MULTILEADER", true}, {"TOLERANCE", true},
                   {"ATTDEF", false},   {"ATTRIB", true},      {"SEQEND", false},
                   {"VIEWPORT", false}, {"XLINE", true},       {"RAY", true},
                   {"TEXT", true},      {"MTEXT", true},       {"HATCH", true}};

/* ---- layers ---- */

static const fw_drawing_layer *find_layer(const reader *r, const char *name) {
    for (int i = 0; i < r->nlayer_row; i++)
        if (strcasecmp(r->layer_row[i].name, name) == 0) return &r->layer_row[i];
    return NULL;
}

/* LAYER of the tables: stands on it, leaves on the next entry. Off is a negative colour (group 62), frozen bit 1 of the flags */
static fw_status note_layer(reader *r) {
    fw_drawing_layer row = {.name = ""};
    while (next(r) && r->now.code != 0)
        if (r->now.code == 2)
            FW_NEED(row.name = fw_drawing_dxf_name(r, r->now.value, r->now.length));
        else if (r->now.code == 62)
            row.off = number_now(r) < 0;
        else if (r->now.code == 70)
            row.frozen = (int)fmax(0, fmin(number_now(r), 1e6)) & 1;
    if (r->nlayer_row == BLOCKS_MOST) damaged(r, r->line, "it has more than 10000 layers");
    if (r->failed) return FW_OK;
    if (r->nlayer_row == r->layer_room) {
        int more = r->layer_room ? 2 * r->layer_room : 16;
        FW_NEED(r->layer_row = fw_arena_grow(r->arena, r->layer_row, (size_t)r->nlayer_row,
                                             (size_t)more, sizeof *r->layer_row));
        r->layer_room = more;
    }
    r->layer_row[r->nlayer_row++] = row;
    return FW_OK;
}

/* once of a file: whether it had not been told */
static bool tell_once(reader *r, unsigned bit) {
    unsigned before = r->told;
    r->told |= bit;
    return before != r->told;
}

/* What the drawing does not show is not taken: what is invisible itself (group 60), and what lies on a layer that is off or
   frozen, unless that layer is asked for by name. A block is hidden by a frozen layer of its INSERT, not by one that is off */
static bool is_seen(reader *r, const entity *e) {
    const unsigned invisible = 1u << 31, switched = 1u << 30;
    const fw_drawing_layer *on = find_layer(r, e->layer);
    bool shown = !on || !(on->frozen || (on->off && strcmp(e->name, "INSERT") != 0));
    bool named = r->asked->layer && strcmp(r->asked->layer, e->layer) == 0;
    if (e->hidden && tell_once(r, invisible))
        fw_diag_warning(r->diags, 705, fw_drawing_dxf_place(r, e->line),
                        "%s on layer '%.64s' is invisible in the drawing (group 60) and not "
                        "taken, and nor is anything else of this file that is: where it is meant "
                        "to be drawn, make it visible",
                        e->name, e->layer);
    else if (!shown && tell_once(r, switched))
        fw_diag_warning(r->diags, 716, fw_drawing_dxf_place(r, e->line),
                        "layer '%.64s' is %s in the drawing, %s", e->layer,
                        on->frozen ? "frozen" : "switched off",
                        named ? "which does not show it; it is taken all the same, since it is "
                                "asked for by its name"
                              : "and what lies on it is not taken: where it is meant to be drawn, "
                                "switch it on or thaw it, or ask for it by its name");
    return !e->hidden && (shown || named);
}

static bool is_wanted(reader *r, const entity *e) {
    if (e->paper) return false;
    if (!r->asked->layer || strcmp(r->asked->layer, e->layer) == 0) return is_seen(r, e);
    r->no_memory = r->no_memory || fw_drawing_dxf_note_other(r, e->layer) != FW_OK;
    return false;
}

/* without a layer in the request all must lie on one */
static bool is_of_layer(reader *r, const entity *e) {
    if (r->asked->layer) return true;
    if (!r->layer) r->layer = fw_arena_strdup(r->arena, e->layer);
    if (!r->layer || strcmp(r->layer, e->layer) == 0) return true;
    fw_diag_error(r->diags, 314, r->asked->place,
                  "%s has lines on the layers '%.64s' and '%.64s'; say which one with %s",
                  r->asked->file, r->layer, e->layer,
                  r->asked->segments_most ? "layers=\"FROM>TO\"" : "layer=\"...\"");
    r->failed = true;
    return false;
}

/* in a block layer 0 is that of what inserts it */
static void inherit(const reader *r, entity *e) {
    if (r->inherited && strcmp(e->layer, "0") == 0)
        snprintf(e->layer, sizeof e->layer, "%s", r->inherited);
}

static bool usable(reader *r, entity *e) {
    inherit(r, e);
    if (!is_wanted(r, e) || !is_of_layer(r, e)) return false;
    if (e->thick || e->turned) {
        fw_diag_error(r->diags, 315, fw_drawing_dxf_place(r, e->line),
                      e->thick ? "%s on layer '%.64s' has a width of its own; draw its outline "
                                 "instead, or set the width to 0"
                               : "%s on layer '%.64s' is drawn in a plane of its own (groups 210 "
                                 "to 230); flatten it into the plane of x and y",
                      e->name, e->layer);
        r->failed = true;
    }
    return !r->failed;
}

/* a vertex that repeats the one before it is none */
static fw_status add_polyline(reader *r, const entity *e, const vertex *v, int n) {
    bool shut = e->flags & 1;
    int first = r->nedge;
    for (int i = 0; i + !shut < n && !r->failed; i++) {
        fw_geometry_vec2 a = v[i].at, b = v[(i + 1) % n].at;
        if (!vec_same(a, b)) FW_TRY(fw_drawing_dxf_edge(r, a, b, 4 * atan(v[i].bulge), e->line));
    }
    bool ends_meet = n > 2 && vec_same(v[0].at, v[n - 1].at);
    return shut || ends_meet ? fw_drawing_dxf_close(r, first, e->line) : FW_OK;
}

static fw_status add_circle(reader *r, const entity *e) {
    int first = r->nedge;
    fw_geometry_vec2 left = {e->x[0] - e->radius, e->y[0]}, right = {e->x[0] + e->radius, e->y[0]};
    FW_TRY(fw_drawing_dxf_edge(r, right, left, FW_PI, e->line));
    FW_TRY(fw_drawing_dxf_edge(r, left, right, FW_PI, e->line));
    return fw_drawing_dxf_close(r, first, e->line);
}

/* one of a full turn is a circle, as some programs write these */
static fw_status add_arc(reader *r, const entity *e) {
    if (fabs(fabs(e->to_deg - e->from_deg) - 360) < 1e-9) return add_circle(r, e);
    double from = e->from_deg * FW_PI / 180, sweep = fmod(e->to_deg - e->from_deg, 360);
    if (sweep <= 0) sweep += 360;
    double to = from + sweep * FW_PI / 180;
    fw_geometry_vec2 c = {e->x[0], e->y[0]};
    return fw_drawing_dxf_edge(
        r, (fw_geometry_vec2){c.x + e->radius * cos(from), c.y + e->radius * sin(from)},
        (fw_geometry_vec2){c.x + e->radius * cos(to), c.y + e->radius * sin(to)},
        sweep * FW_PI / 180, e->line);
}

typedef struct vertices {
    vertex *item;
    int count, room;
} vertices;

static fw_status add_vertex(reader *r, vertices *v) {
    if (v->count > fw_drawing_dxf_most(r)) return FW_OK; /* said when edges are made of them */
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
        const char *name = fw_drawing_dxf_name(r, r->now.value, r->now.length);
        if (name) snprintf(e->layer, sizeof e->layer, "%s", name);
        r->no_memory = r->no_memory || !name;
    } else if (code == 67)
        e->paper = number_now(r) != 0;
    else if (code == 60)
        e->hidden = number_now(r) != 0;
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
        fw_diag_error(r->diags, 315, fw_drawing_dxf_place(r, e->line),
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
    if (strcmp(e->name, "LINE") == 0)
        return vec_same(a, b) ? FW_OK : fw_drawing_dxf_edge(r, a, b, 0, e->line);
    if (!(e->radius > 0)) {
        damaged(r, e->line, "an arc has no radius");
        return FW_OK;
    }
    return strcmp(e->name, "ARC") == 0 ? add_arc(r, e) : add_circle(r, e);
}

static fw_status read_other(reader *r, entity *e) {
    while (next(r) && r->now.code != 0)
        if (r->now.code == 8 || r->now.code == 60 || r->now.code == 67) common_group(r, e);
    inherit(r, e);
    if (r->failed || !is_wanted(r, e)) return FW_OK;
    for (size_t i = 0; i < sizeof passed_over / sizeof *passed_over; i++) {
        if (strcmp(passed_over[i].name, e->name) != 0) continue;
        if (passed_over[i].told && !(r->told >> i & 1))
            fw_diag_warning(r->diags, 723, fw_drawing_dxf_place(r, e->line),
                            "%s on layer '%.64s' is not taken, and no other one of this file: "
                            "where it is meant to be drawn, convert it to closed polylines",
                            e->name, e->layer);
        r->told |= 1u << i;
        return FW_OK;
    }
    fw_diag_error(r->diags, 315, fw_drawing_dxf_place(r, e->line),
                  "%s on layer '%.64s' is not read: convert it to polylines of lines and arcs",
                  e->name, e->layer);
    r->failed = true;
    return FW_OK;
}

/* ---- blocks ---- */

static fw_drawing_block *find_block(const reader *r, const char *name) {
    for (int i = 0; i < r->nblock; i++)
        if (strcasecmp(r->block[i].name, name) == 0) return &r->block[i];
    return NULL;
}

/* stands on 0/BLOCK, leaves on its first entity, or ENDBLK */
static fw_status note_block(reader *r) {
    fw_drawing_block b = {.name = ""};
    while (next(r) && r->now.code != 0) {
        if (r->now.code == 2) FW_NEED(b.name = fw_drawing_dxf_name(r, r->now.value, r->now.length));
        if (r->now.code == 10) b.base.x = number_now(r);
        if (r->now.code == 20) b.base.y = number_now(r);
    }
    b.begin = r->pair_at;
    b.line = r->pair_line;
    if (r->nblock == BLOCKS_MOST) damaged(r, r->line, "it has more than 10000 blocks");
    if (r->failed) return FW_OK;
    if (r->nblock == r->block_room) {
        int more = r->block_room ? 2 * r->block_room : 16;
        FW_NEED(r->block = fw_arena_grow(r->arena, r->block, (size_t)r->nblock, (size_t)more,
                                         sizeof *r->block));
        r->block_room = more;
    }
    r->block[r->nblock++] = b;
    return FW_OK;
}

static fw_status read_entity(reader *r);

/* the entities of a block, with the reader's place in the text as it was */
static fw_status read_block(reader *r, int number, const entity *e) {
    fw_drawing_block *b = &r->block[number];
    const char *why = b->open                ? "holds itself, here or through others"
                      : r->depth >= DEEPEST  ? "lies within others more than 16 deep"
                      : r->work >= WORK_MOST ? "would be placed more than 100000 times"
                                             : NULL;
    if (why) {
        fw_diag_error(r->diags, 319, fw_drawing_dxf_place(r, e->line),
                      "block '%.64s' %s; explode some of the blocks", b->name, why);
        r->failed = true;
        return FW_OK;
    }
    reader kept = *r;
    b->open = true;
    r->at = b->begin;
    r->line = b->line;
    r->depth++;
    next(r);
    while (!r->failed && !r->over && !is(&r->now, 0, "ENDBLK") && !is(&r->now, 0, "ENDSEC")) {
        r->work++;
        FW_TRY(read_entity(r));
    }
    r->block[number].open = false;
    r->at = kept.at, r->line = kept.line, r->over = kept.over, r->now = kept.now;
    r->pair_at = kept.pair_at, r->pair_line = kept.pair_line, r->depth = kept.depth;
    return FW_OK;
}

typedef struct insert {
    char name[LAYER_MOST];
    double scale[2], angle_deg, step[2];
    int columns, rows;
} insert;

static void insert_group(reader *r, insert *in, entity *e) {
    int code = r->now.code;
    if (code == 2) {
        const char *name = fw_drawing_dxf_name(r, r->now.value, r->now.length);
        if (name) snprintf(in->name, sizeof in->name, "%s", name);
        r->no_memory = r->no_memory || !name;
    } else if (code == 10 || code == 20)
        *(code == 10 ? &e->x[0] : &e->y[0]) = number_now(r);
    else if (code == 41 || code == 42)
        in->scale[code - 41] = number_now(r);
    else if (code == 44 || code == 45)
        in->step[code - 44] = number_now(r);
    else if (code == 50)
        in->angle_deg = number_now(r);
    else if (code == 70 || code == 71)
        *(code == 70 ? &in->columns : &in->rows) = (int)fmax(1, fmin(number_now(r), 32767));
    else
        common_group(r, e);
}

/* what INSERT cannot place; NULL: it can */
static const char *insert_fault(const insert *in, const entity *e, const fw_drawing_block *b) {
    double same = fabs(in->scale[0]) - fabs(in->scale[1]);
    if (!b) return "is not in the file; save it with its blocks";
    if (e->turned)
        return "is drawn in a plane of its own (groups 210 to 230); flatten it into the plane of x "
               "and y";
    if (!(fabs(in->scale[0]) > 1e-9 && fabs(same) <= 1e-9 * fabs(in->scale[0])))
        return "is stretched, so that its arcs are none any more; explode it";
    return NULL;
}

/* INSERT: a block, moved so that its base lies on the point, scaled, turned and repeated */
static fw_status read_insert(reader *r, entity *e) {
    insert in = {.scale = {1, 1}, .columns = 1, .rows = 1};
    while (next(r) && r->now.code != 0)
        insert_group(r, &in, e);
    inherit(r, e);
    if (r->failed || e->paper || !is_seen(r, e)) return FW_OK;
    const fw_drawing_block *b = find_block(r, in.name);
    const char *fault = insert_fault(&in, e, b);
    if (fault) {
        fw_diag_error(r->diags, 315, fw_drawing_dxf_place(r, e->line), "block '%.64s' %s", in.name,
                      fault);
        r->failed = true;
        return FW_OK;
    }
    const fw_drawing_frame from = r->frame;
    const char *layer = r->inherited;
    int number = (int)(b - r->block);
    double c = cos(in.angle_deg * FW_PI / 180), s = sin(in.angle_deg * FW_PI / 180);
    FW_NEED(r->inherited = fw_arena_strdup(r->arena, e->layer));
    for (int i = 0; i < in.rows; i++)
        for (int k = 0; k < in.columns && !r->failed; k++) {
            double u = k * in.step[0] - in.scale[0] * r->block[number].base.x,
                   v = i * in.step[1] - in.scale[1] * r->block[number].base.y;
            fw_geometry_vec2 o = fw_drawing_placed(
                &from, (fw_geometry_vec2){e->x[0] + c * u - s * v, e->y[0] + s * u + c * v});
            double xx = c * in.scale[0], xy = -s * in.scale[1], yx = s * in.scale[0],
                   yy = c * in.scale[1];
            r->frame = (fw_drawing_frame){from.xx * xx + from.xy * yx,
                                          from.xx * xy + from.xy * yy,
                                          from.yx * xx + from.yy * yx,
                                          from.yx * xy + from.yy * yy,
                                          o.x,
                                          o.y};
            r->work++;
            FW_TRY(read_block(r, number, e));
        }
    r->frame = from;
    r->inherited = layer;
    return FW_OK;
}

/* stands on the pair 0/NAME of an entity, leaves on that of the next */
static fw_status read_entity(reader *r) {
    entity e = begin(r);
    if (strcmp(e.name, "LWPOLYLINE") == 0) return read_light(r, &e);
    if (strcmp(e.name, "POLYLINE") == 0) return read_heavy(r, &e);
    if (strcmp(e.name, "INSERT") == 0) return read_insert(r, &e);
    if (strcmp(e.name, "LINE") == 0 || strcmp(e.name, "ARC") == 0 || strcmp(e.name, "CIRCLE") == 0)
        return read_simple(r, &e);
    return read_other(r, &e);
}

static fw_status read_section(reader *r) {
    if (!next(r) || r->now.code != 2) {
        damaged(r, r->line, "a section has no name");
        return FW_OK;
    }
    bool header = is(&r->now, 2, "HEADER"), entities = is(&r->now, 2, "ENTITIES"),
         blocks = is(&r->now, 2, "BLOCKS"), tables = is(&r->now, 2, "TABLES");
    bool wanted = false, page = false;
    next(r);
    while (!r->failed && !r->over && !is(&r->now, 0, "ENDSEC")) {
        if (entities && r->now.code == 0) {
            FW_TRY(read_entity(r));
            continue;
        }
        if (blocks && is(&r->now, 0, "BLOCK")) {
            FW_TRY(note_block(r));
            continue;
        }
        if (tables && is(&r->now, 0, "LAYER")) {
            FW_TRY(note_layer(r));
            continue;
        }
        if (header && r->now.code == 9)
            wanted = is(&r->now, 9, "$INSUNITS"), page = is(&r->now, 9, "$DWGCODEPAGE");
        if (header && page && r->now.code == 3)
            FW_NEED(r->code_page = fw_arena_strndup(r->arena, r->now.value, r->now.length));
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
                .frame = {.xx = 1, .yy = 1},
                .insunits = -1};
    *out = (fw_drawing){0};
    while (next(&r) && !is(&r.now, 0, "EOF"))
        if (is(&r.now, 0, "SECTION")) FW_TRY(read_section(&r));
    if (!r.failed && r.line == 0) damaged(&r, 1, "it is empty");
    if (!r.failed && r.over) damaged(&r, r.line, "it does not end with EOF");
    if (r.no_memory) return FW_NOMEM;
    if (r.failed) return FW_INPUT;
    return fw_drawing_dxf_outlines(&r, out);
}
