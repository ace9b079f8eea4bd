/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person reads: the report page, plots, drawings, animations and preview pictures. All text
   is escaped, all numbers are finite, and the same input gives the same bytes: no clock, no locale,
   no measured run time. JSON for programs is in report/report_json.h. */
#ifndef FW_REPORT_REPORT_H
#define FW_REPORT_REPORT_H
#include "base/text.h"
#include "device/device.h"
#include "dynamics/dynamics.h"
#include "flexure/drift.h"
#include "layout/layout.h"
#include "mask/mask.h"
#include "mechanism/mechanism.h"
#include "process/process.h"
#include "recipe/recipe.h"
#include "verdict/verdict.h"

typedef struct fw_report_flow { /* one process flow of the device */
    const fw_verdict_variant_verdict *variant;
    const fw_process_flow *flow; /* NULL: not computed */
    const fw_mask *mask;         /* NULL: not built, `mask_error` says why */
    const char *mask_error;      /* NULL: the design was rejected, or masks were not asked for */
    const fw_mask *violated;     /* its findings are listed; NULL: no rule is broken */
} fw_report_flow;

typedef struct fw_report_input {
    const fw_device *device;
    const fw_layout *layout; /* NULL or not drawn: a schematic of pins and bodies instead */
    const fw_verdict *verdict;
    const fw_report_flow *flow; /* (nflow) */
    int nflow;
    const char *version;
    const char **assumption; /* (nassumption) sentences */
    int nassumption;
    const fw_diags *diags;               /* NULL: none */
    const struct fw_report_hinge *hinge; /* (nhinge) the ladder, per flow */
    int nhinge;
} fw_report_input;

/* report.html: one file, needs nothing else, readable without script and on paper */
fw_status fw_report_write_html(fw_arena *arena, const fw_report_input *input, fw_text *out);

/* hinge angles against time with the limit lines; the title says when the verdict (NULL: none)
 * rejects
 */
fw_status fw_report_motion_svg(fw_arena *arena, const fw_device *device,
                               const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               const fw_device_scene *scene, const fw_verdict *verdict,
                               fw_text *out);
/* every sample with 17 digits: t_s,BODY.x_m,BODY.y_m,BODY.phi_rad,BODY.vx_m_per_s,... */
fw_status fw_report_motion_csv(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               fw_text *out);
/* accelerations, joint forces on body b in world axes, torques of joints about their point b,
   drives
 */
fw_status fw_report_forces_csv(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               fw_text *out);
/* the mechanism moving through one scene, as an SVG that plays by itself */
fw_status fw_report_animation_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                  const fw_device_scene *scene, fw_text *out);
/* the device as drawn, hinges coloured by utilisation. layout and verdict may be NULL. */
fw_status fw_report_device_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_verdict *verdict, fw_text *out);
/* the same as a PNG preview of width_px (16..8192, else FW_USAGE); never geometry of record.
   `out` holds bytes, not text. */
fw_status fw_report_device_png(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_verdict *verdict, int width_px, fw_text *out);

typedef enum fw_report_level_state {
    FW_LEVEL_SOLVED,
    FW_LEVEL_NONE,   /* the level has nothing for this hinge: `why` */
    FW_LEVEL_MISSING /* it needs a program that is not installed: `why` */
} fw_report_level_state;

typedef struct fw_report_level { /* a hinge by one model of the ladder */
    const char *name;
    fw_report_level_state state; /* other than solved: only `why` holds */
    const char *why;
    double at_m[2];                                      /* elastic centre less pin, hinge frame */
    double centre_m[2];                                  /* the same, world, drawn pose */
    double stiffness_Nm_per_rad, kx_N_per_m, ky_N_per_m; /* x along the hinge's axis */
    double strain_per_rad, limit_angle_rad;
    double moment_Nm, drift_m; /* at the limit angle; NaN: the level does not know */
    fw_flexure_error error;    /* the level's own estimate */
    double cpu_s;              /* of one evaluation, measured: never in the report */
} fw_report_level;

typedef struct fw_report_hinge { /* one panel */
    const char *id, *flow;       /* flow NULL: none */
    const fw_mechanism_hinge *hinge;
    const fw_flexure_drift_point *point; /* (npoint) over the range of its limit angle */
    int npoint;
    double gap_m;          /* 0: no conjugate surfaces */
    double contact_rad[2]; /* by a pure moment, on either side; NaN: none */
    double
        cover_rad[2]; /* world directions from W between which the surfaces are; NaN: not drawn */
    const fw_report_level *level; /* (nlevel) */
    int nlevel;
} fw_report_hinge;
/* every hinge as it is, and drift of its axis and gap of its surfaces against the angle */
fw_status fw_report_hinges_svg(const fw_device *device, const fw_report_hinge *hinge, int count,
                               fw_text *out);
#endif
