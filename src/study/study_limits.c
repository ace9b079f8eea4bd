/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What limits the answer of a study. Of a device that a study of sizes found: limits that it is at or misses, in sentences;
   each is said once, and at most eight are. Of a response: devices that have no value of it, of which no least and no largest
   one tells. And limits of responses that dies of a yield hold. Test: tests/cli/test_sizing.py, Lever and LimitsOfDies;
   tests/cli/test_inputs.py, WithoutAValue */
#include "base/json.h"
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

/* ---- limits of responses ---- */

/* relative to the limit where that is not 0 */
static double missed(double by, double limit) {
    return by / (limit != 0 ? fabs(limit) : 1);
}

int fw_study_limits(const fw_study *study, const fw_study_sample *sample, double *c) {
    int n = 0;
    for (int k = 0; k < study->nresponse; k++) {
        const fw_study_response *q = &study->response[k];
        const double value = sample ? sample->response[k] : (double)NAN;
        if (!isnan(q->min) && c) c[n] = missed(q->min - value, q->min);
        n += !isnan(q->min);
        if (!isnan(q->max) && c) c[n] = missed(value - q->max, q->max);
        n += !isnan(q->max);
    }
    return n;
}

/* what hinges and requirements use, in the units of a number that is the largest of it: less `from`, over `of` */
double *fw_study_used_by(const fw_study *study, const fw_study_sample *sample, double from,
                         double of, double *part) {
    for (int j = 0; j < study->nuse; j++)
        *part++ = (sample->use[FW_USE_NUMBERS * j + FW_USE_VALUE] - from) / of;
    return part;
}

void fw_study_limits_parts(const fw_study *study, const fw_study_sample *sample, int **count,
                           double **part) {
    for (int k = 0; k < study->nresponse; k++) {
        const fw_study_response *q = &study->response[k];
        const bool largest = fw_study_response_is_largest(q);
        if (!isnan(q->min) && count) *(*count)++ = 0;
        if (isnan(q->max)) continue;
        if (count) *(*count)++ = largest ? study->nuse : 0;
        if (part && largest)
            *part = fw_study_used_by(study, sample, q->max, q->max != 0 ? fabs(q->max) : 1, *part);
    }
}

double fw_study_excess(const fw_study *study, const fw_study_sample *sample) {
    double most = -HUGE_VAL;
    if (!sample->run) return (double)NAN;
    for (int k = 0; k < study->nresponse; k++) {
        const fw_study_response *q = &study->response[k];
        double value = sample->response[k];
        if (isnan(q->min) && isnan(q->max)) continue;
        if (isnan(value)) return (double)NAN;
        if (!isnan(q->min)) most = fmax(most, missed(q->min - value, q->min));
        if (!isnan(q->max)) most = fmax(most, missed(value - q->max, q->max));
    }
    return most;
}

/* looked at in a few corners it holds every limit and would be better than what was found: it was judged in all of them as
   another sample */
bool fw_study_was_refused(const fw_study *study, const fw_study_sample *s) {
    const fw_study_result *r = study->result;
    if (!fw_study_is_partly(s) || r->nfound != 1 || !(fw_study_excess(study, s) <= 0)) return false;
    for (int k = 0; k < study->nresponse; k++) {
        const fw_device_respond_goal way = study->response[k].asked->goal;
        const double gains = s->response[k] - r->found[0].response[k];
        if ((way == FW_GOAL_MINIMISE && gains < 0) || (way == FW_GOAL_MAXIMISE && gains > 0))
            return true;
    }
    return false;
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
    case FW_STUDY_IS_yield: /* they count both ways */
    case FW_STUDY_KINDS:
        break;
    }
}

