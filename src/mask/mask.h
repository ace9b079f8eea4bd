/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Masks: layers from masks/FLOW.xml, exact biased outlines, polygons on the 1 nm grid, writers. */
#ifndef FW_MASK_MASK_H
#define FW_MASK_MASK_H
#include "base/diag.h"
#include "geometry/contour.h"
#include "geometry/tessellate.h"
#include "layout/layout.h"

typedef struct fw_mask_layer { /* a row of masks/FLOW.xml */
    int layer, datatype;
    const char *id, *name, *purpose, *tone, *colour; /* tone: "data clear" or "data dark" */
    unsigned roles;                                  /* bit per fw_role drawn on it */
    bool biased;                                     /* the process bias applies */
    double min_width_m, min_space_m;                 /* design rule; 0 = none */
    const char *rule_source;
    bool documentation; /* TEXT records go here; nothing is drawn */
    fw_place place;     /* in the table */
} fw_mask_layer;

typedef struct fw_mask_table {
    const char *flow, *reading; /* "right-reading chrome down" */
    fw_mask_layer *layer;
    int nlayer;
    const char *order; /* what is on the plate, for the mask shop; may be NULL */
} fw_mask_table;

typedef struct fw_mask_shape {
    int layer; /* index into table->layer */
    const fw_piece *piece;
    fw_contour contour;       /* biased, exact */
    fw_polygon polygon;       /* flattened */
    fw_polygon_report report; /* of the polygon, exact integers */
    double area_m2, bound_m2; /* of the contour; what flattening may change */
} fw_mask_shape;

typedef struct fw_mask_measure { /* per layer */
    int shapes, vertices;
    double area_m2, polygon_area_m2, bound_m2; /* exact contours, flattened, proven difference */
    double perimeter_m;                        /* of the union: joints are not counted */
    double width_m, space_m;              /* least exact ones, square on edges or at corners, below
                                             FW_MASK_LOOK_M; INFINITY beyond */
    double shortest_edge_m, sharpest_rad; /* of the polygons; INFINITY without any */
} fw_mask_measure;
#define FW_MASK_LOOK_M 100e-6

typedef struct fw_mask {
    const fw_mask_table *table;
    const char *cell, *flow;
    fw_mask_shape *shape; /* (nshape) */
    int nshape;
    double bias_m, tolerance_m;
    fw_box box;
    bool rejected;     /* every file says REJECTED */
    const char **note; /* (nnote) lines written on the documentation layer */
    int nnote;
    const char *device, *title;
    const fw_mask_measure *measure; /* (table->nlayer) */
} fw_mask;

fw_status fw_mask_table_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                             fw_diags *diags, fw_mask_table *table);
typedef struct fw_mask_options {
    double bias_m, tolerance_m; /* 0 tolerance: 5 nm */
    bool rejected;
    const char *title;
    const char **note;
    int nnote;
    bool no_islands; /* the flow has no insulating carrier: what is not joined would fall out */
} fw_mask_options;
/* biases, checks the rules, flattens, certifies. A rule that is broken is an error naming both
   places (FW-D140..). */
fw_status fw_mask_build(fw_arena *arena, const fw_layout *layout, const fw_mask_table *table,
                        const char *device_name, const fw_mask_options *options, fw_diags *diags,
                        const fw_mask **mask);

/* writers: same mask, same bytes */
fw_status fw_mask_write_gds(const fw_mask *mask, fw_text *out);
fw_status fw_mask_write_svg(const fw_mask *mask, fw_text *out);
fw_status fw_mask_write_lyp(const fw_mask *mask, fw_text *out);
/* certificate: counts, areas, minimum edge, angle, hash; JSON */
fw_status fw_mask_write_certificate(const fw_mask *mask, const char *gds_sha256, fw_text *out);

#endif
