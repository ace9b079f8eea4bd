/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed outlines that somebody drew: from points and arcs, or from the bytes of a DXF or GDSII
   file. Lines and arcs stay lines and arcs. Files are hostile until read: sizes are bounded, and
   what is wrong is a diagnostic with its line (GDSII: its record). */
#ifndef FW_DRAWING_DRAWING_H
#define FW_DRAWING_DRAWING_H
#include "geometry/contour.h"
#include "geometry/merge.h"
#include "geometry/polygon.h"

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
    int segments_most;    /* of a DXF file; 0: FW_DRAWING_SEGMENTS_MOST, */
    int outlines_most;    /* 0: FW_DRAWING_OUTLINES_MOST */
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
   open polylines, of ENTITIES and of the blocks that these insert */
fw_status fw_drawing_read_dxf(fw_arena *arena, const char *data, size_t n,
                              const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out);
/* gds_reader.c: BOUNDARY and BOX of one cell */
fw_status fw_drawing_read_gds(fw_arena *arena, const char *data, size_t n,
                              const fw_drawing_asked *asked, fw_diags *diags, fw_drawing *out);

/* ---- cells: finished drawings that are placed on a mask as they are ----
   A cell of a GDSII file with all that it refers to, or a DXF file, as polygons on the 1 nm grid, merged
   for each layer that they go to. */

enum {
    FW_DRAWING_MAPS_MOST = 32,        /* "1/0>mask" of one cell */
    FW_DRAWING_DEEPEST = 32,          /* cells within cells */
    FW_DRAWING_SHAPES_MOST = 1000000, /* polygons, and references followed, of one cell */
    FW_DRAWING_POINTS_MOST = 2000000, /* of its polygons before they are merged, */
    FW_DRAWING_PARTS_MOST = 4000,     /* polygons after that, */
    FW_DRAWING_CORNERS_MOST = 200000, /* and their vertices; */
    FW_DRAWING_DXF_MOST = 20000,      /* lines and arcs of one of its layers */
};

typedef struct fw_drawing_map { /* layers="FROM>TO; ..." */
    const char *from, *to;
    int layer, type; /* of `from` in a GDSII file; type -1: any */
    bool found;      /* something lay on it */
} fw_drawing_map;

typedef struct fw_drawing_cell_asked {
    const char *file, *cell;   /* cell NULL: the only top cell */
    const char *unit;          /* of a DXF file; NULL: what the file says */
    double unit_m;             /* its size; else NaN */
    const fw_drawing_map *map; /* (nmap); 0: the only layer, to `usual` */
    int nmap;
    const char *usual;
    fw_geometry_pose pose; /* mirrored first (y becomes -y), then turned, then moved */
    bool mirrored;
    fw_place place, cell_place, unit_place, layers_place;
} fw_drawing_cell_asked;

typedef struct fw_drawing_cell_layer { /* all that goes to one layer */
    const char *to;
    /* (n) of lines between points of the grid, counter-clockwise; what two share because a hole was cut
       open there is a JOINT of both */
    fw_geometry_contour *outline;
    int n;
    fw_geometry_box box;
} fw_drawing_cell_layer;

typedef struct fw_drawing_cell {
    const char *name;             /* of the cell; of a DXF file NULL */
    fw_drawing_cell_layer *layer; /* (nlayer) in the order of the map */
    int nlayer;
} fw_drawing_cell;

/* FW_INPUT: reported at the place that asked, with the byte of the file (FW-D565 to FW-D569). Points that
   do not lie on the grid are rounded to it, half up, and counted in a note (FW-D573). Exact on the grid:
   fw_geometry_merge. Cost: linear in the bytes and in what references multiply, then n log n. Test:
   test_drawing_cell.c */
fw_status fw_drawing_cell_read(fw_arena *arena, const char *data, size_t n,
                               const fw_drawing_cell_asked *asked, fw_diags *diags,
                               fw_drawing_cell *out);

/* the outline through points of the grid; outlines of merged polygons, whose cuts are JOINTs of both sides */
fw_status fw_drawing_outline_of(fw_arena *arena, const fw_geometry_polygon *polygon,
                                fw_geometry_contour *out);
fw_status fw_drawing_outlines_of(fw_arena *arena, const fw_geometry_merged *merged,
                                 fw_geometry_contour **out);

