/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of layout/ only. Construction and figures: docs/theory/layout.md. */
#ifndef FW_LAYOUT_DRAW_H
#define FW_LAYOUT_DRAW_H
#include "flexure/flexure.h"
#include "layout/layout.h"
#include "layout/layout_rules.h"
#include <math.h>

/* ---- small vectors ---- */
static inline fw_geometry_vec2 fw_v(double x, double y) {
    return (fw_geometry_vec2){x, y};
}
static inline fw_geometry_vec2 fw_add(fw_geometry_vec2 p, double s, fw_geometry_vec2 d) {
    return (fw_geometry_vec2){p.x + s * d.x, p.y + s * d.y};
}
static inline fw_geometry_vec2 fw_sub(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return (fw_geometry_vec2){p.x - q.x, p.y - q.y};
}
static inline double fw_dot(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x * q.x + p.y * q.y;
}
static inline fw_geometry_vec2 fw_left(fw_geometry_vec2 d) {
    return (fw_geometry_vec2){-d.y, d.x};
}
static inline double fw_norm(fw_geometry_vec2 p) {
    return hypot(p.x, p.y);
}
static inline fw_geometry_vec2 fw_polar(double angle_rad) {
    return fw_v(cos(angle_rad), sin(angle_rad));
}
/* unit vector; (1, 0) when the points coincide */
static inline fw_geometry_vec2 fw_towards(fw_geometry_vec2 from, fw_geometry_vec2 to) {
    fw_geometry_vec2 d = fw_sub(to, from);
    double n = fw_norm(d);
    return n > 0.0 ? fw_v(d.x / n, d.y / n) : fw_v(1.0, 0.0);
}

/* local frame: origin, x axis (c, s); mirror: local y points the other way. The same local point
   gives the same world bits whoever asks. */
typedef struct fw_layout_local {
    fw_geometry_vec2 origin;
    double c, s;
    bool mirror;
} fw_layout_local;
fw_geometry_vec2 fw_layout_local_point(const fw_layout_local *local, fw_geometry_vec2 p);

/* an outline given in local coordinates; closes counter-clockwise whatever the mirror */
typedef struct fw_layout_sketch {
    fw_geometry_outline outline;
    const fw_layout_local *local;
} fw_layout_sketch;
fw_layout_sketch fw_layout_sketch_start(fw_arena *arena, const fw_layout_local *local,
                                        fw_geometry_vec2 p);
void fw_layout_sketch_line(fw_layout_sketch *sketch, fw_geometry_vec2 to, unsigned flags);
void fw_layout_sketch_arc(fw_layout_sketch *sketch, fw_geometry_vec2 centre, double sweep_rad,
                          fw_geometry_vec2 to);
fw_status fw_layout_sketch_close(fw_layout_sketch *sketch, fw_geometry_contour *contour);
/* joint: index of a JOINT edge or -1 */
fw_status fw_layout_polygon(fw_arena *arena, const fw_layout_local *local,
                            const fw_geometry_vec2 *p, int n, int joint,
                            fw_geometry_contour *contour);

/* ---- hinges ---- */
/* Flexure and its root at the upper body, in the hinge frame: W at the origin, bulge along +x. The
   root at the lower body is the mirror image. */
typedef struct fw_layout_hinge_shape {
    fw_geometry_vec2 arc_centre;          /* O */
    double strip_sweep_rad;               /* of the flexure between the two cuts; 0: straight */
    double fillet_m, width_m, size_m;     /* size: radius, or half the length of a leaf */
    fw_geometry_vec2 joint_in, joint_out; /* the cut */
    fw_geometry_vec2 outer_start, outer_centre, outer_end; /* fillet on the bulge side */
    fw_geometry_vec2 inner_start, inner_centre,
        inner_end; /* fillet inside; usually ends at joint_in */
    /* edges from the cut to outer_start, and from inner_end to the cut; sweep 0: a line, or none */
    fw_geometry_vec2 edge_centre, inner_edge_centre;
    double edge_sweep_rad, inner_edge_sweep_rad;
    double outer_sweep_rad, inner_sweep_rad;
    fw_geometry_vec2 root, face, into; /* middle of the root; along its face; into the block */
    fw_geometry_vec2 inner_corner;     /* end of the root face inside */
    double reach_m;                    /* farthest of flexure and fillets from W */
    double cut_m;       /* of a path: along the centre line, from the root to the cut */
    unsigned cut_flags; /* JOINT, of a path THROUGH as well */
} fw_layout_hinge_shape;

