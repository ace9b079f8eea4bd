/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer and its plate: which dies lie whole on it, which device each of them is, the cells of
   the mask file with their arrays, and the map.

   Places are integers on the 1 nm grid (dbu), counted from the wafer's centre, x right, y up, as
   drawn. One cell per different device; equal dies of a row are one array. */
#ifndef FW_WAFER_WAFER_H
#define FW_WAFER_WAFER_H
#include "device/device.h"
#include "geometry/polygon.h"
#include "mask/mask.h"

enum { FW_WAFER_MOST_DIES = 20000 };

/* ---- the wafer as a shape: wafer_grid.c ---- */
typedef struct fw_wafer_form {
    double diameter_m, flat_m, notch_m; /* flat: length of the chord; 0: none. notch: depth */
    double edge_m;
    fw_device_wafer_side side;
    int64_t usable_dbu;           /* radius inside the edge exclusion */
    int64_t flat_dbu;             /* centre to the usable side of the flat; no flat: usable_dbu */
    int64_t notch_dbu, avoid_dbu; /* centre to rim at the notch; radius about it to stay away from;
                                     0: no notch */
    double plate_m;               /* edge of the square plate */
} fw_wafer_form;
/* FW_INPUT (FW-D190): no flat known, or what is stated contradicts itself */
fw_status fw_wafer_form_of(const fw_device_wafer_asked *asked, fw_diags *diags,
                           fw_wafer_form *form);
/* of a plate with one die, `across_m` from corner to corner as written, and no wafer; FW-D551: it does not
   hold it */
fw_status fw_wafer_form_single(const fw_device_wafer_asked *asked, double across_m, fw_diags *diags,
                               fw_wafer_form *form);
/* m2 of the wafer, and of what a polygon of its plate as drawn has over it */
double fw_wafer_area(const fw_wafer_form *form);
double fw_wafer_area_over(const fw_wafer_form *form, const fw_geometry_polygon *polygon);
/* do all points of the rectangle lie in the usable area? exact */
bool fw_wafer_holds(const fw_wafer_form *form, int64_t x0, int64_t y0, int64_t x1, int64_t y1);

/* ---- places: wafer_grid.c ---- */
typedef enum fw_wafer_kind { FW_WAFER_DIE, FW_WAFER_ALIGNMENT, FW_WAFER_TEST } fw_wafer_kind;

typedef struct fw_wafer_site {
    int row, column; /* 0: the top row, the leftmost column of the grid */
    int32_t x, y;    /* lower left corner, dbu */
    fw_wafer_kind kind;
    int variant; /* of a die; else -1 */
} fw_wafer_site;

typedef struct fw_wafer_grid {
    int32_t width, height, pitch_x, pitch_y; /* dbu */
    bool street_x, street_y;                 /* a street, not a die, lies in the centre */
    int rows, columns;
    fw_wafer_site *site; /* (nsite) row by row from the top, each from the left */
    int nsite;
} fw_wafer_grid;
/* all whole dies of width x height dbu; kinds and variants are left at FW_WAFER_DIE and 0 */
fw_status fw_wafer_grid_fill(fw_arena *arena, const fw_wafer_form *form,
                             const fw_device_wafer_asked *asked, int32_t width, int32_t height,
                             fw_diags *diags, fw_wafer_grid *grid);
/* alignment sites, test dies, then the steps of the sweeps: variant = step0 + steps0 step1 */
fw_status fw_wafer_assign(const fw_wafer_form *form, const fw_device_wafer_asked *asked,
                          fw_diags *diags, fw_wafer_grid *grid);
/* dies that are devices, for the process; 0: what is asked for cannot be laid out */
fw_status fw_wafer_dies(fw_arena *arena, const fw_device_wafer_asked *asked, fw_geometry_box die,
                        int *dies);

/* origin of a die's cell from the lower left corner of its place: dies of sweeps may differ in size
   and are centred */
void fw_wafer_origin(const fw_wafer_grid *grid, fw_geometry_box die, int32_t *dx, int32_t *dy);

/* "C" and "07" of "C07"; columns are written with as many digits as the last one, two at least */
enum { FW_WAFER_NAME = 16 };
const char *fw_wafer_row_name(int row, char name[FW_WAFER_NAME]);
const char *fw_wafer_column_name(const fw_wafer_grid *grid, int column, char name[FW_WAFER_NAME]);

/* ---- what is placed ---- */
typedef struct fw_wafer_variant {
    const fw_mask *mask; /* NULL: could not be made; its dies are then those of `stand_in` */
    fw_geometry_box die, window; /* of its layout */
    double value[2];             /* SI, of the parameters that are swept */
    const char *decision;        /* "accept", "inconclusive", "reject"; NULL: not judged */
    double utilisation;          /* largest; NaN: not known */
    const char *why;             /* why its dies are other ones, or NULL */
    int dies;                    /* filled by fw_wafer_build */
} fw_wafer_variant;

