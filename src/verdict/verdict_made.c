/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device that a flow may make, at any point of its inputs: the largest share of a limit that it uses, for
   whoever draws many of them. Theory: docs/theory/as-fabricated.md. */
#include "verdict/verdict_parts.h"
#include <math.h>

/* a flexure cut through, or a scene that cannot be run through, is beyond its limit by no known share */
static const double beyond = 0.5;

static fw_status judge(fw_arena *scratch, fw_arena *arena, const fw_device *device,
                       const fw_layout *layout, const fw_verdict_options *options,
                       const fw_verdict_variant_verdict *v, const double *x, fw_verdict_made *out) {
    fw_verdict_search s;
    fw_verdict_options glance = *options;
    glance.at_a_glance = true; /* the value counts, not the decision */
    FW_TRY(fw_verdict_search_begin(scratch, device, layout, &glance, v, &s));
    FW_TRY(fw_verdict_search_run(&s, x, FW_NO_CORNER));
    const fw_verdict_fabricated_corner *c = &s.fabricated->corner[0];
    *out = (fw_verdict_made){.decision = c->decision, .ln = -HUGE_VAL, .up = 0, .down = 0};
    for (int r = 0; r < s.ncheck; r++)
        out->ln = fmax(out->ln, s.ln[r]); /* NaN is passed */
    double most = 0;
    for (int k = 0; k < v->nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &c->hinge[k];
        if (!h->scene || !(h->utilisation > most)) continue;
        most = h->utilisation;
        out->hinge = k;
        out->up = log(h->utilisation_high / h->utilisation);
        out->down = h->utilisation_low > 0 ? log(h->utilisation / h->utilisation_low) : HUGE_VAL;
    }
    if (most == 0) out->hinge = FW_NONE;
    if (c->why) FW_NEED(out->why = fw_arena_strdup(arena, c->why));
    if (c->decision == FW_REJECT && out->ln <= 0 && c->why) out->ln = beyond;
    if (!isfinite(out->ln)) out->ln = c->decision == FW_REJECT ? beyond : (double)NAN;
    return FW_OK;
}

fw_status fw_verdict_made_at(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict_options *options, const fw_verdict_variant_verdict *v,
                             const double *x, fw_verdict_made *out) {
    fw_arena *scratch = fw_arena_part(arena, 0);
    FW_NEED(scratch);
    fw_status status = judge(scratch, arena, device, layout, options, v, x, out);
    fw_arena_free(scratch);
    return status;
}
