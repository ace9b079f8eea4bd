/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Damping of the flexures' material. A loss factor eta (energy lost per radian of a cycle over the
   energy stored) is a viscous damper of c = eta k/omega at one frequency only: <material-damping>
   says which, else it is the lowest mode of the pinned mechanism, and where that is not known
   sqrt(k/J) of each hinge with the smaller inertia J of its two bodies about it.

   Without <material-damping> in the scene, a flexure whose damping the file does not state has the
   estimate of mechanism/mechanism_build.c, which joint-damping adds. With it, joint-damping leaves
   these hinges alone (fw_effects_material_damped) and this effect has them: nothing counts twice. A
   damping stated in the file holds in both cases. Inputs eta, Hz, k in N m/rad; output N m s/rad.
   Valid for motions near the frequency: away from it the damper's loss factor goes with the
   frequency, the material's hardly does. Source: loss factor and equivalent viscous damping as in
   any text on vibration; docs/theory/effects/material-damping.md. Test: test_material_damping.c. */
#include "effects/effect.h"
#include "base/constants.h"
#include "effects/envelope.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (fw_effects_material_damped(c, i)) return true;
    return false;
}

static double inertia_about(const fw_mechanism *m, int body, double x, double y) {
    if (body == FW_GROUND) return (double)INFINITY;
    return m->body[body].inertia_kg_m2 + m->body[body].mass_kg * (x * x + y * y);
}

/* rad/s at which the loss factor holds, for this pin; the scene's last word counts */
static double frequency_of(const fw_effect_case *c, const fw_mechanism_pin *p) {
    double stated = c->scene->damping[c->scene->ndamping - 1].frequency_Hz;
    if (!isnan(stated)) return 2 * FW_PI * stated;
    const fw_effects_envelope *e =
        c->envelope && c->envelope->pinned ? c->envelope->pinned : c->envelope;
    if (e && e->valid && e->modes > 0 && e->omega[0] > 0) return e->omega[0];
    double a = inertia_about(c->mechanism, p->body_a, p->ax_m, p->ay_m);
    double b = inertia_about(c->mechanism, p->body_b, p->bx_m, p->by_m);
    return sqrt(p->stiffness_Nm_per_rad / fmin(a, b));
}

/* N m s/rad; NaN: the material's loss factor is not known */
static double damping_of(const fw_effect_case *c, int pin) {
    const fw_mechanism_pin *p = &c->mechanism->pin[pin];
    if (!(p->stiffness_Nm_per_rad > 0)) return 0;
    return fw_effects_loss(c) * p->stiffness_Nm_per_rad / frequency_of(c, p);
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    if (isnan(fw_effects_loss(c))) {
        const fw_mechanism_variant *v = c->mechanism->variant;
        if (!c->diags) return FW_INPUT;
        return fw_diag_error(c->diags, 247, c->scene->damping[c->scene->ndamping - 1].place,
                             "the loss factor of material %s is not known; give "
                             "<material-damping loss-factor=\"...\">",
                             v && v->material.id ? v->material.id : "");
    }
    for (int i = 0; i < c->mechanism->npin; i++)
        if (fw_effects_material_damped(c, i) && damping_of(c, i) > 0)
            fw_effects_loads_torsion(c->mechanism, loads, i)->damping_Nms_per_rad +=
                damping_of(c, i);
    return FW_OK;
}

/* Without its dampers the motion differs by d with M d'' + C d' + K d = C q', q the motion without
   them: the answer to its forces at the largest rates, of whatever sign and course (modal_loads.c).
   Infinite where the envelope is not valid. Inputs SI from the envelope; output dimensionless.
   Test: test_material_damping.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_mechanism *m = c->mechanism;
    const fw_effects_envelope *v = c->envelope;
    *value = (double)INFINITY;
    *reason = "the loss factor is not known";
    if (isnan(fw_effects_loss(c))) return FW_OK;
    if (!v || !v->valid) {
        FW_NEED(*reason = fw_arena_printf(c->arena,
                                          "the material has a loss factor, and nothing bounds how "
                                          "fast the hinges turn: kept (%s)",
                                          v ? v->why_not : "not looked at"));
        return FW_OK;
    }
    fw_mark mark = fw_arena_mark(c->arena);
    fw_effects_loads loads;
    double *mode;
    FW_NEED(mode = fw_arena_array(c->arena, double, (size_t)v->modes));
    FW_TRY(fw_effects_loads_new(c->arena, m, c->scene, &loads));
    FW_TRY(add(c, &loads));
    if (v->pinned) FW_TRY(fw_effects_hinges_flex(c, &loads)); /* they dissipate in all directions */
    FW_TRY(fw_effects_envelope_dampers(c, &loads, mode));
    *value = fw_effects_envelope_mode_answer(c, mode, (double)INFINITY);
    *reason = "the material has a loss factor: answer to c times the largest rates, over the scene";
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int hinges = 0;
    for (int i = 0; i < c->mechanism->npin; i++)
        hinges += fw_effects_material_damped(c, i);
    return hinges;
}

/* every hinge has a damping of its own */
static void idle(const fw_effect_case *c, fw_diags *diags) {
    const int n = c->scene->ndamping;
    if (n == 0 || c->mechanism->nhinge == 0) return;
    fw_diag_warning(diags, 686, c->scene->damping[n - 1].place,
                    "<material-damping> of %s%s damps nothing: every hinge states a damping of its "
                    "own, which holds; leave out damping of the <revolute>, or this",
                    FW_NAMED("scene", c->scene->name));
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    if (s->ndamping) fw_effects_say(to, "; damping by the material");
}

const fw_effect_row fw_effect_material_damping = {
    .id = "material-damping",
    .summary = "loss factor of the flexures' material, as the scene states it",
    .called_for = called_for,
    .idle = idle,
    .bound = bound,
    .by_rate = true,
    .calms = true,
    .add = add,
    .cost = 31,
    .count = count,
    .describe = describe,
    .solid = FW_EFFECTS_SOLID_NO_PART};