void fw_study_without_say(fw_text *out, const fw_study *study) {
    const fw_study_result *result = study->result;
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_without *w = &result->extreme[r].without;
        const char *left_out = fw_study_not_counted(study, r);
        if (left_out)
            fw_text_printf(out, "  the yield does not count the limit of %s: %s\n",
                           study->response[r].asked->name, left_out);
        if (w->at < 0 || (left_out && study->asked->kind == FW_STUDY_IS_yield)) continue;
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

/* ---- limits of responses that dies hold ----
   A die is held against the limits of check as it is made (study_made.c), and against those of responses by its documents: of
   hinges and requirements as the flow makes them, of any other number where no flow makes anything differ and a die is the
   description with its own settings. A response is as far off as its document says beside it.

   Of a limit L and a value v, x = v/L: of a max the share is x, of a min 1/x, and ln of it goes on in a straight line where x is
   below 1/2; where both are below 0 a max is a min turned. Of a limit 0 it is exp(v/now), now as the description stands. In: the
   unit of the response. Error: that of the document. Test: tests/cli/test_sizing.py, LimitsOfDies */

typedef enum told { /* what a document says of how far off a number is */
                    TOLD_NOTHING,
                    TOLD_BAND,  /* both ends */
                    TOLD_ERROR, /* either way */
                    TOLD_SHARE  /* either way, of the number */
} told;

static const struct {
    const char *document, *begin, *key; /* whose path begins and ends so */
    const char *low, *high;             /* keys in its place; of an error one */
    told as;
} beside[] = {
    {"verdict", "requirements[", "value", "band[0]", "band[1]", TOLD_BAND},
    {"verdict", "hinges[", "utilisation", "utilisation_band[0]", "utilisation_band[1]", TOLD_BAND},
    {"verdict", "governing", "utilisation", "utilisation_band[0]", "utilisation_band[1]",
     TOLD_BAND},
    {"verdict", "hinges[", "peak_angle_rad", "angle_error_rad", NULL, TOLD_ERROR},
    {"verdict", "governing", "peak_angle_rad", "angle_error_rad", NULL, TOLD_ERROR},
    {"verdict", "clearances[", "clearance_m", "low_m", "high_m", TOLD_BAND},
    {"verdict", "out_of_plane[", "f_Hz", "band_Hz[0]", "band_Hz[1]", TOLD_BAND},
    {"modes", "modes[", "f_Hz", "frequency_error", NULL, TOLD_SHARE},
    {"modes", "modes[", "omega_rad_per_s", "frequency_error", NULL, TOLD_SHARE},
    {"simulate", "probes[", "peak", "error", NULL, TOLD_ERROR},
    {"simulate", "probes[", "maximum", "error", NULL, TOLD_ERROR},
    {"simulate", "probes[", "minimum", "error", NULL, TOLD_ERROR},
    {"simulate", "probes[", "final", "final_error", NULL, TOLD_ERROR},
    {"simulate", "reactions[", "force_N", "error_N", NULL, TOLD_ERROR},
    {"simulate", "reactions[", "torque_Nm", "torque_error_Nm", NULL, TOLD_ERROR},
};

typedef struct held { /* of `at` */
    int response;     /* of the study that states the limit */
    int value, low, high;
    told as;
} held;

struct fw_study_counted { /* of one flow */
    fw_study at;          /* its dies, with the responses that are read of them */
    const fw_study *of;
    held *held; /* (n) */
    int n;
};

static bool is_limited(const fw_study_response *r) {
    return !isnan(r->min) || !isnan(r->max);
}

static const char *left_out(const fw_study *study, const fw_plan *plan, int k) {
    const fw_study_response *r = &study->response[k];
    if (!is_limited(r) || fw_study_response_of_hinges(r)) return NULL;
    if (fw_study_documents[r->document].stages & FW_STUDY_STAGE_FABRICATE)
        return "masks and recipes are of the drawing, which all dies have in common";
    for (int i = 0; i < plan->verdict.nvariant; i++)
        if (plan->verdict.variant[i].ninput > 0)
            return "the document that it stands in is of the drawing, and not of what a flow makes "
                   "of it; ask for it by <require>, which check and dies are held against as made";
    return NULL;
}

static bool is_of_dies(const fw_study *study) {
    return study->asked && (study->asked->kind == FW_STUDY_IS_yield || study->asked->yield > 0);
}

const char *fw_study_not_counted(const fw_study *study, int k) {
    const fw_study *dies = study->dies ? study->dies : study;
    return is_of_dies(study) && dies->plan ? left_out(study, dies->plan, k) : NULL;
}

void fw_study_counted_say(fw_text *out, const fw_study *study, int k) {
    const char *why = fw_study_not_counted(study, k);
    if (why)
        fw_text_printf(out, ", which the yield does not count: %s", why);
    else if (is_of_dies(study) && is_limited(&study->response[k]))
        fw_text_add(out, ", of dies, too");
    fw_text_add(out, "\n");
}

void fw_study_counted_json(fw_json *json, const fw_study *study, int k) {
    if (!is_of_dies(study) || !is_limited(&study->response[k])) return;
    const char *why = fw_study_not_counted(study, k);
    fw_json_truth(json, "counted", !why);
    fw_json_text(json, "not_counted", why);
}

/* the response `asked`, with another last key; NULL: its own */
static fw_status add_read(struct fw_study_counted *c, const fw_device_respond *asked,
                          const char *key, int *at) {
    fw_arena *arena = c->at.arena;
    fw_device_respond *own = fw_arena_one(arena, fw_device_respond);
    FW_NEED(own);
    *own = *asked;
    const char *last = asked->value;
    int depth = 0;
    for (const char *p = last; *p; p++) {
        depth += (*p == '[') - (*p == ']');
        if (depth == 0 && *p == '.') last = p + 1;
    }
    if (key)
        FW_NEED(own->value = fw_arena_printf(arena, "%.*s%s", (int)(last - asked->value),
                                             asked->value, key));
    *at = c->at.nresponse;
    return fw_study_response_parse(arena, own, &c->at.diags, &c->at.response[c->at.nresponse++]);
}

/* does the path end in the key? */
static bool ends_in(const char *path, const char *key) {
    const size_t n = strlen(path), m = strlen(key);
    return n > m && strcmp(path + n - m, key) == 0 && path[n - m - 1] == '.';
}

static fw_status add_held(struct fw_study_counted *c, int k) {
    const fw_study_response *r = &c->of->response[k];
    held *h = &c->held[c->n++];
    *h = (held){.response = k};
    FW_TRY(add_read(c, r->asked, NULL, &h->value));
    c->at.stages |= fw_study_documents[r->document].stages;
    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
        if (strcmp(fw_study_documents[r->document].name, beside[i].document) != 0 ||
            strncmp(r->path, beside[i].begin, strlen(beside[i].begin)) != 0 ||
            !ends_in(r->path, beside[i].key))
            continue;
        h->as = beside[i].as;
        FW_TRY(add_read(c, r->asked, beside[i].low, &h->low));
        return beside[i].high ? add_read(c, r->asked, beside[i].high, &h->high) : FW_OK;
    }
    return FW_OK;
}

