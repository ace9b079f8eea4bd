/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The description, read and checked: what the device file says, in SI, with the place of every
   value in the file. Const for everyone downstream.

   <six-bar> is expanded here into bodies, joints and body shapes, so that the rooms above know only
   the general planar mechanism. */
#ifndef FW_DEVICE_DEVICE_H
#define FW_DEVICE_DEVICE_H
#include "base/diag.h"
#include "device/material.h"
#include "quantity/law.h"
#include "quantity/quantity.h"
#include <stdbool.h>

enum { FW_GROUND = -1, FW_NONE = -1 };

typedef struct fw_parameter {
    const char *name, *doc;
    double value, min, max; /* SI; min and max are -inf and +inf when absent */
    fw_dimension dimension;
    const char *unit; /* unit of the value as written, "" when none */
    bool overridden;  /* by --set */
    fw_place place;
} fw_parameter;

typedef struct fw_flow_use { /* <flow ref material thickness/> */
    const char *ref;
    const char *material; /* id of the material in this flow; NULL: the device's own */
    double thickness_m;   /* NaN: the device's own */
    fw_place place, material_place;
} fw_flow_use;

typedef enum fw_flexure_kind { FW_FLEXURE_CSFH, FW_FLEXURE_LEAF } fw_flexure_kind;

typedef struct fw_flexure { /* <flexure id kind radius|length angle width gap fillet .../> */
    const char *id;
    fw_flexure_kind kind;
    double length_m;                 /* along the centre line, face to face */
    double angle_rad;                /* subtended angle 2a (csfh) */
    double radius_m;                 /* of the centre line (csfh) */
    double width_m;                  /* in the plane, t */
    double gap_m;                    /* of the conjugate surfaces; 0 = none */
    double fillet_m;                 /* NaN: chosen by the layout */
    bool length_given, radius_given; /* in the file: what advice should name */
    fw_place place, length_place;
} fw_flexure;

typedef struct fw_body { /* <body>, or a link of <six-bar> */
    const char *id;
    double mass_kg, inertia_kg_m2; /* NaN: from the laid-out shape */
    double x_m, y_m, phi_rad;      /* pose of the centre of mass; x, y NaN: from the shape */
    double vx_m_per_s, vy_m_per_s, omega_rad_per_s; /* initial velocities are in the scene */
    double width_m;                       /* of the bars that join its hinges; NaN: not drawn */
    double plate_width_m, plate_height_m; /* a rectangle about plate_x, plate_y; NaN: none */
    double plate_x_m, plate_y_m, plate_angle_rad;
    bool platform;
    fw_place place;
} fw_body;

typedef struct fw_joint { /* <revolute>, or a hinge of <six-bar> */
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
} fw_joint;

typedef enum fw_tie_kind { FW_TIE_PRISMATIC, FW_TIE_DISTANCE, FW_TIE_WELD } fw_tie_kind;

/* <prismatic>, <distance>, <weld>: joints that are not pins. Points a and b are local, as in
   fw_spring. prismatic: point b slides along the line through point a with direction `axis` in the
   frame of a, phi_b - phi_a stays `angle`; travel = distance along the axis - free length, with a
   spring and a damper. distance: the points stay `length` apart. weld: the points coincide, phi_b -
   phi_a stays `angle`. */
typedef struct fw_tie {
    const char *id;
    fw_tie_kind kind;
    int body_a, body_b;
    double ax_m, ay_m, bx_m, by_m;
    double axis_rad;                                           /* prismatic */
    double angle_rad;                                          /* prismatic, weld; NaN: as drawn */
    double length_m;                                           /* distance; NaN: as drawn */
    double stiffness_N_per_m, damping_Ns_per_m, free_length_m; /* prismatic */
    fw_place place;
} fw_tie;

/* <driver joint value>: the joint's own coordinate follows a law: the angle of a revolute (phi_b -
   phi_a - free angle), the travel of a prismatic, the length of a distance */
typedef struct fw_driver {
    const char *id;
    int joint, tie; /* index; the other one is FW_NONE */
    fw_law law;     /* rad or m */
    fw_place place, value_place;
} fw_driver;

