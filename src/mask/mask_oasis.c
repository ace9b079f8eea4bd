/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OASIS stream (SEMI P39): strict, all names in tables whose places the END record tells, the
   content of every cell deflated, polygons only, equal polygons and rows of equal cells written
   once with a repetition, CRC32 over the file. Texts say what the mask is, as in GDSII.

   Same mask, same zlib, same bytes: no dates, fixed order. */
#include "mask/mask_parts.h"
#include "base/sort.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* children before parents, the top cell last; all masks have the layers of one table */
typedef struct oasis_cell {
    const char *name;
    const fw_mask *mask;              /* its polygons; NULL: none of its own */
    const fw_mask_plate_place *place; /* (nplace) of cells that stand before this one */
    int nplace;
    const char **note; /* (nnote) lines of text on the documentation layer, from (x, y) by step */
    int nnote;
    int64_t note_x, note_y, note_step; /* dbu */
    fw_mask_port *port;                /* (nport), likewise */
    int nport;
} oasis_cell;

enum {
    START = 1,
    END = 2,
    CELLNAME = 3,
    TEXTSTRING = 5,
    LAYERNAME = 11,
    TEXTLAYERNAME = 12,
    CELL = 13,
    PLACEMENT = 17,
    TEXT = 19,
    POLYGON = 21,
    CBLOCK = 34,
    END_BYTES = 256,
    GRID_PER_UM = 1000,
    LINE_PITCH_DBU = 60000,
    LEVEL = 4, /* 6 takes twice the time for 4 % less */
};

typedef struct writer {
    const fw_mask_table *table;
    bool rejected;
    fw_mask_octets file;
    /* of the cell that is being written */
    const fw_mask *mask;
    fw_mask_octets cell;
    int layer, datatype; /* what the reader holds as current; -1: nothing yet */
    int32_t x, y;
    const fw_geometry_polygon *before; /* its point list is the current one */
    uint64_t ntext;                    /* lines of text of the cells before */
} writer;

/* ---- equal polygons ---- */
typedef struct group { /* shapes of one layer that differ by a translation */
    int first, count, next;
} group;

static bool same_form(const fw_geometry_polygon *p, const fw_geometry_polygon *q) {
    if (p->count != q->count) return false;
    int64_t dx = (int64_t)q->vertex[0].x_dbu - p->vertex[0].x_dbu;
    int64_t dy = (int64_t)q->vertex[0].y_dbu - p->vertex[0].y_dbu;
    for (int i = 1; i < p->count; i++)
        if (q->vertex[i].x_dbu - dx != p->vertex[i].x_dbu ||
            q->vertex[i].y_dbu - dy != p->vertex[i].y_dbu)
            return false;
    return true;
}

/* of the form, not of the place; any fixed mixing will do (Fowler, Noll and Vo's prime) */
static uint64_t hash_of(const fw_mask_shape *s) {
    const fw_geometry_polygon *p = &s->polygon;
    uint64_t h = 14695981039346656037ull ^ (unsigned)s->layer;
    for (int i = 1; i < p->count; i++) {
        uint32_t dx = (uint32_t)p->vertex[i].x_dbu - (uint32_t)p->vertex[0].x_dbu;
        uint32_t dy = (uint32_t)p->vertex[i].y_dbu - (uint32_t)p->vertex[0].y_dbu;
        h = (h ^ ((uint64_t)dx << 32 | dy)) * 1099511628211ull;
    }
    return h ^ h >> 29;
}

/* groups in the order of their first shapes; follow[i] is the next shape of i's group, or -1 */
static fw_status make_groups(fw_arena *arena, const fw_mask *mask, group **out, int *ngroup,
                             int **out_follow) {
    size_t n = (size_t)mask->nshape, slots = 16;
    while (slots < 2 * n)
        slots *= 2;
    group *list = fw_arena_array(arena, group, n);
    int *follow = fw_arena_array(arena, int, n), *last = fw_arena_array(arena, int, n);
    int *slot = fw_arena_array(arena, int, slots); /* 1 + group, 0: none */
    FW_NEED(list && follow && last ? slot : NULL);
    *ngroup = 0;
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        int *at = &slot[hash_of(s) & (slots - 1)], g = *at - 1;
        while (g >= 0 && !(mask->shape[list[g].first].layer == s->layer &&
                           same_form(&mask->shape[list[g].first].polygon, &s->polygon)))
            g = list[g].next;
        follow[i] = -1;
        if (g < 0) {
            g = (*ngroup)++;
            list[g] = (group){i, 0, *at - 1};
            *at = g + 1;
        } else
            follow[last[g]] = i;
        last[g] = i;
        list[g].count++;
    }
    *out = list;
    *out_follow = follow;
    return FW_OK;
}

