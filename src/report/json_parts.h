/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of JSON documents that several of them have. Each writes one value with its key (NULL in a
   list). Private to the room. */
#ifndef FW_REPORT_JSON_PARTS_H
#define FW_REPORT_JSON_PARTS_H
#include "base/json.h"
#include "dynamics/dynamics.h"
#include "report/report.h"
#include "statics/statics.h"

/* [a, b] */
void fw_report_json_pair(fw_json *json, const char *key, double a, double b);
/* [a, b, ...] */
void fw_report_json_reals(fw_json *json, const char *key, const double *value, int count);
/* {"BODY": [x, y, phi]}: poses of reference frames, from those of centres of mass */
void fw_report_json_poses(fw_json *json, const char *key, const fw_mechanism *mechanism,
                          const double *q);
/* "com": {"BODY": [x, y]}: centres of mass */
void fw_report_json_centres(fw_json *json, const fw_mechanism *mechanism, const double *q);
/* {"BODY": [vx, vy, omega]}: velocities, or small displacements, of the frames' origins */
void fw_report_json_velocities(fw_json *json, const char *key, const fw_mechanism *mechanism,
                               const double *q, const double *v);
/* {"BODY": [ax, ay, alpha]} */
void fw_report_json_accelerations(fw_json *json, const char *key, const fw_mechanism *mechanism,
                                  const double *q, const double *v, const double *a);
/* one object per line of the ledger, into a list; scene and flow are added where they are given */
void fw_report_json_effects(fw_json *json, const fw_effect_ledger *ledger, const char *scene,
                            const char *flow);
/* Members of the object about one pull-in, which the caller opens and closes */
void fw_report_json_pull_in(fw_json *json, const fw_statics_pull_in *pull_in);
/* how hinges were taken, as members of an object that the caller opens and closes, where
   use->why is given; level may be NULL */
void fw_report_json_hinge_model(fw_json *json, const fw_mechanism *mechanism,
                                const fw_effects_hinge_use *use,
                                const fw_statics_level_step *level);

/* one probe of a motion, as an object in a list; scene NULL: the document is of one scene */
void fw_report_json_probe(fw_json *json, const fw_device_probe *probe, const char *scene,
                          const char *flow, const fw_probe_result *result);
/* keys of one requirement, as it was run */
void fw_report_json_requirement(fw_json *json, const fw_verdict_requirement *requirement);
/* "probes", where the device has any, and "requirements" of all flows */
void fw_report_json_requirements(fw_json *json, const fw_report_input *in);
/* the list "clearances" of every scene and required box */
void fw_report_json_clearances(fw_json *json, const fw_verdict *verdict);

/* "out_of_plane" of every flow */
void fw_report_json_out_of_plane(fw_json *json, const fw_verdict *verdict);
/* "stiction" of every flow that dries it */
fw_status fw_report_json_stiction(fw_arena *arena, fw_json *json, const fw_verdict *verdict);

/* ---- the preview: lengths are in um with y up, to 1 nm; keys as in base/json.h ---- */

void fw_report_preview_put_um(fw_text *out, double metres);
void fw_report_preview_um(fw_json *out, const char *key, double metres);
void fw_report_preview_point(fw_json *out, const char *key, double x_m, double y_m); /* [x, y] */
void fw_report_preview_bodies(fw_json *out, const char *key, int a, int b); /* -1: the ground */
/* outlines as strings, in the axes of the file; region NULL: none */
void fw_report_preview_outlines(fw_json *out, const char *key, const fw_geometry_region *region);
/* what else joins bodies and what drives them: "ties", "springs", "loads", and "not_drawn", the
   names of loads that effects find in the scene and no picture shows */
void fw_report_preview_attached(const fw_report_preview *in, fw_json *out);
/* "load_factor": of every load, in their order, its time law at the motion's instants */
void fw_report_preview_factors(const fw_device_scene *scene, const fw_dynamics_motion *motion,
                               fw_json *out);
/* "tension_N": of every tendon of the scene, at the motion's instants; empty: none acts */
fw_status fw_report_preview_tensions(fw_arena *arena, const fw_mechanism *mechanism,
                                     const fw_device_scene *scene, const fw_dynamics_motion *motion,
                                     fw_json *out);
/* the box, where it holds anything, with springs and joints; with cables and electrodes of a
   scene */
void fw_report_preview_attached_box(const fw_mechanism *mechanism, fw_geometry_box *box);
void fw_report_preview_scene_box(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                 fw_geometry_box *box);

#endif
