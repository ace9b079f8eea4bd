/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reasons of a judgement, and numbers in their sentences. */
#include "process/judge.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *fw_process_judge_number(fw_process_numbers *list, double value, int digits) {
    char *text = list->text[list->n++ % 8];
    return fw_number_text(text, sizeof list->text[0], value, digits);
}

const char *fw_process_judge_um(fw_process_numbers *list, double value_m) {
    return fw_process_judge_number(list, value_m * 1e6, 4);
}

double fw_process_judge_known(const fw_quantity *q) {
    return q && !q->unknown ? q->value : (double)NAN;
}

static fw_status append(fw_arena *arena, fw_process_flow *f, const char *why) {
    const char **grown =
        fw_arena_grow(arena, f->reason, (size_t)f->nreason, (size_t)f->nreason + 1, sizeof *grown);
    FW_NEED(why && grown);
    f->reason = grown;
    f->reason[f->nreason++] = why;
    return FW_OK;
}

void fw_process_judge_to_front(fw_process_flow *f, int from) {
    for (int i = from; i < f->nreason; i++) {
        const char *why = f->reason[i];
        memmove(f->reason + i - from + 1, f->reason + i - from, (size_t)from * sizeof *f->reason);
        f->reason[i - from] = why;
    }
}

fw_status fw_process_flow_add_reason(fw_arena *arena, fw_process_flow *flow, int manufacturable,
                                     const char *why) {
    FW_TRY(append(arena, flow, why));
    if (manufacturable == 0) flow->fails = why;
    if (manufacturable == 0) fw_process_judge_to_front(flow, flow->nreason - 1);
    if (manufacturable == 0 || flow->manufacturable != 0) flow->manufacturable = manufacturable;
    return FW_OK;
}

void fw_process_flow_lead(fw_process_flow *flow, int from) {
    if (from >= flow->nreason || flow->manufacturable == 0) return;
    fw_process_judge_to_front(flow, from);
    if (!flow->fails) flow->fails = flow->reason[0];
}

static fw_process_answer worse(fw_process_answer a, fw_process_answer b) {
    if (a == FW_ANSWER_NO || b == FW_ANSWER_NO) return FW_ANSWER_NO;
    return a == FW_ANSWER_OPEN || b == FW_ANSWER_OPEN ? FW_ANSWER_OPEN : FW_ANSWER_FINE;
}

fw_status fw_process_judge_reason(fw_process_judge *j, fw_process_answer weight, const char *format,
                                  ...) {
    char text[1200];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length >= (int)sizeof text) { /* cut a very long list, never inside a character */
        size_t end = sizeof text - 4;
        while (end > 0 && ((unsigned char)text[end] & 0xC0) == 0x80)
            end--;
        memcpy(text + end, "...", 4);
    }
    FW_TRY(append(j->arena, j->flow, fw_arena_strdup(j->arena, text)));
    if (weight == FW_ANSWER_NO && j->verdict != FW_ANSWER_NO)
        j->flow->fails = j->flow->reason[j->flow->nreason - 1];
    j->verdict = worse(j->verdict, weight);
    return FW_OK;
}

/* what was judged with the whole flow (flow.c): in the last pass of fw_process_flow_compute, which the reasons are of */
fw_status fw_process_judge_nearest(const fw_process_judge *j, const char **text) {
    const fw_process_flow *f = j->flow;
    fw_process_numbers t = {0};
    fw_text list = fw_text_new(j->arena);
    fw_text_add(&list, "");
    if (f->nearest_known && !isnan(f->nearest_gap_m))
        fw_text_printf(&list, "openings at least %s um wide",
                       fw_process_judge_um(&t, f->nearest_gap_m));
    if (f->nearest_known && !isnan(f->nearest_anisotropy))
        fw_text_printf(&list, "%san etch with an anisotropy of at least %s",
                       list.length ? ", or " : "",
                       fw_process_judge_number(&t, f->nearest_anisotropy, 5));
    if (!list.length)
        fw_text_add(&list,
                    "no width of the openings alone is enough; a thinner layer or another etch");
    FW_TRY(fw_text_end(&list));
    *text = list.data;
    return FW_OK;
}
