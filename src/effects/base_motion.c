/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The base shakes: poses and velocities are counted in its frame, where every body feels -m a(t) at
   its centre of mass. The base does not turn, so there is no other force of that kind. Energies are
   those in the frame of the base: the work of -m a is what the shaker feeds in, seen from there. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

static bool shakes(const fw_base_motion *b) {
    return b->ax_m_per_s2 != 0 || b->ay_m_per_s2 != 0;
}

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->nbase; i++)
        if (shakes(&c->scene->base[i])) return true;
    return false;
}

/* largest |law| and its total variation in units of that, jumps at the start and at the end
   included: between two extremes a sine goes 2, and in n half periods there are at most n + 1 of
   them. Infinite where samples would have to stand for a proof (expressions), and for noise. */
static void law_size(const fw_law *law, double end_s, double *size, double *variation) {
    *size = *variation = 1;
    if (fw_law_is_constant(law)) return;
    double last = fmin(end_s, law->end_s), value[3] = {0, 0, 0};
    switch (law->kind) {
    case FW_LAW_STEP:
        *variation = 2;
        return;
    case FW_LAW_RAMP:
        return;
    case FW_LAW_SINE:
        *variation = 2 * ceil(2 * law->frequency_Hz * fmax(0, last - law->start_s)) + 2;
        return;
    case FW_LAW_HALF_SINE:
        *variation = 2;
        return;
    case FW_LAW_TABLE:
        *size = fw_law_largest(law, end_s), *variation = 0;
        for (int i = 0; i < law->ntable; i++) {
            *variation += fabs(law->table_value[i] - value[0]);
            value[0] = law->table_value[i];
        }
        if (*size > 0) *variation /= *size;
        return;
    case FW_LAW_RANDOM: /* sqrt(2/n) sum of n cosines */
        *size = sqrt(2.0 * law->lines);
        *variation = (double)INFINITY;
        return;
    case FW_LAW_EXPRESSION:
    default:
        *size = (double)INFINITY;
        return;
    }
}

/* sum over the shakes of the envelope's answer to |m a| on every body with the variation of the
   law. Inputs SI; output dimensionless. Valid where the envelope is. Cost modes x bodies each.
   Test: test_base_motion.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_mechanism *m = c->mechanism;
    *value = (double)INFINITY;
    *reason = "the base shakes: it is the motion itself";
    if (!c->envelope || !c->envelope->valid) return FW_OK;
    fw_mark mark = fw_arena_mark(c->arena);
    double *force, sum = 0;
    FW_NEED(force = fw_arena_array(c->arena, double, 3 * (size_t)m->nbody));
    for (int i = 0; i < c->scene->nbase; i++) {
        const fw_base_motion *b = &c->scene->base[i];
        double size, variation;
        if (!shakes(b)) continue;
        law_size(b->law, c->scene->duration_s, &size, &variation);
        if (size == 0) continue;
        for (int k = 0; k < m->nbody; k++) {
            force[3 * k] = m->body[k].mass_kg * fabs(b->ax_m_per_s2) * size;
            force[3 * k + 1] = m->body[k].mass_kg * fabs(b->ay_m_per_s2) * size;
        }
        sum += isfinite(size) ? fw_envelope_answer(c, force, variation) : (double)INFINITY;
    }
    fw_arena_rewind(c->arena, mark);
    if (!(sum < (double)INFINITY)) return FW_OK;
    *value = sum;
    *reason = "the base shakes: bound by the envelope's answer to the forces -m a with all turns "
              "of their laws";
    return FW_OK;
}

/* laws to `timed` (room for every body and shake is reserved), what is constant to the constants */
static fw_status add(const fw_effect_case *c, fw_terms *terms) {
    const fw_mechanism *m = c->mechanism;
    for (int i = 0; i < c->scene->nbase; i++) {
        const fw_base_motion *b = &c->scene->base[i];
        for (int k = 0; k < m->nbody && shakes(b); k++) {
            double fx = -m->body[k].mass_kg * b->ax_m_per_s2;
            double fy = -m->body[k].mass_kg * b->ay_m_per_s2;
            if (!fw_law_is_constant(b->law)) {
                terms->timed[terms->ntimed++] =
                    (fw_timed_load){.body = k, .fx_N = fx, .fy_N = fy, .law = b->law};
                continue;
            }
            terms->constant[3 * k] += fx;
            terms->constant[3 * k + 1] += fy;
        }
    }
    return FW_OK;
}

/* what is constant is among the constants */
static int count(const fw_effect_case *c) {
    int laws = 0;
    for (int i = 0; i < c->scene->nbase; i++)
        laws += shakes(&c->scene->base[i]) && !fw_law_is_constant(c->scene->base[i].law);
    return laws * c->mechanism->nbody;
}

/* kept: a scene that shakes may have nothing else to judge; beside large loads a bound below the
   accuracy wanted says that it adds nothing */
const fw_effect_row fw_effect_base_motion = {.id = "base-motion",
                                             .summary = "acceleration of the base: -m a(t) on "
                                                        "every body, in the base's frame",
                                             .called_for = called_for,
                                             .bound = bound,
                                             .add = add,
                                             .cost = 449,
                                             .count = count,
                                             .kept = true};
