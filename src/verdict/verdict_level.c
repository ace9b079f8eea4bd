/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strains on two neighbouring levels of hinges, and what of it is in the band. */
#include "verdict/strain.h"
#include "verdict/verdict.h"
#include <math.h>

static double turned(const fw_mechanism *m, const double *q, int body) {
    return body == FW_GROUND ? 0 : q[3 * body + 2] - m->body[body].phi_rad;
}

/* by the level's own section moments: of the arc as drawn, or of the exact beam. Leaves have only
   bounds as drawn, which would hide the step: theirs are those of the beam on both levels */
static double strain_of(const fw_mechanism *m, const fw_mechanism_hinge *h,
                        fw_effects_hinge_model level, fw_flexure_elastica *beam,
                        const fw_verdict_hinge_load *load) {
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    const fw_layout_hinge_layout drawn = {.drawn = isfinite(h->axis_rad),
                                          .upper = h->first_is_a ? pin->body_b : pin->body_a,
                                          .axis_rad = h->axis_rad};
    bool arc = m->device->flexure[h->flexure].kind == FW_FLEXURE_CSFH;
    return fw_verdict_hinge_strain_exact(m, h, &drawn,
                                         level == FW_HINGE_ELASTICA || !arc ? beam : NULL, load);
}

static void strains(const fw_mechanism *m, fw_effects_hinge_model level,
                    fw_flexure_elastica *const *beam, const fw_statics_level_state *at) {
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        const double *force = at->reaction_N + 2 * m->hinge[k].pin;
        const fw_verdict_hinge_load load = {
            at->angle_rad[m->hinge[k].pin], force[0], force[1],
            0.5 * (turned(m, at->q, pin->body_a) + turned(m, at->q, pin->body_b))};
        at->strain[k] = strain_of(m, &m->hinge[k], level, beam[k], &load);
    }
}

fw_status fw_verdict_level_strains(fw_arena *arena, const fw_mechanism *m,
                                   const fw_statics_level_step *step) {
    if (!step || step->why_not || !m->device || m->device->nflexure == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    fw_flexure_elastica **beam = fw_arena_alloc(arena, (size_t)m->nhinge, sizeof *beam);
    FW_NEED(beam);
    for (int k = 0; k < m->nhinge; k++)
        FW_TRY(fw_verdict_hinge_beam(arena, &m->hinge[k], &beam[k]));
    strains(m, step->used, beam, &step->at);
    strains(m, step->next, beam, &step->up);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* stiffness of the closed form against 3-D finite elements: both levels have it, so that the step
   does not see it, and the angles under given loads follow it */
double fw_verdict_motion_lasting_error(const fw_mechanism *m) {
    double most = 0;
    for (int k = 0; k < m->nhinge; k++)
        if (!m->hinge[k].stated) most = fmax(most, m->hinge[k].closed_form.error.stiffness);
    return most;
}

/* Largest difference of strain and of angle between the level used and the next at the motion's
   peak, over the largest of either, and what both have in common. In a motion with inertia pins
   are judged by the reference cases where these are worse: frequencies that shift are not in the
   step. Exact beams have no next level: what is left is what they have in common with solids. */
double fw_verdict_motion_model_error(const fw_mechanism *m, const fw_dynamics_motion *x) {
    const fw_statics_level_step *s = x->level;
    double usual = fw_verdict_model_error.motion, common = fw_verdict_motion_lasting_error(m),
           off = 0, largest = 0;
    if (x->ledger.hinge.used == FW_HINGE_ELASTICA) return fmin(usual, common);
    if (!s || s->why_not || m->nhinge == 0) return usual;
    for (int k = 0; k < m->nhinge; k++) {
        if (!isfinite(s->at.strain[k]) || !isfinite(s->up.strain[k])) return usual;
        off = fmax(off, fabs(s->up.strain[k] - s->at.strain[k]));
        largest = fmax(largest, s->at.strain[k]);
    }
    double computed = fmax(largest > 0 ? off / largest : 0, s->relative) + common;
    bool swings = x->loads && !x->loads->quasi_static;
    return s->used == FW_HINGE_REVOLUTE && swings ? fmax(usual, computed) : computed;
}
