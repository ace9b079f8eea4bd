/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Masks: layers from masks/FLOW.xml, exact biased outlines, polygons on the 1 nm grid, writers. */
#ifndef FW_MASK_MASK_H
#define FW_MASK_MASK_H
#include "base/diag.h"
#include "base/output.h"
#include "geometry/contour.h"
#include "geometry/tessellate.h"
#include "layout/content.h"

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
    const char *order;         /* what is on the plate, for the mask shop; may be NULL */
    const char *plate;         /* the same as an expression, "1/0 NOT 2/0"; NULL: not said */
    const fw_pattern *pattern; /* (npattern) of the test die, in the order of the file */
    int npattern;
} fw_mask_table;

typedef struct fw_mask_shape {
    int layer; /* index into table->layer */
    const fw_piece *piece;
    fw_contour contour;       /* biased, exact */
    fw_polygon polygon;       /* flattened */
    fw_polygon *part;         /* (npart) the same, cut to the vertex limit of GDSII */
    int npart;                /* 0: not cut, `polygon` itself */
    fw_polygon_report report; /* of the polygon, exact integers */
    double area_m2, bound_m2; /* of the contour; what flattening may change */
} fw_mask_shape;

typedef struct fw_mask_measure { /* per layer */
    int shapes, vertices;
    double area_m2, polygon_area_m2, bound_m2; /* exact contours, flattened, proven difference */
    double perimeter_m;                        /* of the union: joints are not counted */
    double width_m, space_m;              /* least exact ones, square on edges or at corners, below
                                             FW_MASK_LOOK_M; INFINITY beyond */
    fw_vec2 width_at[2], space_at[2];     /* ends of these chords */
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
    int vertex_limit;  /* of one GDSII boundary */
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
    int vertex_limit;           /* 0: 4094; else 8 to 8190 */
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

/* ---- the test die: the patterns of the table on a die of the device's size ---- */
typedef struct fw_mask_coupons {
    const fw_mask *mask; /* as any other: written, certified and placed on a wafer likewise */
    const fw_content *content;
} fw_mask_coupons;
typedef struct fw_coupon_options {
    fw_box die;             /* with its lane: layout->die of the device */
    double frame_m, lane_m; /* NAN: as devices have them */
    const char *die_id;     /* lettered on the frame; NULL: none */
    fw_mask_options mask;   /* the same as for the device: bias, tolerance, title, notes */
} fw_coupon_options;
/* *coupons NULL where the table has no <pattern>. The mask's own bias is 0: the process bias is in
   the outlines of the patterns that ask for it, and in no other. Cell "TEST_FLOW". */
fw_status fw_mask_coupons_build(fw_arena *arena, const fw_mask_table *table,
                                const fw_coupon_options *options, fw_diags *diags,
                                const fw_mask_coupons **coupons);
/* the device's drawing with the marks that the table has for its frame; the device itself where it
   has none */
fw_status fw_mask_frame_marks(fw_arena *arena, const fw_mask_table *table, const fw_layout *device,
                              const fw_layout **layout, int *left_out);
/* the certificate and, in `coupons`, every pattern: place, drawn sizes, what to measure and which
   quantity of the process it gives */
fw_status fw_mask_write_coupons(const fw_mask_coupons *coupons, const char *gds_sha256,
                                fw_text *out);

/* writers: same mask, same bytes */
fw_status fw_mask_write_gds(const fw_mask *mask, fw_text *out);
fw_status fw_mask_write_svg(const fw_mask *mask, fw_text *out);
fw_status fw_mask_write_lyp(const fw_mask *mask, fw_text *out);
fw_status fw_mask_write_oasis(const fw_mask *mask, fw_text *out);
/* name of layer k in DXF; NULL: out of memory */
const char *fw_mask_dxf_layer(fw_arena *arena, const fw_mask *mask, int k);
fw_status fw_mask_write_dxf(const fw_mask *mask, fw_text *out);
fw_status fw_mask_write_lyt(const fw_mask *mask, fw_text *out);

typedef struct fw_mask_format { /* a row of format.c */
    const char *name, *ending;  /* as the user says it; of the file */
    fw_status (*write)(const fw_mask *mask, fw_text *out);
    bool always, usual; /* whatever is asked for; when nothing is asked for */
} fw_mask_format;
const fw_mask_format *fw_mask_format_at(size_t i); /* NULL behind the last row */
/* bit i for row i. list: names with commas between, "all", or NULL for the usual ones; false: a
   name is not known */
bool fw_mask_formats(const char *list, unsigned *set);

/* certificate: counts, areas, minimum edge, angle, hash; JSON */
fw_status fw_mask_write_certificate(const fw_mask *mask, const char *gds_sha256, fw_text *out);
/* order sheet for the mask shop, as JSON and for people, with the files that go with it */
fw_status fw_mask_write_order(const fw_mask *mask, const fw_output_file *file, int nfile,
                              fw_text *out);
fw_status fw_mask_write_order_text(const fw_mask *mask, const fw_output_file *file, int nfile,
                                   fw_text *out);

#endif