/* ---- repetitions ---- */
static int by_row(const void *left, const void *right) {
    const fw_geometry_point *a = left, *b = right;
    int order = fw_order_wholes(a->y_dbu, b->y_dbu);
    return order ? order : fw_order_wholes(a->x_dbu, b->x_dbu);
}

/* columns of a full grid of places with equal steps, sorted by rows; 0: it is none */
static int grid_columns(const fw_geometry_point *at, int n) {
    int columns = 1;
    while (columns < n && at[columns].y_dbu == at[0].y_dbu)
        columns++;
    if (n % columns) return 0;
    int64_t dx = columns > 1 ? (int64_t)at[1].x_dbu - at[0].x_dbu : 0;
    int64_t dy = columns < n ? (int64_t)at[columns].y_dbu - at[0].y_dbu : 0;
    for (int i = 0; i < n; i++)
        if (at[i].x_dbu != at[0].x_dbu + (i % columns) * dx ||
            at[i].y_dbu != at[0].y_dbu + (i / columns) * dy)
            return 0;
    return columns;
}

/* n >= 2 places sorted by rows: a grid (type 1), a row (2), a column (3), or one step after the
   other (10). Counts are written less two. Source: SEMI P39, 7.6. */
static void repetition(fw_mask_octets *o, const fw_geometry_point *at, int n) {
    int columns = grid_columns(at, n), rows = columns ? n / columns : 0;
    if (columns == 0) {
        fw_mask_octets_number(o, 10);
        fw_mask_octets_number(o, (uint64_t)n - 2);
        for (int i = 1; i < n && fw_mask_octets_room(o, 2 * FW_OCTETS_INTEGER); i++) {
            unsigned char *end = fw_mask_octets_displacement(
                o->data + o->length, (int64_t)at[i].x_dbu - at[i - 1].x_dbu,
                (int64_t)at[i].y_dbu - at[i - 1].y_dbu);
            o->length = (size_t)(end - o->data);
        }
        return;
    }
    fw_mask_octets_number(o, columns == 1 ? 3 : rows == 1 ? 2 : 1);
    if (columns > 1) fw_mask_octets_number(o, (uint64_t)columns - 2);
    if (rows > 1) fw_mask_octets_number(o, (uint64_t)rows - 2);
    if (columns > 1) fw_mask_octets_number(o, (uint64_t)((int64_t)at[1].x_dbu - at[0].x_dbu));
    if (rows > 1) fw_mask_octets_number(o, (uint64_t)((int64_t)at[columns].y_dbu - at[0].y_dbu));
}

/* ---- elements: what the reader holds already is not written ---- */
enum { L = 1, D = 2, R = 4, Y = 8, X = 16, P = 32 };

static fw_status polygons(writer *w, fw_arena *arena, const group *g, const int *follow) {
    fw_geometry_point *at = fw_arena_array(arena, fw_geometry_point, (size_t)g->count);
    FW_NEED(at);
    int n = 0;
    for (int i = g->first; i >= 0; i = follow[i])
        at[n++] = w->mask->shape[i].polygon.vertex[0];
    qsort(at, (size_t)n, sizeof *at, by_row);
    const fw_mask_shape *s = &w->mask->shape[g->first];
    const fw_mask_layer *y = &w->table->layer[s->layer];
    unsigned info = 0;
    if (y->layer != w->layer) info |= L;
    if (y->datatype != w->datatype) info |= D;
    if (n > 1) info |= R;
    if (at[0].y_dbu != w->y) info |= Y;
    if (at[0].x_dbu != w->x) info |= X;
    if (!w->before || !same_form(w->before, &s->polygon)) info |= P;
    fw_mask_octets *o = &w->cell;
    fw_mask_octets_number(o, POLYGON);
    fw_mask_octets_number(o, info);
    if (info & L) fw_mask_octets_number(o, (uint64_t)y->layer);
    if (info & D) fw_mask_octets_number(o, (uint64_t)y->datatype);
    if (info & P) fw_mask_octets_points(o, &s->polygon);
    if (info & X) fw_mask_octets_signed(o, at[0].x_dbu);
    if (info & Y) fw_mask_octets_signed(o, at[0].y_dbu);
    if (info & R) repetition(o, at, n);
    w->layer = y->layer;
    w->datatype = y->datatype;
    w->x = at[0].x_dbu;
    w->y = at[0].y_dbu;
    w->before = &s->polygon;
    return FW_OK;
}

