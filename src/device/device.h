/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The description, read and checked: what the device file says, in SI, with the place of every
   value in the file. Const for everyone downstream.

   <six-bar> is expanded here into bodies, joints and body shapes, so that the rooms above know only
   the general planar mechanism. */
#ifndef FW_DEVICE_DEVICE_H
#define FW_DEVICE_DEVICE_H
#include "base/diag.h"
#include "device/device_asked.h"
#include "device/material.h"
#include "drawing/drawing.h"
#include "geometry/contour.h"
#include "quantity/quantity_law.h"
#include "quantity/quantity.h"
#include <stdbool.h>

enum { FW_GROUND = -1, FW_NONE = -1 };

typedef struct fw_device_parameter {
    const char *name, *doc;
    double value, min, max; /* SI; min and max are -inf and +inf when absent */
    fw_quantity_dimension dimension;
    const char *unit; /* unit of the value as written, "" when none */
    bool overridden;  /* by --set */
    fw_place place;
} fw_device_parameter;

typedef struct fw_device_flow_use { /* <flow ref material thickness carrier/> */
    const char *ref;
    bool insulating_carrier; /* carrier="insulating": what is not joined in the layer is insulated;
                                default "none": the layer is one conducting sheet */
    const char *material;    /* id of the material in this flow; NULL: the device's own */
    double thickness_m;      /* NaN: the device's own */
    double orientation_rad;  /* NaN: the device's own */
    fw_place place, material_place;
} fw_device_flow_use;

typedef enum fw_device_flexure_kind {
    FW_FLEXURE_CSFH,
    FW_FLEXURE_LEAF,
    FW_FLEXURE_PATH
} fw_device_flexure_kind;

typedef struct fw_device_flexure { /* <flexure id kind radius|length angle width gap fillet .../> */
    const char *id;
    fw_device_flexure_kind kind;
    double length_m;       /* along the centre line, face to face */
    double angle_rad;      /* subtended angle 2a (csfh); turn of a path */
    double radius_m;       /* of the centre line (csfh) */
    double width_m;        /* in the plane, t; of a path the least one */
    double width_middle_m; /* csfh, leaf: in the middle, where it differs; 0: uniform */
    double gap_m;          /* of the conjugate surfaces; 0 = none */
    double fillet_m;       /* NaN: chosen by the layout */
    const fw_geometry_strip_piece *piece; /* (npiece) of a path, in the order of the file */
    int npiece;
    double flare_m; /* of a section as made: half of what one face of the layer is wider than the
                       other, width_m being their mean; 0 as drawn */
    bool length_given, radius_given; /* in the file: what advice should name */
    fw_place place, length_place, fillet_place;
} fw_device_flexure;

/* the pieces of any kind, one of a csfh or leaf; returns how many, at most FW_STRIP_MOST */
int fw_device_flexure_pieces(const fw_device_flexure *flexure, fw_geometry_strip_piece *piece);
/* is there more to it than one arc or line of one width? */
bool fw_device_flexure_varies(const fw_device_flexure *flexure);
double fw_device_flexure_narrowest_m(const fw_device_flexure *flexure);

/* <outline>, <plate>, <bar>, <disc> or <lettering> of a body; of several copies each is one */
typedef struct fw_device_shape {
    fw_geometry_contour contour; /* in the body's frame, counter-clockwise; count 0: lettering */
    bool hole;                   /* cut out of the body */
    const char *text;            /* of lettering, whose lower left corner is at `pose` */
    double height_m;
    fw_geometry_pose pose; /* in the body's frame */
    fw_place place;
} fw_device_shape;