/* how much wider or narrower lines of the plate may be, by what the verdict has looked at */
typedef struct fw_wafer_width_effect {
    /* which hinge, requirement or distance decides, and how it goes with a width */
    const char *says;
    /* before that is not accepted, first order; HUGE_VAL: nothing decides, NaN: not known */
    double left_m;
    double looked_m; /* how far the verdict's corners have gone either way; NaN: not known */
} fw_wafer_width_effect;

typedef struct fw_wafer_input {
    const fw_device *device;
    const fw_mask_table *table;
    const fw_wafer_variant *variant; /* (nvariant) one, or the product of the steps */
    int nvariant;
    fw_wafer_variant stand_in; /* the description as it stands: for variants without a mask */
    fw_wafer_variant test;     /* the die with coupons; mask NULL: its sites get the marks of an
                                  alignment site */
    fw_wafer_width_effect effect;
    double overlay_m;     /* closest that the flow aligns a mask; NaN: it aligns none */
    bool single;          /* no wafer: one die in the plate's middle, which is written alone */
    fw_mask_options mask; /* bias, tolerance, vertex limit of the plate's own cells */
} fw_wafer_input;

/* what a cell is of: a die that is lettered with its id, the letters of a row or a column, or else */
typedef enum fw_wafer_cell_kind {
    FW_WAFER_CELL_OTHER,
    FW_WAFER_CELL_DIE,
    FW_WAFER_CELL_ROW,
    FW_WAFER_CELL_COLUMN
} fw_wafer_cell_kind;

typedef struct fw_wafer_cell {
    fw_wafer_cell_kind kind;
    const char *name; /* of the GDSII structure */
    const fw_mask *mask;
    int32_t dx, dy; /* of its origin from the lower left corner of a place */
    int placed;     /* how often */
} fw_wafer_cell;

typedef struct fw_wafer_run { /* a cell, or an equally spaced array of it */
    int cell;
    int32_t x, y; /* origin of the first */
    int columns, rows;
    int32_t step_x, step_y;
} fw_wafer_run;

/* what stands beside the dies of a plate, as it is drawn; NULL: it is not there */
typedef struct fw_wafer_beside {
    const char *title, *line; /* at the top, at the bottom */
    const char *barcode;      /* its text */
    bool flat_line;
} fw_wafer_beside;

typedef struct fw_wafer {
    const fw_device *device;
    const fw_mask_table *table;
    fw_wafer_form form;
    fw_wafer_grid grid;
    fw_wafer_variant *variant; /* (nvariant) */
    int nvariant;
    fw_wafer_variant stand_in;
    const fw_mask *plate; /* title and fiducials, drawn in the top cell; NULL: none */
    const fw_wafer_beside
        *beside; /* (plates of the flow) what is drawn of that on each; NULL: nothing */
    const char *top, *title, *flow;
    fw_wafer_cell *cell; /* (ncell) children before the top cell */
    int ncell;
    fw_wafer_run *run; /* (nrun) */
    int nrun;
    int dies, alignments, tests;
    bool ids;                    /* dies are lettered */
    fw_geometry_vec2 id_at;      /* lower left corner of the id from that of a place, m */
    double stroke_m;             /* of its letters */
    fw_mask_window id_window[2]; /* of its row and of its column, from the lower left corner of a
                                    place: they share an edge */
    fw_wafer_width_effect effect;
    double overlay_m; /* as in fw_wafer_input */
    bool single;
    double fiducial_m; /* |x| and |y| of the crosses in the plate's corners; 0: it has none */
    bool rejected;
    const fw_mask *rejecting; /* the first mask of its dies that is; NULL: none */
} fw_wafer;
/* "M14": of its row and its column */
const char *fw_wafer_site_name(const fw_wafer *wafer, const fw_wafer_site *site,
                               char name[2 * FW_WAFER_NAME]);

fw_status fw_wafer_build(fw_arena *arena, const fw_wafer_input *input, fw_diags *diags,
                         const fw_wafer **wafer);

/* same wafer, same bytes */
fw_status fw_wafer_write_gds(const fw_wafer *wafer, fw_text *out);
/* in a format that has plates: format->plate is not NULL */
fw_status fw_wafer_write_format(const fw_wafer *wafer, const fw_mask_format *format, fw_text *out);
fw_status fw_wafer_write_csv(const fw_wafer *wafer, fw_text *out); /* one line per place */
fw_status fw_wafer_write_map(const fw_wafer *wafer, fw_text *out); /* SVG for people */
fw_status fw_wafer_write_json(const fw_wafer *wafer, const char *gds_sha256, fw_text *out);

/* ---- the plates as the shop writes them: wafer_write.c, written_order.c ----
   Of one plate of the flow its layers joined to one, scaled about the middle, mirrored, and what it leaves
   free instead where the other tone is ordered. */
