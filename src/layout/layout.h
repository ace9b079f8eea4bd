/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is drawn: exact outlines of every body, flexure, conjugate surface, frame, tether and mark.

   Pieces never overlap. Where a flexure meets a body both share one straight edge (a JOINT segment)
   bit for bit, so that the union of all pieces is the device and no boolean is ever needed on the
   mask. Each body's own pieces give its area, centroid and second moment. */
#ifndef FW_LAYOUT_LAYOUT_H
#define FW_LAYOUT_LAYOUT_H
#include "device/device.h"
#include "geometry/contour.h"

/* what a piece is; masks/ maps roles to layers */
typedef enum fw_layout_role {
    FW_ROLE_STRUCTURE, /* links, platform, base: what is left standing */
    FW_ROLE_FLEXURE,   /* thin parts; the same material as the structure */
    FW_ROLE_FRAME,     /* die frame */
    FW_ROLE_TETHER,    /* broken before use */
    FW_ROLE_TEXT,      /* title and parameters, polygons */
    FW_ROLE_MARK,      /* alignment marks */
    FW_ROLE_DICING,    /* lane */
    FW_ROLE_BACK,      /* marks of the back side, as seen from the front */
    FW_ROLE_CAVITY,    /* hollow in the carrier, below what moves */
    FW_ROLE_LAND,      /* within a cavity: what stays of the carrier, below what is held there */
    FW_ROLE_METAL,     /* of bond pads */
    FW_ROLE_COUNT,     /* those that a layer table may name */
    FW_ROLE_CELL       /* of a cell on a layer of its own: nothing of the device */
} fw_layout_role;

/* body of a piece that stands on the carrier by itself, insulated from the rest: stators with their
   leads, pads and lettering. In a flow without an insulating carrier it would fall out, and is left
   out of the mask. */
enum { FW_ISLAND = FW_NONE - 2 };

typedef struct fw_layout_piece {
    fw_layout_role role;
    int body;          /* index, FW_GROUND, FW_ISLAND, or FW_NONE - 1 for marks and text */
    int joint;         /* of a flexure piece, else FW_NONE */
    const char *label; /* for messages: "link AB", "flexure of hinge C" */
    fw_geometry_contour contour;
} fw_layout_piece;

typedef struct fw_layout_hinge_layout { /* per joint */
    bool drawn;
    const char *id;
    fw_place place;              /* of its flexure in the file */
    bool axis_stated;            /* by the file; else the layout chose it */
    fw_geometry_vec2 centre;     /* W = the hinge point, world */
    fw_geometry_vec2 arc_centre; /* O, world */
    double axis_rad;             /* direction O -> W, world */
    int lower, upper;            /* body at the root of polar angle -a and +a */
    double fillet_m;             /* as drawn */
    double surface_radius_m;     /* convex conjugate surface, about W; 0 = none */
    double gap_m;
    double keep_out_m; /* radius about W that belongs to this hinge */
    double free_rad;   /* rotation until solid parts of the two bodies touch, either way */
    fw_geometry_contour solid[2]; /* outlines, as drawn, of what is at `lower` and `upper` */
    int convex;        /* body with the convex surface: the one farther from the ground */
    double facing_rad; /* sector about W in which the surfaces face each other: counter-clockwise */
    double facing_from_rad; /* from here, measured from the axis, where the upper body's ring ends,
                               to where the lower body's ends */
} fw_layout_hinge_layout;

typedef struct fw_layout_body_layout { /* per body; area 0 when it is not drawn */
    double area_m2, perimeter_m;
    fw_geometry_vec2 centroid;  /* world, drawn position */
    double polar_m4;            /* second moment about the centroid */
    fw_geometry_vec2 spread_m4; /* likewise the integral of (x^2 - y^2, 2 x y) */
    fw_geometry_vec2 edge_m2;   /* of the edges about the centroid: integral of x dl, */
    double edge_m3;             /* of |x|^2 dl */
} fw_layout_body_layout;