typedef struct fw_device_body { /* <body>, or a link of <six-bar> */
    const char *id;
    double mass_kg, inertia_kg_m2; /* NaN: from the laid-out shape; about the centre of mass */
    double x_m, y_m, phi_rad;      /* pose of the reference frame, in which points of the body are
                                      stated; x, y NaN: at the centroid of the laid-out shape */
    double com_x_m, com_y_m; /* centre of mass in that frame; NaN: where the mass is stated the
                                      frame's origin, else the centroid of the laid-out shape */
    double vx_m_per_s, vy_m_per_s, omega_rad_per_s; /* initial velocities are in the scene */
    double width_m;                       /* of the bars that join its hinges; NaN: not drawn */
    double plate_width_m, plate_height_m; /* a rectangle about plate_x, plate_y; NaN: none */
    double plate_x_m, plate_y_m, plate_angle_rad;
    const fw_device_shape *shape; /* (nshape) what else is drawn of it, in the order of the file */
    int nshape;
    double inner_corner_m; /* of their union; 0: sharp */
    fw_place inner_corner_place;
    bool platform;
    fw_place place, width_place;
    bool shape_failed; /* a size of it was given and could not be read, which was said */
} fw_device_body;

typedef struct fw_device_revolute { /* <revolute>, or a hinge of <six-bar> */
    const char *id;
    int body_a, body_b;            /* index or FW_GROUND; angle = phi_b - phi_a - free_angle */
    double x_m, y_m;               /* hinge point in the world, in the drawn position */
    double ax_m, ay_m, bx_m, by_m; /* local coordinates as written; NaN: from x, y */
    double stiffness_Nm_per_rad;   /* NaN: from the flexure's geometry (0 without a flexure) */
    double damping_Nms_per_rad;    /* NaN: from the flexure's material (0 without a flexure) */
    double free_angle_rad;
    int flexure;     /* index or FW_NONE */
    double axis_rad; /* direction of the flexure's bulge; NaN: chosen by the layout */
    /* stops: beyond these joint angles a spring and damper push back; NaN: none */
    double stop_min_rad, stop_max_rad, stop_stiffness_Nm_per_rad, stop_damping_Nms_per_rad;
    fw_place place;
} fw_device_revolute;

typedef enum fw_device_joint_kind {
    FW_JOINT_PRISMATIC,
    FW_JOINT_DISTANCE,
    FW_JOINT_WELD
} fw_device_joint_kind;

/* <prismatic>, <distance>, <weld>: joints that are not pins. Points a and b are local, as in
   fw_device_spring. prismatic: point b slides along the line through point a with direction `axis`
   in the frame of a, phi_b - phi_a stays `angle`; travel = distance along the axis - free length,
   with a spring and a damper. distance: the points stay `length` apart. weld: the points coincide,
   phi_b - phi_a stays `angle`. */
typedef struct fw_device_joint {
    const char *id;
    fw_device_joint_kind kind;
    int body_a, body_b;
    double ax_m, ay_m, bx_m, by_m;
    double axis_rad;                                           /* prismatic */
    double angle_rad;                                          /* prismatic, weld; NaN: as drawn */
    double length_m;                                           /* distance; NaN: as drawn */
    double stiffness_N_per_m, damping_Ns_per_m, free_length_m; /* prismatic */
    fw_place place;
} fw_device_joint;

/* <driver joint value>: the joint's own coordinate follows a law: the angle of a revolute (phi_b -
   phi_a - free angle), the travel of a prismatic, the length of a distance */
typedef struct fw_device_driver {
    const char *id;
    int revolute, joint; /* index; the other one is FW_NONE */
    fw_quantity_law law; /* rad or m */
    fw_place place, value_place;
} fw_device_driver;

typedef struct fw_device_spring { /* <spring>: point to point */
    const char *id;
    int body_a, body_b;
    double ax_m, ay_m, bx_m, by_m; /* local; for ground: world */
    double stiffness_N_per_m, damping_Ns_per_m, length_m;
    double expansion_per_K; /* thermal, of its length at rest */
    bool cable;             /* only pulls: no force while shorter than its length */
    fw_place place;
} fw_device_spring;

typedef struct
    fw_device_force { /* <force on x y fx fy/>: point local to the body, force in world axes */
    int body;
    double x_m, y_m, fx_N, fy_N;
    const fw_quantity_law *law; /* factor; NULL: constant from the start */
    fw_place place;
} fw_device_force;