/* arrays of at least two are repetitions of type 1, 2 or 3 */
static void placement(fw_mask_octets *o, const fw_mask_plate_place *p) {
    enum { BY_NUMBER = 0xc0, PX = 0x20, PY = 0x10, PR = 0x08 };
    bool several = p->columns > 1 || p->rows > 1;
    fw_mask_octets_number(o, PLACEMENT);
    const unsigned char info = (unsigned char)(BY_NUMBER | PX | PY | (several ? PR : 0));
    fw_mask_octets_bytes(o, &info, 1); /* a byte and no integer: its highest bit is set */
    fw_mask_octets_number(o, (uint64_t)p->cell);
    fw_mask_octets_signed(o, p->x);
    fw_mask_octets_signed(o, p->y);
    if (!several) return;
    fw_mask_octets_number(o, p->columns == 1 ? 3 : p->rows == 1 ? 2 : 1);
    if (p->columns > 1) fw_mask_octets_number(o, (uint64_t)p->columns - 2);
    if (p->rows > 1) fw_mask_octets_number(o, (uint64_t)p->rows - 2);
    if (p->columns > 1) fw_mask_octets_number(o, (uint64_t)p->step_x);
    if (p->rows > 1) fw_mask_octets_number(o, (uint64_t)p->step_y);
}

/* lines on the documentation layer, as in GDSII */
static void texts(writer *w, const oasis_cell *c) {
    enum { TL = 1, TT = 2, TY = 8, TX = 16, BY_NUMBER = 0x60 };
    int k = fw_mask_notes_layer(w->table);
    if (k < 0) return;
    for (int i = 0; i < c->nnote; i++) {
        fw_mask_octets_number(&w->cell, TEXT);
        fw_mask_octets_number(&w->cell, BY_NUMBER | TY | (i == 0 ? TL | TT | TX : 0));
        fw_mask_octets_number(&w->cell, w->ntext++);
        if (i == 0) {
            fw_mask_octets_number(&w->cell, (uint64_t)w->table->layer[k].layer);
            fw_mask_octets_number(&w->cell, (uint64_t)w->table->layer[k].datatype);
            fw_mask_octets_signed(&w->cell, c->note_x);
        }
        fw_mask_octets_signed(&w->cell, c->note_y + i * c->note_step);
    }
    for (int i = 0; i < c->nport; i++) { /* behind notes, which every cell with ports has */
        fw_mask_octets_number(&w->cell, TEXT);
        fw_mask_octets_number(&w->cell, BY_NUMBER | TX | TY);
        fw_mask_octets_number(&w->cell, w->ntext++);
        fw_mask_octets_signed(&w->cell, c->port[i].x);
        fw_mask_octets_signed(&w->cell, c->port[i].y);
    }
}

/* ---- deflated block; memory from the arena, so that a limit on it holds here too ---- */
static void *zlib_take(void *arena, unsigned count, unsigned size) {
    return fw_arena_alloc(arena, count, size);
}

static void zlib_leave(void *arena, void *block) {
    (void)arena;
    (void)block;
}

