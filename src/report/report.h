/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person reads: the report page, plots, drawings, animations and preview pictures. All text
   is escaped, all numbers are finite, and the same input gives the same bytes: no clock, no locale,
   no measured run time. Below: documents for programs, and those of the single computations. */
#ifndef FW_REPORT_REPORT_H
#define FW_REPORT_REPORT_H
#include "assembly/assembly.h"
#include "base/json.h"
#include "base/text.h"
#include "device/device.h"
#include "dynamics/dynamics.h"
#include "flexure/finite.h"
#include "layout/layout.h"
#include "mask/mask.h"
#include "measuring/measuring.h"
#include "mechanism/mechanism.h"
#include "mechanism/mechanism_plates.h"
#include "probe/probe.h"
#include "process/process.h"
#include "recipe/recipe.h"
#include "statics/statics.h"
#include "verdict/verdict.h"
#include "workspace/reach.h"

typedef struct fw_report_flow { /* one process flow of the device */
    const fw_verdict_variant_verdict *variant;
    const fw_process_flow *flow;   /* NULL: not computed */
    const fw_mask *mask;           /* NULL: not built, `mask_error` says why */
    const char *mask_error;        /* NULL: the design was rejected, or masks were not asked for */
    const fw_mask *violated;       /* its findings are listed; NULL: no rule is broken */
    const fw_measuring *measuring; /* which measurement pays; NULL: not asked for */
    const fw_text *release;        /* picture of when every place is free; NULL: none */
    const fw_wiring *wiring;       /* NULL: nothing is drawn */
    const fw_statics_tethers *tethers; /* what breaks them; NULL: none */
    /* steps of a sweep whose dies are judged worse than the device, and how many dies that are; NULL: none are */
    const char *dies, *dies_count;
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
    const fw_verdict_from_outside *outside; /* (noutside) what it needs and the masks do not have */
    int noutside;
    const fw_diags *diags;               /* NULL: none */
    const struct fw_report_hinge *hinge; /* (nhinge) the ladder, per flow */
    int nhinge;
    fw_json_wanted wanted; /* of the verdict's JSON; member NULL: all */
} fw_report_input;

/* report.html: one file, needs nothing else, readable without script and on paper */
fw_status fw_report_write_html(fw_arena *arena, const fw_report_input *input, fw_text *out);

/* hinge angles against time with the limit lines; the title says when the verdict (NULL: none)
   rejects */
fw_status fw_report_motion_svg(fw_arena *arena, const fw_device *device,
                               const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               const fw_device_scene *scene, const fw_verdict *verdict,
                               fw_text *out);
/* every sample with 17 digits: t_s,BODY.x_m,BODY.y_m,BODY.phi_rad,BODY.vx_m_per_s,..., then the
   probes of the scene, PROBE.displacement_m */
fw_status fw_report_motion_csv(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               const fw_device_scene *scene, fw_text *out);
bool fw_report_probe_moves(const fw_probe *p); /* it has a course in this scene */
/* accelerations, joint forces on body b in world axes, torques of joints about their point b,
   drives */
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
    double cover_rad[2];   /* world directions from W between which the surfaces are; NaN: not
                              drawn */
    const fw_report_level *level; /* (nlevel) */
    int nlevel;
} fw_report_hinge;
/* every hinge as it is, and drift of its axis and gap of its surfaces against the angle */
fw_status fw_report_hinges_svg(const fw_device *device, const fw_report_hinge *hinge, int count,
                               fw_text *out);

/* ---- what a person reads in a terminal: the same bytes in every locale ---- */

typedef struct fw_report_terminal_style {
    int detail; /* -1: the answer only, 0: tables too, 1: every reason */
    bool colour;
} fw_report_terminal_style;

/* decision, governing hinge, hinges, advice, flows */
fw_status fw_report_verdict_text(const fw_report_input *input, fw_report_terminal_style style,
                                 fw_text *out);
