/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What speaks against a scene, or a flow, beside the bands of its hinges. */
#include "base/constants.h"
#include "base/text.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>

/* ---- whether a scene stays where the model holds ----
   Beside the bands of its hinges a scene is judged by whether it stays where the model holds:
     - it ends where an element's formula does (electrodes touch): rejected, or inconclusive where
       it does not with voltages lower by the model's own error; where a flexure's model does: inconclusive,
     - it asks for more than the static pull-in voltage and is over before the rotor has snapped, or
       it would touch with voltages higher by what fringe fields and softer hinges can do: inconclusive,
     - what holds it up to its voltages was not found: inconclusive,
     - it stays on an unstable equilibrium: rejected where a hinge would fall beyond its limit, else not,
     - nothing says what its model of the hinges is off by, or the strain of a hinge is not known at an
       instant: inconclusive,
     - it does not start as stated, or its energy does not add up: inconclusive.
   Test: test_program.py. */

/* below this many times the margin a sudden voltage may throw the rotor to the stator: half of the
   static voltage does so in the worst case, a step without damping from 0.9 of it on */
static const double fw_thrown = 2;
/* an equilibrium that a disturbance of a thousandth reaches within the scene */
static const double fw_workspace_reached = 6.9;

/* ---- runs that end where a formula does ---- */

static const fw_diag *formula_ended(const fw_diags *diags) {
    for (size_t i = 0; i < diags->count; i++)
        if (diags->item[i].ended != FW_ENDED_NOT) return &diags->item[i];
    return NULL;
}

/* ended: the error that said so, which is then no error of the whole verdict */
static void take_messages(const fw_diags *from, const fw_diag *ended, fw_diags *diags) {
    for (size_t i = 0; i < from->count; i++) {
        const fw_diag *d = &from->item[i];
        fw_diags_add(diags, d, d == ended ? FW_WARNING : d->severity);
    }
}

/* does it touch with all voltages `by` times as high? Nobody looks at that run. */
static fw_status touches(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                         double by, const fw_dynamics_motion_options *options, bool *does) {
    fw_device_scene changed = *scene;
    fw_dynamics_motion_options quiet = *options;
    fw_diags own = fw_diags_new(arena);
    const fw_dynamics_motion *motion;
    fw_device_comb *comb;
    FW_NEED(comb = fw_arena_array(arena, fw_device_comb, (size_t)scene->ncomb));
    for (int i = 0; i < scene->ncomb; i++) {
        comb[i] = scene->comb[i];
        comb[i].voltage_V *= by;
    }
    changed.comb = comb;
    quiet.observe = NULL, quiet.samples = 2;
    quiet.hinge_accuracy = 1; /* whether it touches is no matter of a better level of hinges */
    fw_status status = fw_statics_move_scene(arena, m, &changed, &quiet, &own, &motion);
    *does = status == FW_SOLVER && formula_ended(&own);
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}

/* share of the loads to try: force goes with the square of the voltage */
static double share_for(const fw_statics_pull_in *p) {
    double by = p ? p->margin / fw_statics_pull_in_margin(p) : 1;
    return 0.98 * fmin(by * by, 0.87);
}

/* A flexure that its model does not follow need not fail: a leaf bends on beyond its buckling load, and how far it is strained
   is not known. What turned beyond every limit ended before (within_limits), and is rejected by its strain. */
static bool flexure_ended(const fw_diag *ended) {
    return ended->ended == FW_ENDED_CLOSED_FORM || ended->ended == FW_ENDED_BEAM;
}

