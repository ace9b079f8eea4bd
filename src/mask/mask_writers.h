/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the writers of files share: the parts of a GDSII library, the integers of OASIS, and the lines of text. */
#ifndef FW_MASK_MASK_WRITERS_H
#define FW_MASK_MASK_WRITERS_H
#include "base/arena.h"
#include "geometry/polygon.h"
#include "mask/mask.h"
#include <stdbool.h>
#include <stdint.h>

/* one writer for each line of formats.def: same mask, same bytes */
#define FW_MASK_FORMAT(name, ...) fw_status fw_mask_write_##name(const fw_mask *mask, fw_text *out);
#include "mask/formats.def"
#undef FW_MASK_FORMAT

/* A GDSII library for programs that write more polygons than they hold: what stands in the text may
   be taken out (length = 0) between two calls. A library is begin, then for each cell, children
   before parents, cell_begin, its content, cell_end, then end. */
void fw_mask_gds_begin(fw_text *out, const char *library);
void fw_mask_gds_cell_begin(fw_text *out, const char *name);
void fw_mask_gds_boundary(fw_text *out, const fw_mask_layer *layer,
                          const fw_geometry_polygon *polygon);
void fw_mask_gds_cell_end(fw_text *out);
void fw_mask_gds_end(fw_text *out);

/* The lines "key=value" that a mask says about itself, shared by the writers. */
enum { FW_MASK_NOTE_MOST = 512 };
/* one line, "key=value" or the value alone where the key is ""; other bytes than ASCII become '?':
   two of the common readers stop at them */
fw_status fw_mask_note(fw_arena *arena, const char *key, const char *value, const char **line);
/* ASCII, at most 512 characters each, in a fixed order, from the writer's arena */
fw_status fw_mask_notes(fw_arena *arena, const fw_mask *mask, const char ***line, int *count);
/* index of the documentation layer, or -1 */
int fw_mask_notes_layer(const fw_mask_table *table);

/* nets on the certificate; contacts on the order sheets, where something is driven (mask_merge.c) */
void fw_mask_wiring_json(fw_json *json, const fw_mask *mask);
void fw_mask_wiring_order_json(fw_json *json, const fw_mask *mask);
fw_status fw_mask_wiring_order_text(const fw_mask *mask, fw_text *out);
typedef struct
    fw_mask_port { /* a contact as a port of the cell: "port=NET" in the middle of its pad */
    const char *note;
    int32_t x, y; /* dbu */
} fw_mask_port;
fw_status fw_mask_ports(fw_arena *arena, const fw_mask *mask, fw_mask_port **port, int *count);

/* drawings of others on the mask, where there are some (mask_cells.c) */
void fw_mask_cells_json(fw_json *json, const fw_mask *mask);
void fw_mask_cells_order_text(const fw_mask *mask, fw_text *out);

/* which plate of a flow that prints several, as a member; files with their hashes, without the last
   bracket (mask_json.c) */
void fw_mask_json_set(fw_json *json, const fw_mask_table *table, const fw_mask_order *order);
void fw_mask_json_files(fw_json *json, const fw_output_file *file, int n);

/* ---- bytes of an OASIS file: octets.c ----
   A buffer that is made large enough once per record and then filled
   without further checks, and the format's integers. */

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
