/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What limits the answer of a study. Of a device that a study of sizes found: limits that it is at or misses, in sentences;
   each is said once, and at most eight are. Of a response: devices that have no value of it, of which no least and no largest
   one tells. Test: tests/cli/test_sizing.py, Lever; tests/cli/test_inputs.py, WithoutAValue */
#include "plan/stages.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

enum { LIMITS_MOST = 8 /* sentences */ };
/* share of a limit that a search takes for all of it */
static const double at_limit = 0.97;

static fw_status tell(fw_study *study, fw_study_found *f, const fw_text *text) {
    FW_TRY(fw_text_end(text));
    for (int k = 0; k < f->nlimit; k++)
        if (strcmp(f->limit[k], text->data) == 0) return FW_OK;
    if (f->nlimit == LIMITS_MOST) return FW_OK;
    FW_NEED(f->limit[f->nlimit++] = fw_arena_strdup(study->arena, text->data));
    return FW_OK;
}

/* a flow that says no to what hinges bear, and why, as `check` says it */
static fw_status tell_unmade(fw_study *study, const fw_plan *plan, fw_study_found *f) {
    for (int i = 0; i < plan->nflow; i++) {
        const fw_process_flow *flow = plan->flow[i].flow;
        fw_text text = fw_text_new(study->arena);
        if (!flow || flow->manufacturable != 0) continue;
        const char *why = flow->fails ? flow->fails : flow->nreason > 0 ? flow->reason[0] : "";
        fw_text_printf(&text, "it cannot be made in %s: %s", flow->id, why);
        FW_TRY(tell(study, f, &text));
    }
    return FW_OK;
}

static fw_status tell_reasons(fw_study *study, const fw_plan *plan, fw_study_found *f) {
    const fw_verdict *v = &plan->verdict;
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nreason; k++) {
            const char *words;
            fw_text text = fw_text_new(study->arena);
            if (v->variant[i].reason[k].decision != v->decision) continue;
            FW_TRY(fw_verdict_reason_words(plan->arena, v, i, k, &words));
            if (!words) continue;
            fw_text_add(&text, words);
            FW_TRY(tell(study, f, &text));
        }
    if (!plan->layout || plan->layout->nfault == 0) return tell_unmade(study, plan, f);
    fw_text text = fw_text_new(study->arena);
    fw_text_printf(&text, "it cannot be made: %s [FW-D%03d]", plan->layout->fault[0].message,
                   plan->layout->fault[0].number);
    return tell(study, f, &text);
}

/* the hinge or the requirement that governs, where it is not accepted or uses nearly all of its limit */
static fw_status tell_governing(fw_study *study, const fw_plan *plan, int kinds,
                                fw_study_found *f) {
    fw_verdict_check c;
    bool found;
    fw_text text = fw_text_new(study->arena);
    FW_TRY(fw_verdict_governing(plan->arena, &plan->verdict, kinds, true, &c, &found));
    if (!found || (c.decision == FW_ACCEPT && !(fmax(c.used, c.high) > at_limit))) return FW_OK;
    if (c.requirement && c.decision != FW_ACCEPT) return FW_OK; /* it is among the reasons */
    if (c.requirement)
        fw_text_add(&text, c.of);
    else
        fw_text_printf(&text, "%s uses %.1f %% of %s (%.1f to %.1f %%)", c.what, 100 * c.used, c.of,
                       100 * c.low, 100 * c.high);
    if (c.scene) fw_text_printf(&text, " in %s", c.scene);
    if (c.corner && strcmp(c.corner, "nominal") != 0) fw_text_printf(&text, ", with %s", c.corner);
    return tell(study, f, &text);
}

/* a limit (NaN: none) of a response that it misses; where all hold, one that it is at and its goal does not lead away from */
static fw_status tell_responses(fw_study *study, fw_study_found *f) {
    for (int k = 0; k < study->nresponse; k++) {
        const fw_study_response *of = &study->response[k];
        const fw_device_respond_goal way = of->asked->goal;
        const bool missed = f->excess > 0;
        const double value = f->response[k], slack = missed ? 0 : (1 - at_limit) * fabs(value);
        const bool low = value < of->min + slack && (missed || way != FW_GOAL_MAXIMISE),
                   high = value > of->max - slack && (missed || way != FW_GOAL_MINIMISE);
        fw_text text = fw_text_new(study->arena);
        if (!low && !high) continue;
        fw_text_printf(&text, "%s is ", of->asked->name);
        fw_study_response_text(&text, of, value);
        fw_text_add(&text, low ? ", and at least " : ", and at most ");
        fw_study_response_text(&text, of, low ? of->min : of->max);
        fw_text_add(&text, " is asked for");
        FW_TRY(tell(study, f, &text));
    }
    return FW_OK;
}

