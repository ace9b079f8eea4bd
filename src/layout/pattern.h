/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test patterns: what is on a plate beside the device, to be measured. A kind is a section of one
   of the files pattern_*.c and a line of patterns.def; which patterns a flow has, and their sizes,
   are rows of masks/FLOW.xml.

   A pattern is drawn in a box of its own: x to the right from 0, y up from the top edge of the bar
   that it stands on. Whatever touches y = 0 has a foot there (JOINT segments), so that it is joined
   to the bar and through it to the frame: nothing falls out of a flow that etches through, and
   everything is at one potential while copper is plated. All coordinates are multiples of 1 nm. */
#ifndef FW_LAYOUT_PATTERN_H
#define FW_LAYOUT_PATTERN_H
#include "layout/layout.h"

enum { FW_PATTERN_PARAMETERS = 6, FW_PATTERN_SIZES = 48 };

typedef struct fw_layout_pattern_parameter {
    const char *name;   /* attribute of <pattern> */
    double usual;       /* m, or a plain number; NAN: must be stated */
    double least, most; /* what may be stated */
    bool number;        /* a plain number, not a length */
} fw_layout_pattern_parameter;

struct fw_layout_pattern_kind;
typedef struct fw_layout_pattern { /* a row of the table */
    const struct fw_layout_pattern_kind *kind;
    double value[FW_PATTERN_PARAMETERS]; /* in the order of the kind's parameters */
    double size_m[FW_PATTERN_SIZES];     /* (nsize) "sizes", in the order of the file */
    int nsize;
    bool biased;                          /* the process bias is added to its edges */
    const char *id, *title;               /* id: names it in measured values; title: lettering */
    const char *gives, *measure, *source; /* quantity of the process; what to do; may be NULL */
    fw_place place;
} fw_layout_pattern;

typedef struct fw_layout_feature { /* one thing to be measured */
    const char *name;              /* "line", "slot", ... */
    double drawn_m;                /* on the plate */
    fw_geometry_vec2 from, to; /* ends of the chord that is drawn_m long, or of what is looked at */
    const char *label;         /* lettering on the bar below it; NULL: none */
} fw_layout_feature;

typedef struct fw_layout_pattern_figure { /* a number that the pattern's reading needs */
    const char *name, *unit;
    double value; /* in that unit */
} fw_layout_pattern_figure;

enum { FW_FIGURES = 4 };
typedef struct fw_layout_coupon { /* a drawn pattern */
    const fw_layout_pattern *pattern;
    fw_layout_piece *piece; /* (npiece) */
    fw_layout_feature *feature;
    fw_layout_pattern_figure figure[FW_FIGURES];
    const char *formula; /* how the reading gives the quantity; NULL: as it stands */
    int npiece, nfeature, nfigure, piece_room, feature_room;
    double width_m, height_m; /* of its box */
    fw_geometry_vec2 at;      /* the box's origin on the die */
    bool placed;
} fw_layout_coupon;

typedef struct fw_layout_pen { /* what a kind draws with */
    fw_arena *arena;
    const fw_layout_pattern *pattern;
    fw_layout_coupon *coupon;
    double width_rule_m, space_rule_m, bias_m;
    fw_geometry_contour *box; /* (nbox) rectangles of the shape that is being drawn */
    int nbox, box_room;
} fw_layout_pen;

/* what a kind adds to the frame of the device's own die, where the device asks for fill */
typedef enum fw_layout_growth {
    FW_GROWS_NOT,
    FW_GROWS_ALONG_EDGES, /* a strip along every edge, as wide as the kind's first parameter */
    FW_GROWS_IN_CELLS     /* squares on stems, on top of the strips */
} fw_layout_growth;

typedef struct fw_layout_pattern_kind { /* a row: one for each line of patterns.def */
    const char *name, *what;
    fw_layout_pattern_parameter parameter[FW_PATTERN_PARAMETERS];
    int nparameter;
    const char *sizes; /* what the list of lengths is; NULL: takes none */
    /* FW_GEOMETRY: cannot be drawn with these numbers */
    fw_status (*draw)(fw_layout_pen *pen);
    int on_frame; /* on the frame of every die, so often; 0: on the test die */
    bool aligns;  /* plates are put on each other by it */
    bool fills;   /* takes what the others leave of a row: drawn by layout_content.c */
    fw_layout_growth in_window; /* on the device's own die: content_frame.c */
} fw_layout_pattern_kind;

const fw_layout_pattern_kind *fw_layout_pattern_kind_at(size_t i); /* NULL behind the last row */
const fw_layout_pattern_kind *fw_layout_pattern_kind_named(const char *name);

