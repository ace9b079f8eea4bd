/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "assembly/assembly.h"
#include "plan/stages.h"
#include "probe/probe.h"
#include "process/process.h"
#include "statics/quasi.h"
#include "statics/tethers.h"
#include <math.h>
#include <string.h>

/* the same with the gaps of the drawing: the facts that fw_plan_compute_flows has, hence the same
   edges as mask and recipe. The variant may be one of a description read again. */
static fw_status fabricated_of(void *context, fw_arena *arena, const fw_device *device,
                               const fw_layout *layout, int i, fw_verdict_variant_verdict *v) {
    const fw_plan_flow *pf = &((const fw_plan *)context)->flow[i];
    fw_process_mask_facts facts;
    if (!pf->flow || !layout || !layout->drawn) return FW_OK;
    FW_TRY(fw_plan_mask_facts(arena, device, layout, v->variant, pf->table, fw_plan_insulated(pf),
                              &facts));
    return fw_process_flow_fabricated(arena, pf->flow, &facts, v->variant, &v->input, &v->ninput);
}

static fw_status restated(void *plan, fw_arena *arena, const fw_device_set *set, int nset,
                          const fw_device **device, fw_verdict_variant_verdict *variant) {
    return fw_plan_restated((const fw_plan *)plan, arena, set, nset, device, variant);
}

/* how tethers are broken, and which of them stand in the way of their own bodies */
static fw_status find_tethers(fw_plan *plan, const fw_verdict_variant_verdict *v,
                              const fw_statics_tethers **out) {
    if (!v->mechanism) return FW_OK;
    FW_TRY(fw_statics_tethers_find(plan->arena, v->mechanism, out));
    for (int k = 0; *out && v->motion && k < plan->device->nscene; k++) {
        const fw_dynamics_motion *x = v->motion[k];
        if (!x || !x->q) continue;
        fw_dynamics_motion_rows(x, 0, x->nsample);
        fw_statics_tethers_watch(*out, v->mechanism, plan->device->scene[k].name, x->q, x->nsample);
    }
    return FW_OK;
}

fw_status fw_plan_judge(fw_plan *plan) {
    fw_verdict *verdict = &plan->verdict;
    FW_TRY(fw_plan_need_material(plan));
    *verdict = (fw_verdict){.nvariant = plan->nflow};
    FW_NEED(verdict->variant =
                fw_arena_array(plan->arena, fw_verdict_variant_verdict, (size_t)plan->nflow));
    for (int i = 0; i < plan->nflow; i++)
        FW_TRY(fw_plan_fabricated_of(plan->arena, &plan->flow[i], &verdict->variant[i]));
    fw_verdict_options options = plan->options.verdict;
    options.restated = (fw_verdict_restated){restated, plan};
    options.fabricated_of = (fw_verdict_fabricated_of){fabricated_of, plan};
    FW_TRY(
        fw_verdict_run(plan->arena, plan->device, &options, &plan->diags, verdict, &plan->layout));
    FW_TRY(fw_verdict_advise(plan->arena, plan->device, &options, verdict));
    if (verdict->decision == FW_REJECT)
        FW_TRY(fw_verdict_rejections(plan->arena, verdict, &plan->because, &plan->nbecause));
    FW_TRY(fw_plan_compute_flows(plan));
    for (int i = 0; i < plan->nflow; i++)
        FW_TRY(find_tethers(plan, &verdict->variant[i], &plan->flow[i].tethers));
    return fw_plan_measurements_find(plan, false);
}

static bool loaded(const fw_plan *plan, const char *flow) {
    for (int i = 0; i < plan->nflow; i++)
        if (fw_device_in_flow(flow, plan->flow[i].variant.flow)) return true;
    return false;
}

/* the named scene, else the first one that holds in a flow of this plan */
const fw_device_scene *fw_plan_scene(fw_plan *plan) {
    const fw_device *d = plan->device;
    const char *wanted = plan->options.scene;
    fw_text names = fw_text_new(plan->arena);
    for (int i = 0; i < d->nscene; i++) {
        const fw_device_scene *scene = &d->scene[i];
        if (wanted ? strcmp(scene->name, wanted) == 0 : loaded(plan, scene->flow)) {
            if (loaded(plan, scene->flow)) return scene;
            fw_diag_error(&plan->diags, 229, scene->place,
                          "scene '%s' applies to flow %s only, and --flow selects %s", scene->name,
                          scene->flow, plan->options.flow);
            return NULL;
        }
        fw_text_printf(&names, " %s", scene->name);
    }
    const char *has = names.length && !names.failed ? names.data : " none";
    if (wanted)
        fw_diag_error(&plan->diags, 229, (fw_place){.file = d->file},
                      "no scene '%s' in the device; it has%s", wanted, has);
    else
        fw_diag_error(&plan->diags, 229, (fw_place){.file = d->file},
                      "the device has no scene for this flow; it has%s", has);
    return NULL;
}

/* a scene that belongs to one flow is run in that flow, else in the first one */
static const fw_mechanism_variant *variant_of(const fw_plan *plan, const fw_device_scene *scene) {
    for (int i = 0; scene && scene->flow && i < plan->nflow; i++)
        if (plan->flow[i].variant.flow && strcmp(plan->flow[i].variant.flow, scene->flow) == 0)
            return &plan->flow[i].variant;
    return &plan->flow[0].variant;
}