static fw_status compressed(fw_arena *arena, fw_mask_octets *file, const fw_mask_octets *cell) {
    if (cell->length > UINT32_MAX / 2) return FW_LIMIT;
    z_stream z = {.zalloc = zlib_take, .zfree = zlib_leave, .opaque = arena};
    if (deflateInit2(&z, LEVEL, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY) != Z_OK) return FW_NOMEM;
    size_t most = deflateBound(&z, (unsigned long)cell->length);
    unsigned char *packed = fw_arena_array(arena, unsigned char, most);
    FW_NEED(packed);
    z.next_in = cell->data;
    z.avail_in = (unsigned)cell->length;
    z.next_out = packed;
    z.avail_out = (unsigned)most;
    if (deflate(&z, Z_FINISH) != Z_STREAM_END) return FW_INTERNAL;
    size_t n = z.total_out;
    deflateEnd(&z);
    if (n + 3 * FW_OCTETS_INTEGER >= cell->length) { /* short cells are left as they are */
        fw_mask_octets_bytes(file, cell->data, cell->length);
        return FW_OK;
    }
    fw_mask_octets_number(file, CBLOCK);
    fw_mask_octets_number(file, 0); /* deflate */
    fw_mask_octets_number(file, cell->length);
    fw_mask_octets_number(file, n);
    fw_mask_octets_bytes(file, packed, n);
    return FW_OK;
}

/* ---- tables and the END record ---- */
static uint64_t cell_table(writer *w, const oasis_cell *cell, int ncell) {
    uint64_t at = w->file.length;
    for (int i = 0; i < ncell; i++) {
        fw_mask_octets_number(&w->file, CELLNAME);
        fw_mask_octets_string(&w->file, cell[i].name);
    }
    return at;
}

static uint64_t text_table(writer *w, const oasis_cell *cell, int ncell) {
    if (w->ntext == 0) return 0;
    uint64_t at = w->file.length;
    for (int k = 0; k < ncell; k++)
        for (int i = 0; i < cell[k].nnote + cell[k].nport; i++) {
            const int port = i - cell[k].nnote;
            fw_mask_octets_number(&w->file, TEXTSTRING);
            fw_mask_octets_string(&w->file, port < 0 ? cell[k].note[i] : cell[k].port[port].note);
        }
    return at;
}

/* names without spaces; each holds for one layer and one data type */
static fw_status layer_table(writer *w, fw_arena *arena, uint64_t *at) {
    enum { EXACTLY = 3 };
    *at = w->table->nlayer ? w->file.length : 0;
    for (int k = 0; k < w->table->nlayer; k++) {
        const fw_mask_layer *y = &w->table->layer[k];
        char *name = fw_arena_printf(arena, "%s%s", w->rejected ? "REJECTED_" : "", y->name);
        FW_NEED(name);
        for (char *s = name; *s; s++)
            if ((unsigned char)*s <= 0x20 || (unsigned char)*s > 0x7e) *s = '_';
        fw_mask_octets_number(&w->file, y->documentation ? TEXTLAYERNAME : LAYERNAME);
        fw_mask_octets_string(&w->file, name);
        fw_mask_octets_number(&w->file, EXACTLY);
        fw_mask_octets_number(&w->file, (uint64_t)y->layer);
        fw_mask_octets_number(&w->file, EXACTLY);
        fw_mask_octets_number(&w->file, (uint64_t)y->datatype);
    }
    return FW_OK;
}

/* exactly 256 bytes; the signature covers the file from its first byte to the scheme (P39, 14.4) */
static void end(writer *w, uint64_t cells_at, uint64_t texts_at, uint64_t layers_at) {
    enum { STRICT = 1, CRC32 = 1, SIGNATURE = 4 };
    size_t start = w->file.length;
    const uint64_t place[6] = {cells_at, texts_at, 0, 0, layers_at, 0};
    fw_mask_octets_number(&w->file, END);
    for (int i = 0; i < 6; i++) { /* cells, texts, property names and strings, layers, extensions */
        fw_mask_octets_number(&w->file, STRICT);
        fw_mask_octets_number(&w->file, place[i]);
    }
    /* at most 1 + 6 * 11 bytes so far: the padding has between 128 and 255, its length two bytes */
    size_t padding = END_BYTES - (w->file.length - start) - 2 - 1 - SIGNATURE;
    fw_mask_octets_number(&w->file, padding);
    static const unsigned char zeros[END_BYTES];
    fw_mask_octets_bytes(&w->file, zeros, padding);
    fw_mask_octets_number(&w->file, CRC32);
    if (w->file.failed) return;
    unsigned long crc = crc32_z(crc32_z(0, NULL, 0), w->file.data, w->file.length);
    unsigned char signature[SIGNATURE];
    for (int i = 0; i < SIGNATURE; i++)
        signature[i] = (unsigned char)(crc >> 8 * i & 0xff);
    fw_mask_octets_bytes(&w->file, signature, SIGNATURE);
}

