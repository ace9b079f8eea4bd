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
/* what etches do to edges and gaps, from the fixed point (judge_etch.c) */
fw_status fw_process_judge_etching(fw_process_judge *j);

/* fills bias_note, manufacturable and reason. Edges and steps must have been computed. */
fw_status fw_process_flow_judge(fw_arena *arena, fw_process_flow *flow,
                                const fw_process_mask_facts *facts, fw_diags *diags);

#endif
