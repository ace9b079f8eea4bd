/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of GDSII: length u16, type u8, data type u8, payload, all big-endian, strings padded to
   even length. Source: Calma, GDSII Stream Format Manual, release 6.0. Private to the room. */
#include "base/text.h"
#include "mask/mask_parts.h"
#include <math.h>
#include <stdint.h>
#include <string.h>

/* type and data type */
enum {
    FW_GDS_HEADER = 0x0002,
    FW_GDS_BGNLIB = 0x0102,
    FW_GDS_LIBNAME = 0x0206,
    FW_GDS_UNITS = 0x0305,
    FW_GDS_ENDLIB = 0x0400,
    FW_GDS_BGNSTR = 0x0502,
    FW_GDS_STRNAME = 0x0606,
    FW_GDS_ENDSTR = 0x0700,
    FW_GDS_BOUNDARY = 0x0800,
    FW_GDS_SREF = 0x0a00,
    FW_GDS_AREF = 0x0b00,
    FW_GDS_TEXT = 0x0c00,
    FW_GDS_LAYER = 0x0d02,
    FW_GDS_DATATYPE = 0x0e02,
    FW_GDS_XY = 0x1003,
    FW_GDS_ENDEL = 0x1100,
    FW_GDS_SNAME = 0x1206,
    FW_GDS_COLROW = 0x1302,
    FW_GDS_TEXTTYPE = 0x1602,
    FW_GDS_STRING = 0x1906,
};

static inline void gds_u16(fw_text *out, unsigned value) {
    unsigned char b[2] = {(unsigned char)(value >> 8 & 0xff), (unsigned char)(value & 0xff)};
    fw_text_bytes(out, b, sizeof b);
}

static inline void gds_record(fw_text *out, unsigned type, size_t payload) {
    gds_u16(out, (unsigned)(payload + 4));
    gds_u16(out, type);
}

static inline void gds_number(fw_text *out, unsigned type, int value) {
    gds_record(out, type, 2);
    gds_u16(out, (unsigned)value & 0xffff);
}

static inline void gds_string(fw_text *out, unsigned type, const char *s) {
    size_t n = strlen(s), odd = n & 1;
    gds_record(out, type, n + odd);
    fw_text_bytes(out, s, n);
    fw_text_bytes(out, "", odd);
}

static inline void gds_point(fw_text *out, int32_t x, int32_t y) {
    const uint32_t value[] = {(uint32_t)x, (uint32_t)y};
    for (int i = 0; i < 2; i++) {
        gds_u16(out, value[i] >> 16);
        gds_u16(out, value[i] & 0xffff);
    }
}

/* GDSII stream, restricted to what every reader takes in silence: one cell, closed boundaries in
   one XY record, texts, all dates zero. Record = length u16, type u8, data type u8, payload,
   big-endian (Calma GDSII Stream Format Manual, release 6). */

enum { VERSION = 600, LINE_PITCH_DBU = 60000 };

/* real8: sign, 7 bits exponent of 16 plus 64, 56 bits fraction f in [1/16, 1): value = f 16^e.
   In: finite, 16^-64 <= |value| < 16^63, or 0. Out: 8 bytes. Exact for every such double (53 bits
   fit into 56). Source: Calma manual. Test: test_gds.c. */
static void real8(fw_text *out, double value) {
    int two;
    double f = frexp(fabs(value), &two); /* value = f 2^two, f in [1/2, 1) */
    int sixteen = two > 0 ? (two + 3) / 4 : -(-two / 4);
    uint64_t fraction = (uint64_t)ldexp(f, 56 + two - 4 * sixteen);
    unsigned char b[8] = {0};
    if (value != 0) {
        b[0] = (unsigned char)((value < 0 ? 0x80 : 0) | (sixteen + 64));
        for (int i = 1; i < 8; i++)
            b[i] = (unsigned char)(fraction >> (8 * (7 - i)) & 0xff);
    }
    fw_text_bytes(out, b, sizeof b);
}

