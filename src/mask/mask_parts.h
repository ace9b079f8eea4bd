/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of masks share: the parts of a GDSII library, the integers of OASIS and lines of text, for the writers; the
   rows <plate> and <content> of a flow that prints several plates with the kinds of content, and the laboratory's own layer
   numbers, for the reader of layer tables; and what leads from exact outlines to polygons: joints between pieces, necks,
   flattening, bounds, corners, cuts. Private to the room, but for the numbers and for those who write libraries themselves. */
#ifndef FW_MASK_MASK_PARTS_H
#define FW_MASK_MASK_PARTS_H
#include "base/arena.h"
#include "geometry/polygon.h"
#include "geometry/segment.h"
#include "mask/mask.h"
#include "xml/xml_reader.h"
#include <stdbool.h>
#include <stdint.h>

/* ---- writers ---- */

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

/* ---- from outlines to polygons ---- */

/* Finds the partner of every JOINT segment among the shapes of each layer (drawn outlines, bit for
   bit), makes the biased end points of both the same bits, and marks the joint as inner. Distances
   above 1e-12 m and missing partners are FW-D146. */
fw_status fw_mask_join(fw_arena *arena, fw_mask_shape *shape, int nshape, fw_diags *diags);
/* mask_cells.c: the bias of cells that have holes, of which the outlines of all their parts are moved as they were drawn,
   and cut anew; after fw_mask_join. FW-D143 where outlines meet. Is a shape of such a cell? */
fw_status fw_mask_cells_bias(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                             fw_diags *diags);
bool fw_mask_cell_is_cut(const fw_mask *mask, int shape);
/* mask_cells.c: cells that lie on the frame become one with it, as they are on the mask; after fw_mask_join */
fw_status fw_mask_cells_unite(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                              fw_diags *diags);

/* after flattening: both sides of every joint share the same two grid points (FW-D146) */
fw_status fw_mask_check_joints(fw_arena *arena, const fw_mask_shape *shape, int nshape,
                               fw_diags *diags);

/* warns of corners that the grid made sharper than 90 degrees (FW-D153), once per shape; ends of
   joints are no corners */
void fw_mask_check_corners(const fw_mask_shape *shape, int nshape, fw_diags *diags);

/* "(123.456, -7.89) um" for messages; `text` holds at least 80 bytes */
const char *fw_mask_place_text(char *text, size_t n, fw_geometry_vec2 at);

/* the hinge that a place belongs to; NULL: none */
const fw_layout_hinge_layout *fw_mask_hinge_at(const fw_layout *layout, fw_geometry_vec2 at);
/* "; the place belongs to hinge A, ..." for messages, with what to do; "" where it is of none */
const char *fw_mask_cause(fw_arena *arena, const fw_layout *layout, fw_geometry_vec2 at);

/* ---- flattening ---- */

/* how all shapes are to be flattened */
void fw_mask_set_flattening(fw_mask_shape *shape, int nshape, fw_geometry_flattening kind);
/* Where a chord between two edges is shortest: of parallel or concentric ones in the middle. */
fw_geometry_chord fw_mask_narrowest(const fw_geometry_segment *p, const fw_geometry_segment *q);
typedef struct fw_mask_wavy_arc { /* for which a tolerance is too small */
    bool there;
    fw_geometry_segment arc;
    double next_m; /* the tolerance that takes one chord less */
} fw_mask_wavy_arc;

/* polygon, bounds and, of a flexure, the neck, whose ends on arcs become vertices (below 1.42 nm
   where that can be proven). FW_GEOMETRY with wavy->there: an arc that cannot */
fw_status fw_mask_flatten(fw_arena *arena, fw_mask_shape *shape, double tolerance_m,
                          fw_mask_wavy_arc *wavy);

/* of a layer: shortest edge, sharpest corners, farthest edge, straight vertices, box */
void fw_mask_measure_start(fw_mask_measure *measure);
void fw_mask_measure_add(fw_mask_measure *measure, const fw_mask_shape *shape);

/* ---- polygons of more vertices than a reader takes ---- */

/* what a cut keeps to every vertex, as a share of the shortest edge, where it can */
#define FW_CUT_SHARE 0.9

/* Cuts along straight lines between existing vertices until no part has more than `most` >= 8 of
   them. The parts share their cut edges, point by point; nothing is moved or added. One part where
   nothing is to be cut. clear_dbu (may be NULL): no cut is nearer to a vertex that it does not end
   at; INFINITY where nothing is cut. FW_GEOMETRY: no cut was found. */
fw_status fw_mask_polygon_cut(fw_arena *arena, const fw_geometry_polygon *polygon, int most,
                              fw_geometry_polygon **part, int *npart, double *clear_dbu);

