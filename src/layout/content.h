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

#endif