/* columns: what a size has chosen, settings, quantities of the flow */
static fw_status add_inputs(struct fw_study_counted *c, const fw_study *dies, int flow) {
    const fw_verdict_variant_verdict *v = &dies->plan->verdict.variant[flow];
    fw_study *at = &c->at;
    at->nvary = c->of == dies ? 0 : c->of->nvary;
    at->ninput = at->nvary + at->nsetting + v->ninput;
    fw_study_input *in = fw_arena_array(at->arena, fw_study_input, (size_t)at->ninput + 1);
    FW_NEED(in);
    for (int k = 0; k < at->nvary; k++)
        in[k] = c->of->input[k];
    for (int k = 0; k < at->nsetting; k++)
        in[at->nvary + k] = dies->input[dies->nvary + k];
    for (int k = 0; k < v->ninput; k++)
        in[at->nvary + at->nsetting + k] = (fw_study_input){.what = v->input[k].name};
    at->input = in;
    return FW_OK;
}

static fw_status open_flow(fw_study *dies, const fw_study *of, int flow,
                           struct fw_study_counted *c) {
    const size_t n = (size_t)of->nresponse;
    fw_device_study *asked = fw_arena_one(dies->arena, fw_device_study);
    bool hinges = true;
    *c = (struct fw_study_counted){.at = *dies, .of = of};
    fw_study *at = &c->at;
    FW_NEED(asked);
    FW_NEED(c->held = fw_arena_array(dies->arena, held, n));
    FW_NEED(at->response = fw_arena_array(dies->arena, fw_study_response, 3 * n));
    at->nresponse = 0, at->stages = 0, at->held = NULL, at->dies = NULL, at->store = NULL;
    at->diags = fw_diags_new(dies->arena);
    for (int k = 0; k < of->nresponse; k++) {
        if (!is_limited(&of->response[k]) || left_out(of, dies->plan, k)) continue;
        hinges = hinges && fw_study_response_of_hinges(&of->response[k]);
        FW_TRY(add_held(c, k));
    }
    FW_TRY(add_inputs(c, dies, flow));
    *asked = *dies->asked;
    asked->judge = hinges ? FW_JUDGE_DIE : FW_JUDGE_MADE; /* else as drawn, which the die is */
    asked->fitted = 0;
    at->asked = asked;
    const char *name = dies->plan->verdict.variant[flow].variant->flow;
    if (name) at->options.design.flow = name;
    return fw_study_engines_open(at);
}

