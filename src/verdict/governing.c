/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which check a verdict rests on, and why a design is rejected. */
#include "verdict/verdict.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- which check ----
   Of all flows, as each makes the device, or as it is drawn. */

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
                              .most = (double)NAN,
                              .decision = h->decision,
                              .hinge = h};
}

/* a bound that is what was drawn has no share of it: only its decision counts */
static fw_verdict_check of_requirement(const fw_verdict_requirement *r, const char *corner) {
    return (fw_verdict_check){.used = r->utilisation,
                              .low = r->utilisation_low,
                              .high = r->utilisation_high,
                              .flow = r->flow,
                              .scene = r->scene ? r->scene : "at rest",
                              .corner = corner,
                              .t_s = r->t_s,
                              .most = (double)NAN,
                              .decision = r->decision,
                              .requirement = r};
}

static void keep(fw_verdict_check *worst, bool *found, fw_verdict_check now) {
    bool more = now.used > worst->used || (isnan(worst->used) && !isnan(now.used));
    bool worse = !*found || fw_verdict_is_worse(now.decision, worst->decision) ||
                 (now.decision == worst->decision && more);
    if (worse) *worst = now;
    *found = true;
}

static void drawn(const fw_verdict_variant_verdict *v, int kinds, fw_verdict_check *worst,
                  bool *found) {
    for (int k = 0; (kinds & FW_CHECK_HINGES) && k < v->nhinge; k++)
        if (v->hinge[k].scene)
            keep(worst, found, check_of(&v->hinge[k], v->variant ? v->variant->flow : NULL, NULL));
    for (int k = 0; (kinds & FW_CHECK_REQUIREMENTS) && k < v->nrequirement; k++)
        keep(worst, found, of_requirement(&v->requirement[k], NULL));
}

/* of what was run: every corner */
static void as_made(const fw_verdict_variant_verdict *v, int kinds, fw_verdict_check *worst,
                    bool *found) {
    for (int c = 0; c < v->fabricated->ncorner; c++) {
        const fw_verdict_fabricated_corner *corner = &v->fabricated->corner[c];
        for (int k = 0; (kinds & FW_CHECK_HINGES) && k < v->nhinge; k++)
            if (corner->hinge[k].scene)
                keep(worst, found, check_of(&corner->hinge[k], v->variant->flow, corner->what));
    }
    for (int k = 0; (kinds & FW_CHECK_REQUIREMENTS) && k < v->nrequirement; k++) {
        int c;
        const fw_verdict_requirement *r = fw_verdict_requirement_made(v, k, &c);
        if (r) keep(worst, found, of_requirement(r, v->fabricated->corner[c].what));
    }
}

/* what no corner exceeds, run or not */
static double most_of(const fw_verdict *verdict) {
    double most = (double)NAN;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; v->fabricated && k < v->nhinge; k++)
            most = fmax(most, v->fabricated->hinge[k].most);
    }
    return most;
}

fw_status fw_verdict_governing(fw_arena *arena, const fw_verdict *verdict, int kinds, bool made,
                               fw_verdict_check *check, bool *found) {
    *found = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (made && v->fabricated)
            as_made(v, kinds, check, found);
        else
            drawn(v, kinds, check, found);
    }
    if (!*found) return FW_OK;
    if (made && check->hinge) check->most = most_of(verdict);
    const fw_verdict_requirement *r = check->requirement;
    check->what = r ? fw_arena_printf(arena, "requirement %s (%s)", r->probe,
                                      r->measure ? r->measure : r->kind)
                    : fw_arena_printf(arena, "hinge %s", check->hinge->id);
    FW_NEED(check->what);
    if (r) FW_NEED(check->of = fw_verdict_requirement_text(arena, r));
    return FW_OK;
}

/* ---- why it is rejected ----
   Each reason once: what stands on certificates, order sheets and run sheets
   that are written all the same. */

static bool said(const char *const *text, int n, const char *what) {
    for (int i = 0; i < n; i++)
        if (strcmp(text[i], what) == 0) return true;
    return false;
}

static fw_status rejection_of_hinge(fw_arena *arena, const fw_verdict_hinge_verdict *h,
                                    const char **text) {
    char used[32];
    fw_percent_text(used, sizeof used, h->utilisation);
    FW_NEED(*text =
                fw_arena_printf(arena, "hinge %s uses %s %% of its limit in %s%s%s", h->id, used,
                                h->scene, h->flow ? ", flow " : "", h->flow ? h->flow : ""));
    return FW_OK;
}

fw_status fw_verdict_rejections(fw_arena *arena, const fw_verdict *verdict, const char ***text,
                                int *n) {
    int most = verdict->nhinge;
    const char *one;
    *n = 0;
    for (int i = 0; i < verdict->nvariant; i++)
        most += verdict->variant[i].nreason;
    FW_NEED(*text = fw_arena_alloc(arena, (size_t)most, sizeof **text));
    for (int k = 0; k < verdict->nhinge; k++) {
        if (verdict->hinge[k].decision != FW_REJECT || !verdict->hinge[k].scene) continue;
        FW_TRY(rejection_of_hinge(arena, &verdict->hinge[k], &one));
        (*text)[(*n)++] = one;
    }
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < verdict->variant[i].nreason; k++) {
            const fw_verdict_reason *r = &verdict->variant[i].reason[k];
            if (r->decision != FW_REJECT) continue;
            FW_NEED(one = fw_arena_printf(arena, "%s [FW-D%03d]", r->text, r->number));
            if (!said(*text, *n, one)) (*text)[(*n)++] = one;
        }
    return FW_OK;
}
