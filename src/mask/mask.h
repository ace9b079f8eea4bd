/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Masks: layers from masks/FLOW.xml, exact biased outlines, polygons on the 1 nm grid, writers. */
#ifndef FW_MASK_MASK_H
#define FW_MASK_MASK_H
#include "base/diag.h"
#include "base/json.h"
#include "base/output.h"
#include "geometry/contour.h"
#include "geometry/polygon.h"
#include "layout/pattern.h"
#include "wiring/wiring.h"

typedef struct fw_mask_layer { /* a row of masks/FLOW.xml */
    int layer, datatype;
    const char *id, *name, *purpose, *tone, *colour; /* tone: "data clear" or "data dark" */
    unsigned roles;                                  /* bit per fw_layout_role drawn on it */
    bool biased;                                     /* the process bias applies */
    double min_width_m, min_space_m;                 /* design rule; 0 = none */
    const char *rule_source;
    bool documentation; /* TEXT records go here; nothing is drawn */
    /* quantity of the flow by which its step widens, or narrows, what is printed: the plate is drawn so
       much smaller, or larger, at every edge; NULL: by none */
    const char *shrink, *grow;
    fw_place place; /* in the table */
} fw_mask_layer;

/* ---- design rules: rows of the table, and what breaks them ---- */
struct fw_mask_rule_kind_row; /* a kind of rule: rule.h */
/* what a rule looks at, where it can look at several things */
enum {
    FW_OF_OUTLINE = 1, /* exact lines and arcs */
    FW_OF_POLYGON = 2, /* what is written */
    FW_OF_ISLAND = 4,
    FW_OF_HOLE = 8,
};
typedef struct fw_mask_rule {
    const struct fw_mask_rule_kind_row *kind;
    int layer, other;        /* indices into table->layer; other -1: the rule has one layer */
    double least, most;      /* m, rad, m2 or a share; 0 and INFINITY: not asked for */
    double window_m, step_m; /* of a density */
    unsigned of;             /* FW_OF_... */
    const char *formula; /* the limit as it stands in the table; NULL: a layer's own attribute */
    const char *source;
    fw_severity severity; /* FW_ERROR: the mask is not made */
    fw_place place;
} fw_mask_rule;

typedef struct fw_mask_finding { /* one place where a rule is broken */
    const fw_mask_rule *rule;
    const char *what; /* "width", "space", "corner", ... */
    /* the two ends of the worst chord or edge; twice the same point of a corner */
    fw_geometry_vec2 at[2];
    fw_geometry_box box;  /* all of the place, m */
    double value;         /* in the rule's unit */
    double limit;         /* what the rule says */
    double needed;        /* the same: what is written is judged, and nothing is allowed for it */
    const char *label[2]; /* pieces; NULL: none */
    int edge[2];          /* of their outlines; -1: none */
} fw_mask_finding;

/* <content>: what a plate draws besides the device, found from the device's drawing; kinds are rows of
   contents.def (mask_parts.h) */
struct fw_mask_content_kind;
enum { FW_CONTENT_PARAMETERS = 4 };
typedef struct fw_mask_content {
    const struct fw_mask_content_kind *kind;
    double value[FW_CONTENT_PARAMETERS]; /* in the order of the kind's parameters */
    const char *source;
    fw_place place;
} fw_mask_content;

/* a plate that the flow prints: <plate>, or the attributes of a table that has only one */
typedef struct fw_mask_plate_row {
    const char *id, *title;
    const char *layers;     /* "1/0 NOT 2/0"; NULL: not said */
    const char *reading;    /* "right-reading chrome down" */
    const char *order;      /* what is on it, for the mask shop; may be NULL */
    const char *aligned_to; /* id of a plate printed before; NULL: of none */
    bool back;              /* aligned from the back of the wafer, on marks seen there */
    double overlay_m;       /* budget between the two; NaN: not aligned */
    fw_place place;
} fw_mask_plate_row;

