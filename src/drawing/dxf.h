/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the two halves of the reader of DXF: what was read of the text (dxf_reader.c), and the
   outlines that are made of it (dxf_outlines.c). Private to the room. */
#ifndef FW_DRAWING_DXF_H
#define FW_DRAWING_DXF_H
#include "drawing/drawing.h"

typedef struct fw_drawing_pair {
    int code;
    const char *value; /* (length) */
    size_t length;
    int line; /* of the code, from 1 */
} fw_drawing_pair;

typedef struct fw_drawing_edge { /* of the pool from which outlines are put together */
    fw_geometry_vec2 a, b;       /* in units of the file */
    double sweep_rad;
    int line;
    bool used;
} fw_drawing_edge;

typedef struct fw_drawing_run {
    int first, count, line; /* of edges */
} fw_drawing_run;

typedef struct fw_drawing_dxf {
    fw_arena *arena;
    fw_diags *diags;
    const fw_drawing_asked *asked;
    const char *at, *end;
    int line;
    fw_drawing_pair now;
    bool failed, over;     /* nothing more can be read; the text is at its end */
    int insunits;          /* -1: not said */
    const char *layer;     /* the only one so far that had something; NULL */
    fw_drawing_edge *edge; /* (nedge) */
    int nedge, edge_room;
    fw_drawing_run *closed; /* (nclosed) runs of edges that are closed as they are */
    int nclosed, closed_room;
} fw_drawing_dxf;

/* closed runs and chains of edges to outlines in metres; FW_INPUT: reported */
fw_status fw_drawing_dxf_outlines(fw_drawing_dxf *dxf, fw_drawing *out);

#endif
