/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The verdict of a design, and what is asked beside it: motions, positions and kinematics, equilibria and
   modes, the workspace. */
#include "assembly/assembly.h"
#include "plan/stages.h"
#include "probe/probe.h"
#include "process/process.h"
#include "statics/statics.h"
#include "workspace/reach.h"
#include <math.h>
#include <string.h>

/* ---- corners as text ----
   A corner of all flows of a device, in a form that holds for other devices of the same flows, whose ranges may be others: for
   each flow a letter for each of its inputs, l at its lower end, h at its upper one, n between, and ';' between flows.
   "": of some flow no corner was looked at, or there are too many inputs to say it. Test: tests/cli/test_sizing.py, AsMade */

void fw_plan_corner_text(const fw_plan *plan, char text[FW_PLAN_CORNER]) {
    size_t at = 0;
    text[0] = '\0';
    for (int i = 0; i < plan->verdict.nvariant; i++) {
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
        const size_t more = (size_t)v->ninput + 1;
        if ((v->ninput > 0 && !v->fabricated) || at + more + 1 > FW_PLAN_CORNER) {
            text[0] = '\0';
            return;
        }
        if (i > 0) text[at++] = ';';
        for (int k = 0; k < v->ninput; k++) {
            const fw_verdict_fabrication_input *in = &v->input[k];
            const double x = v->fabricated->corner[v->fabricated->at].x[k];
            text[at++] = x <= in->low && in->low < in->nominal     ? 'l'
                         : x >= in->high && in->high > in->nominal ? 'h'
                                                                   : 'n';
        }
        text[at] = '\0';
    }
}

/* the letters of flow i; NULL: it has none */
static const char *letters_of(const char *text, int i) {
    while (i > 0 && text)
        text = strchr(text, ';'), text = text ? text + 1 : NULL, i--;
    return text && *text && *text != ';' ? text : NULL;
}

/* the corners of the options in the ranges that flow i has for this device, each once */
static fw_status watch_corners(const fw_plan_options *o, fw_arena *arena, int i,
                               fw_verdict_variant_verdict *v) {
    const size_t n = (size_t)v->ninput;
    double *x = fw_arena_array(arena, double, (size_t)o->nwatched *n + 1);
    FW_NEED(x);
    v->suspect = x, v->nsuspect = 0;
    for (int j = 0; j < o->nwatched; j++) {
        const char *letter = letters_of(o->watched[j], i);
        bool there = !letter || strcspn(letter, ";") != n;
        for (int k = 0; k < j && !there; k++) {
            const char *other = letters_of(o->watched[k], i);
            there = other && strncmp(other, letter, n) == 0;
        }
        if (there) continue;
        double *to = x + (size_t)v->nsuspect++ * n;
        for (size_t k = 0; k < n; k++)
            to[k] = letter[k] == 'l'   ? v->input[k].low
                    : letter[k] == 'h' ? v->input[k].high
                                       : v->input[k].nominal;
    }
    return FW_OK;
}

/* ---- the verdict and motions ---- */

/* the same with the gaps of the drawing: the facts that fw_plan_compute_flows has, hence the same
   edges as mask and recipe. The variant may be one of a description read again. */
static fw_status fabricated_of(void *context, fw_arena *arena, const fw_device *device,
                               const fw_layout *layout, int i, fw_verdict_variant_verdict *v) {
    const fw_plan *plan = context;
    const fw_plan_flow *pf = &plan->flow[i];
    fw_process_mask_facts facts;
    if (!pf->flow || !layout || !layout->drawn) return FW_OK;
    FW_TRY(fw_plan_edge_facts(arena, device, layout, pf, v->variant, &facts));
    FW_TRY(fw_plan_join_swept(plan, arena, i, &facts));
    FW_TRY(fw_process_flow_fabricated(arena, pf->flow, &facts, v->variant, &v->input, &v->ninput));
    return plan->options.nwatched > 0 ? watch_corners(&plan->options, arena, i, v) : FW_OK;
}

static fw_status restated(void *plan, fw_arena *arena, const fw_device_set *set, int nset,
                          const fw_device **device, fw_verdict_variant_verdict *variant) {
    return fw_plan_restated((const fw_plan *)plan, arena, set, nset, NULL, device, variant);
}

/* how tethers are broken, and which of them stand in the way of their own bodies */
static fw_status find_tethers(fw_plan *plan, const fw_verdict_variant_verdict *v,
                              const fw_statics_tethers **out) {
    if (!v->mechanism || plan->options.verdict.bounded) return FW_OK; /* nobody reads them */
    FW_TRY(fw_statics_tethers_find(plan->arena, v->mechanism, out));
    const bool watched = *out && v->motion;
    for (int k = 0; watched && k < plan->device->nscene; k++) {
        const fw_dynamics_motion *x = v->motion[k];
        if (!x || !x->q) continue;
        fw_dynamics_motion_rows(x, 0, x->nsample);
        fw_statics_tethers_watch(*out, v->mechanism, plan->device->scene[k].name, x->q, x->nsample);
    }
    return FW_OK;
}

/* cells that lie where they must not are a mistake of the file, which is said before anything is computed */
static fw_status check_cells(fw_plan *plan) {
    const fw_layout *layout = NULL;
    fw_diags quiet = fw_diags_new(plan->arena); /* the verdict says the rest */
    if (plan->device->ncell == 0) return FW_OK;
    fw_status status = fw_layout_build(plan->arena, plan->device, &quiet, &layout);
    if (status == FW_GEOMETRY || status == FW_INPUT || !layout || !layout->drawn) return FW_OK;
    FW_TRY(status);
    return fw_layout_cells_check(layout, &plan->diags);
}