typedef struct fw_wafer_written {
    int of;                             /* which of the flow's plates */
    const fw_device_order_asked *asked; /* what is ordered of it */
    fw_mask_plate plate;                /* one layer */
    fw_mask_merge_sums sums;            /* over all places */
    double over_m2;                     /* of their area, what lies over the wafer */
    int cells, references;
    bool mirrored;
    double field_m; /* inverted: edge of the square within which the rest is written; else 0 */
} fw_wafer_written;
fw_status fw_wafer_written_of(fw_arena *arena, const fw_wafer *wafer, int plate,
                              fw_wafer_written *written);
/* in a format that has plates */
fw_status fw_wafer_write_written(const fw_wafer_written *written, const fw_mask_format *format,
                                 fw_text *out);
fw_status fw_wafer_write_written_order(const fw_wafer *wafer, const fw_wafer_written *written,
                                       const fw_output_file *file, int nfile, fw_text *out);
fw_status fw_wafer_write_written_order_json(const fw_wafer *wafer, const fw_wafer_written *written,
                                            const fw_output_file *file, int nfile, fw_text *out);

/* What is ordered against the plate's reading (FW-D688), what the verdict bears (FW-D689) and what a shop promises
   (FW-D697). Test: test_wafer_written.c */
fw_status fw_wafer_check_orders(fw_arena *arena, const fw_wafer *wafer, fw_diags *diags);

/* of one plate of the flow, for the mask shop, with the files that go with it */
fw_status fw_wafer_write_order(const fw_wafer *wafer, int plate, const fw_output_file *file,
                               int nfile, fw_text *out);

/* ---- what the parts of the room share, private to it: cells that no device file describes, the lists they go into, and
   what its files say in words ---- */

typedef struct fw_wafer_maker {
    fw_arena *arena;
    const fw_wafer_input *input;
    fw_diags *diags;
    fw_wafer *wafer;
    int cells, runs; /* capacities */
} fw_wafer_maker;

/* a list of pieces that becomes a mask with the bias and the rules of the flow */
typedef struct fw_wafer_sheet {
    fw_wafer_maker *maker;
    fw_layout_role role; /* of lettering, bars and crosses beside the dies */
    fw_layout_piece *piece;
    int npiece, capacity;
    const fw_layout_cell *cell; /* (ncell) among them */
    int ncell;
} fw_wafer_sheet;
/* as_read: other plates than the device's are drawn as they are read, without what an etch takes */
fw_status fw_wafer_sheet_mask(fw_wafer_sheet *sheet, const char *name, bool as_read,
                              const fw_mask **mask);
bool fw_wafer_draws(const fw_mask_table *table, fw_layout_role role);

/* m to the nearest place on the grid */
int64_t fw_wafer_dbu(double m);

/* wafer_cells.c */
enum { FW_WAFER_LONGEST_NAME = 32 };
fw_status fw_wafer_add_cell(fw_wafer_maker *m, const char *name, const fw_mask *mask, int32_t dx,
                            int32_t dy, int *cell);
/* arrays of equal cells in every row; cell_of[i]: of site i, -1: none */
fw_status fw_wafer_add_rows(fw_wafer_maker *m, const int *cell_of);

/* wafer_marks.c, wafer_cells.c */
fw_status fw_wafer_plate(fw_wafer_maker *m);
/* (plate->nshape) which shapes beside the dies are of cells of the description that lie on the wafer, if only in part */
fw_status fw_wafer_cells_on(fw_arena *arena, const fw_wafer *wafer, const bool **on);
fw_status fw_wafer_alignment_mask(fw_wafer_maker *m, const fw_mask **mask);
fw_status fw_wafer_ids(fw_wafer_maker *m);

/* ---- what the files of a wafer say of it: wafer_facts.c ---- */

/* lines "key=value" for the documentation layer, ASCII */
fw_status fw_wafer_notes(fw_arena *arena, const fw_wafer *wafer, const char ***line, int *count);
/* "arc = 220 deg, link = 120 um"; "" without sweeps */
const char *fw_wafer_values(fw_arena *arena, const fw_wafer *wafer, const fw_wafer_variant *v);
/* of one sweep, in its unit */
double fw_wafer_value(const fw_wafer *wafer, const fw_wafer_variant *v, int sweep);
const char *fw_wafer_kind_text(fw_wafer_kind kind);
/* are the dies of this variant the stand-in's? */
bool fw_wafer_stood_in(const fw_wafer_variant *v);

typedef struct fw_wafer_sum { /* of one layer over the whole plate */
    double polygons, vertices, area_m2, width_m, space_m;
    double over_m2;  /* of that area, what lies over the wafer */
    bool unfinished; /* as in fw_mask_measure */
} fw_wafer_sum;
fw_status fw_wafer_sums(const fw_wafer *wafer, fw_arena *arena, fw_wafer_sum **sum);
/* the die whose middle is nearest to a point, not one of those before; NULL: none is left */
const fw_wafer_site *fw_wafer_nearest_die(const fw_wafer *wafer, double x, double y,
                                          const fw_wafer_site *const *before, int n);
/* of all that is drawn: the fiducials stand outermost, without them the places do */
fw_geometry_box fw_wafer_extent(const fw_wafer *wafer);

#endif