static fw_status touched(fw_arena *arena, const fw_device_scene *scene, const fw_statics_pull_in *p,
                         const fw_diag *ended, const fw_dynamics_motion_options *options,
                         fw_verdict_variant_verdict *v) {
    bool still = true;
    if (flexure_ended(ended))
        return fw_verdict_scene_reason(v, scene, 242, FW_INCONCLUSIVE, share_for(NULL),
                                       ended->message);
    double off = p ? fmax(fw_verdict_model_error.motion, 0.5 * p->stiffness_error) : 0;
    if (p && fw_effects_levitation_may_be(v->mechanism)) off = 1 - (1 - off) / sqrt(1 + p->fringe);
    if (p) FW_TRY(touches(arena, v->mechanism, scene, 1 - off, options, &still));
    const char *why = p ? fw_statics_pull_in_explain(arena, p) : "";
    char less[32];
    FW_NEED(why);
    fw_number_text(less, sizeof less, 100 * off, 2);
    char *text = fw_arena_printf(arena, "%s%s%s%s%s%s", ended->message, p ? "; " : "", why,
                                 still ? "" : " (not at voltages lower by the ", still ? "" : less,
                                 still ? "" : " % that the model may be wrong by)");
    FW_TRY(fw_verdict_scene_reason(v, scene, 242, still ? FW_REJECT : FW_INCONCLUSIVE, share_for(p),
                                   text));
    v->reason[v->nreason - 1].met = true;
    return FW_OK;
}

/* ---- runs that end well, and may not ---- */

static fw_status beyond(fw_arena *arena, const fw_device_scene *scene, const fw_statics_pull_in *p,
                        fw_verdict_variant_verdict *v) {
    char at[32], asked[32], part[32], off[32];
    fw_number_text(at, sizeof at, p->voltage_V, 4);
    fw_number_text(asked, sizeof asked, p->largest_V, 4);
    fw_number_text(part, sizeof part, 100 * p->fringe, 2);
    fw_percent_text(off, sizeof off, p->stiffness_error);
    const char *text =
        p->margin < 1
            ? fw_arena_printf(
                  arena,
                  "%s%s asks for up to %s V, beyond the pull-in voltage %s V of "
                  "%s%s%s%s; %s, and whether that holds on a wafer is not known",
                  FW_NAMED("scene", scene->name), asked, at, FW_NAMED("comb drive", p->comb),
                  scene->ncomb > 1 ? " " : "", scene->ncomb > 1 ? p->together : "",
                  scene->ncontact > 0
                      ? "no electrodes touch in it, because it is over before the rotor "
                        "has snapped or because a contact of the scene holds it off them"
                      : "it is over before the rotor has snapped")
            : fw_arena_printf(arena,
                              "%s%s asks for up to %s V: %s%s pulls in at %s V, or at "
                              "less: %s may add up to %s %% to its pull, and what holds it may "
                              "be less stiff by up to %s %%",
                              FW_NAMED("scene", scene->name), asked,
                              FW_NAMED("comb drive", p->comb), at,
                              fw_statics_pull_in_fringe_text(p), part, off);
    return fw_verdict_scene_reason(v, scene, 248, FW_INCONCLUSIVE, share_for(p), text);
}

/* thrown to the stator, were the fringe fields all there and what holds it as soft as it may be */
static fw_status may_be_thrown(fw_arena *arena, const fw_device_scene *scene,
                               const fw_statics_pull_in *p, const fw_dynamics_motion *motion,
                               const fw_dynamics_motion_options *options, fw_diags *diags,
                               fw_verdict_variant_verdict *v) {
    bool does;
    if (motion->loads->quasi_static || !(p->margin < fw_thrown * fw_statics_pull_in_margin(p)))
        return FW_OK;
    FW_TRY(touches(arena, v->mechanism, scene, fw_statics_pull_in_margin(p), options, &does));
    if (!does) return FW_OK;
    char part[32], off[32];
    const char *text = fw_arena_printf(
        arena,
        "%s%s may throw the rotor of %s%s to its stator (dynamic pull-in): it does so in a run "
        "with %s, which may add up to %s %% to the pull, and with what holds it less stiff by the "
        "%s %% that it may be",
        FW_NAMED("scene", scene->name), FW_NAMED("comb drive", p->comb),
        fw_statics_pull_in_fringe_text(p), fw_number_text(part, sizeof part, 100 * p->fringe, 2),
        fw_percent_text(off, sizeof off, p->stiffness_error));
    FW_NEED(text);
    fw_diag_warning(diags, 248, p->place, "%s", text);
    return fw_verdict_scene_reason(v, scene, 248, FW_INCONCLUSIVE,
                                   0.98 * (1 - p->stiffness_error) / (1 + p->fringe), text);
}

