/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mechanism as the equations of motion see it: bodies with mass, pins (revolute joints) with
   springs, dampers and stops, joints (prismatic, distance, weld), drivers, point-to-point springs.
   Built from the description, the laid-out shapes (mass) and the flexures (stiffness) for one
   variant: a material and a thickness.

   Explicit masses, stiffnesses and dampings of the file hold for the device's own material and
   thickness; another flow scales them with rho h, E h and sqrt(E h rho h) (same modal damping). */
#ifndef FW_MECHANISM_MECHANISM_H
#define FW_MECHANISM_MECHANISM_H
#include "device/device.h"
#include "flexure/flexure.h"
#include "flexure/path.h"
#include "geometry/segment.h"
#include "layout/layout.h"

typedef struct fw_mechanism_below { /* what is below a device that the flow has set free */
    bool known, open;               /* open: nothing, it is etched through */
    double m, low_m, high_m;        /* of the gap to it, else NaN */
    const char *words; /* "2 um of buried silicon dioxide taken away"; never NULL where known */
} fw_mechanism_below;

/* How a device that is free is dried, and how its surfaces hold each other: what the flow says */
typedef enum fw_mechanism_dried {
    FW_DRIED_UNKNOWN, /* no flow says so */
    FW_DRIED_NEVER,   /* nothing wets it once it is free */
    FW_DRIED_CALM,    /* without a meniscus */
    FW_DRIED_PULLED   /* a meniscus passes over it */
} fw_mechanism_dried;
typedef struct fw_mechanism_drying {
    fw_mechanism_dried how;
    const char
        *words; /* "from isopropyl alcohol in the oven, step C27"; never NULL where it is known */
    double tension_N_per_m, tension_low, tension_high; /* of what a meniscus is of */
    double cos_low, cos_high;                          /* of its contact angle */
    double water_N_per_m, alcohol_N_per_m;             /* to compare with; NaN: the pack has none */
    double adhesion_J_per_m2, adhesion_low,
        adhesion_high;          /* of surfaces that touch; NaN: not known */
    const char *adhesion_words; /* status and source; NULL: not known */
} fw_mechanism_drying;

typedef struct fw_mechanism_variant { /* what the device is made of, in one flow */
    const char *flow;                 /* flow id or NULL */
    fw_device_material material;
    const char *substrate; /* name of what the layer is anchored to; NULL: not known */
    /* of it, 1/K at 300 K; over a change dT the mean is that + slope dT + curvature dT^2, 1/K2 and 1/K3 (unknown: 0) */
    fw_quantity substrate_expansion, substrate_slope, substrate_curvature;
    /* a scene goes by the material's own expansion, by that of the substrate */
    bool heated_layer, heated_substrate;
    bool
        substrate_insulates; /* what faces the device is glass or the like, which screens no field */
    double thickness_m;
    double orientation_rad; /* of [100] of a crystal from +x */
    double explicit_mass_scale, explicit_stiffness_scale, explicit_damping_scale;
    fw_mechanism_below below;   /* {.known = false}: no flow says so */
    fw_mechanism_drying drying; /* zeroed: no flow says so */
} fw_mechanism_variant;

typedef struct fw_mechanism_mass { /* per body */
    const char *id;
    double mass_kg, inertia_kg_m2;
    double x_m, y_m, phi_rad; /* initial pose of the centre of mass */
    fw_geometry_vec2 frame; /* origin of the body's reference frame, seen from the centre of mass in
                                 the body's axes, which are those of the frame */
} fw_mechanism_mass;

typedef struct
    fw_mechanism_shape { /* per body, as drawn: area, its polar second moment about its centroid,
                             perimeter; NaN where it is not drawn */
    double area_m2, polar_m4, perimeter_m;
    fw_geometry_vec2 centroid;  /* from the centre of mass, in the body's axes; 0 where not drawn */
    fw_geometry_vec2 spread_m4; /* about its centroid, of (x^2 - y^2, 2 x y), axes of the world */
} fw_mechanism_shape;

