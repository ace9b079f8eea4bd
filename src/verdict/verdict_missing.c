/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nothing is in the motion, or holds the device, that is not in its masks: what finds no room in the
   drawing rejects it, in the flows whose scenes have it. Test: tests/unit/plan/test_not_drawn.c */
#include "verdict/verdict_parts.h"
#include <math.h>

int fw_verdict_missing_most(const fw_device *device) {
    int n = device->nbody;
    for (int i = 0; i < device->nscene; i++) {
        n += device->scene[i].ncomb;
        for (int t = 0; t < device->scene[i].ntendon; t++)
            n += device->scene[i].tendon[t].neyelet;
    }
    return n;
}

static fw_status text_of(fw_arena *arena, const fw_layout_missing *m, const char **text) {
    char x[32], y[32];
    const bool moves = m->comb || m->eyelet;
    const char *line = m->place.line > 0
                           ? fw_arena_printf(arena, ", line %d, column %d of the description",
                                             m->place.line, m->place.column)
                           : "";
    FW_NEED(line);
    FW_NEED(*text = fw_arena_printf(arena, "%s at (%s, %s) um%s: %s, but not in the masks: %s%s%s",
                                    m->name, fw_number_text(x, sizeof x, m->at.x * 1e6, 5),
                                    fw_number_text(y, sizeof y, m->at.y * 1e6, 5), line,
                                    moves ? "in the motion" : "asked for", m->why,
                                    m->room ? "; nearest room: " : "", m->room ? m->room : ""));
    return FW_OK;
}

fw_status fw_verdict_missing(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             fw_verdict_variant_verdict *v) {
    for (int i = 0; layout && layout->drawn && i < layout->nmissing; i++) {
        const fw_layout_missing *m = &layout->missing[i];
        const char *flow = v->mechanism->variant->flow, *text;
        if (!fw_layout_missing_in_flow(device, m, flow)) continue;
        FW_TRY(text_of(arena, m, &text));
        v->reason[v->nreason++] = (fw_verdict_reason){.scene = NULL,
                                                      .flow = flow,
                                                      .number = m->number,
                                                      .decision = FW_REJECT,
                                                      .keep = 0.7,
                                                      .not_by_loads = true,
                                                      .not_by_width = true,
                                                      .text = text};
    }
    return FW_OK;
}