static fw_status fingers_snap(fw_arena *arena, const fw_device_scene *scene,
                              const fw_statics_pull_in *p, fw_verdict_variant_verdict *v) {
    char holds[32], times[32];
    return fw_verdict_scene_reason(
        v, scene, 595, FW_INCONCLUSIVE, 0.98 / ((1 + p->fringe) * p->fingers),
        fw_arena_printf(arena,
                        "%s%s: the fingers of a comb bend and may snap by themselves; "
                        "up to %s V they surely do not, and the scene asks for %s times that",
                        FW_NAMED("scene", scene->name),
                        fw_number_text(holds, sizeof holds, p->fingers_V, 4),
                        fw_number_text(times, sizeof times, sqrt(p->fingers), 3)));
}

/* what holds it at the voltages of the scene was not found: where it runs all the same, what it rests on is not known */
static fw_status not_found(fw_arena *arena, const fw_device_scene *scene,
                           const fw_statics_pull_in *p, fw_verdict_variant_verdict *v) {
    char at[32], asked[32];
    return fw_verdict_scene_reason(
        v, scene, 249, FW_INCONCLUSIVE, share_for(p),
        fw_arena_printf(arena,
                        "the pull-in voltage of %s%s is not known: %s%s is stable up to %s V of "
                        "the %s V that the scene asks for; then %s",
                        FW_NAMED("scene", scene->name), FW_NAMED("comb drive", p->comb),
                        fw_number_text(at, sizeof at, p->voltage_V, 4),
                        fw_number_text(asked, sizeof asked, p->largest_V, 4), p->why));
}

/* what holds the rotor may be less stiff, too, by what bodies give in the motion; of a scene in which nothing moves that is
   not known. What the next model of the hinges changes of a motion near pull-in is not what it changes of a stiffness. */
static fw_status softened(fw_arena *arena, int scene, fw_verdict_variant_verdict *v) {
    const fw_statics_pull_in **p = &v->pull_in[scene];
    fw_statics_pull_in *softer;
    double gives;
    if (!*p || (*p)->kind == FW_PULL_IN_NONE) return FW_OK;
    FW_TRY(fw_verdict_places_pulled(arena, v, scene, *p, &gives));
    FW_NEED(softer = fw_arena_one(arena, fw_statics_pull_in));
    *softer = **p;
    const double stiff = 1 - fmin(1, softer->stiffness_error);
    softer->stiffness_error = 1 - stiff / (1 + fw_verdict_bending_moving(v->motion[scene]) + gives);
    *p = softer;
    return FW_OK;
}

static fw_status judge_pull_in(fw_arena *arena, const fw_device_scene *scene,
                               const fw_statics_pull_in *p, const fw_dynamics_motion *motion,
                               const fw_dynamics_motion_options *options, fw_diags *diags,
                               fw_verdict_variant_verdict *v) {
    if (!p) return FW_OK;
    if (p->beyond)
        FW_TRY(fw_verdict_scene_reason(v, scene, 715, FW_INCONCLUSIVE, FW_VERDICT_KEEP_MOST,
                                       fw_arena_printf(arena, "what %s%s pulls is not known: %s",
                                                       FW_NAMED("comb drive", p->beyond_id),
                                                       p->beyond)));
    if (fw_statics_pull_in_fingers_snap(p)) {
        FW_TRY(fingers_snap(arena, scene, p, v));
        if (p->margin >= 1) return FW_OK;
    }
    if (p->kind == FW_PULL_IN_NONE && p->margin < 1) return not_found(arena, scene, p, v);
    if (p->kind != FW_PULL_IN_NONE && p->margin < fw_statics_pull_in_margin(p))
        return beyond(arena, scene, p, v);
    return may_be_thrown(arena, scene, p, motion, options, diags, v);
}

