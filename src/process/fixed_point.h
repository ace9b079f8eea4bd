/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where edges end up: the bias of the mask, the gaps it leaves, the time of the etch and what that
   etch takes sideways depend on each other and are solved together. Everybody who needs an edge, a
   time or a bias reads this one struct: masks, recipe, verdict. Theory: docs/theory/etching.md,
   "Bias, time and gap". */
#ifndef FW_PROCESS_FIXED_POINT_H
#define FW_PROCESS_FIXED_POINT_H
#include "base/arena.h"
#include "base/status.h"
#include "quantity/quantity.h"
#include <stdbool.h>

/* <corner of>: what a flow does not make exactly as drawn */
typedef enum fw_process_corner_of {
    FW_CORNER_EDGE,       /* m: edges stand out of the drawn ones */
    FW_CORNER_TAPER,      /* rad: of the walls, about mid-depth */
    FW_CORNER_ANISOTROPY, /* 1: of the etch that cuts the device layer */
    FW_CORNER_THICKNESS,  /* m: of the device layer */
    FW_CORNER_YOUNGS,     /* of the material as it is */
    FW_CORNER_LOCAL       /* m: edges of one hinge against those of the others */
} fw_process_corner_of;

typedef struct fw_process_corner { /* <corner of q assumed>: an input of what stands in the end */
    fw_process_corner_of of;
    const char *name;           /* "printed edge" */
    const fw_quantity *q;       /* its range; NULL: the material's own (youngs) */
    const fw_quantity *assumed; /* range taken where q is unknown; may be NULL */
    const fw_quantity *within;  /* holds this one, too, once it was measured; may be NULL */
    /* of a thickness that is a length: what the flow aimed at where it was stated, which its range is about; 0: q itself, or
       q is the share of what is planned */
    double aim_m;
    bool etched; /* of an edge: q is uncertain by what the flow's isotropic etches are */
    fw_place place;
} fw_process_corner;

/* is it a thickness that is stated as its share of the planned one? */
bool fw_process_corner_is_share(fw_process_corner_of of, const fw_quantity *q);
/* false: what was measured holds it already */
bool fw_process_corner_counts(const fw_process_corner *corner);

struct fw_process_flow;
struct fw_process_step;
struct fw_process_exposed;
struct fw_process_mask_facts;

/* of openings in the drawn layout */
typedef enum fw_process_gap_kind {
    FW_GAP_FIELD,
    FW_GAP_SLOT,
    FW_GAP_HINGE,
    FW_GAP_COMB
} fw_process_gap_kind;

typedef struct fw_process_mask_gap { /* an opening of the drawing, between edges of the material */
    fw_process_gap_kind kind;
    const char *name; /* "gap of hinge C" */
    double gap_m;     /* as drawn, > 0 */
} fw_process_mask_gap;

/* What a flow knows of its mask is what it was told. Whether a changed device has a mask, too, is seen when it is drawn:
   by whoever has a drawing, with the flow's quantities as they are. */
typedef enum fw_process_redrawn {
    FW_REDRAWN_MADE,
    FW_REDRAWN_REFUSED,  /* why (n) says by what, cut where it is longer */
    FW_REDRAWN_UNDECIDED /* its openings are outlines that no number of the description widens */
} fw_process_redrawn;

typedef struct fw_process_redraw {
    bool judging; /* the flow is being judged for one: none of its own are looked for */
    /* NULL: nothing is drawn. Every opening at least gap_m wide, a layer of thickness_m; 0: as it is */
    fw_status (*judge)(void *context, double gap_m, double thickness_m, fw_process_redrawn *answer,
                       char *why, size_t n);
    void *context;
} fw_process_redraw;

typedef enum fw_process_face { FW_FACE_MIDDLE, FW_FACE_TOP, FW_FACE_BOTTOM } fw_process_face;

typedef struct fw_process_edge { /* m outside the drawn edge; middle is the mean of the faces */
    double top_m, middle_m, bottom_m;
} fw_process_edge;

typedef enum fw_process_lag_kind {
    FW_LAG_NONE,
    FW_LAG_SLOT,
    FW_LAG_CYLINDER,
    FW_LAG_LINEAR
} fw_process_lag_kind;

typedef struct fw_process_cut { /* a masked etch downward: a <change> with an anisotropy */
    const struct fw_process_step *step;
    const fw_quantity *quantity; /* A as the pack has it, perhaps unknown */
    bool device;                 /* through the device layer; else through a masking layer,
                                    of which the foot alone counts */
    double depth_m, overrun;
    double anisotropy; /* NaN: not known; nothing is then compensated */
    double low, high;  /* of the anisotropy: what is assumed where it is not known, else itself;
                          NaN where nothing is assumed */
    fw_process_lag_kind lag;         /* how narrow openings fall behind */
    double lag_value;                /* S, or c of the linear law; NaN: not known */
    const fw_quantity *lag_quantity; /* the same; NULL: no lag is stated */
    bool own;       /* the lag is in the time of the step; else it is derived beside it */
    bool follows;   /* the time is that of the narrowest opening of the mask */
    double width_m; /* else of this opening; INFINITY: of a wide one */
    fw_process_face compensate; /* the face whose edge the mask brings to where it is drawn */
    double planned_m;           /* R T as planned, without overrun. NaN: the lag is not known */
    double
        etched_m; /* E = R T with overrun: the floor of a wide opening would be so deep. NaN likewise */
    double least_m;     /* the same; where the lag is not known what it is at least, without any */
    double mask_m;      /* what the mask adds at every edge for this etch */
    double reach_slope; /* d E/d(edge in the masking layer), 1 */
} fw_process_cut;

