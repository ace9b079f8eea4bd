/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

/* of a pin: as the file or the mechanism has it, unless the scene's <material-damping> replaces it
 */
static double damping_of(const fw_effect_case *c, int pin) {
    return fw_effects_material_damped(c, pin) ? 0 : c->mechanism->pin[pin].damping_Nms_per_rad;
}

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (damping_of(c, i) > 0) return true;
    for (int i = 0; i < c->mechanism->njoint; i++)
        if (c->mechanism->joint[i].damping_Ns_per_m > 0) return true;
    return false;
}

/* rate along the axis of a sliding joint at most, m/s: of both points, and of the line's turning */
static double slide_rate(const fw_effect_case *c, const fw_device_joint *t) {
    const fw_mechanism *m = c->mechanism;
    fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
    const double *v = c->envelope->speed;
    double rate = 0;
    for (int side = 0; side < 2; side++) {
        int body = side ? t->body_b : t->body_a;
        if (body == FW_GROUND) continue;
        double arm = hypot(side ? t->bx_m : t->ax_m, side ? t->by_m : t->ay_m);
        rate += hypot(v[3 * body], v[3 * body + 1]) + arm * v[3 * body + 2];
        if (!side) rate += hypot(b.x - a.x, b.y - a.y) * v[3 * body + 2];
    }
    return rate;
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (damping_of(c, i) > 0)
            fw_effects_loads_torsion(c->mechanism, loads, i)->damping_Nms_per_rad =
                damping_of(c, i);
    for (int i = 0; i < c->mechanism->njoint; i++)
        if (c->mechanism->joint[i].damping_Ns_per_m > 0)
            fw_effects_loads_slide(loads, i)->damping_Ns_per_m =
                c->mechanism->joint[i].damping_Ns_per_m;
    return FW_OK;
}

/* modal forces (modes) of dampers along sliding joints at their largest rates */
static void slides(const fw_effect_case *c, double *mode, double *force) {
    const fw_mechanism *m = c->mechanism;
    const fw_effects_envelope *e = c->envelope;
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        if (!(t->damping_Ns_per_m > 0)) continue;
        double f = t->damping_Ns_per_m * slide_rate(c, t);
        fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
        fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
        double apart = hypot(b.x - a.x, b.y - a.y);
        for (int side = 0; side < 2; side++) {
            int body = side ? t->body_b : t->body_a;
            if (body == FW_GROUND) continue;
            double arm = hypot(side ? t->bx_m : t->ax_m, side ? t->by_m : t->ay_m);
            force[3 * body] += f, force[3 * body + 1] += f;
            force[3 * body + 2] += f * (arm + (side ? 0 : apart));
        }
    }
    for (int j = 0; j < e->modes; j++)
        for (int k = 0; k < e->n; k++)
            mode[j] += fabs(e->shape[(size_t)j * (size_t)e->n + (size_t)k]) * force[k];
}

/* Without its dampers the motion differs by d with M d'' + C d' + K d = C q', q the motion without
   them, whose rates the envelope knows: an answer to a force of known size that may go with the
   motion (resonance). Inputs c in N m s/rad and N s/m; output dimensionless; conservative for small
   motions. Cost modes times joints. Test: test_effects.c, test_bounds.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    *value = (double)INFINITY;
    if (!e->valid) {
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "joints have damping, and nothing bounds how fast they turn: kept (%s)",
                    e->why_not));
        return FW_OK;
    }
    fw_mark mark = fw_arena_mark(c->arena);
    double *mode, *force;
    FW_NEED(mode = fw_arena_array(c->arena, double, (size_t)e->modes));
    FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->n));
    fw_effects_loads loads;
    slides(c, mode, force);
    FW_TRY(fw_effects_loads_new(c->arena, c->mechanism, c->scene, &loads));
    FW_TRY(add(c, &loads));
    if (e->pinned) FW_TRY(fw_effects_hinges_flex(c, &loads)); /* they dissipate in all directions */
    for (int i = 0; i < loads.nslide; i++)
        loads.slide[i].damping_Ns_per_m = 0; /* see slides */
    FW_TRY(fw_effects_envelope_dampers(c, &loads, mode));
    *value = fw_effects_envelope_mode_answer(c, mode, (double)INFINITY);
    fw_arena_rewind(c->arena, mark);
    *reason = "joints have damping: answer of the modes to c times the largest rates, over the "
              "scene";
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->npin; i++)
        n += damping_of(c, i) > 0;
    for (int i = 0; i < c->mechanism->njoint; i++)
        n += c->mechanism->joint[i].damping_Ns_per_m > 0;
    return n;
}

const fw_effect_row fw_effect_joint_damping = {
    .id = "joint-damping",
    .summary = "viscous torque of hinges and force of sliding joints, c times rate",
    .called_for = called_for,
    .bound = bound,
    .calms = true,
    .by_rate = true,
    .add = add,
    .adds_blindly = true,
    .cost = 32,
    .count = count,
    .solid = FW_EFFECTS_SOLID_NO_PART};