static fw_status judge_stability(fw_arena *arena, const fw_device_scene *scene, int i,
                                 fw_diags *diags, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_statics_stability *stability;
    FW_TRY(fw_statics_stability_find(arena, m, scene, v->motion[i], diags, &stability, &v->left[i],
                                     NULL));
    if (!stability) return FW_OK;
    double model = fw_verdict_model_error.motion + fw_verdict_model_error.strain, used = 0;
    for (int k = 0; stability->angle_rad && k < m->nhinge; k++) {
        double limit = m->hinge[k].closed_form.limit_angle_rad;
        used = fmax(used, fabs(stability->angle_rad[m->hinge[k].pin]) / limit);
    }
    bool beyond_limit =
        used * (1 - model) > 1 && stability->growth > fw_workspace_reached && !stability->chance;
    return fw_verdict_scene_reason(v, scene, 259, beyond_limit ? FW_REJECT : FW_INCONCLUSIVE,
                                   0.95 * stability->share, stability->text);
}

/* the step to the next level of hinges is what their model is off by; 2.9 % in its place are of other
   devices */
static fw_status judge_level(fw_arena *arena, const fw_device_scene *scene,
                             const fw_dynamics_motion *motion, fw_verdict_variant_verdict *v) {
    const fw_statics_level_step *step = motion->level;
    const bool apart = fw_statics_level_far_apart(step);
    char by[32];
    if (!step || !(step->unknown || apart)) return FW_OK;
    fw_percent_text(by, sizeof by, step->relative);
    const char *why =
        apart
            ? fw_arena_printf(arena,
                              "exact beams are computed to change it by %s %% of the largest way, "
                              "so that they may move otherwise, as where one snaps and the other "
                              "does not",
                              by)
            : step->why_not;
    FW_NEED(why);
    return fw_verdict_scene_reason(
        v, scene, 293, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF,
        fw_arena_printf(arena,
                        "what the model of the hinges (%s) is off by in %s%s is not "
                        "known: %s; lower the load, or ask for exact beams with "
                        "--hinge-model elastica",
                        fw_effects_hinge_model_text(step->used), FW_NAMED("scene", scene->name),
                        why));
}

/* an instant without a strain: a peak that nobody saw may be there */
static fw_status judge_strains(fw_arena *arena, const fw_device_scene *scene,
                               const fw_dynamics_motion *motion, fw_verdict_variant_verdict *v) {
    const fw_verdict_strain_monitor *saw = motion->observed;
    const fw_mechanism *m = v->mechanism;
    char at[32];
    int k = 0;
    while (saw && k < m->nhinge && !saw->hinge[k].lost)
        k++;
    if (!saw || k == m->nhinge) return FW_OK;
    return fw_verdict_scene_reason(
        v, scene, 597, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF,
        fw_arena_printf(
            arena,
            "the strain of %s%s in %s%s at %s ms is not known: %s; lower the load "
            "or the displacement that bends it",
            FW_NAMED("hinge", m->pin[m->hinge[k].pin].id), FW_NAMED("scene", scene->name),
            fw_number_text(at, sizeof at, 1e3 * saw->hinge[k].lost_s, 4),
            motion->ledger.hinge.used == FW_HINGE_ELASTICA
                ? "no exact beam was found that bears its force in its place"
                : "it is pressed beyond its buckling load, of which its closed form knows "
                  "nothing (--hinge-model elastica may)"));
}

/* what the run itself says is not to be relied on: another start than the stated one, an energy that
   does not add up */
static fw_status judge_reliability(const fw_device_scene *scene, const fw_diags *said,
                                   fw_verdict_variant_verdict *v) {
    for (size_t i = 0; i < said->count; i++)
        if (said->item[i].unreliable)
            FW_TRY(fw_verdict_scene_reason(v, scene, said->item[i].number, FW_INCONCLUSIVE,
                                           FW_VERDICT_KEEP_HALF, said->item[i].message));
    return FW_OK;
}