/* one row per kind of flexure; false: no room for two roots */
typedef struct fw_layout_hinge_drawer {
    fw_device_flexure_kind kind;
    bool (*shape)(const fw_device_flexure *flexure, fw_layout_hinge_shape *shape);
} fw_layout_hinge_drawer;
bool fw_layout_hinge_shape_csfh(const fw_device_flexure *flexure, fw_layout_hinge_shape *shape);
bool fw_layout_hinge_shape_leaf(const fw_device_flexure *flexure, fw_layout_hinge_shape *shape);
/* both roots of a flexure that varies: [0] in the lower body's own (mirrored) frame */
bool fw_layout_hinge_shape_path(const fw_device_flexure *flexure, double fillet_m,
                                fw_layout_hinge_shape shape[2]);

/* dimensions of a head that are free within limits */
typedef struct fw_layout_head_shape {
    double neck;     /* share of the neck's greatest half width */
    double behind;   /* block behind the root, in flexure widths */
    double longer_m; /* neck */
    double wider_m;  /* disc cut out of the body's own plate */
    bool plain;      /* the neck does not widen towards a plate's corner */
} fw_layout_head_shape;
fw_layout_head_shape fw_layout_head_form(int attempt); /* 0: as wanted; then others, without end */

typedef struct fw_layout_side { /* one body at one hinge */
    int body;
    fw_geometry_vec2 direction; /* unit, from W to where its bar or plate lies, world */
    double own_rad;             /* the same in its own (mirrored) hinge frame, from the bulge */
    double half_width_m;        /* of the bar */
    double ring_in_m, ring_out_m, ring_end_rad;
    /* the neck ends in this plate, `plate_at_m` from W; NULL: in a bar */
    const fw_device_body *plate;
    double plate_at_m;
    double drawn_at_m; /* from W to where the neck may end in the body's shapes; 0: it has others */
    double drawn_half_m; /* half the width of what is drawn beside a neck; 0: nothing is */
    double neck_m;       /* half width of the neck between ring and bar */
    double far_m;        /* the same on the side away from the bulge */
    double corner_m;     /* where far_m > neck_m: of the plate's corner, along `direction` */
    double neck_end_m;   /* from W along `direction` */
    double solid_m;      /* from there on the neck is as wide as neck_m on both sides */
    bool straight;       /* a head on the line of its leaf, alike on both sides of it: */
    double root_m;       /* from W to the root; */
    double clear_m;      /* from W to where its own plate may begin beside it; */
    double foot_m;       /* from W to where the middle of its neck begins: 0, in a plate root_m */
    double square_at_m; /* from W to an edge of its plate square to the leaf; 0: it is not square */
    fw_layout_local local;
    fw_geometry_contour head;  /* root block, ring and neck */
    int attempt;               /* at the head's free dimensions, */
    fw_layout_head_shape form; /* which are these */
} fw_layout_side;

/* a uniform leaf without conjugate surfaces: alike on either side of its line, whichever way `axis` points */
bool fw_layout_leaf_is_free(const fw_device_flexure *flexure);

typedef struct fw_layout_hinge_plan {
    fw_layout_hinge_shape shape[2]; /* as seen by each side: alike but for paths */
    fw_layout_side side[2];         /* 0 lower, 1 upper */
    int convex;                     /* which side carries the convex surface */
    fw_geometry_contour flexure;
} fw_layout_hinge_plan;

/* ---- the whole drawing ---- */
typedef enum fw_layout_window_side { FW_LEFT, FW_RIGHT, FW_BOTTOM, FW_TOP } fw_layout_window_side;
/* what meets the frame, from `low` to `high` along the side */
typedef struct fw_layout_attachment {
    int body;
    fw_layout_window_side side;
    double low_m, high_m, stub_m;
    double at_m, cut_m; /* of a tether: along the side, and the depth of its cut */
    /* the way of a tether, from inside the body; count 0 for the base */
    fw_geometry_contour finger;
    fw_geometry_contour tether; /* from the neck to the frame; count 0 for the base */
} fw_layout_attachment;

