/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laboratory's own layer numbers and names, instead of those of masks/FLOW.xml. A small text,
   one line for each layer:

       # what stands behind a # is for people
       structure 7/0 name POLY2
       text      7/10
       flow copper-on-porous-silicon
       lane      name SAW

   LAYER [NUMBER/DATATYPE] [name NAME]. LAYER is the id of a layer of the table, or a role that is
   drawn on it (structure, text, mark, ...), or "plate": the one layer of the plate as it is written. Lines below `flow NAME` are for that flow alone, lines
   above the first one for every flow. Numbers are 0 to 65535. */
#ifndef FW_MASK_LAYER_MAP_H
#define FW_MASK_LAYER_MAP_H
#include "mask/mask.h"

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
/* the layer that a role, as the table says it, is drawn on; -1: none */
int fw_mask_layer_of_role(const fw_mask_table *table, const char *role);

#endif