typedef struct fw_mask_table {
    const char *flow, *reading; /* "right-reading chrome down" */
    fw_mask_layer *layer;
    int nlayer;
    const char *order; /* what is on the device's plate, for the mask shop; may be NULL */
    const char *plate; /* the same as an expression, "1/0 NOT 2/0"; NULL: not said */
    /* (nplate) rows <plate>, in the order of printing; 0: the table has one plate, which is that of
       reading, order and plate above */
    fw_mask_plate_row *plates;
    int nplate,
        device_plate; /* the one that draws the structure: reading, order and plate above are its own */
    const fw_mask_content *content; /* (ncontent) what other plates draw below or upon the device */
    int ncontent;
    bool written_numbered; /* the plate as it is written has a number of its own; else its first
                              layer's */
    int written_layer, written_datatype;
    const char *written_name; /* NULL: "PLATE" */
    fw_mask_rule *rule; /* (nrule) rows <rule>; the rules of <layer> itself are not among them */
    int nrule;
    const fw_layout_pattern *pattern; /* (npattern) of the test die, in the order of the file */
    int npattern;
} fw_mask_table;

typedef struct fw_mask_neck { /* the narrowest place of a flexure */
    bool there;
    fw_geometry_vec2 at[2];      /* ends of the chord on the exact outline */
    int segment[2];              /* of the outline, */
    double t[2];                 /* and where on them */
    bool divided[2];             /* the arc was flattened in two parts there */
    bool on_vertex[2];           /* a vertex is there: on arcs always, on lines where they end */
    fw_geometry_point vertex[2]; /* it, where it is */
} fw_mask_neck;

typedef struct fw_mask_shape {
    int layer; /* index into table->layer */
    const fw_layout_piece *piece;
    fw_geometry_contour contour;       /* biased, exact */
    fw_geometry_box box;               /* of it */
    fw_geometry_polygon polygon;       /* flattened */
    fw_geometry_polygon *part;         /* (npart) the same, cut to the vertex limit of GDSII */
    int npart;                         /* 0: not cut, `polygon` itself */
    double cut_clear_dbu;              /* no cut is nearer to another vertex; INFINITY: no cut */
    fw_geometry_polygon_report report; /* of the polygon, exact integers */
    double area_m2, bound_m2;          /* of the contour; what flattening may change */
    double polygon_area_m2;            /* exact, of the polygon */
    fw_geometry_flattening flattening;
    double edge_m; /* farthest that an edge of the polygon is from the contour, at most */
    fw_mask_neck neck;
} fw_mask_shape;

typedef struct fw_mask_measure { /* per layer */
    int shapes, vertices;
    double area_m2, polygon_area_m2, bound_m2; /* exact contours, flattened, proven difference */
    double perimeter_m;                        /* of the union: joints are not counted */
    double width_m, space_m; /* least exact ones, square on edges or at corners, below
                                FW_MASK_LOOK_M; INFINITY beyond */
    fw_geometry_vec2 width_at[2], space_at[2];        /* ends of these chords */
    double shortest_edge_m, sharpest_rad;             /* of the polygons; INFINITY without any */
    double sharpest_material_rad, sharpest_space_rad; /* its two sides */
    bool
        unfinished; /* too many edges are near each other (FW-D592): findings and least distances are of the first of them */
    double edge_m;  /* farthest that an edge of a polygon is from its outline, at most */
    int straight;   /* vertices exactly between their neighbours */
    fw_geometry_box box; /* of the polygons, on the grid; x0 > x1 without any */
} fw_mask_measure;
#define FW_MASK_LOOK_M 100e-6

/* where the edges of biased layers stand in the end, m outside the drawn ones, beside the open
   field */
typedef struct fw_mask_edges {
    double top_m, bottom_m; /* what is known of both faces */
    double least_m, most_m; /* of the top face, at the ends of what is assumed; NaN: no range */
    bool known_part;        /* something else is lost that nobody knows */
    const char *range;      /* what the range is of; "" */
    const char *note;       /* may be NULL */
} fw_mask_edges;

