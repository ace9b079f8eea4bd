/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The verdict on a device in all its flows: each judged as drawn, again more closely where that may
   decide, and then as the flows make it. */
#include "base/constants.h"
#include "verdict/verdict_fabrication.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PLATFORM = 2 }; /* of the six-bar's bodies AB BC CD DE EF */

const char fw_verdict_not_searched[] = "no change that would be accepted was searched for";

static void unreachable(const fw_device *device, const fw_verdict_variant_verdict *v,
                        fw_diags *diags) {
    const fw_place place = device->workspace[v->workspace.fail_box].place;
    for (int i = 0; i < v->nreason; i++) {
        const int number = v->reason[i].number;
        if ((number != 201 && number != 727) || fw_diag_said(diags, number, place)) continue;
        fw_diag_warning(diags, number, place, "%s%s", v->reason[i].text,
                        number == 201 ? "; the design is rejected" : "");
        return;
    }
}

/* ---- what a description states and nothing here answers ---- */

static bool holds_in_any(const fw_device *d, const char *flow) {
    bool any = d->nflow == 0;
    for (int i = 0; i < d->nflow && !any; i++)
        any = fw_device_in_flow(flow, d->flow[i].ref);
    return any;
}

/* Of a motion that no scene of the flow has: an empty set of scenes meets every bound. A scene that is named, and what is in
   scenes alone (a tendon), are asked for in their own flows: then only where no flow has it. */
static bool is_unanswered(const fw_device *d, const fw_device_requirement *q, const char *flow) {
    const fw_device_probe *p = &d->probe[q->probe];
    const bool elsewhere = q->scene != FW_NONE || p->of;
    if (!fw_device_probe_moves(&fw_device_probe_kinds[p->row])) return false;
    for (int i = 0; i < d->nscene; i++) {
        const fw_device_scene *s = &d->scene[i];
        if ((q->scene == FW_NONE || q->scene == i) && fw_device_probe_in_scene(p, s) &&
            (elsewhere ? holds_in_any(d, s->flow) : fw_device_in_flow(s->flow, flow)))
            return false;
    }
    return true;
}

static fw_status unanswered(fw_arena *arena, const fw_device *d, fw_diags *diags,
                            fw_verdict_variant_verdict *v) {
    for (int i = 0; i < d->nrequirement; i++) {
        const fw_device_requirement *q = &d->requirement[i];
        const fw_device_probe *p = &d->probe[q->probe];
        if (!is_unanswered(d, q, v->variant->flow)) continue;
        const char *text = fw_arena_printf(
            arena,
            "what is required of probe %s is of a motion, and no <scene>%s%s %s, so that nothing "
            "says "
            "whether the device does it: write a <scene> that moves it, or take the <require> away",
            fw_text_name(p->id), d->nscene > 0 && v->variant->flow ? " of flow " : "",
            d->nscene > 0 && v->variant->flow ? v->variant->flow : "",
            d->nscene > 0 ? "has what it sees" : "is there");
        FW_NEED(text);
        v->reason[v->nreason++] = (fw_verdict_reason){.scene = fw_verdict_at_rest,
                                                      .flow = v->variant->flow,
                                                      .number = 729,
                                                      .decision = FW_INCONCLUSIVE,
                                                      .keep = 0.99,
                                                      .text = text};
        v->decision = v->drawn = fw_verdict_worse(v->decision, FW_INCONCLUSIVE);
        if (!fw_diag_said(diags, 729, q->place)) fw_diag_warning(diags, 729, q->place, "%s", text);
    }
    return FW_OK;
}

