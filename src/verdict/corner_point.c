/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device at a point of the ranges of a flow: built, judged as closely as its decision needs,
   and what of it is kept. Theory: docs/theory/as-fabricated.md. */
#include "verdict/compare.h"
#include "verdict/corners.h"
#include <math.h>
#include <string.h>

const char *fw_made_value(fw_arena *arena, const fw_made_input *input, double x) {
    fw_quantity q = input->q;
    char text[32];
    q.value = x;
    fw_number_text(text, sizeof text, fw_quantity_in_unit(&q), 4);
    bool unit = q.unit && strcmp(q.unit, "1") != 0;
    return fw_arena_printf(arena, "%s%s%s", text, unit ? " " : "", unit ? q.unit : "");
}

static fw_status describe(fw_search *s, const double *x, const char **what) {
    fw_text text = fw_text_new(s->arena);
    for (int i = 0; i < s->v->ninput; i++) {
        const fw_made_input *in = &s->v->input[i];
        if (x[i] == in->nominal) continue;
        const char *value = fw_made_value(s->arena, in, x[i]);
        FW_NEED(value);
        fw_text_printf(&text, "%s%s %s", text.length ? ", " : "", in->name, value);
    }
    if (text.length == 0) fw_text_add(&text, "nominal");
    FW_TRY(fw_text_end(&text));
    *what = text.data;
    return FW_OK;
}

/* rows of one run: utilisation of each hinge in each scene, and how near pull-in is */
static void take_rows(const fw_search *s, const fw_variant_verdict *now, double *ln) {
    int scenes = s->device->nscene, hinges = s->v->nhinge * (scenes + 1);
    for (int r = 0; r < hinges; r++)
        ln[r] = now->used[r] > 1e-9 ? log(now->used[r]) : (double)NAN;
    for (int i = 0; i < scenes; i++) {
        const fw_pull_in *p = now->pull_in[i];
        bool near = p && p->kind != FW_PULL_IN_NONE && p->margin > 0.0;
        ln[hinges + i] = near ? log(fw_pull_in_margin(p) / p->margin) : (double)NAN;
    }
}

/* the first reason beside the hinges */
static fw_status take_reason(fw_search *s, const fw_variant_verdict *now, fw_made_corner *corner) {
    const char *why = NULL;
    for (int i = 0; i < now->nreason && !why; i++) {
        if (now->reason[i].decision == FW_ACCEPT) continue;
        why = now->reason[i].text;
        corner->scene = now->reason[i].scene;
        corner->keep = now->reason[i].keep;
    }
    if (now->workspace.required && !now->workspace.reachable)
        why = "part of the required workspace is out of reach";
    if (why) FW_NEED(corner->why = fw_arena_strdup(s->arena, why));
    return FW_OK;
}

static const char *last_error(const fw_diags *diags) {
    for (size_t i = diags->count; i-- > 0;)
        if (diags->item[i].severity == FW_ERROR) return diags->item[i].message;
    return "it could not be run";
}

/* copies what stays: the run's own arena is given back */
static fw_status take(fw_search *s, const fw_variant_verdict *now, fw_made_corner *corner,
                      double *ln) {
    for (int k = 0; k < s->v->nhinge; k++) {
        corner->hinge[k] = now->hinge[k];
        corner->hinge[k].flow = s->v->variant->flow;
    }
    corner->decision = now->decision;
    FW_TRY(take_reason(s, now, corner));
    take_rows(s, now, ln);
    return FW_OK;
}

static double wanted(const fw_verdict_options *o) {
    return o->motion.accuracy > 0 ? o->motion.accuracy : 1e-3;
}

/* Options of the next look, where numbers may decide: what was asked for, then as much closer as
   seems to be needed, then as close as it gets. false: there is none. */
static bool look_closer(const fw_search *s, const fw_variant_verdict *now,
                        fw_verdict_options *options) {
    double asked = wanted(&s->options), had = wanted(options);
    bool own = s->options.motion.rtol == 0; /* else the accuracy says nothing of the numbers */
    fw_closer closer = fw_verdict_closer(now->hinge, now->nhinge);
    if (options->at_a_glance || closer != FW_CLOSER_NUMBERS) return false;
    if (options->motion.rtol == 0 && had <= fw_verdict_tightest) return false;
    bool coarse = own && had > asked;
    double next = fmin(0.1 * had, fw_verdict_enough(now->hinge, now->nhinge, had));
    *options = coarse ? s->options : fw_verdict_tighter(&s->options, closer);
    if (own && had == asked && next > 3 * fw_verdict_tightest) options->motion.accuracy = next;
    return true;
}