/* values of probes at an equilibrium; nothing without probes */
fw_status fw_report_rest_probes_text(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                     const fw_statics *statics, fw_text *out);
/* what each flow makes of the device, at its corners */
void fw_report_fabricated_text(fw_text *out, const fw_verdict *verdict);
/* what to measure first where bands were asked for; ranked: and what every other input would leave */
void fw_report_measurements_text(fw_text *out, const fw_report_input *input, bool ranked);
/* peaks, statistics, effects of one scene; holds a measured CPU time */
fw_status fw_report_simulate_text(const fw_device_scene *scene, const fw_mechanism *mechanism,
                                  const fw_dynamics_motion *motion, fw_text *out);

/* ---- the unit in which a column of numbers reads best ---- */

typedef enum fw_report_measure {
    FW_MEASURE_LENGTH,
    FW_MEASURE_FORCE,
    FW_MEASURE_TIME
} fw_report_measure;

typedef struct fw_report_magnitude {
    const char *unit;
    double per_si; /* times the SI value */
} fw_report_magnitude;

/* the largest of um, mm, m, km (uN, mN, N, kN, MN; us, ms, s) in which `largest_si` is at least
   1 */
fw_report_magnitude fw_report_magnitude_of(fw_report_measure measure, double largest_si);

/* ---- JSON for programs: 17 digits, keys in a fixed order, null for what is not finite ---- */

/* schema flexwright.verdict/1 (verdict.json) */
fw_status fw_report_verdict_json(const fw_report_input *input, fw_text *out);
/* schema flexwright.simulate/1; where the device has probes, fw_probe_monitor has observed the
   motion */
fw_status fw_report_simulate_json(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                  fw_text *out);
/* schema flexwright.modes/1 */
fw_status fw_report_modes_json(const fw_mechanism *mechanism, const fw_device_scene *scene,
                               const fw_statics_modes *modes, fw_text *out);
/* schema flexwright.statics/1 */
fw_status fw_report_statics_json(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                 const fw_statics *statics, fw_text *out);

/* ---- equilibria and modes for people: text, tables, pictures ---- */

/* "point", "limit point", "bifurcation", "switch", "end" */
const char *fw_report_path_mark(fw_statics_path_mark mark);
/* the first limit point behind which an unstable path is stable again; FW_NONE */
int fw_report_path_second(const fw_statics_path *path);

/* for a terminal */
fw_status fw_report_modes_text(const fw_mechanism *mechanism, const fw_device_scene *scene,
                               const fw_statics_modes *modes, fw_text *out);
/* a probe of small motions and its error; frequencies are counted in the plane and across it as it says. plates: of
   the same mechanism */
void fw_report_probe_small(const fw_probe *probe, const fw_statics_modes *modes,
                           const fw_mechanism_plates *plates, double *value, double *error);
fw_status fw_report_statics_text(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                 const fw_statics *statics, fw_text *out);
/* load_factor,lowest_per_s2,negative,mark,BODY.x_m,...,HINGE.angle_rad,...,TIE.fx_N,...,DRIVER
   with 17 digits: a row per point of the path, or the equilibrium alone */
fw_status fw_report_load_path_csv(const fw_mechanism *mechanism, const fw_statics *statics,
                                  fw_text *out);

/* every mode that has frames, moving, in one picture */
fw_status fw_report_modes_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                              const fw_mechanism *mechanism, const fw_device_scene *scene,
                              const fw_statics_modes *modes, fw_text *out);
/* the equilibrium over the pose at rest, with the loads; with a path the way there, moving */
fw_status fw_report_statics_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                const fw_mechanism *mechanism, const fw_device_scene *scene,
                                const fw_statics *statics, fw_text *out);
/* load factor against the displacement of the platform, else of what turns or moves most. FW_USAGE
   without a path. */
fw_status fw_report_load_path_svg(fw_arena *arena, const fw_device *device,
                                  const fw_mechanism *mechanism, const fw_device_scene *scene,
                                  const fw_statics *statics, fw_text *out);

/* ---- the result of `assemble`: document, terminal text, picture of before and after ---- */

typedef struct fw_report_assembly {
    const fw_device *device;
    const fw_layout *layout;       /* NULL or not drawn: bodies as lines between their joints */
    const fw_mechanism *mechanism; /* stands in the guess */
    const fw_device_scene *scene;  /* its loads; NULL: none */
    const fw_assembly *assembly;
    const fw_assembly_kinematics *kinematics; /* NULL: not computed */
    bool motion;                              /* rates were given, or drivers move it */
    bool closed;
} fw_report_assembly;