typedef struct fw_mask {
    const fw_mask_table *table;
    const char *cell, *flow;
    fw_mask_shape *shape; /* (nshape) */
    int nshape;
    double bias_m, tolerance_m;
    fw_geometry_flattening flattening;
    double thickness_m; /* of the device, for solids; 0: not known */
    fw_geometry_box box;
    int vertex_limit;           /* of one GDSII boundary */
    bool rejected;              /* every file says REJECTED */
    const char *const *because; /* (nbecause) why the verdict rejects the design */
    int nbecause;
    const double *layer_bias_m; /* as of the options; NULL: none */
    const char **note;          /* (nnote) lines written on the documentation layer */
    int nnote;
    const char *device, *title;
    const fw_mask_measure *measure; /* (table->nlayer) */
    const fw_mask_edges *edges;     /* as fabricated; NULL: not known */
    const fw_mask_finding *finding; /* (nfinding) every place where a rule is broken */
    int nfinding;
    int nbroken;                  /* of them those that forbid the mask */
    bool whole;                   /* every polygon is there and proven */
    const fw_layout_cell *placed; /* (nplaced) drawings of others on it */
    int nplaced;
    /* nets as drawn; NULL: they were not asked for, and `wired` is empty */
    const fw_wiring *wiring;
    fw_wiring_on_mask wired; /* the same on the mask */
} fw_mask;

/* what a layer's polygons stand outside of what is drawn, m per edge */
double fw_mask_layer_bias_m(const fw_mask *mask, int layer);

/* a layer, and how it joins what stands before it; the first: OR */
typedef struct fw_mask_plate_term {
    int layer;
    fw_geometry_set_rule rule;
} fw_mask_plate_term;
/* what the device's plate draws, from the left: the terms of table->plate, or the biased layers where
   it is not said */
fw_status fw_mask_plate_terms(fw_arena *arena, const fw_mask_table *table,
                              fw_mask_plate_term **term, int *n);
/* the same of any plate */
fw_status fw_mask_plate_terms_of(fw_arena *arena, const fw_mask_table *table, int plate,
                                 fw_mask_plate_term **term, int *n);
int fw_mask_plates(const fw_mask_table *table); /* at least one */
fw_mask_plate_row fw_mask_plate_at(const fw_mask_table *table, int i);
/* index of a plate by its id; -1: there is none */
int fw_mask_plate_named(const fw_mask_table *table, const char *id);
/* is a layer in what a plate draws or takes away? */
bool fw_mask_plate_draws(const fw_mask_table *table, int plate, int layer);

fw_status fw_mask_table_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                             fw_diags *diags, fw_mask_table *table);
/* the layer that a name of a cell's layers="...>NAME" means: "mask" is the one that draws the structure, else an id,
   a name, NUMBER/DATATYPE or a role; -1: the table has none */
int fw_mask_layer_named(const fw_mask_table *table, const char *text);
/* What the layers draw that cells of the device and of its wafer go to (fw_device_cell_layer.role). Numbers that a
   table has not become rows of it, which no plate has. FW_INPUT: reported (FW-D570) */
fw_status fw_mask_cells_settle(fw_arena *arena, const fw_device *device,
                               fw_mask_table *const *table, int ntable, fw_diags *diags);

typedef struct fw_mask_options {
    double bias_m, tolerance_m; /* 0 tolerance: 5 nm */
    int vertex_limit;           /* 0: 4094; else 8 to 8190 */
    fw_geometry_flattening flattening;
    double thickness_m; /* of the device */
    bool rejected;
    const char *const *because; /* (nbecause) why, for certificate and order sheet */
    int nbecause;
    const char *title;
    const char **note;
    int nnote;
    const fw_mask_edges *edges; /* kept; may be NULL */
    bool no_islands; /* the flow has no insulating carrier: what is not joined would fall out */
    /* (table->nlayer) what layers with shrink or grow get at every edge, m; NULL: nothing */
    const double *layer_bias_m;
    const fw_wiring *wiring; /* of the same layout, to be found again on the mask; may be NULL */
} fw_mask_options;
/* biases, checks the rules, flattens, certifies. FW_OK: the mask can be made. FW_INPUT with a mask:
   rules are broken, and its findings say all of them; diagnostics name the worst. FW_INPUT or
   FW_GEOMETRY with NULL: it cannot be drawn at all (FW-D140..). */