static void zero_dates(fw_text *out, unsigned type) {
    gds_record(out, type, 24);
    for (int i = 0; i < 12; i++)
        gds_u16(out, 0);
}

/* Both numbers of a point at once: the eight bytes turned round, and their halves exchanged. */
static unsigned char *put_points(unsigned char *at, const fw_geometry_point *p, size_t n) {
    for (size_t i = 0; i < n; i++, at += 8) {
        uint64_t x = (uint32_t)p[i].x_dbu, y = (uint32_t)p[i].y_dbu, big = x << 32 | y;
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
        big = __builtin_bswap64(big);
#endif
        memcpy(at, &big, sizeof big);
    }
    return at;
}

void fw_mask_gds_boundary(fw_text *out, const fw_mask_layer *layer,
                          const fw_geometry_polygon *polygon) {
    gds_record(out, FW_GDS_BOUNDARY, 0);
    gds_number(out, FW_GDS_LAYER, layer->layer);
    gds_number(out, FW_GDS_DATATYPE, layer->datatype);
    gds_record(out, FW_GDS_XY, 8 * ((size_t)polygon->count + 1));
    unsigned char *at = fw_text_room(out, 8 * ((size_t)polygon->count + 1));
    if (at) put_points(put_points(at, polygon->vertex, (size_t)polygon->count), polygon->vertex, 1);
    gds_record(out, FW_GDS_ENDEL, 0);
}

static void text(fw_text *out, const fw_mask_layer *layer, int32_t x, int32_t y, const char *line) {
    gds_record(out, FW_GDS_TEXT, 0);
    gds_number(out, FW_GDS_LAYER, layer->layer);
    gds_number(out, FW_GDS_TEXTTYPE, layer->datatype);
    gds_record(out, FW_GDS_XY, 8);
    gds_point(out, x, y);
    gds_string(out, FW_GDS_STRING, line);
    gds_record(out, FW_GDS_ENDEL, 0);
}

static fw_status texts(const fw_mask *mask, fw_text *out) {
    int k = fw_mask_notes_layer(mask->table);
    if (k < 0) return FW_OK;
    const char **line;
    int n;
    FW_TRY(fw_mask_notes(out->arena, mask, &line, &n));
    /* a column above the die, read downwards: nothing of the device is written over but by its ports */
    int32_t x = (int32_t)lround(mask->box.x0 * 1e9);
    int32_t y = (int32_t)lround(mask->box.y1 * 1e9) + LINE_PITCH_DBU / 2;
    for (int i = 0; i < n; i++)
        text(out, &mask->table->layer[k], x, y + (n - 1 - i) * LINE_PITCH_DBU, line[i]);
    fw_mask_port *port;
    FW_TRY(fw_mask_ports(out->arena, mask, &port, &n));
    for (int i = 0; i < n; i++)
        text(out, &mask->table->layer[k], port[i].x, port[i].y, port[i].note);
    return FW_OK;
}

/* ---- a library of several cells ---- */

void fw_mask_gds_begin(fw_text *out, const char *library) {
    gds_number(out, FW_GDS_HEADER, VERSION);
    zero_dates(out, FW_GDS_BGNLIB);
    gds_string(out, FW_GDS_LIBNAME, library);
    gds_record(out, FW_GDS_UNITS, 16);
    real8(out, 1e-3); /* user unit 1 um */
    real8(out, 1e-9);
}

void fw_mask_gds_cell_begin(fw_text *out, const char *name) {
    zero_dates(out, FW_GDS_BGNSTR);
    gds_string(out, FW_GDS_STRNAME, name);
}

static void shapes(fw_text *out, const fw_mask *mask) {
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        if (s->npart == 0) fw_mask_gds_boundary(out, &mask->table->layer[s->layer], &s->polygon);
        for (int k = 0; k < s->npart; k++)
            fw_mask_gds_boundary(out, &mask->table->layer[s->layer], &s->part[k]);
    }
}