/* a payload that somebody stated is not at the required poses */
static void loads_elsewhere(const fw_device *d, fw_diags *diags,
                            const fw_verdict_variant_verdict *v) {
    const fw_device_scene *of = NULL;
    int box = FW_NONE;
    for (int i = 0; i < d->nworkspace && box == FW_NONE; i++)
        if (v->workspace.required && v->workspace.asked[i]) box = i;
    for (int i = 0; i < d->nscene && !of; i++) {
        const fw_device_scene *s = &d->scene[i];
        bool any = false;
        for (int k = 0; k < s->nforce; k++)
            any = any || s->force[k].body == PLATFORM;
        for (int k = 0; k < s->ntorque; k++)
            any = any || s->torque[k].body == PLATFORM;
        if (any && fw_device_in_flow(s->flow, v->variant->flow)) of = s;
    }
    if (box == FW_NONE || !of || fw_diag_said(diags, 730, d->workspace[box].place)) return;
    fw_diag_warning(
        diags, 730, d->workspace[box].place,
        "%s%s loads the platform with a size that acts in that scene alone: a required "
        "pose is held by such a load as strong as it takes, without payload, and neither "
        "required stiffness and frequency nor the way from one <workspace> to another is "
        "looked at there; for these write a scene that drives to the pose",
        FW_NAMED("scene", of->name));
}

static bool judged(const fw_verdict_variant_verdict *v, const fw_device *device) {
    bool any = v->workspace.required || v->nreason > 0;
    for (int i = 0; i < device->nscene; i++)
        any = any || v->motion[i];
    return any;
}

/* worst over the variants, joint by joint */
static fw_status combine(fw_arena *arena, const fw_device *device, double accuracy_wanted,
                         fw_verdict *verdict) {
    size_t most = (size_t)device->nrevolute;
    FW_NEED(verdict->hinge = fw_arena_array(arena, fw_verdict_hinge_verdict, most));
    verdict->decision = FW_ACCEPT;
    verdict->governing = FW_NONE;
    verdict->accuracy_wanted = accuracy_wanted;
    for (int j = 0; j < device->nrevolute; j++) {
        fw_verdict_hinge_verdict *worst = &verdict->hinge[verdict->nhinge];
        for (int i = 0; i < verdict->nvariant; i++)
            for (int k = 0; k < verdict->variant[i].nhinge; k++) {
                const fw_verdict_hinge_verdict *h = &verdict->variant[i].hinge[k];
                if (h->joint == j && h->scene) fw_verdict_keep_worst(worst, h);
            }
        verdict->nhinge += worst->scene != NULL;
    }
    for (int k = 0; k < verdict->nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &verdict->hinge[k];
        if (verdict->governing == FW_NONE ||
            fw_verdict_governs(h, &verdict->hinge[verdict->governing]))
            verdict->governing = k;
        if (h->peak_angle_rad != 0.0)
            verdict->accuracy_estimated =
                fmax(verdict->accuracy_estimated, h->angle_error_rad / fabs(h->peak_angle_rad));
    }
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < device->nscene; k++)
            if (verdict->variant[i].motion[k])
                verdict->accuracy_left_out = fmax(verdict->accuracy_left_out,
                                                  verdict->variant[i].motion[k]->ledger.left_out);
    verdict->failure_probability = (double)NAN;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        verdict->decision = fw_verdict_worse(verdict->decision, v->decision);
        verdict->failure_probability = fmax(verdict->failure_probability, v->failure_probability);
    }
    return FW_OK;
}

static fw_place flow_place(const fw_device *device, const char *flow) {
    for (int i = 0; flow && i < device->nflow; i++)
        if (strcmp(device->flow[i].ref, flow) == 0) return device->flow[i].place;
    return (fw_place){device->file, 1, 1};
}

static fw_status nothing_to_judge(const fw_device *device, const char *flow, fw_diags *diags) {
    return fw_diag_error(diags, 202, flow_place(device, flow),
                         "nothing to judge in flow %s: add a <scene> or a <workspace> "
                         "that holds for it",
                         flow ? flow : "(none)");
}

/* what all flows of a design are judged by */
typedef struct judging {
    const fw_device *device;
    const fw_layout *layout;
    const fw_verdict_options *options;
    fw_verdict *verdict;
    fw_diags *diags; /* (nvariant) each flow has its own */
    bool *nothing;   /* (nvariant) to judge */
    const fw_arena *whole; /* in which flows that need nothing of each other are judged in turn */
} judging;