/* why the layout cannot be made, and where: what an error of the drawing says, for its picture */
typedef struct fw_layout_fault {
    int number;          /* FW-Dnnn */
    const char *message; /* of the error */
    int body[2], nbody;  /* concerned: indices, FW_GROUND, FW_ISLAND */
    int joint[2], njoint;
    fw_geometry_vec2 at;        /* world; NaN: no one place */
    fw_geometry_region overlap; /* what two outlines both cover; count 0: they do not overlap */
} fw_layout_fault;

/* of a comb drive or a plate that moves the device: what the drawing has of it */
typedef struct fw_layout_electrode {
    const fw_device_comb *comb; /* the first of those at this place */
    const char *stator; /* label of its stator's piece, this very pointer; NULL: it is not drawn, */
    const char *why_not; /* for this reason */
    fw_geometry_vec2 at; /* middle of the overlap, or of the rotor's face */
    bool routed;         /* its stator ends in a pad at the edge of the chip */
    fw_geometry_box edge_pad;
} fw_layout_electrode;
/* What the motion has, or the file asks for, and what finds no room in the drawing: an electrode pair,
   an eyelet, the tethers of a body; or what is never drawn: a joint that does not turn, a spring between two
   bodies. It is left out whole, and the device is not accepted with it. */
typedef struct fw_layout_missing {
    int number;                     /* FW-Dnnn of its warning */
    const fw_device_comb *comb;     /* of the device; else NULL */
    const fw_device_eyelet *eyelet; /* the same */
    int body;                       /* that it belongs to, or FW_GROUND */
    const char *name;               /* "comb drive upper", "the tethers of link AB" */
    fw_geometry_vec2 at;            /* world: where it should be */
    fw_place place;
    const char *why;  /* what is in its way, and where: a clause */
    const char *room; /* the nearest change with which it is drawn; NULL: not looked for */
    bool narrow;      /* room, where it lies: its fingers are too narrow */
} fw_layout_missing;
/* what stands between its `why` and its `room` */
const char *fw_layout_missing_way(const fw_layout_missing *missing);

/* pieces of a cell that go to one layer: they have this label, this very pointer */
typedef struct fw_layout_cell {
    const char *label;
    const char *layer; /* as the description names it (fw_mask_layer_named) */
    bool biased;       /* as the device is; else the outlines are those of the mask */
    const fw_device_cell *of;
} fw_layout_cell;

/* marks that a flow aligns its plates by and that find no room on the frame */
typedef struct fw_layout_no_room {
    int count, of;            /* so many of so many */
    const char *id;           /* of the pattern of the first of them */
    fw_geometry_box upright;  /* of the frame, where that one was looked for */
    double width_m, height_m; /* of its box */
    double frame_m;           /* least width of a frame that it lies across */
} fw_layout_no_room;

typedef struct fw_layout_tether { /* a straight finger of the frame with a neck at the body */
    int body;
    const char *label;           /* of its piece: "tether of link AB" */
    fw_geometry_vec2 cut;        /* world: middle of the cut at the body's stub */
    fw_geometry_vec2 outward;    /* unit, from the body to the frame */
    double length_m;             /* from the cut to the inner edge of the frame */
    double finger_m, neck_m;     /* widths */
    double neck_long_m, flare_m; /* from the cut: the neck, then where it widens to the finger */
    double stub_m; /* of the body, straight and as wide as the neck, before it is rounded */
} fw_layout_tether;