typedef struct fw_process_edge_class { /* one width of opening, in ascending order of `drawn_m` */
    fw_process_gap_kind kind;
    const char *name;
    double drawn_m, plate_m; /* as drawn; on the mask */
    double opening_m;        /* in the layer that masks the last etch: what that etch sees */
    double reach_m;          /* R t until its floor is through, of the cut of the device; NaN */
    double through_s;        /* the same as a time; NaN until steps are computed */
    double over_etch;        /* E/reach - 1; below 0: not through in the whole time. NaN */
    fw_process_edge edge;    /* where the edges of the material stand: the known part */
    fw_process_edge low,
        high; /* at the ends of all ranges of the pack's corners, and of what is worn; NaN: A has none */
} fw_process_edge_class;

typedef struct fw_process_wear {  /* what the device itself loses of every open face, walls too */
    double loss_m, uncertainty_m; /* in all such steps: the known part */
    double after_m;               /* of it, what is taken once a release begins */
    double most_m;       /* where each of them runs to its stop time, at its rate as it is known */
    const char *missing; /* what must be known to say how much a step takes; NULL: nothing */
    bool never; /* ... which no laboratory can state: the mask alone gives it, or nothing does */
    const struct fw_process_step *step; /* the first of them; NULL: there is none */
    const struct fw_process_exposed *exposed;
} fw_process_wear;

/* between which losses the corners of a verdict lie; m */
void fw_process_wear_range(const fw_process_wear *w, double *low, double *high);

enum { FW_CUTS = 4 };

typedef struct fw_process_fixed_point {
    bool solved;          /* false: no mask brings the edges to where they are drawn */
    double bias_m;        /* of the mask, per edge outward: sum of printed, wet, etch and worn */
    double printed_m;     /* against what is known of printing */
    double wet_m, etch_m; /* against isotropic etches, against cuts of known anisotropy */
    bool wet_open;        /* the depth of an isotropic etch is not known */
    fw_process_wear wear; /* against what steps take of the walls that stand */
    bool
        open; /* an anisotropy is not known (or the time of its cut), or where edges or walls come out */
    double low_m, high_m; /* bias that the ends of what is assumed would ask for; NaN: none */
    double slope;         /* F' at the solution: below 1, what a plain iteration contracts by */
    int iterations;       /* of Newton's method */
    double
        edges_u_m; /* standard uncertainty of an edge in the layer that masks the cut: of all those corners */
    double off_low_m, off_high_m; /* range of the <corner>s of edges about what is known, <= 0 <= */
    double flare_off_m;           /* the same of the walls: either way */
    double flare_m;              /* known slope of the walls: bottom wider than top by twice this */
    fw_process_cut cut[FW_CUTS]; /* (ncut) */
    int ncut;
    fw_process_edge_class *cls; /* (ncls) narrowest first, the open field last */
    int ncls;                   /* 0: nothing is drawn yet */
    int field;                  /* the class of the open field, beside which flexures stand */
    double least_gap_m;         /* not solved: drawn narrowest gap from which on it is. NaN */
    double least_anisotropy; /* not solved: the same for the anisotropy of the device's cut. NaN */
} fw_process_fixed_point;

/* In: a flow as read (its steps need not be computed), what the mask says of the drawing (NULL:
   nothing drawn), the device layer's thickness in m (0 or NaN: the pack's). FW_OK also when there
   is no solution. Pure: the same inputs give the same doubles. */
fw_status fw_process_fixed_point_solve(fw_arena *arena, const struct fw_process_flow *flow,
                                       const struct fw_process_mask_facts *facts,
                                       double thickness_m, fw_process_fixed_point *out);
/* does what a step takes of the device itself go by the reach of a release, which its drawing alone gives? */
bool fw_process_flow_wears_by_reach(const struct fw_process_flow *flow);
/* is this lag (S, or c) only assumed? Then neither the step's time nor the bias contains it. */
bool fw_process_lag_is_guess(const fw_quantity *lag);
/* where printing leaves the edge: the plate's, less what is known of printing */
double fw_process_fixed_point_printed_m(const fw_process_fixed_point *p);
/* Known slope of printed walls, d(edge)/dz. Where the device is cut out of a layer the corner `taper` is of that cut, else
   of the resist that the device grows in. device_m: thickness of its layer */
double fw_process_fixed_point_slope(const fw_process_fixed_point *p, double device_m);
/* extra depth R (t - D/R) that an opening of w_m needs until its floor is at depth_m; m */
double fw_process_cut_lag(const fw_process_cut *cut, double w_m, double depth_m);
/* E - D - lag, at least 0: what of the whole time is left when the floor is through; m. A lag that
   is not known counts as none, here as in E. */
double fw_process_cut_foot(const fw_process_cut *cut, double w_m);
/* where the edges beside an opening of w_m stand if the anisotropies of the cuts were A[i]
   (ncut); NaN counts as 1 */
fw_process_edge fw_process_fixed_point_edge(const fw_process_fixed_point *p, double w_m,
                                            const double *A);
/* the cut whose anisotropy is this quantity; NULL */
const fw_process_cut *fw_process_fixed_point_cut(const fw_process_fixed_point *p,
                                                 const fw_quantity *anisotropy);

#endif