/* ---- what moves the device: layout_actuators.c, comb.c, eyelet.c ---- */
typedef struct fw_layout_eyelet_plan { /* one ring; several tendons and scenes may use it */
    const fw_device_tendon *tendon;
    const fw_device_eyelet *eyelet;
    fw_geometry_vec2 at; /* world */
    double hole_m, ring_m;
    int wider;               /* row of what is added to the ring; only ever grows */
    bool off;                /* not drawn, and said why */
    bool on_frame;           /* of those on the ground: not on a base */
    fw_geometry_contour cap; /* the piece that closes its ring; count 0: not there yet */
} fw_layout_eyelet_plan;

typedef struct fw_layout_comb_plan { /* one drive; several scenes may use it */
    const fw_device_comb *comb;
    double width_m, length_m;
    /* middle of the overlap, or of the rotor's face; x where the rotor is pulled */
    fw_layout_local local;
    bool off;
    const char *why; /* it is off */
    fw_geometry_contour rotor,
        stator;         /* rotor: before it is united with its body; stator: with pad */
    const char *letter; /* on the pad */
    fw_geometry_vec2 letter_at, pad_at; /* pad_at: middle of what is bonded */
    bool at_edge;                       /* a track is asked for */
    bool routed; /* a track leads to the edge of the chip, and ends there in */
    fw_geometry_box edge_pad;
} fw_layout_comb_plan;

typedef struct fw_layout_track { /* where it goes through the frame */
    bool right;
    double y_m, half_m; /* its middle, and half of the gap in the upright */
} fw_layout_track;

typedef struct fw_layout_shapes {   /* what the description draws of a body, in the world */
    fw_geometry_region solid, hole; /* holes counter-clockwise as well */
    fw_geometry_region all;         /* solid, and the body's own plate as one more of its shapes */
    fw_geometry_region left;        /* of all, and of bars, beside the hinges; heads come on top */
} fw_layout_shapes;

typedef struct fw_layout_drawing {
    fw_arena *arena;
    const fw_device *device;
    fw_diags *diags;
    fw_layout *layout;
    int capacity;
    fw_geometry_vec2 centre; /* mean of the hinge points */
    double lane_m;
    fw_layout_hinge_plan *hinge; /* (njoint) */
    fw_geometry_contour *raw;   /* (nslot) united, not rounded: bodies, then one base for all ground
                                   hinges, or one for each when there are more than two */
    fw_geometry_contour *plain; /* (nslot) rounded, without tethers */
    /* (nslot) rounded, with the stubs that tethers leave; count 0: none */
    fw_geometry_contour *held;
    double *corner_m; /* (nslot) radius of the rounded corners */
    bool *beside;     /* (nbody) the hub stands beside the hinges; NULL: nowhere */
    /* (njoint) to where a base of its own leaves its hinge; NULL: away from the mean of the hinges */
    const fw_layout_window_side *base_side;
    bool *stuck;              /* (njoint) a base of its own that cannot be drawn */
    fw_layout_shapes *shapes; /* (nbody); NULL: no body has any */
    fw_geometry_region *caps; /* (nbody) what closes the cuts to holes of bodies again */
    int nslot;
    fw_geometry_contour *lug; /* (nlug) of the platforms, for the tethers to avoid */
    int nlug;
    fw_geometry_contour *bare;     /* (nbody) as raw, before actuators; NULL: there are none */
    fw_layout_eyelet_plan *eyelet; /* (neyelet) */
    int neyelet;
    fw_layout_comb_plan *comb; /* (ncomb) */
    int ncomb;
    fw_layout_track *track; /* (ntrack) */
    int ntrack;
    bool said;           /* a drawing of this device was commented before */
    const fw_diags *own; /* diags of the drawing itself: of tries no faults are kept */
    int fault_capacity;
    fw_layout_attachment *attachment; /* (nattachment) what meets the frame */
    int nattachment;
    int base;      /* while a base is drawn: one of its ground hinges; else FW_NONE */
    int too_wide;  /* the body whose bar was refused last (FW-D137); FW_NONE */
    double fits_m; /* what it could be wide with the necks that it had then */
} fw_layout_drawing;