typedef struct fw_device_torque { /* <torque on value/> */
    int body;
    double value_Nm;
    const fw_quantity_law *law; /* factor; NULL: constant from the start */
    fw_place place;
} fw_device_torque;

typedef struct fw_device_initial { /* <initial body vx vy omega/> */
    int body;
    double vx_m_per_s, vy_m_per_s, omega_rad_per_s;
    bool moves_free, turns_free; /* neither vx nor vy, no omega given: as the joints ask */
    fw_place place;
} fw_device_initial;

typedef struct fw_device_eyelet { /* point of a tendon: local to the body; of the ground: world */
    int body;
    double x_m, y_m;
    double hole_m, ring_m; /* as drawn: diameter of the hole, width of the ring; 0: the defaults */
    fw_place place;
} fw_device_eyelet;

/* <tendon><eyelet/>...</tendon>: a cable without mass or friction from the first eyelet, where it
   is fixed, through the others to a remote actuator behind the last. Pulled: its tension is pull
   times the law. Drawn: it is elastic and only pulls; of its path, draw times the law is taken in:
     T = max(0, stiffness (path + draw law - (path as drawn + slack)) + damping path') */
typedef struct fw_device_tendon {
    const char *id;
    fw_device_eyelet *eyelet; /* (neyelet) at least 2 */
    int neyelet;
    double pull_N;                                       /* NaN: drawn */
    double draw_m;                                       /* NaN: pulled */
    double stiffness_N_per_m, damping_Ns_per_m, slack_m; /* drawn; slack below 0: pretension */
    double expansion_per_K;                              /* drawn: thermal, of the cable */
    const fw_quantity_law *law;
    fw_place place;
} fw_device_tendon;

typedef enum fw_device_electrodes { FW_ELECTRODES_COMB, FW_ELECTRODES_PLATE } fw_device_electrodes;

/* <comb-drive on against x y direction ...>: electrodes of a rotor (body_b) and a stator (body_a,
   usually the ground), voltage times the law between them. comb: `fingers` of the rotor between
   those of the stator, `gap` on either side, engaged by `overlap`; `direction` is where the rotor
   is pulled to. plate: one face of `length` along the wafer opposite another at `gap`; `direction`
   is from rotor to stator. Point: the middle of the overlap, or of the rotor's face. */
typedef struct fw_device_comb {
    const char *id;
    fw_device_electrodes kind;
    int body_a, body_b;
    double bx_m, by_m;    /* local to the rotor */
    double direction_rad; /* in the frame of the stator */
    int fingers;
    double gap_m, overlap_m,
        length_m;   /* length: of the fingers (NaN: twice the overlap), or plate */
    double depth_m; /* NaN: the device layer's thickness */
    double width_m; /* of the fingers, or of a plate across its face, as drawn; 0: the default */
    double lean_m;  /* as made: the gap is so much narrower at one face, wider at the other */
    double voltage_V;
    const fw_quantity_law *law;
    bool pad_at_edge; /* a track leads from the stator's pad to the edge of the chip */
    fw_place place;
} fw_device_comb;

/* what is drawn where the file says nothing */
#define FW_EYELET_HOLE_M  80e-6
#define FW_EYELET_RING_M  30e-6
#define FW_FINGER_WIDTH_M 8e-6
#define FW_PLATE_BAR_M    40e-6 /* a plate and the bar behind fingers, across their face */
#define FW_FINGER_TIP_M   3e-6  /* rounding of finger tips, within their length */
#define FW_TIP_SHARE      0.4   /* of the width of fingers that are too narrow for that */

static inline double fw_device_comb_width_m(const fw_device_comb *c) {
    if (c->width_m > 0) return c->width_m;
    return c->kind == FW_ELECTRODES_PLATE ? FW_PLATE_BAR_M : FW_FINGER_WIDTH_M;
}
/* the same electrodes, of one scene or of two: build_scenes.c */
bool fw_device_same_comb(const fw_device_comb *p, const fw_device_comb *q);
static inline double fw_device_comb_tip_m(double width_m) {
    return width_m * FW_TIP_SHARE < FW_FINGER_TIP_M ? width_m * FW_TIP_SHARE : FW_FINGER_TIP_M;
}