/* flow i as drawn */
static fw_status judge_drawn(const judging *j, size_t i, fw_arena *arena) {
    const fw_device *device = j->device;
    fw_diags *diags = &j->diags[i];
    fw_verdict_variant_verdict *v = &j->verdict->variant[i];
    const fw_mechanism *m = NULL;
    *diags = fw_diags_new(arena);
    fw_arena_tell(arena, "judging the device as drawn", (double)i, j->verdict->nvariant, "flows");
    FW_TRY(fw_mechanism_build(arena, device, j->layout, v->variant, diags, &m));
    if (m->nhinge == 0)
        return fw_diag_error(diags, 203,
                             device->nrevolute ? device->revolute[0].place
                                               : (fw_place){device->file, 1, 1},
                             "no joint of the mechanism is a flexure, so there is no elastic "
                             "limit to judge: name a flexure on the joints");
    FW_TRY(fw_verdict_check_closure(device, m, diags));
    if (i > 0) { /* the same drawing: so flows are judged one after the other */
        v->arm = j->verdict->variant[0].arm;
        v->solid = j->verdict->variant[0].solid;
        v->straight = j->verdict->variant[0].straight;
    }
    FW_TRY(fw_verdict_variant(arena, device, j->layout, m, j->options, diags, v));
    if (v->workspace.required && !v->workspace.reachable) unreachable(device, v, diags);
    j->nothing[i] = !judged(v, device);
    if (j->nothing[i] || j->options->only_scene) return FW_OK;
    loads_elsewhere(device, diags, v);
    return unanswered(arena, device, diags, v);
}

static fw_status attempt(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                         const fw_verdict_options *options, fw_diags *diags, fw_verdict *verdict) {
    const size_t n = (size_t)verdict->nvariant;
    judging j = {.device = device, .layout = layout, .options = options, .verdict = verdict};
    FW_NEED(j.diags = fw_arena_array(arena, fw_diags, n));
    FW_NEED(j.nothing = fw_arena_array(arena, bool, n));
    fw_status status = FW_OK;
    for (size_t i = 0; i < n && status == FW_OK; i++)
        status = judge_drawn(&j, i, arena);
    for (size_t i = 0; i < n; i++) {
        fw_diags_take(diags, &j.diags[i]);
        if (j.diags[i].errors > 0 && status != FW_OK) break; /* of those behind it nothing counts */
    }
    FW_TRY(diags->failed ? FW_NOMEM : status);
    for (size_t i = 0; i < n; i++)
        if (j.nothing[i])
            status = nothing_to_judge(device, verdict->variant[i].variant->flow, diags);
    FW_TRY(status);
    return combine(arena, device, options->motion.accuracy, verdict);
}

/* a device far from its limits is decided by a first look */
static fw_status first_attempt(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_verdict_options *options, fw_diags *diags,
                               fw_verdict *verdict) {
    fw_verdict_options coarse = *options;
    const fw_verdict empty = {.variant = verdict->variant, .nvariant = verdict->nvariant};
    bool looser = options->motion.rtol == 0 && options->motion.accuracy < fw_verdict_first_accuracy;
    if (!options->coarse_first || !looser)
        return attempt(arena, device, layout, options, diags, verdict);
    coarse.motion.accuracy = fw_verdict_first_accuracy;
    FW_TRY(attempt(arena, device, layout, &coarse, diags, verdict));
    if (verdict->decision != FW_INCONCLUSIVE || options->at_a_glance) return FW_OK;
    fw_diags again = fw_diags_new(arena); /* the same warnings a second time */
    *verdict = empty;
    return attempt(arena, device, layout, options, &again, verdict);
}

static bool has_soft_bodies(const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++)
        if (!fw_verdict_bending_settled(&verdict->variant[i])) return true;
    return false;
}

/* what is not accepted says how near things come */
static bool is_bounded_well(const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; k < v->nclearance; k++)
            if (v->clearance[k].decision != FW_ACCEPT) return false;
    }
    return true;
}