/* index into raw, plain and held; the joint tells bases apart */
bool fw_layout_own_bases(const fw_layout_drawing *d); /* one for each ground hinge */
int fw_layout_drawing_slot(const fw_layout_drawing *d, int body, int joint);
const fw_layout_side *fw_layout_side_of(const fw_layout_drawing *d, int joint, int body);
/* held, else plain */
const fw_geometry_contour *fw_layout_drawing_outline(const fw_layout_drawing *d, int slot);
const char *fw_layout_body_label(fw_layout_drawing *d, int body); /* NULL: out of memory */
fw_place fw_layout_body_place(const fw_layout_drawing *d, int body);
fw_geometry_vec2 fw_layout_joint_point(const fw_device *device, int joint);
/* joints between a body and the ground, 1 for the ground itself */
int fw_layout_steps_to_ground(const fw_device *device, int body);
int fw_layout_body_joints(const fw_device *device, int body, int *joint, int most);
fw_status fw_layout_drawing_add(fw_layout_drawing *d, fw_layout_role role, int body, int joint,
                                const char *label, const fw_geometry_contour *contour);
/* "1234.5" in um */
const char *fw_layout_um(char buffer[32], double metres);

/* a point `depth` inside the window, at `along` on a side; sides run along +x or +y */
fw_geometry_vec2 fw_layout_window_point(const fw_layout *layout, fw_layout_window_side side,
                                        double along, double depth);
fw_geometry_vec2 fw_layout_window_outward(fw_layout_window_side side);
/* strip from `start` (inside the body) to the stub of the frame, cut off by a JOINT segment */
fw_status fw_layout_strip_draw(fw_layout_drawing *d, fw_layout_window_side side, double low_start,
                               double high_start, double along, double half_m, double stub_m,
                               fw_layout_attachment *out);
fw_status fw_layout_attachment_add(fw_layout_drawing *d, const fw_layout_attachment *item);

/* side (njoint): to where a base of its own leaves each hinge; d: its hinges are planned, and stand as they would without
   that; false: none of them leaves by its leaf, as where no leaf on the ground has a stated axis */
bool fw_layout_sides_by_leaf(const fw_layout_drawing *d, fw_layout_window_side *side);
bool fw_layout_has_stated_leaf(const fw_device *device);
/* of a body with more than two hinges */
fw_geometry_vec2 fw_layout_body_hub(const fw_layout_drawing *d, int body);
fw_status fw_layout_hinges_plan(fw_layout_drawing *d);
fw_status fw_layout_flexure_draw(fw_arena *arena, const fw_device_flexure *flexure,
                                 fw_layout_hinge_plan *plan);
/* a head that comes nearer than own_space_m to its own flexure beyond the root; and of a path,
   whose roots may point anywhere, one that crosses itself. Of an arc or a leaf, as wide everywhere
   or not, block and ring may overlap: they become one when the body is united, with another head
   where that is unsound */
bool fw_layout_path_in_the_way(const fw_device_flexure *flexure, const fw_layout_hinge_plan *plan);
/* that the fillets of a hinge's flexure are below what every mask shows, as at this body */
fw_status fw_layout_say_fillet(fw_layout_drawing *d, int joint, const char *label,
                               fw_geometry_vec2 at, double least_m);
/* draws a head with other free dimensions */
fw_status fw_layout_head_draw(fw_layout_drawing *d, int joint, int body, int attempt);
/* where the root's face, extended outwards, meets the circle of radius q about W */
fw_geometry_vec2 fw_layout_ring_foot(const fw_layout_hinge_shape *shape, double q);
/* half width and end of the neck; then block, ring and neck in the body's own frame */
/* of a free leaf, before its neck is chosen */
void fw_layout_side_straighten(fw_layout_side *side, const fw_layout_hinge_shape *shape);
void fw_layout_neck_choose(fw_layout_side *side, double keep_out_m);
/* of the body on the side `own`, or of another (NULL) */
fw_status fw_layout_hinge_place(fw_arena *arena, const fw_layout_side *own, fw_geometry_vec2 centre,
                                double radius_m, fw_geometry_contour *place);
fw_status fw_layout_head_draw_shape(fw_arena *arena, const fw_layout_hinge_shape *shape,
                                    fw_layout_side *side);
/* joint: the only one of several bases, or FW_NONE */
fw_status fw_layout_body_draw(fw_layout_drawing *d, int body, int joint,
                              const fw_geometry_contour *extra, int nextra);
fw_status fw_layout_body_round(fw_layout_drawing *d, int body, const fw_geometry_contour *in,
                               fw_geometry_contour *out, double *radius_m, fw_geometry_vec2 *where);
