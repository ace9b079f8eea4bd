/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an interactive page draws: the mechanism's shapes, to be put where its bodies are, and one
   motion of it. Compact JSON: numbers are rounded to what a picture needs, those of record are in
   the other documents. */
#ifndef FW_REPORT_PREVIEW_H
#define FW_REPORT_PREVIEW_H
#include "base/json.h"
#include "report/report.h"

typedef struct fw_report_left_out { /* what a quick answer is without */
    const char *what, *sentence;
    bool could_reject;
} fw_report_left_out;

typedef struct fw_report_preview {
    const char *status;                 /* "ok", "invalid", "failed" */
    int exit_status;                    /* that of the program for the same question */
    bool provisional;                   /* the verdict may still become worse by what is left out */
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

/* parts of it that other documents have too, each with its key */
fw_status fw_report_preview_shapes(fw_arena *arena, const fw_report_preview *in, fw_json *out);
/* "diagnostics": each once */
void fw_report_preview_diagnostics(const fw_diags *diags, const char *file, fw_json *out);
#endif