typedef struct
    fw_device_base_motion { /* <base-motion ax ay az>: acceleration of the base times the law */
    double ax_m_per_s2, ay_m_per_s2, az_m_per_s2;
    const fw_quantity_law *law;
    fw_place place;
} fw_device_base_motion;

typedef struct fw_device_friction_use { /* <friction on coefficient>: Coulomb friction of a joint */
    int revolute, joint;                /* one of them, the other FW_NONE */
    double coefficient, static_coefficient; /* static: NaN: the same */
    double radius_m;  /* of what slides; NaN: of the hinge's conjugate surfaces. Revolutes only */
    double preload_N; /* presses besides the joint's own force */
    fw_place place;
} fw_device_friction_use;

typedef enum fw_device_contact_side {
    FW_CONTACT_INSIDE,
    FW_CONTACT_OUTSIDE
} fw_device_contact_side;

/* what the masks do not draw of a contact is put there, at its place as stated, or etched of the same layer by
   masks that somebody else adds, so that its edge moves as all edges do. Not said: both are judged. */
typedef enum fw_device_undrawn {
    FW_UNDRAWN_NOT_SAID,
    FW_UNDRAWN_PLACED,
    FW_UNDRAWN_ETCHED
} fw_device_undrawn;

/* <contact on>: the conjugate surfaces of a hinge touch where its gap closes. <contact a b ...>:
   two round things about point a and point b: a disc inside a hole (their centres stay within
   `distance`), or side by side (not nearer than `distance`). */
typedef struct fw_device_contact_use {
    const char *id;
    int joint; /* FW_NONE: points */
    fw_device_contact_side side;
    int body_a, body_b;
    double ax_m, ay_m, bx_m, by_m;
    bool face;                /* a is a flat face through its point, without end: */
    double face_rad;          /* its normal, away from a's material, in a's frame */
    double distance_m;        /* NaN, of a hinge: its gap */
    double stiffness_N_per_m; /* NaN, of a hinge: of the line contact of its surfaces */
    double damping_Ns_per_m;
    fw_device_undrawn undrawn;
    double expansion_per_K; /* thermal, of what is placed; 0: it keeps its size */
    fw_place place;
} fw_device_contact_use;

typedef struct fw_device_material_damping { /* <material-damping loss-factor frequency> */
    double loss_factor;                     /* NaN: the material's */
    double frequency_Hz;                    /* where c = eta k/omega holds; NaN: the lowest mode */
    fw_place place;
} fw_device_material_damping;

typedef struct
    fw_device_temperature { /* <temperature change>: of device and substrate, from where it was
                                   made; times the law */
    double change_K;
    double expansion_per_K;           /* of length; NaN: the material's */
    double substrate_expansion_per_K; /* likewise; NaN: that of the flow's substrate */
    double modulus_change_per_K;      /* relative; NaN: the material's */
    const fw_quantity_law *law;
    fw_place place;
} fw_device_temperature;

typedef struct
    fw_device_residual_stress { /* <residual-stress mean gradient>: of the layer as deposited,
                                       tension positive; gradient along the thickness */
    double mean_Pa, gradient_Pa_per_m;
    fw_place place;
} fw_device_residual_stress;

typedef enum fw_device_air_kind { FW_AIR_SLIDE, FW_AIR_SQUEEZE, FW_AIR_DRAG } fw_device_air_kind;

/* <air kind on ...>: slide: film of `gap` between the face of a body and a plane below it; drag: of
   the open air around its outline; squeeze: film between a wall of the body (middle x, y; `length`;
   `direction` outward in its frame) and one of `against` at `gap`. */
typedef struct fw_device_air {
    fw_device_air_kind kind;
    int body;              /* FW_NONE (== FW_GROUND): all bodies (slide, drag) */
    int against;           /* squeeze */
    double gap_m, area_m2; /* area NaN: of the drawn shape */
    double x_m, y_m, direction_rad, length_m, depth_m; /* squeeze; depth NaN: the thickness */
    double pressure_Pa, temperature_K, viscosity_Pas;  /* NaN: dry air at that temperature */
    fw_place place;
} fw_device_air;