typedef struct fw_spring { /* <spring>: point to point */
    const char *id;
    int body_a, body_b;
    double ax_m, ay_m, bx_m, by_m; /* local; for ground: world */
    double stiffness_N_per_m, damping_Ns_per_m, length_m;
    bool cable; /* only pulls: no force while shorter than its length */
    fw_place place;
} fw_spring;

typedef struct fw_force { /* <force on x y fx fy/>: point local to the body, force in world axes */
    int body;
    double x_m, y_m, fx_N, fy_N;
    const fw_law *law; /* factor; NULL: constant from the start */
    fw_place place;
} fw_force;

typedef struct fw_torque { /* <torque on value/> */
    int body;
    double value_Nm;
    const fw_law *law; /* factor; NULL: constant from the start */
    fw_place place;
} fw_torque;

typedef struct fw_initial { /* <initial body vx vy omega/> */
    int body;
    double vx_m_per_s, vy_m_per_s, omega_rad_per_s;
    bool moves_free, turns_free; /* neither vx nor vy, no omega given: as the joints ask */
    fw_place place;
} fw_initial;

typedef struct fw_scene {
    const char *name;
    const char *flow; /* only in this flow; NULL: in all */
    double duration_s;
    bool gravity;
    double gx_m_per_s2, gy_m_per_s2;
    fw_force *force;     /* (nforce) */
    fw_torque *torque;   /* (ntorque) */
    fw_initial *initial; /* (ninitial) */
    int nforce, ntorque, ninitial;
    fw_place place;
} fw_scene;

typedef struct fw_workspace_box { /* <workspace>: platform poses relative to the drawn one */
    const char *flow;             /* only in this flow; NULL: in all */
    double x_min_m, x_max_m, y_min_m, y_max_m, phi_min_rad, phi_max_rad;
    fw_place place;
} fw_workspace_box;

typedef struct fw_die { /* <die>; NaN: from the drawn mechanism */
    double width_m, height_m, frame_m, lane_m, clearance_m;
    const char *title;
    bool tethers;
} fw_die;

typedef struct fw_device {
    const char *file, *name;
    const char *source; /* the file's text, for carets */
    size_t source_length;
    fw_parameter *parameter;
    fw_flow_use *flow;
    fw_flexure *flexure;
    fw_body *body;
    fw_joint *joint;
    fw_tie *tie;
    fw_driver *driver;
    fw_spring *spring;
    fw_scene *scene;
    fw_workspace_box *workspace;
    int nparameter, nflow, nflexure, nbody, njoint, ntie, ndriver, nspring, nscene, nworkspace;
    const char *material_ref; /* NULL only where nothing needs one: no flexures, all masses given */
    fw_place material_place;
    /* overrides of <material>; unknown = take the pack's value */
    fw_material_override material;
    double thickness_m;   /* device layer, NaN: the flow's */
    double safety_factor; /* <limits safety-factor>, default 1.5 */
    fw_place limits_place;
    bool six_bar; /* joints 0..5 are A..F, bodies 0..4 AB BC CD DE EF */
    fw_die die;
} fw_device;

typedef struct fw_set { /* --set PATH=VALUE */
    const char *path, *value;
} fw_set;

/* reads and checks; all mistakes are in diags. FW_INPUT when there is an error: *device is then
   NULL, or what could be understood, good for looking up further references and for nothing else.
   `file` names the text in diagnostics. --set PATH is a parameter's name, or ELEMENT[ID]/@ATTRIBUTE
   (for example flexure[A]/@length). */
fw_status fw_device_read(fw_arena *arena, const char *file, const char *xml, size_t n,
                         const fw_set *set, int nset, fw_diags *diags, const fw_device **device);

/* a scene or workspace that asks for a flow (NULL: any) holds in this one (NULL: none) */
bool fw_device_in_flow(const char *asked, const char *flow);
/* some mass, inertia or centre of mass is not stated: it comes from the drawn shape */
bool fw_device_needs_shapes(const fw_device *device);

/* generated from the one table of elements and attributes */
fw_status fw_device_reference_markdown(fw_text *out);
fw_status fw_device_relax_ng(fw_text *out);

#endif
