/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON for programs: 17 digits, keys in a fixed order, null where a number is not finite. */
#ifndef FW_REPORT_REPORT_JSON_H
#define FW_REPORT_REPORT_JSON_H
#include "statics/modes.h"
#include "report/report.h"

/* schema flexwright.verdict/1 (verdict.json) */
fw_status fw_report_verdict_json(const fw_report_input *input, fw_text *out);
/* schema flexwright.simulate/1 */
fw_status fw_report_simulate_json(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                  fw_text *out);
/* schema flexwright.modes/1 */
fw_status fw_report_modes_json(const fw_mechanism *mechanism, const fw_device_scene *scene,
                               const fw_statics_modes *modes, fw_text *out);
/* schema flexwright.statics/1 */
fw_status fw_report_statics_json(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                 const fw_statics *statics, fw_text *out);
#endif
