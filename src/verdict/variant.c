/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/compare.h"
#include "verdict/strain.h"
#include <math.h>
#include <string.h>

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

static double rotation(const fw_motion *motion, const fw_mechanism *m, int row, int body) {
    if (body == FW_GROUND) return 0.0;
    return motion->q[(size_t)row * 3 * (size_t)motion->nbody + 3 * (size_t)body + 2] -
           m->body[body].phi_rad;
}

static double strain_at(const fw_mechanism *m, const fw_hinge *hinge, const fw_hinge_layout *drawn,
                        const fw_motion *motion, int row) {
    const fw_pin *pin = &m->pin[hinge->pin];
    size_t at = (size_t)row * (size_t)motion->npin + (size_t)hinge->pin;
    fw_hinge_load load = {
        motion->angle_rad[at], motion->reaction_N ? motion->reaction_N[2 * at] : 0.0,
        motion->reaction_N ? motion->reaction_N[2 * at + 1] : 0.0,
        0.5 * (rotation(motion, m, row, pin->body_a) + rotation(motion, m, row, pin->body_b))};
    return fw_hinge_strain(m, hinge, drawn, &load);
}

/* largest strain over the samples, its instant, and what a parabola through the neighbours adds */
static double largest_strain(const fw_mechanism *m, const fw_hinge *hinge,
                             const fw_hinge_layout *drawn, const fw_motion *motion, double *t_s,
                             double *between) {
    double best = 0.0;
    int row = 0;
    for (int i = 0; i < motion->nsample; i++) {
        double strain = strain_at(m, hinge, drawn, motion, i);
        if (strain > best) {
            best = strain;
            row = i;
        }
    }
    *t_s = motion->nsample ? motion->t_s[row] : 0.0;
    *between = 0.0;
    if (row > 0 && row < motion->nsample - 1) {
        double a = strain_at(m, hinge, drawn, motion, row - 1);
        double b = strain_at(m, hinge, drawn, motion, row + 1), bend = 2.0 * best - a - b;
        if (bend > 0.0) *between = (b - a) * (b - a) / (8.0 * bend);
    }
    return best + *between;
}

/* utilisation = peak strain (rotation and joint force, fillets included) over the limit strain, and
   never less than peak angle / limit angle; band = numerical error + model errors, added up */
static void judge_scene(const fw_mechanism *m, const fw_hinge *hinge, const fw_hinge_layout *drawn,
                        const fw_motion *motion, const char *scene, fw_hinge_verdict *out) {
    const fw_peak *peak = &motion->peak[hinge->pin];
    const fw_flexure_result *c = &hinge->closed_form;
    double angle = fabs(peak->angle_rad), t_strain, between;
    double strain = largest_strain(m, hinge, drawn, motion, &t_strain, &between);
    double by_angle = angle / c->limit_angle_rad, by_strain = strain / out->strain_limit;
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
    out->t_s = by_strain > by_angle ? t_strain : peak->t_s;
    double numeric =
        (angle > 0.0 ? peak->error_rad / angle : 0.0) + (strain > 0.0 ? between / strain : 0.0);
    double band = numeric + fw_verdict_model_error.motion + fw_verdict_model_error.strain +
                  2.0 * (c->limit_uncertainty - 0.015);
    out->utilisation_low = out->utilisation * fmax(0.0, 1.0 - band);
    out->utilisation_high = out->utilisation * (1.0 + band);
    out->decision = decide(out->utilisation_low, out->utilisation_high);
    out->touches = drawn && drawn->drawn && drawn->free_rad > 0.0 && angle > drawn->free_rad;
}

static void judge_workspace(const fw_mechanism *m, const fw_hinge *hinge,
                            const fw_workspace_result *workspace, fw_hinge_verdict *out) {
    const fw_workspace_peak *peak = &workspace->peak[hinge->pin];
    const fw_flexure_result *c = &hinge->closed_form;
    double angle = fabs(peak->angle_rad);
    *out = (fw_hinge_verdict){.id = out->id,
                              .joint = out->joint,
                              .strain_limit = out->strain_limit,
                              .limit_angle_rad = c->limit_angle_rad,
                              .flow = m->variant->flow,
                              .scene = "workspace",
                              .peak_angle_rad = peak->angle_rad,
                              .angle_error_rad = peak->error_rad,
                              .t_s = (double)NAN};
    out->utilisation = angle / c->limit_angle_rad;
    out->peak_strain = out->utilisation * out->strain_limit;
    double numeric = angle > 0.0 ? peak->error_rad / angle : 0.0;
    double band = numeric + fw_verdict_model_error.strain + 2.0 * (c->limit_uncertainty - 0.015);
    out->utilisation_low = out->utilisation * fmax(0.0, 1.0 - band);
    out->utilisation_high = out->utilisation * (1.0 + band + fw_verdict_model_error.workspace);
    out->decision = decide(out->utilisation_low, out->utilisation_high);
}

static bool in_flow(const char *asked, const char *flow) {
    return !asked || (flow && strcmp(asked, flow) == 0);
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

static fw_status run_scenes(fw_arena *arena, const fw_device *device, const fw_mechanism *m,
                            const fw_verdict_options *options, fw_diags *diags,
                            fw_variant_verdict *v) {
    size_t n = (size_t)device->nscene;
    fw_motion_options motion = options->motion;
    if (motion.most_angle_rad <= 0) motion.most_angle_rad = whole_turn;
    FW_NEED(v->motion = fw_arena_alloc(arena, n, sizeof *v->motion));
    for (size_t i = 0; i < n; i++) {
        const fw_scene *scene = &device->scene[i];
        if (!in_flow(scene->flow, m->variant->flow)) continue;
        FW_TRY(fw_simulate(arena, m, scene, &motion, diags, &v->motion[i]));
        if (v->motion[i]->ended) warn_ended(scene, v->motion[i], diags);
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
    FW_TRY(run_scenes(arena, device, m, options, diags, v));
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
            judge_scene(m, hinge, drawn, v->motion[i], device->scene[i].name, &now);
            if (now.touches) warn_touching(device, drawn, &now, diags);
            fw_verdict_keep_worst(&v->hinge[k], &now);
        }
        if (v->workspace.required && v->workspace.reachable) {
            fw_hinge_verdict now = blank;
            judge_workspace(m, hinge, &v->workspace, &now);
            fw_verdict_keep_worst(&v->hinge[k], &now);
        }
    }
    v->decision = FW_ACCEPT;
    for (int k = 0; k < v->nhinge; k++) {
        if (v->hinge[k].decision > v->decision) v->decision = v->hinge[k].decision;
        if (v->hinge[k].scene &&
            (v->governing == FW_NONE || fw_verdict_governs(&v->hinge[k], &v->hinge[v->governing])))
            v->governing = k;
    }
    if (v->workspace.required && !v->workspace.reachable) v->decision = FW_REJECT;
    return FW_OK;
}