typedef struct
    fw_mechanism_pin { /* per revolute joint; local points in the body frames (ground: world) */
    const char *id;
    int body_a, body_b;
    double ax_m, ay_m, bx_m, by_m;
    double stiffness_Nm_per_rad, damping_Nms_per_rad, free_angle_rad;
    int hinge; /* index into mechanism->hinge, or FW_NONE */
    /* From the pin to where the flexure begins in each body, in its frame: a body that becomes
       longer takes the pin along as it does that place, since the flexure itself does not; 0 where
       there is no flexure or its axis is not known */
    fw_geometry_vec2 root_a_m, root_b_m;
    /* stops at these joint angles; stiffness 0: none; NaN: not on this side */
    double stop_min_rad, stop_max_rad, stop_stiffness_Nm_per_rad, stop_damping_Nms_per_rad;
} fw_mechanism_pin;

typedef struct fw_mechanism_hinge { /* a pin that is a flexure */
    int pin, flexure;
    fw_flexure_input input; /* what the closed form was asked, for other levels */
    fw_flexure_result closed_form;
    /* what it bears; closed_form.limit_angle_rad is that of the governing one */
    fw_flexure_limits limits;
    /* strain along it and its law at finite rotation, both with the stated stiffness, if any: all
       of the flexure's forces are its own times `scale` */
    fw_flexure_path_strain section;
    fw_flexure_hinge_law law;
    double
        coupling; /* c_xy/sqrt(c_xx c_yy) that the law leaves out up to the limit's rotation; 0: none */
    double scale; /* stated stiffness over its own; 1: none is stated, or 0 */
    double
        stated_less; /* share by which a moment may strain it less than the stated stiffness says */
    /* the arc as drawn: direction, in the world, from the arc's centre to the middle of the arc
       (leaf: across it); `first` is the body at polar angle -a from there (element frame of
       flexure.h) */
    double axis_rad;
    bool first_is_a;
    /* The pin is at the true centre of compliance. Of a crystal that is not where the hinge is
       drawn: pin less drawn point (centre of both conjugate surfaces), in the frames of body a and
       b; else
       0 */
    fw_geometry_vec2 off_a_m, off_b_m;
    double surface_radius_m; /* of the convex conjugate surface; 0: none */
    /* directions, in body a's frame and the drawn pose, in which they can touch, counter-clockwise;
       NaN: not drawn. Where they begin the surface of the body at polar angle +a ends, where they
       end that of the other: so do the directions turn */
    double cover_from_rad, cover_to_rad;
    bool convex_is_a;    /* the convex surface belongs to body a */
    bool stated;         /* the file states the stiffness */
    bool damping_stated; /* and the damping: no loss factor is asked for */
} fw_mechanism_hinge;

/* what a body gives where something acts on it beside its hinges (body_give.c) */
typedef struct fw_mechanism_give {
    int body;
    double x_m, y_m; /* local to it */
    double c[9];     /* (3 x 3) by (M, Fx, Fy) of (turn, x, y), SI, axes of the body */
    double off;      /* relative error of it */
} fw_mechanism_give;

typedef struct fw_mechanism {
    /* the description with the frames of all bodies at their centres of mass: what it says of a point
       of a body, here and in its scenes, goes with poses of centres of mass */
    const fw_device *device;
    const fw_mechanism_variant *variant;
    fw_mechanism_mass *body;   /* (nbody) */
    fw_mechanism_shape *shape; /* (nbody) or NULL: nothing is drawn */
    fw_mechanism_pin *pin;     /* (npin) */
    /* (njoint) all values known (angle, length: as drawn where the file leaves them open; 0 where
       they mean nothing); local points refer to centres of mass */
    fw_device_joint *joint;
    fw_device_driver *driver;  /* (ndriver) joint is an index of pin, joint of joint */
    fw_device_spring *spring;  /* (nspring) local points refer to centres of mass */
    fw_mechanism_hinge *hinge; /* (nhinge) */
    int nbody, npin, njoint, ndriver, nspring, nhinge;
    const fw_layout *layout; /* what it was built from; NULL: nothing is drawn */
    /* (nbody) the bodies there, wherever assembly has moved `body` */
    const fw_mechanism_mass *drawn;
    fw_mechanism_give *give; /* (ngive) where contacts, springs and cables that are drawn act */
    int ngive;
} fw_mechanism;

