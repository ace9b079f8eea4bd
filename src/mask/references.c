/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of the Calma manual, as in gds.c: length u16, type u8, data type u8, payload, big-endian.
 */
#include "mask/references.h"
#include <string.h>

enum {
    SREF = 0x0a00,
    AREF = 0x0b00,
    TEXT = 0x0c00,
    LAYER = 0x0d02,
    XY = 0x1003,
    ENDEL = 0x1100,
    SNAME = 0x1206,
    COLROW = 0x1302,
    TEXTTYPE = 0x1602,
    STRING = 0x1906,
};

static void u16(fw_text *out, unsigned value) {
    unsigned char b[2] = {(unsigned char)(value >> 8 & 0xff), (unsigned char)(value & 0xff)};
    fw_text_bytes(out, b, sizeof b);
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

static void point(fw_text *out, int32_t x, int32_t y) {
    const uint32_t value[] = {(uint32_t)x, (uint32_t)y};
    for (int i = 0; i < 2; i++) {
        u16(out, value[i] >> 16);
        u16(out, value[i] & 0xffff);
    }
}

void fw_gds_array(fw_text *out, const char *cell, fw_point at, int columns, int rows,
                  fw_point step) {
    bool one = columns == 1 && rows == 1;
    record(out, one ? SREF : AREF, 0);
    string(out, SNAME, cell);
    if (!one) {
        record(out, COLROW, 4);
        u16(out, (unsigned)columns);
        u16(out, (unsigned)rows);
    }
    record(out, XY, one ? 8 : 24);
    point(out, at.x_dbu, at.y_dbu);
    if (!one) {
        point(out, at.x_dbu + columns * step.x_dbu, at.y_dbu);
        point(out, at.x_dbu, at.y_dbu + rows * step.y_dbu);
    }
    record(out, ENDEL, 0);
}

void fw_gds_note(fw_text *out, const fw_mask_layer *layer, fw_point at, const char *line) {
    record(out, TEXT, 0);
    number(out, LAYER, layer->layer);
    number(out, TEXTTYPE, layer->datatype);
    record(out, XY, 8);
    point(out, at.x_dbu, at.y_dbu);
    string(out, STRING, line);
    record(out, ENDEL, 0);
}