/* An element of a scene that no struct stands for: the numbers of its row in the description's
   table, in its order.
   For effects that need no more than a body, numbers and a law. */
typedef struct fw_device_scene_part {
    const char *element;     /* "magnetic-torque" */
    int body;                /* that its attribute `on` names; FW_GROUND */
    const char *const *name; /* (count) of its attributes */
    double *number; /* (count) SI; what is absent has its default, or NaN, as what is no number */
    int count;
    const fw_quantity_law *law; /* NULL: constant */
    fw_place place;
} fw_device_scene_part;
/* by the attribute's name; NaN: there is none */
double fw_device_scene_part_number(const fw_device_scene_part *part, const char *name);
/* multiplies it */
void fw_device_scene_part_scale(const fw_device_scene_part *part, const char *name, double by);

typedef struct fw_device_scene {
    const char *name;
    const char *flow; /* only in this flow; NULL: in all */
    double duration_s;
    bool gravity;
    double gx_m_per_s2, gy_m_per_s2, gz_m_per_s2; /* z: across the plane, away from the carrier */
    fw_device_force *force;                       /* (nforce) */
    fw_device_torque *torque;                     /* (ntorque) */
    fw_device_initial *initial;                   /* (ninitial) */
    fw_device_tendon *tendon;                     /* (ntendon) and so on */
    fw_device_comb *comb;
    fw_device_base_motion *base;
    fw_device_friction_use *friction;
    fw_device_contact_use *contact;
    fw_device_material_damping *damping;
    fw_device_temperature *temperature;
    fw_device_residual_stress *stress;
    fw_device_air *air;
    int nforce, ntorque, ninitial;
    fw_device_scene_part *part;
    int ntendon, ncomb, nbase, nfriction, ncontact, ndamping, ntemperature, nstress, nair, npart;
    /* the scene of which this one has a part of the loads: what its laws set ringing is damped by the material here, too
       (effects/hinge_source.c); NULL: its own laws tell */
    const struct fw_device_scene *set_off;
    fw_place place;
} fw_device_scene;
/* the scene gets arrays of its own, which may be changed, its tendons their eyelets; FW_NOMEM */
fw_status fw_device_own_scene(fw_arena *arena, fw_device_scene *scene);

typedef struct fw_device_workspace_box { /* <workspace>: platform poses relative to the drawn one */
    const char *flow;                    /* only in this flow; NULL: in all */
    double x_min_m, x_max_m, y_min_m, y_max_m, phi_min_rad, phi_max_rad;
    fw_place place;
} fw_device_workspace_box;

typedef struct fw_device_die { /* <die>; NaN: from the drawn mechanism */
    double width_m, height_m, frame_m, lane_m, clearance_m;
    double anchor_m, pad_m; /* of bases; of pads of stators: NaN or 0: chosen by the layout */
    const char *title;
    bool tethers;
    bool fill; /* what the flow has for the window: thief and fill */
    fw_place width_place, height_place, frame_place, title_place;
} fw_device_die;

enum { FW_CELL_ROLE_OPEN = -2, FW_CELL_ROLE_NONE = -1 };
typedef struct fw_device_cell_layer { /* all of a cell that goes to one layer */
    const char *to;                   /* as the file names it: "mask", "text", "7/0" */
    const fw_drawing_cell_layer *drawn;
    /* fw_layout_role of what that layer draws, once the flows' layer tables are known (fw_mask_cells_settle);
       FW_CELL_ROLE_NONE: a layer of its own, which is nothing of the device; FW_CELL_ROLE_OPEN: not yet */
    int role;
} fw_device_cell_layer;

typedef struct fw_device_cell {  /* <cell>: a drawing that is placed on the die, or on the wafer */
    const char *file, *name;     /* name: id, else the cell's, else the file's */
    bool biased;                 /* as the device is; else it goes onto the mask as it was drawn */
    fw_device_cell_layer *layer; /* (nlayer) */
    int nlayer;
    fw_place place, layers_place;
} fw_device_cell;

