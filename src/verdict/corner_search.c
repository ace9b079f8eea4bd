/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device at a point of the ranges of a flow: built, judged as closely as its decision needs,
   and what of it is kept. Called a corner here, as in the tables of results, even where only one
   input is off its nominal value. Theory: docs/theory/as-fabricated.md. */
#include "verdict/body.h"
#include "verdict/verdict_fabrication.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* the inputs that are off their nominal values: "printed edge -0.15 um, thickness 49 um" */
static fw_status describe(const fw_verdict_search *s, const double *x, const char **what) {
    fw_text text = fw_text_new(s->arena);
    for (int i = 0; i < s->v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &s->v->input[i];
        if (x[i] == in->nominal) continue;
        const char *value = fw_verdict_search_value_text(s->arena, in, x[i]);
        FW_NEED(value);
        fw_text_printf(&text, "%s%s %s", text.length ? ", " : "", in->name, value);
    }
    for (int j = 0, n = 0; s->sign && j < s->device->nrevolute; j++)
        if (s->sign[j] < 0)
            fw_text_printf(&text, "%s%s", n++ ? " " : ", narrower: ", s->device->revolute[j].id);
    if (text.length == 0) fw_text_add(&text, "nominal");
    FW_TRY(fw_text_end(&text));
    *what = text.data;
    return FW_OK;
}

/* ---- checks ---- */

/* Only where a pair has lost much of its distance may a corner take the rest: loads move a device
   further by half where its flexures are a sixth thinner. Below that a corner only proves that enough
   is left. */
bool fw_verdict_search_clearances_count(const fw_verdict_variant_verdict *v, bool by_nearest) {
    for (int i = 0; i < v->nclearance; i++) {
        const fw_verdict_clearance *c = &v->clearance[i];
        const double used =
            by_nearest ? fw_verdict_search_used_nearest(c) : fw_verdict_search_used(c, true);
        if (used > fw_verdict_clearance_counts) return true;
    }
    return false;
}

/* Logarithms of all checks of one run, in the order of fw_verdict_search: the utilisation of each
   hinge in each scene and in the workspace, then for each scene the pull-in margin that is needed
   over the one that there is (by value: 1 is needed), the utilisation of each requirement, and the share of each clearance
   that is used, and what tips and strains it across the plane, which are 1 at their limits. Logarithms, because the
   estimates at corners are of first order in them. NaN: there is no such check, or the hinge uses less than 1e-9 of its
   limit, which no corner brings near it. */
static void take_checks(const fw_verdict_search *s, const fw_verdict_variant_verdict *now,
                        double *ln) {
    int scenes = s->device->nscene, hinges = s->v->nhinge * (scenes + 1);
    for (int i = 0; i < s->v->nrequirement; i++) {
        double used = now->requirement[i].utilisation;
        ln[hinges + scenes + i] = used > 1e-9 ? log(used) : (double)NAN;
    }
    double *clearance = ln + hinges + scenes + s->v->nrequirement;
    for (int i = 0; s->clearances && i < now->nclearance; i++) {
        const fw_verdict_clearance *c = &now->clearance[i];
        int at = c->box == FW_NONE ? c->scene_index : scenes + c->box;
        if (c->box == FW_NONE || s->nearest)
            clearance[at] = log(fw_verdict_search_used(c, s->nearest));
    }
    fw_verdict_across_checks(now, scenes, clearance + scenes + s->device->nworkspace);
    for (int r = 0; r < hinges; r++)
        ln[r] = now->used[r] > 1e-9 ? log(now->used[r]) : (double)NAN;
    for (int i = 0; i < scenes; i++) {
        const fw_statics_pull_in *p = now->pull_in[i];
        bool near = p && p->kind != FW_PULL_IN_NONE && p->margin > 0.0;
        const double needed = near && !s->by_value ? fw_statics_pull_in_margin(p) : 1;
        ln[hinges + i] = near ? log(needed / p->margin) : (double)NAN;
    }
}

