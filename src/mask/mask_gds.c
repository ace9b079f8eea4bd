/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GDSII stream, restricted to what every reader takes in silence: one cell, closed boundaries in
   one XY record, texts, all dates zero. Record = length u16, type u8, data type u8, payload,
   big-endian (Calma GDSII Stream Format Manual, release 6). */
#include "mask/mask_notes.h"
#include "mask/records.h"
#include "mask/stream.h"
#include <math.h>
#include <string.h>

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
    fw_gds_record(out, type, 24);
    for (int i = 0; i < 12; i++)
        fw_gds_u16(out, 0);
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
    fw_gds_record(out, FW_GDS_BOUNDARY, 0);
    fw_gds_number(out, FW_GDS_LAYER, layer->layer);
    fw_gds_number(out, FW_GDS_DATATYPE, layer->datatype);
    fw_gds_record(out, FW_GDS_XY, 8 * ((size_t)polygon->count + 1));
    unsigned char *at = fw_text_room(out, 8 * ((size_t)polygon->count + 1));
    if (at) put_points(put_points(at, polygon->vertex, (size_t)polygon->count), polygon->vertex, 1);
    fw_gds_record(out, FW_GDS_ENDEL, 0);
}

static void text(fw_text *out, const fw_mask_layer *layer, int32_t x, int32_t y, const char *line) {
    fw_gds_record(out, FW_GDS_TEXT, 0);
    fw_gds_number(out, FW_GDS_LAYER, layer->layer);
    fw_gds_number(out, FW_GDS_TEXTTYPE, layer->datatype);
    fw_gds_record(out, FW_GDS_XY, 8);
    fw_gds_point(out, x, y);
    fw_gds_string(out, FW_GDS_STRING, line);
    fw_gds_record(out, FW_GDS_ENDEL, 0);
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

void fw_mask_gds_begin(fw_text *out, const char *library) {
    fw_gds_number(out, FW_GDS_HEADER, VERSION);
    zero_dates(out, FW_GDS_BGNLIB);
    fw_gds_string(out, FW_GDS_LIBNAME, library);
    fw_gds_record(out, FW_GDS_UNITS, 16);
    real8(out, 1e-3); /* user unit 1 um */
    real8(out, 1e-9);
}

void fw_mask_gds_cell_begin(fw_text *out, const char *name) {
    zero_dates(out, FW_GDS_BGNSTR);
    fw_gds_string(out, FW_GDS_STRNAME, name);
}

void fw_mask_gds_shapes(fw_text *out, const fw_mask *mask) {
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        if (s->npart == 0) fw_mask_gds_boundary(out, &mask->table->layer[s->layer], &s->polygon);
        for (int k = 0; k < s->npart; k++)
            fw_mask_gds_boundary(out, &mask->table->layer[s->layer], &s->part[k]);
    }
}

void fw_mask_gds_cell_end(fw_text *out) {
    fw_gds_record(out, FW_GDS_ENDSTR, 0);
}

void fw_mask_gds_end(fw_text *out) {
    fw_gds_record(out, FW_GDS_ENDLIB, 0);
}

fw_status fw_mask_write_gds(const fw_mask *mask, fw_text *out) {
    size_t total = 4096; /* texts may take more */
    for (int i = 0; i < mask->nshape; i++)
        total += 64 + 8 * (size_t)mask->shape[i].polygon.count;
    fw_text_reserve(out, total);
    fw_mask_gds_begin(out, mask->rejected ? "FLEXWRIGHT_REJECTED" : "FLEXWRIGHT");
    fw_mask_gds_cell_begin(out, mask->cell);
    fw_mask_gds_shapes(out, mask);
    FW_TRY(texts(mask, out));
    fw_mask_gds_cell_end(out);
    fw_mask_gds_end(out);
    return fw_text_end(out);
}