fw_status fw_study_counted_open(fw_study *dies, const fw_study *of) {
    int n = 0;
    for (int k = 0; k < of->nresponse; k++)
        n += is_limited(&of->response[k]) && !left_out(of, dies->plan, k);
    if (n == 0) return FW_OK;
    struct fw_study_counted *c =
        fw_arena_array(dies->arena, struct fw_study_counted, (size_t)dies->plan->nflow);
    FW_NEED(c);
    dies->held = c;
    for (int i = 0; i < dies->plan->nflow; i++)
        FW_TRY(open_flow(dies, of, i, &c[i]));
    return FW_OK;
}

void fw_study_counted_warn(fw_study *study) {
    for (int k = 0; k < study->nresponse; k++) {
        const fw_device_respond *r = study->response[k].asked;
        const char *why = fw_study_not_counted(study, k);
        if (why)
            fw_diag_warning(&study->diags, 755, r->place,
                            "study '%s': its yield does not count the limit of response '%s' "
                            "(%s): %s",
                            study->asked->name, r->name, r->value, why);
    }
}

void fw_study_counted_close(fw_study *dies) {
    for (int i = 0; dies->held && i < dies->plan->nflow; i++)
        fw_study_engines_close(&dies->held[i].at);
    dies->held = NULL;
}

/* ln of a share of a min that is above 0, of a max x is turned */
static double ln_of(double x) {
    return x > 0.5 ? log(x) : log(0.5) + (x - 0.5) / 0.5;
}

/* ln of the share of a min that a value uses */
static double of_min(double value, double min, double now) {
    if (min > 0) return -ln_of(value / min);
    if (min < 0) return ln_of(value / min);
    return -value / (now != 0 && isfinite(now) ? fabs(now) : 1);
}

