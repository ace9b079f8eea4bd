/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The quick look: what has been done with a design so far, in one document. */
#include "plan/design.h"
#include "plan/plan.h"
#include "plan/live.h"
#include "plan/stages.h"
#include "report/report.h"
#include <string.h>
#include <time.h>

/* a preview shows all of a motion */
enum { WANTED = FW_WANTED_FIGURES | FW_WANTED_ENERGIES, NO_MATERIAL = 225 /* FW-D225 */ };

/* names and materials of the flows where nothing was judged */
static fw_status flows_of(fw_plan *plan, bool judged, fw_report_preview *in) {
    in->nflow = plan->nflow;
    if (judged) {
        in->flow = fw_plan_report_input(plan).flow;
        return in->flow ? FW_OK : FW_NOMEM;
    }
    size_t n = (size_t)plan->nflow;
    fw_report_flow *flow = fw_arena_array(plan->arena, fw_report_flow, n);
    fw_verdict_variant_verdict *verdict =
        fw_arena_array(plan->arena, fw_verdict_variant_verdict, n);
    FW_NEED(flow && verdict ? flow : NULL);
    for (size_t i = 0; i < n; i++) {
        verdict[i].variant = &plan->flow[i].variant;
        flow[i].variant = &verdict[i];
    }
    in->flow = flow;
    return FW_OK;
}

/* where nothing was moved: the one that was judged, or one that is built for the picture; what
   there is to say of it is not said twice */
static fw_status mechanism_of(fw_plan *plan, bool judged, const fw_mechanism **mechanism) {
    *mechanism = judged ? plan->verdict.variant[0].mechanism : NULL;
    if (*mechanism) return FW_OK;
    fw_diags said = plan->diags;
    plan->diags = fw_diags_new(plan->arena);
    fw_status status = fw_plan_mechanism(plan, NULL, mechanism);
    if (status == FW_GEOMETRY && plan->layout && plan->layout->nfault > 0) /* shown, not moved */
        status = fw_plan_hinges_mechanism(plan, plan->layout, &plan->flow[0].variant, mechanism);
    plan->diags = said;
    if (status != FW_OK) *mechanism = NULL;
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}

/* does a flow make anything of the device that was not judged? */
static bool corners_missing(const fw_plan *plan) {
    bool missing = false;
    for (int i = 0; i < plan->verdict.nvariant; i++)
        missing = missing || plan->verdict.variant[i].ninput > 0;
    return missing && plan->options.verdict.corners != FW_CORNERS_AUTO;
}

/* pins where nobody asked for them: what that may be off by is in the bands */
static bool only_pins(const fw_plan *plan) {
    const fw_verdict_options *o = &plan->options.verdict;
    return o->at_a_glance && o->motion.effects.hinge == FW_HINGE_REVOLUTE;
}

enum { LEFT_OUT_MOST = 5 };

static int leave_out(const fw_plan *plan, bool judged, fw_report_left_out *item) {
    int n = 0;
    if (judged && only_pins(plan))
        item[n++] = (fw_report_left_out){
            "hinge-model",
            "Hinges are pins; what a better model of them would change is estimated, and in the "
            "bands of the utilisations.",
            true};
    if (judged && plan->options.verdict.at_a_glance)
        item[n++] = (fw_report_left_out){"closer-look",
                                         "What is undecided was not computed more closely.", true};
    if (!judged)
        item[n++] = (fw_report_left_out){"verdict", "Nothing was judged.", true};
    else if (corners_missing(plan))
        item[n++] = (fw_report_left_out){
            "corners",
            "Judged as drawn: what the flows may make of it (edges, etch, thickness, modulus) was "
            "not run.",
            true};
    if (!plan->options.verdict.with_advice)
        item[n++] = (fw_report_left_out){"advice",
                                         "No change that would be accepted was "
                                         "searched for.",
                                         false};
    item[n++] = (fw_report_left_out){
        "masks",
        "No mask was computed, so no design rule was checked; the verdict covers the "
        "hinges only.",
        false};
    return n;
}