typedef enum fw_device_wafer_side {
    FW_SIDE_BOTTOM,
    FW_SIDE_TOP,
    FW_SIDE_LEFT,
    FW_SIDE_RIGHT
} fw_device_wafer_side;
typedef enum fw_device_wafer_centre {
    FW_CENTRE_AUTO,
    FW_CENTRE_DIE,
    FW_CENTRE_STREET
} fw_device_wafer_centre;

typedef struct fw_device_sweep { /* <sweep parameter from to steps> */
    int parameter;               /* index */
    double from, to;             /* SI */
    const char *unit;            /* one that its value can be written in; "" for pure numbers */
    int steps;
    fw_place place;
} fw_device_sweep;

typedef struct fw_device_order_asked { /* <order>; NaN, NULL: chosen by the wafer room */
    const char *plate; /* id of the one plate of a flow that it is of; NULL: of all others */
    bool quartz;       /* else soda-lime glass */
    bool inverted;     /* written is what the drawing leaves free */
    double scale;      /* of all that lies on a wafer, about the plate's middle */
    double size_m;     /* edge of the square; NaN: the wafer's */
    double thickness_m, cd_m, registration_m, defect_m;
    enum {
        FW_MIRROR_READ,
        FW_MIRROR_YES,
        FW_MIRROR_NO
    } mirror; /* of the written data; READ: as the
                                                    plate's reading says, seen with the chrome up */
    bool pellicle;
    int quantity;
    const char *barcode; /* text of a Code 39 beside the wafer; NULL: none */
    bool flat_line;      /* where the wafer's flat lies */
    fw_place place;
} fw_device_order_asked;

typedef struct fw_device_wafer_asked { /* <wafer>; NaN: chosen by the wafer room */
    bool asked;
    double diameter_m, flat_m, edge_m;
    double pitch_x_m, pitch_y_m;
    fw_device_wafer_side side; /* of flat or notch */
    fw_device_wafer_centre centre;
    bool alignment; /* two sites */
    int tests;      /* dies that give way to coupons */
    bool blocks;    /* steps side by side, not in turn */
    double plate_m;
    const char *title;        /* NULL: the die's */
    fw_device_sweep sweep[2]; /* (nsweep) along columns, along rows */
    int nsweep;
    fw_device_order_asked order;          /* of every plate that has none of its own */
    const fw_device_order_asked *ordered; /* (nordered) those of one plate */
    int nordered;
    bool written; /* there is an <order>: a plate is written without a wafer, too, of one die */
    const fw_device_cell *cell; /* (ncell) about the wafer's middle */
    int ncell;
    fw_place place;
} fw_device_wafer_asked;
/* what is ordered of a plate: its own <order>, or that of all */
const fw_device_order_asked *fw_device_order_of(const fw_device_wafer_asked *wafer,
                                                const char *plate);

typedef struct fw_device_limits_asked { /* <limits>, beside the safety factor */
    double cycles;                      /* repetitions of every scene; NaN: static */
    double failure_probability; /* of the whole device, of what fractures; likewise: not asked */
    bool survival;              /* the 0.2 % offset, not the proportional limit */
    double clearance_m; /* of everything that moves from what it may meet; NaN: they do not meet */
    fw_place cycles_place, probability_place, clearance_place;
} fw_device_limits_asked;

