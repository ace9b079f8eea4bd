/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person reads in a terminal. The same bytes in every locale. */
#ifndef FW_REPORT_TERMINAL_H
#define FW_REPORT_TERMINAL_H
#include "report/report.h"

typedef struct fw_report_terminal_style {
    int detail; /* -1: the answer only, 0: tables too, 1: every reason */
    bool colour;
} fw_report_terminal_style;

/* decision, governing hinge, hinges, advice, flows */
fw_status fw_report_verdict_text(const fw_report_input *input, fw_report_terminal_style style,
                                 fw_text *out);
/* what each flow makes of the device, at its corners */
void fw_report_fabricated_text(fw_text *out, const fw_verdict *verdict);
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

/* the largest of um, mm, m, km (uN, mN, N, kN, MN; us, ms, s) in which `largest_si` is at least 1
 */
fw_report_magnitude fw_report_magnitude_of(fw_report_measure measure, double largest_si);

#endif