/* What leaves open where a device is by value, and no band does: an equilibrium that was not found or is left, strains that
   nobody knows, a run that ended before its scene did. */
static bool leaves_open(const fw_verdict_reason *r) {
    static const int number[] = {242, 249, 259, 597};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++)
        if (r->number == number[i] && r->decision != FW_ACCEPT && !r->met) return true;
    return false;
}

/* a bound of what is drawn has no share of it, and its value is beyond it or not */
static void required_by_value(const fw_verdict_requirement *r, fw_verdict_by_value *b) {
    if (!isnan(r->utilisation) || r->decision == FW_ACCEPT) return;
    if (isnan(r->value))
        b->open = true;
    else if (r->value < r->min || r->value > r->max) /* NaN: no bound */
        b->fails = true, b->sure = b->sure || r->decision == FW_REJECT;
}

/* A check (ln; NaN is passed) and its band, ratios to it. Of an end that nobody knows (NaN) the share itself still leads to
   its limit, from as far as anything is told. */
static void reads(double ln, double up, double down, fw_verdict_by_value *b) {
    const double most = 6.9; /* a thousand times */
    b->high = fmax(b->high, ln + fmin(up >= 1 ? log(up) : isnan(up) ? most : 0, most));
    b->low = fmax(b->low, ln - fmin(down >= 1 ? log(down) : isnan(down) ? most : 0, most));
}

/* a scene that uses more by value than the one that governs by its band is as far off */
static void hinge_reads(const fw_verdict_hinge_verdict *h, const double *ln, int n,
                        fw_verdict_by_value *b) {
    double most = -HUGE_VAL;
    for (int r = 0; r < n; r++)
        most = fmax(most, ln[r]);
    reads(most, h->utilisation_high / exp(most), h->utilisation / h->utilisation_low, b);
    b->open = b->open || (h->scene && h->touches);
}

static void pull_in_reads(const fw_statics_pull_in *p, double ln, fw_verdict_by_value *b) {
    const double less = p && p->fringe_counted ? fmin(p->fringe, 0.9) : 0;
    if (isnan(ln)) return;
    reads(ln, fw_statics_pull_in_margin(p), sqrt((1 + p->stiffness_error) / (1 - less)), b);
}

/* What a die is by value beside its shares, and by either end of the band of each of its checks (ln). A pull-in is as far off
   as what is left out of its force and what its flexures are off by: V^2 is in proportion to their stiffness. The way of a
   motion is as far off as the motion. That nothing tips is a bound, which says of no die that it does. Decision 236.
   Test: test_made_at.c */
static void take_by_value(const fw_verdict_search *s, const fw_verdict_variant_verdict *now,
                          const double *ln, fw_verdict_by_value *b) {
    const int scenes = s->device->nscene;
    const double *pull = ln + now->nhinge * (scenes + 1), *required = pull + scenes;
    const double *clearance = required + now->nrequirement,
                 *across = clearance + scenes + s->device->nworkspace;
    b->low = b->high = -HUGE_VAL;
    for (int i = 0; i < now->nreason; i++) {
        b->fails = b->fails || now->reason[i].met, b->sure = b->sure || now->reason[i].met;
        b->open = b->open || leaves_open(&now->reason[i]);
    }
    for (int k = 0; k < now->nhinge; k++)
        hinge_reads(&now->hinge[k], ln + k * (scenes + 1), scenes + 1, b);
    for (int i = 0; i < scenes; i++)
        pull_in_reads(now->pull_in[i], pull[i], b);
    for (int i = 0; i < now->nrequirement; i++) {
        const fw_verdict_requirement *r = &now->requirement[i];
        const double used = r->utilisation;
        required_by_value(r, b);
        reads(required[i], r->utilisation_high / used, used / r->utilisation_low, b);
    }
    for (int i = 0; s->clearances && i < now->nclearance; i++) {
        const fw_verdict_clearance *c = &now->clearance[i];
        const double off = 1 + (c->high_m - c->m) / c->least.moved_m;
        reads(clearance[c->box == FW_NONE ? c->scene_index : scenes + c->box], off, off, b);
    }
    const fw_verdict_out_of_plane *o = now->out_of_plane;
    for (int i = 0; o && i < o->nscene; i++) {
        const fw_verdict_across *a = &o->scene[i];
        reads(across[a->scene_index], 1 + a->tips_error, (double)NAN, b);
        reads(across[scenes + a->scene_index], 1, a->strained / a->strained_sure, b);
    }
}