/* draws one pattern by itself; FW_GEOMETRY: the numbers do not go together */
fw_status fw_layout_pattern_draw(fw_arena *arena, const fw_layout_pattern *pattern,
                                 double width_rule_m, double space_rule_m, double bias_m,
                                 fw_layout_coupon *coupon);

/* ---- for the kinds: pattern_pen.c ---- */
/* a rectangle of the shape that is being drawn; parts of a shape overlap, none only touches */
fw_status fw_layout_pen_box(fw_layout_pen *pen, double x0, double y0, double x1, double y1);
/* ends the shape: the rectangles become one piece; what lies on y = 0 is its feet. FW_GEOMETRY when
   they are not one outline without holes */
fw_status fw_layout_pen_shape(fw_layout_pen *pen, fw_layout_role role, const char *label);
/* one rectangle that is a shape by itself */
fw_status fw_layout_pen_bar(fw_layout_pen *pen, fw_layout_role role, const char *label, double x0,
                            double y0, double x1, double y1);
fw_status fw_layout_pen_outline(fw_layout_pen *pen, fw_layout_role role, const char *label,
                                fw_geometry_outline *outline);
/* label NULL: no lettering; FW_PEN_SIZE: the size in um */
fw_status fw_layout_pen_feature(fw_layout_pen *pen, const char *name, double drawn_m,
                                fw_geometry_vec2 from, fw_geometry_vec2 to, const char *label);
extern const char FW_PEN_SIZE[];
fw_status fw_layout_pen_chord(fw_layout_pen *pen, const char *name, double x0, double y0, double x1,
                              double y1, const char *label);
void fw_layout_pen_figure(fw_layout_pen *pen, const char *name, double value, const char *unit);
double fw_layout_pen_value(const fw_layout_pen *pen, int parameter);

/* one row per kind: pattern_etch.c, pattern_print.c */

/* ---- closed forms of what the patterns tell; each beside its drawing ---- */
/* turn of the rotating pointer per strain, 1 (pattern_etch.c) */
double fw_layout_pointer_turn_per_strain(double arm_m, double offset_m, double width_m);
/* farthest way from an opening within a plate with holes in a square grid, m (pattern_etch.c) */
double fw_layout_holes_reach_m(double pitch_m, double hole_m, bool round);
/* gap between squares joined in chains for a share of covered area; NAN: there is none */
double fw_layout_fill_gap_m(double square_m, double stem_m, double density);

/* ---- the test die of a flow ----
   Its patterns on bars across the window of a frame, in the order of the
   table, with lettering and fill. Everything is joined to the frame. */

typedef struct fw_layout_content_options {
    fw_geometry_box die;               /* outline with its lane, as of the device */
    double frame_m, lane_m;            /* NAN: as devices have them */
    double bias_m;                     /* of the process, added to the patterns that ask for it */
    double width_rule_m, space_rule_m; /* of the layer that the patterns are drawn on */
    const char *title, *flow;
    const char *die_id; /* "R2C3"; NULL: none */
    const char *file;   /* where the patterns are from, for messages */
} fw_layout_content_options;

typedef struct fw_layout_content {
    const fw_layout *layout;  /* drawn outlines: the bias is in, where a pattern wants it */
    fw_layout_coupon *coupon; /* (ncoupon) in the order of the table; some not placed */
    int ncoupon, nplaced;
    double fill_density; /* of the fields of fill; 0: there is none */
    double fill_area_m2; /* of the material in them */
} fw_layout_content;

/* Draws and places; what has no room is left out with a warning (FW-D186), numbers that do not go
   together are FW-D187, a die without room for anything FW-D188 (FW_GEOMETRY).
   Shelf packing, first fit in the order of the table: deterministic, O(patterns x rows). */
fw_status fw_layout_content_build(fw_arena *arena, const fw_layout_pattern *pattern, int npattern,
                                  const fw_layout_content_options *options, fw_diags *diags,
                                  const fw_layout_content **content);

/* the device's drawing with what its table has for the frame (kinds with on_frame): the pieces of
   `device` and, behind them, marks in its uprights, from the top, where they lie 12 um clear of
   every edge and 40 um of lettering and other marks. What finds no room is left out, and is what
   *no_room says. */
fw_status fw_layout_content_on_frame(fw_arena *arena, const fw_layout *device,
                                     const fw_layout_pattern *pattern, int npattern,
                                     double width_rule_m, double space_rule_m,
                                     const fw_layout **out, fw_layout_no_room *no_room);
/* the pieces of a drawn pattern with its box at `at` */
fw_status fw_layout_coupon_put(fw_arena *arena, const fw_layout_coupon *coupon, fw_geometry_vec2 at,
                               fw_layout_piece **list, int *count, int *capacity);

#endif
