/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/compare.h"
#include "verdict/scene.h"
#include "verdict/watch.h"
#include <math.h>

/* motion: largest difference of any hinge's peak section moment, joint force included, between
   ideal pins and geometrically exact flexures over the four reference load cases of a whole
   six-bar, 2.9 % (0.7 % at the governing hinge); strain: largest error of the closed form on
   held-out shapes, 2.9 %; workspace: largest moment that joint forces added at the governing hinge
   in the same cases, 21 % */
const fw_model_error fw_verdict_model_error = {0.029, 0.029, 0.21};

const char *fw_decision_text(fw_decision decision) {
    switch (decision) {
    case FW_ACCEPT:
        return "accept";
    case FW_INCONCLUSIVE:
        return "inconclusive";
    case FW_REJECT:
        return "reject";
    }
    return "inconclusive";
}

static fw_decision decide(double low, double high) {
    if (low > 1.0) return FW_REJECT;
    return high < 1.0 ? FW_ACCEPT : FW_INCONCLUSIVE;
}

/* the worse decision, then the higher utilisation; the band holds that of both */
void fw_verdict_keep_worst(fw_hinge_verdict *worst, const fw_hinge_verdict *other) {
    double low = fmax(worst->utilisation_low, other->utilisation_low);
    double high = fmax(worst->utilisation_high, other->utilisation_high);
    if (!worst->scene || fw_verdict_governs(other, worst)) *worst = *other;
    worst->utilisation_low = low;
    worst->utilisation_high = high;
}

bool fw_verdict_governs(const fw_hinge_verdict *h, const fw_hinge_verdict *other) {
    if (h->decision != other->decision) return h->decision > other->decision;
    return h->utilisation > other->utilisation;
}

/* twice the standard uncertainty that a shape outside the fitted range has on top of the model
 * error */
static double beyond_fit(const fw_flexure_result *c) {
    return 2.0 * (c->limit_uncertainty - FW_FLEXURE_STRAIN_UNCERTAINTY);
}

/* the solids meet first: what happens then is not in the model, so it cannot be accepted */
static void collide(const fw_hinge_layout *drawn, fw_hinge_verdict *out) {
    out->touches = drawn && drawn->drawn && drawn->free_rad > 0.0 &&
                   fabs(out->peak_angle_rad) > drawn->free_rad;
    if (out->touches && out->decision == FW_ACCEPT) out->decision = FW_INCONCLUSIVE;
}

/* utilisation = peak strain (rotation and joint force, fillets included) over the limit strain, and
   never less than peak angle / limit angle; band = model errors of it, and the numerical errors of
   the angle over the limit angle and of the search for the strain */
static void judge_scene(const fw_mechanism *m, const fw_hinge *hinge, const fw_hinge_layout *drawn,
                        const fw_motion *motion, const fw_strain_peak *strain, const char *scene,
                        fw_hinge_verdict *out) {
    const fw_peak *peak = &motion->peak[hinge->pin];
    const fw_flexure_result *c = &hinge->closed_form;
    double by_angle = fabs(peak->angle_rad) / c->limit_angle_rad;
    double by_strain = strain->strain / out->strain_limit;
    *out = (fw_hinge_verdict){.id = out->id,
                              .joint = out->joint,
                              .strain_limit = out->strain_limit,
                              .limit_angle_rad = c->limit_angle_rad,
                              .flow = m->variant->flow,
                              .scene = scene,
                              .peak_angle_rad = peak->angle_rad,
                              .angle_error_rad = peak->error_rad};
    out->utilisation = fmax(by_angle, by_strain);
    out->peak_strain = out->utilisation * out->strain_limit;
    out->force_share = by_strain > by_angle ? 1.0 - by_angle / by_strain : 0.0;
    out->t_s = by_strain > by_angle ? strain->t_s : peak->t_s;
    /* a run that was ended went a whole turn: no error of its own changes that */
    double numeric = motion->ended ? 0.0
                                   : out->angle_error_rad / c->limit_angle_rad +
                                         strain->between / out->strain_limit;
    double model = fw_motion_model_error(m, motion) + fw_verdict_model_error.strain + beyond_fit(c);
    out->utilisation_low = fmax(0.0, out->utilisation * (1.0 - model) - numeric);
    out->utilisation_high = out->utilisation * (1.0 + model) + numeric;
    out->decision = decide(out->utilisation_low, out->utilisation_high);
    collide(drawn, out);
}

static void judge_workspace(const fw_mechanism *m, const fw_hinge *hinge,
                            const fw_hinge_layout *drawn, const fw_workspace_result *workspace,
                            fw_hinge_verdict *out) {
    const fw_workspace_peak *peak = &workspace->peak[hinge->pin];
    const fw_flexure_result *c = &hinge->closed_form;
    *out = (fw_hinge_verdict){.id = out->id,
                              .joint = out->joint,
                              .strain_limit = out->strain_limit,
                              .limit_angle_rad = c->limit_angle_rad,
                              .flow = m->variant->flow,
                              .scene = "workspace",
                              .peak_angle_rad = peak->angle_rad,
                              .angle_error_rad = peak->error_rad,
                              .t_s = (double)NAN};
    out->utilisation = fabs(peak->angle_rad) / c->limit_angle_rad;
    out->peak_strain = out->utilisation * out->strain_limit;
    double numeric = peak->error_rad / c->limit_angle_rad;
    double model = fw_verdict_model_error.strain + beyond_fit(c);
    out->utilisation_low = fmax(0.0, out->utilisation * (1.0 - model) - numeric);
    out->utilisation_high =
        out->utilisation * (1.0 + model + fw_verdict_model_error.workspace) + numeric;
    out->decision = decide(out->utilisation_low, out->utilisation_high);
    collide(drawn, out);
}