fw_status fw_mask_examine(fw_arena *arena, const fw_layout *layout, const fw_mask_table *table,
                          const char *device_name, const fw_mask_options *options, fw_diags *diags,
                          const fw_mask **mask);
/* the same, but a mask that breaks a rule is NULL */
fw_status fw_mask_build(fw_arena *arena, const fw_layout *layout, const fw_mask_table *table,
                        const char *device_name, const fw_mask_options *options, fw_diags *diags,
                        const fw_mask **mask);

/* ---- the test die: the patterns of the table on a die of the device's size ---- */
typedef struct fw_mask_coupons {
    const fw_mask *mask; /* as any other: written, certified and placed on a wafer likewise */
    const fw_layout_content *content;
} fw_mask_coupons;
typedef struct fw_mask_coupon_options {
    fw_geometry_box die;    /* with its lane: layout->die of the device */
    double frame_m, lane_m; /* NAN: as devices have them */
    const char *die_id;     /* lettered on the frame; NULL: none */
    fw_mask_options mask;   /* the same as for the device: bias, tolerance, title, notes */
} fw_mask_coupon_options;
/* *coupons NULL where the table has no <pattern>. The mask's own bias is 0: the process bias is in
   the outlines of the patterns that ask for it, and in no other. Cell "TEST_FLOW". */
fw_status fw_mask_coupons_build(fw_arena *arena, const fw_mask_table *table,
                                const fw_mask_coupon_options *options, fw_diags *diags,
                                const fw_mask_coupons **coupons);
/* The die of the same middle on which every pattern has room, in steps of 250 um, the shorter side first.
   *found false: none up to 8 mm wider has. Cost: one drawing and packing of the patterns a step. */
fw_status fw_mask_coupons_die(fw_arena *arena, const fw_mask_table *table,
                              const fw_mask_coupon_options *options, fw_geometry_box *die,
                              bool *found);
/* the device's drawing with the marks that the table has for its frame; the device itself where it
   has none. *no_room: what of them plates are put on each other by and finds none */
fw_status fw_mask_frame_marks(fw_arena *arena, const fw_mask_table *table, const fw_layout *device,
                              const fw_layout **layout, fw_layout_no_room *no_room);
/* ... and with what its other plates draw (<content>) */
fw_status fw_mask_contents_add(fw_arena *arena, const fw_mask_table *table, const fw_layout *marked,
                               const fw_layout **layout);
/* why the device of a drawing cannot be made with what the other plates draw; none: it can */
typedef struct fw_mask_verdict {
    fw_arena *arena;
    const char **reason; /* (n) sentences */
    int n, room;
    double widest_hollow_m; /* side of the largest square within one; 0: there is none */
    int pads;               /* that have metal for a wire */
} fw_mask_verdict;
fw_status fw_mask_contents_judge(fw_arena *arena, const fw_mask_table *table,
                                 const fw_layout *layout, fw_mask_verdict *verdict);
/* a length of the first <content> of a kind, "margin" of "cavity"; NaN: the table has none */
double fw_mask_content_m(const fw_mask_table *table, const char *kind, const char *parameter);
/* the first plate that draws a role; -1: none does */
int fw_mask_plate_of_role(const fw_mask_table *table, fw_layout_role role);
/* budget between the plate of the device and the one with a role: along the rows that align them, added;
   0 where one plate has both */
double fw_mask_overlay_m(const fw_mask_table *table, fw_layout_role role);
/* the certificate and, in `coupons`, every pattern: place, drawn sizes, what to measure and which
   quantity of the process it gives */
fw_status fw_mask_write_coupons(const fw_mask_coupons *coupons, const char *gds_sha256,
                                const fw_output_file *file, int nfile, fw_text *out);

/* same mask, same bytes; the writers of the other formats are in their rows (fw_mask_format) */
fw_status fw_mask_write_gds(const fw_mask *mask, fw_text *out);
/* name of layer k in DXF; NULL: out of memory */
const char *fw_mask_dxf_layer(fw_arena *arena, const fw_mask *mask, int k);

