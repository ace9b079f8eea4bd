/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the reader of layer tables shares: the rows <plate> and <content> of a flow that prints several plates with
   the kinds of content, and the laboratory's own layer numbers. Private to the room, but for the latter. */
#ifndef FW_MASK_MASK_TABLE_H
#define FW_MASK_MASK_TABLE_H
#include "mask/mask.h"
#include "xml/xml_reader.h"

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