/* drivers, and what is touched and not drawn: said once, and kept for certificate, report and recipe */
static fw_status say_outside(fw_plan *plan) {
    FW_TRY(fw_verdict_outside(plan->arena, plan->device, &plan->verdict, &plan->outside,
                              &plan->noutside));
    for (int i = 0; i < plan->noutside; i++)
        fw_diag_note(&plan->diags, plan->outside[i].number, plan->outside[i].place, "%s",
                     plan->outside[i].text);
    return FW_OK;
}

/* A proposal accepts by motion and drawing. Where a flow cannot make the device as it is, for a reason that has a nearest
   change of its own (a margin, a layer), each proposal says that this is another matter, so that nobody takes one change
   for both. */
static fw_status say_apart(fw_plan *plan) {
    fw_verdict *v = &plan->verdict;
    const char *flow = NULL;
    for (int i = 0; i < plan->nflow && !flow; i++)
        if (plan->flow[i].flow && plan->flow[i].flow->manufacturable == 0)
            flow = plan->flow[i].flow->id;
    for (int i = 0; flow && i < v->nproposal + v->nparameter; i++) {
        const int k = i - v->nproposal;
        const char **text = k < 0 ? &v->proposal[i].text : &v->parameter[k].text;
        if (k >= 0 && v->parameter[k].found != FW_PARAMETER_ACCEPTS) continue;
        FW_NEED(*text = fw_arena_printf(plan->arena,
                                        "%s; that it cannot be made in %s is another matter", *text,
                                        flow));
    }
    return FW_OK;
}

fw_status fw_plan_judge(fw_plan *plan) {
    fw_verdict *verdict = &plan->verdict;
    FW_TRY(fw_plan_need_material(plan));
    FW_TRY(check_cells(plan));
    FW_TRY(fw_plan_find_swept(plan));
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
    FW_TRY(say_outside(plan));
    if (verdict->decision == FW_REJECT)
        FW_TRY(fw_verdict_rejections(plan->arena, verdict, &plan->because, &plan->nbecause));
    FW_TRY(fw_plan_compute_flows(plan));
    if (!plan->options.without_masks) FW_TRY(fw_plan_masks_examine(plan));
    FW_TRY(say_apart(plan));
    for (int i = 0; i < plan->nflow; i++)
        FW_TRY(find_tethers(plan, &verdict->variant[i], &plan->flow[i].tethers));
    return fw_plan_measurements_find(plan, false);
}

fw_status fw_plan_judge_shown(fw_plan *plan) {
    const fw_device *d = plan->device;
    const char *wanted = plan->options.scene;
    fw_verdict_options options = plan->options.verdict;
    plan->verdict = (fw_verdict){.nvariant = 0};
    for (int k = 0; k < d->nscene; k++)
        for (int i = 0; i < plan->nflow; i++) {
            const fw_device_scene *scene = &d->scene[k];
            if (wanted && strcmp(wanted, scene->name) != 0) continue;
            if (!fw_device_in_flow(scene->flow, plan->flow[i].variant.flow)) continue;
            FW_TRY(fw_plan_need_material(plan));
            plan->verdict.nvariant = 1;
            FW_NEED(plan->verdict.variant = fw_arena_one(plan->arena, fw_verdict_variant_verdict));
            plan->verdict.variant->variant = &plan->flow[i].variant;
            options.only_scene = scene->name;
            options.hinges_only = options.at_a_glance = options.bounded = true;
            options.corners = FW_CORNERS_NONE;
            return fw_verdict_run(plan->arena, d, &options, &plan->diags, &plan->verdict,
                                  &plan->layout);
        }
    return FW_OK;
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
    const char **name = fw_arena_array(plan->arena, const char *, (size_t)d->nscene);
    if (!name) {
        plan->diags.failed = 1;
        return NULL;
    }
    for (int i = 0; i < d->nscene; i++) {
        const fw_device_scene *scene = &d->scene[i];
        name[i] = scene->name;
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
    const char *near = wanted ? fw_did_you_mean(wanted, name, (size_t)d->nscene) : NULL;
    if (wanted)
        fw_diag_error(&plan->diags, 229, (fw_place){.file = d->file},
                      "no scene '%s' in the device%s%s%s; it has%s", wanted,
                      near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "", has);
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
        if (d->ended == FW_ENDED_NOT) continue;
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
        FW_TRY(fw_probe_monitor_new(plan->arena, m, scene, NULL, NULL, &both[i]));
    options->observe = fw_probe_monitor_record;
    options->trace = fw_probe_monitor_trace;
    options->trace_both = true;
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
    FW_TRY(fw_verdict_level_strains(plan->arena, *mechanism, (*motion)->loads, (*motion)->level,
                                    NULL));
    FW_TRY(fw_statics_stability_find(plan->arena, *mechanism, *scene, *motion, &plan->diags,
                                     &stability, NULL, NULL));
    note_tolerance(plan, options.rtol, (*motion)->stats.rtol);
    return FW_OK;
}

/* ---- positions, equilibria, modes, the workspace ---- */

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
    return fw_verdict_level_strains(plan->arena, *mechanism, (*statics)->loads, (*statics)->level,
                                    NULL);
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
    FW_TRY(fw_workspace_required(plan->arena, f->mechanism, NULL, &plan->diags, required));
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
