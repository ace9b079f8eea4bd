/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What dampers do to the modes: |C q'| with C between the modes and the envelope's modal speed of
   each; a
   share u of the fastest rate on every torsion, u the nonlinearity estimate of the envelope,
   because motions that
   are not linear turn what linear theory leaves at rest. Hinges that give dissipate in all
   directions: their elements are part of `loads`. Inputs and outputs SI. Test: test_bounds.c,
   test_hinge_bounds.c. */
#include "effects/envelope.h"
#include "effects/modal.h"
#include <math.h>

fw_status fw_effects_envelope_dampers(const fw_effect_case *c, const fw_effects_loads *loads,
                                      double *mode) {
    const fw_effects_envelope *e = c->envelope;
    size_t m = (size_t)e->modes, pins = (size_t)e->npin;
    double *damping, fastest = 0, nonlinearity = 0.25 * (e->margin - 1);
    fw_mark mark = fw_arena_mark(c->arena);
    FW_NEED(damping = fw_arena_array(c->arena, double, m *m));
    FW_TRY(fw_effects_modal_damping(c->arena, e->modal, loads, damping));
    for (size_t i = 0; i < pins; i++)
        fastest = fmax(fastest, e->rate[i]);
    for (size_t j = 0; j < m; j++) {
        for (size_t l = 0; l < m; l++)
            mode[j] += fabs(damping[j * m + l]) * e->modal_speed[l] * e->margin;
        for (int i = 0; i < loads->ntorsion; i++)
            mode[j] += fabs(e->turn[j * pins + (size_t)loads->torsion[i].pin]) *
                       loads->torsion[i].damping_Nms_per_rad * fastest * nonlinearity;
    }
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}
