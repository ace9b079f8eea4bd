/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the preview's files. Lengths are in um with y up, to 1 nm; keys as in base/json.h.
 */
#ifndef FW_REPORT_PREVIEW_PARTS_H
#define FW_REPORT_PREVIEW_PARTS_H
#include "report/preview.h"

void fw_report_preview_um(fw_json *out, const char *key, double metres);
void fw_report_preview_point(fw_json *out, const char *key, double x_m, double y_m); /* [x, y] */
void fw_report_preview_bodies(fw_json *out, const char *key, int a, int b); /* -1: the ground */
/* what else joins bodies and what drives them: "joints", "springs", "loads" */
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