static fw_status verdict_of(fw_design *d, fw_report_preview *in) {
    fw_plan *plan = d->plan;
    if (!(d->done & FW_DONE_JUDGED)) return FW_OK;
    fw_text json = fw_text_new(plan->arena);
    FW_TRY(fw_plan_verdict_json(plan, &json));
    in->verdict_json = json.data;
    in->verdict = &plan->verdict;
    return FW_OK;
}

/* of a design that was judged only: the scene that was asked for, or the first that has a motion,
   in the first flow where it has */
static void judged_motion(const fw_plan *plan, fw_report_preview *in) {
    const char *wanted = plan->options.scene;
    for (int k = 0; k < in->device->nscene; k++) {
        const fw_device_scene *scene = &in->device->scene[k];
        if (wanted && strcmp(wanted, scene->name) != 0) continue;
        for (int i = 0; i < plan->verdict.nvariant; i++) {
            const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
            if (!v->motion || !v->motion[k]) continue;
            in->mechanism = v->mechanism, in->motion = v->motion[k];
            in->scene = &v->mechanism->device->scene[k];
            return;
        }
    }
}

/* the exit status of `check` for the same, and whether it may still become worse */
static void outcome(fw_design *d, fw_status status, fw_report_preview *in) {
    bool judged = d->done & FW_DONE_JUDGED;
    in->exit_status = judged ? fw_design_decision(d) : fw_status_exit(status);
    in->provisional = judged && d->plan->verdict.decision != FW_REJECT;
    bool could = false;
    for (int i = 0; i < in->nleft_out; i++)
        could = could || in->left_out[i].could_reject;
    in->provisional = in->provisional && could;
}

/* status: of what was tried last; device: the plan's, or the same one as another text has it */
static fw_status compose(fw_design *d, const fw_device *device, fw_status status, bool rates,
                         fw_text *out) {
    fw_plan *plan = d->plan;
    fw_report_left_out left_out[LEFT_OUT_MOST];
    bool judged = d->done & FW_DONE_JUDGED, moved = d->done & FW_DONE_SIMULATED;
    fw_report_preview in = {.status = device ? "ok" : "invalid",
                            .left_out = left_out,
                            .nleft_out = leave_out(plan, judged, left_out),
                            .rates = rates,
                            .diags = &plan->diags,
                            .file = plan->source_file,
                            .device = device,
                            .read_s = d->read_s,
                            .judge_s = d->judge_s,
                            .simulate_s = d->simulate_s};
    if (!(d->done & FW_DONE_READ)) in.device = NULL, in.status = "invalid";
    if (in.device) {
        FW_TRY(flows_of(plan, judged, &in));
        FW_TRY(verdict_of(d, &in));
        if (moved)
            in.mechanism = d->mechanism, in.motion = d->motion, in.scene = d->scene;
        else if (judged)
            judged_motion(plan, &in);
        if (!in.mechanism) FW_TRY(mechanism_of(plan, judged, &in.mechanism));
        in.layout = plan->layout;
        if (status != FW_OK && !judged && !moved) in.status = "failed";
    }
    outcome(d, status, &in);
    return fw_report_preview_json(plan->arena, &in, out);
}

fw_status fw_plan_design_preview_json(fw_design *design, fw_text *out) {
    if (design->done & FW_DONE_SIMULATED) FW_TRY(fw_plan_design_know(design, WANTED));
    return compose(design, design->plan->device, FW_OK, false, out);
}

/* ---- the request ---- */

/* what ends a request; anything else is said by the document */
static bool hopeless(int status) {
    return status == FW_STATUS_NOMEM || status == FW_STATUS_CANCELLED ||
           status == FW_STATUS_INTERNAL;
}

typedef struct work {
    const fw_device *device;
    fw_status status;
    bool rates;
    fw_text *out;
} work;

static fw_status document(fw_design *d, void *argument) {
    const work *w = argument;
    return compose(d, w->device, w->status, w->rates, w->out);
}

/* so many rows that a page can still take them: fewer of a mechanism with hundreds of bodies */
static void shorten(fw_plan *plan) {
    enum { NUMBERS_MOST = 400000 };
    int each = 3 * plan->device->nbody + plan->device->nrevolute + 6;
    int most = NUMBERS_MOST / each > 2 ? NUMBERS_MOST / each : 2, *samples;
    samples = &plan->options.verdict.motion.samples;
    if (*samples > most) *samples = most;
}