/* at a place of a body; NULL: nothing, or nothing that is known */
const fw_mechanism_give *fw_mechanism_give_at(const fw_mechanism *mechanism, int body, double x_m,
                                              double y_m);

/* the same scene of the mechanism's own description, whose points go with centres of mass; a scene
   that is not of `device` stays what it is */
const fw_device_scene *fw_mechanism_scene(const fw_mechanism *mechanism, const fw_device *device,
                                          const fw_device_scene *scene);

/* pose (x, y, phi) of a body's reference frame, from that of its centre of mass */
void fw_mechanism_frame_pose(const fw_mechanism_mass *body, const double centre[3],
                             double frame[3]);
/* velocity (or a small displacement) of its origin and of the body, from that of the centre of mass
   at rotation phi: v' = v + omega x r */
void fw_mechanism_frame_velocity(const fw_mechanism_mass *body, double phi_rad,
                                 const double centre[3], double frame[3]);
/* acceleration of its origin and of the body, which turns at omega: a' = a + alpha x r - omega^2 r
 */
void fw_mechanism_frame_acceleration(const fw_mechanism_mass *body, double phi_rad,
                                     double omega_rad_per_s, const double centre[3],
                                     double frame[3]);

/* world position, in the drawn pose, that body a (side 0) or body b (side 1) gives to a pin */
fw_geometry_vec2 fw_mechanism_pin_place(const fw_mechanism *mechanism, const fw_mechanism_pin *pin,
                                        int side);

/* where hinge i/2 ends in the body, on side i % 2: its pin, and where its flexure begins there, both in the drawn pose. false: that
   side is of another body */
bool fw_mechanism_hinge_end(const fw_mechanism *mechanism, int body, int i, fw_geometry_vec2 *pin,
                            fw_geometry_vec2 *root);

/* in the pose q (3 nbody), from its image on body a to that on body b: what a flexure there is displaced by */
fw_geometry_vec2 fw_mechanism_pin_opened(const fw_mechanism_pin *pin, const double *q);

/* in the pose q, half of what both of its bodies have turned together from where they are described */
double fw_mechanism_pin_half_turned(const fw_mechanism *mechanism, const fw_mechanism_pin *pin,
                                    const double *q);

/* fw_mechanism_pin_place of any local point (ground: world) */
fw_geometry_vec2 fw_mechanism_local_place(const fw_mechanism *mechanism, int body, double x_m,
                                          double y_m);

/* the same with every local arm of body b longer by strain[b], points of the ground (strain[nbody])
   away from their mean; springs stay at rest where they were. Initial poses are not closed again.
 */
fw_status fw_mechanism_strained(fw_arena *arena, const fw_mechanism *mechanism,
                                const double *strain, const fw_mechanism **strained);

/* mean of the ground's points (of pins, joints and springs): what a strain of the ground is
   about */
fw_geometry_vec2 fw_mechanism_ground_centre(const fw_mechanism *mechanism);
/* a local point (ground: world) of a body that has become longer by strain[body], that of the
   ground (strain[nbody]) away from the centre */
void fw_mechanism_strain_point(const double *strain, int nbody, fw_geometry_vec2 centre, int body,
                               double *x_m, double *y_m);
/* the same of one that goes with another place of the body, `root` away from it */
void fw_mechanism_strain_pin(const double *strain, int nbody, fw_geometry_vec2 centre, int body,
                             fw_geometry_vec2 root, double *x_m, double *y_m);

