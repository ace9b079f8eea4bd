/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the answer rests on, in sentences: every material number that is not measured, every
   scaling, every model with its error. */
#include "plan/stages.h"
#include "base/constants.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const fw_device_material *fw_plan_material(const fw_plan *plan, const fw_plan_flow *pf,
                                           const char *id) {
    return fw_device_material_find(pf->materials.count > 0 ? &pf->materials : &plan->materials, id);
}

__attribute__((format(printf, 2, 3))) static fw_status assume(fw_plan *plan, const char *format,
                                                              ...) {
    if (plan->nassumption == plan->assumption_capacity) {
        int more = plan->assumption_capacity ? 2 * plan->assumption_capacity : 16;
        const char **grown = fw_arena_grow(plan->arena, plan->assumption, (size_t)plan->nassumption,
                                           (size_t)more, sizeof *plan->assumption);
        FW_NEED(grown);
        plan->assumption = grown;
        plan->assumption_capacity = more;
    }
    char buffer[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    FW_NEED(plan->assumption[plan->nassumption++] = fw_arena_strdup(plan->arena, buffer));
    return FW_OK;
}

/* a crystal: which way it lies, and what is known of its stress */
static fw_status of_crystal(fw_plan *plan, const fw_verdict_variant_verdict *judged) {
    const fw_mechanism_variant *v = judged->variant;
    const fw_mechanism *m = judged->mechanism;
    double most = 0;
    for (int k = 0; m && k < m->nhinge; k++)
        most = fmax(most, hypot(m->hinge[k].off_a_m.x, m->hinge[k].off_a_m.y));
    char angle[32], off[32];
    return assume(
        plan,
        "%s%s%s is a cubic crystal with [100] at %s deg from +x; its modulus goes with the "
        "direction "
        "of every hinge. Pins are at the elastic centres of the crystal, up to %s um from where "
        "the "
        "hinges and their surfaces are drawn. Peak stress at the roots is calibrated on three "
        "finite "
        "element models of one arc, none held out: the band is 3 %% wider for it on either side.",
        v->flow ? v->flow : "", v->flow ? ": " : "", v->material.id,
        fw_number_text(angle, sizeof angle, v->orientation_rad * 180.0 / FW_PI, 4),
        fw_number_text(off, sizeof off, most * 1e6, 2));
}

static fw_status of_variant(fw_plan *plan, const fw_verdict_variant_verdict *judged) {
    const fw_mechanism_variant *v = judged->variant;
    if (fw_device_material_is_crystal(&v->material) && plan->device->nflexure > 0)
        FW_TRY(of_crystal(plan, judged));
    bool scaled =
        fabs(v->explicit_stiffness_scale - 1.0) > 1e-9 || fabs(v->explicit_mass_scale - 1.0) > 1e-9;
    if (scaled) {
        char k[32], mass[32], c[32];
        FW_TRY(assume(plan,
                      "Flow %s: masses, stiffnesses and dampings that the device file states "
                      "hold for its own material and thickness; here they are scaled by "
                      "rho h (%s), E h (%s) and sqrt(E h rho h) (%s, the same modal "
                      "damping).",
                      v->flow, fw_number_text(mass, sizeof mass, v->explicit_mass_scale, 4),
                      fw_number_text(k, sizeof k, v->explicit_stiffness_scale, 4),
                      fw_number_text(c, sizeof c, v->explicit_damping_scale, 4)));
    }
    return FW_OK;
}

/* the material as that flow has it that takes it for the weakest */
static const fw_device_material *weakest(const fw_plan *plan, const char *id) {
    const fw_device_material *least = NULL;
    for (int i = 0; i < plan->nflow; i++) {
        const fw_device_material *m = fw_plan_material(plan, &plan->flow[i], id);
        if (m && (!least || m->strength.value < least->strength.value)) least = m;
    }
    return least;
}

/* a strength above the pack's own is the number that the verdict rests on most: say so twice */
static fw_status strength_override(fw_plan *plan) {
    const fw_device *d = plan->device;
    const fw_device_material *pack = weakest(plan, d->material_ref);
    const fw_quantity *own = &d->material.strength;
    if (!pack || own->unknown || pack->strength.unknown || own->value <= pack->strength.value)
        return FW_OK;
    char mine[32], theirs[32];
    fw_number_text(mine, sizeof mine, own->value * 1e-9, 3);
    fw_number_text(theirs, sizeof theirs, pack->strength.value * 1e-9, 3);
    fw_diag_note(&plan->diags, 231, own->place,
                 "strength of %s is stated as %s GPa, the pack has %s GPa (%s): the verdict "
                 "depends on it, so measure it on beams of the same wafer",
                 pack->id, mine, theirs, pack->strength.source ? pack->strength.source : "");
    return assume(plan,
                  "The device file states a strength of %s GPa for %s where the pack has %s "
                  "GPa; with the pack's value every utilisation would be %.2f times as "
                  "high. Measure the strength of your own sidewalls.",
                  mine, pack->id, theirs, own->value / pack->strength.value);
}

/* what asking for cycles, a probability or survival rests on */
static fw_status repetitions(fw_plan *plan) {
    const fw_device_limits_asked *asked = &plan->device->limits;
    char n[32];
    if (asked->cycles > 0)
        FW_TRY(assume(
            plan,
            "Every scene is repeated %s times, each on its own. Strains at both roots are counted "
            "by "
            "rainflow and summed after Miner, mean stress after Smith, Watson and Topper. Lives "
            "scatter by a factor of two and more, which the band of the stress does not hold.",
            fw_number_text(n, sizeof n, asked->cycles, 4)));
    if (asked->failure_probability > 0)
        FW_TRY(assume(
            plan,
            "Brittle materials are allowed a failure probability of %s of the whole device, shared "
            "equally by its flexures, from the Weibull strength of their stressed surfaces; the "
            "safety factor comes on top.",
            fw_number_text(n, sizeof n, asked->failure_probability, 3)));
    if (asked->survival)
        FW_TRY(assume(plan, "Metals may pass their proportional limit up to the 0.2 %% "
                            "offset: a hinge may not come back to where it was."));
    return FW_OK;
}

/* how many motions took their hinges in this way; the largest error that the bands have for it */
typedef struct taken {
    int motions, level[4];
    double error;
} taken;

static taken how_taken(const fw_plan *plan) {
    taken t = {0};
    for (int i = 0; i < plan->verdict.nvariant; i++) {
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
        for (int k = 0; v->motion && k < plan->device->nscene; k++) {
            if (!v->motion[k]) continue;
            t.motions++;
            t.level[v->motion[k]->ledger.hinge.used]++;
            t.error = fmax(t.error, fw_verdict_motion_model_error(v->mechanism, v->motion[k]));
        }
    }
    return t;
}

/* pins, closed forms or beams: the ledger of each motion says which */
static fw_status how_hinges_move(fw_plan *plan) {
    const taken t = how_taken(plan);
    int give = t.level[FW_HINGE_COMPLIANCE], exact = t.level[FW_HINGE_ELASTICA];
    bool all = give + exact == t.motions;
    if (give > 0)
        FW_TRY(assume(plan,
                      "%singes turn, give way to forces and drift as flexures do, in "
                      "closed form for the wound strip (nonlinear-hinge).",
                      give < t.motions ? "In scenes whose ledger has nonlinear-hinge h" : "H"));
    if (exact > 0)
        FW_TRY(assume(plan, "%singes are geometrically exact beams (elastica).",
                      exact < t.motions ? "In scenes that need it h" : "H"));
    char by[32];
    fw_percent_text(by, sizeof by, t.error);
    FW_TRY(assume(plan, "%s revolute joints at the centres of elastic weights.",
                  give + exact == 0 ? "Hinges are"
                  : all             ? "Required poses take them as"
                                    : "Other scenes and required poses take them as"));
    return assume(plan,
                  "The band of every utilisation holds what these models of hinges may be "
                  "off by, up to %s %%: the step to the next level, computed at each "
                  "scene's peak, and the stiffness of the closed form against finite "
                  "elements; where there is no such step, and at least where pins swing, "
                  "%.1f %%, the most by which exact flexures changed the peak moment of a "
                  "hinge in four reference load cases.",
                  by, 100.0 * fw_verdict_model_error.motion);
}

/* what the corners of the flows are, and what they are not */
static fw_status as_fabricated(fw_plan *plan) {
    bool any = false;
    for (int i = 0; i < plan->verdict.nvariant; i++) {
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
        any = any || v->fabricated;
        for (int k = 0; v->fabricated && k < v->ninput; k++)
            if (v->input[k].unknown)
                FW_TRY(assume(plan,
                              v->input[k].open
                                  ? "Flow %s: %s is not known (%s), and no range is assumed: the "
                                    "corners are run without it, and accept nothing: measure it."
                                  : "Flow %s: %s is not known (%s). The corners take an assumed "
                                    "range, and the verdict holds inside it only: measure it.",
                              v->variant->flow, v->input[k].name, v->input[k].unknown));
    }
    if (!any)
        return assume(plan, "The check is of the drawn geometry; what etching or plating "
                            "makes of it is in each flow's judgement.");
    return assume(plan, "Corners of a flow move all edges of the device alike, and all its walls. "
                        "The strength is no input of them: the safety factor stands for it. What "
                        "differs from flexure to flexure of one device is not in them.");
}

/* a sentence for every value that laboratory packs replace */
static fw_status of_laboratory(fw_plan *plan) {
    for (int i = 0; i < plan->nflow; i++) {
        const fw_process_flow *flow = plan->flow[i].flow;
        for (int k = 0; flow && k < flow->noverride; k++) {
            const fw_process_override *o = &flow->override[k];
            FW_TRY(assume(plan,
                          "Flow %s: the laboratory's %s = %s stands for %s of the process "
                          "pack. Source: %s.",
                          flow->id, o->id, o->is, o->was, o->source));
        }
    }
    return FW_OK;
}

/* what holds the required poses */
static fw_status of_workspace(fw_plan *plan) {
    for (int i = 0; i < plan->verdict.nvariant; i++) {
        const fw_workspace_result *w = &plan->verdict.variant[i].workspace;
        if (!w->required) continue;
        return assume(
            plan,
            "A required pose is held by three actuators of the flow's scenes, each as "
            "strong as the pose asks, or, where these are not enough, by the wrench on the "
            "platform besides; without scenes by that wrench or by torques on links. Of all "
            "that can hold the whole box the worst counts for every hinge. Point springs, "
            "stops and contacts do not act there. %s",
            w->certified ? "Rotations, joint forces and strains are bounded by interval "
                           "arithmetic over every pose."
                         : "The poses were sampled: nothing is proved.");
    }
    return FW_OK;
}

fw_status fw_plan_assumptions(fw_plan *plan) {
    const fw_verdict_model_errors *e = &fw_verdict_model_error;
    char sf[32];
    if (plan->nassumption > 0) return FW_OK; /* said already, for another document */
    for (int i = 0; i < plan->verdict.nvariant; i++)
        FW_TRY(of_variant(plan, &plan->verdict.variant[i]));
    FW_TRY(strength_override(plan));
    FW_TRY(of_laboratory(plan));
    FW_TRY(assume(plan, "Safety factor %s on the strength (%s:%d:%d).",
                  fw_number_text(sf, sizeof sf, plan->device->safety_factor, 4),
                  fw_place_file(plan->device->limits_place), plan->device->limits_place.line,
                  plan->device->limits_place.column));
    FW_TRY(repetitions(plan));
    FW_TRY(how_hinges_move(plan));
    FW_TRY(assume(plan,
                  "Peak strain is the closed form with root fillets, depth and curved-beam "
                  "factors, with the joint force's own bending added; 3-D finite elements "
                  "on held-out shapes are within %.1f %%.",
                  100.0 * e->strain));
    FW_TRY(of_workspace(plan));
    for (int i = 0; i < plan->noutside; i++)
        FW_TRY(assume(plan, "From outside: %s.", plan->outside[i].text));
    return as_fabricated(plan);
}

/* which expansions its scenes leave to the pack */
void fw_plan_find_heated(const fw_device *d, const char *flow, fw_mechanism_variant *v) {
    for (int i = 0; i < d->nscene; i++)
        for (int k = 0; k < d->scene[i].ntemperature && fw_device_in_flow(d->scene[i].flow, flow);
             k++) {
            const fw_device_temperature *t = &d->scene[i].temperature[k];
            const bool warm = t->change_K != 0;
            v->heated_layer = v->heated_layer || (warm && isnan(t->expansion_per_K));
            v->heated_substrate =
                v->heated_substrate || (warm && isnan(t->substrate_expansion_per_K));
        }
}

/* ---- what of <material> changes nothing, or less than it seems ---- */

/* an orientation that nothing goes by is worth a word */
static void check_orientation(fw_plan *plan, const fw_plan_flow *pf, const fw_device_material *m) {
    const fw_device_flow_use *use = pf->use;
    bool asked = use && !isnan(use->orientation_rad);
    if (fw_device_material_is_crystal(m) || (!asked && isnan(plan->device->orientation_rad)))
        return;
    if (!asked && !fw_text_same(m->id, plan->device->material_ref))
        return; /* it is not about this one */
    const fw_device_material *pack = fw_plan_material(plan, pf, m->id);
    fw_diag_warning(
        &plan->diags, 210, asked ? use->place : plan->device->material_place,
        pack && fw_device_material_is_crystal(pack)
            ? "orientation has no effect on '%s', because youngs-modulus is stated and "
              "holds in every direction; leave one of them out"
            : "orientation has no effect on '%s', which has no crystal constants in the "
              "pack; leave it out",
        m->id);
}

/* A modulus that is stated has no range: the flow's corner of it is none then. That a range of more than some percent is gone is
   worth a word. Test: tests/cli/test_program.py */
static void check_modulus(fw_plan *plan, const fw_plan_flow *pf, const fw_device_material *m) {
    static const double worth_a_word = 0.03; /* two standard uncertainties of the pack's */
    const fw_device_material *pack = fw_plan_material(plan, pf, m->id);
    bool corner = false;
    char stated[32], own[32], range[32];
    for (int i = 0; pf->flow && i < pf->flow->ncorner; i++)
        corner = corner || pf->flow->corner[i].of == FW_CORNER_YOUNGS;
    if (!corner || plan->device->material.youngs.unknown || !plan->device->material.youngs.unit ||
        !fw_text_same(m->id, plan->device->material_ref) || !pack || pack->youngs.unknown ||
        !(2 * pack->youngs.uncertainty > worth_a_word * pack->youngs.value))
        return;
    fw_percent_text(range, sizeof range, 2 * pack->youngs.uncertainty / pack->youngs.value);
    fw_diag_warning(
        &plan->diags, 733, plan->device->material_place,
        "youngs-modulus is stated, %s GPa, and so it is known exactly for what is judged as made: "
        "the pack's own for %s in flow %s is %s GPa within %s %% either way; where it was "
        "measured, say how well in a study: <uncertain what=\"material/@youngs-modulus\" mean=... "
        "sd=...>",
        fw_number_text(stated, sizeof stated, 1e-9 * m->youngs.value, 4), m->id, pf->flow->id,
        fw_number_text(own, sizeof own, 1e-9 * pack->youngs.value, 4), range);
}

void fw_plan_look_at_material(fw_plan *plan, const fw_plan_flow *pf, const fw_device_material *m) {
    check_orientation(plan, pf, m);
    check_modulus(plan, pf, m);
}