/* finds the nets that were asked for on the mask, FW-D441 where they differ: in `wired`; `wiring` becomes NULL where
   it is of another layout */
fw_status fw_mask_wiring_check(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                               fw_diags *diags);

/* ---- plates and contents ---- */

typedef struct fw_mask_content_parameter {
    const char *name;   /* attribute of <content> */
    double usual;       /* m; NAN: must be stated */
    double least, most; /* m */
    const char *sentence;
} fw_mask_content_parameter;

typedef struct fw_mask_sheet { /* pieces that a content adds to a drawing */
    fw_arena *arena;
    const fw_layout *device;
    fw_layout_piece *piece;
    int npiece, capacity;
} fw_mask_sheet;
fw_status fw_mask_sheet_add(fw_mask_sheet *sheet, fw_layout_role role, int body, const char *label,
                            const fw_geometry_contour *contour);

/* one reason more; text NULL: FW_NOMEM */
fw_status fw_mask_verdict_add(fw_mask_verdict *verdict, const char *text);
double fw_mask_overlay_between_m(const fw_mask_table *table, int a, int b); /* of two plates */

typedef struct fw_mask_content_kind { /* a row: one for each line of contents.def */
    const char *name, *what;
    fw_mask_content_parameter parameter[FW_CONTENT_PARAMETERS];
    int nparameter;
    fw_status (*draw)(const fw_mask_content *content, fw_mask_sheet *sheet);
    /* adds why the device cannot be made with it; layout: without what other contents draw */
    fw_status (*judge)(const fw_mask_content *content, const fw_mask_table *table,
                       const fw_layout *layout, fw_mask_verdict *verdict);
} fw_mask_content_kind;

extern const fw_xml_element_row fw_mask_plate_rows[];
fw_status fw_mask_plates_build(fw_xml_reader *r, fw_mask_table *table);
fw_status fw_mask_contents_build(fw_xml_reader *r, fw_mask_table *table);

/* ---- the laboratory's own layer numbers and names ----
   The laboratory's own layer numbers and names, instead of those of masks/FLOW.xml. A small text,
   one line for each layer:

       # what stands behind a # is for people
       structure 7/0 name POLY2
       text      7/10
       flow copper-on-porous-silicon
       lane      name SAW

   LAYER [NUMBER/DATATYPE] [name NAME]. LAYER is the id of a layer of the table, or a role that is
   drawn on it (structure, text, mark, ...), or "plate": the one layer of the plate as it is written. Lines
   below `flow NAME` are for that flow alone, lines above the first one for every flow. Numbers are 0 to 65535. */

enum { FW_MASK_LARGEST_NUMBER = 65535 };

typedef struct fw_mask_layer_entry {
    const char *layer, *flow; /* flow NULL: of every flow */
    int number, datatype;     /* -1: stays */
    const char *name;         /* NULL: stays */
    fw_place place, number_place, name_place;
    bool used;
} fw_mask_layer_entry;

typedef struct fw_mask_layer_map { /* a file */
    fw_mask_layer_entry *entry;    /* (n) */
    int n;
} fw_mask_layer_map;

/* FW_INPUT: lines that cannot be read, each with its line and column (FW-D380) */
fw_status fw_mask_layer_map_read(fw_arena *arena, const char *file, const char *text, size_t n,
                                 fw_diags *diags, fw_mask_layer_map *map);
/* into a table as it was read: numbers, names, and the numbers in what it says of the plate.
   FW_INPUT: two layers would have one number or one name (FW-D382) */
fw_status fw_mask_layer_map_apply(fw_arena *arena, fw_mask_layer_map *map, fw_mask_table *table,
                                  fw_diags *diags);
/* after all flows: lines that no layer answers to. FW_INPUT (FW-D381) where a flow that is planned
   lacks it, a warning where no such flow is planned */
fw_status fw_mask_layer_map_finish(fw_arena *arena, const fw_mask_layer_map *map,
                                   const fw_mask_table *const *table, int ntable, fw_diags *diags);

/* "7/0" and nothing behind it, both 0 to FW_MASK_LARGEST_NUMBER */
bool fw_mask_gds_pair(const char *text, int *number, int *datatype);
/* 1 to 32 of A-Z a-z 0-9 _ - */
bool fw_mask_is_name(const char *text);
const char *const *fw_mask_role_names(void); /* as tables have them; NULL behind the last */
/* the layer that a role, as the table says it, is drawn on; -1: none */
int fw_mask_layer_of_role(const fw_mask_table *table, const char *role);
#endif
