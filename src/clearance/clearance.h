/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How near does anything that moves come to anything that it may meet: over a whole motion, between
   its samples too, and over boxes of poses. Distances are those of the outlines as drawn, at poses
   of the bodies; what a flow makes of the walls comes off them (verdict/).

   Theory: docs/theory/clearance.md. */
#ifndef FW_CLEARANCE_CLEARANCE_H
#define FW_CLEARANCE_CLEARANCE_H
#include "dynamics/dynamics.h"
#include "layout/layout.h"
#include "mechanism/mechanism.h"
#include <math.h>

/* ---- clearance_things.c: what may meet what ---- */

/* a part of an outline, where it is drawn */
typedef struct fw_clearance_edge {
    fw_geometry_segment segment;
    int hinge;   /* in whose own region it lies (keep-out circle); FW_NONE: in none */
    int other;   /* the solid on the other side of that hinge; FW_NONE */
    int held;    /* of a tether: the body that it holds; FW_NONE: none */
    bool bends;  /* a disc that holds a flexure */
    bool always; /* a wall of the die's edge, whatever a scene lets its body meet on the ground */
    const char *label;
} fw_clearance_edge;

/* what moves as one: a body (0 .. nbody - 1) or, last, all that stands on the ground */
typedef struct fw_clearance_solid {
    fw_clearance_edge *edge; /* (count) */
    int count;
    fw_geometry_box box;
    fw_geometry_vec2 centre; /* of mass, as drawn: what poses refer to */
    double turned_rad;       /* its pose as drawn */
} fw_clearance_solid;

typedef struct fw_clearance_things {
    fw_clearance_solid *solid; /* (nbody + 1) */
    int nbody;
} fw_clearance_things;

/* Outlines of bodies with their halves of hinges, rotor fingers, eyelets and stubs; frame, base,
   anchors, tethers and stators, and where the dicing lane begins. Lettering and marks are no walls.
 */
fw_status fw_clearance_things_of(fw_arena *arena, const fw_layout *layout,
                                 const fw_mechanism *mechanism, fw_clearance_things *things);

/* ---- clearance_motion.c: a motion as polynomials ---- */

enum { FW_CLEARANCE_NODES = FW_PIECE_NODES };

/* Places are on the substrate: what stands is as it is drawn, and bodies are where they then are, and longer where a free
   strain has made them so. */
typedef struct fw_clearance_path { /* pieces of one motion, one after the other */
    int nq, npiece, capacity;      /* nq: three of every body, and by how much bodies are longer */
    bool begun;                    /* `start` is there */
    double *start;                 /* (nq) where the motion begins; stays when pieces go */
    double *node;                  /* (nq x FW_CLEARANCE_NODES) work */
    int njump;                     /* pieces that are straight ways of jumps; stays, too */
    double jump_s, jump_m; /* the largest of them: when, and how far a centre of mass goes */
    int *nodes;            /* (capacity) coefficients of a piece: its degree and one */
    double *t_s;           /* (capacity x 2) from, to */
    double *bern;          /* (capacity x nq x FW_CLEARANCE_NODES) Bernstein coefficients; m, rad */
    int of;                /* nodes that `fit` is for; 0: none yet */
    double fit[FW_CLEARANCE_NODES]
              [FW_CLEARANCE_NODES]; /* values at equal spacing to coefficients */
} fw_clearance_path;

fw_status fw_clearance_path_new(fw_arena *arena, int nbody, fw_clearance_path *path);
/* room for so many pieces */
fw_status fw_clearance_path_of(fw_arena *arena, int nbody, int pieces, fw_clearance_path *path);
bool fw_clearance_path_full(const fw_clearance_path *path);
void fw_clearance_path_add(fw_clearance_path *path, const fw_dynamics_piece *piece);

/* part of a path: whole pieces, or of one piece the part from `from` to `to` */
typedef struct fw_clearance_span {
    int first, last; /* pieces, both included */
    double from, to; /* 0..1 of the only piece; of several: 0, 1 */
} fw_clearance_span;
/* coefficients of a coordinate over a part of a piece */
const double *fw_clearance_path_coefficients(const fw_clearance_path *path, int piece, int q);
void fw_clearance_path_part(const fw_clearance_path *path, int piece, int q, double from, double to,
                            double out[FW_CLEARANCE_NODES]);