fw_status fw_verdict_scene(fw_arena *arena, const fw_device_scene *scene, int i,
                           const fw_dynamics_motion_options *options, fw_diags *diags,
                           fw_verdict_variant_verdict *v) {
    fw_diags own = fw_diags_new(arena);
    const fw_statics_pull_in *p;
    FW_TRY(fw_statics_pull_in_find(arena, v->mechanism, scene, &options->effects, diags,
                                   &v->pull_in[i]));
    p = v->pull_in[i];
    fw_status status =
        fw_statics_move_scene(arena, v->mechanism, scene, options, &own, &v->motion[i]);
    const fw_diag *ended = status == FW_SOLVER ? formula_ended(&own) : NULL;
    take_messages(&own, ended, diags);
    if (diags->failed || own.failed) return FW_NOMEM;
    if (ended) {
        v->motion[i] = NULL;
        return touched(arena, scene, p, ended, options, v);
    }
    FW_TRY(status);
    FW_TRY(softened(arena, i, v));
    FW_TRY(judge_pull_in(arena, scene, v->pull_in[i], v->motion[i], options, diags, v));
    FW_TRY(judge_level(arena, scene, v->motion[i], v));
    FW_TRY(fw_verdict_beside(arena, scene, i, options, v));
    FW_TRY(judge_strains(arena, scene, v->motion[i], v));
    FW_TRY(judge_reliability(scene, &own, v));
    FW_TRY(judge_stability(arena, scene, i, diags, v));
    return fw_verdict_ends_early(arena, scene, v->motion[i], options, diags, v);
}

const char fw_verdict_unstable_there[] =
    "in its scene the device stays on an unstable equilibrium, which what is made leaves";

void fw_verdict_unstable_leaves_open(fw_verdict_variant_verdict *v, int scene, int first) {
    bool unstable = false;
    for (int i = first; i < v->nreason; i++)
        unstable = unstable || v->reason[i].number == 259;
    for (int k = 0; unstable && k < v->nrequirement; k++) {
        fw_verdict_requirement *r = &v->requirement[k];
        if (r->scene_index != scene || !r->measure) continue;
        r->value = r->low = r->high = r->margin = (double)NAN;
        r->utilisation = r->utilisation_low = r->utilisation_high = (double)NAN;
        r->rings = 0, r->open = NULL;
        r->decision = FW_INCONCLUSIVE;
        r->why = fw_verdict_unstable_there;
    }
    for (int i = 0; unstable && i < v->nclearance; i++)
        if (v->clearance[i].scene_index == scene && v->clearance[i].decision == FW_ACCEPT)
            v->clearance[i].decision = FW_INCONCLUSIVE;
}

/* ---- what is not in the masks ----
   Nothing is in the motion, or holds the device, that is not in its masks: what finds no room in the
   drawing rejects it, in the flows whose scenes have it. Test: tests/unit/plan/test_not_drawn.c */

static fw_status text_of(fw_arena *arena, const fw_layout_missing *m, const char **text) {
    char x[32], y[32];
    const bool moves = m->number != 127;
    const char *line = m->place.line > 0
                           ? fw_arena_printf(arena, ", line %d, column %d of the description",
                                             m->place.line, m->place.column)
                           : "";
    const char *at = isfinite(m->at.x) && isfinite(m->at.y) /* else of a body that no file places */
                         ? fw_arena_printf(arena, " at (%s, %s) um",
                                           fw_number_text(x, sizeof x, m->at.x * 1e6, 5),
                                           fw_number_text(y, sizeof y, m->at.y * 1e6, 5))
                         : "";
    FW_NEED(line && at ? line : NULL);
    FW_NEED(*text =
                fw_arena_printf(arena, "%s%s%s: %s, but not in the masks: %s%s%s", m->name, at,
                                line, moves ? "in the motion" : "asked for", m->why,
                                m->room ? fw_layout_missing_way(m) : "", m->room ? m->room : ""));
    return FW_OK;
}