/* what a flaw is, for a message about a file: "does not close: ..." */
const char *fw_drawing_flaw_text(fw_arena *arena, const fw_drawing_flaw *flaw);

/* ---- between the files of the readers of GDSII: records, and what a cell is flattened to ---- */

/* kinds of records of the GDSII stream format, release 6 */
enum {
    FW_DRAWING_UNITS = 0x03,
    FW_DRAWING_ENDLIB = 0x04,
    FW_DRAWING_BGNSTR = 0x05,
    FW_DRAWING_STRNAME = 0x06,
    FW_DRAWING_ENDSTR = 0x07,
    FW_DRAWING_BOUNDARY = 0x08,
    FW_DRAWING_PATH = 0x09,
    FW_DRAWING_SREF = 0x0a,
    FW_DRAWING_AREF = 0x0b,
    FW_DRAWING_TEXT = 0x0c,
    FW_DRAWING_LAYER = 0x0d,
    FW_DRAWING_DATATYPE = 0x0e,
    FW_DRAWING_WIDTH = 0x0f,
    FW_DRAWING_XY = 0x10,
    FW_DRAWING_ENDEL = 0x11,
    FW_DRAWING_SNAME = 0x12,
    FW_DRAWING_COLROW = 0x13,
    FW_DRAWING_NODE = 0x15,
    FW_DRAWING_STRANS = 0x1a,
    FW_DRAWING_MAG = 0x1b,
    FW_DRAWING_ANGLE = 0x1c,
    FW_DRAWING_PATHTYPE = 0x21,
    FW_DRAWING_BOX = 0x2d,
    FW_DRAWING_BOXTYPE = 0x2e,
    FW_DRAWING_BGNEXTN = 0x30,
    FW_DRAWING_ENDEXTN = 0x31
};
typedef struct fw_drawing_record {
    int kind;
    size_t offset; /* of its first byte in the file */
    const unsigned char *data;
    size_t length; /* of data */
} fw_drawing_record;
/* the record at *at, which moves behind it; what is wrong with it, or NULL (gds_reader.c) */
const char *fw_drawing_record_next(const char *data, size_t n, size_t *at, fw_drawing_record *out);
/* numbers of a record: big-endian, and the real number of eight bytes */
static inline unsigned fw_drawing_u16(const unsigned char *p) {
    return (unsigned)p[0] << 8 | p[1];
}
static inline int fw_drawing_i32(const unsigned char *p) {
    return (int)((unsigned)p[0] << 24 | (unsigned)p[1] << 16 | (unsigned)p[2] << 8 | p[3]);
}
double fw_drawing_real8(const unsigned char *p);

typedef struct fw_drawing_shape {
    int map;                     /* index of what takes it */
    fw_geometry_polygon polygon; /* in either direction, may cross itself */
    bool hole;                   /* of a DXF file: cut out of the others */
} fw_drawing_shape;

typedef struct fw_drawing_flat { /* a cell without its hierarchy */
    fw_arena *arena;
    fw_diags *diags;
    const fw_drawing_cell_asked *asked;
    fw_drawing_map *map; /* (nmap) */
    int nmap;
    fw_drawing_shape *shape; /* (n) */
    int n, room;
    size_t points;
    fw_drawing_map other[12]; /* (nother) layers of which nothing is taken, */
    int nother;               /* one more than there is room for: and others */
    int rounded;              /* points that were not on the grid */
    const char *name;         /* of the cell */
} fw_drawing_flat;

/* one polygon of n points in nm, in the device's axes. FW_LIMIT: too many; FW_GEOMETRY: too far from the
   origin (trace.c) */
fw_status fw_drawing_flat_add(fw_drawing_flat *flat, int map, const fw_geometry_vec2 *at, int n,
                              bool hole);
/* gds_cells.c */
fw_status fw_drawing_flatten_gds(fw_drawing_flat *flat, const char *data, size_t n);

