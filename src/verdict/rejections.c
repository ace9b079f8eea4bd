/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why a design is rejected, each reason once: what stands on certificates, order sheets and run sheets
   that are written all the same. */
#include "verdict/verdict.h"
#include <string.h>

static bool said(const char *const *text, int n, const char *what) {
    for (int i = 0; i < n; i++)
        if (strcmp(text[i], what) == 0) return true;
    return false;
}

static fw_status of_hinge(fw_arena *arena, const fw_verdict_hinge_verdict *h, const char **text) {
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
        FW_TRY(of_hinge(arena, &verdict->hinge[k], &one));
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
