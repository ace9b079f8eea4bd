/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The continuum rung of the hinge ladder: one flexure with its root fillets and root blocks as a
   structured mesh of quadratic bricks, solved by CalculiX, an independent program that need not be
   installed. Theory, limits and cost: docs/theory/continuum.md. */
#ifndef FW_CONTINUUM_CONTINUUM_H
#define FW_CONTINUUM_CONTINUUM_H
#include "base/text.h"
#include "flexure/flexure.h"
#include "mechanism/mechanism.h"

/* a piece of the centre line: straight (curvature 0) or an arc, > 0 turning left */
typedef struct fw_continuum_piece {
    double length_m, curvature_per_m;
} fw_continuum_piece;

typedef enum fw_continuum_root {
    FW_ROOT_BLOCK, /* tangent fillets into a block whose outer faces are rigid */
    FW_ROOT_RIGID  /* the strip ends in a rigid section: what beam theory assumes */
} fw_continuum_root;

enum { FW_CONTINUUM_PIECES = 16, FW_CONTINUUM_ANGLES = 16 };

/* Tangential pieces from the first root to the second. Frame of flexure.h when it comes from a
   flexure: arc centre (leaf: middle) at the origin, bulge along +x, first root at polar angle -a.
 */
typedef struct fw_continuum_shape {
    fw_continuum_piece piece[FW_CONTINUUM_PIECES];
    int npiece;
    double x_m, y_m, direction_rad; /* of the centre line at the first root */
    double width_m, fillet_m, depth_m;
    fw_continuum_root root;
    double block_half_m;   /* half width of the block across the centre line */
    double block_length_m; /* root to the rigid far face, along the continued centre line */
    bool sides_free;       /* true: only the far face of the block is rigid, not its sides */
    double centre_x_m, centre_y_m; /* point that twist and wrench refer to */
} fw_continuum_shape;

typedef struct fw_continuum_material {
    bool cubic;
    double youngs_Pa, poisson;     /* isotropic */
    double c11_Pa, c12_Pa, c44_Pa; /* cubic, [001] across the wafer */
    double crystal_rad;            /* of [100] in the frame of the shape */
} fw_continuum_material;

typedef struct fw_continuum_options {
    double refinement; /* element counts go with it; 1: about 900 bricks. [0.5, 4]; 0: 1 */
    bool plane_stress; /* one thin layer instead of the real depth */
    bool one_mesh;     /* no second mesh, no estimate of the error */
    bool large;        /* finite rotations `angle_rad` under a pure moment, too */
    double angle_rad[FW_CONTINUUM_ANGLES]; /* in the order in which they are reached */
    int nangle;
    double timeout_s; /* of one run of the solver; 0: 600 */
} fw_continuum_options;

typedef struct fw_continuum_mesh_size {
    int elements, nodes;
} fw_continuum_mesh_size;

/* at one finite rotation under a pure moment; the shift is that of the shape's centre as a point
   of the second root's body, in the frame of the first */
typedef struct fw_continuum_large {
    double angle_rad, moment_Nm, shift_x_m, shift_y_m, strain;
} fw_continuum_large;

typedef struct fw_continuum_result {
    bool installed; /* false: nothing else is set, and `missing` says what to do */
    const char *missing;
    double compliance[3][3];       /* (theta, ux, uy) at the shape's centre from (M, Fx, Fy) there:
                                      rad/(N m), rad/N = m/(N m), m/N */
    double stiffness_Nm_per_rad;   /* under a pure moment */
    double centre_x_m, centre_y_m; /* centre of compliance: a force through it does not turn */
    double kx_N_per_m, ky_N_per_m; /* force along one axis through that centre over the shift along
                                      the same axis, the other force 0 */
    double strain_per_rad;         /* peak principal, |.| */
    double stress_per_rad_Pa;      /* peak principal, |.| */
    double mises_per_rad_Pa;
    double peak_x_m, peak_y_m, peak_z_m; /* where the strain is highest */
    /* estimated errors from two meshes; NaN with one */
    double stiffness_error, strain_error; /* relative */
    double centre_error_m;
    fw_continuum_large large[FW_CONTINUUM_ANGLES];
    int nlarge;
    double cpu_s; /* of the solver, all runs */
    fw_continuum_mesh_size mesh;
} fw_continuum_result;

/* the flexure of the closed form, with blocks as the closed form's root law assumes them: 40 um or
   four widths to either side, 30 degrees of the arc (leaf: 52.4 um) or 5 widths long */
void fw_continuum_shape_of(const fw_flexure_input *in, fw_continuum_shape *shape);