/* what has no flexure has no limit: that it cannot be judged without a material is no mistake of a
   description that moves */
static void excuse(fw_plan *plan) {
    for (size_t i = 0; plan->device->nflexure == 0 && i < plan->diags.count; i++) {
        fw_diag *said = &plan->diags.item[i];
        if (said->number != NO_MATERIAL || said->severity != FW_ERROR) continue;
        said->severity = FW_NOTE;
        plan->diags.errors--;
    }
}

/* judged and moved, of a description that was read with this status */
static fw_status look(fw_design *d, int status, fw_plan_live_request *request, bool rates,
                      fw_text *out) {
    if (status == FW_STATUS_USAGE && d->wrong_option)
        return fw_plan_live_wrong(request, d->wrong_option, NULL);
    if (status == FW_STATUS_OK) {
        bool scenes = d->plan->device->nscene > 0;
        shorten(d->plan);
        status = fw_design_judge(d);
        /* its motions will do for a picture; what cannot be judged can be moved all the same */
        int moved = FW_STATUS_OK;
        if (scenes && !hopeless(status) && (request->full || status != FW_STATUS_OK))
            d->wanted |= WANTED, moved = fw_design_simulate(d);
        if (scenes && status != FW_STATUS_OK && moved == FW_STATUS_OK) excuse(d->plan);
        if (hopeless(moved)) status = moved;
    }
    if (hopeless(status)) return (fw_status)status;
    return (fw_status)fw_plan_design_run(d, document,
                                         &(work){d->plan->device, (fw_status)status, rates, out});
}

/* ---- what the former preview read ---- */

/* A slider changes the description some ten times a second and the packs never; reading them takes a quarter of a
   preview. The design that was shown last stays as it was read, and becomes the next one if that has the same
   options and names the same packs, whose files are compared. */

enum { KEPT_MOST = 64 * 1024 * 1024 }; /* bytes of a design that stays */

void fw_plan_live_shown_free(fw_plan_live *live) {
    fw_plan_kept_free(&live->shown.kept);
    fw_design_free(live->shown.kept.design);
    json_decref(live->shown.options);
    json_decref(live->shown.lab);
    json_decref(live->shown.held);
    live->shown = (struct fw_plan_live_shown){.options = NULL};
}

static bool alike(const json_t *a, const json_t *b) {
    return a == b || (a && b && json_equal(a, b));
}

/* *done false: the description is to be read as if there had been none before */
static fw_status take_shown(fw_plan_live *live, fw_plan_live_request *r, bool *done) {
    fw_device_set *set;
    int n;
    *done = false;
    if (!live->shown.kept.design || !alike(live->shown.options, r->options) ||
        !alike(live->shown.lab, r->lab))
        return FW_OK;
    FW_TRY(fw_plan_live_sets(r, r->arena, r->set, &set, &n));
    r->full = live->shown.full;
    return fw_plan_kept_with(&live->shown.kept, r->text, r->length, set, n, done);
}

static void keep_shown(fw_plan_live *live, const fw_plan_live_request *r, fw_design *design) {
    if (fw_plan_keep(design, &live->shown.kept) != FW_OK) {
        live->shown.kept.design = NULL;
        return;
    }
    live->shown.options = json_incref(r->options);
    live->shown.lab = json_incref(r->lab);
    live->shown.full = r->full;
}

/* ---- what was held, as text ---- */

/* Who lets a slider go has its value written into the text and asks what that text gives: the device that was judged
   with the value held. Its answer is composed anew, of the description as the new text has it, and nothing is judged
   again: a tenth of the cost. Only of an answer that the very last request has got, and once. Test: test_live_kept.c,
   which compares with the answer of somebody who asks for the first time. */

/* Of two texts: are they the same but for numbers in some lines? Then everything in the other lines has its place in
   both, and nothing that is said of these lines names another unit or element. changed(line) is called for each line that
   is another one; false from it: they are not. */