/* ---- a plate: dies on their places, as the formats that have cells and arrays write it ---- */
typedef struct fw_mask_plate_cell {
    const char *name;
    const fw_mask *mask;
} fw_mask_plate_cell;

typedef struct fw_mask_plate_place { /* of a cell, once or as an equally spaced array; dbu */
    int cell;
    int32_t x, y; /* of the cell's origin, from the plate's middle */
    int columns, rows;
    int32_t step_x, step_y; /* > 0 where there are several */
} fw_mask_plate_place;

typedef struct fw_mask_plate {
    const fw_mask_table *table;
    const char *top, *title, *flow;
    bool rejected;
    double edge_m; /* of the square */
    /* (ncell) each different die once; all have layers of `table` */
    const fw_mask_plate_cell *cell;
    int ncell;
    const fw_mask_plate_place *place; /* (nplace) in the top cell */
    int nplace;
    const fw_mask *drawn; /* what the top cell draws itself; NULL: nothing */
    const char **note; /* (nnote) lines on the documentation layer, from (note_x, note_y) by step */
    int nnote;
    int32_t note_x, note_y, note_step; /* dbu */
} fw_mask_plate;
fw_status fw_mask_plate_gds(const fw_mask_plate *plate, fw_text *out);
fw_status fw_mask_plate_svg(const fw_mask_plate *plate, fw_text *out);
fw_status fw_mask_plate_oasis(const fw_mask_plate *plate, fw_text *out);
fw_status fw_mask_plate_dxf(const fw_mask_plate *plate, fw_text *out);

typedef struct fw_mask_format { /* a row of formats.def */
    const char *name, *ending;  /* as the user says it; of the file */
    fw_status (*write)(const fw_mask *mask, fw_text *out);
    /* the same for a whole plate; NULL: the format has no cells, and no plate is written in it */
    fw_status (*plate)(const fw_mask_plate *plate, fw_text *out);
    bool always, usual; /* whatever is asked for; when nothing is asked for */
    bool beside;        /* goes with GDSII and need not be named */
    bool picture;       /* to look at: the order sheet does not name it */
    bool solid; /* of the etched device: no plate is written from it, and no order names it */
} fw_mask_format;
const fw_mask_format *fw_mask_format_at(size_t i); /* NULL behind the last row */
/* bit i for row i. list: names with commas between, "all", or NULL for the usual ones; false: a
   name is not known */
bool fw_mask_formats(const char *list, unsigned *set);

/* "inside" (also NULL and "") or "equal-area"; false: neither */
bool fw_mask_flattening_named(const char *name, fw_geometry_flattening *kind);
const char *fw_mask_flattening_name(fw_geometry_flattening kind);

/* certificate: counts, areas, minimum edge, angle, hash; JSON */
fw_status fw_mask_write_certificate(const fw_mask *mask, const char *gds_sha256, fw_text *out);
/* where rules are broken, to look at: KLayout's report database (.lyrdb), the list as JSON, and a
   mask with the drawn layers and a marker for each finding, which every writer above takes. Its
   marker layer is the highest one up to 60 that the table leaves free, data type by kind of rule */
fw_status fw_mask_write_lyrdb(const fw_mask *mask, fw_text *out);
fw_status fw_mask_write_findings(const fw_mask *mask, fw_text *out);
fw_status fw_mask_marked(fw_arena *arena, const fw_mask *mask, const fw_mask **marked);
const char *fw_mask_rule_name(const fw_mask_rule *rule); /* its kind as the table says it */
double fw_mask_rule_shown(const fw_mask_rule *rule, double value); /* in um, deg, um2, a share */
const char *fw_mask_rule_unit(const fw_mask_rule *rule);           /* "" of a share */

/* the same with the files that it goes with */
fw_status fw_mask_write_certificate_of(const fw_mask *mask, const char *gds_sha256,
                                       const fw_output_file *file, int nfile, fw_text *out);
/* order sheet of one plate for the mask shop, as JSON and for people, with the files that go with it */
fw_status fw_mask_write_order(const fw_mask *mask, int plate, const fw_output_file *file, int nfile,
                              fw_text *out);