double fw_clearance_path_value(const fw_clearance_path *path, int piece, int q, double theta);

typedef struct fw_clearance_pose { /* of a solid's centre of mass; the ground's never changes */
    double x_m, y_m, phi_rad;
    double longer; /* by how much its outlines are, relative, about that centre */
} fw_clearance_pose;

typedef struct fw_clearance_meet { /* the nearest places of two outlines at a pose of each */
    double distance_m;             /* 0: they meet */
    fw_geometry_vec2 at_a, at_b;   /* world */
    const char *a, *b;             /* labels */
    const fw_clearance_edge *edge[2];
    bool bound;  /* one of them only holds what it stands for: a flexure's disc */
    bool lane;   /* one of them is the die's edge */
    bool tether; /* one of them stands by a tether, broken or not */
} fw_clearance_meet;

/* ---- clearance_motion.c: the least clearance over a motion ---- */

typedef struct fw_clearance_least {
    bool known;    /* something moved against something else */
    double m;      /* distance of the pair of which the least is left, where it is */
    double left_m; /* that less what the motion may be off by there; -HUGE_VAL: they meet */
    double low_m;  /* proved: no pair has less left anywhere */
    fw_clearance_meet at;
    double t_s;
    double platform[3];        /* of a box of poses: its displacement there, m, m, rad */
    int a, b;                  /* bodies; FW_GROUND */
    fw_clearance_pose pose[2]; /* there */
    double moved_m;            /* how far the pair moved at most; HUGE_VAL: not known */
    double farthest_m;         /* and any pair, at most */
    double start_m;            /* distance of the pair where the motion begins */
    double share;              /* of went_m: where they meet first; 1: they do not */
    double went_m; /* where they meet: how far the pair is from its start where it is farthest */
    long looked;   /* distances that were computed */
    bool given_up; /* too many: low_m is what was proved by then */
} fw_clearance_least;

/* before anything was looked at */
static inline fw_clearance_least fw_clearance_nothing(void) {
    return (fw_clearance_least){.low_m = HUGE_VAL, .m = HUGE_VAL, .left_m = HUGE_VAL, .share = 1};
}

/* of required poses: how far the pair goes has no bound, so that nothing is known of how near it comes */
static inline bool fw_clearance_has_no_band(const fw_clearance_least *l) {
    return l->m > 0 && !isfinite(l->moved_m);
}

typedef struct fw_clearance_wish {
    /* (nsolid x nsolid) pairs of which nothing is said, but for the die's edge; NULL: none */
    const bool *may_meet;
    const bool *left_out; /* (nsolid) solids of which nothing is said; NULL: none */
    double relative;      /* error wanted of the least clearance, beside 1 nm */
    double off;           /* of what a pair is moved by the motion may be off by so much */
    double enough_m;      /* a bound of this is enough, and the least is then not looked for;
                             HUGE_VAL: it is */
    double beyond;        /* both that and needed_m are more by so much of what moves farthest */
    double needed_m;      /* a bound below this decides nothing yet, */
    long most, most_ever; /* so many distances, and as many while it decides nothing */
} fw_clearance_wish;

/* looks at everything in the path and keeps the least of it and of what `least` has; the path may
   then be used again */
fw_status fw_clearance_of_path(fw_arena *arena, const fw_clearance_things *things,
                               const fw_clearance_path *path, const fw_clearance_wish *wish,
                               fw_clearance_least *least);

/* What would come first to a distance if all went further the same way. The nearest pair need not:
   fingers of a comb slide by each other at one gap and come to their roots. */
typedef struct fw_clearance_way {
    double share;        /* of the way there that the motion takes: the largest of all pairs */
    const char *a, *b;   /* labels; NULL: no share is above that which was asked about */
    fw_geometry_vec2 at; /* where they would come to it */
    double t_s,
        start_m; /* when the motion is farthest that way; distance of a and b at its start */
} fw_clearance_way;

/* Of what is in the path: of pairs that are looked at and move against each other, from where they are at the
   start of the motion. way->share: in, what is known already; only larger ones are looked for */
fw_status fw_clearance_way_of_path(fw_arena *arena, const fw_clearance_things *things,
                                   const fw_clearance_path *path, const fw_clearance_wish *wish,
                                   double within_m, fw_clearance_way *way);

