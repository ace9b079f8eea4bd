/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What to change, and by how much: longer flexures, else wider ones; and, beside either, how far
   the loads or the required poses would have to come down; and every declared parameter alone.
   Every sentence has been run and accepted. */
#include "verdict/trial.h"
#include <math.h>

/* no change of a flexure can help */
static const char *hopeless(const fw_device *device, const fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (v->workspace.required && !v->workspace.reachable)
            return "part of the required workspace is out of reach: no flexure can change that; "
                   "make the links longer or the workspace smaller";
        for (int k = 0; k < device->nscene; k++)
            if (v->motion[k] && v->motion[k]->ended)
                return "a scene turns a joint by more than a whole turn: no flexure can follow; "
                       "lower its load";
    }
    return NULL;
}

static fw_status conclude(fw_arena *arena, fw_verdict *verdict, const char *loads) {
    if (!verdict->advice_verified && !loads) {
        verdict->advice_note =
            "no single kind of change (longer or wider flexures, smaller loads or workspace) was "
            "found that accepts and can be drawn: reconsider hinge points, thickness or material";
        return FW_OK;
    }
    if (!verdict->advice_verified)
        verdict->advice_note = fw_arena_printf(
            arena,
            "reduce %s: this was run and accepted; longer or wider flexures alone do not help",
            loads);
    else
        verdict->advice_note =
            fw_arena_printf(arena, "%s run and accepted%s%s%s",
                            verdict->nadvice > 1 ? "all of these together were" : "this was",
                            loads ? "; or keep the flexures and reduce " : "", loads ? loads : "",
                            loads ? ": run and accepted as well" : "");
    FW_NEED(verdict->advice_note);
    return FW_OK;
}

fw_status fw_verdict_advise(fw_arena *arena, const fw_device *device,
                            const fw_verdict_options *options, fw_verdict *verdict) {
    FW_TRY(fw_verdict_change_parameters(arena, device, options, verdict));
    verdict->advice_note = hopeless(device, verdict);
    if (verdict->advice_note) return FW_OK;
    FW_NEED(verdict->advice =
                fw_arena_array(arena, fw_verdict_advice, 2 * (size_t)device->nflexure));
    fw_verdict_trial trial;
    bool done = false;
    const char *loads = NULL;
    FW_TRY(fw_verdict_trial_start(arena, device, options, verdict, &trial));
    FW_TRY(fw_verdict_change_lengths(&trial, verdict, &done));
    if (!done) {
        FW_TRY(fw_verdict_trial_start(arena, device, options, verdict, &trial));
        FW_TRY(fw_verdict_change_widths(&trial, verdict, &done));
    }
    verdict->advice_verified = done;
    FW_TRY(fw_verdict_trial_start(arena, device, options, verdict, &trial));
    FW_TRY(fw_verdict_change_loads(&trial, &loads, &done));
    return conclude(arena, verdict, done ? loads : NULL);
}