fw_status fw_mask_write_order_text(const fw_mask *mask, int plate, const fw_output_file *file,
                                   int nfile, fw_text *out);

/* ---- what the order sheet says, gathered once for its two forms and the wafer's ---- */
typedef struct fw_mask_order_site { /* where the shop, and later the laboratory, measures */
    int layer;                      /* index into the table */
    const char *what;               /* "least width", "least space", or the label of a flexure */
    bool space;                     /* between polygons, not through one */
    fw_geometry_vec2 from, to;      /* ends of the chord, on the exact outlines */
} fw_mask_order_site;

typedef struct fw_mask_order {
    int plate_index;   /* of table->plates */
    const char *name;  /* of the mask */
    const char *tone;  /* of the plate's polygons: "data clear", "data dark"; NULL: not said */
    const char *field; /* "dark" or "clear": what is where there are no polygons */
    int mirror;        /* 1: seen with the chrome up the plate is the data's mirror image; 0: not;
                          -1: the table's reading does not say */
    double width_m, space_m;  /* least ones on the plate's layers; INFINITY: none below 100 um */
    bool unfinished;          /* a layer's search for them ended before its end (FW-D592) */
    bool *plate;              /* (nlayer of the table): is it on the plate? */
    fw_mask_order_site *site; /* (nsite) */
    int nsite;
    int polygons, vertices; /* of the plate's layers in the GDSII file */
} fw_mask_order;

/* 1: a plate that is read so is, seen with the chrome up, the mirror image of its data; 0: not; -1: it does not say */
int fw_mask_reading_mirrors(const char *reading);
fw_status fw_mask_order_gather(fw_arena *arena, const fw_mask *mask, int plate,
                               fw_mask_order *order);

/* Lines of the sheet for people, ASCII: one of them; what is on the plate (called `what`), with its
   tone, reading and mirror; least sizes (INFINITY: none), bias and grid; corners of the data, m */
void fw_mask_order_line(fw_text *out, const char *what, const char *value);
/* "7/0" of a layer, and how many characters the longest of a table has, at least 5 */
enum { FW_MASK_GDS_TEXT = 32 };
const char *fw_mask_order_gds(char text[FW_MASK_GDS_TEXT], const fw_mask_layer *layer);
int fw_mask_order_gds_width(const fw_mask_table *table);
/* the table of CD sites: `where` ("layer", "1/0") in `wide` columns, the middle and the direction of the chord in m */
void fw_mask_order_site_heading(fw_text *out, const char *where, int wide);
void fw_mask_order_site_row(fw_text *out, int number, const char *where, int wide,
                            const fw_mask_order_site *site, fw_geometry_vec2 at,
                            fw_geometry_vec2 along);
/* the head of what is rejected, with why */
void fw_mask_order_rejected(fw_text *out, const fw_mask *mask);
/* the same as a member of an object; nothing where the verdict does not reject it */
void fw_mask_json_because(fw_json *json, const fw_mask *mask);
void fw_mask_order_plate_lines(fw_text *out, const char *what, const fw_mask_table *table,
                               const fw_mask_order *order);
/* which plate of how many it is, and what it is aligned to; nothing where there is only one */
void fw_mask_order_set_lines(fw_text *out, const fw_mask_table *table, const fw_mask_order *order);
/* unfinished: the search for these two ended before its end */
void fw_mask_order_size_lines(fw_text *out, double width_m, double space_m, bool unfinished,
                              const fw_mask *mask, int plate);
/* likewise of data that are scaled: sizes as they are in them, bias and arcs of the mask */
void fw_mask_order_scaled_lines(fw_text *out, double width_m, double space_m, bool unfinished,
                                const fw_mask *mask, int plate, double scale);
/* by how much its first layer is drawn outside of what is wanted */
double fw_mask_plate_bias_m(const fw_mask *mask, int plate);
void fw_mask_order_extent_line(fw_text *out, fw_geometry_box box);

/* boundaries of one layer in the GDSII file */
void fw_mask_order_count(const fw_mask *mask, int layer, int *polygons, int *vertices);

