/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria and modes for people: text, tables, pictures. The same bytes every time. */
#ifndef FW_REPORT_REPORT_EQUILIBRIUM_H
#define FW_REPORT_REPORT_EQUILIBRIUM_H
#include "statics/modes.h"
#include "report/report.h"

/* "point", "limit point", "bifurcation", "switch", "end" */
const char *fw_report_path_mark(fw_statics_path_mark mark);

/* for a terminal */
fw_status fw_report_modes_text(const fw_device_scene *scene, const fw_statics_modes *modes,
                               fw_text *out);
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
#endif
