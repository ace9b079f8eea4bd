/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person reads in a terminal. The same bytes in every locale. */
#ifndef FW_REPORT_TERMINAL_H
#define FW_REPORT_TERMINAL_H
#include "report/report.h"

typedef struct fw_terminal_style {
    int detail; /* -1: the answer only, 0: tables too, 1: every reason */
    bool colour;
} fw_terminal_style;

/* decision, governing hinge, hinges, advice, flows */
fw_status fw_report_verdict_text(const fw_report_input *input, fw_terminal_style style,
                                 fw_text *out);
/* what each flow makes of the device, at its corners */
void fw_report_made_text(fw_text *out, const fw_verdict *verdict);
/* peaks, statistics, effects of one scene; holds a measured CPU time */
fw_status fw_report_simulate_text(const fw_scene *scene, const fw_mechanism *mechanism,
                                  const fw_motion *motion, fw_text *out);
#endif