/* how far an outline is from what a mask can show; >= 1 is good, else *where */
double fw_layout_body_soundness(const fw_geometry_contour *c, fw_geometry_vec2 *where);
/* Does it take a process that moves its edges by 1.5 um to either side? sound: of this outline; 0: not known */
fw_status fw_layout_takes_bias(fw_arena *arena, const fw_geometry_contour *contour, double sound,
                               bool *good);
/* What is wrong with the outline that a body and a comb's rotor would have together, as a reason; of a flaw of its own
   fingers with the width that has none. *why NULL: nothing that a mask could not show. */
fw_status fw_layout_rotor_flaw(fw_layout_drawing *d, int body, const fw_layout_comb_plan *p,
                               const fw_geometry_contour *raw, const char **why);
/* shift_m: of the places along their edges */
fw_status fw_layout_platform_lugs(fw_layout_drawing *d, int body, double shift_m,
                                  fw_geometry_contour *lug, int *nlug);

/* ---- what a description draws of a body: shape.c, opening.c, body.c ---- */
bool fw_layout_has_shapes(const fw_device *device, int body);
bool fw_layout_only_shapes(const fw_device *device, int body); /* neither width nor plate */
/* all bodies; refusals are diagnostics (FW-D316, FW-D318) and FW_GEOMETRY */
fw_status fw_layout_shapes_unite(fw_layout_drawing *d);
/* cuts the holes of the description out of what is drawn of a body */
fw_status fw_layout_shapes_pierce(fw_layout_drawing *d, int body, fw_geometry_region *all);
/* notes of what the round places of hinges take off it, heads and necks apart (FW-D537), and a warning where
   it is more than a twentieth; its raw outline is drawn */
fw_status fw_layout_shapes_say_cut(fw_layout_drawing *drawing, int body);
/* warnings of necks that close what the description leaves open (FW-D702); its heads are drawn */
fw_status fw_layout_shapes_say_closed(fw_layout_drawing *d, int body);
/* unit vector from W and where from W the neck, `half_m` wide to either side, may begin to end in
   what is drawn, at least clear_m; *found false: nowhere within reach. across: one that closes what
   the description leaves open is better than none. */
typedef struct fw_layout_neck_way {
    fw_geometry_vec2 w;
    double clear_m, half_m;
    bool across;
    double half_there_m; /* half the width of what is drawn at clear_m, as far as it matters */
} fw_layout_neck_way;
fw_status fw_layout_shape_direction(const fw_layout_drawing *d, int body, fw_layout_neck_way *way,
                                    fw_geometry_vec2 *direction, double *begins_m, bool *found);
/* of the way along a direction into the body's own plate, which begins at begins_m: no other shape
   is nearer to the hinge, but for those that the neck enters first; and it closes nothing */
fw_status fw_layout_plate_way(const fw_layout_drawing *d, int body, const fw_layout_neck_way *way,
                              fw_geometry_vec2 direction, double begins_m, bool *nearest,
                              bool *open);
/* outline of the body's own plate, in the world */
fw_status fw_layout_plate_outline(fw_layout_drawing *d, int body, fw_geometry_contour *plate);
/* error `number`: "BODY: WHAT, near (x, y) um" */
fw_status fw_layout_shape_refuse(fw_layout_drawing *d, int number, fw_place place, int body,
                                 const char *what, fw_geometry_vec2 at);
/* one outer outline, then holes, to one outline with cuts, and the caps that close them */
fw_status fw_layout_holes_open(fw_layout_drawing *d, int body, const fw_geometry_region *all,
                               fw_geometry_contour *outline, fw_geometry_region *caps);
/* area, edges and moments of outline, caps, and `extra` caps (nextra) of eyelets */
fw_status fw_layout_body_measure(fw_layout_drawing *d, int body, const fw_geometry_contour *extra,
                                 int nextra);

/* collects the eyelets and drives of all scenes, each place once */
fw_status fw_layout_actuators_plan(fw_layout_drawing *d);
bool fw_layout_eyelets_on(const fw_layout_drawing *d, int body);
/* bodies with what of their actuators can be drawn, and the stators; after all bodies */
fw_status fw_layout_actuators_draw(fw_layout_drawing *d);
bool fw_layout_stators_drawn(const fw_layout_drawing *d);
/* nearer than `space_m` to a stator? */
bool fw_layout_near_stator(const fw_layout_drawing *d, const fw_geometry_contour *c,
                           double space_m);