fw_status fw_verdict_missing(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             fw_verdict_variant_verdict *v) {
    for (int i = 0; layout && layout->drawn && i < layout->nmissing; i++) {
        const fw_layout_missing *m = &layout->missing[i];
        const char *flow = v->mechanism->variant->flow, *text;
        if (!fw_layout_missing_in_flow(device, m, flow)) continue;
        FW_TRY(text_of(arena, m, &text));
        v->reason[v->nreason++] = (fw_verdict_reason){.scene = NULL,
                                                      .flow = flow,
                                                      .number = m->number,
                                                      .decision = FW_REJECT,
                                                      .keep = FW_VERDICT_KEEP_MOST,
                                                      .not_by_loads = true,
                                                      .not_by_width = true,
                                                      .text = text};
    }
    return FW_OK;
}

/* ---- what is strained as it is drawn ----
   A flexure is cut out of one piece where its mask lies: there it is straight, or the arc that it is drawn as, and at
   rest. A motion that begins there with its spring strained (bodies drawn tilted, and free-angle left out) is that of
   another device: one that was bent and let go. Where that is meant, it has no flow. What residual stress does is a
   load of the scene. Test: tests/unit/plan/test_not_drawn.c */

/* As a joint that does not close: 10 nm over 1 mm; and no more is counted than what a verdict sees of a limit, since
   positions that are typed with few digits are closed by turning bodies so far (FW-D132). */
static const double fw_bent_rad = 1e-5, fw_bent_of_limit = 1e-3;
enum { FW_BENT_NAMED = 4 };

static double bent_by(const fw_mechanism *m, const fw_mechanism_pin *pin) {
    const double a = pin->body_a == FW_GROUND ? 0 : m->body[pin->body_a].phi_rad,
                 b = pin->body_b == FW_GROUND ? 0 : m->body[pin->body_b].phi_rad;
    return b - a - pin->free_angle_rad;
}

/* "hinge B by 7.125 deg (free-angle="7.125016 deg", line 14)" of each, and how many more */
static fw_status list_bent(const fw_device *device, const fw_mechanism *m, fw_text *list, int *n) {
    char by[32], rest[32];
    *n = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        const double angle = bent_by(m, pin),
                     least = fw_bent_of_limit * m->hinge[k].closed_form.limit_angle_rad;
        if (fabs(angle) <= fmax(fw_bent_rad, least) || ++*n > FW_BENT_NAMED) continue;
        fw_text_printf(
            list, "%s%s%s by %s deg (free-angle=\"%s deg\"", *n > 1 ? ", " : "",
            FW_NAMED("hinge", pin->id), fw_number_text(by, sizeof by, FW_DEG_PER_RAD * angle, 4),
            fw_number_text(rest, sizeof rest, FW_DEG_PER_RAD * (angle + pin->free_angle_rad), 9));
        const int line = device->revolute[m->hinge[k].pin].place.line;
        if (line > 0) fw_text_printf(list, ", line %d", line);
        fw_text_printf(list, ")");
    }
    if (*n > FW_BENT_NAMED) fw_text_printf(list, ", and %d more", *n - FW_BENT_NAMED);
    return fw_text_end(list);
}

fw_status fw_verdict_bent(fw_arena *arena, const fw_device *device, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    fw_text list = fw_text_new(arena);
    const char *text;
    int n;
    if (!m->variant->flow) return FW_OK;
    FW_TRY(list_bent(device, m, &list, &n));
    if (n == 0) return FW_OK;
    v->bent = true;
    FW_NEED(text =
                fw_arena_printf(arena,
                                "its motion begins with flexures bent that are made at rest where "
                                "they are drawn: %s; with that free-angle the motion is that of "
                                "what is made, or draw the bodies without their phi",
                                list.data));
    v->reason[v->nreason++] = (fw_verdict_reason){.flow = m->variant->flow,
                                                  .number = 622,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = FW_VERDICT_KEEP_MOST,
                                                  .not_by_loads = true,
                                                  .not_by_width = true,
                                                  .text = text};
    return FW_OK;
}

