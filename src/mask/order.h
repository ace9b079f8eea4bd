/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the order sheet says, gathered once for its two forms. Private to the room. */
#ifndef FW_MASK_ORDER_H
#define FW_MASK_ORDER_H
#include "mask/mask.h"

typedef struct fw_mask_order_site { /* where the shop, and later the laboratory, measures */
    int layer;                      /* index into the table */
    const char *what;               /* "least width", "least space", or the label of a flexure */
    bool space;                     /* between polygons, not through one */
    fw_geometry_vec2 from, to;      /* ends of the chord, on the exact outlines */
} fw_mask_order_site;

typedef struct fw_mask_order {
    const char *name;  /* of the mask */
    const char *tone;  /* of the plate's polygons: "data clear", "data dark"; NULL: not said */
    const char *field; /* "dark" or "clear": what is where there are no polygons */
    int mirror;        /* 1: seen with the chrome up the plate is the data's mirror image; 0: not;
                          -1: the table's reading does not say */
    double width_m, space_m;  /* least ones on the plate's layers; INFINITY: none below 100 um */
    bool *plate;              /* (nlayer of the table): is it on the plate? */
    fw_mask_order_site *site; /* (nsite) */
    int nsite;
    int polygons, vertices; /* of the plate's layers in the GDSII file */
} fw_mask_order;

fw_status fw_mask_order_gather(fw_arena *arena, const fw_mask *mask, fw_mask_order *order);
fw_status fw_mask_order_sites(fw_arena *arena, const fw_mask *mask, fw_mask_order *order);

/* boundaries of one layer in the GDSII file */
void fw_mask_order_count(const fw_mask *mask, int layer, int *polygons, int *vertices);

/* "1/0 NOT 2/0": terms "LAYER/DATATYPE" with AND, OR, NOT, XOR between them, applied from the left.
   Marks the layers named (NULL: does not) and says which comes first, -1 where nothing is said;
   false: not of this form, or a layer is not in the table (*wrong is where) */
bool fw_mask_plate_layers(const fw_mask_table *table, bool *named, int *first, const char **wrong);

#endif