static bool hinge_decides(const fw_verdict_variant_verdict *now) {
    for (int k = 0; k < now->nhinge; k++)
        if (now->hinge[k].decision == now->decision) return true;
    return false;
}

/* The first reason beside the hinges of those that decide: what is not known is no reason of a rejection, be it by another
   reason or by a hinge, which has none. The workspace goes before all others */
static fw_status take_reason(const fw_verdict_search *s, const fw_verdict_variant_verdict *now,
                             fw_verdict_fabricated_corner *corner) {
    const char *why = NULL;
    fw_verdict_decision worst = FW_ACCEPT;
    for (int i = 0; i < now->nreason; i++)
        if (fw_verdict_is_worse(now->reason[i].decision, worst)) worst = now->reason[i].decision;
    const bool by_hinge = fw_verdict_is_worse(now->decision, worst) && hinge_decides(now);
    for (int i = 0; i < now->nreason && !why && !by_hinge; i++) {
        if (worst == FW_ACCEPT || now->reason[i].decision != worst) continue;
        why = now->reason[i].text;
        corner->number = now->reason[i].number;
        corner->scene = now->reason[i].scene;
        corner->keep = now->reason[i].keep;
        corner->not_by_loads = now->reason[i].not_by_loads;
        corner->not_by_width = now->reason[i].not_by_width;
    }
    if (now->workspace.required && !now->workspace.reachable && now->workspace.beyond.certain)
        why = "part of the required workspace is out of reach";
    if (why) FW_NEED(corner->why = fw_arena_strdup(s->arena, why));
    return FW_OK;
}

static const char *last_error(const fw_diags *diags) {
    for (size_t i = diags->count; i-- > 0;)
        if (diags->item[i].severity == FW_ERROR) return diags->item[i].message;
    return "it could not be run";
}

static bool refinement_may_decide(const fw_verdict_variant_verdict *now) {
    fw_verdict_refinement refinement = fw_verdict_refinement_of(now->hinge, now->nhinge);
    if (refinement == FW_REFINE_NOTHING)
        refinement = fw_verdict_requirements_refinement(now->requirement, now->nrequirement);
    if (fw_verdict_in_vain(now, 1)) return false;
    return refinement == FW_REFINE_NUMBERS || fw_verdict_across_open(now);
}

/* a hinge's verdict with everything that it points to */
static fw_status take_hinge(const fw_verdict_search *s, const fw_verdict_hinge_verdict *now,
                            fw_verdict_hinge_verdict *kept) {
    *kept = *now;
    kept->flow = s->v->variant->flow;
    if (now->limit) {
        fw_flexure_limit *limit = fw_arena_one(s->arena, fw_flexure_limit);
        FW_NEED(limit);
        *limit = *now->limit;
        kept->limit = limit;
    }
    if (now->actuation) FW_NEED(kept->actuation = fw_arena_strdup(s->arena, now->actuation));
    return FW_OK;
}

static fw_status take_requirements(const fw_verdict_search *s,
                                   const fw_verdict_variant_verdict *now,
                                   fw_verdict_fabricated_corner *corner) {
    size_t n = (size_t)s->v->nrequirement;
    if (n == 0) return FW_OK;
    FW_NEED(corner->requirement =
                fw_arena_grow(s->arena, now->requirement, n, n, sizeof *corner->requirement));
    for (size_t i = 0; i < n; i++) { /* names are those of the drawn device */
        fw_verdict_requirement *r = &corner->requirement[i];
        const fw_verdict_requirement *drawn = &s->v->requirement[i];
        r->scene = drawn->scene, r->flow = drawn->flow, r->probe = drawn->probe;
        if (r->why) FW_NEED(r->why = fw_arena_strdup(s->arena, r->why));
    }
    return FW_OK;
}