/* schema flexwright.assemble/1 */
fw_status fw_report_assemble_json(const fw_report_assembly *input, fw_text *out);
fw_status fw_report_assemble_text(const fw_report_assembly *input, fw_text *out);
/* guess and assembled position side by side, open joints in red with their size */
fw_status fw_report_assemble_svg(fw_arena *arena, const fw_report_assembly *input, fw_text *out);

/* ---- the certified workspace: text, JSON, pictures, the certificate ---- */

typedef struct fw_report_workspace_flow { /* one flow: a material and a thickness */
    const char *flow;                     /* NULL: the device's own material */
    const fw_mechanism *mechanism;
    const fw_workspace_map *map;
    const fw_workspace_result *required;
    const fw_workspace_regularity *singular; /* (device->nworkspace) of the boxes that are proved */
} fw_report_workspace_flow;

typedef struct fw_report_workspace {
    const fw_device *device;
    const fw_report_workspace_flow *flow; /* (nflow) */
    int nflow;
} fw_report_workspace;

fw_status fw_report_workspace_text(const fw_report_workspace *in, fw_text *out);
/* schema flexwright.workspace/1 */
fw_status fw_report_workspace_json(const fw_report_workspace *in, fw_text *out);
/* schema flexwright.workspace-certificate/2: what tests/accept/check_certificate.py verifies */
fw_status fw_report_certificate_json(const fw_report_workspace *in, fw_text *out);
/* slices at constant rotation, their boundary coloured by the hinge that is at its limit */
fw_status fw_report_workspace_svg(fw_arena *arena, const fw_report_workspace *in, fw_text *out);
enum { FW_SLICES_WIDTH = 910 }; /* of the picture of one flow's slices and shares */

/* ---- the preview ----
   What an interactive page draws: the mechanism's shapes, to be put where its bodies are, and one motion of
   it. Compact JSON: numbers are rounded to what a picture needs, those of record are in the other
   documents. */

typedef struct fw_report_left_out { /* what a quick answer is without */
    const char *what, *sentence;
    bool could_reject;
} fw_report_left_out;

typedef struct fw_report_preview {
    const char *status;                 /* "ok", "invalid", "failed" */
    int exit_status;                    /* that of the program for the same question */
    bool provisional;                   /* the verdict may still become worse by what is left out */
    bool rates;                         /* of the motion velocities are asked for, too */
    const fw_report_left_out *left_out; /* (nleft_out) */
    int nleft_out;
    const fw_diags *diags;
    const char *file; /* whose name stands for the text in diagnostics */
    /* from here on NULL where it is not there */
    const fw_device *device;
    const fw_layout *layout;
    const fw_mechanism *mechanism; /* of the shapes */
    const fw_dynamics_motion *motion;
    const fw_device_scene *scene;
    const fw_verdict *verdict;
    const char *verdict_json;   /* flexwright.verdict/1 */
    const fw_report_flow *flow; /* (nflow) */
    int nflow;
    double read_s, judge_s, simulate_s; /* CPU time */
} fw_report_preview;

/* schema flexwright.preview/1 */
fw_status fw_report_preview_json(fw_arena *arena, const fw_report_preview *in, fw_text *out);
/* schema flexwright.picture/1: of the same what a picture of the motion shows */
fw_status fw_report_picture_json(fw_arena *arena, const fw_report_preview *in, fw_text *out);

/* parts of it that other documents have too, each with its key */
fw_status fw_report_preview_shapes(fw_arena *arena, const fw_report_preview *in, fw_json *out);
/* "diagnostics": each once */
void fw_report_preview_diagnostics(const fw_diags *diags, const char *file, fw_json *out);

/* A figure that this program wrote, as PDF (figure_pdf.c). svg: its text of n bytes. FW_INPUT: *unknown is what of it the
   writer does not know; NULL: it is no picture of a stated size, where *line is not 0 because that line is no XML */
fw_status fw_report_figure_pdf(fw_arena *arena, const char *svg, size_t n, fw_text *pdf,
                               const char **unknown, int *line);

#endif