/* what a reader holds as current is forgotten at every cell (P39, 10) */
static fw_status write_cell(writer *w, fw_arena *arena, const oasis_cell *c, int number) {
    fw_mask_octets_number(&w->file, CELL);
    fw_mask_octets_number(&w->file, (uint64_t)number);
    w->cell = (fw_mask_octets){.arena = arena};
    w->layer = w->datatype = -1;
    w->x = w->y = 0;
    w->before = NULL;
    w->mask = c->mask;
    group *list;
    int n = 0, *follow;
    if (c->mask) FW_TRY(make_groups(arena, c->mask, &list, &n, &follow));
    for (int i = 0; i < n; i++)
        FW_TRY(polygons(w, arena, &list[i], follow));
    for (int i = 0; i < c->nplace; i++)
        placement(&w->cell, &c->place[i]);
    texts(w, c);
    if (w->cell.failed) return FW_NOMEM;
    return w->cell.length ? compressed(arena, &w->file, &w->cell) : FW_OK;
}

static fw_status write_file(writer *w, fw_arena *arena, const oasis_cell *cell, int ncell) {
    fw_mask_octets_bytes(&w->file, "%SEMI-OASIS\r\n", 13);
    fw_mask_octets_number(&w->file, START);
    fw_mask_octets_string(&w->file, "1.0");
    fw_mask_octets_number(&w->file, 0); /* a real of kind 0: a whole number */
    fw_mask_octets_number(&w->file, GRID_PER_UM);
    fw_mask_octets_number(&w->file, 1); /* the places of the tables are in END */
    for (int i = 0; i < ncell; i++)
        FW_TRY(write_cell(w, arena, &cell[i], i));
    uint64_t cells_at = cell_table(w, cell, ncell), texts_at = text_table(w, cell, ncell),
             layers_at;
    FW_TRY(layer_table(w, arena, &layers_at));
    end(w, cells_at, texts_at, layers_at);
    return w->file.failed ? FW_NOMEM : FW_OK;
}

static fw_status write_cells(const fw_mask_table *table, bool rejected, const oasis_cell *cell,
                             int ncell, fw_text *out) {
    writer w = {.table = table, .rejected = rejected, .file = {.arena = out->arena}};
    FW_TRY(write_file(&w, out->arena, cell, ncell));
    fw_text_bytes(out, w.file.data, w.file.length);
    return fw_text_end(out);
}

/* the lines stand in a column above the die */
fw_status fw_mask_write_oasis(const fw_mask *mask, fw_text *out) {
    oasis_cell cell = {.name = mask->cell,
                       .mask = mask,
                       .note_x = lround(mask->box.x0 * 1e9),
                       .note_step = -LINE_PITCH_DBU};
    if (fw_mask_notes_layer(mask->table) >= 0) {
        FW_TRY(fw_mask_notes(out->arena, mask, &cell.note, &cell.nnote));
        FW_TRY(fw_mask_ports(out->arena, mask, &cell.port, &cell.nport));
    }
    cell.note_y = lround(mask->box.y1 * 1e9) + LINE_PITCH_DBU / 2 +
                  (int64_t)(cell.nnote - 1) * LINE_PITCH_DBU;
    return write_cells(mask->table, mask->rejected, &cell, 1, out);
}

/* the cells and arrays of the plate's GDSII library, and no other; texts stand where those do */
fw_status fw_mask_plate_oasis(const fw_mask_plate *p, fw_text *out) {
    oasis_cell *cell = fw_arena_array(out->arena, oasis_cell, (size_t)p->ncell + 1);
    FW_NEED(cell);
    for (int c = 0; c < p->ncell; c++)
        cell[c] = (oasis_cell){.name = p->cell[c].name, .mask = p->cell[c].mask};
    cell[p->ncell] = (oasis_cell){.name = p->top,
                                  .mask = p->drawn,
                                  .place = p->place,
                                  .nplace = p->nplace,
                                  .note = p->note,
                                  .nnote = p->nnote,
                                  .note_x = p->note_x,
                                  .note_y = p->note_y,
                                  .note_step = p->note_step};
    return write_cells(p->table, p->rejected, cell, p->ncell + 1, out);
}