/* ---- clearance_gap.c: the distance of two outlines, for probes ---- */

typedef struct fw_clearance_gap fw_clearance_gap;
/* Of a and b (FW_GROUND: all that stands), without flexures and the die's edge. NULL: one of them has
   no outline, or all of it lies within a hinge between them */
fw_status fw_clearance_gap_new(fw_arena *arena, const fw_clearance_things *things, int a, int b,
                               const fw_clearance_gap **gap);
/* as drawn; q: (3 nbody) centres of mass, m, rad; longer: all bodies, relative */
double fw_clearance_gap_m(const fw_clearance_gap *gap, const double *q, double longer);
double fw_clearance_gap_drawn_m(const fw_clearance_gap *gap);
/* how far the two have been moved against each other, at most, from where they are drawn */
double fw_clearance_gap_moved_m(const fw_clearance_gap *gap, const double *q, double longer);

typedef struct fw_clearance_gap_extreme {
    double m, t_s;  /* the least or largest so far */
    double bound_m; /* proved: none is beyond this */
    double moved_m; /* the largest of what they were moved */
} fw_clearance_gap_extreme;
/* the least (sign -1) or largest (1) distance over the one piece of a path, where it is beyond that
   which is known */
void fw_clearance_gap_over(const fw_clearance_gap *gap, const fw_clearance_path *path, double sign,
                           fw_clearance_gap_extreme *known);

/* ---- clearance_box.c: the least clearance over a required box of the six-bar's poses ---- */

/* Every pose of the box, on the drawn branch. What rides on the six-bar goes with the body that it
   hangs on; *open: a body whose pose does not follow from the platform's, which is not looked at;
   FW_NONE: none. false in *known: no such proof for this mechanism */
fw_status fw_clearance_of_box(fw_arena *arena, const fw_clearance_things *things,
                              const fw_mechanism *mechanism, const fw_device_workspace_box *box,
                              const fw_clearance_wish *wish, fw_clearance_least *least, bool *known,
                              int *open);

/* ---- clearance_strip.c: the strip of a flexure, and where it can be when it bends ---- */

typedef struct fw_clearance_strip_part { /* of an edge, as drawn */
    fw_geometry_segment segment;
    double from_m, to_m; /* along the strip from the lower body's root, at its two ends */
} fw_clearance_strip_part;

typedef struct fw_clearance_strip {
    bool known;
    const fw_layout_hinge_layout *hinge;
    fw_clearance_strip_part *part; /* (count) */
    int count;
    double length_m; /* of the longer edge */
} fw_clearance_strip;

typedef struct fw_clearance_bend { /* bounds of what bends it */
    bool known;
    double strain;          /* of any fibre */
    double width_m;         /* the least */
    double curvature_per_m; /* change of it */
    double forced_per_m;    /* of that, what forces add to a pure moment; HUGE_VAL: not known */
    double turn_rad;        /* of the hinge, either way */
    double root_share;      /* of that, what both roots take */
    bool straight;          /* and of one width, so that forces bend it linearly */
} fw_clearance_bend;

fw_status fw_clearance_strip_of(fw_arena *arena, const fw_layout *layout,
                                const fw_layout_piece *piece, fw_clearance_strip *strip);
/* at the elastic limit with its safety factor; turn_rad is left 0 */
fw_clearance_bend fw_clearance_bend_of(const fw_mechanism *mechanism,
                                       const fw_mechanism_hinge *hinge);
/* A strip that keeps off its bodies when it bends like a does when it bends like b: no bound of b is larger. */
bool fw_clearance_bend_covers(const fw_clearance_bend *a, const fw_clearance_bend *b);
/* what a point s_m from a root goes by against the body there, at most */
double fw_clearance_bend_at(const fw_clearance_bend *bend, double s_m);
/* radius about the hinge point within which it stays */
double fw_clearance_strip_reach(const fw_clearance_strip *strip, const fw_clearance_bend *bend);

/* an edge of its own two bodies that it is not proved to keep off; NULL: none */
fw_status fw_clearance_strip_meets(fw_arena *arena, const fw_clearance_things *things,
                                   const fw_clearance_strip *strip, const fw_clearance_bend *bend,
                                   double wall_m, const fw_clearance_edge **met);

#endif