/* all stators are given up, because of `why`; the bodies are to be drawn again */
fw_status fw_layout_stators_drop(fw_layout_drawing *d, const char *why);
/* rings on the base; for the tethers to avoid: all rings and stators */
fw_status fw_layout_actuators_on_base(fw_layout_drawing *d);
fw_status fw_layout_actuators_on_frame(fw_layout_drawing *d, fw_geometry_contour *raw);
fw_status fw_layout_actuators_add(fw_layout_drawing *d); /* pieces */
/* lettering and marks where rings went give way */
fw_status fw_layout_actuators_letters(fw_layout_drawing *d);

/* tracks from the pads to the chip's edge, where the die asks for them; behind the tethers (layout_track.c) */
fw_status fw_layout_tracks_route(fw_layout_drawing *d);
fw_status fw_layout_tracks_cut(fw_layout_drawing *d, const fw_geometry_contour *half,
                               fw_geometry_region *parts);
/* radius of the tips of fingers */
double fw_layout_comb_tip(double width_m);
/* the least width of fingers whose sides and tips every mask shows */
double fw_layout_comb_width_shown(void);
/* rotor's and stator's electrodes alone: world outlines. docs/theory/layout.md, section 5 */
fw_status fw_layout_comb_rotor(fw_arena *arena, const fw_layout_comb_plan *plan,
                               fw_geometry_contour *rotor);
fw_status fw_layout_comb_stator(fw_arena *arena, const fw_layout_comb_plan *plan,
                                fw_geometry_contour *stator);
/* the stator with lead and pad where nothing is in the way; else *why (then not drawn) */
fw_status fw_layout_stator_place(fw_layout_drawing *d, fw_layout_comb_plan *plan, const char **why);
/* what a contour of `body` comes nearer to than `space_m`: of other bodies, hinges, drives before
   `before`, and eyelets; NULL: nothing. Names thing and place. */
fw_status fw_layout_actuator_crosses(fw_layout_drawing *d, const fw_geometry_contour *c, int body,
                                     double space_m, int before, const char **what);
/* adds ring and stem to an outline; *why set: it cannot */
fw_status fw_layout_eyelet_ring(fw_layout_drawing *d, const fw_layout_eyelet_plan *e, int body,
                                const fw_geometry_contour *raw, fw_geometry_contour *out,
                                const char **why);
/* opens the hole: `out` is cut from the hole to its edge, `cap` closes the cut again */
fw_status fw_layout_eyelet_hole(fw_layout_drawing *d, const fw_layout_eyelet_plan *e,
                                const fw_geometry_contour *raw, fw_geometry_contour *out,
                                fw_geometry_contour *cap, const char **why);
fw_status fw_layout_window_choose(fw_layout_drawing *d);
/* from the hinge of a base of its own straight to its cut at the frame */
double fw_layout_base_reach(const fw_layout_drawing *d, int joint);
fw_status fw_layout_ground_draw(fw_layout_drawing *d);
fw_status fw_layout_tethers_draw(fw_layout_drawing *d);
fw_status fw_layout_frame_draw(fw_layout_drawing *d);
fw_status fw_layout_clearance_check(fw_layout_drawing *d);
double fw_layout_free_rotation(fw_geometry_vec2 w, const fw_geometry_contour *p,
                               const fw_geometry_contour *q, double radius_m);

/* where a ray first meets an outline; segment -1: nowhere (eyelet.c) */
typedef struct fw_layout_ray_hit {
    int segment;
    double far_m;
    fw_geometry_vec2 at;
} fw_layout_ray_hit;
fw_layout_ray_hit fw_layout_first_hit(const fw_geometry_contour *c, fw_geometry_vec2 from,
                                      fw_geometry_vec2 u);

/* holes in bodies, where the die asks for them: outlines, caps and moments (release.c). Last of
   all, before the pieces are listed */
fw_status fw_layout_release_holes(fw_layout_drawing *d);

/* ---- layout_fault.c: what is wrong with a drawing, and what can be shown of it all the same ---- */
/* keeps the last error of the drawing (of that number, where it is not 0) as a fault; its number and
   message are filled in. What a try says is no fault. */