/* from coarse to as close as its decision needs: most points are far enough from the limit */
static fw_status judge_closely(const fw_search *s, fw_arena *scratch, const fw_made_device *device,
                               const fw_mechanism *m, fw_diags *diags, fw_variant_verdict *now) {
    const fw_motion *const *like = (const fw_motion *const *)s->v->motion;
    fw_verdict_options options = s->options;
    fw_motion_options *motion = &options.motion;
    if (motion->rtol == 0) motion->accuracy = fmax(motion->accuracy, fw_verdict_first_look);
    do {
        *now = (fw_variant_verdict){.variant = &device->variant, .like = like};
        FW_TRY(
            fw_verdict_variant(scratch, &device->device, device->drawn, m, &options, diags, now));
    } while (look_closer(s, now, &options));
    return FW_OK;
}

/* what the flow makes may be just what was drawn, and that has been judged */
static bool as_drawn(const fw_made *made) {
    return made->edge_m == 0.0 && made->flare_m == 0.0 && made->thickness_ratio == 1.0 &&
           made->youngs_ratio == 1.0;
}

static fw_status judge_point(fw_search *s, fw_arena *scratch, const double *x,
                             fw_made_corner *corner, double *ln) {
    fw_made made = fw_made_at(s->v->input, s->v->ninput, x);
    fw_made_device *device = fw_arena_one(scratch, fw_made_device);
    fw_diags diags = fw_diags_new(scratch);
    fw_variant_verdict now = {0};
    const fw_mechanism *m = NULL;
    FW_NEED(device);
    if (as_drawn(&made)) return take(s, s->v, corner, ln);
    FW_TRY(fw_made_build(scratch, s->device, s->layout, s->v->variant, &made, device));
    corner->decision = FW_REJECT;
    if (device->gone) {
        FW_NEED(corner->why = fw_arena_strdup(s->arena, device->gone));
        return FW_OK;
    }
    fw_status status =
        fw_mechanism_build(scratch, &device->device, device->drawn, &device->variant, &diags, &m);
    if (status == FW_OK) status = judge_closely(s, scratch, device, m, &diags, &now);
    if (status == FW_OK) return take(s, &now, corner, ln);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    corner->decision = FW_INCONCLUSIVE;
    FW_NEED(corner->why = fw_arena_strdup(s->arena, last_error(&diags)));
    return FW_OK;
}

static fw_status run_point(fw_search *s, const double *x, fw_made_corner *corner, double *ln) {
    size_t n = (size_t)s->v->ninput, h = (size_t)s->v->nhinge;
    double *kept;
    *corner = (fw_made_corner){0};
    for (int r = 0; r < s->nrow; r++)
        ln[r] = (double)NAN;
    FW_NEED(kept = fw_arena_array(s->arena, double, n));
    memcpy(kept, x, n * sizeof *kept);
    corner->x = kept;
    FW_NEED(corner->hinge = fw_arena_array(s->arena, fw_hinge_verdict, h));
    FW_TRY(describe(s, x, &corner->what));
    for (size_t k = 0; k < h; k++)
        corner->hinge[k] = (fw_hinge_verdict){
            .id = s->v->hinge[k].id, .joint = s->v->hinge[k].joint, .decision = FW_INCONCLUSIVE};
    fw_arena *scratch = fw_arena_part(s->arena, 0); /* given back at once: there may be many */
    FW_NEED(scratch);
    fw_status status = judge_point(s, scratch, x, corner, ln);
    fw_arena_free(scratch);
    return status;
}

static bool is_known(const fw_search *s, const double *x) {
    return s->known && memcmp(s->known->x, x, (size_t)s->v->ninput * sizeof *x) == 0;
}

fw_status fw_search_run(fw_search *s, const double *x, unsigned bits) {
    fw_made_verdict *made = s->made;
    int point = made->ncorner;
    if (point >= FW_MOST_POINTS) return FW_OK;
    double *ln = s->ln + (size_t)point * (size_t)s->nrow;
    if (is_known(s, x)) {
        made->corner[point] = *s->known;
        memcpy(ln, s->known_ln, (size_t)s->nrow * sizeof *ln);
    } else {
        FW_TRY(run_point(s, x, &made->corner[point], ln));
    }
    s->bits[point] = bits;
    made->ncorner++;
    return FW_OK;
}

fw_status fw_search_accepts(const fw_search *s, const double *x, bool *accepted) {
    fw_search quiet = *s;
    fw_made_corner corner;
    double *ln;
    FW_NEED(ln = fw_arena_array(s->arena, double, (size_t)s->nrow));
    FW_TRY(run_point(&quiet, x, &corner, ln));
    *accepted = corner.decision == FW_ACCEPT;
    return FW_OK;
}