/* "1/0 NOT 2/0": terms "LAYER/DATATYPE" with AND, OR, NOT, XOR between them, applied from the left.
   Marks the layers named (NULL: does not) and says which comes first, -1 where nothing is said;
   false: not of this form, or a layer is not in the table (*wrong is where) */
bool fw_mask_plate_layers(const fw_mask_table *table, const char *layers, bool *named, int *first,
                          const char **wrong);

/* ---- three outlines of one shape: as drawn, on the mask, as it stands in the end ----
   The last is the mask's outline taken back by what the flow loses at its edges, at the top and at
   the bottom face: fw_mask_edges. */
/* contours of one shape of a biased layer; count 0: not asked for, or nothing of it is left */
typedef struct fw_mask_outline {
    const fw_mask_shape *shape;      /* piece->contour is as drawn, contour is on the mask */
    fw_geometry_contour top, bottom; /* as fabricated, known part */
    fw_geometry_contour least, most; /* of the top face, at the ends of what is assumed */
} fw_mask_outline;

typedef struct fw_mask_outlines {
    fw_mask_outline *outline; /* (n) */
    int n;
    int gone_top, gone_bottom, gone_least; /* shapes of which that face has nothing left */
} fw_mask_outlines;

/* In: a mask with its edges. FW_OK with n = 0 where it has none. A shape that cannot be taken back
   so far without changing what hangs together has count 0 and is counted. Exact: lines and arcs as
   fw_geometry_contour_offset makes them; taking back what was added gives the drawn outline to
   1e-12 m. */
fw_status fw_mask_outlines_of(fw_arena *arena, const fw_mask *mask, fw_mask_outlines *out);
/* the picture of fw_mask_write_outlines as a part of an HTML document: ids begin with the flow */
fw_status fw_mask_outlines_part(const fw_mask *mask, fw_text *out);

/* ---- as the shop writes it ----
   The layers of the order joined to one, mirrored where asked for. */

typedef struct fw_mask_window { /* dbu, in coordinates of the cell; x1 <= x0: none */
    int32_t x0, y0, x1, y1;
} fw_mask_window;

typedef struct fw_mask_merge_options {
    const fw_mask_table *written; /* of one layer: fw_mask_written_table */
    int plate;                    /* of the mask's table */
    const fw_mask_window
        *window; /* (nwindow) parts of the cell that other cells draw, as written */
    int nwindow;
    int under; /* -1: the windows are left out; else this is the other cell: all that lies in the window,
                     where layer `under` of the mask's table is whole */
    bool inverted;        /* written is what is left free of `field` */
    fw_mask_window field; /* as written */
    double scale;         /* of the mask, each vertex to the nearest point of the grid */
    const double *scales; /* (nshape) of each of its shapes instead; NULL: of all the same */
    bool mirror;          /* x becomes -x */
    int vertices;         /* most of a polygon */
} fw_mask_merge_options;

typedef struct fw_mask_merge_sums { /* added up over calls, each so many times */
    double polygons, vertices, cuts, holes, area_m2;
    double
        clear_m; /* least distance of a cut from a vertex that it does not end at; INFINITY: no cut */
    int rounded;
} fw_mask_merge_sums;

/* The plate's expression over the polygons of a mask (fw_geometry_merge), as a mask of one layer whose
   writers are those of any other. FW_LIMIT: coordinates of more than 268 mm, or more layers in the
   expression than FW_MERGE_SETS - 1. FW_GEOMETRY: a polygon that is not simple, or has too many vertices
   and no cut. Test: tests/accept/wafer.sh, against KLayout */
fw_status fw_mask_merged(fw_arena *arena, const fw_mask *mask, const fw_mask_merge_options *options,
                         const fw_mask **out, fw_mask_merge_sums *sums);
/* the one layer of a plate: number and name of the laboratory for "plate", else those of the first layer
   of its order, and its tone, or the other one */
fw_status fw_mask_written_table(fw_arena *arena, const fw_mask_table *table, int plate,
                                bool inverted, const fw_mask_table **out);

#endif