/* with options.bounded, which is taken back where bounds are not good enough to decide */
static fw_status bounded_attempt(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                 fw_verdict_options *options, fw_diags *diags,
                                 fw_verdict *verdict) {
    const fw_verdict empty = {.variant = verdict->variant, .nvariant = verdict->nvariant};
    if (!options->bounded) return first_attempt(arena, device, layout, options, diags, verdict);
    fw_diags first = fw_diags_new(arena);
    fw_status status = first_attempt(arena, device, layout, options, &first, verdict);
    const bool soft = status == FW_OK && !options->only_scene && has_soft_bodies(verdict);
    /* what is judged as made all the same is so as if it had been found */
    const bool wanted = options->all_made && verdict->decision != FW_ACCEPT;
    if (status != FW_OK || (!soft && !wanted && is_bounded_well(verdict))) {
        fw_diags_take(diags, &first);
        return diags->failed ? FW_NOMEM : status;
    }
    options->bounded = false;
    *verdict = empty;
    status = first_attempt(arena, device, layout, options, diags, verdict);
    verdict->soft_bodies = soft;
    return status;
}

/* the drawing, whose messages are warnings where the mechanics can be judged without it; *judged:
   NULL where it cannot be made */
static fw_status draw(fw_arena *arena, const fw_device *device, const fw_verdict_options *options,
                      fw_diags *diags, const fw_layout **layout, const fw_layout **judged) {
    fw_diags drawing = fw_diags_new(arena);
    *layout = NULL;
    fw_status status = fw_layout_build(arena, device, &drawing, layout);
    bool impossible = status == FW_GEOMETRY || status == FW_INPUT;
    if (drawing.failed) return FW_NOMEM;
    if (status != FW_OK && !impossible) return status;
    if (!options->at_a_glance && !options->decision_only) /* trials need no room */
        FW_TRY(fw_layout_rooms_find(arena, device, *layout, layout));
    *judged = impossible ? NULL : *layout;
    bool fatal = impossible && fw_device_needs_shapes(device);
    for (size_t i = 0; i < drawing.count; i++) {
        const fw_diag *d = &drawing.item[i];
        fw_diags_add(diags, d, d->severity == FW_ERROR && !fatal ? FW_WARNING : d->severity);
    }
    return fatal ? status : FW_OK;
}

/* flow i as it makes the device */
static fw_status judge_made(void *context, size_t i, fw_arena *arena) {
    const judging *j = context;
    fw_verdict_options options = *j->options;
    if (arena != j->whole) options.kept = NULL, options.motion.tapes = NULL; /* of one thread */
    return fw_verdict_as_made(arena, j->device, j->layout, &options, &j->verdict->variant[i]);
}

/* what the flows make of it; the drawn verdict stays in each variant */
static fw_status as_fabricated(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_verdict_options *options, fw_verdict *verdict) {
    verdict->drawn = verdict->decision;
    if (options->decision_only && verdict->drawn == FW_REJECT) return FW_OK;
    judging j = {.device = device,
                 .layout = layout,
                 .options = options,
                 .verdict = verdict,
                 .whole = arena};
    FW_TRY(fw_arena_each(arena, (size_t)verdict->nvariant, judge_made, &j));
    for (int i = 0; i < verdict->nvariant; i++)
        verdict->decision = fw_verdict_worse(verdict->decision, verdict->variant[i].decision);
    return FW_OK;
}

/* gaps of the drawing decide what an etch takes */
static fw_status take_inputs(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict_fabricated_of *fabricated, fw_verdict *verdict) {
    for (int i = 0; fabricated->fill && i < verdict->nvariant; i++)
        FW_TRY(
            fabricated->fill(fabricated->context, arena, device, layout, i, &verdict->variant[i]));
    return FW_OK;
}

/* nobody knows what exact beams change */
static bool beams_untried(const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < verdict->variant[i].nreason; k++) {
            const fw_verdict_reason *r = &verdict->variant[i].reason[k];
            if (r->number == 293 && r->decision == FW_INCONCLUSIVE) return true;
        }
    return false;
}

static bool all_in_vain(const fw_verdict *verdict, double times) {
    for (int i = 0; i < verdict->nvariant; i++)
        if (!fw_verdict_in_vain(&verdict->variant[i], times)) return false;
    return verdict->nvariant > 0;
}

/* of hinges, requirements and what tips, whichever goes further; where no tolerance makes numbers better only better hinges,
   if those are not lost in the numbers */
