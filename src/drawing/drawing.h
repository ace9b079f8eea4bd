/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed outlines that somebody drew: from points and arcs, or from the bytes of a DXF or GDSII
   file. Lines and arcs stay lines and arcs. Files are hostile until read: sizes are bounded, and
   what is wrong is a diagnostic with its line (GDSII: its record). */
#ifndef FW_DRAWING_DRAWING_H
#define FW_DRAWING_DRAWING_H
#include "geometry/contour.h"

enum {
    FW_DRAWING_SEGMENTS_MOST = 4000, /* of one outline, and of what is taken from a file */
    FW_DRAWING_OUTLINES_MOST = 1000, /* taken from a file */
};

/* ---- one outline from its pieces ---- */

typedef struct fw_drawing_piece { /* from where the one before ends */
    fw_geometry_vec2 to;          /* m */
    double sweep_rad;             /* of an arc, > 0 to the left, below a full turn; 0: a line */
} fw_drawing_piece;

typedef enum fw_drawing_fault {
    FW_DRAWING_SOUND,
    FW_DRAWING_OPEN,    /* the last point is not the first within 1 nm */
    FW_DRAWING_POINT,   /* a piece without length */
    FW_DRAWING_CROSSES, /* or touches itself */
    FW_DRAWING_FLAT,    /* no area */
} fw_drawing_fault;

typedef struct fw_drawing_flaw {
    fw_drawing_fault fault;
    int piece, other;    /* indices: of CROSSES other < piece */
    fw_geometry_vec2 at; /* where */
} fw_drawing_flaw;

#define FW_DRAWING_SAME_M 1e-9 /* ends nearer than this are one point */

/* The outline through `start` and the pieces (n), counter-clockwise whichever way it was drawn.
   FW_GEOMETRY: *flaw says why not. Arcs: radius c/(2 sin(s/2)), centre c/(2 tan(s/2)) beside the
   middle of the chord c. Cost: n^2 boxes. Test: test_drawing_trace.c */
fw_status fw_drawing_trace(fw_arena *arena, fw_geometry_vec2 start, const fw_drawing_piece *piece,
                           int n, fw_geometry_contour *out, fw_drawing_flaw *flaw);

/* ---- files ---- */

typedef struct fw_drawing_outline {
    fw_geometry_contour contour; /* counter-clockwise, m, in the file's axes */
    bool hole;                   /* DXF: it lies within another */
    int line;                    /* of the file where it begins; GDSII: number of the record */
} fw_drawing_outline;

typedef struct fw_drawing {
    fw_drawing_outline *outline; /* (count) */
    int count;
} fw_drawing;

typedef struct fw_drawing_asked {
    const char *file;     /* as in messages */
    const char *layer;    /* NULL: the only one that has closed outlines */
    const char *cell;     /* GDSII; NULL: the only one */
    double unit_m;        /* what one unit of a DXF file is; NaN: what the file says */
    const char *unit;     /* its symbol; NULL: not stated */
    fw_place place;       /* where the file was asked for, */
    fw_place unit_place;  /* its unit, */
    fw_place cell_place;  /* cell */
    fw_place layer_place; /* and layer */
} fw_drawing_asked;

/* Which of the two formats it is, its first bytes say. FW_INPUT: reported (FW-D312 to FW-D315,
   FW-D319). Cost: linear in the bytes, and pieces squared where lines and arcs are put together. */
fw_status fw_drawing_read(fw_arena *arena, const char *data, size_t n,
                          const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out);

/* dxf_reader.c: closed LWPOLYLINE and POLYLINE with bulges, CIRCLE, and chains of LINE, ARC and
   open polylines, of ENTITIES */
fw_status fw_drawing_read_dxf(fw_arena *arena, const char *data, size_t n,
                              const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out);
/* gds_reader.c: BOUNDARY and BOX of one cell */
fw_status fw_drawing_read_gds(fw_arena *arena, const char *data, size_t n,
                              const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out);

/* what a flaw is, for a message about a file: "does not close: ..." */
const char *fw_drawing_flaw_text(fw_arena *arena, const fw_drawing_flaw *flaw);

/* ---- between the two halves of the reader of DXF: what was read of the text (dxf_reader.c), and the outlines that
   are made of it (dxf_outlines.c) ---- */

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