void fw_verdict_bent_leaves_open(fw_verdict_variant_verdict *v, int first) {
    if (!v->bent) return;
    for (int i = first; i < v->nreason; i++)
        if (fw_verdict_is_worse(v->reason[i].decision, FW_INCONCLUSIVE))
            v->reason[i].decision = FW_INCONCLUSIVE;
    for (int k = 0; k < v->nrequirement; k++)
        if (fw_verdict_is_worse(v->requirement[k].decision, FW_INCONCLUSIVE))
            v->requirement[k].decision = FW_INCONCLUSIVE;
    for (int i = 0; i < v->nclearance; i++)
        if (v->clearance[i].scene_index != FW_NONE &&
            fw_verdict_is_worse(v->clearance[i].decision, FW_INCONCLUSIVE))
            v->clearance[i].decision = FW_INCONCLUSIVE;
}

/* ---- what moves it from outside ----
   A driver is an actuator that nothing on the chip is, as a force of a scene is: a probe, a hand. Other than a
   force it also holds what it moves (FW-D598). */

static bool is_on_body(const fw_mechanism *m, const fw_layout *layout, const fw_device_force *f,
                       fw_geometry_vec2 *at) {
    const double hardly_m = 10e-6;
    if (f->body == FW_GROUND) return true;
    *at = fw_mechanism_local_place(m, f->body, f->x_m, f->y_m);
    for (int i = 0; i < layout->npiece; i++)
        if (fw_mechanism_is_of(&layout->piece[i], f->body) &&
            fw_geometry_contour_contains(&layout->piece[i].contour, *at))
            return true;
    return fw_verdict_comes_near(layout, f->body, *at, hardly_m);
}

static fw_status forces_in_the_open(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout,
                                    const fw_device_scene *s, int scene,
                                    fw_verdict_from_outside *list, int *n) {
    char x[32], y[32];
    fw_geometry_vec2 at;
    for (int k = 0; k < s->nforce; k++) {
        const bool own = s->force[k].x_m == 0 && s->force[k].y_m == 0; /* as the file has it */
        if (own || is_on_body(m, layout, &m->device->scene[scene].force[k], &at)) continue;
        list[*n] = (fw_verdict_from_outside){.number = 696, .place = s->force[k].place};
        FW_NEED(list[(*n)++].text = fw_arena_printf(
                    arena,
                    "%s%s: the masks draw nothing of %s at (%s, %s) um, where a force acts on it: "
                    "something else has to carry it from there; move it on to the body (x, y)",
                    FW_NAMED("scene", s->name), fw_text_name(m->device->body[s->force[k].body].id),
                    fw_number_text(x, 32, 1e6 * at.x, 5), fw_number_text(y, 32, 1e6 * at.y, 5)));
    }
    return FW_OK;
}

fw_status fw_verdict_outside(fw_arena *arena, const fw_device *device, const fw_verdict *verdict,
                             const fw_verdict_from_outside **outside, int *n) {
    const bool drawn = verdict->layout && verdict->layout->drawn;
    const int drivers = drawn ? device->ndriver : 0, scenes = drawn ? device->nscene : 0;
    size_t most = (size_t)drivers;
    fw_verdict_from_outside *list;
    for (int i = 0; i < scenes; i++)
        most += (size_t)(2 * device->scene[i].ncontact + device->scene[i].nforce);
    FW_NEED(list = fw_arena_array(arena, fw_verdict_from_outside, most));
    for (*n = 0; *n < drivers; (*n)++) {
        const fw_device_driver *d = &device->driver[*n];
        const bool turns = d->revolute != FW_NONE;
        const char *id = turns ? device->revolute[d->revolute].id : device->joint[d->joint].id;
        list[*n] = (fw_verdict_from_outside){.number = 598, .place = d->place};
        FW_NEED(list[*n].text = fw_arena_printf(
                    arena,
                    "%s%s moves and holds %s%s, whatever that takes, and nothing on the chip "
                    "does: the verdict is of a device beside which something else does so; "
                    "`simulate` says with what force",
                    FW_NAMED("driver", fw_text_name(d->id)),
                    fw_text_kind(turns ? "hinge " : "joint ", id), fw_text_name(id)));
    }
    for (int i = 0; verdict->nvariant > 0 && i < scenes; i++)
        FW_TRY(forces_in_the_open(arena, verdict->variant[0].mechanism, verdict->layout,
                                  &device->scene[i], i, list, n));
    *outside = list;
    return drawn ? fw_verdict_undrawn(arena, device, verdict->layout, list, n) : FW_OK;
}