static fw_verdict_refinement refinement_of(const fw_verdict *verdict, fw_verdict_refinement last) {
    if (last < FW_REFINE_BEAMS && beams_untried(verdict)) return FW_REFINE_BEAMS;
    fw_verdict_refinement most = fw_verdict_refinement_of(verdict->hinge, verdict->nhinge);
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        const fw_verdict_refinement also =
            fw_verdict_requirements_refinement(v->requirement, v->nrequirement);
        if (also > most) most = also;
        if (most == FW_REFINE_NOTHING && fw_verdict_across_open(v)) most = FW_REFINE_NUMBERS;
    }
    if (all_in_vain(verdict, FW_DYNAMICS_VAIN)) return FW_REFINE_NOTHING;
    if (last == FW_REFINE_BEAMS && most == FW_REFINE_NUMBERS) return FW_REFINE_HINGES;
    return most == FW_REFINE_NUMBERS && all_in_vain(verdict, 1) ? FW_REFINE_HINGES : most;
}

/* what was computed stays in the arena when it is computed once more */
static fw_status keep_computed(fw_arena *arena, const fw_verdict *verdict,
                               fw_verdict_refinement refinement, fw_verdict_computed *look) {
    *look = (fw_verdict_computed){refinement, verdict->hinge, NULL};
    FW_NEED(look->requirement =
                fw_arena_alloc(arena, (size_t)verdict->nvariant, sizeof *look->requirement));
    for (int i = 0; i < verdict->nvariant; i++)
        look->requirement[i] = verdict->variant[i].requirement;
    return FW_OK;
}

/* no motion makes it accepted: it, or a part of it, cannot be drawn. Bodies without shapes are never drawn, and that decides
   nothing */
static bool decided_by_drawing(const fw_device *device, const fw_layout *layout,
                               const fw_verdict *verdict) {
    if (!layout || layout->nfault > 0) return true;
    for (int i = 0; i < layout->nmissing; i++)
        for (int k = 0; k < verdict->nvariant; k++) {
            const char *flow = verdict->variant[k].variant->flow;
            if (fw_layout_missing_in_flow(device, &layout->missing[i], flow)) return true;
        }
    return false;
}

bool fw_verdict_no_number_helps(const fw_verdict *verdict, const char **why) {
    for (int i = 0; verdict->layout && i < verdict->layout->nmissing; i++)
        if (verdict->layout->missing[i].number == 130) {
            *why = "a joint, a spring or a stop that is never drawn is in the motion, and no "
                   "change of a "
                   "number makes the design accepted with it: draw what does its work";
            return true;
        }
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < verdict->variant[i].nreason; k++)
            if (verdict->variant[i].reason[k].number == 622) {
                *why = "flexures are bent where the masks draw them at rest, and the motion is not "
                       "that of "
                       "what is made: state their free-angle first";
                return true;
            } else if (verdict->variant[i].reason[k].number == 729) {
                *why = "a requirement is of a motion that no scene has, and no change of the "
                       "design answers it: write the scene first";
                return true;
            } else if (verdict->variant[i].reason[k].number == 694) {
                *why = "what the flow makes is not known, and no change of the design makes it "
                       "known: measure first what the reason names";
                return true;
            }
    return false;
}