/* of scenes, the one of which the least is surely left; only where clearances count it was looked for (variant.c) */
static fw_status take_clearance(const fw_verdict_search *s, const fw_verdict_variant_verdict *now,
                                fw_verdict_fabricated_corner *corner) {
    const fw_verdict_clearance *least = NULL;
    fw_verdict_clearance *kept;
    for (int i = 0; s->clearances && !s->options.decision_only && i < now->nclearance; i++) {
        const fw_verdict_clearance *c = &now->clearance[i];
        if (c->box == FW_NONE && (!least || c->low_m < least->low_m)) least = c;
    }
    if (!least || !least->least.at.a || !least->least.at.b) return FW_OK;
    FW_NEED(corner->clearance = kept = fw_arena_one(s->arena, fw_verdict_clearance));
    *kept = *least;
    kept->way = (fw_clearance_way){.share = 0};
    kept->flow = s->v->variant->flow;
    FW_NEED(kept->scene = fw_arena_strdup(s->arena, least->scene));
    FW_NEED(kept->least.at.a = fw_arena_strdup(s->arena, least->least.at.a));
    FW_NEED(kept->least.at.b = fw_arena_strdup(s->arena, least->least.at.b));
    return FW_OK;
}

/* surface tension of a liquid that wets and that it surely bears; NaN: not judged. Formula and test: verdict_stiction.c */
double fw_verdict_dries(const fw_verdict_variant_verdict *v) {
    const fw_verdict_stiction *s = v->stiction;
    if (!s || s->why || (!s->below.known && !s->beside.known)) return (double)NAN;
    return fmin(s->below.tension_N_per_m[0], s->beside.tension_N_per_m[0]);
}

/* copies what stays: the run's own arena is given back */
static fw_status take(const fw_verdict_search *s, const fw_verdict_variant_verdict *now,
                      fw_verdict_fabricated_corner *corner, double *ln) {
    for (int k = 0; k < s->v->nhinge; k++)
        FW_TRY(take_hinge(s, &now->hinge[k], &corner->hinge[k]));
    corner->decision = now->decision;
    corner->undecided = now->decision != FW_ACCEPT && refinement_may_decide(now);
    corner->dries_N_per_m = fw_verdict_dries(now);
    FW_TRY(take_requirements(s, now, corner));
    FW_TRY(fw_verdict_shaken_keep(s->arena, now, &corner->shaken));
    FW_TRY(take_reason(s, now, corner));
    FW_TRY(fw_verdict_stators_keep(s->arena, now, corner));
    FW_TRY(take_clearance(s, now, corner));
    take_checks(s, now, ln);
    if (s->by_value) take_by_value(s, now, ln, s->by_value);
    return FW_OK;
}

/* accuracy asked for; 1e-3 is that of a request that names none */
static double wanted(const fw_verdict_options *o) {
    return o->motion.accuracy > 0 ? o->motion.accuracy : 1e-3;
}

/* What the motions of a look left out, relative: it does not go with the accuracy as long as it is left out. */
static double left_out(const fw_verdict_search *s, const fw_verdict_variant_verdict *now) {
    double most = 0;
    for (int i = 0; now->motion && i < s->device->nscene; i++)
        if (now->motion[i]) most = fmax(most, now->motion[i]->ledger.left_out);
    return most;
}

/* Of a trial nobody sees more than the decision: after the first look the accuracy that its bands seem to need, where that is
   known and less than what was asked for, with half of what was left out at most. 0: it is not. */
