/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of GDSII: length u16, type u8, data type u8, payload, all big-endian, strings padded to
   even length. Source: Calma, GDSII Stream Format Manual, release 6.0. Private to the room. */
#ifndef FW_MASK_RECORDS_H
#define FW_MASK_RECORDS_H
#include "base/text.h"
#include <stdint.h>
#include <string.h>

enum { /* type and data type */
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

static inline void fw_gds_u16(fw_text *out, unsigned value) {
    unsigned char b[2] = {(unsigned char)(value >> 8 & 0xff), (unsigned char)(value & 0xff)};
    fw_text_bytes(out, b, sizeof b);
}

static inline void fw_gds_record(fw_text *out, unsigned type, size_t payload) {
    fw_gds_u16(out, (unsigned)(payload + 4));
    fw_gds_u16(out, type);
}

static inline void fw_gds_number(fw_text *out, unsigned type, int value) {
    fw_gds_record(out, type, 2);
    fw_gds_u16(out, (unsigned)value & 0xffff);
}

static inline void fw_gds_string(fw_text *out, unsigned type, const char *s) {
    size_t n = strlen(s), odd = n & 1;
    fw_gds_record(out, type, n + odd);
    fw_text_bytes(out, s, n);
    fw_text_bytes(out, "", odd);
}

static inline void fw_gds_point(fw_text *out, int32_t x, int32_t y) {
    const uint32_t value[] = {(uint32_t)x, (uint32_t)y};
    for (int i = 0; i < 2; i++) {
        fw_gds_u16(out, value[i] >> 16);
        fw_gds_u16(out, value[i] & 0xffff);
    }
}

#endif