/* The stroke of a path: a strip of twice `half` along its points, mitred at corners. */
typedef struct fw_drawing_stroke {
    const fw_geometry_vec2 *p; /* (n >= 2) none repeats the one before */
    int n;
    double half, begin, end; /* begin, end: beyond its first and last point */
    bool round;              /* at both ends, of chords that are at most `chord` inside the arc */
    double chord;
} fw_drawing_stroke;
typedef struct fw_drawing_points {
    fw_geometry_vec2 *p; /* (n) */
    int n;
} fw_drawing_points;
/* Polygons that cover it: one, where its segments leave room for the mitres on their inner sides; else one
   for each segment and each corner, which is mitred up to a right angle and beyond is cut off half a width behind its point, as
   KLayout draws paths: the format does not say how corners are (trace.c) */
fw_status fw_drawing_stroke_parts(fw_arena *arena, const fw_drawing_stroke *stroke,
                                  fw_drawing_points **part, int *n);

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

typedef struct fw_drawing_block { /* of DXF: a drawing that INSERT places */
    const char *name, *begin;     /* of its first entity */
    int line;                     /* before that */
    fw_geometry_vec2 base;
    bool open; /* it is being placed */
} fw_drawing_block;

typedef struct fw_drawing_frame { /* p goes to (xx x + xy y + x, yx x + yy y + y) */
    double xx, xy, yx, yy, x, y;
} fw_drawing_frame;

static inline fw_geometry_vec2 fw_drawing_placed(const fw_drawing_frame *f, fw_geometry_vec2 p) {
    return (fw_geometry_vec2){f->xx * p.x + f->xy * p.y + f->x, f->yx * p.x + f->yy * p.y + f->y};
}

typedef struct fw_drawing_layer { /* of DXF, as its tables have it */
    const char *name;
    bool off, frozen; /* the drawing does not show what lies on it */
} fw_drawing_layer;

typedef struct fw_drawing_dxf {
    fw_arena *arena;
    fw_diags *diags;
    const fw_drawing_asked *asked;
    const char *at, *end;
    int line;
    const char *pair_at; /* where the pair `now` begins, behind line */
    int pair_line;
    fw_drawing_pair now;
    fw_drawing_block *block; /* (nblock) */
    int nblock, block_room;
    fw_drawing_layer *layer_row; /* (nlayer_row) */
    int nlayer_row, layer_room;
    const char *code_page; /* of names that are no UTF-8; NULL: ANSI_1252 */
    const char *other
        [12]; /* (nother) other layers than the one that is asked for, on which something lies */
    size_t nother;          /* one more than there is room for: there are others */
    fw_drawing_frame frame; /* of the block that is being placed, in the drawing */
    const char
        *inherited;  /* layer of its INSERT, which its layer 0 stands for; NULL: there is none */
    int depth, work; /* blocks within blocks; entities of blocks that were placed */
    bool no_memory;
    bool failed, over;     /* nothing more can be read; the text is at its end */
    int insunits;          /* -1: not said */
    unsigned told;         /* a bit for each kind of entity that was passed over with a warning */
    const char *layer;     /* the only one so far that had something; NULL */
    fw_drawing_edge *edge; /* (nedge) */
    int nedge, edge_room;
    fw_drawing_run *closed; /* (nclosed) runs of edges that are closed as they are */
    int nclosed, closed_room;
} fw_drawing_dxf;

static inline fw_place fw_drawing_dxf_place(const fw_drawing_dxf *dxf, int line) {
    return (fw_place){dxf->asked->file, line, 1};
}
/* a layer on which something lies that was not asked for */
fw_status fw_drawing_dxf_note_other(fw_drawing_dxf *dxf, const char *layer);
/* a name of the file in UTF-8: \U+XXXX is one character, and bytes that are no UTF-8 are of the drawing's code page, as in files of
   before 2007; NULL: no memory */
const char *fw_drawing_dxf_name(const fw_drawing_dxf *dxf, const char *value, size_t n);
/* how many edges are taken; one more edge, in units of the file and placed by the frame; the edges from `first` on are a closed
   line. What is too much is reported, and dxf->failed */
int fw_drawing_dxf_most(const fw_drawing_dxf *dxf);
fw_status fw_drawing_dxf_edge(fw_drawing_dxf *dxf, fw_geometry_vec2 a, fw_geometry_vec2 b,
                              double sweep_rad, int line);
fw_status fw_drawing_dxf_close(fw_drawing_dxf *dxf, int first, int line);
/* closed runs and chains of edges to outlines in metres; FW_INPUT: reported */
fw_status fw_drawing_dxf_outlines(fw_drawing_dxf *dxf, fw_drawing *out);

#endif