static double enough_for_trial(const fw_verdict_search *s, const fw_verdict_variant_verdict *now,
                               double had) {
    const double open = 0.9; /* of `had`: nearer to it no band has said anything */
    const double enough =
        fmin(fw_verdict_enough(now->hinge, now->nhinge, had),
             fw_verdict_requirements_enough(now->requirement, now->nrequirement, had));
    const double out = left_out(s, now);
    if (!s->options.coarse_first || had < fw_verdict_first_accuracy || !(enough < open * had))
        return 0;
    return out > 0 ? fmin(enough, 0.5 * out) : enough;
}

/* Options of the next look at a point that tighter numbers may still decide: first the accuracy
   that was asked for, then at least ten times tighter and as tight as the bands seem to need, then
   the tightest there is, to which a step that would end within 3 times of it goes at once. What
   needs a better model of its hinges stays undecided here. false: no look is left. */
static bool refine(const fw_verdict_search *s, const fw_verdict_variant_verdict *now,
                   fw_verdict_options *options) {
    double asked = wanted(&s->options), had = wanted(options);
    /* else the caller has set the tolerances of the integrator, and no accuracy goes with them */
    bool steered = s->options.motion.rtol == 0;
    if (options->at_a_glance || !refinement_may_decide(now)) return false;
    if (options->motion.rtol == 0 && had <= fw_verdict_tightest) return false;
    bool coarse = steered && had > asked;
    double next = fmin(0.1 * had, fw_verdict_enough(now->hinge, now->nhinge, had));
    next = fmin(next, fw_verdict_requirements_enough(now->requirement, now->nrequirement, had));
    *options = coarse ? s->options : fw_verdict_tighter(&s->options, FW_REFINE_NUMBERS);
    if (steered && had == asked && next > 3 * fw_verdict_tightest) options->motion.accuracy = next;
    if (coarse) options->motion.accuracy = fmax(asked, enough_for_trial(s, now, had));
    return true;
}

/* from coarse to as close as its decision needs: most points are far enough from the limit */
static fw_status judge_closely(const fw_verdict_search *s, fw_arena *scratch,
                               const fw_verdict_fabricated_device *device, const fw_mechanism *m,
                               fw_diags *diags, fw_verdict_variant_verdict *now) {
    const fw_dynamics_motion *const *like = (const fw_dynamics_motion *const *)s->v->motion;
    const double edge_m = device->drawn ? device->drawn->edge_m : 0;
    const fw_verdict_arm *arm;
    FW_TRY(fw_verdict_arms_made(scratch, s->v->mechanism, s->v->arm, edge_m, &arm));
    fw_verdict_options options = s->options;
    fw_dynamics_motion_options *motion = &options.motion;
    options.values = s->nearest;
    options.ways = s->clearances;
    if (motion->rtol == 0) motion->accuracy = fmax(motion->accuracy, fw_verdict_first_accuracy);
    int looks = 0;
    do {
        *now = (fw_verdict_variant_verdict){.variant = &device->variant,
                                            .like = like,
                                            .corner = true,
                                            .tipping = s->tipping,
                                            .bends_m = s->v->bends_m,
                                            .arm = arm,
                                            .solid = s->v->solid};
        FW_TRY(
            fw_verdict_variant(scratch, &device->device, device->drawn, m, &options, diags, now));
    } while (++looks != s->most_looks && refine(s, now, &options));
    return FW_OK;
}

/* What the flow makes may be just what was drawn: that has been judged, and is not run again. */
static bool as_drawn(const fw_verdict_fabrication *fabricated) {
    return !fabricated->sign && fabricated->edge_m == 0.0 && fabricated->flare_m == 0.0 &&
           fabricated->thickness_ratio == 1.0 && fabricated->youngs_ratio == 1.0 &&
           fabricated->expansion_per_K == 0.0 && fabricated->substrate_per_K == 0.0;
}

/* A flexure that is cut through rejects the point; a device that cannot be built or run leaves it
   inconclusive, with the last error as the reason. */