void fw_mask_gds_cell_end(fw_text *out) {
    gds_record(out, FW_GDS_ENDSTR, 0);
}

void fw_mask_gds_end(fw_text *out) {
    gds_record(out, FW_GDS_ENDLIB, 0);
}

fw_status fw_mask_write_gds(const fw_mask *mask, fw_text *out) {
    size_t total = 4096; /* texts may take more */
    for (int i = 0; i < mask->nshape; i++)
        total += 64 + 8 * (size_t)mask->shape[i].polygon.count;
    fw_text_reserve(out, total);
    fw_mask_gds_begin(out, mask->rejected ? "FLEXWRIGHT_REJECTED" : "FLEXWRIGHT");
    fw_mask_gds_cell_begin(out, mask->cell);
    shapes(out, mask);
    FW_TRY(texts(mask, out));
    fw_mask_gds_cell_end(out);
    fw_mask_gds_end(out);
    return fw_text_end(out);
}

/* columns and rows at most 32767; both 1: a plain reference (SREF), else an array (AREF) whose
   corners divide by columns and rows exactly */
static void reference(fw_text *out, const char *cell, fw_geometry_point at, int columns, int rows,
                      fw_geometry_point step) {
    bool one = columns == 1 && rows == 1;
    gds_record(out, one ? FW_GDS_SREF : FW_GDS_AREF, 0);
    gds_string(out, FW_GDS_SNAME, cell);
    if (!one) {
        gds_record(out, FW_GDS_COLROW, 4);
        gds_u16(out, (unsigned)columns);
        gds_u16(out, (unsigned)rows);
    }
    gds_record(out, FW_GDS_XY, one ? 8 : 24);
    gds_point(out, at.x_dbu, at.y_dbu);
    if (!one) {
        gds_point(out, at.x_dbu + columns * step.x_dbu, at.y_dbu);
        gds_point(out, at.x_dbu, at.y_dbu + rows * step.y_dbu);
    }
    gds_record(out, FW_GDS_ENDEL, 0);
}

/* ---- the plate: every different die once, one array per evenly spaced run of equal dies, the top
   cell last. No reader warns: names of at most 32 letters, digits and _, no rotation, array corners
   that divide exactly, dates zero (docs/theory/mask-files.md). ---- */

static size_t plate_bytes(const fw_mask_plate *p) {
    size_t n = 16384 + 96 * (size_t)p->nplace;
    for (int c = 0; c < p->ncell; c++)
        for (int i = 0; i < p->cell[c].mask->nshape; i++)
            n += 64 + 8 * (size_t)p->cell[c].mask->shape[i].polygon.count;
    return n;
}

fw_status fw_mask_plate_gds(const fw_mask_plate *p, fw_text *out) {
    fw_text_reserve(out, plate_bytes(p));
    fw_mask_gds_begin(out, p->rejected ? "FLEXWRIGHT_REJECTED" : "FLEXWRIGHT");
    for (int c = 0; c < p->ncell; c++) {
        fw_mask_gds_cell_begin(out, p->cell[c].name);
        shapes(out, p->cell[c].mask);
        fw_mask_gds_cell_end(out);
    }
    fw_mask_gds_cell_begin(out, p->top);
    if (p->drawn) shapes(out, p->drawn);
    for (int i = 0; i < p->nplace; i++) {
        const fw_mask_plate_place *at = &p->place[i];
        reference(out, p->cell[at->cell].name, (fw_geometry_point){at->x, at->y}, at->columns,
                  at->rows, (fw_geometry_point){at->step_x, at->step_y});
    }
    int k = fw_mask_notes_layer(p->table);
    for (int i = 0; k >= 0 && i < p->nnote; i++)
        text(out, &p->table->layer[k], p->note_x, p->note_y + i * p->note_step, p->note[i]);
    fw_mask_gds_cell_end(out);
    fw_mask_gds_end(out);
    return fw_text_end(out);
}