fw_status fw_verdict_run(fw_arena *arena, const fw_device *device, const fw_verdict_options *asked,
                         fw_diags *diags, fw_verdict *verdict, const fw_layout **layout) {
    const fw_layout *judged;
    fw_verdict_options own = *asked;
    const fw_verdict_options *options = &own;
    FW_TRY(draw(arena, device, options, diags, layout, &judged));
    if (options->decision_only && decided_by_drawing(device, judged, verdict)) {
        verdict->decision = verdict->drawn = FW_REJECT;
        return FW_OK;
    }
    FW_TRY(take_inputs(arena, device, judged, &options->fabricated_of, verdict));
    int nvariant = verdict->nvariant;
    fw_verdict_variant_verdict *variant = verdict->variant;
    FW_TRY(bounded_attempt(arena, device, judged, &own, diags, verdict));

    /* a band that straddles 1 for want of computing: once more, closer. Numbers first: they cost
       less than better hinges, which then may not be needed */
    const char *vain;
    fw_verdict_computed look[FW_VERDICT_LOOKS] = {{.hinge = NULL}};
    int nlook = 0;
    FW_TRY(keep_computed(arena, verdict, FW_REFINE_NOTHING, &look[nlook++]));
    for (fw_verdict_refinement last = FW_REFINE_NOTHING;
         verdict->decision == FW_INCONCLUSIVE && !options->at_a_glance &&
         !fw_verdict_no_number_helps(verdict, &vain);) {
        fw_verdict_refinement refinement = refinement_of(verdict, last);
        if (refinement <= last) break; /* what comes first costs the least */
        last = refinement;
        fw_verdict_options tight = fw_verdict_tighter(options, refinement);
        fw_diags again = fw_diags_new(arena); /* the same warnings a second time */
        *verdict = (fw_verdict){.variant = variant, .nvariant = nvariant};
        FW_TRY(attempt(arena, device, judged, &tight, &again, verdict));
        verdict->accuracy_wanted = options->motion.accuracy;
        FW_TRY(keep_computed(arena, verdict, refinement, &look[nlook++]));
    }
    memcpy(verdict->computed, look, sizeof look);
    verdict->ncomputed = nlook;
    verdict->layout = judged;
    FW_TRY(as_fabricated(arena, device, judged, options, verdict));
    if (*layout && (*layout)->nfault > 0) /* whatever its motion does */
        verdict->decision = verdict->drawn = FW_REJECT;
    if (verdict->decision != FW_ACCEPT) verdict->advice_note = fw_verdict_not_searched;
    return FW_OK;
}

/* ---- does the description close as it is drawn? ---- */

/* the mask is drawn where the bodies are, so both must put a pin at the same place */
static double pin_gap(const fw_mechanism *m, const fw_mechanism_pin *pin) {
    fw_geometry_vec2 a = fw_mechanism_pin_place(m, pin, 0), b = fw_mechanism_pin_place(m, pin, 1);
    return hypot(a.x - b.x, a.y - b.y);
}

static double turn_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0.0 : m->body[body].phi_rad;
}

static bool driven(const fw_mechanism *m, int joint) {
    for (int i = 0; i < m->ndriver; i++)
        if (m->driver[i].joint == joint) return true;
    return false;
}

/* how far a joint is from holding as drawn: m, and rad beside it */
static double joint_gap(const fw_mechanism *m, int i, double *angle_rad) {
    const fw_device_joint *t = &m->joint[i];
    fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
    double dx = b.x - a.x, dy = b.y - a.y, axis = turn_of(m, t->body_a) + t->axis_rad;
    *angle_rad = turn_of(m, t->body_b) - turn_of(m, t->body_a) - t->angle_rad;
    switch (t->kind) {
    case FW_JOINT_PRISMATIC:
        return fabs(-sin(axis) * dx + cos(axis) * dy);
    case FW_JOINT_DISTANCE: /* a driver gives another length, from the start on */
        *angle_rad = 0;
        return driven(m, i) ? 0 : fabs(hypot(dx, dy) - t->length_m);
    case FW_JOINT_WELD:
        break;
    }
    return hypot(dx, dy);
}

fw_status fw_verdict_check_closure(const fw_device *device, const fw_mechanism *m,
                                   fw_diags *diags) {
    const double grid = 10e-9, tilt_rad = 1e-5; /* 10 nm over 1 mm */
    fw_status status = FW_OK;
    for (int i = 0; i < m->npin + m->njoint; i++) {
        bool pin = i < m->npin;
        double tilt = 0, gap = pin ? pin_gap(m, &m->pin[i]) : joint_gap(m, i - m->npin, &tilt);
        const char *id = pin ? m->pin[i].id : m->joint[i - m->npin].id;
        char text[32];
        if (gap > grid)
            status = fw_diag_error(
                diags, 206, pin ? device->revolute[i].place : m->joint[i - m->npin].place,
                "%s%s does not close in the drawn position: its two bodies put it "
                "%s um apart (10 nm is allowed); correct the body positions or its "
                "coordinates, since masks are drawn there; `flexwright assemble` prints poses "
                "that close",
                FW_NAMED("joint", id), fw_number_text(text, sizeof text, gap * 1e6, 4));
        else if (fabs(tilt) > tilt_rad)
            status = fw_diag_error(
                diags, 206, m->joint[i - m->npin].place,
                "%s%s does not close in the drawn position: its bodies are turned against "
                "each other by %s deg more than its angle; correct the angle or the bodies, since "
                "masks are drawn there",
                FW_NAMED("joint", id), fw_number_text(text, sizeof text, tilt * 180 / FW_PI, 4));
    }
    return status;
}

