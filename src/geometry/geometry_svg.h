/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact outlines as commands of an SVG path: lines and true arcs. The y axis of SVG points down, so
   y is turned round here and not by a transform that importers may lose. */
#ifndef FW_GEOMETRY_GEOMETRY_SVG_H
#define FW_GEOMETRY_GEOMETRY_SVG_H
#include "base/constants.h"
#include "base/svg.h"
#include "geometry/contour.h"

typedef struct fw_geometry_sheet { /* from the plane to the picture */
    double x0_m, y1_m;             /* upper left corner of the picture */
    double per_m;                  /* user units per metre */
    int decimals;
    double most_rad; /* arcs are written in equal parts of at most so much turn, see below */
} fw_geometry_sheet;

/* A reader of SVG finds an arc's centre from its end points, which fails where they are equal and
   loses half the digits near a half turn. For pictures it is enough to split what is nearly a full
   turn; with a third of a turn nothing is lost, and the large-arc flag is never set. */
#define FW_GEOMETRY_ARC_PICTURE (1.8 * FW_PI)
#define FW_GEOMETRY_ARC_EXACT   (2.0 * FW_PI / 3.0)

/* how many parts an arc has, and where part i = 1 ... parts ends: the last one exactly at s->b */
int fw_geometry_arc_parts(const fw_geometry_segment *s, double most_rad);
fw_geometry_vec2 fw_geometry_arc_end(const fw_geometry_segment *s, int i, int parts);

/* the closed outline, for filling */
void fw_geometry_svg_contour(fw_text *out, const fw_geometry_sheet *sheet,
                             const fw_geometry_contour *c);
/* its edges alone, for a line: without the cuts between pieces (FW_SEGMENT_JOINT) */
void fw_geometry_svg_edges(fw_text *out, const fw_geometry_sheet *sheet,
                           const fw_geometry_contour *c);

#endif