fw_status fw_plan_mechanism(fw_plan *plan, const fw_device_scene *scene,
                            const fw_mechanism **mechanism) {
    bool from_shapes = fw_device_needs_shapes(plan->device); /* only then is the drawing needed */
    fw_diags drawing = fw_diags_new(plan->arena);
    fw_status status = fw_layout_build(plan->arena, plan->device,
                                       from_shapes ? &plan->diags : &drawing, &plan->layout);
    if (status != FW_OK && (from_shapes || (status != FW_GEOMETRY && status != FW_INPUT)))
        return status;
    return fw_mechanism_build(plan->arena, plan->device, plan->layout, variant_of(plan, scene),
                              &plan->diags, mechanism);
}

/* poses that leave joints open are a guess: effects, motion and pictures start from closed ones */
fw_status fw_plan_start(fw_plan *plan, const fw_mechanism **mechanism,
                        const fw_device_scene **scene, double *moved_m) {
    if (!*scene) *scene = fw_plan_scene(plan);
    if (!*scene) return FW_INPUT;
    if (!plan->start.mechanism || plan->start.scene != *scene) {
        plan->start.mechanism = NULL;
        FW_TRY(fw_plan_mechanism(plan, *scene, mechanism));
        FW_TRY(fw_assembly_assembled(plan->arena, *mechanism, &plan->diags, mechanism,
                                     &plan->start.moved_m));
        plan->start.mechanism = *mechanism;
        plan->start.scene = *scene;
    }
    *mechanism = plan->start.mechanism;
    *scene = fw_mechanism_scene(*mechanism, plan->device, *scene);
    if (moved_m) *moved_m = plan->start.moved_m;
    return FW_OK;
}

/* a tolerance that was asked for and not used */
static void note_tolerance(fw_plan *plan, double asked, double used) {
    if (!(asked > 0) || fabs(used - asked) <= 1e-9 * asked) return;
    char a[32], u[32];
    fw_number_text(a, sizeof a, asked, 3);
    fw_number_text(u, sizeof u, used, 3);
    if (used < asked)
        fw_diag_note(&plan->diags, 232, (fw_place){0},
                     "rtol %s: %s is used, the loosest at which error estimates hold", a, u);
    else
        fw_diag_warning(&plan->diags, 232, (fw_place){0},
                        "rtol %s: %s is used, the tightest that round-off leaves room for", a, u);
}

/* electrodes that touched (the messages from `from` on say so): was it the voltage as such? */
static fw_status explain_pull_in(fw_plan *plan, const fw_statics_pull_in *pull_in, size_t from) {
    for (size_t i = from; pull_in && i < plan->diags.count; i++) {
        const fw_diag *d = &plan->diags.item[i];
        if (d->number != 242 || d->severity != FW_ERROR) continue;
        const char *text = fw_statics_pull_in_explain(plan->arena, pull_in);
        FW_NEED(text);
        fw_diag_warning(&plan->diags, 242, d->place, "%s", text);
        break;
    }
    return FW_SOLVER;
}

/* two runs are looked at: what they differ by is the error of a probe */
static fw_status watch_probes(fw_plan *plan, const fw_mechanism *m, const fw_device_scene *scene,
                              fw_dynamics_motion_options *options) {
    fw_probe_monitor *both;
    if (fw_probe_count(m) == 0) return FW_OK;
    FW_NEED(both = fw_arena_array(plan->arena, fw_probe_monitor, 2));
    for (int i = 0; i < 2; i++)
        FW_TRY(fw_probe_monitor_new(plan->arena, m, scene, NULL, &both[i]));
    options->observe = fw_probe_monitor_record;
    options->trace = fw_probe_monitor_trace;
    options->whole = true;
    options->context = &both[0], options->other = &both[1];
    return FW_OK;
}

fw_status fw_plan_simulate(fw_plan *plan, unsigned *wanted, const fw_dynamics_motion **motion,
                           const fw_mechanism **mechanism, const fw_device_scene **scene) {
    *scene = NULL;
    fw_dynamics_motion_options options = plan->options.verdict.motion;
    FW_TRY(fw_plan_start(plan, mechanism, scene, &options.moved_m));
    if (!(options.rtol > 0)) *wanted |= FW_WANTED_FIGURES;
    options.reactions = *wanted & FW_WANTED_FIGURES;
    options.energies = *wanted & FW_WANTED_ENERGIES;
    options.alone = options.late_rows = !options.reactions;
    FW_TRY(watch_probes(plan, *mechanism, *scene, &options));
    const fw_statics_pull_in *pull_in;     /* it says why a run may end early */
    const fw_statics_stability *stability; /* only its warning */
    FW_TRY(fw_statics_pull_in_find(plan->arena, *mechanism, *scene, &options.effects, &plan->diags,
                                   &pull_in));
    size_t said = plan->diags.count;
    fw_status status =
        fw_statics_move_scene(plan->arena, *mechanism, *scene, &options, &plan->diags, motion);
    if (status == FW_SOLVER) return explain_pull_in(plan, pull_in, said);
    FW_TRY(status);
    const fw_probe_monitor *saw = options.context;
    if (saw && (saw[0].no_memory || saw[1].no_memory)) return FW_NOMEM;
    FW_TRY(fw_verdict_level_strains(plan->arena, *mechanism, (*motion)->level));
    FW_TRY(fw_statics_stability_find(plan->arena, *mechanism, *scene, *motion, &plan->diags,
                                     &stability));
    note_tolerance(plan, options.rtol, (*motion)->stats.rtol);
    return FW_OK;
}