/* FW_GEOMETRY (FW-D213): the shape cannot be meshed. A solver that is not installed is no error:
   result->installed is false and FW-D214 is noted. FW_SOLVER (FW-D215, FW-D216): it failed. */
fw_status fw_continuum_hinge(fw_arena *arena, const fw_continuum_shape *shape,
                             const fw_continuum_material *material,
                             const fw_continuum_options *options, fw_place place, fw_diags *diags,
                             fw_continuum_result *result);

/* the same mesh and steps as an input deck (um, uN, MPa), same inputs same bytes */
fw_status fw_continuum_hinge_deck(fw_arena *arena, const fw_continuum_shape *shape,
                                  const fw_continuum_material *material,
                                  const fw_continuum_options *options, fw_place place,
                                  fw_diags *diags, fw_text *deck);

/* *path: absolute, of an external program in PATH, or NULL: it is not there; for `doctor` too */
fw_status fw_continuum_program(fw_arena *arena, const char *name, const char **path);
extern const char *const fw_continuum_install; /* how to get the solver */

/* ---- device_deck.c: the last rung for a whole mechanism: every flexure a solid at finite rotation, every body rigid ---- */

typedef struct fw_continuum_solid_hinge {
    const char *id;
    fw_continuum_shape shape;
    fw_geometry_pose pose; /* of the shape's frame in the world */
    int first, second;     /* bodies at its roots; FW_GROUND */
} fw_continuum_solid_hinge;

typedef struct fw_continuum_solid_body {
    const char *id;
    double x_m, y_m; /* the point that is followed, drawn position */
    bool driven;     /* its rotation is prescribed: `rotation_rad`; else `moment_Nm` acts */
    double rotation_rad, moment_Nm;
} fw_continuum_solid_body;

/* at a point of a body, drawn position; keeps its direction */
typedef struct fw_continuum_solid_force {
    int body;
    double x_m, y_m, fx_N, fy_N;
} fw_continuum_solid_force;

typedef struct fw_continuum_solid_device {
    fw_continuum_solid_hinge *hinge; /* (nhinge) */
    fw_continuum_solid_body *body;   /* (nbody) */
    fw_continuum_solid_force *force; /* (nforce) */
    int nhinge, nbody, nforce;
    fw_continuum_material material; /* crystal_rad: of [100] in the world */
} fw_continuum_solid_device;

typedef struct fw_continuum_solid_options {
    double refinement; /* as of one hinge; 0: 0.5 */
    bool plane_stress;
    int increments;   /* equal parts of the load to begin with; 0: 20, what free bodies need; 4 do
                         where all rotations that matter are driven */
    double timeout_s; /* 0: 600 */
} fw_continuum_solid_options;

typedef struct fw_continuum_solid_pose { /* per body, against the drawn one */
    double x_m, y_m, rotation_rad;
    double moment_Nm; /* of a driven body: what holds it; else what acts */
} fw_continuum_solid_pose;

typedef struct fw_continuum_solid_result {
    bool installed;
    const char *missing;
    fw_continuum_solid_pose *body; /* (nbody) */
    double strain;                 /* peak principal, |.|, of all flexures */
    int strain_hinge;              /* where */
    double cpu_s;
    fw_continuum_mesh_size mesh;
} fw_continuum_solid_result;

/* What a hinge is made of, in its own frame, where [100] lies at minus the angle that its axis has from it. A
   crystal in which it has no direction is isotropic, as the closed form takes it. */
fw_continuum_material fw_continuum_material_of(const fw_mechanism *mechanism,
                                               const fw_mechanism_hinge *hinge);

/* From a mechanism whose joints all are flexures, with the scene's forces and torques at its end
   (scene NULL: none). Fillets as the mechanism's closed forms have them; blocks as for one hinge;
   a crystal in turned axes. FW_GEOMETRY (FW-D213): other joints, or loads that are not forces and
   torques. */
fw_status fw_continuum_solid_device_of(fw_arena *arena, const fw_mechanism *mechanism,
                                       const fw_device_scene *scene, fw_diags *diags,
                                       fw_continuum_solid_device *device);

/* input deck (um, uN, MPa): geometrically nonlinear equilibrium under the loads and rotations */
fw_status fw_continuum_solid_deck(fw_arena *arena, const fw_continuum_solid_device *device,
                                  const fw_continuum_solid_options *options, fw_diags *diags,
                                  fw_text *deck);

/* the same, solved; not installed is no error, as for one hinge */
fw_status fw_continuum_solid_solve(fw_arena *arena, const fw_continuum_solid_device *device,
                                   const fw_continuum_solid_options *options, fw_diags *diags,
                                   fw_continuum_solid_result *result);

#endif