static fw_status tell_ranges(fw_study *study, fw_study_found *f) {
    for (int k = 0; k < study->nvary; k++) {
        const fw_study_input *in = &study->input[k];
        const double share = in->ntext > 0 ? 0.5 : fw_study_input_share(in, f->value[k]);
        fw_text text = fw_text_new(study->arena);
        if (share > 1e-4 && share < 1 - 1e-4) continue;
        fw_text_printf(&text, "%s is at the end of its range, %s", in->what, f->text[k]);
        FW_TRY(tell(study, f, &text));
    }
    return FW_OK;
}

/* It is judged once more: of samples their numbers are kept, and no words. What cannot be judged says nothing here. */
fw_status fw_study_tell_limits(fw_study *study, fw_study_found *f) {
    int status;
    fw_design *design = fw_study_design(study, study->options.cancel, f->text, &status);
    FW_NEED(design);
    FW_NEED(f->limit = fw_arena_array(study->arena, const char *, LIMITS_MOST));
    if (status == FW_STATUS_OK) status = fw_design_judge(design);
    const fw_plan *plan = fw_plan_design_plan(design);
    fw_status told = FW_OK;
    if (status == FW_STATUS_OK && f->decision != FW_ACCEPT) told = tell_reasons(study, plan, f);
    if (status == FW_STATUS_OK && told == FW_OK)
        told = tell_governing(study, plan, FW_CHECK_HINGES, f);
    if (status == FW_STATUS_OK && told == FW_OK)
        told = tell_governing(study, plan, FW_CHECK_REQUIREMENTS, f);
    fw_design_free(design);
    if (fw_plan_is_final((fw_status)status)) return (fw_status)status;
    FW_TRY(told);
    FW_TRY(tell_responses(study, f));
    return f->decision == FW_ACCEPT ? tell_ranges(study, f) : FW_OK;
}

/* ---- devices without a value of a response ---- */

enum { FIRST_DIGITS = 13 /* of the settings of the device that is named: it can be asked for */ };

fw_status fw_study_without_take(fw_study *study, const fw_study_sample *sample,
                                fw_study_without *without) {
    without->n++;
    without->failed += !sample->run;
    without->accepted += sample->run && sample->decision == 0;
    without->rejected += sample->run && sample->decision == 1;
    without->inconclusive += sample->run && sample->decision == 4;
    if (without->at >= 0) return FW_OK;
    without->at = sample->i;
    without->state = fw_study_state_text(sample->run, sample->decision);
    FW_NEED(without->text =
                fw_arena_alloc(study->arena, (size_t)study->nvary + 1, sizeof *without->text));
    return fw_study_settings_write(study, sample, FIRST_DIGITS, without->text);
}

/* "13 rejected, 11 inconclusive" */
static void say_states(fw_text *out, const fw_study_without *w) {
    const struct {
        long n;
        const char *words;
    } row[] = {{w->accepted, "accepted"},
               {w->rejected, "rejected"},
               {w->inconclusive, "inconclusive"},
               {w->failed, "could not be judged"},
               {w->n - w->accepted - w->rejected - w->inconclusive - w->failed, "not judged"}};
    for (size_t k = 0, said = 0; k < sizeof row / sizeof row[0]; k++)
        if (row[k].n > 0)
            fw_text_printf(out, "%s%ld %s", said++ ? ", " : "", row[k].n, row[k].words);
}

/* what that leaves of the answer */
static void say_consequence(fw_text *out, const fw_study *study, int r) {
    const fw_study_result *result = study->result;
    const long others = result->extreme[r].n;
    if (others == 0) return;
    switch (study->asked->kind) {
    case FW_STUDY_IS_worst_case:
        fw_text_printf(out,
                       "; the worst case of the ranges may well be among them, and both ends "
                       "above are only those of the other %ld",
                       others);
        break;
    case FW_STUDY_IS_sensitivity:
        if (result->index_rows && result->index_rows[r] < result->index_rows_all)
            fw_text_printf(out,
                           "; shares of its variance are of the %zu of %zu groups of devices in "
                           "which each has one, and not of all of the ranges",
                           result->index_rows[r], result->index_rows_all);
        break;
    case FW_STUDY_IS_size:
        fw_text_printf(out, "; what was found is the best of the other %ld at most", others);
        break;
    case FW_STUDY_IS_sweep:
    case FW_STUDY_IS_yield: /* has no responses */
    case FW_STUDY_KINDS:
        break;
    }
}

void fw_study_without_say(fw_text *out, const fw_study *study) {
    const fw_study_result *result = study->result;
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_without *w = &result->extreme[r].without;
        if (w->at < 0) continue;
        fw_text_printf(out, "  %ld of %ld devices have no value of %s: ", w->n,
                       result->run + result->failed, study->response[r].asked->name);
        say_states(out, w);
        fw_text_printf(out, "; number %ld (%s) is the first of them:", w->at, w->state);
        for (int k = 0; k < study->nvary; k++)
            fw_text_printf(out, " --set \"%s=%s\"", study->input[k].what, w->text[k]);
        say_consequence(out, study, r);
        fw_text_add(out, "\n");
    }
}