static bool but_for_numbers(const char *a, const char *b, bool (*changed)(const fw_plan *, int),
                            const fw_plan *plan) {
    static const char number[] = "0123456789.+-eE";
    for (int line = 1;; line++) {
        size_t n = strcspn(a, "\n"), m = strcspn(b, "\n"), same = 0, behind = 0;
        while (same < n && same < m && a[same] == b[same])
            same++;
        while (behind < n - same && behind < m - same && a[n - 1 - behind] == b[m - 1 - behind])
            behind++;
        size_t left = n - same - behind, right = m - same - behind;
        if (strspn(a + same, number) < left || strspn(b + same, number) < right) return false;
        if (left + right > 0 && !changed(plan, line)) return false;
        if (!a[n] || !b[m]) return a[n] == b[m];
        a += n + 1, b += m + 1;
    }
}

/* does the answer say nothing of this line? */
static bool nothing_said_of(const fw_plan *plan, int line) {
    for (size_t i = 0; i < plan->diags.count; i++)
        if (plan->diags.item[i].place.line == line &&
            fw_text_same(plan->diags.item[i].place.file, plan->source_file))
            return false;
    for (int i = 0; plan->layout && i < plan->layout->nmissing; i++)
        if (plan->layout->missing[i].place.line == line) return false;
    return true;
}

/* would the text of the last answer, with what it held written into it, be that of the request? */
static fw_status is_written(const fw_plan *plan, fw_plan_live_request *r, json_t *held,
                            bool *same) {
    fw_device_text_change *change =
        fw_arena_array(r->arena, fw_device_text_change, json_object_size(held));
    const char *path;
    json_t *value;
    int n = 0;
    FW_NEED(change);
    json_object_foreach(held, path, value) change[n++] = (fw_device_text_change){
        .kind = FW_CHANGE_SET, .path = path, .value = json_string_value(value)};
    fw_diags silent = fw_diags_new(r->arena);
    fw_text text = fw_text_new(r->arena);
    fw_status status = fw_device_edit(r->arena, plan->source_file, plan->source,
                                      plan->source_length, change, n, &silent, &text);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    *same = status == FW_OK && text.length == r->length &&
            memcmp(text.data, r->text, r->length) == 0 &&
            but_for_numbers(plan->source, r->text, nothing_said_of, plan);
    return FW_OK;
}

/* *done false: nothing was written */
static fw_status answer_held(fw_plan_live *live, fw_plan_live_request *r, bool rates, fw_text *out,
                             bool *done) {
    json_t *held = live->shown.held;
    live->shown.held = NULL; /* whatever becomes of it */
    if (!held) return FW_OK;
    fw_design *d = live->shown.kept.design;
    const fw_device *device = NULL;
    bool same = false;
    fw_status status = FW_OK;
    if (json_object_size(r->set) == 0 && rates == live->shown.rates &&
        alike(live->shown.options, r->options) && alike(live->shown.lab, r->lab))
        status = is_written(d->plan, r, held, &same);
    json_decref(held);
    if (status == FW_OK && same) status = fw_plan_same_packs(d->plan, &same);
    if (status != FW_OK || !same) return status;
    fw_plan other = *d->plan;
    other.arena = r->arena;
    other.diags = fw_diags_new(r->arena);
    other.source = r->text, other.source_length = r->length;
    clock_t start = clock();
    status = fw_plan_device_again(&other, r->arena, NULL, 0, &other.diags, &device);
    if (status != FW_OK) return fw_plan_is_final(status) ? status : FW_OK;
    d->read_s = (double)(clock() - start) / CLOCKS_PER_SEC;
    *done = true;
    return (fw_status)fw_plan_design_run(d, document, &(work){device, FW_OK, rates, out});
}

/* ---- a request ---- */

static void hold(fw_plan_live *live, const fw_plan_live_request *r, bool rates) {
    const fw_design *d = live->shown.kept.design;
    if (json_object_size(r->set) == 0 || !(d->done & FW_DONE_JUDGED)) return;
    live->shown.held = json_incref(r->set);
    live->shown.rates = rates;
}