typedef struct fw_device {
    const char *file, *name;
    const char *source; /* the file's text, for carets */
    size_t source_length;
    fw_device_parameter *parameter;
    fw_device_flow_use *flow;
    fw_device_flexure *flexure;
    fw_device_body *body;
    fw_device_revolute *revolute;
    fw_device_joint *joint;
    fw_device_driver *driver;
    fw_device_spring *spring;
    fw_device_scene *scene;
    fw_device_workspace_box *workspace;
    int nparameter, nflow, nflexure, nbody, nrevolute, njoint, ndriver, nspring, nscene, nworkspace;
    fw_device_probe *probe;             /* (nprobe) those of the file, then implied ones */
    fw_device_requirement *requirement; /* (nrequirement) */
    int nprobe, nrequirement;
    fw_device_study *study; /* (nstudy) */
    int nstudy;
    const char *material_ref; /* NULL only where nothing needs one: no flexures, all masses given */
    fw_place material_place;
    /* overrides of <material>; unknown = take the pack's value */
    fw_device_material_override material;
    double thickness_m;     /* device layer, NaN: the flow's */
    double orientation_rad; /* of [100] of a crystal from +x; NaN: not stated, 45 deg */
    double safety_factor;   /* <limits safety-factor>, default 1.5 */
    fw_device_limits_asked limits;
    fw_place limits_place;
    bool six_bar; /* joints 0..5 are A..F, bodies 0..4 AB BC CD DE EF */
    fw_device_die die;
    double release_pitch_m, release_hole_m; /* <die>: holes in bodies; NaN or 0 pitch: none */
    fw_device_wafer_asked wafer;
    const fw_device_cell *cell; /* (ncell) on the die */
    int ncell;
    bool meets_midway; /* as made: contacts meet in the middle of the depth */
    bool rounded; /* the poses were typed with few digits, and closed as they were read: FW-D132 */
} fw_device;

typedef struct fw_device_set { /* --set PATH=VALUE */
    const char *path, *value;
} fw_device_set;

/* Reads the files that a description names (drawings), by their names as it states them: relative,
   without "..", not longer than 255 bytes. What cannot be read is reported at `asked`. */
typedef struct fw_device_files {
    fw_status (*read)(void *of, const char *name, fw_place asked, const char **data, size_t *n);
    void *of;
} fw_device_files;

/* reads and checks; all mistakes are in diags. FW_INPUT when there is an error: *device is then
   NULL, or what could be understood, good for looking up further references and for nothing else.
   `file` names the text in diagnostics. --set PATH is a parameter's name, or ELEMENT[ID]/@ATTRIBUTE
   (for example flexure[A]/@length). */
fw_status fw_device_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                         const fw_device_set *set, int nset, fw_diags *diags,
                         const fw_device **device);
/* the same; files NULL: a description that names files is refused (FW-D311) */
fw_status fw_device_read_with(fw_arena *arena, const char *file, const char *xml, size_t n,
                              const fw_device_set *set, int nset, const fw_device_files *files,
                              fw_diags *diags, const fw_device **device);

/* A study in a file of its own, checked like a device file; *study->device names the device. */
fw_status fw_device_study_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                               fw_diags *diags, const fw_device_study **study);

/* a scene or workspace that asks for a flow (NULL: any) holds in this one (NULL: none) */
bool fw_device_in_flow(const char *asked, const char *flow);
/* the scene has what carries the probe: the tendon, comb drive or contact of that id */
bool fw_device_probe_in_scene(const fw_device_probe *probe, const fw_device_scene *scene);
/* some mass, inertia or centre of mass is not stated: it comes from the drawn shape */
bool fw_device_needs_shapes(const fw_device *device);

/* A body's reference frame moves over it: its origin comes to the point `by` (m, in the frame's own
   axes) and to the world position `to`, and all points of the body are stated anew, so that nothing
   but numbers of the description changes. */
typedef struct fw_device_frame_move {
    fw_geometry_vec2 by, to;
} fw_device_frame_move;
/* move (nbody); bodies whose `by` is 0 keep their frame as it is. *moved is a copy that shares what
   does not change. Places in the world, angles and directions stay. Exact but for one rounding of
   each number. FW_NOMEM. Test: tests/cli/test_frames.py */
fw_status fw_device_move_frames(fw_arena *arena, const fw_device *device,
                                const fw_device_frame_move *move, const fw_device **moved);

/* generated from the one table of elements and attributes */
fw_status fw_device_reference_markdown(fw_text *out);
fw_status fw_device_relax_ng(fw_text *out);
fw_status fw_device_table_json(fw_text *out); /* a list of elements, part of flexwright.table/1 */

#endif