static fw_status judge_point(const fw_verdict_search *s, fw_arena *scratch, const double *x,
                             fw_verdict_fabricated_corner *corner, double *ln) {
    fw_verdict_fabrication fabricated = fw_verdict_fabrication_at(s->v->input, s->v->ninput, x);
    fw_verdict_fabricated_device *device = fw_arena_one(scratch, fw_verdict_fabricated_device);
    fw_diags diags = fw_diags_new(scratch);
    fw_verdict_variant_verdict now = {0};
    const fw_mechanism *m = NULL;
    FW_NEED(device);
    fabricated.sign = fabricated.local_m != 0.0 ? s->sign : NULL;
    if (as_drawn(&fabricated)) return take(s, s->v, corner, ln);
    FW_TRY(fw_verdict_fabrication_build(scratch, s->device, s->layout, s->v->variant, &fabricated,
                                        device));
    corner->decision = FW_REJECT;
    if (device->gone) {
        FW_NEED(corner->why = fw_arena_strdup(s->arena, device->gone));
        return FW_OK;
    }
    FW_TRY(fw_verdict_body_cut(s->arena, s->v->mechanism, s->v->arm, fabricated.edge_m,
                               fabricated.flare_m, &corner->why));
    if (corner->why) {
        corner->decision = FW_INCONCLUSIVE;
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

static bool is_same_device(const fw_verdict_search *s, const double *x, const signed char *sign,
                           const fw_verdict_ahead *a) {
    if (memcmp(a->x, x, (size_t)s->v->ninput * sizeof *x) != 0 || a->most_looks != s->most_looks)
        return false;
    const size_t joints = (size_t)s->device->nrevolute;
    return a->sign && sign ? memcmp(a->sign, sign, joints) == 0 : a->sign == sign;
}

static const fw_verdict_ahead *find_ahead(const fw_verdict_search *s, const double *x,
                                          const signed char *sign) {
    for (size_t i = 0; i < s->nahead; i++)
        if (is_same_device(s, x, sign, &s->ahead[i])) return &s->ahead[i];
    return NULL;
}

fw_status fw_verdict_search_point(const fw_verdict_search *s, const double *x,
                                  fw_verdict_fabricated_corner *corner, double *ln) {
    size_t n = (size_t)s->v->ninput, h = (size_t)s->v->nhinge;
    const fw_verdict_ahead *known = find_ahead(s, x, s->sign);
    double *kept;
    if (known) {
        *corner = known->corner;
        corner->sign = s->sign;
        memcpy(ln, known->ln, (size_t)s->ncheck * sizeof *ln);
        s->told->done++;
        return FW_OK;
    }
    *corner = (fw_verdict_fabricated_corner){.dries_N_per_m = (double)NAN};
    for (int r = 0; r < s->ncheck; r++)
        ln[r] = (double)NAN;
    FW_NEED(kept = fw_arena_array(s->arena, double, n));
    memcpy(kept, x, n * sizeof *kept);
    corner->x = kept;
    corner->sign = s->sign;
    FW_NEED(corner->hinge = fw_arena_array(s->arena, fw_verdict_hinge_verdict, h));
    FW_TRY(describe(s, x, &corner->what));
    for (size_t k = 0; k < h; k++)
        corner->hinge[k] = (fw_verdict_hinge_verdict){
            .id = s->v->hinge[k].id, .joint = s->v->hinge[k].joint, .decision = FW_INCONCLUSIVE};
    fw_arena *scratch = fw_arena_part(s->arena, 0); /* given back at once: there may be many */
    FW_NEED(scratch);
    fw_arena_tell_of(scratch, s->told);
    fw_arena_tell(scratch, "", 0, 0, "");
    s->told->done++;
    fw_status status = judge_point(s, scratch, x, corner, ln);
    fw_arena_free(scratch);
    return status;
}

/* ---- points ---- */

int fw_verdict_checks(const fw_device *device, const fw_verdict_variant_verdict *v) {
    return v->nhinge * (device->nscene + 1) + 4 * device->nscene + v->nrequirement +
           device->nworkspace;
}

bool fw_verdict_search_has_range(const fw_verdict_fabrication_input *in) {
    return in->local == 0.0 &&
           in->high >
               in->low; /* one that is known exactly has one value, and no second end to run */
}

unsigned fw_verdict_search_without_range(const fw_verdict_variant_verdict *v) {
    unsigned bits = 0; /* corners have them clear */
    for (int i = 0; i < v->ninput; i++)
        bits |= fw_verdict_search_has_range(&v->input[i]) ? 0u : 1u << i;
    return bits;
}

void fw_verdict_search_corner_point(const fw_verdict_search *s, unsigned bits, double *x) {
    for (int i = 0; i < s->v->ninput; i++)
        x[i] = !fw_verdict_search_has_range(&s->v->input[i]) ? s->v->input[i].nominal
               : bits >> i & 1u                              ? s->v->input[i].high
                                                             : s->v->input[i].low;
}

int fw_verdict_search_find(const fw_verdict_search *s, unsigned bits) {
    for (int p = 0; p < s->fabricated->ncorner; p++)
        if (s->bits[p] == bits) return p;
    return FW_NONE;
}

/* bit for bit: where two points make one device, both were made from the same ends of ranges */
static bool is_same(const fw_verdict_fabrication *a, const fw_verdict_fabrication *b) {
    return a->edge_m == b->edge_m && a->flare_m == b->flare_m &&
           a->thickness_ratio == b->thickness_ratio && a->youngs_ratio == b->youngs_ratio &&
           a->expansion_per_K == b->expansion_per_K && a->substrate_per_K == b->substrate_per_K &&
           a->local_m == b->local_m;
}

/* a device that was run before this search, or in it: of one range the end of a slope is a corner */
static bool known_device(const fw_verdict_search *s, const double *x, fw_verdict_known *out) {
    const fw_verdict_variant_verdict *v = s->v;
    const fw_verdict_fabrication made = fw_verdict_fabrication_at(v->input, v->ninput, x);
    for (int i = 0; i < s->nknown; i++) {
        *out = s->known[i];
        if (is_same(&out->made, &made)) return true;
    }
    for (int i = 0; i < s->fabricated->ncorner; i++) {
        const fw_verdict_fabricated_corner *c = &s->fabricated->corner[i];
        *out = (fw_verdict_known){fw_verdict_fabrication_at(v->input, v->ninput, c->x), c,
                                  s->ln + (size_t)i * (size_t)s->ncheck};
        if (is_same(&out->made, &made)) return true;
    }
    return false;
}

/* ---- several points at once ---- */

/* point i of `context`, a search whose next points these are, by a search of its own; behind it the corner is complete */
static fw_status run_ahead(void *context, size_t i, fw_arena *arena) {
    const fw_verdict_search *s = context;
    fw_verdict_ahead *a = &s->ahead[i];
    fw_verdict_search own = *s;
    fw_progress_whole told = *s->told;
    own.arena = arena, own.told = &told, own.sign = a->sign, own.nahead = 0;
    own.options.kept = NULL, own.options.motion.tapes = NULL; /* which one thread may use */
    FW_NEED(a->ln = fw_arena_array(arena, double, (size_t)s->ncheck));
    return fw_verdict_search_point(&own, a->x, &a->corner, a->ln);
}

fw_status fw_verdict_search_ahead(fw_verdict_search *s, const double *x,
                                  const signed char *const *sign, size_t n) {
    const size_t width = (size_t)s->v->ninput;
    s->nahead = 0;
    if (n < 2 || !fw_arena_helped(s->arena)) return FW_OK;
    FW_NEED(s->ahead = fw_arena_array(s->arena, fw_verdict_ahead, n));
    size_t most = 0;
    for (size_t i = 0; i < n; i++) {
        const signed char *as = sign ? sign[i] : s->sign;
        const double *at = x + i * width;
        fw_verdict_known known;
        s->nahead = most; /* those before it */
        if (find_ahead(s, at, as) || (!as && known_device(s, at, &known))) continue;
        s->ahead[most++] = (fw_verdict_ahead){.x = at, .sign = as, .most_looks = s->most_looks};
    }
    s->nahead = 0;
    FW_TRY(fw_arena_each(s->arena, most, run_ahead, s));
    s->nahead = most;
    return FW_OK;
}

/* what is known of a device, as this search names it */
static fw_status take_known(const fw_verdict_search *s, const fw_verdict_known *known,
                            const double *x, fw_verdict_fabricated_corner *corner, double *ln) {
    size_t n = (size_t)s->v->ninput;
    double *kept = fw_arena_array(s->arena, double, n);
    FW_NEED(kept);
    memcpy(kept, x, n * sizeof *kept);
    *corner = *known->corner;
    corner->x = kept;
    FW_TRY(describe(s, x, &corner->what));
    memcpy(ln, known->ln, (size_t)s->ncheck * sizeof *ln);
    return FW_OK;
}

fw_status fw_verdict_search_run(fw_verdict_search *s, const double *x, unsigned bits) {
    fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    int point = fabricated->ncorner;
    if (point >= FW_MOST_POINTS) return FW_OK; /* never: there is room for all that is ever run */
    double *ln = s->ln + (size_t)point * (size_t)s->ncheck;
    fw_verdict_known known;
    if (!s->sign && known_device(s, x, &known)) {
        FW_TRY(take_known(s, &known, x, &fabricated->corner[point], ln));
        s->told->done++;
    } else {
        FW_TRY(fw_verdict_search_point(s, x, &fabricated->corner[point], ln));
        s->judged++;
    }
    s->bits[point] = bits;
    fabricated->ncorner++;
    return FW_OK;
}

/* the search that follows may come to the corners that were run, and does not run them again */
static fw_status know_all(fw_verdict_search *s) {
    const size_t n = (size_t)s->fabricated->ncorner, m = (size_t)s->ncheck;
    fw_verdict_fabricated_corner *corner;
    fw_verdict_known *known;
    double *ln;
    FW_NEED(corner = fw_arena_array(s->arena, fw_verdict_fabricated_corner, n));
    FW_NEED(known = fw_arena_array(s->arena, fw_verdict_known, n));
    FW_NEED(ln = fw_arena_array(s->arena, double, n *m));
    memcpy(ln, s->ln, n * m * sizeof *ln);
    memcpy(corner, s->fabricated->corner, n * sizeof *corner);
    for (size_t i = 0; i < n; i++)
        known[i] =
            (fw_verdict_known){fw_verdict_fabrication_at(s->v->input, s->v->ninput, corner[i].x),
                               &corner[i], ln + i * m};
    s->known = known, s->nknown = (int)n;
    s->fabricated->ncorner = 0;
    return FW_OK;
}

/* a trial's suspects decide alone where one is not accepted, or nothing else is asked for; all have values where asked */
fw_status fw_verdict_search_suspects(fw_verdict_search *s, bool *decided) {
    const fw_verdict_variant_verdict *v = s->v;
    const bool alone = s->options.corners == FW_CORNERS_SUSPECT;
    *decided = false;
    if (v->nsuspect == 0 || !(alone || s->options.corners == FW_CORNERS_FIRST)) return FW_OK;
    if (s->options.values)
        FW_TRY(fw_verdict_search_ahead(s, v->suspect, NULL, (size_t)v->nsuspect));
    for (int i = 0; i < v->nsuspect && (!*decided || s->options.values); i++) {
        FW_TRY(fw_verdict_search_run(s, v->suspect + i * v->ninput, FW_NO_CORNER));
        *decided = *decided || s->fabricated->corner[i].decision != FW_ACCEPT;
    }
    return (*decided = *decided || alone) ? FW_OK : know_all(s);
}