/* the design of this request: the one that was shown last, as far as it is the same, else one of its own */
static fw_status read_shown(fw_plan_live *live, fw_plan_live_request *request, fw_design **design,
                            int *read) {
    bool taken;
    *read = FW_STATUS_OK;
    FW_TRY(take_shown(live, request, &taken));
    *design = live->shown.kept.design;
    if (taken) return FW_OK;
    fw_plan_live_shown_free(live);
    FW_TRY(fw_plan_live_design(live, request, design));
    *read = fw_design_read_memory(*design, "device.xml", request->text, request->length);
    if (*read == FW_STATUS_OK) keep_shown(live, request, *design);
    return FW_OK;
}

/* it stays where it can be taken again */
static void leave_shown(fw_plan_live *live, fw_design *design, fw_status status) {
    if (live->shown.kept.design != design)
        fw_design_free(design);
    else if ((status != FW_OK && status != FW_CANCELLED) ||
             fw_arena_peak(design->plan->arena) > KEPT_MOST)
        fw_plan_live_shown_free(live);
}

static fw_status preview(fw_plan_live *live, fw_plan_live_request *request, fw_text *out) {
    const json_t *rates = json_object_get(request->root, "rates");
    fw_design *design;
    int read;
    bool taken = false;
    if (rates && !json_is_null(rates) && !json_is_boolean(rates))
        return fw_plan_live_wrong(request, "true or false is needed for", "rates");
    FW_TRY(answer_held(live, request, json_is_true(rates), out, &taken));
    if (taken) return FW_OK;
    FW_TRY(read_shown(live, request, &design, &read));
    fw_status status = look(design, read, request, json_is_true(rates), out);
    leave_shown(live, design, status);
    if (status == FW_OK && live->shown.kept.design) hold(live, request, json_is_true(rates));
    return status;
}

/* ---- the picture alone ---- */

static fw_status compose_picture(fw_design *d, void *argument) {
    const work *w = argument;
    fw_plan *plan = d->plan;
    fw_report_preview in = {.status = w->device ? "ok" : "invalid",
                            .diags = &plan->diags,
                            .file = plan->source_file,
                            .device = w->device,
                            .read_s = d->read_s};
    fw_status status = w->status;
    if (status == FW_OK) {
        clock_t start = clock();
        shorten(plan);
        status = fw_plan_judge_shown(plan);
        in.judge_s = (double)(clock() - start) / CLOCKS_PER_SEC;
        if (hopeless((int)status)) return status;
    }
    if (status == FW_OK) {
        in.verdict = &plan->verdict;
        judged_motion(plan, &in);
        if (!in.mechanism) FW_TRY(mechanism_of(plan, false, &in.mechanism));
        in.layout = plan->layout;
    }
    if (w->device && !in.mechanism) in.status = "failed";
    return fw_report_picture_json(plan->arena, &in, w->out);
}

static fw_status picture(fw_plan_live *live, fw_plan_live_request *request, fw_text *out) {
    fw_design *design;
    int read;
    json_decref(live->shown.held); /* the design that answered it becomes another one */
    live->shown.held = NULL;
    FW_TRY(read_shown(live, request, &design, &read));
    fw_status status = (fw_status)read;
    if (read == FW_STATUS_USAGE && design->wrong_option)
        status = fw_plan_live_wrong(request, design->wrong_option, NULL);
    else if (!hopeless(read)) {
        const fw_device *device = read == FW_STATUS_OK ? design->plan->device : NULL;
        status = (fw_status)fw_plan_design_run(design, compose_picture,
                                               &(work){device, status, false, out});
    }
    leave_shown(live, design, status);
    return status;
}

fw_plan_live_answer fw_plan_live_picture(fw_plan_live *live, const char *request, size_t n) {
    static const char *const keys[] = {"text", "set", "options", "lab", NULL};
    return fw_plan_live_call(live, request, n, keys, picture);
}

fw_plan_live_answer fw_plan_live_preview(fw_plan_live *live, const char *request, size_t n) {
    static const char *const keys[] = {"text", "set", "options", "lab", "rates", NULL};
    return fw_plan_live_call(live, request, n, keys, preview);
}
