/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can this flow make this device? Private to process/. */
#ifndef FW_PROCESS_JUDGE_H
#define FW_PROCESS_JUDGE_H
#include "base/diag.h"
#include "process/process.h"

typedef enum fw_process_answer { FW_ANSWER_NO, FW_ANSWER_OPEN, FW_ANSWER_FINE } fw_process_answer;

typedef struct fw_process_judge {
    fw_arena *arena;
    fw_process_flow *flow;
    const fw_process_mask_facts *facts; /* may be NULL */
    fw_diags *diags;
    fw_text note;
    fw_process_answer verdict;
} fw_process_judge;

/* up to eight numbers of one sentence */
typedef struct fw_process_numbers {
    char text[8][32];
    int n;
} fw_process_numbers;
const char *fw_process_judge_number(fw_process_numbers *list, double value, int digits);
const char *fw_process_judge_um(fw_process_numbers *list, double value_m);
double fw_process_judge_known(const fw_quantity *q); /* NaN where it is not */

/* appends a reason; the verdict becomes no better than `weight` */
fw_status fw_process_judge_reason(fw_process_judge *j, fw_process_answer weight, const char *format,
                                  ...) __attribute__((format(printf, 3, 4)));
/* the reasons from `from` on come before all others, in their order */
void fw_process_judge_to_front(fw_process_flow *flow, int from);
/* what etches do to edges and gaps, from the fixed point (judge_etch.c) */
fw_status fw_process_judge_etching(fw_process_judge *j);

/* from the distances of the device's openings: the reach that frees it (judge_release.c) */
fw_status fw_process_judge_release(fw_process_judge *j);
/* fills the reaches that the pack leaves to the mask; after the edges are solved */
void fw_process_release_fill(fw_process_flow *flow, const fw_process_mask_facts *facts);

/* fills bias_note, manufacturable and reason. Edges and steps must have been computed. */
fw_status fw_process_flow_judge(fw_arena *arena, fw_process_flow *flow,
                                const fw_process_mask_facts *facts, fw_diags *diags);

/* What lateral etching does to a flexure, and how fine a mould can be printed. */

/* widths at the top and the bottom of a beam after an etch that lasts T = depth_equivalent/R */
void fw_process_undercut_widths(double width_m, double anisotropy, double depth_m, double etched_m,
                                double *top_m, double *bottom_m);
/* k/k0 of a trapezoidal section against a rectangle of width w0, bending in the wafer plane */
double fw_process_undercut_stiffness(double top_m, double bottom_m, double w0_m);
/* anisotropy at which the top edge of a beam is just cut through */
double fw_process_undercut_cut(double width_m, double etched_m);
/* smallest anisotropy that keeps k/k0 >= 1 - tolerance; straight: full undercut over the depth */
double fw_process_undercut_needed(double width_m, double depth_m, double etched_m, double tolerance,
                                  int straight);
/* smallest line or space, contact or proximity printing */
double fw_process_print_limit(double wavelength_m, double gap_m, double resist_m);

/* what change the whole flow was judged with and does not refuse, in words */
fw_status fw_process_judge_nearest(const fw_process_judge *j, const char **text);

/* one pass of a flow for the facts of a mask: fw_process_flow_compute_once, given by who calls */
typedef fw_status fw_process_compute(fw_arena *arena, fw_process_flow *flow,
                                     const fw_process_mask_facts *facts, fw_diags *diags);
/* the changes with which the whole flow refuses nothing (flow->nearest_...), and the flow computed once more with them known */
fw_status fw_process_judge_changes(fw_arena *arena, fw_process_flow *flow,
                                   const fw_process_mask_facts *facts, fw_process_compute *compute);

#endif