/* ---- bodies that bend ---- */

static const fw_verdict_arm *narrowest(const fw_mechanism *m, const fw_verdict_bending *b,
                                       int body) {
    const fw_verdict_arm *narrow = NULL;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const fw_verdict_arm *arm = &b->arm[i];
        if ((i % 2 ? pin->body_b : pin->body_a) != body || !arm->known) continue;
        if (!narrow || arm->narrow_m < narrow->narrow_m) narrow = arm;
    }
    for (int i = 0; i < b->nplace; i++)
        if (b->place[i].element && b->place[i].body == body &&
            (!narrow || b->place[i].arm->narrow_m < narrow->narrow_m))
            narrow = b->place[i].arm;
    return narrow;
}

/* of a device that is pressed along its stiff flexures it is not a share */
static bool is_share(double share) {
    return share < 2;
}

static const char *unit_of(double share) {
    return is_share(share) ? "% of" : "times";
}

static const char *number_of(char text[32], double share) {
    return fw_number_text(text, 32, is_share(share) ? 100 * share : share, 3);
}

void fw_verdict_bending_tell(const fw_mechanism *m, const fw_device_scene *scene,
                             const fw_dynamics_motion *motion, fw_diags *diags) {
    const double share = fw_verdict_bending_counted(motion);
    char all[32], one[32], width[32], x[32], y[32];
    int most = 0;
    if (share == 0) return;
    const fw_verdict_bending *b = &((const fw_verdict_strain_monitor *)motion->observed)->bending;
    for (int i = 1; i < m->nbody; i++)
        if (b->body_J[i] > b->body_J[most]) most = i;
    if (b->bases_J > b->body_J[most]) {
        const double own = fmin(b->bases_J / b->hinges_J, share);
        const char *said[4] = {number_of(all, share), unit_of(share), number_of(one, own),
                               unit_of(own)};
        fw_verdict_bases_tell(m, b->arm, scene, said, diags);
        return;
    }
    const fw_verdict_arm *arm = narrowest(m, b, most);
    if (!arm) return;
    const double most_share = fmin(b->body_J[most] / b->hinges_J, share);
    const char *wider =
        fw_layout_wider_there(diags->arena, m->device, m->layout, most, arm->narrow);
    fw_diag_warning(
        diags, 510, m->device->body[most].place,
        "bodies are taken as rigid, and in %s%s they may give by up to %s %s what "
        "the hinges give, %s%s by %s %s it: what is probed may move that much further, and the "
        "bands allow for it. It is narrowest, %s um, at (%s, %s) um: %s; or make it shorter",
        FW_NAMED("scene", scene->name), number_of(all, share), unit_of(share),
        FW_NAMED("body", m->device->body[most].id), number_of(one, most_share), unit_of(most_share),
        fw_number_text(width, sizeof width, 1e6 * arm->narrow_m, 2),
        fw_number_text(x, sizeof x, 1e6 * arm->narrow.x, 4),
        fw_number_text(y, sizeof y, 1e6 * arm->narrow.y, 4), wider ? wider : "make it wider there");
}
