/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The last rung for a whole mechanism: every flexure a solid at finite rotation, every body rigid.
   docs/theory/continuum.md. */
#ifndef FW_CONTINUUM_DEVICE_DECK_H
#define FW_CONTINUUM_DEVICE_DECK_H
#include "continuum/continuum.h"
#include "mechanism/mechanism.h"

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
