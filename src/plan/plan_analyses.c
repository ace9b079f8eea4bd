/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of a design beside its verdict: positions and kinematics, equilibria and modes, the
   workspace. */
#include "plan/stages.h"
#include "workspace/survey.h"
#include <math.h>
#include <string.h>

static void guess_of(const fw_mechanism *m, double *q) {
    for (int b = 0; b < m->nbody; b++) {
        q[3 * b] = m->body[b].x_m;
        q[3 * b + 1] = m->body[b].y_m;
        q[3 * b + 2] = m->body[b].phi_rad;
    }
}

static fw_status usage(fw_status status) {
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* "10 rad/s, 0.2 mm/s": values with units, one per independent coordinate; power 1: rates, 2:
   accelerations */
static fw_status read_values(fw_plan *plan, const char *list, const char *option,
                             const fw_assembly_coordinate_choice *choice, int power,
                             double *value) {
    int count = 0;
    for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
        count++;
    if (count != choice->count)
        return usage(fw_diag_error(&plan->diags, 119, (fw_place){0},
                                   "--%s has %d value%s, and there %s %d independent coordinate%s "
                                   "(%s)",
                                   option, count, count == 1 ? "" : "s",
                                   choice->count == 1 ? "is" : "are", choice->count,
                                   choice->count == 1 ? "" : "s", choice->text));
    const fw_quantity_names none = {NULL, 0};
    for (int i = 0; i < count; i++) {
        size_t n = strcspn(list, ",");
        const fw_quantity_dimension wanted = {
            .m = choice->item[i].axis < 2, .rad = choice->item[i].axis == 2, .s = (int8_t)-power};
        fw_quantity_expression_error error;
        fw_status status =
            fw_quantity_expression_evaluate(plan->arena, list, n, &none, wanted, &value[i], &error);
        if (status == FW_INPUT)
            return usage(fw_diag_error(&plan->diags, 119, (fw_place){0}, "--%s, value %d: %s",
                                       option, i + 1, error.message));
        FW_TRY(status);
        list += n + (list[n] == ',');
    }
    return FW_OK;
}

static fw_status kinematics(fw_plan *plan, fw_plan_assembly *out) {
    const fw_plan_options *o = &plan->options;
    fw_assembly_kinematics_options options = {.independent = o->independent,
                                              .accuracy = o->verdict.motion.accuracy,
                                              .effects = o->verdict.motion.effects};
    const fw_mechanism *m = out->mechanism;
    const double *q = out->assembly->after;
    bool asked = o->independent || o->rates || o->accelerations;
    if (!asked && (m->nbody > FW_KINEMATICS_MOST / 3 || !out->assembly->rank.clear)) return FW_OK;
    FW_TRY(fw_assembly_kinematics_solve(plan->arena, m, out->scene, q, &options, &plan->diags,
                                        &out->kinematics));
    out->motion = m->ndriver > 0 || o->rates || o->accelerations;
    if (!o->rates && !o->accelerations) return FW_OK;
    const fw_assembly_coordinate_choice *choice = &out->kinematics->independent;
    double *rate, *accel;
    FW_NEED(rate = fw_arena_array(plan->arena, double, (size_t)choice->count));
    FW_NEED(accel = fw_arena_array(plan->arena, double, (size_t)choice->count));
    if (o->rates) FW_TRY(read_values(plan, o->rates, "rates", choice, 1, rate));
    if (o->accelerations)
        FW_TRY(read_values(plan, o->accelerations, "accelerations", choice, 2, accel));
    options.independent = choice->text;
    options.rate = rate, options.accel = accel;
    options.nrate = options.naccel = choice->count;
    bool automatic = choice->automatic;
    fw_assembly_kinematics *with;
    FW_TRY(fw_assembly_kinematics_solve(plan->arena, m, out->scene, q, &options, &plan->diags,
                                        &out->kinematics));
    FW_NEED(with = fw_arena_one(plan->arena, fw_assembly_kinematics));
    *with = *out->kinematics;
    with->independent.automatic = automatic;
    out->kinematics = with;
    return FW_OK;
}

fw_status fw_plan_assemble(fw_plan *plan, fw_plan_assembly *out) {
    double *q;
    *out = (fw_plan_assembly){0};
    if (plan->device->nscene > 0 || plan->options.scene) {
        out->scene = fw_plan_scene(plan);
        if (!out->scene) return FW_INPUT; /* said there */
    }
    FW_TRY(fw_plan_mechanism(plan, out->scene, &out->mechanism));
    out->scene = fw_mechanism_scene(out->mechanism, plan->device, out->scene);
    FW_NEED(q = fw_arena_array(plan->arena, double, 3 * (size_t)out->mechanism->nbody));
    guess_of(out->mechanism, q);
    fw_assembly *assembly = NULL;
    fw_status status = fw_assembly_solve(plan->arena, out->mechanism, q, &plan->diags, &assembly);
    out->assembly = assembly;
    FW_TRY(status);
    out->closed = true;
    return kinematics(plan, out);
}

/* ---- equilibria and modes of one scene ---- */

enum { DRAWN_MODES = 12 };

/* modes about rest need no scene: one without loads stands in where the device has none */
static const fw_device_scene without_loads = {.name = "(none)", .duration_s = 1.0};

fw_status fw_plan_modes(fw_plan *plan, const fw_statics_modes **modes,
                        const fw_mechanism **mechanism, const fw_device_scene **scene) {
    const fw_statics_mode_options o = {.effects = plan->options.verdict.motion.effects,
                                       .accuracy = plan->options.verdict.motion.accuracy,
                                       .at_equilibrium = plan->options.at_equilibrium,
                                       .drawn = DRAWN_MODES};
    *scene = NULL;
    if (plan->device->nscene == 0 && !plan->options.scene && !o.at_equilibrium)
        *scene = &without_loads;
    FW_TRY(fw_plan_start(plan, mechanism, scene, NULL));
    return fw_statics_small_motions(plan->arena, *mechanism, *scene, &o, &plan->diags, modes);
}

fw_status fw_plan_statics(fw_plan *plan, const fw_statics **statics, const fw_mechanism **mechanism,
                          const fw_device_scene **scene) {
    const fw_statics_static_options o = {.effects = plan->options.verdict.motion.effects,
                                         .accuracy = plan->options.verdict.motion.accuracy,
                                         .path = plan->options.path};
    *scene = NULL;
    FW_TRY(fw_plan_start(plan, mechanism, scene, NULL));
    FW_TRY(fw_statics_solve(plan->arena, *mechanism, *scene, &o, &plan->diags, statics));
    return fw_verdict_level_strains(plan->arena, *mechanism, (*statics)->level);
}

/* ---- the workspace of every flow ---- */

/* what could not be proved, at the place of the box */
static void warn(fw_plan *plan, const fw_report_workspace_flow *f) {
    const fw_device *d = plan->device;
    for (int k = 0; k < d->nworkspace; k++)
        if (f->required->asked[k] && f->required->box_reachable[k] && !f->required->proof[k].proved)
            fw_diag_warning(&plan->diags, 218, d->workspace[k].place,
                            "the required workspace could not be proved: a leg comes close to "
                            "stretched or folded, or a hinge to half a turn; its angles are from "
                            "samples");
    const fw_workspace_measure *v = &f->map->volume;
    if (f->map->none || v->reached) return;
    char width[32];
    double relative = 100.0 * (v->value.hi - v->value.lo) / v->value.hi;
    const char *flow = f->flow ? f->flow : "", *colon = f->flow ? ": " : "";
    fw_number_text(width, sizeof width, relative, 2);
    if (relative > 1.0)
        fw_diag_warning(&plan->diags, 219, (fw_place){.file = d->file},
                        "%s%sthe volume of the workspace is certified to %s %% only: within these "
                        "limits a leg comes close to stretched or folded, where boxes close in "
                        "slowly; the truth may lie anywhere in the bracket",
                        flow, colon, width);
    else
        fw_diag_note(&plan->diags, 219, (fw_place){0},
                     "%s%sthe volume of the workspace is certified to %s %% only", flow, colon,
                     width);
}

static fw_status one_flow(fw_plan *plan, const fw_plan_flow *pf, fw_report_workspace_flow *f) {
    const fw_device *d = plan->device;
    fw_workspace_map *map = fw_arena_one(plan->arena, fw_workspace_map);
    fw_workspace_result *required = fw_arena_one(plan->arena, fw_workspace_result);
    fw_workspace_regularity *singular =
        fw_arena_array(plan->arena, fw_workspace_regularity, (size_t)d->nworkspace);
    FW_NEED(map);
    FW_NEED(required);
    FW_NEED(singular);
    f->flow = pf->variant.flow;
    f->map = map, f->required = required, f->singular = singular;
    FW_TRY(fw_mechanism_build(plan->arena, d, plan->layout, &pf->variant, &plan->diags,
                              &f->mechanism));
    FW_TRY(fw_workspace_required(plan->arena, f->mechanism, &plan->diags, required));
    FW_TRY(fw_workspace_map_make(plan->arena, f->mechanism, fw_workspace_usual, map));
    for (int k = 0; k < d->nworkspace; k++) {
        const fw_workspace_proof *p = &required->proof[k];
        if (!p->proved) continue;
        const fw_workspace_box3 box = {{p->low[0], p->low[1], p->low[2]},
                                       {p->high[0], p->high[1], p->high[2]}};
        FW_TRY(fw_workspace_required_survey(plan->arena, &map->loop, &box, &singular[k]));
    }
    warn(plan, f);
    return FW_OK;
}

fw_status fw_plan_workspace(fw_plan *plan, fw_report_workspace *workspace) {
    const fw_device *d = plan->device;
    if (!d->six_bar)
        return fw_diag_error(&plan->diags, 217, (fw_place){.file = d->file},
                             "%s is not described by a <six-bar>, whose closed-form inverse "
                             "kinematics the workspace needs: use scenes instead",
                             d->name);
    FW_TRY(fw_plan_need_material(plan));
    fw_diags drawing =
        fw_diags_new(plan->arena); /* what cannot be drawn can be moved all the same */
    bool from_shapes = fw_device_needs_shapes(d);
    fw_status status =
        fw_layout_build(plan->arena, d, from_shapes ? &plan->diags : &drawing, &plan->layout);
    if (status != FW_OK && (from_shapes || (status != FW_GEOMETRY && status != FW_INPUT)))
        return status;
    fw_report_workspace_flow *flow =
        fw_arena_array(plan->arena, fw_report_workspace_flow, (size_t)plan->nflow);
    FW_NEED(flow);
    *workspace = (fw_report_workspace){.device = d, .flow = flow, .nflow = plan->nflow};
    for (int i = 0; i < plan->nflow; i++)
        FW_TRY(one_flow(plan, &plan->flow[i], &flow[i]));
    return FW_OK;
}