/* ---- what a recipe is told ---- */

/* the least of those that the flow makes, at the corners that were run; NaN: it was not judged at all of them, as where a
   flow dries without a meniscus */
static double dries_as_made(const fw_verdict_variant_verdict *v) {
    double least = HUGE_VAL;
    const int n = v->fabricated ? v->fabricated->ncorner : 0;
    for (int i = 0; i < n; i++) {
        if (isnan(v->fabricated->corner[i].dries_N_per_m)) return (double)NAN;
        least = fmin(least, v->fabricated->corner[i].dries_N_per_m);
    }
    return n > 0 ? least : (double)NAN;
}

/* of which liquids the device bears the meniscus, as drawn, and where that was judged as made; HUGE_VAL: of any */
static const char *borne(fw_arena *arena, const fw_mechanism_drying *d, double drawn, double made) {
    char text[2][32], most[96];
    const double tension = fmin(drawn, made);
    fw_number_text(text[0], sizeof text[0], 1e3 * drawn, 3);
    fw_number_text(text[1], sizeof text[1], 1e3 * made, 3);
    if (isnan(made))
        snprintf(most, sizeof most, "%s mN/m as drawn", text[0]);
    else if (isinf(drawn))
        snprintf(most, sizeof most, "%s mN/m as made", text[1]);
    else
        snprintf(most, sizeof most, "%s mN/m as made, %s as drawn", text[1], text[0]);
    if (isinf(tension))
        return isnan(made) ? "as drawn it may be dried from any liquid, from water too"
                           : "it may be dried from any liquid, from water too";
    if (tension > d->water_N_per_m)
        return fw_arena_printf(arena, "it may be dried from any liquid, from water too (up to %s)",
                               most);
    if (tension > d->alcohol_N_per_m)
        return fw_arena_printf(
            arena,
            "it may be dried from isopropyl alcohol, and not from water (liquids of up to %s)",
            most);
    return fw_arena_printf(arena,
                           "it needs drying without a meniscus, at the critical point or by "
                           "sublimation: it surely bears only liquids of up to %s",
                           most);
}

fw_status fw_verdict_drying_words(fw_arena *arena, const fw_verdict_variant_verdict *v,
                                  const char **words) {
    const fw_verdict_stiction *s = v->stiction;
    *words = NULL;
    if (!s) return FW_OK;
    const fw_verdict_pull *p =
        s->beside.tension_N_per_m[0] < s->below.tension_N_per_m[0] ? &s->beside : &s->below;
    const fw_mechanism_drying *d = &v->variant->drying;
    if (d->how == FW_DRIED_NEVER) {
        *words = d->words;
        return FW_OK;
    }
    if (s->why || (!s->below.known && !s->beside.known)) {
        FW_NEED(*words = fw_arena_printf(arena, "what it needs is not known: %s",
                                         s->why ? s->why : "nothing is drawn"));
        return FW_OK;
    }
    FW_NEED(*words = borne(arena, d, p->tension_N_per_m[0], dries_as_made(v)));
    if (p->a)
        FW_NEED(*words = fw_arena_printf(arena, "%s; the first to give way is %s, towards %s",
                                         *words, p->a, p->b ? p->b : "the carrier"));
    if (!v->variant->below.known)
        FW_NEED(*words = fw_arena_printf(
                    arena, "from wall to wall %s; how far the carrier is away is not known",
                    *words));
    return FW_OK;
}
