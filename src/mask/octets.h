/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bytes of an OASIS file: a buffer that is made large enough once per record and then filled
   without further checks, and the format's integers. Private to the room. */
#ifndef FW_MASK_OCTETS_H
#define FW_MASK_OCTETS_H
#include "base/arena.h"
#include "geometry/polygon.h"
#include <stdbool.h>
#include <stdint.h>

typedef struct fw_mask_octets {
    fw_arena *arena;
    unsigned char *data;
    size_t length, capacity;
    bool failed; /* out of memory: sticks */
} fw_mask_octets;

enum { FW_OCTETS_INTEGER = 10 }; /* the longest integer: ten times 7 bits */

/* room for `more` bytes behind the last one; false: failed */
bool fw_mask_octets_room(fw_mask_octets *octets, size_t more);
void fw_mask_octets_bytes(fw_mask_octets *octets, const void *data, size_t n);
void fw_mask_octets_number(fw_mask_octets *octets, uint64_t value); /* makes room itself */
void fw_mask_octets_signed(fw_mask_octets *octets, int64_t value);
void fw_mask_octets_string(fw_mask_octets *octets, const char *text); /* length, bytes */

/* where to write next, the new end; 7 bits per byte, low ones first, high bit set but in the last
 */
static inline unsigned char *fw_octets_put(unsigned char *at, uint64_t value) {
    while (value > 0x7f) {
        *at++ = (unsigned char)(0x80 | (value & 0x7f));
        value >>= 7;
    }
    *at++ = (unsigned char)value;
    return at;
}

/* the sign is the lowest bit */
static inline uint64_t fw_octets_folded(int64_t value) {
    return value < 0 ? (uint64_t)(-value) << 1 | 1 : (uint64_t)value << 1;
}

/* a displacement of any direction ("g-delta"); at most 2 FW_OCTETS_INTEGER bytes */
unsigned char *fw_mask_octets_displacement(unsigned char *at, int64_t dx, int64_t dy);

/* the vertices of a polygon behind its first one, in the shortest kind of point list */
void fw_mask_octets_points(fw_mask_octets *octets, const fw_geometry_polygon *polygon);

#endif