fw_status fw_layout_fault_keep(fw_layout_drawing *d, fw_layout_fault fault);
/* the same where no part of the drawing has kept an error behind the first `before` of them */
fw_status fw_layout_fault_rest(fw_layout_drawing *d, int before, int body);
fw_layout_fault fw_layout_fault_at(fw_geometry_vec2 at);
void fw_layout_say_open_hinges(const fw_layout_drawing *d);
extern const fw_geometry_vec2 fw_layout_nowhere;
/* pieces of everything that has an outline; bodies without one by their shapes, plates and bars */
fw_status fw_layout_show(fw_layout_drawing *d);

/* ---- what finds no room, and that it is said ---- */
fw_status fw_layout_missing_add(fw_layout_drawing *d, fw_layout_missing item);
/* joints, springs and stops that no mask draws (FW-D130) */
fw_status fw_layout_joints_missing(fw_layout_drawing *d);
/* one place of the drawing, whichever scenes it is in */
bool fw_layout_same_eyelet(const fw_device_eyelet *p, const fw_device_eyelet *q);

/* ---- fingers of the frame that tethers are made of: where one may reach a body ---- */

/* nothing but its own body is nearer than the rules have it */
bool fw_layout_finger_is_clear(const fw_layout_drawing *d, const fw_geometry_contour *finger,
                               int body);
/* the finger may leave its own body only once: everything from a little outside on is free */
bool fw_layout_finger_leaves_once(const fw_layout_drawing *d, const fw_layout_attachment *a,
                                  fw_geometry_vec2 from);
/* Depth of the neck's cut. The stub's corners at a body's edge of slope m (against the side) are
   rounded by r; the farther one ends r sqrt(1 + m2) outside the edge at r from the stub. A little
   more stays straight, so that the cut is square. Exact for a straight edge. test_layout.c
   tethers_break_at_the_body */
double fw_layout_finger_cut(const fw_layout_drawing *d, const fw_layout_attachment *a, double at,
                            double deep);
void fw_layout_sides_by_distance(const fw_layout *l, fw_geometry_vec2 p,
                                 fw_layout_window_side order[4]);
/* where a line straight inwards from a side meets the body, if its edge is one there and beside; a
   stub near a corner that somebody drew would leave a slit. Segment -1: it is not */
fw_layout_ray_hit fw_layout_finger_edge(const fw_layout_drawing *d, int body,
                                        fw_layout_window_side side, double along);
/* What stands in the way of the finger that comes nearest to having room, and by how much it would have
   to stand aside, or an opening to be wider: clauses (tether_finger.c). fit: fingers in whose way there is nothing;
   then there are no clauses */
enum { FW_LAYOUT_FITS = 8 };
typedef struct fw_layout_fit {
    fw_layout_window_side side;
    double along;
} fw_layout_fit;
fw_status fw_layout_tether_room(fw_layout_drawing *d, int body, fw_layout_fit fit[FW_LAYOUT_FITS],
                                int *nfit, fw_geometry_vec2 *at, const char **why,
                                const char **room);

/* ---- release holes of one body while they are made ---- */

typedef struct fw_layout_release_grid {
    fw_layout_drawing *d;
    int body;
    const char *label;
    fw_geometry_contour outline; /* as it is now; */
    int segments;                /* there is room for so many in it, 0: it is another's */
    fw_geometry_contour before;  /* without holes */
    fw_geometry_box box;         /* of that */
    fw_geometry_vec2 origin, x, y;
    double pitch_m, hole_m, rim_m; /* hole: diameter */
    fw_geometry_vec2 *hole;        /* (nhole) middles of those made */
    int nhole, room;
    fw_geometry_vec2 far; /* the farthest place for which no cut was found, */
    double far_m;         /* and how far from an opening it stays; 0: none */
} fw_layout_release_grid;

fw_status fw_layout_note_hole(fw_layout_release_grid *g, fw_geometry_vec2 middle);
/* room in the outline for `more` segments behind number i; what they are is still to be said. A hole costs
   the move of what lies behind it, and no copy of an outline that thousands of holes make long. */
fw_status fw_layout_release_open(fw_layout_release_grid *g, int i, int more);
/* holes where the grid has left any point too far from an opening: heads, necks, ends of bars (release_rest.c) */
fw_status fw_layout_release_rest(fw_layout_release_grid *g);

#endif