/* a hinge that has turned once is past every limit: the rest of the scene is not needed */
static const double whole_turn = 6.283185307179586;

static void warn_ended(const fw_scene *scene, const fw_motion *motion, fw_diags *diags) {
    char t[32];
    fw_diag_warning(diags, 205, scene->place,
                    "scene %s was ended after %s ms, when a joint had turned by more than a whole "
                    "turn: the load is far beyond what these hinges can take; lower it",
                    scene->name, fw_number_text(t, sizeof t, motion->end_s * 1e3, 4));
}

/* runs every scene of this variant; watch[i] has its strain peaks */
static fw_status run_scenes(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                            const fw_mechanism *m, const fw_verdict_options *options,
                            fw_diags *diags, fw_variant_verdict *v, fw_watch *watch) {
    size_t n = (size_t)device->nscene;
    fw_motion_options motion = options->motion;
    motion.within_limits = true;
    if (motion.most_angle_rad <= 0) motion.most_angle_rad = whole_turn;
    FW_NEED(v->motion = fw_arena_alloc(arena, n, sizeof *v->motion));
    FW_NEED(v->pull_in = fw_arena_alloc(arena, n, sizeof *v->pull_in));
    FW_NEED(v->reason = fw_arena_array(arena, fw_reason, FW_REASONS * n));
    for (size_t i = 0; i < n; i++) {
        const fw_scene *scene = &device->scene[i];
        if (!fw_device_in_flow(scene->flow, m->variant->flow)) continue;
        FW_TRY(fw_watch_new(arena, m, layout, &watch[i]));
        motion.observe = fw_watch_see;
        motion.context = &watch[i];
        FW_TRY(fw_verdict_scene(arena, scene, (int)i, &motion, diags, v));
        if (watch[i].no_memory) return FW_NOMEM;
        if (v->motion[i]) FW_TRY(fw_level_strains(arena, m, v->motion[i]->level));
        if (v->motion[i] && v->motion[i]->ended) warn_ended(scene, v->motion[i], diags);
    }
    return FW_OK;
}

static void warn_touching(const fw_device *device, const fw_hinge_layout *drawn,
                          const fw_hinge_verdict *h, fw_diags *diags) {
    char peak[32], free_turn[32];
    double degrees = 180.0 / acos(-1.0);
    fw_diag_warning(diags, 204, device->joint[h->joint].place,
                    "hinge %s turns by %s deg in %s (%s), but its drawn solids touch at %s deg: "
                    "use a smaller subtended angle, a longer arc or a smaller load",
                    h->id, fw_number_text(peak, sizeof peak, h->peak_angle_rad * degrees, 3),
                    h->scene, h->flow ? h->flow : "the device's own material",
                    fw_number_text(free_turn, sizeof free_turn, drawn->free_rad * degrees, 3));
}

fw_status fw_verdict_variant(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_mechanism *m, const fw_verdict_options *options,
                             fw_diags *diags, fw_variant_verdict *v) {
    v->mechanism = m;
    v->governing = FW_NONE;
    v->nhinge = m->nhinge;
    FW_NEED(v->hinge = fw_arena_array(arena, fw_hinge_verdict, (size_t)m->nhinge));
    fw_watch *watch = fw_arena_array(arena, fw_watch, (size_t)device->nscene);
    FW_NEED(watch);
    FW_TRY(run_scenes(arena, device, layout, m, options, diags, v, watch));
    FW_TRY(fw_workspace_required(arena, m, diags, &v->workspace));

    const fw_material *material = &m->variant->material;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_hinge *hinge = &m->hinge[k];
        const fw_hinge_layout *drawn = layout && layout->drawn ? &layout->hinge[hinge->pin] : NULL;
        fw_hinge_verdict blank = {.id = m->pin[hinge->pin].id,
                                  .joint = hinge->pin,
                                  .strain_limit = material->strength.value / device->safety_factor /
                                                  material->youngs.value};
        v->hinge[k] = blank;
        for (int i = 0; i < device->nscene; i++) {
            if (!v->motion[i]) continue;
            fw_hinge_verdict now = blank;
            judge_scene(m, hinge, drawn, v->motion[i], &watch[i].hinge[k], device->scene[i].name,
                        &now);
            if (now.touches) warn_touching(device, drawn, &now, diags);
            fw_verdict_keep_worst(&v->hinge[k], &now);
        }
        if (v->workspace.required) { /* the poses that can be reached */
            fw_hinge_verdict now = blank;
            judge_workspace(m, hinge, drawn, &v->workspace, &now);
            if (now.touches) warn_touching(device, drawn, &now, diags);
            fw_verdict_keep_worst(&v->hinge[k], &now);
        }
    }
    v->decision = FW_ACCEPT;
    for (int k = 0; k < v->nhinge; k++) {
        if (!v->hinge[k].scene) v->hinge[k].decision = FW_INCONCLUSIVE; /* nothing was run */
        if (v->hinge[k].decision > v->decision) v->decision = v->hinge[k].decision;
        if (v->hinge[k].scene &&
            (v->governing == FW_NONE || fw_verdict_governs(&v->hinge[k], &v->hinge[v->governing])))
            v->governing = k;
    }
    if (v->workspace.required && !v->workspace.reachable) v->decision = FW_REJECT;
    for (int i = 0; i < v->nreason; i++)
        if (v->reason[i].decision > v->decision) v->decision = v->reason[i].decision;
    return FW_OK;
}
