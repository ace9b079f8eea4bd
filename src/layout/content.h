/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The test die of a flow: its patterns on bars across the window of a frame, in the order of the
   table, with lettering and fill. Everything is joined to the frame. */
#ifndef FW_LAYOUT_CONTENT_H
#define FW_LAYOUT_CONTENT_H
#include "layout/pattern.h"

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
   every edge and 40 um of lettering and other marks. What finds no room is left out (*left_out
   counts). */
fw_status fw_layout_content_on_frame(fw_arena *arena, const fw_layout *device,
                                     const fw_layout_pattern *pattern, int npattern,
                                     double width_rule_m, double space_rule_m,
                                     const fw_layout **out, int *left_out);
/* thief and fill (kinds with in_window) on the frame's pieces, whose outlines are made anew; the
   layout's own are left alone */
fw_status fw_layout_content_in_window(fw_arena *arena, const fw_layout *device,
                                      const fw_layout_pattern *pattern, int npattern,
                                      fw_layout_piece *piece, int npiece);
/* appends the die's id as TEXT in the left upright, from below, in lines of what fits there;
   nothing where it has no room. The three last arguments are a growing array. */
fw_status fw_layout_content_die_id(fw_arena *arena, const fw_layout *device, const char *id,
                                   fw_layout_piece **piece, int *npiece, int *capacity);

/* ---- private to content*.c ---- */
typedef struct fw_layout_shelf { /* a bar with what stands on it */
    double low_m, top_m;         /* of the bar, once all rows are known */
    double height_m;             /* of the tallest pattern */
    double used_m;               /* along x, from the row's start */
} fw_layout_shelf;

enum { FW_SHELVES = 64 };
typedef struct fw_layout_bench { /* the die while it is being built */
    fw_arena *arena;
    fw_diags *diags;
    const fw_layout_content_options *options;
    fw_layout_content *content;
    fw_layout *layout;
    const fw_layout_pattern *fill; /* NULL: none */
    int capacity;
    fw_geometry_box window; /* between the frame's bars; low edge: top of the lowest bar's frame */
    double lane_m, keep_m, start_m, end_m; /* patterns lie from start to end */
    double floor_m, ceiling_m;             /* top of the lowest bar, foot of the highest */
    fw_layout_shelf shelf[FW_SHELVES];
    int nshelf, *where; /* shelf of each coupon, -1: none */
    double *offset;     /* of each coupon along its shelf */
} fw_layout_bench;

extern const double FW_CONTENT_STROKE_M, FW_CONTENT_BAND_M;      /* lettering; bar below a row */
double fw_layout_content_slot_m(const fw_layout_coupon *coupon); /* width with its lettering */
fw_status fw_layout_content_pack(fw_layout_bench *b);
fw_status
fw_layout_content_place(fw_layout_bench *b); /* pieces of the patterns and their lettering */
fw_status fw_layout_content_fill(fw_layout_bench *b);
fw_status fw_layout_content_bars(fw_layout_bench *b); /* frame and bars around the feet */
fw_status fw_layout_content_add(fw_layout_bench *b, const fw_layout_piece *piece);

#endif
