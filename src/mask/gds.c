/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GDSII stream, restricted to what every reader takes in silence: one cell, closed boundaries in
   one XY record, texts, all dates zero. Record = length u16, type u8, data type u8, payload,
   big-endian (Calma GDSII Stream Format Manual, release 6). */
#include "mask/notes.h"
#include "mask/stream.h"
#include <math.h>
#include <string.h>

enum {
    HEADER = 0x0002,
    BGNLIB = 0x0102,
    LIBNAME = 0x0206,
    UNITS = 0x0305,
    ENDLIB = 0x0400,
    BGNSTR = 0x0502,
    STRNAME = 0x0606,
    ENDSTR = 0x0700,
    BOUNDARY = 0x0800,
    TEXT = 0x0c00,
    LAYER = 0x0d02,
    DATATYPE = 0x0e02,
    XY = 0x1003,
    ENDEL = 0x1100,
    TEXTTYPE = 0x1602,
    STRING = 0x1906,
    VERSION = 600,
    LINE_PITCH_DBU = 60000,
};

static void u16(fw_text *out, unsigned value) {
    unsigned char b[2] = {(unsigned char)(value >> 8 & 0xff), (unsigned char)(value & 0xff)};
    fw_text_bytes(out, b, sizeof b);
}

static unsigned char *put_i32(unsigned char *at, int32_t value) {
    uint32_t v = (uint32_t)value;
    at[0] = (unsigned char)(v >> 24), at[1] = (unsigned char)(v >> 16 & 0xff);
    at[2] = (unsigned char)(v >> 8 & 0xff), at[3] = (unsigned char)(v & 0xff);
    return at + 4;
}

static void point(fw_text *out, int32_t x, int32_t y) {
    unsigned char *at = fw_text_room(out, 8);
    if (at) put_i32(put_i32(at, x), y);
}

static void record(fw_text *out, unsigned type, size_t payload) {
    u16(out, (unsigned)(payload + 4));
    u16(out, type);
}

static void number(fw_text *out, unsigned type, int value) {
    record(out, type, 2);
    u16(out, (unsigned)value & 0xffff);
}

static void string(fw_text *out, unsigned type, const char *s) {
    size_t n = strlen(s), odd = n & 1;
    record(out, type, n + odd);
    fw_text_bytes(out, s, n);
    fw_text_bytes(out, "", odd);
}

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
    record(out, type, 24);
    for (int i = 0; i < 12; i++)
        u16(out, 0);
}

static void boundary(fw_text *out, const fw_mask_layer *layer, const fw_polygon *polygon) {
    record(out, BOUNDARY, 0);
    number(out, LAYER, layer->layer);
    number(out, DATATYPE, layer->datatype);
    record(out, XY, 8 * ((size_t)polygon->count + 1));
    unsigned char *at = fw_text_room(out, 8 * ((size_t)polygon->count + 1));
    for (int i = 0; at && i < polygon->count; i++)
        at = put_i32(put_i32(at, polygon->vertex[i].x_dbu), polygon->vertex[i].y_dbu);
    if (at) put_i32(put_i32(at, polygon->vertex[0].x_dbu), polygon->vertex[0].y_dbu); /* closed */
    record(out, ENDEL, 0);
}

static void text(fw_text *out, const fw_mask_layer *layer, int32_t x, int32_t y, const char *line) {
    record(out, TEXT, 0);
    number(out, LAYER, layer->layer);
    number(out, TEXTTYPE, layer->datatype);
    record(out, XY, 8);
    point(out, x, y);
    string(out, STRING, line);
    record(out, ENDEL, 0);
}

static fw_status texts(const fw_mask *mask, fw_text *out) {
    int k = fw_mask_notes_layer(mask->table);
    if (k < 0) return FW_OK;
    const char **line;
    int n;
    FW_TRY(fw_mask_notes(out->arena, mask, &line, &n));
    /* a column above the die, read downwards: nothing of the device is written over */
    int32_t x = (int32_t)lround(mask->box.x0 * 1e9);
    int32_t y = (int32_t)lround(mask->box.y1 * 1e9) + LINE_PITCH_DBU / 2;
    for (int i = 0; i < n; i++)
        text(out, &mask->table->layer[k], x, y + (n - 1 - i) * LINE_PITCH_DBU, line[i]);
    return FW_OK;
}

/* ---- a library of several cells ---- */

void fw_gds_begin(fw_text *out, const char *library) {
    number(out, HEADER, VERSION);
    zero_dates(out, BGNLIB);
    string(out, LIBNAME, library);
    record(out, UNITS, 16);
    real8(out, 1e-3); /* user unit 1 um */
    real8(out, 1e-9);
}

void fw_gds_cell_begin(fw_text *out, const char *name) {
    zero_dates(out, BGNSTR);
    string(out, STRNAME, name);
}

void fw_gds_shapes(fw_text *out, const fw_mask *mask) {
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        if (s->npart == 0) boundary(out, &mask->table->layer[s->layer], &s->polygon);
        for (int k = 0; k < s->npart; k++)
            boundary(out, &mask->table->layer[s->layer], &s->part[k]);
    }
}

void fw_gds_cell_end(fw_text *out) {
    record(out, ENDSTR, 0);
}

void fw_gds_end(fw_text *out) {
    record(out, ENDLIB, 0);
}

fw_status fw_mask_write_gds(const fw_mask *mask, fw_text *out) {
    size_t total = 4096; /* texts may take more */
    for (int i = 0; i < mask->nshape; i++)
        total += 64 + 8 * (size_t)mask->shape[i].polygon.count;
    fw_text_reserve(out, total);
    fw_gds_begin(out, mask->rejected ? "FLEXWRIGHT_REJECTED" : "FLEXWRIGHT");
    fw_gds_cell_begin(out, mask->cell);
    fw_gds_shapes(out, mask);
    FW_TRY(texts(mask, out));
    fw_gds_cell_end(out);
    fw_gds_end(out);
    return fw_text_end(out);
}