/* by value, at the best end of its band and at the worst: the largest share of both limits */
static void read_limits(const fw_study_response *r, double value, double low, double high,
                        double *ln) {
    const double far = 6.9; /* an end that nobody knows is a thousand times away */
    const double end[FW_STUDY_READINGS][2] = {{value, value}, {high, low}, {low, high}};
    for (int i = 0; i < FW_STUDY_READINGS; i++) {
        const double off = i == FW_STUDY_AT_BEST ? -far : far;
        for (int k = 0; k < 2; k++) {
            const double bound = k ? r->max : r->min, is = end[i][k];
            if (isnan(bound)) continue;
            const double turned = k ? -1 : 1;
            ln[i] = fmax(ln[i], isnan(is) ? of_min(turned * value, turned * bound, r->now) + off
                                          : of_min(turned * is, turned * bound, r->now));
        }
    }
}

/* of one limit, of a device that has values; false: this one has none */
static bool hold(const struct fw_study_counted *c, const held *h, const double *read, double *ln) {
    const double value = read[h->value], by = read[h->low];
    double low = value, high = value;
    switch (h->as) {
    case TOLD_NOTHING:
        break;
    case TOLD_BAND:
        low = fmin(by, value), high = fmax(read[h->high], value);
        if (isnan(by)) low = by;
        if (isnan(read[h->high])) high = read[h->high];
        break;
    case TOLD_ERROR:
        low = value - fabs(by), high = value + fabs(by);
        break;
    case TOLD_SHARE:
        low = value - fabs(by * value), high = value + fabs(by * value);
        break;
    }
    if (!isnan(value)) read_limits(&c->of->response[h->response], value, low, high, ln);
    return !isnan(value);
}

static fw_status settings_of(const struct fw_study_counted *c, const fw_study_yielding *y,
                             const double *x, fw_study_sample *sample) {
    const fw_study *at = &c->at;
    const int first = at->nvary + at->nsetting;
    for (int k = 0; k < at->ninput; k++)
        sample->text[k][0] = '\0', sample->value[k] = (double)NAN;
    for (int k = 0; k < y->nbase && k < at->nvary; k++)
        snprintf(sample->text[k], FW_STUDY_TEXT, "%s", y->base[k].value);
    for (int k = at->nvary; k < first; k++)
        FW_TRY(fw_study_input_write(&at->input[k], x[y->ninput + k - at->nvary], 12,
                                    sample->text[k], &sample->value[k]));
    for (int k = first; k < at->ninput; k++)
        sample->value[k] = x[k - first];
    return FW_OK;
}

fw_status fw_study_counted_judge(const fw_study_yielding *y, fw_arena *arena, const double *x,
                                 fw_verdict_made *made, double *response) {
    const struct fw_study_counted *c = &y->study->held[y->flow];
    double ln[FW_STUDY_READINGS] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    const char *without = NULL;
    bool changed = false;
    fw_study_sample sample;
    if (made->why && isnan(made->ln)) return FW_OK; /* it cannot even be read or run */
    FW_TRY(fw_study_sample_new(arena, &c->at, &sample));
    FW_TRY(settings_of(c, y, x, &sample));
    fw_status status = fw_study_evaluate(&c->at, y->study->options.cancel, &sample, &changed);
    if (changed || fw_plan_is_final(status)) return status;
    for (int k = 0; k < c->n; k++) {
        const held *h = &c->held[k];
        if (sample.run && response && c->of == y->study)
            response[h->response] = sample.response[h->value];
        if (!sample.run || !hold(c, h, sample.response, ln))
            without = c->of->response[h->response].asked->name;
    }
    const bool fails = made->ln > 0 || ln[FW_STUDY_BY_VALUE] > 0;
    made->ln = fmax(made->ln, ln[FW_STUDY_BY_VALUE]); /* NaN is passed */
    made->low = fmax(made->low, ln[FW_STUDY_AT_BEST]);
    made->high = fmax(made->high, ln[FW_STUDY_AT_WORST]);
    if (!without || fails) return FW_OK;
    made->ln = made->low = made->high = (double)NAN;
    FW_NEED(made->why = fw_arena_printf(arena, "it has no value of %s, which has a limit%s%s",
                                        without, sample.why[0] ? ": " : "", sample.why));
    return FW_OK;
}