typedef struct fw_layout {
    bool drawn; /* false: the mechanism has no shapes; `why_not` says what is missing */
    const char *why_not;
    fw_layout_piece *piece; /* (npiece) */
    int npiece;
    fw_layout_hinge_layout *hinge; /* (device->njoint) */
    fw_layout_body_layout *body;   /* (device->nbody) */
    fw_geometry_box die;           /* outline of the chip with its lane */
    fw_geometry_box window;        /* inner edge of the frame */
    double narrowest_gap_m;        /* least distance between pieces that move apart */
    /* walls stand out from what is drawn by edge_m, and by the flare beside it at one face: 0 as
       drawn (verdict/verdict_fabrication.h) */
    double edge_m, flare_m;
    bool fill;                            /* the flow's thief and fill are wanted in the window */
    const fw_layout_electrode *electrode; /* (nelectrode) each place once */
    int nelectrode;
    /* (nfault) none of a layout that is drawn. Else it cannot be made as it is stated: the pieces
       are what can be shown of it, nothing is measured of what they lack (area 0, hinge not drawn),
       and no mask is made of them */
    fw_layout_fault *fault;
    int nfault;
    fw_layout_tether *tether; /* (ntether) */
    int ntether;
    fw_layout_missing *missing; /* (nmissing) of a layout that is drawn, too */
    int nmissing;
    const fw_layout_cell *cell; /* (ncell) */
    int ncell;
} fw_layout;

/* What a message ends with where a body is too narrow at a place: which number of the file makes the head of a hinge
   wider, which the layout draws, or that the body is to be wider there. layout may be NULL. NULL: out of memory */
const char *fw_layout_wider_there(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  int body, fw_geometry_vec2 at);

/* the cell that a piece is of; NULL: of none */
const fw_layout_cell *fw_layout_cell_of(const fw_layout *layout, const fw_layout_piece *piece);
/* Of what a cell draws on a layer of the device: which of its parts (pieces that touch are one) hang on frame or bases, by
   themselves or by cells in between? What does is one with them on the mask (mask/mask_cells.c). out: (ncell). Cost: pairs of
   pieces of cells, and of these and what is fixed, whose boxes meet. Test: tests/klayout/cells.py */
typedef struct fw_layout_hold {
    int parts, loose;    /* 0 where it draws nothing there */
    fw_geometry_box box; /* of the first loose part */
    const char *of; /* ": 1 of its 2 parts, from ... um," for messages; "" where it is all of it */
} fw_layout_hold;
fw_status fw_layout_cells_hold(fw_arena *arena, const fw_layout *layout, fw_layout_hold **out);
/* pieces of cells behind those of a list: of *layout, whose pieces and cells they become (layout_cells.c) */
fw_status fw_layout_cells_add(fw_arena *arena, const fw_device_cell *cell, int ncell,
                              fw_layout *layout, int *capacity);
/* Do they lie on the die, and clear of what moves, of what bends and of stators? FW_INPUT: reported
   (FW-D571, FW-D572) */
fw_status fw_layout_cells_check(const fw_layout *layout, fw_diags *diags);

/* what is drawn of a drive of a scene; NULL: nothing was planned for it */
const fw_layout_electrode *fw_layout_electrode_of(const fw_layout *layout,
                                                  const fw_device_comb *comb);
/* material of a body, or of what stands, that something may meet: no flexure, lettering or mark */
bool fw_layout_is_wall(const fw_layout_piece *piece);
/* is there such a piece of the body, or of what stands (FW_GROUND)? */
bool fw_layout_has_outline(const fw_layout *layout, int body);
/* by how much two walls come nearer than they are drawn */
double fw_layout_walls_m(const fw_layout *layout);
/* free_rad of a drawn hinge whose solids stand out by out_m, either of them; at the face where they stand out most,
   that is edge + |flare|/2. An edge that ends at a root of the flexure may be off by out_m. Test: test_layout.c */
fw_status fw_layout_free_rotation_made(fw_arena *arena, const fw_layout_hinge_layout *hinge,
                                       double out_m, double *free_rad);

/* FW_GEOMETRY when the parts cannot be drawn: diagnostics name both places, and *layout holds what
   can be shown of it with its faults. */
