/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which check a verdict rests on: of all flows, as each makes the device, or as it is drawn. */
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

static const char *limit_of(const fw_verdict_hinge_verdict *h) {
    bool tires = h->limit && strcmp(h->limit->criterion, "fatigue") == 0;
    return tires ? "its fatigue limit" : "its elastic limit";
}

static fw_verdict_check check_of(const fw_verdict_hinge_verdict *h, const char *flow,
                                 const char *corner) {
    return (fw_verdict_check){.of = limit_of(h),
                              .used = h->utilisation,
                              .low = h->utilisation_low,
                              .high = h->utilisation_high,
                              .flow = flow,
                              .scene = h->scene,
                              .corner = corner,
                              .t_s = h->t_s,
                              .decision = h->decision,
                              .hinge = h};
}

static void keep(fw_verdict_check *worst, bool *found, fw_verdict_check now) {
    bool worse = !*found || fw_verdict_is_worse(now.decision, worst->decision) ||
                 (now.decision == worst->decision && now.used > worst->used);
    if (worse) *worst = now;
    *found = true;
}

static void drawn(const fw_verdict_variant_verdict *v, fw_verdict_check *worst, bool *found) {
    for (int k = 0; k < v->nhinge; k++)
        if (v->hinge[k].scene)
            keep(worst, found, check_of(&v->hinge[k], v->variant ? v->variant->flow : NULL, NULL));
}

/* of what was run: every corner */
static void as_made(const fw_verdict_variant_verdict *v, fw_verdict_check *worst, bool *found) {
    for (int c = 0; c < v->fabricated->ncorner; c++) {
        const fw_verdict_fabricated_corner *corner = &v->fabricated->corner[c];
        for (int k = 0; k < v->nhinge; k++)
            if (corner->hinge[k].scene)
                keep(worst, found, check_of(&corner->hinge[k], v->variant->flow, corner->what));
    }
}

fw_status fw_verdict_governing(fw_arena *arena, const fw_verdict *verdict, bool made,
                               fw_verdict_check *check, bool *found) {
    *found = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (made && v->fabricated)
            as_made(v, check, found);
        else
            drawn(v, check, found);
    }
    if (*found) FW_NEED(check->what = fw_arena_printf(arena, "hinge %s", check->hinge->id));
    return FW_OK;
}