/* what the closed form of a joint's flexure takes in this variant: the file's sizes, with the
   fillet that was drawn (layout may be NULL) */
fw_flexure_input fw_mechanism_flexure(const fw_device *device, const fw_layout *layout,
                                      const fw_mechanism_variant *variant, int joint);

fw_status fw_mechanism_build(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_mechanism_variant *variant, fw_diags *diags,
                             const fw_mechanism **mechanism);
/* The same for what follows from the hinges alone, of a layout that cannot be made (`shown` has
   faults): flexures and hinge points as far as they are drawn. Bodies whose mass would come from a
   drawing that is not there have one that stands in for it: not to be moved or judged.
   Test: tests/cli/test_marked.py */
fw_status fw_mechanism_build_hinges(fw_arena *arena, const fw_device *device,
                                    const fw_layout *shown, const fw_mechanism_variant *variant,
                                    fw_diags *diags, const fw_mechanism **mechanism);

/* ---- bodies as drawn, and what they give: body_solid.c, body_give.c ---- */

/* Where something acts on a body in one of the flow's scenes, or, scene FW_NONE, a stiffness is probed. known_N: how large it becomes, where the scene says so;
   NaN: it follows from the motion. what, id: "eyelet of tendon", "T1"; id NULL: it has none */
typedef struct fw_mechanism_load_end {
    int scene, body;
    int first;           /* the first of all that acts at this place: they have one way */
    double x_m, y_m;     /* local to the body */
    fw_geometry_vec2 at; /* world, as drawn */
    double known_N;
    double
        stiff_N_per_m; /* of what acts there by how the place goes; a cable's turns twice from either side; 0: nothing does */
    const char *what, *id;
    const fw_device_force *force; /* that acts there; NULL: something else does */
} fw_mechanism_load_end;
fw_status fw_mechanism_load_ends(fw_arena *arena, const fw_mechanism *mechanism,
                                 fw_mechanism_load_end **end, int *n);
typedef struct fw_mechanism_line { /* a chord of a body's outlines, world */
    fw_geometry_vec2 a, b;
    bool edge; /* of the material; else a joint between two pieces */
    int piece;
} fw_mechanism_line;
/* a piece of the layout that is the body's material */
bool fw_mechanism_is_of(const fw_layout_piece *piece, int body);
/* the chords of all of them: (n) */
fw_status fw_mechanism_body_lines(fw_arena *arena, const fw_layout *layout, int body,
                                  fw_mechanism_line **line, int *n);
/* full (ny nx): the share of each square cell that is material, none of the lines left out counted; outlines lie within the box */
enum { FW_MECHANISM_SUBROWS = 16 }; /* of a row of cells: heights at which outlines are crossed */
typedef struct fw_mechanism_cells {
    fw_geometry_box box;
    double cell_m;
    int nx, ny;
} fw_mechanism_cells;
fw_status fw_mechanism_fill_cells(fw_arena *arena, const fw_mechanism_line *line,
                                  const bool *left_out, int nline, const fw_mechanism_cells *cells,
                                  float *full);
/* ---- body_solid.c: what a body gives under all that acts on it together ---- */

/* of a hinge; of what else acts pin and root are one place. nearest: in place of its root it acts on what is full of
   material and nearest to the body's middle */
typedef struct fw_mechanism_solid_end {
    fw_geometry_vec2 pin, root;
    bool nearest;
    double reach_m; /* nodes nearer than that bear it; 0, or too few: those of the nearest cells */
} fw_mechanism_solid_end;
/* fine, coarse: (3n x 3n) C of two meshes, energy w^T C w/(2 E h) of wrenches w = (M, Fx, Fy) about the pins, world axes
   of the drawn pose; the body's inertia balances what they are not in balance by themselves */