fw_status fw_layout_build(fw_arena *arena, const fw_device *device, fw_diags *diags,
                          const fw_layout **layout);

/* Is what is missing in a scene of this flow (NULL: the device's own material)? Tethers are of all. */
bool fw_layout_missing_in_flow(const fw_device *device, const fw_layout_missing *missing,
                               const char *flow);
/* *out: the same layout with the nearest room of everything that is missing, each found by drawing the
   device again with a changed copy of the part (layout_room.c). Nothing is missing: *out is layout. */
fw_status fw_layout_rooms_find(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_layout **out);

/* ---- layout_text.c ----
   Lettering, alignment marks and the dicing lane, as polygons that pass a width/space check.

   Letters are drawn on square cells of one stroke, nine high and up to nine wide, two cells apart.
   Every part and every space is at least `stroke` wide; corners are 90 or 270 degrees; closed
   letters (A B D O 0 8 ...) are open through a stencil gap, so there is neither a hole nor an
   island; parts never touch at a corner. Text is UTF-8; the font has ASCII, the letters of Latin-1,
   mu, omega and some signs (glyphs.def). What it lacks is refused, never drawn as something else.
   All coordinates are multiples of 1 nm. */

/* the text, or as much of its beginning as is no longer than length_m, with '+' at its end; "" where
   not even one letter and the '+' are */
fw_status fw_layout_text_fit(fw_arena *arena, const char *string, double height_m, double stroke_m,
                             double length_m, const char **shown);
/* the first character that the font lacks, inside the string; NULL: it has them all */
const char *fw_layout_text_lacks(const char *string);
/* FW_INPUT with an error at `place` (FW-D390) where the font lacks a character of the text, which
   `what` says what it is; else FW_OK */
fw_status fw_layout_text_check(const char *string, const char *what, fw_place place,
                               fw_diags *diags);

/* width of the line of text, m; 0 for "" and for sizes that fw_layout_text refuses */
double fw_layout_text_width(const char *string, double height_m, double stroke_m);

/* appends the letters as pieces with body FW_NONE - 1; `origin` is the lower left corner. Cells are
   height / 9, rounded down to 1 nm. FW_GEOMETRY unless stroke >= 1 nm and height >= 9 stroke, all
   finite and below 1 m, and the font has every character. The three last arguments are a growing array: *npiece used of *capacity. */
fw_status fw_layout_text(fw_arena *arena, const char *string, fw_geometry_vec2 origin,
                         double height_m, double stroke_m, fw_layout_role role, const char *label,
                         fw_layout_piece **piece, int *npiece, int *capacity);

double fw_layout_to_grid(double x_m); /* nearest multiple of 1 nm */

/* four equal arms, each coarse near the centre (half width w, length a) and fine at the tip (f, b):
   the coarse part is found by eye, the fine one is lined up. Counter-clockwise. */
enum { FW_LAYOUT_CROSS = 28 };
void fw_layout_cross(fw_geometry_vec2 centre, double w, double a, double f, double b,
                     fw_geometry_vec2 p[FW_LAYOUT_CROSS]);
/* appends one piece, growing the array */
fw_status fw_layout_add(fw_arena *arena, fw_layout_piece item, fw_layout_piece **piece, int *npiece,
                        int *capacity);

/* appends the title (device->die.title, else the name), the version and the parameters as TEXT,
   crosses and corner brackets as MARK, and four rectangles of the lane as DICING (joined at the
   corners by JOINT segments), all between `window` and `die`. What does not fit with strokes of
   5 um is left out: text loses its last items (then ends in '+'), marks need 80 um of bar beside
   the lane. FW_GEOMETRY when the window is not inside the die. */
fw_status fw_layout_annotate(fw_arena *arena, const fw_device *device, fw_geometry_box window,
                             fw_geometry_box die, fw_diags *diags, fw_layout_piece **piece,
                             int *npiece, int *capacity);

#endif