typedef struct fw_mechanism_solid {
    bool known;
    int n,
        nhinge; /* ends; those of hinges stand first, then the middle, then those of loads, or none of them */
    double *fine, *coarse;
    const fw_mechanism_solid_end *end; /* (n) */
} fw_mechanism_solid;
typedef struct fw_mechanism_solid_mesh {
    fw_geometry_vec2 middle;
    double narrow_m; /* its narrowest place; 0: not known, cells are as small as can be */
    double edge_m;   /* by which edges stand out as made */
    double area_m2;  /* of its material, by which cells are counted; 0: of the box about it */
    int cells;       /* at most, fine; 0: as many as are wanted of its kind */
    bool close; /* what edges cut is neither softer nor stiffer than it is; else softer: a bound */
} fw_mechanism_solid_mesh;
fw_status fw_mechanism_solid_of(fw_arena *arena, const fw_mechanism_line *line, int nline,
                                const fw_mechanism_solid_mesh *as,
                                const fw_mechanism_solid_end *end, int n, fw_mechanism_solid *out);
/* w (3n), at most: what two meshes differ by, and what a crystal's directions may, is added */
double fw_mechanism_solid_energy_J(const fw_mechanism_solid *solid, double stiff_N,
                                   const double *w);
/* how far an end turns and goes against the body's middle: rad, m, m */
void fw_mechanism_solid_goes(const fw_mechanism_solid *solid, double stiff_N, const double *w,
                             int end, double to[3]);

/* ---- straight ways through a body ---- */

typedef struct fw_mechanism_edges { /* of one body, and those near to where one looks */
    int body;
    fw_geometry_lines all, near; /* near: those no farther than `reach` from `centre` */
    fw_geometry_vec2 centre;
    double reach;
    double *off; /* squares of distances from a place */
} fw_mechanism_edges;
fw_status fw_mechanism_edges_of(fw_arena *arena, const fw_layout *layout, int body,
                                fw_mechanism_edges *edges);
/* a piece of the way around `at`, `from` to `until`, as a strip: it bears no more than the body does there */
typedef struct fw_mechanism_walker {
    void (*add)(void *to, fw_geometry_vec2 at, fw_geometry_vec2 from, fw_geometry_vec2 until,
                double wide_m);
    void *to;
} fw_mechanism_walker;
/* from the root of a pin, or a place, straight to the body's middle, as far as circles inside the body touch; false: they do not */
bool fw_mechanism_walk(const fw_layout *layout, fw_mechanism_edges *edges, fw_geometry_vec2 pin,
                       fw_geometry_vec2 root, const fw_mechanism_walker *walker);

/* ---- what the parts of fw_mechanism_build share; private to mechanism/ ---- */

typedef struct fw_mechanism_builder {
    fw_arena *arena;
    const fw_device *device;
    const fw_layout *layout; /* may be NULL */
    const fw_mechanism_variant *variant;
    fw_diags *diags;
    fw_mechanism *mechanism;
} fw_mechanism_builder;

bool fw_mechanism_all_finite(const double *value, int count);
/* world position, in the drawn pose, of a local point; body NULL: the ground */
fw_geometry_vec2 fw_mechanism_body_point(const fw_mechanism_mass *body, fw_geometry_vec2 local);

/* link.c: bodies, joints and pins are built */
fw_status fw_mechanism_build_spring(const fw_mechanism_builder *b, int i);
fw_status fw_mechanism_build_joint(const fw_mechanism_builder *b, int i);
fw_status fw_mechanism_build_driver(const fw_mechanism_builder *b, int i);
fw_status fw_mechanism_tell_depths(const fw_mechanism_builder *b);
/* body_give.c: m->give; all else is built */
fw_status fw_mechanism_find_gives(fw_arena *arena, fw_mechanism *mechanism);
void fw_mechanism_tell_turned(const fw_mechanism_builder *b, const fw_device_revolute *from,
                              const fw_mechanism_pin *pin);

#endif
